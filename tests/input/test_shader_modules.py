"""What the inputs of a run share of shader modules: analyses, but not the work that they may
take.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.frame.spirv.module import Module
from msaa_lint.input import shader_modules
from tests.command import run
from tests.frame.spirv.generate import SHADERS

CODE = (SHADERS / "no_alpha.frag.spv").read_bytes()
STATE = "multisampleState: {{rasterizationSamples: 4, alphaToCoverageEnable: true}}"
PIPELINE = "  p{0}: {{stages: [{{stage: FRAGMENT, module: a.spv{1}}}], " + STATE + "}}\n"

Analysis = tuple[dict[int, float | bool], bool]
"""The constants of an analysis, and whether what is written to alpha was asked for; trials of fixes
do not ask.
"""


def description(count: int, constant: str = "") -> str:
    return "pipelines:\n" + "".join(
        PIPELINE.format(number, constant.format(number)) for number in range(count)
    )


def reported(
    folder: Path, files: Mapping[str, str], *arguments: str
) -> tuple[list[tuple[str, str]], int]:
    (folder / "a.spv").write_bytes(CODE)
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    done = run(folder, "check", "--isolated", "--output", "json", *arguments, ".")
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return [
        (f"{each['file']}:{each['line']}:{each['column']}", each["severity"])
        for each in found
        if each["code"] == "MSAA906"
    ], done.returncode


@pytest.fixture
def analyses(monkeypatch: pytest.MonkeyPatch) -> list[Analysis]:
    seen: list[Analysis] = []
    reflected = shader_modules.reflected

    def counted(
        module: Module, name: str | None, constants: Mapping[int, float | bool], alpha: bool
    ) -> object:
        seen.append((dict(constants), alpha))
        return reflected(module, name, constants, alpha)

    monkeypatch.setattr(shader_modules, "reflected", counted)
    return seen


def test_a_module_is_analyzed_once_in_a_run(tmp_path: Path, analyses: list[Analysis]) -> None:
    """For the pipelines, documents and files that name it; once more for each specialization."""
    stream = "---\n".join([description(5)] * 3)
    reported(
        tmp_path,
        {
            "a.msaa.yaml": stream,
            "b.msaa.yaml": description(5),
            "c.msaa.yaml": description(3, ", specialization: {{0: {}}}"),
        },
    )
    assert [constants for constants, alpha in analyses if alpha] == [{}, {0: 0}, {0: 1}, {0: 2}]
    assert all(analyses.count(each) == 1 for each in analyses)


def test_the_budget_is_that_of_an_input(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, analyses: list[Analysis]
) -> None:
    """Each document says that its modules were not analyzed. What was analyzed for an input before
    counts as if it had not been.
    """
    monkeypatch.setattr(shader_modules, "ANALYSES", 0)
    monkeypatch.setattr(shader_modules, "MAX_WORK", 4 * (len(CODE) // 4 + shader_modules.ANALYSIS))
    two = [description(1), description(1, ", specialization: {{0: 7}}")]
    files = {
        "a.msaa.yaml": "---\n".join(two),
        "b.msaa.yaml": "---\n".join([*two, description(1, ", specialization: {{0: 8}}")]),
        "c.msaa.yaml": "---\n".join([*two, description(1, ", specialization: {{0: 9}}"), *two]),
    }
    found, code = reported(tmp_path, files)
    assert found == [("b.msaa.yaml:8:43", "warning"), ("c.msaa.yaml:8:43", "warning")]
    assert ([constants for constants, alpha in analyses if alpha], code) == ([{}, {0: 7}], 1)
    for name, text in files.items():
        (tmp_path / name[0]).mkdir()
        alone, _ = reported(tmp_path / name[0], {name: text})
        assert alone == [each for each in found if each[0].startswith(name)]


def test_a_shader_that_takes_too_many_steps_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("msaa_lint.frame.spirv.state.MAX_STEPS", 0)
    found, _ = reported(tmp_path, {"a.msaa.yaml": description(2)})
    assert found == [("a.msaa.yaml:2:43", "note")]
