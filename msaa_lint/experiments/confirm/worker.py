"""The child process that calls a driver: `python -m msaa_lint.experiments.confirm.worker`, started
by `session` only.

Requests arrive as JSON lines on standard input; answers go to a duplicate of standard output that
no library knows. The output of drivers and layers goes to standard error, which the parent reads
and limits. Each pass is announced before it is touched, so that the parent knows what killed this
process.
"""

from __future__ import annotations

import importlib
import json
import os
import signal
import sys
from collections.abc import Callable
from typing import IO, Any

from msaa_lint.core.parent_process import end_with_parent

from .protocol import MAX_LINE, Event, line
from .vulkan_errors import Unusable

EXECUTE = "msaa_lint.experiments.confirm.execute"
INTERLEAVED = "msaa_lint.experiments.confirm.interleaved"


def main(arguments: list[str]) -> int:
    """Answers requests until there are no more. The only argument is JSON: `memory`, a limit in
    bytes; `execute`, the module that runs plans; and `parent`, the process to end with.
    """
    limits = json.loads(arguments[0]) if arguments else {}
    end_with_parent(limits.get("parent", os.getppid()))
    with os.fdopen(_private(), "wb", buffering=0) as answers:
        _limit(int(limits.get("memory", 0)))
        return _serve(sys.stdin.buffer, answers, limits.get("execute") or EXECUTE)


def _private() -> int:
    """A descriptor of the original standard output; standard output itself is redirected to
    standard error.
    """
    own = os.dup(1)
    os.dup2(2, 1)
    os.set_inheritable(own, False)
    return own


def _limit(memory: int) -> None:
    """Disables core files and limits the address space, where the system supports it."""
    try:
        import resource
    except ImportError:
        return
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if memory:
        hard = resource.getrlimit(resource.RLIMIT_AS)[1]
        least = memory if hard == resource.RLIM_INFINITY else min(memory, hard)
        resource.setrlimit(resource.RLIMIT_AS, (least, hard))


def _serve(requests: IO[bytes], answers: IO[bytes], execute: str) -> int:
    def emit(event: Event) -> None:
        answers.write(line(event))

    session: Any = None
    while text := requests.readline(MAX_LINE):
        request = json.loads(text)
        _alarm(request.get("seconds", 0))
        try:
            session = _answer(importlib.import_module(execute), session, request, emit)
        except MemoryError:
            emit({"event": "failed", "kind": "memory", "reason": "out of memory"})
        except ImportError as error:
            emit(
                {
                    "event": "failed",
                    "kind": "environment",
                    "reason": str(error)[:400],
                    "missing": error.name,
                }
            )
        except Exception as error:
            kind = "environment" if isinstance(error, Unusable) else "program"
            reason = str(error) if kind == "environment" else f"{type(error).__name__}: {error}"
            emit({"event": "failed", "kind": kind, "reason": reason[:2000], "where": _where(error)})
        _alarm(0)
    return 0


def _answer(
    module: Any, session: Any, request: dict[str, Any], emit: Callable[[Event], None]
) -> Any:
    """Handles a request and returns the session, which an `open` request creates."""
    if request["do"] == "devices":
        emit({"event": "devices", "devices": module.devices()})
    elif request["do"] == "open":
        session = module.Session(
            request["device"], request["validation"], tuple(request["vendors"])
        )
        emit({"event": "opened", "device": session.device, "layer": session.layer})
    elif request["do"] == "time":
        importlib.import_module(INTERLEAVED).run(session, request["items"], request["want"], emit)
    else:
        module.run(
            session,
            module.from_json(request["plan"]),
            request["passes"],
            module.RunOptions(**request["want"]),
            emit,
        )
    return session


def _alarm(seconds: float) -> None:
    """Lets the system end this process after `seconds` in case the parent is gone; 0 cancels the
    alarm.
    """
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGALRM, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_REAL, seconds)


def _where(error: BaseException) -> str:
    import traceback

    return "".join(traceback.format_exception(error))[-4000:]


if __name__ == "__main__":
    # Nobody needs to know that the parent is gone.
    try:
        code = main(sys.argv[1:])
    except BrokenPipeError:
        code = 0
    # Skip the interpreter's shutdown: a driver's threads may hold its locks.
    os._exit(code)
