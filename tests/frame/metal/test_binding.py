"""Mistakes in the section `metal`: each at its place, with the nearest right word."""

from __future__ import annotations

import json
from typing import Any

import pytest

from msaa_lint import lint
from msaa_lint.frame.description.models import Metal
from msaa_lint.frame.description.pydantic_models import model_of
from tests.frame.description.test_schema import documents, mistakes
from tests.frame.metal.frames import ARTICLE, BEST, read
from tests.marked import unmarked


@pytest.mark.parametrize(
    ("marked", "code", "message", "help"),
    [
        (
            "metal: ⟦3⟧",
            "MSAA903",
            "`metal` must be a mapping, found `3`; its keys are family, supportedSampleCounts, "
            "textures, "
            "renderPasses, renderPipelines, commands",
            "",
        ),
        (
            "metal: {⟦texturs⟧: {}}",
            "MSAA902",
            "unknown key `texturs` in metal: did you mean `textures`?",
            "",
        ),
        (
            "metal: {family: ⟦aple7⟧}",
            "MSAA903",
            "`family` must be an MTLGPUFamily, found `aple7`; did you mean `apple7`?",
            "",
        ),
        (
            "metal: {supportedSampleCounts: [1, ⟦3⟧]}",
            "MSAA903",
            "`supportedSampleCounts[1]` must be 1, 2, 4, 8, 16, 32 or 64, found `3`",
            "",
        ),
        (
            "metal: {textures: {a: {pixelFormat: ⟦brga8Unorm_srgb⟧}}}",
            "MSAA903",
            "`pixelFormat` must be an MTLPixelFormat, found `brga8Unorm_srgb`; did you mean "
            "`rgba8Unorm_srgb`?",
            "",
        ),
        (
            "metal: {textures: {a: {⟦samples⟧: 4}}}",
            "MSAA902",
            "unknown key `samples` in metal.textures.a: did you mean `sampleCount`?",
            None,
        ),
        (
            "metal: {textures: {a: {usage: [renderTarget, ⟦.shaderReed⟧]}}}",
            "MSAA903",
            "`usage[1]` must be an MTLTextureUsage, found `.shaderReed`; did you mean "
            "`shaderRead`?",
            "",
        ),
        (
            "metal: {textures: {a: {storageMode: ⟦MTLStorageModeMemoryles⟧}}}",
            "MSAA903",
            "`storageMode` must be an MTLStorageMode, found `MTLStorageModeMemoryles`; did you "
            "mean `memoryless`?",
            "",
        ),
        (
            "metal: {textures: {a: {textureType: ⟦2DMultisample⟧}}}",
            "MSAA903",
            "`textureType` must be an MTLTextureType, found `2DMultisample`; did you mean "
            "`type2DMultisample`?",
            "",
        ),
        (
            "metal: {renderPasses: {p: {colorAttachments: [{storeAction: ⟦DONT_CARE⟧}]}}}",
            "MSAA903",
            "`storeAction` must be an MTLStoreAction, found `DONT_CARE`; did you mean `dontCare`?",
            "",
        ),
        (
            "metal: {renderPasses: {p: {depthAttachment: {⟦resolveFilter⟧: min}}}}",
            "MSAA902",
            "unknown key `resolveFilter` in metal.renderPasses.p.depthAttachment: did you mean "
            "`depthResolveFilter`?",
            "",
        ),
        (
            "metal: {renderPasses: {p: {colorAttachments: {⟦8⟧: {}}}}}",
            "MSAA903",
            "the keys of `metal.renderPasses.p.colorAttachments` must be integers from 0 to 7, "
            "found `8`",
            "",
        ),
        (
            "metal: {renderPasses: {p: {colorAttachments: {⟦4294967295⟧: {}}}}}",
            "MSAA903",
            "the keys of `metal.renderPasses.p.colorAttachments` must be integers from 0 to 7, "
            "found `4294967295`",
            "",
        ),
        (
            "metal: {renderPasses: {p: {colorAttachments: [~, ~, ~, ~, ~, ~, ~, ~, ⟦~⟧]}}}",
            "MSAA903",
            "`metal.renderPasses.p.colorAttachments` must have at most 8 items, found 9",
            "",
        ),
        (
            "metal: {textures: {colorMS: {}}, renderPasses: {p: {colorAttachments: [{texture: "
            "⟦colourMS⟧}]}}}",
            "MSAA904",
            "`texture` names `colourMS`, which is not in `metal.textures`; did you mean `colorMS`?",
            "",
        ),
        (
            "metal: {renderPasses: {p: {depthAttachment: {resolveTexture: ⟦depth⟧}}}}",
            "MSAA904",
            "`resolveTexture` names `depth`, which is not in `metal.textures`; the description has "
            "no `metal.textures`",
            "",
        ),
        (
            "metal: {renderPasses: {forward: {}}, commands: [{renderPass: ⟦forwad⟧}]}",
            "MSAA904",
            "`renderPass` names `forwad`, which is not in `metal.renderPasses`; did you mean "
            "`forward`?",
            "",
        ),
        (
            "metal: {renderPasses: {forward: {}}, renderPipelines: {a: {renderPass: ⟦other⟧}}}",
            "MSAA904",
            "`renderPass` names `other`, which is not in `metal.renderPasses`; write one of "
            "forward",
            "",
        ),
        (
            "metal: {commands: [{⟦blit⟧: {}}]}",
            "MSAA902",
            "unknown command `blit`: expected one of renderPass, readTexture, writeTexture, copy, "
            "present",
            "",
        ),
        (
            "metal: {commands: [⟦present⟧]}",
            "MSAA903",
            "the command `present` needs parameters; write `present: ...`",
            "",
        ),
        (
            "metal: {commands: [{readTexture: {stage: ⟦FRAGMENT⟧}}]}",
            "MSAA903",
            "`stage` must be one of vertex, fragment, compute, tile, found `FRAGMENT`; did you "
            "mean `fragment`?",
            "",
        ),
        (
            "images: {}\n⟦metal⟧: {}",
            "MSAA903",
            "`metal` cannot be combined with the Vulkan section `images`",
            "describe the frame either in `metal` or in Vulkan's sections; only `frame`, `device` "
            "and `scene` are allowed beside `metal`",
        ),
        (
            "⟦metal⟧: {}\ncommands: []",
            "MSAA903",
            "`metal` cannot be combined with the Vulkan section `commands`",
            None,
        ),
        (
            "metal: {}\ndevice: ⟦apple-m9⟧",
            "MSAA904",
            "unknown device `apple-m9`; did you mean `apple-m1`?",
            "",
        ),
    ],
)
def test_mistakes(marked: str, code: str, message: str, help: str | None) -> None:
    text, (span,) = unmarked(marked)
    found = read(text)
    assert [(problem.code, problem.message, problem.span) for problem in found.problems] == [
        (code, message, span)
    ]
    assert help is None or found.problems[0].help == help
    assert found.metal is None and not found.description.renderPasses, (
        "what was misread is not judged"
    )


def test_every_mistake_is_told() -> None:
    text = (
        "metal: {family: x, textures: {a: {pixelFormat: y, usage: 3}}, commands: [{renderPass: z}]}"
    )
    assert [problem.code for problem in read(text).problems] == [
        "MSAA903",
        "MSAA903",
        "MSAA903",
        "MSAA904",
    ]


@pytest.mark.parametrize("text", [ARTICLE, BEST])
def test_the_schema_takes_what_is_read(text: str) -> None:
    (value,) = documents(text)
    assert mistakes(value) == []
    value["metal"]["textures"]["ms"]["storageMode"] = "lazily"
    value["metal"]["renderPasses"]["forward"]["colorAttachments"][0]["storeOp"] = "STORE"
    assert sorted(mistakes(value)) == [
        "metal/renderPasses/forward/colorAttachments",
        "metal/textures/ms/storageMode",
    ]


def test_programs_are_checked_alike() -> None:
    (value,) = documents(ARTICLE)
    found = lint(text=json.dumps(value)).findings
    assert "metal-samples-stored-unread" in {finding.rule for finding in found}
    made: Any = model_of(Metal).model_validate(
        {
            "textures": {
                "a": {"usage": ".renderTarget | shaderRead", "storageMode": "MTLStorageModePrivate"}
            }
        }
    )
    assert (made.textures["a"].usage, made.textures["a"].storageMode) == (
        ("renderTarget", "shaderRead"),
        "private",
    )
