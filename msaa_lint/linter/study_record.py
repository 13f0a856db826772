"""Reads the record that `msaa-lint study --record` writes next to a description, and compares it
with the frame.

A record has digests of everything that the result of a study depends on. It may come from an
untrusted branch, so it is limited and validated.
"""

import math
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.quote import quoted
from msaa_lint.frame.facts.study import STALE, UNSTUDIED, UNUSABLE, Measured, Studied

if TYPE_CHECKING:
    from msaa_lint.core.text.tree import Node
    from msaa_lint.frame.description.record import Record
    from msaa_lint.frame.facts.frame import Frame

ENDING = ".msaa-study.json"
SCHEMA = "msaa-lint/study-record-v2"
WITHOUT_SHADING = "msaa-lint/study-record-v1"
"""The schema of records that do not say under which cost of shading they were made."""

DEFAULT_SHADING = "medium"
"""The cost of shading that rules where a description does not state its own (`scene.shading`)."""

AS_DESCRIBED = "as described"
"""The cost of shading of a frame that is timed with its own fragment shaders."""

PARTS = ("attachments", "device", "pipelines", "scene", "shaders", "size")
"""The parts of a description that the result of a study depends on."""

COUNTS = (1, 2, 4, 8, 16, 32, 64)
MAX_BYTES = 1 << 18
MAX_DEPTH = 8
MAX_NODES = 20_000
MAX_TEXT = 200
MAX_MODULES = 64
"""Shader modules whose content counts; of the others, and of those above the limit of their size,
only the names do.
"""

MAX_MODULE_BYTES = 1 << 22

_PIPELINE = ("multisampleState", "colorBlendState", "depthStencilState")
_LEFT_OUT = frozenset({"rasterizationSamples", "shading"})


class Unusable(Exception):
    """The problem of an unusable record, and its node."""

    def __init__(self, reason: str, at: "Node | None" = None) -> None:
        super().__init__(reason)
        self.at = at


class _Outdated(Exception):
    """A record does not say under which cost of shading it was made."""


class Shading(NamedTuple):
    """The cost of shading under which techniques were timed: its name, and what it adds to a full
    screen at one sample, in milliseconds, if that is known.
    """

    name: str
    full_screen_ms: float | None


class Entry(NamedTuple):
    """The study of one document: digests by part, the device of its times (or empty), the cost of
    shading (None without times), the error that compares sample counts, size in pixels, results by
    sample count.
    """

    inputs: dict[str, str]
    device: str
    shading: Shading | None
    error_of: str
    size: tuple[int, int]
    counts: "dict[int, _Count]"


def path_of(file: str) -> str:
    """The path of the record of a description."""
    return file + ENDING


def studied(frame: "Frame", file: str) -> Studied:
    """Compares the record of a description with its frame. `file` is the path of the description,
    or a name such as `<stdin>`.
    """
    path = path_of(file)
    try:
        if not os.path.lexists(path):
            return UNSTUDIED
        entries = _read(path)
    except Unusable as error:
        return Studied(UNUSABLE, str(error))
    except _Outdated:
        return Studied(STALE, f"it was made without a cost of shading; {_AGAIN}")
    current, stated = digests(frame, file), stated_shading(frame)
    same = [entry for entry in entries if entry.inputs == current]
    # Without times, the cost of shading does not matter.
    found = next(
        (
            entry
            for entry in same
            if entry.shading is None
            or entry.shading.name in (stated or DEFAULT_SHADING, AS_DESCRIBED)
        ),
        None,
    )
    if found is not None:
        measured = ", ".join(f"{count}x" for count in sorted(found.counts))
        counts = {
            count: Measured(found.counts[count].justified, _says(count, found, stated))
            for count in sorted(found.counts)
        }
        return Studied("", f"it measured {measured}", counts)
    if same and same[0].shading is not None:
        expected = (
            f"scene.shading is {stated}"
            if stated is not None
            else f"without scene.shading, {DEFAULT_SHADING} counts"
        )
        return Studied(
            STALE,
            f"it was made under {quoted(same[0].shading.name, 40)} shading, and {expected}; "
            f"{_AGAIN}",
        )
    nearest = min(entries, key=lambda entry: len(_changed(entry, current)))
    return Studied(STALE, f"{_listed(_changed(nearest, current))} changed since; {_AGAIN}")


_AGAIN = "run `msaa-lint study --record` again"


def stated_shading(frame: "Frame") -> str | None:
    """The cost of shading that a description states; None if it states none."""
    scene = frame.description.scene
    return scene.shading if scene is not None else None


def _changed(entry: Entry, current: dict[str, str]) -> list[str]:
    return [part for part in PARTS if entry.inputs[part] != current[part]]


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def digests(frame: "Frame", file: str) -> dict[str, str]:
    """Digests by part of what a study of a frame depends on; `file` is the path of its description.

    That excludes sample counts, of which a study measures several, the cost of shading, which is
    compared by its name, names, load and store operations, layouts, memory, and images that nothing
    is rendered to.
    """
    from hashlib import sha256

    return {
        part: sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:16]
        for part, text in inputs(frame, file).items()
    }


def inputs(frame: "Frame", file: str) -> dict[str, str]:
    """The text by part of what a study of a frame depends on."""
    description = frame.description
    size = description.frame
    states = (
        [(member, _canonical(getattr(pipeline, member))) for member in _PIPELINE]
        for pipeline, _ in frame.pipelines
    )
    return {
        "attachments": repr(sorted(set(map(repr, _attachments(frame))))),
        "device": repr(_canonical(description.device)),
        "pipelines": repr(sorted(set(map(repr, states)))),
        # A scene that states nothing is none.
        "scene": repr(_canonical(description.scene) or None),
        "shaders": repr(sorted(set(_fragment_shaders(frame, file)))),
        "size": repr((size.width, size.height) if size is not None else None),
    }


def _attachments(frame: "Frame") -> Iterator[object]:
    """Formats and encodings of multisampled images, whether other color targets are encoded, and
    resolve modes.
    """
    for target in frame.all_targets:
        encoding = target.image.encoding if target.image is not None else None
        usage = target.image.usage if target.image is not None else None
        if target.samples is not None and target.samples > 1:
            yield target.format.name if target.format is not None else None, encoding
        elif usage is None or "COLOR_ATTACHMENT" in usage:
            yield target.format is not None and target.format.is_srgb, encoding == "GAMMA"
    for render_pass in frame.passes:
        for subpass in render_pass.subpasses:
            yield from ((resolve.aspect, resolve.mode) for resolve in subpass.resolves)


def _fragment_shaders(frame: "Frame", file: str) -> Iterator[str]:
    """The stages of fragment shaders, with the content of their modules."""
    from hashlib import sha256

    from msaa_lint.core.project import folder_of, project_root
    from msaa_lint.core.text.files import read
    from msaa_lint.core.text.source import Unreadable

    folder = folder_of(file)
    contents: dict[str, str] = {}
    for stage in (
        stage
        for pipeline, _ in frame.pipelines
        for stage in pipeline.stages
        if stage.stage == "FRAGMENT"
    ):
        name = stage.module or ""
        if name and name not in contents and len(contents) < MAX_MODULES:
            try:
                contents[name] = sha256(
                    read(os.path.join(folder, name), MAX_MODULE_BYTES, project_root(folder))
                ).hexdigest()
            except (OSError, Unreadable, ValueError):
                contents[name] = ""
        yield repr((_canonical(stage), contents.get(name)))


def _canonical(value: object) -> object:
    """A value in a form that is the same for every spelling and order with the same meaning."""
    shape = getattr(type(value), "SHAPE", None)
    if shape is not None:
        record: Record = value  # type: ignore[assignment]
        members = [(name, getattr(record, name)) for name in sorted(shape) if name not in _LEFT_OUT]
        return [
            (name, _canonical(member))
            for name, member in members
            if member != getattr(type(record), name, None)
        ]
    if isinstance(value, dict):
        return sorted((str(key), _canonical(member)) for key, member in value.items())
    if isinstance(value, (list, tuple)):
        return [_canonical(member) for member in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def _read(path: str) -> list[Entry]:
    """The studies of a record. Raises Unusable if it is invalid."""
    from msaa_lint.core.project import project_root
    from msaa_lint.core.text.files import read
    from msaa_lint.core.text.source import Source, Unreadable, decode
    from msaa_lint.core.text.tree import Limits, parse

    name = os.path.basename(path)
    try:
        source = Source(
            name, decode(read(path, MAX_BYTES, project_root(os.path.dirname(path) or os.curdir)))
        )
    except Unreadable as error:
        raise Unusable(f"{name}: {str(error).replace('the input', 'it')}") from None
    except OSError as error:
        raise Unusable(f"{name} cannot be read: {error.strerror or error}") from None
    parsed = parse(source, Limits(depth=MAX_DEPTH, nodes=MAX_NODES))
    for problem in parsed.problems:
        place = source.position(problem.span.start)
        raise Unusable(f"{name}, line {place.line}: {problem.message}")
    try:
        if len(parsed.documents) != 1:
            raise Unusable("expected one JSON object")
        return list(_entries(parsed.documents[0]))
    except Unusable as error:
        at = f", line {source.position(error.at.start).line}" if error.at is not None else ""
        raise Unusable(f"{name}{at}: {error}") from None


def _entries(root: "Node") -> Iterator[Entry]:
    schema, studies = _members(root, ("schema", "studies"))
    if schema.value == WITHOUT_SHADING:
        raise _Outdated
    if schema.value != SCHEMA:
        raise Unusable(f'expected the schema "{SCHEMA}"', schema)
    if studies.kind != "sequence" or not studies.value:
        raise Unusable("`studies` must be a list with at least one element", studies)
    for node in studies.value:
        parts, device, shading, error_of, size, counts = _members(
            node, ("inputs", "device", "shading", "error_of", "size", "counts")
        )
        digests = dict(zip(PARTS, (_text(part) for part in _members(parts, PARTS)), strict=True))
        if size.kind != "sequence" or len(size.value) != 2:
            raise Unusable("`size` must be a list of width and height", size)
        width, height = (_pixels(side) for side in size.value)
        entry = Entry(
            digests,
            _text(device),
            _shading(shading),
            _text(error_of),
            (width, height),
            _counts(counts),
        )
        if entry.shading is None and any(
            count.time_ms is not None for count in entry.counts.values()
        ):
            raise Unusable("times need a cost of shading", shading)
        yield entry


def _shading(node: "Node") -> Shading | None:
    if node.kind == "scalar" and node.value is None:
        return None
    name, full_screen = _members(node, ("name", "full_screen_ms"))
    return Shading(_text(name), None if full_screen.value is None else _number(full_screen))


class _Count(NamedTuple):
    error: float
    time_ms: float | None
    justified: bool
    reason: str


def _counts(node: "Node") -> dict[int, _Count]:
    if node.kind != "mapping" or not node.value:
        raise Unusable("`counts` must be an object with at least one sample count", node)
    known = {str(count): count for count in COUNTS}
    found: dict[int, _Count] = {}
    for key, value in node.value.items():
        if key not in known:
            raise Unusable(f"{quoted(key, 20)} is not a sample count", node.keys[key])
        error, time, justified, reason = _members(
            value, ("error", "time_ms", "justified", "reason")
        )
        if not isinstance(justified.value, bool):
            raise Unusable("`justified` must be true or false", justified)
        time_ms = None if time.value is None else _number(time)
        found[known[key]] = _Count(_number(error), time_ms, justified.value, _text(reason))
    return found


def _says(count: int, entry: Entry, stated: str | None) -> str:
    """The result of a study for a sample count, compared with the largest count up to 4."""
    measured = entry.counts[count]
    base = max((samples for samples in entry.counts if samples <= 4), default=None)
    where = f"at {entry.size[0]}x{entry.size[1]}" + (f" on {entry.device}" if entry.device else "")
    if entry.shading is not None:
        screen = (
            []
            if entry.shading.full_screen_ms is None
            else [f"{entry.shading.full_screen_ms:.3g} ms a full screen"]
        )
        notes = ", ".join([*screen, *(["the default"] if stated is None else [])])
        cost = (
            f"under {entry.shading.name} shading"
            if entry.shading.name != AS_DESCRIBED
            else "with its own fragment shaders"
        )
        where += f" {cost}" + (
            f" ({notes})" if notes and entry.shading.name != AS_DESCRIBED else ""
        )
    where += f"; {measured.reason}" if measured.reason else ""
    if base is None or base == count:
        return f"its {entry.error_of} is {measured.error:.3g} {where}"
    reference = entry.counts[base]
    if reference.error > 0:
        error = (
            f"it leaves {100 * measured.error / reference.error:.0f} % of {base}x's "
            f"{entry.error_of}"
        )
    else:
        error = f"{base}x has no {entry.error_of} to lose"
    if measured.time_ms is None or not reference.time_ms:
        return f"{error}, at no known time, {where}"
    return f"{error} for {measured.time_ms / reference.time_ms:.2g} times its time {where}"


def _members(node: "Node", expected: tuple[str, ...]) -> "list[Node]":
    """The members of an object, which must have these names and no others."""
    if node.kind != "mapping":
        raise Unusable(f"expected an object with {', '.join(expected)}", node)
    for key in node.value:
        if key not in expected:
            raise Unusable(f"unknown key {quoted(key, 40)}", node.keys[key])
    missing = [name for name in expected if name not in node.value]
    if missing:
        raise Unusable(f"missing {', '.join(missing)}", node)
    return [node.value[name] for name in expected]


def _text(node: "Node") -> str:
    if node.kind != "scalar" or not isinstance(node.value, str) or len(node.value) > MAX_TEXT:
        raise Unusable(f"expected a string of at most {MAX_TEXT} characters", node)
    return node.value


def _pixels(node: "Node") -> int:
    if type(node.value) is not int or not 1 <= node.value < 1 << 31:
        raise Unusable("expected a positive integer number of pixels", node)
    return node.value


def _number(node: "Node") -> float:
    if type(node.value) not in (int, float) or not 0 <= node.value < math.inf:
        raise Unusable("expected a number of at least 0", node)
    return float(node.value)
