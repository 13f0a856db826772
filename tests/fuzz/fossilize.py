"""Fuzzes the reader of Fossilize databases: calls, marks and one Broken at the end are all that may
come of any bytes.

    pip install atheris
    python tests/fuzz/fossilize.py -max_total_time=300 -rss_limit_mb=1024 -timeout=10 [CORPUS]

An input of the fuzzer is a database; every other one is made whole first, since no fuzzer guesses
checksums: its entries get the names, lengths and sums that they need to be looked into.
"""

from __future__ import annotations

import io
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import atheris  # type: ignore[import-not-found,import-untyped,unused-ignore]

with atheris.instrument_imports():
    from msaa_lint.input.captures.call import Call, CaptureError
    from msaa_lint.input.readers import fossilize, fossilize_code, fossilize_objects  # noqa: F401

from tests.input.readers.dialects_binary import MAGIC, entry, packed

EVERYTHING = frozenset(
    f"vkCreate{kind}"
    for kind in ("Instance", "ShaderModule", "RenderPass", "RenderPass2", "GraphicsPipelines")
)
HEADS = (
    b'{"applicationInfo":{',
    b'{"shaderModules":{"01":{"varintOffset":0,"varintSize":2,"codeSize":4',
    b'{"renderPasses":{"0a":{"attachments":[{"samples":4}],"subpasses":[{"colorAttachments":[],"pNext":[{"sType":1000199001}]',
    b'{"renderPasses2":{"0b":{',
    b'{"graphicsPipelines":{"0c":{"stages":[{"stage":16,"module":"01","specializationInfo":{"mapEntries":[],"data":"',
)


def whole(data: bytes) -> bytes:
    """A database of entries that hold the parts of the data."""
    provider = atheris.FuzzedDataProvider(data)
    out = [MAGIC]
    while provider.remaining_bytes():
        kind = provider.PickValueInList([0, 4, 4, 5, 6, 6, 9])
        deflated, checked, headed = (
            provider.ConsumeBool(),
            provider.ConsumeBool(),
            provider.ConsumeBool(),
        )
        payload = provider.ConsumeBytes(provider.ConsumeIntInRange(0, 400))
        if headed:
            payload = provider.PickValueInList(list(HEADS)) + payload
        out.append(entry(kind, provider.ConsumeIntInRange(0, 3), payload, deflated, checked))
    return b"".join(out)


def read(data: bytes) -> None:
    """Reads a database to its end."""
    seen = set()
    try:
        for each in fossilize.calls(io.BytesIO(data), EVERYTHING, None):
            if isinstance(each, Call):
                assert each.name in EVERYTHING
                seen.add(each.at.call)
    except CaptureError as error:
        assert error.message
        assert error.place.call is None or error.place.call >= 0


def one(data: bytes) -> None:
    """One input."""
    if data[:1] == b"\x81":
        read(data)
        return
    read(whole(data))
    # What is packed unpacks to itself, and nothing unpacks to another size.
    code = data[: len(data) & ~3]
    assert fossilize_code.unpack_code(packed(code), len(code)) == code
    unpacked = fossilize_code.unpack_code(data, 4 * (len(data) // 2))
    assert unpacked is None or len(unpacked) == 4 * (len(data) // 2)


if __name__ == "__main__":
    atheris.Setup(sys.argv, one)
    atheris.Fuzz()
