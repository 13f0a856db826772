"""Folders of source files that are read together."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from .shape import Shape
from .source_code import IMAGE, function


def _folder(name: str, files: Callable[[int], dict[str, str]]) -> Shape:
    """A folder of source files, read without what earlier runs kept."""

    def write(folder: Path, size: int) -> None:
        for file, text in files(size).items():
            path = folder / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"// msaa\n{text}", encoding="utf-8")

    return Shape(
        f"C++ files: {name}", write, ("check", "--isolated", "--no-cache", "."), (0, 1, 2), 4000
    )


def _class(number: int) -> str:
    return (
        f"struct Part{number} {{\n    int samples{number} = 4;\n    void create(int samples);\n"
        f"}};\n"
    )


def _source(number: int, header: str = "parts.h") -> str:
    return f'#include "{header}"\n' + function(IMAGE, f"void Part{number}::create(int samples)")


def _choices(count: int) -> str:
    """Choices of a count that each pass to the next object."""
    return "".join(
        f"VkSampleCountFlagBits pick{n}() {{\n"
        "    VkSampleCountFlags counts = limits.framebufferColorSampleCounts & "
        "limits.framebufferDepthSampleCounts;\n"
        "    if (counts & VK_SAMPLE_COUNT_8_BIT) return VK_SAMPLE_COUNT_8_BIT;\n    return "
        "VK_SAMPLE_COUNT_1_BIT;\n}\n"
        f"void Part{n}::choose() {{ samples{n} = pick{n}(); part{n + 1}.create(samples{n}); }}\n"
        for n in range(count)
    )


SHAPES: tuple[Shape, ...] = (
    _folder(
        "sample counts chosen for images elsewhere",
        lambda n: {
            "parts.h": "".join(
                f"{_class(k)[:-3]}    void choose();\n}};\nextern Part{k} part{k};\n"
                for k in range(n + 1)
            ),
            "choices.cpp": '#include "parts.h"\n' + _choices(n),
            **{f"part{k}.cpp": _source(k) for k in range(n)},
        },
    ),
    _folder(
        "one program",
        lambda n: {
            "parts.h": "".join(map(_class, range(n))),
            **{f"part{k}.cpp": _source(k) for k in range(n)},
        },
    ),
    _folder(
        "many programs over one library",
        lambda n: {
            "base/parts.h": "".join(map(_class, range(4))),
            "base/part0.cpp": _source(0),
            **{
                f"app{k}/main.cpp": '#include "../base/parts.h"\nint main() { return 0; }\n'
                + function(IMAGE)
                for k in range(n)
            },
        },
    ),
    _folder(
        "a chain of includes",
        lambda n: (
            {f"h{k}.h": f'#include "h{k + 1}.h"\nconstexpr int samples{k} = 4;\n' for k in range(n)}
            | {"a.cpp": '#include "h0.h"\n' + function(IMAGE)}
        ),
    ),
    _folder(
        "definitions of one name that differ",
        lambda n: (
            {
                f"f{k}/a.h": f"constexpr int samples_used = {k};\nstruct Part {{ int a{k}; }};\n"
                for k in range(n)
            }
            | {f"f{k}/a.cpp": '#include "a.h"\n' + function(IMAGE) for k in range(n)}
        ),
    ),
    _folder(
        "folders that include each other",
        lambda n: (
            {
                f"f{k}/a.cpp": f'#include "f{(k + 1) % n}/b.h"\n'
                + function(IMAGE, f"void setup{k}(int samples)")
                for k in range(n)
            }
            | {f"f{k}/b.h": f"constexpr int samples{k} = 4;\n" for k in range(n)}
        ),
    ),
    _folder(
        "headers of one name",
        lambda n: (
            {f"f{k}/common.h": f"constexpr int samples{k} = 4;\n" for k in range(n)}
            | {f"g{k}/a.cpp": '#include "common.h"\n' + function(IMAGE) for k in range(n)}
        ),
    ),
)
