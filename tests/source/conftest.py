"""Every test that asks for `stack` runs on libyaml and on PyYAML's own parser."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import pytest

STACKS = ("libyaml", "pure")


@contextmanager
def without_libyaml() -> Iterator[None]:
    """What a PyYAML that was built without libyaml is like."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(sys.modules, "yaml._yaml", None)
        yield


@pytest.fixture(params=STACKS)
def stack(request: pytest.FixtureRequest) -> Iterator[str]:
    if request.param == "pure":
        with without_libyaml():
            yield request.param
    else:
        pytest.importorskip("yaml._yaml", reason="this PyYAML was built without libyaml")
        yield request.param
