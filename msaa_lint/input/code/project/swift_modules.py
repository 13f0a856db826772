"""The modules of Swift: the folders whose files, with those in their subfolders, see each other."""

from __future__ import annotations

import os
import posixpath

_SOURCES = ("Sources", "Source", "src", "srcs", "Tests")
"""The folders of a package that have a folder for each module (Swift Package Manager,
Target.path).
"""

_PROJECTS = (".xcodeproj", ".xcworkspace", ".podspec")


class SwiftModules:
    """The modules of the files of a project, whose folder is `root`."""

    def __init__(self, root: str) -> None:
        self.root = os.path.abspath(root)
        self._kinds: dict[str, str] = {}

    def folder(self, path: str) -> str:
        """Returns the folder of the module of a file: that of its package's target, or of its Xcode
        project, pod, or playground; empty if there is none.
        """
        folder = posixpath.dirname(path)
        below: list[str] = []
        while os.path.abspath(folder).startswith(self.root):
            if folder.endswith(".playground") or self._kind(folder) == "project":
                return folder
            if self._kind(folder) == "package":
                names = below[::-1]
                return (
                    posixpath.join(folder, *names[:2])
                    if len(names) > 1 and names[0] in _SOURCES
                    else folder
                )
            parent = posixpath.dirname(folder)
            if parent == folder:
                break
            below.append(posixpath.basename(folder))
            folder = parent
        return ""

    def _kind(self, folder: str) -> str:
        """Returns `package` or `project` for a folder with the manifest of one, otherwise an empty
        string.
        """
        if folder not in self._kinds:
            try:
                names = os.listdir(folder or os.curdir)
            except OSError:
                names = []
            is_project = any(name.endswith(_PROJECTS) for name in names)
            self._kinds[folder] = (
                "package" if "Package.swift" in names else "project" if is_project else ""
            )
        return self._kinds[folder]
