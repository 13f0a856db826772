from xml.etree import ElementTree

from tests.cli.report.sample import finding, frame, printed, result


def test_suites_and_cases() -> None:
    root = ElementTree.fromstring(printed("junit", frame()).encode())
    assert root.attrib == {"name": "msaa-lint", "tests": "6", "failures": "2", "errors": "1"}
    suites = {suite.attrib["name"]: suite for suite in root}
    assert list(suites) == [
        "broken.yaml",
        "passes/clean.yaml",
        "passes/forward.yaml",
        "src/render.cpp",
        "trace.rdc",
    ]
    counts = {
        name: [suite.attrib[key] for key in ("tests", "failures", "errors")]
        for name, suite in suites.items()
    }
    assert counts == {
        "broken.yaml": ["1", "0", "1"],
        "passes/clean.yaml": ["1", "0", "0"],
        "passes/forward.yaml": ["2", "2", "0"],
        "src/render.cpp": ["1", "0", "0"],
        "trace.rdc": ["1", "0", "0"],
    }
    (clean,) = suites["passes/clean.yaml"]
    assert clean.attrib == {"name": "No findings", "classname": "passes/clean"} and len(clean) == 0
    (unread,) = suites["src/render.cpp"]
    assert [(each.tag, each.attrib["message"]) for each in unread] == [
        ("skipped", "`samples = count` is in no pass")
    ]
    assert (
        suites["src/render.cpp"].attrib["skipped"] == "1"
        and "skipped" not in suites["passes/clean.yaml"].attrib
    )
    stored = suites["passes/forward.yaml"][0]
    assert stored.attrib == {
        "name": "org.msaa-lint.MSAA201",
        "classname": "passes/forward",
        "file": "passes/forward.yaml",
        "line": "9",
        "column": "18",
    }
    (failure,) = stored.findall("failure")
    cost = "+2248 MB/s written, +31.6 MiB of memory, +225 mW"
    assert (
        failure.text
        == "line 9, column 18, multisampled attachment `color` is resolved and also stored "
        f"({cost})"
    )
    assert failure.attrib["type"] == "multisampled-attachment-stored"


def test_run_without_files_has_a_passing_case() -> None:
    root = ElementTree.fromstring(printed("junit", result()))
    assert root.attrib["tests"] == "1" and len(root.findall("./testsuite/testcase")) == 1


def test_characters_that_xml_forbids_and_that_it_means() -> None:
    evil = "\x00\x0b\ufffe\ud800 <a b='c'>&\"]]>"
    root = ElementTree.fromstring(printed("junit", result(finding(evil, file=evil))))
    failure = root.find("./testsuite/testcase/failure")
    assert failure is not None
    assert failure.attrib["message"] == "\\x00\\x0b\\ufffe\\ud800 <a b='c'>&\"]]>"
    assert root[0].attrib["name"] == "\\x00\\x0b\\ufffe\\ud800 <a b='c'>&\"]]>"
