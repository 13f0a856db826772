"""Time and memory of `check` on a large source tree: `python tests/benchmarks/projects.py [MB]
[--keep FOLDER]`.

The tree is an engine of 100 MB by default: libraries of several folders with headers, of which one
in twenty uses Vulkan, and a program for each library. It is checked three times: without anything
kept, again, and after a change of one file. Prints a table in Markdown.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).parents[2]

FILES_PER_FOLDER = 12
FILE_BYTES = 14_000
VULKAN_SHARE = 20

HEADER = """\
#pragma once
#include "common.h"
class Renderer{n} {{
public:
    void create();
private:
    VkRenderPass pass;
    VkSampleCountFlagBits samples = SAMPLES;
}};
"""
SOURCE = """\
#include "renderer{n}.h"
void Renderer{n}::create() {{
    VkAttachmentDescription attachments[2] = {{}};
    attachments[0].samples = samples;
    attachments[0].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachments[0].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].samples = VK_SAMPLE_COUNT_1_BIT;
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkAttachmentReference color = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkAttachmentReference resolve = {{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    VkSubpassDescription subpass = {{}};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    subpass.pResolveAttachments = &resolve;
    VkRenderPassCreateInfo info = {{VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO}};
    info.attachmentCount = 2;
    info.pAttachments = attachments;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    vkCreateRenderPass(device, &info, nullptr, &pass);
}}
"""
OTHER = """\
float Component{n}::update_{k}(float dt, const std::vector<Entity>& entities) {{
    float total = 0.0f;
    for (const Entity& entity : entities) {{
        if (entity.kind == Kind{k} && entity.weight > {k}.5f)
            total += entity.weight * dt;
    }}
    return total;
}}
"""


def other(number: int, size: int) -> str:
    """A file that has nothing to do with Vulkan."""
    text = f'#include "common.h"\n#include "component{number}.h"\n'
    part = "".join(OTHER.format(n=number, k=k) for k in range(40))
    return text + part * max(1, (size - len(text)) // len(part))


def write_tree(folder: Path, size: int) -> None:
    """Writes a tree of about `size` bytes."""
    (folder / ".git").mkdir(parents=True)
    written = number = 0
    while written < size:
        library = folder / f"engine{number // 40}" / f"library{number}"
        library.mkdir(parents=True)
        files = {
            "common.h": "#pragma once\n#include <vulkan/vulkan.h>\nconstexpr VkSampleCountFlagBits "
            "SAMPLES = VK_SAMPLE_COUNT_4_BIT;\n"
        }
        for position in range(FILES_PER_FOLDER):
            at = number * FILES_PER_FOLDER + position
            if at % VULKAN_SHARE == 0:
                files[f"renderer{at}.h"] = HEADER.format(n=at)
                files[f"renderer{at}.cpp"] = SOURCE.format(n=at) + other(at, FILE_BYTES)
            else:
                files[f"component{at}.cpp"] = other(at, FILE_BYTES)
        files["main.cpp"] = '#include "common.h"\nint main() { return run(); }\n'
        for name, text in files.items():
            (library / name).write_text(text, encoding="utf-8")
            written += len(text)
        number += 1


def measure(folder: Path, kept: Path) -> tuple[float, float, float, int]:
    """The seconds that a run takes, its CPU seconds, the most memory of one process in MB, and the
    number of findings.
    """
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "XDG_CACHE_HOME": str(kept)}
    command = [sys.executable, "-m", "msaa_lint", "check", ".", "--isolated", "--output", "json"]
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    seconds = time.perf_counter() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    assert done.returncode in (0, 1), done.stderr[-2000:]
    return seconds, cpu, after.ru_maxrss / 1000, len(json.loads(done.stdout)["findings"])


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n\n")[0])
    parser.add_argument("megabytes", nargs="?", type=int, default=100)
    parser.add_argument(
        "--keep", metavar="FOLDER", help="write the tree to this folder, and leave it there"
    )
    given = parser.parse_args()
    base = Path(tempfile.mkdtemp())
    folder = Path(given.keep) if given.keep else base / "tree"
    try:
        if not folder.exists():
            write_tree(folder, given.megabytes * 1_000_000)
        print("| run | s | CPU s | MB | findings |\n|---|---|---|---|---|")
        print("| first | {:.1f} | {:.1f} | {:.0f} | {} |".format(*measure(folder, base / "kept")))
        print("| second | {:.1f} | {:.1f} | {:.0f} | {} |".format(*measure(folder, base / "kept")))
        changed = next(iter(sorted(folder.rglob("renderer*.cpp"))))
        changed.write_text(changed.read_text(encoding="utf-8") + "\n", encoding="utf-8")
        print(
            "| one file changed | {:.1f} | {:.1f} | {:.0f} | {} |".format(
                *measure(folder, base / "kept")
            )
        )
    finally:
        shutil.rmtree(base)
    return 0


if __name__ == "__main__":
    sys.exit(main())
