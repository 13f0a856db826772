"""Where frames end without presents: what repeats, and what only looks like it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from io import BytesIO
from pathlib import Path

import pytest

from msaa_lint.input.capture_input import read_capture
from tests.command import run
from tests.input.captures.program import (
    COLOR,
    D32,
    DEPTH,
    SOURCE,
    Program,
    attachment,
    codes,
    info,
    lint,
)
from tests.input.captures.test_frames import read
from tests.input.captures.test_tracking import tree
from tests.input.readers.dialects_binary import renderdoc

Area = tuple[int, int, int, int]


class Offscreen(Program):
    """A program that presents nothing. Each submission begins one pass, in a framebuffer made for
    it.
    """

    def __init__(self) -> None:
        super().__init__()
        self.clears = self.render_pass([attachment(store="STORE")])
        self.loads = self.render_pass([attachment(load="LOAD", store="STORE")])
        self.resolves = self.render_pass(
            [attachment(), attachment(samples=1, load="DONT_CARE", store="STORE")], resolve=(1,)
        )

    def submission(
        self,
        views: Sequence[int],
        render_pass: int = 0,
        pipeline: int = 0,
        area: tuple[int, int, int, int] | None = None,
    ) -> None:
        """A pass that draws to views; `area` in pixels."""
        passes = render_pass or self.clears
        framebuffer = self.framebuffer(passes, views)
        buffer = self.buffer()
        self.begin(buffer, passes, framebuffer)
        if area is not None:
            x, y, width, height = area
            rect = {"offset": {"x": x, "y": y}, "extent": {"width": width, "height": height}}
            self.calls[-1][1]["pRenderPassBegin"]["renderArea"] = rect
        self.draw(buffer, pipeline)
        self.end(buffer)
        self.submit(buffer)
        self.destroy("Framebuffer", "framebuffer", framebuffer)

    def part(self, image: int, level: int = 0, layer: int = 0) -> int:
        """A view of a mip level and layer."""
        view = self.view(image)
        self.calls[-1][1]["pCreateInfo"]["subresourceRange"] |= {
            "baseMipLevel": level,
            "baseArrayLayer": layer,
        }
        return view

    def wait(self) -> None:
        self.call(
            "vkWaitForFences", device=2, fenceCount=1, pFences=[9], waitAll=1, timeout=2**64 - 1
        )


def same_images(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    for _ in range(frames):
        program.submission([view])


def new_images(program: Offscreen, frames: int) -> None:
    for _ in range(frames):
        image = program.image()
        program.submission([program.view(image)])
        program.destroy("Image", "image", image)


def images_kept(program: Offscreen, frames: int) -> None:
    for _ in range(frames):
        program.submission([program.view(program.image())])


def resolved_to_a_ring(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    ring = [program.view(program.image(samples=1)) for _ in range(3)]
    for number in range(frames):
        program.submission([view, ring[number % 3]], program.resolves)


def ring_after_waits(program: Offscreen, frames: int) -> None:
    ring = [program.view(program.image()) for _ in range(frames)]
    for view in ring:
        program.submission([view])
        program.wait()


def shadow_main_post(program: Offscreen, frames: int) -> None:
    shadow, main, post = (program.view(program.image(samples=samples)) for samples in (1, 4, 2))
    for _ in range(frames):
        for view in (shadow, main, post):
            program.submission([view])


def faces(program: Offscreen, frames: int) -> None:
    cube, main = program.image(layers=6), program.view(program.image())
    layers = [program.part(cube, layer=layer) for layer in range(6)]
    for _ in range(frames):
        for view in (*layers, main):
            program.submission([view])


def faces_of_rendering(program: Offscreen, frames: int) -> None:
    cube = program.image(layers=6)
    layers = [program.part(cube, layer=layer) for layer in range(6)]
    for _ in range(frames):
        for view in layers:
            buffer = program.buffer()
            program.rendering(buffer, [info(view, store="STORE")])
            program.end(buffer, rendering=True)
            program.submit(buffer)


def mip_chain(program: Offscreen, frames: int) -> None:
    image = program.image()
    levels = [program.part(image, level) for level in range(12)]
    for _ in range(frames):
        for view in levels:
            program.submission([view])


def cascades(program: Offscreen, frames: int) -> None:
    images = [program.view(program.image(D32, usage=DEPTH)) for _ in range(4)]
    main = program.view(program.image())
    for _ in range(frames):
        for view in (*images, main):
            program.submission([view])


def ping_pong(program: Offscreen, frames: int) -> None:
    views = [program.view(program.image(samples=1)) for _ in range(2)]
    main = program.view(program.image())
    pipelines = [
        program.pipeline(program.clears, dynamic=[f"VK_DYNAMIC_STATE_{name}"])
        for name in ("VIEWPORT", "SCISSOR", "LINE_WIDTH")
    ]
    for _ in range(frames):
        for view, pipeline in (
            (main, 0),
            (views[0], pipelines[0]),
            (views[1], pipelines[1]),
            (views[0], pipelines[2]),
        ):
            program.submission([view], pipeline=pipeline)


def overlays(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    for _ in range(frames):
        program.submission([view])
        program.submission([view], program.loads)
        program.submission([view], program.loads)


def accumulation(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    for _ in range(frames):
        program.submission([view], program.loads)


def atlas(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    for _ in range(frames):
        for x in (0, 64, 128, 192):
            program.submission([view], area=(x, 0, 64, 64))


def dirty_areas(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    for number in range(frames):
        program.submission([view], area=(number, number, 64, 64))


def compute_between(program: Offscreen, frames: int) -> None:
    image = program.image(usage=COLOR | SOURCE)
    view = program.view(image)
    for _ in range(frames):
        for name, args in (
            ("vkCmdDispatch", {}),
            ("vkCmdCopyImageToBuffer", {"srcImage": image, "dstBuffer": 7, "pRegions": []}),
        ):
            if name == "vkCmdCopyImageToBuffer":
                program.submission([view])
            buffer = program.buffer()
            program.call(name, commandBuffer=buffer, **args)
            program.submit(buffer)
            program.wait()


def other_first_frame(program: Offscreen, frames: int) -> None:
    view, depth = program.view(program.image()), program.view(program.image(D32, usage=DEPTH))
    for number in range(frames):
        buffer = program.buffer()
        for _ in range(1 + (number == 0)):
            program.rendering(buffer, [info(view, store="STORE")])
            program.end(buffer, rendering=True)
        if number == 0:
            program.rendering(buffer, [], info(depth))
            program.end(buffer, rendering=True)
        program.submit(buffer)


def more_passes_each_time(program: Offscreen, frames: int) -> None:
    main = program.view(program.image())
    others = [program.view(program.image(samples=1)) for _ in range(frames)]
    for number in range(frames):
        buffer = program.buffer()
        for view in (main, *others[:number]):
            program.rendering(buffer, [info(view, store="STORE")])
            program.end(buffer, rendering=True)
        program.submit(buffer)


def two_buffers(program: Offscreen, frames: int) -> None:
    view = program.view(program.image())
    for _ in range(frames):
        buffers = [program.buffer(), program.buffer()]
        for buffer in buffers:
            program.rendering(buffer, [info(view, store="STORE")])
            program.end(buffer, rendering=True)
        program.submit(*buffers)


@pytest.mark.parametrize(
    "draw",
    [
        same_images, new_images, images_kept, resolved_to_a_ring, ring_after_waits,
        shadow_main_post, faces, faces_of_rendering, mip_chain,
        cascades, ping_pong, overlays, accumulation, atlas, dirty_areas, compute_between,
        other_first_frame, more_passes_each_time, two_buffers,
    ],
    ids=lambda draw: draw.__name__,
)  # fmt: skip
def test_without_presents_a_frame_is_what_repeats(draw: Callable[[Offscreen, int], None]) -> None:
    program = Offscreen()
    draw(program, 7)
    assert read(program).frames == 7


def test_frames_of_a_submission_each_are_counted_and_priced_as_such() -> None:
    program = Offscreen()
    same_images(program, 5)
    presented = Offscreen()
    presented.swap(1)
    view = presented.view(presented.image())
    for _ in range(5):
        presented.submission([view])
        presented.present()
    found, expected = (
        [each for each in lint(made.text()) if each.code == "MSAA201"]
        for made in (program, presented)
    )
    assert [each.capture_location and each.capture_location[2:] for each in found] == [(5, 5)]
    assert [each.price for each in found] == [each.price for each in expected]
    assert read(program).source.text.count("vkCreateFramebuffer") == 1, (
        "a framebuffer made anew is described again"
    )


def test_many_submissions_on_top_of_another_are_frames_in_the_end() -> None:
    program = Offscreen()
    view = program.view(program.image())
    program.submission([view])
    for _ in range(20):
        program.submission([view], program.loads)
    assert read(program).frames == 1 + 20 - 8


# What the user says.


def frames(program: Program, end: str) -> int:
    """The number of frames if they end as the user says."""
    return read_capture(
        BytesIO(program.text()), "gfxreconstruct", "p.jsonl", None, frame_end=end
    ).frames


def labeled(program: Offscreen, buffer: int, call: str, text: str = "") -> None:
    """A debug label, in a command buffer or (0) in the queue."""
    place = {"commandBuffer": buffer} if buffer else {"queue": 5}
    program.call(
        f"vk{'Cmd' if buffer else 'Queue'}{call}DebugUtilsLabelEXT",
        **place,
        **({"pLabelInfo": {"pLabelName": text}} if text else {}),
    )


def a_pass(program: Offscreen, buffer: int, view: int) -> None:
    program.rendering(buffer, [info(view, store="STORE")])
    program.end(buffer, rendering=True)


def in_one_buffer(program: Offscreen, view: int) -> None:
    """Three frames in one command buffer."""
    buffer = program.buffer()
    for _ in range(3):
        labeled(program, buffer, "Begin", "Frame")
        labeled(program, buffer, "Begin", "Shadow")
        a_pass(program, buffer, view)
        labeled(program, buffer, "End")
        a_pass(program, buffer, view)
        labeled(program, buffer, "End")
    program.submit(buffer)


def in_the_queue(program: Offscreen, view: int) -> None:
    for _ in range(3):
        labeled(program, 0, "Begin", "Frame")
        for _ in range(2):
            buffer = program.buffer()
            a_pass(program, buffer, view)
            program.submit(buffer)
        labeled(program, 0, "End")


def inserted(program: Offscreen, view: int) -> None:
    """The label is inserted in a pass, which is not divided, and before the first frame, where
    nothing ends.
    """
    labeled(program, 0, "Insert", "Frame")
    for _ in range(3):
        buffer = program.buffer()
        program.rendering(buffer, [info(view, store="STORE")])
        labeled(program, buffer, "Insert", "Frame")
        program.end(buffer, rendering=True)
        program.submit(buffer)


def across_buffers(program: Offscreen, view: int) -> None:
    """It begins in a command buffer, and ends in another."""
    for _ in range(3):
        buffers = [program.buffer(), program.buffer()]
        labeled(program, buffers[0], "Begin", "Frame")
        for buffer in buffers:
            a_pass(program, buffer, view)
        labeled(program, buffers[1], "End")
        program.submit(*buffers)


def never_ended(program: Offscreen, view: int) -> None:
    """It begins again and again."""
    for _ in range(4):
        buffer = program.buffer()
        labeled(program, buffer, "Begin", "Frame")
        a_pass(program, buffer, view)
        program.submit(buffer)


@pytest.mark.parametrize(
    "draw",
    [in_one_buffer, in_the_queue, inserted, across_buffers, never_ended],
    ids=lambda draw: draw.__name__,
)
@pytest.mark.parametrize("presents", [False, True])
def test_a_label_ends_frames(draw: Callable[[Offscreen, int], None], presents: bool) -> None:
    program = Offscreen()
    if presents:
        program.swap(1)
    draw(program, program.view(program.image()))
    if presents:
        program.present()
    # What follows the last mark is no frame.
    assert frames(program, "label:Frame") == 3


def test_each_submission_of_a_pass_or_only_presents_end_frames() -> None:
    program = Offscreen()
    program.swap(1)
    view, other = program.view(program.image()), program.view(program.image(samples=1))
    for _ in range(3):
        program.submission([view])
        buffer = program.buffer()
        program.call("vkCmdDispatch", commandBuffer=buffer)
        program.submit(buffer)
        program.submission([other])
        program.present()
    assert [frames(program, end) for end in ("present", "submit")] == [3, 6]
    assert read(program).frames == 3


def test_a_submission_after_the_last_present_is_no_frame_but_reads() -> None:
    program = Offscreen()
    program.swap(1)
    image = program.image(usage=COLOR | SOURCE)
    view = program.view(image)
    for _ in range(3):
        program.submission([view])
        program.present()
    assert codes(lint(program.text())).count("MSAA201") == 1
    buffer = program.buffer()
    program.call(
        "vkCmdCopyImageToBuffer", commandBuffer=buffer, srcImage=image, dstBuffer=7, pRegions=[]
    )
    a_pass(program, buffer, view)
    program.submit(buffer)
    assert read(program).frames == 3
    assert "MSAA201" not in codes(lint(program.text()))


def test_without_a_present_the_capture_is_one_frame_if_only_presents_end_frames() -> None:
    program = Offscreen()
    same_images(program, 3)
    made = read_capture(
        BytesIO(program.text()), "gfxreconstruct", "p.jsonl", None, frame_end="present"
    )
    assert (made.frames, made.notes) == (
        1, ("p.jsonl: the capture presents nothing, so that it is one frame: `--frame-end submit` "
            "ends frames at submissions",)
    )  # fmt: skip


def test_a_frame_of_renderdoc_is_one_frame() -> None:
    program = Offscreen()
    same_images(program, 3)
    made = read_capture(
        BytesIO(renderdoc(program.calls).text()), "renderdoc", "p.xml", None, frame_end="submit"
    )
    assert (made.frames, made.notes) == (
        1,
        ("p.xml: `--frame-end` is ignored: the capture is a single frame",),
    )


@pytest.mark.parametrize("command", ["check", "cost", "facts", "convert", "confirm"])
def test_a_label_that_the_capture_lacks_is_an_error_of_the_capture(
    command: str, tmp_path: Path
) -> None:
    program = Offscreen()
    in_the_queue(program, program.view(program.image()))
    (tmp_path / "p.jsonl").write_bytes(program.text())
    result = run(tmp_path, command, "p.jsonl", "--frame-end", "label:Frmae")
    assert result.returncode == 2
    assert (
        "has no debug label `Frmae`, which `--frame-end` names; did you mean `Frame`?"
        in result.stdout + result.stderr
    )
    if command != "confirm":
        assert run(tmp_path, command, "p.jsonl", "--frame-end=label:Frame").returncode in (0, 1)


def test_an_end_that_is_not_one_of_the_forms_is_refused(tmp_path: Path) -> None:
    for end in ("presents", "label:", "label"):
        result = run(tmp_path, "check", "x.jsonl", "--frame-end", end)
        assert result.returncode == 2 and f"unknown value `{end}` of `--frame-end`" in result.stderr


# OpenXR.


def openxr(mirror: bool, flags: object = "0x00000021") -> Program:
    """A program that draws to the images of an OpenXR swapchain, as the source of gfxreconstruct's
    converter writes its calls.
    """
    program = Program()
    if mirror:
        program.swap(1)
    info_of_swapchain = {
        "type": "XR_TYPE_SWAPCHAIN_CREATE_INFO", "createFlags": "0x00000000", "usageFlags": flags,
        "format": 37, "sampleCount": 1,
        "width": 256, "height": 128, "faceCount": 1, "arraySize": 2, "mipCount": 1, "next": None,
    }  # fmt: skip
    program.call("xrCreateSwapchain", session=20, createInfo=info_of_swapchain, swapchain=21)
    images = [
        {"type": "XR_TYPE_SWAPCHAIN_IMAGE_VULKAN_KHR", "image": handle, "next": None}
        for handle in (30, 31, 32)
    ]
    program.call(
        "xrEnumerateSwapchainImages",
        swapchain=21,
        imageCapacityInput=0,
        imageCountOutput=3,
        images=None,
    )
    program.call(
        "xrEnumerateSwapchainImages",
        swapchain=21,
        imageCapacityInput=3,
        imageCountOutput=3,
        images=images,
    )
    eye, resolved = (
        program.view(program.image(layers=2)),
        [program.view(handle) for handle in (30, 31, 32)],
    )
    for number in range(6):
        for _ in range(2):
            buffer = program.buffer()
            program.rendering(buffer, [info(eye, resolve=resolved[number % 3], store="DONT_CARE")])
            program.end(buffer, rendering=True)
            program.submit(buffer)
            if mirror:
                program.present()
        program.call("xrEndFrame", session=20, frameEndInfo={"type": "XR_TYPE_FRAME_END_INFO"})
    return program


@pytest.mark.parametrize("mirror", [False, True])
@pytest.mark.parametrize(
    "flags",
    ["0x00000021", 33, "XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT|XR_SWAPCHAIN_USAGE_SAMPLED_BIT"],
)
def test_frames_of_an_openxr_program_end_with_its_end_of_a_frame(
    mirror: bool, flags: object
) -> None:
    program = openxr(mirror, flags)
    made = read(program)
    assert made.frames == 6
    images = tree(program)["images"].values()
    swapchain_image = next(
        image for image in images if image["samples"] == 1 and image["arrayLayers"] == 2
    )
    assert swapchain_image == {
        "format": "R8G8B8A8_UNORM", "samples": 1, "usage": ["COLOR_ATTACHMENT", "SAMPLED"],
        "mipLevels": 1, "arrayLayers": 2,
        "extent": {"width": 256, "height": 128, "depth": 1}, "imageType": "2D", "mayBeRead": True,
    }  # fmt: skip
    assert not [found for found in lint(program.text()) if found.code == "MSAA201"]
