"""Vulkan structures in C and C++."""
