"""What becomes of what a pass stores, and what was in what it loads: against a frame that is
played, and case by case.

A line of carets under a line of input marks what must be found there, and nothing else of `WATCHED`
may be found.
"""

from __future__ import annotations

import textwrap
from typing import NamedTuple

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.results import FileResult
from tests.linter.lifetimes import watched as given_frames
from tests.linter.lifetimes.watched import ENGINE, as_written
from tests.strength import examples

WATCHED = {f"MSAA{number}" for number in (107, 208, 209, 211, 212, 213, 214)}


def lint(text: str, **values: str) -> FileResult:
    """Lints a text, in which `$name` stands for a value."""
    return given_frames.lint(given_frames.given_text(text, **values), prices=True)


def check(text: str, **values: str) -> FileResult:
    """As `watched.check`, of the watched rules; `$name` stands for a value."""
    return given_frames.check(given_frames.given_text(text, **values), WATCHED, prices=True)


def undecided(linted: FileResult, code: str) -> set[str]:
    return {each.subject for each in linted.undecided if each.code == code}


def message(linted: FileResult, code: str) -> str:
    (found,) = [finding for finding in linted.findings if finding.code == code]
    return found.message


# A frame that is played: every image holds marks of who wrote what is in it, and for whom is told
# by who reads them.


class Step(NamedTuple):
    """A pass that begins, or a command."""

    kind: str
    """`pass` or the command."""
    which: int
    """The pass, or the image."""
    images: tuple[int, ...] = ()
    """A pass: the images of its framebuffers, which alternate from frame to frame."""


class Played(NamedTuple):
    """What must be found, by code: the passes."""

    wasted: set[int]
    undefined: set[int]
    cleared: set[int]
    copied: set[int]


Operations = list[tuple[str, str]]
IMAGES = 2
COMMANDS = {
    "read": "copyImageToBuffer: {{srcImage: i{0}}}",
    "clear": "clearColorImage: {{image: i{0}}}",
    "copy": "copyImage: {{srcImage: source, dstImage: i{0}}}",
    "write": "writeImage: {{image: i{0}, stage: COMPUTE}}",
}


def play(operations: Operations, steps: list[Step]) -> Played:
    """What the frames come to, once they have settled."""
    holds: list[set[tuple[str, int]]] = [{("before", 0)} for _ in range(IMAGES)]
    last = [""] * IMAGES
    stores, read, undefined, copied = set[int](), set[int](), set[int](), set[int]()
    cleared: dict[int, bool] = {}
    for frame in range(36):
        settled = frame >= 12
        for step in steps:
            if step.kind != "pass":
                image = step.which
                if step.kind == "read":
                    read |= {which for kind, which in holds[image] if kind == "stored"}
                    if settled and [kind for kind, _ in holds[image]] == ["discarded"]:
                        undefined |= {which for _, which in holds[image]}
                elif step.kind == "clear":
                    holds[image] = {("cleared", 0)}
                else:
                    holds[image] = {
                        *((k, w) for k, w in holds[image] if k != "discarded"),
                        ("written", 0),
                    }
                last[image] = step.kind
                continue
            image = step.images[frame % len(step.images)]
            begin, end = operations[step.which]
            if begin == "LOAD":
                read |= {which for kind, which in holds[image] if kind == "stored"}
                if settled and [kind for kind, _ in holds[image]] == ["discarded"]:
                    undefined.add(step.which)
                if settled and last[image] == "copy":
                    copied.add(step.which)
            if settled:
                cleared[step.which] = cleared.get(step.which, True) and last[image] == "clear"
            if end == "STORE":
                stores.add(step.which)
            holds[image] = {("stored" if end == "STORE" else "discarded", step.which)}
            last[image] = "pass"
    return Played(
        stores - read, undefined, {which for which, every in cleared.items() if every}, copied
    )


def described(
    operations: Operations,
    steps: list[Step],
    usage: str = "usage: [COLOR_ATTACHMENT], presentable: false",
) -> str:
    """The same as a description."""
    lines = ["images:", "  source: {format: R8_UNORM, samples: 1}"]
    lines += [f"  i{n}: {{format: R8_UNORM, samples: 1, {usage}}}" for n in range(IMAGES)]
    lines.append("renderPasses:")
    for n, (begin, end) in enumerate(operations):
        lines += [
            f"  p{n}:",
            "    attachments:",
            f"      color: {{format: R8_UNORM, samples: 1, loadOp: {begin}, storeOp: {end}}}",
        ]
        lines.append("    subpasses: [{colorAttachments: [color]}]")
    lines.append("framebuffers:")
    lines += [
        f"  f{n}x{i}: {{renderPass: p{n}, attachments: [i{i}]}}"
        for n in range(len(operations))
        for i in range(IMAGES)
    ]
    lines.append("commands:")
    for step in steps:
        if step.kind == "pass":
            buffers = ", ".join(f"f{step.which}x{i}" for i in step.images)
            lines += [
                f"  - beginRenderPass: {{renderPass: p{step.which}, framebuffer: [{buffers}]}}",
                "  - endRenderPass",
            ]
        else:
            lines.append(f"  - {COMMANDS[step.kind].format(step.which)}")
    return "\n".join(lines) + "\n"


def found(linted: FileResult, code: str) -> set[int]:
    """The passes that a rule blames."""
    return {
        int(each.subject.split(".")[1].removeprefix("p"))
        for each in linted.findings
        if each.code == code
    }


@st.composite
def frames(draw: st.DrawFn, alternating: bool) -> tuple[Operations, list[Step]]:
    """Some passes with their operations, and in which order a frame begins them and gives
    commands.
    """
    operations = [
        (
            draw(st.sampled_from(["LOAD", "LOAD", "CLEAR", "DONT_CARE"])),
            draw(st.sampled_from(["STORE", "STORE", "DONT_CARE"])),
        )
        for _ in range(draw(st.integers(1, 4)))
    ]
    steps = []
    for _ in range(draw(st.integers(1, 7))):
        if draw(st.integers(0, 2)):
            most = 3 if alternating else 1
            images = tuple(draw(st.lists(st.integers(0, IMAGES - 1), min_size=1, max_size=most)))
            steps.append(Step("pass", draw(st.integers(0, len(operations) - 1)), images))
        else:
            steps.append(
                Step(draw(st.sampled_from(sorted(COMMANDS))), draw(st.integers(0, IMAGES - 1)))
            )
    return operations, steps


@examples(3)
@given(st.booleans().flatmap(frames))
def test_a_frame_that_is_played(case: tuple[Operations, list[Step]]) -> None:
    """Whatever the order, however often a pass is begun, and whichever images alternate."""
    operations, steps = case
    expected = play(operations, steps)
    linted = lint(described(operations, steps))
    assert found(linted, "MSAA208") == expected.wasted
    assert found(linted, "MSAA209") == expected.undefined
    assert found(linted, "MSAA211") == expected.cleared
    assert found(linted, "MSAA213") == expected.copied


@examples(1)
@given(st.booleans().flatmap(frames), st.integers(0, 30), st.integers(0, IMAGES - 1))
def test_a_further_reader_excuses_stores_and_blames_none(
    case: tuple[Operations, list[Step]], at: int, image: int
) -> None:
    operations, steps = case
    before = found(lint(described(operations, steps)), "MSAA208")
    at %= len(steps) + 1
    after = found(
        lint(described(operations, [*steps[:at], Step("read", image), *steps[at:]])), "MSAA208"
    )
    assert after <= before


@examples(1)
@given(frames(alternating=False), st.integers(0, 6))
def test_where_the_loop_is_cut_does_not_matter(
    case: tuple[Operations, list[Step]], at: int
) -> None:
    """By what the usage tells, the frame may begin anywhere."""
    operations, steps = case
    at %= len(steps)
    one, other = (
        lint(described(operations, steps)),
        lint(described(operations, [*steps[at:], *steps[:at]])),
    )
    for code in ("MSAA208", "MSAA209", "MSAA211", "MSAA213"):
        assert found(one, code) == found(other, code)


@examples(1)
@given(frames(alternating=True))
def test_what_the_usage_does_not_tell_is_never_more(case: tuple[Operations, list[Step]]) -> None:
    """Unknown is not wrong: without a usage a part of it is found."""
    operations, steps = case
    known, unknown = (
        lint(described(operations, steps)),
        lint(described(operations, steps, usage="mipLevels: 1")),
    )
    for code in ("MSAA208", "MSAA209"):
        assert found(unknown, code) <= found(known, code)


READS = [
    "readImage: {image: x, stage: FRAGMENT, access: SHADER_READ}",
    "resolveImage: {srcImage: x, dstImage: other}",
    "copyImage: {srcImage: x, dstImage: other}",
    "blitImage: {srcImage: x, dstImage: other}",
    "copyImageToBuffer: {srcImage: x}",
    "present: {image: x}",
]
NEUTRAL = [
    "readImage: {image: other, stage: FRAGMENT, access: SHADER_READ}",
    "pipelineBarrier: {srcStageMask: [ALL_COMMANDS], dstStageMask: [ALL_COMMANDS], images: [x]}",
    "copyImage: {srcImage: third, dstImage: x}",
    "writeImage: {image: x, stage: COMPUTE}",
    "copyBufferToImage: {dstImage: x}",
    "present: {image: third}",
]


@examples(1.2)
@given(
    st.lists(st.sampled_from(NEUTRAL), max_size=4),
    st.sampled_from(["CLEAR", "DONT_CARE"]),
    st.sampled_from(
        [
            "x: {format: R8_UNORM, samples: 1}",
            "x: {format: R8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}",
        ]
    ),
    st.sampled_from(READS),
    st.integers(0, 4),
)
def test_a_reader_anywhere_between_a_store_and_what_overwrites_it(
    between: list[str], begin: str, image: str, reader: str, at: int
) -> None:
    def blamed(commands: list[str]) -> bool:
        text = (
            f"images:\n  {image}\n  other: {{format: R8_UNORM, samples: 1}}\n  third: {{format: "
            f"R8_UNORM, samples: 1}}\ncommands:\n"
        )
        text += (
            "  - beginRendering: {colorAttachments: [{image: x, loadOp: CLEAR, storeOp: "
            "STORE}]}\n  - endRendering\n"
        )
        text += "".join(f"  - {command}\n" for command in commands)
        text += (
            f"  - beginRendering: {{colorAttachments: [{{image: x, loadOp: {begin}, storeOp: "
            f"STORE}}]}}\n  - endRendering\n"
        )
        text += "  - readImage: {image: x, stage: FRAGMENT}\n"
        return any(each.code == "MSAA208" for each in lint(text.replace("$", "$$")).findings)

    assert blamed(between)
    at %= len(between) + 1
    assert not blamed([*between[:at], reader, *between[at:]])


# Whole images and parts of them.


@pytest.mark.parametrize(
    ("image", "begin", "whole"),
    [
        (
            "extent: {width: 64, height: 64}",
            "renderArea: {x: 0, y: 0, width: 64, height: 64}",
            True,
        ),
        (
            "extent: {width: 64, height: 64}",
            "renderArea: {x: 0, y: 0, width: 32, height: 64}",
            False,
        ),
        (
            "extent: {width: 64, height: 64}",
            "renderArea: {x: 1, y: 0, width: 64, height: 64}",
            False,
        ),
        ("flags: []", "renderArea: {x: 0, y: 0, width: 64, height: 64}", False),
        ("arrayLayers: 2", "layerCount: 2", True),
        ("arrayLayers: 2", "layerCount: 1", False),
        ("arrayLayers: 2", "viewMask: 3", True),
        ("mipLevels: 2", "flags: []", False),
    ],
)
def test_what_is_overwritten_or_thrown_away_in_part_lives_on(
    image: str, begin: str, whole: bool
) -> None:
    linted = lint(
        """
    images:
      color: {format: R8G8B8A8_UNORM, samples: 1, $image}
      depth: {format: D16_UNORM, samples: 1, $image}
    commands:
      - beginRendering:
          colorAttachments: [{image: color, loadOp: CLEAR, storeOp: STORE}]
          depthAttachment: {image: depth, loadOp: CLEAR, storeOp: STORE}
      - endRendering
      - beginRendering:
          $begin
          colorAttachments: [{image: color, loadOp: CLEAR, storeOp: STORE}]
          depthAttachment: {image: depth, loadOp: LOAD, storeOp: DONT_CARE}
      - endRendering
      - readImage: {image: color, stage: FRAGMENT}
      - beginRendering: {depthAttachment: {image: depth, loadOp: LOAD, storeOp: STORE}}
      - endRendering
      - readImage: {image: depth, stage: FRAGMENT}
    """,
        image=image,
        begin=begin,
    )
    assert [(found.code, found.subject) for found in linted.findings if found.code in WATCHED] == (
        [
            ("MSAA208", "commands[0].beginRendering.colorAttachments[0]"),
            ("MSAA209", "commands[5].beginRendering.depthAttachment"),
        ]
        if whole
        else []
    )


def test_multisampled_stores_have_rules_of_their_own() -> None:
    linted = check("""
    images:
      color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT], presentable: false}
      both: {format: D24_UNORM_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT]}
    commands:
      - beginRendering:
          colorAttachments: [{image: color, loadOp: CLEAR, storeOp: STORE}]
          depthAttachment: {image: both, loadOp: CLEAR, storeOp: STORE}
          stencilAttachment: {image: both, loadOp: CLEAR, storeOp: STORE}
      - endRendering
    """)
    covering = {
        found.code
        for found in linted.findings
        if "covers stored-then-discarded (MSAA208) too" in found.notes
    }
    assert covering == {"MSAA201", "MSAA203", "MSAA204"}


# Clears by commands.

CLEARING = """
images:
  color: {format: R8G8B8A8_UNORM, samples: 1%(image)s}
renderPasses:
  scene:
    attachments:
      color: {image: color, loadOp: %(load)s, storeOp: STORE}
    subpasses:
      - {colorAttachments: [color]}
      - {colorAttachments: [color]}
commands:
%(commands)s
"""


def cleared(commands: list[str], load: str = "LOAD", image: str = "") -> list[tuple[str, str]]:
    text = CLEARING % {
        "load": load,
        "image": image,
        "commands": "\n".join(f"  - {command}" for command in commands),
    }
    return [
        (found.severity, found.message) for found in lint(text).findings if found.code == "MSAA211"
    ]


BEGIN = "beginRenderPass: {renderPass: scene, renderArea: {x: 0, y: 0, width: 64, height: 32}}"
CLEAR = (
    "clearAttachments: {attachments: [{aspect: COLOR, colorAttachment: 0}], rects: [{x: 0, y: "
    "0, width: 64, height: 32}]}"
)


@pytest.mark.parametrize(
    "commands",
    [
        [BEGIN, "draw: {vertexCount: 3}", CLEAR, "endRenderPass"],
        [BEGIN, "draw: {vertexCount: 3}", "nextSubpass", CLEAR, "endRenderPass"],
        [BEGIN, CLEAR.replace("x: 0", "x: 1"), "endRenderPass"],
        [BEGIN, CLEAR.replace("width: 64", "width: 63"), "endRenderPass"],
        [BEGIN, CLEAR.replace("colorAttachment: 0", "colorAttachment: 1"), "endRenderPass"],
        [BEGIN, CLEAR.replace("COLOR", "DEPTH"), "endRenderPass"],
        ["beginRenderPass: {renderPass: scene}", CLEAR, "endRenderPass"],
        [BEGIN, CLEAR, "endRenderPass", BEGIN, "draw: {vertexCount: 3}", "endRenderPass"],
        [CLEAR],
    ],
)
def test_a_clear_that_the_load_operation_cannot_do(commands: list[str]) -> None:
    assert cleared(commands) == []


# What nothing touches.

TOUCHED = """
images:
  color: {format: R8G8B8A8_UNORM, samples: 1}
  both: {format: D24_UNORM_S8_UINT, samples: 1}
pipelines:
  one: {rendering: {}, colorBlendState: {attachments: [%(blend)s]}, depthStencilState: {%(depth)s}%(more)s}
commands:
  - beginRendering:
      colorAttachments: [{image: color, loadOp: %(load)s, storeOp: %(store)s}]
      depthAttachment: {image: both, loadOp: %(load)s, storeOp: %(store)s}
      stencilAttachment: {image: both, loadOp: %(load)s, storeOp: %(store)s}
  - %(command)s
  - endRendering
  - readImage: {image: color, stage: FRAGMENT}
  - readImage: {image: both, stage: FRAGMENT}
"""
DRAW = "draw: {pipeline: one, vertexCount: 300}"
OFF = "depthTestEnable: false, depthBoundsTestEnable: false, stencilTestEnable: false"


# Passes over the whole picture.

SCREEN = """
images:
  scene: {format: R8G8B8A8_UNORM, samples: %(read)s}
  color: {format: R8G8B8A8_UNORM, samples: 4}
pipelines:
  screen:
    rendering: {}
    vertexInputState: {%(vertices)s}
    multisampleState: {rasterizationSamples: 4, sampleShadingEnable: %(shading)s, alphaToCoverageEnable: false%(more)s}
commands:
  - beginRendering: {flags: [%(flags)s], colorAttachments: [{image: color, loadOp: %(load)s, storeOp: STORE}]}
  - readImage: {image: scene, stage: FRAGMENT}
  - draw: {pipeline: screen, vertexCount: %(count)s, instanceCount: %(instances)s}
  - endRendering
%(after)s
"""
PLAIN = {
    "read": "1", "vertices": "", "shading": "false", "more": "", "flags": "", "load": "DONT_CARE",
    "count": "3", "instances": "1",
    "after": "",
}  # fmt: skip


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({}, True),
        ({"count": "6"}, True),
        ({"load": "CLEAR"}, True),
        ({"count": "4"}, False),
        ({"instances": "2"}, False),
        ({"load": "LOAD"}, False),
        ({"read": "4"}, False),
        ({"shading": "true"}, False),
        ({"more": ", sampleMask: [1]"}, False),
        ({"flags": "SUSPENDING"}, False),
        ({"vertices": "vertexBindingDescriptions: [{binding: 0, stride: 8}]"}, False),
        (
            {
                "after": "  - beginRendering: {colorAttachments: [{image: color, loadOp: LOAD, "
                "storeOp: STORE}]}\n  - endRendering"
            },
            False,
        ),
        (
            {
                "after": "  - beginRendering: {colorAttachments: [{image: color, loadOp: CLEAR, "
                "storeOp: STORE}]}\n  - endRendering"
            },
            True,
        ),
    ],
)
def test_a_pass_over_the_whole_picture(changed: dict[str, str], expected: bool) -> None:
    assert (
        "MSAA107" in {found.code for found in lint(SCREEN % {**PLAIN, **changed}).findings}
    ) is expected


# Prices: plain arithmetic, 1000 * 500 texels of 4 bytes at 60 frames a second.


def priced(text: str, code: str) -> tuple[float, float]:
    (found,) = [
        found
        for found in lint(
            "frame: {width: 1000, height: 500, fps: 60}\n" + textwrap.dedent(text)
        ).findings
        if found.code == code
    ]
    assert found.price is not None
    return found.price.read_mb_per_s, found.price.write_mb_per_s


PICTURE = 1000 * 500 * 4 * 60 / 1e6


def test_prices() -> None:
    stored = (
        "images: {d: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}}\n"
        "commands:\n"
    )
    stored += (
        "  - beginRendering: {depthAttachment: {image: d, loadOp: CLEAR, storeOp: STORE}}\n  "
        "- endRendering\n"
    )
    assert priced(stored, "MSAA208") == pytest.approx((0, PICTURE))
    loaded = stored.replace("CLEAR", "LOAD").replace("STORE}", "DONT_CARE}")
    assert priced(loaded, "MSAA209") == pytest.approx((PICTURE, 0))
    copied = (
        "images: {a: {format: R8G8B8A8_UNORM, samples: 1}, b: {format: R8G8B8A8_UNORM, "
        "samples: 1}}\ncommands:\n"
    )
    copied += "  - blitImage: {srcImage: a, dstImage: b}\n"
    copied += (
        "  - beginRendering: {colorAttachments: [{image: b, loadOp: LOAD, storeOp: STORE}]}\n"
        "  - endRendering\n"
    )
    assert priced(copied, "MSAA213") == pytest.approx((PICTURE, PICTURE))
    assert priced(
        copied.replace("blitImage: {srcImage: a, dstImage: b}", "clearColorImage: {image: b}"),
        "MSAA211",
    ) == pytest.approx((PICTURE, PICTURE))
    assert priced(TOUCHED % {"blend": "{colorWriteMask: [R]}",
    "depth": OFF.replace("stencilTestEnable: false", "stencilTestEnable: true"),
                             "more": "", "load": "LOAD", "store": "STORE", "command": DRAW},
                             "MSAA212") == pytest.approx(
        (PICTURE * 3 / 4, PICTURE * 3 / 4)
    )  # fmt: skip


def test_more_uses_than_are_followed_leave_all_unknown() -> None:
    attachments, begins = 750, 700
    text = (
        "images: {x: {format: D16_UNORM, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}}\n"
        "renderPasses:\n  scene:\n    attachments:\n"
    )
    text += "      - {image: x, loadOp: CLEAR, storeOp: STORE}\n" * attachments
    text += "    subpasses: [{depthStencilAttachment: 0}]\ncommands:\n"
    text += "  - beginRenderPass: {renderPass: scene}\n  - endRenderPass\n" * begins
    linted = ENGINE.lint(text.encode(), "frame.yaml", LintOptions(as_written))
    assert "renderPasses.scene.attachments[0]" in undecided(linted, "MSAA208")
