"""The form of an entry of the reference of a description's keys."""

from typing import NamedTuple


class Key(NamedTuple):
    """What one key means.

    `meaning` consists of sentences. `unit` is the unit of a number, or of the numbers in a list.
    `absent` is what holds without the key, if that is not what its type implies: none for a list,
    unknown for a value. `source` is the specification's term, if it is not the member with the
    key's name of the structure; an empty one says that the key is msaa-lint's own. `section` is an
    anchor in `SECTIONS`.
    """

    title: str
    meaning: str
    unit: str = ""
    absent: str = ""
    source: str | None = None
    section: str = ""


class Structure(NamedTuple):
    """A structure and its keys. `source` is the structure in the specification that members of the
    same name belong to.
    """

    title: str
    source: str
    section: str
    keys: dict[str, Key]


SECTIONS = {
    "capabilities": ("capabilities", "Additional Capabilities"),
    "clears-inside": ("clears", "Clearing Images Inside a Render Pass Instance"),
    "clears-outside": ("clears", "Clearing Images Outside a Render Pass Instance"),
    "copies-buffers-images": ("copies", "Copying Data Between Buffers and Images"),
    "copies-images": ("copies", "Copying Data Between Images"),
    "copies-imagescaling": ("copies", "Image Copies With Scaling"),
    "copies-resolve": ("copies", "Resolving Multisample Images"),
    "devsandqueues-device-creation": ("devsandqueues", "Device Creation"),
    "devsandqueues-physical-device-enumeration": ("devsandqueues", "Physical Devices"),
    "drawing-primitive-shading": ("drawing", "Programmable Primitive Shading"),
    "drawing-primitive-topologies": ("drawing", "Primitive Topologies"),
    "extendingvulkan-device-extensions": ("extensions", "Device Extensions"),
    "features": ("features", "Features"),
    "formats-definition": ("formats", "Format Definition"),
    "fragops-covg": ("fragops", "Multisample Coverage"),
    "fragops-dbt": ("fragops", "Depth Bounds Test"),
    "fragops-depth": ("fragops", "Depth Test"),
    "fragops-depth-write": ("fragops", "Depth Attachment Writes"),
    "fragops-ds-state": ("fragops", "Depth and Stencil Operations"),
    "fragops-samplemask": ("fragops", "Sample Mask Test"),
    "fragops-stencil": ("fragops", "Stencil Test"),
    "framebuffer-blendfactors": ("framebuffer", "Blend Factors"),
    "framebuffer-blending": ("framebuffer", "Blending"),
    "framebuffer-blendoperations": ("framebuffer", "Blend Operations"),
    "framebuffer-color-write-mask": ("framebuffer", "Color Write Mask"),
    "framebuffer-logicop": ("framebuffer", "Logical Operations"),
    "fxvertex-input": ("fxvertex", "Vertex Input Description"),
    "limits": ("limits", "Limits"),
    "memory-device-lazy_allocation": ("memory", "Lazily Allocated Memory"),
    "memory-device-properties": ("memory", "Device Memory Properties"),
    "pipelines-dynamic-state": ("pipelines", "Dynamic State"),
    "pipelines-graphics": ("pipelines", "Graphics Pipelines"),
    "pipelines-specialization-constants": ("pipelines", "Specialization Constants"),
    "primsrast": ("primsrast", "Rasterization"),
    "primsrast-depthbias-enable": ("primsrast", "Depth Bias Enable"),
    "primsrast-discard": ("primsrast", "Discarding Primitives Before Rasterization"),
    "primsrast-multisampling": ("primsrast", "Multisampling"),
    "primsrast-polygonmode": ("primsrast", "Polygon Mode"),
    "primsrast-sampleshading": ("primsrast", "Sample Shading"),
    "renderpass": ("renderpass", "Render Pass"),
    "renderpass-commands": ("renderpass", "Render Pass Commands"),
    "renderpass-creation": ("renderpass", "Render Pass Creation"),
    "renderpass-load-operations": ("renderpass", "Render Pass Load Operations"),
    "renderpass-resolve-operations": ("renderpass", "Render Pass Multisample Resolve Operations"),
    "renderpass-store-operations": ("renderpass", "Render Pass Store Operations"),
    "resources-image-layouts": ("resources", "Image Layouts"),
    "resources-images": ("resources", "Images"),
    "resources-sharing": ("resources", "Resource Sharing Mode"),
    "synchronization-access-types": ("synchronization", "Access Types"),
    "synchronization-image-memory-barriers": ("synchronization", "Image Memory Barriers"),
    "synchronization-pipeline-barriers": ("synchronization", "Pipeline Barriers"),
    "synchronization-pipeline-stages": ("synchronization", "Pipeline Stages"),
    "vertexpostproc-clipping": ("vertexpostproc", "Primitive Clipping"),
    "wsi-swapchain": ("VK_KHR_surface/wsi", "WSI Swapchain"),
}
"""Sections of the Vulkan specification: the chapter's page and the title of each anchor."""
