"""What a capture executes and reads may grow faster than the capture: it is counted once, or a
limit ends it with a finding.
"""

from __future__ import annotations

import gc
import re
import tracemalloc
from io import BytesIO
from typing import Any

import pytest

from msaa_lint.core.finding import Finding
from msaa_lint.input.captures import command_buffers, frames, images, json_stream, submissions
from msaa_lint.input.captures import tracker as tracker_module
from msaa_lint.input.captures.call import Call, Place
from msaa_lint.input.captures.description_text import describe_capture
from msaa_lint.input.captures.submissions import MAX_REPEATED
from msaa_lint.input.captures.tracker import Tracker
from msaa_lint.input.readers import gfxreconstruct
from tests.benchmarks.shapes import capture_frames
from tests.input.captures.program import COLOR, SAMPLED, Program, attachment, codes, info, lint


def tracked(program: Program) -> Tracker:
    """A tracker that has seen a program."""
    tracker = Tracker()
    for number, (name, args) in enumerate(program.calls):
        tracker.feed(Call(name, args, Place(number + 1, 1, number)))
    tracker.finish()
    return tracker


def described(program: Program) -> list[str]:
    """The lines of a program's description."""
    return describe_capture(tracked(program))[0].split("\n")


def count(lines: list[str], text: str) -> int:
    return sum(text in line for line in lines)


def limits(findings: list[Finding]) -> list[str]:
    return [found.message for found in findings if found.code == "MSAA906"]


def target(program: Program) -> tuple[int, int]:
    render_pass = program.render_pass([attachment()])
    return render_pass, program.framebuffer(render_pass, [program.view(program.image())])


def pass_of(program: Program, buffer: int, render_pass: int, framebuffer: int) -> None:
    program.begin(buffer, render_pass, framebuffer)
    program.draw(buffer)
    program.end(buffer)


def nested(depth: int, calls: int = 2) -> Program:
    """A pass in a secondary command buffer, and others that execute the one before them so
    often.
    """
    program = Program()
    below = program.buffer(secondary=True)
    pass_of(program, below, *target(program))
    for _ in range(depth):
        above = program.buffer(secondary=True)
        program.call("vkCmdExecuteCommands", commandBuffer=above, pCommandBuffers=[below] * calls)
        below = above
    program.submit(below)
    return program


def test_nested_secondary_command_buffers_are_executed() -> None:
    assert count(described(nested(5)), "beginRenderPass") == 32
    assert limits(lint(nested(5).text())) == []


def test_what_nested_secondary_command_buffers_repeat_is_limited(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(submissions, "MAX_REPEATED", 4000)
    lines = described(nested(60))
    assert 200 < count(lines, "beginRenderPass") <= 4000
    program = nested(60)
    (found,) = [each for each in lint(program.text()) if each.code == "MSAA906"]
    assert found.message == (
        "limit exceeded: a frame executes command buffers again that have 20,000 commands "
        "together; further repetitions are not checked"
    )
    assert found.capture_location is None
    assert found.span is not None


def test_a_command_buffer_that_executes_one_that_executes_it_ends() -> None:
    program = Program()
    one, other = program.buffer(secondary=True), program.buffer(secondary=True)
    pass_of(program, one, *target(program))
    for _ in range(14):
        program.call("vkCmdExecuteCommands", commandBuffer=other, pCommandBuffers=[one])
        program.call("vkCmdExecuteCommands", commandBuffer=one, pCommandBuffers=[other])
    program.submit(one)
    assert count(described(program), "beginRenderPass") > 1


def test_an_execution_is_of_what_was_recorded_before_it() -> None:
    program = Program()
    secondary, buffer = program.buffer(secondary=True), program.buffer()
    ends = target(program)
    pass_of(program, secondary, *ends)
    program.call("vkCmdExecuteCommands", commandBuffer=buffer, pCommandBuffers=[secondary])
    pass_of(program, secondary, *ends)
    program.submit(buffer)
    assert count(described(program), "beginRenderPass") == 1


def test_submitting_a_command_buffer_again_in_a_frame_is_limited() -> None:
    program = Program()
    program.swap()
    buffer = program.buffer()
    ends = target(program)
    for _ in range(500):
        pass_of(program, buffer, *ends)
    program.submit(*[buffer] * 500)
    program.present()
    frames = tracked(program).frames
    (kind,) = frames.kinds.values()
    assert len(kind.passes) == 500 * (1 + MAX_REPEATED // 1500)
    assert len(frames.limits) == 1


def test_a_command_buffer_that_is_submitted_in_every_frame_is_one_kind_of_frame() -> None:
    program = Program()
    buffer = program.buffer()
    ends = target(program)
    for _ in range(300):
        pass_of(program, buffer, *ends)
    program.submit(buffer)
    for _ in range(2000):
        program.call(
            "vkQueueSubmit",
            queue=5,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": [buffer]}],
            fence=0,
        )
    frames = tracked(program).frames
    (kind,) = frames.kinds.values()
    assert (frames.total, kind.count, frames.limits) == (2001, 2001, {})


def reads(passes: int, images: int, write: bool = False, storage: bool = False) -> Program:
    """Passes that read a set of images; `write`: each pass draws to the first of them before."""
    program = Program()
    bound = program.descriptor_set()
    views = [
        program.view(program.image(samples=1, usage=COLOR | SAMPLED, name=f"sampled{number}"))
        for number in range(images)
    ]
    for binding, view in enumerate(views):
        program.write(
            bound, view, binding, "STORAGE_IMAGE" if storage else "COMBINED_IMAGE_SAMPLER"
        )
    render_pass, framebuffer = target(program)
    buffer = program.buffer()
    program.bind(buffer, bound)
    for _ in range(passes):
        if write:
            program.rendering(buffer, [info(views[0], store="STORE")])
            program.end(buffer, rendering=True)
        program.begin(buffer, render_pass, framebuffer)
        program.draw(buffer)
        program.draw(buffer)
        program.end(buffer)
    program.submit(buffer)
    return program


def test_a_set_is_read_in_every_pass() -> None:
    lines = described(reads(3, 2))
    assert (
        count(lines, "readImage: {image: sampled0")
        == count(lines, "readImage: {image: sampled1")
        == 3
    )


@pytest.mark.parametrize("storage", [False, True])
def test_further_passes_that_read_a_set_are_not_described_again(storage: bool) -> None:
    lines = described(reads(100, 100, storage=storage))
    assert count(lines, "beginRenderPass") == 100
    assert count(lines, "readImage") == 800


def test_an_image_that_is_written_between_is_read_again() -> None:
    lines = described(reads(100, 3, write=True))
    assert count(lines, "readImage: {image: sampled0") == 100
    assert count(lines, "readImage: {image: sampled1") == 8


def test_a_set_that_changes_between_submissions_is_read_as_it_is_then() -> None:
    program = reads(1, 1)
    bound = next(
        args["pDescriptorSets"][0]
        for name, args in program.calls
        if name == "vkAllocateDescriptorSets"
    )
    other = program.view(program.image(samples=1, usage=COLOR | SAMPLED, name="later"))
    program.write(bound, other)
    render_pass, framebuffer = target(program)
    buffer = program.buffer()
    program.bind(buffer, bound)
    pass_of(program, buffer, render_pass, framebuffer)
    program.submit(buffer)
    lines = described(program)
    assert (
        count(lines, "readImage: {image: sampled0"),
        count(lines, "readImage: {image: later"),
    ) == (1, 1)


def test_frames_that_read_far_more_than_they_record_are_not_checked() -> None:
    program = reads(1, 200)
    program.swap()
    submit = next(call for call in program.calls if call[0] == "vkQueueSubmit")
    bound = next(
        args["pDescriptorSets"][0]
        for name, args in program.calls
        if name == "vkAllocateDescriptorSets"
    )
    many = program.buffer()
    program.bind(many, bound)
    render_pass, framebuffer = target(program)
    copies = [program.descriptor_set() for _ in range(700)]
    for copied in copies:
        program.call(
            "vkUpdateDescriptorSets",
            device=2,
            pDescriptorCopies=[{"srcSet": bound, "dstSet": copied, "descriptorCount": 64}],
        )
    program.begin(many, render_pass, framebuffer)
    for copied in copies:
        program.bind(many, copied)
        program.draw(many)
    program.end(many)
    program.submit(many)
    for _ in range(30):
        program.calls.append(submit)
        program.call(
            "vkQueueSubmit", queue=5, submitCount=1, pSubmits=[{"pCommandBuffers": [many]}], fence=0
        )
        program.present()
    findings = lint(program.text())
    assert limits(findings) == [
        "limit exceeded: frames execute far more commands, or read far more images, than the "
        "capture records; some of them are not checked"
    ]


def test_one_copied_descriptor_is_one_image() -> None:
    program = reads(0, 3)
    bound = next(
        args["pDescriptorSets"][0]
        for name, args in program.calls
        if name == "vkAllocateDescriptorSets"
    )
    copied = program.descriptor_set()
    copy = {
        "srcSet": bound,
        "srcBinding": 1,
        "srcArrayElement": 0,
        "dstSet": copied,
        "dstBinding": 7,
        "dstArrayElement": 0,
    }
    program.call(
        "vkUpdateDescriptorSets", device=2, pDescriptorCopies=[{**copy, "descriptorCount": 1}]
    )
    assert [image.label for image, _ in tracked(program).sets[copied].images.values()] == [
        "sampled1"
    ]


def test_pushed_and_bound_sets_are_bounded() -> None:
    program = Program()
    buffer = program.buffer()
    point = "VK_PIPELINE_BIND_POINT_GRAPHICS"
    for binding in range(1000):
        view = program.view(program.image(samples=1, usage=COLOR | SAMPLED))
        write = {
            "dstBinding": binding,
            "descriptorType": "VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE",
            "pImageInfo": [{"imageView": view}],
        }
        program.call(
            "vkCmdPushDescriptorSetKHR",
            commandBuffer=buffer,
            pipelineBindPoint=point,
            set=0,
            pDescriptorWrites=[write],
        )
        descriptors = program.descriptor_set()
        program.call(
            "vkCmdBindDescriptorSets",
            commandBuffer=buffer,
            pipelineBindPoint=point,
            firstSet=binding + 1,
            pDescriptorSets=[descriptors],
        )
    recorded = tracked(program).buffers[buffer]
    assert recorded is not None
    bound = recorded.graphics.sets
    assert (len(bound), len(bound[0].images)) == (64, 256)


def test_destroyed_and_freed_objects_are_forgotten() -> None:
    program = Program()
    for _ in range(200):
        image = program.image()
        view = program.view(image)
        render_pass = program.render_pass([attachment()])
        framebuffer = program.framebuffer(render_pass, [view])
        descriptors, buffer, pipeline = (
            program.descriptor_set(),
            program.buffer(),
            program.pipeline(render_pass),
        )
        program.swap()
        program.call("vkGetPhysicalDeviceProperties", physicalDevice=1, pProperties={"limits": {}})
        program.call(
            "vkFreeDescriptorSets", device=2, descriptorPool=4, pDescriptorSets=[descriptors]
        )
        program.call("vkFreeCommandBuffers", device=2, commandPool=3, pCommandBuffers=[buffer])
        destroyed = {
            "Framebuffer": framebuffer,
            "RenderPass": render_pass,
            "ImageView": view,
            "Image": image,
            "Pipeline": pipeline,
        }
        for kind, handle in destroyed.items():
            member = "imageView" if kind == "ImageView" else kind[0].lower() + kind[1:]
            program.destroy(kind, member, handle)
        program.destroy("SwapchainKHR", "swapchain", program.swapchain)
    tracker = tracked(program)
    held: list[Any] = [
        tracker.images, tracker.views, tracker.render_passes, tracker.framebuffers,
        tracker.pipelines, tracker.sets, tracker.buffers,
        tracker.swapchains, tracker.pipeline_bindings, *tracker.layouts.followed(),
        *tracker.pools.values(), *tracker.set_pools.values(),
    ]  # fmt: skip
    assert [len(each) for each in held] == [0] * len(held)
    assert len(tracker.queried[1]["properties"]) == 1


def test_images_of_one_name_are_numbered() -> None:
    program = Program()
    buffer = program.buffer()
    for _ in range(3):
        program.rendering(buffer, [info(program.view(program.image(name="target")))])
        program.end(buffer, rendering=True)
    program.submit(buffer)
    assert [
        line.split(":")[0].strip() for line in described(program) if line.startswith("  target")
    ] == ["target", "target_2", "target_3"]


def test_a_pass_of_too_many_different_commands_says_so() -> None:
    program = Program()
    buffer = program.buffer()
    program.begin(buffer, *target(program))
    for width in range(4100):
        rect = {"rect": {"offset": {"x": 0, "y": 0}, "extent": {"width": 1 + width, "height": 1}}}
        program.call(
            "vkCmdClearAttachments",
            commandBuffer=buffer,
            pAttachments=[{"aspectMask": 1, "colorAttachment": 0}],
            pRects=[rect],
        )
    program.end(buffer)
    program.submit(buffer)
    findings = lint(program.text())
    assert limits(findings) == [
        "limit exceeded: a pass has more than 4,096 different commands; those after them are not "
        "checked"
    ]
    assert "MSAA906" in codes(findings)


def test_elements_that_are_laid_out_unusually_are_not_searched_to_the_end_each(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    searches: list[bytes] = []
    original = re.compile

    def compile(pattern: bytes) -> re.Pattern[bytes]:
        searches.append(pattern)
        return original(pattern)

    monkeypatch.setattr(json_stream.re, "compile", compile)
    indents = [f"{number:020b}".replace("0", " ").replace("1", "\t") for number in range(8000)]
    elements = [
        f'{indent}{{\n"index":{number},"function":{{}}}}' for number, indent in enumerate(indents)
    ]
    cursor = json_stream.Cursor(BytesIO(("[\n" + ",\n".join(elements) + "]\n").encode()))
    assert sum(cursor.value().startswith(b"{") for _ in cursor.elements()) == 8000
    assert len(searches) < 10


def test_a_call_that_is_too_large_to_parse_ends_the_capture() -> None:
    program = Program()
    program.call("vkDestroyImage", image=1, x="a" * json_stream.MAX_PARSED)
    program.call("vkUnknown", x="a" * json_stream.MAX_PARSED)
    program.calls.reverse()
    (found,) = lint(program.text())
    assert (found.code, found.message) == (
        "MSAA901",
        "the capture ends here: a call that is read exceeds 12 MiB",
    )


def test_objects_beyond_a_limit_are_not_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(images, "MAX_HANDLES", 3)
    program = Program()
    sets = [program.descriptor_set() for _ in range(5)]
    buffers = [program.buffer() for _ in range(5)]
    tracker = tracked(program)
    assert (list(tracker.sets), list(tracker.buffers)[:3]) == (sets[:3], buffers[:3])
    assert list(tracker.frames.limits) == [
        "more than 2,000,000 objects of a kind exist at a time; further ones are not followed"
    ]


def test_structures_beyond_a_limit_are_not_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tracker_module, "MAX_CONTAINERS", 100)
    program = Program()
    passes = [program.render_pass([attachment()] * count) for count in (1, 2, 200, 3)]
    program.pipeline(passes[0])
    tracker = tracked(program)
    assert (list(tracker.render_passes), list(tracker.pipelines)) == (passes[:2], [])
    assert len(tracker.frames.limits) == 1


def test_memory_does_not_grow_with_frames_of_which_no_two_are_alike(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for module, name, limit in (
        (images, "MAX_DISTINCT", 20),
        (tracker_module, "MAX_DESTROYED", 200),
        (tracker_module, "MIN_DESTROYED", 10),
        (tracker_module, "MAX_CACHED_COMMANDS", 20),
        (command_buffers, "MAX_CACHED_COMMANDS", 100),
        (frames, "MAX_CANDIDATES", 20),
        (frames, "MAX_KINDS", 8),
        (gfxreconstruct, "MAX_CACHE", 50_000),
        (gfxreconstruct, "MAX_STARTS", 100),
    ):
        monkeypatch.setattr(module, name, limit)

    def kept(size: int) -> int:
        """The memory in bytes that the state takes after a capture of a size."""
        gc.collect()
        tracemalloc.start()
        tracker = Tracker()
        for call in gfxreconstruct.calls(
            BytesIO(b"".join(capture_frames.text(size))), tracker.wanted, None
        ):
            tracker.feed(call)
        tracker.finish()
        gc.collect()
        memory = tracemalloc.get_traced_memory()[0]
        tracemalloc.stop()
        assert tracker.frames.dropped == tracker.frames.total - 8 > 0
        return memory

    kept(400_000)
    assert kept(1_200_000) < 1.25 * kept(400_000)


def test_the_most_frequent_kinds_of_frames_are_kept() -> None:
    program = Program()
    program.swap(1)
    view = program.view(program.image())

    def frame(passes: int) -> None:
        buffer = program.buffer()
        for _ in range(passes):
            program.rendering(buffer, [info(view, store="STORE")])
            program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present()

    for passes in range(1, 60):
        frame(passes)
    for _ in range(10):
        for passes in (50, 55):
            frame(passes)
    tracker = tracked(program)
    counts = {len(kind.passes): kind.count for kind in tracker.frames.kinds.values()}
    assert (len(counts), counts[50], counts[55], tracker.frames.dropped) == (
        32,
        11,
        11,
        79 - 22 - 30,
    )
