"""Parses source code with tree-sitter, which needs no headers and recovers from errors."""

import re
import warnings
from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Basis
from msaa_lint.input.file_types import missing_extra

from .languages import GRAMMARS

if TYPE_CHECKING:
    import tree_sitter
    from tree_sitter import Tree

    SyntaxNode = tree_sitter.Node
else:
    # The grammars may not be installed.
    SyntaxNode = object

_NOT_ASCII = re.compile(r"[^\x00-\x7f]")

MAX_CALLBACKS = 30_000
"""The maximum number of progress callbacks of the parser, enough for 4 MB of ordinary code. Each
takes up to half a millisecond.
"""

BASE_CALLBACKS = 1000
CALLBACKS_PER_KILOBYTE = 25
"""The number of callbacks that a text of any length, and each 1000 bytes of it, may take. Ordinary
code takes 7, broken code 15.
"""

MAX_DECLARATORS = 120
"""The maximum nesting of declarators."""

_CHUNK = 1 << 16


class Missing(Unreadable):
    """The extra `source` is not installed."""


class Assumed(NamedTuple):
    """The value that the user states for a name, or for the sample count on the line `about`. `at`
    is its place in a comment; None if the configuration states it.
    """

    name: str
    value: bool | int | str
    at: Span | None
    about: Span


class Remark(NamedTuple):
    """What is wrong with a comment: the code of a 9xx finding, its message, and its place."""

    code: str
    message: str
    at: Span


class Assumptions(NamedTuple):
    """What the user states about a program, the problems of the comments that state it, and what of
    it was of use.
    """

    entries: tuple[Assumed, ...]
    remarks: tuple[Remark, ...]
    used: set[Assumed]


class Code(NamedTuple):
    """Code in one language.

    Irrelevant text is blanked, and every non-ASCII character is replaced by `_`, so that the
    parser's byte offsets are code point offsets in the input. `fragments` is set for pieces of a
    page rather than a whole program, `assumptions` once they are read.
    """

    text: str
    language: str
    fragments: bool = False
    assumptions: Assumptions | None = None


class Unread(NamedTuple):
    """Code that is not read because it exceeds a limit: a message that says which, and where it
    starts.
    """

    message: str
    at: Span


class Read(NamedTuple):
    """A description tree read from code, whose nodes have locations in the input; empty if nothing
    is known but what is not read.

    `assumed` lists unknown values, their locations, and the values assumed for them. `modules` are
    shaders by the names in the tree, `basis` says what the values in the tree rest on.
    """

    tree: Node
    assumed: tuple[tuple[str, Span, str], ...] = ()
    modules: Mapping[str, bytes] = {}
    unread: tuple[Unread, ...] = ()
    basis: Basis = Basis()


def span(node: SyntaxNode) -> Span:
    """Returns the location of a node. A byte of the parser's input is a character of the file."""
    # There are several for each line: the constructor of the tuple is called directly.
    return tuple.__new__(Span, node.byte_range)


def fields(node: SyntaxNode, *names: str) -> "tuple[SyntaxNode | None, ...]":
    """Returns the children of a node in some fields."""
    return tuple(map(node.child_by_field_name, names))


def without_comments(node: "SyntaxNode | None") -> list[SyntaxNode]:
    """Returns the named children that are not comments."""
    return (
        [child for child in node.named_children if child.type != "comment"]
        if node is not None
        else []
    )


def function_declarator(node: SyntaxNode) -> "tuple[SyntaxNode | None, SyntaxNode | None]":
    """Returns the function declarator of a declaration and the name in it; None if there is
    none.
    """
    declarator = node.child_by_field_name("declarator")
    for _ in range(MAX_DECLARATORS):
        if declarator is None or declarator.type == "function_declarator":
            break
        inner = declarator.child_by_field_name("declarator")
        declarator = inner or next(
            (child for child in declarator.named_children if child.type.endswith("declarator")),
            None,
        )
    else:
        declarator = None
    return declarator, declarator.child_by_field_name(
        "declarator"
    ) if declarator is not None else None


class SyntaxReader:
    """Reads the syntax tree of a text."""

    text: str

    def text_of(self, node: "SyntaxNode | None") -> str:
        """Returns the text of a node, or an empty string."""
        return self.text[node.start_byte : node.end_byte] if node is not None else ""


_BLANKS = {code: " " for code in range(128) if chr(code) not in "\r\n"}


def blank(text: str) -> str:
    """Returns as many blanks as a text in ASCII has characters, with its line ends."""
    return text.translate(_BLANKS)


def ascii_only(text: str) -> str:
    """Returns the text with `_` for each non-ASCII character."""
    return text if text.isascii() else _NOT_ASCII.sub("_", text)


def tree(code: Code) -> "Tree":
    """Returns the syntax tree of code.

    Raises `Missing` if the grammars are not installed, and `Unreadable` if parsing takes too long.
    """
    try:
        from tree_sitter import Language, Parser

        grammar = import_module(GRAMMARS[code.language])
    except ImportError:
        raise Missing(missing_extra()) from None
    data = code.text.encode()
    with warnings.catch_warnings():
        # tree-sitter-glsl still uses the deprecated API.
        warnings.simplefilter("ignore", DeprecationWarning)
        parser = Parser(Language(grammar.language()))
    calls = 0
    limit = min(BASE_CALLBACKS + CALLBACKS_PER_KILOBYTE * len(data) // 1000, MAX_CALLBACKS)

    def stop(_offset: int, _has_error: bool) -> bool:
        nonlocal calls
        calls += 1
        return calls > limit

    try:
        return parser.parse(
            lambda offset, _point: data[offset : offset + _CHUNK], progress_callback=stop
        )
    except ValueError:
        raise Unreadable("the code is too long or too complex to parse") from None
