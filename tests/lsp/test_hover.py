"""What is said about keys, values, names, findings and rules, and the traffic beside the text."""

from __future__ import annotations

import pytest

from msaa_lint.cli.lsp.hover import hover
from msaa_lint.cli.lsp.inlay_hints import hints
from msaa_lint.cli.lsp.view import View
from msaa_lint.core.text.span import Span

from .views import at, engine, view

FRAME = """\
frame: {width: 1000, height: 1000, fps: 100}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT]}
renderPasses:
  forward:
    attachments:
      source: {image: color_ms, loadOp: CLEAR, storeOp: STORE}
      target: {image: color, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - {colorAttachments: [source], resolveAttachments: [target]}
"""


def said(text: str, kind: str = "description") -> str:
    """What is said at the mark."""
    text, offset = at(text)
    answer = hover(view(text, kind), offset)
    assert answer is not None and answer.span.start <= offset <= answer.span.end
    return answer.markdown


def test_a_key() -> None:
    text = said(FRAME.replace("storeOp: STORE", "store^Op: STORE", 1))
    assert text.startswith("**Store operation** `storeOp`")
    assert (
        "[VkAttachmentDescription2::storeOp](https://" in text
        and "Value: `VkAttachmentStoreOp`" in text
    )


def test_a_store_with_and_without() -> None:
    text = said(FRAME.replace("storeOp: STORE", "storeOp: ST^ORE", 1))
    assert "`VK_ATTACHMENT_STORE_OP_STORE`" in text
    assert "Moves 1,600 MB/s, 160 mW." in text
    assert "| `STORE` as written | 2,000 | 200 |" in text
    assert "| `DONT_CARE` | 400 (−1,600) | 40.0 (−160) |" in text


def test_samples_and_formats() -> None:
    text = said(FRAME.replace("samples: 4", "samples: ^4"))
    assert "| `1` | 800 (−1,200) |" in text and "| `8` | 3,600 (+1,600) |" in text
    text = said(
        FRAME.replace("format: R8G8B8A8_UNORM, samples: 4", "format: R8^G8B8A8_UNORM, samples: 4")
    )
    assert "4 bytes a texel" in text and "| `R16G16B16A16_SFLOAT` | 3,600 (+1,600) |" in text


def test_a_flag_that_saves_memory() -> None:
    text = said(FRAME.replace("LAZILY_ALLOCATED", "LAZILY^_ALLOCATED"))
    assert "| `without LAZILY_ALLOCATED` | 2,000 | 200 | 19.1 (+15.3) |" in text


def test_a_value_that_costs_nothing_has_no_table() -> None:
    assert "|" not in said(
        FRAME.replace(
            "R8G8B8A8_UNORM, samples: 1, usage: [C", "R8G8B8A8_UNORM, samples: 1, usage: [^C"
        )
    )


def test_a_device_and_a_value_without_a_text() -> None:
    assert said("device: mali^-g76\n").startswith(
        "**Mali-G76**: tile-based; color sample counts 1, "
    )
    assert "`rasterizationSamples`" in said(
        "pipelines: {p: {multisampleState: {rasterizationSamples: ^4}}}\n"
    )


def test_an_image_over_the_frame() -> None:
    text = said(FRAME.replace("image: color_ms", "image: color^_ms"))
    assert (
        "Image `color_ms`: 0.00 MB/s read, 1,600 MB/s written, 160 mW; 0.00 MiB of memory of 15.3 "
        "MiB." in text
    )
    assert "| `forward` | color | store | 1,600 | 160 |" in text


def test_a_pass_and_an_attachment() -> None:
    text = said(FRAME.replace("  forward:", "  for^ward:"))
    assert "This pass moves 2,000 MB/s, 200 mW." in text
    assert "| `target` | color | resolve | 1 | 400 |" in text
    assert "This attachment moves 400 MB/s, 40.0 mW, by its resolve." in said(
        FRAME.replace("  target:", "  tar^get:")
    )


def test_metal() -> None:
    text = """\
frame: {width: 1000, height: 1000, fps: 100}
metal:
  textures:
    ms: {pixelFormat: bgra8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: private}
    out: {pixelFormat: bgra8Unorm, sampleCount: 1, usage: [renderTarget]}
  renderPasses:
    p: {colorAttachments: [{texture: ms, resolveTexture: out, loadAction: clear, storeAction: storeAnd^MultisampleResolve}]}
"""
    said_here = said(text)
    assert "`MTLStoreAction.storeAndMultisampleResolve`" in said_here
    assert "| `storeAndMultisampleResolve` as written | 2,000 | 200 |" in said_here
    assert "| `multisampleResolve` | 400 (−1,600) |" in said_here


def test_a_shorthand() -> None:
    text = """\
frame: {width: 1000, height: 1000, fps: 100}
renderTargets:
  onscreen:
    api: vulkan
    colorFormat: kR8G8B8A8UNormInt
    sampleCount: k4
    colorAttachmentConfig: {storageMode: kDeviceTransient, loadAction: kClear, storeAction: kMulti^sampleResolve}
"""
    assert "| `kMultisampleResolve` as written | 800 |" in said(text)
    assert "| `kStoreAndMultisampleResolve` | 2,400 (+1,600) |" in said(text)


def test_names_are_escaped() -> None:
    name = "a`|<b>[x](y)"
    text = said(
        FRAME.replace("color_ms", f"'{name}'").replace(f"image: '{name}'", f"image: ^'{name}'")
    )
    assert name not in text and "<b>" not in text and "&#60;b&#62;" in text


def test_a_finding_and_its_rule() -> None:
    seen = view(FRAME)
    finding = next(found for found in seen.findings if found.span is not None)
    answer = hover(seen, finding.span.start)  # type: ignore[union-attr]
    assert answer is not None
    assert f"**{finding.rule}** `{finding.code}`" in answer.markdown and "## Why" in answer.markdown


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("images: {} # msaa-lint: ignore[MSAA^102] x", "description"),
        ("int a; // msaa-lint: ignore[MSAA^102] x", "code"),
        ('select = ["MSAA^102"]', "configuration"),
        ("---\nsupersedes: [MSAA^102]\n---\n", "rule"),
    ],
)
def test_a_rule_that_is_named(text: str, kind: str) -> None:
    assert "`MSAA102`" in said(text, kind)


def test_the_page_of_a_rule_is_linked_where_there_is_a_site() -> None:
    text, offset = at('select = ["MSAA^102"]')
    rule = next(rule for rule in engine().registry.rules if rule.code == "MSAA102")
    answer = hover(
        View(text, "configuration", None, engine().registry, docs_url="https://example.org"), offset
    )
    assert answer is not None and f"](https://example.org/rules/{rule.name}/)" in answer.markdown


def test_a_fact_in_a_rule_page() -> None:
    assert "INT" in said("---\nwhen: image.sam^ples > 1\n---\n", "rule")


def test_nothing_is_said_about_blanks_and_other_texts() -> None:
    text, offset = at("images: ^ {}\n")
    assert hover(view(text), offset) is None
    text, offset = at("int MSAA^102;")
    assert hover(view(text, "code"), offset) is None


def test_hints() -> None:
    found = [
        (FRAME.count("\n", 0, hint.at) + 1, hint.text)
        for hint in hints(view(FRAME), Span(0, len(FRAME)))
    ]
    assert found == [(6, "2,000 MB/s, 200 mW"), (8, "1,600 MB/s"), (9, "400 MB/s (resolve)")]


def test_hints_of_a_part_of_the_text() -> None:
    start = FRAME.index("      target")
    assert [hint.text for hint in hints(view(FRAME), Span(start, len(FRAME)))] == [
        "400 MB/s (resolve)"
    ]


def test_hints_of_dynamic_rendering() -> None:
    text = """\
frame: {width: 1000, height: 1000, fps: 100}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4}
  color: {format: R8G8B8A8_UNORM, samples: 1}
commands:
  - beginRendering:
      colorAttachments:
        - {image: color_ms, loadOp: CLEAR, storeOp: STORE, resolveMode: AVERAGE, resolveImage: color}
  - endRendering
"""
    found = [
        (text.count("\n", 0, hint.at) + 1, hint.text)
        for hint in hints(view(text), Span(0, len(text)))
    ]
    assert found == [(6, "2,000 MB/s, 200 mW"), (8, "2,000 MB/s, 400 of it the resolve")]


@pytest.mark.parametrize(
    ("text", "expected", "other"),
    [
        ('fa^il-on = "error"', "**fail-on**: the lowest severity", "(#"),
        ('fail-on = "er^ror"', "Default: `warning`", "](#"),
        ("[limits]\ndep^th = 3", "**limits.depth**", "nodes"),
        ("[lim^its]\ndepth = 3", "`limits.nodes`", "**"),
        ("[tool.msaa-lint]\ninc^lude = ['a']", "Default: as below", "](#"),
        ("fail^-on", "**fail-on**: the lowest severity", "(#"),
        ("select = ['ALL']\n[limits]\ndep^th =\n", "**limits.depth**", "nodes"),
        (
            "[tool.ruff]\na = 1\n[tool.msaa-lint]\nfail^-on =\n",
            "**fail-on**: the lowest severity",
            "(#",
        ),
        (
            "[tool.msaa-lint.source.ass^ume]\na = 1",
            "**source.assume**: values that source code does not state",
            "](",
        ),
    ],
)
def test_settings(text: str, expected: str, other: str) -> None:
    text, offset = at(text)
    answer = hover(view(text, "configuration"), offset)
    assert answer is not None and expected in answer.markdown and other not in answer.markdown


@pytest.mark.parametrize("line", ["exc^lude = ['a']", "exc^lude ="])
def test_keys_of_other_tools_are_no_settings(line: str) -> None:
    text, offset = at(f"[tool.ruff]\n{line}")
    assert hover(view(text, "configuration"), offset) is None
