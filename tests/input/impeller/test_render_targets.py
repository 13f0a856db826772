"""Impeller's render targets: what the engine builds of them, where the findings stand, and what it
cannot be asked for.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from msaa_lint import lint
from msaa_lint.core.text.emitter import emit
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import BeginRenderPass
from msaa_lint.input.impeller.words import sample_count
from msaa_lint.input.readers import description
from tests.command import run
from tests.marked import unmarked

LAZY = "{memoryTypes: [[DEVICE_LOCAL], [DEVICE_LOCAL, LAZILY_ALLOCATED]]}"
EAGER = "{memoryTypes: [[DEVICE_LOCAL], [HOST_VISIBLE]]}"


def read(text: str) -> Document:
    source = Source("targets.yaml", text)
    parsed = parse(source, Limits())
    assert not parsed.problems
    return description.read(source, parsed.documents[0])


def vulkan(target: str, device: str = LAZY) -> Document:
    """The document of one target on Vulkan, of a size."""
    made = read(
        f"device: {device}\nrenderTargets:\n  main: {{api: vulkan, width: 64, height: 32, "
        f"{target}}}\n"
    )
    assert made.problems == ()
    assert made.tree is not None
    return made


def rasterized(document: Document) -> int | None:
    state = document.description.pipelines["main"].multisampleState
    assert state is not None
    return state.rasterizationSamples


def test_defaults_of_an_onscreen_target_are_the_engines() -> None:
    made = vulkan("onscreen: true, sampleCount: kCount4, depthFormat: kD24UnormS8Uint")
    frame = made.description
    assert list(frame.images) == ["main_color_ms", "main_color", "main_depth_stencil"]
    color, shown, depth = frame.images.values()
    assert (color.format, color.samples, color.memory) == (
        "R8G8B8A8_UNORM",
        4,
        ("DEVICE_LOCAL", "LAZILY_ALLOCATED"),
    )
    assert color.usage == ("COLOR_ATTACHMENT", "INPUT_ATTACHMENT", "TRANSIENT_ATTACHMENT")
    assert (shown.samples, shown.presentable, shown.memory, shown.usage) == (
        1,
        True,
        None,
        ("COLOR_ATTACHMENT", "INPUT_ATTACHMENT"),
    )
    assert (depth.format, depth.samples) == ("D24_UNORM_S8_UINT", 4)
    assert depth.usage == ("DEPTH_STENCIL_ATTACHMENT", "TRANSIENT_ATTACHMENT")
    assert color.extent is not None
    assert (color.extent.width, color.extent.height, color.extent.depth) == (64, 32, 1)
    built = frame.renderPasses["main"]
    ops = {
        each.key: (each.image, each.loadOp, each.storeOp, each.stencilLoadOp, each.stencilStoreOp)
        for each in built.attachments
    }
    assert ops == {
        "color_ms": ("main_color_ms", "CLEAR", "DONT_CARE", None, None),
        "color": ("main_color", "CLEAR", "STORE", None, None),
        "depth_stencil": ("main_depth_stencil", "CLEAR", "DONT_CARE", "CLEAR", "DONT_CARE"),
    }
    (subpass,) = built.subpasses
    assert [slot.attachment for slot in subpass.colorAttachments] == ["color_ms"]
    assert [slot.attachment for slot in subpass.resolveAttachments] == ["color"]
    assert subpass.depthStencilAttachment is not None
    assert subpass.depthStencilAttachment.attachment == "depth_stencil"
    assert frame.framebuffers["main"].attachments == (
        "main_color_ms",
        "main_color",
        "main_depth_stencil",
    )
    assert rasterized(made) == 4
    assert [command.kind for command in frame.commands or ()] == [
        "beginRenderPass",
        "draw",
        "endRenderPass",
        "pipelineBarrier",
        "present",
    ]


def test_memory_that_is_not_lazily_allocated_makes_nothing_transient() -> None:
    color = vulkan("sampleCount: 4", EAGER).description.images["main_color_ms"]
    assert color.usage == ("COLOR_ATTACHMENT", "INPUT_ATTACHMENT"), (
        "and no transfers: the mode is transient all the same"
    )
    assert color.memory == ("DEVICE_LOCAL",)


@pytest.mark.parametrize("device", ["{name: a}", "../device.json", "portable-tiler"])
def test_a_device_that_is_not_known_leaves_usage_and_memory_unknown(device: str) -> None:
    color = vulkan("sampleCount: 4", device).description.images["main_color_ms"]
    assert color.usage is None
    assert color.memory is None


@pytest.mark.parametrize(
    ("mode", "usage", "memory"),
    [
        ("kDevicePrivate", ("TRANSFER_SRC", "TRANSFER_DST"), ("DEVICE_LOCAL",)),
        ("kHostVisible", ("TRANSFER_SRC", "TRANSFER_DST"), None),
        ("kDeviceTransient", ("TRANSIENT_ATTACHMENT",), ("DEVICE_LOCAL", "LAZILY_ALLOCATED")),
    ],
)
def test_storage_modes(mode: str, usage: tuple[str, ...], memory: tuple[str, ...] | None) -> None:
    made = vulkan(
        f"sampleCount: 4, colorAttachmentConfig: {{storageMode: {mode}, resolveStorageMode: "
        f"{mode}}},"
        f" stencilAttachmentConfig: {{storageMode: {mode}}}"
    )
    color, resolved, depth = made.description.images.values()
    assert color.usage == ("COLOR_ATTACHMENT", "INPUT_ATTACHMENT", *usage)
    assert resolved.usage == ("COLOR_ATTACHMENT", "INPUT_ATTACHMENT", "SAMPLED", *usage)
    assert depth.usage == ("DEPTH_STENCIL_ATTACHMENT", *usage)
    assert {color.memory, resolved.memory, depth.memory} == {memory}


@pytest.mark.parametrize(
    ("action", "stored", "resolved"),
    [
        ("kDontCare", "DONT_CARE", False),
        ("kStore", "STORE", False),
        ("kMultisampleResolve", "DONT_CARE", True),
        ("kStoreAndMultisampleResolve", "STORE", True),
    ],
)
def test_store_actions(action: str, stored: str, resolved: bool) -> None:
    made = vulkan(
        f"sampleCount: 4, enableStencil: false, colorAttachmentConfig: {{storeAction: {action}}}"
    )
    built = made.description.renderPasses["main"]
    assert [each.storeOp for each in built.attachments] == (
        [stored, "STORE"] if resolved else [stored]
    )
    assert bool(built.subpasses[0].resolveAttachments) == resolved
    assert len(made.description.framebuffers["main"].attachments) == len(built.attachments)


@pytest.mark.parametrize(
    ("action", "operation", "layout"),
    [
        ("kLoad", "LOAD", "GENERAL"),
        ("kClear", "CLEAR", "UNDEFINED"),
        ("kDontCare", "DONT_CARE", "UNDEFINED"),
    ],
)
def test_load_actions(action: str, operation: str, layout: str) -> None:
    config = f"{{storageMode: kDevicePrivate, loadAction: {action}}}"
    made = vulkan(
        f"sampleCount: 4, depthFormat: kD32FloatS8UInt, colorAttachmentConfig: {config}, "
        f"stencilAttachmentConfig: {config}"
    )
    color, resolve, depth = made.description.renderPasses["main"].attachments
    assert (color.loadOp, color.initialLayout) == (operation, layout)
    assert (resolve.loadOp, resolve.initialLayout) == (operation, layout)
    assert (depth.loadOp, depth.stencilLoadOp, depth.initialLayout) == (
        operation,
        operation,
        "UNDEFINED",
    )


def test_stencil_alone_has_no_operations_of_depth() -> None:
    made = vulkan(
        "sampleCount: 4, depthFormat: kS8UInt, stencilAttachmentConfig: {loadAction: kClear, "
        "storeAction: kDontCare}"
    )
    depth = made.description.renderPasses["main"].attachments[-1]
    assert (depth.loadOp, depth.storeOp, depth.stencilLoadOp, depth.stencilStoreOp) == (
        "DONT_CARE",
        "DONT_CARE",
        "CLEAR",
        "DONT_CARE",
    )


def test_one_sample_is_drawn_where_it_is_shown() -> None:
    made = vulkan("onscreen: true, enableStencil: false")
    assert list(made.description.images) == ["main_color"]
    (color,) = made.description.renderPasses["main"].attachments
    assert (color.image, color.loadOp, color.storeOp) == ("main_color", "CLEAR", "STORE")
    assert not made.description.renderPasses["main"].subpasses[0].resolveAttachments


def test_offscreen_targets_are_sampled_by_who_knows_whom() -> None:
    made = vulkan("sampleCount: 4")
    assert made.description.images["main_color"].presentable is False
    (*_, last) = made.description.commands or ()
    assert last is not None
    assert (last.kind, last.body.image, last.body.access) == ("readImage", "main_color", None)  # type: ignore[attr-defined]


def test_the_size_is_the_frames_where_the_target_has_none() -> None:
    made = read("frame: {width: 8, height: 9}\nrenderTargets: {a: {api: vulkan, height: 5}}")
    begin = (made.description.commands or ())[0]
    assert begin is not None
    assert isinstance(begin.body, BeginRenderPass)
    assert begin.body.renderArea is not None
    assert (begin.body.renderArea.width, begin.body.renderArea.height) == (8, 5)
    assert read("renderTargets: {a: {api: vulkan}}").description.images["a_color"].extent is None


@pytest.mark.parametrize(
    ("word", "count"),
    [
        (1, 1),
        ("kCount1", 1),
        ("kCount4", 4),
        (4, 4),
        ("k2", 2),
        ("k8", 8),
        ("kCount16", 16),
        ("k16", 16),
    ],
)
def test_sample_counts(word: int | str, count: int) -> None:
    assert sample_count(word) == count
    assert rasterized(vulkan(f"sampleCount: {word}")) == count


MISTAKES = [
    (
        "renderTargets: {a: {api: ⟦vulcan⟧}}",
        "`api` must be vulkan or metal, found `vulcan`; did you mean `vulkan`?",
        "",
    ),
    ("renderTargets: {⟦a⟧: {sampleCount: 4}}", "`a` must have an `api`: vulkan or metal", ""),
    (
        "renderTargets: {a: {api: vulkan, ⟦colourFormat⟧: kR8UNormInt}}",
        "unknown key `colourFormat` in renderTargets.a: did you mean `colorFormat`?",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan, colorAttachmentConfig: {⟦storageMod⟧: kDevicePrivate}}}",
        "unknown key `storageMod` in renderTargets.a.colorAttachmentConfig: did you mean "
        "`storageMode`?",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan, colorAttachmentConfig: {storeAction: "
        "⟦kMultiSampleResolve⟧}}}",
        "`storeAction` must be one of kDontCare, kStore, kMultisampleResolve, "
        "kStoreAndMultisampleResolve, found `kMultiSampleResolve`; "
        "did you mean `kMultisampleResolve`?",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan, depthFormat: ⟦kD32Float⟧}}",
        "`depthFormat` must be one of kS8UInt, kD24UnormS8Uint, kD32FloatS8UInt, found "
        "`kD32Float`; did you mean `kD32FloatS8UInt`?",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan, enableStencil: ⟦1⟧}}",
        "`enableStencil` must be true or false, found `1`; write `true`",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan, depthFormat: kS8UInt, enableStencil: ⟦false⟧}}",
        "`kS8UInt` has only stencil, but `enableStencil` is false",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan, colorFormat: ⟦kB10G10R10XR⟧}}",
        "`kB10G10R10XR` requires Metal: the engine has no extended-range formats on Vulkan",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan}, b: {api: ⟦metal⟧}}",
        "all render targets must have the same `api`, but `a` has vulkan",
        "",
    ),
    (
        "renderTargets: {a: {api: vulkan}}\n⟦images⟧: {b: {samples: 4}}",
        "`images` is not allowed beside `renderTargets`, which define the whole frame",
        "run `msaa-lint convert` to expand the render targets, then edit the result",
    ),
    ("renderTargets: ⟦4⟧", "`renderTargets` must be a mapping by name, found `4`", ""),
]


@pytest.mark.parametrize(("marked", "message", "help"), MISTAKES)
def test_mistakes(marked: str, message: str, help: str) -> None:
    text, spans = unmarked(marked)
    (found,) = read(text).problems
    assert (found.message, found.span, found.help) == (message, spans[0], help)


def test_a_count_that_is_none_has_a_place_and_the_words() -> None:
    text, spans = unmarked("renderTargets: {a: {api: vulkan, sampleCount: ⟦3⟧}}")
    (found,) = read(text).problems
    assert found.span == spans[0]
    assert found.message.startswith("`sampleCount` must be one of 1, 2, 4, 8, 16, kCount1, ")


MARKED = """\
frame: {width: 1080, height: 2400, fps: 60}
device: adreno-740
renderTargets:
  main:
    api: vulkan
    onscreen: true
    depthFormat: kD24UnormS8Uint
    sampleCount: 4
    colorAttachmentConfig:
      loadAction: ⟦kClear⟧
      storeAction: ⟦kStoreAndMultisampleResolve⟧
    stencilAttachmentConfig: {storageMode: ⟦kDevicePrivate⟧, storeAction: ⟦kStore⟧}
"""


def test_findings_stand_at_the_members_of_the_shorthand(tmp_path: Path) -> None:
    text, (load, store, storage, depth) = unmarked(MARKED)
    (tmp_path / "a.msaa.yaml").write_text(text, encoding="utf-8")
    found = lint(str(tmp_path / "a.msaa.yaml"), isolated=True).findings
    assert sorted((each.rule, each.span) for each in found) == sorted(
        [
            ("resolve-target-loaded", load),
            ("multisampled-attachment-stored", store),
            ("transient-needs-memory", store),
            ("multisampled-image-not-transient", storage),
            ("multisampled-depth-stored", depth),
            ("multisampled-stencil-stored", depth),
        ]
    )
    assert all(each.price is not None for each in found if each.rule.startswith("multisampled-"))


def test_the_expansion_has_the_same_findings(tmp_path: Path) -> None:
    text, _ = unmarked(MARKED)
    (tmp_path / "a.msaa.yaml").write_text(text, encoding="utf-8")
    made = run(tmp_path, "convert", "a.msaa.yaml")
    (tmp_path / "b.msaa.yaml").write_text(made.stdout, encoding="utf-8")
    assert "renderTargets" not in made.stdout
    assert max(map(len, made.stdout.splitlines())) <= 140
    assert told(tmp_path / "a.msaa.yaml") == told(tmp_path / "b.msaa.yaml")


def test_the_expansion_costs_the_same(tmp_path: Path) -> None:
    text, _ = unmarked(MARKED)
    (tmp_path / "a.msaa.yaml").write_text(text, encoding="utf-8")
    assert run(tmp_path, "convert", "a.msaa.yaml", "-o", "b.msaa.yaml").returncode == 0
    costs = []
    for name in ("a.msaa.yaml", "b.msaa.yaml"):
        done = run(tmp_path, "cost", "--output", "json", name)
        costs.append(json.loads(re.sub(r'"(file|line|column)": [^,}\n]+', r'"\1": 0', done.stdout)))
    assert costs[0] == costs[1]
    # Colour and depth with stencil, 4 samples each of 4 bytes, and the picture: 1080 * 2400 * 60 Hz
    # * 36 B.
    assert costs[0]["total"]["write_mb_per_s"] == pytest.approx(1080 * 2400 * 60 * 36 / 1e6)


def test_a_folders_file_is_told_by_the_section(tmp_path: Path) -> None:
    (tmp_path / "targets.yaml").write_text(
        "renderTargets: {a: {api: vulkan, sampleCount: 8}}\n", encoding="utf-8"
    )
    assert "sample-count-above-four" in {
        each.rule for each in lint(str(tmp_path), isolated=True).findings
    }


def told(path: Path) -> list[tuple[str, str, str]]:
    return sorted(
        (each.rule, each.severity, each.message) for each in lint(str(path), isolated=True).findings
    )


def fixed(tmp_path: Path, text: str, *arguments: str) -> tuple[str, list[dict[str, Any]]]:
    """A description after `check --fix`, and what is still found."""
    path = tmp_path / "a.msaa.yaml"
    path.write_text(text, encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", "--fix", *arguments, "--output", "json", str(path))
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return path.read_text(encoding="utf-8"), found


def test_fixes_are_in_the_words_of_the_shorthand(tmp_path: Path) -> None:
    text, _ = unmarked(MARKED)
    safe = text.replace("kStoreAndMultisampleResolve", "kMultisampleResolve").replace(
        "kStore}", "kDontCare}"
    )
    made, left = fixed(tmp_path, text)
    assert made == safe
    assert [
        (each["rule"], each["fixable"], each["fix"]["title"], each["fix"]["shown"]) for each in left
    ] == [
        ("resolve-target-loaded", False, "set loadOp to DONT_CARE", True),
        ("multisampled-image-not-transient", True, "storageMode: kDeviceTransient", False),
    ]
    made, left = fixed(tmp_path, text, "--unsafe-fixes")
    assert made == safe.replace("kDevicePrivate", "kDeviceTransient")
    assert [each["rule"] for each in left] == ["resolve-target-loaded"]


def test_a_fix_that_no_word_of_the_shorthand_makes_is_shown_and_never_made(tmp_path: Path) -> None:
    # The samples would have to be cleared, and the resolved picture not: the engine has one word
    # for both.
    text = (
        "renderTargets: {a: {api: vulkan, sampleCount: 4, enableStencil: false, "
        "colorAttachmentConfig: {loadAction: kClear}}}\n"
    )
    made, (left,) = fixed(tmp_path, text, "--unsafe-fixes")
    assert made == text
    assert (left["rule"], left["fix"]["shown"]) == ("resolve-target-loaded", True)


@pytest.mark.parametrize(
    "stencil",
    [
        "{storageMode: kDeviceTransient, storeAction: &s kStore}}\n  b: {api: vulkan, "
        "stencilAttachmentConfig: {storeAction: *s}}",
        "&s {storageMode: kDeviceTransient, storeAction: kStore}}\n  b: {api: vulkan, "
        "stencilAttachmentConfig: *s}",
    ],
)
def test_a_word_that_others_share_is_left_alone(tmp_path: Path, stencil: str) -> None:
    text = (
        f"renderTargets:\n  a: {{api: vulkan, sampleCount: 4, depthFormat: kD24UnormS8Uint, "
        f"stencilAttachmentConfig: {stencil}\n"
    )
    made, left = fixed(tmp_path, text, "--unsafe-fixes")
    assert made == text
    assert "multisampled-depth-stored" in [each["rule"] for each in left]


def test_depth_that_is_loaded_from_nothing_is_no_safe_fixs(tmp_path: Path) -> None:
    # The engine begins depth in UNDEFINED, whatever it loads.
    config = "{storageMode: kDevicePrivate, loadAction: kLoad, storeAction: kStore}"
    text = (
        f"renderTargets: {{a: {{api: vulkan, sampleCount: 4, depthFormat: kD24UnormS8Uint, "
        f"stencilAttachmentConfig: {config}}}}}\n"
    )
    made, left = fixed(tmp_path, text)
    assert made == text
    assert [each["fix"]["title"] for each in left if each["rule"] == "load-from-undefined"] == [
        "loadAction: kDontCare"
    ] * 2
    # Nor one of a kind that only tells of the next mistake: without the load, nothing reads what is
    # stored.
    made, _ = fixed(tmp_path, text, "--unsafe-fixes")
    assert made == text


def test_suppressions_work_in_the_shorthand(tmp_path: Path) -> None:
    text, _ = unmarked(MARKED)
    path = tmp_path / "a.msaa.yaml"
    path.write_text(
        text.replace(
            "kClear\n", "kClear  # msaa-lint: ignore[resolve-target-loaded] the engine's own\n"
        ),
        encoding="utf-8",
    )
    result = lint(str(path), isolated=True)
    assert "resolve-target-loaded" not in [each.rule for each in result.findings]
    assert [each.finding.rule for each in result.suppressed] == ["resolve-target-loaded"]


def test_convert_tells_mistakes_and_where(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text("renderTargets:\n  a: {api: vulcan}\n", encoding="utf-8")
    made = run(tmp_path, "convert", "a.yaml")
    assert (made.returncode, made.stdout) == (2, "")
    assert (
        made.stderr
        == "msaa-lint: a.yaml:2:12: `api` must be vulkan or metal, found `vulcan`; did you mean "
        "`vulkan`? (MSAA903)\n"
    )


def test_convert_of_a_stream_has_every_document(tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(
        "renderTargets: {a: {api: vulkan}}\n---\nimages: {b: {samples: 4}}\n", encoding="utf-8"
    )
    command = ["convert", "a.yaml", "-o", "out.yaml"]
    assert run(tmp_path, *command).returncode == 0
    text = (tmp_path / "out.yaml").read_text(encoding="utf-8")
    assert re.findall(r"^(?:---|images:)$", text, re.MULTILINE) == ["images:", "---", "images:"]
    again = run(tmp_path, *command)
    assert again.returncode == 2
    assert "already exists" in again.stderr


def test_hostile_names_and_many_targets() -> None:
    made = read(
        "renderTargets:\n"
        + "".join(f'  "{n} ]: #\\u2028": {{api: vulkan, sampleCount: 4}}\n' for n in range(256))
    )
    assert made.problems == ()
    assert made.tree is not None
    again = read(emit(made.tree))
    assert again.problems == ()
    assert list(again.description.images) == list(made.description.images)
    assert read("renderTargets: {}").problems == ()


def test_there_are_at_most_so_many_targets() -> None:
    (problem,) = read(
        "renderTargets:\n" + "".join(f"  t{n}: {{api: vulkan}}\n" for n in range(5000))
    ).problems
    assert (problem.code, problem.message, problem.path) == (
        "MSAA903",
        "at most 256 render targets are allowed",
        "renderTargets.t256",
    )
