"""What `msaa-lint study` is asked to study: scenes by name, meshes, documents of descriptions, each with its picture."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.experiments.study.tasks import StudyInput
from msaa_lint.frame.devices import DeviceProfile

from .common import MOST_PIXELS, Mistake, settings

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding
    from msaa_lint.frame.facts.frame import Frame

SIZE = (1920, 1080)
MESHES = (".obj", ".ply")


class Subject(NamedTuple):
    """What is studied. `picture` is its scene; of a description there are its frame, its file and the device that it is judged for."""

    input: StudyInput
    picture: Any
    device: DeviceProfile | None = None
    frame: Frame | None = None
    file: str = ""


class Subjects(NamedTuple):
    """All of them, the size in pixels that they are studied at, findings that say what cannot be studied, and lines for the standard error
    stream."""

    pixels: tuple[int, int]
    subjects: list[Subject]
    wrong: list[Finding]
    notes: list[str]


def subjects(given: Mapping[str, Any], size: tuple[int, int] | None) -> Subjects:
    """What the arguments name, at the size that they state, if they do. Mistake where one names nothing."""
    from msaa_lint.experiments.study.scenes import NAMES

    named: list[StudyInput] = []
    paths: list[str] = []
    for path in dict.fromkeys(given["paths"]):
        if path in NAMES:
            named.append(StudyInput("scene", path))
        elif path.lower().endswith(MESHES) and os.path.isfile(path):
            named.append(StudyInput("mesh", path, path))
        elif path == "-" or os.path.lexists(path):
            paths.append(path)
        else:
            raise Mistake(_unknown(path, NAMES))
    read = _descriptions(paths, given)
    default = _profile(given)
    pixels = size or _stated([each.frame for each in read.inputs] if not named else []) or SIZE
    found = [Subject(each, _picture(each, pixels), default) for each in named]
    for own in read.inputs:
        name = own.file if own.many == 1 else f"{own.file}#{own.number + 1}"
        text = own.frame.document.source.text
        described = StudyInput("description", name, own.file, text, own.number, given.get("input_format"))
        found.append(Subject(described, _picture(described, pixels), own.device or default, own.frame, own.file))
    return Subjects(pixels, found, read.wrong, read.notes)


def _picture(asked: StudyInput, pixels: tuple[int, int]) -> Any:
    """The scene of what is asked for. Mistake where it cannot be had."""
    from msaa_lint.experiments.study.sweep import picture

    try:
        return picture(asked, *pixels)
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package in ("", "msaa_lint"):
            raise
        raise Mistake(f"study needs {package}, which is not installed: pip install 'msaa-lint[study]'") from None
    except (OSError, ValueError, LookupError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise Mistake(f"{asked.name}: {reason}") from None


def _unknown(word: str, names: Sequence[str]) -> str:
    from msaa_lint.core.suggestions import nearest

    close = nearest(word, names)
    help = f"did you mean {close}?" if close else f"scenes are {', '.join(names)}"
    return f"no scene and no file {word[:80]!r}; {help}"


def _descriptions(paths: Sequence[str], given: Mapping[str, Any]) -> Any:
    from msaa_lint.experiments.confirm.inputs import Inputs, inputs
    from msaa_lint.linter.run import Request

    if not paths:
        return Inputs([], [], [])
    return inputs(
        Request(
            paths=paths,
            overrides=settings(given),
            config=given.get("config"),
            isolated=bool(given.get("isolated")),
            format=given.get("input_format"),
            stdin_filename=given.get("stdin_filename"),
        )
    )


def _profile(given: Mapping[str, Any]) -> DeviceProfile | None:
    from msaa_lint.frame.profiles import Problem, profile_of

    if "profile" not in given:
        return None
    found = profile_of(given["profile"])
    if isinstance(found, Problem):
        raise Mistake(f"--profile: {found.message}" + (f"; {found.help}" if found.help else ""))
    return found


def _stated(frames: Sequence[Frame]) -> tuple[int, int] | None:
    """The size that all descriptions state, where it is one and can be drawn."""
    sizes = {(each.description.frame.width, each.description.frame.height) if each.description.frame else (None, None) for each in frames}
    (width, height) = sizes.pop() if len(sizes) == 1 else (None, None)
    return (width, height) if width and height and max(width, height) <= MOST_PIXELS else None
