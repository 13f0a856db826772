"""Syntax of Objective-C and Objective-C++."""
