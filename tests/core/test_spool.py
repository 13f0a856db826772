"""Sequences, mappings, and sorted groups that leave memory, against those of Python."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core import spool as spools
from msaa_lint.core.spool import Spool, SpooledDict, SpooledList, SpooledSort, SpoolError

NAMES = st.text(max_size=3) | st.sampled_from(["a\udcff", "\ud800", ""])


@pytest.fixture(autouse=True, scope="module")
def small() -> Iterator[None]:
    """Three values stay in memory."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(spools, "MAX_VALUES", 3)
        patch.setattr(spools, "MAX_UNWRITTEN", 1)
        patch.setattr(spools, "MAX_READ", 2)
        yield


@given(st.lists(st.integers() | NAMES))
def test_a_list(values: list[object]) -> None:
    spooled = SpooledList(Spool(), values)
    assert (list(spooled), len(spooled), bool(spooled)) == (values, len(values), bool(values))
    assert [spooled[number] for number in range(-len(values), len(values))] == values * 2
    assert list(spooled[1:-1]) == values[1:-1] and list(spooled[::-2]) == values[::-2]
    assert (
        isinstance(spooled.finished(), list) == (len(values) < 3)
        and list(spooled.finished()) == values
    )
    with pytest.raises(IndexError):
        spooled[len(values)]


@given(st.lists(st.tuples(NAMES, st.integers() | st.none())))
def test_a_mapping(pairs: list[tuple[str, object]]) -> None:
    spooled: SpooledDict[object] = SpooledDict(Spool())
    expected: dict[str, object] = {}
    for name, value in pairs:
        if value is None and name in expected:
            assert spooled.pop(name) == expected.pop(name)
        else:
            spooled.update({name: value})
            expected[name] = value
        assert spooled.get(name, "none") == expected.get(name, "none")
    assert (list(spooled.items()), len(spooled)) == (list(expected.items()), len(expected))
    assert list(spooled.finished().items()) == list(expected.items())
    with pytest.raises(KeyError):
        spooled["missing"]


@given(st.lists(st.tuples(st.integers(-2, 2), st.floats(allow_nan=False), NAMES)))
def test_groups_in_the_order_of_keys(rows: list[tuple[int, float, str]]) -> None:
    spooled: SpooledSort[int] = SpooledSort(Spool(), 3)
    keys = [(number, price, name.encode("utf-8", "surrogatepass")) for number, price, name in rows]
    for at, key in enumerate(keys):
        spooled.add(key, [at])
    expected = [(keys[at], [at]) for at in sorted(range(len(keys)), key=keys.__getitem__)]
    assert list(spooled) == expected
    assert list(spooled) == expected


def test_without_sqlite_all_stay_in_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sqlite3", None)
    assert SpooledList(Spool(), range(10)).finished() == list(range(10))


def test_a_full_disk_is_one_error() -> None:
    spool = Spool()
    assert spool.database is not None
    spool.database.execute("pragma max_page_count = 3")
    values: SpooledList[Any] = SpooledList(spool)
    with pytest.raises(
        SpoolError,
        match=r"^cannot keep results in a temporary file: .*full; set TMPDIR to a folder with more "
        r"room$",
    ):
        values.extend(bytes(5000) for _ in range(10))


def test_a_spool_has_no_name(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("SQLITE_TMPDIR", str(tmp_path))
    spooled = SpooledList(Spool(), (bytes(100_000) for _ in range(100)))
    assert len(spooled) == 100 and not list(tmp_path.iterdir())
