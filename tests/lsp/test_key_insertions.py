"""The keys that undecided rules lack: what is inserted is valid, in descriptions of all kinds."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from msaa_lint.cli.lsp.key_insertions import KeyInsertion, as_snippet, key_insertions
from msaa_lint.core.allowance import Allowance
from msaa_lint.core.text.edits import apply
from msaa_lint.linter.results import FileResult
from tests.descriptions import CLEAN

from .views import OPTIONS, descriptions, engine

COMMANDS = """\
commands:
  - beginRenderPass: {renderPass: forward, framebuffer: main}
  - endRenderPass
"""

FRAME = f"""{CLEAN}\
framebuffers:
  main: {{renderPass: forward, attachments: [color_ms, color], width: 8, height: 8}}
pipelines:
  opaque: {{renderPass: forward, subpass: 0, multisampleState: {{rasterizationSamples: 4}}, stages: [{{stage: FRAGMENT}}]}}
"""


def linted(text: str, name: str = "frame.msaa.yaml") -> FileResult:
    return engine().lint(text.encode(), name, OPTIONS._replace(keys=Allowance(), all_keys=True))


def insertions(text: str, name: str = "frame.msaa.yaml") -> list[KeyInsertion]:
    return key_insertions(linted(text, name))


def errors(text: str, name: str) -> list[str]:
    return [
        found.message
        for found in linted(text, name).findings
        if found.severity == "error" and found.code.startswith("MSAA9")
    ]


def is_valid(text: str, name: str) -> int:
    """How many insertions of a text were made, each of which must leave it as valid as it was."""
    before = errors(text, name)
    whole = [each for each in insertions(text, name) if not each.is_snippet]
    by_key = {each.title.split(": ")[0].split(" to ")[0]: each for each in whole}
    for each in by_key.values():
        after = apply(text, list(each.edits))
        assert after != text and errors(after, name) == before, each.title
    return len(by_key)


@pytest.mark.parametrize("path", descriptions()[::4], ids=lambda path: path.stem)
def test_what_is_inserted_in_examples_is_valid(path: Path) -> None:
    is_valid(path.read_text(encoding="utf-8"), path.name)


@pytest.mark.parametrize("indent", [None, 2])
def test_what_is_inserted_in_json_is_valid(indent: int | None) -> None:
    text = json.dumps(yaml.safe_load(FRAME + COMMANDS), indent=indent)
    assert is_valid(text, "frame.msaa.json") > 5
    for each in insertions(text, "frame.msaa.json"):
        if not each.is_snippet:
            json.loads(apply(text, list(each.edits)))


def titles(text: str) -> dict[str, str]:
    return {
        each.title.partition(", to decide")[0]: apply(text, list(each.edits))
        for each in insertions(text)
    }


def test_lists_are_inserted_with_their_first_item() -> None:
    found = titles(FRAME)
    text = found["Add colorBlendState.attachments[0].blendEnable: true to pipelines.opaque"]
    assert "colorBlendState: {attachments: [{blendEnable: true}]}" in text


def test_a_command_is_inserted_where_its_place_is_known() -> None:
    text = """\
images:
  scene: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  shown: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
commands:
  - beginRendering: {colorAttachments: [{image: shown, loadOp: CLEAR, storeOp: STORE}]}
  - endRendering
"""
    assert [each for each in titles(text) if each.startswith("Add present:")] == [
        "Add present: shown to commands"
    ]
    assert titles(text)["Add present: shown to commands"] == text + "  - present: {image: shown}\n"
    flow = (
        text.partition("commands:")[0]
        + "commands: [{beginRendering: {colorAttachments: [{image: shown, storeOp: STORE}]}}, "
        "endRendering]\n"
    )
    assert titles(flow)["Add present: shown to commands"] == flow.replace(
        "endRendering]", "endRendering, {present: {image: shown}}]"
    )


def test_values_are_those_that_other_structures_state() -> None:
    text = CLEAN.replace(
        "{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]",
        "{format: R8G8B8A8_UNORM, samples: 1",
    )
    assert "Add usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT] to images.color" in titles(text)
    text = CLEAN.replace("{image: color, loadOp", "{loadOp")
    assert (
        "image: color}"
        in titles(text)["Add image: color to renderPasses.forward.attachments.color"]
    )


def test_a_snippet_places_the_cursor_in_the_value() -> None:
    snippets = [each for each in insertions(CLEAN) if each.is_snippet]
    (tiling,) = (each for each in snippets if each.title.startswith("Add tiling to images.color,"))
    assert as_snippet(tiling.edits[0].text).strip(", ") == "tiling: $0"
    assert as_snippet("a}$\\") == "a\\}\\$\\\\"
