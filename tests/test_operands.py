"""The conditions of the rules have no operand that no example of their page needs."""

from __future__ import annotations

import pytest

from tests import operands


@pytest.mark.parametrize(
    ("condition", "without"),
    [
        ("a && b", {"a", "b"}),
        ("a || b && !c", {"a", "b && !c", "a || b", "a || !c"}),
        (
            "(a || b) && x in ['&&']",
            {"(a || b)", "x in ['&&']", "(a ) && x in ['&&']", "( b) && x in ['&&']"},
        ),
        ("a ? b && c : d", {"a ? c : d", "a ? b : d"}),
        ("size(x) > 0", set()),
    ],
)
def test_operands_are_those_of_every_part(condition: str, without: set[str]) -> None:
    assert {" ".join(operand.rest.split()) for operand in operands.operands(condition)} == without


def test_examples_hold_the_operands(capsys: pytest.CaptureFixture[str]) -> None:
    """At least 97 % of them: without one, an example of its page fails."""
    assert operands.main([]) == 0, capsys.readouterr().out


def test_an_operand_that_nothing_needs_is_found() -> None:
    rule = next(
        rule for rule in operands.built_in().rules if rule.name == "multisampled-attachment-stored"
    )
    count, loose = operands.not_held(rule._replace(when=f"(1 == 1) && ({rule.when})"))
    assert count > 2
    assert "(1 == 1)" in [operand.text for operand in loose]
