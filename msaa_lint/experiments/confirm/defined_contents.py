"""Which images have defined contents: undefined contents are neither shown nor compared."""

from __future__ import annotations

from . import parts
from .parts import CLEAR, COLOR, DEPTH, LOAD, NONE, RESUMING, STENCIL, STORE, SUSPENDING, Framebuffer, Pass, Plan, Step, Subpass

Key = tuple[int, int]
"""The number of an image and one of its aspects."""


class Contents:
    """Tracks the contents of the images of a plan step by step. With `assumed`, all images have defined contents: what is timed may be
    undefined, as nobody looks at it."""

    def __init__(self, plan: Plan, *, assumed: bool = False) -> None:
        self.plan = plan
        self.assumed = assumed
        self.known: set[Key] = set()
        self.suspended: set[Key] = set()

    def outputs(self) -> list[Key]:
        """The aspects of single-sampled images with defined contents."""
        return [
            (number, aspect)
            for number, image in enumerate(self.plan.images)
            for aspect in (COLOR, DEPTH, STENCIL)
            if image.samples == 1 and image.aspects & aspect and (number, aspect) in self.known
        ]

    def whole(self, number: int, aspects: int | None = None) -> bool:
        """Whether the contents of an image, or of some aspects, are entirely defined."""
        aspect_mask = self.plan.images[number].aspects if aspects is None else aspects
        return all((number, aspect) in self.known for aspect in (COLOR, DEPTH, STENCIL) if aspect_mask & aspect)

    def reads(self, step: Step) -> list[int]:
        """The images that a pass reads, except for those without defined contents."""
        return [inner.image for inner in step.inner if inner.kind == "read" and self.readable(inner.image)]

    def readable(self, number: int) -> bool:
        """Whether a built-in shader can read an image: its contents are defined, it may be sampled, and it has no integer format."""
        image = self.plan.images[number]
        usage = image.usage & parts.SAMPLED and not image.usage & parts.TRANSIENT
        aspect = image.aspects & (COLOR | DEPTH)
        return bool(usage and aspect and image.numeric not in ("UINT", "SINT") and image.type == 1) and (
            self.assumed or self.whole(number, aspect)
        )

    def begin(self, frame_pass: Pass, step: Step) -> None:
        """Applies the effects of a pass."""
        framebuffer = frame_pass.framebuffers[step.framebuffer]
        if frame_pass.kind == parts.RENDERING:
            self._rendering(frame_pass, step, framebuffer)
        else:
            self._render_pass(frame_pass, step, framebuffer)

    def transfer(self, step: Step) -> None:
        """Applies the effects of a command outside passes."""
        if step.kind in ("resolve", "copy", "blit"):
            source, target = (self.plan.images[n] for n in (step.source, step.target))
            aspects = source.aspects & target.aspects
            whole = (source.width, source.height) == (target.width, target.height) or step.kind == "blit"
            plain = source.layers == target.layers == source.levels == target.levels == 1
            self._set(step.target, target.aspects, False) if not whole or not plain else None
            for aspect in (COLOR, DEPTH, STENCIL):
                if aspects & aspect:
                    self._set(step.target, aspect, whole and plain and (step.source, aspect) in self.known)
        elif step.kind == "clear":
            self._set(step.target, self.plan.images[step.target].aspects, True)
        elif step.kind == "copyIn":
            self._set(step.target, self.plan.images[step.target].aspects, False)

    def _set(self, number: int, aspects: int, defined: bool) -> None:
        keys = {(number, aspect) for aspect in (COLOR, DEPTH, STENCIL) if aspects & aspect}
        self.known = self.known | keys if defined else self.known - keys

    def _load(self, number: int, aspect: int, operation: int, preserved: bool, covers_all: bool) -> None:
        before = (number, aspect) in self.known and preserved
        self._set(number, aspect, covers_all or before if operation == CLEAR else before if operation == LOAD else False)

    def _full(self, step: Step, number: int, layers: int) -> bool:
        image = self.plan.images[number]
        return step.area == (0, 0, image.width, image.height) and layers >= image.layers and image.levels == 1 and image.depth == 1

    def _render_pass(self, frame_pass: Pass, step: Step, framebuffer: Framebuffer) -> None:
        used = {r.attachment for s in frame_pass.subpasses for r in (*s.colors, *s.resolves, *s.depth_stencil, *s.depth_resolve, *s.inputs)}
        layers = max(framebuffer.layers, *(subpass.view_mask.bit_count() for subpass in frame_pass.subpasses))
        for index, (attachment, number) in enumerate(zip(frame_pass.attachments, framebuffer.images, strict=True)):
            covers_all = self._full(step, number, layers)
            image = self.plan.images[number]
            if index not in used:
                self._set(number, image.aspects, False)
                continue
            preserved = attachment.initial != 0
            self._load(number, image.aspects & (COLOR | DEPTH), attachment.load, preserved, covers_all)
            if image.aspects & STENCIL:
                stencil_preserved = attachment.stencil_initial != 0 if attachment.stencil_initial != NONE else preserved
                self._load(number, STENCIL, attachment.stencil_load, stencil_preserved, covers_all)
        for number, subpass in enumerate(frame_pass.subpasses):
            self._subpass(frame_pass, step, framebuffer, number, subpass, layers)
        for attachment, number in zip(frame_pass.attachments, framebuffer.images, strict=True):
            image = self.plan.images[number]
            if attachment.store != STORE:
                self._set(number, image.aspects & (COLOR | DEPTH), False)
            if attachment.stencil_store != STORE:
                self._set(number, STENCIL, False)

    def _subpass(self, frame_pass: Pass, step: Step, framebuffer: Framebuffer, at: int, subpass: Subpass, layers: int) -> None:
        images = framebuffer.images
        covered = self._covers(step, at) and (framebuffer.layers == 1 or subpass.view_mask > 0)
        colors = [images[reference.attachment] for reference in subpass.colors if reference.attachment != NONE]
        depths = [images[reference.attachment] for reference in subpass.depth_stencil]
        self._drawn(frame_pass, step, at, colors, depths[0] if depths else NONE, covered, layers)
        for color, target in zip(subpass.colors, subpass.resolves, strict=False):
            if NONE not in (color.attachment, target.attachment):
                self._resolve(step, images[color.attachment], images[target.attachment], COLOR, layers)
        for depth, target in zip(subpass.depth_stencil, subpass.depth_resolve, strict=False):
            for aspect, mode in ((DEPTH, subpass.depth_mode), (STENCIL, subpass.stencil_mode)):
                if mode and self.plan.images[images[target.attachment]].aspects & aspect:
                    self._resolve(step, images[depth.attachment], images[target.attachment], aspect, layers)

    def _drawn(self, frame_pass: Pass, step: Step, at: int, colors: list[int], depth: int, covered: bool, layers: int) -> None:
        """Applies the effects of draws on color: defined if they cover every pixel, undefined if they depend on undefined depth."""
        pipelines = [frame_pass.pipelines[i.pipeline] for i in step.inner if i.kind == "draw" and i.subpass == at]
        tests = any(p.depth_test and p.depth_compare not in (NEVER, ALWAYS) for p in pipelines)
        if depth != NONE and tests and self.plan.images[depth].aspects & DEPTH and (depth, DEPTH) not in self.known:
            for number in colors:
                self._set(number, COLOR, False)
            return
        for number in colors:
            if covered and self._full(step, number, layers):
                self._set(number, COLOR, True)

    def _covers(self, step: Step, subpass: int) -> bool:
        """Whether the draws of a subpass cover every pixel."""
        commands = [inner for inner in step.inner if inner.subpass == subpass]
        return any(i.covers for i in commands if i.kind == "draw") or any(i.kind == "read" and self.readable(i.image) for i in commands)

    def _resolve(self, step: Step, source: int, target: int, aspect: int, layers: int) -> None:
        # A resolve needs a multisampled source and a single-sampled target.
        fitting = self.plan.images[source].samples > 1 and self.plan.images[target].samples == 1
        whole = self._full(step, target, layers) or (target, aspect) in self.known
        self._set(target, aspect, fitting and whole and (source, aspect) in self.known)

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
        self._drawn(frame_pass, step, 0, colors, next((r.image for r, aspect in rendered if aspect == DEPTH), NONE), covered, layers)
        if frame_pass.flags & SUSPENDING:
            # Nothing is stored until the rendering ends.
            keys = {(r.image, aspect) for r, aspect in rendered}
            self.suspended |= self.known & keys
            self.known -= keys
            return
        for r, aspect in rendered:
            if r.mode and r.resolve_image != NONE:
                self._resolve(step, r.image, r.resolve_image, aspect, layers)
            if r.store != STORE:
                self._set(r.image, aspect, False)


NEVER, ALWAYS = 0, 7
"""VkCompareOp."""

_ROLES = {"color": COLOR, "depth": DEPTH, "stencil": STENCIL}
