"""Tracks the calls of a capture: its objects, the contents of command buffers, and the submitted
frames.

Each call has a method named after it, without the vendor suffix; other calls are ignored. Captures
are untrusted: an invalid argument makes a value unknown and never stops the tracker.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any, NamedTuple

from msaa_lint.frame.description.models import Framebuffer as FramebufferRecord
from msaa_lint.frame.spirv.bindings import image_bindings
from msaa_lint.frame.spirv.words import SpirvError

from . import set_layouts, values
from .call import Call, Mark, without_vendor
from .command_buffers import RecordedCommand
from .create_infos import pipeline_of, render_pass_of
from .frame_ends import FrameLabel
from .frame_marks import FrameMarks, xr_handlers
from .labels import printable
from .layouts import UNSEEN
from .objects import CapturedObject, Framebuffer, Pipeline, RenderPass
from .recordings import UNCHANGING, Recordings
from .set_layouts import ShaderImages
from .structures import Tree, containers, to_tree
from .transfers import Transfers

BOUNDARY = frozenset(
    f"vkCmd{name}"
    for name in (
        "BeginRenderPass", "BeginRenderPass2", "NextSubpass", "NextSubpass2", "EndRenderPass",
        "EndRenderPass2", "BeginRendering",
        "EndRendering", "EndRendering2",
    )
)  # fmt: skip
RECURRING = BOUNDARY | {
    name.replace("on_", "vk", 1) for name in vars(Transfers) if name.startswith("on_")
}
"""Commands whose effect depends only on their arguments."""

DESTROYERS = {
    "FreeMemory": ("memory", "memory"),
    "DestroyRenderPass": ("renderPass", "render_passes"),
    "DestroyFramebuffer": ("framebuffer", "framebuffers"),
}
"""The calls that only destroy objects: the parameter with their handles, and the tracker's mapping
that holds them.
"""

MAX_CONTAINERS = 500_000
"""Maximum number of structures and arrays in all different render passes and pipelines that exist
at a time. 256 bytes of shader code count as one.
"""

MAX_DESTROYED = 50_000
"""Maximum number of them in those that were destroyed, which a program may create again."""

MIN_DESTROYED = 4096
"""Minimum number of objects that are destroyed between two searches for them."""

TOO_MANY_STRUCTURES = (
    f"render passes and pipelines have more than {MAX_CONTAINERS:,} structures; "
    "further ones are not followed"
)

MAX_STAGES = 16
"""Maximum number of stages of a pipeline whose shaders are read; with more, it is unknown what they
read.
"""

MAX_SHADER_IMAGES = 256
"""Maximum number of images that a shader declares; of a shader with more it is unknown what it
reads.
"""

MAX_WORDS = 4_000_000
"""Maximum number of words of declarations in shaders; what further shaders read is unknown."""

MAX_CACHED_COMMANDS = 4096
"""Maximum number of commands cached by their arguments."""

MAX_ROUTES = 4096
"""Maximum number of names of calls that are remembered."""

RECURS, BEGINS_OR_ENDS, DESTROYS, CHANGES = 1, 2, 3, 4
"""How a call is processed: commands whose effect is cached, those of them in BOUNDARY, calls that
destroy objects, and others that may change what commands refer to.
"""

Route = tuple[Callable[[Call], None], int]


class CachedCommand(NamedTuple):
    """The effect of a command, cached by the identity of its arguments, because readers reuse the
    arguments of identical calls.

    `generation` is the tracker's when the command was recorded; `boundary` says whether it begins
    or ends a pass or subpass.
    """

    args: dict[str, Any]
    generation: int
    boundary: bool
    commands: list[RecordedCommand]


class Tracker(FrameMarks):
    """The state of one capture. Call `feed` for each call in order, then `finish`. `frame_end` is
    the option `--frame-end`.
    """

    def __init__(self, frame_end: str | None = None) -> None:
        super().__init__()
        if frame_end is not None:
            self.frames.frame_end, _, text = frame_end.partition(":")
            self.frames.frame_label = FrameLabel(text) if text else None
        self.modules: dict[int, bytes] = {}
        self.shader_images: dict[int, dict[str, ShaderImages | None]] = {}
        """The images that the entry points of modules declare, as far as pipelines have used
        them.
        """
        self._words_left = MAX_WORDS
        self.generation = 0
        """The number of destroyed objects. After a destruction, a handle may refer to another
        object.
        """
        self._changes = 0
        """The number of calls after which commands may refer to other objects."""
        self._recordings = Recordings(self._process, self.buffers)
        self._routes: dict[str, Route] = {}
        """By the name of the call, with its vendor suffix."""
        self._cache: dict[int, CachedCommand] = {}
        self._containers = 0
        self._next_count = MAX_DESTROYED
        self._next_generation = 0
        """The number of structures above which destroyed objects are forgotten, and the generation
        from which on.
        """
        self.distinct: dict[Hashable, RenderPass | Pipeline] = {}
        """Render passes and pipelines by their creation parameters, those created last at the
        end.
        """
        self.handlers: dict[str, Callable[[Call], None]] = {
            "vk" + name[len("on_") :]: getattr(self, name)
            for name in dir(self)
            if name.startswith("on_")
        }
        for name, (parameter, objects) in DESTROYERS.items():
            self.handlers[f"vk{name}"] = partial(_remove, getattr(self, objects), parameter)
        self.handlers |= xr_handlers(self)
        self.handlers["SetDevicePropertiesCommand"] = self.device_properties_command
        self.handlers["SetDeviceMemoryPropertiesCommand"] = self.memory_properties_command

    @property
    def wanted(self) -> frozenset[str]:
        """The names of the tracked calls, without vendor suffixes."""
        return frozenset(self.handlers)

    def feed(self, call: Call | Mark) -> None:
        """Processes one call or mark."""
        recordings = self._recordings
        if call[1] is recordings.expected[recordings.position]:
            recordings.position += 1
        elif recordings.is_active or call[0] == "vkBeginCommandBuffer":
            recordings.follow(call, (self._changes, self.commands.forgotten))
        else:
            self._process(call)

    def _process(self, call: Call | Mark) -> None:
        handler, way = self._routes.get(call[0]) or self._route(call[0])
        if isinstance(call, Mark):
            self.frames.mark(call.kind)
            if call.kind in ("trimmed", "frameless"):
                self.layouts.initial = frozenset((UNSEEN,))
        elif way in (RECURS, BEGINS_OR_ENDS):
            cached = self._cache.get(id(call.args))
            if (
                cached is not None
                and cached.args is call.args
                and cached.generation == self.generation
            ):
                self._replay(cached, call)
            else:
                self._record(handler, call, way == BEGINS_OR_ENDS)
        elif not call.failed or call.name == "vkQueuePresentKHR":
            # A present ends the frame although the surface is out of date.
            if way:
                self._changes += 1
                if way == DESTROYS:
                    self.generation += 1
            handler(call)

    def _route(self, name: str) -> Route:
        """How a call is processed; calls without a handler are ignored."""
        plain_name = name if name in self.handlers else without_vendor(name)
        way = DESTROYS if plain_name.startswith("vkDestroy") else 0
        if not way and plain_name in self.handlers and not plain_name.startswith(UNCHANGING):
            way = CHANGES
        if plain_name in RECURRING:
            way = BEGINS_OR_ENDS if plain_name in BOUNDARY else RECURS
        route = self.handlers.get(plain_name, _ignore), way
        if len(self._routes) < MAX_ROUTES:
            self._routes[name] = route
        return route

    def _record(self, handler: Callable[[Call], None], call: Call, boundary: bool) -> None:
        """Processes a recurring command and caches its effect."""
        buffer = self.buffer(call)
        start = len(buffer.commands)
        handler(call)
        commands: list[RecordedCommand] = buffer.commands[start:]  # type: ignore[assignment]  # None of these executes others.
        if commands or boundary:
            if len(self._cache) >= MAX_CACHED_COMMANDS:
                self._cache.clear()
            self._cache[id(call.args)] = CachedCommand(
                call.args, self.generation, boundary, commands
            )

    def _replay(self, cached: CachedCommand, call: Call) -> None:
        buffer = self.buffer(call)
        if cached.boundary:
            buffer.start_section()
            for command in cached.commands:
                buffer.record_boundary(command)
            return
        for command in cached.commands:
            (buffer.record_once if command.kind == "clearAttachments" else buffer.record)(command)

    def finish(self) -> None:
        """Ends the capture: the commands since the last present are the last frame."""
        self.layouts.finish()
        self.frames.end_of_capture()

    # Render passes and framebuffers.

    def on_CreateRenderPass(self, call: Call) -> None:
        tree = render_pass_of(values.record(call.args.get("pCreateInfo")))
        handle = values.handle(call.args.get("pRenderPass"))
        render_pass = self._deduplicate(RenderPass, call, tree)
        if render_pass is not None:
            self.render_passes[handle] = render_pass
        else:
            self.render_passes.pop(handle, None)

    on_CreateRenderPass2 = on_CreateRenderPass

    def _deduplicate(
        self,
        kind: Callable[..., Any],
        call: Call,
        tree: Tree,
        related: RenderPass | None = None,
        code: int = 0,
    ) -> Any:
        """The object of a kind created earlier from the same parameters, or a new one; None if
        there are too many different ones. `code` is the number of bytes of its shaders.
        """
        digest = hashlib.blake2b(
            repr(tree).encode("utf-8", "surrogatepass"), digest_size=16
        ).digest()
        key = (kind, related.number if related is not None else None, digest)
        existing = self.distinct.pop(key, None)
        if existing is None:
            weight = containers(tree) + code // 256
            self._containers += weight
            if (
                self._containers > min(self._next_count, MAX_CONTAINERS)
                and self.generation >= self._next_generation
            ):
                self._forget_destroyed()
                self._containers += weight
            if self._containers > MAX_CONTAINERS:
                self.frames.limits.setdefault(TOO_MANY_STRUCTURES, call.at)
                return None
            arguments = (related,) if kind is Pipeline else ()
            existing = kind(call, next(self.numbers[kind]), tree, *arguments)
        self.distinct[key] = existing
        return existing

    def _forget_destroyed(self) -> None:
        """Forgets the objects that were destroyed, except those created last."""
        pipelines = self.pipelines.values()
        existing: set[object] = {
            *self.render_passes.values(),
            *pipelines,
            *(pipeline.render_pass for pipeline in pipelines),
        }
        kept = []
        self._containers = destroyed = 0
        for key, each in reversed(self.distinct.items()):
            weight = containers(each.tree)
            if isinstance(each, Pipeline):
                weight += sum(map(len, each.modules.values())) // 256
            if each not in existing:
                destroyed += weight
                if destroyed > min(MAX_DESTROYED // 2, MAX_CONTAINERS // 4):
                    continue
            self._containers += weight
            kept.append((key, each))
        self.distinct = dict(reversed(kept))
        self._next_count = self._containers + self._containers // 2 + MAX_DESTROYED // 2
        self._next_generation = self.generation + MIN_DESTROYED

    def on_CreateFramebuffer(self, call: Call) -> None:
        info = values.record(call.args.get("pCreateInfo"))
        tree = to_tree(
            FramebufferRecord,
            {key: item for key, item in info.items() if key not in ("pAttachments", "attachments")},
        )
        imageless = "IMAGELESS" in tree.get("flags", ())
        views = values.items(info.get("pAttachments"))[:64]
        images = None if imageless else tuple(map(self.view, views))
        handle = values.handle(call.args.get("pFramebuffer"))
        size: Tree = {
            member: tree[member] for member in ("width", "height", "layers") if member in tree
        }
        self.framebuffers[handle] = Framebuffer(
            call, next(self.numbers[Framebuffer]), size, images, self.parts_of(views)
        )

    # Shaders and pipelines.

    def on_CreateShaderModule(self, call: Call) -> None:
        code = values.record(call.args.get("pCreateInfo")).get("pCode")
        handle = values.handle(call.args.get("pShaderModule"))
        self.shader_images.pop(handle, None)
        if isinstance(code, bytes):
            self.modules[handle] = code

    def on_DestroyShaderModule(self, call: Call) -> None:
        handle = values.handle(call.args.get("shaderModule"))
        self.modules.pop(handle, None)
        self.shader_images.pop(handle, None)

    def on_DestroyPipeline(self, call: Call) -> None:
        handle = values.handle(call.args.get("pipeline"))
        self.pipelines.pop(handle, None)
        self.pipeline_bindings.pop(handle, None)

    def on_CreateGraphicsPipelines(self, call: Call) -> None:
        infos = values.items(call.args.get("pCreateInfos"))
        for info, handle in zip(infos, values.items(call.args.get("pPipelines")), strict=False):
            tree, modules = pipeline_of(values.record(info), self.modules)
            render_pass = self.render_passes.get(
                values.handle(values.record(info).get("renderPass"))
            )
            if render_pass is not None and tree.get("subpass", 0) >= max(
                len(render_pass.tree.get("subpasses", ())), 1
            ):
                del tree["subpass"]
            code = sum(map(len, modules.values()))
            pipeline: Pipeline | None = self._deduplicate(Pipeline, call, tree, render_pass, code)
            if pipeline is not None and self.has_room(self.pipelines, call):
                pipeline.modules.update(modules)
                self.pipelines[values.handle(handle)] = pipeline
            else:
                self.pipelines.pop(values.handle(handle), None)
        self._bindings(call, set_layouts.GRAPHICS)

    def on_CreateComputePipelines(self, call: Call) -> None:
        self._bindings(call, set_layouts.COMPUTE)

    def on_CreateRayTracingPipelines(self, call: Call) -> None:
        self._bindings(call, set_layouts.RAY_TRACING)

    def _bindings(self, call: Call, stages: int) -> None:
        """Keeps what new pipelines can read of descriptor sets."""
        for item, handle in zip(
            values.items(call.args.get("pCreateInfos")),
            values.items(call.args.get("pPipelines")),
            strict=False,
        ):
            info = values.record(item)
            self.pipeline_bindings.pop(values.handle(handle), None)
            if self.has_room(self.pipeline_bindings, call):
                bindings = self.bindings_of(
                    info.get("layout"), stages, self._images_of_shaders(info)
                )
                self.pipeline_bindings[values.handle(handle)] = bindings

    def _images_of_shaders(self, info: dict[str, Any]) -> ShaderImages | None:
        """The images that the shaders of a pipeline declare; None if the code of one of them is
        unknown.
        """
        stages = values.items(info.get("pStages")) or [info.get("stage")]
        found: dict[tuple[int, int], frozenset[bool]] = {}
        if values.chained(info, "PIPELINE_LIBRARY_CREATE_INFO") is not None:
            return None
        for stage in map(values.record, stages[:MAX_STAGES]):
            handle, name = values.handle(stage.get("module")), values.text(stage.get("pName"))
            code = self.modules.get(handle)
            if code is None or name is None:
                return None
            of_module = self.shader_images.setdefault(handle, {})
            if name not in of_module:
                of_module[name] = self._images_of(code, name)
            images = of_module[name]
            if images is None:
                return None
            for place, multisampled in images.items():
                found[place] = found.get(place, frozenset()) | multisampled
        return found if len(stages) <= MAX_STAGES else None

    def _images_of(self, code: bytes, name: str) -> ShaderImages | None:
        """The images that an entry point declares; None if the module is invalid, or many large
        ones came before it.
        """
        if len(code) > 4 * self._words_left:
            return None
        try:
            images, words = image_bindings(code, name)
        except SpirvError:
            return None
        self._words_left -= words
        return images if len(images) <= MAX_SHADER_IMAGES else None

    # Names.

    def on_SetDebugUtilsObjectName(self, call: Call) -> None:
        info = values.record(call.args.get("pNameInfo"))
        namer = (
            _object_type(info.get("objectType")),
            values.handle(info.get("objectHandle", info.get("object"))),
        )
        kind, handle = namer
        objects: dict[int, CapturedObject] = getattr(self, LABELED.get(kind, ""), {})
        created = self.view(handle) if kind == "IMAGE_VIEW" else objects.get(handle)
        if created is None:
            return
        # An object may stand for several that were created alike. An image's own name counts more
        # than its view's.
        if (
            created.namer is None
            or created.namer == namer
            or (kind == "IMAGE" and created.namer[0] == "IMAGE_VIEW")
        ):
            created.label = printable(values.text(info.get("pObjectName")) or "")
            created.namer = namer if created.label else None

    on_DebugMarkerSetObjectName = on_SetDebugUtilsObjectName


def _ignore(call: Call) -> None:
    """Processes a call without a handler."""


def _remove(objects: dict[int, Any], parameter: str, call: Call) -> None:
    """Removes the objects that a call destroys."""
    handles = call.args.get(parameter)
    for handle in handles if isinstance(handles, list) else (handles,):
        objects.pop(values.handle(handle), None)


_TYPES = {
    10: "IMAGE", 14: "IMAGE_VIEW", 18: "RENDER_PASS", 19: "PIPELINE", 24: "FRAMEBUFFER",
    27: "SWAPCHAIN_KHR", 1000001000: "SWAPCHAIN_KHR"
}  # fmt: skip
"""VkObjectType and VkDebugReportObjectTypeEXT."""
LABELED = {
    "IMAGE": "images",
    "RENDER_PASS": "render_passes",
    "FRAMEBUFFER": "framebuffers",
    "PIPELINE": "pipelines",
    "SWAPCHAIN_KHR": "swapchains",
}
"""The tracker's mappings of objects that have debug names."""


def _object_type(kind: object) -> str:
    number = values.integer(kind)
    if number is not None:
        return _TYPES.get(number, "")
    name = (
        values.enumerant_name(kind)
        .removeprefix("VK_OBJECT_TYPE_")
        .removeprefix("VK_DEBUG_REPORT_OBJECT_TYPE_")
    )
    return name.removesuffix("_EXT")
