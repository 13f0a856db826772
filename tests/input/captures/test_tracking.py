"""What a capture's calls mean: handles, bindings, descriptors, command buffers of both levels,
names.
"""

from __future__ import annotations

import io

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.capture_input import CaptureInput, read_capture
from tests.input.captures.program import (
    COLOR,
    SAMPLED,
    Program,
    attachment,
    codes,
    info,
    lint,
    written,
)


def read(program: Program) -> CaptureInput:
    return read_capture(io.BytesIO(program.text()), "gfxreconstruct", "p.jsonl", None)


def tree(program: Program) -> dict:  # type: ignore[type-arg]
    """The first document of what a capture becomes, as plain data."""
    import yaml

    return next(iter(yaml.safe_load_all(read(program).source.text)))  # type: ignore[no-any-return]


def one_pass(program: Program, view: int) -> None:
    buffer = program.buffer()
    program.rendering(buffer, [info(view, store="STORE")])
    program.draw(buffer)
    program.end(buffer, rendering=True)
    program.submit(buffer)


def test_a_handle_that_is_used_again_is_another_object() -> None:
    program = Program(reuse=True)
    first = program.image(samples=4)
    view = program.view(first)
    buffer = program.buffer()
    program.rendering(buffer, [info(view)])
    program.end(buffer, rendering=True)
    program.destroy("ImageView", "imageView", view)
    program.destroy("Image", "image", first)
    second = program.image(samples=1, usage=COLOR)
    assert second == first or program.view(second) == first
    program.submit(buffer)
    made = tree(program)
    named = made["commands"][0]["beginRendering"]["colorAttachments"][0]["image"]
    assert made["images"][named]["samples"] == 4


def test_memory_flags_are_those_of_the_type_that_the_image_is_bound_to() -> None:
    program = Program()
    types = [{"propertyFlags": 1, "heapIndex": 0}, {"propertyFlags": 17, "heapIndex": 0}]
    properties = {"memoryTypeCount": 2, "memoryTypes": types}
    program.call(
        "vkGetPhysicalDeviceMemoryProperties", physicalDevice=1, pMemoryProperties=properties
    )
    image = program.image(usage=COLOR | 0x40)
    program.call(
        "vkAllocateMemory",
        device=2,
        pAllocateInfo={"allocationSize": 4096, "memoryTypeIndex": 1},
        pMemory=77,
    )
    program.call(
        "vkBindImageMemory2KHR",
        device=2,
        bindInfoCount=1,
        pBindInfos=[{"image": image, "memory": 77, "memoryOffset": 0}],
    )
    one_pass(program, program.view(image))
    assert tree(program)["images"]["color 256x128 RGBA8 4x #3"]["memory"] == [
        "DEVICE_LOCAL",
        "LAZILY_ALLOCATED",
    ]


def test_an_imageless_framebuffer_has_the_images_of_its_begin() -> None:
    program = Program()
    views = [program.view(program.image()) for _ in range(2)]
    render_pass = program.render_pass([attachment(store="STORE")])
    framebuffer = program.framebuffer(render_pass, views[:1], imageless=True)
    program.swap(1)
    for view in views:
        buffer = program.buffer()
        program.begin(buffer, render_pass, framebuffer, [view])
        program.end(buffer)
        program.submit(buffer)
        program.present()
    made = tree(program)
    assert [each["attachments"] for each in made["framebuffers"].values()] == [
        ["color 256x128 RGBA8 4x #2"],
        ["color 256x128 RGBA8 4x #4"],
    ]
    assert made["commands"][0]["beginRenderPass"]["framebuffer"] == list(made["framebuffers"])


@pytest.mark.parametrize("how", ["bound", "pushed", "filled later", "opaque", "compute"])
def test_what_a_descriptor_shows_is_read(how: str) -> None:
    program = Program()
    image = program.image(usage=COLOR | SAMPLED)
    view, target = program.view(image), program.view(program.image(samples=1))
    own = program.descriptor_set()
    if how in ("bound", "compute"):
        program.write(own, view)
    buffer = program.buffer()
    program.rendering(buffer, [info(view, store="STORE")])
    program.end(buffer, rendering=True)
    if how == "pushed":
        pushed = {
            "pipelineBindPoint": "VK_PIPELINE_BIND_POINT_GRAPHICS",
            "set": 0,
            "pDescriptorWrites": [written(0, view)],
        }
        program.call("vkCmdPushDescriptorSetKHR", commandBuffer=buffer, **pushed)
    elif how == "opaque":
        program.call(
            "vkUpdateDescriptorSetWithTemplate", device=2, descriptorSet=own, pData="0x7f00"
        )
    if how == "compute":
        point = "VK_PIPELINE_BIND_POINT_COMPUTE"
        program.call(
            "vkCmdBindDescriptorSets",
            commandBuffer=buffer,
            pipelineBindPoint=point,
            firstSet=0,
            pDescriptorSets=[own],
        )
        program.call(
            "vkCmdDispatch", commandBuffer=buffer, groupCountX=1, groupCountY=1, groupCountZ=1
        )
    elif how != "pushed":
        program.bind(buffer, own)
    program.rendering(buffer, [info(target, store="STORE")])
    program.draw(buffer)
    program.end(buffer, rendering=True)
    if how == "filled later":
        program.write(own, view)
    program.submit(buffer)
    stage = "COMPUTE" if how == "compute" else "FRAGMENT"
    reads = [
        each["readImage"]
        for each in tree(program)["commands"]
        if isinstance(each, dict) and "readImage" in each
    ]
    image_name = "color 256x128 RGBA8 4x #2"
    assert reads == ([{"image": image_name, "stage": stage}] if how != "opaque" else [])
    assert tree(program)["images"][image_name].get("mayBeRead") == (
        True if how == "opaque" else None
    )
    assert "MSAA201" not in codes(lint(program.text()))


def test_an_input_attachment_is_read_on_the_tile_not_later() -> None:
    program = Program()
    view = program.view(program.image(usage=COLOR | 0x80))
    own = program.descriptor_set()
    program.write(own, view, kind="INPUT_ATTACHMENT")
    buffer = program.buffer()
    program.bind(buffer, own)
    program.rendering(buffer, [info(view, store="STORE")])
    program.draw(buffer)
    program.end(buffer, rendering=True)
    program.submit(buffer)
    assert "readImage" not in read(program).source.text
    assert "MSAA201" in codes(lint(program.text()))


def test_secondary_command_buffers_are_where_they_are_executed() -> None:
    program = Program()
    render_pass = program.render_pass([attachment()])
    framebuffer = program.framebuffer(render_pass, [program.view(program.image())])
    pipeline = program.pipeline(render_pass)
    secondary = program.buffer(secondary=True)
    program.draw(secondary, pipeline, vertices=3)
    program.call("vkEndCommandBuffer", commandBuffer=secondary)
    buffer = program.buffer()
    program.begin(buffer, render_pass, framebuffer)
    program.call(
        "vkCmdExecuteCommands",
        commandBuffer=buffer,
        commandBufferCount=1,
        pCommandBuffers=[secondary],
    )
    program.end(buffer)
    program.submit(buffer)
    commands = tree(program)["commands"]
    assert commands[1] == {
        "draw": {"pipeline": "pipeline 4x #6", "vertexCount": 3, "instanceCount": 1}
    }
    assert commands[2] == "endRenderPass"


def test_a_command_buffer_that_is_submitted_again_is_recorded_once() -> None:
    program = Program()
    program.swap(1)
    buffer = program.buffer()
    program.rendering(buffer, [info(program.view(program.image()), store="STORE")])
    program.end(buffer, rendering=True)
    program.call("vkEndCommandBuffer", commandBuffer=buffer)
    for _ in range(30):
        program.call(
            "vkQueueSubmit2",
            queue=5,
            submitCount=1,
            pSubmits=[{"pCommandBufferInfos": [{"commandBuffer": buffer}]}],
            fence=0,
        )
        program.present()
    found = next(found for found in lint(program.text()) if found.code == "MSAA201")
    assert found.capture_location is not None and (
        found.capture_location.frames,
        found.capture_location.of,
    ) == (30, 30)


def test_a_rendering_that_is_suspended_and_resumed_in_another_command_buffer() -> None:
    program = Program()
    view = program.view(program.image(usage=COLOR | 0x40))
    target = program.view(program.image(samples=1))
    first, second = program.buffer(), program.buffer()
    for buffer, flags in ((first, 2), (second, 4)):
        program.rendering(buffer, [info(view, resolve=target)], flags=flags)
        program.draw(buffer)
        program.end(buffer, rendering=True)
    program.submit(first, second)
    begins = [
        each["beginRendering"]["flags"]
        for each in tree(program)["commands"]
        if isinstance(each, dict) and "beginRendering" in each
    ]
    assert begins == [["SUSPENDING"], ["RESUMING"]]
    assert "MSAA207" not in codes(lint(program.text()))


def test_a_count_that_commands_set_is_that_of_the_draws_after_it() -> None:
    program = Program()
    view = program.view(program.image())
    pipeline = program.pipeline(dynamic=["VK_DYNAMIC_STATE_RASTERIZATION_SAMPLES_EXT"])
    buffer = program.buffer()
    program.rendering(buffer, [info(view)])
    for count in (4, 1, 4):
        program.call(
            "vkCmdSetRasterizationSamplesEXT",
            commandBuffer=buffer,
            rasterizationSamples=f"VK_SAMPLE_COUNT_{count}_BIT",
        )
        program.draw(buffer, pipeline, vertices=30 + count)
    program.end(buffer, rendering=True)
    program.submit(buffer)
    within = tree(program)["commands"][1:-1]
    assert [each["setRasterizationSamples"] for each in within if "draw" not in each] == [4, 1]


def test_a_renderings_like_again_is_an_alias() -> None:
    program = Program()
    view = program.view(program.image())
    buffer = program.buffer()
    for _ in range(3):
        program.rendering(buffer, [info(view, store="STORE")])
        program.end(buffer, rendering=True)
    program.submit(buffer)
    text = read(program).source.text
    assert text.count("&rendering_0") == 1
    assert text.count("*rendering_0") == 2
    assert codes(lint(program.text())).count("MSAA201") == 1


SUPPRESSION = "# msaa-lint: ignore[multisampled-attachment-stored]"
SHOWN = {
    **{
        name: name
        for name in (
            "a: {b",
            SUPPRESSION,
            "null",
            "3",
            "ключ",
            '"',
            "\\",
            "<<",
            "x-color",
            "a.b[0]",
            "*a",
            "&a",
            "{}",
            "- x",
        )
    },
    "x\n- y": "x - y",
    "\x1b[31mred": "\ufffd[31mred",
    "\u202ered\u2066": "\ufffdred\ufffd",
    "  two\t words\u00a0": "two words",
    "": "color 256x128 RGBA8 4x #2",
    "\n": "color 256x128 RGBA8 4x #2",
    "é" * 500: "é" * 77 + "...",
}


@pytest.mark.parametrize("name", SHOWN)
def test_a_name_that_the_application_gave_is_the_name_as_far_as_it_can_be_shown(name: str) -> None:
    program = Program()
    view = program.view(program.image(name=name))
    one_pass(program, view)
    made = read(program)
    (root,) = parse(Source("p", made.source.text), Limits()).documents
    assert list(root.value["images"].value) == [SHOWN[name]]
    found = lint(program.text())
    assert "MSAA201" in codes(found)
    assert codes(lint(made.source.text.encode())) == codes(found)


def test_two_objects_of_one_name_are_told_apart() -> None:
    program = Program()
    views = [program.view(program.image(name="color")) for _ in range(2)]
    for view in views:
        one_pass(program, view)
    assert list(tree(program)["images"]) == ["color", "color_2"]


def test_a_capture_that_ends_in_the_middle_is_linted_up_to_there() -> None:
    program = Program()
    one_pass(program, program.view(program.image()))
    lines = program.lines()
    data = ("\n".join(lines) + '\n{"index":99,"function":{"name":"vkCmdBegin').encode()
    found = lint(data)
    assert {"MSAA201", "MSAA901"} <= set(codes(found))
    broken = next(each for each in found if each.code == "MSAA901")
    source = read_capture(io.BytesIO(data), "gfxreconstruct", "p", None).source
    assert broken.span is not None
    origin = source.origin(broken.span.start)
    assert origin is not None and origin.line == len(lines) + 1


def test_calls_that_failed_made_nothing() -> None:
    program = Program()
    program.image()
    made = b'"args": {"device": 2, "pCreateInfo"'
    text = program.text().replace(
        b'"return": "VK_SUCCESS", ' + made, b'"return": "VK_ERROR_OUT_OF_DEVICE_MEMORY", ' + made
    )
    assert "images:" not in read_capture(io.BytesIO(text), "gfxreconstruct", "p", None).source.text


def test_draws_of_one_pipeline_are_counted() -> None:
    """Those that differ but for their counts are one command with the mean of the first pass;
    full-screen draws stay apart.
    """
    program = Program()
    view = program.view(program.image())
    first, second = program.pipeline(), program.pipeline(dynamic=["VK_DYNAMIC_STATE_VIEWPORT"])
    for _ in range(2):
        buffer = program.buffer()
        program.rendering(buffer, [info(view, store="STORE")])
        for vertices in (300, 600, 3, 3, 900):
            program.draw(buffer, first, vertices)
        program.call(
            "vkCmdDrawIndirect", commandBuffer=buffer, buffer=9, offset=0, drawCount=5, stride=16
        )
        infos = [{"firstIndex": 0, "indexCount": count, "vertexOffset": 0} for count in (36, 72)]
        program.draw(buffer, second, 60)
        program.call(
            "vkCmdDrawMultiIndexedEXT",
            commandBuffer=buffer,
            drawCount=2,
            pIndexInfo=infos,
            instanceCount=3,
        )
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    draws = [command["draw"] for command in tree(program)["commands"] if "draw" in command]
    assert [{key: value for key, value in draw.items() if key != "pipeline"} for draw in draws] == [
        {"vertexCount": 600, "instanceCount": 1, "drawCount": 3},
        {"vertexCount": 3, "instanceCount": 1, "drawCount": 2},
        {},
        {"vertexCount": 60, "instanceCount": 1},
        {"indexCount": 162, "instanceCount": 1, "drawCount": 2},
    ]
