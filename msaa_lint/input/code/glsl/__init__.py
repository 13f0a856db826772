"""What shaders in GLSL say of multisampling."""
