"""A frame in Metal's words and the same frame in Vulkan's: the same findings of Vulkan's rules, the
same cost, at Metal's places.
"""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from hypothesis import HealthCheck, given

from msaa_lint.frame.cost.model import frame_cost
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.global_facts import profile
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.registry import load
from tests.frame.description.shapes import Json
from tests.frame.metal.frames import ARTICLE, BEST, document
from tests.frames import metal_frames
from tests.strength import examples

ENGINE = Engine(load())

STORED = (
    ARTICLE,
    """\
frame: {width: 1920, height: 1080, fps: 60}
device:
  name: apple7
  vendor: apple
  tiler: true
  sampleCounts: {color: [1, 2, 4], depth: [1, 2, 4], stencil: [1, 2, 4]}
  memoryTypes: [[DEVICE_LOCAL], [DEVICE_LOCAL, LAZILY_ALLOCATED]]
  tile: {model: apple-g13}
images:
  ms: {format: R8_UNORM, imageType: 2D, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
  depth: {format: D32_SFLOAT, imageType: 2D, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT], memory: [DEVICE_LOCAL]}
  drawable: {format: R8_UNORM, samples: 1, presentable: true}
renderPasses:
  forward:
    attachments:
      ms: {image: ms, loadOp: CLEAR, storeOp: STORE}
      depth: {image: depth, loadOp: CLEAR, storeOp: STORE}
      drawable: {image: drawable, loadOp: DONT_CARE, storeOp: STORE}
    subpasses: [{colorAttachments: [ms], resolveAttachments: [drawable], depthStencilAttachment: depth}]
pipelines: {opaque: {renderPass: forward, subpass: 0, multisampleState: {rasterizationSamples: 4}}}
commands:
  - beginRenderPass: {renderPass: forward}
  - endRenderPass: {}
  - present: {image: drawable}
""",
)
DEPTH = (
    """\
frame: {width: 640, height: 480, fps: 60}
device: mali-g76
scene: {depth: STANDARD, depthResolveWants: NEAREST}
metal:
  textures:
    normals: {encoding: DATA, pixelFormat: r16Float, sampleCount: 4, usage: [renderTarget, shaderRead, shaderWrite], storageMode: private}
    ds: {pixelFormat: depth32Float_stencil8, sampleCount: 4, usage: [renderTarget, shaderRead], storageMode: private, mipmapLevelCount: 1}
    out: {pixelFormat: depth32Float_stencil8, sampleCount: 1, width: 640, height: 480, usage: [renderTarget], storageMode: private}
    drawable: {pixelFormat: bgra8Unorm_srgb, drawable: true}
  renderPasses:
    geometry:
      colorAttachments: {0: null, 1: {texture: normals, loadAction: load, storeAction: store}}
      depthAttachment:
        {texture: ds, resolveTexture: out, loadAction: clear, storeAction: storeAndMultisampleResolve, depthResolveFilter: max}
      stencilAttachment: {texture: ds, loadAction: clear, storeAction: dontCare}
    light:
      colorAttachments: [{texture: drawable, loadAction: clear, storeAction: store}]
      depthAttachment: {texture: out, loadAction: load, storeAction: dontCare}
  commands:
    - renderPass: geometry
    - readTexture: {texture: normals, stage: fragment, samples: 1}
    - readTexture: {texture: ds, stage: compute, samples: ALL, resolves: AVERAGE}
    - writeTexture: {texture: normals, stage: compute}
    - renderPass: light
    - copy: {source: normals, destination: normals}
    - present: drawable
""",
    """\
frame: {width: 640, height: 480, fps: 60}
device: mali-g76
scene: {depth: STANDARD, depthResolveWants: NEAREST}
images:
  normals: {format: R16_SFLOAT, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED, STORAGE], memory: [DEVICE_LOCAL], encoding: DATA}
  ds: {format: D32_SFLOAT_S8_UINT, samples: 4, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL], mipLevels: 1}
  out:
    {format: D32_SFLOAT_S8_UINT, samples: 1, extent: {width: 640, height: 480}, usage: [DEPTH_STENCIL_ATTACHMENT], memory: [DEVICE_LOCAL]}
  drawable: {format: B8G8R8A8_SRGB, samples: 1, presentable: true}
renderPasses:
  geometry:
    attachments:
      normals: {image: normals, loadOp: LOAD, storeOp: STORE}
      ds: {image: ds, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: DONT_CARE}
      out: {image: out, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - colorAttachments: [null, normals]
        depthStencilAttachment: ds
        depthStencilResolve: {attachment: out, depthResolveMode: MAX, stencilResolveMode: NONE}
  light:
    attachments:
      drawable: {image: drawable, loadOp: CLEAR, storeOp: STORE}
      out: {image: out, loadOp: LOAD, storeOp: DONT_CARE}
    subpasses: [{colorAttachments: [drawable], depthStencilAttachment: out}]
commands:
  - beginRenderPass: {renderPass: geometry}
  - endRenderPass: {}
  - readImage: {image: normals, stage: FRAGMENT, samples: 1}
  - readImage: {image: ds, stage: COMPUTE, samples: ALL, resolves: AVERAGE}
  - writeImage: {image: normals, stage: COMPUTE}
  - beginRenderPass: {renderPass: light}
  - endRenderPass: {}
  - copyImage: {srcImage: normals, dstImage: normals}
  - present: {image: drawable}
""",
)


def meant(value: object) -> Any:
    """What records state, their places aside."""
    if isinstance(value, Record):
        members = [name for name in (*value.SHAPE, "kind", "body") if hasattr(value, name)]
        return (type(value).__name__, {name: meant(getattr(value, name)) for name in members})
    if isinstance(value, dict):
        return {name: meant(each) for name, each in value.items()}
    return [meant(each) for each in value] if isinstance(value, (list, tuple)) else value


def found(document: Document) -> list[tuple[str, str, str]]:
    """What Vulkan's rules say of a frame."""
    if document.metal is not None:
        document = document._replace(metal=document.metal._replace(api="VULKAN"))
    verdicts, _ = ENGINE.linter.lint_document(
        document, "given.yaml", LintOptions(lambda rule, suggested, vendor: suggested)
    )
    return sorted(
        (finding.rule, finding.severity, finding.message) for finding in verdicts.findings
    )


@pytest.mark.parametrize(("metal", "vulkan"), [STORED, DEPTH])
def test_it_is_the_same_frame(metal: str, vulkan: str) -> None:
    ours, theirs = document(metal), document(vulkan)
    for section in ("images", "renderPasses", "pipelines", "commands"):
        assert meant(getattr(ours.description, section)) == meant(
            getattr(theirs.description, section)
        ), section
    # The cases for Metal word some findings otherwise.
    assert [each[:2] for each in found(ours)] == [each[:2] for each in found(theirs)] != []
    costs = [frame_cost(Frame(each), profile(each.description)) for each in (ours, theirs)]
    without_places = [re.sub(r"path='[^']*'|place=Span\([^)]*\)", "", str(each)) for each in costs]
    assert without_places[0] == without_places[1]


def test_findings_stand_in_metals_text() -> None:
    linted = ENGINE.lint(
        ARTICLE.encode(), "given.yaml", LintOptions(lambda rule, suggested, vendor: suggested)
    )
    stated = {
        (f.rule, ARTICLE[f.span.start : f.span.end], f.subject)
        for f in linted.findings
        if f.span is not None
    }
    assert stated == {
        ("metal-usage-blocks-memoryless", "shaderRead", "metal.textures.ms"),
        ("metal-memoryless-possible", "private", "metal.textures.depth"),
        (
            "metal-samples-stored-unread",
            "storeAndMultisampleResolve",
            "metal.renderPasses.forward.colorAttachments[0]",
        ),
        ("metal-depth-stored-unread", "store", "metal.renderPasses.forward.depthAttachment"),
    }
    assert (
        ENGINE.lint(
            BEST.encode(), "given.yaml", LintOptions(lambda rule, suggested, vendor: suggested)
        ).findings
        == []
    )


def test_paths_are_metals() -> None:
    paths = {(subject.kind, subject.path) for subject in subjects(document(DEPTH[0]))}
    assert {
        path for kind, path in paths if kind in ("pass", "attachment", "subpass", "resolve")
    } == {
        "metal.renderPasses.geometry",
        "metal.renderPasses.geometry.colorAttachments.1",
        "metal.renderPasses.geometry.depthAttachment",
        "metal.renderPasses.geometry.depthAttachment.resolveTexture",
        "metal.renderPasses.light",
        "metal.renderPasses.light.colorAttachments[0]",
        "metal.renderPasses.light.depthAttachment",
    }


def resolves(passes: str) -> list[tuple[str, str | None, str | None, str | None]]:
    """Of a frame with these passes: what is resolved, by which mode, from and to what."""
    textures = (
        "c: {pixelFormat: r8Unorm, sampleCount: 4}, d: {pixelFormat: depth32Float, sampleCount: 4}"
    )
    textures += (
        ", s: {pixelFormat: stencil8, sampleCount: 4}, ds: {pixelFormat: "
        "depth32Float_stencil8, sampleCount: 4}"
    )
    textures += (
        ", one: {pixelFormat: r8Unorm}, d1: {pixelFormat: depth32Float}, s1: {pixelFormat: "
        "stencil8}"
    )
    textures += ", ds1: {pixelFormat: depth32Float_stencil8}"
    frame = Frame(
        document(f"metal: {{textures: {{{textures}}}, renderPasses: {{p: {{{passes}}}}}}}")
    )
    return [
        (r.aspect, r.mode, r.source.name if r.source else None, r.target.name if r.target else None)
        for r in frame.passes[0].subpasses[0].resolves
    ]


@pytest.mark.parametrize("action", ["multisampleResolve", "storeAndMultisampleResolve"])
def test_an_action_and_a_texture_resolve(action: str) -> None:
    assert resolves(
        f"colorAttachments: [null, {{texture: c, resolveTexture: one, storeAction: {action}}}]"
    ) == [("color", "AVERAGE", "c", "one")]
    assert resolves(f"colorAttachments: [{{texture: c, storeAction: {action}}}]") == []
    assert (
        resolves("colorAttachments: [{texture: c, resolveTexture: one, storeAction: store}]") == []
    )
    assert (
        resolves("colorAttachments: [{texture: c, resolveTexture: one, storeAction: unknown}]")
        == []
    )
    assert resolves("colorAttachments: [{texture: c, resolveTexture: one}]") == []


@pytest.mark.parametrize(
    ("filter", "mode"),
    [("", "SAMPLE_ZERO"), (", depthResolveFilter: sample0", "SAMPLE_ZERO"),
    (", depthResolveFilter: .min", "MIN"),
     (", depthResolveFilter: MTLMultisampleDepthResolveFilterMax", "MAX")],
)  # fmt: skip
def test_a_filter_is_a_mode(filter: str, mode: str) -> None:
    stated = (
        f"depthAttachment: {{texture: d, resolveTexture: d1, storeAction: "
        f"multisampleResolve{filter}}}"
    )
    assert resolves(stated) == [("depth", mode, "d", "d1")]


def test_depth_and_stencil_of_one_texture() -> None:
    depth = "depthAttachment: {texture: ds, resolveTexture: ds1, storeAction: multisampleResolve"
    stencil = (
        "stencilAttachment: {texture: ds, resolveTexture: ds1, storeAction: multisampleResolve"
    )
    both = [("depth", "MIN", "ds", "ds1"), ("stencil", "SAMPLE_ZERO", "ds", "ds1")]
    assert resolves(f"{depth}, depthResolveFilter: min}}, {stencil}}}") == both
    chosen = resolves(
        f"{depth}, depthResolveFilter: min}}, {stencil}, stencilResolveFilter: "
        f"depthResolvedSample}}"
    )
    assert [each[1] for each in chosen] == ["MIN", None], (
        "Vulkan has no mode that follows the depth's"
    )
    assert [
        each[1]
        for each in resolves(f"{depth}}}, {stencil}, stencilResolveFilter: depthResolvedSample}}")
    ] == ["SAMPLE_ZERO"] * 2
    alone = resolves(f"{depth}}}, stencilAttachment: {{texture: ds, storeAction: dontCare}}")
    assert [each[1] for each in alone] == ["SAMPLE_ZERO", "NONE"]
    assert [each[1] for each in resolves(f"{stencil}}}")] == ["NONE", "SAMPLE_ZERO"]


def test_depth_and_stencil_of_two_textures() -> None:
    depth = (
        "depthAttachment: {texture: d, resolveTexture: d1, loadAction: clear, storeAction: "
        "multisampleResolve}"
    )
    stencil = (
        "stencilAttachment: {texture: s, resolveTexture: s1, loadAction: load, storeAction: "
        "storeAndMultisampleResolve}"
    )
    assert resolves(f"{depth}, {stencil}") == [
        ("depth", "SAMPLE_ZERO", "d", "d1"),
        ("stencil", "SAMPLE_ZERO", "s", "s1"),
    ]
    textures = (
        "d: {pixelFormat: depth32Float, sampleCount: 4}, s: {pixelFormat: stencil8, "
        "sampleCount: 4}, d1: {pixelFormat: depth32Float}"
    )
    text = (
        f"metal: {{textures: {{{textures}, s1: {{pixelFormat: stencil8}}}}, renderPasses: {{p: "
        f"{{{depth}, {stencil}}}}}}}"
    )
    frame = Frame(document(text))
    assert [each.name for each in frame.passes[0].subpasses[0].depth_stencil] == ["d", "s"]
    by_name = {each.name: each for each in frame.passes[0].attachments}
    assert [(a.name, a.load, a.store) for a in by_name["s"].aspects] == [
        ("stencil", "LOAD", "STORE")
    ]
    assert by_name["s"].used and by_name["s"].drawn and by_name["s1"].resolve == {0: {"stencil"}}


def test_attachments_have_names_of_their_own() -> None:
    """One texture in two slots, and names that mean something else in a description."""
    attachments = (
        "{texture: a, resolveTexture: a, storeAction: multisampleResolve}, {texture: a}, "
        "{texture: UNUSED}, {}"
    )
    text = (
        f"metal: {{textures: {{a: {{}}, UNUSED: {{}}}}, renderPasses: {{p: {{colorAttachments: "
        f"[{attachments}]}}}}}}"
    )
    frame = Frame(document(text))
    assert [each.name for each in frame.passes[0].attachments] == [
        "a",
        "a (colorAttachments[1])",
        "UNUSED (colorAttachments[2])",
        "colorAttachments[3]",
        "a (colorAttachments[0].resolveTexture)",
    ]
    assert [each.name if each else None for each in frame.passes[0].subpasses[0].color] == [
        "a", "a (colorAttachments[1])", "UNUSED (colorAttachments[2])", "colorAttachments[3]",
    ]  # fmt: skip
    assert [each.image for each in frame.description.renderPasses["p"].attachments] == [
        "a",
        "a",
        "UNUSED",
        None,
        "a",
    ]


def test_what_is_not_stated_stays_unknown() -> None:
    text = (
        "metal: {textures: {a: {}}, renderPasses: {p: {colorAttachments: [{texture: a}]}}, "
        "renderPipelines: {x: {renderPass: p}}}"
    )
    described = document(text).description
    image, attachment = described.images["a"], described.renderPasses["p"].attachments[0]
    assert all(getattr(image, member) in (None, ()) for member in image.SHAPE)
    assert [attachment.loadOp, attachment.storeOp, attachment.format, attachment.samples] == [
        None
    ] * 4
    assert described.pipelines["x"].multisampleState is None
    assert described.commands is None and not document(text).description.states("images")


@pytest.mark.parametrize(
    ("texture", "samples"),
    [("", None), ("drawable: true", 1), ("textureType: type2D", 1), ("textureType: "
        "type2DMultisample", None),
     ("textureType: type2D, sampleCount: 4", 4)],
)  # fmt: skip
def test_samples_of_a_texture(texture: str, samples: int | None) -> None:
    assert (
        document(f"metal: {{textures: {{a: {{{texture}}}}}}}").description.images["a"].samples
        == samples
    )


@pytest.mark.parametrize(
    ("texture", "usage"),
    [
        ("pixelFormat: r8Unorm, usage: [renderTarget]", ("COLOR_ATTACHMENT",)),
        (
            "pixelFormat: stencil8, usage: [renderTarget, shaderRead]",
            ("DEPTH_STENCIL_ATTACHMENT", "SAMPLED"),
        ),
        ("pixelFormat: r8Unorm, usage: [shaderWrite, shaderAtomic]", ("STORAGE",)),
        ("pixelFormat: r8Unorm, usage: [unknown]", None),
        ("pixelFormat: r8Unorm, usage: [renderTarget, unknown]", None),
        ("pixelFormat: r8Unorm", None),
        ("usage: [renderTarget]", None),
        (
            "pixelFormat: r8Unorm, storageMode: memoryless",
            ("COLOR_ATTACHMENT", "TRANSIENT_ATTACHMENT"),
        ),
        (
            "pixelFormat: r8Unorm, usage: [shaderRead], storageMode: memoryless",
            ("SAMPLED", "TRANSIENT_ATTACHMENT"),
        ),
    ],
)
def test_usage_of_a_texture(texture: str, usage: tuple[str, ...] | None) -> None:
    assert (
        document(f"metal: {{textures: {{a: {{{texture}}}}}}}").description.images["a"].usage
        == usage
    )


def test_a_render_target_of_no_vulkan_format_is_what_it_is_attached_as() -> None:
    texture = "a: {pixelFormat: bgr10_xr, usage: [renderTarget]}"
    text = (
        f"metal: {{textures: {{{texture}}}, renderPasses: {{p: {{colorAttachments: [{{texture: "
        f"a}}]}}}}}}"
    )
    image = document(text).description.images["a"]
    assert (image.format, image.usage) == (None, ("COLOR_ATTACHMENT",))


@examples(1.5, suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large])
@given(metal_frames())
def test_random_frames_are_judged_priced_and_fixed_without_a_failure(frame: Json) -> None:
    text = json.dumps(frame)
    severity = lambda rule, suggested, vendor: suggested  # noqa: E731
    linted = ENGINE.lint(text.encode(), "random.json", LintOptions(severity, prices=True))
    assert [finding for finding in linted.findings if finding.fatal] == []
    for finding in linted.findings:
        assert finding.span is not None and 0 <= finding.span.start <= finding.span.end <= len(text)
        assert "{" not in finding.message, finding
    (judged,) = linted.documents
    made = Frame(judged.document)
    frame_cost(made, judged.device)
    for each in made.passes:
        assert len(each.attachments) == len({attachment.name for attachment in each.attachments})
