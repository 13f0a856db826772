"""How many examples a property test tries: few for a person who waits, many in CI."""

from __future__ import annotations

import os
from typing import Any

from hypothesis import settings

settings.register_profile("quick", deadline=None, max_examples=20)
settings.register_profile("thorough", deadline=None, max_examples=60)


def load_profile() -> None:
    """Selects `thorough` in CI and `quick` elsewhere; pytest's `--hypothesis-profile` overrides
    it.
    """
    settings.load_profile("thorough" if os.environ.get("CI") else "quick")


def examples(factor: float = 1, **options: Any) -> settings:
    """Settings of a test that tries `factor` times as many examples as the profile states."""
    return settings(max_examples=max(1, round(factor * settings.default.max_examples)), **options)
