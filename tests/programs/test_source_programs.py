"""The comparison of findings in source code with a table of what a person found."""

from __future__ import annotations

from pathlib import Path

import pytest

from . import source_programs

PASS = """\
#include <vulkan/vulkan.h>

/* attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE; in a comment */
VkRenderPass makePass(VkDevice device, VkSampleCountFlagBits count) {
    VkAttachmentDescription attachments[2] = {};
    attachments[0].samples = VK_SAMPLE_COUNT_4_BIT;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkAttachmentReference resolve = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass = {};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    VkRenderPass pass;
    vkCreateRenderPass(device, &info, 0, &pass);
    return pass;
}

void forget(VkAttachmentDescription *unused) {
    unused->storeOp = VK_ATTACHMENT_STORE_OP_STORE;
}
"""

HEADING = "program\tkind\tfile\tline\trule\tverdict\treason\n"


@pytest.fixture
def programs(tmp_path: Path) -> Path:
    for name, text in (("stored", PASS), ("empty", "int main() { return 0; }\n")):
        (tmp_path / name / "src").mkdir(parents=True)
        (tmp_path / name / "src" / "render.cpp").write_text(text, encoding="utf-8")
    return tmp_path


def table(folder: Path, *rows: str) -> str:
    path = folder / "table.tsv"
    path.write_text(
        HEADING + "".join(row.replace(" ", "\t", 6) + "\n" for row in rows), encoding="utf-8"
    )
    return str(path)


def test_found(programs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = table(
        programs,
        "stored game src/render.cpp 8 MSAA201 expected stored",
        "empty engine - 0 - clean nothing",
    )
    assert (
        source_programs.main([str(programs), rows, "--texts", "--findings", str(programs / "kept")])
        == 0
    )
    printed = capsys.readouterr().out
    assert "stored               game       found 1 of 1, false 0;" in printed
    assert "read      storeOp 2 of 3, samples 1 of 1" in printed
    assert "unread    src/render.cpp:28 storeOp" in printed
    assert "\nall                 2      1    1    1.00      0      1.00         0\n" in printed
    assert sorted(path.name for path in (programs / "kept").iterdir()) == [
        "empty.json",
        "stored.json",
    ]


def test_missed_and_false(programs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = table(
        programs,
        "stored game src/render.cpp 10 MSAA201 expected elsewhere",
        "empty game src/render.cpp 1 MSAA401 expected image",
    )
    assert source_programs.main([str(programs), rows]) == 1
    printed = capsys.readouterr().out
    assert "missed    src/render.cpp:10 MSAA201 elsewhere" in printed
    assert "missed    src/render.cpp:1 MSAA401 image" in printed
    assert "false     src/render.cpp:8 MSAA201 `attachments[0]` is resolved" in printed
    assert "\nall                 2      0    2    0.00      1      0.00         0\n" in printed


def test_groups_and_debatable(programs: Path, capsys: pytest.CaptureFixture[str]) -> None:
    group = (
        "stored game src/render.cpp 8 MSAA403#color expected transient",
        "stored game src/render.cpp 8 MSAA201#color expected stored",
    )
    assert (
        source_programs.main([str(programs), table(programs, *group), "--program", "stored"]) == 0
    )
    assert "found 1 of 1, false 0" in capsys.readouterr().out
    near = table(programs, "stored game src/render.cpp 6 MSAA201 debatable maybe")
    assert source_programs.main([str(programs), near]) == 0
    assert "debatable src/render.cpp:8 MSAA201" in capsys.readouterr().out
    denied = table(
        programs,
        "stored game src/render.cpp 6 MSAA201 debatable maybe",
        "stored game src/render.cpp 8 MSAA201 false loaded later",
    )
    assert source_programs.main([str(programs), denied]) == 1
    assert "false     src/render.cpp:8 MSAA201" in capsys.readouterr().out


def test_wrong_verdict(programs: Path) -> None:
    with pytest.raises(ValueError, match=r"table.tsv:2: 'maybe' is not a verdict"):
        source_programs.table(
            Path(table(programs, "stored game src/render.cpp 8 MSAA201 maybe stored"))
        )


def test_stated() -> None:
    text = """
    VkImageCreateInfo info = {};  // info.samples = VK_SAMPLE_COUNT_8_BIT;
    info.samples = msaa ? VK_SAMPLE_COUNT_4_BIT : count;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    #if 0
    info.samples = VK_SAMPLE_COUNT_2_BIT;
    #endif
    a.setSamples(count).setStoreOp(vk::AttachmentStoreOp::eStore);
    attachment.storeOp =
        discard ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE;
    other.storeOp = first.storeOp;
    """
    assert source_programs.stated(text) == ({8, 10}, {3, 8})
    assert source_programs.stated("wave.samples = 4;") == (set(), set())


def test_rows_of_the_repository() -> None:
    path = Path(__file__).parents[1] / "data" / "programs" / "source_findings.tsv"
    rows = source_programs.table(path)
    commits = {
        line.split("\t")[0]
        for line in path.with_name("source_repositories.tsv")
        .read_text(encoding="utf-8")
        .splitlines()[1:]
    }
    assert {row.program for row in rows} == commits
    assert len({(row.program, row.place, row.verdict) for row in rows}) == len(rows)
    assert all((row.line > 0) == (row.verdict != "clean") for row in rows)
