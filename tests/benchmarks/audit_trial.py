"""Random plausible bearings, each run for some milliseconds: which of them exceed the audit?

Catalogue bearings of every family, design and type of cage, with defects of cages, spalls, pits,
flats and waves, loads, speeds, mounts and films, drawn from a seed. See README.md, "audit".
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from math import exp, log

import numpy as np

import flexcage
from flexcage.case.catalogue import designations, find
from flexcage.case.new import new_case
from flexcage.core.errors import InputError, RunFailed
from flexcage.geometry.full_complement import CAGED
from flexcage.results.audit import EXCEEDED, OF_CAGE, OF_DRIVE, energy_audit

LARGEST = 61e-3  # m, bore of deep groove ball bearings
CAGES = {
    "deep_groove_ball": ("machined", "ribbon", "crown"),
    "angular_contact_ball": ("machined", "crown"),
    "cylindrical_roller": ("window",),
}
WAVES = ("inner", "outer")


def between(rng: np.random.Generator, low: float, high: float) -> float:
    """A number that is uniform in its logarithm."""
    return exp(rng.uniform(log(low), log(high)))


def plausible_case(
    seed: int, number: int, *, duration: str, method: str = "auto", flexible: float = 0.0
) -> flexcage.Case:
    """Case ``number`` of the trial of ``seed``; combinations that a case refuses are drawn anew."""
    for attempt in range(40):
        rng = np.random.default_rng([seed, number, attempt])
        try:
            changes, text = _drawn(rng, flexible)
            changes |= {"solver.duration": duration, "solver.method": method}
            return flexcage.load_case(text, overrides=changes)
        except InputError:
            continue
    raise RuntimeError(f"no case {number} of seed {seed} can be")


def _drawn(rng: np.random.Generator, flexible: float) -> tuple[dict[str, str], str]:
    """Changes and text of a case for a bearing of the catalogue."""
    rollers = rng.random() < 0.5
    outlines = {n: find(n).outline for n in designations()}
    # numbers of a seed name cases: deep groove ball bearings are those that the first trials drew
    names = [n for n, outline in outlines.items()
             if outline.type in CAGES and outline.complement == CAGED
             and (outline.type == "cylindrical_roller") == rollers
             and (outline.type != "deep_groove_ball" or outline.bore < LARGEST)]  # fmt: skip
    entry = find(names[rng.integers(len(names))])
    outline = entry.outline
    if rollers and outline.design == "NJ" and rng.random() < 0.3:
        outline = replace(outline, design="NF", designation="")
    cages = CAGES[outline.type]
    text = new_case(outline, "trial", cage=cages[rng.integers(len(cages))]).text
    model = "flexible" if rng.random() < flexible else "rigid"
    changes = {"cage.model": model, "mesh.fineness": "coarse"}
    case = flexcage.load_case(text)
    changes |= _operation(rng, case, outline)
    for part in (_race_defects, _element_defects, _cage_defects, _mount):
        changes |= part(rng, case)
    return changes, text


def _operation(rng: np.random.Generator, case: flexcage.Case, outline) -> dict[str, str]:
    """Speed by dn, loads by the dynamic rating, films and drag."""
    b = case.bearing
    rpm = between(rng, 3e4, 1e6) / (1e3 * b.pitch_diameter)
    load = between(rng, 0.005, 0.25) * outline.dynamic_rating
    out = {"drive.speed": f"{rpm:.0f} rpm"}
    if b.element == "ball":
        share = rng.uniform(0.0, 1.0) if b.type == "angular_contact_ball" else rng.uniform(0, 0.5)
        axial = max(share, 0.2 if b.type == "angular_contact_ball" else 0.0)
        out |= {"load.radial": f"{load * (1 - axial):.1f} N", "load.axial": f"{load * axial:.1f} N"}
        if b.type == "angular_contact_ball" and rng.random() < 0.3:
            out["load.tilt"] = "free"
            out["load.tilt_stiffness"] = "1e4 N*m/rad"
    else:
        out["load.radial"] = f"{load:.1f} N"
        if b.design in ("NJ", "NUP", "NF") and rng.random() < 0.6:
            out["load.axial"] = f"{load * rng.uniform(0.02, 0.2):.1f} N"
        if rng.random() < 0.2:
            out["load.misalignment"] = f"{rng.uniform(0.1, 1.0):.2f} mrad"
    if rng.random() < 0.3 and case.cage.guidance in ("inner", "outer"):
        out["contacts.land.kind"] = "film"
    if rng.random() < 0.2:
        out["cage.unbalance"] = f"{between(rng, 0.01, 1.0):.3f} g*mm"
    if rng.random() < 0.2:
        out["bearing.radial_clearance"] = f"{rng.uniform(0.0, 40.0):.1f} um"
    return out


def _race_defects(rng: np.random.Generator, case: flexcage.Case) -> dict[str, str]:
    """A spall (in a third of the cases), waves (in a fifth)."""
    out = {}
    if rng.random() < 0.35:
        ring = WAVES[rng.integers(2)]
        out[f"bearing.{ring}_spall.length"] = f"{between(rng, 0.3, 3.0):.2f} mm"
        out[f"bearing.{ring}_spall.depth"] = f"{between(rng, 5.0, 200.0):.1f} um"
        out[f"bearing.{ring}_spall.azimuth"] = f"{rng.uniform(-180, 180):.1f} deg"
        if rng.random() < 0.4:
            out[f"bearing.{ring}_spall.width"] = f"{between(rng, 0.5, 5.0):.2f} mm"
    if rng.random() < 0.2:
        ring = WAVES[rng.integers(2)]
        out[f"bearing.{ring}_waviness"] = f"{between(rng, 0.2, 5.0):.2f} um"
        out[f"bearing.{ring}_waviness_order"] = str(rng.integers(2, 30))
    return out


def _element_defects(rng: np.random.Generator, case: flexcage.Case) -> dict[str, str]:
    """A pit or a flat of an element (in an eighth of the cases), scatter (in a fifth)."""
    element, out = case.bearing.element, {}
    if rng.random() < 0.125:
        spot = f"bearing.{element}_spot"
        out[f"{spot}.kind"] = ("pit", "flat")[rng.integers(2)]
        out[f"{spot}.size"] = f"{between(rng, 0.2, 1.0):.2f} mm"
        out[f"{spot}.{element}"] = str(rng.integers(case.bearing.element_count))
    if rng.random() < 0.2:
        out[f"bearing.{element}_scatter"] = f"{between(rng, 0.1, 1.0):.2f} um"
    return out


def _cage_defects(rng: np.random.Generator, case: flexcage.Case) -> dict[str, object]:
    """A defect of the cage, in a quarter of the cases."""
    if rng.random() > 0.25:
        return {}
    at = int(rng.integers(case.bearing.element_count))
    claw, side = ("front", "rear")[rng.integers(2)], ("+x", "-x")[rng.integers(2)]
    known: dict[str, list[dict[str, object]]] = {
        "window": [
            {
                "type": "crossbeam",
                "crossbeam": at,
                "displacement": f"{rng.uniform(-0.3, 0.3):.2f} mm",
            },
            {"type": "side_beam", "pocket": at, "side": side, "displacement": "0.1 mm"},
        ],
        "crown": [
            {"type": "bent_claw", "pocket": at, "claw": claw, "deflection": "0.1 mm"},
            {"type": "missing_claw", "pocket": at, "claw": claw},
            {"type": "worn_pocket", "pocket": at, "depth": "0.05 mm"},
        ],
        "machined": [
            {"type": "enlarged", "pocket": at, "increase": "0.2 mm"},
            {"type": "displaced", "pocket": at, "circumferential": "0.1 mm"},
            {"type": "worn_pocket", "pocket": at, "depth": "0.05 mm"},
        ],
        "ribbon": [{"type": "worn_pocket", "pocket": at, "depth": "0.05 mm"}],
    }
    choices = known[case.cage.type]
    return {"defects": [choices[rng.integers(len(choices))]]}


def _mount(rng: np.random.Generator, case: flexcage.Case) -> dict[str, str]:
    """Fixed, on a bushing, or with clearance in a bore."""
    kind = ("fixed", "fixed", "bushing", "contact")[rng.integers(4)]
    if kind == "fixed":
        return {}
    out = {"mount.kind": kind, "mount.stiffness": f"{between(rng, 2e7, 1e9):.2e} N/m"}
    out["mount.damping"] = f"{between(rng, 300.0, 5000.0):.0f} N*s/m"
    if kind == "contact":
        out["mount.clearance"] = f"{rng.uniform(2.0, 30.0):.1f} um"
    return out


def outcome(case: flexcage.Case) -> dict[str, object]:
    """What became of a run: verdict, shares in percent, largest work."""
    begun = time.process_time()
    try:
        run = flexcage.simulate(case, stress=False)
    except (InputError, RunFailed) as exc:
        return {"verdict": "refused", "why": str(exc)}
    audit = energy_audit(run.dataset)
    return {
        "verdict": audit.verdict,
        "of_drive": 100.0 * audit.of_drive,
        "of_cage": 100.0 * audit.of_cage,
        "worst_uJ": 1e6 * audit.worst,
        "moved_uJ": 1e6 * audit.moved,
        "cpu_s": time.process_time() - begun,
    }


def features(case: flexcage.Case) -> str:
    """What is special in a case, in few words."""
    b, said = case.bearing, []
    for ring in WAVES:
        spall = getattr(b, f"{ring}_spall")
        if spall.length:
            wide = f"x{1e3 * spall.width:.2g}" if spall.width else ""
            said.append(f"{ring} spall {1e3 * spall.length:.2g}{wide} {1e6 * spall.depth:.0f}um")
        if getattr(b, f"{ring}_waviness"):
            said.append(f"{ring} waves")
    spot = getattr(b, f"{b.element}_spot")
    said += [f"{spot.kind} {1e3 * spot.size:.2g}"] if spot.size else []
    said += [d.type for d in case.defects]
    said += [case.mount.kind] if case.mount.kind != "fixed" else []
    said += ["film"] if case.contacts.land.kind == "film" else []
    said += ["axial"] if case.load.axial and b.element == "roller" else []
    said += ["misaligned"] if case.load.misalignment else []
    said += ["scatter"] if getattr(b, f"{b.element}_scatter") else []
    return ", ".join(said)


def rows(args: argparse.Namespace) -> Iterator[dict[str, object]]:
    for number in args.only or range(args.first, args.first + args.cases):
        case = plausible_case(
            args.seed, number, duration=args.duration, method=args.method, flexible=args.flexible
        )
        name = case.name + (f" {case.bearing.design}" if case.bearing.element == "roller" else "")
        what = f"{case.cage_model} {case.cage.type}, {features(case)}"
        yield {"case": number, "bearing": name, "with": what, **outcome(case)}


def main(argv: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--only", type=int, nargs="*", help="numbers of cases")
    parser.add_argument("--method", default="auto")
    parser.add_argument("--flexible", type=float, default=0.0, help="share of cages that bend")
    parser.add_argument("--duration", default="3 ms")
    args = parser.parse_args(argv)
    found: Counter[str] = Counter()
    for row in rows(args):
        found[str(row["verdict"])] += 1
        sys.stdout.write(json.dumps(row) + "\n")
        sys.stdout.flush()
    limits = {"of_drive": 100 * OF_DRIVE, "of_cage": 100 * OF_CAGE}
    sys.stdout.write(json.dumps({"verdicts": found, "limits": limits}) + "\n")
    return int(found[EXCEEDED] > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
