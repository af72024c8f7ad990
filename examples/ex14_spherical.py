"""A spherical roller bearing: how much axial load leaves one of its rows with nothing to bear."""

from dataclasses import replace
from math import tan
from pathlib import Path

import numpy as np

import flexcage


def main(*axial: float) -> list[float]:
    """Share of a radial load that the row at -x bears, under axial loads [N]."""
    case = flexcage.load_static(Path(__file__).with_name("22208.toml"))
    shares = []
    for load in axial:
        given = replace(case.load, axial=load)
        e = flexcage.solve_static(replace(case, load=given)).elements
        row = e.angle[:, 0] < 0.0
        radial = e.force[row, 0] * np.cos(e.angle[row, 0]) * np.cos(e.azimuth[row])
        shares.append(radial.sum() / case.load.radial)
        print(f"{load:6.0f} N axially: the row at -x bears {shares[-1]:.1%} of the radial load")
    return shares


def limit() -> float:
    """Axial load [N] from which ISO 281 rates such a bearing as one row: e = 1.5 tan(alpha)."""
    case = flexcage.load_static(Path(__file__).with_name("22208.toml"))
    return 1.5 * tan(case.bearing.contact_angle) * case.load.radial


if __name__ == "__main__":
    both, some, few = main(0.0, 0.5 * limit(), limit())
    assert abs(both - 0.5) < 0.01 and 0.02 < some < 0.3 and few < 0.02, (both, some, few)
