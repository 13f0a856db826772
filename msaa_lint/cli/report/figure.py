"""matplotlib figures as bytes. Nothing that a user configures affects them, so the same data gives the same SVG."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable
from typing import Any

_SETTINGS: Any = {
    "svg.hashsalt": "msaa-lint",
    "svg.fonttype": "none",
    "text.parse_math": False,
    "font.size": 10,
    "hatch.linewidth": 0.6,
}


def save_figure(width: float, height: float, draw: Callable[[Any], None], format: str) -> bytes:
    """What `draw` puts on a figure of a size in inches, as `svg` or `png`. ModuleNotFoundError if matplotlib is not installed."""
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    with matplotlib.rc_context(), warnings.catch_warnings():
        # A missing glyph is drawn as a box: nothing to print.
        warnings.simplefilter("ignore")
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_SETTINGS)
        figure = Figure(figsize=(width, height), layout="constrained")
        FigureCanvasAgg(figure)
        draw(figure)
        out = io.BytesIO()
        metadata: dict[str, Any] = {"Date": None, "Creator": "msaa-lint"} if format == "svg" else {"Software": "msaa-lint"}
        figure.savefig(out, format=format, metadata=metadata, dpi=150)
    return out.getvalue()
