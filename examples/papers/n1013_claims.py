"""The claims of Lubricants 2025, 13(11), 495 as comparisons of a study's figures.

Thresholds that turn the paper's words into numbers were chosen before anything was computed:
"unchanged" is within 10 % (a roller's speed: 1 %), "clearly" is by a quarter or more (a roller's
speed: 5 %), and a plain "more" is beyond both intervals. They are this study's reading.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

from n1013_view import (
    AFTER,
    AT,
    BASE,
    BEFORE,
    BENT1,
    BENT2,
    CAGES,
    CORNER,
    CREST,
    CROSSBEAM,
    LINE_AT,
    LINE_SHARE,
    LONGER,
    PAPER,
    PITCH,
    REACH,
    RIPPLE,
    SHORTER,
    SOUND,
    SPIKES,
    SPREAD,
    STRESS,
    WHIRL,
    Rows,
    View,
    shown,
    slip,
    spin,
    spin_ripple,
)

from flexcage.study.verdicts import (
    UNDECIDED,
    Estimate,
    Line,
    Verdict,
    every,
    less,
    monotone,
    range_of,
    unchanged,
)

SAME, CLEARLY = 0.10, 0.25  # shares
SAME_SPEED, CLEAR_DROP = 0.01, 0.05  # of a roller's speed


@dataclass(frozen=True)
class Claim:
    """One statement of the paper, its test on a view, and the figures that show it."""

    key: str
    text: str
    test: Callable[[View], str]
    figures: tuple[str, ...]
    cages: tuple[str, ...]
    source: str = PAPER

    def verdict(self, rows: Rows, variations: tuple[str, ...]) -> Verdict:
        """The verdict at the base clearances, and where else it holds of what was computed."""
        base = View(rows)
        outcomes, missing = {}, []
        for name in variations:
            view = View(rows, name)
            if all(view.has(cage) for cage in self.cages):
                outcomes[name] = self.test(view)
            else:
                missing.append(name)
        text = range_of(outcomes)
        if missing:
            text += ("; " if text else "") + f"undecided, not computed: {', '.join(missing)}"
        lines = [self._line(base, name, cage) for name in self.figures for cage in self.cages]
        return Verdict(
            key=self.key,
            claim=self.text,
            outcome=outcomes.get(BASE, UNDECIDED),
            figures=tuple(line for line in lines if isfinite(line.value)),
            range=text,
            reason="" if BASE in outcomes else "not computed",
            source=self.source,
        )

    def _line(self, view: View, output: str, cage: str) -> Line:
        return shown(output, cage, view(output, cage))


def _magnitude(figure: Estimate) -> Estimate:
    """A roller's speed without its sign."""
    return Estimate(abs(figure.value), figure.margin)


def _speed(view: View, roller: int, cage: str) -> Estimate:
    return _magnitude(view(spin(roller), cage))


def _steady(view: View, roller: int, cage: str) -> str:
    return unchanged(_speed(view, roller, SOUND), _speed(view, roller, cage), within=SAME_SPEED)


def _drops(view: View, roller: int, cage: str) -> str:
    """The roller turns slower than in the sound cage by 5 % or more."""
    sound = _speed(view, roller, SOUND)
    allowed = Estimate(sound.value * (1.0 - CLEAR_DROP), sound.margin)
    return less(_speed(view, roller, cage), allowed)


def _same(view: View, output: str, cage: str) -> str:
    return unchanged(view(output, SOUND), view(output, cage), within=SAME)


def _more(view: View, output: str, cage: str, *, than: str = SOUND, by: float = 0.0) -> str:
    return less(view(output, than), view(output, cage), by=by)


def _rises_then_falls(view: View, output: str) -> str:
    sound, first, second = view.along(output, CROSSBEAM)
    return every([less(sound, first), less(second, first)])


CLAIMS: tuple[Claim, ...] = (
    Claim(
        "000-1",
        "Cage stress rises with delta_q: 0 < 0.1 < 0.2 mm",
        lambda v: every(monotone(v.along(o, CROSSBEAM)) for o in (STRESS, CORNER)),
        (STRESS, CORNER, "stress_peak"),
        CROSSBEAM,
    ),
    Claim(
        "000-2",
        "The amplitude of the cage's radial displacement rises from delta_q = 0 to 0.1 mm and "
        "falls at 0.2 mm",
        lambda v: _rises_then_falls(v, REACH),
        (REACH, "cage_radial_displacement.mean"),
        CROSSBEAM,
    ),
    Claim(
        "000-3",
        "The whirl radius grows from delta_q = 0 to 0.1 mm and falls at 0.2 mm, and the orbit is "
        "more dispersed",
        lambda v: every([_rises_then_falls(v, WHIRL), _more(v, SPREAD, BENT2)]),
        (WHIRL, SPREAD),
        CROSSBEAM,
    ),
    Claim(
        "000-4",
        "The outer ring's acceleration is a stable band in a sound cage and gets irregular spikes "
        "(kurtosis) with any deformation",
        lambda v: every(_more(v, SPIKES, cage) for cage in CAGES[1:]),
        (SPIKES, CREST, "outer_acceleration_filtered[axis2=y].rms"),
        CAGES,
    ),
    Claim(
        "000-5",
        "Cage speed ripple: unchanged at delta_q = 0.1 mm; amplitude and frequency clearly up at "
        "0.2 mm",
        lambda v: every(
            [
                _same(v, RIPPLE, BENT1),
                _more(v, RIPPLE, BENT2, by=CLEARLY),
                _more(v, PITCH, BENT2, by=CLEARLY),
            ]
        ),
        (RIPPLE, PITCH),
        CROSSBEAM,
    ),
    Claim(
        "000-6",
        "Speed of roller j-1: unchanged at delta_q = 0.1 mm, a large drop and more ripple at "
        "0.2 mm; rollers j and j+1 unchanged",
        lambda v: every(
            [
                _steady(v, BEFORE, BENT1),
                _drops(v, BEFORE, BENT2),
                _more(v, spin_ripple(BEFORE), BENT2),
                *(_steady(v, r, cage) for r in (AT, AFTER) for cage in (BENT1, BENT2)),
            ]
        ),
        (spin(BEFORE), spin_ripple(BEFORE), spin(AT), spin(AFTER)),
        CROSSBEAM,
    ),
    Claim(
        "000-7",
        "Slip of roller j-1: slightly lower at delta_q = 0.1 mm, sharply higher at 0.2 mm; others "
        "unchanged",
        lambda v: every(
            [
                less(v(slip(BEFORE), BENT1), v(slip(BEFORE), SOUND)),
                _more(v, slip(BEFORE), BENT2, by=CLEARLY),
                *(_same(v, slip(r), cage) for r in (AT, AFTER) for cage in (BENT1, BENT2)),
            ]
        ),
        (slip(BEFORE), slip(AT), slip(AFTER)),
        CROSSBEAM,
    ),
    Claim(
        "000-8",
        "Cage stress: unchanged at delta_p = +0.3 mm, a strong increase at -0.3 mm (the paper: "
        "320.51 MPa)",
        lambda v: every(
            [_same(v, STRESS, LONGER), _more(v, STRESS, SHORTER, by=CLEARLY)]
        ),
        (STRESS, CORNER, "stress_peak"),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-9",
        "Radial displacement of the cage: unchanged at delta_p = +0.3 mm, sinusoidal at -0.3 mm, "
        "at one characteristic frequency",
        lambda v: every([_same(v, REACH, LONGER), _more(v, LINE_SHARE, SHORTER, by=CLEARLY)]),
        (REACH, LINE_AT, LINE_SHARE),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-10",
        "Orbit: larger and more chaotic at delta_p = +0.3 mm; regular and smaller at -0.3 mm",
        lambda v: every(
            [
                _more(v, WHIRL, LONGER),
                _more(v, SPREAD, LONGER),
                less(v(WHIRL, SHORTER), v(WHIRL, SOUND)),
                less(v(SPREAD, SHORTER), v(SPREAD, SOUND)),
            ]
        ),
        (WHIRL, SPREAD, "whirl_ratio"),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-11",
        "Cage speed ripple: smaller at delta_p = +0.3 mm; larger and of higher frequency at "
        "-0.3 mm",
        lambda v: every(
            [
                less(v(RIPPLE, LONGER), v(RIPPLE, SOUND)),
                _more(v, RIPPLE, SHORTER),
                _more(v, PITCH, SHORTER),
            ]
        ),
        (RIPPLE, PITCH),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-12",
        "Speed of roller j: unchanged at delta_p = +0.3 mm, drops at -0.3 mm",
        lambda v: every([_steady(v, AT, LONGER), _drops(v, AT, SHORTER)]),
        (spin(AT), spin_ripple(AT)),
        (SOUND, LONGER, SHORTER),
    ),
    Claim(
        "000-13",
        "A side-beam fault (-0.3 mm) changes the slip of rollers j-1 and j+1; a crossbeam fault "
        "(0.2 mm) leaves that of rollers j and j+1 as it was",
        lambda v: every(
            [
                *(_more(v, slip(r), SHORTER, by=SAME) for r in (BEFORE, AFTER)),
                *(_same(v, slip(r), BENT2) for r in (AT, AFTER)),
            ]
        ),
        (slip(BEFORE), slip(AT), slip(AFTER)),
        (SOUND, BENT2, SHORTER),
    ),
)  # fmt: skip
