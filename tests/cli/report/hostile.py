"""What a stranger's input may hold."""

from __future__ import annotations

from hypothesis import strategies as st

from msaa_lint.core.finding import (
    CONFIDENCES,
    SEVERITIES,
    CaptureLocation,
    CaptureSummary,
    Finding,
    Fix,
    InputSummary,
    MissingKey,
    Price,
    Result,
    Suppressed,
    Undecided,
    Unread,
)
from msaa_lint.core.text.span import Edit, Label, Span
from tests.cli.report.sample import RULES, Source

TOKENS = (
    "\x1b[2J",
    "\x1b]0;x\x07",
    "\u202e",
    "\u2028",
    "\x85",
    "\r\n",
    "\n",
    "\r",
    "\t",
    "\x00",
    "\ud800",
    "\udc80",
    "\ufffe",
    "e\u0301\u0301\u0301\u0301\u0301\u0301",
    "日本",
    "::error::x",
    "::stop-commands::x",
    "##[error]x",
    "%0A::warning::",
    "|",
    "\\|",
    "\\",
    "`",
    "````",
    "</details>",
    "<script>alert(1)</script>",
    "<!--",
    "-->",
    "@octocat",
    "#1",
    "GH-1",
    "a@b.example",
    "http://evil.example/",
    "www.evil.example",
    "[x](http://evil.example)",
    "![x](y)",
    "](1)",
    "**b**",
    "_u_",
    "~~s~~",
    "$x$",
    "&lt;",
    "&#60;",
    "]]>",
    "'\"",
    "{0}",
    "./",
    "../",
    "/",
    ":",
    ",",
    "a: {b: 1}",
)

texts = st.lists(
    st.one_of(st.sampled_from(TOKENS), st.text(st.characters(exclude_categories=()), max_size=5)),
    max_size=5,
).map("".join)
names = texts.map(lambda text: text or "x")
figures = st.one_of(st.floats(), st.just(0.0))
counts = st.one_of(st.none(), st.integers(0, 2**63))


@st.composite
def findings(draw: st.DrawFn, text: str, file: str) -> Finding:
    spans = st.tuples(st.integers(0, len(text)), st.integers(0, len(text))).map(
        lambda ends: Span(min(ends), max(ends))
    )
    labels = st.lists(st.builds(Label, spans, texts), max_size=4).map(tuple)
    edits = st.lists(st.builds(Edit, spans, texts), max_size=2).map(tuple)
    made = st.builds(
        Finding,
        code=st.sampled_from(["MSAA101", "MSAA901", "ACME1"]),
        rule=names,
        severity=st.sampled_from(SEVERITIES),
        confidence=st.sampled_from(CONFIDENCES),
        message=texts,
        file=st.just(file),
        span=st.one_of(spans, st.none()),
        subject=texts,
        labels=labels,
        notes=st.lists(texts, max_size=2).map(tuple),
        help=texts,
        fix=st.one_of(
            st.none(),
            st.builds(Fix, texts, st.booleans(), edits, st.booleans(), st.booleans(), texts),
        ),
        price=st.one_of(st.none(), st.builds(Price, figures, figures, figures, figures)),
        capture_location=st.one_of(
            st.none(),
            st.builds(
                CaptureLocation,
                texts,
                counts,
                st.one_of(st.none(), st.integers(1, 240)),
                st.just(240),
            ),
        ),
    )
    return draw(made)


@st.composite
def results(draw: st.DrawFn) -> Result:
    """A run over one or two files. One of them may have no text."""
    files = draw(st.lists(names, min_size=1, max_size=2, unique=True))
    sources = {file: Source(file, draw(texts)) for file in files[: draw(st.integers(0, 2))]}
    found: list[Finding] = []
    silenced: list[Suppressed] = []
    for file in files:
        one = findings(sources[file].text if file in sources else "", file)
        found += draw(st.lists(one, max_size=3))
        silenced += draw(
            st.lists(
                st.builds(Suppressed, one, st.sampled_from(["inline", "baseline"]), texts),
                max_size=1,
            )
        )
    lacking = st.lists(texts, min_size=1, max_size=3).map(tuple)
    key = st.builds(
        MissingKey,
        texts,
        texts,
        texts,
        st.builds(Span, st.integers(0, 5), st.integers(5, 9)),
        st.booleans(),
    )
    keys = st.lists(key, max_size=2).map(tuple)
    undecided = draw(
        st.lists(
            st.builds(Undecided, names, names, st.sampled_from(files), texts, lacking, keys),
            max_size=2,
        )
    )
    places = st.one_of(
        st.none(), st.tuples(st.integers(0, 20), st.integers(20, 40)).map(lambda ends: Span(*ends))
    )
    unread = st.one_of(st.none(), st.builds(Unread, places, texts))
    n = st.integers(0, 3)
    formats = st.sampled_from(["description", "fossilize", "cpp", ""])
    passes = st.dictionaries(n, n, max_size=3)
    captures = st.one_of(
        st.none(), st.builds(CaptureSummary, texts, texts, texts, n, n, passes, n, n, texts, n)
    )
    terms = (
        formats,
        n,
        n,
        n,
        n,
        n,
        st.booleans(),
        unread,
        captures,
        st.one_of(st.none(), n),
        texts,
    )
    inputs = [draw(st.builds(InputSummary, st.just(file), *terms)) for file in files]
    return Result(found, undecided, silenced, files, sources, RULES, inputs=inputs)
