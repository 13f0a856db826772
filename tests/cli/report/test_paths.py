import os
from pathlib import Path

import pytest

from msaa_lint.cli.report.fingerprint import fingerprint, fingerprints
from msaa_lint.cli.report.paths import display_path, relative, uri
from tests.cli.report.sample import finding


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("/repo/a/b.yaml", "a/b.yaml"),
        ("/repo/./a/../b.yaml", "b.yaml"),
        ("/repository/b.yaml", "/repository/b.yaml"),
        ("/repo", "/repo"),
        ("-", "-"),
        ("<stdin>", "<stdin>"),
    ],
)
def test_relative(file: str, expected: str) -> None:
    assert relative(file, "/repo") == relative(file, "/repo/") == expected


def test_relative_to_nothing_is_as_given_without_the_leading_dot() -> None:
    assert relative("./a/./b.yaml", "") == "a/./b.yaml"
    assert relative(".//a", "") == "a"
    assert relative("../a", "") == "../a"


def test_relative_to_the_working_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "sub").mkdir()
    monkeypatch.chdir(tmp_path / "sub")
    assert relative("a.yaml", str(tmp_path)) == "sub/a.yaml"
    assert relative("../a.yaml", str(tmp_path)) == "a.yaml"


def test_links_are_followed_for_uris_alone(tmp_path: Path) -> None:
    (tmp_path / "real.yaml").touch()
    os.symlink("real.yaml", tmp_path / "link.yaml")
    os.symlink(tmp_path, tmp_path / "again")
    assert relative(str(tmp_path / "link.yaml"), str(tmp_path)) == "link.yaml"
    assert uri(str(tmp_path / "link.yaml"), str(tmp_path)) == "real.yaml"
    assert relative(str(tmp_path / "real.yaml"), str(tmp_path / "again")) == "real.yaml"


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        ("a b/é#?%.yaml", "a%20b/%C3%A9%23%3F%25.yaml"),
        ("c:d.yaml", "c%3Ad.yaml"),
        ("/abs/a b", "file:///abs/a%20b"),
        ("C:/abs/a b", "file:///C:/abs/a%20b"),
        ("bad\udc80name", "bad%80name"),
        ("bad\ud800name", "bad%ED%A0%80name"),
        ("nul\0", "nul%00"),
    ],
)
def test_uri(file: str, expected: str) -> None:
    assert uri(file, "") == expected


@pytest.mark.parametrize("file", ["::error::x", "  ::error::x", "##[error]x"])
def test_no_name_begins_a_line_with_an_order(file: str) -> None:
    assert not display_path(file, "").lstrip().startswith(("::", "##"))
    assert display_path(file, "").endswith("x")


def test_a_name_that_no_file_can_have() -> None:
    assert display_path("a\0\n\u202e", "/repo") == "a\\x00\\n\\u202e"


def test_fingerprint_is_of_rule_file_subject_and_count() -> None:
    one = finding("m", file="/repo/a.yaml", subject="images.a")
    # printf '%s\0%s\0%s\0%s' multisampled-attachment-stored a.yaml images.a 0 | sha256sum
    assert fingerprint(one, 0, "/repo") == "fe02514e04a9a4364e8b6150222c6152"
    assert fingerprint(
        one._replace(file="/other/a.yaml", message="x", code="y", severity="note"), 0, "/other"
    ) == fingerprint(one, 0, "/repo")
    different = [
        fingerprint(one, 1, "/repo"),
        fingerprint(one, 0),
        fingerprint(one._replace(rule="other"), 0, "/repo"),
        fingerprint(one._replace(subject="images.b"), 0, "/repo"),
    ]
    assert len({fingerprint(one, 0, "/repo"), *different}) == 5


def test_fingerprints_count_what_agrees() -> None:
    one, other = finding(subject="a"), finding(subject="b")
    assert list(fingerprints([one, other, one])) == [
        fingerprint(one, 0),
        fingerprint(other, 0),
        fingerprint(one, 1),
    ]


def test_fingerprint_of_a_lone_surrogate() -> None:
    assert len(fingerprint(finding(file="\udc80", subject="\ud800"), 0)) == 32


def test_a_name_that_ends_in_a_colon_begins_no_order_with_the_colon_after_it() -> None:
    assert display_path(":", "") == "./:"
