"""Follows the calls of a capture: what exists, what is recorded, and which frames are submitted.

One method a call, found by the call's name without its vendor suffix; a call without a method is passed over. What a call states badly is
unknown, and never stops the rest: captures come from strangers.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, NamedTuple

from msaa_lint.frame.description.models import Framebuffer as FramebufferRecord

from . import values
from .call import Call, Mark
from .call_names import bare
from .command_buffers import CommandBuffer, Commands, Recorded
from .descriptors import Descriptors
from .frames import Frames
from .images import MAX_DISTINCT, Images
from .objects import Created, Framebuffer, Pipeline, RenderPass, frozen
from .pipelines import pipelines_of
from .render_passes import render_pass_of
from .structures import described
from .transfers import Transfers

BOUNDARY = frozenset(
    f"vkCmd{name}"
    for name in (
        "BeginRenderPass", "BeginRenderPass2", "NextSubpass", "NextSubpass2", "EndRenderPass", "EndRenderPass2", "BeginRendering",
        "EndRendering", "EndRendering2",
    )
)  # fmt: skip
RECURRING = BOUNDARY | {name.replace("on_", "vk", 1) for name in vars(Transfers) if name.startswith("on_")}
"""Commands that record the same whenever their arguments are the same, whatever was recorded before them."""

MAX_KNOWN = 4096
"""So many commands are remembered with their arguments."""


class Known(NamedTuple):
    """What a command recorded: its arguments (the very object, which a reader gives again where the call is written alike), when that was,
    and whether it is where a pass or a subpass begins or ends."""

    args: dict[str, Any]
    generation: int
    boundary: bool
    recorded: list[Recorded]


class Tracker(Images, Descriptors, Transfers):
    """The state of one capture. Feed it the calls in their order, then `finish`."""

    def __init__(self) -> None:
        Images.__init__(self)
        Descriptors.__init__(self)
        self.render_passes: dict[int, RenderPass] = {}
        self.framebuffers: dict[int, Framebuffer] = {}
        self.pipelines: dict[int, Pipeline] = {}
        self.modules: dict[int, bytes] = {}
        self.buffers: dict[int, CommandBuffer] = {}
        self.pools: dict[int, set[int]] = {}
        self.frames = Frames()
        self.commands = Commands()
        self.generation = 0
        """Counts the objects that were destroyed: from then on a handle may be another's."""
        self._known: dict[int, Known] = {}
        self.distinct: dict[Hashable, Any] = {}
        """Render passes and pipelines by what they were created from."""
        self.handlers: dict[str, Callable[[Call], None]] = {
            "vk" + name[len("on_") :]: getattr(self, name) for name in dir(self) if name.startswith("on_")
        }
        self.handlers["SetDevicePropertiesCommand"] = self.device_properties_command
        self.handlers["SetDeviceMemoryPropertiesCommand"] = self.memory_properties_command

    @property
    def wanted(self) -> frozenset[str]:
        """The calls that are followed, without vendor suffixes."""
        return frozenset(self.handlers)

    def feed(self, call: Call | Mark) -> None:
        """Follows one call."""
        if isinstance(call, Mark):
            self.frames.mark(call.kind)
            return
        known = self._known.get(id(call.args))
        if known is not None and known.args is call.args and known.generation == self.generation:
            self._again(known, call)
            return
        name = call.name
        handler = self.handlers.get(name)
        if handler is None:
            name = bare(name)
            handler = self.handlers.get(name)
        if handler is None or (call.result is not None and call.result.startswith("VK_ERROR")):
            return
        if name in RECURRING:
            self._first(handler, call, name in BOUNDARY)
            return
        if name.startswith("vkDestroy"):
            self.generation += 1
        handler(call)

    def _first(self, handler: Callable[[Call], None], call: Call, boundary: bool) -> None:
        """Follows a command that records the same whenever it comes with the same arguments, and remembers what."""
        buffer = self.buffer(call)
        before = len(buffer.recorded)
        handler(call)
        recorded = buffer.recorded[before:]
        if recorded or boundary:
            if len(self._known) >= MAX_KNOWN:
                self._known.clear()
            self._known[id(call.args)] = Known(call.args, self.generation, boundary, recorded)

    def _again(self, known: Known, call: Call) -> None:
        buffer = self.buffer(call)
        if known.boundary:
            buffer.boundary()
            buffer.recorded.extend(known.recorded)
            return
        for each in known.recorded:
            (buffer.once if each.kind == "clearAttachments" else buffer.record)(each)

    def finish(self) -> None:
        """What was submitted since the last present is the last frame."""
        self.frames.end_of_capture()

    # Render passes and framebuffers.

    def on_CreateRenderPass(self, call: Call) -> None:
        self._render_pass(call)

    def on_CreateRenderPass2(self, call: Call) -> None:
        self._render_pass(call)

    def _render_pass(self, call: Call) -> None:
        tree = render_pass_of(values.record(call.args.get("pCreateInfo")))
        handle = values.handle(call.args.get("pRenderPass"))
        self.render_passes[handle] = self._alike(("renderPass", frozen(tree)), lambda: RenderPass(call, self.number("render pass"), tree))

    def _alike(self, key: Hashable, make: Callable[[], Any]) -> Any:
        """The object that was created from the same before; a new one else."""
        found = self.distinct.get(key)
        if found is None:
            found = make()
            if len(self.distinct) < MAX_DISTINCT:
                self.distinct[key] = found
        return found

    def on_DestroyRenderPass(self, call: Call) -> None:
        self.render_passes.pop(values.handle(call.args.get("renderPass")), None)

    def on_CreateFramebuffer(self, call: Call) -> None:
        info = values.record(call.args.get("pCreateInfo"))
        tree = described(FramebufferRecord, {key: item for key, item in info.items() if key not in ("pAttachments", "attachments")})
        imageless = "IMAGELESS" in tree.get("flags", ())
        views = values.items(info.get("pAttachments"))
        images = None if imageless else tuple(self.view(view) for view in views[:64])
        render_pass = self.render_passes.get(values.handle(info.get("renderPass")))
        handle = values.handle(call.args.get("pFramebuffer"))
        made = Framebuffer(call, self.number("framebuffer"), render_pass, images)
        made.width, made.height, made.layers = tree.get("width"), tree.get("height"), tree.get("layers")
        self.framebuffers[handle] = made

    def on_DestroyFramebuffer(self, call: Call) -> None:
        self.framebuffers.pop(values.handle(call.args.get("framebuffer")), None)

    # Shaders and pipelines.

    def on_CreateShaderModule(self, call: Call) -> None:
        code = values.record(call.args.get("pCreateInfo")).get("pCode")
        if isinstance(code, bytes):
            self.modules[values.handle(call.args.get("pShaderModule"))] = code

    def on_DestroyShaderModule(self, call: Call) -> None:
        self.modules.pop(values.handle(call.args.get("shaderModule")), None)

    def on_CreateGraphicsPipelines(self, call: Call) -> None:
        infos = values.items(call.args.get("pCreateInfos"))
        for info, handle in zip(infos, values.items(call.args.get("pPipelines")), strict=False):
            tree, modules = pipelines_of(values.record(info), self.modules)
            render_pass = self.render_passes.get(values.handle(values.record(info).get("renderPass")))
            number = values.handle(handle)
            if render_pass is not None and tree.get("subpass", 0) >= max(len(render_pass.tree.get("subpasses", ())), 1):
                del tree["subpass"]

            def make(tree: dict[str, Any] = tree, render_pass: RenderPass | None = render_pass) -> Pipeline:
                return Pipeline(call, self.number("pipeline"), tree, render_pass)

            made: Pipeline = self._alike(("pipeline", render_pass, frozen(tree)), make)
            made.modules.update(modules)
            self.pipelines[number] = made

    def on_DestroyPipeline(self, call: Call) -> None:
        self.pipelines.pop(values.handle(call.args.get("pipeline")), None)

    # Names.

    def on_SetDebugUtilsObjectName(self, call: Call) -> None:
        info = values.record(call.args.get("pNameInfo"))
        kind = info.get("objectType")
        self._named(kind, info.get("objectHandle"), values.text(info.get("pObjectName")), "VK_OBJECT_TYPE_")

    def on_DebugMarkerSetObjectName(self, call: Call) -> None:
        info = values.record(call.args.get("pNameInfo"))
        self._named(info.get("objectType"), info.get("object"), values.text(info.get("pObjectName")), "VK_DEBUG_REPORT_OBJECT_TYPE_")

    def _named(self, kind: object, handle: object, name: str | None, prefix: str) -> None:
        number = values.handle(handle)
        kinds: dict[str, dict[int, Any]] = {
            "IMAGE": self.images,
            "RENDER_PASS": self.render_passes,
            "FRAMEBUFFER": self.framebuffers,
            "PIPELINE": self.pipelines,
            "SWAPCHAIN_KHR": self.swapchains,
        }
        word = _object_type(kind, prefix)
        if name and word in kinds and number:
            found: Created | None = kinds[word].get(number)
            if found is not None and not found.label:
                found.label = name[:MAX_NAME]


MAX_NAME = 80
_TYPES = {10: "IMAGE", 18: "RENDER_PASS", 19: "PIPELINE", 24: "FRAMEBUFFER", 1000001000: "SWAPCHAIN_KHR"}
"""VkObjectType."""


def _object_type(kind: object, prefix: str) -> str:
    number = values.integer(kind)
    if number is not None:
        return _TYPES.get(number, "")
    return values.named(kind).removeprefix(prefix).removesuffix("_EXT")
