import pytest
from rich.text import Text

from msaa_lint.cli.report import Options
from msaa_lint.cli.report.console import cell, open_console
from msaa_lint.cli.report.tables import NAME, Column, Table, print_tables


@pytest.mark.parametrize("color", [False, True])
def test_no_line_begins_with_what_a_runner_obeys(color: bool) -> None:
    """Not in a name that a table breaks, nor in a line of its own, indented or not."""
    printed: list[str] = []
    options = Options(color=color, width=24)
    rows = [("", [cell(name, "bold red"), cell(name)]) for name in ("::error::x", "a" * 12 + "::error::x", " ::set-env::")]
    print_tables(printed.append, options, [Table([Column("file", NAME), Column("pass", NAME)], rows)])
    for line in ("::error::x", "  ::error::x", Text("::error::x", style="red"), "a::b"):
        open_console(printed.append, options).print(line, soft_wrap=True)
    plain = Text.from_ansi("".join(printed)).plain
    assert not [line for line in plain.splitlines() if line.lstrip().startswith("::")]
    assert plain.count("\\x3a:") >= 5 and "a::b" in plain
