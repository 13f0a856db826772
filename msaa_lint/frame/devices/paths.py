"""Words that name a device: whether one is the path of a report, and which device of that report it
picks.
"""

from __future__ import annotations

ENDINGS = (".json", ".txt", ".xml")


def is_path(name: str) -> bool:
    """Whether a name is a path: it has a slash, or the ending of a report's file. No built-in
    device's has.
    """
    path, _ = split(name)
    return path.endswith(ENDINGS) or "/" in path or "\\" in path


def split(name: str) -> tuple[str, str]:
    """The path, and the device that `path#device` picks by its number from 1 on or by its name;
    empty where it picks none.
    """
    path, mark, device = name.rpartition("#")
    if (
        not mark
        or not path
        or "/" in device
        or "\\" in device
        or (device.endswith(ENDINGS) and not path.endswith(ENDINGS))
    ):
        return name, ""
    return path, device
