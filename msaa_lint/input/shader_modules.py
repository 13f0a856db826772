"""Loads the SPIR-V or GLSL of shader stages, and extracts what matters for multisampling.

A module comes with the input (a capture), or is a file of the project: its path is relative to the folder of the description. Files are
untrusted: their size is limited and they are only read as data. A problem with a module is a warning at its `module`; rules that need the
shader stay undecided.
"""

import os

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.project import Outside, folder_of, project_root
from msaa_lint.core.quote import quoted_path
from msaa_lint.core.text.files import read
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.span import Span
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import ShaderStage
from msaa_lint.frame.spirv.module import MAX_BYTES, Module
from msaa_lint.frame.spirv.reflect import Reflected, reflected
from msaa_lint.frame.spirv.words import SpirvError

MAX_WORK = 64_000_000
"""The budget of one document: the words of modules, for each analysis, and the instructions followed, each of which counts as STEP words.
It corresponds to about 30 seconds; a game's frame takes a hundredth of it."""

STEP = 16

TOO_MANY = "this shader module and later ones were not analyzed because there are too many or they are too large"

GLSL = (".frag", ".comp", ".glsl", ".vert", ".tesc", ".tese", ".geom", ".mesh", ".task")
"""File name extensions of GLSL."""

MAGIC = (b"\x03\x02\x23\x07", b"\x07\x23\x02\x03")
"""The SPIR-V magic number, in either byte order."""

MAX_KEPT = 8
"""Maximum number of cached modules: pipelines that share a module are usually adjacent."""


class _Unusable(Exception):
    """A module cannot be used: the code of the finding, the message, and the help text."""

    def __init__(self, code: str, message: str, help: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.help = help


class Modules:
    """The shader modules of one document. `findings` are the warnings about unusable modules."""

    def __init__(self, document: Document, file: str) -> None:
        self.findings: list[Finding] = []
        self._own = document.modules
        self._file = file
        self._folder = folder_of(file)
        self._left = MAX_WORK
        self._warned: set[tuple[str, str]] = set()
        self._kept: dict[str, Module | _Unusable] = {}
        self._known: dict[object, Reflected | None] = {}

    def reflected(self, stage: ShaderStage, alpha: bool) -> Reflected | None:
        """The properties of a stage's module; None if it cannot be used. `alpha` also asks what is written to the alpha of color 0."""
        constants = {int(name): value for name, value in (stage.specialization or {}).items()}
        key = (stage.module, stage.name, tuple(constants.items()), alpha)
        if key not in self._known:
            self._known[key] = self._reflected(stage, constants, alpha)
        return self._known[key]

    def _reflected(self, stage: ShaderStage, constants: dict[int, float | bool], alpha: bool) -> Reflected | None:
        name = stage.module or ""
        try:
            module = self._module(name)
            self._left -= len(module.words)
            if self._left < 0:
                raise _Unusable("MSAA906", TOO_MANY)
            try:
                found = reflected(module, stage.name, constants, alpha)
                self._left -= STEP * found.steps
            except SpirvError as error:
                raise _Unusable("MSAA904" if "entry point" in str(error) else "MSAA903", f"{quoted_path(name)}: {error}") from None
            if found.stage != stage.stage:
                message = f"{quoted_path(name)}: `{found.name[:40]}` is a shader of stage {found.stage}, not {stage.stage}"
                raise _Unusable("MSAA903", message)
        except _Unusable as error:
            self._warn(error, stage)
            return None
        return found

    def _warn(self, error: _Unusable, stage: ShaderStage) -> None:
        # Report each problem once, at the first stage that has it. The budget warning does not name a module.
        key = ("" if error.code == "MSAA906" else stage.module or "", str(error))
        if key in self._warned:
            return
        self._warned.add(key)
        at: Span = stage.place("name") if "entry point" in str(error) and stage.states("name") else stage.place("module")
        help = error.help or "rules that need the shader stay undecided"
        self.findings.append(
            diagnostic(error.code, str(error), self._file, at, f"{stage.path}.module", help=help)._replace(severity="warning")
        )

    def _module(self, name: str) -> Module:
        kept = self._kept.pop(name, None)
        if kept is None:
            if len(self._kept) >= MAX_KEPT:
                self._kept.pop(next(iter(self._kept)))
            try:
                kept = self._read(name)
            except _Unusable as error:
                kept = error
        self._kept[name] = kept
        if isinstance(kept, _Unusable):
            raise kept
        return kept

    def _read(self, name: str) -> Module:
        code = self._own.get(name)
        if code is None:
            code = self._bytes(name)
        if self._left < len(code) // 4:
            raise _Unusable("MSAA906", TOO_MANY)
        if name.endswith(GLSL) and code[:4] not in MAGIC:
            code = self._of_text(name, code)
        try:
            return Module(code)
        except SpirvError as error:
            raise _Unusable(
                "MSAA903", f"{quoted_path(name)}: {error}", "a module must be SPIR-V, for example from glslang or DXC"
            ) from None

    def _of_text(self, name: str, code: bytes) -> bytes:
        """Compiles GLSL to SPIR-V."""
        from .code.glsl.shader import shader
        from .code.glsl.text import UnsupportedShader
        from .code.parsing import Missing

        self._left -= STEP * len(code)
        try:
            # Snippets and included files may be partial shaders.
            return shader(code.decode("utf-8", "replace"), True).code
        except Missing as error:
            raise _Unusable("MSAA903", f"{quoted_path(name)} is GLSL", str(error)) from None
        except UnsupportedShader as error:
            raise _Unusable(
                "MSAA903", f"{quoted_path(name)} cannot be analyzed: {error}", "name its SPIR-V instead, which is fully supported"
            ) from None

    def _bytes(self, name: str) -> bytes:
        try:
            return read(os.path.join(self._folder, name), MAX_BYTES, project_root(self._folder))
        except Outside:
            raise _Unusable("MSAA903", f"{quoted_path(name)} is outside the project") from None
        except FileNotFoundError:
            raise _Unusable("MSAA904", f"file not found: {quoted_path(name)}", "rules that need the shader stay undecided") from None
        except Unreadable:
            raise _Unusable("MSAA903", f"{quoted_path(name)} cannot be read: it is larger than {MAX_BYTES >> 20} MiB") from None
        except OSError as error:
            raise _Unusable("MSAA903", f"{quoted_path(name)} cannot be read: {error.strerror or error}") from None
