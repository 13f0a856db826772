"""Random descriptions whose references all lead somewhere, so that they are judged."""

from __future__ import annotations

from typing import Any

from hypothesis import strategies as st

from tests.frame.description.shapes import Json, structure

SECTIONS = {
    "images": ["image", "srcImage", "dstImage", "resolveImage"],
    "renderPasses": ["renderPass"],
    "framebuffers": ["framebuffer"],
    "pipelines": ["pipeline"],
}


def joined(description: Json) -> Json:
    """A description with every name, index and list of images made to fit the sections there
    are.
    """
    # Frames in other words are none of Vulkan's; what they state is fitted to itself.
    description = {
        key: value for key, value in description.items() if key not in ("metal", "renderTargets")
    }
    names = {section: list(description.get(section, {})) for section in SECTIONS}
    own = {member: section for section, members in SECTIONS.items() for member in members}
    fitted = _fitted(description, names, own)
    if isinstance(fitted.get("device"), str):
        fitted["device"] = "mali-g76"
    if isinstance(fitted.get("device"), dict):
        # What these may hold is checked beyond their types.
        for member in ("tile", "compression"):
            fitted["device"].pop(member, None)
    for render_pass in fitted.get("renderPasses", {}).values():
        _slots(render_pass)
    for framebuffer in fitted.get("framebuffers", {}).values():
        bound = fitted.get("renderPasses", {}).get(framebuffer.get("renderPass"))
        if bound is not None and "attachments" in framebuffer:
            images = (framebuffer["attachments"] or [None]) * len(bound.get("attachments", []))
            framebuffer["attachments"] = images[: len(bound.get("attachments", []))]
    for pipeline in fitted.get("pipelines", {}).values():
        within = fitted.get("renderPasses", {}).get(pipeline.get("renderPass"))
        if within is not None and "subpass" in pipeline:
            pipeline["subpass"] %= max(len(within.get("subpasses", [])), 1)
    if isinstance(fitted.get("commands"), list):
        fitted["commands"] = _in_order(fitted["commands"])
    return fitted


def _in_order(commands: list[Json]) -> list[Json]:
    """The commands without those that begin a pass within another one, and those that end none."""
    ends = {"beginRenderPass": "endRenderPass", "beginRendering": "endRendering"}
    kept, opened = [], None
    for command in commands:
        kind = command if isinstance(command, str) else next(iter(command), "")
        if (kind in ends and opened is not None) or (kind in ends.values() and kind != opened):
            continue
        opened = ends.get(kind, None if kind == opened else opened)
        kept.append(command)
    return kept


def _fitted(
    value: Json, names: dict[str, list[str]], own: dict[str, str], member: str = ""
) -> Json:
    section = own.get(member)
    if section is not None and isinstance(value, (str, int)):
        return _one_of(value, names[section])
    if section is not None and isinstance(value, list):
        return [_one_of(each, names[section]) for each in value if names[section]]
    if isinstance(value, dict):
        fitted = {key: _fitted(inner, names, own, key) for key, inner in value.items()}
        return {
            key: inner
            for key, inner in fitted.items()
            if inner is not ... and (key not in own or inner is not None)
        }
    if isinstance(value, list):
        if member == "attachments" and all(
            each is None or isinstance(each, (str, int)) for each in value
        ):
            return [
                None if each is None or not names["images"] else _one_of(each, names["images"])
                for each in value
            ]
        if member == "images":
            each_fitted = [
                _one_of(i, names["images"]) if isinstance(i, (str, int)) else _fitted(i, names, own)
                for i in value
            ]
            return [each for each in each_fitted if each is not ...]
        return [_fitted(inner, names, own) for inner in value]
    return value


def _one_of(value: Json, names: list[str]) -> Json:
    if not names:
        return ...
    return names[(len(value) if isinstance(value, str) else value) % len(names)]


def _slots(render_pass: dict[str, Any]) -> None:
    count = len(render_pass.get("attachments", []))
    subpasses = render_pass.get("subpasses", [])
    if "fragmentDensityMapAttachment" in render_pass:
        render_pass["fragmentDensityMapAttachment"] = _slot(
            render_pass["fragmentDensityMapAttachment"], count
        )
    for subpass in subpasses:
        for member in (
            "inputAttachments",
            "colorAttachments",
            "resolveAttachments",
            "preserveAttachments",
        ):
            if member in subpass:
                subpass[member] = [_slot(each, count) for each in subpass[member]]
        if {"colorAttachments", "resolveAttachments"} <= subpass.keys():
            subpass["resolveAttachments"] = subpass["resolveAttachments"][
                : len(subpass["colorAttachments"])
            ]
        for member in ("depthStencilAttachment", "fragmentShadingRateAttachment"):
            if member in subpass:
                subpass[member] = _slot(subpass[member], count)
        if "attachment" in subpass.get("depthStencilResolve", {}):
            subpass["depthStencilResolve"]["attachment"] = _slot(
                subpass["depthStencilResolve"]["attachment"], count
            )
    for dependency in render_pass.get("dependencies", []):
        for member in ("srcSubpass", "dstSubpass"):
            if isinstance(dependency.get(member), int) and dependency[member] >= len(subpasses):
                dependency[member] = "EXTERNAL"


def _slot(value: Json, count: int) -> Json:
    if isinstance(value, dict):
        return {**value, "attachment": _slot(value.get("attachment"), count)}
    if value is None or count == 0:
        return None
    return (len(value) if isinstance(value, str) else value) % count


METAL_NAMES = {
    "texture": "textures",
    "resolveTexture": "textures",
    "source": "textures",
    "destination": "textures",
    "present": "textures",
    "renderPass": "renderPasses",
}


def _metal(value: Json, names: dict[str, list[str]]) -> Json:
    """A part of a frame in Metal's words with every name made to fit; a command that would name
    nothing is left out.
    """
    if isinstance(value, list):
        return [each for each in (_metal(inner, names) for inner in value) if each != {}]
    if not isinstance(value, dict):
        return value
    fitted = {}
    for key, inner in value.items():
        if key in METAL_NAMES and isinstance(inner, (str, int)):
            inner = _one_of(inner, names[METAL_NAMES[key]])
        else:
            inner = _metal(inner, names)
        if inner is not ...:
            fitted[key] = inner
    return fitted


def _in_metals_words(whole: tuple[Json, Json]) -> Json:
    description, metal = whole
    names = {section: list(metal.get(section, {})) for section in ("textures", "renderPasses")}
    beside = {
        key: value
        for key, value in joined(description).items()
        if key in ("frame", "device", "scene")
    }
    return {**beside, "metal": _metal(metal, names)}


def metal_frames() -> st.SearchStrategy[Json]:
    """Whole random frames in Metal's words."""
    return st.tuples(structure("Description"), structure("Metal")).map(_in_metals_words)


def frames() -> st.SearchStrategy[Json]:
    """Whole random frames."""
    return structure("Description").map(joined)
