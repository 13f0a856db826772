"""The tables of docs/cost.md, computed by the model. `UPDATE=1 python -m pytest
tests/frame/cost/test_docs.py` writes them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from msaa_lint.cli.report.cost_rows import variant_title
from msaa_lint.frame.cost.amounts import Amount, FrameCost, Terms
from msaa_lint.frame.cost.model import difference
from msaa_lint.frame.cost.shading import EDGES
from msaa_lint.frame.devices.tile_models import MODELS
from msaa_lint.frame.devices.tiles import bins, tile_use
from msaa_lint.frame.vulkan.formats import Format, format_of
from msaa_lint.linter.cost_run import run_costs
from msaa_lint.linter.request import Request
from tests.frame.cost.frames import cost, example
from tests.frame.cost.published import CONFIGURATIONS, FITTED_ON, MB_PER_MIB, fitted, predictions
from tests.frame.cost.triangles import invocations_at_most
from tests.paths import ROOT

Row = Sequence[str]


def table(head: Row, rows: Iterable[Row]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def stored(samples: int, width: int, height: int) -> FrameCost:
    """A pass that stores RGBA8 of that many samples, at 60 frames a second, and nothing else."""
    image = f"{{format: R8G8B8A8_UNORM, samples: {samples}, loadOp: CLEAR, storeOp: STORE}}"
    text = (
        f"renderPasses: {{scene: {{attachments: [{image}], subpasses: [{{colorAttachments: "
        f"[0]}}]}}}}\n"
    )
    return cost(text, terms=Terms(60, width, height))


def separate(width: int, height: int) -> FrameCost:
    """The Khronos sample's separate resolve of color at 4x, at another size."""
    return example("khronos-msaa/color-separate.msaa.yaml", Terms(60, width, height))


def between(one: str, other: str) -> tuple[Amount, float, float]:
    """What one published configuration costs more than another: by the model, and as measured (read
    and write in MiB/s).
    """
    a, b = CONFIGURATIONS[one], CONFIGURATIONS[other]
    return difference(a.cost().total, b.cost().total), a.read - b.read, a.write - b.write


def share(milliwatts: float) -> str:
    """Of the budget of 2.5 W."""
    return f"{milliwatts / 25:.1f} %"


def arithmetic() -> str:
    one, four = (
        stored(1, 2168, 1080).total.write_mb_per_s,
        stored(4, 2168, 1080).total.write_mb_per_s,
    )
    color, color_read, color_write = between("C", "B")
    worst, worst_read, worst_write = between("F", "E")
    measured, most = (
        (color_read + color_write) * MB_PER_MIB,
        (worst_read + worst_write) * MB_PER_MIB,
    )
    full, wide = separate(1920, 1080).total, separate(2560, 1440).total
    plain = stored(1, 1920, 1080).total.write_mb_per_s
    a, b, d, e = (CONFIGURATIONS[name] for name in "ABDE")
    before, after = a.read + a.write, b.read + b.write
    post, resolved = d.read + d.write, e.read + e.write
    rows = [
        (
            "562 bytes/s, later MiB/s",
            "2168 * 1080 * 4 B * 1 * 60 Hz",
            f"{one:.2f} MB/s = {one / MB_PER_MIB:.2f} MiB/s",
            "the number is MB/s",
        ),
        (
            "2247",
            "2168 * 1080 * 4 B * 4 * 60 Hz",
            f"{four:.2f} MB/s = {four / MB_PER_MIB:.2f} MiB/s",
            "MB/s, truncated, not rounded",
        ),
        ("1685", "the two above", f"{four - one:.2f} MB/s", "MB/s"),
        (
            "3 %",
            "B - A, E - D (measured)",
            f"+{100 * (after / before - 1):.2f} %, +{100 * (resolved / post - 1):.2f} %",
            "3 % is with post-processing only; without it, 4.5 %",
        ),
        (
            "+5 GB/s",
            "C - B: 4x written and read again",
            f"{color.traffic_mb_per_s / 1000:.3f} GB/s; measured {measured / 1000:.3f} GB/s",
            "rounded up",
        ),
        (
            "500 mW, 20 %",
            "the line above, 100 mW per GB/s, 2.5 W",
            f"{color.milliwatts:.0f} mW, {share(color.milliwatts)}; measured {measured / 10:.0f} "
            f"mW, {share(measured / 10)}",
            "follows from the line above",
        ),
        (
            "read +2366 MiB/s",
            "F - E: 4 samples of color; sample 0 of depth instead of the resolved depth",
            f"{worst.read_mb_per_s / MB_PER_MIB:.1f} MiB/s; measured {worst_read:.1f} MiB/s",
            "attributed to color alone",
        ),
        (
            "write +3951 MiB/s = 1685 + 2247",
            "F - E: color at 4x; depth at 4x instead of 1x",
            f"{worst.write_mb_per_s:.1f} MB/s = {worst.write_mb_per_s / MB_PER_MIB:.1f} MiB/s; "
            f"measured {worst_write:.1f} MiB/s",
            "the sum is in MB/s, the counter in MiB/s",
        ),
        (
            "6.3 GB/s, 302 %, 630 mW, 25 %",
            "F - E, together",
            f"{worst.traffic_mb_per_s / 1000:.2f} GB/s; measured {worst_read + worst_write:.0f} "
            f"MiB/s = {most / 1000:.2f} GB/s, "
            f"{100 * (worst_read + worst_write) / resolved:.0f} %, {most / 10:.0f} mW, "
            f"{share(most / 10)}",
            "MiB/s called GB/s; color and depth together, not depth alone",
        ),
        (
            "3.9 GB/s against 500 MB/s",
            "1920 * 1080 * 4 B * (4 + 4) * 60 Hz against 1",
            f"{(full.traffic_mb_per_s - plain) / 1000:.3f} against {plain / 1000:.3f} GB/s",
            "without the write of the resolved picture; with it "
            f"{full.traffic_mb_per_s / 1000:.3f} GB/s",
        ),
        (
            "7.9 GB/s, 790 mW (Arm)",
            "2560 * 1440 * 4 B * (4 + 4 + 1) * 60 Hz",
            f"{wide.traffic_mb_per_s / 1000:.3f} GB/s, {wide.milliwatts:.0f} mW, "
            f"{share(wide.milliwatts)}",
            "includes the write that the line above leaves out",
        ),
    ]
    return table(("printed", "arithmetic", "model", "mistake"), rows)


def counters() -> str:
    rows = []
    found = {(each.name, each.direction): each for each in predictions()}
    for name, each in CONFIGURATIONS.items():
        cells = [f"{name}: {each.name}", "fitted" if name in FITTED_ON else "predicted"]
        for direction in ("read", "write"):
            one = found[name, direction]
            cells += [f"{one.measured:.1f}", f"{one.predicted:.1f}", f"{one.error:+.1f} %"]
        rows.append(cells)
    return table(
        ("configuration", "", "read, published", "model", "", "write, published", "model", ""), rows
    )


def constants() -> str:
    read, write = fitted("read"), fitted("write")
    return table(
        ("constant", "read", "write", "from"),
        [
            (
                "scene besides its targets",
                f"{read.base:.1f} MiB/s",
                f"{write.base:.1f} MiB/s",
                "fitted to A, B, D, E",
            ),
            (
                "1x traffic, relative to arithmetic",
                f"{read.ratio:.3f}",
                f"{write.ratio:.3f}",
                "fitted to A, B, D, E",
            ),
            (
                "4x traffic, relative to arithmetic",
                "1",
                "1",
                "not fitted: AFBC applies to single-sampled images",
            ),
        ],
    )


SIZES = {
    "1920x1080": (1920, 1080),
    "2168x1080": (2168, 1080),
    "2560x1440": (2560, 1440),
    "3840x2160": (3840, 2160),
}


def memory() -> str:
    rows = []
    for title, (width, height) in SIZES.items():
        for color, depth in (
            ("R8G8B8A8_UNORM", "D32_SFLOAT"),
            ("R16G16B16A16_SFLOAT", "D32_SFLOAT_S8_UINT"),
        ):
            cells = [title, f"{color}, {depth}"]
            for samples in (1, 2, 4, 8, 16):
                text = (
                    f"images: {{c: {{format: {color}, samples: {samples}}}, d: {{format: "
                    f"{depth}, samples: {samples}}}}}\n"
                )
                cells.append(f"{cost(text, terms=Terms(60, width, height)).total.memory_mib:.1f}")
            rows.append(cells)
    return table(("MiB", "formats", "1x", "2x", "4x", "8x", "16x"), rows)


def of(name: str) -> Format:
    found = format_of(name)
    assert found is not None
    return found


TARGETS = {
    "RGBA8": [of("R8G8B8A8_UNORM")],
    "RGBA16F": [of("R16G16B16A16_SFLOAT")],
    "RGBA8 four times": [of("R8G8B8A8_UNORM")] * 4,
    "RGBA32F": [of("R32G32B32A32_SFLOAT")],
}


def tiles() -> str:
    rows = []
    depth = of("D32_SFLOAT")
    for name, model in MODELS.items():
        if model.kind == "adreno":
            continue
        cells = [name]
        for formats in TARGETS.values():
            pixels = []
            for samples in (1, 4, 8, 16):
                use = tile_use(model, [(format, samples) for format in formats], (depth, samples))
                pixels.append(
                    "-"
                    if use is None
                    else f"{use.pixels} spills"
                    if use.spills
                    else str(use.pixels)
                )
            cells.append(" / ".join(pixels))
        rows.append(cells)
    return table(("model", *TARGETS), rows)


def adreno() -> str:
    rows = []
    depth = of("D32_SFLOAT")
    for name, (width, height) in (("adreno-quest", (1216, 1344)), ("adreno-740", (1920, 1080))):
        model = MODELS[name]
        for title, formats in TARGETS.items():
            cells = [name, f"{width}x{height}", title]
            for samples in (1, 2, 4):
                use = tile_use(model, [(format, samples) for format in formats], (depth, samples))
                assert use is not None
                cells.append(str(bins(width, height, use.bytes_per_pixel, model.color_bytes)))
            rows.append(cells)
    return table(("model", "size", "color, plus 4 B of depth", "1x", "2x", "4x"), rows)


def shading() -> str:
    rows = []
    for n, (leg, _) in enumerate(EDGES[1]):
        cells = [str(leg)]
        for samples, by_leg in EDGES.items():
            cells.append(f"{by_leg[n][1]:.2f} ({invocations_at_most(leg, samples):.2f})")
        rows.append(cells)
    return table(("legs, pixels", *(f"{samples}x" for samples in EDGES)), rows)


def phone() -> str:
    """The frame of a phone's engine, as written, after fixes, and with other counts after the same
    fixes.
    """
    (frame,) = run_costs(
        Request([(ROOT / "examples/phone/frame.msaa.yaml").as_posix()], isolated=True),
        Terms(),
        (1, 4),
    ).frames
    costs = [
        (f"{title} (4x)" if title == "as written" else f"`{title.removeprefix('with ')}`", cost)
        for title, cost in frame.states
    ]
    costs += [
        (f"{variant_title(variant)}, after the same fixes", variant.cost)
        for variant in frame.counts
        if variant.samples == 1
    ]
    rows = [
        (
            title,
            *(
                f"{figure:,.0f}"
                for figure in (
                    cost.total.traffic_mb_per_s,
                    cost.total.memory_mib,
                    cost.total.milliwatts,
                )
            ),
            share(cost.total.milliwatts),
        )
        for title, cost in costs
    ]
    return table(("the frame", "MB/s", "MiB", "mW", "of 2.5 W"), rows)


TABLES: dict[str, Callable[[], str]] = {
    "counters": counters, "constants": constants, "arithmetic": arithmetic, "memory": memory,
    "tiles": tiles, "adreno": adreno,
    "shading": shading, "phone": phone,
}  # fmt: skip
