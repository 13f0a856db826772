"""Shaders: GLSL, and the SPIR-V made from it by `python -m
tests.experiments.confirm.generate_shaders`.
"""
