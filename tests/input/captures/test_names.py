"""Names of passes and images: debug labels and object names, else what an object is and the call
that made it.
"""

from __future__ import annotations

import pytest

from tests.input.captures.program import DEPTH, Program, attachment, codes, info, lint
from tests.input.captures.test_frames import read
from tests.input.captures.test_tracking import tree

Steps = list[tuple[str, ...]]


class Labeled(Program):
    """A program with debug labels, by one of the two extensions."""

    markers = False

    def label(self, kind: str, buffer: int, text: str = "") -> None:
        """Begins, ends, or inserts a label."""
        if self.markers:
            self.call(
                f"vkCmdDebugMarker{kind}EXT",
                commandBuffer=buffer,
                **({"pMarkerInfo": {"pMarkerName": text}} if text else {}),
            )
        else:
            self.call(
                f"vkCmd{kind}DebugUtilsLabelEXT",
                commandBuffer=buffer,
                **({"pLabelInfo": {"pLabelName": text}} if text else {}),
            )

    def queue_label(self, kind: str, text: str = "") -> None:
        """Begins or ends a label of the queue."""
        self.call(
            f"vkQueue{kind}DebugUtilsLabelEXT",
            queue=3,
            **({"pLabelInfo": {"pLabelName": text}} if text else {}),
        )

    def submit_all(self, *buffers: int) -> None:
        """One submission to the queue with labels."""
        self.call(
            "vkQueueSubmit",
            queue=3,
            submitCount=1,
            pSubmits=[{"pCommandBuffers": list(buffers)}],
            fence=0,
        )


def target(program: Program, load: str = "CLEAR") -> tuple[int, int]:
    """A render pass with a framebuffer."""
    render_pass = program.render_pass([attachment(load=load, store="STORE")])
    return render_pass, program.framebuffer(render_pass, [program.view(program.image())])


def labels(program: Program) -> list[object]:
    """The labels of the passes of a program's only kind of frame; None where there is none."""
    begins = [
        next(iter(command.items()))
        for command in tree(program)["commands"]
        if isinstance(command, dict)
    ]
    return [
        body.get("label") for kind, body in begins if kind in ("beginRenderPass", "beginRendering")
    ]


def run_steps(program: Labeled, steps: str, buffer: int, begun: tuple[int, int]) -> None:
    """Records `<A` (a label begins), `>` (it ends), `!A` (a label is inserted), `(` and `)` (a
    pass), and `.` (a draw).
    """
    for step in steps.split():
        match step[0]:
            case "<":
                program.label("Begin", buffer, step[1:])
            case ">":
                program.label("End", buffer)
            case "!":
                program.label("Insert", buffer, step[1:])
            case "(":
                program.begin(buffer, *begun)
            case ")":
                program.end(buffer)
            case ".":
                program.draw(buffer, program.pipeline(begun[0]))


PLACES = {
    "<Shadow ( . ) >": ["Shadow"],
    "<Shadow <cascade-2 ( . ) > > ( . )": ["Shadow / cascade-2", None],
    "( <Shadow . > )": ["Shadow"],
    "<Frame ( <Shadow . > ) >": ["Frame / Shadow"],
    "( . <late . > )": [None],
    "( <opaque . > <blended . > )": [None],
    "<Main ( <opaque . > <blended . > ) >": ["Main"],
    "( <a <b . > <c . > > )": ["a"],
    "!Shadow ( . ) ( . )": ["Shadow", None],
    "!Shadow <other > ( . )": [None],
    "( !inner . )": [None],
    "> > <a > ( . ) >": [None],
    "<a ( . > ) ( . )": ["a", None],
    "( <a . > <a . > )": ["a"],
}


@pytest.mark.parametrize("markers", [False, True])
@pytest.mark.parametrize("steps", PLACES)
def test_a_pass_has_the_labels_around_it_or_the_one_that_it_begins_with(
    steps: str, markers: bool
) -> None:
    program = Labeled()
    program.markers = markers
    begun = target(program)
    buffer = program.buffer()
    run_steps(program, steps, buffer, begun)
    program.submit(buffer)
    assert labels(program) == PLACES[steps]


def test_labels_span_the_command_buffers_of_a_submission_and_those_of_the_queue_all() -> None:
    program = Labeled()
    program.swap(1)
    begun = target(program)
    first, second, third = program.buffer(), program.buffer(), program.buffer()
    run_steps(program, "<Scene", first, begun)
    run_steps(program, "( . ) > ( . )", second, begun)
    run_steps(program, "( . )", third, begun)
    program.queue_label("Begin", "Game")
    program.submit_all(first, second)
    program.queue_label("End")
    program.submit_all(third)
    program.present()
    assert labels(program) == ["Game / Scene", "Game", None]


def test_renderings_of_a_secondary_command_buffer_are_within_the_labels_that_execute_it() -> None:
    program = Labeled()
    view = program.view(program.image())
    primary, secondary = program.buffer(), program.buffer(secondary=True)
    program.label("Begin", secondary, "inner")
    program.rendering(secondary, [info(view)])
    program.end(secondary, rendering=True)
    program.label("Begin", primary, "outer")
    program.call("vkCmdExecuteCommands", commandBuffer=primary, pCommandBuffers=[secondary])
    program.submit(primary)
    assert labels(program) == ["outer / inner"]


@pytest.mark.parametrize(
    ("texts", "label"), [(["a"], "a"), (["a", "a"], "a"), (["a", "b"], None), (["", "a"], None)]
)
def test_a_pass_has_the_label_that_all_secondary_command_buffers_in_it_begin_with(
    texts: list[str], label: str | None
) -> None:
    program = Labeled()
    begun = target(program)
    primary = program.buffer()
    secondaries = [program.buffer(secondary=True) for _ in texts]
    for secondary, text in zip(secondaries, texts, strict=True):
        run_steps(program, f"<{text} . >" if text else ".", secondary, begun)
    program.begin(primary, *begun)
    program.call("vkCmdExecuteCommands", commandBuffer=primary, pCommandBuffers=secondaries)
    program.end(primary)
    program.submit(primary)
    assert labels(program) == [label]


def test_a_render_pass_is_named_by_its_labels_if_they_are_always_the_same() -> None:
    program = Labeled()
    shadow, main = target(program), target(program, "DONT_CARE")
    buffer = program.buffer()
    run_steps(program, "<Shadow <cascade-1 ( . ) > >", buffer, shadow)
    run_steps(program, "<Left ( . ) > <Right ( . ) >", buffer, main)
    run_steps(program, "<Shadow <cascade-1 ( . ) > >", buffer, shadow)
    program.submit(buffer)
    assert list(tree(program)["renderPasses"]) == ["Shadow / cascade-1", "pass 256x128 4x #6"]


def test_a_finding_begins_with_the_labels_of_its_pass() -> None:
    program = Labeled()
    begun = target(program)
    buffer = program.buffer()
    run_steps(program, "<Left ( . ) > <Right ( . ) > <Third ( . ) > <Fourth ( . ) >", buffer, begun)
    program.submit(buffer)
    (found,) = [each for each in lint(program.text()) if each.code == "MSAA201"]
    assert found.message.startswith("in `Left`, `Right` and 2 more, `color 256x128 RGBA8 4x #")


def frames(texts: list[str], passes: int = 1) -> Labeled:
    """A program that begins every frame with another label."""
    program = Labeled()
    program.swap(1)
    begun = target(program)
    for text in texts:
        buffer = program.buffer()
        for number in range(passes):
            run_steps(program, f"<{text} <Shadow{number} ( . ) > >", buffer, begun)
        program.submit(buffer)
        program.present()
    return program


def test_a_label_that_counts_frames_names_no_pass_and_makes_no_kind_of_frame() -> None:
    text = read(frames([f"Frame-{number}" for number in range(50)], 2)).source.text
    assert "---" not in text and "Frame-" not in text
    assert "label: Shadow0" in text and "label: Shadow1" in text


def test_other_labels_are_those_of_the_first_frame() -> None:
    assert labels(frames(["even", "odd"] * 3)) == ["even / Shadow0"]


def test_equal_renderings_with_different_labels_are_one() -> None:
    program = Labeled()
    view = program.view(program.image())
    buffer = program.buffer()
    for text in ("a", "b", "a"):
        program.label("Begin", buffer, text)
        program.rendering(buffer, [info(view, store="STORE")])
        program.end(buffer, rendering=True)
        program.label("End", buffer)
    program.submit(buffer)
    assert labels(program) == [["a", "b"]] * 3
    assert codes(lint(program.text())).count("MSAA201") == 1


def test_names_of_objects_count_whenever_they_are_set() -> None:
    program = Program()
    image, unnamed, viewed = (program.image() for _ in range(3))
    program.name("VK_OBJECT_TYPE_IMAGE", image, "first name")
    views = [program.view(each) for each in (image, unnamed, viewed)]
    render_pass = program.render_pass([attachment()] * 3)
    framebuffer = program.framebuffer(render_pass, views)
    buffer = program.buffer()
    program.begin(buffer, render_pass, framebuffer)
    program.end(buffer)
    program.submit(buffer)
    program.name("VK_OBJECT_TYPE_IMAGE_VIEW", views[0], "view of a named image")
    program.name("VK_OBJECT_TYPE_IMAGE_VIEW", views[2], "view")
    program.name("VK_OBJECT_TYPE_IMAGE", image, "last name")
    program.name("VK_OBJECT_TYPE_RENDER_PASS", render_pass, "forward")
    program.name("VK_OBJECT_TYPE_FRAMEBUFFER", framebuffer, "targets")
    made = tree(program)
    assert list(made["images"]) == ["last name", "color 256x128 RGBA8 4x #3", "view"]
    assert list(made["renderPasses"]) == ["forward"] and list(made["framebuffers"]) == ["targets"]


FORMATS = {
    "VK_FORMAT_R16G16B16A16_SFLOAT": "color 256x128 RGBA16F 4x #2",
    "VK_FORMAT_B8G8R8A8_SRGB": "color 256x128 BGRA8_SRGB 4x #2",
    "VK_FORMAT_B10G11R11_UFLOAT_PACK32": "color 256x128 B10G11R11F 4x #2",
    "VK_FORMAT_A2B10G10R10_UNORM_PACK32": "color 256x128 A2B10G10R10 4x #2",
    "VK_FORMAT_R8_UINT": "color 256x128 R8UI 4x #2",
    "VK_FORMAT_D32_SFLOAT": "depth 256x128 D32F 4x #2",
    "VK_FORMAT_X8_D24_UNORM_PACK32": "depth 256x128 D24 4x #2",
    "VK_FORMAT_D24_UNORM_S8_UINT": "depth-stencil 256x128 D24S8 4x #2",
    "VK_FORMAT_D32_SFLOAT_S8_UINT": "depth-stencil 256x128 D32FS8 4x #2",
    "VK_FORMAT_S8_UINT": "stencil 256x128 S8 4x #2",
}


@pytest.mark.parametrize("format", FORMATS)
def test_an_image_without_a_name_is_called_by_what_it_is(format: str) -> None:
    program = Program()
    program.image(format, usage=DEPTH)
    program.submit(program.buffer())
    assert list(tree(program)["images"]) == [FORMATS[format]]
