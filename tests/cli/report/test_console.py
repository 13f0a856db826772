import pytest
from rich.text import Text

from msaa_lint.cli.fix_report import unified_diff
from msaa_lint.cli.report import Options
from msaa_lint.cli.report.console import cell, open_console
from msaa_lint.cli.report.tables import NAME, Column, Table, print_tables


@pytest.mark.parametrize("color", [False, True])
def test_no_line_begins_with_what_a_runner_obeys(color: bool) -> None:
    """Not in a name that a table breaks, nor in a line of its own, indented or not."""
    printed: list[str] = []
    options = Options(color=color, width=24)
    rows = [
        ("", [cell(name, "bold red"), cell(name)])
        for name in ("::error::x", "a" * 12 + "::error::x", " ::set-env::")
    ]
    print_tables(
        printed.append, options, [Table([Column("file", NAME), Column("pass", NAME)], rows)]
    )
    for line in ("::error::x", "  ::error::x", Text("::error::x", style="red"), "a::b"):
        open_console(printed.append, options).print(line, soft_wrap=True)
    plain = Text.from_ansi("".join(printed)).plain
    assert not [line for line in plain.splitlines() if line.lstrip().startswith("::")]
    assert plain.count("\\x3a:") >= 5 and "a::b" in plain


def test_no_line_of_a_diff_begins_so() -> None:
    before = "a: |\n  ::error::x\n::error::y\nb: 1\nc::d: 1\n"
    lines = list(unified_diff(before, before.replace("b: 1", "::error::z"), "x"))
    assert [line for line in lines if line.lstrip().startswith("::")] == []
    assert lines[3:] == [
        " a: |\n",
        "   \\x3a:error::x\n",
        " \\x3a:error::y\n",
        "-b: 1\n",
        "+::error::z\n",
        " c::d: 1\n",
    ]
