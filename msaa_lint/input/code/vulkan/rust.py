"""Vulkan's names in Rust: those of ash, vulkanalia, and vulkano."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.input.code.core.library import Construction
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.core.lists import Receiver
from msaa_lint.input.code.core.scope import Scope
from msaa_lint.input.code.core.terms import Term, Unit
from msaa_lint.input.code.core.values import Struct, Value, pointee, sole_value

from . import names
from .creation import VulkanInterpreter
from .library import VulkanLibrary

_CONSTANT = re.compile(r"(?:vk::)?([A-Z]\w*)::(_?\w+)$")
_SUFFIX = re.compile(r"(?:_(?:KHR|EXT|NV|AMD))+$")
_VENDOR = re.compile(r"(?:KHR|EXT|NV|AMD)$")
_CAPITAL = re.compile(r"(?<!^)[A-Z]")
_SETTER = re.compile(r"[a-z][a-z0-9_]*$")


@cache
def _members() -> dict[str, str]:
    """Returns the names of members in descriptions by their names in Rust."""
    every = {name for members in names.MEMBERS.values() for name in members} | {"pNext"}
    spellings = {
        spelling: names.member(name) for name in every for spelling in (name, names.member(name))
    }
    return {
        _CAPITAL.sub(r"_\g<0>", spelling).lower(): member for spelling, member in spellings.items()
    }


_RENAMED = {"color_resolve_attachments": "resolveAttachments"}
"""Members of vulkano that have other names."""


class RustLibrary(VulkanLibrary):
    """The names of Vulkan in Rust."""

    copies_on_set = True

    def constant(self, name: str) -> int | str | bool | None:
        match = _CONSTANT.match(name)
        if match is None:
            return {
                "vk::QUEUE_FAMILY_IGNORED": None,
                "vk::ATTACHMENT_UNUSED": 2**32 - 1,
                "vk::TRUE": True,
                "vk::FALSE": False,
            }.get(name, "VK_SUBPASS_EXTERNAL" if name.endswith("SUBPASS_EXTERNAL") else None)
        enum, value = match[1], match[2]
        if enum.startswith("SampleCount"):
            count = re.fullmatch(r"(?:TYPE_|_|Sample)(1|2|4|8|16|32|64)", value)
            return int(count[1]) if count is not None else None
        plain = _VENDOR.sub("", enum)
        kind = plain.rstrip("2")
        version = plain[len(kind) :]
        for table in (
            f"Vk{plain}",
            f"Vk{kind.removesuffix('s')}Bits{version}",
            f"Vk{kind.removesuffix('s')}FlagBits{version}",
            f"Vk{kind}FlagBits{version}",
        ):
            table = names.TABLES.get(table, table)
            if table in VALUES:
                values = names.squashed(table)
                short = value.removeprefix("TYPE_").removeprefix("Dim")
                return next(
                    (
                        values[key]
                        for key in map(_squeezed, (short, _SUFFIX.sub("", short)))
                        if key in values
                    ),
                    None,
                )
        return None

    def construction(self, type_text: str) -> Construction:
        return super().construction(type_text)._replace(takes_lists=False)

    def member(self, name: str) -> str:
        return _RENAMED.get(name) or _members().get(name, name)

    def setter(self, method: str) -> str | None:
        return self.member(method) if _SETTER.match(method) else None

    def is_success(self, name: str) -> bool:
        return name.endswith("Result::SUCCESS")

    def command(self, name: str) -> str:
        first, *words = name.split("_")
        return first + "".join(word.capitalize() for word in words)


def _squeezed(name: str) -> str:
    return name.replace("_", "").lower()


class RustInterpreter(VulkanInterpreter):
    """Executes a Rust program that calls Vulkan."""

    def __init__(self, unit: Unit, fragments: bool, is_cpp: bool, work: Work) -> None:
        super().__init__(unit, fragments, is_cpp, work, RustLibrary())

    def method(
        self, receiver: Receiver, name: str, arguments: Sequence[Term], place: Span, scope: Scope
    ) -> Value | None:
        if name == "push_next" and len(arguments) == 1:
            name = "next"
            extended = pointee(sole_value(receiver.content))
            first = pointee(sole_value(self.value(arguments[0], scope)))
            if (
                isinstance(extended, Struct)
                and "next" in extended.fields
                and isinstance(first, Struct)
            ):
                # The structures that are there follow the new one.
                first.cell("next").write(extended.fields["next"].writes, place, scope.guards)
        return super().method(receiver, name, arguments, place, scope)

    def braced_value(self, term: Term, scope: Scope, kind: str) -> Value:
        """Returns the value of a structure. One of a type that the program declares sets the
        members of the type, as constructors do.
        """
        value = super().braced_value(term, scope, kind)
        owner = self.class_of(term[1] or kind, scope.enclosing) if term[2] else None
        if owner is not None and len(value) == 1 and isinstance(value[0].value, Struct):
            for name, cell in value[0].value.fields.items():
                if sole_value(cell.writes) is None:
                    # What a constructor leaves null is set later.
                    continue
                self.store(
                    self.member_cell(f"{owner}::{name}"),
                    cell.writes,
                    cell.writes[-1].at if cell.writes else term[-1],
                    scope,
                )
        return value
