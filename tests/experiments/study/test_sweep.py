"""Sweeps: every point once, whatever the backend; kept as they come; what fails is said and the
others go on.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import threading
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.core.extras import pip_install
from msaa_lint.experiments.study.checkpoint import Checkpoint
from msaa_lint.experiments.study.points import MSAA, SAMPLE_SHADING, Point, Technique, techniques
from msaa_lint.experiments.study.shading import Shading
from msaa_lint.experiments.study.sweep import costs, ordered, sweep, with_cost
from msaa_lint.experiments.study.tasks import FailedPoint, StudyInput, Task, Unusable
from msaa_lint.experiments.study.times import Cost, CostModel
from tests.experiments.study.fakes import DeviceClock, measure, point, tasks
from tests.strength import examples

ALL = techniques()
FEW = [
    Technique(MSAA, 1),
    Technique(MSAA, 4),
    Technique(MSAA, 8),
    Technique(SAMPLE_SHADING, 4, 0.5),
]

NO_SHADING = [Shading("")]
WORK = Shading("2ops", operations=2)


def in_order(
    results: list[Point | FailedPoint], *names: str, own: list[Technique]
) -> list[Point | FailedPoint]:
    return ordered(results, names, own)


def never(task: Task) -> Point:
    raise AssertionError(f"{task.technique.name} was there already")


@pytest.mark.parametrize("jobs", [1, 2, None])
def test_every_number_of_jobs_gives_every_point(jobs: int | None) -> None:
    results = list(sweep(tasks("a", "b", techniques=ALL), jobs=jobs, measure=measure))
    expected = [point(technique, name) for name in ("a", "b") for technique in ALL]
    assert in_order(results, "a", "b", own=ALL) == expected


@pytest.mark.parametrize("jobs", [1, 2])
def test_a_point_that_fails_is_said_and_the_others_go_on(jobs: int) -> None:
    results = in_order(
        list(sweep(tasks("breaks", "a", techniques=FEW), jobs=jobs, measure=measure)),
        "breaks",
        "a",
        own=FEW,
    )
    assert results[1] == FailedPoint(
        "breaks", FEW[1], "ValueError: the picture \x1b[31m is no picture"
    )
    assert [isinstance(each, Point) for each in results] == [
        True,
        False,
        True,
        True,
        True,
        True,
        True,
        True,
    ]


def test_a_worker_that_dies_takes_only_its_own_point() -> None:
    results = in_order(
        list(sweep(tasks("a", "dies", techniques=FEW), jobs=2, measure=measure)),
        "a",
        "dies",
        own=FEW,
    )
    (failed,) = [each for each in results if isinstance(each, FailedPoint)]
    assert (failed.scene, failed.technique) == ("dies", Technique(MSAA, 4))
    assert (
        failed.reason
        == "it ended the process that read it (exit code 3): please report it with the input"
    )
    assert len(results) == 8


def test_points_that_are_kept_are_not_had_again(tmp_path: Path) -> None:
    wanted = tasks("a", techniques=ALL)
    first = list(sweep(wanted, checkpoint=Checkpoint(str(tmp_path)), measure=measure))
    assert list(sweep(wanted, checkpoint=Checkpoint(str(tmp_path)), measure=never)) == first
    assert len(list(tmp_path.iterdir())) == len(ALL)


def test_each_point_is_kept_before_the_next_is_asked_for(tmp_path: Path) -> None:
    """What a stop at any place loses is at most what was under way."""
    running = sweep(
        tasks("a", techniques=ALL), checkpoint=Checkpoint(str(tmp_path)), measure=measure
    )
    for count in range(1, 6):
        next(running)
        assert len(list(tmp_path.glob("*.json"))) == count
        assert len(list(tmp_path.iterdir())) == count


@examples(0.2)
@given(st.integers(0, len(ALL)), st.sampled_from([1, 2]))
def test_resumed_after_any_stop_it_is_the_same(stop: int, jobs: int) -> None:
    wanted = tasks("a", techniques=ALL)
    with tempfile.TemporaryDirectory() as folder:
        running = sweep(wanted, checkpoint=Checkpoint(folder), measure=measure, jobs=jobs)
        for _ in range(stop):
            next(running)
        running.close()  # type: ignore[attr-defined]
        told: list[tuple[int, int]] = []
        again = list(
            sweep(
                wanted,
                checkpoint=Checkpoint(folder),
                measure=measure,
                progress=lambda done, total, _: told.append((done, total)),
            )
        )
    assert in_order(again, "a", own=ALL) == [point(technique, "a") for technique in ALL]
    assert told == [(n + 1, len(ALL)) for n in range(len(ALL))]


def test_failures_are_not_kept(tmp_path: Path) -> None:
    wanted = tasks("breaks", techniques=FEW)
    assert [
        type(each) for each in sweep(wanted, checkpoint=Checkpoint(str(tmp_path)), measure=measure)
    ].count(FailedPoint) == 1
    mended = list(
        sweep(
            wanted,
            checkpoint=Checkpoint(str(tmp_path)),
            measure=lambda task: point(task.technique, "breaks"),
        )
    )
    assert [type(each) for each in mended].count(FailedPoint) == 0


@pytest.mark.parametrize(
    "change",
    [
        {"width": 65},
        {"height": 49},
        {"bits": 4},
        {"ssim": True},
        {"flip": True},
        {"technique": Technique(MSAA, 8)},
        {"input": StudyInput("scene", "b")},
        {"input": StudyInput("description", "a", text="images: {}")},
        {"input": StudyInput("description", "a", text="images: {}", number=1)},
        {"input": StudyInput("description", "a", text="images: {} # ")},
    ],
)
def test_what_was_made_otherwise_is_had_anew(tmp_path: Path, change: dict[str, object]) -> None:
    (task,) = tasks("a", techniques=[Technique(MSAA, 4)])
    kept = Checkpoint(str(tmp_path))
    kept.save_point(task, point(task.technique, "a"))
    assert kept.point(task) is not None
    assert kept.point(task._replace(**change)) is None  # type: ignore[arg-type]


def test_a_mesh_that_changed_is_had_anew(tmp_path: Path) -> None:
    from msaa_lint.experiments.study import checkpoint as module

    mesh = tmp_path / "mesh.obj"
    mesh.write_text("v 0 0 0\n")
    task = Task(StudyInput("mesh", "mesh.obj", str(mesh)), Technique(MSAA, 4), 64, 48)
    kept = Checkpoint(str(tmp_path / "kept"))
    kept.save_point(task, point(task.technique, "mesh.obj"))
    assert kept.point(task) is not None
    mesh.write_text("v 0 0 1\n")
    module._contents.cache_clear()
    assert kept.point(task) is None


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "null", '{"schema": "msaa-lint/study-point-v1"}', "[" * 100_000, "\udcff"],
)
def test_what_is_kept_and_broken_is_had_anew(tmp_path: Path, text: str) -> None:
    (task,) = tasks("a", techniques=[Technique(MSAA, 4)])
    kept = Checkpoint(str(tmp_path))
    kept.save_point(task, point(task.technique, "a"))
    (path,) = tmp_path.iterdir()
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    assert list(sweep([task], checkpoint=kept, measure=measure)) == [point(task.technique, "a")]
    assert list(sweep([task], checkpoint=kept, measure=never)) == [point(task.technique, "a")]


def test_a_stored_point_of_another_scene_is_simulated_again(tmp_path: Path) -> None:
    (task,) = tasks("a", techniques=[Technique(MSAA, 4)])
    checkpoint = Checkpoint(str(tmp_path))
    checkpoint.save_point(task, point(task.technique, "b"))
    assert list(sweep([task], checkpoint=checkpoint, measure=measure)) == [
        point(task.technique, "a")
    ]


@given(
    st.dictionaries(
        st.sampled_from([*Point._fields, "more"]),
        st.none() | st.booleans() | st.floats() | st.text(max_size=3),
        max_size=30,
    )
)
def test_no_content_of_the_folder_makes_a_crash(values: dict[str, object]) -> None:
    (task,) = tasks("a", techniques=[Technique(MSAA, 4)])
    with tempfile.TemporaryDirectory() as folder:
        kept = Checkpoint(folder)
        kept.save_point(task, point(task.technique, "a"))
        (name,) = os.listdir(folder)
        path = os.path.join(folder, name)
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
        data["values"] |= values
        with open(path, "w", encoding="utf-8") as file:
            json.dump(data, file)
        found = kept.point(task)
        if found is not None:
            assert found.technique == task.technique
            for name in ("rmse", "max_error", "bias", "psnr_db", "simulated_ms"):
                assert type(getattr(found, name)) in (int, float)


def test_a_folder_that_cannot_be_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(Unusable, match=r"--resume .*file: "):
        Checkpoint(str(tmp_path / "file"))


def test_infinity_survives(tmp_path: Path) -> None:
    (task,) = tasks("a", techniques=[Technique(MSAA, 4)])
    exact = point(task.technique, "a", psnr_db=float("inf"), rmse=0.1 + 0.2)
    kept = Checkpoint(str(tmp_path))
    kept.save_point(task, exact)
    assert kept.point(task) == exact


def test_one_sample_is_always_timed_and_each_technique_once() -> None:
    clock = DeviceClock()
    found = costs(
        [Technique(MSAA, 4), Technique(MSAA, 4)], [Shading("none"), WORK], (64, 48), clock
    )
    assert clock.input == [Technique(MSAA, 1), Technique(MSAA, 4)]
    made = with_cost(point(Technique(MSAA, 4)), found, Shading("none"), clock.name)
    assert (made.shading, made.time_ms, made.time_from, made.ratio, made.bytes_per_frame) == (
        "none",
        8.0,
        "a device",
        4.0,
        4000,
    )
    assert (made.low_ms, made.high_ms) == (0.95 * 8.0, 1.05 * 8.0)
    worked = with_cost(point(Technique(MSAA, 4)), found, WORK, clock.name)
    assert (worked.shading, worked.time_ms, worked.ratio) == ("2ops", 24.0, 4.0), (
        "the ratio is to one sample under the same cost"
    )


def test_what_the_device_does_not_draw_has_no_time_and_no_source() -> None:
    found = costs([Technique(MSAA, 8)], NO_SHADING, (64, 48), DeviceClock(unsupported=(8,)))
    made = with_cost(point(Technique(MSAA, 8)), found, NO_SHADING[0], "a device")
    assert (made.time_ms, made.time_from, made.ratio, made.bytes_per_frame) == (
        None,
        "",
        None,
        1000,
    )
    unknown = with_cost(
        point(Technique(MSAA, 4)),
        {(Technique(MSAA, 1), ""): Cost(), (Technique(MSAA, 4), ""): Cost(time_ms=2.0)},
        NO_SHADING[0],
        "a device",
    )
    assert (unknown.time_ms, unknown.ratio) == (2.0, None)


def test_times_that_are_kept_are_not_taken_again(tmp_path: Path) -> None:
    first, again = DeviceClock(), DeviceClock()
    found = costs(ALL, NO_SHADING, (64, 48), first, Checkpoint(str(tmp_path)))
    assert costs(ALL, NO_SHADING, (64, 48), again, Checkpoint(str(tmp_path))) == found
    assert again.input == []
    for other in (DeviceClock("another device"),):
        costs(ALL, NO_SHADING, (64, 48), other, Checkpoint(str(tmp_path)))
        assert len(other.input) == len(ALL)
    shaded = DeviceClock()
    costs(ALL, [*NO_SHADING, WORK], (64, 48), shaded, Checkpoint(str(tmp_path)))
    assert len(shaded.input) == len(ALL), "all costs of shading are timed together"
    bigger = DeviceClock()
    costs(ALL, NO_SHADING, (65, 48), bigger, Checkpoint(str(tmp_path)))
    assert len(bigger.input) == len(ALL)


def test_the_models_costs_are_kept_by_what_it_takes_a_frame_to_be(tmp_path: Path) -> None:
    kept = Checkpoint(str(tmp_path))
    plain = costs(FEW, NO_SHADING, (64, 48), CostModel(), kept)
    assert plain[Technique(MSAA, 4), ""].time_ms is None, "the cost model has no time"
    assert costs(FEW, NO_SHADING, (64, 48), CostModel(hdr=True), kept)[
        Technique(MSAA, 1), ""
    ].bytes_per_frame == 2 * (plain[Technique(MSAA, 1), ""].bytes_per_frame or 0)
    assert costs(FEW, NO_SHADING, (64, 48), CostModel(), kept) == plain


@pytest.mark.parametrize(("package", "backend", "words"), [
    ("distributed", "dask", "--backend dask: distributed is not installed: run "
        f"`{pip_install('distributed')}`"),
    ("ray", "ray", f"--backend ray: ray is not installed: run `{pip_install('ray')}`"),
])  # fmt: skip
def test_a_backend_that_is_not_installed_is_said(
    monkeypatch: pytest.MonkeyPatch, package: str, backend: str, words: str
) -> None:
    for name in [name for name in sys.modules if name.partition(".")[0] == package]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, package, None)  # type: ignore[arg-type]
    with pytest.raises(Unusable) as raised:
        list(sweep(tasks("a", techniques=FEW), jobs=2, backend=backend, measure=measure))
    assert str(raised.value) == words


def test_a_sweep_beside_other_threads_gives_every_point() -> None:
    """Of a process with threads, as a progress bar has one, no copies are made: others are started,
    which import what they need.
    """
    end = threading.Event()
    thread = threading.Thread(target=end.wait)
    thread.start()
    try:
        results = list(sweep(tasks("a", techniques=ALL), jobs=2, measure=measure))
    finally:
        end.set()
        thread.join()
    assert in_order(results, "a", own=ALL) == [point(technique, "a") for technique in ALL]


@pytest.mark.parametrize(("shader", "pictures"), [(True, 4), (False, 3)])
def test_points_of_one_picture_are_simulated_together(shader: bool, pictures: int) -> None:
    """One sample, four, and eight; without a shader half of four samples shaded is four."""
    wanted = [task._replace(shader=shader) for task in tasks("a", techniques=FEW)]
    assert len({task.picture for task in wanted}) == pictures
    assert in_order(list(sweep(wanted, measure=measure)), "a", own=FEW) == [
        point(technique, "a") for technique in FEW
    ]
