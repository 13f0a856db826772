"""The parts of a plan: what is created and recorded, in Vulkan's integers, as sent to the child
process.

A plan consists of nested named tuples of numbers and texts, which JSON turns into lists and
`from_json` restores. An index of -1 means none.
"""

import zlib
from base64 import b64decode, b64encode
from typing import Any, NamedTuple, get_args

NONE = -1

RENDER_PASS = "renderPass"
RENDERING = "rendering"
FRAME = "frame"
"""Kinds of passes. `frame` stands for a description without passes: its images, pipelines and
commands.
"""

VERTEX_STAGE, FRAGMENT_STAGE = 1, 16
"""VkShaderStageFlagBits."""

COLOR, DEPTH, STENCIL = 1, 2, 4
"""VkImageAspectFlagBits."""

TRANSIENT, SAMPLED, STORAGE, TRANSFER_SOURCE, TRANSFER_TARGET = 0x40, 0x4, 0x8, 0x1, 0x2
COLOR_ATTACHMENT, DEPTH_ATTACHMENT, INPUT_ATTACHMENT = 0x10, 0x20, 0x80
"""VkImageUsageFlagBits."""

LOAD, CLEAR, LOAD_DONT_CARE = 0, 1, 2
STORE, STORE_DONT_CARE = 0, 1
"""VkAttachmentLoadOp and VkAttachmentStoreOp."""

(
    UNDEFINED,
    GENERAL,
    COLOR_LAYOUT,
    DEPTH_LAYOUT,
    DEPTH_READ_LAYOUT,
    READ_LAYOUT,
    SOURCE_LAYOUT,
    TARGET_LAYOUT,
) = range(8)
PRESENT_LAYOUT, STENCIL_LAYOUT, DEPTH_ALONE_READ_LAYOUT, EITHER_READ_LAYOUT = (
    1000001002,
    1000241002,
    1000241001,
    1000314000,
)
"""VkImageLayout; the last three are STENCIL_ATTACHMENT_OPTIMAL, DEPTH_READ_ONLY_OPTIMAL and
READ_ONLY_OPTIMAL.
"""

SUSPENDING, RESUMING = 2, 4
"""VkRenderingFlagBits."""

VIEWPORT, SCISSOR = 0, 1
SAMPLES_DYNAMIC, MASK_DYNAMIC, COVERAGE_DYNAMIC = 1000455005, 1000455006, 1000455007
KEPT_DYNAMIC = (SAMPLES_DYNAMIC, MASK_DYNAMIC, COVERAGE_DYNAMIC)
"""VkDynamicState: plans support RASTERIZATION_SAMPLES_EXT, SAMPLE_MASK_EXT and
ALPHA_TO_COVERAGE_ENABLE_EXT besides the viewport and the scissor.
"""


class Image(NamedTuple):
    """An image. `width` to `layers` are as described; `numeric` is the type of the color (`SFLOAT`,
    `UINT`, ..., empty without color), `bytes` the size of a texel; `lazy` requests lazily allocated
    memory if the device has any.
    """

    name: str
    format: int
    samples: int
    usage: int
    width: int
    height: int
    depth: int
    layers: int
    levels: int
    type: int
    tiling: int
    flags: int
    lazy: bool
    aspects: int
    numeric: str
    bytes: int = 4


class Attachment(NamedTuple):
    """VkAttachmentDescription2; the separate layouts of stencil are -1 if stencil has the
    attachment's layouts.
    """

    format: int
    samples: int
    flags: int
    load: int
    store: int
    stencil_load: int
    stencil_store: int
    initial: int
    final: int
    stencil_initial: int = NONE
    stencil_final: int = NONE


class Reference(NamedTuple):
    """VkAttachmentReference2."""

    attachment: int
    layout: int = 0
    aspects: int = 0


class Subpass(NamedTuple):
    """VkSubpassDescription2. `depth_stencil` and `depth_resolve` hold one reference or none;
    `single_sampled` is the count of VkMultisampledRenderToSingleSampledInfoEXT, 0 without.
    """

    flags: int = 0
    inputs: tuple[Reference, ...] = ()
    colors: tuple[Reference, ...] = ()
    resolves: tuple[Reference, ...] = ()
    depth_stencil: tuple[Reference, ...] = ()
    depth_resolve: tuple[Reference, ...] = ()
    depth_mode: int = 0
    stencil_mode: int = 0
    preserves: tuple[int, ...] = ()
    view_mask: int = 0
    single_sampled: int = 0


class Dependency(NamedTuple):
    """VkSubpassDependency2; masks are those of the second synchronization version."""

    source: int
    target: int
    source_stages: int
    target_stages: int
    source_accesses: int
    target_accesses: int
    flags: int
    view_offset: int


class RenderTarget(NamedTuple):
    """VkRenderingAttachmentInfo. `role` is `color`, `depth` or `stencil`; an unused attachment has
    no image.
    """

    role: str
    image: int = NONE
    layout: int = 0
    mode: int = 0
    resolve_image: int = NONE
    resolve_layout: int = 0
    load: int = LOAD_DONT_CARE
    store: int = STORE


class Framebuffer(NamedTuple):
    """VkFramebufferCreateInfo, with images instead of views."""

    images: tuple[int, ...]
    width: int
    height: int
    layers: int


class Blend(NamedTuple):
    """VkPipelineColorBlendAttachmentState."""

    enable: bool = False
    mask: int = 15
    source: int = 6
    target: int = 7
    operation: int = 0
    source_alpha: int = 1
    target_alpha: int = 7
    alpha_operation: int = 0


class Descriptor(NamedTuple):
    """A binding of a descriptor set of a stage. `type` is a VkDescriptorType, `length` the
    number of descriptors, and `view` a VkImageViewType; `format` and `samples` are those of
    images and texel buffers. A sampler compares if `compares`, and takes the nearest texel if
    `nearest`. `contents` are those of a buffer (`packed`). `attachment` is the index of an input
    attachment.
    """

    set: int
    binding: int
    type: int
    length: int = 1
    view: int = NONE
    format: int = 0
    samples: int = 1
    compares: bool = False
    nearest: bool = False
    size: int = 0
    contents: str = ""
    attachment: int = NONE


class Stage(NamedTuple):
    """VkPipelineShaderStageCreateInfo with the SPIR-V at `path`, or in `code` (`packed`) without
    one; `constants` are (id, value) of its specialization, `pushed` the contents of its push
    constants (`packed`). A device needs `features` and the `version` of SPIR-V.
    """

    stage: int
    path: str
    name: str
    constants: tuple[tuple[int, float], ...] = ()
    code: str = ""
    descriptors: tuple[Descriptor, ...] = ()
    pushed: str = ""
    features: tuple[str, ...] = ()
    version: tuple[int, ...] = (1, 0)


class Pipeline(NamedTuple):
    """VkGraphicsPipelineCreateInfo. `formats` are those of the color attachments in dynamic
    rendering, 0 for unused ones; `sample_shading` is minSampleShading, -1 if sample shading is
    disabled. With `shaded`, a built-in fragment shader does the work that a timing asks for
    (workload.py). `topology` is the VkPrimitiveTopology of the description.
    """

    name: str
    subpass: int
    samples: int
    sample_shading: float = -1.0
    mask: tuple[int, ...] = ()
    alpha_to_coverage: bool = False
    alpha_to_one: bool = False
    dynamic: tuple[int, ...] = ()
    depth_test: bool = False
    depth_write: bool = False
    depth_compare: int = 1
    stencil_test: bool = False
    blends: tuple[Blend, ...] = ()
    numerics: tuple[str, ...] = ()
    discard: bool = False
    depth_clamp: bool = False
    depth_bias: bool = False
    polygon_mode: int = 0
    formats: tuple[int, ...] = ()
    depth_format: int = 0
    stencil_format: int = 0
    view_mask: int = 0
    stages: tuple[Stage, ...] = ()
    shaded: bool = False
    topology: int = 3

    @property
    def has_vertex_shader(self) -> bool:
        """Whether it has a vertex shader of the frame; a generated one has no file, and the input
        of the built-in one.
        """
        return any(stage.stage == VERTEX_STAGE and stage.path for stage in self.stages)

    @property
    def has_fragment_shader(self) -> bool:
        """Whether it has a fragment shader of the frame."""
        return any(stage.stage == FRAGMENT_STAGE for stage in self.stages)


class Mesh(NamedTuple):
    """Triangles to draw instead of the scene: `draws` draws of `vertices` vertices and `instances`
    instances each (mesh_buffers.py).

    Their render area is divided into `columns` by `rows` cells of two triangles; without columns,
    one triangle covers it. `first` is the number of their first triangle: the cells before it are
    those of earlier draws.
    """

    columns: int
    rows: int
    vertices: int
    instances: int = 1
    draws: int = 1
    first: int = 0

    @property
    def triangles(self) -> int:
        """The triangles of a draw, over all its instances."""
        return self.vertices // 3 * self.instances


class PassCommand(NamedTuple):
    """A command within a pass.

    `draw` draws the scene with `pipeline`, over a backdrop if `backdrop` is set; `covers` says that
    it then writes to every pixel. `read` writes `image` to every pixel, as a shader that reads it
    does; `samples` sets the dynamic sample count to `value`; `clear` clears `rects` (x, y, width,
    height), or the render area without any. A described draw has `vertices` (or indices; 0 if
    unknown) and `instances` for each of its `draws`, which are 0 if the description has no draws;
    `full_screen` says that it draws a triangle or a quad over every pixel. `mesh` holds the
    triangles to draw instead of the scene, or none.
    """

    kind: str
    subpass: int
    pipeline: int = NONE
    backdrop: bool = False
    covers: bool = False
    image: int = NONE
    value: int = 0
    aspects: int = 0
    rects: tuple[tuple[int, ...], ...] = ()
    vertices: int = 0
    instances: int = 1
    draws: int = 1
    full_screen: bool = False
    mesh: tuple[Mesh, ...] = ()


class Pass(NamedTuple):
    """A render pass (`api` 1 or 2: the version of the structures that create it), a dynamic
    rendering, or the frame itself. `refused` says why no device can run it, and `failed` why it
    could not be planned; empty if one may, and if it could.
    """

    name: str
    path: str
    kind: str
    api: int
    refused: str = ""
    flags: int = 0
    attachments: tuple[Attachment, ...] = ()
    subpasses: tuple[Subpass, ...] = ()
    dependencies: tuple[Dependency, ...] = ()
    rendered: tuple[RenderTarget, ...] = ()
    framebuffers: tuple[Framebuffer, ...] = ()
    pipelines: tuple[Pipeline, ...] = ()
    layers: int = 1
    view_mask: int = 0
    single_sampled: int = 0
    images: tuple[int, ...] = ()
    failed: str = ""


class Step(NamedTuple):
    """A step of a frame: the `begin` of a pass with a framebuffer and a render area (x, y, width,
    height), or a command outside passes (`resolve`, `copy`, `blit`, `clear`, `copyOut`, `copyIn`,
    `barrier`, `present`, `read`). `number` is the pass that it is reported with, and `filter` the
    VkFilter of a blit. The layer sees a command that is `illegal`, but not the driver.
    """

    kind: str
    number: int
    framebuffer: int = 0
    area: tuple[int, ...] = ()
    inner: tuple[PassCommand, ...] = ()
    source: int = NONE
    target: int = NONE
    masks: tuple[int, ...] = ()
    layouts: tuple[tuple[int, int, int], ...] = ()
    filter: int = 0
    illegal: bool = False


class Plan(NamedTuple):
    """A frame. `steps` are recorded in order; `defaults` state in words what was assumed where
    the description is silent; `extensions` must be enabled and the features `without` must not;
    `reversed` says that greater depths are nearer. `vertices` is a file of triangles to draw
    instead of the scene: x, y and depth in clip coordinates, 32-bit floats. `left_out` are
    commands that Vulkan forbids, in words, with the numbers of their passes; the driver is not
    given them.
    """

    file: str = ""
    images: tuple[Image, ...] = ()
    passes: tuple[Pass, ...] = ()
    steps: tuple[Step, ...] = ()
    defaults: tuple[str, ...] = ()
    extensions: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    reversed: bool = False
    hdr: bool = False
    vertices: str = ""
    left_out: tuple[tuple[int, str], ...] = ()


def from_json(data: Any) -> Plan:
    """A plan from its JSON. TypeError or ValueError for data that is not a plan."""
    plan: Plan = _part(Plan, data)
    return plan


def packed(data: bytes) -> str:
    """Bytes as a text in a plan."""
    return b64encode(zlib.compress(data)).decode("ascii")


def unpacked(text: str) -> bytes:
    """The bytes of `packed`."""
    return zlib.decompress(b64decode(text))


def _part(kind: Any, value: Any) -> Any:
    if hasattr(kind, "_fields"):
        return kind(
            *(
                _part(member, each)
                for member, each in zip(kind.__annotations__.values(), value, strict=True)
            )
        )
    elements = get_args(kind)
    return tuple(_part(elements[0], each) for each in value) if elements else value
