"""What plain `vulkaninfo` prints: every GPU, with memory types, which its JSON lacks. Lines are
read one by one, old spellings too.
"""

from __future__ import annotations

import re

from .members import WANTED, Found

MAX_GPUS = 16
_GPU = re.compile(r"GPU\s?(\d{1,3})\s*:?\s*\Z", re.ASCII)
_MEMBER = re.compile(r"\s+(\w+)\s*=\s*(.*)\Z", re.ASCII)
_LIST = re.compile(r"\s+(\w+):\s*count\s*=\s*\d+\s*\Z", re.ASCII)
_ENTRY = re.compile(r"\s*(memoryHeaps|memoryTypes)\[(\d{1,3})\]\s*:?\s*\Z", re.ASCII)
_EXTENSION = re.compile(r"\s+(VK_\w+)\s*:\s*extension revision\s", re.ASCII)


def claims(text: str) -> bool:
    """Whether a text is what vulkaninfo prints."""
    return (
        re.search(
            r"(?m)^(?:VULKANINFO|Vulkan Instance Version\s*:|GPU\s?0\s*:?)\s*", text[: 1 << 16]
        )
        is not None
    )


def read(text: str) -> list[Found]:
    """Every GPU."""
    made: list[_Gpu] = []
    current: _Gpu | None = None
    for line in text.splitlines():
        if line and not line[0].isspace():
            gpu = _GPU.match(line)
            if gpu is not None:
                current = _Gpu() if len(made) < MAX_GPUS else None
                made += [current] if current is not None else []
            elif current is not None:
                current.section_begins(line)
        elif current is not None and line:
            current.line(line)
    return [gpu.found() for gpu in made]


class _Gpu:
    """One GPU while its lines are read."""

    def __init__(self) -> None:
        self.members: dict[str, list[object]] = {}
        self.features: dict[object, object] = {}
        self.extensions: list[object] | None = None
        self.types: list[object] = []
        self.heaps: list[list[object]] = []
        self.section = ""
        self.listed: tuple[int, list[object]] | None = None
        self.entry = ""

    def section_begins(self, line: str) -> None:
        """A line at the margin: a structure's name, or the line drawn under it."""
        if line.strip("=- \t"):
            self.section = line.partition(":")[0].strip()
            self.listed = None
            self.entry = ""
            if self.section.startswith("Device Extensions"):
                self.extensions = self.extensions or []

    def line(self, line: str) -> None:
        """A line within a structure."""
        if self.extensions is not None and self.section.startswith("Device Extensions"):
            found = _EXTENSION.match(line)
            self.extensions += [found.group(1)] if found is not None else []
        elif self.section.startswith(
            ("memoryHeaps", "memoryTypes", "VkPhysicalDeviceMemoryProperties")
        ):
            self._memory(line)
        elif self.section.startswith("VkPhysicalDevice") and "Features" in self.section:
            member = _MEMBER.match(line)
            if member is not None:
                name, value = member.groups()
                self.features[name] = "true" if self.features.get(name) in ("true", "1") else value
        else:
            self._property(line)

    def _property(self, line: str) -> None:
        indent = len(line) - len(line.lstrip())
        begins = _LIST.match(line)
        if begins is not None:
            self.listed = (indent, []) if begins.group(1) in WANTED else None
            if self.listed is not None:
                self.members.setdefault(begins.group(1), []).append(self.listed[1])
            return
        if self.listed is not None and indent > self.listed[0]:
            self.listed[1].append(line.strip())
            return
        self.listed = None
        member = _MEMBER.match(line)
        if member is not None and member.group(1) in WANTED:
            self.members.setdefault(member.group(1), []).append(member.group(2))

    def _memory(self, line: str) -> None:
        begins = _ENTRY.match(line)
        if begins is not None:
            self.entry = begins.group(1)
            if self.entry == "memoryHeaps":
                self.heaps.append([None, []])
            else:
                self.types.append(None)
            return
        member = _MEMBER.match(line)
        if (
            self.entry == "memoryTypes"
            and member is not None
            and member.group(1) == "propertyFlags"
        ):
            self.types[-1] = member.group(2)
        elif self.entry == "memoryHeaps" and member is not None and member.group(1) == "size":
            self.heaps[-1][0] = member.group(2)
        elif self.entry == "memoryHeaps" and "DEVICE_LOCAL" in line:
            self.heaps[-1][1] = ["DEVICE_LOCAL"]

    def found(self) -> Found:
        return Found(
            self.members,
            self.features or None,
            self.extensions,
            self.types or None,
            [(size, flags) for size, flags in self.heaps] or None,
            what="vulkaninfo",
        )
