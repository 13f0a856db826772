"""The rows of the tables of `msaa-lint cost`, before layout: texts as the input has them, figures
as text.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from msaa_lint.frame.cost.amounts import Amount, FrameCost, Line, PassCost, Shading
from msaa_lint.frame.cost.compare import SAME, Change, Comparison, title
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame
from msaa_lint.frame.cost.power import Rates
from msaa_lint.frame.cost.variants import AS_WRITTEN, NONE, Variant

from . import Options
from .paths import display_path

PASS, LINE, TOTAL = "pass", "line", "total"

AT_LEAST = "≥ "
"""Before a figure that is incomplete."""

COLUMNS = ("pass, attachment", "aspect", "action", "samples")
FIGURES = ("read MB/s", "write MB/s", "corrected MB/s", "memory MiB", "mW", "budget")
CHANGES = ("old MB/s", "new MB/s", "read MB/s", "write MB/s", "memory MiB", "mW", "traffic")


MAX_ROWS = 1000
"""Rows of a table that a person reads: laying one out in a terminal takes a millisecond."""


class Row(NamedTuple):
    """A row: its kind, the texts on its left, and the figures below `FIGURES` or `CHANGES`, empty
    if unknown or not applicable.
    """

    kind: str
    texts: tuple[str, ...]
    figures: tuple[str, ...]


class Table(NamedTuple):
    """A table: the headings of its texts and of its figures, and its rows."""

    texts: tuple[str, ...]
    figures: tuple[str, ...]
    rows: list[Row]


def frame_name(frame: CostedFrame, options: Options) -> str:
    """A frame's input, and its document if there are several."""
    return display_path(frame.file, options.root) + (
        f", document {frame.number + 1}" if frame.documents > 1 else ""
    )


def frame_tables(frame: CostedFrame) -> list[Table]:
    """The tables of a frame: what its passes cost, what it would cost otherwise, and the memory of
    its images.
    """
    return [
        Table(COLUMNS, FIGURES, list(rows(frame.cost))),
        Table(("the frame",), FIGURES, alternatives(frame)),
        Table(("image", ""), ("in full MiB", "committed MiB"), images(frame.cost)),
    ]


def limited(table: Table) -> Table:
    """A table with its first rows, its totals, and between them the number of rows that are left
    out.
    """
    rows = table.rows
    if len(rows) <= MAX_ROWS:
        return table
    totals = [row for row in rows[MAX_ROWS:] if row.kind == TOTAL]
    text = f"and {len(rows) - MAX_ROWS - len(totals)} more rows (--output json has all)"
    rest = Row(PASS, (text, *("" for _ in rows[0].texts[1:])), tuple("" for _ in rows[0].figures))
    return table._replace(rows=[*rows[:MAX_ROWS], rest, *totals])


def totals(frames: Sequence[CostedFrame], names: Sequence[str]) -> Table:
    """The total of each frame, by name."""
    return Table(
        ("frame",),
        FIGURES,
        [
            Row(LINE, (name,), _of_frame(frame.cost))
            for name, frame in zip(names, frames, strict=True)
        ],
    )


def figure(value: float, digits: int = 2, sign: bool = False) -> str:
    """A number with its decimals, none from a million; zero is `0.00` without a sign, and larger
    numbers have an exponent.
    """
    if abs(value) >= 1e9:
        return f"{value:+.4g}" if sign else f"{value:.4g}"
    digits = digits if abs(value) < 1e6 else 0
    text = f"{value:+.{digits}f}" if sign else f"{value:.{digits}f}"
    return text.lstrip("+-") if not text.strip("+-0.") else text


def rows(cost: FrameCost) -> Iterator[Row]:
    """The passes of a frame, each with the traffic of its attachments, and the total."""
    rates = Rates(cost.fps, cost.milliwatts_per_gbps)
    memory = {image.name: image.committed for image in cost.images}
    for pass_cost in cost.passes:
        times = f", {pass_cost.times} times" if pass_cost.times != 1 else ""
        corrected = (pass_cost.corrected, pass_cost.corrected_most)
        figures = _figures(
            pass_cost.amount, corrected, cost.budget_milliwatts, bool(pass_cost.unknown)
        )
        yield Row(PASS, (title(pass_cost) + times, "", "", ""), figures)
        images: set[str] = set()
        for line in pass_cost.lines:
            committed = None if line.image in images else memory.get(line.image)
            images.add(line.image)
            yield _line(line, rates, committed, cost.budget_milliwatts)
    yield Row(TOTAL, ("total", "", "", ""), _of_frame(cost))


def _line(line: Line, rates: Rates, committed: int | None, budget: float | None) -> Row:
    read = line.direction == "read"
    amount = rates.amount(line.bytes if read else 0, 0 if read else line.bytes, committed or 0)
    corrected = [
        rates.amount(each, 0, 0).read_mb_per_s
        for each in (line.corrected, line.corrected_most)
        if each is not None
    ]
    figures = (
        figure(amount.read_mb_per_s) if read else "",
        "" if read else figure(amount.write_mb_per_s),
        _range(corrected),
        "" if committed is None else figure(amount.memory_mib),
        figure(amount.milliwatts, 1),
        _share(amount, budget),
    )
    return Row(LINE, (line.attachment, line.aspect, line.action, str(line.samples)), figures)


def _of_frame(cost: FrameCost) -> tuple[str, ...]:
    unknown_traffic = any(pass_cost.unknown for pass_cost in cost.passes)
    unknown_memory = any(image.bytes is None for image in cost.images)
    corrected = (cost.corrected, cost.corrected_most)
    return _figures(cost.total, corrected, cost.budget_milliwatts, unknown_traffic, unknown_memory)


def _figures(
    amount: Amount,
    corrected: Sequence[Amount | None],
    budget: float | None,
    unknown_traffic: bool = False,
    unknown_memory: bool = False,
) -> tuple[str, ...]:
    """The figures of a pass or a frame, marked as lower bounds if some traffic or memory is
    unknown.
    """
    compressed = _range([each.traffic_mb_per_s for each in corrected if each is not None])
    least, least_memory = (
        AT_LEAST if unknown else "" for unknown in (unknown_traffic, unknown_memory)
    )
    return (
        least + figure(amount.read_mb_per_s),
        least + figure(amount.write_mb_per_s),
        least + compressed if compressed else "",
        least_memory + figure(amount.memory_mib),
        least + figure(amount.milliwatts, 1),
        least + _share(amount, budget) if budget is not None else "",
    )


def _range(values: Sequence[float]) -> str:
    """`265.59–603.61`; one figure if the least and the most are equal, none without them."""
    return "–".join(dict.fromkeys(map(figure, values)))


def _share(amount: Amount, budget: float | None) -> str:
    return "" if budget is None else f"{figure(100 * amount.milliwatts / budget, 1)} %"


def alternatives(frame: CostedFrame) -> list[Row]:
    """The frame as written, after fixes, and with other sample counts after the same fixes; empty
    if there is no alternative.
    """
    if not frame.counts and frame.fixed is None:
        return []
    after = "" if frame.fixed is None else ", same fixes"
    rows = [(title, cost) for title, cost in frame.states]
    rows += [
        (variant_title(variant) + after, variant.cost)
        for variant in frame.counts
        if not _is_repeated(variant, frame.counts)
    ]
    return [Row(LINE, (name,), _of_frame(cost)) for name, cost in rows]


def _is_repeated(variant: Variant, variants: Sequence[Variant]) -> bool:
    """Whether a variant that resolves as written equals another one with the same count."""
    return variant.resolve == AS_WRITTEN and any(
        other.samples == variant.samples
        and other.resolve != AS_WRITTEN
        and other.cost.total == variant.cost.total
        for other in variants
    )


_RESOLVES = {
    "as written": ", resolved as written",
    "inline": ", resolved inline",
    "separate": ", resolved separately",
    NONE: "",
}


def variant_title(variant: Variant) -> str:
    """`4x, resolved inline`, and whether the device does not support it."""
    return f"{variant.samples}x{_RESOLVES[variant.resolve]}" + (
        " (not supported)" if variant.offered is False else ""
    )


def images(cost: FrameCost) -> list[Row]:
    """Each image, with its full size and its committed memory."""
    table = []
    for image in cost.images:
        remark = "lazily allocated" if image.bytes and image.committed == 0 else ""
        if image.committed_by_use:
            remark += "; committed, as a pass loads or stores it"
        table.append(Row(LINE, (image.name, remark), (_mib(image.bytes), _mib(image.committed))))
    return table


def _mib(size: int | None) -> str:
    return "unknown" if size is None else figure(size / 2**20)


def details(cost: FrameCost) -> list[tuple[str, str]]:
    """How passes use the tile, and how often their fragment shaders run: word and sentence."""
    tiles = [("tile", f"{row.name}: {_tile(row)}") for row in cost.passes if row.tile is not None]
    return tiles + [
        ("shading", f"{row.name}: {_shading(row.shading)}")
        for row in cost.passes
        if row.shading is not None
    ]


def _tile(cost: PassCost) -> str:
    use = cost.tile
    assert use is not None
    spills = "; the tile is too small, and attachments spill to memory" if use.spills else ""
    return (
        f"{use.pixels} pixels per tile ({use.full} with one sample), {use.bytes_per_pixel} "
        f"bytes per pixel{spills}"
    )


SHOWN_LEG = 4
"""The size in pixels of the small triangles that text reports mention; JSON has all sizes."""


def _shading(shading: Shading) -> str:
    text = f"{figure(shading.msaa)} million fragment shader invocations per frame"
    if shading.samples == 1:
        return text
    text += f" at {shading.samples} samples ({figure(shading.sample_shading)} with sample shading"
    text += f", {figure(shading.super_sampling)} with supersampling"
    if shading.demanded is not None and shading.demanded != shading.msaa:
        text += f", {figure(shading.demanded)} as requested"
    factor = dict(shading.edges).get(SHOWN_LEG)
    return text + (
        f"; {figure(factor)} times as many for triangles of {SHOWN_LEG} pixels)"
        if factor is not None
        else ")"
    )


def changes(comparison: Comparison) -> Table:
    """The changes of passes, except those that cost the same; of the total; and of the corrected
    total, if known.
    """
    table = [
        _change(change)
        for change in (*comparison.passes, comparison.total)
        if change.status != SAME or change is comparison.total
    ]
    corrected = comparison.total.corrected
    if corrected is not None:
        signed = (
            *(figure(value, sign=True) for value in corrected[:3]),
            figure(corrected.milliwatts, 1, sign=True),
        )
        table.append(Row(TOTAL, ("total, corrected", ""), ("", "", *signed, "")))
    return Table(("pass", "change"), CHANGES, table)


def _change(change: Change) -> Row:
    difference = change.difference
    return Row(
        TOTAL if change.kind == TOTAL else LINE,
        (change.name, change.status),
        (
            "" if change.old is None else figure(change.old.traffic_mb_per_s),
            "" if change.new is None else figure(change.new.traffic_mb_per_s),
            figure(difference.read_mb_per_s, sign=True),
            figure(difference.write_mb_per_s, sign=True),
            figure(difference.memory_mib, sign=True),
            figure(difference.milliwatts, 1, sign=True),
            "" if change.per_cent is None else f"{figure(change.per_cent, 1, sign=True)} %",
        ),
    )


def sentence(comparison: Comparison, budget: float | None) -> str:
    """`This change: +2247.78 MB/s read, ..., +449.6 mW (+18.0 % of 2500 mW)`; without a budget,
    without the share.
    """
    if comparison.total.status == SAME:
        return "This change costs nothing"
    difference = comparison.total.difference
    share = (
        ""
        if budget is None
        else f" ({figure(100 * difference.milliwatts / budget, 1, sign=True)} % of {budget:g} mW)"
    )
    parts = (
        f"{figure(difference.read_mb_per_s, sign=True)} MB/s read",
        f"{figure(difference.write_mb_per_s, sign=True)} MB/s written",
        f"{figure(difference.memory_mib, sign=True)} MiB",
        f"{figure(difference.milliwatts, 1, sign=True)} mW{share}",
    )
    return f"This change: {', '.join(parts)}"


def head(cost: FrameCost) -> str:
    """The terms of an estimate. A fixed word comes first, so that no line begins with text from an
    input.
    """
    device = cost.device if cost.device is not None else "no device (on a tile-based GPU)"
    budget = "" if cost.budget_milliwatts is None else f", budget {cost.budget_milliwatts:g} mW"
    return (
        f"{cost.fps:g} frames per second on {device}, {cost.milliwatts_per_gbps:g} mW per "
        f"GB/s{budget}"
    )


def remarks(cost: FrameCost) -> list[tuple[str, str]]:
    """Assumptions, and what could not be counted: word and text."""
    return [
        *(("assumed", text) for text in cost.assumed),
        *(("unknown", text) for text in cost.unknown),
    ]


def comparison_remarks(compared: CostComparison, number: int) -> list[tuple[str, str]]:
    """What makes a comparison uncertain: word and text. Remarks that apply to both sides appear
    once.
    """
    comparison = compared.frames[number]
    same = sum(change.status == SAME for change in comparison.passes)
    lines = (
        [("note", f"{same} {'pass costs' if same == 1 else 'passes cost'} the same")]
        if same
        else []
    )
    lines += [("note", text) for text in comparison.remarks]
    old, new = (
        dict.fromkeys(
            remark for frame in side if frame.number == number for remark in remarks(frame.cost)
        )
        for side in (compared.old, compared.new)
    )
    lines += [remark for remark in old if remark in new]
    lines += [(f"{word} in the old input", text) for word, text in old if (word, text) not in new]
    lines += [(f"{word} in the new input", text) for word, text in new if (word, text) not in old]
    return lines


def budget_of(compared: CostComparison) -> float | None:
    """The power budget of a comparison, in mW; None if its device has none."""
    return next(frame.cost.budget_milliwatts for frame in (*compared.new, *compared.old))
