"""A render pass of a description, with one pipeline of it, alone; and the same as the tools of
Vulkan SC dump it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from msaa_lint.frame.description.scalars import sample_count
from msaa_lint.frame.vulkan.enums import BITLESS, PREFIXES
from msaa_lint.frame.vulkan.names import VENDORS, parse_enum, parse_flags
from tests.frame.description.shapes import RECORDS

Json = Any

UNUSED = 2**32 - 1

LISTS = ("inputAttachments", "colorAttachments", "resolveAttachments")
SEPARATE_LAYOUTS = ("stencilInitialLayout", "stencilFinalLayout")


def alone(description: Json, version: int) -> Iterator[Json]:
    """Each render pass of a description with each of its pipelines, or none: attachments by index,
    with what their images state.

    A pass is named as the dump of that version has it. Version 1 has none with what only version 2
    can say.
    """
    images = description.get("images", {})
    for name, render_pass in description.get("renderPasses", {}).items():
        bound = [
            each
            for each in description.get("framebuffers", {}).values()
            if each.get("renderPass") == name
        ]
        own = _pass(render_pass, images, bound[0].get("attachments", []) if len(bound) == 1 else [])
        if version == 1 and _needs_version_2(own):
            continue
        key = "Renderpass" if version == 1 else "Renderpass2"
        made: Json = {"renderPasses": {key: own}}
        enabled = {k: v for k, v in description.get("enabled", {}).items() if k != "apiVersion"}
        if enabled:
            made["enabled"] = enabled
        pipelines = [
            p for p in description.get("pipelines", {}).values() if p.get("renderPass") == name
        ]
        for pipeline in pipelines:
            yield {**made, "pipelines": {"GraphicsPipeline": {**pipeline, "renderPass": key}}}
        if not pipelines:
            yield made


def _pass(render_pass: Json, images: Json, bound: list[str | None]) -> Json:
    stated = render_pass.get("attachments", [])
    names = list(stated) if isinstance(stated, dict) else []
    attachments = []
    for index, attachment in enumerate(stated.values() if isinstance(stated, dict) else stated):
        image = images.get(
            (bound[index] if index < len(bound) else None) or attachment.get("image"), {}
        )
        of_image = {key: image[key] for key in ("format", "samples") if key in image}
        attachments.append({**of_image, **{k: v for k, v in attachment.items() if k != "image"}})
    subpasses = [_subpass(subpass, names) for subpass in render_pass.get("subpasses", [])]
    made = {**render_pass, "attachments": attachments, "subpasses": subpasses}
    if "fragmentDensityMapAttachment" in made:
        made["fragmentDensityMapAttachment"] = _reference(
            made["fragmentDensityMapAttachment"], names
        )
    return made


def _subpass(subpass: Json, names: list[str]) -> Json:
    out = dict(subpass)
    for member in (*LISTS, "preserveAttachments"):
        if member in out:
            out[member] = [_reference(each, names) for each in out[member]]
    for member in ("depthStencilAttachment", "fragmentShadingRateAttachment"):
        if member in out:
            out[member] = _reference(out[member], names)
    if "depthStencilResolve" in out and "attachment" in out["depthStencilResolve"]:
        chained = out["depthStencilResolve"]
        out["depthStencilResolve"] = {
            **chained,
            "attachment": _reference(chained["attachment"], names),
        }
    return out


def _reference(stated: Json, names: list[str]) -> Json:
    reference = dict(stated) if isinstance(stated, dict) else {"attachment": stated}
    attachment = reference.get("attachment")
    reference["attachment"] = names.index(attachment) if attachment in names else attachment
    return reference


def _needs_version_2(render_pass: Json) -> bool:
    subpasses, attachments = render_pass["subpasses"], render_pass["attachments"]
    chained = (
        "depthStencilResolve",
        "multisampledRenderToSingleSampled",
        "fragmentShadingRateAttachment",
        "pNext",
        "viewMask",
    )
    return any(k in s for s in subpasses for k in chained) or any(
        k in a for a in attachments for k in SEPARATE_LAYOUTS
    )


def dump(made: Json, version: int) -> Json:
    """What `alone` gives as the structures of a pipeline dump. A member that is not stated is left
    out, as it would be unknown.
    """
    ((key, render_pass),) = made["renderPasses"].items()
    state: Json = {key: _dumped_pass(render_pass, version)}
    for pipeline in made.get("pipelines", {}).values():
        state["GraphicsPipeline"] = _pipeline(pipeline)
    out: Json = {"GraphicsPipelineState": state}
    enabled = made.get("enabled", {})
    if "extensions" in enabled:
        out["EnabledExtensions"] = enabled["extensions"]
    if "features" in enabled:
        features = {
            "sType": "VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2",
            "features": dict.fromkeys(enabled["features"], "VK_TRUE"),
        }
        reserved = {
            "sType": "VK_STRUCTURE_TYPE_DEVICE_OBJECT_RESERVATION_CREATE_INFO",
            "pNext": features,
        }
        state["PhysicalDeviceFeatures"] = {
            **reserved,
            "features": {"sampleRateShading": "VK_FALSE"},
        }
    return out


def text(dumped: Json) -> str:
    """A dump as the tools write it: keys with blanks before the colon, commas after last items."""
    lines = json.dumps(dumped, indent=4, separators=(",", " : ")).splitlines()
    return "\n".join(
        f"{line}," if line.strip() in ("}", "]") and len(line) > 8 else line for line in lines
    )


def _dumped_pass(render_pass: Json, version: int) -> Json:
    suffix = "_2" if version == 2 else ""
    attachments = [_attachment(each, suffix) for each in render_pass["attachments"]]
    subpasses = [_dumped_subpass(each, suffix) for each in render_pass["subpasses"]]
    dependencies = [
        _structure("SubpassDependency", each, f"SUBPASS_DEPENDENCY{suffix}", suffix)
        for each in render_pass.get("dependencies", [])
    ]
    for each in dependencies:
        for member in ("srcSubpass", "dstSubpass"):
            if each.get(member) == "EXTERNAL":
                each[member] = UNUSED
    chain: Json = _unread(render_pass)
    if "fragmentDensityMapAttachment" in render_pass:
        density = _dumped_reference(render_pass["fragmentDensityMapAttachment"], "")
        stype = "VK_STRUCTURE_TYPE_RENDER_PASS_FRAGMENT_DENSITY_MAP_CREATE_INFO_EXT"
        chain = {"sType": stype, "pNext": chain, "fragmentDensityMapAttachment": density}
    return {
        "sType": f"VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO{suffix}",
        "pNext": chain,
        "flags": "0",
        "attachmentCount": len(attachments),
        "pAttachments": attachments or "NULL",
        "subpassCount": len(subpasses),
        "pSubpasses": subpasses or "NULL",
        "dependencyCount": len(dependencies),
        "pDependencies": dependencies or "NULL",
    }


def _unread(stated: Json) -> Json:
    """The chain of the structures that a description names by `pNext`."""
    chain: Json = "NULL"
    for stype in reversed(stated.get("pNext", [])):
        chain = {"sType": stype, "pNext": chain}
    return chain


def _structure(kind: str, stated: Json, stype: str, suffix: str = "2") -> Json:
    """A structure's members by the shapes of its record, under their names in C."""
    out: Json = {"sType": f"VK_STRUCTURE_TYPE_{stype}", "pNext": _unread(stated)} if suffix else {}
    for member, value in stated.items():
        shape = RECORDS[kind].SHAPE[member]
        if shape[0] in ("enum", "flags", "samples", "bool", "int", "number", "subpass"):
            out[member] = _scalar(shape, value)
    return out


def _scalar(shape: tuple[Any, ...], value: Json) -> Json:
    match shape[0]:
        case "enum":
            return full(shape[1], value)
        case "flags":
            bits = parse_flags(shape[1], value) if isinstance(value, str) else value or []
            return " | ".join(full(shape[1], bit) for bit in bits) or "0"
        case "samples":
            return f"VK_SAMPLE_COUNT_{sample_count(value)}_BIT"
        case "bool":
            return "VK_TRUE" if value else "VK_FALSE"
    return value


def full(enum: str, text: str) -> str:
    """An enumerant as C has it."""
    name = parse_enum(enum, text)
    assert name is not None, (enum, text)
    second = "2_" if enum.endswith("2") and name not in BITLESS.get(enum, ()) else ""
    if "FlagBits" in enum and name not in BITLESS.get(enum, ()):
        head, _, vendor = name.rpartition("_")
        name = f"{head}_BIT_{vendor}" if head and vendor in VENDORS else f"{name}_BIT"
    return f"{PREFIXES[enum]}{second}{name}"


def _attachment(stated: Json, suffix: str) -> Json:
    own = {key: value for key, value in stated.items() if key not in SEPARATE_LAYOUTS}
    out = _structure("AttachmentDescription", own, "ATTACHMENT_DESCRIPTION_2", suffix)
    separate = {key: value for key, value in stated.items() if key in SEPARATE_LAYOUTS}
    if separate:
        out["pNext"] = _structure(
            "AttachmentDescription", separate, "ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT"
        )
    return out


def _dumped_subpass(stated: Json, suffix: str) -> Json:
    out = _structure("Subpass", stated, "SUBPASS_DESCRIPTION_2", suffix)
    for member in LISTS:
        c_name = "p" + member[0].upper() + member[1:]
        out[f"{member[:-1]}Count"] = len(stated.get(member, []))
        out[c_name] = [_dumped_reference(each, suffix) for each in stated.get(member, [])] or "NULL"
    depth = stated.get("depthStencilAttachment")
    out["pDepthStencilAttachment"] = (
        _dumped_reference(depth, suffix) if depth is not None else "NULL"
    )
    out["pPreserveAttachments"] = [
        UNUSED if each["attachment"] is None else each["attachment"]
        for each in stated.get("preserveAttachments", [])
    ]
    if "depthStencilResolve" in stated:
        resolve = stated["depthStencilResolve"]
        chained = _structure(
            "DepthStencilResolve", resolve, "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE"
        )
        target = resolve.get("attachment")
        chained["pDepthStencilResolveAttachment"] = (
            _dumped_reference(target, suffix) if target is not None else "NULL"
        )
        chained["pNext"] = out["pNext"]
        out["pNext"] = chained
    if "fragmentShadingRateAttachment" in stated:
        rate = {
            "pFragmentShadingRateAttachment": _dumped_reference(
                stated["fragmentShadingRateAttachment"], suffix
            )
        }
        size = stated.get("shadingRateAttachmentTexelSize")
        rate |= {"shadingRateAttachmentTexelSize": size} if size is not None else {}
        out["pNext"] = {
            "sType": "VK_STRUCTURE_TYPE_FRAGMENT_SHADING_RATE_ATTACHMENT_INFO_KHR",
            "pNext": out["pNext"],
            **rate,
        }
    if "multisampledRenderToSingleSampled" in stated:
        single = stated["multisampledRenderToSingleSampled"]
        chained = _structure(
            "RenderToSingleSampled", single, "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO_EXT"
        )
        chained["pNext"] = out["pNext"]
        out["pNext"] = chained
    return out


def _dumped_reference(stated: Json, suffix: str) -> Json:
    out: Json = (
        {"sType": "VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2", "pNext": "NULL"} if suffix else {}
    )
    out["attachment"] = UNUSED if stated["attachment"] is None else stated["attachment"]
    out["layout"] = full("VkImageLayout", stated.get("layout", "GENERAL"))
    if suffix:
        out["aspectMask"] = "VK_IMAGE_ASPECT_COLOR_BIT"
    return out


STATES = {
    "multisampleState": ("MultisampleState", "PIPELINE_MULTISAMPLE_STATE_CREATE_INFO"),
    "depthStencilState": ("DepthStencilState", "PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO"),
    "rasterizationState": ("RasterizationState", "PIPELINE_RASTERIZATION_STATE_CREATE_INFO"),
    "colorBlendState": ("ColorBlendState", "PIPELINE_COLOR_BLEND_STATE_CREATE_INFO"),
}


def _pipeline(stated: Json) -> Json:
    out: Json = {
        "sType": "VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO",
        "pNext": "NULL",
        "flags": "0",
        "renderPass": 19,
    }
    for member, (kind, stype) in STATES.items():
        c_name = "p" + member[0].upper() + member[1:]
        out[c_name] = _structure(kind, stated[member], stype) if member in stated else "NULL"
    state = stated.get("multisampleState", {})
    if "multisampleState" in stated:
        out["pMultisampleState"]["pSampleMask"] = [
            f"0x{mask:x}" for mask in state.get("sampleMask", [])
        ] or "NULL"
    if "attachments" in stated.get("colorBlendState", {}):
        blended = stated["colorBlendState"]["attachments"]
        out["pColorBlendState"]["attachmentCount"] = len(blended)
        out["pColorBlendState"]["pAttachments"] = [
            _structure("ColorBlendAttachment", each, "", "") for each in blended
        ]
    states = [full("VkDynamicState", each) for each in stated.get("dynamicState", [])]
    if states:
        dynamic = {
            "sType": "VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO",
            "pNext": "NULL",
            "flags": 0,
        }
        out["pDynamicState"] = {
            **dynamic,
            "dynamicStateCount": len(states),
            "pDynamicStates": states,
        }
    else:
        out["pDynamicState"] = "NULL"
    if "subpass" in stated:
        out["subpass"] = stated["subpass"]
    return out
