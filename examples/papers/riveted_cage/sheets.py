"""What rivets carry over the sheet's thickness: why claim 001-4b does not hold.

    python examples/papers/riveted_cage/sheets.py     # three flexible runs: half a minute of a core

Runs the better model with a flexible cage at three thicknesses, one start each, and writes
sheets.csv: means of the loads over time and rivets. Written after the stress had been seen.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd

import flexcage
from flexcage.core.progress import Progress
from flexcage.results import metrics

FOLDER = Path(__file__).parent
SHEETS = ("0.7 mm", "0.8 mm", "1.0 mm")


def loads(run) -> dict[str, float]:
    """Mean loads of a rivet over the settled part, and the steady part of its bending."""
    ds = metrics.settled(run.rivets.dataset, run.case.output.settle)
    return {
        "thickness [mm]": run.case.cage.thickness * 1e3,
        "tension [N]": float(ds["tension"].mean()),
        "shear [N]": float(ds["shear"].mean()),
        "bending [mN m]": float(ds["bending"].mean()) * 1e3,
        "steady moment about the pitch circle [mN m]": float(
            ds["moment"].sel(axis="psi").mean()
        ) * 1e3,
        "stress [MPa]": float(ds["stress"].mean()) * 1e-6,
    }  # fmt: skip


def main() -> pd.DataFrame:
    """Compute, write, print."""
    rows = []
    for thickness in SHEETS:
        case = flexcage.load_case(FOLDER / "case.toml", overrides={
            "cage.model": "flexible", "cage.thickness": thickness, "start.push": "20 mm/s",
            "start.seed": 1,
        })  # fmt: skip
        rows.append(loads(flexcage.simulate(case, progress=Progress)))
    table = pd.DataFrame(rows)
    table.to_csv(FOLDER / "sheets.csv", index=False, float_format="%.4g")
    print(table.T.to_string())
    return table


if __name__ == "__main__":
    main()
