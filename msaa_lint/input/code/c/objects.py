"""What calls do: the file's own functions, constructors and setters, lists, and Vulkan's functions that make an object.

A call makes what its structure says, whatever the function is called: vkCreateImage, a dispatch table's, vmaCreateImage, vulkan.hpp's
`createImage` and vk::raii::Image all take a VkImageCreateInfo. The structure is copied as it is at that moment.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.enums import VALUES

from .conditions import worded
from .escapes import forget, forget_captures, mark_escaped, mark_used, settled_under
from .lists import Lists
from .names import first_version, structure
from .scope import Around
from .terms import ADDRESS, CALL, FIELD, INDEX, NAME, Function, Term
from .values import (
    ALWAYS,
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    Array,
    Cell,
    Closure,
    Flags,
    Ref,
    Struct,
    Symbol,
    Value,
    VulkanObject,
    copied,
    one,
    pointee,
)

MAKES = {
    "ImageCreateInfo": "image",
    "ImageViewCreateInfo": "view",
    "RenderPassCreateInfo": "renderPass",
    "FramebufferCreateInfo": "framebuffer",
    "GraphicsPipelineCreateInfo": "pipeline",
    "RenderingInfo": "rendering",
    "MemoryAllocateInfo": "memory",
    "DeviceCreateInfo": "device",
}
"""What is made with a structure, by its name."""

ALONE = ("PipelineMultisampleStateCreateInfo",)
"""Structures that say something even where no call is seen to take them."""

_LOOKS = re.compile(r"[gG]et|Requirement|[pP]ropert|[fF]ind|[lL]og|[pP]rint|assert|Supported|[hH]ash|validate|setDebug|Name$")

COUNTS = re.compile(
    r"max.*sample|sample.*max|usable.*sample|supported.*sample|best.*sample|sample.*support|choose.*sample|pick.*sample|select.*sample",
    re.IGNORECASE,
)

_HARMLESS = re.compile(
    r"[dD]estroy|[dD]elete|[fF]ree|[rR]elease|[nN]ame|[lL]og|[pP]rint|[aA]ssert|[cC]heck|CHECK|[mM]emory|[rR]equire|push_back|emplace"
)
"""What is done with an object there, and does not use it."""

_MEMORY = re.compile(r"mem.*(?:type|index)", re.IGNORECASE)

VIEW = re.compile(r"view", re.IGNORECASE)

_MOVES = frozenset({"swap", "exchange", "tie", "iter_swap", "forward"})

_IMAGE = re.compile(r"(?:Vk|vk::|vk::raii::)Image[&*]*$")

_TYPED = {
    "SampleCountFlagBits": "samples",
    "ImageUsageFlags": "usage",
    "Format": "format",
    "ImageTiling": "tiling",
    "MemoryPropertyFlags": "memory",
    "ImageUsageFlagBits": "usage",
    "SampleCountFlags": "samples",
}

_MEMORY_BITS = VALUES["VkMemoryPropertyFlagBits"]


class Objects(Lists):
    """Objects of one file."""

    def unknown(self, term: Term, name: str, owner: Term | None, values: Sequence[Value], around: Around) -> Value:
        """A function that is not the file's: what it makes, by the structures that it takes."""
        place = term[3]
        if name in ("vkCmdResolveImage", "resolveImage", "vkCmdResolveImage2", "vkCmdResolveImage2KHR", "resolveImage2"):
            self.resolving(name, values, place)
            return UNKNOWN_VALUE
        if name in ("vkBindImageMemory", "bindImageMemory", "bindMemory"):
            self.binding(values, owner, around)
            return UNKNOWN_VALUE
        if not _LOOKS.search(name):
            for n, value in enumerate(values):
                target = pointee(one(value))
                if isinstance(target, Array) and len(target.items) == 1:
                    target = pointee(one(target.items[0].writes))
                if isinstance(target, Struct) and first_version(target.kind) in MAKES:
                    return self.makes(target, n, term, name, values, around)
        if _MEMORY.search(name):
            for value in values:
                if value and all(_of_memory(a.value) for a in value):
                    return value
        if VIEW.search(name):
            viewed = self.viewed(values, term, around)
            if viewed is not None:
                return viewed
        for argument in term[2]:
            if argument[0] == ADDRESS:
                cell = self.run.place(argument[1], around)
                content = pointee(one(cell.read(around.guards))) if cell is not None else None
                if isinstance(content, Struct):
                    # What only asks Vulkan fills the structure in.
                    is_input = name.startswith(("vk", "vma")) and not name.startswith(("vkGet", "vkEnumerate"))
                    if not is_input and not self.keeps(name, argument, term):
                        content.zeroed = False
                        content.fields.clear()
                elif cell is not None and not isinstance(content, (Array, VulkanObject)):
                    # The function gives it a value that is not known here.
                    cell.write((Alternative(UNKNOWN, place),), place, around.guards)
            elif not name.startswith(("vk", "vma")):
                self.handed(name, argument, term, around)
        if name and not name.startswith(("vk", "vma")) and not name.isupper() and not _HARMLESS.search(name):
            for value in values:
                for alternative in value:
                    mark_escaped(alternative.value)
        if not name or (name[0].isupper() and owner is None and structure(name)):
            return UNKNOWN_VALUE
        helped = self.initialised(term, name, values, place)
        if helped is not None:
            return helped
        return (Alternative(Symbol(worded(term), name, bool(COUNTS.search(name))), place),)

    def keeps(self, name: str, argument: Term, term: Term) -> bool:
        """Whether a function is declared not to change what an argument points to."""
        parameters = self.run.unit.prototypes.get(name, ())
        position = term[2].index(argument)
        return bool(position < len(parameters) and parameters[position].fixed)

    def handed(self, name: str, argument: Term, term: Term, around: Around) -> None:
        """A list, or a structure, that is handed to somebody else's function, which may change it if it takes a reference."""
        for constant in [item.value for item in self.run.value(argument, around)]:
            if isinstance(constant, Closure):
                forget_captures(constant)
                continue
            value = pointee(constant)
            if not isinstance(value, (Array, Struct)) or self.keeps(name, argument, term):
                continue
            parameters = self.run.unit.prototypes.get(name, ())
            position = term[2].index(argument)
            if isinstance(constant, Struct) and name not in _MOVES:
                # C++ may take a reference where nothing looks like it, and a macro may do anything.
                by_reference = parameters[position].by_reference if position < len(parameters) else self.run.plus or name.isupper()
                if not by_reference:
                    continue
            forget(value)

    def initialised(self, term: Term, name: str, values: Sequence[Value], place: Span) -> Value | None:
        """The helpers of Sascha Willems's examples, which many samples use: a structure by its name, zeroed but for its arguments."""
        function = term[1]
        if function[0] != NAME or "initializers::" not in function[1]:
            return None
        kind = structure("Vk" + name[0].upper() + name[1:])
        if not kind:
            return None
        struct = Struct(kind, place, function[1].startswith("vks::") and not values)
        if kind == "PipelineMultisampleStateCreateInfo" and values:
            struct.cell("rasterizationSamples").writes = values[0]
        return (Alternative(struct, place),)

    def makes(self, info: Struct, n: int, term: Term, name: str, values: Sequence[Value], around: Around) -> Value:
        kind = MAKES[first_version(info.kind)]
        vulkan_object = self.make(kind, info, term, around)
        plain = (name.startswith(("vk", "vma")) and name[2:3].isupper()) or name.startswith("vma")
        result: Value = (Alternative(vulkan_object, term[3]),)
        for position, argument in enumerate(term[2]):
            if position <= n:
                continue
            target = argument[1] if argument[0] == ADDRESS else argument if plain and argument[0] in (NAME, FIELD, INDEX) else None
            if target is None:
                continue
            value = pointee(one(values[position]))
            if isinstance(value, Struct) and (value.kind or "requiredFlags" in value.fields or "usage" in value.fields):
                if kind == "image":
                    vulkan_object.memory = vulkan_object.memory or self.allocated(value)
                continue
            cell = self.run.place(target, around)
            pointed = one(cell.writes) if cell is not None else None
            if cell is not None and argument[0] != ADDRESS and isinstance(pointed, Ref):
                cell = pointed.cell
            if cell is not None:
                self.run.store(cell, result, term[3], around)
        # What the function itself gives is a VkResult.
        return (Alternative(0, term[3]),) if plain else result

    def make(self, kind: str, info: Struct, term: Term, around: Around) -> VulkanObject:
        """The object that a call makes."""
        key = (kind, term[3], around.calls, around.turns)
        vulkan_object = self.made.get(key)
        if vulkan_object is None:
            vulkan_object = self.made[key] = VulkanObject(kind, key, term[3])
        mark_used(info)
        vulkan_object.info = settled_under(copied(info, through=True), dict(around.guards))
        vulkan_object.guards = around.guards
        vulkan_object.memory = ()
        vulkan_object.deep = 99
        self.met[key] = vulkan_object
        return vulkan_object

    def allocated(self, info: Struct) -> Value:
        """The memory that VMA is asked for (VmaAllocationCreateInfo)."""
        usage = one(info.fields["usage"].writes) if "usage" in info.fields else None
        if isinstance(usage, Symbol) and usage.name == "VMA_MEMORY_USAGE_GPU_LAZILY_ALLOCATED":
            return (Alternative("LAZILY_ALLOCATED", info.fields["usage"].writes[-1].at),)
        for name in ("requiredFlags", "preferredFlags"):
            if name in info.fields and all(_of_memory(a.value) for a in info.fields[name].writes):
                return info.fields[name].writes
        return ()

    def binding(self, values: Sequence[Value], owner: Term | None, around: Around) -> None:
        every = [*values, self.run.value(owner, around)] if owner is not None else list(values)
        objects = [pointee(one(value)) for value in every]
        image = next((v for v in objects if isinstance(v, VulkanObject) and v.kind == "image"), None)
        memory = next((v for v in objects if isinstance(v, VulkanObject) and v.kind == "memory"), None)
        if image is not None and memory is not None and memory.info is not None and "memoryTypeIndex" in memory.info.fields:
            index = memory.info.fields["memoryTypeIndex"].writes
            image.memory = index if index and all(_of_memory(a.value) for a in index) else ()

    def viewed(self, values: Sequence[Value], term: Term, around: Around) -> Value | None:
        """A view of the one image among some arguments."""
        images = [v for v in values if any(isinstance(a.value, VulkanObject) and a.value.kind == "image" for a in v)]
        if len(images) != 1:
            return None
        info = Struct("ImageViewCreateInfo", term[3], False)
        info.cell("image").writes = images[0]
        return (Alternative(self.make("view", info, term, around), term[3]),)

    def resolving(self, name: str, values: Sequence[Value], place: Span) -> None:
        if name.endswith(("2", "2KHR")):
            info = next((v for v in (pointee(one(value)) for value in values) if isinstance(v, Struct)), None)
            if info is not None:
                self.resolves[place] = (info.cell("srcImage").writes, info.cell("dstImage").writes)
            return
        ends = values[1:] if name.startswith("vk") else values
        if len(ends) >= 3:
            self.resolves[place] = (ends[0], ends[2])

    @staticmethod
    def called_by(value: Value, name: str, around: Around) -> None:
        """Names what a call made after the variable that it goes to: the outermost function's."""
        for alternative in value:
            vulkan_object = alternative.value
            if isinstance(vulkan_object, VulkanObject) and name and len(around.calls) < vulkan_object.deep:
                vulkan_object.name, vulkan_object.deep = name, len(around.calls)

    def ended(self, around: Around) -> None:
        """At the end of a beginning: structures that no call was seen to take."""
        for info, guards in self.born:
            kind = first_version(info.kind)
            if info.used or not info.fields or not (kind in ALONE or (self.run.fragments and kind in MAKES)):
                continue
            term = (CALL, (NAME, "", info.at), (), info.at)
            around.guards = guards
            vulkan_object = self.make(MAKES.get(kind, "state"), info, term, around)
            vulkan_object.name = vulkan_object.name or info.name
        self.born.clear()

    def pieces(self, overlay: dict[str, Cell]) -> None:
        """Of a page's pieces: structures that none of them declares, told by a member that only they have."""
        keys = {key for key in (*self.run.summary, *overlay) if key.count(".") == 1}
        for key in sorted(keys):
            owner, _, name = key.partition(".")
            kind = {"rasterizationSamples": "PipelineMultisampleStateCreateInfo", "attachments": "FramebufferCreateInfo"}.get(name)
            cell = self.run.path(key)
            if kind is None or not cell.writes:
                continue
            at = cell.writes[0].at
            struct = self.run.gathered(owner, at)
            if struct and (kind in ALONE or self.of_views(cell)):
                info = struct[0].value
                info.kind = kind
                vulkan_object = self.make(MAKES.get(kind, "state"), info, (CALL, (NAME, "", at), (), at), Around("", ({},), ALWAYS, ()))
                vulkan_object.name = owner.rpartition("::")[2]

    def of_views(self, cell: Cell) -> bool:
        array = pointee(one(cell.writes))
        items = [one(item.writes) for item in array.items] if isinstance(array, Array) else []
        return any(isinstance(item, VulkanObject) and item.kind == "view" for item in items)

    def by_types(self, function: Function, term: Term, around: Around) -> Value | None:
        """An image that a function makes whose body a page leaves out: its parameters' types say what they are."""
        info, out = Struct("ImageCreateInfo", term[3], False), None
        memory: Value = ()
        for parameter, argument in zip(function.parameters, term[2], strict=False):
            kind = parameter.type.removeprefix("Vk").removeprefix("vk::")
            member = _TYPED.get(kind)
            if member == "memory":
                memory = self.run.value(argument, around)
            elif member is not None:
                info.cell(member).writes = self.run.value(argument, around)
            elif parameter.by_reference and _IMAGE.search(parameter.type):
                out = argument[1] if argument[0] == ADDRESS else argument
        if out is None or "usage" not in info.fields:
            return None
        vulkan_object = self.make("image", info, term, around)
        vulkan_object.memory = memory
        cell = self.run.place(out, around)
        if cell is not None:
            cell.write((Alternative(vulkan_object, term[3]),), term[3], around.guards)
            self.called_by((Alternative(vulkan_object, term[3]),), cell.name, around)
        return UNKNOWN_VALUE


def _of_memory(value: Any) -> bool:
    if isinstance(value, Flags):
        return bool(value.bits) and all(_of_memory(bit) for bit, _ in value.bits)
    return isinstance(value, str) and (value.startswith("VK_MEMORY_PROPERTY_") or value in _MEMORY_BITS)
