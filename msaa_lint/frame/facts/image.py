"""Facts of images."""

from __future__ import annotations

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import AttachmentDescription, Enabled, Image, ReadImage
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.devices.shares import sample_count_share
from msaa_lint.frame.vulkan.formats import Format

from .commands import PRESENT, accesses, image_of
from .compression import is_valhall_or_later
from .facts import Facts
from .frame import Frame
from .parts import RENDER_PASS, RENDERING, Attachment, Target
from .readers import READS, Readers, usage_reads

BESIDE_TRANSIENT = frozenset(
    {"TRANSIENT_ATTACHMENT", "COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT", "INPUT_ATTACHMENT"}
)
"""VUID-VkImageCreateInfo-usage-00963."""

COMPRESSION_BLOCKERS = {
    "amd": ("STORAGE", "MUTABLE_FORMAT", "CONCURRENT"),
    "arm": ("STORAGE", "MUTABLE_FORMAT", "LINEAR"),
    "nvidia": ("LINEAR",),
}
"""What keeps a vendor's GPUs from compressing a render target: the validation layer's advice for
AMD and NVIDIA, Arm's for AFBC, which MUTABLE_FORMAT rules out before Valhall alone.
"""

RENDER_TO_SINGLE_SAMPLED = "MULTISAMPLED_RENDER_TO_SINGLE_SAMPLED_EXT"
"""The creation flag of images that VK_EXT_multisampled_render_to_single_sampled renders to."""

_ATTACHMENT_USAGES = BESIDE_TRANSIENT - {"TRANSIENT_ATTACHMENT"}
_RENDER_TARGET_USAGES = frozenset({"COLOR_ATTACHMENT", "DEPTH_STENCIL_ATTACHMENT"})


class Bindings:
    """What a frame does with its images. Images and those that stand for attachments without one go
    by their records.
    """

    __slots__ = (
        "_idle",
        "_usages",
        "attachments",
        "begun",
        "presented",
        "reads",
        "resolve_ends",
        "resolved",
    )

    def __init__(self, frame: Frame) -> None:
        self.attachments: dict[int, list[Attachment]] = {}
        """The attachments that an image is bound to, also by a framebuffer that no command
        names.
        """
        self.begun: set[int] = set()
        """The images that a pass which the commands begin is bound to."""
        self.resolved: set[int] = set()
        """The images that a resolve within a pass writes."""
        ends = (
            end
            for _, resolve in frame.resolve_commands
            for end in (resolve.source_image, resolve.target_image)
        )
        self.resolve_ends = {id(end.record) for end in ends if end is not None}
        """The images that a resolve reads or writes."""
        self.reads: dict[str, list[ReadImage]] = {}
        self.presented = {
            image_of(command, PRESENT): command.head
            for command in frame.commands
            if command.kind == "present"
        }
        """The images that a command presents, each with the place of a command that does."""
        self._idle: set[int] = set()
        """The attachments, by identity, of passes that the frame does not begin."""
        for render_pass in frame.passes:
            if frame.whether_begun(render_pass) == "NO":
                self._idle.update(map(id, render_pass.attachments))
            for attachment in render_pass.attachments:
                records = {id(target.record) for target in attachment.targets}
                for record in records:
                    self.attachments.setdefault(record, []).append(attachment)
                if render_pass.begun:
                    self.begun |= records
            targets = (resolve.target_image for resolve in render_pass.resolves)
            self.resolved.update(id(target.record) for target in targets if target is not None)
            sources = (resolve.source_image for resolve in render_pass.resolves)
            self.resolve_ends.update(id(source.record) for source in sources if source is not None)
        self._usages: dict[str, list[tuple[str, tuple[str, Span]]]] = {}
        """The usages that commands and the resolves of renderings need, by image."""
        self._add_usages(frame)
        passes = {
            render_pass.name: render_pass
            for render_pass in frame.passes
            if render_pass.kind == RENDER_PASS
        }
        begun_with = {
            id(attachment): set(map(id, attachment.targets))
            for each in passes.values()
            for attachment in each.attachments
        }
        for framebuffer in frame.description.framebuffers.values():
            bound_to = passes.get(framebuffer.renderPass or "")
            for attachment, name in zip(
                bound_to.attachments if bound_to is not None else (),
                framebuffer.attachments,
                strict=False,
            ):
                target = frame.target(name)
                if target is not None and id(target) not in begun_with[id(attachment)]:
                    self.attachments.setdefault(id(target.record), []).append(attachment)
        for _, body in frame.recorded(ReadImage):
            if body.image is not None:
                self.reads.setdefault(body.image, []).append(body)

    def _add_usages(self, frame: Frame) -> None:
        for render_pass in frame.passes:
            for resolve in render_pass.resolves if render_pass.kind == RENDERING else ():
                if resolve.target_image is not None and resolve.is_certain:
                    usage = (
                        "COLOR_ATTACHMENT"
                        if resolve.aspect == "color"
                        else "DEPTH_STENCIL_ATTACHMENT"
                    )
                    self._usages.setdefault(resolve.target_image.name, []).append(
                        (usage, (render_pass.name, resolve.target_at))
                    )
        for command in frame.commands:
            for name, access in accesses(command):
                target = frame.target(name)
                # The usage of a stencil aspect may be stated apart (VkImageStencilUsageCreateInfo),
                # which is not read.
                has_stencil = target is not None and (
                    target.format is None or "stencil" in target.format.aspects
                )
                if len(access.usages) == 1 and not has_stencil and isinstance(command.body, Record):
                    self._usages.setdefault(name, []).append(
                        (access.usages[0], (command.kind, command.body.place(access.member)))
                    )

    def needed_usages(self, target: Target) -> dict[str, tuple[str, Span]]:
        """The usages that an image needs, each with the name of a pass or command that needs it,
        and where that states it.
        """
        found: dict[str, tuple[str, Span]] = {}
        for attachment in self.used_by(target.record):
            aspects = set().union(*attachment.resolve.values())
            roles = (
                ("COLOR_ATTACHMENT", attachment.color or "color" in aspects),
                ("DEPTH_STENCIL_ATTACHMENT", attachment.depth_stencil or aspects - {"color"}),
                (
                    "INPUT_ATTACHMENT",
                    attachment.input and isinstance(attachment.record, AttachmentDescription),
                ),
            )
            for usage in (usage for usage, is_used in roles if is_used):
                found.setdefault(usage, (attachment.title, attachment.record.head))
        for name, use in self._usages.get(target.name, ()) if target.image is not None else ():
            found.setdefault(name, use)
        return found

    def used_by(self, record: Record) -> list[Attachment]:
        """Those of `attachments` in passes that the frame may begin."""
        return [
            attachment
            for attachment in self.attachments.get(id(record), ())
            if id(attachment) not in self._idle
        ]


def image_facts(
    target: Target, bindings: Bindings, frame: Frame, readers: Readers, device: DeviceProfile | None
) -> Facts:
    """What is known of an image by itself, and by what the frame does with it."""
    facts = Facts()
    image, record = target.image, target.record
    bound = bindings.used_by(record)
    rendered = _rendered(target, bound, bindings)
    facts.put("image.name", target.title, record.head)
    facts.put("image.stated", image is not None)
    facts.put("image.is_data", image is not None and image.encoding == "DATA")
    facts.put("image.samples", target.samples, record.place("samples"))
    format = target.format
    format_at = record.place("format")
    facts.put("image.format", format.name if format is not None else None, format_at)
    if format is not None:
        facts.put("image.is_color", "color" in format.aspects, format_at)
        facts.put("image.numeric", format.numeric or None, format_at)
        facts.put("image.is_half_float", format.is_float16)
    if target.samples == 1:
        facts.put("image.supported", True)
    supported, whole = supported_samples(target, device)
    if supported is not None and device is not None:
        offered = target.samples == 1 or target.samples in supported
        if whole or not offered:
            facts.put("image.supported_samples", list(supported))
        # What a class of devices does not promise, a device of it may offer; framebuffer limits say
        # nothing of what no pass draws to.
        decided = (
            target.samples is not None
            and (whole or not offered)
            and (offered or not device.minimum)
        )
        if decided and (image is None or image.usage is None or rendered):
            facts.put("image.supported", offered, record.place("samples"))
    if target.samples is not None:
        facts.put("image.share_of_devices", sample_count_share(target.samples, tilers=False))
        facts.put("image.share_of_tilers", sample_count_share(target.samples, tilers=True))
    facts.put("image.loaded", _loaded(bound, frame))
    facts.put(
        "image.resolved", id(record) in bindings.resolved or id(record) in bindings.resolve_ends
    )
    stated = image is not None and bool(image.presentable)
    command_at = bindings.presented.get(target.name) if image is not None else None
    facts.put(
        "image.presented",
        stated or command_at is not None,
        record.place("presentable") if stated else command_at,
    )
    if image is None:
        facts.put("image.is_render_target", rendered)
        return facts
    facts.put("image.type", image.imageType, image.place("imageType"))
    facts.put("image.tiling", image.tiling, image.place("tiling"))
    facts.put("image.mip_levels", image.mipLevels, image.place("mipLevels"))
    facts.put("image.flags", list(image.flags), image.place("flags"))
    if image.states("flags") or not (image.presentable or frame.document.format == ""):
        at = image.flag_place("flags", (RENDER_TO_SINGLE_SAMPLED,))
        facts.put("image.single_sampled_flag", RENDER_TO_SINGLE_SAMPLED in image.flags, at)
    facts.put("image.sharing_mode", image.sharingMode, image.place("sharingMode"))
    _put_first(
        facts,
        "image.multisampling_conflicts",
        _multisampling_conflicts(image, format, frame.description.enabled),
    )
    facts.put("image.presentable", image.presentable, image.place("presentable"))
    facts.put("image.encoding", image.encoding, image.place("encoding"))
    if image.memory is not None:
        facts.put("image.memory", list(image.memory), image.place("memory"))
        facts.put(
            "image.lazily_allocated",
            "LAZILY_ALLOCATED" in image.memory,
            image.flag_place("memory", ("LAZILY_ALLOCATED",)),
        )
    if image.usage is not None:
        at = image.place("usage")
        facts.put("image.usage", list(image.usage), at)
        transient_at = image.flag_place("usage", ("TRANSIENT_ATTACHMENT",))
        facts.put("image.transient", "TRANSIENT_ATTACHMENT" in image.usage, transient_at)
        facts.put("image.attachment_usage", not _ATTACHMENT_USAGES.isdisjoint(image.usage), at)
        if (
            (target.samples or 0) > 1
            or id(record) in bindings.resolved
            or id(record) in bindings.resolve_ends
        ):
            missing = {
                usage: use
                for usage, use in bindings.needed_usages(target).items()
                if usage not in image.usage
            }
            facts.put("image.missing_usages", list(missing), at)
            for user, place in list(missing.values())[:1]:
                facts.put("image.usage_needed_by", user, place)
        elif target.samples is not None:
            facts.put("image.missing_usages", [], at)
        conflicts = [usage for usage in image.usage if usage not in BESIDE_TRANSIENT]
        facts.put(
            "image.transient_conflicts",
            conflicts,
            image.flag_place("usage", conflicts) if conflicts else transient_at,
        )
        facts.put("image.is_render_target", rendered, at)
    elif rendered:
        facts.put("image.is_render_target", True)
    else:
        facts.places["image.usage"] = record.head
    blockers = _compression_blockers(image, device)
    if blockers or None not in (image.usage, image.sharingMode, image.tiling):
        _put_first(facts, "image.compression_blockers", blockers)
    facts.put("image.read", _read(target, bindings, frame, readers))
    facts.put("image.read_on_tile", any(attachment.input for attachment in bound))
    reads = bindings.reads.get(target.name, [])
    averages = next((body.place("resolves") for body in reads if body.resolves == "AVERAGE"), None)
    facts.put("image.averaged_by_reader", _averaged(reads, frame), averages)
    return facts


def supported_samples(
    target: Target, device: DeviceProfile | None
) -> tuple[tuple[int, ...] | None, bool]:
    """The counts that a device offers for the aspects of an image's format, and whether those of
    every aspect are known.

    None where nothing is known.
    """
    format = target.format
    if device is None or format is None:
        return None, False
    lists = counts_by_aspect(format, device)
    known = [counts for counts in lists if counts is not None]
    if not known:
        return None, False
    return tuple(count for count in known[0] if all(count in counts for counts in known)), len(
        known
    ) == len(lists)


def counts_by_aspect(format: Format, device: DeviceProfile) -> list[tuple[int, ...] | None]:
    """The counts that a device offers for each aspect of a format; None where they are not
    known.
    """
    color = device.integer_samples if format.is_integer else device.color_samples
    offered = {"color": color, "depth": device.depth_samples, "stencil": device.stencil_samples}
    return [offered[aspect] for aspect in format.aspects]


def _rendered(target: Target, bound: list[Attachment], bindings: Bindings) -> bool:
    """Whether a pass draws or resolves to it, or its usage allows that."""
    usage = target.image.usage if target.image is not None else None
    drawn = (
        any(attachment.drawn or attachment.resolve for attachment in bound)
        or id(target.record) in bindings.resolved
    )
    return drawn or not _RENDER_TARGET_USAGES.isdisjoint(usage or ())


def _put_first(facts: Facts, name: str, stated: list[tuple[str, Span]]) -> None:
    """Puts a list, at the place of the first of it."""
    facts.put(name, [text for text, _ in stated], stated[0][1] if stated else None)


SINGLE_SAMPLED_USAGES = (
    "FRAGMENT_DENSITY_MAP_EXT",
    "FRAGMENT_SHADING_RATE_ATTACHMENT_KHR",
    "VIDEO_ENCODE_QUANTIZATION_DELTA_MAP_KHR",
    "VIDEO_ENCODE_EMPHASIS_MAP_KHR",
)
"""Usages that require one sample: VUID-VkImageCreateInfo-samples-02558, -samples-02083 and
-usage-10253.
"""


def _multisampling_conflicts(
    image: Image, format: Format | None, enabled: Enabled | None
) -> list[tuple[str, Span]]:
    """What Vulkan forbids together with more than one sample.

    VUID-VkImageCreateInfo-samples-02257 (dimensions, mip levels, cube faces, tiling),
    -format-06411, -flags-06883, -imageType-00973 to 00976, -multisampleArrayImage-04460, and those
    of `SINGLE_SAMPLED_USAGES`.
    """
    found = []
    if image.mipLevels is not None and image.mipLevels > 1:
        found.append((f"mipLevels {image.mipLevels}", image.place("mipLevels")))
    if image.imageType not in (None, "2D"):
        found.append((f"imageType {image.imageType}", image.place("imageType")))
    if "CUBE_COMPATIBLE" in image.flags:
        found.append(("CUBE_COMPATIBLE", image.flag_place("flags", ("CUBE_COMPATIBLE",))))
    if image.tiling == "LINEAR":
        found.append(("LINEAR tiling", image.place("tiling")))
    if format is not None and format.ycbcr:
        found.append((f"the YCbCr format {format.name}", image.place("format")))
    single = [usage for usage in SINGLE_SAMPLED_USAGES if usage in (image.usage or ())]
    found += [(usage, image.flag_place("usage", (usage,))) for usage in single]
    if RENDER_TO_SINGLE_SAMPLED in image.flags:
        found.append(
            (RENDER_TO_SINGLE_SAMPLED, image.flag_place("flags", (RENDER_TO_SINGLE_SAMPLED,)))
        )
    features = enabled.features if enabled is not None else None
    extensions = enabled.extensions if enabled is not None else None
    if features is None:
        return found
    sparse = f"sparseResidency{image.samples}Samples"
    if (
        "SPARSE_RESIDENCY" in image.flags
        and image.samples in (2, 4, 8, 16)
        and sparse not in features
    ):
        found.append(
            (
                f"SPARSE_RESIDENCY without the feature {sparse}",
                image.flag_place("flags", ("SPARSE_RESIDENCY",)),
            )
        )
    layered = image.arrayLayers is not None and image.arrayLayers > 1
    if (
        layered
        and "VK_KHR_portability_subset" in (extensions or ())
        and "multisampleArrayImage" not in features
    ):
        text = f"arrayLayers {image.arrayLayers} without the feature multisampleArrayImage"
        found.append((text, image.place("arrayLayers")))
    return found


def _compression_blockers(image: Image, device: DeviceProfile | None) -> list[tuple[str, Span]]:
    stated = []
    if "STORAGE" in (image.usage or ()):
        stated.append(("STORAGE", image.flag_place("usage", ("STORAGE",))))
    if "MUTABLE_FORMAT" in image.flags:
        stated.append(("MUTABLE_FORMAT", image.flag_place("flags", ("MUTABLE_FORMAT",))))
    if image.sharingMode == "CONCURRENT":
        stated.append(("CONCURRENT", image.place("sharingMode")))
    if image.tiling == "LINEAR":
        stated.append(("LINEAR", image.place("tiling")))
    names = COMPRESSION_BLOCKERS.get(device.vendor or "") if device is not None else None
    if (
        names is not None
        and device is not None
        and device.vendor == "arm"
        and is_valhall_or_later(device) is not False
    ):
        names = tuple(name for name in names if name != "MUTABLE_FORMAT")
    return stated if names is None else [(name, at) for name, at in stated if name in names]


def _loaded(bound: list[Attachment], frame: Frame) -> bool | None:
    """Whether some pass loads an aspect of it; unknown where a load operation is not stated.

    Of a program's file also where no pass of it has the image; of a page's pieces where a pass
    loads samples of an image that is not known.
    """
    if not bound and not frame.document.whole and not frame.document.pieces:
        return None
    if not bound and frame.document.pieces:
        attachments = (
            attachment
            for render_pass in frame.passes
            for attachment in render_pass.attachments
            if attachment.used
        )
        strangers = (
            each
            for each in attachments
            if each.target is not None and each.target.image is None and each.samples != 1
        )
        if any(aspect.load == "LOAD" for attachment in strangers for aspect in attachment.aspects):
            return None
    ops = [aspect.load for attachment in bound if attachment.used for aspect in attachment.aspects]
    if "LOAD" in ops:
        return True
    stored = any(
        aspect.store == "STORE"
        for attachment in bound
        if attachment.used
        for aspect in attachment.aspects
    )
    return None if None in ops or (stored and "NONE" in ops) else False


def _read(target: Target, bindings: Bindings, frame: Frame, readers: Readers) -> bool | None:
    """Whether its samples are read from memory: by commands where the description records them,
    else as its usage allows.

    An input attachment is read within its pass: what is read from memory is what the pass loads.
    Commands say nothing of an image that none of them touches.
    """
    image = target.image
    assert image is not None
    if any(attachment.rate for attachment in bindings.used_by(image)):
        return True
    if not readers.timeline.followed:
        return None
    uses = readers.uses(target.name)
    if frame.has_commands and (uses or id(image) in bindings.begun):
        read = any(effect == READS and event.aspect is None for event, effect in uses)
        return None if not read and image.mayBeRead else read
    return usage_reads(
        image, input_attachment=any(attachment.input for attachment in bindings.used_by(image))
    )


def _averaged(reads: list[ReadImage], frame: Frame) -> bool | None:
    """Whether a reader states that it averages the samples; unknown where a reader does not say."""
    stated = [body.resolves for body in reads]
    if "AVERAGE" in stated:
        return True
    return None if not frame.has_commands or None in stated else False
