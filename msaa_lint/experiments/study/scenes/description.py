"""A scene of what a description contains: its `scene` section, its pipelines, and the formats and resolves of its passes.

Each thing that the description calls for has a part of the picture, side by side, with its effects.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from msaa_lint.frame.description.models import DepthStencilState, MultisampleState, Pipeline
from msaa_lint.frame.facts.frame import Frame

from . import depth, detail, edges, light
from .scene import MIN_SIZE, Scene
from .side_by_side import side_by_side


class _GlobalEffects(NamedTuple):
    """The effects that apply to the whole picture: the reason for each, and its settings."""

    why: dict[str, str]
    settings: dict[str, object]


def from_description(frame: Frame, width: int, height: int) -> Scene:
    """The scene of a description, named after its file. ValueError where the picture is too small for all its parts."""
    names = _part_names(frame)
    part_width = width // len(names)
    if part_width < MIN_SIZE or height < MIN_SIZE:
        parts = ", ".join(names)
        raise ValueError(f"{width}x{height} pixels are too few for {parts} side by side: each needs at least {MIN_SIZE}x{MIN_SIZE}")
    effects = _GlobalEffects({}, {})
    _add_light(frame, effects)
    if "intersecting" in names:
        _add_depth_resolve(frame, effects)
    _add_coverage(frame, effects)
    display = light.display if "tone-mapping" in effects.why else None
    scene = side_by_side([_part(name, frame, part_width, height, display) for name in names], width, height)
    return scene._replace(
        name=frame.document.source.name,
        description=f"what the description calls for: {', '.join(names)}",
        effects=tuple(dict.fromkeys((*scene.effects, *effects.why))),
        why={**scene.why, **effects.why},
        settings={**scene.settings, **effects.settings},
    )


def _part_names(frame: Frame) -> list[str]:
    """The names of the scenes that get a part of the picture; edges alone where nothing is called for."""
    stated = frame.description.scene
    names = []
    if (stated is not None and stated.depth is not None) or any(state.depthTestEnable for state in _depth_states(frame)):
        names.append("intersecting")
    if (stated is not None and stated.alphaTest) or any(state.alphaToCoverageEnable for _, state in _multisample_states(frame)):
        names.append("foliage")
    if stated is not None and stated.textureDetail:
        names.append("zone-plate")
    if any(_blends(pipeline) for pipeline, _ in frame.pipelines):
        names.append("glass")
    if any(state.stencilTestEnable for state in _depth_states(frame)):
        names.append("portal")
    has_edges = stated.edges if stated is not None and stated.edges is not None else True
    return ["edge-fan", *names] if has_edges or not names else names


def _depth_states(frame: Frame) -> Iterator[DepthStencilState]:
    return (pipeline.depthStencilState for pipeline, _ in frame.pipelines if pipeline.depthStencilState is not None)


def _multisample_states(frame: Frame) -> Iterator[tuple[Pipeline, MultisampleState]]:
    return ((pipeline, pipeline.multisampleState) for pipeline, _ in frame.pipelines if pipeline.multisampleState is not None)


def _blends(pipeline: Pipeline) -> bool:
    return pipeline.colorBlendState is not None and any(blend.blendEnable for blend in pipeline.colorBlendState.attachments)


def _add_light(frame: Frame, effects: _GlobalEffects) -> None:
    """HDR, tone mapping and sRGB."""
    stated = frame.description.scene
    if stated is not None and stated.color == "HDR":
        effects.why["hdr"] = f"scene.color is HDR, scene.peak {_peak(frame):g} times display white"
        setting = {"AFTER_RESOLVE": "after-resolve", "IN_PASS": "before-resolve"}.get(stated.toneMapping or "AFTER_RESOLVE")
        if setting is not None:
            effects.why["tone-mapping"] = f"scene.toneMapping is {stated.toneMapping or 'not stated: after the resolve'}"
            effects.settings["tone-mapping"] = setting
        return
    for target in frame.all_targets:
        if "COLOR_ATTACHMENT" not in _usage(target.record):
            continue
        if target.format is not None and target.format.is_srgb:
            effects.why["srgb"] = f"{target.title} is {target.format.name}: the resolve averages light"
            effects.settings["srgb"] = "linear-light"
            return
        if target.image is not None and target.image.encoding == "GAMMA":
            effects.why["srgb"] = f"{target.title} holds encoded values in a format without sRGB: the resolve averages codes"
            effects.settings["srgb"] = "encoded"
            return


def _usage(record: object) -> tuple[str, ...]:
    """The usages of an image; an unstated usage, or an attachment without an image, may be a color attachment."""
    usage = getattr(record, "usage", None)
    return ("COLOR_ATTACHMENT",) if usage is None else tuple(usage)


def _peak(frame: Frame) -> float:
    stated = frame.description.scene
    if stated is None or stated.color != "HDR":
        return 1.0
    return float(stated.peak) if stated.peak is not None else light.EMITTER[0]


def _is_reversed(frame: Frame) -> bool:
    stated = frame.description.scene
    if stated is not None and stated.depth is not None:
        return stated.depth == "REVERSED"
    return any((state.depthCompareOp or "").startswith("GREATER") for state in _depth_states(frame))


def _add_depth_resolve(frame: Frame, effects: _GlobalEffects) -> None:
    stated = frame.description.scene
    for subpass in (subpass for render_pass in frame.passes for subpass in render_pass.subpasses):
        for resolve in subpass.resolves:
            if resolve.aspect == "depth" and resolve.mode in ("SAMPLE_ZERO", "AVERAGE", "MIN", "MAX"):
                effects.why["depth-resolve"] = f"{resolve.path} resolves depth with {resolve.mode}"
                effects.settings["depth-resolve"] = resolve.mode
                return
    consumer = stated.depthResolveWants if stated is not None else None
    if consumer in ("NEAREST", "FARTHEST"):
        mode = "MAX" if (consumer == "NEAREST") == _is_reversed(frame) else "MIN"
        effects.why["depth-resolve"] = f"scene.depthResolveWants is {consumer}: {mode}"
        effects.settings["depth-resolve"] = mode


def _add_coverage(frame: Frame, effects: _GlobalEffects) -> None:
    """The sample mask, and alpha to coverage besides an alpha test."""
    for pipeline, state in _multisample_states(frame):
        every_sample = (1 << min(state.rasterizationSamples or 16, 16)) - 1
        if state.sampleMask and state.sampleMask[0] & every_sample != every_sample:
            effects.why["sample-mask"] = f"{pipeline.path}.multisampleState.sampleMask is {state.sampleMask[0]:#x}"
            effects.settings["sample-mask"] = state.sampleMask[0]
        if state.alphaToCoverageEnable:
            effects.why["alpha-to-coverage"] = "a pipeline sets alphaToCoverageEnable"
            effects.settings["alpha-to-coverage"] = "dithered"


def _part(name: str, frame: Frame, width: int, height: int, display: light.Display | None) -> Scene:
    stated = frame.description.scene
    if name == "edge-fan":
        return _with_peak(edges.edge_fan(width, height), _peak(frame), display)
    if name == "intersecting":
        return (depth.intersecting_reversed if _is_reversed(frame) else depth.intersecting)(width, height, display)
    if name == "zone-plate":
        return detail.zone_plate(width, height, display)
    if name == "glass":
        return light.glass(width, height, display)
    if name == "portal":
        return _with_peak(depth.portal(width, height), 1.0, display)
    leaves = detail.foliage(width, height)
    if not (stated is not None and stated.alphaTest):
        leaves = leaves._replace(effects=(), why={})
    return _with_peak(leaves, 1.0, display)


def _with_peak(scene: Scene, peak: float, display: light.Display | None) -> Scene:
    """A scene of white shapes on black with `peak` times the brightness."""
    color = np.array([peak, peak, peak, 1.0])
    displayed = color if display is None else display(color)

    def exact(triangles: light.Floats) -> light.Floats:
        picture: light.Floats = scene.exact(triangles)[..., 3:] * displayed
        return picture

    return scene._replace(colors=scene.colors * color, exact=exact)
