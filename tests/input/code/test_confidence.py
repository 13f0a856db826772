"""The confidence of findings in source code: medium where the code states every value that a
finding rests on, low where one is assumed.
"""

from __future__ import annotations

import json
from pathlib import Path
from string import Template
from typing import Any

import pytest

from tests.command import run

PROGRAM = Template("""\
#include <vulkan/vulkan.h>
$before
VkRenderPass create(VkDevice device, bool msaa, bool keep) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[0].samples = $samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = $store;
    attachments[1].format = VK_FORMAT_R8G8B8A8_UNORM;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = $resolve;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
$after
""")
LITERAL = {
    "before": "",
    "samples": "VK_SAMPLE_COUNT_4_BIT",
    "store": "VK_ATTACHMENT_STORE_OP_STORE",
    "resolve": "&resolve",
    "after": "",
}
CONDITIONAL = "VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT"
CHANGED = "int sampleCount = 2; void more() { sampleCount = 4; } void less() { sampleCount = 8; }"


def finding(folder: Path, changes: dict[str, str], name: str = "pass.cpp") -> dict[str, Any]:
    """The only finding of MSAA201 in a program."""
    (folder / name).write_text(PROGRAM.substitute(LITERAL | changes), encoding="utf-8")
    done = run(folder, "check", "--isolated", "--select", "MSAA201", "--output", "json", name)
    (found,) = json.loads(done.stdout)["findings"]
    assert done.returncode == (found["confidence"] == "medium")
    entry: dict[str, Any] = found
    return entry


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"before": "#define COUNT VK_SAMPLE_COUNT_8_BIT", "samples": "COUNT"},
        {"before": "constexpr auto kCount = VK_SAMPLE_COUNT_4_BIT;", "samples": "kCount"},
        {"before": "enum Samples { Few = 2, Many = 8 };", "samples": "(VkSampleCountFlagBits)Many"},
        {
            "before": "static VkSampleCountFlagBits count() { return VK_SAMPLE_COUNT_4_BIT; }",
            "samples": "count()",
        },
        {"samples": f"msaa ? {CONDITIONAL}"},
        {"samples": f"msaa ? {CONDITIONAL}", "resolve": "msaa ? &resolve : nullptr"},
    ],
)
def test_what_is_stated_has_medium_confidence(tmp_path: Path, changes: dict[str, str]) -> None:
    assert finding(tmp_path, changes)["confidence"] == "medium"


@pytest.mark.parametrize(
    ("changes", "note"),
    [
        (
            {"samples": "chooseSampleCount(device)"},
            "chooseSampleCount (line 6) is unknown; assumed to be 4",
        ),
        (
            {"samples": f"msaa ? {CONDITIONAL}", "resolve": "keep ? &resolve : nullptr"},
            "assumption: `keep` and `msaa` hold at the same time",
        ),
        (
            {"before": CHANGED, "samples": "(VkSampleCountFlagBits)sampleCount"},
            "assumption: functions write different values to `sampleCount`",
        ),
        (
            {"before": "int sampleCount = 4;", "samples": "(VkSampleCountFlagBits)sampleCount"},
            "assumption: `sampleCount` keeps its initial value",
        ),
    ],
)
def test_what_is_assumed_has_low_confidence(
    tmp_path: Path, changes: dict[str, str], note: str
) -> None:
    found = finding(tmp_path, changes)
    assert found["confidence"] == "low"
    assert found["notes"] == [note]


def test_an_assumption_lowers_the_findings_that_rest_on_it_alone(tmp_path: Path) -> None:
    literal = PROGRAM.substitute(LITERAL)
    other = PROGRAM.substitute(LITERAL | {"samples": "chooseSampleCount(device)"}).replace(
        "create(", "createOther("
    )
    (tmp_path / "two.cpp").write_text(literal + other, encoding="utf-8")
    done = run(
        tmp_path, "check", "--isolated", "--select", "MSAA201", "--output", "json", "two.cpp"
    )
    found = json.loads(done.stdout)["findings"]
    assert [(each["line"], each["confidence"]) for each in found] == [
        (8, "medium"),
        (8 + literal.count("\n"), "low"),
    ]
    assert (found[0]["notes"], len(found[1]["notes"])) == ([], 1)
