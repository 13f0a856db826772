"""Compressed captures, through the command: they are read like what they hold, as far as they
go.
"""

from __future__ import annotations

import gzip
import json
import lzma
from pathlib import Path
from typing import Any

import pytest

from msaa_lint.input import compression
from msaa_lint.input.capture_stream import CaptureStream, pieces_of
from tests.command import Done, run, run_process
from tests.input.compressed import COMPRESS
from tests.paths import ROOT

FORWARD = (ROOT / "examples/capture/forward.jsonl").read_bytes()
XML = (ROOT / "examples/capture/forward.xml").read_bytes()
FOZ = next((ROOT / "tests/data").rglob("*.foz")).read_bytes()

NAMES = {"gz": "gzip", "xz": "xz", "zst": "zstd", "bz2": "bzip2"}


def findings(done: Done) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return found


def check(folder: Path, name: str, data: bytes, *arguments: str) -> list[dict[str, Any]]:
    (folder / name).write_bytes(data)
    found = findings(run(folder, "check", "--isolated", "--output", "json", *arguments, name))
    assert {finding["file"] for finding in found} <= {name}
    for finding in found:
        for each in (finding, *finding["labels"]):
            del each["file"]
    return found


@pytest.mark.parametrize("ending", COMPRESS)
@pytest.mark.parametrize(("name", "data"), [("c.jsonl", FORWARD), ("c.xml", XML), ("c.foz", FOZ)])
def test_a_compressed_capture_has_the_findings_of_what_it_holds(
    tmp_path: Path, ending: str, name: str, data: bytes
) -> None:
    assert check(tmp_path, f"{name}.{ending}", COMPRESS[ending](data)) == check(
        tmp_path, name, data
    )
    assert check(tmp_path, f"misnamed.{name}", COMPRESS[ending](data)) == check(
        tmp_path, name, data
    )


def test_standard_input_may_be_compressed(tmp_path: Path) -> None:
    (tmp_path / "c.jsonl").write_bytes(FORWARD)
    plain = run(tmp_path, "check", "--isolated", "--output", "concise", "c.jsonl")
    for compress in COMPRESS.values():
        done = run_process(
            tmp_path, "check", "--isolated", "--output", "concise", "-", stdin=compress(FORWARD)
        )
        assert done.stdout.replace("<stdin>:", "c.jsonl:") == plain.stdout


@pytest.mark.parametrize("ending", COMPRESS)
def test_members_follow_one_another(tmp_path: Path, ending: str) -> None:
    """As `cat a.gz b.gz` and pzstd write them; xz and gzip allow zeros after a member."""
    third = len(FORWARD) // 3
    members = [
        COMPRESS[ending](FORWARD[start : start + third]) for start in range(0, len(FORWARD), third)
    ]
    padding = bytes(8) if ending in ("gz", "xz") else b""
    skippable = b"\x50\x2a\x4d\x18\x04\0\0\0\0\0\0\0" if ending == "zst" else b""
    data = skippable + padding.join(members) + padding + skippable
    assert check(tmp_path, f"c.jsonl.{ending}", data) == check(tmp_path, "c.jsonl", FORWARD)


@pytest.mark.parametrize("ending", COMPRESS)
@pytest.mark.parametrize("part", [0.5, 0.9, 0.999])
def test_what_stands_before_the_end_of_truncated_data_is_linted(
    tmp_path: Path, ending: str, part: float
) -> None:
    # bzip2 has blocks of up to 900 kB, of which a part decompresses to nothing.
    members = [
        COMPRESS[ending](FORWARD[start : start + 4096]) for start in range(0, len(FORWARD), 4096)
    ]
    data = b"".join(members)
    found = check(tmp_path, f"c.jsonl.{ending}", data[: int(len(data) * part)])
    (end,) = [finding for finding in found if finding["code"] == "MSAA901"]
    assert end["message"] == f"the capture ends here: the {NAMES[ending]} data is truncated"
    assert end["line"] >= 100
    if part > 0.5:
        plain = {
            (finding["code"], finding["subject"]) for finding in check(tmp_path, "c.jsonl", FORWARD)
        }
        assert plain <= {(finding["code"], finding["subject"]) for finding in found}


@pytest.mark.parametrize("ending", COMPRESS)
def test_invalid_data_ends_the_capture(tmp_path: Path, ending: str) -> None:
    head, rest = (
        COMPRESS[ending](FORWARD[: len(FORWARD) // 2]),
        COMPRESS[ending](FORWARD[len(FORWARD) // 2 :]),
    )
    found = check(tmp_path, f"c.jsonl.{ending}", head + b"garbage" + rest)
    (end,) = [finding for finding in found if finding["code"] == "MSAA901"]
    assert end["message"].startswith(
        f"the capture ends here: the {NAMES[ending]} data is invalid: "
    )
    assert len(found) >= 10
    damaged = bytearray(head + rest)
    for at in range(len(head) + 100, len(head) + 200):
        damaged[at] ^= 0x55
    # Not all formats have a checksum that comes before the text.
    found = check(tmp_path, f"c.jsonl.{ending}", bytes(damaged))
    assert [finding["code"] for finding in found].count("MSAA901") == 1
    assert len(found) >= 10


def test_truncated_before_its_head_it_is_not_a_capture(tmp_path: Path) -> None:
    (found,) = check(tmp_path, "c.jsonl.gz", gzip.compress(FORWARD)[:12])
    assert (found["code"], found["message"]) == (
        "MSAA901",
        "unsupported input: this is a compressed file that is not a capture (the gzip data is "
        "truncated); only captures may be compressed: "
        "decompress it with `gzip -d FILE`",
    )


def test_a_bomb_ends_at_a_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compression, "MAX_BYTES", 1 << 20)
    monkeypatch.setattr(compression, "MAX_RATIO", 4)
    for compress in (COMPRESS["gz"], COMPRESS["zst"]):
        found = check(tmp_path, "c.jsonl", compress(FORWARD + b"\n" * (8 << 20)))
        (limit,) = [finding for finding in found if finding["code"] == "MSAA906"]
        assert "decompresses to more than 0 GiB and 4 times its size" in limit["message"]
        assert len(found) > 20


def test_a_stream_is_read_step_by_step() -> None:
    """A gigabyte of zeros is never in memory: each read decompresses what it returns."""
    from io import BytesIO

    from msaa_lint.input.file_types import compression_of

    source = BytesIO(gzip.compress(bytes(64 << 20)))
    kind = compression_of(source.getvalue())
    assert kind is not None
    stream = compression.decompressed(source, kind)
    assert stream.head() == bytes(1 << 16)
    assert source.tell() <= compression.BLOCK
    assert len(stream.read()) == 64 << 20 and stream.failure is None


def test_only_captures_may_be_compressed(tmp_path: Path) -> None:
    for data, words in (
        (
            b"images: {}\n",
            "a compressed file that is not a capture; only captures may be compressed",
        ),
        (b"GFXR\0\0\0\0", "a binary gfxreconstruct capture, compressed"),
    ):
        (found,) = check(tmp_path, "f.yaml.gz", gzip.compress(data))
        assert (
            found["message"]
            == f"unsupported input: this is {words}: decompress it with `gzip -d FILE`"
        )


def test_a_folder_has_compressed_captures(tmp_path: Path) -> None:
    (tmp_path / "a.jsonl.gz").write_bytes(gzip.compress(FORWARD))
    (tmp_path / "b.foz.zst").write_bytes(COMPRESS["zst"](FOZ))
    for name, data in (
        ("c.json.gz", b'{"images": {"c": {"format": "R8_UNORM"}}}'),
        ("d.jsonl.xz", b""),
        ("e.txt.gz", FORWARD),
    ):
        (tmp_path / name).write_bytes(gzip.compress(data))
    (tmp_path / "f.jsonl.gz").write_bytes(b"not compressed")
    inputs = json.loads(run(tmp_path, "check", "--isolated", "--output", "json", ".").stdout)[
        "inputs"
    ]
    assert [each["file"] for each in inputs] == ["a.jsonl.gz", "b.foz.zst"]


def test_a_slow_pipe_is_recognized() -> None:
    """A format is detected from the head, however few bytes arrive at a time."""

    class Slow:
        def __init__(self) -> None:
            self.left = FORWARD

        def read1(self, size: int) -> bytes:
            piece, self.left = self.left[:7], self.left[7:]
            return piece

        read = read1

    stream = CaptureStream(pieces_of(Slow(), 1 << 16))  # type: ignore[arg-type]
    assert stream.head() == FORWARD[: 1 << 16]
    assert stream.read() == FORWARD


def test_convert_and_cost_read_compressed_captures(tmp_path: Path) -> None:
    (tmp_path / "c.jsonl").write_bytes(FORWARD)
    (tmp_path / "c.jsonl.xz").write_bytes(lzma.compress(FORWARD))
    for command in ("convert", "cost"):
        assert (
            run(tmp_path, command, "c.jsonl.xz").stdout.replace("c.jsonl.xz", "c.jsonl")
            == run(tmp_path, command, "c.jsonl").stdout
        )
