"""Values of a description: scalars and flags, each by its shape, every mistake with its place and
the nearest right word.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from msaa_lint.core.quote import quoted
from msaa_lint.core.suggestions import did_you_mean
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.vulkan.names import from_value

from . import dumps
from .dumps import DECISIVE, is_number
from .hints import (
    boolean_hint,
    enumerant_hint,
    joined_flags,
    meant,
    null_hint,
    number_hint,
    question_or_names,
    samples_hint,
    shading_hint,
    single_hint,
)
from .members import MAX_UINT32
from .problems import MAX_PROBLEMS, Mention, Problem, found, head_of, member_of, one_of, quote_hint
from .scalars import (
    ATTACHMENT_UNUSED,
    EXTERNAL,
    SAMPLE_COUNTS,
    SHADING_LEVELS,
    enumerant,
    finite,
    flags,
    sample_count,
    shading_cost,
)

_SAMPLE_COUNTS = f"{', '.join(map(str, SAMPLE_COUNTS[:-1]))} or {SAMPLE_COUNTS[-1]}"


class ValueBinder:
    """Reads single values; `problems` and `mentions` fill as it goes. `dumped` says that the input
    is a tool's dump (`dumps`).

    A value that is wrong is reported and read as None, which is unknown.
    """

    def __init__(self, dumped: bool = False) -> None:
        self.dumped = dumped
        self.problems: list[Problem] = []
        self.mentions: list[Mention] = []

    def report(
        self, code: str, message: str, span: Span, path: str, help: str = "", foreign: bool = False
    ) -> None:
        """Adds a problem, up to MAX_PROBLEMS."""
        if not self.is_full:
            self.problems.append(Problem(code, message, span, path, (), help, foreign))

    @property
    def is_full(self) -> bool:
        """Whether further problems are not reported."""
        return len(self.problems) >= MAX_PROBLEMS

    def suggestion(self, name: str, candidates: Iterable[str], separator: str = "; ") -> str:
        """`did_you_mean`; nothing for a problem that is not reported, as the search takes time."""
        return "" if self.is_full else did_you_mean(name, candidates, separator)

    def mismatch(self, node: Node, path: str, expected: str, hint: str = "") -> None:
        """Reports a value of the wrong type or out of range."""
        if not self.is_full:
            hint = hint or null_hint(node) or single_hint(node)
            self.report(
                "MSAA903",
                f"{member_of(path)} must be {expected}, found {found(node)}{hint}",
                head_of(node),
                path,
            )

    def enumerant(self, enums: str, node: Node, path: str) -> str | None:
        text = node.text if node.kind == "scalar" else None
        name = enumerant(enums, text) if text else None
        if name is None and self.dumped and text is not None and is_number(text):
            name = from_value(enums.partition("|")[0], int(text))
        if name is None:
            if text is None or node.value is None:
                self.mismatch(node, path, _a(enums))
            elif not self.dumped:
                self.unknown_enumerant(enums, text, node, path)
        return name

    def unknown_enumerant(self, enums: str, text: str, node: Node, path: str) -> None:
        hint = "" if self.is_full else enumerant_hint(enums, text)
        self.report(
            "MSAA903",
            f"{member_of(path)} must be {_a(enums)}, found {quoted(text)}{hint}",
            node.span,
            path,
        )

    def flags(self, enum: str, node: Node, path: str) -> tuple[str, ...] | None:
        if node.kind == "sequence":
            bits = [self.enumerant(enum, item, f"{path}[{n}]") for n, item in enumerate(node.value)]
            is_known = None not in bits or (self.dumped and enum not in DECISIVE)
            return _distinct(bits) if is_known else None
        is_plain = isinstance(node.value, str) or (
            isinstance(node.value, int) and (self.dumped or node.text == "0")
        )
        if node.kind != "scalar" or not is_plain:
            self.mismatch(node, path, f"a list of {enum}")
            return None
        try:
            return tuple(flags(enum, node.text))
        except ValueError as error:
            if not self.dumped:
                joined = "" if self.is_full else joined_flags(enum, node.text)
                if joined:
                    self.mismatch(node, path, f"a list of {enum}", f"; write `[{joined}]`")
                else:
                    self.unknown_enumerant(enum, str(error), node, path)
                return None
        return (
            None
            if enum in DECISIVE
            else _distinct([enumerant(enum, part.strip()) for part in node.text.split("|")])
        )

    def boolean(self, node: Node, path: str) -> bool | None:
        value = (
            node.value
            if isinstance(node.value, bool)
            else dumps.boolean(node)
            if self.dumped
            else None
        )
        if value is None:
            self.mismatch(node, path, "true or false", boolean_hint(node))
        return value

    def integer(self, low: int, high: int, node: Node, path: str) -> int | None:
        value = node.value
        if self.dumped and isinstance(value, str):
            value = dumps.integer(value)
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            self.mismatch(
                node, path, f"an integer from {low} to {high}", number_hint(node, low, high)
            )
            return None
        return value

    def number(self, positive: bool, node: Node, path: str) -> float | None:
        value = dumps.number(node) if self.dumped else node.value
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not finite(value):
            self.mismatch(node, path, "a finite number", number_hint(node, -MAX_UINT32, MAX_UINT32))
            return None
        if positive and value <= 0:
            self.mismatch(node, path, "a number above 0")
            return None
        return value

    def share(self, node: Node, path: str) -> float | None:
        share = self.number(True, node, path)
        if share is not None and share > 1:
            self.mismatch(node, path, "a fraction above 0 and up to 1")
            return None
        return share

    def samples(self, node: Node, path: str) -> int | None:
        count = sample_count(node.text if self.dumped else node.value)
        if count is None:
            self.mismatch(node, path, _SAMPLE_COUNTS, samples_hint(node))
        return count

    def shading(self, node: Node, path: str) -> str | None:
        cost = shading_cost(node.value)
        if cost is None:
            expected = (
                f"{', '.join(SHADING_LEVELS)}, or a cost of at most 1000000ops, "
                "1000000000ns or 1000ms"
            )
            self.mismatch(
                node,
                path,
                expected,
                shading_hint(node) or self.suggestion(node.text, SHADING_LEVELS),
            )
        return cost

    def text(self, node: Node, path: str) -> str | None:
        if node.kind != "scalar" or not (isinstance(node.value, str) or self.dumped):
            self.mismatch(node, path, "a string", quote_hint(node))
            return None
        return node.text

    def name(self, section: str, node: Node, path: str) -> str | None:
        if node.kind != "scalar" or node.value is None or isinstance(node.value, (bool, float)):
            self.mismatch(node, path, f"the name of an entry of `{section}`", quote_hint(node))
            return None
        self.mentions.append(Mention(section, node.text, node, path))
        return node.text

    def word(self, words: tuple[Any, ...], node: Node, path: str) -> Any:
        if is_word(node, words):
            return node.value
        hint = ""
        if node.kind == "scalar" and node.value is not None and not self.is_full:
            hint = question_or_names(
                meant(node.text, [word for word in words if isinstance(word, str)]), (), "; "
            )
        self.mismatch(node, path, one_of(words), hint)
        return None

    def subpass(self, node: Node, path: str) -> int | str | None:
        """The index of a subpass, or EXTERNAL."""
        if isinstance(node.value, str) and node.text in EXTERNAL:
            return "EXTERNAL"
        if isinstance(node.value, str) and not (self.dumped and is_number(node.text)):
            self.mismatch(
                node,
                path,
                "EXTERNAL or the index of a subpass",
                self.suggestion(node.text, EXTERNAL),
            )
            return None
        if isinstance(node.value, int) and node.value < 0:
            self.mismatch(node, path, "EXTERNAL or the index of a subpass")
            return None
        index = self.integer(0, MAX_UINT32, node, path)
        return "EXTERNAL" if index == ATTACHMENT_UNUSED else index


def is_word(node: Node, words: tuple[Any, ...]) -> bool:
    """Whether a scalar is one of some words, some of which may be integers."""
    return node.kind == "scalar" and type(node.value) in (str, int) and node.value in words


def _a(enums: str) -> str:
    """The enums with the article: `a VkFormat`, `an MTLPixelFormat`."""
    return ("an " if enums.startswith("MTL") else "a ") + enums.replace("|", " or ")


def _distinct(bits: list[str | None]) -> tuple[str, ...]:
    """The bits that are known, each once; NONE is no bit."""
    return tuple(dict.fromkeys(bit for bit in bits if bit is not None and bit != "NONE"))
