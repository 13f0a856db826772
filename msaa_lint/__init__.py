"""msaa-lint finds the multisampling mistakes in a Vulkan frame.

`lint` is the whole Python interface; everything else is internal and may change.
"""

from __future__ import annotations

from .core.package import VERSION as __version__

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from .core.finding import Result

__all__ = ["__version__", "lint"]


def lint(
    *paths: str,
    text: str | bytes | None = None,
    filename: str = "<text>",
    select: Iterable[str] | None = None,
    extend_select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    rules: Iterable[str] = (),
    profile: str | None = None,
    edition: str | None = None,
    config: str | None = None,
    isolated: bool = False,
) -> Result:
    """What `msaa-lint check` finds in files and folders, or in a `text` that is called `filename`.

    Findings have places as offsets into `result.sources[finding.file].text`; `Source.position` turns them into lines and columns. A
    mistake in an input, a page or the configuration is a finding (MSAA9xx), never an exception. The other arguments are the command's
    options.
    """
    from .linter.run import run
    from .linter.workspace import Request

    overrides = {
        "select": select, "extend_select": extend_select, "ignore": ignore, "rules": rules, "profile": profile, "edition": edition,
    }  # fmt: skip
    data = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    given = [*paths, "-"] if text is not None else paths
    return run(Request(given, overrides, config, isolated, stdin_filename=filename if text is not None else None, data=data)).result
