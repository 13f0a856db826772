"""The record beside a description: what makes it stale, what it justifies, and what a hostile one
cannot do.
"""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.experiments.study.measures import FLICKER
from msaa_lint.experiments.study.pareto import mark_best
from msaa_lint.experiments.study.points import MSAA, techniques
from msaa_lint.experiments.study.record import DocumentStudy, text, write
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.study import JUSTIFIES, STALE, UNUSABLE, Studied
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.input import readers
from msaa_lint.linter.study_record import AS_DESCRIBED, MAX_BYTES, PARTS, digests, path_of, studied
from tests.command import run
from tests.experiments.study.fakes import point, timed
from tests.paths import ROOT
from tests.strength import examples

FRAME = """\
frame: {width: 1920, height: 1080, fps: 60}
images:
  color_ms: {format: R8G8B8A8_UNORM, samples: 8, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL, LAZILY_ALLOCATED]}
  color: {format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}
  shadow: {format: D16_UNORM, samples: 1, usage: [DEPTH_STENCIL_ATTACHMENT, SAMPLED]}
renderPasses:
  forward:
    attachments:
      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}
      color: {image: color, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {colorAttachments: [color_ms], resolveAttachments: [color]}
  shadows:
    attachments:
      shadow: {image: shadow, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}
    subpasses:
      - {depthStencilAttachment: shadow}
pipelines:
  opaque:
    renderPass: forward
    multisampleState: {rasterizationSamples: 8}
    depthStencilState: {depthTestEnable: false}
  caster: {renderPass: shadows, multisampleState: {rasterizationSamples: 1}, depthStencilState: {depthTestEnable: true}}
scene: {color: LDR, edges: true}
"""


def document(source: str, name: str = "frame.msaa.yaml", number: int = 0) -> Document:
    made = Source(name, source)
    found = readers.read(made, parse(made, Limits()).documents[number])
    assert found.problems == ()
    return found


def frame(source: str = FRAME) -> Frame:
    return Frame(document(source))


MEDIUM = Shading("medium", 312, 4, 65536, 2e6, 4.17)
ON_A_DEVICE = "at 1920x1080 on a device under"
MEASURED = f"{ON_A_DEVICE} medium shading (4.17 ms a full screen, the default)"


def study(source: str = FRAME, with_times: bool = True) -> DocumentStudy:
    points = mark_best([(timed if with_times else point)(technique) for technique in techniques()])
    return DocumentStudy(
        frame(source), "a device" if with_times else "", (1920, 1080), points, MEDIUM
    )


def changed(*edits: tuple[str, str]) -> str:
    source = FRAME
    for old, new in edits:
        assert old in source
        source = source.replace(old, new)
    return source


SAME = {
    "a comment": [("images:", "# why not\nimages:")],
    "another sample count": [("samples: 8", "samples: 4"), ("rasterizationSamples: 8",
    "rasterizationSamples: 4")],
    "an image that nothing multisampled has to do with": [
        ("  shadow: {format", "  noise: {format: R8G8B8A8_SRGB, samples: 1, usage: [SAMPLED]}\n  "
            "shadow: {format")
    ],
    "an attachment's image renamed": [("color_ms", "samples_of_color")],
    "load and store operations": [("loadOp: CLEAR, storeOp: DONT_CARE", "loadOp: LOAD, storeOp: "
        "STORE")],
    "layouts": [("finalLayout: COLOR_ATTACHMENT_OPTIMAL", "finalLayout: GENERAL")],
    "memory and usage": [("usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT]",
    "usage: [COLOR_ATTACHMENT]")],
    "a rate": [("fps: 60", "fps: 120")],
    "another spelling": [("R8G8B8A8_UNORM", "VK_FORMAT_R8G8B8A8_UNORM")],
    "the cost of shading, whose name is compared": [("edges: true", "edges: true, shading: heavy")],
    "another order": [("color: LDR, edges: true", "edges: true, color: LDR")],
    "a pipeline like another": [
        ("pipelines:\n", "pipelines:\n  lit: {renderPass: forward, depthStencilState: "
            "{depthTestEnable: false}, multisampleState: {}}\n")
    ],
}  # fmt: skip

OTHER = {
    "scene": [("color: LDR", "color: HDR")],
    "size": [("width: 1920", "width: 1280")],
    "device": [("frame:", "device: mali-g610\nframe:")],
    "pipelines": [("depthTestEnable: false", "depthTestEnable: true")],
    "attachments": [("R8G8B8A8_UNORM", "R16G16B16A16_SFLOAT")],
    "shaders": [
        (
            "    depthStencilState: {depthTestEnable: false}",
            "    stages: [{stage: FRAGMENT, module: a.spv, name: main}]\n    depthStencilState: "
            "{depthTestEnable: false}",
        )
    ],
}


@pytest.mark.parametrize("name", SAME)
def test_what_a_study_does_not_answer_to_makes_no_record_stale(name: str) -> None:
    assert digests(frame(changed(*SAME[name])), "frame.msaa.yaml") == digests(
        frame(), "frame.msaa.yaml"
    )


@pytest.mark.parametrize("part", OTHER)
def test_what_a_study_answers_to_does(part: str) -> None:
    before, after = (
        digests(frame(), "frame.msaa.yaml"),
        digests(frame(changed(*OTHER[part])), "frame.msaa.yaml"),
    )
    assert [name for name in PARTS if before[name] != after[name]] == [part]
    assert set(before) == set(PARTS)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("resolveAttachments: [color]", "resolveAttachments: [null]"),
        ("  color: {format: R8G8B8A8_UNORM", "  color: {format: R8G8B8A8_SRGB"),
        ("  color: {format: R8G8B8A8_UNORM", "  color: {encoding: GAMMA, format: R8G8B8A8_UNORM"),
    ],
)
def test_how_colour_is_resolved_and_stored_counts(old: str, new: str) -> None:
    before, after = (
        digests(frame(), "frame.msaa.yaml"),
        digests(frame(changed((old, new))), "frame.msaa.yaml"),
    )
    assert [name for name in PARTS if before[name] != after[name]] == ["attachments"]


def test_alpha_to_coverage_of_a_multisampled_pipeline_counts() -> None:
    source = changed(
        ("rasterizationSamples: 8", "rasterizationSamples: 8, alphaToCoverageEnable: true")
    )
    assert (
        digests(frame(source), "frame.msaa.yaml")["pipelines"]
        != digests(frame(), "frame.msaa.yaml")["pipelines"]
    )


def test_a_record_is_sorted_small_and_the_same_for_the_same_study() -> None:
    made = text([study()], "frame.msaa.yaml")
    assert made == text([study()], "frame.msaa.yaml")
    assert len(made) < 2000
    data = json.loads(made)
    assert made == json.dumps(data, indent=2, sort_keys=True) + "\n"
    assert data["schema"] == "msaa-lint/study-record-v2"
    (own,) = data["studies"]
    assert (own["device"], own["size"], sorted(own["counts"], key=int)) == (
        "a device",
        [1920, 1080],
        ["1", "2", "4", "8", "16"],
    )
    assert (own["shading"], own["error_of"]) == (
        {"name": "medium", "full_screen_ms": 4.17},
        "error",
    )
    assert own["counts"]["8"] == {"error": 0.0361, "time_ms": 3.8, "justified": True, "reason": ""}
    assert own["counts"]["16"] == {
        "error": 0.0363,
        "time_ms": 7.6,
        "justified": False,
        "reason": "8x has no more error and costs no more",
    }
    assert all(re.fullmatch("[0-9a-f]{16}", own["inputs"][part]) for part in PARTS)


def test_a_study_without_counts_is_no_record() -> None:
    with pytest.raises(ValueError, match="no sample count was measured"):
        text([study()._replace(points=[])], "frame.msaa.yaml")


@pytest.fixture
def beside(tmp_path: Path) -> Path:
    """A description with the record of its study; the path of the description."""
    path = tmp_path / "frame.msaa.yaml"
    path.write_text(FRAME)
    assert write(str(path), [study()]) == f"{path}.msaa-study.json"
    assert sorted(each.name for each in tmp_path.iterdir()) == [
        "frame.msaa.yaml",
        "frame.msaa.yaml.msaa-study.json",
    ]
    return path


def of(path: Path, source: str = FRAME) -> Studied:
    return studied(frame(source), str(path))


def image_study(path: Path, source: str) -> tuple[object, object]:
    """What rules see of the multisampled image."""
    made = document(source, str(path))
    (own,) = [
        each
        for each in subjects(made, None, lambda own: studied(own, str(path)))
        if each.path == "images.color_ms"
    ]
    return own.facts.values["image.study"], own.facts.values["image.study_says"]


def test_the_record_says_what_was_found(beside: Path) -> None:
    assert image_study(beside, FRAME) == (
        JUSTIFIES,
        f"it leaves 50 % of 4x's error for 1.9 times its time {MEASURED}",
    )
    assert image_study(beside, FRAME.replace("samples: 8", "samples: 16")) == (
        "DECLINES",
        f"it leaves 50 % of 4x's error for 3.8 times its time {MEASURED}; 8x has no more error and "
        "costs no more",
    )
    assert image_study(beside, FRAME.replace("samples: 8", "samples: 32")) == (
        "DECLINES", "it did not measure 32x; it measured 1x, 2x, 4x, 8x, 16x",
    )  # fmt: skip


def test_without_a_time_that_is_said(tmp_path: Path) -> None:
    path = tmp_path / "frame.msaa.yaml"
    write(str(path), [study(with_times=False)])
    words = (
        "it leaves 50 % of 4x's error, at no known time, at 1920x1080; its time was not "
        "measured; `--device NAME` measures it"
    )
    assert image_study(path, FRAME) == ("DECLINES", words)


def test_a_count_of_at_most_four_asks_for_no_record(beside: Path) -> None:
    def never(_: Frame) -> Studied:
        raise AssertionError("it was asked for")

    made = document(FRAME.replace("samples: 8", "samples: 4"), str(beside))
    assert {
        each.facts.values.get("image.study", "NONE") for each in subjects(made, None, never)
    } == {"NONE"}


def test_no_record_is_none(tmp_path: Path) -> None:
    assert studied(frame(), str(tmp_path / "frame.msaa.yaml")).state == "NONE"
    assert studied(frame(), "<stdin>").state == "NONE"
    assert studied(frame(), "a\0b").state == "NONE"


def test_a_stale_record_names_what_changed(beside: Path) -> None:
    found = of(beside, changed(*OTHER["scene"], *OTHER["size"], *OTHER["device"]))
    assert (found.state, found.says) == (
        STALE,
        "device, scene and size changed since; run `msaa-lint study --record` again",
    )


OWN_COST = changed(("edges: true", "edges: true, shading: 200ops"))


def test_a_record_expires_when_the_description_s_own_cost_differs(tmp_path: Path) -> None:
    path = tmp_path / "frame.msaa.yaml"
    write(str(path), [study(OWN_COST)._replace(shading=Shading("200ops", 200, 0, 0, 1e6, 2.07))])
    own = image_study(path, OWN_COST)
    assert own == (
        JUSTIFIES, f"it leaves 50 % of 4x's error for 1.9 times its time {ON_A_DEVICE} 200ops "
            "shading (2.07 ms a full screen)",
    )  # fmt: skip
    for source, expected in (
        (OWN_COST.replace("200ops", "heavy"), "scene.shading is heavy"),
        (OWN_COST.replace("200ops", "medium"), "scene.shading is medium"),
        (FRAME, "without scene.shading, medium counts"),
    ):
        found = of(path, source)
        assert (found.state, found.says) == (
            STALE, f"it was made under `200ops` shading, and {expected}; run `msaa-lint study "
                "--record` again",
        )  # fmt: skip
    assert of(path, OWN_COST.replace("200ops", "200")).state == "", (
        "another spelling of the same cost"
    )


def test_the_default_cost_is_the_same_whether_stated_or_not(beside: Path) -> None:
    stated = changed(("edges: true", "edges: true, shading: medium"))
    assert image_study(beside, stated) == (
        JUSTIFIES, f"it leaves 50 % of 4x's error for 1.9 times its time {ON_A_DEVICE} medium "
            "shading (4.17 ms a full screen)",
    )  # fmt: skip
    assert (
        of(
            beside,
            changed(
                (
                    "scene: {color: LDR, edges: true}",
                    "scene: {color: LDR, edges: true, shading: heavy}",
                )
            ),
        ).state
        == STALE
    )


def test_a_record_made_with_a_frame_s_own_shaders_expires_when_they_change(tmp_path: Path) -> None:
    path, source = tmp_path / "frame.msaa.yaml", changed(*OTHER["shaders"])
    (tmp_path / "a.spv").write_bytes(b"one")
    write(str(path), [study(source)._replace(shading=Shading(AS_DESCRIBED))])
    words = (
        "it leaves 50 % of 4x's error for 1.9 times its time at 1920x1080 on a device with its "
        "own fragment shaders"
    )
    assert image_study(path, source) == (JUSTIFIES, words)
    (tmp_path / "a.spv").write_bytes(b"two")
    assert of(path, source) == Studied(
        STALE, "shaders changed since; run `msaa-lint study --record` again"
    )
    (tmp_path / "a.spv").unlink()
    assert of(path, source).state == STALE
    os.mkfifo(tmp_path / "a.spv")
    assert of(path, source).state == STALE, "and what is not a file is not read"


def test_a_record_without_a_cost_is_stale(beside: Path) -> None:
    Path(path_of(str(beside))).write_bytes(edited(put("schema", "msaa-lint/study-record-v1")))
    assert of(beside) == Studied(
        STALE, "it was made without a cost of shading; run `msaa-lint study --record` again"
    )


def test_without_times_any_cost_is_the_record_s(tmp_path: Path) -> None:
    path = tmp_path / "frame.msaa.yaml"
    write(str(path), [study(with_times=False)])
    assert json.loads(Path(path_of(str(path))).read_text())["studies"][0]["shading"] is None
    assert of(path).state == of(path, OWN_COST).state == ""


def test_a_ruling_goes_by_the_error_that_counts_and_by_no_software_driver(tmp_path: Path) -> None:
    path = tmp_path / "frame.msaa.yaml"
    of_flicker = study()
    points = [each._replace(flicker=0.1 / each.technique.samples) for each in of_flicker.points]
    write(str(path), [of_flicker._replace(points=points, measure=FLICKER)])
    assert (
        image_study(path, FRAME)[1]
        == f"it leaves 50 % of 4x's flicker for 1.9 times its time {MEASURED}"
    )
    write(str(path), [study()._replace(software=True)])
    assert image_study(path, FRAME) == (
        "DECLINES",
        f"it leaves 50 % of 4x's error for 1.9 times its time {MEASURED}; its time is a software "
        "driver's, which says nothing about a GPU",
    )


def test_a_stream_has_a_study_for_each_document(tmp_path: Path) -> None:
    path = tmp_path / "two.msaa.yaml"
    second = changed(*OTHER["scene"])
    write(str(path), [study(), study(second)])
    assert of(path).state == of(path, second).state == ""
    assert of(path, changed(*OTHER["scene"], *OTHER["size"])).says.startswith("size changed since")


def test_a_record_that_cannot_be_written_leaves_the_old_one(
    beside: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = Path(path_of(str(beside))).read_bytes()
    monkeypatch.setattr(
        os, "replace", lambda *_: (_ for _ in ()).throw(OSError(28, "No space left on device"))
    )
    with pytest.raises(OSError, match="No space left"):
        write(str(beside), [study(with_times=False)])
    assert Path(path_of(str(beside))).read_bytes() == before
    assert len(list(beside.parent.iterdir())) == 2


def broken(beside: Path, data: bytes) -> str:
    Path(path_of(str(beside))).write_bytes(data)
    found = of(beside)
    assert found.state == UNUSABLE
    return found.says.removeprefix("frame.msaa.yaml.msaa-study.json")


def edited(edit: Any) -> bytes:
    data = json.loads(text([study()], "frame.msaa.yaml"))
    edit(data)
    return json.dumps(data).encode()


def put(*keys: Any) -> Any:
    *path, last, value = keys

    def edit(data: Any) -> None:
        for key in path:
            data = data[key]
        data[last] = value

    return edit


COUNT = ("studies", 0, "counts", "8")


@pytest.mark.parametrize(
    ("edit", "words"),
    [
        (
            put("schema", "msaa-lint/study-record-v3"),
            'line 1: expected the schema "msaa-lint/study-record-v2"',
        ),
        (put("more", 1), "line 1: unknown key `more`"),
        (put("studies", []), "line 1: `studies` must be a list with at least one element"),
        (put("studies", {}), "`studies` must be a list"),
        (
            put("studies", 0, None),
            "line 1: expected an object with inputs, device, shading, error_of, size, counts",
        ),
        (put("studies", 0, "size", [1]), "`size` must be a list of width and height"),
        (put("studies", 0, "size", [1, 0]), "expected a positive integer number of pixels"),
        (put("studies", 0, "size", [True, 1]), "expected a positive integer number of pixels"),
        (put("studies", 0, "device", "x" * 201), "expected a string of at most 200 characters"),
        (put("studies", 0, "device", None), "expected a string of at most 200 characters"),
        (put("studies", 0, "shading", None), "times need a cost of shading"),
        (put("studies", 0, "shading", "medium"), "expected an object with name, full_screen_ms"),
        (put("studies", 0, "shading", "name", 5), "expected a string of at most 200 characters"),
        (put("studies", 0, "shading", "full_screen_ms", -1), "expected a number of at least 0"),
        (put("studies", 0, "error_of", None), "expected a string of at most 200 characters"),
        (put("studies", 0, "inputs", "scene", 5), "expected a string of at most 200 characters"),
        (
            put("studies", 0, "inputs", {}),
            "missing attachments, device, pipelines, scene, shaders, size",
        ),
        (
            put("studies", 0, "counts", {}),
            "`counts` must be an object with at least one sample count",
        ),
        (put("studies", 0, "counts", "3", {}), "`3` is not a sample count"),
        (
            put("studies", 0, "counts", "8x" * 50, {}),
            "`8x8x8x8x8x8x8x8x8x8…` is not a sample count",
        ),
        (put(*COUNT, "error", -1), "expected a number of at least 0"),
        (put(*COUNT, "error", "0.1"), "expected a number of at least 0"),
        (put(*COUNT, "error", True), "expected a number of at least 0"),
        (put(*COUNT, "error", float("nan")), "expected a number of at least 0"),
        (put(*COUNT, "time_ms", float("inf")), "expected a number of at least 0"),
        (put(*COUNT, "justified", 1), "`justified` must be true or false"),
        (put(*COUNT, "reason", []), "expected a string of at most 200 characters"),
    ],
)
def test_a_malformed_record_is_said_to_be(beside: Path, edit: Any, words: str) -> None:
    assert words in broken(beside, edited(edit))


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", ": expected one JSON object"),
        (b"null", ", line 1: expected an object with schema, studies"),
        (b"{} \n---\n{}", ": expected one JSON object"),
        (b"{", "line 1"),
        (b"\xff\xfe\x00", "UTF-16"),
        (b"\xff", ": it is not UTF-8"),
        (b"[" * 100_000, "nest"),
        (b"{" * 20, "line 1"),
        (b'{"schema": 1, "schema": 2}', "`schema`"),
        (b'{"schema": "a\x00b"}', "U+0000"),
        (b"a: &a [1,1,1,1,1,1,1,1]\nb: &b [*a,*a,*a,*a,*a,*a,*a,*a]\nc: &c "
            b"[*b,*b,*b,*b,*b,*b,*b,*b]\nd: &d [*c,*c,*c,*c,*c,*c,*c,*c]\n"
         b"e: &e [*d,*d,*d,*d,*d,*d,*d,*d]\nf: [*e,*e,*e,*e,*e,*e,*e,*e]\n", "20000"),
        (b" " * (MAX_BYTES + 1), f": it is larger than the limit of {MAX_BYTES} bytes"),
    ],
)  # fmt: skip
def test_a_hostile_record_is_said_to_be(beside: Path, data: bytes, words: str) -> None:
    assert words in broken(beside, data)


@examples(1.5)
@given(st.data())
def test_no_record_makes_a_crash(data: st.DataObject) -> None:
    whole = text([study()], "frame.msaa.yaml").encode()
    start = data.draw(st.integers(0, len(whole)))
    end = data.draw(st.integers(start, min(start + 40, len(whole))))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "frame.msaa.yaml"
        Path(path_of(str(path))).write_bytes(
            whole[:start] + data.draw(st.binary(max_size=8)) + whole[end:]
        )
        found = of(path)
    assert found.state in ("", STALE, UNUSABLE)
    assert len(found.says) < 500


def test_what_is_no_file_is_not_read(
    beside: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    record = Path(path_of(str(beside)))
    record.unlink()
    record.mkdir()
    assert of(beside).state == UNUSABLE and "it is a folder, not a regular file" in of(beside).says
    record.rmdir()
    os.mkfifo(record)
    assert "it is a pipe, not a regular file" in of(beside).says
    record.unlink()
    record.symlink_to(tmp_path_factory.mktemp("elsewhere") / "secret")
    assert (
        of(beside).says
        == "frame.msaa.yaml.msaa-study.json cannot be read: it is outside the project"
    )
    record.unlink()
    record.symlink_to("nowhere")
    assert "cannot be read: No such file or directory" in of(beside).says


def check(path: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    return run(
        path.parent,
        "check",
        "--isolated",
        "--select",
        "MSAA101",
        *arguments,
        path.name,
        NO_COLOR="1",
    )


def test_check_accepts_what_a_current_record_justifies_and_says_so(beside: Path) -> None:
    done = check(beside, "--fail-on-cost", "1mW")
    assert done.returncode == 0
    assert (
        "note[sample-count-above-four] `color_ms` has 8 samples per pixel, which its study "
        "justifies: "
        f"it leaves 50 % of 4x's error for 1.9 times its time {MEASURED} (MSAA101)" in done.stdout
    )
    (found,) = json.loads(check(beside, "--output", "json").stdout)["findings"]
    assert (found["severity"], found["fixable"], found["price"]) == ("note", False, None)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "samples: 8",
            "samples: 16",
            "which its study does not justify: it leaves 50 % of 4x's error for 3.8 times its time",
        ),
        (
            "LDR",
            "HDR",
            "and its study record is stale: scene changed since; run `msaa-lint study --record` "
            "again",
        ),
    ],
)
def test_check_reports_what_a_record_does_not_justify(
    beside: Path, old: str, new: str, words: str
) -> None:
    beside.write_text(FRAME.replace(old, new))
    done = check(beside)
    assert done.returncode == 1
    assert "warning[sample-count-above-four]" in done.stdout and words in done.stdout


def test_check_tells_a_broken_record_and_goes_on(beside: Path) -> None:
    Path(path_of(str(beside))).write_text('{"schema": "\\u001b[31m"}')
    done = check(beside)
    assert done.returncode == 1 and done.stderr == ""
    assert (
        "its study record cannot be used: frame.msaa.yaml.msaa-study.json, line 1: missing studies"
        in done.stdout
    )
    hostile = edited(put("studies", 0, "device", "\x1b[31m\u202e##[x]"))
    Path(path_of(str(beside))).write_bytes(hostile)
    done = check(beside)
    assert done.returncode == 0
    assert "\x1b" not in done.stdout and "\u202e" not in done.stdout and "##[" not in done.stdout


def test_check_without_a_record_is_as_ever(beside: Path) -> None:
    Path(path_of(str(beside))).unlink()
    done = check(beside)
    assert done.returncode == 1
    assert "has 8 samples per pixel, but only up to 4 run at full rate; use 4" in done.stdout


def imported(path: Path) -> set[str]:
    environment = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("MSAA_LINT_", "COV"))
    }
    command = [
        sys.executable,
        "-X",
        "importtime",
        "-m",
        "msaa_lint",
        "check",
        "--isolated",
        path.name,
    ]
    done = subprocess.run(
        command,
        cwd=path.parent,
        env={**environment, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    return set(re.findall(r"^import time:.*\|\s*([\w.]+)\s*$", done.stderr, re.MULTILINE))


def test_a_record_is_read_without_anything_heavy(beside: Path) -> None:
    found = imported(beside)
    assert {"msaa_lint.linter.study_record", "hashlib"} <= found
    roots = {name.partition(".")[0] for name in found}
    assert roots.isdisjoint(
        {"numpy", "json", "multiprocessing", "altair", "pydantic", "typer", "rich"}
    )
    assert not any(
        name.startswith("msaa_lint.experiments.study.") or name == "msaa_lint.experiments.study"
        for name in found
    )
    Path(path_of(str(beside))).unlink()
    assert "hashlib" not in imported(beside)
    beside.write_text(FRAME.replace("samples: 8", "samples: 4"))
    assert "msaa_lint.linter.study_record" not in imported(beside)


def test_a_folder_s_records_are_no_inputs(beside: Path) -> None:
    done = run(beside.parent, "check", "--isolated", "--output", "json", ".")
    assert json.loads(done.stdout)["summary"]["files"] == 1


def test_counts_that_the_kinds_leave_out_are_not_recorded() -> None:
    only = [each for each in study().points if each.technique.kind == MSAA][:3]
    (own,) = json.loads(text([study()._replace(points=only)], "frame.msaa.yaml"))["studies"]
    assert sorted(own["counts"], key=int) == ["1", "2", "4"]
