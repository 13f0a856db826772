"""From a document to everything that rules judge in it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import SubpassDependency
from msaa_lint.frame.devices import DeviceProfile

from .attachment import (
    aspect_facts,
    attachment_facts,
    clear_value_facts,
    later_subpasses,
    pass_facts,
    resolves_at,
    single_sampled_facts,
)
from .contents import Contents
from .copy import copies
from .dependency import Barriers, external_dependencies, recorded_barriers
from .event_search import EventSearch
from .facts import Facts, Subject
from .frame import Frame
from .global_facts import global_facts, profile
from .handovers import put_handover
from .image import Bindings, image_facts
from .joined_facts import join_facts
from .lifetimes import lifetime_facts
from .parts import Aspect, Attachment, Pass, Target
from .pass_begin import max_uses, uses_at_most
from .pass_contents import (
    Instance,
    PassContents,
    pass_contents,
    put_undefined_use,
    screen_facts,
    touch_facts,
)
from .pipeline import draws_of, pipeline_facts, subpass_of, unshaded
from .readers import Readers
from .resolve import command_facts, read_in_vain, resolve_facts
from .resolve_target import ResolveTargets, other_uses
from .resolve_uses import ResolveUses
from .resumption import resumption_facts
from .sample_count_choices import choices
from .sample_readers import samples_fetched
from .shaders import Finder as ShaderFinder
from .shaders import Shaders
from .study import UNSTUDIED, Finder, Studied, put_study
from .subpass import subpass_facts
from .swapchain_rotation import Turns
from .timeline import Timeline
from .walk import Walk


def subjects(
    document: Document,
    default_device: DeviceProfile | None = None,
    study: Finder | None = None,
    shader: ShaderFinder | None = None,
) -> Iterator[Subject]:
    """The subjects of a document with their facts, in the order of the document's sections. Each
    fact is found once.

    `study` finds the record of the frame's study, `shader` what the module of a shader stage says.
    """
    return FrameAnalysis(
        Frame(document), profile(document.description, default_device), study, shader
    ).subjects()


class FrameAnalysis:
    """What is known of a frame. Each part is worked out when it is first asked for."""

    def __init__(
        self,
        frame: Frame,
        device: DeviceProfile | None = None,
        study: Finder | None = None,
        shader: ShaderFinder | None = None,
    ) -> None:
        self.frame = frame
        self.device = device
        self._study = study
        self._shader = shader

    @cached_property
    def walk(self) -> Walk:
        """The commands, and the runs of the passes."""
        return Walk(self.frame)

    @cached_property
    def timeline(self) -> Timeline:
        """What happens to every image."""
        return Timeline(self.frame, self.walk)

    @cached_property
    def readers(self) -> Readers:
        """What reads the images."""
        return Readers(self.timeline)

    @cached_property
    def contents(self) -> Contents:
        """The contents of the images over time."""
        return Contents(self.timeline)

    @cached_property
    def search(self) -> EventSearch:
        """What follows an event."""
        return EventSearch(self.timeline)

    @cached_property
    def bindings(self) -> Bindings:
        """What the images are bound to."""
        return Bindings(self.frame)

    @cached_property
    def resolve_uses(self) -> ResolveUses:
        """What becomes of the results of resolves."""
        return ResolveUses(self.search, self.readers, self.device)

    @cached_property
    def _resolve_targets(self) -> ResolveTargets:
        return ResolveTargets(self.frame, self.timeline.followed)

    @cached_property
    def shaders(self) -> Shaders:
        """What fragment shaders say."""
        return Shaders(self.timeline, self._shader)

    @cached_property
    def shared(self) -> Facts:
        """The facts that every subject has."""
        return global_facts(self.frame.description, self.device)

    @cached_property
    def _inefficient(self) -> set[int]:
        """By identity: the images with more samples than the device takes efficiently."""
        efficient = self.shared.values["device.max_efficient_samples"]
        assert isinstance(efficient, int)
        return {
            id(target)
            for target in self.frame.all_targets
            if target.samples is not None and target.samples > efficient
        }

    @cached_property
    def _studied(self) -> Studied:
        return (
            self._study(self.frame) if self._inefficient and self._study is not None else UNSTUDIED
        )

    @cached_property
    def _image_facts(self) -> dict[int, Facts]:
        """By the identity of an image's record."""
        in_vain = read_in_vain(self.readers) if self.frame.resolve_commands else set()
        facts = {
            id(target.record): self._facts_of_image(target, in_vain)
            for target in self.frame.all_targets
        }
        for names in self.turns.of.values():
            # A frame may show one of them in use.
            targets = [self.frame.targets[name] for name in names]
            used = [facts[id(target.record)] for target in targets if self._is_used(target)]
            join_facts(used, [facts[id(target.record)] for target in targets])
        return facts

    @cached_property
    def turns(self) -> Turns:
        """The multisampled images that take turns."""
        return Turns(self.frame, self.bindings)

    def _facts_of_image(self, target: Target, in_vain: set[str]) -> Facts:
        facts = image_facts(target, self.bindings, self.frame, self.readers, self.device)
        facts.put("image.read_in_vain", target.name in in_vain)
        self.turns.put(facts, target)
        self.shaders.averaged(facts, target)
        put_study(
            facts, target.samples, self._studied if id(target) in self._inefficient else UNSTUDIED
        )
        metal = self.frame.description.metal
        if self.frame.document.metal is not None and metal is not None:
            from .metal import texture_facts

            texture_facts(facts, target, metal, self.shared.values.get("device.lazy_memory"))
        return facts

    def stated_images(self) -> Iterator[tuple[str, Facts, bool]]:
        """The images of the description by name, each with its facts, which may be changed, and
        whether the frame uses it.
        """
        for name, target in self.frame.targets.items():
            yield name, self._image_facts[id(target.record)], self._is_used(target)

    def _is_used(self, target: Target) -> bool:
        """Whether the frame uses an image."""
        if not self.frame.has_commands:
            return id(target.record) in self.bindings.attachments
        return (
            id(target.record) in self.bindings.begun
            or not self.timeline.followed
            or bool(self.readers.uses(target.name))
        )

    @cached_property
    def pass_contents(self) -> PassContents:
        """What the commands record in passes."""
        return pass_contents(self.walk)

    def limits(self) -> Iterator[str]:
        """What was not looked at, since it would take more time than the length of the description
        allows.
        """
        if not self.timeline.followed:
            uses, most = uses_at_most(self.frame), max_uses(self.frame)
            yield (
                f"passes use images {uses} times, more than the limit of {most}; rules about "
                "what happens between passes are undecided"
            )
        if self.search.steps_left < 0:
            yield (
                "the uses of images follow each other at too great distances; some rules about "
                "what becomes of resolves are undecided"
            )
        if self.pass_contents.exhausted:
            yield (
                "passes record too many draws and clears for so many attachments; some rules "
                "about what these draw are undecided"
            )

    def subjects(self) -> Iterator[Subject]:
        """Every subject, in the order of the document's sections."""
        for target in self.frame.run_targets:
            yield Subject(
                "image",
                target.path,
                target.record.head,
                Facts(self.shared, self._image_facts[id(target.record)]),
                image=target,
            )
        contents = self.pass_contents
        of_subpass: dict[str, Facts] = {}
        for render_pass in self.frame.passes:
            instances = contents.get(render_pass.path, [])
            facts = Facts(self.shared, pass_facts(render_pass, self.frame))
            clear_value_facts(facts, render_pass, self.frame)
            put_handover(facts, render_pass, self.search, self.shaders.fetched)
            resumption_facts(facts, render_pass, self.walk)
            yield Subject(
                "pass", render_pass.path, render_pass.record.head, facts, render_pass=render_pass
            )
            yield from self._attachments(render_pass, facts, instances)
            yield from self._subpasses(render_pass, facts, instances, of_subpass)
            yield from self._dependencies(render_pass, facts)
        yield from self._resolve_commands()
        yield from self._pipelines(of_subpass)
        yield from self.shaders.reads(self.shared)
        yield from copies(self.frame, self.shared)
        yield from choices(self.frame.description, self.shared)

    def _attachments(
        self, render_pass: Pass, shared: Facts, instances: list[Instance]
    ) -> Iterator[Subject]:
        resolves = resolves_at(render_pass)
        subpasses_known = (
            self.frame.document.whole or bool(render_pass.subpasses)
        ) and not render_pass.unread
        # What is not read may use an attachment in a subpass.
        dependencies = later_subpasses(render_pass) if not render_pass.unread else {}
        for attachment in render_pass.attachments:
            facts = Facts(
                shared,
                self._image_of(attachment),
                attachment_facts(attachment, subpasses_known, dependencies),
            )
            single_sampled_facts(
                facts,
                render_pass,
                attachment,
                self.device,
                chained_known=self.frame.document.format != "",
            )
            record = attachment.record
            yield Subject(
                "attachment",
                record.path,
                record.head,
                facts,
                attachment=attachment,
                owner=render_pass,
            )
            for aspect in attachment.aspects:
                of_aspect = aspect_facts(
                    render_pass, attachment, aspect, resolves.get(id(attachment), []), self.readers
                )
                of_aspect = Facts(facts, of_aspect)
                self._put_aspect(of_aspect, render_pass, attachment, aspect, instances)
                yield Subject(
                    "aspect",
                    record.path,
                    record.head,
                    of_aspect,
                    attachment=attachment,
                    aspect=aspect,
                    owner=render_pass,
                )

    def _put_aspect(
        self,
        facts: Facts,
        render_pass: Pass,
        attachment: Attachment,
        aspect: Aspect,
        instances: list[Instance],
    ) -> None:
        """Adds what the frame says of an aspect over time."""
        if aspect.name != "depth" or aspect.store not in ("STORE", None) or attachment.samples == 1:
            facts.put("aspect.fetched", "OTHER")
        elif aspect.store is not None:
            facts.put("aspect.fetched", samples_fetched(attachment, aspect, self.search))
        touch_facts(facts, render_pass, attachment, aspect, instances, self.frame)
        put_undefined_use(facts, render_pass, attachment, aspect, instances, self.frame)
        lifetime_facts(facts, attachment, aspect, self.contents)
        if self.frame.document.metal is not None:
            from .metal import action_facts

            action_facts(facts, attachment, aspect, self.frame.document.metal)

    def _subpasses(
        self,
        render_pass: Pass,
        shared: Facts,
        instances: list[Instance],
        of_subpass: dict[str, Facts],
    ) -> Iterator[Subject]:
        uses = other_uses(render_pass)
        for subpass in render_pass.subpasses:
            facts = Facts(shared, subpass_facts(subpass, self.walk, self.device))
            screen_facts(facts, subpass, instances, self.contents)
            of_subpass[subpass.path] = facts
            yield Subject(
                "subpass",
                subpass.path,
                subpass.record.head,
                facts,
                subpass=subpass,
                owner=render_pass,
            )
            for resolve in subpass.resolves:
                of_resolve = Facts(shared, resolve_facts(resolve, self.device))
                self.resolve_uses.put(of_resolve, resolve)
                self._resolve_targets.put(of_resolve, resolve, uses)
                if self.frame.document.metal is not None:
                    from .metal import filter_facts

                    filter_facts(of_resolve, resolve, self.frame.document.metal)
                yield Subject(
                    "resolve",
                    resolve.path,
                    resolve.record.head,
                    of_resolve,
                    resolve=resolve,
                    owner=render_pass,
                )

    def _dependencies(self, render_pass: Pass, shared: Facts) -> Iterator[Subject]:
        detached = self.frame.has_commands and not self.frame.commands
        for record, facts in external_dependencies(
            render_pass, self._barriers, self.turns.alternating, detached
        ):
            dependency = record if isinstance(record, SubpassDependency) else None
            yield Subject(
                "dependency", record.path, record.head, Facts(shared, facts), dependency=dependency
            )

    @cached_property
    def _barriers(self) -> Barriers:
        return recorded_barriers(self.frame)

    def _resolve_commands(self) -> Iterator[Subject]:
        for position, resolve in self.frame.resolve_commands:
            facts = Facts(self.shared, resolve_facts(resolve, self.device))
            command_facts(facts, resolve, position, self.timeline)
            self.resolve_uses.put(facts, resolve)
            yield Subject("resolve", resolve.path, resolve.record.head, facts, resolve=resolve)

    def _pipelines(self, of_subpass: dict[str, Facts]) -> Iterator[Subject]:
        enabled = self.frame.description.enabled
        extensions = enabled.extensions or () if enabled is not None else ()
        draws = draws_of(self.walk) if self.frame.pipelines else {}
        without_shading = unshaded(self.frame)
        for pipeline, render_pass in self.frame.pipelines:
            subpass = subpass_of(pipeline, render_pass)
            facts = pipeline_facts(
                pipeline, subpass, draws.get(pipeline.key, ()), without_shading, extensions
            )
            self.shaders.put(facts, pipeline)
            shared = of_subpass[subpass.path] if subpass is not None else self.shared
            yield Subject(
                "pipeline",
                pipeline.path,
                pipeline.head,
                Facts(shared, facts),
                pipeline=pipeline,
                subpass=subpass,
                owner=render_pass,
            )

    def _image_of(self, attachment: Attachment) -> Facts:
        """The facts of an attachment's image; of several that alternate, those on which all
        agree.
        """
        images = self._image_facts
        every = [
            images[id(target.record)]
            for target in attachment.targets
            if id(target.record) in images
        ]
        if len(every) <= 1:
            return every[0] if every else Facts()
        common = Facts()
        for name, value in every[0].values.items():
            if all(other.values.get(name) == value for other in every[1:]):
                common.put(name, value, every[0].places.get(name))
        return common
