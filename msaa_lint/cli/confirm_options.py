"""The options of `confirm`, as data: read as those of `check` are, without waiting for typer."""

from __future__ import annotations

from collections.abc import Sequence

from . import options
from .options import SHARED, Given, Option

CONFIRM = (
    Option("device", "text", "A device, by a part of its name.  [default: llvmpipe where it is there, else the first]", "NAME", many=True),
    Option("list_devices", "flag", "List the devices that the Vulkan loader finds, and end."),
    Option("image", "text", "Write pictures there: as written, fixed, their difference, an edge enlarged (PNG).", "DIR"),
    Option("no_gate", "flag", "Try what the device does not support too: a driver may crash on it, in its own process."),
    Option("no_layer", "flag", "Do without the validation layer."),
    Option("timeout", "text", "The longest that one pass may take.  [default: 30]", "SECONDS"),
    Option("time", "flag", "Measure time.  [default: on a GPU, not on a software driver]"),
    Option("no_time", "flag", "Measure no time."),
    Option("repeats", "number", "How often each version of a pass is timed.  [default: 15]", "N"),
    Option("resolves", "flag", "Hold what resolves give against their samples, those of colour too; depth and stencil always are."),
    Option("size", "text", "Pixels, whatever the input says.", "WxH"),
    Option("samples", "number", "Sample count of every multisampled image, whatever the input says.", "N"),
    Option("select", "text", "Rules to use in place of the edition's: names, codes, prefixes (MSAA2), ALL.", "RULES", many=True),
    Option("extend_select", "text", "Rules to use as well.", "RULES", many=True),
    Option("ignore", "text", "Rules to leave out.", "RULES", many=True),
    Option("rules", "text", "A page or a folder of pages with rules of your own.", "PATH", many=True),
    Option("profile", "text", "The device, device class or vendor that inputs without a device are judged for.", "NAME"),
    Option("output", "text", "full, json; =FILE writes there.  [default: full]", "FORMAT[=FILE]", many=True),
    Option("verbose", "flag", "Show what only we find, noise of the layer, and what driver and layer print."),
    *SHARED,
)


def read(arguments: Sequence[str]) -> Given | None:
    """What the arguments of `confirm` say; None where they are not well formed, or ask for help."""
    return options.read(arguments, CONFIRM, ("list_devices",))
