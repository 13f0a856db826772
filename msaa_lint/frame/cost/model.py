"""The cost of a frame: traffic, memory and power of its passes, once by plain arithmetic and once
as the device compresses.
"""

from __future__ import annotations

from msaa_lint.frame.devices import DeviceProfile
from msaa_lint.frame.devices.tiles import TileUse
from msaa_lint.frame.facts.frame import Frame
from msaa_lint.frame.facts.parts import Pass
from msaa_lint.frame.facts.subpass import tile_targets
from msaa_lint.frame.facts.walk import Walk

from .amounts import Amount, FrameCost, ImageMemory, Line, PassCost, Terms
from .immediate_mode import ASSUMED, immediate_lines
from .memory import images_memory
from .power import ASSUMED_FPS, BUDGET_MILLIWATTS, MAX_RATE, MILLIWATTS_PER_GBPS, Rates, rates
from .shading import pass_shading
from .sizes import Area, Sizes
from .traffic import MOVING, Lines, command_lines, pass_lines


def frame_cost(frame: Frame, device: DeviceProfile | None, terms: Terms | None = None) -> FrameCost:
    """What a frame costs: the passes that its commands begin and the commands that move images, in
    their order.

    Without commands every pass runs once. What an input does not say is not counted, and `unknown`
    names it. It never raises: the frame may be any that a reader gives.
    """
    terms = terms if terms is not None else Terms()
    frame_rates = rates(frame.description, device, terms)
    sizes = Sizes(frame, terms)
    images, assumed = images_memory(frame, sizes, device)
    committed = {image.name: image.committed or 0 for image in images}
    costs: list[PassCost] = []
    entries, unknown = _entries(frame, device, sizes, frame_rates)
    read = written = 0
    corrected: Moved | None = (
        ((0.0, 0.0), (0.0, 0.0)) if device is not None and device.compression is not None else None
    )
    taken: dict[str, None] = {}
    for name, path, kind, each, area, lines in entries:
        lines.move_planes()
        used = dict.fromkeys(line.image for line in lines.found)
        if each is not None:
            used.update(
                dict.fromkeys(t.name for a in each.attachments if a.used for t in a.targets[:1])
            )
        memory = sum(committed.get(image, 0) for image in used)
        reads, writes = _bytes(lines.found)
        measured = _corrected(lines.found, device)
        cost = PassCost(
            name,
            path,
            kind,
            area.times,
            area.width,
            area.height,
            tuple(lines.found),
            frame_rates.amount(reads, writes, memory),
            None if measured is None else frame_rates.amount(*measured[0], memory),
            pass_shading(each, area, frame) if each is not None else None,
            _tile(each, device) if each is not None else None,
            tuple(lines.unknown),
            None if measured is None else frame_rates.amount(*measured[1], memory),
        )
        costs.append(cost)
        read, written = read + reads, written + writes
        corrected = None if corrected is None or measured is None else _sum(corrected, measured)
        unknown += [f"`{name}`: {text}" for text in lines.unknown]
        taken.update(lines.assumed)
    everything = sum(committed.values())
    unknown += [
        f"`{image.name}`: what it takes of memory" for image in images if image.bytes is None
    ]
    return FrameCost(
        tuple(costs),
        tuple(images),
        frame_rates.amount(read, written, everything),
        None if corrected is None else frame_rates.amount(*corrected[0], everything),
        frame_rates.fps,
        device.name if device is not None else None,
        (*_assumed(frame, device, terms, frame_rates), *taken, *assumed),
        tuple(dict.fromkeys(unknown)),
        frame_rates.milliwatts_per_gbps,
        terms.budget_milliwatts or (BUDGET_MILLIWATTS if device is None or device.tiler else None),
        frame.description.frame.share if frame.description.frame is not None else None,
        device.tiler if device is not None else None,
        None if corrected is None else frame_rates.amount(*corrected[1], everything),
    )


Entry = tuple[str, str, str, Pass | None, Area, Lines]

_NO_AREA = Area(1, 0, 0, None, None, True, ())
"""A command outside of passes runs once and renders nothing."""


def _entries(
    frame: Frame, device: DeviceProfile | None, sizes: Sizes, frame_rates: Rates
) -> tuple[list[Entry], list[str]]:
    """The passes and commands of a frame, with their lines, in the order in which they first come;
    and the passes that never do.
    """
    entries: dict[int, Entry] = {}
    for each in frame.passes if not frame.has_commands else ():
        entries[id(each)] = _pass_entry(each, device, sizes)
    attached: dict[int, set[str]] = {}
    for step in Walk(frame).steps:
        command, render_pass = step.command, step.run.render_pass if step.run is not None else None
        if step.begins and render_pass is not None:
            if id(render_pass) not in entries:
                entries[id(render_pass)] = _pass_entry(render_pass, device, sizes)
            if id(render_pass) not in attached:
                attached[id(render_pass)] = _attached_images(render_pass)
        elif (
            command.kind not in MOVING
            or getattr(command.body, "access", None) == "INPUT_ATTACHMENT_READ"
        ):
            # An input attachment is counted with its pass.
            continue
        elif render_pass is None:
            lines = Lines(device)
            entries[id(command)] = (command.kind, command.path, "command", None, _NO_AREA, lines)
            command_lines(lines, command, frame, sizes)
        elif getattr(command.body, "image", None) not in attached[id(render_pass)]:
            # What a pass has attached it reads on the tile.
            command_lines(entries[id(render_pass)][5], command, frame, sizes)
    never = [
        f"`{each.name}`: no command begins it"
        for each in frame.passes
        if frame.has_commands and not each.begun
    ]
    return list(entries.values()), never


def _attached_images(render_pass: Pass) -> set[str]:
    """The images of a pass's attachments."""
    return {
        target.name
        for attachment in render_pass.attachments
        for target in attachment.targets
        if target.image is not None
    }


def _pass_entry(each: Pass, device: DeviceProfile | None, sizes: Sizes) -> Entry:
    area = sizes.area(each)
    if device is not None and device.tiler is False:
        lines = immediate_lines(each, area, device)
    else:
        lines = pass_lines(each, area, device)
    lines.assumed.update(dict.fromkeys(area.assumed))
    return each.name, each.path, each.kind, each, area, lines


def _tile(each: Pass, device: DeviceProfile | None) -> TileUse | None:
    """The tile of the subpass that takes most of it; None where none is known."""
    if device is None or device.tile is None:
        return None
    from msaa_lint.frame.devices.tiles import tile_use

    uses = []
    for subpass in each.subpasses:
        targets = tile_targets(subpass)
        use = tile_use(device.tile, *targets) if targets is not None else None
        if use is not None:
            uses.append(use)
    return max(uses, key=lambda use: (use.bytes_per_pixel, -use.pixels), default=None)


def _bytes(lines: list[Line]) -> tuple[int, int]:
    return sum(line.bytes for line in lines if line.direction == "read"), sum(
        line.bytes for line in lines if line.direction == "write"
    )


Moved = tuple[tuple[float, float], tuple[float, float]]
"""Read and written bytes, at least and at most."""


def _corrected(lines: list[Line], device: DeviceProfile | None) -> Moved | None:
    """Read and written bytes as the device compresses; None where that is not known of one of the
    lines.
    """
    if device is None or device.compression is None:
        return None
    moved: Moved = ((0.0, 0.0), (0.0, 0.0))
    for line in lines:
        low, high = line.corrected, line.corrected_most
        if low is None or high is None:
            return None
        moved = _sum(
            moved,
            ((low, 0.0), (high, 0.0)) if line.direction == "read" else ((0.0, low), (0.0, high)),
        )
    return moved


def _sum(one: Moved, other: Moved) -> Moved:
    (a, b), (c, d) = one, other
    return (a[0] + c[0], a[1] + c[1]), (b[0] + d[0], b[1] + d[1])


def _assumed(
    frame: Frame, device: DeviceProfile | None, terms: Terms, frame_rates: Rates
) -> list[str]:
    """What was taken for granted of the frame as a whole."""
    found = []
    size = frame.description.frame
    if terms.fps is None and (size is None or size.fps is None):
        found.append(f"{ASSUMED_FPS:g} frames a second")
    if MAX_RATE in frame_rates:
        found.append(f"rates above {MAX_RATE:g} are taken for that")
    if device is not None and device.tiler is None:
        found.append(
            f"{device.name} may be a tile-based GPU or not: the traffic is that on a tile-based GPU"
        )
    if device is not None and device.tiler is False:
        found.append(ASSUMED.format(device.name))
        if terms.milliwatts_per_gbps is None and device.milliwatts_per_gbps is None:
            found.append(
                f"{MILLIWATTS_PER_GBPS:g} mW per GB/s is Arm's figure for a phone's memory"
            )
    return found


def difference(before: Amount, after: Amount) -> Amount:
    """What one amount is more than another; negative where it is less."""
    return Amount(*(one - other for one, other in zip(before, after, strict=True)))


__all__ = ["FrameCost", "ImageMemory", "difference", "frame_cost"]
