"""SPIR-V: what a shader does with multisampling, and what it takes from outside. The analysis is
bounded and safe for untrusted bytes.

`reflect.reflect` tells the former, `interface.interface` the latter; `words` is the walk over
instructions that `confirm` uses too.
"""
