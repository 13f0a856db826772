"""Resolves told against the truth: the samples, where the specification has them, and what they are
to come to.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm import resolve_check as resolving
from msaa_lint.experiments.confirm.frame_results import FrameRun, PassOutcome
from msaa_lint.experiments.confirm.parts import COLOR, DEPTH, RENDER_PASS, RENDERING, STENCIL, Plan
from msaa_lint.experiments.confirm.resolve_check import (
    Deviation,
    deviations,
    judged,
    of_pass,
    witnessed,
)
from msaa_lint.experiments.confirm.resolve_expected import (
    AVERAGE,
    GREATEST,
    LEAST,
    ZERO,
    beside,
    components,
    decoded,
    due,
    encoded,
    stored,
)
from msaa_lint.experiments.confirm.resolve_probe import COMMAND, Resolve, probe, resolves
from msaa_lint.experiments.confirm.scene import CORNERS
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.texels import Texels, format_of, texels
from msaa_lint.experiments.confirm.vulkan_errors import Unusable
from msaa_lint.frame.vulkan.enums import VALUES
from tests.experiments.confirm.frames import planned

SIDE = 64

Pixels = list[list[tuple[float, ...]]]
"""The samples of each pixel, each red, green, blue and alpha."""


@pytest.fixture(scope="module")
def session() -> Iterator[Session]:
    """Lavapipe, in a child process."""
    with Session(environment=environment(None)) as opened:
        opened.open()
        yield opened


def frame(form: str, samples: int = 4, mode: str = "AVERAGE", side: int = SIDE) -> str:
    """A frame that resolves one format in a render pass, in dynamic rendering and by a command."""
    more = f"extent: {{width: {side}, height: {side}}}"
    return f"""
images:
  color: {{format: {form}, samples: {samples}, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], {more}}}
  inline: {{format: {form}, samples: 1, usage: [COLOR_ATTACHMENT], {more}}}
  command: {{format: {form}, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_DST], {more}}}
  rendering: {{format: {form}, samples: 1, usage: [COLOR_ATTACHMENT], {more}}}
renderPasses:
  forward:
    attachments:
      color: {{image: color, loadOp: CLEAR, storeOp: STORE, finalLayout: TRANSFER_SRC_OPTIMAL}}
      inline: {{image: inline, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses:
      - {{colorAttachments: [color], resolveAttachments: [inline]}}
commands:
  - beginRenderPass: {{renderPass: forward}}
  - endRenderPass
  - resolveImage: {{srcImage: color, dstImage: command}}
  - beginRendering:
      colorAttachments: [{{image: color, loadOp: CLEAR, storeOp: STORE, resolveMode: {mode}, resolveImage: rendering}}]
  - endRendering
"""


def depth_frame(form: str, depth: str = "AVERAGE", stencil: str = "NONE", side: int = SIDE) -> str:
    """A frame that resolves depth and stencil in a render pass."""
    more = f"usage: [DEPTH_STENCIL_ATTACHMENT], extent: {{width: {side}, height: {side}}}"
    operations = "storeOp: STORE, stencilStoreOp: STORE"
    return f"""
images:
  depth: {{format: {form}, samples: 4, {more}}}
  resolved: {{format: {form}, samples: 1, {more}}}
renderPasses:
  forward:
    attachments:
      depth: {{image: depth, loadOp: CLEAR, stencilLoadOp: CLEAR, {operations}}}
      resolved: {{image: resolved, loadOp: DONT_CARE, stencilLoadOp: DONT_CARE, {operations}}}
    subpasses:
      - depthStencilAttachment: depth
        depthStencilResolve: {{attachment: resolved, depthResolveMode: {depth}, stencilResolveMode: {stencil}}}
"""


def drawn(session: Session, plan: Plan, seen: str) -> tuple[Pixels, dict[str, Texels]]:
    """The samples of an image of a frame, and all its single-sampled images."""
    want = {
        "pixels": session.folder("drawn"),
        "repeats": 0,
        "warmups": 0,
        "size": None,
        "samples_of": seen,
    }
    run = session.run(plan, range(len(plan.passes)), want)
    assert run.whole and all(ran.created for ran in run.passes.values()), run
    event = run.images[f"{seen}:samples"]
    count = event["samples"]
    every = list(struct.iter_unpack("<4f", Path(event["path"]).read_bytes()))
    assert len(every) == event["width"] * event["height"] * count
    found = {}
    for image in plan.images:
        if image.name in run.images:
            form = format_of(
                next(name for name, value in VALUES["VkFormat"].items() if value == image.format)
            )
            assert form is not None
            texel = texels(form, Path(run.images[image.name]["path"]).read_bytes(), image.width)
            assert texel is not None
            found[image.name] = texel
    return [every[at : at + count] for at in range(0, len(every), count)], found


# What Vulkan says of an average, in exact arithmetic.


def mean(values: Sequence[float]) -> Fraction:
    return sum(map(Fraction, values), Fraction(0)) / len(values)


def right_normalised(given_code: float, samples: Sequence[float], codes: int) -> bool:
    """Whether a code is within one of the exact average of the samples' codes."""
    return abs(Fraction(given_code) - mean([round(each * codes) for each in samples])) <= 1


def light(code: int) -> float:
    """The light of an sRGB code."""
    share = code / 255
    return share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4


LIGHT = [light(code) for code in range(256)]


def code_of(own: float) -> int:
    """The sRGB code whose light is nearest."""
    return min(range(256), key=lambda code: abs(LIGHT[code] - own))


def right_srgb(given_code: float, samples: Sequence[float]) -> bool:
    """Whether a code is within one of the encoded average of the samples' light, of the exact light
    of their codes.
    """
    average = math.fsum(LIGHT[code_of(each)] for each in samples) / len(samples)
    back = 12.92 * average if average <= 0.0031308 else 1.055 * average ** (1 / 2.4) - 0.055
    return abs(given_code - 255 * back) <= 1


def right_small_float(given_value: float, samples: Sequence[float], mantissa: int) -> bool:
    """Whether a float is one of the two neighbours of the exact average in a format with five bits
    of exponent.
    """
    exact = mean(samples)
    unit = Fraction(2) ** (max(math.frexp(float(exact))[1] - 1, -14) - mantissa)
    return Fraction(given_value) % unit == 0 and abs(Fraction(given_value) - exact) < unit


def right_single(given_value: float, samples: Sequence[float]) -> bool:
    """Whether a float is within two units in the last place of the exact average."""
    exact = mean(samples)
    return abs(Fraction(given_value) - exact) <= 2 * Fraction(2) ** (
        math.frexp(float(exact))[1] - 24
    )


PLACES = {"R": 0, "G": 1, "B": 2, "A": 3}
FORMATS: dict[str, dict[str, Any]] = {
    "R8G8B8A8_UNORM": dict.fromkeys("RGBA", lambda g, s: right_normalised(g, s, 255)),
    "B8G8R8A8_UNORM": dict.fromkeys("RGBA", lambda g, s: right_normalised(g, s, 255)),
    "R16G16B16A16_UNORM": dict.fromkeys("RGBA", lambda g, s: right_normalised(g, s, 65535)),
    "R8G8B8A8_SRGB": {
        **dict.fromkeys("RGB", right_srgb),
        "A": lambda g, s: right_normalised(g, s, 255),
    },
    "B8G8R8A8_SRGB": {
        **dict.fromkeys("RGB", right_srgb),
        "A": lambda g, s: right_normalised(g, s, 255),
    },
    "R16G16B16A16_SFLOAT": dict.fromkeys("RGBA", lambda g, s: right_small_float(g, s, 10)),
    "R32G32B32A32_SFLOAT": dict.fromkeys("RGBA", right_single),
    "A2B10G10R10_UNORM_PACK32": {
        **dict.fromkeys("RGB", lambda g, s: right_normalised(g, s, 1023)),
        "A": lambda g, s: right_normalised(g, s, 3),
    },
    "B10G11R11_UFLOAT_PACK32": {
        **dict.fromkeys("RG", lambda g, s: right_small_float(g, s, 6)),
        "B": lambda g, s: right_small_float(g, s, 5),
    },
}
"""By format and component: whether what is stored is right for some samples."""

MIXED = 414
"""Pixels of the scene at 64x64 whose four samples are not all of one triangle."""


@pytest.mark.parametrize("form", FORMATS)
@pytest.mark.parametrize("api", [1, 2])
def test_every_way_of_resolving_gives_the_average(session: Session, form: str, api: int) -> None:
    pixels, images = drawn(session, planned(frame(form), api=api), "color")
    assert sum(any(each != samples[0] for each in samples) for samples in pixels) == MIXED
    assert set(images) == {"inline", "command", "rendering"}
    for name, image in images.items():
        assert (image.width, image.height) == (SIDE, SIDE) and set(image.planes) == set(
            FORMATS[form]
        )
        for component, plane in image.planes.items():
            resolved = {
                (code, tuple(sample[PLACES[component]] for sample in samples))
                for code, samples in zip(plane, pixels, strict=True)
            }
            wrong = [each for each in resolved if not FORMATS[form][component](*each)]
            assert not wrong, (name, component, wrong)
    # Vulkan leaves open how each way rounds; lavapipe resolves by one way.
    planes = {
        name: {part: list(plane) for part, plane in image.planes.items()}
        for name, image in images.items()
    }
    assert planes["inline"] == planes["command"] == planes["rendering"]


def test_averages_that_tell_the_ways_of_averaging_apart(session: Session) -> None:
    """What the average is not, at many pixels: sample zero, and for sRGB the average of what is
    stored.
    """
    pixels, images = drawn(session, planned(frame("R8G8B8A8_SRGB")), "color")
    red = [[round(255 * encoded(sample[0])) for sample in samples] for samples in pixels]
    assert (
        sum(
            abs(code - codes[0]) > 1
            for code, codes in zip(images["inline"].planes["R"], red, strict=True)
        )
        > 300
    )
    assert (
        sum(
            abs(code - mean(codes)) > 1
            for code, codes in zip(images["inline"].planes["R"], red, strict=True)
        )
        > 150
    )


# Where the samples are.

STANDARD = ((6, 2), (14, 6), (2, 10), (10, 14))
"""The standard sample locations of four samples, in sixteenths of a pixel."""


TRIANGLES = [CORNERS[at : at + 3] for at in range(0, len(CORNERS), 3)]


def covered(triangle: Sequence[tuple[int, int, int]], side: int) -> list[int]:
    """By sample of a square of `side` pixels: whether a triangle covers it, by edge functions in
    whole numbers of 1/256 of a pixel.
    """

    def within(x: int, y: int, edge: tuple[int, int, int, int]) -> bool:
        # Of an edge itself the samples belong to the triangle where it is a left or a top edge.
        px, py, dx, dy = edge
        value = dx * (y - py) - dy * (x - px)
        return value > 0 or (value == 0 and (dy < 0 or (dy == 0 and dx > 0)))

    (ax, ay), (bx, by), (cx, cy) = (
        (x * side + 128 * side, y * side + 128 * side) for x, y, _ in triangle
    )
    if (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) < 0:
        (bx, by), (cx, cy) = (cx, cy), (bx, by)
    edges = [(ax, ay, bx - ax, by - ay), (bx, by, cx - bx, cy - by), (cx, cy, ax - cx, ay - cy)]
    return [
        int(all(within(256 * column + 16 * across, 256 * row + 16 * down, edge) for edge in edges))
        for row in range(side)
        for column in range(side)
        for across, down in STANDARD
    ]


def shown(side: int) -> list[int]:
    """By sample: the last triangle of the scene that covers it; 0 where none does."""
    found = [0] * (side * side * len(STANDARD))
    for number, triangle in enumerate(TRIANGLES):
        if number:
            found = [
                number if inside else before
                for inside, before in zip(covered(triangle, side), found, strict=True)
            ]
    return found


def nearest(side: int) -> list[Fraction]:
    """By sample: the depth of the nearest triangle that covers it, 1 where none does."""
    found = [Fraction(1)] * (side * side * len(STANDARD))
    for triangle in TRIANGLES[1:]:
        depth = Fraction(triangle[0][2], 256)
        found = [
            min(depth, before) if inside else before
            for inside, before in zip(covered(triangle, side), found, strict=True)
        ]
    return found


def test_samples_are_at_the_standard_locations(session: Session) -> None:
    pixels, _ = drawn(session, planned(frame("R32G32B32A32_SFLOAT")), "color")
    colors = {
        n: ((n * 5 + 3) % 8 / 7, (n * 3 + 1) % 9 / 8, n * 7 % 11 / 10, (1 + n % 4) / 4)
        for n in range(1, len(TRIANGLES))
    }
    colors[0] = (0.125, 0.25, 0.5, 1.0)
    assert len(set(colors.values())) == len(colors) == 19
    expected = shown(SIDE)
    assert len(set(expected)) == 19
    read = [sample for samples in pixels for sample in samples]
    wrong = [
        n
        for n, sample in enumerate(read)
        if max(abs(a - b) for a, b in zip(sample, colors[expected[n]], strict=True)) > 1e-6
    ]
    assert not wrong, wrong[:5]
    assert sum(len(set(expected[at : at + 4])) > 1 for at in range(0, len(expected), 4)) == MIXED


@pytest.mark.parametrize(
    "moved",
    [((7, 2), (15, 6), (3, 10), (11, 14)), ((6, 3), (14, 7), (2, 11), (10, 15)), STANDARD[::-1]],
)
def test_other_locations_would_be_seen(
    monkeypatch: pytest.MonkeyPatch, moved: tuple[tuple[int, int], ...]
) -> None:
    here = shown(SIDE)
    monkeypatch.setattr("tests.experiments.confirm.test_resolve.STANDARD", moved)
    there = shown(SIDE)
    assert sum(one != other for one, other in zip(here, there, strict=True)) > 30


# What a device's resolves come to.


def depths() -> list[list[Fraction]]:
    """By pixel of a probe: the depths of its samples."""
    every = nearest(16)
    return [every[at : at + 4] for at in range(0, len(every), 4)]


def test_sample_zero_of_depth_is_sample_zero(session: Session) -> None:
    pixels, images = drawn(session, planned(depth_frame("D32_SFLOAT", "SAMPLE_ZERO")), "depth")
    expected = nearest(SIDE)
    assert [sample[0] for samples in pixels for sample in samples] == expected
    assert list(images["resolved"].planes["D"]) == expected[::4]
    assert sum(len(set(expected[at : at + 4])) > 1 for at in range(0, len(expected), 4)) == 410


@pytest.mark.parametrize("form", FORMATS)
def test_colors_do_not_deviate(session: Session, form: str) -> None:
    cache: resolving.Cache = {}
    assert deviations(session, planned(frame(form)), session.open(), cache) == []
    assert {each.way for _, each in cache} == {RENDER_PASS, RENDERING, COMMAND}


def test_average_of_depth_is_found_to_be_sample_zero(session: Session) -> None:
    """Mesa 22.3 says that lavapipe averages depth, and takes sample zero."""
    cache: resolving.Cache = {}
    (found,) = deviations(session, planned(depth_frame("D32_SFLOAT")), session.open(), cache)
    off = [abs(mean(samples) - samples[0]) for samples in depths()]
    worst = off.index(max(off))
    samples = depths()[worst]
    assert (found.x, found.y) == (worst % 16, worst // 16) == (9, 8)
    assert (
        (Fraction(found.given), Fraction(found.expected))
        == (samples[0], mean(samples))
        == (Fraction(1, 16), Fraction(49, 64))
    )
    assert found[:5] == (126, 4, RENDER_PASS, DEPTH, AVERAGE)
    assert found.text == (
        "averaging the depth of D32_SFLOAT at 4 samples in a render pass gives 0.0625 at (9, 8), "
        "which is sample 0; expected 0.765625: "
        "this is up to the driver"
    )


@pytest.mark.parametrize(
    ("form", "tolerance"),
    [("D16_UNORM", Fraction(1, 65535)), ("X8_D24_UNORM_PACK32", Fraction(1, (1 << 24) - 1))],
)
def test_average_of_depth_in_codes(session: Session, form: str, tolerance: Fraction) -> None:
    (found,) = deviations(session, planned(depth_frame(form)), session.open(), {})
    samples = depths()[found.y * 16 + found.x]
    assert (
        abs(Fraction(found.given) - samples[0]) <= tolerance
        and abs(Fraction(found.expected) - mean(samples)) <= tolerance
    )
    assert "which is sample 0" in found.text


def test_integers_and_stencil_are_known_by_their_witness(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen: dict[tuple[str, int], tuple[int, int]] = {}
    original = resolving.judged

    def spied(
        name: str,
        resolve: Resolve,
        aspect: int,
        mode: int,
        samples: resolving.Samples,
        image: Texels,
    ) -> Deviation | None:
        known = [each for each in samples if each is not None]
        seen[resolve.way, aspect] = (
            len(known),
            sum(any(each != own[0] for each in own) for own in known),
        )
        return original(name, resolve, aspect, mode, samples, image)

    monkeypatch.setattr(resolving, "judged", spied)
    device = session.open()
    assert (
        deviations(session, planned(frame("R8G8B8A8_UINT", mode="SAMPLE_ZERO")), device, {}) == []
    )
    assert seen == {(way, COLOR): (1016, 195) for way in (RENDER_PASS, RENDERING, COMMAND)}
    seen.clear()
    assert (
        deviations(
            session,
            planned(depth_frame("D24_UNORM_S8_UINT", "SAMPLE_ZERO", "SAMPLE_ZERO")),
            device,
            {},
        )
        == []
    )
    assert seen == {(RENDER_PASS, DEPTH): (1024, 204), (RENDER_PASS, STENCIL): (1024, 166)}


class Spied:
    """A session whose runs are counted, and what its frames left changed."""

    def __init__(self, session: Session, change: Mapping[str, Any] | None = None) -> None:
        self.session = session
        self.change = change or {}
        self.runs = 0
        self.folder = session.folder

    def run(self, *arguments: Any) -> FrameRun:
        self.runs += 1
        found = self.session.run(*arguments)
        for name, change in self.change.items():
            path = Path(found.images[name]["path"])
            path.write_bytes(change(path.read_bytes()))
        return found


def test_a_way_of_resolving_is_probed_once(session: Session) -> None:
    spied: Any = Spied(session)
    cache: resolving.Cache = {}
    device = session.open()
    both = planned(frame("R8G8B8A8_UNORM"))
    assert deviations(spied, both, device, cache) == [] and spied.runs == 1
    assert deviations(spied, both, device, cache) == [] and spied.runs == 1
    first = deviations(spied, planned(depth_frame("D32_SFLOAT")), device, cache)
    again = deviations(spied, planned(depth_frame("D32_SFLOAT", side=32)), device, cache)
    assert first == again and len(first) == 1 and spied.runs == 2
    other = {**device, "properties": {**device["properties"], "deviceName": "another"}}
    deviations(spied, both, other, cache)
    assert spied.runs == 3


def test_what_the_device_cannot_do_is_not_probed(session: Session) -> None:
    spied: Any = Spied(session)
    device = session.open()
    assert deviations(spied, planned(depth_frame("D32_SFLOAT", "MIN")), device, {}) == []
    assert deviations(spied, planned(frame("R8G8B8A8_UNORM", samples=8)), device, {}) == []
    assert (
        deviations(spied, planned("images: {a: {format: R8G8B8A8_UNORM, samples: 4}}"), device, {})
        == []
    )
    assert spied.runs == 0


def test_zeros_in_place_of_what_was_resolved_are_seen(session: Session) -> None:
    """Whatever way, format and aspect: a driver that resolves nothing deviates."""
    device = session.open()

    def words(text: str, changed: Sequence[str]) -> list[str]:
        spied: Any = Spied(session, dict.fromkeys(changed, lambda data: bytes(len(data))))
        return [each.text for each in deviations(spied, planned(text), device, {})]

    by_way = words(frame("R8G8B8A8_UNORM"), ["0", "1", "2"])
    assert [each.partition(" at 4 samples in ")[2].partition(" gives 0 in ")[0] for each in by_way] == [
        "a render pass", "vkCmdResolveImage", "dynamic rendering"
    ]  # fmt: skip
    assert by_way[1].endswith(
        "this is up to the driver, because Vulkan does not specify how this command resolves"
    )
    assert by_way[0].endswith(": this is up to the driver")
    assert len(words(frame("R16G16B16A16_SFLOAT"), ["1"])) == 1
    integers = words(frame("R8G8B8A8_UINT", mode="SAMPLE_ZERO"), ["0", "1", "2"])
    assert [" at 4 samples in a render pass gives 0" in integers[0], len(integers)] == [True, 3]
    stencil = words(depth_frame("D24_UNORM_S8_UINT", "SAMPLE_ZERO", "SAMPLE_ZERO"), ["0:stencil"])
    (of_stencil,) = stencil
    assert of_stencil.startswith(
        "taking sample 0 of the stencil of D24_UNORM_S8_UINT at 4 samples in a render pass gives 0 "
        "at "
    )
    assert of_stencil.endswith("; expected 1: this is up to the driver")


def test_one_wrong_integer_is_seen(session: Session) -> None:
    spied: Any = Spied(session, {"0": lambda data: data[:-4] + b"\xfe\xfd\xfc\xfb"})
    (found,) = deviations(
        spied, planned(frame("R8G8B8A8_UINT", mode="SAMPLE_ZERO")), session.open(), {}
    )
    assert (found.x, found.y, found.aspect, found.mode, found.given, found.expected) == (
        31,
        31,
        COLOR,
        ZERO,
        254,
        3,
    )
    assert found.text.startswith(
        "taking sample 0 of R8G8B8A8_UINT at 4 samples in a render pass gives 254 in R at (31, "
        "31); expected 3"
    )


class Dying:
    """A session whose driver dies of everything."""

    def __init__(self, how: str, folder: Path) -> None:
        self.how = how
        self.path = str(folder)

    def folder(self, name: str) -> str:
        return self.path

    def run(self, plan: Any, passes: Sequence[int], want: Any) -> FrameRun:
        if self.how == "unusable":
            raise Unusable("no device opens any more")
        if self.how == "uncreated":
            return FrameRun(
                {n: PassOutcome(n, created=False, error="VK_ERROR_UNKNOWN") for n in passes}
            )
        return FrameRun(
            {n: PassOutcome(n, end="died", signal="SIGSEGV") for n in passes}, whole=False
        )


@pytest.mark.parametrize("how", ["dies", "unusable", "uncreated"])
def test_a_driver_that_dies_of_a_probe_is_no_finding(
    session: Session, tmp_path: Path, how: str
) -> None:
    dying: Any = Dying(how, tmp_path)
    assert deviations(dying, planned(depth_frame("D32_SFLOAT")), session.open(), {}) == []


# The comparison, with samples that are made up.


def image(form: str, width: int, **planes: Sequence[float]) -> Texels:
    found = format_of(form)
    assert found is not None
    (plane, *_) = planes.values()
    numeric = found.numeric or (found.depth_type if "D" in planes else "UINT")
    aspect = "color" if "R" in planes else "depth" if "D" in planes else "stencil"
    return Texels(width, len(plane) // width, numeric, dict(planes), dict(found.components), aspect)


def told(
    form: str,
    mode: int,
    samples: Sequence[Sequence[float]],
    values: Sequence[float],
    way: str = RENDER_PASS,
) -> Deviation | None:
    """What is told of one row of pixels, of formats with a single component."""
    found = format_of(form)
    assert found is not None
    aspect = COLOR if "color" in found.aspects else DEPTH if "depth" in found.aspects else STENCIL
    name = {COLOR: "R", DEPTH: "D", STENCIL: "S"}[aspect]
    resolve = Resolve(way, VALUES["VkFormat"][form], len(samples[0]), aspect, mode)
    four = [[(each, 0.0, 0.0, 1.0) for each in pixel] for pixel in samples]
    return judged(form, resolve, aspect, mode, four, image(form, len(samples), **{name: values}))


def test_a_wrong_average_is_told() -> None:
    samples = [[0.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 0.0]]
    assert told("R8_UNORM", AVERAGE, samples, [64, 127]) is None
    assert told("R8_UNORM", AVERAGE, samples, [63, 128]) is None
    found = told("R8_UNORM", AVERAGE, samples, [63, 130])
    assert found is not None and (found.x, found.y, found.given, found.expected) == (
        1,
        0,
        130 / 255,
        0.5,
    )
    assert (
        found.text
        == "averaging R8_UNORM at 4 samples in a render pass gives 0.509804 in R at (1, 0); "
        "expected 0.5: this is up to the driver"
    )
    # 63.75: 64 and 63 are beside it, 65 is further off than one, and so is 62.
    assert (
        told("R8_UNORM", AVERAGE, samples, [65, 127]) is not None
        and told("R8_UNORM", AVERAGE, samples, [62, 127]) is not None
    )


def test_the_pixel_furthest_off_is_told() -> None:
    found = told("R8_UNORM", AVERAGE, [[0.0, 1.0]] * 4, [127, 120, 255, 0])
    assert found is not None and (found.x, found.given) == (2, 1.0)


def test_an_average_of_encoded_srgb_is_told() -> None:
    samples = [[0.0, 0.0, 1.0, 1.0], [decoded(10 / 255)] * 4]
    due_code = round(255 * encoded(0.5))
    assert due_code == 188
    assert told("R8_SRGB", AVERAGE, samples, [188, 10]) is None
    assert told("R8_SRGB", AVERAGE, samples, [187, 11]) is None
    found = told("R8_SRGB", AVERAGE, samples, [128, 10])
    assert found is not None and found.text == (
        "averaging R8_SRGB at 4 samples in a render pass gives 0.501961 as stored in R at (0, 0), "
        "which is the average of the "
        "encoded values instead of the light; expected 0.735357: this is up to the driver, because "
        "Vulkan does not require linear light"
    )


def test_an_overflow_of_half_floats_is_told() -> None:
    samples = [[65504.0] * 4]
    assert told("R16_SFLOAT", AVERAGE, samples, [65504.0]) is None
    found = told("R16_SFLOAT", AVERAGE, samples, [math.inf])
    assert found is not None and found.text.startswith(
        "averaging R16_SFLOAT at 4 samples in a render pass gives inf in R at (0, 0); expected "
        "65504"
    )
    assert told("R16_SFLOAT", AVERAGE, [[20000.0] * 4], [16376.0]) is not None


@pytest.mark.parametrize(
    ("samples", "right", "wrong"),
    [
        ([math.inf, 1.0, 1.0, 1.0], math.inf, 16376.0),
        ([-math.inf, 1.0, 1.0, 1.0], -math.inf, math.inf),
        ([math.inf, -math.inf, 0.0, 0.0], math.nan, 0.0),
        ([math.nan, 1.0, 1.0, 1.0], math.nan, 1.0),
        ([1.0, 1.0, 1.0, 1.0], 1.0, math.nan),
        ([1.0, 1.0, 1.0, 1.0], 1.0, math.inf),
    ],
)
@pytest.mark.parametrize("form", ["R16_SFLOAT", "R32_SFLOAT"])
def test_infinities_and_what_is_no_number_are_told(
    form: str, samples: list[float], right: float, wrong: float
) -> None:
    assert told(form, AVERAGE, [samples], [right]) is None
    found = told(form, AVERAGE, [samples], [wrong])
    assert found is not None and (found.given == wrong or math.isnan(wrong))


def test_order_of_adding_is_free() -> None:
    """In single precision 2^-24 is lost at 1 three times, and kept where the three are added first:
    1.5 units lie between.
    """
    samples = [[1.0, 2.0**-24, 2.0**-24, 2.0**-24]]
    assert told("R32_SFLOAT", AVERAGE, samples, [0.25]) is None
    assert told("R32_SFLOAT", AVERAGE, samples, [0.25 + 2.0**-25]) is None
    assert told("R32_SFLOAT", AVERAGE, samples, [0.25 - 2.0**-25]) is not None
    assert told("R32_SFLOAT", AVERAGE, samples, [0.25 + 2.0**-23 + 2.0**-25]) is not None
    # The order of these changes nothing.
    assert told("R32_SFLOAT", AVERAGE, [[1.0, 2.0**-23, 0.0, 0.0]], [0.25]) is not None


def test_what_is_subnormal_may_be_zero() -> None:
    least = 2.0**-24
    assert (
        told("R16_SFLOAT", AVERAGE, [[3 * least] * 4], [3 * least]) is None
        and told("R16_SFLOAT", AVERAGE, [[3 * least] * 4], [0.0]) is None
    )
    assert told("R16_SFLOAT", AVERAGE, [[3 * least] * 4], [7 * least]) is not None
    assert told("R16_SFLOAT", AVERAGE, [[2.0**-13, 2.0**-23 - 2.0**-13]], [0.0]) is None
    # Of a sample that counts as zero the average lacks its share.
    some = [[2.0**-13, 2.0**-13, 2.0**-15, 2.0**-15]]
    assert (
        told("R16_SFLOAT", AVERAGE, some, [2.0**-14]) is None
        and told("R16_SFLOAT", AVERAGE, some, [5 * 2.0**-16]) is None
    )
    assert told("R16_SFLOAT", AVERAGE, some, [2.0**-15]) is not None


def test_least_of_what_is_no_number_may_be_anything() -> None:
    assert (
        told("D32_SFLOAT", LEAST, [[math.nan, 0.5]], [0.5]) is None
        and told("D32_SFLOAT", LEAST, [[math.nan, 0.5]], [math.nan]) is None
    )
    assert (
        told("D32_SFLOAT", ZERO, [[0.5, math.nan]], [0.5]) is None
        and told("D32_SFLOAT", ZERO, [[0.5, math.nan]], [math.nan]) is not None
    )


def test_least_and_greatest_swapped_are_told() -> None:
    samples = [[0.5, 0.25, 0.75, 1.0], [0.25, 0.5, 0.5, 0.125]]
    least, greatest = [0.25, 0.125], [1.0, 0.5]
    assert (
        told("D32_SFLOAT", LEAST, samples, least) is None
        and told("D32_SFLOAT", GREATEST, samples, greatest) is None
    )
    one, other = (
        told("D32_SFLOAT", LEAST, samples, greatest),
        told("D32_SFLOAT", GREATEST, samples, least),
    )
    assert one is not None and other is not None
    assert one.text == (
        "taking the minimum of the depth of D32_SFLOAT at 4 samples in a render pass gives 1 at "
        "(0, 0), which is the maximum of the "
        "samples; expected 0.25: this is up to the driver"
    )
    assert (
        "taking the maximum of the depth" in other.text
        and "which is the minimum of the samples; expected 1" in other.text
    )


def test_sample_zero_is_that_very_sample() -> None:
    assert told("D32_SFLOAT", ZERO, [[0.25, 0.5, 0.5, 0.5]], [0.25]) is None
    found = told("D32_SFLOAT", ZERO, [[0.25, 0.5, 0.5, 0.5]], [0.4375])
    assert found is not None and "which is the average of the samples" in found.text
    assert told("D32_SFLOAT", ZERO, [[0.25, 0.5, 0.5, 0.5]], [0.25000003]) is not None
    assert (
        told("D16_UNORM", ZERO, [[100 / 65535, 1.0]], [100]) is None
        and told("D16_UNORM", ZERO, [[100 / 65535, 1.0]], [101]) is not None
    )
    # The samples of 24 bits are read as single precision.
    assert told("X8_D24_UNORM_PACK32", ZERO, [[1.0, 0.0]], [(1 << 24) - 2]) is None
    assert told("X8_D24_UNORM_PACK32", ZERO, [[1.0, 0.0]], [(1 << 24) - 3]) is not None


def test_integers_by_a_pass_and_by_a_command() -> None:
    """A pass takes sample zero; a command any of the samples, never their average."""
    assert told("R8_UINT", ZERO, [[4.0, 8.0, 8.0, 8.0]], [4]) is None
    found = told(
        "R8_UINT", ZERO, [[4.0, 8.0, 8.0, 9.0], [4.0, 4.0, 4.0, 5.0], [7.0] * 4], [9, 5, 7]
    )
    assert found is not None and found.text == (
        "taking sample 0 of R8_UINT at 4 samples in a render pass gives 9 in R at (0, 0), which is "
        "sample 3; "
        "expected 4: this is up to the driver"
    )
    assert told("R8_UINT", ZERO, [[4.0, 8.0, 8.0, 8.0]], [8], COMMAND) is None
    assert told("R8_UINT", ZERO, [[4.0, 8.0, 8.0, 8.0]], [7], COMMAND) is not None


def test_stencil() -> None:
    assert told("S8_UINT", GREATEST, [[0.0, 1.0], [1.0, 1.0]], [1, 1]) is None
    found = told("S8_UINT", GREATEST, [[0.0, 1.0], [1.0, 1.0]], [0, 1])
    assert found is not None and found.text == (
        "taking the maximum of the stencil of S8_UINT at 2 samples in a render pass gives 0 at (0, "
        "0), which is sample 0; expected 1: "
        "this is up to the driver"
    )


def test_lowest_code_of_snorm_is_minus_one() -> None:
    near = [[-1.0, -1.0, -1.0, -125 / 127]]
    assert (
        told("R8_SNORM", AVERAGE, near, [-128]) is None
        and told("R8_SNORM", AVERAGE, near, [-127]) is None
    )
    assert told("R8_SNORM", AVERAGE, near, [-124]) is not None
    assert told("R8_SNORM", AVERAGE, [[-1.0, 1.0]], [2]) is not None


def test_pixels_that_are_not_known_are_left_out() -> None:
    resolve = Resolve(RENDER_PASS, 13, 2, COLOR, ZERO)
    assert (
        judged(
            "R8_UINT", resolve, COLOR, ZERO, [None, [(1.0,) * 4] * 2], image("R8_UINT", 2, R=[9, 1])
        )
        is None
    )
    assert (
        judged(
            "R8_UINT", resolve, COLOR, ZERO, [None, [(1.0,) * 4] * 2], image("R8_UINT", 2, R=[1, 9])
        )
        is not None
    )


def test_witness_tells_integers_by_what_is_alike_and_what_is_cleared() -> None:
    red, green, blue, cleared = (
        (1.0, 0.0, 0.0, 1.0),
        (0.0, 1.0, 0.0, 1.0),
        (0.0, 0.0, 1.0, 1.0),
        (0.1255, 0.251, 0.502, 1.0),
    )
    read = [
        [red, red],
        [green, green],
        [green, red],
        [blue, red],
        [cleared, cleared],
        [cleared, red],
    ]
    found = witnessed(read, image("R8_UINT", 6, R=[7, 9, 0, 0, 1, 0]), COLOR)
    seven, nine, clear = (7, 0, 0, 0), (9, 0, 0, 0), (3, 5, 7, 11)
    assert found == [[seven] * 2, [nine] * 2, [nine, seven], None, [clear] * 2, [clear, seven]]
    # Two bits do not hold what others are cleared to.
    found = witnessed(read, image("A2B10G10R10_UINT_PACK32", 6, R=[7, 9, 0, 0, 1, 0]), COLOR)
    assert found[4:] == [[(1, 0, 0, 0)] * 2, [(1, 0, 0, 0), seven]]
    assert witnessed([[red, cleared]], image("S8_UINT", 1, S=[0]), STENCIL) == [[(1.0,), (0.0,)]]


# Laws.

HALVES = st.floats(allow_nan=False, allow_infinity=False, width=16)
SINGLES = st.floats(
    allow_nan=False, allow_infinity=False, width=32, min_value=-(2.0**100), max_value=2.0**100
)


def single(value: float) -> float:
    """Rounded to single precision, to nearest and ties to even."""
    (found,) = struct.unpack("<f", struct.pack("<f", value))
    return float(found)


def component(form: str) -> Any:
    found = format_of(form)
    assert found is not None
    return components(found, COLOR if "color" in found.aspects else DEPTH)[0]


@given(
    st.lists(SINGLES, min_size=1, max_size=8).filter(lambda own: len(own) in (1, 2, 4, 8)),
    st.randoms(use_true_random=False),
)
def test_every_order_of_adding_in_single_precision_is_right(
    samples: list[float], random: Any
) -> None:
    expected = due(component("R32_SFLOAT"), AVERAGE, samples)
    order = list(samples)
    random.shuffle(order)
    total = order[0]
    for each in order[1:]:
        total = single(total + each)
    assert expected.met(single(total / len(order)))
    pairs = list(order)
    while len(pairs) > 1:
        pairs = [single(one + other) for one, other in zip(pairs[::2], pairs[1::2], strict=True)]
    assert expected.met(single(pairs[0] / len(order)))


@given(st.lists(HALVES, min_size=4, max_size=4))
def test_half_floats_are_rounded_either_way_and_no_further(samples: list[float]) -> None:
    own = component("R16_SFLOAT")
    expected = due(own, AVERAGE, samples)
    exact = mean(samples)
    assert Fraction(expected.value) == exact
    low, high = beside(own, expected.value)
    assert Fraction(low) <= exact <= Fraction(high) and expected.met(low) and expected.met(high)
    assert struct.unpack("<e", struct.pack("<e", expected.value))[0] in (low, high)
    # Up to 4096 times the least sample single precision adds them exactly, in every order.
    normal = [abs(each) for each in samples if each]
    if normal and sum(normal) <= 4096 * min(normal) and abs(exact) >= min(normal) >= 2.0**-14:
        unit = Fraction(2) ** (math.frexp(float(exact))[1] - 11)
        assert not expected.met(float(exact + unit)) and not expected.met(float(exact - unit))


@given(st.sampled_from([16, 32]), SINGLES.filter(bool))
def test_neighbours_are_the_ones_that_the_encoding_has(bits: int, number: float) -> None:
    if bits == 16 and abs(number) > 65504:
        number = math.copysign(65504.0, number)
    own, letters = component(f"R{bits}_SFLOAT"), {16: ("<e", "<H"), 32: ("<f", "<I")}[bits]
    (nearest_one,) = struct.unpack(letters[0], struct.pack(letters[0], number))
    low, high = beside(own, number)
    assert low <= number <= high and nearest_one in (low, high)
    codes = [
        struct.unpack(letters[1], struct.pack(letters[0], abs(each)))[0] for each in (low, high)
    ]
    assert abs(codes[0] - codes[1]) == (0 if nearest_one == number else 1)


@given(
    st.lists(st.integers(0, 255), min_size=1, max_size=16), st.sampled_from(["R8_UNORM", "R8_SRGB"])
)
def test_codes_are_found_again_and_their_average_lies_between_them(
    codes: list[int], form: str
) -> None:
    own = component(form)
    read = [single(decoded(code / 255) if form == "R8_SRGB" else code / 255) for code in codes]
    assert [stored(own, each) for each in read] == codes
    expected = due(own, AVERAGE, codes)
    assert min(codes) - 1e-9 <= expected.value <= max(codes) + 1e-9
    assert expected.met(round(expected.value)) and not expected.met(round(expected.value) + 2)
    if form == "R8_UNORM":
        assert expected.value == pytest.approx(float(mean(codes)), abs=1e-9)
    else:
        assert expected.value >= float(mean(codes)) - 1e-9


# Which resolves a plan makes.


def test_resolves_of_a_plan_by_pass() -> None:
    made = planned(frame("R8G8B8A8_UNORM"))
    assert resolves(made) == {
        0: (Resolve(RENDER_PASS, 37, 4, COLOR, AVERAGE), Resolve(COMMAND, 37, 4, COLOR, AVERAGE)),
        1: (Resolve(RENDERING, 37, 4, COLOR, AVERAGE),),
    }
    assert resolves(planned(frame("R8G8B8A8_UNORM"), samples=1)) == {}
    assert resolves(planned(frame("R32_SINT", mode="SAMPLE_ZERO")))[1] == (
        Resolve(RENDERING, 99, 4, COLOR, ZERO),
    )
    # A mode that colours do not have is no resolve.
    assert resolves(planned(frame("R8G8B8A8_UNORM", mode="SAMPLE_ZERO"))).get(1) is None


def test_resolves_of_depth_and_stencil() -> None:
    assert resolves(planned(depth_frame("D32_SFLOAT", "MAX")))[0] == (
        Resolve(RENDER_PASS, 126, 4, DEPTH, GREATEST, 0),
    )
    (both,) = resolves(planned(depth_frame("D24_UNORM_S8_UINT", "MIN", "SAMPLE_ZERO")))[0]
    assert both == Resolve(RENDER_PASS, 129, 4, DEPTH | STENCIL, LEAST, ZERO) and both.modes == [
        (DEPTH, LEAST),
        (STENCIL, ZERO),
    ]
    assert resolves(planned(depth_frame("D32_SFLOAT", "NONE"))) == {}
    (alone,) = resolves(planned(depth_frame("D24_UNORM_S8_UINT", "NONE", "MAX")))[0]
    assert alone.modes == [(STENCIL, GREATEST)]


def test_deviations_of_a_pass_are_those_that_it_shows() -> None:
    made = planned(frame("R8G8B8A8_UNORM"))
    found = [
        Deviation(form, 4, way, COLOR, AVERAGE, 0, 0, 0.0, 1.0, f"{form} {way}")
        for form in (37, 44)
        for way in (RENDER_PASS, RENDERING, COMMAND)
    ]
    assert [each.text for each in of_pass(made, 0, found)] == ["37 renderPass", "37 command"]
    assert [each.text for each in of_pass(made, 1, found)] == ["37 rendering"]
    assert of_pass(made, 7, found) == []


def test_probe_makes_all_ways_in_one_frame_and_commands_need_no_pass_of_their_own() -> None:
    made = planned(frame("R8G8B8A8_UNORM"))
    ways = [each for own in resolves(made).values() for each in own]
    whole = probe(ways, made)
    assert whole is not None and [(each.way, at) for each, at in whole.resolves] == [
        (RENDER_PASS, 0),
        (RENDERING, 1),
        (COMMAND, 1),
    ]
    assert (len(whole.plan.passes), whole.seen, whole.plan.images[0].width) == (2, ("samples",), 16)
    alone = probe([ways[1]], made)
    assert (
        alone is not None
        and len(alone.plan.passes) == 1
        and alone.plan.passes[0].subpasses[0].resolves == ()
    )
    assert probe([Resolve(RENDER_PASS, 999999, 4, COLOR, AVERAGE)], made) is None
