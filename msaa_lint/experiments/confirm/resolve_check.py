"""What a device's resolves give, told against the samples that they are of: what deviates is the driver's doing.

A probe is a tiny frame that resolves as a plan does. Its samples are read back one by one by a shader. Integers and stencil, which that
shader cannot read, have a witness: a colour drawn beside them, whose samples say which triangle each sample shows; what a triangle is
stored as is seen where it has all the samples of a pixel.
"""

from __future__ import annotations

import array
import math
import os
import shutil
import sys
from collections.abc import Mapping, MutableMapping, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from .frame_results import SAMPLES_OF, FrameRun
from .gate import gate
from .parts import COLOR, DEPTH, RENDER_PASS, STENCIL, Plan, to_json
from .protocol import Event
from .resolve_expected import AVERAGE, ENCODED_AVERAGE, GREATEST, LEAST, ZERO, Component, Expected, components, due, likeness, stored, value
from .resolve_probe import COMMAND, SAMPLES, Probe, Resolve, probe, resolves
from .scene import CLEARED, CLEARED_INTEGERS, CLEARED_STENCIL, DRAWN_STENCIL
from .session import Session
from .texels import Texels, format_name, format_of, texel_bytes, texels
from .vulkan_errors import Unusable

VERBS = {ZERO: "taking sample 0 of", AVERAGE: "averaging", LEAST: "taking the least of", GREATEST: "taking the greatest of"}
ASPECTS = {COLOR: "", DEPTH: "the depth of ", STENCIL: "the stencil of "}
WAYS = {RENDER_PASS: "a render pass", "rendering": "dynamic rendering", COMMAND: "vkCmdResolveImage"}
NAMES = {COLOR: "color", DEPTH: "depth", STENCIL: "stencil"}
"""What modes, aspects and ways are called, and what `texels` calls aspects."""

CLOSE = 0.004
"""More than half a code of the witness, less than any colour of the scene is from another."""

Samples = Sequence[Sequence[tuple[float, ...]] | None]
"""By pixel, rows from the top: its samples, each of the numbers that a shader reads of it; None where they are not known."""


class Deviation(NamedTuple):
    """A resolve that gives what it should not, at the pixel (x, y) that is furthest off.

    `format` is the VkFormat's number, `way` a kind of pass or `command`, `aspect` a VkImageAspectFlagBits, `mode` a VkResolveModeFlagBits;
    `given` and `expected` are of the component that is furthest off, of 0 to 1 where it is normalised, and as stored where it is sRGB;
    `text` say it all.
    """

    format: int
    samples: int
    way: str
    aspect: int
    mode: int
    x: int
    y: int
    given: float
    expected: float
    text: str


Cache = MutableMapping[tuple[str, Resolve], list[Deviation]]
"""What was found before, by the device's name and the resolve."""


def deviations(session: Session, plan: Plan, device: Mapping[str, Any], cache: Cache, color: bool = True) -> list[Deviation]:
    """How the device of a session deviates in what a plan resolves; without `color`, in depth and stencil alone.

    Every way of resolving is probed once for a `cache`, all those of one format and sample count in one run, or in two where both depth and
    stencil are resolved. Nothing is said of what the gate refuses, what cannot be read back, and of a driver that dies of a probe.
    """
    name = str(device.get("properties", {}).get("deviceName", ""))
    wanted = list(dict.fromkeys(each for own in resolves(plan).values() for each in own))
    if not color:
        wanted = [each for each in wanted if any(aspect != COLOR for aspect, _ in each.modes)]
    groups: dict[tuple[int, int], list[Resolve]] = {}
    for each in wanted:
        if (name, each) not in cache:
            cache[name, each] = []
            groups.setdefault((each.format, each.samples), []).append(each)
    for group in groups.values():
        made = probe(group, plan)
        if made is not None:
            for each, found in _probed(session, made, device):
                cache[name, each].append(found)
    return [found for each in wanted for found in cache[name, each]]


def of_pass(plan: Plan, number: int, found: Sequence[Deviation]) -> list[Deviation]:
    """Those of some deviations that a pass shows, or a command after it, by its number."""
    own = {(r.format, r.samples, r.way, *modes) for r in resolves(plan).get(number, ()) for modes in r.modes}
    return [each for each in found if each[:5] in own]


def _probed(session: Session, made: Probe, device: Mapping[str, Any]) -> list[tuple[Resolve, Deviation]]:
    refused = gate(made.plan, device)
    going = [number for number in range(len(made.plan.passes)) if number not in refused]
    found = []
    for seen in made.seen if going else ():
        folder = session.folder("probe")
        want = {"pixels": folder, "repeats": 0, "warmups": 0, "size": None, "samples_of": seen}
        try:
            run = session.run(to_json(made.plan), going, want)
            for number, (resolve, at) in enumerate(made.resolves):
                if at in going and run.passes[at].created:
                    found += [(resolve, each) for each in _judged(resolve, number, seen, run, folder)]
        except Unusable:
            # Whoever runs something next is told.
            break
        finally:
            shutil.rmtree(folder, ignore_errors=True)
    return found


def _judged(resolve: Resolve, number: int, seen: str, run: FrameRun, folder: str) -> list[Deviation]:
    name, form = format_name(resolve.format), format_of(format_name(resolve.format))
    read = _samples(run.images.get(seen + SAMPLES_OF), folder)
    if form is None or read is None:
        return []
    found = []
    for aspect, mode in resolve.modes:
        direct = aspect == DEPTH or (aspect == COLOR and not form.is_integer)
        if direct != (seen == SAMPLES):
            continue
        stencil = aspect == STENCIL and form.aspects != ("stencil",)
        event = run.images.get(f"{number}:stencil" if stencil else str(number))
        size = texel_bytes(form, NAMES[aspect])
        data = _file(event, folder, size * event["width"] * event["height"]) if event is not None else None
        given = texels(form, data, event["width"], NAMES[aspect]) if event is not None and data is not None else None
        if given is None or given.width * given.height != len(read):
            continue
        known: Samples = read if direct else witnessed(read, given, aspect)
        deviation = judged(name, resolve, aspect, mode, known, given)
        found += [deviation] if deviation is not None else []
    return found


def _samples(event: Event | None, folder: str) -> list[list[tuple[float, ...]]] | None:
    """The samples of every pixel, each four numbers."""
    if event is None:
        return None
    count = event["samples"]
    data = _file(event, folder, event["width"] * event["height"] * count * 16)
    if data is None or not count:
        return None
    numbers = array.array("f", data)
    if sys.byteorder == "big":
        numbers.byteswap()
    every = list(zip(*[iter(numbers)] * 4, strict=True))
    return [every[at : at + count] for at in range(0, len(every), count)]


def _file(event: Event, folder: str, size: int) -> bytes | None:
    """What a file of a run holds, where it is of that folder and of that size in bytes."""
    path = os.path.realpath(event["path"])
    if os.path.dirname(path) != os.path.realpath(folder):
        return None
    try:
        with open(path, "rb") as file:
            data = file.read(size + 1)
    except OSError:
        return None
    return data if len(data) == size else None


def witnessed(read: Sequence[Sequence[tuple[float, ...]]], given: Texels, aspect: int) -> Samples:
    """The samples of an image that is not read, by those of its witness and by what it resolves to where all samples are alike.

    What attachments are cleared to, and what is drawn into stencil, is known.
    """
    if aspect == STENCIL:
        return [[(float(CLEARED_STENCIL if _is_cleared(each) else DRAWN_STENCIL),) for each in samples] for samples in read]
    known: dict[tuple[float, ...], tuple[float, ...]] = {}
    planes = [given.planes.get(name) for name in "RGBA"]
    wide = min(given.bits.values()) >= max(CLEARED_INTEGERS).bit_length()
    for pixel, samples in enumerate(read):
        if samples[0] not in known and all(each == samples[0] for each in samples):
            cleared = wide and _is_cleared(samples[0])
            known[samples[0]] = CLEARED_INTEGERS if cleared else tuple(plane[pixel] if plane is not None else 0 for plane in planes)
    return [[known[each] for each in samples] if all(each in known for each in samples) else None for samples in read]


def _is_cleared(seen: Sequence[float]) -> bool:
    """Whether a sample of the witness is what it was cleared to."""
    return all(abs(one - other) < CLOSE for one, other in zip(seen, CLEARED, strict=True))


def judged(name: str, resolve: Resolve, aspect: int, mode: int, samples: Samples, given: Texels) -> Deviation | None:
    """How an image that was resolved deviates from the samples it is of; None where it is as it should be.

    `name` is the format's. Components of several widths or kinds are each held to their own.
    """
    form = format_of(name)
    assert form is not None
    worst: tuple[float, int, Component, float, float] | None = None
    wrong: dict[Component, list[tuple[float, Sequence[float]]]] = {}
    every = components(form, aspect)
    planes = [given.planes[own.name] for own in every]
    # Most pixels are as another is.
    pixels: dict[tuple[object, ...], int] = {}
    for pixel, read in enumerate(samples):
        if read is not None:
            pixels.setdefault((*read, *[plane[pixel] for plane in planes]), pixel)
    for pixel in pixels.values():
        for own, plane in zip(every, planes, strict=True):
            codes, expected = _due(own, mode, tuple(each[own.place] for each in samples[pixel] or ()))
            # The lowest code of SNORM is -1 as the one above it is.
            found = max(plane[pixel], -own.codes) if own.numeric == "SNORM" else plane[pixel]
            if expected.met(found) or (own.numeric == "WHOLE" and resolve.way == COMMAND and found in codes):
                continue
            wrong.setdefault(own, []).append((found, codes))
            distance = abs(value(own, found) - value(own, expected.value))
            distance = math.inf if math.isnan(distance) else distance
            if worst is None or distance > worst[0]:
                worst = distance, pixel, own, found, expected.value
    if worst is None:
        return None
    _, pixel, own, found, right = worst
    x, y = pixel % given.width, pixel // given.width
    given_value, right_value = value(own, found), value(own, right)
    text = _words(name, resolve, aspect, mode, own, (x, y), (given_value, right_value), likeness(own, wrong[own]))
    return Deviation(resolve.format, resolve.samples, resolve.way, aspect, mode, x, y, given_value, right_value, text)


@lru_cache(1 << 14)
def _due(own: Component, mode: int, read: tuple[float, ...]) -> tuple[tuple[float, ...], Expected]:
    """What the samples of a component are stored as, and what is due of them: the same in every way of resolving."""
    codes = tuple(stored(own, each) for each in read)
    return codes, due(own, mode, codes)


def _words(
    name: str, resolve: Resolve, aspect: int, mode: int, own: Component, at: tuple[int, int], values: tuple[float, float], like: str
) -> str:
    part = f"{ASPECTS[aspect]}{name}"
    of = f"{VERBS.get(mode, f'mode {mode} of')} {part} at {resolve.samples} samples in {WAYS[resolve.way]}"
    component = f" in {own.name}" if aspect == COLOR else ""
    code = " as stored" if own.numeric == "SRGB" else ""
    given, right = (f"{each:.6g}" for each in values)
    which = f", which is {like}" if like else ""
    whose = "the driver's doing"
    if like == ENCODED_AVERAGE:
        whose += ", as Vulkan does not insist on linear light"
    elif resolve.way == COMMAND and own.numeric != "WHOLE":
        whose += ", as Vulkan leaves to it how this command resolves"
    return f"{of} gives {given}{code}{component} at {at}{which}; {right} is due: {whose}"
