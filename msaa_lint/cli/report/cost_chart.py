"""One figure of what a frame costs: as written, fixed, and with other sample counts, resolved inline and separately.

matplotlib is an extra and is imported when a chart is drawn; nothing of it that a user configures takes part, so that the same frame
gives the same SVG.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.frame.cost.amounts import FrameCost
from msaa_lint.frame.cost.input_cost import Compared, Costed
from msaa_lint.frame.cost.variants import AS_WRITTEN, NONE, Variant

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FORMATS = ("svg", "png")

READ_COLOR, WRITE_COLOR = "#56B4E9", "#D55E00"
"""Sky blue and vermilion of Okabe and Ito's palette: apart for every kind of colour blindness, and in grey; reads are hatched besides."""

_BAR, _GAP = 0.72, 0.55
_SETTINGS: Any = {
    "svg.hashsalt": "msaa-lint",
    "svg.fonttype": "none",
    "text.parse_math": False,
    "font.size": 10,
    "hatch.linewidth": 0.6,
}


class Bar(NamedTuple):
    """A frame's traffic in MB/s and its power in mW under a name; `group` changes where a gap is due."""

    name: str
    group: str
    read: float
    write: float
    milliwatts: float


def bars(costed: Costed) -> list[Bar]:
    """What is drawn of a frame, from top to bottom."""
    found = [_bar("as written", "", costed.cost)]
    if costed.fixed is not None:
        found.append(_bar("fixed", "", costed.fixed))
    return found + list(_variants(costed.variants))


def compared_bars(found: Compared) -> list[Bar]:
    """What is drawn of two inputs of one frame each: both as written, and of the new one the rest."""
    made = [_bar("old, as written", "", each.cost) for each in found.old]
    for each in found.new:
        made += [bar._replace(name=f"new, {bar.name}") if not bar.group else bar for bar in bars(each)]
    return made


def _variants(variants: Sequence[Variant]) -> Iterator[Bar]:
    placed = {each.samples for each in variants if each.resolve not in (AS_WRITTEN, NONE)}
    for each in variants:
        if each.resolve == AS_WRITTEN and each.samples in placed:
            continue
        place = f", {each.resolve}" if each.samples in placed else ""
        offered = " (not offered)" if each.offered is False else ""
        yield _bar(f"{each.samples}x{place}{offered}", str(each.samples), each.cost)


def _bar(name: str, group: str, cost: FrameCost) -> Bar:
    total = cost.total
    return Bar(name, group, total.read_mb_per_s, total.write_mb_per_s, total.milliwatts)


def draw(found: Sequence[Bar], title: str, subtitle: str, cost: FrameCost, format: str) -> bytes:
    """A figure of the bars as SVG or PNG. `title` and `subtitle` are shown as they are: whoever calls has escaped them.

    `cost` has the power of a GB/s and the budget. ModuleNotFoundError where matplotlib is not installed.
    """
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(), warnings.catch_warnings():
        # A glyph that the font does not have is a box: no reason to print anything.
        warnings.simplefilter("ignore")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        positions = _positions(found)
        figure = Figure(figsize=(10, 1.9 + 0.36 * (positions[-1] if positions else 0)), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
        _bars(axes, found, positions, cost)
        figure.suptitle(title, x=0.01, ha="left", fontweight="bold")
        axes.set_title(subtitle, loc="left", fontsize=9)
        out = io.BytesIO()
        about: dict[str, Any] = {"Date": None, "Creator": "msaa-lint"} if format == "svg" else {"Software": "msaa-lint"}
        figure.savefig(out, format=format, metadata=about, dpi=150)
    return out.getvalue()


def _positions(found: Sequence[Bar]) -> list[float]:
    positions: list[float] = []
    at, group = 0.0, found[0].group if found else ""
    for bar in found:
        at += _GAP if bar.group != group else 0.0
        group = bar.group
        positions.append(at)
        at += 1
    return positions


def _bars(axes: Axes, found: Sequence[Bar], positions: Sequence[float], cost: FrameCost) -> None:
    reads, writes = [bar.read for bar in found], [bar.write for bar in found]
    edge: dict[str, Any] = {"height": _BAR, "edgecolor": "black", "linewidth": 0.6}
    axes.barh(positions, reads, color=READ_COLOR, hatch="///", label="read", **edge)
    axes.barh(positions, writes, left=reads, color=WRITE_COLOR, label="write", **edge)
    longest = max((bar.read + bar.write for bar in found), default=0.0) or 1.0
    for bar, at in zip(found, positions, strict=True):
        share = 100 * bar.milliwatts / cost.budget_milliwatts
        text = f"{bar.read + bar.write:.0f} MB/s, {bar.milliwatts:.0f} mW ({share:.1f} %)"
        box = {"facecolor": "white", "edgecolor": "none", "pad": 1}
        axes.text(bar.read + bar.write + longest * 0.01, at, text, va="center", fontsize=9, bbox=box)
    axes.set_yticks(positions, [bar.name for bar in found])
    axes.invert_yaxis()
    axes.set_xlim(0, longest * 1.4)
    axes.set_xlabel(f"traffic with external memory, MB/s; in brackets the share of {cost.budget_milliwatts:g} mW")
    axes.ticklabel_format(axis="x", style="plain", useOffset=False)
    axes.grid(axis="x", color="#CCCCCC", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=2, frameon=False)
