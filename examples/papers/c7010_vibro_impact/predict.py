"""The one row that the paper does not show: the deviation ratio at a clearance of 0.14 mm.

    python examples/papers/c7010_vibro_impact/predict.py -o runs/c7010_vibro_impact

Conclusion 2 names 24.44 % for a load of 12,500 N and, in the same sentence, the ratio at 0.14 mm,
which is not shown. ``value`` is the ratio itself, not an increase, as 24.44 % is read.

ln R(0.14 mm) = m + d. m is ln R of a point of the map of clearances at 0.14 mm, the clearance read
as the pockets', the races' or both (a third of the prior each), weighted by how near ln R of the
same point at 12,500 N is to ln 0.2444 (Gaussian, deviation T), plus that point's own miss times a
share that is uniform from 0 to 1 (a miss may be common to both figures or not); or, with half of
the prior, the printed 24.44 % itself, as if both figures showed a cage that is disturbed alike. d
is Gaussian of deviation T, log-uniform over 0.1 to 0.6.
"""

from __future__ import annotations

import argparse
import json
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
SCATTERS = np.geomspace(0.1, 0.6, 12)  # T
DRAWS, SEED, MOST = 40_000, 1, 2.0
MEANING = (
    "deviation ratio of the cage's mass centre velocity at this clearance (a value or an "
    "increase: say which you took)"
)


def drawn(printed: float, loaded: np.ndarray, wide: np.ndarray, rng) -> np.ndarray:
    """Draws (DRAWS,) of R at 0.14 mm from R of points at 12,500 N and at 0.14 mm; NaN where a
    run is missing."""
    there = np.isfinite(loaded) & np.isfinite(wide)
    at_load, ahead = np.log(loaded[there]), np.log(wide[there])
    miss = np.log(printed) - np.r_[at_load, np.log(printed)]
    middle = np.r_[ahead, np.log(printed)]
    prior = np.r_[np.full(len(ahead), 0.5 / max(len(ahead), 1)), 0.5]
    logs = [-0.5 * (miss / t) ** 2 - np.log(t) + np.log(prior) for t in SCATTERS]
    weight = np.exp(np.array(logs) - np.max(logs))
    chosen = rng.choice(weight.size, DRAWS, p=(weight / weight.sum()).ravel())
    scatter, point = np.unravel_index(chosen, weight.shape)
    shared = rng.uniform(0.0, 1.0, DRAWS)
    found = middle[point] + shared * miss[point] + SCATTERS[scatter] * rng.standard_normal(DRAWS)
    return np.minimum(np.exp(found), MOST)


def prediction(printed: float, loaded: np.ndarray, wide: np.ndarray) -> list[dict]:
    """The entry of the row; ratios as shares."""
    draws = drawn(printed, loaded, wide, np.random.default_rng(SEED))
    low, value, high = 100.0 * np.percentile(draws, (5.0, 50.0, 95.0))
    return [{
        "paper": "004", "table": "text", "row": "0.14 mm", "quantity": "deviation_ratio",
        "unit": "%", "meaning": MEANING, "value": round(float(value), 2),
        "low": round(float(low), 2), "high": round(float(high), 2),
    }]  # fmt: skip


def main() -> None:
    from flexcage.study import MapResults

    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--out", type=Path, default=Path("runs/c7010_vibro_impact"))
    out = parser.parse_args().out
    clearance = MapResults(out / "map_clearance")
    loaded = clearance.means("deviation", "radial 12500 N")
    wide = [clearance.means("deviation", f"{kind} 0.14") for kind in ("pockets", "races", "both")]
    printed = tomllib.loads((HERE / "printed.toml").read_text("utf-8"))
    share = 0.01 * printed["deviation"]["radial 12500 N"]
    rows = prediction(share, np.tile(loaded, 3), np.concatenate(wide))
    text = json.dumps(rows, indent=1)
    (HERE / "predictions.json").write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
