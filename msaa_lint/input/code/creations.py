"""Finds where source code creates multisampled images and pipelines, by its words, if nothing of
them could be read.
"""

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from .c.preprocessor import without_dead_code
from .parsing import Code, blank

COUNTS = ("2", "4", "8", "16", "32", "64")

IMAGES = "images"
PIPELINES = "pipelines"
READS = "reads"

_BLANKED = re.compile(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.)*'", re.DOTALL
)
"""Comments and literals."""

_ONE = re.compile(
    r"(?:\(\s*\w+\s*\)\s*)?(?:0|1|1u|\{\s*\}|VK_SAMPLE_COUNT_1_BIT|(?:\w+::)*SampleCountFlagBits(?:KHR)?::e1|\.e1)?\s*",
    re.IGNORECASE,
)
"""A sample count of one, or no value."""

_ASSIGNED = re.compile(
    r"(?<![.>\w])(?P<name>[A-Za-z_]\w*)\s*(?:=(?!=)|\{)(?=\s*(?P<assigned>[^;,{}\n]{0,200}))"
    r"|#\s*define\s+(?P<macro>\w+)[ \t]+(?P<defined>[^\n]{0,200})"
)
"""A name that gets a value. The value may contain another one."""

_COUNT = r"(?:VK_SAMPLE_COUNT_(?:2|4|8|16|32|64)_BIT|(?:\w+::){0,9}SampleCountFlagBits::e(?:2|4|8|16|32|64)\b)"  # noqa: E501
_NAMED = r"\b(?:\w{1,80}(?:\.|->|::)){0,2}\w{0,80}(?i:sample|msaa)\w{0,80}"
_VALUE = r"(?P<value>[^,;{}\n]{1,200}|\{\s*\})"

_VULKAN = re.compile(
    # A member that is set: not the declaration of one, and not the setter of a binding.
    rf"(?:\.|->)\s*(?P<member>samples|rasterizationSamples)\s*=(?!=)\s*{_VALUE}"
    rf"|(?:\.|->)\s*set(?P<setter>Samples|RasterizationSamples)\s*\((?P<argument>[^;{{}}\n]{{1,200}}?)\)"
    # Its place in the initializer of an image or an attachment, and a function that creates one.
    rf"|(?P<initializer>{_COUNT}|{_NAMED})\s*,\s*(?:VK_ATTACHMENT_LOAD_OP_|VK_IMAGE_TILING_|(?:\w+::){{0,9}}(?:AttachmentLoadOp|ImageTiling)::)"
    rf"|\b\w{{0,80}}(?i:create|make|alloc|init)\w{{0,80}}\s*\((?:[^;{{}}()]|\([^;{{}}()]{{0,80}}\)){{0,200}}?(?P<passed>{_COUNT})"
)
_VULKAN_ANCHOR = re.compile(
    r"(?:\.|->)\s*(?:samples|rasterizationSamples|setSamples|setRasterizationSamples)\b|VK_SAMPLE_COUNT_(?!1_)|SampleCountFlagBits::e(?!1\b)"
    r"|VK_ATTACHMENT_LOAD_OP_|VK_IMAGE_TILING_|AttachmentLoadOp::|ImageTiling::"
)
"""What each match of `_VULKAN` contains. It is searched for only in the statements with one of
these.
"""

MAX_BEFORE = 1000
MAX_AFTER = 400
"""The number of characters of a statement before and after an anchor."""

_VULKAN_IMAGES = re.compile(
    r"(?i:create)\w{0,80}(?:Image|Texture|RenderPass|Attachment|Target)\w{0,80}\s*\(|raii::(?:Image|RenderPass)\b|[bB]eginRendering"
)
_VULKAN_PIPELINES = re.compile(r"(?i:create)\w{0,80}Pipeline\w{0,80}\s*\(|raii::Pipeline\b")
"""Calls that create something: initializers of structures alone do not."""

_METAL = re.compile(
    rf"\.\s*(?P<member>sampleCount|rasterSampleCount)\s*=(?!=)\s*{_VALUE}|\.(?P<type>textureType)\s*=\s*(?P<initializer>\.type2DMultisample\w*)"
)
_METAL_IMAGES = re.compile(r"MTLTextureDescriptor|MTKView|texture2DDescriptor|extureDescriptor")

_GLSL = re.compile(
    r"\b(?P<initializer>[iu]?(?:sampler|texture|image)2DMS(?:Array)?|[iu]?subpassInputMS)\b"
)
_GLSL_READS = re.compile(r"\b(?:texelFetch|subpassLoad|imageLoad)\b")


class Creation(NamedTuple):
    """Code that creates something multisampled: what (IMAGES, PIPELINES; READS: a shader that reads
    samples), its place, and its text.
    """

    kind: str
    start: int
    end: int
    text: str


def creations(codes: Iterable[Code]) -> Iterator[Creation]:
    """Yields what code creates with a sample count that is not one, in the order of the code.

    Declarations of members, tables of enumerants, and comparisons create nothing.
    """
    for code in codes:
        if (
            code.language not in ("swift", "glsl", "objc", "objcpp")
            and _VULKAN_ANCHOR.search(code.text) is None
        ):
            continue
        yield from _of_language(code.language, blanked(code))


def blanked(code: Code) -> str:
    """Returns the text of code with comments, literals, and dead code blanked, at the same
    offsets.
    """
    return _BLANKED.sub(lambda match: blank(match[0]), without_dead_code(code).text)


class _Ones:
    """Which expressions of a text are a sample count of one, or not a sample count."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.names: dict[str, bool] | None = None
        """The names that the text gives a value, and whether each of their values is one."""

    def holds(self, value: str) -> bool:
        """Whether an expression is: a literal, or a name that the text gives no other value."""
        if _ONE.fullmatch(value) is not None:
            return True
        if value.isdecimal():
            # Audio devices have samples, too.
            return value not in COUNTS
        if not value.isidentifier():
            return False
        if self.names is None:
            self.names = {}
            for match in _ASSIGNED.finditer(self.text):
                name = match["name"] or match["macro"]
                one = (
                    _ONE.fullmatch((match["assigned"] or match["defined"] or "").strip())
                    is not None
                )
                self.names[name] = one and self.names.get(name, True)
        return self.names.get(value, False)


def _matches(pattern: re.Pattern[str], text: str) -> Iterator[re.Match[str]]:
    """Yields the matches of a language's pattern."""
    if pattern is not _VULKAN:
        yield from pattern.finditer(text)
        return
    done = 0
    for anchor in _VULKAN_ANCHOR.finditer(text):
        if anchor.end() <= done:
            continue
        least = max(done, anchor.start() - MAX_BEFORE)
        start = max(least, *(text.rfind(sign, least, anchor.start()) + 1 for sign in ";{}"))
        for match in pattern.finditer(text, start, min(anchor.end() + MAX_AFTER, len(text))):
            yield match
            done = match.end()
        done = max(done, anchor.end())


def _of_language(language: str, text: str) -> Iterator[Creation]:
    if language == "glsl":
        match = _GLSL.search(text) if _GLSL_READS.search(text) is not None else None
        if match is not None:
            yield Creation(READS, match.start(), match.end(), match[0])
        return
    if language in ("swift", "objc", "objcpp"):
        yield from _of_api(text, _METAL, _METAL_IMAGES, None)
    if language != "swift":
        yield from _of_api(text, _VULKAN, _VULKAN_IMAGES, _VULKAN_PIPELINES)


def _of_api(
    text: str, pattern: re.Pattern[str], images: re.Pattern[str], pipelines: re.Pattern[str] | None
) -> Iterator[Creation]:
    has_images, has_pipelines = (
        images.search(text) is not None,
        pipelines is None or pipelines.search(text) is not None,
    )
    ones = _Ones(text)
    for match in _matches(pattern, text):
        groups = match.groupdict()
        value = next(
            groups[name]
            for name in ("value", "argument", "initializer", "passed")
            if groups.get(name) is not None
        ).strip()
        if ones.holds(value):
            continue
        setter = groups.get("setter") or "samples"
        member = groups.get("member") or groups.get("type") or setter[:1].lower() + setter[1:]
        kind = PIPELINES if member.lower().startswith("raster") else IMAGES
        if has_images if kind == IMAGES else has_pipelines:
            yield Creation(kind, match.start(), match.end(), f"{member} = {value}")
