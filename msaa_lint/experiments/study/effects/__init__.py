"""Effects: independent stages of a draw, each of which a scene turns on or leaves off. What is off is neither called nor allocated."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from . import alpha_test, alpha_to_coverage, blending, depth_resolve, depth_test, hdr, sample_mask, srgb, stencil, tone_mapping

SAMPLE_SHADING = "sample-shading"


class Effect(NamedTuple):
    """A stage, and where it comes in:

    - `fragment` changes a batch of fragments after they are shaded, before anything is written;
    - `write` gives what is written, of a colour and of what is there;
    - `stored` gives what is read back of what is written, of samples and of resolved pixels.

    Resolving ones (`depth-resolve`, `tone-mapping`, `srgb`) are called by their own names, and sample shading decides how much is shaded.
    """

    name: str
    says: str
    fragment: Callable[..., None] | None = None
    write: Callable[..., Any] | None = None
    stored: Callable[..., Any] | None = None


TABLE: tuple[Effect, ...] = (
    Effect("sample-mask", "samples that pSampleMask leaves out are not drawn", fragment=sample_mask.fragment),
    Effect(SAMPLE_SHADING, "the shader runs for groups of samples instead of once for a pixel"),
    Effect("alpha-test", "the shader discards where alpha is below a threshold", fragment=alpha_test.fragment),
    Effect("alpha-to-coverage", "alpha covers as many samples as its share", fragment=alpha_to_coverage.fragment),
    Effect("stencil", "samples are drawn where stencil is marked", fragment=stencil.fragment),
    Effect("depth-test", "of each sample the nearest surface stays", fragment=depth_test.fragment),
    Effect("blending", "colours are mixed with what is there, sample by sample", write=blending.blended),
    Effect("hdr", "samples are kept in half precision", stored=hdr.stored),
    Effect("srgb", "samples are kept as 8-bit sRGB codes", stored=srgb.stored),
    Effect("depth-resolve", "samples' depths become the pixel's"),
    Effect("tone-mapping", "light is mapped to what a display shows"),
)
"""All effects, in the order in which they come in (specification: Fragment Operations)."""

BY_NAME: dict[str, Effect] = {each.name: each for each in TABLE}

MODULES = (alpha_test, alpha_to_coverage, blending, depth_resolve, depth_test, hdr, sample_mask, srgb, stencil, tone_mapping)


def ordered(names: tuple[str, ...]) -> tuple[Effect, ...]:
    """Effects by their names, in the order of the table. LookupError for a name that is none."""
    unknown = [name for name in names if name not in BY_NAME]
    if unknown:
        raise LookupError(f"no effect is called {unknown[0]}; effects are {', '.join(BY_NAME)}")
    return tuple(each for each in TABLE if each.name in names)
