"""SPIR-V: what a shader does with multisampling. The analysis is bounded and safe for untrusted bytes.

`reflect.reflect` is all that others need; `words` is the walk over instructions that `confirm` uses too.
"""
