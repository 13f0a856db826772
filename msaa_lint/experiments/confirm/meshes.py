"""The triangles of described draws: as many as they state, as large as the frame says or their
number implies.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from .parts import LOAD, NONE, RENDER_PASS, Mesh, Pass, PassCommand, Pipeline, Plan, Step
from .plan_notes import Notes

MAX_VERTICES = 10_000_000
"""Vertices of a draw, over all its instances."""

MAX_FRAME_VERTICES = 100_000_000

MAX_DRAWS = 4096
"""Draws of a frame: those of one command are joined beyond that."""

EQUAL = 2
"""VK_COMPARE_OP_EQUAL."""

POINTS, LINES, LINE_STRIPS, STRIPS, FANS = 0, (1, 6), (2, 7), (4, 9), 5
"""VkPrimitiveTopology; others are lists of triangles, or patches, which count as triangles."""


class Sizes(NamedTuple):
    """How large the triangles are: `overdraw` is how many cover a pixel on average, and `side` the
    longest side of one in pixels, or 0 for what their number implies.
    """

    overdraw: float = 1.0
    side: float = 0.0


def with_meshes(plan: Plan, sizes: Sizes) -> Plan:
    """A plan whose draws with a known number of vertices draw that many triangles, over the render
    area, each layer nearer than the last.

    Full-screen draws cover it, draws of points and lines are left out, and those of an unknown
    number stay as they are, unless `sizes.side` says how many triangles there are. Notes say so.
    """
    notes = Notes()
    left = MAX_FRAME_VERTICES
    draws = sum(inner.draws for step in plan.steps for inner in step.inner if inner.kind == "draw")
    layers: dict[int, int] = {}
    steps = []
    for step in plan.steps:
        if step.kind == "begin" and any(inner.kind == "draw" for inner in step.inner):
            layout = _Layout(plan, step, sizes, layers, -(-draws // MAX_DRAWS), left, notes)
            step = step._replace(inner=layout.commands())
            left = layout.left
        steps.append(step)
    return plan._replace(steps=tuple(steps), defaults=(*plan.defaults, *notes.lines()))


def triangles(topology: int, vertices: int) -> int:
    """The triangles that so many vertices form."""
    if topology == POINTS or topology in (*LINES, *LINE_STRIPS):
        return 0
    return max(vertices - 2, 0) if topology in STRIPS or topology == FANS else vertices // 3


class _Layout:
    """The triangles of one pass: its render area is divided into cells, which its draws fill one
    after another.
    """

    def __init__(
        self,
        plan: Plan,
        step: Step,
        sizes: Sizes,
        layers: dict[int, int],
        join: int,
        left: int,
        notes: Notes,
    ) -> None:
        self.frame_pass: Pass = plan.passes[step.number]
        self.step, self.sizes, self.layers, self.join, self.left = step, sizes, layers, join, left
        self.notes = notes
        width, height = step.area[2:]
        self.counts = {
            id(inner): self._count(inner) for inner in step.inner if inner.kind == "draw"
        }
        total = sum(
            count * inner.draws
            for inner in step.inner
            for count in [self.counts.get(id(inner)) or 0]
        )
        if sizes.side:
            # A cell is a square whose diagonal is the longest side of its two triangles.
            cells = 2 * width * height / sizes.side**2
        else:
            cells = max(total, 1) / (2 * sizes.overdraw)
        self.columns = max(1, min(round(math.sqrt(cells * width / height)), 1 << 14))
        self.rows = max(1, min(math.ceil(cells / self.columns), 1 << 14))
        unknown = sum(
            max(inner.draws, 1)
            for inner in step.inner
            if inner.kind == "draw" and self.counts[id(inner)] is None
        )
        self.share = (
            math.ceil(2 * self.columns * self.rows * sizes.overdraw / unknown)
            if unknown and sizes.side
            else 0
        )

    def commands(self) -> tuple[PassCommand, ...]:
        """The commands of the pass, with meshes."""
        cells = 2 * self.columns * self.rows
        depth = self._depth_image()
        first = self.layers.get(depth, 0) * cells
        equal = 0
        commands: list[PassCommand] = []
        for inner in self.step.inner:
            if inner.kind != "draw":
                commands.append(inner)
                continue
            pipeline = self.frame_pass.pipelines[inner.pipeline]
            count = self.counts[id(inner)]
            count = self.share if count is None else count
            if pipeline.has_vertex_shader and inner.vertices:
                commands.append(inner._replace(mesh=(self._mesh(inner, pipeline, count, 0),)))
            elif inner.full_screen:
                commands.append(
                    inner._replace(mesh=(Mesh(0, 0, 3) if inner.vertices == 3 else Mesh(1, 1, 6),))
                )
            elif count:
                at_depth = pipeline.depth_test and pipeline.depth_compare == EQUAL
                mesh = self._mesh(inner, pipeline, count, equal if at_depth else first)
                drawn = mesh.vertices // 3 * mesh.instances * mesh.draws
                equal, first = (equal + drawn, first) if at_depth else (equal, first + drawn)
                commands.append(inner._replace(mesh=(mesh,)))
            elif inner.vertices:
                self.notes.append(
                    "the draws of points and lines of {} are left out", self.frame_pass.name
                )
            else:
                self.notes.append(
                    "the number of vertices of draws of {} is not stated: they draw the scene",
                    self.frame_pass.name,
                )
                commands.append(inner)
        if depth != NONE:
            self.layers[depth] = -(-first // cells)
        return tuple(commands)

    def _count(self, inner: PassCommand) -> int | None:
        """The triangles of a draw, over all its instances; 0 if it covers the render area or has
        none, None if unknown.
        """
        if inner.full_screen:
            return 0
        if not inner.vertices:
            return None
        return (
            triangles(self.frame_pass.pipelines[inner.pipeline].topology, inner.vertices)
            * inner.instances
        )

    def _mesh(self, inner: PassCommand, pipeline: Pipeline, count: int, first: int) -> Mesh:
        """The mesh of a draw of `count` triangles; of a pipeline with a vertex shader of its own,
        the draw as described.
        """
        draws, instances = max(inner.draws, 1), max(inner.instances, 1) if inner.vertices else 1
        if self.join > 1:
            draws = max(draws // self.join, 1)
        each = -(-count * max(inner.draws, 1) // (draws * instances))
        vertices = inner.vertices if pipeline.has_vertex_shader and inner.vertices else 3 * each
        most = max(min(MAX_VERTICES, self.left // draws), 3)
        if vertices * instances > most:
            limit = (
                f"a draw has at most {MAX_VERTICES:,} vertices, and a frame {MAX_FRAME_VERTICES:,}"
            )
            self.notes.append("some vertices of {} are left out: " + limit, self.frame_pass.name)
            instances = max(min(instances, most // vertices), 1)
            vertices = min(vertices, most // 3 * 3)
        self.left -= vertices * instances * draws
        return Mesh(self.columns, self.rows, vertices, instances, draws, first)

    def _depth_image(self) -> int:
        """The depth attachment whose contents the pass loads or leaves; its layers start again
        where it is not loaded.
        """
        frame_pass = self.frame_pass
        if frame_pass.kind == RENDER_PASS:
            images = frame_pass.framebuffers[self.step.framebuffer].images
            references = [
                reference for subpass in frame_pass.subpasses for reference in subpass.depth_stencil
            ]
            found = [
                (images[r.attachment], frame_pass.attachments[r.attachment].load)
                for r in references
            ]
        else:
            found = [
                (r.image, r.load)
                for r in frame_pass.rendered
                if r.role == "depth" and r.image != NONE
            ]
        if not found:
            return NONE
        image, load = found[0]
        if load != LOAD:
            self.layers.pop(image, None)
        return image
