"""Blanks the macros around declarations that the grammar does not expect, where their definitions
are unknown: `class API Name`, `API void f()`, `internal void f()`, `void CALL f()`, `f() ATTRIBUTE
{`, `Q_OBJECT`.
"""

from __future__ import annotations

import re

from msaa_lint.input.code.parsing import blank

_MACRO = r"_{0,3}[A-Z][A-Z0-9_]{1,60}"
_ARGUMENTS = r"\([^()\n]{0,200}\)"
_DECLARED = (
    r"(?:[A-Za-z_][\w:]{0,80}(?:<[^<>()\n]{0,100}>)?[ \t*&\n]{1,40}){1,5}~?[\w:]{1,100}[ \t]*\("
)
_KEYWORD = (
    r"(?:class|struct|union|enum|namespace|template|public|private|protected|typedef|using)\b"
)

_CLASSES = tuple(
    re.compile(
        rf"{word}(?<!\w{word})[ \t]+(?P<blank>{_MACRO}(?:[ "
        rf"\t]*{_ARGUMENTS})?)(?=\s{{1,40}}[A-Za-z_][\w:]{{0,100}}\s{{0,40}}"
        rf"(?:final\s{{0,40}})?(?::(?!:)|\{{))"
    )
    for word in ("class", "struct", "union")
)
"""`class API Name : public Base {`"""

_FUNCTION = re.compile(
    rf"\n[ \t]*+(?:(?:static|inline|extern|virtual|constexpr|friend|explicit|template[ "
    rf"\t]*<[^<>\n]{{0,100}}>)[ \t]+){{0,4}}"
    rf"(?P<blank>{_MACRO}(?:[ \t]*{_ARGUMENTS}(?=[ \t]))?)(?=\s{{1,40}}(?:{_KEYWORD}|{_DECLARED}))"
)
"""`API void f()`; also a macro on a line of its own before a function."""

_SPECIFIERS = (
    r"(?:auto|bool|char|class|consteval|constexpr|constinit|const|double|else|enum|explicit|extern|float|friend|goto|inline|int|long|namespace"
    r"|new|delete|operator|private|protected|public|register|return|short|signed|static|struct|template|thread_local|throw|typedef|typename"
    r"|union|unsigned|using|virtual|void|volatile|case|co_await|co_return|co_yield|export|import|module|concept|requires|\w+_t)\b"
)
_WORD = re.compile(
    rf"\n(?P<blank>(?!{_SPECIFIERS})[a-z][a-z0-9_]{{2,60}})(?=\s{{1,40}}(?!(?:const|constexpr|extern|inline|static|virtual|volatile)\b)"
    rf"(?!{_MACRO}[ \t*&\n]{{1,40}}[\w:]{{1,100}}[ \t]*\(){_DECLARED})"
)
"""`internal VkImage createImage()`, at the left margin: two types in a row are none; but `s32 CALL
f()` has one.
"""

_CONVENTION = re.compile(
    r"(?P<blank>[A-Z0-9_](?<=[ \t].)\w{2,124}+)(?=[ \t]{1,40}[A-Za-z_][\w:~]{0,100}[ \t]?\()"
)
"""`void CALL f()`"""

_CALLED = re.compile(
    r"[A-Z0-9_]{0,60}(?:CALL|API|DECL|CONV|PTR|INLINE|ATTR|EXPORT)[A-Z0-9_]{0,60}|__\w{0,20}call|__cdecl"
)
_TYPE = re.compile(r"[\w*&>][ \t]{1,40}\Z")

_AFTER = re.compile(
    r"\)[ \t\n]{0,40}(?:const[ "
    r"\t\n]{1,40})?(?P<blank>[A-Z0-9_]{0,60}(?:NOEXCEPT|OVERRIDE|FINAL|PRINTF|"
    rf"FORMAT|VARARG|ATTR|NONNULL|PURE|NORETURN|ANNOT|REQUIRES"
    rf"|EXCLUDES|ACQUIRE|RELEASE|GUARDED|NODISCARD|UNUSED)[A-Z0-9_]{{0,60}}(?:[ "
    rf"\t]?{_ARGUMENTS})?)(?=\s{{0,40}}[{{;])"
)
"""`void f() NOEXCEPT {`"""

_STATEMENT = re.compile(
    rf"\n[ \t]*+{_MACRO}[ \t]?{_ARGUMENTS}(?P<end>[ "
    rf"\t]*\n)(?=\s{{0,200}}(?:{_KEYWORD}|{_DECLARED}))",
)
"""`DECLARE_CLASS(Name, Base)`, without a semicolon"""

_INTERFACE = re.compile(r"^[ \t]*@(?:interface|implementation|protocol)\b", re.MULTILINE)


def without_annotations(text: str) -> str:
    """Returns the text without what only says how to link, call, or check a declaration; offsets
    stay.
    """
    for pattern in (*_CLASSES, _CONVENTION, _AFTER):
        text = pattern.sub(_blanked, text)
    # The patterns of lines start with the end of the one before, which is found faster than the
    # start of a line.
    return _STATEMENT.sub(_ended, _WORD.sub(_blanked, _FUNCTION.sub(_blanked, f"\n{text}")))[1:]


def without_objective_c(text: str) -> str:
    """Returns the text of C or C++ without the classes of Objective-C in it; offsets stay."""
    parts: list[str] = []
    last = 0
    while (start := _INTERFACE.search(text, last)) is not None and (
        end := text.find("@end", start.end())
    ) >= 0:
        parts += (text[last : start.start()], blank(text[start.start() : end + 4]))
        last = end + 4
    return "".join((*parts, text[last:]))


def _ended(match: re.Match[str]) -> str:
    return (
        match[0][: match.start("end") - match.start()]
        + ";"
        + " " * (len(match["end"]) - 2)
        + ("\n" if len(match["end"]) > 1 else "")
    )


def _blanked(match: re.Match[str]) -> str:
    if match.re is _CONVENTION and not (
        _CALLED.fullmatch(match["blank"])
        and _TYPE.search(match.string, max(match.start() - 41, 0), match.start())
    ):
        return match[0]
    start, end = match.start("blank") - match.start(), match.end("blank") - match.start()
    return match[0][:start] + " " * (end - start) + match[0][end:]
