"""Inputs at URLs: on a server of S3's protocol, and in fsspec's memory."""

from __future__ import annotations

import gc
import json
import os
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.core import urls
from msaa_lint.core.execution import processes
from msaa_lint.core.text import files
from msaa_lint.linter import input_runs
from tests.command import Done, run
from tests.descriptions import CLEAN, STORED
from tests.frame.spirv.generate import SHADERS
from tests.paths import ROOT

fsspec = pytest.importorskip("fsspec")
asyn = pytest.importorskip("fsspec.asyn")

CAPTURE = ROOT / "examples/capture/forward.jsonl"
LOOK = "images: {color: {format: R8G8B8A8_UNORM}}\n"
PIPELINE = """\
pipelines:
  p: {stages: [{stage: FRAGMENT, module: %s}], multisampleState: {rasterizationSamples: 4, alphaToCoverageEnable: true}}
"""

Put = Callable[[str, str | bytes], None]


@pytest.fixture(autouse=True)
def forgotten(monkeypatch: pytest.MonkeyPatch) -> None:
    """What one test may read, another one may not."""
    monkeypatch.setattr(urls, "_allowed", set())
    monkeypatch.setattr(urls, "_listed", {})
    monkeypatch.setattr(urls, "_versions", {})


@pytest.fixture
def put() -> Iterator[Put]:
    """Writes an object to fsspec's memory."""
    memory = fsspec.filesystem("memory")
    yield lambda path, data: memory.pipe_file(
        path, data.encode() if isinstance(data, str) else data
    )
    memory.store.clear()
    memory.pseudo_dirs[:] = [""]


@pytest.fixture(scope="module")
def server() -> Iterator[dict[str, str]]:
    """The environment for a server of S3's protocol."""
    storage = pytest.importorskip("s3fs").S3FileSystem
    storage.clear_instance_cache()
    moto = pytest.importorskip("moto.server").ThreadedMotoServer("127.0.0.1", 0, verbose=False)
    moto.start()
    host, port = moto.get_host_and_port()
    yield {
        "AWS_ENDPOINT_URL": f"http://{host}:{port}",
        "AWS_ACCESS_KEY_ID": "key",
        "AWS_SECRET_ACCESS_KEY": "secret",
        "AWS_DEFAULT_REGION": "us-east-1",
    }
    storage.clear_instance_cache()
    moto.stop()
    # Other tests copy this process, which must have no other threads.
    gc.collect()
    if asyn.loop[0] is not None:
        asyn.loop[0].call_soon_threadsafe(asyn.loop[0].stop)
        asyn.iothread[0].join(10)
        asyn.loop[0] = asyn.iothread[0] = None


@pytest.fixture
def bucket(server: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """An empty bucket `frames`, as a file system."""
    for name, value in server.items():
        monkeypatch.setenv(name, value)
    storage = fsspec.filesystem("s3", use_listings_cache=False)
    storage.mkdir("frames")
    yield storage
    storage.rm("frames", recursive=True)


def check(folder: Path, *arguments: str, **environment: str) -> Done:
    return run(folder, "check", "--output", "concise", *arguments, **environment)


def linted(folder: Path, *arguments: str, **environment: str) -> list[str]:
    """The names of the files that were linted."""
    done = run(folder, "check", "--output", "json", *arguments, **environment)
    return [each["file"] for each in json.loads(done.stdout)["inputs"]]


def test_a_bucket_reads_as_a_folder(bucket: Any, server: dict[str, str], tmp_path: Path) -> None:
    """The same inputs, findings, notes, and exit code in every format, except for the names."""
    (tmp_path / ".git").mkdir()
    corpus = tmp_path / "corpus"
    for name, data in {
        "a.msaa.yaml": STORED,
        "b/look.yaml": LOOK,
        "b/other.yaml": "name: ci\n",
        "b/node_modules/x.msaa.yaml": STORED,
        ".hidden/x.msaa.yaml": STORED,
        "c d/forward.jsonl": CAPTURE.read_bytes(),
        "c d/game.gfxr": b"GFXR" + bytes(100),
        "c d/near.yaml": "images: {color: {samples: 4}}\n",
        "e/shader.msaa.yaml": PIPELINE % "../modules/a.spv",
        "modules/a.spv": (SHADERS / "no_alpha.frag.spv").read_bytes(),
        "z/own.json": '{"schema": "msaa-lint/baseline-v1"}',
        "z/depth.cpp": (ROOT / "examples/code/forward.cpp").read_bytes(),
    }.items():
        path = corpus / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
    bucket.put(f"{corpus}/", "frames/corpus/", recursive=True)
    bucket.touch("frames/corpus/b/")
    for format in ("concise", "full", "json", "github", "markdown"):
        here = run(tmp_path, "check", "--output", format, "corpus")
        there = run(tmp_path, "check", "--output", format, "s3://frames/corpus/", **server)
        place = "s3%3A//frames/corpus/" if format == "github" else "s3://frames/corpus/"
        if format in ("concise", "json", "github"):
            assert there.stdout.replace(place, "corpus/") == here.stdout
        assert there.stderr.replace("s3://frames/corpus/", "corpus/") == here.stderr
        assert there.returncode == here.returncode == 1
        assert "MSAA201" in there.stdout
    assert linted(tmp_path, "s3://frames/corpus", **server) == [
        f"s3://frames/corpus/{name}"
        for name in (
            "a.msaa.yaml",
            "b/look.yaml",
            "c d/forward.jsonl",
            "e/shader.msaa.yaml",
            "z/depth.cpp",
        )
    ]


def test_processes_of_their_own_read_buckets(
    bucket: Any, server: dict[str, str], tmp_path: Path
) -> None:
    bucket.pipe(
        {
            f"frames/many/{number}/{name}.msaa.yaml": STORED.encode()
            for number in range(2)
            for name in "abcde"
        }
    )
    bucket.pipe_file("frames/many/z/z.msaa.yaml", (PIPELINE % "../0/a.spv").encode())
    bucket.pipe_file("frames/many/0/a.spv", (SHADERS / "no_alpha.frag.spv").read_bytes())
    one, two = (check(tmp_path, "--jobs", jobs, "s3://frames/many", **server) for jobs in "12")
    assert (one.stdout, one.stderr, one.returncode) == (two.stdout, two.stderr, two.returncode)
    assert one.stdout.count("MSAA201") == 10 and "outside the project" not in one.stdout


def test_many_objects_are_divided_without_being_asked(
    bucket: Any, server: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The connections have threads, so that the processes cannot be copies of this one."""
    started: list[int] = []
    create = processes.Processes.__init__

    def counted(self: processes.Processes, workers: int) -> None:
        started.append(workers)
        create(self, workers)

    monkeypatch.setattr(processes.Processes, "__init__", counted)
    monkeypatch.setattr(processes, "cores", lambda: 2)
    monkeypatch.setattr(input_runs, "MIN_DIVIDED_ANEW", 4 * input_runs.URL_BYTES)
    bucket.pipe({f"frames/many/{name}.msaa.yaml": STORED.encode() for name in "abcd"})
    done = check(tmp_path, "s3://frames/many", **server)
    assert started == [2] and not processes.can_copy() and done.stdout.count("MSAA201") == 4
    assert (
        check(
            tmp_path, "s3://frames/many/a.msaa.yaml", "s3://frames/many/b.msaa.yaml", **server
        ).stdout.count("MSAA201")
        == 2
    )
    assert started == [2]


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_study_reads_meshes_and_descriptions(
    bucket: Any, server: dict[str, str], tmp_path: Path, jobs: str
) -> None:
    pytest.importorskip("trimesh")
    for name, text in {
        "a.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "b.msaa.yaml": STORED,
    }.items():
        (tmp_path / name).write_text(text)
        bucket.pipe_file(f"frames/{name}", text.encode())
    options = ("--size", "32x32", "--samples", "1,4", "--jobs", jobs, "--output", "json")
    here = run(tmp_path, "study", "a.obj", "b.msaa.yaml", *options)
    there = run(
        tmp_path, "study", "s3://frames/a.obj", "s3://frames/b.msaa.yaml", *options, **server
    )
    assert there.stdout.replace("s3://frames/", "") == here.stdout
    assert (there.returncode, there.stderr) == (here.returncode, here.stderr) == (0, "")


def test_study_says_what_is_wrong_with_a_url(put: Put, tmp_path: Path) -> None:
    put("/frames/a.msaa.yaml", STORED)
    for arguments, message in {
        ("memory://none.obj",): "memory://none.obj: no such file or folder",
        ("memory://none",): "memory://none: no such file or folder `memory://none`",
        (
            "s3://key:secret@bucket/a.obj",
        ): "s3://bucket/a.obj: a URL with credentials is not read because others can see it: ",
        (
            "memory://frames",
            "--record",
        ): "--record needs a description in a file, to write the record next to it",
    }.items():
        done = run(tmp_path, "study", *arguments, "--samples", "1", "--size", "32x32")
        assert done.returncode == 2 and done.stderr.startswith(f"msaa-lint: {message}"), done
        assert done.stderr.count("\n") == 1


def test_pages_of_a_listing(
    bucket: Any, server: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """More entries than a page has, and in a fixed order."""
    names = [f"{number:03}.yaml" for number in range(25)]
    bucket.pipe(
        {f"frames/pages/{name}": b"" for name in reversed(names)} | {"frames/pages/a/x.yaml": b""}
    )
    monkeypatch.setattr(urls, "PAGE", 10)
    assert [entry.name for entry in urls.entries("s3://frames/pages")] == [*names, "a"]


def test_a_named_object(bucket: Any, server: dict[str, str], tmp_path: Path) -> None:
    bucket.pipe_file("frames/named/frame.txt", STORED.encode())
    done = check(tmp_path, "s3://frames/named/frame.txt", **server)
    assert done.stdout.startswith("s3://frames/named/frame.txt:7:") and done.returncode == 1


@pytest.mark.parametrize("command", ["check", "cost", "convert"])
def test_commands_read_captures_from_buckets(
    bucket: Any, server: dict[str, str], tmp_path: Path, command: str
) -> None:
    bucket.pipe_file("frames/c/forward.jsonl", CAPTURE.read_bytes())
    (tmp_path / "c").mkdir()
    (tmp_path / "c/forward.jsonl").write_bytes(CAPTURE.read_bytes())
    arguments = ["--output", "json"] if command != "convert" else []
    here = run(tmp_path, command, *arguments, "c/forward.jsonl")
    there = run(tmp_path, command, *arguments, "s3://frames/c/forward.jsonl", **server)
    assert there.stdout.replace("s3://frames/c/", "c/") == here.stdout
    assert there.returncode == here.returncode and len(here.stdout) > 200


def test_confirm_draws_with_shaders_of_a_bucket(
    bucket: Any, server: dict[str, str], tmp_path: Path
) -> None:
    pytest.importorskip("vulkan")
    bucket.put(f"{ROOT}/examples/lit/", "frames/lit/", recursive=True)
    here, there = (
        run(tmp_path, "confirm", "--size", "64x64", "--output", "json", place, **server)
        for place in (f"{ROOT}/examples/lit/forward.msaa.yaml", "s3://frames/lit/forward.msaa.yaml")
    )
    if not json.loads(here.stdout)["passes"]:
        pytest.skip("no Vulkan device")
    assert there.stdout.replace("s3://frames/lit/", f"{ROOT}/examples/lit/") == here.stdout
    assert "a built-in one is used" not in there.stdout and there.returncode == here.returncode == 0


def test_results_are_kept_by_version(
    bucket: Any, server: dict[str, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An unchanged object is not read again. A changed input and a changed, a removed, and an added
    module are seen.
    """
    (tmp_path / "cache").mkdir()
    folder = "frames/kept"
    names = [f"{number:02}.msaa.yaml" for number in range(5)]
    bucket.pipe({f"{folder}/{name}": (STORED + "# filler\n" * 500).encode() for name in names})
    bucket.pipe_file(f"{folder}/shader.msaa.yaml", (PIPELINE % "a.spv").encode())
    read: list[str] = []
    real = files.open_object

    def counted(url: str, entry: Any = None) -> Any:
        read.append(url.rpartition("/")[2])
        return real(url, entry)

    monkeypatch.setattr(files, "open_object", counted)

    def again() -> tuple[str, list[str]]:
        read.clear()
        done = check(tmp_path, f"s3://{folder}", XDG_CACHE_HOME=str(tmp_path / "cache"), **server)
        fresh = check(tmp_path, "--no-cache", f"s3://{folder}", **server) if read else done
        assert (done.stdout, done.stderr) == (fresh.stdout, fresh.stderr)
        return done.stdout, sorted(
            dict.fromkeys(each for each in read[: len(read)] if each.endswith((".yaml", ".spv")))
        )

    first, _ = again()
    assert "not found" in first and first.count("MSAA201") == 5
    assert again() == (first, [])
    bucket.pipe_file(f"{folder}/{names[3]}", CLEAN.encode())
    assert again()[0].count("MSAA201") == 4
    assert again()[1] == []
    for module in (b"no module", (SHADERS / "no_alpha.frag.spv").read_bytes()):
        bucket.pipe_file(f"{folder}/a.spv", module)
        before, first = first, again()[0]
        assert first != before
        assert again() == (first, [])
    bucket.rm_file(f"{folder}/a.spv")
    assert "not found" in again()[0]


def test_a_storage_without_versions_is_read_again(put: Put, tmp_path: Path) -> None:
    (tmp_path / "cache").mkdir()
    for number in range(30):
        put(f"/kept/{number}.msaa.yaml", STORED + "# filler\n" * 80)
    kept = {"XDG_CACHE_HOME": str(tmp_path / "cache")}
    assert check(tmp_path, "memory://kept", **kept).stdout.count("MSAA201") == 30
    put("/kept/7.msaa.yaml", CLEAN)
    assert check(tmp_path, "memory://kept", **kept).stdout.count("MSAA201") == 29


def test_globs_count_from_the_named_folder(put: Put, tmp_path: Path) -> None:
    for name in ("old/a", "new/old/a", "new/b", "new/skip"):
        put(f"/studio/{name}.msaa.yaml", CLEAN)
    (tmp_path / "msaa-lint.toml").write_text('exclude = ["/old/", "skip.*"]\n')
    put("/studio/msaa-lint.toml", 'exclude = ["new/"]\n')
    put("/studio/.gitignore", "new/\n")
    assert linted(tmp_path, "memory://studio") == [
        "memory://studio/new/b.msaa.yaml",
        "memory://studio/new/old/a.msaa.yaml",
    ]
    (tmp_path / "msaa-lint.toml").write_text('include = ["*.txt"]\n')
    put("/studio/new/c.txt", CLEAN)
    assert linted(tmp_path, "memory://studio") == ["memory://studio/new/c.txt"]


def test_nothing_to_lint(put: Put, tmp_path: Path) -> None:
    put("/empty/ci.yaml", "name: ci\n")
    done = check(tmp_path, "memory://empty")
    assert done.stdout.startswith(
        "memory://empty: error[configuration] nothing to lint in `memory://empty`: inputs are "
        "called *.msaa.yaml"
    )
    assert done.returncode == 2


def test_modules_stay_in_the_named_folder(put: Put, tmp_path: Path) -> None:
    module = (SHADERS / "no_alpha.frag.spv").read_bytes()
    for path in ("/studio/a.spv", "/studio/frames/a.spv", "/secret.spv"):
        put(path, module)
    for name, stated in {
        "up": "../a.spv",
        "out": "../../secret.spv",
        "url": "memory://secret.spv",
        "root": "/secret.spv",
    }.items():
        put(f"/studio/frames/{name}.msaa.yaml", PIPELINE % f'"{stated}"')
    folder = check(tmp_path, "memory://studio").stdout
    assert "frames/up.msaa.yaml:2" in folder and "alpha" in folder
    urls._allowed.clear()
    named = check(tmp_path, "memory://studio/frames/up.msaa.yaml").stdout
    assert "`../a.spv` is outside the project" in named
    for name in ("out", "root"):
        assert f"/{name}.msaa.yaml:2:42: warning[wrong-value]" in folder
    assert folder.count("is outside the project") == 2
    assert "`memory://secret.spv` cannot be read: it is a URL, not a path" in folder


def test_a_device_report_is_read_from_the_named_folder(put: Put, tmp_path: Path) -> None:
    report = {"VK_KHR_report": 1}
    put("/studio/frame.msaa.yaml", "device: phone.json\n" + STORED)
    put("/studio/out.msaa.yaml", "device: ../phone.json\n" + STORED)
    missing = check(tmp_path, "memory://studio").stdout
    assert (
        "no file `phone.json`; built-in devices: " in missing
        and "`../phone.json` is outside the project" in missing
    )
    put("/studio/phone.json", json.dumps(report))
    assert "error[wrong-value] `phone.json`" in check(tmp_path, "memory://studio").stdout


def test_a_local_input_states_no_url(put: Put, tmp_path: Path) -> None:
    put("/a.spv", (SHADERS / "no_alpha.frag.spv").read_bytes())
    (tmp_path / "frame.msaa.yaml").write_text(PIPELINE % '"memory://a.spv"')
    assert (
        "it is a URL, not a path" in check(tmp_path, "frame.msaa.yaml", "memory://nothing").stdout
    )
    assert (
        "it is a URL, not a path"
        in run(
            tmp_path,
            "check",
            "-",
            "--stdin-filename",
            "memory://x/y.yaml",
            stdin=(PIPELINE % "a.spv").encode(),
        ).stdout
    )


def test_fixes_are_shown_and_not_written(put: Put, tmp_path: Path) -> None:
    put("/frames/a.msaa.yaml", STORED)
    done = check(tmp_path, "--fix", "memory://frames")
    assert (
        "memory://frames/a.msaa.yaml is at a URL and is not fixed: `--diff` prints the changes"
        in done.stderr
    )
    assert "MSAA201" in done.stdout and done.returncode == 1
    assert fsspec.filesystem("memory").cat("/frames/a.msaa.yaml") == STORED.encode()
    assert (
        "+      color_ms: {image: color_ms, loadOp: CLEAR, storeOp: DONT_CARE"
        in run(tmp_path, "check", "--diff", "memory://frames").stdout
    )


def test_captures_are_read_by_pieces(
    put: Put, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The most that is asked for at once is a block, and nothing is read twice."""
    monkeypatch.setattr(urls, "BLOCK", 1 << 17)
    put("/c/forward.jsonl", CAPTURE.read_bytes())
    asked: list[tuple[int, int]] = []
    memory = type(fsspec.filesystem("memory"))
    real = memory.cat_file
    monkeypatch.setattr(
        memory,
        "cat_file",
        lambda self, path, start, end: asked.append((start, end)) or real(self, path, start, end),
    )
    assert "MSAA" in check(tmp_path, "memory://c/forward.jsonl").stdout
    assert len(asked) > 1 and max(end - start for start, end in asked) <= 1 << 17
    assert sum(end - start for start, end in asked) == len(CAPTURE.read_bytes())


def test_limits_hold(put: Put, tmp_path: Path) -> None:
    put("/big.msaa.yaml", STORED + "# filler\n" * 100)
    (tmp_path / "msaa-lint.toml").write_text("[limits]\nbytes = 1000\n")
    assert (
        "larger than the limit of 1000 bytes (MSAA906)"
        in check(tmp_path, "memory://big.msaa.yaml").stdout
    )


@pytest.mark.skipif(os.name != "posix", reason="the program is a shell script")
def test_a_program_gets_a_copy(put: Put, tmp_path: Path) -> None:
    put("/game.gfxr", b"GFXR" + bytes(100))
    program = tmp_path / "bin/gfxrecon-convert"
    program.parent.mkdir()
    size = 'test "$(wc -c < "$5")" = 104'
    program.write_text(
        f'#!/bin/sh\ncase "$*" in --help) echo "  --format";; *) {size} && cat \'{CAPTURE}\';; '
        "esac\n"
    )
    program.chmod(0o755)
    (tmp_path / "project").mkdir()
    done = run(
        tmp_path / "project",
        "check",
        "--output",
        "concise",
        "memory://game.gfxr",
        PATH=f"{program.parent}:/usr/bin:/bin",
    )
    assert done.stdout.count("memory://game.gfxr") > 10 and "MSAA9" not in done.stdout


def test_a_file_url_is_the_path(tmp_path: Path) -> None:
    (tmp_path / "a b.msaa.yaml").write_text(STORED)
    (tmp_path / ".git").mkdir()
    (tmp_path / ".gitignore").write_text("*.msaa.yaml\n")
    assert (
        check(tmp_path, (tmp_path / "a b.msaa.yaml").as_uri()).stdout
        == check(tmp_path, "a b.msaa.yaml").stdout
    )
    assert "that .gitignore or .ignore lists" in check(tmp_path, tmp_path.as_uri()).stdout


@pytest.mark.parametrize(
    ("url", "message"),
    [
        ("memory://nothing", "no such file or folder `memory://nothing`"),
        ("nope://frames", "unknown protocol `nope`: fsspec has no file system for it"),
        (
            "memory://me:secret@frames/a.yaml",
            "set them in the environment, and write the URL without them",
        ),
        ("https://host/frame.json?signature=secret", "download the file, and name it"),
        ("file://elsewhere/frame.yaml", "a `file` URL of another machine cannot be read"),
    ],
)
def test_urls_that_cannot_be_read(tmp_path: Path, url: str, message: str) -> None:
    done = run(tmp_path, "check", "--verbose", "--output", "concise", url)
    assert message in done.stdout and "secret" not in done.stdout + done.stderr
    assert done.stdout.count("MSAA921") == 1 and done.returncode == 2


def test_a_missing_package_is_named(
    put: Put, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing(scheme: str) -> None:
        raise ImportError("Install s3fs")

    monkeypatch.setattr(fsspec, "get_filesystem_class", missing)
    assert "reading `s3://` needs the extra `s3`: run `" in check(tmp_path, "s3://frames").stdout
    assert "cannot read the URL: Install s3fs" in check(tmp_path, "memory://frames").stdout
    monkeypatch.setitem(__import__("sys").modules, "fsspec", None)
    assert "reading URLs needs the extra `corpus`: run `" in check(tmp_path, "s3://frames").stdout


def test_errors_of_a_bucket(bucket: Any, server: dict[str, str], tmp_path: Path) -> None:
    def message(url: str, **environment: str) -> str:
        type(bucket).clear_instance_cache()
        done = check(tmp_path, url, **{**server, **environment})
        assert done.stdout.count("\n") == 2 and done.returncode == 2
        return done.stdout

    assert "no such file or folder `s3://nothing`" in message("s3://nothing")
    assert "no such file or folder `s3://frames/a.yaml`" in message("s3://frames/a.yaml")
    nobody = {
        "AWS_ACCESS_KEY_ID": "",
        "AWS_SECRET_ACCESS_KEY": "",
        "AWS_EC2_METADATA_DISABLED": "true",
    }
    assert "no credentials: set those of the storage in the environment" in message(
        "s3://frames/a", HOME=str(tmp_path), **nobody
    )
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    type(bucket).retries, retries = 1, type(bucket).retries
    try:
        assert "the storage cannot be reached: " in message(
            "s3://frames/a", AWS_ENDPOINT_URL=f"http://127.0.0.1:{port}", AWS_MAX_ATTEMPTS="1"
        )
    finally:
        type(bucket).retries = retries
        type(bucket).clear_instance_cache()


def test_errors_while_an_input_is_read(
    put: Put, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One input cannot be read; the others are."""
    put("/frames/a.msaa.yaml", STORED)
    put("/frames/b.msaa.yaml", STORED)
    memory = type(fsspec.filesystem("memory"))
    real = memory.cat_file

    def denied(self: Any, path: str, **range: int) -> bytes:
        if path.endswith("a.msaa.yaml"):
            raise PermissionError("Access Denied\nfor you")
        return bytes(real(self, path, **range))

    monkeypatch.setattr(memory, "cat_file", denied)
    done = check(tmp_path, "memory://frames")
    assert (
        "frames/a.msaa.yaml: error[" in done.stdout
        and "access denied (Access Denied): check the credentials" in done.stdout
    )
    assert "frames/b.msaa.yaml:7" in done.stdout and done.returncode == 2


def test_a_watch_of_a_url_is_refused(tmp_path: Path) -> None:
    done = check(tmp_path, "--watch", "s3://key:secret@frames")
    assert (done.returncode, done.stdout) == (2, "")
    assert "cannot watch s3://frames" in done.stderr and "secret" not in done.stderr
