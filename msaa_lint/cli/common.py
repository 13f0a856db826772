"""What the commands share: parsing option values, writing outputs, and ending with the right exit
code.
"""

import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from types import FrameType
from typing import IO, TYPE_CHECKING, Any, NamedTuple, TypeVar

from msaa_lint.core import atomic_write
from msaa_lint.core.diagnostics import internal_error
from msaa_lint.core.extras import needs_extra
from msaa_lint.core.interrupts import deferred
from msaa_lint.core.package import VERSION
from msaa_lint.core.project import resolved
from msaa_lint.core.quote import quoted

from .hyperlinks import shows_hyperlinks
from .options import Arguments
from .progress import capture_progress
from .report import Options
from .report.escape import escape
from .streams import OutputError

if TYPE_CHECKING:
    from msaa_lint.linter.request import Division

MAX_RENDER_SIDE = 16384
"""Width and height of a rendered picture, in pixels."""

_OVERRIDES = (
    "edition",
    "profile",
    "fail_on",
    "fail_on_cost",
    "fail_confidence",
    "min_severity",
    "baseline",
    "rules",
    "strict_inputs",
)
_SELECTORS = ("select", "extend_select", "ignore")

_quiet = _traceback = False
"""Whether the command that runs has `--quiet`, and `--traceback`."""

Value = TypeVar("Value")


class UsageError(Exception):
    """Arguments that cannot be used; its text is for the user."""


class Target(NamedTuple):
    """An output format, and the file to write it to; None is standard output."""

    format: str
    path: str | None


def warn(text: str) -> None:
    """Prints a line to the standard error stream."""
    print(f"msaa-lint: {escape(text)}", file=sys.stderr)


def note(text: str) -> None:
    """Prints a line that is not an error to the standard error stream, unless the command that runs
    is `--quiet`.
    """
    if not _quiet:
        warn(text)


def run_command(
    command: Callable[[Arguments], int],
    arguments: Arguments,
    errors: tuple[type[Exception], ...] = (),
    terminable: bool = False,
) -> int:
    """Runs a command and returns its exit code, however it ends.

    Returns 2 for a UsageError, for the given `errors`, whose texts are for the user too, and for
    any other exception but OutputError unless `--traceback` is given, which raises it; 130 on an
    interrupt. If `terminable`, SIGTERM, SIGHUP, and SIGQUIT unwind the stack, so that no child
    process and no temporary file is left.
    """
    global _quiet, _traceback
    _quiet, _traceback = bool(arguments.get("quiet")), bool(arguments.get("traceback"))
    reported: tuple[type[Exception], ...] = (UsageError, *errors)
    previous = _unwind_on_signals() if terminable else {}
    try:
        _check_current_folder()
        with capture_progress(_quiet):
            return command(arguments)
    except reported as error:
        warn(str(error))
        return 2
    except OutputError:
        raise
    except KeyboardInterrupt:
        return 130
    except Exception as error:
        if _traceback:
            raise
        warn(
            f"internal error: {type(error).__name__}: {str(error)[:300]} (--traceback shows where)"
        )
        return 2
    finally:
        for number, handler in previous.items():
            import signal

            signal.signal(number, handler)


@contextmanager
def internal_errors_of(name: str) -> Iterator[None]:
    """UsageError, which names the input, for an exception that is a mistake in msaa-lint, unless
    `--traceback` is given.
    """
    try:
        yield
    except (UsageError, OutputError):
        raise
    except Exception as error:
        if _traceback:
            raise
        raise UsageError(f"{name}: {internal_error(error)}") from None


def _check_current_folder() -> None:
    try:
        os.getcwd()
    except OSError as error:
        raise UsageError(f"the current folder cannot be used: {error.strerror}") from None


def _unwind_on_signals() -> dict[int, Any]:
    """Makes signals that would end the process raise SystemExit. Returns the previous handlers;
    none in a thread, which cannot set any.
    """
    import signal

    previous: dict[int, Any] = {}

    def unwind(number: int, frame: FrameType | None) -> None:
        if deferred(number, frame):
            return
        # Another signal must not interrupt the cleanup: a terminal that closes may send several.
        for each in previous:
            signal.signal(each, signal.SIG_IGN)
        raise SystemExit(128 + number)

    for name in ("SIGTERM", "SIGHUP", "SIGQUIT"):
        number = getattr(signal, name, None)
        # `nohup` ignores SIGHUP.
        if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
            try:
                previous[number] = signal.signal(number, unwind)
            except ValueError:
                break
    return previous


def parse_outputs(texts: Sequence[str], formats: Sequence[str], example: str) -> list[Target]:
    """The targets that values of `--output` name. UsageError for an unknown format, and if two go
    to standard output; `example` is a value with a file, and if the extra `html` is not installed
    but needed.
    """
    targets = []
    for text in texts:
        name, equals, path = text.partition("=")
        if name not in formats:
            from msaa_lint.core.suggestions import near_or_all

            raise UsageError(f"unknown output format {quoted(name)}: {near_or_all(name, formats)}")
        targets.append(
            Target(name, path if equals and path not in ("", "-", "/dev/stdout") else None)
        )
    if find_spec("jinja2") is None and any(target.format == "html" for target in targets):
        raise UsageError(needs_extra("--output html", "html"))
    if sum(target.path is None for target in targets) > 1:
        raise UsageError(
            "only one output can go to standard output; write the others to files, as in --output "
            f"{example}"
        )
    return targets


def refuse_inputs(outputs: Iterable[str | None], inputs: Sequence[str]) -> None:
    """UsageError if two outputs would go to the same file, or one would replace an input. None is
    standard output.
    """
    paths = [path for path in outputs if path is not None]
    places = list(map(_place, paths))
    for number, (path, place) in enumerate(zip(paths, places, strict=True)):
        if os.path.exists(path) and not os.path.isfile(path):
            continue
        if place in places[:number]:
            raise UsageError(f"two outputs go to {path}; write each to a file of its own")
        if os.path.isfile(path) and any(_is_same_file(path, each) for each in inputs):
            raise UsageError(
                f"{path} is an input, which the output would replace; write it to another file"
            )


def _place(path: str) -> str:
    """The path with links resolved; itself if that is not possible."""
    try:
        return resolved(path)
    except OSError:
        return path


def _is_same_file(path: str, other: str) -> bool:
    try:
        return os.path.samefile(path, other)
    except (OSError, ValueError):
        return False


def write_output(path: str | None, render: Callable[[IO[str]], object]) -> None:
    """Calls `render` with a file, or standard output, opened for UTF-8. UsageError if a file cannot
    be written.
    """
    if path is None:
        render(sys.stdout)
        sys.stdout.flush()
        return
    with writes(path), atomic_write.new_text(path) as file:
        render(file)


@contextmanager
def writes(path: str) -> Iterator[None]:
    """UsageError for an OSError: `path` cannot be written. OutputError if it is a pipe whose reader
    is gone.
    """
    try:
        yield
    except BrokenPipeError:
        raise OutputError from None
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror or error}") from None


def write_figure(path: str, option: str, figure: Callable[[], dict[str, Any]]) -> None:
    """Writes a figure in the format of a file. UsageError if it cannot be written, or the extra
    `chart` is not installed.
    """
    from .report.figure import draw

    format = figure_format(path, option)
    try:
        data = draw(figure(), format)
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("altair", "vl_convert"):
            raise
        raise UsageError(needs_extra(option, "chart")) from None
    with writes(path):
        atomic_write.write_file(path, data)


def require_figures(option: str, format: str = "svg") -> None:
    """UsageError if what figures of a format need is not installed: the extra `chart`, of which
    JSON needs altair alone.
    """
    if any(
        find_spec(package) is None
        for package in ("altair", *(["vl_convert"] if format != "json" else []))
    ):
        raise UsageError(needs_extra(option, "chart"))


def figure_format(path: str, option: str) -> str:
    """The format of a figure by its file's extension. UsageError for another one."""
    from .report.figure import FORMATS

    extension = os.path.splitext(path)[1].lower()
    if extension[1:] not in FORMATS:
        raise UsageError(
            f"`{option}` must be the name of an .svg, .png, or .json file, found {quoted(path)}"
        )
    return extension[1:]


def parse_size(text: str, limit: int) -> tuple[int, int]:
    """Width and height in pixels of `1920x1080`. UsageError for anything else, and for a side above
    `limit`.
    """
    found = re.fullmatch(r"0*([1-9][0-9]{0,18})[xX]0*([1-9][0-9]{0,18})", text)
    if found is None:
        raise UsageError(
            f"`--size` must be WIDTHxHEIGHT in pixels, as in 1920x1080; found {quoted(text)}"
        )
    width, height = int(found[1]), int(found[2])
    if max(width, height) > limit:
        raise UsageError(f"`--size` must be at most {limit}x{limit}; found {quoted(text)}")
    return width, height


def parse_list(text: str, option: str, choices: Mapping[str, Value]) -> list[Value]:
    """The values of a comma-separated list. UsageError for a word that is not one of the
    `choices`.
    """
    words = [word.strip() for word in text.split(",")]
    for word in words:
        if word not in choices:
            from msaa_lint.core.suggestions import did_you_mean

            hint = did_you_mean(word, choices)
            raise UsageError(
                f"`{option}` must be a comma-separated list of {', '.join(choices)}; found "
                f"{quoted(text)}{hint}"
            )
    return [choices[word] for word in words]


def overrides(arguments: Arguments) -> dict[str, Any]:
    """The settings that arguments state, which take precedence over a configuration."""
    settings = {name: arguments[name] for name in _OVERRIDES if name in arguments}
    for name in _SELECTORS:
        if name in arguments:
            settings[name] = [
                word.strip() for text in arguments[name] for word in text.split(",") if word.strip()
            ]
    if arguments.get("no_respect_gitignore"):
        settings["respect_gitignore"] = False
    return settings


def log(arguments: Arguments) -> Callable[[str], None] | None:
    """The `log` of a request: prints lines to the standard error stream if `--verbose` is given."""
    return warn if arguments.get("verbose") else None


def require_engine(arguments: Arguments) -> None:
    """UsageError for the address of a cluster without its engine."""
    if "cluster" in arguments and "backend" not in arguments:
        raise UsageError(
            "`--cluster` needs the engine of the cluster: `--backend dask` or `--backend ray`"
        )


def division(arguments: Arguments) -> "Division":
    """Who reads the inputs. UsageError for an address without an engine."""
    from msaa_lint.linter.request import Division

    require_engine(arguments)
    return Division(arguments.get("backend"), arguments.get("cluster"), arguments.get("jobs"))


def input_options(arguments: Arguments) -> dict[str, Any]:
    """The members of a `linter.request.Request` that all commands fill alike."""
    return {
        "paths": arguments["paths"],
        "config": arguments.get("config"),
        "isolated": bool(arguments.get("isolated")),
        "format": arguments.get("input_format"),
        "frame_end": arguments.get("frame_end"),
        "stdin_filename": arguments.get("stdin_filename"),
        "log": log(arguments),
        "traceback": bool(arguments.get("traceback")),
        "cache": not arguments.get("no_cache"),
        "division": division(arguments),
    }


def report_options(
    arguments: Arguments, out: IO[str], *, color: bool = True, width: int = 80
) -> Options:
    """How to print to a stream: in color and with links only if `color` is true, `width` cells
    unless COLUMNS or a terminal states another number.
    """
    colored = color and use_color(arguments.get("color", "auto"), out.isatty())
    return Options(
        color=colored,
        hyperlinks=colored and shows_hyperlinks(out),
        width=output_width(out, width),
        version=VERSION,
        quiet=bool(arguments.get("quiet")),
        verbose=bool(arguments.get("verbose")),
    )


def output_width(out: IO[str], width: int = 80) -> int:
    """The width of a stream in cells: that of the terminal, else COLUMNS, else the given one."""
    if out.isatty():
        import shutil

        return shutil.get_terminal_size().columns or width
    columns = os.environ.get("COLUMNS", "")
    return (
        int(columns)
        if columns.isascii() and columns.isdigit() and len(columns) < 6 and int(columns)
        else width
    )


def report_module(command: str, format: str) -> Any:
    """The module that prints a command's result in a format. It is imported only if it prints:
    tables take rich, pages jinja2.
    """
    return import_module(
        f".report.html.{command}" if format == "html" else f".report.{command}_{format}",
        __package__,
    )


def use_color(mode: str, terminal: bool) -> bool:
    """Whether to use color: by `--color`, else by NO_COLOR (no-color.org), FORCE_COLOR, and
    CLICOLOR_FORCE, else on a terminal that can.
    """
    if mode != "auto":
        return mode == "always"
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR") or os.environ.get("CLICOLOR_FORCE", "0") not in ("", "0"):
        return True
    return terminal and os.environ.get("TERM") != "dumb"
