"""Figures of diagnosis: passing frequencies, how strongly the outer ring vibrates, and how much of
it comes back at these frequencies."""

from __future__ import annotations

from functools import partial
from math import isfinite

from flexcage.results.evenly import FEWEST
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.results.frequencies import SOUGHT

#: Of every line its part of a figure's name, and what it counts.
LINES = {
    "FTF": ("ftf", "turns of the cage, or without one of the elements"),
    "shaft": ("shaft", "turns of the inner ring"),
    "BSF": ("bsf", "turns of an element relative to the cage"),
    "2 BSF": ("bsf_twice", "blows of a defect of an element on both races"),
    "BPFO": ("bpfo", "elements that pass a place of the outer race"),
    "BPFI": ("bpfi", "elements that pass a place of the inner race"),
}
_SHORT = "the run is too short to tell; raise solver.duration"
_SLOW = "too few samples a second for the band to 20 kHz; raise output.vibration_rate"


def _own(line: str, part: SettledRun) -> Found:
    if line == "shaft":
        return Found(part.frequencies[line])
    return Found(part.frequencies[line], f"nominal {part.nominal_frequencies[line]:.5g} Hz")


def _nominal(line: str, part: SettledRun) -> float:
    return part.nominal_frequencies[line]


# fmt: off
FREQUENCIES = FigureTable[SettledRun]("Passing frequencies")
for _line, (_key, _what) in LINES.items():
    FREQUENCIES.add(f"frequency_{_key}", f"Frequency {_line}", "Hz",
                    f"{_what}; by the run's own mean speeds",
                    take=partial(_own, _line))
for _line, (_key, _what) in LINES.items():
    if _line != "shaft":
        FREQUENCIES.add(f"nominal_{_key}", f"Nominal {_line}", "Hz",
                        "of pure rolling at the nominal contact angle and the mean speed",
                        take=partial(_nominal, _line))
# fmt: on


def _of(name: str, part: SettledRun) -> Found:
    """A figure of the outer ring's acceleration, along the axis where it is larger."""
    if part.vibration is None:
        many = part.ds.sizes["time_hf"] >= FEWEST
        return Found(None, _SLOW if many else _SHORT)
    axis, figures = part.vibration
    value = figures[name]
    return Found(value, f"along {axis}") if isfinite(value) else Found(None, _SHORT)


def _line_of(name: str, part: SettledRun) -> Found:
    """A line of the envelope's spectrum, and how far it stands above the floor."""
    found = _of(name, part)
    floor = _of("envelope floor", part).value
    if not isinstance(found.value, float) or not isinstance(floor, float) or not floor:
        return found
    return Found(found.value, f"{found.value / floor:.3g} times the floor")


# fmt: off
#: Of runs that record the outer ring's acceleration.
VIBRATION = FigureTable[SettledRun]("Vibration of the outer ring")
VIBRATION.add("vibration_rms", "Acceleration, RMS", "m/s^2", "about its mean",
              take=partial(_of, "rms"))
VIBRATION.add("vibration_band", "Acceleration, RMS in the band", "m/s^2", "of 2 to 20 kHz",
              take=partial(_of, "band rms"))
VIBRATION.add("vibration_kurtosis", "Acceleration, kurtosis", "",
              "3 of Gaussian noise, more of blows", take=partial(_of, "kurtosis"))
VIBRATION.add("vibration_crest", "Acceleration, crest factor", "", "its largest over its RMS",
              take=partial(_of, "crest"))
VIBRATION.add("envelope_floor", "Envelope, floor", "m/s^2",
              "median of the spectrum of its envelope from 2 to 20 kHz",
              take=partial(_of, "envelope floor"))
for _line in SOUGHT:
    VIBRATION.add(f"envelope_{LINES[_line][0]}", f"Envelope at {_line}", "m/s^2",
                  "largest amplitude of this spectrum within two bins",
                  take=partial(_line_of, f"envelope at {_line}"))
for _line in SOUGHT[1:]:
    VIBRATION.add(f"envelope_{LINES[_line][0]}_multiples", f"Envelope at 1, 2, 3 times {_line}",
                  "m/s^2", "root of the sum of squares of these three amplitudes",
                  take=partial(_line_of, f"envelope at 3 {_line}"))
# fmt: on
