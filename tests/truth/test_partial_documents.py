"""A key, a value or a name that cannot be read is reported, and the rest of the document is checked
without it.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from msaa_lint import lint
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from tests.command import run
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples as at_most

FRAME = """
images:
  ms: {format: R8G8B8A8_UNORM, samples: 8, usage: [COLOR_ATTACHMENT, SAMPLED]}
  out: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
renderPasses:
  main:
    attachments:
      a: {image: ms, loadOp: CLEAR, storeOp: STORE}
      b: {image: out, loadOp: DONT_CARE, storeOp: STORE}
      c: {image: out, loadOp: LOAD, storeOp: DONT_CARE}
    subpasses: [{colorAttachments: [a], resolveAttachments: [b]}]
pipelines:
  opaque: {renderPass: main, multisampleState: {rasterizationSamples: 4}}
commands:
  - beginRenderPass: {renderPass: main}
  - draw: {pipeline: opaque, vertexCount: 3}
  - endRenderPass
  - readImage: {image: out}
"""


def check(folder: Path, text: str, *arguments: str) -> tuple[int, list[dict[str, Any]]]:
    (folder / "f.msaa.yaml").write_text(text, encoding="utf-8")
    done = run(folder, "check", "--output", "json", *arguments, "f.msaa.yaml")
    return done.returncode, json.loads(done.stdout)["findings"]


def test_the_whole_frame_has_findings(tmp_path: Path) -> None:
    code, findings = check(tmp_path, FRAME)
    assert code == 1
    assert {"MSAA101", "MSAA201", "MSAA212"} <= {found["code"] for found in findings}


@pytest.mark.parametrize(
    ("before", "after", "error", "left", "gone"),
    [
        # A key at each level: what it may say is not taken for absent.
        ("images:", "weird: 1\nimages:", "MSAA902", {"MSAA101", "MSAA212"}, {"MSAA201"}),
        ("samples: 8,", "samples: 8, colour: red,", "MSAA902", {"MSAA101", "MSAA212"}, set()),
        ("  main:\n", "  main:\n    weird: {attachment: c}\n", "MSAA902", {"MSAA101"}, {"MSAA212"}),
        (
            "[{colorAttachments",
            "[{weird: c, colorAttachments",
            "MSAA902",
            {"MSAA101", "MSAA201"},
            {"MSAA212"},
        ),
        (
            "{renderPass: main, mu",
            "{weird: 1, renderPass: main, mu",
            "MSAA902",
            {"MSAA101", "MSAA201", "MSAA212"},
            set(),
        ),
        (
            "readImage: {image: out}",
            "readImage: {image: out, weird: ms}",
            "MSAA902",
            {"MSAA101", "MSAA212"},
            {"MSAA201"},
        ),
        (
            "readImage: {image: out}",
            "raedImage: {image: ms}",
            "MSAA902",
            {"MSAA101", "MSAA212"},
            {"MSAA201"},
        ),
        # Values and names.
        (
            "usage: [COLOR_ATTACHMENT, SAMPLED]}\n  out",
            "usage: [COLOR_ATACHMENT]}\n  out",
            "MSAA903",
            {"MSAA101", "MSAA212"},
            set(),
        ),
        (
            "a: {image: ms, loadOp: CLEAR, storeOp: STORE}",
            "a: {image: ms, loadOp: CLEAR, storeOp: STOER}",
            "MSAA903",
            {"MSAA101"},
            {"MSAA201"},
        ),
        ("colorAttachments: [a]", "colorAttachments: [x]", "MSAA904", {"MSAA101"}, {"MSAA212"}),
        (
            "readImage: {image: out}",
            "readImage: {image: mss}",
            "MSAA904",
            {"MSAA101", "MSAA212"},
            {"MSAA201"},
        ),
        ("a: {image: ms,", "a: {image: mss,", "MSAA904", {"MSAA101"}, {"MSAA201"}),
    ],
)
def test_the_rest_of_a_document_is_checked(
    tmp_path: Path, before: str, after: str, error: str, left: set[str], gone: set[str]
) -> None:
    assert before in FRAME
    code, findings = check(tmp_path, FRAME.replace(before, after, 1))
    codes = {found["code"] for found in findings}
    assert code == 2
    assert error in codes
    assert left <= codes, codes
    assert not gone & codes, codes
    assert not any(found["fix"] and found["fix"]["safe"] for found in findings)


def test_no_fix_is_made_before_the_errors_are_gone(tmp_path: Path) -> None:
    text = FRAME.replace("samples: 8,", "samples: 8, colour: red,")
    check(tmp_path, text, "--fix", "--unsafe-fixes")
    assert (tmp_path / "f.msaa.yaml").read_text(encoding="utf-8") == text


def test_after_a_syntax_error_nothing_is_checked(tmp_path: Path) -> None:
    code, findings = check(tmp_path, FRAME + "commands: [\n")
    assert code == 2
    assert {found["code"] for found in findings} <= {"MSAA901", "MSAA905"}


def test_what_is_not_known_to_be_whole_says_nothing_of_the_frame(tmp_path: Path) -> None:
    """Nothing else is checked where the device could not be read, since rules ask for it; a foreign
    key of it is left out.
    """
    assert {found["code"] for found in check(tmp_path, "device: {vendor: armm}\n" + FRAME)[1]} == {
        "MSAA903"
    }
    assert "MSAA201" in {
        found["code"] for found in check(tmp_path, "device: {vendor: arm, weird: 1}\n" + FRAME)[1]
    }


METAL = """
metal:
  textures: {ms: {pixelFormat: rgba8Unorm, textureType: type2DMultisample, sampleCount: 8, usage: [renderTarget]}}
  renderPasses: {main: {colorAttachments: [{texture: ms, loadAction: clear, storeAction: store}]}}
"""


def test_of_metal_only_foreign_keys_are_left_out(tmp_path: Path) -> None:
    code, findings = check(tmp_path, METAL.replace("sampleCount: 8,", "sampleCount: 8, weird: 1,"))
    assert code == 2
    assert {"MSAA902", "MSAA101"} <= {found["code"] for found in findings}
    code, findings = check(tmp_path, METAL.replace("sampleCount: 8,", "sampleCount: 9,"))
    assert {found["code"] for found in findings} == {"MSAA903"}


def _documents() -> list[tuple[str, dict[str, Any]]]:
    texts = [(str(example), example.text) for example in all_examples()]
    texts += [
        (str(path), path.read_text(encoding="utf-8"))
        for path in sorted((ROOT / "examples").rglob("*.msaa.yaml"))
    ]
    parsed = (
        (name, [plain(root) for root in parse(Source(name, text), Limits()).documents])
        for name, text in texts
    )
    return [
        (name, documents[0])
        for name, documents in parsed
        if len(documents) == 1 and isinstance(documents[0], dict)
    ]


def plain(node: Node) -> Any:
    """The value of a tree."""
    if node.kind == "mapping":
        return {key: plain(value) for key, value in node.value.items()}
    return [plain(item) for item in node.value] if node.kind == "sequence" else node.value


WRONG = ("bogus", -1, 3, None, {}, [], 1.5, True, {"weird": 1}, ["bogus"])
NAMED = {
    "images",
    "renderPasses",
    "framebuffers",
    "pipelines",
    "attachments",
    "textures",
    "sampleCountChoices",
    "renderTargets",
}


def places(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """The paths of a value and of all that it contains."""
    yield path
    for key, value in (
        node.items()
        if isinstance(node, dict)
        else enumerate(node)
        if isinstance(node, list)
        else ()
    ):
        yield from places(value, (*path, key))


def misspelled(random: Random, word: str) -> str:
    at = random.randrange(len(word))
    return random.choice(
        (
            word[:at] + word[at + 1 :],
            word[:at] + word[at] + word[at:],
            f"{word[:at]}x{word[at + 1 :]}",
        )
    )


def corrupt(random: Random, frame: dict[str, Any]) -> None:
    """Inserts an unknown key, misspells a key, or replaces a value, at one place."""
    path = random.choice(list(places(frame)))
    parents: list[Any] = [frame]
    for part in path:
        parents.append(parents[-1][part])
    node = parents.pop()
    if isinstance(node, dict) and (not path or random.random() < 0.4):
        node[random.choice(("weird", "vendorThing", "x"))] = random.choice(
            (1, "foo", {"attachment": 0}, {"image": "color"})
        )
        return
    parent, last = parents[-1], path[-1]
    if isinstance(parent, dict) and not (NAMED & set(path[-2:-1])) and random.random() < 0.4:
        new = misspelled(random, last)
        items = [(new if key == last else key, value) for key, value in parent.items()]
        parent.clear()
        parent.update(items)
    else:
        parent[last] = (
            misspelled(random, node)
            if isinstance(node, str) and node and random.random() < 0.6
            else random.choice(WRONG)
        )


def mistakes(frame: dict[str, Any]) -> tuple[bool, set[tuple[str, str]]]:
    """Whether the description has errors, and the errors and warnings of rules."""
    findings = lint(text=json.dumps(frame), filename="frame.msaa.json", isolated=True).findings
    has_errors = any(
        found.code in ("MSAA901", "MSAA902", "MSAA903", "MSAA904") for found in findings
    )
    return has_errors, {
        (found.code, found.subject)
        for found in findings
        if not found.fatal and found.severity != "note"
    }


DOCUMENTS = _documents()


@given(st.sampled_from(DOCUMENTS), st.integers(0, 2**32))
@at_most()
def test_an_error_adds_no_finding(document: tuple[str, dict[str, Any]], seed: int) -> None:
    _, frame = document
    changed = json.loads(json.dumps(frame))
    corrupt(Random(seed), changed)
    has_errors, found = mistakes(changed)
    # What is no error may be another frame.
    assume(has_errors)
    assert found <= mistakes(frame)[1]
