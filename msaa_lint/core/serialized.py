"""Values of known types as bytes."""

from __future__ import annotations

import io
import pickle
from collections.abc import Mapping
from typing import Any

PROTOCOL = 5
"""The version of the format, so that it does not depend on that of Python."""


def dumps(value: object) -> bytes:
    """Returns a value as bytes. Raises RecursionError if it nests too deeply."""
    return pickle.dumps(value, PROTOCOL)


def by_name(*types: type) -> dict[tuple[str, str], type]:
    """Returns types by the names that bytes have for them."""
    return {(kind.__module__, kind.__name__): kind for kind in types}


def loads(data: bytes, types: Mapping[tuple[str, str], type]) -> object:
    """Returns the value that bytes hold, of built-in types and those that `types` has for its
    names. Raises ValueError for other bytes, and RecursionError.
    """
    try:
        return _Reader(data, types).load()
    except RecursionError:
        raise
    except Exception as error:
        raise ValueError(str(error)) from None


class _Reader(pickle.Unpickler):
    """Reads values of known types. It looks no other name up, so that nothing that the bytes state
    is executed.
    """

    def __init__(self, data: bytes, types: Mapping[tuple[str, str], type]) -> None:
        super().__init__(io.BytesIO(data))
        self._types = types

    def find_class(self, module: str, name: str) -> Any:
        kind = self._types.get((module, name))
        if kind is None:
            raise ValueError(f"unexpected type {module}.{name}")
        return kind
