"""An input that has been read, with the settings that apply to it."""

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from msaa_lint.core.finding import Finding, rank
from msaa_lint.core.project import shown
from msaa_lint.core.text.node import Limits
from msaa_lint.core.text.source import Source, encode
from msaa_lint.frame.devices import DeviceProfile

from .engine import Engine
from .lint_options import LintOptions
from .results import FileResult, finding_kind, unmerged
from .settings.selection import Selection
from .settings.settings import Settings

if TYPE_CHECKING:
    from msaa_lint.input.capture_input import CaptureInput
    from msaa_lint.input.source_file import SourceFile

    from .fixes.fixer import Lint


class ResolvedSettings(NamedTuple):
    """The settings that apply to a file, with the rules, the device and the limits that they
    name.
    """

    settings: Settings
    selection: Selection
    engine: Engine
    device: DeviceProfile | None
    limits: Limits
    configuration: str | None


class InputFile(NamedTuple):
    """An input that has been read, and how to lint it. `path` is `-` for standard input; findings
    below `min_severity` are hidden.
    """

    path: str
    name: str
    data: "bytes | CaptureInput | SourceFile"
    resolved: ResolvedSettings
    options: LintOptions
    min_severity: str
    log: Callable[[str], None] | None = None

    def lint(self, data: bytes | None = None, prices: bool = False) -> FileResult:
        """The findings of the input, or of other `data` in its place."""
        result = self.resolved.engine.lint(
            self.data if data is None else data, self.name, self.options._replace(prices=prices)
        )
        if data is None and self.log is not None:
            formats = [getattr(self.data, "format", ""), getattr(self.data, "language", "")]
            formats += [document.document.format for document in result.documents]
            where = (
                f", {configuration_name(self.resolved.configuration)}"
                if self.resolved.configuration is not None
                else ""
            )
            self.log(f"{self.name}: read as {next(filter(None, formats), 'nothing')}{where}")
        return result

    def fixable(self, result: FileResult) -> Callable[[Finding], bool]:
        """Whether to fix a finding of the input or of its description: one that the settings turn
        off or hide is left alone.
        """
        settle, least = self.resolved.selection.settle, rank(self.min_severity)

        def is_shown(finding: Finding) -> bool:
            return rank(finding.severity) >= least and settle(finding) is not None

        if not result.is_code:
            return is_shown
        # The description has neither the comments of the code nor its lower confidence.
        reported = {finding_kind(finding) for finding in result.findings}
        return lambda finding: finding_kind(finding) in reported and is_shown(finding)

    def description(self, result: FileResult) -> tuple[FileResult, "Lint"]:
        """The result of linting the text that fixes edit, and a function that lints other contents
        of that text, to try fixes.

        The text is the input itself or, if `result` is that of a capture or source code, the
        description that `convert` writes of it.
        """
        data, engine, name = self.data, self.resolved.engine, self.name
        # Of a trial, only the findings count.
        options = self.options._replace(prices=False, keys=None)
        if isinstance(data, bytes):
            return unmerged(result), lambda text: unmerged(
                engine.lint(encode(text, data), name, options)
            )
        modules = data.modules

        def lint(text: str) -> FileResult:
            # Without origins, the order of commands would be checked as that of a description that
            # a person wrote.
            return engine.lint_description(Source(name, text, []), name, options, modules)

        return result.description or lint(data.description), lint


def configuration_name(path: str | None) -> str:
    """A configuration file as the lines of `--verbose` name it."""
    return "no configuration file" if path is None else f"configuration {shown(path)}"
