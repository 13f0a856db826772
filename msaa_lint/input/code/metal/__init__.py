"""What Metal's descriptors and calls mean, in Swift, Objective-C, and metal-cpp."""
