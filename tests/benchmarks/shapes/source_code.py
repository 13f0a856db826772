"""Text of source code."""

from __future__ import annotations

from collections.abc import Callable

from .shape import Shape, text

IMAGE = """\
    VkImageCreateInfo info = {VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.format = VK_FORMAT_R8G8B8A8_UNORM;
    info.samples = samples;
    info.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    vkCreateImage(device, &info, nullptr, &image);
"""


def repeated(line: str, count: int, start: int = 0) -> str:
    """Formats a line with every number `n`."""
    return "".join(line.format(n=number, m=number + 1) for number in range(start, start + count))


def function(body: str, name: str = "void setup(int samples)") -> str:
    return f"{name} {{\n{body}}}\n"


def code(name: str, file: str, content: Callable[[int], str]) -> Shape:
    """A file that the command names: in a folder, only files that mention multisampling are read. A
    limit may end it.
    """
    return Shape(name, text(file, content), ("check", "--isolated", file), (0, 1, 2))


def cpp(name: str, content: Callable[[int], str]) -> Shape:
    return code(f"C++: {name}", "a.cpp", content)
