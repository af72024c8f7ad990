"""The paper on deformed cage pockets: its readings, its map, and what was found."""

from __future__ import annotations

import numpy as np
from claims import BENT1, BENT2, CAGES, CLAIMS, LONGER, SHORTER, SOUND, WITHIN
from figures import BETTER, MAP, MPA, PRINTED_MODEL, ROOT, UM, draw, tables
from repeat import Computed, Paper, Words

from flexcage.core.digits import percent_text
from flexcage.study import StudyResults
from flexcage.study.claims import mean_of
from flexcage.study.sensitivity import share

OF_STRESS = ("000-1", "000-8", "000-8b")  # claims that the map's rigid cages say nothing of
DECIDED_BY = {c.key: BETTER if c.key in OF_STRESS else MAP for c in CLAIMS}
CLEARANCES = {"Cq - Dw": (0.05e-3, 0.25e-3), "Cp - Lw": (0.15e-3, 0.35e-3)}  # m, as in map.toml


def row(computed: Computed, column: str, output: str, factor: float, *cages: str) -> str:
    """An output of several cages by one reading, in their order."""
    return ", ".join(computed.readings[column].said(output, c, factor) for c in cages)


def clearance(computed: Computed, name: str) -> np.ndarray:
    """A clearance [m] at every point of the map."""
    joined, (low, high) = computed.maps[MAP], CLEARANCES[name]
    return low + (high - low) * joined.shares[:, joined.names.index(name)]


def when(computed: Computed, key: str, part: str, there: np.ndarray) -> str:
    """In how many of some points of the map (n,) a part of a claim holds."""
    claim = next(c for c in computed.paper.claims if c.key == key)
    found = np.array([o is True for o in computed.maps[MAP].judge(claim.parts[part].holds)])
    known = np.array([o is not None for o in computed.maps[MAP].judge(claim.parts[part].holds)])
    return f"{int((found & there & known).sum())} of {int((there & known).sum())}"


def at_filter(computed: Computed, output: str) -> str:
    """Share of the map in which all deformations make spikes, at another filter."""
    claim = next(c for c in computed.paper.claims if c.key == "000-4")
    outcomes = computed.maps[MAP].judge(
        lambda at: claim.holds(lambda name, c: at(output if name == "spikes" else name, c))
    )
    found = share(outcomes)
    return percent_text(found.value) if found.decided else "-"


def contrary(computed: Computed, column: str, key: str) -> str:
    """Parts of a claim that the means of a reading speak against."""
    claim = next(c for c in computed.paper.claims if c.key == key)
    reading = computed.readings.get(column)
    if reading is None or not reading.look:
        return "not computed"
    return ", ".join(claim.contrary(mean_of(reading.at_look()))) or "none"


def reasons(computed: Computed) -> dict[str, str]:
    """One line for every claim."""
    c = computed
    pinched, longer = clearance(c, "Cq - Dw") < 0.2e-3, clearance(c, "Cp - Lw") < 0.3e-3
    return {
        "000-1": f"corners: {row(c, BETTER, 'corner', MPA, *CAGES[:3])} MPa; the roller just fits "
        "at 0.2 mm, so nothing is squeezed",
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
        "000-6": f"drops at 0.2 mm where that exceeds the clearance "
        f"({when(c, '000-6', 'j-1 drops at 0.2', pinched)} points), else in "
        f"{when(c, '000-6', 'j-1 drops at 0.2', ~pinched)}",
        "000-7": f"lower at 0.1 in {c.part(MAP, '000-7', 'lower at 0.1')}, sharply higher at 0.2 "
        f"in {c.part(MAP, '000-7', 'sharply higher at 0.2')}; {c.by(MAP, '000-7')}",
        "000-8": f"corners: {row(c, BETTER, 'corner', MPA, SOUND, LONGER, SHORTER)} MPa: the "
        "interference sets the stress",
        "000-8b": f"better model {row(c, BETTER, 'corner', MPA, SHORTER)} MPa at Cp - Lw = 0.25 mm",
        "000-9": f"unchanged in {c.part(MAP, '000-9', 'unchanged at +0.3')}, one line in "
        f"{c.part(MAP, '000-9', 'one line at -0.3')}",
        "000-10": f"larger at +0.3 in {c.part(MAP, '000-10', 'larger at +0.3')}, smaller at -0.3 "
        f"in {c.part(MAP, '000-10', 'smaller at -0.3')}",
        "000-11": f"less at +0.3 in {c.part(MAP, '000-11', 'less at +0.3')}, more at -0.3 in "
        f"{c.part(MAP, '000-11', 'more at -0.3')}",
        "000-12": f"drops where -0.3 mm exceeds the clearance "
        f"({when(c, '000-12', 'drops at -0.3', longer)} points), else in "
        f"{when(c, '000-12', 'drops at -0.3', ~longer)}",
        "000-13": f"j-1 changes in {c.part(MAP, '000-13', 'shorter: j-1 changes')}, j+1 in "
        f"{c.part(MAP, '000-13', 'shorter: j+1 changes')}; {c.by(MAP, '000-13')}",
    }  # fmt: skip


def lost(computed: Computed) -> str:
    """How many cages without a land were lost, in words; empty if that was not computed."""
    folder = computed.out / "lost"
    if not folder.is_dir():
        return ""
    found = [r for r in StudyResults(folder).rows if r.state == "done"]
    gone = [r for r in found if r.figures["lost"].value]
    return f"{len(gone)} of {len(found)}"


def words(computed: Computed) -> Words:
    """Summary, reasons, what decides, and readings, with the numbers of what was computed."""
    c = computed
    counts, points = c.counts, len(c.maps[MAP].shares)
    starts = {column: reading.starts for column, reading in c.readings.items()}
    summary = f"""The paper deforms one pocket of an N1013's brass cage at 6000 rpm and 1000 N, in
        ADAMS: its crossbeam by 0.1 and 0.2 mm, its side beam by +0.3 and -0.3 mm. It says that
        stress and slip rise where the roller is squeezed, and that orbits, vibration and speeds
        change with it. Of its {len(c.lines)} claims (one in two readings, one with a number)
        {counts["holds"]} hold, {counts["does not hold"]} do not; open: {counts["undecided"]}. One
        thing decides most: does the displacement exceed the pocket's clearance, which the paper
        does not print? How sure: {points} points of {len(c.maps[MAP].names) - 1} unknowns, one
        start each of five rigid cages over three turns; and
        {" and ".join(f"{n} starts ({column})" for column, n in starts.items())} with a flexible
        cage, over 39 ms each."""
    return Words(summary, reasons(c), decides(c), readings(c))


def decides(computed: Computed) -> list[str]:
    """What decides, in paragraphs."""
    c = computed
    pinched, shorter = clearance(c, "Cq - Dw") < 0.2e-3, clearance(c, "Cp - Lw") < 0.3e-3
    gone = lost(c)
    return [
        "**Clearance left or not.** Where 0.2 mm exceeds Cq - Dw, roller j-1 drops in "
        f"{when(c, '000-6', 'j-1 drops at 0.2', pinched)} points, elsewhere in "
        f"{when(c, '000-6', 'j-1 drops at 0.2', ~pinched)}; where 0.3 mm exceeds Cp - Lw, roller j "
        f"drops in {when(c, '000-12', 'drops at -0.3', shorter)}, elsewhere in "
        f"{when(c, '000-12', 'drops at -0.3', ~shorter)}. Friction holds a pinched roller in its "
        "pocket: it turns with the cage, backwards in the sense of rolling, which is a slip of "
        "109 %: a loss of all speed, where the paper's figures have a drop.",
        *([f"**No land, no cage.** Section 2.2 lists no contact between cage and rings. Rollers "
           f"alone do not hold the cage: {gone} runs of 60 ms lost it (more than 0.5 mm off the "
           "axis). The paper's cage stayed, so something that it does not list guides it; the "
           "printed model is judged on the inner ring's ribs."] if gone else []),
        f"**Stress (000-1, 000-8).** In the better model the corners of the deformed pockets see "
        f"{row(c, BETTER, 'corner', MPA, *CAGES)} MPa ({', '.join(CAGES)}). A pinch needs no "
        "motion: its stress is there from assembly on and stands still, as the paper says "
        f'("stabilizes" at {ROOT} MPa). It is interference over the pocket\'s compliance, so '
        "0.01 mm of clearance is worth tens of MPa; the pinched corners of cast brass (160 MPa) "
        "would yield.",
        f"**Whirl (000-2, 000-3, 000-10).** Whirl radii of the better model: "
        f"{row(c, BETTER, 'whirl', UM, *CAGES)} um. A moved crossbeam is met by its roller before "
        "its neighbours meet theirs; that roller drives the cage alone for a part of each turn, "
        "and swings it. A pinched roller drags the cage through the load zone once a turn: a "
        "regular motion at the cage's own frequency, but a larger one, not a smaller.",
        f"**Vibration (000-4).** All four deformations make spikes at 10 kHz in "
        f"{percent_text(c.found[MAP]['000-4'].share.value)} of the map, at 5 kHz in "
        f"{at_filter(c, 'spikes_5k')}, at 20 kHz in {at_filter(c, 'spikes_20k')}.",
    ]  # fmt: skip


def readings(computed: Computed) -> list[str]:
    """How the paper was read, and what is assumed."""
    c = computed
    return [
        "**Better model.** Flexible cage (coarse mesh), Hertz contact with restitution 0.9 at "
        "races and 0.7 in pockets, traction of 0.05 at 0.3 m/s, ribs 0.25 mm below the cage, a "
        "housing of 200 N/um; Cq - Dw = 0.20 mm and Cp - Lw = 0.25 mm.",
        "**As printed.** IMPACT by ADAMS' defaults (10 N s/mm, full from 0.1 mm on) over Hertz "
        "stiffness, friction 0.3 and 0.1 at 100 and 1000 mm/s, no oil, Craig-Bampton modes damped "
        "by 1, 10 and 100 % (to 100 Hz, to 1 kHz, above), the outer ring in contact with its "
        "socket. ADAMS' default exponent of 2.2 is not the paper's Hertz contact, and not used.",
        f"**Parts against.** Better model: 000-13 {contrary(c, BETTER, '000-13')}; as printed: "
        f"{contrary(c, PRINTED_MODEL, '000-13')}.",
        "**Words into numbers.** Unchanged: within 10 %, a roller's speed within 1 %. Clearly "
        "more: by 25 %. A drop of speed: by 5 %. Sinusoidal: half of the variance in one line. "
        f"{ROOT} MPa: within a factor of {WITHIN:g}. All were written before the runs.",
        '**Two readings.** "Whirl radius gradually expands ... once the deformation exceeds '
        '0.2 mm, decreases" is 000-3 where taken literally, 000-3b where it means 0 < 0.1 > 0.2.',
        "**Pockets.** Crossbeam 5, between j-1 = 4 and j = 5, is displaced as a whole, as equation "
        "1 says; side beams bend.",
        "**A rigid cage in the map** has no stress, so claims on stress are decided by the better "
        "model's starts; its pinch is stiffer than a flexible cage's.",
        *_flexible(c),
    ]  # fmt: skip


def _flexible(computed: Computed) -> list[str]:
    """What a flexible cage changes at the points that were rechecked."""
    rigid = computed.maps[MAP].parts[0]
    for results in computed.rechecks.values():
        rows = [np.flatnonzero((rigid.shares == s).all(axis=1)) for s in results.shares]
        same, both = 0, 0
        for claim in computed.paper.claims:
            if claim.key in OF_STRESS:
                continue
            before, after = rigid.judge(claim.holds), results.judge(claim.holds)
            for k, other in zip(rows, after):
                one = before[int(k[0])] if len(k) else None
                both += one is not None and other is not None
                same += one is not None and one == other
        if both:
            return [f"**Flexible cage.** At points of the map computed anew with an elastic cage "
                    f"{same} of {both} outcomes are as with a rigid one."]  # fmt: skip
    return ["**Flexible cage.** No point of the map was computed anew with an elastic cage."]


PAPER = Paper(
    title="An N1013 with a deformed cage pocket",
    source="Dynamic Characteristics of Cylindrical Roller Bearing with Cage Pocket Deformation, "
    "Lubricants 2025, 13(11), 495",
    claims=CLAIMS,
    readings="readings.toml",
    columns={"better": BETTER},
    alone={PRINTED_MODEL: ("readings_printed.toml", "printed")},
    studies=("lost.toml",),
    maps={MAP: ("map.toml",)},
    decided_by=DECIDED_BY,
    rechecks={"map.toml": (0, 3, 6, 9, 12)},
    recheck_conditions=CAGES,
    stress=("case.toml", {
        "defects": [{"type": "side_beam", "pocket": 5, "displacement": "-0.3 mm"}],
        "solver.duration": "40 ms",
    }),
    draw=draw,
    tables=tables,
    words=words,
    files=("printed.toml",),
)  # fmt: skip
