"""Recorded commands and their parameters."""

from __future__ import annotations

from typing import Annotated, Literal

from ..members import (
    Access,
    Accesses,
    Aspects,
    FramebufferName,
    ImageName,
    Index,
    Layout,
    LoadOp,
    Offset,
    PipelineName,
    RenderingFlags,
    RenderPassName,
    ResolveMode,
    Samples,
    Size,
    Stage,
    Stages,
    StoreOp,
)
from ..record import Record
from ..shapes import shapes_of
from .vulkan import Extent2D, RenderToSingleSampled, UnreadStructures


class Rect(Record):
    """VkRect2D, flat, in pixels."""

    x: Offset | None = None
    y: Offset | None = None
    width: Size | None = None
    height: Size | None = None


class BeginRenderPass(Record):
    """VkRenderPassBeginInfo; a list of framebuffers alternates from frame to frame. `label` is the
    debug labels around it.
    """

    renderPass: RenderPassName | None = None
    framebuffer: FramebufferName | tuple[FramebufferName, ...] | None = None
    renderArea: Rect | None = None
    clearValueCount: Index | None = None
    label: str | None = None


class RenderingAttachment(Record):
    """VkRenderingAttachmentInfo, with images in place of views."""

    image: ImageName | None = None
    imageLayout: Layout | None = None
    resolveMode: ResolveMode | None = None
    resolveImage: ImageName | None = None
    resolveImageLayout: Layout | None = None
    loadOp: LoadOp | None = None
    storeOp: StoreOp | None = None
    pNext: UnreadStructures = ()


class FragmentDensityMapAttachment(Record):
    """VkRenderingFragmentDensityMapAttachmentInfoEXT, with an image in place of the view."""

    image: ImageName | None = None
    imageLayout: Layout | None = None


class FragmentShadingRateAttachment(Record):
    """VkRenderingFragmentShadingRateAttachmentInfoKHR, with an image in place of the view."""

    image: ImageName | None = None
    imageLayout: Layout | None = None
    shadingRateAttachmentTexelSize: Extent2D | None = None


class BeginRendering(Record):
    """VkRenderingInfo; null is an unused color attachment. `label` is the debug labels around it;
    several of one that is begun again.
    """

    flags: RenderingFlags = ()
    renderArea: Rect | None = None
    layerCount: Size | None = None
    viewMask: Index | None = None
    colorAttachments: tuple[RenderingAttachment | None, ...] = ()
    depthAttachment: RenderingAttachment | None = None
    stencilAttachment: RenderingAttachment | None = None
    multisampledRenderToSingleSampled: RenderToSingleSampled | None = None
    fragmentDensityMapAttachment: FragmentDensityMapAttachment | None = None
    fragmentShadingRateAttachment: FragmentShadingRateAttachment | None = None
    label: str | tuple[str, ...] | None = None
    pNext: UnreadStructures = ()


class Draw(Record):
    """vkCmdDraw, vkCmdDrawIndexed; or `drawCount` such draws with one pipeline, whose counts are
    these on average.
    """

    pipeline: PipelineName | None = None
    vertexCount: Index | None = None
    indexCount: Index | None = None
    instanceCount: Index | None = None
    firstVertex: Index | None = None
    firstInstance: Index | None = None
    drawCount: Size | None = None


class ClearAttachment(Record):
    """VkClearAttachment."""

    aspect: Aspects = ()
    colorAttachment: Index | None = None


class ClearAttachments(Record):
    """vkCmdClearAttachments."""

    attachments: tuple[ClearAttachment, ...] = ()
    rects: tuple[Rect, ...] = ()


class OneImage(Record):
    """vkCmdClearColorImage, vkCmdClearDepthStencilImage, vkQueuePresentKHR."""

    image: ImageName | None = None


class TwoImages(Record):
    """vkCmdCopyImage, vkCmdBlitImage."""

    srcImage: ImageName | None = None
    dstImage: ImageName | None = None


class ResolveImage(Record):
    """vkCmdResolveImage; with a mode vkCmdResolveImage2 with a VkResolveImageModeInfoKHR."""

    srcImage: ImageName | None = None
    dstImage: ImageName | None = None
    resolveMode: ResolveMode | None = None
    stencilResolveMode: ResolveMode | None = None


class CopyImageToBuffer(Record):
    """vkCmdCopyImageToBuffer."""

    srcImage: ImageName | None = None


class CopyBufferToImage(Record):
    """vkCmdCopyBufferToImage."""

    dstImage: ImageName | None = None


class WriteImage(Record):
    """A shader writes the image."""

    image: ImageName | None = None
    stage: Stage | None = None
    access: Access | None = None


class ReadImage(Record):
    """A shader reads the image; for a multisampled one, the samples that it fetches and how it
    combines them.
    """

    image: ImageName | None = None
    stage: Stage | None = None
    access: Access | None = None
    samples: Literal[1, "ALL"] | None = None
    resolves: Literal["AVERAGE", "MIN", "MAX", "OTHER"] | None = None


class ImageBarrier(Record):
    """VkImageMemoryBarrier's image and layouts."""

    image: ImageName | None = None
    oldLayout: Layout | None = None
    newLayout: Layout | None = None


class PipelineBarrier(Record):
    """vkCmdPipelineBarrier."""

    srcStageMask: Stages = ()
    dstStageMask: Stages = ()
    srcAccessMask: Accesses = ()
    dstAccessMask: Accesses = ()
    images: tuple[ImageBarrier | ImageName, ...] = ()


class Nothing(Record):
    """A command without parameters."""


NoParameters = Annotated[Nothing | None, ("null", ("record", Nothing))]


class Command(Record):
    """A recorded command: a mapping with one key. A command without parameters may be written as a
    bare word.

    `kind` is the key, `body` the parameters (None where there are none). SHAPE has the commands and
    the shapes of their parameters.
    """

    SHAPE = shapes_of(
        beginRenderPass=BeginRenderPass,
        nextSubpass=NoParameters,
        endRenderPass=NoParameters,
        beginRendering=BeginRendering,
        endRendering=NoParameters,
        setRasterizationSamples=Samples,
        draw=Draw,
        clearAttachments=ClearAttachments,
        clearColorImage=OneImage,
        clearDepthStencilImage=OneImage,
        resolveImage=ResolveImage,
        copyImage=TwoImages,
        blitImage=TwoImages,
        copyImageToBuffer=CopyImageToBuffer,
        copyBufferToImage=CopyBufferToImage,
        writeImage=WriteImage,
        readImage=ReadImage,
        pipelineBarrier=PipelineBarrier,
        present=OneImage,
    )

    kind: str
    body: object


RecordedCommand = Annotated[Command, ("command", Command)]
