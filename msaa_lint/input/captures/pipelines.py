"""VkGraphicsPipelineCreateInfo as a description states it, with the code of its shaders."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any

from msaa_lint.frame.description.models import Pipeline

from . import values
from .structures import Tree, described


def pipelines_of(info: dict[str, Any], modules: Mapping[int, bytes]) -> tuple[Tree, dict[str, bytes]]:
    """A pipeline's tree, and the code of the modules that its stages name, by the names they have there."""
    structure = dict(info)
    # In a description the dynamic states stand by themselves.
    dynamic = values.record(info.get("pDynamicState") or info.get("dynamicState"))
    structure["dynamicState"] = dynamic.get("pDynamicStates", dynamic.get("dynamicState")) or []
    structure.pop("pDynamicState", None)
    structure.pop("renderPass", None)
    stages = values.items(info.get("pStages") or info.get("stages"))
    structure["pStages"] = None
    structure.pop("stages", None)
    tree = described(Pipeline, structure)
    if not values.handle(info.get("renderPass")):
        tree.pop("subpass", None)
    made, code = _stages(stages, modules)
    if made:
        tree["stages"] = made
    return tree, code


def _stages(stages: list[Any], modules: Mapping[int, bytes]) -> tuple[list[Tree], dict[str, bytes]]:
    """The fragment stage, which is the one that rules ask about, where its code is known."""
    made: list[Tree] = []
    found: dict[str, bytes] = {}
    for stage in stages[:16]:
        given = values.record(stage)
        kind = values.enum("VkShaderStageFlagBits", given.get("stage"))
        code = modules.get(values.handle(given.get("module")))
        # With constants whose values the capture does not tell, it is not known what the code does.
        specialized = given.get("pSpecializationInfo") or given.get("specializationInfo")
        if kind != "FRAGMENT" or code is None or specialized:
            continue
        name = f"shaders/{hashlib.sha256(code).hexdigest()[:16]}.spv"
        found[name] = code
        tree: Tree = {"stage": kind, "module": name}
        entry = values.text(given.get("pName") or given.get("name"))
        if entry:
            tree["name"] = entry
        made.append(tree)
    return made, found
