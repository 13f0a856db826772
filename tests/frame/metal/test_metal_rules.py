"""What the catalogue says of frames in Metal's words, all rules together: one cause is one finding,
sound frames have none.
"""

from __future__ import annotations

import re

import pytest

from msaa_lint.linter.rules.registry import load
from tests.linter.fixes.linting import fix_findings, lint

RULES = {rule.name: rule for rule in load().rules}

TEXTURES = """
    colorMS: {pixelFormat: bgra8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: COLOR}
    depthMS: {pixelFormat: depth32Float, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless}
    color: {pixelFormat: bgra8Unorm, textureType: type2D, sampleCount: 1, usage: [renderTarget, shaderRead], storageMode: private}
    drawable: {pixelFormat: bgra8Unorm, drawable: true}
"""


def frame(
    color: str,
    *,
    storage: str = "memoryless",
    depth: str = "loadAction: clear, storeAction: dontCare",
    commands: str = "",
) -> str:
    """A pass that draws to `colorMS` and `depthMS`; the rest of the colour attachment, of the depth
    attachment, and of the commands.
    """
    return f"""metal:
  family: apple7
  textures:{TEXTURES.rstrip().replace("COLOR", storage)}
  renderPasses:
    forward:
      colorAttachments:
        - {{texture: colorMS, {color}}}
      depthAttachment: {{texture: depthMS, {depth}}}
  commands:
    - renderPass: forward
{commands or "    - present: drawable"}
"""


def found(text: str) -> list[tuple[str, str, str]]:
    """Rule, severity, and the text that it points at."""
    linted = lint(text)
    assert linted.source is not None
    assert not [each for each in linted.findings if each.fatal]
    whole = linted.source.text
    return sorted(
        (each.rule, each.severity, whole[each.span.start : each.span.end])
        for each in linted.findings
        if each.span
    )


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            frame(
                "resolveTexture: drawable, loadAction: clear, storeAction: "
                "storeAndMultisampleResolve",
                storage="private",
            ),
            [
                ("metal-memoryless-possible", "warning", "private"),
                ("metal-samples-stored-unread", "warning", "storeAndMultisampleResolve"),
            ],
        ),
        (
            frame(
                "resolveTexture: drawable, loadAction: clear, storeAction: "
                "storeAndMultisampleResolve"
            ),
            [("metal-memoryless-needs-memory", "error", "storeAndMultisampleResolve")],
        ),
        (
            # Memoryless, not resolved, and stored: one word is wrong.
            frame("resolveTexture: drawable, loadAction: clear, storeAction: store"),
            [("metal-memoryless-needs-memory", "error", "store")],
        ),
        (
            frame(
                "resolveTexture: drawable, loadAction: clear, storeAction: store", storage="private"
            ),
            [
                ("metal-memoryless-possible", "warning", "private"),
                ("metal-resolve-texture-unused", "warning", "store"),
            ],
        ),
        (
            frame("resolveTexture: drawable, loadAction: clear, storeAction: dontCare"),
            [("metal-resolve-texture-unused", "warning", "dontCare")],
        ),
        (
            frame("loadAction: clear, storeAction: multisampleResolve"),
            [("metal-resolve-texture-missing", "error", "multisampleResolve")],
        ),
        (
            frame("loadAction: clear, storeAction: storeAndMultisampleResolve", storage="shared"),
            [
                ("metal-memoryless-possible", "warning", "shared"),
                ("metal-resolve-texture-missing", "error", "storeAndMultisampleResolve"),
            ],
        ),
        (
            # What it loads it threw away: the undefined contents are worse than their price.
            frame(
                "resolveTexture: drawable, loadAction: load, storeAction: multisampleResolve",
                storage="private",
            ),
            [("discarded-then-loaded", "warning", "load")],
        ),
        (
            frame("resolveTexture: drawable, loadAction: load, storeAction: multisampleResolve"),
            [("metal-memoryless-needs-memory", "error", "load")],
        ),
        (
            frame(
                "resolveTexture: color, loadAction: clear, storeAction: multisampleResolve",
                commands="    - copy: {source: color, destination: drawable}\n    - present: "
                "drawable",
            ),
            [("metal-resolve-then-blit", "warning", "color")],
        ),
        (
            # No finding of four samples being enough; that they do not fit on the tile is another
            # matter.
            frame(
                "resolveTexture: drawable, loadAction: clear, storeAction: multisampleResolve"
            ).replace("Count: 4", "Count: 16"),
            [
                *[("metal-sample-count-unsupported", "error", "16")] * 2,
                ("tile-budget-exceeded", "warning", "colorAttachments"),
            ],
        ),
        (
            # Colour of one sample: its own type, and what stands beside it.
            frame(
                "loadAction: clear, storeAction: store",
                commands="    - readTexture: {texture: colorMS, stage: fragment}",
            ).replace(
                "type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless",
                "type2D, sampleCount: 1",
                1,
            ),
            [("mixed-sample-counts", "error", "depthMS")],
        ),
    ],
)
def test_one_cause_is_one_finding(text: str, expected: list[tuple[str, str, str]]) -> None:
    assert found(text) == expected


@pytest.mark.parametrize(
    "text",
    [
        frame("resolveTexture: drawable, loadAction: clear, storeAction: multisampleResolve"),
        frame("resolveTexture: drawable, loadAction: dontCare, storeAction: unknown"),
        # Samples that a tile function resolves: nothing is stored, and nothing is lost.
        frame(
            "loadAction: clear, storeAction: dontCare",
            commands="    - writeTexture: {texture: color, stage: tile}",
        ),
        # A resolve of the application's own.
        frame(
            "loadAction: clear, storeAction: store",
            storage="private",
            commands="    - readTexture: {texture: colorMS, stage: compute, samples: ALL, "
            "resolves: OTHER}",
        ),
        # A picture that later frames read.
        frame(
            "resolveTexture: color, loadAction: clear, storeAction: multisampleResolve",
            commands="    - readTexture: {texture: color}",
        ),
        # A blit of what something is drawn on between.
        frame(
            "resolveTexture: color, loadAction: clear, storeAction: multisampleResolve",
            commands="    - writeTexture: {texture: color, stage: compute}\n    - copy: {source: "
            "color, destination: drawable}",
        ),
    ],
)
def test_sound_frames_have_no_finding(text: str) -> None:
    assert found(text) == []


def test_a_deferred_frame_on_the_tile_has_no_finding() -> None:
    """Attachments that fragment functions read on the tile are neither stored nor resolved, and not
    lost for that.
    """
    text = """metal:
  family: apple7
  textures:
    albedo: {pixelFormat: rgba8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless}
    litMS: {pixelFormat: bgra8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless}
    shadow: {pixelFormat: depth32Float, textureType: type2D, sampleCount: 1, usage: [renderTarget, shaderRead], storageMode: private}
    drawable: {pixelFormat: bgra8Unorm, drawable: true}
  renderPasses:
    shadows:
      depthAttachment: {texture: shadow, loadAction: clear, storeAction: store}
    deferred:
      colorAttachments:
        - {texture: litMS, resolveTexture: drawable, loadAction: dontCare, storeAction: multisampleResolve}
        - {texture: albedo, loadAction: dontCare, storeAction: dontCare}
  commands:
    - renderPass: shadows
    - readTexture: {texture: shadow, stage: fragment}
    - renderPass: deferred
    - present: drawable
"""
    assert found(text) == []


@pytest.mark.parametrize("storage", ["memoryless", "private"])
@pytest.mark.parametrize("action", ["store", "storeAndMultisampleResolve", "dontCare"])
def test_fixes_of_a_pass_leave_nothing_to_find(storage: str, action: str) -> None:
    """Rules about one attachment do not undo each other's fixes."""
    text = frame(
        f"resolveTexture: drawable, loadAction: clear, storeAction: {action}", storage=storage
    )
    done = fix_findings(text, True)
    assert done.result.findings == []
    assert re.search(
        r"storeAction: multisampleResolve}.*storeAction: dontCare}", done.text, re.DOTALL
    )


def test_a_rule_is_asked_of_the_frames_that_its_page_names() -> None:
    metal = lint(
        frame(
            "resolveTexture: drawable, loadAction: clear, storeAction: storeAndMultisampleResolve",
            storage="private",
        )
    )
    vulkan = lint("""
images: {color_ms: {format: R8G8B8A8_UNORM, samples: 16}, color: {format: R8G8B8A8_UNORM, samples: 1}}
commands:
  - beginRendering: {colorAttachments: [{image: color_ms, loadOp: LOAD, storeOp: STORE, resolveMode: AVERAGE, resolveImage: color}]}
  - endRendering
""")
    for linted, api in ((metal, "metal"), (vulkan, "vulkan")):
        asked = {each.rule for each in linted.findings} | {each.rule for each in linted.undecided}
        assert asked
        assert {api} <= set.intersection(*(set(RULES[name].apis) for name in asked))


PLACEHOLDER = re.compile(r"\{[a-z_.]+\}")
VULKAN = re.compile(
    r"\b(storeOp|loadOp|stencil\w+Op|VK_\w+|vkCmd\w+|TRANSIENT_ATTACHMENT|subpass|DONT_CARE|alphaTo\w+)\b"
)


def test_what_is_said_of_metal_is_in_its_words() -> None:
    """The rules that are Metal's alone name nothing of Vulkan's, and the others say so in a case of
    their own where they would.
    """
    for rule in RULES.values():
        if "metal" not in rule.apis:
            continue
        cases = (
            [case for case in rule.cases if "METAL" in case.when]
            if "vulkan" in rule.apis
            else rule.cases
        )
        whole = next((case for case in cases if case.when == 'frame.api == "METAL"'), None)
        texts = [case.message or rule.message for case in cases] + [
            case.help or rule.help for case in cases
        ]
        texts += [case.fix.title for case in cases if case.fix is not None]
        if whole is None:
            texts += [rule.message, rule.help]
        assert not [text for text in texts if VULKAN.search(PLACEHOLDER.sub("", text))], rule.name
