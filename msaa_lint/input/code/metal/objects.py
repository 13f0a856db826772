"""Metal's objects: descriptors and their attachments, views, layers, drawables."""

from __future__ import annotations

from typing import Any, NamedTuple

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.core.guards import ALWAYS, Guards
from msaa_lint.input.code.core.interpreter import Interpreter
from msaa_lint.input.code.core.limits import Work
from msaa_lint.input.code.core.scope import MEMBER, Scope
from msaa_lint.input.code.core.terms import Function, Term, Unit
from msaa_lint.input.code.core.values import (
    UNKNOWN,
    UNKNOWN_VALUE,
    Alternative,
    ApiObject,
    Cell,
    Instance,
    Struct,
    Symbol,
    Value,
    sole_value,
)

from .library import MetalLibrary
from .names import ATTACHMENTS, PASS_SOURCES, SHARED, kind_of, type_name

ANY = "color?"
"""The color attachment with an unknown index."""

LOOSE = "?"
"""The member of a descriptor that says that other code may have changed it."""

CREATED = "!"
"""The member of a copied descriptor that says that the program creates it."""

MAX_COLORS = 8

_TEXTURE_MEMBERS = frozenset({"textureType", "usage", "storageMode", "sampleCount"})
_PIPELINE_MEMBERS = frozenset(
    {"rasterSampleCount", "sampleCount", "isAlphaToCoverageEnabled", "depthAttachmentPixelFormat"}
)
_VIEW_MEMBERS = frozenset({"sampleCount", "depthStencilPixelFormat", "colorPixelFormat"})
_DESCRIPTORS = frozenset({"texture", "pass", "pipeline", "attachment"})


class Encoded(NamedTuple):
    """A step of a frame: a pass, copy, read, or presented drawable, the entry point that encodes
    it, and whether it always does.
    """

    kind: str
    what: tuple[Any, ...]
    at: Span
    by: int
    sure: bool


class MetalObjects(Interpreter):
    """The objects of a program that calls Metal."""

    def __init__(self, unit: Unit, fragments: bool, is_cpp: bool, work: Work) -> None:
        super().__init__(unit, MetalLibrary(), fragments, is_cpp, work)
        self.instances: dict[tuple[Any, ...], Instance] = {}
        self.by_key: dict[str, Instance] = {}
        self.owners: dict[str, Instance] = {}
        """The descriptors by the keys of their attachments and lists of color attachments."""
        self.views: set[Span] = set()
        """Where views are created."""
        self.root = 0
        """The number of the current entry point."""
        self.branches = 0
        """The number of enclosing branches that may not be taken."""
        self.encoded: list[Encoded] = []
        self.incomplete: set[int] = set()
        """Entry points that hide some of what they encode."""

    def begin(self) -> None:
        super().begin()
        self.root = 0
        self.encoded.clear()
        self.incomplete.clear()

    def instance(self, kind: str, key: tuple[Any, ...], at: Span, complete: bool) -> Instance:
        """Returns the object with a key, which is created on first use."""
        known = self.instances.get(key)
        if known is None:
            known = self.instances[key] = Instance(
                kind, f"@{len(self.instances)}.", at, self, complete
            )
            self.by_key[known.key] = known
        return known

    def construct_object(self, kind: str, place: Span, scope: Scope) -> Value:
        """Returns an object that the program creates."""
        if kind == "view":
            self.views.add(place)
        key = (kind,) if kind in SHARED else (kind, place, scope.calls, scope.iterations)
        created = self.instance(kind, key, place, True)
        if kind not in SHARED:
            created.complete = True
            self.reset(created)
        return (Alternative(created, place),)

    def reset(self, created: Instance) -> None:
        """Discards the members of an object whose creation is executed again."""
        for name in self.names_of(created.key):
            self.work.spend()
            key = created.key + name
            for write in self.member_cell(key).writes:
                if (
                    isinstance(write.value, Instance)
                    and self.instances.get(("attachment", created.key, name)) is write.value
                ):
                    self.reset(write.value)
            self.overlay[key] = Cell(MEMBER, key, (), key)
            self.initial[key] = ()

    def typed_value(self, kind: str, name: str, place: Span) -> Value:
        """Returns the object in a variable of unknown value, by its type."""
        known = kind_of(kind)
        written = type_name(kind)
        if not known and self.is_view(written):
            known = "view"
        if known:
            created = self.instance(
                known, (known,) if known in SHARED else (known, name, place), place, False
            )
            return (Alternative(created, place),)
        class_name = self.class_of(written, "") if written and not kind.endswith("]") else None
        return self.of_class(class_name, place) if class_name is not None else UNKNOWN_VALUE

    def of_class(self, class_name: str, place: Span) -> Value:
        """Returns an object of a class of the program; all of them are taken for one."""
        key = ("class", class_name)
        known = self.instances.get(key)
        if known is None:
            known = self.instances[key] = Instance(
                class_name, f"{class_name}::", place, self, False
            )
        return (Alternative(known, place),)

    def is_view(self, class_name: str) -> bool:
        """Returns whether a class of the program is an MTKView."""
        return "MTKView" in self.unit.bases.get(class_name, ())

    def own_object(self, function: Function) -> Cell | None:
        """Returns `self` in the methods that a program adds to Metal's types."""
        self.root += 1
        kind = kind_of(function.class_name) or ("view" if self.is_view(function.class_name) else "")
        return (
            Cell(kind, "", self.typed_value(function.class_name, kind, function.at))
            if kind
            else None
        )

    def variable(self, name: str, scope: Scope) -> Cell | None:
        if scope.this_object is not None and not any(
            name in variables for variables in scope.scopes
        ):
            value = sole_value(scope.this_object.read(scope.guards))
            if (
                isinstance(value, Instance)
                and value.kind in _OBJECT_KINDS
                and name not in self.members.get(scope.class_name, ())
            ):
                return self.member_of_object(value, scope.this_object, name, value.at, scope)
        return super().variable(name, scope)

    def member_key(self, name: str, scope: Scope) -> str:
        owner, _, short = name.rpartition("::")
        class_name = self.class_of(owner, "") if owner and name not in self.globals else None
        return (
            f"{class_name}::{short}" if class_name is not None else super().member_key(name, scope)
        )

    def declared(self, key: str) -> Value:
        value = super().declared(key)
        for alternative in value:
            name_by_member(alternative.value, key)
        return value

    def read(self, term: Term, scope: Scope) -> Value:
        # A value that an argument passes is where a member is set to the parameter.
        value = super().read(term, scope)
        return tuple(
            a
            if isinstance(a.value, Struct)
            else Alternative(self.spelled(a.value), term[-1], a.guards)
            for a in value
        )

    def spelled(self, value: Any) -> Any:
        """Returns a symbol named as in the program: `view.sampleCount`."""
        if not isinstance(value, Symbol) or value.name[:1] != "@":
            return value
        key, _, name = value.name.partition(".")
        owner = self.by_key.get(f"{key}.")
        return value._replace(
            name=f"{owner.name or owner.kind}.{name}" if owner is not None else name
        )

    def member_of_object(
        self, value: Any, cell: Cell, name: str, place: Span, scope: Scope
    ) -> Cell | None:
        """Returns a member of an object, or None."""
        if isinstance(value, Instance):
            special = self.special_member(value, name, place, scope)
            return special if special is not None else value.cell(name)
        if isinstance(value, ApiObject):
            return value.info.fields.get(name) if value.kind == "texture" else None
        if isinstance(value, Struct):
            return None
        if name in PASS_SOURCES or name == "currentDrawable":
            return self.special_member(
                self.instance("view", ("view",), place, False), name, place, scope
            )
        last = cell.name.rpartition("::")[2].rpartition(".")[2]
        if name == "texture" and "drawable" in last.lower():
            return Cell(writes=(Alternative(self.drawable_texture(place), place),))
        kind = _kind_by_name(last.lower(), name) if last else ""
        if not kind or isinstance(value, Alternative):
            return None
        adopted = self.instance(
            kind,
            (kind,) if kind in SHARED else ("adopted", kind, cell.key or cell.name),
            place,
            False,
        )
        adopted.name = adopted.name or last
        cell.writes = (Alternative(adopted, place),)
        return self.member_of_object(adopted, cell, name, place, scope)

    def special_member(self, value: Instance, name: str, place: Span, scope: Scope) -> Cell | None:
        """Returns a member that Metal creates, or None."""
        member: ApiObject | Instance | None = None
        if value.kind in ("pass", "pipeline"):
            if name == "colorAttachments":
                member = self.instance("slots", ("slots", value.key), place, True)
                self.owners[member.key] = value
            elif name in ATTACHMENTS:
                return self.slot(value, name, place)
        elif value.kind == "drawable" and name == "texture":
            member = self.drawable_texture(place)
        elif value.kind == "view":
            if name in ("multisampleColorTexture", "depthStencilTexture"):
                member = self.view_texture(name, place)
            elif name == "layer":
                member = self.instance("layer", ("layer",), place, False)
            elif name == "currentDrawable":
                member = self.instance("drawable", ("drawable",), place, False)
            elif name in PASS_SOURCES:
                member = self.view_pass(place, scope)
        return Cell(name=name, writes=(Alternative(member, place),)) if member is not None else None

    def element_of_object(self, value: Any, index: Any, place: Span) -> Cell | None:
        """Returns a color attachment."""
        if not isinstance(value, Instance) or value.kind != "slots":
            return None
        known = type(index) is int and 0 <= index < MAX_COLORS
        return self.slot(self.owners[value.key], f"color{index}" if known else ANY, place)

    def slot(self, owner: Instance, name: str, place: Span) -> Cell:
        """Returns the member with an attachment of a descriptor, which always exists."""
        cell = owner.cell(name)
        if not cell.writes:
            attachment = self.instance("attachment", ("attachment", owner.key, name), place, True)
            self.owners[attachment.key] = owner
            # That it exists is no write of the entry point.
            cell.writes = self.initial[cell.name] = (Alternative(attachment, place),)
        return cell

    def invalidate(self, value: Instance, place: Span, guards: Guards) -> None:
        """Marks a descriptor that other code may change. A texture descriptor keeps only what is
        set afterwards.
        """
        if value.kind in _DESCRIPTORS:
            value.cell(LOOSE).write((Alternative(True, place),), place, guards)
            for cell in value.fields.values() if value.kind == "texture" else ():
                self.work.spend()
                cell.write(UNKNOWN_VALUE, place, guards)

    def snapshot(self, value: Instance, guards: Guards) -> Struct:
        """Returns a copy of an object with its attachments; `zeroed` says that the members that it
        does not set have their defaults.
        """
        copy = Struct(value.kind, value.at, value.complete, value.name)
        for name in self.names_of(value.key):
            exists = ("attachment", value.key, name) in self.instances
            cell = self.slot(value, name, value.at) if exists else value.cell(name)
            self.work.spend(1 + len(cell.writes))
            written = cell.read(guards)
            inner = sole_value(written)
            if name == LOOSE:
                copy.zeroed = False
            elif isinstance(inner, Instance) and inner.kind == "attachment":
                copy.fields[name] = Cell(
                    name=name, writes=(Alternative(self.snapshot(inner, guards), inner.at),)
                )
            elif written:
                copy.fields[name] = Cell(name=name, writes=written)
        if value.complete and value.kind == "pass":
            copy.fields[CREATED] = Cell(name=CREATED, writes=(Alternative(True, value.at),))
        if ANY in copy.fields:
            copy.zeroed = False
            unknown = copy.fields.pop(ANY).writes[0].value
            for name, cell in copy.fields.items():
                attachment = sole_value(cell.writes)
                if (
                    name.startswith("color")
                    and isinstance(attachment, Struct)
                    and isinstance(unknown, Struct)
                ):
                    for member in unknown.fields.keys() & attachment.fields.keys():
                        attachment.fields[member].write(UNKNOWN_VALUE, attachment.at, ALWAYS)
        return copy

    def api_object(self, kind: str, key: tuple[Any, ...], place: Span, info: Struct) -> ApiObject:
        obj = self.objects.get(key)
        if obj is None:
            obj = self.objects[key] = ApiObject(kind, key, place, info)
        elif kind == "pipeline" and "passes" in obj.info.fields:
            # The call is executed again; what was drawn with it stays known.
            info.fields.setdefault("passes", obj.info.fields["passes"])
        obj.info = info
        self.current_objects[key] = obj
        return obj

    def create(self, kind: str, info: Struct, place: Span, scope: Scope) -> ApiObject:
        """Returns the object that a call creates from a copy of its descriptor."""
        obj = self.api_object(kind, (kind, place, scope.calls, scope.iterations), place, info)
        obj.guards = scope.guards
        obj.name_depth = 99
        return obj

    def drawable_texture(self, place: Span) -> ApiObject:
        """Returns the texture of the program's drawable."""
        return self.named("drawable", ("drawable texture",), place)

    def view_texture(self, name: str, place: Span) -> ApiObject:
        """Returns a texture that the view creates and keeps."""
        return self.named(name, ("view texture", name), place)

    def named(self, name: str, key: tuple[Any, ...], place: Span) -> ApiObject:
        known = self.objects.get(key)
        if known is None:
            known = ApiObject("texture", key, place, Struct("texture", place))
            self.objects[key] = known
            known.name, known.name_depth = name, -2
        return known

    def view_setting(self, name: str) -> Value:
        """Returns what the program sets for its view, in any function."""
        view = self.instances.get(("view",))
        key = view.key + name if view is not None else ""
        return self.overlay[key].writes if key in self.overlay else self.summary.get(key, ())

    def view_pass(self, place: Span, scope: Scope) -> Instance:
        """Returns the descriptor that MTKView creates for its drawable.

        With multisampling, it clears the multisampled texture and resolves it to the drawable's
        texture. Depth and stencil are cleared and not stored (Apple's documentation of
        currentRenderPassDescriptor).
        """
        descriptor = self.instance("pass", ("view pass", place, scope.calls), place, True)
        self.reset(descriptor)
        counts = self.view_setting("sampleCount")
        several = [write for write in counts if type(write.value) is int and write.value > 1]
        known = (
            all(type(write.value) is int for write in counts)
            and len({write.guards for write in several}) == 1
        )
        descriptor.complete = known and len(self.views) < 2
        if not descriptor.complete:
            return descriptor
        guards = several[0].guards if len(several) < len(counts) else ALWAYS
        self.clear(
            descriptor, "color0", "multisampleColorTexture", "multisampleResolve", place, guards
        )
        pixels = sole_value(self.view_setting("depthStencilPixelFormat"))
        for aspect in ("depth", "stencil"):
            if isinstance(pixels, str) and aspect in pixels:
                self.clear(
                    descriptor,
                    f"{aspect}Attachment",
                    "depthStencilTexture",
                    "dontCare",
                    place,
                    guards,
                )
        return descriptor

    def clear(
        self, descriptor: Instance, slot: str, texture: str, store: str, place: Span, guards: Guards
    ) -> None:
        """Sets an attachment that is cleared."""
        attachment = sole_value(self.slot(descriptor, slot, place).writes)
        members: dict[str, Any] = {
            "texture": self.view_texture(texture, place),
            "loadAction": "clear",
            "storeAction": store,
        }
        if store == "multisampleResolve":
            members["resolveTexture"] = self.drawable_texture(place)
        for name, value in members.items():
            attachment.cell(name).writes = (Alternative(value, place, guards),)


_OBJECT_KINDS = frozenset({*_DESCRIPTORS, *SHARED})


def _kind_by_name(low: str, member: str) -> str:
    """Returns the kind of an undeclared object by its name, in lower case, and the member that is
    used, or an empty string.
    """
    if member in ("colorAttachments", *ATTACHMENTS):
        return "pipeline" if "pipeline" in low or "pso" in low else "pass"
    if member in _PIPELINE_MEMBERS and "pipeline" in low:
        return "pipeline"
    if member in _VIEW_MEMBERS and "view" in low:
        return "view"
    return "texture" if member in _TEXTURE_MEMBERS and "desc" in low else ""


def name_by_member(value: Any, key: str) -> None:
    """Names an object of the API after the member that holds it, rather than after a variable."""
    if isinstance(value, ApiObject) and value.name_depth > -1:
        value.name, value.name_depth = key, -1


def is_unknown(value: Any) -> bool:
    """Returns whether nothing is known of a value but where it comes from."""
    return value is UNKNOWN or isinstance(value, Symbol)
