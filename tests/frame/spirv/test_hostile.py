"""Bytes of anyone: read, or refused by one kind of error, in bounded steps."""

from __future__ import annotations

import array
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from msaa_lint.frame.spirv import state
from msaa_lint.frame.spirv.module import MAX_BYTES, Module
from msaa_lint.frame.spirv.reflect import Reflected, reflect
from msaa_lint.frame.spirv.words import SpirvError, words_of
from tests.frame.spirv.generate import RULES, SHADERS
from tests.strength import examples

MODULES = [
    path.read_bytes() for folder in (SHADERS, RULES) for path in sorted(folder.glob("*.spv"))
]
SMALLEST = min(MODULES, key=len)
HEADER = words_of(SMALLEST)[:5]


def read(code: bytes) -> Reflected | None:
    """What is said; None where it is refused. Anything else than a SpirvError fails the test."""
    try:
        return reflect(code)
    except SpirvError as error:
        text = str(error)
        assert text.startswith(
            (
                "not SPIR-V: ",
                "it has no entry point",
                "it has several entry points",
                "it is larger",
                "several entry points",
            )
        )
        return None


def starts(code: bytes) -> set[int]:
    """The words that instructions begin at, and the end."""
    words = words_of(code)
    found, at = {5}, 5
    while at < len(words):
        at += words[at] >> 16
        found.add(at)
    return found


@pytest.mark.parametrize(
    "name", ["average.frag", "early_end.frag", "array_of_images.frag", "sample_inputs.frag"]
)
def test_code_that_is_cut_off_is_refused(name: str) -> None:
    """At every byte. Between two instructions outside of functions there is an entry point whose
    function is not there.
    """
    code = (SHADERS / f"{name}.spv").read_bytes()
    for length in range(len(code)):
        with pytest.raises(
            SpirvError,
            match="not SPIR-V" if length % 4 or length // 4 not in starts(code) else None,
        ):
            reflect(code[:length])


@pytest.mark.parametrize("name", ["average.frag", "spec_arithmetic.frag"])
def test_every_word_may_be_anything(name: str) -> None:
    code = (SHADERS / f"{name}.spv").read_bytes()
    for at in range(1, len(code) // 4):
        for value in (
            0,
            1,
            0xFFFFFFFF,
            0x0001FFFF,
            words_of(code)[at] ^ 1,
            words_of(code)[at] + 0x10000 & 0xFFFFFFFF,
        ):
            words = words_of(code)
            words[at] = value
            read(words.tobytes())


@pytest.mark.parametrize("name", ["average_unrolled.frag"])
def test_every_bit_may_be_flipped(name: str) -> None:
    code = bytearray((SHADERS / f"{name}.spv").read_bytes())
    for at in range(len(code)):
        for bit in range(8):
            code[at] ^= 1 << bit
            read(bytes(code))
            code[at] ^= 1 << bit


WORDS = st.one_of(
    st.integers(0, 2**32 - 1),
    st.integers(0, 120),
    st.builds(lambda length, op: length << 16 | op, st.integers(0, 9), st.integers(0, 400)),
)


@examples(4)
@given(
    st.sampled_from(MODULES),
    st.lists(st.tuples(st.integers(5, 10**6), WORDS), min_size=1, max_size=8),
)
def test_damaged_code_is_read_or_refused(code: bytes, damage: list[tuple[int, int]]) -> None:
    words = words_of(code)
    for at, value in damage:
        words[5 + at % (len(words) - 5)] = value
    read(words.tobytes())


@examples(3)
@given(
    st.sampled_from(MODULES), st.integers(5, 10**6), st.integers(5, 10**6), st.sampled_from(MODULES)
)
def test_two_modules_in_one_are_read_or_refused(
    one: bytes, at: int, begin: int, other: bytes
) -> None:
    first, second = words_of(one), words_of(other)
    read((first[: 5 + at % (len(first) - 5)] + second[5 + begin % (len(second) - 5) :]).tobytes())


@examples(3)
@given(st.lists(WORDS, max_size=60))
def test_random_words_are_read_or_refused(given_words: list[int]) -> None:
    read((HEADER + array.array("I", given_words)).tobytes())


@examples(1)
@given(st.binary(max_size=200))
def test_random_bytes_are_refused(data: bytes) -> None:
    assert read(data) is None


@examples(1)
@given(st.sampled_from(MODULES), st.lists(st.tuples(st.integers(5, 10**6), WORDS), max_size=4))
def test_damaged_code_is_the_same_in_both_orders(
    code: bytes, damage: list[tuple[int, int]]
) -> None:
    words = words_of(code)
    for at, value in damage:
        words[5 + at % (len(words) - 5)] = value
    other = array.array("I", words)
    other.byteswap()
    # Not equal where something is not a number.
    assert repr(read(words.tobytes())) == repr(read(other.tobytes()))


# Made to take long


def assembled(*instructions: tuple[int, ...]) -> bytes:
    """A module of instructions, each a number and operands."""
    made = array.array("I", HEADER)
    for number, *operands in instructions:
        made.extend([(len(operands) + 1) << 16 | number, *operands])
    return made.tobytes()


START = (
    (15, 4, 1, 0x6E69616D, 0),
    (19, 2),
    (33, 3, 2),
    (20, 4),
    (21, 5, 32, 0),
    (41, 4, 6),
    (43, 5, 7, 0),
)
"""An entry point `main` that is function 1, types (2 void, 3 function, 4 boolean, 5 integer),
constants (6 true, 7 zero).
"""


def body(*instructions: tuple[int, ...]) -> bytes:
    return assembled(*START, (54, 2, 1, 0, 3), (248, 10), *instructions, (56,))


def test_a_loop_without_end_is_given_up() -> None:
    found = reflect(
        body(
            (249, 11),
            (248, 11),
            (246, 13, 12, 0),
            (249, 12),
            (248, 12),
            (249, 11),
            (248, 13),
            (253,),
        )
    )
    assert found.alpha.declared is False


def test_blocks_that_lead_to_themselves_are_given_up() -> None:
    assert not reflect(body((249, 11), (248, 11), (249, 11))).followed
    assert not reflect(body((249, 99))).followed


def test_a_function_that_calls_itself_is_given_up() -> None:
    assert not reflect(body((57, 2, 20, 1), (253,))).followed


def test_branches_without_a_place_to_meet_are_bounded() -> None:
    """Each doubles the ways."""
    blocks: list[tuple[int, ...]] = [(249, 100)]
    for n in range(100, 160):
        blocks += [
            (248, n),
            (1, 4, n + 200),
            (250, n + 200, n + 1, n + 1001),
            (248, n + 1001),
            (249, n + 1),
        ]
    found = reflect(body(*blocks, (248, 160), (253,)))
    assert not found.followed


def test_constants_within_constants_are_bounded() -> None:
    """Each has the one before it twice: the last would have 2^200 parts."""
    doubling: list[tuple[int, ...]] = []
    previous, kind = 7, 5
    for n in range(100, 500, 2):
        doubling += [(30, n, kind, kind), (44, n, n + 1, previous, previous)]
        previous, kind = n + 1, n
    store = [(32, 600, 7, kind), (32, 602, 7, kind)]
    code = assembled(
        *START,
        *doubling,
        *store,
        (46, kind, 601),
        (54, 2, 1, 0, 3),
        (248, 10),
        (59, 600, 603, 7),
        (62, 603, previous),
        (253,),
        (56,),
    )
    assert reflect(code).followed


def test_types_within_types_are_bounded() -> None:
    chain: list[tuple[int, ...]] = [(30, n, n - 1) for n in range(101, 3000)]
    assert reflect(
        assembled(
            (30, 100, 5),
            *START,
            *chain,
            (46, 2999, 4000),
            (54, 2, 1, 0, 3),
            (248, 10),
            (253,),
            (56,),
        )
    ).followed


def test_decorations_of_groups_are_bounded() -> None:
    """So many decorations for so many targets."""
    group = (
        [(71, 100, n, 0) for n in range(20_000)]
        + [(73, 100)]
        + [(74, 100, *range(200 + n * 1000, 1200 + n * 1000)) for n in range(20)]
    )
    module = Module(assembled(*START, *group, (54, 2, 1, 0, 3), (248, 10), (253,), (56,)))
    assert len(module.decorations) >= 20_000
    assert all(len(each) <= 24 for each in module.decorations.values())


def test_selections_within_selections_are_given_up_before_the_stack_ends() -> None:
    nest: list[tuple[int, ...]] = []
    deep = 3000
    for n in range(deep):
        nest += [
            (248, 1000 + n),
            (1, 4, 20_000 + n),
            (247, 10_000 + n, 0),
            (250, 20_000 + n, 1001 + n, 10_000 + n),
        ]
    nest += [(248, 1000 + deep), (249, 10_000 + deep - 1)]
    for n in reversed(range(deep)):
        nest += [(248, 10_000 + n), (249, 10_000 + n - 1) if n else (253,)]
    assert not reflect(body((249, 1000), *nest)).followed


def test_a_module_that_is_too_large_is_refused() -> None:
    with pytest.raises(SpirvError, match="it is larger than 16 MiB"):
        reflect(bytes(MAX_BYTES + 4))


def test_a_variable_may_hold_a_pointer_to_itself() -> None:
    """What it holds is used: that ends."""
    types = ((32, 600, 7, 5), (32, 601, 7, 600))
    inner = (
        (54, 2, 1, 0, 3),
        (248, 10),
        (59, 601, 602, 7),
        (62, 602, 602),
        (61, 600, 603, 602),
        (109, 5, 604, 603),
        (253,),
        (56,),
    )
    assert reflect(assembled(*START, *types, *inner)).followed


def test_indices_within_indices_are_bounded() -> None:
    """Each pointer is an index of the next."""
    chain = [(65, 600, n, 602, n - 1) for n in range(1001, 20_000)]
    inner = (
        (54, 2, 1, 0, 3),
        (248, 10),
        (59, 600, 602, 7),
        (65, 600, 1000, 602, 7),
        *chain,
        (61, 5, 20_001, 19_999),
        (253,),
        (56,),
    )
    assert reflect(assembled(*START, (32, 600, 7, 5), *inner)).followed


def test_steps_are_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """With fewer, less is followed: nothing goes uncounted."""
    code = (SHADERS / "average.frag.spv").read_bytes()
    monkeypatch.setattr(state, "MAX_STEPS", 100)
    assert not reflect(code).followed
    monkeypatch.setattr(state, "MAX_STEPS", 1000)
    assert reflect(code).followed


def test_the_modules_are_small() -> None:
    assert all(len(code) < 8192 for code in MODULES)
    assert len(MODULES) == len(
        [path for folder in (SHADERS, RULES) for path in Path(folder).glob("*.spv")]
    )
