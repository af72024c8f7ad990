"""Predictions of the rows of Tables 6 and 7 that are not shown, by a likelihood of those that are.

    python examples/papers/speed_fluctuation/predict.py -o runs/speed_fluctuation

**Which row is which.** A = 6 % of Table 6 and N = 1 of Table 7 are one case with two pairs of
numbers, and Table 6's pair is Table 7's of N = 2. Either Table 6 took over the wrong row, so that
Table 7 is right, or Table 7 has N = 1 and N = 2 exchanged: a mixture of both, half and half.

**Fluctuation.** ln S(c) = m(c) + l + d(c) over the cases c. m is ln S of a point of the map of the
model, or of the law S^p = S0^p + (g A)^p at any N, p from 1 (a constant fluctuation adds to the
ring's) over 2 (it is independent of it) to 8 (the larger one rules), with S0 and g from the shown
rows: half of the prior each. l is an unknown level (deviation 0.3 for points, 0.03 for the law),
d independent scatter of deviation T, log-uniform over 0.02 to 0.2. The shown rows give the
posterior of points, p and T.

**Mean speed.** No point of a map has the printed 1.4 % below kinematics, so means follow from the
shown rows alone: v(c) = v0 + a A/6 % + b (N - 1) + e for cases with waves, a and b of deviation
3 rpm about zero, e of deviation s, log-uniform over 0.5 to 3 rpm. Figures taken once a millisecond
of a speed that fluctuates by 6 % scatter by 1 to 2 rpm.
"""

from __future__ import annotations

import argparse
import json
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
SHOWN, AHEAD = ("constant", "A 6 %", "N 2"), ("A 3 %", "A 9 %", "N 3")
RINGS = {"constant": 0.0, "A 3 %": 3.0, "A 6 %": 6.0, "A 9 %": 9.0, "N 2": 6.0, "N 3": 6.0}  # %
WAVES = {"constant": 0.0, "A 3 %": 1.0, "A 6 %": 1.0, "A 9 %": 1.0, "N 2": 2.0, "N 3": 3.0}
ROWS = {"A 3 %": ("6", "A = 3 %"), "A 9 %": ("6", "A = 9 %"), "N 3": ("7", "N = 3")}
POWERS = np.geomspace(1.0, 8.0, 13)  # p
LEVELS = {"points": 0.3, "law": 0.03}  # deviations of l
SCATTERS = np.geomspace(0.02, 0.2, 12)  # T
SLOPE, NOISES = 3.0, np.geomspace(0.5, 3.0, 12)  # rpm: deviation of a and b; s
DRAWS, SEED = 20_000, 1
MEANINGS = {
    "cage_speed": ("rpm", "mean cage speed of the paper's LS-DYNA run"),
    "fluctuation": ("%", "fluctuation amplitude A_c of the cage speed"),
}


def hypotheses(printed) -> list[dict[str, tuple[float, float]]]:
    """Mean [rpm] and fluctuation [%] of the shown cases, as either table has them."""
    six, seven = printed["table_6"], printed["table_7"]
    one = {c: (seven["speed"][c], seven["swing"][c]) for c in SHOWN}
    other = dict(one)
    other["A 6 %"] = (six["speed"]["A 6 %"], six["swing"]["A 6 %"])
    other["N 2"] = one["A 6 %"]
    return [one, other]


def by_law(shown: dict[str, float]) -> np.ndarray:
    """ln S of ``SHOWN`` and ``AHEAD`` (powers, 6) by the law of every power, from S shown [%]."""
    cases, rows = (*SHOWN, *AHEAD), []
    still, with_waves = shown["constant"], np.mean([shown["A 6 %"], shown["N 2"]])
    for p in POWERS:
        gain = (with_waves**p - still**p) ** (1.0 / p) / RINGS["A 6 %"]
        rows.append([np.log((still**p + (gain * RINGS[c]) ** p) ** (1.0 / p)) for c in cases])
    return np.array(rows)


def gaussian(rest: np.ndarray, level: float, scatter: float) -> np.ndarray:
    """Log density (members,) of residuals (members, n) with a common level and own scatter."""
    cover = scatter**2 * np.eye(rest.shape[1]) + level**2
    solved = np.linalg.solve(cover, rest.T).T
    return -0.5 * ((rest * solved).sum(axis=1) + np.linalg.slogdet(2.0 * np.pi * cover)[1])


def fluctuations(shown: dict[str, float], points: np.ndarray, rng) -> np.ndarray:
    """Draws (DRAWS, 3) of S [%] at ``AHEAD``; ``points``: ln S (members, 6) of a map."""
    groups = [(points, LEVELS["points"]), (by_law(shown), LEVELS["law"])]
    seen = np.log([shown[c] for c in SHOWN])
    weights, members = [], []
    for means, level in groups:
        evidence = [gaussian(seen - means[:, :3], level, t) for t in SCATTERS]
        weights.append(np.array(evidence).T - np.log(2.0 * max(len(means), 1)))
        members += [(means, level, i) for i in range(len(means))]
    log_w = np.vstack(weights)
    weight = np.exp(log_w - log_w.max())
    chosen = rng.choice(weight.size, DRAWS, p=(weight / weight.sum()).ravel())
    which, scatter = np.unravel_index(chosen, weight.shape)
    out = np.empty((DRAWS, 3))
    for k, (member, t) in enumerate(zip(which, SCATTERS[scatter])):
        means, level, i = members[member]
        rest = seen - means[i, :3]
        left = 1.0 / (3.0 / t**2 + 1.0 / level**2)  # variance of the level, given the shown rows
        height = left * rest.sum() / t**2 + np.sqrt(left) * rng.standard_normal()
        out[k] = means[i, 3:] + height + t * rng.standard_normal(3)
    return np.exp(out)


def means(shown: dict[str, float], rng) -> np.ndarray:
    """Draws (DRAWS, 3) of the mean speed [rpm] at ``AHEAD``."""

    def columns(cases) -> np.ndarray:
        return np.array([[1.0, RINGS[c] / 6.0, max(WAVES[c] - 1.0, 0.0)] for c in cases])

    seen, ahead = columns(SHOWN), columns(AHEAD)
    prior = np.diag([1e3, SLOPE, SLOPE]) ** 2
    values = np.array([shown[c] for c in SHOWN]) - shown["constant"]
    draws, logs = [], []
    for s in NOISES:
        cover = seen @ prior @ seen.T + s**2 * np.eye(3)
        gain = prior @ seen.T @ np.linalg.inv(cover)
        middle, left = gain @ values, prior - gain @ seen @ prior
        found = rng.multivariate_normal(middle, left, DRAWS) @ ahead.T
        draws.append(found + s * rng.standard_normal(found.shape))
        logs.append(-0.5 * (values @ np.linalg.solve(cover, values)
                            + np.linalg.slogdet(cover)[1]))  # fmt: skip
    weight = np.exp(np.array(logs) - max(logs))
    chosen = rng.choice(len(NOISES), DRAWS, p=weight / weight.sum())
    return shown["constant"] + np.array(draws)[chosen, np.arange(DRAWS)]


def predictions(swings: dict[str, np.ndarray], printed) -> list[dict]:
    """An entry for every row that is not shown; ``swings``: S of a map's points by case."""
    rng = np.random.default_rng(SEED)
    table = np.array([swings[c] for c in (*SHOWN, *AHEAD)]).T
    points = np.log(table[np.isfinite(table).all(axis=1)])
    speed, swing = [], []
    for case in hypotheses(printed):
        speed.append(means({c: v[0] for c, v in case.items()}, rng))
        swing.append(fluctuations({c: v[1] for c, v in case.items()}, points, rng))
    rows = []
    for k, case in enumerate(AHEAD):
        number, row = ROWS[case]
        for quantity, draws in (("cage_speed", speed), ("fluctuation", swing)):
            unit, meaning = MEANINGS[quantity]
            low, value, high = np.percentile(np.vstack(draws)[:, k], (5.0, 50.0, 95.0))
            rows.append({
                "paper": "002", "table": number, "row": row, "quantity": quantity, "unit": unit,
                "meaning": meaning, "value": round(float(value), 2), "low": round(float(low), 2),
                "high": round(float(high), 2),
            })  # fmt: skip
    return rows


def main() -> None:
    from flexcage.study import MapResults

    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--out", type=Path, default=Path("runs/speed_fluctuation"))
    found = MapResults(parser.parse_args().out / "map_model")
    swings = {c: 100.0 * found.means("swing", c) for c in (*SHOWN, *AHEAD)}
    printed = tomllib.loads((HERE / "printed.toml").read_text("utf-8"))
    text = json.dumps(predictions(swings, printed), indent=1)
    (HERE / "predictions.json").write_text(text + "\n", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
