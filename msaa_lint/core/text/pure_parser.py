"""PyYAML's own parser with the events of libyaml's, for installations without libyaml; about
thirteen times slower.
"""

from __future__ import annotations

from typing import Any

from yaml.events import DocumentStartEvent
from yaml.parser import Parser, ParserError
from yaml.reader import Reader
from yaml.scanner import Scanner, ScannerError
from yaml.tokens import ScalarToken

_BREAKS = "\r\n\x85\u2028\u2029"
_BLANKS = "\0 \t" + _BREAKS


class PureParser(Reader, Scanner, Parser):
    """Reader, scanner and parser in one, as in PyYAML's loaders. Each override is a difference from
    libyaml.
    """

    def __init__(self, text: str) -> None:
        Reader.__init__(self, text)
        Scanner.__init__(self)
        Parser.__init__(self)

    def get_event(self) -> Any:
        event: Any = super().get_event()  # type: ignore[no-untyped-call]
        if type(event) is DocumentStartEvent and event.version not in (None, (1, 1), (1, 2)):
            raise ParserError(None, None, "found incompatible YAML document", event.start_mark)  # type: ignore[arg-type]
        return event

    def scan_to_next_token(self) -> None:
        """Tabs separate tokens where they cannot be mistaken for indentation; a line may begin with
        a byte order mark.
        """
        while True:
            if self.column == 0 and self.peek() == "\ufeff":
                self.forward()
                self.column += 1
            while self.peek() == " " or (
                self.peek() == "\t" and (self.flow_level or not self.allow_simple_key)
            ):
                self.forward()
            if self.peek() == "#":
                while self.peek() not in "\0" + _BREAKS:
                    self.forward()
            if not self.scan_line_break():  # type: ignore[no-untyped-call]
                return
            if not self.flow_level:
                self.allow_simple_key = True

    def scan_block_scalar_indicators(self, start_mark: Any) -> tuple[bool | None, int | None]:
        """A comment may follow without a space."""
        chomping: bool | None = None
        increment: int | None = None
        while True:
            ch = self.peek()
            if ch in "+-" and chomping is None:
                chomping = ch == "+"
            elif ch in "123456789" and increment is None:
                increment = int(ch)
            else:
                return chomping, increment
            self.forward()

    def scan_block_scalar_ignored_line(self, start_mark: Any) -> None:
        """Tabs are skipped like spaces."""
        while self.peek() in " \t":
            self.forward()
        if self.peek() == "#":
            while self.peek() not in "\0" + _BREAKS:
                self.forward()
        if self.peek() not in "\0" + _BREAKS:
            problem = "did not find expected comment or line break"
            raise ScannerError(
                "while scanning a block scalar", start_mark, problem, self.get_mark()
            )
        self.scan_line_break()  # type: ignore[no-untyped-call]

    def scan_block_scalar_indentation(self) -> Any:
        """The first line must not begin with a tab."""
        found: Any = super().scan_block_scalar_indentation()
        if self.peek() == "\t":
            problem = "found a tab character where an indentation space is expected"
            raise ScannerError("while scanning a block scalar", None, problem, self.get_mark())
        return found

    def scan_flow_scalar_non_spaces(self, double: bool, start_mark: Any) -> list[str]:
        """An escape must not be half of a surrogate pair."""
        try:
            chunks: list[str] = super().scan_flow_scalar_non_spaces(double, start_mark)
        except (ValueError, OverflowError):
            chunks = ["\ud800"]
        if any("\ud800" <= chunk <= "\udfff" for chunk in chunks if len(chunk) == 1):
            raise ScannerError(
                "while parsing a quoted scalar",
                start_mark,
                "found invalid Unicode character escape code",
                self.get_mark(),
            )
        return chunks

    def scan_plain(self) -> ScalarToken:
        """A plain scalar may contain tabs and, in a flow collection, `?`, but no `:` before
        `,[]{}`.
        """
        chunks: list[str] = []
        start = end = self.get_mark()
        indent = self.indent + 1
        spaces: list[str] = []
        flow = bool(self.flow_level)
        while self.peek() != "#" and not self._document_indicator():
            length = 0
            while True:
                ch = self.peek(length)
                if ch in _BLANKS or (flow and ch in ",[]{}"):
                    break
                if ch == ":":
                    after = self.peek(length + 1)
                    if flow and after in ",?[]{}":
                        self.forward(length)
                        raise ScannerError(
                            "while scanning a plain scalar",
                            start,
                            "found unexpected ':'",
                            self.get_mark(),
                        )
                    if after in _BLANKS:
                        break
                length += 1
            if length == 0:
                break
            self.allow_simple_key = False
            chunks += (*spaces, self.prefix(length))
            self.forward(length)
            end = self.get_mark()
            if self.peek() not in " \t" + _BREAKS:
                break
            spaces = self._plain_spaces(indent, start)
            if not flow and self.column < indent:
                break
        return ScalarToken("".join(chunks), True, start, end)

    def _plain_spaces(self, indent: int, start: Any) -> list[str]:
        """The white space within or after a plain scalar, with line breaks folded."""
        blanks = ""
        breaks: list[str] = []
        while self.peek() in " \t" + _BREAKS:
            ch = self.peek()
            if ch in " \t":
                if breaks and ch == "\t" and self.column < indent:
                    problem = "found a tab character that violates indentation"
                    raise ScannerError(
                        "while scanning a plain scalar", start, problem, self.get_mark()
                    )
                if not breaks:
                    blanks += ch
                self.forward()
            else:
                breaks.append(self.scan_line_break())  # type: ignore[no-untyped-call]
        if not breaks:
            return [blanks]
        self.allow_simple_key = True
        first, *rest = breaks
        if first != "\n":
            return breaks
        return rest or [" "]

    def _document_indicator(self) -> bool:
        return self.column == 0 and self.prefix(3) in ("---", "...") and self.peek(3) in _BLANKS
