"""Help and completion of the command line, by typer, from the tables of `options`."""

from __future__ import annotations

import inspect
import os
import re
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Annotated, Any

import typer
from typer.core import TyperCommand

from .commands import COMMANDS
from .options import Command, Option

app = typer.Typer(
    name="msaa-lint",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
    help="Finds multisampling mistakes in Vulkan and Metal frames that cost bandwidth, memory, "
    "power, or correctness.",
    epilog="`msaa-lint COMMAND --help` describes a command; `msaa-lint rule NAME` explains a rule.",
)


@app.callback()
def main(
    version: Annotated[
        bool, typer.Option("--version", help="Print the version, and exit.")
    ] = False,
) -> None:
    """The options before a command."""


class _TableCommand(TyperCommand):
    """A command with its options below their headings."""

    table: Command

    def collect_usage_pieces(self, ctx: Any) -> list[str]:
        paths = self.table.paths
        if paths.max == 0:
            return ["[OPTIONS]"]
        return [
            "[OPTIONS]",
            paths.metavar if paths.min and not self.table.standalone else f"[{paths.metavar}]",
        ]

    def format_options(self, ctx: Any, formatter: Any) -> None:
        paths = self.table.paths
        if paths.max != 0:
            with formatter.section("Arguments"):
                formatter.write_dl([(paths.metavar, paths.help + _values(paths.choices))])
        for heading, options in self.table.groups.items():
            with formatter.section(heading):
                formatter.write_dl([_help_row(option) for option in options])


def _help_row(option: Option) -> tuple[str, str]:
    """An option, and what it does."""
    name = ", ".join(filter(None, (option.short, option.flag)))
    return f"{name} {option.metavar}".rstrip(), option.help + _values(
        option.choices, option.default
    )


def _values(choices: tuple[str, ...], default: str = "") -> str:
    """`  [a, b, c; default: b]`, or what there is of it."""
    text = "; ".join(filter(None, (", ".join(choices), default and f"default: {default}")))
    return f"  [{text}]" if text else ""


def _add_command(name: str, command: Command) -> None:
    """Adds a command of `COMMANDS` to the application."""
    paths = typer.Argument(
        metavar=command.paths.metavar,
        autocompletion=_completion(command.paths.values, command.paths.choices),
    )
    parameters = [_parameter("paths", list[str] | None, paths)] if command.paths.max != 0 else []
    for option in command.options:
        if option.name != "help":
            flags = filter(None, (option.flag, option.short))
            complete = None if option.kind == "flag" else _completion(option.values, option.choices)
            info = typer.Option(*flags, help=option.help, autocompletion=complete)
            parameters.append(
                _parameter(option.name, bool if option.kind == "flag" else list[str] | None, info)
            )

    def callback(**_: Any) -> None:
        """Never called: `arguments` runs commands."""

    callback.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    callback.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    cls = type(name, (_TableCommand,), {"table": command})
    app.command(name, cls=cls, help=inspect.cleandoc(command.help))(callback)


def _parameter(name: str, kind: Any, info: Any) -> inspect.Parameter:
    default = False if kind is bool else None
    return inspect.Parameter(
        name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, info]
    )


def _completion(
    source: str, choices: tuple[str, ...]
) -> Callable[[str], Iterator[tuple[str, str]]] | None:
    """The function that completes a value; None if shells complete it as a path."""
    if not source and not choices:
        return None

    def complete(incomplete: str) -> Iterator[tuple[str, str]]:
        values = (
            getattr(import_module(".completion", __package__), source)()
            if source
            else [(choice, "") for choice in choices]
        )
        # The last word of a comma-separated list.
        head = (
            incomplete[: incomplete.rfind(",") + 1]
            if source not in ("", "scenes", "devices")
            else ""
        )
        return ((head + word, text) for word, text in values)

    return complete


def _join_values(words: str, number: str) -> tuple[str, str]:
    """The words that bash completes, and the number of the current one, with `--output = json`
    joined again: bash splits words at `=`.
    """
    joined, count = re.subn(r"(\s--[\w-]+)\s=\s(?=\S)", r"\1=", words)
    return joined, str(int(number) - 2 * count) if number.isdigit() else number


for _name, _command in COMMANDS.items():
    _add_command(_name, _command)
if os.environ.get("_MSAA_LINT_COMPLETE") == "complete_bash":
    _words = _join_values(os.environ.get("COMP_WORDS", ""), os.environ.get("COMP_CWORD", ""))
    os.environ["COMP_WORDS"], os.environ["COMP_CWORD"] = _words
