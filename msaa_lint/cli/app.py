"""The command line as typer knows it: help, errors, suggestions, completion, and every command but a well-formed `check`."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Annotated, Any, Literal

import typer

from msaa_lint.core.package import VERSION
from msaa_lint.input.code import LANGUAGES
from msaa_lint.input.readers import CAPTURES

from .confirm_options import CONFIRM
from .options import CHECK, SHARED, Option
from .study_options import STUDY

app = typer.Typer(
    name="msaa-lint",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Finds the multisampling mistakes in a Vulkan frame that cost bandwidth, memory, power or correctness.",
)


def _version(asked: bool) -> None:
    if asked:
        typer.echo(f"msaa-lint {VERSION}")
        raise typer.Exit


@app.callback()
def common(
    version: Annotated[bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")] = False,
) -> None:
    """What every command takes."""


def _parameter(option: Option) -> inspect.Parameter:
    """An option of the table as a parameter of a typer command."""
    kinds: dict[str, Any] = {"flag": bool, "number": int, "text": str}
    kind = Literal[option.choices] if option.kind == "choice" else kinds[option.kind]
    default: Any = False if option.kind == "flag" else None
    if option.many:
        kind = list[kind]  # type: ignore[valid-type]
    elif option.kind != "flag":
        kind = kind | None
    least = 1 if option.kind == "number" else None
    stated = typer.Option(option.flag, help=option.help, metavar=option.metavar or None, show_default=False, min=least)
    return inspect.Parameter(
        option.name, inspect.Parameter.KEYWORD_ONLY, default=[] if option.many else default, annotation=Annotated[kind, stated]
    )


def _check(**given: Any) -> None:
    """Lint descriptions, pipeline JSON and folders of them.

    Exits with 0 where nothing is found, 1 where something is, 2 where an input, the configuration or the program failed.
    """
    from .check import check

    paths = given.pop("paths")
    raise typer.Exit(check({"paths": paths, **{name: value for name, value in given.items() if value not in (None, False, [])}}))


def _confirm(**given: Any) -> None:
    """Try what is described on a Vulkan device: is it created, what does the validation layer say, does a fix keep the picture.

    Exits with 0 where all is confirmed, 1 where something disagrees or a driver died, 2 where an input or the environment failed.
    """
    from .confirm import confirm

    paths = given.pop("paths") or []
    raise typer.Exit(confirm({"paths": paths, **{name: value for name, value in given.items() if value not in (None, False, [])}}))


def _study(**given: Any) -> None:
    """Show what accuracy costs in time: the error of 1 to 16 samples, sample shading and supersampling against the exact picture.

    Scenes by name (--list-scenes), meshes (.obj, .ply) or descriptions. Exits with 0, or with 2 where something could not be used.
    """
    from .study import study

    paths = given.pop("paths") or []
    raise typer.Exit(study({"paths": paths, **{name: value for name, value in given.items() if value not in (None, False, [])}}))


def _from_table(command: Callable[..., None], table: Sequence[Option], needs_paths: bool = True) -> Callable[..., None]:
    argument = typer.Argument(metavar="PATH...", help="Files and folders; - is standard input.")
    paths: Any = Annotated[list[str], argument] if needs_paths else Annotated[list[str] | None, argument]
    none: Any = inspect.Parameter.empty if needs_paths else None
    first = inspect.Parameter("paths", inspect.Parameter.KEYWORD_ONLY, default=none, annotation=paths)
    return _taking(command, [first, *(_parameter(option) for option in table)])


def _sharing(command: Callable[..., None]) -> Callable[..., None]:
    """A command with the options that several have, after its own."""
    own = inspect.signature(command, eval_str=True).parameters.values()
    return _taking(command, [*(each for each in own if each.kind != inspect.Parameter.VAR_KEYWORD), *map(_parameter, SHARED)])


def _taking(command: Callable[..., None], parameters: Sequence[inspect.Parameter]) -> Callable[..., None]:
    command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
    command.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
    return command


app.command("check")(_from_table(_check, CHECK))
app.command("confirm")(_from_table(_confirm, CONFIRM, needs_paths=False))
app.command("study")(_from_table(_study, STUDY, needs_paths=False))


@app.command()
def rule(
    name: Annotated[str | None, typer.Argument(help="A rule's name or code.")] = None,
    all_rules: Annotated[bool, typer.Option("--all", help="List every rule.")] = False,
    output: Annotated[Literal["text", "markdown", "json"], typer.Option("--output", help="How to print.")] = "text",
    rules: Annotated[list[str] | None, typer.Option("--rules", metavar="PATH", help="Pages or folders of your own.")] = None,
) -> None:
    """Explain a rule: why, what it costs, good and bad examples."""
    from .rule import explain, listing

    raise typer.Exit(listing(rules or [], output) if all_rules or name is None else explain(name, rules or [], output))


@app.command()
@_sharing
def cost(
    paths: Annotated[list[str], typer.Argument(metavar="PATH...", help="Inputs; exactly two files are compared: what the second adds.")],
    fps: Annotated[float | None, typer.Option(help="Frames a second, whatever the input says.")] = None,
    size: Annotated[str | None, typer.Option(metavar="WxH", help="Pixels, where the input states no size.")] = None,
    profile: Annotated[str | None, typer.Option(metavar="NAME|PATH", help="The device of inputs without one.")] = None,
    milliwatts_per_gbps: Annotated[
        float | None, typer.Option(help="Power of 10^9 bytes a second.  [default: the device's, else 100]")
    ] = None,
    budget: Annotated[str | None, typer.Option(metavar="POWER", help="What the power is set against.  [default: 2.5W]")] = None,
    samples: Annotated[str | None, typer.Option(metavar="N,...", help="Sample counts to reckon too.  [default: 1,2,4,8]")] = None,
    each: Annotated[bool, typer.Option("--each", help="Show two inputs one after the other, not compared.")] = False,
    output: Annotated[list[str] | None, typer.Option(metavar="FORMAT[=FILE]", help="full, json, markdown; =FILE writes there.")] = None,
    chart: Annotated[str | None, typer.Option(metavar="FILE", help="Draw a chart, .svg or .png (extra `chart`).")] = None,
    **shared: Any,
) -> None:
    """Show what a frame costs: MB/s, MiB and mW per pass and attachment; or what a change adds.

    Exits with 0, or with 2 where an input, an option, the configuration or the program failed; the other inputs are still shown.
    """
    given = dict(locals())
    given |= given.pop("shared")
    from .cost import cost as show

    raise typer.Exit(show({name: value for name, value in given.items() if value is not None and value is not False and value != []}))


@app.command()
def device(
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME|PATH]...", help="Built-in devices and reports; - is standard input; none: the running drivers."),
    ] = None,
    output: Annotated[Literal["text", "json", "description"], typer.Option("--output", help="How to print.")] = "text",
    listing: Annotated[bool, typer.Option("--list", help="List the built-in devices.")] = False,
) -> None:
    """Show what a device offers for multisampling."""
    from .device import device as show

    raise typer.Exit(show(names or [], output, listing))


@app.command()
def facts(
    path: Annotated[str | None, typer.Argument(help="An input; none: every fact that a rule may ask.")] = None,
    output: Annotated[Literal["text", "json", "markdown"], typer.Option("--output", help="How to print.")] = "text",
    profile: Annotated[str | None, typer.Option("--profile", metavar="NAME", help="The device of an input without one.")] = None,
) -> None:
    """Show what rules may ask, and what is known of each subject of an input."""
    from .facts import of_input, reference

    raise typer.Exit(reference(output) if path is None else of_input(path, output, profile))


@app.command()
def convert(
    capture: Annotated[str, typer.Argument(metavar="INPUT", help="A capture, source code, or render targets; - is standard input.")],
    output: Annotated[str | None, typer.Option("--output", "-o", metavar="FILE", help="Write there, shaders beside it.")] = None,
    input_format: Annotated[
        Literal[(*CAPTURES, *LANGUAGES)] | None,  # type: ignore[valid-type]
        typer.Option(help="Read the input as this."),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Write over a file that exists.")] = False,
) -> None:
    """Write a capture, source code or render targets as a description that can be read, edited, fixed and confirmed.

    Exits with 0, or with 2 where the input has mistakes or a capture cannot be read to its end; what can be read of that is written.
    """
    from .convert import convert as write

    raise typer.Exit(write(capture, output, input_format, force))


@app.command()
def schema(
    which: Annotated[
        Literal["description", "json-v1", "cost-v1"], typer.Argument(help="Of the description format, or of what --output json prints.")
    ] = "description",
) -> None:
    """Print a JSON Schema."""
    from .schema import schema as print_schema

    raise typer.Exit(print_schema(which))


@app.command()
def baseline(
    paths: Annotated[list[str], typer.Argument(metavar="PATH...", help="What to lint.")],
    file: Annotated[str, typer.Option("--file", help="The baseline file.")] = "msaa-lint-baseline.json",
    prune: Annotated[bool, typer.Option("--prune", help="Only take away what is no longer found.")] = False,
    config: Annotated[str | None, typer.Option("--config", metavar="FILE", help="Use this configuration file.")] = None,
    isolated: Annotated[bool, typer.Option("--isolated", help="Use no configuration file.")] = False,
) -> None:
    """Write down today's findings, so that only new ones are reported."""
    from .baseline import baseline as write

    raise typer.Exit(write(paths, file, prune, config, isolated))


@app.command()
def init(
    folder: Annotated[str, typer.Argument(help="Where.")] = ".",
) -> None:
    """Write a commented configuration, a first description, and print the hook for pre-commit."""
    from .init import init as write

    raise typer.Exit(write(folder))
