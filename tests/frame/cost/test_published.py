"""The published counters of a Mali-G76, predicted."""

from __future__ import annotations

import pytest

from msaa_lint.frame.devices import builtin
from tests.frame.cost.published import (
    CONFIGURATIONS,
    FITTED_ON,
    MB_PER_MIB,
    Prediction,
    fitted,
    predictions,
)


@pytest.mark.parametrize(
    "found", predictions(), ids=lambda found: f"{found.name}-{found.direction}"
)
def test_counters_are_within_ten_percent(found: Prediction) -> None:
    assert abs(found.error) < 10


PREDICTED = [found for found in predictions() if found.name not in FITTED_ON]


@pytest.mark.parametrize("found", PREDICTED, ids=lambda found: f"{found.name}-{found.direction}")
def test_what_was_not_fitted_is_within_six_percent(found: Prediction) -> None:
    """Where four samples are stored and loaded: nothing of the model was fitted to these
    counters.
    """
    assert abs(found.error) < 6


def test_the_profile_holds_the_fitted_constants() -> None:
    profile = builtin("mali-g76")
    assert profile is not None
    assert profile.compression is not None
    assert profile.compression[1] == (
        round(fitted("read").ratio, 3),
        round(fitted("write").ratio, 3),
    )
    assert set(profile.compression.values()) - {profile.compression[1]} == {(1.0, 1.0)}


def test_the_fit_has_fewer_constants_than_points() -> None:
    """Four constants, eight points fitted to, four more predicted: a wrong constant shows."""
    assert fitted("read").base == pytest.approx(620.3, abs=0.05)
    assert fitted("write").base == pytest.approx(175.6, abs=0.05)
    assert len(FITTED_ON) * 2 == 8
    assert len(predictions()) == 12


def test_without_compression_single_sampled_frames_are_far_off() -> None:
    """What the correction is for: plain arithmetic alone says twice the traffic of images that the
    counters leave for them.
    """
    written = CONFIGURATIONS["D"].cost().total.write_mb_per_s / MB_PER_MIB
    assert written / (CONFIGURATIONS["D"].write - fitted("write").base) > 2


def test_a_separate_resolve_costs_what_the_counters_say() -> None:
    """C less B: 2169.8 MiB/s of reads, 2282.0 of writes."""
    separate, inline = CONFIGURATIONS["C"].cost().corrected, CONFIGURATIONS["B"].cost().corrected
    assert separate is not None
    assert inline is not None
    read = (separate.read_mb_per_s - inline.read_mb_per_s) / MB_PER_MIB
    written = (separate.write_mb_per_s - inline.write_mb_per_s) / MB_PER_MIB
    assert read == pytest.approx(2169.8, rel=0.02)
    assert written == pytest.approx(2282.0, rel=0.07)
