"""Predictions of the rows of Tables 4 and 5 that are not shown, by a likelihood of those that are.

    python examples/papers/c7010_centroid/predict.py -o runs/c7010_centroid

For the measured (solved by the paper's equations) and the simulated (centroid) difference of whirl
radii D alike, each with the map's own:

    ln D(n) = m(n) + d(n)

d is a Gaussian process of deviation T, correlated as exp(-(n - n')^2/2L^2) with L = 3000 rpm. m is
either a constant that is not known (vague prior), or ln D of a point of the map that belongs to the
rows, plus such a constant. Both have equal prior odds, T is log-uniform over 0.05 to 1. The shown
rows give the posterior of points and T; the rest is drawn from it. The deflection error is
log-uniform between the two that are printed: the paper says that it falls to 10,000 rpm and rises
from there.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
LENGTH, LEVEL = 3000.0, 1.0  # rpm; deviation of the constant's prior, in ln
SPREADS = np.geomspace(0.05, 1.0, 25)  # T
DRAWS, SEED = 20_000, 1
SHOWN, AHEAD = np.array([4000.0, 10000.0]), np.array([7000.0, 11000.0])


def correlation(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.exp(-0.5 * ((a[:, None] - b[None, :]) / LENGTH) ** 2)


def posterior(shown: np.ndarray, means: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Log evidence (points, spreads) of ln D shown (2,) under each mean (points, 2)."""
    rest = shown - means
    found = np.empty((len(means), len(SPREADS)))
    for k, spread in enumerate(SPREADS):
        cover = spread**2 * correlation(SHOWN, SHOWN) + LEVEL**2
        solved = np.linalg.solve(cover, rest.T).T
        found[:, k] = -0.5 * ((rest * solved).sum(axis=1) + np.linalg.slogdet(2 * np.pi * cover)[1])
    return found, rest


def drawn(shown: np.ndarray, at_shown: np.ndarray, ahead: np.ndarray, rng) -> np.ndarray:
    """Draws (DRAWS, 2) of D at ``AHEAD``, from D shown (2,) and the map's D there and ahead."""
    start = np.log(shown).mean()
    means = np.vstack([np.full((1, 2), start), np.log(at_shown)])
    later = np.vstack([np.full((1, 2), start), np.log(ahead)])
    evidence, rest = posterior(np.log(shown), means)
    prior = np.concatenate([[0.5], np.full(len(at_shown), 0.5 / max(len(at_shown), 1))])
    weight = np.exp(evidence - evidence.max()) * prior[:, None]
    chosen = rng.choice(weight.size, DRAWS, p=(weight / weight.sum()).ravel())
    points, spreads = np.unravel_index(chosen, weight.shape)
    out = np.empty((DRAWS, 2))
    for k in np.unique(spreads):
        s2 = SPREADS[k] ** 2
        cover = s2 * correlation(SHOWN, SHOWN) + LEVEL**2
        cross = s2 * correlation(AHEAD, SHOWN) + LEVEL**2
        gain = cross @ np.linalg.inv(cover)
        left = s2 * correlation(AHEAD, AHEAD) + LEVEL**2 - gain @ cross.T
        root = np.linalg.cholesky(left + 1e-12 * np.eye(2))
        mine = np.flatnonzero(spreads == k)
        noise = rng.standard_normal((len(mine), 2)) @ root.T
        out[mine] = later[points[mine]] + rest[points[mine]] @ gain.T + noise
    return np.exp(out)


def errors(printed: dict[str, float], rng) -> np.ndarray:
    """Draws (DRAWS, 2) of the deflection error as a share."""
    low, high = sorted(printed.values())
    return 0.01 * np.exp(rng.uniform(np.log(low), np.log(high), (DRAWS, 2)))


def predictions(computed, printed) -> list[dict]:
    """An entry for every row of the paper that is not shown."""
    rng, rows = np.random.default_rng(SEED), []
    tables = (
        ("4", "test", "solved", "solved", "measured", "solved",
         ("measured vortex radius difference at this inner speed, rpm",
          "the same after the paper's correction")),
        ("5", "model", "difference", "centroid", "origin", "centroid",
         ("simulated difference at the measuring origin", "simulated difference of the centroid")),
    )  # fmt: skip
    for table, column, output, row, raw, plain, meanings in tables:
        numbers = printed[f"table_{table}"]
        means = computed.samples[column].means
        found = {n: means[output, f"{n:.0f}"] * 1e3 for n in (*SHOWN, *AHEAD)}
        whole = np.isfinite(list(found.values())).all(axis=0)
        at_shown, ahead = (
            np.column_stack([found[n][whole] for n in speeds]) for speeds in (SHOWN, AHEAD)
        )
        shown = np.array([numbers[row][f"{n:.0f}"] for n in SHOWN])
        centre = drawn(shown, at_shown, ahead, rng)
        seen = centre * (1.0 + errors(numbers["error"], rng))
        for k, speed in enumerate(AHEAD):
            for name, values, meaning in ((raw, seen, meanings[0]), (plain, centre, meanings[1])):
                low, value, high = np.percentile(values[:, k], (5.0, 50.0, 95.0))
                rows.append({
                    "paper": "003", "table": table, "row": f"{speed:.0f}", "quantity": name,
                    "unit": "mm", "meaning": meaning, "value": round(float(value), 4),
                    "low": round(float(low), 4), "high": round(float(high), 4),
                })  # fmt: skip
    return sorted(rows, key=lambda r: (int(r["row"]), r["table"]))


def main() -> None:
    sys.path.insert(0, str(HERE.parent))
    import repeat

    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--out", type=Path, default=Path("runs/c7010_centroid"))
    computed = repeat.collect(repeat.load(HERE), HERE, parser.parse_args().out)
    from figures import PRINTED

    text = json.dumps(predictions(computed, PRINTED), indent=1)
    (HERE / "predictions.json").write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
