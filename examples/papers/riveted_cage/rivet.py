"""The rivet of the riveted cage over its fit, as in figure 10 of "Machines 2024, 12(7), 466".

    python examples/papers/riveted_cage/rivet.py RUN            # the folder of a run, flexible cage
    python examples/papers/riveted_cage/rivet.py RUN --force 25 # loads scaled to that ball force, N
    python examples/papers/riveted_cage/rivet.py RUN --assumed  # what is assumed, each alone

Takes the loads of the run's most stressed rivet through a cycle, for fits from interference to
play, and writes fits.csv and lives.csv into the folder of the page. Prints what becomes of claim
001-7, by rules that were fixed before any fit was computed (``judged``). With ``--assumed`` it
writes assumed.csv instead: clamp, friction and root radius at the ends of their ranges.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

import flexcage
from flexcage.mesh.riveted_joint import JointMesh
from flexcage.stress.riveted_joint import PLACES, Fits, JointResult, fits_of
from flexcage.stress.rivets import Rivets

FOLDER = Path(__file__).parent
HOLDS, FAILS, UNDECIDED = "holds", "fails", "undecided"
#: Play over the diameter [m]. The paper gives no values; an upset shank fills its hole or presses
#: on it, and a punched hole of 1.2 mm has some hundredths of a millimetre of play at most.
PLAYS = (-6e-6, -3e-6, 0.0, 3e-6, 10e-6, 20e-6)
#: What no one knows, and why in this range: a clamp of 20 to 200 N is 20 to 180 MPa in the shank,
#: up to about half of a soft steel's yield stress; friction of steel on steel with grease or
#: without 0.1 to 0.3; roots of cold headed rivets 0.05 to 0.2 mm.
ASSUMED = {"clamp": (20.0, 100.0, 200.0), "friction": (0.1, 0.15, 0.3),
           "root_radius": (0.05e-3, 0.1e-3, 0.2e-3)}  # fmt: skip
MESH = JointMesh(sectors=8, size=1.0, seat=0.3, growth=1.2)
SMALL = 3e-6  # play [m] at which what is assumed is varied
COARSE = JointMesh(sectors=6, size=1.5, seat=0.5, growth=2.0)  # for that, as in outputs.py
CLEAR = 0.05  # share by which one stress must exceed another to count as larger


def judged(results: Sequence[JointResult]) -> dict[str, str]:
    """Claim 001-7 in three parts: under interference the largest stress is at the edge of the
    heads, with play at their roots; a small play lowers the stress at the edge."""
    peaks = {r.fit.play: {p.place: p.stress for p in r.peaks()} for r in results}
    tight = [p for play, p in peaks.items() if play < 0.0]
    loose = [p for play, p in peaks.items() if play > 0.0]
    small = min(play for play in peaks if play > 0.0)
    return {
        "at the edge under interference": _all(_larger(p["eave"], p["root"]) for p in tight),
        "at the root with play": _all(_larger(p["root"], p["eave"]) for p in loose),
        "less at the edge with a small play": _all(
            _larger(p["eave"], peaks[small]["eave"]) for p in tight
        ),
    }


def _larger(one: float, other: float) -> str:
    if one > (1.0 + CLEAR) * other:
        return HOLDS
    return FAILS if one < (1.0 + CLEAR) * other and other > (1.0 + CLEAR) * one else UNDECIDED


def _all(outcomes: Sequence[str] | object) -> str:
    found = set(outcomes)  # type: ignore[call-overload]
    if found == {HOLDS}:
        return HOLDS
    return FAILS if FAILS in found else UNDECIDED


def scaled(rivets: Rivets, factor: float) -> Rivets:
    """The same loads, each ``factor`` times as large: the cage is linear."""
    return Rivets(factor * rivets.dataset, rivets.diameter, rivets.settled)


def computed(
    run: flexcage.Run, factor: float, plays: Sequence[float] = PLAYS, mesh: JointMesh = MESH,
    **changed: float,
) -> Fits:  # fmt: skip
    """The joint over fits, with what is assumed at its middle or ``changed``."""
    values = {name: low_mid_high[1] for name, low_mid_high in ASSUMED.items()} | changed
    case = run.case
    shape = case.cage.rivet_joint(
        case.bearing.pitch_diameter, case.bearing.element_count, values["root_radius"]
    )
    return fits_of(
        scaled(run.rivets, factor), shape, case.cage.material, plays, clamp=values["clamp"],
        friction=values["friction"], mesh=mesh,
    )  # fmt: skip


def assumed(run: flexcage.Run, factor: float) -> pd.DataFrame:
    """One row for the middle of what is assumed, and one for each end of it, each alone."""
    ends = [(name, value) for name, (low, _, high) in ASSUMED.items() for value in (low, high)]
    changes = [{}, *({name: value} for name, value in ends)]
    rows = []
    for changed in changes:
        (result,) = computed(run, factor, (SMALL,), COARSE, **changed)
        root = result.places["root"]
        rows.append({
            "changed": next(iter(changed), "-"), "value [SI]": next(iter(changed.values()), None),
            "root, clamped [MPa]": result.instants["clamped"].equivalent[root].max() / 1e6,
            "root, again [MPa]": result.instants["again"].equivalent[root].max() / 1e6,
            "range at the root [MPa]": result.range_at("root")[0] / 1e6,
            "nominal range [MPa]": result.nominal_range / 1e6, "K_t": result.K_t,
            "cycles, least": least_life(result),
        })  # fmt: skip
    return pd.DataFrame(rows)


def least_life(result: JointResult) -> float:
    """Fewest cycles over all steels, readings of the rule, and corrections for the mean stress."""
    return min(0.5 * cycles for life in result.lives() for cycles in (life.swt, life.morrow))


def frame(fits: Fits) -> pd.DataFrame:
    """One row a fit: peaks at the largest load, before any load, ranges and K_t."""
    rows = []
    for r in fits:
        row: dict[str, object] = {"play [um]": r.fit.play * 1e6, "clamp [N]": r.fit.clamp}
        for place, words in PLACES.items():
            for instant in ("clamped", "again"):
                value = r.instants[instant].equivalent[r.places[place]].max()
                row[f"{words}, {instant} [MPa]"] = value / 1e6
        row |= {"nominal range [MPa]": r.nominal_range / 1e6,
                "range at the root [MPa]": r.range_at("root")[0] / 1e6, "K_t": r.K_t}  # fmt: skip
        row |= {f"pressure, {name} [MPa]": p / 1e6 for name, p in r.largest_pressure.items()}
        row |= {f"slip, {name} [um]": s * 1e6 for name, s in r.slip.items()}
        rows.append(row)
    return pd.DataFrame(rows)


def lives(fits: Fits) -> pd.DataFrame:
    """One row a fit, a steel and a reading of the modified Neuber rule."""
    return pd.DataFrame([
        {"play [um]": r.fit.play * 1e6, "steel": life.steel.name, "K_f by": life.reading,
         "dS [MPa]": life.nominal / 1e6, "K_t": life.K_t, "K_f": life.K_f,
         "local range [MPa]": life.stress / 1e6, "elastic": life.elastic,
         "cycles, SWT": 0.5 * life.swt, "cycles, Morrow": 0.5 * life.morrow}
        for r in fits for life in r.lives()
    ])  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> dict[str, str]:
    """Compute, write, print."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", help="folder of a run with a flexible riveted cage")
    parser.add_argument("--force", type=float, help="mean of the largest of a ball pass, N")
    parser.add_argument("--assumed", action="store_true", help="vary what is assumed")
    parser.add_argument("-o", "--out", type=Path, default=FOLDER)
    options = parser.parse_args(arguments)
    run = flexcage.load_run(options.run)
    own = float(run.summary["pocket_force_pass_peak"])
    factor = 1.0 if options.force is None else options.force / own
    if options.assumed:
        table = assumed(run, factor)
        table.to_csv(options.out / "assumed.csv", index=False, float_format="%.4g")
        print(table.to_string())
        return {}
    fits = computed(run, factor)
    frame(fits).round(4).to_csv(options.out / "fits.csv", index=False)
    lives(fits).to_csv(options.out / "lives.csv", index=False, float_format="%.5g")
    verdict = judged(fits.results)
    print(fits)
    for life in fits.results[-1].lives():
        print(life)
    for part, outcome in verdict.items():
        print(f"001-7 {part}: {outcome}")
    return verdict


if __name__ == "__main__":
    main()
