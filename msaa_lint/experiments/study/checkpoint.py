"""The folder that a sweep resumes from: a file for each point and each time.

The name of a file depends on everything that its contents depend on (text, size, precision,
version). A file that cannot be read is ignored.
"""

from __future__ import annotations

import functools
import json
import os
import re
from collections.abc import Mapping
from hashlib import sha256
from types import UnionType
from typing import Any, get_args, get_type_hints

from msaa_lint.core.atomic_write import write_file
from msaa_lint.core.package import VERSION
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable

from .points import Point, Technique
from .shading import Shading
from .tasks import Task, Unusable
from .times import Cost, CostSource

SCHEMA = "msaa-lint/study-point-v1"
MAX_BYTES = 1 << 16


class Checkpoint:
    """A folder of points and times. Unusable where it cannot be written."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        try:
            os.makedirs(folder, exist_ok=True)
        except OSError as error:
            raise self._unusable(error) from None

    def point(self, task: Task) -> Point | None:
        """The stored point of a task, if any."""
        values = self._read(_key(task), _name(task), Point)
        if values is None or values["scene"] != task.input.name:
            return None
        return Point(**{**values, "technique": task.technique})

    def save_point(self, task: Task, point: Point) -> None:
        """Stores a point."""
        self._write(_key(task), _name(task), point._replace(technique=Technique("", 0)))

    def cost(
        self, source: CostSource, technique: Technique, shading: Shading, size: tuple[int, int]
    ) -> Cost | None:
        """The stored cost of a technique under a cost of shading, if any."""
        values = self._read(
            _cost_key(source, technique, shading, size), f"time-{technique.name}", Cost
        )
        return None if values is None else Cost(**values)

    def save_cost(
        self,
        source: CostSource,
        technique: Technique,
        shading: Shading,
        size: tuple[int, int],
        cost: Cost,
    ) -> None:
        """Stores the cost of a technique under a cost of shading."""
        self._write(_cost_key(source, technique, shading, size), f"time-{technique.name}", cost)

    def _path(self, key: Mapping[str, Any], name: str) -> str:
        digest = sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:16]
        return os.path.join(
            self.folder, f"{re.sub('[^A-Za-z0-9]+', '-', name)[-60:].strip('-')}-{digest}.json"
        )

    def _read(
        self, key: Mapping[str, Any], name: str, kind: type[Point] | type[Cost]
    ) -> dict[str, Any] | None:
        try:
            data = json.loads(read(self._path(key, name), MAX_BYTES, self.folder))
        except (OSError, ValueError, RecursionError):
            return None
        values = (
            data.get("values")
            if isinstance(data, dict) and data.get("schema") == SCHEMA and data.get("key") == key
            else None
        )
        if not isinstance(values, dict) or set(values) != set(kind._fields):
            return None
        hints = get_type_hints(kind)
        values = {name: _tuple(value) for name, value in values.items()}
        return (
            values if all(_has_type(value, hints[name]) for name, value in values.items()) else None
        )

    def _write(self, key: Mapping[str, Any], name: str, values: Point | Cost) -> None:
        data = {"schema": SCHEMA, "key": key, "values": values._asdict()}
        try:
            write_file(self._path(key, name), json.dumps(data, sort_keys=True).encode())
        except OSError as error:
            raise self._unusable(error) from None

    def _unusable(self, error: OSError) -> Unusable:
        return Unusable(f"--resume {self.folder}: {error.strerror}")


def _tuple(value: Any) -> Any:
    """A JSON value with tuples instead of lists."""
    return tuple(map(_tuple, value)) if isinstance(value, list) else value


def _has_type(value: object, hint: Any) -> bool:
    """Whether a value has the type of a member: a scalar, an optional one, or a tuple; that of
    techniques is not checked.
    """
    if hint is float:
        return type(value) in (int, float)
    if hint in (int, str, bool, type(None)):
        return type(value) is hint
    if isinstance(hint, UnionType):
        return any(_has_type(value, option) for option in get_args(hint))
    elements = get_args(hint)
    if not elements or not isinstance(value, tuple):
        return isinstance(value, tuple)
    if elements[-1] is ...:
        return all(_has_type(each, elements[0]) for each in value)
    return len(value) == len(elements) and all(map(_has_type, value, elements))


def _name(task: Task) -> str:
    return f"{task.input.name}-{task.technique.name}"


def _key(task: Task) -> dict[str, Any]:
    """Everything that a point depends on."""
    subject = task.input
    content = (
        _contents(subject.path)
        if subject.kind == "mesh"
        else subject.text.encode("utf-8", "surrogatepass")
    )
    return {
        "version": VERSION,
        "kind": subject.kind,
        "name": subject.name,
        "content": sha256(content).hexdigest(),
        "document": subject.number,
        "technique": list(task.technique),
        "size": [task.width, task.height],
        "bits": task.bits,
        "ssim": task.ssim,
        "flip": task.flip,
    }


@functools.lru_cache(maxsize=4)
def _contents(path: str) -> bytes:
    from .scenes import mesh

    try:
        return read(path, mesh.MAX_BYTES, None)
    except (OSError, Unreadable):
        return b""


def _cost_key(
    source: CostSource, technique: Technique, shading: Shading, size: tuple[int, int]
) -> dict[str, Any]:
    # Calibrations of the same cost differ a little from run to run.
    return {
        "version": VERSION,
        "source": identity(source),
        "technique": list(technique),
        "shading": shading.name,
        "size": list(size),
    }


def identity(source: CostSource) -> list[Any]:
    """Everything that the answers of a source depend on: the device, the triangles, and the
    parameters of the cost model.
    """
    model = getattr(source, "model", source)
    parameters = [
        source.name,
        getattr(source, "content", ""),
        *(getattr(model, name, None) for name in ("hdr", "depth", "fps")),
    ]
    return [*parameters, repr(getattr(model, "device", None))]
