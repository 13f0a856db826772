"""The layout of a frame's graph: passes from top to bottom, each image a line beside them from its
first use to its last.

It is like a sequence diagram: a line from an image to a pass is a read, and back a write. Images of
which one ends before the other begins share a column, so that a long frame stays narrow.
"""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heappop, heappush
from math import sqrt
from typing import NamedTuple

from msaa_lint.frame.cost.graph import TILE, WRITE, Flow, FrameGraph, GraphImage, GraphPass

from ..cost_rows import figure
from ..words import plural

MAX_PASSES = 60
MAX_IMAGES = 100
MAX_FLOWS = 16
"""What a graph draws: passes, images, and flows of one pass. The table beside it has the rest."""

_PASS_WIDTH, _LABEL_WIDTH, _COLUMN, _IMAGE_WIDTH = 170, 200, 158, 148
_IMAGE_HEIGHT, _PORT, _GAP, _MARGIN = 40, 27, 18, 8
_PASS_TEXT, _IMAGE_TEXT = 22, 19
"""Characters of names that fit; the title of a box has the whole name."""


class Box(NamedTuple):
    """A pass or an image. The title is the text of its tooltip."""

    x: int
    y: int
    width: int
    height: int
    name: str
    detail: str
    title: str
    kind: str


class Arrow(NamedTuple):
    """A flow between a pass, whose edge is at `left`, and an image at `right`. `kind` is `read`,
    `write`, or `tile`.
    """

    left: int
    right: int
    y: int
    width: float
    kind: str
    label: str
    title: str


class Lifeline(NamedTuple):
    """The line of an image from its box to its last use."""

    x: int
    top: int
    bottom: int


class Drawing(NamedTuple):
    """A graph to draw, and what of it is left out; empty if nothing is."""

    width: int
    height: int
    passes: list[Box]
    images: list[Box]
    lifelines: list[Lifeline]
    arrows: list[Arrow]
    left_out: str


class FlowRow(NamedTuple):
    """A flow in the table that says the same as the drawing."""

    name: str
    image: str
    samples: str
    action: str
    path: str
    megabytes: str


def drawing(graph: FrameGraph, fps: float) -> Drawing:
    """The graph as boxes and lines, in pixels. The time it takes is proportional to the number of
    passes and flows.
    """
    return _Layout(graph, fps).drawing()


def flow_rows(graph: FrameGraph) -> Iterator[FlowRow]:
    """The flows of a graph, in the order of the passes."""
    for each in graph.passes:
        for flow in each.flows:
            samples = f"{flow.samples}x" if flow.samples is not None else "unknown"
            path = "stays on the tile" if flow.direction == TILE else "through memory"
            action = "drawn to" if flow.direction == TILE else _action(flow)
            megabytes = "" if flow.direction == TILE else figure(flow.bytes / 1e6)
            yield FlowRow(
                each.name, graph.images[flow.image].name, samples, action, path, megabytes
            )


class _Layout:
    def __init__(self, graph: FrameGraph, fps: float) -> None:
        self._graph = graph
        self._fps = fps
        self._passes = [
            each._replace(flows=each.flows[:MAX_FLOWS]) for each in graph.passes[:MAX_PASSES]
        ]
        uses: dict[int, list[int]] = {}
        for number, each in enumerate(self._passes):
            for flow in each.flows:
                if flow.image in uses or len(uses) < MAX_IMAGES:
                    uses.setdefault(flow.image, []).append(number)
        self._uses = uses
        self._columns = _columns(uses, len(self._passes))
        self._largest = (
            max((flow.bytes for each in self._passes for flow in each.flows), default=0) or 1
        )

    def drawing(self) -> Drawing:
        passes, images, arrows = list[Box](), list[Box](), list[Arrow]()
        ends: dict[int, tuple[int, int]] = {}
        y = _MARGIN
        for number, each in enumerate(self._passes):
            begun = (
                [image for image, numbers in self._uses.items() if numbers[0] == number]
                if each.flows
                else []
            )
            if begun:
                images += [self._image(image, y) for image in begun]
                ends.update((image, (y + _IMAGE_HEIGHT, y + _IMAGE_HEIGHT)) for image in begun)
                y += _IMAGE_HEIGHT + _GAP
            flows = [flow for flow in each.flows if flow.image in self._uses]
            height = max(len(flows) * _PORT + 10, 46)
            passes.append(_pass_box(each, y, height))
            first = y + (height - len(flows) * _PORT) // 2 + _PORT - 8
            for port, flow in enumerate(flows):
                at = first + port * _PORT
                arrows.append(self._arrow(each, flow, at))
                ends[flow.image] = (ends[flow.image][0], at)
            y += height + _GAP
        columns = 1 + max(self._columns.values(), default=-1)
        lifelines = [Lifeline(self._x(image), top, bottom) for image, (top, bottom) in ends.items()]
        width = _PASS_WIDTH + _LABEL_WIDTH + columns * _COLUMN + 2 * _MARGIN
        return Drawing(
            width, y - _GAP + _MARGIN, passes, images, lifelines, arrows, self._left_out()
        )

    def _x(self, image: int) -> int:
        """The middle of an image's column."""
        return _MARGIN + _PASS_WIDTH + _LABEL_WIDTH + self._columns[image] * _COLUMN + _COLUMN // 2

    def _image(self, number: int, y: int) -> Box:
        image = self._graph.images[number]
        box = (self._x(number) - _IMAGE_WIDTH // 2, y, _IMAGE_WIDTH, _IMAGE_HEIGHT)
        kind = "multisampled" if (image.samples or 1) > 1 else "single"
        detail = _detail(image)
        title = f"{image.name}: {detail}{_memory(image)}"
        return Box(*box, _cut(image.name, _IMAGE_TEXT), _cut(detail, _IMAGE_TEXT + 2), title, kind)

    def _arrow(self, each: GraphPass, flow: Flow, y: int) -> Arrow:
        width = (
            1.5 if flow.direction == TILE else round(1.5 + 5 * sqrt(flow.bytes / self._largest), 2)
        )
        image = self._graph.images[flow.image].name
        samples = f"{flow.samples}x " if flow.samples is not None else ""
        if flow.direction == TILE:
            label, title = (
                f"{samples}stays on the tile",
                f"{each.name} draws to {image}, which stays on the tile",
            )
        else:
            label = f"{_action(flow, 14)} {samples}· {amount(flow.bytes)}"
            rate = figure(flow.bytes * self._fps / 1e6)
            verb = "writes" if flow.direction == WRITE else "reads"
            title = (
                f"{each.name} {verb} {image} ({_action(flow)}): {amount(flow.bytes)} a frame, "
                f"{rate} MB/s"
            )
        return Arrow(
            _MARGIN + _PASS_WIDTH, self._x(flow.image), y, width, flow.direction, label, title
        )

    def _left_out(self) -> str:
        graph = self._graph
        parts = []
        if len(graph.passes) > MAX_PASSES:
            parts.append(f"the first {MAX_PASSES} of {plural(len(graph.passes), 'pass')}")
        drawn = sum(flow.image in self._uses for each in self._passes for flow in each.flows)
        flows = sum(len(each.flows) for each in graph.passes[:MAX_PASSES])
        if drawn < flows:
            parts.append(f"{drawn} of their {flows} reads and writes")
        return f"The graph shows {' and '.join(parts)}." if parts else ""


def _columns(uses: dict[int, list[int]], passes: int) -> dict[int, int]:
    """The column of each image: the first that is free from its first use to its last."""
    begin: list[list[int]] = [[] for _ in range(passes)]
    end: list[list[int]] = [[] for _ in range(passes)]
    for image, numbers in uses.items():
        begin[numbers[0]].append(image)
        end[numbers[-1]].append(image)
    free: list[int] = []
    columns: dict[int, int] = {}
    count = 0
    for started, ended in zip(begin, end, strict=True):
        for image in started:
            if not free:
                heappush(free, count)
                count += 1
            columns[image] = heappop(free)
        for image in ended:
            heappush(free, columns[image])
    return columns


def _pass_box(each: GraphPass, y: int, height: int) -> Box:
    words = {"renderPass": "render pass", "rendering": "rendering", "command": "command"}[each.kind]
    times = f", {each.times} times" if each.times != 1 else ""
    size = sum(flow.bytes for flow in each.flows)
    words += f", {amount(size)}" if size else ""
    title = f"{each.name}: {words}{times}"
    kind = "command" if each.kind == "command" else "pass"
    return Box(
        _MARGIN, y, _PASS_WIDTH, height, _cut(each.name, _PASS_TEXT), words + times, title, kind
    )


def _detail(image: GraphImage) -> str:
    return (
        " ".join(
            [f"{image.samples}x" if image.samples is not None else "", image.format or ""]
        ).strip()
        or "format unknown"
    )


def _memory(image: GraphImage) -> str:
    if image.committed is None:
        return ""
    return (
        f", {figure(image.committed / 2**20)} MiB"
        if image.committed
        else ", no memory (lazily allocated)"
    )


def _action(flow: Flow, room: int = 4096) -> str:
    return f"resolve of {_cut(flow.source, room)}" if flow.source else flow.action


def _cut(text: str, room: int) -> str:
    return text if len(text) <= room else text[: room - 1] + "…"


def amount(size: int) -> str:
    """Bytes in words: `118 MB`, `64 kB`."""
    for unit, factor in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if size >= factor:
            return (
                f"{size / factor:.3g} {unit}"
                if size < 1e3 * factor
                else f"{size / factor:.0f} {unit}"
            )
    return f"{size} B"
