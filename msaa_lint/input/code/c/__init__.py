"""Structures of Vulkan's in C and C++."""
