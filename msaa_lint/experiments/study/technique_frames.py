"""A technique as a description of a frame, for the cost model and for devices."""

from __future__ import annotations

import json

from msaa_lint.frame.facts.frame import Frame

from .points import SAMPLE_SHADING, SSAA, Technique

COLOR, HDR_COLOR, DEPTH = "R8G8B8A8_UNORM", "R16G16B16A16_SFLOAT", "D32_SFLOAT"


def describe(
    technique: Technique,
    width: int,
    height: int,
    *,
    hdr: bool = False,
    depth: bool = False,
    fps: float = 60.0,
) -> str:
    """The description as JSON: the picture is rendered with the technique's samples and resolved in
    the pass or, for SSAA, rendered larger and downscaled by a blit. Samples stay on the tile
    wherever Vulkan allows it.
    """
    side = technique.grid if technique.kind == SSAA else 1
    samples = 1 if technique.kind == SSAA else technique.samples
    color_format = HDR_COLOR if hdr else COLOR
    size = {"width": width * side, "height": height * side}
    images: dict[str, object] = {
        "picture": {
            "format": color_format,
            "samples": 1,
            "extent": {"width": width, "height": height},
            "usage": _PICTURE,
        }
    }
    target: dict[str, object] = {"image": "picture", "loadOp": "CLEAR", "storeOp": "STORE"}
    commands: list[object] = []
    if samples > 1:
        images["color"] = {
            "format": color_format,
            "samples": samples,
            "extent": size,
            "usage": _SAMPLES,
            "memory": _LAZY,
        }
        target = {
            "image": "color",
            "loadOp": "CLEAR",
            "storeOp": "DONT_CARE",
            "resolveMode": "AVERAGE",
            "resolveImage": "picture",
        }
    elif side > 1:
        images["large"] = {
            "format": color_format,
            "samples": 1,
            "extent": size,
            "usage": ["COLOR_ATTACHMENT", "TRANSFER_SRC"],
        }
        target = {"image": "large", "loadOp": "CLEAR", "storeOp": "STORE"}
        commands.append({"blitImage": {"srcImage": "large", "dstImage": "picture"}})
    rendering: dict[str, object] = {"colorAttachments": [target]}
    if depth:
        usage = ["DEPTH_STENCIL_ATTACHMENT", "TRANSIENT_ATTACHMENT"]
        images["depth"] = {
            "format": DEPTH,
            "samples": samples,
            "extent": size,
            "usage": usage,
            "memory": _LAZY,
        }
        rendering["depthAttachment"] = {"image": "depth", "loadOp": "CLEAR", "storeOp": "DONT_CARE"}
    state: dict[str, object] = {"rasterizationSamples": samples}
    if technique.kind == SAMPLE_SHADING:
        state |= {"sampleShadingEnable": True, "minSampleShading": technique.fraction}
    commands = [
        {"beginRendering": rendering},
        {"draw": {"pipeline": "scene"}},
        "endRendering",
        *commands,
    ]
    frame = {
        "frame": {"width": width, "height": height, "fps": fps},
        "images": images,
        "pipelines": {
            "scene": {
                "rendering": {"colorAttachmentFormats": [color_format]},
                "multisampleState": state,
            }
        },
        "commands": commands,
    }
    return json.dumps(frame, indent=1)


_PICTURE = ["COLOR_ATTACHMENT", "TRANSFER_DST", "SAMPLED"]
_SAMPLES = ["COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT"]
_LAZY = ["DEVICE_LOCAL", "LAZILY_ALLOCATED"]


def frame_of(
    technique: Technique,
    width: int,
    height: int,
    *,
    hdr: bool = False,
    depth: bool = False,
    fps: float = 60.0,
) -> Frame:
    """The frame of a technique."""
    from msaa_lint.core.text.source import Source
    from msaa_lint.core.text.tree import Limits, parse
    from msaa_lint.input import readers

    source = Source(
        "study.msaa.json", describe(technique, width, height, hdr=hdr, depth=depth, fps=fps)
    )
    (root,) = parse(source, Limits()).documents
    return Frame(readers.read(source, root))
