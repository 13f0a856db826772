"""Facts of the dependencies that order a frame's use of an attachment after the last frame's."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import (
    ImageBarrier,
    PipelineBarrier,
    RenderPass,
    SubpassDependency,
)
from msaa_lint.frame.description.record import Record

from .facts import Facts
from .frame import Frame
from .parts import RENDER_PASS, Attachment, Pass
from .pipeline_stages import stated_stages

_ALL_STAGES = frozenset({"ALL_GRAPHICS", "ALL_COMMANDS"})
_LATE_STAGES = frozenset({"LATE_FRAGMENT_TESTS", "BOTTOM_OF_PIPE"}) | _ALL_STAGES
_COLOR_STAGES = frozenset({"COLOR_ATTACHMENT_OUTPUT"}) | _ALL_STAGES
_ATTACHMENT_STAGES = frozenset(
    {
        "COLOR_ATTACHMENT_OUTPUT",
        "EARLY_FRAGMENT_TESTS",
        "LATE_FRAGMENT_TESTS",
        "ALL_GRAPHICS",
        "ALL_COMMANDS",
    }
)

COLOR_WRITE = "COLOR_ATTACHMENT_WRITE"
DEPTH_STENCIL_WRITE = "DEPTH_STENCIL_ATTACHMENT_WRITE"


class Masks(NamedTuple):
    """The first scope of a barrier: the stages that it waits for, and the accesses that it makes
    available.
    """

    srcStageMask: tuple[str, ...] | None
    srcAccessMask: tuple[str, ...] | None


Wait = Masks | SubpassDependency


class Waits:
    """The first scopes of several waits together, and the writes that one of them makes
    available.
    """

    __slots__ = ("_available", "_known", "_names")

    def __init__(self) -> None:
        self._names: tuple[dict[str, None], dict[str, None]] = ({}, {})
        self._known = [True, True]
        self._available: set[str] = set()

    def add(self, wait: Wait) -> None:
        """Adds a wait."""
        for number, mask in enumerate((wait.srcStageMask, wait.srcAccessMask)):
            if mask is None:
                self._known[number] = False
            self._names[number].update(dict.fromkeys(mask or ()))
        self._available.update(
            access
            for access in (COLOR_WRITE, DEPTH_STENCIL_WRITE)
            if _makes_available(access, wait)
        )

    def union(self, others: Sequence[Waits]) -> Waits:
        """These waits and others."""
        joined = Waits()
        for waits in (self, *others):
            for number in (0, 1):
                joined._names[number].update(waits._names[number])
                joined._known[number] = joined._known[number] and waits._known[number]
            joined._available |= waits._available
        return joined

    @property
    def stages(self) -> list[str] | None:
        """The stages of all; None where those of one could not be read."""
        return list(self._names[0]) if self._known[0] else None

    @property
    def accesses(self) -> list[str] | None:
        """The accesses of all; None where those of one could not be read."""
        return list(self._names[1]) if self._known[1] else None

    def makes_available(self, access: str) -> bool:
        """Whether one of them makes an attachment's writes available."""
        return access in self._available


Barriers = Mapping[str | None, Waits]
"""By image (None: all memory, where attachment stages wait): the recorded barriers."""


def recorded_barriers(frame: Frame) -> Barriers:
    """The recorded barriers that attachments may wait for."""
    found: dict[str | None, Waits] = {}
    for _, body in frame.recorded(PipelineBarrier):
        images = {
            image.image if isinstance(image, ImageBarrier) else image for image in body.images
        }
        for name in images or (
            {None} if not _ATTACHMENT_STAGES.isdisjoint(body.dstStageMask or ()) else set()
        ):
            found.setdefault(name, Waits()).add(
                Masks(body.srcStageMask or (), body.srcAccessMask or ())
            )
    return found


def external_dependencies(
    render_pass: Pass, barriers: Barriers, alternating: Collection[str], detached: bool = False
) -> Iterator[tuple[Record, Facts]]:
    """For every subpass with stated dependencies from EXTERNAL: the one to report, and the facts of
    all of them.

    A subpass without any that is the first to use a multisampled attachment is yielded with its own
    record: what orders it is unknown. It is unknown, too, for passes that are `detached` from a
    frame, which is where `commands` is stated and empty. Images in `alternating` take turns with
    those of the swapchain, so that acquiring the swapchain's image orders their reuse.
    """
    if render_pass.kind != RENDER_PASS or not isinstance(render_pass.record, RenderPass):
        return
    into: dict[int, list[SubpassDependency]] = {}
    for dependency in render_pass.record.dependencies:
        if dependency.srcSubpass == "EXTERNAL" and isinstance(dependency.dstSubpass, int):
            into.setdefault(dependency.dstSubpass, []).append(dependency)
    first_used: dict[int, list[Attachment]] = {}
    for attachment in render_pass.attachments:
        if attachment.targets and all(target.name in alternating for target in attachment.targets):
            continue
        if (
            attachment.drawn
            and _first_use(attachment) in attachment.color | attachment.depth_stencil
        ):
            first_used.setdefault(_first_use(attachment), []).append(attachment)
    for subpass, dependencies in into.items():
        attachments = first_used.get(subpass, [])
        if detached:
            yield dependencies[0], _use_facts(subpass, attachments)
        else:
            yield _dependency_facts(
                subpass, attachments, dependencies, barriers if render_pass.begun else {}
            )
    for subpass, attachments in first_used.items():
        if subpass not in into and _any_multisampled(attachments):
            yield render_pass.subpasses[subpass].record, _use_facts(subpass, attachments)


def _use_facts(subpass: int, attachments: list[Attachment]) -> Facts:
    facts = Facts()
    facts.put("dependency.subpass", subpass)
    multisampled = _any_multisampled(attachments)
    facts.put("dependency.multisampled", multisampled)
    if multisampled is False:
        facts.put("dependency.makes_writes_available", True)
    facts.put(
        "dependency.multisampled_depth_stencil",
        _any_multisampled([a for a in attachments if subpass in a.depth_stencil]),
    )
    return facts


def _dependency_facts(
    subpass: int,
    attachments: list[Attachment],
    dependencies: list[SubpassDependency],
    barriers: Barriers,
) -> tuple[SubpassDependency, Facts]:
    """The dependency to report, and the facts of all that lead into a subpass."""
    facts = _use_facts(subpass, attachments)
    multisampled = [attachment for attachment in attachments if attachment.samples != 1]
    names = dict.fromkeys(
        target.name for a in multisampled for target in a.targets if target.image is not None
    )
    stated = Waits()
    for dependency in dependencies:
        stated.add(dependency)
    waits = stated.union([barriers[name] for name in (*names, None) if name in barriers])
    stages, accesses = waits.stages, waits.accesses
    reported = dependencies[0]
    late = stages is not None and not _LATE_STAGES.isdisjoint(stages)
    unavailable: dict[str, bool] = {}
    if stages is not None and accesses is not None:
        for attachment in multisampled:
            access = COLOR_WRITE if subpass in attachment.color else DEPTH_STENCIL_WRITE
            own = {
                None,
                *(target.name for target in attachment.targets if target.image is not None),
            }
            if not any(
                each.makes_available(access)
                for each in (stated, *(barriers[name] for name in own if name in barriers))
            ):
                unavailable[access] = (
                    unavailable.get(access, False) or attachment.samples is not None
                )
        if list(unavailable) == [COLOR_WRITE]:
            reported = next(
                (
                    each
                    for each in dependencies
                    if not _COLOR_STAGES.isdisjoint(each.srcStageMask or ())
                ),
                reported,
            )
    stages_at, accesses_at = reported.place("srcStageMask"), reported.place("srcAccessMask")
    missing_at: Span | None = None
    facts.places["dependency.subpass"] = reported.place("dstSubpass")
    if stages is not None:
        facts.put("dependency.stages", stages, stages_at)
        facts.put("dependency.waits_for_late_tests", late, stages_at)
        if not late and facts.values.get("dependency.multisampled_depth_stencil"):
            missing_at = stages_at
            facts.put("dependency.missing", "LATE_FRAGMENT_TESTS in srcStageMask", missing_at)
    if accesses is not None:
        facts.put("dependency.accesses", accesses, accesses_at)
    if stages is not None and accesses is not None:
        # Of an attachment whose sample count is unknown, it is unknown whether its writes must be
        # available.
        available = False if True in unavailable.values() else None if unavailable else True
        facts.put("dependency.makes_writes_available", available, accesses_at)
        facts.put("dependency.unavailable_writes", list(unavailable), accesses_at)
        if available is False:
            facts.put(
                "dependency.missing", f"{' and '.join(unavailable)} in srcAccessMask", accesses_at
            )
    return reported, facts


def _makes_available(access: str, wait: Wait) -> bool:
    """Whether a wait makes an attachment's writes available.

    A specific access implies its stage (VUID-VkSubpassDependency-srcAccessMask-00868); MEMORY_WRITE
    goes with every stage, and BOTTOM_OF_PIPE accesses nothing. The stages that write depth and
    stencil are judged by `dependency.waits_for_late_tests`.
    """
    accesses = wait.srcAccessMask or ()
    if wait.srcStageMask and not stated_stages(wait.srcStageMask):
        return False
    if access in accesses:
        return True
    return "MEMORY_WRITE" in accesses and (
        access != COLOR_WRITE or not _COLOR_STAGES.isdisjoint(wait.srcStageMask or ())
    )


def _first_use(attachment: Attachment) -> int:
    return min(
        attachment.color | attachment.depth_stencil | attachment.input | set(attachment.resolve)
    )


def _any_multisampled(attachments: list[Attachment]) -> bool | None:
    counts = [attachment.samples for attachment in attachments]
    if any(count is not None and count > 1 for count in counts):
        return True
    return None if None in counts else False
