"""Reports of devices: what tools print of a GPU, read into profiles. The format is told by content,
never by a file's name.

A dialect is a module with `claims` and `read`; it knows where the dialect has what. `reading.py`
knows what it means.
"""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

from . import devsim, gpuinfo, profiles_json, vkjson, vulkaninfo_text
from .members import Details, Found, Report
from .reading import report

__all__ = ["EXPECTED", "MAX_BYTES", "Details", "NotAReport", "Report", "pick", "read"]

JSON: tuple[ModuleType, ...] = (profiles_json, gpuinfo, vkjson, devsim)
"""The dialects in JSON, in the order in which they are asked."""

MAX_BYTES = 8 << 20
"""Of a report. The largest seen, of a driver that lists video formats, has one MiB."""

EXPECTED = (
    "vulkaninfo (text or --json), a Vulkan profile, a report of gpuinfo.org, vkjson or devsim JSON"
)


class NotAReport(ValueError):
    """The text is not a device report, or lacks the limits of the device; the message says
    which.
    """


def read(text: str, file: str = "") -> list[Report]:
    """The devices of a report, at least one. `file` is what the profiles' sources call it.

    NotAReport where it is none. A member of a wrong type is unknown, and a note of its report.
    """
    return [report(found, file) for found in _found(text)]


def _found(text: str) -> list[Found]:
    start = text.lstrip()[:1]
    if start not in ("{", "["):
        if not vulkaninfo_text.claims(text):
            raise NotAReport("it is not a device report")
        made = vulkaninfo_text.read(text)
        if not made:
            raise NotAReport("it has no GPU in it")
        if not any("framebufferColorSampleCounts" in found.members for found in made):
            raise NotAReport("it has no limits in it: `vulkaninfo` without --summary prints them")
        return made
    import json

    try:
        root = json.loads(text)
    except RecursionError:
        raise NotAReport("its JSON is nested too deeply") from None
    except json.JSONDecodeError as error:
        from msaa_lint.core.text.json_errors import json_problem

        said = json_problem(text, error.pos).message
        raise NotAReport(
            f"its JSON is broken at line {error.lineno}, column {error.colno}: {said}"
        ) from None
    except ValueError:
        raise NotAReport("its JSON has a number that is too long") from None
    module = next(
        (module for module in JSON if isinstance(root, dict) and module.claims(root)), None
    )
    if module is None:
        raise NotAReport("it is not a device report")
    found: list[Found] = module.read(root)
    if not found:
        raise NotAReport("it has no device in it")
    if not any(each.minimum or "framebufferColorSampleCounts" in each.members for each in found):
        raise NotAReport("it has no sample counts in it")
    return found


def pick(reports: Sequence[Report], which: str) -> Report | None:
    """The device with a number (from 1) or a name; without either, the only one or the only one
    that is not a CPU. None otherwise.
    """
    if which.isascii() and which.isdigit() and len(which) < 4:
        return reports[int(which) - 1] if 0 < int(which) <= len(reports) else None
    if which:
        return next((each for each in reports if each.profile.name.lower() == which.lower()), None)
    left = (
        list(reports)
        if len(reports) == 1
        else [each for each in reports if each.details.device_type != "CPU"]
    )
    return left[0] if len(left) == 1 else None
