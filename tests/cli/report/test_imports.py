"""What printing for a terminal loads: it is on the way of every run."""

import subprocess
import sys

HEAVY = (
    "pydantic rich typer dataclasses inspect pathlib importlib.metadata importlib.resources "
    "logging jsonschema numpy vulkan difflib json"
    " tomllib hashlib subprocess urllib.parse xml.etree.ElementTree unicodedata"
)


def test_text_outputs_load_nothing_heavy() -> None:
    code = (
        "import sys; before = set(sys.modules)\n"
        "from msaa_lint.core.finding import Finding, Result\n"
        "from msaa_lint.cli.report import Options, render\n"
        "found = Finding('MSAA1', 'r', 'note', 'low', 'm', 'f', None)\n"
        "for name in ('full', 'concise'):\n"
        "    render(name, Result([found], [], [], ['f'], {}, []), lambda text: None, Options())\n"
        f"print(*sorted(set({HEAVY!r}.split()) & (set(sys.modules) - before)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
