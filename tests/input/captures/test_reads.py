"""What a draw can read: by what is bound, by its pipeline's layout and shaders, and by the images'
usage and layout at that time.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from typing import Any

import pytest

from msaa_lint.input.captures import set_layouts
from tests.input.captures.program import (
    D32,
    DEPTH,
    GRAPHICS,
    SAMPLED,
    Args,
    Program,
    attachment,
    codes,
    lint,
    written,
)
from tests.input.captures.test_tracking import read, tree

ATTACHMENT, READ_ONLY, SHADER = (
    "DEPTH_STENCIL_ATTACHMENT_OPTIMAL",
    "DEPTH_STENCIL_READ_ONLY_OPTIMAL",
    "SHADER_READ_ONLY_OPTIMAL",
)
FRAGMENT, COMPUTE = 0x10, 0x20
SAMPLER_TYPE = "VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER"
BUFFER_TYPE = "VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER"

Bind = Callable[[Program, int, int], None]
"""Binds descriptors for a draw: the program, the command buffer, the view of the depth image."""


def barrier(
    program: Program, buffer: int, image: int, old: str, new: str, aspects: int = 2, **range: int
) -> None:
    """A change of an image's layout."""
    whole = {
        "baseMipLevel": 0,
        "levelCount": 0xFFFFFFFF,
        "baseArrayLayer": 0,
        "layerCount": 0xFFFFFFFF,
    }
    change = {
        "image": image,
        "oldLayout": f"VK_IMAGE_LAYOUT_{old}",
        "newLayout": f"VK_IMAGE_LAYOUT_{new}",
    }
    change["subresourceRange"] = {"aspectMask": aspects, **whole, **range}  # type: ignore[assignment]
    program.call(
        "vkCmdPipelineBarrier2",
        commandBuffer=buffer,
        pDependencyInfo={"pImageMemoryBarriers": [change]},
    )


def attached(view: int, layout: str, store: str = "STORE") -> Args:
    """A VkRenderingAttachmentInfo of an image in a layout."""
    return {
        "imageView": view, "imageLayout": f"VK_IMAGE_LAYOUT_{layout}",
        "resolveMode": "VK_RESOLVE_MODE_NONE",
        "loadOp": "VK_ATTACHMENT_LOAD_OP_CLEAR", "storeOp": f"VK_ATTACHMENT_STORE_OP_{store}",
    }  # fmt: skip


def scene(
    bind: Bind,
    layout: str | None = READ_ONLY,
    usage: int = DEPTH | SAMPLED,
    pipeline: int = 0,
    program: Program | None = None,
) -> Program:
    """Three frames that store 4x depth, change its layout, and draw to another image with what
    `bind` binds.
    """
    program = program or Program()
    program.swap(1)
    depth, target = program.image(D32, usage=usage), program.image(samples=1)
    view, target_view = program.view(depth), program.view(target)
    for _ in range(3):
        buffer = program.buffer()
        barrier(program, buffer, depth, "UNDEFINED", ATTACHMENT)
        program.rendering(buffer, [], attached(view, ATTACHMENT))
        program.draw(buffer)
        program.end(buffer, rendering=True)
        if layout is not None:
            barrier(program, buffer, depth, ATTACHMENT, layout)
        program.rendering(buffer, [attached(target_view, "COLOR_ATTACHMENT_OPTIMAL")])
        bind(program, buffer, view)
        program.draw(buffer, pipeline)
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()
    return program


def depth_of(program: Program) -> tuple[bool, int]:
    """Whether the depth image may be read, and how many reads of it are described."""
    document = tree(program)
    (name,) = [name for name in document["images"] if name.startswith("depth")]
    reads = [
        each
        for each in document["commands"]
        if isinstance(each, dict) and each.get("readImage", {}).get("image") == name
    ]
    return bool(document["images"][name].get("mayBeRead")), len(reads)


UNREAD, POSSIBLE, READ = (False, 0), (True, 0), (False, 1)


def unknown_set(program: Program, buffer: int, view: int) -> None:
    """Binds a set that a template has written, of which the capture has an address."""
    own = program.descriptor_set()
    program.call(
        "vkUpdateDescriptorSetWithTemplate",
        device=2,
        descriptorSet=own,
        descriptorUpdateTemplate=77,
        pData="0x7f00",
    )
    program.bind(buffer, own)


def known_set(program: Program, buffer: int, view: int) -> None:
    """Binds a set that holds the view."""
    own = program.descriptor_set()
    program.write(own, view)
    program.bind(buffer, own)


def set_layout(program: Program, *bindings: tuple[int, str, int, int]) -> int:
    """A set layout of bindings: number, type, count, stages."""
    made = program.handle()
    members = ("binding", "descriptorType", "descriptorCount", "stageFlags")
    listed = [dict(zip(members, each, strict=True)) for each in bindings]
    program.call(
        "vkCreateDescriptorSetLayout",
        device=2,
        pCreateInfo={"bindingCount": len(listed), "pBindings": listed},
        pSetLayout=made,
    )
    return made


def pipeline_layout(program: Program, *sets: int) -> int:
    made = program.handle()
    info = {"setLayoutCount": len(sets), "pSetLayouts": list(sets)}
    program.call("vkCreatePipelineLayout", device=2, pCreateInfo=info, pPipelineLayout=made)
    return made


def pipeline(program: Program, layout: int, stages: Sequence[Args] = ()) -> int:
    made = program.pipeline(samples=1)
    program.calls[-1][1]["pCreateInfos"][0].update({"layout": layout, "pStages": list(stages)})
    return made


def template(program: Program, *entries: tuple[int, str, int], point: str = GRAPHICS) -> int:
    """A template of entries: binding, type, count."""
    made = program.handle()
    listed = [
        {"dstBinding": b, "dstArrayElement": 0, "descriptorCount": n, "descriptorType": t}
        for b, t, n in entries
    ]
    info = {"pDescriptorUpdateEntries": listed, "pipelineBindPoint": point}
    program.call(
        "vkCreateDescriptorUpdateTemplate",
        device=2,
        pCreateInfo=info,
        pDescriptorUpdateTemplate=made,
    )
    return made


def shape_of_data(layouts: Sequence[str]) -> Args:
    """The data of a template as gfxreconstruct 0.9 writes it: structures without handles."""
    infos = [
        {
            "sampler": "VK_NULL_HANDLE",
            "imageView": "VK_NULL_HANDLE",
            "imageLayout": f"VK_IMAGE_LAYOUT_{each}",
        }
        for each in layouts
    ]
    return {
        "dstBinding": 0,
        "descriptorCount": len(infos),
        "descriptorType": "VK_DESCRIPTOR_TYPE_SAMPLER",
        "pImageInfo": infos or None,
    }


# Layouts and usage.


@pytest.mark.parametrize(
    ("layout", "answer"),
    [
        (None, UNREAD),
        ("TRANSFER_SRC_OPTIMAL", UNREAD),
        (READ_ONLY, POSSIBLE),
        (SHADER, POSSIBLE),
        ("GENERAL", POSSIBLE),
        ("READ_ONLY_OPTIMAL", POSSIBLE),
        ("DEPTH_READ_ONLY_OPTIMAL", POSSIBLE),
        ("ATTACHMENT_FEEDBACK_LOOP_OPTIMAL_EXT", POSSIBLE),
        ("OF_THE_FUTURE", POSSIBLE),
    ],
)
def test_unknown_descriptors_hold_what_is_in_a_layout_for_shaders(
    layout: str | None, answer: tuple[bool, int]
) -> None:
    program = scene(unknown_set, layout)
    assert depth_of(program) == answer
    found = codes(lint(program.text()))
    assert ("MSAA203" in found, "MSAA401" in found) == (
        (True, True) if answer == UNREAD else (False, False)
    )
    assert "MSAA307" not in found


def test_an_image_that_cannot_be_sampled_is_not_in_a_descriptor() -> None:
    assert depth_of(scene(unknown_set, "GENERAL", usage=DEPTH)) == UNREAD


def test_a_layout_that_a_part_of_an_image_has_may_be_that_of_the_part_that_is_read() -> None:
    program = Program()
    depth = program.image(D32, usage=DEPTH | SAMPLED, layers=2)
    buffer = program.buffer()
    barrier(program, buffer, depth, "UNDEFINED", "GENERAL")
    barrier(program, buffer, depth, "GENERAL", ATTACHMENT, layerCount=1)
    program.rendering(buffer, [], attached(program.view(depth), ATTACHMENT))
    unknown_set(program, buffer, 0)
    program.draw(buffer)
    program.end(buffer, rendering=True)
    program.submit(buffer)
    assert depth_of(program) == POSSIBLE


@pytest.mark.parametrize("final", [SHADER, ATTACHMENT])
def test_a_render_pass_leaves_its_attachments_in_their_final_layouts(final: str) -> None:
    program = Program()
    view = program.view(program.image(D32, usage=DEPTH | SAMPLED))
    render_pass = program.render_pass([attachment(D32, store="STORE", final=final)], (), depth=0)
    subpass = program.calls[-1][1]["pCreateInfo"]["pSubpasses"][0]
    subpass["pDepthStencilAttachment"]["layout"] = f"VK_IMAGE_LAYOUT_{ATTACHMENT}"
    framebuffer, target = (
        program.framebuffer(render_pass, [view]),
        program.view(program.image(samples=1)),
    )
    for _ in range(2):
        buffer = program.buffer()
        program.begin(buffer, render_pass, framebuffer)
        unknown_set(program, buffer, view)
        program.draw(buffer)
        program.end(buffer)
        if _ == 0:
            program.rendering(buffer, [attached(target, "COLOR_ATTACHMENT_OPTIMAL")])
            program.draw(buffer)
            program.end(buffer, rendering=True)
        program.submit(buffer)
    assert depth_of(program) == (POSSIBLE if final == SHADER else UNREAD)


@pytest.mark.parametrize("readable_first", [True, False])
def test_layouts_change_in_the_order_of_submission(readable_first: bool) -> None:
    program = Program()
    depth = program.image(D32, usage=DEPTH | SAMPLED)
    view, target = program.view(depth), program.view(program.image(samples=1))
    change, draw = program.buffer(), program.buffer()
    barrier(program, change, depth, ATTACHMENT, READ_ONLY)
    program.rendering(draw, [attached(target, "COLOR_ATTACHMENT_OPTIMAL")])
    unknown_set(program, draw, view)
    program.draw(draw)
    program.end(draw, rendering=True)
    first = program.buffer()
    barrier(program, first, depth, "UNDEFINED", ATTACHMENT)
    program.rendering(first, [], attached(view, ATTACHMENT))
    program.end(first, rendering=True)
    program.submit(first, *((change, draw) if readable_first else (draw, change)))
    assert depth_of(program) == (POSSIBLE if readable_first else UNREAD)


@pytest.mark.parametrize(
    ("first", "answer"),
    [(ATTACHMENT, UNREAD), ("UNDEFINED", UNREAD), (READ_ONLY, POSSIBLE), (None, POSSIBLE)],
)
def test_the_first_command_of_a_trimmed_capture_tells_the_layout_before_it(
    first: str | None, answer: tuple[bool, int]
) -> None:
    program = Program()
    depth = program.image(D32, usage=DEPTH | SAMPLED)
    view, target = program.view(depth), program.view(program.image(samples=1))
    for _ in range(2):
        buffer = program.buffer()
        program.rendering(buffer, [attached(target, "COLOR_ATTACHMENT_OPTIMAL")])
        unknown_set(program, buffer, view)
        program.draw(buffer)
        program.end(buffer, rendering=True)
        if first is not None:
            barrier(program, buffer, depth, first, ATTACHMENT)
            program.rendering(buffer, [], attached(view, ATTACHMENT))
        else:
            program.call("vkCmdClearDepthStencilImage", commandBuffer=buffer, image=depth)
            program.rendering(
                buffer, [attached(target, "COLOR_ATTACHMENT_OPTIMAL")], attached(view, "GENERAL")
            )
        program.end(buffer, rendering=True)
        program.submit(buffer)
        first = ATTACHMENT if first is not None else None
    head, *lines = program.lines()
    marker = '{"index": 0, "state": {"marker_type": "BeginMarker"}}'
    import io

    import yaml

    from msaa_lint.input.capture_input import read_capture

    data = "\n".join([head.replace("p.gfxr", "p_frames_3_through_6.gfxr"), marker, *lines]).encode()
    document = yaml.safe_load(
        read_capture(io.BytesIO(data), "gfxreconstruct", "p", None).source.text
    )
    (image,) = [image for name, image in document["images"].items() if name.startswith("depth")]
    assert bool(image.get("mayBeRead")) == (answer == POSSIBLE)


# Templates.


@pytest.mark.parametrize("pushed", [False, True])
@pytest.mark.parametrize(
    ("entries", "layouts", "answer"),
    [
        ([(0, BUFFER_TYPE, 5)], [], UNREAD),
        ([(0, "VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT", 1)], [READ_ONLY], UNREAD),
        ([(0, SAMPLER_TYPE, 1)], [READ_ONLY], POSSIBLE),
        ([(0, SAMPLER_TYPE, 1)], [SHADER], UNREAD),
        ([(0, SAMPLER_TYPE, 1)], ["UNDEFINED"], UNREAD),
        ([(0, SAMPLER_TYPE, 1)], [], POSSIBLE),
        ([(0, SAMPLER_TYPE, 2)], [SHADER, READ_ONLY], POSSIBLE),
        ([(0, "VK_DESCRIPTOR_TYPE_SAMPLER", 1), (1, SAMPLER_TYPE, 1)], [READ_ONLY, SHADER], UNREAD),
        ([(0, "VK_DESCRIPTOR_TYPE_STORAGE_IMAGE", 1)], [READ_ONLY], UNREAD),
    ],
)
def test_of_a_template_only_entries_of_images_are_unknown_and_their_layouts_are_stated(
    entries: list[tuple[int, str, int]], layouts: list[str], answer: tuple[bool, int], pushed: bool
) -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        data = {"descriptorUpdateTemplate": made, "pData": shape_of_data(layouts)}
        if pushed:
            program.call(
                "vkCmdPushDescriptorSetWithTemplateKHR",
                commandBuffer=buffer,
                layout=0,
                set=0,
                **data,
            )
        else:
            own = program.descriptor_set()
            program.call("vkUpdateDescriptorSetWithTemplate", device=2, descriptorSet=own, **data)
            program.bind(buffer, own)

    program = Program()
    made = template(program, *entries)
    assert depth_of(scene(bind, program=program)) == answer


@pytest.mark.parametrize(
    ("form", "answer"), [("imageInfos", READ), ("null", UNREAD), ("pDescriptorWrites", READ)]
)
def test_handles_that_a_template_states_are_read(form: str, answer: tuple[bool, int]) -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        image = {
            "sampler": 0,
            "imageView": view if form != "null" else 0,
            "imageLayout": f"VK_IMAGE_LAYOUT_{READ_ONLY}",
        }
        data = (
            {"pDescriptorWrites": [written(0, view)]}
            if form == "pDescriptorWrites"
            else {"pData": {"imageInfos": [image]}}
        )
        call = {"commandBuffer": buffer, "descriptorUpdateTemplate": made, "layout": 0, "set": 0}
        program.call("vkCmdPushDescriptorSetWithTemplateKHR", **call, **data)

    program = Program()
    made = template(program, (0, SAMPLER_TYPE, 1))
    assert depth_of(scene(bind, program=program)) == answer


def test_what_is_pushed_for_dispatches_is_not_read_by_draws() -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        call = {"commandBuffer": buffer, "descriptorUpdateTemplate": made, "layout": 0, "set": 0}
        program.call("vkCmdPushDescriptorSetWithTemplateKHR", **call, pData={})

    program = Program()
    made = template(program, (0, SAMPLER_TYPE, 1), point="VK_PIPELINE_BIND_POINT_COMPUTE")
    assert depth_of(scene(bind, program=program)) == UNREAD


def test_an_update_that_states_the_image_ends_what_is_unknown() -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        own = program.descriptor_set()
        data = {"descriptorUpdateTemplate": made, "pData": shape_of_data([READ_ONLY])}
        program.call("vkUpdateDescriptorSetWithTemplate", device=2, descriptorSet=own, **data)
        program.write(own, 0)
        program.bind(buffer, own)

    program = Program()
    made = template(program, (0, SAMPLER_TYPE, 1))
    assert depth_of(scene(bind, program=program)) == UNREAD


def test_a_thousand_draws_with_unknown_descriptors_are_no_reads() -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        for _ in range(300):
            own = program.descriptor_set()
            program.call(
                "vkUpdateDescriptorSetWithTemplate",
                device=2,
                descriptorSet=own,
                descriptorUpdateTemplate=made,
                pData={},
            )
            program.bind(buffer, own)
            program.draw(buffer)

    program = Program()
    made = template(program, (0, SAMPLER_TYPE, 1))
    text = read(scene(bind, program=program)).source.text
    assert ("readImage" in text, text.count("mayBeRead")) == (False, 1)


# Layouts of pipelines.


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    ("sets", "is_read"),
    [
        ([[(0, SAMPLER_TYPE, 1, FRAGMENT)]], True),
        ([[(0, "VK_DESCRIPTOR_TYPE_MUTABLE_EXT", 1, 0x7FFFFFFF)]], True),
        ([[(0, SAMPLER_TYPE, 1, COMPUTE)]], False),
        ([[(0, BUFFER_TYPE, 1, FRAGMENT), (1, SAMPLER_TYPE, 1, COMPUTE)]], False),
        ([[], [(0, SAMPLER_TYPE, 1, FRAGMENT)]], False),
        ([], False),
        (None, True),
    ],
)
def test_a_draw_reads_the_bindings_that_its_pipeline_has(
    sets: Any, is_read: bool, known: bool
) -> None:
    program = Program()
    layout = (
        pipeline_layout(program, *(set_layout(program, *each) for each in sets))
        if sets is not None
        else 0
    )
    drawn = depth_of(
        scene(
            known_set if known else unknown_set, pipeline=pipeline(program, layout), program=program
        )
    )
    assert drawn == ((READ if known else POSSIBLE) if is_read else UNREAD)


@pytest.mark.parametrize("reuses", [True, False])
def test_layouts_that_no_longer_exist_do_not_count_toward_the_limit(
    reuses: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(set_layouts, "MAX_BINDINGS_TOTAL", 20)
    program = Program()
    for _ in range(20):
        of_set = set_layout(program, (0, SAMPLER_TYPE, 1, FRAGMENT))
        of_pipeline, update = (
            pipeline_layout(program, of_set),
            template(program, (0, SAMPLER_TYPE, 1)),
        )
        if reuses:
            for _, args in program.calls[-3:]:
                args.update(
                    {
                        name: 7
                        for name in ("pSetLayout", "pPipelineLayout", "pDescriptorUpdateTemplate")
                        if name in args
                    }
                )
        else:
            program.call("vkDestroyDescriptorSetLayout", device=2, descriptorSetLayout=of_set)
            program.call("vkDestroyPipelineLayout", device=2, pipelineLayout=of_pipeline)
            program.call(
                "vkDestroyDescriptorUpdateTemplate", device=2, descriptorUpdateTemplate=update
            )
    layout = pipeline_layout(program, set_layout(program, (0, SAMPLER_TYPE, 1, COMPUTE)))
    assert (
        depth_of(scene(unknown_set, pipeline=pipeline(program, layout), program=program)) == UNREAD
    )


def test_another_pipeline_reads_other_bindings_of_the_same_set() -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        own = program.descriptor_set()
        program.write(own, view, binding=1)
        program.bind(buffer, own)
        program.draw(buffer, blind)

    program = Program()
    layouts = [set_layout(program, (binding, SAMPLER_TYPE, 1, FRAGMENT)) for binding in (0, 1)]
    blind, other = (pipeline(program, pipeline_layout(program, layout)) for layout in layouts)
    assert depth_of(scene(bind, pipeline=blind, program=program)) == UNREAD
    program = Program()
    layouts = [set_layout(program, (binding, SAMPLER_TYPE, 1, FRAGMENT)) for binding in (0, 1)]
    blind, other = (pipeline(program, pipeline_layout(program, layout)) for layout in layouts)
    assert depth_of(scene(bind, pipeline=other, program=program)) == READ


def test_descriptors_beyond_the_end_of_a_binding_are_in_the_next_one() -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        own = program.handle()
        info = {"descriptorPool": 4, "pSetLayouts": [layout]}
        program.call(
            "vkAllocateDescriptorSets", device=2, pAllocateInfo=info, pDescriptorSets=[own]
        )
        write = written(own, view)
        write["pImageInfo"] = [{"imageView": 0}, {"imageView": 0}, *write["pImageInfo"]]
        program.call("vkUpdateDescriptorSets", device=2, pDescriptorWrites=[write])
        program.bind(buffer, own)

    for stages, answer in ((FRAGMENT, READ), (COMPUTE, UNREAD)):
        program = Program()
        layout = set_layout(program, (3, SAMPLER_TYPE, 1, stages), (0, SAMPLER_TYPE, 2, FRAGMENT))
        assert (
            depth_of(
                scene(
                    bind,
                    pipeline=pipeline(program, pipeline_layout(program, layout)),
                    program=program,
                )
            )
            == answer
        )


@pytest.mark.parametrize(("stages", "answer"), [(0x1F, READ), (COMPUTE, UNREAD)])
def test_the_calls_of_vulkan_1_4_bind_for_stages(stages: int, answer: tuple[bool, int]) -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        own = program.descriptor_set()
        program.write(own, view)
        info = {"stageFlags": stages, "layout": 0, "firstSet": 0, "pDescriptorSets": [own]}
        program.call(
            "vkCmdBindDescriptorSets2KHR", commandBuffer=buffer, pBindDescriptorSetsInfo=info
        )

    assert depth_of(scene(bind)) == answer


@pytest.mark.parametrize("name", ["vkCmdBindDescriptorBuffersEXT", "vkCmdBindResourceHeapEXT"])
@pytest.mark.parametrize(("stages", "answer"), [(FRAGMENT, POSSIBLE), (COMPUTE, UNREAD)])
def test_descriptors_in_buffers_may_be_in_any_set(
    name: str, stages: int, answer: tuple[bool, int]
) -> None:
    program = Program()
    layout = pipeline_layout(
        program, set_layout(program), set_layout(program, (4, SAMPLER_TYPE, 1, stages))
    )
    own = pipeline(program, layout)
    assert (
        depth_of(
            scene(
                lambda program, buffer, view: program.call(name, commandBuffer=buffer),
                pipeline=own,
                program=program,
            )
        )
        == answer
    )


@pytest.mark.parametrize(
    ("layout", "answer"), [(ATTACHMENT, UNREAD), ("GENERAL", READ), (READ_ONLY, READ)]
)
def test_a_pass_reads_its_attachments_in_feedback_loops_and_read_only(
    layout: str, answer: tuple[bool, int]
) -> None:
    program = Program()
    depth = program.image(D32, usage=DEPTH | SAMPLED)
    view, own = program.view(depth), program.descriptor_set()
    program.write(own, view)
    buffer = program.buffer()
    program.bind(buffer, own)
    program.rendering(buffer, [], attached(view, layout))
    program.draw(buffer)
    program.end(buffer, rendering=True)
    program.submit(buffer)
    assert depth_of(program) == answer


# Shaders.


def spirv(
    *images: tuple[int, int, bool], version: int = 0x10000, interface: Sequence[int] | None = None
) -> str:
    """A fragment shader that declares images (set, binding, whether multisampled), as the file that
    gfxreconstruct 1.x writes.
    """
    words = [0x07230203, version, 0, 100, 0]

    def add(number: int, *operands: int) -> None:
        words.extend(((len(operands) + 1) << 16 | number, *operands))

    variables = [50 + index for index in range(len(images))] if interface is None else interface
    add(15, 4, 1, 0x6E69616D, 0, *variables)
    for index, (number, binding, _) in enumerate(images):
        add(71, 50 + index, 34, number)
        add(71, 50 + index, 33, binding)
    add(22, 2, 32)
    for index, (_, _, multisampled) in enumerate(images):
        add(25, 10 + index, 2, 1, 0, 0, int(multisampled), 1, 0)
        add(27, 20 + index, 10 + index)
        add(29, 30 + index, 20 + index)
        add(32, 40 + index, 0, 30 + index)
        add(59, 40 + index, 50 + index, 0)
    add(54, 2, 1, 0, 3)
    words.append(1 << 16 | 56)
    return struct.pack(f"<{len(words)}I", *words).decode("latin-1")


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    ("code", "is_read"),
    [
        (spirv((0, 0, True)), True),
        (spirv((0, 0, False)), False),
        (spirv((0, 1, True)), False),
        (spirv((1, 0, True)), False),
        (spirv(), False),
        (spirv((0, 0, True), version=0x10400), True),
        (spirv((0, 0, True), version=0x10400, interface=()), False),
        (spirv((0, 0, True), version=0x10000, interface=()), True),
        ("not SPIR-V", True),
        (None, True),
    ],
)
def test_a_draw_reads_what_its_shaders_declare(
    code: str | None, is_read: bool, known: bool
) -> None:
    from msaa_lint.input.captures.call import Call, Place
    from msaa_lint.input.captures.description_text import describe_capture
    from msaa_lint.input.captures.tracker import Tracker

    program = Program()
    info = {"pCode": code.encode("latin-1") if code is not None else None}
    program.call("vkCreateShaderModule", device=2, pCreateInfo=info, pShaderModule=60)
    layout = pipeline_layout(program, set_layout(program, (0, SAMPLER_TYPE, 1, 0x7FFFFFFF)))
    stage = {"stage": "VK_SHADER_STAGE_FRAGMENT_BIT", "module": 60, "pName": "main"}
    scene(
        known_set if known else unknown_set,
        pipeline=pipeline(program, layout, [stage]),
        program=program,
    )
    tracker = Tracker()
    for number, (name, args) in enumerate(program.calls):
        tracker.feed(Call(name, args, Place(number + 1, 1, number)))
    tracker.finish()
    text = describe_capture(tracker)[0]
    assert ("readImage" in text, "mayBeRead" in text) == (
        (known, not known) if is_read else (False, False)
    )


def test_an_image_that_may_be_written_too_is_a_storage_image() -> None:
    def bind(program: Program, buffer: int, view: int) -> None:
        own = program.descriptor_set()
        data = {"descriptorUpdateTemplate": made, "pData": {}}
        program.call("vkUpdateDescriptorSetWithTemplate", device=2, descriptorSet=own, **data)
        program.bind(buffer, own)

    for usage, answer in ((DEPTH | SAMPLED, UNREAD), (DEPTH | 0x8, POSSIBLE)):
        program = Program()
        made = template(program, (0, "VK_DESCRIPTOR_TYPE_STORAGE_IMAGE", 1))
        assert depth_of(scene(bind, "GENERAL", usage, program=program)) == answer
