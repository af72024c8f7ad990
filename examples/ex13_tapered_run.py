"""Tapered rollers in motion: cones with one apex roll, and the large rib turns them askew."""

from math import pi, sin
from pathlib import Path

import flexcage


def main(**changes: object) -> tuple[float, float]:
    """Cage speed over that of cones that roll on their lines, and mean skew [mrad] of loaded
    rollers; ``changes`` of the case by key."""
    case = flexcage.load_case(Path(__file__).with_name("30205_run.toml")).replace(changes)
    summary = flexcage.simulate(case).summary
    ratio, skew = summary["cage_speed"] / rolling(case), 1e3 * summary["roller_skew_loaded"]
    print(f"cage at {summary['cage_speed'] * 30 / pi:.1f} rpm, {ratio:.4f} of pure rolling; loaded "
          f"rollers run {skew:.2f} mrad askew")  # fmt: skip
    return ratio, skew


def rolling(case: flexcage.Case) -> float:
    """Cage speed [rad/s] by hand: races are cones with the rollers' apex, the outer one stands."""
    inner, outer = (sin(angle) for angle in case.bearing.race_angles)
    return case.drive.speed * inner / (inner + outer)


if __name__ == "__main__":
    found, askew = main()
    assert abs(found - 1.0) < 0.005 and askew > 0.02, (found, askew)
