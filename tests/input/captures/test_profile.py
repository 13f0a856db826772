"""A capture, and its description, on another device: memory is what the program would choose there,
where that is known.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from msaa_lint.core.finding import Finding
from tests.command import run
from tests.input.captures.program import COLOR, TRANSIENT, Program, codes, lint
from tests.input.captures.test_tracking import one_pass

DEVICE_LOCAL, LAZILY_ALLOCATED = 0x1, 0x11


def capture(*types: int, chosen: int = 0, usage: int = COLOR | TRANSIENT) -> bytes:
    """A pass whose image is bound to one of the device's memory types."""
    program = Program()
    program.call(
        "vkGetPhysicalDeviceProperties",
        physicalDevice=1,
        pProperties={"deviceName": "a desktop", "vendorID": 0x1002},
    )
    memory = {
        "memoryTypeCount": len(types),
        "memoryTypes": [{"propertyFlags": flags, "heapIndex": 0} for flags in types],
    }
    program.call("vkGetPhysicalDeviceMemoryProperties", physicalDevice=1, pMemoryProperties=memory)
    image = program.image(usage=usage)
    program.call(
        "vkAllocateMemory",
        device=2,
        pAllocateInfo={"allocationSize": 4096, "memoryTypeIndex": chosen},
        pMemory=77,
    )
    program.call("vkBindImageMemory", device=2, image=image, memory=77, memoryOffset=0)
    one_pass(program, program.view(image))
    return program.text()


def findings(data: bytes, profile: str | None) -> list[Finding]:
    return lint(data, **({"profile": profile} if profile is not None else {}))


CASES = {
    # The types of the device captured on, the one chosen, the profile; whether MSAA402 fires.
    "no such memory there": ((DEVICE_LOCAL,), 0, "mali-g76", False),
    "no such memory there, and no other device": ((DEVICE_LOCAL,), 0, None, False),
    "not chosen though there was": ((DEVICE_LOCAL, LAZILY_ALLOCATED), 0, "mali-g76", True),
    "not chosen though there was, and no other device": (
        (DEVICE_LOCAL, LAZILY_ALLOCATED),
        0,
        None,
        True,
    ),
    "chosen": ((DEVICE_LOCAL, LAZILY_ALLOCATED), 1, "mali-g76", False),
}


@pytest.mark.parametrize("name", CASES)
def test_memory_is_judged_by_what_the_program_could_choose(name: str, tmp_path: Path) -> None:
    types, chosen, profile, fires = CASES[name]
    data = capture(*types, chosen=chosen)
    found = findings(data, profile)
    assert ("MSAA402" in codes(found)) is fires
    (tmp_path / "p.jsonl").write_bytes(data)
    converted = run(tmp_path, "convert", "p.jsonl").stdout
    assert "captured: true" in converted
    same = findings(converted.encode(), profile)
    assert [(each.code, each.severity, each.message) for each in same] == [
        (each.code, each.severity, each.message) for each in found
    ]


def test_an_image_without_the_usage_is_reported_for_the_other_device() -> None:
    data = capture(DEVICE_LOCAL, usage=COLOR)
    (here,) = (found for found in findings(data, None) if found.code == "MSAA401")
    (there,) = (found for found in findings(data, "mali-g76") if found.code == "MSAA401")
    assert (here.severity, there.severity) == ("note", "warning")


def test_the_memory_of_a_description_is_stated_whatever_the_profile() -> None:
    text = (
        "images:\n  color: {format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT, "
        "TRANSIENT_ATTACHMENT], memory: [DEVICE_LOCAL]}\n"
        "commands:\n  - beginRendering: {colorAttachments: [{image: color, loadOp: CLEAR, storeOp: "
        "DONT_CARE}]}\n  - endRendering\n"
    )
    assert "MSAA402" in codes(findings(text.encode(), "mali-g76"))
    stated = "device: {name: a desktop, memoryTypes: [[DEVICE_LOCAL]]}\n"
    assert "MSAA402" not in codes(findings((stated + text).encode(), "mali-g76"))
