"""The description format: every member of it is read, from YAML and from JSON, and a description is
told by its content.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

import pytest

from msaa_lint import lint
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import Command, Description
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.input.readers import FORMATS, read
from tests.frame.description.shapes import RECORDS
from tests.frame.description.test_schema import documents, mistakes
from tests.paths import ROOT

WHOLE = (ROOT / "tests" / "data" / "format.msaa.yaml").read_text(encoding="utf-8")
ELSEWHERE = [
    (ROOT / "tests" / "data" / f"{name}.msaa.yaml").read_text(encoding="utf-8")
    for name in ("metal", "render_targets")
]
"""What cannot stand beside the sections of a frame in Vulkan's words."""


def document(text: str, format: str | None = None, name: str = "frame.yaml") -> Document:
    source = Source(name, text)
    parsed = parse(source, Limits())
    assert not parsed.problems
    return read(source, parsed.documents[0], format)


def records(value: Any) -> Iterator[Record]:
    """A record and all within it."""
    if isinstance(value, Record):
        yield value
        value = [
            getattr(value, name)
            for name in (value.SHAPE if not isinstance(value, Command) else ("body",))
        ]
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, (list, tuple)):
        for inner in value:
            yield from records(inner)


def test_every_member_of_the_format_is_read() -> None:
    whole = document(WHOLE)
    assert whole.problems == ()
    assert whole.whole
    stated: dict[str, set[str]] = {}
    for text in (WHOLE, *ELSEWHERE):
        binder = Binder()
        described = binder.record(
            Description, parse(Source("frame.yaml", text), Limits()).documents[0], "", ""
        )
        assert binder.problems == []
        for record in records(described):
            names = {record.kind} if isinstance(record, Command) else set(record.spelled)
            stated.setdefault(type(record).__name__, set()).update(names)
        assert document(text).problems == ()
    for name, kind in RECORDS.items():
        if name != "Nothing":
            assert stated[name] == set(kind.SHAPE), name
    assert [mistakes(documents(text)[0]) for text in (WHOLE, *ELSEWHERE)] == [[], [], []]


def test_members_are_read_as_they_are_written() -> None:
    described = document(WHOLE).description
    assert described.device is not None and not isinstance(described.device, str)
    assert described.device.memoryTypes == (("DEVICE_LOCAL",), ("DEVICE_LOCAL", "LAZILY_ALLOCATED"))
    assert described.device.sampleCounts is not None and described.device.sampleCounts.stencil == (
        1,
        4,
    )
    assert described.device.tile == {"model": "mali-g76"}
    image = described.images["color_ms"]
    assert (image.format, image.samples, image.imageType) == ("R16G16B16A16_SFLOAT", 4, "2D")
    assert image.usage == ("COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT")
    forward, single = described.renderPasses.values()
    assert [attachment.key for attachment in forward.attachments] == [
        "color",
        "depth",
        "output",
        "depth_out",
        "density_map",
    ]
    assert [attachment.key for attachment in single.attachments] == ["0"]
    assert [reference.attachment for reference in forward.subpasses[0].colorAttachments] == [
        "color",
        None,
    ]
    assert forward.dependencies[0].dstStageMask == (
        "COLOR_ATTACHMENT_OUTPUT",
        "EARLY_FRAGMENT_TESTS",
    )
    stage = described.pipelines["opaque"].stages[0]
    assert stage.specialization == {"0": 4, "1": True}
    state = described.pipelines["opaque"].multisampleState
    assert state is not None and state.sampleMask == (15,)
    assert described.commands is not None
    assert [command.kind for command in described.commands[:4]] == [
        "beginRenderPass",
        "draw",
        "nextSubpass",
        "endRenderPass",
    ]
    assert described.commands[7].body.framebuffer == ("even", "odd")
    assert described.scene is not None and described.scene.peak == 16.5


def test_yaml_and_json_are_the_same() -> None:
    yaml, json_ = document(WHOLE), document(json.dumps(documents(WHOLE)[0], indent=1))
    facts = [[(s.kind, s.path, s.facts.values) for s in subjects(each)] for each in (yaml, json_)]
    assert facts[0] == facts[1]
    assert len(facts[0]) == 53


def test_the_documentation_shows_a_description() -> None:
    """The example of docs/format.md."""
    text = (ROOT / "docs" / "format.md").read_text(encoding="utf-8")
    block = re.search(r"```yaml\n(frame:.*?)```", text, re.DOTALL)
    assert block is not None
    assert document(block[1]).problems == ()
    assert [mistakes(each) for each in documents(block[1])] == [[]]


@pytest.mark.parametrize(
    ("text", "format"),
    [
        ("images: {}", "description"),
        ("{}", "description"),
        ('{"renderPasses": {}}', "description"),
        ("pipelines: {}\nGraphicsPipelineState: {}", "vulkan-sc"),
        ("GraphicsPipelineState: {}", "vulkan-sc"),
        ('{"ComputePipelineState": {}}', "vulkan-sc"),
        ("[1]", "description"),
        ("words", "description"),
    ],
)
@pytest.mark.parametrize("name", ["frame.yaml", "pipeline.json", "no-ending"])
def test_a_format_is_told_by_content_and_not_by_name(text: str, format: str, name: str) -> None:
    source = Source(name, text)
    root = parse(source, Limits()).documents[0]
    claimed = next(
        (known for known, module in FORMATS.items() if module.claims(root)), "description"
    )
    assert claimed == format
    assert read(source, root).whole == (format == "description")


def test_a_format_may_be_forced() -> None:
    assert [
        problem.code for problem in document("GraphicsPipelineState: {}", "description").problems
    ] == ["MSAA902"]
    assert [problem.code for problem in document("images: {}", "vulkan-sc").problems] == ["MSAA903"]


@pytest.mark.parametrize("text", ["[1]", "words", "4", "null"])
def test_what_is_no_mapping_is_no_description(text: str) -> None:
    for format in (None, "description", "vulkan-sc"):
        assert [problem.code for problem in document(text, format).problems] == ["MSAA903"]


def test_documents_of_a_stream_are_read_apart() -> None:
    result = lint(
        text="images: {a: {samples: 3}}\n---\nimages: {b: {formt: 1}}\n",
        filename="two.yaml",
        isolated=True,
    )
    assert [(found.code, found.subject) for found in result.findings] == [
        ("MSAA903", "documents[0].images.a.samples"),
        ("MSAA902", "documents[1].images.b.formt"),
    ]
