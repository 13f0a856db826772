"""Arranges README, docs/, rules/, and examples/ as the pages of a site: `python -m docs.website
FOLDER [ADDRESS]`, which `docs/build` runs.

Writes FOLDER/pages and FOLDER/zensical.toml, whose `site_dir` is FOLDER/html. The pages keep their
places in the repository, so that the address of a rule's page is `rules/NAME/`; README.md becomes
the index of its folder. Links to what is no page become links to a copy of the file, or plain text.
"""

from __future__ import annotations

import json
import os
import posixpath
import re
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

from docs.website_rules import FAMILY_NAMES, RULES, picture_style, rule_list, rule_page
from msaa_lint.core.package import DOCUMENTATION

ROOT = Path(__file__).resolve().parent.parent

GUIDES = {
    "Engine team": "engine",
    "Continuous integration": "ci",
    "Editor": "editor",
    "Student": "student",
}
REFERENCE = {
    "Using msaa-lint": [
        "commands",
        "configuration",
        "ci",
        "editors",
        "html-report",
        "rows",
        "facts",
        "security",
    ],
    "Inputs": ["format", "keys", "captures", "source-code", "impeller", "devices"],
    "Models and measurements": ["cost", "confirm", "study", "study-numbers", "speed", "scale"],
    "Comparisons": ["captures-and-the-layer", "agreement", "texts"],
}
"""The pages of docs/ by heading, as in docs/README.md."""

_FENCES = re.compile(r"^( *)(`{3,}|~{3,})([^\n]*)\n(.*?)^\1\2 *$", re.MULTILINE | re.DOTALL)
_LINK = re.compile(r"(!?)\[((?:[^\[\]]|\[[^\[\]]*\])*)\]\(([^()\s#:]*)(#[^()\s]*)?\)")
_RUN_NOTE = re.compile(r"^<!-- (?:in |not run)[^\n]*-->\n\n?", re.MULTILINE)


def sources() -> list[str]:
    """The pages of the repository, as paths in it."""
    found = [ROOT / name for name in ("README.md", "CHANGELOG.md", "CONTRIBUTING.md")]
    found += [
        *ROOT.glob("docs/*.md"),
        *ROOT.glob("docs/guides/*.md"),
        *ROOT.glob("examples/**/*.md"),
        ROOT / "editors/vscode/README.md",
    ]
    return sorted(path.relative_to(ROOT).as_posix() for path in found)


def target_of(source: str) -> str:
    """Where a page of the repository is among the pages of the site."""
    return re.sub(r"(^|/)README\.md$", r"\1index.md", source)


def main(folder: str, address: str) -> None:
    """Writes the pages and the configuration."""
    pages = Path(folder, "pages")
    shutil.rmtree(pages, ignore_errors=True)
    known = {*sources(), "rules/README.md", *(f"rules/{rule.name}.md" for rule in RULES)}
    copied: set[str] = set()

    def write(source: str, text: str) -> None:
        file = pages / target_of(source)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(
            _outside_fences(text, lambda part: _relink(part, source, known, copied)),
            encoding="utf-8",
        )

    for source in sources():
        write(source, _RUN_NOTE.sub("", (ROOT / source).read_text(encoding="utf-8")))
    write("rules/README.md", rule_list())
    for rule in RULES:
        write(f"rules/{rule.name}.md", rule_page(rule))
    for source in sorted(copied):
        file = pages / source
        file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / source, file)
    style = (ROOT / "docs" / "website.css").read_text(encoding="utf-8")
    (pages / "website.css").write_text(f"{style}\n{picture_style()}", encoding="utf-8")
    Path(folder, "zensical.toml").write_text(configuration(address), encoding="utf-8")


def _outside_fences(text: str, change: Callable[[str], str]) -> str:
    """A page whose text between fenced code is changed. The fences of examples get classes and
    titles, which Python-Markdown reads.
    """
    parts, end = [], 0
    for fence in _FENCES.finditer(text):
        parts += [change(text[end : fence.start()]), _fence(fence)]
        end = fence.end()
    return "".join([*parts, change(text[end:])])


def _fence(fence: re.Match[str]) -> str:
    indent, marks, info, body = fence.groups()
    words = info.split()
    if len(words) > 1:
        info = f' {{.{words[0]} .{words[1]} title="{" ".join(words[1:]).capitalize()}"}}'
    return f"{indent}{marks}{info}\n{body}{indent}{marks}"


def _relink(text: str, source: str, known: set[str], copied: set[str]) -> str:
    """The text of a page with the links of the site; adds the files that it links to to
    `copied`.
    """

    def replace(link: re.Match[str]) -> str:
        image, label, path, anchor = link[1], link[2], link[3], link[4] or ""
        if not path:
            return link[0]
        linked = posixpath.normpath(posixpath.join(posixpath.dirname(source), path))
        if f"{linked}/README.md" in known or linked == ".":
            linked = posixpath.normpath(f"{linked}/README.md")
        if linked not in known:
            if not (ROOT / linked).is_file() or linked.startswith(".."):
                return label
            copied.add(linked)
        if re.fullmatch(r"[\w./-]+\.md", label):
            label = _title(linked)
        relative = posixpath.relpath(target_of(linked), posixpath.dirname(target_of(source)) or ".")
        return f"{image}[{label}]({relative}{anchor})"

    return _LINK.sub(replace, text)


def _title(source: str) -> str:
    """The heading of a page, which a link shows in place of the name of a file."""
    heading = re.search(r"^# (.+)$", (ROOT / source).read_text(encoding="utf-8"), re.MULTILINE)
    return heading[1] if heading else Path(source).stem


def navigation() -> list[object]:
    """The tree of pages, as Zensical reads it."""
    reference: list[object] = ["docs/index.md"]
    for heading, names in REFERENCE.items():
        reference.append({heading: [f"docs/{name}.md" for name in names]})
    rules: list[object] = ["rules/index.md"]
    for digit, heading in FAMILY_NAMES.items():
        family = [f"rules/{rule.name}.md" for rule in RULES if rule.code[4] == digit]
        if family:
            rules.append({heading: [{Path(page).stem: page} for page in family]})
    return [
        {"Home": "index.md"},
        {"Guides": [{title: f"docs/guides/{name}.md"} for title, name in GUIDES.items()]},
        {"Rules": rules},
        {
            "Reference": [
                *reference,
                {"Editors": [{"Visual Studio Code": "editors/vscode/index.md"}]},
            ]
        },
        {"Examples": ["examples/index.md", "examples/capture/index.md"]},
        {"Project": ["CONTRIBUTING.md", "CHANGELOG.md"]},
    ]


def configuration(address: str) -> str:
    """Zensical's configuration. Nothing is loaded from elsewhere: no fonts, and not the plugin
    `offline`, which loads a script.
    """
    # In this order, the first of which follows the system.
    modes = (
        ("(prefers-color-scheme)", "", "sun-moon", "light"),
        ("(prefers-color-scheme: light)", "default", "sun", "dark"),
    )
    palette = [
        {
            "media": media,
            **({"scheme": scheme} if scheme else {}),
            "toggle": {"icon": f"lucide/{icon}", "name": f"Switch to {following} mode"},
        }
        for media, scheme, icon, following in (
            *modes,
            ("(prefers-color-scheme: dark)", "slate", "moon", "the system's"),
        )
    ]
    features = [
        "content.code.copy", "navigation.indexes", "navigation.prune", "navigation.tabs",
        "navigation.top", "toc.follow",
    ]  # fmt: skip
    project: dict[str, object] = {
        "site_name": "msaa-lint",
        "site_description": "Finds multisampling mistakes in Vulkan and Metal frames that cost "
        "bandwidth, memory, power, or correctness",
        **({"site_url": address.rstrip("/") + "/"} if address else {}),
        "docs_dir": "pages",
        "site_dir": "html",
        "extra_css": ["website.css"],
        "nav": navigation(),
        "theme": {"font": False, "language": "en", "features": features, "palette": palette},
        "extra": {"generator": False},
        "plugins": {"search": {}},
        "markdown_extensions": {
            "admonition": {},
            "attr_list": {},
            "md_in_html": {},
            "tables": {},
            # As GitHub names headings, so that links between pages work on both.
            "toc": {
                "permalink": True,
                "slugify": {"object": "pymdownx.slugs.slugify", "kwds": {"case": "lower"}},
            },
            "pymdownx.highlight": {},
            "pymdownx.superfences": {},
        },
    }
    return "[project]\n" + "".join(
        f"{json.dumps(key)} = {_toml(value)}\n" for key, value in project.items()
    )


def _toml(value: object) -> str:
    """A value in TOML, on one line."""
    if isinstance(value, dict):
        return (
            "{"
            + ", ".join(f"{json.dumps(key)} = {_toml(each)}" for key, each in value.items())
            + "}"
        )
    return (
        "[" + ", ".join(map(_toml, value)) + "]" if isinstance(value, list) else json.dumps(value)
    )


if __name__ == "__main__":
    main(
        sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else os.environ.get("SITE_URL", DOCUMENTATION)
    )
