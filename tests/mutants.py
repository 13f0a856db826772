"""Random small mistakes in the code, one at a time, and the share of them that a test notices.

`python tests/mutants.py [--count 200] [--seed 34] [--room facts]...` changes an operator, a
condition, or a number in a copy of the tree, runs the tests of its room and those of the rules
until one fails, and prints what became of each mutant, then the share that died, by room. A mutant
that runs longer than `--timeout` has died: what it changed never ends.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent

FIRST = ("tests/test_rules.py", "tests/test_examples.py")
ROOMS = {
    "facts": ("frame/facts", ("tests/frame/facts", "tests/linter", "tests/frame")),
    "cost": ("frame/cost", ("tests/frame/cost", "tests/linter", "tests/cli")),
    "fixes": ("linter/fixes", ("tests/linter", "tests/frame/metal")),
    "readers": (
        "input/readers",
        ("tests/input/readers", "tests/frame/metal", "tests/input/impeller"),
    ),
    "reports": ("cli/report", ("tests/cli/report", "tests/cli")),
}
"""By room: its folder in the package, and the tests that are asked, nearest first."""

_COMPARED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq, ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE,
    ast.GtE: ast.Gt, ast.In: ast.NotIn,
    ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is,
}  # fmt: skip
_CALCULATED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.FloorDiv, ast.FloorDiv: ast.Mult,
    ast.Div: ast.Mult, ast.BitOr: ast.BitAnd,
    ast.BitAnd: ast.BitOr, ast.Mod: ast.Add,
}  # fmt: skip


class Mutant(NamedTuple):
    """A change of one place of a module: what stands there, and what stands there instead."""

    room: str
    file: Path
    line: int
    before: str
    after: str
    text: str
    """The whole module with the change."""

    def __str__(self) -> str:
        return (
            f"{self.file.relative_to(ROOT).as_posix()}:{self.line}: `{self.before}` -> "
            f"`{self.after}`"
        )


def changed(node: ast.AST) -> ast.expr | None:
    """A node with a mistake in it, if it is one that has an operator, a condition, or a number."""
    if isinstance(node, ast.Compare) and type(node.ops[0]) in _COMPARED:
        return ast.Compare(
            node.left, [_COMPARED[type(node.ops[0])](), *node.ops[1:]], node.comparators
        )
    if isinstance(node, ast.BoolOp):
        return ast.BoolOp(ast.And() if isinstance(node.op, ast.Or) else ast.Or(), node.values)
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        return node.operand
    if (
        isinstance(node, ast.BinOp)
        and type(node.op) in _CALCULATED
        and not _is_text(node.left)
        and not _is_text(node.right)
    ):
        return ast.BinOp(node.left, _CALCULATED[type(node.op)](), node.right)
    if isinstance(node, ast.IfExp):
        return ast.IfExp(ast.UnaryOp(ast.Not(), node.test), node.body, node.orelse)
    if isinstance(node, ast.Constant) and isinstance(node.value, bool):
        return ast.Constant(not node.value)
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return ast.Constant(node.value + 1)
    return None


def _is_text(node: ast.AST) -> bool:
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str)
    )


def _nodes(tree: ast.AST) -> list[ast.AST]:
    """The nodes of a module that run: not annotations, and not what only a type checker imports."""
    found: list[ast.AST] = []
    remaining: list[ast.AST] = [tree]
    while remaining:
        node = remaining.pop()
        found.append(node)
        skipped: list[ast.AST | None] = []
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            skipped = [node.returns]
        elif isinstance(node, (ast.AnnAssign, ast.arg)):
            skipped = [node.annotation]
        elif isinstance(node, ast.JoinedStr) or (
            isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
        ):
            continue
        remaining += [child for child in ast.iter_child_nodes(node) if child not in skipped]
    return found


def mutants(room: str) -> list[Mutant]:
    """Every mutant of a room."""
    found = []
    for file in sorted((ROOT / "msaa_lint" / ROOMS[room][0]).rglob("*.py")):
        source = file.read_text(encoding="utf-8")
        starts = [0]
        for line in source.encode().splitlines(keepends=True):
            starts.append(starts[-1] + len(line))
        for node in _nodes(ast.parse(source)):
            after = changed(node)
            if after is None:
                continue
            assert (
                isinstance(node, ast.expr)
                and node.end_lineno is not None
                and node.end_col_offset is not None
            )
            begin, end = (
                starts[node.lineno - 1] + node.col_offset,
                starts[node.end_lineno - 1] + node.end_col_offset,
            )
            spelled = f"({ast.unparse(ast.fix_missing_locations(after))})"
            text = source.encode()[:begin] + spelled.encode() + source.encode()[end:]
            found.append(
                Mutant(room, file, node.lineno, ast.unparse(node), spelled[1:-1], text.decode())
            )
    return found


def fails(room: str, tree: Path, timeout: float) -> bool:
    """Whether a test of a room fails in a copy of the tree, or does not end."""
    environment = {**os.environ, "PYTHONPATH": str(tree), "PYTHONDONTWRITEBYTECODE": "1"}
    options = ["-x", "-q", "--no-header", "-p", "no:cacheprovider", "-n", "0"]
    nearest, *others = ROOMS[room][1]
    for tests in ([nearest], FIRST, others):
        command = [sys.executable, "-m", "pytest", *options, *tests]
        try:
            done = subprocess.run(
                command,
                cwd=tree,
                env=environment,
                capture_output=True,
                timeout=timeout,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return True
        if done.returncode:
            return True
    return False


def dies(mutant: Mutant, tree: Path, timeout: float) -> bool:
    """Whether a test notices a mutant, in a copy of the tree."""
    file = tree / mutant.file.relative_to(ROOT)
    original = file.read_text(encoding="utf-8")
    file.write_text(mutant.text, encoding="utf-8")
    try:
        return fails(mutant.room, tree, timeout)
    finally:
        file.write_text(original, encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=200, help="how many mutants")
    parser.add_argument("--seed", type=int, default=34)
    parser.add_argument("--room", action="append", choices=ROOMS, help="default: all")
    parser.add_argument("--timeout", type=float, default=900, help="seconds")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    every = [mutant for room in given.room or ROOMS for mutant in mutants(room)]
    chosen = random.Random(given.seed).sample(every, min(given.count, len(every)))
    died: Counter[str] = Counter()
    tried: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(given.jobs) as pool:
        trees = [Path(folder, str(number)) for number in range(given.jobs)]
        for tree in trees:
            shutil.copytree(
                ROOT,
                tree,
                ignore=shutil.ignore_patterns(".git", ".venv", ".*_cache", "__pycache__", "build"),
            )
        for room in dict.fromkeys(mutant.room for mutant in chosen):
            if fails(room, trees[0], given.timeout):
                print(f"tests of {room} fail without a mutant", file=sys.stderr)
                return 2
        free = [*trees]

        def verdict(mutant: Mutant) -> tuple[Mutant, bool]:
            tree = free.pop()
            try:
                return mutant, dies(mutant, tree, given.timeout)
            finally:
                free.append(tree)

        for mutant, dead in pool.map(verdict, chosen):
            tried[mutant.room] += 1
            died[mutant.room] += dead
            print(f"{'died' if dead else 'survived'}: {mutant}", flush=True)
    for room in tried:
        print(f"{room}: {died[room]} of {tried[room]} died")
    print(
        f"{died.total()} of {tried.total()} died ({died.total() / tried.total():.0%}), seed "
        f"{given.seed}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
