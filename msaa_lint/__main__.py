"""`msaa-lint`, and `python -m msaa_lint`.

Until `isolate` returns, this module and the package import nothing that a file of the working
folder could replace: no `__future__` either.
"""

import gc
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


def main() -> None:
    """Runs the command that the arguments name, and exits with its code."""
    # A run creates many small objects that live to its end, and collecting in between costs a third
    # of the time of reading large inputs. `linter.run` collects between inputs where garbage
    # accumulates.
    gc.disable()
    if sys.argv[1:] == ["--version"] and sys.stdout is not None:
        # Needs no other module, unless it cannot be written.
        try:
            _run()
            return
        except OSError:
            pass
    from .core.isolation import isolate

    isolate()
    from .core.interrupts import install

    install()
    from .cli.streams import run_with_streams

    code = run_with_streams(_run)
    if "duckdb" in sys.modules:
        # Its binding reports what is not collected at exit.
        gc.enable()
    else:
        # Spares the collection that Python does at exit.
        gc.freeze()
    sys.exit(code)


def _run() -> int:
    words = sys.argv[1:]
    if words == ["--version"]:
        from . import __version__

        print(f"msaa-lint {__version__}", flush=True)
        return 0
    from .cli.arguments import run_words

    code = run_words(words)
    if isinstance(code, int):
        return code
    from .cli.common import run_command

    def help_or_complete(arguments: "dict[str, Any]") -> int:
        from .cli.app import app

        app(arguments["words"], prog_name="msaa-lint")
        return 0

    return run_command(help_or_complete, {"paths": [], "words": code})


if __name__ == "__main__":
    main()
