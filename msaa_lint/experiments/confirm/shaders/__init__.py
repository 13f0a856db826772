"""Shaders: GLSL, and the SPIR-V made from it by `python -m msaa_lint.experiments.confirm.shaders.generate`."""
