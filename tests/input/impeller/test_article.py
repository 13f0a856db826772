"""The page on Impeller is true: its examples are what it says. Of its table see
tests/test_texts.py.
"""

from __future__ import annotations

import re

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.readers import description
from tests.command import run
from tests.paths import ROOT

EXAMPLES = ROOT / "examples" / "impeller"
PAGE = (ROOT / "docs" / "impeller.md").read_text(encoding="utf-8")


@pytest.mark.parametrize(("number", "name"), [(0, "engine-vulkan"), (1, "engine-metal")])
def test_the_engines_examples_are_what_convert_writes(number: int, name: str) -> None:
    made = run(EXAMPLES, "convert", "engine-shorthand.msaa.yaml").stdout.split("---\n")
    comment, _, text = (EXAMPLES / f"{name}.msaa.yaml").read_text(encoding="utf-8").partition("\n")
    assert comment.startswith("# ")
    assert text == made[number]


def test_the_shorthand_that_the_page_shows_is_read() -> None:
    block = re.search(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    assert block is not None
    (root,) = parse(Source("page", block[1]), Limits()).documents
    assert description.read(Source("page", block[1]), root).problems == ()


def test_a_property_that_metal_has_not_is_a_mistake_with_the_nearest() -> None:
    text = "metal: {renderPipelines: {main: {depthStencilAttachmentPixelFormat: depth32Float}}}"
    (root,) = parse(Source("page", text), Limits()).documents
    (problem,) = description.read(Source("page", text), root).problems
    assert problem.code == "MSAA902"
    assert problem.message.endswith(": did you mean `stencilAttachmentPixelFormat`?")
