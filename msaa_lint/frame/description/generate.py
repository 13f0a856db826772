"""Writes `records.py`, the shapes that files are read by, from `models`.

    python -m msaa_lint.frame.description.generate [--check]

`--check` writes nothing and exits with 1 where the file is stale.
"""

from __future__ import annotations

import os
import sys
import types
from typing import Annotated, Any, Literal, Union, get_args, get_origin

from annotated_types import Ge, Gt, Le, MaxLen
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from . import metal_models, models
from .fields import MAX_COLOR_ATTACHMENTS, ColorIndex, Count, Counted, Enumerant, FlagBits, NameOf, Null, Slot, SubpassIndex
from .struct import Struct

MARKERS = (Enumerant, FlagBits, NameOf, Count, Counted, Slot, SubpassIndex)

TARGET = os.path.join(os.path.dirname(__file__), "records.py")

HEADER = '''"""The structures of a description as files are read into them.

Generated from models.py by `python -m msaa_lint.frame.description.generate`: do not edit.
"""

from __future__ import annotations

from typing import ClassVar

from .record import Record, Shape
'''


def shape(annotation: Any, metadata: list[Any]) -> tuple[tuple[Any, ...], str]:
    """The shape of a type, and the type that a member read by it has in Python."""
    marker = next((m for m in metadata if isinstance(m, MARKERS)), None)
    match marker:
        case Enumerant():
            return ("enum", marker.enum), "str"
        case FlagBits():
            return ("flags", marker.enum), "tuple[str, ...]"
        case NameOf():
            return ("name", marker.section), "str"
        case Count():
            return ("samples",), "int"
        case Slot():
            return ("slot",), "AttachmentReference"
        case SubpassIndex():
            return ("subpass",), "int | str"
        case Counted():
            item = next(get_args(arm)[0] for arm in get_args(annotation) if get_origin(arm) is tuple)
            return ("counted", shape(item, [])[0]), f"tuple[{item.__name__}, ...]"
    origin = get_origin(annotation)
    if origin is Annotated:
        return shape(get_args(annotation)[0], [*metadata, *get_args(annotation)[1:]])
    if origin is Literal:
        words = get_args(annotation)
        return ("word", words), " | ".join(sorted({type(word).__name__ for word in words}))
    if origin is tuple:
        inner, python = shape(get_args(annotation)[0], [])
        most = next((m.max_length for m in metadata if isinstance(m, MaxLen)), None)
        return ("list", inner, most) if most is not None else ("list", inner), f"tuple[{python}, ...]"
    if origin is dict:
        key, value = get_args(annotation)
        inner, python = shape(value, [])
        if key is ColorIndex:
            return ("numbered", inner, MAX_COLOR_ATTACHMENTS - 1), f"dict[str, {python}]"
        return ("map" if key is str else "numbered", inner), f"dict[str, {python}]"
    if origin in (Union, types.UnionType):
        return _union(list(get_args(annotation)), metadata)
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        if annotation is models.Command:
            return ("command",), "Command"
        if annotation is metal_models.MetalCommand:
            return ("command", "MetalCommand"), "MetalCommand"
        return ("record", annotation.__name__), annotation.__name__
    if annotation is bool:
        return ("bool",), "bool"
    if annotation is str:
        return ("text",), "str"
    if annotation is int:
        low = next((m.ge for m in metadata if isinstance(m, Ge)), None)
        high = next((m.le for m in metadata if isinstance(m, Le)), None)
        return ("int", low, high), "int"
    raise TypeError(f"no shape for {annotation!r} with {metadata!r}")


def _union(arms: list[Any], metadata: list[Any]) -> tuple[tuple[Any, ...], str]:
    nullable = type(None) in arms
    arms = [arm for arm in arms if arm is not type(None)]
    plain = [get_args(arm)[0] if get_origin(arm) is Annotated else arm for arm in arms]
    if set(plain) == {float, int}:
        result: tuple[tuple[Any, ...], str] = ("number", any(isinstance(m, Gt) for m in metadata)), "float"
    elif models.Command in arms:
        result = ("command",), "Command"
    elif len(arms) == 1:
        result = shape(arms[0], metadata)
    else:
        shapes = [shape(arm, []) for arm in arms]
        result = ("either", *(s for s, _ in shapes)), " | ".join(dict.fromkeys(p for _, p in shapes))
    if nullable:
        return ("null", result[0]), f"{result[1]} | None"
    return result


def member(field: FieldInfo) -> tuple[tuple[Any, ...], str, str]:
    """A member's shape, Python type, and what it is where it is absent."""
    found, python = shape(field.annotation, list(field.metadata))
    if found[0] == "null" and not any(isinstance(marker, Null) for marker in field.metadata):
        found = found[1]
    if found[0] == "slot":
        return found, "AttachmentReference | None", "None"
    if field.default in ((), {}):
        return found, python, repr(field.default)
    return found, python if python.endswith("| None") else f"{python} | None", "None"


def source() -> str:
    """The text of records.py."""
    out = [HEADER]
    members = {id(member): member for module in (models, metal_models) for member in vars(module).values()}.values()
    classes = [m for m in members if isinstance(m, type) and issubclass(m, Struct) and m is not Struct]
    # What stands first is inherited from.
    classes.sort(key=lambda model: model.__module__ == metal_models.__name__)
    for model in classes:
        if model in (models.Command, metal_models.MetalCommand):
            out.append(_command(model))
            continue
        fields = {name: member(field) for name, field in model.model_fields.items()}
        doc = (model.__doc__ or "").strip().splitlines()[0]
        out.append(f'\n\nclass {model.__name__}(Record):\n    """{doc}"""\n')
        slots = ", ".join(repr(name) for name in sorted(fields))
        out.append(f"    __slots__ = ({slots}{',' if len(fields) == 1 else ''})\n")
        out.append("    SHAPE: ClassVar[dict[str, Shape]] = {\n")
        out.extend(f"        {name!r}: {found!r},\n" for name, (found, _, _) in fields.items())
        out.append("    }\n")
        out.extend(f"    {name}: {python}\n" for name, (_, python, _) in fields.items())
        none = ", ".join(f"{name!r}: {absent}" for name, (_, _, absent) in fields.items() if absent != "None")
        if none:
            out.append(f"    ABSENT: ClassVar[dict[str, object]] = {{{none}}}\n")
    names = ", ".join(f"{model.__name__!r}: {model.__name__}" for model in classes)
    out.append(f"\n\nRECORDS: dict[str, type[Record]] = {{{names}}}\n")
    return "".join(out)


def _command(model: type[BaseModel]) -> str:
    shapes = {name: member(field)[0] for name, field in model.model_fields.items()}
    lines = "".join(f"        {name!r}: {found!r},\n" for name, found in shapes.items())
    if model is metal_models.MetalCommand:
        head = f'\n\nclass MetalCommand(Command):\n    """{model.__doc__}"""\n\n    __slots__ = ()\n'
        return f"{head}    SHAPE: ClassVar[dict[str, Shape]] = {{\n{lines}    }}\n"
    return (
        '\n\nclass Command(Record):\n    """One recorded command: its name, and its parameters."""\n\n'
        '    __slots__ = ("body", "kind")\n    SHAPE: ClassVar[dict[str, Shape]] = {\n'
        f"{lines}    }}\n    kind: str\n    body: object\n"
    )


def formatted(text: str) -> str:
    """The text as ruff would have it, so that the file is clean under the repository's own checks."""
    import subprocess

    done = subprocess.run([sys.executable, "-m", "ruff", "format", "-"], input=text, capture_output=True, text=True, check=True)
    return done.stdout


def main() -> int:
    """Writes the file, or with `--check` compares."""
    text = formatted(source())
    if "--check" in sys.argv[1:]:
        with open(TARGET, encoding="utf-8") as file:
            return int(file.read() != text)
    with open(TARGET, "w", encoding="utf-8") as file:
        file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
