"""Allowances: how much may be spent on what takes more time than its input is long."""

from __future__ import annotations

import math


class Allowance:
    """What is left of a number of steps, characters or entries. The default has no end."""

    __slots__ = ("exhausted", "left")

    def __init__(self, amount: float = math.inf) -> None:
        self.left = amount
        self.exhausted = False
        """Whether something was asked for that was more than was left."""

    def take(self, amount: float = 1) -> bool:
        """Takes an amount if that much is left; whether it was."""
        if amount > self.left:
            self.exhausted = True
            return False
        self.left -= amount
        return True
