"""How long contents live: who reads what a pass stored, what ends it, and which one rule says so.

A line of carets under a line of input marks what must be found there, and nothing else of `WATCHED` may be found.
"""

from __future__ import annotations

import pytest

from msaa_lint.linter.engine import FileResult
from tests.linter.lifetimes import watched as given_frames

WATCHED = {f"MSAA{number}" for number in (201, 202, 203, 204, 205, 206, 207, 210, 215, 602)}


def lint(text: str, **values: str) -> FileResult:
    """Lints a text, in which `$name` stands for a value."""
    return given_frames.lint(given_frames.given_text(text, **values))


def check(text: str, **values: str) -> FileResult:
    """As `watched.check`, of the watched rules; `$name` stands for a value."""
    return given_frames.check(given_frames.given_text(text, **values), WATCHED)


def undecided(linted: FileResult) -> set[tuple[str, str]]:
    return {(each.code, each.subject) for each in linted.undecided if each.code in WATCHED}


def message(linted: FileResult, code: str) -> str:
    (found,) = [finding for finding in linted.findings if finding.code == code]
    return found.message


# With commands: they are the order, and only they read.

READS = [
    "readImage: {image: ms, stage: FRAGMENT, access: SHADER_READ}",
    "resolveImage: {srcImage: ms, dstImage: single}",
    "copyImage: {srcImage: ms, dstImage: other_ms}",
    "blitImage: {srcImage: ms, dstImage: other_ms}",
    "copyImageToBuffer: {srcImage: ms}",
]


@pytest.mark.parametrize("command", READS)
@pytest.mark.parametrize("after", [True, False])
def test_a_command_reads(command: str, after: bool) -> None:
    """After the pass, or, the frame being a loop, before it in the next frame."""
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      other_ms: {format: R8G8B8A8_UNORM, samples: 4}
      single: {format: R8G8B8A8_UNORM, samples: 1}
    commands:
      $before
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      $after
    """,
        before="" if after else f"- {command}",
        after=f"- {command}" if after else "",
    )


def test_only_commands_read_where_there_are_commands() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED, TRANSFER_SRC, STORAGE]}
      other: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      scene:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
    #                                                ^^^^^ MSAA201 warning high
        subpasses:
          - {colorAttachments: [color]}
    commands:
      - beginRenderPass: {renderPass: scene}
      - endRenderPass
      - readImage: {image: other, stage: FRAGMENT}
      - copyImage: {srcImage: other, dstImage: ms}
    """)
    assert message(linted, "MSAA201") == "`color` stores 4 samples a pixel that nothing reads"


@pytest.mark.parametrize("load", ["CLEAR", "DONT_CARE"])
def test_a_load_operation_that_overwrites_ends_the_life_of_what_was_stored(load: str) -> None:
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
    #                                                                           ^^^^^ MSAA201 warning high
      - endRendering
      - beginRendering: {colorAttachments: [{image: ms, loadOp: $load, storeOp: STORE}]}
      - endRendering
      - readImage: {image: ms, stage: FRAGMENT}
    """,
        load=load,
    )


def test_the_reader_between_two_passes_counts() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - readImage: {image: ms, stage: FRAGMENT}
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
    #                                                                           ^^^^^ MSAA201
      - endRendering
    """)


def test_commands_that_overwrite_all_of_an_image_end_its_life() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      depth_ms: {format: D32_SFLOAT, samples: 4}
    commands:
      - beginRendering:
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]
    #                                                            ^^^^^ MSAA201
          depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: STORE}
    #                                                                ^^^^^ MSAA203
      - endRendering
      - clearColorImage: {image: ms}
      - clearDepthStencilImage: {image: depth_ms}
      - readImage: {image: ms, stage: FRAGMENT}
      - readImage: {image: depth_ms, stage: FRAGMENT}
    """)


@pytest.mark.parametrize(
    ("image", "command"),
    [
        ("format: R8G8B8A8_UNORM", "copyImage: {srcImage: other, dstImage: ms}"),
        ("format: R8G8B8A8_UNORM", "writeImage: {image: ms, stage: COMPUTE}"),
        ("format: R8G8B8A8_UNORM, arrayLayers: 2", "clearColorImage: {image: ms}"),
    ],
)
def test_a_write_that_may_be_partial_ends_nothing(image: str, command: str) -> None:
    check(
        """
    images:
      ms: {$image, samples: 4}
      other: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - $command
      - readImage: {image: ms, stage: FRAGMENT}
    """,
        image=image,
        command=command,
    )


def test_a_clear_command_may_mean_depth_or_stencil_alone() -> None:
    check("""
    images:
      depth_ms: {format: D24_UNORM_S8_UINT, samples: 4}
    commands:
      - beginRendering:
          depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: STORE}
          stencilAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: STORE}
      - endRendering
      - clearDepthStencilImage: {image: depth_ms}
      - readImage: {image: depth_ms, stage: FRAGMENT}
    """)


@pytest.mark.parametrize(
    ("image", "begin"),
    [
        ("extent: {width: 64, height: 64, depth: 1}", "renderArea: {x: 0, y: 0, width: 32, height: 64}"),
        ("extent: {width: 64, height: 64, depth: 1}", "renderArea: {x: 0, y: 0, width: 64, height: 63}"),
        ("extent: {width: 64, height: 64, depth: 1}", "renderArea: {x: 1, y: 0, width: 64, height: 64}"),
        ("flags: []", "renderArea: {x: 0, y: 0, width: 32, height: 32}"),
        ("arrayLayers: 2", "layerCount: 1"),
        ("arrayLayers: 2", "flags: []"),
        ("arrayLayers: 3", "viewMask: 3"),
    ],
)
def test_a_pass_over_a_part_of_an_image_leaves_the_rest(image: str, begin: str) -> None:
    """A smaller render area, or one of a size that cannot be compared; fewer layers, or a count that is not stated."""
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, $image}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - beginRendering: {$begin, colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - readImage: {image: ms, stage: FRAGMENT}
    """,
        image=image,
        begin=begin,
    )


@pytest.mark.parametrize(
    ("image", "begin"),
    [
        ("extent: {width: 64, height: 64, depth: 1}", "renderArea: {x: 0, y: 0, width: 64, height: 64}"),
        ("arrayLayers: 2", "layerCount: 2"),
        ("arrayLayers: 2", "viewMask: 3"),
        ("arrayLayers: 1", "layerCount: 1"),
    ],
)
def test_a_pass_over_all_of_an_image_ends_its_life(image: str, begin: str) -> None:
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, $image}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
    #                                                                           ^^^^^ MSAA201
      - endRendering
      - beginRendering: {$begin, colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - readImage: {image: ms, stage: FRAGMENT}
    """,
        image=image,
        begin=begin,
    )


def test_a_framebuffer_smaller_than_its_image_leaves_the_rest() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 64, height: 64, depth: 1}}
    renderPasses:
      scene:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
      corner:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
    framebuffers:
      whole: {renderPass: scene, attachments: [ms], width: 64, height: 64}
      part: {renderPass: corner, attachments: [ms], width: 32, height: 32}
    commands:
      - beginRenderPass: {renderPass: scene, framebuffer: whole}
      - endRenderPass
      - beginRenderPass: {renderPass: corner, framebuffer: part}
      - endRenderPass
      - readImage: {image: ms, stage: FRAGMENT}
    """)


def test_a_load_operation_that_is_not_stated_leaves_readers_unknown() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      first:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
      second:
        attachments:
          color: {image: ms, storeOp: DONT_CARE}
    #                                 ^^^^^^^^^ MSAA207
        subpasses:
          - {colorAttachments: [color]}
    """)
    assert undecided(linted) >= {("MSAA201", "renderPasses.first.attachments.color"), ("MSAA202", "renderPasses.second.attachments.color")}


# The pass itself, in the next frame.


@pytest.mark.parametrize("commands", ["", "commands: [{beginRenderPass: {renderPass: grow}}, endRenderPass]"])
@pytest.mark.parametrize("image", ["image: ms", "format: R8G8B8A8_UNORM, samples: 4"])
def test_a_pass_that_loads_what_it_stored_is_its_own_reader(commands: str, image: str) -> None:
    """201 is silent, 202 says what it costs; so it is for an attachment that names no image."""
    linted = check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      grow:
        attachments:
          color: {loadOp: LOAD, storeOp: STORE, $image}
    #                     ^^^^ MSAA202 warning high
        subpasses:
          - {colorAttachments: [color]}
    $commands
    """,
        image=image,
        commands=commands,
    )
    assert message(linted, "MSAA202") == "`color` reads back, when the pass begins, the 4 samples a pixel that it stored in the last frame"


def test_another_pass_between_ends_the_loop() -> None:
    """The load then reads what the other pass left, and what this one stored nobody."""
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - beginRendering: {colorAttachments: [{image: ms, loadOp: LOAD, storeOp: STORE}]}
    #                                                           ^^^^ MSAA202
    #                                                                          ^^^^^ MSAA201
      - endRendering
    """)
    assert message(linted, "MSAA202") == "`ms` reads 4 samples a pixel from memory when the pass begins"
    (found,) = [finding for finding in linted.findings if finding.code == "MSAA202"]
    (label,) = [label for label in found.labels if label.text == "stored here"]
    assert linted.source is not None
    assert linted.source.position(label.span.start) == (4, 77)


def test_a_load_shows_no_store_that_something_overwrote() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - writeImage: {image: ms, stage: COMPUTE}
      - beginRendering: {colorAttachments: [{image: ms, loadOp: LOAD, storeOp: DONT_CARE}]}
    #                                                           ^^^^ MSAA202
    #                                                                          ^^^^^^^^^ MSAA207
      - endRendering
    """)
    assert [label.text for found in linted.findings if found.code == "MSAA202" for label in found.labels] == ["4 samples"]


# Aspects are apart.


def test_a_load_of_stencil_does_not_read_depth() -> None:
    check("""
    images:
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
    renderPasses:
      first:
        attachments:
          both: {image: both_ms, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}
    #                                                    ^^^^^ MSAA203 warning high
        subpasses:
          - {depthStencilAttachment: both}
      second:
        attachments:
          both: {image: both_ms, loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE}
    #                                                                              ^^^^ MSAA204 warning high
        subpasses:
          - {depthStencilAttachment: both}
    """)


def test_stencil_that_is_loaded_and_stored_for_nobody_is_one_finding_at_the_load() -> None:
    linted = check("""
    images:
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4}
    commands:
      - beginRendering: {stencilAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}}
      - endRendering
      - beginRendering: {stencilAttachment: {image: both_ms, loadOp: LOAD, storeOp: STORE}}
    #                                                                ^^^^ MSAA204
      - endRendering
    """)
    assert message(linted, "MSAA204") == "the stencil of `both_ms` is loaded, 4 samples a pixel from memory, and stored for nobody"


def test_an_attachment_without_a_known_format_is_undecided() -> None:
    """What its `loadOp` means is not known: depth, or nothing where there is stencil alone."""
    linted = check("""
    renderPasses:
      first:
        attachments:
          depth: {samples: 4, loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: STORE, initialLayout: UNDEFINED}
        subpasses:
          - {depthStencilAttachment: depth}
    """)
    assert {code for code, _ in undecided(linted)} >= {"MSAA202", "MSAA210"}


# Without commands: every pass once, in order; what a stated usage allows is done.


@pytest.mark.parametrize("usage", ["SAMPLED", "STORAGE", "INPUT_ATTACHMENT", "TRANSFER_SRC"])
def test_a_stated_usage_is_taken_as_used(usage: str) -> None:
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, $usage]}
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, $usage]}
    renderPasses:
      scene:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
          both: {image: both_ms, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}
        subpasses:
          - {colorAttachments: [color], depthStencilAttachment: both}
    """,
        usage=usage,
    )


def test_a_stated_usage_without_reading_has_no_reader() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSFER_DST]}
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4, usage: []}
    renderPasses:
      scene:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
    #                                                ^^^^^ MSAA201 warning high
          both: {image: both_ms, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}
    #                                                    ^^^^^ MSAA203 warning high
    #                                                                                                 ^^^^^ MSAA204 warning high
        subpasses:
          - {colorAttachments: [color], depthStencilAttachment: both}
    """)


@pytest.mark.parametrize("image", ["image: ms", "format: R8G8B8A8_UNORM, samples: 4"])
@pytest.mark.parametrize("resolved", [True, False])
def test_unknown_readers(image: str, resolved: bool) -> None:
    """Neither usage nor commands: colour fires with medium confidence where the pass resolves it, and is undecided where not."""
    linted = check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      scene:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE, $image}
    $mark
          output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color], resolveAttachments: [$target]}
    """,
        image=image,
        mark="#                                     ^^^^^ MSAA201 warning medium" if resolved else "",
        target="output" if resolved else "null",
    )
    subject = ("MSAA201", "renderPasses.scene.attachments.color")
    assert (subject in undecided(linted)) is not resolved
    if resolved:
        assert message(linted, "MSAA201").endswith("unless something else reads the samples, nobody does")


def test_unknown_readers_of_depth_and_stencil_are_undecided_even_where_resolved() -> None:
    linted = check("""
    renderPasses:
      scene:
        attachments:
          - {format: D24_UNORM_S8_UINT, samples: 4, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}
          - {format: D24_UNORM_S8_UINT, samples: 1, loadOp: DONT_CARE, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE}
        subpasses:
          - depthStencilAttachment: 0
            depthStencilResolve: {attachment: 1, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: SAMPLE_ZERO}
    """)
    subject = "renderPasses.scene.attachments[0]"
    assert undecided(linted) >= {("MSAA203", subject), ("MSAA204", subject)}


def test_a_later_pass_loads() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      first:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
      second:
        attachments:
          color: {image: ms, loadOp: LOAD, storeOp: STORE}
    #                                ^^^^ MSAA202
    #                                               ^^^^^ MSAA201
        subpasses:
          - {colorAttachments: [color]}
    """)


def test_a_later_pass_clears_before_another_loads() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      first:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
    #                                                ^^^^^ MSAA201
        subpasses:
          - {colorAttachments: [color]}
      second:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
      third:
        attachments:
          color: {image: ms, loadOp: LOAD, storeOp: STORE}
    #                                ^^^^ MSAA202
    #                                               ^^^^^ MSAA201
        subpasses:
          - {colorAttachments: [color]}
    """)


def test_a_single_framebuffer_binds_without_commands() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
      sampled_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED]}
    renderPasses:
      scene:
        attachments:
          color: {image: sampled_ms, loadOp: CLEAR, storeOp: STORE}
    #                                                        ^^^^^ MSAA201 warning high
        subpasses:
          - {colorAttachments: [color]}
    framebuffers:
      main: {renderPass: scene, attachments: [ms], width: 64, height: 64}
    """)


# Passes that the commands never begin are structures only.


@pytest.mark.parametrize("commands", ["[]", "[{present: {image: backbuffer}}]", "[{beginRenderPass: {renderPass: begun}}, endRenderPass]"])
def test_a_pass_that_is_never_begun_is_judged_by_its_usage(commands: str) -> None:
    linted = check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
      sampled_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED]}
      unknown_ms: {format: R8G8B8A8_UNORM, samples: 4}
      backbuffer: {format: R8G8B8A8_UNORM, samples: 1}
    renderPasses:
      idle:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
    #                                                ^^^^^ MSAA201 warning high
          sampled: {image: sampled_ms, loadOp: CLEAR, storeOp: STORE}
          unknown: {image: unknown_ms, loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color, sampled, unknown]}
      begun:
        attachments:
          output: {image: backbuffer, loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [output]}
    commands: $commands
    """,
        commands=commands,
    )
    assert ("MSAA201", "renderPasses.idle.attachments.unknown") in undecided(linted)


@pytest.mark.parametrize("reader", ["own load", "another idle pass", "a command"])
def test_what_is_described_to_read_counts_for_a_pass_that_is_never_begun(reader: str) -> None:
    own = "LOAD" if reader == "own load" else "CLEAR"
    other = "LOAD" if reader == "another idle pass" else "CLEAR"
    linted = lint(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      idle:
        attachments:
          color: {image: ms, loadOp: $own, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
      other:
        attachments:
          color: {image: ms, loadOp: $other, storeOp: DONT_CARE}
        subpasses:
          - {colorAttachments: [color]}
    commands: [$command]
    """,
        own=own,
        other=other,
        command="{readImage: {image: ms, stage: FRAGMENT}}" if reader == "a command" else "",
    )
    assert "MSAA201" not in {found.code for found in linted.findings}


# Framebuffers that alternate.

TWO_IMAGES = """
images:
  a: {format: R8G8B8A8_UNORM, samples: 4}
  b: {format: R8G8B8A8_UNORM, samples: 4}
renderPasses:
  scene:
    attachments:
      color: {loadOp: CLEAR, storeOp: STORE}
%s
    subpasses:
      - {colorAttachments: [color]}
framebuffers:
  fa: {renderPass: scene, attachments: [a], width: 64, height: 64}
  fb: {renderPass: scene, attachments: [b], width: 64, height: 64}
commands:
%s
"""
STORED = "#                                     ^^^^^ MSAA201 warning high"


def test_alternating_images_that_nothing_reads() -> None:
    check(TWO_IMAGES % (STORED, "  - beginRenderPass: {renderPass: scene, framebuffer: [fa, fb]}\n  - endRenderPass"))


@pytest.mark.parametrize("read", ["a", "b"])
def test_one_of_alternating_images_is_read(read: str) -> None:
    """It is one structure: where one of the images needs the store, it is needed."""
    reads = f"  - readImage: {{image: {read}, stage: FRAGMENT}}\n"
    check(TWO_IMAGES % ("", reads + "  - beginRenderPass: {renderPass: scene, framebuffer: [fa, fb]}\n  - endRenderPass"))


def test_a_pass_that_alternates_does_not_end_the_life_of_either_image() -> None:
    """In every other frame it clears the other one."""
    check("""
    images:
      a: {format: R8G8B8A8_UNORM, samples: 4}
      b: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      scene:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
    framebuffers:
      fa: {renderPass: scene, attachments: [a], width: 64, height: 64}
      fb: {renderPass: scene, attachments: [b], width: 64, height: 64}
    commands:
      - beginRendering: {colorAttachments: [{image: a, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - beginRenderPass: {renderPass: scene, framebuffer: [fa, fb]}
      - endRenderPass
      - readImage: {image: a, stage: FRAGMENT}
    """)


def test_framebuffers_that_alternate_over_one_multisampled_image() -> None:
    """As with one multisampled image for all swapchain images: it is cleared in every frame."""
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      first: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
      second: {format: R8G8B8A8_UNORM, samples: 1, presentable: true}
    renderPasses:
      scene:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE}
    #                                     ^^^^^ MSAA201 warning high
          output: {loadOp: LOAD, storeOp: DONT_CARE}
    #                      ^^^^ MSAA205 warning high
    #                                     ^^^^^^^^^ MSAA206 error high
        subpasses:
          - {colorAttachments: [color], resolveAttachments: [output]}
    framebuffers:
      fa: {renderPass: scene, attachments: [ms, first], width: 64, height: 64}
      fb: {renderPass: scene, attachments: [ms, second], width: 64, height: 64}
    commands:
      - beginRenderPass: {renderPass: scene, framebuffer: [fa, fb]}
      - endRenderPass
      - present: {image: first}
      - present: {image: second}
    """)


def test_each_begin_has_its_own_framebuffer() -> None:
    """The second begin clears the other image: what was stored in the first one lives on."""
    check("""
    images:
      a: {format: R8G8B8A8_UNORM, samples: 4}
      b: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      scene:
        attachments:
          color: {loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color]}
    framebuffers:
      fa: {renderPass: scene, attachments: [a], width: 64, height: 64}
      fb: {renderPass: scene, attachments: [b], width: 64, height: 64}
    commands:
      - beginRendering: {colorAttachments: [{image: a, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - beginRenderPass: {renderPass: scene, framebuffer: fb}
      - endRenderPass
      - readImage: {image: a, stage: FRAGMENT}
      - readImage: {image: b, stage: FRAGMENT}
      - beginRenderPass: {renderPass: scene, framebuffer: fa}
      - endRenderPass
    """)


# Input attachments.


@pytest.mark.parametrize("commands", ["", "commands: [{beginRenderPass: {renderPass: scene}}, endRenderPass]"])
def test_an_input_attachment_of_the_same_pass_is_a_reader(commands: str) -> None:
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
      single: {format: R8G8B8A8_UNORM, samples: 1}
    renderPasses:
      scene:
        attachments:
          color: {image: ms, loadOp: CLEAR, storeOp: STORE}
          both: {image: both_ms, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}
          output: {image: single, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color], depthStencilAttachment: both}
          - {colorAttachments: [output], inputAttachments: [color, both]}
    $commands
    """,
        commands=commands,
    )


@pytest.mark.parametrize("load", ["loadOp: LOAD", "flags: []"])
def test_an_input_attachment_of_a_later_pass_is_a_reader(load: str) -> None:
    """What a pass only reads it reads as it was, whether or not its load operation is stated."""
    mark = "#                       ^^^^ MSAA202" if load == "loadOp: LOAD" else ""
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    renderPasses:
      reader:
        attachments:
          samples: {$load, image: ms, storeOp: DONT_CARE}
    $mark
          output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [output], inputAttachments: [samples]}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]}
      - endRendering
      - beginRenderPass: {renderPass: reader}
      - endRenderPass
    """,
        load=load,
        mark=mark,
    )


@pytest.mark.parametrize("local", ["imageLayout: RENDERING_LOCAL_READ", "imageLayout: GENERAL"])
def test_a_local_read_of_a_rendering_is_an_input_attachment(local: str) -> None:
    read = "- readImage: {image: ms, stage: FRAGMENT}" if "GENERAL" in local else ""
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, $local, loadOp: CLEAR, storeOp: DONT_CARE}]}
      $read
      - endRendering
    """,
        local=local,
        read=read,
    )


def test_a_read_after_the_rendering_is_none() -> None:
    """The samples were not stored: what is read is undefined."""
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE}]}
    #                                                                           ^^^^^^^^^ MSAA207 error high
      - endRendering
      - readImage: {image: ms, stage: FRAGMENT}
    """)


# Suspended and resumed renderings.


def test_a_suspended_rendering_is_judged_where_it_ends() -> None:
    """The pieces state the same operations; the last one stores, and nothing reads it."""
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4}
    commands:
      - beginRendering:
          flags: [SUSPENDING]
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]
          depthAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
          stencilAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
      - endRendering
      - beginRendering:
          flags: [SUSPENDING, RESUMING]
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]
          depthAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
          stencilAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
      - endRendering
      - beginRendering:
          flags: [RESUMING]
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]
    #                                                            ^^^^^ MSAA201
          depthAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
    #                                                               ^^^^^ MSAA203
          stencilAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
    #                                                                 ^^^^^ MSAA204
      - endRendering
    """)


def test_a_suspended_rendering_stores_nothing() -> None:
    """Even where what resumes it is recorded somewhere else."""
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      both_ms: {format: D24_UNORM_S8_UINT, samples: 4}
    commands:
      - beginRendering:
          flags: [SUSPENDING]
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE}]
          depthAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
          stencilAttachment: {image: both_ms, loadOp: CLEAR, storeOp: STORE}
      - endRendering
    """)


def test_a_suspended_rendering_loses_nothing_until_it_ends() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {flags: [SUSPENDING], colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE}]}
      - endRendering
      - beginRendering: {flags: [RESUMING], colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE}]}
    #                                                                                              ^^^^^^^^^ MSAA207 warning
      - endRendering
    """)


def test_a_resumed_rendering_that_loads_is_reported_too() -> None:
    check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
    commands:
      - beginRendering: {flags: [SUSPENDING], colorAttachments: [{image: ms, loadOp: LOAD, storeOp: STORE}]}
    #                                                                                ^^^^ MSAA202
      - endRendering
      - beginRendering: {flags: [RESUMING], colorAttachments: [{image: ms, loadOp: LOAD, storeOp: STORE}]}
    #                                                                              ^^^^ MSAA202
      - endRendering
    """)


# A resolve in the same pass is not a reader.


def test_a_resolve_in_the_pass_is_not_a_reader() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      depth_ms: {format: D32_SFLOAT, samples: 4}
      single: {format: R8G8B8A8_UNORM, samples: 1}
      depth: {format: D32_SFLOAT, samples: 1}
    commands:
      - beginRendering:
          colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: STORE, resolveMode: AVERAGE, resolveImage: single}]
    #                                                            ^^^^^ MSAA201 warning high
          depthAttachment: {image: depth_ms, loadOp: CLEAR, storeOp: STORE, resolveMode: SAMPLE_ZERO, resolveImage: depth}
    #                                                                ^^^^^ MSAA203 warning high
      - endRendering
      - readImage: {image: single, stage: FRAGMENT}
      - readImage: {image: depth, stage: FRAGMENT}
    """)
    assert linted.source is not None
    text = linted.source.text
    labels = {(found.code, text[label.span.start : label.span.end]) for found in linted.findings for label in found.labels}
    assert {("MSAA201", "single"), ("MSAA203", "depth")} <= labels


def test_a_resolve_mode_of_none_is_no_resolve() -> None:
    linted = check("""
    renderPasses:
      scene:
        attachments:
          both: {format: D24_UNORM_S8_UINT, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}
          out: {format: D24_UNORM_S8_UINT, samples: 1, loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE}
    #                                                          ^^^^ MSAA205
        subpasses:
          - depthStencilAttachment: both
            depthStencilResolve: {attachment: out, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}
    """)
    assert message(linted, "MSAA205") == "the depth of `out` is read from memory when the pass begins, and a resolve overwrites all of it"


def test_a_resolve_mode_that_is_not_stated_decides_nothing() -> None:
    linted = check("""
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4}
      single: {format: R8G8B8A8_UNORM, samples: 1}
    commands:
      - beginRendering: {colorAttachments: [{image: ms, loadOp: CLEAR, storeOp: DONT_CARE, resolveImage: single}]}
      - endRendering
    """)
    assert ("MSAA207", "commands[0].beginRendering.colorAttachments[0]") in undecided(linted)


# One cause, one finding.


def test_a_load_from_undefined_stands_in_for_the_readback() -> None:
    linted = check("""
    renderPasses:
      ui:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE, initialLayout: UNDEFINED}
    #                                                         ^^^^ MSAA210 error high
          both:
            format: D24_UNORM_S8_UINT
            samples: 1
            loadOp: LOAD
    #               ^^^^ MSAA215 note high
            storeOp: STORE
            stencilLoadOp: LOAD
    #                      ^^^^ MSAA210 error high
            stencilStoreOp: STORE
            initialLayout: DEPTH_ATTACHMENT_OPTIMAL
            stencilInitialLayout: UNDEFINED
        subpasses:
          - {colorAttachments: [color], depthStencilAttachment: both}
    """)
    notes = [found.notes for found in linted.findings if found.code == "MSAA210"]
    assert notes == [("covers framebuffer-readback (MSAA215) too",)] * 2


def test_a_resolve_target_that_is_loaded_is_no_readback() -> None:
    """Not even where a later subpass draws on the resolved picture."""
    check("""
    renderPasses:
      scene:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE, initialLayout: GENERAL}
    #                                                          ^^^^ MSAA205 warning high
        subpasses:
          - {colorAttachments: [color], resolveAttachments: [output]}
          - {colorAttachments: [output]}
    """)


@pytest.mark.parametrize("preserved", ["", ", preserveAttachments: [color, both, single]"])
def test_attachments_that_no_subpass_uses_are_another_rule_s(preserved: str) -> None:
    check(
        """
    images:
      ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
    renderPasses:
      scene:
        attachments:
          color: {image: ms, loadOp: LOAD, storeOp: STORE, initialLayout: UNDEFINED}
          both: {format: D24_UNORM_S8_UINT, samples: 4, loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: STORE}
          single: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE, initialLayout: UNDEFINED}
          drawn: {format: R8G8B8A8_UNORM, samples: 1, loadOp: CLEAR, storeOp: STORE}
        subpasses:
          - {colorAttachments: [drawn, null]$preserved}
    """,
        preserved=preserved,
    )


# What a resolve overwrites, and what is read of it.


def test_a_resolve_from_nothing_overwrites_nothing() -> None:
    """What is wrong there is another rule's: the reference to resolve from is missing."""
    check("""
    renderPasses:
      scene:
        attachments:
          output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: CLEAR, storeOp: DONT_CARE}
          depth: {format: D32_SFLOAT, samples: 1, loadOp: LOAD, storeOp: NONE, initialLayout: GENERAL}
        subpasses:
          - colorAttachments: [null]
            resolveAttachments: [output]
            depthStencilResolve: {attachment: depth, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}
    """)


def test_an_input_attachment_before_or_after_the_resolve() -> None:
    check("""
    renderPasses:
      before:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          history: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: DONT_CARE, initialLayout: GENERAL}
    #                                                                          ^^^^^^^^^ MSAA206 error high
        subpasses:
          - {colorAttachments: [color], inputAttachments: [history]}
          - {colorAttachments: [color], resolveAttachments: [history]}
      after:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          resolved: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: DONT_CARE, initialLayout: GENERAL}
    #                                                            ^^^^ MSAA205 warning high
          output: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: STORE}
        subpasses:
          - {colorAttachments: [color], resolveAttachments: [resolved]}
          - {colorAttachments: [output], inputAttachments: [resolved]}
    """)


@pytest.mark.parametrize(
    ("area", "size", "expected"),
    [
        ("{x: 0, y: 0, width: 64, height: 64}", "extent: {width: 64, height: 64, depth: 1}", "fires"),
        ("{x: 0, y: 0, width: 32, height: 64}", "extent: {width: 64, height: 64, depth: 1}", "silent"),
        ("{x: 0, y: 8, width: 64, height: 56}", "flags: []", "silent"),
        ("{x: 0, y: 0, width: 64, height: 64}", "flags: []", "undecided"),
    ],
)
def test_a_smaller_render_area_keeps_what_the_target_held(area: str, size: str, expected: str) -> None:
    linted = check(
        """
    images:
      single: {format: R8G8B8A8_UNORM, samples: 1, $size}
    renderPasses:
      scene:
        attachments:
          color: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}
          output: {image: single, loadOp: LOAD, storeOp: STORE, initialLayout: GENERAL}
    $mark
        subpasses:
          - {colorAttachments: [color], resolveAttachments: [output]}
    commands:
      - beginRenderPass: {renderPass: scene, renderArea: $area}
      - endRenderPass
    """,
        size=size,
        area=area,
        mark="#                                     ^^^^ MSAA205" if expected == "fires" else "",
    )
    assert (("MSAA205", "renderPasses.scene.attachments.output") in undecided(linted)) is (expected == "undecided")


# Dependencies between frames.


def synchronised(dependencies: str, more: str = "") -> str:
    return f"""
images:
  ms: {{format: R8G8B8A8_UNORM, samples: 4}}
  depth_ms: {{format: D32_SFLOAT, samples: 4}}
  single: {{format: R8G8B8A8_UNORM, samples: 1}}
renderPasses:
  scene:
    attachments:
      color: {{image: ms, loadOp: CLEAR, storeOp: DONT_CARE}}
      depth: {{image: depth_ms, loadOp: CLEAR, storeOp: DONT_CARE}}
      output: {{image: single, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses:
      - {{colorAttachments: [color], resolveAttachments: [output], depthStencilAttachment: depth}}
    dependencies:
{dependencies}
{more}
"""


def test_an_absent_access_mask_is_none() -> None:
    check(
        synchronised("""\
      - srcSubpass: EXTERNAL
#       ^^^^^^^^^^ MSAA602 error medium
        dstSubpass: 0
        srcStageMask: [ALL_COMMANDS]""")
    )


def test_reads_are_no_writes() -> None:
    check(
        synchronised("""\
      - srcSubpass: EXTERNAL
        dstSubpass: 0
        srcStageMask: [ALL_COMMANDS]
        srcAccessMask: [COLOR_ATTACHMENT_READ, SHADER_READ]
#                      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ MSAA602""")
    )


@pytest.mark.parametrize("stage", ["LATE_FRAGMENT_TESTS", "ALL_GRAPHICS", "ALL_COMMANDS", "BOTTOM_OF_PIPE"])
def test_stages_that_include_the_late_tests(stage: str) -> None:
    check(synchronised(f"      - {{srcSubpass: EXTERNAL, dstSubpass: 0, srcStageMask: [{stage}], srcAccessMask: [MEMORY_WRITE]}}"))


def test_a_barrier_for_another_image_orders_nothing() -> None:
    check(
        synchronised(
            """\
      - srcSubpass: EXTERNAL
        dstSubpass: 0
        srcAccessMask: []
#                      ^^ MSAA602""",
            """\
commands:
  - pipelineBarrier: {srcStageMask: [ALL_COMMANDS], srcAccessMask: [MEMORY_WRITE], dstStageMask: [ALL_COMMANDS], images: [single]}
  - beginRenderPass: {renderPass: scene}
  - endRenderPass
  - present: {image: single}""",
        )
    )


def test_a_barrier_orders_no_pass_that_is_never_begun() -> None:
    check(
        synchronised(
            """\
      - srcSubpass: EXTERNAL
        dstSubpass: 0
        srcAccessMask: 0
#                      ^ MSAA602""",
            "commands: [{pipelineBarrier: {srcStageMask: [ALL_COMMANDS], srcAccessMask: [MEMORY_WRITE], dstStageMask: [ALL_COMMANDS]}}]",
        )
    )


@pytest.mark.parametrize("dependency", ["", "{srcSubpass: 0, dstSubpass: EXTERNAL, srcStageMask: [ALL_COMMANDS]}"])
def test_no_stated_dependency_is_undecided(dependency: str) -> None:
    linted = check(synchronised(f"      [{dependency}]"))
    assert ("MSAA602", "renderPasses.scene.subpasses[0]") in undecided(linted)


# Hostile input.


@pytest.mark.parametrize(("begins", "followed"), [(1, True), (700, False)])
def test_more_uses_than_are_followed_leave_readers_unknown(begins: int, followed: bool) -> None:
    """Attachments times begins grow faster than the input does: beyond a limit nothing is claimed, and nothing swells."""
    attachments = 750
    text = "images: {ms: {format: R8G8B8A8_UNORM, samples: 4}}\nrenderPasses:\n  scene:\n    attachments:\n"
    text += "      - {image: ms, loadOp: CLEAR, storeOp: STORE}\n" * attachments
    text += f"    subpasses: [{{colorAttachments: {list(range(attachments))}}}]\ncommands:\n"
    text += "  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n" * begins
    linted = lint(text)
    fired = [found for found in linted.findings if found.code == "MSAA201"]
    assert len(fired) == (attachments if followed else 0)
    assert (("MSAA201", "renderPasses.scene.attachments[0]") in undecided(linted)) is not followed
