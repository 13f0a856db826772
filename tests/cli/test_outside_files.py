"""Nothing outside the project is read because a file, a folder, or a link in it says so; what the
command line names is read as named.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.command import Done, environment_of, run, run_process

pytestmark = pytest.mark.skipif(os.name != "posix", reason="links and pipes are tried")

SECRET = "hunter2"
FRAME = "images: {color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT]}}\n"
PAGE = (
    "---\ncode: OWN1\nseverity: error\nsubject: image\nwhen: image.samples > 1\nmessage: "
    f'"{SECRET}"\n---\nThe page, {SECRET}.\n'
)
BASELINE = '{"schema": "msaa-lint/baseline-v1", "entries": {}}\n'
HUGE = 1 << 40

RULES = 'rules = ["rules"]\n'
OUTSIDE = "it is outside the project"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A repository with a frame and a folder of rules, beside a folder that it must not read."""
    outside, project = tmp_path / "outside", tmp_path / "project"
    outside.mkdir()
    for name, text in (
        ("page.md", PAGE),
        ("base.toml", f"{SECRET} = ["),
        ("base.json", f'{{"{SECRET}": '),
        ("frame.msaa.yaml", FRAME.replace("color:", f"{SECRET}:")),
    ):
        (outside / name).write_text(text)
    (project / ".git").mkdir(parents=True)
    (project / "rules").mkdir()
    (project / "frame.msaa.yaml").write_text(FRAME)
    return project


def link(path: Path, target: str) -> None:
    path.unlink(missing_ok=True)
    path.symlink_to(target)


def sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(HUGE)


def checked(project: Path, *arguments: str, command: Callable[..., Done] = run) -> Done:
    """`check`, in all formats; none shows the secret, and the frame is checked in any case.
    `run_process` ends what waits for a pipe.
    """
    formats = [
        option
        for format in ("json", "sarif", "markdown", "gitlab")
        for option in ("--output", f"{format}=../{format}.out")
    ]
    done = command(
        project,
        "check",
        "--output",
        "concise",
        *formats,
        *arguments,
        "frame.msaa.yaml",
        TOKEN=SECRET,
    )
    texts = [done.stdout, done.stderr, *(file.read_text() for file in project.parent.glob("*.out"))]
    assert len(texts) == 6
    assert not [text for text in texts if SECRET in text]
    assert (
        json.loads((project.parent / "json.out").read_text())["summary"]["checked"]["images"] == 1
    )
    return done


def only(done: Done) -> str:
    """The only error, on its only line."""
    errors = [line for line in done.stdout.splitlines() if "error[" in line]
    assert (done.returncode, len(errors)) == (2, 1), done.stdout + done.stderr
    return errors[0]


# --- rules
# ----------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("named", ["configuration", "command line"])
@pytest.mark.parametrize(
    "target",
    [
        "../../outside/page.md",
        "../../outside/nothing.md",
        "/proc/self/environ",
        "/proc/self/root/etc/passwd",
        "/etc/shadow",
        "inner.md",
    ],
)
def test_a_rule_page_that_links_elsewhere(project: Path, target: str, named: str) -> None:
    """It is found in a folder, even if the command line names the folder. Whether its target exists
    makes no difference.
    """
    link(project / "rules/own.md", target)
    link(project / "rules/inner.md", "../../outside/page.md")
    if named == "configuration":
        (project / "msaa-lint.toml").write_text(RULES)
    command = run_process if target.endswith("environ") else run
    done = checked(
        project, *(["--rules", "rules"] if named == "command line" else []), command=command
    )
    errors = [line for line in done.stdout.splitlines() if "error[" in line]
    problem = (
        f"error[configuration] cannot read the rule page: {OUTSIDE}; only `--rules` can name "
        "such a page (MSAA921)"
    )
    assert (done.returncode, errors) == (
        2,
        [f"rules/{name}.md: {problem}" for name in ("inner", "own")],
    )


def test_no_command_shows_a_page_that_links_elsewhere(project: Path) -> None:
    (project / "msaa-lint.toml").write_text(RULES)
    link(project / "rules/own.md", "../../outside/page.md")
    for command in (
        "rule --all",
        "rule own",
        "rule OWN1",
        "cost frame.msaa.yaml",
        "baseline frame.msaa.yaml",
        "rule --all --output json",
    ):
        done = run(project, *command.split())
        assert done.returncode == 2, command
        assert SECRET not in done.stdout + done.stderr, command


def test_a_page_that_the_command_line_names_may_be_anywhere(project: Path) -> None:
    link(project / "rules/own.md", "../../outside/page.md")
    for page in ("rules/own.md", "../outside/page.md"):
        done = run(project, "check", "--rules", page, "--select", "OWN1", "frame.msaa.yaml")
        assert (done.returncode, SECRET in done.stdout) == (1, True), page


def test_a_page_may_link_to_a_page_of_the_project(project: Path) -> None:
    (project / "shared").mkdir()
    (project / "shared/page.md").write_text(PAGE)
    link(project / "rules/own.md", "../shared/page.md")
    link(project / "more", "rules")
    for configuration in (
        RULES,
        'rules = ["more"]\n',
        'rules = ["more/own.md"]\n',
        'rules = ["./rules//own.md"]\n',
    ):
        (project / "msaa-lint.toml").write_text(configuration)
        done = run(project, "check", "--select", "OWN1", "frame.msaa.yaml")
        assert (done.returncode, SECRET in done.stdout) == (1, True), configuration


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (os.mkfifo, "it is a pipe, not a regular file"),
        (Path.mkdir, "it is a folder, not a regular file"),
        (sparse, "it is larger than the limit of 1048576 bytes"),
        (lambda path: link(path, "own.md"), "Too many levels of symbolic links"),
        (lambda path: link(path, "/dev/zero"), f"{OUTSIDE}; only `--rules` can name such a page"),
    ],
)
def test_a_rule_page_that_is_no_file(
    project: Path, make: Callable[[Path], None], reason: str
) -> None:
    make(project / "rules/own.md")
    (project / "msaa-lint.toml").write_text(RULES)
    done = checked(project, command=run_process if make is os.mkfifo else run)
    assert (
        only(done)
        == f"rules/own.md: error[configuration] cannot read the rule page: {reason} (MSAA921)"
    )


# --- what a configuration names
# -------------------------------------------------------------------------------------------------

ONLY = "only the command line can name such a file (MSAA921)"


@pytest.mark.parametrize(
    ("key", "name", "reason"),
    [
        (key, name, f"is outside the project in `{key}` of msaa-lint.toml: {ONLY}")
        for key, names in (
            (
                "rules",
                (
                    "../outside/page.md",
                    "up/page.md",
                    "up",
                    "../nothing.md",
                    "/proc/self/root/etc/passwd",
                    "rules/../../x.md",
                ),
            ),
            (
                "extends",
                (
                    "../outside/base.toml",
                    "link.toml",
                    "up/base.toml",
                    "../nothing.toml",
                    "/proc/self/cwd/../x.toml",
                ),
            ),
            ("baseline", ("../outside/base.json", "link.json", "up/base.json", "../nothing.json")),
            (
                "profile",
                ("../outside/base.json", "link.json", "up/base.json#2", "../nothing.json", "up/"),
            ),
        )
        for name in names
    ]
    + [
        (
            "rules",
            "file:///etc/passwd",
            "cannot be read: it is a URL, not a path in `rules` of msaa-lint.toml",
        )
    ]
    + [
        (
            "baseline",
            "https://127.0.0.1/b.json",
            "cannot be read: it is a URL, not a path in `baseline` of msaa-lint.toml",
        )
    ]
    + [
        ("rules", "~/page.md", "no such file or folder"),
        ("rules", "$HOME/page.md", "no such file or folder"),
    ],
)
def test_a_configuration_names_what_is_elsewhere(
    project: Path, key: str, name: str, reason: str
) -> None:
    link(project / "up", "../outside")
    for ending in ("toml", "json"):
        link(project / f"link.{ending}", f"../outside/base.{ending}")
    (project / "msaa-lint.toml").write_text(
        f"\n{key} = " + (f'["{name}"]' if key == "rules" else f'"{name}"')
    )
    column = len(key) + 4 + (key == "rules")
    error = only(checked(project))
    assert error.startswith(f"msaa-lint.toml:2:{column}: error[configuration] ")
    assert reason in error
    assert f"`{name.partition('#')[0]}`" in error


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (os.mkfifo, "it is a pipe, not a regular file"),
        (Path.mkdir, "it is a folder, not a regular file"),
        (sparse, "it is larger than "),
    ],
)
@pytest.mark.parametrize(
    ("key", "file"), [("extends", "x.toml"), ("baseline", "x.json"), ("profile", "x.json")]
)
def test_a_configuration_names_what_is_no_file(
    project: Path, key: str, file: str, make: Callable[[Path], None], reason: str
) -> None:
    make(project / file)
    (project / "msaa-lint.toml").write_text(f'{key} = "{file}"\n')
    assert reason in only(checked(project, command=run_process if make is os.mkfifo else run))


@pytest.mark.parametrize("file", ["msaa-lint.toml", "pyproject.toml"])
@pytest.mark.parametrize(
    "target", ["../outside/base.toml", "../outside/nothing.toml", "/dev/zero", "/proc/self/environ"]
)
def test_a_configuration_that_links_elsewhere(project: Path, file: str, target: str) -> None:
    link(project / file, target)
    problem = f"cannot read the configuration: {OUTSIDE}; pass it with --config to use it"
    assert (
        only(checked(project, command=run_process if target.endswith("environ") else run))
        == f"{file}: error[configuration] {problem} (MSAA921)"
    )


def test_a_configuration_that_is_a_pipe_is_not_waited_for(project: Path) -> None:
    os.mkfifo(project / "msaa-lint.toml")
    assert "cannot read the configuration: it is a pipe, not a regular file" in only(
        checked(project, command=run_process)
    )


def test_what_a_named_configuration_names_is_in_its_own_project(project: Path) -> None:
    """A configuration outside of the linted project can name what is beside it, and nothing of the
    linted project.
    """
    outside = project.parent / "outside"
    (outside / "msaa.toml").write_text(
        'extends = "more.toml"\nrules = ["page.md", "../project/rules"]\n'
    )
    (outside / "more.toml").write_text('select = ["OWN1"]\n')
    done = run(
        project,
        "check",
        "--output",
        "concise",
        "--config",
        "../outside/msaa.toml",
        "frame.msaa.yaml",
    )
    assert done.returncode == 2
    assert "`../project/rules` is outside the project in `rules` of" in done.stdout
    assert "frame.msaa.yaml:1:51: error[page] hunter2 (OWN1)" in done.stdout


# --- the baseline
# ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (
            lambda path: link(path, "../outside/base.json"),
            f"{OUTSIDE}; only the command line can name such a file",
        ),
        (os.mkfifo, "it is a pipe, not a regular file"),
    ],
)
def test_prune_reads_no_baseline_elsewhere(
    project: Path, make: Callable[[Path], None], reason: str
) -> None:
    make(project / "msaa-lint-baseline.json")
    done = run_process(project, "baseline", "--prune", "frame.msaa.yaml")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(
        f"msaa-lint: msaa-lint-baseline.json: cannot read the baseline: {reason}"
    )


def test_a_baseline_does_not_tell_what_exists_elsewhere(project: Path) -> None:
    link(project / "up", "../outside")
    said = []
    for name in ("page.md", "nothing.md"):
        for folder in ("../outside", "up", str(project.parent / "outside"), "/proc/self/root/etc"):
            entries = {f"{folder}/{name}": {"resolve-outside-pass": 3}}
            (project / "b.json").write_text(
                json.dumps({"schema": "msaa-lint/baseline-v1", "entries": entries})
            )
            done = run(project, "check", "--baseline", "b.json", "frame.msaa.yaml")
            said.append((done.returncode, done.stdout, done.stderr))
    assert len(set(said)) == 1, "the entry is never called stale"
    (project / "b.json").write_text(
        json.dumps(
            {
                "schema": "msaa-lint/baseline-v1",
                "entries": {"gone.yaml": {"resolve-outside-pass": 3}},
            }
        )
    )
    done = run(project, "check", "--baseline", "b.json", "frame.msaa.yaml")
    assert "the baseline counts 3 of resolve-outside-pass in gone.yaml" in done.stderr


# --- what inputs name
# -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        "../outside/base.json",
        "up/base.json",
        "link.json",
        "../nothing.json",
        "/proc/self/environ.txt",
    ],
)
def test_the_device_of_a_description_elsewhere(project: Path, name: str) -> None:
    link(project / "up", "../outside")
    link(project / "link.json", "../outside/base.json")
    (project / "frame.msaa.yaml").write_text(f"{FRAME}device: {name}\n")
    done = run(project, "check", "frame.msaa.yaml")
    problem = (
        f"`{name}` is outside the project; only --profile on the command line can name such a file"
    )
    assert done.stdout.startswith(f"frame.msaa.yaml:2:9: error[wrong-value] {problem}")
    assert (done.returncode, SECRET in done.stdout) == (2, False)


SHADED = """\
pipelines:
  own:
    rendering: {{colorAttachmentFormats: [R8G8B8A8_UNORM]}}
    multisampleState: {{rasterizationSamples: 4, alphaToCoverageEnable: true}}
    stages: [{{stage: FRAGMENT, module: {}}}]
"""


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("../outside/page.md", "is outside the project"),
        ("../outside/nothing.spv", "is outside the project"),
        ("up/page.md", "is outside the project"),
        ("link.spv", "is outside the project"),
        ("/proc/self/environ", "is outside the project"),
        ("/dev/zero", "is outside the project"),
        ("file:///etc/passwd", "cannot be read: it is a URL, not a path"),
        ("pipe.spv", "cannot be read: it is a pipe, not a regular file"),
        ("huge.spv", "cannot be read: it is larger than 16 MiB"),
        ("rules", "cannot be read: it is a folder, not a regular file"),
    ],
)
def test_the_shader_of_a_description_elsewhere(project: Path, name: str, reason: str) -> None:
    link(project / "up", "../outside")
    link(project / "link.spv", "../outside/page.md")
    os.mkfifo(project / "pipe.spv")
    sparse(project / "huge.spv")
    (project / "frame.msaa.yaml").write_text(SHADED.format(name))
    done = run(project, "check", "--output", "concise", "frame.msaa.yaml")
    assert f"`{name}` {reason}" in done.stdout
    assert SECRET not in done.stdout


def test_paths_in_a_pipe_count_from_the_current_folder(project: Path) -> None:
    """Not from `/dev/fd`, in which other files may be."""
    for name, reason in (
        ("shm/x.json", "no file `shm/x.json`"),
        ("../outside/base.json", "is outside the project"),
    ):
        done = run_process(
            project, "check", "/dev/stdin", stdin=f"{FRAME}device: {name}\n".encode()
        )
        assert (done.returncode, reason in done.stdout) == (2, True), done.stdout


def test_a_record_elsewhere(project: Path) -> None:
    (project / "frame.msaa.yaml").write_text(FRAME.replace("samples: 4", "samples: 8"))
    link(project / "frame.msaa.yaml.msaa-study.json", "../outside/base.json")
    done = run(project, "check", "--select", "MSAA101", "--output", "full", "frame.msaa.yaml")
    assert f"frame.msaa.yaml.msaa-study.json cannot be read: {OUTSIDE}" in done.stdout
    assert SECRET not in done.stdout


def test_the_zip_beside_a_capture_elsewhere(project: Path) -> None:
    from tests.input.readers.test_renderdoc import CODE, PROGRAM, code_of, written

    capture = written(PROGRAM)
    (project.parent / "outside/a.zip").write_bytes(capture.zip())
    (project / "inside.zip").write_bytes(capture.zip())
    assert zipfile.is_zipfile(project / "inside.zip")
    for target, code in (("inside.zip", CODE), ("../outside/a.zip", None)):
        link(project / "a.zip", target)
        assert code_of(capture.text(), project / "a.xml") == code, target


def test_a_mesh_names_no_texture(project: Path) -> None:
    """A PLY file can name a picture as its texture: trimesh would read it."""
    pytest.importorskip("trimesh")
    os.mkfifo(project / "pipe.png")
    head = (
        "ply\nformat ascii 1.0\ncomment TextureFile pipe.png\nelement vertex 3\nproperty float "
        "x\nproperty float y\nproperty float z\n"
    )
    head += (
        "property float s\nproperty float t\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n"
    )
    (project / "mesh.ply").write_text(head + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n")
    done = run_process(
        project,
        "study",
        "mesh.ply",
        "--size",
        "32x32",
        "--samples",
        "1",
        "--techniques",
        "msaa",
        "--jobs",
        "1",
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("what", ["chain", "long"])
def test_paths_that_no_file_can_have(project: Path, what: str) -> None:
    """A chain of more links than the system follows, and a path of 50,000 folders."""
    for number in range(200):
        link(project / f"l{number}", f"l{number + 1}")
    name = "l0" if what == "chain" else "a/" * 50_000 + "x"
    reason = "Too many levels of symbolic links" if what == "chain" else "File name too long"
    for ending in ("toml", "json", "md", "msaa.yaml"):
        link(project / f"chain.{ending}", "l0")
    for key, ending in (
        ("extends", "toml"),
        ("baseline", "json"),
        ("profile", "json"),
        ("rules", "md"),
    ):
        value = f"chain.{ending}" if what == "chain" else f"{name}.{ending}"
        (project / "msaa-lint.toml").write_text(
            f"{key} = " + (f'["{value}"]' if key == "rules" else f'"{value}"')
        )
        assert reason in only(checked(project)), key
    (project / "msaa-lint.toml").unlink()
    device = "chain.json" if what == "chain" else f"{name}.json"
    (project / "frame.msaa.yaml").write_text(f"{FRAME}device: {device}\n")
    assert f"cannot be read: {reason}" in run(project, "check", "frame.msaa.yaml").stdout
    (project / "frame.msaa.yaml").write_text(SHADED.format(device))
    assert f"cannot be read: {reason}" in run(project, "check", "frame.msaa.yaml").stdout
    if what == "chain":
        (project / "frame.msaa.yaml").write_text(FRAME)
        done = run(
            project,
            "check",
            "--output",
            "concise",
            "--output",
            "json=chain.json",
            ".",
            "--rules",
            ".",
        )
        assert (
            "chain.md: error[configuration] cannot read the rule page: Too many levels of symbolic "
            "links (MSAA921)" in done.stdout
        )
        assert "chain.msaa.yaml is a link that is broken or leaves the project" in done.stderr
        assert json.loads((project / "chain.json").read_text())["summary"]["files"] == 2


# --- discovery
# ------------------------------------------------------------------------------------------------------------------


def inputs(done: Done) -> list[str]:
    """The inputs of JSON output."""
    return [str(entry["file"]) for entry in json.loads(done.stdout)["inputs"]]


def test_a_folder_has_no_inputs_elsewhere(project: Path) -> None:
    link(project / "up", "../outside")
    link(project / "link.msaa.yaml", "../outside/frame.msaa.yaml")
    link(project / "gone.msaa.yaml", "../outside/nothing.msaa.yaml")
    link(project / "inner.msaa.yaml", "frame.msaa.yaml")
    os.mkfifo(project / "pipe.msaa.yaml")
    os.mkfifo(project / "pipe.json")
    done = run_process(project, "check", "--output", "json", ".")
    assert inputs(done) == ["frame.msaa.yaml", "inner.msaa.yaml"]
    assert SECRET not in done.stdout + done.stderr
    for name in ("gone", "link"):
        assert (
            f"{name}.msaa.yaml is a link that is broken or leaves the project: name it to lint it"
            in done.stderr
        )
    assert "pipe.msaa.yaml is not a regular file: not linted" in done.stderr
    named = run(project, "check", "up/frame.msaa.yaml", "link.msaa.yaml")
    for name in ("up/frame", "link"):
        assert (
            f"{name}.msaa.yaml:1:63: warning[multisampled-image-not-transient] `{SECRET}`"
            in named.stdout
        ), "the command line names it"


def test_a_link_that_changes_after_the_search_is_not_followed(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from msaa_lint.linter.request import Request
    from msaa_lint.linter.run import run as lint
    from msaa_lint.linter.workspace import Workspace

    (project / "other.msaa.yaml").write_text(FRAME)
    discover = Workspace.discover

    def and_link(workspace: Workspace, sources: bool = False) -> object:
        found = discover(workspace, sources)
        link(project / "other.msaa.yaml", "../outside/frame.msaa.yaml")
        return found

    monkeypatch.setattr(Workspace, "discover", and_link)
    findings = lint(Request([str(project)], isolated=True)).result.findings
    assert [found.message for found in findings if found.fatal] == [
        f"cannot read the input: {OUTSIDE}"
    ]


def test_an_ignore_file_elsewhere_ignores_nothing(project: Path) -> None:
    """Nor does a file called `.jj` name another folder's, as the file `.git` of a worktree does,
    which nobody can commit.
    """
    (project / "a").mkdir()
    (project / "a/b.msaa.yaml").write_text(FRAME)
    (project.parent / "outside/info").mkdir()
    (project.parent / "outside/info/exclude").write_text("*.yaml\n")
    (project / "a/.jj").write_text("gitdir: ../../outside\n")
    link(project / ".gitignore", "../outside/info/exclude")
    link(project / ".ignore", "../outside/info/exclude")
    done = run(project, "check", "--output", "json", ".")
    assert inputs(done) == ["a/b.msaa.yaml", "frame.msaa.yaml"]
    (project / "a/.jj").unlink()
    (project / "a/.jj").mkdir()
    link(project / "a/.jj/info", "../../../outside/info")
    assert inputs(run(project, "check", "--output", "json", ".")) == [
        "a/b.msaa.yaml",
        "frame.msaa.yaml",
    ]


# --- what the command line names
# ------------------------------------------------------------------------------------------------


def through_pipe(project: Path, text: str, *arguments: str) -> Done:
    """The command with `{}` in its arguments replaced by a pipe, as a shell does for
    `<(command)`.
    """
    reader, writer = os.pipe()
    os.write(writer, text.encode())
    os.close(writer)
    words = [word.replace("{}", f"/dev/fd/{reader}") for word in arguments]
    command = [sys.executable, "-m", "msaa_lint", *words]
    done = subprocess.run(
        command,
        cwd=project,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        env=environment_of({}),
        pass_fds=[reader],
        timeout=60,
    )
    os.close(reader)
    return done


@pytest.mark.parametrize(
    ("text", "arguments", "code", "shown"),
    [
        (FRAME, "check {}", 1, "1 description"),
        (
            FRAME,
            "check --fix {}",
            1,
            "is not a regular file and is not fixed: name `-` to print the fixed text",
        ),
        (FRAME, "cost {}", 0, ""),
        (FRAME, "facts {}", 0, "image.samples"),
        (
            'exclude = ["frame.*"]\n',
            "check --config {} frame.msaa.yaml",
            0,
            "frame.msaa.yaml is excluded by `frame.*`",
        ),
        (BASELINE, "check --baseline {} frame.msaa.yaml", 1, "1 description"),
        (PAGE, "check --rules {} --select OWN1 frame.msaa.yaml", 1, SECRET),
        ("", "check {}", 2, "cannot read the input: it is a pipe that nothing writes to"),
        (
            "",
            "check --config {} frame.msaa.yaml",
            2,
            "cannot read the configuration: it is a pipe that nothing writes to",
        ),
    ],
)
def test_a_pipe_that_the_command_line_names_is_read(
    project: Path, text: str, arguments: str, code: int, shown: str
) -> None:
    done = through_pipe(project, text, *arguments.split())
    assert (done.returncode, shown in done.stdout + done.stderr) == (code, True), (
        done.stdout + done.stderr
    )


def test_a_report_from_a_pipe_is_a_profile(project: Path) -> None:
    report = run(project, "device", "mali-g76", "--output", "json").stdout
    assert json.loads(report)["devices"]
    text = "GPU id = 0 (a phone)\n"
    done = through_pipe(project, text, "check", "--profile", "{}", "frame.msaa.yaml")
    assert "not a device report" in done.stdout, done.stdout
    assert "regular file" not in done.stdout


@pytest.mark.parametrize("option", [[], ["--config"], ["--baseline"], ["--rules"], ["--profile"]])
def test_a_pipe_without_a_writer_is_not_waited_for(project: Path, option: list[str]) -> None:
    os.mkfifo(project / "pipe")
    done = run_process(
        project,
        "check",
        *option,
        *(["./pipe"] if option else ["pipe"]),
        *(["frame.msaa.yaml"] if option else []),
    )
    assert done.returncode == 2
    assert "it is a pipe that nothing writes to" in done.stdout


@pytest.mark.parametrize("option", [[], ["--config"], ["--baseline"], ["--rules"], ["--profile"]])
def test_what_never_ends_is_read_up_to_the_limit(project: Path, option: list[str]) -> None:
    done = run(project, "check", *option, "/dev/zero", *(["frame.msaa.yaml"] if option else []))
    assert done.returncode == 2
    assert "larger than" in done.stdout


def test_a_huge_input_is_refused_by_its_size(project: Path) -> None:
    sparse(project / "huge.msaa.yaml")
    done = run(project, "check", ".")
    assert done.returncode == 2
    assert (
        "huge.msaa.yaml: error[limit-exceeded] cannot read the input: the input is larger than the "
        "limit of 67108864 bytes" in done.stdout
    )
