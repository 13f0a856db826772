"""Which data files of a folder are inputs. The files of others are written here in the form that
their tools use.
"""

import json
import os
import time
from pathlib import Path

import pytest

from msaa_lint.cli.options import SCHEMAS
from msaa_lint.input.content import MAX_BYTES, kind_of
from msaa_lint.input.file_types import HEAD_BYTES
from tests.command import run
from tests.paths import ROOT, SAMPLES

FRAME = """\
images:
  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}
renderPasses:
  main:
    attachments: {color: {image: color, loadOp: CLEAR, storeOp: STORE}}
    subpasses: [{colorAttachments: [color]}]
"""

INPUTS = {
    "frame.yaml": FRAME,
    "comments.yaml": f"# a frame\n\n{FRAME}\n# the end\n",
    "crlf.yml": FRAME.replace("\n", "\r\n"),
    "second-document.yaml": f"name: an index\nframes: [main]\n---\n{FRAME}",
    "one-line.json": '{"device": "arm", "frame": {"width": 64}, "images": {"c": {"samples": 4, '
    '"format": "VK_FORMAT_R8_UNORM"}}}',
    "brackets-in-strings.json": '{"enabled": {"features": ["}}]{", "\\\\", "\\"}"]}, "images": '
    '{"c": {"format": "R8_UNORM"}}}',
    "commented.json": "# a frame\n{ # of two keys\n  images: {c: {format: R8_UNORM, samples: 4}},\n"
    "}\n",
    "tagged.yaml": "--- !!map &root {images: {c: {format: R8_UNORM, samples: 4}}}\n",
    "indented-root.yaml": "# a frame\n  " + FRAME.replace("\n", "\n  ").rstrip(),
    "quoted-keys.yaml": '"images" :\n  "c": {"format": R8_UNORM, samples: 4}\n',
    "indented.json": json.dumps(
        {"images": {"c": {"usage": ["COLOR_ATTACHMENT"], "samples": 4}}}, indent=4
    ),
    "typed-in-haste.yaml": FRAME.replace("storeOp", "storeop").replace("samples: 4", "samples: 3"),
    "broken-at-the-end.yaml": FRAME + "pipelines: {p: {renderPass: main\n",
    "pipelines.yaml": "pipelines: {opaque: {multisampleState: {rasterizationSamples: 4}}}\n",
    "commands.yaml": "commands:\n- beginRenderPass: {renderPass: main}\n- endRenderPass\n- "
    "resolveImage: {srcImage: a, dstImage: b}\n",
    "metal.yaml": "metal: {textures: {c: {pixelFormat: rgba8Unorm, sampleCount: 4, storageMode: "
    "memoryless}}}\n",
    "targets.yaml": "renderTargets: {main: {sampleCount: kCount4, colorAttachmentConfig: "
    "{storageMode: kDeviceTransient}}}\n",
    "choice.yaml": "sampleCountChoices: {pick: {limits: [framebufferColorSampleCounts], chosen: "
    "MAXIMUM}}\n",
    "pipeline.json": '{"GraphicsPipelineState": {"GraphicsPipeline": {"sType": '
    '"VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO",}}}',
    "gfxr.jsonl": '{"header":{"source-path":"a.gfxr","gfxrecon-version":"1.0.5"}}\n'
    '{"index":1,"function":{"name":"vkCreateDevice"}}\n',
    "dump.json": '[\n{\n    "frameNumber" : "0",\n    "apiCalls" :\n    [\n        {"name" : '
    '"vkCreateInstance"}]}]',
    "renderdoc.xml": '<?xml version="1.0"?>\n<rdc>\n\t<header>\n\t\t<driver id="8">Vulkan</driver>',
}

OTHERS = {
    "AppIcon.appiconset/Contents.json": '{"images": [{"idiom": "iphone", "scale": "2x", "size": '
    '"20x20"}], "info": {"version": 1}}',
    "kustomization.yaml": "resources: [deployment.yaml]\nimages:\n- name: nginx\n  newTag: "
    "1.21.0\n",
    "compose.yaml": "services:\n  web:\n    image: nginx\n    device: /dev/dri\n",
    ".circleci/config.yml": "version: 2.1\ncommands:\n  build:\n    steps:\n    - run: make\njobs: "
    "{}\n",
    "bitbucket-pipelines.yml": "image: node\npipelines:\n  default:\n  - step: {script: [npm "
    "test]}\n  branches: {main: [{step: {}}]}\n",
    "gem.json": '{"gem_name": "Atom_RHI", "images": {"icon": "icon.png"}, "commands": [], '
    '"requirements": ""}',
    "devcontainer.yaml": "commands: {build: make, test: make check}\n",
    "snapcraft.yaml": "name: app\napps: {app: {command: run}}\nframe: {width: 640, height: 480, "
    "fps: 30}\n",
    "camera.yaml": "device: /dev/video0\nframe: {width: 640, height: 480, fps: 30}\nenabled: "
    "{extensions: [a]}\nscene: {edges: true}\n",
    "models.gltf.json": '{"asset": {"version": "2.0"}, "scene": 0, "images": [{"uri": "a.png"}], '
    '"samplers": [{}], "meshes": []}',
    "package.json": '{"name": "x", "contributes": {"commands": [{"command": "x.run", "title": '
    '"Run"}]}}',
    "keymap.json": '{"commands": [{"command": "go", "key": "g"}, {"command": "stop", "key": "s"}]}',
    "webgpu.json": '{"commands": [{"op": "beginRenderPass", "colorAttachments": [{"loadOp": '
    '"clear"}]}], "pipelines": ["a"]}',
    "engine.json": '{"name": "deferred", "passes": [{"outputs": [{"format": '
    '"VK_FORMAT_D32_SFLOAT", "op": "CLEAR"}]}]}',
    "palette.json": '{"images": {"a.png": {"width": 64, "height": 64, "frames": [1, 2]}}, "meta": '
    '{"app": "packer"}}',
    "translation.yaml": "images: Bilder\npipelines: Leitungen\ncommands: Befehle\nrenderPasses: "
    "Durchgänge\n",
    "fixture.yaml": "- name: reads a description\n  text: |\n    "
    f"{FRAME.replace(chr(10), chr(10) + '    ')}\n",
    "words.json": json.dumps(
        {
            "docs": FRAME,
            "keys": ["images", "renderPasses"],
            "schema": {"images": {"format": "R8_UNORM"}},
        }
    ),
    "deep.json": '{"version": "2.0", "shapes": {"a": {"images": {"c": {"format": "R8G8B8A8_UNORM", '
    '"samples": 4}}}}}',
    "deep.yaml": f"version: 2\nshapes:\n  {FRAME.replace(chr(10), chr(10) + '  ')}\n",
    "quoted.json": '{"text": "\\"images\\": {\\"c\\": {\\"format\\": \\"R8_UNORM\\"}}", "images": '
    "null}",
    "list.yaml": f"- {FRAME.replace(chr(10), chr(10) + '  ')}\n",
    "settings.json": '// a comment\n{"images": {"format": "png"}, "commands": {}}',
    "chart.yaml": "images:\n  web: {repository: {{ .Values.web }}, format: oci}\n",
    "empty.yaml": "images: {}\nrenderPasses:\n",
    "null.json": "null",
    "nothing.yaml": "",
    "tools.jsonl": '{"index":0,"function":{"name":"get_weather","arguments":"{}"}}\n'
    '{"index":1,"meta":{"name":"images"}}\n',
    "frames.json": '[{"frameNumber": 1, "apiCalls": [{"name": "glClear"}]}]',
    "d3d11.xml": '<?xml version="1.0"?>\n<rdc>\n<header><driver '
    'id="2">D3D11</driver></header><chunks><chunk name="Draw"/></chunks></rdc>',
    "mapping.xml": '<?xml version="1.0"?>\n<mapping images: commands: metal: '
    'PipelineState="x"><rdc>a</rdc></mapping>',
    "named.xml": '<?xml version="1.0"?><rdc><driver>Vulkan</driver><row '
    'name="vkCreateImage">images:</row></rdc>',
    "rdc.xml": "<rdc><row>images:</row></rdc>",
    "line.jsonl": '{"images": {"c": {"format": "R8G8B8A8_UNORM"}}}\n{"images": {}}\n',
    "vulkaninfo.json": '{"device": {"VkPhysicalDeviceProperties": {"limits": '
    '{"framebufferColorSampleCounts": 15}}}, "profiles": {}}',
    "validusage.json": '{"version info": {"api version": "1.3"}, "validation": '
    '{"VkImageCreateInfo": {"core": [{"text": "samples"}]}}}',
}

NEARLY = {
    "fossilize.json": json.dumps(
        {
            "version": 6,
            "renderPasses": {"01": {"attachments": [{"format": 44, "samples": 4, "loadOp": 1}]}},
        }
    ),
    "partial.yaml": "images:\n  color: {samples: 4, extent: {width: 64, height: 64}}\n",
    "engine-images.json": '{"images": {"gbuffer": {"format": "R8G8B8A8_UNORM", "path": "a", '
    '"scale": 0.5, "srgb": true}}}',
    "pipeline-state.json": '{"GraphicsPipelineState": {"RootSignature": "a", "PS": "b"}}',
}


def kind(tmp_path: Path, name: str, text: str | bytes) -> str:
    path = tmp_path / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return kind_of(str(path))


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        (name, text, of)
        for of, files in (("input", INPUTS), ("other", OTHERS), ("near", NEARLY))
        for name, text in files.items()
    ],
)
def test_only_what_a_frame_alone_has_makes_an_input(
    tmp_path: Path, name: str, text: str, expected: str
) -> None:
    assert kind(tmp_path, name, text) == expected
    if not name.endswith((".xml", ".jsonl")):
        assert kind(tmp_path, name, b"\xef\xbb\xbf" + text.encode()) == expected
        assert kind(tmp_path, name, text.encode("utf-16")) == (
            "other" if name == "dump.json" else expected
        )


def test_examples_are_inputs() -> None:
    for path in (ROOT / "examples").rglob("*.*"):
        if path.suffix in (".yaml", ".jsonl", ".xml"):
            assert kind_of(str(path)) == "input", path


@pytest.mark.skipif(not SAMPLES.is_dir(), reason="the samples are not here")
def test_captures_and_pipelines_are_inputs_and_device_reports_are_not() -> None:
    kinds = {
        path: kind_of(str(path))
        for path in SAMPLES.rglob("*")
        if path.suffix in (".json", ".jsonl", ".xml", ".foz")
    }
    unexpected = [
        path
        for path, found in kinds.items()
        if (found == "input") == ("devices" in path.parts or path.name == "expected.json")
    ]
    assert unexpected == []


def test_the_key_that_tells_may_come_late_but_not_without_end(tmp_path: Path) -> None:
    padding = "".join(f"  image{number}: {{samples: 1}}\n" for number in range(HEAD_BYTES // 16))
    assert (
        kind(tmp_path, "late.yaml", f"images:\n{padding}{FRAME.partition(chr(10))[2]}") == "input"
    )
    assert (
        kind(
            tmp_path,
            "later.yaml",
            f"images:\n{padding * (MAX_BYTES // len(padding) + 1)}{FRAME.partition(chr(10))[2]}",
        )
        == "near"
    )


def test_the_time_to_tell_a_large_file_is_bounded(tmp_path: Path) -> None:
    entries = ",".join(f'"{n}": {{"name": "x", "samples": {n}}}' for n in range(400_000))
    (tmp_path / "a.json").write_text(f'{{"images": {{{entries}}}}}')
    (tmp_path / "b.yaml").write_text("images: &a {a: &b {samples: 4}}\n" + "pipelines: [" * 50_000)
    (tmp_path / "c.yaml").write_text(
        "images:\n  a: &a [1, 1]\n"
        + "".join(f"  {n}: &{n}x [*{chr(97)}, *{chr(97)}]\n" for n in range(9999))
    )
    started = time.perf_counter()
    (tmp_path / "d.json").write_text("[{" + '"check_name": ' * 90_000)
    (tmp_path / "e.yaml").write_text("images: {c: {samples: 4}}\n" + "!a \n" * 300_000)
    (tmp_path / "f.json").write_text('{"a": [' + '{"images":' * 100_000)
    assert {name: kind_of(str(tmp_path / name)) for name in sorted(os.listdir(tmp_path))} == {
        "a.json": "near", "b.yaml": "near", "c.yaml": "other", "d.json": "other", "e.yaml": "near",
        "f.json": "other",
    }  # fmt: skip
    assert time.perf_counter() - started < 20


def test_a_folder_counts_what_is_nearly_an_input_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "a.msaa.yaml").write_text(FRAME)
    for name, text in {**NEARLY, **OTHERS}.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    done = run(tmp_path, "check", ".", "--isolated", "--output", "json")
    assert done.stderr == (
        "msaa-lint: 4 files look a little like descriptions and were skipped, the first one "
        "engine-images.json: "
        "to lint them, name them or rename them to *.msaa.yaml\n"
    )
    assert {found["file"] for found in json.loads(done.stdout)["findings"]} == {"a.msaa.yaml"}
    done = run(
        tmp_path,
        "check",
        ".",
        "engine-images.json",
        "fossilize.json",
        "pipeline-state.json",
        "--isolated",
        "--output",
        "json",
    )
    assert done.stderr == (
        "msaa-lint: partial.yaml looks a little like a description and was skipped: "
        "to lint it, name it or rename it to *.msaa.yaml\n"
    )  # fmt: skip
    assert done.returncode == 2
    assert {
        found["file"]
        for found in json.loads(done.stdout)["findings"]
        if found["severity"] == "error"
    } == {
        "engine-images.json",
        "fossilize.json",
    }


@pytest.fixture
def written(tmp_path: Path) -> Path:
    """A folder with a frame and whatever msaa-lint writes about it, all under names of inputs."""
    (tmp_path / "frame.msaa.yaml").write_text(FRAME)
    for number, output in enumerate(("json", "sarif", "gitlab", "junit", "markdown", "rdjson")):
        run(
            tmp_path,
            "check",
            "frame.msaa.yaml",
            "--isolated",
            "--output",
            f"{output}=check{number}.msaa.json",
        )
    run(
        tmp_path,
        "cost",
        "frame.msaa.yaml",
        "--size",
        "64x64",
        "--isolated",
        "--output",
        "json=cost.msaa.json",
    )
    run(tmp_path, "baseline", "frame.msaa.yaml", "--isolated", "--file", "baseline.msaa.json")
    for which in SCHEMAS:
        (tmp_path / f"{which}.msaa.json").write_text(run(tmp_path, "schema", which).stdout)
    (tmp_path / "device.msaa.json").write_text(
        run(tmp_path, "device", "arm", "--output", "json").stdout
    )
    assert all(path.stat().st_size for path in tmp_path.iterdir())
    return tmp_path


@pytest.mark.parametrize("include", [(), ("--include", "*")])
def test_what_msaa_lint_wrote_is_not_an_input_of_a_folder_whatever_its_name(
    written: Path, include: tuple[str, ...]
) -> None:
    if include:
        (written / "msaa-lint.toml").write_text('include = ["*.json", "*.msaa.*"]\n')
    assert len(list(written.iterdir())) >= 12
    result = json.loads(run(written, "check", ".", "--output", "json").stdout)
    assert {found["file"] for found in result["findings"]} == {"frame.msaa.yaml"}


def test_a_named_output_of_msaa_lint_is_refused_in_one_line(written: Path) -> None:
    names = sorted(path.name for path in written.glob("*.json"))
    done = run(written, "check", *names, "--isolated", "--output", "concise")
    what = [
        line.partition("this is ")[2].partition(",")[0]
        for line in done.stdout.splitlines()
        if "error[" in line
    ]
    assert done.returncode == 2
    assert dict(zip(names, what, strict=True)) == {
        "baseline.msaa.json": "an msaa-lint baseline",
        "check0.msaa.json": "msaa-lint's own JSON output",
        "check1.msaa.json": "msaa-lint's own SARIF output",
        "check2.msaa.json": "a GitLab code quality report",
        "check3.msaa.json": "msaa-lint's own JUnit output",
        "check4.msaa.json": "msaa-lint's own Markdown output",
        "check5.msaa.json": "msaa-lint's own reviewdog output",
        "cost.msaa.json": "msaa-lint's own JSON output",
        "device.msaa.json": "msaa-lint's own JSON output",
        **{f"{which}.msaa.json": "a JSON Schema of msaa-lint" for which in SCHEMAS},
    }
    assert done.stdout.splitlines()[0] == (
        "baseline.msaa.json: error[syntax] this is an msaa-lint baseline, not an input: "
        "name the description, capture, or source code that it is about (MSAA901)"
    )
