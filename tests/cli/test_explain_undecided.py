"""`check --explain-undecided`: what to add to an input so that rules are decided."""

import json
from pathlib import Path

import pytest

from tests.command import run

FRAME = """\
images:
  color: {format: R8G8B8A8_UNORM, samples: 4, memory: [DEVICE_LOCAL]}
renderPasses:
  main:
    attachments:
      color: {image: color, loadOp: CLEAR, storeOp: DONT_CARE}
    subpasses: [{colorAttachments: [color]}]
"""


def explained(folder: Path, *arguments: str) -> list[str]:
    done = run(folder, "check", "--isolated", "--explain-undecided", *arguments)
    return [
        line
        for line in done.stdout.splitlines()
        if ": undecided: " in line or "undecided rules" in line
    ]


def test_each_rule_names_the_missing_key_its_place_and_its_values(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(FRAME)
    (line,) = explained(tmp_path, "a.msaa.yaml", "--select", "MSAA401")
    assert line == (
        "a.msaa.yaml:2:3: undecided: multisampled-image-not-transient (MSAA401): "
        "add `usage` to `images.color`: a list of VkImageUsageFlagBits"
    )
    (tmp_path / "a.msaa.yaml").write_text(
        FRAME.replace("samples: 4", "samples: 4, usage: [COLOR_ATTACHMENT]")
    )
    assert explained(tmp_path, "a.msaa.yaml", "--select", "MSAA401") == []


def test_only_keys_that_decide_something_are_named(tmp_path: Path) -> None:
    """MSAA101 asks for the sample count alone; the format, which its other cases ask for, is not
    named.
    """
    (tmp_path / "a.msaa.yaml").write_text(FRAME.replace("format: R8G8B8A8_UNORM, samples: 4, ", ""))
    (line,) = explained(tmp_path, "a.msaa.yaml", "--select", "MSAA101")
    assert line.endswith("(MSAA101): add `samples` to `images.color`: 1, 2, 4, 8, 16, 32 or 64")


def test_the_device_may_come_from_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        FRAME.replace("samples: 4", "samples: 4, usage: [COLOR_ATTACHMENT]")
    )
    (line,) = explained(tmp_path, "a.msaa.yaml", "--select", "MSAA102")
    assert line == (
        "a.msaa.yaml:1:1: undecided: sample-count-unsupported (MSAA102): add `device` to the "
        "description (or use `--profile`): "
        "a device's name, or a mapping of what it supports"
    )
    assert explained(tmp_path, "a.msaa.yaml", "--select", "MSAA102", "--profile", "mali-g76") == []


def test_keys_of_metal_are_metals(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        "metal:\n  textures:\n    color: {pixelFormat: rgba8Unorm, sampleCount: 4}\n"
        "  renderPasses:\n    main: {colorAttachments: [{texture: color, storeAction: dontCare}]}\n"
    )
    lines = explained(tmp_path, "a.msaa.yaml", "--select", "MSAA803,MSAA808")
    assert [line.partition(": add ")[2] for line in lines] == [
        "`storageMode` to `metal.textures.color`: shared, managed, private or memoryless",
        "`usage` to `metal.textures.color`: a list of MTLTextureUsage",
        "`loadAction` to `metal.renderPasses.main.colorAttachments[0]`: dontCare, load or clear",
        "`loadAction` to `metal.renderPasses.main.colorAttachments[0]`: dontCare, load or clear",
    ]


def test_many_structures_are_counted(tmp_path: Path) -> None:
    images = "".join(
        f"  i{number}: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}}\n"
        for number in range(9)
    )
    (tmp_path / "a.msaa.yaml").write_text(f"images:\n{images}")
    lines = explained(tmp_path, "a.msaa.yaml", "--select", "MSAA405")
    assert [line.partition("(MSAA405): ")[2].split(":")[0] for line in lines] == [
        "add `memory` to `images.i0`",
        "add `memory` to `images.i1`",
        "add `memory` to `images.i2`",
        "the same for 6 more",
    ]


def test_json_has_the_keys_and_the_summary_counts_rules_by_key(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(FRAME)
    arguments = ("check", "--isolated", "a.msaa.yaml", "--select", "MSAA401,MSAA404")
    data = json.loads(run(tmp_path, *arguments, "--output", "json").stdout)
    key = {
        "key": "images.color.usage",
        "values": "a list of VkImageUsageFlagBits",
        "converted": False,
        "line": 2,
        "column": 3,
    }
    assert [[{**each, **key} == each for each in entry["keys"]] for entry in data["undecided"]] == [
        [True],
        [True],
    ]
    assert data["summary"]["missing_keys"] == {"images.*.usage": 2}
    text = run(tmp_path, *arguments).stdout
    assert (
        "\n2 rules undecided, missing keys: images.*.usage (2); --explain-undecided lists what to "
        "add\n" in text
    )


def test_a_capture_is_converted_first(tmp_path: Path) -> None:
    from tests.paths import ROOT

    lines = explained(
        tmp_path, str(ROOT / "examples" / "capture" / "forward.jsonl"), "--select", "MSAA702"
    )
    assert lines and all(" in what `msaa-lint convert` writes: " in line for line in lines)


def test_a_pipeline_dump_has_no_place_for_images(tmp_path: Path) -> None:
    from tests.paths import ROOT

    lines = explained(tmp_path, str(ROOT / "tests" / "data" / "vulkan_sc_renderpass.json"))
    assert lines
    assert all(
        ": no single key decides it for " in line
        or "add `device` to the description (or use `--profile`)" in line
        for line in lines
    )


def test_undecided_rules_of_source_code_are_not_listed(tmp_path: Path) -> None:
    pytest.importorskip("tree_sitter_cpp")
    (tmp_path / "a.cpp").write_text(
        "VkAttachmentDescription a{};\nvoid f() { a.samples = VK_SAMPLE_COUNT_4_BIT; }\n"
    )
    assert explained(tmp_path, "a.cpp") == [
        "a.cpp: undecided rules of source code are not listed; complete the description that "
        "`msaa-lint convert` writes"
    ]
