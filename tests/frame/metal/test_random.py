"""Random frames in Metal's words, of a few textures that meet often: whatever they state, they are
judged and fixed by the laws.
"""

from __future__ import annotations

import json
from random import Random
from typing import Any

from hypothesis import example, given
from hypothesis import strategies as st

from msaa_lint.frame.metal.names import ENUMS
from tests.linter.fixes.linting import fix_findings, kinds, lint
from tests.strength import examples

FORMATS = {
    "a": "rgba8Unorm",
    "b": "rgba8Unorm",
    "c": "depth32Float_stencil8",
    "d": "depth32Float_stencil8",
}
FILTERS = {
    "depthAttachment": {"depthResolveFilter": ENUMS["MTLMultisampleDepthResolveFilter"]},
    "stencilAttachment": {"stencilResolveFilter": ENUMS["MTLMultisampleStencilResolveFilter"]},
}


class Frames:
    """Makes frames from a seed."""

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)

    def some(self, members: dict[str, Any], likely: float = 0.85, **rare: float) -> dict[str, Any]:
        return {
            name: value
            for name, value in members.items()
            if self.random.random() < rare.get(name, likely)
        }

    def texture(self, name: str) -> dict[str, Any]:
        stated = {
            "pixelFormat": FORMATS[name],
            "sampleCount": self.random.choice([1, 2, 4, 8, 16]),
            "textureType": self.random.choice(["type2D", "type2DMultisample"]),
            "usage": self.random.sample(
                ["renderTarget", "shaderRead", "shaderWrite", "unknown"], self.random.randint(1, 3)
            ),
            "storageMode": self.random.choice(["private", "memoryless", "shared"]),
            "drawable": True,
        }
        return self.some(stated, drawable=0.2)

    def attachment(self, textures: str, slot: str = "") -> dict[str, Any]:
        stated = {
            "texture": self.random.choice(textures),
            "resolveTexture": self.random.choice(textures),
            "loadAction": self.random.choice(ENUMS["MTLLoadAction"]),
            "storeAction": self.random.choice(ENUMS["MTLStoreAction"]),
            **{name: self.random.choice(words) for name, words in FILTERS.get(slot, {}).items()},
        }
        return self.some(stated, 0.9, resolveTexture=0.5)

    def render_pass(self) -> dict[str, Any]:
        colors = [
            self.attachment("ab") if self.random.random() < 0.9 else None
            for _ in range(self.random.randint(0, 2))
        ]
        return self.some(
            {"colorAttachments": colors, **{slot: self.attachment("cd", slot) for slot in FILTERS}},
            0.7,
        )

    def command(self, passes: dict[str, Any]) -> dict[str, Any]:
        kind = self.random.choice(
            [*["renderPass"] * 3, "readTexture", "writeTexture", "copy", "present"]
        )
        one, other = self.random.choices(list(FORMATS), k=2)
        if kind == "renderPass":
            return {kind: self.random.choice(list(passes))}
        if kind == "copy":
            return {kind: {"source": one, "destination": other}}
        return {
            kind: one
            if kind == "present"
            else {"texture": one, "stage": self.random.choice(["fragment", "compute", "tile"])}
        }

    def frame(self) -> dict[str, Any]:
        passes = {name: self.render_pass() for name in ("p", "q")[: self.random.randint(1, 2)]}
        metal = {
            "family": self.random.choice(["apple1", "apple7", "mac2"]),
            "textures": {name: self.texture(name) for name in FORMATS},
            "renderPasses": passes,
            "renderPipelines": {
                "x": {"renderPass": "p", "rasterSampleCount": self.random.choice([1, 2, 4])}
            },
            "commands": [self.command(passes) for _ in range(self.random.randint(0, 6))],
        }
        wants = {
            "depth": self.random.choice(["STANDARD", "REVERSED"]),
            "depthResolveWants": self.random.choice(["NEAREST", "FARTHEST"]),
        }
        metal = self.some(metal, 0.8, textures=1, renderPasses=1)
        return {"frame": {"width": 64, "height": 64, "fps": 60}, "scene": wants, "metal": metal}


@examples(0.6)
@given(st.integers(0, 2**32), st.booleans())
# Depth, once it is resolved beside stencil, is the first to have the resolve target that is wrong.
@example(1104266, True)
def test_they_are_judged_and_fixed(seed: int, unsafe: bool) -> None:
    text = json.dumps(Frames(seed).frame(), indent=1)
    before = lint(text)
    assert not [found for found in before.findings if found.fatal]
    done = fix_findings(text, unsafe)
    after = lint(done.text)
    assert not kinds(after) - kinds(before)
    assert after.findings == done.result.findings
    assert fix_findings(done.text, unsafe).text == done.text
    for found in after.findings:
        assert "unknown" not in found.message.replace("storeAction unknown", ""), found
