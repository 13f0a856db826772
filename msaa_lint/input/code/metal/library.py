"""Metal's names in source code, as the interpreter asks for them."""

from __future__ import annotations

import re

from msaa_lint.frame.metal.names import ENUMS
from msaa_lint.input.code.core.library import Construction, Library

from . import names

_COUNTS = re.compile(
    r"max.*sample|sample.*max|supported.*sample|best.*sample|choose.*sample|pick.*sample|select.*sample",
    re.IGNORECASE,
)
_CAST = re.compile(r"(?:U?Int(?:8|16|32|64)?|NSU?Integer|NSInteger|MTL[A-Z]\w*)$")


class MetalLibrary(Library):
    """The names of Metal. Its descriptors are objects, so there are no structures."""

    def constant(self, name: str) -> int | str | bool | None:
        return names.constant(name)

    def structure(self, type_text: str) -> str:
        return ""

    def construction(self, type_text: str) -> Construction:
        return Construction("", (), {}, False)

    def is_alike(self, structure: str, other: str) -> bool:
        return structure == other

    def member(self, name: str) -> str:
        return names.member(name)

    def member_type(self, structure: str, member: str) -> str:
        return ""

    def setter(self, method: str) -> str | None:
        return None

    def has_member(self, structure: str, member: str) -> bool:
        return False

    def is_type(self, type_text: str) -> bool:
        return type_text.startswith(("MTL", "CA", "MTK", "NS"))

    def is_scalar(self, type_text: str) -> bool:
        return False

    def is_cast(self, type_text: str) -> bool:
        return _CAST.match(type_text) is not None and not names.kind_of(type_text)

    def is_format(self, value: str) -> bool:
        return value in ENUMS["MTLPixelFormat"]

    def is_success(self, name: str) -> bool:
        return False

    def is_count_choice(self, function: str) -> bool:
        return _COUNTS.search(function) is not None
