"""What becomes of the barriers around a vkCmdResolveImage when the render pass that draws the
samples resolves them instead.

The barriers between the pass and the command only prepare the copy; what they wait for, the pass
then waits for. The barrier behind the command waits for the pass instead.
"""

from __future__ import annotations

from msaa_lint.frame.description.models import ImageBarrier, PipelineBarrier, RenderPass
from msaa_lint.frame.facts.parts import Pass

from .changes import Change, NoFix
from .context import FixContext

_TRANSFER_STAGES = ("TRANSFER", "ALL_TRANSFER", "RESOLVE", "COPY", "BLIT", "CLEAR")
_TRANSFER_ACCESSES = ("TRANSFER_READ", "TRANSFER_WRITE")
_LAYOUT = "COLOR_ATTACHMENT_OPTIMAL"


def moved_barriers(
    source: str, target: str, begin: int, position: int, render_pass: Pass, context: FixContext
) -> tuple[list[Change], bool]:
    """The changes of the barriers that name the images of a resolve, and whether one of them takes
    over the resolved image in the layout COLOR_ATTACHMENT_OPTIMAL. `begin` and `position` are the
    places of the pass and of the resolve among the commands.

    Raises NoFix if a barrier concerns other images as well, or prepares the resolved image before
    the pass.
    """
    changes: list[Change] = []
    takes_over = False
    next_use = context.uses.next_use_of_commands(target, position)
    for index in sorted(
        {*context.uses.barriers.get(source, ()), *context.uses.barriers.get(target, ())}
    ):
        body = context.frame.commands[index].body
        assert isinstance(body, PipelineBarrier)
        names = {_name(entry) for entry in body.images}
        if index < begin:
            if target in names:
                raise NoFix("a barrier prepares the image that is resolved to before the pass")
        elif index < position:
            if not names <= {source, target}:
                raise NoFix(
                    "a barrier between the pass and the resolve concerns other images as well"
                )
            changes.append(context.drop_command(index))
            if target in names:
                changes += _dependency(body, render_pass)
        elif target in names and (next_use is None or index < next_use):
            if names != {target}:
                raise NoFix("a barrier behind the resolve concerns other images as well")
            changes += _after_pass(body)
            takes_over |= any(
                isinstance(entry, ImageBarrier) and entry.oldLayout is not None
                for entry in body.images
            )
    return changes, takes_over


def _name(entry: ImageBarrier | str) -> str | None:
    return entry.image if isinstance(entry, ImageBarrier) else entry


def _dependency(barrier: PipelineBarrier, render_pass: Pass) -> list[Change]:
    """What a barrier waits for before the image is written again, as a dependency of the pass that
    writes it then.

    A dependency that is stated replaces the implicit one, so it also orders the writes of one frame
    and the next.
    """
    record = render_pass.record
    if not isinstance(record, RenderPass):
        raise NoFix(
            "a barrier prepares the image that is resolved to, and vkCmdBeginRendering has no "
            "dependencies"
        )
    has_depth = any(subpass.depth_stencil for subpass in render_pass.subpasses)
    stages, accesses = ["COLOR_ATTACHMENT_OUTPUT"], ["COLOR_ATTACHMENT_WRITE"]
    if has_depth:
        stages, accesses = (
            [*stages, "EARLY_FRAGMENT_TESTS", "LATE_FRAGMENT_TESTS"],
            [*accesses, "DEPTH_STENCIL_ATTACHMENT_WRITE"],
        )
    masks = {
        "srcStageMask": [*dict.fromkeys([*barrier.srcStageMask, *stages])],
        "dstStageMask": stages,
        "srcAccessMask": [*dict.fromkeys([*barrier.srcAccessMask, *accesses])],
        "dstAccessMask": accesses,
    }
    for dependency in record.dependencies:
        if dependency.srcSubpass == "EXTERNAL" and dependency.dstSubpass == 0:
            return [
                Change(dependency, member, "add", flag)
                for member, flags in masks.items()
                for flag in flags
            ]
    return [
        Change(
            record, "dependencies", "append", {"srcSubpass": "EXTERNAL", "dstSubpass": 0, **masks}
        )
    ]


def _after_pass(barrier: PipelineBarrier) -> list[Change]:
    """A barrier that waits for the resolve of a pass instead of that of a command."""
    changes: list[Change] = []
    for member, removed, added in (
        ("srcStageMask", _TRANSFER_STAGES, "COLOR_ATTACHMENT_OUTPUT"),
        ("srcAccessMask", _TRANSFER_ACCESSES, "COLOR_ATTACHMENT_WRITE"),
    ):
        if barrier.states(member):
            changes += (
                Change(barrier, member, "remove", flag)
                for flag in getattr(barrier, member)
                if flag in removed
            )
            changes.append(Change(barrier, member, "add", added))
    for entry in barrier.images:
        if isinstance(entry, ImageBarrier) and entry.oldLayout is not None:
            changes.append(Change(entry, "oldLayout", "set", _LAYOUT))
    return changes
