"""Writes what a program creates as a description.

For a program that renders with one sample or with several, depending on a setting, the multisampled
configuration is described. Values that depend on other conditions are unknown unless they are the
same either way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.devices.msaa_features import FEATURES
from msaa_lint.frame.vulkan.names import parse_enum
from msaa_lint.input.code.core.values import UNKNOWN, ApiObject, Array, Struct, Symbol, sole_value
from msaa_lint.input.code.parsing import Read

from .enumerants import FLAGS
from .members import Item, complete, flags_of, head_of
from .names import first_version
from .passes import Passes
from .renderings import Commands


class DescriptionWriter(Passes, Commands):
    """Writes the description of one file."""

    def read(self) -> Read | None:
        """Returns the description, or None if the file creates nothing that can be described."""
        self.choose_configuration()
        self.current_objects = [obj for obj in self.current_objects if not self.is_excluded(obj)]
        passes = [obj for obj in self.current_objects if obj.kind == "renderPass"]
        self.bind(passes)
        attached: dict[int, ApiObject] = {}
        rendered = {
            id(obj): item for obj in passes if (item := self.render_pass(obj, attached)) is not None
        }
        first: dict[str, Item] = {}
        for key, item in rendered.items():
            # The same code creates a pass again, when a window is resized, for example.
            rendered[key] = first.setdefault(
                f"{item[1]} {_signature(item[2], samples_at=False)}", item
            )
        pass_names = {key: item[0] for key, item in rendered.items()}
        recorded = [
            self.rendering(obj, attached) for obj in self.current_objects if obj.kind == "rendering"
        ]
        recorded += [self.resolve(at, ends, attached) for at, ends in self.resolves.items()]
        commands = _distinct_nodes([node for node in recorded if node is not None])
        images = dict.fromkeys(
            self.first_duplicate(obj) for obj in self.current_objects if obj.kind == "image"
        )
        image_items = [
            self.image(image)
            for image in images
            if id(image) in attached or self.is_multisampled(image)
        ]
        image_items += self.external_images.values()
        pipelines = [
            item
            for obj in self.current_objects
            if obj.kind in ("pipeline", "state")
            for item in self.pipeline(obj, pass_names)
        ]
        sections = []
        for name, every in (
            ("images", image_items),
            ("renderPasses", first.values()),
            ("pipelines", pipelines),
        ):
            items = _distinct(every)
            if items:
                at = items[0][1]
                sections.append(
                    (name, Span(at.start, at.start), mapping(items, Span(at.start, at.start)))
                )
        sections += self.enabled()
        if commands:
            at = Span(commands[0].start, commands[0].start)
            sections.append(("commands", at, sequence(commands, at)))
        return (
            Read(mapping(sections, Span(0, 0)), tuple(self.assumed.values()), basis=self.basis)
            if sections
            else None
        )

    def is_multisampled(self, obj: ApiObject) -> bool:
        return (self.samples(obj.info)[0] or 1) > 1

    def image(self, obj: ApiObject) -> Item:
        info = obj.info
        items: list[Item] = []
        structs, known = self.chain(info)
        if structs or not known:
            items.append(self.unread(info))
        for name in ("format", "imageType", "tiling", "sharingMode", "usage"):
            if (
                name == "usage"
                and not self.is_transient(info)
                and (obj.escaped or self.is_unread(obj))
            ):
                # External code may use the image in any way; what nothing reads is used in fewer
                # ways than the usage allows.
                continue
            if name == "imageType" and info.zeroed and name not in info.fields:
                continue
            items += self.item(info, name)
        count, at = self.samples(info)
        if count is not None:
            items.insert(min(1, len(items)), ("samples", at, scalar(count, at)))
        for name in ("mipLevels", "arrayLayers"):
            value, place = self.get(info, name)
            if type(value) is int and value > 0:
                items.append((name, place, scalar(value, place)))
        memory = (
            flags_of(FLAGS["memory"], sole_value(self.settle(obj.memory)), obj.memory[-1].at)
            if obj.memory
            else None
        )
        if memory is not None:
            items.append(("memory", memory.span, memory))
        head = head_of(info.at)
        return self.object_name(obj, "image"), head, mapping(items, head)

    def is_unread(self, obj: ApiObject) -> bool:
        """Returns whether the usage of a color attachment allows reads that no code of the program
        does.
        """
        usage = self.usage_text(obj.info)
        may_be_read = "COLOR" in usage and ("TRANSFER_SRC" in usage or "SAMPLED" in usage)
        return may_be_read and not self.fragments and self.reads.is_unread(obj, usage)

    def pipeline(self, obj: ApiObject, passes: dict[int, str]) -> Iterator[Item]:
        info = obj.info
        state = info if obj.kind == "state" else self.struct(info, "multisampleState")
        if state is None or first_version(state.kind) not in (
            "PipelineMultisampleStateCreateInfo",
            "",
        ):
            return
        items: list[Item] = []
        count, at = self.samples(state, "rasterizationSamples")
        if count is not None:
            items.append(("rasterizationSamples", at, scalar(count, at)))
        for name in (
            "sampleShadingEnable",
            "minSampleShading",
            "alphaToCoverageEnable",
            "alphaToOneEnable",
        ):
            # A value that is a fraction of the count is unknown if the count is.
            if (
                name != "minSampleShading"
                or not self.has_assumed_count(state)
                or self.known_value(state, name) in (None, 0, 1)
            ):
                items += self.item(state, name)
        items += self.mask(state)
        if not items:
            return
        head = head_of(state.at)
        members: list[Item] = []
        if obj.kind == "pipeline":
            target = self.dereference(self.get(info, "renderPass")[0])
            # The listings of a page need not belong to one program, and a count that may be 1 need
            # not be that of this pass.
            if (
                isinstance(target, ApiObject)
                and id(target) in passes
                and not self.fragments
                and not self.may_be_single_sampled(state)
            ):
                at = self.get(info, "renderPass")[1]
                members.append(("renderPass", at, scalar(passes[id(target)], at)))
                subpass, place = self.get(info, "subpass")
                if subpass is None or type(subpass) is int:
                    members.append(("subpass", place, scalar(subpass or 0, place)))
            dynamic = self.dynamic(info)
            if dynamic is None:
                return
            members += dynamic
            members += self.blending(info)
        members.append(("multisampleState", head, mapping(items, head)))
        yield self.object_name(obj, state.name or "pipeline"), head, mapping(members, head)

    def has_assumed_count(self, state: Struct) -> bool:
        """Returns whether the sample count of a pipeline is assumed."""
        cell = state.fields.get("rasterizationSamples")
        return cell is not None and any(
            isinstance(item.value, Symbol) for item in self.settle(cell.writes)
        )

    def may_be_single_sampled(self, state: Struct) -> bool:
        """Returns whether the sample count of a pipeline is assumed where the program also writes 1
        to it.
        """
        cell = state.fields.get("rasterizationSamples")
        has_one = cell is not None and any(
            type(item.value) is int and item.value == 1 for item in cell.writes
        )
        return has_one and self.has_assumed_count(state)

    def mask(self, state: Struct) -> Iterator[Item]:
        """Yields the sample mask if all its words are known."""
        value, at = self.get(state, "sampleMask")
        known = self.dereference(value)
        words = (
            [sole_value(self.settle(cell.writes)) for cell in known.items]
            if isinstance(known, Array) and known.complete
            else [known]
        )
        if (
            words
            and all(type(word) is int and 0 <= word < 2**32 for word in words)
            and value not in (None, 0)
        ):
            yield "sampleMask", at, sequence([scalar(word, at) for word in words], at)

    def enabled(self) -> Iterator[Item]:
        """Yields those features about multisampling that the only device of the file enables, if
        all of them are known.
        """
        devices = [obj for obj in self.current_objects if obj.kind == "device"]
        if len(devices) != 1:
            return
        info = devices[0].info
        features = self.struct(info, "enabledFeatures")
        structures = [features] if features is not None else []
        chained = self.dereference(self.get(info, "next")[0]) if "next" in info.fields else None
        while isinstance(chained, Struct):
            if chained.kind == "PhysicalDeviceFeatures2":
                features = self.struct(chained, "features")
                structures += [features] if features is not None else []
            else:
                structures.append(chained)
            chained = (
                self.dereference(self.get(chained, "next")[0]) if "next" in chained.fields else None
            )
        if features is None or (chained is not None and chained != 0):
            # What is not known of the pNext chain may enable more.
            return
        at = self.get(features, "sampleRateShading")[1]
        stated = [
            (name, *self.get(structure, name))
            for structure in structures
            for name in FEATURES
            if name in structure.fields
        ]
        if all(isinstance(value, (bool, int)) for _, value, _ in stated):
            names = [scalar(name, place) for name, value, place in stated if value]
            yield (
                "enabled",
                head_of(info.at),
                mapping([("features", at, sequence(names, at))], head_of(info.at)),
            )

    def dynamic(self, info: Struct) -> list[Item] | None:
        """Returns the dynamic states, or None if they are unknown and the sample count may be among
        them.
        """
        value, at = self.get(info, "dynamicState")
        if value is None:
            return []
        state = self.dereference(value)
        list_node = (
            self.dereference(self.get(state, "dynamicStates")[0])
            if isinstance(state, Struct)
            else UNKNOWN
        )
        if not isinstance(list_node, Array) or not list_node.complete:
            return None if self.has_dynamic_samples else []
        names = [
            parse_enum("VkDynamicState", str(sole_value(self.settle(cell.writes))))
            for cell in list_node.items
        ]
        nodes = [scalar(name, at) for name in names if name is not None]
        return [("dynamicState", at, sequence(nodes, at))] if nodes else []

    def blending(self, info: Struct) -> Iterator[Item]:
        state = self.struct(info, "colorBlendState")
        attachments = self.structs(state, "attachments") if state is not None else None
        known = complete(attachments) if state is not None and attachments else None
        if state is None or known is None:
            return
        nodes = [
            mapping(self.item(attachment, "blendEnable"), head_of(attachment.at))
            for attachment in known
        ]
        head = head_of(state.at)
        yield "colorBlendState", head, mapping([("attachments", head, sequence(nodes, head))], head)


def _distinct(items: Iterable[Item]) -> list[Item]:
    """Removes items with equal content and location: calling a function twice creates them
    twice.
    """
    distinct: dict[str, Item] = {}
    for item in items:
        distinct.setdefault(f"{item[1]} {_signature(item[2])}", item)
    return list(distinct.values())


def _distinct_nodes(nodes: Sequence[Node]) -> list[Node]:
    return list({_signature(node): node for node in nodes}.values())


def _signature(node: Node, samples_at: bool = True) -> str:
    """Returns what a node consists of and where it is. `samples_at` is whether the place of a
    sample count matters.
    """
    inner = node.text
    if node.kind == "mapping":
        parts = (
            (key, _signature(item, samples_at) if samples_at or key != "samples" else item.text)
            for key, item in node.value.items()
        )
        inner = ",".join(f"{key}:{part}" for key, part in parts)
    elif node.kind == "sequence":
        inner = ",".join(_signature(item, samples_at) for item in node.value)
    return f"{node.start}-{node.end}({inner})"
