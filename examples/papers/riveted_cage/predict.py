"""Predictions of the rows of Tables 3 and 4 that are not shown, from those that are.

    python examples/papers/riveted_cage/predict.py -o runs/riveted_cage

Table 3. The shown cross gives what pocket radius and width each add to the least force, a and b.
Together they add

    e = (a^(1/q) + b^(1/q))^q exp(rho s + noise) + rest

q = 1 is the plain sum of the cross, Q(Rp, 6.2) + Q(3.46, w) - 25.12; q towards 0 the larger of
both; q above 1 more than the sum, as where they multiply. The prior of q is N(0.85, 0.2^2),
between larger and sum. The computed design goes beyond the sum at its corners by 1.9 +- 1.8 N
(standard error) of 37 N (``interaction``), which is q = 1.17 +- 0.16 at the paper's forces; as its
force hardly knows the width, its error counts as 0.3. Together q is N(0.95, 0.17^2).
rho turns the bowl's axes: s is +1 where both are above or both below their best, else -1; its
deviation is 0.08. The noise's deviation sigma has the likelihood of the cross's six mirror pairs,
ln(a+/a-) ~ N(0, 2 sigma^2), with the prior 1/sigma; the rest is of 0.2 N, an assumption.

Table 4. Slip S of each cage goes with speed n as S(9000) (n/9000)^k. Half of the weight is on
points of the map whose slip is positive, as the measured is, in both cages at all speeds, each with
its own k and the likelihood ln S(9000) ~ N(ln measured, 0.7^2) of both cages; half on k ~ N(0, 1),
which takes no side. Measured over computed slip is ln-normal about the two ratios that are shown.
(An older list of this paper's claims said how the slip goes with speed, which is held back; nothing
here makes use of it.)
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
DRAWS, SEED = 20_000, 1
NORM, TURNED, REST = (0.95, 0.17), 0.08, 0.2  # q, its deviation; those of rho and the rest [N]
RADII = ("3.43", "3.44", "3.45", "3.46", "3.47", "3.48", "3.49")
WIDTHS = ("8", "7.4", "6.8", "6.2", "5.6", "5", "4.4")
AXES = ("cage.pocket_diameter", "cage.width")  # of the 49-point design, Table 3
BEST = 3  # place of the best radius, and of the best width
WIDE, OWN, NEAR, APART = 1.0, 0.04, 0.7, 0.035  # deviations: of k without a map; of one cage and
# speed; of ln S in the likelihood of a point; of ln(measured/computed)
MEANING_3 = "ball-cage impact force at pocket radius x cage width, mm"
MEANING_4 = (
    "cage slip by eq. 10 of the original or modified cage at this speed, measured (experimental) "
    "or the paper's own (artificial)"
)


def excess(printed) -> tuple[float, np.ndarray, np.ndarray]:
    """Least force [N], and what radii (7,) and widths (7,) add to it."""
    table = printed["table_3"]
    least = table["radius"][RADII[BEST]]
    return (
        least,
        np.array([table["radius"][r] - least for r in RADII]),
        np.array([table["width"][w] - least for w in WIDTHS]),
    )


def mirrored(*arms: np.ndarray) -> np.ndarray:
    """ln(a+/a-) of all mirror pairs of arms (7,)."""
    return np.concatenate([np.log(arm[:BEST] / arm[:BEST:-1]) for arm in arms])


def sigmas(pairs: np.ndarray, rng, draws: int = DRAWS) -> np.ndarray:
    """Draws of the noise's deviation from its posterior by the mirror pairs."""
    return np.sqrt(0.5 * (pairs**2).sum() / rng.chisquare(len(pairs), draws))


def joined(a: float, b: float, q) -> np.ndarray:
    """What both add together."""
    return (a ** (1.0 / q) + b ** (1.0 / q)) ** q


def forces(printed, rng) -> dict[str, np.ndarray]:
    """Draws (DRAWS,) of the force of every cell that is not shown, by its row."""
    least, a, b = excess(printed)
    q = np.clip(rng.normal(*NORM, DRAWS), 0.2, None)
    rho = TURNED * rng.standard_normal(DRAWS)
    noise = sigmas(mirrored(a, b), rng)
    found = {}
    for i, radius in enumerate(RADII):
        for j, width in enumerate(WIDTHS):
            if BEST in (i, j):
                continue
            side = 1.0 if (i > BEST) == (j < BEST) else -1.0  # widths are listed from the largest
            own = np.exp(rho * side + noise * rng.standard_normal(DRAWS))
            rest = REST * rng.standard_normal(DRAWS)
            found[f"{radius} x {width}"] = least + joined(a[i], b[j], q) * own + rest
    return found


def additive(printed) -> dict[str, float]:
    """What the shown cross alone predicts."""
    least, a, b = excess(printed)
    return {
        f"{r} x {w}": least + a[i] + b[j]
        for i, r in enumerate(RADII) for j, w in enumerate(WIDTHS) if BEST not in (i, j)
    }  # fmt: skip


def left_out(printed) -> list[tuple[str, float, float, float, float]]:
    """Every shown cell of the cross but the best, from its mirror image alone: row, printed value,
    and the prediction with its 90 % interval."""
    least, a, b = excess(printed)
    found = []
    for names, arm in ((RADII, a), (WIDTHS, b)):
        for i in (i for i in range(len(arm)) if i != BEST):
            pairs = np.delete(mirrored(a, b), (0 if names is RADII else 3) + min(i, 2 * BEST - i))
            rng = np.random.default_rng(SEED)
            noise = np.sqrt(2.0) * sigmas(pairs, rng) * rng.standard_normal(DRAWS)
            low, mid, high = np.percentile(least + arm[2 * BEST - i] * np.exp(noise), (5, 50, 95))
            found.append((names[i], least + arm[i], mid, low, high))
    return found


def powers(slips: np.ndarray) -> np.ndarray:
    """k (points, 2) of slips (points, 3) at 9000, 8000, 7000 rpm that are all positive: from 9000
    to 8000 and to 7000 rpm they went as (n/9000)^k."""
    there = np.isfinite(slips).all(axis=1) & (slips > 0.0).all(axis=1)
    kept = slips[there]
    return np.log(kept[:, 1:] / kept[:, :1]) / np.log(np.array([8000.0, 7000.0]) / 9000.0)


def trends(computed, printed, rng) -> dict[str, np.ndarray]:
    """Draws (DRAWS, 2) of ln(S(n)/S(9000)) at 8000 and 7000 rpm of each cage: k of a point of the
    map whose slip is positive in both cages at all speeds, weighted by how near its slips at 9000
    rpm are to those measured; or as often of N(0, WIDE), which no point says."""
    speeds, cages = ("9000", "8000", "7000"), ("modified", "original")
    means = computed.samples["cage"].means
    slips = {c: np.column_stack([means["slip", f"{c} {n}"] for n in speeds])
             for c in cages}  # fmt: skip
    both = np.hstack([slips[c] for c in cages])
    there = np.isfinite(both).all(axis=1) & (both > 0.0).all(axis=1)
    lever = np.log(np.array([8000.0, 7000.0]) / 9000.0)
    wide = WIDE * rng.standard_normal(DRAWS)[:, None] * lever
    if not there.any():
        return {c: wide + OWN * rng.standard_normal((DRAWS, 2)) for c in cages}
    measured = np.log([0.01 * printed["table_4"]["experimental"][c] for c in cages])
    apart = (np.log(both[there][:, [0, 3]]) - measured) / NEAR
    weight = np.exp(-0.5 * (apart**2).sum(axis=1))
    point = rng.choice(int(there.sum()), DRAWS, p=weight / weight.sum())
    follows = rng.random(DRAWS) < 0.5
    found = {}
    for c in cages:
        own = (powers(slips[c][there]) * lever)[point]
        found[c] = np.where(follows[:, None], own, wide) + OWN * rng.standard_normal((DRAWS, 2))
    return found


def slips(computed, printed, rng) -> dict[str, np.ndarray]:
    """Draws (DRAWS,) of the slip [%] of every row of Table 4 that is not shown."""
    table, found = printed["table_4"], {}
    ratios = [table["experimental"][c] / table["artificial"][c] for c in table["artificial"]]
    mean, spread = np.log(ratios).mean(), APART
    for cage, trend in trends(computed, printed, rng).items():
        for k, speed in enumerate(("8000", "7000")):
            own = table["artificial"][cage] * np.exp(trend[:, k])
            found[f"{cage} {speed} artificial"] = own
            ratio = np.exp(mean + spread * rng.standard_normal(DRAWS))
            found[f"{cage} {speed} experimental"] = own * ratio
    return found


def predictions(computed, printed) -> list[dict]:
    """An entry for every row of the paper that is not shown."""
    rng, rows = np.random.default_rng(SEED), []
    for table, found, quantity, unit, meaning, digits in (
        ("3", forces(printed, rng), "Qcj", "N", MEANING_3, 2),
        ("4", slips(computed, printed, rng), "slip", "%", MEANING_4, 3),
    ):
        for row, draws in found.items():
            low, value, high = np.percentile(draws, (5.0, 50.0, 95.0))
            rows.append({
                "paper": "001", "table": table, "row": row, "quantity": quantity, "unit": unit,
                "meaning": meaning, "value": round(float(value), digits),
                "low": round(float(low), digits), "high": round(float(high), digits),
            })  # fmt: skip
    return rows


def design_samples(computed):
    """Forces of the computed 49-point design over pocket diameter and cage width."""
    from claims import FORCE

    from flexcage.study import StudyResults
    from flexcage.study.samples import samples_of

    return samples_of(StudyResults(computed.out / "design"), FORCE, axes=AXES)


def interaction(computed) -> str:
    """What the computed 49-point design says of q: the force that radius and width add together at
    its four corners, less the sum of what each adds alone, over that sum; and its error."""
    s = design_samples(computed)
    mean, variance = {}, {}
    for r in (6.86, 6.92, 6.98):
        for w in (8.0, 6.2, 4.4):
            y = s.y[np.isclose(s.x, (r, w)).all(axis=1)]
            mean[r, w], variance[r, w] = y.mean(), y.var(ddof=1) / len(y)
    lines = []
    for r in (6.86, 6.98):
        for w in (8.0, 4.4):
            cells = ((r, w), (6.92, 6.2), (r, 6.2), (6.92, w))
            beyond = mean[cells[0]] + mean[cells[1]] - mean[cells[2]] - mean[cells[3]]
            half = 2.0 * np.sqrt(sum(variance[c] for c in cells))
            sum_ = mean[cells[2]] + mean[cells[3]] - 2.0 * mean[cells[1]]
            lines.append(f"{0.5 * r:.2f} x {w:g}: beyond the sum by {beyond:.2f} +- {half:.2f} N; "
                         f"the sum is {sum_:.2f} N")  # fmt: skip
    return "\n".join(lines)


def main() -> None:
    sys.path.insert(0, str(HERE.parent))
    import repeat

    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("-o", "--out", type=Path, default=Path("runs/riveted_cage"))
    computed = repeat.collect(repeat.load(HERE), HERE, parser.parse_args().out)
    from figures import PRINTED

    rows = predictions(computed, PRINTED)
    text = json.dumps(rows, indent=1)
    (HERE / "predictions.json").write_text(text + "\n", encoding="utf-8")
    alone = additive(PRINTED)
    for r in rows:
        cross = f"; the cross alone {alone[r['row']]:.2f}" if r["row"] in alone else ""
        print(f"{r['table']}: {r['row']}: {r['value']} ({r['low']} to {r['high']}){cross}")
    inside = [low <= value <= high for _, value, _, low, high in left_out(PRINTED)]
    print(f"left out, {sum(inside)} of {len(inside)} shown cells lie in their 90 % intervals")
    print(interaction(computed))


if __name__ == "__main__":
    main()
