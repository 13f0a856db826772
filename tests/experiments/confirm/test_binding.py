"""The package `vulkan`, mended: structures read back, results by name, one messenger, devices
opened and closed.
"""

from __future__ import annotations

import gc
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("vulkan")

from msaa_lint.experiments.confirm import binding
from msaa_lint.experiments.confirm.instance import Device, Instance, Message
from msaa_lint.experiments.confirm.vulkan_errors import RESULTS, Unusable, VulkanError
from tests.paths import ROOT

try:
    vk: Any = binding.load()
except Unusable as reason:
    pytest.skip(str(reason), allow_module_level=True)


def churn() -> None:
    """Takes the memory of what was freed for something else."""
    gc.collect()
    kept = [vk.ffi.new("char[]", b"X" * (1 + n % 64)) for n in range(20_000)]
    kept += [vk.ffi.new("uint32_t[]", [0x99999999] * (1 + n % 24)) for n in range(20_000)]
    kept += [bytes([n % 256]) * 64 for n in range(20_000)]
    assert kept


def test_what_elements_of_a_list_point_to_is_kept() -> None:
    def made() -> Any:
        resolve = vk.VkAttachmentReference2(attachment=0x33, layout=2)
        below = vk.VkSubpassDescriptionDepthStencilResolve(
            depthResolveMode=1, pDepthStencilResolveAttachment=resolve
        )
        subpass = vk.VkSubpassDescription2(
            pNext=below,
            pColorAttachments=[
                vk.VkAttachmentReference2(attachment=0x11),
                vk.VkAttachmentReference2(attachment=0x12),
            ],
            pDepthStencilAttachment=vk.VkAttachmentReference2(attachment=0x22),
        )
        return vk.VkRenderPassCreateInfo2(pSubpasses=[subpass])

    every = [made() for _ in range(50)]
    churn()
    for each in every:
        subpass = each.pSubpasses[0]
        assert [subpass.pColorAttachments[n].attachment for n in range(2)] == [0x11, 0x12]
        assert subpass.pDepthStencilAttachment.attachment == 0x22
        below = vk.ffi.cast("VkSubpassDescriptionDepthStencilResolve*", subpass.pNext)
        assert (below.depthResolveMode, below.pDepthStencilResolveAttachment.attachment) == (
            1,
            0x33,
        )


def test_names_in_stages_are_kept() -> None:
    every = [
        vk.VkGraphicsPipelineCreateInfo(
            pStages=[vk.VkPipelineShaderStageCreateInfo(stage=bit, pName="main") for bit in (1, 16)]
        )
        for _ in range(50)
    ]
    churn()
    assert {binding.text(each.pStages[n].pName) for each in every for n in range(2)} == {"main"}


def test_what_a_nested_structure_points_to_is_kept() -> None:
    def made() -> Any:
        return vk.VkComputePipelineCreateInfo(
            stage=vk.VkPipelineShaderStageCreateInfo(stage=32, pName="main")
        )

    every = [made() for _ in range(50)]
    churn()
    assert {binding.text(each.stage.pName) for each in every} == {"main"}


def test_code_is_kept() -> None:
    every = [vk.VkShaderModuleCreateInfo(codeSize=64, pCode=bytes([7]) * 64) for _ in range(50)]
    churn()
    assert {each.pCode[n] for each in every for n in range(16)} == {0x07070707}


def test_a_list_that_is_emptied_later_is_kept() -> None:
    names = ["one", "two"]
    made = vk.VkInstanceCreateInfo(ppEnabledLayerNames=names)
    subpasses = [
        vk.VkSubpassDescription2(pColorAttachments=[vk.VkAttachmentReference2(attachment=5)])
        for _ in range(20)
    ]
    render_pass = vk.VkRenderPassCreateInfo2(pSubpasses=subpasses)
    names.clear()
    subpasses.clear()
    churn()
    assert [binding.text(made.ppEnabledLayerNames[n]) for n in range(made.enabledLayerCount)] == [
        "one",
        "two",
    ]
    assert {render_pass.pSubpasses[n].pColorAttachments[0].attachment for n in range(20)} == {5}


def test_chains_are_kept() -> None:
    def made() -> Any:
        return binding.chain(
            vk.VkPhysicalDeviceProperties2(),
            vk.VkPhysicalDeviceVulkan11Properties(),
            vk.VkPhysicalDeviceVulkan12Properties(),
        )

    every = [made() for _ in range(20)]
    churn()
    for each in every:
        second = vk.ffi.cast("VkPhysicalDeviceVulkan11Properties*", each.pNext)
        third = vk.ffi.cast("VkPhysicalDeviceVulkan12Properties*", second.pNext)
        assert (second.sType, third.sType) == (50, 52)
        assert third.pNext == vk.ffi.NULL


def test_nothing_is_kept_for_ever() -> None:
    kept = vk._vulkan._weakkey_dict
    gc.collect()
    before = len(kept)
    for _ in range(2000):
        vk.VkRenderPassCreateInfo2(
            pSubpasses=[
                vk.VkSubpassDescription2(
                    pColorAttachments=[vk.VkAttachmentReference2(attachment=1)]
                )
            ]
        )
    gc.collect()
    assert len(kept) <= before + 10


def test_any_sequence_is_an_array() -> None:
    made = vk.VkSubpassDescription(pColorAttachments=None, colorAttachmentCount=0)
    assert made.pColorAttachments == vk.ffi.NULL
    info = vk.VkDeviceQueueCreateInfo(queueCount=2, pQueuePriorities=(each for each in (0.5, 1.0)))
    assert [info.pQueuePriorities[n] for n in range(2)] == [0.5, 1.0]
    with pytest.raises(TypeError):
        vk.VkSubpassDescription2(pColourAttachments=[])


def test_results_have_vulkans_names() -> None:
    with pytest.raises(VulkanError) as error:
        vk.vkCreateInstance(vk.VkInstanceCreateInfo(ppEnabledExtensionNames=["VK_OWN_none"]), None)
    assert (error.value.name, error.value.result, error.value.call) == (
        "VK_ERROR_EXTENSION_NOT_PRESENT",
        -7,
        "vkCreateInstance",
    )
    assert str(error.value) == "vkCreateInstance: VK_ERROR_EXTENSION_NOT_PRESENT"
    assert VulkanError(-1000069000, "vkX").name == "VK_ERROR_OUT_OF_POOL_MEMORY"
    assert VulkanError(-12345, "vkX").name == "VkResult -12345"
    for result in (-1000069000, -1000161000, 1000297000, 424242):
        with pytest.raises(VulkanError):
            raise vk._vulkan.exception_codes[result]


def test_constants() -> None:
    assert (vk.VK_API_VERSION_1_1, vk.VK_API_VERSION_1_3) == (0x401000, 0x403000)
    assert vk.VK_MAKE_API_VERSION(0, 1, 2, 3) == 0x402003
    assert (vk.VK_ERROR_OUT_OF_POOL_MEMORY, vk.VK_ERROR_VALIDATION_FAILED) == (
        -1000069000,
        -1000011001,
    )
    assert binding.version_of(0x402003) == (1, 2, 3)


def test_results_are_the_registrys() -> None:
    vulkan_object = pytest.importorskip("vulkan_object")
    registry = vulkan_object.get_vulkan_object().enums["VkResult"]
    assert {field.value: field.name for field in registry.fields} == RESULTS


def devices(instance: Instance) -> list[Any]:
    try:
        return instance.physical_devices()
    except Unusable as reason:
        pytest.skip(str(reason))


@pytest.fixture
def instance() -> Any:
    try:
        with Instance() as made:
            yield made
    except Unusable as reason:
        pytest.skip(str(reason))


def test_a_device_is_opened_and_closed(instance: Instance) -> None:
    physical = devices(instance)[0]
    assert binding.physical_name(physical)
    for _ in range(3):
        with Device(physical) as device:
            assert device.family >= 0
            made = device.procedure("vkCreateRenderPass2")(device.handle, _render_pass(), None)
            vk.vkDestroyRenderPass(device.handle, made, None)
            with pytest.raises(VulkanError, match="vkOwn"):
                device.procedure("vkOwn")
    assert device.handle is None


def _render_pass() -> Any:
    attachment = vk.VkAttachmentDescription2(
        format=37, samples=1, loadOp=1, storeOp=0, stencilLoadOp=2, stencilStoreOp=1, finalLayout=2
    )
    subpass = vk.VkSubpassDescription2(
        pColorAttachments=[vk.VkAttachmentReference2(attachment=0, layout=2, aspectMask=1)]
    )
    return vk.VkRenderPassCreateInfo2(pAttachments=[attachment], pSubpasses=[subpass])


def test_a_layer_that_is_missing() -> None:
    with (
        pytest.raises(Unusable, match="VK_LAYER_OWN_none is not installed"),
        Instance(["VK_LAYER_OWN_none"]),
    ):
        pass


def test_messages_and_their_guard() -> None:
    name = "VK_LAYER_KHRONOS_validation"
    if name not in binding.layers():
        pytest.skip("the validation layer is not installed")
    said: list[Message] = []
    with Instance([name], on_message=said.append) as made:
        with (
            pytest.raises(RuntimeError, match="already a debug messenger"),
            Instance(on_message=said.append),
        ):
            pass
        physical = devices(made)[0]
        with Device(physical) as device:
            bad = vk.VkImageCreateInfo(
                imageType=1,
                format=37,
                extent=vk.VkExtent3D(width=8, height=8, depth=1),
                mipLevels=1,
                arrayLayers=1,
                samples=64,
                usage=16,
            )
            try:
                vk.vkDestroyImage(device.handle, vk.vkCreateImage(device.handle, bad, None), None)
            except VulkanError as error:
                assert error.name == "VK_ERROR_VALIDATION_FAILED"
    assert any("samples" in each.id and each.severity == "error" for each in said), said
    with Instance(on_message=said.append) as again:
        assert again.sink_error is None


def test_a_sink_that_raises_is_told_of() -> None:
    name = "VK_LAYER_KHRONOS_validation"
    if name not in binding.layers():
        pytest.skip("the validation layer is not installed")

    def fails(message: Message) -> None:
        raise KeyError(message.id)

    with Instance(
        [name], on_message=fails, severities=("error", "warning", "info", "verbose")
    ) as made:
        pass
    assert isinstance(made.sink_error, KeyError)


@pytest.mark.parametrize("name", ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"])
def test_no_driver(name: str, tmp_path: Path) -> None:
    code = (
        "from msaa_lint.experiments.confirm.instance import Instance\n"
        "from msaa_lint.experiments.confirm.vulkan_errors import Unusable\n"
        "try:\n    with Instance() as i: i.physical_devices()\n"
        "except Unusable as e: print(e)\n"
    )
    environment = {
        "PATH": "/usr/bin:/bin",
        "PYTHONPATH": str(ROOT),
        name: str(tmp_path / "none.json"),
    }
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert "the Vulkan loader finds no driver" in done.stdout
    assert "mesa-vulkan-drivers" in done.stdout
    assert f"{name} is set" in done.stdout
