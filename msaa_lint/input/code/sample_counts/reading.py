"""Reads how the functions of a C or C++ file choose their sample count, statement by statement.

See `choices` for what is tracked.
"""

import re
from typing import NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.parsing import SyntaxNode, fields, function_declarator, span, without_comments

from .chains import MAX_TESTS, Chain, Test, greatest
from .loops import halving_loop, loop_iterations
from .masks import COUNTS, Bindings, Expressions, Highest, Mask, Value, combine
from .statements import links, statements, unwrapped

MAX_DEPTH = 40
"""The maximum nesting of blocks."""

RETURN = ""
"""The target of a chain that returns its count; other targets are variables."""

_MASK_TYPE = re.compile(r"SampleCountFlags\b")
_SPELLED = re.compile(r"SAMPLE_COUNT_\d|SampleCountFlagBits|\be(?:2|4|8|16|32|64)\b")


class Owner(NamedTuple):
    """The function or lambda that contains statements: its name, the location of the name, and its return type. Empty for global code."""

    name: str
    at: Span | None
    returns: str


class Choice(NamedTuple):
    """A choice: its name and location, the mask, the tests, and the highest count that it selects if known."""

    name: str
    at: Span
    mask: Mask
    tests: tuple[Test, ...]
    at_most: int | None


class ChoiceReader:
    """Reads the functions of a file."""

    def __init__(self, text: str) -> None:
        self.expressions = Expressions(text)
        self.choices: list[Choice] = []
        self.combined: dict[Span, tuple[str, Mask]] = {}
        """Masks that are combined incorrectly, by the location of the operator: the name of the target, and the mask."""

    def function(self, node: SyntaxNode) -> None:
        """Reads a function definition."""
        declarator, name = function_declarator(node)
        body = node.child_by_field_name("body")
        if declarator is None or name is None or body is None:
            return
        owner = Owner(self.expressions.name(name), span(name), self.expressions.text_of(node.child_by_field_name("type")))
        self.block(body, self.parameters(declarator), owner, 0)

    def parameters(self, declarator: SyntaxNode | None) -> Bindings:
        """Returns the parameters; those whose type is a mask are unknown masks."""
        bindings: Bindings = {}
        list_node = declarator.child_by_field_name("parameters") if declarator is not None else None
        for child in list_node.named_children if list_node is not None else ():
            kind, name = fields(child, "type", "declarator")
            if kind is not None and name is not None and name.type == "identifier":
                mask = _MASK_TYPE.search(self.expressions.text_of(kind)) is not None
                bindings[self.expressions.text_of(name)] = Mask((), "NONE", span(name), known=False) if mask else None
        return bindings

    def block(self, node: SyntaxNode, bindings: Bindings, owner: Owner, depth: int) -> None:
        """Reads a sequence of statements."""
        chains: dict[str, Chain] = {}
        if depth < MAX_DEPTH:
            for child in statements(node):
                self.statement(child, bindings, owner, chains, depth + 1)
        for target, chain in chains.items():
            self.finish(target, chain, owner)

    def statement(self, node: SyntaxNode, bindings: Bindings, owner: Owner, chains: dict[str, Chain], depth: int) -> None:
        kind = node.type
        if kind == "if_statement":
            self.branches(node, bindings, owner, chains, depth)
        elif kind in ("for_statement", "for_range_loop", "while_statement"):
            body = node.child_by_field_name("body")
            if not self.loop(node, bindings, chains) and body is not None:
                self.block(body, dict(bindings), owner, depth)
        elif kind in ("compound_statement", "switch_statement", "try_statement", "do_statement", "else_clause", "labeled_statement"):
            inner = node if kind in ("compound_statement", "else_clause") else node.child_by_field_name("body")
            if inner is not None and kind != "switch_statement":
                self.block(inner, bindings, owner, depth)
        elif kind in ("declaration", "expression_statement", "return_statement", "field_declaration", "init_declarator"):
            self.plain(node, bindings, owner, chains)
            self.lambdas(node, bindings, owner, depth)

    def plain(self, node: SyntaxNode, bindings: Bindings, owner: Owner, chains: dict[str, Chain]) -> None:
        """Reads a declaration, an assignment, or a return."""
        of = self.expressions.text_of
        if node.type == "return_statement":
            self.assign(RETURN, next(iter(without_comments(node)), None), owner.returns, bindings, owner, chains)
        elif node.type == "expression_statement":
            child = node.named_children[0] if node.named_child_count else None
            if child is not None and child.type == "assignment_expression":
                target, sign, source = fields(child, "left", "operator", "right")
                name = self.expressions.name(target)
                if of(sign) == "&=" and name:
                    before = bindings.get(name, self.expressions.members.get(name))
                    bindings[name] = _apply_mask(before, self.expressions.value(source, bindings), span(sign or child))
                elif of(sign) == "=":
                    self.assign(name, source, "", bindings, owner, chains)
        else:
            kind = of(node.child_by_field_name("type"))
            for child in node.children_by_field_name("declarator"):
                target, source = fields(child, "declarator", "value")
                target = target if child.type == "init_declarator" else child
                while target is not None and target.type.endswith("_declarator"):
                    inner = target.child_by_field_name("declarator")
                    target = inner if inner is not None else next(iter(target.named_children), None)
                name = self.expressions.name(target)
                if name and source is not None:
                    bindings[name] = None
                    self.assign(name, source, kind, bindings, owner, chains)
                elif name:
                    bindings[name] = Mask((), "NONE", span(child), known=False) if _MASK_TYPE.search(kind) else None

    def assign(self, target: str, node: SyntaxNode | None, typed: str, bindings: Bindings, owner: Owner, chains: dict[str, Chain]) -> None:
        """Assigns the value of an expression to a variable, or returns it."""
        value = self.expressions.value(node, bindings)
        if value is None and node is not None and _MASK_TYPE.search(typed) and target:
            value = Mask((), "NONE", span(node), known=False)
        if isinstance(value, Mask):
            logical = value.combined.startswith("LOGICAL") and not re.search(r"SampleCount|int|VkFlags", typed)
            if value.combined not in ("NONE", "AND", "OR") and not logical:
                self.combined.setdefault(value.at, (target or owner.name, value))
        if isinstance(value, Highest) and value.form == "COUNT":
            at = owner.at if target == RETURN and owner.at is not None else span(node) if node is not None else value.mask.at
            # The highest count of a mask from elsewhere, such as a setting, is not the device's highest.
            most = 1 << (value.mask.allowed.bit_length() - 1) if value.mask.allowed and value.mask.limits and value.mask.known else None
            self.choices.append(Choice(target or owner.name, at, value.mask, (), most))
        elif target == RETURN and owner.name:
            returns = self.expressions.returns
            returns[owner.name] = value if isinstance(value, Mask) and returns.get(owner.name, value) == value else None
        elif target:
            if target not in bindings:
                members = self.expressions.members
                members[target] = value if members.get(target, value) == value else None
            bindings[target] = value
        self.conditional(target, node, bindings, chains)

    def conditional(self, target: str, node: SyntaxNode | None, bindings: Bindings, chains: dict[str, Chain]) -> None:
        """Reads a chain of conditional expressions."""
        tests: list[Test] = []
        for _ in range(MAX_TESTS):
            node = unwrapped(node)
            if node is None or node.type != "conditional_expression":
                break
            test, then = fields(node, "condition", "consequence")
            mask, count = self.expressions.value(test, bindings), self.expressions.value(then, bindings)
            if test is None or not isinstance(mask, Mask) or mask.bit is None or not isinstance(count, int) or count not in COUNTS:
                break
            tests.append(Test(mask, mask.bit, count, span(test), 0, True, self.spells_count(node)))
            node = node.child_by_field_name("alternative")
        if tests and (node is None or node.type != "conditional_expression"):
            chain = chains.setdefault(target, Chain())
            chain.groups += 1
            chain.tests += tests

    def lambdas(self, node: SyntaxNode, bindings: Bindings, owner: Owner, depth: int) -> None:
        """Reads the lambdas in an expression."""
        stack = [node]
        while stack:
            expression = stack.pop()
            if expression.type != "lambda_expression":
                stack += expression.named_children
                continue
            body, declarator = fields(expression, "body", "declarator")
            declared = expression.parent.child_by_field_name("declarator") if expression.parent is not None else None
            if body is not None and depth < MAX_DEPTH:
                at = span(declared) if declared is not None else None
                inner = Owner(self.expressions.name(declared), at, self.expressions.text_of(declarator))
                self.block(body, {**bindings, **self.parameters(declarator)}, inner, depth + 1)

    def branches(self, node: SyntaxNode, bindings: Bindings, owner: Owner, chains: dict[str, Chain], depth: int) -> None:
        """Reads an `if` chain: its tests and its blocks."""
        self.read_tests(node, bindings, chains)
        for condition, then in links(node):
            if condition is None or then.type != "else_clause":
                self.comparison(condition, then, node, bindings, owner)
            self.block(then, bindings, owner, depth)

    def comparison(self, condition: SyntaxNode | None, then: SyntaxNode, node: SyntaxNode, bindings: Bindings, owner: Owner) -> None:
        """Reads `if (a < b) counts = a; else counts = b;` and the same with returns."""
        compared = self.expressions.comparison(condition, bindings)
        if compared is None:
            return
        first = self.assignment_of(then)
        second = self.assignment_of(node.child_by_field_name("alternative") or node.next_named_sibling)
        if first is None or second is None or first[0] != second[0]:
            return
        lesser = self.expressions.minimum(compared, self.expressions.value(first[1], bindings), self.expressions.value(second[1], bindings))
        if lesser is not None:
            self.combined.setdefault(lesser.at, (first[0] or owner.name, lesser))

    def assignment_of(self, node: SyntaxNode | None) -> "tuple[str, SyntaxNode] | None":
        """Returns the target and the value that a branch assigns or returns."""
        for child in statements(node) if node is not None else ():
            if child.type == "return_statement" and child.named_child_count:
                return RETURN, child.named_children[0]
            inner = child.named_children[0] if child.type == "expression_statement" and child.named_child_count else None
            value = inner.child_by_field_name("right") if inner is not None and inner.type == "assignment_expression" else None
            if inner is not None and value is not None and _is_plain_assignment(inner, self.expressions):
                return self.expressions.name(inner.child_by_field_name("left")), value
        return None

    def spells_count(self, node: SyntaxNode) -> bool:
        return _SPELLED.search(self.expressions.text_of(node)[:4000]) is not None

    def read_tests(self, node: SyntaxNode, bindings: Bindings, chains: dict[str, Chain], spelled: bool | None = None) -> bool:
        """Reads the tests of an `if`. Returns whether it selects a count. `spelled` is whether a loop around it names a count."""
        gave = False
        touched: set[str] = set()
        for condition, then in links(node):
            assignment = self.assignment_of(then)
            if condition is None or assignment is None:
                continue
            target, expression = assignment
            count, mask = self.expressions.value(expression, bindings), self.expressions.value(condition, bindings)
            if not isinstance(count, int) or count not in COUNTS:
                if isinstance(mask, Mask) and mask.bit is not None and target in chains:
                    chains[target].pure = False
                continue
            chain = chains.setdefault(target, Chain())
            gave = True
            if isinstance(mask, Mask) and mask.bit is not None and len(chain.tests) < MAX_TESTS:
                if target not in touched:
                    chain.groups += 1
                touched.add(target)
                leaves = target == RETURN or any(c.type in ("break_statement", "return_statement") for c in statements(then))
                at = span(unwrapped(condition) or condition)
                chain.tests.append(
                    Test(mask, mask.bit, count, at, chain.groups, leaves, self.spells_count(then) if spelled is None else spelled)
                )
            elif count > 1:
                chain.pure = False
        return gave

    def loop(self, node: SyntaxNode, bindings: Bindings, chains: dict[str, Chain]) -> bool:
        """Reads a loop over known counts. Returns whether it is one."""
        is_loop = False
        waited = halving_loop(node, self.expressions, bindings)
        if waited is not None:
            name, tests = waited
            chain = chains.setdefault(name, Chain())
            chain.groups += 1
            chain.tests += [Test(mask, mask.bit or 1, count, at, chain.groups, True, True) for mask, count, at in tests]
            return True
        body = node.child_by_field_name("body")
        spelled = self.spells_count(node)
        for inner in loop_iterations(node, self.expressions, bindings):
            for child in statements(body) if body is not None else ():
                is_loop |= child.type == "if_statement" and self.read_tests(child, inner, chains, spelled)
        return is_loop

    def finish(self, target: str, chain: Chain, owner: Owner) -> None:
        """Adds the choice of a chain at the end of its block."""
        tests = chain.ordered()
        mask = tests[0].mask if tests else None
        if mask is None or not (mask.known or all(test.spelled for test in tests)):
            return
        if len({(tuple(name for name, _ in test.mask.limits), test.mask.combined) for test in tests}) > 1:
            # The variable was assigned another mask in between.
            return
        at = owner.at if target == RETURN and owner.at is not None else tests[0].at
        # The maximum of a mask from elsewhere is the device's maximum only if the mask is the device's.
        most = greatest(tests) if chain.pure and mask.limits else None
        self.choices.append(Choice(target or owner.name or "samples", at, mask, tuple(tests), most))


def _apply_mask(value: Value | None, other: Value | None, at: Span) -> Value | None:
    """Returns the result of `&=` on a mask."""
    if isinstance(value, Mask) and isinstance(other, Mask):
        return combine((value, other), "AND", at)
    return value._replace(allowed=value.allowed & other) if isinstance(value, Mask) and isinstance(other, int) else None


def _is_plain_assignment(node: SyntaxNode, expressions: Expressions) -> bool:
    """Returns whether an assignment uses `=`."""
    sign = node.child_by_field_name("operator")
    return sign is None or expressions.text_of(sign) == "="
