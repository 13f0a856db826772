"""A scene of what a description calls for: its `scene` section, its pipelines, the formats and resolves of its passes. Each thing that is
called for has a part of the picture, side by side, and its effects; what is not is not there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from msaa_lint.frame.description.models import Pipeline
from msaa_lint.frame.facts.frame import Frame

from . import LEAST, depth, detail, edges, light
from .scene import Scene
from .side_by_side import beside


class _Called(NamedTuple):
    """The parts of a picture, and effects that hold for all of it with their reasons and settings."""

    parts: list[Scene]
    why: dict[str, str]
    settings: dict[str, object]


def from_description(frame: Frame, width: int, height: int) -> Scene:
    """The scene of a description, named as its file. ValueError where the picture is too small for all that it calls for."""
    names = _parts(frame)
    each = width // len(names)
    if each < LEAST or height < LEAST:
        raise ValueError(f"{width}x{height} pixels are too few for {', '.join(names)} side by side: {LEAST} for each")
    called = _Called([], {}, {})
    _light(frame, called)
    _depth(frame, called)
    _coverage(frame, called)
    shown = light.displayed if "tone-mapping" in called.why else None
    for name in names:
        called.parts.append(_part(name, frame, called, each, height, shown))
    made = beside(called.parts, width, height)
    effects = tuple(dict.fromkeys((*made.effects, *called.why)))
    settings = {**made.settings, **called.settings}
    says = f"what the description calls for: {', '.join(names)}"
    return made._replace(name=frame.document.source.name, says=says, effects=effects, why={**made.why, **called.why}, settings=settings)


def _parts(frame: Frame) -> list[str]:
    """What has a part of the picture, by the names of scenes. Where nothing is called for it is edges, which are what samples are for."""
    stated = frame.description.scene
    names = []
    if (stated is not None and stated.depth is not None) or any(_tests_depth(each) for each in _pipelines(frame)):
        names.append("intersecting")
    if (stated is not None and stated.alphaTest) or any(_covers(each) for each in _pipelines(frame)):
        names.append("foliage")
    if stated is not None and stated.textureDetail:
        names.append("zone-plate")
    if any(_blends(each) for each in _pipelines(frame)):
        names.append("glass")
    if any(each.depthStencilState is not None and each.depthStencilState.stencilTestEnable for each in _pipelines(frame)):
        names.append("portal")
    edges_called = stated.edges if stated is not None and stated.edges is not None else True
    return ["edge-fan", *names] if edges_called or not names else names


def _pipelines(frame: Frame) -> Iterator[Pipeline]:
    return (pipeline for pipeline, _ in frame.pipelines)


def _tests_depth(pipeline: Pipeline) -> bool:
    return pipeline.depthStencilState is not None and bool(pipeline.depthStencilState.depthTestEnable)


def _covers(pipeline: Pipeline) -> bool:
    return pipeline.multisampleState is not None and bool(pipeline.multisampleState.alphaToCoverageEnable)


def _blends(pipeline: Pipeline) -> bool:
    return pipeline.colorBlendState is not None and any(each.blendEnable for each in pipeline.colorBlendState.attachments)


def _light(frame: Frame, called: _Called) -> None:
    """HDR, tone mapping, sRGB."""
    stated = frame.description.scene
    if stated is not None and stated.color == "HDR":
        called.why["hdr"] = f"scene.color is HDR, scene.peak {_peak(frame):g} times display white"
        place = {"AFTER_RESOLVE": "after-resolve", "IN_PASS": "before-resolve"}.get(stated.toneMapping or "AFTER_RESOLVE")
        if place is not None:
            called.why["tone-mapping"] = f"scene.toneMapping is {stated.toneMapping or 'not stated: after the resolve'}"
            called.settings["tone-mapping"] = place
        return
    for target in frame.all_targets:
        if target.format is not None and target.format.is_srgb and "COLOR_ATTACHMENT" in _usage(target.record):
            called.why["srgb"] = f"{target.title} is {target.format.name}: its light is averaged"
            called.settings["srgb"] = "linear-light"
            return
        if target.image is not None and target.image.encoding == "GAMMA" and "COLOR_ATTACHMENT" in _usage(target.record):
            called.why["srgb"] = f"{target.title} holds encoded values in a format without sRGB: codes are averaged"
            called.settings["srgb"] = "encoded"
            return


def _usage(record: object) -> tuple[str, ...]:
    """The usages of an image; one that is not stated, or an attachment without an image, may be of any use."""
    usage = getattr(record, "usage", None)
    return ("COLOR_ATTACHMENT",) if usage is None else tuple(usage)


def _peak(frame: Frame) -> float:
    stated = frame.description.scene
    peak = stated.peak if stated is not None and stated.color == "HDR" else None
    return float(peak) if peak is not None else light.EMITTER[0] if stated is not None and stated.color == "HDR" else 1.0


def _reversed(frame: Frame) -> bool:
    stated = frame.description.scene
    if stated is not None and stated.depth is not None:
        return stated.depth == "REVERSED"
    states = [each.depthStencilState for each in _pipelines(frame)]
    return any(state is not None and (state.depthCompareOp or "").startswith("GREATER") for state in states)


def _depth(frame: Frame, called: _Called) -> None:
    """Depth resolve. The test comes with its part of the picture."""
    if "intersecting" not in _parts(frame):
        return
    stated = frame.description.scene
    for subpass in (each for own in frame.passes for each in own.subpasses):
        for resolve in subpass.resolves:
            if resolve.aspect == "depth" and resolve.mode in ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX"):
                called.why["depth-resolve"] = f"{resolve.path} resolves depth by {resolve.mode}"
                called.settings["depth-resolve"] = resolve.mode
                return
    wants = stated.depthResolveWants if stated is not None else None
    if wants in ("NEAREST", "FARTHEST"):
        mode = "MAX" if (wants == "NEAREST") == _reversed(frame) else "MIN"
        called.why["depth-resolve"] = f"scene.depthResolveWants is {wants}: {mode}"
        called.settings["depth-resolve"] = mode


def _coverage(frame: Frame, called: _Called) -> None:
    """Sample mask, and alpha to coverage beside an alpha test."""
    for pipeline in _pipelines(frame):
        state = pipeline.multisampleState
        if state is not None and state.sampleMask and state.sampleMask[0] & 0xFFFF != 0xFFFF:
            count = state.rasterizationSamples or 16
            if state.sampleMask[0] & ((1 << count) - 1) != (1 << count) - 1:
                called.why["sample-mask"] = f"{pipeline.path}.multisampleState.sampleMask is {state.sampleMask[0]:#x}"
                called.settings["sample-mask"] = state.sampleMask[0]
    if any(_covers(each) for each in _pipelines(frame)):
        called.why["alpha-to-coverage"] = "a pipeline sets alphaToCoverageEnable"
        called.settings["alpha-to-coverage"] = "dithered"


def _part(name: str, frame: Frame, called: _Called, width: int, height: int, shown: light.Shown | None) -> Scene:
    stated = frame.description.scene
    if name == "edge-fan":
        return _lit(edges.edge_fan(width, height), _peak(frame), shown)
    if name == "intersecting":
        made = (depth.intersecting_reversed if _reversed(frame) else depth.intersecting)(width, height, shown)
        return made
    if name == "zone-plate":
        return detail.zone_plate(width, height, shown)
    if name == "glass":
        return light.glass(width, height, shown)
    if name == "portal":
        return _lit(depth.portal(width, height), 1.0, shown)
    leaves = detail.foliage(width, height)
    if not (stated is not None and stated.alphaTest):
        leaves = leaves._replace(effects=(), why={})
    return _lit(leaves, 1.0, shown)


def _lit(scene: Scene, peak: float, shown: light.Shown | None) -> Scene:
    """White shapes on black, so many times as bright."""
    color = np.array([peak, peak, peak, 1.0])
    display = color if shown is None else shown(color)

    def exact(triangles: light.Floats) -> light.Floats:
        made: light.Floats = scene.exact(triangles)[..., 3:] * display
        return made

    return scene._replace(colors=scene.colors * color, exact=exact)
