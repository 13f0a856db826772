"""Converts a Metal frame to the equivalent Vulkan frame. Every value keeps its place in the Metal
text.

A texture becomes an image. A render pass descriptor becomes a render pass with one subpass, whose
attachments include the resolve textures. A command that encodes a pass begins and ends it. Unstated
values stay unstated. From Apple's documentation: `multisampleResolve` leaves the samples undefined;
a memoryless texture is a render target without contents before or after a pass; a depth resolve
without a filter takes sample 0; a drawable, or a texture whose type is not multisampled, has one
sample.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.bind import Binder
from msaa_lint.frame.description.document import Lowered
from msaa_lint.frame.description.models import (
    Command,
    Description,
    Image,
    Metal,
    MetalCommand,
    MetalPipelineColor,
    MetalRead,
    MetalRenderPass,
    MetalRenderPipeline,
    MetalTexture,
    MetalWrite,
    Pipeline,
    RenderPass,
)
from msaa_lint.frame.description.record import Record
from msaa_lint.frame.metal.formats import PIXEL_FORMATS
from msaa_lint.frame.metal.names import MULTISAMPLE_TYPES
from msaa_lint.frame.vulkan.formats import format_of

from .metal_pass import (
    Items,
    PassTree,
    attachments_of,
    by_index,
    first_stated,
    key_of,
    placed,
    renamed,
    resolves,
)

BESIDE = ("images", "renderPasses", "framebuffers", "pipelines", "commands")
"""The sections of a Vulkan frame."""

_USAGE = {"shaderRead": "SAMPLED", "shaderWrite": "STORAGE", "shaderAtomic": "STORAGE"}
_COMMANDS = {
    "copy": ("copyImage", {"source": "srcImage", "destination": "dstImage"}),
    "readTexture": (
        "readImage",
        {"texture": "image", "samples": "samples", "resolves": "resolves"},
    ),
    "writeTexture": ("writeImage", {"texture": "image"}),
}
_STAGES = {"vertex": "VERTEX", "fragment": "FRAGMENT", "compute": "COMPUTE", "tile": "FRAGMENT"}


def check(binder: Binder, description: Description) -> None:
    """Reports Vulkan sections beside `metal`: a frame is described in one API."""
    metal = description.metal
    assert metal is not None
    beside = [section for section in BESIDE if description.states(section)]
    if beside:
        key = description.spelled["metal"][0]
        help = (
            "describe the frame either in `metal` or in Vulkan's sections; only `frame`, "
            "`device` and `scene` are allowed beside `metal`"
        )
        binder.report(
            "MSAA903",
            f"`metal` cannot be combined with the Vulkan section `{beside[0]}`",
            key.span,
            "metal",
            help,
        )


def lower(description: Description) -> Lowered:
    """Adds the Vulkan records for `metal` to a valid description, and returns the Metal structures
    behind each attachment.
    """
    assert description.metal is not None
    return _Lowering(description, description.metal).lowered()


class _Lowering:
    """The conversion of one frame."""

    def __init__(self, description: Description, metal: Metal) -> None:
        self.description = description
        self.metal = metal
        self.binder = Binder()
        self.made = Lowered({}, {})
        self.used_as: dict[str, set[str]] = {}
        """The aspects for which passes attach each texture."""

    def lowered(self) -> Lowered:
        description, metal, bind = self.description, self.metal, self.binder.record
        for each in metal.renderPasses.values():
            for aspect, attachment in attachments_of(each):
                for name in (attachment.texture, attachment.resolveTexture):
                    if name is not None:
                        self.used_as.setdefault(name, set()).add(aspect)
        description.images = {
            name: bind(Image, self.image(name, texture), texture.path, name, texture.head)
            for name, texture in metal.textures.items()
        }
        description.renderPasses = {
            name: self.render_pass(name, each) for name, each in metal.renderPasses.items()
        }
        description.pipelines = {
            name: bind(Pipeline, self.pipeline(each), each.path, name, each.head)
            for name, each in metal.renderPipelines.items()
        }
        if metal.commands is not None:
            description.commands = tuple(
                made for each in metal.commands if each is not None for made in self.commands(each)
            )
        assert not self.binder.problems, self.binder.problems
        return self.made

    def image(self, name: str, texture: MetalTexture) -> Node:
        items: Items = []
        vk_format = PIXEL_FORMATS.get(texture.pixelFormat or "")
        if vk_format:
            items.append(("format", *placed(texture, "pixelFormat", vk_format)))
        samples = samples_of(texture)
        if samples is not None:
            by = next(m for m in ("sampleCount", "textureType", "drawable") if texture.states(m))
            items.append(("samples", *placed(texture, by, samples)))
        usage = self._usage(name, texture, vk_format)
        if usage is not None:
            by = "usage" if texture.states("usage") else "storageMode"
            items.append(
                ("usage", key_of(texture, by), sequence(usage, texture.spelled[by][1].span))
            )
        if texture.storageMode is not None:
            flags = (
                ("DEVICE_LOCAL", "LAZILY_ALLOCATED")
                if texture.storageMode == "memoryless"
                else ("DEVICE_LOCAL",)
            )
            at = texture.spelled["storageMode"][1].span
            items.append(
                (
                    "memory",
                    key_of(texture, "storageMode"),
                    sequence([scalar(flag, at) for flag in flags], at),
                )
            )
        sides = renamed(texture, {"width": "width", "height": "height"})
        if sides:
            items.append(("extent", sides[0][1], mapping(sides, sides[0][1])))
        items += renamed(
            texture,
            {"drawable": "presentable", "mipmapLevelCount": "mipLevels", "encoding": "encoding"},
        )
        items += _type(texture)
        return mapping(items, texture.node.span)

    def _usage(self, name: str, texture: MetalTexture, vk_format: str | None) -> list[Node] | None:
        """The usage flags of a texture; None if the usage is not stated or is `unknown`, which
        allows everything.
        """
        words = texture.usage
        if words is not None and ("unknown" in words or not words):
            words = None
        memoryless = texture.storageMode == "memoryless"
        if words is None and not memoryless:
            return None
        rendered = self._rendered_as(name, vk_format)
        found: dict[str, Span] = {}
        for word in words or ("renderTarget",):
            at = (
                texture.flag_place("usage", (word,))
                if words is not None
                else texture.place("storageMode")
            )
            flag = rendered if word == "renderTarget" else _USAGE.get(word)
            if word == "renderTarget" and flag is None:
                return None
            if flag is not None:
                found.setdefault(flag, at)
        if memoryless:
            found["TRANSIENT_ATTACHMENT"] = texture.place("storageMode")
        return [scalar(flag, at) for flag, at in found.items()]

    def _rendered_as(self, name: str, vk_format: str | None) -> str | None:
        """The attachment usage of a render target, from its format or else from the passes that
        attach it.
        """
        known = format_of(vk_format) if vk_format else None
        aspects = set(known.aspects) if known is not None else self.used_as.get(name, set())
        if not aspects or ("color" in aspects and len(aspects) > 1):
            return None
        return "COLOR_ATTACHMENT" if "color" in aspects else "DEPTH_STENCIL_ATTACHMENT"

    def render_pass(self, name: str, each: MetalRenderPass) -> RenderPass:
        own = PassTree(each)
        made: RenderPass = self.binder.record(RenderPass, own.tree(), each.path, name, each.head)
        subpass = made.subpasses[0]
        subpass.path = each.path
        if subpass.depthStencilResolve is not None:
            resolving = next(
                a
                for a in (each.depthAttachment, each.stencilAttachment)
                if a is not None and resolves(a)
            )
            subpass.depthStencilResolve.path = resolving.path
        for attachment, (path, by_aspect) in zip(made.attachments, own.origins, strict=True):
            attachment.path = path
            self.made.attachments[id(attachment)] = by_aspect
        if own.apart is not None:
            self.made.stencils[id(subpass)] = own.apart
        return made

    def pipeline(self, each: MetalRenderPipeline) -> Node:
        items: Items = []
        state: Items = []
        for members, ours in (
            (("rasterSampleCount", "sampleCount"), "rasterizationSamples"),
            (("isAlphaToCoverageEnabled", "alphaToCoverageEnabled"), "alphaToCoverageEnable"),
            (("isAlphaToOneEnabled", "alphaToOneEnabled"), "alphaToOneEnable"),
        ):
            member = first_stated(each, members)
            if member is not None:
                state.append((ours, *placed(each, member, getattr(each, member))))
        if state:
            items.append(("multisampleState", state[0][1], mapping(state, each.node.span)))
        raster = first_stated(each, ("isRasterizationEnabled", "rasterizationEnabled"))
        if raster is not None:
            key, value = placed(each, raster, not getattr(each, raster))
            items.append(
                (
                    "rasterizationState",
                    key,
                    mapping([("rasterizerDiscardEnable", key, value)], each.node.span),
                )
            )
        colors = by_index(each.colorAttachments)
        if any(
            color is not None and first_stated(color, _BLENDING) is not None for color in colors
        ):
            at = key_of(each, "colorAttachments")
            items.append(
                (
                    "colorBlendState",
                    at,
                    mapping(
                        [("attachments", at, sequence([_blend(c, at) for c in colors], at))], at
                    ),
                )
            )
        if each.renderPass is not None:
            key, value = placed(each, "renderPass", each.renderPass)
            items += [("renderPass", key, value), ("subpass", key, scalar(0, value.span))]
        else:
            items.append(("rendering", each.head, mapping(_formats(each, colors), each.head)))
        return mapping(items, each.node.span)

    def commands(self, each: MetalCommand) -> Iterable[Command]:
        """What a command records; both of a pass stand at its place."""
        body = each.body
        if not isinstance(body, Record):
            name = scalar(str(body), _inner(each).span)
            if each.kind == "present":
                return [
                    self._command("present", mapping([("image", each.head, name)], name.span), each)
                ]
            begin = mapping([("renderPass", each.head, name)], name.span)
            return [
                self._command("beginRenderPass", begin, each),
                self._command("endRenderPass", mapping((), name.span), each),
            ]
        kind, members = _COMMANDS[each.kind]
        items = renamed(body, members)
        if isinstance(body, (MetalRead, MetalWrite)) and body.stage is not None:
            items.append(("stage", *placed(body, "stage", _STAGES[body.stage])))
        return [self._command(kind, mapping(items, body.node.span), each)]

    def _command(self, kind: str, body: Node, origin: MetalCommand) -> Command:
        node = mapping([(kind, origin.head, body)], origin.node.span)
        made = self.binder.command(node, "", origin.key, Command)
        assert made is not None
        made.path = origin.path
        if isinstance(made.body, Record):
            made.body.path = origin.path
        return made


_BLENDING = ("isBlendingEnabled", "blendingEnabled")


def samples_of(texture: MetalTexture) -> int | None:
    """A texture's sample count; 1 for a drawable or a type that is not multisampled, unless
    stated.
    """
    if texture.sampleCount is not None:
        return texture.sampleCount
    return (
        1
        if texture.drawable
        or (texture.textureType is not None and texture.textureType not in MULTISAMPLE_TYPES)
        else None
    )


def _inner(command: MetalCommand) -> Node:
    """The value of a command's only key."""
    inner: Node = next(iter(command.node.value.values()))
    return inner


def _type(texture: MetalTexture) -> Items:
    """The image members that follow from a texture's type, array length and view usage."""
    items: Items = []
    flags: list[Node] = []
    layers = texture.arrayLength
    by = "arrayLength"
    if texture.textureType is not None:
        kind = texture.textureType
        key, value = placed(
            texture, "textureType", "1D" if "1D" in kind else "3D" if "3D" in kind else "2D"
        )
        items.append(("imageType", key, value))
        if kind.startswith("typeCube"):
            flags.append(scalar("CUBE_COMPATIBLE", value.span))
            layers, by = 6 * (layers or 1), "textureType"
    if "pixelFormatView" in (texture.usage or ()):
        flags.append(scalar("MUTABLE_FORMAT", texture.flag_place("usage", ("pixelFormatView",))))
    if layers is not None and layers < 2**31:
        items.append(("arrayLayers", *placed(texture, by, layers)))
    if flags:
        items.append(("flags", flags[0].span, sequence(flags, flags[0].span)))
    return items


def _blend(color: MetalPipelineColor | None, at: Span) -> Node:
    member = first_stated(color, _BLENDING) if color is not None else None
    if color is None or member is None:
        return mapping((), at)
    return mapping(
        [("blendEnable", *placed(color, member, getattr(color, member)))], color.node.span
    )


def _formats(each: MetalRenderPipeline, colors: Sequence[MetalPipelineColor | None]) -> Items:
    """The formats of a pipeline without a render pass."""
    items: Items = []
    if colors:
        at = key_of(each, "colorAttachments")
        formats = [_format(c, "pixelFormat") if c is not None else None for c in colors]
        items.append(
            (
                "colorAttachmentFormats",
                at,
                sequence([node or scalar(None, at) for node in formats], at),
            )
        )
    for aspect in ("depth", "stencil"):
        node = _format(each, f"{aspect}AttachmentPixelFormat")
        if node is not None:
            items.append(
                (f"{aspect}AttachmentFormat", key_of(each, f"{aspect}AttachmentPixelFormat"), node)
            )
    return items


def _format(record: Record, member: str) -> Node | None:
    name = getattr(record, member)
    vk_format = "UNDEFINED" if name == "invalid" else PIXEL_FORMATS.get(name or "")
    return scalar(vk_format, record.place(member)) if vk_format else None
