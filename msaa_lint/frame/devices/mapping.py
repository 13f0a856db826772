"""A device as the `device` of a description: YAML that can be pasted there and lints the same."""

from __future__ import annotations

from msaa_lint.core.visible import is_visible

from . import DeviceProfile, builtin
from .msaa_features import EXTENSIONS, FEATURES
from .offer import Offer, tile_model
from .paths import is_path
from .tile_models import MOST

WIDTH = 120


def description(offer: Offer) -> str:
    """The `device` of a description, as YAML.

    It has only the features and extensions that concern multisampling. A class of devices is named
    instead, as a mapping would say that what it does not list is unsupported.
    """
    profile = offer.profile
    head = f"# {_printable(profile.name)}: {_printable(profile.source)}\n"
    if profile.minimum:
        named = offer.key is not None and (builtin(offer.key) is not None or is_path(offer.key))
        return head + (
            f"device: {_text(offer.key or '')}\n"
            if named
            else "# Name a class of devices by the path of its report.\n"
        )
    return (
        head
        + "device:\n"
        + "".join(
            _line(key, value) for key, value in _members(profile).items() if value is not None
        )
    )


def _members(profile: DeviceProfile) -> dict[str, object]:
    counts = {
        "color": profile.color_samples,
        "depth": profile.depth_samples,
        "stencil": profile.stencil_samples,
        "integer": profile.integer_samples,
    }
    compression = (profile.compression or {}).items()
    ratios = {
        f"{count} {way}": ratio
        for count, pair in compression
        for way, ratio in zip(("read", "write"), pair, strict=True)
    }
    ratios |= dict(zip(MOST, profile.compression_most or (), strict=False))
    features, extensions = profile.features, profile.extensions
    return {
        "name": _text(profile.name),
        "vendor": profile.vendor or None,
        "tiler": profile.tiler,
        "sampleCounts": {
            aspect: samples for aspect, samples in counts.items() if samples is not None
        }
        or None,
        "memoryTypes": profile.memory_types,
        "depthResolveModes": profile.depth_resolve_modes,
        "stencilResolveModes": profile.stencil_resolve_modes,
        "independentResolve": profile.independent_resolve,
        "independentResolveNone": profile.independent_resolve_none,
        "features": tuple(name for name in features if name in FEATURES)
        if features is not None
        else None,
        "extensions": tuple(name for name in extensions if name in EXTENSIONS)
        if extensions is not None
        else None,
        "apiVersion": f'"{profile.api_version}"' if profile.api_version is not None else None,
        "maxEfficientSamples": profile.max_efficient_samples or None,
        "tile": _tile(profile),
        "compression": ratios or None,
        "milliwattsPerGBps": profile.milliwatts_per_gbps,
    }


def _line(key: str, value: object) -> str:
    """A member; a long list takes several lines."""
    text = _flow(value)
    if len(text) + len(key) + 4 <= WIDTH or not isinstance(value, tuple):
        return f"  {key}: {text}\n"
    lines, line = [], "   "
    for item in map(_flow, value):
        if len(line) + len(item) + 2 > WIDTH:
            lines.append(line)
            line = "   "
        line += f" {item},"
    return f"  {key}: [\n" + "\n".join([*lines, line[:-1]]) + "\n  ]\n"


def _flow(value: object) -> str:
    """A value in YAML's flow style. A text is written as it is."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return f"[{', '.join(map(_flow, value))}]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_flow(item)}" for key, item in value.items()) + "}"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _tile(profile: DeviceProfile) -> dict[str, object] | None:
    model = profile.tile
    if model is None:
        return None
    name = tile_model(profile)
    if name is not None:
        return {"model": name}
    if model.kind == "adreno":
        return {"kind": "adreno", "gmemBytes": model.color_bytes}
    sizes = {
        "colorBytes": model.color_bytes,
        "depthBytes": model.depth_bytes,
        "maxPixels": model.max_pixels,
    }
    return {"kind": "mali", **sizes, "limitBytes": model.limit_bytes}


def _text(text: str) -> str:
    """A scalar in double quotes, with unprintable characters escaped."""
    return '"' + _printable(text.replace("\\", "\\\\").replace('"', '\\"')) + '"'


def _printable(text: str) -> str:
    return "".join(letter if is_visible(letter) else _escape(ord(letter)) for letter in text)


def _escape(point: int) -> str:
    if 0xD800 <= point <= 0xDFFF:
        return "\\uFFFD"
    return f"\\u{point:04X}" if point < 0x10000 else f"\\U{point:08X}"
