"""A render target with the engine's defaults for what it leaves out, each choice at the place of its reason."""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.models import FrameSize, RenderTarget
from msaa_lint.frame.description.record import Record

from . import words
from .value_tree import Value

COLOR = {"storageMode": "kDevicePrivate", "resolveStorageMode": "kDevicePrivate", "loadAction": "kClear", "storeAction": "kStore"}
"""`RenderTarget::kDefaultColorAttachmentConfig`."""

COLOR_MSAA = {**COLOR, "storageMode": "kDeviceTransient", "storeAction": "kMultisampleResolve"}
"""`RenderTarget::kDefaultColorAttachmentConfigMSAA`."""

STENCIL = {"storageMode": "kDeviceTransient", "loadAction": "kClear", "storeAction": "kDontCare"}
"""`RenderTarget::kDefaultStencilAttachmentConfig`: for depth and stencil alike, which are one texture."""


class Config:
    """An attachment's storage mode, its resolve texture's, its load and its store action."""

    def __init__(self, owner: RenderTarget, member: str, defaults: dict[str, str]) -> None:
        record: Record | None = getattr(owner, member)
        self.storage, self.resolve_storage, self.load, self.store = (
            member_or_default(record, name, defaults.get(name), owner.head)
            for name in ("storageMode", "resolveStorageMode", "loadAction", "storeAction")
        )


class Target:
    """What the engine is asked for. `at` is the target's name, where all stands that is not stated."""

    def __init__(self, name: str, record: RenderTarget, frame: FrameSize | None) -> None:
        api = record.api or ""
        self.name = name
        self.at = record.head
        self.onscreen = bool(record.onscreen)
        self.width, self.height = (_size(record, side, frame) for side in ("width", "height"))
        count = member_or_default(record, "sampleCount", 1, self.at)
        self.samples = Value(words.sample_count(count.value), count.at)
        self.multisampled = self.samples.value > 1
        self.color = Config(record, "colorAttachmentConfig", COLOR_MSAA if self.multisampled else COLOR)
        self.depth_stencil = Config(record, "stencilAttachmentConfig", STENCIL)
        self.color_format = member_or_default(record, "colorFormat", words.DEFAULT_COLOR[api], self.at)
        self.depth_format = member_or_default(record, "depthFormat", words.DEFAULT_DEPTH_STENCIL[api], self.at)
        self.has_depth_stencil = record.depthFormat is not None or record.enableStencil is not False
        self.has_depth = self.depth_format.value != "kS8UInt"
        self.has_stencil = record.enableStencil is not False

    @property
    def resolves(self) -> bool:
        """Whether the colour's store action asks for a resolve."""
        return self.color.store.value in words.RESOLVES


def member_or_default(record: Record | None, member: str, default: object, at: Span) -> Value:
    """What a record states for a member, at its value; the default, at a place, where it states nothing."""
    if record is None or not record.states(member):
        return Value(default, at)
    return Value(getattr(record, member), record.spelled[member][1].span)


def _size(record: RenderTarget, side: str, frame: FrameSize | None) -> Value | None:
    """A side in texels: the target's, else the frame's; None where neither is stated."""
    for owner in (record, frame):
        if owner is not None and owner.states(side):
            return Value(getattr(owner, side), owner.spelled[side][1].span)
    return None


def sections(node: Node, names: tuple[str, ...]) -> dict[str, Value]:
    """Those sections of a description that go on as they are."""
    return {name: Value(node.value[name], node.keys[name].span) for name in names if name in node.value}
