"""`do: make-transient`: an image that nothing reads or loads becomes a transient attachment, with all that this takes."""

from __future__ import annotations

from msaa_lint.frame.description.models import Command, Image
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Target
from msaa_lint.frame.facts.image import BESIDE_TRANSIENT

from .changes import Change, FixContext, Refused
from .usages import TOLD_BY_COMMANDS


def make_transient(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """TRANSIENT_ATTACHMENT in place of usages that nothing needs; no store; lazily allocated memory where the device may offer it."""
    target = subject.of
    if not isinstance(target, Target) or target.image is None:
        return Refused("the image is not described")
    values = subject.facts.values
    if values.get("image.read") is not False or values.get("image.loaded") is not False:
        return Refused("something reads or loads it, or may")
    usage = usage_changes(target.image, mending, None)
    if isinstance(usage, Refused):
        return usage
    stores = _stores(target, mending)
    if isinstance(stores, Refused):
        return stores
    return [*usage, *stores, *memory_changes(target.image, values.get("device.lazy_memory"))]


def usage_changes(image: Image, mending: FixContext, without: Command | None) -> list[Change] | Refused:
    """TRANSIENT_ATTACHMENT, and out with what may not stand beside it (VUID-VkImageCreateInfo-usage-00963), where no command needs that,
    one command left out."""
    conflicts = [flag for flag in image.usage or () if flag not in BESIDE_TRANSIENT]
    uses = mending.usages.needed(image.key, without)
    told = mending.frame.has_commands and mending.usages.followed
    for flag in conflicts:
        if flag in uses or flag not in TOLD_BY_COMMANDS or not told:
            return Refused(f"its usage {flag} may be needed")
    return [*(Change(image, "usage", "remove", flag) for flag in conflicts), Change(image, "usage", "add", "TRANSIENT_ATTACHMENT")]


def memory_changes(image: Image, lazy_memory: object) -> list[Change]:
    """LAZILY_ALLOCATED beside the memory flags that are stated, unless the device offers none."""
    return [Change(image, "memory", "add", "LAZILY_ALLOCATED")] if image.memory is not None and lazy_memory is not False else []


def _stores(target: Target, mending: FixContext) -> list[Change] | Refused:
    """DONT_CARE where an attachment of the image is stored by mistake: a transient one has no memory to be stored to."""
    found: list[Change] = []
    for each, attachment in mending.attachments.get(id(target.record), ()):
        for aspect in attachment.aspects if attachment.used else ():
            if aspect.store != "STORE":
                continue
            if mending.timeline.read_later(each, attachment, aspect) is not False:
                return Refused(f"whether something reads what {attachment.title} stores is not known")
            found.append(Change(attachment.record, aspect.store_member, "set", "DONT_CARE"))
    return found
