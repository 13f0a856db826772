"""Vulkan in source code: what its names, structures, and calls mean, and descriptions of what a
program creates.
"""
