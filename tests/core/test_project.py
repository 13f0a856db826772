from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.project import MAX_LINKS, resolved
from tests.strength import examples

NAMES = st.sampled_from(["a", "b", "c", "d", ".", "..", ""])
PATHS = st.lists(NAMES, min_size=1, max_size=5).map("/".join)


@given(
    links=st.dictionaries(st.sampled_from(["a/c", "b/d", "c", "d", "a/b/c"]), PATHS, max_size=4),
    path=PATHS,
)
@examples()
def test_links_are_resolved_as_python_does(
    links: dict[str, str], path: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    root = tmp_path_factory.mktemp("tree")
    (root / "a/b").mkdir(parents=True)
    (root / "b").mkdir()
    for name, target in links.items():
        (root / name).symlink_to(target or ".")
    given = f"{root}/{path.lstrip('/')}"
    try:
        expected = os.path.realpath(given, strict=True)
    except OSError:
        return
    assert resolved(given) == expected


def test_the_number_of_links_is_limited(tmp_path: Path) -> None:
    (tmp_path / "l0").mkdir()
    for number in range(MAX_LINKS + 1):
        (tmp_path / f"l{number + 1}").symlink_to(f"l{number}")
    assert resolved(f"{tmp_path}/l{MAX_LINKS}/x") == f"{tmp_path.resolve()}/l0/x"
    for path in (f"l{MAX_LINKS + 1}", f"l{MAX_LINKS}/../l1"):
        with pytest.raises(OSError, match="Too many levels of symbolic links"):
            resolved(f"{tmp_path}/{path}")
