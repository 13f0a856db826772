"""Metal's words: its enumerants, pixel formats and GPU families, and what Vulkan has of the same meaning."""
