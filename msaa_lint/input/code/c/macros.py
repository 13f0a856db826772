"""Macros: what a text defines, and the expansion of a use (C17, 6.10.3).

The tokens of an expansion know their places, so that a finding lies where its code is written: in
the use of the macro, or in its replacement.
"""

import re
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import NamedTuple

from msaa_lint.core.text.span import Span

MAX_TOKENS = 20_000
"""The maximum number of tokens of one expansion, intermediate ones included."""

MAX_ARGUMENTS = 2000
"""The maximum number of tokens in the arguments of a macro."""

MAX_DEFINITIONS = 4
"""The maximum number of different definitions of a macro that are kept; with more than one, only
annotations are expanded.
"""

_TOKEN = re.compile(
    r"(?P<blank>(?:\s|\\\r?\n|//[^\n]*|/\*.*?(?:\*/|\Z))+)|(?P<word>[A-Za-z_]\w*)|(?P<number>\.?\d(?:[eEpP][-+]|'\w|[\w.])*)"
    r"|\"(?:[^\"\\\n]|\\.)*\"?|'(?:[^'\\\n]|\\.)*'?|##|->|::|.",
    re.DOTALL,
)
_DEFINE = re.compile(r"\s*([A-Za-z_]\w*)(?:\(([^()]*)\))?")
_DIRECTIVE_BLANKS = re.compile(r"(?:\s|\\\r?\n|//[^\n]*|/\*.*?\*/)+", re.DOTALL)

_ANNOTATION = re.compile(
    r"(?:\s|__declspec\s*\([^()]*(?:\([^()]*\))?\s*\)|__attribute__\s*\(\([^()]*(?:\([^()]*\)[^()]*)*\)\)|\[\[[^\[\]]*\]\]|_Pragma\s*\([^()]*\)"
    r"|__pragma\s*\([^()]*(?:\([^()]*\))?\s*\)|extern\s*\"C\"|alignas\s*\([^()]*\)"
    r"|\b(?:extern|inline|static|constexpr|consteval|volatile|restrict|__restrict(?:__)?|noexcept|register|explicit|final|override"
    r"|__\w*(?:inline|call|cdecl|restrict|noreturn|extension)\w*|_cdecl|WINAPI|APIENTRY|CALLBACK|STDCALL|EMSCRIPTEN_KEEPALIVE)\b)*"
)
"""A replacement that says how to compile or to link, not what."""

_LEAVES = re.compile(
    r"\b(?:return|abort|exit|_exit|throw|goto|break|continue|terminate|raise|__debugbreak|assert)\b"
)

_SAYS = re.compile(
    r"[sS]ample|SAMPLE|[aA]ttachment|ATTACHMENT|[rR]esolve|RESOLVE|_OP_|Create[A-Z]|Info\b|Description"
)
"""What a macro says of a frame."""

_KEPT = re.compile(
    r"vk[A-Z]|Vk[A-Z]|VK_\w+_(?:KHR|EXT|NV|AMD|ARM|QCOM|BIT|ENUM)$|(?:MIN|MAX|min|max|VK_NULL_HANDLE|NULL|TRUE|FALSE|true|false|nullptr|bool|assert)$"
)
"""Names that mean the same wherever they are defined."""


class Macro(NamedTuple):
    """A definition: the parameters, None for an object-like macro; the replacement as written; its
    place in its own file, if the use is there too.
    """

    parameters: tuple[str, ...] | None
    replacement: str
    at: int | None = None
    certain: bool = True
    """Whether it is defined under no condition."""
    default: bool = False
    """Whether it applies only if the build defines nothing else."""

    def same(self, other: "Macro") -> bool:
        """Returns whether two definitions are the same but for blanks."""
        return self.parameters == other.parameters and _spelled(self.replacement) == _spelled(
            other.replacement
        )

    @property
    def is_annotation(self) -> bool:
        """Whether the macro can be left out of code without a change of what it does."""
        return _ANNOTATION.fullmatch(_DIRECTIVE_BLANKS.sub(" ", self.replacement)) is not None

    @property
    def is_number(self) -> bool:
        """Whether it is a number, which stays as its name unless other macros use it."""
        return self.is_constant and self.replacement.strip(" \t()")[:1].isdigit()

    @property
    def is_constant(self) -> bool:
        """Whether it is a number or a name, which is read like a constant."""
        return (
            self.parameters is None
            and sum(
                token[1] != "blank" and token[0] not in "()" for token in tokens(self.replacement)
            )
            == 1
        )


Definitions = tuple[Macro, ...]
"""The different definitions that a name may have; none if it is certainly undefined."""

Macros = Mapping[str, Definitions]
"""Macros by name. Of other names nothing is known."""

NO_MACROS: Macros = {}


def parsed(rest: str, at: int, certain: bool, default: str) -> tuple[str, Macro] | None:
    """Returns the name and the definition that follow `#define`; `at` is the offset of that text,
    `default` the name that an enclosing #ifndef tests.
    """
    match = _DEFINE.match(rest)
    if match is None:
        return None
    parameters = None
    if match[2] is not None:
        parameters = tuple(word for word in _DIRECTIVE_BLANKS.sub("", match[2]).split(",") if word)
    body = rest[match.end() :]
    return match[1], Macro(parameters, body, at + match.end(), certain, match[1] == default)


def extended(before: Definitions, macro: Macro) -> Definitions:
    """Returns the definitions of a name after a further one that may apply."""
    if macro.certain:
        return (macro,)
    if any(macro.same(item) for item in before):
        return before
    return (*before, macro)[: MAX_DEFINITIONS + 1]


def merged(files: Iterable[Macros]) -> dict[str, Definitions]:
    """Returns the macros of several files as others see them."""
    every: dict[str, Definitions] = {}
    for macros in files:
        for name, definitions in macros.items():
            for macro in definitions:
                before = every.get(name, ())
                if not before or not any(macro.same(item) for item in before):
                    every[name] = (
                        *before,
                        macro._replace(at=None, certain=macro.certain and not before),
                    )[: MAX_DEFINITIONS + 1]
    return every


def expandable(name: str, definitions: Definitions) -> Macro | None:
    """Returns the definition by which a name is replaced, or None if it stays."""
    if not definitions or _KEPT.match(name):
        return None
    macro = definitions[0]
    if all(item.is_annotation for item in definitions):
        return macro._replace(replacement="")
    if (
        len(definitions) > 1
        or "__VA_OPT__" in macro.replacement
        or (macro.default and macro.parameters is None)
    ):
        return None
    if macro.is_constant and name.startswith("VK_"):
        return None
    # Checks of a result wrap a call, and leave what follows as it is.
    return (
        None if _LEAVES.search(macro.replacement) and not _SAYS.search(macro.replacement) else macro
    )


@lru_cache(maxsize=4096)
def _spelled(replacement: str) -> str:
    return " ".join(text for text, kind, _ in tokens(replacement) if kind != "blank")


def tokens(text: str) -> list[tuple[str, str, int]]:
    """Returns the tokens of a text: the text of each, its kind (`blank`, `word`, `number`, or
    another), and its offset.
    """
    return [(match[0], match.lastgroup or "", match.start()) for match in _TOKEN.finditer(text)]


class Token(NamedTuple):
    """A token of an expansion, and its place. `hidden` are the macros that it is not a use of."""

    text: str
    kind: str
    place: Span | None
    hidden: frozenset[str] = frozenset()
    written: bool = False
    """Whether its place lies in the use of the macro, not in a replacement."""


class TooLong(Exception):
    """An expansion exceeds a limit."""


def _trimmed(items: list[Token]) -> list[Token]:
    """Returns an argument without the blanks around it."""
    start, end = 0, len(items)
    while start < end and items[start].kind == "blank":
        start += 1
    while end > start and items[end - 1].kind == "blank":
        end -= 1
    return items[start:end]


@lru_cache(maxsize=4096)
def _pieces(replacement: str) -> list[tuple[str, str, int]]:
    """Returns the tokens of a replacement without blanks around it and beside `#` and `##`; other
    blanks are one space.
    """
    pieces: list[tuple[str, str, int]] = []
    for text, kind, offset in tokens(replacement):
        if kind != "blank":
            if text == "##" and pieces and pieces[-1][1] == "blank":
                pieces.pop()
            pieces.append((text, kind, offset))
        elif pieces and pieces[-1][0] not in ("#", "##"):
            pieces.append((" ", kind, offset))
    if pieces and pieces[-1][1] == "blank":
        pieces.pop()
    return pieces


class Expansion:
    """The expansion of one use: `macros` returns the definition of a name, or None; `text` is that
    of the file, `end` the end of what was taken from it.
    """

    def __init__(self, macros: Mapping[str, Macro], text: str, start: int, stop: int) -> None:
        self.macros = macros
        self.text = text
        self.end = start
        self.stop = stop
        self.pending: list[Token] = []
        """The tokens to read next, the last first."""
        self.count = 0

    def expand(self) -> list[Token]:
        """Returns the tokens of the use that starts in the text. Raises TooLong."""
        result: list[Token] = []
        self.pending.append(self._from_text())
        while self.pending or self._continues(result):
            token = self.pending.pop() if self.pending else result.pop()
            replaced = self._replaced(token)
            if replaced is None:
                result.append(token)
            else:
                self.pending += reversed(replaced)
        return result

    def _continues(self, result: list[Token]) -> bool:
        """Returns whether the expansion ends in the name of a macro whose arguments follow the
        use.
        """
        while result and result[-1].kind == "blank":
            result.pop()
        last = result[-1] if result else None
        macro = (
            self.macros.get(last.text)
            if last is not None and last.kind == "word" and last.text not in last.hidden
            else None
        )
        return macro is not None and macro.parameters is not None and self._next_is_parenthesis()

    def _next_is_parenthesis(self) -> bool:
        for token in reversed(self.pending):
            if token.kind != "blank":
                return token.text == "("
        match = _TOKEN.match(self.text, self.end, self.stop)
        if match is not None and match.lastgroup == "blank":
            match = _TOKEN.match(self.text, match.end(), self.stop)
        return match is not None and match[0] == "("

    def _from_text(self) -> Token:
        match = _TOKEN.match(self.text, self.end, self.stop)
        if match is None:
            raise TooLong
        self.end = match.end()
        kind = match.lastgroup or ""
        return Token(
            match[0] if kind != "blank" else " ",
            kind,
            Span(match.start(), match.end()),
            frozenset(),
            True,
        )

    def _next(self) -> Token:
        self.count += 1
        if self.count > MAX_TOKENS:
            raise TooLong
        return self.pending.pop() if self.pending else self._from_text()

    def _replaced(self, token: Token) -> list[Token] | None:
        """Returns the replacement of a token that is the use of a macro, its arguments taken from
        what follows; None for others.
        """
        self.count += 1
        if self.count > MAX_TOKENS:
            raise TooLong
        if token.kind != "word" or token.text in token.hidden:
            return None
        macro = self.macros.get(token.text)
        if macro is None:
            return None
        arguments: dict[str, list[Token]] = {}
        if macro.parameters is not None:
            if not self._next_is_parenthesis():
                return None
            arguments = self._arguments(macro.parameters)
        return self._substituted(token, macro, arguments)

    def _arguments(self, parameters: tuple[str, ...]) -> dict[str, list[Token]]:
        """Takes the arguments of a use, with their parentheses, from what follows."""
        while self._next().text != "(":
            pass
        items: list[list[Token]] = [[]]
        rest = bool(parameters) and parameters[-1].endswith("...")
        depth = 1
        for _ in range(MAX_ARGUMENTS):
            token = self._next()
            # Only parentheses protect commas.
            depth += (token.text == "(") - (token.text == ")")
            if not depth:
                break
            if token.text == "," and depth == 1 and not (rest and len(items) == len(parameters)):
                items.append([])
            else:
                items[-1].append(token)
        else:
            raise TooLong
        if len(items) != max(len(parameters), 1) and not (
            rest and len(items) == len(parameters) - 1
        ):
            raise TooLong
        names = (
            [*parameters[:-1], parameters[-1].removesuffix("...") or "__VA_ARGS__"]
            if rest
            else parameters
        )
        return {name: _trimmed(items[n]) if n < len(items) else [] for n, name in enumerate(names)}

    def _substituted(
        self, use: Token, macro: Macro, arguments: dict[str, list[Token]]
    ) -> list[Token]:
        """Returns the replacement of a use with its arguments."""
        result: list[Token] = []
        body = _pieces(macro.replacement)
        rest = [name for name in arguments if name not in (macro.parameters or ())]
        joins = False
        for n, (text, kind, offset) in enumerate(body):
            after = body[n + 1][0] if n + 1 < len(body) else ""
            before = body[n - 1][0] if n else ""
            place = (
                Span(macro.at + offset, macro.at + offset + len(text))
                if macro.at is not None and len(body) > 1
                else None
            )
            items = [Token(text, kind, place)]
            if text == "##":
                joins = True
                continue
            if text == "#" and after in arguments:
                spelled = (
                    "".join(item.text for item in arguments[after])
                    .replace("\\", "\\\\")
                    .replace('"', '\\"')
                )
                items = [Token(f'"{spelled}"', "", place)]
            elif text in arguments:
                if before == "#":
                    continue
                items = (
                    arguments[text] if joins or after == "##" else self._expanded(arguments[text])
                )
            if joins and result and result[-1].text == "," and text in rest:
                # GNU: the comma before absent arguments is removed.
                result = result[: None if items else -1] + items
            elif joins and result and items:
                last, first = result[-1], items[0]
                place = first.place if first.written else last.place
                result[-1] = Token(
                    last.text + first.text,
                    last.kind,
                    place,
                    last.hidden & first.hidden,
                    last.written and first.written,
                )
                result += items[1:]
            else:
                result += items
            joins = False
        hidden = use.hidden | {use.text}
        return [token._replace(hidden=token.hidden | hidden) for token in result]

    def _expanded(self, argument: list[Token]) -> list[Token]:
        """Returns an argument with its own macros replaced."""
        if not any(token.kind == "word" and token.text in self.macros for token in argument):
            return argument
        inner = Expansion(self.macros, "", 0, 0)
        inner.count = self.count
        inner.pending = argument[::-1]
        result: list[Token] = []
        while inner.pending:
            token = inner.pending.pop()
            replaced = inner._replaced(token)
            if replaced is None:
                result.append(token)
            else:
                inner.pending += reversed(replaced)
        self.count = inner.count
        return result
