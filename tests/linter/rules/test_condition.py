"""Conditions: three-valued, typed, bounded, and wrong at a place."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.linter.rules.condition import (
    Condition,
    ConditionError,
    activation,
    check,
    literals,
    named,
)
from msaa_lint.linter.rules.rule_file import MAX_CONDITION
from tests.strength import examples

TEXTS = {
    "image.transient": "image.transient",
    "image.loaded": "image.loaded",
    "image.read": "image.read",
}


def holds(text: str, subject: str = "image", **facts: Any) -> bool | None:
    known = {name.replace("__", "."): value for name, value in facts.items() if value is not None}
    return Condition(text, subject).holds(activation(subject, known))


def both(one: bool | None, other: bool | None) -> bool | None:
    return False if False in (one, other) else None if None in (one, other) else True


@pytest.mark.parametrize(("one", "other"), list(itertools.product([True, False, None], repeat=2)))
def test_and_and_or_take_an_unknown_where_the_other_side_decides(
    one: bool | None, other: bool | None
) -> None:
    facts = {"image__transient": one, "image__loaded": other}
    assert holds("image.transient && image.loaded", **facts) is both(one, other)
    either = both(None if one is None else not one, None if other is None else not other)
    assert holds("image.transient || image.loaded", **facts) is (
        None if either is None else not either
    )
    assert holds("!(image.transient && image.loaded)", **facts) is (
        None if both(one, other) is None else not both(one, other)
    )


@pytest.mark.parametrize(
    ("text", "facts", "answer"),
    [
        ("image.samples > 1", {"image__samples": 4}, True),
        ("image.samples > 1", {"image__samples": 1}, False),
        ("image.samples > 1", {}, None),
        ("!(image.samples > 1)", {}, None),
        ('image.format == "D16_UNORM"', {"image__format": "D16_UNORM"}, True),
        ('"SAMPLED" in image.usage', {"image__usage": ["SAMPLED"]}, True),
        ('"SAMPLED" in image.usage', {"image__usage": []}, False),
        ('"SAMPLED" in image.usage', {}, None),
        ('image.format in ["D16_UNORM", "D32_SFLOAT"]', {"image__format": "D32_SFLOAT"}, True),
        (
            "image.transient ? image.samples > 1 : image.loaded",
            {"image__transient": False, "image__loaded": True},
            True,
        ),
        ("image.transient ? image.samples > 1 : image.loaded", {"image__samples": 4}, None),
        (
            'image.usage.exists(usage, usage == "SAMPLED")',
            {"image__usage": ["STORAGE", "SAMPLED"]},
            True,
        ),
        (
            "image.supported_samples.all(count, count <= 4)",
            {"image__supported_samples": [1, 4]},
            True,
        ),
        ("size(image.usage) == 0", {"image__usage": []}, True),
        ("double(image.samples) * 0.5 == 2.0", {"image__samples": 4}, True),
        ("device.known && image.samples > 1", {"device__known": False}, False),
        ("1 / 0 == 1 || true", {}, True),
        (
            '// a comment with a " quote and image.nonsense\nimage.samples > 1',
            {"image__samples": 4},
            True,
        ),
    ],
)
def test_answers(text: str, facts: dict[str, Any], answer: bool | None) -> None:
    check(text, "image")
    assert holds(text, **facts) is answer


@examples(1)
@given(
    st.recursive(
        st.sampled_from(list(TEXTS)),
        lambda inner: st.tuples(st.sampled_from(["&&", "||", "!"]), inner, inner),
        max_leaves=6,
    ),
    st.data(),
)
def test_knowing_more_never_changes_a_decision(tree: Any, data: st.DataObject) -> None:
    """Kleene's logic: what is decided with a fact unknown is decided the same whatever the fact
    is.
    """
    text = written(tree)
    values = {name: data.draw(st.sampled_from([True, False, None])) for name in TEXTS}
    answer = Condition(text, "image").holds(
        activation("image", {n: v for n, v in values.items() if v is not None})
    )
    for more in itertools.product([True, False], repeat=len(TEXTS)):
        known = {
            name: value if values[name] is None else values[name]
            for name, value in zip(TEXTS, more, strict=True)
        }
        decided = Condition(text, "image").holds(activation("image", known))
        assert decided is not None
        assert answer in (None, decided)


def written(tree: Any) -> str:
    if isinstance(tree, str):
        return tree
    operator, one, other = tree
    return (
        f"!({written(one)})" if operator == "!" else f"({written(one)} {operator} {written(other)})"
    )


@pytest.mark.parametrize(
    "text",
    [
        "1 / (image.samples - 4) == 1",
        "9223372036854775807 + image.samples > 0",
        "image.supported_samples[7] == 1",
    ],
)
def test_what_cannot_be_worked_out_is_an_error_and_not_unknown(text: str) -> None:
    check(text, "image")
    with pytest.raises(ArithmeticError):
        holds(text, image__samples=4, image__supported_samples=[1])


@pytest.mark.parametrize(
    ("text", "message", "at"),
    [
        (
            "image.sampels > 1",
            "unknown fact image.sampels of image; did you mean image.samples?",
            "image.sampels",
        ),
        (
            "true &&\n  image.sampels > 1",
            "unknown fact image.sampels of image; did you mean image.samples?",
            "image.sampels",
        ),
        (
            '"\U0001f600" == image.name && image.sampels > 1',
            "unknown fact image.sampels of image; did you mean image.samples?",
            "image.sampels",
        ),
        (
            "imagee.samples > 1",
            "unknown fact imagee.samples of image; did you mean image.samples?",
            "imagee.samples",
        ),
        (
            "resolve.mode == 'AVERAGE'",
            "unknown fact resolve.mode of image; it is a fact of resolve",
            "resolve.mode",
        ),
        ("samples > 1", "unknown fact samples of image; did you mean image.samples?", "samples"),
        (
            'image.format == "D17_UNORM"',
            "image.format is never 'D17_UNORM'; did you mean 'D16_UNORM'?",
            '"D17_UNORM"',
        ),
        (
            "image.format != 'D17_UNORM'",
            "image.format is never 'D17_UNORM'; did you mean 'D16_UNORM'?",
            "'D17_UNORM'",
        ),
        (
            '"D17_UNORM" == image.format',
            "image.format is never 'D17_UNORM'; did you mean 'D16_UNORM'?",
            '"D17_UNORM"',
        ),
        (
            'image.format in ["D16_UNORM", "D17_UNORM"]',
            "image.format is never 'D17_UNORM'; did you mean 'D16_UNORM'?",
            '"D17_UNORM"',
        ),
        (
            '"SAMPLE" in image.usage',
            "image.usage is never 'SAMPLE'; did you mean 'SAMPLED'?",
            '"SAMPLE"',
        ),
        (
            'image.format == r"D17_UNORM"',
            "image.format is never 'D17_UNORM'; did you mean 'D16_UNORM'?",
            'r"D17_UNORM"',
        ),
        ('image.encoding == "SRGB"', "image.encoding is never 'SRGB'", '"SRGB"'),
        ('device.vendor == "ARM"', "device.vendor is never 'ARM'; did you mean 'arm'?", '"ARM"'),
        ("image.samples", "the condition must be a boolean expression, found int", None),
        ("dyn(image.samples)", "the condition must be a boolean expression, found dyn", None),
        ('image.samples == "4"', "`==` cannot be applied to int and string", "="),
        (
            "image.usage in ['SAMPLED']",
            "`in` cannot be applied to list(string) and list(string)",
            "i",
        ),
        (
            "image.samples > 1 and image.is_color",
            "unexpected `and` in the condition: write `&&`",
            "and",
        ),
        ("image.samples = 4", "unexpected `=` in the condition: write `==`", "="),
        ("image.samples > && image.is_color", "unexpected `&&` in the condition", "&&"),
        ("image.samples >", "the condition is incomplete", None),
        (
            "image.format == D32_SFLOAT",
            'unknown fact D32_SFLOAT of image; a text is written in quotes: "D32_SFLOAT"',
            "D32_SFLOAT",
        ),
        (
            "image.zzz",
            "unknown fact image.zzz of image; `msaa-lint facts` lists the facts",
            "image.zzz",
        ),
        ("image.samples > 1.0 +", None, ""),
        ("", None, ""),
        ("\U0001f600 > 2", None, "\U0001f600"),
    ],
)
def test_what_is_wrong_and_where(text: str, message: str | None, at: str | None) -> None:
    with pytest.raises(ConditionError) as raised:
        check(text, "image")
    if message is not None:
        assert str(raised.value) == message
    if at is None:
        assert raised.value.offset is None
    elif at:
        offset = raised.value.offset
        assert offset is not None
        assert text[offset : offset + raised.value.length] == at


@pytest.mark.parametrize(
    "subject", ["image", "attachment", "aspect", "subpass", "resolve", "pipeline", "dependency"]
)
def test_a_subject_has_its_own_facts(subject: str) -> None:
    check("frame.has_commands && device.known", subject)
    with pytest.raises(ConditionError):
        check("elsewhere.fact == 1", subject)
    if subject != "image":
        check("pass.custom_resolve", subject)
    else:
        with pytest.raises(ConditionError):
            check("pass.custom_resolve", subject)


MANY = "the condition uses all, exists, exists_one, map and filter more than 2 times"


@pytest.mark.parametrize(
    ("text", "fine"),
    [
        ("[1].all(x, [1].exists(y, x == y))", True),
        ("[1].all(x, [1].exists(y, [1].all(z, z == x)))", False),
        ("[1].all(x, true) && [1].all(x, true) && [1].all(x, true)", False),
        (
            "[1] . map ( x, x) == [1] && [1].filter(x, true) == [1] && [1].exists_one(x, true)",
            False,
        ),
        ("[1].\nall(x, [1]. // comment\nall(y, [1].//\nall(z, true)))", False),
        ('image.name == "a.all(b.all(c.all("', True),
    ],
)
def test_loops_are_bounded(text: str, fine: bool) -> None:
    if fine:
        check(text, "image")
    else:
        with pytest.raises(ConditionError, match="more than 2 times"):
            check(text, "image")


HOSTILE = [
    "(" * 900 + "true" + ")" * 900,
    "!" * 1990 + "true",
    "-" * 1900 + "1 == 1",
    "[" * 900 + "]" * 900 + " == []",
    " && ".join(["true"] * 220),
    "true ? " * 140 + "true" + " : true" * 140,
    "9" * 1900 + " > 1",
    '"' + "a" * 1900,
    "image.name.matches('(a*)*b')",
    "image.name.matches('((((a{0,100}){0,100}){0,100}))b')",
    "[" + ",".join("1" * 400) + "].all(x, [" + ",".join("1" * 400) + "].all(y, x == y))",
    'image.name + image.name + image.name == "' + "a" * 1000 + '"',
    "{" * 900,
    "image." * 300 + "samples > 1",
    "\0" * 100,
    "image.name == '\\ud800'",
]


@pytest.mark.parametrize("text", HOSTILE, ids=lambda text: text[:20])
def test_hostile_conditions_end(text: str) -> None:
    """Refused, or answered, or an error: no crash and no endless work."""
    assert len(text) <= MAX_CONDITION
    try:
        check(text, "image")
        holds(text, image__name="a" * 5000)
    except (ConditionError, ArithmeticError) as error:
        assert str(error)


def test_facts_that_are_named() -> None:
    assert named(
        'image.samples > 1 && (image.format == "image.usage" || image.samples > 4) // image.read'
    ) == (
        "image.samples",
        "image.format",
    )
    assert named("image.name.matches('x')") == ("image.name",)
    assert Condition("image.samples > 1 || image.read", "image").facts == (
        "image.samples",
        "image.read",
    )


def test_literals_and_where_they_stand() -> None:
    text = "image.format == 'A' && \"B\" in image.usage // 'C'\n && image.tiling in ['D', r\"E\"]"
    found = [
        (fact, literal, text[offset : offset + length])
        for fact, literal, offset, length in literals(text)
    ]
    assert found == [
        ("image.format", "A", "'A'"),
        ("image.usage", "B", '"B"'),
        ("image.tiling", "D", "'D'"),
        ("image.tiling", "E", 'r"E"'),
    ]
