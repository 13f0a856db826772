"""A description as it was read: what every reader gives."""

from collections.abc import Mapping
from typing import NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source

from .models import Description, MetalStencilAttachment
from .problems import Problem
from .record import Record


class StencilApart(NamedTuple):
    """A stencil attachment with a texture of its own, which Vulkan's render passes have not: the names of its attachment and of the one
    that it is resolved to, if it is, and the structure that states it."""

    attachment: str
    target: str | None
    record: MetalStencilAttachment


class Lowered(NamedTuple):
    """What the Vulkan records of a frame in Metal's words were made of."""

    attachments: dict[int, Mapping[str, Record]]
    """By the identity of an attachment's record: by aspect, the structure that states it; nothing for what is only resolved to."""
    stencils: dict[int, StencilApart]
    """By the identity of a subpass's record."""
    api: str = "METAL"
    """The API whose rules are asked of the frame: VULKAN where the Vulkan frame itself is meant."""


class Document(NamedTuple):
    """One frame, or part of one.

    `whole` says that what the description does not hold the frame does not have: the passes and pipelines listed are all there are. It is
    false for dumps of a single pipeline. `problems` are the mistakes in the description itself; a document with problems is not judged.
    """

    source: Source
    description: Description
    problems: tuple[Problem, ...]
    whole: bool = True
    path: str = ""
    """What stands before every structural path: `documents[1]` in a stream of several, else nothing."""
    modules: Mapping[str, bytes] = {}
    """The code of shaders that came with the input, by the names that `pipelines` have for them; those of a description lie beside it."""
    tree: Node | None = None
    """The description as a tree that was made of something else: of source code, of a shorthand. None where the text itself is one."""
    pieces: bool = False
    """Whether it is of pieces of a program that a page shows, and not of a whole file."""
    ordered: bool = True
    """Whether the passes run in the order in which they are stated, and the commands are all that is recorded. Code says neither."""
    metal: Lowered | None = None
    """Of a frame in Metal's words: where its Vulkan records come from."""

    @property
    def api(self) -> str:
        """The API whose rules are asked of the frame: VULKAN or METAL."""
        return "VULKAN" if self.metal is None else self.metal.api
