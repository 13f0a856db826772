import json

from msaa_lint.cli.report.fingerprint import fingerprint
from tests.cli.report.sample import finding, frame, printed, result


def test_issues() -> None:
    broken, stored, _, binary = json.loads(printed("gitlab", frame()))
    assert stored == {
        "description": (
            "multisampled-attachment-stored: multisampled attachment `color` is resolved and also "
            "stored"
            " (+2248 MB/s written, +31.6 MiB of memory, +225 mW)"
        ),
        "check_name": "multisampled-attachment-stored",
        "fingerprint": fingerprint(frame().findings[1], 0),
        "severity": "minor",
        "location": {
            "path": "passes/forward.yaml",
            "positions": {"begin": {"line": 9, "column": 18}, "end": {"line": 9, "column": 23}},
        },
    }
    assert (broken["severity"], binary["severity"]) == ("major", "info")
    assert binary["location"] == {"path": "trace.rdc", "lines": {"begin": 1}}


def test_clean_run_is_an_empty_list() -> None:
    assert printed("gitlab", result(files=("a.yaml",))) == "[]\n"


def test_same_finding_twice_has_two_fingerprints_and_no_leading_dot() -> None:
    one, two = json.loads(
        printed("gitlab", result(finding(file="./a.yaml"), finding(file="./a.yaml")))
    )
    assert one["location"]["path"] == "a.yaml"
    assert one["fingerprint"] != two["fingerprint"]
