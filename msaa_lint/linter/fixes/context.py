"""Data about one frame that fixes look up."""

from __future__ import annotations

from functools import cached_property

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Document, Lowered
from msaa_lint.frame.description.models import (
    ClearAttachments,
    Framebuffer,
    Metal,
    PipelineBarrier,
    SubpassDependency,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Attachment, Pass, Resolve
from msaa_lint.frame.facts.subjects import FrameAnalysis

from .changes import Change
from .command_uses import CommandUses
from .references import References

Wait = SubpassDependency | PipelineBarrier


class FixContext:
    """The frame of a document and indexes of it, all built on first use."""

    def __init__(self, document: Document) -> None:
        self.document = document

    @cached_property
    def frame(self) -> Frame:
        return Frame(self.document)

    @cached_property
    def analysis(self) -> FrameAnalysis:
        return FrameAnalysis(self.frame)

    @cached_property
    def uses(self) -> CommandUses:
        return CommandUses(self.frame)

    @cached_property
    def references(self) -> References:
        """The records that name images or, in a Metal description, textures."""
        description = self.document.description
        return (
            References(description, "images")
            if description.metal is None
            else References(description.metal, "metal.textures")
        )

    @property
    def metal(self) -> Metal:
        """The `metal` section of a Metal description."""
        metal = self.document.description.metal
        assert metal is not None
        return metal

    @property
    def lowered(self) -> Lowered:
        """The Metal records that the Vulkan records of a Metal description come from."""
        assert self.document.metal is not None
        return self.document.metal

    @cached_property
    def commands_at(self) -> dict[Span, list[tuple[int, int | None]]]:
        """The positions of commands, and the entries of vkCmdClearAttachments, by the places that
        facts point to.
        """
        commands: dict[Span, list[tuple[int, int | None]]] = {}
        for position, command in enumerate(self.frame.commands):
            commands.setdefault(command.head, []).append((position, None))
            if isinstance(command.body, ClearAttachments):
                for entry, cleared in enumerate(command.body.attachments):
                    commands.setdefault(cleared.place("aspect"), []).append((position, entry))
        return commands

    @cached_property
    def waits(self) -> dict[Span, list[Wait]]:
        """The subpass dependencies and barriers by the place of their source stages."""
        waits: list[Wait] = [
            wait
            for record in self.document.description.renderPasses.values()
            for wait in record.dependencies
        ]
        waits += (body for _, body in self.frame.recorded(PipelineBarrier))
        by_place: dict[Span, list[Wait]] = {}
        for wait in waits:
            if wait.states("srcStageMask"):
                by_place.setdefault(wait.place("srcStageMask"), []).append(wait)
        return by_place

    @cached_property
    def resolves(self) -> dict[tuple[int, str], Resolve]:
        """The resolves within passes, by the identity of their record and their aspect."""
        subpasses = [
            subpass for render_pass in self.frame.passes for subpass in render_pass.subpasses
        ]
        return {
            (id(resolve.record), resolve.aspect): resolve
            for subpass in subpasses
            for resolve in subpass.resolves
        }

    @cached_property
    def continued(self) -> dict[int, list[Record]]:
        """By the identity of an attachment's record: those of the renderings that it suspends or
        resumes, which must state the same.
        """
        groups: dict[int, list[Pass]] = {}
        for render_pass in self.frame.passes:
            before = self.analysis.walk.suspended.get(id(render_pass))
            groups[id(render_pass)] = [
                *(groups[id(before)] if before is not None else ()),
                render_pass,
            ]
        continued: dict[int, list[Record]] = {}
        for group in groups.values():
            for attachments in (
                zip(*(each.attachments for each in group), strict=False) if len(group) > 1 else ()
            ):
                records = [attachment.record for attachment in attachments]
                continued.update((id(record), records) for record in records)
        return continued

    @cached_property
    def framebuffers(self) -> dict[str, list[Framebuffer]]:
        """The framebuffers by render pass."""
        framebuffers: dict[str, list[Framebuffer]] = {}
        for framebuffer in self.document.description.framebuffers.values():
            framebuffers.setdefault(framebuffer.renderPass or "", []).append(framebuffer)
        return framebuffers

    @cached_property
    def attachments(self) -> dict[int, list[tuple[Pass, Attachment]]]:
        """The attachments that an image is bound to, with their passes, by the identity of the
        image's record.
        """
        attachments: dict[int, list[tuple[Pass, Attachment]]] = {}
        for render_pass in self.frame.passes:
            for attachment in render_pass.attachments:
                for record in {id(target.record) for target in attachment.targets}:
                    attachments.setdefault(record, []).append((render_pass, attachment))
        return attachments

    def drop_command(self, position: int) -> Change:
        """Removes the command at a position of the frame."""
        # Rules only run on documents without errors, so the frame has all commands of the
        # description.
        return Change(self.document.description, "commands", "drop", position)
