"""Barrels in motion on a tilted shaft: how fast their cage turns, and how far they skew."""

from math import cos, pi
from pathlib import Path

import flexcage


def main(**changes: object) -> tuple[float, float]:
    """Cage speed over that of barrels that roll in their middles, and mean skew [mrad] of loaded
    barrels; ``changes`` of the case by key."""
    case = flexcage.load_case(Path(__file__).with_name("22208_run.toml")).replace(changes)
    summary = flexcage.simulate(case).summary
    ratio, skew = summary["cage_speed"] / rolling(case), 1e3 * summary["barrel_skew_loaded"]
    print(f"cage at {summary['cage_speed'] * 30 / pi:.1f} rpm, {ratio:.4f} of pure rolling; loaded "
          f"barrels run {skew:.2f} mrad askew")  # fmt: skip
    return ratio, skew


def rolling(case: flexcage.Case) -> float:
    """Cage speed [rad/s] by hand: the outer ring stands, and barrels roll in their middles."""
    b = case.bearing
    gamma = b.roller_diameter / b.pitch_diameter * cos(b.contact_angle)
    return 0.5 * case.drive.speed * (1.0 - gamma)


if __name__ == "__main__":
    found, askew = main()
    assert abs(found - 1.0) < 0.03 and 1.0 < askew < 30.0, (found, askew)
