"""Captures with several kinds of frame: what is said of an object holds for all of them, and one
defect is one finding.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.core.finding import Finding
from msaa_lint.input.captures import yaml_text
from msaa_lint.input.captures.description_text import TOO_MUCH
from tests.command import run
from tests.input.captures.program import (
    COLOR,
    SAMPLED,
    SOURCE,
    TARGET,
    Program,
    attachment,
    codes,
    info,
    lint,
)


def resolve(program: Program, buffer: int, source: int, target: int) -> None:
    """vkCmdResolveImage."""
    regions = [{"srcSubresource": {"aspectMask": 1}, "dstSubresource": {"aspectMask": 1}}]
    layouts = {
        "srcImageLayout": "VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL",
        "dstImageLayout": "VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL",
    }
    program.call(
        "vkCmdResolveImage",
        commandBuffer=buffer,
        srcImage=source,
        dstImage=target,
        pRegions=regions,
        **layouts,
    )


def drawn(program: Program, *attachments: dict[str, object]) -> int:
    """A command buffer with a rendering."""
    buffer = program.buffer()
    program.rendering(buffer, list(attachments))
    program.draw(buffer)
    program.end(buffer, rendering=True)
    return buffer


def alternating(frames: int = 6, resolves: bool = True) -> Program:
    """Frames that resolve in the pass, and every second one in addition, after drawing something
    else, by a command.
    """
    program = Program()
    program.swap(2)
    color, shown = (
        program.image(usage=COLOR | SOURCE, name="scene"),
        program.image(samples=1, usage=COLOR | SAMPLED | TARGET | SOURCE),
    )
    other = program.image(samples=1, usage=COLOR | SAMPLED)
    view, shown_view, other_view = map(program.view, (color, shown, other))
    for frame in range(frames):
        if frame % 2 and resolves:
            program.submit(drawn(program, info(other_view, store="STORE")))
            buffer = program.buffer()
            program.rendering(buffer, [info(view, store="STORE")])
            program.draw(buffer)
            program.end(buffer, rendering=True)
            resolve(program, buffer, color, shown)
            program.submit(buffer)
        else:
            program.submit(drawn(program, info(view, resolve=shown_view)))
        program.present(frame % 2)
    return program


def stored(frames: int = 6) -> Program:
    """The same mistake in frames of two kinds: samples that nothing reads are stored."""
    program = Program()
    program.swap(2)
    view, shown, other = (
        program.view(program.image(samples=samples, name=name))
        for samples, name in ((4, "scene"), (1, "x"), (4, "y"))
    )
    for frame in range(frames):
        if frame % 2:
            program.submit(drawn(program, info(other)))
        program.submit(drawn(program, info(view, store="STORE", resolve=shown)))
        program.present(frame % 2)
    return program


def converted(program: Program, folder: Path) -> tuple[list[Finding], list[Finding]]:
    """The findings of a capture and of its description."""
    (folder / "p.jsonl").write_bytes(program.text())
    text = run(folder, "convert", "p.jsonl").stdout
    (folder / "frame.yaml").write_text(text)
    return lint(program.text()), lint(text.encode())


def test_what_one_kind_of_frame_reads_is_not_unread_in_another(tmp_path: Path) -> None:
    alone, text = converted(alternating(resolves=False), tmp_path)
    assert "MSAA401" in codes(alone)
    both, text = converted(alternating(), tmp_path)
    for findings in (both, text):
        assert "MSAA401" not in codes(findings)
        assert "MSAA301" in codes(findings)


def test_fixes_of_a_description_agree_about_what_its_documents_share(tmp_path: Path) -> None:
    for program in (alternating(), stored()):
        converted(program, tmp_path)
        run(tmp_path, "check", "--isolated", "--fix", "--unsafe-fixes", "frame.yaml")
        documents = (tmp_path / "frame.yaml").read_text().split("---\n")
        assert len(documents) == 2
        of_first_image = [
            next(line for line in document.split("  scene:")[1].splitlines() if "usage" in line)
            for document in documents
        ]
        assert of_first_image[0] == of_first_image[1]


def test_a_mistake_of_several_kinds_of_frame_is_one_finding_with_the_price_of_all(
    tmp_path: Path,
) -> None:
    for findings in converted(stored(), tmp_path):
        found = [finding for finding in findings if finding.code == "MSAA201"]
        assert len(found) == 1
        assert found[0].price is not None
        assert found[0].price.write_mb_per_s == pytest.approx(256 * 128 * 4 * 4 * 60 / 1e6)
    location = next(
        finding for finding in lint(stored().text()) if finding.code == "MSAA201"
    ).capture_location
    assert location is not None
    assert (location.frames, location.of) == (6, 6)


def test_the_same_mistake_of_two_passes_is_two_findings(tmp_path: Path) -> None:
    program = Program()
    program.swap(2)
    views = [program.view(program.image()) for _ in range(2)]
    for frame in range(4):
        for view in views[: 1 + frame % 2]:
            program.submit(drawn(program, info(view, store="STORE")))
        program.present(frame % 2)
    for findings in converted(program, tmp_path):
        assert codes(findings).count("MSAA201") == 2


def rotating(
    images: int,
    swapchain: int = 3,
    frames: int = 6,
    pass_object: bool = False,
    used: int | None = None,
) -> Program:
    """A program with a multisampled image for each swapchain image."""
    program = Program()
    shown = [program.view(image) for image in program.swap(swapchain)]
    views = [program.view(program.image()) for _ in range(images)]
    render_pass = framebuffers = None
    if pass_object:
        attachments = [
            attachment(),
            attachment(samples=1, load="DONT_CARE", store="STORE", final="PRESENT_SRC_KHR"),
        ]
        render_pass = program.render_pass(attachments, resolve=[1])
        framebuffers = [
            program.framebuffer(render_pass, [views[n % images], shown[n]])
            for n in range(swapchain)
        ]
    for frame in range(frames):
        index = frame % swapchain
        if render_pass is not None and framebuffers is not None:
            buffer = program.buffer()
            program.begin(buffer, render_pass, framebuffers[index])
            program.draw(buffer)
            program.end(buffer)
            program.submit(buffer)
        else:
            program.submit(
                drawn(program, info(views[index % (used or images)], resolve=shown[index]))
            )
        program.present(index)
    return program


@pytest.mark.parametrize(
    "program",
    [rotating(3), rotating(3, pass_object=True), rotating(3, frames=1), rotating(3, used=1)],
)
def test_an_image_for_each_swapchain_image_is_one_finding(program: Program, tmp_path: Path) -> None:
    for findings in converted(program, tmp_path):
        assert codes(findings).count("MSAA406") == 1
        assert codes(findings).count("MSAA401") == 1


@pytest.mark.parametrize("program", [rotating(1), rotating(2)])
def test_other_numbers_of_images_do_not_take_turns(program: Program, tmp_path: Path) -> None:
    for findings in converted(program, tmp_path):
        assert "MSAA406" not in codes(findings)


def test_images_that_do_not_exist_together_do_not_take_turns() -> None:
    program = Program()
    shown = [program.view(image) for image in program.swap(3)]
    for frame in range(3):
        image = program.image()
        program.submit(drawn(program, info(program.view(image), resolve=shown[frame])))
        program.present(frame)
        program.destroy("Image", "image", image)
    assert "MSAA406" not in codes(lint(program.text()))


def interface(count: int) -> Program:
    """A multisampled pass beside as many single-sampled ones, whose images it neither reads nor
    writes.
    """
    program = Program()
    shown = [program.view(image) for image in program.swap(2)]
    color = program.view(program.image())
    tiles = [program.view(program.image(samples=1, usage=COLOR | SAMPLED)) for _ in range(count)]
    for frame in range(2):
        for tile in tiles:
            program.submit(drawn(program, info(tile, store="STORE")))
        program.submit(drawn(program, info(color, store="STORE", resolve=shown[frame])))
        program.present(frame)
    return program


def test_what_has_nothing_to_do_with_multisampling_is_counted(tmp_path: Path) -> None:
    findings, text = converted(interface(5), tmp_path)
    assert codes(findings) == codes(text)
    assert "MSAA201" in codes(findings)
    description = (tmp_path / "frame.yaml").read_text()
    assert (
        "# left out: 5 images and 5 passes that multisampled images neither depend on nor lead to"
        in description
    )
    assert description.count("beginRendering") == 1


def test_a_capture_without_multisampled_images_has_nothing_to_check(tmp_path: Path) -> None:
    program = Program()
    view = program.view(program.swap(2)[0])
    program.submit(drawn(program, info(view, store="STORE")))
    program.present()
    findings, text = converted(program, tmp_path)
    assert findings == text == []
    checked = run(tmp_path, "check", "--isolated", "p.jsonl")
    assert checked.returncode == 0
    assert "nothing to check" in checked.stdout + checked.stderr


def test_what_feeds_a_multisampled_pass_is_described(tmp_path: Path) -> None:
    program = Program()
    shown = [program.view(image) for image in program.swap(2)]
    shadow, color = (
        program.view(program.image(samples=1, usage=COLOR | SAMPLED)),
        program.view(program.image()),
    )
    descriptors = program.descriptor_set()
    program.write(descriptors, shadow)
    for frame in range(2):
        program.submit(drawn(program, info(shadow, store="STORE")))
        buffer = program.buffer()
        program.rendering(buffer, [info(color, resolve=shown[frame])])
        program.bind(buffer, descriptors)
        program.draw(buffer)
        program.end(buffer, rendering=True)
        program.submit(buffer)
        program.present(frame)
    converted(program, tmp_path)
    description = (tmp_path / "frame.yaml").read_text()
    assert "left out" not in description
    assert description.count("beginRendering") == 2


def test_a_description_is_not_larger_than_what_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(yaml_text, "MAX_NODES", 400)
    findings, text = converted(stored(), tmp_path)
    assert [finding.message for finding in findings if finding.code == "MSAA906"] == [
        f"limit exceeded: {TOO_MUCH}"
    ]
    assert (tmp_path / "frame.yaml").read_text().count("share:") == 1
    assert not any(finding.fatal for finding in text)


def test_costs_say_what_they_do_not_include(tmp_path: Path) -> None:
    (tmp_path / "p.jsonl").write_bytes(interface(5).text())
    said = run(tmp_path, "cost", "p.jsonl")
    assert said.returncode == 0
    assert (
        "p.jsonl: the costs do not include 5 images and 5 passes that multisampled images neither "
        "depend on nor lead to" in said.stderr
    )


@pytest.mark.parametrize("pair", [("left", "right"), ("scene 0", "scene 1")])
def test_names_tell_whether_images_of_different_frames_take_turns(
    pair: tuple[str, str], tmp_path: Path
) -> None:
    """Images with names of their own are two things, those that are numbered are one."""
    program = Program()
    shown = [program.view(image) for image in program.swap(2)]
    views = [program.view(program.image(name=name)) for name in pair]
    extra = program.view(program.image(samples=1))
    for frame in range(4):
        if frame % 2:
            program.submit(drawn(program, info(views[1], store="STORE", resolve=extra)))
        program.submit(drawn(program, info(views[frame % 2], store="STORE", resolve=shown[0])))
        program.present(0)
    for findings in converted(program, tmp_path):
        assert codes(findings).count("MSAA201") == (2 if pair[0] == "left" else 1)
