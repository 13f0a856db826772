"""A fragment shader that the user names, SPIR-V or GLSL, as stages for the pipelines of a plan."""

from __future__ import annotations

from msaa_lint.core.quote import quoted_path
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable
from msaa_lint.frame.spirv.bindings import INPUT_ATTACHMENT
from msaa_lint.frame.spirv.module import Module
from msaa_lint.frame.spirv.words import SpirvError
from msaa_lint.input.glsl_compiler import CompilationError, compiled

from .parts import Stage, packed
from .plan_descriptors import Unmakeable
from .shader_stages import FRAGMENT, fragment_entry, reflected_stage, scene_stage

MAX_OWN = 1 << 19
"""Bytes of SPIR-V or GLSL. The code is part of every plan, and the plans of a timing are one
request to the child process.
"""


class UnusableOwnShader(Exception):
    """The shader cannot be used; the message is one sentence that names it."""


def own_shader(path: str) -> tuple[Stage, Stage]:
    """The stages, to be the `stages` of pipelines: a vertex shader that draws the scene and writes
    the inputs of the fragment shader, and the fragment shader (`main`, or the first one) with its
    descriptors and push constants. UnusableOwnShader for a shader that is invalid, or needs what
    cannot be created on any device; `shader_support.unsupported` tells whether a device supports
    it.
    """
    shown = quoted_path(path)
    try:
        code = read(path, MAX_OWN, None)
        if not code.startswith((b"\x03\x02\x23\x07", b"\x07\x23\x02\x03")):
            if path.endswith(".spv"):
                raise SpirvError("it is not SPIR-V")
            if path.endswith((".hlsl", ".metal", ".wgsl")):
                raise SpirvError(
                    "only SPIR-V and GLSL are supported: compile it to SPIR-V, HLSL by `dxc -spirv "
                    "-T ps_6_0`"
                )
            code = compiled(path)
        if len(code) > MAX_OWN:
            raise SpirvError(f"its SPIR-V is larger than {MAX_OWN >> 10} KiB")
        module = Module(code)
        fragment = reflected_stage(module, fragment_entry(module, None), FRAGMENT, "", ())
        attachment = next(
            (each for each in fragment.interface.descriptors if each.kind == INPUT_ATTACHMENT), None
        )
        if attachment is not None:
            where = (
                f"input attachment {attachment.attachment} at set {attachment.set}, binding "
                f"{attachment.binding}"
            )
            raise Unmakeable(f"reads {where}, and the passes of a study have none")
        outputs = {
            each.location: each.type for each in fragment.interface.outputs if each.blend_index == 0
        }
        if not outputs.get(0, "").startswith(("float", "vec")):
            found = (
                f"its output at location 0 is of type {outputs[0]}"
                if 0 in outputs
                else "it has no output at location 0"
            )
            raise Unmakeable(f"does not write a color: {found}, and must be a float or a vec4")
        return scene_stage(fragment), fragment.stage._replace(code=packed(code))
    except (OSError, Unreadable) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise UnusableOwnShader(f"the shader {shown} cannot be read: {reason}") from None
    except (SpirvError, CompilationError) as error:
        raise UnusableOwnShader(f"the shader {shown} cannot be used: {error}") from None
    except Unmakeable as error:
        raise UnusableOwnShader(f"the shader {shown} {error}") from None
