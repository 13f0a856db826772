"""What entries of a Fossilize database hold, as calls that create it: JSON with names of its own, hashes, numbers for enumerants."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from msaa_lint.input.captures.call import Broken, Call, Place

from .fossilize_code import decoded

APPLICATION, SHADER_MODULE, RENDER_PASS, GRAPHICS_PIPELINE = 0, 4, 5, 6
"""Kinds of entries, by the number in their names."""

FRAGMENT = 16
"""VkShaderStageFlagBits."""

MAX_JSON = 4 << 20
"""Bytes of an entry's JSON: of small values, in memory they are some 20 times as many."""

MAX_DEPTH = 100

MAX_CODE = 16 << 20
"""Bytes of a shader module's code; it is not told of larger ones."""

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
    "vertexInputState": {"attributes": "pVertexAttributeDescriptions", "bindings": "pVertexBindingDescriptions"},
    "inputAssemblyState": {},
    "tessellationState": {},
    "viewportState": {"viewports": "pViewports", "scissors": "pScissors"},
    "rasterizationState": {},
    "multisampleState": {"sampleMask": "pSampleMask"},
    "depthStencilState": {},
    "colorBlendState": {"attachments": "pAttachments"},
    "dynamicState": {"dynamicState": "pDynamicStates"},
}
"""The states of a pipeline, and their members that C has by another name."""

CHAINED: dict[int, tuple[str, dict[str, str]]] = {
    1000044002: ("PIPELINE_RENDERING_CREATE_INFO", {"colorAttachmentFormats": "pColorAttachmentFormats"}),
    1000199001: (
        "SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE",
        {"depthStencilResolveAttachment": "pDepthStencilResolveAttachment"},
    ),
    1000241002: ("ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT", {}),
    1000314000: ("MEMORY_BARRIER_2", {}),
    1000376002: ("MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO_EXT", {}),
}
"""VkStructureType of the structures of a chain that are told, their names, and their members that C has by another name."""


def calls_of(tag: int, payload: bytes, at: Place, wanted: frozenset[str]) -> Iterator[Call]:
    """The wanted calls that an entry stands for. Broken where its JSON is none."""
    end = payload.find(b"\x00")
    length = len(payload) if end < 0 else end
    if length > MAX_JSON:
        raise Broken(f"its JSON has more than {MAX_JSON >> 20} MiB", at)
    document = _document(payload[:length], at)
    if tag == APPLICATION:
        yield _instance(document, at)
    elif tag == SHADER_MODULE:
        for handle, module in _objects(document, "shaderModules"):
            yield _module(handle, module, payload, end + 1 if end >= 0 else len(payload), at)
    elif tag == RENDER_PASS:
        for key, name in (("renderPasses", "vkCreateRenderPass"), ("renderPasses2", "vkCreateRenderPass2")):
            if name in wanted:
                for handle, made in _objects(document, key):
                    yield Call(name, {"pCreateInfo": _render_pass(made), "pRenderPass": handle}, at)
    elif tag == GRAPHICS_PIPELINE:
        for handle, made in _objects(document, "graphicsPipelines"):
            arguments = {"createInfoCount": 1, "pCreateInfos": [_pipeline(made)], "pPipelines": [handle]}
            yield Call("vkCreateGraphicsPipelines", arguments, at)


def fragment_modules(payload: bytes, at: Place) -> Iterator[int]:
    """The hashes of the modules that pipelines have as their fragment stages. Broken as `calls_of`."""
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
        raise Broken("its JSON is no object", at)
    if text.count(b"{") + text.count(b"[") > MAX_DEPTH and _deep(document):
        raise Broken(f"its JSON is nested more than {MAX_DEPTH} deep", at)
    return document


def _deep(document: Json) -> bool:
    level = [document]
    for _ in range(MAX_DEPTH):
        level = [item for each in level for item in (each.values() if isinstance(each, dict) else each) if isinstance(item, (dict, list))]
    return bool(level)


def _lenient(text: bytes, at: Place) -> Json:
    """JSON with the NaN and Infinity that Fossilize writes for such numbers, and names that are no UTF-8."""
    from json import loads

    try:
        return loads(text.decode("utf-8", "replace"))
    except (ValueError, RecursionError):
        raise Broken("it holds no JSON", at) from None


def _objects(document: Json, key: str) -> Iterator[tuple[int, dict[str, Any]]]:
    """The objects of a kind, by their hashes."""
    found = document.get(key)
    for name, made in found.items() if isinstance(found, dict) else ():
        if isinstance(made, dict):
            yield _handle(name), made


def _handle(value: object) -> int:
    """A hash: 16 hexadecimal digits; 0 where there is none."""
    if isinstance(value, str) and len(value) <= 16:
        try:
            return int(value, 16)
        except ValueError:
            return 0
    return value if type(value) is int else 0


def _instance(document: Json, at: Place) -> Call:
    """The application. Fossilize notes the few features that a pipeline's hash depends on: a call that tells them would deny the others."""
    stated = document.get("applicationInfo")
    stated = stated if isinstance(stated, dict) else {}
    names = {"applicationName": "pApplicationName", "engineName": "pEngineName"}
    return Call("vkCreateInstance", {"pCreateInfo": {"pNext": None, "pApplicationInfo": _renamed(stated, names)}}, at)


def _module(handle: int, module: dict[str, Any], payload: bytes, start: int, at: Place) -> Call:
    info = {"sType": "VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO", "flags": module.get("flags", 0), "codeSize": module.get("codeSize")}
    offset, length, size = (module.get(key) for key in ("varintOffset", "varintSize", "codeSize"))
    if type(offset) is int and type(length) is int and type(size) is int and 0 <= size <= MAX_CODE:
        first = start + offset
        if offset < 0 or length < 0 or first + length > len(payload):
            raise Broken("its shader's code is outside of it", at)
        # A word takes five bytes at most.
        code = decoded(payload[first : first + length], size) if length <= size // 4 * 5 else None
        if code is None:
            raise Broken("its shader's code has not the size that it says", at)
        info["pCode"] = code
    return Call("vkCreateShaderModule", {"pCreateInfo": info, "pShaderModule": handle}, at)


def _render_pass(given: dict[str, Any]) -> Json:
    made = _renamed(given, PASS)
    for key in ("pAttachments", "pDependencies"):
        if isinstance(made.get(key), list):
            made[key] = [_renamed(each, {}) for each in made[key]]
    if isinstance(made.get("pSubpasses"), list):
        made["pSubpasses"] = [_renamed(each, SUBPASS) for each in made["pSubpasses"]]
    return made


def _pipeline(given: dict[str, Any]) -> Json:
    made = _renamed(given, {})
    for key, names in STATES.items():
        if key in made:
            made["p" + key[0].upper() + key[1:]] = _renamed(made.pop(key), names)
    for key in ("layout", "renderPass", "basePipelineHandle"):
        made[key] = _handle(made.get(key))
    stages = made.pop("stages", None)
    made["pStages"] = [_stage(each) for each in stages] if isinstance(stages, list) else None
    return made


def _stage(given: object) -> Json:
    made = _renamed(given, {"name": "pName"})
    if not isinstance(made, dict):
        return made
    made["module"] = _handle(made.get("module"))
    constants = made.pop("specializationInfo", None)
    if isinstance(constants, dict):
        made["pSpecializationInfo"] = _renamed(constants, {"mapEntries": "pMapEntries", "data": "pData"})
        made["pSpecializationInfo"]["pData"] = _bytes(constants.get("data"))
    return made


def _bytes(text: object) -> bytes | None:
    from binascii import Error, a2b_base64

    try:
        return a2b_base64(text) if isinstance(text, str) else None
    except (Error, ValueError):
        return None


def _renamed(given: object, names: dict[str, str]) -> Json:
    """A structure with C's names, and C's chain of structures; what is no structure as it is."""
    if not isinstance(given, dict):
        return given
    made = {names.get(key, key): value for key, value in given.items()}
    if "pNext" in made:
        made["pNext"] = _chain(made["pNext"])
    return made


def _chain(listed: object) -> dict[str, Any] | None:
    """Fossilize's list of structures as a chain of those that are told."""
    chain: dict[str, Any] | None = None
    for each in reversed(listed if isinstance(listed, list) else []):
        kind = each.get("sType") if isinstance(each, dict) else None
        if type(kind) is int and kind in CHAINED:
            name, names = CHAINED[kind]
            chain = {**{names.get(key, key): value for key, value in each.items()}, "sType": "VK_STRUCTURE_TYPE_" + name, "pNext": chain}
    return chain
