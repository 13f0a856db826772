"""The shares of devices: what they say, and that they are those of the table they were counted
in.
"""

from __future__ import annotations

import os

import pytest

from msaa_lint.frame.devices import shares_table
from msaa_lint.frame.devices.shares import (
    ATTRIBUTION,
    DEPTH_RESOLVE_ALL,
    DEPTH_RESOLVE_TILERS,
    lazily_allocated_share,
    per_cent,
    resolve_mode_share,
    sample_count_share,
)
from tests.frame.devices import generate_shares
from tests.paths import SAMPLES

TABLE = """\
vendorID,framebufferColorSampleCounts,framebufferIntegerColorSampleCounts,has_LAZILY_ALLOCATED
0x13b5,13,1,1
0x13b5,5,,0
0x10de,15,15,0
0x1414,7,1,0
"""


@pytest.mark.parametrize(
    ("count", "tilers", "share"),
    [
        *(
            (1, False, 99),
            (2, False, 85),
            (4, False, 99),
            (8, False, 80),
            (16, False, 8),
            (32, False, 1),
            (64, False, 0),
            (3, False, 0),
        ),
        *(
            (1, True, 100),
            (2, True, 74),
            (4, True, 100),
            (8, True, 18),
            (16, True, 8),
            (32, True, 0),
            (64, True, 0),
        ),
    ],
)
def test_sample_count_share(count: int, tilers: bool, share: int) -> None:
    assert sample_count_share(count, tilers) == share


@pytest.mark.parametrize(
    ("mode", "tilers", "share"),
    [
        *(
            ("SAMPLE_ZERO", False, 99),
            ("MIN", False, 81),
            ("MAX", False, 81),
            ("AVERAGE", False, 70),
            ("CUSTOM_EXT", False, None),
        ),
        *(
            ("SAMPLE_ZERO", True, 100),
            ("MIN", True, 38),
            ("MAX", True, 38),
            ("AVERAGE", True, 14),
            ("NONE", True, None),
        ),
    ],
)
def test_resolve_mode_share(mode: str, tilers: bool, share: int | None) -> None:
    assert resolve_mode_share(mode, tilers) == share


@pytest.mark.parametrize(
    ("vendor", "share"),
    [("arm", 91), ("apple", 100), ("qualcomm", 49), ("img", 31), ("nvidia", 0), ("khronos", None)],
)
def test_lazily_allocated_share(vendor: str, share: int | None) -> None:
    assert lazily_allocated_share(vendor) == share


@pytest.mark.parametrize(
    ("part", "whole", "share"),
    [(0, 10, 0), (10, 10, 100), (1, 1000, 1), (999, 1000, 99), (1, 3, 33), (0, 0, 0)],
)
def test_per_cent_keeps_none_and_all_apart(part: int, whole: int, share: int) -> None:
    assert per_cent(part, whole) == share


def test_counts() -> None:
    assert (shares_table.ALL, shares_table.TILERS) == (2035, 191)
    assert shares_table.INTEGER_SINGLE_SAMPLED == (487, 1423)
    assert sum(devices for _, devices in shares_table.LAZILY_ALLOCATED.values()) <= shares_table.ALL
    for devices, having in (DEPTH_RESOLVE_ALL, DEPTH_RESOLVE_TILERS):
        assert all(count <= devices for count in having.values())
    assert "CC BY 4.0" in ATTRIBUTION


def test_the_table_is_the_one_that_was_counted() -> None:
    path = os.path.join(SAMPLES, "devices", "gpuinfo_devices_msaa_summary.csv")
    if not os.path.exists(path):
        pytest.skip(
            "the table of devices is not at hand: MSAA_LINT_SAMPLES names the folder of samples"
        )
    assert generate_shares.main([path, "--check"]) == 0


def test_counting(tmp_path: object) -> None:
    path = os.path.join(str(tmp_path), "table.csv")
    with open(path, "w", encoding="utf-8") as file:
        file.write(TABLE)
    made: dict[str, object] = {}
    exec(compile(generate_shares.source(path), "made", "exec"), made)
    assert (made["ALL"], made["TILERS"]) == (4, 2)
    assert made["SAMPLES_ALL"] == {1: 4, 2: 2, 4: 4, 8: 2, 16: 0, 32: 0, 64: 0}
    assert made["SAMPLES_TILERS"] == {1: 2, 2: 0, 4: 2, 8: 1, 16: 0, 32: 0, 64: 0}
    assert made["LAZILY_ALLOCATED"] == {"arm": (1, 2), "nvidia": (0, 1)}
    assert made["INTEGER_SINGLE_SAMPLED"] == (2, 3)


def test_another_table_is_told_and_written(
    tmp_path: object, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path, target = (os.path.join(str(tmp_path), name) for name in ("table.csv", "shares_table.py"))
    with open(path, "w", encoding="utf-8") as file:
        file.write(TABLE)
    assert generate_shares.main([path, "--check"]) == 1
    assert "is stale" in capsys.readouterr().err
    monkeypatch.setattr(generate_shares, "TARGET", target)
    assert generate_shares.main([path]) == 0
    assert generate_shares.main([path, "--check"]) == 0
    assert generate_shares.main([]) == 2
