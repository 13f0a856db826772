"""Confirms a described frame on a Vulkan device: creates and renders it, compares it with its fixed
version, and times both. Drivers run in a child process.
"""
