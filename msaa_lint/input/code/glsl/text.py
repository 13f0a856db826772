"""Preprocesses GLSL: blanks comments and directives, evaluates conditions, expands macros (GLSL
4.60, 3.3).

As with glslang without options, nothing is defined except what the file defines.
"""

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from typing import NamedTuple

MAX_TEXT = 1 << 20
"""The maximum length of a shader before and after macro expansion, in characters."""

MAX_EXPANDED = 1 << 17
"""The maximum length of a macro expansion, in characters."""

MAX_NESTED = 16
"""The maximum nesting of macros."""

MAX_MACROS = 500

_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_VISIBLE = re.compile(r"[^\n]")
_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(\w*)[ \t]*(.*)", re.DOTALL)
_DEFINE = re.compile(r"(\w+)(\([^()]*\))?[ \t]*(.*)", re.DOTALL)
_TOKEN = re.compile(r"[A-Za-z_]\w*|\.?[0-9](?:[eE][+-]|[\w.])*|\s+|.", re.DOTALL)
_DEFINED = re.compile(r"\bdefined\s*(?:\(\s*(\w+)\s*\)|(\w+))")
_ALONE = re.compile(
    r"\blayout\s*\(([^()]*)\)\s*(?:in|out)\s*;|\bprecision\s+\w+\s+\w+\s*;|\b(?:invariant|precise)\s+[\w,\s]+;(?=\s*(?:\n|$))"
)


class UnsupportedShader(Exception):
    """The shader uses something unsupported; the message says what."""


class ShaderLimitExceeded(UnsupportedShader):
    """The shader exceeds a limit; the message says which."""


class Macro(NamedTuple):
    """The replacement of a macro. `parameters` is None for an object-like macro."""

    parameters: tuple[str, ...] | None
    body: str


class Branch(NamedTuple):
    """The current branch of a condition: whether its text exists, whether that of the condition
    does, and whether a branch was taken.
    """

    live: bool
    outer: bool
    taken: bool


class PreprocessedText(NamedTuple):
    """The text to parse, pairs of offsets in it and in the original text, and the contents of
    `layout(...) in;`.
    """

    text: str
    pieces: tuple[tuple[int, int], ...]
    layouts: tuple[str, ...]

    def place(self, offset: int) -> int:
        """Returns the offset in the original text."""
        index = bisect_right(self.pieces, (offset, 1 << 60)) - 1
        start, original = self.pieces[index] if index >= 0 else (0, 0)
        next_node = self.pieces[index + 1][1] if index + 1 < len(self.pieces) else 1 << 60
        return min(original + offset - start, max(next_node - 1, original))


def blank(text: str) -> str:
    """Returns a text with every character replaced by a space, except line ends."""
    return _VISIBLE.sub(" ", text)


def preprocess(text: str) -> PreprocessedText:
    """Returns a preprocessed shader. Raises UnsupportedShader if a directive is not understood."""
    if len(text) > MAX_TEXT:
        raise ShaderLimitExceeded(f"the shader has more than {MAX_TEXT} characters")
    text = _COMMENT.sub(lambda match: blank(match[0]), text.replace("\r", " "))
    out: list[str] = []
    pieces: list[tuple[int, int]] = []
    length = at = 0
    macros: dict[str, Macro] = {
        "GL_core_profile": Macro(None, "1"),
        "VULKAN": Macro(None, "100"),
        "__VERSION__": Macro(None, "450"),
    }
    branches: list[Branch] = []
    for line in re.findall(r"(?:[^\n\\]|\\\n|\\)*(?:\n|\Z)", text):
        directive = _DIRECTIVE.match(line) if "#" in line else None
        parts: Iterable[tuple[str, int]] = [(blank(line), at)]
        if directive is not None:
            _apply_directive(
                directive[1], directive[2].replace("\\\n", "").strip(), macros, branches
            )
        elif not branches or branches[-1].live:
            parts = _expanded(line, at, macros)
        for part, original in parts:
            if part:
                pieces.append((length, original))
                out.append(part)
                length += len(part)
        at += len(line)
        if length > MAX_TEXT:
            raise ShaderLimitExceeded(
                f"the macros of the shader expand to more than {MAX_EXPANDED} characters in a "
                f"line, or {MAX_TEXT} in all"
            )
    layouts: list[str] = []

    def noted(match: re.Match[str]) -> str:
        layouts.append(match[1] or "")
        return blank(match[0])

    whole = _ALONE.sub(noted, "".join(out))
    return PreprocessedText(whole, tuple(pieces), tuple(layouts))


def _apply_directive(
    name: str, rest: str, macros: dict[str, Macro], branches: list[Branch]
) -> None:
    live = not branches or branches[-1].live
    if name in ("ifdef", "ifndef"):
        word = rest.split()[0] if rest.split() else ""
        holds = (word in macros) == (name == "ifdef")
        branches.append(Branch(live and holds, live, holds))
    elif name == "if":
        holds = live and _condition_holds(rest, macros)
        branches.append(Branch(holds, live, holds))
    elif name in ("else", "elif") and branches:
        _, outer, before = branches.pop()
        holds = not before and (name == "else" or (outer and _condition_holds(rest, macros)))
        branches.append(Branch(outer and holds, outer, before or holds))
    elif name == "endif" and branches:
        branches.pop()
    elif name == "define" and live:
        match = _DEFINE.fullmatch(rest)
        if match is not None:
            parameters = (
                tuple(word.strip() for word in match[2][1:-1].split(",") if word.strip())
                if match[2]
                else None
            )
            macros[match[1]] = Macro(parameters, match[3].strip())
            if len(macros) > MAX_MACROS:
                raise ShaderLimitExceeded(f"the shader has more than {MAX_MACROS} macros")
    elif name == "undef" and live:
        macros.pop(rest, None)
    # An `include` may define anything; a missing definition is reported where it is used.


def _condition_holds(condition: str, macros: dict[str, Macro]) -> bool:
    """Returns whether the condition of an `#if` holds. Raises UnsupportedShader if it is too
    complex.
    """
    text = _DEFINED.sub(lambda match: "1" if (match[1] or match[2]) in macros else "0", condition)
    text = _expand(text, macros, ())
    text = re.sub(r"\b[A-Za-z_]\w*\b", "0", text)
    from msaa_lint.input.code.sample_counts.arithmetic import condition_holds

    answer = condition_holds(text)
    if answer is None:
        raise UnsupportedShader(f"`#if {condition[:40]}` is not supported")
    return answer


def _expanded(line: str, at: int, macros: dict[str, Macro]) -> Iterator[tuple[str, int]]:
    """Yields the parts of a line with its macros expanded, and the offset of each in the original
    text.
    """
    position = 0
    if any(name in line for name in macros):
        for start, end, body in _replacements(line, macros, ()):
            yield line[position:start], at + position
            yield body, at + start
            position = end
    yield line[position:], at + position


def _replacements(
    text: str, macros: dict[str, Macro], expanding: tuple[str, ...]
) -> Iterator[tuple[int, int, str]]:
    """Yields the range of each macro in a text, and its expansion. A macro is not expanded in its
    own expansion.
    """
    tokens = [(match[0], match.start(), match.end()) for match in _TOKEN.finditer(text)]
    index = 0
    while index < len(tokens):
        word, start, end = tokens[index]
        macro = macros.get(word)
        index += 1
        if macro is None or word in expanding:
            continue
        body = macro.body
        if macro.parameters is not None:
            arguments = _arguments(tokens, index)
            if arguments is None:
                continue
            values, index = arguments
            end = tokens[index - 1][2]
            named = dict(zip(macro.parameters, values, strict=False))
            body = "".join(named.get(match[0], match[0]) for match in _TOKEN.finditer(body))
        yield start, end, _expand(body, macros, (*expanding, word))


def _arguments(tokens: list[tuple[str, int, int]], index: int) -> tuple[list[str], int] | None:
    """Returns the arguments of a macro in parentheses, and the index of the token after them."""
    while index < len(tokens) and tokens[index][0].isspace():
        index += 1
    if index >= len(tokens) or tokens[index][0] != "(":
        return None
    depth, arguments = 0, [""]
    for n in range(index, len(tokens)):
        word = tokens[n][0]
        depth += (word == "(") - (word == ")")
        if depth == 0:
            return [item.strip() for item in arguments], n + 1
        if word == "," and depth == 1:
            arguments.append("")
        elif n > index:
            arguments[-1] += word
    return None


def _expand(text: str, macros: dict[str, Macro], expanding: tuple[str, ...]) -> str:
    """Returns a text with its macros expanded."""
    if len(text) > MAX_EXPANDED:
        raise ShaderLimitExceeded(
            f"the macros of the shader expand to more than {MAX_EXPANDED} characters in a line, or "
            f"{MAX_TEXT} in all"
        )
    if len(expanding) > MAX_NESTED:
        return text
    out: list[str] = []
    position = size = 0
    for start, end, body in _replacements(text, macros, expanding):
        out += (text[position:start], body)
        size += start - position + len(body)
        position = end
        if size > MAX_EXPANDED:
            break
    if size + len(text) - position > MAX_EXPANDED:
        raise ShaderLimitExceeded(
            f"the macros of the shader expand to more than {MAX_EXPANDED} characters in a line, or "
            f"{MAX_TEXT} in all"
        )
    return "".join(out) + text[position:]
