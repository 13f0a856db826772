"""Metal: its enumerants, pixel formats and GPU families, and their Vulkan counterparts."""
