"""Vulkan SC pipeline JSON: the input of the offline pipeline compiler, as the Khronos tools write
it.

A file contains one pipeline, with its render pass as C structures. It has no images, so what the
file omits is unknown.
"""

from __future__ import annotations

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.span import Span
from msaa_lint.core.text.tree import Node
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.dumps import is_null
from msaa_lint.frame.description.models import Description, Enabled, Pipeline, RenderPass

STATES = ("GraphicsPipelineState", "ComputePipelineState", "RayTracingPipelineState")


def claims(root: Node) -> bool:
    """Whether a document is a Vulkan SC pipeline."""
    return root.kind == "mapping" and any(state in root.value for state in STATES)


def read(source: Source, root: Node) -> Document:
    """Reads a pipeline as a document. The document of a compute pipeline has no passes."""
    binder = Binder(dumped=True)
    description: Description = binder.record(
        Description, _nothing(root), "", "", Span(root.start, root.start)
    )
    if root.kind != "mapping" or not any(state in root.value for state in STATES):
        binder.wrong_structure(root, "", f"a mapping with one of {', '.join(STATES)}")
        return Document(source, description, tuple(binder.problems), whole=False)
    state = root.value.get("GraphicsPipelineState")
    if state is not None and state.kind == "mapping":
        _graphics(binder, description, state)
        _enabled(binder, description, root, state)
    elif state is not None and not is_null(state):
        binder.wrong_structure(state, "GraphicsPipelineState", "a mapping")
    return Document(source, description, tuple(binder.problems), whole=False)


def _nothing(root: Node) -> Node:
    """An empty mapping at the root's place."""
    return Node("mapping", root.start, root.end, {}, {})


def _graphics(binder: Binder, description: Description, state: Node) -> None:
    passes = [
        key
        for key in ("Renderpass", "Renderpass2", "RenderPass", "RenderPass2")
        if key in state.value and not is_null(state.value[key])
    ]
    name = ""
    for name in passes:
        path = f"GraphicsPipelineState.{name}"
        render_pass: RenderPass = binder.record(
            RenderPass, state.value[name], path, name, state.keys[name].span
        )
        description.renderPasses = {name: render_pass}
    pipeline = state.value.get("GraphicsPipeline")
    if pipeline is None or is_null(pipeline):
        return
    path = "GraphicsPipelineState.GraphicsPipeline"
    if pipeline.kind != "mapping":
        binder.wrong_structure(pipeline, path, "a mapping")
        return
    pipeline_record: Pipeline = binder.record(
        Pipeline, _plain(pipeline), path, "GraphicsPipeline", state.keys["GraphicsPipeline"].span
    )
    # `renderPass` is the tool's number for the render pass above.
    pipeline_record.renderPass = name or None
    for stage in pipeline_record.stages:
        # `module` is also a number, not a path.
        stage.module = None
        stage.spelled.pop("module", None)
    description.pipelines = {"GraphicsPipeline": pipeline_record}


def _plain(pipeline: Node) -> Node:
    """The pipeline without the number of its render pass, and with a plain list of dynamic
    states.
    """
    keys = {key: node for key, node in pipeline.keys.items() if key != "renderPass"}
    value = {key: pipeline.value[key] for key in keys}
    state = value.get("pDynamicState")
    if state is not None and state.kind == "mapping":
        states = state.value.get("pDynamicStates")
        if states is not None:
            value["pDynamicState"] = states
        else:
            del value["pDynamicState"], keys["pDynamicState"]
    return Node("mapping", pipeline.start, pipeline.end, value, keys)


def _enabled(binder: Binder, description: Description, root: Node, state: Node) -> None:
    """Reads EnabledExtensions, and the features that the device is created with."""
    enabled: Enabled = binder.record(
        Enabled,
        _nothing(root),
        "EnabledExtensions",
        "EnabledExtensions",
        Span(root.start, root.start),
    )
    extensions = root.value.get("EnabledExtensions")
    if extensions is not None and extensions.kind == "sequence":
        enabled.extensions = tuple(item.text for item in extensions.value if item.kind == "scalar")
        enabled.spelled["extensions"] = (root.keys["EnabledExtensions"], extensions)
    features = state.value.get("PhysicalDeviceFeatures")
    core_features = _core_features(features) if features is not None else None
    if core_features is not None:
        key, node = core_features
        chain = [features, node]
        while chain[-2].kind == "mapping" and "pNext" in chain[-2].value:
            chain.insert(-1, chain[-2].value["pNext"])
        members = [
            member for each in chain if each.kind == "mapping" for member in each.value.items()
        ]
        enabled.features = tuple(
            name
            for name, item in members
            if item.kind == "scalar" and item.text in ("VK_TRUE", "1", "true")
        )
        rate = "sampleRateShading"
        enabled.spelled["features"] = (
            (node.keys[rate], node.value[rate]) if rate in node.value else (key, node)
        )
    description.enabled = enabled


def _core_features(chain: Node) -> tuple[Node, Node] | None:
    """The VkPhysicalDeviceFeatures that the device is created with, from a chain of structures.

    The tools dump VkDeviceObjectReservationCreateInfo. Its chain contains the application's
    VkPhysicalDeviceFeatures2, if any; beside the chain is pEnabledFeatures, all false if the
    application passed none.
    """
    node: Node | None = chain
    outer: tuple[Node, Node] | None = None
    while node is not None and node.kind == "mapping":
        features = node.value.get("features")
        if features is not None and features.kind == "mapping":
            last = (node.keys["features"], features)
            if node is not chain:
                return last
            outer = last
        node = node.value.get("pNext")
    return outer
