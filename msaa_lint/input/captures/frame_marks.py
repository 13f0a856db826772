"""Tracks what marks the end of a frame besides presents: debug labels, if the user names one, and
OpenXR.
"""

from __future__ import annotations

from typing import Any

from msaa_lint.frame.description.models import Image as ImageRecord

from . import values
from .call import Call
from .objects import Swapchain
from .structures import to_tree
from .transfers import Transfers

XR_USAGE = {
    1: "COLOR_ATTACHMENT", 2: "DEPTH_STENCIL_ATTACHMENT", 4: "STORAGE", 8: "TRANSFER_SRC",
    16: "TRANSFER_DST", 32: "SAMPLED",
    128: "INPUT_ATTACHMENT",
}  # fmt: skip
"""XrSwapchainUsageFlagBits as VkImageUsageFlagBits."""

XR_USAGE_NAMES = {name: name for name in XR_USAGE.values()} | {"UNORDERED_ACCESS": "STORAGE"}


class LabelDepth:
    """How many labels are open in a command buffer or a queue, and at which depth the one that ends
    frames is; 0 if it is not.
    """

    __slots__ = ("depth", "frame")

    def __init__(self) -> None:
        self.depth = 0
        self.frame = 0

    def begin(self, ends_frames: bool) -> str:
        """Opens a label; returns what that means for the frame."""
        self.depth += 1
        if not ends_frames:
            return ""
        self.frame = self.depth
        return "begin"

    def end(self) -> str:
        """Closes a label; returns what that means for the frame."""
        if not self.depth:
            return "outer end"
        is_frame = self.depth == self.frame
        self.depth -= 1
        if is_frame:
            self.frame = 0
        return "end" if is_frame else ""


class FrameMarks(Transfers):
    """Tracks the marks of a capture."""

    def __init__(self) -> None:
        super().__init__()
        self._queue_depths: dict[int, LabelDepth] = {}

    # Debug labels.

    def follow_label(self, call: Call, event: str) -> None:
        """Marks where the label that ends frames begins, ends, or is inserted: in a command buffer
        for its submissions, in a queue now.
        """
        label = self.frames.frame_label
        if label is None:
            return
        info = values.record(call.args.get("pLabelInfo") or call.args.get("pMarkerInfo"))
        is_frame = event != "end" and label.matches(
            values.text(info.get("pLabelName") or info.get("pMarkerName")) or ""
        )
        if call.name.startswith("vkCmd"):
            buffer = self.buffer(call)
            depth = buffer.label_depth = buffer.label_depth or LabelDepth()
        else:
            buffer = None
            depth = self._queue_depths.setdefault(
                values.handle(call.args.get("queue")), LabelDepth()
            )
        mark = (
            depth.end()
            if event == "end"
            else depth.begin(is_frame)
            if event == "begin"
            else "insert"
            if is_frame
            else ""
        )
        if mark and buffer is not None:
            buffer.record(self.commands.command("frameMark", mark, call))
        elif mark:
            self.frames.label_mark(mark)

    # OpenXR. gfxreconstruct writes its calls between those of Vulkan.

    def xr_CreateSwapchain(self, call: Call) -> None:
        info = values.record(call.args.get("createInfo"))
        faces = values.integer(info.get("faceCount")) or 1
        structure = {
            "format": values.integer(info.get("format")),
            "samples": values.integer(info.get("sampleCount")),
            "usage": xr_usage(info.get("usageFlags")),
            "extent": {"width": info.get("width"), "height": info.get("height"), "depth": 1},
            "mipLevels": info.get("mipCount"),
            "arrayLayers": (values.integer(info.get("arraySize")) or 1) * faces,
            "imageType": "2D",
        }
        swapchain = Swapchain(call, next(self.numbers[Swapchain]), to_tree(ImageRecord, structure))
        self.swapchains[values.handle(call.args.get("swapchain"))] = swapchain
        self.frames.start_openxr()

    def xr_DestroySwapchain(self, call: Call) -> None:
        self.on_DestroySwapchain(call)

    def xr_EnumerateSwapchainImages(self, call: Call) -> None:
        swapchain = self.swapchains.get(values.handle(call.args.get("swapchain")))
        handles = [
            values.record(item).get("image") for item in values.items(call.args.get("images"))
        ]
        if swapchain is not None:
            # The compositor reads them.
            self.add_swapchain_images(swapchain, handles, call, shared=True)

    def xr_EndFrame(self, call: Call) -> None:
        self.frames.end_of_openxr_frame()


def xr_usage(value: object) -> list[str] | None:
    """XrSwapchainUsageFlags, a number or names, as the names of VkImageUsageFlagBits; None if
    unknown.
    """
    number = values.integer(value)
    if number is not None:
        return [name for bit, name in XR_USAGE.items() if number & bit]
    if not isinstance(value, str):
        return None
    words = [
        word.strip().removeprefix("XR_SWAPCHAIN_USAGE_").removesuffix("_BIT")
        for word in value.split("|")
    ]
    return [XR_USAGE_NAMES[word] for word in words if word in XR_USAGE_NAMES]


def xr_handlers(tracker: Any) -> dict[str, Any]:
    """The handlers of OpenXR calls, by the name of the call."""
    return {
        "xr" + name[len("xr_") :]: getattr(tracker, name)
        for name in dir(tracker)
        if name.startswith("xr_")
    }
