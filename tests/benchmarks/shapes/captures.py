"""Captures: many frames, and many of what a frame has, in each format; calls that multiply what is
executed.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from tests.input.captures.program import COLOR, SAMPLED, Program, attachment, info
from tests.input.readers.dialects import api_dump, new_array
from tests.input.readers.dialects_binary import fossilize, renderdoc

from . import capture_frames
from .capture_commands import (
    Target,
    dispatches_of_sets,
    executions,
    frame,
    layouts_of_pipelines,
    many_sets,
    nested,
    nested_once,
    one_pass_submissions,
    pass_of,
    passes_of_sets,
    passes_of_unknown_sets,
    pushed_sets,
    set_copies,
    submissions,
    submissions_as_frames,
)
from .shape import Shape

NAMES = {
    "gfxreconstruct": "a.jsonl",
    "array": "a.json",
    "api_dump": "a.json",
    "renderdoc": "a.xml",
    "fossilize": "a.foz",
}


def shape(
    name: str,
    build: Callable[[Program, int], None],
    form: str = "gfxreconstruct",
    codes: tuple[int, ...] = (0, 1),
) -> Shape:
    """A shape whose program makes the calls of a size."""

    def write(folder: Path, size: int) -> None:
        program = Program()
        build(program, size)
        (folder / NAMES[form]).write_bytes(encoded(program, form))

    return Shape(f"capture: {name}", write, ("check", "--isolated", NAMES[form]), codes)


def encoded(program: Program, form: str) -> bytes:
    """The calls of a program as a tool writes them."""
    if form == "gfxreconstruct":
        return program.text()
    if form == "array":
        return new_array(program.calls)
    if form == "api_dump":
        return api_dump(program.calls)
    return renderdoc(program.calls).text() if form == "renderdoc" else fossilize(program.calls)


# Frames.


def frames(program: Program, count: int) -> None:
    program.swap()
    target = Target(program)
    for _ in range(count):
        buffer = program.buffer()
        pass_of(program, target, buffer)
        frame(program, buffer)


def new_images(program: Program, count: int) -> None:
    """Each frame draws to new images, and samples new ones."""
    program.swap()
    bound = program.descriptor_set()
    for _ in range(count):
        target = Target(program)
        program.write(bound, program.view(program.image(samples=1, usage=COLOR | SAMPLED)))
        buffer = program.buffer()
        program.bind(buffer, bound)
        pass_of(program, target, buffer)
        frame(program, buffer)


def distinct_frames(program: Program, count: int) -> None:
    """No two frames are of one kind: each has another number of passes, up to 64, and another
    render area.
    """
    program.swap()
    target = Target(program)
    for number in range(count):
        buffer = program.buffer()
        begin = {
            "renderPass": target.render_pass,
            "framebuffer": target.framebuffer,
            "clearValueCount": 1,
        }
        begin["renderArea"] = {
            "offset": {"x": 0, "y": 0},
            "extent": {"width": 1 + number % 250, "height": 1 + number // 250},
        }  # type: ignore[assignment]
        for _ in range(1 + number % 8):
            program.call(
                "vkCmdBeginRenderPass", commandBuffer=buffer, pRenderPassBegin=begin, contents=0
            )
            program.draw(buffer)
            program.end(buffer)
        frame(program, buffer)


def created_and_destroyed(program: Program, count: int) -> None:
    program.swap()
    for _ in range(count):
        target = Target(program)
        buffer = program.buffer()
        pass_of(program, target, buffer)
        frame(program, buffer)
        program.call("vkFreeCommandBuffers", device=2, commandPool=3, pCommandBuffers=[buffer])
        program.destroy("Framebuffer", "framebuffer", target.framebuffer)
        program.destroy("RenderPass", "renderPass", target.render_pass)
        program.destroy("ImageView", "imageView", target.view)
        program.destroy("Image", "image", target.image)


def swapchains(program: Program, count: int) -> None:
    """Swapchains that are made and destroyed, and many images alive meanwhile."""
    for _ in range(count):
        program.image()
        program.swap()
        program.destroy("SwapchainKHR", "swapchain", program.swapchain)


def presents(program: Program, count: int) -> None:
    program.swap()
    for _ in range(count):
        program.present()


# One frame of many.


def resolves(program: Program, count: int) -> None:
    """A frame of many resolves, of as many images."""
    program.swap()
    buffer = program.buffer()
    target = Target(program)
    pass_of(program, target, buffer)
    region = {"dstOffset": {"x": 0, "y": 0}, "extent": {"width": 256, "height": 128}}
    for _ in range(count):
        program.call(
            "vkCmdResolveImage",
            commandBuffer=buffer,
            srcImage=program.image(),
            dstImage=program.image(samples=1),
            pRegions=[region],
        )
    frame(program, buffer)


def passes(program: Program, count: int) -> None:
    """A frame of many passes, each with its own render pass, framebuffer and pipeline."""
    program.swap()
    buffer = program.buffer()
    for number in range(count):
        target = Target(program)
        program.render_pass([attachment()] * (1 + number % 8))
        program.begin(buffer, target.render_pass, target.framebuffer)
        program.draw(buffer, program.pipeline(target.render_pass))
        program.end(buffer)
    frame(program, buffer)


def renderings(program: Program, count: int) -> None:
    """A frame of many dynamic renderings."""
    program.swap()
    buffer = program.buffer()
    for _ in range(count):
        program.rendering(
            buffer,
            [info(program.view(program.image()), resolve=program.view(program.image(samples=1)))],
        )
        program.draw(buffer)
        program.end(buffer, rendering=True)
    frame(program, buffer)


def pipelines(program: Program, count: int) -> None:
    """A pass that draws with many pipelines."""
    target = Target(program)
    buffer = program.buffer()
    program.begin(buffer, target.render_pass, target.framebuffer)
    for number in range(count):
        program.call("vkCmdSetStencilReference", commandBuffer=buffer)
        pipeline = program.handle()
        create_info = {"pMultisampleState": {"rasterizationSamples": 4,
        "minSampleShading": number / (1 << 20), "sampleShadingEnable": 1},
                       "renderPass": target.render_pass}  # fmt: skip
        program.call(
            "vkCreateGraphicsPipelines",
            device=2,
            createInfoCount=1,
            pCreateInfos=[create_info],
            pPipelines=[pipeline],
        )
        program.draw(buffer, pipeline)
    program.end(buffer)
    program.submit(buffer)


def unused(program: Program, count: int) -> None:
    """Objects that no frame uses."""
    for number in range(count):
        render_pass = program.render_pass(
            [attachment()] * (1 + number % 8), color=range(1 + number % 8)
        )
        view = program.view(program.image(layers=1 + number % 2000))
        program.framebuffer(render_pass, [view])
        program.pipeline(render_pass)
    frames(program, 1)


def names(program: Program, count: int) -> None:
    """A frame of many images that share a name."""
    buffer = program.buffer()
    for _ in range(count):
        image = program.image(name="target")
        program.rendering(buffer, [info(program.view(image))])
        program.end(buffer, rendering=True)
    program.submit(buffer)


def labels(program: Program, count: int) -> None:
    """Debug labels that nest."""
    target = Target(program)
    buffer = program.buffer()
    for number in range(count):
        program.call(
            "vkCmdBeginDebugUtilsLabelEXT",
            commandBuffer=buffer,
            pLabelInfo={"pLabelName": f"label {number}"},
        )
    pass_of(program, target, buffer)
    for _ in range(count):
        program.call("vkCmdEndDebugUtilsLabelEXT", commandBuffer=buffer)
    program.submit(buffer)


def barriers(program: Program, count: int) -> None:
    target = Target(program)
    other = program.image()
    buffer = program.buffer()
    for number in range(count):
        barrier = {
            "srcAccessMask": 256,
            "dstAccessMask": 32,
            "oldLayout": 2,
            "newLayout": 5,
            "image": other,
        }
        program.call("vkCmdPipelineBarrier", commandBuffer=buffer, srcStageMask=1024,
        dstStageMask=128,
                     pImageMemoryBarriers=[barrier] * (1 + number % 3))  # fmt: skip
    pass_of(program, target, buffer)
    program.submit(buffer)


def clears(program: Program, count: int) -> None:
    """A pass with many different vkCmdClearAttachments."""
    target = Target(program)
    buffer = program.buffer()
    program.begin(buffer, target.render_pass, target.framebuffer)
    for number in range(count):
        rect = {"rect": {"offset": {"x": 0, "y": 0}, "extent": {"width": 1 + number, "height": 1}}}
        program.call(
            "vkCmdClearAttachments",
            commandBuffer=buffer,
            pAttachments=[{"aspectMask": 1, "colorAttachment": 0}],
            pRects=[rect],
        )
    program.end(buffer)
    program.submit(buffer)


def queries(program: Program, count: int) -> None:
    """A program that asks the device again and again, and makes many devices."""
    for number in range(count):
        program.call(
            "vkGetPhysicalDeviceProperties",
            physicalDevice=1,
            pProperties={"limits": {"maxColorAttachments": 8}, "apiVersion": number},
        )
        program.call(
            "vkGetPhysicalDeviceFeatures", physicalDevice=1, pFeatures={"sampleRateShading": 1}
        )
        program.call(
            "vkCreateDevice",
            physicalDevice=1,
            pCreateInfo={"ppEnabledExtensionNames": ["VK_KHR_maintenance1"]},
            pDevice=2,
        )
    frames(program, 1)


def unknown_calls(program: Program, count: int) -> None:
    for number in range(count):
        program.call(f"vkUnknown{number}", device=2, pInfo={"sType": 1})
    frames(program, 1)


def imageless(program: Program, count: int) -> None:
    """Passes over an imageless framebuffer, each with another image."""
    render_pass = program.render_pass([attachment()])
    framebuffer = program.framebuffer(render_pass, [0], imageless=True)
    buffer = program.buffer()
    for _ in range(count):
        program.begin(buffer, render_pass, framebuffer, [program.view(program.image())])
        program.end(buffer)
    program.submit(buffer)


def chained(program: Program, count: int) -> None:
    """An image whose pNext chain has many structures, 64 levels of which are looked at."""
    program.image()
    head: Any = None
    for number in range(min(count, 40)):
        head = {"sType": "VK_STRUCTURE_TYPE_X", "pNext": head, "values": [number] * count}
    program.calls[-1][1]["pCreateInfo"]["pNext"] = head
    frames(program, 1)


def layers_as_frames(program: Program, count: int) -> None:
    """Submissions without presents, each to other layers of an image: one frame, and each again:
    another one.
    """
    target = Target(program)
    for _ in range(2):
        for layer in range(count):
            view = program.view(target.image)
            program.calls[-1][1]["pCreateInfo"]["subresourceRange"]["baseArrayLayer"] = layer
            buffer = program.buffer()
            program.begin(
                buffer, target.render_pass, program.framebuffer(target.render_pass, [view])
            )
            program.end(buffer)
            program.submit(buffer)


def labeled_frames(program: Program, count: int) -> None:
    """Frames that end with a label in a single command buffer, among many other labels."""
    target = Target(program)
    buffer = program.buffer()
    for number in range(count):
        for text in ("Frame", f"Pass {number}"):
            program.call(
                "vkCmdBeginDebugUtilsLabelEXT",
                commandBuffer=buffer,
                pLabelInfo={"pLabelName": text},
            )
        pass_of(program, target, buffer)
        for _ in range(2):
            program.call("vkCmdEndDebugUtilsLabelEXT", commandBuffer=buffer)
    program.submit(buffer)


def never_alike(folder: Path, size: int) -> None:
    """Frames of which no two are alike, about 6 kB each."""
    (folder / "a.jsonl").write_bytes(b"".join(capture_frames.text(6000 * size)))


PROGRAMS: dict[str, Callable[[Program, int], None]] = {
    "frames": frames,
    "frames on new images": new_images,
    "frames of different kinds": distinct_frames,
    "objects created and destroyed": created_and_destroyed,
    "swapchains": swapchains,
    "presents": presents,
    "passes that read a set": passes_of_sets,
    "passes that read an unknown set": passes_of_unknown_sets,
    "dispatches that read a set": dispatches_of_sets,
    "copied sets": set_copies,
    "pushed sets": pushed_sets,
    "bound sets": many_sets,
    "secondary command buffers, nested": nested_once,
    "submissions of many passes as frames": submissions_as_frames,
    "submissions": one_pass_submissions,
    "resolves": resolves,
    "passes": passes,
    "renderings": renderings,
    "pipelines": pipelines,
    "unused objects": unused,
    "equal names": names,
    "labels": labels,
    "barriers": barriers,
    "queries": queries,
    "unknown calls": unknown_calls,
    "imageless framebuffer": imageless,
    "submissions to layers as frames": layers_as_frames,
}

LIMITED: dict[str, Callable[[Program, int], None]] = {
    "secondary command buffers, doubling": nested,
    "executions of a secondary": executions,
    "unknown sets of many bindings": layouts_of_pipelines,
    "submissions of many passes": submissions,
    "clears": clears,
    "chained structures": chained,
}
"""What a limit ends: it is not linear by nature, or one call."""

SHAPES = (
    *(shape(name, build) for name, build in PROGRAMS.items()),
    *(shape(name, build, codes=(0, 1, 2)) for name, build in LIMITED.items()),
    Shape(
        "capture: frames of which no two are alike", never_alike, ("check", "--isolated", "a.jsonl")
    ),
    shape("labeled frames", labeled_frames)._replace(
        arguments=("check", "--isolated", "--frame-end=label:Frame", "a.jsonl")
    ),
    *(shape(f"frames, {form}", frames, form) for form in ("array", "api_dump", "renderdoc")),
    *(shape(f"objects, {form}", unused, form) for form in ("api_dump", "renderdoc", "fossilize")),
    *(shape(f"sets, {form}", passes_of_sets, form) for form in ("api_dump", "renderdoc")),
)
