"""One mistake in source code is one finding: the one whose fix solves it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from tests.command import run

PASS = """\
#include <vulkan/vulkan.h>
static VkAttachmentDescription attachment(VkSampleCountFlagBits samples, VkAttachmentStoreOp store) {
    VkAttachmentDescription description = {};
    description.format = VK_FORMAT_R8G8B8A8_UNORM;
    description.samples = samples;
    description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    description.storeOp = store;
    description.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    return description;
}
VkRenderPass create(VkDevice device) {
    VkAttachmentDescription attachments[4] = {
        ATTACHMENTS
        attachment(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE),
        attachment(VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_STORE_OP_STORE),
    };
    VkAttachmentReference colors[2] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkAttachmentReference resolves[2] = {{2, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}, {3, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 2;
    subpass.pColorAttachments = colors;
    subpass.pResolveAttachments = resolves;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 4;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
    return pass;
}
"""
STORED = "attachment(VK_SAMPLE_COUNT_4_BIT, VK_ATTACHMENT_STORE_OP_STORE),"
RENDERING = """\
#include <vulkan/vulkan.h>
void draw(VkDevice device, VkCommandBuffer commands, VkImageView target) {
    VkImageCreateInfo image = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    image.imageType = VK_IMAGE_TYPE_2D;
    image.format = VK_FORMAT_R8G8B8A8_UNORM;
    image.samples = VK_SAMPLE_COUNT_4_BIT;
    image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    VkImage color;
    vkCreateImage(device, &image, nullptr, &color);
    VkImageViewCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    info.image = color;
    VkImageView view;
    vkCreateImageView(device, &info, nullptr, &view);
    VkRenderingAttachmentInfo attachment = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    attachment.imageView = view;
    attachment.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    attachment.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    attachment.resolveImageView = target;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingInfo rendering = {VK_STRUCTURE_TYPE_RENDERING_INFO};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &attachment;
    vkCmdBeginRendering(commands, &rendering);
}
"""
COVERS = "covers transient-needs-memory (MSAA403) too"


def findings(folder: Path, text: str, *options: str) -> list[dict[str, Any]]:
    (folder / "a.cpp").write_text(text, encoding="utf-8")
    done = run(folder, "check", "--isolated", "--output", "json", *options, "a.cpp")
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return found


def test_two_rules_about_one_value_are_one_finding(tmp_path: Path) -> None:
    (found,) = findings(tmp_path, RENDERING, "--select", "MSAA201,MSAA403")
    assert (found["code"], found["line"], found["notes"][-1]) == ("MSAA201", 20, COVERS)


def test_a_rule_that_is_off_covers_nothing(tmp_path: Path) -> None:
    (found,) = findings(tmp_path, RENDERING, "--select", "MSAA403")
    assert (found["code"], found["line"], COVERS in found["notes"]) == ("MSAA403", 20, False)


def test_a_suppression_of_the_covered_rule_is_not_unused(tmp_path: Path) -> None:
    marked = RENDERING.replace("_STORE;", "_STORE;  // msaa-lint: ignore[MSAA201, MSAA403] kept")
    assert findings(tmp_path, marked, "--select", "MSAA201,MSAA403,MSAA911") == []


def test_two_attachments_with_a_value_each_are_two_findings(tmp_path: Path) -> None:
    text = PASS.replace("ATTACHMENTS", f"{STORED}\n{STORED}", 1)
    assert [each["line"] for each in findings(tmp_path, text, "--select", "MSAA201")] == [13, 14]
    text = PASS.replace("ATTACHMENTS", f"{STORED} {STORED}", 1)
    found = findings(tmp_path, text, "--select", "MSAA201")
    assert [(each["line"], each["column"]) for each in found] == [(13, 43), (13, 108)]


def test_a_value_that_several_attachments_take_is_one_finding(tmp_path: Path) -> None:
    changed = PASS.replace("ATTACHMENTS", f"{STORED}\n{STORED}", 1).replace(
        "storeOp = store;", "storeOp = VK_ATTACHMENT_STORE_OP_STORE;"
    )
    (found,) = findings(tmp_path, changed, "--select", "MSAA201")
    assert (found["line"], found["notes"]) == (7, ["the same applies to `description (1)`"])


def test_several_calls_are_one_finding(tmp_path: Path) -> None:
    text = PASS.replace(
        "ATTACHMENTS", f"{STORED}\n{STORED.replace('STORE_OP_STORE', 'STORE_OP_DONT_CARE')}", 1
    )
    calls = "void both(VkDevice device) { create(device); create(device); }\n"
    assert [each["line"] for each in findings(tmp_path, text + calls, "--select", "MSAA201")] == [
        13
    ]


def test_a_member_that_a_function_does_not_set_is_one_finding(tmp_path: Path) -> None:
    text = PASS.replace("description.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;", "")
    (found,) = findings(
        tmp_path,
        text.replace("ATTACHMENTS", f"{STORED}\n{STORED}", 1),
        "--select",
        "MSAA205,MSAA210",
    )
    assert (found["code"], found["line"]) == ("MSAA210", 3)


def test_a_member_that_two_elements_lack_are_two_findings(tmp_path: Path) -> None:
    helper = "    VkAttachmentDescription attachments[4] = {"
    text = PASS[: PASS.index(helper)] + helper + "};\n"
    for number in range(4):
        text += f"    attachments[{number}].format = VK_FORMAT_R8G8B8A8_UNORM;\n"
        text += (
            f"    attachments[{number}].samples = VK_SAMPLE_COUNT_{1 if number > 1 else 4}_BIT;\n"
        )
    text += PASS[PASS.index("    VkAttachmentReference colors") :]
    found = findings(tmp_path, text, "--select", "MSAA205,MSAA210")
    assert [(each["code"], each["line"], each["subject"][-2]) for each in found] == [
        ("MSAA210", 12, n) for n in "0123"
    ]


def test_a_description_has_every_finding(tmp_path: Path) -> None:
    (tmp_path / "a.cpp").write_text(RENDERING, encoding="utf-8")
    (tmp_path / "a.msaa.yaml").write_text(
        run(tmp_path, "convert", "a.cpp").stdout, encoding="utf-8"
    )
    done = run(
        tmp_path,
        "check",
        "--isolated",
        "--output",
        "json",
        "--select",
        "MSAA201,MSAA403",
        "a.msaa.yaml",
    )
    assert [each["code"] for each in json.loads(done.stdout)["findings"]] == ["MSAA201", "MSAA403"]
