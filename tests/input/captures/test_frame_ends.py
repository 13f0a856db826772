"""Where frames end without presents: what repeats, and what only looks like it."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import pytest

from tests.input.captures.program import COLOR, D32, DEPTH, SOURCE, Program, attachment, info, lint
from tests.input.captures.test_frames import read

Area = tuple[int, int, int, int]


class Offscreen(Program):
    """A program that presents nothing. Each submission begins one pass, in a framebuffer made for it."""

    def __init__(self) -> None:
        super().__init__()
        self.clears = self.render_pass([attachment(store="STORE")])
        self.loads = self.render_pass([attachment(load="LOAD", store="STORE")])
        self.resolves = self.render_pass([attachment(), attachment(samples=1, load="DONT_CARE", store="STORE")], resolve=(1,))

    def submission(
        self, views: Sequence[int], render_pass: int = 0, pipeline: int = 0, area: tuple[int, int, int, int] | None = None
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
        self.calls[-1][1]["pCreateInfo"]["subresourceRange"] |= {"baseMipLevel": level, "baseArrayLayer": layer}
        return view

    def wait(self) -> None:
        self.call("vkWaitForFences", device=2, fenceCount=1, pFences=[9], waitAll=1, timeout=2**64 - 1)


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
    pipelines = [program.pipeline(program.clears, dynamic=[f"VK_DYNAMIC_STATE_{name}"]) for name in ("VIEWPORT", "SCISSOR", "LINE_WIDTH")]
    for _ in range(frames):
        for view, pipeline in ((main, 0), (views[0], pipelines[0]), (views[1], pipelines[1]), (views[0], pipelines[2])):
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
        for name, args in (("vkCmdDispatch", {}), ("vkCmdCopyImageToBuffer", {"srcImage": image, "dstBuffer": 7, "pRegions": []})):
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
        same_images, new_images, images_kept, resolved_to_a_ring, ring_after_waits, shadow_main_post, faces, faces_of_rendering, mip_chain,
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
    found, expected = ([each for each in lint(made.text()) if each.code == "MSAA201"] for made in (program, presented))
    assert [each.capture_location and each.capture_location[2:] for each in found] == [(5, 5)]
    assert [each.price for each in found] == [each.price for each in expected]
    assert read(program).source.text.count("vkCreateFramebuffer") == 1, "a framebuffer made anew is described again"


def test_many_submissions_on_top_of_another_are_frames_in_the_end() -> None:
    program = Offscreen()
    view = program.view(program.image())
    program.submission([view])
    for _ in range(20):
        program.submission([view], program.loads)
    assert read(program).frames == 1 + 20 - 8
