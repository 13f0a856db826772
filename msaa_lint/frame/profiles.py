"""Which device is meant: the one that a description names or describes, what `--profile` and the
configuration's `profile` name.

A name is a built-in device's, a class of devices', a vendor's, or the path of a report
(`devices/reports`); `phone.json#2` and `phone.json#Mali-G715` pick one of several devices in a
report. Of reports nothing is imported before one is named.
"""

import os
import stat
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.project import Outside, folder_of, project_root, real_path, resolved
from msaa_lint.core.quote import quoted_path
from msaa_lint.core.suggestions import nearest
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable, decode
from msaa_lint.core.urls import is_url

from .devices import DeviceProfile, builtin, names
from .devices.paths import ENDINGS, is_path, split
from .facts.words import WORDS

if TYPE_CHECKING:
    from .description.models import Description
    from .devices.reports import Report

MAX_LISTED = 1000
"""Files of a folder that are looked at for the name that was meant."""


class Problem(NamedTuple):
    """Why no device can be had: the code of a finding at the place that names it, in words, and
    what may help.
    """

    code: str
    message: str
    help: str = ""


def device_of(name: str | None) -> DeviceProfile | None:
    """The device that descriptions without one are judged for; None where there is none of that
    name (`profile_of` says why).
    """
    found = profile_of(name) if name is not None else None
    return found if isinstance(found, DeviceProfile) else None


def profile_of(name: str, project: str | None = None) -> DeviceProfile | Problem:
    """The device that `--profile` or a configuration names; of a vendor's only that is known. Paths
    count from the current folder.

    `project` is that of the configuration, in which a report must be; None for `--profile`.
    """
    found = builtin(name)
    if found is not None:
        return found
    if name in WORDS["vendor"]:
        return DeviceProfile(
            name=name, vendor=name, minimum=True, source="only the vendor is known"
        )
    if is_path(name):
        return _reported(name, os.curdir, project)
    close = nearest(name, known_profiles())
    help = (
        f"did you mean `{close}`?"
        if close
        else f"there are {', '.join(known_profiles())}, and paths of device reports"
    )
    return Problem("MSAA904", f"no profile {quoted_path(name)}", help)


def known_profiles() -> tuple[str, ...]:
    """Every name that `profile_of` knows, paths aside."""
    return (*names(), *WORDS["vendor"])


def replace_captured(description: "Description", default: DeviceProfile | None) -> None:
    """Replaces the device that a frame was captured on by the given one, if any, in memory that the
    program would choose there.

    A program that prefers lazily allocated memory takes other memory where there is none, so that
    of its images is then unknown.
    """
    from .description.models import Device

    captured = description.device
    if default is None or not isinstance(captured, Device) or not captured.captured:
        return
    description.device = None
    if any("LAZILY_ALLOCATED" in flags for flags in captured.memoryTypes or ()):
        return
    for image in description.images.values():
        image.memory = None


def device_for(
    description: "Description", file: str, default: DeviceProfile | None
) -> DeviceProfile | Problem | None:
    """The device that a description names or describes, or the family of Metal's GPUs that it
    states, else the given one.

    A path counts from the folder of the description's `file` (a name that is no path, such as
    `<stdin>`: from the current folder) and must stay in its project: a description may come from a
    stranger's branch. A Problem is one of the description, at its `device`.
    """
    from .description.models import Device
    from .facts.global_facts import described, of_family

    stated = description.device
    if stated is None:
        return of_family(description) or default
    if isinstance(stated, Device):
        return described(stated)
    found = builtin(stated)
    if found is not None:
        return found
    if is_path(stated):
        folder = folder_of(file)
        return _reported(stated, folder, project_root(folder))
    return Problem(
        "MSAA904", f"no device {quoted_path(stated)}", f"built-in devices: {', '.join(names())}"
    )


def _reported(name: str, folder: str, project: str | None) -> DeviceProfile | Problem:
    """The device of a report that a name is the path of. `project` is None for a path of the
    command line.
    """
    path, which = split(name)
    found = reports(os.path.join(folder, path), path, project)
    if isinstance(found, Problem):
        return found
    from .devices.reports import pick

    report = pick(found, which)
    if report is not None:
        return report.profile
    there = ", ".join(
        f"`{path}#{number}` is {each.profile.name}" for number, each in enumerate(found[:8], 1)
    )
    if which:
        return Problem("MSAA904", f"no device {quoted_path(which)} in {quoted_path(path)}", there)
    return Problem("MSAA903", f"{quoted_path(path)} has {len(found)} devices: say which", there)


def reports(path: str, called: str, project: str | None) -> "list[Report] | Problem":
    """The devices of a report's file. `called` is what messages and the profiles' sources call it;
    `project` is None for a path of the command line.
    """
    from .devices.reports import EXPECTED, MAX_BYTES, NotAReport

    try:
        if project is not None and is_url(project):
            return parsed(read(path, MAX_BYTES, project), called)
        real = resolved(path) if project is None else real_path(path, project)
        status = os.stat(path if project is None else real)
        # A pipe changes as it is read.
        version = (status.st_mtime_ns, status.st_size) if stat.S_ISREG(status.st_mode) else (0, 0)
        key = (real, called, *version)
        if key not in _read:
            _read[key] = parsed(read(path, MAX_BYTES, project), called)
        return _read[key]
    except Outside:
        return Problem(
            "MSAA903",
            f"{quoted_path(called)} is outside the project",
            "only --profile on the command line can name such a file",
        )
    except FileNotFoundError:
        return Problem("MSAA904", f"no file {quoted_path(called)}", _near(path, called))
    except Unreadable:
        reason = f"it is larger than {MAX_BYTES >> 20} MiB"
    except NotAReport as error:
        return Problem("MSAA903", f"{quoted_path(called)}: {error}", f"expected {EXPECTED}")
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return Problem("MSAA903", f"{quoted_path(called)} cannot be read: {reason}")


_read: "dict[tuple[str, str, int, int], list[Report]]" = {}


def parsed(data: bytes, called: str) -> "list[Report]":
    """The devices of a report's bytes. NotAReport where it is none."""
    from .devices.reports import NotAReport, read

    try:
        return read(decode(data), called)
    except Unreadable as error:
        raise NotAReport(str(error)) from None


def _near(path: str, called: str) -> str:
    """What may have been meant by the path of a file that is not there."""
    folder, name = os.path.split(path)
    if is_url(folder):
        return f"built-in devices: {', '.join(names())}"
    try:
        with os.scandir(folder or os.curdir) as entries:
            there = [
                entry.name
                for entry, _ in zip(entries, range(MAX_LISTED), strict=False)
                if entry.name.endswith(ENDINGS)
            ]
    except OSError:
        return f"the folder {quoted_path(os.path.dirname(called))} is not there"
    close = nearest(name, sorted(there))
    if close is not None:
        return f"did you mean `{called[: len(called) - len(name)]}{close}`?"
    return f"built-in devices: {', '.join(names())}"
