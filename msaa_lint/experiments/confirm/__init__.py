"""A described frame tried on a Vulkan device: created, drawn, compared with its fixed version, timed. Drivers run in a child process."""
