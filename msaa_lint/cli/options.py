"""The commands and their options, as tables. `arguments` parses by them; `app` prints help and completes words from them.

This module and `arguments` import no library: importing typer (0.29), which imports pydantic, takes 130 ms on a machine where Python starts
in 14, three times as long as the rest of a run of `check`.
"""

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any, NamedTuple

from msaa_lint.core.finding import CONFIDENCES, SEVERITIES
from msaa_lint.core.text.node import Limits
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS, TABLE_FORMATS

_LIMITS = Limits()

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
"""The names in `readers.FORMATS`, `readers.CAPTURES`, and `file_types.LANGUAGES`, so that help and errors import no reader."""

CHECK_FORMATS = (*OUTPUT_FORMATS, *TABLE_FORMATS)
COST_FORMATS = ("full", "json", "markdown", "html")
PAGE_FORMATS = ("full", "json", "html")
"""The values of `--output` of `confirm` and `study`."""

SCHEMAS = ("description", "json-v1", "cost-v1")

Arguments = dict[str, Any]
"""Values by option name, and `paths`. Options that are not on the command line are not in it."""


class Option(NamedTuple):
    """One option. `kind` is flag, text, integer, decimal, or choice; `repeatable` options collect their values in a list.

    `default` is shown in the help. `values` names what a shell completes the value from: a function of `completion`.
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
    """A command whose module and function have its name. `groups` are its options by heading. No path is required if one of the flags
    `standalone` is given."""

    help: str
    groups: Mapping[str, Sequence[Option]]
    paths: Paths = Paths("PATH...", "Files and folders; - is standard input.")
    standalone: tuple[str, ...] = ()

    @property
    def options(self) -> list[Option]:
        return [option for options in self.groups.values() for option in options]


_SELECT = Option("select", "text", "", "RULES", repeatable=True, values="rules")
_SELECTORS = (
    _SELECT._replace(help="Rules to enable instead of the edition's: names, codes, prefixes (MSAA2), ALL."),
    _SELECT._replace(name="extend_select", help="Rules to enable in addition."),
    _SELECT._replace(name="ignore", help="Rules to disable."),
    Option("rules", "text", "Page or folder of custom rules.", "PATH", repeatable=True),
)
_PROFILE = Option(
    "profile", "text", "Device, device class, or vendor to assume for captures and inputs that name none.", "NAME", values="profiles"
)
_STDIN_FILENAME = Option("stdin_filename", "text", "Name to use for standard input.", "NAME")
_CONFIGURATION = (
    Option("config", "text", "Use this configuration file.", "FILE"),
    Option("isolated", "flag", "Ignore configuration files."),
    Option("no_respect_gitignore", "flag", "In folders, also lint files that .gitignore ignores."),
    Option("no_cache", "flag", "Neither use nor keep results in the user's cache folder."),
)


def _input_format(*formats: str) -> Option:
    return Option("input_format", "choice", "Read inputs as this format instead of detecting it.", "FORMAT", choices=formats)


def _output(*formats: str, default: str = "full") -> Option:
    help_text = "Output format; with =FILE, written to this file. Repeatable."
    return Option("output", "text", help_text, "FORMAT[=FILE]", formats, repeatable=True, default=default)


def _text_output(*formats: str) -> Option:
    return Option("output", "choice", "Output format.", "FORMAT", choices=formats, default="text")


_FORCE = Option("force", "flag", "Overwrite files that msaa-lint did not write.")
_COLOR = Option("color", "choice", "Color text output.", "WHEN", choices=("auto", "always", "never"), default="auto")
GLOBAL = (
    Option("quiet", "flag", "Print results and errors only: no notes, no summary.", short="-q"),
    Option("verbose", "flag", "Also print which inputs and settings are used, to standard error.", short="-v"),
    Option("traceback", "flag", "Show a traceback if msaa-lint itself fails."),
    Option("help", "flag", "Show this help, and exit.", short="-h"),
)
"""Options of all commands."""

_FRAME_END = Option(
    "frame_end",
    "choice",
    "What ends a frame of a capture.",
    "END",
    ("present", "submit", "label:TEXT"),
)
SHARED = (_STDIN_FILENAME, _input_format(*INPUT_FORMATS), _FRAME_END, *_CONFIGURATION, _COLOR, *GLOBAL)
"""Options of `check`, `cost`, `confirm`, and `study`."""

_CLUSTER = (
    Option("backend", "choice", "Let the workers of a cluster do the work.", "NAME", choices=("dask", "ray")),
    Option(
        "cluster",
        "text",
        "Address of the cluster; without one, of DASK_SCHEDULER_ADDRESS or RAY_ADDRESS, or one of this machine.",
        "ADDRESS",
    ),
)
_DIVISION = (
    Option("jobs", "integer", "Inputs to read at once.", "N", default="the cores, for more than a few inputs; the workers of a cluster"),
    *_CLUSTER,
)
_INPUTS = SHARED[:3]
_SIZE = Option("size", "text", "Size in pixels of inputs that state none.", "WxH")

COMMANDS = {
    "check": Command(
        """Find multisampling mistakes in frames.

        Reads descriptions of frames (YAML, JSON), captures (GFXReconstruct, API dump, RenderDoc, Fossilize), Vulkan SC pipelines, render
        targets of Flutter's engine, and source code (C, C++, Swift, GLSL, Markdown).
        In a folder, it reads files called *.msaa.yaml (.yml, .json), other data files with content that only a frame has, and source code
        that uses multisampling, except what .gitignore ignores. A file that is named is always read.

        Exits with 0 if there are no findings, 1 if there are, and 2 if an input, an option, the configuration, or msaa-lint failed.

        \b
        Examples:
          msaa-lint check frame.msaa.yaml --profile mali-g76
          msaa-lint check . --fix --output sarif=findings.sarif
        """,
        {
            "Rules": (
                *_SELECTORS,
                Option("edition", "text", "Use the default rules of this edition.", "EDITION", values="editions"),
                _PROFILE,
            ),
            "Findings": (
                Option("min_severity", "choice", "Lowest severity to report.", "SEVERITY", choices=SEVERITIES, default="note"),
                Option("baseline", "text", "Hide the findings that this baseline file counts.", "FILE"),
                Option("no_ignores", "flag", "Disregard suppression comments."),
                Option("show_suppressed", "flag", "Report suppressed findings as well, marked as suppressed."),
            ),
            "Fixes": (
                Option("fix", "flag", "Apply safe fixes in place; for `-`, print the fixed text."),
                Option("unsafe_fixes", "flag", "With --fix or --diff: include fixes that may change the picture."),
                Option("diff", "flag", "Print what --fix would change without writing it; exit with 1 if there is a change."),
            ),
            "Exit code": (
                Option("fail_on", "choice", "Lowest severity that exits with 1.", "SEVERITY", SEVERITIES, default="warning"),
                Option("fail_confidence", "choice", "Lowest confidence that exits with 1.", "LEVEL", CONFIDENCES, default="medium"),
                Option("fail_on_cost", "text", "Exit with 1 if fixes would save this much of an input: 50MB/s, 100mW, 16MiB.", "COST"),
                Option("strict_inputs", "flag", "Exit with 2 if an input creates multisampled images but shows no pass to check."),
                Option("exit_zero", "flag", "Exit with 0 even if there are findings."),
            ),
            "Output": (
                _output(*CHECK_FORMATS, default="full; concise in a pipe"),
                Option("sort", "choice", "Order of the findings.", "ORDER", choices=("place", "price"), default="place"),
                Option("statistics", "flag", "Print counts and costs by rule instead of findings."),
                Option("watch", "flag", "Check again whenever an input, the configuration, or a rule page changes (extra `watch`)."),
                Option("explain_undecided", "flag", "List what to add to the input for each rule that it does not decide."),
                _COLOR,
            ),
            "Inputs": (
                *_INPUTS,
                *_DIVISION,
                Option("max_depth", "integer", "Maximum nesting depth of an input.", "N", default=str(_LIMITS.depth)),
                Option("max_nodes", "integer", "Maximum number of nodes in an input, aliases expanded.", "N", default=str(_LIMITS.nodes)),
                Option("max_bytes", "integer", "Maximum size of an input in bytes.", "N", default=str(_LIMITS.bytes)),
            ),
            "Configuration": _CONFIGURATION,
            "Other": GLOBAL,
        },
    ),
    "cost": Command(
        """Show what a frame costs in bandwidth, memory, and power.

        Prints MB/s, MiB, and mW by pass and attachment, or for two files, what the second adds.

        Exits with 0, or with 2 if an input, an option, or the configuration failed; the other inputs are still shown.
        """,
        {
            "Frame": (
                Option("fps", "decimal", "Frames per second, overriding the input.", "FPS"),
                _SIZE,
                _PROFILE._replace(help="Device to assume for captures and inputs that name none.", metavar="NAME|PATH"),
                Option("milliwatts_per_gbps", "decimal", "Power per GB/s of traffic.", "MW", default="the device's, else 100"),
            ),
            "Comparison": (
                Option("budget", "text", "Power budget to compare with, as in 2500mW.", "POWER", default="2.5W"),
                Option("samples", "text", "Other sample counts to estimate.", "N,...", default="1,2,4,8", values="cost_samples"),
                Option("each", "flag", "Show two inputs one after the other instead of comparing them."),
            ),
            "Output": (
                _output(*COST_FORMATS),
                Option("chart", "text", "Draw a chart to an .svg, .png, or .json (Vega-Lite) file (extra `chart`).", "FILE"),
                _COLOR,
            ),
            "Inputs": (*_INPUTS, *_DIVISION),
            "Configuration": _CONFIGURATION,
            "Other": GLOBAL,
        },
        Paths("PATH...", "Files and folders; - is standard input. Exactly two files are compared: what the second adds."),
    ),
    "confirm": Command(
        """Render inputs on a Vulkan device to confirm their findings.

        Reports whether passes are created, whether the validation layer agrees, and whether safe fixes keep the picture.

        Exits with 0 if everything is confirmed, 1 if something disagrees or a driver died, and 2 if an input or the environment failed.
        """,
        {
            "Device": (
                Option("device", "text", "Device, by part of its name.", "NAME", repeatable=True, default="llvmpipe, else the first"),
                Option("list_devices", "flag", "List the devices that the Vulkan loader finds, and exit."),
                Option("no_gate", "flag", "Also try what the device does not support; a driver may crash, in its own process."),
                Option("no_layer", "flag", "Do not load the validation layer."),
                Option("timeout", "text", "Time limit for one pass.", "SECONDS", default="30"),
            ),
            "Frame": (
                Option("size", "text", "Size in pixels, overriding the input.", "WxH"),
                Option("samples", "integer", "Sample count of all multisampled images, overriding the input.", "N", values="cost_samples"),
                Option("resolves", "flag", "Compare color resolves with their samples, too; depth and stencil always are."),
            ),
            "Times": (
                Option("time", "flag", "Measure times.  [default: on a GPU, not on a software driver]"),
                Option("no_time", "flag", "Do not measure times."),
                Option("repeats", "integer", "Number of timed runs of each version of a pass.", "N", default="15"),
            ),
            "Rules": (*_SELECTORS, _PROFILE),
            "Output": (
                _output(*PAGE_FORMATS),
                Option("image", "text", "Write pictures to this folder: as written, fixed, difference, enlarged edge (PNG).", "DIR"),
                _FORCE,
                _COLOR,
            ),
            "Inputs": (*_INPUTS, _DIVISION[0]._replace(help="Inputs to try at once, unless times are measured.", default="1")),
            "Configuration": _CONFIGURATION,
            "Other": (
                GLOBAL[0],
                GLOBAL[1]._replace(
                    help="Also show what only msaa-lint reports, noise and output of the layer and the driver, and inputs and settings."
                ),
                *GLOBAL[2:],
            ),
        },
        standalone=("list_devices",),
    ),
    "study": Command(
        """Measure the error and cost of sampling techniques.

        Compares 1 to 16 samples, sample shading, and supersampling with the exact picture, for scenes by name (--list-scenes), meshes
        (.obj, .ply), and descriptions. Exits with 0, or with 2 if something failed.
        """,
        {
            "Study": (
                Option("list_scenes", "flag", "List the scenes, and exit."),
                Option("samples", "text", "Sample counts.", "N,...", default="1,2,4,8,16", values="study_samples"),
                Option("techniques", "text", "Techniques to compare.", "NAME,...", default="msaa,sample-shading,ssaa", values="techniques"),
                Option("size", "text", "Size in pixels.", "WxH", default="the description's, else 1920x1080"),
                Option("bits", "choice", "Sub-pixel precision of vertices, in bits.", "BITS", choices=("4", "8"), default="8"),
                Option("flip", "flag", "Also measure FLIP, the difference that a viewer notices (extra `flip`)."),
                Option("ssim", "flag", "Also measure structural similarity (extra `ssim`)."),
                _PROFILE._replace(help="Device whose traffic to estimate for captures and inputs that name none."),
            ),
            "Times": (
                Option("device", "text", "Measure times on this Vulkan device, by part of its name.", "NAME", default="no times"),
                Option(
                    "shading",
                    "text",
                    "Costs of shading: none, light, medium, heavy, 200ops, 500000ns (a million invocations), 4ms (a full screen).",
                    "COST,...",
                    default="none,medium,heavy",
                ),
                Option("shader", "text", "Fragment shader to time techniques with: .spv or GLSL.", "FILE"),
                Option("overdraw", "integer", "Draw each triangle this many times.", "N", default="1"),
                Option("triangle_size", "decimal", "Split triangles until no side is longer than this.", "PIXELS", default="as they are"),
                Option("repeats", "integer", "Number of rounds in which techniques are timed.", "N", default="15, fewer of slow frames"),
                Option("budget", "text", "Recommend what adds at most this time to one sample: 0.5ms, 500us.", "TIME", default="1ms"),
            ),
            "Output": (
                _output(*PAGE_FORMATS),
                Option("plot", "text", "Draw error against time to an .svg, .png, or .json (Vega-Lite) file (extra `chart`).", "FILE"),
                Option("crops", "text", "Write enlarged crops of each scene to this folder (PNG; extra `chart`).", "DIR"),
                Option("record", "flag", "Write a record next to each description, for rule sample-count-above-four."),
                _FORCE,
                _COLOR,
            ),
            "Execution": (
                Option("resume", "text", "Save finished points in this folder, and reuse those already there.", "FOLDER"),
                Option("jobs", "integer", "Points to simulate at once.", "N", default="one per core, or per cluster worker"),
                *_CLUSTER,
            ),
            "Inputs": _INPUTS,
            "Configuration": _CONFIGURATION,
            "Other": GLOBAL,
        },
        Paths("INPUT...", "Scenes, meshes, descriptions; - is standard input.", values="scenes"),
        ("list_scenes",),
    ),
    "corpus": Command(
        """Summarize the findings of many inputs.

        Reads what `msaa-lint check` wrote with --output parquet=FILE or sqlite=FILE, of one run or of several together: where the most
        can be saved, how prices are distributed, and what has changed (extra `corpus`). --sql answers a question of your own.

        Exits with 0, or with 2 if a file, an option, or the query failed.

        \b
        Examples:
          msaa-lint check captures --output parquet=findings.parquet
          msaa-lint corpus findings.parquet --by engine --since last-week.parquet
          msaa-lint corpus findings.parquet --sql 'select * from passes'
        """,
        {
            "Summary": (
                Option("by", "choice", "What to group findings by.", "WHAT", ("rule", "engine", "device", "input"), default="rule"),
                Option("since", "text", "Show what is new and gone since this earlier file or folder.", "PATH"),
                Option("top", "integer", "Rows of a table.", "N", default="20; in JSON all"),
                Option("sql", "text", "Print the rows of a SELECT over findings, passes, inputs, and run instead.", "QUERY"),
            ),
            "Output": (_output(*COST_FORMATS), _COLOR),
            "Other": GLOBAL,
        },
        Paths("PATH...", "Parquet files of findings, SQLite files, and folders of them."),
    ),
    "rule": Command(
        """Explain a rule, or list all rules.

        Custom rules of the configuration are included. A custom rule is a page like those that this command prints; `msaa-lint facts`
        lists what its condition can use.
        """,
        {
            "Options": (
                Option("all", "flag", "List all rules."),
                _text_output("text", "markdown", "json"),
                _SELECTORS[3],
                *_CONFIGURATION,
                *GLOBAL,
            ),
        },
        Paths("NAME", "A rule's name or code, in any case; none: list all rules.", 0, 1, values="rules"),
    ),
    "device": Command(
        """Show what a device supports for multisampling.""",
        {
            "Options": (
                _text_output("text", "json", "description"),
                Option("list", "flag", "List the built-in devices."),
                *GLOBAL,
            ),
        },
        Paths("NAME|PATH...", "Built-in devices and reports; - is standard input; none: the installed drivers.", 0, values="devices"),
    ),
    "facts": Command(
        """List facts that rules can use, or their values in an input.""",
        {
            "Options": (
                _text_output("text", "json", "markdown"),
                _PROFILE._replace(help="Device to assume for an input that names none."),
                _FRAME_END,
                *GLOBAL,
            ),
        },
        Paths("PATH...", "An input, or folders and files of source code; none: all facts that a rule can use.", 0),
    ),
    "convert": Command(
        """Convert a capture or source code to a description.

        The description can be read, edited, fixed, and confirmed. Render targets are converted to plain descriptions, too.

        Several inputs are converted to several descriptions, in a folder: that of `captures/a/b.jsonl` is `a/b.jsonl.msaa.yaml` for the
        input `captures`. Source files of a program are converted together.

        Exits with 0, or with 2 if an input has mistakes or a capture is truncated; the part that can be read, and the other inputs, are
        still written.
        """,
        {
            "Options": (
                Option("output", "text", "Write to this file, or to a folder: an existing one, or `NAME/`.", "PATH", short="-o"),
                Option("force", "flag", "Overwrite existing files."),
                _input_format(*INPUT_FORMATS[2:]),
                _FRAME_END,
                *_DIVISION,
                *GLOBAL,
            ),
        },
        Paths("INPUT...", "Captures, render targets, or source code; folders of these; - is standard input."),
    ),
    "schema": Command(
        """Print a JSON Schema.""",
        {"Options": GLOBAL},
        Paths("WHICH", "The description format (the default), or the JSON of `check` or `cost`.", 0, 1, SCHEMAS),
    ),
    "lsp": Command(
        """Run the language server, for editors.""",
        {
            "Options": (
                Option("stdio", "flag", "Communicate over standard input and output: the default, and the only way."),
                *GLOBAL,
            ),
        },
        Paths("", "", 0, 0),
    ),
    "baseline": Command(
        """Record the current findings, so that only new ones are reported.""",
        {
            "Options": (
                Option("file", "text", "The baseline file.", "FILE", default="msaa-lint-baseline.json"),
                Option("prune", "flag", "Only remove fixed findings."),
                *_CONFIGURATION,
                *GLOBAL,
            ),
        },
        Paths("PATH...", "Files and folders to lint."),
    ),
    "init": Command(
        """Write a configuration, a first description, and its schema.""",
        {"Options": GLOBAL},
        Paths("FOLDER", "Folder to write to; none: the current one.", 0, 1),
    ),
}  # fmt: skip


def run(name: str, arguments: Arguments) -> int:
    """Runs a command of `COMMANDS` and returns its exit code."""
    code: int = getattr(import_module(f".{name}", __package__), name)(arguments)
    return code
