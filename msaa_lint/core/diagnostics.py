"""The 9xx diagnostics: problems of an input, a rule page, a suppression or the configuration
itself.
"""

from __future__ import annotations

from .finding import Finding, RuleInfo
from .quote import quoted
from .text.span import Label, Span

HIDDEN_CHARACTER = "MSAA914"

_TEXTS = {
    "MSAA901": (
        "syntax",
        "error",
        "The input is not readable: its encoding, its YAML or its JSON is broken.",
    ),
    "MSAA902": ("unknown-key", "error", "A key that the structure does not have."),
    "MSAA903": (
        "wrong-value",
        "error",
        "A value of the wrong type, or one that its type does not have.",
    ),
    "MSAA904": (
        "dangling-reference",
        "error",
        "A name or an index that nothing in the description has.",
    ),
    "MSAA905": ("duplicate-key", "error", "The same key twice in one mapping."),
    "MSAA906": ("limit-exceeded", "error", "The input exceeds a limit on depth, nodes or size."),
    "MSAA911": ("unused-suppression", "warning", "A suppression comment that silences nothing."),
    "MSAA912": (
        "unknown-rule-in-suppression",
        "warning",
        "A suppression comment that names no rule there is, or that cannot be read.",
    ),
    "MSAA913": (
        "blanket-suppression",
        "warning",
        "A suppression comment that names no rule: it silences nothing.",
    ),
    "MSAA914": (
        "hidden-character",
        "note",
        "A character that cannot be seen, or that displays its line in another order than it is "
        "read.",
    ),
    "MSAA915": (
        "unused-assumption",
        "warning",
        "An `assume` comment in source code that states nothing that is read.",
    ),
    "MSAA916": (
        "invalid-assumption",
        "error",
        "An `assume` comment in source code that cannot be read.",
    ),
    "MSAA921": (
        "configuration",
        "error",
        "The configuration, a rule page, a baseline or a path cannot be used.",
    ),
    "MSAA931": (
        "unread-input",
        "error",
        "With `--strict-inputs`: the input creates something multisampled, but shows no pass to "
        "check.",
    ),
    "MSAA941": (
        "internal-error",
        "error",
        "msaa-lint failed on an input, which is a mistake in msaa-lint. The other inputs are still "
        "linted.",
    ),
}

DIAGNOSTICS: dict[str, RuleInfo] = {
    code: RuleInfo(code, name, severity, "high", summary, f"{summary}\n")
    for code, (name, severity, summary) in _TEXTS.items()
}
"""By code."""


def diagnostic(
    code: str,
    message: str,
    file: str,
    span: Span | None = None,
    subject: str = "",
    labels: tuple[Label, ...] = (),
    help: str = "",
) -> Finding:
    """A 9xx finding."""
    info = DIAGNOSTICS[code]
    return Finding(
        code, info.name, info.severity, "high", message, file, span, subject, labels, (), help
    )


def internal_error(error: Exception) -> str:
    """The message of an exception that is a mistake in msaa-lint."""
    text = f": {quoted(str(error), 300)}" if str(error) else ""
    return (
        f"internal error: {type(error).__name__}{text}; please report it with the output of "
        "--traceback"
    )
