"""Messages of the validation layer that say nothing of a description: about how `confirm` calls Vulkan, the scene that it draws, or
matters that have nothing to do with multisampling."""

from __future__ import annotations

from typing import NamedTuple


class Noise(NamedTuple):
    """Messages that are left out of the agreement: words that their ids share, and why they say nothing of the description."""

    ids: tuple[str, ...]
    reason: str


_MEMORY = "memory is confirm's own doing: each image has an allocation of its own, as small as the image"
_SCENE = "what is drawn is confirm's own scene"
_VALUES = "the values that attachments are cleared to are confirm's own"
_CALLS = "how confirm records and submits commands is no part of the description"
_START = "how confirm opens a device is no part of the description"
_OTHER = "it has nothing to do with multisampling"

NOISE = (
    Noise(("vkAllocateMemory-small-allocation", "small-dedicated-allocation", "too-many-objects"), _MEMORY),
    Noise(("AllocateMemory-ReuseAllocations",), _MEMORY),
    Noise(("AllocateMemory-SetPriority", "BindMemory-NoPriority", "CreateDevice-PageableDeviceLocalMemory"), _MEMORY),
    Noise(("requirements-not-retrieved", "requirements-not-all-retrieved"), _MEMORY),
    Noise(("VUID_Undefined",), "it is about the layer itself: what it does not know of an extension or a driver"),
    Noise(("specialuse-extension", "deprecated-extension", "extension-mismatch", "API-version-mismatch"), _START),
    Noise(("physical-device-features-not-retrieved", "RobustBufferAccess"), _START),
    Noise(("command-buffer-reset", "one-time-submit", "simultaneous-use", "AvoidSecondaryCmdBuffers", "unusable-secondary"), _CALLS),
    Noise(("pipeline-stage-flags", "CmdBuffer-highBarrierCount", "readToReadBarrier", "ImageBarrierAccessLayout"), _CALLS),
    Noise(("ReduceNumberOfSubmissions", "HighNumberOfFences", "HighNumberOfSemaphores", "vkImage-AvoidGeneral"), _CALLS),
    Noise(("TransitionUndefinedToReadOnly", "AvoidImageToImageCopy", "ClearAttachment-ClearImage"), _CALLS),
    Noise(("multiple-pipelines-caches", "multiple-pipelines-no-cache", "TooManyPipelines", "Pipeline-SortAndBind"), _CALLS),
    Noise(("MinimizeNumDynamicStates", "CreatePipelinesLayout-KeepLayoutSmall", "CreatePipelineLayout"), _CALLS),
    Noise(("SpirvDeprecated_WorkgroupSize",), "it is about a shader of confirm's own"),
    Noise(("redundant-attachment-on-tile", "depth-pre-pass-usage", "Zcull-LessGreaterRatio"), _SCENE),
    Noise(("small-indexed-drawcalls", "SwitchTessGeometryMesh", "Shader-OutputNotConsumed"), _SCENE),
    Noise(("ClearColor-NotCompressed", "ClearAttachment-FastClearValues", "ClearValueCountHigherThanAttachmentCount"), _VALUES),
    Noise(("CreateImage-Depth32Format", "depthbias-zero", "DepthBiasNoAttachment", "AvoidPrimitiveRestart"), _OTHER),
)
"""By what they are about. Everything else that no family has is shown as the layer's alone."""
