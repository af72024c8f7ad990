"""How many digits a number is printed with, alone and beside its margin."""

import pytest

from flexcage.core.digits import number_text, texts_with_margin


@pytest.mark.parametrize(
    "value, text",
    [
        (0.0, "0"), (2650.04, "2,650.0"), (95.703, "95.703"), (0.12345, "0.1235"),
        (-3.14159, "-3.1416"), (1.5e7, "1.500e+07"), (2e-5, "2.000e-05"), (float("nan"), "-"),
    ],
)  # fmt: skip
def test_a_number_alone_has_about_five_digits(value, text):
    assert number_text(value) == text


@pytest.mark.parametrize(
    "value, margin, texts",
    [
        (95.703, 150.0, ("100", "150")),
        (86.09, 221.0, ("90", "220")),
        (12.3456, 0.1449, ("12.35", "0.14")),
        (12.3456, 0.0999, ("12.35", "0.10")),  # rounds up to another digit
        (2650.04, 0.87, ("2,650.04", "0.87")),
        (-12.3456, 3.2, ("-12.3", "3.2")),
        (0.3, 150.0, ("0", "150")),
        (-0.3, 150.0, ("0", "150")),  # and not "-0"
        (99.99356, 0.0001, ("99.99356", "0.00010")),
        (12345.678, 12.0, ("12,346", "12")),
        (12.0, 0.0, ("12.000", "0")),
        (12.0, 1e-9, ("12.00000", "1e-09")),
        (1.2345e-6, 3e-8, ("1.235e-06", "0.030e-06")),
        (1.5e-7, 2.04e-6, ("0.1e-06", "2.0e-06")),
        (4.21e8, 1.1e6, ("4.210e+08", "0.011e+08")),
        (12.0, None, ("12.000", "")),
        (12.0, float("nan"), ("12.000", "")),
        (float("nan"), 3.0, ("-", "")),
    ],
)  # fmt: skip
def test_a_margin_says_how_many_digits_its_value_has(value, margin, texts):
    assert texts_with_margin(value, margin) == texts
