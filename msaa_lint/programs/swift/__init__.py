"""Metal descriptors in Swift."""
