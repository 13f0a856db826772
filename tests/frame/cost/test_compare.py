"""Two frames side by side: exact differences, and the laws that every comparison keeps."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.frame.cost.amounts import Amount, FrameCost, Line, PassCost
from msaa_lint.frame.cost.compare import ADDED, CHANGED, NOTHING, REMOVED, SAME, Change, compare
from msaa_lint.frame.cost.input_cost import CostedFrame, compare_inputs
from tests.frame.cost.frames import example

FOUR = 2247.7824
"""MB/s: 2168 * 1080 * 4 B * 4 samples * 60 Hz."""


def a_pass(
    name: str,
    amount: Amount,
    corrected: Amount | None = None,
    kind: str = "renderPass",
    images: tuple[str, ...] = (),
) -> PassCost:
    lines = tuple(Line(image, image, "color", 1, "copy", "read", 1, None, None) for image in images)
    return PassCost(name, name, kind, 1, 1, 1, lines, amount, corrected, None, None, ())


def a_frame(*passes: PassCost, fps: float = 60, device: str | None = None) -> FrameCost:
    total = Amount(
        *(sum(column) for column in zip(NOTHING, *(each.amount for each in passes), strict=True))
    )
    return FrameCost(passes, (), total, None, fps, device, (), ())


ONE, TWO = Amount(1, 2, 3, 4), Amount(10, 20, 30, 40)


def test_what_a_resolve_by_command_and_a_stored_depth_add() -> None:
    found = compare(
        example("khronos-msaa/inline.msaa.yaml"), example("khronos-msaa/depth-unresolved.msaa.yaml")
    )
    one = FOUR / 4
    assert [(each.name, each.status) for each in found.passes] == [
        ("scene", CHANGED), ("resolveImage color_ms, color", ADDED), ("post", CHANGED),
    ]  # fmt: skip
    assert found.passes[0].difference.write_mb_per_s == pytest.approx(2 * FOUR - 2 * one)
    assert found.total.difference.read_mb_per_s == pytest.approx(FOUR)
    assert found.total.difference.write_mb_per_s == pytest.approx(2 * FOUR - one)
    assert found.total.difference.milliwatts == pytest.approx((3 * FOUR - one) / 10)
    assert found.total.per_cent == pytest.approx(220)
    assert found.total.corrected is None, "a range has no difference"


def test_passes_are_matched_by_name() -> None:
    old = a_frame(a_pass("a", ONE), a_pass("gone", TWO), a_pass("b", ONE))
    new = a_frame(a_pass("b", TWO), a_pass("a", ONE), a_pass("new", ONE))
    assert [(each.name, each.status, each.difference) for each in compare(old, new).passes] == [
        ("b", CHANGED, Amount(9, 18, 27, 36)),
        ("a", SAME, NOTHING),
        ("gone", REMOVED, Amount(-10, -20, -30, -40)),
        ("new", ADDED, ONE),
    ]


def test_commands_are_matched_by_their_images() -> None:
    copies = [
        a_pass("copyImage", ONE, kind="command", images=(image, "out")) for image in ("a", "b", "b")
    ]
    found = compare(a_frame(*copies), a_frame(*copies[1:]))
    assert [(each.name, each.status) for each in found.passes] == [
        ("copyImage a, out", REMOVED), ("copyImage b, out", SAME), ("copyImage b, out", SAME),
    ]  # fmt: skip


def test_a_corrected_difference_needs_both_sides() -> None:
    with_it, without = a_frame(a_pass("a", ONE, TWO)), a_frame(a_pass("a", ONE))
    assert compare(with_it, with_it).passes[0].corrected == NOTHING
    assert compare(with_it, without).passes[0].corrected is None
    assert compare(a_frame(), with_it).passes[0].corrected == TWO


def test_other_rates_and_devices_are_said() -> None:
    remarks = compare(a_frame(), a_frame(fps=30, device="Mali-G76")).remarks
    assert remarks == (
        "the old frame is shown 60 times a second, the new one 30",
        "the old frame is for no device, the new one for Mali-G76",
    )
    assert compare(a_frame(), a_frame()).remarks == ()


def test_per_cent_of_nothing_is_none() -> None:
    assert compare(a_frame(), a_frame(a_pass("a", ONE))).total.per_cent is None


def test_documents_are_matched_by_their_number() -> None:
    costs = [a_frame(a_pass("a", ONE)), a_frame(a_pass("a", TWO))]
    old = [CostedFrame("old", 0, 1, costs[0])]
    new = [CostedFrame("new", number, 2, cost) for number, cost in enumerate(costs)]
    assert [each.total.status for each in compare_inputs("old", old, "new", new).frames] == [
        SAME,
        ADDED,
    ]
    assert [each.total.status for each in compare_inputs("new", new, "old", old).frames] == [
        SAME,
        REMOVED,
    ]


figures = st.floats(0, 1e12)
amounts = st.builds(Amount, figures, figures, figures, figures)
passes = st.builds(
    a_pass,
    st.sampled_from("abcd"),
    amounts,
    st.one_of(st.none(), amounts),
    st.sampled_from(["renderPass", "rendering", "command"]),
)
frames = st.lists(passes, max_size=6).map(lambda made: a_frame(*made))


@given(frames)
def test_a_frame_costs_no_more_than_itself(frame: FrameCost) -> None:
    found = compare(frame, frame)
    assert {each.status for each in found.passes} <= {SAME}
    assert found.total.status == SAME
    assert found.total.difference == NOTHING
    assert all(each.difference == NOTHING for each in found.passes)


@given(frames, frames)
def test_the_way_back_costs_the_opposite(old: FrameCost, new: FrameCost) -> None:
    there, back = compare(old, new), compare(new, old)
    opposite = {SAME: SAME, CHANGED: CHANGED, ADDED: REMOVED, REMOVED: ADDED}

    def turned(each: Change) -> tuple[str, str, str, tuple[float, ...], tuple[float, ...] | None]:
        negative = tuple(-value for value in each.difference)
        corrected = None if each.corrected is None else tuple(-value for value in each.corrected)
        return each.name, each.kind, opposite[each.status], negative, corrected

    def as_is(each: Change) -> tuple[str, str, str, tuple[float, ...], tuple[float, ...] | None]:
        return (
            each.name,
            each.kind,
            each.status,
            tuple(each.difference),
            None if each.corrected is None else tuple(each.corrected),
        )

    assert sorted(map(turned, there.passes), key=repr_without_sign) == sorted(
        map(as_is, back.passes), key=repr_without_sign
    )
    assert turned(there.total) == as_is(back.total)


def repr_without_sign(found: object) -> str:
    return repr(found).replace("-0.0", "0.0")


@given(frames, frames)
def test_every_pass_of_both_is_there_once(old: FrameCost, new: FrameCost) -> None:
    found = compare(old, new).passes
    assert sum(each.old is not None for each in found) == len(old.passes)
    assert sum(each.new is not None for each in found) == len(new.passes)
    assert [each.new for each in found if each.new is not None] == [
        each.amount for each in new.passes
    ]
