"""The Khronos validation layer's best-practices checks across passes, by their ids: those that
follow images from command to command.

Where its trigger holds ours fires too; where it takes aspects together, misses DONT_CARE or passes
over dynamic rendering, ours is right.
"""

from __future__ import annotations

import pytest

from msaa_lint.core.finding import Finding
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.registry import load
from msaa_lint.linter.rules.rule import Rule

ENGINE = Engine(load())


def as_written(rule: Rule, suggested: str, vendor: str | None) -> str:
    return suggested


def findings(text: str) -> list[Finding]:
    linted = ENGINE.lint(text.encode(), "frame.yaml", LintOptions(as_written))
    assert not [found.message for found in linted.findings if found.fatal]
    return linted.findings


def rules(text: str) -> set[str]:
    return {found.rule for found in findings(text)}


IMAGES = """
images:
  color: {format: R8G8B8A8_UNORM, samples: 1}
  other: {format: R8G8B8A8_UNORM, samples: 1}
  color_ms: {format: R8G8B8A8_UNORM, samples: 4}
  both: {format: D24_UNORM_S8_UINT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
"""


def passes(*stated: tuple[str, str], commands: tuple[str, ...], begin: str = "") -> str:
    """Render passes p0, p1, ... with one attachment each, an image and its operations; `p0` in the
    commands begins the first.
    """
    text = f"{IMAGES}renderPasses:\n"
    for n, (image, operations) in enumerate(stated):
        use = "depthStencilAttachment: a" if image == "both" else "colorAttachments: [a]"
        text += (
            f"  p{n}: {{attachments: {{a: {{image: {image}, {operations}}}}}, subpasses: "
            f"[{{{use}}}]}}\n"
        )
    text += "commands:\n"
    for command in commands:
        begins = command.startswith("p")
        text += (
            f"  - beginRenderPass: {{renderPass: {command}{begin}}}\n"
            if begins
            else f"  - {command}\n"
        )
    return text


END = "endRenderPass"
AREA = ", renderArea: {x: 0, y: 0, width: 64, height: 64}"
CLEAR_COLOR = (
    "clearAttachments: {attachments: [{aspect: COLOR, colorAttachment: 0}], rects: [{x: "
    "0, y: 0, width: 64, height: 64}]}"
)
CLEAR_DEPTH = (
    "clearAttachments: {attachments: [{aspect: DEPTH}], rects: [{x: 0, y: 0, width: 64, "
    "height: 64}]}"
)
CLEAR_STENCIL = CLEAR_DEPTH.replace("DEPTH", "STENCIL")
DRAW = "draw: {vertexCount: 300}"
STENCIL = "stencilLoadOp: DONT_CARE, stencilStoreOp: DONT_CARE"
LOADS = ("color", "loadOp: LOAD, storeOp: STORE")

UNTOUCHED = """
images:
  color: {format: R8G8B8A8_UNORM, samples: 1}
  both: {format: D24_UNORM_S8_UINT, samples: 1}
renderPasses:
  p:
    attachments:
      color: {image: color, loadOp: CLEAR, storeOp: STORE}
      both: {image: both, loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: STORE}
    subpasses:
      - {colorAttachments: [color], depthStencilAttachment: both}
pipelines:
  draw:
    renderPass: p
    colorBlendState: {attachments: [{colorWriteMask: [R, G, B, A]}]}
    depthStencilState: {depthTestEnable: DEPTH, depthBoundsTestEnable: false, stencilTestEnable: false}
commands:
  - beginRenderPass: {renderPass: p}
  - draw: {pipeline: draw, vertexCount: 300}
  - endRenderPass
"""

FIRES = {
    "RenderPass-redundant-store": (
        passes(
            ("color", "loadOp: CLEAR, storeOp: STORE"),
            ("color", "loadOp: CLEAR, storeOp: STORE"),
            commands=("p0", END, "p1", END),
        ),
        "stored-then-discarded",
    ),
    "RenderPass-redundant-clear": (
        passes(
            ("color", "loadOp: CLEAR, storeOp: STORE"),
            commands=("clearColorImage: {image: color}", "p0", END),
        ),
        "clear-command-instead-of-load-op",
    ),
    "RenderPass-inefficient-clear": (
        passes(LOADS, commands=("clearColorImage: {image: color}", "p0", END)),
        "clear-command-instead-of-load-op",
    ),
    "RenderPass-blitimage-loadopload": (
        passes(LOADS, commands=("blitImage: {srcImage: other, dstImage: color}", "p0", END)),
        "copied-then-loaded",
    ),
    "RenderPass-copyimage-loadopload": (
        passes(LOADS, commands=("copyImage: {srcImage: other, dstImage: color}", "p0", END)),
        "copied-then-loaded",
    ),
    "RenderPass-resolveimage-loadopload": (
        passes(LOADS, commands=("resolveImage: {srcImage: color_ms, dstImage: color}", "p0", END)),
        "copied-then-loaded",
    ),
    "StoreOpDontCareThenLoadOpLoad": (
        passes(
            ("color", "loadOp: CLEAR, storeOp: DONT_CARE"), LOADS, commands=("p0", END, "p1", END)
        ),
        "discarded-then-loaded",
    ),
    "DrawState-ClearCmdBeforeDraw": (
        passes(
            ("color", "loadOp: DONT_CARE, storeOp: STORE"),
            commands=("p0", CLEAR_COLOR, DRAW, END),
            begin=AREA,
        ),
        "clear-command-instead-of-load-op",
    ),
    "vkCmdClearAttachments-clear-after-load-color": (
        passes(LOADS, commands=("p0", CLEAR_COLOR, DRAW, END), begin=AREA),
        "clear-command-instead-of-load-op",
    ),
    "vkCmdClearAttachments-clear-after-load-depth": (
        passes(
            ("both", f"loadOp: LOAD, storeOp: DONT_CARE, {STENCIL}"),
            commands=("p0", CLEAR_DEPTH, DRAW, END),
            begin=AREA,
        ),
        "clear-command-instead-of-load-op",
    ),
    "vkCmdClearAttachments-clear-after-load-stencil": (
        passes(
            (
                "both",
                "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE",
            ),
            commands=("p0", CLEAR_STENCIL, DRAW, END),
            begin=AREA,
        ),
        "clear-command-instead-of-load-op",
    ),
    "vkCmdEndRenderPass-redundant-attachment-on-tile": (
        UNTOUCHED.replace("DEPTH", "false"),
        "attachment-untouched",
    ),
    "ClearValueWithoutLoadOpClear": (
        passes(LOADS, commands=("p0", END), begin=", clearValueCount: 1"),
        "clear-value-without-clear",
    ),
    "ClearValueCountHigherThanAttachmentCount": (
        passes(
            ("color", "loadOp: CLEAR, storeOp: STORE"),
            commands=("p0", END),
            begin=", clearValueCount: 2",
        ),
        "clear-value-without-clear",
    ),
    "vkCmdBeginRenderPass-attachment-needs-readback (as part of what is wrong)": (
        passes(
            ("color", "loadOp: CLEAR, storeOp: DONT_CARE"), LOADS, commands=("p0", END, "p1", END)
        ),
        "discarded-then-loaded",
    ),
}


@pytest.mark.parametrize("peer", FIRES)
def test_ours_fires_where_the_trigger_of(peer: str) -> None:
    text, rule = FIRES[peer]
    assert rule in rules(text)


def test_redundant_store_passes_over_a_load_op_of_dont_care_and_ours_does_not() -> None:
    text = passes(
        ("color", "loadOp: CLEAR, storeOp: STORE"),
        ("color", "loadOp: DONT_CARE, storeOp: STORE"),
        commands=("p0", END, "p1", END),
    )
    assert "stored-then-discarded" in rules(text)


def test_redundant_store_is_silent_for_presentable_images_and_so_is_ours() -> None:
    text = passes(("color", "loadOp: CLEAR, storeOp: STORE"), commands=("p0", END)).replace(
        "samples: 1}", "samples: 1, presentable: true}"
    )
    assert "stored-then-discarded" not in rules(text)


def test_redundant_store_takes_aspects_together_and_ours_does_not() -> None:
    """Stencil is loaded: the layer takes the image for read, and passes over the depth that nobody
    loads.
    """
    first = ("both", "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE")
    second = (
        "both",
        "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE",
    )
    found = [
        f
        for f in findings(passes(first, second, commands=("p0", END, "p1", END)))
        if f.rule == "stored-then-discarded"
    ]
    assert [f.message.startswith("the depth of") for f in found] == [True]


def test_store_op_dont_care_then_load_takes_aspects_together_and_ours_does_not() -> None:
    """Stencil is stored: the layer takes the image for stored, and passes over the depth that is
    not.
    """
    first = (
        "both",
        "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: STORE",
    )
    second = (
        "both",
        "loadOp: LOAD, storeOp: DONT_CARE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE",
    )
    found = [
        f
        for f in findings(passes(first, second, commands=("p0", END, "p1", END)))
        if f.rule == "discarded-then-loaded"
    ]
    assert [f.message.startswith("the depth of") for f in found] == [True]


def test_a_load_of_the_aspect_that_was_stored_is_no_load_of_what_was_not() -> None:
    first = (
        "both",
        "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE",
    )
    second = (
        "both",
        "loadOp: LOAD, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE",
    )
    assert not rules(passes(first, second, commands=("p0", END, "p1", END))) & {
        "stored-then-discarded",
        "discarded-then-loaded",
    }


def test_none_is_no_discard() -> None:
    """The layer once took it for one (its issue 4533)."""
    text = passes(("color", "loadOp: LOAD, storeOp: NONE"), LOADS, commands=("p0", END, "p1", END))
    assert "discarded-then-loaded" not in rules(text)


def test_none_after_a_clear_preserves_nothing_which_the_layer_passes_over() -> None:
    """VK-GL-CTS issue 618."""
    text = passes(
        ("color", "loadOp: DONT_CARE, storeOp: NONE"), LOADS, commands=("p0", END, "p1", END)
    )
    assert "discarded-then-loaded" in rules(text)


RENDERING = IMAGES + "commands:\n"


def rendering(*commands: str) -> str:
    lines = []
    for command in commands:
        image, _, operations = command.partition("|")
        begin = (
            f"  - beginRendering: {{{AREA[2:]}, colorAttachments: [{{image: {image}, "
            f"{operations}}}]}}\n"
        )
        lines.append(begin if operations else f"  - {command}\n")
    return RENDERING + "".join(lines)


E = "endRendering"
DYNAMIC = {
    "RenderPass-redundant-store": (
        ("color|loadOp: CLEAR, storeOp: STORE", E, "color|loadOp: CLEAR, storeOp: STORE", E),
        "stored-then-discarded",
    ),
    "StoreOpDontCareThenLoadOpLoad": (
        ("color|loadOp: CLEAR, storeOp: DONT_CARE", E, "color|loadOp: LOAD, storeOp: STORE", E),
        "discarded-then-loaded",
    ),
    "RenderPass-inefficient-clear": (
        ("clearColorImage: {image: color}", "color|loadOp: LOAD, storeOp: STORE", E),
        "clear-command-instead-of-load-op",
    ),
    "RenderPass-redundant-clear": (
        ("clearColorImage: {image: color}", "color|loadOp: CLEAR, storeOp: STORE", E),
        "clear-command-instead-of-load-op",
    ),
    "vkCmdClearAttachments-clear-after-load-color": (
        ("color|loadOp: LOAD, storeOp: STORE", CLEAR_COLOR, DRAW, E),
        "clear-command-instead-of-load-op",
    ),
    "RenderPass-blitimage-loadopload": (
        ("blitImage: {srcImage: other, dstImage: color}", "color|loadOp: LOAD, storeOp: STORE", E),
        "copied-then-loaded",
    ),
}


@pytest.mark.parametrize("peer", DYNAMIC)
def test_dynamic_rendering_is_followed_where_the_layer_does_not(peer: str) -> None:
    commands, rule = DYNAMIC[peer]
    text = rendering(*commands).replace(
        "R8G8B8A8_UNORM, samples: 1", "R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}"
    )
    assert rule in rules(text)


def test_clear_before_draw_compares_sizes_and_not_offsets_and_ours_does() -> None:
    """A clear of as large a part beside the render area."""
    moved = CLEAR_COLOR.replace("x: 0", "x: 32")
    assert "clear-command-instead-of-load-op" not in rules(
        passes(LOADS, commands=("p0", moved, DRAW, END), begin=AREA)
    )


def test_a_clear_of_a_part_of_an_atlas_is_what_the_command_is_for() -> None:
    """The layer once asked for a load operation there (its issue 1307)."""
    part = CLEAR_COLOR.replace("width: 64", "width: 16")
    assert "clear-command-instead-of-load-op" not in rules(
        passes(LOADS, commands=("p0", part, DRAW, END), begin=AREA)
    )


def test_clear_values_for_stencil_alone_are_values_for_a_clear() -> None:
    """The layer looks at loadOp alone (its issue 3123)."""
    operations = "loadOp: LOAD, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE"
    assert "clear-value-without-clear" not in rules(
        passes(("both", operations), commands=("p0", END), begin=", clearValueCount: 1")
    )


def test_redundant_attachment_takes_a_tested_depth_and_finds_the_stencil_beside_it() -> None:
    found = [
        f for f in findings(UNTOUCHED.replace("DEPTH", "true")) if f.rule == "attachment-untouched"
    ]
    assert [f.message.startswith("the stencil of") for f in found] == [True]


def test_redundant_attachment_blames_a_clear_that_is_stored_and_ours_does_not() -> None:
    text = UNTOUCHED.replace("DEPTH", "false").replace(
        "loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD",
        "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR",
    )
    assert "attachment-untouched" not in rules(text)
