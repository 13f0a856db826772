"""Command buffers that are recorded again with the same calls contain the same, whether that is
recognized or determined again.
"""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import pytest

from msaa_lint.input.captures.call import Call
from msaa_lint.input.captures.description_text import describe_capture
from msaa_lint.input.captures.recordings import Recordings
from msaa_lint.input.captures.tracker import Tracker
from msaa_lint.input.readers import gfxreconstruct

EXAMPLE = Path(__file__).parents[3] / "examples" / "capture" / "forward.jsonl"
NEW_OBJECTS = '"vkCreate', '"vkAllocate', '"vkBind', '"vkGet', '"vkDestroy', '"vkFree'


def frames() -> tuple[list[str], list[str]]:
    """The lines before the frames, and those of the frames without their indices."""
    lines = EXAMPLE.read_text().splitlines()
    first = next(number for number, line in enumerate(lines) if '"vkBeginCommandBuffer"' in line)
    last = max(number for number, line in enumerate(lines) if '"vkQueueSubmit' in line)
    return lines[:first], [
        line.partition(",")[2]
        for line in lines[first : last + 1]
        if not any(name in line for name in NEW_OBJECTS)
    ]


def description(lines: list[str], recognized: bool) -> tuple[str, int, int]:
    """What is described, the number of frames, and that of recordings that were recognized."""
    restored = 0
    tracker = Tracker()
    restore = Recordings._restore

    def counted(self: Recordings) -> None:
        nonlocal restored
        restored += 1
        restore(self)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Recordings, "_restore", counted)
        for call in gfxreconstruct.calls(
            BytesIO("\n".join(lines).encode() + b"\n"), tracker.wanted, None
        ):
            tracker.feed(
                call if recognized or not isinstance(call, Call) else call._replace(recurring=0)
            )
    tracker.finish()
    return describe_capture(tracker)[0], tracker.frames.total, restored


CHANGED = "begin", "draw", "end", "destroyed", "updated", "cut"


@pytest.mark.parametrize("changed", ["", *CHANGED])
def test_what_recurs_is_recognized_and_means_the_same(changed: str) -> None:
    once, repeated = frames()
    lines = list(once)
    for number in range(12):
        for line in repeated:
            recorded = line
            if number % 3 == 2:
                if changed == "draw" and '"vkCmdDraw"' in line:
                    recorded = line.replace('"vertexCount":', '"vertexCount":9')
                if changed == "begin" and "BeginRender" in line and "beginRender" not in line:
                    recorded = line.replace('"renderPass":', '"renderPass":9')
                if changed == "end" and '"vkEndCommandBuffer"' in line:
                    continue
                if changed == "destroyed" and '"vkCmdDraw"' in line:
                    lines.append(
                        f'{{"index":{len(lines)},"vkFunc":{{"name":"vkDestroyFramebuffer","args":{{"device":2,"framebuffer":1}}}}}}'
                    )
                if changed == "updated" and '"vkCmdDraw"' in line:
                    update = '"vkFunc":{"name":"vkUpdateDescriptorSets","args":{"pDescriptorWrites":[],"pDescriptorCopies":[]}}'
                    lines.append(f'{{"index":{len(lines)},{update}}}')
            lines.append(f'{{"index":{len(lines)},{recorded}')
    if changed == "cut":
        del lines[-20:]
    text, count, restored = description(lines, recognized=True)
    assert (text, count) == description(lines, recognized=False)[:2]
    assert restored > 4
