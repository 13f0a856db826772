"""What fragment shaders say: facts of pipelines from their modules, and the images that shaders
read.
"""

from collections.abc import Callable, Iterator
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.frame.description.models import Draw, Pipeline, ReadImage, ShaderStage, Subpass

from .facts import Facts, Subject
from .frame import Frame
from .parts import RENDER_PASS, Attachment, Pass, PassSubpass, Resolve, Target
from .pipeline import discards, subpass_of
from .resolve import command_facts
from .timeline import Timeline
from .walk import Walk

if TYPE_CHECKING:
    from msaa_lint.frame.spirv.reflect import Multisampled, Reflected

Finder = Callable[[ShaderStage, bool], "Reflected | None"]
"""Finds what the module of a shader stage says; None where there is none that can be read. The
second says whether what is stored to alpha is asked for. It is asked only where a rule may need
it.
"""

ONE, ALL, OTHER = "ONE", "ALL", "OTHER"

_IN_FRAGMENTS = (None, "FRAGMENT", "FRAGMENT_SHADER", "ALL_GRAPHICS", "ALL_COMMANDS", "ALL")
"""The stages of a read that a fragment shader may do."""

_CERTAIN = ("SampleId", "SamplePosition")
"""What makes a shader run for every sample; inputs decorated Sample may."""


_SAMPLE_RATE = frozenset({35, 52})
"""The capabilities SampleRateShading and InterpolationFunction, which need the feature
sampleRateShading (vk.xml, spirvcapabilities).
"""


def fragment_stage(pipeline: Pipeline) -> ShaderStage | None:
    """The fragment shader of a pipeline, where its module is stated; None where rasterization is
    disabled.
    """
    if discards(pipeline):
        return None
    return next(
        (
            stage
            for stage in pipeline.stages
            if stage.stage == "FRAGMENT" and stage.module is not None
        ),
        None,
    )


class Read(NamedTuple):
    """A fragment shader's read of a multisampled image: the pipeline, its stage, and what its
    module says of the image.
    """

    pipeline: Pipeline
    stage: ShaderStage
    image: "Multisampled"


class _Part(NamedTuple):
    """A subpass or rendering as it is recorded: the pass and where it begins, the reads and the
    pipelines in it (None: not stated).
    """

    render_pass: Pass | None
    begun: int
    reads: list[tuple[int, ReadImage]]
    drawn: dict[str | None, None]


class _Fetching(NamedTuple):
    """The shaders that are known to do a read, and whether those are all that may."""

    reads: list[Read]
    whole: bool


MAX_PAIRS = 20_000
"""Reads times shaders that are looked at in a subpass; of more it is not known which shader reads
which image.
"""


class Shaders:
    """The fragment shaders of a frame's pipelines, and the images that they read."""

    def __init__(self, timeline: Timeline, find: Finder | None) -> None:
        self.frame: Frame = timeline.frame
        self.timeline = timeline
        self._find = find
        self._found: dict[str, Reflected | None] = {}
        self._reads: list[tuple[int, ReadImage, Target, _Part]] = []
        """Where sample counts matter: position, parameters, image, what is around it."""
        self._reading: set[str | None] = set()
        """Pipelines that draw where such a read is."""
        self._fetches: dict[int, _Fetching] = {}
        self._reads_of: dict[str, list[tuple[ReadImage, _Part]]] = {}
        for part in _parts(timeline.walk):
            taken = [
                (at, body, target)
                for at, body in part.reads
                if (target := self.frame.target(body.image)) and _matters(body, target)
            ]
            self._reads += [(at, body, target, part) for at, body, target in taken]
            for _, body, target in taken:
                self._reads_of.setdefault(target.name, []).append((body, part))
            if taken:
                self._reading.update(part.drawn)

    def of(self, pipeline: Pipeline) -> "Reflected | None":
        """What a pipeline's fragment shader says; None where that is not known, or nothing can need
        it.
        """
        if pipeline.key not in self._found:
            stage = fragment_stage(pipeline) if self._find is not None else None
            state = pipeline.multisampleState
            one = (
                state is not None
                and state.rasterizationSamples == 1
                and "RASTERIZATION_SAMPLES_EXT" not in pipeline.dynamicState
            )
            dynamic = "ALPHA_TO_COVERAGE_ENABLE_EXT" in pipeline.dynamicState
            covers = state is not None and state.alphaToCoverageEnable is True and not dynamic
            render_pass = self.frame.render_pass(pipeline.renderPass)
            features = (
                self.frame.description.enabled.features
                if self.frame.description.enabled is not None
                else None
            )
            missing = features is not None and "sampleRateShading" not in features
            inputs = render_pass is not None and self._has_inputs(render_pass)
            needed = not one or covers or missing or inputs or pipeline.key in self._reading
            found = (
                self._find(stage, covers)
                if self._find is not None and stage is not None and needed
                else None
            )
            self._found[pipeline.key] = (
                found if found is not None and found.stage == "FRAGMENT" else None
            )
        return self._found[pipeline.key]

    # Pipelines

    def put(self, facts: Facts, pipeline: Pipeline) -> None:
        """Adds what a pipeline's fragment shader says to the pipeline's facts."""
        found = self.of(pipeline)
        stage = fragment_stage(pipeline)
        at = stage.place("module") if stage is not None else None
        reads: list[str] = []
        certain = False
        if found is not None and stage is not None:
            facts.put("pipeline.module", stage.module, at)
            reads = [name for name in _CERTAIN if name in found.built_ins]
            certain = bool(reads)
            reads += [_input(location) for location in found.sample_inputs]
            facts.put("pipeline.alpha_output", found.alpha.declared, at)
            facts.put("pipeline.alpha_written", found.alpha.written, at)
            facts.put("pipeline.alpha_constant", found.alpha.constant, at)
        declared = found is not None and not _SAMPLE_RATE.isdisjoint(found.capabilities)
        facts.put("pipeline.sample_rate_capability", declared, at if declared else None)
        facts.put("pipeline.per_sample_reads", reads, at)
        facts.put("pipeline.shaded_per_sample", certain, at)
        samples, runs = (
            facts.values.get("pipeline.rasterization_samples"),
            facts.values.get("pipeline.shaded_samples"),
        )
        several = isinstance(samples, int) and samples > 1
        asked = facts.values.get("pipeline.sample_shading") is True and (
            not isinstance(runs, int) or runs > 1
        )
        facts.put("pipeline.sample_shading_implied", bool(reads) and several and not asked, at)

    # Reads

    def averaged(self, facts: Facts, target: Target) -> None:
        """Says of an image that a shader averages its samples, where its readers do not state
        it.
        """
        if facts.values.get("image.averaged_by_reader") is True or target.image is None:
            return
        for body, part in self._reads_of.get(target.name, ()):
            if body.resolves is None:
                read = next(
                    (
                        each
                        for each in self._fetching(body, part).reads
                        if each.image.resolves == "AVERAGE"
                    ),
                    None,
                )
                if read is not None:
                    facts.put("image.averaged_by_reader", True, read.stage.place("module"))
                    return

    def reads(self, around: Facts) -> Iterator[Subject]:
        """The reads where sample counts matter, each with every shader that is known to do it."""
        for position, body, target, part in self._reads:
            command = self.frame.commands[position]
            shared = self._stated(position, body, target, part)
            fetching = self._fetching(body, part)
            if body.resolves is None and fetching.reads:
                _resolved(shared, body, fetching)
            for read in fetching.reads or (None,):
                facts = Facts(around, shared)
                if read is not None:
                    _fetched(facts, read)
                yield Subject(
                    "read", command.path, command.head, facts, image=target, position=position
                )
        for pipeline, render_pass in self.frame.pipelines:
            if render_pass is not None and self._has_inputs(render_pass):
                yield from self._input_reads(around, pipeline, render_pass)

    @cached_property
    def _read_at(self) -> dict[int, tuple[ReadImage, Target, _Part]]:
        return {position: (body, target, part) for position, body, target, part in self._reads}

    def fetched(self, position: int) -> tuple[str | None, str | None]:
        """What `read.samples` and `read.resolves` say of the read at a position; None for what is
        not known.
        """
        if position not in self._read_at:
            return None, None
        body, target, part = self._read_at[position]
        facts = self._stated(position, body, target, part)
        fetching = self._fetching(body, part)
        if body.resolves is None and fetching.reads:
            _resolved(facts, body, fetching)
        samples, resolves = facts.values.get("read.samples"), facts.values.get("read.resolves")
        return (str(samples) if samples is not None else None), (
            str(resolves) if resolves is not None else None
        )

    def _stated(self, position: int, body: ReadImage, target: Target, part: _Part) -> Facts:
        """What the commands say of a read."""
        facts = Facts()
        facts.put("read.image", target.title, body.place("image"))
        facts.put("read.image_samples", target.samples, target.record.place("samples"))
        if target.format is not None:
            facts.put("read.is_color", "color" in target.format.aspects)
            facts.put("read.numeric", target.format.numeric or None)
        facts.put(
            "read.alone",
            not self.frame.passes and target.format is None and target.samples != 1,
            body.place("image"),
        )
        facts.put("read.resolves", body.resolves, body.place("resolves", "samples", "image"))
        several = body.samples == ALL or body.resolves is not None
        facts.put(
            "read.samples",
            ALL if several else ONE if body.samples == 1 else None,
            body.place("samples", "resolves", "image"),
        )
        on_tile = part.render_pass is not None and bool(
            self.timeline.drawn_by(target, (part.begun, part.render_pass))
        )
        facts.put("read.on_tile", on_tile)
        # As of a vkCmdResolveImage in its place.
        resolve, found = Resolve("command", "color", body, body.path), Facts()
        resolve.source_image = target
        command_facts(found, resolve, position, self.timeline)
        facts.put(
            "read.writer", found.values.get("resolve.writer"), found.places.get("resolve.writer")
        )
        facts.put(
            "read.pass_could_resolve",
            False if on_tile else found.values.get("resolve.pass_could_resolve"),
        )
        return facts

    def _fetching(self, body: ReadImage, part: _Part) -> _Fetching:
        """The shaders that are known to do a read."""
        if body.stage not in _IN_FRAGMENTS:
            return _Fetching([], False)
        if id(part) not in self._fetches:
            self._fetches[id(part)] = self._fetching_in(part)
        return self._fetches[id(part)]

    def _fetching_in(self, part: _Part) -> _Fetching:
        """The shaders that draw in a subpass and fetch as many multisampled images as are read
        there; of several, those that fetch all alike.
        """
        bodies = [
            body
            for _, body in part.reads
            if body.stage in _IN_FRAGMENTS and self._several(body.image)
        ]
        images = {body.image for body in bodies}
        found: list[Read] = []
        whole = True
        if not images or len(bodies) * len(part.drawn) > MAX_PAIRS:
            return _Fetching([], False)
        for name in part.drawn:
            pipeline = self.frame.description.pipelines.get(name) if name is not None else None
            reflected = self.of(pipeline) if pipeline is not None else None
            stage = fragment_stage(pipeline) if pipeline is not None else None
            if pipeline is None or reflected is None or stage is None:
                whole = whole and pipeline is not None and discards(pipeline)
                continue
            own = _fetched_images(
                reflected, part.render_pass is not None and part.render_pass.kind == RENDER_PASS
            )
            if (
                own is not None
                and len(own) == len(images)
                and len({image[1:] for image in own}) == 1
            ):
                found.append(Read(pipeline, stage, own[0]))
            elif own is None or own:
                whole = False
        return _Fetching(found, whole)

    def _several(self, name: str | None) -> bool:
        target = self.frame.target(name)
        return target is not None and target.samples != 1

    def _input_reads(
        self, around: Facts, pipeline: Pipeline, render_pass: Pass
    ) -> Iterator[Subject]:
        """The reads of multisampled input attachments by a render pass's pipeline."""
        subpass, stage, found = (
            subpass_of(pipeline, render_pass),
            fragment_stage(pipeline),
            self.of(pipeline),
        )
        if subpass is None or stage is None or found is None:
            return
        for image in found.images:
            attachment = _input_attachment(subpass, image.image.input_attachment)
            if attachment is not None:
                facts = Facts(around)
                facts.put("read.image", attachment.title, attachment.record.head)
                facts.put(
                    "read.image_samples",
                    attachment.samples,
                    attachment.record.place("samples", "image"),
                )
                facts.put("read.on_tile", True)
                facts.put("read.alone", False)
                facts.put("read.pass_could_resolve", False)
                facts.put("read.resolves", image.resolves or OTHER, stage.place("module"))
                facts.put("read.samples", _takes(image, attachment.samples), stage.place("module"))
                _fetched(facts, Read(pipeline, stage, image))
                yield Subject("read", stage.path, stage.head, facts, pipeline=pipeline)

    def _has_inputs(self, render_pass: Pass) -> bool:
        """Whether a pass has input attachments of several samples, or of an unknown count."""
        return render_pass.kind == RENDER_PASS and any(
            attachment.input and attachment.samples != 1 for attachment in render_pass.attachments
        )


def _parts(walk: Walk) -> Iterator[_Part]:
    part = _Part(None, 0, [], {})
    for step in walk.steps:
        body = step.command.body
        if step.begins or step.ends or step.command.kind == "nextSubpass":
            yield part
            run = step.run if not step.ends else None
            part = _Part(
                run.render_pass if run is not None else None,
                run.position or 0 if run is not None else 0,
                [],
                {},
            )
        elif isinstance(body, ReadImage) and body.image is not None:
            part.reads.append((step.position, body))
        elif isinstance(body, Draw):
            part.drawn[body.pipeline] = None
    yield part


def _matters(body: ReadImage, target: Target) -> bool:
    """Whether sample counts matter to a read: the image may have several, or the read is stated to
    fetch several.
    """
    return target.samples != 1 or body.samples == ALL or body.resolves is not None


def _input_attachment(subpass: PassSubpass, index: int | None) -> Attachment | None:
    """The input attachment of an index, where it may have several samples."""
    record = subpass.record
    stated = record.inputAttachments if isinstance(record, Subpass) else ()
    if index is None or index >= len(stated):
        return None
    name = stated[index].attachment
    found = (
        each
        for each in subpass.render_pass.attachments
        if name in ((each.name, each.index) if name is not None else ())
    )
    return next((each for each in found if each.samples != 1), None)


def _fetched_images(found: "Reflected", in_render_pass: bool) -> "list[Multisampled] | None":
    """The multisampled images that a shader fetches from; None where it may be others. Input
    attachments of a render pass are its own, whatever else is read.
    """
    if found.fetching and (
        not found.followed or any(set(fetch.image) == {None} for fetch in found.fetches)
    ):
        return None
    return [
        image
        for image in found.images
        if image.image.input_attachment is None or not in_render_pass
    ]


def _resolved(facts: Facts, body: ReadImage, fetching: _Fetching) -> None:
    """What becomes of the samples where only shaders say it: what each of them does, if those are
    all that may read the image.
    """
    does = {read.image.resolves or OTHER for read in fetching.reads}
    takes = {_takes(read.image, facts.values.get("read.image_samples")) for read in fetching.reads}
    at = body.place("image")
    facts.put("read.samples", takes.pop() if len(takes) == 1 else OTHER, at)
    if len(does) > 1 or OTHER in does:
        facts.put("read.resolves", OTHER, at)
    elif fetching.whole:
        facts.put("read.resolves", does.pop(), at)


def _input(location: int | None) -> str:
    return (
        "an input decorated `sample`"
        if location is None
        else f"the `sample` input at location {location}"
    )


def _takes(image: "Multisampled", samples: object) -> str | None:
    """Which samples a shader fetches of an image with a count."""
    if image.queried:
        return ALL
    if image.samples is None or not isinstance(samples, int):
        return None
    if image.samples == (0,):
        return ONE
    return ALL if image.total == samples else OTHER


def _fetched(facts: Facts, read: Read) -> None:
    """What a shader says of the samples that it fetches, at its constants."""
    stage, image = read.stage, read.image
    at = stage.place("specialization", "module")
    facts.put("read.pipeline", read.pipeline.key, stage.place("module"))
    facts.put("read.module", stage.module, stage.place("module"))
    # What hangs on a condition may hang on the image's count.
    always = image.always == image.samples
    facts.put("read.fetched_samples", image.total, at)
    facts.put("read.highest_sample", image.always[-1] if image.always else None, at)
    facts.put(
        "read.as_all",
        always
        and image.total is not None
        and image.total > 1
        and (image.looped or image.resolves != OTHER),
    )
