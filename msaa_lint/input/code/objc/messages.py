"""Rewrites Objective-C as C++ of the same length, so that the grammar of C++, which Objective-C++
needs anyway, parses it.

    [device newTextureWithDescriptor:d]         device.newTextureWithDescriptor(d)
    [pass setTexture:t atIndex:0]               pass.setTexture(t ,        0)
    - (void)draw:(CGSize)size on:(id)target {   void draw(CGSize size, id target) {
    @property (strong) id<MTLTexture> color;    id<MTLTexture> color;

Tables say which members of the text are messages, which functions are methods, and the labels of
their arguments.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from typing import NamedTuple

_TOKEN = re.compile(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|^[ "
    r"\t]*\#(?:\\\n|[^\n])*|@?\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|@?[A-Za-z_]\w*|\d[\w.]*"
    r"|::|->|&&|\|\||[^\s\w]",
    re.DOTALL | re.MULTILINE,
)
_WORD = re.compile(r"[A-Za-z_]\w*$")
_BLANK = frozenset({
    "__weak", "__strong", "__unsafe_unretained", "__block", "__autoreleasing", "__bridge",
    "__bridge_retained", "__bridge_transfer",
    "nonnull", "nullable", "null_unspecified", "_Nonnull", "_Nullable", "_Null_unspecified",
    "__nonnull", "__nullable", "__kindof",
    "IBOutlet", "IBAction", "NS_DESIGNATED_INITIALIZER", "NS_ASSUME_NONNULL_BEGIN",
    "NS_ASSUME_NONNULL_END", "NS_REQUIRES_SUPER",
    "@autoreleasepool", "@try", "@finally", "@public", "@private", "@protected", "@package",
    "@optional", "@required",
})  # fmt: skip
"""Words that say nothing about values."""

_BLANK_CALLS = frozenset({
    "__attribute__", "API_AVAILABLE", "API_UNAVAILABLE", "API_DEPRECATED", "NS_AVAILABLE",
    "NS_AVAILABLE_MAC", "NS_AVAILABLE_IOS",
    "NS_SWIFT_NAME", "NS_CLASS_AVAILABLE", "NS_DEPRECATED", "@synchronized", "@catch",
})  # fmt: skip
"""Words that say nothing, and their arguments."""

_BLANK_LINES = frozenset({"@class", "@import", "@synthesize", "@dynamic", "@compatibility_alias"})
_VALUES = frozenset({"@selector", "@protocol", "@encode"})
_KEYWORDS = frozenset({
    "new", "class", "default", "delete", "private", "protected", "public", "register", "this",
    "namespace", "template", "typename",
    "operator",
    "union", "struct", "signed", "switch", "case", "return", "continue", "break", "for", "if",
    "else", "goto", "do", "while",
    "auto",
})  # fmt: skip
"""Selectors that are keywords of C++."""

_BEFORE_VALUE = frozenset(
    {
        "return",
        "case",
        "else",
        "do",
        "in",
        "throw",
        "goto",
        "co_return",
        "sizeof",
        "@throw",
        "__bridge",
    }
)
_ENUMS = frozenset({"NS_ENUM", "NS_OPTIONS", "NS_CLOSED_ENUM", "CF_ENUM", "CF_OPTIONS"})
_PAIRS = {")": "(", "]": "[", "}": "{"}
_BLOCK_TYPE = re.compile(r"\(\s*\^")
_QUALIFIERS = re.compile(
    r"\b(?:nonnull|nullable|null_unspecified|_Nonnull|_Nullable|__kindof|__autoreleasing|__strong|__weak|__unsafe_unretained|oneway|inout|out|bycopy|byref|in|const)\b"
)
_INTERFACE = re.compile(
    r"\s+([A-Za-z_]\w*)(?:\s*<[^>{}@;]*>)?(?:\s*\([^(){}]*\))?(?:\s*:\s*([A-Za-z_][\w.]*))?(?:\s*<[^{};@]*?>)?"
)
_METHOD = re.compile(r"([-+])\s*(\((?:[^()]|\([^()]*(?:\([^()]*\)[^()]*)*\))*\))?\s*")
_PART = re.compile(
    r"([A-Za-z_]\w*)?\s*:\s*(\((?:[^()]|\([^()]*(?:\([^()]*\)[^()]*)*\))*\))?\s*([A-Za-z_]\w*)\s*"
)


class Message(NamedTuple):
    """A message or the name of a method: its first part, and the labels of the further arguments;
    None for one without arguments.
    """

    name: str
    labels: tuple[str, ...] | None


class Rewritten(NamedTuple):
    """C++ of the same length. Messages and methods are by the offset of their name; `classes` are
    those that the text declares or implements, `bases` what they derive from.
    """

    text: str
    messages: dict[int, Message]
    methods: dict[int, tuple[str, Message]]
    bases: dict[str, tuple[str, ...]]
    classes: set[str]


def rewrite(text: str) -> Rewritten:
    """Returns Objective-C as C++ of the same length."""
    return _Rewriter(text).rewrite()


class _Rewriter:
    """Rewrites one text."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.out = list(text)
        found = [
            m for m in _TOKEN.finditer(text) if not m[0].lstrip().startswith(("//", "/*", "#"))
        ]
        self.tokens = [m[0] for m in found]
        self.starts = [m.start() for m in found]
        self.ends = [m.end() for m in found]
        self.match = self.matches()
        self.messages: dict[int, Message] = {}
        self.methods: dict[int, tuple[str, Message]] = {}
        self.bases: dict[str, tuple[str, ...]] = {}
        self.classes: set[str] = set()

    def matches(self) -> list[int]:
        """Returns the closing bracket of each opening one, as indices of tokens; -1 for others."""
        match = [-1] * len(self.tokens)
        open_: list[int] = []
        for n, token in enumerate(self.tokens):
            if token in ("(", "[", "{"):
                open_.append(n)
            elif token in _PAIRS:
                while open_ and self.tokens[open_[-1]] != _PAIRS[token] and token == "}":
                    open_.pop()
                if open_ and self.tokens[open_[-1]] == _PAIRS[token]:
                    match[open_.pop()] = n
        return match

    def rewrite(self) -> Rewritten:
        n = 0
        class_name = ""
        while n < len(self.tokens):
            token = self.tokens[n]
            if token == "@interface" or (token == "@protocol" and not self.is_token(n + 1, "(")):
                n = self.interface(n)
                continue
            if token == "@implementation":
                n, class_name = self.implementation(n)
                continue
            if token == "@end":
                self.blank(self.starts[n], self.ends[n])
                class_name = ""
            elif class_name and token in "-+" and self.is_method(n):
                n = self.method(n, class_name)
                continue
            elif token == "[":
                self.message(n)
            else:
                n = self.word(n)
            n += 1
        return Rewritten("".join(self.out), self.messages, self.methods, self.bases, self.classes)

    def is_token(self, n: int, token: str) -> bool:
        return n < len(self.tokens) and self.tokens[n] == token

    def blank(self, start: int, end: int) -> None:
        for n in range(start, end):
            if self.out[n] != "\n":
                self.out[n] = " "

    def put(self, start: int, end: int, text: str) -> None:
        """Replaces a range by a text that is not longer, followed by blanks."""
        self.blank(start, end)
        self.out[start : start + len(text)] = text

    def word(self, n: int) -> int:
        """Rewrites a word; returns the last token that is rewritten."""
        token, start, end = self.tokens[n], self.starts[n], self.ends[n]
        arguments = self.match[n + 1] if self.is_token(n + 1, "(") else -1
        if token in _BLANK:
            self.blank(start, end)
        elif token in _BLANK_CALLS and arguments >= 0:
            self.blank(start, self.ends[arguments])
            return arguments
        elif token in _BLANK_LINES:
            stop = self.text.find(";", end)
            self.blank(start, stop + 1 if stop >= 0 else end)
            return max(n, bisect_right(self.starts, stop) - 1)
        elif token in _VALUES and arguments >= 0:
            self.put(start, self.ends[arguments], "0")
            return arguments
        elif token == "@available" and arguments >= 0:
            self.put(
                start,
                self.ends[arguments],
                re.sub(r"\W", "_", self.text[start : self.ends[arguments]]),
            )
            return arguments
        elif token in _ENUMS and arguments >= 0 and n + 4 <= arguments:
            if n and self.tokens[n - 1] == "typedef":
                self.blank(self.starts[n - 1], start)
            self.put(start, self.ends[arguments], f"enum {self.tokens[arguments - 1]}")
            return arguments
        elif token == "__auto_type":
            self.put(start, end, "auto")
        elif token == "@":
            self.boxed(n)
        elif token[0] == "@":
            self.out[start] = " "
        elif token == "in" and n > 2 and _WORD.match(self.tokens[n - 1]):
            self.fast_enumeration(n)
        elif token == "^":
            self.block(n)
        return n

    def boxed(self, n: int) -> None:
        """Rewrites `@[...]`, `@{...}`, and `@(...)`."""
        self.out[self.starts[n]] = " "
        close = self.match[n + 1] if n + 1 < len(self.tokens) else -1
        if close >= 0 and self.tokens[n + 1] == "[":
            self.out[self.starts[n + 1]], self.out[self.starts[close]] = "{", "}"
        elif close >= 0 and self.tokens[n + 1] == "{":
            for inner in range(n + 2, close):
                if self.tokens[inner] == ":":
                    self.out[self.starts[inner]] = ","

    def fast_enumeration(self, n: int) -> None:
        """Rewrites the `in` of `for (x in y)`."""
        for before in range(n - 1, max(n - 12, 0), -1):
            if self.tokens[before] in (";", "{", "}", ")"):
                return
            if self.tokens[before] == "(":
                if self.tokens[before - 1] == "for":
                    self.put(self.starts[n], self.ends[n], ":")
                return

    def block(self, n: int) -> None:
        """Rewrites a block as a lambda, and the type of one as that of a function pointer."""
        start = self.starts[n]
        before = self.tokens[n - 1] if n else ""
        if (
            before == "("
            and n + 1 < len(self.tokens)
            and (self.is_token(n + 1, ")") or self.is_token(n + 2, ")"))
        ):
            self.out[start] = "*"
            return
        if (_WORD.match(before) and before not in _BEFORE_VALUE) or before in (")", "]"):
            return
        if start and self.out[start - 1].isspace():
            self.out[start - 1 : start + 1] = "[]"
        elif start > 1 and self.out[start - 1] == "(" and self.text[start - 1] == ":":
            self.out[start - 2 : start + 1] = "([]"
        for inner in range(n + 1, min(n + 8, len(self.tokens))):
            if self.tokens[inner] in ("(", "{"):
                self.blank(start + 1, self.starts[inner])
                return

    def message(self, n: int) -> None:
        """Rewrites `[receiver selector:argument]`; other brackets stay."""
        close = self.match[n]
        if close < 0 or (
            close + 1 < len(self.tokens) and self.tokens[close + 1] in ("(", "{", "mutable")
        ):
            return
        selector = self.selector(n, close)
        if selector is None:
            return
        name, start = self.tokens[selector], self.starts[selector]
        blank = next(
            (
                at
                for at in range(start - 1, self.ends[selector - 1] - 1, -1)
                if self.text[at] in " \t"
            ),
            start - 1,
        )
        if not self.out[blank].isspace() and not (
            self.tokens[selector - 1] == "]" and self.out[blank] == " "
        ):
            return
        self.out[self.starts[n]] = " "
        self.out[blank] = "."
        if name in _KEYWORDS:
            self.out[self.ends[selector] - 1] = "_"
        colon = selector + 1
        if not self.is_token(colon, ":") or colon > close:
            self.out[self.starts[close]] = " "
            self.messages[start] = Message(name, None)
            return
        self.out[self.starts[colon]] = "("
        self.out[self.starts[close]] = ")"
        self.messages[start] = Message(name, tuple(self.labels(colon + 1, close)))

    def labels(self, n: int, close: int) -> list[str]:
        """Blanks the labels of further arguments; returns them."""
        labels: list[str] = []
        questions = 0
        while n < close:
            token = self.tokens[n]
            if self.match[n] > n:
                n = self.match[n]
            elif token == "?":
                questions += 1
            elif token == ":" and questions:
                questions -= 1
            elif token == ":":
                labeled = (
                    _WORD.match(self.tokens[n - 1]) is not None
                    and self.ends[n - 1] == self.starts[n]
                )
                labels.append(self.tokens[n - 1] if labeled else "")
                self.put(self.starts[n - 1] if labeled else self.starts[n], self.ends[n], ",")
            n += 1
        return labels

    def selector(self, n: int, close: int) -> int | None:
        """Returns the first part of the selector of a message, or None for a subscript or a
        lambda.
        """
        first = n + 1
        operand = False
        after_group = False
        while first < close:
            token = self.tokens[first]
            if _WORD.match(token) and token not in _BEFORE_VALUE:
                ends = first + 1 == close or self.tokens[first + 1] == ":"
                if operand and (not after_group or ends):
                    return first
                operand, after_group = True, False
            elif self.match[first] > first and token != "{":
                after_group = token == "(" and not operand
                operand = True
                first = self.match[first]
            elif token[-1] in "\"'" or token[0].isdigit():
                operand, after_group = True, False
            elif token == "<" and operand:
                stop = next(
                    (at for at in range(first, min(first + 12, close)) if self.tokens[at] == ">"),
                    None,
                )
                if stop is None:
                    return None
                first = stop
            elif token in (".", "->", "::", "*", "&", "@"):
                operand = False
            else:
                return None
            first += 1
        return None

    def interface(self, n: int) -> int:
        """Rewrites the declaration of a class as a structure; returns the token after it."""
        end = next((m for m in range(n, len(self.tokens)) if self.tokens[m] == "@end"), None)
        header = _INTERFACE.match(self.text, self.ends[n])
        if end is None or header is None or self.tokens[n] == "@protocol":
            stop = self.text.find(";", self.ends[n])
            forward = (
                self.tokens[n] == "@protocol"
                and stop >= 0
                and (end is None or "@" not in self.text[self.ends[n] : stop])
            )
            last = bisect_right(self.starts, stop) - 1 if forward else end if end is not None else n
            self.blank(self.starts[n], self.ends[last])
            return last + 1
        self.classes.add(header[1])
        if header[2]:
            self.bases[header[1]] = (*self.bases.get(header[1], ()), header[2])
        self.put(self.starts[n], header.end(), f"struct {header[1]}{{")
        n = bisect_right(self.starts, header.end() - 1)
        if self.is_token(n, "{") and self.match[n] >= 0:
            self.out[self.starts[n]] = self.out[self.starts[self.match[n]]] = " "
        while n < end:
            token = self.tokens[n]
            if token == "@property":
                arguments = self.match[n + 1] if self.is_token(n + 1, "(") else n
                self.blank(self.starts[n], self.ends[arguments])
                n = max(arguments, n)
            elif token in "-+" and self.is_method(n):
                stop = self.text.find(";", self.ends[n])
                self.blank(self.starts[n], stop + 1)
                n = bisect_right(self.starts, stop) - 1
            else:
                n = self.word(n)
            n += 1
        self.put(self.starts[end], self.ends[end], " };")
        return end + 1

    def implementation(self, n: int) -> tuple[int, str]:
        """Blanks the start of an implementation; its variables become a structure. Returns the
        token after it and the class.
        """
        header = _INTERFACE.match(self.text, self.ends[n])
        if header is None:
            return n + 1, ""
        self.classes.add(header[1])
        self.blank(self.starts[n], header.end())
        after = bisect_right(self.starts, header.end() - 1)
        close = self.match[after] if self.is_token(after, "{") else -1
        if close < 0:
            return after, header[1]
        end = self.starts[close]
        self.put(self.starts[n], self.starts[after] + 1, f"struct {header[1]}{{")
        if end + 1 < len(self.out) and self.out[end + 1].isspace():
            self.out[end + 1] = ";"
        for inner in range(after + 1, close):
            self.word(inner)
        return close + 1, header[1]

    def is_method(self, n: int) -> bool:
        """Returns whether a sign begins a method: where a declaration may begin."""
        before = self.tokens[n - 1] if n else ""
        return (
            before in ("", ";", "}", "{", ")")
            or before[0] == "@"
            or self.text.rfind("\n", self.ends[n - 1], self.starts[n]) >= 0
        )

    def method(self, n: int, class_name: str) -> int:
        """Rewrites the head of a method as that of a function; returns the token after it."""
        head = _METHOD.match(self.text, self.starts[n])
        first = (
            re.compile(r"[A-Za-z_]\w*").match(self.text, head.end()) if head is not None else None
        )
        if head is None or first is None:
            return n + 1
        name, at = first[0], first.end()
        labels: list[str] | None = None
        parameters: list[tuple[str, str]] = []
        part = _PART.match(self.text, first.start())
        while part is not None and len(parameters) < 64:
            labels = [*(labels or ()), part[1] or ""]
            parameters.append((_type(part[2]), part[3]))
            at = part.end()
            part = _PART.match(self.text, at)
        body = bisect_right(self.starts, at - 1)
        stop = next(
            (
                m
                for m in range(body, min(body + 40, len(self.tokens)))
                if self.tokens[m] in ("{", ";")
            ),
            None,
        )
        if stop is None:
            return n + 1
        start, end = self.starts[n], self.starts[stop]
        safe = name[:-1] + "_" if name in _KEYWORDS else name
        kind = _type(head[2])
        for types in (True, False):
            listed = ", ".join(
                f"{kind_of_parameter if types else 'id'} {parameter}"
                for kind_of_parameter, parameter in parameters
            )
            written = f"{kind if types else 'id'} {safe}({listed})"
            if len(written) <= end - start:
                break
        else:
            return stop
        self.put(start, end, written)
        self.methods[start + written.index(" " + safe + "(") + 1] = (
            class_name,
            Message(name, tuple(labels[1:]) if labels else None),
        )
        return stop


def _type(group: str | None) -> str:
    """Returns a type in parentheses as C++; that of a block is an object."""
    if group is None or _BLOCK_TYPE.search(group):
        return "id"
    return " ".join(_QUALIFIERS.sub(" ", group[1:-1]).split()) or "id"
