"""C and C++ syntax trees to terms.

What no rule asks for stays UNPARSED, and what the parser could not make sense of is passed over: macros break the grammar in most real
files, and hardly ever where a structure is filled in.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from msaa_lint.input.code.parsing import Code, SyntaxNode, span

from .directives import Section
from .kinds import CLASSES, DEEPEST, function_declarator, without_comments
from .statements import Statements
from .terms import ASSIGN, CALL, DO, NAME, Function, Parameter, Term, Unit

RELEVANT = re.compile(
    r"[sS]ample|SAMPLE|[aA]ttachment|ATTACHMENT|[mM]saa|MSAA|[rR]esolve|RESOLVE|[fF]ramebuffer|[rR]enderPass|CreateImage|createImage|ImageCreateInfo|TRANSIENT|ImageView"
)
"""A function without any of these says nothing of multisampling, unless it calls one that does."""

VIRTUAL = re.compile(r"\b(?:virtual|override)\b")

CONTAINERS = frozenset({
    "translation_unit", "namespace_definition", "declaration_list", "linkage_specification", "template_declaration", "preproc_if",
    "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef", "ERROR", "export_declaration",
})  # fmt: skip


def unit(code: Code, root: SyntaxNode, sections: tuple[Section, ...] = ()) -> Unit:
    """The functions of a file, what its classes declare, and what stands outside. `sections` are parts of lists that are there only
    under conditions."""
    return _Reading(code.text, code.fragments, sections).unit(root)


class _Reading(Statements):
    """One file while it is read."""

    def __init__(self, text: str, fragments: bool, sections: tuple[Section, ...]) -> None:
        self.text = text
        self.sections = sections
        self.fragments = fragments
        self.found: list[tuple[str, str, SyntaxNode]] = []
        """Functions: the namespace and the class that they are in, and where."""
        self.members: dict[str, list[Term]] = {}
        self.prototypes: dict[str, tuple[Parameter, ...]] = {}
        """By name, the parameters of functions that are declared."""
        self.outside: list[Term] = []
        self.current = ""
        self.public: set[int] = set()
        """Where members are declared that are public."""
        self.virtual: set[str] = set()
        """The names of methods that a derived class may have others of."""
        self.aliases: dict[str, str] = {}
        self.called_names: set[str] = set()
        """The names of functions that another function calls."""

    def unit(self, root: SyntaxNode) -> Unit:
        self.outer(root)
        functions = [self.function(node, space, within) for space, within, node in self.relevant()]
        members = {name: tuple(terms) for name, terms in self.members.items()}
        return Unit(
            tuple(f for f in functions if f is not None), members, tuple(self.outside), self.prototypes, frozenset(self.called_names)
        )

    def outer(self, root: SyntaxNode) -> None:
        """Goes through what holds functions: namespaces, classes, blocks of the preprocessor."""
        stack: list[tuple[str, str, SyntaxNode, int]] = [("", "", root, 0)]
        while stack:
            space, within, node, depth = stack.pop()
            kind = node.type
            if kind in CONTAINERS or kind == "field_declaration_list":
                if kind == "namespace_definition":
                    name = node.child_by_field_name("name")
                    space = f"{space}{self.of(name)}::" if name is not None else space
                if kind == "field_declaration_list":
                    self.accesses(node)
                if depth < DEEPEST:
                    stack += [(space, within, child, depth + 1) for child in reversed(node.named_children)]
            elif kind in CLASSES:
                name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
                if body is not None:
                    stack.append((space, f"{space}{self.of(name)}" if name is not None else within, body, depth + 1))
            elif kind == "function_definition":
                if node.child_by_field_name("body") is not None:
                    self.found.append((space, within, node))
            elif kind == "field_declaration":
                self.class_in(node, stack, space, within, depth)
                if within:
                    terms = self.declared(node)
                    if node.start_byte in self.public:
                        # Anybody may change it: what it begins with says nothing.
                        terms = [term if term[5] else (*term[:3], None, *term[4:]) for term in terms]
                    self.members.setdefault(within, []).extend(terms)
                    self.prototype(node)
                    self.virtuals(node)
            elif kind == "declaration":
                self.class_in(node, stack, space, within, depth)
                self.outside += [(*term[:2], space + term[2], *term[3:]) for term in self.declared(node)]
                self.prototype(node)
            elif kind == "preproc_def":
                parent = node.parent
                name_node = parent.child_by_field_name("name") if parent is not None and parent.type == "preproc_ifdef" else None
                macro = node.child_by_field_name("name")
                if name_node is not None and macro is not None and self.of(name_node) == self.of(macro):
                    # The build may say otherwise.
                    continue
                self.outside += self.defined(node)
            elif kind == "type_definition":
                self.class_in(node, stack, space, within, depth)
                self.typedef(node)
            elif kind in ("namespace_alias_definition", "alias_declaration"):
                self.alias(node)
            elif kind == "enum_specifier":
                self.outside += [(*term[:2], space + term[2], *term[3:]) for term in self.enumerated(node)]
            elif self.fragments:
                # A page shows statements without the function that they are of.
                self.outside += self.statement(node, 0)

    @staticmethod
    def class_in(node: SyntaxNode, stack: list[tuple[str, str, SyntaxNode, int]], space: str, within: str, depth: int) -> None:
        kind = node.child_by_field_name("type")
        if kind is not None and (kind.type in CLASSES or kind.type == "enum_specifier"):
            stack.append((space, within, kind, depth + 1))

    def relevant(self) -> list[tuple[str, str, SyntaxNode]]:
        """The functions that matter: those that say something of multisampling, and those that call them, over and over."""
        texts = [self.of(node) for _, _, node in self.found]
        relevant = [RELEVANT.search(text) is not None for text in texts]
        fresh = relevant
        for _ in range(4):
            names = {self.called(self.found[n][2]) for n, new in enumerate(fresh) if new} - {""}
            if not names or all(relevant):
                break
            calls = re.compile(r"\b(?:" + "|".join(map(re.escape, sorted(names))) + r")\s*\(")
            fresh = [not old and calls.search(text) is not None for old, text in zip(relevant, texts, strict=True)]
            relevant = [old or new for old, new in zip(relevant, fresh, strict=True)]
        return [item for item, matters in zip(self.found, relevant, strict=True) if matters]

    def accesses(self, node: SyntaxNode) -> None:
        """Notes which members of a class are public."""
        parent = node.parent
        public = parent is not None and parent.type != "class_specifier"
        for child in node.named_children:
            if child.type == "access_specifier":
                public = self.of(child).startswith("public")
            elif public:
                self.public.add(child.start_byte)

    def virtuals(self, node: SyntaxNode) -> None:
        if VIRTUAL.search(self.of(node)):
            declarator = function_declarator(node.child_by_field_name("declarator"))
            name = declarator.child_by_field_name("declarator") if declarator is not None else None
            if name is not None:
                self.virtual.add(self.of(name))

    def alias(self, node: SyntaxNode) -> None:
        name = node.child_by_field_name("name")
        stands = node.child_by_field_name("type") or (node.named_children[-1] if node.named_child_count > 1 else None)
        if name is not None and stands is not None and stands.end_byte - stands.start_byte < 100 and len(self.aliases) < 200:
            text = self.type_text(stands)
            if text.startswith(("vk", "Vk", "VULKAN")):
                self.aliases[self.of(name)] = text

    def typedef(self, node: SyntaxNode) -> None:
        stands, name = node.child_by_field_name("type"), node.child_by_field_name("declarator")
        if stands is not None and name is not None and name.type == "type_identifier" and stands.type == "type_identifier":
            text = self.of(stands)
            if text.startswith(("vk", "Vk")) and len(self.aliases) < 200:
                self.aliases[self.of(name)] = text

    def prototype(self, node: SyntaxNode) -> None:
        declarator = function_declarator(node.child_by_field_name("declarator"))
        name = declarator.child_by_field_name("declarator") if declarator is not None else None
        if declarator is not None and name is not None:
            parameters = self.parameters(declarator.child_by_field_name("parameters"))
            self.prototypes.setdefault(self.of(name).rpartition("::")[2], parameters)

    def called(self, node: SyntaxNode) -> str:
        declarator = function_declarator(node.child_by_field_name("declarator"))
        name = declarator.child_by_field_name("declarator") if declarator is not None else None
        return self.of(name).rpartition("::")[2].strip() if name is not None else ""

    def function(self, node: SyntaxNode, space: str, within: str) -> Function | None:
        declarator = function_declarator(node.child_by_field_name("declarator"))
        name = declarator.child_by_field_name("declarator") if declarator is not None else None
        body = node.child_by_field_name("body")
        if declarator is None or name is None or body is None:
            return None
        scope, _, short = self.type_text(name).rpartition("::")
        returns = node.child_by_field_name("type")
        kind = self.type_text(returns) if returns is not None else ""
        if kind in ("auto", ""):
            trailing = next((c for c in declarator.named_children if c.type == "trailing_return_type"), None)
            kind = self.type_text(trailing).removeprefix("->") if trailing is not None else kind
        list_node = declarator.child_by_field_name("parameters")
        owner = within or (space + scope if scope else "")
        self.current = short
        statements = tuple(self.initialised(node)) + tuple(self.block(body, 0))
        at = span(name)
        parameters = self.parameters(list_node)
        declared = self.prototypes.get(short, ())
        if len(declared) == len(parameters):
            parameters = tuple(
                item._replace(default=item.default or entry.default) for item, entry in zip(parameters, declared, strict=True)
            )
        head = self.text[node.start_byte : body.start_byte]
        overridden = VIRTUAL.search(head) is not None or short in self.virtual
        return Function(short, owner, kind, parameters, statements, at, space, overridden)

    def initialised(self, node: SyntaxNode) -> Iterator[Term]:
        """What a constructor gives its members before its body."""
        match = next((c for c in node.named_children if c.type == "field_initializer_list"), None)
        for child in match.named_children if match is not None else ():
            if child.type == "field_initializer" and child.named_child_count == 2:
                name, value = child.named_children
                items = [self.expression(c, 0) for c in without_comments(value)]
                at = span(name)
                term = items[0] if len(items) == 1 else (CALL, (NAME, "", at), tuple(items), at)
                yield (DO, (ASSIGN, "=", (NAME, self.of(name), at), term, at), at)
