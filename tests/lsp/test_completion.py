"""What is offered at a cursor, in complete and incomplete texts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from msaa_lint.cli.lsp.completion import KEY, Completion, complete
from msaa_lint.cli.lsp.file_paths import paths
from msaa_lint.cli.lsp.places import alternatives
from msaa_lint.cli.lsp.view import View
from msaa_lint.frame.description.models import Description
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.description.shapes import Shape

from .views import at, engine


def items(
    text: str, kind: str = "description", snippets: bool = False, folder: Path | None = None
) -> tuple[str, dict[str, Completion]]:
    text, offset = at(text)
    view = View(
        text, kind, None, engine().registry, folder=str(folder) if folder is not None else None
    )
    return text, {item.label: item for item in complete(view, offset, snippets)}


def accepted(text: str, label: str, snippets: bool = False) -> str:
    """The text with a completion accepted."""
    text, found = items(text, snippets=snippets)
    item = found[label]
    return text[: item.start] + item.text + text[item.end :]


FRAME = """\
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
  color: {format: R8G8B8A8_UNORM, samples: 1}
  "a: b": {format: D32_SFLOAT}
renderPasses:
  forward:
    attachments:
      source: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE}
      target: {image: color, loadOp: DONT_CARE, storeOp: STORE}
    subpasses:
      - colorAttachments: [source]
"""


def test_keys_that_are_stated_are_not_offered() -> None:
    _, found = items(FRAME.replace("samples: 1}", "samples: 1, ^}"))
    assert (
        "usage" in found
        and "format" not in found
        and "samples" not in found
        and "loadOp" not in found
    )


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (("      source: {image", "      s^\n      source: {image"), None),
        (
            ("    subpasses:\n", "    dep^\n    subpasses:\n"),
            "    dependencies: \n    subpasses:\n",
        ),
        (("    subpasses:\n", "    ^\n    subpasses:\n"), "    dependencies: \n    subpasses:\n"),
        (
            ("- colorAttachments: [source]\n", "- colorAttachments: [source]\n        res^\n"),
            "        resolveAttachments: \n",
        ),
        (("- colorAttachments: [source]\n", "- ^\n"), "      - resolveAttachments: \n"),
        (("storeOp: STORE}", "storeOp: STORE, fin^"), "storeOp: STORE, finalLayout: \n"),
    ],
)
def test_keys(before: tuple[str, str], after: str | None) -> None:
    text = FRAME.replace(*before, 1)
    if after is None:
        assert "source" not in items(text)[1]
    else:
        label = after.strip("\n -,:").split("\n")[0].split(", ")[-1].strip(" -:")
        assert after in accepted(text, label)


@pytest.mark.parametrize(
    ("text", "label", "after"),
    [
        ("pipelines:\n  a:\n    r^", "rendering", "    rendering:\n      $0"),
        ("renderPasses:\n  a:\n    s^", "subpasses", "    subpasses:\n      - $0"),
        ("images: {a: {u^}}", "usage", "images: {a: {usage: [$0]}}"),
        ("images: {a: {e^}}", "extent", "images: {a: {extent: {$0}}}"),
        ('{"images": {"a": {"e^"}}}', "extent", '{"images": {"a": {"extent": {$0}}}}'),
        ('{"images": {"a": {"e^" "samples": 4}}}', None, ""),
        (
            '{"images": {"a": {"e^"\n "samples": 4}}}',
            "extent",
            '{"images": {"a": {"extent": {$0},\n "samples": 4}}}',
        ),
        ('{"commands": [\n^\n]}', "draw", '{"commands": [\n{"draw": {$0}}\n]}'),
        ('{"commands": ["n^"]}', "nextSubpass", '{"commands": ["nextSubpass"]}'),
        ('{"commands": [{"d^"}]}', "draw", '{"commands": [{"draw": {$0}}]}'),
        ("frame: {width: 1, ^\nimages: {}", "height", "frame: {width: 1, height: $0\nimages: {}"),
        ("commands:\n  - d^", "draw", "commands:\n  - draw:\n      $0"),
        ("commands:\n  - n^", "nextSubpass", "commands:\n  - nextSubpass"),
    ],
)
def test_snippets(text: str, label: str | None, after: str) -> None:
    if label is None:
        assert not items(text, snippets=True)[1]
    else:
        assert accepted(text, label, snippets=True).endswith(after)


@pytest.mark.parametrize(
    ("text", "expected", "other"),
    [
        (FRAME.replace("loadOp: CLEAR", "loadOp: ^"), {"LOAD", "CLEAR", "DONT_CARE"}, "STORE"),
        (FRAME.replace("loadOp: CLEAR", "loadOp: C^LEAR"), {"LOAD", "CLEAR", "DONT_CARE"}, "STORE"),
        (FRAME.replace("samples: 1", "samples: ^"), {"1", "2", "4", "64"}, "3"),
        (FRAME.replace("{image: color,", "{image: ^,"), {"color", "color_ms", "a: b"}, "source"),
        (FRAME.replace("[source]", "[^]"), {"source", "target", "null"}, "color_ms"),
        (FRAME.replace("[source]", "[so^"), {"source", "target", "null"}, "color_ms"),
        (
            FRAME.replace("usage: [COLOR_ATTACHMENT]", "usage: [COLOR_ATTACHMENT, ^]"),
            {"SAMPLED", "TRANSIENT_ATTACHMENT"},
            "COLOR_ATTACHMENT",
        ),
        (
            FRAME.replace("usage: [COLOR_ATTACHMENT]", "usage: COLOR_ATTACHMENT | ^"),
            {"SAMPLED"},
            "LOAD",
        ),
        (f"device: ^\n{FRAME}", {"mali-g76"}, "arm"),
        (f"scene: {{edges: ^}}\n{FRAME}", {"true", "false"}, "LDR"),
        (f"scene: {{color: ^}}\n{FRAME}", {"LDR", "HDR"}, "true"),
        (f"{FRAME}pipelines: {{p: {{renderPass: ^}}}}", {"forward"}, "color"),
        (f"{FRAME}pipelines: {{p: {{renderPass: forward, subpass: ^}}}}", {"0"}, "1"),
        (f"{FRAME}pipelines: {{p: {{}}}}\ncommands:\n  - draw: {{pipeline: ^}}", {"p"}, "forward"),
        (
            f"{FRAME}commands:\n  - beginRenderPass: {{renderPass: ^\n  - endRenderPass",
            {"forward"},
            "color",
        ),
        ("device: {tile: {^}}", {"model", "kind", "colorBytes", "gmemBytes"}, "mali"),
        ("device: {tile: {model: mali-g76, ^}}", {"kind"}, "model"),
        ("device: {tile: {model: ^}}", {"mali-g76", "adreno-740"}, "adreno"),
        ("device: {tile: {kind: ^}}", {"mali", "adreno"}, "mali-g76"),
        ("device: {compression: {4: 1.0, ^}}", {"1 read", "1 write", "8"}, "4"),
        ("enabled: {apiVersion: ^}", {"1.2", "1.4"}, "true"),
        ("enabled: {extensions: [^]}", {"VK_KHR_depth_stencil_resolve"}, "sampleRateShading"),
        ("metal: {textures: {t: {pixelFormat: ^}}}", {"bgra8Unorm"}, "R8G8B8A8_UNORM"),
    ],
)
def test_values(text: str, expected: set[str], other: str) -> None:
    _, found = items(text)
    assert expected <= found.keys()
    assert other not in found


@pytest.mark.parametrize(
    ("text", "label"),
    [
        (
            "images:\n  a: {format: VK_FORMAT_D16_UNORM}\n  b: {tiling: ^}",
            "VK_IMAGE_TILING_OPTIMAL",
        ),
        (
            "images:\n  a: {usage: [VK_IMAGE_USAGE_SAMPLED_BIT]}\n  b: {usage: [^]}",
            "VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT",
        ),
        (
            "images:\n  a: {samples: VK_SAMPLE_COUNT_4_BIT}\n  b: {samples: ^}",
            "VK_SAMPLE_COUNT_2_BIT",
        ),
        (
            "metal: {renderPasses: {p: {depthAttachment: {loadAction: .clear, storeAction: ^}}}}",
            ".dontCare",
        ),
        (
            "metal: {renderPasses: {p: {depthAttachment: {loadAction: MTLLoadActionClear, "
            "storeAction: ^}}}}",
            "MTLStoreActionDontCare",
        ),
    ],
)
def test_enumerants_are_spelled_as_in_the_text(text: str, label: str) -> None:
    assert label in items(text)[1]


def test_names_are_quoted_where_they_need_it() -> None:
    assert '{image: "a: b",' in accepted(FRAME.replace("{image: color,", "{image: ^,"), "a: b")
    assert '"image": "a"' in accepted(
        '{"images": {"a": {}}, "commands": [{"present": {"image": ^}}]}', "a"
    )


def test_a_flag_alone_becomes_a_list() -> None:
    assert "usage: [SAMPLED]}" in accepted("images: {a: {usage: ^}}", "SAMPLED")


def test_the_rest_of_a_text_with_errors_is_still_known() -> None:
    broken = FRAME.replace("  color: {format", "  color {format")
    assert "color_ms" in items(broken.replace("{image: color,", "{image: ^,"))[1]
    assert "target" in items(broken.replace("[source]", "[^"))[1]


def test_a_name_that_is_used_and_not_defined_is_offered() -> None:
    text = FRAME.replace("image: color,", "image: resolved,").replace(
        "  color: {", "  ^\n  color: {"
    )
    assert "\n  resolved: \n  color: {" in accepted(text, "resolved")


def test_every_key_has_documentation() -> None:
    assert all(item.member is not None for item in items("^")[1].values())
    assert "renderPasses" in items("^")[1]


@pytest.mark.parametrize(
    ("text", "kind", "expected"),
    [
        ("a: 1 # msaa-lint: ^", "description", "ignore"),
        ("a: 1 # msaa-lint: ignore[^", "description", "sample-count-above-four"),
        ("a: 1 # msaa-lint: ignore[MSAA101, ^]", "description", "MSAA102"),
        ("int a; // msaa-lint: ignore[^]", "code", "MSAA102"),
        ("^", "configuration", "select"),
        ('select = ["^"]', "configuration", "MSAA102"),
        ("fail-on = ^", "configuration", "warning"),
        ('profile = "^"', "configuration", "mali-g76"),
        ("[severity]\n^", "configuration", "MSAA102"),
        ('[severity]\nMSAA102 = "^"', "configuration", "off"),
        ("[limits]\n^", "configuration", "depth"),
        ("[tool.msaa-lint]\n^", "configuration", "select"),
        ("[tool.msaa-lint.severity]\nMSAA102 = '^'", "configuration", "off"),
        ("---\n^\n---\n", "rule", "severity"),
        ("---\nseverity: ^\n---\n", "rule", "warning"),
        ("---\nsubject: image\nwhen: image.^\n---\n", "rule", "image.samples"),
    ],
)
def test_comments_configuration_and_rule_pages(text: str, kind: str, expected: str) -> None:
    assert expected in items(text, kind)[1]


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in (
        "shaders/a.frag.spv",
        "shaders/deep/b.frag",
        "base.toml",
        "pages/r.md",
        "reports/gpu.json",
        ".hidden/c.spv",
        "build.txt",
    ):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    return tmp_path


@pytest.mark.parametrize(
    ("text", "kind", "expected"),
    [
        (
            "pipelines: {p: {stages: [{stage: FRAGMENT, module: ^}]}}",
            "description",
            ["shaders/a.frag.spv", "shaders/deep/b.frag"],
        ),
        (
            "pipelines: {p: {stages: [{module: shaders/de^}]}}",
            "description",
            ["shaders/a.frag.spv", "shaders/deep/b.frag"],
        ),
        ("device: ./r^", "description", ["reports/gpu.json"]),
        ("extends = '^'", "configuration", ["base.toml"]),
        ("rules = ['pages/^']", "configuration", ["pages/r.md"]),
        ("baseline = ^", "configuration", ["reports/gpu.json"]),
        ("profile = 'reports/^'", "configuration", ["reports/gpu.json"]),
    ],
)
def test_files(folder: Path, text: str, kind: str, expected: list[str]) -> None:
    without, found = items(text, kind, folder=folder)
    assert list(found) == expected
    item = found[expected[-1]]
    after = without[: item.start] + item.text + without[item.end :]
    assert expected[-1] in after and not any(
        part in after for part in ("de/", "pages/pages", "shaders/shaders", "./r")
    )


def test_files_of_a_large_folder_are_bounded(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert paths(str(folder), (".spv", ".frag")) == ["shaders/a.frag.spv", "shaders/deep/b.frag"]
    (folder / "link").symlink_to(folder / "shaders")
    assert paths(str(folder), (".spv",)) == ["shaders/a.frag.spv"]
    monkeypatch.setattr("msaa_lint.cli.lsp.file_paths.MAX_ENTRIES", 3)
    assert len(paths(str(folder), ("",))) <= 3
    assert paths(str(folder / "none"), (".spv",)) == []


def leaves(
    kind: type[Record], text: str = "^", seen: frozenset[type[Record]] = frozenset()
) -> Iterator[tuple[str, str, Shape, str]]:
    """The structure and name of each key of the schema that holds no structure, its shape, and a
    text with the cursor in its value.
    """
    if kind in seen:
        return
    for name, shape in kind.SHAPE.items():
        yield from leaves_of(kind, name, shape, text.replace("^", f"{{{name}: ^}}"), seen | {kind})


def leaves_of(
    kind: type[Record], name: str, shape: Shape, text: str, seen: frozenset[type[Record]]
) -> Iterator[tuple[str, str, Shape, str]]:
    for each in alternatives(shape):
        if each[0] in ("record", "command"):
            yield from leaves(each[1], text, seen)
        elif each[0] == "list":
            yield from leaves_of(kind, name, each[1], text.replace("^", "[^]"), seen)
        elif each[0] in ("map", "numbered"):
            yield from leaves_of(kind, name, each[1], text.replace("^", "{0: ^}"), seen)
        else:
            yield kind.__name__, name, each, text


FREE_KINDS = {"int", "number", "share"}
FREE_MEMBERS = {"label", "name", "pNext", "tile", "compression"}
"""What a person chooses, and unread structures. The entries of `tile` and `compression` have their
own test: values depend on keys.
"""

NAMED = (
    "images: {i: {}}\nrenderPasses: {r: {attachments: {a: {}}, subpasses: [{}]}}\n"
    "framebuffers: {f: {}}\npipelines: {p: {}}\n"
)
METAL = "metal: {textures: {t: {}}, renderPasses: {q: {}}, renderPipelines: {s: {}}}\n"


def test_every_enumerable_value_is_completed(folder: Path) -> None:
    """No key of the schema that holds a word, a flag, a name, or a file is without completions."""
    missing, count = set(), 0
    for kind, name, shape, text in leaves(Description):
        if shape[0] in FREE_KINDS or name in FREE_MEMBERS:
            continue
        count += 1
        head, _, tail = text[1:-1].partition(": ")
        others = "".join(
            line + "\n" for line in (NAMED + METAL).splitlines() if not line.startswith(f"{head}:")
        )
        if head in ("renderPasses", "metal"):
            # The names are those of the same section.
            tail = (
                f"{tail[:-1]}, a: {{attachments: {{a: {{}}}}}}}}"
                if head == "renderPasses"
                else tail
            )
            tail = (
                f"{tail[:-1]}, {METAL[8:-2]}}}"
                if head == "metal" and "textures: " not in tail
                else tail
            )
        if all(
            item.kind == KEY for item in items(f"{others}{head}: {tail}", folder=folder)[1].values()
        ):
            missing.add((kind, name, shape[0]))
    assert count > 150
    assert missing == set()


def test_other_tables_of_a_project_are_left_alone() -> None:
    assert not items('[tool.ruff]\nselect = ["^"]', "configuration")[1]


@pytest.mark.parametrize(
    "text",
    ["# a comm^", "images: {a: {}} # c^", "images: {a: {format: D16_UNORM ^ }}", "images: {a: &^}"],
)
def test_nothing_is_offered_where_nothing_may_stand(text: str) -> None:
    assert not items(text)[1]
