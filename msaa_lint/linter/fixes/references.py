"""The records of a description, and those of them that name an image or a texture."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from msaa_lint.frame.description.models import Command
from msaa_lint.frame.description.record import Record


def nested_records(value: object) -> Iterator[Record]:
    """All records in a value, including the value itself."""
    if isinstance(value, Record):
        yield value
        for member in value.SHAPE if not isinstance(value, Command) else ("body",):
            yield from nested_records(getattr(value, member))
    elif isinstance(value, tuple):
        for item in value:
            yield from nested_records(item)
    elif isinstance(value, dict):
        for item in value.values():
            yield from nested_records(item)


class References:
    """The records below `root` that name entries of a section, such as `images` or
    `metal.textures`.
    """

    def __init__(self, root: Record, section: str) -> None:
        self._section = section
        self._members: dict[type[Record], list[str]] = {}
        self._records: dict[str, list[Record]] = {}
        for record in nested_records(root):
            for name in self._names(record):
                self._records.setdefault(name, []).append(record)

    def _names(self, record: Record) -> Iterator[str]:
        kind = type(record)
        if kind not in self._members:
            self._members[kind] = [
                member for member, shape in kind.SHAPE.items() if _holds_names(shape, self._section)
            ]
        for member in self._members[kind]:
            if isinstance(record, Command):
                value = record.body if record.kind == member else None
            else:
                value = getattr(record, member)
            yield from (
                name
                for name in (value if isinstance(value, tuple) else (value,))
                if isinstance(name, str)
            )

    def records(self, name: str) -> list[Record]:
        """The records that name an entry, one item per reference."""
        return self._records.get(name, [])

    def has_others(self, name: str, records: Iterable[Record]) -> bool:
        """Whether any record outside `records` names an entry."""
        identities = {id(record) for record in records}
        return any(id(record) not in identities for record in self.records(name))


def _holds_names(shape: object, section: str) -> bool:
    if not isinstance(shape, tuple):
        return False
    return shape == ("name", section) or any(_holds_names(part, section) for part in shape)
