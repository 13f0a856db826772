"""What the summary says was checked, and what it names as not checked."""

import json
from pathlib import Path

import pytest

from tests.command import run

pytest.importorskip("tree_sitter_cpp")

PASS = """\
images:
  color: {format: R8G8B8A8_UNORM, samples: 4}
renderPasses:
  main:
    attachments:
      color: {image: color, loadOp: CLEAR, storeOp: DONT_CARE}
    subpasses: [{colorAttachments: [color]}]
"""
IMAGES = (
    "images:\n  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, SAMPLED]}\n"
)
HELP = "check a capture or a description of the frame instead"

CREATES = {
    "member.cpp": (
        "VkImageCreateInfo info{};\nvoid create() {\n  info.samples = settings.msaa;\n  "
        "vkCreateImage(d, &info, nullptr, &image);\n}\n",
        "3:7",
        "samples = settings.msaa",
    ),
    "pointer.c": (
        "void f(VkImageCreateInfo *info) { info->samples = VK_SAMPLE_COUNT_8_BIT; "
        "vmaCreateImage(a, info, 0, &i, 0, 0); }\n",
        "1:39",
        "samples = VK_SAMPLE_COUNT_8_BIT",
    ),
    "setter.cpp": (
        "void f(vk::Device d) { info.setSamples(vk::SampleCountFlagBits::e4); image = "
        "d.createImage(info); }\n",
        "1:28",
        "samples = vk::SampleCountFlagBits::e4",
    ),
    "helper.cpp": (
        "// VkImageCreateInfo is elsewhere.\nvoid f() { color = createTarget(w, h, "
        "VK_SAMPLE_COUNT_4_BIT); }\n",
        "2:20",
        "samples = VK_SAMPLE_COUNT_4_BIT",
    ),
    "attachment.cpp": (
        "void f() { a[0].samples = count; a[0].loadOp = op(); vkCreateRenderPass(device, &info, "
        "nullptr, &pass); }\n",
        "1:16",
        "samples = count",
    ),
    "initializer.cpp": (
        "void f() { VkAttachmentDescription a = {0, format, self->msaaSamples, "
        "VK_ATTACHMENT_LOAD_OP_CLEAR}; createRenderPass(a); }\n",
        "1:52",
        "samples = self->msaaSamples",
    ),
    "pipeline.cpp": (
        "void f() { multisampling->rasterizationSamples = caps.count; vkCreateGraphicsPipelines(d, "
        "c, 1, get(), 0, &p); }\n",
        "1:25",
        "rasterizationSamples = caps.count",
    ),
    "view.swift": ("func f(view: MTKView) { view.sampleCount = 4 }\n", "1:29", "sampleCount = 4"),
    "resolve.frag": (
        '#include "common.glsl"\nuniform sampler2DMS tex;\nvoid main() { color = '
        "AVERAGE(texelFetch(tex, at, 0)); }\n",
        "2:9",
        "sampler2DMS",
    ),
}

CREATES_NOTHING = {
    "types.h": (
        "struct Desc { VkImageCreateInfo info; VkSampleCountFlagBits samples; "
        "VkSampleCountFlagBits other = VK_SAMPLE_COUNT_4_BIT; };\n"
        "VkImage createImage(const Desc &desc);\n"
    ),
    "names.cpp": (
        "const char *name(VkSampleCountFlagBits s) { switch (s) { case VK_SAMPLE_COUNT_4_BIT: "
        'return "VK_SAMPLE_COUNT_4_BIT"; } }\n'
        "const std::map<VkSampleCountFlagBits, int> counts = {{VK_SAMPLE_COUNT_4_BIT, 4}, "
        "{VK_SAMPLE_COUNT_8_BIT, 8}};\n"
    ),
    "one.cpp": (
        "constexpr auto samples = VK_SAMPLE_COUNT_1_BIT;\n"
        "void f() { info.samples = samples; other.samples = VK_SAMPLE_COUNT_1_BIT; "
        "vkCreateImage(d, &info, 0, &i); }\n"
        "void g() { ci.setSamples(vk::SampleCountFlagBits::e1); if (info.samples == "
        "VK_SAMPLE_COUNT_4_BIT) h(); }\n"
    ),
    "comment.cpp": (
        "// info.samples = VK_SAMPLE_COUNT_4_BIT;\n/* x.samples = n; */\n"
        'void f() { log("x.samples = VK_SAMPLE_COUNT_4_BIT"); vkCreateImage(d, &info, 0, &i); }\n'
    ),
    "initializers.hpp": (
        "inline VkPipelineMultisampleStateCreateInfo multisampling(VkSampleCountFlagBits n) {\n"
        "  VkPipelineMultisampleStateCreateInfo info{};\n  info.rasterizationSamples = n;\n  "
        "return info;\n}\n"
    ),
    "binding.hpp": (
        "struct ImageCreateInfo { ImageCreateInfo &setSamples(SampleCountFlagBits samples_) { "
        "samples = samples_; return *this; } };\n"
        "Image createImage(const ImageCreateInfo &info);\n"
    ),
    "audio.cpp": "VkImageCreateInfo info; void f() { spec.samples = 4096; texture = "
    "SDL_CreateTexture(r, f, a, w, h); }\n",
    "declared.glsl": "uniform sampler2DMS unused;\n",
    "one.swift": "func f(view: MTKView) { view.sampleCount = 1 }\n",
}


def test_the_summary_counts_what_was_checked_by_kind_of_input(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(PASS)
    (tmp_path / "b.msaa.yaml").write_text(
        PASS
        + "pipelines:\n  main: {renderPass: main}\n---\n"
        + PASS.replace("color:", "other:")
        .replace(" color,", " other,")
        .replace("[color]", "[other]")
    )
    (tmp_path / "broken.msaa.yaml").write_text(PASS.replace("CLEAR", "CLAER"))
    done = run(tmp_path, "check", "--isolated", ".", "--output", "json")
    data = json.loads(done.stdout)
    assert done.returncode == 2
    assert data["summary"]["checked"] == {
        "images": 4,
        "passes": 4,
        "pipelines": 1,
        "shaders": 0,
        "choices": 0,
    }
    assert [(each["file"], each["images"], each["failed"]) for each in data["inputs"]] == [
        ("a.msaa.yaml", 1, False),
        ("b.msaa.yaml", 2, False),
        ("broken.msaa.yaml", 1, True),
    ]
    text = run(tmp_path, "check", "--isolated", ".").stdout
    assert (
        " (3 descriptions: 4 images, 4 passes, 1 pipeline, 1 checked in part because of errors)\n"
        in text
    )


def test_a_document_that_is_not_checked_beside_a_good_one_is_not_counted(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        PASS + "---\n" + PASS.replace("renderPasses:", "metal: 1\nrenderPasses:")
    )
    done = run(tmp_path, "check", "--isolated", "a.msaa.yaml")
    assert (
        "in 1 file (1 description: 1 image, 1 pass, 1 checked in part because of errors)"
        in done.stdout
    )


def test_an_input_that_cannot_be_opened_is_counted_as_unreadable(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(PASS)
    (tmp_path / "b.txt").write_text("VULKANINFO\n==========\n")
    done = run(tmp_path, "check", "--isolated", "a.msaa.yaml", "b.txt")
    assert " (1 description: 1 image, 1 pass; 1 unreadable file)" in done.stdout


def test_a_capture_that_cannot_be_read_is_not_summarized(tmp_path: Path) -> None:
    (tmp_path / "b.jsonl").write_text(
        '{"index":1,"function":{"name":"vkCmdDraw","args":{}}}\n{"index": nonsense}\n'
    )
    done = run(tmp_path, "check", "--isolated", "b.jsonl")
    assert done.returncode == 2
    assert "the capture ends here" in done.stdout and "frames" not in done.stdout


def test_renderings_are_passes_and_an_empty_description_has_nothing_to_check(
    tmp_path: Path,
) -> None:
    (tmp_path / "a.msaa.yaml").write_text(
        "images:\n  c: {format: R8G8B8A8_UNORM, samples: 4}\ncommands:\n"
        + "- beginRendering: {colorAttachments: [{image: c, loadOp: CLEAR, storeOp: DONT_CARE}]}\n"
        "- endRendering\n" * 2
    )
    (tmp_path / "b.msaa.yaml").write_text("scene: {color: HDR}\n")
    assert (
        "(1 description: 1 image, 2 passes)"
        in run(tmp_path, "check", "--isolated", "a.msaa.yaml").stdout
    )
    done = run(tmp_path, "check", "--isolated", "b.msaa.yaml", "--strict-inputs")
    assert (done.returncode, done.stdout) == (
        0,
        "No findings in 1 file (1 description: nothing to check)\n",
    )


def test_images_alone_are_not_a_pass(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(IMAGES)
    (tmp_path / "one.msaa.yaml").write_text(IMAGES.replace("samples: 4", "samples: 1"))
    done = run(tmp_path, "check", "--isolated", ".")
    message = (
        "`color` has 4 samples, but the input has no pass that uses it; add `renderPasses` "
        "or `beginRendering` commands"
    )
    assert done.returncode == 0
    assert [line for line in done.stdout.splitlines() if "not checked" in line] == [
        f"a.msaa.yaml:2:44: not checked: {message}",
        "--strict-inputs makes inputs that are not checked an error",
    ]
    done = run(tmp_path, "check", "--isolated", "--strict-inputs", ".")
    assert done.returncode == 2
    assert f"a.msaa.yaml:2:44: error[unread-input] {message} (MSAA931)\n" in done.stdout
    assert "not checked" not in done.stdout and "one.msaa.yaml" not in done.stdout


def test_the_configuration_makes_inputs_strict(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(IMAGES)
    (tmp_path / "msaa-lint.toml").write_text("strict-inputs = true\n")
    assert run(tmp_path, "check", "a.msaa.yaml").returncode == 2
    (tmp_path / "msaa-lint.toml").write_text('strict-inputs = "yes"\n')
    done = run(tmp_path, "check", "a.msaa.yaml")
    assert (
        "msaa-lint.toml:1:17: error[configuration] expected true or false, found a string in "
        "`strict-inputs`" in done.stdout
    )


@pytest.mark.parametrize("name", CREATES)
def test_code_that_creates_multisampled_objects_without_a_pass_is_named(
    tmp_path: Path, name: str
) -> None:
    text, place, quote = CREATES[name]
    (tmp_path / name).write_text(text)
    done = run(tmp_path, "check", "--isolated", name)
    assert done.returncode == ("warning[" in done.stdout)
    (line, *_) = [line for line in done.stdout.splitlines() if "not checked" in line]
    assert line.startswith(f"{name}:{place}: not checked: `{quote}` ") and line.endswith(HELP)
    strict = run(tmp_path, "check", "--isolated", "--strict-inputs", "--output", "json", name)
    (found,) = [
        each for each in json.loads(strict.stdout)["findings"] if each["severity"] == "error"
    ]
    assert (strict.returncode, found["code"], f"{found['line']}:{found['column']}") == (
        2,
        "MSAA931",
        place,
    )


@pytest.mark.parametrize("name", CREATES_NOTHING)
def test_code_that_creates_nothing_multisampled_is_not_named(tmp_path: Path, name: str) -> None:
    (tmp_path / name).write_text(CREATES_NOTHING[name])
    done = run(tmp_path, "check", "--isolated", "--strict-inputs", name)
    assert (
        done.returncode == 0
        and "No findings in 1 file (" in done.stdout
        and "not checked" not in done.stdout
    )


def test_many_such_inputs_are_counted(tmp_path: Path) -> None:
    for number in range(8):
        (tmp_path / f"{number}.cpp").write_text(CREATES["member.cpp"][0])
    lines = run(
        tmp_path, "check", "--isolated", *(f"{number}.cpp" for number in range(8))
    ).stdout.splitlines()
    assert lines[0] == "No findings in 8 files (8 C++ files: nothing read)"
    assert [line.split(":")[0] for line in lines[1:6]] == [
        "0.cpp",
        "1.cpp",
        "2.cpp",
        "3.cpp",
        "4.cpp",
    ]
    assert lines[6] == "3 more files not checked"
