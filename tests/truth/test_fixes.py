"""A finding that says `(safe: --fix)` is fixed by `--fix`, and no fix makes a finding that was not
there.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

SUBPASSES = """\
images:
  d: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  o: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
  c: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]}
  p: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
renderPasses:
  a:
    attachments:
      c: {image: c, loadOp: CLEAR, storeOp: DONT_CARE}
      d: {image: d, loadOp: CLEAR, storeOp: DONT_CARE}
      o: {image: o, loadOp: DONT_CARE, storeOp: STORE}
      p: {image: p, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
    - {colorAttachments: [c], depthStencilAttachment: d, depthStencilResolve: {attachment: o, depthResolveMode: SAMPLE_ZERO}}
    - colorAttachments: [c]
      resolveAttachments: [p]
      depthStencilAttachment: d
      depthStencilResolve: {attachment: o, depthResolveMode: SAMPLE_ZERO}
"""
RENDERINGS = """\
images:
  d: {format: D32_SFLOAT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
  o: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
  p: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}
commands:
- beginRendering: {depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE, resolveMode: SAMPLE_ZERO, resolveImage: o}}
- endRendering
- beginRendering: {depthAttachment: {image: d, loadOp: LOAD, storeOp: DONT_CARE, resolveMode: SAMPLE_ZERO, resolveImage: o}}
- endRendering
- present: {image: p}
"""


@pytest.mark.parametrize("text", [SUBPASSES, RENDERINGS])
def test_what_is_said_to_be_fixed_is_fixed(text: str, tmp_path: Path) -> None:
    def findings() -> list[dict[str, object]]:
        return list(
            json.loads(
                run(tmp_path, "check", "--output", "json", "--no-cache", "frame.yaml").stdout
            )["findings"]
        )

    (tmp_path / "frame.yaml").write_text(text)
    before = findings()
    safe = [
        (f["code"], f["subject"])
        for f in before
        if f["fixable"] and f["fix"]["safe"] and not f["fix"]["shown"]
    ]  # type: ignore[index]
    assert any(code == "MSAA308" for code, _ in safe)
    run(tmp_path, "check", "--fix", "--no-cache", "frame.yaml")
    after = [(f["code"], f["subject"]) for f in findings()]
    assert not set(after) & set(safe)
    assert set(after) <= {(f["code"], f["subject"]) for f in before}
