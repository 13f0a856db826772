"""The trial of inputs on one device: planned, let through the gate, run as written and as fixed, compared, timed, judged."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.core.finding import Finding
from msaa_lint.frame.facts.frame import Frame

from .frame_results import FrameRun
from .inputs import Input, of_pass
from .outcome import About, DeviceRun, about
from .pixels import Compared, Raw, compare, read
from .planning import PlannedPass, Planner, Told
from .protocol import Event
from .results import Unusable
from .session import Session
from .timing import cannot_show
from .verdict import REFUSED, SKIPPED, Said, Verdict, pixels_equal, settled
from .version_timing import Version, times

if TYPE_CHECKING:
    from .png import Album

LARGEST = 256 << 20
"""Bytes of one image that are read back, at most."""


NOTHING_TO_COMPARE = "there is no picture to compare: no image of one sample holds in the end what the pass draws"


class Terms(NamedTuple):
    """What is asked of a trial: whether to ask the gate, where pictures go, whether to time (None: on a GPU), how often, at which size,
    with how many samples; `resolves` has those of colour held against their samples too; `several` devices have folders of their own for
    their pictures."""

    gate: bool = True
    image: str | None = None
    time: bool | None = None
    repeats: int = 15
    size: tuple[int, int] | None = None
    samples: int | None = None
    several: bool = False
    resolves: bool = False


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
        # Imports what planning needs while the device opens.
        planner = planner or _planner()
        found = inputs()
        session.meanwhile = meanwhile
        this = _Trial(session, terms, session.open(), planner)
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
            from .png import Album, file_name

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
        compared, why = self.compared(each, before, after)
        pictures = self.pictures(each, before, after, compared)
        versions = {"as written": before, **({"fixed": after} if after is not None else {})}
        timed = times(self.session, versions, self.terms.repeats, self.about.software) if self.timed else {}
        # The model's figures stand beside times alone, and take a while to reckon.
        said, model = self.said(each, before), _model(each) if self.timed else {}
        deviating = self.planner.deviations(self.session, before.planned, self.device, self.terms.resolves) if before.run.passes else {}
        verdicts = []
        if not before.planned.passes:
            verdicts.append(Verdict(each.file, "", each.prefix.rstrip("."), SKIPPED, "it has no pass"))
        for number, one in enumerate(before.planned.passes):
            verdict = self.verdict(each, before, number)
            verdict = verdict._replace(said=tuple(said.get(number, ())), times=timed.get(number), model=model.get(one.name))
            if one.refused or number in before.refused:
                verdicts.append(verdict._replace(status=REFUSED, reason=one.refused or before.refused[number]))
                continue
            own = [image for image in compared if _concerns(image.image, one, each.frame, len(before.planned.passes))]
            told = why or (NOTHING_TO_COMPARE if after is not None and pixels_equal(own) is None else "")
            notes = (*verdict.notes, *([told] if told else ()), *deviating.get(number, ()))
            verdict = verdict._replace(images=tuple(own), pixels_equal=pixels_equal(own), notes=notes)
            fixed_number = after.number(one.name) if after is not None else None
            fixed = after.run.passes.get(fixed_number) if after is not None and fixed_number is not None else None
            errors = any(found.severity == "error" for found in _findings(each, one))
            verdict = settled(verdict, before.run.passes.get(number), fixed, errors)
            verdicts.append(verdict._replace(pictures=tuple(pictures) if number == len(before.planned.passes) - 1 else ()))
        return verdicts

    def version(self, frame: Frame, file: str) -> Version:
        """A frame planned, let through the gate, and run."""
        planned = self.planner.plan(frame, file, self.terms.size, self.terms.samples)
        refused = self.planner.gate(planned, self.device) if self.terms.gate else {}
        going = [n for n, each in enumerate(planned.passes) if not each.refused and n not in refused]
        if not going:
            return Version(planned, refused, FrameRun({}), {})
        folder = self.session.folder("pixels")
        want = {"pixels": folder, "repeats": 0, "warmups": 0, "size": None, "samples_of": None}
        try:
            run = self.session.run(planned.data, going, want)
            return Version(planned, refused, run, dict(_raw(run.images, folder)))
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def compared(self, each: Input, before: Version, after: Version | None) -> tuple[list[Compared], str]:
        """The images of both versions compared, or why they cannot be."""
        if after is None or not before.run.passes:
            return [], ""
        if not before.run.whole or not after.run.whole or before.run.failed or after.run.failed:
            reason = before.run.failed or after.run.failed or "not every pass went through"
            return [], f"the pictures are not compared: {reason}"
        if any(ran.created is False for version in (before, after) for ran in version.run.passes.values()):
            return [], "the pictures are not compared: a pass could not be created"
        if len(before.run.passes) != len(after.run.passes):
            return [], "the pictures are not compared: the device does not support the same passes of both versions"
        ways, others = _resolved(each.frame), _resolved(each.fixed) if each.fixed is not None else {}
        moved = {name for name, how in ways.items() if others.get(name, how) != how}
        why = "an average is rounded as each way of resolving does it"
        return compare(before.images, after.images, dict.fromkeys(moved, (1, why))), ""

    def pictures(self, each: Input, before: Version, after: Version | None, compared: Sequence[Compared]) -> list[str]:
        if self.album is None:
            return []
        from .png import show

        paths = []
        first = {image.image: image.first for image in compared}
        stem = (each.file, *([str(each.number)] if each.many > 1 else ()))
        for name, raw in sorted(before.images.items()):
            texels = read(raw)
            other = after.images.get(name) if after is not None else None
            if texels is not None and texels.planes:
                paths += show(self.album, (*stem, name), texels, read(other) if other is not None else None, first.get(name))
        return paths

    def said(self, each: Input, before: Version) -> Mapping[int, Sequence[Said]]:
        """How the layer and we agree, by pass."""
        layer, run = self.session.layer, before.run
        if layer is None or not run.passes:
            return {}
        messages = [*run.messages, *(message for ran in run.passes.values() for message in ran.messages)]
        told = Told(list(run.passes), messages, layer, self.session.vendors, self.device, self.about.name)
        return self.planner.rows(each, before.planned, told)

    def verdict(self, each: Input, before: Version, number: int) -> Verdict:
        """What is known of a pass before it is judged."""
        one = before.planned.passes[number]
        ran = before.run.passes.get(number)
        notes = list(before.planned.defaults) if number == 0 else []
        if ran is not None and ran.dropped:
            notes.append(f"{ran.dropped} more messages of the layer are left out")
        codes = tuple(dict.fromkeys(found.code for found in _findings(each, one)))
        return Verdict(each.file, one.name, each.prefix + one.path, "", findings=codes, notes=tuple(notes))


def _findings(each: Input, one: PlannedPass) -> list[Finding]:
    """All that is found of a pass, silenced or not."""
    own = next((p for p in each.frame.passes if p.name == one.name), None)
    findings = [*each.findings, *each.silenced]
    return of_pass(each.frame, own, findings) if own is not None else findings


def _concerns(image: str, one: PlannedPass, frame: Frame, passes: int) -> bool:
    """Whether an image is told of with a pass: one that it renders or resolves to; what no pass does is told with each."""
    owners = [each.name for each in frame.passes if _draws(each, image)]
    return passes == 1 or not owners or one.name in owners


def _draws(each: Any, image: str) -> bool:
    targets = {target.name for attachment in each.attachments for target in attachment.targets}
    targets.update(r.target_image.name for subpass in each.subpasses for r in subpass.resolves if r.target_image is not None)
    return image.partition(":")[0] in targets


def _resolved(frame: Frame) -> dict[str, set[str]]:
    """By image that is averaged to: in which ways, in a pass or by a command."""
    found: dict[str, set[str]] = {}
    resolves = [resolve for each in frame.passes for subpass in each.subpasses for resolve in subpass.resolves]
    for resolve in (*resolves, *(resolve for _, resolve in frame.resolve_commands)):
        if resolve.target_image is not None and resolve.mode == "AVERAGE":
            found.setdefault(resolve.target_image.name, set()).add("command" if resolve.kind == "command" else "pass")
    return found


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


def _model(each: Input) -> dict[str, dict[str, Any]]:
    """What the cost model says of passes, as written and fixed, by their names."""
    from msaa_lint.frame.cost.model import frame_cost

    frames = [frame for frame in (each.frame, each.fixed) if frame is not None]
    written, *fixed = ({cost.name: cost.amount._asdict() for cost in frame_cost(frame, each.device).passes} for frame in frames)
    return {name: {"as_written": amount, "fixed": fixed[0].get(name) if fixed else None} for name, amount in written.items()}


def _tiler(device: About) -> bool | None:
    """Whether a device renders by tiles, as its vendor's do."""
    from msaa_lint.frame.devices.vendors import TILERS, vendor_of

    vendor = vendor_of(device.vendor_id)
    return True if vendor in TILERS else False if vendor in IMMEDIATE else None


IMMEDIATE = ("amd", "intel", "nvidia")
"""Vendors whose GPUs keep the samples of a pass in memory."""
