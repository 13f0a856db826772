"""The folder that a sweep resumes from: a file for each point and each time, written whole or not at all.

What was made otherwise (of another text, size, precision, version) has another name; what cannot be read is had anew.
"""

from __future__ import annotations

import contextlib
import functools
import json
import os
import re
from collections.abc import Mapping
from hashlib import sha256
from types import UnionType
from typing import Any, get_args, get_type_hints

from msaa_lint.core.package import VERSION

from .points import Point, Technique
from .tasks import Task, Unusable
from .times import Cost, Source

SCHEMA = "msaa-lint/study-point-v1"
MAX_BYTES = 1 << 16


class Kept:
    """A folder of points. Unusable where it cannot be written."""

    def __init__(self, folder: str) -> None:
        self.folder = folder
        try:
            os.makedirs(folder, exist_ok=True)
        except OSError as error:
            raise Unusable(f"--resume {folder}: {error.strerror}") from None

    def point(self, task: Task) -> Point | None:
        """The point of a task, if it is there."""
        key = _key(task)
        found = self._read(key, f"{task.asked.name}-{task.technique.name}", Point)
        if found is None:
            return None
        found["technique"] = task.technique
        effects = found["effects"]
        found["effects"] = tuple(map(str, effects)) if isinstance(effects, list) else ()
        return Point(**found)

    def keep_point(self, task: Task, point: Point) -> None:
        """Writes a point down."""
        self._write(_key(task), f"{task.asked.name}-{task.technique.name}", point._replace(technique=Technique("", 0)))

    def cost(self, source: Source, technique: Technique, size: tuple[int, int]) -> Cost | None:
        """What a technique was found to take, if it is there."""
        found = self._read(_cost_key(source, technique, size), f"time-{technique.name}", Cost)
        return None if found is None else Cost(**found)

    def keep_cost(self, source: Source, technique: Technique, size: tuple[int, int], cost: Cost) -> None:
        """Writes down what a technique takes."""
        self._write(_cost_key(source, technique, size), f"time-{technique.name}", cost)

    def _path(self, key: Mapping[str, Any], name: str) -> str:
        digest = sha256(json.dumps(key, sort_keys=True).encode()).hexdigest()[:16]
        return os.path.join(self.folder, f"{re.sub('[^A-Za-z0-9]+', '-', name)[-60:].strip('-')}-{digest}.json")

    def _read(self, key: Mapping[str, Any], name: str, kind: type[Point] | type[Cost]) -> dict[str, Any] | None:
        try:
            with open(self._path(key, name), encoding="utf-8") as file:
                data = json.loads(file.read(MAX_BYTES))
        except (OSError, ValueError, RecursionError):
            return None
        values = data.get("values") if isinstance(data, dict) and data.get("schema") == SCHEMA and data.get("key") == key else None
        if not isinstance(values, dict) or set(values) != set(kind._fields):
            return None
        hints = get_type_hints(kind)
        return values if all(_fits(value, hints[name]) for name, value in values.items()) else None

    def _write(self, key: Mapping[str, Any], name: str, values: Point | Cost) -> None:
        path = self._path(key, name)
        beside = f"{path}.{os.getpid()}.tmp"
        try:
            with open(beside, "w", encoding="utf-8", newline="\n") as file:
                json.dump({"schema": SCHEMA, "key": key, "values": values._asdict()}, file, sort_keys=True)
            os.replace(beside, path)
        except OSError as error:
            raise Unusable(f"--resume {self.folder}: {error.strerror}") from None
        finally:
            with contextlib.suppress(OSError):
                os.unlink(beside)


def _fits(value: object, hint: Any) -> bool:
    """Whether a value of JSON is of a member's type; of lists and objects nothing is asked here."""
    if hint is float:
        return type(value) in (int, float)
    if hint in (int, str, bool, type(None)):
        return type(value) is hint
    return any(_fits(value, each) for each in get_args(hint)) if isinstance(hint, UnionType) else isinstance(value, (list, dict))


def _key(task: Task) -> dict[str, Any]:
    """What a point depends on."""
    asked = task.asked
    content = asked.text.encode("utf-8", "surrogatepass")
    if asked.kind == "mesh":
        content = _bytes(asked.path)
    return {
        "version": VERSION,
        "kind": asked.kind,
        "name": asked.name,
        "content": sha256(content).hexdigest(),
        "document": asked.number,
        "technique": list(task.technique),
        "size": [task.width, task.height],
        "bits": task.bits,
        "ssim": task.ssim,
    }


@functools.lru_cache(maxsize=4)
def _bytes(path: str) -> bytes:
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError:
        return b""


def _cost_key(source: Source, technique: Technique, size: tuple[int, int]) -> dict[str, Any]:
    return {"version": VERSION, "source": identity(source), "technique": list(technique), "size": list(size)}


def identity(source: Source) -> list[Any]:
    """What a source's answers depend on: whose clock and which triangles, and what the model takes a frame to be."""
    model = getattr(source, "model", source)
    named = [source.name, getattr(source, "content", ""), *(getattr(model, name, None) for name in ("hdr", "depth", "fps"))]
    return [*named, repr(getattr(model, "device", None))]
