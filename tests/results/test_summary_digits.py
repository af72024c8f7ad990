"""Digits of the figures that summaries, pages and studies print."""

import pytest

from flexcage.results.row import SummaryRow, format_value
from flexcage.results.summary import Section, Summary


@pytest.mark.parametrize(
    "value, shown, margin, texts",
    [
        (95.703e-6, "um", 150e-6, ("100", "± 150")),
        (86.09, "N", 221.0, ("90", "± 220")),
        (7.495e-18, "um", None, ("0", "")),  # below what lengths resolve
        (7.495e-18, "um", 1e-18, ("0", "± 0")),
        (2.3e-7, "deg", None, ("0", "")),  # of a deep groove bearing under a radial load
        (2.3e-7, "mrad", None, ("0.0002", "")),
        (2.1e-15 / 3.6e9, "um/h", None, ("2.100e-15", "")),  # a rate of wear is as small
        (0.0215, "%", 0.0004, ("2.150", "± 0.040")),
    ],
)
def test_a_value_in_its_unit(value, shown, margin, texts):
    assert format_value(value, shown, margin) == texts


def test_a_row_and_tables_agree():
    row = SummaryRow("pocket_force_mean", "Pocket force", 86.09, "N", margin=221.0)
    assert (row.text, row.margin_text, row.full_text) == ("90", "± 220", "90 ± 220 N")
    summary = Summary((Section("Forces", (row,)),))
    assert "90 ± 220 N" in summary.text()
    assert SummaryRow("a", "a", "nothing").full_text == "nothing"


def test_words_stand_in_no_column():
    """A sentence as a value does not push the figures to the right."""
    words = "free across the axis; held along the axis and in tilt"
    rows = [SummaryRow("speed", "Speed", 100.0, "m/s"), SummaryRow("held", "Ring", words)]
    lines = Summary((Section("Both", tuple(rows)),)).text().splitlines()
    assert lines[2].index("Ring") == 2 and lines[2].endswith(f"  {words}")
    assert len(lines[1]) < 30
