"""The environment of child processes that run native code, a Vulkan driver or a converter: what
they need, and no path into the project in the working folder.

The loader runs whatever library a manifest names, with all rights of the user, and a checkout may
contain manifests and libraries.
"""

from __future__ import annotations

import os
from collections.abc import Mapping

from .project import Outside, project_root, real_path

_LOADER_PATHS = frozenset({
    "VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES", "VK_LAYER_PATH",
    "VK_ADD_LAYER_PATH", "VK_IMPLICIT_LAYER_PATH",
    "VK_ADD_IMPLICIT_LAYER_PATH", "VK_LAYER_SETTINGS_PATH",
})  # fmt: skip
"""Where the loader finds drivers and layers, and layers their settings."""

_PATHS = _LOADER_PATHS | {
    "PATH", "HOME", "TMPDIR", "LD_LIBRARY_PATH", "DYLD_LIBRARY_PATH", "DYLD_FALLBACK_LIBRARY_PATH",
    "LIBGL_DRIVERS_PATH",
    "MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME", "XDG_CONFIG_DIRS",
    "XDG_CONFIG_HOME", "XDG_DATA_DIRS",
    "XDG_DATA_HOME", "XDG_RUNTIME_DIR",
}  # fmt: skip

_NAMES = _PATHS | {
    "APPDATA", "COMSPEC", "DISPLAY", "DRI_PRIME", "LANG", "LANGUAGE", "LOCALAPPDATA", "LOGNAME",
    "NODEFAULTCURRENTDIRECTORYINEXEPATH",
    "PROGRAMDATA", "PROGRAMFILES", "SYSTEMDRIVE", "SYSTEMROOT", "TEMP", "TMP", "TZ", "USER",
    "USERNAME", "USERPROFILE",
    "WAYLAND_DISPLAY", "WINDIR", "XAUTHORITY",
}  # fmt: skip

_PREFIXES = (
    "AMD_", "ANV_", "CUDA_", "DISABLE_", "GALLIUM_", "INTEL_", "LC_", "LIBGL_", "LP_", "MESA_",
    "NVIDIA_", "NVK_", "RADV_", "TU_", "VK_",
    "__GL_", "__NV_", "__VK_",
)  # fmt: skip
"""Of settings of the loader, the layers and the drivers. `DISABLE_` is how implicit layers are
disabled.
"""


def child_environment() -> dict[str, str]:
    """The variables that the loader, the layers and the drivers need. Of lists of paths, those
    that are relative or lead into the project are left out; so is any other variable that leads
    into it.
    """
    return _filtered(os.environ, project_root(os.curdir))


def ignored_paths() -> list[str]:
    """What to tell the user about paths of drivers and layers that are left out, one line per
    variable.
    """
    root = project_root(os.curdir)
    used = _filtered(os.environ, root)
    ignored = [
        name
        for name in sorted(_LOADER_PATHS)
        if os.environ.get(name) and os.environ[name] != used.get(name)
    ]
    return [
        f"{name}: paths that are relative or in the project {root} are ignored: name drivers and "
        "layers outside it"
        for name in ignored
    ]


def _filtered(stated: Mapping[str, str], root: str) -> dict[str, str]:
    variables = {}
    for name, value in stated.items():
        if name.upper() not in _NAMES and not name.startswith(_PREFIXES):
            continue
        entries = value.split(os.pathsep)
        if name in _PATHS:
            kept = [
                entry for entry in entries if os.path.isabs(entry) and not _is_inside(entry, root)
            ]
            # An empty VK_LAYER_PATH would be the default one instead of no layer.
            if kept or name == "VK_LAYER_PATH":
                variables[name] = os.pathsep.join(kept) or os.devnull
        elif not any(os.path.isabs(entry) and _is_inside(entry, root) for entry in entries):
            variables[name] = value
    return variables


def _is_inside(path: str, root: str) -> bool:
    try:
        real_path(path, root)
    except (OSError, Outside):
        return False
    return True
