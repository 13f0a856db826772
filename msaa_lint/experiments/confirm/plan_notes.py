"""Notes on a plan: what was assumed or left out, in words."""

from __future__ import annotations

MAX_NAMES = 3
"""Names that a note lists at most."""


class Notes:
    """Notes in the order of their first occurrence. Notes that differ only in the name of an object
    are one.
    """

    def __init__(self) -> None:
        self._names: dict[str, dict[str, None]] = {}

    def append(self, text: str, name: str = "") -> None:
        """Adds a note; `{}` in its text stands for `name`, if there is one."""
        names = self._names.setdefault(text, {})
        if name:
            names[name] = None

    def lines(self) -> tuple[str, ...]:
        """The notes as texts."""
        return tuple(
            text.replace("{}", _listed(list(names))) if names else text
            for text, names in self._names.items()
        )


def _listed(names: list[str]) -> str:
    shown = (
        names
        if len(names) <= MAX_NAMES + 1
        else [*names[:MAX_NAMES], f"{len(names) - MAX_NAMES} more"]
    )
    return " and ".join([", ".join(shown[:-1]), shown[-1]]) if len(shown) > 1 else shown[0]
