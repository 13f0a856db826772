"""What the inputs of one run share of what strangers' rules and shaders may take."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from .rules.budget import Budget

if TYPE_CHECKING:
    from msaa_lint.input.shader_modules import ShaderAnalyses


class RunLimits:
    """The budget of custom rules, and the analyses of shader modules with theirs."""

    def __init__(self) -> None:
        self.rules = Budget()

    @cached_property
    def shaders(self) -> ShaderAnalyses:
        """Created with the first shader that a rule asks for."""
        from msaa_lint.input.shader_modules import ShaderAnalyses

        return ShaderAnalyses()
