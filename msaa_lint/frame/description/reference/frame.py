"""What the keys of a whole description, its device and its scene mean."""

from .entries import Key, Structure

_EXTENSIONS = "extendingvulkan-device-extensions"
_MASK = "sample counts, in samples per texel"

FRAME_STRUCTURES = {
    "SampleCounts": Structure(
        "Supported sample counts",
        "VkPhysicalDeviceLimits",
        "limits",
        {
            "color": Key(
                "Color",
                "The sample counts of color attachments.",
                source="VkPhysicalDeviceLimits::framebufferColorSampleCounts",
                absent="unknown",
            ),
            "depth": Key(
                "Depth",
                "The sample counts of depth attachments.",
                source="VkPhysicalDeviceLimits::framebufferDepthSampleCounts",
                absent="unknown",
            ),
            "stencil": Key(
                "Stencil",
                "The sample counts of stencil attachments.",
                source="VkPhysicalDeviceLimits::framebufferStencilSampleCounts",
                absent="unknown",
            ),
            "integer": Key(
                "Integer color",
                "The sample counts of color attachments with integer formats.",
                source="VkPhysicalDeviceVulkan12Properties::framebufferIntegerColorSampleCounts",
                absent="unknown",
            ),
        },
    ),
    "Device": Structure(
        "Device",
        "",
        "devsandqueues-physical-device-enumeration",
        {
            "captured": Key(
                "Captured",
                "True if the frame was captured on this device, as `convert` writes it. "
                "`--profile` then replaces the device.",
                absent="false",
            ),
            "name": Key(
                "Device name",
                "The name of the device, for messages.",
                source="VkPhysicalDeviceProperties::deviceName",
            ),
            "vendor": Key(
                "Vendor",
                "The vendor of the GPU, in any case.",
                source="VkPhysicalDeviceProperties::vendorID",
            ),
            "tiler": Key(
                "Tile-based",
                "Whether the GPU renders tile by tile in memory on the chip, where samples cost no "
                "bandwidth until they are stored.",
            ),
            "sampleCounts": Key(
                "Supported sample counts",
                "The sample counts of attachments, by aspect.",
                source="VkPhysicalDeviceLimits",
                section="limits",
            ),
            "memoryTypes": Key(
                "Memory types",
                "The property flags of each memory type.",
                source="VkPhysicalDeviceMemoryProperties::memoryTypes",
                section="memory-device-properties",
            ),
            "depthResolveModes": Key(
                "Depth resolve modes",
                "The supported resolve modes of depth.",
                source="VkPhysicalDeviceDepthStencilResolveProperties::supportedDepthResolveModes",
                section="limits",
            ),
            "stencilResolveModes": Key(
                "Stencil resolve modes",
                "The supported resolve modes of stencil.",
                source="VkPhysicalDeviceDepthStencilResolveProperties::supportedStencilResolveModes",
                section="limits",
            ),
            "independentResolve": Key(
                "Independent resolve modes",
                "Whether depth and stencil may have any two supported resolve modes.",
                source="VkPhysicalDeviceDepthStencilResolveProperties::independentResolve",
                section="limits",
            ),
            "independentResolveNone": Key(
                "Independent resolve",
                "Whether one of depth and stencil may be resolved without the other.",
                source="VkPhysicalDeviceDepthStencilResolveProperties::independentResolveNone",
                section="limits",
            ),
            "features": Key(
                "Features",
                "The features that the device supports, such as sampleRateShading.",
                source="VkPhysicalDeviceFeatures",
                section="features",
            ),
            "extensions": Key(
                "Extensions",
                "The extensions that the device supports.",
                source="VkExtensionProperties::extensionName",
                section=_EXTENSIONS,
            ),
            "apiVersion": Key(
                "Vulkan version",
                'The version of Vulkan that the device supports, such as "1.2".',
                source="VkPhysicalDeviceProperties::apiVersion",
            ),
            "maxEfficientSamples": Key(
                "Highest efficient sample count",
                "The samples of a pixel up to which the vendor recommends the device, which may "
                "support more.",
            ),
            "tile": Key(
                "Tile memory",
                "The memory of a tile, for costs: a `model` that msaa-lint knows, or a `kind` with "
                "its budgets.",
                "bytes (`colorBytes`, `depthBytes`, `limitBytes`, `gmemBytes`) and pixels "
                "(`maxPixels`)",
            ),
            "compression": Key(
                "Framebuffer compression",
                "The measured traffic of images that the device may compress, divided by the "
                "arithmetic one, by sample count, such as"
                " `{1 read: 0.48, 1 write: 0.46, 4: 1.0}`; `most read` and `most write` beside "
                "them make a range.",
                "ratio of bytes",
            ),
            "milliwattsPerGBps": Key(
                "Power of memory traffic",
                "The power that a gigabyte per second of memory traffic takes.",
                "mW per GB/s",
            ),
        },
    ),
    "Enabled": Structure(
        "What the application enables",
        "VkDeviceCreateInfo",
        "devsandqueues-device-creation",
        {
            "apiVersion": Key(
                "Vulkan version",
                'The version of Vulkan that the application is written for, such as "1.2".',
                source="VkApplicationInfo::apiVersion",
            ),
            "extensions": Key(
                "Extensions",
                "The device extensions that the application enables.",
                absent="unknown",
                source="VkDeviceCreateInfo::ppEnabledExtensionNames",
                section=_EXTENSIONS,
            ),
            "features": Key(
                "Features",
                "The features that the application enables.",
                absent="unknown",
                source="VkDeviceCreateInfo::pEnabledFeatures",
                section="features",
            ),
        },
    ),
    "AttachmentConfig": Structure(
        "Attachment of an Impeller render target", "RenderTarget::AttachmentConfig", "", {}
    ),
    "AttachmentConfigMSAA": Structure(
        "Multisampled attachment of an Impeller render target",
        "RenderTarget::AttachmentConfigMSAA",
        "",
        {},
    ),
    "RenderTarget": Structure(
        "Impeller render target",
        "RenderTarget",
        "",
        {
            "api": Key(
                "Graphics API",
                "Whether the target expands to Vulkan or to Metal.",
                absent="an error; it is required",
            ),
            "onscreen": Key(
                "On screen",
                "Whether the target resolves to a swapchain image or a drawable instead of a "
                "texture.",
                absent="false",
            ),
            "width": Key("Width", "The width of the target.", "pixels", "the frame's"),
            "height": Key("Height", "The height of the target.", "pixels", "the frame's"),
            "colorFormat": Key(
                "Color format",
                "Impeller's PixelFormat of color.",
                absent="kR8G8B8A8UNormInt on Vulkan, kB8G8R8A8UNormInt on Metal",
            ),
            "depthFormat": Key(
                "Depth-stencil format",
                "Impeller's PixelFormat of depth and stencil.",
                absent="kD32FloatS8UInt on Metal, unknown on Vulkan",
            ),
            "sampleCount": Key(
                "Sample count",
                "Impeller's SampleCount; the engine itself has kCount1 and kCount4.",
                "samples per pixel",
                "kCount1",
            ),
            "enableStencil": Key(
                "Stencil", "Whether the target has depth and stencil.", absent="true"
            ),
            "colorAttachmentConfig": Key(
                "Color attachment",
                "Storage, load and store of color.",
                absent="the engine's default",
            ),
            "stencilAttachmentConfig": Key(
                "Depth and stencil attachment",
                "Storage, load and store of depth and stencil.",
                absent="the engine's default",
            ),
        },
    ),
    "FrameSize": Structure(
        "Frame size and rate",
        "",
        "",
        {
            "width": Key(
                "Width",
                "The width of the frame, for costs.",
                "pixels",
                "the width of the framebuffers",
            ),
            "height": Key(
                "Height",
                "The height of the frame, for costs.",
                "pixels",
                "the height of the framebuffers",
            ),
            "fps": Key(
                "Frame rate",
                "The frames shown in a second. It turns bytes per frame into MB/s.",
                "frames per second",
                "60",
            ),
            "share": Key(
                "Share of frames",
                "How often this kind of frame occurs, in a file with one document for each kind of "
                "a program.",
                "fraction above 0, up to 1",
            ),
        },
    ),
    "Scene": Structure(
        "Scene",
        "",
        "",
        {
            "edges": Key(
                "Edges", "Whether the picture shows edges of geometry, which multisampling smooths."
            ),
            "depth": Key("Depth direction", "STANDARD if near is 0, REVERSED if near is 1."),
            "color": Key(
                "Dynamic range", "LDR if color is at most display white, HDR if it may be brighter."
            ),
            "peak": Key(
                "Peak brightness",
                "The brightest value, in units of display white.",
                "multiples of display white",
            ),
            "depthResolveWants": Key(
                "Depth to resolve to",
                "Which depth the reader of resolved depth needs: ANY sample, the NEAREST, or the "
                "FARTHEST.",
            ),
            "toneMapping": Key(
                "Tone mapping",
                "Whether tone mapping comes AFTER_RESOLVE, IN_PASS before it, or not at all "
                "(NONE).",
            ),
            "alphaTest": Key(
                "Alpha test",
                "Whether fragments are discarded by alpha, whose edges multisampling does not "
                "smooth.",
            ),
            "textureDetail": Key(
                "Texture detail",
                "Whether textures have detail finer than a pixel, which multisampling does not "
                "smooth.",
            ),
            "overdraw": Key(
                "Overdraw",
                "How many triangles of a pass cover a pixel, on average.",
                "triangles per pixel",
                "1",
            ),
            "triangleSize": Key(
                "Triangle size",
                "The longest side of a triangle, on average.",
                "pixels",
                "what the number of vertices implies",
            ),
            "shading": Key(
                "Shading cost",
                "What a fragment shader invocation costs: none, light, medium or heavy, operations "
                "(200ops), "
                "the time of a million (500000ns), "
                "or of a screen (4.2ms).",
                "operations, ns per million invocations, or ms per screen",
            ),
        },
    ),
    "SampleCountTest": Structure(
        "Test of a sample count",
        "",
        "capabilities",
        {
            "tests": Key(
                "Tested sample count",
                "The sample count whose bit is tested.",
                source="VkSampleCountFlagBits",
            ),
            "gives": Key(
                "Selected sample count",
                "The sample count that is selected if the bit is set.",
                source="VkSampleCountFlagBits",
            ),
        },
    ),
    "SampleCountChoice": Structure(
        "Choice of a sample count",
        "",
        "limits",
        {
            "limits": Key(
                "Limits",
                "The masks of sample counts that the choice uses.",
                absent="unknown",
                source="VkPhysicalDeviceLimits",
            ),
            "combined": Key(
                "Combination of masks",
                "How the masks are combined: AND is right, as every attachment must support the "
                "count; NONE for one mask.",
            ),
            "chosen": Key(
                "Selected bit",
                "MAXIMUM for the highest supported count, ATMOST for the highest up to `atMost`.",
            ),
            "atMost": Key("Highest sample count", "The highest count that the choice can return."),
            "tests": Key(
                "Tests in order",
                "The tests of the combined mask. The first bit that is set decides.",
            ),
            "formats": Key(
                "Formats",
                "The formats of the images that get the sample count.",
                absent="unknown",
                section="formats-definition",
            ),
        },
    ),
    "Description": Structure(
        "msaa-lint description",
        "",
        "",
        {
            "frame": Key(
                "Frame",
                "The frame's size and rate, for costs.",
                absent="the sizes of framebuffers, and 60 frames per second",
            ),
            "device": Key(
                "Device",
                "The name of a built-in profile, or what the device supports.",
                section="devsandqueues-physical-device-enumeration",
            ),
            "enabled": Key(
                "What the application enables",
                "The version, extensions and features that the application uses.",
                absent="what the device supports",
                source="VkDeviceCreateInfo",
                section="devsandqueues-device-creation",
            ),
            "images": Key(
                "Images",
                "The images of the frame, by name.",
                source="VkImageCreateInfo",
                section="resources-images",
            ),
            "renderPasses": Key(
                "Render passes",
                "The render passes, by name.",
                source="VkRenderPassCreateInfo2",
                section="renderpass-creation",
            ),
            "framebuffers": Key(
                "Framebuffers",
                "The framebuffers, by name; needed only if a render pass is used with several sets "
                "of images.",
                source="VkFramebufferCreateInfo",
                section="renderpass-creation",
            ),
            "pipelines": Key(
                "Pipelines",
                "The graphics pipelines, by name.",
                source="VkGraphicsPipelineCreateInfo",
                section="pipelines-graphics",
            ),
            "commands": Key(
                "Commands",
                "What every frame records, in order.",
                absent="every pass once, in order",
                section="renderpass-commands",
            ),
            "scene": Key("Scene", "What the picture needs, for `study` and some rules."),
            "metal": Key(
                "Metal frame",
                "The frame in Metal's terms, in place of Vulkan's sections.",
                absent="a Vulkan frame",
            ),
            "sampleCountChoices": Key(
                "Choices of sample counts",
                "How the program selects sample counts, by the function or variable that holds the "
                "count.",
                source="VkPhysicalDeviceLimits",
                section="limits",
            ),
            "renderTargets": Key(
                "Impeller render targets",
                "Render targets of Flutter's engine, by name. They expand to what the engine "
                "creates from them.",
            ),
        },
    ),
}

_ENGINE = "the engine's default"
_CONFIG = {
    "storageMode": Key(
        "Storage mode",
        "kDeviceTransient for samples that exist only on the tile, "
        "kDevicePrivate for memory of the GPU, kHostVisible for memory of the CPU.",
        absent=_ENGINE,
    ),
    "loadAction": Key(
        "Load action",
        "kLoad reads every sample from memory; kClear and kDontCare do not.",
        absent=_ENGINE,
    ),
    "storeAction": Key(
        "Store action",
        "kMultisampleResolve stores the resolved image alone, kStoreAndMultisampleResolve the "
        "samples as well.",
        absent=_ENGINE,
    ),
    "clearColor": Key(
        "Clear color", "Red, green, blue and alpha for kClear.", "1.0 for full intensity", _ENGINE
    ),
}
FRAME_STRUCTURES["AttachmentConfig"].keys.update(_CONFIG)
FRAME_STRUCTURES["AttachmentConfigMSAA"].keys.update(
    _CONFIG,
    resolveStorageMode=Key(
        "Storage mode of the resolve texture",
        "Where the resolved image is stored; unused with one sample per pixel.",
        absent=_ENGINE,
    ),
)
