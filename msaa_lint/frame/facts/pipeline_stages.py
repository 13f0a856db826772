"""Stages and accesses of synchronization scopes (Vulkan specification, Synchronization and Cache
Control: Pipeline Stages, Access Types).

A stage mask has two meanings. As a synchronization scope it includes the logically earlier stages
(source) or the logically later ones (destination); BOTTOM_OF_PIPE as a source and TOP_OF_PIPE as a
destination are all commands there. As the limit of an access scope it has only the stages that are
stated, and TOP_OF_PIPE and BOTTOM_OF_PIPE access nothing.
"""

from __future__ import annotations

from collections.abc import Collection
from functools import lru_cache

from msaa_lint.frame.vulkan.enums import ENUMS

Stages = frozenset[str]

_PSEUDO = frozenset({"NONE", "TOP_OF_PIPE", "BOTTOM_OF_PIPE", "HOST"})
_PRE_RASTERIZATION = (
    "VERTEX_SHADER", "TESSELLATION_CONTROL_SHADER", "TESSELLATION_EVALUATION_SHADER",
    "GEOMETRY_SHADER", "TASK_SHADER_EXT",
    "MESH_SHADER_EXT", "CLUSTER_CULLING_SHADER_HUAWEI",
)  # fmt: skip
_FRAGMENTS = (
    "EARLY_FRAGMENT_TESTS",
    "FRAGMENT_SHADER",
    "LATE_FRAGMENT_TESTS",
    "COLOR_ATTACHMENT_OUTPUT",
)
_GRAPHICS = (
    "DRAW_INDIRECT", "COPY_INDIRECT_KHR", "INDEX_INPUT", "VERTEX_ATTRIBUTE_INPUT",
    *_PRE_RASTERIZATION, *_FRAGMENTS,
    "CONDITIONAL_RENDERING_EXT", "TRANSFORM_FEEDBACK_EXT", "FRAGMENT_SHADING_RATE_ATTACHMENT_KHR",
    "FRAGMENT_DENSITY_PROCESS_EXT",
    "SUBPASS_SHADER_HUAWEI", "INVOCATION_MASK_HUAWEI",
)  # fmt: skip
_TRANSFERS = ("COPY", "BLIT", "RESOLVE", "CLEAR", "ACCELERATION_STRUCTURE_COPY_KHR")
_SEVERAL = {
    "VERTEX_INPUT": frozenset({"INDEX_INPUT", "VERTEX_ATTRIBUTE_INPUT"}),
    "PRE_RASTERIZATION_SHADERS": frozenset(_PRE_RASTERIZATION),
    "TRANSFER": frozenset(_TRANSFERS),
    "ALL_GRAPHICS": frozenset(_GRAPHICS),
}

ALL_STAGES: Stages = (
    frozenset(ENUMS["VkPipelineStageFlagBits2"].values())
    - _PSEUDO
    - _SEVERAL.keys()
    - {"ALL_COMMANDS"}
)
"""Every stage that runs on a queue, without those that stand for several."""

_PIPELINES = (
    (
        "DRAW_INDIRECT", "COPY_INDIRECT_KHR", "INDEX_INPUT", "VERTEX_ATTRIBUTE_INPUT",
        "VERTEX_SHADER", "TESSELLATION_CONTROL_SHADER",
        "TESSELLATION_EVALUATION_SHADER", "GEOMETRY_SHADER", "TRANSFORM_FEEDBACK_EXT",
        "FRAGMENT_SHADING_RATE_ATTACHMENT_KHR",
        *_FRAGMENTS,
    ),
    ("DRAW_INDIRECT", "TASK_SHADER_EXT", "MESH_SHADER_EXT", "FRAGMENT_SHADING_RATE_ATTACHMENT_KHR",
    *_FRAGMENTS),
    ("FRAGMENT_DENSITY_PROCESS_EXT", *_FRAGMENTS),
    ("DRAW_INDIRECT", "COPY_INDIRECT_KHR", "COMPUTE_SHADER"),
    ("DRAW_INDIRECT", "RAY_TRACING_SHADER_KHR"),
)  # fmt: skip
"""The stages of each pipeline in their logical order (vk.xml: syncpipeline)."""

_IMPLIED = {
    "SHADER_SAMPLED_READ": "SHADER_READ", "SHADER_STORAGE_READ": "SHADER_READ",
    "SHADER_STORAGE_WRITE": "SHADER_WRITE",
}  # fmt: skip
"""The accesses that another one includes."""


@lru_cache(maxsize=512)
def stated_stages(mask: tuple[str, ...]) -> Stages:
    """The stages whose accesses a mask can include."""
    if "ALL_COMMANDS" in mask:
        return ALL_STAGES
    return frozenset().union(*(_SEVERAL.get(stage, {stage}) for stage in mask)) - _PSEUDO


@lru_cache(maxsize=512)
def first_scope(mask: tuple[str, ...]) -> Stages:
    """The stages that a source mask waits for."""
    stages = stated_stages(mask)
    if "BOTTOM_OF_PIPE" in mask:
        return ALL_STAGES
    earlier = (
        pipeline[: 1 + max(map(pipeline.index, stages.intersection(pipeline)), default=-1)]
        for pipeline in _PIPELINES
    )
    return stages.union(*earlier)


@lru_cache(maxsize=512)
def second_scope(mask: tuple[str, ...]) -> Stages:
    """The stages that a destination mask holds back."""
    stages = stated_stages(mask)
    if "TOP_OF_PIPE" in mask:
        return ALL_STAGES
    later = (
        pipeline[min(map(pipeline.index, stages.intersection(pipeline)), default=len(pipeline)) :]
        for pipeline in _PIPELINES
    )
    return stages.union(*later)


def includes_access(mask: Collection[str], access: str) -> bool:
    """Whether an access mask includes an access, by its name, or as part of another."""
    return not {
        access,
        _IMPLIED.get(access),
        "MEMORY_WRITE" if access.endswith("_WRITE") else "MEMORY_READ",
    }.isdisjoint(mask)
