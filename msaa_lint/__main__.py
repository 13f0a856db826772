"""`msaa-lint`, and `python -m msaa_lint`."""

from __future__ import annotations

import gc
import sys


def main() -> None:
    """Runs the command that the arguments name, and exits with its code."""
    # A run creates many small objects that live to its end, and collecting in between costs a third of the time of reading large inputs.
    # `linter.run` collects between inputs where garbage accumulates.
    gc.disable()
    words = sys.argv[1:]
    if words == ["--version"]:
        from . import __version__

        print(f"msaa-lint {__version__}")
        return
    from .cli.arguments import run_words

    code = run_words(words)
    if isinstance(code, int):
        # Spares the collection that Python does at exit.
        gc.freeze()
        sys.exit(code)
    from .cli.app import app

    app(code, prog_name="msaa-lint")


if __name__ == "__main__":
    main()
