"""Rule pages, configurations, baselines, suppressions and patterns of files: what a stranger's
branch says beside its frames.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from pathlib import Path

from .descriptions import FRAME, images
from .shape import Shape

CHECK = ("check", ".")
RULES = ("check", "--rules", "rules", "a.msaa.yaml")
OVER = (0, 1, 2)


def page(
    number: int = 0,
    front: str = "",
    when: str = "image.samples > 2",
    message: str = "`{image.name}`",
) -> str:
    """A rule page: its code has the number, and its front matter the keys of `front` too."""
    return (
        f"---\ncode: ACME{number:05}\nseverity: note\nsubject: image\nwhen: '{when}'\nmessage: "
        f"'{message}'\n{front}---\nText.\n"
    )


def rules(
    frames: Callable[[int], str], pages: Callable[[int], Iterable[str]]
) -> Callable[[Path, int], None]:
    """Writes a description and a folder of rule pages."""

    def write(folder: Path, size: int) -> None:
        (folder / "a.msaa.yaml").write_text(frames(size), encoding="utf-8")
        (folder / "rules").mkdir()
        for number, text in enumerate(pages(size)):
            (folder / "rules" / f"r{number}.md").write_text(text, encoding="utf-8")

    return write


def few(size: int) -> str:
    return images(4)


def named(count: int, length: int) -> str:
    """Images with long names."""
    rows = "".join(f"  ? {'n' * length}{number}\n  : {{samples: 4}}\n" for number in range(count))
    return f"{FRAME}images:\n{rows}renderPasses: {{}}\n"


def cases(size: int, when: str = "image.samples == {}") -> str:
    return "cases:\n" + "".join(
        f"  - {{when: '{when.format(number)}', message: 'm{number}'}}\n" for number in range(size)
    )


def configured(
    text: Callable[[int], str], files: Callable[[int], Iterable[str]] = lambda _: ("a.msaa.yaml",)
) -> Callable[[Path, int], None]:
    """Writes a configuration, and files with a description each."""

    def write(folder: Path, size: int) -> None:
        (folder / "msaa-lint.toml").write_text(text(size), encoding="utf-8")
        for name in files(size):
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(images(1), encoding="utf-8")

    return write


def many_files(size: int) -> Iterable[str]:
    return (f"d{number % 64}/f{number}.msaa.yaml" for number in range(size))


def patterns(
    pattern: Callable[[int], str], name: str = ".gitignore"
) -> Callable[[Path, int], None]:
    """A file of ignored patterns above files that none of them matches."""

    def write(folder: Path, size: int) -> None:
        (folder / ".git").mkdir()
        (folder / name).write_text(
            "".join(pattern(number) + "\n" for number in range(size)), encoding="utf-8"
        )
        for file in many_files(64):
            (folder / file).parent.mkdir(exist_ok=True)
            (folder / file).write_text(images(1), encoding="utf-8")

    return write


def commented(comment: Callable[[int], str]) -> Callable[[Path, int], None]:
    """A description with comments."""

    def write(folder: Path, size: int) -> None:
        (folder / "a.msaa.yaml").write_text(comment(size) + images(1), encoding="utf-8")

    return write


def accepted(entries: Callable[[int], dict[str, dict[str, int]]]) -> Callable[[Path, int], None]:
    """A description and a baseline."""

    def write(folder: Path, size: int) -> None:
        (folder / "a.msaa.yaml").write_text(images(1), encoding="utf-8")
        text = json.dumps({"schema": "msaa-lint/baseline-v1", "entries": entries(size)})
        (folder / "b.json").write_text(text, encoding="utf-8")

    return write


def folders(folder: Path, size: int) -> None:
    """Folders with a configuration each, which extend one file and name one folder of rules."""
    (folder / "shared.toml").write_text('rules = ["rules"]\n', encoding="utf-8")
    (folder / "rules").mkdir()
    (folder / "rules" / "r.md").write_text(page(), encoding="utf-8")
    (folder / "msaa-lint.toml").write_text("", encoding="utf-8")
    for number in range(size):
        (folder / f"d{number}").mkdir()
        (folder / f"d{number}" / "msaa-lint.toml").write_text(
            'extends = "../shared.toml"\n', encoding="utf-8"
        )
        (folder / f"d{number}" / "a.msaa.yaml").write_text(images(1), encoding="utf-8")


def own_rules(folder: Path, size: int) -> None:
    """Folders with a configuration and a rule page each."""
    for number in range(size):
        at = folder / f"d{number}"
        (at / "rules").mkdir(parents=True)
        (at / "rules" / "r.md").write_text(page(number), encoding="utf-8")
        (at / "msaa-lint.toml").write_text('rules = ["rules"]\n', encoding="utf-8")
        (at / "a.msaa.yaml").write_text(images(1), encoding="utf-8")


def nested(folder: Path, size: int) -> None:
    """Folders within folders with an ignore file each, 32 deep, beside each other."""
    (folder / ".git").mkdir()
    for number in range(size):
        at = folder.joinpath(f"t{number // 32}", *[f"d{depth}" for depth in range(number % 32)])
        at.mkdir(parents=True, exist_ok=True)
        (at / ".gitignore").write_text(f"x{number}\n*.tmp\n", encoding="utf-8")
        (at / "a.msaa.yaml").write_text(images(1), encoding="utf-8")


def documents(size: int) -> str:
    return "---\n".join(images(1) for _ in range(size))


ALIASED = "labels:\n  image.format: &t 'x{image.name}'\n"
NESTED_MAP = (
    "[1, 2, 3, 4, 5, 6, 7, 8].map(a, [1, 2, 3, 4, 5, 6, 7, 8].map(b, image.name + "
    "image.name)).size() > 0"
)
SLOW = 'image.name.matches("(n|nn|nnn)*(n{0,100}){0,10}q")'

SHAPES = (
    Shape(
        "rules: pages",
        rules(few, lambda size: (page(number) for number in range(size))),
        RULES,
        most=1 << 14,
    ),
    Shape(
        "rules: pages and images",
        rules(images, lambda _: (page(number) for number in range(16))),
        RULES,
    ),
    Shape(
        "rules: pages of the same code",
        rules(few, lambda size: (page() for _ in range(size))),
        RULES,
        OVER,
        1 << 14,
    ),
    Shape(
        "rules: pages with an unknown fact",
        rules(few, lambda size: (page(n, when="image.sampels > 2") for n in range(size))),
        RULES,
        OVER,
        1 << 14,
    ),
    Shape(
        "rules: undecided pages",
        rules(
            few,
            lambda size: (
                page(n, when='image.format == "R8_UNORM" && image.tiling == "LINEAR"')
                for n in range(size)
            ),
        ),
        RULES,
        most=1 << 14,
    ),
    Shape("rules: cases", rules(few, lambda size: [page(front=cases(size))]), RULES, OVER, 1 << 15),
    Shape(
        "rules: cases of unknown facts",
        rules(few, lambda size: [page(front=cases(size, "image.sampel{} == 1"))]),
        RULES,
        OVER,
        1 << 15,
    ),
    Shape(
        "rules: costly cases",
        rules(few, lambda size: [page(front=cases(size, NESTED_MAP + " && image.samples == {}"))]),
        RULES,
        OVER,
        1 << 13,
    ),
    Shape(
        "rules: placeholders",
        rules(few, lambda size: [page(message="{image.name}" * size)]),
        RULES,
        OVER,
        1 << 16,
    ),
    Shape(
        "rules: unknown placeholders",
        rules(few, lambda size: [page(message="".join(f"{{image.n{n}}}" for n in range(size)))]),
        RULES,
        OVER,
        1 << 16,
    ),
    Shape("rules: braces", rules(few, lambda size: [page(message="{" * size)]), RULES, OVER),
    Shape(
        "rules: placeholders of long names",
        rules(lambda size: named(4, size), lambda _: [page(message="{image.name}" * 100)]),
        RULES,
        OVER,
    ),
    Shape(
        "rules: maps over long names",
        rules(lambda size: named(4, size), lambda _: [page(when=NESTED_MAP)]),
        RULES,
        OVER,
    ),
    Shape(
        "rules: maps over images",
        rules(images, lambda _: [page(when=NESTED_MAP.replace(" > 0", " > 9"))]),
        RULES,
        OVER,
    ),
    Shape(
        "rules: hostile pattern",
        rules(lambda size: named(4, size), lambda _: [page(when=SLOW)]),
        RULES,
        OVER,
    ),
    Shape(
        "rules: hostile pattern over images",
        rules(lambda size: named(size, 40), lambda _: [page(when=SLOW)]),
        RULES,
        OVER,
    ),
    Shape(
        "rules: superseded rules",
        rules(
            few,
            lambda size: [
                page(front="supersedes:\n" + "".join(f"  - x{n}\n" for n in range(size)))
            ],
        ),
        RULES,
        OVER,
    ),
    Shape(
        "rules: references",
        rules(
            few,
            lambda size: [
                page(front="references:\n" + "".join(f"  - x{n}\n" for n in range(size)))
            ],
        ),
        RULES,
        OVER,
    ),
    Shape(
        "rules: unknown keys",
        rules(few, lambda size: [page(front="".join(f"mesage{n}: x\n" for n in range(size)))]),
        RULES,
        OVER,
    ),
    Shape(
        "rules: keys of a fix",
        rules(
            few,
            lambda size: [
                page(
                    front="fix:\n  title: t\n  safety: unsafe\n  add:\n    image.usage:\n"
                    + "".join(f"      - U{n}\n" for n in range(size))
                )
            ],
        ),
        RULES,
        OVER,
    ),
    Shape(
        "rules: text of a page",
        rules(few, lambda size: [page() + "word " * size]),
        RULES,
        OVER,
        1 << 18,
    ),
    Shape(
        "rules: documents of a stream",
        rules(documents, lambda _: [page(n) for n in range(8)]),
        RULES,
        most=1 << 15,
    ),
    Shape("rules: folders with a page each", own_rules, CHECK, most=1 << 13),
    Shape("configuration: folders that extend one file", folders, CHECK, most=1 << 13),
    Shape(
        "configuration: unknown keys",
        configured(lambda size: "".join(f"selec{n} = 1\n" for n in range(size))),
        CHECK,
        OVER,
        1 << 16,
    ),
    Shape(
        "configuration: unknown rules",
        configured(
            lambda size: "select = [" + ", ".join(f'"resolve-{n}"' for n in range(size)) + "]\n"
        ),
        CHECK,
        OVER,
        1 << 16,
    ),
    Shape(
        "configuration: severities",
        configured(
            lambda size: "[severity]\n" + "".join(f'MSAA{n} = "note"\n' for n in range(size))
        ),
        CHECK,
        OVER,
        1 << 16,
    ),
    Shape(
        "configuration: dotted keys",
        configured(lambda size: ".".join(["a"] * size) + " = 1\n"),
        CHECK,
        OVER,
        1 << 16,
    ),
    Shape(
        "configuration: nested lists",
        configured(lambda size: "select = " + "[" * size + "]" * size + "\n"),
        CHECK,
        OVER,
        1 << 16,
    ),
    Shape(
        "configuration: an open quote",
        configured(lambda size: 'select = """' + '\\"' * size + "\n"),
        CHECK,
        OVER,
        1 << 18,
    ),
    Shape(
        "configuration: lines",
        configured(lambda size: "select = [\n" + '"MSAA201",\n' * 900 + "# c\n" * size + "]\n"),
        CHECK,
        OVER,
        1 << 17,
    ),
    Shape(
        "globs: files that per-file-ignores compares",
        configured(
            lambda _: (
                "[per-file-ignores]\n" + "".join(f'"**/*a*b{n}*" = ["ALL"]\n' for n in range(200))
            ),
            many_files,
        ),
        CHECK,
        most=1 << 14,
    ),
    Shape(
        "globs: files that exclude compares",
        configured(
            lambda _: "exclude = [" + ", ".join(f'"**/x/**/*a*b{n}*"' for n in range(200)) + "]\n",
            many_files,
        ),
        CHECK,
        most=1 << 14,
    ),
    Shape(
        "globs: exceptions of exclude",
        configured(
            lambda _: (
                "exclude = ["
                + ", ".join(f'"{"!" * (n % 2)}**/x/**/*a*b{n}*"' for n in range(200))
                + "]\n"
            ),
            many_files,
        ),
        CHECK,
        most=1 << 14,
    ),
    Shape("globs: ignored names", patterns(lambda number: f"*a*a*x{number}"), CHECK, most=1 << 14),
    Shape(
        "globs: ignored paths", patterns(lambda number: f"a/**/*a*a*x{number}"), CHECK, most=1 << 14
    ),
    Shape(
        "globs: patterns of .ignore",
        patterns(lambda number: f"**/*[a-z]?*x{number}/", ".ignore"),
        CHECK,
        most=1 << 14,
    ),
    Shape("globs: ignore files of nested folders", nested, CHECK, most=1 << 13),
    Shape(
        "suppressions: comments",
        commented(lambda size: "".join(f"# msaa-lint: ignore[MSAA{n}]\n" for n in range(size))),
        CHECK,
    ),
    Shape(
        "suppressions: rules of a comment",
        commented(
            lambda size: f"# msaa-lint: ignore[{', '.join(['MSAA201', 'resolve-unread'] * size)}]\n"
        ),
        CHECK,
    ),
    Shape(
        "suppressions: unknown rules",
        commented(
            lambda size: f"# msaa-lint: ignore[{', '.join(f'resolve-{n}' for n in range(size))}]\n"
        ),
        CHECK,
    ),
    Shape(
        "suppressions: on one line",
        commented(lambda size: "# " + "msaa-lint: ignore[MSAA201] " * size + "\n"),
        CHECK,
    ),
    Shape(
        "suppressions: unknown words",
        commented(lambda size: "".join(f"# msaa-lint: ignroe{n}[MSAA201]\n" for n in range(size))),
        CHECK,
    ),
    Shape(
        "suppressions: open brackets",
        commented(lambda size: "# " + "msaa-lint: ignore[ " * size + "\n"),
        CHECK,
    ),
    Shape(
        "baseline: files",
        accepted(lambda size: {f"f{n}.msaa.yaml": {"resolve-then-copy": 1} for n in range(size)}),
        ("check", "--baseline", "b.json", "."),
    ),
    Shape(
        "baseline: rules of a file",
        accepted(lambda size: {"a.msaa.yaml": {f"rule-{n}": 1 for n in range(size)}}),
        ("check", "--baseline", "b.json", "."),
    ),
)
