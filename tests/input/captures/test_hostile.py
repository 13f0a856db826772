"""Captures come from strangers: whatever calls hold, they are followed as far as they make
sense.
"""

from __future__ import annotations

import copy
import time
from typing import Any

from hypothesis import HealthCheck, given
from hypothesis import strategies as st

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.input import readers
from msaa_lint.input.captures.call import Call, Mark, Place
from msaa_lint.input.captures.description_text import describe_capture
from msaa_lint.input.captures.tracker import Tracker
from tests.input.captures.program import Program, attachment, info
from tests.input.captures.test_frames import forward, history
from tests.strength import examples

NUMBERS = st.sampled_from(
    [0, 1, 2, 3, -1, 4, 5, 100, 101, 103, 2**31 - 1, 2**32 - 1, 2**64, -(2**70), 0.5, 1e308]
)
WORDS = st.sampled_from(
    [
        "",
        "VK_NULL_HANDLE",
        "0x11",
        "VK_SAMPLE_COUNT_4_BIT",
        "17 (VK_A | VK_B)",
        "VK_FORMAT_UNDEFINED",
        "VK_FORMAT_D24_UNORM_S8_UINT",
        "\0",
        "é",
    ]
)
VALUES = st.recursive(
    st.none() | st.booleans() | NUMBERS | WORDS,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(
            st.sampled_from(["sType", "pNext", "image", "attachment", "x"]), inner, max_size=3
        )
    ),
    max_leaves=6,
)


def everything() -> list[tuple[str, dict[str, Any]]]:
    """A program with a bit of everything."""
    program = forward(3)
    program.calls += history(True).calls
    view = program.view(program.image())
    depth = program.view(program.image("VK_FORMAT_D24_UNORM_S8_UINT", usage=0x20))
    render_pass = program.render_pass(
        [attachment(), attachment("VK_FORMAT_D24_UNORM_S8_UINT", load="LOAD", store="STORE")],
        depth=1,
        two=True,
    )
    framebuffer = program.framebuffer(render_pass, [view, depth], imageless=True)
    secondary, buffer = program.buffer(secondary=True), program.buffer()
    program.draw(secondary, program.pipeline(render_pass))
    program.begin(buffer, render_pass, framebuffer, [view, depth])
    program.call("vkCmdExecuteCommands", commandBuffer=buffer, pCommandBuffers=[secondary])
    program.call("vkCmdNextSubpass", commandBuffer=buffer, contents=0)
    clear = {"aspectMask": 3, "colorAttachment": 0}
    program.call(
        "vkCmdClearAttachments",
        commandBuffer=buffer,
        pAttachments=[clear],
        pRects=[{"rect": {"extent": {"width": 3, "height": 3}}}],
    )
    program.end(buffer)
    images = [program.image(samples=count) for count in (4, 1)]
    region = {"dstOffset": {"x": 0, "y": 0}, "extent": {"width": 256, "height": 128}}
    ends = {"srcImage": images[0], "dstImage": images[1]}
    for name in ("vkCmdResolveImage", "vkCmdCopyImage", "vkCmdBlitImage"):
        program.call(name, commandBuffer=buffer, **ends, pRegions=[region])
    program.call(
        "vkCmdResolveImage2", commandBuffer=buffer, pResolveImageInfo={**ends, "pRegions": [region]}
    )
    barrier = {
        "srcAccessMask": 256,
        "dstAccessMask": 32,
        "oldLayout": 2,
        "newLayout": 5,
        "image": images[0],
    }
    stages = {"srcStageMask": 1024, "dstStageMask": 128}
    program.call(
        "vkCmdPipelineBarrier",
        commandBuffer=buffer,
        **stages,
        pMemoryBarriers=[barrier],
        pImageMemoryBarriers=[barrier],
    )
    program.call(
        "vkCmdPipelineBarrier2",
        commandBuffer=buffer,
        pDependencyInfo={"pImageMemoryBarriers": [{**barrier, **stages}]},
    )
    program.rendering(buffer, [info(view, resolve=program.view(images[1]))], info(depth), flags=2)
    program.end(buffer, rendering=True)
    program.submit(buffer)
    program.present()
    return program.calls


CALLS = everything()


def places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The paths of all that a value holds."""
    inner = (
        value.items()
        if isinstance(value, dict)
        else enumerate(value)
        if isinstance(value, list)
        else ()
    )
    return [path, *(each for key, item in inner for each in places(item, (*path, key)))]


def described(calls: list[tuple[str, dict[str, Any]]]) -> list[Document]:
    """The documents that calls become."""
    tracker = Tracker()
    for number, (name, args) in enumerate(calls):
        tracker.feed(Call(name, args, Place(number + 1, 1, number)))
    tracker.feed(Mark("frame", Place()))
    tracker.finish()
    source = Source("capture", describe_capture(tracker)[0])
    parsed = parse(source, Limits())
    assert parsed.problems == []
    return [readers.read(source, root) for root in parsed.documents]


def test_the_calls_themselves_make_a_right_description() -> None:
    documents = described(CALLS)
    assert [problem for document in documents for problem in document.problems] == []
    assert {
        "beginRenderPass",
        "beginRendering",
        "resolveImage",
        "present",
        "clearAttachments",
        "pipelineBarrier",
        "readImage",
    } <= {
        command.kind
        for document in documents
        for command in document.description.commands or ()
        if command is not None
    }


@examples(1.5, suppress_health_check=[HealthCheck.too_slow])
@given(data=st.data())
def test_any_value_in_any_place_leaves_a_description_without_mistakes(data: st.DataObject) -> None:
    calls = list(CALLS)
    for _ in range(data.draw(st.integers(1, 4))):
        number = data.draw(st.integers(0, len(calls) - 1))
        name, args = calls[number]
        args = copy.deepcopy(args)
        path = data.draw(st.sampled_from([each for each in places(args) if each] or [("x",)]))
        within: Any = args
        for key in path[:-1]:
            within = within[key]
        if data.draw(st.booleans()):
            within[path[-1]] = data.draw(VALUES)
        elif isinstance(within, dict):
            within.pop(path[-1], None)
        elif isinstance(within, list):
            within.append(within[path[-1]])
        calls[number] = (name, args)
    for document in described(calls):
        assert document.problems == (), [problem.message for problem in document.problems]


@examples(1)
@given(st.lists(st.integers(0, len(CALLS) - 1), max_size=200))
def test_calls_in_any_order_leave_a_description_without_mistakes(order: list[int]) -> None:
    for document in described([CALLS[number] for number in order]):
        assert document.problems == ()


def test_chains_that_go_on_forever_end() -> None:
    chain: dict[str, Any] = {"sType": "VK_STRUCTURE_TYPE_X"}
    chain["pNext"] = chain
    calls = [
        ("vkCreateImage", {"pCreateInfo": {**chain}, "pImage": 5}),
        ("vkCreateDevice", {"pCreateInfo": {"pNext": chain}, "pDevice": 6}),
        ("vkGetPhysicalDeviceProperties2", {"physicalDevice": 1, "pProperties": chain}),
    ]
    assert described(calls)[0].problems == ()


def test_hostile_counts_are_followed_in_bounded_time() -> None:
    begin = time.process_time()
    program = Program()
    views = [program.view(program.image()) for _ in range(200)]
    for _ in range(20):
        buffer = program.buffer()
        for view in views:
            program.rendering(buffer, [info(view)])
            program.call(
                "vkCmdExecuteCommands", commandBuffer=buffer, pCommandBuffers=[buffer] * 50
            )
        program.submit(*[buffer] * 20)
    described(program.calls)
    assert time.process_time() - begin < 60
