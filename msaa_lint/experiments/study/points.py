"""What a study measures and what it gives: techniques, and a point for each of them on a scene. Nothing here needs NumPy."""

# No `from __future__ import annotations`: a NamedTuple then compiles the text of every annotation, which takes four times as long.
from typing import NamedTuple

MSAA, SAMPLE_SHADING, SSAA = "msaa", "sample-shading", "ssaa"
KINDS = (MSAA, SAMPLE_SHADING, SSAA)
COUNTS = (1, 2, 4, 8, 16)
"""The sample counts that have a standard pattern."""

FRACTIONS = (0.25, 0.5, 1.0)
GRIDS = (2, 3, 4)


class Technique(NamedTuple):
    """A way of taking samples. `samples` of a pixel's coverage; with `sample-shading` at least `fraction` of them are shaded
    (minSampleShading), with `ssaa` the picture is drawn `grid` times as wide and as high, one sample a pixel, and averaged."""

    kind: str
    samples: int
    fraction: float = 0.0
    grid: int = 1

    @property
    def name(self) -> str:
        """As reports name it: `4x`, `4x, half of them shaded`, `SSAA 2x2`."""
        if self.kind == SSAA:
            return f"SSAA {self.grid}x{self.grid}"
        if self.kind == SAMPLE_SHADING:
            shares = {0.25: "a quarter of them", 0.5: "half of them", 1.0: "each"}
            return f"{self.samples}x, {shares.get(self.fraction, f'{self.fraction:g} of them')} shaded"
        return f"{self.samples}x"

    @property
    def shaded(self) -> int:
        """Shader invocations of a pixel that is covered whole: max(ceil(minSampleShading * samples), 1), specification 29.6."""
        if self.kind == SSAA:
            return self.grid * self.grid
        return max(-int(-self.fraction * self.samples // 1), 1) if self.kind == SAMPLE_SHADING else 1


class Point(NamedTuple):
    """One technique on one scene.

    `rmse`, `max_error` and `bias` (signed, measured less exact) are of coverage in [0, 1] over the pixels that an edge crosses, or of
    linear colour in units of display white where the scene is no matter of coverage; `rmse_all` over all pixels. `psnr_db` is of linear
    colour, `psnr_display_db` of sRGB-encoded colour clipped to [0, 1], both over all pixels, infinite where nothing differs. `ssim` is
    None unless asked for. `time_ms` is the device's that `time_from` names, and None where none is known; `ratio` is that time over the
    time of one sample. `bytes_per_frame` are the cost model's. `simulated_ms` is how long the simulation took, which is nobody's GPU.
    `effects` are the stages that ran.
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
    time_ms: float | None = None
    time_from: str = ""
    ratio: float | None = None
    bytes_per_frame: float | None = None
    milliwatts: float | None = None
    memory_mib: float | None = None
    simulated_ms: float = 0.0
    best: bool = False


def techniques(kinds: tuple[str, ...] = KINDS, counts: tuple[int, ...] = COUNTS) -> list[Technique]:
    """All that a study compares: every count of `counts`, sample shading at several fractions of those above one, SSAA 2x2 to 4x4."""
    found = [Technique(MSAA, count) for count in counts] if MSAA in kinds else []
    if SAMPLE_SHADING in kinds:
        shaded = {(count, max(-int(-share * count // 1), 1)): share for count in counts if count > 1 for share in FRACTIONS}
        found += [Technique(SAMPLE_SHADING, count, share) for (count, invocations), share in shaded.items() if invocations > 1]
    if SSAA in kinds:
        found += [Technique(SSAA, grid * grid, grid=grid) for grid in GRIDS]
    return found
