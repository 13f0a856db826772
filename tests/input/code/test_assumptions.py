"""`// msaa-lint: assume` and `[source.assume]` state what source code does not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from tests.command import run
from tests.input.code.test_confidence import LITERAL, PROGRAM

SETTINGS = "struct Settings { int samples; bool msaa; };\nextern Settings settings;"
CHOSEN = "settings.msaa ? VK_SAMPLE_COUNT_8_BIT : VK_SAMPLE_COUNT_1_BIT"
MEMBER = "(VkSampleCountFlagBits)settings.samples"


def program(**changes: str) -> str:
    return PROGRAM.substitute(LITERAL | changes)


def check(folder: Path, text: str, *options: str, name: str = "pass.cpp") -> list[dict[str, Any]]:
    (folder / name).write_text(text, encoding="utf-8")
    done = run(folder, "check", "--select", "MSAA201,MSAA915", "--output", "json", *options, name)
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return found


STATED = {
    "a call": {"samples": "pick(device); // msaa-lint: assume samples=8 the settings cap it\n //"},
    "the line before": {
        "before": SETTINGS,
        "samples": f"\n// msaa-lint: assume samples=8\n{MEMBER}",
    },
    "a member": {
        "before": f"// msaa-lint: assume settings.samples=8\n{SETTINGS}",
        "samples": MEMBER,
    },
    "an enumerant": {
        "before": f"// msaa-lint: assume settings.samples=VK_SAMPLE_COUNT_8_BIT\n{SETTINGS}",
        "samples": MEMBER,
    },
    "a declaration": {
        "before": SETTINGS.replace("samples;", "samples; /* msaa-lint: assume samples=8 */"),
        "samples": MEMBER,
    },
    "a class": {
        "before": f"{SETTINGS}\n// msaa-lint: assume Settings::samples=8",
        "samples": MEMBER,
    },
    "a pointer": {
        "before": "// msaa-lint: assume state->samples=8",
        "samples": "(VkSampleCountFlagBits)state->samples",
    },
    "a function": {
        "before": "// msaa-lint: assume getSamples()=8",
        "samples": "renderer->getSamples()",
    },
    "a prototype": {
        "before": "VkSampleCountFlagBits level(VkDevice device); // msaa-lint: assume samples=8",
        "samples": "level(device)",
    },
    "a condition": {
        "before": f"{SETTINGS}\n// msaa-lint: assume settings.msaa=true",
        "samples": CHOSEN,
    },
    "several": {
        "before": f"{SETTINGS}\n// msaa-lint: assume settings.msaa=true, other()=2 of the user",
        "samples": CHOSEN,
    },
    "a macro": {
        "before": "// msaa-lint: assume ENGINE_MSAA=8",
        "samples": "VK_SAMPLE_COUNT_1_BIT;\n#if ENGINE_MSAA > 1\n    attachments[0].samples = "
        "VK_SAMPLE_COUNT_8_BIT;\n#endif\n    ",
    },
}


@pytest.mark.parametrize("case", STATED)
def test_what_is_assumed_is_a_fact(tmp_path: Path, case: str) -> None:
    found = check(tmp_path, program(**STATED[case]), "--isolated")
    assert [each["code"] for each in found if each["code"] == "MSAA201"] == ["MSAA201"]
    assert (found[-1]["confidence"], found[-1]["notes"], "8x samples" in found[-1]["message"]) == (
        "medium",
        [],
        True,
    )
    unused = [each["message"] for each in found if each["code"] == "MSAA915"]
    assert unused == (
        ["unused assumption: nothing in this program reads an unknown `other()`"]
        if case == "several"
        else []
    )


def test_one_sample_can_be_assumed(tmp_path: Path) -> None:
    text = program(before=f"{SETTINGS}\n// msaa-lint: assume settings.msaa=false", samples=CHOSEN)
    assert check(tmp_path, text, "--isolated") == []


def test_a_page_can_state_it(tmp_path: Path) -> None:
    text = program(before=f"// msaa-lint: assume settings.samples=8\n{SETTINGS}", samples=MEMBER)
    (found,) = check(tmp_path, f"```cpp\n{text}```\n", "--isolated", name="page.md")
    assert ("8x samples" in found["message"], found["confidence"]) == (True, "low")


def test_other_files_of_the_program_can_state_it(tmp_path: Path) -> None:
    (tmp_path / "settings.h").write_text(
        "struct Settings {\n    int samples; // msaa-lint: assume samples=8\n};\n", encoding="utf-8"
    )
    text = program(before='#include "settings.h"\nextern Settings settings;', samples=MEMBER)
    (tmp_path / "pass.cpp").write_text(text, encoding="utf-8")
    done = run(
        tmp_path, "check", "--isolated", "--select", "MSAA201,MSAA915", "--output", "json", "."
    )
    (found,) = json.loads(done.stdout)["findings"]
    assert (found["code"], "8x samples" in found["message"]) == ("MSAA201", True)


@pytest.mark.parametrize(
    ("comment", "column", "end", "message"),
    [
        (
            "// msaa-lint: assume samples=3",
            30,
            31,
            "`3` is not a sample count; write 1, 2, 4, 8, 16, 32, or 64",
        ),
        (
            "// msaa-lint: assume samples=true",
            30,
            34,
            "`true` is not a sample count; write 1, 2, 4, 8, 16, 32, or 64",
        ),
        (
            "// msaa-lint: assume a.b=many",
            26,
            30,
            "`many` is not a value; write true, false, an integer, or an enumerant",
        ),
        (
            "// msaa-lint: assume a..b=4",
            22,
            26,
            "`a..b` is not a name; write a variable, a member, a call without arguments, or a "
            "macro",
        ),
        (
            "// msaa-lint: assume four samples",
            1,
            34,
            "an assumption without `NAME=VALUE`; write `// msaa-lint: assume samples=4` or `// "
            "msaa-lint: assume NAME=VALUE`",
        ),
    ],
)
def test_what_is_wrong_is_an_error_at_its_place(
    tmp_path: Path, comment: str, column: int, end: int, message: str
) -> None:
    (tmp_path / "a.cpp").write_text(program(before=comment), encoding="utf-8")
    done = run(tmp_path, "check", "--isolated", "--output", "json", "a.cpp")
    (found,) = [each for each in json.loads(done.stdout)["findings"] if each["code"] == "MSAA916"]
    assert (done.returncode, found["line"], found["column"], found["end_column"]) == (
        2,
        2,
        column,
        end,
    )
    assert found["message"] == message


def test_what_nothing_reads_is_reported(tmp_path: Path) -> None:
    (found,) = check(
        tmp_path,
        program(
            before="int x; // msaa-lint: assume samples=4", store="VK_ATTACHMENT_STORE_OP_DONT_CARE"
        ),
        "--isolated",
    )
    assert (found["rule"], found["line"], found["column"]) == ("unused-assumption", 2, 29)
    assert found["message"] == "unused assumption: nothing on its line reads an unknown `samples`"


def test_a_description_has_no_assumptions(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        "images: {} # msaa-lint: assume samples=4\n", encoding="utf-8"
    )
    assert (
        "unknown word `assume` after `msaa-lint:`"
        in run(tmp_path, "check", "--isolated", "a.msaa.yaml").stdout
    )


def test_the_configuration_states_it(tmp_path: Path) -> None:
    configuration = (
        '[source.assume]\n"settings.samples" = 8\nENGINE_MSAA = true\n"Other::name()" '
        '= "VK_SAMPLE_COUNT_4_BIT"\n'
    )
    (tmp_path / "msaa-lint.toml").write_text(configuration, encoding="utf-8")
    text = program(before=SETTINGS, samples=MEMBER)
    (found,) = check(tmp_path, text)
    assert ("8x samples" in found["message"], found["confidence"]) == (True, "medium")
    done = run(
        tmp_path,
        "check",
        "--select",
        "MSAA201",
        "--output",
        "json",
        "-",
        "--stdin-filename",
        "pass.cpp",
        stdin=text.encode(),
    )
    assert "8x samples" in done.stdout


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        (
            '[source.assume]\n"a.b" = 1.5\n',
            "2:9",
            "`1.5` is not a value; write true, false, an integer, or an enumerant",
        ),
        ('[source.assume]\n"a b" = 4\n', "2:1", "`a b` is not a name"),
        ("[source.assume]\nsamples = 3\n", "2:11", "`3` is not a sample count"),
        (
            "[source]\nassumed = {}\n",
            "2:1",
            "unknown key `assumed` in `source` of msaa-lint.toml: did you mean `assume`?",
        ),
        ("source = 4\n", "1:10", "expected a table such as"),
    ],
)
def test_a_wrong_configuration_is_an_error_at_its_place(
    tmp_path: Path, text: str, place: str, message: str
) -> None:
    (tmp_path / "msaa-lint.toml").write_text(text, encoding="utf-8")
    (tmp_path / "a.cpp").write_text(program(), encoding="utf-8")
    done = run(tmp_path, "check", "--output", "concise", "a.cpp")
    assert done.returncode == 2
    assert f"msaa-lint.toml:{place}: error[configuration] {message}" in done.stdout


SWIFT = """\
import Metal
final class Renderer {
    let settings: Settings
    func draw(device: MTLDevice, commands: MTLCommandBuffer, target: MTLTexture) {
        let description = MTLTextureDescriptor()
        description.textureType = .type2DMultisample
        description.usage = .renderTarget
        description.sampleCount = settings.samples // msaa-lint: assume ASSUMED
        let color = device.makeTexture(descriptor: description)!
        let pass = MTLRenderPassDescriptor()
        pass.colorAttachments[0].texture = color
        pass.colorAttachments[0].resolveTexture = target
        pass.colorAttachments[0].loadAction = .clear
        pass.colorAttachments[0].storeAction = .storeAndMultisampleResolve
        commands.makeRenderCommandEncoder(descriptor: pass)!.endEncoding()
    }
}
"""
OBJECTIVE_C = """\
#import <Metal/Metal.h>
@interface Renderer : NSObject
@property (nonatomic) Settings *settings;
@end
@implementation Renderer
- (void)draw:(id<MTLDevice>)device on:(id<MTLCommandBuffer>)commands to:(id<MTLTexture>)target {
    MTLTextureDescriptor *description = [MTLTextureDescriptor new];
    description.textureType = MTLTextureType2DMultisample;
    description.usage = MTLTextureUsageRenderTarget;
    description.sampleCount = self.settings.samples; // msaa-lint: assume ASSUMED
    id<MTLTexture> color = [device newTextureWithDescriptor:description];
    MTLRenderPassDescriptor *pass = [MTLRenderPassDescriptor renderPassDescriptor];
    pass.colorAttachments[0].texture = color;
    pass.colorAttachments[0].resolveTexture = target;
    pass.colorAttachments[0].loadAction = MTLLoadActionClear;
    pass.colorAttachments[0].storeAction = MTLStoreActionStoreAndMultisampleResolve;
    [[commands renderCommandEncoderWithDescriptor:pass] endEncoding];
}
@end
"""
RUST = """\
use ash::vk;
pub fn create(device: &ash::Device, settings: &Settings) -> vk::RenderPass {
    let attachments = [
        vk::AttachmentDescription::default()
            .samples(settings.samples) // msaa-lint: assume ASSUMED
            .load_op(vk::AttachmentLoadOp::CLEAR)
            .store_op(vk::AttachmentStoreOp::STORE),
        vk::AttachmentDescription::default().samples(vk::SampleCountFlags::TYPE_1).store_op(vk::AttachmentStoreOp::STORE),
    ];
    let color = [vk::AttachmentReference::default().attachment(0)];
    let resolve = [vk::AttachmentReference::default().attachment(1)];
    let subpasses = [vk::SubpassDescription::default().color_attachments(&color).resolve_attachments(&resolve)];
    let info = vk::RenderPassCreateInfo::default().attachments(&attachments).subpasses(&subpasses);
    unsafe { device.create_render_pass(&info, None) }.unwrap()
}
"""
LANGUAGES = {
    "a.swift": (SWIFT, "MSAA801"),
    "a.m": (OBJECTIVE_C, "MSAA801"),
    "a.mm": (OBJECTIVE_C, "MSAA801"),
    "a.rs": (RUST, "MSAA201"),
}


@pytest.mark.parametrize("assumed", ["samples=8", "settings.samples=8", "Settings::samples=8"])
@pytest.mark.parametrize("name", LANGUAGES)
def test_every_language_can_state_it(tmp_path: Path, name: str, assumed: str) -> None:
    text, code = LANGUAGES[name]
    (tmp_path / name).write_text(text.replace("ASSUMED", assumed), encoding="utf-8")
    done = run(
        tmp_path, "check", "--isolated", "--select", f"{code},MSAA915", "--output", "json", name
    )
    (found,) = json.loads(done.stdout)["findings"]
    assert (found["code"], "8x samples" in found["message"], found["confidence"]) == (
        code,
        True,
        "medium",
    )


@pytest.mark.parametrize("command", ["convert", "facts"])
@pytest.mark.parametrize("name", ["pass.cpp", "page.md"])
def test_other_commands_follow_the_configuration(tmp_path: Path, command: str, name: str) -> None:
    (tmp_path / "msaa-lint.toml").write_text(
        '[source.assume]\n"settings.samples" = 8\n', encoding="utf-8"
    )
    text = program(before=SETTINGS, samples=MEMBER)
    (tmp_path / name).write_text(
        f"```cpp\n{text}```\n" if name.endswith(".md") else text, encoding="utf-8"
    )
    done = run(tmp_path, command, name)
    assert (
        "samples: 8" if command == "convert" else "image.samples                              8"
    ) in done.stdout
