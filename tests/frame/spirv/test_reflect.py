"""What shaders say of multisampling: modules of glslang, as they are and as spirv-opt rewrites
them.
"""

from __future__ import annotations

import array
import tempfile
from pathlib import Path
from typing import NamedTuple

import pytest

from msaa_lint.frame.spirv.reflect import Alpha, Multisampled, Reflected, Where, reflect
from msaa_lint.frame.spirv.words import SpirvError, instructions, words_of
from tests.frame.spirv.generate import EXAMPLE, RULES, SHADERS, compiled, optimised, sources

FIRST = Where(0, 0)
NO_ALPHA = Alpha(False, False, None)
ANY_ALPHA = Alpha(True, True, None)


def code(name: str) -> bytes:
    return (SHADERS / f"{name}.spv").read_bytes()


def several(count: int, resolves: str, where: Where = FIRST) -> Multisampled:
    """An image of which a loop fetches samples 0 to `count` - 1."""
    return Multisampled(
        where, tuple(range(count)), tuple(range(count)), count, False, True, resolves
    )


def maybe(count: int, resolves: str) -> Multisampled:
    """As `several`, where that hangs on conditions."""
    return several(count, resolves)._replace(always=())


class Said(NamedTuple):
    """What is expected of a shader."""

    images: tuple[Multisampled, ...] = ()
    alpha: Alpha = ANY_ALPHA
    built_ins: frozenset[str] = frozenset()
    sample_inputs: tuple[int | None, ...] = ()
    sample_rate_shading: bool = False
    interlock: bool = False
    discards: bool = False


EXPECTED = {
    "average.frag": Said((several(8, "AVERAGE", Where(1, 2)),)),
    "average_weights.frag": Said((several(4, "AVERAGE"),), Alpha(True, True, 1.0)),
    "average_unrolled.frag": Said((several(4, "AVERAGE")._replace(looped=False),), NO_ALPHA),
    "average_queried.frag": Said((Multisampled(FIRST, None, (), None, True, True, "AVERAGE"),)),
    "average_input.frag": Said((several(4, "AVERAGE", Where(0, 3, None, 1)),)),
    "average_branches.frag": Said((maybe(4, "AVERAGE"),)),
    "average_two.frag": Said((several(4, "AVERAGE"), several(4, "AVERAGE", Where(0, 1)))),
    "array_of_images.frag": Said(
        (several(2, "AVERAGE", Where(0, 4, 0)), several(4, "AVERAGE", Where(0, 4, 2)))
    ),
    "spec_arithmetic.frag": Said((several(2, "AVERAGE"),)),
    "storage.frag": Said((several(2, "AVERAGE"),)),
    "resolve.comp": Said((several(4, "AVERAGE"),), NO_ALPHA),
    "nearest.frag": Said((several(4, "MAX"), several(4, "MIN", Where(0, 1))), NO_ALPHA),
    "tone_mapped.frag": Said((several(4, "OTHER"),), Alpha(True, True, 1.0)),
    "weighted.frag": Said((several(4, "OTHER"),)),
    "used_twice.frag": Said((several(4, "OTHER"),)),
    "neighbours.frag": Said((several(4, "OTHER"),)),
    "wrong_divisor.frag": Said((several(4, "OTHER"),)),
    "early_end.frag": Said((maybe(8, "OTHER"),)),
    "partly.frag": Said((maybe(4, "OTHER"),)),
    "masked.frag": Said((maybe(4, "OTHER"),)),
    "unknown_bound.frag": Said((Multisampled(FIRST, None, (), None, False, True, "OTHER"),)),
    "first_sample.frag": Said((Multisampled(FIRST, (0,), (0,), 1, False, False, None),)),
    "per_sample.frag": Said(
        (Multisampled(FIRST, None, (), None, False, False, "OTHER"),),
        built_ins=frozenset({"SampleId"}),
        sample_rate_shading=True,
    ),
    "sample_position.frag": Said(
        (), Alpha(True, True, 1.0), frozenset({"SamplePosition"}), sample_rate_shading=True
    ),
    "sample_mask.frag": Said(built_ins=frozenset({"SampleMask"})),
    "sample_inputs.frag": Said(sample_inputs=(1, 3), sample_rate_shading=True),
    "block_member.frag": Said(sample_rate_shading=True),
    "unreached.frag": Said(alpha=Alpha(True, True, 1.0)),
    "alpha_stored.frag": Said(discards=True),
    "alpha_missing.frag": Said(alpha=Alpha(True, False, None)),
    "no_alpha.frag": Said(alpha=NO_ALPHA),
    "alpha_one.frag": Said(alpha=Alpha(True, True, 1.0)),
    "alpha_elsewhere.frag": Said(alpha=NO_ALPHA),
    "alpha_component.frag": Said(),
    "alpha_array.frag": Said(),
    "depth_only.frag": Said(alpha=NO_ALPHA),
    "interlock.frag": Said(alpha=NO_ALPHA, interlock=True),
}
"""By shader; the comments in its source say what it is for."""

UNROLLED = (
    "--inline-entry-points-exhaustive", "--private-to-local", "--eliminate-local-single-block",
    "--eliminate-local-single-store",
    "--ssa-rewrite", "--ccp", "--loop-unroll", "--eliminate-dead-branches",
    "--eliminate-dead-code-aggressive", "--simplify-instructions",
    "--scalar-replacement=100",
)  # fmt: skip
WAYS = {"as it is": (), "optimised": ("-O",), "for size": ("-Os",), "unrolled": UNROLLED}


def unlooped(image: Multisampled) -> Multisampled:
    return image._replace(looped=False)


def said(found: Reflected) -> Said:
    own = sorted(found.images, key=str)
    return Said(
        tuple(own),
        found.alpha,
        found.built_ins,
        found.sample_inputs,
        found.sample_rate_shading,
        found.interlock,
        found.discards,
    )


@pytest.mark.parametrize("folder", [SHADERS, RULES, EXAMPLE], ids=["tests", "rules", "example"])
def test_the_code_is_that_of_the_source(folder: Path) -> None:
    assert sorted(path.name for path in folder.glob("*.spv")) == [
        f"{path.name}.spv" for path in sources(folder)
    ]
    for source in sources(folder):
        made, there = (
            words_of(compiled(source)),
            words_of(source.with_name(f"{source.name}.spv").read_bytes()),
        )
        # The generator's version is its own.
        assert [list(each) for _, each in instructions(made)] == [
            list(each) for _, each in instructions(there)
        ], source.name


def test_every_shader_is_expected() -> None:
    assert sorted(EXPECTED) == [path.name for path in sources(SHADERS)]


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", EXPECTED)
def test_what_a_shader_says(name: str, way: str) -> None:
    passes = WAYS[way]
    found = reflect(optimised(code(name), *passes) if passes else code(name))
    expected = EXPECTED[name]
    images = sorted(expected.images, key=str)
    own = said(found)
    # Unrolling leaves no loop.
    assert own == expected._replace(images=tuple(images)) or way == "unrolled"
    assert own._replace(images=tuple(map(unlooped, own.images))) == expected._replace(
        images=tuple(map(unlooped, images))
    )
    assert found.followed
    assert (found.stage, found.name) == (
        "COMPUTE" if name.endswith(".comp") else "FRAGMENT",
        "main",
    )


def swapped(given: bytes) -> bytes:
    words = array.array("I", given)
    words.byteswap()
    return words.tobytes()


@pytest.mark.parametrize("name", EXPECTED)
def test_the_order_of_bytes_does_not_matter(name: str) -> None:
    assert reflect(swapped(code(name))) == reflect(code(name))


# Operands


@pytest.mark.parametrize(
    ("name", "operands"),
    [
        ("average.frag", [("LOOP", (0, 1, 2, 3, 4, 5, 6, 7))]),
        (
            "average_unrolled.frag",
            [("CONSTANT", (0,)), ("CONSTANT", (1,)), ("CONSTANT", (2,)), ("CONSTANT", (3,))],
        ),
        ("used_twice.frag", [("CONSTANT", (0,)), ("LOOP", (1, 2, 3))]),
        ("first_sample.frag", [("CONSTANT", (0,)), ("CONSTANT", (0,))]),
        ("per_sample.frag", [("CURRENT", ())]),
        ("sample_position.frag", []),
    ],
)
def test_what_the_sample_operand_is(name: str, operands: list[tuple[str, tuple[int, ...]]]) -> None:
    assert [(fetch.operand, fetch.samples) for fetch in reflect(code(name)).fetches] == operands


def test_a_loop_of_unknown_length_is_unknown() -> None:
    (fetch,) = reflect(code("unknown_bound.frag")).fetches
    assert (fetch.image, fetch.operand) == (FIRST, "UNKNOWN")


# Specialisation


@pytest.mark.parametrize("count", [2, 4, 8, 16])
def test_a_specialisation_constant_counts(count: int) -> None:
    (image,) = reflect(code("average.frag"), specialization={0: count}).images
    assert image == several(count, "AVERAGE", Where(1, 2))


@pytest.mark.parametrize("value", [4, 4.0])
def test_a_whole_number_is_an_integer_however_it_is_written(value: float) -> None:
    assert reflect(code("average.frag"), specialization={0: value}).images == (
        several(4, "AVERAGE", Where(1, 2)),
    )


def test_another_constant_does_not_count() -> None:
    assert reflect(code("average.frag"), specialization={1: 4}) == reflect(code("average.frag"))


@pytest.mark.parametrize("value", [4.5, float("inf"), float("nan")])
def test_a_constant_that_cannot_be_is_unknown(value: float) -> None:
    (image,) = reflect(code("average.frag"), specialization={0: value}).images
    assert (image.samples, image.resolves) == (None, "OTHER")


@pytest.mark.parametrize(
    ("constants", "expected"),
    [
        ({}, several(2, "AVERAGE")),
        ({3: 3}, several(8, "AVERAGE")),
        ({3: 2, 5: 1}, Multisampled(FIRST, (1, 2, 3), (1, 2, 3), None, False, True, "OTHER")),
        ({3: 2, 4: False}, Multisampled(FIRST, (3,), (3,), None, False, False, None)),
        ({3: 0, 4: False}, Multisampled(FIRST, (0,), (0,), 1, False, False, None)),
    ],
)
def test_constants_made_of_constants(
    constants: dict[int, float | bool], expected: Multisampled
) -> None:
    """A shift makes the count of one, a boolean decides which way is taken, an unsigned one is
    where the loop begins.
    """
    assert reflect(code("spec_arithmetic.frag"), specialization=constants).images == (expected,)


@pytest.mark.parametrize("constants", [{3: 0}, {3: 2}, {3: 3, 5: 1}, {3: 4, 5: 8}])
def test_specialised_is_as_if_written_so(constants: dict[int, float | bool]) -> None:
    """spirv-opt writes the values into the module, and folds all that is made of them."""
    values = " ".join(f"{identity}:{value}" for identity, value in constants.items())
    given = code("spec_arithmetic.frag")
    written = optimised(
        given,
        f"--set-spec-const-default-value={values}",
        "--freeze-spec-const",
        "--fold-spec-const-op-composite",
        "-O",
    )
    assert said(reflect(written)) == said(reflect(given, specialization=constants))


# Entry points


def test_the_entry_point_is_found_by_its_name() -> None:
    assert reflect(code("average.frag"), "main") == reflect(code("average.frag"))
    with pytest.raises(SpirvError, match="it has no entry point `shade`, but `main`"):
        reflect(code("average.frag"), "shade")


def with_second_entry(name: str, model: int, called: bytes) -> bytes:
    """A module with its entry point a second time, under another name or for another stage."""
    words = words_of(code(name))
    made = words[:5]
    for number, each in instructions(words):
        made += each
        if number == 15:
            text = array.array("I", called + bytes(4 - len(called) % 4))
            own = array.array("I", [0, model, each[2], *text, *each[5:]])
            own[0] = len(own) << 16 | 15
            made += own
    return made.tobytes()


def test_of_two_with_one_name_the_fragment_shader_is_meant() -> None:
    assert reflect(with_second_entry("average.frag", 0, b"main"), "main").stage == "FRAGMENT"


def test_of_several_fragment_shaders_the_name_is_needed() -> None:
    both = with_second_entry("average.frag", 4, b"other")
    assert reflect(both, "other").images == reflect(both, "main").images != ()
    with pytest.raises(SpirvError, match="it has several entry points: `main`, `other`"):
        reflect(both)


def test_a_vertex_shader_is_told_from_the_fragment_shader_beside_it() -> None:
    both = with_second_entry("average.frag", 0, b"vertices")
    assert reflect(both).stage == "FRAGMENT"
    assert reflect(both, "vertices").stage == "VERTEX"


# Bounds


def test_a_shader_that_takes_too_many_steps_is_given_up() -> None:
    found = reflect(nested(10))
    assert not found.followed
    assert found.alpha == Alpha(True, None, None)
    assert all((image.samples, image.resolves) == (None, "OTHER") for image in found.images)
    assert all(fetch.operand == "UNKNOWN" for fetch in found.fetches)


def nested(depth: int) -> bytes:
    """A shader that fetches within so many loops of eight rounds."""
    loops = "".join(f"for (int i{n} = 0; i{n} < 8; i{n}++) " for n in range(depth))
    text = f"""#version 450
layout(binding = 0) uniform sampler2DMS scene;
layout(location = 0) out vec4 color;
void main() {{ vec4 sum = vec4(0.0); {loops} sum += texelFetch(scene, ivec2(i0), i1); color = sum; }}
"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "nested.frag")
        path.write_text(text, encoding="utf-8")
        return compiled(path)


def test_what_is_not_asked_is_not_followed() -> None:
    from msaa_lint.frame.spirv.module import Module
    from msaa_lint.frame.spirv.reflect import reflected

    plain = reflected(Module(code("alpha_one.frag")), None, {}, alpha=False)
    assert (plain.followed, plain.alpha) == (False, Alpha(True, None, None))
    fetching = reflected(Module(code("average.frag")), None, {}, alpha=False)
    assert fetching == reflect(code("average.frag"))
