"""Calls in normal form as the tools that write JSON spell them, and back to one form that all of
them can be compared in.

The calls are pairs of name and arguments: structures as mappings with C's names, enumerants as full
names, flags as numbers, VkBool32 as booleans, handles as numbers. What a number is, a flag or a
handle, its member's name says.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any

from msaa_lint.frame.vulkan.enums import PREFIXES, VALUES
from msaa_lint.input.captures import values
from msaa_lint.input.captures.call import Call
from tests.input.readers.dialects_binary import number

Pairs = Sequence[tuple[str, dict[str, Any]]]

FLAGS = {
    "usage": "VkImageUsageFlagBits",
    "propertyFlags": "VkMemoryPropertyFlagBits",
    "framebufferColorSampleCounts": "VkSampleCountFlagBits",
}
"""Members that are masks, and their bits."""
PLAIN_FLAGS = frozenset({"flags"})
"""Members that are masks without a table of bits here."""
BITS = frozenset(
    {"samples", "rasterizationSamples", "resolveMode", "depthResolveMode", "stencilResolveMode"}
)
"""Members that are one bit of a mask."""
HANDLES = frozenset({
    "instance", "physicalDevice", "device", "commandBuffer", "queue", "image", "renderPass",
    "framebuffer", "pipelineCache", "layout_",
    "imageView", "resolveImageView", "pImage", "pRenderPass", "pFramebuffer", "pPipelines",
    "pDevice", "pInstance", "pPhysicalDevices",
    "fence", "pCommandBuffers", "pSwapchainImages", "swapchain", "pView", "srcImage", "dstImage",
    "objectHandle", "pFramebufferAttachments",
})  # fmt: skip


def bits(mask: int, enum: str) -> list[str]:
    """The full names of a mask's bits."""
    known = {
        value: name for name, value in VALUES[enum].items() if value and value & (value - 1) == 0
    }
    return [f"{PREFIXES[enum]}{known[1 << shift]}_BIT" for shift in range(32) if mask >> shift & 1]


# gfxreconstruct.


def spelt(value: Any, key: str, flags: Callable[[int, str], Any], boolean: type, null: Any) -> Any:
    """A value as gfxrecon-convert spells it."""
    if isinstance(value, dict):
        return {name: spelt(item, name, flags, boolean, null) for name, item in value.items()}
    if isinstance(value, list):
        return [spelt(item, key, flags, boolean, null) for item in value]
    if isinstance(value, bool):
        return boolean(value)
    if key in HANDLES and value == 0:
        return null
    if (key in FLAGS or key in PLAIN_FLAGS) and isinstance(value, int):
        return flags(value, key)
    return value


def _without_mask(value: Any) -> Any:
    """Version 0.9 writes null for every sample mask, and pointers for code."""
    if isinstance(value, dict):
        return {
            key: None
            if key == "pSampleMask"
            else "0x7f00aa00"
            if key == "pCode"
            else _without_mask(item)
            for key, item in value.items()
        }
    return [_without_mask(item) for item in value] if isinstance(value, list) else value


def _results(name: str) -> dict[str, str]:
    return {} if name.startswith(("vkCmd", "vkGetPhysicalDevice")) else {"return": "VK_SUCCESS"}


def old_lines(calls: Pairs, first: int = 2) -> list[str]:
    """What gfxrecon-convert 0.9.18 writes: a header, and a call a line."""
    lines = [
        json.dumps(
            {
                "header": {
                    "source-path": "p.gfxr",
                    "json-version": "0.8.0",
                    "gfxrecon-version": "0.9.18",
                }
            },
            separators=(",", ":"),
        )
    ]
    for index, (name, args) in enumerate(calls, first):
        body = spelt(_without_mask(args), "", lambda mask, _: mask, int, "VK_NULL_HANDLE")
        call = {"index": index, "vkFunc": {"name": name, **_results(name), "args": body}}
        lines.append(json.dumps(call, separators=(",", ":"), ensure_ascii=False))
    return lines


def new_objects(calls: Pairs, expand: bool = False, first: int = 2) -> list[dict[str, Any]]:
    """The objects that gfxrecon-convert 1.x writes, `expand` as by `--expand-flags`."""

    def flags(mask: int, key: str) -> str:
        return (
            "|".join(bits(mask, FLAGS[key]))
            if expand and mask and key in FLAGS
            else f"0x{mask:08x}"
        )

    objects: list[dict[str, Any]] = [
        {
            "header": {
                "source-path": "p.gfxr",
                "gfxrecon-version": "1.0.5",
                "vulkan-version": "1.4.357",
            }
        }
    ]
    for index, (name, args) in enumerate(calls, first):
        body = spelt(_last(args), "", flags, bool, 0)
        objects.append(
            {
                "index": index,
                "function": {"name": name, "thread": 1, **_results(name), "args": body},
            }
        )
    return objects


def _last(value: Any) -> Any:
    """Structures with their pNext as the last member, code as it is left out."""
    if isinstance(value, dict):
        made = {
            key: "[Binary data]" if key == "pCode" else _last(item)
            for key, item in value.items()
            if key != "pNext"
        }
        return {**made, "pNext": _last(value["pNext"])} if "pNext" in value else made
    return [_last(item) for item in value] if isinstance(value, list) else value


def new_lines(calls: Pairs, expand: bool = False) -> list[str]:
    """Those a line each."""
    return [
        json.dumps(each, separators=(",", ":"), ensure_ascii=False)
        for each in new_objects(calls, expand)
    ]


def new_array(calls: Pairs, expand: bool = False) -> bytes:
    """Those as one indented array."""
    return (
        "[\n"
        + ",\n".join(
            json.dumps(each, indent=2, ensure_ascii=False) for each in new_objects(calls, expand)
        )
        + "\n]\n"
    ).encode()


def lined(lines: Sequence[str]) -> bytes:
    """Lines as a file."""
    return "".join(f"{line}\n" for line in lines).encode()


# api_dump.


def node(name: str, value: Any, key: str = "", null: str = "address") -> dict[str, Any]:
    """An argument, member or element."""
    made: dict[str, Any] = {
        "type": "const char*" if key in ("pObjectName", "pName") else "VkThing",
        "name": name,
    }
    if value is None:
        return {**made, "address": null}
    if isinstance(value, dict):
        return {
            **made,
            "address": "0x7ffe0010",
            "members": [node(each, item, each, null) for each, item in value.items()],
        }
    if isinstance(value, list):
        return {
            **made,
            "address": "0x7ffe0010",
            "elements": [node(f"[{at}]", item, key, null) for at, item in enumerate(value)],
        }
    return {**made, "value": _dumped(value, key)}


def _dumped(value: Any, key: str) -> str:
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, bytes):
        return "SHADER DATA"
    if key in HANDLES:
        return f"0x{value:x}" if value else "0"
    if key in FLAGS:
        return f"{value} ({' | '.join(bits(value, FLAGS[key]))})" if value else "0"
    if key in BITS:
        return f"{number(value)} ({value})"
    return str(value)


def dumped(calls: Pairs, null: str = "address") -> list[dict[str, Any]]:
    """The calls as api_dump's objects."""
    objects = []
    for name, args in calls:
        result = (
            {"returnType": "VkResult", "returnValue": "VK_SUCCESS"}
            if _results(name)
            else {"returnType": "void"}
        )
        objects.append(
            {
                "name": name,
                "thread": "Thread 0",
                **result,
                "args": [node(key, item, key, null) for key, item in args.items()],
            }
        )
    return objects


def api_dump(calls: Pairs, frames: int = 1, first: int = 0, null: str = "address") -> bytes:
    """A dump, its calls dealt to some frames."""
    objects = dumped(calls, null)
    size = max(1, -(-len(objects) // frames))
    out = ["["]
    for frame in range(frames):
        inner = ",\n".join(_shifted(each, 8) for each in objects[frame * size : (frame + 1) * size])
        head = f'{{\n    "frameNumber" : "{first + frame}",\n    "apiCalls" :\n    [\n'
        out.append(head + inner + "\n    ]\n}" + ("," if frame + 1 < frames else ""))
    return ("\n".join(out) + "\n]\n").encode()


def _shifted(value: Any, indent: int) -> str:
    return "\n".join(
        " " * indent + line
        for line in json.dumps(value, indent=4, separators=(",", " : "), ensure_ascii=False).split(
            "\n"
        )
    )


# Back again.


def common(call: Call) -> tuple[str, Any, str | None]:
    """A call in the form that is the same for all dialects: its name, its arguments as they are
    decoded, its result.
    """
    return call.name, decoded(call.args, ""), call.result


def decoded(value: Any, key: str) -> Any:
    """A value as `captures.values` reads it."""
    if isinstance(value, dict):
        return {name: decoded(item, name) for name, item in value.items() if name != "pCode"}
    if isinstance(value, list):
        return [decoded(item, key) for item in value]
    if key in HANDLES:
        return values.handle(value)
    if value is None or key in ("sType", "pObjectName", "pName"):
        return value
    if key in FLAGS:
        return values.flags(FLAGS[key], value)
    if key in BITS:
        return (
            values.samples(value)
            if "amples" in key
            else values.enum("VkResolveModeFlagBits", value)
        )
    if key.endswith("Enable"):
        return values.boolean(value)
    if isinstance(value, str) and value.startswith("VK_"):
        return value
    return values.number(value) if values.integer(value) is None else values.integer(value)
