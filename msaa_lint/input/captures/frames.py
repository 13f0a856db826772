"""Frames: the submitted commands from one present to the next, those alike counted once.

Two frames are alike where they begin the same passes in the same order on images of the same kind. What is drawn within a pass is joined
over all of them; of what happens between passes the commonest stands for all.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import NamedTuple

from .command_buffers import Begin, Recorded
from .frame_boundary import ends_of
from .objects import Image, Pipeline, frozen

MAX_KINDS = 32
"""So many kinds of frames are kept."""

MAX_ALTERNATES = 8
"""So many framebuffers that a pass is begun with in turns are kept."""

MAX_BETWEEN = 8
"""So many different ways to go from a pass to the next are counted."""

MAX_WITHIN = 4096
"""So many different draws, reads and clears of one pass are kept."""

MAX_ALIKE = 8
"""So many submissions alike, on other images each, are taken for one frame's where nothing tells frames apart."""

MAX_SEEN = 1024
"""So many different frames are remembered, to be known again."""

MAX_HELD = 1_000_000
"""So many commands these may have together."""

MAX_FRAME = 1_000_000
"""So many commands of one frame are followed."""

BEGINS = ("beginRenderPass", "beginRendering")
ENDS = ("endRenderPass", "endRendering")


class Role:
    """An image by the place at which a frame's passes first draw to it. There is one object a place."""

    __slots__ = ("number",)

    def __init__(self, number: int) -> None:
        self.number = number


_ROLES: list[Role] = []


def role_of(number: int) -> Role:
    """The role of a place."""
    while len(_ROLES) <= number:
        _ROLES.append(Role(len(_ROLES)))
    return _ROLES[number]


class Segment:
    """What is recorded between two passes, or within one: `begin` is the pass's, None between passes."""

    __slots__ = ("begin", "items")

    def __init__(self, begin: Recorded | None) -> None:
        self.begin = begin
        self.items: list[Recorded] = []


class Way:
    """What is recorded between two passes, and in how many frames."""

    __slots__ = ("count", "items")

    def __init__(self, items: list[Recorded], count: int) -> None:
        self.items = items
        self.count = count


class Kind:
    """Frames that are alike: the first of them, how many there are, and what the others add."""

    __slots__ = ("alternates", "between", "count", "defined", "images", "later", "number", "passes", "undefined", "within")

    def __init__(self, number: int, images: list[Image], passes: list[Recorded]) -> None:
        self.number = number
        self.count = 0
        self.images = images
        self.passes = passes
        self.alternates: list[dict[Hashable, Begin]] = [{} for _ in passes]
        self.within: list[dict[Hashable, Recorded]] = [{} for _ in passes]
        self.between: list[list[Way]] = [[] for _ in range(len(passes) + 1)]
        self.later: set[tuple[Hashable, str]] = set()
        """Images and aspects that a later frame reads as this one left them."""
        self.defined: set[tuple[Hashable, str]] = set()
        self.undefined: set[tuple[Hashable, str]] = set()
        """Those that this one reads first, where what was left there was stored, or was not."""


class Left(NamedTuple):
    """What a frame left in an aspect of an image: whether that was stored and read, and the frame's kind with the image's place in it."""

    state: str
    kind: Kind
    role: Hashable


class Seen:
    """A frame that came before, command for command: its kind, None where that is not kept, and how often it came since it was counted."""

    __slots__ = ("between", "count", "images", "kind", "passes", "pipelines", "recorded")

    def __init__(self, kind: Kind | None, recorded: list[Recorded], roles: Iterable[Image], between: list[list[Recorded]]) -> None:
        self.kind = kind
        self.between = between
        self.recorded = recorded
        self.count = 0
        self.images = list(roles)
        begins = [each.key for each in recorded if isinstance(each.key, Begin)]
        self.passes = list(dict.fromkeys(begin.render_pass for begin in begins))
        drawn = [each.key[0] for each in recorded if each.kind == "draw" and isinstance(each.key, tuple)]
        self.pipelines = list(dict.fromkeys(pipeline for pipeline in drawn if isinstance(pipeline, Pipeline)))


class Frames:
    """The frames of a capture as they end."""

    def __init__(self) -> None:
        self.current: list[Recorded] = []
        self.kinds: dict[Hashable, Kind] = {}
        self.total = 0
        self.unkept = 0
        """Frames of kinds that are not kept."""
        self.presents = False
        self.frameless = False
        self.truncated = False
        self._submits: dict[Hashable, int] = {}
        """The passes of the submissions of the frame, and how often each was submitted."""
        self._alike: dict[Hashable, Hashable] = {}
        self._seen: dict[Hashable, Seen] = {}
        self._held = 0
        """Commands of the frames that are remembered."""
        self._last: Seen | None = None
        self._repeated = 0
        """How often the last frame came in a row."""

    def mark(self, kind: str) -> None:
        """What the capture says of itself."""
        if kind == "frameless":
            self.frameless = True
        elif kind == "truncated":
            self.truncated = True
        elif kind == "frame" and not self.presents:
            self.end()

    def submit(self, recorded: list[Recorded]) -> None:
        """Commands of one command buffer are submitted."""
        if not self.presents and not self.frameless:
            self._divide(recorded)
        if len(self.current) < MAX_FRAME:
            self.current.extend(recorded)

    def _divide(self, recorded: list[Recorded]) -> None:
        """Without presents a frame is over where it begins anew: with passes that it has already, on the same images; or on images made
        anew, where that comes again and again."""
        begins = [each for each in recorded if each.kind in BEGINS]
        if not begins:
            return
        same = tuple(map(id, begins))
        alike = self._alike.get(same)
        if alike is None:
            if len(self._alike) > MAX_SEEN:
                self._alike.clear()
            alike = self._alike[same] = tuple(_shape(each, {}) for each in begins)
        if same in self._submits or self._submits.get(alike, 0) >= MAX_ALIKE:
            self.end()
        for shape in (same, alike):
            self._submits[shape] = self._submits.get(shape, 0) + 1

    def end_of_capture(self) -> None:
        """The capture is over: what is left is a frame of its own where it begins a pass."""
        if any(each.kind in BEGINS for each in self.current):
            self.end()
        for seen in self._seen.values():
            _counted(seen)

    def end(self) -> None:
        """The frame is over."""
        recorded, self.current = self.current, []
        self._submits.clear()
        self.total += 1
        key = tuple(map(id, recorded))
        seen = self._seen.get(key)
        if seen is None:
            seen = self._new(recorded)
            if seen is None:
                return
            self._held += len(recorded)
            if len(self._seen) >= MAX_SEEN or self._held > MAX_HELD:
                for each in self._seen.values():
                    _counted(each)
                self._seen.clear()
                self._held = len(recorded)
            self._seen[key] = seen
        elif seen.kind is not None and self._repeated < 2:
            self._lifetimes(seen.kind, recorded, {image: role_of(number) for number, image in enumerate(seen.images)})
        seen.count += 1
        self.unkept += seen.kind is None
        self._repeated = self._repeated + 1 if seen is self._last else 0
        self._last = seen

    def _new(self, recorded: list[Recorded]) -> Seen | None:
        """A frame that did not come before; None where it has no pass."""
        segments = _segments(recorded)
        if not any(segment.begin is not None for segment in segments):
            return None
        self._repeated = 0
        roles: dict[Image, Role] = {}
        shape = tuple(_shape(segment.begin, roles) for segment in segments if segment.begin is not None)
        kind = self.kinds.get(shape)
        if kind is None and len(self.kinds) < MAX_KINDS:
            passes = [segment.begin for segment in segments if segment.begin is not None]
            kind = self.kinds[shape] = Kind(len(self.kinds), list(roles), passes)
        between: list[list[Recorded]] = []
        if kind is not None:
            between = _join(kind, segments, roles)
            self._lifetimes(kind, recorded, roles)
        return Seen(kind, recorded, roles, between)

    def _lifetimes(self, kind: Kind, recorded: list[Recorded], roles: dict[Image, Role]) -> None:
        """What this frame reads of what others left, and what it leaves."""
        for image, own in ends_of(recorded).items():
            role = roles.get(image, image)
            for aspect, end in own.items():
                left: Left | None = image.left.get(aspect)
                if end.first == "read":
                    if left is not None and left.state == "unread":
                        left.kind.later.add((left.role, aspect))
                    if left is not None and left.state == "discarded":
                        kind.undefined.add((role, aspect))
                    else:
                        kind.defined.add((role, aspect))
                if end.last is not None:
                    image.left[aspect] = Left(end.last, kind, role)
                elif end.first == "read" and left is not None and left.state == "unread":
                    image.left[aspect] = left._replace(state="read")


def _counted(seen: Seen) -> None:
    """Adds the times that a frame came to its kind's, and to those of what it uses."""
    for made in (*seen.images, *seen.passes, *seen.pipelines):
        made.frames += seen.count
    if seen.kind is not None:
        seen.kind.count += seen.count
        for way, items in zip(seen.kind.between, seen.between, strict=True):
            _way(way, items, seen.count)
    seen.count = 0


def _join(kind: Kind, segments: list[Segment], roles: dict[Image, Role]) -> list[list[Recorded]]:
    """Adds what is recorded within the passes of a frame to its kind; what is recorded between them is the answer."""
    number = 0
    between: list[list[Recorded]] = []
    for segment in segments:
        if segment.begin is None:
            between.append([_with_roles(each, roles) for each in segment.items])
            continue
        if isinstance(segment.begin.key, Begin):
            alternates = kind.alternates[number]
            begin = segment.begin.key
            imageless = begin.framebuffer is None or begin.framebuffer.images is None
            if len(alternates) < MAX_ALTERNATES:
                alternates.setdefault(begin.images if imageless else begin.framebuffer, begin)
        within = kind.within[number]
        for part, each in _parts(segment.items):
            made = _with_roles(each, roles)
            identity = (part, made.kind, made.key)
            if identity not in within and len(within) < MAX_WITHIN:
                within[identity] = made
        number += 1
    return between


def _way(between: list[Way], items: list[Recorded], count: int) -> None:
    """Counts one way from a pass to the next."""
    bare = [(each.kind, each.key) for each in items]
    for way in between:
        if [(each.kind, each.key) for each in way.items] == bare:
            way.count += count
            return
    if len(between) < MAX_BETWEEN:
        between.append(Way(items, count))


def _segments(recorded: list[Recorded]) -> list[Segment]:
    """The passes of a frame and what stands before, between and after them, in turns."""
    made = [Segment(None)]
    within = False
    for each in recorded:
        if each.kind in BEGINS:
            if within:
                # A pass whose end is not in the capture.
                made.append(Segment(None))
            made.append(Segment(each))
            within = True
        elif each.kind in ENDS:
            if within:
                made.append(Segment(None))
            within = False
        elif each.kind == "nextSubpass" and not within:
            continue
        else:
            made[-1].items.append(each)
    if within:
        made.append(Segment(None))
    return made


def _parts(items: list[Recorded]) -> Iterable[tuple[int, Recorded]]:
    """The commands of a pass with the subpass that each is recorded in; a change of subpass begins the next."""
    part = 0
    for each in items:
        if each.kind == "nextSubpass":
            part += 1
        yield part, each


def _shape(begin: Recorded, roles: dict[Image, Role]) -> Hashable:
    """A pass as far as frames are told apart by it: images by their kind and by when the frame first draws to them."""
    if isinstance(begin.key, Begin):
        begun = begin.key
        size = (begun.framebuffer.width, begun.framebuffer.height, begun.framebuffer.layers) if begun.framebuffer is not None else None
        images = tuple(_role(image, roles) if image is not None else None for image in begun.images)
        return ("renderPass", id(begun.render_pass), images, size, begun.area)
    return ("rendering", _placed(begin.key, roles))


def _role(image: Image, roles: dict[Image, Role]) -> Hashable:
    if image not in roles:
        roles[image] = role_of(len(roles))
    return (roles[image], image.swapchain is not None, frozen(image.tree))


def _placed(key: Hashable, roles: dict[Image, Role]) -> Hashable:
    """A rendering with its images by their places."""
    if isinstance(key, Image):
        return _role(key, roles)
    return tuple(_placed(each, roles) for each in key) if isinstance(key, tuple) else key


def _with_roles(each: Recorded, roles: dict[Image, Role]) -> Recorded:
    """A command with the images that passes draw to by their places."""
    key: Hashable
    if isinstance(each.key, tuple) and not isinstance(each.key, Begin):
        key = tuple(roles.get(item, item) if isinstance(item, Image) else item for item in each.key)
    elif isinstance(each.key, Image):
        key = roles.get(each.key, each.key)
    else:
        return each
    return Recorded(each.kind, key, each.at, each.by, each.detail)
