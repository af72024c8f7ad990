"""Frequencies at which a bearing excites vibration: without slip, and by a run's own speeds."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

from flexcage.geometry.kinematics import passing_frequencies
from flexcage.results import metrics
from flexcage.results.slip import BearingNumbers, at_own_angles, spin_in_cage

if TYPE_CHECKING:
    import xarray

    from flexcage.geometry.bearing import Bearing

SOUGHT = ("FTF", "2 BSF", "BPFO", "BPFI")  # where defects of cage, element and races show


def bearing_frequencies(
    bearing: BearingNumbers | Bearing, inner_speed: float, outer_speed: float = 0.0
) -> dict[str, float]:
    """Frequencies [Hz] by name, without slip, of a bearing whose rings turn at speeds [rad/s].

    Names as in ``geometry.kinematics.passing_frequencies``.
    """
    numbers = bearing if isinstance(bearing, BearingNumbers) else BearingNumbers.of(bearing)
    return passing_frequencies(numbers.kinematics(inner_speed, outer_speed), inner_speed)


def run_frequencies(
    ds: xarray.Dataset, bearing: BearingNumbers, *, own: bool = True
) -> dict[str, float]:
    """The bearing's frequencies [Hz] by name at the run's mean inner speed: of a ball bearing, at
    its ``own`` mean contact angles (``at_own_angles``), or at the nominal one."""
    own_or_nominal = at_own_angles(ds, bearing) if own else bearing.nominal
    return bearing_frequencies(own_or_nominal, float(ds["inner_speed"].mean()))


def own_frequencies(ds: xarray.Dataset, bearing: BearingNumbers) -> dict[str, float]:
    """The same frequencies [Hz] by name as the run's own mean speeds have them, slip included: of
    the cage, the inner ring, and the elements about their own axes relative to the cage. The outer
    ring stands."""
    cage, inner = float(metrics.carrier_speed(ds).mean()), float(ds["inner_speed"].mean())
    spin = abs(float(spin_in_cage(ds).mean()))
    speeds = {
        "FTF": abs(cage),
        "shaft": abs(inner),
        "BSF": spin,
        "2 BSF": 2.0 * spin,
        "BPFO": bearing.element_count * abs(cage),
        "BPFI": bearing.element_count * abs(inner - cage),
    }
    return {name: speed / (2.0 * pi) for name, speed in speeds.items()}
