"""Effects: each by itself, with the values that are due; what is off is neither called nor
allocated.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from msaa_lint.experiments.study import effects, locations, resolve, scenes, shade, simulate
from msaa_lint.experiments.study.drawing import Band, Batch, Drawing
from msaa_lint.experiments.study.effects import (
    BAYER,
    alpha_coverage,
    alpha_test,
    alpha_to_coverage,
    blend,
)
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scenes import shapes
from msaa_lint.experiments.study.scenes.scene import BLACK, RGBA, WHITE, Scene

SIZE = 8
FOUR = Technique(MSAA, 4)


def layers(
    *polygons: tuple[list[shapes.Point], RGBA, float],
    names: tuple[str, ...] = (),
    behind: RGBA = BLACK,
    **given: object,
) -> Scene:
    """Polygons of a colour and a depth each, in their order."""
    made = [shapes.triangles([polygon]) for polygon, _, _ in polygons]
    colors = np.concatenate(
        [
            shapes.uniform_colors(len(own), color)
            for own, (_, color, _) in zip(made, polygons, strict=True)
        ]
    )
    depths = np.concatenate(
        [np.full((len(own), 3), depth) for own, (_, _, depth) in zip(made, polygons, strict=True)]
    )
    scene = Scene(
        SIZE,
        SIZE,
        np.concatenate(made),
        colors,
        lambda each: np.zeros((SIZE, SIZE, 4)),
        depths=depths,
    )
    return scene._replace(name="layers", effects=names, background=behind, **given)  # type: ignore[arg-type]


ALL = shapes.rectangle(0, 0, SIZE, SIZE)
LEFT = shapes.rectangle(0, 0, 4, SIZE)
RED, GREEN = (1.0, 0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)


def batch(alpha: list[list[float]], samples: int = 4) -> Batch:
    """Fragments of one row, covered whole, with an alpha for each group of samples."""
    count = len(alpha)
    numbers = np.arange(count, dtype=np.int32)
    made = Batch(
        np.zeros(count, np.int32),
        numbers.astype(np.intp),
        numbers,
        np.zeros(count, np.int32),
        np.full(count, (1 << samples) - 1, np.uint16),
    )
    made.color = np.zeros((count, len(alpha[0]), 4), np.float32)
    made.color[..., 3] = alpha
    return made


def drawing(samples: int = 4, invocations: int = 1, **settings: object) -> Drawing:
    named = {name.replace("_", "-"): value for name, value in settings.items()}
    return Drawing(
        samples, locations.standard(samples) / 256, shade.groups(samples, invocations), named, None
    )


NO_BAND = Band(np.zeros((0, 0, 4), np.float32), None, None, None)


@pytest.mark.parametrize("name", scenes.NAMES)
def test_what_a_scene_does_not_call_for_is_not_called(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def unwanted(*given: object) -> None:
        raise AssertionError("an effect ran that is off")

    made = scenes.scene(name, 48, 48)
    wanted = simulate.simulate(made, FOUR).image
    off = [
        each._replace(fragment=unwanted, blend=unwanted, store=unwanted)
        for each in effects.TABLE
        if each.name not in made.effects
    ]
    kept = {each.name: each for each in effects.TABLE if each.name in made.effects} | {
        each.name: each for each in off
    }
    monkeypatch.setattr(effects, "TABLE", tuple(kept[each.name] for each in effects.TABLE))
    for name, function in (
        ("tone-mapping", "tone_map"),
        ("srgb", "encode"),
        ("depth-resolve", "resolve_depth"),
    ):
        if name not in made.effects:
            monkeypatch.setattr(resolve, function, unwanted)
    assert np.array_equal(simulate.simulate(made, FOUR).image, wanted)


@pytest.mark.parametrize("name", scenes.NAMES)
def test_what_a_scene_does_not_call_for_is_not_allocated(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: list[Band] = []
    made = scenes.scene(name, 48, 48)
    inner = simulate.Simulator.band

    def band(simulator: simulate.Simulator, pixels: int) -> Band:
        seen.append(inner(simulator, pixels))
        return seen[-1]

    monkeypatch.setattr(simulate.Simulator, "band", band)
    found = simulate.simulate(made, FOUR)
    assert found.effects == tuple(each.name for each in effects.ordered(made.effects))
    for each in seen:
        assert (each.depth is not None) == ("depth-test" in made.effects)
        assert (each.stencil is not None) == ("stencil" in made.effects)
        assert (each.written is not None) == made.coverage_matter
    assert (found.depth is not None) == ("depth-resolve" in made.effects)
    assert (found.coverage is not None) == made.coverage_matter


def test_every_effect_is_called_for_by_a_scene_or_a_description() -> None:
    called = {name for each in scenes.NAMES for name in scenes.scene(each, 48, 48).effects}
    assert set(effects.BY_NAME) - called == {"sample-mask", "sample-shading", "srgb"}


def test_effects_come_in_in_one_order_whatever_the_order_of_their_names() -> None:
    names = tuple(each.name for each in effects.TABLE)
    assert tuple(each.name for each in effects.ordered(names[::-1])) == names
    with pytest.raises(LookupError, match="unknown effect `bloom`; the effects are sample-mask, "):
        effects.ordered(("stencil", "bloom"))


def test_a_sample_is_stored_in_one_format() -> None:
    with pytest.raises(ValueError, match="hdr and srgb exclude each other"):
        simulate.simulate(layers((ALL, WHITE, 0), names=("srgb", "hdr")), FOUR)


def test_sample_shading_runs_where_there_is_something_to_shade() -> None:
    each = Technique(SAMPLE_SHADING, 4, 1.0)
    assert simulate.simulate(scenes.scene("edge-fan", 48, 48), each).effects == ()
    assert simulate.simulate(scenes.scene("zone-plate", 48, 48), each).effects == (
        "sample-shading",
    )
    assert simulate.simulate(scenes.scene("zone-plate", 48, 48), FOUR).effects == ()


@pytest.mark.parametrize(
    ("invocations", "places"), [(1, [(0.5, 0.5)]), (2, [(0.625, 0.25), (0.375, 0.75)]), (4, None)]
)
def test_invocations_are_evaluated_in_the_middle_of_their_samples(
    invocations: int, places: list[tuple[float, float]] | None
) -> None:
    standard = locations.standard(4) / 256
    found = shade.positions(standard, shade.groups(4, invocations))
    assert found.tolist() == [list(each) for each in places or standard]


def test_each_group_of_samples_has_its_own_colour() -> None:
    seen: list[tuple[float, float]] = []

    def shaded(
        triangle: NDArray[np.int32], x: NDArray[np.float64], y: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        seen.append((float(x[0]) % 1, float(y[0]) % 1))
        return np.repeat(np.full((len(x), 1), float(len(seen))), 4, axis=1)

    made = layers((shapes.rectangle(0, 0, SIZE, SIZE), WHITE, 0))._replace(
        triangles=np.array([[[0, 0], [16, 0], [0, 16.0]]]), shade=shaded
    )
    image = simulate.simulate(
        made._replace(colors=np.ones((1, 4))), Technique(SAMPLE_SHADING, 4, 0.5)
    ).image
    assert seen == [(0.625, 0.25), (0.375, 0.75)]
    assert (image == 1.5).all()


@pytest.mark.parametrize(
    ("mask", "share"), [(0b0101, 0.5), (0b0001, 0.25), (0, 0.0), (0xFFFFFFFF, 1.0)]
)
def test_a_sample_mask_leaves_samples_out(mask: int, share: float) -> None:
    made = layers((ALL, WHITE, 0), names=("sample-mask",), settings={"sample-mask": mask})
    found = simulate.simulate(made, FOUR)
    assert found.coverage is not None
    assert (found.coverage == share).all() and (found.image == share).all()


def test_the_sample_mask_is_by_the_number_of_the_sample() -> None:
    """An edge at x 0.5 of a pixel has samples 0 and 2 of 4 at its left."""
    made = layers((shapes.rectangle(0, 0, 0.5, SIZE), WHITE, 0), names=("sample-mask",))
    for mask, share in ((0b0101, 0.5), (0b1010, 0.0), (0b0100, 0.25)):
        coverage = simulate.simulate(made._replace(settings={"sample-mask": mask}), FOUR).coverage
        assert coverage is not None and (coverage[:, 0] == share).all()


def test_the_alpha_test_discards_what_is_below_a_half() -> None:
    half = np.float32(0.5)
    given = batch([[0.0], [float(np.nextafter(half, np.float32(0)))], [0.5], [1.0], [float("nan")]])
    alpha_test(given, NO_BAND, drawing())
    assert given.mask.tolist() == [0, 0, 15, 15, 15]


def test_the_alpha_test_discards_an_invocation_with_its_samples() -> None:
    given = batch([[0.2, 0.9], [0.9, 0.2], [0.1, 0.1]])
    alpha_test(given, NO_BAND, drawing(invocations=2))
    assert given.mask.tolist() == [0b1100, 0b0011, 0]


@given(st.floats(0, 1, width=32), st.sampled_from([1, 2, 4, 8, 16]))
def test_ceil_covers_the_least_count_that_is_no_less_than_alpha(alpha: float, samples: int) -> None:
    given = batch([[alpha]], samples)
    alpha_to_coverage(given, NO_BAND, drawing(samples, alpha_to_coverage="ceil"))
    count = int(given.mask[0]).bit_count()
    assert count - 1 < Fraction(alpha) * samples <= count or count == alpha == 0


@given(st.floats(0, 1, width=32), st.sampled_from([1, 2, 4, 8, 16]))
def test_dithering_covers_alpha_on_average_over_a_block(alpha: float, samples: int) -> None:
    bits = alpha_coverage(np.full((4, 4), alpha, np.float32), BAYER, samples)
    mean = Fraction(int(np.bitwise_count(bits).sum()), 16 * samples)
    assert abs(mean - Fraction(alpha)) <= Fraction(1, 32 * samples) + Fraction(1, 10**6)


@pytest.mark.parametrize("model", ["dithered", "ceil"])
def test_no_alpha_covers_nothing_and_full_alpha_everything(model: str) -> None:
    given = batch([[0.0], [-1.0], [float("nan")], [1.0], [7.0], [float("inf")]])
    alpha_to_coverage(given, NO_BAND, drawing(alpha_to_coverage=model))
    assert given.mask.tolist() == [0, 0, 0, 15, 15, 15]


def test_alpha_to_coverage_only_takes_away() -> None:
    given = batch([[1.0], [0.5]])
    given.mask = np.array([0b0110, 0b1001], np.uint16)
    alpha_to_coverage(given, NO_BAND, drawing(alpha_to_coverage="ceil"))
    assert given.mask.tolist() == [0b0110, 0b0001]


def test_stencil_draws_where_it_is_marked_and_marks_nothing_visible() -> None:
    made = layers(
        (LEFT, RED, 0), (ALL, GREEN, 0), names=("stencil",), settings={"stencil": (0, 2, 4)}
    )
    found = simulate.simulate(made, FOUR)
    assert (found.image[:, :4] == GREEN).all() and not found.image[:, 4:].any()
    assert found.coverage is not None and found.coverage.sum() == 32


def test_stencil_leaves_other_triangles_alone() -> None:
    right = shapes.rectangle(6, 0, SIZE, SIZE)
    made = layers(
        (right, WHITE, 0),
        (LEFT, RED, 0),
        (ALL, GREEN, 0),
        (right, RED, 0),
        names=("stencil",),
        settings={"stencil": (2, 4, 6)},
    )
    image = simulate.simulate(made, FOUR).image
    assert (image[:, :4] == GREEN).all() and not image[:, 4:6].any() and (image[:, 6:] == RED).all()


def test_without_depth_the_last_one_stays() -> None:
    made = layers((ALL, RED, 0.1), (LEFT, GREEN, 0.9))
    image = simulate.simulate(made, FOUR).image
    assert (image[:, :4] == GREEN).all() and (image[:, 4:] == RED).all()


@pytest.mark.parametrize("technique", [FOUR, Technique(MSAA, 1), Technique(SSAA, 9, grid=3)])
@pytest.mark.parametrize(
    ("comparison", "first", "second", "left"),
    [
        ("LESS", 0.2, 0.7, RED), ("LESS", 0.7, 0.2, GREEN), ("LESS", 0.5, 0.5, RED),
        ("LESS_OR_EQUAL", 0.5, 0.5, GREEN),
        ("GREATER", 0.2, 0.7, GREEN), ("GREATER", 0.7, 0.2, RED), ("GREATER", 0.5, 0.5, RED),
        ("GREATER_OR_EQUAL", 0.5, 0.5, GREEN),
    ],
)  # fmt: skip
def test_depth_decides(
    technique: Technique, comparison: str, first: float, second: float, left: RGBA
) -> None:
    made = layers(
        (ALL, RED, first),
        (LEFT, GREEN, second),
        names=("depth-test",),
        settings={"depth-test": comparison},
    )
    image = simulate.simulate(made, technique).image
    assert (image[:, :4] == left).all() and (image[:, 4:] == RED).all()


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_where_surfaces_cross_each_sample_decides(order: tuple[int, int]) -> None:
    """Surfaces cross along x 2.5: of the 4 samples of that pixel two are on either side, whatever
    is drawn first.
    """
    slanted = np.array(
        [[0.5 + (x - 2.5) / 16 for x, _ in triangle] for triangle in shapes.triangles([ALL])]
    )
    depths = [np.full((2, 3), 0.5), slanted]
    made = layers(
        (ALL, (RED, GREEN)[order[0]], 0), (ALL, (RED, GREEN)[order[1]], 0), names=("depth-test",)
    )
    made = made._replace(
        depths=np.concatenate([depths[each] for each in order]), settings={"depth-test": "LESS"}
    )
    image = simulate.simulate(made, FOUR).image
    assert (
        (image[:, 2] == (0.5, 0.5, 0, 1)).all()
        and (image[:, :2] == GREEN).all()
        and (image[:, 3:] == RED).all()
    )


def test_depth_is_evaluated_at_the_sample_and_rounded_once() -> None:
    triangle = np.array([[[0.0, 0.0], [16.0, 0.0], [0.0, 16.0]]])
    made = layers(
        (ALL, WHITE, 0),
        names=("depth-test", "depth-resolve"),
        settings={"depth-test": "LESS", "depth-resolve": "SAMPLE_ZERO"},
    )
    made = made._replace(
        triangles=triangle, colors=np.ones((1, 4)), depths=np.array([[0.1, 0.9, 0.3]])
    )
    depth = simulate.simulate(made, FOUR).depth
    assert depth is not None
    # Sample 0 of 4 is at 6/16, 2/16.
    for x, y in ((0, 0), (3, 5), (7, 7)):
        due = (
            Fraction(1, 10)
            + Fraction(8, 10) * (x + Fraction(6, 16)) / 16
            + Fraction(2, 10) * (y + Fraction(2, 16)) / 16
        )
        assert depth[y, x] == np.float32(float(due))


@pytest.mark.parametrize(
    ("mode", "edge"), [("SAMPLE_ZERO", 0.25), ("AVERAGE", 0.5), ("MIN", 0.25), ("MAX", 0.75)]
)
def test_depth_at_a_silhouette_is_by_the_mode(mode: str, edge: float) -> None:
    half = shapes.rectangle(0, 0, 2.5, SIZE)
    made = layers((ALL, RED, 0.75), (half, GREEN, 0.25), names=("depth-test", "depth-resolve"))
    depth = simulate.simulate(
        made._replace(settings={"depth-test": "LESS", "depth-resolve": mode}), FOUR
    ).depth
    assert depth is not None and depth.dtype == np.float32
    assert (
        (depth[:, :2] == 0.25).all()
        and (depth[:, 2] == edge).all()
        and (depth[:, 3:] == 0.75).all()
    )


def test_supersampled_depth_is_resolved_over_its_pixels() -> None:
    half = shapes.rectangle(0, 0, 2.5, SIZE)
    made = layers((ALL, RED, 0.75), (half, GREEN, 0.25), names=("depth-test", "depth-resolve"))
    depth = simulate.simulate(
        made._replace(settings={"depth-resolve": "AVERAGE"}), Technique(SSAA, 4, grid=2)
    ).depth
    assert depth is not None and depth[0].tolist() == [
        0.25,
        0.25,
        0.5,
        0.75,
        0.75,
        0.75,
        0.75,
        0.75,
    ]


def test_layers_are_blended_in_their_order() -> None:
    glass = [
        (ALL, (1.0, 0.0, 0.5, 0.5), 0.0),
        (LEFT, (0.0, 1.0, 0.25, 0.25), 0.0),
        (ALL, (0.5, 0.5, 0.5, 0.75), 0.0),
    ]
    behind = (0.25, 0.5, 1.0, 1.0)
    image = simulate.simulate(layers(*glass, names=("blending",), behind=behind), FOUR).image
    for column, seen in ((0, glass), (7, [glass[0], glass[2]])):
        due = [Fraction(each) for each in behind]
        for _, color, _ in seen:
            alpha = Fraction(color[3])
            due = [
                Fraction(own) * alpha + old * (1 - alpha)
                for own, old in zip(color[:3], due, strict=False)
            ]
        assert image[3, column, :3].tolist() == [float(each) for each in due]
        assert image[3, column, 3] == 1


def test_blending_at_an_edge_is_sample_by_sample() -> None:
    half = shapes.rectangle(0, 0, 2.5, SIZE)
    image = simulate.simulate(
        layers((half, (1.0, 1.0, 1.0, 0.5), 0.0), names=("blending",)), FOUR
    ).image
    assert image[0, :4, 0].tolist() == [0.5, 0.5, 0.25, 0.0]


def test_opaque_and_clear_colours_blend_to_themselves_and_what_is_behind() -> None:
    source = np.array([[0.3, 0.6, 0.9, 1.0], [0.3, 0.6, 0.9, 0.0]], np.float32)
    behind = np.array([[0.1, 0.2, 0.7, 0.5]] * 2, np.float32)
    assert np.array_equal(blend(source, behind), np.stack([source[0], behind[1]]))


def test_srgb_samples_average_as_light_and_encoded_ones_as_codes() -> None:
    half = layers((shapes.rectangle(0, 0, 2.5, SIZE), WHITE, 0), names=("srgb",))
    light = simulate.simulate(half._replace(settings={"srgb": "linear-light"}), FOUR).image
    codes = simulate.simulate(half._replace(settings={"srgb": "encoded"}), FOUR).image
    assert light[0, 2, 0] == pytest.approx(((188 / 255 + 0.055) / 1.055) ** 2.4, rel=1e-6)
    assert codes[0, 2, 0] == pytest.approx(((128 / 255 + 0.055) / 1.055) ** 2.4, rel=1e-6)
    assert light[0, 0].tolist() == codes[0, 0].tolist() == [1, 1, 1, 1]


def test_light_beyond_half_precision_is_infinite_and_displays_white() -> None:
    sun = layers(
        (shapes.rectangle(0, 0, 2.5, SIZE), (7e4, 65504.0, 0.1, 1.0), 0),
        names=("hdr", "tone-mapping"),
    )
    after = simulate.simulate(sun._replace(settings={"tone-mapping": "after-resolve"}), FOUR).image
    before = simulate.simulate(
        sun._replace(settings={"tone-mapping": "before-resolve"}), FOUR
    ).image
    assert after[0, 0, 0] == 1 and after[0, 2, 0] == 1 and not np.isnan(after).any()
    assert before[0, 2, :2] == pytest.approx([0.5, 0.5], abs=1e-4)
    kept = float(np.float16(0.1))
    assert after[0, 0, 2] == pytest.approx(kept / (1 + kept), rel=1e-3)


def test_blending_happens_before_what_is_stored_is_rounded() -> None:
    """Half of 1 over 2048 in half precision: 1024.5 is kept as 1024."""
    made = layers(
        (ALL, (2048.0,) * 3 + (1.0,), 0), (ALL, (1.0, 1.0, 1.0, 0.5), 0), names=("blending", "hdr")
    )
    assert simulate.simulate(made, FOUR).image[0, 0, 0] == 1024
