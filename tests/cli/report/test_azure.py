import re

import pytest

from msaa_lint.core.finding import Fix, Price
from msaa_lint.core.text.span import Span
from tests.cli.report.hostile import TOKENS
from tests.cli.report.sample import finding, frame, printed, result

_DECODED = {"%3B": ";", "%0D": "\r", "%0A": "\n", "%5D": "]"}


def parsed(line: str) -> tuple[dict[str, str], str]:
    """The properties and the text of a command, as the agent reads it: it finds the command
    anywhere in a line, and decodes percent signs last.
    """
    head, _, rest = line.partition("##vso[")
    command, _, text = rest.partition("]")
    name, _, joined = command.partition(" ")
    assert (head, name) == ("", "task.logissue")
    pairs = [pair.split("=", 1) for pair in joined.split(";") if pair]
    return {key: decoded(value) for key, value in pairs}, decoded(text)


def decoded(text: str) -> str:
    for escape, character in _DECODED.items():
        text = text.replace(escape, character)
    return text.replace("%AZP25", "%")


def test_worst_first_and_one_command_each() -> None:
    commands = [parsed(line) for line in printed("azure", frame()).splitlines()]
    assert [properties["type"] for properties, _ in commands] == [
        "error",
        "error",
        "warning",
        "warning",
        "warning",
    ]
    stored = {
        "type": "warning",
        "sourcepath": "passes/forward.yaml",
        "linenumber": "9",
        "columnnumber": "18",
        "code": "MSAA201",
    }
    assert commands[2] == (
        stored,
        "multisampled-attachment-stored: multisampled attachment `color` is resolved and also "
        "stored\n"
        "cost: +2248 MB/s written, +31.6 MiB of memory, +225 mW\nhelp: set `storeOp: DONT_CARE`",
    )
    binary = {"type": "warning", "sourcepath": "trace.rdc", "code": "MSAA101"}
    assert commands[3] == (binary, "note: sample-count-above-four: 8 samples")
    unread = {
        "type": "warning",
        "sourcepath": "src/render.cpp",
        "linenumber": "2",
        "columnnumber": "8",
        "code": "MSAA931",
    }
    assert commands[4] == (unread, "note: unread-input: `samples = count` is in no pass")


def test_nothing_found_prints_nothing() -> None:
    assert printed("azure", result(files=("a.yaml",))) == ""


def test_escapes() -> None:
    line = printed(
        "azure",
        result(
            finding("100% a;b]c\n%3B%AZP25", file="a;b]c%.yaml", rule="r;]", fix=Fix("50%", True))
        ),
    )
    assert line == (
        "##vso[task.logissue type=warning;sourcepath=a%3Bb%5Dc%AZP25.yaml;code=MSAA201;]"
        "r;]: 100%AZP25 a;b]c\\n%AZP253B%AZP25AZP25%0Ahelp: 50%AZP25\n"
    )


@pytest.mark.parametrize(
    "token",
    [*TOKENS, "##vso[task.setvariable variable=PATH]x", ";type=error;", "]", "\u0085", "\u2029"],
)
def test_no_text_of_an_input_is_a_command(token: str) -> None:
    run = result(
        finding(token, file=f"{token}.yaml", rule=token, help=token, span=Span(0, 1)), text="a"
    )
    (line,) = printed("azure", run).splitlines()
    properties, text = parsed(line)
    assert list(properties) == ["type", "sourcepath", "linenumber", "columnnumber", "code"]
    assert properties["type"] == "warning" and line.isprintable()
    assert not re.search(r"##\w*\[", line.removeprefix("##vso["))
    assert text.count("\n") == (1 if token.strip() else 0)


def test_the_first_ten_are_the_most_important() -> None:
    many = [finding(str(n), price=Price(0.0, 0.0, 0.0, float(n))) for n in range(12)]
    texts = [parsed(line)[1] for line in printed("azure", result(*many)).splitlines()]
    assert [text.partition(": ")[2].partition("\n")[0] for text in texts] == [
        str(n) for n in range(11, -1, -1)
    ]
