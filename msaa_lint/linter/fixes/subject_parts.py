"""The parts of a frame that a fix's subject stands for. Each function raises NoFix for a subject of another kind."""

from __future__ import annotations

from msaa_lint.frame.description.models import Image, Pipeline
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.parts import Aspect, Attachment, Resolve, Target

from .changes import NoFix


def described_image(subject: Subject) -> Image:
    """The record of an image that the description declares."""
    image = subject.image.image if subject.image is not None else None
    if image is None:
        raise NoFix("the description does not declare the image")
    return image


def attachment_of(subject: Subject) -> Attachment:
    """The attachment of an attachment or of one of its aspects."""
    if subject.attachment is None:
        raise NoFix("the finding is not about an attachment")
    return subject.attachment


def aspect_of(subject: Subject) -> tuple[Attachment, Aspect]:
    """An aspect and its attachment."""
    if subject.attachment is None or subject.aspect is None:
        raise NoFix("the finding is not about an aspect of an attachment")
    return subject.attachment, subject.aspect


def images_of(subject: Subject) -> list[Target]:
    """The images of an image, attachment or aspect: several if framebuffers alternate between them."""
    if subject.image is not None:
        return [subject.image]
    return list({id(target.record): target for target in attachment_of(subject).targets}.values())


def resolve_of(subject: Subject) -> Resolve:
    """The resolve that the subject is."""
    if subject.resolve is None:
        raise NoFix("the finding is not about a resolve")
    return subject.resolve


def pipeline_of(subject: Subject) -> Pipeline:
    """The pipeline that the subject is."""
    if subject.pipeline is None:
        raise NoFix("the finding is not about a pipeline")
    return subject.pipeline


def read_of(subject: Subject) -> tuple[int, str]:
    """The position of a command that reads an image, and the image's name."""
    if subject.position is None or subject.image is None:
        raise NoFix("the finding is not about a command that reads an image")
    return subject.position, subject.image.name


def copied_images(subject: Subject) -> tuple[str, str]:
    """The names of the image that a resolve writes and of the one that its result is copied to."""
    source, target = text_fact(subject, "resolve.copied_from"), text_fact(subject, "resolve.copied_to")
    if source is None or target is None:
        raise NoFix("the result of the resolve is not copied exactly once")
    return source, target


def text_fact(subject: Subject, name: str) -> str | None:
    """The value of a text fact, or None if it is unknown."""
    value = subject.facts.values.get(name)
    return value if isinstance(value, str) else None
