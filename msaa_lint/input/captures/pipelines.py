"""Converts VkGraphicsPipelineCreateInfo to the form of a description, with the code of its shaders."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from typing import Any

from msaa_lint.frame.description.models import Pipeline

from . import values
from .structures import Tree, to_tree


def pipeline_of(info: dict[str, Any], modules: Mapping[int, bytes]) -> tuple[Tree, dict[str, bytes]]:
    """A pipeline's tree, and the code of the shader modules by the names that the tree uses."""
    structure = dict(info)
    # A description lists the dynamic states directly.
    dynamic = values.record(info.get("pDynamicState") or info.get("dynamicState"))
    structure["dynamicState"] = dynamic.get("pDynamicStates", dynamic.get("dynamicState")) or []
    structure.pop("pDynamicState", None)
    structure.pop("renderPass", None)
    stages = values.items(info.get("pStages") or info.get("stages"))
    structure["pStages"] = None
    structure.pop("stages", None)
    tree = to_tree(Pipeline, structure)
    if not values.handle(info.get("renderPass")):
        tree.pop("subpass", None)
    made, code = _stages(stages, modules)
    if made:
        tree["stages"] = made
    return tree, code


def _stages(stages: list[Any], modules: Mapping[int, bytes]) -> tuple[list[Tree], dict[str, bytes]]:
    """The fragment stage, the only one that rules need, if its code is known."""
    trees: list[Tree] = []
    modules_by_name: dict[str, bytes] = {}
    for stage in stages[:16]:
        info = values.record(stage)
        kind = values.enum("VkShaderStageFlagBits", info.get("stage"))
        code = modules.get(values.handle(info.get("module")))
        # The capture omits the values of specialization constants, so the behavior of the code is unknown.
        specialized = info.get("pSpecializationInfo") or info.get("specializationInfo")
        if kind != "FRAGMENT" or code is None or specialized:
            continue
        name = f"shaders/{hashlib.sha256(code).hexdigest()[:16]}.spv"
        modules_by_name[name] = code
        tree: Tree = {"stage": kind, "module": name}
        entry = values.text(info.get("pName") or info.get("name"))
        if entry:
            tree["name"] = entry
        trees.append(tree)
    return trees, modules_by_name
