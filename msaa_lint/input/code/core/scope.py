"""The scope in which functions are executed, and its limits."""

from __future__ import annotations

from msaa_lint.core.text.span import Span

from .guards import ALWAYS, Guards
from .values import Alternative, ApiObject, Cell, Value

MAX_TURNS = 16
"""The maximum number of loop iterations that are executed individually."""

MAX_CASES = 8
"""The maximum number of labels of a switch that are executed one after the other without a
break.
"""

MAX_PASSES = 3
"""The maximum number of times that a file is executed. A member's value may depend on another
member, which depends on a third.
"""

MEMBER = "member"
"""The kind of a cell for a class member or a global variable."""

Scopes = tuple[dict[str, Cell], ...]

MAX_CALLS = 100
"""The maximum depth of calls that are executed."""

MAX_FRAMES = 8000
"""The depth of Python's stack while a program is executed, enough for MAX_CALLS in ordinary
code.
"""

MAX_CLOSURES = 20
"""The maximum depth of calls in which lambdas are executed; they may call each other."""

MAX_WAYS = 1
"""The number of times that a call is executed whatever work is left."""


class Scope:
    """The scope of a function call: its variables, its class, and the calls that lead to it."""

    def __init__(
        self,
        class_name: str = "",
        namespace: str = "",
        scopes: Scopes = (),
        guards: Guards = ALWAYS,
        calls: tuple[Span, ...] = (),
    ) -> None:
        self.class_name = class_name
        self.namespace = namespace
        """The namespace, with a trailing `::`."""
        self.enclosing = class_name or namespace
        """Where names of classes are looked up first."""
        self.scopes = scopes or ({},)
        self.guards = guards
        self.calls = calls
        self.return_values: list[Alternative] = []
        self.return_type = ""
        self.by_reference = False
        """Whether the function returns a reference."""
        self.unreachable = False
        """Whether the following statements are unreachable."""
        self.interrupted = False
        """Whether a loop or a switch was left before its end."""
        self.unknown_loops = 0
        self.iterations: tuple[int, ...] = ()
        """The current iterations of the enclosing loops that are executed individually."""
        self.this_object: Cell | None = None
        """The object that the method is called on, if known."""
        self.object_class = class_name
        """The class of that object, as far as it is known: `class_name` or one that derives from
        it.
        """
        self.extent: Span | None = None
        """The place of the function's body."""
        self.active_functions: tuple[Span, ...] = ()
        """The functions that are being executed."""

    def contains(self, place: Span) -> bool:
        """Returns whether a place is in the function that is executed, or in none that is known."""
        return self.extent is None or self.extent.start <= place.start <= self.extent.end


def name_objects(value: Value, name: str, scope: Scope) -> None:
    """Names objects after the variable that they are assigned to; the outermost function takes
    precedence.
    """
    for alternative in value:
        obj = alternative.value
        if isinstance(obj, ApiObject) and name and len(scope.calls) < obj.name_depth:
            obj.name, obj.name_depth = name, len(scope.calls)
