"""Times and memory of the language server, with a description of 64 KB: `python
tests/benchmarks/editor.py [--edits N]`.

For each request it prints the time until the answer arrives, p50 and p95, and the processor time of
the server, which other programs change less.
"""

from __future__ import annotations

import argparse
import asyncio
import os
import statistics
import sys
import tempfile
from collections.abc import Awaitable, Callable
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

from lsprotocol import types
from pytest_lsp import LanguageClient

sys.path.insert(0, str(Path(__file__).parents[2]))

from tests.lsp.editor import Editor, editor

SIZE = 64 << 10

PASS = """\
  pass{0}:
    attachments:
      color_ms: {{image: color_ms{0}, loadOp: CLEAR, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: COLOR_ATTACHMENT_OPTIMAL}}
      color: {{image: color{0}, loadOp: DONT_CARE, storeOp: STORE, initialLayout: UNDEFINED, finalLayout: SHADER_READ_ONLY_OPTIMAL}}
    subpasses:
      - {{colorAttachments: [color_ms], resolveAttachments: [color]}}
"""
IMAGES = """\
  color_ms{0}: {{format: R8G8B8A8_UNORM, samples: 4, usage: [COLOR_ATTACHMENT], memory: [DEVICE_LOCAL]}}
  color{0}: {{format: R8G8B8A8_UNORM, samples: 1, usage: [COLOR_ATTACHMENT, SAMPLED], memory: [DEVICE_LOCAL]}}
"""


def frame(size: int) -> str:
    """A frame of passes that are alike, in about `size` characters."""
    count = size // (len(PASS.format(0)) + len(IMAGES.format(0)))
    images, passes = ("".join(map(text.format, range(count))) for text in (IMAGES, PASS))
    return (
        f"frame: {{width: 1920, height: 1080, fps: 60}}\nimages:\n{images}renderPasses:\n{passes}"
    )


def processor_seconds(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def memory(pid: int) -> str:
    lines = Path(f"/proc/{pid}/status").read_text(encoding="utf-8").splitlines()
    return ", ".join(
        line.replace("\t", " ") for line in lines if line.startswith(("VmRSS", "VmHWM"))
    )


def note_arrivals(client: LanguageClient) -> list[float]:
    """A list that gets the times at which a client reads structures of messages. It takes longer
    than an editor to read all of them.
    """
    arrivals: list[float] = []
    structure = client.protocol.structure_message

    def noted(data: dict[str, Any]) -> Any:
        arrivals.append(perf_counter())
        return structure(data)

    client.protocol.structure_message = noted
    return arrivals


async def measure(
    name: str, pid: int, arrivals: list[float], count: int, ask: Callable[[int], Awaitable[object]]
) -> None:
    """Prints the times of a request that is made several times."""
    times = []
    before = processor_seconds(pid)
    for number in range(count):
        arrivals.clear()
        start = perf_counter()
        await ask(number)
        times.append((arrivals[0] - start) * 1e3)
    processor = (processor_seconds(pid) - before) / count * 1e3
    p95 = statistics.quantiles(times, n=20)[-1] if count > 1 else times[0]
    print(
        f"{name:28} p50 {statistics.median(times):6.1f} ms   p95 {p95:6.1f} ms   processor "
        f"{processor:6.1f} ms"
    )


async def benchmark(edits: int) -> None:
    text = frame(SIZE)
    lines = text.split("\n")
    line = next(
        number
        for number, each in enumerate(lines)
        if "storeOp: STORE" in each and number > len(lines) // 2
    )
    column = lines[line].index("STORE")
    with tempfile.TemporaryDirectory() as folder:
        async with editor(Path(folder)) as opened:
            assert opened.client._server is not None
            client, pid = opened.client, opened.client._server.pid
            measured = partial(measure, pid=pid, arrivals=note_arrivals(client))
            await measured(
                "first diagnostics", count=1, ask=lambda _: opened.open("first.msaa.yaml", text)
            )
            await measured(
                "diagnostics after opening",
                count=5,
                ask=lambda number: opened.open(f"{number}.msaa.yaml", text),
            )
            await measured(
                "diagnostics after an edit",
                count=edits,
                ask=lambda number: edit(opened, line, column, number),
            )
            document, at = (
                types.TextDocumentIdentifier(opened.uri("first.msaa.yaml")),
                types.Position(line, column + 1),
            )
            complete, hover = types.CompletionParams(document, at), types.HoverParams(document, at)
            await measured(
                "completion",
                count=edits,
                ask=lambda _: client.text_document_completion_async(complete),
            )
            await measured(
                "hover", count=edits, ask=lambda _: client.text_document_hover_async(hover)
            )
            narrow = types.DocumentFormattingParams(
                document, types.FormattingOptions(tab_size=2, insert_spaces=True)
            )
            await measured(
                "formatting, no change",
                count=edits,
                ask=lambda _: client.text_document_formatting_async(narrow),
            )
            await opened.open("wide.msaa.yaml", text.replace("\n  ", "\n    "))
            wide = types.DocumentFormattingParams(
                types.TextDocumentIdentifier(opened.uri("wide.msaa.yaml")), narrow.options
            )
            await measured(
                "formatting, all lines",
                count=edits,
                ask=lambda _: client.text_document_formatting_async(wide),
            )
            print(memory(pid))


async def edit(opened: Editor, line: int, column: int, number: int) -> None:
    """Changes an operation of one pass, there and back."""
    before, after = ("STORE", "NONE") if number % 2 == 0 else ("NONE", "STORE")
    place = types.Range(types.Position(line, column), types.Position(line, column + len(before)))
    await opened.change("first.msaa.yaml", types.TextDocumentContentChangePartial(place, after))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--edits", type=int, default=40)
    asyncio.run(benchmark(parser.parse_args().edits))
