"""What a stranger may hand in: each ends in one clear problem or a right tree, soon."""

from __future__ import annotations

import random
from typing import Any

import pytest

from msaa_lint.core.text import events
from msaa_lint.core.text.comments import comments
from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Limits, parse
from tests.core.text.reading import nodes, one, plain, reading, trouble

DESCRIPTION = """\
%YAML 1.2
---
# A frame.
frame: {width: 1920, height: 1080, fps: 60.0}
images:
  "color\\u00e9\\ud83d\\ude00": &ms
    format: R8G8B8A8_UNORM   # 32 bits
    samples: !!int 4
    usage: [COLOR_ATTACHMENT, 'TRANSIENT_ATTACHMENT',]
  other: {<<: *ms, samples: 8}
note: >-
  Two lines
  of text.

commands:
- draw: {pipeline: ~}
-
  - nested
...
"""


@pytest.fixture
def events_read(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The events that are asked for."""
    made: list[Any] = []
    parser = events.parser

    class Watched:
        def __init__(self, text: Any) -> None:
            self.parser = parser(text)

        def get_event(self) -> Any:
            made.append(self.parser.get_event())
            return made[-1]

    monkeypatch.setattr(events, "parser", Watched)
    return made


@pytest.mark.usefixtures("stack")
class TestDepth:
    @pytest.mark.parametrize(
        ("opening", "at"),
        [
            ("[", 100),
            ("{a: ", 400),
            ("{a:\n", 400),
            ("- ", 200),
            ("[{a: ", 250),
            ("[a: ", 200),
            ("[\n", 200),
        ],
    )
    def test_it_ends_at_the_limit(
        self, stack: str, opening: str, at: int, events_read: list[Any]
    ) -> None:
        text = opening * (100_000 if stack == "libyaml" else 1_000)
        problem = trouble(text)
        assert len(events_read) < 400
        # libyaml from 0.2.6 on gives up at its own limit, 1000, where it reads that far ahead
        # before the first event.
        start = 1000 if (stack, opening) == ("libyaml", "[") and len(events_read) < at else at
        assert problem == (
            "MSAA906",
            "the nesting exceeds the limit of 100",
            Span(start, start + 1),
            (),
        )

    def test_indented_ever_further(self) -> None:
        text = "".join(" " * depth + "a:\n" for depth in range(300))
        assert trouble(text).code == "MSAA906"
        root = one("".join(" " * depth + "a:\n" for depth in range(100)))
        assert len(nodes(root)) == 201

    def test_just_deep_enough(self) -> None:
        text = "[" * 100 + "]" * 100
        node = one(text)
        for depth in range(100):
            assert (node.start, node.end) == (depth, 200 - depth)
            node = node.value[0] if node.value else node
        assert trouble("[" * 101 + "]" * 101).span == Span(100, 101)

    def test_aliases_count(self) -> None:
        lines = ["- &a0 [x]", *(f"- &a{n} [*a{n - 1}]" for n in range(1, 200))]
        problem = trouble("\n".join(lines))
        # The list at the top is one; `a98` is the 99th within it.
        assert problem.code == "MSAA906"
        assert "aliases expanded" in problem.message
        assert "\n".join(lines)[problem.span.start : problem.span.end] == "*a98"
        assert reading("\n".join(lines[:99])).problems == []

    def test_aliases_in_a_key_and_beside_each_other(self) -> None:
        assert reading("[&a [&b [x]], [*b], *a, [*a]]", depth=4).problems == []
        assert trouble("[&a [&b [x]], [*b], *a, [*a]]", depth=3).span == Span(25, 27)

    def test_a_document_has_its_own_depth(self) -> None:
        assert reading("--- [[[1]]]\n" * 50, depth=3).problems == []


@pytest.mark.usefixtures("stack")
class TestNodes:
    @pytest.mark.parametrize(
        ("text", "count"),
        [
            ("1", 1),
            ("[1, 2]", 3),
            ("{a: 1, b: [2]}", 6),
            ("[&a [1, 2], *a, *a]", 10),
            ("{a: &a {b: 1}, c: *a, d: {<<: *a}}", 15),
            ("--- 1\n--- [2]\n---\n", 4),
            ("[&a x, *a, *a]", 4),
            ("{x: 1, x: [2]}", 6),
        ],
    )
    def test_all_are_counted_once_aliases_are_expanded(self, text: str, count: int) -> None:
        assert [p.code for p in reading(text, nodes=count).problems] == [
            p.code for p in reading(text).problems
        ]
        problems = reading(text, nodes=count - 1).problems
        message = f"the number of nodes with aliases expanded exceeds the limit of {count - 1}"
        assert (problems[-1].code, problems[-1].message) == ("MSAA906", message)

    def test_an_alias_bomb(self, events_read: list[Any]) -> None:
        lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
        lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 10)]
        text = "\n".join(lines)
        problem = trouble(text)
        assert problem.code == "MSAA906"
        assert text[problem.span.start : problem.span.end] == "*a4"
        assert len(events_read) < 200

    def test_an_alias_bomb_of_mappings_and_keys(self) -> None:
        lines = [
            "a0: &a0 {x: 1}",
            *(f"a{n}: &a{n} {{l: *a{n - 1}, r: *a{n - 1}}}" for n in range(1, 60)),
        ]
        assert trouble("\n".join(lines)).code == "MSAA906"

    def test_merges_that_double(self) -> None:
        lines = [
            "a0: &a0 {x0: 0}",
            *(f"a{n}: &a{n} {{<<: [*a{n - 1}, *a{n - 1}], x{n}: {n}}}" for n in range(1, 30)),
        ]
        assert trouble("\n".join(lines)).code == "MSAA906"
        root = one("\n".join(lines[:10]))
        assert plain(root)["a9"] == {f"x{n}": n for n in range(10)}

    def test_merges_of_a_wide_mapping(self) -> None:
        wide = ", ".join(f"k{n}: 1" for n in range(500))
        lines = [f"- &a {{{wide}}}", *["- <<: *a"] * 2000]
        documents, problems = reading("\n".join(lines))
        assert (documents, [p.code for p in problems]) == ([], ["MSAA906"])

    def test_exactly_the_default(self) -> None:
        # 1 + 1001 + 998 aliases of 1001 nodes each, and 1 more.
        text = "[&a [" + "x," * 1000 + "]," + "*a," * 998 + "]"
        assert reading(text, nodes=1 + 999 * 1001).problems == []
        assert trouble(text, nodes=999 * 1001).code == "MSAA906"

    def test_empty_documents_count(self) -> None:
        assert reading("---\n" * 1000) == ([], [])
        problem = trouble("---\n" * 1001, nodes=1000)
        assert problem.code == "MSAA906"


def test_more_than_a_million_nodes() -> None:
    documents, problems = reading("[" + "1," * 1_000_001 + "]")
    assert documents == []
    # The list is a node too: the millionth number is one too many.
    assert [(p.code, p.span) for p in problems] == [
        ("MSAA906", Span(2 * 1_000_000 - 1, 2 * 1_000_000))
    ]


@pytest.mark.usefixtures("stack")
class TestSize:
    def test_a_long_line(self) -> None:
        text = "[" + "aé𝄞, " * 5_000 + "{x: 'y'}]"
        root = one(text)
        last = root.value[-1].value["x"]
        assert len(root.value) == 5_001
        assert text[last.start : last.end] == "'y'"
        assert Source("x", text).position(last.start) == (1, len(text) - 4)

    def test_many_documents(self) -> None:
        documents, problems = reading("--- {a: 1}\n" * 2000)
        assert problems == []
        assert [d.start for d in documents] == [11 * n + 4 for n in range(2000)]

    def test_many_tag_directives(self) -> None:
        text = "".join(f"%TAG !t{n}! tag:example.org,{n}:\n" for n in range(5_000)) + "--- a\n"
        problem = trouble(text)
        assert problem.code == "MSAA906"
        assert text[problem.span.start : problem.span.end + 7] == "%TAG !t100!"
        assert comments(Source("x", text), []) == []
        assert plain(one("a: |\n" + "  %TAG\n" * 200))["a"] == "%TAG\n" * 200

    def test_numbers_of_many_digits_are_texts(self) -> None:
        digits = "9" * 50_000
        texts = [
            digits,
            "-" + digits,
            "0x" + digits,
            "0o" + 50_000 * "7",
            "1." + digits,
            "1e" + digits,
        ]
        assert plain(one(f"[{', '.join(texts)}]")) == texts


@pytest.mark.parametrize(
    ("before", "after"), [("", ""), ("'", "'"), ('"', '"'), ("|\n  ", ""), (">-\n  ", "\n\n")]
)
def test_ten_megabytes_of_one_scalar(before: str, after: str) -> None:
    body = "x" * 10_000_000
    text = f"a: {before}{body}{after}"
    node = one(text).value["a"]
    assert node.value == body
    assert (node.start, node.end) == (3, len(text.rstrip("\n")))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("{}: 1", None),
        ('{{"{}": 1}}', "a key must be on the line of its `:` and have at most 1024 characters"),
        ("'{}': 1", ""),
        ("? {}\n: 1", None),
        ("'{}", "is never closed"),
        ("# {}", None),
        ("&{} a", None),
        ("*{}", "is not defined"),
        ("!{} a", "is not supported"),
        ("%{}", "directive"),
    ],
)
def test_two_megabytes_of_one_key_or_name(text: str, code: str | None) -> None:
    text = text.format("k" * 2_000_000)
    documents, problems = reading(text)
    assert len(documents) + len(problems) in (0, 1, 2)
    assert all(len(problem.message) < 300 for problem in problems)
    if problems and code is not None:
        assert code in problems[0].message
    if text.startswith("?"):
        assert plain(documents[0]) == {"k" * 2_000_000: 1}


@pytest.mark.usefixtures("stack")
@pytest.mark.parametrize(
    "text",
    [
        "\n" * 50_000,
        "a:\n" + "   \n" * 10_000 + " b",
        "'" + "''" * 50_000 + "'",
        '"' + "\\\n" * 20_000 + '"',
        "#\n" * 20_000,
    ],
)
def test_long_texts_of_little(text: str) -> None:
    documents, problems = reading(text)
    assert problems == []
    assert len(documents) <= 1


@pytest.mark.usefixtures("stack")
def test_truncated_at_every_character() -> None:
    whole = plain(one(DESCRIPTION))
    assert whole["images"]["other"] == {
        "format": "R8G8B8A8_UNORM",
        "samples": 8,
        "usage": ["COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT"],
    }
    for end in range(len(DESCRIPTION)):
        text = DESCRIPTION[:end]
        documents, problems = reading(text)
        if problems:
            assert [p.code for p in problems] in (["MSAA901"], ["MSAA903"])
            assert 0 <= problems[0].span.start <= problems[0].span.end <= end
        for document in documents:
            value = plain(document)
            if isinstance(value, dict):
                assert (
                    list(value) == list(whole)[: len(value)]
                    or list(value)[:-1] == list(whole)[: len(value) - 1]
                )
            assert all(
                0 <= node.start <= node.end <= end
                for node in nodes(document)
                if node.anchor is None
            )


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_truncated_at_every_byte(encoding: str) -> None:
    data = DESCRIPTION.replace("A frame", "Ein Bild für 𝄞").encode(encoding)
    for end in range(0, len(data), 3):
        try:
            text = decode(data[:end])
        except Unreadable as error:
            assert error.offset is not None
            assert end - 4 < error.offset < end
        else:
            assert len(reading(text).problems) <= 1


@pytest.mark.usefixtures("stack")
def test_noise() -> None:
    noise = random.Random(0)
    indicators = "ab1 \t\n\r-?:,[]{}#&*!|>'\"%@`~<=.\\/é𝄞\x85\u2028\ufeff"
    for _ in range(400):
        text = "".join(noise.choices(indicators, k=noise.randrange(60)))
        documents, problems = reading(text)
        assert len([p for p in problems if p.code == "MSAA901"]) <= 1
        for document in documents:
            for node in nodes(document) if not problems else []:
                assert 0 <= node.start <= node.end <= len(text)
        for comment in comments(Source("x", text), documents):
            assert text[comment.span.start] == "#"


@pytest.mark.usefixtures("stack")
def test_binary() -> None:
    noise = random.Random(1)
    for size in (1, 2, 3, 10, 1000, 20_000):
        data = noise.randbytes(size)
        problem = trouble(data.decode("latin-1") + "\0")
        assert problem.code == "MSAA901"
        assert "is not allowed in YAML or JSON" in problem.message
        with pytest.raises(Unreadable, match="not UTF-8"):
            decode(b"\x89" + data)


@pytest.mark.usefixtures("stack")
@pytest.mark.parametrize("mark", [b"\xff\xfe", b"\xfe\xff"])
def test_utf_16(mark: bytes) -> None:
    text = decode(
        mark
        + 'é: {"𝄞": "\\ud834\\udd1e"}\r\nb: 1'.encode(
            "utf-16-le" if mark == b"\xff\xfe" else "utf-16-be"
        )
    )
    root = one(text)
    assert plain(root) == {"é": {"𝄞": "𝄞"}, "b": 1}
    assert Source("x", text).position(root.value["b"].start) == (2, 4)
    unmarked = decode("a: 1".encode("utf-16-le"))
    assert trouble(unmarked).span == Span(1, 2)


def test_names_in_messages_are_short() -> None:
    long = "n" * 100_000
    for text in (
        f"*{long}",
        f"a: &{long} [*{long}]",
        f"a: !{long} x",
        f"{{? {long} : 1, ? {long} : 2}}",
        f"a: !!{long} x",
    ):
        assert len(trouble(text).message) < 200


def test_the_limits_of_the_design() -> None:
    assert Limits() == Limits(depth=100, nodes=1_000_000, bytes=64 * 2**20)
    assert parse(Source("x", "a: 1"), Limits()).problems == []
