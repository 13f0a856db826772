"""`do: resolve-before-read`: an image that a shader reads to average its samples is resolved by the pass that draws it, and the shader
reads the result, an image of its own with one sample.

The shader has to be written for that; this is to show, and to price, what it takes. Refused as a vkCmdResolveImage's is.
"""

from __future__ import annotations

from bisect import bisect_left
from copy import copy
from typing import Any

from msaa_lint.frame.description.models import ReadImage
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.frame import Target
from msaa_lint.frame.facts.pass_begin import targets_at
from msaa_lint.frame.facts.timeline import READ

from .changes import Change, FixContext, Refused
from .inline_resolve import MAX_ATTACHMENTS, Site, into_pass, suspended
from .transient import memory_changes, usage_changes

_ENDINGS = ("_multisampled", "_msaa", "_ms", "MSAA", "Ms", "MS")
"""What names of multisampled images end with."""


def resolve_before_read(subject: Subject, mending: FixContext) -> list[Change] | Refused:
    """The changes that put a resolve in place of a shader's."""
    site = _site(subject, mending)
    if isinstance(site, Refused):
        return site
    made = into_pass(site, mending)
    if isinstance(made, Refused):
        return made
    source = _source(site, mending, subject.facts.values.get("device.lazy_memory"))
    if isinstance(source, Refused):
        return source
    return [_image(site, mending), *(_laid_out(change, site) for change in made), *source, *_read(site)]


def _site(subject: Subject, mending: FixContext) -> Site | Refused:
    frame = mending.frame
    position, target = subject.of if isinstance(subject.of, tuple) else (None, None)
    source = frame.target(target.name) if isinstance(target, Target) else None
    if not isinstance(position, int) or source is None or source.image is None:
        return Refused("the image is not described")
    if source.samples is None or source.samples < 2 or source.format is None or "color" not in source.format.aspects:
        return Refused("how it would be resolved is not known")
    drew = mending.writers.get(source.name, [])
    last = bisect_left(drew, position, key=lambda writer: writer[0]) - 1
    begin, within = drew[last] if last >= 0 else (0, None)
    if within is None or len(within.begun) != 1 or within.custom_resolve or suspended(within) or len(within.attachments) > MAX_ATTACHMENTS:
        return Refused("the pass that draws it does not come once, just before it")
    drawn = [each for each in within.attachments if any(own.record is source.record for own in targets_at(frame, each, begin))]
    if len(drawn) != 1 or drawn[0].target is None or not drawn[0].color or drawn[0].input:
        return Refused("it is no plain colour attachment of that pass")
    resolved = copy(source.image)
    resolved.key, resolved.presentable, resolved.samples = _name(source.name, mending), None, 1
    return Site(frame.commands[position], position, within, begin, drawn[0], source.image, resolved, False)


def _name(name: str, mending: FixContext) -> str:
    """A name for what is resolved to: without the ending that says multisampled, if that is free."""
    images = mending.document.description.images
    short = next((name.removesuffix(ending) for ending in _ENDINGS if name.endswith(ending) and name != ending), "")
    wanted = [short, f"{name}_resolved", *(f"{name}_resolved_{n}" for n in range(2, 3 + len(images)))]
    return next(each for each in wanted if each and each not in images)


def _image(site: Site, mending: FixContext) -> Change:
    """The image that is resolved to."""
    target = mending.frame.targets[site.source.key]
    data: dict[str, Any] = {"format": target.format.name if target.format is not None else "", "samples": 1}
    if site.source.usage is not None:
        data["usage"] = ["COLOR_ATTACHMENT", "SAMPLED"]
    extent = site.source.extent
    if extent is not None:
        data["extent"] = {side: value for side in ("width", "height") if (value := getattr(extent, side)) is not None}
    return Change(mending.document.description, "images", "entry", (site.target.key, data))


def _laid_out(change: Change, site: Site) -> Change:
    """A new attachment is left in the layout that a shader reads."""
    if change.action != "entry" or not site.attachment.record.states("finalLayout"):
        return change
    key, data = change.value
    return change._replace(value=(key, {**data, "finalLayout": "SHADER_READ_ONLY_OPTIMAL"}))


def _source(site: Site, mending: FixContext, lazy_memory: object) -> list[Change] | Refused:
    """What nothing else reads is not stored, and takes no memory."""
    uses = mending.timeline.uses.get(site.source.key, [])
    if not mending.timeline.followed or any(use.kind == READ and use.position != site.position for use in uses):
        return []
    record = site.attachment.record
    made = [Change(record, "storeOp", "set", "DONT_CARE")] if record.storeOp == "STORE" else []
    if getattr(record, "finalLayout", None) == "SHADER_READ_ONLY_OPTIMAL":
        made.append(Change(record, "finalLayout", "set", "COLOR_ATTACHMENT_OPTIMAL"))
    if site.source.usage is None:
        return made
    changed = usage_changes(site.source, mending, site.command)
    return changed if isinstance(changed, Refused) else [*made, *changed, *memory_changes(site.source, lazy_memory)]


def _read(site: Site) -> list[Change]:
    """The read, of one sample now."""
    body = site.command.body
    assert isinstance(body, ReadImage)
    made = [Change(body, "image", "set", site.target.key)]
    if body.states("samples"):
        made.append(Change(body, "samples", "set", 1))
    return [*made, Change(body, "resolves", "unset")] if body.states("resolves") else made
