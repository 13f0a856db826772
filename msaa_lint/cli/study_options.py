"""The options of `study`, as data: read as those of `check` are, without waiting for typer."""

from __future__ import annotations

from collections.abc import Sequence

from . import options
from .options import SHARED, Given, Option

STUDY = (
    Option("list_scenes", "flag", "List the scenes, and end."),
    Option("samples", "text", "Sample counts.  [default: 1,2,4,8,16]", "N,..."),
    Option("techniques", "text", "Ways of taking samples.  [default: msaa,sample-shading,ssaa]", "NAME,..."),
    Option("size", "text", "Pixels.  [default: what the description states, else 1920x1080]", "WxH"),
    Option("device", "text", "Measure times on this Vulkan device, by a part of its name.  [default: no times]", "NAME"),
    Option("repeats", "number", "How often each technique is timed.  [default: 15]", "N"),
    Option("profile", "text", "The device whose traffic the cost model reckons, where an input states none.", "NAME"),
    Option("bits", "choice", "Bits of sub-pixel precision that vertices are snapped to.  [default: 8]", choices=("4", "8")),
    Option("ssim", "flag", "Measure structural similarity too (extra `ssim`)."),
    Option("output", "text", "full, json; =FILE writes there.  [default: full]", "FORMAT[=FILE]", many=True),
    Option("plot", "text", "Plot accuracy against time, .svg or .png (extra `chart`).", "FILE"),
    Option("crops", "text", "Write enlarged crops of each scene there, side by side (PNG).", "DIR"),
    Option("record", "flag", "Leave a record beside each description, for rule sample-count-above-four."),
    Option("resume", "text", "Keep each point there as it is done, and take those that are there.", "FOLDER"),
    Option("jobs", "number", "Points that are simulated at once.  [default: one for each core, or worker of a cluster]", "N"),
    Option(
        "backend",
        "choice",
        "How joblib spreads them.  [default: loky, processes of this machine]",
        choices=("loky", "threading", "dask", "ray"),
    ),
    *SHARED,
)


def read(arguments: Sequence[str]) -> Given | None:
    """What the arguments of `study` say; None where they are not well formed, or ask for help."""
    return options.read(arguments, STUDY, ("list_scenes",))
