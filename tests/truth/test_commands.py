"""What the specification forbids of copies, blits, resolves and their images: each frame through
the command line, as YAML and JSON.

The cases are those of the specification's valid usage, and of the validation layer's own tests,
positive and negative.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from tests.command import run
from tests.input.captures.program import D32, SAMPLED, SOURCE, TARGET, Program, codes, lint

COPIES, COLOR_MODE, DEPTH_COMMAND, IMAGE = "MSAA319", "MSAA318", "MSAA320", "MSAA106"


def found(tmp_path: Path, text: str, code: str) -> list[int]:
    """The lines of a frame on which a rule fires. The same frame as JSON must have as many findings
    of the rule.
    """
    (tmp_path / "frame.msaa.yaml").write_text(text)
    (tmp_path / "frame.msaa.json").write_text(json.dumps(yaml.safe_load(text)))
    lines = []
    for name in ("frame.msaa.yaml", "frame.msaa.json"):
        report = json.loads(run(tmp_path, "check", "--output", "json", "--no-cache", name).stdout)
        assert not [each for each in report["findings"] if each["code"].startswith("MSAA9")], (
            report["findings"]
        )
        lines.append([each["line"] for each in report["findings"] if each["code"] == code])
    assert len(lines[0]) == len(lines[1])
    return sorted(lines[0])


IMAGES = """\
images:
  one: {format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_SRC, TRANSFER_DST, COLOR_ATTACHMENT]}
  other: {format: R8G8B8A8_UNORM, samples: 1, usage: [TRANSFER_SRC, TRANSFER_DST, COLOR_ATTACHMENT]}
  two: {format: R8G8B8A8_UNORM, samples: 2, usage: [TRANSFER_SRC, TRANSFER_DST, COLOR_ATTACHMENT]}
  four: {format: R8G8B8A8_UNORM, samples: 4, usage: [TRANSFER_SRC, TRANSFER_DST, COLOR_ATTACHMENT]}
  four_too: {format: R8G8B8A8_UNORM, samples: 4, usage: [TRANSFER_SRC, TRANSFER_DST, COLOR_ATTACHMENT]}
  open: {format: R8G8B8A8_UNORM, usage: [TRANSFER_SRC, TRANSFER_DST, COLOR_ATTACHMENT]}
  ids: {format: R32_UINT, samples: 1, usage: [TRANSFER_DST, COLOR_ATTACHMENT]}
  ids_ms: {format: R32_UINT, samples: 4, usage: [TRANSFER_SRC, COLOR_ATTACHMENT]}
  depth: {format: D32_SFLOAT, samples: 1, usage: [TRANSFER_SRC, TRANSFER_DST, DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
  depth_ms: {format: D32_SFLOAT, samples: 4, usage: [TRANSFER_SRC, TRANSFER_DST, DEPTH_STENCIL_ATTACHMENT]}
  ds: {format: D24_UNORM_S8_UINT, samples: 1, usage: [TRANSFER_SRC, TRANSFER_DST, DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
  ds_ms: {format: D24_UNORM_S8_UINT, samples: 4, usage: [TRANSFER_SRC, TRANSFER_DST, DEPTH_STENCIL_ATTACHMENT]}
"""
FEATURE = "enabled: {features: [maintenance10]}\n"
WITHOUT = "enabled: {features: [sampleRateShading]}\n"


def of_command(command: str, enabled: str = "") -> str:
    """A frame of one command, on its last line."""
    return f"{enabled}{IMAGES}commands:\n  - {command}\n"


def color(source: str, mode: str, target: str, flags: str = "[]") -> str:
    attachment = (
        f"{{image: {source}, loadOp: CLEAR, storeOp: STORE, resolveMode: {mode}, "
        f"resolveImage: {target}}}"
    )
    return f"beginRendering: {{flags: {flags}, colorAttachments: [{attachment}]}}"


@pytest.mark.parametrize(
    "command",
    [
        "copyImage: {srcImage: four, dstImage: one}",
        "copyImage: {srcImage: one, dstImage: four}",
        "copyImage: {srcImage: two, dstImage: four}",
        "copyImage: {srcImage: depth_ms, dstImage: depth}",
        "blitImage: {srcImage: four, dstImage: one}",
        "blitImage: {srcImage: one, dstImage: two}",
        "blitImage: {srcImage: four, dstImage: four_too}",
        "blitImage: {srcImage: four, dstImage: open}",
        "blitImage: {srcImage: open, dstImage: four}",
        "copyImageToBuffer: {srcImage: two}",
        "copyImageToBuffer: {srcImage: ds_ms}",
        "copyBufferToImage: {dstImage: four}",
    ],
)
def test_a_copy_of_samples_that_vulkan_forbids(tmp_path: Path, command: str) -> None:
    text = of_command(command)
    assert found(tmp_path, text, COPIES) == [text.count("\n")]


@pytest.mark.parametrize(
    "command",
    [
        "copyImage: {srcImage: four, dstImage: four_too}",
        "copyImage: {srcImage: one, dstImage: other}",
        "copyImage: {srcImage: four, dstImage: open}",
        "copyImage: {srcImage: open, dstImage: four}",
        "copyImage: {srcImage: four, dstImage: four}",
        "blitImage: {srcImage: one, dstImage: other}",
        "blitImage: {srcImage: one, dstImage: open}",
        "copyImageToBuffer: {srcImage: one}",
        "copyImageToBuffer: {srcImage: open}",
        "copyBufferToImage: {dstImage: depth}",
        "clearColorImage: {image: four}",
        "clearDepthStencilImage: {image: depth_ms}",
        "resolveImage: {srcImage: four, dstImage: one}",
        "copyImage: {srcImage: four}",
        "copyImage: {}",
    ],
)
def test_a_copy_that_is_allowed_or_not_known_to_be_forbidden(tmp_path: Path, command: str) -> None:
    assert found(tmp_path, of_command(command), COPIES) == []


@pytest.mark.parametrize(
    "command",
    [
        *(color("four", mode, "one") for mode in ("SAMPLE_ZERO", "MIN", "MAX")),
        *(color("ids_ms", mode, "ids") for mode in ("AVERAGE", "MIN", "MAX")),
        color("open", "MIN", "one"),
        color("four", "SAMPLE_ZERO", "null").replace(", resolveImage: null", ""),
        *(
            f"resolveImage: {{srcImage: four, dstImage: one, resolveMode: {mode}}}"
            for mode in ("NONE", "SAMPLE_ZERO", "MIN", "CUSTOM_EXT")
        ),
        *(
            f"resolveImage: {{srcImage: ids_ms, dstImage: ids, resolveMode: {mode}}}"
            for mode in ("NONE", "AVERAGE", "MAX")
        ),
    ],
)
def test_a_color_resolve_mode_that_vulkan_forbids(tmp_path: Path, command: str) -> None:
    text = of_command(command, FEATURE)
    assert found(tmp_path, text, COLOR_MODE) == [text.count("\n")]


@pytest.mark.parametrize(
    "command",
    [
        color("four", "AVERAGE", "one"),
        color("four", "NONE", "one"),
        color("four", "CUSTOM_EXT", "one", "[CUSTOM_RESOLVE_EXT]"),
        color("one", "EXTERNAL_FORMAT_DOWNSAMPLE_ANDROID", "other"),
        color("ids_ms", "SAMPLE_ZERO", "ids"),
        color("ids_ms", "NONE", "ids"),
        "beginRendering: {depthAttachment: {image: depth_ms, resolveMode: MAX, resolveImage: "
        "depth, loadOp: CLEAR, storeOp: DONT_CARE}}",
        "resolveImage: {srcImage: four, dstImage: one}",
        "resolveImage: {srcImage: ids_ms, dstImage: ids}",
        "resolveImage: {srcImage: four, dstImage: one, resolveMode: AVERAGE}",
        "resolveImage: {srcImage: ids_ms, dstImage: ids, resolveMode: SAMPLE_ZERO}",
        "resolveImage: {srcImage: depth_ms, dstImage: depth, resolveMode: MIN}",
        "beginRendering: {colorAttachments: [null, {resolveMode: MIN, loadOp: CLEAR, storeOp: "
        "STORE}]}",
    ],
)
def test_a_color_resolve_mode_that_is_allowed(tmp_path: Path, command: str) -> None:
    assert found(tmp_path, of_command(command, FEATURE), COLOR_MODE) == []


DEPTH = "resolveImage: {srcImage: depth_ms, dstImage: depth"
BOTH = "resolveImage: {srcImage: ds_ms, dstImage: ds"


@pytest.mark.parametrize(
    ("command", "enabled", "wrong"),
    [
        (f"{DEPTH}}}", "", True),
        (f"{DEPTH}}}", FEATURE, True),
        (f"{BOTH}}}", WITHOUT, True),
        (f"{DEPTH}, resolveMode: SAMPLE_ZERO}}", WITHOUT, True),
        (
            f"{DEPTH}, resolveMode: SAMPLE_ZERO}}",
            "enabled: {extensions: [VK_KHR_maintenance9]}\n",
            True,
        ),
        (f"{DEPTH}, resolveMode: NONE}}", "", True),
        (f"{BOTH}, resolveMode: NONE, stencilResolveMode: NONE}}", FEATURE, True),
        (f"{DEPTH}, resolveMode: SAMPLE_ZERO}}", FEATURE, False),
        (f"{DEPTH}, resolveMode: SAMPLE_ZERO}}", "", False),
        (
            f"{DEPTH}, resolveMode: SAMPLE_ZERO}}",
            "enabled: {extensions: [VK_KHR_maintenance10]}\n",
            False,
        ),
        (f"{BOTH}, resolveMode: NONE, stencilResolveMode: SAMPLE_ZERO}}", FEATURE, False),
        (f"{BOTH}, resolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}}", FEATURE, False),
        ("resolveImage: {srcImage: four, dstImage: one}", WITHOUT, False),
        (
            "beginRendering: {depthAttachment: {image: depth_ms, resolveMode: SAMPLE_ZERO, "
            "resolveImage: depth}}",
            WITHOUT,
            False,
        ),
    ],
)
def test_depth_that_a_command_resolves(
    tmp_path: Path, command: str, enabled: str, wrong: bool
) -> None:
    text = of_command(command, enabled)
    assert found(tmp_path, text, DEPTH_COMMAND) == ([text.count("\n")] if wrong else [])


@pytest.mark.parametrize("mode", [None, "VK_RESOLVE_MODE_SAMPLE_ZERO_BIT"])
def test_a_capture_says_how_a_command_resolves(mode: str | None) -> None:
    program = Program()
    feature = {
        "sType": "VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_10_FEATURES_KHR",
        "maintenance10": 1,
    }
    program.calls[0][1]["pCreateInfo"]["pNext"] = feature
    depth_ms, depth = (
        program.image(D32, usage=0x20 | SOURCE),
        program.image(D32, samples=1, usage=TARGET | SAMPLED | 0x20),
    )
    view = program.view(depth_ms)
    program.swap()
    for _ in range(3):
        buffer = program.buffer()
        program.rendering(
            buffer, [], depth={"imageView": view, "loadOp": "VK_ATTACHMENT_LOAD_OP_CLEAR"}
        )
        program.end(buffer, rendering=True)
        info: dict[str, object] = {"srcImage": depth_ms, "dstImage": depth, "pRegions": []}
        if mode is not None:
            info["pNext"] = {
                "sType": "VK_STRUCTURE_TYPE_RESOLVE_IMAGE_MODE_INFO_KHR",
                "resolveMode": mode,
            }
        program.call("vkCmdResolveImage2", commandBuffer=buffer, pResolveImageInfo=info)
        program.submit(buffer)
        program.present()
    assert (DEPTH_COMMAND in codes(lint(program.text()))) == (mode is None)


@pytest.mark.parametrize(
    ("image", "command", "wrong"),
    [
        ("samples: 4, presentable: true", "", True),
        ("samples: 4", "  - present: {image: shown}\n", True),
        ("samples: 1, presentable: true", "  - present: {image: shown}\n", False),
        ("samples: 4, presentable: false", "", False),
        ("presentable: true", "  - present: {image: shown}\n", False),
    ],
)
def test_a_presented_image_has_one_sample(
    tmp_path: Path, image: str, command: str, wrong: bool
) -> None:
    stated = "imageType: 2D, mipLevels: 1, tiling: OPTIMAL, usage: [COLOR_ATTACHMENT]"
    text = (
        f"images:\n  shown: {{format: B8G8R8A8_UNORM, {stated}, {image}}}\ncommands:\n  - "
        f"pipelineBarrier: {{}}\n{command}"
    )
    assert found(tmp_path, text, IMAGE) == ([2] if wrong else [])


USAGE, TWICE, SMALL = "MSAA321", "MSAA322", "MSAA323"
MS, ONE = "samples: 4, usage: [COLOR_ATTACHMENT]", "samples: 1, usage: [COLOR_ATTACHMENT]"


def rendered(images: dict[str, str], attachments: str, area: str = "", after: str = "") -> str:
    """A frame with images, each on a line from the second on, and a rendering."""
    lines = "".join(
        f"  {name}: {{format: {'D32_SFLOAT' if 'depth' in name else 'R8G8B8A8_UNORM'}, {it}}}\n"
        for name, it in images.items()
    )
    return (
        f"images:\n{lines}commands:\n  - beginRendering:\n{area}{attachments}  - endRendering\n"
        f"{after}"
    )


def resolved(*pairs: str, member: str = "colorAttachments", mode: str = "AVERAGE") -> str:
    """The attachments of a rendering, `source target` each; without a target, there is no
    resolve.
    """
    items = []
    for source, target in ((*pair.split(), "")[:2] for pair in pairs):
        resolve = f", resolveMode: {mode}, resolveImage: {target}" if target else ""
        items.append(f"{{image: {source}, loadOp: CLEAR, storeOp: STORE{resolve}}}")
    return (
        f"      {member}: "
        f"{items[0] if member != 'colorAttachments' else '[' + ', '.join(items) + ']'}\n"
    )


def legacy(
    images: dict[str, str], subpass: str, framebuffer: str = "", begin: str = "", count: int = 1
) -> str:
    """A frame with images, each on a line from the second on, that are the attachments of a render
    pass with their names.
    """
    lines = "".join(
        f"  {name}: {{format: {'D32_SFLOAT' if 'depth' in name else 'R8G8B8A8_UNORM'}, {it}}}\n"
        for name, it in images.items()
    )
    attachments = "".join(
        f"      {name}: {{loadOp: DONT_CARE, storeOp: STORE}}\n" for name in images
    )
    names = ", ".join(images)
    buffers = "".join(
        f"  f{n}: {{renderPass: p, attachments: [{names}]{framebuffer}}}\n" for n in range(count)
    )
    return (
        f"images:\n{lines}renderPasses:\n  p:\n    attachments:\n{attachments}    subpasses:\n     "
        f" - {subpass}\nframebuffers:\n{buffers}"
        f"commands:\n  - beginRenderPass: {{renderPass: p, framebuffer: f0{begin}}}\n  - "
        "endRenderPass\n"
    )


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        (rendered({"ms": MS, "out": "samples: 1, usage: [SAMPLED]"}, resolved("ms out")), [3]),
        (rendered({"ms": "samples: 4, usage: [SAMPLED]", "out": ONE}, resolved("ms out")), [2]),
        (
            rendered(
                {"ms": MS, "out": "samples: 1, usage: [TRANSFER_DST]"},
                resolved("ms out", mode="NONE"),
            ),
            [],
        ),
        (rendered({"ms": MS, "out": "samples: 1"}, resolved("ms out")), []),
        (rendered({"out": "samples: 1, usage: [SAMPLED]"}, resolved("out")), []),
        (
            rendered(
                {
                    "depth_ms": "samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]",
                    "depth": "samples: 1, usage: [SAMPLED]",
                },
                resolved("depth_ms depth", member="depthAttachment", mode="SAMPLE_ZERO"),
            ),
            [3],
        ),
        (
            rendered(
                {"ms": MS, "out": ONE},
                resolved("ms"),
                after="  - resolveImage: {srcImage: ms, dstImage: out}\n",
            ),
            [2, 3],
        ),
        (rendered({"ms": MS}, resolved("ms"), after="  - clearColorImage: {image: ms}\n"), [2]),
        (
            legacy(
                {"ms": MS, "out": "samples: 1, usage: [SAMPLED]"},
                "{colorAttachments: [ms], resolveAttachments: [out]}",
            ),
            [3],
        ),
        (
            legacy(
                {"ms": MS, "out": "samples: 1, usage: [SAMPLED]"},
                "{colorAttachments: [ms], resolveAttachments: [null]}",
            ),
            [],
        ),
        (
            legacy(
                {"ms": MS, "out": ONE},
                "{colorAttachments: [ms], resolveAttachments: [out]}",
                ", flags: [IMAGELESS]",
            ),
            [],
        ),
        (legacy({"ms": MS}, "{inputAttachments: [ms]}"), [2]),
        (legacy({"depth_ms": MS}, "{depthStencilAttachment: depth_ms}"), [2]),
        (
            legacy(
                {"depth_ms": "samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]", "depth": ONE},
                "{depthStencilAttachment: depth_ms, depthStencilResolve: {attachment: depth, "
                "depthResolveMode: SAMPLE_ZERO}}",
            ),
            [3],
        ),
    ],
)
def test_an_image_without_the_usage_that_is_needed(
    tmp_path: Path, text: str, lines: list[int]
) -> None:
    assert found(tmp_path, text, USAGE) == lines


@pytest.mark.parametrize(
    ("text", "count"),
    [
        (rendered({"a": MS, "b": MS, "out": ONE}, resolved("a out", "b out")), 1),
        (rendered({"a": MS, "b": MS, "c": MS, "out": ONE}, resolved("a out", "b out", "c out")), 2),
        (rendered({"a": MS, "out": ONE}, resolved("a out", "out")), 1),
        (rendered({"a": MS, "b": MS, "out": ONE, "two": ONE}, resolved("a out", "b two")), 0),
        (
            rendered(
                {"a": MS, "b": MS, "out": f"{ONE}, arrayLayers: 2"}, resolved("a out", "b out")
            ),
            0,
        ),
        (
            rendered({"a": MS, "b": MS, "out": f"{ONE}, mipLevels: 2"}, resolved("a out", "b out")),
            0,
        ),
        (
            rendered(
                {"a": MS, "b": MS, "out": f"{ONE}, imageType: 3D"}, resolved("a out", "b out")
            ),
            0,
        ),
        (rendered({"a": MS, "b": MS, "out": ONE}, resolved("a out", "b out", mode="NONE")), 0),
        (
            legacy(
                {"a": MS, "b": MS, "out": ONE},
                "{colorAttachments: [a, b], resolveAttachments: [out, out]}",
            ),
            1,
        ),
        (
            legacy(
                {"a": MS, "b": MS, "out": ONE},
                "{colorAttachments: [a, b], resolveAttachments: [out, null]}",
            ),
            0,
        ),
        (
            legacy(
                {"a": MS, "out": ONE},
                "{colorAttachments: [a], resolveAttachments: [out], inputAttachments: [out]}",
            ),
            1,
        ),
        (
            legacy(
                {"a": MS, "out": ONE},
                "{colorAttachments: [a], resolveAttachments: [out], preserveAttachments: [out]}",
            ),
            1,
        ),
        (
            legacy(
                {"a": MS, "out": ONE},
                "{colorAttachments: [a], resolveAttachments: [out], inputAttachments: [a]}",
            ),
            0,
        ),
        (
            legacy(
                {"a": MS, "b": MS, "out": ONE},
                "{colorAttachments: [a, b], resolveAttachments: [out, 3]}",
            )
            .replace(
                "      out: {",
                "      other: {image: out, loadOp: DONT_CARE, storeOp: STORE}\n      out: {",
            )
            .replace("out: {loadOp", "out: {image: out, loadOp")
            .replace("attachments: [a, b, out]", "attachments: [a, b, out, out]"),
            1,
        ),
    ],
)
def test_a_resolve_target_with_another_use(tmp_path: Path, text: str, count: int) -> None:
    assert len(found(tmp_path, text, TWICE)) == count


def sized(width: int, height: int, image: str) -> str:
    return f"{image}, extent: {{width: {width}, height: {height}}}"


AREA = "      renderArea: {x: 0, y: 0, width: 64, height: 32}\n"
PAIR = "{colorAttachments: [ms], resolveAttachments: [out]}"


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        (
            rendered(
                {"ms": sized(64, 32, MS), "out": sized(64, 16, ONE)}, resolved("ms out"), AREA
            ),
            True,
        ),
        (
            rendered(
                {"ms": sized(64, 32, MS), "out": sized(32, 64, ONE)}, resolved("ms out"), AREA
            ),
            True,
        ),
        (
            rendered(
                {"ms": sized(80, 32, MS), "out": sized(64, 32, ONE)},
                resolved("ms out"),
                AREA.replace("x: 0", "x: 8"),
            ),
            True,
        ),
        (
            rendered(
                {"ms": sized(64, 32, MS), "out": sized(64, 32, ONE)}, resolved("ms out"), AREA
            ),
            False,
        ),
        (
            rendered(
                {"ms": sized(64, 32, MS), "out": sized(128, 64, ONE)}, resolved("ms out"), AREA
            ),
            False,
        ),
        (
            rendered(
                {"ms": sized(128, 32, MS), "out": sized(64, 32, ONE)}, resolved("ms out"), AREA
            ),
            False,
        ),
        (rendered({"ms": sized(64, 32, MS), "out": sized(32, 16, ONE)}, resolved("ms out")), False),
        (
            rendered(
                {"ms": sized(64, 32, MS), "out": sized(32, 16, ONE)},
                resolved("ms out", mode="NONE"),
                AREA,
            ),
            False,
        ),
        (rendered({"ms": MS, "out": ONE}, resolved("ms out"), AREA), False),
        (
            legacy(
                {"ms": sized(64, 32, MS), "out": sized(32, 32, ONE)},
                PAIR,
                ", width: 64, height: 32",
            ),
            True,
        ),
        (
            legacy(
                {"ms": sized(64, 32, MS), "out": sized(32, 32, ONE)},
                PAIR,
                ", width: 64, height: 32",
                count=2,
            ),
            True,
        ),
        (
            legacy(
                {"ms": sized(64, 32, MS), "out": sized(32, 32, ONE)},
                PAIR,
                "",
                ", renderArea: {width: 64, height: 32}",
            ),
            True,
        ),
        (
            legacy(
                {"ms": sized(64, 32, MS), "out": sized(32, 32, ONE)},
                PAIR,
                ", width: 32, height: 32",
            ),
            False,
        ),
        (
            legacy(
                {"ms": sized(64, 32, MS), "out": sized(64, 32, ONE)},
                PAIR,
                ", width: 64, height: 32",
            ),
            False,
        ),
        (legacy({"ms": sized(64, 32, MS), "out": sized(32, 32, ONE)}, PAIR), False),
    ],
)
def test_a_resolve_target_that_is_too_small(tmp_path: Path, text: str, wrong: bool) -> None:
    assert len(found(tmp_path, text, SMALL)) == wrong
