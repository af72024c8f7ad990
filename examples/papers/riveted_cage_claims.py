"""The claims of the paper on riveted cages, as tests on the figures of a reading.

What counts was fixed before the study was computed: a figure "rises" or "falls" if it does beyond
the intervals from each case to the next; it has "its least within" if the ends of a sweep are
beyond the intervals above its least; it is "flat" if it stays within 10 % of the base case's.
Stress of rivets came later, by the same rules; before it, that at waists and rims took its place.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from ball_claim import Claim, Found, Shown, View, rising

import flexcage
from flexcage.results.metrics import settled
from flexcage.results.statistics import element_passes
from flexcage.study.verdicts import Estimate, Verdict, every, less, unchanged

PAPER = "Machines 2024, 12(7), 466"
BASE = "base"
#: Values of every sweep by label, SI; the base case is in all of them.
RADII = {f"Rp {r:.2f}": r * 1e-3 for r in (3.43, 3.44, 3.45)} | {BASE: 3.46e-3} | {
    f"Rp {r:.2f}": r * 1e-3 for r in (3.47, 3.48, 3.54, 3.60)}  # fmt: skip
FAR = tuple(RADII)
NEAR = FAR[:6]  # the paper's own
WIDTHS = {"w 6.3": 6.3e-3, BASE: 6.5e-3, "w 6.8": 6.8e-3, "w 7.4": 7.4e-3, "w 8.0": 8.0e-3}
SHEETS = {"t 0.7": 0.7e-3, BASE: 0.8e-3, "t 1.0": 1.0e-3}
GROOVES = {"f 0.505/0.515": (0.505, 0.515), "f 0.510/0.520": (0.510, 0.520),
           BASE: (0.515, 0.525), "f 0.520/0.530": (0.520, 0.530)}  # fmt: skip
CLEARANCES = {"Pd 5": 5e-6, BASE: 10e-6, "Pd 15": 15e-6, "Pd 20": 20e-6}
SPEEDS = ("7000", "8000", "9000")  # rpm
ORIGINAL = tuple(f"original {n}" for n in SPEEDS)  # Rp 3.60, w 8.0
MODIFIED = tuple(f"modified {n}" for n in SPEEDS)  # Rp 3.46, w 6.2


@dataclass(frozen=True)
class Figures:
    """One run, its settled part; SI."""

    force: Estimate  # largest of a ball pass on the cage, mean over passes
    contact: Estimate  # mean force of a pocket while it is touched
    slip: Estimate  # of the cage, behind balls that roll at a contact angle of zero
    tilt: Estimate  # of the cage's axis, mean
    off_plane: Estimate  # largest distance of the cage's centre from the outer ring's axis
    stress: Estimate | None  # largest of a ball pass, at waists and rims
    ring_tilt: Estimate
    rivet: Estimate | None  # largest nominal stress of a rivet in a ball pass


#: How figures are shown: name, unit, factor from SI.
SHOWN: Shown = {
    "force": ("ball-cage force of a pass", "N", 1.0),
    "contact": ("mean force in contact", "N", 1.0),
    "slip": ("cage slip ratio", "%", 100.0),
    "tilt": ("cage tilt", "deg", 57.29578),
    "off_plane": ("largest whirl radius", "um", 1e6),
    "stress": ("stress at waists and rims", "MPa", 1e-6),
    "ring_tilt": ("tilt of the ring", "mrad", 1e3),
    "rivet": ("nominal stress of rivets", "MPa", 1e-6),
}


def evaluate(run: flexcage.Run) -> Figures:
    """Figures of a run, from its summary and of its rivets."""
    s = run.summary

    def of(key: str) -> Estimate:
        row = s.row(key)
        margin = float("nan") if row.margin is None else row.margin
        return Estimate(float(row.value), margin)

    return Figures(
        force=of("pocket_force_pass_peak"), contact=of("pocket_force_mean"),
        slip=of("cage_slip_ratio_nominal"), tilt=of("tilt_mean"), off_plane=of("whirl_radius_max"),
        stress=of("stress_root_pass_peak") if "stress_root_pass_peak" in s else None,
        ring_tilt=of("inner_tilt"), rivet=_rivet_stress(run),
    )  # fmt: skip


def _rivet_stress(run: flexcage.Run) -> Estimate | None:
    """Of the most stressed rivet the largest of a ball pass, mean over passes."""
    if run.cage is None:
        return None
    share = run.case.output.settle
    worst = settled(run.rivets.dataset, share)["stress"].max("rivet").values
    record = element_passes(settled(run.dataset, share), run.numbers).peak(worst)
    return Estimate(record.value, record.margin)


Test = Callable[[View], str]


def least_within(key: str, labels: Sequence[str]) -> Test:
    """Do both ends of a sweep exceed the least value between them?"""

    def test(view: View) -> str:
        first, *between, last = view.all(key, labels)
        low = min(between, key=lambda v: v.value)
        return every(less(low, end) for end in (first, last))

    return test


def flat(key: str, labels: Sequence[str]) -> Test:
    return lambda view: every(
        unchanged(view(key, BASE), view(key, label), within=0.1) for label in labels
    )


def higher(key: str, labels: Sequence[str], others: Sequence[str]) -> Test:
    """Is a figure of each of these cases above that of its counterpart?"""
    return lambda view: every(
        less(view(key, other), view(key, label)) for label, other in zip(labels, others)
    )


def _claim(key: str, text: str, cases: Sequence[str], parts: Mapping[str, Test], *shown: str):
    return Claim(key, text, parts, tuple(cases), shown)


FALL = {"up": False}
CLAIMS = (
    _claim(
        "001-1", "The ball-cage force over the pocket radius has its least within, at 3.46 mm, and "
        "so has the rivets' stress",
        RADII,
        {"the paper's radii": least_within("force", NEAR), "all": least_within("force", FAR),
         "rivets": least_within("rivet", NEAR)},
        "force", "contact", "rivet",
    ),
    _claim(
        "001-2", "Slip rises with the pocket radius; the cage's tilt falls",
        RADII,
        {"slip": rising("slip", tuple(RADII)), "tilt": rising("tilt", tuple(RADII), **FALL)},
        "slip", "tilt",
    ),
    _claim(
        "001-3", "The force over the cage's width has its least within, at 6 to 6.5 mm; its tilt "
        "falls with width",
        WIDTHS,
        {"least within": least_within("force", tuple(WIDTHS)),
         "tilt": rising("tilt", tuple(WIDTHS), **FALL)},
        "force", "tilt", "slip",
    ),
    _claim(
        "001-4", "The force over the sheet's thickness is least at 0.8 mm; the rivets' stress "
        "falls with it, and slip is flat",
        SHEETS,
        {"least at 0.8": least_within("force", tuple(SHEETS)),
         "rivets": rising("rivet", tuple(SHEETS), **FALL), "slip": flat("slip", tuple(SHEETS))},
        "force", "rivet", "stress", "slip",
    ),
    _claim(
        "001-5", "Wider grooves lower tilt and slip",
        GROOVES,
        {"tilt": rising("tilt", tuple(GROOVES), **FALL),
         "slip": rising("slip", tuple(GROOVES), **FALL)},
        "tilt", "slip", "force",
    ),
    _claim(
        "001-6", "Force, tilt and slip rise with the radial clearance",
        CLEARANCES,
        {key: rising(key, tuple(CLEARANCES)) for key in ("force", "tilt", "slip")},
        "force", "tilt", "slip",
    ),
    _claim(
        "001-8", "Slip rises with speed, and is larger with the original cage than with the "
        "modified one",
        (*ORIGINAL, *MODIFIED),
        {"original with speed": rising("slip", ORIGINAL),
         "modified with speed": rising("slip", MODIFIED),
         "original above modified": higher("slip", ORIGINAL, MODIFIED)},
        "slip", "force",
    ),
)  # fmt: skip


def verdicts(found: Mapping[str, Found], base: str) -> list[Verdict]:
    """A verdict on every claim by the base reading, and where else it holds."""
    views = {name: View(f) for name, f in found.items()}
    return [claim.verdict(views, base, shown=SHOWN, source=PAPER) for claim in CLAIMS]
