"""Runs plans on a device in the current process. A driver may kill the process, so only `worker`
calls this.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from . import parts
from .build import FrameObjects
from .devices import devices
from .draw import Recorder
from .opening import Emit, Session
from .parts import (
    SAMPLED,
    SUSPENDING,
    TRANSFER_SOURCE,
    TRANSFER_TARGET,
    TRANSIENT,
    Plan,
    Step,
    from_json,
)
from .readback import bring_back, bring_samples
from .resample import pictured, resized
from .submit import Submitter
from .vulkan_errors import VulkanError


class RunOptions(NamedTuple):
    """The options of a run. `pixels` is a folder to write images to. With `repeats`, passes are
    timed after `warmups` at the described size; otherwise pictures of at most 512x512 texels are
    drawn. `size` overrides the size. `samples_of` is an image whose samples are written one by
    one.
    """

    pixels: str | None = None
    repeats: int = 0
    warmups: int = 0
    size: Sequence[int] | None = None
    samples_of: str | None = None


def run(
    session: Session, plan: Plan, passes: Sequence[int] | None, want: RunOptions, emit: Emit
) -> None:
    """Creates and draws passes of a plan (None: all that can be) in the frame's order, and reports
    events.

    The events are `pass` before a pass is touched, `created`, `message` for those of the layer,
    `pixels` and `sample` for files, `time`, and finally `done`. A pass that the driver fails to
    create is skipped; a lost device ends the run. Unusable and programming errors are raised.
    """
    plan = _sized(plan, want)
    asked = range(len(plan.passes)) if passes is None else passes
    going = [
        n
        for n in asked
        if 0 <= n < len(plan.passes) and not (plan.passes[n].refused or plan.passes[n].failed)
    ]
    session.at = None
    session.telling(emit)
    opened = session.opened(plan)
    sampled = next(
        (n for n, image in enumerate(plan.images) if image.name == want.samples_of), None
    )
    if sampled is not None:
        images = list(plan.images)
        images[sampled] = images[sampled]._replace(
            usage=(images[sampled].usage | SAMPLED) & ~TRANSIENT
        )
        plan = plan._replace(images=tuple(images))
    built = FrameObjects(opened, plan)
    submitter: Submitter | None = None
    at = -1
    made: list[int] = []
    try:
        for at in going:
            emit({"event": "pass", "pass": at})
            session.at = at
            try:
                built.create_pass(at)
            except VulkanError as error:
                emit({"event": "created", "pass": at, "ok": False, "error": error.name})
                continue
            made.append(at)
            emit({"event": "created", "pass": at, "ok": True, "error": ""})
        submitter = Submitter(opened, want.repeats > 0)
        # Twice with the layer, so that it sees the transition from one frame to the next.
        for turn in range(
            want.warmups + want.repeats if want.repeats else 2 if session.layer is not None else 0
        ):
            recorder = Recorder(built)
            times: dict[int, float] = {}
            for at, steps in segments(plan, made):
                session.at = at
                if turn == 0:
                    emit({"event": "pass", "pass": at})
                times[at] = times.get(at, 0.0) + _drawn(recorder, submitter, steps)
            if want.repeats and turn >= want.warmups:
                for number, time in times.items():
                    emit(
                        {
                            "event": "time",
                            "pass": number,
                            "ms": round(time, 6),
                            "source": submitter.source,
                        }
                    )
        if want.pixels is not None and not want.repeats:
            # The layer has seen the frame as it is described: not with what follows.
            submitter.close()
            submitter = None
            built.close()
            with session.unheard():
                built = FrameObjects(opened, plan, _more_usage(plan))
                for at in made:
                    built.create_pass(at)
                submitter = Submitter(opened)
                # Samples are read back as they were drawn, whether or not the pass stores them.
                recorder = Recorder(built, poisons=sampled is None)
                for at, steps in segments(plan, made):
                    emit({"event": "pass", "pass": at})
                    _drawn(recorder, submitter, steps)
                bring_back(recorder, submitter, want.pixels, emit)
                if sampled is not None and sampled in built.images:
                    bring_samples(recorder, submitter, sampled, want.pixels, emit)
    except VulkanError as error:
        if at < 0:
            raise
        emit({"event": "created", "pass": at, "ok": False, "error": error.name})
    finally:
        session.at = None
        if submitter is not None:
            submitter.close()
        built.close()
    emit({"event": "done"})


def _sized(plan: Plan, want: RunOptions) -> Plan:
    if want.size is not None:
        return resized(plan, (want.size[0], want.size[1]))
    return plan if want.repeats else pictured(plan)


def _more_usage(plan: Plan) -> dict[int, int]:
    """The additional usage for overwriting images and reading them back, by image."""
    kept = {n: image for n, image in enumerate(plan.images) if not image.usage & TRANSIENT}
    return {
        n: TRANSFER_TARGET | (TRANSFER_SOURCE if image.samples == 1 and image.type == 1 else 0)
        for n, image in kept.items()
    }


def segments(plan: Plan, made: Sequence[int]) -> Iterator[tuple[int, list[Step]]]:
    """The steps of the created passes in groups that are submitted together: a pass with the
    commands after it.
    """
    group: list[Step] = []
    there = set(made)
    images = {image for number in made for image in plan.passes[number].images}
    for step in plan.steps:
        if step.number not in there or not {step.source, step.target} - {parts.NONE} <= images:
            continue
        suspended = (
            bool(group)
            and group[-1].kind == "begin"
            and plan.passes[group[-1].number].flags & SUSPENDING
        )
        if (
            step.kind == "begin"
            and group
            and not suspended
            and any(each.kind == "begin" for each in group)
        ):
            yield group[0].number, group
            group = []
        group.append(step)
    if group:
        yield group[0].number, group


def _drawn(recorder: Recorder, submitter: Submitter, steps: Sequence[Step]) -> float:
    buffer = submitter.begin()
    recorder.layouts.fence(buffer)
    submitter.start()
    for step in steps:
        recorder.step(buffer, step)
    submitter.stop()
    return submitter.end(timed=True)


__all__ = ["RunOptions", "Session", "devices", "from_json", "run", "segments"]
