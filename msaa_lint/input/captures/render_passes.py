"""VkRenderPassCreateInfo and VkRenderPassCreateInfo2 as a description states them."""

from __future__ import annotations

from typing import Any

from msaa_lint.frame.description.models import RenderPass
from msaa_lint.frame.vulkan.formats import format_of

from . import values
from .structures import Tree, described, slot


def render_pass_of(info: dict[str, Any]) -> Tree:
    """A render pass's tree, in which every reference leads somewhere."""
    tree = described(RenderPass, info)
    for attachment in tree.get("attachments", ()):
        _without_stencil(attachment)
    _maps(tree, info)
    _coherent(tree)
    return tree


def _without_stencil(attachment: Tree) -> None:
    """Takes the stencil operations, which C always states, from an attachment whose format has no stencil."""
    format = format_of(attachment["format"]) if "format" in attachment else None
    if format is not None and "stencil" not in format.aspects:
        for member in ("stencilLoadOp", "stencilStoreOp", "stencilInitialLayout", "stencilFinalLayout"):
            attachment.pop(member, None)


def _maps(tree: Tree, info: dict[str, Any]) -> None:
    """Makes input attachments of those that say how densely a pass is shaded: it reads them, which a description has no other word for."""
    density = values.chained(info, "RENDER_PASS_FRAGMENT_DENSITY_MAP_CREATE_INFO")
    of_all = slot(density.get("fragmentDensityMapAttachment")) if density is not None else None
    for subpass, given in zip(tree.get("subpasses", ()), values.items(info.get("pSubpasses")), strict=False):
        rate = values.chained(values.record(given), "FRAGMENT_SHADING_RATE_ATTACHMENT_INFO")
        of_one = slot(rate.get("pFragmentShadingRateAttachment")) if rate is not None else None
        read = [reference for reference in (of_all, of_one) if reference is not None]
        if read:
            subpass["inputAttachments"] = [*subpass.get("inputAttachments", ()), *read]


def _coherent(tree: Tree) -> None:
    """Takes the references from a render pass that lead nowhere, as no program that runs has them."""
    count, subpasses = len(tree.get("attachments", ())), tree.get("subpasses", [])

    def known(reference: Any) -> Any:
        index = reference.get("attachment") if isinstance(reference, dict) else reference
        return reference if isinstance(index, int) and index < count else None

    for subpass in subpasses:
        for member in ("inputAttachments", "colorAttachments", "resolveAttachments", "preserveAttachments"):
            if member in subpass:
                subpass[member] = [known(reference) for reference in subpass[member]]
        if known(subpass.get("depthStencilAttachment")) is None:
            subpass.pop("depthStencilAttachment", None)
        resolve = subpass.get("depthStencilResolve")
        if resolve is not None and known(resolve.get("attachment")) is None:
            resolve.pop("attachment", None)
    dependencies = tree.get("dependencies", [])
    ends = ("srcSubpass", "dstSubpass")
    tree["dependencies"] = [
        each for each in dependencies if all(each.get(end) in (None, "EXTERNAL") or each[end] < len(subpasses) for end in ends)
    ]
    if not tree["dependencies"]:
        del tree["dependencies"]
