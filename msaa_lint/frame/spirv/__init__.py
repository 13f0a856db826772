"""SPIR-V: what a shader says of multisampling by itself. Hand-written, bounded, and made for bytes of anyone.

`reflect.reflect` is all that others need; `words` is the walk over instructions that `confirm` uses too.
"""
