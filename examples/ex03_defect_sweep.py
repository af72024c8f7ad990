"""A side beam bent further into its pocket: pinch force and stress against interference."""

from pathlib import Path

import flexcage

SHORTER = ("-0.26 mm", "-0.28 mm", "-0.30 mm")  # of a pocket with 0.25 mm of clearance


def main(**changes: object) -> list[float]:
    """Force [N] that the assembled pocket pinches its roller with, one per step."""
    base = flexcage.load_case(Path(__file__).with_name("n1013.toml")).replace(
        **{"solver.duration": "10 ms", **changes}
    )
    forces = []
    for displacement in SHORTER:
        defect = {"type": "side_beam", "pocket": 5, "displacement": displacement}
        run = flexcage.simulate(base.replace("defects", [defect]))
        forces.append(run.start.pinch_force)
        peak = run.summary["stress_peak"] / 1e6
        print(f"{displacement}: pinched with {forces[-1]:.0f} N, then up to {peak:.0f} MPa")
    return forces


if __name__ == "__main__":
    first, _, last = main()
    # the cage is linear: 0.05 mm of interference takes five times the force of 0.01 mm, and a
    # little more, because more of the roller's end comes to bear
    assert abs(last / first / 5 - 1) < 0.06, last / first
