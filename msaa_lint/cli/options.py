"""What options and commands are, and the options that several commands have.

This module, `commands`, and `arguments` import no library: importing typer (0.29), which imports
pydantic, takes 130 ms on a machine where Python starts in 14, three times as long as the rest of a
run of `check`.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from msaa_lint.linter.settings.settings import OUTPUT_FORMATS, TABLE_FORMATS

CAPTURE_FORMATS = ("gfxreconstruct", "api-dump", "renderdoc", "fossilize")
"""The names in `readers.CAPTURES`."""

INPUT_FORMATS = (
    "description",
    "vulkan-sc",
    *CAPTURE_FORMATS,
    "c",
    "cpp",
    "objc",
    "objcpp",
    "swift",
    "rust",
    "glsl",
    "markdown",
    "asciidoc",
    "rst",
)
"""The names in `readers.FORMATS`, `readers.CAPTURES`, and `file_types.LANGUAGES`, so that help and
errors import no reader.
"""

CHECK_FORMATS = (*OUTPUT_FORMATS, *TABLE_FORMATS)
COST_FORMATS = ("full", "json", "markdown", "html")
PAGE_FORMATS = ("full", "json", "html")
"""The values of `--output` of `confirm` and `study`."""

SCHEMAS = ("description", "json-v1", "cost-v1", "confirm-v1", "study-v1", "corpus-v1")

Arguments = dict[str, Any]
"""Values by option name, and `paths`. Options that are not on the command line are not in it."""


class Option(NamedTuple):
    """One option. `kind` is flag, text, integer, decimal, or choice; `repeatable` options collect
    their values in a list.

    `default` is shown in the help. `values` names what a shell completes the value from: a function
    of `completion`.
    """

    name: str
    kind: str
    help: str
    metavar: str = ""
    choices: tuple[str, ...] = ()
    repeatable: bool = False
    default: str = ""
    short: str = ""
    values: str = ""

    @property
    def flag(self) -> str:
        return "--" + self.name.replace("_", "-")


class Paths(NamedTuple):
    """The arguments that are not options: how many there must be, and may be (None: any number)."""

    metavar: str
    help: str
    min: int = 1
    max: int | None = None
    choices: tuple[str, ...] = ()
    values: str = ""


class Command(NamedTuple):
    """A command whose module and function have its name. `groups` are its options by heading. No
    path is required if one of the flags `standalone` is given.
    """

    help: str
    groups: Mapping[str, Sequence[Option]]
    paths: Paths = Paths("PATH...", "Files and folders; - is standard input.")
    standalone: tuple[str, ...] = ()

    @property
    def options(self) -> list[Option]:
        return [option for options in self.groups.values() for option in options]


_SELECT = Option("select", "text", "", "RULES", repeatable=True, values="rules")
SELECTORS = (
    _SELECT._replace(
        help="Rules to enable instead of the edition's: names, codes, prefixes (MSAA2), ALL."
    ),
    _SELECT._replace(name="extend_select", help="Rules to enable in addition."),
    _SELECT._replace(name="ignore", help="Rules to disable."),
    Option("rules", "text", "Page or folder of custom rules.", "PATH", repeatable=True),
)
PROFILE = Option(
    "profile",
    "text",
    "Device, device class, or vendor to assume for captures and inputs that name none.",
    "NAME",
    values="profiles",
)
_STDIN_FILENAME = Option("stdin_filename", "text", "Name to use for standard input.", "NAME")
CONFIGURATION = (
    Option("config", "text", "Use this configuration file.", "FILE"),
    Option("isolated", "flag", "Ignore configuration files."),
    Option("no_respect_gitignore", "flag", "In folders, also lint files that .gitignore ignores."),
    Option("no_cache", "flag", "Neither use nor keep results in the user's cache folder."),
)


def input_format(*formats: str) -> Option:
    """`--input-format` with these values."""
    return Option(
        "input_format",
        "choice",
        "Read inputs as this format instead of detecting it.",
        "FORMAT",
        choices=formats,
    )


def output(*formats: str, default: str = "full") -> Option:
    """`--output` with these formats, each of which may go to a file."""
    help_text = "Output format; with =FILE, written to this file. Repeatable."
    return Option(
        "output", "text", help_text, "FORMAT[=FILE]", formats, repeatable=True, default=default
    )


def text_output(*formats: str) -> Option:
    """`--output` with these formats, for standard output alone."""
    return Option("output", "choice", "Output format.", "FORMAT", choices=formats, default="text")


FORCE = Option("force", "flag", "Overwrite files that msaa-lint did not write.")
COLOR = Option(
    "color",
    "choice",
    "Color text output.",
    "WHEN",
    choices=("auto", "always", "never"),
    default="auto",
)
GLOBAL = (
    Option("quiet", "flag", "Print results and errors only: no notes, no summary.", short="-q"),
    Option(
        "verbose",
        "flag",
        "Also print which inputs and settings are used, to standard error.",
        short="-v",
    ),
    Option("traceback", "flag", "Show a traceback if msaa-lint itself fails."),
    Option("help", "flag", "Show this help, and exit.", short="-h"),
)
"""Options of all commands."""

FRAME_END = Option(
    "frame_end",
    "choice",
    "What ends a frame of a capture.",
    "END",
    ("present", "submit", "label:TEXT"),
)
SHARED = (_STDIN_FILENAME, input_format(*INPUT_FORMATS), FRAME_END, *CONFIGURATION, COLOR, *GLOBAL)
"""Options of `check`, `cost`, `confirm`, and `study`."""

CLUSTER = (
    Option(
        "backend",
        "choice",
        "Let the workers of a cluster do the work.",
        "NAME",
        choices=("dask", "ray"),
    ),
    Option(
        "cluster",
        "text",
        "Address of the cluster; without one, of DASK_SCHEDULER_ADDRESS or RAY_ADDRESS, or one of "
        "this machine.",
        "ADDRESS",
    ),
)
DIVISION = (
    Option(
        "jobs",
        "integer",
        "Inputs to read at once.",
        "N",
        default="the cores, for more than a few inputs; the workers of a cluster",
    ),
    *CLUSTER,
)
INPUTS = SHARED[:3]
