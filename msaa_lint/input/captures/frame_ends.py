"""Where frames end that nothing marks: at the submission that begins a pass again.

A pass that begins again draws into the same images with the same attachments (formats, load and
store operations), and shares a pipeline and a part of the area with the earlier one. Handles do not
matter: programs create framebuffers, views, and images anew for each frame.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any, NamedTuple

from .command_buffers import PASS_BEGINS, PASS_ENDS, RecordedCommand, RenderPassBegin
from .objects import Image
from .submissions import Submission

MAX_OTHER_LABELS = 1000
"""Maximum number of labels among which the nearest is searched."""

MAX_USES = 64
"""Maximum number of similar passes of a frame that are compared."""

MAX_SIMILAR = 8
"""Maximum number of submissions of a frame that begin similar passes: on equally created images,
with other pipelines, or on top of what the frame drew.
"""

Area = tuple[int, int, int, int] | None
"""x, y, width, height in pixels; None if unknown."""


class PassIdentity(NamedTuple):
    """What of a pass recurs in each frame.

    `key` is the same for passes on the same images, `similar` for those on equally created ones.
    `loads` says whether the pass draws on top of what the images have.
    """

    key: Hashable
    similar: Hashable
    images: tuple[Image, ...]
    area: Area
    pipelines: frozenset[Hashable]
    loads: bool


class FrameLabel:
    """The debug label with which frames end. `is_found` says whether the capture has it, `others`
    which other labels it has.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self.is_found = False
        self.others: dict[str, None] = {}
        self._is_open = False

    def matches(self, text: str) -> bool:
        """Whether a label is this one."""
        if text == self.text:
            self.is_found = True
            return True
        if len(self.others) < MAX_OTHER_LABELS:
            self.others[text] = None
        return False

    def ends_frame(self, mark: str) -> bool:
        """Whether a mark ends the frame: the label ends or is inserted, or it begins again although
        it has not ended.
        """
        return mark in ("end", "insert") or self._is_open

    def follow(self, mark: str) -> None:
        """Processes a mark."""
        if mark != "insert":
            self._is_open = mark == "begin"


class _Use(NamedTuple):
    """A pass of the current frame: the number of its submission, and the numbers of created images
    and of waits at that time.
    """

    identity: PassIdentity
    submission: int
    created: int
    waits: int


class Repetitions:
    """The passes of the current frame. `created` is the number of images that the program has
    created, `waits` how often it has waited for the device.
    """

    def __init__(self) -> None:
        self.created = 0
        self.waits = 0
        self._uses: dict[Hashable, list[_Use]] = {}
        """By what similar passes have in common."""
        self._counts: dict[Hashable, int] = {}
        """The number of submissions that begin similar passes."""
        self._submissions = 0

    def clear(self) -> None:
        """Starts a frame."""
        self._uses.clear()
        self._counts.clear()
        self._submissions = 0

    def repeats(self, passes: Iterable[PassIdentity]) -> bool:
        """Whether a submission with these passes starts a new frame."""
        return any(self._repeats(each) for each in passes)

    def add(self, passes: Iterable[PassIdentity]) -> None:
        """Adds the passes of a submission to the frame."""
        for each in passes:
            uses = self._uses.setdefault(each.similar, [])
            if not uses or uses[-1].submission != self._submissions:
                self._counts[each.similar] = self._counts.get(each.similar, 0) + 1
            if len(uses) < MAX_USES:
                uses.append(_Use(each, self._submissions, self.created, self.waits))
        self._submissions += 1

    def _repeats(self, identity: PassIdentity) -> bool:
        if self._counts.get(identity.similar, 0) >= MAX_SIMILAR:
            return True
        # A pass that loads continues the frame, unless the frame started with it.
        uses = (
            use
            for use in self._uses.get(identity.similar, ())
            if use.submission == 0 or not identity.loads
        )
        return any(
            _is_alike(identity, use.identity) and self._is_next(identity, use) for use in uses
        )

    def _is_next(self, identity: PassIdentity, use: _Use) -> bool:
        """Whether the pass has the images of the earlier one, images created since, or other images
        after a wait for the device.
        """
        if identity.key == use.identity.key or use.waits < self.waits:
            return True
        return any(
            image.number >= use.created
            for image in identity.images
            if image not in use.identity.images
        )


def passes_of(submission: Submission) -> tuple[PassIdentity, ...]:
    """The passes that a submission begins."""
    if submission.passes is None:
        passes: list[PassIdentity] = []
        begin: RecordedCommand | None = None
        pipelines: set[Hashable] = set()
        for command in submission.commands:
            if command.kind in PASS_BEGINS or command.kind in PASS_ENDS:
                if begin is not None:
                    passes.append(_identity(begin, frozenset(pipelines)))
                    pipelines.clear()
                begin = command if command.kind in PASS_BEGINS else None
            elif command.kind == "draw" and isinstance(command.key, tuple):
                pipelines.add(command.key[0])
        if begin is not None:
            passes.append(_identity(begin, frozenset(pipelines)))
        submission.passes = tuple(passes)
    return submission.passes


def _is_alike(identity: PassIdentity, other: PassIdentity) -> bool:
    """Whether two passes share a pipeline and a part of the area."""
    shares = (
        not identity.pipelines
        or not other.pipelines
        or not identity.pipelines.isdisjoint(other.pipelines)
    )
    return shares and _overlap(identity.area, other.area)


def _overlap(area: Area, other: Area) -> bool:
    if area is None or other is None:
        return True
    return all(
        area[axis] < other[axis] + other[axis + 2] and other[axis] < area[axis] + area[axis + 2]
        for axis in (0, 1)
    )


def _identity(begin: RecordedCommand, pipelines: frozenset[Hashable]) -> PassIdentity:
    identity: PassIdentity | None = begin.identity
    if identity is None:
        identity = begin.identity = _new_identity(begin)
    return identity._replace(pipelines=pipelines)


def _new_identity(begin: RecordedCommand) -> PassIdentity:
    key: Any = begin.key
    attachments: Hashable
    if isinstance(key, RenderPassBegin):
        attachments = key.render_pass
        trees = key.render_pass.tree.get("attachments", ())
        operations = [tree.get(name) for tree in trees for name in ("loadOp", "stencilLoadOp")]
        images, area, loads = key.images, key.area, "LOAD" in operations
    else:
        members = dict(key)
        area = tuple(dict(members["renderArea"]).values()) if "renderArea" in members else None
        trees = [
            dict(tree or ())
            for name in ("depthAttachment", "stencilAttachment")
            for tree in [members.get(name)]
        ]
        trees += [dict(tree or ()) for tree in members.get("colorAttachments", ())]
        images = tuple(tree.get(member) for tree in trees for member in ("image", "resolveImage"))
        loads = any(tree.get("loadOp") == "LOAD" for tree in trees) or "RESUMING" in members.get(
            "flags", ()
        )
        attachments = tuple(
            (tree.get("loadOp"), tree.get("storeOp"), tree.get("resolveMode")) for tree in trees
        )
    parts = tuple(zip(images, begin.parts or ((0, 0),) * len(images), strict=False))
    multisampled = any(image is not None and image.samples > 1 for image in images)
    exact, similar = [], []
    for image, part in parts:
        alike = (_parameters(image), part)
        similar.append(alike)
        # The samples of one image may be resolved to others in turns.
        exact.append(
            (image, part)
            if image is not None and (image.samples > 1 or not multisampled)
            else alike
        )
    drawn = tuple(image for image in images if image is not None)
    return PassIdentity(
        (attachments, tuple(exact)), (attachments, tuple(similar)), drawn, area, frozenset(), loads
    )


def _parameters(image: Image | None) -> Hashable:
    """What equally created images have in common."""
    if image is None:
        return None
    tree = image.tree
    return (
        tree.get("format"),
        image.samples,
        *tree.get("extent", {}).values(),
        tree.get("arrayLayers"),
        tree.get("mipLevels"),
    )
