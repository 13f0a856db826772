"""A finding that says that `--fix` fixes it is fixed by `--fix`, and nothing new is found after
that.
"""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from tests.command import run
from tests.strength import examples
from tests.truth.test_spelled import TEXTS


def findings(folder: Path, *options: str) -> list[dict[str, Any]]:
    done = run(folder, "check", "--no-cache", "--output", "json", *options, "frame.msaa.yaml")
    found: list[dict[str, Any]] = json.loads(done.stdout)["findings"]
    return found


@examples(3)
@given(st.sampled_from(sorted(TEXTS)))
def test_what_is_said_to_be_safe_is_fixed(name: str) -> None:
    with TemporaryDirectory() as folder:
        Path(folder, "frame.msaa.yaml").write_text(TEXTS[name], encoding="utf-8")
        before = findings(Path(folder))
        run(Path(folder), "check", "--no-cache", "--fix", "frame.msaa.yaml")
        after = findings(Path(folder))
    said = {
        (found["code"], found["message"])
        for found in before
        if found["fixable"] and found["fix"]["safe"]
    }
    assert not said & {(found["code"], found["message"]) for found in after}
    assert not Counter(found["code"] for found in after) - Counter(
        found["code"] for found in before
    )
