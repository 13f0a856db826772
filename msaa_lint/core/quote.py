"""Text of an input as messages show it: never longer than a limit."""

MAX_LENGTH = 80
MAX_PATH_LENGTH = 120


def shortened(text: str, limit: int = MAX_LENGTH) -> str:
    """The text, cut to `limit` characters with an ellipsis at the end if it is longer."""
    return text if len(text) <= limit else f"{text[: limit - 1]}…"


def quoted(text: str, limit: int = MAX_LENGTH) -> str:
    """The text in backticks, shortened to `limit` characters."""
    return f"`{shortened(text, limit)}`"


def quoted_path(path: str) -> str:
    """A path in backticks, shortened only if it is unusually long."""
    return quoted(path, MAX_PATH_LENGTH)
