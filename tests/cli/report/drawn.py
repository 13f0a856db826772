"""What an SVG file shows, and where: texts, marks, and panels, as boxes in its pixels."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple
from xml.etree import ElementTree

import vl_convert

from msaa_lint.cli.report.figure import FONT
from msaa_lint.cli.report.labels import Box

SVG = "{http://www.w3.org/2000/svg}"
_NUMBER = r"-?\d+(?:\.\d+)?(?:e-?\d+)?"


class Shape(NamedTuple):
    """A text, or a mark, whose `kind` is the role of the group that it is in; and the corners of a
    rule or a line.
    """

    kind: str
    box: Box
    text: str = ""
    corners: tuple[tuple[float, float], ...] = ()


class Drawing:
    """The shapes of a file."""

    def __init__(self, data: bytes) -> None:
        root = ElementTree.fromstring(data)
        self.width, self.height = float(root.attrib["width"]), float(root.attrib["height"])
        self.texts: list[Shape] = []
        self.marks: list[Shape] = []
        self.panels: list[Box] = []
        self._read(root, 0.0, 0.0, "")

    @property
    def names(self) -> list[Shape]:
        """The labels within panels."""
        return [text for text in self.texts if "role-mark" in text.kind]

    def words(self) -> list[str]:
        """All texts."""
        return [shape.text for shape in self.texts]

    def marks_of(self, kind: str) -> list[Shape]:
        """The symbols, rules, lines, or rects within panels."""
        return [mark for mark in self.marks if mark.kind.startswith(f"mark-{kind} ")]

    def _read(self, element: ElementTree.Element, x: float, y: float, kind: str) -> None:
        turned = "rotate(-90" in element.get("transform", "")
        for dx, dy in re.findall(
            rf"translate\(({_NUMBER}),({_NUMBER})\)", element.get("transform", "")
        ):
            # After the turn, `along` the text is up.
            x, y = (x, y) if turned and (dx, dy) == ("0", "-2") else (x + float(dx), y + float(dy))
        name = element.get("class", "")
        kind = name if name.startswith("mark-") else kind
        if element.tag == f"{SVG}text":
            for line in element.findall(f"{SVG}tspan") or [element]:
                y += float(line.get("dy", 0))
                self.texts.append(
                    Shape(kind, _text_box(element, line.text or "", x, y, turned), line.text or "")
                )
            return
        if (
            element.tag == f"{SVG}path"
            and name == "background"
            and "h0v0" not in element.get("d", "")
        ):
            self.panels.append(_path_box(element.get("d", ""), x, y))
        elif element.tag == f"{SVG}path" and "role-mark" in kind and not name:
            path = element.get("d", "")
            corners = [
                (x + float(a), y + float(b))
                for a, b in re.findall(rf"[ML]({_NUMBER}),({_NUMBER})", path)
            ]
            self.marks.append(Shape(kind, _path_box(path, x, y), corners=tuple(corners)))
        elif element.tag == f"{SVG}line" and "role-mark" in kind:
            end_x, end_y = x + float(element.get("x2", 0)), y + float(element.get("y2", 0))
            box = Box(min(x, end_x), min(y, end_y), max(x, end_x), max(y, end_y))
            self.marks.append(Shape(kind, box, corners=((x, y), (end_x, end_y))))
        elif element.tag == f"{SVG}image":
            self.marks.append(
                Shape(
                    kind,
                    Box(
                        x,
                        y,
                        x + float(element.attrib["width"]),
                        y + float(element.attrib["height"]),
                    ),
                )
            )
        for child in element:
            self._read(child, x, y, kind)


def overlaps(boxes: list[Box], others: list[Box] | None = None) -> Iterator[tuple[Box, Box]]:
    """The pairs that have an area in common."""
    for number, one in enumerate(boxes):
        for other in boxes[number + 1 :] if others is None else others:
            if one.meets(other):
                yield one, other


@cache
def width_of(text: str, weight: str) -> float:
    """The width of a text of size 1, as vl-convert measures it: that of a picture that shows
    nothing else.
    """
    mark = {
        "type": "text",
        "text": text,
        "fontSize": 200,
        "fontWeight": weight,
        "align": "left",
        "x": 0,
        "y": 0,
        "limit": 0,
    }
    spec = {
        "data": {"values": [{}]}, "mark": mark, "width": 1, "height": 1, "padding": 0,
        "config": {"font": FONT},
        "view": {"stroke": None},
    }  # fmt: skip
    return float(ElementTree.fromstring(vl_convert.vegalite_to_svg(spec)).attrib["width"]) / 200


def _text_box(element: ElementTree.Element, text: str, x: float, y: float, turned: bool) -> Box:
    size = float(element.attrib["font-size"].removesuffix("px"))
    width = width_of(text, element.get("font-weight", "normal")) * size
    before = {"start": 0.0, "middle": width / 2, "end": width}[element.get("text-anchor", "start")]
    # From the top of capitals to the baseline.
    return (
        Box(x - 0.72 * size, y - width + before, x, y + before)
        if turned
        else Box(x - before, y - 0.72 * size, x - before + width, y)
    )


def _path_box(path: str, x: float, y: float) -> Box:
    """A box about a path of lines, and of arcs about its place."""
    at = 0.0, 0.0
    places: list[tuple[float, float]] = []
    for command, text in re.findall(r"([MLlhHvVA])([^MLlhHvVAZ]*)", path):
        numbers = [float(number) for number in re.findall(_NUMBER, text)]
        if command in "hH":
            at = numbers[0] + (at[0] if command == "h" else 0), at[1]
        elif command in "vV":
            at = at[0], numbers[0] + (at[1] if command == "v" else 0)
        elif command == "A":
            at = numbers[5], numbers[6]
            places += [(0, -numbers[1]), (0, numbers[1])]
        else:
            at = (
                (at[0] + numbers[0], at[1] + numbers[1])
                if command == "l"
                else (numbers[0], numbers[1])
            )
        places.append(at)
    if not places:
        return Box(x, y, x, y)
    across, down = zip(*places, strict=True)
    return Box(x + min(across), y + min(down), x + max(across), y + max(down))
