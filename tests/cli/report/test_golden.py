"""Every output of one run, byte for byte. UPDATE=1 rewrites the files."""

import os

import pytest

from msaa_lint.core.text.span import Label, Span
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from tests.cli.report.sample import finding, frame, printed, result, span
from tests.paths import ROOT

GOLDEN = ROOT / "tests" / "golden" / "report"


def check(name: str, text: str) -> None:
    path = GOLDEN / name
    if os.environ.get("UPDATE"):
        path.write_bytes(text.encode())
    assert text == path.read_bytes().decode()


SUFFIXES = {
    "json": "json",
    "sarif": "sarif",
    "gitlab": "json",
    "rdjson": "json",
    "junit": "xml",
    "markdown": "md",
    "html": "html",
}


@pytest.mark.parametrize("name", OUTPUT_FORMATS)
def test_format(name: str) -> None:
    text = printed(name, frame())
    # The style and the script of a page are files of the package.
    check(
        f"{name}.{SUFFIXES.get(name, 'txt')}",
        text[text.index("<main") : text.index("</main>")] if name == "html" else text,
    )


def test_full_in_color_with_all_options() -> None:
    check(
        "full-color.txt",
        printed(
            "full",
            frame(),
            color=True,
            show_suppressed=True,
            statistics=True,
            max_undecided=1,
            explain_undecided=True,
        ),
    )


def test_excerpts() -> None:
    """The layouts that an ordinary frame does not have."""
    nested = "a:\n  - b: {c: 1,\n       d: 2}\n    e: 3\nf: 4\n"
    long = "a:\n" + "".join(f"  key{i}: {i}\n" for i in range(20))
    row = "x: [aaa, bbb, ccc, ddd]"
    wide = 'k: "\t日本語 e\u0301 \x1b[31m \u202e" # x'
    minified = "{" + '"samples":4,' * 100 + '"z":1}'
    cases = {
        "a mapping over two lines": (nested, span(nested, "{c: 1,\n       d: 2}"), {}),
        "three marks, two of them over several lines": (
            nested,
            span(nested, nested[nested.index("b:") : nested.index("\nf")]),
            {"mapping": span(nested, "{c: 1,\n       d: 2}"), "three": span(nested, "3")},
        ),
        "many lines": (long, Span(3, len(long)), {"last key": span(long, "key19")}),
        "several labels on one line": (
            row,
            span(row, "aaa"),
            {"second": span(row, "bbb"), "third": span(row, "ccc"), "fourth": span(row, "ddd")},
        ),
        "one mark inside another": (
            row,
            span(row, "[aaa, bbb, ccc, ddd]"),
            {"inner": span(row, "bbb")},
        ),
        "tabs, wide, combining and control characters": (
            wide,
            span(wide, "\x1b[31m"),
            {"book": span(wide, "本"), "hash": span(wide, "#")},
        ),
        "a long line": (minified, Span(601, 610), {"near": Span(613, 622), "far": Span(1, 10)}),
        "the end of the file": ("a:\n", Span(3, 3), {}),
    }
    shown = []
    for title, (text, place, labels) in cases.items():
        run = result(
            finding(
                title,
                span=place,
                labels=tuple(Label(where, said) for said, where in labels.items()),
            ),
            text=text,
        )
        shown.append(printed("full", run, width=72))
    check("excerpts.txt", "".join(shown))
