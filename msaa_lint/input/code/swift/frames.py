"""The commands of a frame in Swift."""

from __future__ import annotations

from msaa_lint.core.text.node import Node
from msaa_lint.core.text.node_builder import mapping, scalar, sequence

from .frame_state import Encoded, Pass
from .interpreter import Interpreter
from .textures import Textures
from .values import Constant, Field, Texture


def commands(interpreter: Interpreter, textures: Textures, passes: list[Pass], names: dict[int, str]) -> Node | None:
    """Returns the commands of a frame if one function encodes all passes and presents the drawable, and every step is known."""
    encodings = [item for item in interpreter.encoded if item.kind == "pass"]
    roots = {encoding.by for encoding in encodings}
    if len(roots) != 1 or len(encodings) != len(passes) or roots & interpreter.incomplete:
        return None
    steps = [item for item in interpreter.encoded if item.by in roots]
    if not all(item.sure for item in steps) or not any(entry.kind == "present" for entry in steps):
        return None
    if {id(encoding.what[0]) for encoding in encodings} != set(names):
        return None
    attached = {id(field.value) for render_pass in passes for fields in render_pass.attachments.values() for field in fields.values()}
    hidden = attached & interpreter.escaped or any(id(item) in attached and _read_elsewhere(item) for item in textures.all.values())
    if hidden or len(steps) != len(interpreter.encoded):
        return None
    reads: dict[int, list[Encoded]] = {}
    for step in steps:
        if step.kind == "read":
            if not isinstance(step.what[2], Pass):
                return None
            reads.setdefault(id(step.what[2]), []).append(step)
    nodes: list[Node] = []
    for step in steps:
        if step.kind == "pass":
            nodes.extend(_command(textures, item) for item in reads.get(id(step.what[0]), ()))
            nodes.append(mapping([("renderPass", step.at, scalar(names[id(step.what[0])], step.at))], step.at))
        elif step.kind != "read":
            nodes.append(_command(textures, step))
    return sequence(nodes, steps[0].at)


def _read_elsewhere(texture: Texture) -> bool:
    """Returns whether other files may read a texture, judging by its usage."""
    if not texture.open:
        return False
    return not texture.made or any(not _drawn_only(fields.get("usage")) for fields in texture.made)


def _drawn_only(usage: Field | None) -> bool:
    return usage is not None and usage.value in (Constant("renderTarget"), Constant(("renderTarget",)))


def _command(textures: Textures, step: Encoded) -> Node:
    at = step.at
    named = [scalar(textures.name(item), at) for item in step.what if isinstance(item, Texture)]
    if step.kind == "present":
        return mapping([("present", at, named[0])], at)
    if step.kind == "copy":
        return mapping([("copy", at, mapping([("source", at, named[0]), ("destination", at, named[1])], at))], at)
    return mapping([("readTexture", at, mapping([("texture", at, named[0]), ("stage", at, scalar(str(step.what[1]), at))], at))], at)
