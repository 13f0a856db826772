"""The examples find what their README says, at the lines where it is."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from msaa_lint import lint

EXAMPLES = Path(__file__).parent.parent / "examples"

EXPECTED: dict[str, list[tuple[int, str]]] = {
    "khronos-msaa/inline.msaa.yaml": [],
    "khronos-msaa/stored-and-resolved.msaa.yaml": [
        (6, "multisampled-image-not-transient"),
        (7, "multisampled-image-not-transient"),
        (13, "multisampled-attachment-stored"),
        (14, "multisampled-depth-stored"),
    ],
    "khronos-msaa/color-separate.msaa.yaml": [(30, "resolve-outside-pass")],
    "khronos-msaa/depth-unresolved.msaa.yaml": [(16, "depth-read-without-resolve"), (29, "resolve-outside-pass")],
    "tutorial/final.msaa.yaml": [
        (7, "sample-count-above-four"),
        (7, "sample-count-not-portable"),
        (7, "transient-not-lazily-allocated"),
        (8, "multisampled-image-not-transient"),
        (8, "sample-count-above-four"),
        (8, "sample-count-not-portable"),
        (17, "multisampled-attachment-stored"),
        (17, "transient-needs-memory"),
        (47, "sample-shading-everywhere"),
    ],
    "notes/notes.msaa.yaml": [(6, "multisampled-attachment-stored")],
    "impeller/article.msaa.yaml": [
        (7, "transient-not-lazily-allocated"),
        (14, "multisampled-image-not-transient"),
        (34, "present-layout-on-private-image"),
        (51, "reused-attachment-unsynchronised"),
    ],
    "impeller/best-practice.msaa.yaml": [],
    "shader-resolve/note.msaa.yaml": [
        (25, "sample-shading-ineffective"),
        (35, "half-float-resolve-overflow"),
        (35, "shader-resolve-off-tile"),
    ],
    "frame/deferred-forward.msaa.yaml": [
        (16, "multisampled-attachment-loaded"),
        (19, "multisampled-attachment-loaded"),
        (43, "multisampled-float-blending"),
        (53, "multisampled-stencil-stored"),
        (65, "framebuffer-readback"),
    ],
}


def names() -> list[str]:
    return sorted(path.relative_to(EXAMPLES).as_posix() for path in EXAMPLES.rglob("*.msaa.*"))


def test_every_example_is_expected_and_described() -> None:
    assert names() == sorted(EXPECTED)
    readme = (EXAMPLES / "README.md").read_text(encoding="utf-8")
    assert sorted(re.findall(r"^\| \[([^\]]+)\]", readme, re.MULTILINE)) == names()


@pytest.mark.parametrize("name", sorted(EXPECTED))
def test_example(name: str) -> None:
    result = lint(str(EXAMPLES / name), isolated=True)
    found = []
    for finding in result.findings:
        assert finding.span is not None
        found.append((result.sources[finding.file].position(finding.span.start).line, finding.rule))
    assert sorted(found) == EXPECTED[name]
