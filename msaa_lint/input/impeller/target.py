"""A render target with the engine's defaults. Each value has the place that determines it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import FrameSize, RenderTarget
from msaa_lint.frame.description.record import Record

from . import words

COLOR = {
    "storageMode": "kDevicePrivate",
    "resolveStorageMode": "kDevicePrivate",
    "loadAction": "kClear",
    "storeAction": "kStore",
}
"""`RenderTarget::kDefaultColorAttachmentConfig`."""

COLOR_MSAA = {**COLOR, "storageMode": "kDeviceTransient", "storeAction": "kMultisampleResolve"}
"""`RenderTarget::kDefaultColorAttachmentConfigMSAA`."""

STENCIL = {"storageMode": "kDeviceTransient", "loadAction": "kClear", "storeAction": "kDontCare"}
"""`RenderTarget::kDefaultStencilAttachmentConfig`, for both depth and stencil, which share one
texture.
"""


class Value(NamedTuple):
    """A value, and the place that determines it."""

    value: Any
    at: Span

    def mapped(self, names: Mapping[Any, Any]) -> Value:
        """The name of the value in an API, at the same place; unknown if the API has none."""
        return Value(names.get(self.value), self.at)


class Config:
    """The storage modes of an attachment and its resolve texture, and its load and store
    actions.
    """

    def __init__(self, owner: RenderTarget, member: str, defaults: dict[str, str]) -> None:
        record: Record | None = getattr(owner, member)
        self.storage, self.resolve_storage, self.load, self.store = (
            member_or_default(record, name, defaults.get(name), owner.head)
            for name in ("storageMode", "resolveStorageMode", "loadAction", "storeAction")
        )


class Target:
    """A render target. `at` is the place of its name, which defaults have as their place."""

    def __init__(self, name: str, record: RenderTarget, frame: FrameSize | None) -> None:
        api = record.api or ""
        self.name = name
        self.at = record.head
        self.onscreen = bool(record.onscreen)
        self.width, self.height = (_size(record, side, frame) for side in ("width", "height"))
        count = member_or_default(record, "sampleCount", 1, self.at)
        self.samples = Value(words.sample_count(count.value), count.at)
        self.multisampled = self.samples.value > 1
        self.color = Config(
            record, "colorAttachmentConfig", COLOR_MSAA if self.multisampled else COLOR
        )
        self.depth_stencil = Config(record, "stencilAttachmentConfig", STENCIL)
        self.color_format = member_or_default(
            record, "colorFormat", words.DEFAULT_COLOR[api], self.at
        )
        self.depth_format = member_or_default(
            record, "depthFormat", words.DEFAULT_DEPTH_STENCIL[api], self.at
        )
        self.has_depth_stencil = record.depthFormat is not None or record.enableStencil is not False
        self.has_depth = self.depth_format.value != "kS8UInt"
        self.has_stencil = record.enableStencil is not False

    @property
    def resolves(self) -> bool:
        """Whether the color store action resolves."""
        return self.color.store.value in words.RESOLVES


def member_or_default(record: Record | None, member: str, default: object, at: Span) -> Value:
    """The stated value of a member, or the default at a place."""
    if record is None or not record.states(member):
        return Value(default, at)
    return Value(getattr(record, member), record.spelled[member][1].span)


def _size(record: RenderTarget, side: str, frame: FrameSize | None) -> Value | None:
    """A width or height in texels, from the target or else the frame; None if neither states it."""
    for owner in (record, frame):
        if owner is not None and owner.states(side):
            return Value(getattr(owner, side), owner.spelled[side][1].span)
    return None


def sections(node: Node, names: tuple[str, ...]) -> dict[str, Value]:
    """The given sections of a description, unchanged."""
    return {
        name: Value(node.value[name], node.keys[name].span) for name in names if name in node.value
    }


def tree(value: Any, at: Span) -> Node:
    """The node for a dict, list or scalar at a place; a `Value` has its own place, and a node is
    kept.

    Members whose value is None are unknown and omitted.
    """
    if isinstance(value, Node):
        return value
    if isinstance(value, Value):
        return tree(value.value, value.at)
    if isinstance(value, dict):
        members = (
            (key, _place(each, at), tree(each, at))
            for key, each in value.items()
            if not _unknown(each)
        )
        return mapping(members, at)
    if isinstance(value, (list, tuple)):
        return sequence([tree(each, at) for each in value], at)
    return scalar(value, at)


def _unknown(value: Any) -> bool:
    return value is None or (isinstance(value, Value) and value.value is None)


def _place(value: Any, at: Span) -> Span:
    return value.at if isinstance(value, Value) else at
