"""The results of the cost model. MB is 10^6 bytes, MiB 2^20 bytes; a frame is one round of the
description's commands.

Every figure is given twice: by plain arithmetic, `width * height * bytes * samples * fps`, and
corrected by the device's measured compression, which is a range: `corrected` at least,
`corrected_most` at most.
"""

from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.frame.devices.tiles import TileUse


class Amount(NamedTuple):
    """Traffic with external memory, committed memory, and the power that the traffic takes."""

    read_mb_per_s: float
    write_mb_per_s: float
    memory_mib: float
    milliwatts: float

    @property
    def traffic_mb_per_s(self) -> float:
        """Reads and writes together."""
        return self.read_mb_per_s + self.write_mb_per_s


class Line(NamedTuple):
    """One cause of traffic per frame: an aspect of an attachment, or of a command's image, that is
    read or written.

    `action` is `load`, `store`, `resolve`, `resolve command`, `copy`, `clear`, `read`, `write` (by
    a shader; on an immediate-mode GPU also what a pass draws) or `input`; `direction` is `read` or
    `write`. `bytes` are those of a frame by plain arithmetic, exact; `corrected` is the least and
    `corrected_most` the most that the device's compression leaves of them, None where none is
    known. `samples` is the number of samples moved per pixel. `place` is where the input states it.
    """

    attachment: str
    image: str
    aspect: str
    samples: int
    action: str
    direction: str
    bytes: int
    corrected: float | None
    place: Span | None
    corrected_most: float | None = None


class Shading(NamedTuple):
    """Fragment shader invocations of a pass in a frame, in millions, for one layer of triangles
    that cover all that it renders to.

    `msaa` is once a pixel, the limit of large triangles. `sample_shading` is once a sample
    (minSampleShading 1), `super_sampling` that of the smallest grid of k x k single-sampled pixels
    that has as many samples; `demanded` what the pipelines of the pass state, None where they do
    not say. `edges` holds, for triangles of 1, 2, 4, ... pixels, by what to multiply `msaa`: (leg
    in pixels, invocations for each pixel of area), see `shading.EDGES`.
    """

    pixels: int
    samples: int
    msaa: float
    sample_shading: float
    super_sampling: float
    demanded: float | None = None
    edges: tuple[tuple[int, float], ...] = ()


class PassCost(NamedTuple):
    """One pass, or one command outside of passes (`kind` is `renderPass`, `rendering` or
    `command`), as often as a frame begins it.

    `memory_mib` of its amounts is that of the images it uses, which other passes may use too.
    `unknown` describes what could not be counted, and what information is missing.
    """

    name: str
    path: str
    kind: str
    times: int
    width: int | None
    height: int | None
    lines: tuple[Line, ...]
    amount: Amount
    corrected: Amount | None
    shading: Shading | None
    tile: TileUse | None
    unknown: tuple[str, ...]
    corrected_most: Amount | None = None


class ImageMemory(NamedTuple):
    """The memory of an image: `bytes` in full, `committed` without what lazy allocation saves; None
    if a size is unknown.

    Only usage and memory decide what is committed, so that the prices of findings add up.
    `committed_by_use`: a pass loads or stores an image that is counted as not committed, so the
    driver has to commit it after all.
    """

    name: str
    bytes: int | None
    committed: int | None
    committed_by_use: bool = False


class FrameCost(NamedTuple):
    """A whole frame. `total` counts each image's memory once. `assumed` lists the assumptions (60
    fps, a size).

    `share` is the fraction of a program's frames that are like this one, by which its traffic is
    weighted; None if it is not stated. `budget_milliwatts` is None where power has no budget to be
    set against. `tiler` is the device's, by which the model is chosen: if it is None, the figures
    are those on a tile-based GPU.
    """

    passes: tuple[PassCost, ...]
    images: tuple[ImageMemory, ...]
    total: Amount
    corrected: Amount | None
    fps: float
    device: str | None
    assumed: tuple[str, ...]
    unknown: tuple[str, ...]
    milliwatts_per_gbps: float = 100.0
    budget_milliwatts: float | None = 2500.0
    share: float | None = None
    tiler: bool | None = None
    corrected_most: Amount | None = None

    @property
    def budget_share(self) -> float | None:
        """The share of the power budget that the traffic takes by plain arithmetic; 1 is all of it.
        None without a budget.
        """
        return (
            None
            if self.budget_milliwatts is None
            else self.total.milliwatts / self.budget_milliwatts
        )


class Terms(NamedTuple):
    """The terms of an estimate that a caller may set; None takes the description's, then the
    device's, then the default.

    `milliwatts_per_gbps` is the power of 10^9 bytes a second (default 100, Arm's figure for
    LPDDR4-class memory), `budget_milliwatts` what it is set against (default 2500, a phone's
    sustained budget by the same source, unless the device is not known to be tile-based).
    """

    fps: float | None = None
    width: int | None = None
    height: int | None = None
    milliwatts_per_gbps: float | None = None
    budget_milliwatts: float | None = None
