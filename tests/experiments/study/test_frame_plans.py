"""A frame's own passes under every technique: what is created for each, and that the validation
layer finds nothing wrong with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from msaa_lint.experiments.confirm import gate
from msaa_lint.experiments.confirm.inputs import inputs
from msaa_lint.experiments.confirm.parts import NONE, Image, Pass, Plan
from msaa_lint.experiments.confirm.session import Session, environment
from msaa_lint.experiments.study.frame_plans import FramePlans
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, SSAA, Technique
from msaa_lint.linter.request import Request
from tests.experiments.confirm.frames import frame
from tests.paths import ROOT

SIZE = (96, 64)
ONE, FOUR, EIGHT = Technique(MSAA, 1), Technique(MSAA, 4), Technique(MSAA, 8)
HALF, LARGER = Technique(SAMPLE_SHADING, 4, 0.5), Technique(SSAA, 4, grid=2)
ON_LAVAPIPE = (ONE, FOUR, HALF, LARGER)

FORWARD = """\
frame: {width: 96, height: 64}
images:
  shadow: {format: D32_SFLOAT, samples: 1, extent: {width: 128, height: 128}, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
  hdr: {format: R16G16B16A16_SFLOAT, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
  depth: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
  picture: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC], presentable: true}
pipelines:
  caster: {renderPass: shadows, depthStencilState: {depthTestEnable: true, depthWriteEnable: true, depthCompareOp: LESS}}
  opaque: {renderPass: scene, depthStencilState: {depthTestEnable: true, depthWriteEnable: true, depthCompareOp: LESS}}
  smoke:
    renderPass: particles
    depthStencilState: {depthTestEnable: true, depthWriteEnable: false, depthCompareOp: LESS}
    colorBlendState: {attachments: [{blendEnable: true}]}
  widgets: {renderPass: ui, colorBlendState: {attachments: [{blendEnable: true}]}}
renderPasses:
  shadows:
    attachments: {d: {image: shadow, loadOp: CLEAR, storeOp: STORE, finalLayout: DEPTH_STENCIL_READ_ONLY_OPTIMAL}}
    subpasses: [{depthStencilAttachment: d}]
  scene:
    attachments:
      c: {image: hdr, loadOp: CLEAR, storeOp: STORE, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      d: {image: depth, loadOp: CLEAR, storeOp: STORE, finalLayout: DEPTH_STENCIL_ATTACHMENT_OPTIMAL}
    subpasses: [{colorAttachments: [c], depthStencilAttachment: d}]
  particles:
    attachments:
      c: {image: hdr, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: SHADER_READ_ONLY_OPTIMAL}
      d: {image: depth, loadOp: LOAD, storeOp: DONT_CARE}
    subpasses: [{colorAttachments: [c], depthStencilAttachment: d}]
  tone_map:
    attachments: {c: {image: picture, loadOp: DONT_CARE, storeOp: STORE, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
    subpasses: [{colorAttachments: [c]}]
  ui:
    attachments: {c: {image: picture, loadOp: LOAD, storeOp: STORE, initialLayout: COLOR_ATTACHMENT_OPTIMAL, finalLayout: PRESENT_SRC_KHR}}
    subpasses: [{colorAttachments: [c]}]
commands:
  - beginRenderPass: {renderPass: shadows}
  - draw: {pipeline: caster, vertexCount: 3000}
  - endRenderPass
  - beginRenderPass: {renderPass: scene}
  - readImage: {image: shadow, stage: FRAGMENT}
  - draw: {pipeline: opaque, vertexCount: 3000, drawCount: 3}
  - endRenderPass
  - beginRenderPass: {renderPass: particles}
  - draw: {pipeline: smoke, vertexCount: 600, instanceCount: 2}
  - endRenderPass
  - beginRenderPass: {renderPass: tone_map}
  - readImage: {image: hdr, stage: FRAGMENT}
  - endRenderPass
  - beginRenderPass: {renderPass: ui}
  - draw: {pipeline: widgets, vertexCount: 90}
  - endRenderPass
  - present: {image: picture}
"""

RENDERING = """\
frame: {width: 96, height: 64}
images:
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED]}
  ids: {format: R32_UINT, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC]}
  depth: {format: D24_UNORM_S8_UINT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
  picture: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
commands:
  - beginRendering:
      colorAttachments: [{image: color, loadOp: CLEAR, storeOp: STORE}, {image: ids, loadOp: CLEAR, storeOp: STORE}]
      depthAttachment: {image: depth, loadOp: CLEAR, storeOp: STORE}
      stencilAttachment: {image: depth, loadOp: CLEAR, storeOp: DONT_CARE}
  - draw: {vertexCount: 300}
  - endRendering
  - beginRendering: {colorAttachments: [{image: picture, loadOp: DONT_CARE, storeOp: STORE}]}
  - readImage: {image: color, stage: FRAGMENT}
  - readImage: {image: depth, stage: FRAGMENT}
  - endRendering
"""


def plans(text: str) -> FramePlans:
    return FramePlans(frame(text), "frame.msaa.yaml", SIZE)


def named(plan: Plan, name: str) -> Pass:
    (found,) = [each for each in plan.passes if each.name == name]
    return found


def attached(plan: Plan, name: str) -> list[tuple[str, int]]:
    images = [plan.images[number] for number in named(plan, name).framebuffers[0].images]
    return [(image.name, image.samples) for image in images]


def image(plan: Plan, name: str) -> Image:
    (found,) = [each for each in plan.images if each.name == name]
    return found


def blits(plan: Plan) -> list[tuple[str, str]]:
    return [
        (plan.images[step.source].name, plan.images[step.target].name)
        for step in plan.steps
        if step.kind == "blit"
    ]


def test_geometry_gets_samples_and_the_rest_stays() -> None:
    """The scene and the particles share multisampled attachments, and the particles resolve them;
    shadows, tone mapping, and the user interface are as described.
    """
    studied = plans(FORWARD)
    assert [studied.base.passes[number].name for number in sorted(studied.passes)] == [
        "scene",
        "particles",
    ]
    assert "the techniques apply to scene, particles" in studied.notes
    plan = studied.of(FOUR).plan
    assert attached(plan, "scene") == [("hdr 4x", 4), ("depth 4x", 4)]
    assert attached(plan, "particles") == [("hdr 4x", 4), ("depth 4x", 4), ("hdr", 1)]
    assert attached(plan, "shadows") == [("shadow", 1)]
    assert attached(plan, "ui") == [("picture", 1)]
    assert {
        pipeline.samples
        for name in ("scene", "particles")
        for pipeline in named(plan, name).pipelines
    } == {4}
    scene, particles = named(plan, "scene"), named(plan, "particles")
    assert [attachment.store for attachment in scene.attachments] == [0, 0]
    assert scene.subpasses[0].resolves == ()
    assert [attachment.store for attachment in particles.attachments] == [1, 1, 0]
    assert [reference.attachment for reference in particles.subpasses[0].resolves] == [2]
    assert studied.of(ONE).plan.images == studied.base.images


def test_every_technique_draws_the_same_triangles() -> None:
    studied = plans(FORWARD)

    def meshes(technique: Technique) -> list[object]:
        return [
            inner.mesh
            for step in studied.of(technique).plan.steps
            for inner in step.inner
            if inner.kind == "draw"
        ]

    assert all(mesh for mesh in meshes(ONE))
    assert meshes(ONE) == meshes(FOUR) == meshes(EIGHT) == meshes(HALF) == meshes(LARGER)


def test_what_is_read_afterward_is_resolved() -> None:
    plan = plans(RENDERING).of(EIGHT).plan
    color, ids, depth, stencil = plan.passes[0].rendered
    assert [(plan.images[each.image].name, each.mode) for each in (color, ids)] == [
        ("color 8x", 2),
        ("ids 8x", 1),
    ]
    assert [plan.images[each.resolve_image].name for each in (color, ids, depth, stencil)] == [
        "color",
        "ids",
        "depth",
        "depth",
    ]
    assert depth.mode == stencil.mode == 1
    assert plan.passes[1].rendered == plans(RENDERING).base.passes[1].rendered


def test_larger_images_are_scaled_down_where_they_are_used() -> None:
    plan = plans(FORWARD).of(LARGER).plan
    assert (
        attached(plan, "scene") == attached(plan, "particles") == [("hdr 2x2", 1), ("depth 2x2", 1)]
    )
    assert (image(plan, "hdr 2x2").width, image(plan, "hdr 2x2").height) == (192, 128)
    assert (
        named(plan, "scene").framebuffers[0].width,
        named(plan, "tone_map").framebuffers[0].width,
    ) == (192, 96)
    assert blits(plan) == [("hdr 2x2", "hdr")]
    assert next(step.area for step in plan.steps if step.number == 1) == (0, 0, 192, 128)


def test_sample_shading_is_on_the_pipelines_of_the_technique() -> None:
    text = FORWARD.replace("frame: {", "enabled: {features: [samplerAnisotropy]}\nframe: {")
    plain, shaded = plans(text).of(FOUR).plan, plans(text).of(HALF).plan
    assert plain.without == ("sampleRateShading", "alphaToOne")
    assert shaded.without == ("alphaToOne",)
    for name, expected in (("scene", 0.5), ("particles", 0.5), ("ui", -1.0), ("shadows", -1.0)):
        assert {pipeline.sample_shading for pipeline in named(shaded, name).pipelines} == {expected}
        assert {pipeline.sample_shading for pipeline in named(plain, name).pipelines} == {-1.0}
        # Of the others, the cost of shading is their own.
        assert {pipeline.shaded for pipeline in named(plain, name).pipelines} == {expected == 0.5}


def test_a_plan_without_resolves_shows_what_they_take() -> None:
    """The part of resolving is the difference to the same frame without; with one sample there is
    none.
    """
    studied = plans(FORWARD)
    assert studied.of(ONE).bare is None
    bare = studied.of(FOUR).bare
    assert bare is not None and all(
        subpass.resolves == () for each in bare.passes for subpass in each.subpasses
    )
    larger = studied.of(LARGER).bare
    assert larger is not None and blits(larger) == []
    rendering = plans(RENDERING).of(FOUR).bare
    assert rendering is not None and all(
        target.resolve_image == NONE for each in rendering.passes for target in each.rendered
    )


def test_a_depth_prepass_has_no_fragment_shader() -> None:
    text = (ROOT / "examples/phone/forward.msaa.yaml").read_text()
    pipelines = {
        pipeline.name: pipeline for pipeline in named(plans(text).of(FOUR).plan, "scene").pipelines
    }
    assert (pipelines["prepass"].numerics, pipelines["prepass"].shaded) == (("",), False)
    assert all(pipelines[name].shaded for name in ("opaque", "leaves", "glass"))


def test_a_multisampled_frame_keeps_its_resolves() -> None:
    text = (ROOT / "examples/phone/frame.msaa.yaml").read_text()
    studied = plans(text)
    assert studied.is_multisampled
    eight, one, larger = (studied.of(technique).plan for technique in (EIGHT, ONE, LARGER))
    assert image(eight, "scene_ms").samples == 8
    assert [step.kind for step in eight.steps].count("resolve") == 1
    assert (
        [step.kind for step in one.steps].count("resolve")
        == [step.kind for step in one.steps].count("copy")
        == 0
    )
    assert attached(one, "scene") == [("scene", 1), ("depth_ms", 1)]
    assert blits(larger) == [("scene 2x2", "scene")]


NO_GEOMETRY = "no pass of the frame draws geometry to color attachments that it clears"

SHADER_RESOLVE = """\
images: {c: {format: R8G8B8A8_UNORM, samples: 4}}
renderPasses:
  own: {attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{colorAttachments: [c], flags: [CUSTOM_RESOLVE_EXT]}]}
"""


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("images: {c: {format: R8G8B8A8_UNORM}}\n", NO_GEOMETRY),
        ("frame: {width: 64, height: 64}\n", "the frame has no passes"),
        (RENDERING.replace("loadOp: CLEAR", "loadOp: LOAD"), NO_GEOMETRY),
        (
            SHADER_RESOLVE,
            "own cannot be drawn: it resolves with a shader of its own, which confirm does not "
            "support",
        ),
    ],
)
def test_what_cannot_be_done_has_a_reason(text: str, reason: str) -> None:
    assert plans(text).of(FOUR).reason == reason


def test_one_sample_needs_no_geometry() -> None:
    assert plans("images: {c: {format: R8G8B8A8_UNORM}}\n").of(ONE).reason == ""


@pytest.fixture(scope="module")
def session() -> Iterator[Session]:
    with Session(None, environment=environment(None)) as opened:
        yield opened


def messages(session: Session, plan: Plan) -> list[str]:
    """The validation layer's errors about a plan, without work of a cost, which only a timing
    does.
    """
    plain = tuple(
        each._replace(pipelines=tuple(p._replace(shaded=False) for p in each.pipelines))
        for each in plan.passes
    )
    refused = gate.gate(plan, session.open())
    assert refused == {}
    run = session.run(plan._replace(passes=plain), range(len(plan.passes)), {})
    assert not run.failed
    assert [
        (number, each.end, each.error)
        for number, each in run.passes.items()
        if each.end or each.error
    ] == []
    found = [*run.messages, *(message for each in run.passes.values() for message in each.messages)]
    return [
        message["text"] for message in found if "VUID" in message["id"] or "SYNC" in message["id"]
    ]


def test_shaders_of_the_frame_are_as_described() -> None:
    """No cost of shading applies where all that draws has a fragment shader of its own."""
    (document,) = inputs(Request(paths=[str(ROOT / "examples/lit/forward.msaa.yaml")])).inputs
    studied = FramePlans(document.frame, document.file, SIZE)
    assert studied.as_described and not plans(FORWARD).as_described
    assert not any(
        pipeline.shaded for each in studied.of(FOUR).plan.passes for pipeline in each.pipelines
    )


@pytest.mark.parametrize("technique", ON_LAVAPIPE, ids=lambda each: each.name)
@pytest.mark.parametrize("text", [FORWARD, RENDERING], ids=["render passes", "dynamic rendering"])
def test_the_layer_has_no_message(session: Session, text: str, technique: Technique) -> None:
    found = plans(text).of(technique)
    assert found.reason == ""
    assert session.open() and session.layer is not None, (
        "the validation layer is missing: apt install vulkan-validationlayers"
    )
    assert messages(session, found.plan) == []


EXAMPLES = sorted([*ROOT.glob("examples/*/*.msaa.yaml"), *ROOT.glob("examples/capture/*.jsonl")])

OWN_MISTAKES = {"article-advice.msaa.yaml": "VUID-VkImageCreateInfo-usage-00963"}
"""What the layer says about a frame however it is drawn: an image is TRANSIENT_ATTACHMENT and
SAMPLED.
"""


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_examples_have_plans_without_messages(session: Session, path: Path) -> None:
    read = inputs(Request(paths=[str(path)]))
    assert read.wrong == []
    for document in read.inputs:
        studied = FramePlans(document.frame, document.file, SIZE)
        for technique in ON_LAVAPIPE:
            found = studied.of(technique)
            if found.reason:
                assert found.reason == "the frame has no passes"
                continue
            expected = OWN_MISTAKES.get(path.name)
            assert [
                text
                for text in messages(session, found.plan)
                if expected is None or expected not in text
            ] == []


def test_no_image_is_left_that_nothing_draws_to() -> None:
    plan = plans(FORWARD).of(FOUR).plan
    used = {number for each in plan.passes for number in each.images}
    assert used == set(range(len(plan.images)))
    assert all(number != NONE for number in used)
