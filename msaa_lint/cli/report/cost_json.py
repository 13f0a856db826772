"""The versioned JSON of `msaa-lint cost`; `cost_v1.schema.json` beside this file is its schema.

Texts are as the input has them but for lone surrogates and for what is longer than `escape.LONGEST`. Figures have six decimals.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from msaa_lint.frame.cost.amounts import Amount, FrameCost, Line, PassCost, Shading
from msaa_lint.frame.cost.compare import Change, title
from msaa_lint.frame.cost.power import Rates

from .data import dump, write_list
from .escape import clip, whole
from .paths import relative
from .place import place

if TYPE_CHECKING:
    from msaa_lint.core.finding import Finding, Result
    from msaa_lint.core.text.span import Span
    from msaa_lint.frame.cost.input_cost import Compared, Costed

    from . import Options, Write

SCHEMA = "msaa-lint/cost-v1"
_DIGITS = 6
_NAMES = Amount._fields

Json = dict[str, Any]


def render(frames: Sequence[Costed], wrong: Result, out: Write, options: Options) -> None:
    """Prints one JSON object: `passes` of all frames and their `total`, `frames` with the rest of each, `errors`.

    What else there is of a frame stands at the top too where it is the only one.
    """
    _write({**_head(options), **_inputs(frames, wrong, options), "errors": _errors(wrong, options)}, out)


def render_comparison(found: Compared, wrong: Result, out: Write, options: Options) -> None:
    """Prints one JSON object: `old` and `new`, each as `render` has its frames, and their `difference`."""
    passes = [
        {**_change(each), "document": number, "name": _text(each.name), "kind": each.kind}
        for number, frame in enumerate(found.frames)
        for each in frame.passes
    ]
    totals = [frame.total for frame in found.frames]
    more = {
        **_amount(_sum(each.difference for each in totals)),
        "corrected": _optional([each.corrected for each in totals]),
        "percent": _rounded(totals[0].per_cent) if len(totals) == 1 else None,
    }
    remarks = [_text(text) for frame in found.frames for text in frame.remarks]
    report = {
        **_head(options),
        "old": _inputs(found.old, wrong, options),
        "new": _inputs(found.new, wrong, options),
        "difference": {"total": more, "passes": passes, "remarks": remarks},
        "errors": _errors(wrong, options),
    }
    _write(report, out)


def _head(options: Options) -> Json:
    return {"schema": SCHEMA, **({"version": options.version} if options.version else {})}


def _write(report: Json, out: Write) -> None:
    """Prints an object with an element of each of its lists a line, so that no report is one endless line."""
    out("{\n")
    for number, (key, value) in enumerate(report.items()):
        out(",\n" if number else "")
        out(f"  {dump(key)}: ")
        if isinstance(value, list):
            write_list(value, out, "  ")
        else:
            out(dump(value))
    out("\n}\n")


def _inputs(frames: Sequence[Costed], wrong: Result, options: Options) -> Json:
    made = [_frame(each, wrong, options) for each in frames]
    totals = [each.cost.total for each in frames]
    passes = [{"file": each["file"], "document": each["document"], **own} for each in made for own in each["passes"]]
    total = {**_amount(_sum(totals)), "corrected": _optional([each.cost.corrected for each in frames])}
    if len(made) == 1:
        return {**made[0], "passes": passes, "frames": made}
    return {"passes": passes, "total": total, "frames": made}


def _frame(each: Costed, wrong: Result, options: Options) -> Json:
    cost = each.cost
    return {
        "file": whole(relative(each.file, options.root)),
        "document": each.number,
        "device": None if cost.device is None else _text(cost.device),
        "fps": cost.fps,
        "milliwatts_per_gbps": cost.milliwatts_per_gbps,
        "budget_milliwatts": cost.budget_milliwatts,
        "passes": [_pass(own, each, wrong) for own in cost.passes],
        "total": _total(cost),
        "fixed": None if each.fixed is None else _total(each.fixed),
        "variants": [{"samples": own.samples, "resolve": own.resolve, "offered": own.offered, **_total(own.cost)} for own in each.variants],
        "images": [
            {"name": _text(own.name), "bytes": own.bytes, "committed": own.committed, "committed_by_use": own.committed_by_use}
            for own in cost.images
        ],
        "assumed": [_text(text) for text in cost.assumed],
        "unknown": [_text(text) for text in cost.unknown],
    }


def _pass(own: PassCost, each: Costed, wrong: Result) -> Json:
    rates = Rates(each.cost.fps, each.cost.milliwatts_per_gbps)
    return {
        "name": _text(own.name),
        "title": _text(title(own)),
        "path": _text(own.path),
        "kind": own.kind,
        "times": own.times,
        "width": own.width,
        "height": own.height,
        **_amount(own.amount),
        "corrected": None if own.corrected is None else _amount(own.corrected),
        "lines": [_line(line, rates, each.file, wrong) for line in own.lines],
        "shading": None if own.shading is None else _shading(own.shading),
        "tile": None if own.tile is None else own.tile._asdict(),
        "unknown": [_text(text) for text in own.unknown],
    }


def _line(line: Line, rates: Rates, file: str, wrong: Result) -> Json:
    read = line.direction == "read"
    amount = rates.amount(line.bytes if read else 0, 0 if read else line.bytes, 0)
    corrected = None if line.corrected is None else rates.amount(line.corrected, 0, 0)
    return {
        "attachment": _text(line.attachment),
        "image": _text(line.image),
        "aspect": line.aspect,
        "samples": line.samples,
        "action": line.action,
        "direction": line.direction,
        "bytes": line.bytes,
        "mb_per_s": _rounded(amount.traffic_mb_per_s),
        "milliwatts": _rounded(amount.milliwatts),
        "corrected_mb_per_s": None if corrected is None else _rounded(corrected.traffic_mb_per_s),
        **_place(wrong, file, line.place),
    }


def _shading(found: Shading) -> Json:
    return {**found._asdict(), "edges": [{"leg": leg, "factor": factor} for leg, factor in found.edges]}


def _total(cost: FrameCost) -> Json:
    return {**_amount(cost.total), "corrected": None if cost.corrected is None else _amount(cost.corrected)}


def _change(each: Change) -> Json:
    return {
        "status": each.status,
        **_amount(each.difference),
        "corrected": None if each.corrected is None else _amount(each.corrected),
        "percent": _rounded(each.per_cent),
    }


def _amount(amount: Amount) -> Json:
    return {name: _rounded(value) for name, value in zip(_NAMES, amount, strict=True)}


def _optional(amounts: Sequence[Amount | None]) -> Json | None:
    """The sum; None where one is not known, or there is none."""
    known = [amount for amount in amounts if amount is not None]
    return _amount(_sum(known)) if known and len(known) == len(amounts) else None


def _sum(amounts: Iterable[Amount]) -> Amount:
    return Amount(*(sum(column) for column in zip(Amount(0.0, 0.0, 0.0, 0.0), *amounts, strict=True)))


def _rounded(value: float | None) -> float | None:
    """What JSON can hold; `-0.0` is 0."""
    return None if value is None else round(value, _DIGITS) + 0.0


def _errors(wrong: Result, options: Options) -> list[Json]:
    return [_error(found, wrong, options) for found in wrong.findings]


def _error(found: Finding, wrong: Result, options: Options) -> Json:
    return {
        "rule": _text(found.rule),
        "code": _text(found.code),
        "message": _text(found.message),
        "file": whole(relative(found.file, options.root)),
        **_place(wrong, found.file, found.span),
        "help": _text(found.help),
    }


def _place(wrong: Result, file: str, span: Span | None) -> Json:
    at = place(wrong, file, span)
    return {"line": at.line if at else None, "column": at.column if at else None}


def _text(text: str) -> str:
    return whole(clip(text))
