"""A ring whose speed fluctuates: its acceleration, and what that asks of the balls."""

from __future__ import annotations

from collections.abc import Iterator
from math import radians

import numpy as np

from flexcage import epicyclic
from flexcage.verification.bearings import RPM, preset
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.runs import c7010, run_of

SPEED = 2000.0  # rpm
# amplitude over the mean speed, waves a turn: largest acceleration of the ring [rad/s^2], force
# that a ball's orbit then takes [mN], None where the source has none
TABLE = {
    (0.03, 1): (1316.0, 9.1), (0.06, 1): (2632.0, None), (0.09, 1): (3948.0, None),
    (0.06, 2): (5264.0, None), (0.06, 3): (7896.0, 54.8),
}  # fmt: skip
SHORT_RUN = {
    "bearing.preset": "7603025",
    "drive.speed": f"{SPEED} rpm",
    "drive.wave": "sine",
    "load.axial": "3500 N",
    "solver.duration": "0.2 ms",
    "output.rate": "100 kHz",
    "output.vibration_rate": "100 kHz",
}
PRINTED = Tolerance(4e-4, "printed to four digits")
ROUNDED = Tolerance(6e-3, "printed to two or three digits")


def acceleration(amplitude: float, waves: int) -> float:
    """Largest acceleration [rad/s^2] of the ring in a run that begins where it is largest."""
    wave = {
        "drive.wave_amplitude": f"{amplitude * SPEED!r} rpm",
        "drive.wave_period": f"{60.0 / (waves * SPEED)!r} s",
    }
    ds = run_of(c7010(SHORT_RUN, wave)).dataset
    return float(np.max(np.diff(ds["inner_speed"].values) / np.diff(ds["time"].values)))


def orbital_force(peak: float) -> float:
    """Force [N] that takes a ball along as its orbit accelerates with the ring's ``peak``."""
    bearing = preset("7603025")
    share = epicyclic(
        element_diameter=bearing.ball_diameter,
        pitch_diameter=bearing.pitch_diameter,
        element_count=bearing.ball_count,
        inner_speed=SPEED * RPM,
        contact_angle=radians(60.0),
    ).cage_speed / (SPEED * RPM)
    return bearing.ball_mass * 0.5 * bearing.pitch_diameter * share * peak


def rows() -> Iterator[Row]:
    for (amplitude, waves), (expected, push) in TABLE.items():
        peak = acceleration(amplitude, waves)
        where = f"{amplitude:.0%}, {waves} a turn"
        yield Row(f"{where}: acceleration of the ring", "rad/s^2", expected, peak, PRINTED)
        if push is not None:
            found = 1e3 * orbital_force(peak)
            yield Row(f"{where}: force on a ball's orbit", "mN", push, found, ROUNDED)


CASE: KnownAnswer = KnownAnswer(
    name="speed_fluctuation",
    title="A ring whose speed fluctuates",
    source="closed form, A W^2 N for a speed W (1 + A sin(N W t)), and m r gamma' times that for a "
    "ball that orbits at gamma' of the ring's speed; numbers from an independent program",
    checks="The inner ring of a 7603025 at 2000 rpm with waves of 3 to 9 % of its speed: its "
    "largest acceleration in a run, and the force that takes a ball along. Friction of 0.002 under "
    "15 N gives 30 mN.",
    rows=rows,
    quick=False,
)
