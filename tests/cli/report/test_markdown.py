import re

import pytest
from hypothesis import HealthCheck, given
from markdown_it import MarkdownIt

from msaa_lint.cli.report.escape import display
from msaa_lint.cli.report.markdown import MAX_COMMENT, escape_markdown
from msaa_lint.core.finding import Result
from msaa_lint.core.text.span import Span
from tests.cli.report.hostile import TOKENS, results, texts
from tests.cli.report.sample import finding, frame, printed, result
from tests.strength import examples

PARSER = MarkdownIt("commonmark").enable(["table", "strikethrough"])


def test_clean_run_is_one_sentence() -> None:
    assert (
        printed("markdown", result(files=("a.yaml",)))
        == "<!-- msaa-lint -->\n### msaa-lint\n\nNo findings in 1 file\n"
    )


def test_table_has_the_worst_first() -> None:
    rows = [line for line in printed("markdown", frame()).split("\n") if line.startswith("| ")][2:]
    assert [row.split(" | ")[0] for row in rows] == ["| error", "| error", "| warning", "| note"]
    assert (
        rows[1]
        == "| error | resolve-target-loaded | passes/forward.yaml:10:60 | resolve target is loaded "
        "| +562 MB/s read, +5.62 mW |"
    )


@given(texts)
def test_literal_is_text_and_nothing_else(text: str) -> None:
    text = display(text)
    (inline,) = [
        token for token in PARSER.parse(f"x {escape_markdown(text)}") if token.type == "inline"
    ]
    assert {token.type for token in inline.children} == {"text"} | (
        {"text_special"} & {token.type for token in inline.children}
    )
    assert (
        "".join(token.content for token in inline.children).replace("\u200b", "")
        == f"x {text}".rstrip()
    )


@pytest.mark.parametrize(
    ("text", "forbidden"),
    [
        ("@octocat", "@octocat"),
        ("see #1 and !2", "#1"),
        ("see #1 and !2", "!2"),
        ("GH-1", "GH-1"),
        ("http://evil.example", "http://"),
        ("www.evil.example", "www."),
        ("WWW.evil.example", "WWW."),
        ("a@b.example", "@b"),
        ("~label", "~label"),
    ],
)
def test_forges_find_no_reference_in_the_finished_page(text: str, forbidden: str) -> None:
    page = "".join(token.content for token in PARSER.parseInline(escape_markdown(text))[0].children)
    assert forbidden not in page
    assert page.replace("\u200b", "") == text
    assert forbidden not in escape_markdown(text)


@examples(0.6, suppress_health_check=[HealthCheck.too_slow])
@given(results())
def test_nothing_breaks_out(run: Result) -> None:
    text = printed("markdown", run)
    tokens = PARSER.parse(text)
    assert sum(token.type == "tr_open" for token in tokens) == (
        len(run.findings) + 1 if run.findings else 0
    )
    assert sum(token.type == "td_open" for token in tokens) == 5 * len(run.findings)
    fences = [token for token in tokens if token.type == "fence"]
    assert len(fences) == len(run.findings)
    html = [token.content.strip() for token in tokens if token.type == "html_block"]
    assert all(
        re.fullmatch("<!-- msaa-lint -->|<details><summary>[^<>]*</summary>|</details>", block)
        for block in html
    )
    for token in tokens:
        assert {child.type for child in token.children or ()} <= {"text", "text_special"}
    assert {token.type for token in tokens if token.type.endswith("_open")} <= {
        "heading_open",
        "paragraph_open",
        "table_open",
        "thead_open",
        "tbody_open",
        "tr_open",
        "th_open",
        "td_open",
    }


@pytest.mark.parametrize("token", TOKENS)
def test_fence_is_longer_than_any_in_the_source(token: str) -> None:
    run = result(finding(token, span=Span(0, 1)), text=f"``````{token}")
    (fence,) = [found for found in PARSER.parse(printed("markdown", run)) if found.type == "fence"]
    assert "1 | ``````" in fence.content


def test_comment_is_never_longer_than_a_forge_takes() -> None:
    text = printed(
        "markdown", result(*(finding("x" * 500, span=Span(0, 1)) for _ in range(500)), text="abc")
    )
    assert len(text) <= MAX_COMMENT
    assert re.search(r"\n\d+ more findings not shown\.\n", text)
    assert re.search(r"\nThe details of \d+ more findings do not fit into this comment\.\n$", text)
    assert text.count("<details>") == text.count("</details>") > 10
