"""`msaa-lint init`: the first files of a project that adopts the linter."""

from __future__ import annotations

import os
import sys

from msaa_lint.core.package import VERSION
from msaa_lint.linter.rules.registry import EDITIONS

from .report.escape import visible

CONFIGURATION = f"""\
# msaa-lint's configuration. Every key may be left out; `msaa-lint rule --all` lists the rules.

# The default rules of this edition: a new release never turns a green job red by itself.
edition = "{EDITIONS[-1]}"

# The device, class of devices or vendor that descriptions without a `device:` are judged for.
# profile = "portable-tiler"

# Rules by name, code or the beginning of a code (MSAA2). `select` replaces the edition's rules, the others add and take away.
# select = ["ALL"]
# extend-select = ["MSAA706"]
# ignore = ["framebuffer-readback"]

# The severity from which on `msaa-lint check` exits with 1: note, warning or error.
fail-on = "warning"

# The confidence that findings need to do so: low, medium or high. Those of source code are low.
# fail-confidence = "medium"

# Pages with rules of your own, or folders of them.
# rules = ["ci/msaa-rules"]

# exclude = ["third_party/**"]
# baseline = "msaa-lint-baseline.json"

# [severity]
# multisampled-attachment-stored = "error"

# [per-file-ignores]
# "tests/**" = ["sample-count-above-four"]
"""

DESCRIPTION = """\
# A frame, or part of one, in Vulkan's own words. What you do not state stays unknown, and rules on it undecided.
# Completion and checking in an editor: msaa-lint schema > msaa-lint.schema.json, and this line:
# yaml-language-server: $schema=msaa-lint.schema.json
frame: {width: 1920, height: 1080, fps: 60}

images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  backbuffer: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT], presentable: true}

renderPasses:
  main:
    attachments:
      color: {image: color_ms, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      output: {image: backbuffer, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: PRESENT_SRC_KHR}
    subpasses:
      - {colorAttachments: [color], resolveAttachments: [output]}
"""

HOOK = f"""\
For pre-commit, in .pre-commit-config.yaml:

  - repo: https://github.com/msaa-lint/msaa-lint
    rev: v{VERSION}
    hooks:
      - id: msaa-lint

Now: msaa-lint check frame.msaa.yaml
"""


def init(folder: str) -> int:
    """Writes msaa-lint.toml and frame.msaa.yaml where they are not there yet; 2 where that cannot be."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        print(f"msaa-lint: {visible(folder)} cannot be made: {error.strerror}", file=sys.stderr)
        return 2
    for name, text in (("msaa-lint.toml", CONFIGURATION), ("frame.msaa.yaml", DESCRIPTION)):
        path = os.path.join(folder, name)
        try:
            with open(path, "x", encoding="utf-8", newline="\n") as file:
                file.write(text)
            print(f"wrote {visible(path)}", file=sys.stderr)
        except FileExistsError:
            print(f"{visible(path)} is there already: left as it is", file=sys.stderr)
        except OSError as error:
            print(f"msaa-lint: {visible(path)} cannot be written: {error.strerror}", file=sys.stderr)
            return 2
    print(HOOK, end="")
    return 0
