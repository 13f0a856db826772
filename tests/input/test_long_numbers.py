"""Numbers with more digits than Python converts (4300), or with digits that are not ASCII, are
values like any other.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.command import run

LONG = "9" * 5000
IMAGE = "images: {a: {format: R8G8B8A8_UNORM, samples: 8}}\n"
DEPTH = """\
renderPasses:
  forward:
    attachments: {depth: {format: D24_UNORM_S8_UINT, samples: 4, loadOp: CLEAR, storeOp: STORE}}
    subpasses: [{depthStencilAttachment: depth}]
"""
INPUTS = {
    "array.c": f"void f(void) {{ VkImageView views[{LONG}]; VkFramebufferCreateInfo info = {{0}}; "
    f"info.pAttachments = views; }}\n",
    "enumerant.cpp": f"void f() {{ vk::ImageCreateInfo i; i.samples = "
    f"vk::SampleCountFlagBits::e{LONG}; device.createImage(i); }}\n",
    "literal.swift": f"let descriptor = MTLTextureDescriptor()\ndescriptor.sampleCount = {LONG}\n",
    "constant.frag": f"#version 450\nlayout(constant_id = {LONG}) const int n = {LONG};\nvoid "
    f"main() {{}}\n",
    "samples.msaa.yaml": f"images: {{a: {{samples: {LONG}}}}}\n",
    "version.msaa.yaml": f'enabled: {{apiVersion: "1.\u00b2", extensions: []}}\n{DEPTH}',
    "family.msaa.yaml": f"device: {{family: apple{LONG}}}\n{IMAGE}",
    "samples.msaa.json": f'{{"images": {{"a": {{"samples": {LONG}}}}}}}',
    "capture.jsonl": f'{{"index":{LONG},"vkFunc":{{"name":"vkCreateImage","args":{{"pCreateInfo":{{"samples":{LONG}}}}}}}}}\n',
}


@pytest.mark.parametrize("name", INPUTS)
def test_in_inputs(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text(INPUTS[name], encoding="utf-8")
    done = run(tmp_path, "check", "--output", "json", name)
    assert done.returncode in (0, 1, 2)
    assert "MSAA941" not in {found["code"] for found in json.loads(done.stdout)["findings"]}, (
        done.stdout
    )


def test_in_editions(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(IMAGE, encoding="utf-8")
    done = run(tmp_path, "check", "--edition", LONG, "frame.msaa.yaml")
    assert (done.returncode, "internal error" in done.stderr) == (2, False), done.stderr
