"""Vulkan objects that calls create.

A call creates what its structure describes, whatever the function is called: vkCreateImage, the
entry of a dispatch table, vmaCreateImage, vulkan.hpp's `createImage`, and vk::raii::Image all take
a VkImageCreateInfo. The structure is copied at the call.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.input.code.core.escapes import (
    forget,
    forget_captures,
    mark_escaped,
    mark_used,
    settle_under,
)
from msaa_lint.input.code.core.executions import Results
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.core.scope import Scope, name_objects
from msaa_lint.input.code.core.structures import Items
from msaa_lint.input.code.core.terms import (
    ADDRESS,
    CALL,
    FIELD,
    INDEX,
    NAME,
    Function,
    Parameter,
    Term,
    Unit,
)
from msaa_lint.input.code.core.values import (
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    ApiObject,
    Array,
    Cell,
    Closure,
    Flags,
    Ref,
    Struct,
    Symbol,
    Value,
    pointee,
    sole_value,
    structures_in,
)

from .foreign import ForeignCode
from .library import VulkanLibrary
from .names import MAX_NAMES, first_version, vulkan_struct

CREATE_INFOS = {
    "ImageCreateInfo": "image",
    "ImageViewCreateInfo": "view",
    "RenderPassCreateInfo": "renderPass",
    "FramebufferCreateInfo": "framebuffer",
    "GraphicsPipelineCreateInfo": "pipeline",
    "RenderingInfo": "rendering",
    "MemoryAllocateInfo": "memory",
    "DeviceCreateInfo": "device",
}
"""The kind of object that each structure creates."""

STANDALONE_INFOS = ("PipelineMultisampleStateCreateInfo",)
"""Structures that are described even if no call takes them."""

_RESOLVES = frozenset({
    "vkCmdResolveImage", "vkCmdResolveImage2", "vkCmdResolveImage2KHR", "resolveImage",
    "resolveImage2", "cmdResolveImage",
    "cmdResolveImage2",
})  # fmt: skip

_QUERIES = re.compile(
    r"[gG]et|Requirement|[pP]ropert|[fF]ind|[lL]og|[pP]rint|assert|Supported|[hH]ash|validate|setDebug|Name$"
)

_HARMLESS = re.compile(
    r"[dD]estroy|[dD]elete|[fF]ree|[rR]elease|[nN]ame|[lL]og|[pP]rint|[aA]ssert|[cC]heck|CHECK|[mM]emory|[rR]equire|push_back|emplace"
)
"""Functions that do not use the objects passed to them."""

_COPIES = re.compile(r"^(?:vkCmd(?:Copy|Blit)Image|(?:copy|blit)Image)")
"""Commands that read an image; resolves are recorded with their targets."""

_MEMORY = re.compile(r"mem.*(?:type|index)", re.IGNORECASE)
_VIEW = re.compile(r"view", re.IGNORECASE)

_MOVES = frozenset({"swap", "exchange", "tie", "iter_swap", "forward"})

_IMAGE = re.compile(r"(?:Vk|vk::|vk::raii::)Image[&*]*$")


class _Traits(NamedTuple):
    """What a function outside the program does, by its name."""

    copies: bool
    sets_samples: bool
    queries: bool
    finds_memory: bool
    makes_views: bool
    uses: bool
    """Whether it may use the objects passed to it."""


@lru_cache(MAX_NAMES)
def _traits(name: str) -> _Traits:
    return _Traits(
        _COPIES.search(name) is not None,
        "etRasterizationSamples" in name,
        _QUERIES.search(name) is not None,
        _MEMORY.search(name) is not None,
        _VIEW.search(name) is not None,
        name != ""
        and not name.startswith(("vk", "vma"))
        and not name.isupper()
        and _HARMLESS.search(name) is None,
    )


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


class VulkanInterpreter(ForeignCode):
    """Executes a program that calls Vulkan."""

    def __init__(
        self,
        unit: Unit,
        fragments: bool,
        is_cpp: bool,
        work: Work,
        names: VulkanLibrary | None = None,
    ) -> None:
        self.names = names or VulkanLibrary()
        super().__init__(unit, self.names, fragments, is_cpp, work)
        self.resolves: dict[Span, tuple[Value, Value, Value]] = {}
        """The source, the target, and the pNext chain of each resolve command."""
        self.copied: list[Value] = []
        """The sources of copies and blits."""
        self.descriptors: list[Struct] = []
        """The VkDescriptorImageInfo of the program."""

    def collected(self) -> Results:
        return [*super().collected(), self.resolves, self.copied, self.descriptors]

    def construct(self, kind: str, items: Items, place: Span, scope: Scope) -> Value:
        return self.noted(super().construct(kind, items, place, scope))

    def default_value(
        self, kind: str, name: str, place: Span, scope: Scope, zeroed: bool = False
    ) -> Value:
        return self.noted(super().default_value(kind, name, place, scope, zeroed))

    def unset_element(self, kind: str, place: Span, zeroed: bool) -> Cell:
        cell = super().unset_element(kind, place, zeroed)
        self.noted(cell.writes)
        return cell

    def stored_value(self, value: Any, kind: str, name: str) -> Any:
        stored = super().stored_value(value, kind, name)
        self.noted((Alternative(stored, Span(0, 0)),))
        return stored

    def noted(self, value: Value) -> Value:
        """Returns a value; notes descriptors of images in it."""
        self.descriptors += [
            struct
            for a in value
            for struct in structures_in(a.value)
            if struct.kind == "DescriptorImageInfo"
        ]
        return value

    def external_call(
        self, term: Term, name: str, owner: Term | None, values: Sequence[Value], scope: Scope
    ) -> Value:
        """Returns the result of a function outside the file: the object that the structures among
        its arguments create.
        """
        place, name = term[3], self.library.command(name)
        if name in _RESOLVES:
            self.record_resolve(name, values, place)
            return UNKNOWN_VALUE
        traits = _traits(name)
        if traits.copies:
            info = next(
                (
                    v
                    for v in (pointee(sole_value(value)) for value in values)
                    if isinstance(v, Struct)
                ),
                None,
            )
            ends = values[1:] if name.startswith("vk") else values
            self.copied.append(
                info.cell("srcImage").writes
                if info is not None
                else ends[0]
                if ends
                else UNKNOWN_VALUE
            )
        if traits.sets_samples:
            self.names.has_dynamic_samples = True
        if name in ("vkBindImageMemory2", "vkBindImageMemory2KHR", "bindImageMemory2"):
            infos = (
                struct for value in values for struct in structures_in(pointee(sole_value(value)))
            )
            for info in infos:
                self.bind_memory(
                    [info.cell("image").writes, info.cell("memory").writes], None, scope
                )
            return UNKNOWN_VALUE
        if name in ("vkBindImageMemory", "bindImageMemory", "bindMemory"):
            self.bind_memory(values, owner, scope)
            return UNKNOWN_VALUE
        if not traits.queries:
            for n, value in enumerate(values):
                target = self.creation_structure(value, values[n - 1] if n else (), scope)
                if isinstance(target, Struct) and first_version(target.kind) in CREATE_INFOS:
                    return self.create_from_call(target, n, term, name, values, scope)
        if traits.finds_memory:
            for value in values:
                if value and all(_of_memory(a.value) for a in value):
                    return value
        if traits.makes_views:
            view = self.view_of_argument(values, term, scope)
            if view is not None:
                return view
        for position, argument in enumerate(term[2]):
            if argument[0] == ADDRESS:
                cell = self.cell_of(argument[1], scope)
                content = pointee(sole_value(cell.read(scope.guards))) if cell is not None else None
                if isinstance(content, Struct):
                    # Functions that only query Vulkan fill the structure.
                    is_input = name.startswith(("vk", "vma")) and not name.startswith(
                        ("vkGet", "vkEnumerate")
                    )
                    parameter = self.declared_parameter(name, position)
                    if not is_input and (parameter is None or not parameter.fixed):
                        forget(content)
                elif cell is not None and not isinstance(content, (Array, ApiObject)):
                    # The function assigns an unknown value.
                    cell.write((Alternative(UNKNOWN, place),), place, scope.guards)
            elif not name.startswith(("vk", "vma")):
                self.escape_argument(name, values[position], position)
        if traits.uses:
            for value in values:
                mark_escaped(value, self.work)
        if not name or (name[0].isupper() and owner is None and vulkan_struct(name)):
            return UNKNOWN_VALUE
        helper_value = self.initializer(term, name, values, place)
        if helper_value is not None:
            return helper_value
        return (
            Alternative(
                Symbol(
                    self.key_of_call(term, scope), name, bool(self.library.is_count_choice(name))
                ),
                place,
            ),
        )

    def declared_parameter(self, name: str, position: int) -> Parameter | None:
        """Returns the parameter that an argument is passed to, if the file declares the
        function.
        """
        parameters = self.unit.prototypes.get(name, ())
        return parameters[position] if position < len(parameters) else None

    def escape_argument(self, name: str, argument: Value, position: int) -> None:
        """Handles a list or a structure that is passed to an external function, which may change it
        through a reference.
        """
        parameter = self.declared_parameter(name, position)
        # In C++, any argument may be passed by reference; a macro may do anything.
        by_reference = (
            parameter.by_reference if parameter is not None else self.is_cpp or name.isupper()
        )
        for value in [item.value for item in argument]:
            if isinstance(value, Closure):
                forget_captures(value)
            elif (parameter is None or not parameter.fixed) and (
                by_reference or name in _MOVES or not isinstance(value, Struct)
            ):
                forget(pointee(value))

    def initializer(
        self, term: Term, name: str, values: Sequence[Value], place: Span
    ) -> Value | None:
        """Returns the structure made by a helper of Sascha Willems's examples, which many samples
        use: named after it, zeroed except for its arguments.
        """
        function = term[1]
        if function[0] != NAME or "initializers::" not in function[1]:
            return None
        kind = vulkan_struct("Vk" + name[0].upper() + name[1:])
        if not kind:
            return None
        struct = Struct(kind, place, function[1].startswith("vks::") and not values)
        if kind == "PipelineMultisampleStateCreateInfo" and values:
            struct.cell("rasterizationSamples").writes = values[0]
        return (Alternative(struct, place),)

    def create_from_call(
        self, info: Struct, n: int, term: Term, name: str, values: Sequence[Value], scope: Scope
    ) -> Value:
        kind = CREATE_INFOS[first_version(info.kind)]
        obj = self.create(kind, info, term, scope)
        plain = (name.startswith(("vk", "vma")) and name[2:3].isupper()) or name.startswith("vma")
        result: Value = (Alternative(obj, term[3]),)
        stored = False
        for position, argument in enumerate(term[2]):
            if position <= n or (
                name.startswith("vk") and position < len(term[2]) - 1 and argument[0] != ADDRESS
            ):
                continue
            target = (
                argument[1]
                if argument[0] == ADDRESS
                else argument
                if plain and argument[0] in (NAME, FIELD, INDEX)
                else None
            )
            if target is None:
                continue
            value = pointee(sole_value(values[position]))
            if isinstance(value, Struct) and (
                value.kind or "requiredFlags" in value.fields or "usage" in value.fields
            ):
                if kind == "image":
                    obj.memory = obj.memory or self.vma_memory(value)
                continue
            cell = self.cell_of(target, scope)
            pointee_value = sole_value(cell.writes) if cell is not None else None
            if cell is not None and argument[0] != ADDRESS and isinstance(pointee_value, Ref):
                cell = pointee_value.cell
            if cell is not None:
                self.store(cell, result, term[3], scope)
                stored = True
        if (
            not plain
            and not stored
            and (output := self.output_argument(kind, term[2], values, scope)) is not None
        ):
            self.store(output, result, term[3], scope)
        # The function itself returns a VkResult.
        return (Alternative(0, term[3]),) if plain else result

    def create(self, kind: str, info: Struct, term: Term, scope: Scope) -> ApiObject:
        """Returns the object that a call creates."""
        key = (kind, term[3], scope.calls, scope.iterations)
        obj = self.objects.get(key)
        if obj is None:
            obj = self.objects[key] = ApiObject(kind, key, term[3], info)
        mark_used(info, self.work)
        obj.info = self.copies.with_targets(info)
        settle_under(obj.info, dict(scope.guards), self.work)
        obj.guards = scope.guards
        obj.repeated = scope.unknown_loops > 0
        obj.memory = ()
        obj.name_depth = 99
        self.current_objects[key] = obj
        return obj

    def vma_memory(self, info: Struct) -> Value:
        """Returns the memory properties that a VmaAllocationCreateInfo requests."""
        usage = sole_value(info.fields["usage"].writes) if "usage" in info.fields else None
        if usage == "VMA_MEMORY_USAGE_GPU_LAZILY_ALLOCATED":
            return (Alternative("LAZILY_ALLOCATED", info.fields["usage"].writes[-1].at),)
        for name in ("requiredFlags", "preferredFlags"):
            if name in info.fields and all(_of_memory(a.value) for a in info.fields[name].writes):
                return info.fields[name].writes
        return ()

    def bind_memory(self, values: Sequence[Value], owner: Term | None, scope: Scope) -> None:
        every = [*values, self.value(owner, scope)] if owner is not None else list(values)
        objects = [pointee(sole_value(value)) for value in every]
        image = next((v for v in objects if isinstance(v, ApiObject) and v.kind == "image"), None)
        memory = next((v for v in objects if isinstance(v, ApiObject) and v.kind == "memory"), None)
        if image is not None and memory is not None and "memoryTypeIndex" in memory.info.fields:
            index = memory.info.fields["memoryTypeIndex"].writes
            image.memory = index if index and all(_of_memory(a.value) for a in index) else ()

    def view_of_argument(self, values: Sequence[Value], term: Term, scope: Scope) -> Value | None:
        """Returns a view of the only image among the arguments, or None."""
        images = [
            v
            for v in values
            if any(isinstance(a.value, ApiObject) and a.value.kind == "image" for a in v)
        ]
        if len(images) != 1:
            return None
        info = Struct("ImageViewCreateInfo", term[3], False)
        info.cell("image").writes = images[0]
        return (Alternative(self.create("view", info, term, scope), term[3]),)

    def record_resolve(self, name: str, values: Sequence[Value], place: Span) -> None:
        if name.endswith(("2", "2KHR")):
            info = next(
                (
                    v
                    for v in (pointee(sole_value(value)) for value in values)
                    if isinstance(v, Struct)
                ),
                None,
            )
            if info is not None:
                chain = info.cell("next").writes if "next" in info.fields else ()
                self.resolves[place] = (
                    info.cell("srcImage").writes,
                    info.cell("dstImage").writes,
                    chain,
                )
        elif len(ends := values[1:] if name.startswith(("vk", "cmd")) else values) >= 3:
            self.resolves[place] = (ends[0], ends[2], ())

    def create_unused(self, scope: Scope) -> None:
        """Creates objects for the structures of an entry point that no call takes."""
        for info, guards in self.declared_structs:
            kind = first_version(info.kind)
            if (
                info.used
                or not info.fields
                or not (kind in STANDALONE_INFOS or (self.fragments and kind in CREATE_INFOS))
            ):
                continue
            term = (CALL, (NAME, "", info.at), (), info.at)
            scope.guards = guards
            obj = self.create(CREATE_INFOS.get(kind, "state"), info, term, scope)
            obj.name = obj.name or info.name
        self.declared_structs.clear()

    def create_from_fragments(self, overlay: dict[str, Cell]) -> None:
        """On a page of code fragments, creates objects for undeclared structures, identified by a
        member that only they have.
        """
        keys = {key for key in (*self.summary, *overlay) if key.count(".") == 1}
        for key in sorted(keys):
            owner, _, name = key.partition(".")
            kind = {
                "rasterizationSamples": "PipelineMultisampleStateCreateInfo",
                "attachments": "FramebufferCreateInfo",
            }.get(name)
            cell = self.member_cell(key)
            if kind is None or not cell.writes:
                continue
            at = cell.writes[0].at
            struct = self.gathered_struct(owner, at)
            if struct and (kind in STANDALONE_INFOS or self.lists_views(cell)):
                info = struct[0].value
                info.kind = kind
                obj = self.create(
                    CREATE_INFOS.get(kind, "state"), info, (CALL, (NAME, "", at), (), at), Scope()
                )
                obj.name = owner.rpartition("::")[2]

    def lists_views(self, cell: Cell) -> bool:
        array = pointee(sole_value(cell.writes))
        items = (
            [sole_value(item.writes) for item in array.items] if isinstance(array, Array) else []
        )
        return any(isinstance(item, ApiObject) and item.kind == "view" for item in items)

    def result_of(
        self, function: Function, term: Term, value: Value, creates: bool, scope: Scope
    ) -> Value:
        if self.fragments and not creates:
            image = self.image_by_types(function, term, scope)
            if image is not None:
                return image
        if not value and _VIEW.search(function.name):
            return (
                self.view_of_argument([self.value(a, scope) for a in term[2]], term, scope)
                or UNKNOWN_VALUE
            )
        return value

    def image_by_types(self, function: Function, term: Term, scope: Scope) -> Value | None:
        """Returns the image created by a function whose body a page leaves out, based on the types
        of its parameters.
        """
        info, out = Struct("ImageCreateInfo", term[3], False), None
        memory: Value = ()
        for parameter, argument in zip(function.parameters, term[2], strict=False):
            kind = parameter.type.removeprefix("Vk").removeprefix("vk::")
            member = _TYPED.get(kind)
            if member == "memory":
                memory = self.value(argument, scope)
            elif member is not None:
                info.cell(member).writes = self.value(argument, scope)
            elif parameter.by_reference and _IMAGE.search(parameter.type):
                out = argument[1] if argument[0] == ADDRESS else argument
        if out is None or "usage" not in info.fields:
            return None
        obj = self.create("image", info, term, scope)
        obj.memory = memory
        cell = self.cell_of(out, scope)
        if cell is not None:
            cell.write((Alternative(obj, term[3]),), term[3], scope.guards)
            name_objects((Alternative(obj, term[3]),), cell.name, scope)
        return UNKNOWN_VALUE


def _of_memory(value: Any) -> bool:
    if isinstance(value, Flags):
        return bool(value.bits) and all(_of_memory(bit) for bit, _ in value.bits)
    return isinstance(value, str) and (
        value.startswith("VK_MEMORY_PROPERTY_") or value in _MEMORY_BITS
    )
