"""GLSL's types, built-in variables, and built-in functions that sample values can pass through."""

from __future__ import annotations

import re
from typing import Any

Type = tuple[Any, ...]
"""(name,) for a scalar; ("vec", scalar, n); ("mat", columns, rows); ("array", element, n or 0);
("struct", name, ((member, type), ...)); ("opaque", name) for samplers and images.
"""

VOID, BOOL, INT, UINT, FLOAT, DOUBLE = (
    ("void",),
    ("bool",),
    ("int",),
    ("uint",),
    ("float",),
    ("double",),
)
SCALARS = {
    "void": VOID,
    "bool": BOOL,
    "int": INT,
    "uint": UINT,
    "float": FLOAT,
    "double": DOUBLE,
    "float16_t": FLOAT,
    "uint32_t": UINT,
}


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


_VECTOR = re.compile(r"([biud]?)vec([234])")
_MATRIX = re.compile(r"d?mat([234])(?:x([234]))?")
_OPAQUE = re.compile(
    r"[iu]?(?:sampler|image|texture)(?:1D|2D|3D|Cube|2DRect|1DArray|2DArray|CubeArray|Buffer|2DMS|2DMSArray)(?:Shadow)?"
    r"|[iu]?subpassInput(?:MS)?|sampler(?:Shadow)?"
)
_MULTISAMPLED = re.compile(r"([iu]?)(?:sampler2DMS|image2DMS|texture2DMS|subpassInputMS)(Array)?")
_PREFIXES = {"": FLOAT, "b": BOOL, "i": INT, "u": UINT, "d": DOUBLE}


def vector(scalar: Type, count: int) -> Type:
    """Returns a vector type, or the scalar itself for one component."""
    return ("vec", scalar, count) if count > 1 else scalar


def named(name: str) -> Type | None:
    """Returns the built-in type of a name, or None."""
    if name in SCALARS:
        return SCALARS[name]
    match = _VECTOR.fullmatch(name)
    if match is not None:
        return ("vec", _PREFIXES[match[1]], int(match[2]))
    match = _MATRIX.fullmatch(name)
    if match is not None:
        return ("mat", int(match[1]), int(match[2] or match[1]))
    return ("opaque", name) if _OPAQUE.fullmatch(name) else None


def texel(kind: Type) -> Type:
    """Returns the type of the texels of a sampler or image."""
    name = str(kind[1]) if kind[0] == "opaque" else ""
    return (
        "vec",
        _PREFIXES.get(name[:1] if name[:1] in "iu" and not name.startswith("image") else "", FLOAT),
        4,
    )


def multisampled(kind: Type) -> bool:
    """Returns whether a type is a multisampled sampler or image."""
    return kind[0] == "opaque" and _MULTISAMPLED.fullmatch(str(kind[1])) is not None


def is_image(kind: Type) -> bool:
    """Returns whether a type is a sampler or image, or an array of them."""
    inner: Type = kind[1] if kind[0] == "array" else kind
    return bool(inner[0] == "opaque")


def scalar_of(kind: Type) -> Type:
    """Returns the component type of a scalar, vector, or matrix."""
    inner: Type = kind[1] if kind[0] == "vec" else FLOAT if kind[0] == "mat" else kind
    return inner


def size_of(kind: Type) -> int:
    """Returns the number of components of a scalar or vector; 0 for other types."""
    if kind[0] == "vec":
        return int(kind[2])
    return 1 if len(kind) == 1 and kind != VOID else 0


INPUTS: dict[str, tuple[Type, int]] = {
    "gl_FragCoord": (("vec", FLOAT, 4), 15), "gl_PointCoord": (("vec", FLOAT, 2), 16),
    "gl_FrontFacing": (BOOL, 17),
    "gl_SampleID": (INT, 18), "gl_SamplePosition": (("vec", FLOAT, 2), 19),
    "gl_SampleMaskIn": (("array", INT, 1), 20),
    "gl_PrimitiveID": (INT, 7), "gl_Layer": (INT, 9), "gl_ViewportIndex": (INT, 10),
    "gl_HelperInvocation": (BOOL, 23),
    "gl_ViewIndex": (INT, 4440), "gl_NumWorkGroups": (("vec", UINT, 3), 24),
    "gl_WorkGroupSize": (("vec", UINT, 3), 25),
    "gl_WorkGroupID": (("vec", UINT, 3), 26), "gl_LocalInvocationID": (("vec", UINT, 3), 27),
    "gl_GlobalInvocationID": (("vec", UINT, 3), 28), "gl_LocalInvocationIndex": (UINT, 29),
}  # fmt: skip
"""Built-in inputs of fragment and compute shaders, with their SPIR-V numbers."""

OUTPUTS: dict[str, tuple[Type, int]] = {
    "gl_FragDepth": (FLOAT, 22),
    "gl_SampleMask": (("array", INT, 1), 20),
}

EXTREMES = {
    "min": {"float": 37, "uint": 38, "int": 39},
    "max": {"float": 40, "uint": 41, "int": 42},
}
FUSED = 50
"""The number of Fma in GLSL.std.450."""

_SAME = _words(
    """abs sign floor ceil fract sqrt inversesqrt exp log exp2 log2 pow sin cos tan asin acos atan
    sinh cosh tanh asinh acosh atanh degrees
    radians normalize clamp mix mod round roundEven trunc reflect refract faceforward dFdx dFdy
    fwidth dFdxFine dFdyFine dFdxCoarse
    dFdyCoarse fwidthFine fwidthCoarse cross inverse transpose interpolateAtCentroid
    interpolateAtSample interpolateAtOffset
    bitfieldExtract bitfieldInsert bitfieldReverse not matrixCompMult subgroupAdd subgroupMin
    subgroupMax subgroupBroadcastFirst
    subgroupShuffle"""
)
_FLOATS = _words("length distance dot determinant")
_COMPONENTS: dict[str, Type] = {
    **dict.fromkeys(
        _words("lessThan lessThanEqual greaterThan greaterThanEqual equal notEqual isnan isinf"),
        BOOL,
    ),
    **dict.fromkeys(_words("bitCount findLSB findMSB floatBitsToInt"), INT),
    **{"floatBitsToUint": UINT, "intBitsToFloat": FLOAT, "uintBitsToFloat": FLOAT},
}
"""The component types of results that have as many components as the first argument."""

_TEXELS = _words(
    """texture textureLod textureOffset textureProj textureProjLod textureGrad textureLodOffset
    textureGather textureGatherOffset
    textureProjOffset textureProjGrad texelFetchOffset texture2D textureCube"""
)
_FIXED: dict[str, Type] = {
    "any": BOOL, "all": BOOL, "packUnorm4x8": UINT, "packSnorm4x8": UINT, "packHalf2x16": UINT,
    "packUnorm2x16": UINT,
    "packSnorm2x16": UINT, "unpackUnorm4x8": ("vec", FLOAT, 4), "unpackSnorm4x8": ("vec", FLOAT,
    4), "unpackHalf2x16": ("vec", FLOAT, 2),
    "unpackUnorm2x16": ("vec", FLOAT, 2), "unpackSnorm2x16": ("vec", FLOAT, 2),
    "textureQueryLevels": INT,
    "textureQueryLod": ("vec", FLOAT, 2),
}  # fmt: skip
_NOTHING = _words(
    """barrier memoryBarrier memoryBarrierShared memoryBarrierImage memoryBarrierBuffer
    groupMemoryBarrier imageStore
    beginInvocationInterlockARB endInvocationInterlockARB beginInvocationInterlockNV
    endInvocationInterlockNV demote"""
)
LAST = ("smoothstep", "step")
"""Functions whose result has the type of the last argument."""


def result(name: str, kinds: list[Type]) -> Type | None:
    """Returns the result type of a built-in function for argument types, or None if it is
    unknown.
    """
    if name in _NOTHING:
        return VOID
    if name in _FIXED:
        return _FIXED[name]
    if not kinds:
        return None
    first = kinds[0]
    if name in _SAME:
        wide = max(kinds, key=size_of) if name in ("clamp", "mix", "mod", "pow") else first
        return (
            vector(FLOAT, size_of(wide))
            if size_of(wide) and name not in _WHOLE and scalar_of(wide) != BOOL
            else wide
        )
    if name in LAST:
        return kinds[-1] if scalar_of(kinds[-1]) == FLOAT else vector(FLOAT, size_of(kinds[-1]))
    if name in _FLOATS:
        return FLOAT
    if name in _COMPONENTS:
        return vector(_COMPONENTS[name], size_of(first))
    if name in ("textureSize", "imageSize"):
        return (
            "vec",
            INT,
            3
            if "3D" in str(first[-1]) or "Array" in str(first[-1])
            else 1
            if "Buffer" in str(first[-1])
            else 2,
        )
    if name in _TEXELS or name in ("texelFetch", "imageLoad", "subpassLoad"):
        return FLOAT if "Shadow" in str(first[-1]) and "Gather" not in name else texel(first)
    if name.startswith(("imageAtomic", "atomic")):
        return kinds[-1]
    return None


_WHOLE = _words(
    "abs sign clamp bitfieldExtract bitfieldInsert bitfieldReverse subgroupAdd subgroupMin "
    "subgroupMax mix"
)
"""Functions that also accept integers."""
