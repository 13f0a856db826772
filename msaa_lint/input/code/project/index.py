"""What the words of a source file say about the other files of its project: what it includes, what
it declares, whether it is a program.

Files are searched by words, without being parsed, so that the files of a large project take little
time.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.project import shown
from msaa_lint.core.text.files import file_state, is_settled, open_entry, open_file
from msaa_lint.input.code import mentions
from msaa_lint.input.code.languages import unread
from msaa_lint.input.file_types import HEAD_BYTES

if TYPE_CHECKING:
    from msaa_lint.core.cache import Cache

MAX_BYTES = (4 << 20) + 1
"""The number of bytes of a file that are searched; a source file of that length is too long to be
read.
"""

MIN_KEPT = 50
"""The number of files of a run whose words are not kept in a cache."""

HEADERS = (".h", ".hpp", ".hh", ".hxx", ".h++", ".inl", ".ipp", ".tpp", ".inc")
"""The endings of files that sources include."""

SOURCES = (".cpp", ".c", ".cc", ".cxx", ".mm", ".m")
"""The endings of files that define what headers declare."""

_INCLUDE = re.compile(
    rb'^[ \t]*#[ \t]*(?:include|import)[ \t]*[<"]([^>"\r\n]{1,400})[>"]', re.MULTILINE
)

_RUST_MODULE = re.compile(
    rb"^[ \t]*(?:pub(?:\([a-z ]{1,20}\))?[ \t]+)?(?:mod[ \t]+(\w+)[ \t]*;|use[ "
    rb"\t]+(\w+(?:::\w+){1,12}))",
    re.MULTILINE,
)
"""A module of Rust that a file declares or uses."""

_MAIN = re.compile(
    rb"^[ \t]*(?:extern[ \t]+\"C\"[ "
    rb"\t]+)?(?:(?:int|auto|sapp_desc|SDL_AppResult)\s+(?:[A-Z_a-z]\w*[ \t]+){0,2}"
    rb"(?:_?main_?|w?WinMain|_tmain|wmain|SDL_main|SDL_AppInit|sokol_main)|void\s+android_main)[ "
    rb"\t]*\((?![^()]{0,400}\)[ \t]*;)"
    rb"|^[A-Z][A-Z0-9_]*_MAIN[A-Z_]*[ \t]*\("
    rb"|^(?:pub[ \t]+)?(?:async[ \t]+)?fn[ \t]+main[ "
    rb"\t]*\(|^@(?:main|UIApplicationMain|NSApplicationMain)\b",
    re.MULTILINE,
)
"""Where a program starts, also by the macro of a framework."""

_MAINS = (b"main", b"Main", b"MAIN", b"SDL_AppInit")
"""What files have in which a program starts: to search for it takes far less time."""

_CLASS = re.compile(
    rb"\b(?:class|struct|@interface|@implementation)[ \t]+(?:[A-Z_0-9]+[ \t]+)?([A-Za-z_]\w*)(?=[ "
    rb"\t]*(?:final\b|:|\{|\r?$))",
    re.MULTILINE,
)
_FUNCTION = re.compile(
    rb"^[A-Za-z_][\w \t*&:<>,]{0,200}?[ \t*&]([A-Za-z_]\w*)(?:::~?\w+)?[ \t]*\(", re.MULTILINE
)
"""A function that is declared or defined at the left margin; of a method, its class."""


class Words(NamedTuple):
    """The words of a file, and its length in bytes.

    `names` are the classes and functions that it declares or defines; `is_related` says whether it
    can matter to files that use multisampling, `has_api`, `has_multisampling`, and `speaks` what it
    mentions itself.
    """

    length: int
    includes: tuple[str, ...]
    names: frozenset[str]
    has_main: bool
    is_related: bool
    has_api: bool
    has_multisampling: bool
    speaks: bool


def words(data: bytes) -> Words:
    """Returns the words of a file, in time linear in its length."""
    length = len(data)
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        data = data.decode("utf-16", "replace").encode()
    includes = dict.fromkeys(
        name.decode("utf-8", "replace").replace("\\", "/") for name in _INCLUDE.findall(data)
    )
    if b"fn " in data:
        includes.update(dict.fromkeys(_modules(data)))
    has_main = any(word in data for word in _MAINS) and _MAIN.search(data) is not None
    text = data.decode("latin-1")
    if not mentions.is_related(text):
        return Words(length, tuple(includes), frozenset(), has_main, False, False, False, False)
    names = {name.decode() for pattern in (_CLASS, _FUNCTION) for name in pattern.findall(data)}
    text = text[: mentions.MAX_BYTES]
    has_api = mentions.may_have_findings(text)
    speaks = has_api and mentions.speaks(text)
    multisampled = speaks or mentions.mentions_multisampling(text)
    return Words(
        length, tuple(includes), frozenset(names), has_main, True, has_api, multisampled, speaks
    )


def _modules(data: bytes) -> Iterator[str]:
    """Yields the files that the modules of Rust may be in that a file declares or uses."""
    for match in _RUST_MODULE.finditer(data):
        parts = (match[1] or match[2]).decode().split("::")
        parts = parts[1:] if parts[0] in ("crate", "super", "self") else parts
        for end in range(1, len(parts) + 1):
            yield from ("/".join(parts[:end]) + ".rs", "/".join(parts[:end]) + "/mod.rs")


class Index:
    """The words of the files of a run. With a cache, files that are as they were in an earlier run
    are not read again, apart from the first `MIN_KEPT`: a few files take less time than what they
    were kept in. `cache` opens it, when it is needed, and `name` is that of the run.
    """

    def __init__(self, name: str, cache: Callable[[], Cache | None]) -> None:
        self.name = name
        self.by_path: dict[str, Words] = {}
        self._open = cache
        self._start = time.time_ns()
        self._used = _Kept({}, {})
        self._contents: dict[str, str] = {}

    @cached_property
    def _cache(self) -> Cache | None:
        return self._open()

    @cached_property
    def _known(self) -> _Kept:
        """What an earlier run kept."""
        data = self._cache.read("words", self.name) if self._cache is not None else None
        if data is None:
            return _Kept({}, {})
        import orjson

        try:
            return _Kept(*orjson.loads(data))
        except (TypeError, ValueError):
            return _Kept({}, {})

    def close(self) -> None:
        """Keeps the words of the files of this run."""
        if self._used.files and self._cache is not None and self._used != self._known:
            import orjson

            self._cache.write("words", self.name, orjson.dumps(list(self._used)))

    def length(self, path: str) -> int:
        """The number of bytes of a file whose words are known, or 0."""
        return self.by_path[path].length if path in self.by_path else 0

    def content(self, path: str, project: str | None) -> str | None:
        """A name for the content of a file; None if it cannot be read."""
        if path not in self._contents:
            from msaa_lint.core.cache import digest

            data = _content(path, project)
            if data is None:
                return None
            self._contents[path] = digest(data)
        return self._contents[path]

    def of_entry(self, path: str) -> Words:
        """The words of a regular file, according to the listing of its folder. Raises OSError if it
        cannot be read.
        """
        known = self._unchanged(path)
        if known is not None:
            return known
        with open_entry(path) as file:
            status = os.fstat(file.fileno())
            # Python allocates as much memory as it is asked to read.
            return self._add(shown(path), file.read(min(status.st_size, MAX_BYTES)), status)

    def of(self, path: str, project: str | None) -> Words | None:
        """The words of a file; None if it cannot be read. A pipe is not read twice."""
        if path not in self.by_path:
            data = _content(path, project)
            if data is not None:
                self._add(path, data)
        return self.by_path.get(path)

    def _unchanged(self, path: str) -> Words | None:
        """The words of a file that has not been written since an earlier run."""
        if len(self.by_path) < MIN_KEPT or os.name != "posix" or self._cache is None:
            return None
        name = shown(path)
        known = self._known.files.get(name)
        if known is None or known[1:] != file_state(os.lstat(path)):
            return None
        members = self._known.words.get(known[0])
        found = _words(members) if members is not None else None
        if found is not None and members is not None:
            self._contents[name] = known[0]
            self._used.files[name] = known
            self._used.words[known[0]] = members
            self.by_path[name] = found
        return found

    def _add(self, path: str, data: bytes, status: os.stat_result | None = None) -> Words:
        if unread(path, data[:HEAD_BYTES].decode("latin-1")) is not None:
            found = Words(len(data), (), frozenset(), False, False, False, False, False)
        elif len(self.by_path) < MIN_KEPT or self._cache is None:
            found = words(data)
        else:
            found = self._kept(path, data, status)
        self.by_path[path] = found
        return found

    def _kept(self, path: str, data: bytes, status: os.stat_result | None) -> Words:
        """The words of a file, from the cache if it has them."""
        from msaa_lint.core.cache import digest

        key = self._contents[path] = digest(data)
        members = self._known.words.get(key)
        found = _words(members) if members is not None else None
        if found is None or members is None:
            found = words(data)
            members = [found.length, list(found.includes), sorted(found.names), *found[3:]]
        self._used.words[key] = members
        if status is not None and is_settled(file_state(status), self._start):
            self._used.files[path] = [key, *file_state(status)]
        return found


class _Kept(NamedTuple):
    """What is kept of files between runs: by path, a name for the content and the state, and by
    these names, the members of the words.
    """

    files: dict[str, list[Any]]
    words: dict[str, list[Any]]


def _words(members: Sequence[Any]) -> Words | None:
    """The words that have some members."""
    try:
        return Words(members[0], tuple(members[1]), frozenset(members[2]), *members[3:])
    except (TypeError, IndexError):
        return None


def _content(path: str, project: str | None) -> bytes | None:
    """The bytes of a file; None if it cannot be read."""
    try:
        file, size = open_file(path, project)
        with file:
            return file.read(min(size, MAX_BYTES)) if size is not None else None
    except OSError:
        return None


def is_header(name: str) -> bool:
    """Returns whether a file is one that sources include, by its name."""
    return name.lower().endswith(HEADERS)
