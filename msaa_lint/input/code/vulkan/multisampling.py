"""Which configuration of a program is the multisampled one, and which unknown sample counts are
above 1 in it.

What the code does decides before what it calls its settings: a count of 1 that a condition replaces
by another count, a resolve, a resolve mode, a comparison with 1. All attachments of a subpass have
the same count (VUID-VkSubpassDescription-pDepthStencilAttachment-01418).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import Any

from msaa_lint.input.code.core.configurations import ASSUMED
from msaa_lint.input.code.core.elements import is_other_element
from msaa_lint.input.code.core.guards import Guards, negated
from msaa_lint.input.code.core.values import (
    UNKNOWN,
    ApiObject,
    Array,
    Flags,
    Ref,
    Struct,
    Symbol,
    Value,
    inner_cells,
    sole_value,
)

from .configurations import COUNTS, VulkanConfiguration, chosen_counts, guarded_structs

_FLAG = re.compile(r"[\w:.]*(?:msaa|multi_?sampl)\w*(?:\(\))?", re.IGNORECASE)
_OPPOSITE = re.compile(
    r"(?:^|[._:])(?:no|non|not|disable|without|skip|un)_?(?:msaa|multi)", re.IGNORECASE
)

NO_RESOLVE = (None, 0, "NONE", "VK_RESOLVE_MODE_NONE", "VK_RESOLVE_MODE_NONE_KHR")
"""Values of a resolve mode that resolves nothing."""

ALWAYS: Guards = frozenset()


class Multisampling(VulkanConfiguration):
    """Selects the multisampled configuration."""

    def choose_configuration(self) -> None:
        """Selects the conditions under which the program is multisampled."""
        slots = [
            under(struct.fields[name].writes, guards)
            for struct, name, guards in self.sample_slots()
            if name in struct.fields
        ]
        self.assume_counts(slots)
        for alternative in chain.from_iterable(slots):
            if isinstance(alternative.value, Symbol) and alternative.value.chosen:
                self.assume_multisampled(alternative.value, alternative.guards)
        for value in self.resolving_values():
            for write in value:
                if isinstance(write.value, (Ref, Array, Struct)) or (
                    isinstance(write.value, str) and write.value not in NO_RESOLVE
                ):
                    self.assume(write.guards)
        self.assume_replacements(slots)
        guards = self.guard_texts()
        # What is written at another unknown index is another element.
        self.configuration.update(dict.fromkeys(filter(is_other_element, guards), False))
        for text in guards:
            if (
                text not in self.configuration
                and _FLAG.fullmatch(text)
                and not _OPPOSITE.search(text)
            ):
                self.configuration[text] = True
        for alternative in chain.from_iterable(slots):
            if isinstance(alternative.value, Symbol) and f"{alternative.value.key}>1" in guards:
                self.assume_multisampled(alternative.value, alternative.guards)
        self.assume_no_fallback(slots)
        self.assume_present()
        for text in guards - self.configuration.keys():
            subject, _, other = text.partition("==")
            if self.equal.get(subject, other) != other:
                self.configuration[text] = False
        self.assume_same_counts()

    def assume_counts(self, slots: Iterable[Value]) -> None:
        """Assumes the conditions of the known counts above 1: of the count that every device
        supports, else of the lowest.
        """
        for value in slots:
            multisampled = [item for item in value if type(item.value) is int and item.value > 1]
            if chosen_counts(value):
                self.assume(frozenset.intersection(*(item.guards for item in multisampled)))
                continue
            for alternative in sorted(multisampled, key=lambda a: (a.value != ASSUMED, a.value)):
                self.assume(alternative.guards)

    def assume_replacements(self, slots: Iterable[Value]) -> None:
        """Assumes the conditions under which an unknown count takes the place of 1."""
        for value in slots:
            if any(item.value == 1 and type(item.value) is int for item in value):
                for item in value:
                    if isinstance(item.value, Symbol) and item.guards:
                        self.assume_multisampled(item.value, item.guards)

    def assume_no_fallback(self, slots: Iterable[Value]) -> None:
        """Assumes that no condition holds under which 1 takes the place of a count above 1, one
        that a device does not support.
        """
        for value in slots:
            settled = self.settle(value) if len(value) > 1 else ()
            if any(
                isinstance(item.value, Symbol) or (type(item.value) is int and item.value > 1)
                for item in settled
            ):
                for item in settled:
                    if item.value == 1 and type(item.value) is int and item.guards:
                        self.assume(negated(item.guards))

    def assume_present(self) -> None:
        """Assumes the conditions of optional attachments, subpasses, and references, so that the
        lists are known.
        """
        for obj in self.current_objects:
            if (
                obj.kind == "renderPass"
                and self.assume_elements(obj.info, "attachments")
                and self.assume_elements(obj.info, "subpasses")
            ):
                for subpass in self.subpasses(obj):
                    for name in ("colorAttachments", "resolveAttachments", "inputAttachments"):
                        self.assume_elements(subpass, name)
            if obj.kind == "rendering":
                self.assume_elements(obj.info, "colorAttachments")

    def assume_elements(self, struct: Struct, name: str) -> bool:
        """Assumes that the optional elements of a list exist, as many as it can have. Returns
        whether there is such a list.
        """
        array = self.dereference(self.get(struct, name)[0])
        for cell in array.items if isinstance(array, Array) else ():
            writes = self.settle(cell.writes)
            if writes and all(write.guards for write in writes):
                self.assume(writes[-1].guards)
        count = struct.fields.get(COUNTS.get(name, ""))
        counts = (
            [item for item in self.settle(count.writes) if type(item.value) is int]
            if count is not None
            else []
        )
        if len(counts) > 1:
            self.assume(max(counts, key=lambda item: int(item.value)).guards)
        return isinstance(array, (Array, Struct))

    def sample_slots(self) -> Iterator[tuple[Struct, str, Guards]]:
        """Yields the structures with a sample count, the member that holds it, and the conditions
        of the structure.
        """
        for obj in self.current_objects:
            yield from (
                (obj.info, name, ALWAYS)
                for name in ("samples", "rasterizationSamples")
                if name in obj.info.fields
            )
            if obj.kind == "renderPass" and "attachments" in obj.info.fields:
                yield from (
                    (struct, "samples", guards)
                    for struct, guards in guarded_structs(obj.info.fields["attachments"], 0)
                )
            state = self.struct(obj.info, "multisampleState")
            if state is not None:
                yield state, "rasterizationSamples", ALWAYS

    def resolving_values(self) -> Iterator[Value]:
        """Yields the members that resolve where they are neither null nor NONE."""
        for obj in self.current_objects:
            if obj.kind == "renderPass" and "subpasses" in obj.info.fields:
                for subpass, guards in guarded_structs(obj.info.fields["subpasses"], 0):
                    yield from (
                        under(subpass.fields[name].writes, guards)
                        for name in ("resolveAttachments",)
                        if name in subpass.fields
                    )
                    chained = (
                        self.dereference(self.get(subpass, "next")[0])
                        if "next" in subpass.fields
                        else None
                    )
                    if (
                        isinstance(chained, Struct)
                        and chained.kind == "SubpassDescriptionDepthStencilResolve"
                    ):
                        yield under(subpass.fields["next"].writes, guards)
            if obj.kind == "rendering":
                for name in ("colorAttachments", "depthAttachment"):
                    for attachment, guards in (
                        guarded_structs(obj.info.fields[name], 0) if name in obj.info.fields else ()
                    ):
                        if "resolveMode" in attachment.fields:
                            yield under(attachment.fields["resolveMode"].writes, guards)

    def guard_texts(self) -> set[str]:
        """Returns the conditions that anything depends on."""
        texts: set[str] = set()
        seen: set[int] = set()
        stack: list[Any] = [obj.info for obj in self.current_objects]
        texts.update(text for obj in self.current_objects for text, _ in obj.guards)
        while stack:
            for cell in inner_cells(stack.pop()):
                if id(cell) not in seen:
                    seen.add(id(cell))
                    for write in cell.writes:
                        texts.update(text for text, _ in write.guards)
                        stack.append(write.value)
        return texts

    def assume_same_counts(self) -> None:
        """Finds the structures whose unknown count is above 1: what is resolved, and what is drawn
        together with it.
        """
        for sources, resolved in self.drawn_together():
            for struct in resolved:
                self.mark_multisampled(struct)
            known = {count for struct in sources if (count := self.samples(struct)[0]) is not None}
            for struct in sources if known and 1 not in known else ():
                self.mark_multisampled(struct)

    def mark_multisampled(self, struct: Struct) -> None:
        self.multisampled_structs.add(id(struct))
        for alternative in (
            self.settle(struct.fields["samples"].writes) if "samples" in struct.fields else ()
        ):
            if isinstance(alternative.value, Symbol):
                self.assume_multisampled(alternative.value, alternative.guards)

    def drawn_together(self) -> Iterator[tuple[list[Struct], list[Struct]]]:
        """Yields the structures with the sample counts of attachments that are drawn together, and
        those of them that are resolved.
        """
        for ends in self.resolves.values():
            source = self.dereference(sole_value(self.settle(ends[0])))
            if isinstance(source, ApiObject) and source.kind == "image":
                yield [], [source.info]
        for obj in self.current_objects:
            if obj.kind == "renderPass":
                attachments = self.structs(obj.info, "attachments") or []
                for subpass in self.subpasses(obj):
                    yield self.drawn_by_subpass(subpass, attachments)
            if obj.kind == "rendering":
                colors = self.structs(obj.info, "colorAttachments") or ()
                structs = [
                    *colors,
                    self.struct(obj.info, "depthAttachment"),
                    self.struct(obj.info, "stencilAttachment"),
                ]
                images = [
                    (struct, self.image_of(struct, "imageView"))
                    for struct in structs
                    if struct is not None
                ]
                resolved = [
                    image.info
                    for struct, image in images
                    if image is not None and self.resolves_attachment(struct)
                ]
                yield [image.info for _, image in images if image is not None], resolved
            if obj.kind == "image" and self.is_transient_color(obj.info):
                yield [], [obj.info]

    def drawn_by_subpass(
        self, subpass: Struct, attachments: Sequence[Struct | None]
    ) -> tuple[list[Struct], list[Struct]]:
        colors, targets = (
            self.structs(subpass, "colorAttachments"),
            self.structs(subpass, "resolveAttachments"),
        )
        sources = [self.referent(reference, attachments) for reference in colors or ()]
        ends = [self.referent(target, attachments) for target in targets or ()]
        resolved = [
            source
            for source, end in zip(sources, ends, strict=False)
            if source is not None and end is not None
        ]
        depth = self.referent(self.struct(subpass, "depthStencilAttachment"), attachments)
        chained = (
            self.dereference(self.get(subpass, "next")[0]) if "next" in subpass.fields else None
        )
        kind = chained.kind if isinstance(chained, Struct) else ""
        if kind == "MultisampledRenderToSingleSampledInfo":
            return [], []
        if (
            isinstance(chained, Struct)
            and kind == "SubpassDescriptionDepthStencilResolve"
            and depth is not None
        ):
            target = self.referent(
                self.struct(chained, "depthStencilResolveAttachment"), attachments
            )
            resolved += [depth] if target is not None else []
        return [struct for struct in (*sources, depth) if struct is not None], resolved

    def referent(
        self, reference: Struct | None, attachments: Sequence[Struct | None]
    ) -> Struct | None:
        """Returns the attachment that a reference refers to, or None."""
        index = self.get(reference, "attachment")[0] if reference is not None else UNKNOWN
        index = 0 if index is None else index
        return attachments[index] if type(index) is int and 0 <= index < len(attachments) else None

    def resolves_attachment(self, attachment: Struct) -> bool:
        """Returns whether an attachment of a rendering certainly has a resolve mode."""
        mode = self.get(attachment, "resolveMode")[0]
        return isinstance(mode, str) and mode not in NO_RESOLVE

    def subpasses(self, render_pass: ApiObject) -> Iterator[Struct]:
        return (
            struct
            for struct in self.structs(render_pass.info, "subpasses") or ()
            if struct is not None
        )

    def is_transient(self, info: Struct) -> bool:
        return "TRANSIENT" in self.usage_text(info)

    def is_transient_color(self, info: Struct) -> bool:
        """Returns whether an image is a transient color attachment that no subpass reads: with one
        sample it would hold nothing to keep.
        """
        usage = self.usage_text(info)
        return "TRANSIENT" in usage and "COLOR" in usage and "INPUT" not in usage

    def usage_text(self, info: Struct) -> str:
        value = self.get(info, "usage")[0]
        bits = value.bits if isinstance(value, Flags) else ((value, info.at),)
        return " ".join(bit for bit, _ in bits if isinstance(bit, str))


def under(value: Value, guards: Guards) -> Value:
    """Returns a value that applies only under some conditions."""
    return tuple(item._replace(guards=item.guards | guards) for item in value) if guards else value
