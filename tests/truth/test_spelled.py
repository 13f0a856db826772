"""A frame has the same findings, prices, fixes, and exit codes however its description is
written.
"""

from __future__ import annotations

import json
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tests.command import run
from tests.linter.fixes.linting import lint, meaning
from tests.linter.fixes.spellings import data_of
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples
from tests.truth.spelled import STYLES

EXAMPLES = sorted((ROOT / "examples").rglob("*.msaa.yaml"))
TEXTS = {str(each): each.text for each in all_examples()} | {
    path.stem: path.read_text(encoding="utf-8") for path in EXAMPLES
}
DATA = {name: data_of(text) for name, text in TEXTS.items() if "\n---\n" not in text}


STATED = (
    "code",
    "subject",
    "message",
    "severity",
    "confidence",
    "price",
    "fixable",
    "fix",
    "notes",
)


def said(text: str, *options: str) -> tuple[Any, ...]:
    """What `check` says of a description, without places: exit code, findings with prices and
    fixes, what the fixes save, and how much more a limit than all of them accept.
    """
    with TemporaryDirectory() as folder:
        Path(folder, "frame.msaa.yaml").write_text(text, encoding="utf-8")
        done = run(
            Path(folder),
            "check",
            "--no-cache",
            "--output",
            "json",
            "--fail-on-cost",
            "1MB/s",
            *options,
            "frame.msaa.yaml",
        )
    report = json.loads(done.stdout)
    findings = [
        json.dumps(
            {
                key: found[key]
                for key in (
                    "code",
                    "subject",
                    "message",
                    "severity",
                    "confidence",
                    "price",
                    "fixable",
                    "fix",
                    "notes",
                )
            }
        )
        for found in report["findings"]
    ]
    return (
        done.returncode,
        sorted(findings),
        report["summary"]["price"],
        report["summary"]["savings"],
        done.stderr,
    )


def fixed(text: str) -> list[list[object]]:
    """What the description means after its safe fixes, and after all fixes."""
    with TemporaryDirectory() as folder:
        path = Path(folder, "frame.msaa.yaml")
        texts = []
        for options in (["--fix"], ["--fix", "--unsafe-fixes"]):
            path.write_text(text, encoding="utf-8")
            run(Path(folder), "check", "--no-cache", *options, path.name)
            texts.append(path.read_text(encoding="utf-8"))
    return [meaning(lint(each)) for each in texts]


@examples(2)
@given(st.sampled_from(sorted(DATA)), st.sampled_from(sorted(STYLES)), st.integers(0, 2**32))
@example("note.msaa", "json", 0)
@example("multisampled-image-invalid-bad-3", "aliases in block", 0)
def test_as_another_text(name: str, style: str, seed: int) -> None:
    text = STYLES[style](DATA[name], Random(seed))
    assert said(text) == said(TEXTS[name]), text
    if "shuffled" not in style:
        assert fixed(text) == fixed(TEXTS[name]), text


TWO = """\
images:
  a: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  b: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  x: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
  y: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
frame: {width: 1920, height: 1080, fps: 60}
renderPasses:
  p:
    attachments:
      a: ONE
      b: OTHER
      x: {image: x, loadOp: DONT_CARE, storeOp: STORE}
      y: {image: y, loadOp: DONT_CARE, storeOp: STORE}
    subpasses: [{colorAttachments: [a, b], resolveAttachments: [x, y]}]
"""
STORED = "loadOp: CLEAR, storeOp: STORE"
PLAIN = TWO.replace("ONE", f"{{image: a, {STORED}}}").replace("OTHER", f"{{image: b, {STORED}}}")


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (f"&s {{image: a, {STORED}}}", "{<<: *s, image: b}"),
        ("{image: a, loadOp: CLEAR, storeOp: &s STORE}", "{image: b, loadOp: CLEAR, storeOp: *s}"),
        (f"{{<<: &s {{{STORED}}}, image: a}}", "{<<: *s, image: b}"),
    ],
)
def test_a_fix_that_two_findings_share_by_an_anchor(one: str, other: str) -> None:
    text = TWO.replace("ONE", one).replace("OTHER", other)
    assert said(text) == said(PLAIN)
    assert said(text)[0] == 1
    findings = [json.loads(found) for found in said(text)[1] if '"MSAA201"' in found]
    assert [(found["fixable"], found["price"]["write_mb_per_s"]) for found in findings] == [
        (True, 1990.656)
    ] * 2
    assert fixed(text) == fixed(PLAIN)


@pytest.mark.parametrize("kept", ["a", "b"])
def test_a_fix_of_one_of_two_structures_with_an_anchor(kept: str) -> None:
    """One image is read after the pass, so only the store of the other one is a mistake."""
    read = (
        f"commands: [{{beginRenderPass: {{renderPass: p}}}}, endRenderPass, {{readImage: "
        f"{{image: {kept}, stage: FRAGMENT}}}}]\n"
    )

    def text(one: str, other: str) -> str:
        usages = TWO.replace(f"{kept}: {{format: R8G8B8A8_UNORM, samples: 4, usage: "
            "[COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]",
                             f"{kept}: {{format: R8G8B8A8_UNORM, samples: 4, usage: "
                             "[COLOR_ATTACHMENT, SAMPLED]")  # fmt: skip
        return usages.replace("ONE", one).replace("OTHER", other) + read

    plain = text(f"{{image: a, {STORED}}}", f"{{image: b, {STORED}}}")
    shared = text(f"&s {{image: a, {STORED}}}", "{<<: *s, image: b}")
    assert said(shared) == said(plain)
    assert fixed(shared) == fixed(plain)
    assert any('"MSAA201"' in found and '"fixable": true' in found for found in said(shared)[1])


RESOLVED = """\
renderPasses:
  p:
    attachments:
      d: {format: D16_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
      e: {format: D16_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: DONT_CARE}
    subpasses:
      - KEYS
"""


@pytest.mark.parametrize("comment", ["", "  # why"])
def test_a_key_goes_wherever_it_is(comment: str) -> None:
    """The resolve of a depth buffer that nothing reads is removed from the first line of an item,
    too.
    """
    keys = [
        f"depthStencilResolve: {{attachment: e, depthResolveMode: SAMPLE_ZERO}}{comment}",
        "depthStencilAttachment: d",
    ]
    done = []
    for order in (keys, keys[::-1]):
        text = RESOLVED.replace("KEYS", "\n        ".join(order))
        removed = [json.loads(found) for found in said(text)[1] if "esolve" in found]
        assert removed and all(
            found["fixable"] and not found["fix"]["refusal"] for found in removed
        ), removed
        done.append(fixed(text))
        with TemporaryDirectory() as folder:
            path = Path(folder, "frame.msaa.yaml")
            path.write_text(text, encoding="utf-8")
            run(Path(folder), "check", "--no-cache", "--fix", "--unsafe-fixes", path.name)
            assert path.read_text(encoding="utf-8").count("# why") == bool(comment)
    assert done[0] == done[1]
