"""Looks for known vulnerabilities in the dependencies of all extras, at the lowest and the highest
versions that `pyproject.toml` allows.

    pip install uv pip-audit
    python tests/audit.py

Versions of what the dependencies depend on are the newest, which is what pip installs. Exits with 1
for a vulnerability, and with 2 if a package could not be audited.
"""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
RESOLUTIONS = ("lowest-direct", "highest")
PYTHONS = ("3.11", "3.13")


def requirements(resolution: str, python: str) -> str:
    """The versions of all dependencies, as a requirements file."""
    options = (
        "--resolution",
        resolution,
        "--python-version",
        python,
        "--all-extras",
        "--no-header",
        "--no-annotate",
        "--quiet",
    )
    command = ("uv", "pip", "compile", *options, "pyproject.toml")
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def audited(pinned: str) -> list[dict[str, Any]]:
    """What pip-audit reports of each package of a requirements file."""
    command = (
        "pip-audit",
        "--requirement",
        "/dev/stdin",
        "--no-deps",
        "--disable-pip",
        "--format",
        "json",
        "--progress-spinner",
        "off",
    )
    done = subprocess.run(command, input=pinned, check=False, capture_output=True, text=True)
    try:
        dependencies: list[dict[str, Any]] = json.loads(done.stdout)["dependencies"]
    except (ValueError, LookupError):
        print(f"tests/audit.py: pip-audit failed: {done.stderr.strip()}", file=sys.stderr)
        sys.exit(2)
    return dependencies


def main() -> int:
    """Prints a line for each vulnerability and for each package without an answer."""
    reports: dict[str, int] = {}
    count = 0
    for pinned in dict.fromkeys(
        requirements(resolution, python) for resolution in RESOLUTIONS for python in PYTHONS
    ):
        for package in audited(pinned):
            count += 1
            if "skip_reason" in package:
                reports[f"{package['name']}: not audited: {package['skip_reason']}"] = 2
            for found in package.get("vulns", ()):
                fixed = ", ".join(found["fix_versions"]) or "no version"
                reports[
                    f"{package['name']} {package['version']}: {found['id']}, fixed in {fixed}"
                ] = 1
    print(*reports, f"{count} versions of packages, {len(reports)} problems", sep="\n")
    return max(reports.values(), default=0)


if __name__ == "__main__":
    sys.exit(main())
