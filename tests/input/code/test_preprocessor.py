"""The preprocessor of C and C++: what it replaces and leaves out, and the places of what
remains.
"""

from __future__ import annotations

import re

import pytest

from msaa_lint.core.text.span import Span
from msaa_lint.input.code.c.macros import merged
from msaa_lint.input.code.c.preprocessor import definitions, preprocessed, without_dead_code
from msaa_lint.input.code.parsing import Code
from msaa_lint.input.code.places import Piece, Places


def read(text: str, language: str = "cpp") -> str:
    """The text after preprocessing, with single blanks."""
    return " ".join(preprocessed(Code(text, language))[0].text.split())


@pytest.mark.parametrize(
    ("macros", "use", "expected"),
    [
        ("#define S(T, n) T n = {0}", "S(VkExtent2D, e);", "VkExtent2D e = {0};"),
        ("#define FN(x) pfn_##x", "FN(vkA)(1, 2);", "pfn_vkA(1, 2);"),
        ("#define CAT_(a, b) a ## b\n#define CAT(a, b) CAT_(a, b)\n#define N 4", "CAT(VK_, N);",
        "VK_4;"),
        ("#define STR(x) #x", 'STR(a "b" c);', r'"a \"b\" c";'),
        ("#define LOG(f, ...) print(f, ##__VA_ARGS__)", 'LOG("x"); LOG("x", 1, 2);', 'print("x"); '
            'print("x",1, 2);'),
        ("#define CALL(f, args...) f(args)", "CALL(g, 1, 2);", "g(1, 2);"),
        ("#define F(x) g(x)\n#define G F", "G(3);", "g(3);"),
        ("#define f(x) x + f(x)", "f(1);", "1 + f(1);"),
        ("#define A B\n#define B A", "A;", "A;"),
        ("#define LINES(a) \\\n  one(a); \\\n  two(a)", "LINES(3);", "one(3); two(3);"),
        ("#define P(x) q(x)", "P((a, b)); P(c{1, 2});", "q((a, b)); P(c{1, 2});"),
        ("#define ID(x) x", 'ID; "ID(1)" /* ID(1) */ ID (2) ID(ID(3))', 'ID; "ID(1)" /* ID(1) */ 2 '
            '3'),
        ("#define X(a) a;\n#define LIST X(1) X(2)", "LIST\n#undef X\n#define X(a) [a]\nLIST",
        "1; 2; [1] [2]"),
        ("#define CHECK(x) do { if (x) return; } while (0)", "CHECK(vkA());", "CHECK(vkA());"),
        ("#ifdef _WIN32\n#define API __declspec(dllexport)\n#else\n#define API\n#endif", "API int "
            "f();", "int f();"),
        ("#ifndef N\n#define N (1 + 2)\n#endif", "x = N;", "x = N;"),
        ("#if defined(A)\n#define F(x) g(x)\n#else\n#define F(x) h(x)\n#endif", "F(1);", "F(1);"),
        ("#ifdef A\n#define F(x) g(x)\n#endif", "F(1);", "g(1);"),
        ("#ifdef __cplusplus\n#define Z(T, n) T n{}\n#else\n#define Z(T, n) T n = {0}\n#endif",
        "Z(T, n);", "T n{};"),
    ],
)  # fmt: skip
def test_uses_of_macros(macros: str, use: str, expected: str) -> None:
    assert read(f"{macros}\n{use}\n")[-len(expected) :] == expected
    assert "#define S" not in read(f"{macros}\n{use}\n")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#if 0\na\n#endif\nb", "b"),
        ("#if 0\na\n#else\nb\n#endif", "b"),
        ("#if 1\na\n#elif X\nb\n#endif", "a"),
        ("#if false\na\n#elif X\nb\n#else\nc\n#endif", "#if X b #else c #endif"),
        ("#ifdef Q\na\n#elif 1\nb\n#else\nc\n#endif", "#ifdef Q a #else b #endif"),
        ("#define N 3\n#if N > 2 && defined(N)\na\n#else\nb\n#endif", "#define N 3 a"),
        ("#define N 3\n#if N > 2 && X\na\n#endif", "#define N 3 #if N > 2 && X a #endif"),
        ("#define N 3\n#if N < 2 && X\na\n#endif", "#define N 3"),
        ("#undef N\n#ifdef N\na\n#endif", ""),
        ("#ifndef N\n#define N 3\n#endif\n#if N == 3\na\n#endif", "#ifndef N #endif #if N == 3 a "
            "#endif"),
        ("#ifdef X\n#define N 3\n#endif\n#ifdef N\na\n#endif", "#ifdef X #define N 3 #endif #ifdef "
            "N a #endif"),
        ("#ifndef GUARD_H\n#define GUARD_H\na\n#endif", "a"),
        ("/*\n#if 0\n*/ a\n#ifdef X\nb\n#endif", "/* #if 0 */ a #ifdef X b #endif"),
        ("#if 0\n#if X\na\n#endif\nb\n#else\nc\n#endif", "c"),
        ("#ifdef X\nif (a) {\n#else\nif (b) {\n#endif\nc; }", "if (a) { c; }"),
        ("if (a) {\n#ifdef X\n} else if (b) {\n#endif\n}", "if (a) { } else if (b) { }"),
        ("#if __has_include(<x>)\na\n#endif", "#if __has_include(<x>) a #endif"),
    ],
)  # fmt: skip
def test_conditions(text: str, expected: str) -> None:
    assert read(f"{{\n{text}\n}}") == " ".join(f"{{ {expected} }}".split())


def test_conditions_outside_of_functions_are_left_out() -> None:
    """Their parts are read as if all of them existed."""
    assert (
        read("#ifdef X\nvoid f() {}\n#else\nvoid g() {}\n#endif\n#ifndef N\n#define N 3\n#endif")
        == "void f() {} void g() {}"
    )


def test_the_places_of_an_expansion() -> None:
    text = "#define T(f) { .a = f, .b = STORE }\nint x = T(g(1)); int y;\n"
    code, places, _ = preprocessed(Code(text, "c"))

    def place(part: str) -> str:
        start = code.text.index(part)
        at = places.original(Span(start, start + len(part)))
        return text[at.start : at.end]

    assert place("STORE") == "STORE"
    assert place("g(1)") == "g(1)"
    assert place("{ .a = g(1), .b = STORE }") == "T(g(1))"
    assert place("x = { .a = g(1), .b = STORE }") == "x = T(g(1))"
    assert place("int y;") == "int y;"


def test_pieces_keep_their_places_in_the_text_of_a_program() -> None:
    moved = Places([Piece(0, 0, 5).moved(10, 100), Piece(0, 7, 9, 4, 12).moved(15, 100)])
    assert moved.original(Span(11, 13)) == Span(101, 103)
    assert moved.original(Span(15, 17)) == Span(107, 109)
    assert moved.original(Span(12, 17)) == Span(102, 112)


def test_macros_of_other_files() -> None:
    one = definitions(Code("#define F(x) g(x)\n#define C 3\n#undef D\n", "cpp"))
    two = definitions(Code("#define F(x) g( x )\n#define C 4\n", "cpp"))
    shared = merged([one, two])
    assert len(shared["F"]) == 1
    assert len(shared["C"]) == 2
    assert preprocessed(Code("F(C)", "cpp"), shared)[0].text == "g(C)"


def test_expansions_are_bounded() -> None:
    """Each macro doubles the one before it."""
    text = (
        "#define M0 x x\n"
        + "".join(f"#define M{n} M{n - 1} M{n - 1}\n" for n in range(1, 60))
        + "M59\nM3\n"
    )
    code, _, unread = preprocessed(Code(text, "c"))
    assert code.text.split()[0] == "M59"
    assert len(code.text) < 2 * len(text)
    many = "#define M0 " + "x" * 100 + "\n#define M1 " + "M0 " * 100 + "\n" + "M1\n" * 100
    code, _places, unread = preprocessed(Code(many, "c"))
    assert len(code.text) < 2 * len(many) + 200_000
    assert re.match(
        r"the macros of the file expand to more than its own length and 100000 characters; from "
        r"`M1` on",
        unread[0].message,
    )
    assert many[unread[0].at.start : unread[0].at.end] == "M1"


def test_dead_code_is_blanked_in_place() -> None:
    text = "#if 0\nVK_SAMPLE_COUNT_4_BIT\n#endif\nlive"
    assert (
        without_dead_code(Code(text, "c")).text
        == " " * 5 + "\n" + " " * 21 + "\n" + " " * 6 + "\nlive"
    )
