"""Lowers GLSL declarations to SPIR-V: variables, blocks, structures, constants, function
headers.
"""

from __future__ import annotations

import re

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import Code, SyntaxNode, fields, tree, without_comments
from msaa_lint.input.code.sample_counts.arithmetic import whole

from .calls import evaluate_call
from .expressions import Expressions
from .text import PreprocessedText
from .types import BOOL, FLOAT, INPUTS, INT, OUTPUTS, UINT, VOID, Type, multisampled, vector
from .values import Function, Place, Value

MAX_PARTS = 1000
"""The maximum number of types in a structure, including those of nested structures."""

_WORD = re.compile(r"\w+")
_ENTRY = re.compile(r"(\w+)(?:\s*=\s*(\w+))?")
_STORAGE = {
    "in": op.INPUT,
    "varying": op.INPUT,
    "out": op.OUTPUT,
    "uniform": op.UNIFORM_CONSTANT,
    "buffer": 12,
    "shared": 4,
}
_DECORATED = {"location": op.LOCATION, "component": op.COMPONENT, "index": op.INDEX,
"binding": op.BINDING, "set": op.DESCRIPTOR_SET,
              "input_attachment_index": op.INPUT_ATTACHMENT_INDEX}  # fmt: skip
_SAMPLE_BUILT_INS = ("gl_SampleID", "gl_SamplePosition")


class Declarations(Expressions):
    """The declarations of one shader."""

    def __init__(self, source: PreprocessedText) -> None:
        super().__init__(source.text)
        self.source = source
        self.root = tree(Code(source.text, "glsl")).root_node
        self.starts: list[tuple[Place, SyntaxNode]] = []
        """Global variables and their initializers."""
        self.images: dict[str, tuple[int, int]] = {}
        self.bindings: dict[str, tuple[int, int | None]] = {}
        self.counts: dict[int, tuple[int, int]] = {}
        """The first location of each integer value of a constant."""
        self.weights: dict[str, int] = {}
        self.outputs_without_location: list[int] = []
        self.integer_constants: dict[int, int] = {}
        """The values of integer constants by id."""

    def global_declaration(self, node: SyntaxNode, depth: int = 0) -> None:
        kind = node.type
        if kind == "function_definition":
            self.function_header(node)
        elif kind == "struct_specifier":
            self.structure(node)
        elif kind == "declaration":
            self.declaration(node)
        elif kind == "ERROR" or kind.endswith("statement"):
            raise self.unsupported(node, "is not supported")

    def structure(self, node: SyntaxNode) -> Type | None:
        name, body = fields(node, "name", "body")
        if name is None or body is None:
            return None
        members = tuple((member, kind) for member, kind, _ in self.members(body))
        written = self.text_of(name)
        self.weights[written] = 1 + sum(self.weight(kind) for _, kind in members)
        if self.weights[written] > MAX_PARTS:
            raise self.unsupported(name, "has too many parts")
        self.structs[written] = ("struct", written, members)
        return self.structs[written]

    def weight(self, kind: Type) -> int:
        """Returns the number of types in a type."""
        while kind[0] == "array":
            kind = kind[1]
        return self.weights.get(str(kind[1]), 1) if kind[0] == "struct" else 1

    def members(self, body: SyntaxNode) -> list[tuple[str, Type, set[str]]]:
        """Returns the name, type, and qualifiers of the members of a structure or block."""
        members: list[tuple[str, Type, set[str]]] = []
        for field in body.named_children:
            if field.type != "field_declaration":
                continue
            type_node = field.child_by_field_name("type")
            kind = self.kind(self.text_of(type_node))
            if type_node is None or kind is None:
                raise self.unsupported(field, "is not supported")
            words = set(_WORD.findall(self.text[field.start_byte : type_node.start_byte]))
            for declarator in field.children_by_field_name("declarator"):
                name, member_kind = self.declarator(declarator, kind)
                members.append((name, member_kind, words))
        return members

    def declarator(self, node: SyntaxNode, kind: Type) -> tuple[str, Type]:
        """Returns a declarator's name, and its type including array dimensions."""
        sizes: list[int] = []
        while node.type == "array_declarator":
            size_node, inner = fields(node, "size", "declarator")
            sizes.append(self.size(size_node) if size_node is not None else 0)
            if inner is None or len(sizes) > 4:
                raise self.unsupported(node, "is not supported")
            node = inner
        for size in sizes:
            kind = ("array", kind, size)
        return self.text_of(node), kind

    def integer(self, text: str) -> int | None:
        """Returns the value of an integer literal or constant, or None."""
        number = whole(text)
        constant = self.lookup(text) if number is None else None
        return self.integer_constants.get(constant.id) if isinstance(constant, Value) else number

    def size(self, node: SyntaxNode) -> int:
        """Returns the size of an array if it is a literal or an integer constant."""
        number = self.integer(self.text_of(node))
        if number is None or not 0 < number <= 65536:
            raise self.unsupported(node, "is not a supported array size")
        return number

    def qualifiers(self, node: SyntaxNode, end: int) -> tuple[set[str], dict[str, int | None]]:
        """Returns the qualifiers before a type: words, and the entries of `layout`."""
        layouts = [child for child in node.children if child.type == "layout_specification"]
        texts = [
            self.text_of(child)
            for child in node.children
            if child.start_byte < end and child not in layouts
        ]
        pairs = [
            pair
            for layout in layouts
            for pair in _ENTRY.findall(self.text_of(layout).partition("(")[2])
        ]
        return set(_WORD.findall(" ".join(texts))), {
            name: self.integer(value) if value else None for name, value in pairs
        }

    def declaration(self, node: SyntaxNode) -> None:
        if any(child.type == "ERROR" for child in node.children):
            raise self.unsupported(node, "is not supported")
        body = next(
            (child for child in node.named_children if child.type == "field_declaration_list"), None
        )
        type_node = node.child_by_field_name("type")
        if body is not None and type_node is None:
            self.block(node, body)
            return
        if type_node is None:
            return
        kind = (
            self.structure(type_node)
            if type_node.type == "struct_specifier"
            else self.kind(self.text_of(type_node))
        )
        words, layout = self.qualifiers(node, type_node.start_byte)
        if kind is None and self.text_of(type_node) != "precision":
            raise self.unsupported(node, "has an unknown type")
        for declarator in node.children_by_field_name("declarator"):
            if declarator.type != "function_declarator" and kind is not None:
                self.declared(declarator, kind, words, layout)

    def declared(
        self, node: SyntaxNode, kind: Type, words: set[str], layout: dict[str, int | None]
    ) -> None:
        """Declares a global variable."""
        name, kind, initializer = self.initialized(node, kind)
        if "const" in words or initializer is not None:
            self.constant(name, kind, initializer, layout, node, "const" in words)
            return
        storage = next((number for word, number in _STORAGE.items() if word in words), op.PRIVATE)
        self.scopes[0][name] = variable = self.variable(storage, kind)
        if multisampled(kind[1] if kind[0] == "array" else kind):
            layout = self.with_binding(name, layout)
            self.images[name] = (node.start_byte, node.end_byte)
        self.decorate_layout(variable.pointer, layout, storage)
        if "sample" in words and storage == op.INPUT:
            self.out.decorate(variable.pointer, op.SAMPLE)
            self.out.capabilities.add(op.SAMPLE_RATE_SHADING)

    def with_binding(self, name: str, layout: dict[str, int | None]) -> dict[str, int | None]:
        """Returns the layout of a multisampled image. Images without a binding, as in OpenGL, get a
        unique one.
        """
        if layout.get("binding") is None:
            layout = {**layout, "binding": 1000 + len(self.bindings)}
        self.bindings[name] = (layout.get("set") or 0, layout.get("binding"))
        return layout

    def initialized(self, node: SyntaxNode, kind: Type) -> tuple[str, Type, SyntaxNode | None]:
        """Returns the name and type that a declarator declares, and the initial value."""
        if node.type != "init_declarator":
            return *self.declarator(node, kind), None
        target, initializer = self.parts(node, "declarator", "value")
        if target.type == "array_declarator" and target.child_by_field_name("size") is None:
            # The number of initial values is the size of the array.
            kind = (
                "array",
                kind,
                len(without_comments(initializer.child_by_field_name("arguments") or initializer)),
            )
            target = target.child_by_field_name("declarator") or target
        return *self.declarator(target, kind), initializer

    def decorate_layout(self, target: int, layout: dict[str, int | None], storage: int) -> None:
        for name, number in _DECORATED.items():
            value = layout.get(name)
            if value is not None:
                self.out.decorate(target, number, value)
        if (
            storage == op.UNIFORM_CONSTANT
            and layout.get("binding") is not None
            and layout.get("set") is None
        ):
            self.out.decorate(target, op.DESCRIPTOR_SET, 0)
        if storage == op.OUTPUT and layout.get("location") is None:
            self.outputs_without_location.append(target)

    def constant(
        self,
        name: str,
        kind: Type,
        initializer: SyntaxNode | None,
        layout: dict[str, int | None],
        node: SyntaxNode,
        fixed: bool,
    ) -> None:
        """Declares a constant or an initialized variable."""
        if initializer is None:
            raise self.unsupported(node, "is not supported")
        special = layout.get("constant_id")
        negative = initializer.type == "unary_expression" and self.text_of(initializer)[:1] == "-"
        literal = initializer.child_by_field_name("argument") if negative else initializer
        while (
            literal is not None
            and literal.type == "parenthesized_expression"
            and literal.named_child_count == 1
        ):
            literal = literal.named_children[0]
        scalar = kind in (BOOL, INT, UINT, FLOAT)
        if (
            fixed
            and scalar
            and literal is not None
            and literal.type in ("number_literal", "true", "false")
        ):
            text = self.text_of(literal)
            number = whole(text)
            value: float | bool = text == "true"
            if kind in (INT, UINT) and number is None:
                raise self.unsupported(node, "is not supported")
            if kind != BOOL:
                value = float(number) if number is not None else self.real(literal)
                value = -value if negative else value
            constant_id = self.out.number(kind, value, special)
            self.scopes[0][name] = Value(constant_id, kind)
            if kind in (INT, UINT) and number is not None:
                self.integer_constants[constant_id] = number
                self.counts.setdefault(number, (literal.start_byte, literal.end_byte))
            return
        if special is not None:
            raise self.unsupported(node, "is not supported")
        self.scopes[0][name] = variable = self.variable(op.PRIVATE, kind)
        self.starts.append((variable, initializer))

    def block(self, node: SyntaxNode, body: SyntaxNode) -> None:
        """Declares a block of inputs, outputs, uniforms, or a buffer."""
        children = node.named_children
        at = children.index(body)
        named = (
            children[at - 1]
            if at and children[at - 1].type in ("identifier", "type_identifier")
            else None
        )
        words, layout = self.qualifiers(
            node, named.start_byte if named is not None else body.start_byte
        )
        storage = next(
            (
                _STORAGE[word]
                for word in ("in", "out", "uniform", "buffer", "shared")
                if word in words
            ),
            op.UNIFORM,
        )
        storage = (
            op.PUSH_CONSTANT
            if "push_constant" in layout
            else op.UNIFORM
            if storage == op.UNIFORM_CONSTANT
            else storage
        )
        members = self.members(body)
        label = self.text_of(named) if named is not None else f"block {node.start_byte}"
        kind: Type = (
            "struct",
            f"{label} {node.start_byte}",
            tuple((name, item) for name, item, _ in members),
        )
        instance = next(
            (
                child
                for child in children[at + 1 :]
                if child.type in ("identifier", "array_declarator")
            ),
            None,
        )
        name, whole_kind = self.declarator(instance, kind) if instance is not None else ("", kind)
        variable = self.variable(storage, whole_kind)
        if storage != op.INPUT:
            layout.pop("location", None)
        self.decorate_layout(variable.pointer, layout, storage)
        type_id = self.out.type(kind)
        for n, (member, _, qualifiers) in enumerate(members):
            if "sample" in qualifiers | words and storage == op.INPUT:
                self.out.decorate_member(type_id, n, op.SAMPLE)
                self.out.capabilities.add(op.SAMPLE_RATE_SHADING)
            if not name:
                self.scopes[0][member] = (variable, n)
        if name:
            self.scopes[0][name] = variable

    def call(self, node: SyntaxNode, depth: int) -> Value:
        return evaluate_call(self, node, depth)

    def built_in(self, name: str) -> Place | None:
        storage = op.INPUT if name in INPUTS else op.OUTPUT
        kind_and_number = INPUTS.get(name) or OUTPUTS.get(name)
        if name == "gl_FragColor":
            variable = self.variable(op.OUTPUT, vector(FLOAT, 4))
            self.out.decorate(variable.pointer, op.LOCATION, 0)
        elif kind_and_number is None:
            return None
        else:
            kind, number = kind_and_number
            variable = self.variable(storage, kind)
            self.out.decorate(variable.pointer, op.BUILT_IN, number)
            if name in _SAMPLE_BUILT_INS:
                self.out.capabilities.add(op.SAMPLE_RATE_SHADING)
        self.scopes[0][name] = variable
        return variable

    def function_header(self, node: SyntaxNode) -> None:
        declarator, type_node = fields(node, "declarator", "type")
        name = declarator.child_by_field_name("declarator") if declarator is not None else None
        list_node = declarator.child_by_field_name("parameters") if declarator is not None else None
        returns = self.kind(self.text_of(type_node))
        if name is None or list_node is None or returns is None:
            raise self.unsupported(node, "is not supported")
        parameters: list[tuple[Type, bool, str]] = []
        for child in list_node.named_children:
            parameter_type, target = fields(child, "type", "declarator")
            kind = self.kind(self.text_of(parameter_type))
            if child.type != "parameter_declaration" or parameter_type is None or kind is None:
                raise self.unsupported(child, "is not supported")
            if kind == VOID:
                continue
            words = set(_WORD.findall(self.text[child.start_byte : parameter_type.start_byte]))
            name_text, kind = self.declarator(target, kind) if target is not None else ("", kind)
            parameters.append((kind, bool(words & {"out", "inout"}), name_text))
        function = Function(node, returns, tuple(parameters), self.out.id())
        self.add_function(self.text_of(name), function)
