"""Changes that make an input worse: of its bytes, tokens, brackets, lines and values, chosen by a
random number generator.

`Mutator.mutated` is the only function that others need. It knows no format; what it inserts comes
from `EXTREMES`, from `SNIPPETS` of the format's language, and from other inputs of the same kind: a
value that a key has there, too, is often valid.
"""

from __future__ import annotations

import json
import random
import re
from collections.abc import Callable, Sequence
from typing import Any

import yaml

from .snippets import EXTREMES, NUMBERS, SNIPPETS, WORDS

MAX_BYTES = 400_000
"""What grows beyond this is cut, so that a run spends its time on many inputs."""

_TOKEN = re.compile(r"[\w.+-]+|[^\w\s]|\n|[^\S\n]+")
_NUMBER = re.compile(r"-?\b\d[\w.]*")
_STRING = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'")
_VALUE = re.compile(r"(?<=[:=] )[^\s][^\n,}\]]*|(?<=- )[^\s][^\n]*|(?<=\":)[^,}\]\n]+")
_KEY = re.compile(r"[A-Za-z_][\w-]*(?=\"?\s?[:=])")
_PAIRS = {"(": ")", "[": "]", "{": "}"}
_GROUP = re.compile(r"[\[({]")


class Mutator:
    """Mutates inputs of one kind. `languages` are keys of `SNIPPETS`; `tree` is `json`, `jsonl`, or
    `yaml` if they are trees of values.
    """

    def __init__(
        self,
        generator: random.Random,
        languages: Sequence[str],
        tree: str = "",
        seeds: Sequence[bytes] = (),
    ) -> None:
        self.random = generator
        self.snippets = [text for language in languages for text in SNIPPETS[language]]
        self.tree = tree
        self.binary = "binary" in languages
        self.values: dict[str, list[Any]] = {}
        for seed in seeds if tree else ():
            for root in _roots(seed, tree):
                self._learn(root)

    def _learn(self, value: Any) -> None:
        """Collects the values of each key of a tree."""
        for key, item in (
            value.items()
            if isinstance(value, dict)
            else enumerate(value)
            if isinstance(value, list)
            else ()
        ):
            if (
                isinstance(key, str)
                and len(known := self.values.setdefault(key, [])) < 60
                and item not in known
            ):
                known.append(item)
            self._learn(item)

    def mutated(self, data: bytes, other: bytes) -> bytes:
        """The data after one to five changes; `other` is an input of the same kind to take parts
        of.
        """
        changes = self.random.choices((1, 2, 3, 5), (8, 4, 2, 1))[0]
        if self.tree and self.random.random() < 0.45:
            data = self._tree(data, changes)
            changes = self.random.random() < 0.2
        for _ in range(changes):
            if self.binary and self.random.random() < 0.8:
                data = self._bytes(data, other)
                continue
            text = data.decode("utf-8", "surrogateescape")
            change = self.random.choice(_CHANGES)
            data = change(self, text, other.decode("utf-8", "surrogateescape")).encode(
                "utf-8", "surrogatepass"
            )[:MAX_BYTES]
        if self.random.random() < 0.06:
            data = self._encoded(data)
        return data

    def value(self) -> str:
        """Text to put in place of a value."""
        kind = self.random.random()
        if kind < 0.35 or not self.snippets:
            return self.random.choice(NUMBERS)
        return self.random.choice(WORDS) if kind < 0.55 else self.random.choice(self.snippets)

    def _match(self, pattern: re.Pattern[str], text: str) -> re.Match[str] | None:
        """A match of the pattern near a random place."""
        start = self.random.randrange(len(text) + 1)
        return pattern.search(text, start) or pattern.search(text)

    def _replace(self, pattern: re.Pattern[str], text: str, words: Callable[[str], str]) -> str:
        match = self._match(pattern, text)
        return (
            text if match is None else text[: match.start()] + words(match[0]) + text[match.end() :]
        )

    def _number(self, text: str, other: str) -> str:
        return self._replace(_NUMBER, text, lambda _: self.random.choice(NUMBERS))

    def _string(self, text: str, other: str) -> str:
        return self._replace(
            _STRING, text, lambda old: old[0] + self.random.choice(WORDS) + old[-1]
        )

    def _written_value(self, text: str, other: str) -> str:
        return self._replace(_VALUE, text, lambda _: self.value())

    def _key(self, text: str, other: str) -> str:
        keys = _KEY.findall(other[:20_000]) or [""]
        return self._replace(
            _KEY,
            text,
            lambda old: self.random.choice(
                [*keys[:200], self.random.choice(WORDS), old[:-1], old.upper(), old + "s"]
            ),
        )

    def _token(self, text: str, other: str) -> str:
        words = _TOKEN.findall(other[:20_000]) or [""]
        choices: list[Callable[[str], str]] = [
            lambda old: "",
            lambda old: old * 2,
            lambda old: self.random.choice(words),
            lambda old: self.value(),
            lambda old: old + self.value(),
            lambda old: old[: len(old) // 2],
        ]
        return self._replace(_TOKEN, text, self.random.choice(choices))

    def _group(self, text: str, other: str) -> str:
        """Deletes, empties, repeats, cuts, or replaces what a pair of brackets encloses."""
        match = self._match(_GROUP, text)
        if match is None:
            return text
        start = match.start()
        end = _closing(text, start)
        inner = text[start + 1 : end]
        parts = inner.split(",")
        index = self.random.randrange(len(parts))
        choices = (
            "",
            text[start] + text[end : end + 1],
            text[start : end + 1] * 2,
            text[start] + ",".join(parts[:index] + parts[index + 1 :]) + text[end : end + 1],
            text[start]
            + ",".join([*parts[:index], parts[index], *parts[index:]])
            + text[end : end + 1],
            text[start]
            + ",".join([*parts[:index], self.value(), *parts[index + 1 :]])
            + text[end : end + 1],
            text[start] + ",".join(reversed(parts)) + text[end : end + 1],
            self.value(),
            text[start] + text[start : end + 1] + text[end : end + 1],
        )
        return text[:start] + self.random.choice(choices) + text[end + 1 :]

    def _lines(self, text: str, other: str) -> str:
        lines = text.splitlines(keepends=True) or [""]
        start = self.random.randrange(len(lines))
        end = min(len(lines), start + self.random.choice((1, 1, 1, 2, 5, 20)))
        block = lines[start:end]
        kind = self.random.randrange(7)
        if kind == 0:
            lines[start:end] = []
        elif kind == 1:
            lines[start:end] = block * 2
        elif kind == 2:
            lines[start:end] = block * self.random.choice((10, 100, 1000))
        elif kind == 3:
            lines[start:end] = []
            at = self.random.randrange(len(lines) + 1)
            lines[at:at] = block
        elif kind == 4:
            theirs = other.splitlines(keepends=True) or [""]
            at = self.random.randrange(len(theirs))
            lines[start:end] = theirs[at : at + self.random.choice((1, 2, 5, 50))]
        elif kind == 5:
            lines[start:end] = [
                self.random.choice((" ", "  ", "    ", "\t")) + line for line in block
            ]
        else:
            lines[start:end] = [line.lstrip() for line in block]
        return "".join(lines)

    def _insertion(self, text: str, other: str) -> str:
        at = self.random.randrange(len(text) + 1)
        return text[:at] + self.value() + text[at:]

    def _splice(self, text: str, other: str) -> str:
        return (
            text[: self.random.randrange(len(text) + 1)]
            + other[self.random.randrange(len(other) + 1) :]
        )

    def _cut(self, text: str, other: str) -> str:
        return text[: self.random.randrange(len(text) + 1)]

    def _swap(self, text: str, other: str) -> str:
        first, second = self._match(_TOKEN, text), self._match(_TOKEN, text)
        if first is None or second is None or first.end() > second.start():
            return text
        return (
            text[: first.start()]
            + second[0]
            + text[first.end() : second.start()]
            + first[0]
            + text[second.end() :]
        )

    def _bytes(self, data: bytes, other: bytes) -> bytes:
        """Changes bits, bytes, and 32-bit words; deletes, repeats and splices parts."""
        changed = bytearray(data)
        at = self.random.randrange(len(changed) + 1)
        length = self.random.choice((1, 1, 4, 4, 16, 200))
        kind = self.random.randrange(8)
        if kind == 0 and at < len(changed):
            changed[at] ^= 1 << self.random.randrange(8)
        elif kind == 1:
            at &= ~3
            word = self.random.choice(
                (
                    0,
                    1,
                    2,
                    3,
                    0xFF,
                    0xFFFF,
                    0x7FFFFFFF,
                    0x80000000,
                    0xFFFFFFFF,
                    self.random.randrange(64),
                    self.random.randrange(2**16),
                )
            )
            changed[at : at + 4] = word.to_bytes(4, "little")
        elif kind == 2:
            del changed[at : at + length]
        elif kind == 3:
            changed[at:at] = changed[at : at + length] * self.random.choice((1, 2, 1000))
        elif kind == 4:
            start = self.random.randrange(len(other) + 1)
            changed[at : at + length] = other[start : start + length]
        elif kind == 5:
            start = self.random.randrange(len(changed) + 1) & ~3
            changed[at & ~3 : (at & ~3) + 4] = changed[start : start + 4]
        elif kind == 6:
            del changed[at:]
        else:
            changed[at:at] = self.random.randbytes(length)
        return bytes(changed[:MAX_BYTES])

    def _encoded(self, data: bytes) -> bytes:
        """The data in another encoding, or in none."""
        kind = self.random.randrange(8)
        if kind == 0:
            return data.replace(
                b"\n", self.random.choice((b"\r\n", b"\r", b"\n\r", b"\xc2\x85", b"\xe2\x80\xa8"))
            )
        if kind == 1:
            return b"\xef\xbb\xbf" + data
        if kind < 5:
            encoding = ("utf-16", "utf-16-be", "utf-32")[kind - 2]
            return data.decode("utf-8", "replace").encode(encoding, "replace")
        at = self.random.randrange(len(data) + 1)
        return (
            data[:at]
            + self.random.choice(
                (b"\xff", b"\xc3", b"\xed\xa0\x80", b"\xf4\x90\x80\x80", b"\0", b"\xc0\x80")
            )
            + data[at:]
        )

    def _tree(self, data: bytes, changes: int) -> bytes:
        """The data with values of its tree replaced, moved, or repeated; the data itself if it is
        not a tree.
        """
        if self.tree == "jsonl":
            lines = data.splitlines()
            if not lines:
                return data
            at = self.random.randrange(len(lines))
            lines[at] = self._json(lines[at], changes)
            return b"\n".join(lines)
        if self.tree == "json":
            return self._json(data, changes)
        roots = [self._changed(root, changes) for root in _roots(data, "yaml")]
        if not roots:
            return data
        if self.random.random() < 0.3:
            return "\n---\n".join(json.dumps(root, default=str) for root in roots).encode()
        return yaml.dump_all(roots, Dumper=yaml.CSafeDumper, sort_keys=False).encode(
            "utf-8", "surrogatepass"
        )

    def _json(self, data: bytes, changes: int) -> bytes:
        ascii_only = self.random.random() < 0.5
        for root in _roots(data, "json"):
            return json.dumps(self._changed(root, changes), ensure_ascii=ascii_only).encode(
                "utf-8", "surrogatepass"
            )
        return data

    def _changed(self, root: Any, changes: int) -> Any:
        holder = [root]
        for _ in range(changes):
            container, key = self._place(holder)
            _, theirs = spot = self._place(holder)
            value = container[key]
            kind = self.random.randrange(13)
            if kind > 8 and isinstance(key, str) and key in self.values:
                container[key] = _copied(self.random.choice(self.values[key]))
            elif kind < 3:
                container[key] = self.random.choice(EXTREMES)
            elif kind == 3:
                container[key] = [value]
            elif kind == 4 and isinstance(container, dict):
                del container[key]
                container[
                    self.random.choice(
                        (*map(str, WORDS[:8]), str(theirs), str(key).upper(), f"{key}s")
                    )
                ] = value
            elif kind == 5 and container is not holder:
                del container[key]
            elif kind == 6 and isinstance(value, list):
                value.extend(value[:50] * self.random.choice((1, 2, 20)))
            elif kind == 7:
                container[key] = _copied(spot[0][theirs])
            else:
                container[key] = {str(theirs): value}
        return holder[0]

    def _place(self, holder: list[Any]) -> tuple[Any, Any]:
        """A random place in a tree: a container, and a key or index. Deeper places are as likely as
        those at the top.
        """
        container: Any = holder
        key: Any = 0
        while True:
            value = container[key]
            if (
                not isinstance(value, dict | list)
                or not value
                or self.random.random() < 0.15 * (container is not holder)
            ):
                return container, key
            container, key = (
                value,
                self.random.choice(list(value) if isinstance(value, dict) else range(len(value))),
            )


def _roots(data: bytes, tree: str) -> list[Any]:
    """The trees of an input; none if it is not valid."""
    try:
        if tree == "yaml":
            return list(yaml.load_all(data, yaml.CSafeLoader))
        return [json.loads(line) for line in (data.splitlines() if tree == "jsonl" else [data])]
    except (yaml.YAMLError, ValueError, UnicodeError, RecursionError, TypeError):
        return []


def _copied(value: Any) -> Any:
    return json.loads(json.dumps(value, default=str, skipkeys=True))


def _closing(text: str, start: int) -> int:
    """The index of the bracket that closes the one at `start`; of the text's end if none does."""
    opening, closing = text[start], _PAIRS[text[start]]
    depth = 0
    for index in range(start, min(len(text), start + 20_000)):
        if text[index] == opening:
            depth += 1
        elif text[index] == closing:
            depth -= 1
            if depth == 0:
                return index
    return len(text)


_CHANGES = (
    Mutator._number,
    Mutator._string,
    Mutator._written_value,
    Mutator._written_value,
    Mutator._key,
    Mutator._token,
    Mutator._token,
    Mutator._group,
    Mutator._group,
    Mutator._lines,
    Mutator._lines,
    Mutator._insertion,
    Mutator._splice,
    Mutator._cut,
    Mutator._swap,
)
