"""The techniques that a study compares, and the points that it measures: one per technique and
scene. Nothing here needs NumPy.
"""

from typing import NamedTuple

MSAA, SAMPLE_SHADING, SSAA = "msaa", "sample-shading", "ssaa"
KINDS = (MSAA, SAMPLE_SHADING, SSAA)
COUNTS = (1, 2, 4, 8, 16)
"""The sample counts that have a standard pattern."""

FRACTIONS = (0.25, 0.5, 1.0)
GRIDS = (2, 3, 4)


class Technique(NamedTuple):
    """A way of taking samples. `samples` are coverage samples per pixel. With `sample-shading` at
    least `fraction` of them are shaded (minSampleShading); with `ssaa` the picture is rendered
    `grid` times as wide and as high with one sample per pixel, and averaged.
    """

    kind: str
    samples: int
    fraction: float = 0.0
    grid: int = 1

    @property
    def name(self) -> str:
        """The name in reports: `4x`, `4x, half of them shaded`, `SSAA 2x2`."""
        if self.kind == SSAA:
            return f"SSAA {self.grid}x{self.grid}"
        if self.kind == SAMPLE_SHADING:
            shares = {0.25: "a quarter of them", 0.5: "half of them", 1.0: "each"}
            return (
                f"{self.samples}x, {shares.get(self.fraction, f'{self.fraction:g} of them')} shaded"
            )
        return f"{self.samples}x"

    @property
    def shaded(self) -> int:
        """Shader invocations of a fully covered pixel: max(ceil(minSampleShading * samples), 1),
        specification 29.6.
        """
        if self.kind == SSAA:
            return self.grid * self.grid
        return (
            max(-int(-self.fraction * self.samples // 1), 1) if self.kind == SAMPLE_SHADING else 1
        )


class Point(NamedTuple):
    """One technique on one scene.

    `rmse`, `max_error` and `bias` (measured minus exact) are of coverage in [0, 1] over the pixels
    that an edge crosses, or of linear color in units of display white for scenes without coverage;
    `rmse_all` is over all pixels. `psnr_db` is of linear color, `psnr_display_db` of sRGB-encoded
    color clipped to [0, 1], both over all pixels and infinite where nothing differs. `ssim` is None
    unless requested. `flip` is the mean of FLIP (Andersson and others 2020) of display-encoded
    color, and `flicker` the root mean square of the change of the error from frame to frame while
    the picture moves in steps of 1/64 of a pixel, over the pixels that an edge crosses; None where
    not measured.

    `shading` names the cost of shading under which the point was timed (study/shading.py).
    `time_ms` is the median time on the device that `time_from` names, None if unknown; `low_ms` and
    `high_ms` bound it with 95 % confidence, and `rounds` are the medians of each round; `ratio` is
    that time over the time of one sample. `resolve_ms` is the part of the time that resolving takes
    (SSAA: downscaling), `fill_ms` the rest without shading, and `shading_ms` what shading adds.
    `invocations` are the device's fragment shader invocations (pipeline statistics), and
    `expected_invocations` those that the model expects. `bytes_per_frame` is the cost model's.
    `simulated_ms` is the time that the simulation took, which says nothing about a GPU, and
    `stages` the part of it that each effect took. `effects` are the stages that ran.
    """

    scene: str
    technique: Technique
    width: int
    height: int
    rmse: float
    rmse_all: float
    max_error: float
    bias: float
    psnr_db: float
    psnr_display_db: float
    edge_pixels: int
    effects: tuple[str, ...] = ()
    ssim: float | None = None
    flip: float | None = None
    flicker: float | None = None
    shading: str = ""
    time_ms: float | None = None
    low_ms: float | None = None
    high_ms: float | None = None
    rounds: tuple[float, ...] = ()
    time_from: str = ""
    ratio: float | None = None
    fill_ms: float | None = None
    shading_ms: float | None = None
    resolve_ms: float | None = None
    invocations: int | None = None
    expected_invocations: int | None = None
    bytes_per_frame: float | None = None
    milliwatts: float | None = None
    memory_mib: float | None = None
    simulated_ms: float = 0.0
    stages: tuple[tuple[str, float], ...] = ()
    best: bool = False


def techniques(kinds: tuple[str, ...] = KINDS, counts: tuple[int, ...] = COUNTS) -> list[Technique]:
    """The techniques that a study compares: MSAA at `counts`, sample shading at several fractions
    of the counts above one, and SSAA from 2x2 to 4x4, as far as `kinds` includes them.
    """
    found = [Technique(MSAA, count) for count in counts] if MSAA in kinds else []
    if SAMPLE_SHADING in kinds:
        shaded = {
            (count, max(-int(-share * count // 1), 1)): share
            for count in counts
            if count > 1
            for share in FRACTIONS
        }
        found += [
            Technique(SAMPLE_SHADING, count, share)
            for (count, invocations), share in shaded.items()
            if invocations > 1
        ]
    if SSAA in kinds:
        found += [Technique(SSAA, grid * grid, grid=grid) for grid in GRIDS]
    return found
