"""Reports as one HTML file: `page` has what all share, and each command has a module."""
