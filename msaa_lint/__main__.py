"""`msaa-lint`, and `python -m msaa_lint`."""

from __future__ import annotations

import sys


def main() -> None:
    """Runs the command that the arguments name, and exits with its code."""
    arguments = sys.argv[1:]
    if arguments[:1] == ["check"]:
        from .cli.options import read

        given = read(arguments[1:])
        if given is not None:
            from .cli.check import check

            sys.exit(check(given))
    if arguments == ["--version"]:
        from . import __version__

        print(f"msaa-lint {__version__}")
        return
    from .cli.app import app

    app(prog_name="msaa-lint")


if __name__ == "__main__":
    main()
