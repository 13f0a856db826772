"""Attachments that a subpass between two others neither uses nor preserves.

Render Pass Creation: "The contents of an attachment within the render area become undefined at the
start of a subpass S if ... There is a subpass S1 that uses or preserves the attachment, and a
subpass dependency from S1 to S; the attachment is not used or preserved in subpass S." They "remain
undefined for subpasses in subpass dependency chains starting with subpass S until they are written
again".
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from tests.command import run

CHAIN = "0 1, 1 2"
WRITES, OTHER, READS = (
    "{colorAttachments: [a]}",
    "{colorAttachments: [b]}",
    "{inputAttachments: [a], colorAttachments: [c]}",
)
KEEPS = "{colorAttachments: [b], preserveAttachments: [a]}"

FRAMES = [
    ("read after a subpass without it", [WRITES, OTHER, READS], CHAIN, "high"),
    ("drawn after a subpass without it", [WRITES, OTHER, WRITES], CHAIN, "medium"),
    ("preserved", [WRITES, KEEPS, READS], CHAIN, ""),
    ("used", [WRITES, "{inputAttachments: [a], colorAttachments: [b]}", READS], CHAIN, ""),
    ("no dependencies", [WRITES, OTHER, READS], "", ""),
    ("a dependency past it", [WRITES, OTHER, READS], "0 2", ""),
    ("one that nothing depends on", [WRITES, OTHER, READS], "0 1, 0 2", ""),
    ("one that depends on nothing", [WRITES, OTHER, READS], "1 2, 0 2", ""),
    ("two chains, one without it", [WRITES, KEEPS, OTHER, READS], "0 1, 0 2, 1 3, 2 3", "high"),
    (
        "two subpasses, the second without it",
        [WRITES, KEEPS, OTHER, READS],
        "0 1, 1 2, 2 3",
        "high",
    ),
    ("two subpasses that preserve it", [WRITES, KEEPS, KEEPS, READS], "0 1, 1 2, 2 3", ""),
    ("first used after it", [OTHER, OTHER, WRITES], CHAIN, ""),
    ("last used before it", [WRITES, READS, OTHER], CHAIN, ""),
    ("read only", [READS, "{colorAttachments: [c]}", READS], CHAIN, ""),
    (
        "depth",
        [
            "{depthStencilAttachment: d}",
            OTHER,
            "{depthStencilAttachment: d, colorAttachments: [b]}",
        ],
        CHAIN,
        "medium",
    ),
    (
        "depth preserved",
        [
            "{depthStencilAttachment: d}",
            "{colorAttachments: [b], preserveAttachments: [d]}",
            "{depthStencilAttachment: d}",
        ],
        CHAIN,
        "",
    ),
    ("external dependencies", [WRITES, OTHER, READS], "EXTERNAL 0, 2 EXTERNAL", ""),
    (
        "a resolve target that is read",
        [
            "{colorAttachments: [a], resolveAttachments: [r]}",
            OTHER,
            "{inputAttachments: [r], colorAttachments: [b]}",
        ],
        CHAIN,
        "high",
    ),
    (
        "a resolve target that is written again",
        [
            "{colorAttachments: [a], resolveAttachments: [r]}",
            OTHER,
            "{colorAttachments: [b], resolveAttachments: [r]}",
        ],
        CHAIN,
        "",
    ),
]


def frame(subpasses: list[str], dependencies: str) -> str:
    pairs = (pair.split() for pair in dependencies.split(",") if pair)
    stated = "".join(
        f"      - {{srcSubpass: {source}, dstSubpass: {target}, srcStageMask: [ALL_GRAPHICS], "
        "dstStageMask: [ALL_GRAPHICS], "
        "srcAccessMask: [MEMORY_WRITE], dstAccessMask: [MEMORY_READ, MEMORY_WRITE]}\n"
        for source, target in pairs
    )
    color = "{format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE}"
    return f"""renderPasses:
  main:
    attachments:
      a: {color}
      b: {color}
      c: {color}
      d: {color.replace("R8G8B8A8_UNORM", "D32_SFLOAT")}
      r: {color.replace("samples: 4", "samples: 1")}
    subpasses:
{"".join(f"      - {subpass}{chr(10)}" for subpass in subpasses)}    dependencies:
{stated or "      []"}
"""


@pytest.fixture(scope="module")
def found(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[tuple[str, str]]]:
    """The severities and confidences of the findings by file, as YAML and as JSON."""
    folder: Path = tmp_path_factory.mktemp("frames")
    for number, (_, subpasses, dependencies, _) in enumerate(FRAMES):
        text = frame(subpasses, dependencies)
        (folder / f"{number}.msaa.yaml").write_text(text)
        (folder / f"{number}.msaa.json").write_text(json.dumps(yaml.safe_load(text)))
    by_file: dict[str, list[tuple[str, str]]] = {}
    for finding in json.loads(run(folder, "check", "--output", "json", ".").stdout)["findings"]:
        assert not finding["code"].startswith("MSAA9"), finding
        if finding["code"] == "MSAA218":
            by_file.setdefault(finding["file"], []).append(
                (finding["severity"], finding["confidence"])
            )
    return by_file


@pytest.mark.parametrize(
    ("number", "name", "confidence"),
    [(n, name, confidence) for n, (name, _, _, confidence) in enumerate(FRAMES)],
)
def test_a_frame(
    found: dict[str, list[tuple[str, str]]], number: int, name: str, confidence: str
) -> None:
    for kind in ("yaml", "json"):
        assert found.get(f"{number}.msaa.{kind}", []) == (
            [("error", confidence)] if confidence else []
        ), (name, kind)
