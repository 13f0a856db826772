"""Generates the tables of docs/agreement.md from the data of `confirm`; `--check` only tests
whether they are up to date.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from msaa_lint.experiments.confirm.explanations import (
    CONSEQUENCES,
    EXPLANATIONS,
    NOISE,
    Explanation,
)
from msaa_lint.experiments.confirm.families import FAMILIES, CheckScope
from msaa_lint.linter.rules.registry import load

PAGE = Path(__file__).parent / "agreement.md"
NAMES = {"arm": "Arm", "img": "IMG", "amd": "AMD", "nvidia": "NVIDIA"}
PASSES = {
    "renderPass": "vkCreateRenderPass",
    "renderPass2": "vkCreateRenderPass2",
    "rendering": "vkCmdBeginRendering",
}


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table in Markdown."""
    head = list(head)
    lines = [head, ["---"] * len(head), *(list(row) for row in rows)]
    return "\n".join(
        "| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines
    )


def linked(rules: Iterable[str]) -> str:
    return ", ".join(f"[{rule}](../rules/{rule}.md)" for rule in rules)


def looks(at: CheckScope) -> str:
    """What the layer checks, in words."""
    words = []
    if at.passes:
        words.append(", ".join(PASSES[each] for each in at.passes))
    if at.vendors:
        words.append(" and ".join(NAMES[each] for each in at.vendors) + " checks")
    if at.since is not None:
        words.append("since " + ".".join(map(str, at.since)))
    if at.lazy:
        words.append("devices with lazily allocated memory")
    if at.device:
        words.append("the device that runs")
    if at.instead:
        words.append(at.instead)
    words.extend(text.removeprefix("it checks ") for _, _, text in at.when)
    return "; ".join(words)


def families() -> str:
    rows = (
        (
            f"`{f.name}`",
            f.description,
            linked(f.rules) or "none",
            looks(f.scope),
            " ".join(f"`{id}`" for id in f.ids),
        )
        for f in FAMILIES
    )
    return table(
        ("family", "the layer reports", "rules", "it checks", "VUIDs and best practices"), rows
    )


def alone() -> str:
    known = {rule for family in FAMILIES for rule in family.rules}
    rules = [rule for rule in load([]).rules if rule.name not in known and "vulkan" in rule.apis]
    return "\n".join(f"- [{rule.name}](../rules/{rule.name}.md): {rule.summary}" for rule in rules)


def noise() -> str:
    reasons = dict.fromkeys(each.reason for each in NOISE)
    ids = {
        reason: [id for each in NOISE if each.reason == reason for id in each.ids]
        for reason in reasons
    }
    return table(
        ("why", "messages"),
        ((reason, " ".join(f"`{id}`" for id in ids[reason])) for reason in reasons),
    )


def explained(keep: Callable[[Explanation], bool]) -> str:
    rows = (
        (f"`{e.family}`", f"{e.subject}: `{e.when}`", e.reason) for e in EXPLANATIONS if keep(e)
    )
    return table(("family", "where", "why"), rows)


def consequences() -> str:
    rows = (
        (" ".join(f"`{id}`" for id in each.ids), linked(each.rules), each.reason)
        for each in CONSEQUENCES
    )
    return table(("family or VUID", "follows from", "why"), rows)


TABLES: dict[str, Callable[[], str]] = {
    "families": families,
    "alone": alone,
    "noise": noise,
    "wrong": lambda: explained(lambda each: each.wrong),
    "deliberate": lambda: explained(lambda each: not each.wrong),
    "consequences": consequences,
}


def fresh(text: str) -> str:
    """The page with its tables regenerated."""
    for name, made in TABLES.items():
        begin, end = f"<!-- {name}: made by docs/agreement.py -->", f"<!-- end of {name} -->"
        if text.count(begin) != 1 or end not in text:
            raise SystemExit(f"docs/agreement.md has no single place for {name}")
        before, after = text.split(begin)
        text = f"{before}{begin}\n{made()}\n{end}{after.split(end, 1)[1]}"
    return text


if __name__ == "__main__":
    page = PAGE.read_text(encoding="utf-8")
    if "--check" in sys.argv:
        sys.exit(page != fresh(page))
    PAGE.write_text(fresh(page), encoding="utf-8")
