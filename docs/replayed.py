"""Writes docs/captures-and-the-layer.md: what the validation layer says of the captures of examples/capture, and what the rules say.

    PYTHONPATH=. python docs/replayed.py

captures `forward` with all its mistakes, with none and with each alone, replays each capture with `gfxrecon-replay` under
VK_LAYER_KHRONOS_validation, and lints it. `--times` measures times alone, and keeps the rest of the page. Needs what
examples/capture/capture.sh needs, and vulkan-validationlayers; takes two minutes on two idle cores.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from msaa_lint.experiments.confirm.explanations import Noise
from msaa_lint.experiments.confirm.families import Family
from msaa_lint.experiments.confirm.messages import bare, classify

PAGE = Path(__file__).parent / "captures-and-the-layer.md"
ROOT = PAGE.parent.parent
EXAMPLE = ROOT / "examples" / "capture"
DRIVERS = Path("/usr/share/vulkan/icd.d")
MANIFEST = Path("/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json")

VENDORS = {"": "all", "ARM": "Arm", "IMG": "IMG", "AMD": "AMD", "NVIDIA": "NVIDIA"}
"""Whose checks are on, one at a time: a check that crashes takes no more than its vendor's messages with it."""

PROFILE = "mali-g76"
"""What our rules judge for. The captures say that they are of lavapipe, which has no tiles; vendors' checks of the layer do not ask."""

UNRELATED = ("DevLimit-MissingQueryCount", "vkCreateSampler-lod-clamping")
"""Messages besides NOISE of `confirm` that have nothing to do with multisampling."""

WHY = {
    4: "no check of the layer is about sample shading",
    6: "no check of the layer compares frames; synchronization validation, which is not on, is silent too",
    7: "`image-requires-memory` looks at vkCreateRenderPass alone; what is left takes the next frame's clear, or TRANSIENT usage",
    8: "nothing names stencil: depth and stencil are one to the layer",
    9: "no check of the layer is about what a depth resolve does",
    10: "no check of the layer is about what a resolve overwrites",
    13: "best practices do not follow dynamic rendering",
    14: "`StoreOpDontCareThenLoadOpLoad` follows render passes alone",
    15: "best practices do not follow dynamic rendering",
    16: "no check of the layer is about sample shading",
}
"""Where the layer misses a mistake, or its heart: why."""


class Mistake(NamedTuple):
    """A mistake that forward makes on purpose: `rule` is the one that is about it."""

    number: int
    rule: str
    place: str
    text: str


class Finding(NamedTuple):
    """A finding of ours, by what stays the same from capture to capture: not the number of a command."""

    rule: str
    code: str
    subject: str


class Capture(NamedTuple):
    """What is said of a capture: the layer's messages by id, for each vendor; whose replay crashed; our findings with their lines."""

    messages: dict[str, Counter[str]]
    crashed: list[str]
    findings: dict[Finding, list[int]]


class Used(NamedTuple):
    """What a command takes: seconds on the clock, seconds of processors, the greatest resident memory in MiB."""

    seconds: float
    processor: float
    memory: float


def mistakes() -> list[Mistake]:
    """The mistakes, as the comments in forward.c have them."""
    text = (EXAMPLE / "forward.c").read_text(encoding="utf-8")
    found = re.findall(r"/\* Mistake (\d+), ([a-z-]+), (\w+): (.*?)\. \*/", text, re.DOTALL)
    return sorted(Mistake(int(number), rule, place, " ".join(words.split())) for number, rule, place, words in found)


def captured(folder: Path, *arguments: str) -> Path:
    """The capture of forward run with arguments. `.jsonl` stands beside it."""
    folder.mkdir()
    environment = {**os.environ, "TOOLS": "gfxreconstruct"}
    subprocess.run([EXAMPLE / "capture.sh", folder, *arguments], env=environment, check=True, stdout=subprocess.DEVNULL)
    return folder / "forward.gfxr"


def layered(folder: Path, vendors: Iterable[str]) -> dict[str, str]:
    """The environment of a replay under the layer, which writes to log.txt in its folder."""
    enabled = ["VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT"]
    enabled += [f"VALIDATION_CHECK_ENABLE_VENDOR_SPECIFIC_{vendor}" for vendor in vendors if vendor]
    settings = {
        "debug_action": "VK_DBG_LAYER_ACTION_LOG_MSG",
        "log_filename": "log.txt",
        "report_flags": "error,warn,perf",
        "enables": ",".join(enabled),
        "enable_message_limit": "false",
    }
    lines = "".join(f"khronos_validation.{key} = {value}\n" for key, value in settings.items())
    (folder / "vk_layer_settings.txt").write_text(lines, encoding="utf-8")
    return {**plain(), "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation", "VK_LAYER_SETTINGS_PATH": str(folder)}


def plain() -> dict[str, str]:
    """The environment of a replay on lavapipe."""
    driver = ":".join(map(str, sorted(DRIVERS.glob("lvp_icd*.json"))))
    return {**os.environ, "VK_DRIVER_FILES": driver, "VK_ICD_FILENAMES": driver}


def replay(capture: Path) -> list[str]:
    return ["gfxrecon-replay", "--log-level", "error", str(capture)]


def messages(capture: Path, vendor: str) -> Counter[str] | None:
    """The ids of what the layer says of multisampling, and how often. None where the replay crashes."""
    log = capture.parent / "log.txt"
    log.unlink(missing_ok=True)
    done = subprocess.run(replay(capture), cwd=capture.parent, env=layered(capture.parent, [vendor]), capture_output=True, check=False)
    if done.returncode:
        return None
    found: Counter[str] = Counter()
    for id, text in re.findall(r"^([\w-]+)\((?:ERROR|WARN)[^)]*\): msgNum: (.*)$", log.read_text(encoding="utf-8"), re.MULTILINE):
        if bare(id) not in UNRELATED and not isinstance(classify(id, text), Noise):
            found[id.removeprefix("UNASSIGNED-").removeprefix("BestPractices-")] += 1
    return found


def lint(jsonl: Path) -> list[str]:
    return [sys.executable, "-m", "msaa_lint", "check", "--isolated", "--profile", PROFILE, "--output", "json", str(jsonl)]


def findings(jsonl: Path) -> dict[Finding, list[int]]:
    """Our findings, for a device with tiles: the lines in which the capture says what it ran on are left empty."""
    text = jsonl.read_text(encoding="utf-8")
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl", encoding="utf-8") as file:
        file.write(re.sub(r'^.*"name":"vkGetPhysicalDevice.*$', "", text, flags=re.MULTILINE))
        file.flush()
        done = subprocess.run(lint(Path(file.name)), cwd=ROOT, capture_output=True, text=True, check=False)
    if not done.stdout:
        raise SystemExit(f"{jsonl}: {done.stderr}")
    found: dict[Finding, list[int]] = {}
    for each in json.loads(done.stdout)["findings"]:
        subject = re.sub(r"^commands\[\d+\]\.", "", each["subject"])
        found.setdefault(Finding(each["rule"], each["code"], subject), []).append(each["line"])
    return found


def said(folder: Path, *arguments: str) -> Capture:
    """What the layer and the rules say of forward run with arguments."""
    capture = captured(folder, *arguments)
    said = {vendor: messages(capture, vendor) for vendor in VENDORS}
    crashed = [VENDORS[vendor] for vendor, found in said.items() if found is None]
    found = {vendor: found for vendor, found in said.items() if found is not None}
    return Capture(found, crashed, findings(capture.with_suffix(".jsonl")))


def whose(messages: Mapping[str, Counter[str]], id: str) -> tuple[str, int]:
    """Whose checks say it, and how often."""
    vendors = [vendor for vendor, found in messages.items() if id in found]
    count = max(messages[vendor][id] for vendor in vendors)
    return ("all" if "" in vendors else ", ".join(VENDORS[vendor] for vendor in vendors)), count


def used(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> Used:
    """What one run of a command takes."""
    begun = time.perf_counter()
    process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - begun
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        raise SystemExit(f"{command[0]} ends with {process.returncode}")
    return Used(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)


def linked(finding: Finding) -> str:
    return f"[{finding.code}](../rules/{finding.rule}.md)"


def at(lines: Sequence[int]) -> str:
    return ", line " + " and ".join(map(str, lines)) if lines else ""


def rows(each: Mapping[Mistake, Capture], shown: Mapping[Finding, Sequence[int]]) -> Iterator[list[str]]:
    """A line for each mistake: what the layer says of it alone, and what we say."""
    for mistake, capture in each.items():
        ids = sorted({id for found in capture.messages.values() for id in found})
        layer = [f"`{id}` ({', '.join(map(str, whose(capture.messages, id)))}×)" for id in ids]
        if mistake.number in WHY:
            layer.append(f"*{WHY[mistake.number]}*")
        own = [
            f"{linked(finding)} {finding.rule}, `{finding.subject}`" + at(shown.get(finding, ()))
            for finding in sorted(capture.findings, key=lambda finding: (finding.rule != mistake.rule, finding))
        ]
        yield [f"{mistake.number}", f"{mistake.place}: {mistake.text}", "<br>".join(layer) or "nothing", "<br>".join(own) or "nothing"]


def answers(together: Capture, each: Mapping[Mistake, Capture]) -> Iterator[list[str]]:
    """A line for each id of the layer's in the capture with all mistakes: how often, and which mistakes and rules are behind it."""
    for id in sorted({id for found in together.messages.values() for id in found}, key=str.lower):
        behind = [mistake for mistake, capture in each.items() if any(id in found for found in capture.messages.values())]
        family = classify("UNASSIGNED-BestPractices-" + id) if not id.startswith("VUID") else classify(id)
        rules = family.rules if isinstance(family, Family) else ()
        own = dict.fromkeys(
            linked(finding) for mistake in behind for finding in each[mistake].findings if finding.rule in (*rules, mistake.rule)
        )
        who, count = whose(together.messages, id)
        yield [f"`{id}`", who, str(count), ", ".join(str(mistake.number) for mistake in behind), ", ".join(own) or "none"]


def times(folder: Path) -> Iterator[list[str]]:
    """What replaying and linting take, for a short capture and a long one."""
    for frames in (4, 300):
        capture = captured(folder / f"frames-{frames}", "--frames", str(frames))
        jsonl = capture.with_suffix(".jsonl")
        here = capture.parent
        commands: dict[str, tuple[list[str], dict[str, str]]] = {
            "gfxrecon-replay without the layer": (replay(capture), plain()),
            "gfxrecon-replay under the layer, best practices, all four vendors": (replay(capture), layered(here, VENDORS)),
            "gfxrecon-convert": (["gfxrecon-convert", "--output", str(here / "again.jsonl"), str(capture)], plain()),
            "msaa-lint check": (lint(jsonl), {**os.environ, "PYTHONPATH": str(ROOT)}),
        }
        taken: dict[str, list[Used]] = {name: [] for name in commands}
        for _ in range(3):  # in turns: what else the machine does then falls on all of them
            for name, (command, environment) in commands.items():
                taken[name].append(used(command, here, environment))
        for name, runs in taken.items():
            size = (jsonl if name.startswith("msaa-lint") else capture).stat().st_size / 1e6
            best = Used(*map(min, zip(*runs, strict=True)))
            yield [f"{frames}", f"{size:.2f}", name, f"{best.seconds:.2f}", f"{best.processor:.2f}", f"{best.memory:.0f}"]


def time_table(folder: Path) -> str:
    return table(("frames", "MB read", "", "seconds", "of processors", "MiB"), times(folder))


def page(folder: Path) -> str:
    """The page, measured anew."""
    together, fixed = said(folder / "together"), said(folder / "fixed", "--fixed")
    each = {mistake: said(folder / f"mistake-{mistake.number}", "--mistake", str(mistake.number)) for mistake in mistakes()}
    committed = findings(EXAMPLE / "forward.jsonl")
    unexplained = [m.number for m, capture in each.items() if not any(capture.messages.values()) and m.number not in WHY]
    if unexplained:
        raise SystemExit(f"docs/replayed.py: the layer is silent about {unexplained}; WHY has to say why")
    missed = [str(m.number) for m, capture in each.items() if m.rule not in {finding.rule for finding in capture.findings}]
    silent = [str(m.number) for m, capture in each.items() if not any(capture.messages.values())]
    crashed = {who for capture in (together, fixed, *each.values()) for who in capture.crashed}
    layer = json.loads(MANIFEST.read_text(encoding="utf-8"))["layer"]["api_version"]
    tool = subprocess.run(["gfxrecon-replay", "--version"], capture_output=True, text=True, check=True).stdout
    mesa = subprocess.run(["dpkg-query", "-Wf${Version}", "mesa-vulkan-drivers"], capture_output=True, text=True, check=True).stdout
    version = re.search(r"GFXReconstruct Version ([\d.]+)", tool)
    return TEMPLATE.format(
        count=len(each),
        layer=layer,
        tool=version[1] if version else "?",
        mesa=mesa.partition("-")[0],
        profile=PROFILE,
        mistakes=table(("", "mistake", "the layer, replaying", "msaa-lint check"), rows(each, committed)),
        fixed_messages=sum(sum(found.values()) for found in fixed.messages.values()) or "nothing",
        fixed_findings=len(fixed.findings) or "nothing",
        silent=", ".join(silent) or "none",
        missed=", ".join(missed) or "none",
        crashed=", ".join(sorted(crashed)) or "none",
        answers=table(("message", "checks", "times", "mistakes behind it", "ours"), answers(together, each)),
        findings=sum(map(len, together.findings.values())),
        times=time_table(folder),
    )


TEMPLATE = """\
# Captures and the validation layer

A capture can be searched for mistakes without the program that it is of: by replaying it under Khronos' validation layer. This page puts
what the layer says beside what `msaa-lint check` says of the same capture. `PYTHONPATH=. python docs/replayed.py` made it, from the
program in [examples/capture](../examples/capture/README.md), which makes {count} mistakes on purpose: once all of them, once none, and
each alone.

gfxreconstruct {tool}; VK_LAYER_KHRONOS_validation {layer} with core checks and best practices, once without a vendor and once with each
of Arm, IMG, AMD and NVIDIA; lavapipe of Mesa {mesa}; four frames. Messages that have nothing to do with multisampling are left out
([noise](agreement.md#noise)). Ours are for `--profile {profile}`, and of captures whose lines that say what they ran on are empty, as
trimmed captures have none: lavapipe has no tiles, and where a capture says so, rules about tiles are silent or notes. The layer's checks
for a vendor speak wherever they run.

## Each mistake alone

The line is that of [forward.jsonl](../examples/capture/forward.jsonl), which has all mistakes, where the finding is there too. An image
that is transient and stored gets two findings: in a frame that is right otherwise, a store is against both.

{mistakes}

Without mistakes the layer says {fixed_messages}, and the rules say {fixed_findings}.

The layer says nothing of {silent}. The rules miss {missed}.

## All together

{findings} findings. The layer:

{answers}

The layer says handles and numbers of attachments, anew in every frame and for every framebuffer. A finding says the pass, the pipeline or
the image as the program named it, the call, the line, and in how many frames it is so.

## What had to be left out

Replays that crashed, by vendor: {crashed}. Version 1.3.239 of the layer crashes in Arm's check of blending where a multisampled pipeline
is created without a render pass, for dynamic rendering. The program gets round that by creating that pipeline in one call with one of a
single sample, at which the check gives up; so the layer does not judge its blending. A capture of a program that does not do so cannot be
replayed with Arm's checks.

`vkBindImageMemory-non-lazy-transient-image` and `vkCreateFramebuffer-attachment-should-be-transient` are silent where the device that
replays has no lazily allocated memory, as no software driver has.

## Time and memory

Best of three, in turns, whole processes, on two cores: seconds on the clock, seconds of processors, the greatest resident memory. Replays
draw, on lavapipe by the processor: the row without the layer says how much of it is that.

<!-- times -->
{times}
<!-- end of times -->

`gfxrecon-convert` runs once for a capture. A replay takes a driver with the features and formats of the one that was captured; a check
takes the file.
"""


def timed(text: str, folder: Path) -> str:
    """The page with its table of times measured anew."""
    before, rest = text.split("<!-- times -->\n")
    after = rest.split("\n<!-- end of times -->")[1]
    return f"{before}<!-- times -->\n{time_table(folder)}\n<!-- end of times -->{after}"


def main() -> None:
    """Writes the page, or no more than its times anew."""
    with tempfile.TemporaryDirectory() as folder:
        text = timed(PAGE.read_text(encoding="utf-8"), Path(folder)) if "--times" in sys.argv else page(Path(folder))
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
