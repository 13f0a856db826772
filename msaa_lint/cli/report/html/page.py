"""The frame of every HTML report: one file with its style, script, and data, under a strict
Content-Security-Policy.

A report is a template of `templates/` that extends `base.html` and fills its blocks. Text of an
input is safe in any place of one: jinja2 escapes HTML, and `finalize` escapes before that what
`escape` does in a terminal (controls, characters that reorder a line).
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import jinja2
from markupsafe import Markup

from msaa_lint.core.package import VERSION

from .. import Write
from ..escape import clip, escape

_FOLDER = os.path.dirname(__file__)

# Escapes of JSON for what HTML, or JavaScript before 2019, reads in a script element.
_IN_SCRIPT = {ord(character): f"\\u{ord(character):04x}" for character in "<>&\u2028\u2029"}


def write_page(
    template: str,
    context: Mapping[str, Any],
    out: Write,
    *,
    data: object = None,
    styles: Sequence[str] = (),
    scripts: Sequence[str] = (),
) -> None:
    """Writes a page.

    `context` has `title` and what the template uses. `data` is what scripts read from the JSON of
    the element `data`. `styles` and `scripts` are texts that follow those of all reports; they must
    be the package's own, because the policy of the page allows them.
    """
    styles, scripts = [asset("style.css"), *styles], [asset("report.js"), *scripts]
    for script in scripts:
        if "</script" in script.lower() or "<!--" in script:
            raise ValueError("a script cannot be inline if it contains `</script` or `<!--`")
    values = {
        **context,
        "version": VERSION,
        "policy": policy(styles, scripts),
        "styles": [Markup(style) for style in styles],
        "scripts": [Markup(script) for script in scripts],
        "data": json_element(data),
    }
    for piece in _environment().get_template(template).generate(values):
        out(piece)


def policy(styles: Sequence[str], scripts: Sequence[str]) -> str:
    """The Content-Security-Policy of a page: nothing but these texts, by their hashes, and pictures
    inside the page.
    """
    return "; ".join((
        "default-src 'none'",
        f"script-src {' '.join(map(_hash, scripts))}",
        f"style-src {' '.join(map(_hash, styles))}",
        "img-src data:",
        "base-uri 'none'",
        "form-action 'none'",
    ))  # fmt: skip


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def json_element(data: object) -> Markup:
    """JSON that no text in it can end the script element of."""
    text = json.dumps(data, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    return Markup(text.translate(_IN_SCRIPT))


@cache
def asset(name: str) -> str:
    """A file beside the templates."""
    with open(os.path.join(_FOLDER, name), encoding="utf-8") as file:
        return file.read()


@cache
def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(os.path.join(_FOLDER, "templates")),
        autoescape=True,
        finalize=_visible,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )


def _visible(value: object) -> object:
    """What a template prints for a value: text on one line, with characters that cannot be seen
    escaped.
    """
    return (
        escape(clip(value)) if isinstance(value, str) and not isinstance(value, Markup) else value
    )
