"""What each key of a configuration means, for editors and the table in docs/configuration.md."""

from __future__ import annotations

from typing import NamedTuple


class Setting(NamedTuple):
    """A key: what it holds, what it means, and its default. Texts are Markdown, with links relative
    to docs/.
    """

    type: str
    meaning: str
    default: str = ""


_RULES = "a list of rules: names, codes, prefixes (`MSAA2`), or `ALL`"

SETTINGS: dict[str, Setting] = {
    "extends": Setting(
        "a path",
        "another configuration of the same project, whose keys are the defaults of this one",
    ),
    "edition": Setting(
        "an edition",
        "use the default rules of this edition, so that a new release adds no findings",
        "the newest",
    ),
    "select": Setting(_RULES, "rules to use instead of the edition's"),
    "extend-select": Setting(_RULES, "rules to add; the more specific selector wins"),
    "ignore": Setting(_RULES, "rules to remove; the more specific selector wins"),
    "per-file-ignores": Setting(
        "a table from globs to lists of rules", "rules to remove for the files that a glob matches"
    ),
    "severity": Setting(
        "a table from rules to `error`, `warning`, `note`, or `off`",
        "the severities of rules",
        "the rule page's",
    ),
    "fail-on": Setting(
        "`error`, `warning`, or `note`",
        "the lowest severity that makes `check` exit with 1",
        "`warning`",
    ),
    "fail-on-cost": Setting(
        "a cost, such as `50MB/s`, `100mW`, or `16MiB`",
        "the total cost of an input's findings that makes `check` exit with 1",
    ),
    "fail-confidence": Setting(
        "`low`, `medium`, or `high`",
        "the lowest confidence of a finding that can make `check` exit with 1, by severity or by "
        "cost",
        "`medium`",
    ),
    "min-severity": Setting(
        "`error`, `warning`, or `note`", "the lowest severity to report", "`note`"
    ),
    "profile": Setting(
        "a device, a device class, a vendor, or the path of a device report",
        "the device to assume for captures and inputs that name none",
    ),
    "rules": Setting(
        "a list of paths", "pages with [custom rules](#custom-rules), or folders of them"
    ),
    "include": Setting(
        "a list of globs",
        "which files of a folder are linted",
        "[as below](#which-files-of-a-folder-are-linted)",
    ),
    "exclude": Setting("a list of globs", "files that are never linted"),
    "respect-gitignore": Setting(
        "`true` or `false`",
        "whether files of a folder that `.gitignore` ignores are skipped",
        "`true`",
    ),
    "strict-inputs": Setting(
        "`true` or `false`",
        "whether an input that creates something multisampled, but shows no pass to check, makes "
        "`check` exit with 2 (MSAA931)",
        "`false`",
    ),
    "source.assume": Setting(
        "a table from names to values",
        "values that [source code does not state](source-code.md#stating-what-the-code-does-not)",
    ),
    "output": Setting(
        "a list of output formats",
        "the formats that `check` prints, as for its `--output`",
        "`full`; `concise` in a pipe",
    ),
    "docs-url": Setting(
        "an http or https address",
        'the documentation\'s site, for links to the pages of rules; `""` for none',
        "that of the package",
    ),
    "baseline": Setting(
        "the path of a `.json` file", "the [baseline](#baseline), whose findings are hidden"
    ),
    "limits.depth": Setting(
        "an integer", "the deepest nesting of an input; a configuration can only lower it", "100"
    ),
    "limits.nodes": Setting(
        "an integer",
        "the number of values in an input; a configuration can only lower it",
        "1000000",
    ),
    "limits.bytes": Setting(
        "an integer", "the size of an input; a configuration can only lower it", "67108864"
    ),
}


def table() -> str:
    """The keys as a table in Markdown."""
    rows = [
        f"| `{key}` | {each.type} | {each.meaning} | {each.default} |".replace("|  |", "| |")
        for key, each in SETTINGS.items()
    ]
    return "\n".join(["| key | value | meaning | default |", "|---|---|---|---|", *rows])


def documentation(key: str) -> str:
    """What a key, or the first part of several keys, means; empty if there is none of that name."""
    found = {
        name: each for name, each in SETTINGS.items() if name == key or name.startswith(f"{key}.")
    }
    if key not in found:
        return "\n".join(f"- `{name}`: {each.meaning}" for name, each in found.items())
    setting = found[key]
    default = f"\n\nDefault: {setting.default}" if setting.default else ""
    return f"**{key}**: {setting.meaning}\n\nValue: {setting.type}{default}"
