"""The triangles of described draws: their number, and how large they are."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from msaa_lint.experiments.confirm import meshes
from msaa_lint.experiments.confirm.meshes import Sizes, triangles, with_meshes
from msaa_lint.experiments.confirm.parts import Mesh, PassCommand, Plan
from msaa_lint.experiments.confirm.session import Session, environment
from tests.experiments.confirm.frames import planned

TEXT = """\
frame: {width: 64, height: 32}
images:
  c: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
  d: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
pipelines:
  mesh: {rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}, vertexInputState: {vertexBindingDescriptions: [{binding: 0, stride: 12}]}}
  strip: {rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}, inputAssemblyState: {topology: TRIANGLE_STRIP}}
  lines: {rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}, inputAssemblyState: {topology: LINE_LIST}}
  screen:
    rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}
    multisampleState: {rasterizationSamples: 1, sampleShadingEnable: false, alphaToCoverageEnable: false}
    vertexInputState: {}
"""

BEGIN = "{beginRendering: {colorAttachments: [{image: c, loadOp: CLEAR, storeOp: STORE}]}}"


DEFAULT = Sizes()


def frame(*commands: str) -> Plan:
    return planned(
        TEXT
        + "commands:\n"
        + "".join(f"  - {command}\n" for command in (BEGIN, *commands, "endRendering"))
    )


def drawn(plan: Plan) -> list[PassCommand]:
    return [inner for step in plan.steps for inner in step.inner if inner.kind == "draw"]


def meshed(*commands: str, sizes: Sizes = DEFAULT) -> list[Mesh | None]:
    return [
        inner.mesh[0] if inner.mesh else None
        for inner in drawn(with_meshes(frame(*commands), sizes))
    ]


@pytest.fixture(scope="module")
def session() -> Iterator[Session]:
    with Session(None, environment=environment(None)) as opened:
        yield opened


def test_cells_are_as_many_as_the_triangles_fill() -> None:
    """400 triangles in 64 x 32 pixels: 200 cells, 20 across and 10 down."""
    assert meshed(
        "draw: {pipeline: mesh, vertexCount: 300}",
        "draw: {pipeline: mesh, indexCount: 450, instanceCount: 2}",
    ) == [
        Mesh(20, 10, 300),
        Mesh(20, 10, 450, 2, first=100),
    ]


def test_overdraw_and_sides_decide_how_large_they_are() -> None:
    draw = "draw: {pipeline: mesh, vertexCount: 1200}"
    (mesh,) = meshed(draw, sizes=Sizes(overdraw=4))
    assert mesh == Mesh(10, 5, 1200)
    # 64 * 32 pixels hold 16 x 8 cells of two triangles of 8 pixels each.
    (mesh,) = meshed(draw, sizes=Sizes(overdraw=4, side=32**0.5))
    assert mesh == Mesh(16, 8, 1200)


def test_several_draws_are_one_after_another() -> None:
    (mesh, later) = meshed(
        "draw: {pipeline: mesh, vertexCount: 6, drawCount: 50}",
        "draw: {pipeline: mesh, vertexCount: 3}",
    )
    assert (mesh.vertices, mesh.draws, mesh.first) == (6, 50, 0) if mesh else False
    assert later is not None and later.first == 100


@pytest.mark.parametrize(
    ("topology", "vertices", "count"),
    [
        (3, 300, 100),
        (3, 302, 100),
        (4, 300, 298),
        (5, 4, 2),
        (10, 9, 3),
        (0, 300, 0),
        (1, 300, 0),
        (2, 300, 0),
        (6, 300, 0),
        (4, 1, 0),
        (9, 6, 4),
    ],
)
def test_a_topology_has_its_triangles(topology: int, vertices: int, count: int) -> None:
    assert triangles(topology, vertices) == count


def test_what_covers_the_screen_does() -> None:
    assert meshed(
        "draw: {pipeline: screen, vertexCount: 3, instanceCount: 1}",
        "draw: {pipeline: screen, vertexCount: 6, instanceCount: 1}",
    ) == [
        Mesh(0, 0, 3),
        Mesh(1, 1, 6),
    ]


def test_lines_are_left_out_and_unknown_draws_stay() -> None:
    made = with_meshes(
        frame("draw: {pipeline: lines, vertexCount: 30}", "draw: {pipeline: strip}"), Sizes()
    )
    assert [inner.mesh for inner in drawn(made)] == [()]
    assert made.defaults[-2:] == (
        "the draws of points and lines of rendering0 are left out",
        "the number of vertices of draws of rendering0 is not stated: they draw the scene",
    )


def test_a_side_says_how_many_an_unknown_draw_has() -> None:
    """Half of the 2 * 16 * 8 triangles that cover the screen three times, for each of two draws."""
    made = meshed(
        "draw: {pipeline: strip}", "draw: {pipeline: mesh}", sizes=Sizes(overdraw=3, side=32**0.5)
    )
    assert made == [Mesh(16, 8, 3 * 384), Mesh(16, 8, 3 * 384, first=384)]


def test_draws_and_vertices_are_limited(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(meshes, "MAX_VERTICES", 3000)
    monkeypatch.setattr(meshes, "MAX_FRAME_VERTICES", 10_000)
    monkeypatch.setattr(meshes, "MAX_DRAWS", 4)
    plan = with_meshes(
        frame(
            "draw: {pipeline: mesh, vertexCount: 4000000000, instanceCount: 4000000000}",
            "draw: {pipeline: mesh, vertexCount: 3, drawCount: 2000000000}",
        ),
        Sizes(),
    )
    made = [inner.mesh[0] for inner in drawn(plan)]
    assert sum(each.vertices * each.instances * each.draws for each in made) <= 10_000
    assert all(each.vertices * each.instances <= 3000 and each.draws <= 4 for each in made)
    assert (
        plan.defaults[-1]
        == "some vertices of rendering0 are left out: a draw has at most 3,000 vertices, and a "
        "frame 10,000"
    )


DEPTH = """\
frame: {width: 64, height: 64}
images:
  c: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_SRC]}
  d: {format: D32_SFLOAT, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT]}
pipelines:
  prepass: {renderPass: first, depthStencilState: {depthTestEnable: true, depthWriteEnable: true, depthCompareOp: LESS}}
  opaque: {renderPass: second, depthStencilState: {depthTestEnable: true, depthWriteEnable: false, depthCompareOp: EQUAL}}
  glass: {renderPass: second, depthStencilState: {depthTestEnable: true, depthWriteEnable: false, depthCompareOp: LESS}}
renderPasses:
  first: {attachments: {d: {image: d, loadOp: CLEAR, storeOp: STORE}}, subpasses: [{depthStencilAttachment: d}]}
  second:
    attachments: {c: {image: c, loadOp: CLEAR, storeOp: STORE}, d: {image: d, loadOp: LOAD, storeOp: DONT_CARE}}
    subpasses: [{colorAttachments: [c], depthStencilAttachment: d}]
commands:
  - beginRenderPass: {renderPass: first}
  - draw: {pipeline: prepass, vertexCount: 384}
  - endRenderPass
  - beginRenderPass: {renderPass: second}
  - DRAW
  - endRenderPass
"""


@pytest.mark.parametrize("draw", ["opaque, vertexCount: 384", "glass, vertexCount: 96"])
def test_what_is_drawn_passes_the_depth_test(session: Session, tmp_path: Path, draw: str) -> None:
    """After a depth pass: the same triangles with EQUAL, and others, which are nearer, with
    LESS.
    """
    plan = with_meshes(planned(DEPTH.replace("DRAW", f"draw: {{pipeline: {draw}}}")), Sizes())
    run = session.run(plan, [0, 1], {"pixels": str(tmp_path)})
    assert not run.failed
    pixels = np.fromfile(run.images["c"]["path"], np.uint8).reshape(64, 64, 4)
    cleared = (pixels == np.round(np.array((0.125, 0.25, 0.5, 1.0)) * 255)).all(axis=-1)
    assert not cleared.any()


def test_as_many_triangles_are_drawn_as_are_stated(session: Session, tmp_path: Path) -> None:
    """Every triangle has 32 pixels; neighbors differ in color, so that their edges are where they
    should be.
    """
    plan = with_meshes(frame("draw: {pipeline: mesh, vertexCount: 192}"), Sizes())
    (mesh,) = (inner.mesh[0] for inner in drawn(plan))
    assert (mesh.columns, mesh.rows) == (8, 4)
    run = session.run(plan, [0], {"pixels": str(tmp_path)})
    pixels = np.fromfile(run.images["c"]["path"], np.uint8).reshape(32, 64, 4).astype(np.int64)
    codes = pixels @ np.array((1, 1 << 8, 1 << 16, 1 << 24))
    cell = codes[:8, :8]
    assert len(np.unique(cell)) == 2
    upper = np.add.outer(np.arange(8), np.arange(8)) < 7
    assert len(np.unique(cell[upper])) == 1
    assert (
        math.prod(codes.shape)
        / len(np.unique(codes.reshape(4, 8, 8, 8).swapaxes(1, 2).reshape(32, 64), axis=0))
        == 64
    )
