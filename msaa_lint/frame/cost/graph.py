"""A frame as a graph: its passes in order, its images, and what moves between them, through memory
or on the tile.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Attachment, Pass

from .amounts import FrameCost, PassCost
from .compare import title

READ, WRITE, TILE = "read", "write", "tile"


class GraphImage(NamedTuple):
    """An image, or an attachment without one. `committed` is in bytes; None where the format,
    sample count, or size is unknown.
    """

    name: str
    format: str | None
    samples: int | None
    committed: int | None


class Flow(NamedTuple):
    """What a pass or command does with an image, the aspects together.

    `image` is its index in the graph. `direction` is `read` or `write` through memory, with the
    bytes of one frame, or `tile`: the attachment is drawn to and stays on the tile, and `bytes` is
    0. `source` is the image that a resolve reads on the tile; empty if the flow is not a resolve
    within a pass.
    """

    image: int
    action: str
    direction: str
    samples: int | None
    bytes: int
    source: str = ""


class GraphPass(NamedTuple):
    """A pass, or a command outside of passes (`kind` is `renderPass`, `rendering`, or `command`),
    with its reads before its writes.
    """

    name: str
    path: str
    kind: str
    times: int
    flows: tuple[Flow, ...]


class FrameGraph(NamedTuple):
    """Passes in the order in which the frame first runs them, and images in the order of their
    first use.
    """

    passes: tuple[GraphPass, ...]
    images: tuple[GraphImage, ...]


def frame_graph(frame: Frame, cost: FrameCost) -> FrameGraph:
    """The graph of a frame with its cost."""
    return _Graph(frame, cost).graph(cost)


class _Graph:
    def __init__(self, frame: Frame, cost: FrameCost) -> None:
        self._frame = frame
        self._passes = {render_pass.path: render_pass for render_pass in frame.passes}
        self._committed = {image.name: image.committed for image in cost.images}
        self._numbers: dict[tuple[str, str], int] = {}
        self._images: list[GraphImage] = []

    def graph(self, cost: FrameCost) -> FrameGraph:
        passes = tuple(
            GraphPass(title(each), each.path, each.kind, each.times, tuple(self._flows(each)))
            for each in cost.passes
        )
        return FrameGraph(passes, tuple(self._images))

    def _flows(self, cost: PassCost) -> Iterator[Flow]:
        render_pass = self._passes.get(cost.path)
        attachments = (
            {each.name: each for each in render_pass.attachments} if render_pass is not None else {}
        )
        sources = _resolve_sources(render_pass) if render_pass is not None else {}
        flows: dict[tuple[int, str, str], Flow] = {}
        moved = set()
        for line in cost.lines:
            moved.add(line.attachment)
            image = self._image(
                cost.path,
                line.image,
                line.attachment,
                attachments.get(line.attachment),
                line.samples,
            )
            key = (image, line.action, line.direction)
            before = flows[key].bytes if key in flows else 0
            source = sources.get(line.attachment, "") if line.action == "resolve" else ""
            flows[key] = Flow(
                image, line.action, line.direction, line.samples, before + line.bytes, source
            )
        for name, attachment in attachments.items():
            if attachment.used and name not in moved:
                target = attachment.targets[0] if attachment.targets else None
                named = target.name if target is not None and target.image is not None else ""
                image = self._image(cost.path, named, name, attachment, attachment.samples)
                flows.setdefault(
                    (image, "", TILE), Flow(image, "stays on the tile", TILE, attachment.samples, 0)
                )
        yield from sorted(
            flows.values(), key=lambda flow: (READ, TILE, WRITE).index(flow.direction)
        )

    def _image(
        self,
        path: str,
        name: str,
        attachment_name: str,
        attachment: Attachment | None,
        samples: int | None,
    ) -> int:
        """The number of an image. An attachment without one, and a buffer, belong to their pass or
        command.
        """
        key = (name, "") if name else (path, attachment_name)
        if key not in self._numbers:
            target = self._frame.target(name) if name else None
            if target is not None:
                image = GraphImage(
                    name,
                    target.format.name if target.format else None,
                    target.samples,
                    self._committed.get(name),
                )
            else:
                format = (
                    attachment.format.name
                    if attachment is not None and attachment.format is not None
                    else None
                )
                image = GraphImage(
                    attachment.title if attachment is not None else attachment_name,
                    format,
                    samples,
                    None,
                )
            self._numbers[key] = len(self._images)
            self._images.append(image)
        return self._numbers[key]


def _resolve_sources(render_pass: Pass) -> dict[str, str]:
    """The names of the attachments that the resolves of a pass read, by the attachment or image
    that they write.
    """
    sources = {}
    for resolve in render_pass.resolves:
        target, source = resolve.written_part, resolve.read_part
        if target is not None and source is not None and resolve.mode != "NONE":
            sources[target.name] = source.title
    return sources
