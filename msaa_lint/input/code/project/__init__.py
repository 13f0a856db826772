"""Source files that are read together: which of them form a program, and what they define for each
other.
"""
