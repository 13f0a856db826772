"""Frames in Metal's words, read and judged as the tests need them."""

from __future__ import annotations

from msaa_lint.core.text.source import Source
from msaa_lint.core.text.tree import Limits, parse
from msaa_lint.frame.description.document import Document
from msaa_lint.frame.facts.facts import Facts, Subject
from msaa_lint.frame.facts.subjects import subjects
from msaa_lint.input import readers

ARTICLE = """\
frame: {width: 1920, height: 1080, fps: 60}
metal:
  family: apple7
  textures:
    ms: {pixelFormat: r8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget, shaderRead], storageMode: private}
    depth: {pixelFormat: depth32Float, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: private}
    drawable: {pixelFormat: r8Unorm, drawable: true}
  renderPasses:
    forward:
      colorAttachments:
        - {texture: ms, resolveTexture: drawable, loadAction: clear, storeAction: storeAndMultisampleResolve}
      depthAttachment: {texture: depth, loadAction: clear, storeAction: store}
  renderPipelines:
    opaque: {renderPass: forward, rasterSampleCount: 4}
  commands:
    - renderPass: forward
    - present: drawable
"""
"""The article's code: samples stored, memory behind all, a usage that nothing needs."""

BEST = """\
frame: {width: 1920, height: 1080, fps: 60}
metal:
  family: apple7
  textures:
    ms: {pixelFormat: r8Unorm, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless}
    depth: {pixelFormat: depth32Float, textureType: type2DMultisample, sampleCount: 4, usage: [renderTarget], storageMode: memoryless}
    drawable: {pixelFormat: r8Unorm, drawable: true}
  renderPasses:
    forward:
      colorAttachments:
        - {texture: ms, resolveTexture: drawable, loadAction: clear, storeAction: multisampleResolve}
      depthAttachment: {texture: depth, loadAction: clear, storeAction: dontCare}
  renderPipelines:
    opaque: {renderPass: forward, rasterSampleCount: 4}
  commands:
    - renderPass: forward
    - present: drawable
"""


def read(text: str) -> Document:
    """The first document of a text."""
    source = Source("given.yaml", text)
    parsed = parse(source, Limits())
    assert parsed.problems == []
    return readers.read(source, parsed.documents[0])


def document(text: str) -> Document:
    """The same, without mistakes."""
    found = read(text)
    assert found.problems == ()
    return found


def of(text: str, kind: str) -> list[Subject]:
    """The subjects of a kind."""
    return [subject for subject in subjects(document(text)) if subject.kind == kind]


def image(text: str, name: str) -> Facts:
    """The facts of a texture."""
    return next(
        subject.facts for subject in of(text, "image") if subject.facts.values["image.name"] == name
    )


def aspect(text: str, path: str, name: str = "color") -> Facts:
    """The facts of an aspect of an attachment, by the end of its path."""
    found = [subject for subject in of(text, "aspect") if subject.path.endswith(path)]
    return next(subject.facts for subject in found if subject.facts.values["aspect.name"] == name)


def stated(text: str, facts: Facts, name: str) -> str:
    """The text at the place of a fact."""
    place = facts.places[name]
    return text[place.start : place.end]
