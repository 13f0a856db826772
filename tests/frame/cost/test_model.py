"""What each cause of traffic costs, to the byte; what is not known is not counted, and named."""

from __future__ import annotations

import pytest

from msaa_lint.frame.cost.amounts import Amount, FrameCost, PassCost, Terms
from tests.frame.cost.frames import cost, example, lines, of_pass

PIXELS = 1920 * 1080


def begun(
    attachments: str, subpasses: str, begin: str = "", images: str = "", more: str = ""
) -> str:
    """A frame of 1920x1080 with one render pass `p`, begun once."""
    return f"""
frame: {{width: 1920, height: 1080, fps: 60}}
images:
  unused: {{format: R8_UNORM, samples: 1, extent: {{width: 1, height: 1, depth: 1}}}}
{images}
renderPasses:
  p:
    attachments: {{{attachments}}}
    subpasses: [{subpasses}]
commands:
  - beginRenderPass: {{renderPass: p{begin}}}
  - endRenderPass
{more}
"""


def only(found: FrameCost) -> PassCost:
    (one,) = found.passes
    return one


MS = "c: {format: R8G8B8A8_UNORM, samples: 4, loadOp: LOAD_OP, storeOp: STORE_OP}"


@pytest.mark.parametrize(
    ("load", "store", "read", "written"),
    [
        ("LOAD", "STORE", 4, 4), ("CLEAR", "STORE", 0, 4), ("LOAD", "DONT_CARE", 4, 0),
        ("DONT_CARE", "DONT_CARE", 0, 0),
        ("NONE", "NONE", 0, 0),
    ],
)  # fmt: skip
def test_operations(load: str, store: str, read: int, written: int) -> None:
    text = begun(MS.replace("LOAD_OP", load).replace("STORE_OP", store), "{colorAttachments: [c]}")
    found = cost(text)
    assert found.total.read_mb_per_s == read * PIXELS * 4 * 60 / 1e6
    assert found.total.write_mb_per_s == written * PIXELS * 4 * 60 / 1e6
    assert found.unknown == ()


def test_a_line_says_what_it_is() -> None:
    (line,) = only(
        cost(
            begun(
                MS.replace("LOAD_OP", "LOAD").replace("STORE_OP", "NONE"), "{colorAttachments: [c]}"
            )
        )
    ).lines
    assert (line.attachment, line.aspect, line.samples, line.action, line.direction) == (
        "c",
        "color",
        4,
        "load",
        "read",
    )
    assert line.bytes == PIXELS * 16
    assert line.corrected is None
    assert line.place is not None


@pytest.mark.parametrize(
    ("format", "depth", "stencil"),
    [
        ("D16_UNORM", 2, None), ("X8_D24_UNORM_PACK32", 4, None), ("D32_SFLOAT", 4, None),
        ("S8_UINT", None, 1),
        ("D16_UNORM_S8_UINT", 2, 1),
        ("D24_UNORM_S8_UINT", 3, 1), ("D32_SFLOAT_S8_UINT", 4, 1),
    ],
)  # fmt: skip
def test_aspects_of_depth_and_stencil(format: str, depth: int | None, stencil: int | None) -> None:
    attachment = (
        f"d: {{format: {format}, samples: 4, loadOp: CLEAR, storeOp: STORE, "
        f"stencilLoadOp: LOAD, stencilStoreOp: DONT_CARE}}"
    )
    expected = []
    if depth is not None:
        expected.append(("d", "depth", "store", "write", PIXELS * 4 * depth))
    if stencil is not None:
        expected.append(("d", "stencil", "load", "read", PIXELS * 4 * stencil))
    assert lines(only(cost(begun(attachment, "{depthStencilAttachment: d}")))) == expected


RESOLVED = """c: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: DONT_CARE},
      o: {format: R8G8B8A8_UNORM, samples: 1, loadOp: DONT_CARE, storeOp: KEPT}"""


@pytest.mark.parametrize(("store", "written"), [("STORE", PIXELS * 4), ("DONT_CARE", 0)])
def test_a_resolve_in_the_pass_writes_one_sample_if_it_is_stored(store: str, written: int) -> None:
    found = only(
        cost(
            begun(
                RESOLVED.replace("KEPT", store), "{colorAttachments: [c], resolveAttachments: [o]}"
            )
        )
    )
    assert lines(found) == ([("o", "color", "resolve", "write", written)] if written else [])


def test_attachments_that_no_subpass_uses_move_nothing() -> None:
    text = begun(
        MS.replace("LOAD_OP", "LOAD").replace("STORE_OP", "STORE")
        + ", o: {format: R8_UNORM, samples: 1, loadOp: CLEAR, storeOp: STORE}",
        "{colorAttachments: [o]}",
    )
    assert lines(only(cost(text))) == [("o", "color", "store", "write", PIXELS)]


def test_render_to_single_sampled_loads_and_stores_one_sample() -> None:
    text = begun(
        "c: {format: R8G8B8A8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE}",
        "{colorAttachments: [c], multisampledRenderToSingleSampled: {rasterizationSamples: 4}}",
    )
    assert [line[4] for line in lines(only(cost(text)))] == [PIXELS * 4, PIXELS * 4]


STORED = "c: {format: R8G8B8A8_UNORM, samples: 4, loadOp: CLEAR, storeOp: STORE}"


@pytest.mark.parametrize(
    ("begin", "pixels"),
    [
        (", renderArea: {x: 0, y: 0, width: 100, height: 50}", 5000),
        (", renderArea: {x: 1900, y: 1000, width: 100, height: 100}", 20 * 80),
        (", renderArea: {x: 20, y: 0, width: 2000, height: 2000}", 1900 * 1080),
        (", renderArea: {x: -20, y: 0, width: 100, height: 10}", 800),
        (", renderArea: {x: 5000, y: 0, width: 100, height: 10}", 0),
        (", renderArea: {width: 100}", 100 * 1080),
    ],
)
def test_a_render_area_counts_what_it_covers(begin: str, pixels: int) -> None:
    assert (
        sum(
            line.bytes for line in only(cost(begun(STORED, "{colorAttachments: [c]}", begin))).lines
        )
        == pixels * 16
    )


def test_a_pass_counts_as_often_as_it_begins() -> None:
    more = (
        "  - beginRenderPass: {renderPass: p, renderArea: {x: 0, y: 0, width: 10, height: 10}}\n"
        "  - endRenderPass\n"
    )
    found = only(cost(begun(STORED, "{colorAttachments: [c]}", more=more * 2)))
    assert found.times == 3
    assert [line.bytes for line in found.lines] == [(PIXELS + 200) * 16]


def test_a_pass_that_nothing_begins_is_not_in_the_frame() -> None:
    text = begun(STORED, "{colorAttachments: [c]}").replace(
        "commands:", "  q:\n    attachments: [{}]\n    subpasses: [{}]\ncommands:"
    )
    found = cost(text)
    assert [each.name for each in found.passes] == ["p"]
    assert found.unknown == ("`q`: no command begins it",)


def test_without_commands_every_pass_runs_once() -> None:
    found = cost(begun(STORED, "{colorAttachments: [c]}").split("commands:")[0])
    assert [(each.name, each.times) for each in found.passes] == [("p", 1)]
    assert found.total.write_mb_per_s == PIXELS * 16 * 60 / 1e6


@pytest.mark.parametrize(
    ("subpass", "image", "framebuffer", "layers"),
    [
        ("viewMask: 0b11, ", "", "", 2),
        ("viewMask: 0b1011, ", "arrayLayers: 4,", "layers: 1,", 3),
        ("", "arrayLayers: 6,", "layers: 2,", 2),
        ("", "arrayLayers: 6,", "", 6),
        ("", "", "layers: 5,", 5),
        ("", "", "", 1),
    ],
)
def test_layers(subpass: str, image: str, framebuffer: str, layers: int) -> None:
    text = f"""
images: {{i: {{format: R8G8B8A8_UNORM, {image} samples: 1}}}}
renderPasses:
  p:
    attachments: [{{image: i, loadOp: CLEAR, storeOp: STORE}}]
    subpasses: [{{{subpass.replace("0b1011", "11").replace("0b11", "3")}colorAttachments: [0]}}]
framebuffers: {{f: {{renderPass: p, attachments: [i], {framebuffer} width: 10, height: 10}}}}
"""
    found = cost(text)
    assert [line.bytes for line in only(found).lines] == [400 * layers]
    assert any("layers" in text for text in found.assumed) == (layers == 6)


SIZES = """
frame: {width: 7, height: 7}
images: {i: {format: R8_UNORM, samples: 1EXTENT}, j: {format: R8_UNORM, samples: 1, extent: {width: 40, height: 30, depth: 1}}}
renderPasses:
  p:
    attachments: [{image: i, loadOp: CLEAR, storeOp: STORE}SECOND]
    subpasses: [{colorAttachments: [ATTACHED]}]
FRAMEBUFFER
"""


@pytest.mark.parametrize(
    ("extent", "second", "framebuffer", "pixels", "image"),
    [
        ("", False, "", 49, 49),
        (
            "",
            False,
            "framebuffers: {f: {renderPass: p, attachments: [i], width: 20, height: 10, layers: "
            "1}}",
            200,
            200,
        ),
        (", extent: {width: 50, height: 50, depth: 1}", False, "", 2500, 2500),
        (", extent: {width: 50, height: 50, depth: 1}", True, "", 1200, 2500),
        ("", True, "", 1200, 1200),
        (", extent: {width: 50}", False, "", 350, 350),
    ],
)
def test_sizes_come_from_framebuffers_and_images_before_the_frame(
    extent: str, second: bool, framebuffer: str, pixels: int, image: int
) -> None:
    text = SIZES.replace("EXTENT", extent).replace("FRAMEBUFFER", framebuffer)
    text = text.replace(
        "SECOND", ", {image: j, loadOp: CLEAR, storeOp: DONT_CARE}" if second else ""
    ).replace("ATTACHED", "0, 1" if second else "0")
    found = cost(text)
    assert [line.bytes for line in only(found).lines] == [pixels]
    assert found.images[0].bytes == image


def test_a_caller_may_say_the_size_and_the_rates() -> None:
    text = begun(STORED, "{colorAttachments: [c]}")
    found = cost(
        text,
        terms=Terms(fps=30, width=100, height=100, milliwatts_per_gbps=50, budget_milliwatts=1000),
    )
    assert found.total.write_mb_per_s == 100 * 100 * 16 * 30 / 1e6
    assert found.total.milliwatts == pytest.approx(4.8e6 / 1e9 * 50)
    assert found.budget_share == pytest.approx(found.total.milliwatts / 1000)
    assert found.fps == 30


def test_sixty_frames_a_second_are_assumed_and_said() -> None:
    text = begun(STORED, "{colorAttachments: [c]}").replace(", fps: 60", "")
    assert cost(text).assumed == ("60 frames a second",)
    assert cost(text, terms=Terms(fps=60)).assumed == ()


def test_a_device_may_say_its_power() -> None:
    text = begun(STORED, "{colorAttachments: [c]}") + "device: {milliwattsPerGBps: 40}\n"
    found = cost(text)
    assert found.total.milliwatts == pytest.approx(found.total.write_mb_per_s * 0.04)
    assert cost(text, terms=Terms(milliwatts_per_gbps=10)).total.milliwatts == pytest.approx(
        found.total.milliwatts / 4
    )


COMMANDS = """
frame: {width: 100, height: 10, fps: 60}
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4}
  one: {format: R8G8B8A8_UNORM, samples: 1}
  half: {format: R8G8B8A8_UNORM, samples: 1, extent: {width: 50, height: 5, depth: 1}}
  depth: {format: D24_UNORM_S8_UINT, samples: 4}
  layered: {format: R8_UNORM, samples: 1, arrayLayers: 3}
  packed: {format: BC1_RGB_UNORM_BLOCK, samples: 1, extent: {width: 10, height: 10, depth: 1}}
commands:
  - COMMAND
"""


@pytest.mark.parametrize(
    ("command", "expected"),
    [
        ("resolveImage: {srcImage: ms, dstImage: one}", [
            ("ms", "color", "resolve command", "read", 16000), ("one", "color", "resolve command",
            "write", 4000),
        ]),
        ("resolveImage: {srcImage: depth, dstImage: depth}", [
            ("depth", "depth", "resolve command", "read", 12000), ("depth", "stencil", "resolve "
                "command", "read", 4000),
            ("depth", "depth", "resolve command", "write", 3000), ("depth", "stencil", "resolve "
                "command", "write", 1000),
        ]),
        ("copyImage: {srcImage: ms, dstImage: ms}", [("ms", "color", "copy", "read", 16000), ("ms",
        "color", "copy", "write", 16000)]),
        ("copyImage: {srcImage: one, dstImage: half}", [("one", "color", "copy", "read", 1000),
        ("half", "color", "copy", "write", 1000)]),
        ("blitImage: {srcImage: one, dstImage: half}", [("one", "color", "copy", "read", 4000),
        ("half", "color", "copy", "write", 1000)]),
        ("clearColorImage: {image: ms}", [("ms", "color", "clear", "write", 16000)]),
        ("clearDepthStencilImage: {image: depth}", [
            ("depth", "depth", "clear", "write", 12000), ("depth", "stencil", "clear", "write",
            4000),
        ]),
        ("writeImage: {image: layered}", [("layered", "color", "write", "write", 3000)]),
        ("readImage: {image: ms, samples: 1}", [("ms", "color", "read", "read", 4000)]),
        ("readImage: {image: ms, samples: ALL}", [("ms", "color", "read", "read", 16000)]),
        ("readImage: {image: ms}", [("ms", "color", "read", "read", 16000)]),
        ("readImage: {image: depth, samples: 1}", [("depth", "depth", "read", "read", 3000)]),
        ("copyImageToBuffer: {srcImage: one}", [("one", "color", "copy", "read", 4000), ("buffer",
        "color", "copy", "write", 4000)]),
        ("copyBufferToImage: {dstImage: packed}", [("packed", "color", "copy", "write", 72),
        ("buffer", "color", "copy", "read", 72)]),
    ],
)  # fmt: skip
def test_commands(command: str, expected: list[tuple[str, str, str, str, int]]) -> None:
    found = cost(COMMANDS.replace("COMMAND", command))
    assert lines(only(found)) == expected
    assert only(found).kind == "command"
    assert found.unknown == ()
    assert found.assumed == (
        ("the reader of `ms` fetches all 4 samples",) if command == "readImage: {image: ms}" else ()
    )


@pytest.mark.parametrize(
    "command", ["present: {image: one}", "pipelineBarrier: {images: [one]}", "clearAttachments: {}"]
)
def test_what_moves_nothing(command: str) -> None:
    assert cost(COMMANDS.replace("COMMAND", command)).passes == ()


RENDERING = """
frame: {width: 10, height: 10, fps: 60}
images:
  ms: {format: R8G8B8A8_UNORM, samples: 4}
  depth: {format: D24_UNORM_S8_UINT, samples: 4}
  one: {format: R8G8B8A8_UNORM, samples: 1}
commands:
  - beginRendering:
      FLAGS
      colorAttachments: [{image: ms, loadOp: LOAD, storeOp: STORE, resolveMode: AVERAGE, resolveImage: one}]
      depthAttachment: {image: depth, loadOp: CLEAR, storeOp: STORE}
      stencilAttachment: {image: depth, loadOp: LOAD, storeOp: NONE}
  - endRendering
"""
LOADS = [("ms", "color", "load", "read", 1600), ("depth", "stencil", "load", "read", 400)]
STORES = [
    ("ms", "color", "store", "write", 1600),
    ("depth", "depth", "store", "write", 1200),
    ("one", "color", "resolve", "write", 400),
]


@pytest.mark.parametrize(
    ("flags", "expected"),
    [
        ("", [*LOADS, *STORES]), ("flags: [SUSPENDING]", LOADS), ("flags: [RESUMING]", STORES),
        ("layerCount: 2", [(*line[:4], line[4] * 2) for line in [*LOADS, *STORES]]),
        ("viewMask: 7", [(*line[:4], line[4] * 3) for line in [*LOADS, *STORES]]),
        ("renderArea: {x: 0, y: 0, width: 5, height: 10}", [(*line[:4],
        line[4] // 2) for line in [*LOADS, *STORES]]),
    ],
)  # fmt: skip
def test_dynamic_rendering(flags: str, expected: list[tuple[str, str, str, str, int]]) -> None:
    """A resumed rendering loads nothing; a suspended one stores and resolves nothing."""
    found = only(cost(RENDERING.replace("FLAGS", flags)))
    assert sorted(lines(found)) == sorted(expected)
    assert (found.name, found.kind, found.width) == (
        "rendering0",
        "rendering",
        5 if "renderArea" in flags else 10,
    )


LOCAL = """
frame: {width: 10, height: 10, fps: 60}
DEVICE
images: {a: {format: R8_UNORM, samples: 4}, b: {format: R8_UNORM, samples: 1}}
renderPasses:
  p:
    attachments: {a: {image: a, loadOp: CLEAR, storeOp: DONT_CARE}, b: {image: b, loadOp: DONT_CARE, storeOp: STORE}}
    subpasses: [{colorAttachments: [a]}, {inputAttachments: [a], colorAttachments: [b]}]
commands:
  - beginRenderPass: {renderPass: p}
  - nextSubpass
  - readImage: {image: a}
  - endRenderPass
"""


def test_input_attachments_stay_on_the_tile() -> None:
    stored = ("b", "color", "store", "write", 100)
    unknown, tiler = (
        cost(LOCAL.replace("DEVICE", "")),
        cost(LOCAL.replace("DEVICE", "device: mali-g76")),
    )
    assert lines(only(unknown)) == lines(only(tiler)) == [stored]
    assert unknown.assumed == ("input attachments are read on the tile",)
    assert tiler.assumed == ()


def test_input_attachments_are_read_where_there_are_no_tiles() -> None:
    found = cost(LOCAL.replace("DEVICE", "device: nvidia"))
    written = [
        ("a", "color", "write", "write", 400),
        ("a", "color", "input", "read", 400),
        ("b", "color", "write", "write", 100),
    ]
    assert lines(only(found)) == written
    assert any("is an immediate-mode GPU" in text for text in found.assumed)


def test_reads_inside_a_pass_are_the_pass_s() -> None:
    found = example("khronos-msaa/inline.msaa.yaml")
    post = of_pass(found, "post")
    assert [(line.image, line.action) for line in post.lines] == [
        ("backbuffer", "store"),
        ("color", "read"),
        ("depth", "read"),
    ]


@pytest.mark.parametrize(
    ("attachment", "text"),
    [
        (
            "c: {format: R8_UNORM, samples: 1, storeOp: DONT_CARE}",
            "`p`: whether `c` is loaded: loadOp is not stated",
        ),
        (
            "c: {format: R8_UNORM, samples: 1, loadOp: CLEAR}",
            "`p`: whether `c` is stored: storeOp is not stated",
        ),
        (
            "c: {samples: 1, loadOp: CLEAR, storeOp: STORE}",
            "`p`: `c`: its format is not stated: write `format`",
        ),
        (
            "c: {format: R8_UNORM, loadOp: CLEAR, storeOp: STORE}",
            "`p`: `c`: its sample count is not stated: write `samples`",
        ),
    ],
)
def test_what_is_not_stated_is_not_counted_and_named(attachment: str, text: str) -> None:
    found = cost(begun(attachment, "{colorAttachments: [c]}"))
    assert found.total[:2] == (0, 0)
    assert found.unknown == (text,)


def test_without_a_size_nothing_is_counted() -> None:
    text = begun(
        STORED, "{colorAttachments: [c]}", images="  n: {format: R8_UNORM, samples: 1}"
    ).replace("frame: {width: 1920, height: 1080, fps: 60}", "")
    found = cost(text)
    assert found.total == Amount(0, 0, 1 / 2**20, 0)
    assert found.unknown == (
        "`p`: its size is not stated: write `frame: {width: ..., height: ...}`",
        "`n`: what it takes of memory",
    )
    assert cost(text, terms=Terms(width=10, height=10)).total.write_mb_per_s > 0


def test_a_command_on_images_of_unknown_form() -> None:
    found = cost(
        "images: {a: {}, b: {format: R8_UNORM}}\n"
        "commands: [resolveImage: {srcImage: a, dstImage: b}, readImage: {}, copyImage: {srcImage: "
        "a}]"
    )
    assert found.total[:2] == (0, 0)
    assert len(found.unknown) == 6


def test_correction_is_by_the_image_s_samples_and_the_direction() -> None:
    text = """
frame: {width: 100, height: 10, fps: 60}
device: {compression: {1 read: 0.25, 1 write: 0.5, 4: 0.75}}
images: {ms: {format: R8G8B8A8_UNORM, samples: 4}, one: {format: R8G8B8A8_UNORM, samples: 1}, two: {format: R8_UNORM, samples: 2}}
commands:
  - resolveImage: {srcImage: ms, dstImage: one}
  - readImage: {image: ms, samples: 1}
  - readImage: {image: one}
  - copyImageToBuffer: {srcImage: one}
"""
    found = cost(text)
    assert [[line.corrected for line in each.lines] for each in found.passes] == [
        [12000, 2000],
        [3000],
        [1000],
        [1000, 4000],
    ]
    assert found.corrected is not None
    assert found.corrected.read_mb_per_s == pytest.approx(17000 * 60 / 1e6)
    with_unknown = cost(text + "  - readImage: {image: two}\n")
    assert with_unknown.corrected is None
    assert with_unknown.passes[0].corrected is not None
    assert with_unknown.passes[-1].corrected is None


def test_without_measurements_there_is_no_correction() -> None:
    found = cost(COMMANDS.replace("COMMAND", "readImage: {image: one}"), "mali-g610")
    assert found.corrected is None
    assert found.passes[0].corrected is None
    assert found.device == "Mali-G610"


MEMORY = (
    "frame: {width: 1920, height: 1080, fps: 60}\nimages: {i: {format: D32_SFLOAT_S8_UINT, "
    "samples: 4MEMBERS}}\n"
)
FULL = PIXELS * 20


@pytest.mark.parametrize(
    ("members", "device", "committed"),
    [
        ("", None, FULL),
        (
            ", usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [LAZILY_ALLOCATED]",
            None,
            0,
        ),
        (
            ", usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL]",
            "mali-g76",
            FULL,
        ),
        (", usage: [DEPTH_STENCIL_ATTACHMENT], memory: [LAZILY_ALLOCATED]", "mali-g76", FULL),
        (", usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT]", None, FULL),
        (", usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT]", "nvidia", FULL),
        (", usage: [DEPTH_STENCIL_ATTACHMENT, TRANSIENT_ATTACHMENT]", "mali-g76", 0),
    ],
)
def test_memory(members: str, device: str | None, committed: int) -> None:
    found = cost(MEMORY.replace("MEMBERS", members), device)
    (image,) = found.images
    assert (image.bytes, image.committed, image.committed_by_use) == (FULL, committed, False)
    assert found.total.memory_mib == committed / 2**20
    assert any("lazily" in text for text in found.assumed) == (
        device == "mali-g76" and "memory" not in members
    )


def test_memory_of_mip_levels_layers_and_slices() -> None:
    text = (
        "images: {i: {format: R8_UNORM, samples: 1, extent: {width: 8, height: 4, depth: 2}, "
        "mipLevels: 2147483647, arrayLayers: 3}}"
    )
    assert cost(text).images[0].bytes == (64 + 8 + 2 + 1) * 3


def test_a_lazily_allocated_image_that_is_stored_is_committed_by_use() -> None:
    image = (
        "  l: {format: R8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, TRANSIENT_ATTACHMENT], "
        "memory: [LAZILY_ALLOCATED]}"
    )
    found = cost(
        begun(
            "c: {image: l, loadOp: CLEAR, storeOp: STORE}", "{colorAttachments: [c]}", images=image
        )
    )
    assert found.images[1][2:] == (0, True)


def test_a_pass_has_the_memory_of_its_images_and_the_frame_each_once() -> None:
    found = example("khronos-msaa/depth-unresolved.msaa.yaml")
    mib = {image.name: (image.committed or 0) / 2**20 for image in found.images}
    assert of_pass(found, "scene").amount.memory_mib == pytest.approx(
        mib["color_ms"] + mib["depth_ms"]
    )
    assert of_pass(found, "post").amount.memory_mib == pytest.approx(
        mib["backbuffer"] + mib["color"] + mib["depth_ms"]
    )
    assert found.total.memory_mib == pytest.approx(sum(mib.values()))


def test_hostile_sizes_and_rates_stay_finite() -> None:
    text = """
frame: {width: 2147483647, height: 2147483647, fps: 1.0e+300}
device: {milliwattsPerGBps: 1.0e+300, compression: {64: 16}}
images: {i: {format: R64G64B64A64_SFLOAT, samples: 64, arrayLayers: 2147483647, mipLevels: 2147483647}}
commands: [readImage: {image: i}]
"""
    found = cost(text)
    assert found.corrected is not None
    for figure in (*found.total, *found.corrected):
        assert 0 <= figure < float("inf")
    assert found.total.read_mb_per_s > 1e30
    assert "rates above 1e+09 are taken for that" in found.assumed


def test_many_begins_of_many_attachments_take_little_time() -> None:
    attachments = ", ".join(
        f"a{n}: {{format: R8_UNORM, samples: 1, loadOp: LOAD, storeOp: STORE}}" for n in range(2000)
    )
    slots = ", ".join(f"a{n}" for n in range(2000))
    more = "  - beginRenderPass: {renderPass: p}\n  - endRenderPass\n" * 5000
    found = only(cost(begun(attachments, f"{{colorAttachments: [{slots}]}}", more=more)))
    assert found.times == 5001
    assert len(found.lines) == 4000
