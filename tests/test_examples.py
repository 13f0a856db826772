"""The examples find what their README says, at the lines where it is."""

from __future__ import annotations

import re

import pytest

from msaa_lint import lint
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"

EXPECTED: dict[str, list[tuple[int, str]]] = {
    "khronos-msaa/inline.msaa.yaml": [],
    "lit/forward.msaa.yaml": [],
    "khronos-msaa/stored-and-resolved.msaa.yaml": [
        (6, "multisampled-image-not-transient"),
        (7, "multisampled-image-not-transient"),
        (13, "multisampled-attachment-stored"),
        (14, "multisampled-depth-stored"),
    ],
    "khronos-msaa/color-separate.msaa.yaml": [(30, "resolve-outside-pass")],
    "khronos-msaa/depth-unresolved.msaa.yaml": [
        (16, "depth-read-without-resolve"),
        (29, "resolve-outside-pass"),
    ],
    "phone/frame.msaa.yaml": [
        (8, "multisampled-image-not-transient"),
        (18, "multisampled-depth-stored"),
        (39, "framebuffer-readback"),
        (46, "hdr-resolved-before-tone-mapping"),
        (46, "resolve-outside-pass"),
    ],
    "phone/forward.msaa.yaml": [
        (26, "hdr-resolved-before-tone-mapping"),
        (35, "framebuffer-readback"),
        (60, "multisampled-float-blending"),
    ],
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
    "tutorial/choice.msaa.yaml": [
        (5, "source-stencil-counts-ignored"),
        (7, "source-sample-count-maximum"),
        (13, "source-sample-bit-retested"),
    ],
    "notes/choice.msaa.yaml": [
        (4, "source-stencil-counts-ignored"),
        (5, "source-sample-masks-compared"),
        (9, "source-sample-masks-compared"),
    ],
    "notes/notes.msaa.yaml": [(6, "multisampled-attachment-stored")],
    "impeller/article.msaa.yaml": [
        (7, "transient-not-lazily-allocated"),
        (14, "multisampled-image-not-transient"),
        (34, "present-layout-on-private-image"),
        (51, "reused-attachment-unsynchronised"),
    ],
    "impeller/best-practice.msaa.yaml": [],
    "impeller/article-advice.msaa.yaml": [
        (14, "resolve-then-copy"),
        (39, "reused-attachment-unsynchronised"),
        (59, "attachment-blocks-compression"),
        (59, "transient-not-lazily-allocated"),
        (59, "transient-usage-conflict"),
        (66, "transient-needs-memory"),
        (67, "depth-read-without-resolve"),
        (79, "shader-resolve-off-tile"),
        (105, "multisampled-attachment-loaded"),
        (106, "multisampled-depth-stored"),
        (142, "multisampled-fullscreen-pass"),
    ],
    "impeller/article-metal.msaa.yaml": [
        (15, "metal-usage-blocks-memoryless"),
        (29, "metal-resolve-then-blit"),
        (31, "metal-samples-stored-unread"),
        (35, "metal-depth-stored-unread"),
    ],
    "impeller/article-shorthand.msaa.yaml": [
        (13, "resolve-target-loaded"),
        (14, "multisampled-depth-stored"),
        (14, "multisampled-image-not-transient"),
        (14, "multisampled-stencil-stored"),
        (15, "resolve-target-loaded"),
        (18, "sample-count-unsupported"),
        (18, "sixteen-samples-biased"),
        (33, "metal-memoryless-possible"),
        (33, "metal-samples-stored-unread"),
        (34, "metal-depth-stored-unread"),
        (34, "metal-depth-stored-unread"),
        (34, "metal-memoryless-possible"),
        (35, "tile-budget-exceeded"),
        (38, "metal-sample-count-unsupported"),
    ],
    "impeller/engine-metal.msaa.yaml": [],
    "impeller/engine-shorthand.msaa.yaml": [(6, "resolve-target-loaded")],
    "impeller/engine-vulkan.msaa.yaml": [(42, "resolve-target-loaded")],
    "shader-resolve/note.msaa.yaml": [
        (25, "sample-shading-ineffective"),
        (35, "half-float-resolve-overflow"),
        (35, "shader-resolve-off-tile"),
    ],
    "frame/deferred-forward.msaa.yaml": [
        (16, "multisampled-attachment-loaded"),
        (19, "multisampled-attachment-loaded"),
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


def test_the_example_in_code() -> None:
    result = lint(str(EXAMPLES / "code" / "forward.cpp"), isolated=True)
    found = []
    for finding in result.findings:
        assert finding.span is not None
        assert finding.confidence == ("medium" if finding.code == "MSAA852" else "low")
        found.append((result.sources[finding.file].position(finding.span.start).line, finding.rule))
    assert found == [
        (29, "source-sample-masks-compared"),
        (61, "multisampled-attachment-stored"),
        (95, "multisampled-image-not-transient"),
    ]
