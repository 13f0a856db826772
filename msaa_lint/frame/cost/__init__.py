"""What a frame costs: bytes read and written, memory, power, fragment shader invocations, and what
fits on a tile.
"""
