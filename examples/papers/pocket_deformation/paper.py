"""The paper on deformed cage pockets: its readings, its map, and what was found."""

from __future__ import annotations

import numpy as np
from claims import BENT1, BENT2, CAGES, CLAIMS, DROP, LONGER, SHORTER, SOUND, WITHIN
from figures import BETTER, FLEXIBLE, MAP, MPA, PRINTED_MODEL, ROOT, UM, draw, tables
from paper_weighed import Asked, rechecked
from repeat import Computed, Paper, Words

from flexcage.core.digits import percent_text
from flexcage.study import StudyResults
from flexcage.study.sensitivity import share
from flexcage.study.verdicts import HOLDS

OF_STRESS = ("000-1", "000-8", "000-8b")  # claims that the map's rigid cages say nothing of
DECIDED_BY = {c.key: FLEXIBLE if c.key in OF_STRESS else MAP for c in CLAIMS}
#: Numbers that claims are judged by, whose unknowns are weighed: chosen after the map's runs.
WEIGHED = (
    Asked("whirl radius [um], dq 0.2", "whirl", BENT2, UM),
    Asked("cage speed fluctuation [%], dq 0.2", "ripple", BENT2, 100.0),
    Asked("slip of j-1 [%], dq 0.2", "slip_before", BENT2, 100.0),
    Asked("slip of j [%], dp -0.3", "slip_at", SHORTER, 100.0),
    Asked("kurtosis of acceleration, dp -0.3", "spikes", SHORTER),
)
HELD = 1.05  # slip from which a roller turns with the cage
CLEARANCES = {"Cq - Dw": (0.05e-3, 0.25e-3), "Cp - Lw": (0.15e-3, 0.35e-3)}  # m, as in map.toml


def row(computed: Computed, column: str, output: str, factor: float, *cages: str) -> str:
    """An output of several cages by one reading, in their order."""
    return ", ".join(computed.readings[column].said(output, c, factor) for c in cages)


def over(computed: Computed, output: str, factor: float) -> str:
    """An output of all cages over the map."""
    joined = computed.maps[MAP]
    return "; ".join(f"{cage} {joined.middle(output, cage, factor)}" for cage in CAGES)


def clearance(computed: Computed, name: str) -> np.ndarray:
    """A clearance [m] at every point of the map."""
    joined, (low, high) = computed.maps[MAP], CLEARANCES[name]
    return low + (high - low) * joined.shares[:, joined.names.index(name)]


def when(computed: Computed, key: str, part: str, there: np.ndarray) -> str:
    """In how many of some points of the map (n,) a part of a claim holds, or all of it ("")."""
    claim = next(c for c in computed.paper.claims if c.key == key)
    outcomes = computed.maps[MAP].judge((claim.parts[part] if part else claim).holds)
    found = np.array([o is True for o in outcomes])
    known = np.array([o is not None for o in outcomes])
    return f"{int((found & there & known).sum())} of {int((there & known).sum())}"


def at_filter(computed: Computed, output: str) -> str:
    """Share of the map in which all deformations make spikes, at another filter."""
    claim = next(c for c in computed.paper.claims if c.key == "000-4")
    outcomes = computed.maps[MAP].judge(
        lambda at: claim.holds(lambda name, c: at(output if name == "spikes" else name, c))
    )
    found = share(outcomes)
    return percent_text(found.value) if found.decided else "-"


def pinched(computed: Computed, deformed: str) -> list[tuple[float, float]]:
    """Clearances [mm] and stress [Pa] at the corners of a pocket that pinches its roller, falling
    stress by stress; empty if that was not computed."""
    folder = computed.out / "pinch"
    if not folder.is_dir():
        return []
    done = [r for r in StudyResults(folder).rows if r.state == "done"]
    named = [(r.planned.point.labels["pocket"].split(", "), r.figures["corner"]) for r in done]
    return sorted((float(where), float(f.value)) for (what, where), f in named if what == deformed)


def printed_within(computed: Computed) -> tuple[float, float]:
    """Clearances Cp - Lw [mm] between which the root stress is the printed one within a factor
    of two; NaN where the computed ones do not enclose it."""
    found = pinched(computed, SHORTER)
    if len(found) < 2:
        return np.nan, np.nan
    at, corner = np.array(found).T
    low, high = (
        float(np.interp(-ROOT * 1e6 * f, -corner, at, np.nan, np.nan)) for f in (WITHIN, 1 / WITHIN)
    )
    return low, high


def of_pinch(computed: Computed) -> str:
    """Stress over clearance, in words that end a sentence; empty if that was not computed."""
    parts = [
        f"{what}: {', '.join(f'{v * MPA:,.0f} MPa at {at:g} mm' for at, v in found)}"
        for what, found in (("a shorter pocket", pinched(computed, SHORTER)),
                            ("a crossbeam moved by 0.2 mm", pinched(computed, BENT2)))
        if found
    ]  # fmt: skip
    return "".join(f"; {part}" for part in parts)


def light(computed: Computed) -> str:
    """Flexible points whose pinched roller is held in part only, in words."""
    said = []
    for name, taken, cage, roller in (
        ("Cq - Dw", 0.2e-3, BENT2, "before"), ("Cp - Lw", 0.3e-3, SHORTER, "at")
    ):  # fmt: skip
        joined, over_by = computed.maps[FLEXIBLE], taken - clearance(computed, name)
        slip, swing = (joined.means(f"{what}_{roller}", cage) for what in ("slip", "swing"))
        said += [
            f"{over_by[k] * UM:.1f} um beyond {name} the roller slips by {percent_text(slip[k])}, "
            f"and its speed fluctuates by {percent_text(swing[k])}"
            for k in np.flatnonzero((over_by > 0.0) & (slip > DROP) & (slip < HELD))
        ]
    return "; ".join(said) or "none is seen"


def reasons(computed: Computed) -> dict[str, str]:
    """One line for every claim."""
    c, (low, high) = computed, printed_within(computed)
    least, most = (1e3 * v for v in CLEARANCES["Cp - Lw"])
    held, shorter = clearance(c, "Cq - Dw") < 0.2e-3, clearance(c, "Cp - Lw") < 0.3e-3
    between = held & (clearance(c, "Cq - Dw") > 0.1e-3)
    return {
        "000-1": f"{row(c, BETTER, 'corner', MPA, *CAGES[:3])} MPa where the roller just "
        f"fits at 0.2 mm; rises in {c.part(FLEXIBLE, '000-1', 'rises')} of flexible points",
        "000-2": f"rises and falls in {c.part(MAP, '000-2', 'amplitude')}; "
        f"{c.by(MAP, '000-2')}",
        "000-3": f"radius grows in {c.part(MAP, '000-3', 'radius')}, scatter in "
        f"{c.part(MAP, '000-3', 'more dispersed')}; {c.by(MAP, '000-3')}",
        "000-3b": f"radius turns in {c.part(MAP, '000-3b', 'radius')}; {c.by(MAP, '000-3b')}",
        "000-4": f"dq 0.2 in {c.part(MAP, '000-4', BENT2)}, dp -0.3 in "
        f"{c.part(MAP, '000-4', SHORTER)}, dq 0.1 in {c.part(MAP, '000-4', BENT1)}, dp +0.3 in "
        f"{c.part(MAP, '000-4', LONGER)}",
        "000-5": f"as before at 0.1 in {c.part(MAP, '000-5', 'unchanged at 0.1')}, larger at 0.2 "
        f"in {c.part(MAP, '000-5', 'larger at 0.2')}, faster in "
        f"{c.part(MAP, '000-5', 'faster at 0.2')}",
        "000-6": f"drops where 0.2 mm exceeds the clearance "
        f"({when(c, '000-6', 'j-1 drops at 0.2', held)} points, else "
        f"{when(c, '000-6', 'j-1 drops at 0.2', ~held)}), but fluctuates in "
        f"{c.part(MAP, '000-6', 'j-1 fluctuates at 0.2')}: it is held",
        "000-7": f"holds where Cq - Dw is between 0.1 and 0.2 mm "
        f"({when(c, '000-7', '', between)} points, else {when(c, '000-7', '', ~between)})",
        "000-8": f"{row(c, BETTER, 'corner', MPA, SOUND, LONGER, SHORTER)} MPa; the same in "
        f"{c.part(FLEXIBLE, '000-8', 'unchanged at +0.3')}, more in "
        f"{c.part(FLEXIBLE, '000-8', 'more at -0.3')} of flexible points",
        "000-8b": f"{row(c, BETTER, 'corner', MPA, SHORTER)} MPa at 0.25 mm"
        + (f"; within a factor of two from {low:.2f} to {high:.2f} mm, "
           f"{percent_text((high - low) / (most - least))} of the range" if low < high else ""),
        "000-9": f"unchanged in {c.part(MAP, '000-9', 'unchanged at +0.3')}, one line in "
        f"{c.part(MAP, '000-9', 'one line at -0.3')}",
        "000-10": f"larger at +0.3 in {c.part(MAP, '000-10', 'larger at +0.3')}, smaller at -0.3 "
        f"in {c.part(MAP, '000-10', 'smaller at -0.3')}",
        "000-11": f"less at +0.3 in {c.part(MAP, '000-11', 'less at +0.3')}, more at -0.3 in "
        f"{c.part(MAP, '000-11', 'more at -0.3')}",
        "000-12": f"drops where -0.3 mm exceeds the clearance "
        f"({when(c, '000-12', 'drops at -0.3', shorter)} points), else in "
        f"{when(c, '000-12', 'drops at -0.3', ~shorter)}",
        "000-13": f"j-1 changes in {c.part(MAP, '000-13', 'shorter: j-1 changes')}, j+1 in "
        f"{c.part(MAP, '000-13', 'shorter: j+1 changes')}; {c.by(MAP, '000-13')}",
    }  # fmt: skip


def lost(computed: Computed) -> str:
    """How many cages without a land were lost, in words; empty if that was not computed."""
    folder = computed.out / "lost"
    if not folder.is_dir():
        return ""
    rows = StudyResults(folder).rows
    done = [r for r in rows if r.state == "done"]
    gone, broken = sum(bool(r.figures["lost"].value) for r in done), len(rows) - len(done)
    more = f", {broken} more ended as the solver gave up" if broken else ""
    return f"{gone} of {len(done)} runs of 60 ms lost it (more than 0.5 mm off the axis){more}"


def words(computed: Computed) -> Words:
    """Summary, reasons, what decides, and readings, with the numbers of what was computed."""
    c = computed
    points = c.found[MAP]["000-12"].share.decided
    held = [line.key for line in c.lines if line.cells[BETTER].outcome == HOLDS]
    starts = {column: reading.starts for column, reading in c.readings.items()}
    summary = f"""The paper deforms one pocket of an N1013's brass cage at 6000 rpm and 1000 N, in
        ADAMS: its crossbeam by 0.1 and 0.2 mm, its side beam by +0.3 and -0.3 mm. It says that
        stress and slip rise where the roller is squeezed, and that orbits, vibration and speeds
        change with it. Of its {len(c.lines)} claims (one in two readings, one with a number)
        {c.tally}. At the clearances of the better model {", ".join(held)}
        hold. One thing decides most: does the displacement exceed the pocket's clearance, which
        the paper does not print? How sure: {points} points of {len(c.maps[MAP].names) - 1}
        unknowns, one start each of five rigid cages; {len(c.paper.rechecks["map.toml"])} of them
        again with flexible ones;
        {" and ".join(f"{n} starts ({column})" for column, n in starts.items() if n)} of flexible
        cages. Records are 0.12 s long, and judged over their last 60 ms, two turns of the
        cage."""
    return Words(summary, reasons(c), decides(c), readings(c))


def decides(computed: Computed) -> list[str]:
    """What decides, in paragraphs."""
    c, joined = computed, computed.maps[MAP]
    held, shorter = clearance(c, "Cq - Dw") < 0.2e-3, clearance(c, "Cp - Lw") < 0.3e-3
    gone = lost(c)
    return [
        "**Clearance left or not.** Where 0.2 mm exceeds Cq - Dw, roller j-1 drops in "
        f"{when(c, '000-6', 'j-1 drops at 0.2', held)} points, elsewhere in "
        f"{when(c, '000-6', 'j-1 drops at 0.2', ~held)}; where 0.3 mm exceeds Cp - Lw, roller j "
        f"drops in {when(c, '000-12', 'drops at -0.3', shorter)}, elsewhere in "
        f"{when(c, '000-12', 'drops at -0.3', ~shorter)}. Friction holds a pinched roller in its "
        "pocket: it turns with the cage, backwards in the sense of rolling, which is a slip of "
        f"{c.readings[BETTER].said('slip_at', SHORTER, 100.0)} %: a loss of all speed, and a "
        "steady one, where the paper's figures have a drop that fluctuates. Table 2 (000-7) "
        "follows: j-1 slips a little less at 0.1 mm and sharply more at 0.2 mm where Cq - Dw lies "
        "between both, as the paper's own text has it (a roller that runs at 0.1 mm and is "
        "squeezed at 0.2).",
        f"**A light pinch** does what the paper says of 000-6, at flexible points: {light(c)}.",
        *([f"**No land, no cage.** Section 2.2 lists no contact between cage and rings. Rollers "
           f"alone do not hold the cage: {gone}. The paper's cage stayed, so something that it "
           "does not list guides it; the printed model is taken on the inner ring's ribs."]
          if gone else []),
        f"**Stress (000-1, 000-8).** Corners of the deformed pockets, better model: "
        f"{row(c, BETTER, 'corner', MPA, *CAGES)} MPa ({', '.join(CAGES)}). A pinch needs no "
        "motion: its stress is there from assembly on and stands still, as the paper says "
        f'("stabilizes" at {ROOT} MPa). The clearance sets it{of_pinch(c)}. Cast brass yields at '
        "160 MPa. So 000-1 needs a Cq - Dw below 0.2 mm, and then stress jumps.",
        "**Whirl (000-2, 000-3, 000-10).** Whirl radii over the map: "
        f"{over(computed, 'whirl', UM)} um. A moved "
        "crossbeam meets its roller before the others meet theirs: in the better model roller j-1 "
        f"pushes with {row(c, BETTER, 'push_before', 1.0, *CAGES[:3])} N on average at 0, 0.1 "
        "and 0.2 mm. A cage with a held roller swings wider, not less: its strongest line lies at "
        f"{joined.middle('order', SHORTER, 1.0)} times its own frequency.",
        f"**Vibration (000-4).** All four deformations make spikes at 10 kHz in "
        f"{percent_text(c.found[MAP]['000-4'].share.value)} of the map, at 5 kHz in "
        f"{at_filter(c, 'spikes_5k')}, at 20 kHz in {at_filter(c, 'spikes_20k')}.",
        f"**Fluctuation (000-5, 000-11).** Mean frequencies of the cage's speed: "
        f"{over(computed, 'pitch', 1.0)} Hz. A held roller makes the fluctuation larger and "
        "slower, not faster; a moved crossbeam that leaves clearance makes it smaller: "
        f"better model {row(c, BETTER, 'ripple', 100.0, *CAGES[:3])} %.",
    ]  # fmt: skip


def readings(computed: Computed) -> list[str]:
    """How the paper was read, and what is assumed."""
    c = computed
    return [
        "**Better model.** Flexible cage (coarse mesh), Hertz contact with restitution 0.9 at "
        "races and 0.7 in pockets, traction of 0.05 at 0.3 m/s, ribs 0.25 mm below the cage, a "
        "housing of 200 N/um; Cq - Dw = 0.20 mm and Cp - Lw = 0.25 mm.",
        "**As printed.** IMPACT by ADAMS' defaults (10 N s/mm, full from 0.1 mm on) over Hertz "
        "stiffness, friction 0.3 and 0.1 at 100 and 1000 mm/s, no oil, the outer ring in contact "
        "with its socket. ADAMS' default exponent of 2.2 is not the paper's Hertz contact, and not "
        "used; modes are damped as brass is, since ADAMS' damping of modes (1, 10, 100 %) makes a "
        "run five times as long. Without oil the cage still slides along the ribs when its records "
        "end: its whirl and speed are those of a start.",
        "**Single starts.** A point of the map has one start, so \"unchanged\" within 10 % is "
        "asked of two chaotic records; what starts alone do is the dummy.",
        "**Changed after results were seen.** Earlier runs had records of 60 ms (starts) and 0.1 "
        "s, 16 points, 5 of them flexible, and a rigid cage as printed; the claims' rules and the "
        "ranges stayed as they were.",
        "**Words into numbers.** Unchanged: within 10 %, a roller's speed within 1 %. Clearly "
        "more: by 25 %. A drop of speed: by 5 %. Sinusoidal: half of the variance in one line. "
        f"{ROOT} MPa: within a factor of {WITHIN:g}. These were written before the runs.",
        '**Two readings.** "Whirl radius gradually expands ... once the deformation exceeds '
        '0.2 mm, decreases" is 000-3 where taken literally, 000-3b where it means 0 < 0.1 > 0.2.',
        "**Pockets.** Crossbeam 5, between j-1 = 4 and j = 5, is displaced as a whole, as equation "
        "1 says; side beams bend.",
        "**A rigid cage in the map** has no stress, so claims on stress are decided by points of "
        "the map with a flexible one: changed from the better model's starts after results were "
        "seen, which opened 000-8 and 000-8b. A rigid cage pinches harder than a flexible one.",
        "**Indices** are of a screening by Morris' design, 4 trajectories of 14 points with 22 "
        "rollers, each run with another start; its numbers were chosen after the map's runs.",
        *rechecked(c, "whirl"),
    ]  # fmt: skip


PAPER = Paper(
    title="An N1013 with a deformed cage pocket",
    source="Dynamic Characteristics of Cylindrical Roller Bearing with Cage Pocket Deformation, "
    "Lubricants 2025, 13(11), 495",
    claims=CLAIMS,
    readings="readings.toml",
    columns={"better": BETTER},
    alone={PRINTED_MODEL: ("readings_printed.toml", "printed")},
    studies=("pinch.toml", "lost.toml"),
    maps={MAP: ("map.toml",)},
    decided_by=DECIDED_BY,
    rechecks={"map.toml": tuple(range(9))},
    recheck_conditions=CAGES,
    recheck_column=FLEXIBLE,
    weighed={"screen.toml": WEIGHED},
    stress=("case.toml", {
        "defects": [{"type": "side_beam", "pocket": 5, "displacement": "-0.3 mm"}],
        "solver.duration": "40 ms",
    }),
    draw=draw,
    tables=tables,
    words=words,
    files=("printed.toml",),
)  # fmt: skip
