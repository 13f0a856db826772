"""The options of `check`, as data: read straight from the arguments where they are well formed, by typer where they are not.

typer (0.29) imports pydantic for any command it runs, 130 ms on a machine where Python itself starts in 14: three times what the rest of a
run takes. So what parses needs no typer, and help, errors, suggestions and completion are typer's, from the same table.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from msaa_lint.linter.settings.settings import OUTPUT_FORMATS

_OUTPUTS = ", ".join(OUTPUT_FORMATS)
LEVELS = ("note", "warning", "error")
CONFIDENCES = ("low", "medium", "high")


INPUT_FORMATS = (
    "description", "vulkan-sc", "gfxreconstruct", "api-dump", "renderdoc", "fossilize", "c", "cpp", "swift", "glsl", "markdown",
)  # fmt: skip
"""The names of `readers.FORMATS`, `readers.CAPTURES` and `programs.LANGUAGES`, for help and errors that import no reader."""


class Option(NamedTuple):
    """One option: `kind` is flag, text, number or choice; `many` for one that may be given again."""

    name: str
    kind: str
    help: str
    metavar: str = ""
    choices: tuple[str, ...] = ()
    many: bool = False

    @property
    def flag(self) -> str:
        return "--" + self.name.replace("_", "-")


SHARED = (
    Option("stdin_filename", "text", "What to call the input from `-`.", "NAME"),
    Option("input_format", "choice", "Read inputs as this, whatever they look like.", choices=INPUT_FORMATS),
    Option("config", "text", "Use this configuration file.", "FILE"),
    Option("isolated", "flag", "Use no configuration file."),
    Option("color", "choice", "Colour in text output.  [default: auto]", choices=("auto", "always", "never")),
    Option("traceback", "flag", "Show where the program itself failed."),
)
"""Options that `check`, `cost`, `confirm` and `study` have."""

CHECK = (
    Option("select", "text", "Rules to use in place of the edition's: names, codes, prefixes (MSAA2), ALL.", "RULES", many=True),
    Option("extend_select", "text", "Rules to use as well.", "RULES", many=True),
    Option("ignore", "text", "Rules to leave out.", "RULES", many=True),
    Option("rules", "text", "A page or a folder of pages with rules of your own.", "PATH", many=True),
    Option("edition", "text", "The default rules of that edition.", "EDITION"),
    Option("profile", "text", "The device, device class or vendor that inputs without a device are judged for.", "NAME"),
    Option("fail_on", "choice", "Exit with 1 from this severity on.  [default: warning]", choices=LEVELS),
    Option("fail_on_cost", "text", "Exit with 1 where the findings of an input cost this together: 50MB/s, 100mW, 16MiB.", "BUDGET"),
    Option("fail_confidence", "choice", "Findings of less confidence never fail a run.  [default: medium]", choices=CONFIDENCES),
    Option("fix", "flag", "Mend what has a safe fix, in the files; of `-` the mended text is printed."),
    Option("unsafe_fixes", "flag", "With --fix or --diff: use fixes too that may change the picture, or are a choice."),
    Option("diff", "flag", "Print what --fix would change and write nothing; exit with 1 if that is anything."),
    Option("exit_zero", "flag", "Exit with 0 whatever is found."),
    Option("min_severity", "choice", "Leave out what is below.  [default: note]", choices=LEVELS),
    Option(
        "output",
        "text",
        f"{', '.join(OUTPUT_FORMATS)}; =FILE writes there.  [default: full; concise in a pipe]",
        "FORMAT[=FILE]",
        many=True,
    ),
    Option("sort", "choice", "Order of the findings; price is the dearest first.  [default: place]", choices=("place", "price")),
    Option("statistics", "flag", "Count findings and add up their prices by rule instead of listing them."),
    Option("baseline", "text", "Silence what this baseline file counts.", "FILE"),
    Option("no_ignores", "flag", "Disregard suppression comments."),
    Option("show_suppressed", "flag", "Report silenced findings as such (sarif, json)."),
    Option("max_depth", "number", "Deepest nesting of an input.  [default: 100]", "N"),
    Option("max_nodes", "number", "Most nodes of an input, aliases expanded.  [default: 1000000]", "N"),
    Option("max_bytes", "number", "Largest input.  [default: 67108864]", "N"),
    *SHARED,
)

Given = dict[str, Any]
"""Option names with their values, and `paths`. What is not given is not in it."""


def read(arguments: Sequence[str], table: Sequence[Option] = CHECK, alone: Sequence[str] = ()) -> Given | None:
    """What the arguments of a command say; None where they are not well formed or ask for help.

    A path is due, unless one of the flags `alone` stands for it.
    """
    options = {option.flag: option for option in table}
    given: Given = {"paths": []}
    rest = iter(arguments)
    for argument in rest:
        if argument == "--":
            given["paths"].extend(rest)
            break
        if argument == "-" or not argument.startswith("-"):
            given["paths"].append(argument)
            continue
        flag, equals, value = argument.partition("=")
        option = options.get(flag)
        if option is None:
            return None
        if option.kind == "flag":
            if equals:
                return None
            given[option.name] = True
            continue
        if not equals:
            following = next(rest, None)
            if following is None:
                return None
            value = following
        if not _take(option, value, given):
            return None
    return given if given["paths"] or any(given.get(name) for name in alone) else None


def _take(option: Option, value: str, given: Given) -> bool:
    if option.kind == "choice" and value not in option.choices:
        return False
    if option.kind == "number":
        if not (value.isascii() and value.isdigit() and 0 < len(value) < 12 and int(value) > 0):
            return False
        given[option.name] = int(value)
    elif option.many:
        given.setdefault(option.name, []).append(value)
    else:
        given[option.name] = value
    return True
