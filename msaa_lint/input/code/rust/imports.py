"""The names that `use` declarations bring into a Rust file."""

from __future__ import annotations

from msaa_lint.input.code.parsing import SyntaxNode, fields

MAX_IMPORTS = 2000
"""The maximum number of names that are imported; further ones are unknown."""

MAX_DEPTH = 20
"""The maximum nesting of lists in a `use` declaration."""

_CRATES = frozenset({"ash", "vulkanalia", "vulkano", "erupt"})


class Imports:
    """The paths that imported names stand for. Structures and enums of Vulkan's crates are
    `vk::Name`, whatever their module.
    """

    def __init__(self) -> None:
        self.paths: dict[str, list[str]] = {}
        self.wildcards = False
        """Whether all names of a Vulkan crate's module are imported."""
        self.is_vulkano = False
        """Whether names of vulkano are imported, whose structures have defaults of their own."""
        self.declared: set[str] = set()
        """The types that the file declares."""

    def add(self, node: SyntaxNode, text: str) -> None:
        """Adds the names of a `use` declaration."""
        stack: list[tuple[SyntaxNode | None, list[str], int]] = [
            (node.child_by_field_name("argument"), [], 0)
        ]
        while stack and len(self.paths) < MAX_IMPORTS:
            at, prefix, depth = stack.pop()
            self.is_vulkano = (
                self.is_vulkano
                or "vulkano" in prefix[:1]
                or text.startswith("vulkano::", at.start_byte if at is not None else 0)
            )
            if at is None or depth > MAX_DEPTH:
                continue
            kind = at.type
            if kind in ("scoped_use_list", "use_list"):
                path, inner = fields(at, "path", "list")
                outer = [*prefix, *_words(path, text)]
                stack += [(child, outer, depth + 1) for child in (inner or at).named_children]
            elif kind == "use_as_clause":
                path, alias = fields(at, "path", "alias")
                if alias is not None:
                    self.paths[text[alias.start_byte : alias.end_byte]] = _canonical(
                        [*prefix, *_words(path, text)]
                    )
            elif kind == "use_wildcard":
                words = [
                    *prefix,
                    *_words(at.named_children[0] if at.named_child_count else None, text),
                ]
                self.wildcards = self.wildcards or (
                    bool(words) and (words[0] in _CRATES or words[-1] == "vk")
                )
            else:
                words = [*prefix, *(word for word in _words(at, text) if word != "self")]
                if words:
                    self.paths[words[-1]] = _canonical(words)

    def resolved(self, parts: list[str]) -> list[str]:
        """Returns a path with its first part resolved."""
        if parts and parts[0] not in self.declared and (len(parts) > 1 or parts[0][:1].isupper()):
            path = self.paths.get(parts[0])
            if path is not None:
                parts = [*path, *parts[1:]]
            elif (
                self.wildcards
                and parts[0][:1].isupper()
                and parts[0] not in ("Self", "Some", "None", "Ok", "Err", "Vec", "Default", "Box")
            ):
                parts = ["vk", *parts]
        return _canonical(parts)


def _words(node: SyntaxNode | None, text: str) -> list[str]:
    return (
        [] if node is None else text[node.start_byte : node.end_byte].replace(" ", "").split("::")
    )


def _canonical(parts: list[str]) -> list[str]:
    """Returns a path of a Vulkan crate's type as `vk::Name`."""
    if len(parts) > 1 and parts[0] in _CRATES:
        first = next((n for n, part in enumerate(parts) if part[:1].isupper()), None)
        return (
            ["vk", *parts[first:]] if first is not None else ["vk"] if parts[-1] == "vk" else parts
        )
    return parts[parts.index("vk") :] if "vk" in parts[:-1] else parts
