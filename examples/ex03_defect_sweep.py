"""A crossbeam bent further and further: how much play its narrowed pocket leaves the roller."""

from pathlib import Path

import numpy as np

import flexcage
from flexcage.results.metrics import cage_angle

STEPS = ("0 mm", "0.1 mm", "0.19 mm")  # of a circumferential clearance of 0.2 mm
POCKET = 4  # narrowed when crossbeam 5 moves


def play(run: flexcage.Run) -> float:
    """Range [m] of roller 4's position across its pocket, seen from the cage."""
    ds = run.dataset
    turn = cage_angle(ds) + 2 * np.pi * POCKET / ds.sizes["pocket"]
    _, r, psi = ds["roller_position"].sel(roller=POCKET).values.T
    y, z = ds["cage_position"].values[:, 1:].T
    return float(
        np.ptp((r * np.sin(psi) - z) * np.cos(turn) - (r * np.cos(psi) - y) * np.sin(turn))
    )


def main(**changes: object) -> list[float]:
    """Play [m] of roller 4 in its pocket during the run, one per step of the defect."""
    base = flexcage.load_case(Path(__file__).with_name("n1013.toml")).replace(**changes)
    plays = []
    for step in STEPS:
        plays.append(play(flexcage.simulate(base.replace("defects.0.displacement", step))))
        print(f"{step:>8}: the roller moved {plays[-1] * 1e6:.0f} um across its pocket")
    return plays


if __name__ == "__main__":
    tight = main()[-1]
    assert tight < 30e-6, tight  # 10 um of clearance are left, and the walls yield a little
