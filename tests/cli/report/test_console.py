import pytest
from rich.text import Text

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.console import cell, new_table, open_console


@pytest.mark.parametrize("color", [False, True])
def test_no_line_begins_with_what_a_runner_obeys(color: bool) -> None:
    """Not in a cell that the table folds, nor in a line of its own, indented or not."""
    printed: list[str] = []
    console = open_console(printed.append, Options(color=color, width=24))
    table = new_table()
    table.add_column("file", overflow="fold")
    table.add_column("pass", overflow="fold")
    for name in ("::error::x", "a" * 11 + "::error::x", " ::set-env::"):
        table.add_row(cell(name, "bold red"), cell(name))
    console.print(table)
    for line in ("::error::x", "  ::error::x", Text("::error::x", style="red")):
        console.print(line, soft_wrap=True)
    text = "".join(printed)
    plain = Text.from_ansi(text).plain
    assert not [line for line in plain.splitlines() if line.lstrip().startswith("::")]
    assert plain.count("\\x3a:") >= 5
    assert "a::b" in _printed("a::b")


def _printed(text: str) -> str:
    printed: list[str] = []
    open_console(printed.append, Options()).print(text)
    return "".join(printed)
