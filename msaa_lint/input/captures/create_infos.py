"""Converts VkRenderPassCreateInfo, VkRenderPassCreateInfo2 and VkGraphicsPipelineCreateInfo to the
form of a description.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any

from msaa_lint.frame.description.models import Pipeline, RenderPass
from msaa_lint.frame.vulkan.formats import format_of

from . import values
from .structures import Tree, to_tree


def render_pass_of(info: dict[str, Any]) -> Tree:
    """A render pass's tree, without dangling references."""
    tree = to_tree(RenderPass, info)
    for attachment in tree.get("attachments", ()):
        _drop_stencil(attachment)
    _drop_dangling_references(tree)
    return tree


def _drop_stencil(attachment: Tree) -> None:
    """Removes the stencil operations, which C always states, from an attachment whose format has no
    stencil.
    """
    format = format_of(attachment["format"]) if "format" in attachment else None
    if format is not None and "stencil" not in format.aspects:
        for member in (
            "stencilLoadOp",
            "stencilStoreOp",
            "stencilInitialLayout",
            "stencilFinalLayout",
        ):
            attachment.pop(member, None)


def _drop_dangling_references(tree: Tree) -> None:
    """Removes dangling references, which a valid program does not have."""
    count, subpasses = len(tree.get("attachments", ())), tree.get("subpasses", [])

    def valid_or_none(reference: Any) -> Any:
        index = reference.get("attachment") if isinstance(reference, dict) else reference
        return reference if isinstance(index, int) and index < count else None

    for subpass in subpasses:
        for member in (
            "inputAttachments",
            "colorAttachments",
            "resolveAttachments",
            "preserveAttachments",
        ):
            if member in subpass:
                subpass[member] = [valid_or_none(reference) for reference in subpass[member]]
        for member in ("depthStencilAttachment", "fragmentShadingRateAttachment"):
            if valid_or_none(subpass.get(member)) is None:
                subpass.pop(member, None)
        resolve = subpass.get("depthStencilResolve")
        if resolve is not None and valid_or_none(resolve.get("attachment")) is None:
            resolve.pop("attachment", None)
    if valid_or_none(tree.get("fragmentDensityMapAttachment")) is None:
        tree.pop("fragmentDensityMapAttachment", None)
    dependencies = tree.get("dependencies", [])
    ends = ("srcSubpass", "dstSubpass")
    tree["dependencies"] = [
        dependency
        for dependency in dependencies
        if all(
            dependency.get(end) in (None, "EXTERNAL") or dependency[end] < len(subpasses)
            for end in ends
        )
    ]
    if not tree["dependencies"]:
        del tree["dependencies"]


def pipeline_of(
    info: dict[str, Any], modules: Mapping[int, bytes]
) -> tuple[Tree, dict[str, bytes]]:
    """A pipeline's tree, and the code of the shader modules by the names that the tree uses."""
    structure = {
        key: item
        for key, item in info.items()
        if key not in ("pDynamicState", "renderPass", "pStages", "stages")
    }
    # A description lists the dynamic states directly.
    dynamic = values.record(info.get("pDynamicState") or info.get("dynamicState"))
    structure["dynamicState"] = dynamic.get("pDynamicStates", dynamic.get("dynamicState")) or []
    tree = to_tree(Pipeline, structure)
    if not values.handle(info.get("renderPass")):
        tree.pop("subpass", None)
    stages, code = _stages(values.items(info.get("pStages") or info.get("stages")), modules)
    if stages:
        tree["stages"] = stages
    return tree, code


def _stages(stages: list[Any], modules: Mapping[int, bytes]) -> tuple[list[Tree], dict[str, bytes]]:
    """The fragment stage, the only one that rules need, if its code is known."""
    trees: list[Tree] = []
    modules_by_name: dict[str, bytes] = {}
    for stage in stages[:16]:
        info = values.record(stage)
        kind = values.enum("VkShaderStageFlagBits", info.get("stage"))
        code = modules.get(values.handle(info.get("module")))
        # The capture omits the values of specialization constants, so the behavior of the code is
        # unknown.
        specialized = info.get("pSpecializationInfo") or info.get("specializationInfo")
        if kind != "FRAGMENT" or code is None or specialized:
            continue
        name = f"shaders/{hashlib.sha256(code).hexdigest()[:16]}.spv"
        modules_by_name[name] = code
        tree: Tree = {"stage": kind, "module": name}
        entry = values.text(info.get("pName") or info.get("name"))
        if entry:
            tree["name"] = entry
        trees.append(tree)
    return trees, modules_by_name
