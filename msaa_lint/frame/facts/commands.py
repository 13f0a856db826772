"""The table of recorded commands: the images that each names, what it does to them, and the usages
that this needs.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from msaa_lint.frame.description.models import (
    BeginRendering,
    Command,
    ImageBarrier,
    PipelineBarrier,
)
from msaa_lint.frame.description.record import Record

READ = "read"
PRESENT = "present"
COPY_READ = "copy read"
RESOLVE_READ = "resolve read"
CLEAR = "clear"
COPY_WRITE = "copy write"
RESOLVE_WRITE = "resolve write"
WRITE = "write"

COMMAND_READS = frozenset({READ, PRESENT, COPY_READ, RESOLVE_READ})
COMMAND_WRITES = frozenset({CLEAR, COPY_WRITE, RESOLVE_WRITE, WRITE})

END_COMMANDS = ("endRenderPass", "endRendering")


class ImageAccess(NamedTuple):
    """How a command uses the image that a member of it names. `usages` are the image usages that
    allow it: one of them is needed.
    """

    member: str
    effect: str
    usages: tuple[str, ...] = ()


_SOURCE = ("TRANSFER_SRC",)
_TARGET = ("TRANSFER_DST",)
_COPY = (ImageAccess("srcImage", COPY_READ, _SOURCE), ImageAccess("dstImage", COPY_WRITE, _TARGET))
_CLEAR = (ImageAccess("image", CLEAR, _TARGET),)

COMMANDS: dict[str, tuple[ImageAccess, ...]] = {
    "readImage": (ImageAccess("image", READ, ("SAMPLED", "STORAGE")),),
    "writeImage": (ImageAccess("image", WRITE, ("STORAGE",)),),
    "present": (ImageAccess("image", PRESENT),),
    "copyImage": _COPY,
    "blitImage": _COPY,
    "resolveImage": (
        ImageAccess("srcImage", RESOLVE_READ, _SOURCE),
        ImageAccess("dstImage", RESOLVE_WRITE, _TARGET),
    ),
    "copyImageToBuffer": (ImageAccess("srcImage", COPY_READ, _SOURCE),),
    "copyBufferToImage": (ImageAccess("dstImage", COPY_WRITE, _TARGET),),
    "clearColorImage": _CLEAR,
    "clearDepthStencilImage": _CLEAR,
}
"""The commands that read or write whole images; passes, draws and barriers aside."""


def accesses(command: Command) -> Iterator[tuple[str, ImageAccess]]:
    """The images that a command of the table names, each with its access."""
    for access in COMMANDS.get(command.kind, ()):
        name = getattr(command.body, access.member, None)
        if isinstance(name, str):
            yield name, access


def image_of(command: Command, *effects: str) -> str | None:
    """The image that a command has one of some effects on; None where it names none."""
    return next((name for name, access in accesses(command) if access.effect in effects), None)


def naming_records(command: Command) -> Iterator[tuple[Record, str]]:
    """Every image that a command names, attachments of renderings and barriers included, with the
    record that names it.
    """
    body = command.body
    if isinstance(body, BeginRendering):
        for rate in (body.fragmentDensityMapAttachment, body.fragmentShadingRateAttachment):
            if rate is not None and rate.image is not None:
                yield rate, rate.image
        for info in (*body.colorAttachments, body.depthAttachment, body.stencilAttachment):
            for name in (info.image, info.resolveImage) if info is not None else ():
                if info is not None and name is not None:
                    yield info, name
    elif isinstance(body, PipelineBarrier):
        for image in body.images:
            record, name = (
                (image, image.image) if isinstance(image, ImageBarrier) else (body, image)
            )
            if name is not None:
                yield record, name
    elif isinstance(body, Record):
        yield from ((body, name) for name, _ in accesses(command))


def named_images(command: Command) -> Iterator[str]:
    """The images of `naming_records`."""
    return (name for _, name in naming_records(command))
