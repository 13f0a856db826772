"""Folders that tests read."""

import os
from pathlib import Path

ROOT = Path(__file__).parent.parent
SAMPLES = Path(os.environ.get("MSAA_LINT_SAMPLES") or ROOT.parent / "shared" / "samples")
"""Inputs of other programs, where they are at hand."""
