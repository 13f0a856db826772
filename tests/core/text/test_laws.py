"""Laws of places: what stands at a node's place is that node, on either parser."""

from __future__ import annotations

import json
from typing import Any

import yaml
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.text.scalars import resolve
from msaa_lint.core.text.source import forbidden
from msaa_lint.core.text.tree import Node, Parsed
from tests.core.text.reading import nodes, one, plain, reading, without_libyaml
from tests.strength import examples

# What YAML 1.1, which yaml.dump writes, reads otherwise is left out where it writes without quotes.
LETTERS = st.text(
    st.characters(exclude_categories=["Cs"], exclude_characters="\x85\u2028\u2029").filter(
        lambda c: forbidden(c) is None
    ),
    max_size=15,
)
WORDS = st.sampled_from(
    [
        "true",
        "no",
        "~",
        "010",
        "0o7",
        "1e3",
        "# x",
        "- x",
        "a: b",
        "<<",
        "=",
        "x ",
        " x",
        "",
        "x\n",
        "\n",
        "a\n b\n\nc",
        "---",
    ]
)
SCALARS = (
    st.none()
    | st.booleans()
    | st.integers(-(10**39), 10**39)
    | st.floats(allow_nan=False)
    | LETTERS
    | WORDS
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries((LETTERS | WORDS).filter(lambda key: key != "<<"), inner, max_size=4)
    ),
    max_leaves=15,
)


def as_yaml(
    value: Any, style: str | None, flow: bool | None, indent: int, width: int, ascii_only: bool
) -> str:
    text: str = yaml.dump(
        value,
        Dumper=_Dumper,
        default_style=style,
        default_flow_style=flow,
        indent=indent,
        width=width,
        allow_unicode=not ascii_only,
        sort_keys=False,
        line_break="\n",
    )
    return text


class _Dumper(yaml.SafeDumper):
    """Texts that YAML 1.2 reads as something else have quotes."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _text(dumper: yaml.SafeDumper, value: str) -> yaml.ScalarNode:
    style = '"' if not isinstance(resolve(value), str) else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", value, style=style)


def _plain(dumper: yaml.SafeDumper, value: Any) -> yaml.Node:
    """Without quotes whatever the style, so that it needs no tag."""
    node = yaml.SafeDumper.yaml_representers[type(value)](dumper, value)
    assert isinstance(node, yaml.ScalarNode)
    node.style = ""
    return node


_Dumper.add_representer(str, _text)
for _type in (int, float, bool, type(None)):
    _Dumper.add_representer(_type, _plain)

TEXTS = st.builds(
    as_yaml,
    VALUES,
    st.sampled_from([None, "'", '"']),
    st.sampled_from([None, True, False]),
    st.sampled_from([2, 4, 7]),
    st.sampled_from([10, 80]),
    st.booleans(),
) | st.builds(
    lambda value, indent: json.dumps(value, indent=indent, allow_nan=False),
    VALUES.filter(lambda v: "inf" not in repr(v)),
    st.sampled_from([None, 1, "\t"]),
)


@examples(0.6)
@given(
    VALUES,
    st.sampled_from([None, "'", '"']),
    st.sampled_from([None, True, False]),
    st.sampled_from([2, 5]),
    st.booleans(),
)
def test_what_is_dumped_is_read(
    value: Any, style: str | None, flow: bool | None, indent: int, ascii_only: bool
) -> None:
    text = as_yaml(value, style, flow, indent, 30, ascii_only)
    found = plain(one(text))
    assert found == value
    assert repr(found) == repr(value)


@examples(0.6)
@given(TEXTS)
def test_the_text_at_a_place_is_the_node(text: str) -> None:
    for node in nodes(one(text)):
        at = text[node.start : node.end]
        # A collection in block style keeps its columns.
        column = node.start - text.rfind("\n", 0, node.start) - 1
        documents, problems = reading(" " * column + at)
        assert problems == []
        assert (plain(documents[0]) if documents else None) == plain(node)
        if documents:
            assert documents[0].end - documents[0].start == node.end - node.start


@examples(0.6)
@given(TEXTS)
def test_places_nest_and_follow_each_other(text: str) -> None:
    def check(node: Node) -> None:
        children = node.value if node.kind == "sequence" else []
        if node.kind == "mapping":
            children = [
                child for key, value in node.value.items() for child in (node.keys[key], value)
            ]
        at = node.start
        for child in children:
            assert at <= child.start <= child.end <= node.end
            at = child.end
            check(child)
        assert (
            text[node.start : node.end] == text[node.start : node.end].strip(" \t\r\n")
            or not children
        )

    check(one(text))


@examples(0.6)
@given(TEXTS, st.data())
def test_both_parsers_give_the_same(text: str, data: st.DataObject) -> None:
    cuts = data.draw(st.lists(st.integers(0, len(text)), max_size=2))
    for cut in cuts:
        text = (
            text[:cut]
            + data.draw(
                st.sampled_from(
                    [
                        "",
                        " ",
                        "\n",
                        "\t",
                        "#",
                        ":",
                        "*a",
                        "&a ",
                        "!!str ",
                        "!x ",
                        "]",
                        "}",
                        "'",
                        "\\",
                        "\x85",
                    ]
                )
            )
            + text[cut:]
        )
    fast = reading(text)
    with without_libyaml():
        slow = reading(text)
    assert [(p.code, p.span if p.code != "MSAA901" else None) for p in fast.problems] == [
        (p.code, p.span if p.code != "MSAA901" else None) for p in slow.problems
    ]
    assert whole(fast) == whole(slow)


def whole(parsed: Parsed) -> list[Any]:
    return [
        (n.kind, n.start, n.end, n.text, n.plain, repr(plain(n)))
        for document in parsed.documents
        for n in nodes(document)
    ]
