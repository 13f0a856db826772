"""Which textures a frame in Metal's words names, and how often."""

from __future__ import annotations

from collections import Counter

from msaa_lint.frame.description.models import Metal, MetalCopy
from msaa_lint.frame.description.record import Record


class MetalMentions:
    """What is looked up in a frame in Metal's words, made once."""

    def __init__(self, metal: Metal) -> None:
        self.names: Counter[str] = Counter()
        """How often passes and commands name a texture."""
        self.copies: dict[tuple[str, str], list[int]] = {}
        """Where copies stand among the commands, by the textures that they copy from and to."""
        for each in metal.renderPasses.values():
            colors = each.colorAttachments
            stated = [*(colors.values() if isinstance(colors, dict) else colors), each.depthAttachment, each.stencilAttachment]
            for attachment in stated:
                self._count(attachment, "texture", "resolveTexture")
        for position, command in enumerate(metal.commands or ()):
            if command is None:
                continue
            body = command.body
            if command.kind == "present":
                self.names[str(body)] += 1
            self._count(body, "texture", "source", "destination")
            if isinstance(body, MetalCopy) and body.source is not None and body.destination is not None:
                self.copies.setdefault((body.source, body.destination), []).append(position)

    def _count(self, record: object, *members: str) -> None:
        for member in members if isinstance(record, Record) else ():
            name = getattr(record, member, None)
            if isinstance(name, str):
                self.names[name] += 1
