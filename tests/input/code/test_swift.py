"""Metal in Swift: the state of descriptors when textures, passes, and pipelines are created, each
with its location.
"""

from __future__ import annotations

import random
import time
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.source import Source
from msaa_lint.input.code import read
from msaa_lint.input.code.parsing import Code, Read, ascii_only
from msaa_lint.input.readers import description
from tests.input.code.expected import marks, outcome

pytest.importorskip("tree_sitter_swift")

from msaa_lint.input.code.swift.description_trees import trees

PROGRAMS = sorted((Path(__file__).parent / "swift").glob("*.swift"))

MADE = """\
let d = MTLTextureDescriptor()
d.textureType = .type2DMultisample
d.sampleCount = 4
d.usage = .renderTarget
let color = device.makeTexture(descriptor: d)!
"""
PASS = "let pass = MTLRenderPassDescriptor()\npass.colorAttachments[0].texture = color\n"
ENCODED = "let encoder = buffer.makeRenderCommandEncoder(descriptor: pass)!\n"


def found(text: str, fragments: bool = False) -> Read:
    (only,) = trees(Code(ascii_only(text), "swift", fragments))
    return only


def plain(node: Node) -> Any:
    if node.kind == "mapping":
        return {key: plain(value) for key, value in node.value.items()}
    return [plain(item) for item in node.value] if node.kind == "sequence" else node.value


def metal(text: str, fragments: bool = False) -> Any:
    return plain(found(text, fragments).tree)["metal"]


def written(text: str, *path: str) -> tuple[str, str]:
    """Returns the text at the locations of a member's key and value."""
    node = found(text).tree.value["metal"]
    key = node
    for step in path:
        key, node = node.keys.get(step), node.value[step]
    return text[key.start : key.end], text[node.start : node.end]


def color(text: str) -> Any:
    """Returns the first color attachment of the only pass."""
    (only,) = metal(text)["renderPasses"].values()
    return only["colorAttachments"]["0"]


def texture(text: str, name: str = "color") -> Any:
    return metal(text)["textures"][name]


# Programs


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_what_a_program_says(program: Path) -> None:
    held = outcome(program)
    assert held.false == ()
    assert held.missed == ()


def test_there_are_programs_of_both_kinds() -> None:
    marked = [bool(marks(program.read_text(encoding="utf-8"))) for program in PROGRAMS]
    assert sum(marked) >= 8
    assert len(marked) - sum(marked) >= 5


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_a_tree_is_a_description_without_mistakes(program: Path) -> None:
    source = Source(program.name, program.read_text(encoding="utf-8"))
    for each in trees(Code(ascii_only(source.text), "swift")):
        assert description.read(source, each.tree).problems == ()


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda program: program.name)
def test_every_place_is_in_the_source(program: Path) -> None:
    text = program.read_text(encoding="utf-8")
    for each in trees(Code(ascii_only(text), "swift")):
        waiting = [each.tree]
        while waiting:
            node = waiting.pop()
            assert 0 <= node.start < node.end <= len(text)
            waiting.extend(node.keys.values())
            waiting.extend(
                node.value.values()
                if node.kind == "mapping"
                else node.value
                if node.kind == "sequence"
                else ()
            )


# Textures


def test_a_texture_and_its_places() -> None:
    text = MADE + "d.sampleCount = 2\n"
    assert texture(text) == {
        "textureType": "type2DMultisample",
        "sampleCount": 4,
        "usage": ["renderTarget"],
    }
    assert written(text, "textures", "color", "sampleCount") == ("4", "4")
    assert written(text, "textures", "color", "usage") == (".renderTarget", ".renderTarget")


def test_a_descriptor_that_is_used_again() -> None:
    text = (
        MADE + "d.pixelFormat = .depth32Float\nd.usage.insert(.shaderRead)\nlet depth = "
        "device.makeTexture(descriptor: d)!\n"
    )
    assert "pixelFormat" not in texture(text)
    assert texture(text, "depth")["pixelFormat"] == "depth32Float"
    assert texture(text, "depth")["usage"] == ["renderTarget", "shaderRead"]


def test_the_class_function_of_a_descriptor() -> None:
    text = (
        "let d = MTLTextureDescriptor.texture2DDescriptor(pixelFormat: .rgba8Unorm, width: 16, "
        "height: 2 * 8, mipmapped: false)\n"
        "let color = device.makeTexture(descriptor: d)\n"
    )
    assert texture(text) == {
        "pixelFormat": "rgba8Unorm",
        "width": 16,
        "height": 16,
        "mipmapLevelCount": 1,
        "textureType": "type2D",
        "sampleCount": 1,
    }
    assert written(text, "textures", "color", "pixelFormat") == (".rgba8Unorm", ".rgba8Unorm")


@pytest.mark.parametrize(
    "binding",
    [
        "guard let color = device.makeTexture(descriptor: d) else { return }",
        "if let color = device.makeTexture(descriptor: d) { use(color) }",
        "self.color = device.makeTexture(descriptor: d)!",
        "color = try make(d)",
        "let color: MTLTexture = { device.makeTexture(descriptor: d)! }()",
        "let made = device.makeTexture(descriptor: d)!\nself.color = made",
        "guard let made = device.makeTexture(descriptor: d) else { throw Failure.texture }\ncolor "
        "= made",
    ],
)
def test_what_a_texture_is_called(binding: str) -> None:
    body = MADE.rpartition("let color")[0]
    text = (
        "class A { var color: MTLTexture!\nfunc make(_ d: MTLTextureDescriptor) throws -> "
        "MTLTexture {\n"
        f"return device.makeTexture(descriptor: d)!\n}}\nfunc f() throws {{\n{body}{binding}\n}}\n"
        f"}}\n"
    )
    assert list(metal(text)["textures"]) == ["color"]


def test_two_of_one_name() -> None:
    one = (
        "class {} {{ var t: MTLTexture!\nfunc make() {{\nlet d = MTLTextureDescriptor()\n"
        "d.sampleCount = {}\n"
        "d.textureType = .type2DMultisample\nt = gpu.makeTexture(descriptor: d)\n}} }}\n"
    )
    textures = metal(one.format("A", 4) + one.format("B", 2))["textures"]
    assert {name: members["sampleCount"] for name, members in textures.items()} == {
        "A.t": 4,
        "B.t": 2,
    }


def test_a_function_that_makes_textures_makes_one_for_each_call() -> None:
    text = (
        "class A {\nvar color: MTLTexture!\nvar depth: MTLTexture!\n"
        "func make(_ format: MTLPixelFormat, samples: Int = 4) -> MTLTexture? {\nlet d = "
        "MTLTextureDescriptor()\nd.pixelFormat = format\n"
        "d.sampleCount = samples\nif samples > 1 { d.textureType = .type2DMultisample }\nreturn "
        "device.makeTexture(descriptor: d)\n}\n"
        "func resize() {\ncolor = make(.rgba8Unorm)\ndepth = make(.depth32Float, samples: 2)\n}\n"
        "}\n"
    )
    assert metal(text)["textures"] == {
        "color": {
            "pixelFormat": "rgba8Unorm",
            "textureType": "type2DMultisample",
            "sampleCount": 4,
        },
        "depth": {
            "pixelFormat": "depth32Float",
            "textureType": "type2DMultisample",
            "sampleCount": 2,
        },
    }


@pytest.mark.parametrize(
    ("usage", "read_as"),
    [
        ("[.renderTarget, .shaderRead]", ["renderTarget", "shaderRead"]),
        ("[.renderTarget, .unknown]", ["renderTarget"]),
        (".unknown", None),
        ("[]", None),
        ("MTLTextureUsage.shaderWrite", ["shaderWrite"]),
        (
            "MTLTextureUsage(rawValue: MTLTextureUsage.renderTarget.rawValue | "
            "MTLTextureUsage.shaderRead.rawValue)",
            ["renderTarget", "shaderRead"],
        ),
        ("settings.usage", None),
        ("[.renderTarget, extra]", None),
    ],
)
def test_usage(usage: str, read_as: list[str] | None) -> None:
    assert texture(MADE.replace("= .renderTarget", f"= {usage}")).get("usage") == read_as


@pytest.mark.parametrize(
    ("count", "read_as"),
    [
        ("let n = 8\n", 8),
        ("enum Count: Int { case two = 2, eight = 8 }\nlet n = Count.eight.rawValue\n", 8),
        ("struct S { static let samples = 2 }\nlet n = S.samples\n", 2),
        ("let n = device.supportsTextureSampleCount(4) ? 4 : 1\n", 4),
        ("let n = max(2, 1)\n", 2),
        ("let n = Int(2)\n", 2),
        ("let n = settings.high ? 4 : 1\n", 4),
        ("let n = settings.high ? 8 : 4\n", 4),
    ],
)
def test_a_count_that_is_known(count: str, read_as: int) -> None:
    text = count + MADE.replace("sampleCount = 4", "sampleCount = n")
    assert texture(text)["sampleCount"] == read_as
    assert found(text).assumed == ()


@pytest.mark.parametrize(
    ("count", "name", "place"),
    [
        ("settings.count", "`settings.count`", "count"),
        ("Int(samples)", "`samples`", "samples"),
        ("view.sampleCount", "`view.sampleCount`", "sampleCount"),
        (
            "[8, 4].first { ok($0) }",
            "the sample count of `color`",
            "d.sampleCount = [8, 4].first { ok($0) }",
        ),
    ],
)
def test_a_count_that_is_assumed(count: str, name: str, place: str) -> None:
    text = MADE.replace("sampleCount = 4", f"sampleCount = {count}")
    assert texture(text)["sampleCount"] == 4
    ((what, at, value),) = found(text).assumed
    assert (what, text[at.start : at.end], value) == (name, place, "4")


def test_a_count_that_is_not_even_assumed() -> None:
    text = MADE.replace("sampleCount = 4", "sampleCount = settings.count")
    text = text.replace("d.textureType = .type2DMultisample\n", "")
    assert texture(text) == {"usage": ["renderTarget"]}
    assert found(text).assumed == ()


def test_a_descriptor_that_other_code_changes() -> None:
    assert (
        metal(MADE.replace("let color", "pool.configure(d)\nlet color") + PASS)["textures"]["color"]
        == {}
    )


def test_what_is_set_after_other_code_is_known() -> None:
    text = MADE.replace("d.usage", "pool.configure(d)\nd.pixelFormat = .rgba8Unorm\nd.usage")
    assert texture(text) == {"pixelFormat": "rgba8Unorm", "usage": ["renderTarget"]}


def test_a_function_that_another_calls_runs_there_alone() -> None:
    """Also if other types have functions with the caller's name."""
    text = (
        "class A {\nvar color: MTLTexture!\nfunc resize() {\n"
        + MADE.replace("let color", "color")
        + "}\n"
        "func draw() {\nresize()\nfor mesh in meshes { mesh.draw() }\n}\n}\n"
    )
    assert list(metal(text)["textures"]) == ["color"]


def test_a_texture_that_is_made_again_is_one() -> None:
    body = MADE.replace("let color", "color")
    text = (
        "class A {\nvar color: MTLTexture!\nfunc build(_ w: Int) {\n"
        + body.replace("d.usage", "d.width = w\nd.usage")
        + "}\n"
        "init() { build(1) }\nfunc resize() { build(2) }\nfunc other() {\n"
        + body.replace("= .renderTarget", "= [.renderTarget, .shaderRead]")
        + "}\nfunc draw(b: MTLCommandBuffer) {\n"
        + PASS
        + ENCODED.replace("buffer", "b")
        + "}\n}\n"
    )
    assert metal(text)["textures"] == {
        "color": {"textureType": "type2DMultisample", "sampleCount": 4}
    }
    assert color(text)["texture"] == "color"


def test_textures_that_change_places_are_two() -> None:
    body = MADE.replace(
        "let color = device.makeTexture(descriptor: d)!",
        "a = device.makeTexture(descriptor: d)\nb = device.makeTexture(descriptor: d)",
    )
    text = (
        "class A {\nvar a: MTLTexture!\nvar b: MTLTexture!\nvar current: MTLTexture!\ninit() {\n"
        + body
        + "current = a\n}\n"
        "func swap() { current = b }\nfunc draw(b: MTLCommandBuffer) {\n"
        + PASS.replace("= color", "= current")
        + ENCODED
        + "}\n}\n"
    )
    assert sorted(metal(text)["textures"]) == ["a", "b", "current"]


def test_a_function_in_a_function() -> None:
    text = (
        "func all() {\nfunc make(_ format: MTLPixelFormat, samples: Int = 4) -> MTLTexture {\n"
        + MADE.replace("= 4", "= samples").replace("let color", "d.pixelFormat = format\nlet made")
        + "return made\n}\nlet color = make(.rgba8Unorm)\nlet depth = make(.depth32Float, samples: "
        "2)\nuse(color, depth)\n}\n"
    )
    textures = metal(text)["textures"]
    assert {
        name: (made["pixelFormat"], made["sampleCount"]) for name, made in textures.items()
    } == {
        "color": ("rgba8Unorm", 4),
        "depth": ("depth32Float", 2),
    }


def test_a_descriptor_that_other_code_begins() -> None:
    text = MADE.replace("let d = MTLTextureDescriptor()\n", "let desc = pool.descriptor()\n")
    text = text.replace("\nd.", "\ndesc.").replace(": d)", ": desc)")
    assert texture(text) == {
        "textureType": "type2DMultisample",
        "sampleCount": 4,
        "usage": ["renderTarget"],
    }


# Conditions


def test_branches_that_agree_and_branches_that_do_not() -> None:
    text = MADE.replace(
        "let color",
        "if big { d.width = 64\nd.height = 32 } else { d.width = 64\nd.height = 16 }\nif small { "
        "d.arrayLength = 2 }\nlet color",
    )
    assert texture(text) == {
        "width": 64,
        "textureType": "type2DMultisample",
        "sampleCount": 4,
        "usage": ["renderTarget"],
    }


@pytest.mark.parametrize(
    "condition",
    [
        "samples > 1",
        "1 < samples",
        "samples != 1",
        "useMSAA",
        "device.supportsTextureSampleCount(4)",
        "!(samples == 1)",
        "setting.isHigh",
        "let t = msaa",
    ],
)
def test_the_world_with_multisampling(condition: str) -> None:
    text = (
        f"func f(samples: Int) {{\nlet pass = MTLRenderPassDescriptor()\nif {condition} {{\n"
        "pass.colorAttachments[0].texture = msaa\n"
        "pass.colorAttachments[0].resolveTexture = plain\npass.colorAttachments[0].storeAction = "
        ".multisampleResolve\n} else {\n"
        "pass.colorAttachments[0].texture = plain\npass.colorAttachments[0].storeAction = .store\n"
        "}\n"
        "use(pass)\n}\n"
    )
    assert color(text) == {
        "texture": "msaa",
        "resolveTexture": "plain",
        "storeAction": "multisampleResolve",
    }


def test_the_same_words_go_the_same_way() -> None:
    """Everything set under the same condition belongs to the same configuration, even if a branch
    alone does not mention multisampling.
    """
    text = (
        MADE
        + PASS
        + (
            "if quality == .high { pass.colorAttachments[0].resolveTexture = plain } else { "
            "other() }\n"
            "pass.colorAttachments[0].storeAction = quality == .high ? .multisampleResolve : "
            ".store\n"
            "if quality == .high { pass.colorAttachments[0].loadAction = .clear } else { "
            "pass.colorAttachments[0].loadAction = .load }\n"
        )
    )
    assert color(text) == {
        "texture": "color",
        "resolveTexture": "plain",
        "loadAction": "clear",
        "storeAction": "multisampleResolve",
    }


def test_platforms_are_alternatives() -> None:
    both = (
        "#if os(iOS)\nd.storageMode = .memoryless\n#else\nd.storageMode = .private\n#endif\nlet "
        "color"
    )
    assert "storageMode" not in texture(MADE.replace("let color", both) + PASS)
    same = both.replace(".private", ".memoryless").replace(
        "#else", "#elseif os(tvOS)\nd.storageMode = .memoryless\n#else"
    )
    assert texture(MADE.replace("let color", same) + PASS)["storageMode"] == "memoryless"


def test_a_branch_that_leaves_does_not_count() -> None:
    text = (
        MADE
        + PASS
        + (
            "if broken {\npass.colorAttachments[0].storeAction = .dontCare\nreturn\n}\n"
            "if worse { fatalError() } else { pass.colorAttachments[0].loadAction = .clear }\n"
            "guard ready else { pass.colorAttachments[0].loadAction = .load\nreturn }\n"
        )
    )
    assert color("func f() {\n" + text + "use(pass)\n}") == {
        "texture": "color",
        "loadAction": "clear",
    }


def test_cases_of_a_switch() -> None:
    text = (
        "var samples = 1\nvar many = 1\nswitch q {\ncase .low: samples = 1\nmany = 1\ncase .high: "
        "samples = 4\nmany = 2\n"
        "default: samples = 1\nmany = 4\n}\n" + MADE.replace("= 4", "= samples")
    )
    assert texture(text)["sampleCount"] == 4
    assert found(text).assumed == ()
    many = text.replace("sampleCount = samples", "sampleCount = many")
    assert texture(many)["sampleCount"] == 4
    assert texture(many.replace("many = 4", "many = 1"))["sampleCount"] == 2


def test_a_guard_by_the_device() -> None:
    text = (
        "func f() {\nguard device.supportsTextureSampleCount(8) else { return }\n"
        + MADE.replace("= 4", "= 8")
        + "}"
    )
    assert metal(text)["supportedSampleCounts"] == [1, 2, 4, 8]
    assert "supportedSampleCounts" not in metal(text.replace("(8)", "(4)"))
    family = "func f() {\nguard device.supportsFamily(.apple6) else { return }\n" + MADE + "}"
    assert metal(family)["family"] == "apple6"


# Passes


def test_a_pass_is_what_it_was_when_it_was_encoded() -> None:
    text = MADE + PASS + ENCODED + "pass.colorAttachments[0].storeAction = .store\n"
    assert color(text) == {"texture": "color", "loadAction": "dontCare", "storeAction": "store"}
    again = text.replace(
        ENCODED, "pass.colorAttachments[0].storeAction = .dontCare\n" + ENCODED
    ) + ENCODED.replace("encoder", "second", 1)
    passes = metal(again)["renderPasses"]
    assert [each["colorAttachments"]["0"]["storeAction"] for each in passes.values()] == [
        "dontCare",
        "store",
    ]
    assert list(passes) == ["pass", "pass 2"]


def test_defaults_are_those_of_an_encoded_pass_alone() -> None:
    """Other code may complete a descriptor that is passed on; a fragment states what it is
    about.
    """
    assert color(MADE + PASS + "use(pass)\n") == {"texture": "color"}
    fragment = metal(MADE + PASS + ENCODED, fragments=True)
    assert fragment["renderPasses"]["pass"] == {"colorAttachments": {"0": {"texture": "color"}}}
    depth = "let pass = MTLRenderPassDescriptor()\npass.depthAttachment.texture = color\n" + ENCODED
    assert metal(MADE + depth)["renderPasses"]["pass"] == {
        "depthAttachment": {"texture": "color", "loadAction": "clear", "storeAction": "dontCare"}
    }


@pytest.mark.parametrize(
    "way",
    [
        "pass.colorAttachments[0].storeAction = .multisampleResolve",
        "pass.colorAttachments[0]!.storeAction = MTLStoreAction.multisampleResolve",
        "pass.colorAttachments[0]?.storeAction = .multisampleResolve",
        "if let a = pass.colorAttachments[0] { a.storeAction = .multisampleResolve }",
        "guard let a = pass.colorAttachments[0] else { return }\na.storeAction = "
        ".multisampleResolve",
        "let a = pass.colorAttachments[0]!\na.storeAction = .multisampleResolve",
        "let all = pass.colorAttachments\nall[0]!.storeAction = .multisampleResolve",
        "finish(pass, .multisampleResolve)",
        "set(pass.colorAttachments[0], to: .multisampleResolve)",
        "pass.end(.multisampleResolve)",
        "let a: MTLStoreAction = .multisampleResolve\npass.colorAttachments[0].storeAction = a",
        "queue.sync { pass.colorAttachments[0].storeAction = .multisampleResolve }",
        "do { pass.colorAttachments[0].storeAction = .multisampleResolve } catch {}",
    ],
)
def test_ways_to_an_attachment(way: str) -> None:
    text = (
        "func finish(_ p: MTLRenderPassDescriptor, _ s: MTLStoreAction) { "
        "p.colorAttachments[0].storeAction = s }\n"
        "func set(_ a: MTLRenderPassColorAttachmentDescriptor, to s: MTLStoreAction) { "
        "a.storeAction = s }\n"
        "extension MTLRenderPassDescriptor { func end(_ s: MTLStoreAction) { "
        "colorAttachments[0].storeAction = s } }\n"
        f"func f() {{\n{MADE}{PASS}pass.colorAttachments[0].resolveTexture = drawable.texture\n"
        f"{way}\nuse(pass)\n}}\n"
    )
    assert color(text) == {
        "texture": "color",
        "resolveTexture": "drawable",
        "storeAction": "multisampleResolve",
    }


def test_depth_and_stencil() -> None:
    text = MADE + (
        "let pass = MTLRenderPassDescriptor()\nif let depth = pass.depthAttachment {\n"
        "depth.texture = color\n"
        "depth.resolveTexture = shadow\ndepth.depthResolveFilter = .min\ndepth.storeAction = "
        ".multisampleResolve\n}\n"
        "pass.stencilAttachment.texture = color\npass.stencilAttachment.storeAction = .dontCare\n"
        "use(pass)\n"
    )
    assert metal(text)["renderPasses"]["pass"] == {
        "depthAttachment": {
            "texture": "color",
            "resolveTexture": "shadow",
            "storeAction": "multisampleResolve",
            "depthResolveFilter": "min",
        },
        "stencilAttachment": {"texture": "color", "storeAction": "dontCare"},
    }


@pytest.mark.parametrize("index", ["i", "count - 1", "99"])
def test_an_attachment_of_an_unknown_index_leaves_the_others_unknown(index: str) -> None:
    text = (
        MADE + PASS + "pass.colorAttachments[0].loadAction = .clear\n"
        f"pass.colorAttachments[{index}].loadAction = .load\n" + ENCODED
    )
    assert color(text) == {"texture": "color"}


def test_a_resolve_texture_that_may_be_none() -> None:
    text = (
        MADE
        + PASS
        + "if wanted { pass.colorAttachments[0].label = 1 } else { pass.colorAttachments[0].label "
        "= 2 }\n"
    )
    assert color(text + "use(pass)") == {"texture": "color"}
    undecided = (
        "switch w {\ncase .a: pass.colorAttachments[0].resolveTexture = plain\n"
        "default: pass.colorAttachments[0].loadAction = .clear\n}\nuse(pass)\n"
    )
    assert color(MADE + PASS + undecided) == {"texture": "color", "resolveTexture": "plain"}
    assert "renderPasses" not in metal(MADE + PASS + undecided.replace("= plain", "= [plain]"))


def test_a_pass_that_is_begun_elsewhere_says_what_is_set_here() -> None:
    text = (
        "func f(pass: MTLRenderPassDescriptor, t: MTLTexture) {\n"
        "pass.colorAttachments[0].texture = t\n%s}\n"
    )
    assert "renderPasses" not in metal(MADE + text % "")
    assert color(MADE + text % "pass.colorAttachments[0].storeAction = .store\n") == {
        "texture": "t",
        "storeAction": "store",
    }
    assert "renderPasses" not in metal(
        MADE + text % "pass.colorAttachments[0].storeAction = .multisampleResolve\n"
    )


@pytest.mark.parametrize(
    ("handed", "known"),
    [
        (ENCODED, True),
        ("use(pass)\n", False),
        ("configure(pass)\n" + ENCODED, False),
        ("pass.configure()\n" + ENCODED, False),
    ],
)
def test_a_resolve_texture_that_other_code_may_give(handed: str, known: bool) -> None:
    text = MADE + PASS + "pass.colorAttachments[0].storeAction = .multisampleResolve\n" + handed
    assert ("renderPasses" in metal(text)) is known


def test_properties_that_several_functions_set() -> None:
    text = (
        "class A {\nlet pass = MTLRenderPassDescriptor()\ninit(t: MTLTexture) { "
        "pass.colorAttachments[0].texture = t\n"
        "pass.colorAttachments[0].loadAction = .clear }\n"
        "func one() { pass.colorAttachments[0].storeAction = .store }\nfunc two() { "
        "pass.colorAttachments[0].storeAction = .dontCare\n%s}\n"
        "func draw(b: MTLCommandBuffer) { b.makeRenderCommandEncoder(descriptor: "
        "pass)!.endEncoding() }\n}\n"
    )
    assert color(MADE + text % "") == {"texture": "t", "loadAction": "clear"}
    own = text.replace(
        "draw(b: MTLCommandBuffer) {",
        "draw(b: MTLCommandBuffer) {\npass.colorAttachments[0].storeAction = .store\n",
    )
    assert color(MADE + own % "")["storeAction"] == "store"


def test_a_copy_of_a_pass() -> None:
    text = (
        MADE
        + PASS
        + (
            "pass.colorAttachments[0].storeAction = .store\n"
            + ENCODED
            + "let next = pass.copy() as! MTLRenderPassDescriptor\n"
            "next.colorAttachments[0].loadAction = .load\n"
            "buffer.makeRenderCommandEncoder(descriptor: next)!.endEncoding()\n"
        )
    )
    passes = metal(text)["renderPasses"]
    assert passes["pass"]["colorAttachments"]["0"] == {
        "texture": "color",
        "loadAction": "dontCare",
        "storeAction": "store",
    }
    assert passes["next"]["colorAttachments"]["0"] == {
        "texture": "color",
        "loadAction": "load",
        "storeAction": "store",
    }


def test_a_parameter_is_the_argument_of_its_calls() -> None:
    text = (
        "final class A {\nfunc build(pass: MTLRenderPassDescriptor, store: MTLStoreAction) {\n"
        "pass.colorAttachments[0].storeAction = store\n}\n"
        f"func go() {{\n{MADE}{PASS}build(pass: pass, store: .dontCare)\nuse(pass)\n}}\n}}\n"
    )
    assert color(text)["storeAction"] == "dontCare"
    alone = (
        "func build(t: MTLTexture, store: MTLStoreAction) {\nlet pass = MTLRenderPassDescriptor()\n"
        "pass.colorAttachments[0].texture = t\npass.colorAttachments[0].storeAction = store\n"
        "use(pass)\n}\n"
    )
    assert color(MADE + alone) == {"texture": "t"}


def test_textures_that_a_tuple_hands_over() -> None:
    """A page creates them in one function and uses them in another, with the same names."""
    text = (
        "func make() -> (ms: MTLTexture, plain: MTLTexture) {\n"
        + MADE
        + "let p = MTLTextureDescriptor()\n"
        "let other = device.makeTexture(descriptor: p)!\nreturn (color, other)\n}\nfunc pass(ms: "
        "MTLTexture, plain: MTLTexture) {\n"
        "let pass = MTLRenderPassDescriptor()\n"
        "pass.colorAttachments[0].texture = ms\npass.colorAttachments[0].resolveTexture = plain\n"
        "use(pass)\n}\n"
    )
    assert color(text) == {"texture": "color", "resolveTexture": "other"}
    assert (
        color(text.replace("pass(ms: MTLTexture, plain", "pass(ms: MTLTexture, second"))["texture"]
        == "ms"
    )


def test_what_is_resolved_has_several_samples() -> None:
    text = (
        "func f(ms: MTLTexture, plain: MTLTexture) {\nlet pass = MTLRenderPassDescriptor()\n"
        "pass.colorAttachments[0].texture = ms\n"
        "pass.colorAttachments[0].resolveTexture = plain\npass.colorAttachments[0].storeAction = "
        ".multisampleResolve\nuse(pass)\n}\n"
    )
    assert metal(text)["textures"] == {"ms": {"sampleCount": 4}, "plain": {}}
    assert [what for what, _, _ in found(text).assumed] == ["the sample count of `ms`"]


def test_samples_that_some_frames_load_may_be_stored() -> None:
    """Whether anything reads the stored samples depends on the load action, so a finding would be a
    guess.
    """
    text = (
        MADE
        + PASS
        + "pass.colorAttachments[0].storeAction = .store\npass.colorAttachments[0].loadAction = "
        "%s\nuse(pass)\n"
    )
    assert color(text % "first ? .clear : .load") == {"texture": "color"}
    assert color(text % "first ? .clear : .dontCare") == {
        "texture": "color",
        "storeAction": "store",
    }
    assert color(text % "action") == {"texture": "color", "storeAction": "store"}
    of_class = (
        "class A {\nvar action: MTLLoadAction\ninit(_ a: MTLLoadAction) { action = a }\n"
        "func again() { action = .load }\n"
    )
    assert color(of_class + "func f() {\n" + text % "action" + "}\n}\n") == {"texture": "color"}


@pytest.mark.parametrize(
    ("declared", "action"), [("let", "dontCare"), ("private var", "dontCare"), ("var", None)]
)
def test_a_property_that_other_files_may_set(declared: str, action: str | None) -> None:
    body = MADE + PASS + "pass.colorAttachments[0].storeAction = action\nuse(pass)\n"
    text = f"class A {{\n{declared} action: MTLStoreAction = .dontCare\nfunc f() {{\n{body}}}\n}}\n"
    assert color(text).get("storeAction") == action


def test_textures_of_a_pass_have_one_count() -> None:
    depth = "pass.depthAttachment.texture = depth\nuse(pass)\n"
    text = MADE.replace("= 4", "= 8") + PASS + depth
    assert metal(text)["textures"]["depth"] == {"sampleCount": 8}
    assert found(text).assumed == ()
    other = (
        "let e = MTLTextureDescriptor()\ne.textureType = .type2DMultisample\ne.sampleCount = "
        "settings.count\n"
    )
    both = (
        MADE.replace("= 4", "= 2")
        + other
        + "let depth = device.makeTexture(descriptor: e)!\n"
        + PASS
        + depth
    )
    assert metal(both)["textures"]["depth"]["sampleCount"] == 2
    assert found(both).assumed == ()
    assert (
        metal(text.replace("sampleCount = 8", "sampleCount = settings.count"))["textures"]["depth"]
        == {}
    )


# MTKView


VIEW = """\
class R: NSObject, MTKViewDelegate {
    func setup(view: MTKView) {
        view.sampleCount = %s
        view.colorPixelFormat = .bgra8Unorm
        view.depthStencilPixelFormat = .depth32Float_stencil8
    }
    func draw(in mtkView: MTKView) {
        guard let pass = mtkView.currentRenderPassDescriptor, let buffer = queue.makeCommandBuffer() else { return }
        %s
        let encoder = buffer.makeRenderCommandEncoder(descriptor: pass)!
        encoder.endEncoding()
        buffer.present(mtkView.currentDrawable!)
    }
}
"""


def test_what_a_view_makes() -> None:
    made = metal(VIEW % ("4", ""))
    samples = {"textureType": "type2DMultisample", "sampleCount": 4}
    assert made["textures"] == {
        "multisampleColorTexture": {"pixelFormat": "bgra8Unorm", **samples},
        "drawable": {"drawable": True, "pixelFormat": "bgra8Unorm"},
        "depthStencilTexture": {"pixelFormat": "depth32Float_stencil8", **samples},
    }
    depth = {"texture": "depthStencilTexture", "loadAction": "clear", "storeAction": "dontCare"}
    assert made["renderPasses"]["pass"] == {
        "colorAttachments": {
            "0": {
                "texture": "multisampleColorTexture",
                "resolveTexture": "drawable",
                "loadAction": "clear",
                "storeAction": "multisampleResolve",
            }
        },
        "depthAttachment": depth,
        "stencilAttachment": depth,
    }
    assert made["commands"] == [{"renderPass": "pass"}, {"present": "drawable"}]


def test_what_is_changed_of_a_view_s_pass() -> None:
    text = VIEW % ("4", "pass.colorAttachments[0].storeAction = .storeAndMultisampleResolve")
    assert color(text)["storeAction"] == "storeAndMultisampleResolve"


@pytest.mark.parametrize("count", ["1", "nil", "settings.count"])
def test_a_view_that_may_have_one_sample_says_nothing(count: str) -> None:
    assert "renderPasses" not in metal(MADE + VIEW % (count, ""))


def test_of_two_views_nothing_is_known() -> None:
    one = "let a = MTKView(frame: .zero)\n"
    assert "renderPasses" in metal(one + VIEW % ("4", ""))
    assert "renderPasses" not in metal(one + "let b = MTKView(frame: .zero)\n" + VIEW % ("4", ""))


# Pipelines


PIPELINE = """\
let p = MTLRenderPipelineDescriptor()
p.rasterSampleCount = %s
p.colorAttachments[0].pixelFormat = .bgra8Unorm
p.colorAttachments[0].isBlendingEnabled = true
p.isAlphaToCoverageEnabled = true
p.depthAttachmentPixelFormat = .depth32Float
let state = try device.makeRenderPipelineState(descriptor: p)
"""


def test_a_pipeline_and_the_pass_that_it_draws_in() -> None:
    text = PIPELINE % "2" + MADE + PASS + ENCODED
    stated = {
        "rasterSampleCount": 2,
        "depthAttachmentPixelFormat": "depth32Float",
        "isAlphaToCoverageEnabled": True,
        "colorAttachments": {"0": {"pixelFormat": "bgra8Unorm", "isBlendingEnabled": True}},
    }
    assert metal(text)["renderPipelines"] == {"state": stated}
    assert metal(text + "encoder.setRenderPipelineState(state)\n")["renderPipelines"] == {
        "state": {"renderPass": "pass", **stated}
    }


def test_a_pipeline_s_descriptor_that_begins_again() -> None:
    text = (
        PIPELINE % "2" + "p.reset()\np.rasterSampleCount = 4\nlet other = try "
        "device.makeRenderPipelineState(descriptor: p)\n"
    )
    assert metal(text)["renderPipelines"]["other"] == {"rasterSampleCount": 4}


def test_a_pipeline_that_states_no_count_has_one_sample() -> None:
    text = (PIPELINE % "2").replace("p.rasterSampleCount = 2\n", "") + MADE + PASS + ENCODED
    drawn = text + "encoder.setRenderPipelineState(state)\n"
    assert "rasterSampleCount" not in metal(text)["renderPipelines"]["state"]
    assert metal(drawn)["renderPipelines"]["state"]["rasterSampleCount"] == 1
    other = drawn.replace("let state", "configure(p)\nlet state")
    assert "rasterSampleCount" not in metal(other)["renderPipelines"]["state"]


def test_a_count_that_is_assumed_is_the_same_everywhere() -> None:
    text = (
        "class A {\nlet samples: Int\nfunc f() throws {\n"
        + MADE.replace("= 4", "= samples")
        + PIPELINE % "samples"
        + "}\n}\n"
    )
    assert metal(text)["renderPipelines"]["state"]["rasterSampleCount"] == 4
    other = metal(text.replace("rasterSampleCount = samples", "rasterSampleCount = other"))
    assert "rasterSampleCount" not in other["renderPipelines"]["state"]


# Frames


FRAME = """\
class R {
    private let color: MTLTexture
    init(device: MTLDevice) {
        let d = MTLTextureDescriptor()
        d.textureType = .type2DMultisample
        d.sampleCount = 4
        d.usage = [.renderTarget, .shaderRead]
        color = device.makeTexture(descriptor: d)!
    }
    func draw(layer: CAMetalLayer) {
        let buffer = queue.makeCommandBuffer()!
        let drawable = layer.nextDrawable()!
        let pass = MTLRenderPassDescriptor()
        pass.colorAttachments[0].texture = color
        pass.colorAttachments[0].storeAction = .store
        buffer.makeRenderCommandEncoder(descriptor: pass)!.endEncoding()
        let last = MTLRenderPassDescriptor()
        last.colorAttachments[0].texture = drawable.texture
        let encoder = buffer.makeRenderCommandEncoder(descriptor: last)!
        encoder.setFragmentTexture(color, index: 0)
        encoder.endEncoding()
        buffer.present(drawable)
    }
}
"""


def test_the_commands_of_a_frame() -> None:
    assert metal(FRAME)["commands"] == [
        {"renderPass": "pass"},
        {"readTexture": {"texture": "color", "stage": "fragment"}},
        {"renderPass": "last"},
        {"present": "drawable"},
    ]
    blit = FRAME.replace(
        "        buffer.present",
        "        blit.copy(from: plain, to: drawable.texture)\n        buffer.present",
    )
    assert {"copy": {"source": "plain", "destination": "drawable"}} in metal(blit)["commands"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("        buffer.present(drawable)\n", ""),
        (
            "        encoder.setF",
            "        if shown { blit.copy(from: color, to: drawable.texture) }\n        "
            "encoder.setF",
        ),
        ("        encoder.setF", "        others.encode(buffer)\n        encoder.setF"),
        ("        encoder.setF", "        others.show(color)\n        encoder.setF"),
        ("    private let color", "    let color"),
        (
            "draw(layer: CAMetalLayer) {\n        let buffer = queue.makeCommandBuffer()!",
            "draw(layer: CAMetalLayer, buffer: MTLCommandBuffer) {",
        ),
        (
            "    func draw",
            "    func other(buffer: MTLCommandBuffer, p: MTLRenderPassDescriptor) {\n"
            "        buffer.makeRenderCommandEncoder(descriptor: p)\n    }\n    func draw",
        ),
    ],
)
def test_a_frame_of_which_something_is_hidden_has_no_commands(old: str, new: str) -> None:
    assert old in FRAME
    assert "commands" not in metal(FRAME.replace(old, new))


def test_the_family_by_what_a_file_imports() -> None:
    phone = "import UIKit\n" + MADE
    assert metal(phone)["family"] == "apple3"
    assert [what for what, _, _ in found(phone).assumed] == ["the GPU family"]
    for other in (
        "import MetalKit\n",
        "import UIKit\nimport AppKit\n",
        "#if canImport(UIKit)\nimport UIKit\n#endif\n",
    ):
        assert "family" not in metal(other + MADE)


# Fragments, and text that is not Swift


PAGE = """\
Prose.

```swift
renderPassDescriptor.colorAttachments[0].texture = msaaTexture
...
renderPassDescriptor.colorAttachments[0].storeAction = .store
```

More, with a r\u00e9sum\u00e9.

```swift
textureDescriptor.textureType = .type2DMultisample
textureDescriptor.sampleCount = 4
let msaaTexture = device.makeTexture(descriptor: textureDescriptor)
```
"""


def test_fragments_of_a_page() -> None:
    text = PAGE
    (document,) = read(Source("page.md", text), "markdown").documents
    assert document.problems == ()
    made = document.tree
    assert made is not None
    section = made.value["metal"].value
    (only,) = plain(section["renderPasses"]).values()
    assert only == {"colorAttachments": {"0": {"texture": "msaaTexture", "storeAction": "store"}}}
    at = section["textures"].value["msaaTexture"].value["sampleCount"]
    assert text[at.start : at.end] == "4"
    assert text.count("\n", 0, at.start) + 1 == 13


@pytest.mark.parametrize(
    "text",
    [
        "",
        "let a = 1\n",
        "func f() {",
        "MTL",
        "let sampleCount = 4",
        "}}}} MTLTextureDescriptor ((((",
        "\x00MTL",
    ],
)
def test_code_that_says_nothing(text: str) -> None:
    assert trees(Code(text, "swift")) == []


HOSTILE = [
    "let x = " + "(" * 20_000,
    "{" * 20_000,
    "func f() {" + "if a {" * 2_000 + "d.sampleCount = 4" + "}" * 2_001,
    "func f() {\nif a { d.sampleCount = 4 }" + " else if b { d.sampleCount = 3 }\n" * 2_000 + "}",
    "func f() {" + "a {" * 2_000 + "}" * 2_001,
    "func f() { f(); f(); g() }\nfunc g() { f(); g() }\nlet h = { h(); h() }\nfunc k() { let q = { "
    "q(); q() }; q() }",
    "".join(f"func f{n}() {{ f{n + 1}(); f{n + 1}(); f{n + 1}() }}\n" for n in range(300)),
    "func f() { a.b" + ".c()" * 2_000 + " }",
    "#if a\n" * 2_000 + "#endif\n" * 1_000,
    "let x = " + "1 + " * 3_000 + "1",
    "func f() { let d = MTLTextureDescriptor()\n" + "d.usage.insert(.shaderRead)\n" * 2_000 + "}",
    "".join(f"func f(a{n}: Int) {{ f(a{n}: 1) }}\n" for n in range(1_500)),
    "func f() {\nlet d = MTLTextureDescriptor()\n"
    + "".join(f"d.m{n} = {n}\nfoo(d)\n" for n in range(1_500))
    + "}",
    "func f() {\nlet z = T("
    + ", ".join(f"a{n}: 1" for n in range(1_500))
    + ")\n"
    + "use(z)\n" * 1_500
    + "}",
    "class A: A { var a: A { a } \n init() { self.init() } }",
    "func f(_ x: Int = f()) { f() }\nlet a = b\nlet b = a",
]


@pytest.mark.parametrize("text", HOSTILE, ids=range(len(HOSTILE)))
def test_hostile_text(text: str) -> None:
    begun = time.process_time()
    trees(Code(MADE + text, "swift"))
    assert time.process_time() - begun < 5


def test_mutated_programs_do_no_harm() -> None:
    chance = random.Random(5)
    texts = [ascii_only(program.read_text(encoding="utf-8")) for program in PROGRAMS]
    for number in range(120):
        letters = list(texts[number % len(texts)])
        for _ in range(chance.choice((1, 4, 30))):
            at = chance.randrange(len(letters))
            letters[at] = chance.choice(
                ["", "{", "}", "(", ")", "[", "]", ".", "?", "!", "=", '"', "#", "\n", "x", "1"]
            )
        text = "".join(letters)
        for each in trees(Code(text, "swift", number % 2 == 0)):
            assert description.read(Source("mutated.swift", text), each.tree) is not None


def test_two_thousand_lines_in_little_time() -> None:
    parts = [program.read_text(encoding="utf-8") for program in PROGRAMS]
    text = ""
    while text.count("\n") < 2_000:
        number = text.count("\n")
        text += (
            "".join(parts).replace("class ", f"class C{number}").replace("func ", f"func f{number}")
        )
    code = Code(ascii_only(text), "swift")
    best = 9.0
    for _ in range(3):
        begun = time.process_time()
        assert trees(code)
        best = min(best, time.process_time() - begun)
    assert best < 0.3 * text.count("\n") / 2_000 * 2, (
        "twice the time, for machines that do other things as well"
    )


def test_the_same_text_gives_the_same_tree() -> None:
    for program in PROGRAMS:
        text = program.read_text(encoding="utf-8")
        one, other = (
            repr([(plain(each.tree), each.assumed) for each in trees(Code(text, "swift"))])
            for _ in range(2)
        )
        assert one == other
