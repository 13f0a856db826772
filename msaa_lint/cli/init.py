# ruff: noqa: E501 - the template is written as it is
"""`msaa-lint init`: writes the first files of a project that adopts the linter."""

from __future__ import annotations

import json
import os
import shlex

from msaa_lint.core.atomic_write import write_file
from msaa_lint.linter.rules.rule import EDITIONS
from msaa_lint.linter.settings.config import read_folder

from .common import note, run_command, warn
from .options import Arguments
from .report.escape import escape
from .schema import description_schema

CONFIGURATION = f"""\
# Configuration of msaa-lint. All keys are optional; `msaa-lint rule --all` lists the rules.

# Use the default rules of this edition: a new release of msaa-lint then adds no findings.
edition = "{EDITIONS[-1]}"

# The device, device class, or vendor to assume for inputs that name no device.
# profile = "portable-tiler"

# Rules by name, code, or code prefix (MSAA2). `select` replaces the edition's rules; the others add and remove rules.
# select = ["ALL"]
# extend-select = ["MSAA706"]
# ignore = ["framebuffer-readback"]

# The lowest severity that makes `msaa-lint check` exit with 1: note, warning, or error.
fail-on = "warning"

# The lowest confidence that does: low, medium, or high. Findings in source code that rest on assumptions have low confidence.
# fail-confidence = "medium"

# Whether an input that creates multisampled images but shows no pass to check makes the exit code 2.
# strict-inputs = true

# What source code does not state: the values of variables, members, functions, and macros.
# source.assume = {{"settings.samples" = 4, ENGINE_MSAA = true}}

# Pages with custom rules, or folders of pages.
# rules = ["ci/msaa-rules"]

# Where the documentation is, if it is published elsewhere: reports link to its pages of rules.
# docs-url = "https://example.com/msaa-lint"

# exclude = ["third_party/**"]
# baseline = "msaa-lint-baseline.json"

# [severity]
# multisampled-attachment-stored = "error"

# [per-file-ignores]
# "tests/**" = ["sample-count-above-four"]
"""

SCHEMA = "msaa-lint.schema.json"

DESCRIPTION = f"""\
# yaml-language-server: $schema={SCHEMA}
# A frame, or part of one, in Vulkan's terms. What you leave out is unknown, and rules that need it are undecided.
# This frame has one mistake on purpose, for a first finding: replace it with yours.
frame: {{width: 1920, height: 1080, fps: 60}}

images:
  color_ms:
    format: R8G8B8A8_UNORM
    samples: 4
    usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]
    memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]
  backbuffer:
    format: R8G8B8A8_UNORM
    samples: 1
    usage: [COLOR_ATTACHMENT]
    presentable: true

renderPasses:
  main:
    attachments:
      color:
        image: color_ms
        loadOp: CLEAR
        storeOp: STORE
        initialLayout: UNDEFINED
        finalLayout: COLOR_ATTACHMENT_OPTIMAL
      output:
        image: backbuffer
        loadOp: DONT_CARE
        storeOp: STORE
        initialLayout: UNDEFINED
        finalLayout: PRESENT_SRC_KHR
    subpasses:
      - colorAttachments: [color]
        resolveAttachments: [output]
"""

HOOK = r"""To use pre-commit, add this to the `repos` of .pre-commit-config.yaml:

  - repo: local
    hooks:
      - id: msaa-lint
        name: msaa-lint
        language: system
        entry: msaa-lint check
        files: \.msaa\.(ya?ml|json)$
        require_serial: true
"""


def init(arguments: Arguments) -> int:
    """Writes the first files to the folder that the arguments name; returns the exit code."""
    return run_command(_init, arguments)


def _init(arguments: Arguments) -> int:
    return write_files((arguments["paths"] or [os.curdir])[0], not arguments.get("quiet"))


def write_files(folder: str, hints: bool) -> int:
    """Writes msaa-lint.toml, frame.msaa.yaml, and the schema that it names, except those that
    exist; prints `hints` on what to do next.

    Returns 2 if it cannot.
    """
    files = {
        "msaa-lint.toml": CONFIGURATION,
        "frame.msaa.yaml": DESCRIPTION,
        SCHEMA: json.dumps(description_schema(), indent=2) + "\n",
    }
    written = set()
    path = folder
    try:
        os.makedirs(folder, exist_ok=True)
        configuration = read_folder(folder)
        if (
            configuration
            and configuration.path
            and os.path.basename(configuration.path) == "pyproject.toml"
        ):
            # msaa-lint.toml would take its place.
            note(
                f"{os.path.normpath(configuration.path)} configures msaa-lint: wrote no "
                "msaa-lint.toml"
            )
            del files["msaa-lint.toml"]
        for name, text in files.items():
            path = os.path.normpath(os.path.join(folder, name))
            if os.path.lexists(path):
                note(f"{path} already exists: left unchanged")
                continue
            write_file(path, text.encode(), lambda _: False)
            written.add(name)
            note(f"wrote {path}")
    except OSError as error:
        warn(f"cannot write {path}: {error.strerror or error}")
        return 2
    if not hints:
        return 0
    if "frame.msaa.yaml" in written:
        frame = shlex.quote(os.path.normpath(os.path.join(folder, "frame.msaa.yaml")))
        print(
            f"The frame in {escape(frame)} has a mistake on purpose. To see it:\n\n  msaa-lint "
            f"check {escape(frame)}\n"
        )
    print(HOOK, end="")
    return 0
