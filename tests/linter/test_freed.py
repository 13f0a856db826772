"""What is known of an input is freed with its result, without the garbage collector, which the
command line disables.
"""

from __future__ import annotations

import gc
from itertools import product

import pytest

from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.linter.engine import Engine
from msaa_lint.linter.lint_options import LintOptions
from msaa_lint.linter.rules.registry import load
from tests.frame.cost.frames import document
from tests.pages import all_examples
from tests.paths import ROOT

ENGINE = Engine(load())
OPTIONS = LintOptions(lambda rule, severity, vendor: severity, prices=True, all_keys=True)
DEPTH_RESOLVED = """
images:
  color: {format: R8G8B8A8_UNORM, samples: 4, extent: {width: 64, height: 64}}
  out: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 64, height: 64}}
  depth: {format: D24_UNORM_S8_UINT, samples: 4, extent: {width: 64, height: 64}}
  depth_out: {format: D24_UNORM_S8_UINT, samples: 1, extent: {width: 64, height: 64}}
"""
RENDER_PASS = """
renderPasses:
  main:
    attachments:
      color: {image: color, loadOp: CLEAR, storeOp: STORE}
      out: {image: out, loadOp: DONT_CARE, storeOp: STORE}
      depth: {image: depth, loadOp: CLEAR, storeOp: STORE, stencilLoadOp: CLEAR, stencilStoreOp: STORE}
      depth_out: {image: depth_out, loadOp: DONT_CARE, storeOp: STORE, stencilLoadOp: DONT_CARE, stencilStoreOp: STORE}
    subpasses:
      - colorAttachments: [color]
        resolveAttachments: [out]
        depthStencilAttachment: depth
        depthStencilResolve: {attachment: depth_out, depthResolveMode: SAMPLE_ZERO, stencilResolveMode: NONE}
"""
RENDERING = """
commands:
  - beginRendering:
      colorAttachments:
        - {image: color, loadOp: CLEAR, storeOp: STORE, resolveMode: AVERAGE, resolveImage: out}
      depthAttachment: {image: depth, loadOp: CLEAR, storeOp: STORE, resolveMode: SAMPLE_ZERO, resolveImage: depth_out}
      stencilAttachment: {image: depth, loadOp: CLEAR, storeOp: STORE, resolveMode: NONE}
  - draw: {vertexCount: 3}
  - endRendering
  - resolveImage: {srcImage: color, dstImage: out}
"""
METAL = (ROOT / "examples" / "impeller" / "article-metal.msaa.yaml").read_text(encoding="utf-8")
SHAPES = {
    "render pass": DEPTH_RESOLVED + RENDER_PASS,
    "dynamic rendering and commands": DEPTH_RESOLVED + RENDERING,
    "invalid value": DEPTH_RESOLVED + RENDER_PASS.replace("CLEAR", "CLEAN"),
    "invalid syntax": DEPTH_RESOLVED + "renderPasses: {main: [",
    "several documents": f"{DEPTH_RESOLVED}{RENDER_PASS}---{DEPTH_RESOLVED}{RENDERING}",
    "Metal": METAL,
}


def lint(*texts: str) -> None:
    # The pages' shaders are found beside them.
    for text, folder in product(texts, ("rules", "missing")):
        ENGINE.lint(text.encode(), str(ROOT / folder / "x.msaa.yaml"), OPTIONS)


def garbage(*texts: str) -> int:
    """The number of objects that only the garbage collector frees after texts are linted and the
    results are dropped.
    """
    # What is created once and kept, such as compiled conditions, is not counted.
    lint(*texts)
    gc.collect()
    gc.disable()
    try:
        lint(*texts)
        return gc.collect()
    finally:
        gc.enable()


@pytest.mark.parametrize("name", SHAPES)
def test_analysis_leaves_no_garbage(name: str) -> None:
    assert garbage(SHAPES[name]) == 0


def test_analyses_of_all_examples_leave_no_garbage() -> None:
    assert garbage(*(example.text for example in all_examples())) == 0


@pytest.mark.parametrize("name", ["render pass", "dynamic rendering and commands"])
def test_a_subject_keeps_the_pass_of_its_parts(name: str) -> None:
    """What fixes are planned for outlives the frame that it was found in."""
    for subject in list(subjects(document(SHAPES[name]))):
        for resolve in filter(
            None,
            (
                subject.resolve,
                *(subject.attachment.resolved if subject.attachment is not None else ()),
            ),
        ):
            render_pass = resolve.render_pass
            assert (render_pass is None) == (resolve.kind == "command")
            assert render_pass is None or resolve in render_pass.resolves
            assert (resolve.pair is None) == (resolve.aspect == "color")
        assert subject.subpass is None or subject.subpass in subject.subpass.render_pass.subpasses


def test_a_part_without_its_pass_is_an_error() -> None:
    resolve = Frame(document(SHAPES["render pass"])).passes[0].resolves[0]
    with pytest.raises(ReferenceError, match="without its pass"):
        _ = resolve.render_pass
