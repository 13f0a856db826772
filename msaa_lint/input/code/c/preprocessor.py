"""Preprocesses C and C++ as far as that is certain without a build: leaves out dead code, and
replaces macros.

Conditions that the text does not decide stay in it, for the grammar and for `directives`.
"""

from __future__ import annotations

import re
from bisect import bisect_right

from msaa_lint.core.quote import shortened
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.conditions import condition_key
from msaa_lint.input.code.parsing import Code, Unread, blank
from msaa_lint.input.code.places import Piece, Places
from msaa_lint.input.code.sample_counts.arithmetic import condition_holds

from .groups import Arm, Group, Line, balance, cuts_statement
from .macros import (
    NO_MACROS,
    Definitions,
    Expansion,
    Macro,
    Macros,
    Token,
    TooLong,
    expandable,
    extended,
    parsed,
)

MAX_NESTED = 8
"""The maximum nesting of macros in a condition."""

BASE_LENGTH = 100_000
"""The number of characters that the expansions of macros may add to a text, besides its own
length.
"""

_SCAN = re.compile(
    r"#[ \t]*(?P<word>[a-z_]\w*)(?P<rest>(?:[^\n\\/]|\\\r?\n|\\|/(?![*/])|/\*[^*]*(?:\*(?!/)[^*]*)*\*/)*)(?://[^\n]*)?"
    r"|//(?:[^\n\\]|\\\r?\n|\\)*|/\*.*?(?:\*/|\Z)|R\"(?P<mark>[^()\\\s\"]{0,16})\(.*?(?:\)(?P=mark)\"|\Z)"
    r"|\"(?:[^\"\\\n]|\\.)*\"?|'(?:[^'\\\n]|\\.){1,8}'",
    re.DOTALL,
)
"""Directives, comments, and literals."""

_WORD = re.compile(r"[A-Za-z_]\w*")
_TESTED = re.compile(r"\bdefined\s*(?:\(\s*(\w+)\s*\)|(\w+))|\b([A-Za-z_]\w*)\s*(\([^()]*\))?")


class Preprocessed:
    """A text while its directives are read, and what remains of it. `macros` are those that are
    defined elsewhere.

    `structural` also chooses among parts that the grammar cannot read together.
    """

    def __init__(
        self,
        text: str,
        is_cpp: bool,
        macros: Macros,
        structural: bool = True,
        fragments: bool = False,
    ) -> None:
        self.text = text
        self.macros: dict[str, Definitions] = dict(macros)
        """The macros that are defined where the reading is. Without definitions, a name is
        certainly undefined.
        """
        self.macros["__cplusplus"] = (Macro(None, "202002L"),) if is_cpp else ()
        self.structural = structural
        self.opaque: list[tuple[int, int]] = []
        """The ranges of comments and literals."""
        self.edits: list[tuple[int, int, str | None]] = []
        """Ranges of the text that are blanked, or replaced by a text of the same length."""
        self.expansions: list[tuple[Span, list[Token]]] = []
        self.unread: list[Unread] = []
        self._known = {
            name: macro
            for name, found in self.macros.items()
            if (macro := expandable(name, found)) is not None
        }
        """The macros that are replaced."""
        self._active = {name for name, macro in self._known.items() if not macro.is_number}
        """Those of them that are replaced outside of others."""
        self._chosen: dict[str, bool] = {}
        """The values of conditions that are assumed because the grammar cannot read both ways."""
        self._budget = BASE_LENGTH + len(text)
        self._groups: list[Group] = []
        self._depth = 1 if fragments else 0
        """The open braces and parentheses, at most; conditions on a page's statements stay."""
        self._read()

    def _read(self) -> None:
        """Reads the directives in order, and the text between them."""
        lines = self._lines()
        last = 0
        for n, line in enumerate(lines):
            self._between(last, line.start)
            after = lines[n + 1] if n + 1 < len(lines) else None
            if line.word in ("if", "ifdef", "ifndef"):
                self._open(line, after)
            elif line.word in ("elif", "elifdef", "elifndef", "else") and self._groups:
                self._next_arm(line)
            elif line.word == "endif" and self._groups:
                self._close(line)
            elif self._state() is not False:
                self._definition(line)
            last = line.end
        self._between(last, len(self.text))

    def _lines(self) -> list[Line]:
        """Returns the directives, and notes comments and literals."""
        lines: list[Line] = []
        text = self.text
        for match in _SCAN.finditer(text):
            start, end = match.span()
            if text[start] != "#":
                self.opaque.append((start, end))
            elif not text[text.rfind("\n", 0, start) + 1 : start].strip():
                lines.append(Line(start, end, match["word"], match["rest"], match.start("rest")))
        return lines

    def _state(self) -> bool | None:
        """Returns whether the text being read exists; None if a condition decides."""
        return self._groups[-1].state() if self._groups else True

    def _open(self, line: Line, after: Line | None) -> None:
        group = Group(self._state(), self._depth)
        self._groups.append(group)
        name = line.rest.strip() if line.word == "ifndef" else ""
        guards = (
            after is not None
            and after.word == "define"
            and name
            and line.condition == after.condition
        )
        group.add(
            line, True if guards else self._value(line) if group.outer is not False else False
        )

    def _next_arm(self, line: Line) -> None:
        group = self._groups[-1]
        self._end_arm(group, line)
        known = line.word == "else" or (
            self._value(line) if group.outer is not False and not group.taken else False
        )
        group.add(line, False if group.taken else known)

    def _end_arm(self, group: Group, line: Line) -> None:
        arm = group.arms[-1]
        if arm.exists is False and group.outer is not False:
            self.edits.append((arm.line.end, line.start, None))
        self._depth = group.depth

    def _close(self, line: Line) -> None:
        group = self._groups.pop()
        self._end_arm(group, line)
        if group.outer is False:
            return
        remaining = [arm for arm in group.arms if arm.exists is not False]
        undecided = any(arm.exists is None for arm in remaining)
        arm: Arm | None = remaining[0] if remaining else None
        arms = list(zip(group.arms, [*(item.line for item in group.arms[1:]), line], strict=True))
        if undecided and self.structural and (group.is_structural() or self._cut(arms)):
            arm = self._chosen_arm(remaining)
            for other, next_line in arms:
                if other is not arm and other in remaining:
                    self.edits.append((other.line.end, next_line.start, None))
            undecided = False
        if not undecided or (self.structural and group.depth == 0):
            # Outside of functions, what depends on a condition is known wherever the condition is.
            self.edits += [
                (item.start, item.end, None)
                for item in (*(other.line for other in group.arms), line)
            ]
        else:
            self._shorten(group, remaining)
        if arm is not None:
            self._depth += arm.brackets[0] + arm.brackets[1]
            if self._groups:
                self._groups[-1].arms[-1].count(arm.brackets)

    def _cut(self, arms: list[tuple[Arm, Line]]) -> bool:
        """Returns whether an arm that may exist begins or ends within a statement."""
        return any(
            cuts_statement(self.text[arm.line.end : after.start])
            for arm, after in arms
            if arm.exists is not False
        )

    def _shorten(self, group: Group, remaining: list[Arm]) -> None:
        """Leaves out the directives of arms that do not exist."""
        self.edits += [
            (arm.line.start, arm.line.end, None) for arm in group.arms if arm.exists is False
        ]
        first, last = remaining[0].line, remaining[-1]
        if first.word.startswith("el"):
            at = self.text.index(first.word, first.start)
            self.edits.append((at, at + len(first.word), first.word[2:].ljust(len(first.word))))
        if last.exists is True and last.line.word != "else":
            start, end = last.line.start, last.line.end
            self.edits.append((start, end, "#else" + blank(self.text[start + 5 : end])))

    def _chosen_arm(self, arms: list[Arm]) -> Arm | None:
        """Returns the arm that is read where the grammar can read only one: that of the first
        condition, wherever it is tested.
        """
        for arm in arms:
            if arm.exists is True:
                return arm
            key, way = condition_key(arm.line.condition, not arm.line.word.endswith("ndef"))
            if self._chosen.setdefault(key, way) is way:
                return arm
        return None

    def _definition(self, line: Line) -> None:
        if line.word == "define":
            default = self._groups[-1].default() if self._groups else ""
            found = parsed(line.rest, line.at, self._state() is True, default)
            if found is None:
                return
            name, macro = found
            self._define(name, extended(self.macros.get(name, ()), macro))
            if macro.is_constant and not macro.default:
                return
        elif line.word == "undef" and self._state() is True:
            self._define(line.condition, ())
        if line.word not in ("include", "import", "include_next", "embed"):
            self.edits.append((line.start, line.end, None))

    def _define(self, name: str, found: Definitions) -> None:
        self.macros[name] = found
        macro = expandable(name, found)
        self._active.discard(name)
        if macro is None:
            self._known.pop(name, None)
            return
        self._known[name] = macro
        if not macro.is_number:
            self._active.add(name)

    def _value(self, line: Line) -> bool | None:
        """Returns whether a condition certainly holds, or does not; None if it is open."""
        if line.word.endswith("def"):
            answer = self._is_defined(line.condition)
            return answer if answer is None else answer is not line.word.endswith("ndef")
        return condition_holds(self._numbers(line.condition, 0))

    def _is_defined(self, name: str) -> bool | None:
        found = self.macros.get(name)
        return (
            None
            if found is None
            else any(macro.certain for macro in found)
            if not found or found[0].certain
            else None
        )

    def _numbers(self, text: str, depth: int) -> str:
        """Returns a condition with numbers for names, and `?` for what is unknown."""
        if depth > MAX_NESTED or len(text) > 2000:
            return "?"

        def number(match: re.Match[str]) -> str:
            if match[3] is None:
                answer = self._is_defined(match[1] or match[2])
                return "?" if answer is None else str(int(answer))
            name, found = match[3], self.macros.get(match[3])
            if name in ("true", "false"):
                return str(int(name == "true"))
            if found == ():
                return "0" if match[4] is None else "?"
            if (
                found is None
                or match[4] is not None
                or len(found) > 1
                or not found[0].certain
                or found[0].parameters is not None
            ):
                return "?"
            return f"({self._numbers(found[0].replacement.strip(), depth + 1)})"

        return _TESTED.sub(number, text)

    def _between(self, start: int, end: int) -> None:
        """Reads the text between two directives."""
        if self._state() is False or start >= end:
            return
        if self.structural:
            more = balance(self._bare(start, end))
            self._depth += more[0] + more[1]
            if self._groups:
                self._groups[-1].arms[-1].count(more)
        if not self._active or not self.structural:
            return
        if self._active.isdisjoint(_WORD.findall(self.text, start, end)):
            return
        position = start
        for match in _WORD.finditer(self.text, start, end):
            if (
                match[0] in self._active
                and match.start() >= position
                and not self._is_opaque(match.start())
            ):
                position = self._expand(match, end)

    def _expand(self, match: re.Match[str], stop: int) -> int:
        """Notes the expansion of a macro, and returns the end of its use."""
        expansion = Expansion(self._known, self.text, match.start(), stop)
        macro = self._known[match[0]]
        try:
            if self._budget < 0 or (
                macro.parameters is not None
                and self.text[match.end() : match.end() + 100].lstrip()[:1] != "("
            ):
                return match.end()
            tokens = expansion.expand()
        except TooLong:
            self._budget -= 10 * expansion.count
            tokens = None
        if tokens is not None:
            self._budget -= sum(len(token.text) for token in tokens)
        if self._budget < 0 and not self.unread:
            message = (
                f"the macros of the file expand to more than its own length and {BASE_LENGTH} "
                "characters; "
                f"from `{shortened(match[0])}` on, they are not expanded"
            )
            self.unread.append(Unread(message, Span(match.start(), match.end())))
        if tokens is None or self._budget < 0:
            return match.end()
        self.expansions.append((Span(match.start(), expansion.end), tokens))
        return expansion.end

    def _is_opaque(self, at: int) -> bool:
        n = bisect_right(self.opaque, (at, len(self.text))) - 1
        return n >= 0 and at < self.opaque[n][1]

    def _bare(self, start: int, end: int) -> str:
        """Returns a part of the text without comments and literals."""
        parts: list[str] = []
        n = max(bisect_right(self.opaque, (start, 0)) - 1, 0)
        while n < len(self.opaque) and self.opaque[n][0] < end:
            first, last = self.opaque[n]
            if last > start:
                parts.append(self.text[start:first])
                start = last
            n += 1
        return "".join((*parts, self.text[start:end]))

    def blanked(self) -> str:
        """Returns the text without directives and dead code that are settled; offsets stay."""
        parts: list[str] = []
        last = 0
        for start, end, new in sorted(self.edits, key=lambda edit: (edit[0], -edit[1])):
            if end > last:
                parts += (
                    self.text[last:start],
                    new if new is not None else blank(self.text[max(start, last) : end]),
                )
                last = end
        return "".join((*parts, self.text[last:]))

    def expanded(self) -> tuple[str, Places]:
        """Returns the text with its macros replaced, and its places."""
        text = self.blanked()
        parts: list[str] = []
        pieces: list[Piece] = []
        length = last = 0
        for use, tokens in self.expansions:
            if text[use.start] != self.text[use.start]:
                # It is dead.
                continue
            if use.start > last or not pieces:
                pieces.append(Piece(length, last, use.start))
            parts.append(text[last : use.start])
            length += use.start - last
            for part, piece in _placed(tokens, use, length, parts[-1][-1:]):
                parts.append(part)
                length += len(part)
                if piece is not None:
                    pieces.append(piece)
            last = use.end
        if not pieces:
            return text, Places()
        pieces.append(Piece(length, last, len(text)))
        return "".join((*parts, text[last:])), Places(tuple(pieces))


def _placed(tokens: list[Token], use: Span, at: int, before: str) -> list[tuple[str, Piece | None]]:
    """Returns the texts of tokens, each with the piece that starts there, at an offset of the
    preprocessed text.
    """
    parts: list[tuple[str, Piece | None]] = []
    for token in tokens:
        if (
            before
            and token.text
            and (before.isalnum() or before == "_")
            and (token.text[0].isalnum() or token.text[0] == "_")
        ):
            parts.append((" ", None))
            at += 1
        place = token.place
        exact = place is not None and place.end - place.start == len(token.text)
        if token.kind == "blank" and parts:
            parts.append((token.text, None))
        else:
            parts.append((token.text, Piece(at, *(place or use), *use, exact)))
        at += len(token.text)
        before = token.text[-1:]
    return parts


def preprocessed(code: Code, macros: Macros = NO_MACROS) -> tuple[Code, Places, tuple[Unread, ...]]:
    """Returns code without what is dead and with its macros replaced, its places in the file, and
    what exceeds a limit.

    `macros` are defined elsewhere; definitions of the code take precedence.
    """
    if "#" not in code.text and not macros:
        return code, Places(), ()
    reading = Preprocessed(
        code.text, code.language.endswith("cpp"), macros, fragments=code.fragments
    )
    text, places = reading.expanded()
    return code._replace(text=text), places, tuple(reading.unread)


def definitions(code: Code) -> dict[str, Definitions]:
    """Returns the macros that code leaves defined."""
    return (
        Preprocessed(code.text, code.language.endswith("cpp"), {}, structural=False).macros
        if "define" in code.text
        else {}
    )


def without_dead_code(code: Code) -> Code:
    """Returns code with what is certainly dead blanked; offsets stay."""
    if code.language not in ("c", "cpp", "objc", "objcpp") or "#" not in code.text:
        return code
    return code._replace(
        text=Preprocessed(code.text, code.language.endswith("cpp"), {}, structural=False).blanked()
    )
