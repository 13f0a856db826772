"""File names as outputs display them."""

from __future__ import annotations

import os

from msaa_lint.core.project import resolved
from msaa_lint.core.urls import is_url

from .escape import escape


def relative(file: str, root: str, resolve: bool = False) -> str:
    """`file` relative to `root`, with `/` between folders; unchanged if it is not below `root` or
    not a file (`-`, `<stdin>`, a URL).

    `resolve` follows symbolic links first.
    """
    name = file.replace(os.sep, "/") if os.sep != "/" else file
    if not root or file == "-" or file.startswith("<") or is_url(file):
        return _without_dot(name)
    try:
        for place in (resolved,) if resolve else (os.path.abspath, resolved):
            full, base = place(file), place(root)
            below = base if base.endswith(os.sep) else base + os.sep
            if full.startswith(below):
                return full[len(below) :].replace(os.sep, "/")
    except (OSError, ValueError):
        pass  # an impossible name, for example with a NUL from a configuration
    return _without_dot(name)


def display_path(file: str, root: str) -> str:
    """`relative`, escaped for a text output. CI runners obey lines that begin with `::`, so a name
    that could begin such a line, together with the colon that follows it, is prefixed with `./`.
    """
    path = escape(relative(file, root))
    return "./" + path if path.lstrip().startswith((":", "##")) else path


def uri(file: str, root: str) -> str:
    """A URI reference relative to `root`, percent-encoded as UTF-8; a `file:` URI if the file is
    not below `root`; a URL as it is.
    """
    if is_url(file):
        scheme, _, rest = file.partition("://")
        return f"{scheme}://{_percent(rest)}"
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
    from urllib.parse import quote

    try:
        return quote(path, errors="surrogateescape")
    except UnicodeEncodeError:
        return quote(path, errors="surrogatepass")
