"""What a run is asked to do."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from msaa_lint.core.finding import Result
from msaa_lint.core.rendered import RenderedPart
from msaa_lint.input.file_types import STDIN


class Renderer(Protocol):
    """Renders what an input adds to a report. It travels by name."""

    def __call__(self, result: Result, docs_url: str) -> RenderedPart:
        """What the result of an input adds to a report that links to the documentation at an
        address.
        """
        ...


class Division(NamedTuple):
    """Who reads the inputs: the workers of a cluster (`backend` is its engine, `cluster` its
    address), or processes of this machine. `jobs` is the number of inputs at once (None: the
    workers, or the cores if there is enough to do).
    """

    backend: str | None = None
    cluster: str | None = None
    jobs: int | None = None


ALONE = Division(jobs=1)
"""This process reads the inputs."""


class Request(NamedTuple):
    """What a run is asked to do.

    `overrides` are keyword arguments of `settings.override`. `data` replaces standard input, which
    findings call `stdin_filename`. `format` forces a reader, `frame_end` says what ends the frames
    of captures. `formats` are the outputs to print instead of those in the settings, and `fallback`
    is the output if neither names one: findings get prices only if an output shows them. `by_price`
    sorts findings by price, highest first. `fix` is `write` to fix files in place, or `show` to
    compute the fixes only; `unsafe_fixes` includes fixes that may change the picture. Standard
    input is never written. `keys` is the number of undecided rules of an input for which a key is
    looked up that they lack (None: of all), and `all_keys` finds all keys that undecided rules
    lack, and not only the next one. `log` is called with a line for each configuration and each
    input that is used. `traceback` raises an exception that linting an input causes, instead of
    reporting it. `cache` uses and keeps results in the user's cache folder. `division` says who
    reads the inputs. `edits` writes the edits of fixes into the findings. `renderers` are those of
    the formats that are rendered input by input; the result has texts in place of findings if there
    is no other output.
    """

    paths: Sequence[str]
    overrides: Mapping[str, Any] = {}
    config: str | None = None
    isolated: bool = False
    ignores: bool = True
    format: str | None = None
    frame_end: str | None = None
    stdin_filename: str | None = None
    data: bytes | None = None
    full_rules: bool = False
    without_baseline: bool = False
    formats: Sequence[str] = ()
    fallback: str = "json"
    by_price: bool = False
    fix: str | None = None
    unsafe_fixes: bool = False
    keys: int | None = None
    all_keys: bool = False
    log: Callable[[str], None] | None = None
    traceback: bool = False
    cache: bool = False
    division: Division = ALONE
    edits: bool = True
    renderers: Mapping[str, Renderer] = {}

    def input_name(self, path: str) -> str:
        """The name of an input in findings."""
        return (self.stdin_filename or "<stdin>") if path == STDIN else path
