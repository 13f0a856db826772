"""Which images have defined contents, and which contents a frame makes undefined: those are
overwritten with poison (scene.py), so that a picture shows where they are read. Contents that the
frame never wrote are neither, and are not read.
"""

from __future__ import annotations

from collections.abc import Iterator

from . import parts
from .parts import (
    CLEAR,
    COLOR,
    DEPTH,
    LOAD,
    LOAD_DONT_CARE,
    NONE,
    RESUMING,
    STENCIL,
    STORE,
    STORE_DONT_CARE,
    SUSPENDING,
    Framebuffer,
    Image,
    Pass,
    Plan,
    Step,
    Subpass,
)

Key = tuple[int, int]
"""The number of an image and one of its aspects."""


class Contents:
    """Tracks the contents of the images of a plan step by step. With `assumed`, all images have
    defined contents: what is timed may be undefined, as nobody looks at it.

    `known` are defined; `poisoned` are undefined because of the frame, or come from what is. `lost`
    are those that the last step made undefined by a store operation or a layout, whose texels are
    to be overwritten, and `discarded` all undefined ones that nothing was written to since.
    """

    def __init__(self, plan: Plan, *, assumed: bool = False) -> None:
        self.plan = plan
        self.assumed = assumed
        self.known: set[Key] = set()
        self.poisoned: set[Key] = set()
        self.lost: set[Key] = set()
        self.discarded: set[Key] = set()
        self.suspended: set[Key] = set()

    def outputs(self, poisoned: bool = False) -> list[Key]:
        """The aspects of single-sampled images with defined contents, or with `poisoned` ones
        too.
        """
        return [
            (number, aspect)
            for number, image in enumerate(self.plan.images)
            for aspect in (COLOR, DEPTH, STENCIL)
            if image.samples == 1
            and image.aspects & aspect
            and self._is_stated((number, aspect), poisoned)
        ]

    def _is_stated(self, key: Key, poisoned: bool = True) -> bool:
        return key in self.known or (poisoned and key in self.poisoned)

    def whole(self, number: int, aspects: int | None = None) -> bool:
        """Whether the contents of an image, or of some aspects, are entirely defined."""
        aspect_mask = self.plan.images[number].aspects if aspects is None else aspects
        return all(
            (number, aspect) in self.known
            for aspect in (COLOR, DEPTH, STENCIL)
            if aspect_mask & aspect
        )

    def reads(self, step: Step) -> list[int]:
        """The images that a pass reads, except for those without defined contents."""
        return [
            inner.image
            for inner in step.inner
            if inner.kind == "read" and self.readable(inner.image)
        ]

    def readable(self, number: int) -> bool:
        """Whether a built-in shader can read an image: its contents are defined, it may be sampled,
        and it has no integer format.
        """
        image = self.plan.images[number]
        usage = image.usage & parts.SAMPLED and not image.usage & parts.TRANSIENT
        aspect = image.aspects & (COLOR | DEPTH)
        return bool(
            usage and aspect and image.numeric not in ("UINT", "SINT") and image.type == 1
        ) and (
            self.assumed
            or all(self._is_stated((number, each)) for each in (COLOR, DEPTH) if aspect & each)
        )

    def lost_at_begin(self, frame_pass: Pass, step: Step) -> dict[Key, bool]:
        """What the beginning of a pass makes undefined, and whether that is the whole image rather
        than the render area alone.
        """
        lost: dict[Key, bool] = {}
        framebuffer = frame_pass.framebuffers[step.framebuffer]
        if frame_pass.kind == parts.RENDERING:
            layers = max(framebuffer.layers, frame_pass.view_mask.bit_count())
            for r in frame_pass.rendered:
                if (
                    r.image != NONE
                    and not frame_pass.flags & RESUMING
                    and (r.load == LOAD_DONT_CARE or _unread(r.load, r.store))
                ):
                    lost[r.image, _ROLES[r.role]] = self._full(step, r.image, layers)
            return lost
        used = _used(frame_pass)
        layers = max(
            framebuffer.layers, *(subpass.view_mask.bit_count() for subpass in frame_pass.subpasses)
        )
        for index, (attachment, number) in enumerate(
            zip(frame_pass.attachments, framebuffer.images, strict=True)
        ):
            full = self._full(step, number, layers)
            for aspect, load, store, preserved in self._operations(attachment, number):
                if not preserved and not (load == CLEAR and full and index in used):
                    lost[number, aspect] = True
                elif index in used and (load == LOAD_DONT_CARE or _unread(load, store)):
                    lost[number, aspect] = full
        return lost

    def _operations(
        self, attachment: parts.Attachment, number: int
    ) -> Iterator[tuple[int, int, int, bool]]:
        """By aspect: its load and store operation, and whether the initial layout preserves it."""
        preserved = attachment.initial != parts.UNDEFINED
        aspects = self.plan.images[number].aspects
        if aspects & (COLOR | DEPTH):
            yield aspects & (COLOR | DEPTH), attachment.load, attachment.store, preserved
        if aspects & STENCIL:
            stencil = (
                attachment.stencil_initial != parts.UNDEFINED
                if attachment.stencil_initial != NONE
                else preserved
            )
            yield STENCIL, attachment.stencil_load, attachment.stencil_store, stencil

    def begin(self, frame_pass: Pass, step: Step) -> None:
        """Applies the effects of a pass."""
        framebuffer = frame_pass.framebuffers[step.framebuffer]
        self.lost = set()
        if frame_pass.kind == parts.RENDERING:
            self._rendering(frame_pass, step, framebuffer)
        else:
            self._render_pass(frame_pass, step, framebuffer)

    def transfer(self, step: Step) -> None:
        """Applies the effects of a command outside passes."""
        self.lost = set()
        if step.illegal:
            return
        if step.kind in ("resolve", "copy", "blit"):
            source, target = (self.plan.images[n] for n in (step.source, step.target))
            aspects = source.aspects & target.aspects
            whole = (source.width, source.height) == (
                target.width,
                target.height,
            ) or step.kind == "blit"
            plain = source.layers == target.layers == source.levels == target.levels == 1
            self._set(step.target, target.aspects, False) if not whole or not plain else None
            for aspect in (COLOR, DEPTH, STENCIL):
                if aspects & aspect:
                    self._take(step.target, step.source, aspect, whole and plain)
        elif step.kind == "clear":
            self._set(step.target, self.plan.images[step.target].aspects, True)
        elif step.kind == "copyIn":
            self._set(step.target, self.plan.images[step.target].aspects, False)
        elif step.kind == "barrier":
            for number, old, _ in step.layouts:
                if old == parts.UNDEFINED:
                    self._lose(number, self.plan.images[number].aspects)

    def _set(self, number: int, aspects: int, defined: bool, poisoned: bool = False) -> None:
        keys = {(number, aspect) for aspect in (COLOR, DEPTH, STENCIL) if aspects & aspect}
        self.known = self.known | keys if defined else self.known - keys
        self.poisoned = self.poisoned | keys if poisoned and not defined else self.poisoned - keys
        self.discarded = self.discarded - keys

    def _lose(self, number: int, aspects: int) -> None:
        """Makes contents undefined, which are then overwritten."""
        self._set(number, aspects, False, True)
        keys = {(number, aspect) for aspect in (COLOR, DEPTH, STENCIL) if aspects & aspect}
        self.lost, self.discarded = self.lost | keys, self.discarded | keys

    def _take(self, target: int, source: int, aspect: int, whole: bool) -> None:
        """Gives an image the contents of another one, if that is whole."""
        self._set(
            target,
            aspect,
            whole and (source, aspect) in self.known,
            whole and (source, aspect) in self.poisoned,
        )

    def _load(
        self, number: int, aspect: int, operation: int, preserved: bool, covers_all: bool
    ) -> None:
        key = (number, aspect)
        before, poison = key in self.known and preserved, key in self.poisoned or not preserved
        unwritten = self.discarded & {key}
        if operation == CLEAR:
            self._set(number, aspect, covers_all or before, poison)
        elif operation == LOAD:
            self._set(number, aspect, before, poison)
            self.discarded |= unwritten if preserved else {key}
        else:
            self._set(number, aspect, False, True)
            self.discarded |= {key}

    def _full(self, step: Step, number: int, layers: int) -> bool:
        image = self.plan.images[number]
        return (
            step.area == (0, 0, image.width, image.height)
            and layers >= image.layers
            and image.levels == 1
            and image.depth == 1
        )

    def _render_pass(self, frame_pass: Pass, step: Step, framebuffer: Framebuffer) -> None:
        used = _used(frame_pass)
        layers = max(
            framebuffer.layers, *(subpass.view_mask.bit_count() for subpass in frame_pass.subpasses)
        )
        for index, (attachment, number) in enumerate(
            zip(frame_pass.attachments, framebuffer.images, strict=True)
        ):
            covers_all = self._full(step, number, layers)
            for aspect, load, _, preserved in self._operations(attachment, number):
                # Of an attachment that no subpass uses, the operations are ignored, but not the
                # layouts.
                self._load(number, aspect, load if index in used else LOAD, preserved, covers_all)
        for number, subpass in enumerate(frame_pass.subpasses):
            self._subpass(frame_pass, step, framebuffer, number, subpass, layers)
        for index, (attachment, number) in enumerate(
            zip(frame_pass.attachments, framebuffer.images, strict=True)
        ):
            for aspect, load, store, _ in self._operations(attachment, number):
                written = load == CLEAR or self._written(frame_pass, step, index, aspect)
                if index in used and (store == STORE_DONT_CARE or (store != STORE and written)):
                    self._lose(number, aspect)

    @staticmethod
    def _written(frame_pass: Pass, step: Step, index: int, aspect: int) -> bool:
        """Whether a render pass may write to an aspect of an attachment other than by its load
        operation.
        """
        for at, subpass in enumerate(frame_pass.subpasses):
            if any(
                r.attachment == index
                for r in (*subpass.colors, *subpass.resolves, *subpass.depth_resolve)
            ):
                return True
            if any(r.attachment == index for r in subpass.depth_stencil) and _writes(
                frame_pass, step, at, aspect
            ):
                return True
        return False

    def _subpass(
        self,
        frame_pass: Pass,
        step: Step,
        framebuffer: Framebuffer,
        at: int,
        subpass: Subpass,
        layers: int,
    ) -> None:
        images = framebuffer.images
        covered = self._covers(step, at) and (framebuffer.layers == 1 or subpass.view_mask > 0)
        colors = [
            images[reference.attachment]
            for reference in subpass.colors
            if reference.attachment != NONE
        ]
        depths = [images[reference.attachment] for reference in subpass.depth_stencil]
        self._drawn(frame_pass, step, at, colors, depths[0] if depths else NONE, covered, layers)
        for color, target in zip(subpass.colors, subpass.resolves, strict=False):
            if NONE not in (color.attachment, target.attachment):
                self._resolve(
                    step, images[color.attachment], images[target.attachment], COLOR, layers
                )
        for depth, target in zip(subpass.depth_stencil, subpass.depth_resolve, strict=False):
            for aspect, mode in ((DEPTH, subpass.depth_mode), (STENCIL, subpass.stencil_mode)):
                if mode and self.plan.images[images[target.attachment]].aspects & aspect:
                    self._resolve(
                        step, images[depth.attachment], images[target.attachment], aspect, layers
                    )

    def _drawn(
        self,
        frame_pass: Pass,
        step: Step,
        at: int,
        colors: list[int],
        depth: int,
        covered: bool,
        layers: int,
    ) -> None:
        """Applies the effects of draws on color: defined if they cover every pixel, undefined if
        they depend on undefined depth.
        """
        pipelines = [
            frame_pass.pipelines[i.pipeline]
            for i in step.inner
            if i.kind == "draw" and i.subpass == at
        ]
        if pipelines:
            self.discarded -= {(number, COLOR) for number in colors} | {
                (depth, DEPTH),
                (depth, STENCIL),
            }
        tests = any(p.depth_test and p.depth_compare not in (NEVER, ALWAYS) for p in pipelines)
        if (
            depth != NONE
            and tests
            and self.plan.images[depth].aspects & DEPTH
            and (depth, DEPTH) not in self.known
        ):
            for number in colors:
                self._set(number, COLOR, False, (depth, DEPTH) in self.poisoned)
            return
        shown = {
            (i.image, aspect)
            for i in step.inner
            if i.kind == "read" and i.subpass == at
            for aspect in (COLOR, DEPTH)
        }
        poisoned = bool(shown & self.poisoned)
        for number in colors:
            if poisoned:
                self._set(number, COLOR, False, True)
            elif covered and self._full(step, number, layers):
                self._set(number, COLOR, True)

    def _covers(self, step: Step, subpass: int) -> bool:
        """Whether the draws of a subpass cover every pixel."""
        commands = [inner for inner in step.inner if inner.subpass == subpass]
        return any(i.covers for i in commands if i.kind == "draw") or any(
            i.kind == "read" and self.readable(i.image) for i in commands
        )

    def _resolve(self, step: Step, source: int, target: int, aspect: int, layers: int) -> None:
        # A resolve needs a multisampled source and a single-sampled target.
        fitting = self.plan.images[source].samples > 1 and self.plan.images[target].samples == 1
        whole = self._full(step, target, layers) or (target, aspect) in self.known
        self._take(target, source, aspect, fitting and whole)

    def _rendering(self, frame_pass: Pass, step: Step, framebuffer: Framebuffer) -> None:
        layers = max(framebuffer.layers, frame_pass.view_mask.bit_count())
        rendered = [(r, _ROLES[r.role]) for r in frame_pass.rendered if r.image != NONE]
        for r, aspect in rendered:
            if frame_pass.flags & RESUMING:
                self.known |= self.suspended & {(r.image, aspect)}
                self.suspended.discard((r.image, aspect))
                continue
            self._load(r.image, aspect, r.load, True, self._full(step, r.image, layers))
        covered = self._covers(step, 0) and (framebuffer.layers == 1 or frame_pass.view_mask > 0)
        colors = [r.image for r, aspect in rendered if aspect == COLOR]
        self._drawn(
            frame_pass,
            step,
            0,
            colors,
            next((r.image for r, aspect in rendered if aspect == DEPTH), NONE),
            covered,
            layers,
        )
        if frame_pass.flags & SUSPENDING:
            # Nothing is stored until the rendering ends.
            keys = {(r.image, aspect) for r, aspect in rendered}
            self.suspended |= self.known & keys
            self.known -= keys
            self.poisoned -= keys
            return
        for r, aspect in rendered:
            if r.mode and r.resolve_image != NONE:
                self._resolve(step, r.image, r.resolve_image, aspect, layers)
            if r.store == STORE_DONT_CARE or (
                r.store != STORE
                and (r.load == CLEAR or aspect == COLOR or _writes(frame_pass, step, 0, aspect))
            ):
                self._lose(r.image, aspect)


NEVER, ALWAYS = 0, 7
"""VkCompareOp."""

_ROLES = {"color": COLOR, "depth": DEPTH, "stencil": STENCIL}


def _used(frame_pass: Pass) -> set[int]:
    """The attachments that a subpass of a render pass uses."""
    return {
        r.attachment
        for s in frame_pass.subpasses
        for r in (*s.colors, *s.resolves, *s.depth_stencil, *s.depth_resolve, *s.inputs)
    }


def _unread(load: int, store: int) -> bool:
    """Whether a pass does not see what an attachment held before (LOAD_OP_NONE), and the image does
    not keep it either.
    """
    return load not in (LOAD, CLEAR, LOAD_DONT_CARE) and store in (STORE, STORE_DONT_CARE)


def _writes(frame_pass: Pass, step: Step, subpass: int, aspect: int) -> bool:
    """Whether the commands of a subpass may write to depth or stencil."""
    commands = [inner for inner in step.inner if inner.subpass == subpass]
    pipelines = [frame_pass.pipelines[inner.pipeline] for inner in commands if inner.kind == "draw"]
    if any(inner.kind == "clear" and inner.aspects & aspect for inner in commands):
        return True
    return any(
        pipeline.depth_write if aspect == DEPTH else pipeline.stencil_test for pipeline in pipelines
    )


def read_later(plan: Plan) -> set[Key]:
    """What the images of a frame hold at its end that it presents, or that the next one reads
    before it overwrites it.
    """
    uses: dict[Key, list[str]] = {}
    for step in plan.steps:
        for number, aspect, use in _uses(plan, step):
            uses.setdefault((number, aspect), []).append(use)
    later = set()
    for key, each in uses.items():
        writes = [at for at, use in enumerate(each) if use != READ]
        after = each[writes[-1] + 1 :] if writes else each
        if after or each[0] == READ:
            later.add(key)
    return later


def aspect_name(image: Image, aspect: int) -> str:
    """The name of an aspect of an image, as results have it."""
    return f"{image.name}:stencil" if aspect == STENCIL and image.aspects != STENCIL else image.name


READ, WRITE = "read", "write"


def _uses(plan: Plan, step: Step) -> Iterator[tuple[int, int, str]]:
    """The images and aspects that a step reads and writes, in order."""
    if step.kind != "begin":
        transfers = step.kind in ("resolve", "copy", "blit", "copyOut", "present", "read")
        writes = step.kind in ("resolve", "copy", "blit", "clear", "copyIn") and not step.illegal
        if transfers and step.source != NONE:
            yield from ((step.source, aspect, READ) for aspect in _aspects(plan, step.source))
        if writes and step.target != NONE:
            yield from ((step.target, aspect, WRITE) for aspect in _aspects(plan, step.target))
        return
    frame_pass = plan.passes[step.number]
    framebuffer = frame_pass.framebuffers[step.framebuffer]
    for inner in step.inner:
        if inner.kind == "read":
            yield from ((inner.image, aspect, READ) for aspect in _aspects(plan, inner.image))
    contents = Contents(plan)
    if frame_pass.kind == parts.RENDERING:
        for r in frame_pass.rendered:
            if r.image != NONE:
                yield from (
                    (r.image, _ROLES[r.role], use)
                    for use in ((READ, WRITE) if r.load == LOAD else (WRITE,))
                )
            if r.resolve_image != NONE and r.mode:
                yield r.resolve_image, _ROLES[r.role], WRITE
        return
    used = _used(frame_pass)
    for index, (attachment, number) in enumerate(
        zip(frame_pass.attachments, framebuffer.images, strict=True)
    ):
        for aspect, load, _, preserved in contents._operations(attachment, number):
            if index in used:
                yield from (
                    (number, aspect, use)
                    for use in ((READ, WRITE) if load == LOAD and preserved else (WRITE,))
                )
        if attachment.final == parts.PRESENT_LAYOUT:
            yield number, COLOR, READ


def _aspects(plan: Plan, number: int) -> list[int]:
    return [aspect for aspect in (COLOR, DEPTH, STENCIL) if plan.images[number].aspects & aspect]
