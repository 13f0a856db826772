"""Parses the command line by the tables of `options`, and runs the command that it names. Only help
and completion need typer (`app`).
"""

import math
import os
from collections.abc import Iterator, Sequence

from msaa_lint.core.quote import quoted

from .commands import COMMANDS, run
from .common import UsageError, warn
from .options import Arguments, Command, Option

HELP = ("-h", "--help", "--install-completion", "--show-completion")
"""First words that typer answers."""

_MEANINGS = {
    "lint": "check",
    "fix": "check --fix",
    "explain": "rule",
    "rules": "rule --all",
    "version": "--version",
}
"""What others call our commands."""


def run_words(words: Sequence[str]) -> int | list[str]:
    """Runs the command that the words of a command line name, and returns its exit code; the words
    to pass to typer if help or completion is asked for.
    """
    if words[:1] == ["help"]:
        words = [*words[1:2], "--help"]
    if not words or words[0] in HELP:
        return list(words)
    try:
        if words[0] not in COMMANDS:
            raise UsageError(_unknown_command(words[0]))
        arguments = parse(words[0], words[1:])
    except UsageError as error:
        warn(str(error))
        return 2
    return [words[0], "--help"] if arguments.get("help") else run(words[0], arguments)


def parse(name: str, words: Sequence[str]) -> Arguments:
    """The arguments of a command. UsageError if they are malformed, unless they ask for help."""
    command = COMMANDS[name]
    arguments: Arguments = {"paths": []}
    rest = _split_flags(words, command)
    for word in rest:
        if word == "--":
            arguments["paths"].extend(rest)
        elif word == "-" or not word.startswith("-"):
            arguments["paths"].append(word)
        else:
            option, value = _read_option(name, word, rest)
            if option.repeatable:
                arguments.setdefault(option.name, []).append(value)
            else:
                arguments[option.name] = value
            if option.name == "help":
                return arguments
    _check(name, command, arguments)
    return arguments


def _split_flags(words: Sequence[str], command: Command) -> Iterator[str]:
    """The words, with flags of one letter that are written together (`-qv`) one by one."""
    letters = {
        option.short[1:] for option in command.options if option.kind == "flag" and option.short
    }
    for word in words:
        if len(word) > 2 and word[0] == "-" and letters.issuperset(word[1:]):
            yield from (f"-{letter}" for letter in word[1:])
        else:
            yield word


def _read_option(
    name: str, word: str, rest: Iterator[str]
) -> tuple[Option, bool | str | int | float]:
    """The option that a word names, and its value, which may be the next of the words."""
    flags = {
        flag: option
        for option in COMMANDS[name].options
        for flag in (option.flag, option.short)
        if flag
    }
    flag, equals, text = word.partition("=")
    option = flags.get(flag)
    if option is None:
        from msaa_lint.core.suggestions import nearest

        close = nearest(flag, filter(None, (option.flag for option in flags.values())))
        raise UsageError(
            f"unknown option {quoted(flag)} of `{name}`: "
            + (f"did you mean `{close}`?" if close else f"see `msaa-lint {name} --help`")
        )
    if option.kind == "flag":
        if equals:
            raise UsageError(f"`{flag}` takes no value, found {quoted(text)}: write `{flag}` alone")
        return option, True
    value = text if equals else next(rest, None)
    if value is None or (not equals and value.partition("=")[0] in flags):
        raise UsageError(f"`{flag}` needs a value: write `{flag} {option.metavar}`")
    return option, _value(option, value)


def _value(option: Option, text: str) -> str | int | float:
    """What `text` means to an option. UsageError if it is malformed."""
    if (
        option.kind == "choice"
        and text not in option.choices
        and not any(_is_form(choice, text) for choice in option.choices)
    ):
        raise UsageError(
            f"unknown value {quoted(text)} of `{option.flag}`: {_near_or_all(text, option.choices)}"
        )
    if option.kind == "integer":
        if not (text.isascii() and text.isdigit() and len(text) < 12 and int(text) > 0):
            raise UsageError(
                f"`{option.flag}` must be an integer from 1 to {10**11 - 1}, found {quoted(text)}"
            )
        return int(text)
    if option.kind == "decimal":
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not (math.isfinite(number) and number > 0):
            raise UsageError(f"`{option.flag}` must be a number above 0, found {quoted(text)}")
        return number
    return text


def _is_form(choice: str, text: str) -> bool:
    """Whether a text is one of the form `choice`: that of `label:TEXT` is any text after
    `label:`.
    """
    prefix, colon, _ = choice.partition(":")
    return bool(colon) and text.startswith(prefix + colon) and text != prefix + colon


def _check(name: str, command: Command, arguments: Arguments) -> None:
    """UsageError for too few or too many arguments, and for options that contradict each other."""
    stated, paths = arguments["paths"], command.paths
    if len(stated) < paths.min and not any(flag in arguments for flag in command.standalone):
        flags = "".join(f", or `--{flag.replace('_', '-')}`" for flag in command.standalone)
        raise UsageError(
            f"`{name}` needs an argument: write `msaa-lint {name} {paths.metavar}`{flags}"
        )
    if paths.max is not None and len(stated) > paths.max:
        takes = f"takes only one {paths.metavar}" if paths.max else "takes no arguments"
        raise UsageError(f"unexpected argument {quoted(stated[paths.max])}: `{name}` {takes}")
    for word in stated if paths.choices else ():
        if word not in paths.choices:
            raise UsageError(
                f"unknown argument {quoted(word)} of `{name}`: {_near_or_all(word, paths.choices)}"
            )
    if arguments.get("quiet") and arguments.get("verbose"):
        raise UsageError("`--quiet` and `--verbose` contradict each other: write one of them")


def _unknown_command(word: str) -> str:
    """What to write instead of a word that is not a command."""
    flag = word.partition("=")[0]
    if word.startswith("-") and word != "-":
        for name, command in COMMANDS.items():
            if any(flag in (option.flag, option.short) for option in command.options):
                return (
                    f"{quoted(flag)} is an option of a command: write it after the command, as "
                    f"in `msaa-lint {name} {flag} ...`"
                )
        return f"unknown option {quoted(flag)}: " + _near_or_all(flag, [*HELP[1:], "--version"])
    if word in _MEANINGS:
        return f"unknown command {quoted(word)}: did you mean `{_MEANINGS[word]}`?"
    if word == "-" or os.path.exists(word) or os.sep in word or "." in word:
        import shlex

        return (
            f"unknown command {quoted(word)}: to lint a file or folder, write `msaa-lint check "
            f"{shlex.quote(word)[:200]}`"
        )
    return f"unknown command {quoted(word)}: {_near_or_all(word, list(COMMANDS))}"


def _near_or_all(word: str, words: Sequence[str]) -> str:
    from msaa_lint.core.suggestions import near_or_all

    return near_or_all(word, words)
