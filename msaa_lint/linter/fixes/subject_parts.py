"""The parts of a frame that a fix's subject stands for. Each function raises NoFix for a subject of
another kind.
"""

from __future__ import annotations

from typing import TypeVar

from msaa_lint.frame.description.models import Image, Pipeline
from msaa_lint.frame.facts.facts import Subject
from msaa_lint.frame.facts.parts import Aspect, Attachment, Resolve, Target

from .changes import NoFix

T = TypeVar("T")


def present(part: T | None, problem: str) -> T:
    """The part itself; raises NoFix with the problem if there is none."""
    if part is None:
        raise NoFix(problem)
    return part


def described_image(subject: Subject) -> Image:
    """The record of an image that the description declares."""
    return present(
        subject.image.image if subject.image is not None else None,
        "the description does not declare the image",
    )


def attachment_of(subject: Subject) -> Attachment:
    """The attachment of an attachment or of one of its aspects."""
    return present(subject.attachment, "the finding is not about an attachment")


def aspect_of(subject: Subject) -> tuple[Attachment, Aspect]:
    """An aspect and its attachment."""
    problem = "the finding is not about an aspect of an attachment"
    return present(subject.attachment, problem), present(subject.aspect, problem)


def images_of(subject: Subject) -> list[Target]:
    """The images of an image, attachment or aspect: several if framebuffers alternate between
    them.
    """
    if subject.image is not None:
        return [subject.image]
    return list({id(target.record): target for target in attachment_of(subject).targets}.values())


def resolve_of(subject: Subject) -> Resolve:
    """The resolve that the subject is."""
    return present(subject.resolve, "the finding is not about a resolve")


def pipeline_of(subject: Subject) -> Pipeline:
    """The pipeline that the subject is."""
    return present(subject.pipeline, "the finding is not about a pipeline")


def read_of(subject: Subject) -> tuple[int, str]:
    """The position of a command that reads an image, and the image's name."""
    problem = "the finding is not about a command that reads an image"
    return present(subject.position, problem), present(subject.image, problem).name


def copied_images(subject: Subject) -> tuple[str, str]:
    """The names of the image that a resolve writes and of the one that its result is copied to."""
    problem = "the result of the resolve is not copied exactly once"
    return present(text_fact(subject, "resolve.copied_from"), problem), present(
        text_fact(subject, "resolve.copied_to"), problem
    )


def text_fact(subject: Subject, name: str) -> str | None:
    """The value of a text fact, or None if it is unknown."""
    value = subject.facts.values.get(name)
    return value if isinstance(value, str) else None
