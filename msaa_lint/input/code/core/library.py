"""The names of an API as source code spells them, which the interpreter asks for what they stand
for.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import NamedTuple


class Construction(NamedTuple):
    """How a structure of an API is initialized by a list of values."""

    structure: str
    """The name of the structure, as `Library.structure` returns it."""
    members: tuple[str, ...]
    """The members that the values initialize, in order."""
    defaults: Mapping[str, int]
    """Members with a default other than zero."""
    takes_lists: bool
    """Whether a list stands for a count and the pointer that follows it."""


class Library(ABC):
    """The names of one API."""

    copies_on_set = False
    """Whether a setter returns a changed copy and leaves the structure as it is."""

    @abstractmethod
    def constant(self, name: str) -> int | str | bool | None:
        """Returns the value of a constant of the API: a sample count as a number, a boolean, or an
        enumerant; None for other names.
        """

    @abstractmethod
    def structure(self, type_text: str) -> str:
        """Returns the name of the structure that a type is, or an empty string for other types."""

    @abstractmethod
    def construction(self, type_text: str) -> Construction:
        """Returns how a type whose `structure` is not empty is initialized."""

    @abstractmethod
    def is_alike(self, structure: str, other: str) -> bool:
        """Returns whether two structures have the same members."""

    @abstractmethod
    def member(self, name: str) -> str:
        """Returns the name that descriptions give a member. It differs from that of the code for a
        pointer.
        """

    @abstractmethod
    def member_type(self, structure: str, member: str) -> str:
        """Returns the type of a member that braces can initialize, or an empty string."""

    @abstractmethod
    def setter(self, method: str) -> str | None:
        """Returns the member that a method sets by its name, or None."""

    @abstractmethod
    def has_member(self, structure: str, member: str) -> bool:
        """Returns whether a structure has a member, named as in descriptions."""

    @abstractmethod
    def is_type(self, type_text: str) -> bool:
        """Returns whether a type belongs to the API."""

    @abstractmethod
    def is_scalar(self, type_text: str) -> bool:
        """Returns whether braces of a type contain a single value: an enumerant, flags, or a
        number.
        """

    @abstractmethod
    def is_cast(self, type_text: str) -> bool:
        """Returns whether a type, called like a function, converts a value."""

    @abstractmethod
    def is_format(self, value: str) -> bool:
        """Returns whether an enumerant is a format other than an undefined one."""

    def command(self, name: str) -> str:
        """Returns the name that the API gives a function."""
        return name

    @abstractmethod
    def is_success(self, name: str) -> bool:
        """Returns whether a constant is the result of a call that succeeds."""

    @abstractmethod
    def is_count_choice(self, function: str) -> bool:
        """Returns whether a function, judging by its name, chooses a sample count that the device
        supports.
        """
