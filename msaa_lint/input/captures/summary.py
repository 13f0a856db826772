"""What a capture contains, in a few numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator
from typing import Any

from msaa_lint.core.finding import CaptureSummary

from .command_buffers import RenderPassBegin
from .frame_kinds import FrameKind
from .names import pipeline_samples
from .objects import Image, Pipeline, RenderPass, images_in
from .tracker import Tracker


def capture_summary(tracker: Tracker, left_out: str) -> CaptureSummary:
    """The program, the device, the frames, and the passes that these begin; without frames, the
    render passes that are created.
    """
    frames = tracker.frames
    samples: dict[Hashable, int] = {}
    for kind in frames.kinds.values():
        samples.update(_passes(kind))
    if not frames.kinds:
        created = (each for each in tracker.distinct.values() if isinstance(each, RenderPass))
        samples.update((each, _attachment_samples(each)) for each in created)
    counts = Counter(samples.values())
    return CaptureSummary(
        tracker.program,
        tracker.engine,
        tracker.device_name(),
        frames.total,
        len(frames.kinds),
        dict(sorted(counts.items())),
        len(tracker.multisampled),
        frames.dropped,
        left_out,
        sum(
            isinstance(each, Pipeline) and pipeline_samples(each) > 1
            for each in tracker.distinct.values()
        ),
    )


def _passes(kind: FrameKind) -> Iterator[tuple[Hashable, int]]:
    """The passes of a kind of frame, each with its sample count."""
    for command in kind.passes:
        begin: Any = command.key
        if isinstance(begin, RenderPassBegin):
            yield (
                begin.render_pass,
                max([_attachment_samples(begin.render_pass), *_counts(begin.images)]),
            )
        else:
            yield begin, max(_counts(images_in(begin)), default=1)


def _attachment_samples(render_pass: RenderPass) -> int:
    """The most samples that an attachment of a render pass states."""
    return max(
        (each.get("samples") or 1 for each in render_pass.tree.get("attachments", ())), default=1
    )


def _counts(images: Any) -> list[int]:
    return [image.samples for image in images if isinstance(image, Image)]
