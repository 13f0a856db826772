"""The dynamic states that plans keep; the others are left out."""

from __future__ import annotations

VIEWPORT, SCISSOR = 0, 1
SAMPLES_DYNAMIC, MASK_DYNAMIC, COVERAGE_DYNAMIC = 1000455005, 1000455006, 1000455007
KEPT_DYNAMIC = (SAMPLES_DYNAMIC, MASK_DYNAMIC, COVERAGE_DYNAMIC)
"""VkDynamicState: of multisampling's own, RASTERIZATION_SAMPLES_EXT, SAMPLE_MASK_EXT and ALPHA_TO_COVERAGE_ENABLE_EXT are driven."""
