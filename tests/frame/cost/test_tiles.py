"""Tile sizes, against the tables that Mesa's drivers give."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.frame.devices.tile_models import (
    MODELS,
    Misstated,
    TileModel,
    stated_compression,
    stated_tile,
)
from msaa_lint.frame.devices.tiles import TileUse, bins, tile_use
from msaa_lint.frame.vulkan.formats import Format, format_of
from tests.frame.cost.frames import cost


def of(name: str) -> Format:
    found = format_of(name)
    assert found is not None
    return found


RGBA8, RGBA16F, RGBA32F, DEPTH = (
    of(n) for n in ("R8G8B8A8_UNORM", "R16G16B16A16_SFLOAT", "R32G32B32A32_SFLOAT", "D32_SFLOAT")
)


def pixels(model: str, colors: list[Format], samples: int) -> int:
    found = tile_use(MODELS[model], [(format, samples) for format in colors], (DEPTH, samples))
    assert found is not None
    return found.pixels


MALI = {
    "mali-t760": ("256/256/256/128/64", "256/256/128/64/32", "256/128/64/32/16"),
    "mali-g71": ("256/256/256/128/64", "256/128/128/64/32", "256/64/64/32/16"),
    "mali-g51": ("256/256/256/128/64", "256/256/256/128/64", "256/128/128/64/32"),
    "mali-g72": ("256/256/256/128/64", "256/256/256/128/64", "256/128/128/64/32"),
    "mali-g76": ("256/256/256/128/64", "256/256/256/128/64", "256/128/128/64/32"),
    "mali-g610": ("1024/512/512/256/128", "1024/512/512/256/128", "1024/256/256/128/64"),
    "mali-g720": ("4096/2048/1024/512/256", "4096/2048/1024/512/256", "2048/1024/512/256/128"),
    "mali-g725": ("4096/4096/2048/1024/512", "4096/2048/1024/512/256", "2048/1024/512/256/128"),
}
"""Pixels a tile at 1, 2, 4, 8 and 16 samples of RGBA8, RGBA16F and 16 bytes in four attachments.
From G71 to before G720, 2x is 4x.
"""


@pytest.mark.parametrize("model", MALI)
def test_mali(model: str) -> None:
    for colors, row in zip(([RGBA8], [RGBA16F], [RGBA8] * 4), MALI[model], strict=True):
        assert "/".join(str(pixels(model, colors, samples)) for samples in (1, 2, 4, 8, 16)) == row


@pytest.mark.parametrize(
    ("colors", "samples", "expected", "spills"),
    [
        ([RGBA8], 1, 1024, False), ([RGBA8], 2, 1024, False), ([RGBA8], 4, 512, False), ([RGBA8],
        8, 256, False),
        ([RGBA16F], 4, 512, False), ([RGBA16F], 8, 256, False), ([RGBA32F], 4, 256, False),
        ([RGBA32F], 8, 256, True),
        ([RGBA32F] * 2, 4, 256, True), ([RGBA32F] * 5, 1, 256, True),
    ],
)  # fmt: skip
def test_apple(colors: list[Format], samples: int, expected: int, spills: bool) -> None:
    found = tile_use(MODELS["apple-g13"], [(format, samples) for format in colors], None)
    assert found is not None
    assert (found.pixels, found.spills) == (expected, spills)


@pytest.mark.parametrize(
    ("model", "colors", "samples", "expected"),
    [
        ("v3d-7", [RGBA8], 1, 64 * 64), ("v3d-7", [RGBA8], 4, 32 * 32), ("v3d-7", [RGBA16F], 1,
        64 * 32), ("v3d-7", [RGBA16F], 4, 32 * 16),
        ("v3d-7", [of("R8G8B8A8_SRGB")], 1, 64 * 32), ("v3d-4", [RGBA8], 1, 64 * 64), ("v3d-4",
        [RGBA8], 4, 32 * 32),
        ("v3d-4", [RGBA16F, RGBA16F], 4, 16 * 16),
    ],
)  # fmt: skip
def test_v3d(model: str, colors: list[Format], samples: int, expected: int) -> None:
    assert pixels(model, colors, samples) == expected


def test_v3d_knows_only_four_samples() -> None:
    assert tile_use(MODELS["v3d-7"], [(RGBA8, 8)], None) is None


@pytest.mark.parametrize(("samples", "expected"), [(1, 1024), (2, 1024), (4, 512), (8, 256)])
def test_powervr(samples: int, expected: int) -> None:
    assert pixels("powervr", [RGBA8], samples) == expected


@pytest.mark.parametrize(("samples", "expected"), [(1, 13), (2, 25), (4, 50)])
def test_adreno_bins_of_a_quest_eye(samples: int, expected: int) -> None:
    """1216x1344, 4 bytes of colour and 4 of depth, 1 MiB."""
    use = tile_use(MODELS["adreno-quest"], [(RGBA8, samples)], (DEPTH, samples))
    assert use is not None
    assert use.bytes_per_pixel == 8 * samples
    assert bins(1216, 1344, use.bytes_per_pixel, MODELS["adreno-quest"].color_bytes) == expected


FORMATS = st.sampled_from(
    [
        RGBA8,
        RGBA16F,
        RGBA32F,
        of("R8_UNORM"),
        of("R32G32B32A32_UINT"),
        of("A2B10G10R10_UNORM_PACK32"),
    ]
)


@given(
    st.sampled_from(sorted(MODELS)),
    st.lists(FORMATS, max_size=8),
    st.sampled_from([1, 2, 4, 8]),
    st.booleans(),
)
def test_more_samples_never_enlarge_a_tile(
    model: str, colors: list[Format], samples: int, depth: bool
) -> None:
    def use(count: int) -> TileUse | None:
        return tile_use(
            MODELS[model], [(format, count) for format in colors], (DEPTH, count) if depth else None
        )

    few, many = use(samples), use(samples * 2)
    if few is not None and many is not None:
        assert many.pixels <= few.pixels <= few.full == many.full
        assert many.bytes_per_pixel >= few.bytes_per_pixel
        assert many.spills or not few.spills


def test_the_tile_of_a_pass_is_that_of_its_widest_subpass() -> None:
    text = """
device: {tile: {model: mali-g76}}
renderPasses:
  deferred:
    attachments:
      - {format: R8G8B8A8_UNORM, samples: 8}
      - {format: R8G8B8A8_UNORM, samples: 1}
      - {samples: 1}
    subpasses: [{colorAttachments: [1]}, {colorAttachments: [0]}, {colorAttachments: [2]}]
"""
    (found,) = cost(text).passes
    assert found.tile == TileUse(32, 128, 256, False)


def test_render_to_single_sampled_has_the_samples_on_the_tile() -> None:
    text = """
device: {tile: {model: mali-g76}}
renderPasses:
  forward:
    attachments: [{format: R8G8B8A8_UNORM, samples: 1}]
    subpasses: [{colorAttachments: [0], multisampledRenderToSingleSampled: {rasterizationSamples: 16}}]
"""
    assert cost(text).passes[0].tile == TileUse(64, 64, 256, False)


def test_a_device_without_a_model_has_no_tile() -> None:
    text = (
        "renderPasses: {forward: {attachments: [{format: R8G8B8A8_UNORM, samples: 4}], "
        "subpasses: [{colorAttachments: [0]}]}}"
    )
    assert cost(text, "mali-g715").passes[0].tile is None
    assert cost(text).passes[0].tile is None


@pytest.mark.parametrize("name", sorted(MODELS))
def test_every_model_says_where_it_is_from(name: str) -> None:
    assert MODELS[name].source
    assert stated_tile({"model": name}) == MODELS[name]


@pytest.mark.parametrize(
    ("mapping", "key"),
    [
        ({}, None), ({"model": "mali-g77"}, "model"), ({"model": 5}, "model"),
        ({"model": "mali-g76", "colorBytes": 4096}, "colorBytes"),
        ({"kind": "apple"}, "kind"), ({"kind": "adreno"}, None), ({"kind": "adreno", "gmem": 4096},
        "gmem"),
        ({"kind": "adreno", "gmemBytes": 1.5}, "gmemBytes"), ({"kind": "adreno", "gmemBytes": 0},
        "gmemBytes"),
        ({"kind": "adreno", "gmemBytes": 2**40}, "gmemBytes"), ({"kind": "mali",
        "colorBytes": 4096, "depthBytes": 4096}, None),
        ({"kind": "mali", "colorBytes": None, "depthBytes": 4096, "maxPixels": 256}, "colorBytes"),
    ],
)  # fmt: skip
def test_a_misstated_tile_is_told_at_its_key(
    mapping: dict[str, float | str | None], key: str | None
) -> None:
    found = stated_tile(mapping)
    assert isinstance(found, Misstated)
    assert found.key == key
    assert found.message


def test_a_stated_tile() -> None:
    found = stated_tile(
        {
            "kind": "mali",
            "colorBytes": 8192,
            "depthBytes": 4096,
            "maxPixels": 256,
            "limitBytes": 16384,
        }
    )
    assert found == TileModel("mali", 8192, 4096, 256, 16384, "the description")
    assert isinstance(stated_tile({"kind": "adreno", "gmemBytes": 2**20}), TileModel)


@pytest.mark.parametrize(
    ("mapping", "found"),
    [
        ({"1": 0.5, "4": 1}, {1: (0.5, 0.5), 4: (1.0, 1.0)}),
        ({"1 read": 0.4, "1 write": 0.6}, {1: (0.4, 0.6)}),
        ({"1": 0.5, "1 write": 0.6}, {1: (0.5, 0.6)}),
        ({"1 write": 0.6, "1": 0.5}, {1: (0.5, 0.6)}),
        ({}, {}),
    ],
)
def test_a_stated_compression(
    mapping: dict[str, float | None], found: dict[int, tuple[float, float]]
) -> None:
    assert stated_compression(mapping) == found


@pytest.mark.parametrize(
    ("mapping", "key"),
    [
        ({"3": 1}, "3"),
        ({"4 reads": 1}, "4 reads"),
        ({"4": 0}, "4"),
        ({"4": -1}, "4"),
        ({"4": 17}, "4"),
        ({"1 read": 1}, "1 read"),
        ({"4": None}, "4"),
    ],
)
def test_a_misstated_compression_is_told_at_its_key(
    mapping: dict[str, float | None], key: str
) -> None:
    found = stated_compression(mapping)
    assert isinstance(found, Misstated)
    assert found.key == key
