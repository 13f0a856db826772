"""What a member of a description may hold, as data that a reader follows without pydantic.

A shape is a tuple of a kind and its parameters. What an input may state, by shape:

- `("text",)`, `("bool",)`: a string; `true` or `false`;
- `("int", low, high)`, `("number", positive)`: an integer in a range; a finite number, above 0 if
  `positive`;
- `("share",)`: a fraction above 0 and up to 1;
- `("samples",)`: a sample count: `4`, `SAMPLE_COUNT_4` or `VK_SAMPLE_COUNT_4_BIT`;
- `("shading",)`: a cost of shading: `medium`, `200`, `200ops`, `500000ns` or `4.2ms`;
- `("enum", enums)`, `("flags", enum)`: an enumerant of one of the enums, which `|` joins; a list of
  flag bits, or names joined by `|`;
- `("word", words)`, `("caseless", words)`: one of some words; one of some lowercase words, written
  in any case;
- `("name", section)`: the name of an entry of a section, such as `images` or `metal.textures`;
  names may be integers, as keys may;
- `("slot",)`: an attachment of the same render pass: a name, an index, `{attachment, layout}`, or
  null for VK_ATTACHMENT_UNUSED;
- `("subpass",)`: the index of a subpass, or VK_SUBPASS_EXTERNAL;
- `("record", class)`, `("command", class)`: a structure; a recorded command;
- `("list", item[, maximum])`: a list, of `maximum` items at most;
- `("map", item)`, `("numbered", item[, highest])`: a mapping by name; a mapping by number;
- `("counted", item)`: a list, or a mapping whose names are in index order;
- `("null", shape)`, `("either", shape, ...)`: null or a shape; the first shape of the value's kind.
"""

import sys
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

Shape = tuple[Any, ...]

_PLAIN: dict[object, Shape] = {str: ("text",), bool: ("bool",), float: ("number", False)}


def member_shapes(kind: type) -> dict[str, Shape]:
    """The shapes of the members that a class declares. `X | None` says that a member may be absent,
    not that it may be null.
    """
    return {
        name: _shape_of_text(text.removesuffix(" | None"), kind.__module__)
        for name, text in kind.__annotations__.items()
    }


@cache
def _shape_of_text(annotation: str, module: str) -> Shape:
    # As typing.get_type_hints, which takes four times as long.
    return shape_of(eval(annotation, vars(sys.modules[module])))


def shapes_of(**types: object) -> dict[str, Shape]:
    """The shapes of some types by name."""
    return {name: shape_of(annotation) for name, annotation in types.items()}


def shape_of(annotation: Any) -> Shape:
    """The shape that a type is marked with in `Annotated`, or else the one that follows from the
    type itself.
    """
    arguments = get_args(annotation)
    if not arguments:
        return _PLAIN.get(annotation) or ("record", annotation)
    origin = get_origin(annotation)
    if origin is Annotated:
        return next(
            (marker for marker in annotation.__metadata__ if isinstance(marker, tuple)), None
        ) or shape_of(arguments[0])
    if origin is Literal:
        return "word", arguments
    if origin is tuple:
        return "list", shape_of(arguments[0])
    if origin is dict:
        return "map", shape_of(arguments[1])
    if origin not in (Union, UnionType):
        raise TypeError(f"no shape for {annotation!r}")
    shapes = [shape_of(argument) for argument in arguments if argument is not NoneType]
    shape = shapes[0] if len(shapes) == 1 else ("either", *shapes)
    return ("null", shape) if NoneType in arguments else shape
