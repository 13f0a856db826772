"""What a frame would cost with other sample counts, and with its resolves inside its passes or
apart from them.

Each variant is the same description edited into another frame and passed to the cost model; nothing
here counts bytes.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.frame.description.document import Document
from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.image import counts_by_aspect

from .amounts import FrameCost, Terms
from .model import frame_cost
from .resolves import inline, separate
from .samples import COUNTS, is_multisampled, remove_multisampling, set_samples

AS_WRITTEN = "as written"
INLINE = "inline"
SEPARATE = "separate"
NONE = "none"
DEFAULT_COUNTS = (1, 2, 4, 8)


class Variant(NamedTuple):
    """A frame with `samples` a pixel wherever it has more than one.

    `resolve` is `as written`; `inline`, every resolve in its pass and no sample stored that nothing
    reads; `separate`, all samples stored and vkCmdResolveImage reading them back; or, with one
    sample, `none`: what was resolved into is drawn to. `offered` says whether the device offers the
    count for every format of the frame, None where that is not known.
    """

    samples: int
    resolve: str
    cost: FrameCost
    offered: bool | None


def variants(
    document: Document,
    device: DeviceProfile | None,
    terms: Terms,
    counts: Sequence[int] = DEFAULT_COUNTS,
) -> list[Variant]:
    """The variants of a frame, by rising count; none of a frame without multisampling, inline and
    separate only where it resolves.

    ValueError for what is no sample count.
    """
    wrong = [count for count in counts if count not in COUNTS]
    if wrong:
        raise ValueError(f"no sample count {wrong[0]}; there are {', '.join(map(str, COUNTS))}")
    written = Frame(document)
    if not is_multisampled(written):
        return []
    return list(_variants(document, device, terms, sorted(set(counts)), written))


def _variants(
    document: Document,
    device: DeviceProfile | None,
    terms: Terms,
    counts: Sequence[int],
    written: Frame,
) -> Iterator[Variant]:
    resolves = any(each.kind == "resolveImage" for each in written.commands) or any(
        render_pass.resolves for render_pass in written.passes
    )
    for count in counts:
        offered = _offered(written, device, count)
        if count == 1:
            frame = Frame(document)
            remove_multisampling(frame)
            yield Variant(1, NONE, frame_cost(frame, device, terms), offered)
            continue
        for resolve, place in ((AS_WRITTEN, None), (INLINE, inline), (SEPARATE, separate)):
            if place is not None and not resolves:
                continue
            frame = Frame(document)
            if place is not None:
                place(frame)
            set_samples(frame, count)
            yield Variant(count, resolve, frame_cost(frame, device, terms), offered)


def _offered(frame: Frame, device: DeviceProfile | None, count: int) -> bool | None:
    """Whether a device offers a count for all that has several samples; of a class of devices, what
    it does not promise is unknown.
    """
    if device is None or count == 1:
        return True if count == 1 else None
    known = True
    for target in frame.all_targets:
        if target.samples in (None, 1):
            continue
        for counts in (
            counts_by_aspect(target.format, device) if target.format is not None else [None]
        ):
            if counts is None:
                known = False
            elif count not in counts:
                return None if device.minimum else False
    return True if known else None
