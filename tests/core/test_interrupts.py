"""Signals end the command wherever they arrive."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]

PROGRAM = """
import os, signal, sys, time
sys.path.insert(0, sys.argv[1])
from msaa_lint.core.interrupts import HELD, install
install()
sent = []

def send():
    sent.append(signal.SIGINT)
    os.kill(os.getpid(), signal.SIGINT)

def during_import():
    def trace(frame, event, _):
        if frame.f_code.co_name == "cb" and frame.f_code.co_filename == "<frozen importlib._bootstrap>" and not sent:
            send()
    sys.settrace(trace)
    import wave
    sys.settrace(None)

def while_held():
    with HELD:
        send()
        time.sleep(0.05)
        print("held")

def else_():
    send()
    print("not reached")

try:
    globals()[sys.argv[2]]()
    time.sleep(30)
except KeyboardInterrupt:
    print("interrupted" if sent else "too early")
"""


@pytest.mark.skipif(sys.platform == "win32", reason="os.kill ends the process there")
@pytest.mark.parametrize(
    ("case", "printed"),
    [
        ("during_import", "interrupted"),
        ("while_held", "held interrupted"),
        ("else_", "interrupted"),
    ],
)
def test_an_interrupt_is_raised_where_it_is_not_lost(case: str, printed: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, str(ROOT), case],
        capture_output=True,
        text=True,
        timeout=60,
        # A shell in the background ignores interrupts, which children inherit.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"},
    )
    assert (done.stdout.split(), done.stderr) == (printed.split(), "")
