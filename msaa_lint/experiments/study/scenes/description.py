"""A scene of what a description contains: its `scene` section, its pipelines, and the formats and
resolves of its passes.

Each thing that the description calls for has a part of the picture, side by side, with its effects.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from msaa_lint.experiments.confirm.parts import Image
from msaa_lint.experiments.confirm.texels import format_name
from msaa_lint.experiments.study.frame_plans import FramePlans
from msaa_lint.experiments.study.plan_samples import attached
from msaa_lint.frame.description.models import Pipeline
from msaa_lint.frame.facts.frame import Frame

from . import area, depth, detail, edges, light
from .scene import MIN_SIZE, Scene
from .side_by_side import side_by_side
from .view import Truth, View

SMALL = 256.0
"""Triangles of at most so many pixels are shown as a mesh of them: their inner edges are
everywhere.
"""


ASSUMED_PEAK = 4.0
"""The brightest light of floating-point images of which nothing else is stated, in units of display
white.
"""


class _GlobalEffects(NamedTuple):
    """The effects that apply to the whole picture: the reason for each, and its settings."""

    why: dict[str, str]
    settings: dict[str, object]


class _Content(NamedTuple):
    """What the passes draw whose samples a study compares: their pipelines, the mean area of their
    triangles in pixels (None if unknown), the color images with light above display white, and
    whether there is color at all.
    """

    frame: Frame
    pipelines: list[Pipeline]
    triangle_area: float | None
    light: list[Image]
    has_color: bool


def from_description(frame: Frame, width: int, height: int) -> Scene:
    """The scene of a description, named after its file. ValueError where the picture is too small
    for all its parts.
    """
    content = _content(frame, (width, height))
    names = _parts(content)
    part_width = width // len(names)
    if part_width < MIN_SIZE or height < MIN_SIZE:
        parts = ", ".join(names)
        raise ValueError(
            f"{width}x{height} pixels are too few for {parts} side by side: each needs at least "
            f"{MIN_SIZE}x{MIN_SIZE}"
        )
    effects = _GlobalEffects({}, {})
    _add_light(content, effects)
    if "intersecting" in names:
        _add_depth_resolve(content, effects)
    _add_coverage(content, effects)
    display = light.display if "tone-mapping" in effects.why else None
    scene = side_by_side(
        [_part(name, content, part_width, height, display) for name in names], width, height
    )
    reasons = "; ".join(f"{name} ({reason})" for name, reason in names.items())
    return scene._replace(
        name=frame.document.source.name,
        description=f"what the description calls for: {reasons}",
        effects=tuple(dict.fromkeys((*scene.effects, *effects.why))),
        why={**scene.why, **effects.why},
        settings={**scene.settings, **effects.settings},
    )


def _content(frame: Frame, size: tuple[int, int]) -> _Content:
    plans = FramePlans(frame, "", size)
    passes = [plans.base.passes[number] for number in sorted(plans.passes)]
    names = {pipeline.name for each in passes for pipeline in each.pipelines}
    pipelines = [pipeline for pipeline, _ in frame.pipelines if not passes or pipeline.key in names]
    targets = [
        attached(each, framebuffer)
        for each in passes
        for framebuffer in range(len(each.framebuffers))
    ]
    images = [
        plans.base.images[number]
        for number in sorted({image for colors, _ in targets for image in colors})
    ]
    depth_alone = not images and any(depths for _, depths in targets)
    bright = [image for image in images if image.numeric in ("SFLOAT", "UFLOAT")]
    return _Content(frame, pipelines, plans.triangle_area, bright, not depth_alone)


def _parts(content: _Content) -> dict[str, str]:
    """The names of the scenes that get a part of the picture, each with the reason; edges alone
    where nothing is called for.
    """
    stated = content.frame.description.scene
    names = {}
    tested = next((pipeline for pipeline in content.pipelines if _depth_test(pipeline)), None)
    cut = [pipeline for pipeline in content.pipelines if _covers_by_alpha(pipeline)]
    blended = next((pipeline for pipeline in content.pipelines if _blends(pipeline)), None)
    stencil = next((pipeline for pipeline in content.pipelines if _stencil_test(pipeline)), None)
    if not content.has_color:
        names["intersecting"] = "the multisampled passes draw depth alone"
    elif stated is not None and stated.depth is not None:
        names["intersecting"] = f"scene.depth is {stated.depth}"
    elif tested is not None:
        names["intersecting"] = f"{tested.key} tests depth"
    if stated is not None and stated.alphaTest:
        names["foliage"] = "scene.alphaTest"
    elif cut:
        names["foliage"] = f"{cut[0].key} sets alphaToCoverageEnable"
    if stated is not None and stated.textureDetail:
        names["zone-plate"] = "scene.textureDetail"
    if blended is not None:
        names["glass"] = f"{blended.key} blends"
    if stencil is not None:
        names["portal"] = f"{stencil.key} tests stencil"
    only_cut = bool(cut) and len(cut) == len(content.pipelines)
    has_edges = (
        stated.edges
        if stated is not None and stated.edges is not None
        else content.has_color and not only_cut
    )
    return {**_edges(content), **names} if has_edges or not names else names


def _edges(content: _Content) -> dict[str, str]:
    """The scene of edges: those of many small triangles, or those of large ones."""
    area = content.triangle_area
    if area is not None and area <= SMALL:
        return {"mesh": f"triangles have {area:.3g} pixels on average"}
    stated = content.frame.description.scene
    return {
        "edge-fan": "scene.edges" if stated is not None and stated.edges else "triangles have edges"
    }


def _depth_test(pipeline: Pipeline) -> bool:
    return pipeline.depthStencilState is not None and bool(
        pipeline.depthStencilState.depthTestEnable
    )


def _stencil_test(pipeline: Pipeline) -> bool:
    return pipeline.depthStencilState is not None and bool(
        pipeline.depthStencilState.stencilTestEnable
    )


def _covers_by_alpha(pipeline: Pipeline) -> bool:
    return pipeline.multisampleState is not None and bool(
        pipeline.multisampleState.alphaToCoverageEnable
    )


def _blends(pipeline: Pipeline) -> bool:
    return pipeline.colorBlendState is not None and any(
        blend.blendEnable for blend in pipeline.colorBlendState.attachments
    )


def _add_light(content: _Content, effects: _GlobalEffects) -> None:
    """HDR, tone mapping and sRGB."""
    stated = content.frame.description.scene
    if _is_hdr(content):
        stated_hdr = stated is not None and stated.color == "HDR"
        why = f"scene.color is HDR, scene.peak {_peak(content):g} times display white"
        if not stated_hdr:
            image = content.light[0]
            format = format_name(image.format)
            why = (
                f"{image.name} is {format}, which holds light above display white: "
                f"{ASSUMED_PEAK:g} times is assumed without scene.peak"
            )
        effects.why["hdr"] = why
        mapping = stated.toneMapping if stated is not None else None
        setting = {"AFTER_RESOLVE": "after-resolve", "IN_PASS": "before-resolve"}.get(
            mapping or "AFTER_RESOLVE"
        )
        if setting is not None:
            effects.why["tone-mapping"] = (
                f"scene.toneMapping is {mapping or 'not stated: after the resolve'}"
            )
            effects.settings["tone-mapping"] = setting
        return
    for target in content.frame.all_targets:
        if "COLOR_ATTACHMENT" not in _usage(target.record):
            continue
        if target.format is not None and target.format.is_srgb:
            effects.why["srgb"] = (
                f"{target.title} is {target.format.name}: the resolve averages light"
            )
            effects.settings["srgb"] = "linear-light"
            return
        if target.image is not None and target.image.encoding == "GAMMA":
            effects.why["srgb"] = (
                f"{target.title} holds encoded values in a format without sRGB: the resolve "
                "averages codes"
            )
            effects.settings["srgb"] = "encoded"
            return


def _usage(record: object) -> tuple[str, ...]:
    """The usages of an image; an unstated usage, or an attachment without an image, may be a color
    attachment.
    """
    usage = getattr(record, "usage", None)
    return ("COLOR_ATTACHMENT",) if usage is None else tuple(usage)


def _is_hdr(content: _Content) -> bool:
    """Whether color is HDR: as stated, otherwise if it is drawn to floating-point images."""
    stated = content.frame.description.scene
    return (
        stated.color == "HDR"
        if stated is not None and stated.color is not None
        else bool(content.light)
    )


def _peak(content: _Content) -> float:
    stated = content.frame.description.scene
    if not _is_hdr(content):
        return 1.0
    if stated is not None and stated.peak is not None:
        return float(stated.peak)
    return light.EMITTER[0] if stated is not None and stated.color == "HDR" else ASSUMED_PEAK


def _is_reversed(content: _Content) -> bool:
    stated = content.frame.description.scene
    if stated is not None and stated.depth is not None:
        return stated.depth == "REVERSED"
    states = [
        pipeline.depthStencilState
        for pipeline in content.pipelines
        if pipeline.depthStencilState is not None
    ]
    return any((state.depthCompareOp or "").startswith("GREATER") for state in states)


def _add_depth_resolve(content: _Content, effects: _GlobalEffects) -> None:
    stated = content.frame.description.scene
    for subpass in (
        subpass for render_pass in content.frame.passes for subpass in render_pass.subpasses
    ):
        for resolve in subpass.resolves:
            if resolve.aspect == "depth" and resolve.mode in (
                "SAMPLE_ZERO",
                "AVERAGE",
                "MIN",
                "MAX",
            ):
                effects.why["depth-resolve"] = f"{resolve.path} resolves depth with {resolve.mode}"
                effects.settings["depth-resolve"] = resolve.mode
                return
    consumer = stated.depthResolveWants if stated is not None else None
    if consumer in ("NEAREST", "FARTHEST"):
        mode = "MAX" if (consumer == "NEAREST") == _is_reversed(content) else "MIN"
        effects.why["depth-resolve"] = f"scene.depthResolveWants is {consumer}: {mode}"
        effects.settings["depth-resolve"] = mode


def _add_coverage(content: _Content, effects: _GlobalEffects) -> None:
    """The sample mask, and alpha to coverage besides an alpha test."""
    for pipeline in content.pipelines:
        state = pipeline.multisampleState
        if state is None:
            continue
        every_sample = (1 << min(state.rasterizationSamples or 16, 16)) - 1
        if state.sampleMask and state.sampleMask[0] & every_sample != every_sample:
            effects.why["sample-mask"] = (
                f"{pipeline.path}.multisampleState.sampleMask is {state.sampleMask[0]:#x}"
            )
            effects.settings["sample-mask"] = state.sampleMask[0]
        if state.alphaToCoverageEnable:
            effects.why["alpha-to-coverage"] = "a pipeline sets alphaToCoverageEnable"
            effects.settings["alpha-to-coverage"] = "dithered"


def _part(
    name: str, content: _Content, width: int, height: int, display: light.Display | None
) -> Scene:
    stated = content.frame.description.scene
    if name == "edge-fan":
        return _with_peak(edges.edge_fan(width, height), _peak(content), display)
    if name == "mesh":
        side = max(math.sqrt(2 * (content.triangle_area or SMALL)), edges.MIN_SIDE)
        return _colored(edges.mesh(width, height, side), _peak(content), display)
    if name == "intersecting":
        return (depth.intersecting_reversed if _is_reversed(content) else depth.intersecting)(
            width, height, display
        )
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

    def exact(view: View) -> Truth:
        truth = scene.exact(view)
        return Truth(
            truth.image[..., 3:] * displayed,
            area.partly_covered(truth.image[..., 3] * displayed[3]),
        )

    return scene._replace(colors=scene.colors * color, exact=exact)


def _colored(scene: Scene, peak: float, display: light.Display | None) -> Scene:
    """A scene of disjoint triangles that fill the picture, with `peak` times the brightness."""
    colors = scene.colors * np.array([peak, peak, peak, 1.0])
    displayed = colors if display is None else display(colors)
    return scene._replace(colors=colors, exact=area.disjoint(displayed, covered=False))
