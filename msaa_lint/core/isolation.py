"""Keeps files of the working folder, a stranger's checkout perhaps, from being imported or run by
this process and those that it starts.

`python -m`, an empty entry of PYTHONPATH, and `.` in PATH all name the working folder. What an
absolute path names is the user's choice.
"""

import os
import sys

from .package import FOLDER


def isolate() -> None:
    """Removes the working folder from where this process and its child processes look for modules
    and programs.

    If this package itself is in the working folder, `sys.path` stays as it is: the packages that it
    needs may be there too.
    """
    os.environ["PYTHONSAFEPATH"] = "1"
    # Windows looks for programs in the working folder first.
    os.environ["NODEFAULTCURRENTDIRECTORYINEXEPATH"] = "1"
    _keep_absolute("PATH")
    if _is_current_folder(os.path.dirname(FOLDER)):
        return
    stated = _keep_absolute("PYTHONPATH")
    current = [
        number for number, path in enumerate(sys.path) if _is_current_folder(path or os.curdir)
    ]
    if any(map(_is_current_folder, stated)):
        # `python -m` puts the working folder before the entries of PYTHONPATH.
        current = current[:-1]
    for number in reversed(current):
        del sys.path[number]


def import_path() -> list[str]:
    """`sys.path` for a child process: the absolute entries, and the folder of this package."""
    return list(dict.fromkeys([*filter(os.path.isabs, sys.path), os.path.dirname(FOLDER)]))


def _keep_absolute(variable: str) -> list[str]:
    """Removes relative and empty paths from an environment variable, and returns the others."""
    paths = list(filter(os.path.isabs, os.environ.pop(variable, "").split(os.pathsep)))
    # Without any entry, an empty PATH would name the working folder.
    if paths:
        os.environ[variable] = os.pathsep.join(paths)
    return paths


def _is_current_folder(path: str) -> bool:
    try:
        return os.path.samefile(path, os.curdir)
    except (OSError, ValueError):
        return False
