"""`msaa-lint check --watch`: checks again when an input, the configuration, or a rule page
changes.
"""

from __future__ import annotations

import gc
import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from msaa_lint.core.extras import needs_extra
from msaa_lint.core.globs import excluding
from msaa_lint.core.project import NAMES
from msaa_lint.core.quote import quoted
from msaa_lint.core.urls import is_url, name_of
from msaa_lint.frame.devices.paths import is_path, split
from msaa_lint.input.file_types import CAPTURES, DATA, PAGE_ENDINGS, SOURCES, STDIN
from msaa_lint.input.folder_search import SKIPPED_FOLDERS
from msaa_lint.linter.request import Request
from msaa_lint.linter.settings.config import Configurations
from msaa_lint.linter.settings.settings import override

from .common import UsageError, note
from .options import Arguments

FORMATS = ("full", "concise")
"""The outputs that a screen shows."""

DEBOUNCE = 300
"""Milliseconds in which changes count as one: editors and checkouts write several files at once."""

STEP = 50
"""Milliseconds without a change after which those so far are acted on."""

POLL = 100
"""Milliseconds after which waiting for changes returns without any. The first wait only starts
watching.
"""

_CLEAR = "\x1b[2J\x1b[3J\x1b[H"
"""Clears the screen and what has scrolled out of it, as ruff does."""

_ENDINGS = (*DATA, *CAPTURES, *SOURCES, *PAGE_ENDINGS, ".spv")
_NAMES = frozenset({".gitignore", ".ignore", *NAMES})


def watch(arguments: Arguments, request: Request, check: Callable[[Arguments], int]) -> int:
    """Calls `check` now and after each change, on a terminal with a cleared screen, until an
    interrupt ends it.

    UsageError for options that do not go with it, without the extra `watch`, and if the inputs
    cannot be watched.
    """
    _refuse_options(arguments)
    try:
        from watchfiles import watch as changes_in
    except ModuleNotFoundError as error:
        if error.name != "watchfiles":
            raise
        raise UsageError(needs_extra("`--watch`", "watch")) from None
    # Not the output of a configuration, which may be for a program.
    arguments = {"output": ["full" if sys.stdout.isatty() else "concise"], **arguments}
    while True:
        watched = Watched(request)
        # Watching starts before the check, so that no change is missed, and again after each
        # change: a file that an editor replaces is a new one.
        watches = [
            changes_in(
                *paths,
                watch_filter=None,
                debounce=DEBOUNCE,
                step=STEP,
                rust_timeout=POLL,
                yield_on_timeout=True,
                ignore_permission_denied=True,
                recursive=is_recursive,
            )
            for paths, is_recursive in ((watched.folders(), True), (watched.files(), False))
            if paths
        ]
        with _watch_errors():
            for changes in watches:
                next(changes)
        _show(arguments, check)
        with _watch_errors():
            next(
                each
                for both in zip(*watches, strict=True)
                for each in both
                if any(watched.concerns(path) for _, path in each)
            )
        for changes in watches:
            changes.close()


def _refuse_options(arguments: Arguments) -> None:
    if STDIN in arguments["paths"]:
        raise UsageError("`--watch` cannot watch standard input; name files or folders")
    for name in ("fix", "diff"):
        if arguments.get(name):
            raise UsageError(
                f"`--watch` changes no files; leave out `--{name}`, or run it once without "
                "`--watch`"
            )
    for output in arguments.get("output", ()):
        if output not in FORMATS:
            raise UsageError(
                f"`--watch` shows {' or '.join(FORMATS)} output on the screen, not "
                f"{quoted(output)}; write it without `--watch`"
            )
    if len(arguments.get("output", ())) > 1:
        raise UsageError(
            f"`--watch` shows one output; write `--output {FORMATS[0]}` or `--output {FORMATS[1]}`"
        )


def _show(arguments: Arguments, check: Callable[[Arguments], int]) -> None:
    """Checks once, and says that changes are waited for."""
    if sys.stdout.isatty():
        print(_CLEAR, end="", flush=True)
    check(arguments)
    sys.stdout.flush()
    note(f"{time.strftime('%H:%M:%S')}: watching for changes; Ctrl-C ends")
    # The command line turns the collector off, which only a short run may.
    gc.collect()


@contextmanager
def _watch_errors() -> Iterator[None]:
    """UsageError for an error of the operating system, such as its limit of watched folders."""
    try:
        yield
    except (OSError, RuntimeError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise UsageError(f"cannot watch the inputs: {reason}") from None


class Watched:
    """What a run of `check` reads, apart from what folders contain: all paths are absolute, with
    links resolved.
    """

    def __init__(self, request: Request) -> None:
        self._configurations = Configurations(request.config, request.isolated)
        self._folders = [os.path.realpath(path) for path in request.paths if os.path.isdir(path)]
        self._files = {os.path.realpath(path) for path in request.paths if not os.path.isdir(path)}
        if request.config is not None:
            self._files.add(os.path.realpath(request.config))
        for path in request.paths:
            if is_url(path):
                raise UsageError(
                    f"cannot watch {name_of(path)}: a storage does not say what changes; check it "
                    "without --watch"
                )
        for path in [os.curdir, *request.paths]:
            loaded = self._configurations.load(path)
            settings = override(loaded.settings, **request.overrides)
            configurations = self._configurations.candidates(path)
            named = [
                *loaded.sources,
                *configurations,
                *settings.rules,
                settings.baseline,
                _report(settings.profile),
            ]
            for each in map(os.path.realpath, filter(None, named)):
                if os.path.isdir(each):
                    self._folders.append(each)
                else:
                    self._files.add(each)

    def folders(self) -> list[str]:
        """The folders to watch with all that is in them."""
        return list(dict.fromkeys(self._folders))

    def files(self) -> list[str]:
        """The files to watch, and the folders of those that do not exist yet, without the folders
        in them.
        """
        found: dict[str, None] = {}
        for path in sorted(self._files):
            there = path if os.path.exists(path) else os.path.dirname(path)
            if not os.path.exists(there):
                raise UsageError(f"cannot watch {path}: its folder does not exist")
            found[there] = None
        return list(found)

    def concerns(self, path: str) -> bool:
        """Whether a changed file may change the result."""
        if path in self._files:
            return True
        folders = [folder for folder in self._folders if path.startswith(os.path.join(folder, ""))]
        return any(self._is_read(folder, path) for folder in folders)

    def _is_read(self, folder: str, path: str) -> bool:
        """Whether `check` may read a file of a folder, or a folder appeared or disappeared."""
        *parents, name = os.path.relpath(path, folder).split(os.sep)
        hidden = [
            part for part in (*parents, name) if part.startswith(".") or part in SKIPPED_FOLDERS
        ]
        if hidden:
            return hidden == [name] and name in _NAMES
        if name in _NAMES or name.lower().endswith(_ENDINGS) or os.path.isdir(path):
            return True
        return excluding(path, self._configurations.load(path).settings.include) is not None


def _report(profile: str | None) -> str | None:
    """The path of the device report that a profile names."""
    return split(profile)[0] if profile is not None and is_path(profile) else None
