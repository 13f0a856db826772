"""Words, numbers, and values that readers must survive at any place of an input, and text of each
language that is valid only at some.
"""

from __future__ import annotations

from typing import Any

NUMBERS = (
    "-1", "0", "-0", "1", "3", "0.5", "2147483647", "2147483648", "4294967295", "4294967296",
    "9223372036854775808",
    "18446744073709551616", "-9223372036854775809", "1e308", "-1e308", "1e400", "1e-400",
    "9" * 5000, "0x" + "f" * 40,
)  # fmt: skip
WORDS = (
    "", " ", "\0", "a" * 100_000, "\u202eabc\u2066", "\u200b\ufeff", "\x1b]0;title\x07\x1b[31m",
    "`", "'", '"', "\\", "%s{0}{x}",
    "../../../x",
    "/dev/zero", "/dev/stdin", "C:\\x", "~", "<<", "\u0130\u017f\ufb01", "\U0001f600" * 50,
    "e" + "\u0301" * 3000, "::error::x", "$(x)",
    "\ud800", "\r", "\x85\u2028",
)  # fmt: skip
SNIPPETS = {
    "yaml": (
        "null", "~", "[]", "{}", "[[]]", "{a: b}", "!!python/object:os.system x", "!!binary aGk=",
        "!!set {a, b}", "!!omap [a: b]",
        "!x y",
        "2001-01-01", "0o7", "017", "1:30", "1_000", ".inf", "-.inf", ".nan", "true", "yes",
        '"\\ud800"', '"\\0"', "&a [*a]",
        "&a {b: *a}",
        "*a", "*undefined", "<<: *a", "{<<: 3}", "{<<: [1, {a: 2}]}", "{<<: {<<: {a: 1}}}",
        "{[a, b]: c}", "{{a: b}: c}", "? [a]\n: b",
        "{1: 2, null: 3, 1.5: 4, true: 5}", "|\n  x", ">-\n\n", "[", "]", "{", "}", "%YAML 9.9\n"
            "---\n", "\n---\n", "\n...\n", "\t", "#",
        ": ", "- ",
        "[" * 200, "[" * 100_000, "{a: " * 5000, "- " * 5000, "? " * 5000, "&a " * 10, "[1, 2, 3, "
            "4]", "[null]", "[{}]", "[[a, b], [c]]",
    ),
    "json": (
        "null", "[]", "{}", "[[]]", "[null]", "[{}]", '{"a": 1, "a": 2}', '{"": 0}', "true", "NaN",
        "Infinity", "-Infinity", '"\\ud800"',
        '"\\udc00\\ud800"', '"\\u0000"', "[" * 200, "[" * 100_000, '{"a":' * 100_000, "1.", ".5",
        "01", "1e", "'a'", "// x\n", "/*",
        ",", ":", "}{", "\ufeff",
    ),
    "toml": (
        "inf", "-inf", "nan", "1979-05-27T07:32:00Z", "07:32:00", "'''x'''", '"""', "0b1", "0o7",
        "1_000", '"\\uD800"', "[]", "[[]]",
        "{}",
        "{a = {b = 1}}", "[1, 'a', {}]", "\n[x]\n", "\n[[x]]\n", "\n[tool.msaa-lint]\n",
        "\n[a.b.c]\n", "a.b.c = 1\n", "\n'' = 1\n",
        "\n\"\\u0000\" = 1\n",
        "[" * 5000, "{a=" * 3000, "true", "x." * 5000, "=", "#", "'''",
    ),
    "xml": (
        '<!DOCTYPE a [<!ENTITY b "x"><!ENTITY c "&b;&b;&b;">]>', '<!DOCTYPE a [<!ENTITY b SYSTEM '
            '"file:///etc/passwd">]>', "&c;", "&b;",
        "&#0;",
        "&#x110000;", "<![CDATA[", "]]>", "<!--", "-->", "<?x", '<?xml version="1.0" '
            'encoding="UTF-16"?>',
        '<?xml version="1.0" encoding="no-such"?>',
        "<a>" * 200, "<a>" * 100_000, "</a>", "/>", "<", ">", '"', "<a b='1' b='2'/>", "<x:y/>",
    ),
    "code": (
        "(", ")", "{", "}", "[", "]", "<", ">", ";", ",", ".", "->", "::", "=", "==", "?", ":",
        "&", "*", "#", "\\\n", "/*", "//", "'",
        '"', 'R"(',
        "#if 0\n", "#else\n", "#endif\n", "#define X X\n", "#define F(x) F(x) F(x)\n", "#include "
            "<x>\n", "1 << 200", "1 << -1", "1 / 0",
        "1 % 0", "~0u", "-1",
        "sizeof(int)", "1.0e999", "0xFFFFFFFFFFFFFFFFFFu", "a ? b : c",
        "[&](auto x) { return x; }", "{{{}}}", "{0}", "(((((0)))))",
        "(" * 3000, "{" * 3000,
        "a.b" * 1000, "x = x + x;", "VK_SAMPLE_COUNT_64_BIT", "return", "if (a)", "for (;;)",
        "while (1)", "switch (x) { case 1: }",
        "template <class T>",
        "goto x;", "static", "const", "auto", "struct A { A a; };", "enum { A = B, B = A };",
        "case 1 ... 5:", "nil",
        "guard let x else { return }",
    ),
    "page": ("---\n", "```yaml bad\n", "```\n", "#   ^^^^\n", "{frame.api}", "{x}", "{{", "}}",
    "{0!r}", "{" * 3000, "code: MSAA101\n"),
    "cel": (
        "true", "1 + 1", "1 / 0", "'a' + 1", "frame", "pass", "9223372036854775807 + 1",
        "[1, 2].map(x, x)", "matches('a', '(a+)+$')",
        "size('')", "(" * 500,
        "!" * 500, "a.b.c", "x ? y : z", "[1].exists(x, [1].exists(y, x == y))", "b'\\xff'",
        "timestamp('x')", "duration('1s')",
        "dyn(1)", "has(frame.x)",
    ),
    "glob": ("*", "**", "***", "!", "[", "[a-", "[!", "[[:alpha:]]", "\\", "{a,b}", "?" * 500,
    "*" * 500, "*a" * 300, "/", "//", "../",
    "#", "a/**/b/**/c\n"),
    "comment": (
        "# msaa-lint: ignore\n", "# msaa-lint: ignore[", "# msaa-lint: ignore[all]", "# msaa-lint: "
            "ignore-file\n",
        "// msaa-lint: ignore[x] -- reason\n",
        "# msaa-lint: disable-next-line ", "/* msaa-lint: ignore */", "# msaa-lint:",
        "# msaa-lint: ignore[" + "a," * 3000 + "]\n",
    ),
    "mesh": (
        "f 0 0 0\n", "f -1 -2 -3\n", "f 1 2\n", "f 1\n", "f\n", "f 1/1/1 2//2 3/\n",
        "f 1 2 99999999999\n", "f -9 1 2\n", "v\n",
        "v nan nan nan\n", "v inf 0 0\n",
        "v 1e308 -1e308 1e308\n", "v 1 2\n", "v 1 2 3 4 5 6 7 8\n", "vt 0 0\n", "vn 0 0 1\n",
        "o x\n", "g y\n", "usemtl z\n",
        "mtllib /etc/passwd\n", "l 1 2\n",
        "element vertex 4294967296\n", "element face -1\n", "property list uchar int "
            "vertex_indices\n",
        "property list double double vertex_indices\n",
        "format binary_big_endian 1.0\n", "format ascii 1.0\n", "end_header\n", "property float "
            "x\n",
        "comment TextureFile /etc/passwd\n", "s off\n", "\\\n",
    ),
    "binary": (),
}  # fmt: skip
"""Text in a format's language that is valid only at other places, or nowhere."""

EXTREMES: tuple[Any, ...] = (
    None, True, False, -1, 0, 1, 3, 2**31, 2**32 - 1, 2**63, 2**64, -(2**70), 0.5, 1e308,
    float("nan"), float("inf"), [], {}, [None],
    [[]], [{}],
    {"": None}, {"a": {"b": []}}, "", "\0", "\u202e", "x" * 5000, "0", "-1", "1e400",
    "VK_SAMPLE_COUNT_4_BIT", "0x10",
)  # fmt: skip
