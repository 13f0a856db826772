"""That a shader averages is said only where it does: random sums of samples against their
weights.
"""

from __future__ import annotations

import tempfile
from fractions import Fraction
from pathlib import Path
from typing import NamedTuple

from hypothesis import example, given
from hypothesis import strategies as st

from msaa_lint.frame.spirv.reflect import reflect
from tests.frame.spirv.generate import compiled
from tests.strength import examples


class Term(NamedTuple):
    """An expression of GLSL, and how much of each sample is in it."""

    text: str
    weights: dict[int, Fraction]


def fetched(sample: int) -> Term:
    return Term(f"texelFetch(scene, at, {sample})", {sample: Fraction(1)})


def added(one: Term, other: Term, sign: int) -> Term:
    samples = {*one.weights, *other.weights}
    weights = {
        sample: one.weights.get(sample, Fraction(0)) + sign * other.weights.get(sample, Fraction(0))
        for sample in samples
    }
    return Term(f"({one.text} {'+' if sign > 0 else '-'} {other.text})", weights)


def scaled(one: Term, factor: Fraction, divides: bool) -> Term:
    text = f"({one.text} / {float(1 / factor)})" if divides else f"({one.text} * {float(factor)})"
    return Term(text, {sample: weight * factor for sample, weight in one.weights.items()})


def whole(count: int, swapped: bool) -> Term:
    """The sum of the first samples, from either end."""
    terms = [fetched(n) for n in range(count)]
    made, *rest = reversed(terms) if swapped else terms
    for term in rest:
        made = added(made, term, 1)
    return made


FACTORS = st.sampled_from(
    [Fraction(1, 8), Fraction(1, 4), Fraction(1, 2), Fraction(2), Fraction(-1)]
)
TERMS = st.recursive(
    st.one_of(
        st.builds(fetched, st.integers(0, 3)),
        st.builds(whole, st.sampled_from([2, 4]), st.booleans()),
    ),
    lambda inner: st.one_of(
        st.builds(added, inner, inner, st.sampled_from([1, 1, 1, -1])),
        st.builds(scaled, inner, FACTORS, st.booleans()),
    ),
    max_leaves=6,
)


def resolved(term: Term) -> tuple[str | None, tuple[int, ...] | None]:
    """What is said of a shader that puts out a sum, and the samples that it fetches."""
    source = f"""#version 450
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;
void main() {{
    ivec2 at = ivec2(gl_FragCoord.xy);
    color = {term.text};
}}
"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "sum.frag")
        path.write_text(source, encoding="utf-8")
        (image,) = reflect(compiled(path)).images
    return image.resolves, image.samples


@examples(0.6)
@given(TERMS)
@example(scaled(whole(4, True), Fraction(1, 4), True))
@example(added(scaled(whole(2, False), Fraction(1, 2), False), fetched(0), 1))
@example(
    added(
        scaled(whole(4, False), Fraction(1, 4), False),
        scaled(whole(2, False), Fraction(1, 2), False),
        1,
    )
)
def test_an_average_weighs_all_samples_alike(term: Term) -> None:
    resolves, samples = resolved(term)
    assert samples == tuple(sorted(term.weights))
    if resolves == "AVERAGE":
        assert samples == tuple(range(len(samples))) and len(samples) > 1
        assert len(set(term.weights.values())) == 1, "an average, or a multiple of one"


@examples(0.25)
@given(st.sampled_from([2, 4]), st.booleans(), st.booleans())
def test_a_plain_average_is_found(count: int, swapped: bool, divides: bool) -> None:
    assert resolved(scaled(whole(count, swapped), Fraction(1, count), divides))[0] == "AVERAGE"


@examples(0.25)
@given(
    st.permutations(range(4)),
    st.one_of(st.just([Fraction(1, 4)] * 4), st.lists(FACTORS, min_size=4, max_size=4)),
)
def test_weighed_samples_are_an_average_if_the_weights_are(
    order: list[int], factors: list[Fraction]
) -> None:
    made, *rest = (scaled(fetched(sample), factors[sample], False) for sample in order)
    for term in rest:
        made = added(made, term, 1)
    assert (resolved(made)[0] == "AVERAGE") == (set(factors) == {Fraction(1, 4)})
