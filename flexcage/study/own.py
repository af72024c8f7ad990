"""Outputs of a study that a user's own file adds: numbers of a run that no summary holds.

Workers compute them at the end of a run, so that a study that keeps figures only has them as well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING

from flexcage.core.errors import InputError
from flexcage.core.registry import add, check_free, check_word
from flexcage.results.figures.own import OUTPUTS
from flexcage.results.figures.table import FIGURES
from flexcage.results.reductions import DERIVED
from flexcage.results.registry import VARIABLES
from flexcage.results.row import SHOWN, check_shown

if TYPE_CHECKING:
    from flexcage.run import Run

    Compute = Callable[[Run], Mapping[str, float]]

WHAT, VARIABLE = "study output", "result variable"


@dataclass(frozen=True)
class OwnOutput:
    """One number: the unit that it is shown in, and the function that gives it among others."""

    name: str
    shown: str
    compute: Compute


#: Figures of a user's own may not have these names.
OWN: dict[str, OwnOutput] = OUTPUTS


def register_outputs(compute: Compute, units: Mapping[str, str]) -> None:
    """Add outputs that studies may ask for: ``units`` has their names, each with the unit in which
    it is shown ("" for none).

    ``compute(run)`` returns their values in SI by name; one that a run does not have is NaN. It is
    called once a run, whichever of them are asked for. A figure that is stored is not computed
    again when the file behind ``compute`` changes: give a changed one another name.

    Raises InputError for a name that is taken, be it by a figure or a variable, or a unit that
    no figure is shown in.
    """
    for name, shown in units.items():
        check_word(name, what=WHAT)
        for taken, what in ((FIGURES, "figure"), (VARIABLES, VARIABLE), (DERIVED, VARIABLE)):
            check_free(taken, name, what=what)
        check_shown(WHAT, name, shown)
        add(OWN, name, OwnOutput(name, shown, compute), what=WHAT)


def own_values(run: Run, names: tuple[str, ...]) -> dict[str, tuple[float, str, str]]:
    """Value, SI unit and shown unit of those among ``names`` that a user's file has added, and of
    what is computed together with them."""
    found: dict[str, tuple[float, str, str]] = {}
    for compute in dict.fromkeys(OWN[name].compute for name in names if name in OWN):
        values = compute(run)
        for output in (o for o in OWN.values() if o.compute is compute):
            if output.name not in values:
                raise InputError(
                    f"The function behind the {WHAT} '{output.name}' gave no such value.",
                    where=output.name,
                )
            value = float(values[output.name])
            known = value if isfinite(value) else float("nan")
            found[output.name] = (known, SHOWN[output.shown][0], output.shown)
    return found
