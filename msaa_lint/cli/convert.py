"""`msaa-lint convert`: a capture, or what states a frame in other words, as a description that one can read, edit, fix and confirm."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from typing import TYPE_CHECKING

from msaa_lint.core.text.source import Source, Unreadable, decode
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.input.opening import load
from msaa_lint.input.source_file import SourceFile

from .report.escape import visible

if TYPE_CHECKING:
    from msaa_lint.frame.description.document import Document


def convert(path: str, output: str | None, format: str | None, force: bool) -> int:
    """Writes the description to a file, or prints it; with a file, the code of the shaders that it names into `shaders/` beside it.

    2 where the input cannot be read, has mistakes or is a plain description; and where a capture cannot be read to its end: what could be
    read of it is written all the same.
    """
    try:
        made = load(path, Limits(), format=format)
    except (OSError, Unreadable) as error:
        return _failed(path, getattr(error, "strerror", None) or str(error))
    if isinstance(made, bytes):
        return _text(path, made, output, format, force)
    if isinstance(made, SourceFile):
        return _program(path, made, output, force)
    if not _output(made.source.text, made.modules, output, force):
        return 2
    for note in made.notes:
        print(f"msaa-lint: {visible(note)}", file=sys.stderr)
    return _failed(path, f"the capture ends in the middle: {made.broken}") if made.broken else 0


def _text(path: str, data: bytes, output: str | None, format: str | None, force: bool) -> int:
    """Writes the descriptions that the documents of a text give, one after another."""
    from msaa_lint.core.text.emitter import written
    from msaa_lint.input import readers

    name = "<stdin>" if path == "-" else path
    try:
        source = Source(name, decode(data))
    except Unreadable as error:
        return _failed(path, str(error))
    parsed = parse(source, Limits())
    documents: list[Document] = [readers.read(source, root, format) for root in parsed.documents]
    mistakes = [(each.code, each.message, each.span) for each in parsed.problems]
    mistakes += [(each.code, each.message, each.span) for document in documents for each in document.problems]
    for code, message, span in mistakes:
        line, column = source.position(span.start)
        print(f"{visible(name)}:{line}:{column}: {visible(message)} ({code})", file=sys.stderr)
    if mistakes:
        return 2
    if all(each.tree is None for each in documents):
        return _failed(path, "this is no capture: what `check` reads as it stands needs no conversion")
    trees = [each.tree if each.tree is not None else root for each, root in zip(documents, parsed.documents, strict=True)]
    return 0 if _output("---\n".join(map(written, trees)), {}, output, force) else 2


def _program(path: str, code: SourceFile, output: str | None, force: bool) -> int:
    """Writes what was read of source code, a document for each of its parts. What had to be assumed is said beside it."""
    from msaa_lint.core.text.emitter import written

    name = visible(code.source.name)
    trees = [document.tree for document in code.program.documents if document.tree is not None]
    if not trees:
        return _failed(path, "nothing is read in it: no attachment, image, pipeline or sample count")
    for number, notes in enumerate(code.program.assumed):
        where = f"{name}, document {number + 1}" if len(trees) > 1 else name
        for note in notes:
            print(f"msaa-lint: {where}: {visible(note)}", file=sys.stderr)
    head = f"# Read in {name}: what is not stated is not known.\n"
    modules = {name: module for document in code.program.documents for name, module in document.modules.items()}
    return 0 if _output(head + "---\n".join(map(written, trees)), modules, output, force) else 2


def _output(text: str, modules: Mapping[str, bytes], output: str | None, force: bool) -> bool:
    """Writes a description and the modules that it names, or prints it; False, and a line that says why, where that cannot be."""
    if output is None or output == "-":
        sys.stdout.write(text)
        if modules:
            print(f"msaa-lint: {len(modules)} shaders are left out: -o FILE writes them beside the description", file=sys.stderr)
    elif os.path.lexists(output) and not force:
        _failed(output, "it exists already: --force writes over it")
        return False
    else:
        try:
            _write(output, text.encode())
            for name, code in modules.items():
                target = os.path.join(os.path.dirname(output), *name.split("/"))
                os.makedirs(os.path.dirname(target) or os.curdir, exist_ok=True)
                _write(target, code)
        except OSError as error:
            _failed(output, error.strerror or str(error))
            return False
    return True


def _write(path: str, data: bytes) -> None:
    with open(path, "wb") as file:
        file.write(data)


def _failed(path: str, why: str) -> int:
    print(f"msaa-lint: {visible(path)}: {visible(why)}", file=sys.stderr)
    return 2
