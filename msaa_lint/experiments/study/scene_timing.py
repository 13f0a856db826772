"""The time that a device takes to draw the triangles of one scene."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from hashlib import sha256
from types import TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple

from msaa_lint.linter.study_record import AS_DESCRIBED

from .points import MSAA, SAMPLE_SHADING, SSAA, Technique
from .shading import NONE, Shading
from .technique_frames import frame_of
from .time_model import Terms
from .times import Cost, CostModel, Costs, DeviceClock

if TYPE_CHECKING:
    from typing import Self

    import numpy as np
    from numpy.typing import NDArray

    from .frame_plans import FramePlans

MAX_TRIANGLES = 4_000_000
"""The most triangles of a picture: 144 MB of vertices."""


class TechniquePlans(NamedTuple):
    """The plans (confirm/parts.py) of a technique: `whole`, the frame; `bare`, the same without its
    resolve, None where it has none. `reason` says why there are none.
    """

    whole: Any = None
    bare: Any = None
    reason: str = ""


class Geometry(NamedTuple):
    """How a scene is drawn: `overdraw` times, with triangles whose sides are at most
    `triangle_size` pixels long (0: as they are).
    """

    overdraw: int = 1
    triangle_size: float = 0.0


class SceneClock:
    """A device's clock for the triangles of a scene, or for the plans of a frame: `with
    SceneClock(clock, scene, model) as source:`.

    `content` identifies what is drawn. `plans` are those of a frame, whose draws of an unknown
    number of vertices draw the scene, and `stages` the shader stages (confirm/parts.py) that draw
    instead of the built-in ones, of the cost of shading with the name `own`.
    """

    def __init__(
        self,
        clock: DeviceClock,
        scene: Any,
        model: CostModel,
        geometry: Geometry | None = None,
        plans: FramePlans | None = None,
        stages: tuple[Any, ...] = (),
        own: str = "",
    ) -> None:
        self.clock, self.model, self.name = clock, model, clock.name
        self.stages, self.own = stages, own
        self._triangles, self._overdraw = (
            drawn_triangles(scene, geometry or Geometry()),
            (geometry or Geometry()).overdraw,
        )
        self._vertices = clip(self._triangles, scene.width, scene.height).tobytes() * self._overdraw
        self._plans = plans
        self.content = sha256(
            self._vertices + repr((stages, own, plans.base if plans is not None else None)).encode()
        ).hexdigest()[:16]
        self._folder = ""

    def __enter__(self) -> Self:
        self._folder = self.clock.session.folder("timed")
        with open(self._path, "xb") as file:
            file.write(self._vertices)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        value: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        shutil.rmtree(self._folder, ignore_errors=True)

    @property
    def _path(self) -> str:
        return os.path.join(self._folder, self.content)

    def costs(
        self, techniques: Sequence[Technique], shadings: Sequence[Shading], size: tuple[int, int]
    ) -> Costs:
        """The device's times of all techniques, measured in turn, and the model's bytes."""
        plans = {technique: self._supported(technique, size) for technique in techniques}
        # Without shading in any case, as the parts of a time are relative to it.
        none = Shading(NONE)
        works = [
            none,
            *(
                shading
                for shading in shadings
                if shading.name not in (NONE, AS_DESCRIBED, self.own)
            ),
        ]
        items: dict[tuple[Technique, str], tuple[Any, Sequence[Shading]]] = {}
        for technique, each in plans.items():
            if each.reason:
                continue
            items[technique, _WHOLE] = each.whole, works
            if each.bare is not None:
                items[technique, _BARE] = each.bare, [none]
            if self.stages:
                items[technique, _OWN] = own_shaders(each.whole, self.stages), [none]
        timed = dict(zip(items, self.clock.time(list(items.values())).items, strict=True))
        costs: dict[tuple[Technique, str], Cost] = {}
        passes = self._plans.passes if self._plans is not None else None
        # llvmpipe counts the lanes of the blocks of pixels that it shades, covered or not: 25,248
        # for the 9,352 of `edge-fan` at 320x180.
        counts = {
            technique: timed[technique, _BARE if each.bare is not None else _WHOLE].invocations(
                passes
            )
            for technique, each in plans.items()
            if not each.reason and not self.clock.software
        }
        for technique, each in plans.items():
            model = self.model.of(technique, *size)
            if not each.reason:
                model = self._with_terms(model, technique, each.whole, size, counts)
            for shading in shadings:
                cost = model._replace(reason=each.reason)
                if not each.reason:
                    whole, bare = timed[technique, _WHOLE], timed.get((technique, _BARE))
                    own = timed.get((technique, _OWN)) if shading.name == self.own else None
                    cost = _cost(model, whole, bare, own or whole, _place(works, shading))
                    cost = cost._replace(invocations=None) if self.clock.software else cost
                costs[technique, shading.name] = cost
        return costs

    def _with_terms(
        self,
        cost: Cost,
        technique: Technique,
        plan: Any,
        size: tuple[int, int],
        counts: Mapping[Technique, int | None],
    ) -> Cost:
        """The cost with what its time depends on. What frames draw is not known by pixel: theirs
        follow from the counts of the device.
        """
        written, resolved = plan_gigabytes(plan)
        if self._plans is None:
            from .invocations import count

            found = count(self._triangles, size, technique)
            terms = Terms(written, resolved, *(self._overdraw * number / 1e6 for number in found))
            return cost._replace(
                expected_invocations=self._overdraw * found.total, terms=tuple(terms)
            )
        drawn = drawn_by_frame(technique, counts)
        return cost._replace(terms=tuple(Terms(written, resolved, *drawn))) if drawn else cost

    def _supported(self, technique: Technique, size: tuple[int, int]) -> TechniquePlans:
        """The plans of a technique, with the reason why the device cannot run them, if any."""
        from msaa_lint.experiments.confirm import gate

        if self._plans is not None:
            return self._frame_plans(self._plans, technique)
        plans = self._scene_plans(technique, size)
        return plans._replace(
            reason=next(iter(gate.gate(plans.whole, self.clock.device).values()), "")
        )

    def _frame_plans(self, plans: FramePlans, technique: Technique) -> TechniquePlans:
        """The plans of a frame, without the passes that the device cannot run, unless the technique
        is about them.
        """
        from msaa_lint.experiments.confirm import gate

        found = plans.of(technique)
        refused = gate.gate(found.plan, self.clock.device) if not found.reason else {}
        reason = found.reason or next(
            (text for number, text in refused.items() if number in plans.passes), ""
        )

        def drawn(plan: Any) -> Any:
            passes = (
                each._replace(refused=refused.get(number, each.refused))
                for number, each in enumerate(plan.passes)
            )
            return plan._replace(passes=tuple(passes), vertices=self._path)

        return TechniquePlans(
            drawn(found.plan), drawn(found.bare) if found.bare is not None else None, reason
        )

    def _scene_plans(self, technique: Technique, size: tuple[int, int]) -> TechniquePlans:
        from msaa_lint.experiments.confirm import plan

        from .plan_samples import unresolved

        frame = frame_of(technique, *size, hdr=self.model.hdr, depth=self.model.depth)
        whole = shaded(plan.plan(frame)._replace(vertices=self._path))
        return TechniquePlans(whole, unresolved(whole, range(len(whole.passes))))


_WHOLE, _BARE, _OWN = "whole", "bare", "own"


def _place(works: Sequence[Shading], shading: Shading) -> int:
    return next((number for number, work in enumerate(works) if work.name == shading.name), 0)


def _cost(model: Cost, whole: Any, bare: Any, timed: Any, place: int) -> Cost:
    """The cost of a technique, where `timed` (confirm/timed.py) has its times at `place`, and
    `whole` and `bare` those without shading.
    """
    from msaa_lint.experiments.confirm.timing import timing

    for each in (timed, whole, bare):
        if each is not None and each.reason:
            return model._replace(reason=each.reason, failed=True)
    rounds = timed.times[place]
    found, none = timing(rounds), timing(whole.times[0]).median
    fill = timing(bare.times[0]).median if bare is not None else none
    # A part is never longer than the whole, or negative but for noise.
    fill = min(fill, none)
    # Some devices resolve and downscale with fragment shaders of their own.
    invocations = (bare or timed).invocations()
    return model._replace(
        time_ms=found.median, low_ms=found.low, high_ms=found.high, fill_ms=fill,
        resolve_ms=none - fill,
        shading_ms=max(found.median - none, 0.0), invocations=invocations, rounds=tuple(rounds),
    )  # fmt: skip


def shaded(plan: Any) -> Any:
    """The plan, whose built-in fragment shaders do the work of a cost of shading."""
    return _with_pipelines(
        plan, lambda pipeline: pipeline._replace(shaded=True) if not pipeline.stages else pipeline
    )


def own_shaders(plan: Any, stages: tuple[Any, ...]) -> Any:
    """The plan, whose draws with shading of a cost use shader stages instead."""
    return _with_pipelines(
        plan,
        lambda pipeline: (
            pipeline._replace(stages=stages, shaded=False) if pipeline.shaded else pipeline
        ),
    )


def _with_pipelines(plan: Any, change: Callable[[Any], Any]) -> Any:
    passes = (each._replace(pipelines=tuple(map(change, each.pipelines))) for each in plan.passes)
    return plan._replace(passes=tuple(passes))


def drawn_by_frame(
    technique: Technique, counts: Mapping[Technique, int | None]
) -> tuple[float, ...]:
    """The terms of a frame's draws from `samples_drawn` on (study/time_model.py), empty where the
    device counts nothing: `counts` are the invocations of each technique in the passes to which
    techniques apply, as the time of the others is the same under all.

    Helpers are not counted. They are as many as the edges are long, in pixels of the picture that
    is drawn; and so are the invocations that more samples add to one, which stand in for them: the
    model has a coefficient of its own for them.
    """
    whole, single = counts.get(technique), counts.get(Technique(MSAA, 1))
    if whole is None:
        return ()
    one = counts.get(Technique(MSAA, technique.samples))
    fragments = whole if technique.kind != SAMPLE_SHADING or one is None else min(one, whole)
    # With sample shading, an invocation for each sample that is drawn.
    every = counts.get(Technique(SAMPLE_SHADING, technique.samples, 1.0))
    drawn = (
        whole
        if technique.kind == SSAA
        else every
        if every is not None
        else fragments * technique.samples
    )
    edges = (
        max((count for each, count in counts.items() if each.kind == MSAA and count), default=0)
        - (single or 0)
        if single
        else 0
    )
    helpers = (
        edges * technique.grid,
        edges * (technique.shaded - 1) if technique.kind == SAMPLE_SHADING else 0,
    )
    return tuple(
        number / 1e6 for number in (drawn, fragments, helpers[0], whole - fragments, helpers[1])
    )


def plan_gigabytes(plan: Any) -> tuple[float, float]:
    """The gigabytes (10^9) of samples in the attachments that a plan renders to, and of pixels that
    it resolves or blits.
    """
    from msaa_lint.experiments.confirm import parts

    written: list[int] = []
    resolved: list[int] = []
    for step in plan.steps:
        if step.kind in ("resolve", "blit"):
            resolved.append(step.target)
        elif step.kind == "begin" and plan.passes[step.number].kind == parts.RENDERING:
            rendered = [
                target for target in plan.passes[step.number].rendered if target.image != parts.NONE
            ]
            written += [target.image for target in rendered]
            resolved += [
                target.resolve_image for target in rendered if target.resolve_image != parts.NONE
            ]
        elif step.kind == "begin":
            frame_pass = plan.passes[step.number]
            images = (
                frame_pass.framebuffers[step.framebuffer].images if frame_pass.framebuffers else ()
            )
            targets = [
                images[r.attachment]
                for each in frame_pass.subpasses
                for r in each.resolves
                if r.attachment != parts.NONE
            ]
            resolved += targets
            written += [image for image in images if image not in targets]
    sizes = [
        image.width * image.height * image.layers * image.bytes * image.samples
        for image in plan.images
    ]
    return sum(sizes[number] for number in written) / 1e9, sum(
        sizes[number] for number in resolved
    ) / 1e9


def drawn_triangles(scene: Any, geometry: Geometry) -> NDArray[np.float64]:
    """The triangles of a scene (T, 3, 2) that are drawn, in pixels. ValueError for more than
    MAX_TRIANGLES.
    """
    triangles: NDArray[np.float64] = (
        divided(scene.triangles, geometry.triangle_size)
        if geometry.triangle_size
        else scene.triangles
    )
    if len(triangles) * geometry.overdraw > MAX_TRIANGLES:
        raise ValueError(
            f"{len(triangles):,} triangles drawn {geometry.overdraw} times are more than "
            f"{MAX_TRIANGLES:,}"
        )
    return triangles


def divided(triangles: NDArray[np.float64], size: float) -> NDArray[np.float64]:
    """The triangles (T, 3, 2), each divided into equal parts whose sides are at most `size` pixels
    long.
    """
    import numpy as np

    sides = triangles - np.roll(triangles, -1, axis=1)
    counts = np.maximum(np.ceil(np.sqrt((sides**2).sum(axis=2)).max(axis=1) / size), 1).astype(
        np.int64
    )
    if int((counts**2).sum()) > MAX_TRIANGLES:
        raise ValueError(f"triangles of {size:g} pixels would be more than {MAX_TRIANGLES:,}")
    parts = []
    for count in np.unique(counts):
        corners = triangles[counts == count]
        origin, first, second = (
            corners[:, :1],
            corners[:, 1:2] - corners[:, :1],
            corners[:, 2:] - corners[:, :1],
        )
        for i in range(count):
            for j in range(count - i):
                steps = [((i, j), (i + 1, j), (i, j + 1))]
                if i + j < count - 1:
                    steps.append(((i + 1, j), (i + 1, j + 1), (i, j + 1)))
                parts += [
                    np.concatenate(
                        [origin + (first * a + second * b) / count for a, b in shape], axis=1
                    )
                    for shape in steps
                ]
    return np.concatenate(parts) if parts else triangles


def clip(triangles: NDArray[np.float64], width: int, height: int) -> NDArray[np.float32]:
    """Corners (..., 3, 2) in pixels as x, y and depth (..., 3, 3) in clip coordinates, rounded to
    single precision.
    """
    import numpy as np

    scaled = triangles * (2.0 / np.array([width, height])) - 1.0
    depths = np.full((*triangles.shape[:-1], 1), 0.5)
    corners: NDArray[np.float32] = np.concatenate([scaled, depths], axis=-1).astype(np.float32)
    return corners
