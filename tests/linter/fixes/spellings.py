"""Random texts of a description: block and flow style, quotes, names, indentation, comments, line
breaks, JSON.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from random import Random
from typing import Any

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.metal import names as metal
from msaa_lint.frame.metal.names import objective_c

FLAGS = {
    "usage": "VK_IMAGE_USAGE_",
    "memory": "VK_MEMORY_PROPERTY_",
    "srcStageMask": "VK_PIPELINE_STAGE_",
    "dstStageMask": "VK_PIPELINE_STAGE_2_",
    "srcAccessMask": "VK_ACCESS_",
    "dstAccessMask": "VK_ACCESS_2_",
}
ENUMS = {
    "loadOp": "VK_ATTACHMENT_LOAD_OP_",
    "storeOp": "VK_ATTACHMENT_STORE_OP_",
    "stencilLoadOp": "VK_ATTACHMENT_LOAD_OP_",
    "stencilStoreOp": "VK_ATTACHMENT_STORE_OP_",
    "finalLayout": "VK_IMAGE_LAYOUT_",
    "format": "VK_FORMAT_",
}
METAL = {
    "usage": "MTLTextureUsage",
    "storageMode": "MTLStorageMode",
    "textureType": "MTLTextureType",
    "loadAction": "MTLLoadAction",
    "storeAction": "MTLStoreAction",
    "depthResolveFilter": "MTLMultisampleDepthResolveFilter",
    "pixelFormat": "MTLPixelFormat",
}
"""Members of Metal structures and their enums."""


def data_of(text: str) -> Any:
    """The plain data of a description."""
    (root,) = parse(Source("", text), Limits()).documents
    return plain(root)


def plain(node: Node) -> Any:
    """The plain data of a node."""
    if node.kind == "mapping":
        return {key: plain(value) for key, value in node.value.items()}
    return [plain(item) for item in node.value] if node.kind == "sequence" else node.value


def written(data: Any, random: Random, shared: float = 0.0) -> str:
    """A random text of a description; `shared` is the probability of an alias or a merge of an
    earlier value.
    """
    writer = _Json(random) if random.random() < 0.25 and not shared else _Yaml(random, shared)
    text = writer.document(data)
    if random.random() < 0.3:
        text = text.rstrip("\n")
    return text.replace("\n", "\r\n") if random.random() < 0.3 else text


class _Spelled:
    def __init__(self, random: Random) -> None:
        self.random = random
        self.long = random.random() < 0.4
        self.joined = random.random() < 0.3
        self.dotted = random.random() < 0.3

    def metals(self, enum: str, value: Any) -> Any:
        """Metal enumerants with their Objective-C names, with a dot, or bare."""
        names = [value] if isinstance(value, str) else value
        like = objective_c(enum, metal.ENUMS[enum][0]) if self.long else "." if self.dotted else ""
        words = [metal.spelled(enum, name, like) for name in names]
        return words[0] if isinstance(value, str) else " | ".join(words) if self.joined else words

    def likely(self, share: float) -> bool:
        return self.random.random() < share

    def respelled(self, key: str, value: Any) -> Any:
        """A member's value as the document spells it."""
        if key in METAL and isinstance(value, (str, list)):
            names = [value] if isinstance(value, str) else value
            if (
                all(isinstance(name, str) and name in metal.ENUMS[METAL[key]] for name in names)
                and names
            ):
                return self.metals(METAL[key], value)
        if key in FLAGS and isinstance(value, list):
            names = [f"{FLAGS[key]}{name}_BIT" if self.long else name for name in value]
            return " | ".join(names) if self.joined and names else names
        if key in ENUMS and isinstance(value, str) and self.long:
            return ENUMS[key] + value
        if (
            key in ("samples", "rasterizationSamples")
            and isinstance(value, int)
            and value > 1
            and self.long
        ):
            return f"VK_SAMPLE_COUNT_{value}_BIT"
        return value


class _Json(_Spelled):
    def document(self, data: Any) -> str:
        self.indent = self.random.choice([0, 2, 4])
        self.trailing = self.likely(0.3)
        return self.value("", data, 0) + "\n"

    def value(self, key: str, data: Any, depth: int) -> str:
        data = self.respelled(key, data)
        if isinstance(data, (dict, list)) and data:
            pairs = list(data.items()) if isinstance(data, dict) else [("", item) for item in data]
            inner = [
                (f'"{name}": ' if isinstance(data, dict) else "")
                + self.value(name, item, depth + 1)
                for name, item in pairs
            ]
            opened, closed = "{}" if isinstance(data, dict) else "[]"
            if self.indent == 0 or (self.likely(0.3) and sum(map(len, inner)) < 60):
                return opened + self.random.choice([", ", ","]).join(inner) + closed
            blanks = " " * self.indent * (depth + 1)
            ending = "," if self.trailing else ""
            return (
                f"{opened}\n{blanks}"
                + f",\n{blanks}".join(inner)
                + f"{ending}\n{' ' * self.indent * depth}{closed}"
            )
        return _scalar(data, '"')


def _scalar(data: Any, quote: str) -> str:
    if isinstance(data, dict):
        return "{}"
    if isinstance(data, list):
        return "[]"
    if isinstance(data, bool) or data is None:
        return {True: "true", False: "false", None: "null"}[data]
    return f"{quote}{data}{quote}" if isinstance(data, str) else str(data)


def _mergeable(data: Any) -> bool:
    """Whether data is a structure without nested structures, in which the order of members does not
    matter.
    """
    return (
        isinstance(data, dict)
        and bool({"format", "loadOp"} & set(data))
        and not any(isinstance(each, dict) for each in data.values())
    )


class _Yaml(_Spelled):
    def __init__(self, random: Random, shared: float) -> None:
        super().__init__(random)
        self.shared = shared
        self.anchors: dict[str, tuple[str, Any]] = {}

    def document(self, data: Any) -> str:
        self.step = self.random.choice([2, 3, 4])
        self.comments = self.random.choice([0.0, 0.2, 0.6])
        self.flowing = self.random.choice([0.1, 0.5, 0.9])
        self.dented = self.likely(0.5)
        self.number = 0
        return "".join(self.block("", data, 0)) or "{}\n"

    def comment(self) -> str:
        self.number += 1
        return f"# {self.number}: {self.random.choice(['why', 'storeOp: STORE', 'a, b] }', '- x', 'é ☃'])}"

    def tail(self) -> str:
        return (
            f"{self.random.choice(['  ', ' ', '    '])}{self.comment()}\n"
            if self.likely(self.comments)
            else "\n"
        )

    def above(self, indent: int) -> list[str]:
        lines = (
            [" " * self.random.choice([0, indent]) + self.comment() + "\n"]
            if self.likely(self.comments / 2)
            else []
        )
        return [*lines, "\n"] if self.likely(0.05) else lines

    def text(self, data: Any, flow: bool) -> str:
        plainly = (
            isinstance(data, str)
            and data.replace("_", "").replace(" | ", "").isalnum()
            and not data[:1].isdigit()
        )
        quote = self.random.choice(["", "", '"', "'"]) if plainly else '"'
        return _scalar(data, quote)

    def sharing(self, data: Any, made: Callable[[Any], str]) -> str:
        """The value, perhaps with an anchor; or an alias of an equal earlier one, or a merge of one
        that it extends.
        """
        if not self.likely(self.shared):
            return made(data)
        same = json.dumps(data)
        if same in self.anchors:
            return f"*{self.anchors[same][0]}"
        for name, base in self.anchors.values():
            if (
                _mergeable(data)
                and isinstance(base, dict)
                and set(base) <= set(data)
                and self.likely(0.5)
            ):
                rest = {
                    key: value
                    for key, value in data.items()
                    if key not in base or base[key] != value
                }
                inner = ", ".join(
                    [
                        f"<<: *{name}",
                        *(
                            f"{key}: {made(self.respelled(key, value))}"
                            for key, value in rest.items()
                        ),
                    ]
                )
                return f"{{{inner}}}"
        text = made(data)
        name = f"a{len(self.anchors)}"
        self.anchors[same] = (name, data if _mergeable(data) else None)
        return f"&{name} {text}"

    def key(self, name: str) -> str:
        return f'"{name}"' if self.likely(0.1) or not name.isidentifier() else name

    def block(self, key: str, data: Any, indent: int) -> list[str]:
        """The lines of a collection in block style."""
        lines: list[str] = []
        blanks = " " * indent
        pairs = list(data.items()) if isinstance(data, dict) else [("", item) for item in data]
        for name, item in pairs:
            item = self.respelled(name, item)
            lines += self.above(indent)
            head = f"{blanks}{self.key(name)}:" if isinstance(data, dict) else f"{blanks}-"
            if (
                isinstance(item, (dict, list))
                and item
                and not self.likely(self.flowing if indent else 0.02)
            ):
                if isinstance(data, list) and isinstance(item, dict):
                    inner = self.block(name, item, indent + 2)
                    first = next(
                        (
                            n
                            for n, line in enumerate(inner)
                            if line.strip() and not line.lstrip().startswith("#")
                        ),
                        0,
                    )
                    # A comment between a dash and what it begins stands above both.
                    lines += inner[:first]
                    lines += [f"{head} {inner[first].lstrip(' ')}", *inner[first + 1 :]]
                else:
                    lines.append(head + self.tail())
                    deeper = (
                        indent
                        if isinstance(item, list) and isinstance(data, dict) and self.dented
                        else indent + self.step
                    )
                    lines += self.block(name, item, deeper)
            elif isinstance(item, (dict, list)):
                lines.append(
                    f"{head} {self.sharing(item, lambda each: self.flow(each, indent + self.step))}{self.tail()}"
                )
            else:
                lines.append(
                    f"{head} {self.sharing(item, lambda each: self.text(each, False))}{self.tail()}"
                )
        return lines

    def flow(self, data: Any, indent: int) -> str:
        """A collection in flow style, on one line or several."""
        if not isinstance(data, (dict, list)):
            return self.text(data, True)
        pairs = list(data.items()) if isinstance(data, dict) else [("", item) for item in data]
        opened, closed = "{}" if isinstance(data, dict) else "[]"
        inner = [
            (f"{self.key(name)}: " if isinstance(data, dict) else "")
            + self.sharing(
                self.respelled(name, item), lambda each: self.flow(each, indent + self.step)
            )
            for name, item in pairs
        ]
        if not inner:
            return opened + closed
        if self.likely(0.75):
            return opened + self.random.choice([", ", ", ", ",  "]).join(inner) + closed
        blanks = " " * indent
        last = self.random.choice([",", ""])
        made = f"{opened}{self.tail()}"
        for number, item in enumerate(inner):
            made += f"{blanks}{item}{',' if number < len(inner) - 1 else last}{self.tail()}"
        return f"{made}{' ' * (indent - 1)}{closed}"
