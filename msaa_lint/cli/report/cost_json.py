"""The versioned JSON of `msaa-lint cost`; `cost_v1.schema.json` next to this file is its schema.
Figures have six decimals.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from msaa_lint.core.finding import Result
from msaa_lint.frame.cost.amounts import Amount, FrameCost, Line, PassCost, Shading
from msaa_lint.frame.cost.compare import Change, title
from msaa_lint.frame.cost.input_cost import CostComparison, CostedFrame, inputs_total
from msaa_lint.frame.cost.power import Rates
from msaa_lint.frame.cost.variants import Variant

from . import Options, Write
from .data import Json, head, rounded, start, text, write_object
from .escape import escape_surrogates
from .paths import relative

SCHEMA = "msaa-lint/cost-v1"


def render(frames: Sequence[CostedFrame], errors: Result, out: Write, options: Options) -> None:
    """Prints one JSON object: `passes` of all frames and their `total`, `frames` with the details
    of each, `errors`.

    The details of an only frame are at the top as well.
    """
    write_object(
        {
            **head(SCHEMA, options.version),
            **_inputs(frames, errors, options),
            "errors": _errors(errors, options),
        },
        out,
    )


def render_comparison(
    comparison: CostComparison, errors: Result, out: Write, options: Options
) -> None:
    """Prints one JSON object: `old` and `new`, each with the members that `render` prints for
    frames, and their `difference`.
    """
    passes = [
        {**_change(change), "document": number, "name": text(change.name), "kind": change.kind}
        for number, frame in enumerate(comparison.frames)
        for change in frame.passes
    ]
    totals = [frame.total for frame in comparison.frames]
    total = {
        **_amount(_sum(change.difference for change in totals)),
        "corrected": _optional([change.corrected for change in totals]),
        "percent": rounded(totals[0].per_cent) if len(totals) == 1 else None,
    }
    remarks = [text(remark) for frame in comparison.frames for remark in frame.remarks]
    members = {
        **head(SCHEMA, options.version),
        "old": _complete(_inputs(comparison.old, errors, options)),
        "new": _complete(_inputs(comparison.new, errors, options)),
        "difference": {"total": total, "passes": passes, "remarks": remarks},
        "errors": _errors(errors, options),
    }
    write_object(members, out)


def _inputs(frames: Sequence[CostedFrame], errors: Result, options: Options) -> Json:
    """What is printed of frames, as iterators, since many do not fit into memory."""
    details = (_frame(frame, errors, options) for frame in frames)
    passes = (
        {"file": _file(frame, options), "document": frame.number, **_pass(cost, frame, errors)}
        for frame in frames
        for cost in frame.cost.passes
    )
    if len(frames) == 1:
        return {**_frame(frames[0], errors, options), "passes": passes, "frames": details}
    total = {
        **_amount(inputs_total(frames)),
        **_corrected(*([getattr(frame.cost, name) for frame in frames] for name in CORRECTED)),
    }
    return {"passes": passes, "total": total, "frames": details}


def _complete(members: Json) -> Json:
    """Members with lists in place of iterators."""
    return {
        key: list(value) if isinstance(value, Iterator) else value for key, value in members.items()
    }


def _file(frame: CostedFrame, options: Options) -> str:
    return escape_surrogates(relative(frame.file, options.root))


def _frame(frame: CostedFrame, errors: Result, options: Options) -> Json:
    cost = frame.cost
    return {
        "file": _file(frame, options),
        "document": frame.number,
        "device": None if cost.device is None else text(cost.device),
        "fps": cost.fps,
        "milliwatts_per_gbps": cost.milliwatts_per_gbps,
        "budget_milliwatts": cost.budget_milliwatts,
        "passes": [_pass(pass_cost, frame, errors) for pass_cost in cost.passes],
        "total": _total(cost),
        "share": cost.share,
        "fixed": None if frame.fixed is None else _total(frame.fixed),
        "safely_fixed": None if frame.safely_fixed is None else _total(frame.safely_fixed),
        "variants": _variants(frame.variants),
        "fixed_variants": _variants(frame.fixed_variants),
        "images": [{**image._asdict(), "name": text(image.name)} for image in cost.images],
        "assumed": [
            *(["the traffic is that on a tile-based GPU"] if cost.device is None else []),
            *map(text, cost.assumed),
        ],
        "unknown": list(map(text, cost.unknown)),
    }


def _variants(variants: Sequence[Variant]) -> list[Json]:
    return [
        {
            "samples": variant.samples,
            "resolve": variant.resolve,
            "offered": variant.offered,
            **_total(variant.cost),
        }
        for variant in variants
    ]


def _pass(cost: PassCost, frame: CostedFrame, errors: Result) -> Json:
    rates = Rates(frame.cost.fps, frame.cost.milliwatts_per_gbps)
    return {
        "name": text(cost.name),
        "title": text(title(cost)),
        "path": text(cost.path),
        "kind": cost.kind,
        "times": cost.times,
        "width": cost.width,
        "height": cost.height,
        **_amount(cost.amount),
        **_corrected([cost.corrected], [cost.corrected_most]),
        "lines": [_line(line, rates, frame.file, errors) for line in cost.lines],
        "shading": None if cost.shading is None else _shading(cost.shading),
        "tile": None if cost.tile is None else cost.tile._asdict(),
        "unknown": list(map(text, cost.unknown)),
    }


def _line(line: Line, rates: Rates, file: str, errors: Result) -> Json:
    read = line.direction == "read"
    amount = rates.amount(line.bytes if read else 0, 0 if read else line.bytes, 0)
    low, high = (
        None if each is None else rounded(rates.amount(each, 0, 0).traffic_mb_per_s)
        for each in (line.corrected, line.corrected_most)
    )
    return {
        "attachment": text(line.attachment),
        "image": text(line.image),
        "aspect": line.aspect,
        "samples": line.samples,
        "action": line.action,
        "direction": line.direction,
        "bytes": line.bytes,
        "mb_per_s": rounded(amount.traffic_mb_per_s),
        "milliwatts": rounded(amount.milliwatts),
        "corrected_mb_per_s": low,
        "corrected_most_mb_per_s": high,
        **start(errors, file, line.place),
    }


def _shading(shading: Shading) -> Json:
    return {
        **shading._asdict(),
        "edges": [{"leg": leg, "factor": factor} for leg, factor in shading.edges],
    }


def _total(cost: FrameCost) -> Json:
    return {**_amount(cost.total), **_corrected([cost.corrected], [cost.corrected_most])}


CORRECTED = ("corrected", "corrected_most")


def _corrected(*amounts: Sequence[Amount | None]) -> Json:
    """What the device compresses, at least and at most."""
    return dict(zip(CORRECTED, map(_optional, amounts), strict=True))


def _change(change: Change) -> Json:
    return {
        "status": change.status,
        **_amount(change.difference),
        "corrected": None if change.corrected is None else _amount(change.corrected),
        "percent": rounded(change.per_cent),
    }


def _amount(amount: Amount) -> Json:
    return {name: rounded(value) for name, value in amount._asdict().items()}


def _optional(amounts: Sequence[Amount | None]) -> Json | None:
    """The sum; None if one is unknown, or there is none."""
    known = [amount for amount in amounts if amount is not None]
    return _amount(_sum(known)) if known and len(known) == len(amounts) else None


def _sum(amounts: Iterable[Amount]) -> Amount:
    return Amount(
        *(sum(column) for column in zip(Amount(0.0, 0.0, 0.0, 0.0), *amounts, strict=True))
    )


def _errors(errors: Result, options: Options) -> list[Json]:
    return [
        {
            "rule": text(finding.rule),
            "code": text(finding.code),
            "message": text(finding.message),
            "file": escape_surrogates(relative(finding.file, options.root)),
            **start(errors, finding.file, finding.span),
            "help": text(finding.help),
        }
        for finding in errors.findings
    ]
