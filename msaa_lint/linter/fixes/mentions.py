"""Where a document's records name images, and where waits are stated, looked up."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import Framebuffer, ImageBarrier, PipelineBarrier, Subpass, SubpassDependency
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.frame import Frame, Resolve

_MEMBERS = ("image", "srcImage", "dstImage", "resolveImage")

Wait = SubpassDependency | PipelineBarrier


class Mentions:
    """What of a frame names what."""

    def __init__(self, frame: Frame) -> None:
        self.of: dict[str, list[Record]] = {}
        """By image: the records that name it, each time that they do."""
        self.waits: dict[Span, list[Wait]] = {}
        """By the place of their source stages."""
        self.subpasses: dict[int, Subpass] = {}
        """By the identity of a depth-stencil resolve: the subpass that it is chained to."""
        self.resolves: dict[tuple[int, str], Resolve] = {}
        """By the identity of the record, and the aspect."""
        for record, name in _named(frame):
            self.of.setdefault(name, []).append(record)
        for described in frame.description.renderPasses.values():
            for subpass in described.subpasses:
                if subpass.depthStencilResolve is not None:
                    self.subpasses[id(subpass.depthStencilResolve)] = subpass
        for wait in _waits(frame):
            if wait.states("srcStageMask"):
                self.waits.setdefault(wait.place("srcStageMask"), []).append(wait)
        for each in frame.passes:
            for within in each.subpasses:
                self.resolves.update(((id(resolve.record), resolve.aspect), resolve) for resolve in within.resolves)

    def beside(self, name: str, records: list[Record]) -> bool:
        """Whether anything but some records names an image."""
        own = {id(record) for record in records}
        return any(id(record) not in own for record in self.of.get(name, ()))


def _named(frame: Frame) -> Iterator[tuple[Record, str]]:
    description = frame.description
    records: list[object] = [each for described in description.renderPasses.values() for each in described.attachments]
    for command in frame.commands:
        body = command.body
        infos = [*getattr(body, "colorAttachments", ()), getattr(body, "depthAttachment", None), getattr(body, "stencilAttachment", None)]
        records += [body, *infos, *(each for each in getattr(body, "images", ()) if isinstance(each, ImageBarrier))]
        if isinstance(body, PipelineBarrier):
            yield from ((body, each) for each in body.images if isinstance(each, str))
    for record in records:
        for member in _MEMBERS if isinstance(record, Record) else ():
            name = getattr(record, member, None)
            if isinstance(name, str) and isinstance(record, Record):
                yield record, name
    framebuffers: list[Framebuffer] = list(description.framebuffers.values())
    for framebuffer in framebuffers:
        yield from ((framebuffer, name) for name in framebuffer.attachments if name is not None)


def _waits(frame: Frame) -> Iterator[Wait]:
    for described in frame.description.renderPasses.values():
        yield from described.dependencies
    for command in frame.commands:
        if isinstance(command.body, PipelineBarrier):
            yield command.body
