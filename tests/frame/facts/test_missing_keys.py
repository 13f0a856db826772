"""Every fact has the keys that state it, and what an explanation tells to write helps."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator
from typing import Any

import pytest
import yaml

from msaa_lint.core.finding import Undecided
from msaa_lint.frame.description.models import Description
from msaa_lint.frame.description.shapes import Shape
from msaa_lint.frame.facts.table import FACTS
from msaa_lint.frame.facts.table_keys import KEYS, WITHOUT_KEY
from msaa_lint.linter.engine import Engine, load_rules
from msaa_lint.linter.lint_options import LintOptions
from tests.pages import Example, all_examples

ENGINE = Engine(load_rules())
OPTIONS = LintOptions(lambda rule, severity, vendor: severity, all_keys=True)

Path = tuple[str | int, ...]


def test_every_fact_has_a_key_or_needs_none() -> None:
    assert KEYS.keys() | WITHOUT_KEY == FACTS.keys()
    assert not KEYS.keys() & WITHOUT_KEY
    assert all(KEYS.values())


def test_facts_that_are_never_unknown_have_no_key() -> None:
    assert {name for name, fact in FACTS.items() if "never unknown" in fact.doc} <= WITHOUT_KEY


def undecided(tree: Any) -> list[Undecided] | None:
    """The undecided rules for a description; None if it is invalid."""
    result = ENGINE.lint(json.dumps(tree).encode(), "x.msaa.yaml", OPTIONS)
    return None if any(finding.fatal for finding in result.findings) else result.undecided


def leaves(tree: Any, path: Path = ()) -> Iterator[Path]:
    """The paths of the members that hold no mapping."""
    items = (
        tree.items()
        if isinstance(tree, dict)
        else enumerate(tree)
        if isinstance(tree, list)
        else ()
    )
    for key, value in items:
        if isinstance(value, dict) or (
            isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value)
        ):
            yield from leaves(value, (*path, key))
        elif isinstance(tree, dict):
            yield (*path, key)


def without(tree: Any, path: Path) -> Any:
    changed = copy.deepcopy(tree)
    inner = changed
    for key in path[:-1]:
        inner = inner[key]
    del inner[path[-1]]
    return changed


def steps(path: str) -> Path:
    """`a.b[0].c` as keys and indices."""
    return tuple(
        int(part[1:-1]) if part.startswith("[") else part
        for part in re.findall(r"\[\d+\]|[^.\[\]]+", path)
    )


def written(tree: Any, path: Path, value: Any) -> Any:
    """A description with a value at a path; structures on the way to it are added, lists by their
    first item.
    """
    changed = copy.deepcopy(tree)
    inner: Any = changed
    for number, key in enumerate(path[:-1]):
        if isinstance(inner, dict) and key not in inner:
            inner[key] = (
                [{}] if path[number] in ("attachments", "stages", "colorAttachments") else {}
            )
        inner = inner[key] if not isinstance(inner, list) or isinstance(key, int) else inner[0]
        if isinstance(inner, list) and not isinstance(path[number + 1], int):
            inner = inner[0]
    inner[path[-1]] = value
    return changed


VALUES: dict[str, tuple[Any, ...]] = {
    "format": ("R8G8B8A8_UNORM", "D24_UNORM_S8_UINT", "R32_UINT", "R16G16B16A16_SFLOAT"),
    "samples": (1, 4, 8),
    "usage": (
        ["COLOR_ATTACHMENT"],
        ["DEPTH_STENCIL_ATTACHMENT", "SAMPLED"],
        ["TRANSIENT_ATTACHMENT", "COLOR_ATTACHMENT"],
        ["TRANSFER_SRC"],
    ),
    "memory": (["DEVICE_LOCAL"], ["DEVICE_LOCAL", "LAZILY_ALLOCATED"]),
    "storeOp": ("STORE", "DONT_CARE", "NONE"),
    "loadOp": ("LOAD", "CLEAR", "DONT_CARE"),
    "stencilStoreOp": ("STORE", "DONT_CARE"),
    "stencilLoadOp": ("LOAD", "CLEAR"),
    "device": ("mali-g76", "mobile-baseline", {"name": "x", "vendor": "arm"}, {}),
    "commands": ([],),
    "dependencies": ([], [{"srcSubpass": "EXTERNAL", "dstSubpass": 0}]),
    "presentable": (True, False),
    "mipLevels": (1, 3),
    "imageType": ("2D", "3D"),
    "tiling": ("OPTIMAL", "LINEAR"),
    "sharingMode": ("EXCLUSIVE", "CONCURRENT"),
    "encoding": ("LINEAR", "DATA"),
    "initialLayout": ("UNDEFINED", "GENERAL"),
    "finalLayout": ("GENERAL", "PRESENT_SRC_KHR"),
    "rasterizationSamples": (1, 4),
    "sampleShadingEnable": (True, False),
    "minSampleShading": (0.0, 1.0),
    "alphaToCoverageEnable": (True, False),
    "blendEnable": (True, False),
    "rasterizerDiscardEnable": (True, False),
    "apiVersion": ("1.0", "1.3"),
    "features": ([], ["sampleRateShading"]),
    "extensions": ([], ["VK_KHR_depth_stencil_resolve"]),
    "depthResolveMode": ("NONE", "MIN", "AVERAGE"),
    "stencilResolveMode": ("NONE", "SAMPLE_ZERO"),
    "resolveMode": ("NONE", "AVERAGE"),
    "clearValueCount": (0, 3),
    "srcStageMask": (["COLOR_ATTACHMENT_OUTPUT"], []),
    "depth": ("STANDARD", "REVERSED"),
    "color": ("LDR", "HDR"),
    "peak": (1.0, 100.0),
    "toneMapping": ("IN_PASS", "NONE"),
    "depthResolveWants": ("ANY", "NEAREST"),
    "storageMode": ("private", "memoryless"),
    "textureType": ("type2D", "type2DMultisample"),
    "sampleCount": (1, 4),
    "pixelFormat": ("rgba8Unorm", "depth32Float"),
    "loadAction": ("load", "clear"),
    "storeAction": ("store", "dontCare", "multisampleResolve"),
    "drawable": (True, False),
    "rasterSampleCount": (1, 4),
    "isAlphaToCoverageEnabled": (True, False),
    "family": ("apple2", "mac2"),
    "limits": ([], ["framebufferColorSampleCounts"]),
    "combined": ("AND", "MIN"),
    "chosen": ("MAXIMUM", "ATMOST"),
    "atMost": (4, 8),
}
"""Values of keys by name; the structure that a key is in may refuse some of them."""


def data_of(example: Example) -> Any:
    return yaml.load(example.text, yaml.CSafeLoader)


EXAMPLES = [example for example in all_examples() if "\n---" not in example.text]
REMOVED = [
    pytest.param(example, path, id=f"{example}:{'.'.join(map(str, path))}")
    for number, example in enumerate(EXAMPLES)
    for index, path in enumerate(leaves(data_of(example)))
    if (number + index) % 61 == 3
]


@pytest.mark.parametrize(("example", "path"), REMOVED)
def test_an_explanation_names_what_was_removed_or_what_else_says_it(
    example: Any, path: Path
) -> None:
    """And no key is named again for a rule once it is written, with whatever value."""
    tree = data_of(example)
    before, lacking = undecided(tree), without(tree, path)
    after = undecided(lacking)
    if before is None or after is None:
        return
    decided = {(entry.rule, entry.subject) for entry in before}
    for entry in after:
        if (entry.rule, entry.subject) in decided:
            continue
        assert entry.keys or path[-1] in STRUCTURAL, (entry.rule, entry.subject, entry.missing)
        if path[-1] in PLAIN:
            assert path in [steps(key.path) for key in entry.keys], (
                entry.rule,
                [key.path for key in entry.keys],
            )
    for entry in after[:6]:
        for key in entry.keys:
            for value in VALUES.get(key.name.rpartition(".")[2], ()):
                answer = undecided(written(lacking, steps(key.path), value))
                same = [
                    each
                    for each in answer or ()
                    if (each.rule, each.subject) == (entry.rule, entry.subject)
                ]
                assert key.path not in [again.path for each in same for again in each.keys], (
                    entry.rule,
                    key.path,
                    value,
                )


STRUCTURAL = frozenset(
    {
        "pipeline", "image", "texture", "srcImage", "dstImage", "resolveImage", "colorAttachments",
        "renderPass", "resolveMode", "resolves",
        "srcStageMask", "loadAction",
    }
)  # fmt: skip
"""What stands for a connection: without it, other parts are unknown, or their order."""

PLAIN = frozenset(
    {
        "storeOp", "initialLayout", "finalLayout", "rasterizationSamples", "sampleShadingEnable",
        "minSampleShading",
        "alphaToCoverageEnable", "blendEnable", "peak", "toneMapping", "depthResolveWants",
        "mipLevels", "encoding", "chosen", "combined",
    }
)  # fmt: skip
"""Keys that nothing else says."""


def test_keys_are_members_of_structures() -> None:
    """A misspelled member in the table would never be found missing."""
    members = set(_members(("record", Description), set()))
    special = {
        "load", "store", "initial", "loadOp", "resolveMode", "resolveFilter", "mode", "filter",
        "source", "target", "pipeline", "extent",
        "pipelineBarrier", "present", "resolveModes",
    }  # fmt: skip
    for fact, groups in KEYS.items():
        for key in groups.replace(";", " ").split():
            for name in key.split(".")[1:] or [key]:
                assert name in members | special, (fact, key)


def _members(shape: Shape, seen: set[type]) -> Iterator[str]:
    for part in shape[1:]:
        if isinstance(part, tuple):
            yield from _members(part, seen)
        elif isinstance(part, type) and hasattr(part, "SHAPE") and part not in seen:
            seen.add(part)
            for name, inner in part.SHAPE.items():
                yield name
                yield from _members(inner, seen)
