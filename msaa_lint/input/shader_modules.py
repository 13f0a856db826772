"""Loads the SPIR-V or GLSL of shader stages, and extracts what matters for multisampling.

A module comes with the input (a capture), or is a file of the project: its path is relative to the
folder of the description. Files are untrusted: their size is limited and they are only read as
data. A problem with a module is a warning at its `module`; rules that need the shader stay
undecided.
"""

import os
from collections.abc import Callable
from typing import Any

from msaa_lint.core.diagnostics import diagnostic
from msaa_lint.core.finding import Finding
from msaa_lint.core.project import Outside, folder_of, project_root
from msaa_lint.core.quote import quoted_path
from msaa_lint.core.text.files import read, record
from msaa_lint.core.text.source import Unreadable
from msaa_lint.core.text.span import Span
from msaa_lint.core.urls import is_url
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.description.models import ShaderStage
from msaa_lint.frame.spirv.module import MAX_BYTES, Module
from msaa_lint.frame.spirv.reflect import Reflected, reflected
from msaa_lint.frame.spirv.words import SpirvError

MAX_WORK = 8_000_000
"""The budget of an input, however small its modules: the words of modules, for each analysis, and
the instructions followed, each of which counts as STEP words. It corresponds to about 4 seconds; a
game's frame takes a tenth of it.
"""

ANALYSES = 16
"""The budget's part that grows with the modules of an input, as a multiple of their words."""

STEP, ANALYSIS = 16, 1000
"""What an instruction that is followed, and any analysis, count as, in words."""

TOO_MANY = (
    "this shader module and later ones were not analyzed because there are too many or they "
    "are too large"
)

GLSL = (".frag", ".comp", ".glsl", ".vert", ".tesc", ".tese", ".geom", ".mesh", ".task")
"""File name extensions of GLSL."""

MAGIC = (b"\x03\x02\x23\x07", b"\x07\x23\x02\x03")
"""The SPIR-V magic number, in either byte order."""

MAX_KEPT_WORDS = MAX_BYTES // 4
"""Words of cached modules: pipelines that share a module are usually adjacent."""


class _Unusable(Exception):
    """A module cannot be used: the code of the finding, the message, and the help text."""

    def __init__(self, code: str, message: str, help: str = "") -> None:
        super().__init__(message)
        self.code = code
        self.help = help

    def copy(self) -> "_Unusable":
        """Returns the same error without its traceback, which would keep all that is known of a
        frame.
        """
        return _Unusable(self.code, str(self), self.help)


class ShaderAnalyses:
    """The shader modules of one run. Each is analyzed once for each entry point and specialization.

    The modules of an input have one budget, from which an analysis is taken also if it was done for
    an input before: whether a module is analyzed does not depend on other inputs.
    """

    def __init__(self) -> None:
        self.left = MAX_WORK
        self._work: dict[object, int] = {}
        """What a source or an analysis took, in words."""
        self._charged: set[object] = set()
        """The analyses that were taken from the budget of this input."""
        self._known: dict[object, Reflected | _Unusable] = {}
        self._modules: dict[object, Module | _Unusable] = {}
        self._words = 0
        self._sources: set[object] = set()
        """The sources that this input has."""

    def begin_input(self) -> None:
        """Begins a budget."""
        self.left = MAX_WORK
        self._charged, self._sources = set(), set()

    def reflected(
        self, source: object, name: str, code: Callable[[], bytes], query: tuple[Any, ...]
    ) -> Reflected:
        """What a module says. `source` identifies it in the run, `code` reads it; the query is the
        entry point, the constants, and whether what is written to the alpha of color 0 is asked
        for. Raises: _Unusable.
        """
        key = (source, *query)
        if key not in self._known:
            try:
                found: Reflected | _Unusable = self._reflected(source, name, code, query)
            except _Unusable as error:
                if error.code == "MSAA906":
                    raise
                found = error.copy()
            self._known[key] = found
        elif key not in self._charged:
            self._charge(source, self._work.get(source, 0))
            self.spend(self._work.get(key, 0))
        self._charged.add(key)
        known = self._known[key]
        if isinstance(known, _Unusable):
            raise known.copy()
        return known

    def spend(self, work: int) -> None:
        """Counts work before it is done. Raises: _Unusable."""
        self.left -= work
        if self.left < 0:
            raise _Unusable("MSAA906", TOO_MANY)

    def _reflected(
        self, source: object, name: str, code: Callable[[], bytes], query: tuple[Any, ...]
    ) -> Reflected:
        module = self._module(source, name, code)
        self.spend(ANALYSIS + len(module.words))
        entry, constants, alpha = query
        try:
            found = reflected(module, entry, dict(constants), alpha)
        except SpirvError as error:
            raise _Unusable(
                "MSAA904" if "entry point" in str(error) else "MSAA903",
                f"{quoted_path(name)}: {error}",
            ) from None
        self.left -= STEP * found.steps
        self._work[(source, *query)] = ANALYSIS + len(module.words) + STEP * found.steps
        return found

    def _module(self, source: object, name: str, code: Callable[[], bytes]) -> Module:
        kept = self._modules.pop(source, None)
        if kept is not None:
            self._charge(source, self._work.get(source, 0))
        if kept is None:
            try:
                kept = self._read(source, name, code())
                self._words += len(kept.words)
            except _Unusable as error:
                if error.code == "MSAA906":
                    raise
                kept = error.copy()
        while self._words > MAX_KEPT_WORDS and self._modules:
            dropped = self._modules.pop(next(iter(self._modules)))
            self._words -= len(dropped.words) if isinstance(dropped, Module) else 0
        self._modules[source] = kept
        if isinstance(kept, _Unusable):
            raise kept.copy()
        return kept

    def _charge(self, source: object, words: int) -> None:
        """Counts the reading of a module of so many words, the first time in an input."""
        if source not in self._sources:
            self._sources.add(source)
            self.left += ANALYSES * words
            self.spend(ANALYSIS + words)

    def _read(self, source: object, name: str, code: bytes) -> Module:
        self._work[source] = len(code) // 4
        if source in self._sources:
            # It was dropped meanwhile.
            self.spend(ANALYSIS + len(code) // 4)
        self._charge(source, len(code) // 4)
        if name.endswith(GLSL) and code[:4] not in MAGIC:
            self.spend(STEP * len(code))
            code = _of_text(name, code)
        try:
            return Module(code)
        except SpirvError as error:
            raise _Unusable(
                "MSAA903",
                f"{quoted_path(name)}: {error}",
                "a module must be SPIR-V, for example from glslang or DXC",
            ) from None


class Modules:
    """The shader modules of one document. `findings` are the warnings about unusable modules."""

    def __init__(
        self, document: Document, file: str, analyses: ShaderAnalyses | None = None
    ) -> None:
        self.findings: list[Finding] = []
        self._analyses = analyses or ShaderAnalyses()
        self._own = document.modules
        self._file = file
        self._folder = folder_of(file)
        self._project = project_root(self._folder)
        self._digests: dict[str, bytes] = {}
        self._warned: set[tuple[str, str]] = set()

    def reflected(self, stage: ShaderStage, alpha: bool) -> Reflected | None:
        """The properties of a stage's module; None if it cannot be used. `alpha` also asks what is
        written to the alpha of color 0.
        """
        name = stage.module or ""
        constants = tuple(
            (int(each), value) for each, value in (stage.specialization or {}).items()
        )
        try:
            source, code = self._source(name)
            found = self._analyses.reflected(source, name, code, (stage.name, constants, alpha))
            if found.stage != stage.stage:
                message = (
                    f"{quoted_path(name)}: `{found.name[:40]}` is a shader of stage "
                    f"{found.stage}, not {stage.stage}"
                )
                raise _Unusable("MSAA903", message)
        except _Unusable as error:
            self._warn(error, stage)
            return None
        if found.exhausted:
            message = (
                f"{quoted_path(name)}: the shader was not followed to its end, because it "
                f"takes more than {found.steps} steps"
            )
            self._warn(
                _Unusable(
                    "MSAA906", message, "what it does with samples and alpha after that is unknown"
                ),
                stage,
                "note",
            )
        return found

    def _source(self, name: str) -> tuple[object, Callable[[], bytes]]:
        """What identifies a module in the run, and a function that reads it: of a capture its
        content, else the file.
        """
        own = self._own.get(name)
        if own is None:
            path = os.path.join(self._folder, name)
            # What was found out for another input is not read again. With its name, which messages
            # state.
            record(path, self._project)
            return (
                self._project,
                path if is_url(self._folder) else os.path.abspath(path),
                name,
            ), lambda: self._bytes(name)
        if name not in self._digests:
            from hashlib import blake2b

            self._digests[name] = blake2b(own).digest()
        return self._digests[name], lambda: own

    def _warn(self, error: _Unusable, stage: ShaderStage, severity: str = "warning") -> None:
        # Report each problem once, at the first stage that has it. The budget warning does not name
        # a module.
        key = ("" if error.code == "MSAA906" else stage.module or "", str(error))
        if key in self._warned:
            return
        self._warned.add(key)
        at: Span = (
            stage.place("name")
            if "entry point" in str(error) and stage.states("name")
            else stage.place("module")
        )
        help = error.help or "rules that need the shader stay undecided"
        self.findings.append(
            diagnostic(
                error.code, str(error), self._file, at, f"{stage.path}.module", help=help
            )._replace(severity=severity)
        )

    def _bytes(self, name: str) -> bytes:
        try:
            return read(os.path.join(self._folder, name), MAX_BYTES, self._project)
        except Outside:
            raise _Unusable("MSAA903", f"{quoted_path(name)} is outside the project") from None
        except FileNotFoundError:
            raise _Unusable(
                "MSAA904",
                f"file not found: {quoted_path(name)}",
                "rules that need the shader stay undecided",
            ) from None
        except Unreadable:
            raise _Unusable(
                "MSAA903",
                f"{quoted_path(name)} cannot be read: it is larger than {MAX_BYTES >> 20} MiB",
            ) from None
        except OSError as error:
            raise _Unusable(
                "MSAA903", f"{quoted_path(name)} cannot be read: {error.strerror or error}"
            ) from None


def _of_text(name: str, code: bytes) -> bytes:
    """Compiles GLSL to SPIR-V."""
    from .code.glsl.shader import shader
    from .code.glsl.text import UnsupportedShader
    from .code.parsing import Missing

    try:
        # Snippets and included files may be partial shaders.
        return shader(code.decode("utf-8", "replace"), True).code
    except Missing as error:
        raise _Unusable("MSAA903", f"{quoted_path(name)} is GLSL", str(error)) from None
    except UnsupportedShader as error:
        raise _Unusable(
            "MSAA903",
            f"{quoted_path(name)} cannot be analyzed: {error}",
            "name its SPIR-V instead, which is fully supported",
        ) from None
