"""One cause is one finding: of two rules that a mistake breaks, the more precise one reports it."""

from __future__ import annotations

import pytest

from tests.linter.fixes.linting import lint

PASS = """\
images:
  i: {{format: {format}, samples: {samples}, usage: [{usage}_ATTACHMENT, TRANSIENT_ATTACHMENT]}}
renderPasses:
  r:
    attachments:
      a: {{image: i, {operations}}}
    subpasses: [{{{reference}}}]
"""
DEPTH = {"usage": "DEPTH_STENCIL", "reference": "depthStencilAttachment: a"}
COLOR = {"usage": "COLOR", "reference": "colorAttachments: [a]", "format": "R8G8B8A8_UNORM"}
STENCIL = (
    "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: {}, stencilStoreOp: {}, initialLayout: {}"
)
WHOLE = "loadOp: {}, storeOp: {}, initialLayout: {}"


@pytest.mark.parametrize("samples", [1, 4])
@pytest.mark.parametrize(
    ("stated", "operations"),
    [
        ({**DEPTH, "format": "D24_UNORM_S8_UINT"}, STENCIL),
        ({**DEPTH, "format": "S8_UINT"}, STENCIL),
        ({**DEPTH, "format": "D32_SFLOAT"}, WHOLE),
        (COLOR, WHOLE),
    ],
)
def test_a_load_from_undefined(samples: int, stated: dict[str, str], operations: str) -> None:
    def codes(*words: str) -> list[str]:
        text = PASS.format(samples=samples, operations=operations.format(*words), **stated)
        return [
            found.code
            for found in lint(text).findings
            if found.subject.startswith("renderPasses") and found.code != "MSAA207"
        ]

    assert codes("LOAD", "DONT_CARE", "UNDEFINED") == ["MSAA210"]


def test_a_count_that_the_device_lacks_is_not_said_to_be_slow() -> None:
    text = (
        "device: mali-g76\nimages: {i: {format: R8G8B8A8_UNORM, samples: 64, usage: "
        "[COLOR_ATTACHMENT]}}\n"
    )
    codes = [found.code for found in lint(text).findings]
    assert "MSAA102" in codes and "MSAA101" not in codes


@pytest.mark.parametrize("samples", [1, 2])
def test_pipelines_with_another_count(samples: int) -> None:
    text = (
        "renderPasses: {r: {attachments: {a: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, "
        "storeOp: STORE}}, "
        "subpasses: [{colorAttachments: [a]}]}}\n"
        f"pipelines: {{p: {{renderPass: r, subpass: 0, multisampleState: {{rasterizationSamples: "
        f"{samples}}}}}}}\n"
    )
    assert [
        found.code for found in lint(text).findings if found.code in ("MSAA104", "MSAA511")
    ] == ["MSAA104"]
