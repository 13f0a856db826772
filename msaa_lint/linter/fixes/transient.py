"""`do: make-transient`: an image that nothing reads or loads becomes a transient attachment.

Metal's memoryless textures need the same steps; the shared functions are here.
"""

from __future__ import annotations

from collections.abc import Callable

from msaa_lint.frame.description.models import Command, Image
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.image import BESIDE_TRANSIENT
from msaa_lint.frame.facts.parts import Aspect, Attachment

from .changes import Change, NoFix
from .command_uses import COMMAND_USAGES
from .context import FixContext
from .subject_parts import described_image


def make_transient(subject: Subject, context: FixContext) -> list[Change]:
    """Replaces usages that nothing needs by TRANSIENT_ATTACHMENT, drops stores, and uses lazily
    allocated memory if available.
    """
    image = described_image(subject)
    check_unread(subject)
    return [
        *transient_usage(image, context, None),
        *drop_stores(image, context, _dont_store),
        *lazy_memory(image, subject),
    ]


def check_unread(subject: Subject) -> None:
    """Raises NoFix unless it is known that nothing reads or loads the image."""
    if (
        subject.facts.values.get("image.read") is not False
        or subject.facts.values.get("image.loaded") is not False
    ):
        raise NoFix("something reads or loads the image, or may do so")


def is_needed(
    usage: str | None, name: str, context: FixContext, without: Command | None = None
) -> bool:
    """Whether a command, other than `without`, may need a usage of an image. True also for usages
    that commands do not reveal.
    """
    complete = context.frame.has_commands and context.uses.complete
    return (
        not complete
        or usage not in COMMAND_USAGES
        or usage in context.uses.needed_usages(name, without)
    )


def transient_usage(image: Image, context: FixContext, without: Command | None) -> list[Change]:
    """Adds TRANSIENT_ATTACHMENT and removes the usages that exclude it
    (VUID-VkImageCreateInfo-usage-00963).

    Raises NoFix if a command, other than `without`, may need one of those usages.
    """
    conflicts = [usage for usage in image.usage or () if usage not in BESIDE_TRANSIENT]
    for usage in conflicts:
        if is_needed(usage, image.key, context, without):
            raise NoFix(f"`{image.key}` may need its usage {usage}")
    return [
        *(Change(image, "usage", "remove", usage) for usage in conflicts),
        Change(image, "usage", "add", "TRANSIENT_ATTACHMENT"),
    ]


def lazy_memory(image: Image, subject: Subject) -> list[Change]:
    """Adds LAZILY_ALLOCATED to the stated memory properties, unless the device offers no such
    memory.
    """
    if image.memory is None or subject.facts.values.get("device.lazy_memory") is False:
        return []
    return [Change(image, "memory", "add", "LAZILY_ALLOCATED")]


StoreChange = Callable[[Attachment, Aspect], Change | None]
"""The change that drops the store of an aspect, or None if the aspect is not stored."""


def drop_stores(image: Image, context: FixContext, store_change: StoreChange) -> list[Change]:
    """Drops all stores of an image. Raises NoFix if something may read what a pass stores."""
    changes: list[Change] = []
    for render_pass, attachment in context.attachments.get(id(image), ()):
        for aspect in attachment.aspects:
            change = store_change(attachment, aspect)
            if change is None or context.frame.whether_begun(render_pass) == "NO":
                continue
            if context.analysis.readers.read_later(render_pass, attachment, aspect) is not False:
                raise NoFix(
                    f"something may read what `{render_pass.name}` stores in {attachment.title}"
                )
            changes.append(change)
    return changes


def _dont_store(attachment: Attachment, aspect: Aspect) -> Change | None:
    stored = attachment.used and aspect.store == "STORE"
    return Change(attachment.record, aspect.store_member, "set", "DONT_CARE") if stored else None
