"""Frames with every resolve inside its pass, or with every resolve as a command after it."""

from __future__ import annotations

from msaa_lint.frame.description.models import AttachmentDescription, Command, Image, ResolveImage
from msaa_lint.frame.facts.commands import END_COMMANDS
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.image import BESIDE_TRANSIENT
from msaa_lint.frame.facts.parts import RENDERING, Aspect, Attachment, Pass, Resolve, Target
from msaa_lint.frame.facts.readers import Readers
from msaa_lint.frame.facts.timeline import Timeline

from .frame_edits import (
    CommandOrder,
    attachments_by_target,
    blank_record,
    command_order,
    copy_record,
    effective_resolves,
    images_of_commands,
    make_command,
    own_image,
    set_commands,
)

TRANSIENT = "TRANSIENT_ATTACHMENT"

ResolveEnd = Attachment | Target | None


def inline(frame: Frame) -> None:
    """Resolves in the pass that draws, whenever it runs; samples that nothing reads afterwards are
    not stored.

    An image whose samples then stay on the tile becomes transient, and lazily allocated if the
    device is known to offer that. A command stays if no pass before it draws its source, or if the
    pass already resolves that into another image.
    """
    if frame.has_commands:
        _move_commands(frame)
    readers = Readers(Timeline(frame))
    sources: dict[int, Target] = {}
    for render_pass in frame.passes:
        for resolve in effective_resolves(render_pass):
            source = resolve.source
            assert source is not None
            source.aspects = [
                _without_unread_store(readers, render_pass, source, aspect)
                for aspect in source.aspects
            ]
            sources.update((id(target), target) for target in source.targets)
    named, attachments = images_of_commands(frame), attachments_by_target(frame)
    for key, target in sources.items():
        if target.name not in named and not any(map(_uses_memory, attachments.get(key, ()))):
            _make_transient(target)


def _move_commands(frame: Frame) -> None:
    """Replaces resolve commands by resolves of the passes that draw their sources."""
    drawn: dict[str, tuple[Pass, Attachment]] = {}
    resolved_to: dict[int, list[ResolveEnd]] = {}
    for render_pass in frame.passes:
        for resolve in effective_resolves(render_pass):
            resolved_to.setdefault(id(resolve.source), []).append(resolve.written_part)
    order: CommandOrder = []
    for command, begun in command_order(frame):
        if begun is not None and not begun.suspends:
            for attachment in begun.attachments:
                drawn.update(
                    (target.name, (begun, attachment))
                    for target in attachment.targets
                    if attachment.drawn
                )
        if command.kind != "resolveImage" or not _move_into_pass(
            frame, command, drawn, resolved_to
        ):
            order.append((command, begun))
    set_commands(frame, order)


def _without_unread_store(
    readers: Readers, render_pass: Pass, source: Attachment, aspect: Aspect
) -> Aspect:
    unread = aspect.store == "STORE" and readers.read_later(render_pass, source, aspect) is not True
    return aspect._replace(store="DONT_CARE") if unread else aspect


def _uses_memory(attachment: Attachment) -> bool:
    """Whether an attachment is loaded or stored, or may be."""
    return any(
        aspect.load in ("LOAD", None) or aspect.store in ("STORE", None)
        for aspect in attachment.aspects
    )


def _make_transient(target: Target) -> None:
    image = own_image(target)
    if image is None:
        return
    image.usage = (
        *(usage for usage in image.usage or () if usage in BESIDE_TRANSIENT and usage != TRANSIENT),
        TRANSIENT,
    )
    if "LAZILY_ALLOCATED" not in (image.memory or ()):
        # Not stated: the model then asks the device.
        image.memory = None


def _move_into_pass(
    frame: Frame,
    command: Command,
    drawn: dict[str, tuple[Pass, Attachment]],
    resolved_to: dict[int, list[ResolveEnd]],
) -> bool:
    """Makes a resolve command a resolve of the pass that draws its source. Returns whether that is
    possible.
    """
    body = command.body
    assert isinstance(body, ResolveImage)
    source, target = frame.target(body.srcImage), frame.target(body.dstImage)
    if source is None or target is None or source.samples == 1 or source.name not in drawn:
        return False
    render_pass, attachment = drawn[source.name]
    ends = resolved_to.setdefault(id(attachment), [])
    if ends:
        return all(_is_image(end, target) for end in ends)
    ends.append(target)
    if render_pass.kind == RENDERING:
        for aspect_source in (
            render_pass.subpasses[0].depth_stencil if attachment.depth_stencil else [attachment]
        ):
            _add_to_rendering(render_pass, aspect_source, target, command)
    else:
        _add_to_render_pass(render_pass, attachment, target, command)
    return True


def _is_image(end: ResolveEnd, target: Target) -> bool:
    return end is target or (
        isinstance(end, Attachment) and any(image is target for image in end.targets)
    )


def _add_to_rendering(
    render_pass: Pass, source: Attachment, target: Target, command: Command
) -> None:
    resolve = _make_resolve(render_pass, source, source.aspects[0].name or "color", 0, command)
    resolve.target_image = target
    render_pass.subpasses[0].resolves.append(resolve)


def _add_to_render_pass(
    render_pass: Pass, source: Attachment, target: Target, command: Command
) -> None:
    index = max(source.color | source.depth_stencil)
    record = blank_record(AttachmentDescription, command, target.name)
    attachment = Attachment(record, target.name, len(render_pass.attachments), [target])
    attachment.format, attachment.samples = target.format or source.format, target.samples
    names = attachment.format.aspects if attachment.format is not None else ("color",)
    attachment.aspects = [Aspect(name, "DONT_CARE", "STORE", "loadOp", "storeOp") for name in names]
    attachment.resolve = {index: set(names)}
    render_pass.attachments.append(attachment)
    for name in names:
        resolve = _make_resolve(render_pass, source, name, index, command)
        resolve.target, resolve.target_image = attachment, target
        render_pass.subpasses[index].resolves.append(resolve)


def _make_resolve(
    render_pass: Pass, source: Attachment, aspect: str, index: int, command: Command
) -> Resolve:
    resolve = Resolve(render_pass.kind, aspect, command, command.path)
    resolve.render_pass, resolve.subpass, resolve.source, resolve.source_image = (
        render_pass,
        index,
        source,
        source.target,
    )
    resolve.mode = "AVERAGE" if aspect == "color" else "SAMPLE_ZERO"
    return resolve


def separate(frame: Frame) -> None:
    """Stores all samples that passes resolve, and resolves them by vkCmdResolveImage afterwards;
    stored images are no longer transient.

    The command moves every aspect of an image, so every one is stored. A pass that goes on with the
    resolved image loads it.
    """
    commands: dict[int, dict[tuple[str, str], Command]] = {}
    for render_pass in frame.passes:
        resolves = effective_resolves(render_pass)
        for resolve in resolves:
            source, end = resolve.source, resolve.written_part
            assert source is not None and end is not None
            if isinstance(end, Attachment):
                _detach(end, resolve)
            target = _image_to_resolve(frame, end) if isinstance(end, Attachment) else end
            together = render_pass.kind == RENDERING and source.depth_stencil
            for attachment in render_pass.subpasses[0].depth_stencil if together else [source]:
                _store(attachment)
            body = blank_record(ResolveImage, resolve.record, "resolveImage")
            body.srcImage, body.dstImage = _image_to_resolve(frame, source).name, target.name
            command = make_command("resolveImage", body, resolve.record)
            commands.setdefault(id(render_pass), {}).setdefault(
                (body.srcImage, body.dstImage), command
            )
        removed = {id(resolve) for resolve in resolves}
        for subpass in render_pass.subpasses if removed else ():
            subpass.resolves = [
                resolve for resolve in subpass.resolves if id(resolve) not in removed
            ]
    if commands:
        set_commands(frame, _with_resolves(command_order(frame), commands))


def _with_resolves(
    order: CommandOrder, commands: dict[int, dict[tuple[str, str], Command]]
) -> CommandOrder:
    """The commands with the resolves of each pass after its end, by the identity of the pass."""
    extended: CommandOrder = []
    waiting: list[Command] = []
    for command, begun in order:
        if begun is not None:
            extended += [(resolve, None) for resolve in waiting]
            waiting = [copy_record(resolve) for resolve in commands.get(id(begun), {}).values()]
        extended.append((command, begun))
        if command.kind in END_COMMANDS:
            extended += [(resolve, None) for resolve in waiting]
            waiting = []
    return extended + [(resolve, None) for resolve in waiting]


def _detach(target: Attachment, resolve: Resolve) -> None:
    """Takes a resolve's target out of the subpass. A later subpass that uses it must load it."""
    aspects = target.resolve.get(resolve.subpass, set())
    aspects.discard(resolve.aspect)
    if not aspects:
        target.resolve.pop(resolve.subpass, None)
    if target.used:
        target.aspects = [aspect._replace(load="LOAD") for aspect in target.aspects]


def _store(source: Attachment) -> None:
    source.aspects = [aspect._replace(store="STORE") for aspect in source.aspects]
    for target in source.targets:
        if target.image is None or TRANSIENT not in (target.image.usage or ()):
            continue
        image = own_image(target)
        assert image is not None
        image.usage = (
            *(usage for usage in image.usage or () if usage != TRANSIENT),
            "TRANSFER_SRC",
        )
        if image.memory is not None:
            image.memory = tuple(flag for flag in image.memory if flag != "LAZILY_ALLOCATED")


def _image_to_resolve(frame: Frame, attachment: Attachment) -> Target:
    """The image of an attachment. One that the description does not declare gets a name, and takes
    no memory, as in every other frame.
    """
    target = attachment.targets[0]
    if target.image is not None:
        return target
    image = blank_record(Image, target.record, f"{target.record.path} (not described)")
    image.usage, image.memory = (TRANSIENT,), ("LAZILY_ALLOCATED",)
    declared = Target(image, image, None, attachment.samples)
    declared.format = attachment.format
    attachment.targets = [declared]
    frame.targets[declared.name] = declared
    return declared
