"""The one table of result variables: dimensions, unit, long name, type and precision.

The store allocates from it, the dataset is labelled from it, and documentation prints it.
A new output is one more line here, or in a family, and one more array handed to ``write_block``;
from outside, a call of ``register`` with the function that computes it.
Forces act *on* the named body. Frames: "ring" is the fixed frame (x: bearing axis, y towards
element 0 at the start); "cyl" is (x, r, psi) at the element's own azimuth.

The same quantity has the same name and dimensions in every family of bearings; what only one of
them records is in the ``OwnVariables`` that it brings along.

Precision. Energies, work, and orientation and speed of inner ring and cage are kept as computed,
positions of elements to 38 bits (an angle grows without bound), all else in single precision, 24
bits. Values that mean something only together are rounded together, to a share of the largest of
them at that instant: quaternions to 6e-8, modal values and the two moments of a race to 1e-6;
forces of slices, points and stations of a face, and residual coordinates of a pocket, to 3e-5.
Runs in memory are not rounded, and nothing that a run is resumed from is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.binding import near_names
from flexcage.core.errors import InputError
from flexcage.core.listing import Listing
from flexcage.core.registry import check_free
from flexcage.core.wings import FAMILIES, Parts
from flexcage.modes.basis import FACES

if TYPE_CHECKING:
    from flexcage.system.problem import BearingSystem

    Compute = Callable[[Mapping[str, np.ndarray], BearingSystem], np.ndarray]

NEIGHBOURS = "neighbour_force"
CAGES = "cage"  # dimension of runs in which each row of elements has a cage
TIME = "time"
TIME_HF = "time_hf"

#: Dimensions of all bearings whose labels never change. Others get theirs from a run.
_LABELS: dict[str, tuple[str, ...]] = {
    "axis": ("x", "y", "z"),
    "axis2": ("y", "z"),
    "cyl": ("x", "r", "psi"),
    "polar": ("r", "psi"),
    "spin_axis": ("axial", "radial", "tangential"),
    "quaternion": ("w", "x", "y", "z"),
    "race": ("inner", "outer"),
    "bending": ("axial", "radial", "tilt"),
    "face": FACES,
}

#: Dimensions of all bearings whose labels a run gives.
RUN_DIMS = (
    "element", CAGES, "pocket", "mode", "station", "constraint", "energy_kind", "channel",
    "land_station", "support", "spotted",
)  # fmt: skip
ENERGIES = ("kinetic", "strain", "contact", "mount")  # labels of energy_kind
#: Bits of values that are rounded together: forces of parts of a face, modal values and moments.
FORCE_BITS, MODAL_BITS = 15, 20


@dataclass(frozen=True)
class Variable:
    """One result: its dimensions (time first), unit, what it is, and how it is stored.

    ``dtype`` is its type in datasets. On disk it has ``bits`` significant bits of the largest of
    each group of values: those along its last ``together`` dimensions, or each alone. Most values
    of a ``sparse`` one are zero: then zeros stand together, else the values of one place. Runs
    without a cage have none that is ``of_cage``.
    """

    name: str
    dims: tuple[str, ...]
    unit: str
    long_name: str
    dtype: str = "float64"
    bits: int = 53
    together: int = 0
    sparse: bool = False
    of_cage: bool = False

    @property
    def stored(self) -> str:
        """Its type on disk."""
        return "float32" if self.bits <= 24 else "float64"

    def rounded(self, values: np.ndarray) -> np.ndarray:
        """Values as they are stored, in the type that they have on disk."""
        return rounded(values, self.stored, self.bits, self.together)

    @property
    def attrs(self) -> dict[str, str]:
        return {"units": self.unit, "long_name": self.long_name}


def of_each_cage(variable: Variable) -> Variable:
    """The variable of a run in which each row of elements has a cage: one that is of a whole cage
    has these as a dimension."""
    if not variable.of_cage or {"pocket", "element"} & {*variable.dims}:
        return variable
    return replace(variable, dims=(variable.dims[0], CAGES, *variable.dims[1:]))


@dataclass(frozen=True)
class OwnVariables:
    """What bearings of one family record beside what all do: ``variables``; ``labels`` of their own
    dimensions that never change, and ``counted``, those whose labels a run gives, with lengths in
    ``sizes`` where all runs have the same."""

    variables: tuple[Variable, ...]
    labels: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    counted: tuple[str, ...] = ()
    sizes: Mapping[str, int] = field(default_factory=dict)

    @property
    def dims(self) -> set[str]:
        """Their own dimensions."""
        return {*self.labels, *self.counted}


def rounded(values: np.ndarray, stored: str, bits: int, together: int = 0) -> np.ndarray:
    """Floats (n, ...) in type ``stored`` with so many bits of the largest along the last
    ``together`` dimensions, or of each alone."""
    if values.size == 0 or (bits > np.finfo(stored).nmant and not together):
        return values.astype(stored, copy=False)
    groups = values.reshape(math.prod(values.shape[: values.ndim - together]), -1)
    some = np.flatnonzero(np.einsum("ij,ij->i", groups, groups))  # in pockets, most are zero
    part = groups[some].astype(stored, copy=False)
    largest = np.abs(part).max(axis=1, keepdims=True)
    unit = np.ldexp(part.dtype.type(1.0), np.frexp(largest)[1] - bits)
    found = np.zeros(groups.shape, stored)
    found[some] = np.rint(part / unit) * unit
    return found.reshape(values.shape)


def rounded_loads(table: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The table of loads at steps as it is stored, with the precision of the same at samples."""
    return {
        **table,
        "modes": rounded(table["modes"], "float32", MODAL_BITS, 1),
        "land": rounded(table["land"], "float32", FORCE_BITS, 2),
        "force": rounded(table["force"], "float32", FORCE_BITS, 2),
    }


def sampled(
    name: str, unit: str, long_name: str, *dims: str, bits: int = 24, together: int = 0,
    sparse: bool = False, dtype: str = "float64", of_cage: bool = False,
) -> Variable:  # fmt: skip
    """A variable on the main grid, in single precision on disk if nothing else is said."""
    return Variable(name, (TIME, *dims), unit, long_name, dtype, bits, together, sparse, of_cage)


def _common() -> Iterator[Variable]:
    """What every run records."""
    whole: Any = {"bits": 53}
    cage: Any = {"of_cage": True}
    face: Any = {"dtype": "float32", **cage}
    modal: Any = {"bits": MODAL_BITS, "together": 1, **cage}
    yield sampled("inner_position", "m", "inner ring centre, ring frame", "axis")
    yield sampled("inner_velocity", "m/s", "velocity of the inner ring centre, ring frame", "axis")
    yield sampled("inner_angle", "rad", "angle turned by the inner ring", **whole)
    yield sampled("inner_speed", "rad/s", "angular speed of the inner ring", **whole)
    yield sampled(
        "inner_quaternion", "1", "orientation of the inner ring", "quaternion", together=1
    )
    yield sampled("outer_position", "m", "outer ring centre, ring frame", "axis")
    yield sampled("outer_velocity", "m/s", "velocity of the outer ring centre, ring frame", "axis")
    yield sampled(
        "outer_quaternion", "1", "orientation of the outer ring", "quaternion", together=1
    )
    yield sampled(
        "outer_force", "N", "force of all contacts on the outer ring, ring frame: what it hands on "
        "to its mount, but for its weight and inertia",
        "axis",
    )  # fmt: skip
    yield sampled(
        "outer_moment", "N m", "moment of these forces about the outer ring's centre", "axis",
        bits=MODAL_BITS, together=1,
    )  # fmt: skip
    yield sampled(
        "element_position", "m, m, rad", "centre of a rolling element (x, r, psi)",
        "element", "cyl", bits=38,  # psi grows
    )  # fmt: skip
    yield sampled(
        "element_velocity", "m/s", "velocity of an element's centre (axial, radial, tangential)",
        "element", "cyl",
    )  # fmt: skip
    yield sampled(
        "element_omega", "rad/s",
        "inertial angular velocity of an element in its non-spinning frame: its own axis, or axes "
        "at its azimuth",
        "element", "spin_axis",
    )  # fmt: skip
    yield sampled("cage_position", "m", "cage centre, ring frame", "axis", **cage)
    yield sampled("cage_velocity", "m/s", "velocity of the cage centre, ring frame", "axis", **cage)
    yield sampled(
        "cage_quaternion", "1", "orientation of the cage, scalar first", "quaternion",
        bits=53, **cage,
    )  # fmt: skip
    yield sampled(
        "cage_omega", "rad/s", "angular velocity of the cage, cage frame", "axis", **whole, **cage
    )
    yield sampled(
        "cage_acceleration", "m/s^2", "acceleration of the cage centre, cage frame", "axis", **cage
    )
    yield sampled(
        "cage_angular_acceleration", "rad/s^2", "angular acceleration of the cage, cage frame",
        "axis", **cage,
    )  # fmt: skip
    yield sampled("modal_coordinates", "m kg^0.5", "modal coordinates of the cage", "mode", **modal)
    yield sampled("modal_velocity", "m kg^0.5/s", "modal velocities of the cage", "mode", **modal)
    yield sampled(
        "modal_acceleration", "m kg^0.5/s^2", "modal accelerations of the cage", "mode", **modal
    )
    yield sampled("race_force", "N", "normal force of a race on an element", "element", "race")
    yield sampled(
        "spot_direction", "1",
        "unit direction from the centre of an element to its spot, ring frame; of those that have "
        "one",
        "spotted", "axis", together=1,
    )  # fmt: skip
    yield sampled(
        "race_traction", "N",
        "traction of a race on an element, along the rolling direction (psi)",
        "element", "race",
    )  # fmt: skip
    yield sampled(
        "race_slip", "m/s",
        "sliding speed of an element at a race, along the rolling direction (psi), in the middle "
        "of the contact",
        "element", "race",
    )  # fmt: skip
    yield sampled(
        "race_power", "W",
        "power of damping, friction and rolling resistance at all contacts with a race (losses "
        "< 0)",
        "race",
    )  # fmt: skip
    yield sampled(
        "ring_load", "N, N, N m",
        "force of an element on the race of a ring that bends, and its moment in tilt; zero at a "
        "rigid one",
        "element", "race", "bending",
    )  # fmt: skip
    yield sampled(
        "ring_deflection", "m, m, rad",
        "how far the race of a ring that bends lies from where its seat has it, beneath an "
        "element, without what the contact law counts",
        "element", "race", "bending",
    )  # fmt: skip
    yield sampled(
        "support_force", "N",
        "force of a support on the outer ring, inwards, one for every strip of an arc",
        "support",
    )  # fmt: skip
    yield sampled("pocket_force", "N", "normal force on a pocket face", "pocket", "face", **face)
    yield sampled(
        "pocket_peak", "N",
        "largest normal force on a pocket face since the sample before, at the solver's steps",
        "pocket", "face", **face,
    )  # fmt: skip
    yield sampled(
        "pocket_friction", "N", "friction force on a pocket face", "pocket", "face", **face
    )
    yield sampled(
        "station_force", "N", "force on the cage at a station of a pocket face (x, r, psi)",
        "pocket", "face", "station", "cyl", bits=FORCE_BITS, together=2, sparse=True, **face,
    )  # fmt: skip
    yield sampled(
        NEIGHBOURS, "N", "normal force of the next element, where two touch each other", "element"
    )
    yield sampled(
        "land_force", "N", "force of lands and shoulders on the cage, ring frame", "axis", **cage
    )
    yield sampled(
        "land_station_force", "N",
        "force of the guiding land on the cage at stations round it (r, psi); then of the other "
        "ring, where the cage may meet it",
        "land_station", "polar", bits=FORCE_BITS, together=2, **cage,
    )  # fmt: skip
    yield sampled("multiplier", "N or N m", "constraint force or torque", "constraint")
    yield sampled("energy", "J", "energy stored", "energy_kind", **whole)
    yield sampled(
        "work", "J", "work done on the bearing since the start (losses < 0)", "channel", **whole
    )
    for name, words in (
        ("outer_acceleration", "ring frame"),
        ("outer_acceleration_filtered", "low-pass filtered"),
    ):
        long_name = f"acceleration of the outer ring, {words}"
        yield Variable(name, (TIME_HF, "axis2"), "m/s^2", long_name, bits=24)


def own_variables(family: Any) -> OwnVariables:
    """What a bearing family records beside what all do; nothing if it has no motion."""
    found: OwnVariables = family.variables() if family.variables else OwnVariables(())
    return found


#: Every result variable by name, the common ones first; labels of dimensions that never change.
VARIABLES: Parts[Variable] = Parts(
    FAMILIES, lambda family: {v.name: v for v in own_variables(family).variables},
    what="result variable", common={v.name: v for v in _common()},
)  # fmt: skip
LABELS: Parts[tuple[str, ...]] = Parts(
    FAMILIES, lambda family: own_variables(family).labels, what="dimension", common=_LABELS
)


def run_dims() -> set[str]:
    """Dimensions whose labels a run gives, of whichever family."""
    return {*RUN_DIMS, *(d for f in FAMILIES.values() for d in own_variables(f).counted)}


def families_with(name: str) -> tuple[str, ...]:
    """Names of the families whose bearings have a variable: those that list it; else all with its
    dimensions."""
    listed = VARIABLES.owners(name)
    if listed:
        return listed
    owned = {member: own_variables(FAMILIES[member]).dims for member in FAMILIES}
    wanted = set(VARIABLES[name].dims) & set[str]().union(*owned.values())
    return tuple(member for member, dims in owned.items() if wanted <= dims)


def variables_of(family: str) -> list[str]:
    """Names of the variables that bearings of a family have."""
    return [name for name in VARIABLES if family in families_with(name)]


def variable(name: str) -> Variable:
    """The registered variable, or one sentence with the nearest name."""
    if name in VARIABLES:
        return VARIABLES[name]
    near = near_names(name, VARIABLES, 1)
    hint = f"; the nearest known name is {near[0]!r}" if near else ""
    raise InputError(f"There is no result variable {name!r}{hint}.", where="variable", value=name)


def whose(families: Sequence[str]) -> str:
    """Whose bearings have a thing, in words ("roller bearings"); "" for none or all."""
    if len(families) in (0, len(FAMILIES)):
        return ""
    words = dict.fromkeys(FAMILIES[name].element for name in families)
    return " and ".join(f"{word} bearings" for word in words)


PAGE = """# Result variables

What a run records: `run.dataset["NAME"]`, an xarray array with labels and units. Printed by
`flexcage variables`; forces act *on* the named body. Where each row of elements has a cage, what is
of a whole cage has the dimension `cage` behind its first one.
"""
_ON_GRID = {TIME: "", TIME_HF: "at the vibration rate"}


def listing(text: str = "") -> Listing:
    """Variables whose name or meaning holds the text, with dimensions, units and whose bearings
    have them. InputError if there are none."""
    wanted = text.lower()
    found = [v for v in VARIABLES.values() if wanted in v.name or wanted in v.long_name.lower()]
    if not found:
        variable(text)  # refuses it with the nearest name
    rows = []
    for v in found:
        notes = (v.long_name, whose(families_with(v.name)), _ON_GRID.get(v.dims[0], ""))
        rows.append((v.name, ", ".join(v.dims), v.unit, "; ".join(filter(None, notes))))
    return Listing("Result variables", ("variable", "dimensions", "unit", "meaning"), rows)


#: How variables that were registered from outside are computed, by name.
COMPUTED: dict[str, Compute] = {}


def register(
    new: Variable, compute: Compute, *, labels: Mapping[str, Sequence[str]] | None = None
) -> Variable:
    """Add a result variable: every later run computes, stores and labels it; returns it.

    ``compute(arrays, bearing)`` is called once a block of samples. ``arrays`` holds what the
    program itself records on the main grid, by name, in SI, time first (n, ...): the variables of
    this table whose first dimension is time, the modal ones if the cage is flexible.
    ``bearing.data.model`` holds the constant model. It returns the new variable's array, (n, ...)
    by its dimensions. ``labels`` names the entries of a dimension that no variable has yet.

    Raises InputError for a name that is taken, a first dimension other than time, or a dimension
    without labels.
    """
    check_free(VARIABLES, new.name, what=VARIABLES.what)
    if not new.dims or new.dims[0] != TIME:
        raise InputError(
            f"Result variable '{new.name}' has dimensions {new.dims}; the first must be '{TIME}'.",
            where=new.name,
        )
    labels = labels or {}
    for dim in new.dims[1:]:
        if (dim in LABELS or dim in run_dims()) == (dim in labels):
            has = "has labels already" if dim in labels else "needs labels"
            raise InputError(f"Dimension '{dim}' of '{new.name}' {has}.", where=new.name)
    for dim, names in labels.items():
        LABELS.add(dim, tuple(names))
    COMPUTED[new.name] = compute
    return VARIABLES.add(new.name, new)
