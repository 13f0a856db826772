"""Lowers GLSL shaders to SPIR-V: declarations, functions, statements. The module can then be
analyzed by `frame.spirv`.

Shaders are read as glslang reads them without options. Anything unsupported raises; nothing is
reported for such a shader.
"""

import re
from typing import NamedTuple

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import SyntaxNode, ascii_only, fields, without_comments

from .declarations import Declarations
from .text import PreprocessedText, ShaderLimitExceeded, UnsupportedShader, preprocess
from .types import BOOL, VOID, Type, is_image, multisampled, size_of
from .values import Function, Place, Value

MAX_DEPTH = 60
"""The maximum nesting of blocks."""

_WORD = re.compile(r"\w+")
_MODES = {
    "pixel_interlock_ordered": 5366, "pixel_interlock_unordered": 5367,
    "sample_interlock_ordered": 5368, "sample_interlock_unordered": 5369,
}  # fmt: skip
_FRAGMENT, _COMPUTE = 4, 5


class Fetch(NamedTuple):
    """A sample fetch: the name of the image, and the range of the call in the original text."""

    image: str
    start: int
    end: int


class Shader(NamedTuple):
    """A shader: its module, its stage, the name of its entry point, and its sample fetches.

    `images` are the locations of its multisampled images, `bindings` their descriptor sets and
    bindings, `constants` the locations of constants by value.
    """

    code: bytes
    stage: str
    entry: str
    fetches: tuple[Fetch, ...]
    images: dict[str, tuple[int, int]]
    bindings: dict[str, tuple[int, int | None]]
    constants: dict[int, tuple[int, int]]


def shader(text: str, part: bool = False) -> Shader:
    """Lowers a shader. `part` allows a shader without `main`; its entry point is then the function
    that fetches samples.

    Raises UnsupportedShader if the shader cannot be lowered, and `parsing.Missing` if the extra is
    not installed.
    """
    return _ShaderLowering(preprocess(ascii_only(text))).shader(part)


class _ShaderLowering(Declarations):
    """Lowers one shader."""

    def __init__(self, source: PreprocessedText) -> None:
        super().__init__(source)
        self.jump_targets: list[tuple[int, int]] = []
        """The targets of `break` and `continue` in the enclosing loops and switches."""
        self.returns: Type = VOID

    def shader(self, part: bool) -> Shader:
        for node in self.root.named_children:
            self.global_declaration(node)
        entry = self.functions.get("main", [None])[0]
        name = "main"
        if entry is None or entry.node.child_by_field_name("body") is None:
            entry = None
        if entry is None and not part:
            raise UnsupportedShader("the shader has no function `main`")
        main = self.out.id()
        self.out.begin()
        for place, node in self.starts:
            value = self.value(node)
            self.store(place, self.as_type(value, place.type) if size_of(place.type) else value)
        if entry is not None:
            self.add_called(entry)
            self.out.emit(op.FUNCTION_CALL, self.out.type(VOID), self.out.id(), entry.id)
        else:
            name = self.call_uncalled_functions()
        self.out.emit(op.RETURN)
        self.out.end(main, VOID, ())
        position = 0
        while position < len(self.called_functions):
            self.function(self.called_functions[position])
            position += 1
        if len(self.outputs_without_location) > 1:
            raise UnsupportedShader("several outputs have no location")
        for output in self.outputs_without_location:
            self.out.decorate(output, op.LOCATION, 0)
        for layout in self.source.layouts:
            self.out.modes += (_MODES[word] for word in _WORD.findall(layout) if word in _MODES)
        at = self.source.place
        fetches = tuple(
            Fetch(image, at(start), at(end - 1) + 1) for image, start, end in self.fetches
        )
        compute = any("local_size_x" in layout for layout in self.source.layouts)
        code = self.out.module(_COMPUTE if compute else _FRAGMENT, main)
        images = {
            image: (at(start), at(end - 1) + 1) for image, (start, end) in self.images.items()
        }
        constants = {
            count: (at(start), at(end - 1) + 1) for count, (start, end) in self.counts.items()
        }
        return Shader(
            code,
            "COMPUTE" if compute else "FRAGMENT",
            name,
            fetches,
            images,
            self.bindings,
            constants,
        )

    def call_uncalled_functions(self) -> str:
        """Calls the uncalled functions of a shader without `main`, passing images and values of
        their own.

        Returns the name of the first.
        """
        texts = {
            name: self.text_of(entry.node)
            for name, item in self.functions.items()
            for entry in item
        }
        first_name = ""
        for name, functions in self.functions.items():
            function = functions[0]
            if (
                not any(multisampled(kind) for kind, _, _ in function.parameters)
                and "texelFetch" not in texts[name]
            ):
                continue
            if any(
                re.search(rf"\b{name}\s*\(", text) for other, text in texts.items() if other != name
            ):
                continue
            passed: list[int] = []
            for kind, written, parameter in function.parameters:
                storage = (
                    op.UNIFORM_CONSTANT
                    if kind[0] == "opaque"
                    else op.FUNCTION_LOCAL
                    if written
                    else op.INPUT
                )
                variable = self.variable(storage, kind)
                if multisampled(kind):
                    self.decorate_layout(
                        variable.pointer, self.with_binding(parameter, {}), storage
                    )
                    self.images.setdefault(
                        parameter, (function.node.start_byte, function.node.start_byte)
                    )
                passed.append(
                    variable.pointer if written or kind[0] == "opaque" else self.load(variable).id
                )
            self.add_called(function)
            result = self.out.instruction(op.FUNCTION_CALL, function.returns, function.id, *passed)
            if function.returns != VOID:
                output = self.variable(op.OUTPUT, function.returns)
                self.store(output, Value(result, function.returns))
            first_name = first_name or name
        if not first_name:
            raise UnsupportedShader("the shader fetches no samples")
        return first_name

    def function(self, function: Function) -> None:
        body = function.node.child_by_field_name("body")
        if body is None:
            raise self.unsupported(function.node, "has no body")
        self.out.begin()
        self.returns, self.ended, self.jump_targets = function.returns, False, []
        passed: list[tuple[int, int]] = []
        self.scopes.append({})
        for kind, written, name in function.parameters:
            parameter_id = self.out.id()
            image = is_image(kind)
            if image or written:
                storage = op.UNIFORM_CONSTANT if image else op.FUNCTION_LOCAL
                passed.append((self.out.pointer(storage, kind), parameter_id))
                self.scopes[-1][name] = Place(parameter_id, kind, storage)
                continue
            passed.append((self.out.type(kind), parameter_id))
            copy = self.temporary(kind)
            self.out.emit(op.STORE, copy.pointer, parameter_id)
            self.scopes[-1][name] = copy
        self.statements(body, 0)
        self.scopes.pop()
        if not self.ended:
            self.out.emit(op.RETURN if function.returns == VOID else op.UNREACHABLE)
        self.out.end(function.id, function.returns, passed)

    def ensure_block(self) -> None:
        """Starts an unreachable block if the current one has ended."""
        if self.ended:
            self.out.emit(op.LABEL, self.out.id())
            self.ended = False

    def statements(self, node: SyntaxNode, depth: int) -> None:
        if depth > MAX_DEPTH:
            raise ShaderLimitExceeded(
                f"the blocks of the shader nest more than {MAX_DEPTH} levels deep"
            )
        if node.type == "compound_statement":
            self.scopes.append({})
            for child in node.named_children:
                self.statement(child, depth + 1)
            self.scopes.pop()
        else:
            self.statement(node, depth + 1)

    def statement(self, node: SyntaxNode, depth: int) -> None:
        kind = node.type
        if kind in ("comment", ";"):
            return
        self.ensure_block()
        if kind == "compound_statement":
            self.statements(node, depth)
        elif kind == "declaration":
            self.local(node)
        elif kind == "expression_statement":
            self.expression(node)
        elif kind == "return_statement":
            returned = next(iter(without_comments(node)), None)
            if returned is None:
                self.terminate(op.RETURN)
            else:
                value = self.value(returned)
                value = self.as_type(value, self.returns) if size_of(self.returns) else value
                self.terminate(op.RETURN_VALUE, value.id)
        elif kind == "if_statement":
            self.conditional(node, depth)
        elif kind in ("for_statement", "while_statement", "do_statement"):
            self.loop(node, depth)
        elif kind == "switch_statement":
            self.switch(node, depth)
        elif kind in ("break_statement", "continue_statement"):
            ways = [
                way[kind == "continue_statement"]
                for way in self.jump_targets
                if way[kind == "continue_statement"]
            ]
            if not ways:
                raise self.unsupported(node, "is not supported")
            self.terminate(op.BRANCH, ways[-1])
        else:
            raise self.unsupported(node, "is not supported")

    def expression(self, node: SyntaxNode) -> None:
        child = next(iter(without_comments(node)), None)
        if child is None:
            return
        if child.type == "identifier" and self.text_of(child) in ("discard", "terminateInvocation"):
            self.terminate(op.KILL)
        elif child.type == "identifier" and self.text_of(child) == "demote":
            self.out.emit(op.DEMOTE)
        else:
            self.value(child)

    def local(self, node: SyntaxNode) -> None:
        """Declares the variables of a function."""
        kind = self.kind(self.text_of(node.child_by_field_name("type")))
        if kind is None or kind[0] == "opaque":
            raise self.unsupported(node, "has an unknown type")
        for declarator in node.children_by_field_name("declarator"):
            name, declared_kind, initializer = self.initialized(declarator, kind)
            value = (
                self.value(initializer)
                if initializer is not None and initializer.type != "initializer_list"
                else None
            )
            place = self.temporary(declared_kind)
            self.scopes[-1][name] = place
            if value is not None:
                self.store(
                    place, self.as_type(value, declared_kind) if size_of(declared_kind) else value
                )
            elif initializer is not None:
                raise self.unsupported(initializer, "is not supported")

    def condition_id(self, node: SyntaxNode | None) -> int:
        if node is None:
            return self.out.number(BOOL, True)
        value = self.value(node)
        if value.type != BOOL:
            raise self.unsupported(node, "is not a condition")
        return value.id

    def conditional(self, node: SyntaxNode, depth: int) -> None:
        condition, then, other = fields(node, "condition", "consequence", "alternative")
        inner = next(iter(without_comments(other)), None) if other is not None else None

        def consequence() -> None:
            if then is not None:
                self.statements(then, depth)

        def alternative() -> None:
            if other is not None and inner is not None:
                self.statements(inner if other.type == "else_clause" else other, depth)

        self.branch(
            self.condition_id(condition), consequence, alternative if other is not None else None
        )

    def loop(self, node: SyntaxNode, depth: int) -> None:
        out = self.out
        self.scopes.append({})
        first = node.child_by_field_name("initializer")
        if first is not None:
            if first.type == "declaration":
                self.local(first)
            else:
                self.value(first)
        condition, body = fields(node, "condition", "body")
        header, test, begin, again, merge = out.id(), out.id(), out.id(), out.id(), out.id()
        self.label(header)
        out.emit(op.LOOP_MERGE, merge, again, 0)
        after = node.type == "do_statement"
        self.terminate(op.BRANCH, begin if after else test)
        if not after:
            self.label(test)
            self.terminate(op.BRANCH_CONDITIONAL, self.condition_id(condition), begin, merge)
        self.label(begin)
        self.jump_targets.append((merge, again))
        if body is not None:
            self.statements(body, depth)
        self.jump_targets.pop()
        self.terminate(op.BRANCH, again)
        self.label(again)
        update = node.child_by_field_name("update")
        if update is not None:
            self.value(update)
        if after:
            self.terminate(op.BRANCH_CONDITIONAL, self.condition_id(condition), header, merge)
        self.terminate(op.BRANCH, header)
        self.label(merge)
        self.scopes.pop()

    def switch(self, node: SyntaxNode, depth: int) -> None:
        out = self.out
        condition, body = self.parts(node, "condition", "body")
        selector = self.value(condition)
        cases = [child for child in body.named_children if child.type == "case_statement"]
        merge = out.id()
        labels = [out.id() for _ in cases]
        pairs: list[int] = []
        default = merge
        for case, label in zip(cases, labels, strict=True):
            value_node = case.child_by_field_name("value")
            if value_node is None:
                default = label
                continue
            number = self.integer(self.text_of(value_node))
            if number is None:
                raise self.unsupported(case, "is not supported")
            pairs += (number, label)
        out.emit(op.SELECTION_MERGE, merge, 0)
        self.terminate(op.SWITCH, selector.id, default, *pairs)
        self.jump_targets.append((merge, 0))
        self.scopes.append({})
        for case, label in zip(cases, labels, strict=True):
            self.label(label)
            value_node = case.child_by_field_name("value")
            for child in case.named_children:
                if child != value_node:
                    self.statement(child, depth)
        self.scopes.pop()
        self.jump_targets.pop()
        self.label(merge)
