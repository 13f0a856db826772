"""Descriptions: every list of the format, each alone and with what refers to it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from .shape import Shape, text

FRAME = "frame: {width: 64, height: 64, fps: 60}\n"
COLOR = "format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, TRANSFER_SRC]"
ONE = (
    "format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSFER_DST, TRANSFER_SRC, "
    "SAMPLED]"
)
STORE = "loadOp: CLEAR, storeOp: STORE"
BARRIER = (
    "srcStageMask: [FRAGMENT_SHADER], dstStageMask: [COLOR_ATTACHMENT_OUTPUT], "
    "srcAccessMask: [], dstAccessMask: []"
)


def lines(form: str, count: int) -> str:
    """A line for each number, which stands for each `@` of the form."""
    return "".join(form.replace("@", str(number)) + "\n" for number in range(count))


def names(form: str, count: int) -> str:
    """The same with commas, for a list on one line."""
    return ", ".join(form.replace("@", str(number)) for number in range(count))


def many(*parts: str) -> Callable[[int], str]:
    """A frame of parts; a line with a `@` is repeated for each number, the others stand once."""

    def content(count: int) -> str:
        return FRAME + "".join(lines(part, count) if "@" in part else part + "\n" for part in parts)

    return content


def described(
    name: str, *parts: str, codes: Iterable[int] = (0, 1), arguments: Iterable[str] = ()
) -> Shape:
    """A shape of such a frame."""
    return Shape(
        name,
        text("a.msaa.yaml", many(*parts)),
        ("check", "--isolated", *arguments, "."),
        tuple(codes),
    )


IMAGES = ("images:", f"  ms@: {{{COLOR}}}", f"  one@: {{{ONE}}}")
PAIR = ("images:", f"  ms: {{{COLOR}}}", f"  one: {{{ONE}}}")
PASSES = (
    "renderPasses:",
    f"  pass@: {{attachments: {{color: {{image: ms@, {STORE}}}}}, subpasses: [{{colorAttachments: "
    f"[color]}}]}}",
)
PASS = (
    "renderPasses:",
    f"  pass: {{attachments: {{color: {{image: ms, {STORE}}}}}, subpasses: [{{colorAttachments: "
    f"[color]}}]}}",
)
RESOLVING = f"color: {{image: ms, {STORE}}}, out: {{image: one, loadOp: DONT_CARE, storeOp: STORE}}"
BEGIN, END = "- beginRenderPass: {renderPass: pass}", "- endRenderPass"
BEGINS = "- beginRenderPass: {renderPass: pass@}\n- endRenderPass"
RESOLVING_SUBPASS = "{colorAttachments: [color], resolveAttachments: [out]}"


images = many(*IMAGES, "renderPasses: {}")
"""Images that no pass uses."""


def columns(count: int) -> str:
    """A pass of many attachments, all of which its subpass draws to, in many framebuffers that
    alternate.
    """
    side = max(int(count**0.5), 1)
    return (
        FRAME
        + "images:\n"
        + lines(f"  ms@: {{{COLOR}}}", side * side)
        + "renderPasses:\n  pass:\n    attachments:\n"
        + lines(f"      color@: {{{STORE}, format: R8G8B8A8_UNORM, samples: 4}}", side)
        + f"    subpasses: [{{colorAttachments: [{names('color@', side)}]}}]\nframebuffers:\n"
        + "".join(
            f"  fb{row}: {{renderPass: pass, width: 64, height: 64, attachments: "
            f"[{', '.join(f'ms{row * side + column}' for column in range(side))}]}}\n"
            for row in range(side)
        )
        + f"commands:\n- beginRenderPass: {{renderPass: pass, framebuffer: "
        f"[{names('fb@', side)}]}}\n"
    )


def subpasses_of_many(count: int) -> str:
    """Subpasses and pipelines as many as each other: a pipeline for each subpass, and as many for
    the first.
    """
    return (
        many(*PAIR)(count)
        + f"renderPasses:\n  pass:\n    attachments: {{{RESOLVING}}}\n    subpasses:\n"
        + lines(f"    - {RESOLVING_SUBPASS}", count)
        + "pipelines:\n"
        + lines(
            "  of@: {renderPass: pass, subpass: @, multisampleState: {rasterizationSamples: 4, "
            "sampleShadingEnable: true}}",
            count,
        )
        + lines(
            "  first@: {renderPass: pass, subpass: 0, multisampleState: {rasterizationSamples: 8}}",
            count,
        )
    )


def blocks(count: int) -> str:
    """Passes that each begin as often as there are of them: passes times commands."""
    side = max(int(count**0.5), 1)
    return (
        many(*IMAGES)(side)
        + many(*PASSES)(side).removeprefix(FRAME)
        + "commands:\n"
        + lines(BEGINS, side) * side
    )


def barriers_of_all(count: int) -> str:
    """Barriers that each name every image."""
    side = max(int(count**0.5), 1)
    barrier = f"- pipelineBarrier: {{{BARRIER}, images: [{names('ms@', side)}]}}\n"
    return many(*IMAGES, *PASSES)(side) + "commands:\n" + (lines(BEGINS, side) + barrier * side)


def documents(*parts: str) -> Callable[[int], str]:
    """A stream of small descriptions."""
    return lambda count: "---\n".join([many(*parts)(1)] * count)


def program(*parts: str) -> Callable[[int], str]:
    """A stream of the kinds of frame of a program, which have the same objects; their number grows
    with the objects.
    """

    def stream(count: int) -> str:
        side = max(int(count**0.5), 1)
        return "---\n".join(
            [many(*parts)(side).replace("frame: {", "frame: {share: 0.001, ", 1)] * side
        )

    return stream


def alike(count: int) -> str:
    """Two kinds of frame with many images that are alike, each in one of them."""
    first, second = (
        many(*IMAGES, *PASSES)(count).replace("frame: {", "frame: {share: 0.5, ", 1)
        for _ in range(2)
    )
    return f"{first}---\n{second.replace('ms', 'ms9').replace('  pass', '  other')}"


LISTS = (
    Shape("images", text("a.msaa.yaml", images)),
    described(
        "attachments",
        *IMAGES,
        "renderPasses:\n  pass:\n    attachments:",
        f"      color@: {{image: ms@, {STORE}}}",
        f"      out@: {{image: one@, {STORE}}}",
    ),
    Shape("attachments of alternating framebuffers", text("a.msaa.yaml", columns)),
    described(
        "attachments of one image",
        *PAIR,
        "renderPasses:\n  pass:\n    attachments:",
        f"      color@: {{image: ms, {STORE}}}",
    ),
    Shape(
        "attachments of a subpass",
        text(
            "a.msaa.yaml",
            lambda count: (
                many(
                    *IMAGES,
                    "renderPasses:\n  pass:\n    attachments:",
                    f"      color@: {{image: ms@, {STORE}}}",
                )(count)
                + many(f"      out@: {{image: one@, {STORE}}}")(count).removeprefix(FRAME)
                + f"    subpasses:\n    - {{colorAttachments: [{names('color@', count)}], "
                f"resolveAttachments: [{names('out@', count)}]}}\n"
                + f"    - {{inputAttachments: [{names('out@', count)}], preserveAttachments: "
                f"[{names('color@', count)}]}}\n"
            ),
        ),
    ),
    described("render passes", *IMAGES, *PASSES),
    described(
        "render passes of one image", *PAIR, PASSES[0], PASSES[1].replace("image: ms@", "image: ms")
    ),
    described("render passes begun", *IMAGES, *PASSES, "commands:", BEGINS),
    described(
        "render passes that resolve",
        *IMAGES,
        PASSES[0],
        f"  pass@: {{attachments: {{color: {{image: ms@, {STORE}}}, out: {{image: one@, "
        f"{STORE}}}}}, subpasses: [{RESOLVING_SUBPASS}]}}",
        "commands:",
        BEGINS,
    ),
    described("a render pass begun often", *PAIR, *PASS, "commands:", f"# @\n{BEGIN}\n{END}"),
    Shape("render passes begun often", text("a.msaa.yaml", blocks)),
    described(
        "subpasses",
        *PAIR,
        "renderPasses:\n  pass:",
        f"    attachments: {{{RESOLVING}}}\n    subpasses:",
        f"    - {RESOLVING_SUBPASS}  # @",
    ),
    described(
        "subpasses begun",
        *PAIR,
        "renderPasses:\n  pass:",
        f"    attachments: {{{RESOLVING}}}\n    subpasses:",
        f"    - {RESOLVING_SUBPASS}  # @",
        "pipelines: {p: {renderPass: pass, multisampleState: {rasterizationSamples: 4}}}",
        f"commands:\n{BEGIN}",
        "- draw: {pipeline: p, vertexCount: @}\n- nextSubpass",
    ),
    described(
        "subpasses with attachments of their own",
        *IMAGES,
        "renderPasses:\n  pass:\n    attachments:",
        f"      color@: {{image: ms@, {STORE}}}",
        f"      out@: {{image: one@, {STORE}}}",
        "    subpasses:",
        "    - {colorAttachments: [color@], resolveAttachments: [out@]}",
        "    dependencies:",
        f"    - {{srcSubpass: @, dstSubpass: EXTERNAL, {BARRIER}}}",
    ),
    described(
        "dependencies",
        *PAIR,
        "renderPasses:\n  pass:",
        f"    attachments: {{{RESOLVING}}}\n    subpasses: [{RESOLVING_SUBPASS}]\n    "
        "dependencies:",
        f"    - {{srcSubpass: EXTERNAL, dstSubpass: 0, {BARRIER}}}  # @",
        f"commands:\n{BEGIN}\n{END}\n{BEGIN}\n{END}\n- readImage: {{image: one, stage: FRAGMENT}}",
    ),
    described(
        "dynamic renderings",
        *IMAGES,
        "commands:",
        f"- beginRendering: {{colorAttachments: [{{image: ms@, {STORE}, resolveMode: AVERAGE, "
        f"resolveImage: one@}}]}}\n- endRendering",
    ),
    described(
        "dynamic renderings of one image",
        *PAIR,
        "commands:",
        f"- beginRendering: {{colorAttachments: [{{image: ms, {STORE}, resolveMode: AVERAGE, "
        f"resolveImage: one}}]}} # @\n- endRendering",
    ),
    Shape(
        "attachments of a dynamic rendering",
        text(
            "a.msaa.yaml",
            lambda count: (
                many(*IMAGES)(count)
                + "commands:\n- beginRendering:\n    colorAttachments:\n"
                + lines(
                    f"    - {{image: ms@, {STORE}, resolveMode: AVERAGE, resolveImage: one@}}",
                    count,
                )
            ),
        ),
    ),
    described(
        "a dynamic rendering aliased",
        *PAIR,
        f"commands:\n- beginRendering: &r {{colorAttachments: [{{image: ms, {STORE}}}]}}\n- "
        "endRendering",
        "- beginRendering: *r  # @\n- endRendering",
    ),
    described(
        "framebuffers",
        *IMAGES,
        PASSES[0] + "\n  pass: {attachments: {color: {loadOp: CLEAR, storeOp: STORE}}, subpasses: "
        "[{colorAttachments: [color]}]}\nframebuffers:",
        "  fb@: {renderPass: pass, attachments: [ms@], width: 64, height: 64}",
    ),
    described(
        "framebuffers begun",
        *IMAGES,
        PASSES[0] + "\n  pass: {attachments: {color: {loadOp: CLEAR, storeOp: STORE}}, subpasses: "
        "[{colorAttachments: [color]}]}\nframebuffers:",
        "  fb@: {renderPass: pass, attachments: [ms@], width: 64, height: 64}",
        "commands:",
        "- beginRenderPass: {renderPass: pass, framebuffer: fb@}\n- endRenderPass",
    ),
    described(
        "pipelines of a subpass",
        *PAIR,
        *PASS,
        "pipelines:",
        "  p@: {renderPass: pass, subpass: 0, multisampleState: {rasterizationSamples: 8, "
        "sampleShadingEnable: true, minSampleShading: 1.0}}",
        f"commands:\n{BEGIN}",
        "- draw: {pipeline: p@, vertexCount: 3}",
    ),
    described(
        "pipelines of passes",
        *IMAGES,
        *PASSES,
        "pipelines:",
        "  p@: {renderPass: pass@, subpass: 0, multisampleState: {rasterizationSamples: 4, "
        "alphaToCoverageEnable: true}}",
        "commands:",
        "- beginRenderPass: {renderPass: pass@}\n- draw: {pipeline: p@, vertexCount: 3}\n- "
        "endRenderPass",
    ),
    Shape("pipelines times subpasses", text("a.msaa.yaml", subpasses_of_many)),
    described(
        "pipelines with many states",
        *PAIR,
        *PASS,
        "pipelines:\n  p:\n    renderPass: pass\n    dynamicState: [VIEWPORT]\n    stages:",
        "    - {stage: VERTEX, module: no/@.spv}",
    ),
    described(
        "pipelines for dynamic rendering",
        "pipelines:",
        "  p@: {rendering: {colorAttachmentFormats: [R8G8B8A8_UNORM]}, multisampleState: "
        "{rasterizationSamples: 8}}",
    ),
    described(
        "sample count choices",
        "sampleCountChoices:",
        "  c@: {limits: [framebufferColorSampleCounts], tests: [{tests: 8, gives: 8}, {tests: 8, "
        "gives: 4}]}",
    ),
    described(
        "sample count tests",
        "sampleCountChoices:\n  c:\n    limits: [framebufferColorSampleCounts]\n    tests:",
        "    - {tests: 8, gives: 4}  # @",
    ),
    Shape("documents", text("a.msaa.yaml", documents(*PAIR, *PASS))),
    Shape("kinds of frame", text("a.msaa.yaml", program(*IMAGES, *PASSES))),
    Shape("alike images of kinds of frame", text("a.msaa.yaml", alike)),
    described(
        "render targets",
        "device: adreno-740\nrenderTargets:",
        "  t@: {api: vulkan, width: 64, height: 64, sampleCount: kCount4, stencilAttachmentConfig: "
        "{storeAction: kStore}}",
    ),
    described(
        "render targets in Metal",
        "renderTargets:",
        "  t@: {api: metal, width: 64, height: 64, sampleCount: kCount4, stencilAttachmentConfig: "
        "{storeAction: kStore}}",
    ),
    described(
        "device with many extensions",
        "device:\n  name: d\n  extensions:",
        "  - VK_EXT_e@",
        "  features:",
        "  - feature@",
        "  memoryTypes:",
        "  - [DEVICE_LOCAL]  # @",
    ),
)


def command(name: str, *commands: str, begun: bool = True) -> Shape:
    """A shape of a command for each number, after a pass that draws to each image."""
    return described(name, *IMAGES, *PASSES, "commands:", *([BEGINS] if begun else []), *commands)


COMMANDS = (
    command("resolves", "- resolveImage: {srcImage: ms@, dstImage: one@}"),
    command(
        "resolves after each pass",
        "- beginRenderPass: {renderPass: pass@}\n- endRenderPass\n- resolveImage: {srcImage: ms@, "
        "dstImage: one@}",
        begun=False,
    ),
    described(
        "resolves of one image",
        *IMAGES,
        *PASSES,
        f"commands:\n{BEGIN}0}}\n{END}".replace("pass}", "pass"),
        "- resolveImage: {srcImage: ms0, dstImage: one@}",
    ),
    described(
        "resolves of one image to one",
        *IMAGES,
        *PASSES,
        f"commands:\n{BEGIN}0}}\n{END}".replace("pass}", "pass"),
        "- resolveImage: {srcImage: ms0, dstImage: one0}  # @",
    ),
    command("resolves to one image", "- resolveImage: {srcImage: ms@, dstImage: one0}"),
    command(
        "resolves that are read",
        "- resolveImage: {srcImage: ms@, dstImage: one@}",
        "- readImage: {image: one@, stage: FRAGMENT}",
    ),
    command(
        "copies",
        "- copyImage: {srcImage: one@, dstImage: ms@}",
        "- copyImageToBuffer: {srcImage: one@}",
        "- copyBufferToImage: {dstImage: one@}",
    ),
    command("copies of one image", "- copyImage: {srcImage: one0, dstImage: one1} # @"),
    command("blits", "- blitImage: {srcImage: one@, dstImage: one@}"),
    command(
        "copies that are loaded",
        "- copyImage: {srcImage: one@, dstImage: ms@}\n- beginRendering: {colorAttachments: "
        "[{image: ms@, loadOp: LOAD, storeOp: STORE}]}\n- endRendering",
    ),
    command(
        "clears",
        "- clearColorImage: {image: ms@}\n- beginRendering: {colorAttachments: [{image: ms@, "
        "loadOp: LOAD, storeOp: STORE}]}\n- endRendering",
    ),
    command("clears of one image", "- clearColorImage: {image: ms0} # @"),
    described(
        "clears in a pass",
        *PAIR,
        *PASS,
        f"commands:\n{BEGIN}",
        "- clearAttachments: {attachments: [{aspect: COLOR, colorAttachment: 0}], rects: [{x: @, "
        "y: 0, width: 64, height: 64}]}",
    ),
    described(
        "attachments of a clear",
        *PAIR,
        *PASS,
        f"commands:\n{BEGIN}\n- clearAttachments:\n    attachments:",
        "    - {aspect: COLOR, colorAttachment: 0} # @",
        "    rects:",
        "    - {x: @, y: 0, width: 64, height: 64}",
    ),
    command(
        "reads and writes",
        "- writeImage: {image: one@, stage: COMPUTE}",
        "- readImage: {image: ms@, stage: FRAGMENT, samples: ALL, resolves: AVERAGE}",
    ),
    command(
        "reads of one image",
        "- readImage: {image: ms0, stage: FRAGMENT, samples: ALL, resolves: AVERAGE} # @",
    ),
    described(
        "reads in a pass",
        *PAIR,
        *PASS,
        "pipelines:",
        "  p@: {renderPass: pass, stages: [{stage: FRAGMENT, module: no.spv}]}",
        f"commands:\n{BEGIN}",
        "- draw: {pipeline: p@}\n- readImage: {image: one, stage: FRAGMENT, samples: ALL}",
    ),
    command(
        "barriers",
        f"- pipelineBarrier: {{{BARRIER}, images: [{{image: one@, oldLayout: GENERAL, newLayout: "
        f"GENERAL}}, ms@]}}",
    ),
    command("barriers of one image", f"- pipelineBarrier: {{{BARRIER}, images: [one0]}} # @"),
    command(
        "barriers of no image",
        "- resolveImage: {srcImage: ms@, dstImage: one@}",
        f"- pipelineBarrier: {{{BARRIER}}} # @",
        "- readImage: {image: one@, stage: FRAGMENT}",
    ),
    command(
        "barriers between resolves and reads",
        f"- resolveImage: {{srcImage: ms@, dstImage: one@}}\n- pipelineBarrier: {{{BARRIER}, "
        f"images: [one@]}}\n- readImage: {{image: one@, stage: FRAGMENT}}",
    ),
    Shape("barriers of all images", text("a.msaa.yaml", barriers_of_all)),
    command("presents", "- present: {image: one@}"),
    described(
        "draws",
        *PAIR,
        *PASS,
        "pipelines: {p: {renderPass: pass, multisampleState: {rasterizationSamples: 4}}}",
        f"commands:\n{BEGIN}",
        "- draw: {pipeline: p, vertexCount: @}\n- setRasterizationSamples: 4",
    ),
)

TEXTURES = (
    "metal:\n  family: apple7\n  textures:",
    "    ms@: {pixelFormat: bgra8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: "
    "[renderTarget], storageMode: private}",
    "    one@: {pixelFormat: bgra8Unorm, textureType: type2D, usage: [renderTarget, shaderRead], "
    "storageMode: private}",
)
METAL_PASSES = (
    "  renderPasses:",
    "    pass@: {colorAttachments: [{texture: ms@, resolveTexture: one@, loadAction: load, "
    "storeAction: storeAndMultisampleResolve}]}",
)

METAL = (
    described("Metal render passes", *TEXTURES, *METAL_PASSES),
    described(
        "Metal pipelines",
        *TEXTURES,
        *METAL_PASSES,
        "  renderPipelines:",
        "    p@: {renderPass: pass@, rasterSampleCount: 2, colorAttachments: [{pixelFormat: "
        "rgba8Unorm}]}",
    ),
    described(
        "Metal pipelines of a pass",
        *TEXTURES,
        *METAL_PASSES,
        "  renderPipelines:",
        "    p@: {renderPass: pass0, rasterSampleCount: 2}",
    ),
    described(
        "Metal commands",
        *TEXTURES,
        *METAL_PASSES,
        "  commands:",
        "  - renderPass: pass@\n  - copy: {source: one@, destination: ms@}\n  - readTexture: "
        "{texture: one@, stage: fragment}\n  - writeTexture: {texture: one@, stage: compute}",
    ),
    described(
        "a Metal pass encoded often",
        *TEXTURES,
        *METAL_PASSES,
        "  commands:",
        "  - renderPass: pass0 # @\n  - readTexture: {texture: ms0, stage: fragment}",
    ),
)

OUTPUT = ("--output", "html=a.html")
PAGES = (
    described("page of findings", *IMAGES, *PASSES, arguments=OUTPUT),
    Shape(
        "page of documents",
        text("a.msaa.yaml", documents(*PAIR, *PASS)),
        ("check", "--isolated", *OUTPUT, "."),
    ),
    Shape(
        "page of costs",
        text("a.msaa.yaml", many(*IMAGES, *PASSES, "commands:", BEGINS)),
        ("cost", "--isolated", *OUTPUT, "."),
    ),
    Shape(
        "page of a pass encoded often",
        text(
            "a.msaa.yaml",
            many(
                *PAIR,
                *PASS,
                "commands:",
                f"{BEGIN} # @\n{END}\n- readImage: {{image: ms, stage: FRAGMENT, access: "
                f"SHADER_READ}}",
            ),
        ),
        ("cost", "--isolated", *OUTPUT, "."),
    ),
)

SHAPES = (*LISTS, *COMMANDS, *METAL, *PAGES)
