"""What is left of a description with errors, without what could not be read, and whose absence says
nothing.

A key that resembles none is taken for a structure of an extension: it goes into the `pNext` of its
structure, which leaves uses and readers unknown. For any other error, the image, the render pass,
the framebuffer, the pipeline, or the commands of the pass that have it are left out; names of them
are then names of something unknown.
"""

from __future__ import annotations

from collections.abc import Sequence, Set

from msaa_lint.core.quote import shortened
from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, sequence, words
from msaa_lint.core.text.source import Source
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.hints import meant
from msaa_lint.frame.description.models import AttachmentDescription, Command, Description, Image
from msaa_lint.frame.description.problems import Problem

from . import description

MAX_DEEP = 60
"""The maximum nesting of a tree that is copied without some members."""

MAX_ROUNDS = 8
"""How often what names something that was left out is left out too."""

_BEGINS = ("beginRenderPass", "beginRendering")
_ENDS = ("endRenderPass", "endRendering")
_ALONE = frozenset(Command.SHAPE) - {*_BEGINS, *_ENDS, "nextSubpass", "clearAttachments"}
"""Commands without which the others of a pass are what they are."""
_SCALARS = {"images": Image, "renderPasses": AttachmentDescription}
"""The structures of sections with members that are unknown where they are absent."""
_NEEDED = frozenset({"device", "enabled", "metal", "renderTargets"})
"""Sections without which the frame would be taken for another one."""
_DECISIVE = ("format", "arrayLayers", "encoding")
"""Members without which rules would take an image for an ordinary one."""


def rest_of(source: Source, root: Node, document: Document) -> Document | None:
    """What is left of a description with problems.

    None after a syntax error, where the device or what is enabled could not be read, and of Metal
    and shorthands if a known key could not.
    """
    is_lowered = document.description.states("metal") or document.description.states(
        "renderTargets"
    )
    problems = document.problems
    complete = not is_lowered
    for _ in range(MAX_ROUNDS):
        if root.kind != "mapping" or any(
            problem.code == "MSAA901" or not problem.path for problem in problems
        ):
            return None
        sections = {problem.path.split(".")[0] for problem in problems if not problem.foreign}
        if sections and (
            is_lowered
            or not _NEEDED.isdisjoint(
                meant(section, Description.SHAPE) or section for section in sections
            )
        ):
            return None
        rest = _Rest(problems)
        root = rest.of(root)
        complete = complete and rest.complete
        read = description.read(source, root)
        if not read.problems:
            return read._replace(problems=document.problems, complete=read.complete and complete)
        problems = read.problems
    return None


class _Rest:
    """Leaves out what has problems. `complete` says that nothing was left out that may use an image
    or a pass.
    """

    def __init__(self, problems: Sequence[Problem]) -> None:
        self._wrong = {problem.path for problem in problems}
        self._foreign = {problem.path for problem in problems if problem.foreign}
        self.complete = True

    def of(self, root: Node) -> Node:
        """The tree of a description without what has problems."""
        members = []
        for key, value in root.value.items():
            path, at = shortened(key), root.keys[key].span
            if self._below(path):
                if path in self._wrong or value.kind == "scalar":
                    self.complete = False
                    if meant(key, Description.SHAPE) != "commands":
                        continue
                    # Which passes run is not known.
                    key, value = "commands", sequence([_no_effect(value)], value.span)
                else:
                    value = self._section(path, value)
            members.append((key, at, value))
        return mapping(members, root.span)

    def _below(self, path: str) -> set[str]:
        """The paths of the problems of a structure, and of what it has."""
        return {
            wrong
            for wrong in self._wrong
            if wrong == path or wrong.startswith((f"{path}.", f"{path}["))
        }

    def _section(self, path: str, value: Node) -> Node:
        if path == "commands":
            self.complete = False
            return self._commands(value)
        if path not in (
            "images",
            "renderPasses",
            "framebuffers",
            "pipelines",
            "sampleCountChoices",
        ):
            return without(value, path, self._wrong)[0]
        left = [
            (key, value.keys[key].span, self._entry(path, f"{path}.{shortened(key)}", entry))
            for key, entry in value.value.items()
        ]
        return mapping(
            [(key, at, entry) for key, at, entry in left if entry is not None], value.span
        )

    def _entry(self, section: str, path: str, entry: Node) -> Node | None:
        """What is left of an entry of a section; None if it is left out."""
        wrong = self._below(path)
        if not wrong:
            return entry
        if path in wrong or any(
            not (each in self._foreign or _is_scalar(section, each.removeprefix(path)))
            for each in wrong
        ):
            self.complete = False
            return None
        self.complete = self.complete and wrong <= self._foreign
        rest, _ = without(entry, path, wrong)
        return _with_unread(rest) if section in ("images", "renderPasses") else rest

    def _commands(self, commands: Node) -> Node:
        """The commands without those of passes that have problems, in whose places are commands
        without effect.
        """
        items: list[Node] = []
        segment: list[Node] = []
        is_left_out = False
        for n, command in enumerate(commands.value):
            name = _name(command)
            if name in _BEGINS:
                items += map(_no_effect, segment) if is_left_out else segment
                segment, is_left_out = [], False
            path = f"commands[{n}]"
            wrong = self._below(path)
            if path in self._foreign:
                command = _no_effect(command)
            elif wrong <= self._foreign:
                command = _foreign_left_out(command, path, wrong) if wrong else command
            elif (meant(name, Command.SHAPE) if name not in Command.SHAPE else name) in _ALONE:
                command = _no_effect(command)
            else:
                is_left_out = True
            segment.append(command)
            if name in _ENDS:
                items += map(_no_effect, segment) if is_left_out else segment
                segment, is_left_out = [], False
        items += map(_no_effect, segment) if is_left_out else segment
        return Node(commands.kind, commands.start, commands.end, items, commands.keys)


def _is_scalar(section: str, member: str) -> bool:
    """Whether a member of an image or an attachment is unknown where it is absent."""
    kind = _SCALARS.get(section)
    if kind is None or (section == "renderPasses" and not member.startswith(".attachments")):
        return False
    name = member.rpartition(".")[2].partition("[")[0]
    name = name if name in kind.SHAPE else meant(name, kind.SHAPE) or ""
    return (
        name in kind.SHAPE
        and getattr(kind, name) is None
        and name not in _DECISIVE
        and kind.SHAPE[name][0] != "name"
    )


def _name(command: Node) -> str:
    """The name of a command; empty for what is not one."""
    if command.kind == "mapping":
        return next(iter(command.value)) if len(command.value) == 1 else ""
    return command.text if command.kind == "scalar" else ""


def _foreign_left_out(command: Node, path: str, wrong: set[str]) -> Node:
    rest, _ = without(command, path, wrong)
    if _name(rest) != "beginRendering":
        return rest
    key = rest.keys["beginRendering"]
    return mapping(
        [("beginRendering", key.span, _with_unread(rest.value["beginRendering"]))], rest.span
    )


def _with_unread(node: Node) -> Node:
    """A structure with a structure in its pNext chain that is not read."""
    return _with(node, "pNext", words(["UNKNOWN"], node.span))


def _with(node: Node, name: str, member: Node) -> Node:
    if node.kind != "mapping":
        return node
    others = [(key, node.keys[key].span, value) for key, value in node.value.items() if key != name]
    return mapping([*others, (name, node.span, member)], node.span)


def _no_effect(node: Node) -> Node:
    return mapping([("pipelineBarrier", node.span, mapping([], node.span))], node.span)


def without(node: Node, path: str, wrong: Set[str], depth: int = 0) -> tuple[Node, bool]:
    """Returns a node without its invalid members, and whether the node itself is invalid. A list
    with an invalid element is.
    """
    if (path and path in wrong) or depth > MAX_DEEP:
        return node, True
    if node.kind == "sequence":
        items = [
            without(item, f"{path}[{n}]", wrong, depth + 1) for n, item in enumerate(node.value)
        ]
        copied = Node(node.kind, node.start, node.end, [item for item, _ in items], node.keys)
        return copied, any(bad for _, bad in items)
    if node.kind != "mapping":
        return node, False
    members = []
    for key, value in node.value.items():
        inner, bad = without(
            value, f"{path}.{shortened(key)}" if path else shortened(key), wrong, depth + 1
        )
        if not bad:
            members.append((key, node.keys[key].span, inner))
    return mapping(members, node.span), False
