"""Speeds and passing frequencies of pure rolling."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi, radians

from flexcage import epicyclic
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

RPM = pi / 30.0

# bearing: Dw, dm [mm], Z, contact angle [deg]; inner speed [rpm]; then cage speed and spin relative
# to the cage [rpm], BPFO, BPFI, BSF [Hz]
TABLE = {
    "N1013": (8.0, 82.5, 22, 0, 6000, 2709.0909, 30646.59, 993.3333, 1206.6667, 510.7765),
    "6203": (6.47, 26.0, 7, 0, 9000, 3380.1923, 16963.65, 394.3558, 655.6442, 282.7276),
    "7603025": (5.55, 42.4, 17, 60, 2000, 934.5519, 7606.92, 264.7897, 301.8770, 126.7819),
    "7010C at 4000": (9.525, 65.0, 18, 15, 4000, 1716.9094, 13374.85, 515.0728, 684.9272, 222.9142),
    "7010C at 10000": (
        9.525, 65.0, 18, 15, 10000, 4292.2736, 33437.12, 1287.6821, 1712.3179, 557.2854,
    ),
    "7010C at 11000": (
        9.525, 65.0, 18, 15, 11000, 4721.5009, 36780.84, 1416.4503, 1883.5497, 613.0139,
    ),
    "7010C, 8.73 mm balls, at 8000": (
        8.73, 64.94, 18, 15, 8000, 3480.5955, 29253.16, 1044.1786, 1355.8214, 487.5527,
    ),
    "7010C, 8.73 mm balls, at 10000": (
        8.73, 64.94, 18, 15, 10000, 4350.7443, 36566.45, 1305.2233, 1694.7767, 609.4409,
    ),
}  # fmt: skip
DIGITS = Tolerance(5.1e-5, "arithmetic; printed to 1e-4", absolute=True)
SPIN_DIGITS = Tolerance(5.1e-3, "arithmetic; printed to 1e-2", absolute=True)


def rows() -> Iterator[Row]:
    for name, (dw, dm, z, angle, rpm, cage, spin, bpfo, bpfi, bsf) in TABLE.items():
        found = epicyclic(
            element_diameter=dw * 1e-3,
            pitch_diameter=dm * 1e-3,
            element_count=z,
            inner_speed=rpm * RPM,
            contact_angle=radians(angle),
        )
        in_cage = -found.element_spin_in_cage / RPM
        yield Row(f"{name}, cage speed", "rpm", cage, found.cage_speed / RPM, DIGITS)
        yield Row(f"{name}, spin in the cage", "rpm", spin, in_cage, SPIN_DIGITS)
        yield Row(f"{name}, BPFO", "Hz", bpfo, found.outer_race_passing, DIGITS)
        yield Row(f"{name}, BPFI", "Hz", bpfi, found.inner_race_passing, DIGITS)
        yield Row(f"{name}, BSF", "Hz", bsf, found.element_frequency, DIGITS)
        if name == "N1013":
            inertial = -found.element_spin / RPM
            yield Row(f"{name}, spin in space", "rpm", 27937.5, inertial, DIGITS)


CASE: KnownAnswer = KnownAnswer(
    name="kinematics",
    title="Epicyclic speeds",
    source="T. A. Harris, Rolling Bearing Analysis, bearing speeds; the table from an independent "
    "program, in agreement with the speeds printed for these bearings",
    checks="Cage speed, spin of the rolling elements and passing frequencies of pure rolling on a "
    "fixed outer ring. Spin relative to the cage and in space differ by the cage's speed.",
    rows=rows,
)
