"""Every test that asks for `stack` runs on libyaml and on PyYAML's own parser."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.core.text.reading import without_libyaml


@pytest.fixture(params=["libyaml", "pure"])
def stack(request: pytest.FixtureRequest) -> Iterator[str]:
    if request.param == "pure":
        with without_libyaml():
            yield request.param
    else:
        pytest.importorskip("yaml._yaml", reason="this PyYAML was built without libyaml")
        yield request.param
