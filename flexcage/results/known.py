"""The one list of a summary's figures: title, unit, meaning, and which runs have them.

Summaries take titles and units from it, studies what they may ask for, terminals and plots what to
show, and documentation prints it (``flexcage figures``).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from flexcage.core.binding import did_you_mean
from flexcage.core.errors import InputError
from flexcage.core.listing import Listing
from flexcage.results.statistics import Record
from flexcage.results.summary import Row, Value
from flexcage.system.data import POWERS

FLEXIBLE, RIVETED, FATIGUE, WEAR = "flexible cage", "riveted cage", "fatigue", "wear"


@dataclass(frozen=True)
class KnownFigure:
    """One figure of a run. ``of`` names rolling elements ("roller", "ball") whose bearings have it,
    "" all; ``needs`` what a run must have or compute for it; ``signed``: may it be below zero?"""

    key: str
    title: str
    shown: str  # unit that it is printed in, "" for none
    meaning: str
    section: str
    of: str = ""
    needs: str = ""
    signed: bool = False


def _section(section: str, *rows: tuple, of: str = "", needs: str = "") -> Iterator[KnownFigure]:
    """Figures from rows of key, title, unit, meaning, and "+-" if they may be below zero."""
    for key, title, shown, meaning, *more in rows:
        yield KnownFigure(key, title, shown, meaning, section, of, needs, "+-" in more)


def _statistics() -> Iterator[KnownFigure]:
    yield from _section(
        "Statistics",
        ("settled_at", "Settled from", "ms", "end of the share that output.settle leaves out"),
        ("settled_time", "Time in statistics", "ms", "length of the settled part"),
        ("roller_passes", "Passes counted", "", "windows of one element pass in the settled part"),
    )


def _speeds() -> Iterator[KnownFigure]:
    yield from _section(
        "Speeds",
        ("inner_speed", "Inner ring speed", "rpm", "mean", "+-"),
        ("cage_speed", "Cage speed", "rpm", "mean over whole turns of the cage", "+-"),
        ("epicyclic_speed", "Epicyclic cage speed", "rpm",
         "cage speed of pure rolling, of balls at the run's mean contact angles", "+-"),
        ("cage_slip_ratio", "Cage slip ratio", "%",
         "(epicyclic speed - cage speed) / epicyclic speed", "+-"),
        ("cage_speed_ripple", "Cage speed ripple", "%",
         "standard deviation over mean of the cage's speed"),
    )  # fmt: skip
    yield from _section(
        "Speeds",
        ("roller_spin", "Roller spin, mean of all", "rpm",
         "about the roller's axis, inertial frame, positive as in rolling", "+-"),
        ("roller_spin_ideal", "Roller spin, pure rolling", "rpm", "the same in pure rolling", "+-"),
        of="roller",
    )  # fmt: skip
    yield from _section(
        "Speeds",
        ("epicyclic_speed_nominal", "Epicyclic cage speed, nominal", "rpm",
         "cage speed of pure rolling at the nominal contact angle", "+-"),
        ("cage_slip_ratio_nominal", "Cage slip ratio, nominal", "%",
         "cage slip against that speed", "+-"),
        ("ball_spin", "Ball speed, mean of all", "rpm",
         "about the ball's axis, cage frame, positive as in rolling", "+-"),
        ("ball_spin_ideal", "Ball speed, pure rolling", "rpm",
         "the same in pure rolling at the run's mean contact angles", "+-"),
        of="ball",
    )  # fmt: skip


def _slip() -> Iterator[KnownFigure]:
    yield from _section(
        "Slip",
        ("slip_loaded", "Slip ratio, loaded elements", "%",
         "mean over elements that bear more than 1 % of the largest inner race force", "+-"),
        ("slip_unloaded", "Slip ratio, unloaded elements", "%", "mean over the others", "+-"),
        ("sliding_inner_loaded", "Sliding, inner race, loaded", "m/s",
         "mean sliding speed of loaded elements", "+-"),
        ("sliding_outer_loaded", "Sliding, outer race, loaded", "m/s",
         "mean sliding speed of loaded elements", "+-"),
        ("loaded_share", "Loaded elements", "%", "share of all elements"),
    )  # fmt: skip
    yield from _section(
        "Slip",
        ("sliding_inner_unloaded", "Sliding, inner race, unloaded", "m/s",
         "mean sliding speed of unloaded rollers", "+-"),
        ("sliding_outer_unloaded", "Sliding, outer race, unloaded", "m/s",
         "mean sliding speed of unloaded rollers", "+-"),
        of="roller",
    )  # fmt: skip
    yield from _section(
        "Slip",
        ("slip_loaded_nominal", "Slip ratio, loaded balls, nominal", "%",
         "loaded balls' slip against pure rolling at the nominal contact angle", "+-"),
        ("slip_curvature", "Slip ratio by the grooves' curvature", "%",
         "what curvature alone makes: balls roll on lines beside the middle of a contact"),
        ("contact_angle_inner", "Contact angle, inner race", "deg", "mean of loaded balls", "+-"),
        ("contact_angle_outer", "Contact angle, outer race", "deg", "mean of loaded balls", "+-"),
        ("edge_inner", "Ellipse beyond the inner groove's edge", "deg",
         "largest angle by which a contact ellipse passes the edge; below zero: it stays within",
         "+-"),
        ("edge_outer", "Ellipse beyond the outer groove's edge", "deg", "likewise", "+-"),
        of="ball",
    )  # fmt: skip


def _motion() -> Iterator[KnownFigure]:
    yield from _section(
        "Cage motion",
        ("whirl_radius", "Whirl radius, mean", "um", "distance of the centre from its mean place"),
        ("whirl_radius_max", "Whirl radius, largest", "um", "largest such distance"),
        ("whirl_ratio", "Whirl (max - min)/mean", "", "spread of that distance over its mean"),
        ("whirl_radius_axis", "Whirl about axis, mean", "um",
         "distance of the centre from the ring's axis"),
        ("whirl_ratio_axis", "Whirl about axis (max - min)/mean", "",
         "spread of that distance over its mean"),
        ("whirl_speed_ratio", "Whirl speed / cage speed", "",
         "net turns of the centre about the ring's axis over the cage's, over whole turns", "+-"),
        ("velocity_deviation", "Centre's speed, ripple", "%",
         "standard deviation over mean of the centre's speed, at the samples"),
        ("velocity_deviation_2khz", "Centre's speed, slow ripple", "%",
         "the same, low-passed at 2 kHz"),
        ("tilt_mean", "Cage tilt, mean", "deg", "angle between the cage's axis and the bearing's"),
        ("tilt_max", "Cage tilt, largest", "deg", "largest such angle"),
    )  # fmt: skip
    yield from _section(
        "Cage motion",
        ("whirl_difference", "Whirl radius, max - min", "um",
         "of the centre's distance from the ring's axis", "+-"),
        of="ball",
    )  # fmt: skip


def _forces() -> Iterator[KnownFigure]:
    yield from _section(
        "Forces",
        ("pocket_force_mean", "Pocket force, mean", "N", "of a pocket's face while in contact"),
        ("pocket_force_sum", "Pocket forces, mean of sum", "N", "of all faces together"),
        ("pocket_force_pass_peak", "Pocket force, peak of a pass", "N",
         "mean of the largest in each element pass"),
        ("pocket_force_peak", "Pocket force, largest", "N", "largest of the settled part"),
        ("pocket_force_ratio", "Pocket force, largest / mean", "",
         "largest over mean while in contact"),
        ("pocket_contact", "Pocket faces in contact", "%", "share of faces and time"),
        ("race_force_inner", "Inner race on an element, peak", "N", "largest normal force"),
        ("race_force_outer", "Outer race on an element, peak", "N", "largest normal force"),
        ("pinch_force", "Pinch force at the start", "N",
         "of elements that a deformed pocket squeezes when assembled"),
    )  # fmt: skip
    yield from _section(
        "Contacts of the cage",
        ("contact_frequency", "Contacts begun, mean of a pocket", "Hz",
         "contacts with elements begun in a second; every face counts"),
        ("contact_frequency_total", "Contacts begun, all pockets", "Hz", "of all pockets together"),
        ("free_flight_share", "Free flight", "%",
         "share of the time in which no pocket and no land touches the cage"),
    )  # fmt: skip


def _ring() -> Iterator[KnownFigure]:
    yield from _section(
        "Inner ring",
        ("drive_power", "Power of the drive", "W", "mean", "+-"),
        ("drive_torque", "Drive torque", "N mm", "mean power over mean speed", "+-"),
        ("inner_displacement", "Displacement across the axis", "um", "of the mean place"),
        ("inner_axial", "Displacement along the axis", "um", "mean", "+-"),
        ("inner_tilt", "Tilt", "mrad", "mean angle of the ring's axis", "+-"),
        ("reaction_axial_force", "Axial reaction", "N", "what holds the ring, mean", "+-"),
        ("reaction_moment_y", "Moment about y", "N mm", "what holds the ring, mean", "+-"),
        ("reaction_moment_z", "Moment about z", "N mm", "what holds the ring, mean", "+-"),
    )


def _energy() -> Iterator[KnownFigure]:
    kinds = {"kinetic": "motion", "strain": "the cage's modes", "contact": "contacts",
             "mount": "shaft and housing springs"}  # fmt: skip
    gained = (
        (f"stored_{k}", f"Gained: {k}", "mJ", f"energy of {what}, end less beginning", "+-")
        for k, what in kinds.items()
    )
    works = (
        (f"work_{k}", f"Work: {k.replace('_', ' ')}", "mJ", "on the bearing; losses are < 0", "+-")
        for k in POWERS
    )
    yield from _section(
        "Energy",
        *gained,
        ("energy_moved", "Energy moved", "mJ", "sum of all energies and works, each positive"),
        ("energy_elastic", "Elastic energy held", "mJ", "largest"),
        ("energy_imbalance", "Largest imbalance", "mJ", "energy gained less all work"),
        ("energy_relative", "Imbalance / energy moved", "%", ""),
        ("energy_of_drive", "Imbalance / drive's work", "%", "the audit's first bound"),
        ("energy_of_cage", "Imbalance / loss in the cage", "%", "the audit's second bound"),
        *works,
    )


def _film() -> Iterator[KnownFigure]:
    for race in ("inner", "outer"):
        yield from _section(
            "Lubricant's film",
            (f"film_{race}", f"Film, {race} race, mean", "um",
             "middle of loaded elements' contacts; isothermal, fully flooded"),
            (f"film_least_{race}", f"Film, {race} race, least", "um", "of loaded elements"),
        )  # fmt: skip


def _cage() -> Iterator[KnownFigure]:
    yield from _section(
        "Cage",
        ("cage_mass", "Mass", "g", "with the mass that unbalances it"),
        ("cage_centre_shift", "Shift of the mass centre", "um", "from the axis of the sound cage"),
    )
    yield from _section(
        "Cage",
        ("mode_count", "Dynamic modes", "", "number of modal coordinates"),
        ("first_frequency", "First frequency", "Hz", "of the free cage"),
        ("far_coupling", "Pockets' local coupling cut", "%",
         "of a push's deflection of its own pocket, what others would feel of it beyond the modes"),
        needs=FLEXIBLE,
    )  # fmt: skip
    yield from _section(
        "Equivalent stress",
        ("stress_peak", "Largest of the cage", "MPa",
         "of the settled part, without the flat walls of pockets that contacts press on"),
        ("stress_mean_peak", "Mean of the cage's peak", "MPa",
         "mean over time of the largest at each instant"),
        ("stress_root_pass_peak", "At a named place, peak of a pass", "MPa",
         "at pocket corners or edges: mean of the largest in each element pass"),
        ("stress_root", "Largest at a named place", "MPa", "at pocket corners or edges"),
        ("stress_start", "Before settling", "MPa", "largest of the part left out"),
        ("wall_stress", "Wall time of stress", "s", ""),
        needs=FLEXIBLE,
    )  # fmt: skip
    yield from _section(
        "Rivets",
        ("rivet_tension", "Largest tension", "N", "of a rivet"),
        ("rivet_shear", "Largest shear", "N", "of a rivet"),
        ("rivet_stress", "Largest nominal stress", "MPa", "of a shank that bears all alone"),
        needs=RIVETED,
    )


def _late() -> Iterator[KnownFigure]:
    yield from _section(
        "Fatigue",
        ("fatigue_damage_rate", "Damage rate", "1/h", "at the worst named place"),
        ("fatigue_life", "Life", "h", "its inverse"),
        needs=FATIGUE,
    )
    yield from _section(
        "Wear",
        ("wear_volume_rate", "Wear, volume", "mm^3/h", "of all pockets"),
        ("wear_depth_rate", "Wear, depth", "um/h", "of the deepest track, at first"),
        needs=WEAR,
    )


def _solver() -> Iterator[KnownFigure]:
    yield from _section(
        "Solver",
        ("steps", "Steps", "", "accepted"),
        ("explicit_steps", "Explicit steps", "", "of them, by the explicit method"),
        ("residuals", "Residuals", "", "evaluations of the equations"),
        ("jacobians", "Jacobians", "", ""),
        ("factorisations", "Factorisations", "", "of Newton's matrix"),
        ("failed_error_tests", "Failed error tests", "", "steps repeated for their error"),
        ("failed_newton", "Failed Newton iterations", "", ""),
        ("stable_step", "Stability bound of explicit steps", "us",
         "least over the run, by the spectral radius"),
    )  # fmt: skip
    stages = ("mesh", "modes", "kernels", "start", "solve")
    yield from _section(
        "Wall time",
        *((f"wall_{k}", k.capitalize(), "s", "wall time of this stage") for k in stages),
        ("wall_total", "Wall time in all", "s", "of the whole command"),
    )


_FLOORS = (_statistics, _speeds, _slip, _motion, _forces, _ring, _energy, _film, _cage, _late,
           _solver)  # fmt: skip
#: Every figure by name, in the order of a summary.
KNOWN: Mapping[str, KnownFigure] = MappingProxyType(
    {figure.key: figure for part in _FLOORS for figure in part()}
)


def figure(key: str, value: Value, note: str = "", *, label: str = "", idle: bool = False) -> Row:
    """The row of a known figure; ``label`` takes the place of its title."""
    known = KNOWN[key]
    return Row(key, label or known.title, value, known.shown, note, idle=idle)


def statistic(
    key: str, record: Record, note: str = "",
    *, label: str = "", value: float | None = None, idle: bool = False,
) -> Row:  # fmt: skip
    """The row of a known figure that is a statistic: its value (unless given) and its margin."""
    known = KNOWN[key]
    return Row.of(key, label or known.title, record, known.shown, note, value=value, idle=idle)


PAGE = """# Figures of a run

Printed by `flexcage figures`.

A summary holds them (`run.summary["NAME"]`, in SI units), and studies take them as outputs. Where
the run is long enough they come with half of a 95 % interval (`run.summary.row("NAME").margin`).
All but the energies are of the settled part.
"""


def listing(text: str = "") -> Listing:
    """Figures whose name, title or meaning holds the text. InputError if there are none."""
    wanted = text.lower()
    found = [
        f for f in KNOWN.values() if wanted in f"{f.key} {f.title} {f.meaning} {f.section}".lower()
    ]
    if not found:
        hint = did_you_mean(text, KNOWN, "'flexcage figures' lists all")
        raise InputError(f"No figure has the text '{text}'; {hint}.", where="figures", value=text)
    rows = []
    for f in found:
        whose = f"{f.of} bearings" if f.of else ""
        needs = f"needs {f.needs}" if f.needs else ""
        told = "; ".join(filter(None, (f.meaning, whose, needs)))
        rows.append((f.key, f.shown, f"{f.title}: {told}" if told else f.title))
    return Listing("Figures of a run", ("figure", "unit", "meaning"), rows)
