"""A capture that is cut anywhere: the frames before the cut are linted, and one error says that it
ends.
"""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from msaa_lint.core.finding import Finding
from tests.input.captures.program import Program, attachment, lint
from tests.input.captures.test_same import DIALECTS
from tests.input.compressed import COMPRESS

FRAMES = 6


def frames() -> Program:
    """Frames that store 4x samples that nothing reads."""
    program = Program()
    program.swap(1)
    render_pass = program.render_pass([attachment(samples=4, store="STORE")])
    framebuffer = program.framebuffer(render_pass, [program.view(program.image())])
    pipeline = program.pipeline(render_pass)
    for _ in range(FRAMES):
        buffer = program.buffer()
        program.begin(buffer, render_pass, framebuffer)
        program.draw(buffer, pipeline)
        program.end(buffer)
        program.submit(buffer)
        program.present()
    return program


PROGRAM = frames()
TEXTS = {dialect: write(PROGRAM.calls) for dialect, write in DIALECTS.items()}


def stored(findings: list[Finding]) -> list[Finding]:
    return [found for found in findings if found.code == "MSAA201"]


def presents(text: bytes, cut: int) -> int:
    """How many presents stand before the line of a cut; a call is in one line, or ends before the
    line of the next.
    """
    return len(re.findall(rb'vkQueuePresentKHR"', text[: text.rfind(b"\n", 0, cut) + 1]))


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(sorted(TEXTS)), st.integers(0, 9999).map(lambda number: number / 10000))
def test_the_frames_before_a_cut_are_linted(dialect: str, part: float) -> None:
    text = TEXTS[dialect]
    cut = int(len(text) * part)
    head = text[:cut]
    findings = lint(head)
    codes = [found.code for found in findings]
    assert "MSAA941" not in codes
    whole = lint(text)
    lines = text.lstrip().startswith(b"{")
    at_line_end = head.endswith((b"\n", b"}")) or not head.strip()
    if len(head) < 200:
        # Less than what says which format it is.
        assert not stored(findings)
        return
    # RenderDoc's first frame is all; a call takes several lines in formats that indent.
    frames = 0 if dialect.startswith("RenderDoc") else presents(text, cut) - (0 if lines else 1)
    if frames > 0:
        (found,) = stored(findings)
        (expected,) = stored(whole)
        assert (found.message, found.confidence) == (expected.message, expected.confidence)
        assert found.capture_location is not None and found.capture_location.of >= frames
    if not (lines and at_line_end):
        assert codes.count("MSAA901") == 1
        assert all(
            found.message.startswith(("the capture ends here: ", "invalid "))
            for found in findings
            if found.code == "MSAA901"
        )


@settings(max_examples=40, deadline=None)
@given(st.sampled_from(sorted(COMPRESS)), st.integers(0, 9999).map(lambda number: number / 10000))
def test_a_cut_in_compressed_data(format: str, part: float) -> None:
    text = TEXTS["gfxreconstruct 1.x, lines"]
    # As a tool that flushes after each frame writes it.
    members = [COMPRESS[format](line) for line in re.split(rb"(?<=PresentInfo)", text)]
    sizes = [sum(map(len, members[: number + 1])) for number in range(len(members))]
    data = b"".join(members)
    cut = int(len(data) * part)
    findings = lint(data[:cut])
    codes = [found.code for found in findings]
    assert "MSAA941" not in codes
    assert codes.count("MSAA901") == 1 or cut in sizes
    if cut >= sizes[2]:
        assert len(stored(findings)) == 1


@pytest.mark.parametrize("dialect", TEXTS)
def test_whole_captures_have_no_error(dialect: str) -> None:
    assert [found.code for found in lint(TEXTS[dialect]) if found.fatal] == []
    assert len(stored(lint(TEXTS[dialect]))) == 1
