"""One figure of a run as it is printed: value, margin and note, in the unit that it is shown in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import isfinite, pi

from flexcage.core.digits import texts_with_margin
from flexcage.core.errors import InputError
from flexcage.results.statistics import Record

Value = float | int | str | bool | None

#: Units as shown: the SI unit of the value and the factor from it.
SHOWN: dict[str, tuple[str, float]] = {
    "": ("1", 1.0),
    "rpm": ("rad/s", 30.0 / pi),
    "%": ("1", 100.0),
    "um": ("m", 1e6),
    "mm": ("m", 1e3),
    "um/m": ("1", 1e6),
    "m/s": ("m/s", 1.0),
    "m/s^2": ("m/s^2", 1.0),
    "mrad": ("rad", 1e3),
    "N": ("N", 1.0),
    "N mm": ("N m", 1e3),
    "W": ("W", 1.0),
    "MPa": ("Pa", 1e-6),
    "GPa": ("Pa", 1e-9),
    "mJ": ("J", 1e3),
    "s": ("s", 1.0),
    "ms": ("s", 1e3),
    "us": ("s", 1e6),
    "deg": ("rad", 180.0 / pi),
    "Hz": ("Hz", 1.0),
    "kHz": ("Hz", 1e-3),
    "h": ("s", 1.0 / 3600.0),
    "1/h": ("1/s", 3600.0),
    "um/h": ("m/s", 3.6e9),
    "mm^3/h": ("m^3/s", 3.6e12),
    "g": ("kg", 1e3),
    "GB": ("B", 1e-9),
}


#: What counts as nothing, by the SI unit: what rounding and the solver's tolerance leave of a zero.
#: Angles in degrees are of contacts: 1e-9 m across two grooves' centres, a few tenths of a
#: millimetre apart. Rates by the hour have none: those of wear are small and real.
RESOLUTION = {
    "m": 1e-10, "rad": 1e-9, "rad/s": 1e-9, "m/s": 1e-9, "m/s^2": 1e-9, "N": 1e-6, "N m": 1e-9,
    "Pa": 1.0, "J": 1e-12, "W": 1e-9, "Hz": 1e-6, "1": 1e-12, "deg": 5e-6,
}  # fmt: skip


def resolution(shown: str) -> float:
    """What counts as nothing of a value that is shown in this unit, in SI."""
    if shown.endswith("/h"):
        return 0.0
    return RESOLUTION.get(shown, RESOLUTION.get(SHOWN[shown][0], 0.0))


def check_shown(what: str, name: str, shown: str) -> None:
    """Raise InputError unless something called ``name`` is shown in a unit that there is."""
    if shown not in SHOWN:
        raise InputError(
            f"The {what} '{name}' is shown in '{shown}', but should be in one of "
            f'{", ".join(filter(None, SHOWN))}, or "" for none.',
            where=name,
            value=shown,
        )


def format_value(value: float, shown: str = "", margin: float | None = None) -> tuple[str, str]:
    """Texts of a value and of its margin, both in SI, in the unit ``shown``: "100", "± 150".

    The second is empty where no margin is known. A value below what its unit resolves is "0".
    """
    nothing, factor = resolution(shown), SHOWN[shown][1]
    value = 0.0 if abs(value) < nothing else value * factor
    if margin is not None:
        margin = 0.0 if margin < nothing else margin * factor
    number, half = texts_with_margin(value, margin)
    return number, f"± {half}" if half else ""


def with_others(rows: Sequence[SummaryRow]) -> SummaryRow:
    """The row of the cage at -x, with the values of those of other rows in its note."""
    first = rows[0]
    if len(rows) == 1 or first.text == "-":
        return first
    said = f"of the cage at -x; at +x {', '.join(row.full_text for row in rows[1:])}"
    return replace(first, note="; ".join(filter(None, (first.note, said))))


@dataclass(frozen=True)
class SummaryRow:
    """One figure: ``value`` in SI (or a text, a count); ``shown`` is the unit it is printed in.

    ``margin`` is half the width of the value's 95 % interval, in SI; None where there is none.
    ``record`` holds a statistic's windows, while the run is in memory. ``idle``: zero because the
    bearing has nothing that makes it; kept for programs, and not printed.
    """

    key: str
    label: str
    value: Value
    shown: str = ""
    note: str = ""
    margin: float | None = None
    record: Record | None = field(default=None, repr=False, compare=False)
    idle: bool = False

    @property
    def unit(self) -> str:
        return SHOWN[self.shown][0]

    @property
    def text(self) -> str:
        """The value as printed, without its unit, with the digits that its margin leaves."""
        v = self.value
        if v is None or (isinstance(v, float) and not isfinite(v)):
            return "-"
        if isinstance(v, bool):
            return "yes" if v else "no"
        if isinstance(v, str):
            return v
        if isinstance(v, int) and not self.shown:
            return f"{v:,}"
        return format_value(float(v), self.shown, self.margin)[0]

    @property
    def margin_text(self) -> str:
        """The margin as printed; nothing where there is none."""
        if self.margin is None or not isinstance(self.value, (int, float)):
            return ""
        return format_value(float(self.value), self.shown, self.margin)[1]

    @property
    def brief_note(self) -> str:
        """The note's first part, for where there is little room."""
        return self.note.partition(";")[0]

    @property
    def full_text(self) -> str:
        """Value, margin and unit, as a sentence or a key figure shows them: "100 ± 150 um"."""
        return " ".join(filter(None, (self.text, self.margin_text, self.shown)))
