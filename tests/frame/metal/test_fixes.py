"""Fixes of frames in Metal's words: Metal's words are written as the text has them, and Vulkan's
never.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.core.text.edits import apply
from msaa_lint.frame.description.models import MetalRecord
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.linter.fixes.changes import Change, NoFix, StructuralChange, apply_temporarily
from msaa_lint.linter.fixes.context import FixContext
from msaa_lint.linter.fixes.planning import plan
from msaa_lint.linter.fixes.text_edits import TextEditor
from msaa_lint.linter.rules.rule import FixSpec, Setting
from tests.command import run
from tests.frame.metal.frames import ARTICLE, BEST, document
from tests.linter.fixes.linting import fix_findings, kinds, lint

SPELLINGS = {
    "store": "MTLStoreActionStore",
    "storeAndMultisampleResolve": "MTLStoreActionStoreAndMultisampleResolve",
    "[renderTarget, shaderRead]": "[MTLTextureUsageRenderTarget, MTLTextureUsageShaderRead]",
    "private": "MTLStorageModePrivate",
}


def respelled(text: str, form: str) -> str:
    for short, long in SPELLINGS.items():
        words = (
            long
            if form == "MTL"
            else f".{short}"
            if short[0] != "["
            else "[.renderTarget, .shaderRead]"
        )
        text = text.replace(f": {short}}}", f": {words}}}").replace(f": {short},", f": {words},")
    return text


def test_all_fixes_make_the_article_the_best_practice(tmp_path: Path) -> None:
    (tmp_path / "frame.msaa.yaml").write_text(ARTICLE)
    done = run(tmp_path, "check", ".", "--unsafe-fixes", "--fix")
    assert (tmp_path / "frame.msaa.yaml").read_text() == BEST
    assert done.returncode == 0 and done.stdout.startswith("No findings in 1 file")


@pytest.mark.parametrize(
    ("form", "after"), [("MTL", "MTLStoreActionMultisampleResolve"), (".", ".multisampleResolve")]
)
def test_words_are_spelled_as_they_were(form: str, after: str) -> None:
    text = respelled(ARTICLE, form)
    assert text != ARTICLE
    done = fix_findings(text, True)
    assert done.result.findings == []
    assert f"storeAction: {after}}}" in done.text
    assert ("usage: [MTLTextureUsageRenderTarget], storageMode: MTLStorageModeMemoryless" if form == "MTL" else
            "usage: [.renderTarget], storageMode: .memoryless") in done.text  # fmt: skip
    assert (
        fix_findings(text.replace(", storageMode: .private", ""), True).text.count("storageMode")
        <= 2
    )


@pytest.mark.parametrize("unsafe", [False, True])
@pytest.mark.parametrize(
    "text",
    [
        ARTICLE,
        BEST,
        respelled(ARTICLE, "MTL"),
        respelled(ARTICLE, "."),
        ARTICLE.replace("\n", "\r\n"),
    ],
)
def test_what_is_mended_is_gone_and_nothing_came(text: str, unsafe: bool) -> None:
    before, done = lint(text), fix_findings(text, unsafe)
    after = lint(done.text)
    assert not kinds(after) - kinds(before)
    assert {found.rule for found in done.fixed_findings} == {
        rule for rule, _ in kinds(before) - kinds(after)
    }
    assert not [
        found
        for found in after.findings
        if found.fatal or (found.fix is not None and (found.fix.safe or unsafe))
    ]
    again = fix_findings(done.text, unsafe)
    assert (again.text, again.fixed_findings) == (done.text, ())


def mended(text: str, subject: Subject, spec: FixSpec) -> str:
    """A text with a fix for one of its subjects, or why there is none."""
    read = document(text)
    own = next(
        each for each in subjects(read) if (each.kind, each.path) == (subject.kind, subject.path)
    )
    try:
        return apply(text, TextEditor(read).edits(plan(spec, own, FixContext(read))))
    except NoFix as error:
        return f"refused: {error}"


def subject(text: str, kind: str, path: str) -> Subject:
    return next(
        each for each in subjects(document(text)) if each.kind == kind and each.path.endswith(path)
    )


def setting(fact: str, value: str | bool | int) -> tuple[Setting, ...]:
    return (Setting(fact, value, document(ARTICLE).description.head),)


@pytest.mark.parametrize(
    ("kind", "path", "fact", "value", "before", "after"),
    [
        ("aspect", "colorAttachments[0]", "aspect.store_action", "multisampleResolve",
        "storeAndMulti", "multi"),
        ("aspect", "depthAttachment", "aspect.load_action", "dontCare", "depth, loadAction: clear",
        "depth, loadAction: dontCare"),
        ("aspect", "depthAttachment", "aspect.resolve_filter", "min", "Action: store}", "Action: "
            "store, depthResolveFilter: min}"),
        ("image", "depth", "image.storage_mode", "memoryless", "rget], storageMode: private",
        "rget], storageMode: memoryless"),
        ("image", "depth", "image.samples", 2, "depth32Float, textureType: type2DMultisample, "
            "sampleCount: 4",
         "depth32Float, textureType: type2DMultisample, sampleCount: 2"),
        ("image", "ms", "image.texture_type", "type2D", "r8Unorm, textureType: type2DMultisample",
        "r8Unorm, textureType: type2D"),
        ("pipeline", "opaque", "pipeline.rasterization_samples", 2, "rasterSampleCount: 4",
        "rasterSampleCount: 2"),
        ("pipeline", "opaque", "pipeline.alpha_to_coverage", True, "rasterSampleCount: 4",
         "rasterSampleCount: 4, isAlphaToCoverageEnabled: true"),
        ("image", "drawable", "image.storage_mode", "private", "drawable: true", "drawable: true, "
            "storageMode: private"),
    ],
)  # fmt: skip
def test_what_can_be_set(
    kind: str, path: str, fact: str, value: str | int, before: str, after: str
) -> None:
    written = mended(
        ARTICLE, subject(ARTICLE, kind, path), FixSpec("", "safe", set=setting(fact, value))
    )
    assert ARTICLE.count(before) == 1
    # Where a member is put in comes from the order of Metal's structures, not from the text.
    assert isinstance(written, str) and sorted(written) == sorted(ARTICLE.replace(before, after))
    assert document(written).problems == ()


def test_usage_words_come_and_go() -> None:
    color = subject(ARTICLE, "image", "ms")
    gone = mended(
        ARTICLE,
        color,
        FixSpec("", "safe", remove=setting("image.usage_words", "{image.memoryless_conflicts}")),
    )
    assert gone == ARTICLE.replace("[renderTarget, shaderRead]", "[renderTarget]")
    more = mended(
        ARTICLE, color, FixSpec("", "safe", add=setting("image.usage_words", "pixelFormatView"))
    )
    assert more == ARTICLE.replace(
        "[renderTarget, shaderRead]", "[renderTarget, shaderRead, pixelFormatView]"
    )


VULKANS = [
    (
        "aspect",
        "colorAttachments[0]",
        FixSpec("", "safe", set=setting("aspect.store", "DONT_CARE")),
    ),
    ("aspect", "colorAttachments[0]", FixSpec("", "safe", set=setting("aspect.load", "CLEAR"))),
    ("image", "ms", FixSpec("", "safe", add=setting("image.usage", "TRANSIENT_ATTACHMENT"))),
    ("image", "ms", FixSpec("", "safe", add=setting("image.memory", "LAZILY_ALLOCATED"))),
    ("resolve", "colorAttachments[0]", FixSpec("", "safe", set=setting("resolve.mode", "AVERAGE"))),
    ("image", "ms", FixSpec("", "safe", do="make-transient")),
    ("resolve", "colorAttachments[0]", FixSpec("", "safe", do="drop-resolve")),
]


@pytest.mark.parametrize(("kind", "path", "mend"), VULKANS)
def test_vulkans_words_are_never_written(kind: str, path: str, mend: FixSpec) -> None:
    refused = mended(ARTICLE, subject(ARTICLE, kind, path), mend)
    assert "does not apply" in refused


def test_what_it_was_made_into_is_never_written() -> None:
    read = document(ARTICLE)
    for record, member, value in (
        (read.description.images["ms"], "samples", 2),
        (read.description.renderPasses["forward"].attachments[0], "storeOp", "DONT_CARE"),
        (read.description, "commands", 0),
    ):
        with pytest.raises(NoFix, match="does not apply"):
            TextEditor(read).edits(
                [Change(record, member, "drop" if member == "commands" else "set", value)]
            )


def test_metals_words_are_never_written_into_vulkans() -> None:
    text = "images: {a: {format: R8_UNORM, samples: 4}}"
    for mend in (
        FixSpec("", "safe", set=setting("image.storage_mode", "memoryless")),
        FixSpec("", "safe", do="make-memoryless"),
    ):
        refused = mended(text, subject(text, "image", "a"), mend)
        assert "does not apply" in refused


def test_records_of_metal_are_read_anew() -> None:
    texture = document(ARTICLE).description.metal
    assert isinstance(texture, MetalRecord)
    with (
        pytest.raises(StructuralChange),
        apply_temporarily([Change(texture.textures["ms"], "storageMode", "set", "memoryless")]),
    ):
        pass


READ = "something reads or loads the image, or may do so"
MEMORYLESS = FixSpec("", "safe", do="make-memoryless")


@pytest.mark.parametrize(
    ("replacements", "reason"),
    [
        ({"loadAction: clear, storeAction: storeAnd": "loadAction: load, storeAction: storeAnd"},
        READ),
        ({"    - present": "    - readTexture: {texture: ms, stage: fragment}\n    - present"},
        READ),
        ({"family: apple7": "family: apple1"}, "the GPU does not support memoryless textures"),
        ({"shaderRead]": "pixelFormatView]"}, "`ms` may need its usage pixelFormatView"),
        ({"ms: {": "ms: {drawable: true, "}, "the texture is a drawable"),
        ({"  commands:\n    - renderPass: forward\n    - present: drawable\n": ""}, READ),
    ],
)  # fmt: skip
def test_memoryless_is_refused(replacements: dict[str, str], reason: str) -> None:
    text = ARTICLE
    for before, after in replacements.items():
        text = text.replace(before, after)
    assert mended(text, subject(text, "image", "ms"), MEMORYLESS) == f"refused: {reason}"


def test_memoryless_takes_stores_and_usages_along() -> None:
    for name in ("ms", "depth"):
        text = mended(ARTICLE, subject(ARTICLE, "image", name), MEMORYLESS)
        changed = [
            each
            for each in zip(ARTICLE.splitlines(), text.splitlines(), strict=True)
            if each[0] != each[1]
        ]
        wanted = dict(zip(ARTICLE.splitlines(), BEST.splitlines(), strict=True))
        assert [wanted[before] for before, _ in changed] == [after for _, after in changed]
        assert len(changed) == 2


def test_a_resolve_texture_that_is_not_used_goes() -> None:
    text = ARTICLE.replace("storeAndMultisampleResolve", "store")
    gone = mended(
        text,
        subject(text, "aspect", "colorAttachments[0]"),
        FixSpec("", "safe", do="drop-resolve-texture"),
    )
    assert gone == text.replace(" resolveTexture: drawable,", "")
    kept = mended(
        ARTICLE,
        subject(ARTICLE, "aspect", "colorAttachments[0]"),
        FixSpec("", "safe", do="drop-resolve-texture"),
    )
    assert kept == "refused: the pass resolves to the texture, or may do so"


BLIT = BEST.replace("resolveTexture: drawable", "resolveTexture: between").replace(
    "    drawable: {", "    between: {pixelFormat: r8Unorm, textureType: type2D, storageMode: "
        "private}\n    drawable: {"
).replace("    - present",
"    - copy: {source: between, destination: drawable}\n    - present")  # fmt: skip


def test_a_resolve_that_is_copied_goes_to_the_drawable() -> None:
    (found,) = [each for each in lint(BLIT).findings if each.rule == "metal-resolve-then-blit"]
    assert found.subject == "metal.renderPasses.forward.colorAttachments[0]"
    own = subject(BLIT, "resolve", "colorAttachments[0]")
    assert mended(BLIT, own, FixSpec("", "safe", do="resolve-to-copy")) == BEST
    twice = BLIT.replace(
        "    - present", "    - copy: {source: between, destination: drawable}\n    - present"
    )
    assert (
        mended(twice, own, FixSpec("", "safe", do="resolve-to-copy"))
        == "refused: the result of the resolve is not copied exactly once"
    )


def test_a_word_that_others_take_over_stays() -> None:
    text = ARTICLE.replace(
        "[renderTarget, shaderRead]", "[renderTarget, &read shaderRead]"
    ).replace("drawable: true", "usage: [*read]")
    refused = mended(
        text,
        subject(text, "image", "ms"),
        FixSpec("", "safe", remove=setting("image.usage_words", "shaderRead")),
    )
    assert refused == "refused: an anchor shares one of the flags with other members"
    own = text.replace("[*read]", "[renderTarget]")
    assert mended(
        own,
        subject(own, "image", "ms"),
        FixSpec("", "safe", remove=setting("image.usage_words", "shaderRead")),
    ) == own.replace(", &read shaderRead]", "]")
