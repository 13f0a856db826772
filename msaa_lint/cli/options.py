"""The options of `check`, `cost`, `confirm`, and `study`, as tables.

`parse` reads well-formed arguments. Help, errors, suggestions, and completion are typer's, from the same tables. Importing typer (0.29),
which imports pydantic, takes 130 ms on a machine where Python starts in 14: three times as long as the rest of a run of `check`.
"""

from collections.abc import Sequence
from importlib import import_module
from typing import Any, NamedTuple

from msaa_lint.core.finding import CONFIDENCES, SEVERITIES
from msaa_lint.core.text.node import Limits
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS

_LIMITS = Limits()

INPUT_FORMATS = (
    "description", "vulkan-sc", "gfxreconstruct", "api-dump", "renderdoc", "fossilize", "c", "cpp", "swift", "glsl", "markdown",
)  # fmt: skip
"""The names in `readers.FORMATS`, `readers.CAPTURES`, and `file_types.LANGUAGES`, so that help and errors import no reader."""

Arguments = dict[str, Any]
"""Values by option name, and `paths`. Options that are not on the command line are not in it."""


class Option(NamedTuple):
    """One option. `kind` is flag, text, integer, decimal, or choice; `repeatable` options collect their values in a list."""

    name: str
    kind: str
    help: str
    metavar: str = ""
    choices: tuple[str, ...] = ()
    repeatable: bool = False

    @property
    def flag(self) -> str:
        return "--" + self.name.replace("_", "-")


class Command(NamedTuple):
    """A command whose module and function have its name. A path is required unless one of the flags `standalone` is given."""

    help: str
    options: tuple[Option, ...]
    paths: str = "Files and folders; - is standard input."
    standalone: tuple[str, ...] = ()


_RULES = (
    Option("select", "text", "Rules to enable instead of the edition's: names, codes, prefixes (MSAA2), ALL.", "RULES", repeatable=True),
    Option("extend_select", "text", "Rules to enable in addition.", "RULES", repeatable=True),
    Option("ignore", "text", "Rules to disable.", "RULES", repeatable=True),
    Option("rules", "text", "Page or folder of custom rules.", "PATH", repeatable=True),
)
_PROFILE = Option("profile", "text", "Device, device class, or vendor to assume for inputs that name none.", "NAME")

SHARED = (
    Option("stdin_filename", "text", "Name to use for standard input.", "NAME"),
    Option("input_format", "choice", "Read all inputs as this format instead of detecting it.", choices=INPUT_FORMATS),
    Option("config", "text", "Use this configuration file.", "FILE"),
    Option("isolated", "flag", "Ignore configuration files."),
    Option("color", "choice", "Color text output.  [default: auto]", choices=("auto", "always", "never")),
    Option("traceback", "flag", "Show a traceback if msaa-lint itself fails."),
)
"""Options of all these commands."""


def _output(formats: str, default: str = "full") -> Option:
    return Option("output", "text", f"{formats}; =FILE writes to a file.  [default: {default}]", "FORMAT[=FILE]", repeatable=True)


COMMANDS = {
    "check": Command(
        """Lint descriptions, captures, source code, and folders.

        Exits with 0 if there are no findings, 1 if there are, and 2 if an input, the configuration, or msaa-lint failed.
        """,
        (
            *_RULES,
            Option("edition", "text", "Use the default rules of this edition.", "EDITION"),
            _PROFILE,
            Option("fail_on", "choice", "Lowest severity that makes the exit code 1.  [default: warning]", choices=SEVERITIES),
            Option("fail_on_cost", "text", "Exit with 1 if an input's findings cost this much: 50MB/s, 100mW, 16MiB.", "BUDGET"),
            Option("fail_confidence", "choice", "Lowest confidence that makes the exit code 1.  [default: medium]", choices=CONFIDENCES),
            Option("fix", "flag", "Apply safe fixes in place; for `-`, print the fixed text."),
            Option("unsafe_fixes", "flag", "With --fix or --diff: include fixes that may change the picture."),
            Option("diff", "flag", "Print what --fix would change without writing it; exit with 1 if there is a change."),
            Option("exit_zero", "flag", "Exit with 0 even if there are findings."),
            Option("min_severity", "choice", "Lowest severity to report.  [default: note]", choices=SEVERITIES),
            _output(", ".join(OUTPUT_FORMATS), "full; concise in a pipe"),
            Option("sort", "choice", "Sort findings by place, or the most expensive first.  [default: place]", choices=("place", "price")),
            Option("statistics", "flag", "Print counts and costs by rule instead of findings."),
            Option("baseline", "text", "Hide the findings that this baseline file counts.", "FILE"),
            Option("no_ignores", "flag", "Disregard suppression comments."),
            Option("show_suppressed", "flag", "Report suppressed findings as well, marked as suppressed."),
            Option("max_depth", "integer", f"Maximum nesting depth of an input.  [default: {_LIMITS.depth}]", "N"),
            Option("max_nodes", "integer", f"Maximum number of nodes in an input, aliases expanded.  [default: {_LIMITS.nodes}]", "N"),
            Option("max_bytes", "integer", f"Maximum size of an input in bytes.  [default: {_LIMITS.bytes}]", "N"),
            *SHARED,
        ),
    ),
    "cost": Command(
        """Show what a frame costs in bandwidth, memory, and power.

        Prints MB/s, MiB, and mW by pass and attachment, or for two files, what the second adds.

        Exits with 0, or with 2 if an input, an option, the configuration, or msaa-lint failed; the other inputs are still shown.
        """,
        (
            Option("fps", "decimal", "Frames per second, overriding the input.", "FPS"),
            Option("size", "text", "Size in pixels of inputs that state none.", "WxH"),
            Option("profile", "text", "Device to assume for inputs that name none.", "NAME|PATH"),
            Option("milliwatts_per_gbps", "decimal", "Power per GB/s of traffic.  [default: the device's, else 100]", "MW"),
            Option("budget", "text", "Power budget to compare with.  [default: 2.5W]", "POWER"),
            Option("samples", "text", "Other sample counts to estimate.  [default: 1,2,4,8]", "N,..."),
            Option("each", "flag", "Show two inputs one after the other instead of comparing them."),
            _output("full, json, markdown"),
            Option("chart", "text", "Draw a chart to an .svg or .png file (extra `chart`).", "FILE"),
            *SHARED,
        ),
        "Files and folders; - is standard input. Exactly two files are compared: what the second adds.",
    ),
    "confirm": Command(
        """Render inputs on a Vulkan device to confirm their findings.

        Reports whether passes are created, whether the validation layer agrees, and whether safe fixes keep the picture.

        Exits with 0 if everything is confirmed, 1 if something disagrees or a driver died, and 2 if an input or the environment failed.
        """,
        (
            Option("device", "text", "Device, by part of its name.  [default: llvmpipe, else the first]", "NAME", repeatable=True),
            Option("list_devices", "flag", "List the devices that the Vulkan loader finds, and exit."),
            Option("image", "text", "Write pictures to this folder: as written, fixed, difference, enlarged edge (PNG).", "DIR"),
            Option("no_gate", "flag", "Also try what the device does not support; a driver may crash, in its own process."),
            Option("no_layer", "flag", "Do not load the validation layer."),
            Option("timeout", "text", "Time limit for one pass.  [default: 30]", "SECONDS"),
            Option("time", "flag", "Measure times.  [default: on a GPU, not on a software driver]"),
            Option("no_time", "flag", "Do not measure times."),
            Option("repeats", "integer", "Number of timed runs of each version of a pass.  [default: 15]", "N"),
            Option("resolves", "flag", "Compare color resolves with their samples, too; depth and stencil always are."),
            Option("size", "text", "Size in pixels, overriding the input.", "WxH"),
            Option("samples", "integer", "Sample count of all multisampled images, overriding the input.", "N"),
            *_RULES,
            _PROFILE,
            _output("full, json"),
            Option("verbose", "flag", "Also show what only msaa-lint reports, layer noise, and output of driver and layer."),
            *SHARED,
        ),
        standalone=("list_devices",),
    ),
    "study": Command(
        """Measure the error and cost of sampling techniques.

        Compares 1 to 16 samples, sample shading, and supersampling with the exact picture, for scenes by name (--list-scenes), meshes
        (.obj, .ply), and descriptions. Exits with 0, or with 2 if something failed.
        """,
        (
            Option("list_scenes", "flag", "List the scenes, and exit."),
            Option("samples", "text", "Sample counts.  [default: 1,2,4,8,16]", "N,..."),
            Option("techniques", "text", "Techniques to compare.  [default: msaa,sample-shading,ssaa]", "NAME,..."),
            Option("size", "text", "Size in pixels.  [default: the description's, else 1920x1080]", "WxH"),
            Option("device", "text", "Measure times on this Vulkan device, by part of its name.  [default: no times]", "NAME"),
            Option("repeats", "integer", "Number of timed runs of each technique.  [default: 15]", "N"),
            Option("profile", "text", "Device whose traffic to estimate for inputs that name none.", "NAME"),
            Option("bits", "choice", "Sub-pixel precision of vertices, in bits.  [default: 8]", choices=("4", "8")),
            Option("ssim", "flag", "Also measure structural similarity (extra `ssim`)."),
            _output("full, json"),
            Option("plot", "text", "Plot error against time to an .svg or .png file (extra `chart`).", "FILE"),
            Option("crops", "text", "Write enlarged crops of each scene to this folder (PNG).", "DIR"),
            Option("record", "flag", "Write a record next to each description, for rule sample-count-above-four."),
            Option("resume", "text", "Save finished points in this folder, and reuse those already there.", "FOLDER"),
            Option("jobs", "integer", "Points to simulate at once.  [default: one per core, or per cluster worker]", "N"),
            Option(
                "backend", "choice", "joblib backend.  [default: loky, local processes]", choices=("loky", "threading", "dask", "ray")
            ),
            *SHARED,
        ),
        "Scenes, meshes, descriptions; - is standard input.",
        ("list_scenes",),
    ),
}  # fmt: skip
"""The commands whose arguments `parse` reads."""


def run(name: str, arguments: Arguments) -> int:
    """Runs a command of `COMMANDS` and returns its exit code."""
    code: int = getattr(import_module(f".{name}", __package__), name)(arguments)
    return code


def parse(name: str, words: Sequence[str]) -> Arguments | None:
    """The arguments of a command; None if they are malformed or ask for help, which typer handles."""
    command = COMMANDS[name]
    options = {option.flag: option for option in command.options}
    arguments: Arguments = {"paths": []}
    rest = iter(words)
    for word in rest:
        if word == "--":
            arguments["paths"].extend(rest)
            break
        if word == "-" or not word.startswith("-"):
            arguments["paths"].append(word)
            continue
        flag, equals, text = word.partition("=")
        option = options.get(flag)
        if option is None or (option.kind == "flag" and equals):
            return None
        if option.kind == "flag":
            arguments[option.name] = True
            continue
        value = _value(option, text if equals else next(rest, None))
        if value is None:
            return None
        if option.repeatable:
            arguments.setdefault(option.name, []).append(value)
        else:
            arguments[option.name] = value
    return arguments if arguments["paths"] or any(name in arguments for name in command.standalone) else None


def _value(option: Option, text: str | None) -> str | int | float | None:
    """What `text` means to an option; None if it is malformed or missing."""
    if text is None or (option.kind == "choice" and text not in option.choices):
        return None
    if option.kind == "integer":
        return int(text) if text.isascii() and text.isdigit() and len(text) < 12 and int(text) > 0 else None
    if option.kind == "decimal":
        try:
            return float(text)
        except ValueError:
            return None
    return text
