"""Calls in normal form as RenderDoc and Fossilize write them: XML with the zip beside it, and a
pipeline database.

The calls are pairs of name and arguments, as `Program.calls` are, or `Call`s: structures as
mappings with C's names, enumerants and flags as names or numbers.
"""

from __future__ import annotations

import base64
import io
import json
import zipfile
import zlib
from collections.abc import Iterable, Iterator
from typing import Any
from xml.sax.saxutils import escape, quoteattr

from msaa_lint.frame.vulkan.enums import PREFIXES, VALUES
from msaa_lint.frame.vulkan.names import parse_enum
from msaa_lint.input.captures.call import Call, Place

OTHERS = {
    "VK_SUBPASS_CONTENTS_INLINE": 0,
    "VK_SUBPASS_CONTENTS_SECONDARY_COMMAND_BUFFERS": 1,
    "VK_COMMAND_BUFFER_LEVEL_PRIMARY": 0,
    "VK_COMMAND_BUFFER_LEVEL_SECONDARY": 1,
    "VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER": 1,
    "VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT": 10,
    "VK_IMAGE_VIEW_TYPE_2D": 1,
    "VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT": 1,
    "VK_PHYSICAL_DEVICE_TYPE_CPU": 4,
    "VK_OBJECT_TYPE_IMAGE": 10,
}
"""Enumerants that captures have and msaa-lint's tables have not."""

CHAINED = {
    "VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO": 1000044002,
    "VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE": 1000199001,
    "VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_STENCIL_LAYOUT": 1000241002,
    "VK_STRUCTURE_TYPE_MEMORY_BARRIER_2": 1000314000,
    "VK_STRUCTURE_TYPE_MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_INFO_EXT": 1000376002,
}
"""The structures that Fossilize keeps of a chain, as far as msaa-lint asks for them."""


def made(calls: Iterable[Call | tuple[str, dict[str, Any]]]) -> list[Call]:
    """Pairs of name and arguments as calls."""
    return [Call(each[0], each[1], Place()) for each in calls]


def number(text: str) -> int | None:
    """The value of an enumerant, or of flags joined by `|`, by full names; None of a text that is
    none.
    """
    total = 0
    for part in text.split("|"):
        name = part.strip()
        if not name.startswith("VK_"):
            return None
        if name in OTHERS:
            total |= OTHERS[name]
            continue
        enums = [
            enum
            for enum, prefix in PREFIXES.items()
            if name.startswith(prefix) and parse_enum(enum, name) is not None
        ]
        if not enums:
            return None
        total |= VALUES[enums[0]][parse_enum(enums[0], name) or ""]
    return total


def numbers(value: Any, key: str = "") -> Any:
    """Normal form as these dialects can tell it: enumerants but sType as numbers, booleans as 0 and
    1.
    """
    if isinstance(value, dict):
        return {each: numbers(item, each) for each, item in value.items()}
    if isinstance(value, list):
        return [numbers(item) for item in value]
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, str) and key != "sType":
        found = number(value)
        return value if found is None else found
    return value


# RenderDoc.

POINTERS = {
    **{
        f"p{name}": name
        for name in (
            "CreateInfo",
            "AllocateInfo",
            "BeginInfo",
            "RenderPassBegin",
            "PresentInfo",
            "DependencyInfo",
        )
    },
    **{
        f"p{name}": name
        for name in (
            "Image",
            "Memory",
            "View",
            "RenderPass",
            "Framebuffer",
            "ShaderModule",
            "Device",
            "Queue",
            "SetLayout",
        )
    },
    **{f"p{name}": name for name in ("Color", "DepthStencil")},
    "pSubpassBeginInfo": "SubpassBegin",
    "pSubpassEndInfo": "SubpassEnd",
    "pResolveImageInfo": "ResolveInfo",
    "pCommandPool": "CmdPool",
    "pSwapchain": "SwapChain",
    "pLabelInfo": "Label",
    "dstImage": "destImage",
    "dstImageLayout": "destImageLayout",
    "dstStageMask": "destStageMask",
    "descriptorWriteCount": "writeCount",
    "descriptorSetCount": "setCount",
}
"""C's names of parameters, and RenderDoc's."""

QUERIES = {
    "vkGetPhysicalDeviceProperties": ("pProperties", "physProps"),
    "vkGetPhysicalDeviceMemoryProperties": ("pMemoryProperties", "memProps"),
    "vkGetPhysicalDeviceFeatures": ("pFeatures", "physFeatures"),
}


def characters(text: str) -> str:
    """Text as RenderDoc escapes it: a reference for every control character, whether XML has one or
    not.
    """
    return "".join(f"&#{ord(each):02};" if ord(each) < 32 else each for each in escape(text))


class RenderDoc:
    """The XML of a capture. `blobs` are the buffers that the zip beside it holds."""

    def __init__(self) -> None:
        self.lines = [
            '<?xml version="1.0"?>',
            "<rdc>",
            "\t<header>",
            '\t\t<driver id="8">Vulkan</driver>',
            "\t</header>",
        ]
        self.lines.append('\t<chunks version="21">')
        self.blobs: list[bytes] = []
        self.number = 0

    def chunk(self, name: str, arguments: dict[str, Any]) -> None:
        """A call, or one of RenderDoc's own notes."""
        self.number += 1
        self.lines.append(
            f'\t\t<chunk id="{1000 + self.number}" name={quoteattr(name)} length="1" threadID="1" '
            'timestamp="1" duration="1">'
        )
        for key, value in arguments.items():
            self.value(key, value, 3)
        self.lines.append("\t\t</chunk>")

    def value(self, key: str, value: Any, depth: int) -> None:
        tabs, name = "\t" * depth, f" name={quoteattr(key)}" if key else ""
        if isinstance(value, (dict, list)):
            if key == "pNext":
                self.lines.append(
                    f'{tabs}<enum name="pNextType" string={quoteattr(value["sType"])}>1</enum>'
                )  # type: ignore[call-overload]
            if key == "pSampleMask" and isinstance(value, list):
                self.lines.append(f"{tabs}<uint{name}>{value[0]}</uint>")
                return
            tag = "struct" if isinstance(value, dict) else "array"
            self.lines.append(f"{tabs}<{tag}{name}>")
            for each, item in (
                value.items() if isinstance(value, dict) else (("", item) for item in value)
            ):
                self.value(each, item, depth + 1)
            self.lines.append(f"{tabs}</{tag}>")
        elif value is None:
            self.lines.append(f'{tabs}<null{name} typename="void *" />')
        elif isinstance(value, bytes):
            self.lines.append(
                f'{tabs}<buffer{name} byteLength="{len(value)}">{len(self.blobs)}</buffer>'
            )
            self.blobs.append(value)
        elif isinstance(value, (bool, int)):
            self.lines.append(
                f"{tabs}<{'int' if value < 0 else 'uint'}{name}>{int(value)}</{'int' if value < 0 else 'uint'}>"
            )
        elif isinstance(value, float):
            self.lines.append(f"{tabs}<float{name}>{value!r}</float>")
        elif key == "sType" or number(value) is not None:
            known = number(value)
            self.lines.append(
                f"{tabs}<enum{name} "
                f"string={quoteattr(value)}>{0 if known is None else known}</enum>"
            )
        else:
            self.lines.append(f"{tabs}<string{name}>{characters(value)}</string>")

    def text(self) -> bytes:
        """The XML."""
        return "\n".join([*self.lines, "\t</chunks>", "</rdc>", ""]).encode()

    def zip(self) -> bytes:
        """The zip beside it."""
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as file:
            for index, blob in enumerate(self.blobs):
                file.writestr(f"{index:06}", blob)
        return out.getvalue()


def renderdoc(calls: Iterable[Call | tuple[str, dict[str, Any]]]) -> RenderDoc:
    """A capture of the calls."""
    out = RenderDoc()
    device: dict[str, Any] = {}
    for call in made(calls):
        if call.name in QUERIES:
            parameter, own = QUERIES[call.name]
            device |= {
                "PhysicalDevice": call.args["physicalDevice"],
                own: _fixed(call.args[parameter]),
            }
            continue
        if call.name == "vkEnumeratePhysicalDevices":
            continue
        if call.name == "vkCreateDevice" and device:
            out.chunk(
                "vkEnumeratePhysicalDevices", {"instance": 1, "PhysicalDeviceIndex": 0, **device}
            )
        for name, arguments in _chunks(call):
            out.chunk(name, arguments)
    return out


def _fixed(structure: dict[str, Any]) -> dict[str, Any]:
    """Memory properties with C's arrays of fixed length."""
    out = dict(structure)
    for array, length, empty in (
        ("memoryTypes", 32, {"propertyFlags": 0, "heapIndex": 0}),
        ("memoryHeaps", 16, {"size": 0, "flags": 0}),
    ):
        if array in out:
            out[array] = out[array] + [empty] * (length - len(out[array]))
    return out


def _chunks(call: Call) -> Iterator[tuple[str, dict[str, Any]]]:
    """The chunks of a call: one for every object that it makes."""
    args = dict(call.args)
    if call.name == "vkCreateInstance":
        info = args["pCreateInfo"]
        application = info.get("pApplicationInfo") or {}
        stated = {
            "AppName": application.get("pApplicationName"),
            "APIVersion": application.get("apiVersion"),
        }
        yield (
            call.name,
            {
                "InitParams": {
                    **stated,
                    "Extensions": info.get("ppEnabledExtensionNames"),
                    "InstanceID": args.get("pInstance", 1),
                }
            },
        )
    elif call.name == "vkCreateGraphicsPipelines":
        for info, handle in zip(args.pop("pCreateInfos"), args.pop("pPipelines"), strict=False):
            yield call.name, {**args, "count": 1, "CreateInfo": info, "Pipeline": handle}
    elif call.name in ("vkAllocateCommandBuffers", "vkAllocateDescriptorSets"):
        many, one = (
            ("pCommandBuffers", "CommandBuffer")
            if "Command" in call.name
            else ("pDescriptorSets", "DescriptorSet")
        )
        info = dict(args["pAllocateInfo"])
        layouts = info.get("pSetLayouts")
        for index, handle in enumerate(args[many]):
            if layouts is not None:
                info = {**info, "descriptorSetCount": 1, "pSetLayouts": [layouts[index]]}
            yield call.name, {"device": args.get("device"), "AllocateInfo": info, one: handle}
    elif call.name == "vkGetSwapchainImagesKHR":
        for index, handle in enumerate(args["pSwapchainImages"] or []):
            yield (
                call.name,
                {
                    "device": 1,
                    "Swapchain": args["swapchain"],
                    "SwapchainImageIndex": index,
                    "SwapchainImage": handle,
                },
            )
    elif call.name in ("vkBeginCommandBuffer", "vkEndCommandBuffer"):
        own = {
            "CommandBuffer": args.pop("commandBuffer"),
            **{POINTERS.get(key, key): value for key, value in args.items()},
        }
        yield call.name, {**own, "BakedCommandBuffer": 999}
    elif call.name == "vkSetDebugUtilsObjectNameEXT":
        yield (
            call.name,
            {
                "Object": args["pNameInfo"]["objectHandle"],
                "ObjectName": args["pNameInfo"]["pObjectName"],
            },
        )
    else:
        yield call.name, {POINTERS.get(key, key): value for key, value in args.items()}


# Fossilize.

MAGIC = b"\x81FOSSILIZEDB\x00\x00\x00\x06"
KINDS = {
    "vkCreateInstance": 0,
    "vkCreateShaderModule": 4,
    "vkCreateRenderPass": 5,
    "vkCreateRenderPass2": 5,
    "vkCreateGraphicsPipelines": 6,
}
OWN_NAMES = {
    "pVertexAttributeDescriptions": "attributes",
    "pVertexBindingDescriptions": "bindings",
    "pDynamicStates": "dynamicState",
    "pName": "name",
    "pMapEntries": "mapEntries",
    "pData": "data",
}


def entry(
    kind: int, hash: int, payload: bytes, deflated: bool = True, checked: bool = True
) -> bytes:
    """An entry of a database."""
    stored = zlib.compress(payload) if deflated else payload
    numbers_of = (
        len(stored),
        2 if deflated else 1,
        zlib.crc32(stored) if checked else 0,
        len(payload),
    )
    return (
        f"{kind:024x}{hash:016x}".encode()
        + b"".join(each.to_bytes(4, "little") for each in numbers_of)
        + stored
    )


def packed(code: bytes) -> bytes:
    """SPIR-V, seven bits of a word to a byte."""
    out = bytearray()
    for at in range(0, len(code), 4):
        word = int.from_bytes(code[at : at + 4], "little")
        while word > 0x7F:
            out.append(word & 0x7F | 0x80)
            word >>= 7
        out.append(word)
    return bytes(out)


def fossilize(calls: Iterable[Call | tuple[str, dict[str, Any]]], deflated: bool = True) -> bytes:
    """A database of what the calls create, in their order; of other calls it has nothing."""
    return MAGIC + b"".join(
        entry(*each, deflated) for call in made(calls) for each in entries(call)
    )


def entries(call: Call) -> Iterator[tuple[int, int, bytes]]:
    """Kind, hash and contents of the entries of a call."""
    name = call.name.removesuffix("KHR")
    if name not in KINDS:
        return
    kind = KINDS[name]
    info = call.args.get("pCreateInfo")
    if name == "vkCreateInstance":
        application = _own(info.get("pApplicationInfo") or {}) if info else {}
        application = {
            key.replace("pApplicationName", "applicationName"): value
            for key, value in application.items()
        }
        yield (
            kind,
            1,
            _json(
                {
                    "applicationInfo": application,
                    "physicalDeviceFeatures": {"robustBufferAccess": 0},
                }
            ),
        )
    elif name == "vkCreateShaderModule":
        assert info is not None
        code = info["pCode"]
        module = {
            "varintOffset": 0,
            "varintSize": len(packed(code)),
            "codeSize": len(code),
            "flags": 0,
        }
        handle = call.args["pShaderModule"]
        yield (
            kind,
            handle,
            _json({"shaderModules": {f"{handle:016x}": module}}) + b"\x00" + packed(code),
        )
    elif name == "vkCreateGraphicsPipelines":
        for each, handle in zip(call.args["pCreateInfos"], call.args["pPipelines"], strict=False):
            yield kind, handle, _json({"graphicsPipelines": {f"{handle:016x}": _own(each)}})
    else:
        handle = call.args["pRenderPass"]
        key = "renderPasses2" if name.endswith("2") else "renderPasses"
        yield kind, handle, _json({key: {f"{handle:016x}": _own(info)}})


def _json(document: dict[str, Any]) -> bytes:
    return json.dumps({"version": 6, **document}, separators=(",", ":")).encode()


def _own(value: Any, key: str = "") -> Any:
    """A structure with Fossilize's names: no pointers, no sType but in a list of chained
    structures, hashes as digits.
    """
    if isinstance(value, dict):
        out: dict[str, Any] = {}
        for each, item in value.items():
            if each == "pNext":
                chain = list(_chain(item))
                if chain:
                    out["pNext"] = chain
            elif each != "sType" and item is not None:
                name = OWN_NAMES.get(each) or (
                    each[1].lower() + each[2:] if each[0] == "p" and each[1].isupper() else each
                )
                out[name] = _own(item, each)
        return out
    if isinstance(value, list):
        return [_own(item) for item in value]
    if isinstance(value, bytes):
        return base64.b64encode(value).decode()
    if key in ("renderPass", "module", "layout", "basePipelineHandle") and type(value) is int:
        # An attachment's layout is an enumerant, a pipeline's a handle.
        return f"{value:016x}" if key != "layout" or value > 1 << 20 else value
    return numbers(value)


def _chain(structure: Any) -> Iterator[dict[str, Any]]:
    while structure is not None:
        if structure["sType"] in CHAINED:
            yield {
                "sType": CHAINED[structure["sType"]],
                **_own(
                    {key: item for key, item in structure.items() if key not in ("sType", "pNext")}
                ),
            }
        structure = structure.get("pNext")
