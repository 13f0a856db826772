"""Shader modules: many pipelines, documents and files that name them, and code that no compiler
writes.
"""

from __future__ import annotations

import array
from collections.abc import Callable, Iterable
from pathlib import Path

from .shape import Shape

Instruction = tuple[int, ...]

MAIN = 0x6E69616D
HEADER = (0x07230203, 0x00010300, 0, 1 << 22, 0)
START: tuple[Instruction, ...] = (
    (17, 1), (15, 4, 1, MAIN, 0), (71, 8, 30, 0), (71, 60, 34, 0), (71, 60, 33, 0), (19, 2), (33,
    3, 2), (20, 4), (21, 5, 32, 0),
    (22, 6, 32), (23, 7, 6, 4), (32, 70, 3, 7), (59, 70, 8, 3), (32, 71, 1, 5), (59, 71, 9, 1),
    (25, 61, 6, 1, 0, 0, 1, 1, 0),
    (32, 62, 0, 61), (59, 62, 60, 0), (23, 63, 5, 2), (41, 4, 10), (43, 5, 11, 0), (43, 5, 12, 1),
    (44, 7, 13, 14, 14, 14, 14),
    (43, 6, 14, 0x3F800000), (46, 63, 15), (32, 72, 7, 5), (21, 73, 64, 1), (46, 7, 16),
)  # fmt: skip
"""An entry point `main`, function 1; types 2 void, 3 function, 4 bool, 5 uint, 6 float, 7 vec4, 63
uvec2; output 8, input 9, constants 10 to 16, a multisampled image 60.
"""

FIRST = 1000
"""The first id of a shape."""


def assembled(declarations: Iterable[Instruction], bodies: Iterable[Instruction]) -> bytes:
    """A module of the declarations, and of an entry point of the instructions; further functions
    may follow its OpFunctionEnd.
    """
    words = array.array("I", HEADER)
    for number, *operands in (*START, *declarations, (54, 2, 1, 0, 3), (248, 20), *bodies):
        words.extend([(len(operands) + 1) << 16 | number, *operands])
    return words.tobytes()


RETURN: tuple[Instruction, ...] = ((253,), (56,))


def pipelines(
    count: int,
    module: Callable[[int], str] = lambda _: "a.spv",
    constant: Callable[[int], int | None] = lambda _: None,
) -> str:
    rows = []
    for number in range(count):
        value = constant(number)
        stated = "" if value is None else f", specialization: {{0: {value}}}"
        stage = f"{{stage: FRAGMENT, module: {module(number)}{stated}}}"
        rows.append(
            f"  p{number}: {{stages: [{stage}], multisampleState: {{rasterizationSamples: 4, "
            f"alphaToCoverageEnable: true}}}}\n"
        )
    return "frame: {width: 64, height: 64, fps: 60}\npipelines:\n" + "".join(rows)


def code(
    make: Callable[[int], bytes], text: Callable[[int], str] = lambda _: pipelines(1)
) -> Callable[[Path, int], None]:
    """Writes a module of a size, and a description of pipelines that name it."""

    def write(folder: Path, size: int) -> None:
        (folder / "a.spv").write_bytes(make(size))
        (folder / "a.msaa.yaml").write_text(text(size), encoding="utf-8")

    return write


def body(
    make: Callable[[int], Iterable[Instruction]],
    declare: Callable[[int], Iterable[Instruction]] = lambda _: (),
) -> Callable[[Path, int], None]:
    return code(lambda size: assembled(declare(size), make(size)))


def declared(declare: Callable[[int], Iterable[Instruction]]) -> Callable[[Path, int], None]:
    return body(lambda _: RETURN, declare)


def small(size: int) -> bytes:
    return assembled((), ((62, 8, 13), *RETURN))


def middling(size: int) -> bytes:
    return assembled(
        (), (*((129, 6, FIRST + number, 14, 14) for number in range(1000)), (62, 8, 13), *RETURN)
    )


def files(folder: Path, size: int) -> None:
    """Descriptions that name one module."""
    (folder / "a.spv").write_bytes(middling(1))
    for number in range(size):
        (folder / f"{number}.msaa.yaml").write_text(pipelines(1), encoding="utf-8")


def modules(folder: Path, size: int) -> None:
    """A description of a module for each pipeline."""
    for number in range(size):
        (folder / f"{number}.spv").write_bytes(middling(1))
    (folder / "a.msaa.yaml").write_text(
        pipelines(size, lambda number: f"{number}.spv"), encoding="utf-8"
    )


def blocks(size: int) -> Iterable[Instruction]:
    """Blocks in a chain."""
    for label in range(FIRST, FIRST + size):
        yield from ((249, label), (248, label))
    yield from RETURN


def selections(size: int) -> Iterable[Instruction]:
    """Conditions that nothing decides, one after another, each with a phi."""
    for at in range(FIRST, FIRST + 8 * size, 8):
        yield from (
            (61, 5, at, 9),
            (170, 4, at + 1, at, 11),
            (247, at + 4, 0),
            (250, at + 1, at + 2, at + 4),
        )
        yield from (
            (248, at + 2),
            (249, at + 4),
            (248, at + 4),
            (245, 5, at + 5, 11, at + 2, 12, 20 if at == FIRST else at - 4),
        )
    yield from RETURN


def nested(size: int) -> Iterable[Instruction]:
    """Conditions within conditions."""
    ids = range(FIRST, FIRST + 4 * size, 4)
    for at in ids:
        yield from (
            (61, 5, at, 9),
            (170, 4, at + 1, at, 11),
            (247, at + 3, 0),
            (250, at + 1, at + 2, at + 3),
            (248, at + 2),
        )
    for at in reversed(ids):
        yield from ((249, at + 3), (248, at + 3))
    yield from RETURN


def loops(size: int) -> Iterable[Instruction]:
    """Loops that nothing ends, one after another."""
    for at in range(FIRST, FIRST + 8 * size, 8):
        yield from (
            (249, at),
            (248, at),
            (246, at + 3, at + 2, 0),
            (61, 5, at + 4, 9),
            (170, 4, at + 5, at + 4, 11),
        )
        yield from (
            (250, at + 5, at + 1, at + 3),
            (248, at + 1),
            (62, 8, 13),
            (249, at + 2),
            (248, at + 2),
            (249, at),
            (248, at + 3),
        )
    yield from RETURN


def switch(size: int) -> Iterable[Instruction]:
    """A switch with many targets that meet in a phi."""
    yield from ((61, 5, 900, 9), (247, 999, 0))
    for at in range(0, size, 8000):
        count = min(8000, size - at)
        pairs = [each for number in range(at, at + count) for each in (number, FIRST + number)]
        yield (251, 900, 999, *pairs)
        for number in range(at, at + count):
            yield from ((248, FIRST + number), (249, 999))
    yield (248, 999)
    yield from RETURN


def calls(size: int) -> Iterable[Instruction]:
    """Functions of which each calls the next one twice."""
    for function in range(FIRST, FIRST + 3 * size, 3):
        yield from (
            (57, 2, function + 1, function),
            (57, 2, function + 2, function),
            *RETURN,
            (54, 2, function, 0, 3),
            (248, function + 10_000_000),
        )
    yield from RETURN


def stores(size: int) -> Iterable[Instruction]:
    for number in range(size):
        yield from ((61, 7, FIRST + number, 8), (62, 8, FIRST + number))
    yield from RETURN


def arrays(size: int) -> Iterable[Instruction]:
    """Stores to elements of arrays."""
    yield (59, 82, 900, 7)
    for number in range(size):
        yield from ((65, 83, FIRST + number, 900, 11 + number % 2), (62, FIRST + number, 11))
    yield from RETURN


ARRAY: tuple[Instruction, ...] = (
    (43, 5, 80, 250),
    (28, 81, 5, 80),
    (32, 82, 7, 81),
    (32, 83, 7, 5),
)


def fetches(size: int) -> Iterable[Instruction]:
    """Samples that are fetched and summed."""
    yield (61, 61, 900, 60)
    total = 16
    for number in range(size):
        at = FIRST + 3 * number
        yield from ((95, 7, at, 900, 15, 64, 11 + number % 2), (129, 7, at + 1, at, total))
        total = at + 1
    yield (62, 8, total)
    yield from RETURN


def wide(size: int) -> Iterable[Instruction]:
    """Composites of many operands, in a loop that nothing ends."""
    yield from (
        (249, 900),
        (248, 900),
        (246, 903, 902, 0),
        (61, 5, 904, 9),
        (170, 4, 905, 904, 11),
        (250, 905, 901, 903),
        (248, 901),
    )
    for number in range(0, size, 16_000):
        yield (80, 81, FIRST + number, *[11] * min(16_000, size - number))
    yield from ((249, 902), (248, 902), (249, 900), (248, 903), *RETURN)


def ids(size: int) -> range:
    return range(FIRST, FIRST + size)


def chain(
    size: int, instruction: Callable[[int, int], Instruction], first: int
) -> Iterable[Instruction]:
    """Declarations of which each refers to the one before."""
    return (instruction(number, number - 1 if number > FIRST else first) for number in ids(size))


SHAPES = (
    Shape("shaders: pipelines of one module", code(middling, pipelines)),
    Shape(
        "shaders: specializations of one module",
        code(middling, lambda size: pipelines(size, constant=lambda number: number)),
        codes=(0, 1),
    ),
    Shape("shaders: modules", modules, most=1 << 15),
    Shape(
        "shaders: documents that name one module",
        code(middling, lambda size: "---\n".join([pipelines(1)] * size)),
        most=1 << 16,
    ),
    Shape("shaders: files that name one module", files, most=1 << 14),
    Shape("shaders: blocks", body(blocks)),
    Shape("shaders: conditions", body(selections)),
    Shape("shaders: nested conditions", body(nested)),
    Shape("shaders: loops", body(loops)),
    Shape("shaders: targets of a switch", body(switch)),
    Shape("shaders: calls of calls", body(calls)),
    Shape("shaders: stores", body(stores)),
    Shape("shaders: elements of arrays", body(arrays, lambda _: ARRAY)),
    Shape("shaders: fetches", body(fetches)),
    Shape("shaders: wide composites", body(wide, lambda _: ARRAY)),
    Shape(
        "shaders: types",
        declared(lambda size: chain(size, lambda number, before: (30, number, before, before), 5)),
    ),
    Shape(
        "shaders: zeros of structures",
        declared(
            lambda size: (
                *chain(size, lambda number, before: (30, number, before, before), 5),
                *((46, FIRST + number % size, 2_000_000 + number) for number in range(size)),
            )
        ),
    ),
    Shape(
        "shaders: zeros of one structure",
        declared(
            lambda size: ((30, 900, *[5] * 250), *((46, 900, number) for number in ids(size)))
        ),
    ),
    Shape(
        "shaders: composite constants",
        declared(
            lambda size: chain(size, lambda number, before: (44, 63, number, before, before), 11)
        ),
    ),
    Shape(
        "shaders: specialization constants",
        declared(
            lambda size: chain(size, lambda number, before: (52, 5, number, 128, before, 12), 12)
        ),
    ),
    Shape(
        "shaders: products of constants",
        declared(
            lambda size: chain(
                size, lambda number, before: (52, 73, number, 132, before, before), 12
            )
        ),
    ),
    Shape(
        "shaders: inputs",
        body(
            lambda size: (*((61, 5, 2_000_000 + number, number) for number in ids(size)), *RETURN),
            lambda size: ((59, 71, number, 1) for number in ids(size)),
        ),
    ),
    Shape(
        "shaders: members of inputs",
        body(
            lambda size: (
                *((61, 900, 2_000_000 + number, number) for number in ids(size)),
                *RETURN,
            ),
            lambda size: (
                *((72, 900, number, 17) for number in range(size)),
                (30, 900, 5),
                (32, 901, 1, 900),
                *((59, 901, number, 1) for number in ids(size)),
            ),
        ),
    ),
    Shape(
        "shaders: functions and inputs",
        body(
            lambda size: (
                *((57, 2, 2_000_000 + number, number + 4_000_000) for number in ids(size)),
                *RETURN,
                *(
                    each
                    for number in ids(size)
                    for each in (
                        (54, 2, number + 4_000_000, 0, 3),
                        (248, 6_000_000 + number),
                        (61, 5, 8_000_000 + number, number),
                        *RETURN,
                    )
                ),
            ),
            lambda size: ((59, 71, number, 1) for number in ids(size)),
        ),
    ),
    Shape(
        "shaders: decorations of a group",
        declared(
            lambda size: (
                *((71, 900, 30, number) for number in range(size)),
                (74, 900, *[8] * min(size, 60_000)),
            )
        ),
    ),
    Shape(
        "shaders: entry points",
        declared(lambda size: ((15, 0, number, MAIN, 0) for number in ids(size))),
    ),
    Shape("shaders: no-ops", body(lambda size: (*[(0,)] * size, *RETURN))),
    Shape(
        "shaders: cut off",
        code(
            lambda size: assembled((), ((129, 6, FIRST + number, 14, 14) for number in range(size)))
        ),
    ),
)
