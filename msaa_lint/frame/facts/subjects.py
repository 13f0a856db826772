"""From a document to everything that rules judge in it."""

from __future__ import annotations

from collections.abc import Iterator

from msaa_lint.frame.description.document import Document
from msaa_lint.frame.devices import DeviceProfile

from .attachment import aspect_facts, attachment_facts, pass_facts, resolves_at
from .clear_values import clear_value_facts
from .dependency import external_dependencies, recorded_barriers
from .facts import Facts, Subject
from .frame import Attachment, Frame
from .global_facts import profile, surroundings
from .image import Bindings, image_facts
from .lifetimes import lifetime_facts
from .moments import Moments
from .pass_contents import recorded, screen_facts, touch_facts
from .pipeline import draws_of, pipeline_facts, subpass_of, unshaded
from .resolve import command_facts, read_in_vain, resolve_facts, writers_of
from .resolve_uses import Results
from .sample_count_choices import choices
from .sample_readers import fetched
from .shaders import Finder as ShaderFinder
from .shaders import Shaders
from .study import UNSTUDIED, Finder, put_study
from .subpass import pipelines_drawn, subpass_facts
from .swapchain_rotation import Turns
from .timeline import Timeline


def subjects(
    document: Document, default_device: DeviceProfile | None = None, study: Finder | None = None, shader: ShaderFinder | None = None
) -> Iterator[Subject]:
    """The subjects of a document with their facts, in the order of the document's sections. Each fact is found once.

    `study` finds the record of the frame's study, `shader` what the module of a shader stage says.
    """
    device = profile(document.description, default_device)
    frame = Frame(document)
    timeline = Timeline(frame)
    moments = Moments(frame)
    records = recorded(frame)
    around = surroundings(document.description, device)
    images: dict[int, Facts] = {}
    bindings = Bindings(frame)
    results, turns = Results(frame, timeline, device), Turns(frame, bindings)
    shaders = Shaders(frame, shader)
    targets, efficient = frame.all_targets, around.values["device.max_efficient_samples"]
    assert isinstance(efficient, int)
    above = {id(target) for target in targets if target.samples is not None and target.samples > efficient}
    studied = study(frame) if above and study is not None else UNSTUDIED
    lowered, metal = document.metal, document.description.metal
    if lowered is not None:
        from .metal import action_facts, filter_facts, texture_facts
    writers = writers_of(frame) if frame.resolve_commands else {}
    in_vain = read_in_vain(frame, writers, timeline) if writers else set()
    for target in targets:
        facts = image_facts(target, bindings, frame, timeline, device)
        facts.put("image.read_in_vain", target.name in in_vain)
        turns.put(facts, target)
        shaders.averaged(facts, target)
        put_study(facts, target.samples, studied if id(target) in above else UNSTUDIED)
        if lowered is not None and metal is not None:
            texture_facts(facts, target, metal, around.values.get("device.lazy_memory"))
        images[id(target.record)] = facts
        yield Subject("image", target.path, target.record.head, Facts(around, facts), target)
    of_subpass: dict[str, Facts] = {}
    drawn = pipelines_drawn(frame)
    barriers = recorded_barriers(frame)
    for each in frame.passes:
        shared = Facts(around, pass_facts(each))
        clear_value_facts(shared, each, frame)
        yield Subject("pass", each.path, each.record.head, shared, each)
        instances = records.get(each.path, [])
        resolves = resolves_at(each)
        known = document.whole or bool(each.subpasses)
        for attachment in each.attachments:
            base = Facts(shared, _image_of(attachment, images), attachment_facts(attachment, known))
            yield Subject("attachment", attachment.record.path, attachment.record.head, base, attachment)
            for aspect in attachment.aspects:
                facts = Facts(base, aspect_facts(each, attachment, aspect, resolves.get(id(attachment), []), timeline))
                if aspect.name == "depth" and aspect.store == "STORE" and attachment.samples != 1:
                    facts.put("aspect.fetched", fetched(attachment, aspect, results.events))
                touch_facts(facts, each, attachment, aspect, instances, frame)
                lifetime_facts(facts, each, attachment, aspect, moments)
                if lowered is not None:
                    action_facts(facts, attachment, aspect, lowered)
                yield Subject("aspect", attachment.record.path, attachment.record.head, facts, (attachment, aspect))
        for subpass in each.subpasses:
            own = Facts(shared, subpass_facts(subpass, frame, drawn, device))
            screen_facts(own, subpass, instances, moments)
            of_subpass[subpass.path] = own
            yield Subject("subpass", subpass.path, subpass.record.head, own, subpass)
            for resolve in subpass.resolves:
                facts = Facts(shared, resolve_facts(resolve, device))
                results.put(facts, resolve)
                if lowered is not None:
                    filter_facts(facts, resolve, lowered)
                yield Subject("resolve", resolve.path, resolve.record.head, facts, resolve)
        for record, facts in external_dependencies(each, barriers, frame.has_commands and not frame.commands):
            yield Subject("dependency", record.path, record.head, Facts(shared, facts), record)
    for position, resolve in frame.resolve_commands:
        facts = Facts(around, resolve_facts(resolve, device))
        command_facts(facts, resolve, position, frame, writers)
        results.put(facts, resolve)
        yield Subject("resolve", resolve.path, resolve.record.head, facts, resolve)
    draws = draws_of(frame) if frame.pipelines else {}
    without_shading = unshaded(frame)
    for pipeline, within in frame.pipelines:
        drawn_in = subpass_of(pipeline, within)
        base = of_subpass[drawn_in.path] if drawn_in is not None else around
        facts = pipeline_facts(pipeline, drawn_in, draws.get(pipeline.key, ()), without_shading)
        shaders.put(facts, pipeline)
        yield Subject("pipeline", pipeline.path, pipeline.head, Facts(base, facts), (pipeline, drawn_in))
    yield from shaders.reads(around)
    yield from choices(document.description, around)


def _image_of(attachment: Attachment, images: dict[int, Facts]) -> Facts:
    """The facts of an attachment's image; of several that alternate, those on which all agree."""
    every = [images[id(target.record)] for target in attachment.targets if id(target.record) in images]
    if len(every) <= 1:
        return every[0] if every else Facts()
    common = Facts()
    for name, value in every[0].values.items():
        if all(other.values.get(name) == value for other in every[1:]):
            common.put(name, value, every[0].places.get(name))
    return common
