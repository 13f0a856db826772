"""What travels to the processes that lint: settings, rule pages, and device reports, so that only
inputs are read there.
"""

from __future__ import annotations

import pickle
import shutil
from pathlib import Path

import pytest

from msaa_lint.core.execution.backend import Unusable
from msaa_lint.linter.input_runs import InputRuns, Numbered, Task
from msaa_lint.linter.job import Job, TravelledJob
from msaa_lint.linter.part_linter import Contents, PartLinter
from msaa_lint.linter.request import Request
from msaa_lint.linter.workspace import Workspace
from tests.descriptions import STORED

RULE = """\
---
code: {0}
severity: warning
subject: image
when: image.samples == 4
message: "{{image.name}} has 4 samples"
---

# {1}

Samples cost memory.
"""


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A configuration that extends another and names a folder of rule pages, and a page that the
    command line names.
    """
    folder = tmp_path / "project"
    (folder / "settings" / "pages").mkdir(parents=True)
    (folder / "frame.msaa.yaml").write_text(STORED)
    (folder / "msaa-lint.toml").write_text('extends = "settings/base.toml"\nignore = ["MSAA403"]\n')
    (folder / "settings" / "base.toml").write_text('rules = ["pages"]\n')
    (folder / "settings" / "pages" / "team-rule.md").write_text(RULE.format("TEAM1", "team-rule"))
    (folder / "own-rule.md").write_text(RULE.format("OWN1", "own-rule"))
    monkeypatch.chdir(folder)
    return folder


def job() -> Job[object]:
    workspace = Workspace(Request(["."], {"rules": ["own-rule.md"]}))
    workspace.resolve("frame.msaa.yaml")
    return Job(InputRuns(PartLinter(workspace, Contents(prices=True)), ["frame.msaa.yaml"]))


def codes(job: Job[object] | TravelledJob, configuration: str | None) -> list[str]:
    (part,) = job(Task([Numbered(0, "frame.msaa.yaml")], configuration))
    assert part.problems == []  # type: ignore[attr-defined]
    return [found.code for found in part.findings]  # type: ignore[attr-defined]


def test_only_inputs_are_read_where_a_job_travels_to(project: Path) -> None:
    here, configuration = job(), str(project / "msaa-lint.toml")
    expected = codes(here, configuration)
    assert (
        "TEAM1" in expected
        and "OWN1" in expected
        and "MSAA201" in expected
        and "MSAA403" not in expected
    )
    data = pickle.dumps(here)
    for path in (project / "msaa-lint.toml", project / "own-rule.md"):
        path.unlink()
    shutil.rmtree(project / "settings")
    there = pickle.loads(data)
    assert isinstance(there, TravelledJob)
    assert codes(there, configuration) == codes(there, configuration) == expected
    # It travels on, as clusters let it.
    assert codes(pickle.loads(pickle.dumps(there)), configuration) == expected


def test_a_machine_without_the_folder_says_so(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    there = pickle.loads(pickle.dumps(job()))
    monkeypatch.chdir("/")
    shutil.rmtree(project)
    with pytest.raises(
        Unusable,
        match=f"has no folder {project}: inputs must have the same paths on all machines, or be "
        "URLs",
    ):
        codes(there, str(project / "msaa-lint.toml"))
