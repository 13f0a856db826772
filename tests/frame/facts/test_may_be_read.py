"""`mayBeRead`: what something that is not described may read is neither read nor unread."""

from __future__ import annotations

import pytest

from tests.frame.facts.test_facts import found
from tests.input.captures.program import codes, lint

FRAME = """
images:
  color: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED]{color}}}
  depth: {{format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED]{depth}}}
  shown: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]{shown}}}
device: mali-g76
commands:
  - beginRendering:
      colorAttachments: [{{image: color, loadOp: CLEAR, storeOp: {store}, resolveMode: AVERAGE, resolveImage: shown}}]
      depthAttachment: {{image: depth, loadOp: CLEAR, storeOp: STORE}}
  - draw: {{vertexCount: 300}}
  - endRendering
{read}
"""


def frame(*images: str, store: str = "DONT_CARE", read: str = "") -> str:
    """A frame in which something else may read some images."""
    marks = {
        image: ", mayBeRead: true" if image in images else ""
        for image in ("color", "depth", "shown")
    }
    return FRAME.format(**marks, store=store, read=f"  - readImage: {read}" if read else "")


@pytest.mark.parametrize(
    ("images", "reported"), [((), True), (("depth",), False), (("shown",), True)]
)
def test_what_may_be_read_is_not_reported_as_unread(
    images: tuple[str, ...], reported: bool
) -> None:
    found = codes(lint(frame(*images).encode()))
    assert ("MSAA203" in found or "MSAA208" in found) is reported
    assert "MSAA307" not in found


@pytest.mark.parametrize(("images", "confidence"), [((), "high"), (("color",), "medium")])
def test_samples_that_are_resolved_and_stored_are_reported_with_less_confidence(
    images: tuple[str, ...], confidence: str
) -> None:
    (found,) = [
        each for each in lint(frame(*images, store="STORE").encode()) if each.code == "MSAA201"
    ]
    assert found.confidence == confidence


@pytest.mark.parametrize("marked", [False, True])
def test_the_facts_are_unknown(marked: bool) -> None:
    images = ("color", "depth", "shown") if marked else ()
    known: dict[str, set[object]] = {}
    for subject in found(frame(*images)):
        if subject.facts.values.get("aspect.name") != "color":
            for name in (
                "image.read",
                "aspect.read_later",
                "aspect.readers_known",
                "resolve.target_read",
            ):
                if name in subject.facts.values:
                    known.setdefault(name, set()).add(subject.facts.values[name])
    unread = {
        "image.read": {False},
        "aspect.read_later": {False},
        "aspect.readers_known": {True},
        "resolve.target_read": {False},
    }
    assert known == ({"aspect.readers_known": {False}} if marked else unread)


@pytest.mark.parametrize(("images", "reported"), [((), True), (("depth",), False)])
def test_one_sample_is_enough_only_if_nothing_else_may_read(
    images: tuple[str, ...], reported: bool
) -> None:
    text = frame(*images, read="{image: depth, stage: FRAGMENT, access: SHADER_READ, samples: 1}")
    assert ("MSAA307" in codes(lint(text.encode()))) is reported


@pytest.mark.parametrize(
    ("access", "reported"),
    [("SHADER_READ", True), ("MEMORY_READ", False), ("TRANSFER_READ", False)],
)
def test_only_shaders_fetch_samples(access: str, reported: bool) -> None:
    text = frame(read=f"{{image: depth, access: {access}}}")
    assert ("MSAA307" in codes(lint(text.encode()))) is reported
