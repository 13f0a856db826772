"""A device as the `device` of a description: what can be pasted there and lints the same."""

from __future__ import annotations

from collections.abc import Iterable

from . import DeviceProfile, builtin
from .msaa_features import EXTENSIONS, FEATURES
from .offer import Offer, tile_model
from .paths import is_path

WIDTH = 120


def description(offer: Offer) -> str:
    """The `device` of a description, as YAML.

    Of features and extensions only those that multisampling has to do with. A class of devices is named, not written out: in a mapping
    what is not listed would be not offered.
    """
    profile = offer.profile
    head = f"# {_printable(profile.name)}: {_printable(profile.source)}\n"
    if profile.minimum:
        named = offer.key is not None and (builtin(offer.key) is not None or is_path(offer.key))
        return head + (f"device: {_text(offer.key or '')}\n" if named else "# A class of devices is named by the path of its report.\n")
    members = [(key, value) for key, value in _members(profile) if value]
    return head + "device:\n" + "".join(_line(key, value) for key, value in members)


def _members(profile: DeviceProfile) -> list[tuple[str, str]]:
    counts = {
        "color": profile.color_samples,
        "depth": profile.depth_samples,
        "stencil": profile.stencil_samples,
        "integer": profile.integer_samples,
    }
    stated = ", ".join(f"{aspect}: {_flow(map(str, found))}" for aspect, found in counts.items() if found is not None)
    types = profile.memory_types
    modes = profile.depth_resolve_modes, profile.stencil_resolve_modes
    return [
        ("name", _text(profile.name)),
        ("vendor", profile.vendor or ""),
        ("tiler", _boolean(profile.tiler)),
        ("sampleCounts", f"{{{stated}}}" if stated else ""),
        ("memoryTypes", _flow(_flow(flags) for flags in types) if types is not None else ""),
        ("depthResolveModes", _flow(modes[0]) if modes[0] is not None else ""),
        ("stencilResolveModes", _flow(modes[1]) if modes[1] is not None else ""),
        ("independentResolve", _boolean(profile.independent_resolve)),
        ("independentResolveNone", _boolean(profile.independent_resolve_none)),
        ("features", _flow(name for name in profile.features if name in FEATURES) if profile.features is not None else ""),
        ("extensions", _flow(name for name in profile.extensions if name in EXTENSIONS) if profile.extensions is not None else ""),
        ("apiVersion", f'"{profile.api_version}"' if profile.api_version is not None else ""),
        ("maxEfficientSamples", str(profile.max_efficient_samples or "")),
        ("tile", _tile(profile)),
        ("compression", _compression(profile.compression)),
        ("milliwattsPerGBps", f"{profile.milliwatts_per_gbps:g}" if profile.milliwatts_per_gbps is not None else ""),
    ]


def _line(key: str, value: str) -> str:
    """A member, its list over several lines where it is long."""
    if len(value) + len(key) + 4 <= WIDTH or not value.startswith("["):
        return f"  {key}: {value}\n"
    lines, line = [], "   "
    for item in _items(value[1:-1]):
        if len(line) + len(item) + 2 > WIDTH:
            lines.append(line)
            line = "   "
        line += f" {item},"
    return f"  {key}: [\n" + "\n".join([*lines, line[:-1]]) + "\n  ]\n"


def _items(text: str) -> list[str]:
    """What stands between the commas of a flow list, lists in it whole."""
    items, depth, start = [], 0, 0
    for place, letter in enumerate(text):
        depth += (letter == "[") - (letter == "]")
        if letter == "," and not depth:
            items.append(text[start:place].strip())
            start = place + 1
    return [*items, text[start:].strip()]


def _flow(items: Iterable[str]) -> str:
    return f"[{', '.join(items)}]"


def _boolean(value: bool | None) -> str:
    return "" if value is None else str(value).lower()


def _tile(profile: DeviceProfile) -> str:
    model = profile.tile
    if model is None:
        return ""
    name = tile_model(profile)
    if name is not None:
        return f"{{model: {name}}}"
    if model.kind == "adreno":
        return f"{{kind: adreno, gmemBytes: {model.color_bytes}}}"
    numbers = f"colorBytes: {model.color_bytes}, depthBytes: {model.depth_bytes}, maxPixels: {model.most_pixels}"
    return f"{{kind: mali, {numbers}, limitBytes: {model.limit_bytes}}}"


def _compression(compression: dict[int, tuple[float, float]] | None) -> str:
    if not compression:
        return ""
    pairs = (f"{count} read: {read:g}, {count} write: {write:g}" for count, (read, write) in compression.items())
    return f"{{{', '.join(pairs)}}}"


def _text(text: str) -> str:
    """A scalar in double quotes, what is not printable as YAML's escapes."""
    return '"' + _printable(text.replace("\\", "\\\\").replace('"', '\\"')) + '"'


def _printable(text: str) -> str:
    return "".join(each if each.isprintable() else _escape(ord(each)) for each in text)


def _escape(point: int) -> str:
    if 0xD800 <= point <= 0xDFFF:
        return "\\uFFFD"
    return f"\\u{point:04X}" if point < 0x10000 else f"\\U{point:08X}"
