"""The trial of inputs on one device: planned, let through the gate, run as written and as fixed, compared, timed, judged."""

from __future__ import annotations

import glob
import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from ..facts.frame import Frame
from .inputs import Input, of_pass
from .outcome import About, DeviceRun, about
from .pixels import Compared, Raw, compare, read
from .png import Album, show
from .protocol import Event
from .results import Unusable
from .session import FrameRun, Session
from .timing import Timing, cannot_show, difference, rounds, timing
from .verdict import REFUSED, Said, Times, Verdict, pixels_equal, settled

WARMUPS = 2
LARGEST = 256 << 20
"""Bytes of one image that are read back, at most."""

ICD_FOLDERS = ("/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d")
PINNED = ("VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_LOADER_DRIVERS_SELECT", "VK_ADD_DRIVER_FILES")


class PlannedPass(NamedTuple):
    """A pass of a plan; `refused` says why it cannot be run on any device, empty where it can."""

    name: str
    path: str
    refused: str = ""


class Planned(NamedTuple):
    """A frame's plan: as the child takes it, its passes, the defaults that were taken, and images with the steps that may lie between
    two right answers, and why."""

    data: Mapping[str, Any]
    passes: Sequence[PlannedPass]
    defaults: Sequence[str] = ()
    resolved: Mapping[str, str] = {}
    """By image that is resolved to: how (`subpass`, `rendering` or `command`)."""


class Planner(Protocol):
    """What makes plans, and knows what a device does not support."""

    def plan(self, frame: Frame, file: str, size: tuple[int, int] | None, samples: int | None) -> Planned:
        """The plan of a frame; it never raises for what the frame holds."""
        ...

    def gate(self, planned: Planned, device: Mapping[str, Any]) -> dict[int, str]:
        """The passes that a device does not support, by their number, and why."""
        ...

    def rows(
        self, input: Input, number: int, name: str, messages: Sequence[Event], layer: Mapping[str, Any] | None, device: Mapping[str, Any]
    ) -> tuple[Said, ...]:
        """The agreement of the layer and us about a pass."""
        ...


class Terms(NamedTuple):
    """What is asked of a trial: whether to ask the gate, where pictures go, whether to time (None: on a GPU), how often, at which size,
    with how many samples; `several` devices have folders of their own for their pictures."""

    gate: bool = True
    image: str | None = None
    time: bool | None = None
    repeats: int = 15
    size: tuple[int, int] | None = None
    samples: int | None = None
    several: bool = False


def environment(device: str | None) -> dict[str, str]:
    """What a child's environment is: ours, and where neither it nor `device` says which driver, lavapipe's alone if that is installed.

    Loading one driver takes a third of the time that loading all of Mesa's takes.
    """
    made = dict(os.environ)
    if device is None and not any(made.get(name) for name in PINNED):
        found = [path for folder in ICD_FOLDERS for path in sorted(glob.glob(os.path.join(folder, "lvp_icd*.json")))]
        if found:
            made["VK_DRIVER_FILES"] = found[0]
    return made


def trial(
    session: Session,
    inputs: Callable[[], Sequence[Input]],
    terms: Terms,
    planner: Planner | None = None,
    meanwhile: Callable[[], None] | None = None,
) -> DeviceRun:
    """What came of every pass of some inputs on the device of a session, which is closed then.

    `inputs` gives them once the child is opening the device; `meanwhile` is called once, while it draws.
    """
    asked = session.name or ""
    try:
        session.start()
        found = inputs()
        session.meanwhile = meanwhile
        this = _Trial(session, terms, session.open(), planner or _planner())
        verdicts = [verdict for each in found for verdict in this.input(each)]
    except Unusable as error:
        return DeviceRun(None, unusable=str(error), asked=asked)
    finally:
        session.close()
    shown = cannot_show({"type": this.about.type}, this.tiler)
    return DeviceRun(this.about, session.layer, verdicts, this.notes(verdicts), "", asked, shown, session.printed)


def _planner() -> Planner:
    from .planner import PLANNER

    return PLANNER


class _Version(NamedTuple):
    """A frame as written or fixed: its plan, which passes the gate refuses, and its run."""

    planned: Planned
    refused: Mapping[int, str]
    run: FrameRun
    images: Mapping[str, Raw]

    def number(self, name: str) -> int | None:
        """The number of a pass by its name, which fixes leave as it is."""
        return next((n for n, each in enumerate(self.planned.passes) if each.name == name), None)


class _Trial:
    """What is the same for all inputs."""

    def __init__(self, session: Session, terms: Terms, device: Mapping[str, Any], planner: Planner) -> None:
        self.session = session
        self.terms = terms
        self.device = device
        self.about: About = about(device)
        self.tiler: bool | None = _tiler(self.about)
        self.planner = planner
        self.timed = terms.time if terms.time is not None else not self.about.software
        self.album: Album | None = None
        if terms.image is not None:
            from .png import file_name

            self.album = Album(os.path.join(terms.image, file_name(self.about.name)) if terms.several else terms.image)

    def notes(self, verdicts: Sequence[Verdict]) -> list[str]:
        """What holds for the device as a whole."""
        found = []
        if self.session.layer is None and self.session.validation:
            words = "the validation layer is missing, so nothing is said of how it agrees with us"
            found.append(f"{words}; on Debian `apt install vulkan-validationlayers`")
        if not self.timed and self.terms.time is None and verdicts:
            found.append("times are not measured on a software driver unless --time asks for them")
        if not self.terms.gate:
            found.append("the gate is off: what the device does not support was tried too, and its results mean nothing")
        return found

    def input(self, each: Input) -> list[Verdict]:
        """The verdicts on the passes of one input."""
        before = self.version(each.frame, each.file)
        after = self.version(each.fixed, each.file) if each.fixed is not None else None
        compared, why = self.compared(before, after)
        pictures = self.pictures(each, before, after, compared)
        times = self.times(before, after) if self.timed else {}
        verdicts = []
        for number, one in enumerate(before.planned.passes):
            verdict = self.verdict(each, before, after, number, times.get(number))
            if one.refused or number in before.refused:
                verdicts.append(verdict._replace(status=REFUSED, reason=one.refused or before.refused[number]))
                continue
            own = [image for image in compared if _concerns(image.image, one, each.frame, len(before.planned.passes))]
            notes = (*verdict.notes, *([why] if why else ()))
            verdict = verdict._replace(images=tuple(own), pixels_equal=pixels_equal(own), notes=notes)
            fixed_number = after.number(one.name) if after is not None else None
            fixed = after.run.passes.get(fixed_number) if after is not None and fixed_number is not None else None
            errors = any(found.severity == "error" for found in (*each.findings, *each.silenced))
            verdict = settled(verdict, before.run.passes.get(number), fixed, errors)
            verdicts.append(verdict._replace(pictures=tuple(pictures) if number == len(before.planned.passes) - 1 else ()))
        return verdicts

    def version(self, frame: Frame, file: str) -> _Version:
        """A frame planned, let through the gate, and run."""
        planned = self.planner.plan(frame, file, self.terms.size, self.terms.samples)
        refused = self.planner.gate(planned, self.device) if self.terms.gate else {}
        going = [n for n, each in enumerate(planned.passes) if not each.refused and n not in refused]
        if not going:
            return _Version(planned, refused, FrameRun({}), {})
        folder = self.session.folder("pixels")
        want = {"pixels": folder, "repeats": 0, "warmups": 0, "size": None, "samples_of": None}
        try:
            run = self.session.run(planned.data, going, want)
            return _Version(planned, refused, run, dict(_raw(run.images, folder)))
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def compared(self, before: _Version, after: _Version | None) -> tuple[list[Compared], str]:
        """The images of both versions compared, or why they cannot be."""
        if after is None or not before.run.passes:
            return [], ""
        if not before.run.whole or not after.run.whole or before.run.failed or after.run.failed:
            reason = before.run.failed or after.run.failed or "not every pass went through"
            return [], f"the pictures are not compared: {reason}"
        if any(each.created is False for version in (before, after) for each in version.run.passes.values()):
            return [], "the pictures are not compared: a pass could not be created"
        if len(before.run.passes) != len(after.run.passes):
            return [], "the pictures are not compared: the device does not support the same passes of both versions"
        moved = {name for name, how in before.planned.resolved.items() if after.planned.resolved.get(name, how) != how}
        why = "an average is rounded as each way of resolving does it"
        return compare(before.images, after.images, dict.fromkeys(moved, (1, why))), ""

    def pictures(self, each: Input, before: _Version, after: _Version | None, compared: Sequence[Compared]) -> list[str]:
        if self.album is None:
            return []
        paths = []
        first = {image.image: image.first for image in compared}
        stem = (each.file, *([str(each.number)] if each.many > 1 else ()))
        for name, raw in sorted(before.images.items()):
            texels = read(raw)
            other = after.images.get(name) if after is not None else None
            if texels is not None and texels.planes:
                paths += show(self.album, (*stem, name), texels, read(other) if other is not None else None, first.get(name))
        return paths

    def times(self, before: _Version, after: _Version | None) -> dict[int, Times]:
        """The times of the passes that went through, by their number as written: repeats of both versions in turn, in fresh processes."""
        versions = {"as written": before, **({"fixed": after} if after is not None else {})}
        found: dict[str, dict[int, list[float]]] = {name: {} for name in versions}
        source = "wall"
        with _timing_session(self.session) as session:
            before_this = 0
            for process, order, count in rounds(self.terms.repeats):
                if process != before_this:
                    session.close()
                before_this = process
                for name in order:
                    if name not in versions:
                        continue
                    version = versions[name]
                    going = [n for n, ran in version.run.passes.items() if ran.end == "" and ran.created is not False]
                    if not going:
                        continue
                    want = {"pixels": None, "repeats": count, "warmups": WARMUPS, "size": None, "samples_of": None}
                    for n, ran in session.run(version.planned.data, going, want).passes.items():
                        found[name].setdefault(n, []).extend(ran.times)
                        source = ran.source or source
        made = {}
        for number, values in found["as written"].items():
            if not values:
                continue
            written, fixed = timing(values, source), self._fixed_time(before, after, found, number, source)
            made[number] = Times(written, fixed, difference(written, fixed, self.about.software) if fixed is not None else None)
        return made

    @staticmethod
    def _fixed_time(
        before: _Version, after: _Version | None, found: Mapping[str, Mapping[int, list[float]]], number: int, source: str
    ) -> Timing | None:
        twin = after.number(before.planned.passes[number].name) if after is not None else None
        values = found.get("fixed", {}).get(twin, []) if twin is not None else []
        return timing(values, source) if values else None

    def verdict(self, each: Input, before: _Version, after: _Version | None, number: int, times: Times | None) -> Verdict:
        """What is known of a pass before it is judged."""
        one = before.planned.passes[number]
        ran = before.run.passes.get(number)
        own = next((p for p in each.frame.passes if p.name == one.name), None)
        findings = [*each.findings, *each.silenced]
        of = of_pass(each.frame, own, findings) if own is not None else findings
        notes = list(before.planned.defaults) if number == 0 else []
        if ran is not None and ran.dropped:
            notes.append(f"{ran.dropped} more messages of the layer are left out")
        said: tuple[Said, ...] = ()
        if ran is not None and self.session.layer is not None:
            messages = [*ran.messages, *_of_frame(before, number)]
            said = self.planner.rows(each, number, one.name, messages, self.session.layer, self.device)
        codes = tuple(dict.fromkeys(found.code for found in of))
        model = _model(each, one.path, after)
        path = each.prefix + one.path
        return Verdict(each.file, one.name, path, "", said=said, findings=codes, times=times, model=model, notes=tuple(notes))


def _timing_session(session: Session) -> Session:
    """A session of the same device without the layer, which would be timed with it."""
    return Session(
        session.name, validation=False, limits=session.limits, environment=session.environment, execute=session.execute
    )


def _of_frame(version: _Version, number: int) -> list[Event]:
    """The messages that are of no pass and have to do with one: the first of those that ran has them."""
    return list(version.run.messages) if number == min(version.run.passes, default=number) else []


def _concerns(image: str, one: PlannedPass, frame: Frame, passes: int) -> bool:
    """Whether an image is told of with a pass: one that it renders or resolves to; what no pass does is told with each."""
    owners = [each.name for each in frame.passes if _draws(each, image)]
    return passes == 1 or not owners or one.name in owners


def _draws(each: Any, image: str) -> bool:
    targets = {target.name for attachment in each.attachments for target in attachment.targets}
    targets.update(r.target_image.name for subpass in each.subpasses for r in subpass.resolves if r.target_image is not None)
    return image.partition(":")[0] in targets


def _raw(images: Mapping[str, Event], folder: str) -> Any:
    """The images of a run, read: only files of that folder, and none that is larger than an image can be."""
    for name, event in images.items():
        path = os.path.realpath(event["path"])
        if os.path.dirname(path) != os.path.realpath(folder):
            continue
        try:
            with open(path, "rb") as file:
                data = file.read(LARGEST)
        except OSError:
            continue
        yield name, Raw(event["format"], event["width"], event["height"], data, str(event.get("aspect") or ""))


def _model(each: Input, path: str, after: _Version | None) -> dict[str, Any] | None:
    """What the cost model says of a pass, as written and fixed."""
    from ..cost.model import frame_cost

    written = next((cost for cost in frame_cost(each.frame, each.device).passes if cost.path == path), None)
    if written is None:
        return None
    fixed = None
    if each.fixed is not None and after is not None:
        fixed = next((cost for cost in frame_cost(each.fixed, each.device).passes if cost.name == written.name), None)
    return {"as_written": written.amount._asdict(), "fixed": fixed.amount._asdict() if fixed is not None else None}


def _tiler(device: About) -> bool | None:
    """Whether a device renders by tiles, as its vendor's do."""
    from ..devices.vendors import TILERS, vendor_of

    vendor = vendor_of(device.vendor_id)
    return True if vendor in TILERS else False if vendor in IMMEDIATE else None


IMMEDIATE = ("amd", "intel", "nvidia")
"""Vendors whose GPUs keep the samples of a pass in memory."""
