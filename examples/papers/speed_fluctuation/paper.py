"""The paper on fluctuating speed: its readings, its maps, and what was found."""

from __future__ import annotations

import numpy as np
from claims import A3, A6, A9, CLAIMS, CONSTANT, N2, N3
from figures import BEARING, BETTER, MODEL, PERCENT, PRINTED, PRINTED_MODEL, RPM, UM, draw, tables
from paper_index import Measured
from paper_weighed import Asked, rechecked
from repeat import Computed, Paper, Words

from flexcage.core.digits import percent_text

CALM = 0.01  # fluctuation at constant speed below which a cage is calm
DRIVEN = 10.0  # N between a ball and the cage, above which friction drives it
CASES = (CONSTANT, A3, A6, A9, N2, N3)
#: Numbers that claims are judged by, whose unknowns are weighed: chosen before the runs.
WEIGHED = tuple(
    Asked(f"{words}, {A6}", output, A6, factor)
    for words, output, factor in (
        ("mean speed of the cage [rpm]", "speed_whole", RPM),
        ("fluctuation of the cage [%]", "swing", PERCENT),
        ("largest distance of the cage [um]", "distance", UM),
        ("largest force of a ball on the cage [N]", "one_force", 1.0),
        ("largest distance of the ring [um]", "ring_distance", UM),
    )
)  # fmt: skip


def middle(computed: Computed, column: str, output: str, condition: str, factor: float) -> str:
    """Median of a map under one condition."""
    found = computed.maps[column].means(output, condition)
    return f"{np.nanmedian(found) * factor:.3g}" if np.isfinite(found).any() else "-"


def medians(computed: Computed, column: str, output: str, conditions, factor: float) -> str:
    return ", ".join(middle(computed, column, output, c, factor) for c in conditions)


def spread(computed: Computed, column: str, output: str, condition: str, factor: float) -> str:
    """Least and largest of a map under one condition."""
    found = computed.maps[column].means(output, condition) * factor
    return f"{np.nanmin(found):.4g} to {np.nanmax(found):.4g}"


def regimes(computed: Computed) -> tuple[np.ndarray, np.ndarray]:
    """Of the points of the model's map that are whole: is the cage calm at constant speed, and does
    friction stay static at any speed?"""
    joined = computed.maps[MODEL]
    swing = joined.means("swing", CONSTANT)
    decay = joined.shares[:, joined.names.index("decay of friction")]
    there = np.isfinite(swing)
    return swing[there] < CALM, decay[there] < 1.0 / 3.0


def reasons(c: Computed) -> dict[str, str]:
    """One line a claim, with its numbers."""
    calm, _ = regimes(c)
    return {
        "002-0": f"largest error {spread(c, MODEL, 'kinematics', CONSTANT, PERCENT)} %: 3500 N "
        "press all balls on their races",
        "002-0b": f"{spread(c, MODEL, 'speed_whole', CONSTANT, RPM)} rpm, a start from rest "
        "included: nothing costs 1.4 %",
        "002-1": "balls follow the ring, the cage follows balls; "
        f"at 6 % in {c.part(MODEL, '002-1', A6)}, at 9 % in {c.part(MODEL, '002-1', A9)}",
        "002-1b": f"grows in {c.part(MODEL, '002-1b', 'grows')}; medians "
        f"{medians(c, MODEL, 'swing', (CONSTANT, A3, A6, A9), PERCENT)} %",
        "002-1c": f"medians {middle(c, MODEL, 'speed', CONSTANT, RPM)} to "
        f"{middle(c, MODEL, 'speed', N3, RPM)} rpm: balls roll",
        "002-2": "at 3 % the ring's sine has "
        f"{middle(c, MODEL, 'follows', A3, PERCENT)} % of the variance (median)",
        "002-2b": f"median {middle(c, MODEL, 'swing', CONSTANT, PERCENT)} %; a cage that friction "
        f"excites has more, a calm one ({percent_text(float(np.mean(calm)))}) less",
        "002-3": "the load's spread of balls carries the cage "
        f"{middle(c, MODEL, 'distance', CONSTANT, UM)} um off without any wave",
        "002-3b": f"medians over A {medians(c, MODEL, 'one_force', (CONSTANT, A3, A6, A9), 1)} N, "
        f"over N {medians(c, MODEL, 'one_force', (A6, N2, N3), 1)} N",
        "002-4": f"an ellipse at 0 in {c.part(MODEL, '002-4', 'an ellipse at 0')}, at 3 % in "
        f"{c.part(MODEL, '002-4', 'an ellipse at 3 %')}; irregular at 9 % in "
        f"{c.part(MODEL, '002-4', 'irregular at 9 %')}",
        "002-4b": f"with A in {c.part(MODEL, '002-4b', 'with A')}, with N in "
        f"{c.part(MODEL, '002-4b', 'with N')}: any wave disorders, more hardly does",
        "002-5": f"{middle(c, MODEL, 'ring_distance', CONSTANT, UM)} um are the load's; waves add "
        f"nanometres (range {medians(c, MODEL, 'ring_range', (CONSTANT, A9), UM)} um)",
        "002-5b": f"what place does not make: {middle(c, MODEL, 'ripple', CONSTANT, PERCENT)} % at "
        f"constant speed, {middle(c, MODEL, 'ripple', A9, PERCENT)} % at 9 %",
        "002-6": f"{spread(c, MODEL, 'by_place', CONSTANT, PERCENT)} % of the variance follows "
        "from the place",
        "002-7": f"medians at N = 1, 2, 3: {medians(c, MODEL, 'swing', (A6, N2, N3), PERCENT)} %; "
        f"{c.by(MODEL, '002-7', 'it wants')}",
    }


def whole(c: Computed, column: str) -> int:
    """Points of a map that are done under every condition."""
    found = np.array([c.maps[column].means("swing", k) for k in CASES])
    return int(np.isfinite(found).all(axis=0).sum())


def summary(c: Computed) -> str:
    """What the paper says, what was found, how sure."""
    joined, points = c.maps[MODEL], whole(c, MODEL)
    return f"""The paper simulates a ball screw bearing, a 7603025, in LS-DYNA. Its inner ring turns
        at 2000 rpm, and its speed fluctuates by 3 to 9 %, once to three times a turn. The paper
        says that the cage's speed follows the ring's, that its mean does not change, and that
        orbits and forces of cage and ring grow with the fluctuation. Of its {len(c.lines)} claims
        {c.tally}. What holds is what
        rolling balls enforce. The printed 922 rpm (935 by kinematics) hold nowhere. How sure:
        {points} points of {len(joined.names) - 1} unknowns of the paper's own model,
        {whole(c, BEARING)} of the real bearing, one start each under six
        conditions{by_starts(c)}, all over 0.45 s as in the paper."""


def by_starts(c: Computed) -> str:
    """Readings that have as many starts as the first look, and how many all have."""
    there = [column for column, reading in c.readings.items() if reading.look]
    if not there:
        return "; readings are not complete"
    starts = min(c.readings[column].starts for column in there)
    return f", and {starts} starts of {len(there)} readings ({', '.join(there)})"


def decides(c: Computed) -> list[str]:
    """What decides, seen in the data."""
    calm, static = regimes(c)
    better, printed = c.readings[BETTER], c.readings[PRINTED_MODEL]
    return [
        "**Two regimes.** With friction that stays static at any speed (LS-DYNA's default) "
        f"{percent_text(float(np.mean(~calm[static])))} of the points have a cage that fluctuates "
        "by more than 1 % at constant speed; with friction that decays "
        f"{percent_text(float(np.mean(~calm[~static])))}. Pocket friction then drives the cage "
        "round its play, its forces are tens of times larger, and waves of the ring drown: there "
        "the cage's speed has no pronounced period at 3 % (002-2). Starts alone may decide: "
        f"{driven(better)} starts of the better model at 6 % are driven so, the others calm.",
        "**As printed** friction is low, and no cage is driven: it fluctuates by "
        f"{printed.said('swing', A6, PERCENT)} % at 6 % (Tables 6 and 7: 6.48 and 6.40), by "
        f"{printed.said('swing', A9, PERCENT)} % at 9 %, but by "
        f"{printed.said('swing', CONSTANT, PERCENT)} % at constant speed (2.89), and it swings by "
        f"more at N = 2 and 3 ({printed.said('swing', N2, PERCENT)}, "
        f"{printed.said('swing', N3, PERCENT)} %; 6.48 for N = 2).",
        "**Balls follow the ring (002-1).** The balls' mean orbital speed has the ring's wave: "
        f"{middle(c, MODEL, 'ball_gain', A6, PERCENT)} % at 6 %, "
        f"{middle(c, MODEL, 'ball_gain', A9, PERCENT)} % at 9 % (medians). The cage crosses the "
        "play of its pockets, arrives faster than the ball, and is thrown back: it swings by more "
        "than the ring, and the more the faster the waves (002-1b, 002-7).",
        "**Why not 922 rpm (002-0b).** The load presses balls on their races: loaded inner "
        f"contacts slide by {middle(c, MODEL, 'slip', CONSTANT, PERCENT)} % of the rolling speed "
        "(median). Contact angles that differ from 60 degrees make the cage 0.2 to 0.5 % faster "
        f"than equation 6, and a start from rest costs {gap(c)} rpm of the mean over 0.45 s. What "
        "is left, and was not shown here, is the paper's mesh: balls and rings of flat elements of "
        "a third of a millimetre, which roll on chords, and penalty springs. Its own columns "
        "differ as much: 922 rpm and 15,692 passes make 18,326 on the inner ring, where it prints "
        "18,545.",
        "**Distances (002-3, 002-4).** Under the combined load balls run ahead and behind, by "
        f"{middle(c, MODEL, 'excursion', CONSTANT, UM)} um (median) along the pitch circle, more "
        "than the play of most pockets. That carries the cage off the axis without any wave, as "
        "far as the pockets let it; a wave shakes it, and no farther.",
        "**By indices** (table below, at 6 %) the decay of friction moves speed, fluctuation and "
        "force of the paper's own model most, pocket play the cage's way, stiffness of races the "
        "ring's. In the real bearing the pockets' shape and play decide how far the cage goes, "
        "play and friction in pockets how it fluctuates.",
        "**Inner ring (002-5).** The load alone moves it by "
        f"{spread(c, MODEL, 'ring_distance', CONSTANT, UM)} um, as grooves and stiffness have it "
        f"(better model: {better.said('ring_distance', CONSTANT, UM)} um at constant speed, "
        f"{better.said('ring_distance', A3, UM)} um at 3 %). Balls' passing and waves move it by "
        f"{medians(c, MODEL, 'ring_range', (CONSTANT, A9), UM)} um (medians, constant and 9 %).",
    ]  # fmt: skip


def driven(reading) -> str:
    """Starts at 6 % in which friction drives the cage, of all."""
    force = reading.values("one_force", A6)
    return f"{(force > DRIVEN).sum()} of {len(force)}"


def gap(c: Computed) -> str:
    """What a start from rest takes of the mean speed over the whole record [rpm], median."""
    joined = c.maps[MODEL]
    rest = joined.shares[:, joined.names.index("start")] < 0.5
    lost = joined.means("speed", CONSTANT) - joined.means("speed_whole", CONSTANT)
    return f"{np.nanmedian(lost[rest]) * RPM:.2g}"


def lost(c: Computed) -> str:
    """Runs of the model's map that lost the cage, of all that were tried."""
    failed, tried = c.maps[MODEL].lost()
    return f"{failed} of {tried} runs"


def words(computed: Computed) -> Words:
    """Summary, reasons, what decides, and readings, with the numbers of what was computed."""
    readings = [
        "**Geometry.** 34,000 ball passes a minute at 2000 rpm make 17 balls; printed speeds a "
        "pitch circle of 42.4 mm with balls of 5.55 mm. Grooves, shoulders and cage are "
        "assumptions.",
        "**The paper's own model** is the map of the model: its friction, its constraints (a cage "
        "that cannot tilt, no land, no gravity), contacts nearly without damping. The reading as "
        "printed is one point of it by its starts: dynamic coefficients at once, as the text has "
        "it, and a rolling start. It was changed three times after trial runs (a decay of 1000 s/m "
        "in place of friction that stays static; then the dynamic coefficients alone; a rolling "
        "start in place of one from rest).",
        "**Better model.** Film traction of 0.06 at races and in pockets with creep up to 10 mm/s, "
        "restitution 0.8 and 0.6, gravity, a free cage, shoulders of the rings that it may touch.",
        "**Fluctuation** is half the range over the mean, of samples every millisecond as in the "
        "paper, over 0.36 s after the first 0.09 s; \"from the start on\" is the whole record.",
        "**Rigid rings and balls.** The paper's are elastic between a rigid bore and a fixed "
        "outside. In the static solution such rings move the inner one by 16.61 um across and "
        "10.35 um along the axis in place of 16.18 and 10.06 um: 2.7 and 2.9 % more (on "
        "foundations of 10 N/um and mm^2 16 and 14 %). Stiffness of races is an unknown.",
        "**Cages lost.** With low friction at once, a start from rest in cylindrical pockets tears "
        f"the cage off within 4 ms, as loaded balls start and others lag: {lost(computed)} of the "
        "map of the model. The model's screening therefore has spheres and rolling starts alone.",
        "**Changed after the first runs were seen.** Friction that falls to the dynamic "
        "coefficient within 1 mm/s (a decay of 1000 s/m) makes loaded contacts chatter, and runs "
        "twenty times as long; the map's last choice of decay has the dynamic coefficients alone, "
        "with creep in place of sticking. Earlier maps had 16 points; ranges and rules stayed as "
        "they were.",
        *rechecked(computed, "swing"),
    ]  # fmt: skip
    return Words(summary(computed), reasons(computed), decides(computed), readings)


def measured(c: Computed) -> list[Measured]:
    """The measured speed of the cage, beside the better model and the map of the bearing."""
    found = c.maps[BEARING].spread("speed", CONSTANT) * RPM
    return [Measured(
        "cage speed of the 7603025, 2000 rpm", f"{PRINTED['text']['test']:g} rpm",
        f"{c.readings[BETTER].said('speed', CONSTANT, RPM)} rpm",
        f"{found[1]:.1f} ({found[0]:.1f} to {found[2]:.1f}) rpm",
    )]  # fmt: skip


PAPER = Paper(
    title="A 7603025 whose speed fluctuates",
    source="Effect of Rotational Speed Fluctuation Parameters on Dynamic Characteristics of "
    "Angular Contact Ball Bearings, Symmetry 2025, 17(10), 1761",
    claims=CLAIMS,
    readings="readings.toml",
    columns={"better": BETTER, "printed": PRINTED_MODEL},
    maps={MODEL: ("map_model.toml",), BEARING: ("map_bearing.toml",)},
    decided_by={claim.key: MODEL for claim in CLAIMS},
    # Points at the ranks 0, 1/4, 1/2, 3/4 and 1 of the cage's fluctuation at constant speed, which
    # parts the two regimes: chosen before any of these runs; fewer conditions for time.
    rechecks={"map_model.toml": (0, 1, 3, 13, 4), "map_bearing.toml": (3, 10, 14, 4, 13)},
    recheck_conditions=(CONSTANT, A3, A9),
    weighed={"screen_bearing.toml": WEIGHED, "screen_model.toml": WEIGHED},
    stress=("case.toml", {
        "cage.model": "flexible", "drive.wave": "sine", "drive.wave_amplitude": "120 rpm",
        "drive.wave_period": "10 ms", "solver.duration": "60 ms",
    }),
    draw=draw,
    tables=tables,
    words=words,
    measured=measured,
    files=("predictions.json", "printed.toml"),
)  # fmt: skip
