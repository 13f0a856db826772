"""The exact edits that changes make in texts."""

from __future__ import annotations

import json

import pytest

from msaa_lint.core.text.edits import apply
from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.linter.fixes.changes import Change, NoFix
from msaa_lint.linter.fixes.context import FixContext
from msaa_lint.linter.fixes.layout import CollectionEditor
from msaa_lint.linter.fixes.text_edits import TextEditor
from msaa_lint.linter.fixes.text_scanner import TextScanner
from tests.linter.fixes.linting import fix_findings, lint, rules
from tests.paths import ROOT

DATA = ROOT / "tests" / "data"


def changed(text: str, *changes: tuple[str, str, str, object]) -> str:
    """A text after changes, each the path of a record, a member, an action and a value; or the
    reason why not.
    """
    (document,) = lint(text).documents
    made = [
        Change(_record(document.document.description, path), member, action, value)
        for path, member, action, value in changes
    ]
    try:
        return apply(text, TextEditor(document.document).edits(made))
    except NoFix as error:
        return f"refused: {error}"


def _record(record: object, path: str) -> object:
    for step in path.split("."):
        if isinstance(record, dict):
            record = record[step]
        elif isinstance(record, tuple):
            record = next(
                each
                for n, each in enumerate(record)
                if getattr(each, "key", "") == step or str(n) == step
            )
        elif step:
            record = getattr(record, step)
    return record


SET = ("images.a", "tiling", "set", "OPTIMAL")
ADD = ("images.a", "usage", "add", "TRANSIENT_ATTACHMENT")
REMOVE = ("images.a", "usage", "remove", "SAMPLED")
UNSET = ("images.a", "tiling", "unset", None)


@pytest.mark.parametrize(
    ("before", "change", "after"),
    [
        # A scalar keeps its quotes, its spelling, its anchor and its tag.
        ("images: {a: {tiling: LINEAR}}", SET, "images: {a: {tiling: OPTIMAL}}"),
        ("images: {a: {tiling: 'LINEAR'}}", SET, "images: {a: {tiling: 'OPTIMAL'}}"),
        ('{"images":{"a":{"tiling":"LINEAR"}}}', SET, '{"images":{"a":{"tiling":"OPTIMAL"}}}'),
        (
            "images: {a: {tiling: VK_IMAGE_TILING_LINEAR}}",
            SET,
            "images: {a: {tiling: VK_IMAGE_TILING_OPTIMAL}}",
        ),
        (
            "images: {a: {tiling: IMAGE_TILING_LINEAR}}",
            SET,
            "images: {a: {tiling: IMAGE_TILING_OPTIMAL}}",
        ),
        (
            "images:\n  a:\n    tiling:   &t !!str LINEAR   # why\n",
            SET,
            "images:\n  a:\n    tiling:   &t !!str OPTIMAL   # why\n",
        ),
        (
            "images:\n  a:\n    tiling:\n      LINEAR\n",
            SET,
            "images:\n  a:\n    tiling:\n      OPTIMAL\n",
        ),
        (
            "images:\n  a:\n    tiling: |-\n      LINEAR\n",
            SET,
            "refused: the value is a block scalar",
        ),
        (
            "images: {a: {samples: SAMPLE_COUNT_8}}",
            ("images.a", "samples", "set", 4),
            "images: {a: {samples: SAMPLE_COUNT_4}}",
        ),
        (
            'images: {a: {samples: "8"}}',
            ("images.a", "samples", "set", 4),
            'images: {a: {samples: "4"}}',
        ),
        (
            "pipelines: {p: {multisampleState: {sampleShadingEnable: True}}}",
            ("pipelines.p.multisampleState", "sampleShadingEnable", "set", False),
            "pipelines: {p: {multisampleState: {sampleShadingEnable: False}}}",
        ),
        # A missing member: behind the one before it in Vulkan's structure, else at the end.
        (
            "images: {a: {imageType: 2D, flags: []}}",
            SET,
            "images: {a: {imageType: 2D, tiling: OPTIMAL, flags: []}}",
        ),
        (
            "images: {a: {arrayLayers: 1}}",
            ("images.a", "imageType", "set", "2D"),
            "images: {a: {arrayLayers: 1, imageType: 2D}}",
        ),
        ("images: {a: {}}", SET, "images: {a: {tiling: OPTIMAL}}"),
        ("images: {a: { } }", SET, "images: {a: {tiling: OPTIMAL } }"),
        ("images: {a: {flags: [],}}", SET, "images: {a: {flags: [], tiling: OPTIMAL,}}"),
        (
            '{"images":{"a":{"format":"R8_UNORM"}}}',
            SET,
            '{"images":{"a":{"format":"R8_UNORM","tiling":"OPTIMAL"}}}',
        ),
        (
            '{"images": {"a": {"format": "R8_UNORM"}}}',
            SET,
            '{"images": {"a": {"format": "R8_UNORM", "tiling": "OPTIMAL"}}}',
        ),
        (
            "images: {a: {format: VK_FORMAT_R8_UNORM}}",
            SET,
            "images: {a: {format: VK_FORMAT_R8_UNORM, tiling: VK_IMAGE_TILING_OPTIMAL}}",
        ),
        (
            "images: {a: {format: 'R8_UNORM'}}",
            SET,
            "images: {a: {format: 'R8_UNORM', tiling: 'OPTIMAL'}}",
        ),
        (
            "images:\n  a:\n    format: R8_UNORM\n",
            SET,
            "images:\n  a:\n    format: R8_UNORM\n    tiling: OPTIMAL\n",
        ),
        (
            "images:\n  a:\n    format: R8_UNORM",
            SET,
            "images:\n  a:\n    format: R8_UNORM\n    tiling: OPTIMAL",
        ),
        (
            "images:\r\n  a:\r\n    format: R8_UNORM # f\r\n",
            SET,
            "images:\r\n  a:\r\n    format: R8_UNORM # f\r\n    tiling: OPTIMAL\r\n",
        ),
        (
            "images:\n  a:\n    usage:\n      - SAMPLED\n# b\n  b: {}\n",
            SET,
            "images:\n  a:\n    usage:\n      - SAMPLED\n    tiling: OPTIMAL\n# b\n  b: {}\n",
        ),
        (
            "images:\n  a: {\n    format: R8_UNORM  # f\n  }\n",
            SET,
            "images:\n  a: {\n    format: R8_UNORM,  # f\n    tiling: OPTIMAL\n  }\n",
        ),
        (
            "images:\n  a: {\n    format: R8_UNORM,  # f\n  }\n",
            SET,
            "images:\n  a: {\n    format: R8_UNORM,  # f\n    tiling: OPTIMAL,\n  }\n",
        ),
        (
            "images:\n  a: {\n    format: R8_UNORM }\n",
            SET,
            "images:\n  a: {\n    format: R8_UNORM, tiling: OPTIMAL }\n",
        ),
        ("images:\n  ? a\n  : {}\n", SET, "images:\n  ? a\n  : {tiling: OPTIMAL}\n"),
        # Flags.
        (
            "images: {a: {usage: [SAMPLED]}}",
            ADD,
            "images: {a: {usage: [SAMPLED, TRANSIENT_ATTACHMENT]}}",
        ),
        ("images: {a: {usage: []}}", ADD, "images: {a: {usage: [TRANSIENT_ATTACHMENT]}}"),
        ("images: {a: {usage: 0}}", ADD, "images: {a: {usage: [TRANSIENT_ATTACHMENT]}}"),
        (
            "images: {a: {samples: 4}}",
            ADD,
            "images: {a: {samples: 4, usage: [TRANSIENT_ATTACHMENT]}}",
        ),
        (
            "images: {a: {usage: SAMPLED}}",
            ADD,
            "images: {a: {usage: SAMPLED | TRANSIENT_ATTACHMENT}}",
        ),
        (
            "images: {a: {usage: SAMPLED|STORAGE}}",
            ADD,
            "images: {a: {usage: SAMPLED|STORAGE|TRANSIENT_ATTACHMENT}}",
        ),
        (
            "images: {a: {usage: 'VK_IMAGE_USAGE_SAMPLED_BIT'}}",
            ADD,
            "images: {a: {usage: 'VK_IMAGE_USAGE_SAMPLED_BIT | "
            "VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT'}}",
        ),
        (
            'images: {a: {usage: ["SAMPLED_BIT"]}}',
            ADD,
            'images: {a: {usage: ["SAMPLED_BIT", "TRANSIENT_ATTACHMENT_BIT"]}}',
        ),
        (
            "images:\n  a:\n    usage:\n    - SAMPLED # s\n",
            ADD,
            "images:\n  a:\n    usage:\n    - SAMPLED # s\n    - TRANSIENT_ATTACHMENT\n",
        ),
        ("images: {a: {usage: [STORAGE, SAMPLED]}}", REMOVE, "images: {a: {usage: [STORAGE]}}"),
        ("images: {a: {usage: [SAMPLED, STORAGE]}}", REMOVE, "images: {a: {usage: [STORAGE]}}"),
        ("images: {a: {usage: [STORAGE, SAMPLED,]}}", REMOVE, "images: {a: {usage: [STORAGE,]}}"),
        ("images: {a: {usage: [SAMPLED]}}", REMOVE, "images: {a: {usage: []}}"),
        ("images: {a: {usage: SAMPLED}}", REMOVE, "images: {a: {usage: []}}"),
        ("images: {a: {usage: STORAGE | SAMPLED}}", REMOVE, "images: {a: {usage: STORAGE}}"),
        (
            "images:\n  a:\n    usage:\n      - SAMPLED  # why\n      - STORAGE\n",
            REMOVE,
            "images:\n  a:\n    usage:\n      # why\n      - STORAGE\n",
        ),
        (
            "images:\n  a:\n    usage:\n      - STORAGE\n      - SAMPLED",
            REMOVE,
            "images:\n  a:\n    usage:\n      - STORAGE",
        ),
        (
            "images:\n  a:\n    usage: # u\n      - SAMPLED\n",
            REMOVE,
            "images:\n  a:\n    usage: [] # u\n",
        ),
        (
            "images: {a: {usage: [\n  STORAGE,\n  SAMPLED\n]}}",
            REMOVE,
            "images: {a: {usage: [\n  STORAGE\n]}}",
        ),
        (
            "images: {a: {usage: [\n  STORAGE,\n  SAMPLED, # s\n]}}",
            REMOVE,
            "images: {a: {usage: [\n  STORAGE,\n  # s\n]}}",
        ),
        (
            "images: {a: {usage: [STORAGE, # s\n  SAMPLED]}}",
            REMOVE,
            "refused: a comment stands between the entries",
        ),
        # A member that goes.
        (
            "images: {a: {format: R8_UNORM, tiling: LINEAR}}",
            UNSET,
            "images: {a: {format: R8_UNORM}}",
        ),
        (
            "images:\n  a:\n    tiling: LINEAR # t\n    format: R8_UNORM\n",
            UNSET,
            "images:\n  a:\n    # t\n    format: R8_UNORM\n",
        ),
        ("images: {a: {tiling: LINEAR}}", UNSET, "refused: no entry would remain"),
    ],
)
def test_edits(before: str, change: tuple[str, str, str, object], after: str) -> None:
    assert changed(before, change) == after


def test_added_flag_replaces_a_removed_one() -> None:
    assert (
        changed("images: {a: {usage: [SAMPLED, STORAGE]}}", REMOVE, ADD)
        == "images: {a: {usage: [TRANSIENT_ATTACHMENT, STORAGE]}}"
    )
    assert (
        changed("images: {a: {usage: SAMPLED | STORAGE}}", REMOVE, ADD)
        == "images: {a: {usage: TRANSIENT_ATTACHMENT | STORAGE}}"
    )


def test_several_flags_are_removed_at_once() -> None:
    gone = [("images.a", "usage", "remove", name) for name in ("SAMPLED", "STORAGE")]
    assert (
        changed("images: {a: {usage: [TRANSFER_SRC, SAMPLED,  STORAGE]}}", *gone)
        == "images: {a: {usage: [TRANSFER_SRC]}}"
    )
    assert (
        changed("images: {a: {usage: [SAMPLED,  TRANSFER_SRC, STORAGE]}}", *gone)
        == "images: {a: {usage: [TRANSFER_SRC]}}"
    )
    assert (
        changed("images: {a: {usage: [SAMPLED, STORAGE]}}", *gone)
        == "refused: no entry would remain"
    )


def test_several_members_are_added_at_once() -> None:
    both = (("images.a", "tiling", "set", "OPTIMAL"), ("images.a", "samples", "set", 4))
    assert (
        changed("images: {a: {usage: []}}", *both)
        == "images: {a: {usage: [], samples: 4, tiling: OPTIMAL}}"
    )
    assert (
        changed("images:\n  a:\n    usage: []\n", *both)
        == "images:\n  a:\n    usage: []\n    samples: 4\n    tiling: OPTIMAL\n"
    )


A = "renderPasses.p.attachments.a"
STORE = (A, "storeOp", "set", "DONT_CARE")
SHARED = "an anchor shares this structure with others"


@pytest.mark.parametrize(
    ("attachments", "change", "after"),
    [
        # An alias makes way for the value; what it named stays.
        (
            "b: {storeOp: &s STORE}, a: {storeOp: *s}",
            STORE,
            "b: {storeOp: &s STORE}, a: {storeOp: DONT_CARE}",
        ),
        (
            "a: {storeOp: &s STORE}, b: {storeOp: *s}",
            STORE,
            "refused: an anchor shares the value of this `storeOp` with other members",
        ),
        # Of a mapping that is merged, the member is stated beside the merge.
        (
            "b: &b {storeOp: STORE}, a: {<<: *b}",
            STORE,
            "b: &b {storeOp: STORE}, a: {storeOp: DONT_CARE, <<: *b}",
        ),
        (
            "b: &b {storeOp: STORE}, a: {<<: *b, loadOp: CLEAR}",
            STORE,
            "b: &b {storeOp: STORE}, a: {<<: *b, loadOp: CLEAR, storeOp: DONT_CARE}",
        ),
        (
            "a: &b {storeOp: STORE}, b: {<<: *b}",
            STORE,
            "refused: an anchor shares this `storeOp` with other structures",
        ),
        # Of a mapping that is an alias as a whole, a merge takes its place.
        (
            "b: &b {storeOp: STORE}, a: *b",
            STORE,
            "b: &b {storeOp: STORE}, a: {<<: *b, storeOp: DONT_CARE}",
        ),
        (
            "b: &b {storeOp: STORE}, a: *b",
            (A, "samples", "set", 4),
            "b: &b {storeOp: STORE}, a: {<<: *b, samples: 4}",
        ),
        ("a: &b {storeOp: STORE}, b: *b", (A, "samples", "set", 4), f"refused: {SHARED}"),
    ],
)
def test_anchors(attachments: str, change: tuple[str, str, str, object], after: str) -> None:
    before = f"renderPasses: {{p: {{attachments: {{{attachments}}}}}}}"
    expected = (
        after
        if after.startswith("refused")
        else f"renderPasses: {{p: {{attachments: {{{after}}}}}}}"
    )
    assert changed(before, change) == expected


def test_shared_text_is_edited_if_all_request_the_same() -> None:
    before = "renderPasses: {p: {attachments: {a: &b {storeOp: STORE}, b: *b, c: {<<: *b}}}}"
    stores = [
        (f"renderPasses.p.attachments.{name}", "storeOp", "set", "DONT_CARE") for name in "abc"
    ]
    assert changed(before, *stores) == before.replace("STORE", "DONT_CARE")
    assert (
        changed(before, *stores[:2])
        == "refused: an anchor shares this `storeOp` with other structures"
    )
    values = "renderPasses: {p: {attachments: {a: {storeOp: &s STORE}, b: {storeOp: *s}}}}"
    assert changed(values, *stores[:2]) == values.replace("STORE", "DONT_CARE")


def test_pass_given_by_an_alias() -> None:
    before = "renderPasses: {p: &p {attachments: {a: {storeOp: STORE}}}, q: *p}"
    assert changed(before, STORE).startswith("refused")
    both = [(f"renderPasses.{name}.attachments.a", "storeOp", "set", "DONT_CARE") for name in "pq"]
    assert changed(before, *both) == before.replace("STORE", "DONT_CARE")


ALIASED = """\
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4}
  out: {format: R8G8B8A8_UNORM, samples: 1}
renderPasses:
  one:
    attachments: &two
      color: &color {image: ms, loadOp: CLEAR, storeOp: STORE}    # in both
      output: {image: out, loadOp: DONT_CARE, storeOp: STORE}
    subpasses: &drawn
      - {colorAttachments: [color], resolveAttachments: [output]}
  two: {attachments: *two, subpasses: *drawn}
commands:
  - beginRenderPass: {renderPass: one}
  - endRenderPass
  - beginRenderPass: {renderPass: two}
  - endRenderPass
  - present: {image: out}
"""


def test_finding_of_two_passes_is_fixed_for_both() -> None:
    done = fix_findings(ALIASED)
    assert rules(done.fixed_findings) == ["multisampled-attachment-stored"]
    assert done.text == ALIASED.replace("CLEAR, storeOp: STORE", "CLEAR, storeOp: DONT_CARE")


def test_shared_store_that_one_pass_needs_stays() -> None:
    """Pass two loads what pass one stores; nothing reads its own store."""
    read = ALIASED.replace(
        "  two: {attachments: *two,",
        "  two: {attachments: {color: {<<: *color, loadOp: LOAD}, output: {image: out}},",
    )
    done = fix_findings(read)
    assert rules(done.fixed_findings) == ["multisampled-attachment-stored"]
    assert done.text == read.replace(
        "{<<: *color, loadOp: LOAD}", "{<<: *color, loadOp: LOAD, storeOp: DONT_CARE}"
    )


def test_vulkan_sc_json() -> None:
    text = (DATA / "vulkan_sc_renderpass2.json").read_text(encoding="utf-8")
    assert fix_findings(text).text == text
    done = fix_findings(text, True)
    assert rules(done.fixed_findings) == ["depth-averaged", "load-from-undefined"]
    lines = zip(text.splitlines(keepends=True), done.text.splitlines(keepends=True), strict=True)
    assert [(one.strip(), other.strip()) for one, other in lines if one != other] == [
        (
            '"stencilLoadOp" : "VK_ATTACHMENT_LOAD_OP_LOAD",',
            '"stencilLoadOp" : "VK_ATTACHMENT_LOAD_OP_DONT_CARE",',
        ),
        (
            '"depthResolveMode" : "VK_RESOLVE_MODE_AVERAGE_BIT",',
            '"depthResolveMode" : "VK_RESOLVE_MODE_SAMPLE_ZERO_BIT",',
        ),
    ]


def test_removed_pointer_of_a_dump_is_null() -> None:
    text = (DATA / "vulkan_sc_renderpass.json").read_text(encoding="utf-8")
    done = fix_findings(text, True)
    assert rules(done.fixed_findings) == [
        "multisampled-attachment-stored",
        "sample-mask-drops-samples",
        "sample-shading-ineffective",
    ]
    assert '"sampleShadingEnable" : "VK_FALSE",' in done.text
    assert "0x7" not in done.text
    assert done.text.count('"NULL"') == text.count('"NULL"') + 1


@pytest.mark.parametrize(
    ("written", "after"),
    [
        ("0", "1"),
        ('"0"', '"1"'),
        ('"VK_ATTACHMENT_STORE_OP_STORE"', '"VK_ATTACHMENT_STORE_OP_DONT_CARE"'),
        ('"STORE"', '"DONT_CARE"'),
    ],
)
def test_numeric_enumerants_of_a_dump(written: str, after: str) -> None:
    text = json.dumps(
        {
            "GraphicsPipelineState": {
                "Renderpass": {"pAttachments": [{"storeOp": "X", "samples": 4}]}
            }
        }
    ).replace('"X"', written)
    (document,) = lint(text).documents
    record = document.document.description.renderPasses["Renderpass"].attachments[0]
    edits = TextEditor(document.document).edits([Change(record, "storeOp", "set", "DONT_CARE")])
    assert apply(text, edits) == text.replace(written, after, 1)


@pytest.mark.parametrize(
    ("mask", "after"),
    [
        ("0", "64"),
        ('"0x4"', '"0x44"'),
        (
            '"VK_IMAGE_USAGE_SAMPLED_BIT"',
            '"VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT"',
        ),
    ],
)
def test_flags_of_a_dump(mask: str, after: str) -> None:
    from msaa_lint.core.text.span import Span
    from msaa_lint.frame.description.bind import Binder
    from msaa_lint.frame.description.document import Document
    from msaa_lint.frame.description.models import Description

    text = f'{{"images": {{"a": {{"usage": {mask}}}}}}}'
    (root,) = parse(Source("", text), Limits()).documents
    description = Binder(dumped=True).record(Description, root, "", "", Span(0, 0))
    document = Document(Source("", text), description, (), whole=False)
    edits = TextEditor(document).edits(
        [Change(description.images["a"], "usage", "add", "TRANSIENT_ATTACHMENT")]
    )
    assert apply(text, edits) == text.replace(mask, after, 1)


def test_items_with_comments_between_are_not_removed() -> None:
    text = "[a, # 1\n b, c]"
    (root,) = parse(Source("", text), Limits()).documents
    with pytest.raises(NoFix):
        CollectionEditor(TextScanner(Source("", text), root), root).remove([1, 2])
    clean = "[a,   b, c , d]"
    (root,) = parse(Source("", clean), Limits()).documents
    edits = CollectionEditor(TextScanner(Source("", clean), root), root).remove([1, 2])
    assert apply(clean, edits) == "[a , d]"


def test_context_builds_the_frame_once() -> None:
    (document,) = lint(ALIASED).documents
    context = FixContext(document.document)
    assert context.frame is context.frame


@pytest.mark.parametrize("comment", ["", "      # to be read\n"])
@pytest.mark.parametrize("line", ["\n", "\r\n"])
def test_insertion_after_a_removed_line(line: str, comment: str) -> None:
    """The last item of a list that ends a structure is removed, and a member is inserted after that
    list.
    """
    before = f"""\
device: apple-a15
metal:
  textures:
    color:
      pixelFormat: rgba8Unorm
      sampleCount: 4
      usage:
      - renderTarget
{comment}      - shaderRead
    drawable: {{pixelFormat: rgba8Unorm, drawable: true}}
  renderPasses:
    main:
      colorAttachments: [{{texture: color, resolveTexture: drawable, loadAction: clear, storeAction: multisampleResolve}}]
  commands: [{{renderPass: main}}, {{present: drawable}}]
"""
    done = fix_findings(before.replace("\n", line), unsafe=True)
    assert [found.rule for found in done.fixed_findings] == ["metal-usage-blocks-memoryless"]
    moved = before.replace("      - shaderRead\n", "").replace(
        "- renderTarget\n", "- renderTarget\n      storageMode: memoryless\n"
    )
    assert (
        done.text.replace(line, "\n").replace("# to be read", "").split()
        == moved.replace("# to be read", "").split()
    )
    assert done.text.count("# to be read") == bool(comment)
