"""Checks a device's resolves against the samples that they resolve: deviations are due to the
driver.

A probe is a tiny frame that resolves as a plan does. A shader reads its samples back one by one.
Integers and stencil, which that shader cannot read, have a witness: a color drawn next to them
whose samples identify the triangle of each sample; the stored value of a triangle is known from
pixels where it has all samples.
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
from .parts import COLOR, DEPTH, RENDER_PASS, STENCIL, Plan
from .protocol import Event
from .resolve_expected import (
    AVERAGE,
    ENCODED_AVERAGE,
    GREATEST,
    LEAST,
    ZERO,
    Component,
    Expected,
    components,
    due,
    likeness,
    stored,
    value,
)
from .resolve_probe import COMMAND, SAMPLES, Probe, Resolve, probe, resolves
from .scene import CLEARED, CLEARED_INTEGERS, CLEARED_STENCIL, DRAWN_STENCIL
from .session import Session
from .texels import Texels, format_name, format_of, texel_bytes, texels
from .vulkan_errors import Unusable

VERBS = {
    ZERO: "taking sample 0 of",
    AVERAGE: "averaging",
    LEAST: "taking the minimum of",
    GREATEST: "taking the maximum of",
}
ASPECTS = {COLOR: "", DEPTH: "the depth of ", STENCIL: "the stencil of "}
WAYS = {
    RENDER_PASS: "a render pass",
    "rendering": "dynamic rendering",
    COMMAND: "vkCmdResolveImage",
}
NAMES = {COLOR: "color", DEPTH: "depth", STENCIL: "stencil"}
"""The names of modes, aspects and ways of resolving, and the names of aspects in `texels`."""

CLOSE = 0.004
"""More than half a code of the witness, less than the distance between any two colors of the
scene.
"""

Samples = Sequence[Sequence[tuple[float, ...]] | None]
"""By pixel, in rows from the top: the components of each of its samples as a shader reads them;
None if unknown.
"""


class Deviation(NamedTuple):
    """An incorrect resolve, with the pixel (x, y) that deviates most.

    `format` is the VkFormat's number, `way` a kind of pass or `command`, `aspect` a
    VkImageAspectFlagBits, `mode` a VkResolveModeFlagBits; `given` and `expected` are the values of
    the component that deviates most: 0 to 1 for normalized formats, and as stored for sRGB. `text`
    is the full description.
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
"""Known deviations, by the device's name and the resolve."""


def deviations(
    session: Session, plan: Plan, device: Mapping[str, Any], cache: Cache, color: bool = True
) -> list[Deviation]:
    """The deviations of the resolves of a plan on the device of a session; without `color`, those
    of depth and stencil only.

    Every way of resolving is probed once per `cache`: those of one format and sample count in one
    run, or in two if both depth and stencil are resolved. Resolves that the device does not
    support, images that cannot be read back, and drivers that die are ignored.
    """
    name = str(device.get("properties", {}).get("deviceName", ""))
    requested = list(
        dict.fromkeys(resolve for of_pass in resolves(plan).values() for resolve in of_pass)
    )
    if not color:
        requested = [
            resolve for resolve in requested if any(aspect != COLOR for aspect, _ in resolve.modes)
        ]
    groups: dict[tuple[int, int], list[Resolve]] = {}
    for resolve in requested:
        if (name, resolve) not in cache:
            cache[name, resolve] = []
            groups.setdefault((resolve.format, resolve.samples), []).append(resolve)
    for group in groups.values():
        probe_frame = probe(group, plan)
        if probe_frame is not None:
            for resolve, deviation in _probed(session, probe_frame, device):
                cache[name, resolve].append(deviation)
    return [deviation for resolve in requested for deviation in cache[name, resolve]]


def of_pass(plan: Plan, number: int, all_deviations: Sequence[Deviation]) -> list[Deviation]:
    """The deviations that concern a pass, or the commands after it."""
    resolves_of_pass = {
        (r.format, r.samples, r.way, *modes)
        for r in resolves(plan).get(number, ())
        for modes in r.modes
    }
    return [deviation for deviation in all_deviations if deviation[:5] in resolves_of_pass]


def _probed(
    session: Session, probe_frame: Probe, device: Mapping[str, Any]
) -> list[tuple[Resolve, Deviation]]:
    refused = gate(probe_frame.plan, device)
    runnable = [number for number in range(len(probe_frame.plan.passes)) if number not in refused]
    deviations_found = []
    for multisampled in probe_frame.seen if runnable else ():
        folder = session.folder("probe")
        want = {"pixels": folder, "samples_of": multisampled}
        try:
            run = session.run(probe_frame.plan, runnable, want)
            if run.failed:
                raise RuntimeError(f"the probe of the resolves failed: {run.failed}")
            for number, (resolve, at) in enumerate(probe_frame.resolves):
                if at in runnable and run.passes[at].created:
                    deviations_found += [
                        (resolve, deviation)
                        for deviation in _judged(resolve, number, multisampled, run, folder)
                    ]
        except Unusable:
            # The next run reports it.
            break
        finally:
            shutil.rmtree(folder, ignore_errors=True)
    return deviations_found


def _judged(
    resolve: Resolve, number: int, multisampled: str, run: FrameRun, folder: str
) -> list[Deviation]:
    name, format = format_name(resolve.format), format_of(format_name(resolve.format))
    samples_read = _samples(run.images.get(multisampled + SAMPLES_OF), folder)
    if format is None or samples_read is None:
        return []
    deviations_found = []
    for aspect, mode in resolve.modes:
        direct = aspect == DEPTH or (aspect == COLOR and not format.is_integer)
        if direct != (multisampled == SAMPLES):
            continue
        stencil = aspect == STENCIL and format.aspects != ("stencil",)
        event = run.images.get(f"{number}:stencil" if stencil else str(number))
        size = texel_bytes(format, NAMES[aspect])
        data = (
            _file(event, folder, size * event["width"] * event["height"])
            if event is not None
            else None
        )
        resolved = (
            texels(format, data, event["width"], NAMES[aspect])
            if event is not None and data is not None
            else None
        )
        if resolved is None or resolved.width * resolved.height != len(samples_read):
            continue
        known: Samples = samples_read if direct else witnessed(samples_read, resolved, aspect)
        deviation = judged(name, resolve, aspect, mode, known, resolved)
        deviations_found += [deviation] if deviation is not None else []
    return deviations_found


def _samples(event: Event | None, folder: str) -> list[list[tuple[float, ...]]] | None:
    """The samples of every pixel, four numbers each."""
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
    """The contents of a file of a run; None unless it is in that folder and has that size in
    bytes.
    """
    path = os.path.realpath(event["path"])
    if os.path.dirname(path) != os.path.realpath(folder):
        return None
    try:
        with open(path, "rb") as file:
            data = file.read(size + 1)
    except OSError:
        return None
    return data if len(data) == size else None


def witnessed(
    witness: Sequence[Sequence[tuple[float, ...]]], resolved: Texels, aspect: int
) -> Samples:
    """The samples of an image that cannot be read, from those of its witness and from the resolved
    value where all samples are equal.

    The clear values and the stencil value of draws are known.
    """
    if aspect == STENCIL:
        return [
            [
                (float(CLEARED_STENCIL if _is_cleared(sample) else DRAWN_STENCIL),)
                for sample in samples
            ]
            for samples in witness
        ]
    known: dict[tuple[float, ...], tuple[float, ...]] = {}
    planes = [resolved.planes.get(name) for name in "RGBA"]
    wide = min(resolved.bits.values()) >= max(CLEARED_INTEGERS).bit_length()
    for pixel, samples in enumerate(witness):
        if samples[0] not in known and all(sample == samples[0] for sample in samples):
            cleared = wide and _is_cleared(samples[0])
            known[samples[0]] = (
                CLEARED_INTEGERS
                if cleared
                else tuple(plane[pixel] if plane is not None else 0 for plane in planes)
            )
    return [
        [known[sample] for sample in samples]
        if all(sample in known for sample in samples)
        else None
        for samples in witness
    ]


def _is_cleared(seen: Sequence[float]) -> bool:
    """Whether a sample of the witness has the clear value."""
    return all(abs(one - other) < CLOSE for one, other in zip(seen, CLEARED, strict=True))


def judged(
    name: str, resolve: Resolve, aspect: int, mode: int, samples: Samples, resolved: Texels
) -> Deviation | None:
    """How a resolved image deviates from its samples; None if it is correct.

    `name` is that of the format. Components of different widths or types are checked separately.
    """
    format = format_of(name)
    assert format is not None
    worst: tuple[float, int, Component, float, float] | None = None
    incorrect: dict[Component, list[tuple[float, Sequence[float]]]] = {}
    all_components = components(format, aspect)
    planes = [resolved.planes[component.name] for component in all_components]
    # Most pixels equal another one: check each distinct pixel once.
    pixels: dict[tuple[object, ...], int] = {}
    for pixel, pixel_samples in enumerate(samples):
        if pixel_samples is not None:
            pixels.setdefault((*pixel_samples, *[plane[pixel] for plane in planes]), pixel)
    for pixel in pixels.values():
        for component, plane in zip(all_components, planes, strict=True):
            codes, expected = _due(
                component, mode, tuple(sample[component.place] for sample in samples[pixel] or ())
            )
            # The lowest code of SNORM represents -1, like the one above it.
            code = (
                max(plane[pixel], -component.codes)
                if component.numeric == "SNORM"
                else plane[pixel]
            )
            if expected.met(code) or (
                component.numeric == "WHOLE" and resolve.way == COMMAND and code in codes
            ):
                continue
            incorrect.setdefault(component, []).append((code, codes))
            distance = abs(value(component, code) - value(component, expected.value))
            distance = math.inf if math.isnan(distance) else distance
            if worst is None or distance > worst[0]:
                worst = distance, pixel, component, code, expected.value
    if worst is None:
        return None
    _, pixel, component, code, expected_code = worst
    x, y = pixel % resolved.width, pixel // resolved.width
    given_value, right_value = value(component, code), value(component, expected_code)
    text = _description(
        name,
        resolve,
        aspect,
        mode,
        component,
        (x, y),
        (given_value, right_value),
        likeness(component, incorrect[component]),
    )
    return Deviation(
        resolve.format,
        resolve.samples,
        resolve.way,
        aspect,
        mode,
        x,
        y,
        given_value,
        right_value,
        text,
    )


@lru_cache(1 << 14)
def _due(
    component: Component, mode: int, samples_read: tuple[float, ...]
) -> tuple[tuple[float, ...], Expected]:
    """The stored values of a component's samples and the expected result, which do not depend on
    the way of resolving.
    """
    codes = tuple(stored(component, sample) for sample in samples_read)
    return codes, due(component, mode, codes)


def _description(
    name: str,
    resolve: Resolve,
    aspect: int,
    mode: int,
    component: Component,
    at: tuple[int, int],
    values: tuple[float, float],
    like: str,
) -> str:
    verb = VERBS.get(mode, f"mode {mode} of")
    what = f"{verb} {ASPECTS[aspect]}{name} at {resolve.samples} samples in {WAYS[resolve.way]}"
    encoding = " as stored" if component.numeric == "SRGB" else ""
    channel = f" in {component.name}" if aspect == COLOR else ""
    actual, expected = (f"{number:.6g}" for number in values)
    which = f", which is {like}" if like else ""
    cause = "this is up to the driver"
    if like == ENCODED_AVERAGE:
        cause += ", because Vulkan does not require linear light"
    elif resolve.way == COMMAND and component.numeric != "WHOLE":
        cause += ", because Vulkan does not specify how this command resolves"
    return f"{what} gives {actual}{encoding}{channel} at {at}{which}; expected {expected}: {cause}"
