"""What is found in whole captures: frames followed, lifetimes across them, identical ones
counted.
"""

from __future__ import annotations

import io
import re

import pytest

from msaa_lint.input.capture_input import CaptureInput, read_capture
from tests.input.captures.program import (
    COLOR,
    D32,
    DEPTH,
    SAMPLED,
    SOURCE,
    Program,
    attachment,
    codes,
    info,
    lint,
)


def read(program: Program) -> CaptureInput:
    return read_capture(io.BytesIO(program.text()), "gfxreconstruct", "p.jsonl", None)


def forward(
    frames: int,
    images: int = 3,
    store: str = "STORE",
    two: bool = False,
    ms_each: bool = False,
    reuse: bool = False,
) -> Program:
    """A multisampled pass that resolves to the swapchain, frame after frame."""
    program = Program(reuse)
    swap = program.swap(images)
    multisampled = [
        program.view(program.image(usage=COLOR | 0x40)) for _ in range(images if ms_each else 1)
    ]
    output = attachment(samples=1, load="DONT_CARE", store="STORE", final="PRESENT_SRC_KHR")
    render_pass = program.render_pass([attachment(store=store), output], resolve=(1,), two=two)
    pipeline = program.pipeline(render_pass)
    buffers = [
        program.framebuffer(render_pass, [multisampled[n % len(multisampled)], program.view(each)])
        for n, each in enumerate(swap)
    ]
    for number in range(frames):
        buffer = program.buffer()
        program.begin(buffer, render_pass, buffers[number % images])
        program.draw(buffer, pipeline)
        program.end(buffer)
        program.submit(buffer)
        program.present(number % images)
    return program


@pytest.mark.parametrize("two", [False, True])
def test_a_pass_of_every_frame_is_one_finding_with_its_count_and_the_call_that_made_it(
    two: bool,
) -> None:
    program = forward(240, two=two)
    stored = [found for found in lint(program.text()) if found.code == "MSAA201"]
    assert len(stored) == 1
    made = next(
        number
        for number, (name, _) in enumerate(program.calls, 1)
        if name.startswith("vkCreateRenderPass")
    )
    name = "vkCreateRenderPass2KHR" if two else "vkCreateRenderPass"
    assert stored[0].capture_location == (name, made, 240, 240)


def test_the_place_of_a_finding_is_the_call_s_line() -> None:
    program = forward(3)
    found = next(found for found in lint(program.text()) if found.code == "MSAA201")
    made = read(program)
    assert found.span is not None
    origin = made.source.origin(found.span.start)
    assert origin is not None and origin.line is not None
    assert '"vkCreateRenderPass"' in program.lines()[origin.line - 1]
    assert made.source.text[found.span.start : found.span.end] == "STORE"


def test_a_right_frame_has_no_finding() -> None:
    assert lint(forward(5, store="DONT_CARE").text()) == []


def test_frames_with_each_swapchain_image_are_one_kind_with_alternating_framebuffers() -> None:
    text = read(forward(7)).source.text
    (begin,) = [
        line for line in text.splitlines() if "beginRenderPass" in line or "framebuffer: [" in line
    ][-1:]
    assert re.search(
        r'framebuffer: \["framebuffer 256x128 #\d+", "framebuffer 256x128 #\d+", "framebuffer '
        r'256x128 #\d+"\]',
        begin,
    )
    assert "---" not in text


def test_frames_of_two_kinds_are_two_documents_the_commonest_first() -> None:
    program = Program()
    program.swap(1)
    first, second = (program.image() for _ in range(2))
    for number in range(10):
        buffer = program.buffer()
        program.rendering(
            buffer, [info(program.view(second if number == 4 else first), store="STORE")]
        )
        program.draw(buffer)
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    # The same images alike: one kind. A pass more: another.
    buffer = program.buffer()
    for image in (first, second):
        program.rendering(buffer, [info(program.view(image), store="STORE")])
        program.end(buffer, rendering=True)
    program.submit(buffer)
    program.present()
    text = read(program).source.text
    assert text.startswith("frame: {share: 0.909091}  # 10 of 11 frames\n")
    assert text.split("---\n")[1].startswith("frame: {share: 0.0909091}  # 1 of 11 frames\n")


def test_a_rendering_that_two_kinds_of_frame_record_is_one_finding_with_the_sum_of_their_frames() -> (
    None
):
    program = Program()
    program.swap(1)
    image, other = program.view(program.image()), program.view(program.image(D32, usage=DEPTH))
    for number in range(10):
        buffer = program.buffer()
        program.rendering(buffer, [info(image, store="STORE")])
        program.end(buffer, rendering=True)
        if number == 7:
            program.rendering(buffer, [], info(other))
            program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    stored = [found for found in lint(program.text()) if found.code == "MSAA201"]
    assert [
        found.capture_location and (found.capture_location.frames, found.capture_location.of)
        for found in stored
    ] == [(10, 10)]


def history(read_back: bool, every: int = 1) -> Program:
    """Frames that draw to one of two images in turns and read the other, which the frame before
    left; or that read neither.
    """
    program = Program()
    program.swap(1)
    images = [program.image(usage=COLOR | SAMPLED) for _ in range(2)]
    views = [program.view(image) for image in images]
    sets = [program.descriptor_set() for _ in range(2)]
    for own, view in zip(sets, views, strict=True):
        program.write(own, view)
    for number in range(9):
        buffer = program.buffer()
        if read_back and number % every == 0:
            program.bind(buffer, sets[(number + 1) % 2])
        program.rendering(buffer, [info(views[number % 2], store="STORE")])
        program.draw(buffer)
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    return program


@pytest.mark.parametrize("every", [1, 3])
def test_what_a_later_frame_reads_is_not_stored_in_vain(every: int) -> None:
    assert "MSAA201" not in codes(lint(history(True, every).text()))


def test_what_no_later_frame_reads_is_stored_in_vain() -> None:
    assert "MSAA201" in codes(lint(history(False).text()))


def test_a_frame_of_another_kind_reads_what_this_one_left() -> None:
    program = Program()
    program.swap(1)
    image = program.image(usage=COLOR | SOURCE)
    view, target = program.view(image), program.image(samples=1, usage=0x2)
    for number in range(9):
        buffer = program.buffer()
        program.rendering(buffer, [info(view, store="STORE")])
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
        if number == 5:
            buffer = program.buffer()
            program.call(
                "vkCmdCopyImage",
                commandBuffer=buffer,
                srcImage=image,
                dstImage=target,
                regionCount=0,
                pRegions=[],
            )
            program.rendering(buffer, [info(view)])
            program.end(buffer, rendering=True)
            program.submit(buffer)
            program.present()
    made = read(program).source.text
    assert (
        '- readImage: {image: "color 256x128 RGBA8 4x #5", access: MEMORY_READ}  # by a later frame'
        in made
    )
    assert "MSAA201" not in codes(lint(program.text()))


def test_what_some_frames_read_has_a_reader() -> None:
    program = Program()
    program.swap(1)
    image = program.image(usage=COLOR | SOURCE)
    view, target = program.view(image), program.image(samples=1, usage=0x2)
    for number in range(9):
        buffer = program.buffer()
        program.rendering(buffer, [info(view, store="STORE")])
        program.end(buffer, rendering=True)
        if number % 3 == 0:
            program.call(
                "vkCmdCopyImage",
                commandBuffer=buffer,
                srcImage=image,
                dstImage=target,
                regionCount=0,
                pRegions=[],
            )
        program.submit(buffer)
        program.present()
    assert "MSAA201" not in codes(lint(program.text()))


@pytest.mark.parametrize("shared", [False, True])
def test_what_is_shared_with_others_may_be_read_by_them(shared: bool) -> None:
    program = forward(2)
    program.calls.clear()
    program.swap(1)
    image = program.image()
    chained = {
        "sType": "VK_STRUCTURE_TYPE_EXTERNAL_MEMORY_IMAGE_CREATE_INFO",
        "handleTypes": 1,
        "pNext": None,
    }
    name, args = program.calls[-1]
    assert name == "vkCreateImage"
    args["pCreateInfo"]["pNext"] = chained if shared else None
    view = program.view(image)
    for _ in range(3):
        buffer = program.buffer()
        program.rendering(buffer, [info(view, store="STORE")])
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    assert ("MSAA201" in codes(lint(program.text()))) is not shared


def test_a_map_of_shading_density_is_read() -> None:
    program = Program()
    views = [
        program.view(program.image()),
        program.view(program.image("VK_FORMAT_R8G8_UNORM", 1, 0x200)),
    ]
    attachments = [attachment(store="STORE"), attachment("VK_FORMAT_R8G8_UNORM", 1, "LOAD")]
    for mapped in (False, True):
        render_pass = program.render_pass(attachments)
        created = program.calls[-1][1]["pCreateInfo"]
        if mapped:
            reference = {
                "attachment": 1,
                "layout": "VK_IMAGE_LAYOUT_FRAGMENT_DENSITY_MAP_OPTIMAL_EXT",
            }
            kind = "VK_STRUCTURE_TYPE_RENDER_PASS_FRAGMENT_DENSITY_MAP_CREATE_INFO_EXT"
            created["pNext"] = {"sType": kind, "fragmentDensityMapAttachment": reference}
        buffer = program.buffer()
        program.begin(buffer, render_pass, program.framebuffer(render_pass, views))
        program.draw(buffer, program.pipeline(render_pass))
        program.end(buffer)
        program.submit(buffer)
    untouched = [found.subject for found in lint(program.text()) if found.code == "MSAA212"]
    assert untouched == ["renderPasses.pass 256x128 4x #6.attachments[1]"]


def test_without_presents_a_frame_begins_where_its_passes_begin_anew() -> None:
    program = Program()
    view = program.view(program.image())
    other = program.view(program.image(D32, usage=DEPTH))
    for _ in range(6):
        buffer = program.buffer()
        program.rendering(buffer, [info(view, store="STORE")])
        program.end(buffer, rendering=True)
        program.submit(buffer)
        buffer = program.buffer()
        program.rendering(buffer, [], info(other))
        program.end(buffer, rendering=True)
        program.submit(buffer)
    made = read(program)
    assert made.frames == 6
    assert made.source.text.count("beginRendering") == 2


def test_commands_that_were_never_submitted_are_no_frame() -> None:
    program = Program()
    render_pass = program.render_pass([attachment(store="STORE")])
    buffer = program.buffer()
    program.begin(
        buffer, render_pass, program.framebuffer(render_pass, [program.view(program.image())])
    )
    assert "commands: []" in read(program).source.text


def test_memory_does_not_grow_with_frames_that_make_their_images_anew() -> None:
    program = Program(reuse=True)
    swap = program.swap(2)
    views = [program.view(image) for image in swap]
    output = attachment(samples=1, load="DONT_CARE", store="STORE", final="PRESENT_SRC_KHR")
    for number in range(200):
        image = program.image()
        view = program.view(image)
        render_pass = program.render_pass([attachment(store="STORE"), output], resolve=(1,))
        framebuffer = program.framebuffer(render_pass, [view, views[number % 2]])
        buffer = program.buffer()
        program.begin(buffer, render_pass, framebuffer)
        program.end(buffer)
        program.submit(buffer)
        program.present(number % 2)
        program.destroy("Framebuffer", "framebuffer", framebuffer)
        program.destroy("RenderPass", "renderPass", render_pass)
        program.destroy("ImageView", "imageView", view)
        program.destroy("Image", "image", image)
    made = read(program)
    assert made.frames == 200
    assert made.source.text.count("vkCreateRenderPass") == 1
    assert made.source.text.count("vkCreateImage,") <= 9
    assert len(made.source.text) < 12_000
    found = [found for found in lint(program.text()) if found.code == "MSAA201"]
    assert [each.capture_location and each.capture_location.frames for each in found] == [200]
