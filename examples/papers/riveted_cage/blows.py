"""Blows of balls on the riveted cage over its pocket radius: what makes the bowl of Table 3.

    python examples/papers/riveted_cage/blows.py      # fourteen rigid runs: half a minute of a core

Runs the better model at the seven radii of Table 3 with two starts each, and writes blows.csv: how
hard, how many, how fast, and where. Written after the bowl had been seen, so that it explains and
decides nothing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

import flexcage
from flexcage.core.progress import Progress
from flexcage.results import metrics

FOLDER = Path(__file__).parent
RADII = (3.43, 3.44, 3.45, 3.46, 3.47, 3.48, 3.49)  # mm
STARTS = (1, 2)
LEAST = 5.0  # N, from which a largest value counts as a blow
BEFORE = 2  # samples before a blow in which the speed of the approach is read
NEAR = np.sqrt(
    0.5
)  # |cos| of a place's angle to the moment's axis below 45 degrees; half by chance


def approach(ds) -> np.ndarray:
    """How fast every ball moves along the pitch circle relative to the cage there (time, ball)
    [m/s]."""
    psi, r = (ds["element_position"].sel(cyl=c).values for c in ("psi", "r"))
    along = np.stack([-np.sin(psi), np.cos(psi)], axis=-1)
    cage = ds["cage_omega"].values[:, 0, None] * r
    cage = cage + (ds["cage_velocity"].values[:, None, 1:] * along).sum(axis=-1)
    return ds["element_velocity"].sel(cyl="psi").values - cage


def peaks_of(force: np.ndarray, least: float = LEAST) -> list[tuple[int, int]]:
    """Samples and balls (time, ball) at which a force is at a local largest value above
    ``least``."""
    inside = force[1:-1]
    found = (inside > least) & (inside >= force[:-2]) & (inside > force[2:])
    return [(int(i) + 1, int(b)) for i, b in np.argwhere(found)]


def largest_of(force: np.ndarray, turn: int) -> list[tuple[int, int]]:
    """Sample and ball of the largest force of every whole turn of ``turn`` samples."""
    found = []
    for begin in range(0, len(force) - turn + 1, turn):
        i, b = np.unravel_index(force[begin : begin + turn].argmax(), (turn, force.shape[1]))
        found.append((begin + int(i), int(b)))
    return found


def blows(run) -> dict[str, list[float] | float]:
    """Largest blows of every turn of the cage, and all blows of the settled part."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    force = np.abs(ds["pocket_peak"].values).max(axis=-1)
    speed, psi = np.abs(approach(ds)), ds["element_position"].sel(cyl="psi").values
    time = ds["time"].values
    step = float(np.ptp(time)) / (len(time) - 1)
    turn = int(2.0 * np.pi / abs(float(ds["cage_omega"].values[:, 0].mean())) / step)
    largest, all_of_them = largest_of(force, turn), peaks_of(force)
    load = ds["race_force"].sel(race="inner").values
    return {
        "largest": [float(force[i, b]) for i, b in largest],
        "near": [float(abs(np.cos(psi[i, b])) > NEAR) for i, b in largest],
        "load": [float(load[i, b]) for i, b in largest],
        "speed": [float(speed[max(i - BEFORE, 0) : i + 1, b].max()) for i, b in all_of_them],
        "count": len(all_of_them) * turn / len(force),
        "held": float(np.abs(ds["pocket_force"].values).sum(axis=-1).mean()),
        "relative": float(np.sqrt((speed**2).mean())),
        "all_load": float(load.mean()),
    }


def row(radius: float, found: Sequence[Mapping]) -> dict[str, float]:
    """One row of blows.csv from the starts of one radius."""

    def joined(key: str) -> np.ndarray:
        return np.concatenate([f[key] for f in found])

    def mean(key: str) -> float:
        return float(np.mean([f[key] for f in found]))

    return {
        "radius [mm]": radius, "turns": len(joined("largest")),
        "largest of a turn [N]": joined("largest").mean(),
        "blows above 5 N in a turn": mean("count"),
        "fastest twentieth of blows [m/s]": float(np.percentile(joined("speed"), 95.0)),
        "speed of balls relative to the cage, rms [m/s]": mean("relative"),
        "mean force of a pocket [N]": mean("held"),
        "largest near the moment's axis": joined("near").mean(),
        "race force on the ball then [N]": joined("load").mean(),
        "race force on a ball, mean [N]": mean("all_load"),
    }  # fmt: skip


def main() -> pd.DataFrame:
    """Compute, write, print."""
    rows = []
    for radius in RADII:
        found = []
        for start in STARTS:
            case = flexcage.load_case(FOLDER / "case.toml", overrides={
                "cage.pocket_diameter": f"{2.0 * radius:.2f} mm", "start.push": "20 mm/s",
                "start.seed": start,
            })  # fmt: skip
            found.append(blows(flexcage.simulate(case, progress=Progress)))
        rows.append(row(radius, found))
    table = pd.DataFrame(rows)
    table.to_csv(FOLDER / "blows.csv", index=False, float_format="%.4g")
    print(table.T.to_string())
    return table


if __name__ == "__main__":
    main()
