"""What strangers' rules and shaders may take: rules in a run, shaders in each of its inputs."""

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

    def begin_input(self) -> None:
        """Begins the budget of the shaders of another input."""
        if "shaders" in self.__dict__:
            self.shaders.begin_input()

    @cached_property
    def shaders(self) -> ShaderAnalyses:
        """Created with the first shader that a rule asks for."""
        from msaa_lint.input.shader_modules import ShaderAnalyses

        return ShaderAnalyses()
