"""What decides, in words and numbers, for the page on riveted cages."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from claims import DESIGN_AXES, ENDS_OF_RADII, FORCE, ROOT, SHEETS
from figures import CAGE, mean
from paper_page import number
from repeat import Computed
from scipy.stats import spearmanr

from flexcage.core.digits import percent_text
from flexcage.study import StudyResults
from flexcage.study.surface import response_surface

FOLDER = Path(__file__).parent
UNITS = {"clamp": "N", "root_radius": "m", "friction": "(no unit)"}
CAGE_TURNS = 3380.0 / 60.0  # a second, at 9000 rpm by equation 10


def said(reading, output: str, condition: str, factor: float = 1.0) -> str:
    """Mean of the starts ± half of its interval."""
    return number(*mean(reading, output, condition), factor=factor) if reading else "-"


def over(reading, output: str, conditions, factor: float = 1.0) -> str:
    """Means of the starts over conditions, without their intervals."""
    if reading is None:
        return "-"
    found = (mean(reading, output, c)[0] * factor for c in conditions)
    return ", ".join(f"{value:.3g}" if np.isfinite(value) else "-" for value in found)


def surface(computed: Computed):
    """The response surface through the 49 points of Table 3."""
    return response_surface(StudyResults(computed.out / "design"), FORCE, axes=DESIGN_AXES)


def lags(computed: Computed) -> tuple[str, float, float, str]:
    """Median lag by sliding [%] in words by the play of pockets, of both cages and balls; the rank
    correlation of the original cage's with the mean force on a ball, its p, and the range of the
    force [N]."""
    joined, said = computed.maps[CAGE], []
    for part, ball in zip(joined.parts, (6.747, 6.47)):  # mm, in the order of the map's files
        for cage, radius in (("modified", 3.46), ("original", 3.6)):
            lag = 100.0 * np.nanmedian(part.means("traction", f"{cage} 9000"))
            said.append((2.0 * radius - ball, f"{lag:.2g} % at {2.0 * radius - ball:.2f} mm"))
    load, lag = (joined.means(o, "original 9000") for o in ("ball_load", "traction"))
    found = spearmanr(load, lag, nan_policy="omit")
    forces = f"{np.nanmin(load):.0f} to {np.nanmax(load):.0f}"
    return ", ".join(text for _, text in sorted(said)), float(found[0]), float(found[1]), forces


def sign(computed: Computed) -> tuple[str, str, str]:
    """Shares of the map's points whose slip at 9000 rpm is positive with the modified cage, with
    the original, and within 15 % of both measured ones."""
    joined = computed.maps[CAGE]
    one, other = (joined.means("slip", f"{cage} 9000") for cage in ("modified", "original"))
    there = np.isfinite(one) & np.isfinite(other)
    one, other = one[there], other[there]
    near = (abs(one - 0.0113) < 0.0017) & (abs(other - 0.0184) < 0.0028)
    return tuple(percent_text(share.mean()) for share in (one > 0, other > 0, near))


def two_kinds() -> str:
    """What the largest blows of a turn are over the radius, by blows.csv."""
    found = pd.read_csv(FOLDER / "blows.csv").set_index("radius [mm]")
    small, large = found.loc[:3.445], found.loc[3.445:]
    ends = found.iloc[[0, -1]]

    def both(name: str) -> str:
        return " to ".join(f"{value:.2g}" for value in ends[name])

    def share(part: pd.DataFrame) -> str:
        return percent_text(part["largest near the moment's axis"].mean())

    loads = "race force on the ball then [N]"
    near = percent_text(found["largest near the moment's axis"].iloc[-1])
    return (
        f"Largest blows of a turn are of two kinds ({int(found['turns'].sum())} turns, rigid cage, "
        f"looked at after the bowl was seen). At 3.43 and 3.44 mm {share(small)} are within 45 "
        f"degrees of the moment's axis, on balls that carry {small[loads].mean():.2g} N; from "
        f"3.45 mm on {share(large)} ({near} at 3.49 mm), on balls of {large[loads].mean():.3g} N. "
        f"The first kind fades with play: blows a turn go from "
        f"{both('blows above 5 N in a turn')}, a pocket's mean force from "
        f"{both('mean force of a pocket [N]')} N. The second grows: balls move relative to the "
        f"cage by {both('speed of balls relative to the cage, rms [m/s]')} m/s."
    )


def region(laid) -> str:
    """Optima of both models in words."""
    found = []
    for name, optimum in laid.optima.items():
        low, high = 0.5 * optimum.box[:, 0]
        found.append(f"{name} {0.5 * optimum.place[0]:.3f} mm ({low:.3f} to {high:.3f})")
    return "; ".join(found) + "; the width may be anywhere from 4.4 to 8 mm"


def elastic(soft) -> list[str]:
    """What a flexible cage makes of the bowl, and of rivets over the sheet's thickness."""
    if soft is None or not soft.look:
        return []
    forces = ", ".join(said(soft, FORCE, c) for c in ENDS_OF_RADII)
    found = pd.read_csv(FOLDER / "sheets.csv")
    shear, bending = (
        ", ".join(f"{value:.3g}" for value in found[name])
        for name in ("shear [N]", "bending [mN m]")
    )
    return [
        "**An elastic cage shows no bowl beyond chance.** Its largest forces are "
        f"{forces} N at 3.43, 3.46 and 3.49 mm: it gives way to blows, and they are less than half "
        "of a rigid cage's. Its "
        f"rivets' nominal stress is {over(soft, 'rivet', ENDS_OF_RADII, 1e-6)} MPa, the range at "
        f"their roots {', '.join(said(soft, ROOT, c, 1e-6) for c in ENDS_OF_RADII)} MPa (001-1b).",
        "**A thicker sheet (001-4b).** Its halves are farther apart, so that the same forces bend "
        f"a shank that bears all alone more: nominal {over(soft, 'rivet', SHEETS, 1e-6)} MPa at "
        f"0.7, 0.8 and 1 mm (in one start each shear {shear} N, bending {bending} mN m). Clamped "
        "heads carry it by friction; at their roots the range falls, as the paper has it: "
        f"{', '.join(said(soft, ROOT, c, 1e-6) for c in SHEETS)} MPa.",
    ]


def weak(computed: Computed, soft) -> list[str]:
    """Which cage is stressed more, and where."""
    if soft is None or not soft.look:
        return []
    root = "stress_root_pass_peak"
    return [
        "**Which cage fails first.** Rivets, nominal: "
        f"{said(soft, 'rivet', 'original 9000', 1e-6)} MPa in the original cage, "
        f"{said(soft, 'rivet', 'modified 9000', 1e-6)} in the modified one; range at the roots "
        f"{said(soft, ROOT, 'original 9000', 1e-6)} and "
        f"{said(soft, ROOT, 'modified 9000', 1e-6)} MPa. Sheet: "
        f"{said(soft, root, 'original 9000', 1e-6)} and "
        f"{said(soft, root, 'modified 9000', 1e-6)} MPa at waists and rims: the modified cage's "
        "holes leave necks of 0.27 mm in a strip of 3.8 mm, one coarse element across. By this "
        "reading of the width its sheet is the weaker; in the paper's test the original failed."
    ]


def fatigue() -> str:
    """What the printed force does to a rivet in time, by fits.csv, lives.csv and assumed.csv."""
    fits, lives, ends = (pd.read_csv(FOLDER / f"{n}.csv") for n in ("fits", "lives", "assumed"))
    cycles = lives[["cycles, SWT", "cycles, Morrow"]].to_numpy()
    root, local = fits["range at the root [MPa]"], lives["local range [MPa]"]
    clamps = ends[ends["changed"] == "clamp"]
    by_clamp = " and ".join(
        f"{_million(least)} with {clamp:g} N"
        for clamp, least in zip(clamps["value [SI]"], clamps["cycles, least"])
    )
    least = ends["cycles, least"].min()
    return (
        "**Fatigue by the printed force.** Scaled to 25 N a ball, a nominal range of "
        f"{fits['nominal range [MPa]'].max():.3g} MPa becomes {root.min():.2g} to "
        f"{root.max():.2g} MPa at the root over all fits. Both readings of the paper's notch "
        "factor K_f make it "
        f"{local.min():.3g} to {local.max():.3g} MPa: elastic, and {_million(cycles.min())} cycles "
        f"or more by SWT and Morrow with a clamp of 100 N, {by_clamp} (whose mean stress counts). "
        f"With one cycle a turn of the cage {_million(least)} are "
        f"{least / CAGE_TURNS / 3600.0:.0f} hours: what no one knows of the joint decides, and "
        "fatigue is neither shown nor excluded. CalculiX on the same mesh, with contact and "
        "friction, has the same ranges at the roots within 2.3 %."
    )


def _million(cycles: float) -> str:
    return f"{cycles / 1e6:.2g} million"


def assumed() -> str:
    """How the range at the roots depends on what is assumed of the joint, by assumed.csv."""
    found = pd.read_csv(FOLDER / "assumed.csv")
    name = "range at the root [MPa]"
    middle, ends = found[name].iloc[0], found.iloc[1:]
    worst, others = ends.loc[ends[name].idxmax()], ends.drop(ends[name].idxmax())
    return (
        f"The range at the root is {middle:.3g} MPa by a coarser mesh, {worst[name]:.3g} with a "
        f"{worst['changed'].replace('_', ' ')} of {worst['value [SI]']:g} "
        f"{UNITS[worst['changed']]}, and {others[name].min():.3g} to "
        f"{others[name].max():.3g} with the other ends of the ranges (clamp 20 to 200 N, friction "
        "0.1 to 0.3, roots 0.05 to 0.2 mm)"
    )
