"""Which functions of a file matter: the bodies of the others are blanked before the text is
preprocessed and parsed.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence, Set
from typing import NamedTuple

from msaa_lint.input.code.mentions import Words, has
from msaa_lint.input.code.parsing import blank

from .macros import Macros

_API: Words = (("Vk", ""), ("VK_", ""), ("vk::", ""), ("vkC", ""), ("MTL", ""))
"""What names of a graphics API start with."""

_GRAPHICS: Words = (
    ("attachment", ""), ("msaa", ""), ("multisampl", ""), ("multi_sampl", ""), ("renderpass", ""),
    ("render_pass", ""), ("createimage", ""),
    ("create_image", ""), ("imagecreateinfo", ""), ("imageview", ""), ("image_view", ""),
    ("imageusage", ""), ("image_usage", ""),
    ("textureusage", ""),
)  # fmt: skip
"""Words in a function, in lower case, that make it relevant, and its file one about graphics."""

_IN_GRAPHICS: Words = (
    *_GRAPHICS, ("resolve", ""), ("copyimage", ""), ("blitimage", ""), ("addtexture", ""),
    ("vk_format_d", ""), ("vk_format_s", ""),
    ("vk_format_x8_d", ""), ("format::ed", ""), ("format::es", ""), ("format::ex8d", ""),
    ("descriptor", "image|view|texture"),
    ("sampl",
    r"(?<!up)(?<!down)(?<!re)(?<!over)(?<!sub)sampl(?:es?(?!r|d|_?rate(?!_?shading)|_?type|_?format)|ing)"),
    ("transient", "transient(?!_?(?:command|cmd|buffer|pool|memory|heap))"),
    ("frame", "frame_?buffer(?!_?(?:scale|size|width|height|dim|resiz))"),
)  # fmt: skip
"""Words that make a function of such a file relevant."""

_DRAWING = "texture|image|render|frame_?buffer|swap_?chain"
"""What a file mentions whose sample counts are not those of sound."""

_FILE: Words = (*_GRAPHICS, ("samplecount", _DRAWING), ("sample_count", _DRAWING))
"""Words of a file about graphics, in lower case."""

MAX_ROUNDS = 4
"""The maximum length of a chain of calls that ends in a relevant function and whose functions are
all relevant.
"""

MAX_HEADER = 1000
"""The maximum number of characters of what precedes the body of a function."""

_SCAN = re.compile(
    r"[{}]|#[ "
    r"\t]*(?P<word>[a-z]+)(?P<rest>(?:[^\n\\]|\\\r?\n|\\.)*)|//(?:[^\n\\]|\\\r?\n|\\)*|/\*.*?(?:\*/|\Z)"
    r"|R\"(?P<mark>[^()\\\s\"]{0,16})\(.*?(?:\)(?P=mark)\"|\Z)|\"(?:[^\"\\\n]|\\.)*\"?|'(?:[^'\\\n]|\\.){1,8}'",
    re.DOTALL,
)
_CONTAINER = re.compile(r"\b(?:namespace|class|struct|union|enum|extern\s*\"C(?:\+\+)?\")(?![\w])")
_TAIL = re.compile(r"\)([^(){};]*)$")
_UNNAMED = re.compile(
    r"\s*(?:(?:typedef|static|const)\s+)*(?:struct|union|enum|class)\s+\w+\s*\([^{}]*\)\s*$"
)
"""`struct ALIGNED(16)`"""

_QUALIFIERS = frozenset(
    {"const", "noexcept", "override", "final", "volatile", "mutable", "try", "&", "&&"}
)
_TOKEN = re.compile(r"\w+|&+|\S")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)|^[ \t]*#[^\n]*", re.DOTALL | re.MULTILINE)
_TABLE = re.compile(r"=\s*+\{[\s0-9a-fA-FxXuUlL.,+\-']{400,}+\}")
_CALLED = re.compile(r"\b([A-Za-z_]\w*+)\s*+\(")
_WORD = re.compile(r"[A-Za-z_]\w*")
_DEFINITION = re.compile(r"#[ \t]*define[ \t]+(\w+)((?:[^\n\\]|\\\r?\n|\\.)*)")


_SHORT = re.compile(r"(?=[^{}]{0,160}\Z)\s*\w[^;]*;(?:[^;]*;){0,2}\s*\Z")
"""The body of a function that returns or sets a member, appends to a list, or calls another one."""

_CHAINED = re.compile(r"\breturn\s*\*\s*this\s*;\s*\Z")
"""The end of the body of a function after whose call others follow: `Builder().size(w,
h).samples(n)`.
"""

MAX_CHAINED = 1000
"""The maximum number of characters of such a body."""


class Body(NamedTuple):
    """A function in a text: where its header starts, and the range of what is between its
    braces.
    """

    header: int
    start: int
    end: int


class _Brace:
    """An open brace: what precedes it starts at `header`. `group` is the number of conditions
    around it.
    """

    __slots__ = ("group", "header", "is_container", "is_function", "start")

    def __init__(
        self, start: int, header: int, group: int, is_container: bool, is_function: bool
    ) -> None:
        self.start = start
        self.header = header
        self.group = group
        self.is_container = is_container
        self.is_function = is_function


def bodies(text: str) -> list[Body]:
    """Returns the functions of a text that lie in no other function, in order; not those of which a
    condition cuts the body.
    """
    found: list[Body] = []
    braces: list[_Brace] = []
    groups: list[list[_Brace]] = []
    last = 0
    for match in _SCAN.finditer(text):
        sign, at = match[0], match.start()
        if sign == "{":
            if not braces or braces[-1].is_container:
                start = max(last, at - MAX_HEADER)
                before = text[start:at]
                before = _COMMENT.sub(" ", before) if "/" in before or "#" in before else before
                before = before[before.rfind(";") + 1 :]
                function = _is_header(before)
                header = max(start, text.rfind(";", start, at) + 1)
                braces.append(
                    _Brace(
                        at,
                        header,
                        len(groups),
                        not function and _CONTAINER.search(before) is not None,
                        function,
                    )
                )
            else:
                braces.append(_Brace(at, last, len(groups), False, False))
            last = at + 1
        elif sign == "}":
            brace = braces.pop() if braces else None
            if brace is not None and brace.is_function and brace.group == len(groups):
                found.append(Body(brace.header, brace.start + 1, at))
            last = at + 1
        elif sign[0] == "#" and not text[text.rfind("\n", 0, at) + 1 : at].strip():
            word = match["word"]
            if word in ("if", "ifdef", "ifndef"):
                groups.append(braces.copy())
            elif groups and word in ("else", "elif", "elifdef", "elifndef"):
                for brace in braces:
                    # The condition cuts what is open around it.
                    brace.group = brace.group if brace.group < len(groups) else -1
                braces = groups[-1].copy()
            elif groups and word == "endif":
                groups.pop()
                for brace in braces:
                    brace.group = brace.group if brace.group <= len(groups) else -1
            if not braces or braces[-1].is_container:
                last = match.end()
    return found


def is_relevant(text: str) -> bool:
    """Returns whether a text mentions multisampling, or what it takes part in, other than in
    comments. Samplers alone do not.
    """
    return has(_COMMENT.sub(" ", text).lower(), _IN_GRAPHICS)


def is_about_graphics(text: str) -> bool:
    """Returns whether a file mentions a graphics API or multisampling. If not, words such as
    `resolve` mean something else in it.
    """
    text = _COMMENT.sub(" ", text)
    return has(text, _API) or has(text.lower(), _FILE)


def is_accessor(body: str) -> bool:
    """Returns whether what is between the braces of a function is an accessor's: what it returns
    may matter, whatever it is called.
    """
    return _SHORT.match(body) is not None or (
        len(body) <= MAX_CHAINED and _CHAINED.search(body, max(0, len(body) - 40)) is not None
    )


def _is_header(before: str) -> bool:
    """Returns whether a text that precedes a brace, without comments, is the header of a
    function.
    """
    tail = _TAIL.search(before.rstrip())
    if tail is None or _UNNAMED.match(before) is not None:
        return False
    return "->" in tail[1] or all(
        token in _QUALIFIERS or token.isupper() for token in _TOKEN.findall(tail[1])
    )


def without_irrelevant_bodies(text: str, macros: Macros) -> str:
    """Returns a text in which the bodies of irrelevant functions are blank; offsets stay. `macros`
    are defined elsewhere.
    """
    found = bodies(text)
    texts = [text[body.header : body.end] for body in found]
    names = [_CALLED.findall(text, body.header, body.start) for body in found]
    kept = relevant(texts, names, is_about_graphics(text), _relevant_macros(text, macros))
    parts: list[str] = []
    last = 0
    for body, matters in zip(found, kept, strict=True):
        if not matters and not is_accessor(text[body.start : body.end]):
            parts += (text[last : body.start], blank(text[body.start : body.end]))
            last = body.end
    return without_tables("".join((*parts, text[last:])))


def _mentions(text: str, words: Set[str]) -> bool:
    return any(word in text for word in words) and not words.isdisjoint(_WORD.findall(text))


def without_tables(text: str) -> str:
    """Returns a text in which long lists of numbers, such as the code of shaders, are an unknown
    name; offsets stay.
    """
    return (
        _TABLE.sub(lambda match: "=" + blank(match[0][1:-1]) + "_", text) if "{" in text else text
    )


def _relevant_macros(text: str, macros: Macros) -> set[str]:
    """Returns the names in a text of macros whose replacement mentions multisampling, or uses one
    that does.
    """
    texts = [
        *_DEFINITION.findall(text),
        *((name, macro.replacement) for name, found in macros.items() for macro in found),
    ]
    known = {name for name, replacement in texts if is_relevant(f"{name} {replacement}")}
    for _ in range(MAX_ROUNDS if known else 0):
        more = {
            name
            for name, replacement in texts
            if name not in known and not known.isdisjoint(_WORD.findall(replacement))
        }
        known |= more
        if not more:
            break
    return known & set(_WORD.findall(text)) if known else known


def relevant(
    texts: Sequence[str],
    names: Sequence[Iterable[str]],
    graphics: bool,
    words: Set[str] = frozenset(),
) -> list[bool]:
    """Returns whether functions are relevant: those that mention multisampling or one of some
    words, and their callers, transitively.

    `names` are what each function may be called by; `graphics` says whether their file is about
    graphics.
    """
    kept = [(graphics and is_relevant(text)) or _mentions(text, words) for text in texts]
    fresh = {name for n, matters in enumerate(kept) if matters for name in names[n]}
    called = (
        {n: set(_CALLED.findall(texts[n])) for n, matters in enumerate(kept) if not matters}
        if fresh
        else {}
    )
    for _ in range(MAX_ROUNDS if fresh else 0):
        callers = [n for n, those in called.items() if not those.isdisjoint(fresh)]
        if not callers:
            break
        fresh = {name for n in callers for name in names[n]}
        for n in callers:
            kept[n] = True
            del called[n]
    return kept
