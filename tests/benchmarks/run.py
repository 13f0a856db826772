"""Speed and memory of whole runs, measured and printed, never asserted: `python tests/benchmarks/run.py [--quick]`.

Every command is run in turn with the others (A B C, A B C, ...), so that a machine whose speed drifts slows all alike; the median of the wall
times counts, and the largest resident memory. yamllint and check-jsonschema are measured on the same file where they are installed.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]
SAMPLES = Path(os.environ.get("MSAA_LINT_SAMPLES", ROOT.parent / "shared" / "samples"))
FILE_BYTES = 1300


def description(size: int) -> str:
    """A description of a stored and resolved attachment of about that many bytes."""
    text = (ROOT / "examples" / "khronos-msaa" / "stored-and-resolved.msaa.yaml").read_text(encoding="utf-8")
    pipeline = "  p{}: {{renderPass: scene, subpass: 0, multisampleState: {{rasterizationSamples: 4, sampleShadingEnable: false}}}}\n"
    text += "pipelines:\n"
    number = 0
    while len(text) + len(pipeline) <= size:
        text += pipeline.format(number)
        number += 1
    return text


def pipeline_json() -> str:
    """A Vulkan SC pipeline of 36 kB, where the sample files are not at hand."""
    attachment = {"format": "VK_FORMAT_R8G8B8A8_UNORM", "samples": "VK_SAMPLE_COUNT_1_BIT", "loadOp": "VK_ATTACHMENT_LOAD_OP_CLEAR"}
    render_pass = {"sType": "VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO", "pAttachments": [attachment], "pSubpasses": [{"flags": "0"}]}
    features = {f"feature{n}": "VK_TRUE" for n in range(1000)}
    state = {"Renderpass": render_pass, "GraphicsPipeline": {"flags": "0"}, "PhysicalDeviceFeatures": {"features": features}}
    return json.dumps({"GraphicsPipelineState": state}, indent=4)


def once(command: list[str], folder: Path) -> tuple[float, float]:
    """Wall seconds, and peak resident MiB, of one run."""
    start = time.perf_counter()
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    child = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 1):
        raise SystemExit(f"{command[0]} ended with {child.returncode}: nothing was measured")
    return time.perf_counter() - start, usage.ru_maxrss / 1024


def main() -> None:
    """Measures, and prints a Markdown table."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    arguments.add_argument("--quick", action="store_true", help="three rounds in place of fifteen")
    rounds = 3 if arguments.parse_args().quick else 15
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        (folder / "one.msaa.yaml").write_text(description(FILE_BYTES), encoding="utf-8")
        many = folder / "many"
        many.mkdir()
        for number in range(1000):
            (many / f"f{number}.msaa.yaml").write_text(description(FILE_BYTES), encoding="utf-8")
        sc = SAMPLES / "vulkan_sc"
        if not sc.is_dir():
            sc = folder / "sc"
            sc.mkdir()
            for number in range(129):
                (sc / f"{number}.json").write_text(pipeline_json(), encoding="utf-8")
        check = [sys.executable, "-m", "msaa_lint", "check", "--isolated"]
        schema = subprocess.run([sys.executable, "-m", "msaa_lint", "schema"], capture_output=True, text=True, check=True, cwd=ROOT)
        (folder / "schema.json").write_text(schema.stdout, encoding="utf-8")
        commands: dict[str, list[str]] = {"msaa-lint check, one description of 1.3 KB": [*check, "one.msaa.yaml"]}
        scripts = Path(sys.executable).parent
        for name, extra in (("yamllint", ["one.msaa.yaml"]), ("check-jsonschema", ["--schemafile", "schema.json", "one.msaa.yaml"])):
            found = shutil.which(name, path=f"{scripts}{os.pathsep}{os.environ.get('PATH', '')}")
            if found is not None:
                commands[f"{name}, the same file"] = [found, *extra]
        commands["msaa-lint check, 129 Vulkan SC pipelines"] = [*check, str(sc)]
        commands["msaa-lint check, 1,000 descriptions of 1.3 KB"] = [*check, "many"]
        figures: dict[str, list[tuple[float, float]]] = {name: [] for name in commands}
        for _ in range(rounds + 1):
            for name, command in commands.items():
                figures[name].append(once(command, folder))
    print(f"| run (median of {rounds}, Python {sys.version.split()[0]}) | wall s | least | peak MiB |\n|---|---|---|---|")
    for name, runs in figures.items():
        walls = [wall for wall, _ in runs[1:]]
        print(f"| {name} | {statistics.median(walls):.3f} | {min(walls):.3f} | {max(memory for _, memory in runs[1:]):.0f} |")


if __name__ == "__main__":
    main()
