"""`msaa-lint schema`: what an editor checks a description by is what the linter reads."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jsonschema import Draft202012Validator

from msaa_lint.cli.init import DESCRIPTION
from msaa_lint.cli.schema import description_schema, joined, spellings
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, Node, parse
from msaa_lint.frame.vulkan.enums import VALUES
from msaa_lint.frame.vulkan.names import parse_enum, parse_flags
from tests.frame.description.shapes import SPELLINGS, structure
from tests.frame.description.test_models import SOME, Json
from tests.pages import all_examples
from tests.paths import ROOT

SCHEMA = description_schema()
VALIDATOR = Draft202012Validator(SCHEMA)


def value_of(node: Node) -> Json:
    """A document as JSON has it, by YAML 1.2's rules: other readers know 1.1's."""
    if node.kind == "mapping":
        return {key: value_of(value) for key, value in node.value.items()}
    if node.kind == "sequence":
        return [value_of(item) for item in node.value]
    return node.value


def documents(text: str) -> list[Json]:
    parsed = parse(Source("given.yaml", text), Limits())
    assert not parsed.problems
    return [value_of(root) for root in parsed.documents]


def mistakes(value: Json) -> list[str]:
    """Where a description is not as the schema has it."""
    return ["/".join(map(str, error.absolute_path)) for error in VALIDATOR.iter_errors(value)]


def test_the_command_prints_it() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "msaa_lint", "schema"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert json.loads(done.stdout) == SCHEMA
    Draft202012Validator.check_schema(SCHEMA)


def nodes(value: Any) -> Iterator[dict[str, Any]]:
    if isinstance(value, dict):
        yield value
        value = list(value.values())
    if isinstance(value, list):
        for inner in value:
            yield from nodes(inner)


def test_the_schema_is_whole() -> None:
    """Every reference leads somewhere, no structure takes unknown members, every pattern is
    anchored.
    """
    for node in nodes(SCHEMA):
        if "$ref" in node:
            assert node["$ref"].removeprefix("#/$defs/") in SCHEMA["$defs"]
        if "properties" in node and node.get("type") == "object":
            assert node["additionalProperties"] is False
        if "pattern" in node and node.get("type") == "string":
            assert node["pattern"][0] + node["pattern"][-1] == "^$"
            re.compile(node["pattern"])


@pytest.mark.parametrize(
    "path", sorted((ROOT / "examples").rglob("*.msaa.*")), ids=lambda path: path.name
)
def test_examples_are_valid(path: Path) -> None:
    for value in documents(path.read_text(encoding="utf-8")):
        assert mistakes(value) == []


@pytest.mark.parametrize(
    "example", [e for e in all_examples() if "PipelineState" not in e.text], ids=str
)
def test_examples_of_the_pages_are_valid(example: Any) -> None:
    for value in documents(example.text):
        assert mistakes(value) == []


def test_the_first_description_is_valid() -> None:
    assert [mistakes(value) for value in documents(DESCRIPTION)] == [[]]


@SOME
@given(structure("Description"))
def test_what_the_models_accept_is_valid(value: Json) -> None:
    assert mistakes(value) == []


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("image: {}", [""]),
        ("images: {a: {formt: D16_UNORM}}", ["images/a"]),
        (
            "renderPasses: {a: {subpasses: [{colorAttachment: [0]}]}}",
            ["renderPasses/a/subpasses/0"],
        ),
        ("images: {a: {format: RGBA8}}", ["images/a/format"]),
        ("images: {a: {format: VK_FORMAT_RGBA8}}", ["images/a/format"]),
        ("images: {a: {format: FORMAT_}}", ["images/a/format"]),
        ("images: {a: {usage: [TRANSIENT]}}", ["images/a/usage"]),
        ("images: {a: {usage: COLOR_ATTACHMENT | TRANSIENT}}", ["images/a/usage"]),
        ("images: {a: {usage: 'COLOR_ATTACHMENT |'}}", ["images/a/usage"]),
        ("images: {a: {usage: 16}}", ["images/a/usage"]),
        ("images: {a: {samples: 3}}", ["images/a/samples"]),
        ("images: {a: {samples: SAMPLE_COUNT_3}}", ["images/a/samples"]),
        ("images: {a: {samples: null}}", ["images/a/samples"]),
        ("images: {a: null}", ["images/a"]),
        ("images: null", ["images"]),
        ("frame: {fps: 0}", ["frame/fps"]),
        ("frame: {width: 0}", ["frame/width"]),
        ("frame: {width: 2147483648}", ["frame/width"]),
        (
            "renderPasses: {a: {attachments: {c: {storeOp: NONE_BIT}}}}",
            ["renderPasses/a/attachments"],
        ),
        ("renderPasses: {a: {subpasses: [null]}}", ["renderPasses/a/subpasses/0"]),
        (
            "renderPasses: {a: {subpasses: [{colorAttachments: [-1]}]}}",
            ["renderPasses/a/subpasses/0/colorAttachments/0"],
        ),
        (
            "renderPasses: {a: {dependencies: [{srcSubpass: OUTSIDE}]}}",
            ["renderPasses/a/dependencies/0/srcSubpass"],
        ),
        ("pipelines: {p: {dynamicState: [VIEWPORTS]}}", ["pipelines/p/dynamicState"]),
        (
            "pipelines: {p: {stages: [{specialization: {x: 1}}]}}",
            ["pipelines/p/stages/0/specialization"],
        ),
        ("commands: [draw]", ["commands/0"]),
        ("commands: [{draw: null}]", ["commands/0"]),
        ("commands: [{}]", ["commands/0"]),
        ("commands: [{endRendering: null, nextSubpass: null}]", ["commands/0"]),
        ("scene: {peak: -1}", ["scene/peak"]),
        ("scene: {color: BRIGHT}", ["scene/color"]),
    ],
)
def test_what_is_refused(text: str, where: list[str]) -> None:
    (value,) = documents(text)
    assert mistakes(value) == where


@pytest.mark.parametrize("enum", sorted(VALUES))
def test_every_spelling_is_valid(enum: str) -> None:
    one, several = re.compile(spellings(enum)), re.compile(joined(enum))
    for name in SPELLINGS[enum]:
        assert one.fullmatch(name), name
        assert several.match(name), name
        assert parse_enum(enum, name) is not None, name


@given(st.sampled_from(sorted(VALUES)), st.data())
def test_names_that_are_nearly_right_are_valid_where_the_linter_takes_them(
    enum: str, data: st.DataObject
) -> None:
    name = data.draw(st.sampled_from(SPELLINGS[enum]))
    cut = data.draw(st.integers(0, len(name)))
    text = data.draw(
        st.sampled_from(
            [
                name[cut:],
                name[:cut],
                name.lower(),
                f"VK_{name}",
                f"{name}_BIT",
                f" {name}",
                name[:cut] + "_" + name[cut:],
            ]
        )
    )
    valid = re.fullmatch(spellings(enum), text) is not None
    assert valid <= (parse_enum(enum, text) is not None)
    if "_BIT" not in text:
        assert valid == (parse_enum(enum, text) is not None), text


@pytest.mark.parametrize(
    ("text", "valid"),
    [
        ("SAMPLED", True),
        ("SAMPLED|COLOR_ATTACHMENT", True),
        (" SAMPLED | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT ", True),
        ("0", True),
        ("17", True),
        ("0x11", True),
        ("17 (TRANSFER_SRC | COLOR_ATTACHMENT)", True),
        ("0 ()", True),
        ("", False),
        ("|", False),
        ("SAMPLED COLOR_ATTACHMENT", False),
        ("017", False),
        ("SAMPLED (4)", False),
        ("17 (SAMPLE)", False),
    ],
)
def test_joined_flags(text: str, valid: bool) -> None:
    assert (re.match(joined("VkImageUsageFlagBits"), text) is not None) == valid
    try:
        parse_flags("VkImageUsageFlagBits", text)
    except ValueError:
        assert not valid
    else:
        assert valid
