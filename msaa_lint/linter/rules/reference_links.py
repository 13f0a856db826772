"""The public pages of rules, and those that their references name: a rule page cites a source in
words, and a table knows where it is published.
"""

from __future__ import annotations

import re

_SPECIFICATION = "https://docs.vulkan.org/spec/latest/chapters/"
_REFERENCE_PAGE = r"https://docs.vulkan.org/refpages/latest/refpages/source/\1.html"
_LAYERS = "https://github.com/KhronosGroup/Vulkan-ValidationLayers/blob/main/docs/"
_APPLE = "https://developer.apple.com/documentation/"

_PAGES = (
    (r"(https?://[\w.~:/?#@!$&'()*+,;=%-]*[\w/])", r"\1"),
    (r"VUID-(\w+)-[\w-]+", rf"{_REFERENCE_PAGE}#\g<0>"),
    ("BestPractices-", f"{_LAYERS}best_practices.md"),
    (".*synchronization validation", f"{_LAYERS}syncval_usage.md"),
    (
        r"Khronos Vulkan-Samples, (samples/performance/\w+)",
        r"https://docs.vulkan.org/samples/latest/\1/README.html",
    ),
    (
        r"(?:Vulkan specification, (?:[\w -]+: )?)?([Vv]k[A-Z]\w+|VK_(?:EXT|KHR)_[a-z]\w+)",
        _REFERENCE_PAGE,
    ),
    (
        "Vulkan specification, .*Render Pass Store Operations",
        f"{_SPECIFICATION}renderpass.html#renderpass-store-operations",
    ),
    (
        "Vulkan specification, .*Render Pass Load Operations",
        f"{_SPECIFICATION}renderpass.html#renderpass-load-operations",
    ),
    (
        "Vulkan specification, .*(?i:multisample resolve operations)",
        f"{_SPECIFICATION}renderpass.html#renderpass-resolve-operations",
    ),
    (
        "Vulkan specification, .*Implicit Synchronization",
        f"{_SPECIFICATION}synchronization.html#synchronization-implicit",
    ),
    (
        "Vulkan specification, Synchronization",
        f"{_SPECIFICATION}synchronization.html#synchronization-dependencies",
    ),
    ("Vulkan specification, Render Pass", f"{_SPECIFICATION}renderpass.html"),
    ("Vulkan specification, Multisample Coverage", f"{_SPECIFICATION}fragops.html#fragops-covg"),
    (
        "Vulkan specification, Sample Shading",
        f"{_SPECIFICATION}primsrast.html#primsrast-sampleshading",
    ),
    (
        "Vulkan specification, .*Multisampling",
        f"{_SPECIFICATION}primsrast.html#primsrast-multisampling",
    ),
    ("Vulkan specification, Rasterization", f"{_SPECIFICATION}primsrast.html"),
    ("Vulkan specification, Required Limits", f"{_SPECIFICATION}limits.html#limits-required"),
    (
        "Vulkan specification, Resource Memory Association",
        f"{_SPECIFICATION}resources.html#resources-association",
    ),
    ("Vulkan specification, Device Memory", f"{_SPECIFICATION}memory.html#memory-device"),
    ("Vulkan specification, SPIR-V Image Operands", f"{_SPECIFICATION}textures.html"),
    (
        r"Arm GPU Best Practices Developer Guide \(101897\)",
        "https://developer.arm.com/documentation/101897/latest/",
    ),
    (
        "Apple, Metal Best Practices Guide: Load and Store Actions",
        "https://developer.apple.com/library/archive/documentation/3DDrawing/Conceptual/MTLBestPracticesGuide/LoadandStoreActions.html",
    ),
    (
        "Apple, .*Improving edge-rendering quality",
        f"{_APPLE}metal/improving-edge-rendering-quality-with-multisample-antialiasing-msaa",
    ),
    (
        r"Apple, Metal: (MTL(?:\w+Descriptor|\w+Action|\w+Mode|\w+Filter|\w+Usage|Device))\b",
        rf"{_APPLE}metal/\1",
    ),
    (r"Apple, MetalKit: (MTKView)", rf"{_APPLE}metalkit/\1"),
    (r"Apple, Core Animation: (CAMetalLayer)", rf"{_APPLE}quartzcore/\1"),
    (r"([\w-]+/[\w.-]+) issue (\d+)", r"https://github.com/\1/issues/\2"),
    (r"([\w-]+/[\w.-]+) pull request (\d+)", r"https://github.com/\1/pull/\2"),
    ("vulkan.gpuinfo.org", "https://vulkan.gpuinfo.org/"),
    ("GLSL specification", "https://registry.khronos.org/OpenGL/specs/gl/GLSLangSpec.4.60.html"),
    (
        "IEEE 754 binary16",
        "https://registry.khronos.org/DataFormat/specs/1.3/dataformat.1.3.html#16bitfp",
    ),
)
"""How a reference begins, and the page that it names. The first match counts. An address in the
text is found anywhere.
"""


def link(reference: str) -> str:
    """The address of the page that a reference names; empty if it names none that is known."""
    for number, (pattern, page) in enumerate(_PAGES):
        found = (re.search if number == 0 else re.match)(pattern, reference, re.ASCII)
        if found:
            return found.expand(page)
    return ""


def rule_address(docs_url: str, code: str, name: str) -> str:
    """The address of the page of a rule on the site of the documentation, whose address is
    `docs_url`.

    Empty if that is, and for what has no page there: the user's own rules, whose codes cannot begin
    with MSAA, and diagnostics (9xx).
    """
    has_page = re.match("MSAA[0-8]", code) and re.fullmatch("[a-z0-9-]+", name)
    return f"{docs_url}/rules/{name}/" if docs_url and has_page else ""
