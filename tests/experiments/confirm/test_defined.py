"""What images hold, step by step: only what the description defines is shown and compared."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.experiments.confirm.defined_contents import Contents
from msaa_lint.experiments.confirm.parts import COLOR, DEPTH, STENCIL, Image, Plan, Step
from tests.experiments.confirm.frames import planned

ASPECTS = {COLOR: "", DEPTH: ":depth", STENCIL: ":stencil"}


def followed(made: Plan) -> Contents:
    """What a plan's images hold after all its steps."""
    contents = Contents(made)
    for step in made.steps:
        if step.kind == "begin":
            contents.begin(made.passes[step.number], step)
        else:
            contents.transfer(step)
    return contents


def outputs(text: str, **arguments: Any) -> list[str]:
    """The outputs of a description: `image`, `image:depth`, `image:stencil`."""
    made = planned(text, **arguments)
    assert not any(each.refused for each in made.passes)
    return [
        made.images[number].name + ASPECTS[aspect] for number, aspect in followed(made).outputs()
    ]


def inline(**changes: str) -> str:
    """A pass that resolves inline; `changes` take the place of its parts."""
    own = {
        "size": "frame: {width: 64, height: 32}", "ms": "", "o": "", "color": "loadOp: CLEAR, "
            "storeOp: DONT_CARE",
        "target": "loadOp: DONT_CARE, storeOp: STORE", "resolve": "resolveAttachments: [o]",
        "rest": "",
    }  # fmt: skip
    assert set(changes) <= set(own)
    own.update(changes)
    return f"""\
{own["size"]}
images:
  ms: {{format: R8G8B8A8_UNORM, samples: 4, {own["ms"]}}}
  o: {{format: R8G8B8A8_UNORM, samples: 1, {own["o"]}}}
renderPasses:
  p:
    attachments: {{c: {{image: ms, {own["color"]}}}, o: {{image: o, {own["target"]}}}}}
    subpasses: [{{colorAttachments: [c], {own["resolve"]}}}]
{own["rest"]}
"""


def plain(
    color: str = "loadOp: CLEAR, storeOp: STORE", image: str = "samples: 1", rest: str = ""
) -> str:
    """A pass that draws to one image."""
    return f"""\
frame: {{width: 64, height: 32}}
images: {{o: {{format: R8G8B8A8_UNORM, {image}}}, t: {{format: R8G8B8A8_UNORM, samples: 1}}}}
renderPasses:
  p: {{attachments: {{c: {{image: o, {color}}}}}, subpasses: [{{colorAttachments: [c]}}]}}
{rest}
"""


def commands(*each: str) -> str:
    """The commands of a frame; `begin` stands for the whole of pass p."""
    begin = ["{beginRenderPass: {renderPass: p}}", "endRenderPass"]
    return (
        "commands: "
        f"[{', '.join(word for one in each for word in (begin if one == 'begin' else [one]))}]\n"
    )


def begin(area: str = "") -> str:
    return f"{{beginRenderPass: {{renderPass: p{area}}}}}, endRenderPass"


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, ["o"]),
        ({"target": "loadOp: DONT_CARE, storeOp: DONT_CARE"}, []),
        ({"target": "loadOp: DONT_CARE, storeOp: NONE"}, []),
        ({"target": "loadOp: CLEAR, storeOp: STORE"}, ["o"]),
        # What is read from the multisampled image was never written to it.
        ({"color": "loadOp: LOAD, storeOp: DONT_CARE"}, []),
        ({"color": "loadOp: LOAD, storeOp: STORE, initialLayout: UNDEFINED"}, []),
        # The backdrop covers every pixel, but not with these.
        ({"color": "loadOp: DONT_CARE, storeOp: DONT_CARE"}, ["o"]),
        (
            {
                "color": "loadOp: DONT_CARE, storeOp: DONT_CARE",
                "rest": "pipelines: {x: {renderPass: p, multisampleState: {sampleMask: [1]}}}",
            },
            [],
        ),
        (
            {
                "color": "loadOp: DONT_CARE, storeOp: DONT_CARE",
                "rest": "pipelines: {x: {renderPass: p, colorBlendState: {attachments: "
                "[{blendEnable: true}]}}}",
            },
            [],
        ),
        # Nothing resolves: the target is what it was before.
        ({"resolve": "resolveAttachments: [null]"}, []),
        ({"resolve": ""}, []),
        # Attachments of several layers and levels are drawn to in part.
        ({"o": "arrayLayers: 2"}, []),
        ({"o": "mipLevels: 2"}, []),
        ({"o": "extent: {width: 128, height: 32}"}, []),
        (
            {
                "ms": "usage: COLOR_ATTACHMENT | TRANSIENT_ATTACHMENT",
                "o": "usage: COLOR_ATTACHMENT | SAMPLED",
            },
            ["o"],
        ),
    ],
)
def test_an_inline_resolve_gives_what_is_drawn(
    changes: Mapping[str, str], expected: list[str]
) -> None:
    assert outputs(inline(**changes)) == expected


@pytest.mark.parametrize(
    ("image", "color", "expected"),
    [
        ("samples: 1", "loadOp: CLEAR, storeOp: STORE", ["o"]),
        ("samples: 4", "loadOp: CLEAR, storeOp: STORE", []),
        ("samples: 1", "loadOp: CLEAR, storeOp: DONT_CARE", []),
        ("samples: 1", "loadOp: CLEAR, storeOp: NONE", []),
        ("samples: 1", "loadOp: LOAD, storeOp: STORE", []),
        ("samples: 1", "loadOp: DONT_CARE, storeOp: STORE", ["o"]),
        ("samples: 1, usage: COLOR_ATTACHMENT | TRANSIENT_ATTACHMENT", "loadOp: CLEAR", []),
        ("samples: 1, mipLevels: 2", "loadOp: CLEAR, storeOp: STORE", []),
        ("samples: 1, arrayLayers: 2", "loadOp: CLEAR, storeOp: STORE", []),
        ("samples: 1, extent: {width: 64, height: 33}", "loadOp: CLEAR, storeOp: STORE", ["o"]),
    ],
)
def test_a_pass_gives_what_it_stores(image: str, color: str, expected: list[str]) -> None:
    assert outputs(plain(color, image)) == expected


@pytest.mark.parametrize(
    ("area", "expected"),
    [("", ["o"]), (", renderArea: {x: 0, y: 0, width: 64, height: 32}", ["o"]), (", renderArea: "
        "{width: 100, height: 100}", ["o"]),
     (", renderArea: {x: 1, y: 0, width: 63, height: 32}", []), (", renderArea: {x: 0, y: 0, "
         "width: 64, height: 31}", [])],
)  # fmt: skip
@pytest.mark.parametrize("load", ["CLEAR", "DONT_CARE"])
def test_an_area_that_is_not_whole_leaves_the_rest(
    load: str, area: str, expected: list[str]
) -> None:
    extent = "extent: {width: 64, height: 32}"
    assert (
        outputs(
            plain(
                f"loadOp: {load}, storeOp: STORE",
                f"samples: 1, {extent}",
                f"commands: [{begin(area)}]",
            )
        )
        == expected
    )
    color = f"loadOp: {load}, storeOp: DONT_CARE"
    assert (
        outputs(inline(ms=extent, o=extent, color=color, rest=f"commands: [{begin(area)}]"))
        == expected
    )


@pytest.mark.parametrize(
    ("initial", "load", "expected"),
    [
        ("COLOR_ATTACHMENT_OPTIMAL", "LOAD", ["o"]),
        ("COLOR_ATTACHMENT_OPTIMAL", "CLEAR", ["o"]),
        ("COLOR_ATTACHMENT_OPTIMAL", "DONT_CARE", []),
        ("UNDEFINED", "LOAD", []),
        ("UNDEFINED", "CLEAR", []),
    ],
)
def test_a_part_of_what_was_there_before_is_defined_where_it_is_kept(
    initial: str, load: str, expected: list[str]
) -> None:
    area = ", renderArea: {width: 8, height: 8}"
    color = f"loadOp: {load}, storeOp: STORE, initialLayout: {initial}"
    assert (
        outputs(plain(color, rest=f"commands: [{{clearColorImage: {{image: o}}}}, {begin(area)}]"))
        == expected
    )
    assert outputs(plain(color, rest=f"commands: [{begin(area)}]")) == []


def test_one_draw_that_covers_is_enough() -> None:
    pipelines = (
        "pipelines: {x: {renderPass: p}, y: {renderPass: p, colorBlendState: {attachments: "
        "[{blendEnable: true}]}}}"
    )
    assert outputs(plain("loadOp: DONT_CARE, storeOp: STORE", rest=pipelines)) == ["o"]
    assert (
        outputs(
            plain(
                "loadOp: DONT_CARE, storeOp: STORE",
                rest=pipelines.replace("x: {renderPass: p}, ", ""),
            )
        )
        == []
    )


def test_a_later_pass_takes_back_what_it_leaves_undefined() -> None:
    text = """\
images: {o: {format: R8G8B8A8_UNORM, samples: 1}}
renderPasses:
  first: {attachments: {c: {image: o, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [c]}]}
  second: {attachments: {c: {image: o, loadOp: LOAD, storeOp: OP}}, subpasses: [{colorAttachments: [c]}]}
"""
    assert outputs(text.replace("OP}", "STORE}")) == ["o"]
    assert outputs(text.replace("OP}", "DONT_CARE}")) == []
    unused = text.replace("OP}", "STORE}").replace(
        "{colorAttachments: [c]}]}", "{colorAttachments: [null]}]}"
    )
    assert outputs(unused) == []


# Depth and stencil


def depth(
    attachment: str, format: str = "D24_UNORM_S8_UINT", samples: int = 1, rest: str = ""
) -> str:
    return f"""\
frame: {{width: 64, height: 32}}
images: {{d: {{format: {format}, samples: {samples}}}, r: {{format: {format}, samples: 1}}}}
renderPasses:
  p:
    attachments:
      d: {{image: d, {attachment}}}
      r: {{image: r, loadOp: DONT_CARE, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE}}
    subpasses: [{{depthStencilAttachment: d, {rest}}}]
"""


@pytest.mark.parametrize(
    ("operations", "expected"),
    [
        (
            "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE",
            ["d:depth", "d:stencil"],
        ),
        (
            "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE",
            ["d:depth"],
        ),
        (
            "loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE",
            ["d:depth"],
        ),
        (
            "loadOp: DONT_CARE, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE",
            ["d:stencil"],
        ),
        (
            "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: STORE",
            ["d:stencil"],
        ),
        ("loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: STORE", []),
    ],
)
def test_depth_and_stencil_are_apart(operations: str, expected: list[str]) -> None:
    assert outputs(depth(operations)) == expected


def test_an_image_is_whole_with_all_of_its_aspects() -> None:
    contents = followed(
        planned(
            depth("loadOp: CLEAR, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE")
        )
    )
    assert not contents.whole(0)
    assert contents.whole(0, DEPTH) and not contents.whole(0, STENCIL)
    assert followed(
        planned(depth("loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE"))
    ).whole(0)


@pytest.mark.parametrize(
    ("modes", "expected"),
    [
        (
            "depthResolveMode: SAMPLE_ZERO, stencilResolveMode: SAMPLE_ZERO",
            ["r:depth", "r:stencil"],
        ),
        ("depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE", ["r:depth"]),
        ("depthResolveMode: NONE, stencilResolveMode: MAX", ["r:stencil"]),
        ("depthResolveMode: NONE, stencilResolveMode: NONE", []),
    ],
)
def test_a_depth_resolve_gives_the_aspects_that_it_resolves(
    modes: str, expected: list[str]
) -> None:
    operations = (
        "loadOp: CLEAR, storeOp: DONT_CARE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE"
    )
    rest = f"depthStencilResolve: {{attachment: r, {modes}}}"
    assert outputs(depth(operations, samples=4, rest=rest)) == expected
    assert outputs(depth(operations.replace("CLEAR", "DONT_CARE"), samples=4, rest=rest)) == []


@pytest.mark.parametrize(
    ("initial", "expected"),
    [
        ("initialLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL", ["d:depth", "d:stencil"]),
        ("initialLayout: UNDEFINED", []),
        (
            "initialLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL, stencilInitialLayout: UNDEFINED",
            ["d:depth"],
        ),
        (
            "initialLayout: UNDEFINED, stencilInitialLayout: STENCIL_ATTACHMENT_OPTIMAL",
            ["d:stencil"],
        ),
    ],
)
def test_stencil_has_a_layout_of_its_own(initial: str, expected: list[str]) -> None:
    operations = "loadOp: LOAD, storeOp: STORE, stencilLoadOp: LOAD, stencilStoreOp: STORE"
    cleared = (
        "commands: [{clearDepthStencilImage: {image: d}}, {beginRenderPass: {renderPass: "
        "p}}, endRenderPass]\n"
    )
    assert outputs(depth(f"{operations}, {initial}") + cleared) == expected
    assert outputs(depth(f"{operations}, {initial}")) == []


def test_only_several_samples_are_resolved_and_only_to_one() -> None:
    one = inline().replace("samples: 4", "samples: 1")
    assert outputs(one.replace("storeOp: DONT_CARE", "storeOp: STORE")) == ["ms"]
    many = inline().replace("samples: 1", "samples: 4")
    assert outputs(many) == []
    rendered = rendering(color="loadOp: CLEAR, storeOp: STORE")
    assert outputs(rendered.replace("samples: 4", "samples: 1")) == ["ms"]


TESTED = """\
frame: {width: 64, height: 32}
images:
  o: {format: R8G8B8A8_UNORM, samples: 1}
  d: {format: D32_SFLOAT, samples: 1}
renderPasses:
  p:
    attachments: {c: {image: o, loadOp: CLEAR, storeOp: STORE}, d: {image: d, loadOp: LOAD_OP, storeOp: DONT_CARE}}
    subpasses: [{colorAttachments: [c], depthStencilAttachment: d}]
pipelines: {x: {renderPass: p, depthStencilState: {depthTestEnable: TEST, depthCompareOp: COMPARE}}}
"""


@pytest.mark.parametrize(
    ("load", "test", "compare", "expected"),
    [
        ("CLEAR", "true", "LESS", ["o"]),
        ("DONT_CARE", "true", "LESS", []),
        ("LOAD", "true", "LESS_OR_EQUAL", []),
        ("DONT_CARE", "false", "LESS", ["o"]),
        ("DONT_CARE", "true", "ALWAYS", ["o"]),
        ("DONT_CARE", "true", "NEVER", ["o"]),
    ],
)
def test_what_is_tested_against_undefined_depth_is_undefined(
    load: str, test: str, compare: str, expected: list[str]
) -> None:
    assert (
        outputs(TESTED.replace("LOAD_OP", load).replace("TEST", test).replace("COMPARE", compare))
        == expected
    )


def test_depth_that_an_earlier_pass_left_is_tested_against() -> None:
    before = """\
renderPasses:
  before: {attachments: {d: {image: d, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{depthStencilAttachment: d}]}
"""
    text = TESTED.replace("LOAD_OP", "LOAD").replace("TEST", "true").replace("COMPARE", "LESS")
    assert outputs(text.replace("renderPasses:\n", before)) == ["o"]
    assert (
        outputs(
            text.replace("renderPasses:\n", before.replace("storeOp: STORE", "storeOp: DONT_CARE"))
        )
        == []
    )


# Layers and views


def layered(load: str, views: int, layers: int) -> str:
    return f"""\
frame: {{width: 64, height: 32}}
images: {{o: {{format: R8G8B8A8_UNORM, samples: 1, arrayLayers: 2}}}}
renderPasses:
  p: {{attachments: {{c: {{image: o, loadOp: {load}, storeOp: STORE}}}}, subpasses: [{{colorAttachments: [c], viewMask: {views}}}]}}
framebuffers: {{f: {{renderPass: p, attachments: [o], layers: {layers}}}}}
"""


@pytest.mark.parametrize(
    ("load", "views", "layers", "expected"),
    [
        ("CLEAR", 3, 1, ["o"]),
        ("CLEAR", 1, 1, []),
        ("CLEAR", 2, 1, []),
        ("CLEAR", 0, 2, ["o"]),
        ("CLEAR", 0, 1, []),
        ("DONT_CARE", 3, 1, ["o"]),
        # Every view is drawn to, but of layers only the first.
        ("DONT_CARE", 0, 2, []),
    ],
)
def test_layers_are_defined_where_all_of_them_are(
    load: str, views: int, layers: int, expected: list[str]
) -> None:
    assert outputs(layered(load, views, layers)) == expected


# Dynamic rendering


def rendering(
    flags: str = "",
    color: str = "loadOp: CLEAR, storeOp: DONT_CARE",
    area: str = "",
    then: str = "",
) -> str:
    return f"""\
frame: {{width: 64, height: 32}}
images: {{ms: {{format: R8G8B8A8_UNORM, samples: 4}}, o: {{format: R8G8B8A8_UNORM, samples: 1}}}}
commands:
  - beginRendering: {{flags: [{flags}], {area} colorAttachments: [{{image: ms, resolveImage: o, resolveMode: AVERAGE, {color}}}]}}
  - endRendering
{then}
"""


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ({}, ["o"]),
        ({"color": "loadOp: DONT_CARE, storeOp: DONT_CARE"}, ["o"]),
        ({"color": "loadOp: LOAD, storeOp: STORE"}, []),
        ({"area": "renderArea: {width: 63, height: 32},"}, []),
        ({"flags": "SUSPENDING"}, []),
        ({"color": "loadOp: CLEAR, storeOp: STORE, imageLayout: GENERAL"}, ["o"]),
    ],
)
def test_a_rendering_gives_what_it_resolves(arguments: dict[str, str], expected: list[str]) -> None:
    assert outputs(rendering(**arguments)) == expected


def test_what_is_suspended_is_there_when_it_is_resumed() -> None:
    again = rendering("FLAGS")
    again = again[again.index("  - begin") :].rstrip() + "\n"
    resumed, both = (
        again.replace("FLAGS", "RESUMING"),
        again.replace("FLAGS", "RESUMING, SUSPENDING"),
    )
    assert outputs(rendering("SUSPENDING", then=resumed)) == ["o"]
    assert outputs(rendering("SUSPENDING", then=both)) == []
    assert outputs(rendering("SUSPENDING", then=both + resumed)) == ["o"]


def test_a_rendering_that_suspends_stores_nothing_yet() -> None:
    text = """\
frame: {width: 64, height: 32}
images: {o: {format: R8G8B8A8_UNORM, samples: 1}}
commands:
  - beginRendering: {flags: [SUSPENDING], colorAttachments: [{image: o, loadOp: CLEAR, storeOp: STORE}]}
  - endRendering
"""
    resumed = text[text.index("  - begin") :].replace("SUSPENDING", "RESUMING")
    assert outputs(text + resumed) == ["o"]
    assert outputs(text + resumed.replace("storeOp: STORE", "storeOp: DONT_CARE")) == []
    assert outputs(text) == []


@pytest.mark.parametrize(
    ("load", "expected"), [("LOAD", ["o"]), ("CLEAR", ["o"]), ("DONT_CARE", [])]
)
def test_a_rendering_keeps_what_it_loads(load: str, expected: list[str]) -> None:
    text = f"""\
frame: {{width: 64, height: 32}}
images: {{o: {{format: R8G8B8A8_UNORM, samples: 1, extent: {{width: 64, height: 32}}}}}}
commands:
  - clearColorImage: {{image: o}}
  - beginRendering: {{renderArea: {{width: 8, height: 8}}, colorAttachments: [{{image: o, loadOp: {load}, storeOp: STORE}}]}}
  - endRendering
"""
    assert outputs(text) == expected
    assert outputs(text.replace("  - clearColorImage: {image: o}\n", "")) == []


def test_a_rendering_that_resolves_by_no_mode_resolves_nothing() -> None:
    assert outputs(rendering().replace("resolveMode: AVERAGE", "resolveMode: NONE")) == []


def test_a_rendering_stores_what_it_says() -> None:
    one = (
        rendering(color="loadOp: CLEAR, storeOp: STORE")
        .replace("samples: 4", "samples: 1")
        .replace("resolveImage: o, resolveMode: AVERAGE, ", "")
    )
    assert outputs(one) == ["ms"]
    assert outputs(one.replace("storeOp: STORE", "storeOp: DONT_CARE")) == []
    assert outputs(one.replace("storeOp: STORE", "storeOp: NONE")) == []


# Commands outside of passes


@pytest.mark.parametrize(
    ("each", "expected"),
    [
        (["{clearColorImage: {image: o}}"], ["o"]),
        (["{copyImage: {srcImage: o, dstImage: t}}"], []),
        (["begin", "{copyImage: {srcImage: o, dstImage: t}}"], ["o", "t"]),
        (["begin", "{blitImage: {srcImage: o, dstImage: t}}"], ["o", "t"]),
        (["{copyImage: {srcImage: o, dstImage: t}}", "begin"], ["o"]),
        (["begin", "{copyImage: {srcImage: t, dstImage: o}}"], []),
        (["begin", "{copyBufferToImage: {dstImage: o}}"], []),
        (
            [
                "begin",
                "{copyImageToBuffer: {srcImage: o}}",
                "{present: {image: o}}",
                "{pipelineBarrier: {images: [o]}}",
            ],
            ["o"],
        ),
        (
            [
                "begin",
                "{blitImage: {srcImage: o, dstImage: t}}",
                "{blitImage: {srcImage: t, dstImage: o}}",
            ],
            ["o", "t"],
        ),
    ],
)
def test_commands_carry_what_is_defined(each: list[str], expected: list[str]) -> None:
    assert outputs(plain(rest=commands(*each))) == expected


def test_a_resolve_command_gives_what_is_stored() -> None:
    resolve = commands("begin", "{resolveImage: {srcImage: o, dstImage: t}}")
    assert outputs(plain(image="samples: 4", rest=resolve)) == ["t"]
    assert outputs(plain("loadOp: CLEAR, storeOp: DONT_CARE", "samples: 4", resolve)) == []
    assert outputs(plain(image="samples: 4", rest=resolve), samples=1) == ["t"]


@pytest.mark.parametrize(
    ("size", "kind", "expected"),
    [
        ("extent: {width: 32, height: 32}", "copyImage", ["o"]),
        ("extent: {width: 32, height: 32}", "blitImage", ["o", "t"]),
        ("mipLevels: 2", "copyImage", ["o"]),
        ("arrayLayers: 2", "blitImage", ["o"]),
    ],
)
def test_a_part_of_an_image_is_no_image(size: str, kind: str, expected: list[str]) -> None:
    text = plain(rest=commands("begin", f"{{{kind}: {{srcImage: o, dstImage: t}}}}"))
    assert (
        outputs(
            text.replace("t: {format: R8G8B8A8_UNORM,", f"t: {{format: R8G8B8A8_UNORM, {size},")
        )
        == expected
    )


# What a shader reads


READ = """\
frame: {width: 64, height: 32}
images: {a: {format: FORMAT, samples: SAMPLES, USAGE}, o: {format: R8G8B8A8_UNORM, samples: 1}}
renderPasses:
  p: {attachments: {o: {image: o, loadOp: DONT_CARE, storeOp: STORE}}, subpasses: [{colorAttachments: [o]}]}
commands:
  - COMMAND: {image: a}
  - beginRenderPass: {renderPass: p}
  - readImage: {image: a}
  - endRenderPass
"""


@pytest.mark.parametrize(
    ("format", "samples", "usage", "command", "expected"),
    [
        ("R8G8B8A8_UNORM", 1, "", "clearColorImage", ["a", "o"]),
        ("R8G8B8A8_UNORM", 4, "", "clearColorImage", ["o"]),
        ("D32_SFLOAT", 1, "", "clearDepthStencilImage", ["a:depth", "o"]),
        ("R8G8B8A8_UNORM", 1, "", "present", []),
        ("R8G8B8A8_UNORM", 1, "usage: TRANSFER_DST", "clearColorImage", ["a"]),
        (
            "R8G8B8A8_UNORM",
            1,
            "usage: TRANSFER_DST | SAMPLED | TRANSIENT_ATTACHMENT",
            "clearColorImage",
            ["a"],
        ),
        ("R32_UINT", 1, "", "clearColorImage", ["a"]),
        ("R32_SINT", 4, "", "clearColorImage", []),
        ("S8_UINT", 1, "", "clearDepthStencilImage", ["a:stencil"]),
        ("R8G8B8A8_UNORM", 1, "imageType: 1D", "clearColorImage", ["a"]),
    ],
)
def test_what_is_read_is_put_on_every_pixel(
    format: str, samples: int, usage: str, command: str, expected: list[str]
) -> None:
    text = (
        READ.replace("FORMAT", format)
        .replace("SAMPLES", str(samples))
        .replace("USAGE", usage)
        .replace("COMMAND", command)
    )
    assert outputs(text) == expected
    made = planned(text)
    (step,) = [step for step in made.steps if step.kind == "begin"]
    contents = Contents(made)
    for each in made.steps[: made.steps.index(step)]:
        contents.transfer(each)
    assert contents.reads(step) == ([0] if "o" in expected else [])


# Laws


def image(samples: int, aspects: int) -> Image:
    return Image(
        "i",
        37,
        samples,
        0x10,
        8,
        8,
        1,
        1,
        1,
        1,
        0,
        0,
        False,
        aspects,
        "UNORM" if aspects == COLOR else "",
    )


KINDS = st.sampled_from(
    ["resolve", "copy", "blit", "clear", "copyIn", "copyOut", "present", "barrier"]
)


@given(
    st.lists(
        st.builds(
            image,
            st.sampled_from([1, 4]),
            st.sampled_from([COLOR, DEPTH, DEPTH | STENCIL, STENCIL]),
        ),
        min_size=2,
        max_size=5,
    ),
    st.lists(st.tuples(KINDS, st.integers(0, 99), st.integers(0, 99)), max_size=12),
)
def test_what_commands_define_comes_from_a_clear(
    images: list[Image], chosen: list[tuple[str, int, int]]
) -> None:
    steps = tuple(
        Step(kind, 0, source=a % len(images), target=b % len(images)) for kind, a, b in chosen
    )
    contents = followed(Plan("f", tuple(images), steps=steps))
    found = contents.outputs()
    assert all(
        images[number].samples == 1 and images[number].aspects & aspect for number, aspect in found
    )
    assert found == sorted(set(found))
    for number, aspect in found:
        assert whence(images, steps, number, aspect), "what an output holds was cleared once"
    assert all(
        contents.whole(number)
        == all((number, a) in contents.known for a in ASPECTS if each.aspects & a)
        for number, each in enumerate(images)
    )


def whence(images: list[Image], steps: tuple[Step, ...], number: int, aspect: int) -> bool:
    """Whether what an aspect holds in the end goes back to a clear, by the last command that wrote
    it.
    """
    for at in range(len(steps) - 1, -1, -1):
        step = steps[at]
        if step.target != number or step.kind in ("copyOut", "present", "barrier"):
            continue
        if step.kind == "clear":
            return True
        carries = step.kind in ("resolve", "copy", "blit") and images[step.source].aspects & aspect
        if carries:
            return whence(images, steps[:at], step.source, aspect)
        if step.kind == "copyIn":
            return False
    return False


@pytest.mark.parametrize(
    ("changes", "expected"),
    [({}, ["o"]), ({"target": "loadOp: DONT_CARE, storeOp: DONT_CARE"}, ["o"]),
    ({"color": "loadOp: LOAD, storeOp: DONT_CARE"}, []),
     ({"color": "loadOp: CLEAR, storeOp: STORE", "resolve": ""}, ["ms"])],
)  # fmt: skip
def test_one_sample_gives_what_is_drawn_to_directly(
    changes: Mapping[str, str], expected: list[str]
) -> None:
    assert outputs(inline(**changes), samples=1) == expected


def test_an_empty_plan_gives_nothing() -> None:
    assert Contents(Plan()).outputs() == []
    made = planned("images: {a: {format: D24_UNORM_S8_UINT, samples: 1}}\n")
    assert followed(made).outputs() == []
    assert not Contents(made).whole(0) and not Contents(made).readable(0)
