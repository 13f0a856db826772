"""`msaa-lint convert`: a capture as a description that one can read, edit, fix and confirm."""

from __future__ import annotations

import os
import sys

from ..inputs import load
from ..report.escape import visible
from ..source.text import Unreadable
from ..source.tree import Limits


def convert(path: str, output: str | None, format: str | None, force: bool) -> int:
    """Writes the description to a file, or prints it; with a file, the code of the shaders that it names into `shaders/` beside it.

    2 where the capture cannot be read, or not to its end: what could be read of it is written all the same.
    """
    try:
        made = load(path, Limits(), format=format)
    except (OSError, Unreadable) as error:
        return _failed(path, getattr(error, "strerror", None) or str(error))
    if isinstance(made, bytes):
        return _failed(path, "this is no capture: what `check` reads as it stands needs no conversion")
    if output is None or output == "-":
        sys.stdout.write(made.source.text)
        if made.modules:
            print(f"msaa-lint: {len(made.modules)} shaders are left out: -o FILE writes them beside the description", file=sys.stderr)
    elif os.path.lexists(output) and not force:
        return _failed(output, "it exists already: --force writes over it")
    else:
        try:
            _write(output, made.source.text.encode())
            for name, code in made.modules.items():
                target = os.path.join(os.path.dirname(output), *name.split("/"))
                os.makedirs(os.path.dirname(target), exist_ok=True)
                _write(target, code)
        except OSError as error:
            return _failed(output, error.strerror or str(error))
    for note in made.notes:
        print(f"msaa-lint: {visible(note)}", file=sys.stderr)
    return _failed(path, f"the capture ends in the middle: {made.broken}") if made.broken else 0


def _write(path: str, data: bytes) -> None:
    with open(path, "wb") as file:
        file.write(data)


def _failed(path: str, why: str) -> int:
    print(f"msaa-lint: {visible(path)}: {visible(why)}", file=sys.stderr)
    return 2
