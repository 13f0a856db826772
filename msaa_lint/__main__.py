"""`msaa-lint`, and `python -m msaa_lint`."""

from __future__ import annotations

import gc
import sys


def main() -> None:
    """Runs the command that the arguments name, and exits with its code."""
    # A run makes many small objects that live to its end: collecting in between only costs (a third of reading large inputs, a tenth of a
    # small one). `run` collects between inputs where garbage gathers.
    gc.disable()
    arguments = sys.argv[1:]
    if arguments[:1] == ["check"]:
        from .cli.options import read

        given = read(arguments[1:])
        if given is not None:
            from .cli.check import check

            code = check(given)
            # Nor is there anything to gain from the collection with which Python ends.
            gc.freeze()
            sys.exit(code)
    if arguments[:1] == ["confirm"]:
        from .cli.confirm_options import read as read_confirm

        given = read_confirm(arguments[1:])
        if given is not None:
            from .cli.confirm import confirm

            sys.exit(confirm(given))
    if arguments[:1] == ["study"]:
        from .cli.study_options import read as read_study

        given = read_study(arguments[1:])
        if given is not None:
            from .cli.study import study

            sys.exit(study(given))
    if arguments == ["--version"]:
        from . import __version__

        print(f"msaa-lint {__version__}")
        return
    from .cli.app import app

    app(prog_name="msaa-lint")


if __name__ == "__main__":
    main()
