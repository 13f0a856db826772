"""Converts entries of a Fossilize database, JSON with Fossilize's own member names, to the calls
that create the objects.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.input.captures.call import Call, CaptureError, Place
from msaa_lint.input.captures.json_stream import MAX_DEPTH, is_too_deep
from msaa_lint.input.captures.values import items, record

from .fossilize_code import unpack_code

APPLICATION, SHADER_MODULE, RENDER_PASS, GRAPHICS_PIPELINE = 0, 4, 5, 6
"""Kinds of entries, as numbered in their names."""

FRAGMENT = 16
"""VkShaderStageFlagBits."""

MAX_JSON = 4 << 20
"""Maximum size of an entry's JSON in bytes; parsed small values take about 20 times as much
memory.
"""

MAX_CODE = 16 << 20
"""Maximum size of a shader module's code in bytes; larger code is left out."""

Json = Any

SUBPASS = {
    "inputAttachments": "pInputAttachments",
    "colorAttachments": "pColorAttachments",
    "resolveAttachments": "pResolveAttachments",
    "depthStencilAttachment": "pDepthStencilAttachment",
    "preserveAttachments": "pPreserveAttachments",
}
PASS = {
    "attachments": "pAttachments",
    "subpasses": "pSubpasses",
    "dependencies": "pDependencies",
    "correlatedViewMasks": "pCorrelatedViewMasks",
}
STATES: dict[str, dict[str, str]] = {
    "vertexInputState": {
        "attributes": "pVertexAttributeDescriptions",
        "bindings": "pVertexBindingDescriptions",
    },
    "inputAssemblyState": {},
    "tessellationState": {},
    "viewportState": {"viewports": "pViewports", "scissors": "pScissors"},
    "rasterizationState": {},
    "multisampleState": {"sampleMask": "pSampleMask"},
    "depthStencilState": {},
    "colorBlendState": {"attachments": "pAttachments"},
    "dynamicState": {"dynamicState": "pDynamicStates"},
}
"""The states of a pipeline, and the C names of members that Fossilize renames."""

CHAINED: dict[int, tuple[str, dict[str, str]]] = {
    1000044002: (
        "PIPELINE_RENDERING_CREATE_INFO",
        {"colorAttachmentFormats": "pColorAttachmentFormats"},
    ),
    1000199001: (
        "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE",
        {"depthStencilResolveAttachment": "pDepthStencilResolveAttachment"},
    ),
    1000241002: ("ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT", {}),
    1000218002: ("RENDER_PASS_FRAGMENT_DENSITY_MAP_CREATE_INFO_EXT", {}),
    1000226000: (
        "FRAGMENT_SHADING_RATE_ATTACHMENT_INFO_KHR",
        {"fragmentShadingRateAttachment": "pFragmentShadingRateAttachment"},
    ),
    1000314000: ("MEMORY_BARRIER_2", {}),
    1000376002: ("MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO_EXT", {}),
}
"""The chained structures that are kept, by VkStructureType: their names, and the C names of members
that Fossilize renames.
"""


def calls_of(tag: int, payload: bytes, at: Place, wanted: frozenset[str]) -> Iterator[Call]:
    """The wanted calls for an entry. Raises CaptureError if its JSON is invalid."""
    end = payload.find(b"\x00")
    length = len(payload) if end < 0 else end
    if length > MAX_JSON:
        raise CaptureError(f"its JSON exceeds {MAX_JSON >> 20} MiB", at)
    document = _document(payload[:length], at)
    if tag == APPLICATION:
        yield _instance(document, at)
    elif tag == SHADER_MODULE:
        for handle, module in _objects(document, "shaderModules"):
            yield _module(handle, module, payload, end + 1 if end >= 0 else len(payload), at)
    elif tag == RENDER_PASS:
        for key, name in (
            ("renderPasses", "vkCreateRenderPass"),
            ("renderPasses2", "vkCreateRenderPass2"),
        ):
            if name in wanted:
                for handle, create_info in _objects(document, key):
                    yield Call(
                        name, {"pCreateInfo": _render_pass(create_info), "pRenderPass": handle}, at
                    )
    elif tag == GRAPHICS_PIPELINE:
        for handle, create_info in _objects(document, "graphicsPipelines"):
            arguments = {
                "createInfoCount": 1,
                "pCreateInfos": [_pipeline(create_info)],
                "pPipelines": [handle],
            }
            yield Call("vkCreateGraphicsPipelines", arguments, at)


def fragment_modules(payload: bytes, at: Place) -> Iterator[int]:
    """The hashes of the pipelines' fragment shader modules. Raises CaptureError as `calls_of`
    does.
    """
    for call in calls_of(GRAPHICS_PIPELINE, payload, at, frozenset()):
        for stage in call.args["pCreateInfos"][0]["pStages"] or ():
            if isinstance(stage, dict) and stage.get("stage") == FRAGMENT:
                yield stage["module"]


def _document(text: bytes, at: Place) -> Json:
    from orjson import loads

    try:
        document = loads(text)
    except ValueError:
        document = _lenient(text, at)
    if not isinstance(document, dict):
        raise CaptureError("its JSON must be an object", at)
    if text.count(b"{") + text.count(b"[") > MAX_DEPTH and is_too_deep(document):
        raise CaptureError(f"its JSON is nested deeper than {MAX_DEPTH} levels", at)
    return document


def _lenient(text: bytes, at: Place) -> Json:
    """Parses JSON that contains NaN and Infinity, which Fossilize writes, or names that are not
    UTF-8.
    """
    from json import loads

    try:
        return loads(text.decode("utf-8", "replace"))
    except (ValueError, RecursionError):
        raise CaptureError("its JSON is invalid", at) from None


def _objects(document: Json, key: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """The objects of a kind with their hashes."""
    for name, created in record(document.get(key)).items():
        if isinstance(created, dict):
            yield _handle(name), created


def _handle(value: object) -> int:
    """A hash of up to 16 hexadecimal digits as a handle; 0 if there is none."""
    if isinstance(value, str) and len(value) <= 16:
        try:
            return int(value, 16)
        except ValueError:
            return 0
    return value if type(value) is int else 0


def _instance(document: Json, at: Place) -> Call:
    """The application. Fossilize records only the features that affect pipeline hashes; stating
    these would deny all others.
    """
    info = record(document.get("applicationInfo"))
    names = {"applicationName": "pApplicationName", "engineName": "pEngineName"}
    return Call(
        "vkCreateInstance",
        {"pCreateInfo": {"pNext": None, "pApplicationInfo": _renamed(info, names)}},
        at,
    )


def _module(handle: int, module: dict[str, Any], payload: bytes, start: int, at: Place) -> Call:
    info = {
        "sType": "VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO",
        "flags": module.get("flags", 0),
        "codeSize": module.get("codeSize"),
    }
    offset, length, size = (module.get(key) for key in ("varintOffset", "varintSize", "codeSize"))
    if type(offset) is int and type(length) is int and type(size) is int and 0 <= size <= MAX_CODE:
        first = start + offset
        if offset < 0 or length < 0 or first + length > len(payload):
            raise CaptureError("its shader code lies outside the entry", at)
        # A packed word has at most five bytes.
        code = (
            unpack_code(payload[first : first + length], size) if length <= size // 4 * 5 else None
        )
        if code is None:
            raise CaptureError("its shader code differs from its stated size", at)
        info["pCode"] = code
    return Call("vkCreateShaderModule", {"pCreateInfo": info, "pShaderModule": handle}, at)


def _render_pass(source: dict[str, Any]) -> Json:
    create_info = _renamed(source, PASS)
    for key in ("pAttachments", "pDependencies"):
        if isinstance(create_info.get(key), list):
            create_info[key] = [_renamed(item, {}) for item in create_info[key]]
    if isinstance(create_info.get("pSubpasses"), list):
        create_info["pSubpasses"] = [_renamed(item, SUBPASS) for item in create_info["pSubpasses"]]
    return create_info


def _pipeline(source: dict[str, Any]) -> Json:
    create_info = _renamed(source, {})
    for key, names in STATES.items():
        if key in create_info:
            create_info["p" + key[0].upper() + key[1:]] = _renamed(create_info.pop(key), names)
    for key in ("layout", "renderPass", "basePipelineHandle"):
        create_info[key] = _handle(create_info.get(key))
    stages = create_info.pop("stages", None)
    create_info["pStages"] = [_stage(item) for item in stages] if isinstance(stages, list) else None
    return create_info


def _stage(source: object) -> Json:
    stage = _renamed(source, {"name": "pName"})
    if not isinstance(stage, dict):
        return stage
    stage["module"] = _handle(stage.get("module"))
    constants = stage.pop("specializationInfo", None)
    if isinstance(constants, dict):
        stage["pSpecializationInfo"] = _renamed(
            constants, {"mapEntries": "pMapEntries", "data": "pData"}
        )
        stage["pSpecializationInfo"]["pData"] = _bytes(constants.get("data"))
    return stage


def _bytes(text: object) -> bytes | None:
    from binascii import Error, a2b_base64

    try:
        return a2b_base64(text) if isinstance(text, str) else None
    except (Error, ValueError):
        return None


def _renamed(source: object, names: dict[str, str]) -> Json:
    """A structure with C's member names and pNext chain; anything else unchanged."""
    if not isinstance(source, dict):
        return source
    structure = {names.get(key, key): value for key, value in source.items()}
    if "pNext" in structure:
        structure["pNext"] = _chain(structure["pNext"])
    return structure


def _chain(structures: object) -> dict[str, Any] | None:
    """Fossilize's list of chained structures as a pNext chain of the supported ones."""
    chain: dict[str, Any] | None = None
    for structure in reversed(items(structures)):
        kind = structure.get("sType") if isinstance(structure, dict) else None
        if type(kind) is int and kind in CHAINED:
            name, names = CHAINED[kind]
            chain = {
                **{names.get(key, key): value for key, value in structure.items()},
                "sType": "VK_STRUCTURE_TYPE_" + name,
                "pNext": chain,
            }
    return chain
