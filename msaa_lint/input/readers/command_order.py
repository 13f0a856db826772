"""Checks that the commands of a description begin and end render passes in an order that Vulkan
allows.
"""

from __future__ import annotations

from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.models import Command, Description

_ENDS = {"beginRenderPass": "endRenderPass", "beginRendering": "endRendering"}
_BEGINS = {end: begin for begin, end in _ENDS.items()}


def check_order(binder: Binder, description: Description) -> None:
    """Reports a begin within a render pass, an end that ends none, and the end of the other kind.

    The commands may be a part of a frame, so the last render pass may stay open.
    """
    opened: Command | None = None
    for command in description.commands or ():
        if command is None:
            # It is reported, and may have been any command.
            return
        name = command.kind
        if name in _ENDS:
            if opened is not None:
                message = (
                    f"`{name}` stands in the render pass that {_place(opened)} begins; write "
                    f"`- {_ENDS[opened.kind]}` before it"
                )
                binder.report("MSAA904", message, command.head, command.path)
                return
            opened = command
        elif name in _BEGINS:
            if opened is None:
                message = (
                    f"`{name}` ends nothing, as no `{_BEGINS[name]}` is open; remove it, or "
                    "begin the render pass before it"
                )
                binder.report("MSAA904", message, command.head, command.path)
                return
            if _ENDS[opened.kind] != name:
                message = (
                    f"`{name}` cannot end what {_place(opened)} begins; write "
                    f"`{_ENDS[opened.kind]}`"
                )
                binder.report("MSAA904", message, command.head, command.path)
                return
            opened = None


def _place(command: Command) -> str:
    return f"`{command.path}`"
