"""File names as outputs show them."""

from __future__ import annotations

import os

from .escape import visible


def relative(file: str, root: str, resolve: bool = False) -> str:
    """`file` relative to `root` with `/` between folders, or as given where it is not below `root` or is no file (`-`, `<stdin>`).

    `resolve` follows symbolic links first.
    """
    name = file.replace(os.sep, "/") if os.sep != "/" else file
    if not root or file == "-" or file.startswith("<"):
        return _without_dot(name)
    try:
        for place in (os.path.realpath,) if resolve else (os.path.abspath, os.path.realpath):
            full, base = place(file), place(root)
            below = base if base.endswith(os.sep) else base + os.sep
            if full.startswith(below):
                return full[len(below) :].replace(os.sep, "/")
    except (OSError, ValueError):
        pass  # a name that no file can have, e.g. with a NUL from a configuration
    return _without_dot(name)


def shown_path(file: str, root: str) -> str:
    """`relative` for a text output. A CI runner takes a line that begins with `::` as an order, so a name that could begin one, with the
    colon that comes after it, gets `./` before it."""
    path = visible(relative(file, root))
    return "./" + path if path.lstrip().startswith((":", "##")) else path


def uri(file: str, root: str) -> str:
    """A URI reference relative to `root`, percent-encoded as UTF-8; `file:` where the file is not below `root`."""
    path = relative(file, root, resolve=True)
    if path.startswith("/"):
        return "file://" + _percent(path)
    if path[1:3] == ":/":
        return "file:///" + path[:2] + _percent(path[2:])
    return _percent(path)


def _without_dot(path: str) -> str:
    while path.startswith("./"):
        path = path[2:].lstrip("/")
    return path


def _percent(path: str) -> str:
    try:
        raw = path.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raw = path.encode("utf-8", "surrogatepass")
    plain = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/"
    return "".join(chr(byte) if byte in plain else f"%{byte:02X}" for byte in raw)
