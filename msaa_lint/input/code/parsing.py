"""Source code to syntax trees, by tree-sitter: it needs no headers, and what it cannot parse it passes over."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
import re
import warnings
from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.span import Span

if TYPE_CHECKING:
    import tree_sitter
    from tree_sitter import Tree

    SyntaxNode = tree_sitter.Node
else:
    # The grammars need not be installed.
    SyntaxNode = object

_NOT_ASCII = re.compile(r"[^\x00-\x7f]")

GRAMMARS = {"c": "tree_sitter_c", "cpp": "tree_sitter_cpp", "swift": "tree_sitter_swift", "glsl": "tree_sitter_glsl"}
"""The package of each language's grammar."""


MAX_WORK = 30_000
"""How often the parser may say how far it is: 4 MB of code as people write it, a minute of what was written to take long."""

_CHUNK = 1 << 16

EXTRA = 'source code needs the extra: pip install "msaa-lint[source]"'


class Missing(Unreadable):
    """The extra is not installed."""


class Code(NamedTuple):
    """Code of one language, at its offsets in an input: what is of no interest is blanked, and every character beyond ASCII is a `_`, so
    that a byte of the parser's is a code point of the input's. `fragments` says that it is pieces of a page, not a whole program."""

    text: str
    language: str
    fragments: bool = False


class Read(NamedTuple):
    """What was read: a tree in the form of a description whose nodes have their places in the input, and what had to be assumed: what
    is not known, where it stands, and what it was taken for. `modules` are shaders in it, by the names that the tree has."""

    tree: Node
    assumed: tuple[tuple[str, Span, str], ...] = ()
    modules: Mapping[str, bytes] = {}


def span(node: SyntaxNode) -> Span:
    """The location of a node; a byte of the parser's input is a character of the file."""
    return Span(node.start_byte, node.end_byte)


def ascii_only(text: str) -> str:
    """The text with a `_` for each character beyond ASCII."""
    return text if text.isascii() else _NOT_ASCII.sub("_", text)


def tree(code: Code) -> "Tree":
    """The syntax tree of code. Missing where the grammars are not installed, Unreadable where parsing takes too long."""
    try:
        from tree_sitter import Language, Parser

        grammar = import_module(GRAMMARS[code.language])
    except ImportError:
        raise Missing(EXTRA) from None
    data = code.text.encode()
    with warnings.catch_warnings():
        # tree-sitter-glsl hands over its grammar in the old way.
        warnings.simplefilter("ignore", DeprecationWarning)
        parser = Parser(Language(grammar.language()))
    calls = 0

    def stop(_offset: int, _has_error: bool) -> bool:
        nonlocal calls
        calls += 1
        return calls > MAX_WORK

    try:
        return parser.parse(lambda offset, _point: data[offset : offset + _CHUNK], progress_callback=stop)
    except ValueError:
        raise Unreadable("there is more code in it, or harder to parse, than is read") from None
