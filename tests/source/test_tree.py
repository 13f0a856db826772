"""Trees: values, exact places, and hostile inputs, each of which ends in one clear problem or a right tree."""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from msaa_lint.source import tree
from msaa_lint.source.pure import PureParser
from msaa_lint.source.text import Source, Unreadable
from msaa_lint.source.tree import Limits, Node, Parsed, parse, read

SAMPLES = Path(os.environ.get("MSAA_LINT_SAMPLES", Path(__file__).parents[3] / "shared" / "samples"))


def parsed(text: str, **limits: int) -> Parsed:
    return parse(Source("x", text), Limits(**limits))


def root(text: str) -> Node:
    made = parsed(text)
    assert made.problems == []
    assert len(made.documents) == 1
    return made.documents[0]


def plain(node: Node) -> Any:
    """The value of a tree without its places. Not for shared, growing trees."""
    if node.kind == "mapping":
        return {key: plain(value) for key, value in node.value.items()}
    if node.kind == "sequence":
        return [plain(item) for item in node.value]
    return node.value


def only_problem(text: str, **limits: int) -> tuple[str, str]:
    made = parsed(text, **limits)
    assert len(made.problems) == 1
    problem = made.problems[0]
    assert 0 <= problem.span.start <= problem.span.end <= len(text)
    return problem.code, problem.message


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("true", True), ("True", True), ("FALSE", False), ("yes", "yes"), ("on", "on"), ("No", "No"), ("~", None), ("null", None),
        ("4", 4), ("-17", -17), ("+3", 3), ("010", 10), ("0o17", 15), ("0xF", 15), ("1_000", "1_000"), ("1:30", "1:30"),
        ("1.5", 1.5), (".5", 0.5), ("1e3", 1000.0), ("1.", 1.0), (".inf", math.inf), ("-.Inf", -math.inf), ("2020-01-01", "2020-01-01"),
        ("'4'", "4"), ('"true"', "true"), ("!!str 4", "4"), ("!!float 4", 4.0), ("!!int 4", 4), ("!!null ''", None), ("! 4", "4"),
        ("-", None) if False else ("--", "--"), ("0x", "0x"), ("1e", "1e"), ("9" * 64, int("9" * 64)), ("9" * 65, "9" * 65),
    ],
)  # fmt: skip
def test_scalars_are_yaml_1_2(text: str, value: Any) -> None:
    found = root(f"k: {text}").value["k"].value
    assert found == value
    assert type(found) is type(value)


def test_not_a_number() -> None:
    assert math.isnan(root("k: .nan").value["k"].value)


def test_places_in_block_style() -> None:
    text = "images:\n  a:\n    samples: 4   # four\n\n  # said of b\n  b: {format: 'R8', usage: [X, Y]}\n\n\nlast: |\n  two\n  lines\n\n"
    top = root(text)

    def at(node: Node) -> str:
        return text[node.start : node.end]

    images = top.value["images"]
    assert at(top.keys["images"]) == "images"
    assert at(images).endswith("[X, Y]}")
    assert at(images.value["a"]) == "samples: 4"
    assert at(images.value["b"]) == "{format: 'R8', usage: [X, Y]}"
    assert at(images.value["b"].value["format"]) == "'R8'"
    assert images.value["b"].value["format"].plain is False
    assert at(images.value["b"].value["usage"].value[1]) == "Y"
    assert at(top.value["last"]) == "|\n  two\n  lines"


def test_places_count_code_points() -> None:
    text = "\U0001d11e: {é: 4}\r\nb: x"
    top = root(text)
    assert text[top.value["\U0001d11e"].value["é"].start] == "4"
    assert Source("x", text).position(top.value["b"].start) == (2, 4)


def test_an_alias_is_at_its_own_place() -> None:
    text = "a: &x {s: 4}\nb: *x"
    top = root(text)
    alias = top.value["b"]
    assert text[alias.start : alias.end] == "*x"
    assert alias.anchor is top.value["a"]
    assert alias.value["s"] is top.value["a"].value["s"]


def test_merge() -> None:
    top = root("a: &a {x: 1, y: 2}\nb: &b {y: 3, z: 4}\nc: {<<: [*a, *b], x: 0}\nd: {'<<': 1}")
    assert plain(top.value["c"]) == {"x": 0, "y": 2, "z": 4}
    assert plain(top.value["d"]) == {"<<": 1}
    assert only_problem("a: {<<: 4}")[0] == "MSAA903"


def test_duplicate_keys_are_told_with_both_places() -> None:
    text = "a: 1\nb: 2\na: 3\n"
    made = parsed(text)
    (problem,) = made.problems
    assert problem.code == "MSAA905"
    assert problem.span == (10, 11)
    assert problem.labels[0].span == (0, 1)
    assert plain(made.documents[0]) == {"a": 1, "b": 2}


def test_several_documents() -> None:
    made = parsed("a: 1\n---\nb: *x\n")
    assert [plain(document) for document in made.documents] == [{"a": 1}]
    assert [problem.code for problem in made.problems] == ["MSAA901"]
    assert [plain(d) for d in parsed("a: 1\n---\nb: 2\n---\n# nothing\n").documents] == [{"a": 1}, {"b": 2}]
    assert parsed("").documents == parsed("# only this\n").documents == []


def test_json_is_read_by_the_same_path() -> None:
    text = '{\n\t"a":1,"b" : [1,2,],\n\t"c": {"d": "x\\/\\u00e9\\ud83d\\ude00\\n",},\n}'
    assert plain(root(text)) == {"a": 1, "b": [1, 2], "c": {"d": "x/\u00e9\U0001f600\n"}}
    assert text[root(text).value["b"].value[1].start] == "2"


json_values = st.recursive(
    st.none() | st.booleans() | st.integers(-(10**18), 10**18) | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=20),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=8), inner, max_size=4),
    max_leaves=20,
)


@settings(max_examples=150)
@given(json_values, st.sampled_from([None, 2, "\t"]), st.booleans())
def test_json_means_what_json_means(value: Any, indent: Any, ascii_only: bool) -> None:
    text = json.dumps({"k": value}, indent=indent, ensure_ascii=ascii_only)
    if any(0xD800 <= ord(c) <= 0xDFFF for c in text) or tree.forbidden(text) is not None:
        return
    made = parsed(text)
    assert made.problems == []
    assert plain(made.documents[0]) == json.loads(text)


@settings(max_examples=100)
@given(st.dictionaries(st.text("abcé \n", min_size=1, max_size=6), json_values, max_size=4))
def test_the_text_at_a_place_has_the_same_value(value: Any) -> None:
    """What stands at the place of a value of a mapping, read alone, is the value."""
    text = yaml.safe_dump(value, allow_unicode=True, sort_keys=False)
    if parsed(text).problems:
        return
    for node in root(text).value.values() if value else []:
        if node.kind == "scalar" and "\n" not in text[node.start : node.end]:
            assert (
                parsed(text[node.start : node.end]).documents == [] or plain(parsed(text[node.start : node.end]).documents[0]) == node.value
            )


@settings(max_examples=60)
@given(json_values)
def test_the_pure_parser_gives_the_same(value: Any) -> None:
    text = yaml.safe_dump({"k": value, "é": [1]}, allow_unicode=True)
    fast = parsed(text)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tree, "_parser", PureParser)
        slow = parsed(text)
    assert [p.code for p in fast.problems] == [p.code for p in slow.problems]
    assert _spans(fast.documents) == _spans(slow.documents)


def _spans(nodes: list[Node]) -> list[Any]:
    out: list[Any] = []
    for node in nodes:
        below = list(node.value.values()) if node.kind == "mapping" else node.value if node.kind == "sequence" else []
        out.append((node.kind, node.start, node.end, node.text, _spans(below)))
    return out


@pytest.mark.parametrize("opening", ["[", "{a: ", "- ", "? ", "[{a: "])
def test_deep_nesting_ends_at_the_limit(opening: str) -> None:
    code, message = only_problem(opening * 100_000)
    assert code == "MSAA906" or opening == "? "
    assert "limit of 100" in message or opening == "? "


def test_the_limits_can_be_set() -> None:
    assert parsed("[[[1]]]", depth=3).problems == []
    assert only_problem("[[[[1]]]]", depth=3)[0] == "MSAA906"
    assert parsed("[1, 2, 3]", nodes=4).problems == []
    assert only_problem("[1, 2, 3, 4]", nodes=4)[0] == "MSAA906"


def test_aliases_count_expanded() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 10)]
    assert only_problem("\n".join(lines)) == ("MSAA906", "more nodes than the limit of 1000000, aliases expanded")


def test_depth_counts_through_aliases() -> None:
    lines = ["a0: &a0 [1]", *(f"a{n}: &a{n} [*a{n - 1}]" for n in range(1, 200))]
    assert only_problem("\n".join(lines))[0] == "MSAA906"


def test_merges_cannot_swell() -> None:
    wide = "\n".join(f"  k{n}: 1" for n in range(2000))
    lines = [f"a0: &a0\n{wide}", *(f"a{n}: &a{n} {{<<: [*a{n - 1}, *a{n - 1}]}}" for n in range(1, 1000))]
    assert only_problem("\n".join(lines))[0] == "MSAA906"


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("a: &a [*a]", "MSAA901"),
        ("a: &a {b: {c: *a}}", "MSAA901"),
        ("a: *nothing", "MSAA901"),
        ("a: \x00", "MSAA901"),
        ('a: "\x07"', "MSAA901"),
        ("a: !!python/object:os.system x", "MSAA903"),
        ("a: !local x", "MSAA903"),
        ("a: !!int x", "MSAA903"),
        ("a: !!map [1]", "MSAA903"),
        ("? [a, b]\n: 1", "MSAA901"),
        ("a: [1, 2", "MSAA901"),
        ('a: "x', "MSAA901"),
        ("a:\n\t- 1", "MSAA901"),
        ("a: b: c", "MSAA901"),
        ("\ufffe", "MSAA901"),
        ('{"a": "\\ud800"}', "MSAA901"),
        ("%YAML 9.9\n---\na: 1", "MSAA901"),
    ],
)
def test_bad_input_is_one_problem(text: str, code: str) -> None:
    assert only_problem(text)[0] == code


@pytest.mark.parametrize(
    "text", ["a: " + "x" * 10_000_000, "x" * 10_000_000, "'" + "y" * 1_000_000 + "': 1", "#" * 1_000_000, "\n" * 1_000_000]
)
def test_large_scalars_are_read(text: str) -> None:
    made = parsed(text)
    assert len(made.documents) <= 1
    assert len(made.problems) <= 1


def test_a_million_nodes_is_the_end() -> None:
    assert only_problem("[" + "1," * 1_000_001 + "]")[0] == "MSAA906"


@settings(max_examples=200)
@given(st.binary(max_size=200))
def test_noise_never_raises(data: bytes) -> None:
    made = parsed(data.decode("latin-1"))
    assert len(made.problems) <= 1 or all(problem.code == "MSAA905" for problem in made.problems[:-1])


def test_truncated_anywhere_is_a_tree_or_one_problem() -> None:
    text = (Path(__file__).parents[2] / "examples" / "khronos-msaa" / "inline.msaa.yaml").read_text(encoding="utf-8")
    for end in range(0, len(text), 7):
        made = parsed(text[:end])
        assert len(made.problems) <= 1


def test_reads_files_up_to_the_limit(tmp_path: Path) -> None:
    path = tmp_path / "f"
    path.write_bytes(b"12345")
    assert read(str(path), Limits(bytes=5)) == b"12345"
    with pytest.raises(Unreadable, match="limit of 4 bytes"):
        read(str(path), Limits(bytes=4))
    os.mkfifo(tmp_path / "fifo")
    for other in (tmp_path, tmp_path / "fifo", Path("/dev/zero")):
        with pytest.raises(OSError, match="no regular file"):
            read(str(other), Limits())


@pytest.mark.skipif(not (SAMPLES / "vulkan_sc").is_dir(), reason="the sample folder is not here")
def test_real_pipeline_files_are_read_as_json_reads_them() -> None:
    import re

    files = sorted((SAMPLES / "vulkan_sc").rglob("*.json"))
    for path in files:
        text = path.read_text(encoding="utf-8")
        expected = json.loads(re.sub(r",(\s*[\]}])", r"\1", text))
        assert plain(root(text)) == expected
    assert len(files) == 129
