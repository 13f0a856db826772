"""Inputs on object storage, and on any other file system that fsspec knows, by URL.

Only the command line names URLs. What an input states is read from the named folder, or that of the
named file, and from nowhere else. What is opened is read by ranges, as it is needed.
"""

from __future__ import annotations

import errno
import io
import os
import posixpath
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

from .extras import needs_extra

if TYPE_CHECKING:
    from collections.abc import Mapping

BLOCK = 4 << 20
"""The number of bytes that are read at a time."""

PAGE = 1000
"""The number of entries of a folder that are listed at a time."""

MIN_AGE = 60.0
"""Seconds from which on the time at which an object was last written is its version: another write
at the same time is unlikely.
"""

ABSENT = "absent"
"""The version of an object that does not exist."""

_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+.-]+)://")  # One letter is a drive of Windows.
_LOCAL = ("file", "local")
_EXTRAS = {"s3": "s3", "s3a": "s3", "gs": "gcs", "gcs": "gcs"}
_VERSIONS = ("ETag", "etag", "generation")
_TIMES = ("LastModified", "last_modified", "updated", "mtime")
_NO_CREDENTIALS = re.compile(r"Credential")
_UNREACHABLE = re.compile(r"Connect|Timeout|DNS|ServerDisconnected|SSL|ProxyError|gaierror")

_allowed: set[str] = set()
"""The folders that may be read: those that are named, and those of named objects."""

_listed: dict[str, Stated] = {}
"""What the storage stated about inputs when their folder was listed."""


_versions: dict[str, str] = {}
"""The versions that were read of what inputs state."""


class UrlError(OSError):
    """What is at a URL cannot be read: why, and what to do, on one line."""


class Stated(NamedTuple):
    """What the storage states about an object: its size in bytes (None: unknown), and its version,
    which is empty if that is unknown.
    """

    size: int | None
    version: str


class Entry(NamedTuple):
    """An object or a folder in a folder, as `os.DirEntry`."""

    name: str
    type: str
    stated: Stated

    def is_dir(self, *, follow_symlinks: bool = True) -> bool:
        """Whether it is a folder."""
        return self.type == "directory"

    def is_file(self, *, follow_symlinks: bool = True) -> bool:
        """Whether it is an object."""
        return self.type == "file"

    def is_symlink(self) -> bool:
        """Whether it is a link."""
        return False


def is_url(path: str) -> bool:
    """Whether a path is a URL, and not that of a file."""
    return "://" in path and _SCHEME.match(path) is not None and not os.path.lexists(path)


def name_of(path: str) -> str:
    """A path or URL of the command line as outputs name it: that of a `file` URL is its path, and
    no other has credentials in it.
    """
    if not is_url(path):
        return path
    scheme, rest = _parts(path)
    authority, slash, below = rest.partition("/")
    if scheme in _LOCAL:
        from urllib.parse import unquote

        # Of `file:///C:/frames`, the slash is not part of the path.
        local = (
            re.sub(r"\A/(?=[A-Za-z]:)", "", "/" + unquote(below))
            if os.name == "nt"
            else "/" + unquote(below)
        )
        return local if authority in ("", "localhost") else f"file://{rest}"
    if _has_password(rest):
        in_authority = "@" in authority
        host = (authority if in_authority else below).rpartition("@")[2]
        rest = f"{host}{slash}{below}" if in_authority else host if "@" in below else "..."
    if scheme in ("http", "https"):
        rest = re.split("[?#]", rest)[0]
    return f"{scheme}://{rest.rstrip('/')}"


def problem(url: str) -> str | None:
    """Why a URL of the command line is not read; None if it is, or is not a URL."""
    if not is_url(url):
        return None
    scheme, rest = _parts(url)
    if scheme in _LOCAL and rest.partition("/")[0] not in ("", "localhost"):
        return "a `file` URL of another machine cannot be read: name a path, as in `file:///folder`"
    if _has_password(rest):
        return (
            "a URL with credentials is not read because others can see it: set them in the "
            "environment, and write the URL without them"
        )
    if scheme in ("http", "https") and "?" in rest:
        return (
            "a URL with a query is not read because the query may be a signature: download the "
            "file, and name it"
        )
    return None


def _parts(url: str) -> tuple[str, str]:
    scheme, _, rest = url.partition("://")
    return scheme.lower(), rest


def _has_password(rest: str) -> bool:
    """Whether what follows the scheme of a URL contains a password, which may contain a slash."""
    authority, _, _ = rest.partition("/")
    user, at, host = authority.rpartition("@")
    return ":" in user or (not at and re.search(r":(?!\d*\Z)[^\]]*\Z", host) is not None)


def allow(folder: str) -> None:
    """Allows what inputs state to be read from a folder, which the user named, or in which the
    named object is.
    """
    _allowed.add(folder.rstrip("/"))


def root_of(folder: str) -> str:
    """The folder that what an input in `folder` states may be in: the outermost one that is
    allowed.
    """
    folder = folder.rstrip("/")
    return min(
        (each for each in _allowed if f"{folder}/".startswith(f"{each}/")), key=len, default=folder
    )


def inside(path: str, root: str) -> str | None:
    """The URL of a path that content states, which begins with the URL of the input's folder; None
    if it leads out of `root`. Raises OSError if it states a URL.
    """
    if root.rstrip("/") not in _allowed or path.count("://") > 1:
        raise OSError("it is a URL, not a path")
    url = normalized(path)
    below = root.rstrip("/") + "/"
    # A web server may decode what it is asked for.
    is_encoded = url.startswith("http") and re.search("[%?#]", url[len(below) :]) is not None
    return url if url.startswith(below) and not is_encoded else None


def normalized(url: str) -> str:
    """A URL whose path has no `..`."""
    scheme, rest = _parts(url.replace(os.sep, "/"))
    return f"{scheme}://{posixpath.normpath(rest)}"


def is_folder(url: str) -> bool:
    """Whether a URL is that of a folder. Raises OSError, FileNotFoundError if it is of nothing."""
    if url.startswith("http") and url.endswith("/"):
        return True
    with _errors():
        system, path = _file_system(url)
        return bool(system.info(path)["type"] == "directory")


def entries(url: str) -> list[Entry]:
    """What is in a folder, sorted by name. Raises OSError."""
    with _errors():
        system, path = _file_system(url)
        own = path.rstrip("/")
        found = []
        for info in _infos(system, path):
            name = str(info["name"]).rstrip("/")
            # An empty object stands for the folder itself, as some tools create them.
            if name != own and not name.endswith("/"):
                found.append(Entry(name.rpartition("/")[2], info["type"], _stated(info)))
        return sorted(found)


def _infos(system: Any, path: str) -> Iterator[Mapping[str, Any]]:
    """What a storage states about the entries of a folder: page by page, if it is one with millions
    of them.
    """
    if not type(system).__module__.startswith("s3fs."):
        yield from system.ls(path, detail=True)
        return
    from fsspec.asyn import sync
    from s3fs.errors import translate_boto_error

    bucket, key, _ = system.split_path(path)
    listing = system._iterdir(bucket, prefix=key.rstrip("/") + "/" if key else "")

    async def page() -> list[Mapping[str, Any]]:
        found = []
        try:
            async for info in listing:
                found.append(info)
                if len(found) == PAGE:
                    break
        except Exception as error:
            raise translate_boto_error(error) from None
        return found

    while infos := sync(system.loop, page):
        yield from infos


def list_input(url: str, stated: Stated) -> None:
    """Keeps what the storage stated about an input of a folder, for `length` and `version`."""
    _listed[url] = stated


def unlist(url: str) -> None:
    """Forgets a listed object, which is not an input."""
    _listed.pop(url, None)


def forget_listed() -> None:
    """Forgets what earlier runs listed and read."""
    _listed.clear()
    _versions.clear()


def length(url: str) -> int:
    """The number of bytes of a listed input; 0 if that is unknown."""
    stated = _listed.get(url)
    return stated.size or 0 if stated is not None else 0


def version(url: str, is_fresh: bool = False) -> str:
    """What the storage states as the version of an object: ABSENT if there is none, empty if it
    states none. That of a listed input is as of its listing, unless `is_fresh` asks again.
    """
    if not is_fresh and url in _listed:
        return _listed[url].version
    try:
        with _errors():
            system, path = _file_system(url)
            return _stated(system.info(path)).version
    except FileNotFoundError:
        return ABSENT
    except OSError:
        return ""


def keep_version(url: str, version: str) -> None:
    """Keeps the version of an object that is read, unless that is a listed input, for other inputs
    that state it.
    """
    if url not in _listed:
        _versions[url] = version


def version_read(url: str) -> str | None:
    """The version that was read of what an input states; None if it was not."""
    return _versions.get(url)


def open_object(url: str, entry: Entry | None = None) -> tuple[BinaryIO, Stated]:
    """An object, open for reading, and what the storage states about it, which `entry` saves
    asking. Raises OSError.
    """
    with _errors():
        system, path = _file_system(url)
        if entry is None:
            info = system.info(path)
            if info["type"] != "file":
                raise IsADirectoryError(errno.EISDIR, "it is a folder, not a file")
            stated = _stated(info)
        else:
            stated = entry.stated
        if stated.size is None:
            return io.BufferedReader(_Stream(system.open(path, "rb"))), stated
    return io.BufferedReader(
        _Object(system, path, stated.size), min(stated.size + 1, BLOCK)
    ), stated


def open_listed(url: str) -> BinaryIO:
    """An object that `entries` listed, open for reading. Raises OSError."""
    stated = _listed.get(url)
    return open_object(url, Entry(url, "file", stated) if stated is not None else None)[0]


def _stated(info: Mapping[str, Any]) -> Stated:
    size = info.get("size")
    version = next((f"{info[key]} {size}" for key in _VERSIONS if info.get(key)), "")
    written = next((info[key] for key in _TIMES if info.get(key)), None)
    if not version and written is not None:
        seconds = (
            written
            if isinstance(written, (int, float))
            else written.timestamp()
            if hasattr(written, "timestamp")
            else None
        )
        version = (
            f"{seconds} {size}" if seconds is not None and time.time() - seconds > MIN_AGE else ""
        )
    return Stated(size if isinstance(size, int) else None, version)


def _file_system(url: str) -> tuple[Any, str]:
    """The file system of a URL, and the path in it. Each process has its own connections."""
    scheme, _ = _parts(url)
    try:
        from fsspec import get_filesystem_class
    except ImportError:
        raise UrlError(needs_extra("reading URLs", "corpus")) from None
    try:
        kind: Any = get_filesystem_class(scheme)
    except ImportError as error:
        raise UrlError(
            needs_extra(f"reading `{scheme}://`", _EXTRAS[scheme])
            if scheme in _EXTRAS
            else _first_line(error)
        ) from None
    except ValueError:
        raise UrlError(f"unknown protocol `{scheme}`: fsspec has no file system for it") from None
    # Unlike fsspec's own function, this gives `::` no meaning, which an object's name may contain.
    system = kind(**kind._get_kwargs_from_urls(url))
    system.dircache.use_listings_cache = False
    return system, kind._strip_protocol(url)


@contextmanager
def _errors() -> Iterator[None]:
    """Raises what a file system raises as OSError with a text on one line that says what to do."""
    try:
        yield
    except (UrlError, IsADirectoryError):
        raise
    except Exception as error:
        if isinstance(error, FileNotFoundError):
            # A file system may say so of anything that goes wrong.
            cause = error.__cause__
            if not isinstance(cause, Exception) or not (
                _is_unreachable(cause) or getattr(cause, "status", 404) != 404
            ):
                raise FileNotFoundError(errno.ENOENT, "no such file or folder") from None
            error = cause
        raise UrlError(_reason(error)) from None


def _is_unreachable(error: Exception) -> bool:
    return _UNREACHABLE.search(_kinds(error)) is not None


def _kinds(error: Exception) -> str:
    return " ".join(kind.__name__ for kind in type(error).__mro__)


def _reason(error: Exception) -> str:
    kinds = _kinds(error)
    if isinstance(error, PermissionError) or getattr(error, "status", None) in (401, 403):
        return (
            f"access denied ({_first_line(error)}): check the credentials in the environment, "
            "and what they may read"
        )
    if _NO_CREDENTIALS.search(kinds):
        return (
            "no credentials: set those of the storage in the environment, for S3 AWS_PROFILE, "
            "or AWS_ACCESS_KEY_ID and its secret"
        )
    if _is_unreachable(error):
        return f"the storage cannot be reached: {_first_line(error)}"
    return f"the storage reports {type(error).__name__}: {_first_line(error)}"


def _first_line(error: Exception) -> str:
    text = (getattr(error, "strerror", None) or str(error) or type(error).__name__).strip()
    return text.splitlines()[0][:200]


class _Object(io.RawIOBase):
    """An object of known size, which is read by ranges."""

    def __init__(self, system: Any, path: str, size: int) -> None:
        self._system = system
        self._path = path
        self._size = size
        self._at = 0

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        self._at = max(offset + (0, self._at, self._size)[whence], 0)
        return self._at

    def tell(self) -> int:
        return self._at

    def readinto(self, buffer: object) -> int:
        view = memoryview(buffer).cast("B")  # type: ignore[arg-type]
        start, end = self._at, min(self._at + min(len(view), BLOCK), self._size)
        if start >= end:
            return 0
        with _errors():
            data = self._system.cat_file(self._path, start=start, end=end)
            if len(data) > end - start:
                # A web server without ranges sends everything.
                data = data[start:end]
        view[: len(data)] = data
        self._at += len(data)
        return len(data)


class _Stream(io.RawIOBase):
    """An object of unknown size."""

    def __init__(self, file: Any) -> None:
        self._file = file

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: object) -> int:
        view = memoryview(buffer).cast("B")  # type: ignore[arg-type]
        with _errors():
            data = self._file.read(len(view))
        view[: len(data)] = data
        return len(data)

    def close(self) -> None:
        self._file.close()
        super().close()
