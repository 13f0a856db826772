"""The parent's side: frames run in one child as long as it lives; a pass that kills it is
identified, tried alone, and skipped.
"""

from __future__ import annotations

import glob
import os
from collections.abc import Callable, Mapping, Sequence
from types import TracebackType
from typing import Any, NamedTuple

from msaa_lint.core.child_environment import child_environment
from msaa_lint.core.scratch import ScratchFolder

from .child import Child, ChildExit, Limits
from .frame_results import FrameRun, PassOutcome, RunCollector
from .protocol import Event
from .timed import Item, TimedCollector, TimedRun, TimingOptions
from .vulkan_errors import Unusable, missing_package
from .worker import EXECUTE

ICD_FOLDERS = ("/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d")
PINNED = ("VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_LOADER_DRIVERS_SELECT", "VK_ADD_DRIVER_FILES")

MAX_DEATHS = 16
"""Deaths in a frame after which its remaining passes are skipped: each costs two new processes."""

OPENING = 30.0
"""Minimum time limit in seconds for opening a driver: the first run after a reboot loads everything
from disk.
"""


def environment(device: str | None) -> dict[str, str]:
    """The `child_environment`, restricted to lavapipe if it is installed and neither the
    environment nor `device` selects a driver.

    Loading one driver takes a third of the time of loading all of Mesa's.
    """
    variables = child_environment()
    if device is None and not any(variables.get(name) for name in PINNED):
        found = [
            path
            for folder in ICD_FOLDERS
            for path in sorted(glob.glob(os.path.join(folder, "lvp_icd*.json")))
        ]
        if found:
            variables["VK_DRIVER_FILES"] = found[0]
    return variables


class Session:
    """A device in child processes. `with Session(...) as session:`; afterwards nothing remains in
    memory or on disk.
    """

    def __init__(
        self,
        device: str | None = None,
        *,
        validation: bool = True,
        vendors: Sequence[str] = ("arm", "img"),
        limits: Limits | None = None,
        environment: Mapping[str, str] | None = None,
        execute: str = EXECUTE,
    ) -> None:
        self.name = device
        self.validation = validation
        self.vendors = tuple(vendors)
        self.limits = limits or Limits()
        self.environment = child_environment() if environment is None else environment
        self.execute = execute
        self.device: dict[str, Any] = {}
        self.layer: dict[str, Any] | None = None
        self.printed: list[str] = []
        self.meanwhile: Callable[[], None] | None = None
        """Called once while the child works on the next run."""
        self._scratch: ScratchFolder | None = None
        self._child: Child | None = None
        self._opened = False

    def __enter__(self) -> Session:
        self._scratch = ScratchFolder()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            self.close()
        finally:
            if self._scratch is not None:
                self._scratch.remove()

    def close(self) -> None:
        """Terminates the child, if there is one."""
        child, self._child, self._opened = self._child, None, False
        if child is not None:
            child.close()
            text = child.printed.text().strip()
            if text:
                self.printed.append(text)

    def start(self) -> None:
        """Lets a child open the device, without waiting for it."""
        if self._child is None:
            self._start(
                {
                    "do": "open",
                    "device": self.name,
                    "validation": self.validation,
                    "vendors": list(self.vendors),
                }
            )

    def open(self) -> dict[str, Any]:
        """Opens the device and returns its properties. Unusable if there is none."""
        if not self._opened:
            self.start()
            found = self._first()
            self.device, self.layer = found["device"], found.get("layer")
            self._opened = True
        return self.device

    def devices(self) -> list[dict[str, Any]]:
        """Every device that the loader finds. Unusable without a driver."""
        self.close()
        self._start({"do": "devices"})
        try:
            return list(self._first()["devices"])
        finally:
            self.close()

    def folder(self, name: str) -> str:
        """A folder of the session for the files of a run."""
        assert self._scratch is not None
        path = os.path.join(self._scratch.path, name)
        os.makedirs(path, exist_ok=True)
        return path

    def run(self, plan: Any, passes: Sequence[int], want: Mapping[str, Any]) -> FrameRun:
        """Runs passes of a plan in order. The result says how the driver behaved. Unusable if the
        device cannot be opened any more.
        """
        done: dict[int, PassOutcome] = {}
        left = list(passes)
        failed = ""
        while left:
            collected = RunCollector()
            try:
                self._collect(plan, left, want, collected)
            except ChildExit as ended:
                guilty = collected.at
                if guilty is None:
                    # It ended before any pass: run each pass alone to find the cause.
                    done.update(
                        (number, self._alone(plan, number, want, ended))
                        for number in left[:MAX_DEATHS]
                    )
                    done.update((number, _left(number)) for number in left[MAX_DEATHS:])
                    return FrameRun(done, tuple(collected.messages), {}, False)
                done[guilty] = self._alone(plan, guilty, want, ended)
            else:
                failed = failed or collected.failed
                guilty = collected.at
                if not collected.failed or guilty not in left:
                    whole = not done and not failed
                    done.update((number, collected.outcome(number)) for number in left)
                    images = collected.images if whole else {}
                    return FrameRun(
                        done,
                        tuple(collected.messages),
                        images,
                        whole,
                        failed,
                        frozenset(collected.defined if whole else ()),
                    )
                done[guilty] = collected.outcome(guilty)
            left.remove(guilty)
            if sum(ran.end != "" for ran in done.values()) >= MAX_DEATHS:
                done.update((number, _left(number)) for number in left)
                return FrameRun(done, tuple(collected.messages), {}, False, failed)
        return FrameRun(done, whole=False, failed=failed)

    def time(self, items: Sequence[Item], want: TimingOptions) -> TimedRun:
        """Times items in turn. An item that kills the driver is left out, and the others are timed
        again. Unusable if the device cannot be opened any more.
        """
        ended: dict[int, str] = {}
        while True:
            left = [number for number in range(len(items)) if number not in ended]
            collected = TimedCollector(left, ended)
            try:
                if left:
                    request = {
                        "do": "time",
                        "items": [items[number] for number in left],
                        "want": want._asdict(),
                    }
                    self._answered(request, collected)
            except ChildExit as died:
                guilty = left[collected.at or 0]
                ended[guilty] = str(died)
                if len(ended) < MAX_DEATHS:
                    continue
                ended |= dict.fromkeys(left, f"skipped: {MAX_DEATHS} techniques killed the driver")
                collected = TimedCollector([], ended)
            return collected.run(len(items))

    def _alone(
        self, plan: Any, number: int, want: Mapping[str, Any], ended: ChildExit
    ) -> PassOutcome:
        """Runs a pass during which the child died, alone in a fresh child. A pass that timed out is
        not repeated.
        """
        if ended.how == "timed-out":
            return PassOutcome(number, end="timed-out", reason=str(ended))
        self.close()
        collected = RunCollector()
        try:
            self._collect(plan, [number], want, collected)
        except ChildExit as again:
            how = "timed-out" if again.how == "timed-out" else "died"
            return collected.outcome(number)._replace(
                end=how, signal=again.signal, reason=str(again)
            )
        finally:
            self.close()
        ran = collected.outcome(number)
        return ran._replace(
            end="died",
            signal=ended.signal,
            reason=f"{ended} (only together with other passes, not alone)",
        )

    def _collect(
        self, plan: Any, passes: Sequence[int], want: Mapping[str, Any], into: RunCollector
    ) -> None:
        self._answered(
            {"do": "run", "plan": plan, "passes": list(passes), "want": dict(want)}, into
        )

    def _answered(self, request: Mapping[str, Any], into: RunCollector | TimedCollector) -> None:
        """Sends a request and collects the answers."""
        self.open()
        assert self._child is not None
        try:
            self._child.send(request)
            meanwhile, self.meanwhile = self.meanwhile, None
            if meanwhile is not None:
                meanwhile()
            for event in self._child.answers():
                into.add(event)
        except ChildExit:
            self.close()
            raise

    def _start(self, request: Mapping[str, Any]) -> None:
        assert self._scratch is not None
        self._child = Child(self._scratch.path, self.limits, self.environment, self.execute)
        self._child.send(request, max(OPENING, self.limits.seconds))

    def _first(self) -> Event:
        """The answer to the first request of a child."""
        assert self._child is not None
        try:
            *_, found = self._child.answers(max(OPENING, self.limits.seconds))
        except ChildExit as ended:
            self.close()
            raise Unusable(f"cannot open the driver: {ended}") from None
        if found["event"] == "failed":
            self.close()
            raise Unusable(_advice(found))
        return found


class SessionOptions(NamedTuple):
    """The arguments of a `Session`, in the environment of the process that opens it."""

    device: str | None
    validation: bool
    limits: Limits
    execute: str = EXECUTE

    def session(self) -> Session:
        """Such a session."""
        variables = environment(self.device)
        return Session(
            self.device,
            validation=self.validation,
            limits=self.limits,
            environment=variables,
            execute=self.execute,
        )


def _left(number: int) -> PassOutcome:
    return PassOutcome(
        number,
        end="left",
        reason=f"skipped: {MAX_DEATHS} passes of this frame failed or killed the driver",
    )


def _advice(found: Event) -> str:
    """What to do if a child cannot open a device."""
    if found.get("missing") == "vulkan":
        return missing_package()
    if found.get("missing"):
        return f"the module `{found['missing']}` is not installed: {found['reason']}"
    if found.get("kind") == "memory":
        return "there is not enough memory to open a device"
    return str(found["reason"])
