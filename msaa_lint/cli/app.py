"""The command line in typer: help, errors, suggestions, completion, and the commands whose arguments `options.parse` does not read."""

from __future__ import annotations

import inspect
from importlib import import_module
from typing import Annotated, Any, Literal, NoReturn

import typer

from msaa_lint.core.package import VERSION
from msaa_lint.input.file_types import LANGUAGES
from msaa_lint.input.readers import CAPTURES

from .common import run_command
from .options import COMMANDS, Command, Option, run

app = typer.Typer(
    name="msaa-lint",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Finds multisampling mistakes in Vulkan and Metal frames that cost bandwidth, memory, power, or correctness.",
)


def _print_version(requested: bool) -> None:
    if requested:
        typer.echo(f"msaa-lint {VERSION}")
        raise typer.Exit


@app.callback()
def main(
    version: Annotated[bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version.")] = False,
) -> None:
    """The options before a command."""


def _add_command(name: str, command: Command) -> None:
    """Adds a command of `COMMANDS` to the application."""

    def callback(**values: Any) -> None:
        paths = values.pop("paths") or []
        stated = {name: value for name, value in values.items() if value is not None and value is not False and value != []}
        raise typer.Exit(run(name, {"paths": paths, **stated}))

    argument = typer.Argument(metavar="PATH...", help=command.paths)
    optional = bool(command.standalone)
    paths = inspect.Parameter(
        "paths",
        inspect.Parameter.KEYWORD_ONLY,
        default=None if optional else inspect.Parameter.empty,
        annotation=Annotated[list[str] | None, argument] if optional else Annotated[list[str], argument],
    )
    parameters = [paths, *map(_parameter, command.options)]
    callback.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    callback.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    app.command(name, help=inspect.cleandoc(command.help))(callback)


def _parameter(option: Option) -> inspect.Parameter:
    """An option as a parameter of a typer command."""
    types: dict[str, Any] = {"flag": bool, "integer": int, "decimal": float, "text": str}
    kind = Literal[option.choices] if option.kind == "choice" else types[option.kind]
    default: Any = False if option.kind == "flag" else None
    if option.repeatable:
        kind, default = list[kind], []  # type: ignore[valid-type]
    elif option.kind != "flag":
        kind = kind | None
    minimum = 1 if option.kind == "integer" else None
    declaration = typer.Option(option.flag, help=option.help, metavar=option.metavar or None, show_default=False, min=minimum)
    return inspect.Parameter(option.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=Annotated[kind, declaration])


for _name, _command in COMMANDS.items():
    _add_command(_name, _command)


def _exit_with(module: str, function: str, *values: Any) -> NoReturn:
    """Runs the function of a command's module, which is imported only now, and exits with the code that it returns."""
    raise typer.Exit(run_command(lambda _: getattr(import_module(f".{module}", __package__), function)(*values), {}))


@app.command()
def rule(
    name: Annotated[str | None, typer.Argument(help="A rule's name or code.")] = None,
    all_rules: Annotated[bool, typer.Option("--all", help="List all rules.")] = False,
    output: Annotated[Literal["text", "markdown", "json"], typer.Option("--output", help="Output format.")] = "text",
    rules: Annotated[list[str] | None, typer.Option("--rules", metavar="PATH", help="Page or folder of custom rules.")] = None,
) -> None:
    """Explain a rule, or list all rules."""
    if all_rules or name is None:
        _exit_with("rule", "list_rules", rules or [], output)
    _exit_with("rule", "explain_rule", name, rules or [], output)


@app.command()
def device(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME|PATH]...", help="Built-in devices and reports; - is standard input; none: the installed drivers."),
    ] = None,
    output: Annotated[Literal["text", "json", "description"], typer.Option("--output", help="Output format.")] = "text",
    listing: Annotated[bool, typer.Option("--list", help="List the built-in devices.")] = False,
) -> None:
    """Show what a device supports for multisampling."""
    _exit_with("device", "device", names or [], output, listing)


@app.command()
def facts(
    path: Annotated[str | None, typer.Argument(help="An input; none: all facts that a rule can use.")] = None,
    output: Annotated[Literal["text", "json", "markdown"], typer.Option("--output", help="Output format.")] = "text",
    profile: Annotated[str | None, typer.Option("--profile", metavar="NAME", help="Device to assume for an input that names none.")] = None,
) -> None:
    """List facts that rules can use, or their values in an input."""
    if path is None:
        _exit_with("facts", "print_reference", output)
    _exit_with("facts", "print_facts", path, output, profile)


@app.command()
def convert(
    path: Annotated[str, typer.Argument(metavar="INPUT", help="A capture, source code, or render targets; - is standard input.")],
    output: Annotated[str | None, typer.Option("--output", "-o", metavar="FILE", help="Write to this file, shaders next to it.")] = None,
    input_format: Annotated[
        Literal[(*CAPTURES, *LANGUAGES)] | None,  # type: ignore[valid-type]
        typer.Option(help="Read the input as this format instead of detecting it."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")] = False,
) -> None:
    """Convert a capture or source code to a description.

    The description can be read, edited, fixed, and confirmed. Render targets are converted to plain descriptions, too.

    Exits with 0, or with 2 if the input has mistakes or a capture is truncated; the part that can be read is still written.
    """
    _exit_with("convert", "convert", path, output, input_format, force)


@app.command()
def schema(
    which: Annotated[
        Literal["description", "json-v1", "cost-v1"],
        typer.Argument(help="The description format, or the JSON output of `check` (json-v1) or `cost` (cost-v1)."),
    ] = "description",
) -> None:
    """Print a JSON Schema."""
    _exit_with("schema", "schema", which)


@app.command()
def baseline(
    paths: Annotated[list[str], typer.Argument(metavar="PATH...", help="Files and folders to lint.")],
    file: Annotated[str, typer.Option("--file", help="The baseline file.")] = "msaa-lint-baseline.json",
    prune: Annotated[bool, typer.Option("--prune", help="Only remove fixed findings.")] = False,
    config: Annotated[str | None, typer.Option("--config", metavar="FILE", help="Use this configuration file.")] = None,
    isolated: Annotated[bool, typer.Option("--isolated", help="Ignore configuration files.")] = False,
) -> None:
    """Record the current findings, so that only new ones are reported."""
    _exit_with("baseline", "baseline", paths, file, prune, config, isolated)


@app.command()
def init(
    folder: Annotated[str, typer.Argument(help="Folder to write to.")] = ".",
) -> None:
    """Write a commented configuration and a first description."""
    _exit_with("init", "init", folder)
