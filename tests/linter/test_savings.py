"""What a summary says that fixes save is what they save: the cost before them minus the cost after
them.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint import lint
from msaa_lint.core.finding import Price, Savings
from msaa_lint.linter.results import MAX_TRIED
from tests.command import run
from tests.pages import all_examples
from tests.paths import ROOT
from tests.strength import examples

BYTE = 1e-6
"""A MB has 10^6 bytes."""

EXAMPLES = [
    path
    for path in sorted((ROOT / "examples").rglob("*"))
    if path.name.endswith((".msaa.yaml", ".jsonl", ".xml"))
]

FORMATS = {
    "color": ["R8G8B8A8_UNORM", "R16G16B16A16_SFLOAT"],
    "depth": ["D32_SFLOAT", "D24_UNORM_S8_UINT"],
}
OPS = {"loadOp": ["CLEAR", "LOAD", "DONT_CARE"], "storeOp": ["STORE", "DONT_CARE"]}
STENCIL_OPS = {
    "stencilLoadOp": ["CLEAR", "LOAD", "DONT_CARE"],
    "stencilStoreOp": ["STORE", "DONT_CARE"],
}


@st.composite
def frames(draw: st.DrawFn) -> str:
    """Frames with mistakes that have a price: passes that share images, resolves inside and outside
    of passes, readers.
    """
    device = draw(st.sampled_from(["mali-g76", "nvidia", None]))
    images: dict[str, Any] = {}
    for name in ("color_a", "color_b", "depth"):
        usage = ["DEPTH_STENCIL_ATTACHMENT" if name == "depth" else "COLOR_ATTACHMENT"]
        usage += draw(
            st.sampled_from([[], ["TRANSIENT_ATTACHMENT"], ["SAMPLED"], ["TRANSFER_SRC"]])
        )
        image = {
            "format": draw(st.sampled_from(FORMATS["depth" if name == "depth" else "color"])),
            "samples": 4,
            "usage": usage,
        }
        if draw(st.booleans()):
            image["memory"] = draw(
                st.sampled_from([["DEVICE_LOCAL"], ["DEVICE_LOCAL", "LAZILY_ALLOCATED"]])
            )
        images[name] = image
    for name in ("color_a", "color_b"):
        images[f"{name}_1x"] = {
            "format": images[name]["format"],
            "samples": 1,
            "usage": ["COLOR_ATTACHMENT", "TRANSFER_DST", "SAMPLED"],
        }
    passes: dict[str, Any] = {}
    for number in range(draw(st.integers(1, 3))):
        color = draw(st.sampled_from(["color_a", "color_b"]))
        attachments = {
            "color": {
                "image": color,
                **{member: draw(st.sampled_from(values)) for member, values in OPS.items()},
            },
            "depth": {
                "image": "depth",
                **{m: draw(st.sampled_from(v)) for m, v in (OPS | STENCIL_OPS).items()},
            },
        }
        subpass: dict[str, Any] = {"colorAttachments": ["color"], "depthStencilAttachment": "depth"}
        if draw(st.booleans()):
            attachments["output"] = {
                "image": f"{color}_1x",
                **{m: draw(st.sampled_from(v)) for m, v in OPS.items()},
            }
            subpass["resolveAttachments"] = ["output"]
        passes[f"pass{number}"] = {"attachments": attachments, "subpasses": [subpass]}
    description: dict[str, Any] = {
        "frame": {"width": 640, "height": 480, "fps": 30},
        "images": images,
        "renderPasses": passes,
    }
    if device is not None:
        description["device"] = device
    if draw(st.booleans()):
        commands: list[Any] = []
        for name, each in passes.items():
            commands += [{"beginRenderPass": {"renderPass": name}}, "endRenderPass"]
            color = each["attachments"]["color"]["image"]
            commands += draw(
                st.sampled_from(
                    [
                        [],
                        [{"resolveImage": {"srcImage": color, "dstImage": f"{color}_1x"}}],
                        [{"readImage": {"image": "depth", "samples": 1}}],
                        [{"readImage": {"image": f"{color}_1x"}}],
                    ]
                )
            )
        description["commands"] = commands
    return json.dumps(description)


def costs(folder: Path) -> dict[str, list[float]]:
    """The cost of each file of a folder: MB/s read, MB/s written, MiB, mW."""
    totals: dict[str, list[float]] = {}
    for frame in json.loads(run(folder, "cost", "--isolated", "--output", "json", ".").stdout)[
        "frames"
    ]:
        total = frame["total"]
        figures = [total[name] for name in Price._fields]
        before = totals.setdefault(Path(frame["file"]).name, [0.0] * len(figures))
        totals[Path(frame["file"]).name] = [a + b for a, b in zip(before, figures, strict=True)]
    return totals


def assert_saved(
    before: Mapping[str, Sequence[float]],
    after: Mapping[str, Sequence[float]],
    prices: Mapping[str, Price | None],
) -> None:
    for name, figures in before.items():
        saved = [a - b for a, b in zip(figures, after[name], strict=True)]
        assert saved == pytest.approx(list(prices.get(name) or [0.0] * 4), abs=2 * BYTE), name


def assert_law(folder: Path, texts: Mapping[str, str]) -> dict[str, Savings]:
    """Checks the law on texts by file name; returns what is saved of each file."""
    for name, text in texts.items():
        (folder / name).write_text(text)
    savings = {
        Path(file).name: entry
        for file, entry in lint(folder.as_posix(), isolated=True).savings.items()
    }
    before = costs(folder)
    for options in (["--fix"], ["--fix", "--unsafe-fixes"]):
        for name, text in texts.items():
            (folder / name).write_text(text)
        run(folder, "check", "--isolated", *options, ".")
        entries = {
            name: entry.all if "--unsafe-fixes" in options else entry.safe
            for name, entry in savings.items()
        }
        assert_saved(before, costs(folder), {name: entry.price for name, entry in entries.items()})
    return savings


def test_law_on_rule_pages(tmp_path: Path) -> None:
    texts = {}
    for number, example in enumerate(all_examples()):
        if example.language == "yaml":
            sized = "\nframe:" in f"\n{example.text}" or "\n---" in example.text
            text = (
                example.text
                if sized
                else f"frame: {{width: 1920, height: 1080, fps: 60}}\n{example.text}"
            )
            texts[f"{number}.msaa.yaml"] = text
    savings = assert_law(tmp_path, texts)
    assert (
        sum(entry.all.price is not None and any(entry.all.price) for entry in savings.values()) > 70
    )


def test_law_on_examples(tmp_path: Path) -> None:
    texts = {
        f"{path.parent.name}-{path.name}": path.read_text()
        for path in EXAMPLES
        if path.name.endswith(".yaml")
    }
    savings = assert_law(tmp_path, texts)
    assert (
        sum(entry.safe.price is not None and any(entry.safe.price) for entry in savings.values())
        >= 3
    )


@examples(0.1)
@given(frames=st.lists(frames(), min_size=8, max_size=8))
def test_law_on_generated_frames(
    frames: list[str], tmp_path_factory: pytest.TempPathFactory
) -> None:
    assert_law(
        tmp_path_factory.mktemp("frames"),
        {f"{number}.msaa.json": text for number, text in enumerate(frames)},
    )


@pytest.mark.parametrize(
    "name", ["capture/forward.jsonl", "capture/forward.xml", "code/forward.cpp"]
)
def test_law_on_what_is_converted(name: str, tmp_path: Path) -> None:
    """Captures and source code are not edited: the figures are those of the description that
    `convert` writes.
    """
    source = ROOT / "examples" / name
    (savings,) = lint(source.as_posix(), isolated=True).savings.values()
    assert savings.converted
    target = tmp_path / "frame.msaa.yaml"
    for options, saving in ((["--fix"], savings.safe), (["--fix", "--unsafe-fixes"], savings.all)):
        run(tmp_path, "convert", source.as_posix(), "--force", "-o", target.name)
        before = costs(tmp_path)
        run(tmp_path, "check", "--isolated", *options, target.name)
        assert_saved(before, costs(tmp_path), {target.name: saving.price})


KIND = """
frame: {{width: 1000, height: 1000, share: {share}}}
images: {{ms: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}}, out: {{format: R8G8B8A8_UNORM, samples: 1}}}}
renderPasses:
  main:
    attachments: {{color: {{image: ms, loadOp: CLEAR, storeOp: STORE}}, out: {{image: out, loadOp: DONT_CARE, storeOp: STORE}}}}
    subpasses: [{{colorAttachments: [color], resolveAttachments: [out]}}]
"""


def test_kinds_of_frame_are_weighted_by_how_often_they_occur(tmp_path: Path) -> None:
    """4 + 16 MB are stored per frame; the two kinds are all of the frames, and their images are the
    same.
    """
    (tmp_path / "frame.msaa.yaml").write_text(
        "---".join(KIND.format(share=share) for share in (0.75, 0.25))
    )

    def total(*options: str) -> dict[str, Any]:
        done = run(tmp_path, "cost", "--isolated", "--output", "json", "frame.msaa.yaml", *options)
        return dict(json.loads(done.stdout)["total"])

    assert total()["write_mb_per_s"] == pytest.approx(20 * 60)
    assert total("--fps", "30")["write_mb_per_s"] == pytest.approx(20 * 30)
    assert total()["memory_mib"] == pytest.approx(20e6 / 2**20)
    (savings,) = lint((tmp_path / "frame.msaa.yaml").as_posix(), isolated=True).savings.values()
    assert savings.all.price is not None
    assert savings.all.price.write_mb_per_s == pytest.approx(16 * 60)


@pytest.mark.parametrize("share", ["0", "1.5", "-0.1", "25", "true", "half"])
def test_a_share_is_a_fraction(share: str, tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(KIND.format(share=share))
    done = run(tmp_path, "check", "--isolated", "--output", "concise", "frame.msaa.yaml")
    assert done.returncode == 2 and "`share` must be " in done.stdout, done.stdout


@pytest.mark.parametrize(("limit", "code"), [("0.96GB/s", 1), ("1GB/s", 0)])
def test_fail_on_cost_says_what_fixes_save(limit: str, code: int, tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(KIND.format(share=1))
    done = run(
        tmp_path,
        "check",
        "--isolated",
        "--fail-on",
        "error",
        "--fail-on-cost",
        limit,
        "--output",
        "concise",
        "--select",
        "MSAA201",
        ".",
    )
    assert done.returncode == code
    assert (
        f"frame.msaa.yaml: fixes save 960 MB/s, which reaches --fail-on-cost {limit}" in done.stderr
    ) == (code == 1)


def test_fail_on_cost_says_where_it_cannot_tell(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(
        KIND.format(share=1).replace("width: 1000, height: 1000, ", "")
    )
    done = run(
        tmp_path, "check", "--isolated", "--fail-on", "error", "--fail-on-cost", "1MB/s", "."
    )
    assert done.returncode == 0
    assert "frame.msaa.yaml: the sizes or formats that price its fixes are unknown" in done.stderr


def test_a_large_file_says_that_its_fixes_are_not_tried(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(KIND.format(share=1) + "#\n" * (MAX_TRIED // 2))
    done = run(tmp_path, "check", "--isolated", "--output", "concise", ".")
    assert "\n1 file is too large to try fixes here; `check --diff` tries them\n" in done.stdout
    assert "fixable" not in done.stdout
    assert "would be fixed" in run(tmp_path, "check", "--isolated", "--diff", ".").stderr
    assert (
        "fixes save" in run(tmp_path, "check", "--isolated", "--fail-on-cost", "1MB/s", ".").stderr
    )
    assert (
        "frame.msaa.yaml is too large to try fixes"
        in run(tmp_path, "cost", "--isolated", "frame.msaa.yaml").stderr
    )
