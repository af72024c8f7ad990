"""A 7603025 whose speed fluctuates: amplitudes and frequencies, in several readings of friction.

    python examples/papers/speed_fluctuation.py             # all, some forty minutes of one core
    python examples/papers/speed_fluctuation.py --quick     # short runs of the base reading

Repeats "Symmetry 2025, 17(10), 1761", prints figures and a verdict on each of its claims;
verdicts.json in the folder of the first reading keeps them. With --page the page and the pictures
beside this script's case are written.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ball_claim import Found, gathered
from speed_fluctuation_claims import AMPLITUDES, CASES, CONSTANT, FREQUENCIES, verdicts
from speed_fluctuation_figures import evaluate
from speed_fluctuation_page import draw, page, table

import flexcage
from flexcage.study.spec import Repeat
from flexcage.study.verdicts import Verdict, write_verdicts

FOLDER = Path(__file__).with_suffix("")
OUT = Path("runs/speed_fluctuation")
BASE = "step"
SPEED, TURN = 2000.0, 30e-3  # rpm, and the time of a turn [s]


def _everywhere(race: float, pocket: float) -> dict[str, Any]:
    """One coefficient of friction at any speed from 10 mm/s on (an assumption)."""
    ramp = {"law": "ramp_coulomb", "v_static": "0.1 mm/s", "v_dynamic": "10 mm/s"}
    return {
        "contacts.race.friction": {**ramp, "dynamic": race},
        "contacts.pocket.friction": {**ramp, "dynamic": pocket},
    }


# what a reading changes; the static coefficient alone is what LS-DYNA takes unless it is given how
# friction decays with speed (DC = 0)
READINGS: Mapping[str, Mapping[str, Any]] = {
    BASE: {},
    "rigid cage": {"cage.model": "rigid"},
    "static friction": _everywhere(0.1, 0.15),
    "dynamic friction": _everywhere(0.002, 0.02),
    "spherical pockets": {"cage.pocket_shape": "spherical"},
}


def points(reading: str) -> list[dict[str, Any]]:
    """Every case of a reading: its label, and the values that it changes."""
    waves = {CONSTANT: None}
    waves |= {label: (share, 1) for label, share in AMPLITUDES.items()}
    waves |= {label: (0.06, count) for label, count in FREQUENCIES.items() if label not in waves}
    return [
        {"label": label, **READINGS[reading], **({} if wave is None else _wave(*wave))}
        for label, wave in waves.items()
    ]


def _wave(share: float, count: int) -> dict[str, str]:
    """A sine of a share of the mean speed, ``count`` times a turn."""
    return {
        "drive.wave": "sine",
        "drive.wave_amplitude": f"{share * SPEED:g} rpm",
        "drive.wave_period": f"{1e3 * TURN / count:g} ms",
    }


def study(reading: str, *, quick: bool = False) -> flexcage.Study:
    """The study of one reading."""
    case = flexcage.load_case(
        FOLDER / "case.toml", overrides={"solver.duration": "0.15 s"} if quick else None
    )
    return flexcage.Study(
        name=f"speed-fluctuation, {reading}",
        case=case,
        axes=[flexcage.study.Points(tuple(points(reading)), name="case")],
        outputs=["cage_speed", "cage_slip_ratio_nominal", "whirl_radius", "pocket_force_peak"],
        repeat=Repeat(count=3 if reading == BASE and not quick else 1, push=20e-3),
    )


def compute(reading: str, out: Path, *, workers: int, quick: bool = False) -> Found:
    """Figures of every finished case of a reading, by label; one entry a start."""
    planned = study(reading, quick=quick)
    return gathered(
        planned,
        out,
        workers=workers,
        evaluate=lambda label, run: evaluate(run, TURN / CASES[label]),
    )


def main(arguments: Sequence[str] | None = None) -> list[Verdict]:
    """Compute what is missing, print figures and verdicts."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="short runs of one reading")
    parser.add_argument("-o", "--out", type=Path, help="folder of the studies")
    parser.add_argument("--readings", nargs="+", choices=READINGS, default=list(READINGS))
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--page", action="store_true", help="write page and pictures")
    options = parser.parse_args(arguments)
    out = options.out or (OUT.with_name(f"{OUT.name}_quick") if options.quick else OUT)
    readings = [BASE] if options.quick else options.readings
    found = {
        r: compute(r, _folder(out, r), workers=options.workers, quick=options.quick)
        for r in readings
    }
    judged = verdicts(found, BASE)
    write_verdicts(_folder(out, BASE), judged)
    print(table(found))
    for verdict in judged:
        print(f"{verdict.key} {verdict.outcome:14} {verdict.claim} ({verdict.range})")
    if options.page:
        results = flexcage.StudyResults(_folder(out, BASE))
        draw(results, FOLDER)
        (FOLDER / "README.md").write_text(page(found, judged), encoding="utf-8")
    return judged


def _folder(out: Path, reading: str) -> Path:
    return out / reading.replace(" ", "_")


if __name__ == "__main__":
    main()
