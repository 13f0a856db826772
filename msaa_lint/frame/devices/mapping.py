"""A device as the `device` of a description: YAML that can be pasted there and lints the same."""

from __future__ import annotations

import re
from collections.abc import Iterable

from . import DeviceProfile, builtin
from .msaa_features import EXTENSIONS, FEATURES
from .offer import Offer, tile_model
from .paths import is_path

WIDTH = 120


def description(offer: Offer) -> str:
    """The `device` of a description, as YAML.

    It has only the features and extensions that concern multisampling. A class of devices is named instead, as a mapping would say that
    what it does not list is unsupported.
    """
    profile = offer.profile
    head = f"# {_printable(profile.name)}: {_printable(profile.source)}\n"
    if profile.minimum:
        named = offer.key is not None and (builtin(offer.key) is not None or is_path(offer.key))
        return head + (f"device: {_text(offer.key or '')}\n" if named else "# Name a class of devices by the path of its report.\n")
    members = [(key, value) for key, value in _members(profile) if value]
    return head + "device:\n" + "".join(_line(key, value) for key, value in members)


def _members(profile: DeviceProfile) -> list[tuple[str, str]]:
    samples = profile.color_samples, profile.depth_samples, profile.stencil_samples, profile.integer_samples
    counts = zip(("color", "depth", "stencil", "integer"), samples, strict=True)
    stated = ", ".join(f"{aspect}: {_flow(map(str, found))}" for aspect, found in counts if found is not None)
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
    """A member; a long list takes several lines."""
    if len(value) + len(key) + 4 <= WIDTH or not value.startswith("["):
        return f"  {key}: {value}\n"
    lines, line = [], "   "
    for item in re.findall(r"\[[^]]*\]|[^, ][^,]*", value[1:-1]):
        if len(line) + len(item) + 2 > WIDTH:
            lines.append(line)
            line = "   "
        line += f" {item},"
    return f"  {key}: [\n" + "\n".join([*lines, line[:-1]]) + "\n  ]\n"


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
    numbers = f"colorBytes: {model.color_bytes}, depthBytes: {model.depth_bytes}, maxPixels: {model.max_pixels}"
    return f"{{kind: mali, {numbers}, limitBytes: {model.limit_bytes}}}"


def _compression(compression: dict[int, tuple[float, float]] | None) -> str:
    if not compression:
        return ""
    pairs = (f"{count} read: {read:g}, {count} write: {write:g}" for count, (read, write) in compression.items())
    return f"{{{', '.join(pairs)}}}"


def _text(text: str) -> str:
    """A scalar in double quotes, with unprintable characters escaped."""
    return '"' + _printable(text.replace("\\", "\\\\").replace('"', '\\"')) + '"'


def _printable(text: str) -> str:
    return "".join(letter if letter.isprintable() else _escape(ord(letter)) for letter in text)


def _escape(point: int) -> str:
    if 0xD800 <= point <= 0xDFFF:
        return "\\uFFFD"
    return f"\\u{point:04X}" if point < 0x10000 else f"\\U{point:08X}"
