"""`msaa-lint device`, and reports named by descriptions, `--profile` and the configuration, as
processes.
"""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core.extras import needs_extra
from tests.command import run
from tests.frame.devices import reported
from tests.paths import ROOT

EIGHT = """\
device: {}
images:
  ms: {{format: R8G8B8A8_UNORM, samples: 8, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL]}}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "phone.json").write_text(reported.DIALECTS["gpuinfo"])
    (tmp_path / "two.txt").write_text(reported.text("Own A", "Own B"))
    (tmp_path / "class.json").write_text(json.dumps(reported.profiles()))
    return tmp_path


def devices(text: str) -> list[dict[str, Any]]:
    found = json.loads(text)
    assert found["schema"] == "msaa-lint/device-v1"
    made: list[dict[str, Any]] = found["devices"]
    return made


def test_text_of_a_report(folder: Path) -> None:
    done = run(folder, "device", "phone.json")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert lines[0] == "Mali-G999 MC3 (arm, tile-based, integrated GPU, Vulkan 1.3.77)"
    rows = {line.split()[0]: line.split() for line in lines[2:7]}
    assert rows["8x"][1:5] == ["yes", "-", "yes", "-"]
    assert rows["8x"][-4:] == ["80", "%", "18", "%"]
    text = " ".join(done.stdout.split())
    assert "yes: a transient attachment takes memory only if it has to leave the tile" in text
    assert "depth resolve SAMPLE_ZERO, MIN, MAX; not supported: AVERAGE (by 14 % of tilers)" in text
    assert "depth and stencil modes are the same, or one is NONE" in text
    assert "sampleRateShading shading once per sample" in text
    assert "not supported multisampledRenderToSingleSampled, variableMultisampleRate" in text
    assert "source phone.json: report of vulkan.gpuinfo.org" in text
    assert not any(line.endswith(" ") for line in lines)


def test_tiles_of_a_built_in_device(folder: Path) -> None:
    lines = run(folder, "device", "mali-g76").stdout.splitlines()
    assert lines[1].split() == [
        "samples",
        "color",
        "depth",
        "stencil",
        "integer",
        "tile,",
        "RGBA8",
        "of",
        "devices",
        "of",
        "tilers",
    ]
    assert lines[4].split() == ["4x", "yes", "yes", "yes", "?", "256", "px", "99", "%", "100", "%"]
    assert lines[5].split() == ["8x", "yes", "yes", "yes", "?", "128", "px", "80", "%", "18", "%"]


def test_a_minimum_is_worded_as_one(folder: Path) -> None:
    text = run(folder, "device", "class.json#VP_OWN_base").stdout
    assert (
        text.splitlines()[0]
        == "VP_OWN_base (Vulkan 1.1.106, a minimum that every such device guarantees)"
    )
    assert "- not guaranteed; ? unknown" in text
    assert "not supported" not in text


def test_json(folder: Path) -> None:
    (found,) = devices(run(folder, "device", "phone.json", "--output", "json").stdout)
    assert (found["name"], found["key"], found["vendor"], found["tiler"], found["minimum"]) == (
        "Mali-G999 MC3",
        "phone.json",
        "arm",
        True,
        False,
    )
    assert found["sample_counts"] == {
        "color": [1, 4, 8], "depth": [1, 4], "stencil": [1, 4, 8, 16], "integer": [1, 4],
        "no_attachments": [1, 2, 4, 8],
        "sampled_color": [1, 4, 8], "sampled_integer": [1], "sampled_depth": [1, 4],
        "sampled_stencil": [1, 4], "storage": [1],
        "sample_locations": None,
    }  # fmt: skip
    assert found["lazily_allocated"] is True
    assert found["heaps"] == [
        {"bytes": 3 << 30, "device_local": True},
        {"bytes": 256 << 20, "device_local": False},
    ]
    assert (found["features_recorded"], found["extensions_recorded"]) == (None, None)
    assert found["shares"]["samples"]["8"] == {"all": 80, "tilers": 18}
    assert found["shares"]["lazily_allocated_of_vendor"] == 91


def test_the_documentation_has_every_key(folder: Path) -> None:
    (found,) = devices(run(folder, "device", "phone.json", "--output", "json").stdout)
    text = (ROOT / "docs" / "devices.md").read_text(encoding="utf-8")
    rows = [line for line in text.splitlines() if line.startswith("| `")]
    documented = [name for row in rows for name in re.findall(r"`(\w+)`", row.split("|")[1])]
    assert sorted(documented) == sorted(found)
    assert all(f"`{use}`" in text for use in found["sample_counts"])


def test_json_of_several(folder: Path) -> None:
    found = devices(run(folder, "device", "two.txt", "mali-g76", "--output", "json").stdout)
    assert [each["key"] for each in found] == ["two.txt#1", "two.txt#2", "mali-g76"]
    assert [each["name"] for each in found] == ["Own A", "Own B", "Mali-G76"]
    assert found[2]["tiles_rgba8"][2] == {"samples": 8, "pixels": 128, "spills": False}
    assert found[2]["features_recorded"] == ["sampleRateShading"]


def test_standard_input(folder: Path) -> None:
    done = run(
        folder, "device", "-", "--output", "json", stdin=reported.DIALECTS["vkjson"].encode()
    )
    assert (done.returncode, [each["key"] for each in devices(done.stdout)]) == (0, [None])
    done = run(folder, "device", "-", stdin=b"hello")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(
        "msaa-lint: standard input: it is not a device report; expected vulkaninfo"
    )


def test_what_cannot_be_had(folder: Path) -> None:
    done = run(folder, "device", "mali-g67", "phome.json", "two.txt#3", "phone.json")
    assert done.returncode == 2
    assert done.stderr.splitlines() == [
        "msaa-lint: no profile `mali-g67`; did you mean `mali-g76`?",
        "msaa-lint: no file `phome.json`; did you mean `phone.json`?",
        "msaa-lint: no device `3` in `two.txt`; `two.txt#1` is Own A, `two.txt#2` is Own B",
    ]
    assert done.stdout.startswith("Mali-G999 MC3"), "the others are shown"


def test_hostile_names_are_escaped(folder: Path) -> None:
    (folder / "own.json").write_text(
        reported.DIALECTS["gpuinfo"].replace(
            "Mali-G999 MC3", "\\u001b[31m\\u202eevil[/bold]\\ud800"
        )
    )
    done = run(folder, "device", "own.json")
    assert done.returncode == 0
    assert (
        done.stdout.splitlines()[0]
        == "\\x1b[31m\\u202eevil[/bold]\\ud800 (arm, tile-based, integrated GPU, Vulkan 1.3.77)"
    )
    for output in ("json", "description"):
        assert run(folder, "device", "own.json", "--output", output).returncode == 0
    (folder / "own.json").write_text(
        reported.DIALECTS["gpuinfo"].replace("Mali-G999 MC3", "::error::x")
    )
    assert run(folder, "device", "own.json").stdout.startswith("\\x3a:error::x (arm, ")


def test_list(folder: Path) -> None:
    text = run(folder, "device", "--list").stdout
    assert "mali-g715" in text
    assert "vulkan.gpuinfo.org report 38609" in text
    rows = json.loads(run(folder, "device", "--list", "--output", "json").stdout)["profiles"]
    assert {
        "key": "lavapipe",
        "name": "llvmpipe",
        "source": "vulkaninfo of llvmpipe, Mesa 22.3.6, LLVM 15.0.6",
    } in rows


def codes(folder: Path, *arguments: str) -> list[str]:
    done = run(folder, "check", "--output", "json", *arguments)
    return sorted(found["code"] for found in json.loads(done.stdout)["findings"])


def test_a_description_names_a_report(folder: Path) -> None:
    for name in ("phone.json", "nvidia", "lavapipe", "class.json#1"):
        (folder / "a.msaa.yaml").write_text(EIGHT.format(f'"{name}"'))
        written = run(folder, "device", name, "--output", "description")
        assert written.returncode == 0
        by_name = codes(folder, "a.msaa.yaml")
        assert not any(code.startswith("MSAA9") for code in by_name), by_name
        (folder / "a.msaa.yaml").write_text(
            written.stdout + EIGHT.split("\n", 1)[1].replace("{{", "{").replace("}}", "}")
        )
        assert codes(folder, "a.msaa.yaml") == by_name


def test_a_report_decides_what_is_found(folder: Path) -> None:
    (folder / "four.json").write_text(
        reported.DIALECTS["gpuinfo"].replace(
            '"framebufferColorSampleCounts": 13', '"framebufferColorSampleCounts": 5'
        )
    )
    (folder / "a.msaa.yaml").write_text(EIGHT.format("four.json"))
    four = codes(folder, "a.msaa.yaml")
    (folder / "a.msaa.yaml").write_text(EIGHT.format("phone.json"))
    assert set(four) - set(codes(folder, "a.msaa.yaml")), "8 samples are not supported by the one"
    (folder / "a.msaa.yaml").write_text(
        EIGHT.split("\n", 1)[1].replace("{{", "{").replace("}}", "}")
    )
    assert codes(folder, "--profile", "four.json", "a.msaa.yaml") == four
    (folder / "msaa-lint.toml").write_text('profile = "four.json"\n')
    assert codes(folder, "a.msaa.yaml") == four
    (folder / "inner").mkdir()
    (folder / "a.msaa.yaml").rename(folder / "inner" / "a.msaa.yaml")
    assert codes(folder / "inner", "a.msaa.yaml") == four, (
        "the path counts from the configuration's folder"
    )


def test_a_description_that_names_no_report(folder: Path) -> None:
    (folder / "a.msaa.yaml").write_text(EIGHT.format("phome.json"))
    done = run(folder, "check", "--output", "concise", "a.msaa.yaml")
    assert done.returncode == 2
    assert "a.msaa.yaml:1:9:" in done.stdout
    assert "no file `phome.json`" in done.stdout
    (folder / "broken.json").write_text("{")
    (folder / "a.msaa.yaml").write_text(EIGHT.format("broken.json"))
    assert codes(folder, "a.msaa.yaml") == ["MSAA903"]
    done = run(folder, "check", "--profile", "broken.json", "a.msaa.yaml")
    assert done.returncode == 2


def lavapipe() -> bool:
    return os.path.exists("/usr/share/vulkan/icd.d/lvp_icd.x86_64.json")


@pytest.mark.skipif(not lavapipe(), reason="lavapipe is not installed")
def test_the_running_driver(folder: Path) -> None:
    pytest.importorskip("vulkan")
    icd = "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json"
    done = run(folder, "device", "--output", "json", VK_DRIVER_FILES=icd)
    (found,) = devices(done.stdout)
    assert found["name"].startswith("llvmpipe")
    assert (found["vendor"], found["tiler"], found["device_type"], found["key"]) == (
        "mesa",
        False,
        "CPU",
        None,
    )
    assert found["sample_counts"]["color"] == [1, 4]
    assert found["lazily_allocated"] is False
    assert "sampleRateShading" in found["features"]
    assert run(folder, "device", VK_DRIVER_FILES=icd).stdout.startswith("llvmpipe")


def test_no_driver(folder: Path) -> None:
    pytest.importorskip("vulkan")
    done = run(folder, "device", VK_DRIVER_FILES=str(folder.parent / "none.json"))
    assert (done.returncode, done.stdout) == (2, "")
    assert "finds no driver" in done.stderr or "no Vulkan loader" in done.stderr
    assert "apt install" in done.stderr


def test_without_the_package(folder: Path) -> None:
    (folder / "broken").mkdir()
    (folder / "broken" / "vulkan.py").write_text(
        "raise ImportError(\"No module named 'vulkan'\", name='vulkan')\n"
    )
    done = run(folder, "device", PYTHONPATH=f"{folder / 'broken'}{os.pathsep}{ROOT}")
    assert done.returncode == 2
    assert needs_extra("calling a Vulkan driver", "confirm") in done.stderr
    assert (
        run(
            folder, "device", "mali-g76", PYTHONPATH=f"{folder / 'broken'}{os.pathsep}{ROOT}"
        ).returncode
        == 0
    )


def test_a_driver_that_crashes_is_named_by_its_signal(folder: Path) -> None:
    """A package `vulkan` that dies as a driver does: the command lives."""
    (folder / "crash").mkdir()
    (folder / "crash" / "vulkan.py").write_text(
        "import os, signal\nos.kill(os.getpid(), signal.SIGSEGV)\n"
    )
    done = run(folder, "device", PYTHONPATH=f"{folder / 'crash'}{os.pathsep}{ROOT}")
    assert done.returncode == 2
    assert "SIGSEGV" in done.stderr


def test_a_module_beside_the_input_is_not_run(folder: Path) -> None:
    (folder / "vulkan.py").write_text("open('ran', 'w')\n")
    run(folder, "device", VK_DRIVER_FILES="none")
    assert not (folder / "ran").exists()
