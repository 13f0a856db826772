"""Reads C and C++ that fills in Vulkan structures as descriptions."""

from __future__ import annotations

import re

from msaa_lint.core.text.node_builder import mapping
from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.parsing import Code, Read, tree
from msaa_lint.input.code.sample_counts.choices import choices
from msaa_lint.input.code.vulkan.creation import VulkanInterpreter
from msaa_lint.input.code.vulkan.tree_writer import DescriptionWriter

from .directives import clear_list_directives
from .modules import without_modules
from .syntax import unit

_VULKAN = re.compile(r"\b(?:Vk|vk)[A-Z]|\bvk\w*\s*::|=\s*vk\b|VULKAN_HPP")
"""What code contains that fills in Vulkan structures, unless it is a page's; compilers of shaders, too, speak of samples."""

_WAITS = re.compile(r"ipelineBarrier|Queue(?:Submit|Present)[^}]{0,1500}WaitIdle")
"""Synchronization that can replace the dependencies of a render pass between frames."""

_FRAMES = re.compile(r"cquireNextImage")
"""Where a program starts its frames."""


def trees(code: Code) -> list[Read]:
    """Returns the tree of a file or of a page's fragments: one or none. Raises `Missing` if the grammar is not installed."""
    code = code._replace(text=without_modules(code.text))
    root = tree(code).root_node
    text, sections = clear_list_directives(code.text, root)
    if sections:
        code = code._replace(text=text)
        root = tree(code).root_node
    interpreter = VulkanInterpreter(unit(code, root, sections), code.fragments, code.language in ("cpp", "objcpp"), Work(len(code.text)))
    if code.fragments or _VULKAN.search(code.text) is not None:
        interpreter.run()
    read = DescriptionWriter(interpreter, code.fragments, _WAITS.search(code.text) is not None or _FRAMES.search(code.text) is None).read()
    # Sample count masks have this in their name, whatever their source.
    chosen = choices(root, code) if "ampleCounts" in code.text else []
    unread = (interpreter.unread,) if interpreter.unread is not None else ()
    if not chosen:
        return [(read or Read(mapping([], Span(0, 0))))._replace(unread=unread)] if read is not None or unread else []
    start = Span(chosen[0][1].start, chosen[0][1].start)
    node = read.tree if read is not None else mapping([], Span(0, 0))
    items = [(key, node.keys[key].span, value) for key, value in node.value.items()]
    items.append(("sampleCountChoices", start, mapping(chosen, start)))
    return [Read(mapping(items, Span(0, 0)), read.assumed if read is not None else (), unread=unread)]
