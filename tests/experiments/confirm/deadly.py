"""The real driver, which dies in passes of frames that are 66 pixels wide."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Sequence
from typing import Any

from msaa_lint.experiments.confirm import execute
from msaa_lint.experiments.confirm.execute import RunOptions, Session, devices, from_json

WIDTH = 66


def run(
    session: Session,
    plan: Any,
    passes: Sequence[int],
    want: RunOptions,
    emit: Callable[[dict[str, Any]], None],
) -> None:
    if any(image.width == WIDTH for image in plan.images):
        emit({"event": "pass", "pass": passes[0]})
        os.kill(os.getpid(), signal.SIGSEGV)
    execute.run(session, plan, passes, want, emit)


__all__ = ["RunOptions", "Session", "devices", "from_json", "run"]
