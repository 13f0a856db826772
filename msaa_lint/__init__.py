"""msaa-lint finds multisampling mistakes in Vulkan frames.

`lint` is the Python interface; everything else is internal and may change.
"""

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
    select: "Iterable[str] | None" = None,
    extend_select: "Iterable[str]" = (),
    ignore: "Iterable[str]" = (),
    rules: "Iterable[str]" = (),
    profile: str | None = None,
    edition: str | None = None,
    config: str | None = None,
    isolated: bool = False,
) -> "Result":
    """Lints files and folders, or a `text` with the name `filename`, as `msaa-lint check` does; the
    other arguments are its options.

    The location of a finding is a span of offsets into `result.sources[finding.file].text`;
    `Source.position` converts an offset to a line and a column. A problem of an input, a rule page
    or the configuration is a finding (MSAA9xx), never an exception.
    """
    from .linter.request import Request
    from .linter.run import run

    overrides = {
        "select": select, "extend_select": extend_select, "ignore": ignore, "rules": rules,
        "profile": profile, "edition": edition,
    }  # fmt: skip
    data = text.encode("utf-8", "surrogatepass") if isinstance(text, str) else text
    inputs = [*paths, "-"] if text is not None else paths
    return run(
        Request(
            inputs,
            overrides,
            config,
            isolated,
            stdin_filename=filename if text is not None else None,
            data=data,
        )
    ).result
