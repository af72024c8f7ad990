"""The paper on deformed cage pockets: what is run, and what its page says."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from claims import BENT1, BENT2, CLAIMS, LONGER, SCATTER, SHORTER, SOUND
from figures import MPA, UM, draw
from judging.judge import REPRODUCED, UNDER
from judging.page import Figure, Table
from mesh_error import mesh_errors
from repeat import Computed, Draft, Paper

MAP = "map"


def mechanisms(computed: Computed) -> dict[str, str]:
    """Why findings are contradicted, each only if the settings show it."""
    found = {}
    shown = partial(computed.share, MAP)
    held = shown(lambda at: at("slip_at", SHORTER) > 0.5)
    pushed = shown(lambda at: at("push_at", SHORTER) > 2.0 * at("push_sound", SHORTER))
    if held > 0.8 and pushed > 0.8:
        why = "a pinched roller turns with the cage and carries it through every unevenness"
        found |= {"000-10, smaller at -0.3": why, "000-11, faster at -0.3": why}
    before = shown(lambda at: at("push_before", BENT2) > 2.0 * at("push_sound", BENT2))
    if before > 0.8:
        found["000-5, faster at 0.2"] = "roller j-1 alone drives the cage, once a turn"
    loose = shown(lambda at: abs(at("push_at", LONGER) / at("push_at", SOUND) - 1.0) < 0.5)
    if loose > 0.8:
        why = "a side beam that moves away is touched no more than the sound one"
        found |= {f"000-10, {part}": why for part in ("wider at +0.3", "more chaotic at +0.3")}
        found |= {"000-11, steadier at +0.3": why, "000-4b, at +0.3": why}
    return found


KNOWN = Table(
    "Printed, inferred, swept",
    ("quantity", "value", "by"),
    [
        ("bearing, speed, load", "N1013, 6000 rpm, 1000 N", "printed"),
        ("crossbeam's displacement dq", "up to 0.2 mm; and 0.3 mm for what exceeds it", "printed"),
        ("side beam's displacement dp", "0.3 mm outwards and inwards", "printed"),
        ("rollers", "22, as long as thick: 8 mm", "inferred from the ratings"),
        ("Cq - Dw", "0.1 to 0.2 mm", "bounded by the text, swept"),
        ("Cp - Lw", "below 0.3 mm", "bounded by the text, swept"),
        ("guidance", "inner ribs or outer ring", "swept: the text lists none"),
        ("contact stiffness", "Hertz, a tenth of it, or IMPACT", "swept"),
        ("damping, friction, traction", "wide ranges", "swept"),
        ("brass", "105 GPa, 8500 kg/m3", "inferred: HPb59-1's class"),
    ],
)
MODEL = (
    "A point of the flexible cage lies at `r = R + A (s + Phi q)`: a frame, and modes of a finite "
    "element\ncage that the paper has from ADAMS. Rollers touch pocket walls with "
    "`F = K d^n + c(d) d'` (the paper's\nequation 9 has no exponent; Hertz is named). Slip is "
    "`(n_theory - n)/n_theory`.",
)
ASKS = (
    "Which clearances Cq and Cp, how many rollers, and what guides the cage?",
    "Which stiffness, exponent and damping have the contacts? (Is it IMPACT by its defaults?)",
    "Tables 2 and 3 have lost their bodies in the text that we have: which slips are printed?",
    "Is 320.51 MPa a nodal value, and on which fillet? Cast brass yields at 160 MPa.",
    "Does negative deviation lower stress (conclusion 1) or raise it (2 and 3)?",
    '"Once the deformation exceeds 0.2 mm": was 0.3 mm computed?',
)


def pinched(computed: Computed) -> str:
    """What the decisive clearance does, in one sentence."""
    found = computed.of("000-6", "j-1 drops at 0.2").judged
    words = {REPRODUCED: "drops at once", UNDER: "drops where the pinch is hard"}
    return words.get(found.verdict, "does not always drop")


def summary(computed: Computed) -> str:
    """Three sentences of physics."""
    held, all_of = computed.counts[REPRODUCED] + computed.counts[UNDER], len(computed.found)
    return (
        "A displaced beam that pinches a roller stops it from rolling: at 0.2 mm of crossbeam "
        f"roller j-1 {pinched(computed)}, and a side beam moved by -0.3 mm stresses its corners "
        f"to {computed.middle(MAP, 'corner', SHORTER, MPA)} MPa (median of the settings), which "
        "stands still as the paper says. A displacement that leaves clearance changes little. "
        f"{held} of {all_of} findings are reproduced, {computed.counts[UNDER]} of them under a "
        f"condition that is named; contradicted: {computed.counts['contradicted']}."
    )


def paper_figures(computed: Computed, pictures: dict[str, str]) -> list[Figure]:
    """The paper's figures in its order."""
    m = partial(computed.middle, MAP)
    return [
        Figure("Figures 8 and 9: stress and radial displacement, crossbeam",
               "stress rises step by step; vibration is pronounced at 0.2 mm, as roller j-1 is "
               "squeezed.", pictures["8_9"], ("000-0", "000-1", "000-2"),
               f"Medians: {m('corner', SOUND, MPA)}, {m('corner', BENT1, MPA)} and "
               f"{m('corner', BENT2, MPA)} MPa, swings of {m('reach', SOUND, UM)}, "
               f"{m('reach', BENT1, UM)} and {m('reach', BENT2, UM)} um. The pinch stresses the "
               "corners from assembly on."),
        Figure("Figure 10: orbits, crossbeam",
               "the orbit disperses and widens, and beyond 0.2 mm narrows.", pictures["10"],
               ("000-3", "000-3b"), "The dashed circle is the land's clearance."),
        Figure("Figures 11 and 12: acceleration and cage speed, crossbeam",
               "irregular spikes appear; speed: 0.1 mm is negligible, 0.2 mm fluctuates more and "
               "faster.", pictures["11_12"], ("000-4", "000-5"),
               "Kurtosis of the acceleration, low-passed at 10 kHz, is judged. Mean speed hardly "
               "moves; the fluctuation is a share of it."),
        Figure("Figure 13, Table 2: roller speeds, crossbeam",
               "j-1 keeps its speed at 0.1 mm, then drops and fluctuates; its neighbours keep "
               "theirs.", pictures["13"], ("000-6", "000-7"),
               "Friction of the pinch holds the roller against the race's traction: it turns with "
               "the cage, backwards."),
        Figure("Figures 14 and 15: stress and radial displacement, side beam",
               "little changes at +0.3 mm; at -0.3 mm root stress is 320.51 MPa, and the "
               "displacement a sine.", pictures["14_15"], ("000-8", "000-8b", "000-9"),
               f"Median at -0.3 mm: {m('corner', SHORTER, MPA)} MPa, coarse mesh, whose error is "
               "in the appendix. The held roller carries the cage round once a turn: one line."),
        Figure("Figure 16: orbits, side beam",
               "wider and chaotic at +0.3 mm; a regular, smaller whirl at -0.3 mm.",
               pictures["16"], ("000-10",), f"Whirl radii, medians: {m('whirl', SOUND, UM)} um "
               f"sound, {m('whirl', SHORTER, UM)} um at -0.3 mm."),
        Figure("Figures 17 and 18: acceleration and cage speed, side beam", "spikes appear; speed "
               "is steadier at +0.3 mm, less steady and faster at -0.3 mm.",
               pictures["17_18"], ("000-4b", "000-11"), "As Figures 11 and 12."),
        Figure("Figure 19, Table 3: roller speeds, side beam",
               "j keeps its speed at +0.3 mm, and drops at -0.3 mm.", pictures["19"],
               ("000-12", "000-13"), "As Figure 13."),
    ]  # fmt: skip


def draft(computed: Computed, folder: Path) -> Draft:
    """The page's own parts."""
    pictures = draw(computed, folder)
    return Draft(
        summary=summary(computed),
        hero=(pictures["pinch"], "Roller j in its pocket, whose side beam is moved by -0.3 mm"),
        model=MODEL, known=KNOWN, figures=paper_figures(computed, pictures), asks=ASKS,
        history=(
            "Earlier pages judged over ranges that the text excludes, by eight starts that could "
            "decide nothing, and claims of several parts as one. The rules here were written "
            "before any run of map.toml of this version.",
            "After 32 settings of another paper were seen: where the cage's orbit drifts, numbers "
            "of the orbit are left out, and no longer stresses and speeds of rollers.",
        ),
        appendix=tuple(filter(None, [mesh_errors(computed)])),
        files=("printed.toml",),
    )  # fmt: skip


PAPER = Paper(
    title="An N1013 with a deformed cage pocket",
    source="Dynamic Characteristics of Cylindrical Roller Bearing with Cage Pocket Deformation, "
    "Lubricants 2025, 13(11), 495",
    claims=CLAIMS,
    samples={MAP: ("map.toml",)},
    studies=("mesh.toml",),
    readings={"hertz": ("readings.toml", "hertz"), "adams": ("readings.toml", "adams")},
    drifting="drifts",
    spoilt=(
        "reach",
        "reach_range",
        "place",
        "whirl",
        "scatter",
        "line",
        "order",
        "ripple",
        "pitch",
    ),
    scatter=SCATTER,
    mechanisms=mechanisms,
    draft=draft,
)
