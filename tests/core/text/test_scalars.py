from __future__ import annotations

import math
from typing import Any

import pytest

from msaa_lint.core.text.scalars import MAX_DIGITS, MAX_FLOAT, resolve


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("", None), ("~", None), ("null", None), ("Null", None), ("NULL", None),
        ("true", True), ("True", True), ("TRUE", True), ("false", False), ("False", False),
        ("FALSE", False),
        ("0", 0), ("-0", 0), ("+12", 12), ("-12", -12), ("010", 10), ("0o10", 8), ("0o17", 15),
        ("0x1F", 31), ("0xffffffff", 0xFFFFFFFF),
        ("1.", 1.0), (".5", 0.5), ("-.5", -0.5), ("+1.5", 1.5), ("1e3", 1000.0), ("1E-3", 0.001),
        ("1.5e+3", 1500.0), ("0.0", 0.0),
        (".inf", math.inf), ("+.Inf", math.inf), ("-.INF", -math.inf), ("1e999", math.inf),
    ],
)  # fmt: skip
def test_core_schema(text: str, value: Any) -> None:
    assert resolve(text) == value
    assert type(resolve(text)) is type(value)


@pytest.mark.parametrize("text", [".nan", ".NaN", ".NAN"])
def test_nan(text: str) -> None:
    value = resolve(text)
    assert isinstance(value, float)
    assert math.isnan(value)


@pytest.mark.parametrize(
    "text",
    [
        "yes", "no", "on", "off", "y", "n", "Yes", "NO", "tRUE", "nULL", "1_000", "1:30", "0b11",
        "0o8", "0xG",
        "-0x1", "+0o7", "2020-01-01",
        "+", "-", ".", "..", "+.", "e3", ".e3", "1e", "1e+", "--1", "1.2.3", "1 2", "-.nan",
        "+.nan", "inf", "NaN", "Infinity", "=", "<<",
        "１２", "1²", "٣", "1\n", " 1", "nullx",
    ],
)  # fmt: skip
def test_all_else_is_text(text: str) -> None:
    assert resolve(text) == text


def test_the_longest_numbers() -> None:
    digits = "9" * MAX_DIGITS
    assert resolve(digits) == int(digits)
    assert resolve("-" + digits) == -int(digits)
    assert resolve(digits + "9") == digits + "9"
    assert resolve("0x" + "f" * (MAX_DIGITS + 1)) == "0x" + "f" * (MAX_DIGITS + 1)
    # FLT_MAX and DBL_MAX as C's %f writes them.
    assert resolve("340282346638528859811704183484516925440.000000") == 3.4028234663852886e38
    largest = f"{1.7976931348623157e308:f}"
    assert len(largest) <= MAX_FLOAT
    assert resolve(largest) == 1.7976931348623157e308
    assert resolve("1." + "0" * MAX_FLOAT) == "1." + "0" * MAX_FLOAT
