"""Text of an input as messages show it: never longer than a limit."""

MAX_LENGTH = 80


def shortened(text: str, limit: int = MAX_LENGTH) -> str:
    """The text, cut to `limit` characters with an ellipsis at the end if it is longer."""
    return text if len(text) <= limit else f"{text[: limit - 1]}…"


def quoted(text: str, limit: int = MAX_LENGTH) -> str:
    """The text in backticks, shortened to `limit` characters."""
    return f"`{shortened(text, limit)}`"
