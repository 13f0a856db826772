"""Who waits for a resolve, frame by frame, and the sentence of the Vulkan specification that
decides it.

Sections are of the chapter Synchronization and Cache Control, unless another one is named.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from tests.command import run

CODE = "MSAA601"

IMAGES = """
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4}
  color: {format: R8G8B8A8_UNORM, samples: 1}
  depth_ms: {format: D32_SFLOAT, samples: 4}
  depth: {format: D32_SFLOAT, samples: 1}
  other: {format: R8G8B8A8_UNORM, samples: 1}
"""
DRAWN = {
    "color": """
  - beginRendering:
      colorAttachments: [{image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: AVERAGE, resolveImage: color}]
  - endRendering""",
    "depth": """
  - beginRendering:
      depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveMode: SAMPLE_ZERO, resolveImage: depth}
  - endRendering""",
    "stored": """
  - beginRendering: {colorAttachments: [{image: color_ms, loadOp: CLEAR, storeOp: STORE}]}
  - endRendering""",
}
RESOLVE = "\n  - resolveImage: {srcImage: color_ms, dstImage: color}"
OUT, WRITE = "COLOR_ATTACHMENT_OUTPUT", "COLOR_ATTACHMENT_WRITE"


def wait(source: str, written: str, target: str, read: str, images: str = "") -> str:
    masks = (
        f"srcStageMask: [{source}], srcAccessMask: [{written}], dstStageMask: [{target}], "
        f"dstAccessMask: [{read}]"
    )
    return f"\n  - pipelineBarrier: {{{masks}{f', images: [{images}]' if images else ''}}}"


def to_shader(source: str = OUT, written: str = WRITE, images: str = "color") -> str:
    return wait(source, written, "FRAGMENT_SHADER", "SHADER_READ", images)


def layout(image: str) -> str:
    return (
        f"{{image: {image}, oldLayout: COLOR_ATTACHMENT_OPTIMAL, newLayout: "
        f"SHADER_READ_ONLY_OPTIMAL}}"
    )


def sampled(image: str = "color", stage: str = "FRAGMENT", access: str = "") -> str:
    return (
        f"\n  - readImage: {{image: {image}, stage: "
        f"{stage}{f', access: {access}' if access else ''}}}"
    )


def loaded(image: str = "color") -> str:
    return (
        f"\n  - beginRendering: {{colorAttachments: [{{image: {image}, loadOp: LOAD, storeOp: "
        f"STORE}}]}}\n  - endRendering"
    )


def commands(*each: str) -> str:
    return f"{IMAGES}commands:{''.join(each)}\n"


COLOR, DEPTH, STORED = DRAWN["color"], DRAWN["depth"], DRAWN["stored"]

BARRIERS = [
    # The source masks: Access Types, "only includes accesses via the access types specified in that
    # mask".
    ("stage and write", commands(COLOR, to_shader(), sampled()), ""),
    ("with a layout", commands(COLOR, to_shader(images=layout("color")), sampled()), ""),
    ("no access", commands(COLOR, to_shader(written=""), sampled()), "medium"),
    ("NONE as access", commands(COLOR, to_shader(written="NONE"), sampled()), "medium"),
    (
        "no access, with a layout",
        commands(COLOR, to_shader(written="", images=layout("color")), sampled()),
        "medium",
    ),
    (
        "a read for a write",
        commands(COLOR, to_shader(written="COLOR_ATTACHMENT_READ"), sampled()),
        "medium",
    ),
    (
        "any read for a write",
        commands(COLOR, to_shader(written="MEMORY_READ"), sampled()),
        "medium",
    ),
    (
        "another write",
        commands(COLOR, to_shader("ALL_COMMANDS", "TRANSFER_WRITE"), sampled()),
        "medium",
    ),
    ("any write", commands(COLOR, to_shader(written="MEMORY_WRITE"), sampled()), ""),
    ("all graphics", commands(COLOR, to_shader("ALL_GRAPHICS"), sampled()), ""),
    (
        "all commands, any write",
        commands(COLOR, to_shader("ALL_COMMANDS", "MEMORY_WRITE"), sampled()),
        "",
    ),
    (
        "all commands, no access",
        commands(COLOR, to_shader("ALL_COMMANDS", ""), sampled()),
        "medium",
    ),
    # VkPipelineStageFlagBits: "BOTTOM_OF_PIPE is equivalent to ALL_COMMANDS with VkAccessFlags set
    # to 0 in the first scope".
    ("bottom of pipe", commands(COLOR, to_shader("BOTTOM_OF_PIPE", ""), sampled()), "medium"),
    (
        "bottom of pipe with an access",
        commands(COLOR, to_shader("BOTTOM_OF_PIPE", "MEMORY_WRITE"), sampled()),
        "medium",
    ),
    (
        "bottom of pipe beside the stage",
        commands(COLOR, to_shader(f"BOTTOM_OF_PIPE, {OUT}"), sampled()),
        "",
    ),
    # "TOP_OF_PIPE ... specifies no stage of execution when specified in the first scope".
    ("top of pipe", commands(COLOR, to_shader("TOP_OF_PIPE", ""), sampled()), "medium"),
    ("no stage", commands(COLOR, to_shader("NONE", ""), sampled()), "medium"),
    # Render Pass Multisample Resolve Operations: "whether the attachments are color or
    # depth/stencil attachments".
    ("depth as color", commands(DEPTH, to_shader(images="depth"), sampled("depth")), ""),
    (
        "depth as depth",
        commands(
            DEPTH,
            to_shader("LATE_FRAGMENT_TESTS", "DEPTH_STENCIL_ATTACHMENT_WRITE", "depth"),
            sampled("depth"),
        ),
        "medium",
    ),
    (
        "depth, the stage alone",
        commands(
            DEPTH,
            to_shader(f"{OUT}, LATE_FRAGMENT_TESTS", "DEPTH_STENCIL_ATTACHMENT_WRITE", "depth"),
            sampled("depth"),
        ),
        "medium",
    ),
    (
        "depth, all graphics, its own access",
        commands(
            DEPTH,
            to_shader("ALL_GRAPHICS", "DEPTH_STENCIL_ATTACHMENT_WRITE", "depth"),
            sampled("depth"),
        ),
        "medium",
    ),
    (
        "depth, any write of the tests",
        commands(
            DEPTH, to_shader("LATE_FRAGMENT_TESTS", "MEMORY_WRITE", "depth"), sampled("depth")
        ),
        "medium",
    ),
    # The destination masks: Pipeline Stages, "only the stages the application specifies are
    # considered part of each access scope".
    (
        "another shader",
        commands(COLOR, wait(OUT, WRITE, "VERTEX_SHADER", "SHADER_READ", "color"), sampled()),
        "medium",
    ),
    (
        "compute for fragment",
        commands(COLOR, wait(OUT, WRITE, "COMPUTE_SHADER", "SHADER_READ", "color"), sampled()),
        "medium",
    ),
    (
        "all graphics before a fragment shader",
        commands(COLOR, wait(OUT, WRITE, "ALL_GRAPHICS", "SHADER_READ", "color"), sampled()),
        "",
    ),
    (
        "all commands before compute",
        commands(
            COLOR,
            wait(OUT, WRITE, "ALL_COMMANDS", "MEMORY_READ", "color"),
            sampled(stage="COMPUTE"),
        ),
        "",
    ),
    (
        "top of pipe as destination",
        commands(COLOR, wait(OUT, WRITE, "TOP_OF_PIPE", "", "color"), sampled()),
        "medium",
    ),
    (
        "nothing made visible",
        commands(COLOR, wait(OUT, WRITE, "FRAGMENT_SHADER", "", "color"), sampled()),
        "medium",
    ),
    (
        "input attachments for a sampled image",
        commands(
            COLOR,
            wait(OUT, WRITE, "FRAGMENT_SHADER", "INPUT_ATTACHMENT_READ", "color"),
            sampled(access="SHADER_SAMPLED_READ"),
        ),
        "medium",
    ),
    (
        "sampled for sampled",
        commands(
            COLOR,
            wait(OUT, WRITE, "FRAGMENT_SHADER", "SHADER_SAMPLED_READ", "color"),
            sampled(access="SHADER_SAMPLED_READ"),
        ),
        "",
    ),
    (
        "storage for sampled",
        commands(
            COLOR,
            wait(OUT, WRITE, "FRAGMENT_SHADER", "SHADER_STORAGE_READ", "color"),
            sampled(access="SHADER_SAMPLED_READ"),
        ),
        "medium",
    ),
    (
        "shader read for storage",
        commands(
            COLOR,
            wait(OUT, WRITE, "COMPUTE_SHADER", "SHADER_READ", "color"),
            sampled(stage="COMPUTE", access="SHADER_STORAGE_READ"),
        ),
        "",
    ),
    (
        "a write for a read",
        commands(COLOR, wait(OUT, WRITE, "FRAGMENT_SHADER", "SHADER_WRITE", "color"), sampled()),
        "medium",
    ),
    # Loads: Render Pass Load Operations, "COLOR_ATTACHMENT_OUTPUT"; LOAD_OP_LOAD uses
    # COLOR_ATTACHMENT_READ.
    (
        "a load",
        commands(
            COLOR, wait(OUT, WRITE, OUT, f"COLOR_ATTACHMENT_READ, {WRITE}", "color"), loaded()
        ),
        "",
    ),
    (
        "a load, written alone",
        commands(COLOR, wait(OUT, WRITE, OUT, WRITE, "color"), loaded()),
        "medium",
    ),
    (
        "a copy",
        commands(
            COLOR,
            wait(OUT, WRITE, "COPY", "TRANSFER_READ", "color"),
            "\n  - copyImage: {srcImage: color, dstImage: other}",
        ),
        "",
    ),
    (
        "a blit as a copy",
        commands(
            COLOR,
            wait(OUT, WRITE, "COPY", "TRANSFER_READ", "color"),
            "\n  - blitImage: {srcImage: color, dstImage: other}",
        ),
        "medium",
    ),
    (
        "all transfers",
        commands(
            COLOR,
            wait(OUT, WRITE, "ALL_TRANSFER", "TRANSFER_READ", "color"),
            "\n  - blitImage: {srcImage: color, dstImage: other}",
        ),
        "",
    ),
    (
        "a copy without its access",
        commands(
            COLOR,
            wait(OUT, WRITE, "TRANSFER", "SHADER_READ", "color"),
            "\n  - copyImageToBuffer: {srcImage: color}",
        ),
        "medium",
    ),
    # Chains: Execution and Memory Dependencies, "the first access scope of the first command in the
    # Sync chain".
    (
        "a chain",
        commands(
            COLOR,
            wait(OUT, WRITE, "TRANSFER", ""),
            wait("TRANSFER", "", "FRAGMENT_SHADER", "SHADER_READ"),
            sampled(),
        ),
        "",
    ),
    (
        "a chain with a gap",
        commands(
            COLOR,
            wait(OUT, WRITE, "TRANSFER", "", "color"),
            wait("COMPUTE_SHADER", "", "FRAGMENT_SHADER", "SHADER_READ"),
            sampled(),
        ),
        "medium",
    ),
    (
        "a chain that forgets the write",
        commands(
            COLOR,
            wait(OUT, "", "TRANSFER", "", "color"),
            wait("TRANSFER", WRITE, "FRAGMENT_SHADER", "SHADER_READ", "color"),
            sampled(),
        ),
        "medium",
    ),
    (
        "a chain over bottom of pipe",
        commands(
            COLOR,
            wait(OUT, WRITE, "BOTTOM_OF_PIPE", "", "color"),
            wait("TOP_OF_PIPE", "", "FRAGMENT_SHADER", "SHADER_READ", "color"),
            sampled(),
        ),
        "medium",
    ),
    (
        "a chain over all commands",
        commands(
            COLOR,
            wait(OUT, WRITE, "ALL_COMMANDS", "", "color"),
            wait("ALL_COMMANDS", "", "FRAGMENT_SHADER", "SHADER_READ", "color"),
            sampled(),
        ),
        "",
    ),
    (
        "a chain by logically later stages",
        commands(
            COLOR,
            wait(OUT, WRITE, "VERTEX_SHADER", "", "color"),
            wait("FRAGMENT_SHADER", "", "COMPUTE_SHADER", "SHADER_READ", "color"),
            sampled(stage="COMPUTE"),
        ),
        "",
    ),
    (
        "two halves",
        commands(
            COLOR, to_shader("LATE_FRAGMENT_TESTS"), to_shader(written="SHADER_WRITE"), sampled()
        ),
        "medium",
    ),
    # A memory barrier for other images includes every command in its synchronization scopes, and no
    # access to this one.
    ("another image", commands(COLOR, to_shader(images="other"), sampled()), "medium"),
    (
        "another image first",
        commands(
            COLOR,
            wait(OUT, WRITE, "TRANSFER", "", "other"),
            wait(f"TRANSFER, {OUT}", WRITE, "FRAGMENT_SHADER", "SHADER_READ", "color"),
            sampled(),
        ),
        "",
    ),
    # Resolve commands: VkPipelineStageFlagBits2, "RESOLVE specifies the execution of
    # vkCmdResolveImage".
    (
        "a command",
        commands(
            STORED,
            wait(OUT, WRITE, "RESOLVE", "TRANSFER_READ", "color_ms"),
            RESOLVE,
            to_shader("RESOLVE", "TRANSFER_WRITE"),
            sampled(),
        ),
        "",
    ),
    (
        "a command as an attachment",
        commands(
            STORED,
            wait(OUT, WRITE, "RESOLVE", "TRANSFER_READ", "color_ms"),
            RESOLVE,
            to_shader(),
            sampled(),
        ),
        "medium",
    ),
    (
        "a command, its stage alone",
        commands(
            STORED,
            wait(OUT, WRITE, "RESOLVE", "TRANSFER_READ", "color_ms"),
            RESOLVE,
            to_shader("TRANSFER", ""),
            sampled(),
        ),
        "medium",
    ),
    (
        "a command as a copy",
        commands(
            STORED,
            wait(OUT, WRITE, "RESOLVE", "TRANSFER_READ", "color_ms"),
            RESOLVE,
            to_shader("COPY", "TRANSFER_WRITE"),
            sampled(),
        ),
        "medium",
    ),
    (
        "a command before its samples",
        commands(
            STORED,
            wait(OUT, "", "TRANSFER", "TRANSFER_READ", "color_ms"),
            RESOLVE,
            to_shader("TRANSFER", "TRANSFER_WRITE"),
            sampled(),
        ),
        "medium",
    ),
    (
        "a command that blits its samples",
        commands(
            STORED,
            wait(OUT, WRITE, "BLIT", "TRANSFER_READ", "color_ms"),
            RESOLVE,
            to_shader("TRANSFER", "TRANSFER_WRITE"),
            sampled(),
        ),
        "medium",
    ),
    # What is stated: a frame without barriers leaves them out; one with barriers has them all.
    ("nothing stated", commands(COLOR, sampled()), ""),
    (
        "barriers for something else",
        commands(
            wait("TRANSFER", "TRANSFER_WRITE", "FRAGMENT_SHADER", "SHADER_READ", "other"),
            COLOR,
            sampled(),
        ),
        "medium",
    ),
    (
        "accesses left out",
        commands(
            COLOR,
            f"\n  - pipelineBarrier: {{srcStageMask: [{OUT}], dstStageMask: [FRAGMENT_SHADER], "
            f"images: [color]}}",
            sampled(),
        ),
        "",
    ),
    (
        "stages left out",
        commands(
            COLOR,
            "\n  - pipelineBarrier: {dstStageMask: [FRAGMENT_SHADER], images: [color]}",
            sampled(),
        ),
        "",
    ),
    (
        "a presentation",
        commands(
            COLOR, wait(OUT, WRITE, "BOTTOM_OF_PIPE", "", "color"), "\n  - present: {image: color}"
        ),
        "",
    ),
    ("nothing reads", commands(COLOR, to_shader(written="")), ""),
    # The next frame may be ordered by a fence.
    ("the next frame", commands(to_shader(written=""), sampled(), COLOR), "low"),
    ("the next frame, in order", commands(to_shader(), sampled(), COLOR), ""),
]


def dependency(source: str, target: str, masks: tuple[str, str, str, str]) -> str:
    names = ("srcStageMask", "srcAccessMask", "dstStageMask", "dstAccessMask")
    stated = ", ".join(f"{name}: [{mask}]" for name, mask in zip(names, masks, strict=True))
    return f"{{srcSubpass: {source}, dstSubpass: {target}, {stated}}}"


def passes(
    first: str = "", second: str = "", stated: str = "", between: str = "", read: str = sampled()
) -> str:
    """A pass that resolves color, and one that reads it; the dependencies of both, and what is
    recorded between them.
    """
    return f"""{IMAGES}renderPasses:
  first:
    attachments:
      color_ms: {{image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE}}
      color: {{image: color, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{{colorAttachments: [color_ms], resolveAttachments: [color]}}]
    dependencies: [{first}]
  second:
    attachments:
      other: {{image: other, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{{colorAttachments: [other]}}]
    dependencies: [{second}]
commands:{stated}
  - beginRenderPass: {{renderPass: first}}
  - endRenderPass{between}
  - beginRenderPass: {{renderPass: second}}{read}
  - endRenderPass
"""


def subpasses(*dependencies: str, third: str = "") -> str:
    """A pass whose second, or third, subpass reads what the first one resolves."""
    reader = "{inputAttachments: [color], colorAttachments: [other]}"
    listed = [
        "{colorAttachments: [color_ms], resolveAttachments: [color]}",
        *([third] if third else []),
        reader,
    ]
    return f"""{IMAGES}renderPasses:
  main:
    attachments:
      color_ms: {{image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE}}
      color: {{image: color, loadOp: DONT_CARE, storeOp: DONT_CARE}}
      other: {{image: other, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{", ".join(listed)}]
    dependencies: [{", ".join(dependencies)}]
"""


SHADER = (OUT, WRITE, "FRAGMENT_SHADER", "SHADER_READ")
INPUT = (OUT, WRITE, "FRAGMENT_SHADER", "INPUT_ATTACHMENT_READ")
OUTPUT = (OUT, WRITE, OUT, WRITE)
PRESERVES = "{colorAttachments: [other], preserveAttachments: [color]}"

DEPENDENCIES = [
    ("out of the pass", passes(dependency("0", "EXTERNAL", SHADER)), ""),
    (
        "out of the pass, no access",
        passes(dependency("0", "EXTERNAL", (OUT, "", "FRAGMENT_SHADER", "SHADER_READ"))),
        "medium",
    ),
    (
        "out of the pass, a read",
        passes(
            dependency(
                "0", "EXTERNAL", (OUT, "COLOR_ATTACHMENT_READ", "FRAGMENT_SHADER", "SHADER_READ")
            )
        ),
        "medium",
    ),
    (
        "out of the pass, nothing visible",
        passes(dependency("0", "EXTERNAL", (OUT, WRITE, "FRAGMENT_SHADER", ""))),
        "medium",
    ),
    ("into the pass", passes("", dependency("EXTERNAL", "0", SHADER)), ""),
    (
        "into the pass, no access",
        passes("", dependency("EXTERNAL", "0", (OUT, "", "FRAGMENT_SHADER", "SHADER_READ"))),
        "medium",
    ),
    (
        "into the pass, bottom of pipe",
        passes(
            "",
            dependency(
                "EXTERNAL", "0", ("BOTTOM_OF_PIPE", "MEMORY_READ", "FRAGMENT_SHADER", "SHADER_READ")
            ),
        ),
        "medium",
    ),
    # For the attachments of the second pass: it holds back no shader, and no barrier is recorded.
    ("into the pass, for its attachments", passes("", dependency("EXTERNAL", "0", OUTPUT)), ""),
    # Render Pass Creation: the implicit dependencies are from NONE, and to NONE, so nothing chains
    # with them.
    (
        "implicit ones beside barriers",
        passes(
            stated=wait("TRANSFER", "TRANSFER_WRITE", "FRAGMENT_SHADER", "SHADER_READ", "other")
        ),
        "medium",
    ),
    (
        "one after the other",
        passes(
            dependency("0", "EXTERNAL", (OUT, WRITE, "ALL_COMMANDS", "")),
            dependency("EXTERNAL", "0", ("ALL_COMMANDS", "", "FRAGMENT_SHADER", "SHADER_READ")),
        ),
        "",
    ),
    (
        "a barrier after the dependency",
        passes(
            dependency("0", "EXTERNAL", OUTPUT),
            between=wait(OUT, "", "FRAGMENT_SHADER", "SHADER_READ", "color"),
        ),
        "",
    ),
    (
        "a barrier after no dependency",
        passes(between=wait(OUT, "", "FRAGMENT_SHADER", "SHADER_READ", "color")),
        "medium",
    ),
    ("between subpasses", subpasses(dependency("0", "1", INPUT)), ""),
    ("between subpasses, as a texture", subpasses(dependency("0", "1", SHADER)), "high"),
    (
        "between subpasses, no access",
        subpasses(dependency("0", "1", (OUT, "", "FRAGMENT_SHADER", "INPUT_ATTACHMENT_READ"))),
        "high",
    ),
    (
        "between subpasses, as depth",
        subpasses(
            dependency(
                "0", "1", ("LATE_FRAGMENT_TESTS", "MEMORY_WRITE", "FRAGMENT_SHADER", "MEMORY_READ")
            )
        ),
        "high",
    ),
    ("none between subpasses", subpasses(dependency("1", "EXTERNAL", SHADER)), "high"),
    (
        "through a third subpass",
        subpasses(
            dependency("0", "1", (OUT, WRITE, "FRAGMENT_SHADER", "")),
            dependency(
                "1", "2", ("FRAGMENT_SHADER", "", "FRAGMENT_SHADER", "INPUT_ATTACHMENT_READ")
            ),
            third=PRESERVES,
        ),
        "",
    ),
    (
        "not through a third subpass",
        subpasses(
            dependency("0", "1", INPUT),
            dependency(
                "1", "2", ("EARLY_FRAGMENT_TESTS", "", "FRAGMENT_SHADER", "INPUT_ATTACHMENT_READ")
            ),
            third=PRESERVES,
        ),
        "high",
    ),
    (
        "past a third subpass",
        subpasses(dependency("0", "1", OUTPUT), dependency("0", "2", INPUT), third=PRESERVES),
        "",
    ),
]

FRAMES = [*BARRIERS, *DEPENDENCIES]


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[str]]:
    """The confidences of the findings by frame, as YAML and as JSON."""
    folder: Path = tmp_path_factory.mktemp("frames")
    for number, (_, text, _) in enumerate(FRAMES):
        (folder / f"{number}.msaa.yaml").write_text(text)
        (folder / f"{number}.msaa.json").write_text(json.dumps(yaml.safe_load(text)))
    done = run(folder, "check", "--output", "json", ".")
    by_file: dict[str, list[str]] = {}
    for finding in json.loads(done.stdout)["findings"]:
        assert not finding["code"].startswith("MSAA9"), finding
        if finding["code"] == CODE:
            by_file.setdefault(finding["file"], []).append(finding["confidence"])
    return by_file


@pytest.mark.parametrize(
    ("number", "name", "confidence"),
    [(n, name, confidence) for n, (name, _, confidence) in enumerate(FRAMES)],
)
def test_a_frame(found: dict[str, list[str]], number: int, name: str, confidence: str) -> None:
    for kind in ("yaml", "json"):
        assert found.get(f"{number}.msaa.{kind}", []) == ([confidence] if confidence else []), (
            name,
            kind,
        )


def test_a_wait_that_is_stated_is_fixed_and_nothing_else_is(tmp_path: Path) -> None:
    """One pass of fixes leaves the findings that no stated wait can answer, and every fixed wait is
    enough.
    """
    for number, (_, text, _) in enumerate(FRAMES):
        (tmp_path / f"{number}.msaa.yaml").write_text(text)
    run(tmp_path, "check", "--fix", "--select", CODE, ".")
    left = json.loads(run(tmp_path, "check", "--output", "json", "--select", CODE, ".").stdout)[
        "findings"
    ]
    assert [
        each["message"] for each in left if " without a " not in each["message"] or each["fixable"]
    ] == []
    assert {FRAMES[int(finding["file"].split(".")[0])][0] for finding in left} == {
        "another image", "barriers for something else", "implicit ones beside barriers",
        "none between subpasses",
        "not through a third subpass",
    }  # fmt: skip
