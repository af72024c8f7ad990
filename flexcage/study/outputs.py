"""What a study asks of every run: figures of its summary, reductions of result variables, and
figures of fatigue and wear, which are computed only where they are asked for."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass
from math import isfinite, nan, pi
from typing import TYPE_CHECKING

import numpy as np

from flexcage.cages import riveted_cages
from flexcage.core.binding import did_you_mean
from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES
from flexcage.results.figures.figure import (
    CAGED,
    FATIGUE,
    FITTED,
    FLEXIBLE,
    FULL,
    LATER,
    QUOTED,
    RIVETED,
    SIGNED,
    TEXT,
    WEAR,
)
from flexcage.results.figures.own import own_figures
from flexcage.results.figures.stress import (
    DAMAGE,
    RIVETS,
    RIVETS_TIME,
    STRESS,
    STRESS_TIME,
    TRACKS,
    stress_rows,
)
from flexcage.results.figures.table import FIGURES
from flexcage.results.metrics import carrier_angle, settled, whole_revolutions
from flexcage.results.reductions import DERIVED, REDUCTIONS
from flexcage.results.registry import (
    CAGES,
    ENERGIES,
    LABELS,
    NEIGHBOURS,
    TIME,
    VARIABLES,
    Variable,
    families_with,
    variable,
)
from flexcage.results.row import SummaryRow, Value
from flexcage.results.statistics import element_passes
from flexcage.stress.counting import require_pylife
from flexcage.stress.sn_curves import sn_curve
from flexcage.stress.wear_laws import wear_law
from flexcage.study.own import OWN, own_values
from flexcage.system.data import POWERS
from flexcage.system.layout import CONSTRAINTS

if TYPE_CHECKING:
    from flexcage.run import Run

#: Variables that are never below zero, and reductions that are not, whatever they reduce.
_SIZES = frozenset(
    """race_force pocket_force pocket_peak pocket_slice_force pocket_point_force
    rib_force counter_rib_force cage_whirl_radius cage_radial_displacement""".split()
)
_SIZED_REDUCTIONS = frozenset(
    "range std rms ripple crest frequency line_share mean_frequency".split()
)

_REDUCTION = re.compile(r"(\w+)(?:\[([^\]]*)\])?\.(\w+)")
_COUNTED = re.compile(r"(\d+)(?::(\d+))?")  # one place, or those from one to before another
_LABELS_OF_A_RUN = {"energy_kind": ENERGIES, "channel": tuple(POWERS)}


@dataclass(frozen=True)
class StudyFigure:
    """One number of a run: SI ``value``, its unit, and the unit it is printed in ("" for SI).

    ``margin`` is half the width of its 95 % interval by the run itself, None where it has none.
    """

    value: Value
    unit: str
    shown: str = ""
    margin: float | None = None


@dataclass(frozen=True)
class Reduction:
    """One number of a variable over the settled part of a run, cut to whole turns of the cage."""

    variable: Variable
    selection: Mapping[str, str]
    reduce: str

    @property
    def unit(self) -> str:
        """Unit of the number; of a variable like (x, r, psi), that of the component chosen."""
        own, units = REDUCTIONS[self.reduce].unit, self.variable.unit.split(", ")
        if own is not None or len(units) == 1:
            return self.variable.unit if own is None else own
        last = self.variable.dims[-1]
        return units[LABELS[last].index(self.selection[last])]

    def of(self, run: Run) -> StudyFigure:
        """The figure, with its unit and, where windows of the run give one, its margin; NaN where
        the run has no such variable: modes of a rigid cage, rings that do not bend."""
        reducer, unit = REDUCTIONS[self.reduce], self.unit
        name, dim = self.variable.name, self.variable.dims[0]
        if name in VARIABLES and name not in run.dataset:
            return StudyFigure(nan, unit)
        part = whole_revolutions(settled(run.dataset, run.case.output.settle))
        array = DERIVED[name].compute(part, run.numbers) if name in DERIVED else part[name]
        for along, label in self.selection.items():
            places = counted(label)
            if places is None:
                array = array.sel({along: label})
            elif places[1] > array.sizes[along]:
                raise InputError(
                    f"'{name}' has {array.sizes[along]} places along '{along}', counted from 0; "
                    f"'{label}' goes beyond.",
                    where="outputs",
                    value=label,
                )
            else:
                array = array.isel({along: places[0] if ":" not in label else slice(*places)})
        if CAGES in array.dims:  # of several cages that at -x, as in a summary
            array = array.isel({CAGES: 0})
        values, t = array.transpose(dim, ...).values, array[dim].values
        step = float(t[-1] - t[0]) / (len(t) - 1)
        half, turns = nan, 1
        if reducer.record is not None and dim == TIME:
            half = reducer.record(element_passes(part, run.numbers), values).margin
        elif reducer.by_turns:
            turns = round(abs(float(np.ptp(carrier_angle(part)))) / (2.0 * pi))
            half = reducer.margin_by_turns(values, step, turns)
        value = reducer.over_turns(values, step, turns)
        return StudyFigure(value, unit, "", half if isfinite(half) else None)


def _fatigue(run: Run) -> dict[str, StudyFigure]:
    """Damage and life at the worst place."""
    return _figures_in(DAMAGE.rows(run.rows[0].fatigue().worst.rate))


def _wear(run: Run) -> dict[str, StudyFigure]:
    """Volume from all pockets, and the depth of the deepest track at first."""
    return _figures_in(TRACKS.rows(run.wear()))


def _rivets(run: Run) -> dict[str, StudyFigure]:
    """The largest loads of rivets; none of a cage that has no stress or no rivets."""
    if not run.case.riveted:
        return {}
    rows = RIVETS.rows(run.rows[0].rivets)
    return _figures_in([*rows, *RIVETS_TIME.rows(run.stages)])


def _stress(run: Run) -> dict[str, StudyFigure]:
    """Equivalent stress, which a case leaves out while no output of its study needs it."""
    rows = stress_rows(run.rows[0].cage_stress.figures)
    return _figures_in([*rows, *STRESS_TIME.rows(run.stages)])


def _figures_in(rows: Iterable[SummaryRow]) -> dict[str, StudyFigure]:
    return {r.key: StudyFigure(r.value, r.unit, r.shown, r.margin) for r in rows}


_COMPUTED = {FATIGUE: _fatigue, WEAR: _wear, RIVETED: _rivets}
#: Figures that a summary may not hold: what computes them together.
LATE_FIGURES: Mapping[str, Callable[[Run], dict[str, StudyFigure]]] = {
    name: _stress if figure.section == STRESS.section else _COMPUTED[figure.needs]
    for name, figure in FIGURES.items()
    if figure.section == STRESS.section or figure.needs in _COMPUTED
}


def counted(label: str) -> tuple[int, int] | None:
    """First place and the one after the last of "3" or "3:7", None for a label in words."""
    match = _COUNTED.fullmatch(label)
    if match is None:
        return None
    first = int(match[1])
    return first, first + 1 if match[2] is None else int(match[2])


def is_reduction(name: str) -> bool:
    """True for "pocket_force.max", False for the name of a figure."""
    return _REDUCTION.fullmatch(name) is not None


def never_negative(name: str) -> bool:
    """Whether an output is a size, such as a force or a stress: an interval of it ends at zero."""
    match = _REDUCTION.fullmatch(name)
    if name in OWN:
        return False
    if match is None:
        return name not in FIGURES or SIGNED not in FIGURES[name].marks
    return match[1] in _SIZES or match[3] in _SIZED_REDUCTIONS


def beyond_summary(names: tuple[str, ...]) -> tuple[str, ...]:
    """Those among the outputs that a summary may not hold: reductions, ``LATE_FIGURES``, and what a
    user's own file adds."""
    late = {*LATE_FIGURES, *OWN, *own_figures()}
    return tuple(n for n in names if is_reduction(n) or n in late)


def needs_stress(names: tuple[str, ...]) -> bool:
    """Whether any of the outputs is of the cage's stress, its rivets or its fatigue."""
    late = {LATE_FIGURES[name] for name in names if name in LATE_FIGURES}
    return not late.isdisjoint({_stress, _fatigue, _rivets})


def lacking(beyond: tuple[str, ...], figures: Collection[str]) -> tuple[str, ...]:
    """Outputs beyond a summary that a case's figures do not hold and its cage can give: a rigid
    one, which has no modes, gives none that needs a flexible one, and no cage none of a cage."""
    rigid, caged = "mode_count" not in figures, "cage_mass" in figures
    separated = "element_touches" not in figures  # may elements touch?
    return tuple(
        n for n in beyond
        if n not in figures
        and not (rigid and _needs_flexible(n))
        and not (not caged and _needs_cage(n))
        and not (separated and _of_neighbours(n))
        and not (caged and n in FIGURES and FIGURES[n].needs == FULL)
    )  # fmt: skip


def _needs_cage(name: str) -> bool:
    if is_reduction(name):
        return parse_reduction(name).variable.of_cage
    return name in FIGURES and FIGURES[name].needs in (CAGED, FLEXIBLE, RIVETED, FATIGUE, WEAR)


def _of_neighbours(name: str) -> bool:
    return is_reduction(name) and parse_reduction(name).variable.name == NEIGHBOURS


def _needs_flexible(name: str) -> bool:
    return name in FIGURES and FIGURES[name].needs in (FLEXIBLE, RIVETED, FATIGUE)


def parse_reduction(name: str) -> Reduction:
    """Reduction from "variable.mean", "variable[dim=label,...].max" or "variable[dim=3:6].max"."""
    match = _REDUCTION.fullmatch(name)
    assert match is not None
    found = DERIVED[match[1]].variable if match[1] in DERIVED else variable(match[1])
    if match[3] not in REDUCTIONS:
        hint = did_you_mean(match[3], REDUCTIONS, "choose from")
        raise InputError(f"Output '{name}' reduces by '{match[3]}', which is not known; {hint}.")
    pairs = [pair.partition("=") for pair in (match[2] or "").split(",") if pair]
    selection = {dim.strip(): label.strip() for dim, _, label in pairs}
    if len(selection) < len(pairs):
        raise InputError(
            f"Output '{name}' says twice which of one dimension is meant; one output takes one of "
            "them, or a range as in pocket=3:6.",
            where="outputs",
            value=name,
        )
    for dim, label in selection.items():
        _check_label(name, found, dim, label)
    if ", " in found.unit and (last := found.dims[-1]) not in selection:
        raise InputError(
            f"Output '{name}' would mix {found.unit}; say which {last} of {found.name}, as in "
            f"'{match[1]}[{last}={LABELS[last][0]}].{match[3]}'.",
            where="outputs",
            value=name,
        )
    over = [dim for dim in found.dims[1:] if ":" in selection.get(dim, ":")]
    if over and REDUCTIONS[match[3]].series:
        raise InputError(
            f"Output '{name}': '{match[3]}' is that of one series; say which {over[0]}, as in "
            f"'{match[1]}[{over[0]}=...].{match[3]}'."
        )
    return Reduction(found, selection, match[3])


def _check_label(name: str, found: Variable, dim: str, label: str) -> None:
    if dim not in found.dims[1:]:
        hint = did_you_mean(dim, found.dims[1:], "its dimensions are")
        raise InputError(f"Output '{name}': {found.name} has no dimension '{dim}'; {hint}.")
    if dim == "constraint":  # ``check_outputs`` knows which there are
        return
    labels = LABELS.get(dim) or _LABELS_OF_A_RUN.get(dim)
    places = counted(label)
    if labels is None and (places is None or places[0] >= places[1]):
        raise InputError(
            f"Output '{name}': '{dim}' is counted from 0, so '{label}' is none; give one, as in "
            f"{dim}=3, or those from one to before another, as in {dim}=3:6."
        )
    if labels is not None:
        _check_known(name, dim, label, labels)


def _check_known(name: str, dim: str, label: str, labels: Collection[str]) -> None:
    if label not in labels:
        hint = did_you_mean(label, labels, "choose from")
        raise InputError(f"Output '{name}': there is no {dim} '{label}'; {hint}.")


#: Dimensions of what only rings that bend have: what that is, what a study without lacks, and what
#: gives it.
OF_RINGS = {
    "bending": (
        "rings that bend", "every ring of the study is rigid", "outer_ring.ring = 'flexible'",
    ),
    "support": (
        "supports of an outer ring that bends", "no ring of the study has any",
        "outer_ring.ring = 'flexible' and outer_ring.seat = 'arcs'",
    ),
}  # fmt: skip


#: Sections without which a case has no such figures.
OF_SECTIONS = (FITTED, QUOTED)


def check_outputs(
    names: tuple[str, ...], *, family: str, sizes: Mapping[str, int], flexible: bool,
    riveted: bool = False, caged: bool = True, uncaged: bool = False,
    materials: Collection[str] = (), sections: Collection[str] = (),
    reactions: Collection[str] = CONSTRAINTS, rings: Collection[str] = (),
) -> None:  # fmt: skip
    """Raise InputError for the first output that no run of the study can give.

    ``sizes`` holds the least length in any case of dimensions that are counted (rolling elements,
    pockets, slices), ``family`` is that of the bearings, ``flexible`` says whether any cage is,
    ``riveted`` whether one of these is riveted, ``caged`` and ``uncaged`` whether any case has a
    cage, and whether any has none, ``materials`` names those of all cages, ``sections`` of
    ``OF_SECTIONS`` those that any case has, ``reactions`` the
    constraints that every case has, and ``rings`` those of the dimensions ``OF_RINGS`` that any
    case has. Raises EnvironmentLacks for fatigue without pyLife.
    """
    if not names:
        raise InputError("The study has no outputs; name some, such as 'cage_speed'.")
    for i, name in enumerate(names):
        if name in names[:i]:
            raise InputError(f"Output '{name}' is asked for twice.", where="outputs", value=name)
        if is_reduction(name):
            reduction = parse_reduction(name)
            needs = reduction.variable.name.startswith(("modal_", "residual_"))
            _check_family(name, _families(reduction.variable.name), family)
            for dim in OF_RINGS.keys() & set(reduction.variable.dims) - set(rings):
                what, lacks, remedy = OF_RINGS[dim]
                raise InputError(
                    f"Output '{name}' is of {what}, but {lacks}; set {remedy} or leave it out.",
                    where="outputs",
                    value=name,
                )
            for dim, label in reduction.selection.items():
                if dim == "constraint":
                    _check_known(name, dim, label, reactions)
                places = counted(label)
                if places is not None and places[1] > sizes.get(dim, places[1]):
                    what = FAMILIES[family].element if dim == "element" else dim
                    raise InputError(
                        f"Output '{name}': the {what}s count from 0 to {sizes[dim] - 1}, and a "
                        "range ends before its last number."
                    )
        else:
            _check_figure(name)
            needs = _needs_flexible(name)
            if name in FIGURES:
                _check_late(name, materials)
                _check_family(name, FIGURES.owners(name), family)
        _check_cages(name, caged=caged, uncaged=uncaged)
        _check_sections(name, sections)
        if needs and not flexible:
            raise InputError(
                f"Output '{name}' needs a flexible cage, but every cage of the study is rigid; "
                "set cage.model = 'flexible' or leave it out.",
                where="outputs",
                value=name,
            )
        if name in FIGURES and FIGURES[name].needs == RIVETED and not riveted:
            cages, chosen = riveted_cages()
            raise InputError(
                f"Output '{name}' is of {cages}, but no flexible cage of the study is one; set "
                f"{chosen} or leave it out.",
                where="outputs",
                value=name,
            )


def _check_sections(name: str, sections: Collection[str]) -> None:
    """Refuse an output that only cases with a section have which no case has."""
    needs = FIGURES[name].needs if name in FIGURES else ""
    if needs in OF_SECTIONS and needs not in sections:
        section = needs.removeprefix("section ")
        raise InputError(
            f"Output '{name}' is of cases with {section}, but no case of the study has it; give "
            f"{section} or leave it out.",
            where="outputs",
            value=name,
        )


def _check_cages(name: str, *, caged: bool, uncaged: bool) -> None:
    """Refuse an output of a cage where no case has one, and of none where every case has one."""
    if not caged and _needs_cage(name):
        raise InputError(
            f"Output '{name}' is of a cage, but no case of the study has one; leave it out.",
            where="outputs",
            value=name,
        )
    if not uncaged and name in FIGURES and FIGURES[name].needs == FULL:
        raise InputError(
            f"Output '{name}' is of a full complement, but every case of the study has a cage; set "
            "cage.model = 'none' or leave it out.",
            where="outputs",
            value=name,
        )


def _families(variable: str) -> tuple[str, ...]:
    """Families whose runs have a variable; none: all."""
    return () if variable in DERIVED else families_with(variable)


def _check_family(name: str, families: tuple[str, ...], family: str) -> None:
    """Refuse an output that only bearings of other ``families`` have, if any are named."""
    if families and family not in families:
        others = " and ".join(dict.fromkeys(f"{FAMILIES[of].element}s" for of in families))
        raise InputError(
            f"Output '{name}' is of {others}, but the study's bearings have "
            f"{FAMILIES[family].element}s.",
            where="outputs",
            value=name,
        )


def _check_late(name: str, materials: Collection[str]) -> None:
    """Refuse fatigue and wear for which something is lacking."""
    needs = FIGURES[name].needs
    if needs == FATIGUE:
        require_pylife()
    for material in materials:
        if needs == FATIGUE:
            sn_curve(material)
        elif needs == WEAR:
            wear_law(material)


def _check_figure(name: str) -> None:
    if name in OWN:
        return
    if name in FIGURES and not {TEXT, LATER} & FIGURES[name].marks:
        return
    if name in FIGURES:
        what = "a text" if TEXT in FIGURES[name].marks else "a time of work after a run"
        raise InputError(
            f"Output '{name}' is {what}, but a study takes numbers that its runs give; 'flexcage "
            "figures' lists them.",
            where="outputs",
            value=name,
        )
    if name in VARIABLES or name in DERIVED:
        raise InputError(
            f"Output '{name}' is a variable over time; say how it becomes a number, such as "
            f"'{name}.mean' ({', '.join(REDUCTIONS)}).",
            where="outputs",
            value=name,
        )
    hint = did_you_mean(name, (*FIGURES, *OWN, *VARIABLES, *DERIVED), "")
    if not hint.startswith("the nearest"):
        hint = "'flexcage figures' lists figures, such as 'cage_speed'"
    raise InputError(f"There is no output '{name}'; {hint}.", where="outputs", value=name)


def figures_of(run: Run, beyond: tuple[str, ...]) -> dict[str, StudyFigure]:
    """All figures of the summary at the run's end, and those asked for beyond it; by name."""
    found = _figures_in(run.summary_at_end)
    return found | late_figures(run, lacking(beyond, found))


def late_figures(run: Run, names: tuple[str, ...]) -> dict[str, StudyFigure]:
    """Figures beyond the summary, by name, those computed together with them included."""
    found: dict[str, StudyFigure] = {}
    for compute in dict.fromkeys(LATE_FIGURES[name] for name in names if name in LATE_FIGURES):
        found |= compute(run)
    if not own_figures().keys().isdisjoint(names):
        found |= _figures_in(row for row in run.summary_at_end if row.key in own_figures())
    found |= {name: StudyFigure(*values) for name, values in own_values(run, names).items()}
    return found | {name: parse_reduction(name).of(run) for name in names if is_reduction(name)}
