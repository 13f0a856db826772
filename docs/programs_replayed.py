"""Writes the section about real programs in docs/captures-and-the-layer.md: the validation layer
beside the rules, by class of messages.

    PYTHONPATH=. python docs/programs_replayed.py FOLDER

captures the programs of tests/programs into FOLDER, replays each capture with `gfxrecon-replay`
under VK_LAYER_KHRONOS_validation, and lints it. Captures that FOLDER has (NAME/scene.gfxr and
.gfxr.jsonl) are not made again, and those of further programs are included. Requires
gfxreconstruct, xvfb, vulkan-validationlayers, and the packages that it names.
"""

from __future__ import annotations

import re
import subprocess
import sys
import textwrap
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from replayed import BEGIN, END, PAGE, VENDORS, findings, messages, table

from msaa_lint.experiments.confirm.families import FAMILIES, Family
from msaa_lint.experiments.confirm.messages import classify
from tests.programs.capture import capture, missing
from tests.programs.test_programs import PROGRAMS

DISPLAY = ("xvfb-run", "--auto-servernum", "--server-args=-screen 0 1024x768x24")

ELSEWHERE = {("attachment-needs-readback", "resolve-target-loaded")}
"""Families and rules that are about different attachments of these programs: the resolve targets
are cleared, not loaded.
"""

RIGHT = {
    "non-transient-ms-image": "msaa-lint: the other images are loaded, read by a shader, or "
    "resolved by a command, which transient images"
    " do not allow, or replaced before anything is drawn (SDL); the layer sees only their creation",
    "image-requires-memory": "msaa-lint: the layer also counts the render passes that wgpu creates "
    "for pipelines and no command begins, and"
    " a store of depth that a shader reads (wgpu-depth)",
    "attachment-needs-readback": "both: the layer for each frame",
    "redundant-store": "both about color and depth of wgpu-store; the other messages are about "
    "single-sampled results, which programs"
    " without a window keep",
    "amd-render-targets": "the layer, for AMD: zink's swapchains are mutable. The rules are "
    "checked for a Mali, and do not know the flags"
    " of swapchains",
    "multisampled-attachment-stored": "msaa-lint: the layer does not check the stores of dynamic "
    "rendering (zink)",
    "multisampled-depth-stored": "msaa-lint: likewise",
    "multisampled-stencil-stored": "msaa-lint: likewise",
    "multisampled-attachment-loaded": "msaa-lint: the layer does not check the loads of dynamic "
    "rendering (zink)",
    "resolve-target-loaded": "msaa-lint: the resolve targets are cleared before a resolve "
    "overwrites them",
    "resolve-outside-pass": "msaa-lint: the layer's check is Arm's, and crashes (see Limitations)",
    "depth-read-without-resolve": "open: only the shader shows whether it needs every sample of "
    "depth",
    "multisampled-image-per-swapchain-image": "msaa-lint: Qt creates a multisampled image for each "
    "image of the swapchain",
    "resolve-then-copy": "msaa-lint: SDL resolves to a texture of its own and blits that to the "
    "swapchain",
}
"""Who is right, by reading the calls: by the name of a family, or of a rule where the layer is
silent.
"""


class Rule(NamedTuple):
    """A rule, by code and name."""

    code: str
    name: str


class Program(NamedTuple):
    """The layer's messages about a program by vendor, None where the replay crashed, and the
    findings by rule.
    """

    messages: dict[str, Counter[str] | None]
    rules: Counter[Rule]


def captures(folder: Path) -> Iterator[tuple[str, Path]]:
    """The captures by program, each with its `.jsonl` beside it; programs that cannot be captured
    here are named on standard error.
    """
    further = sorted(path.parent.name for path in folder.glob("*/scene.gfxr"))
    for name in dict.fromkeys((*PROGRAMS, *further)):
        raw = folder / name / "scene.gfxr"
        if not raw.exists():
            raw.parent.mkdir(parents=True, exist_ok=True)
            needs = missing(PROGRAMS[name].scene)
            if needs:
                print(f"{name} is left out: install {', '.join(needs)}", file=sys.stderr)
                continue
            capture(PROGRAMS[name].scene, raw.parent)
        yield name, raw


def program(raw: Path) -> Program:
    """What the layer and the rules report about a capture."""
    replay = [*DISPLAY, "gfxrecon-replay", "--remove-unsupported", "--log-level", "error", raw.name]
    rules: Counter[Rule] = Counter()
    for finding, lines in findings(raw.with_name(f"{raw.name}.jsonl")).items():
        rules[Rule(finding.code, finding.rule)] += len(lines)
    found = {}
    for vendor in VENDORS:
        # Some replays crash now and then.
        attempts = (messages(raw, vendor, replay) for _ in range(3))
        found[vendor] = next((ids for ids in attempts if ids is not None), None)
    return Program(found, rules)


def family_of(id: str) -> Family | None:
    """The family of a message about multisampling; None for another one."""
    found = classify(id) or classify(f"UNASSIGNED-BestPractices-{id}")
    return found if isinstance(found, Family) else None


def by_family(programs: Mapping[str, Program]) -> dict[str, dict[str, tuple[int, tuple[str, ...]]]]:
    """By family and program: the number of messages and the vendors whose checks report them."""
    found: dict[str, dict[str, tuple[int, tuple[str, ...]]]] = {}
    for name, seen in programs.items():
        for family in FAMILIES:
            counts = {
                vendor: sum(count for id, count in ids.items() if family_of(id) is family)
                for vendor, ids in seen.messages.items()
                if ids is not None
            }
            vendors = (
                ("",)
                if counts.get("")
                else tuple(vendor for vendor, count in counts.items() if count)
            )
            if vendors:
                found.setdefault(family.name, {})[name] = max(counts.values()), vendors
    return found


def listed(counts: Mapping[str, int]) -> str:
    """How often something is reported, and of which programs."""
    names = ", ".join(counts) if len(counts) <= 4 else f"{len(counts)} programs"
    return f"{sum(counts.values())} ({names})"


def right(name: str) -> str:
    """Who is right about a class of messages or a rule."""
    if name not in RIGHT:
        raise SystemExit(
            f"docs/programs_replayed.py: nothing says who is right about {name}; read the calls, "
            "and add it to RIGHT"
        )
    return RIGHT[name]


def link(rule: Rule) -> str:
    return f"[{rule.code}](../rules/{rule.name}.md)"


def rows(programs: Mapping[str, Program]) -> Iterator[list[str]]:
    """A row for each class of messages, with the findings of its rules about the same programs, and
    one for each rule where the layer is silent.
    """
    layer = by_family(programs)
    silent = {name: Counter(seen.rules) for name, seen in programs.items()}
    for family in FAMILIES:
        if family.name not in layer:
            continue
        theirs = layer[family.name]
        vendors = dict.fromkeys(VENDORS[vendor] for _, names in theirs.values() for vendor in names)
        ours: dict[Rule, dict[str, int]] = {}
        for name in theirs:
            for rule, count in programs[name].rules.items():
                if rule.name in family.rules and (family.name, rule.name) not in ELSEWHERE:
                    ours.setdefault(rule, {})[name] = count
                    silent[name].pop(rule, None)
        cells = [f"{link(rule)}: {listed(counts)}" for rule, counts in sorted(ours.items())]
        counts = {name: count for name, (count, _) in theirs.items()}
        yield [
            f"`{family.name}` ({', '.join(vendors)})",
            listed(counts),
            "<br>".join(cells) or "0",
            right(family.name),
        ]
    covered = {rule for family in FAMILIES for rule in family.rules}
    for rule in sorted({rule for found in silent.values() for rule in found}):
        counts = {name: found[rule] for name, found in silent.items() if found[rule]}
        yield [
            f"{link(rule)} {rule.name}",
            "silent" if rule.name in covered else "no check",
            listed(counts),
            right(rule.name),
        ]


def others(programs: Mapping[str, Program]) -> dict[str, int]:
    """The messages that are not about multisampling, by id, with the number of programs."""
    ids: Counter[str] = Counter()
    for seen in programs.values():
        ids.update(
            {
                id
                for found in seen.messages.values()
                if found is not None
                for id in found
                if family_of(id) is None
            }
        )
    return dict(sorted(ids.items()))


def crashed(programs: Mapping[str, Program]) -> str:
    """The programs whose replay crashed, by vendor."""
    found = {
        who: [name for name, seen in programs.items() if seen.messages[vendor] is None]
        for vendor, who in VENDORS.items()
    }
    return (
        "; ".join(f"{who}: {', '.join(names)}" for who, names in found.items() if names) or "none"
    )


def packages(programs: Collection[str]) -> str:
    """The versions of the packages of PyPI and Debian."""
    from importlib.metadata import PackageNotFoundError, version

    versions = {}
    for name in programs:
        for package, _ in PROGRAMS[name].scene.packages if name in PROGRAMS else ():
            try:
                versions[package] = version(package)
            except PackageNotFoundError:
                versions[package] = "version unknown"
    found = subprocess.run(
        ["dpkg-query", "-Wf${Version}", "love"], capture_output=True, text=True, check=False
    )
    if "love" in programs and found.stdout:
        versions["LÖVE"] = re.split(r"[+-]", found.stdout)[0]
    return ", ".join(f"{package} {number}" for package, number in sorted(versions.items()))


def section(programs: Mapping[str, Program]) -> str:
    """The section."""
    head = ("class of messages, or rule", "the layer", "msaa-lint", "who is right")
    found = others(programs)
    text = TEMPLATE.format(
        names=", ".join(programs),
        count=len(programs),
        packages=packages(programs),
        crashed=crashed(programs),
        others=len(found),
        most=", ".join(f"`{id}`" for id, _ in sorted(found.items(), key=lambda item: -item[1])[:5]),
    )
    before, after = (
        textwrap.fill(part.strip(), 140, break_long_words=False, break_on_hyphens=False)
        for part in text.split("TABLE")
    )
    return f"{before}\n\n{table(head, rows(programs))}\n\n{after}\n"


TEMPLATE = """\
{count} programs: {names}. The scripts in [tests/programs](../tests/programs) drive them ({packages}); sdl3-cube is
`testgpu_spinning_cube --msaa` of SDL 3.2.10. raylib, pyglet, Panda3D, LÖVE, and ModernGL use OpenGL, on zink. Tools, vendors, and profile
are those of the example above. The layer's messages are counted as they are printed, for each frame and framebuffer, by the vendor with the
most; a finding is one for each defect. The findings beside a class of messages are those about the same programs.

TABLE

Replays that crashed, by vendor: {crashed}. The layer also reports {others} messages about other matters, some of them about the replay,
most often {most}. Programs on Dawn (three.js) could not be replayed: they need extensions that lavapipe of Mesa 22.3.6 lacks.
"""


def main() -> None:
    """Writes the section."""
    programs = {name: program(raw) for name, raw in captures(Path(sys.argv[1]))}
    text = PAGE.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    PAGE.write_text(
        f"{before}{BEGIN}\n{section(programs)}{END}{rest.split(END)[1]}", encoding="utf-8"
    )


if __name__ == "__main__":
    main()
