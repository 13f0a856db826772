"""Multisampling in GLSL shaders."""
