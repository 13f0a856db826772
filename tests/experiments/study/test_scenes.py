"""Scenes show what they say, call for what they need, and have the exact picture."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.study import coverage, locations, measure, scenes, snap
from msaa_lint.experiments.study.effects import BY_NAME
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.experiments.study.scenes import depth, detail, edges, view, visible
from msaa_lint.experiments.study.scenes import mesh as own
from msaa_lint.experiments.study.scenes.description import from_description
from msaa_lint.experiments.study.scenes.mesh import from_mesh
from msaa_lint.experiments.study.scenes.part import Part
from msaa_lint.experiments.study.scenes.scene import Scene
from msaa_lint.experiments.study.simulate import simulate
from tests.experiments.confirm.frames import frame
from tests.experiments.study import spans
from tests.strength import examples

MANY = Technique(SSAA, 256, grid=16)
"""So many samples that what is left of an error is theirs: of an edge along an axis 1 / (16
sqrt(12)) = 0.018.
"""

SAMPLED = [
    name
    for name in scenes.NAMES
    if name
    not in ("hdr-emitter", "hdr-emitter-weighted", "foliage-to-coverage", "intersecting-far")
]
"""Scenes whose picture many samples give. The others are there to show what does not."""


@pytest.fixture(autouse=True)
def without_flicker(monkeypatch: pytest.MonkeyPatch) -> None:
    """The flicker of very many samples takes long, and is not looked at here."""
    monkeypatch.setattr(measure, "flicker", lambda *_: 0.0)


def exact_picture(made: Scene) -> np.ndarray:
    """The exact picture of the triangles as they are, not snapped."""
    return made.exact(view.whole(made.triangles, made.width, made.height)).image[0]


@pytest.mark.parametrize("name", scenes.NAMES)
def test_a_scene_says_what_it_is_and_why_it_calls_for_what(name: str) -> None:
    made = scenes.scene(name, 96, 64)
    assert (made.name, made.description, made.width, made.height) == (
        name,
        scenes.DESCRIPTIONS[name],
        96,
        64,
    )
    assert set(made.effects) <= set(BY_NAME)
    assert set(made.why) == set(made.effects) and all(made.why.values())
    assert made.triangles.shape == (len(made.colors), 3, 2) and np.isfinite(made.triangles).all()
    assert (made.depths is not None) == ("depth-test" in made.effects)
    assert set(made.settings) <= set(made.effects)
    exact = exact_picture(made)
    assert exact.shape == (64, 96, 4) and exact.min() >= 0 and exact[..., 3].max() <= 1 + 1e-12
    truth = measure.truth(made)
    assert truth.edge_pixels.shape == (64, 96) and truth.edge_pixels.any()


@pytest.mark.parametrize("name", SAMPLED)
def test_the_exact_picture_is_what_very_many_samples_give(name: str) -> None:
    found = measure.point(scenes.scene(name, 64, 48), MANY)
    assert found.rmse < 0.012 and found.rmse_all < 0.008 and abs(found.bias) < 0.002


@pytest.mark.parametrize("name", scenes.NAMES)
def test_a_scene_is_the_same_every_time(name: str) -> None:
    one, other = (scenes.scene(name, 64, 64) for _ in range(2))
    assert np.array_equal(one.triangles, other.triangles) and np.array_equal(
        one.colors, other.colors
    )


def test_a_name_that_is_none_gets_the_nearest() -> None:
    with pytest.raises(LookupError, match=r"unknown scene `edge-fans`: did you mean `edge-fan`\?"):
        scenes.scene("edge-fans", 64, 64)
    with pytest.raises(LookupError, match="the scenes are edge-fan, near-horizontal"):
        scenes.scene("xyzzy", 64, 64)


@pytest.mark.parametrize("size", [(31, 64), (64, 31), (1, 1), (0, 64)])
def test_pictures_that_are_too_small_are_refused(size: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="must be at least 32x32 pixels"):
        scenes.scene("edge-fan", *size)


@examples(0.15)
@given(st.sampled_from(scenes.NAMES), st.integers(32, 70), st.integers(32, 70))
def test_every_size_has_every_scene(name: str, width: int, height: int) -> None:
    found = measure.point(scenes.scene(name, width, height), Technique(MSAA, 4))
    assert found.edge_pixels > 0 and 0 < found.rmse < 0.6


def directions(made: Scene) -> np.ndarray:
    """The directions of the outlines of quadrilaterals, in degrees from 0 to 180."""
    quads = made.triangles.reshape(-1, 2, 3, 2)
    corners = np.stack([quads[:, 0, 0], quads[:, 0, 1], quads[:, 0, 2], quads[:, 1, 2]], axis=1)
    along = np.roll(corners, -1, axis=1) - corners
    return np.degrees(np.arctan2(along[..., 1], along[..., 0])) % 180


def test_the_fan_has_edges_at_all_angles_evenly() -> None:
    found = directions(scenes.scene("edge-fan", 256, 256))
    # Edges outwards by their own, the ends of wedges by theirs: no gap is wider than twice the
    # mean.
    for some in (found[:, ::2], found[:, 1::2]):
        angles = np.sort(some.ravel())
        gaps = np.diff(angles, append=angles[0] + 180)
        assert gaps.max() <= 2 * 180 / len(np.unique(angles.round(6)))
    assert np.min(found % 90) > 0


def test_near_horizontal_edges_are_near_horizontal() -> None:
    found = directions(scenes.scene("near-horizontal", 256, 256))[:, ::2]
    slopes = np.tan(np.radians(np.where(found > 90, found - 180, found)))
    assert np.abs(slopes).max() <= 1 / 16 + 1e-9
    assert slopes.max() > 0.06 and slopes.min() < -0.06
    assert np.abs(np.diff(np.sort(slopes[:, 0]))).max() == pytest.approx(0.125 / (len(slopes) - 1))


def test_wires_are_a_tenth_to_two_pixels_wide_and_drop_out() -> None:
    made = scenes.scene("wires", 240, 240)
    quads = made.triangles.reshape(-1, 2, 3, 2)
    widths = np.linalg.norm(quads[:, 0, 2] - quads[:, 0, 1], axis=1)
    widths = np.minimum(widths, np.linalg.norm(quads[:, 0, 1] - quads[:, 0, 0], axis=1))
    assert 0.1 <= widths.min() < 0.15 and 1.9 < widths.max() <= 2.0

    def missed(count: int) -> int:
        hits = coverage.rows(snap.snapped(made.triangles), 240, 240, locations.standard(count))
        samples = np.zeros(len(made.triangles), np.int64)
        np.add.at(samples, hits.triangle, (hits.right - hits.left).sum(axis=1))
        # The wire is 20 pixels long: of these so many in a row without a sample are a gap.
        return int(np.count_nonzero(samples.reshape(-1, 2).sum(axis=1) < 10 * count * widths))

    assert missed(1) > missed(16)


def test_the_mesh_is_watertight() -> None:
    made = scenes.scene("mesh", 150, 90)
    triangles = snap.snapped(made.triangles)
    for count in (1, 4, 16):
        assert (
            spans.hits(coverage.rows(triangles, 150, 90, locations.standard(count)), 150, 90)
            == count
        ).all()
    uses: dict[tuple[tuple[int, int], ...], list[int]] = {}
    for number, triangle in enumerate(triangles.tolist()):
        for a, b in ((0, 1), (1, 2), (2, 0)):
            uses.setdefault(tuple(sorted((tuple(triangle[a]), tuple(triangle[b])))), []).append(
                number
            )
    for line, sharing in uses.items():
        (x0, y0), (x1, y1) = line
        border = (x0 == x1 and x0 in (0, 150 * 256)) or (y0 == y1 and y0 in (0, 90 * 256))
        assert len(sharing) == (1 if border else 2)
        if not border:
            assert (made.colors[sharing[0]] != made.colors[sharing[1]]).any()


def test_alpha_tested_leaves_gain_nothing_from_coverage_and_much_from_alpha_to_coverage() -> None:
    tested, covered = scenes.scene("foliage", 120, 96), scenes.scene("foliage-to-coverage", 120, 96)
    one, four = (measure.point(tested, Technique(MSAA, count)).rmse for count in (1, 4))
    assert one == four
    assert measure.point(covered, Technique(MSAA, 4)).rmse < 0.5 * four
    assert measure.point(tested, Technique(SAMPLE_SHADING, 4, 1.0)).rmse < 0.5 * four


def test_light_is_to_be_tone_mapped_before_it_is_averaged() -> None:
    after, before, weighted = (
        scenes.scene(f"hdr-emitter{each}", 96, 96) for each in ("", "-before", "-weighted")
    )
    errors = {
        each.name: [measure.point(each, Technique(MSAA, count)).rmse for count in (1, 4, 16)]
        for each in (after, before, weighted)
    }
    assert errors["hdr-emitter"] == sorted(errors["hdr-emitter"])
    assert errors["hdr-emitter-before"] == sorted(errors["hdr-emitter-before"], reverse=True)
    assert errors["hdr-emitter-before"][2] < 0.06
    assert errors["hdr-emitter-weighted"][2] < 0.12 < 0.3 < errors["hdr-emitter"][2]
    assert measure.point(after, Technique(MSAA, 4)).bias > 0.2


def test_crossing_surfaces_are_the_same_with_standard_and_reversed_depth_near_by() -> None:
    standard, turned = (
        simulate(scenes.scene(f"intersecting{each}", 96, 64), Technique(MSAA, 4)).image
        for each in ("", "-reversed")
    )
    assert np.count_nonzero((standard != turned).any(axis=2)) <= 3


def test_far_away_standard_depth_cannot_tell_surfaces_apart_and_reversed_can() -> None:
    standard, turned = (
        measure.point(scenes.scene(f"intersecting-far{each}", 96, 64), Technique(MSAA, 8))
        for each in ("", "-reversed")
    )
    assert standard.rmse_all > 10 * turned.rmse_all
    assert turned.rmse == pytest.approx(
        measure.point(scenes.scene("intersecting", 96, 64), Technique(MSAA, 8)).rmse, rel=0.05
    )


def test_detail_beyond_pixels_is_averaged_exactly() -> None:
    """The closed form against 60 x 60 midpoints of a pixel."""
    made = detail.zone_plate(40, 36)
    assert made.shade is not None
    places = (np.arange(60) + 0.5) / 60
    exact = exact_picture(made)
    for x, y in ((0, 0), (19, 17), (39, 35), (3, 30)):
        across, down = (each.ravel() for each in np.meshgrid(x + places, y + places))
        mean = made.shade(np.zeros(3600, np.int32), across, down).mean(axis=0)
        assert exact[y, x] == pytest.approx(mean, abs=2e-4)
    mapped = exact_picture(detail.zone_plate(40, 36, lambda color: color * 0.5))
    assert mapped == pytest.approx(exact * 0.5, abs=1e-9)


def squares(
    depths: tuple[list[float], list[float]], look: visible.Visibility
) -> tuple[np.ndarray, np.ndarray]:
    """A red square over x 0 to 4 and a green one over x 2 to 6 of a picture of 8 x 4, and what is
    crossed.
    """
    corners = [
        [[0, 0], [4, 0], [4, 4]],
        [[0, 0], [4, 4], [0, 4]],
        [[2, 0], [6, 0], [6, 4]],
        [[2, 0], [6, 4], [2, 4]],
    ]
    colors = np.array([[1, 0, 0, 0.5]] * 2 + [[0, 1, 0, 0.5]] * 2)
    given = np.array(
        [
            [a, b, c]
            for own in depths
            for a, b, c in ([own[0], own[1], own[2]], [own[0], own[2], own[3]])
        ]
    )
    exact = visible.overlapping(colors, given if look.depth else None, 8, 4, look)
    made = Scene(8, 4, np.array(corners, np.float64), colors, exact)
    picture, crossed = exact(view.whole(made.triangles, made.width, made.height))
    return picture[0], crossed[0]


def test_what_is_drawn_last_is_seen_without_depth() -> None:
    picture, crossed = squares(([0] * 4, [0] * 4), visible.Visibility())
    assert picture[:, :2, 0] == pytest.approx(1) and picture[:, 2:6, 1] == pytest.approx(1)
    assert not picture[:, 2:6, 0].any() and not picture[:, 6:].any() and not crossed.any()


@pytest.mark.parametrize("turned", [False, True])
def test_what_is_nearer_is_seen_with_depth(turned: bool) -> None:
    picture, _ = squares(([0.2] * 4, [0.7] * 4), visible.Visibility(depth=True, reversed=turned))
    assert (
        picture[:, 2:4, int(turned)] == pytest.approx(1)
        and not picture[:, 2:4, int(not turned)].any()
    )


def test_equal_depth_leaves_what_was_drawn_first() -> None:
    picture, _ = squares(([0.5] * 4, [0.5] * 4), visible.Visibility(depth=True))
    assert picture[:, :4, 0] == pytest.approx(1) and picture[:, 4:6, 1] == pytest.approx(1)


def test_crossing_surfaces_are_cut_along_the_line_where_they_cross() -> None:
    """The red is 0.5 deep, the green from 0.3 at x 2 to 0.8 at x 6: they cross at x 3.6."""
    picture, crossed = squares(([0.5] * 4, [0.3, 0.8, 0.8, 0.3]), visible.Visibility(depth=True))
    assert (
        picture[:, 2, 1] == pytest.approx(1)
        and picture[:, 3, 1] == pytest.approx(0.6)
        and picture[:, 3, 0] == pytest.approx(0.4)
    )
    assert crossed[:, 3].all() and crossed.sum() == 4


def test_blended_surfaces_are_mixed_in_their_order() -> None:
    picture, _ = squares(([0] * 4, [0] * 4), visible.Visibility(blended=True))
    assert picture[0, 0] == pytest.approx([0.5, 0, 0, 0.5])
    assert picture[0, 3] == pytest.approx([0.25, 0.5, 0, 0.75])
    assert picture[0, 5] == pytest.approx([0, 0.5, 0, 0.5])


@examples(0.25)
@given(
    st.lists(st.tuples(*[st.integers(-40, 200)] * 6), min_size=1, max_size=6), st.integers(0, 2**20)
)
def test_pieces_of_any_triangles_fill_the_picture_once(
    corners: list[tuple[int, ...]], seed: int
) -> None:
    triangles = np.array(corners, np.float64).reshape(-1, 3, 2) / 8
    draws = np.random.default_rng(seed)
    colors = np.concatenate(
        [draws.random((len(triangles), 3)), np.ones((len(triangles), 1))], axis=1
    )
    depths = draws.random((len(triangles), 3))
    numbers = np.arange(len(triangles))
    whole = view.View([Part(0, 0, 20, 18)], numbers, np.zeros_like(numbers), triangles)
    found = visible.tiles(whole, colors, depths, (20, 18), visible.Visibility(depth=True))
    assert sum(
        abs(visible.signed_area(piece.polygon)) for tile in found for piece in tile.regions
    ) == pytest.approx(20 * 18, abs=1e-6)


OBJ = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n"
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\n{colors}"
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n{vertices}3 0 1 2\n3 0 2 "
    "3\n"
)


def written(folder: Path, name: str, text: str | bytes) -> str:
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return str(path)


@pytest.mark.parametrize("name", ["square.obj", "SQUARE.OBJ", "square.ply"])
def test_a_flat_mesh_is_white_and_fills_the_picture_upright(tmp_path: Path, name: str) -> None:
    text = (
        OBJ
        if "obj" in name.lower()
        else PLY.format(colors="", vertices="0 0 0\n2 0 0\n2 1 0\n0 1 0\n")
    )
    made = from_mesh(written(tmp_path, name, text), 66, 64)
    assert (made.name, made.effects, made.coverage_matter, made.depths) == (name, (), True, None)
    exact = exact_picture(made)[..., 3]
    assert exact.sum() == pytest.approx(64 * 32)
    assert exact[16:48, 1:65] == pytest.approx(1)
    assert measure.point(made, Technique(MSAA, 4)).rmse == 0


def test_up_in_the_file_is_up_in_the_picture(tmp_path: Path) -> None:
    made = from_mesh(written(tmp_path, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), 64, 64)
    exact = exact_picture(made)[..., 3]
    assert exact[5, 2] == exact[60, 50] == 1 and exact[5, 50] == 0


def test_vertex_colours_are_light(tmp_path: Path) -> None:
    colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    vertices = "".join(f"{x} {y} 0 188 0 255\n" for x, y in ((0, 0), (2, 0), (2, 1), (0, 1)))
    made = from_mesh(
        written(tmp_path, "a.ply", PLY.format(colors=colors, vertices=vertices)), 64, 64
    )
    assert not made.coverage_matter
    assert made.colors[0] == pytest.approx([0.5029, 0, 1, 1], abs=1e-4)
    assert measure.point(made, MANY).rmse < 0.02


def test_a_mesh_with_depth_is_tested_for_depth_and_what_has_more_z_is_nearer(
    tmp_path: Path,
) -> None:
    text = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 1\nv 4 0 1.5\nv 4 4 3\nf 1 2 3\nf 4 5 6\n"
    made = from_mesh(written(tmp_path, "a.obj", text), 64, 64)
    assert made.effects == ("depth-test",) and set(made.why) == {"depth-test"}
    assert made.depths is not None and made.depths[0] == pytest.approx(0.99)
    assert made.depths[1].min() == pytest.approx(0.01)
    found = measure.point(made, MANY)
    # Half of a diagonal's 16 samples are on the wrong side of it: 1/32 and less.
    assert found.rmse < 1 / 32 and found.edge_pixels > 60


def test_overlapping_flat_triangles_are_no_matter_of_coverage(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 4 4 0\nf 1 2 3\nf 1 2 4\n"
    made = from_mesh(written(tmp_path, "a.obj", text), 64, 64)
    assert not made.coverage_matter and made.effects == ()


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("a.obj", "", "no triangles|not a valid OBJ mesh"),
        ("a.obj", "v 0 0 0\nv 1 0 0\n", "no triangles|not a valid OBJ mesh"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n", "not finite"),
        ("a.obj", "v 0 0 0\nv 1 0 0\nv 1e400 1 0\nf 1 2 3\n", "not finite"),
        ("a.obj", "v 0 0 0\nv 0 0 1\nv 0 0 2\nf 1 2 3\n", "no visible extent"),
        ("a.obj", "v 0 0 0\nf 1 2 3\n", "not a valid OBJ mesh"),
        ("a.ply", "plx\n", "not a valid PLY mesh"),
        (
            "a.ply",
            b"ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\nproperty float x\n"
            b"end_header\n",
            "not a valid PLY mesh",
        ),
        ("a.stl", "solid\n", r"a mesh must be a \.obj or \.ply file"),
    ],
)
def test_files_that_are_no_mesh_are_said_to_be_none(
    tmp_path: Path, name: str, text: str | bytes, words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        from_mesh(written(tmp_path, name, text), 64, 64)


def test_meshes_have_limits(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = written(tmp_path, "a.obj", OBJ)
    monkeypatch.setattr(own, "MAX_TRIANGLES", 1)
    with pytest.raises(ValueError, match="2 triangles; at most 1 are supported"):
        from_mesh(path, 64, 64)
    monkeypatch.setattr(own, "MAX_BYTES", 10)
    with pytest.raises(ValueError, match="larger than"):
        from_mesh(path, 64, 64)
    with pytest.raises(FileNotFoundError):
        from_mesh(str(tmp_path / "none.obj"), 64, 64)


def _random_triangles(count: int, size: float) -> str:
    """An OBJ file of triangles in random places at random depths."""
    numbers = np.random.default_rng(1)
    corners = numbers.random((count, 1, 3)) + size * numbers.random((count, 3, 3))
    vertices = "".join(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in corners.reshape(-1, 3))
    return vertices + "".join(f"f {n} {n + 1} {n + 2}\n" for n in range(1, 3 * count, 3))


def test_the_exact_picture_of_a_mesh_takes_a_limited_number_of_comparisons(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = 0

    def counted(tile: list[visible.Region], *rest: object) -> list[visible.Region]:
        nonlocal drawn
        drawn += len(tile)
        return draw(tile, *rest)  # type: ignore[arg-type]

    draw = visible._draw
    monkeypatch.setattr(visible, "_draw", counted)
    monkeypatch.setattr(visible, "MAX_STEPS", 1000)
    limit = 1000 + 100 * visible.STEPS_PER_TRIANGLE + 4 * visible.STEPS_PER_TILE
    with pytest.raises(ValueError, match="too many triangles overlap in the same pixels"):
        from_mesh(written(tmp_path, "a.obj", _random_triangles(100, 1)), 32, 32)
    assert limit - 1000 < drawn <= limit


def test_the_comparisons_of_small_triangles_grow_with_their_number(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = written(tmp_path, "a.obj", _random_triangles(300, 0.02))
    quartered = from_mesh(path, 32, 32)
    monkeypatch.setattr(visible, "MAX_STEPS", 0)
    from_mesh(path, 64, 64)
    monkeypatch.undo()
    monkeypatch.setattr(visible, "MAX_IN_CELL", 300)
    whole = from_mesh(path, 32, 32)
    assert exact_picture(quartered) == pytest.approx(exact_picture(whole), abs=1e-9)


def test_a_mesh_opens_no_other_file(tmp_path: Path) -> None:
    """Materials that it names are left alone, though they are there and would be no text."""
    written(tmp_path, "secret.mtl", b"newmtl a\nKd 1 0 0\nmap_Kd /etc/passwd\n")
    made = from_mesh(written(tmp_path, "a.obj", "mtllib secret.mtl\nusemtl a\n" + OBJ), 64, 64)
    assert made.coverage_matter and (made.colors == 1).all()


FULL = """
images:
  color: {format: R16G16B16A16_SFLOAT, samples: 4, usage: [COLOR_ATTACHMENT]}
  depth: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
  resolved: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
pipelines:
  all:
    multisampleState: {rasterizationSamples: 4, alphaToCoverageEnable: true, sampleMask: [7]}
    colorBlendState: {attachments: [{blendEnable: true}]}
    depthStencilState: {depthTestEnable: true, depthCompareOp: GREATER, stencilTestEnable: true}
commands:
  - beginRendering: {colorAttachments: [{image: color}], depthAttachment: {image: depth, resolveMode: MIN, resolveImage: resolved}}
  - endRendering
scene: {color: HDR, peak: 20, toneMapping: IN_PASS, textureDetail: true, alphaTest: true}
"""


def parts(made: Scene) -> list[str]:
    """The names of the parts of a description's scene; each has a reason."""
    introduction, _, texts = made.description.partition(": ")
    assert introduction == "what the description calls for"
    named = [re.fullmatch(r"([a-z-]+) \(([^()]+)\)", text) for text in texts.split("; ")]
    return [found[1] for found in named if found]


@pytest.mark.parametrize(
    ("text", "effects", "says"),
    [
        ("frame: {fps: 60}\n", (), "edge-fan"),
        ("scene: {edges: true}\n", (), "edge-fan"),
        ("scene: {edges: false, textureDetail: true}\n", (), "zone-plate"),
        ("scene: {alphaTest: true}\n", ("alpha-test",), "edge-fan, foliage"),
        ("scene: {depth: STANDARD}\n", ("depth-test",), "edge-fan, intersecting"),
        (
            "scene: {depth: REVERSED, depthResolveWants: FARTHEST}\n",
            ("depth-test", "depth-resolve"),
            "edge-fan, intersecting",
        ),
        (
            "scene: {depth: STANDARD, depthResolveWants: ANY}\n",
            ("depth-test",),
            "edge-fan, intersecting",
        ),
        ("scene: {color: LDR, toneMapping: AFTER_RESOLVE}\n", (), "edge-fan"),
        ("scene: {color: HDR, toneMapping: NONE}\n", ("hdr",), "edge-fan"),
        ("scene: {color: HDR}\n", ("hdr", "tone-mapping"), "edge-fan"),
        (
            "pipelines: {a: {colorBlendState: {attachments: [{blendEnable: true}]}}}\n",
            ("blending",),
            "edge-fan, glass",
        ),
        (
            "pipelines: {a: {depthStencilState: {stencilTestEnable: true}}}\n",
            ("stencil",),
            "edge-fan, portal",
        ),
        (
            "pipelines: {a: {multisampleState: {alphaToCoverageEnable: true}}}\n",
            ("alpha-to-coverage",),
            "foliage",
        ),
        (
            "pipelines: {a: {multisampleState: {rasterizationSamples: 4, sampleMask: [15]}}}\n",
            (),
            "edge-fan",
        ),
        (
            "pipelines: {a: {multisampleState: {rasterizationSamples: 4, sampleMask: [5]}}}\n",
            ("sample-mask",),
            "edge-fan",
        ),
        (
            "images: {a: {format: R8G8B8A8_SRGB, usage: [COLOR_ATTACHMENT]}}\n",
            ("srgb",),
            "edge-fan",
        ),
        ("images: {a: {format: R8G8B8A8_SRGB, usage: [SAMPLED]}}\n", (), "edge-fan"),
        (
            "images: {a: {format: R8G8B8A8_UNORM, encoding: GAMMA, usage: [COLOR_ATTACHMENT]}}\n",
            ("srgb",),
            "edge-fan",
        ),
        (
            "images: {a: {format: R8G8B8A8_UNORM, encoding: LINEAR, usage: [COLOR_ATTACHMENT]}}\n",
            (),
            "edge-fan",
        ),
        (
            FULL,
            (
                "sample-mask",
                "alpha-test",
                "alpha-to-coverage",
                "stencil",
                "depth-test",
                "blending",
                "hdr",
                "depth-resolve",
                "tone-mapping",
            ),
            "intersecting, foliage, zone-plate, glass, portal",
        ),
    ],
)
def test_a_description_calls_for_what_it_says_and_nothing_else(
    text: str, effects: tuple[str, ...], says: str
) -> None:
    made = from_description(frame(text), 240, 64)
    assert parts(made) == says.split(", ")
    assert set(made.effects) == set(effects) == set(made.why)
    found = simulate(made, Technique(MSAA, 4))
    assert found.effects == effects
    assert (found.depth is not None) == ("depth-resolve" in effects)


@pytest.mark.parametrize(
    ("text", "setting"),
    [
        (
            "scene: {depth: STANDARD, depthResolveWants: NEAREST}\n",
            {"depth-test": "LESS", "depth-resolve": "MIN"},
        ),
        (
            "scene: {depth: STANDARD, depthResolveWants: FARTHEST}\n",
            {"depth-test": "LESS", "depth-resolve": "MAX"},
        ),
        (
            "scene: {depth: REVERSED, depthResolveWants: NEAREST}\n",
            {"depth-test": "GREATER", "depth-resolve": "MAX"},
        ),
        (
            "scene: {depth: REVERSED, depthResolveWants: FARTHEST}\n",
            {"depth-test": "GREATER", "depth-resolve": "MIN"},
        ),
        ("scene: {color: HDR, toneMapping: AFTER_RESOLVE}\n", {"tone-mapping": "after-resolve"}),
        ("scene: {color: HDR, toneMapping: IN_PASS}\n", {"tone-mapping": "before-resolve"}),
        (
            "images: {a: {format: R8G8B8A8_SRGB, usage: [COLOR_ATTACHMENT]}}\n",
            {"srgb": "linear-light"},
        ),
        (
            "images: {a: {format: R8G8B8A8_UNORM, encoding: GAMMA, usage: [COLOR_ATTACHMENT]}}\n",
            {"srgb": "encoded"},
        ),
        (
            "pipelines: {a: {depthStencilState: {depthTestEnable: true, depthCompareOp: "
            "GREATER}}}\n",
            {"depth-test": "GREATER"},
        ),
    ],
)
def test_a_description_says_how(text: str, setting: dict[str, str]) -> None:
    assert from_description(frame(text), 240, 64).settings == setting


def test_the_mode_that_a_pass_resolves_depth_by_is_taken() -> None:
    made = from_description(frame(FULL), 240, 64)
    assert made.settings["depth-resolve"] == "MIN"
    assert "commands[0].beginRendering" in made.why["depth-resolve"]


@pytest.mark.parametrize(
    "text",
    [
        "scene: {alphaTest: true, depth: REVERSED}\n",
        "scene: {textureDetail: true, color: HDR, toneMapping: IN_PASS}\npipelines: {a: "
        "{depthStencilState: {stencilTestEnable: true}}}\n",
        "pipelines: {a: {colorBlendState: {attachments: [{blendEnable: true}]}, depthStencilState: "
        "{depthTestEnable: true}}}\n",
    ],
)
def test_what_descriptions_show_has_the_exact_picture(text: str) -> None:
    found = measure.point(from_description(frame(text), 160, 48), MANY)
    assert found.rmse < 0.012 and abs(found.bias) < 0.002


def test_parts_stand_side_by_side_as_they_are_alone() -> None:
    made = from_description(frame("scene: {depth: STANDARD, alphaTest: true}\n"), 200, 64)
    together = simulate(made, Technique(MSAA, 4)).image
    for place, part in enumerate(
        (edges.edge_fan(66, 64), depth.intersecting(66, 64), detail.foliage(66, 64))
    ):
        alone = simulate(part, Technique(MSAA, 4)).image
        assert np.array_equal(together[:, 66 * place : 66 * (place + 1)], alone)
    assert not together[:, 198:].any()


def test_a_description_needs_room_for_all_that_it_calls_for() -> None:
    with pytest.raises(
        ValueError,
        match="150x64 pixels are too few for intersecting, foliage, zone-plate, glass, portal",
    ):
        from_description(frame(FULL), 150, 64)


def test_brightness_is_the_peak_that_is_stated() -> None:
    made = from_description(frame("scene: {color: HDR, peak: 16, toneMapping: NONE}\n"), 64, 64)
    assert made.colors.max() == 16
    assert exact_picture(made)[..., 0].max() == pytest.approx(16)
    shown = from_description(frame("scene: {color: HDR, peak: 16}\n"), 64, 64)
    assert exact_picture(shown)[..., 0].max() == pytest.approx(16 / 17)
    assert math.isclose(from_description(frame("scene: {peak: 16}\n"), 64, 64).colors.max(), 1.0)


DRAWN = """
frame: {width: 200, height: 64}
images:
  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  light: {format: B10G11R11_UFLOAT_PACK32, samples: 4, usage: [COLOR_ATTACHMENT]}
  map: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
  picture: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
renderPasses:
  scene: {attachments: {c: {image: TARGET, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [c]}]}
  shadow: {attachments: {d: {image: map, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{depthStencilAttachment: d}]}
  ui: {attachments: {c: {image: picture, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [c]}]}
pipelines:
  bricks: {renderPass: scene, vertexInputState: {vertexBindingDescriptions: [{binding: 0, stride: 12}]}}
  leaves: {renderPass: scene, multisampleState: {rasterizationSamples: 4, alphaToCoverageEnable: true}}
  widgets: {renderPass: ui, colorBlendState: {attachments: [{blendEnable: true}]}}
commands:
"""

UI = (
    "  - beginRenderPass: {renderPass: ui}\n  - draw: {pipeline: widgets, vertexCount: 6}\n  - "
    "endRenderPass\n"
)


def drawn(render_pass: str, *draws: str, color: str = "color") -> Scene:
    lines = [
        f"beginRenderPass: {{renderPass: {render_pass}}}",
        *(f"draw: {{{draw}}}" for draw in draws),
        "endRenderPass",
    ]
    text = DRAWN.replace("TARGET", color) + "".join(f"  - {line}\n" for line in lines) + UI
    if not any("bricks" in draw for draw in draws):
        text = "".join(line for line in text.splitlines(True) if not line.startswith("  bricks"))
    if not any("leaves" in draw for draw in draws):
        text = "".join(line for line in text.splitlines(True) if not line.startswith("  leaves"))
    return from_description(frame(text), 200, 64)


def test_small_triangles_are_a_mesh_of_as_large_ones() -> None:
    """200 x 64 pixels hold 400 triangles of 32 pixels, or 4 of 3200."""
    small = drawn("scene", "pipeline: bricks, vertexCount: 1200")
    assert (
        small.description
        == "what the description calls for: mesh (triangles have 32 pixels on average)"
    )
    assert 350 <= len(small.triangles) <= 450 and not small.coverage_matter
    assert parts(drawn("scene", "pipeline: bricks, vertexCount: 12")) == ["edge-fan"]
    found = measure.point(small, MANY)
    assert found.rmse < 0.012 and abs(found.bias) < 0.002


def test_what_draws_with_one_sample_does_not_count() -> None:
    """The user interface blends, but nothing multisampled does."""
    assert parts(drawn("scene", "pipeline: bricks")) == ["edge-fan"]


def test_leaves_alone_have_no_other_edges() -> None:
    assert (
        drawn("scene", "pipeline: leaves").description
        == "what the description calls for: foliage (leaves sets alphaToCoverageEnable)"
    )
    assert parts(drawn("scene", "pipeline: leaves", "pipeline: bricks")) == ["edge-fan", "foliage"]


def test_depth_alone_is_compared_where_surfaces_intersect() -> None:
    made = drawn("shadow", "vertexCount: 300")
    assert (
        made.description
        == "what the description calls for: intersecting (the multisampled passes draw depth alone)"
    )


def test_formats_that_hold_light_are_hdr() -> None:
    made = drawn("scene", "pipeline: bricks, vertexCount: 1200", color="light")
    held = "light is B10G11R11_UFLOAT_PACK32, which holds light above display white"
    assert made.why["hdr"] == f"{held}: 4 times is assumed without scene.peak"
    assert made.why["tone-mapping"] == "scene.toneMapping is not stated: after the resolve"
    # Tone mapped, light of 4 is less than display white.
    assert 0.5 < exact_picture(made)[..., :3].max() < 1 < made.colors.max() <= 4
