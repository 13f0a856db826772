"""The only module that imports the package `vulkan`, with fixes: structures keep alive what they
point to, and failed calls raise one exception.

`load()` returns the package. It works as documented, except that

- a structure keeps alive everything that it was created from. The package (1.3.275.1) frees what
  the elements of a list point to, what a structure nested by value points to, and the bytes of
  `pCode`, so that a driver would read freed memory.
- every result except VK_SUCCESS raises `VulkanError` with Vulkan's name, including results that the
  package does not know.
- any sequence is accepted as an array: an empty one, a generator, a NumPy array.
- missing constants are added, and those of errors have Vulkan's values.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from types import ModuleType
from typing import Any

from .vulkan_errors import RESULTS, Unusable, VulkanError, missing_package

LOADER = (
    "there is no Vulkan loader (libvulkan.so.1, vulkan-1.dll): install a Vulkan driver; on "
    "Debian run `apt install libvulkan1`"
)

_loaded: ModuleType | None = None


def load() -> Any:
    """The package `vulkan` with the fixes applied. Unusable if it or the Vulkan loader is not
    installed.
    """
    global _loaded
    if _loaded is None:
        try:
            import vulkan
            from vulkan import _vulkan
        except ImportError as error:
            missing = error.name in ("vulkan", "cffi", "_cffi_backend")
            raise Unusable(
                missing_package() if missing else f"`vulkan` cannot be loaded: {error}"
            ) from None
        except OSError:
            raise Unusable(LOADER) from None
        _keep_alive(_vulkan)
        _vulkan.exception_codes = _Results()
        for name, value in _constants().items():
            setattr(_vulkan, name, value)
            setattr(vulkan, name, value)
        _loaded = vulkan
    return _loaded


class _Results:
    """Replaces the package's table of exceptions, which its functions use as `raise
    exception_codes[result]`.
    """

    def __getitem__(self, result: int) -> VulkanError:
        return VulkanError(result, sys._getframe(1).f_code.co_name)


def _keep_alive(module: Any) -> None:
    cast, new, kept, cdata = module._cast_ptr2, module._new, module._weakkey_dict, module.ffi.CData

    def listed(value: Any) -> Any:
        plain = isinstance(
            value, (cdata, str, bytes, bytearray, memoryview, module.StrWrap)
        ) or not isinstance(value, Iterable)
        return value if plain else list(value)

    def _cast_ptr2(value: Any, kind: Any) -> Any:
        value = listed(value)
        pointer, owner = cast(value, kind)
        if isinstance(value, list):
            kept[owner] = (*kept.get(owner, ()), *value)
        return pointer, owner

    def _new(ctype: str, **members: Any) -> Any:
        stated = {name: listed(value) for name, value in members.items()}
        made = new(ctype, **stated)
        # Copy lists: their owner may modify them.
        kept[made] = (
            *kept.get(made, ()),
            *(tuple(v) if isinstance(v, list) else v for v in stated.values() if v is not None),
        )
        return made

    module._cast_ptr2, module._new = _cast_ptr2, _new


def _constants() -> dict[str, Any]:
    versions = {f"VK_API_VERSION_1_{minor}": packed(0, 1, minor, 0) for minor in range(5)}
    return {
        **versions,
        "VK_MAKE_API_VERSION": packed,
        "VK_HEADER_VERSION": 275,
        "VK_HEADER_VERSION_COMPLETE": packed(0, 1, 3, 275),
        **{name: result for result, name in RESULTS.items()},
    }


def packed(variant: int, major: int, minor: int, patch: int) -> int:
    """A version packed into 32 bits, as in Vulkan."""
    return variant << 29 | major << 22 | minor << 12 | patch


def has(function: str) -> bool:
    """Whether the loader exports a function; old loaders lack those of later versions."""
    try:
        return bool(getattr(load().lib, function, None))
    except AttributeError:
        return False


def text(value: Any) -> str:
    """A char array or `const char*` of a structure as text; empty for NULL."""
    ffi = load().ffi
    if isinstance(value, str):
        return value
    return "" if value == ffi.NULL else ffi.string(value).decode("utf-8", "replace")


def chain(head: Any, *following: Any) -> Any:
    """Links structures by pNext in that order and returns the first one, which keeps the others
    alive.
    """
    vk = load()
    kept = vk._vulkan._weakkey_dict
    for before, after in zip((head, *following), following, strict=False):
        before.pNext = vk.ffi.cast("void*", vk.ffi.addressof(after))
    kept[head] = (*kept.get(head, ()), *following)
    return head


def push_bytes(data: bytes) -> Any:
    """Bytes as the `const void*` that vkCmdPushConstants and vkCmdUpdateBuffer take. The caller
    must keep the result alive until the call returns.
    """
    return load().ffi.from_buffer("char[]", data)


def procedure(owner: Any, name: str, device: bool = False) -> Callable[..., Any]:
    """A function of an instance or device, core or of an enabled extension. VulkanError if there is
    none.
    """
    vk = load()
    try:
        found: Callable[..., Any] = (
            vk.vkGetDeviceProcAddr if device else vk.vkGetInstanceProcAddr
        )(owner, name)
        return found
    except vk.ExtensionNotSupportedError:
        # The package raises this for core functions, which it exports itself.
        if hasattr(vk, name) and has(name):
            found = getattr(vk, name)
            return found
    except vk.ProcedureNotFoundError:
        pass
    raise VulkanError(-7, name)


def instance_version() -> tuple[int, int, int]:
    """The Vulkan version of the loader."""
    number = (
        load().vkEnumerateInstanceVersion()
        if has("vkEnumerateInstanceVersion")
        else packed(0, 1, 0, 0)
    )
    return version_of(number)


def version_of(number: int) -> tuple[int, int, int]:
    """The major, minor and patch numbers of a packed version."""
    return number >> 22 & 0x7F, number >> 12 & 0x3FF, number & 0xFFF


def layers() -> dict[str, tuple[int, int, int]]:
    """The installed layers and the Vulkan version of each."""
    return {
        text(each.layerName): version_of(each.specVersion)
        for each in load().vkEnumerateInstanceLayerProperties()
    }


def extensions(layer: str | None = None) -> frozenset[str]:
    """The available instance extensions, or those of a layer."""
    return frozenset(
        text(each.extensionName) for each in load().vkEnumerateInstanceExtensionProperties(layer)
    )


def physical_name(physical: Any) -> str:
    """The name of a physical device."""
    return text(load().vkGetPhysicalDeviceProperties(physical).deviceName)
