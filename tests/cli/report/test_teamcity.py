import re

import pytest

from msaa_lint.core.text.span import Span
from tests.cli.report.hostile import TOKENS
from tests.cli.report.sample import RULES, finding, frame, printed, result

_ESCAPE = re.compile(r"\|(?:0x((?i:[0-9a-f]{4}))|(.))")


def parsed(line: str) -> tuple[str, dict[str, str]]:
    """The name and the attributes of a service message, by TeamCity's grammar."""
    message = re.fullmatch(r"##teamcity\[(\w+)((?: \w+='(?:[^|'\[\]]|\|.)*')+)\]", line)
    assert message, line
    values = re.findall(r" (\w+)='((?:[^|'\[\]]|\|.)*)'", message[2])
    return message[1], {name: unescaped(text) for name, text in values}


def unescaped(text: str) -> str:
    """The text of an attribute."""
    units = _ESCAPE.sub(
        lambda match: (
            chr(int(match[1], 16)) if match[1] else {"n": "\n", "r": "\r"}.get(match[2], match[2])
        ),
        text,
    )
    return units.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "surrogatepass")


def test_inspections() -> None:
    messages = [parsed(line) for line in printed("teamcity", frame()).splitlines()]
    assert [name for name, _ in messages] == ["inspectionType", "inspection"] * 5
    kind, stored = messages[2][1], messages[3][1]
    assert kind == {
        "id": "MSAA201",
        "name": "multisampled-attachment-stored",
        "category": "msaa-lint",
        "description": f"MSAA201: {RULES[2].summary}",
    }
    assert stored == {
        "typeId": "MSAA201",
        "message": "multisampled attachment `color` is resolved and also stored\n"
        "cost: +2248 MB/s written, +31.6 MiB of memory, +225 mW\nhelp: set `storeOp: DONT_CARE`",
        "file": "passes/forward.yaml",
        "line": "9",
        "SEVERITY": "WARNING",
    }
    assert (
        messages[1][1]["SEVERITY"] == "ERROR" and "is not readable" in messages[0][1]["description"]
    )
    assert messages[7][1] == {
        "typeId": "MSAA101",
        "message": "8 samples",
        "file": "trace.rdc",
        "SEVERITY": "INFO",
    }
    unread = {
        "typeId": "MSAA931",
        "message": "`samples = count` is in no pass",
        "file": "src/render.cpp",
        "line": "2",
        "SEVERITY": "INFO",
    }
    assert messages[9][1] == unread


def test_a_rule_is_described_once() -> None:
    names = [
        parsed(line)[0]
        for line in printed("teamcity", result(finding("a"), finding("b"))).splitlines()
    ]
    assert names == ["inspectionType", "inspection", "inspection"]


def test_nothing_found_prints_nothing() -> None:
    assert printed("teamcity", result(files=("a.yaml",))) == ""


def test_escapes() -> None:
    _, line = printed(
        "teamcity",
        result(finding("it's [a|b] \u65e5\U0001f600\n\r\u0085\u2028.", file="[|'].yaml")),
    ).splitlines()
    assert line == (
        "##teamcity[inspection typeId='MSAA201' message='it|'s |[a||b|] "
        "|0x65E5|0xD83D|0xDE00\\n\\r\\x85\\u2028.' "
        "file='|[|||'|].yaml' SEVERITY='WARNING']"
    )


@pytest.mark.parametrize(
    "token", [*TOKENS, "']##teamcity[buildStop comment='x']", "|", "|n", "]", "\u0085", "\u2029"]
)
def test_no_text_of_an_input_is_a_message(token: str) -> None:
    text = printed(
        "teamcity",
        result(
            finding(token, file=f"{token}.yaml", rule=token, help=token, span=Span(0, 1)), text="a"
        ),
    )
    assert re.fullmatch(r"[\n -~]*", text)
    (_, kind), (_, inspection) = map(parsed, text.splitlines())
    assert list(kind) == ["id", "name", "category", "description"]
    assert list(inspection) == ["typeId", "message", "file", "line", "SEVERITY"]
    assert inspection["message"].count("\n") == (1 if token.strip() else 0)


def test_lengths_that_teamcity_accepts() -> None:
    long = "|" * 5000
    (_, kind), (_, inspection) = map(
        parsed,
        printed(
            "teamcity", result(finding(long, code="GAME001", rule=long, file=long, help=long))
        ).splitlines(),
    )
    assert [len(kind[key]) for key in ("name", "description")] == [255, 4000]
    assert [len(inspection[key]) for key in ("message", "file")] == [4000, 4000]
