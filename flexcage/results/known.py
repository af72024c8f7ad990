"""The one list of a summary's figures: title, unit, meaning, and which runs have them.

Summaries take titles and units from it, studies what they may ask for, terminals and plots what to
show, and documentation prints it (``flexcage figures``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from flexcage.core.binding import near_names
from flexcage.core.errors import InputError
from flexcage.core.listing import Listing
from flexcage.core.wings import FAMILIES, Parts
from flexcage.results.registry import whose
from flexcage.system.data import POWERS

FLEXIBLE, RIVETED, FATIGUE, WEAR = "flexible cage", "riveted cage", "fatigue", "wear"
CAGED, FULL = "a cage", "full complement"
_NEEDS = frozenset({FLEXIBLE, RIVETED, FATIGUE, WEAR, CAGED, FULL})

#: What a figure is: may it be below zero, is it a mean or a peak over windows of the run (and so
#: has an interval), is it a text instead of a number, does only a run read or drawn later have it.
SIGNED, STATISTIC, TEXT, LATER = "signed", "statistic", "text", "later"
#: Where a figure is not printed: it is zero, as a run had no use for it.
RARE = "rare"
#: Where a figure is shown among few: in the terminal after a run, large on a run's page, in a
#: study's table of energy and solver. What else is done with it: halves of a run are compared to
#: see whether it has settled, levels of a study of convergence are compared.
BRIEF, LARGE, EFFORT = "brief", "large", "effort"
SETTLING, CONVERGENCE = "settling", "convergence"

#: What ``drift`` says where no figure does.
NO_DRIFT = "none"

#: Words of titles that depend on the bearing or its cage, and what stands for them in a list.
WORDS = {"Element": "Element", "element": "element", "Faces": "Pocket faces",
         "place": "a corner or edge", "walls": "pocket walls"}  # fmt: skip


@dataclass(frozen=True)
class KnownFigure:
    """One figure of a run. ``pattern`` is its title, with the ``WORDS`` in braces; ``needs`` is
    what a run must have or compute for it; ``marks`` say what it is and where it is shown
    (``SIGNED`` ...)."""

    key: str
    pattern: str
    shown: str  # unit that it is printed in, "" for none
    meaning: str
    section: str
    needs: str = ""
    marks: frozenset[str] = frozenset()

    def titled(self, **words: str) -> str:
        """Its title, with these words in place of the general ones."""
        return self.pattern.format(**WORDS | words)

    @property
    def title(self) -> str:
        """Its title for any bearing and cage."""
        return self.titled()

    @property
    def quantity(self) -> str:
        """What it is a mean or a peak of: its title up to a comma, as part of a sentence."""
        return self.title.partition(",")[0].lower()


def figures_in(section: str, *rows: tuple, needs: str = "") -> Iterator[KnownFigure]:
    """Figures from rows of key, title, unit, meaning, and marks, among them what a row needs other
    than all."""
    for key, pattern, shown, meaning, *marks in rows:
        own = next((mark for mark in marks if mark in _NEEDS), needs)
        kept = frozenset(marks) - _NEEDS
        yield KnownFigure(key, pattern, shown, meaning, section, own, kept)


# fmt: off
def _statistics() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Statistics",
        ("settled_at", "Settled from", "ms", "end of the share that output.settle leaves out"),
        ("settled_time", "Time in statistics", "ms", "length of the settled part"),
        ("roller_passes", "{Element} passes counted", "",
         "windows of one element pass in the settled part", BRIEF),
        ("drift", "Still drifting", "",
         "figures that differ beyond the intervals between the halves of the settled part", TEXT),
    )


def _speeds() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Speeds",
        ("inner_speed", "Inner ring speed", "rpm", "mean", SIGNED),
        ("cage_speed", "Cage speed", "rpm", "mean over whole turns of the cage", CAGED, SIGNED,
         STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE),
        ("orbital_speed", "{Element}s' orbital speed", "rpm",
         "mean of all, over whole turns; without a cage", FULL, SIGNED, STATISTIC, BRIEF, LARGE,
         SETTLING, CONVERGENCE),
        ("epicyclic_speed", "Epicyclic cage speed", "rpm",
         "cage speed of pure rolling, of balls at the run's mean contact angles", SIGNED),
        ("cage_slip_ratio", "Cage slip ratio", "%",
         "(epicyclic speed - cage speed) / epicyclic speed", CAGED, SIGNED, STATISTIC, BRIEF, LARGE,
         CONVERGENCE),
        ("cage_speed_ripple", "Cage speed ripple", "%",
         "standard deviation over mean of the cage's speed", CAGED, STATISTIC, CONVERGENCE),
        ("orbital_slip_ratio", "{Element}s' orbital slip ratio", "%",
         "(epicyclic speed - orbital speed) / epicyclic speed; without a cage", FULL, SIGNED,
         STATISTIC, BRIEF, LARGE, CONVERGENCE),
    )


def _slip() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Slip",
        ("slip_loaded", "Slip ratio, loaded elements", "%",
         "mean over elements that bear more than 1 % of the largest inner race force", SIGNED,
         STATISTIC, BRIEF, CONVERGENCE),
        ("slip_unloaded", "Slip ratio, unloaded elements", "%", "mean over the others", SIGNED,
         STATISTIC, CONVERGENCE),
        ("sliding_inner_loaded", "Sliding, inner race, loaded", "m/s",
         "mean sliding speed of loaded elements", SIGNED),
        ("sliding_outer_loaded", "Sliding, outer race, loaded", "m/s",
         "mean sliding speed of loaded elements", SIGNED),
        ("loaded_share", "Loaded elements", "%", "share of all elements"),
    )


def _motion() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Cage motion",
        ("whirl_radius", "Whirl radius, mean", "um", "distance of the centre from its mean place",
         STATISTIC, LARGE, SETTLING, CONVERGENCE),
        ("whirl_radius_max", "Whirl radius, largest", "um", "largest such distance"),
        ("whirl_ratio", "Whirl (max - min)/mean", "", "spread of that distance over its mean"),
        ("whirl_radius_axis", "Whirl about axis, mean", "um",
         "distance of the centre from the ring's axis", STATISTIC, BRIEF),
        ("whirl_ratio_axis", "Whirl about axis (max - min)/mean", "",
         "spread of that distance over its mean"),
        ("whirl_speed_ratio", "Whirl speed / cage speed", "",
         "net turns of the centre about the ring's axis over the cage's, over whole turns", SIGNED),
        ("velocity_deviation", "Centre's speed, ripple", "%",
         "standard deviation over mean of the centre's speed, at the samples"),
        ("velocity_deviation_2khz", "Centre's speed, slow ripple", "%",
         "the same, low-passed at 2 kHz"),
        ("tilt_mean", "Cage tilt, mean", "deg", "angle between the cage's axis and the bearing's",
         STATISTIC),
        ("tilt_max", "Cage tilt, largest", "deg", "largest such angle"),
        needs=CAGED,
    )


def _forces() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Forces",
        ("pocket_force_mean", "Pocket force, mean", "N", "of a pocket's face while in contact",
         STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE),
        ("pocket_force_sum", "Pocket forces, mean of sum", "N", "of all faces together", STATISTIC,
         CONVERGENCE),
        ("pocket_force_pass_peak", "Pocket force, peak of a pass", "N",
         "mean of the largest in each element pass", STATISTIC, BRIEF, CONVERGENCE),
        ("pocket_force_peak", "Pocket force, largest", "N", "largest of the settled part", BRIEF,
         LARGE),
        ("pocket_force_ratio", "Pocket force, largest / mean", "",
         "largest over mean while in contact"),
        ("pocket_contact", "{Faces} in contact", "%", "share of faces and time"),
        needs=CAGED,
    )
    yield from figures_in(
        "Forces",
        ("race_force_inner", "Inner race on an element, peak", "N", "largest normal force", BRIEF),
        ("race_force_outer", "Outer race on an element, peak", "N", "largest normal force", BRIEF),
    )
    yield from figures_in(
        "Contacts of the cage",
        ("contact_frequency", "Contacts begun, mean of a pocket", "Hz",
         "contacts with elements begun in a second; every face counts", STATISTIC),
        ("contact_frequency_total", "Contacts begun, all pockets", "Hz", "of all pockets together",
         STATISTIC),
        ("free_flight_share", "Free flight", "%",
         "share of the time in which no pocket and no land touches the cage", STATISTIC),
        needs=CAGED,
    )
    yield from figures_in(
        "Contacts of neighbours",
        ("neighbour_force_mean", "Force on the next {element}, mean", "N",
         "of an element while it touches the next one", FULL, STATISTIC, BRIEF, LARGE, SETTLING,
         CONVERGENCE),
        ("neighbour_force_pass_peak", "Force on the next {element}, peak of a pass", "N",
         "mean of the largest in each element pass", FULL, STATISTIC, BRIEF, CONVERGENCE),
        ("neighbour_force_peak", "Force on the next {element}, largest", "N",
         "largest of the settled part", FULL, BRIEF, LARGE),
        ("neighbour_contact", "{Element}s that touch the next one", "%",
         "share of elements and time", FULL),
        ("largest_gap", "Largest gap between {element}s, mean", "mm",
         "between neighbours, along the pitch circle; mean over time", FULL, STATISTIC),
        ("element_touches", "{Element}s touching the next one", "",
         "times in the settled part that an element met the next one; with a cage shown if there "
         "are any"),
    )


def _ring() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Inner ring",
        ("drive_power", "Drive power", "W", "mean", SIGNED, STATISTIC),
        ("drive_torque", "Drive torque", "N mm", "mean power over mean speed", SIGNED, STATISTIC),
        ("inner_displacement", "Inner ring, displacement across the axis", "um",
         "of the mean place"),
        ("inner_axial", "Inner ring, displacement along the axis", "um", "mean", SIGNED, STATISTIC),
        ("inner_tilt", "Inner ring, tilt", "mrad", "mean angle of the ring's axis", SIGNED,
         STATISTIC),
        ("reaction_axial_force", "Inner ring, axial reaction", "N", "what holds the ring, mean",
         SIGNED, STATISTIC),
        ("reaction_moment_y", "Inner ring, moment about y", "N mm", "what holds the ring, mean",
         SIGNED, STATISTIC),
        ("reaction_moment_z", "Inner ring, moment about z", "N mm", "what holds the ring, mean",
         SIGNED, STATISTIC),
    )


def _outer() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Outer ring",
        ("outer_force_radial", "Outer ring, force across the axis", "N",
         "mean size of what all contacts press it with", STATISTIC),
        ("outer_force_axial", "Outer ring, force along the axis", "N", "mean", SIGNED, STATISTIC),
        ("outer_moment", "Outer ring, moment across the axis", "N mm",
         "mean size, about its centre", STATISTIC),
        ("outer_displacement", "Outer ring, displacement across the axis", "um",
         "of the mean place, on a mount that yields"),
        ("outer_tilt", "Outer ring, tilt", "mrad", "mean angle of its axis, likewise", STATISTIC),
    )


def _energy() -> Iterator[KnownFigure]:
    kinds = {"kinetic": "motion", "strain": "the cage's modes", "contact": "contacts",
             "mount": "shaft and housing springs"}
    gained = (
        (f"stored_{k}", f"Gained: {k}", "mJ", f"energy of {what}, end less beginning", SIGNED)
        for k, what in kinds.items()
    )
    works = (
        (f"work_{k}", f"Work: {k.replace('_', ' ')}", "mJ", "on the bearing; losses are < 0",
         SIGNED)
        for k in POWERS
    )
    yield from figures_in(
        "Energy",
        ("energy_audit", "Energy audit", "", "passed, exceeded or not judged", TEXT, BRIEF, LARGE,
         EFFORT),
        *gained,
        ("energy_moved", "Energy moved", "mJ", "sum of all energies and works, each positive"),
        ("energy_elastic", "Elastic energy, largest", "mJ", "in contacts, modes and springs"),
        ("energy_imbalance", "Energy imbalance, largest", "mJ", "energy gained less all work"),
        ("energy_relative", "Energy imbalance / energy moved", "%", "of the whole run"),
        ("energy_of_drive", "Energy imbalance / drive's work", "%", "the audit's first bound",
         EFFORT),
        ("energy_of_cage", "Energy imbalance / loss in the cage", "%", "the audit's second bound",
         EFFORT),
        *works,
    )


def _film() -> Iterator[KnownFigure]:
    for race in ("inner", "outer"):
        yield from figures_in(
            "Lubricant's film",
            (f"film_{race}", f"Film, {race} race, mean", "um",
             "middle of loaded elements' contacts; isothermal, fully flooded"),
            (f"film_least_{race}", f"Film, {race} race, least", "um", "of loaded elements"),
        )


def _cage() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Support",
        ("inner_held", "Support of the inner ring", "", "what holds the ring", TEXT),
    )
    yield from figures_in(
        "Cage",
        ("cage_mass", "Cage mass", "g", "with the mass that unbalances it", CONVERGENCE),
        ("cage_centre_shift", "Cage mass centre, shift", "um", "from the axis of the sound cage"),
        ("cage_modulus", "Cage modulus, warm", "GPa", "of a case with a cage.temperature"),
        ("pinch_force", "Pinch force at the start", "N",
         "of elements that a deformed pocket squeezes when assembled", CONVERGENCE),
    )
    yield from figures_in(
        "Cage",
        ("mode_count", "Cage modes", "", "number of modal coordinates"),
        ("first_frequency", "Cage modes, first frequency", "Hz", "of the free cage", CONVERGENCE),
        ("far_coupling", "Pockets' local coupling cut", "%",
         "of a push's deflection of its own pocket, what others would feel of it beyond the modes"),
        needs=FLEXIBLE,
    )
    yield from figures_in(
        "Equivalent stress",
        ("stress_peak", "Peak stress, {walls} excluded", "MPa",
         "of the settled part, without the walls of pockets that contacts press on", BRIEF,
         LARGE),
        ("stress_mean_peak", "Stress, mean of the cage's peak", "MPa",
         "mean over time of the largest at each instant", STATISTIC, BRIEF, CONVERGENCE),
        ("stress_root_pass_peak", "Stress at {place}, peak of a pass", "MPa",
         "at pocket corners or edges: mean of the largest in each element pass", STATISTIC, LARGE,
         CONVERGENCE),
        ("stress_root", "Stress at {place}, largest", "MPa", "at pocket corners or edges"),
        ("stress_start", "Stress before settling, largest", "MPa", "largest of the part left out"),
        _wall("stress", EFFORT),
        needs=FLEXIBLE,
    )
    yield from figures_in(
        "Rivets",
        ("rivet_tension", "Rivet tension, largest", "N", "of a rivet"),
        ("rivet_shear", "Rivet shear, largest", "N", "of a rivet"),
        ("rivet_stress", "Rivet stress, largest nominal", "MPa", "of a shank that bears all alone"),
        _wall("rivets"),
        needs=RIVETED,
    )


def _late() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Fatigue",
        ("fatigue_damage_rate", "Fatigue damage rate", "1/h", "at the worst named place",
         STATISTIC),
        ("fatigue_life", "Fatigue life", "h", "its inverse", STATISTIC),
        needs=FATIGUE,
    )
    yield from figures_in(
        "Wear",
        ("wear_volume_rate", "Wear, volume", "mm^3/h", "of all pockets"),
        ("wear_depth_rate", "Wear, depth", "um/h", "of the deepest track, at first"),
        needs=WEAR,
    )


def _wall(stage: str, *marks: str) -> tuple:
    words = stage.replace("_", " ")
    return f"wall_{stage}", f"Wall time, {words}", "s", "of this stage", *marks


def _solver() -> Iterator[KnownFigure]:
    yield from figures_in(
        "Solver",
        ("steps", "Steps", "", "accepted", EFFORT),
        ("explicit_steps", "Explicit steps", "", "of them, by the explicit method", RARE),
        ("residuals", "Residuals", "", "evaluations of the equations"),
        ("jacobians", "Jacobians", "", "", RARE),
        ("factorisations", "Factorisations", "", "of Newton's matrix", RARE),
        ("failed_error_tests", "Failed error tests", "", "steps repeated for their error", EFFORT),
        ("failed_newton", "Failed Newton iterations", "", "", EFFORT, RARE),
        ("repeated_blocks", "Blocks done again", "",
         "with a tenth of the tolerance or less, as their energy did not balance", EFFORT, RARE),
        ("stable_step", "Stability bound of explicit steps", "us",
         "least over the run, by the spectral radius"),
    )
    yield from figures_in(
        "Wall time",
        *(_wall(stage) for stage in ("mesh", "modes", "kernels", "start")),
        _wall("solve", EFFORT),
        _wall("cage", LATER),
        _wall("rings", LATER),
        _wall("rivet_joint", LATER),
        _wall("pictures", LATER),
        ("wall_total", "Wall time, total", "s", "of the whole command", BRIEF),
    )
# fmt: on


_FLOORS = (_statistics, _speeds, _slip, _motion, _forces, _ring, _outer, _energy, _film, _cage,
           _late, _solver)  # fmt: skip


class _BySection(Parts[KnownFigure]):
    """Figures in the order of a summary: those of a family close their section, and
    sections of its own come last."""

    def _all(self) -> dict[str, KnownFigure]:
        found = super()._all()
        place = {s: k for k, s in enumerate(dict.fromkeys(f.section for f in found.values()))}
        return dict(sorted(found.items(), key=lambda item: place[item[1].section]))


def _own(family: Any) -> tuple[KnownFigure, ...]:
    """Figures of one family; none if it has no motion."""
    found: tuple[KnownFigure, ...] = family.figures().known if family.figures else ()
    return found


#: Every figure by name, in the order of a summary.
KNOWN: Parts[KnownFigure] = _BySection(
    FAMILIES, lambda family: {f.key: f for f in _own(family)}, what="figure",
    common={figure.key: figure for part in _FLOORS for figure in part()},
)  # fmt: skip


def marked(mark: str) -> tuple[str, ...]:
    """Names of the figures that have a mark, in the order of a summary."""
    return tuple(key for key, figure in KNOWN.items() if mark in figure.marks)


#: What the list says of marks.
_KINDS = {TEXT: "a text", STATISTIC: "with an interval"}
PAGE = """# Figures of a run

Printed by `flexcage figures`.

A summary holds them (`run.summary["NAME"]`, in SI units), and studies take those that are
numbers as outputs. A figure "with an interval" comes with half of its 95 % interval
(`run.summary.row("NAME").margin`) where the run is long enough. All but the energies are of the
settled part.
"""


def near_figure(text: str) -> str:
    """The figure whose name is nearest to a text, as a part of a sentence; empty if none is."""
    close = near_names(text, KNOWN, 1)
    return f"; the nearest name is '{close[0]}'" if close else ""


def listing(text: str = "") -> Listing:
    """Figures whose name, title or meaning holds the text. InputError if there are none."""
    wanted = text.lower()
    found = [
        f for f in KNOWN.values() if wanted in f"{f.key} {f.title} {f.meaning} {f.section}".lower()
    ]
    if not found:
        raise InputError(
            f"No figure has the text '{text}'{near_figure(text)}; 'flexcage figures' lists all.",
            where="figures",
            value=text,
        )
    rows = []
    for f in found:
        needs = f"needs {f.needs}" if f.needs else ""
        kind = [word for mark, word in _KINDS.items() if mark in f.marks]
        said = "; ".join(filter(None, (f.meaning, *kind, whose(KNOWN.owners(f.key)), needs)))
        rows.append((f.key, f.shown, f"{f.title}: {said}" if said else f.title))
    return Listing("Figures of a run", ("figure", "unit", "meaning"), rows)
