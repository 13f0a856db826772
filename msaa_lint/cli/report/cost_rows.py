"""What the tables of `msaa-lint cost` hold, before they are laid out: texts as the input has them, figures as text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.frame.cost.amounts import Amount, FrameCost, Line, PassCost, Shading
from msaa_lint.frame.cost.compare import SAME, Change, Comparison, title
from msaa_lint.frame.cost.input_cost import Compared, Costed
from msaa_lint.frame.cost.power import Rates
from msaa_lint.frame.cost.variants import AS_WRITTEN, NONE, Variant

PASS, LINE, TOTAL = "pass", "line", "total"

AT_LEAST = "≥ "
"""Before what cannot be counted whole."""

COLUMNS = ("pass, attachment", "aspect", "action", "samples")
FIGURES = ("read MB/s", "write MB/s", "corrected MB/s", "memory MiB", "mW", "budget")
CHANGES = ("old MB/s", "new MB/s", "read MB/s", "write MB/s", "memory MiB", "mW", "traffic")


class Row(NamedTuple):
    """A row: its kind, the texts on its left, and the figures under `FIGURES` or `CHANGES`; empty ones are not known, or do not apply."""

    kind: str
    texts: tuple[str, ...]
    figures: tuple[str, ...]


def figure(value: float, digits: int = 2, sign: bool = False) -> str:
    """A number with its decimals; nothing is `0.00`, with a sign or not, and what no table holds has an exponent."""
    if abs(value) >= 1e9:
        return f"{value:+.4g}" if sign else f"{value:.4g}"
    text = f"{value:+.{digits}f}" if sign else f"{value:.{digits}f}"
    return text.lstrip("+-") if not text.strip("+-0.") else text


def rows(cost: FrameCost) -> Iterator[Row]:
    """The passes of a frame, each with what moves its attachments, and the total."""
    rates = Rates(cost.fps, cost.milliwatts_per_gbps)
    memory = {image.name: image.committed for image in cost.images}
    for each in cost.passes:
        times = f", {each.times} times" if each.times != 1 else ""
        figures = _figures(each.amount, each.corrected, cost.budget_milliwatts, bool(each.unknown))
        yield Row(PASS, (title(each) + times, "", "", ""), figures)
        shown: set[str] = set()
        for line in each.lines:
            committed = None if line.image in shown else memory.get(line.image)
            shown.add(line.image)
            yield _line(line, rates, committed, cost.budget_milliwatts)
    yield Row(TOTAL, ("total", "", "", ""), _of_frame(cost))


def _line(line: Line, rates: Rates, committed: int | None, budget: float) -> Row:
    read = line.direction == "read"
    amount = rates.amount(line.bytes if read else 0, 0 if read else line.bytes, committed or 0)
    corrected = rates.amount(line.corrected, 0, 0).read_mb_per_s if line.corrected is not None else None
    figures = (
        figure(amount.read_mb_per_s) if read else "",
        "" if read else figure(amount.write_mb_per_s),
        "" if corrected is None else figure(corrected),
        "" if committed is None else figure(amount.memory_mib),
        figure(amount.milliwatts, 1),
        _share(amount, budget),
    )
    return Row(LINE, (line.attachment, line.aspect, line.action, str(line.samples)), figures)


def _of_frame(cost: FrameCost) -> tuple[str, ...]:
    return _figures(cost.total, cost.corrected, cost.budget_milliwatts, any(each.unknown for each in cost.passes), _memory_unknown(cost))


def _memory_unknown(cost: FrameCost) -> bool:
    return any(image.bytes is None for image in cost.images)


def _figures(
    amount: Amount, corrected: Amount | None, budget: float, uncounted: bool = False, more_memory: bool = False
) -> tuple[str, ...]:
    """The figures of a pass or a frame; `uncounted` says that there is traffic, `more_memory` that there is memory, beside them."""
    least, least_memory = (AT_LEAST if more else "" for more in (uncounted, more_memory))
    return (
        least + figure(amount.read_mb_per_s),
        least + figure(amount.write_mb_per_s),
        "" if corrected is None else least + figure(corrected.traffic_mb_per_s),
        least_memory + figure(amount.memory_mib),
        least + figure(amount.milliwatts, 1),
        least + _share(amount, budget),
    )


def _share(amount: Amount, budget: float) -> str:
    return f"{figure(100 * amount.milliwatts / budget, 1)} %"


def options_of(costed: Costed) -> list[Row]:
    """The frame as it is written, with its findings mended, and with other sample counts; none where there is nothing to choose."""
    if not costed.variants and costed.fixed is None:
        return []
    found = [("as written", costed.cost)]
    if costed.fixed is not None:
        found.append(("fixed", costed.fixed))
    found += [(variant_title(each), each.cost) for each in costed.variants if not _told(each, costed.variants)]
    return [Row(LINE, (name,), _of_frame(cost)) for name, cost in found]


def _told(variant: Variant, others: Sequence[Variant]) -> bool:
    """Whether a variant that resolves as written is one of those with the same count that resolve otherwise."""
    return variant.resolve == AS_WRITTEN and any(
        each.samples == variant.samples and each.resolve != AS_WRITTEN and each.cost.total == variant.cost.total for each in others
    )


def variant_title(variant: Variant) -> str:
    """`4x, inline`; with what is known of the device."""
    text = f"{variant.samples}x" if variant.resolve == NONE else f"{variant.samples}x, {_PLACES[variant.resolve]}"
    return f"{text} (not offered)" if variant.offered is False else text


_PLACES = {"as written": "resolved as written", "inline": "resolved inline", "separate": "resolved separately"}


def images(cost: FrameCost) -> list[Row]:
    """Each image and a remark on it, with its size in full and what is committed of it."""
    found = []
    for image in cost.images:
        remark = "lazily allocated" if image.bytes and image.committed == 0 else ""
        if image.committed_by_use:
            remark += ", but a pass loads or stores it: the driver then commits it"
        found.append(Row(LINE, (image.name, remark), (_mib(image.bytes), _mib(image.committed))))
    return found


def _mib(size: int | None) -> str:
    return "unknown" if size is None else figure(size / 2**20)


def details(cost: FrameCost) -> list[tuple[str, str]]:
    """What passes take of the tile, and how often fragment shaders run in them: word and sentence."""
    tiles = [("tile", f"{each.name}: {_tile(each)}") for each in cost.passes if each.tile is not None]
    return tiles + [("shading", f"{each.name}: {_shading(each.shading)}") for each in cost.passes if each.shading is not None]


def _tile(each: PassCost) -> str:
    use = each.tile
    assert use is not None
    spilt = "; it does not fit and spills to memory" if use.spills else ""
    return f"{use.pixels} pixels a tile ({use.full} with one sample), {use.bytes_per_pixel} bytes a pixel{spilt}"


SHOWN_LEG = 4
"""Of small triangles those of this many pixels stand in texts; JSON has them all."""


def _shading(found: Shading) -> str:
    text = f"{figure(found.msaa)} million fragment shader invocations a frame"
    if found.samples == 1:
        return text
    text += f" at {found.samples} samples ({figure(found.sample_shading)} with sample shading, {figure(found.super_sampling)} supersampled"
    if found.demanded is not None and found.demanded != found.msaa:
        text += f", {figure(found.demanded)} demanded"
    factor = dict(found.edges).get(SHOWN_LEG)
    return text + (f"; {figure(factor)} times as many for triangles of {SHOWN_LEG} pixels)" if factor is not None else ")")


def changes(found: Comparison) -> list[Row]:
    """What passes cost more than before, but for those that cost the same; the total; and that as the device compresses, where known."""
    made = [_change(each) for each in (*found.passes, found.total) if each.status != SAME or each is found.total]
    more = found.total.corrected
    if more is not None:
        signed = (*(figure(value, sign=True) for value in more[:3]), figure(more.milliwatts, 1, sign=True))
        made.append(Row(TOTAL, ("total, corrected", ""), ("", "", *signed, "")))
    return made


def _change(each: Change) -> Row:
    more = each.difference
    return Row(
        TOTAL if each.kind == TOTAL else LINE,
        (each.name, each.status),
        (
            "" if each.old is None else figure(each.old.traffic_mb_per_s),
            "" if each.new is None else figure(each.new.traffic_mb_per_s),
            figure(more.read_mb_per_s, sign=True),
            figure(more.write_mb_per_s, sign=True),
            figure(more.memory_mib, sign=True),
            figure(more.milliwatts, 1, sign=True),
            "" if each.per_cent is None else f"{figure(each.per_cent, 1, sign=True)} %",
        ),
    )


def sentence(found: Comparison, budget: float) -> str:
    """`This change: +2247.78 MB/s read, ..., +449.6 mW (+18.0 % of 2500 mW)`."""
    more = found.total.difference
    if found.total.status == SAME:
        return "This change costs nothing"
    share = figure(100 * more.milliwatts / budget, 1, sign=True)
    parts = (
        f"{figure(more.read_mb_per_s, sign=True)} MB/s read",
        f"{figure(more.write_mb_per_s, sign=True)} MB/s written",
        f"{figure(more.memory_mib, sign=True)} MiB",
        f"{figure(more.milliwatts, 1, sign=True)} mW ({share} % of {budget:g} mW)",
    )
    return f"This change: {', '.join(parts)}"


def head(cost: FrameCost) -> str:
    """What a frame is reckoned with. Our own words come first, so that no line begins with text of an input."""
    device = cost.device if cost.device is not None else "no device"
    return f"{cost.fps:g} frames a second on {device}, {cost.milliwatts_per_gbps:g} mW for each GB/s, budget {cost.budget_milliwatts:g} mW"


def remarks(cost: FrameCost) -> list[tuple[str, str]]:
    """What was taken for granted, and what could not be counted: word and text."""
    return [*(("assumed", text) for text in cost.assumed), *(("unknown", text) for text in cost.unknown)]


def remarks_on(found: Compared, number: int) -> list[tuple[str, str]]:
    """What makes a comparison uncertain: word and text. What both sides assume, or do not know, stands once."""
    same = sum(each.status == SAME for each in found.frames[number].passes)
    told = [("note", f"{same} {'pass costs' if same == 1 else 'passes cost'} the same")] if same else []
    told += [("note", text) for text in found.frames[number].remarks]
    sides = [dict.fromkeys(row for each in side if each.number == number for row in remarks(each.cost)) for side in (found.old, found.new)]
    told += [row for row in sides[0] if row in sides[1]]
    for side, name in zip(sides, ("old", "new"), strict=True):
        told += [(f"{word} of the {name}", text) for word, text in side if not all((word, text) in each for each in sides)]
    return told


def budget_of(found: Compared) -> float:
    """The power budget of a comparison, in mW."""
    return next(each.cost.budget_milliwatts for each in (*found.new, *found.old))
