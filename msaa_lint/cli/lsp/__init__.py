"""`msaa-lint lsp`: the language server."""

from __future__ import annotations

from msaa_lint.cli.common import UsageError, run_command
from msaa_lint.cli.options import Arguments
from msaa_lint.core.extras import needs_extra


def lsp(arguments: Arguments) -> int:
    """Serves one editor over standard input and output until it disconnects; returns the exit
    code.
    """
    return run_command(_lsp, arguments)


def _lsp(arguments: Arguments) -> int:
    try:
        from .protocol import serve
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("pygls", "lsprotocol", "attrs", "cattrs"):
            raise
        raise UsageError(needs_extra("the language server", "lsp")) from None
    return serve()
