"""What a message of the validation layer is about, where it shows: an image that was created or
resolved, or an attachment.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from msaa_lint.frame.facts.commands import accesses
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass

from .families import Family
from .messages import Message, sentence
from .plan_images import image_name

_INDEX = re.compile(r"\battachment #?(\d+)\b|\bpAttachments\[(\d+)\]", re.IGNORECASE)


class MessageScope(NamedTuple):
    """The parts of a frame that a message is about: `paths` with everything below them, and the
    passes with these paths and names.
    """

    paths: frozenset[str]
    pass_paths: frozenset[str]
    pass_names: frozenset[str]

    def has(self, path: str) -> bool:
        """Whether a path is one of these parts, or within one."""
        if path in self.pass_paths:
            return True
        while path not in self.paths:
            cut = max(path.rfind("."), path.rfind("["))
            if cut < 0:
                return False
            path = path[:cut]
        return True


class MessageScopes:
    """The scopes of the messages about a frame."""

    def __init__(self, frame: Frame, subjects: Iterable[Subject]) -> None:
        self._turns: dict[str, list[str]] = {}
        for subject in subjects:
            names = (
                subject.facts.values.get("image.taking_turns") if subject.kind == "image" else None
            )
            group = list(map(str, names)) if isinstance(names, list) else []
            self._turns.update(dict.fromkeys(group, group))
        self._by_image: dict[str, list[tuple[str, Pass | None]]] = {}
        for name, target in frame.targets.items():
            self._by_image.setdefault(name, []).append((target.path, None))
        for described in frame.passes:
            for attachment in described.attachments:
                for target in attachment.targets:
                    parts = self._by_image.setdefault(image_name(described, attachment, target), [])
                    parts += [(attachment.record.path, described), (target.path, described)]
            for resolve in described.resolves:
                if resolve.target_image is not None:
                    self._by_image.setdefault(resolve.target_image.name, []).append(
                        (resolve.target_image.path, described)
                    )

        for command in frame.commands:
            for name, _ in accesses(command):
                if name in self._by_image:
                    self._by_image[name].append((command.path, None))

    def image(self, name: str) -> MessageScope | None:
        """The scope of a message about an image and the commands on it, by its name in the plan;
        None for an unknown image. It includes the images that take turns with it, which have one
        finding for all of them.
        """
        found = [
            part
            for each in (name, *self._turns.get(name, ()))
            for part in self._by_image.get(each, ())
        ]
        return _scope(found) if name in self._by_image else None

    @staticmethod
    def attachment(
        message: Message, family: Family | None, described: Pass | None
    ) -> MessageScope | None:
        """The scope of a message about an attachment of a pass; None where its text does not show
        the index.
        """
        if family is None or not family.of_attachment or described is None:
            return None
        match = _INDEX.search(sentence(message.text))
        index = int(match[1] or match[2]) if match is not None else len(described.attachments)
        if index >= len(described.attachments):
            return None
        attachment = described.attachments[index]
        paths = [attachment.record.path, *(target.path for target in attachment.targets)]
        paths += [resolve.path for resolve in described.resolves if resolve.target is attachment]
        return _scope((path, described) for path in paths)


def _scope(found: Iterable[tuple[str, Pass | None]]) -> MessageScope:
    found = list(found)
    passes = [described for _, described in found if described is not None]
    return MessageScope(
        frozenset(path for path, _ in found),
        frozenset(each.path for each in passes),
        frozenset(each.name for each in passes),
    )
