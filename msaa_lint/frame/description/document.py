"""A description as it was read: the result of every reader."""

from collections.abc import Mapping, Set
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span

from .models import BeginRendering, Description, MetalStencilAttachment
from .problems import Problem
from .record import Record


class StencilApart(NamedTuple):
    """A stencil attachment with its own texture, which Vulkan's render passes cannot have.

    `attachment` is its name, `target` the name of the attachment that it is resolved to, `record`
    the structure that states it.
    """

    attachment: str
    target: str | None
    record: MetalStencilAttachment


class Lowered(NamedTuple):
    """The origins of the Vulkan records of a frame in Metal's terms."""

    attachments: dict[int, Mapping[str, Record]]
    """By the identity of an attachment's record: the structure that states each aspect; empty for a
    mere resolve target.
    """
    stencils: dict[int, StencilApart]
    """By the identity of a subpass's record."""
    api: str = "METAL"
    """The API whose rules apply: VULKAN if the Vulkan frame itself is meant."""


class Basis(NamedTuple):
    """What the values that were read from source code rest on.

    `conditions` are those that were decided for the value at a place, by their subjects; `assumed`
    are the values that the code does not state, by their places, each with the assumption in words
    (empty: an assumption of the document).
    """

    conditions: Mapping[Span, Set[str]] = {}
    assumed: Mapping[Span, str] = {}


class Document(NamedTuple):
    """One frame, or part of one.

    `whole` says that the description lists all passes and pipelines of the frame; it is false for a
    dump of a single pipeline. `problems` are the mistakes in the description itself; rules check
    the `rest` of a document with problems.
    """

    source: Source
    description: Description
    problems: tuple[Problem, ...]
    whole: bool = True
    path: str = ""
    """The prefix of every structural path: `documents[1]` in a stream of several documents, else
    empty.
    """
    modules: Mapping[str, bytes] = {}
    """The code of shaders that came with the input, by their names in `pipelines`; the shaders of a
    description are files beside it.
    """
    tree: Node | None = None
    """The description as a tree, if it was built from source code or a shorthand; None if the text
    itself is a description.
    """
    pieces: bool = False
    """Whether it was built from excerpts of a program on a page, and not from a whole file."""
    ordered: bool = True
    """Whether the passes run in their order, and the commands are complete. Neither is known of
    source code.
    """
    complete: bool = True
    """Whether everything was read that may use an image or a pass; where not, facts of the whole
    frame are unknown.
    """
    metal: Lowered | None = None
    """The origins of the Vulkan records, for a frame in Metal's terms."""
    basis: Basis = Basis()
    """What the values of a document from source code rest on."""
    rest: "Document | None" = None
    """Of a document with problems, what could be read; None where that says nothing by itself."""
    format: str = ""
    """The format that it was read in, as `--input-format` names it; empty for source code."""

    @property
    def is_frame_of_program(self) -> bool:
        """Whether it states how often its frame occurs in its program, and has no problems."""
        frame = self.description.frame
        return frame is not None and frame.share is not None and not self.problems

    @property
    def has_unread_structures(self) -> bool:
        """Whether a pNext chain has a structure that was not read: what nothing that was read uses
        may be used all the same.
        """
        records: list[Record] = list(self.description.images.values())
        for render_pass in self.description.renderPasses.values():
            records += (render_pass, *render_pass.attachments, *render_pass.subpasses)
        for command in self.description.commands or ():
            if command is not None and isinstance(command.body, BeginRendering):
                attachments = (
                    *command.body.colorAttachments,
                    command.body.depthAttachment,
                    command.body.stencilAttachment,
                )
                records += (
                    command.body,
                    *(attachment for attachment in attachments if attachment is not None),
                )
        return any(getattr(record, "pNext", ()) for record in records)

    @property
    def api(self) -> str:
        """The API whose rules apply: VULKAN or METAL."""
        return "VULKAN" if self.metal is None else self.metal.api
