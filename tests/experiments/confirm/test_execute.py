"""Plans run on lavapipe, in a child process as `confirm` does it: what is told of them, what is
drawn, and that nothing is left.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from msaa_lint.experiments.confirm.explanations import Noise
from msaa_lint.experiments.confirm.frame_results import FrameRun, RunCollector
from msaa_lint.experiments.confirm.messages import classify
from msaa_lint.experiments.confirm.parts import Plan, Stage
from msaa_lint.experiments.confirm.protocol import Event
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.confirm.texels import Texels, format_of, texels
from msaa_lint.frame.vulkan.enums import VALUES
from tests.experiments.confirm.frames import frames, planned
from tests.paths import ROOT

SIDE = 32
SIZE = f"extent: {{width: {SIDE}, height: {SIDE}}}"
CLEARED = (32, 64, 128, 255)
"""What colours are cleared to, in codes of eight bits."""


@pytest.fixture(scope="module")
def session() -> Iterator[Session]:
    """Lavapipe in a child process, under the validation layer with the checks of two vendors."""
    with Session(environment=environment(None)) as opened:
        opened.open()
        assert opened.layer is not None
        yield opened


@pytest.fixture(scope="module")
def plain() -> Iterator[Session]:
    """The same without vendors' checks, which have a word on every multisampled image that is
    kept.
    """
    with Session(environment=environment(None), vendors=()) as opened:
        opened.open()
        yield opened


class Done(NamedTuple):
    """What came of a frame: every event in order, the run, and the images that were read back, by
    name.
    """

    events: list[Event]
    run: FrameRun
    images: dict[str, Texels]

    def pixels(self, name: str) -> list[tuple[float, ...]]:
        """The components of every pixel, rows from the top."""
        return list(zip(*self.images[name].planes.values(), strict=True))


def done(session: Session, plan: Plan, **wanted: Any) -> Done:
    """A plan, run; its images without their own names where these are of an aspect
    (`depth:stencil`).
    """
    folder = session.folder("drawn")
    want = {
        "pixels": folder,
        "repeats": 0,
        "warmups": 0,
        "size": None,
        "samples_of": None,
        **wanted,
    }
    every: list[Event] = []

    class Recorded(RunCollector):
        def add(self, event: Event) -> None:
            every.append(event)
            super().add(event)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("msaa_lint.experiments.confirm.session.RunCollector", Recorded)
        run = session.run(plan, range(len(plan.passes)), want)
    images = {}
    for name, event in run.images.items():
        form = format_of(
            next(short for short, number in VALUES["VkFormat"].items() if number == event["format"])
        )
        if event["event"] == "pixels" and form is not None:
            made = texels(
                form, Path(event["path"]).read_bytes(), event["width"], str(event["aspect"])
            )
            assert made is not None and (made.width, made.height) == (
                event["width"],
                event["height"],
            )
            images[name] = made
    return Done(every, run, images)


def well(session: Session, plan: Plan, **wanted: Any) -> Done:
    """A well-formed plan, run: everything was created and went through, and the layer said nothing
    but noise.
    """
    assert not any(each.refused for each in plan.passes)
    found = done(session, plan, **wanted)
    assert found.run.whole and not found.run.failed
    assert [
        (number, ran.created, ran.error, ran.end) for number, ran in found.run.passes.items()
    ] == [(number, True, "", "") for number in range(len(plan.passes))]
    said = [
        *found.run.messages,
        *(message for ran in found.run.passes.values() for message in ran.messages),
    ]
    assert [
        each["text"] for each in said if not isinstance(classify(each["id"], each["text"]), Noise)
    ] == []
    assert not any(ran.dropped for ran in found.run.passes.values())
    return found


MS = f"samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], {SIZE}"
IMAGES = f"""
images:
  color: {{format: R8G8B8A8_UNORM, {MS}}}
  depth: {{format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT], {SIZE}}}
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], {SIZE}}}
  near: {{format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, TRANSFER_SRC], {SIZE}}}
"""
INLINE = (
    IMAGES
    + """
renderPasses:
  forward:
    attachments:
      color: {image: color, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      depth: {image: depth, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL}
      output: {image: output, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output], depthStencilAttachment: depth}
"""
)
DEPTH_RESOLVE = INLINE.replace(
    "    subpasses:\n",
    "      near: {image: near, loadOp: DONT_CARE, storeOp: STORE, finalLayout: "
    "DEPTH_STENCIL_ATTACHMENT_OPTIMAL}\n    subpasses:\n",
).replace(
    "depthStencilAttachment: depth}",
    "depthStencilAttachment: depth, depthStencilResolve: {attachment: near, depthResolveMode: "
    "SAMPLE_ZERO, stencilResolveMode: NONE}}",
)
RENDERING = (
    IMAGES
    + """
commands:
  - beginRendering:
      colorAttachments: [{image: color, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: output}]
      depthAttachment: {image: depth, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: SAMPLE_ZERO, resolveImage: near}
  - endRendering
"""
)


def kinds(events: list[Event]) -> list[tuple[str, int | None]]:
    """What is told, but for messages, with the number of its pass."""
    return [(each["event"], each.get("pass")) for each in events if each["event"] != "message"]


def test_events_in_order(session: Session) -> None:
    plan = planned(INLINE + RENDERING.partition("commands:")[0].replace(IMAGES, ""))
    found = well(session, plan)
    assert kinds(found.events) == [
        *(("pass", 0), ("created", 0)),
        *2 * [("pass", 0)],
        ("pixels", None),
        ("done", None),
    ]
    assert found.events[-1] == {"event": "done"}
    assert found.events.index({"event": "pass", "pass": 0}) < found.events.index(
        {"event": "created", "pass": 0, "ok": True, "error": ""}
    )


def test_events_of_several_passes_are_told_pass_by_pass(plain: Session) -> None:
    plan = planned(TWO_PASSES)
    assert kinds(done(plain, plan).events) == [
        *((kind, number) for number in (0, 1) for kind in ("pass", "created")), *2 * [("pass", 0),
        ("pass", 1)], ("pixels", None),
        ("defined", None), ("done", None),
    ]  # fmt: skip


def test_passes_that_are_not_asked_for_are_not_touched(plain: Session) -> None:
    plan = planned(TWO_PASSES)
    want = {"pixels": None, "repeats": 0, "warmups": 0, "size": None, "samples_of": None}
    run = plain.run(plan, [1], want)
    assert list(run.passes) == [1] and run.passes[1].created


@pytest.mark.parametrize("api", [1, 2])
def test_render_pass(session: Session, api: int) -> None:
    plan = planned(INLINE, api=api)
    assert plan.passes[0].api == api
    found = well(session, plan)
    assert set(found.images) == {"output"}
    pixels = found.pixels("output")
    assert len(pixels) == SIDE * SIDE and pixels[0] == pixels[-1] == CLEARED
    # Some twenty colours are drawn, and as many averages are made of them.
    assert len(set(pixels)) > 100


def test_dynamic_rendering_draws_what_a_render_pass_does(session: Session) -> None:
    one, other = well(session, planned(DEPTH_RESOLVE)), well(session, planned(RENDERING))
    assert set(one.images) == set(other.images) == {"output", "near"}
    for name in one.images:
        assert one.pixels(name) == other.pixels(name)


def test_depth_resolve(session: Session) -> None:
    found = well(session, planned(DEPTH_RESOLVE))
    depths = list(found.images["near"].planes["D"])
    # Depths of the scene are of 1/256, and 1 is what it is cleared to.
    assert depths[0] == 1.0 and all(each * 256 == int(each * 256) for each in depths)
    assert len(set(depths)) == 19 and min(depths) == 16 / 256
    assert found.pixels("output") == well(session, planned(INLINE)).pixels("output")


INPUT = f"""
images:
  color: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, INPUT_ATTACHMENT, TRANSIENT_ATTACHMENT], {SIZE}}}
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], {SIZE}}}
renderPasses:
  deferred:
    attachments:
      color: {{image: color, loadOp: CLEAR, storeOp: DONT_CARE}}
      output: {{image: output, loadOp: CLEAR, storeOp: STORE}}
    subpasses:
      - {{colorAttachments: [color]}}
      - {{colorAttachments: [output], inputAttachments: [color]}}
    dependencies:
      - srcSubpass: 0
        dstSubpass: 1
        srcStageMask: [COLOR_ATTACHMENT_OUTPUT]
        dstStageMask: [FRAGMENT_SHADER]
        srcAccessMask: [COLOR_ATTACHMENT_WRITE]
        dstAccessMask: [INPUT_ATTACHMENT_READ]
        dependencyFlags: [BY_REGION]
"""


@pytest.mark.parametrize("api", [1, 2])
def test_input_attachments(plain: Session, api: int) -> None:
    found = well(plain, planned(INPUT, api=api))
    assert found.pixels("output")[0] == CLEARED and len(set(found.pixels("output"))) == 19


MULTIVIEW = f"""
images:
  color: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], arrayLayers: 2, {SIZE}}}
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], arrayLayers: 2, {SIZE}}}
renderPasses:
  stereo:
    attachments:
      color: {{image: color, loadOp: CLEAR, storeOp: DONT_CARE}}
      output: {{image: output, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses:
      - {{colorAttachments: [color], resolveAttachments: [output], viewMask: 3}}
"""
STEREO_RENDERING = (
    MULTIVIEW.partition("renderPasses:")[0]
    + """
commands:
  - beginRendering:
      viewMask: 3
      colorAttachments: [{image: color, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: output}]
  - endRendering
"""
)


@pytest.mark.parametrize("text", [MULTIVIEW, STEREO_RENDERING])
def test_multiview_draws_to_every_view(session: Session, text: str) -> None:
    found = well(session, planned(text))
    image = found.images["output"]
    assert (image.width, image.height) == (SIDE, 2 * SIDE)
    pixels = found.pixels("output")
    assert pixels[: SIDE * SIDE] == pixels[SIDE * SIDE :] and len(set(pixels)) > 100


LAYERED = f"""
images:
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], arrayLayers: 3, {SIZE}}}
renderPasses:
  layered:
    attachments:
      output: {{image: output, loadOp: CLEAR, storeOp: STORE}}
    subpasses:
      - {{colorAttachments: [output]}}
framebuffers:
  all: {{renderPass: layered, attachments: [output], width: {SIDE}, height: {SIDE}, layers: 3}}
"""


def test_layers_of_a_framebuffer_are_all_cleared_and_the_first_is_drawn_to(plain: Session) -> None:
    found = well(plain, planned(LAYERED))
    assert found.images["output"].height == 3 * SIDE
    pixels = found.pixels("output")
    assert len(set(pixels[: SIDE * SIDE])) == 19
    assert set(pixels[SIDE * SIDE :]) == {CLEARED}


SUSPENDED = (
    IMAGES
    + """
commands:
  - beginRendering:
      flags: [SUSPENDING]
      colorAttachments: [{image: color, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: output}]
  - endRendering
  - beginRendering:
      flags: [RESUMING]
      colorAttachments: [{image: color, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: output}]
  - endRendering
"""
)


def test_suspended_rendering_is_resumed(session: Session) -> None:
    found = well(session, planned(SUSPENDED))
    assert len(found.run.passes) == 2
    assert found.pixels("output")[0] == CLEARED and len(set(found.pixels("output"))) > 100


TWO_PASSES = f"""
images:
  color: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT], {SIZE}}}
  output: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], {SIZE}}}
renderPasses:
  first:
    attachments:
      color: {{image: color, loadOp: CLEAR, storeOp: STORE, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
    subpasses: [{{colorAttachments: [color]}}]
  second:
    attachments:
      color: {{image: color, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL}}
      output: {{image: output, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{{colorAttachments: [color], resolveAttachments: [output]}}]
pipelines:
  nothing:
    renderPass: second
    subpass: 0
    colorBlendState: {{attachments: [{{blendEnable: false, colorWriteMask: []}}]}}
"""


def test_loading_keeps_what_a_pass_before_drew(plain: Session) -> None:
    loaded = well(plain, planned(TWO_PASSES))
    assert loaded.pixels("output") == well(
        plain, planned(INLINE.replace(", depthStencilAttachment: depth", ""))
    ).pixels("output")
    cleared = done(
        plain,
        planned(
            TWO_PASSES.replace(
                "LOAD, storeOp: STORE, initialLayout", "CLEAR, storeOp: STORE, initialLayout"
            )
        ),
    )
    assert set(cleared.pixels("output")) == {CLEARED}


TRANSFERS = f"""
images:
  color: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], {SIZE}}}
  inline: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], {SIZE}}}
  resolved: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST, TRANSFER_SRC], {SIZE}}}
  copied: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST], {SIZE}}}
  half: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST], extent: {{width: {SIDE // 2}, height: {SIDE // 2}}}}}
  cleared: {{format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_DST], {SIZE}}}
  far: {{format: D16_UNORM, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, TRANSFER_DST], {SIZE}}}
  integers: {{format: R16G16B16A16_UINT, samples: 1, usage: [TRANSFER_DST], {SIZE}}}
renderPasses:
  forward:
    attachments:
      color: {{image: color, loadOp: CLEAR, storeOp: STORE, finalLayout: TRANSFER_SRC_OPTIMAL}}
      inline: {{image: inline, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{{colorAttachments: [color], resolveAttachments: [inline]}}]
commands:
  - beginRenderPass: {{renderPass: forward}}
  - endRenderPass
  - resolveImage: {{srcImage: color, dstImage: resolved}}
  - copyImage: {{srcImage: resolved, dstImage: copied}}
  - blitImage: {{srcImage: resolved, dstImage: half}}
  - clearColorImage: {{image: cleared}}
  - clearDepthStencilImage: {{image: far}}
  - clearColorImage: {{image: integers}}
"""


def test_transfer_commands(plain: Session) -> None:
    found = well(plain, planned(TRANSFERS))
    inline = found.pixels("inline")
    assert found.pixels("resolved") == inline == found.pixels("copied") and len(set(inline)) > 100
    # Without a filter, half the size is every second pixel of every second row.
    assert found.pixels("half") == [
        inline[y * SIDE + x] for y in range(1, SIDE, 2) for x in range(1, SIDE, 2)
    ]
    assert set(found.pixels("cleared")) == {CLEARED}
    assert set(found.pixels("far")) == {(65535,)}
    assert set(found.pixels("integers")) == {(3, 5, 7, 11)}


SHADED = """
pipelines:
  own:
    renderPass: forward
    subpass: 0
    stages: [{stage: FRAGMENT, module: own.spv, name: main, specialization: {3: 2}}]
"""
SHADER = """#version 450
layout(constant_id = 3) const int quarters = 1;
layout(location = 0) out vec4 color;
void main() { color = vec4(0.0, 1.0, float(quarters) / 4.0, 1.0); }
"""


def compiled(folder: Path, text: str) -> None:
    """SPIR-V as own.spv beside a description in a folder."""
    source = folder / "own.frag"
    source.write_text(text)
    subprocess.run(
        ["glslangValidator", "-V", "-o", str(folder / "own.spv"), str(source)],
        check=True,
        capture_output=True,
    )


def test_described_shader_is_run_with_its_constants(plain: Session, tmp_path: Path) -> None:
    compiled(tmp_path, SHADER)
    text = INLINE.replace(", depthStencilAttachment: depth", "") + SHADED
    plan = planned(text, file=str(tmp_path / "frame.msaa.yaml"))
    assert [stage.path for stage in plan.passes[0].pipelines[0].stages] == [
        str(tmp_path / "own.spv"),
        "",
    ]
    pixels = well(plain, plan).pixels("output")
    drawn = (0, 255, 128, 255)
    assert {CLEARED, drawn} < set(pixels)
    # What lies between is an average of nothing else.
    assert all(
        0 <= pixel[0] <= 32 and 64 <= pixel[1] <= 255 and pixel[2] == 128 for pixel in pixels
    )
    assert len(set(pixels)) == 5


def test_described_shader_that_is_none_ends_neither_frame_nor_child(
    plain: Session, tmp_path: Path
) -> None:
    compiled(tmp_path, SHADER)
    plan = planned(INLINE + SHADED, file=str(tmp_path / "frame.msaa.yaml"))
    (tmp_path / "own.spv").unlink()
    found = done(plain, plan)
    assert found.run.failed.startswith("FileNotFoundError")
    assert well(plain, planned(INLINE)).images


@pytest.mark.parametrize(
    ("form", "expected"),
    [
        ("R8G8B8A8_UNORM", CLEARED),
        ("B8G8R8A8_UNORM", (128, 64, 32, 255)),
        ("R16G16B16A16_SFLOAT", (0.125, 0.25, 0.5, 1.0)),
        ("R8G8B8A8_SRGB", (99, 137, 188, 255)),
        ("R16G16_UINT", (3, 5)),
        ("R32_SINT", (3,)),
    ],
)
def test_clear_values(plain: Session, form: str, expected: tuple[float, ...]) -> None:
    text = f"""
images: {{output: {{format: {form}, samples: 1, usage: [COLOR_ATTACHMENT], {SIZE}}}}}
renderPasses:
  clear:
    attachments: {{output: {{image: output, loadOp: CLEAR, storeOp: STORE}}}}
    subpasses: [{{colorAttachments: [output]}}]
"""
    pixels = well(plain, planned(text)).pixels("output")
    assert pixels[0] == expected and len(set(pixels)) > 6


@pytest.mark.parametrize(("order", "far"), [("STANDARD", 1.0), ("REVERSED", 0.0)])
def test_depth_is_cleared_to_what_is_farthest(plain: Session, order: str, far: float) -> None:
    found = well(plain, planned(DEPTH_RESOLVE + f"scene: {{depth: {order}}}\n"))
    depths = list(found.images["near"].planes["D"])
    assert depths[0] == far and len(set(depths)) == 19
    assert set(found.pixels("output")) == set(well(plain, planned(DEPTH_RESOLVE)).pixels("output"))


def test_times_are_of_the_devices_clock(plain: Session) -> None:
    plan = planned(TWO_PASSES)
    found = done(plain, plan, pixels=None, repeats=3, warmups=2)
    assert found.images == {}
    timed = [each for each in found.events if each["event"] == "time"]
    assert [each["pass"] for each in timed] == [0, 1] * 3
    assert {each["source"] for each in timed} == {"timestamp"} and all(
        0 < each["ms"] < 10_000 for each in timed
    )
    for number in (0, 1):
        assert (
            len(found.run.passes[number].times) == 3
            and found.run.passes[number].source == "timestamp"
        )
    # A pass is announced once for being created and once for being drawn, not for every time.
    assert kinds(found.events).count(("pass", 0)) == 2


def test_nothing_is_timed_or_read_back_unasked(plain: Session) -> None:
    found = done(plain, planned(TWO_PASSES), pixels=None)
    assert {each["event"] for each in found.events} <= {"pass", "created", "message", "done"}


def test_samples_of_an_image(plain: Session) -> None:
    found = done(plain, planned(TWO_PASSES), samples_of="color")
    (event,) = [each for each in found.events if each["event"] == "sample"]
    own = {"image": "color", "width": SIDE, "height": SIDE, "samples": 4, "format": 37}
    assert {key: event[key] for key in own} == own
    assert os.path.getsize(event["path"]) == SIDE * SIDE * 4 * 16
    assert found.run.images["color:samples"] == event
    assert [
        each["event"]
        for each in found.events
        if each["event"] not in ("message", "pass", "created")
    ] == [
        "pixels",
        "defined",
        "sample",
        "done",
    ]


def test_samples_of_a_transient_image_are_read_all_the_same(plain: Session) -> None:
    kept = INLINE.replace(
        "image: color, loadOp: CLEAR, storeOp: DONT_CARE",
        "image: color, loadOp: CLEAR, storeOp: STORE",
    )
    found = done(plain, planned(kept), samples_of="color")
    assert [each["event"] for each in found.events].count("sample") == 1 and found.run.whole
    whole = done(plain, planned(TWO_PASSES), samples_of="color").run.images["color:samples"]
    assert os.path.getsize(whole["path"]) == SIDE * SIDE * 4 * 16


def test_samples_of_no_image_are_none(plain: Session) -> None:
    found = well(plain, planned(TWO_PASSES), samples_of="nothing of that name")
    assert not any(each["event"] == "sample" for each in found.events) and found.images


def test_size_of_pictures_is_asked_for_or_bounded(plain: Session) -> None:
    found = well(plain, planned(TWO_PASSES), size=[48, 24])
    assert (found.images["output"].width, found.images["output"].height) == (48, 24)
    large = planned(
        TWO_PASSES.replace(f"width: {SIDE}, height: {SIDE}", "width: 2048, height: 1024")
    )
    found = well(plain, large)
    assert (found.images["output"].width, found.images["output"].height) == (512, 256)


def test_every_frame_of_a_stream_runs_in_one_child(plain: Session) -> None:
    """Frames of other formats and counts, one after the other, each for itself."""
    from msaa_lint.experiments.confirm.plan import plan

    stream = "\n---\n".join([INLINE, RENDERING, TWO_PASSES, TRANSFERS])
    runs = [well(plain, plan(each)) for each in frames(stream)]
    assert (
        runs[0].pixels("output")
        == runs[1].pixels("output")
        != runs[2].pixels("output")
        == runs[3].pixels("inline")
    )


LEAKS = """
import json, os, sys, tempfile
from msaa_lint.experiments.confirm import execute
from msaa_lint.experiments.confirm.build import FrameObjects
from msaa_lint.experiments.confirm.execute import RunOptions

plans = [execute.from_json(each) for each in json.loads(sys.stdin.read())]
if "forget" in sys.argv:
    FrameObjects.close = lambda self: None
session = execute.Session(None, True, ())
said, handles, failed = [], [], 0
with tempfile.TemporaryDirectory() as folder:
    for turn in range(int(sys.argv[1])):
        plan = plans[turn % len(plans)]
        seen = next((image.name for image in plan.images if image.samples > 1 and not image.usage & 0x40), None)
        # Each in its turn is drawn, read back and timed.
        want = (RunOptions(pixels=folder, samples_of=seen), RunOptions(), RunOptions(repeats=2, warmups=1))[turn % 3]
        try:
            execute.run(session, plan, None, want, said.append)
        except FileNotFoundError:
            failed += 1
        handles.append(len(os.listdir("/proc/self/fd")))
before = len(said)
session.close()
left = [each for each in said if each["event"] == "message" and "has not been destroyed" in each["text"]]
print(json.dumps({"handles": handles, "left": len(left), "after": len(said) - before, "failed": failed, "layer": session.layer}))
"""


def leaks(tmp_path: Path, turns: int, *more: str) -> dict[str, Any]:
    """What a process says that ran so many frames and closed everything."""
    compiled(tmp_path, SHADER)
    named = str(tmp_path / "frame.msaa.yaml")
    texts = (INLINE + SHADED, RENDERING, INPUT, MULTIVIEW, SUSPENDED, TWO_PASSES, TRANSFERS)
    plans = [planned(text, file=named) for text in texts]
    # The last cannot be created: its shader is nowhere.
    broken = (
        plans[0]
        .passes[0]
        ._replace(
            pipelines=tuple(
                each._replace(stages=(Stage(16, str(tmp_path / "none.spv"), "main"),))
                for each in plans[0].passes[0].pipelines
            )
        )
    )
    plans.append(plans[0]._replace(passes=(broken,)))
    made = subprocess.run(
        [sys.executable, "-c", LEAKS, str(turns), *more],
        input=json.dumps(plans),
        capture_output=True,
        text=True,
        check=True,
        cwd=ROOT,
        env={**environment(None), "PYTHONPATH": str(ROOT)},
    )
    found: dict[str, Any] = json.loads(made.stdout.splitlines()[-1])
    return found


def test_two_hundred_frames_leave_nothing(tmp_path: Path) -> None:
    found = leaks(tmp_path, 200)
    assert found["layer"]["name"] == "VK_LAYER_KHRONOS_validation"
    assert found["failed"] == 25
    assert (found["left"], found["after"]) == (0, 0)
    assert len(found["handles"]) == 200 and found["handles"][23] == found["handles"][-1]


def test_what_is_left_would_be_seen(tmp_path: Path) -> None:
    assert leaks(tmp_path, 3, "forget")["left"] > 10
