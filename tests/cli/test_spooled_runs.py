"""Many inputs: what a run found leaves memory. The output is the same bytes as that of a run that
has it in memory.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from msaa_lint.cli.options import COST_FORMATS
from msaa_lint.core import spool
from msaa_lint.linter.settings.settings import OUTPUT_FORMATS
from tests.command import run
from tests.descriptions import CLEAN, STORED

BROKEN = "images: {color: {samples: 3}}\n"
HEADER = """\
static inline void create(VkDevice device, VkImage* image) {
    VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO, .imageType = VK_IMAGE_TYPE_2D, .samples = VK_SAMPLE_COUNT_4_BIT,
        .format = VK_FORMAT_R8G8B8A8_UNORM, .extent = {64, 64, 1}, .mipLevels = 2, .arrayLayers = 1, .tiling = VK_IMAGE_TILING_LINEAR,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
    vkCreateImage(device, &info, NULL, image);
}
"""


@pytest.fixture
def corpus(tmp_path: Path) -> Path:
    """Descriptions under two configurations, one of which names a broken rule page that is also an
    input, programs with a common header, broken inputs, and one that cannot be read.
    """
    folder = tmp_path / "corpus"
    for name in ("first", "second"):
        (folder / name).mkdir(parents=True)
        for number in range(10):
            text = (CLEAN, STORED, "# msaa-lint: ignore-file[MSAA201] here\n" + STORED, BROKEN)[
                number % 4
            ]
            (folder / name / f"{number}.msaa.yaml").write_text(text)
    (folder / "image.h").write_text(HEADER)
    for name in ("first", "last"):
        text = (
            f'#include "image.h"\nvoid {name}(VkDevice device, VkImage* image) {{ '
            f"create(device, image); }}\n"
        )
        (folder / f"{name}.c").write_text(text)
    (folder / "second" / "unreadable.msaa.yaml").write_bytes(b"images: \xff\n")
    (folder / "second" / "msaa-lint.toml").write_text('rules = ["pages"]\nignore = ["MSAA403"]\n')
    (folder / "second" / "pages").mkdir()
    (folder / "second" / "pages" / "team.md").write_text(
        f"---\ncode: TEAM1\n---\n\n```c\n{HEADER}```\n"
    )
    return folder


@pytest.fixture
def spooled(monkeypatch: pytest.MonkeyPatch) -> Iterator[pytest.MonkeyPatch]:
    """A run has two values in memory, and writes the others."""
    written = []
    create = spool.Spool.table
    with monkeypatch.context() as patch:
        patch.setattr(
            spool.Spool,
            "table",
            lambda self, columns: written.append(columns) or create(self, columns),
        )
        patch.setattr(spool, "MAX_VALUES", 2)
        patch.setattr(spool, "MAX_UNWRITTEN", 1)
        patch.setattr(spool, "MAX_READ", 1)
        yield patch
    assert written


PATHS = (".", "first.c", "last.c", "second/pages/team.md")

OPTIONS = {
    **{output: ("--output", output) for output in OUTPUT_FORMATS},
    "all": ("--output", "full", "--statistics", "--show-suppressed", "--explain-undecided"),
    "price": ("--output", "json", "--sort", "price"),
    "baseline": ("--output", "json", "--baseline", "baseline.json"),
    "limit": ("--fail-on-cost", "1mW"),
    "severity": ("--min-severity", "warning"),
    "diff": ("--diff",),
    "jobs": ("--output", "json", "--jobs", "2"),
}


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_the_output_is_the_same(
    corpus: Path, options: tuple[str, ...], spooled: pytest.MonkeyPatch
) -> None:
    run(corpus, "baseline", "first/1.msaa.yaml", "first/2.msaa.yaml", "--file", "baseline.json")
    found = run(corpus, "check", *PATHS, "--no-cache", *options)
    spooled.undo()
    expected = run(corpus, "check", *PATHS, "--no-cache", *options)
    assert (found.returncode, found.stdout, found.stderr) == (
        expected.returncode,
        expected.stdout,
        expected.stderr,
    )
    assert len(expected.stdout) > 100


@pytest.mark.parametrize("output", COST_FORMATS)
def test_costs_are_the_same(corpus: Path, output: str, spooled: pytest.MonkeyPatch) -> None:
    found = run(corpus, "cost", ".", "--output", output)
    spooled.undo()
    expected = run(corpus, "cost", ".", "--output", output)
    assert (found.returncode, found.stdout, found.stderr) == (
        expected.returncode,
        expected.stdout,
        expected.stderr,
    )
    assert len(expected.stdout) > 100
