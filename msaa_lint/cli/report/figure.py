"""matplotlib figures as bytes. Nothing that a user configures affects them, so the same data gives the same SVG."""

from __future__ import annotations

import contextlib
import io
import os
import warnings
from collections.abc import Callable, Iterator
from typing import Any

from msaa_lint.core.package import FOLDER

_SETTINGS: Any = {
    "svg.hashsalt": "msaa-lint",
    "svg.fonttype": "none",
    "text.parse_math": False,
    "font.size": 10,
    "hatch.linewidth": 0.6,
}


def save_figure(width: float, height: float, draw: Callable[[Any], None], format: str) -> bytes:
    """What `draw` puts on a figure of a size in inches, as `svg` or `png`. ModuleNotFoundError if matplotlib is not installed."""
    with _without_settings():
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


@contextlib.contextmanager
def _without_settings() -> Iterator[None]:
    """While matplotlib is imported: it reads `matplotlibrc` of the working folder before all others."""
    stated = {name: os.environ.pop(name, None) for name in ("MATPLOTLIBRC", "MPLCONFIGDIR")}
    os.environ["MATPLOTLIBRC"] = os.devnull
    if os.path.isabs(cache := stated["MPLCONFIGDIR"] or ""):
        os.environ["MPLCONFIGDIR"] = cache
    try:
        with contextlib.chdir(FOLDER):
            yield
    finally:
        for name, value in stated.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
