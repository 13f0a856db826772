"""Writes docs/captures-and-the-layer.md, which compares the validation layer with the rules for the
captures of examples/capture.

    PYTHONPATH=. python docs/replayed.py

captures `forward` with all its mistakes, with none, and with each alone, replays each capture with
`gfxrecon-replay` under VK_LAYER_KHRONOS_validation, and lints it. `--times` only measures the times
and keeps the rest of the page. Requires vulkan-validationlayers and the requirements of
examples/capture/capture.sh; takes two minutes on two idle cores.
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
"""The vendors whose checks are enabled, one per replay, so that a crash only loses that vendor's
messages.
"""

PROFILE = "mali-g76"
"""The device for the rules. The captures are from lavapipe, which is not tile-based; the layer's
vendor checks ignore the device.
"""

BEGIN, END = "<!-- programs: made by docs/programs_replayed.py -->", "<!-- end of programs -->"
"""The section of real programs on the page."""

UNRELATED = ("DevLimit-MissingQueryCount", "vkCreateSampler-lod-clamping")
"""Messages unrelated to multisampling, in addition to those of `confirm.noise`."""

REASONS = {
    4: "the layer has no check for sample shading",
    6: "the layer has no check across frames; synchronization validation, which is disabled here, "
    "does not report it either",
    7: "`image-requires-memory` only covers vkCreateRenderPass; the other messages require a clear "
    "in the next frame, or TRANSIENT usage",
    8: "no message names stencil: the layer treats depth and stencil as one",
    9: "the layer has no check for the mode of a depth resolve",
    10: "the layer has no check for contents that a resolve overwrites",
    13: "the best-practice checks do not cover dynamic rendering",
    14: "`StoreOpDontCareThenLoadOpLoad` only covers render passes",
    15: "the best-practice checks do not cover dynamic rendering",
    16: "the layer has no check for sample shading",
}
"""Why the layer misses a mistake or its main point, by mistake number."""


class Mistake(NamedTuple):
    """A deliberate mistake in forward.c, with the `rule` that finds it."""

    number: int
    rule: str
    place: str
    text: str


class Finding(NamedTuple):
    """A finding, without command numbers, so that it is the same in every capture."""

    rule: str
    code: str
    subject: str


class Capture(NamedTuple):
    """The results for a capture: the layer's messages by vendor and id, the vendors whose replay
    crashed, and the findings with lines.
    """

    messages: dict[str, Counter[str]]
    crashed: list[str]
    findings: dict[Finding, list[int]]


class Usage(NamedTuple):
    """The cost of a command: wall-clock seconds, CPU seconds, and peak resident memory in MiB."""

    seconds: float
    processor: float
    memory: float


def mistakes() -> list[Mistake]:
    """The mistakes, from the comments in forward.c."""
    text = (EXAMPLE / "forward.c").read_text(encoding="utf-8")
    comments = re.findall(r"/\* Mistake (\d+), ([a-z-]+), (\w+): (.*?)\. \*/", text, re.DOTALL)
    return sorted(
        Mistake(int(number), rule, place, " ".join(words.split()))
        for number, rule, place, words in comments
    )


def capture_forward(folder: Path, *arguments: str) -> Path:
    """Captures a run of forward with arguments. A `.jsonl` is written beside the capture."""
    folder.mkdir()
    environment = {**os.environ, "TOOLS": "gfxreconstruct"}
    subprocess.run(
        [EXAMPLE / "capture.sh", folder, *arguments],
        env=environment,
        check=True,
        stdout=subprocess.DEVNULL,
    )
    return folder / "forward.gfxr"


def layer_environment(folder: Path, vendors: Iterable[str]) -> dict[str, str]:
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
    return {
        **lavapipe_environment(),
        "VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation",
        "VK_LAYER_SETTINGS_PATH": str(folder),
    }


def lavapipe_environment() -> dict[str, str]:
    """The environment of a replay on lavapipe."""
    driver = ":".join(map(str, sorted(DRIVERS.glob("lvp_icd*.json"))))
    return {**os.environ, "VK_DRIVER_FILES": driver, "VK_ICD_FILENAMES": driver}


def replay(capture: Path) -> list[str]:
    return ["gfxrecon-replay", "--log-level", "error", str(capture)]


def messages(capture: Path, vendor: str, command: Sequence[str] = ()) -> Counter[str] | None:
    """The ids of the layer's messages about multisampling, with counts. None if the replay, by
    `command` if stated, crashes.
    """
    log = capture.parent / "log.txt"
    log.unlink(missing_ok=True)
    environment = layer_environment(capture.parent, [vendor])
    process = subprocess.run(
        command or replay(capture),
        cwd=capture.parent,
        env=environment,
        capture_output=True,
        check=False,
    )
    if process.returncode:
        return None
    counts: Counter[str] = Counter()
    for id, text in re.findall(
        r"^([\w-]+)\((?:ERROR|WARN)[^)]*\): msgNum: (.*)$",
        log.read_text(encoding="utf-8"),
        re.MULTILINE,
    ):
        if bare(id) not in UNRELATED and not isinstance(classify(id, text), Noise):
            counts[id.removeprefix("UNASSIGNED-").removeprefix("BestPractices-")] += 1
    return counts


def lint(jsonl: Path) -> list[str]:
    return [
        sys.executable,
        "-m",
        "msaa_lint",
        "check",
        "--isolated",
        "--profile",
        PROFILE,
        "--output",
        "json",
        str(jsonl),
    ]


def findings(jsonl: Path) -> dict[Finding, list[int]]:
    """The findings for a tile-based device: the lines that describe the captured device are
    removed.
    """
    text = jsonl.read_text(encoding="utf-8")
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl", encoding="utf-8") as file:
        file.write(re.sub(r'^.*"name":"vkGetPhysicalDevice.*$', "", text, flags=re.MULTILINE))
        file.flush()
        process = subprocess.run(
            lint(Path(file.name)), cwd=ROOT, capture_output=True, text=True, check=False
        )
    if not process.stdout:
        raise SystemExit(f"{jsonl}: {process.stderr}")
    lines_by_finding: dict[Finding, list[int]] = {}
    for entry in json.loads(process.stdout)["findings"]:
        subject = re.sub(r"^commands\[\d+\]\.", "", entry["subject"])
        lines_by_finding.setdefault(Finding(entry["rule"], entry["code"], subject), []).append(
            entry["line"]
        )
    return lines_by_finding


def results(folder: Path, *arguments: str) -> Capture:
    """The layer's messages and the findings for forward run with arguments."""
    capture = capture_forward(folder, *arguments)
    counts = {vendor: messages(capture, vendor) for vendor in VENDORS}
    crashed = [VENDORS[vendor] for vendor, count in counts.items() if count is None]
    by_vendor = {vendor: count for vendor, count in counts.items() if count is not None}
    return Capture(by_vendor, crashed, findings(capture.with_suffix(".jsonl")))


def vendors_of(messages: Mapping[str, Counter[str]], id: str) -> tuple[str, int]:
    """The vendors whose checks report a message, and its count."""
    vendors = [vendor for vendor, found in messages.items() if id in found]
    count = max(messages[vendor][id] for vendor in vendors)
    return ("all" if "" in vendors else ", ".join(VENDORS[vendor] for vendor in vendors)), count


def measure(command: Sequence[str], folder: Path, environment: Mapping[str, str]) -> Usage:
    """Measures one run of a command."""
    start = time.perf_counter()
    process = subprocess.Popen(
        command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):
        raise SystemExit(f"{command[0]} exited with status {process.returncode}")
    return Usage(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(
        "| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines
    )


def link(finding: Finding) -> str:
    return f"[{finding.code}](../rules/{finding.rule}.md)"


def at(lines: Sequence[int]) -> str:
    return ", line " + " and ".join(map(str, lines)) if lines else ""


def rows(
    captures: Mapping[Mistake, Capture], shown: Mapping[Finding, Sequence[int]]
) -> Iterator[list[str]]:
    """A row for each mistake: the layer's messages and the findings if it is the only mistake."""
    for mistake, capture in captures.items():
        ids = sorted({id for counts in capture.messages.values() for id in counts})
        layer = [f"`{id}` ({', '.join(map(str, vendors_of(capture.messages, id)))}×)" for id in ids]
        if mistake.number in REASONS:
            layer.append(f"*{REASONS[mistake.number]}*")
        cells = [
            f"{link(finding)} {finding.rule}, `{finding.subject}`" + at(shown.get(finding, ()))
            for finding in sorted(
                capture.findings, key=lambda finding: (finding.rule != mistake.rule, finding)
            )
        ]
        yield [
            f"{mistake.number}",
            f"{mistake.place}: {mistake.text}",
            "<br>".join(layer) or "nothing",
            "<br>".join(cells) or "nothing",
        ]


def answers(together: Capture, captures: Mapping[Mistake, Capture]) -> Iterator[list[str]]:
    """A row for each message id in the capture with all mistakes: its count, and the corresponding
    mistakes and rules.
    """
    for id in sorted({id for counts in together.messages.values() for id in counts}, key=str.lower):
        causes = [
            mistake
            for mistake, capture in captures.items()
            if any(id in counts for counts in capture.messages.values())
        ]
        family = (
            classify("UNASSIGNED-BestPractices-" + id)
            if not id.startswith("VUID")
            else classify(id)
        )
        rules = family.rules if isinstance(family, Family) else ()
        links = dict.fromkeys(
            link(finding)
            for mistake in causes
            for finding in captures[mistake].findings
            if finding.rule in (*rules, mistake.rule)
        )
        who, count = vendors_of(together.messages, id)
        yield [
            f"`{id}`",
            who,
            str(count),
            ", ".join(str(mistake.number) for mistake in causes),
            ", ".join(links) or "none",
        ]


def times(folder: Path) -> Iterator[list[str]]:
    """The cost of replaying and linting a short and a long capture."""
    for frames in (4, 300):
        capture = capture_forward(folder / f"frames-{frames}", "--frames", str(frames))
        jsonl = capture.with_suffix(".jsonl")
        here = capture.parent
        commands: dict[str, tuple[list[str], dict[str, str]]] = {
            "gfxrecon-replay without the layer": (replay(capture), lavapipe_environment()),
            "gfxrecon-replay under the layer, best practices, all four vendors": (
                replay(capture),
                layer_environment(here, VENDORS),
            ),
            "gfxrecon-convert": (
                ["gfxrecon-convert", "--output", str(here / "again.jsonl"), str(capture)],
                lavapipe_environment(),
            ),
            "msaa-lint check": (lint(jsonl), {**os.environ, "PYTHONPATH": str(ROOT)}),
        }
        taken: dict[str, list[Usage]] = {name: [] for name in commands}
        for _ in range(3):  # interleaved, so that other load affects all of them
            for name, (command, environment) in commands.items():
                taken[name].append(measure(command, here, environment))
        for name, runs in taken.items():
            size = (jsonl if name.startswith("msaa-lint") else capture).stat().st_size / 1e6
            best = Usage(*map(min, zip(*runs, strict=True)))
            yield [
                f"{frames}",
                f"{size:.2f}",
                name,
                f"{best.seconds:.2f}",
                f"{best.processor:.2f}",
                f"{best.memory:.0f}",
            ]


def time_table(folder: Path) -> str:
    return table(("frames", "MB read", "", "seconds", "CPU seconds", "MiB"), times(folder))


def page(folder: Path) -> str:
    """The page, with new measurements."""
    together, fixed = results(folder / "together"), results(folder / "fixed", "--fixed")
    captures = {
        mistake: results(folder / f"mistake-{mistake.number}", "--mistake", str(mistake.number))
        for mistake in mistakes()
    }
    committed = findings(EXAMPLE / "forward.jsonl")
    unexplained = [
        m.number
        for m, capture in captures.items()
        if not any(capture.messages.values()) and m.number not in REASONS
    ]
    if unexplained:
        raise SystemExit(
            f"docs/replayed.py: the layer is silent about {unexplained}; add the reasons to REASONS"
        )
    missed = [
        str(m.number)
        for m, capture in captures.items()
        if m.rule not in {finding.rule for finding in capture.findings}
    ]
    silent = [
        str(m.number) for m, capture in captures.items() if not any(capture.messages.values())
    ]
    crashed = {who for capture in (together, fixed, *captures.values()) for who in capture.crashed}
    layer = json.loads(MANIFEST.read_text(encoding="utf-8"))["layer"]["api_version"]
    tool = subprocess.run(
        ["gfxrecon-replay", "--version"], capture_output=True, text=True, check=True
    ).stdout
    mesa = subprocess.run(
        ["dpkg-query", "-Wf${Version}", "mesa-vulkan-drivers"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    version = re.search(r"GFXReconstruct Version ([\d.]+)", tool)
    return TEMPLATE.format(
        count=len(captures),
        layer=layer,
        tool=version[1] if version else "?",
        mesa=mesa.partition("-")[0],
        profile=PROFILE,
        mistakes=table(
            ("", "mistake", "validation layer, replay", "msaa-lint check"),
            rows(captures, committed),
        ),
        fixed_messages=sum(sum(found.values()) for found in fixed.messages.values()) or "nothing",
        fixed_findings=len(fixed.findings) or "nothing",
        silent=", ".join(silent) or "none",
        missed=", ".join(missed) or "none",
        crashed=", ".join(sorted(crashed)) or "none",
        answers=table(
            ("message", "checks", "count", "mistakes", "rules"), answers(together, captures)
        ),
        findings=sum(map(len, together.findings.values())),
        programs=BEGIN + PAGE.read_text(encoding="utf-8").split(BEGIN)[1].split(END)[0] + END,
        times=time_table(folder),
    )


TEMPLATE = """\
# Captures and the validation layer

A capture can be checked without the original program by replaying it under the Khronos validation layer. This page compares the layer's
messages with the findings of `msaa-lint check` for the same capture. It is generated by `PYTHONPATH=. python docs/replayed.py` from the
program in [examples/capture](../examples/capture/README.md), which makes {count} deliberate mistakes: all of them together, none of them,
and each one alone.

gfxreconstruct {tool}; VK_LAYER_KHRONOS_validation {layer} with core checks and best practices, once without a vendor and once with each
of Arm, IMG, AMD and NVIDIA; lavapipe of Mesa {mesa}; four frames. Messages unrelated to multisampling are omitted
([noise](agreement.md#noise)). The findings are for `--profile {profile}`, with the lines that describe the device removed from the
captures, as in trimmed captures: lavapipe is not tile-based, so rules about tiles would be silent or notes. The layer's vendor-specific
checks do not depend on the device.

## Each mistake alone

Lines refer to [forward.jsonl](../examples/capture/forward.jsonl), which has all mistakes, if the finding also occurs there. An image
that is transient and stored has two findings, because the store conflicts with both rules.

{mistakes}

Without mistakes, the layer reports {fixed_messages}, and the rules report {fixed_findings}.

The layer does not report {silent}. The rules miss {missed}.

## All mistakes together

`msaa-lint check` reports {findings} findings. The layer reports:

{answers}

The layer's messages contain handles and attachment indices, and are repeated for every frame and every framebuffer. A finding contains the
debug name of the pass, pipeline or image, the call, the line, and the number of frames.

## Real programs

{programs}

## Limitations

Replays that crashed, by vendor: {crashed}. Version 1.3.239 of the layer crashes in Arm's blending check if a multisampled pipeline is
created without a render pass, for dynamic rendering. The program avoids this by creating that pipeline in the same call as a
single-sampled one, at which the check stops, so the layer does not check its blending. Captures of programs without this workaround cannot
be replayed with Arm's checks.

`vkBindImageMemory-non-lazy-transient-image` and `vkCreateFramebuffer-attachment-should-be-transient` are silent if the replaying device has
no lazily allocated memory, which is the case for all software drivers.

## Time and memory

Best of three interleaved runs of whole processes on two cores: wall-clock seconds, CPU seconds and peak resident memory. Replays also
render, on the CPU with lavapipe; the row without the layer shows the cost of that.

<!-- times -->
{times}
<!-- end of times -->

`gfxrecon-convert` runs once per capture. A replay requires a driver with the features and formats of the captured one; a check only
requires the file.
"""


def timed(text: str, folder: Path) -> str:
    """The page with a new table of times."""
    before, rest = text.split("<!-- times -->\n")
    after = rest.split("\n<!-- end of times -->")[1]
    return f"{before}<!-- times -->\n{time_table(folder)}\n<!-- end of times -->{after}"


def main() -> None:
    """Writes the page, or only its table of times."""
    with tempfile.TemporaryDirectory() as folder:
        text = (
            timed(PAGE.read_text(encoding="utf-8"), Path(folder))
            if "--times" in sys.argv
            else page(Path(folder))
        )
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
