"""Source code as input: detects the language of a file and builds documents from its code.

Each language has a module with `trees(code)`, which returns the code's images, passes, and
pipelines as a description. Language modules are imported only when code in that language is read.
The grammars are in the extra `source`.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.source import Unreadable
from msaa_lint.input.file_types import LANGUAGES, PAGES, missing_extra

from .languages import GRAMMARS, MODULES, language_of_header, unread

if TYPE_CHECKING:
    from msaa_lint.core.text.source import Source
    from msaa_lint.core.text.span import Span
    from msaa_lint.frame.description.document import Document

    from .parsing import Assumptions, Code, Read, Remark, Unread

WORDS = ("sample", "attachment", "resolve", "msaa", "2dms", "inputms")
"""Code that contains none of these words, in any case, is skipped."""

_ENDINGS = {ending: language for language, endings in LANGUAGES.items() for ending in endings}
_DATA = (".yaml", ".yml", ".json", ".jsonl", ".xml", ".foz", ".rdc", ".toml")


class Program(NamedTuple):
    """The documents of a source file, the assumptions made for each of them as lines for the user,
    the code that they were read from, what of it exceeds a limit, and what is wrong with the
    assumptions that its comments state.
    """

    documents: "tuple[Document, ...]"
    assumed: tuple[tuple[str, ...], ...]
    codes: "tuple[Code, ...]"
    unread: "tuple[Unread, ...]"
    remarks: "tuple[Remark, ...]" = ()


NOTHING = Program((), (), (), ())
"""What is known of code that is not read."""


def language_of(name: str, head: str) -> str | None:
    """Returns the language of a file by its extension and the start of its text, or None for other
    files.

    Any other text with fenced code blocks that mention Vulkan or Metal is read as Markdown.
    """
    ending = name[name.rfind(".") :].lower() if "." in name.rpartition("/")[2] else ""
    language = _ENDINGS.get(ending)
    if ending == ".h":
        return language_of_header(head)
    if language == "objc" and unread(name, head) is not None:
        return None
    if language is not None or ending in _DATA or not ("```" in head or "~~~" in head):
        return language
    from .fences import codes
    from .mentions import speaks

    return "markdown" if any(speaks(code.text) for code in codes(head)) else None


def installed() -> bool:
    """Returns whether the extra `source` is installed."""
    from importlib.util import find_spec

    return all(find_spec(name) is not None for name in ("tree_sitter", *GRAMMARS.values()))


def read(
    source: "Source", language: str, assumed: "Mapping[str, bool | int | str] | None" = None
) -> Program:
    """Returns the documents of source code in source order.

    Code that is not understood is left out; `assumed` are values that the configuration states, by
    name. Raises `Missing` if the extra is not installed, and `Unreadable` if the code is too long.
    """
    from .parsing import Code, Missing, ascii_only

    check_length(source)
    if language in PAGES:
        from .fences import codes

        codes_found = codes(source.text, language)
    else:
        codes_found = (Code(ascii_only(source.text), language),)
    if codes_found and not installed():
        raise Missing(missing_extra())
    assumptions = assumptions_of([(code, 0) for code in codes_found], assumed or {})
    codes_found = tuple(code._replace(assumptions=assumptions) for code in codes_found)
    by_code = [(code, list(_readings(code))) for code in codes_found]
    if len(by_code) > 1 and any(code.language == "glsl" for code, _ in by_code):
        from .glsl.description_trees import with_page_counts

        by_code = with_page_counts(by_code)
    every = [entry for _, item in by_code for entry in item]
    return program_of(
        source, codes_found, every, lambda at: f"line {source.position(at.start).line}", assumptions
    )


def assumptions_of(
    codes: "Sequence[tuple[Code, int]]", assumed: "Mapping[str, bool | int | str]"
) -> "Assumptions | None":
    """Returns what the comments of code, given with its offset in the program's text, and the
    configuration state; None if nothing.
    """
    if not assumed and not any("assume" in code.text for code, _ in codes):
        return None
    from .assumptions import stated

    return stated(codes, assumed)


def check_length(source: "Source") -> None:
    """Raises `Unreadable` if a file is too long to be read."""
    from .core.limits import MAX_CHARACTERS

    if len(source.text) > MAX_CHARACTERS:
        raise Unreadable(
            f"source code is read up to {MAX_CHARACTERS} characters, and this file has "
            f"{len(source.text)}"
        )


def program_of(
    source: "Source",
    codes: "Sequence[Code]",
    every: "Sequence[Read]",
    line: "Callable[[Span], str]",
    assumptions: "Assumptions | None" = None,
) -> Program:
    """Returns the documents of what was read, whose places are in `source`; `line` names the line
    of a place to the user. `assumptions` are those that it was read with.
    """
    from .documents import bound

    reads = [entry for entry in every if entry.tree.value or not entry.unread]
    unread = tuple(part for entry in every for part in entry.unread)
    pieces = any(code.fragments for code in codes)
    documents = tuple(
        bound(source, read.tree, pieces)._replace(modules=read.modules, basis=read.basis)
        for read in reads
    )
    return Program(
        documents,
        tuple(_assumption_lines(read.assumed, line) for read in reads),
        tuple(codes),
        unread,
        _remarks(assumptions, bool(unread)),
    )


def _remarks(assumptions: "Assumptions | None", is_unread: bool) -> "tuple[Remark, ...]":
    """Returns what is wrong with assumptions. If something is not read, none is unused."""
    if assumptions is None:
        return ()
    from .assumptions import unused

    return (*assumptions.remarks, *(() if is_unread else unused(assumptions)))


def _readings(code: "Code") -> "Iterator[Read]":
    """Yields the trees that the module of the language reads from code."""
    from msaa_lint.core.text.node_builder import mapping
    from msaa_lint.core.text.span import Span

    from .parsing import Read, Unread

    lowered = code.text.lower()
    if not any(word in lowered for word in WORDS):
        return
    module = import_module(f".{MODULES[code.language]}", __package__)
    try:
        for tree in module.trees(code):
            yield tree if isinstance(tree, Read) else Read(tree)
    except RecursionError:
        start = Span(0, 0)
        yield Read(
            mapping([], start),
            unread=(Unread("the code nests too deeply to be read; it is not checked", start),),
        )


MAX_ASSUMED = 3
"""The number of assumptions shown for each document."""


def _assumption_lines(
    assumed: "tuple[tuple[str, Span, str], ...]", line: "Callable[[Span], str]"
) -> tuple[str, ...]:
    """Returns the first assumptions as lines for the user."""
    lines = [
        f"{what} ({line(at)}) is unknown; assumed to be {value}" for what, at, value in assumed
    ]
    more = len(lines) - MAX_ASSUMED
    return (
        (*lines[:MAX_ASSUMED], f"{more} more assumption{'' if more == 1 else 's'}")
        if more > 0
        else tuple(lines)
    )
