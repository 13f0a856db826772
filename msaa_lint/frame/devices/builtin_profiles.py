"""The built-in device profiles: facts of single reports, and of profiles that every device of a
class guarantees.

Reports are those of vulkan.gpuinfo.org (Sascha Willems and contributors, CC BY 4.0) by their
number. Of features only sampleRateShading is recorded, and of extensions only those of `RECORDED`.
"""

from typing import TypedDict

RECORDED = (
    "VK_AMD_mixed_attachment_samples",
    "VK_EXT_multisampled_render_to_single_sampled",
    "VK_KHR_depth_stencil_resolve",
    "VK_KHR_dynamic_rendering",
    "VK_NV_framebuffer_mixed_samples",
)
"""The extensions whose absence from a profile of a device says that the device does not offer
them.
"""

REPORT = "vulkan.gpuinfo.org report {} ({}), CC BY 4.0"
SAMPLE_RATE_SHADING = "; sampleRateShading: the report says that it supports {}"
EFFICIENT = {
    "arm": "; efficient samples: Arm GPU Best Practices, and kMaxEfficientSamplesArm of the "
    "Khronos best-practices layer",
    "img": "; efficient samples: kMaxEfficientSamplesImg of the Khronos best-practices layer",
    "qualcomm": "; efficient samples: Meta's Multisample Anti-Aliasing Analysis for Quest, which "
    "advises against more than 4",
}
"""Vendors whose guides advise against more than four samples, and which guides."""

RESOLVE = ("VK_KHR_depth_stencil_resolve",)
RENDERING = ("VK_KHR_depth_stencil_resolve", "VK_KHR_dynamic_rendering")
SINGLE_SAMPLED = (*RENDERING, "VK_EXT_multisampled_render_to_single_sampled")
AMD_MIXED = (*RENDERING, "VK_AMD_mixed_attachment_samples")
NV_MIXED = (*RENDERING, "VK_NV_framebuffer_mixed_samples")


COMPRESSION_G76 = (
    "; compression: from the ratios fitted to the counters of the Khronos MSAA sample up to those "
    "of its render pass sample (docs/cost.md);"
    " above one sample none: AFBC is for single-sampled images (Arm GPU Best Practices 9.8)"
)
TILER_XCLIPSE = (
    "; not tile-based: likely, since its architecture is AMD's RDNA and the report has "
    "no lazily allocated memory; neither vendor states it"
)
TILE_A15 = "; tile: that of M2, of the same generation, which Mesa sizes as M1's"
TILE_POWERVR = "; tile: Imagination's guide for all PowerVR GPUs, the chip's own is not published"


class Row(TypedDict, total=False):
    """A profile in Vulkan's masks. `counts` are those of color, depth, stencil and integer color;
    memory types are listed once each.

    `resolve` is supportedDepthResolveModes, supportedStencilResolveModes, independentResolve and
    independentResolveNone. Features are sampleRateShading unless `sample_rate_shading` says
    otherwise. `tiler` and `efficient` are stated where the vendor does not decide them. `tile`
    names a model of `tile_models.py`, where its source stands; a GPU whose budgets no open-source
    driver states (Mali-G715) has none. `hardware` is what the source says of the tile and the
    compression beyond that.
    """

    name: str
    vendor: str
    tiler: bool
    counts: tuple[int, int, int, int | None]
    memory: tuple[int, ...]
    resolve: tuple[int, int, bool | None, bool | None]
    sample_rate_shading: bool
    extensions: tuple[str, ...]
    api: str
    efficient: int
    minimum: bool
    tile: str
    compression: dict[int, tuple[float, float]]
    compression_most: tuple[float, float]
    source: str
    hardware: str


PROFILES: dict[str, Row] = {
    "mali-g76": {
        "name": "Mali-G76",
        "vendor": "arm",
        "counts": (13, 13, 13, None),
        "memory": (7, 11, 17, 33),
        "resolve": (1, 1, False, False),
        "extensions": RESOLVE,
        "api": "1.1.213",
        "tile": "mali-g76",
        "compression": {
            1: (0.484, 0.462),
            2: (1.0, 1.0),
            4: (1.0, 1.0),
            8: (1.0, 1.0),
            16: (1.0, 1.0),
        },
        "compression_most": (1.1, 1.07),
        "source": REPORT.format(38559, "Mali-G76, driver r38p1")
        + SAMPLE_RATE_SHADING.format("VP_ANDROID_baseline_2022"),
        "hardware": COMPRESSION_G76,
    },
    "mali-g610": {
        "name": "Mali-G610",
        "vendor": "arm",
        "counts": (29, 29, 29, 29),
        "memory": (7, 11, 17),
        "resolve": (1, 1, False, False),
        "extensions": SINGLE_SAMPLED,
        "api": "1.3.219",
        "tile": "mali-g610",
        "source": REPORT.format(37373, "Mali-G610 MC4, driver r38p1")
        + SAMPLE_RATE_SHADING.format("VP_ANDROID_baseline_2022"),
    },
    "mali-g715": {
        "name": "Mali-G715",
        "vendor": "arm",
        "counts": (29, 29, 29, 29),
        "memory": (7, 11, 17, 33),
        "resolve": (1, 1, False, False),
        "extensions": SINGLE_SAMPLED,
        "api": "1.3.283",
        "source": REPORT.format(38609, "Mali-G715, driver r50p0"),
    },
    "mali-g720": {
        "name": "Mali-G720",
        "vendor": "arm",
        "counts": (31, 31, 31, 31),
        "memory": (7, 11, 17, 33),
        "resolve": (1, 1, False, False),
        "extensions": SINGLE_SAMPLED,
        "api": "1.3.247",
        "tile": "mali-g720",
        "source": REPORT.format(38589, "Mali-G720-Immortalis MC12, driver r44p1")
        + SAMPLE_RATE_SHADING.format("VP_ANDROID_baseline_2022"),
    },
    "adreno-740": {
        "name": "Adreno 740",
        "vendor": "qualcomm",
        "counts": (7, 7, 7, 7),
        "memory": (1, 11, 7, 15, 33, 17),
        "resolve": (15, 5, False, False),
        "extensions": RENDERING,
        "api": "1.3.128",
        "tile": "adreno-740",
        "source": REPORT.format(38724, "Adreno (TM) 740, driver 512.676.67"),
    },
    "apple-m1": {
        "name": "Apple M1",
        "vendor": "apple",
        "counts": (7, 7, 7, None),
        "memory": (1, 15, 11, 17),
        "resolve": (13, 1, True, True),
        "extensions": RENDERING,
        "api": "1.1.216",
        "tile": "apple-g13",
        "source": REPORT.format(38819, "Apple M1, MoltenVK"),
    },
    "apple-a15": {
        "name": "Apple A15",
        "vendor": "apple",
        "counts": (7, 7, 7, 7),
        "memory": (1, 15, 17),
        "resolve": (13, 1, True, True),
        "extensions": RENDERING,
        "api": "1.2.296",
        "tile": "apple-g13",
        "source": REPORT.format(37680, "Apple A15 GPU, MoltenVK 1.2.11"),
        "hardware": TILE_A15,
    },
    "powervr": {
        "name": "PowerVR BXE-4-32",
        "vendor": "img",
        "counts": (7, 7, 7, 7),
        "memory": (1, 17, 7, 11),
        "resolve": (1, 1, True, True),
        "extensions": RENDERING,
        "api": "1.3.204",
        "tile": "powervr",
        "source": REPORT.format(35506, "PowerVR B-Series BXE-4-32, driver 1.17"),
        "hardware": TILE_POWERVR,
    },
    "v3d": {
        "name": "V3D 7.1",
        "vendor": "broadcom",
        "counts": (5, 5, 5, 5),
        "memory": (7,),
        "resolve": (1, 1, False, False),
        "extensions": RENDERING,
        "api": "1.3.305",
        "tile": "v3d-7",
        "source": REPORT.format(38811, "V3D 7.1.7 of a Raspberry Pi 5, Mesa 25.0.4"),
    },
    "samsung-xclipse": {
        "name": "Xclipse 940",
        "vendor": "samsung",
        "counts": (7, 7, 7, 15),
        "memory": (7, 1, 15, 33),
        "resolve": (13, 13, True, True),
        "extensions": AMD_MIXED,
        "api": "1.3.279",
        "source": REPORT.format(38664, "Samsung Xclipse 940, driver 24.3.9"),
        "hardware": TILER_XCLIPSE,
    },
    "nvidia": {
        "name": "GeForce RTX 4070",
        "vendor": "nvidia",
        "counts": (15, 15, 31, 15),
        "memory": (0, 1, 6, 14, 7),
        "resolve": (15, 13, True, True),
        "extensions": NV_MIXED,
        "api": "1.4.303",
        "source": REPORT.format(38868, "NVIDIA GeForce RTX 4070, driver 576.40"),
    },
    "amd": {
        "name": "Radeon RX 9070 XT",
        "vendor": "amd",
        "counts": (15, 15, 15, 15),
        "memory": (1, 6, 7, 14, 193, 198, 199, 206),
        "resolve": (13, 13, True, True),
        "extensions": AMD_MIXED,
        "api": "1.4.308",
        "source": REPORT.format(38798, "AMD Radeon RX 9070 XT, driver 25.5.1"),
    },
    "intel": {
        "name": "Arc B580",
        "vendor": "intel",
        "counts": (15, 15, 15, 15),
        "memory": (1, 6, 14, 7),
        "resolve": (15, 13, True, True),
        "extensions": RENDERING,
        "api": "1.4.311",
        "source": REPORT.format(38826, "Intel Arc B580, driver 101.6793")
        + SAMPLE_RATE_SHADING.format("VP_KHR_roadmap_2022"),
    },
    "lavapipe": {
        "name": "llvmpipe",
        "vendor": "mesa",
        "tiler": False,
        "counts": (5, 5, 5, 1),
        "memory": (15,),
        "resolve": (3, 1, False, False),
        "extensions": SINGLE_SAMPLED,
        "api": "1.3.230",
        "source": "vulkaninfo of llvmpipe, Mesa 22.3.6, LLVM 15.0.6",
    },
    "portable": {
        "name": "any Vulkan device",
        "vendor": "khronos",
        "counts": (5, 5, 5, 1),
        "resolve": (1, 1, None, None),
        "sample_rate_shading": False,
        "extensions": (),
        "api": "1.0",
        "minimum": True,
        "source": "the Vulkan specification's required limits; resolve modes: those that who "
        "offers any depth-stencil resolve must offer",
    },
    "portable-tiler": {
        "name": "any Android device of the 2022 baseline",
        "vendor": "khronos",
        "tiler": True,
        "counts": (5, 5, 5, 1),
        "resolve": (1, 1, None, None),
        "extensions": (),
        "api": "1.1.106",
        "efficient": 4,
        "minimum": True,
        "source": "Vulkan profile VP_ANDROID_baseline_2022; integer samples and resolve modes: "
        "what the Vulkan specification requires" + EFFICIENT["arm"],
    },
    "desktop": {
        "name": "any desktop device of the 2022 baseline",
        "vendor": "khronos",
        "counts": (7, 7, 7, 1),
        "resolve": (1, 1, True, True),
        "extensions": RESOLVE,
        "api": "1.1.139",
        "minimum": True,
        "source": "Vulkan profile VP_LUNARG_desktop_baseline_2022; integer samples: what the "
        "Vulkan specification requires",
    },
}
