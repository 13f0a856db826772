"""What `msaa-lint study` studies: scenes by name, meshes, and the documents of descriptions, each
with its scene.
"""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from os.path import abspath, isfile, lexists
from typing import Any, NamedTuple

from msaa_lint.core import urls
from msaa_lint.core.diagnostics import diagnostic, internal_error
from msaa_lint.core.extras import needs_extra
from msaa_lint.core.finding import Finding
from msaa_lint.core.quote import quoted
from msaa_lint.experiments.confirm.inputs import Input, Inputs, inputs
from msaa_lint.experiments.confirm.vulkan_errors import Unusable as NoDevice
from msaa_lint.experiments.study.tasks import StudyInput, Unusable
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.profiles import Problem, profile_of
from msaa_lint.linter.request import Request

from .common import MAX_RENDER_SIDE, UsageError, input_options, overrides
from .options import Arguments

SIZE = (1920, 1080)

MIN_SIDE = 200
"""The least width and height of a frame, in pixels, that a scene is as large as if the description
does not state the size.
"""

MESHES = (".obj", ".ply")


class Subject(NamedTuple):
    """One scene to study. `picture` is the scene; a description also has a frame, a file, and the
    device to assume.
    """

    input: StudyInput
    picture: Any
    device: DeviceProfile | None = None
    frame: Frame | None = None
    file: str = ""


class Subjects(NamedTuple):
    """All of them, the size in pixels to study them at, findings about inputs that cannot be used,
    and notes for standard error.
    """

    size: tuple[int, int]
    subjects: list[Subject]
    errors: list[Finding]
    notes: list[str]


def subjects(arguments: Arguments, size: tuple[int, int] | None) -> Subjects:
    """What the arguments name, at the given size, else at the size that all descriptions state.
    UsageError if a word names nothing.
    """
    from msaa_lint.experiments.study.scenes import NAMES

    named: list[StudyInput] = []
    paths: list[str] = []
    for path in dict.fromkeys(arguments["paths"]):
        if path in NAMES:
            named.append(StudyInput("scene", path))
        elif path.lower().endswith(MESHES) and urls.is_url(path) and urls.problem(path) is None:
            name = urls.name_of(path)
            named.append(StudyInput("mesh", name, name))
        elif path.lower().endswith(MESHES) and isfile(path):
            # Workers may have another working folder.
            named.append(StudyInput("mesh", path, abspath(path)))
        elif path == "-" or lexists(path) or urls.is_url(path):
            paths.append(path)
        else:
            raise UsageError(_unknown(path, NAMES))
    read = Inputs([], [], [])
    if paths:
        read = inputs(
            Request(**{**input_options(arguments), "paths": paths}, overrides=overrides(arguments))
        )
    default = _profile(arguments)
    size = size or (None if named else _stated_size(read.inputs)) or SIZE
    errors = list(read.wrong)
    studied = []

    def add(study_input: StudyInput, *more: Any) -> None:
        with errors_of(study_input.name, errors, arguments):
            studied.append(Subject(study_input, _picture(study_input, size), *more))

    for study_input in named:
        add(study_input, default)
    for document in read.inputs:
        name = document.file if document.many == 1 else f"{document.file}#{document.number + 1}"
        text = document.frame.document.source.text
        study_input = StudyInput(
            "description", name, document.file, text, document.number, arguments.get("input_format")
        )
        add(study_input, document.device or default, document.frame, document.file)
    return Subjects(size, studied, errors, read.notes)


@contextmanager
def errors_of(name: str, errors: list[Finding], arguments: Arguments) -> Iterator[None]:
    """Makes an internal error of one scene a finding, so that the others are studied; with
    `--traceback`, it is raised.
    """
    try:
        yield
    except (UsageError, MemoryError, Unusable, NoDevice):
        raise
    except _Unreadable as error:
        errors.append(diagnostic("MSAA901", str(error), name))
    except Exception as error:
        if arguments.get("traceback"):
            raise
        errors.append(diagnostic("MSAA941", internal_error(error), name))


class _Unreadable(Exception):
    """An input that is not a scene; the message is for the user."""


def _picture(study_input: StudyInput, size: tuple[int, int]) -> Any:
    """The scene. _Unreadable if the input is not one, and UsageError if a package is missing."""
    from msaa_lint.experiments.study.sweep import picture

    try:
        return picture(study_input, *size)
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package in ("", "msaa_lint"):
            raise
        raise UsageError(needs_extra("msaa-lint study", "study")) from None
    except (OSError, ValueError, LookupError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        # Of a scene by name, only the size can be wrong.
        raise (
            UsageError(f"{study_input.name}: {reason}")
            if study_input.kind == "scene"
            else _Unreadable(reason)
        ) from None


def _unknown(word: str, names: Sequence[str]) -> str:
    from msaa_lint.core.suggestions import nearest

    close = nearest(word, names)
    hint = f"did you mean `{close}`?" if close else f"scenes are {', '.join(names)}"
    return f"no scene or file {quoted(word)}; {hint}"


def _profile(arguments: Arguments) -> DeviceProfile | None:
    if "profile" not in arguments:
        return None
    profile = profile_of(arguments["profile"])
    if isinstance(profile, Problem):
        raise UsageError(
            f"{profile.message} in `--profile`" + (f": {profile.help}" if profile.help else "")
        )
    return profile


def _stated_size(documents: Sequence[Input]) -> tuple[int, int] | None:
    """The size of all descriptions; None if they differ, state none, or it is too large or, of
    images alone, too small.
    """
    sizes = {_frame_size(document.frame) for document in documents}
    width, height = sizes.pop() if len(sizes) == 1 else (0, 0)
    return (width, height) if width and height and max(width, height) <= MAX_RENDER_SIDE else None


def _frame_size(frame: Frame) -> tuple[int, int]:
    """The size of a frame as stated, otherwise that of the passes that techniques are about; 0
    without any.
    """
    from msaa_lint.experiments.study.frame_plans import described_size

    stated = frame.description.frame
    if stated is not None and stated.width is not None and stated.height is not None:
        return stated.width, stated.height
    width, height = described_size(frame) or (0, 0)
    return (width, height) if min(width, height) >= MIN_SIDE else (0, 0)
