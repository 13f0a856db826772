"""Lowers GLSL shaders to SPIR-V: declarations, functions, statements. The module can then be analyzed by `frame.spirv`.

Shaders are read as glslang reads them without options. Anything unsupported raises; nothing is reported for such a shader.
"""

import re
from typing import NamedTuple

from msaa_lint.frame.spirv import numbers as op
from msaa_lint.input.code.parsing import ascii_only

from .statements import Statements
from .text import UnsupportedShader, preprocess
from .types import VOID, multisampled, size_of
from .values import Value

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

    `images` are the locations of its multisampled images, `bindings` their descriptor sets and bindings, `constants` the locations of
    constants by value. `specialized` is set if it has specialization constants.
    """

    code: bytes
    stage: str
    entry: str
    fetches: tuple[Fetch, ...]
    images: dict[str, tuple[int, int]]
    bindings: dict[str, tuple[int, int | None]]
    constants: dict[int, tuple[int, int]]
    specialized: bool


def shader(text: str, part: bool = False) -> Shader:
    """Lowers a shader. `part` allows a shader without `main`; its entry point is then the function that fetches samples.

    Raises UnsupportedShader if the shader cannot be lowered, and `parsing.Missing` if the extra is not installed.
    """
    return _ShaderLowering(preprocess(ascii_only(text))).shader(part)


class _ShaderLowering(Statements):
    """Lowers one shader."""

    @property
    def compute(self) -> bool:
        return "local_size_x" in " ".join(self.source.layouts)

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
            self.called_functions.append(entry)
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
        fetches = tuple(Fetch(image, at(start), at(end - 1) + 1) for image, start, end in self.fetches)
        code = self.out.module(_COMPUTE if self.compute else _FRAGMENT, main, "main")
        images = {image: (at(start), at(end - 1) + 1) for image, (start, end) in self.images.items()}
        constants = {count: (at(start), at(end - 1) + 1) for count, (start, end) in self.counts.items()}
        stage = "COMPUTE" if self.compute else "FRAGMENT"
        return Shader(code, stage, name, fetches, images, self.bindings, constants, self.specialized)

    def call_uncalled_functions(self) -> str:
        """Calls the uncalled functions of a shader without `main`, passing images and values of their own.

        Returns the name of the first.
        """
        texts = {name: self.text_of(entry.node) for name, item in self.functions.items() for entry in item}
        first_name = ""
        for name, functions in self.functions.items():
            function = functions[0]
            if not any(multisampled(kind) for kind, _, _ in function.parameters) and "texelFetch" not in texts[name]:
                continue
            if any(re.search(rf"\b{name}\s*\(", text) for other, text in texts.items() if other != name):
                continue
            passed: list[int] = []
            for kind, written, parameter in function.parameters:
                storage = op.UNIFORM_CONSTANT if kind[0] == "opaque" else op.FUNCTION_LOCAL if written else op.INPUT
                variable = self.variable(storage, kind)
                if multisampled(kind):
                    self.decorate_layout(variable.pointer, self.with_binding(parameter, {}), storage)
                    self.images.setdefault(parameter, (function.node.start_byte, function.node.start_byte))
                passed.append(variable.pointer if written or kind[0] == "opaque" else self.load(variable).id)
            self.called_functions.append(function)
            result = self.out.instruction(op.FUNCTION_CALL, function.returns, function.id, *passed)
            if function.returns != VOID:
                output = self.variable(op.OUTPUT, function.returns)
                self.store(output, Value(result, function.returns))
            first_name = first_name or name
        if not first_name:
            raise UnsupportedShader("the shader fetches no samples")
        return first_name
