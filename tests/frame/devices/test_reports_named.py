"""Which device a name means: paths of reports, picks, and what a description from a stranger may
not name.
"""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame import profiles
from msaa_lint.frame.description.models import Description
from msaa_lint.frame.devices import DeviceProfile, builtin, names
from msaa_lint.frame.devices.mapping import description as mapping
from msaa_lint.frame.devices.msaa_features import EXTENSIONS
from msaa_lint.frame.devices.offer import Offer, builtin_offer
from msaa_lint.frame.devices.paths import is_path, split
from msaa_lint.frame.devices.reports import MAX_BYTES, read
from msaa_lint.frame.facts.global_facts import global_facts
from msaa_lint.frame.facts.words import WORDS
from msaa_lint.frame.profiles import Problem, device_for, device_of, profile_of
from msaa_lint.input.readers import read as read_document
from tests.frame.devices import reported


def description(text: str) -> Description:
    source = Source("a.msaa.yaml", text)
    document = read_document(source, parse(source, Limits()).documents[0])
    assert document.problems == ()
    return document.description


def named(
    folder: Path, device: str, default: DeviceProfile | None = None
) -> DeviceProfile | Problem | None:
    """The device that a description in a folder means by a name."""
    text = json.dumps({"device": device, "images": {}})
    return device_for(description(text), str(folder / "a.msaa.yaml"), default)


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = tmp_path / "project"
    (folder / "frames").mkdir(parents=True)
    (folder / ".git").mkdir()
    (folder / "phone.json").write_text(reported.DIALECTS["gpuinfo"])
    (folder / "frames" / "two.txt").write_text(reported.text("Own A", "Own B"))
    (tmp_path / "outside.json").write_text(reported.DIALECTS["devsim"])
    return folder


def test_paths_and_picks() -> None:
    assert split("phone.json") == ("phone.json", "")
    assert split("phone.json#2") == ("phone.json", "2")
    assert split("a/phone#Mali-G715") == ("a/phone", "Mali-G715")
    assert split("a#b/phone.json") == ("a#b/phone.json", "")
    assert split("a#b.json") == ("a#b.json", "")
    assert [is_path(name) for name in ("phone.json", "phone.txt#2", "a/b", "a\\b")] == [True] * 4
    assert not any(is_path(name) for name in (*names(), *WORDS["vendor"], "", "#", "mali#2"))


def test_a_report_counts_from_the_descriptions_folder(project: Path) -> None:
    found = named(project / "frames", "../phone.json")
    assert isinstance(found, DeviceProfile)
    assert (found.name, found.color_samples) == ("Mali-G999 MC3", (1, 4, 8))
    assert found.source.startswith("../phone.json: ")


def test_a_device_is_picked(project: Path) -> None:
    found = named(project / "frames", "two.txt#2")
    assert isinstance(found, DeviceProfile)
    assert found.name == "Own B"
    found = named(project / "frames", "two.txt#own a")
    assert isinstance(found, DeviceProfile)
    assert found.name == "Own A"
    assert named(project / "frames", "two.txt") == Problem(
        "MSAA903",
        "`two.txt` has 2 devices: say which",
        "`two.txt#1` is Own A, `two.txt#2` is Own B",
    )
    assert named(project / "frames", "two.txt#Own C") == Problem(
        "MSAA904", "no device `Own C` in `two.txt`", "`two.txt#1` is Own A, `two.txt#2` is Own B"
    )


def test_other_devices_of_a_description(project: Path) -> None:
    other = builtin("nvidia")
    assert named(project, "mali-g76") == builtin("mali-g76")
    assert device_for(description("images: {}"), "<stdin>", other) is other
    assert device_for(description("images: {}"), "<stdin>", None) is None
    found = device_for(description("device: {vendor: arm}\nimages: {}"), "<stdin>", other)
    assert isinstance(found, DeviceProfile)
    assert (found.vendor, found.color_samples) == ("arm", None)


def test_a_file_that_is_missing(project: Path) -> None:
    assert named(project, "phome.json") == Problem(
        "MSAA904", "no file `phome.json`", "did you mean `phone.json`?"
    )
    assert named(project / "frames", "../phome.json") == Problem(
        "MSAA904", "no file `../phome.json`", "did you mean `../phone.json`?"
    )
    found = named(project, "nowhere/phone.json")
    assert found == Problem(
        "MSAA904", "no file `nowhere/phone.json`", "the folder `nowhere` is not there"
    )


def test_what_leaves_the_project_is_not_looked_at(project: Path) -> None:
    help = "only --profile on the command line can name such a file"
    for name in (
        "../outside.json",
        "../nothing.json",
        str(project.parent / "outside.json"),
        "/etc/hostname.txt",
    ):
        assert named(project, name) == Problem("MSAA903", f"`{name}` is outside the project", help)
    (project / "link.json").symlink_to(project.parent / "outside.json")
    assert named(project, "link.json") == Problem(
        "MSAA903", "`link.json` is outside the project", help
    )
    (project / "folder").symlink_to(project.parent)
    assert named(project, "folder/outside.json") == Problem(
        "MSAA903", "`folder/outside.json` is outside the project", help
    )
    (project / "inner.json").symlink_to("phone.json")
    assert isinstance(named(project, "inner.json"), DeviceProfile)
    assert isinstance(profile_of(str(project / "link.json")), DeviceProfile), (
        "who types the command line may"
    )


def test_what_is_no_file_is_not_read(project: Path) -> None:
    os.mkfifo(project / "pipe.json")
    (project / "a.json").mkdir()
    (project / "large.json").write_bytes(b" " * (MAX_BYTES + 1))
    (project / "bytes.json").write_bytes(b'{"a": "\xff"}')
    (project / "words.txt").write_text("hello")
    assert named(project, "pipe.json") == Problem(
        "MSAA903", "`pipe.json` cannot be read: it is a pipe, not a regular file"
    )
    assert named(project, "a.json") == Problem(
        "MSAA903", "`a.json` cannot be read: it is a folder, not a regular file"
    )
    assert named(project, "large.json") == Problem(
        "MSAA903", "`large.json` cannot be read: it is larger than 8 MiB"
    )
    for name, reason in (("bytes.json", "not UTF-8: byte 7"), ("words.txt", "not a device report")):
        found = named(project, name)
        assert isinstance(found, Problem)
        assert found.code == "MSAA903"
        assert reason in found.message
        assert found.help.startswith("expected vulkaninfo")
    assert isinstance(named(project, "\0.json"), Problem)


def test_a_report_in_utf_16_is_read(project: Path) -> None:
    """As PowerShell's `>` writes it."""
    (project / "windows.txt").write_bytes(
        b"\xff\xfe" + reported.text().replace("\n", "\r\n").encode("utf-16-le")
    )
    found, plain = named(project, "windows.txt"), read(reported.text())[0].profile
    assert isinstance(found, DeviceProfile)
    assert found._replace(source="") == plain._replace(source="")


def test_a_report_is_read_again_once_it_changed(project: Path) -> None:
    path = str(project / "phone.json")
    first = profile_of(path)
    assert profile_of(path) is first
    (project / "phone.json").write_text(reported.DIALECTS["gpuinfo"].replace("MC3", "MC12"))
    second = profile_of(path)
    assert isinstance(second, DeviceProfile)
    assert second.name == "Mali-G999 MC12"


def test_names_of_the_command_line(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(project)
    found = device_of("phone.json")
    assert found is not None
    assert found.vendor == "arm"
    assert device_of("arm") == DeviceProfile(
        "arm", vendor="arm", minimum=True, source="only the vendor is known"
    )
    assert device_of("mali-g67") is None
    assert device_of(None) is None
    assert profile_of("mali-g67") == Problem(
        "MSAA904", "no profile `mali-g67`", "did you mean `mali-g76`?"
    )
    assert profiles.known_profiles() == (*names(), *WORDS["vendor"])


def facts_of(text: str, folder: Path) -> dict[str, object]:
    """What rules may ask of the device that a description states."""
    stated = description(text + "images: {}\n")
    device = device_for(stated, str(folder / "a.msaa.yaml"), None)
    assert isinstance(device, DeviceProfile)
    return global_facts(stated, device).values | {
        "profile": device._replace(source="", name="", features=None, extensions=None)
    }


@pytest.mark.parametrize("name", names())
def test_a_built_in_device_written_out_lints_the_same(name: str, tmp_path: Path) -> None:
    offer = builtin_offer(name)
    assert offer is not None
    text = mapping(offer)
    written, by_name = facts_of(text, tmp_path), facts_of(f"device: {name}\n", tmp_path)
    assert ("\n  name: " in text) != offer.profile.minimum
    assert written == by_name


@pytest.mark.parametrize("dialect", sorted(reported.DIALECTS))
def test_a_report_written_out_lints_the_same(dialect: str, tmp_path: Path) -> None:
    (tmp_path / "own.json").write_text(reported.DIALECTS[dialect])
    (report,) = read(reported.DIALECTS[dialect])
    assert facts_of(mapping(Offer(report, "own.json")), tmp_path) == facts_of(
        "device: own.json\n", tmp_path
    )


def test_a_class_of_devices_is_written_as_its_path(tmp_path: Path) -> None:
    (tmp_path / "own.json").write_text(json.dumps(reported.profiles()))
    (first, _) = read(json.dumps(reported.profiles()))
    text = mapping(Offer(first, "own.json#1"))
    assert text.splitlines()[1:] == ['device: "own.json#1"']
    assert facts_of(text, tmp_path)["device.minimum"] is True
    assert (
        mapping(Offer(first)).splitlines()[1]
        == "# Name a class of devices by the path of its report."
    )


def test_a_hostile_name_is_written_so_that_it_reads_back() -> None:
    name = 'x"\\\x1b[31m\u202e: {}]\n# y'
    (report,) = read(reported.DIALECTS["gpuinfo"])
    text = mapping(Offer(report._replace(profile=report.profile._replace(name=name))))
    assert "\x1b" not in text
    assert "\u202e" not in text
    stated = description(text + "images: {}\n").device
    assert not isinstance(stated, str)
    assert stated is not None
    assert stated.name == name


def test_what_rules_ask_is_written_out() -> None:
    from msaa_lint.frame.devices.builtin_profiles import RECORDED
    from msaa_lint.frame.facts.global_facts import MIXED_SAMPLES

    assert MIXED_SAMPLES | set(RECORDED) <= set(EXTENSIONS)
