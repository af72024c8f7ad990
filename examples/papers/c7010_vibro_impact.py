"""A 7010C over speeds, loads, clearances, waves and accelerations: vibro-impacts of its cage.

    python examples/papers/c7010_vibro_impact.py             # all, some forty minutes of one core
    python examples/papers/c7010_vibro_impact.py --quick     # 40 ms of speeds alone

Repeats "Lubricants 2025, 13(5), 216" in several readings of what it leaves open, prints figures and
a verdict on each of its seven claims; verdicts.json in the folder of the first reading keeps them.
With --page the page and the pictures beside this script's case are written.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ball_claim import gathered
from c7010_vibro_claims import Found, verdicts
from c7010_vibro_figures import evaluate
from c7010_vibro_page import draw, page, table

import flexcage
from flexcage.study.spec import Repeat
from flexcage.study.verdicts import Verdict, write_verdicts

FOLDER = Path(__file__).with_suffix("")
OUT = Path("runs/c7010_vibro_impact")
BASE = "radial"
SPEEDS = (4000, 6000, 8000, 10000, 12000)
LOADS = (5000, 9000, 12500)  # 1500 N is the case at 8000 rpm
CLEARANCES = ("0.02", "0.08", "0.14")
# free contact angles that go with these radial clearances: 1 - cos(alpha) = Pd/(2 A), A = 0.48 mm
ANGLES = {"0.02": "11.716 deg", "0.08": "23.556 deg", "0.14": "31.333 deg"}
WAVES = ("sine", "triangle", "rectangle")
RAMPS = {"slow": "0.4 s", "medium": "0.2 s", "fast": "0.1 s"}  # from 4000 to 12,000 rpm

# load (N) and what else a reading changes
Loads = Mapping[str, float]
READINGS: Mapping[str, tuple[Loads, Mapping[str, Any]]] = {
    BASE: ({"radial": 1.0, "axial": 1.0 / 3.0}, {}),
    "rigid cage": ({"radial": 1.0, "axial": 1.0 / 3.0}, {"cage.model": "rigid"}),
    "1 g mm": ({"radial": 1.0, "axial": 1.0 / 3.0}, {"cage.unbalance": "1 g*mm"}),
    "axial": ({"radial": 0.0, "axial": 1.0}, {}),
    "axial + 1 g mm": ({"radial": 0.0, "axial": 1.0}, {"cage.unbalance": "1 g*mm"}),
    "combined": ({"radial": 1.0, "axial": 1.0}, {}),
    "guided by a land": (
        {"radial": 1.0, "axial": 1.0 / 3.0},
        {
            "cage.guidance": "outer",
            "cage.pocket_shape": "cylindrical",
            "contacts.land.clearance": "0.2 mm",
        },
    ),
    "steeper friction": (
        {"radial": 1.0, "axial": 1.0 / 3.0},
        {
            "contacts.race.friction.v_dynamic": "10 mm/s",
            "contacts.pocket.friction.v_dynamic": "10 mm/s",
        },
    ),
}
SPEEDS_ALONE = ("1 g mm", "axial + 1 g mm")
SHORT = ("guided by a land", "steeper friction")  # speeds, loads and clearances only


def points(reading: str, *, quick: bool = False) -> list[dict[str, Any]]:
    """Every case of a reading: its label, and the values that it changes."""
    share, others = READINGS[reading]

    def point(label: str, load: float = 1500.0, **values: Any) -> dict[str, Any]:
        loads = {f"load.{key}": f"{load * part:.6g} N" for key, part in share.items()}
        named = {key.replace("__", "."): value for key, value in values.items()}
        return {"label": label, **loads, **others, **named}

    def at(rpm: int) -> dict[str, str]:
        return {"drive.speed": f"{rpm} rpm"}

    out = [point(f"{n} rpm", **at(n)) for n in SPEEDS]
    if quick or reading in SPEEDS_ALONE:
        return out
    out += [point(f"{p} N", p) for p in LOADS]
    out += [point(f"pocket {c} mm", **_pocket(c)) for c in CLEARANCES]
    out += [point(f"radial {c} mm", **{"bearing.contact_angle": ANGLES[c]}) for c in CLEARANCES]
    if reading in SHORT:
        return out
    out += [point("no wave", 5000.0, **at(10000))]
    out += [point(f"load {w}", 5000.0, **at(10000), **_load_wave(w, share)) for w in WAVES]
    out += [point(f"speed {w}", 5000.0, **at(10000), **_speed_wave(w)) for w in WAVES]
    out += [point(f"{name} ramp", **_ramp(time)) for name, time in RAMPS.items()]
    held = {"load.centre": "held", "solver.method": "explicit"}
    out += [point(f"held, {n} rpm", **at(n), **held) for n in SPEEDS[::2]]
    out += [point("27 g", **{"cage.material.density": "2840 kg/m^3"})]
    return out


def _pocket(clearance: str) -> dict[str, str]:
    return {"cage.pocket_diameter": f"{8.73 + float(clearance):.2f} mm"}


def _load_wave(shape: str, share: Loads) -> dict[str, str]:
    """A fifth of the load, a hundred times a second (assumptions)."""
    along = "radial" if share["radial"] else "axial"
    return {
        "load.wave": shape, "load.wave_of": along, "load.wave_amplitude": "1000 N",
        "load.wave_period": "10 ms",
    }  # fmt: skip


def _speed_wave(shape: str) -> dict[str, str]:
    """A tenth of the speed, fifty times a second (assumptions)."""
    return {
        "drive.wave": shape, "drive.wave_amplitude": "1000 rpm", "drive.wave_period": "20 ms",
    }  # fmt: skip


def _ramp(time: str) -> dict[str, str]:
    return {
        "drive.speed": "4000 rpm", "drive.ramp_to": "12000 rpm", "drive.ramp_time": time,
        "solver.duration": time,
    }  # fmt: skip


def study(reading: str, *, quick: bool = False) -> flexcage.Study:
    """The study of one reading."""
    case = flexcage.load_case(
        FOLDER / "case.toml", overrides={"solver.duration": "40 ms"} if quick else None
    )
    return flexcage.Study(
        name=f"c7010-vibro-impact, {reading}",
        case=case,
        axes=[flexcage.study.Points(tuple(points(reading, quick=quick)), name="case")],
        outputs=["cage_speed", "cage_slip_ratio_nominal", "velocity_deviation", "whirl_radius"],
        repeat=Repeat(count=2 if reading == BASE and not quick else 1, push=20e-3),
    )


def compute(reading: str, out: Path, *, workers: int, quick: bool = False) -> Found:
    """Figures of every finished case of a reading, by label; one entry a start."""
    planned = study(reading, quick=quick)
    return gathered(planned, out, workers=workers, evaluate=lambda _, run: evaluate(run))


def main(arguments: Sequence[str] | None = None) -> list[Verdict]:
    """Compute what is missing, print figures and verdicts."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="short runs of the speeds")
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
        (FOLDER / "README.md").write_text(page(results, found, judged), encoding="utf-8")
    return judged


def _folder(out: Path, reading: str) -> Path:
    return out / reading.replace(" ", "_")


if __name__ == "__main__":
    main()
