"""Figures of the five cages: their names, units, and how repetitions are gathered."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import floor, isfinite, log10, nan

from flexcage.results.audit import OF_DRIVE
from flexcage.study.results import ResultRow, StudyResults
from flexcage.study.verdicts import Estimate, Line, pooled

PAPER = "Lubricants 2025, 13(11), 495"
SOUND, BENT1, BENT2, LONGER, SHORTER = "sound", "dq +0.1", "dq +0.2", "dp +0.3", "dp -0.3"
CAGES = (SOUND, BENT1, BENT2, LONGER, SHORTER)
BASE, RIGID = "base", "rigid cage"
BEFORE, AT, AFTER = 4, 5, 6  # rollers j-1, j, j+1: crossbeam 5 lies between pockets 4 and 5
CROSSBEAM = (SOUND, BENT1, BENT2)

RIPPLE, PITCH = "cage_speed_ripple", "cage_omega[axis=x].mean_frequency"
STRESS, CORNER = "stress_mean_peak", "stress_root_pass_peak"
WHIRL = "whirl_radius"
REACH, SPREAD = "cage_radial_displacement.std", "cage_whirl_radius.ripple"
SPIKES, CREST = (f"outer_acceleration_filtered[axis2=y].{k}" for k in ("kurtosis", "crest"))
LINE_AT, LINE_SHARE = (f"cage_position[axis=y].{k}" for k in ("frequency", "line_share"))


def spin(roller: int) -> str:
    return f"element_omega[element={roller},spin_axis=axial].mean"


def spin_ripple(roller: int) -> str:
    return f"element_omega[element={roller},spin_axis=axial].ripple"


def slip(roller: int) -> str:
    return f"element_slip_ratio[element={roller}].mean"


#: How figures are shown: name, unit, factor from SI.
SHOWN: Mapping[str, tuple[str, str, float]] = {
    STRESS: ("mean of the cage's peak stress", "MPa", 1e-6),
    CORNER: ("pocket corner stress, peak of a roller pass", "MPa", 1e-6),
    "stress_peak": ("largest stress", "MPa", 1e-6),
    RIPPLE: ("cage speed ripple", "%", 100.0),
    PITCH: ("mean frequency of the ripple", "Hz", 1.0),
    REACH: ("radial displacement, standard deviation", "um", 1e6),
    "cage_radial_displacement.mean": ("mean radial displacement", "um", 1e6),
    WHIRL: ("mean whirl radius", "um", 1e6),
    SPREAD: ("scatter of the whirl radius", "%", 100.0),
    SPIKES: ("kurtosis of the ring's acceleration", "", 1.0),
    CREST: ("crest factor of the ring's acceleration", "", 1.0),
    LINE_AT: ("strongest line of the cage centre", "Hz", 1.0),
    LINE_SHARE: ("its share of the variance", "%", 100.0),
    "outer_acceleration_filtered[axis2=y].rms": ("rms of the ring's acceleration", "m/s²", 1.0),
    "stress_root": ("largest pocket corner stress", "MPa", 1e-6),
    "cage_omega[axis=x].frequency": ("strongest line of the ripple", "Hz", 1.0),
    "whirl_speed_ratio": ("whirl speed over cage speed", "", 1.0),
    "pocket_force_peak": ("hardest blow in a pocket", "N", 1.0),
    "whirl_ratio": ("whirl (max - min)/mean", "", 1.0),
    "cage_slip_ratio": ("cage slip ratio", "%", 100.0),
    "inner_speed.ripple": ("inner ring's speed ripple", "%", 100.0),
    "inner_speed.frequency": ("its strongest line", "Hz", 1.0),
    "cage_centre_shift": ("shift of the mass centre", "um", 1e6),
    "pocket_force[pocket=4,face=front].mean": ("push of roller j-1 on the cage, mean", "N", 1.0),
    "pocket_force[pocket=5,face=front].mean": ("push of roller j on the cage, mean", "N", 1.0),
    "pocket_force[pocket=5,face=side+x].mean": ("force on the pushed side beam, mean", "N", 1.0),
    "land_force[axis=z].mean": ("land force on the cage along z", "N", 1.0),
    "cage_position[axis=z].mean": ("mean displacement of the cage along z", "um", 1e6),
    "slip_loaded": ("slip in the loaded zone", "%", 100.0),
    "pinch_force": ("pinch force", "N", 1.0),
}  # fmt: skip
_ROLLERS = {BEFORE: "j-1", AT: "j", AFTER: "j+1"}


Rows = Mapping[tuple[str, str], tuple[ResultRow, ...]]  # finished cases by cage and variation


def over_starts(rows: Iterable[ResultRow], output: str) -> Estimate:
    """A figure over the repetitions of a case; NaN where nothing was computed."""
    known = [
        row.figures[output]
        for row in rows
        if output in row.figures and row.figures[output].value is not None
    ]
    return pooled([float(f.value) for f in known], [f.margin for f in known])  # type: ignore[arg-type]


@dataclass(frozen=True)
class View:
    """Figures of the five cages in one variation of the study."""

    rows: Rows
    variation: str = BASE

    def __call__(self, output: str, cage: str) -> Estimate:
        """A figure over the repetitions; NaN where nothing was computed."""
        return over_starts(self.rows.get((cage, self.variation), ()), output)

    def along(self, output: str, cages: tuple[str, ...]) -> list[Estimate]:
        return [self(output, cage) for cage in cages]

    def has(self, cage: str) -> bool:
        return bool(self.rows.get((cage, self.variation)))


def rows_of(results: StudyResults) -> Rows:
    """Finished cases of the study by cage and variation, those whose energy closes."""
    found: dict[tuple[str, str], tuple[ResultRow, ...]] = {}
    for row in results.rows:
        if row.state == "done" and imbalance(row) <= OF_DRIVE:
            labels = row.planned.point.labels
            key = (labels["cage"], labels["variation"])
            found[key] = (*found.get(key, ()), row)
    return found


def imbalance(row: ResultRow) -> float:
    """Largest energy that is missing in a finished case, over the drive's work."""
    return float(row.figures["energy_of_drive"].value)  # type: ignore[arg-type]


def shown(output: str, cage: str, figure: Estimate) -> Line:
    """A figure as a verdict shows it."""
    label, unit, factor = SHOWN.get(output) or _of_roller(output)
    margin = factor * figure.margin if isfinite(figure.margin) else nan
    return Line(f"{label}, {cage}", factor * figure.value, abs(margin), unit)


def written(line: Line) -> str:
    """A figure with its margin and unit, in words."""
    if not isfinite(line.value):
        return "-"
    told = isfinite(line.margin) and line.margin > 1e-9 * abs(line.value)
    margin = f" ± {_digits(line.margin, 2)}" if told else ""
    return f"{_digits(line.value, 4)}{margin} {line.unit}".strip()


def _digits(value: float, count: int) -> str:
    """``count`` significant digits without an exponent, and no decimals from a thousand on."""
    size = abs(value)
    if size < 1e-9:
        return "0"
    if size >= 1e3:
        return f"{value:,.0f}"
    return f"{value:.{max(count - 1 - floor(log10(size)), 0)}f}"


def _of_roller(output: str) -> tuple[str, str, float]:
    roller = next(r for r in _ROLLERS if f"[element={r}" in output)
    name = _ROLLERS[roller]
    if output == slip(roller):
        return f"slip of roller {name}", "%", 100.0
    if output == spin(roller):
        return f"speed of roller {name}", "rpm", -9.549296585513721  # it spins backwards
    return f"speed ripple of roller {name}", "%", 100.0
