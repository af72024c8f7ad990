"""The one table of result variables: dimensions, unit, long name, type and precision.

The store allocates from it, the dataset is labelled from it, and documentation prints it.
A new output is one more line here and one more array handed to ``write_block``; from outside, a
call of ``register`` with the function that computes it.
Forces act *on* the named body. Frames: "ring" is the fixed frame (x: bearing axis, y towards
roller 0 at the start); "cyl" is (x, r, psi) at the element's own azimuth.

Precision. Energies, work, and orientation and speed of inner ring and cage are kept as computed,
positions of elements to 38 bits (an angle grows without bound), all else in single precision, 24
bits. Values that mean something only together are rounded together, to a share of the largest of
them at that instant: quaternions to 6e-8, modal values and the two moments of a race to 1e-6;
forces of slices, points and stations of a face, and residual coordinates of a pocket, to 3e-5.
Runs in memory are not rounded, and nothing that a run is resumed from is.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.listing import Listing
from flexcage.core.registry import add, check_free
from flexcage.modes.basis import FACES

if TYPE_CHECKING:
    from flexcage.system.problem import Bearing

    Compute = Callable[[Mapping[str, np.ndarray], Bearing], np.ndarray]

TIME = "time"
TIME_HF = "time_hf"

#: Dimensions whose labels never change. Others (roller, mode, slice ...) get theirs from a run.
_labels: dict[str, tuple[str, ...]] = {
    "axis": ("x", "y", "z"),
    "axis2": ("y", "z"),
    "cyl": ("x", "r", "psi"),
    "polar": ("r", "psi"),
    "tilt": ("skew", "tilt"),
    "spin_axis": ("axial", "radial", "tangential"),
    "quaternion": ("w", "x", "y", "z"),
    "race": ("inner", "outer"),
    "moment": ("tilt", "skew"),
    "face": FACES,
    "crossbeam_face": FACES[:2],
    "side_face": FACES[2:],
    "rib": ("+x", "-x"),
    "direction": ("rolling", "across"),
}
LABELS: Mapping[str, tuple[str, ...]] = MappingProxyType(_labels)

#: Dimensions whose labels a run gives.
RUN_DIMS = (
    "roller", "ball", "pocket", "mode", "slice", "end_point", "station", "residual", "constraint",
    "energy_kind", "channel", "land_station",
)  # fmt: skip
ENERGIES = ("kinetic", "strain", "contact", "mount")  # labels of energy_kind


@dataclass(frozen=True)
class Variable:
    """One result: its dimensions (time first), unit, what it is, and how it is stored.

    ``dtype`` is its type in datasets. On disk it has ``bits`` significant bits of the largest of
    each group of values: those along its last ``together`` dimensions, or each alone.
    """

    name: str
    dims: tuple[str, ...]
    unit: str
    long_name: str
    dtype: str = "float64"
    bits: int = 53
    together: int = 0

    @property
    def stored(self) -> str:
        """Its type on disk."""
        return "float32" if self.bits <= 24 else "float64"

    @property
    def sparse(self) -> bool:
        """Whether most values are zero: then zeros stand together, else the values of one place."""
        return bool(_FINE & set(self.dims))

    def rounded(self, values: np.ndarray) -> np.ndarray:
        """Values as they are stored, in the type that they have on disk."""
        return rounded(values, self.stored, self.bits, self.together)

    @property
    def attrs(self) -> dict[str, str]:
        return {"units": self.unit, "long_name": self.long_name}

    @property
    def of(self) -> str:
        """Rolling elements ("roller", "ball") whose bearings have it; "": all bearings."""
        own = (one for one, dims in _OWN_DIMS.items() if dims & set(self.dims))
        return next(own, "")


#: Dimensions that only runs with one kind of rolling elements have.
_OWN_DIMS = {
    "ball": {"ball"},
    "roller": {"roller", "slice", "residual", "rib", "crossbeam_face", "side_face"},
}


_FINE = {"slice", "end_point", "station", "residual"}  # dimensions within a pocket
_WHOLE = ("inner_angle", "inner_speed", "cage_quaternion", "cage_omega", "energy", "work")
_LONG = ("roller_position", "ball_position")  # psi grows
_FORCES, _MODAL = 15, 20  # bits of values that are rounded together


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
        "modes": rounded(table["modes"], "float32", _MODAL, 1),
        "land": rounded(table["land"], "float32", _FORCES, 2),
        "force": rounded(table["force"], "float32", _FORCES, 2),
    }


def _precision(name: str, dims: tuple[str, ...]) -> tuple[int, int]:
    """Bits, and how many of the last dimensions are rounded together."""
    if name in _WHOLE:
        return 53, 0
    if name in _LONG:
        return 38, 0
    if "quaternion" in dims:
        return 24, 1
    if {"slice", "end_point", "residual"} & set(dims):
        return _FORCES, 1
    if {"station", "land_station"} & set(dims):
        return _FORCES, 2
    return (_MODAL, 1) if {"mode", "moment"} & set(dims) else (24, 0)


def _variables() -> list[Variable]:
    def on(*dims: str) -> tuple[str, ...]:
        return (TIME, *dims)

    def row(name: str, dims: tuple[str, ...], unit: str, long_name: str) -> Variable:
        small = bool({"station", "face", "crossbeam_face", "side_face"} & set(dims))
        kind = "float32" if small else "float64"
        return Variable(name, dims, unit, long_name, kind, *_precision(name, dims))

    body, roller, ball, pocket = "axis", "roller", "ball", "pocket"
    return [
        row("inner_position", on(body), "m", "inner ring centre, ring frame"),
        row("inner_velocity", on(body), "m/s", "velocity of the inner ring centre, ring frame"),
        row("inner_angle", on(), "rad", "angle turned by the inner ring"),
        row("inner_speed", on(), "rad/s", "angular speed of the inner ring"),
        row("inner_quaternion", on("quaternion"), "1", "orientation of the inner ring"),
        row("outer_position", on(body), "m", "outer ring centre, ring frame"),
        row("outer_velocity", on(body), "m/s", "velocity of the outer ring centre, ring frame"),
        row("roller_position", on(roller, "cyl"), "m, m, rad", "roller centre (x, r, psi)"),
        row(
            "roller_velocity",
            on(roller, "cyl"),
            "m/s",
            "velocity of the roller centre (axial, radial, tangential)",
        ),
        row(
            "roller_quaternion",
            on(roller, "quaternion"),
            "1",
            "orientation of the spinning roller, ring frame, scalar first",
        ),
        row("roller_tilt", on(roller, "tilt"), "rad", "skew and tilt of the roller's axis"),
        row(
            "roller_omega",
            on(roller, "spin_axis"),
            "rad/s",
            "inertial angular velocity of the roller in its non-spinning frame (0: axial spin)",
        ),
        row("cage_position", on(body), "m", "cage centre, ring frame"),
        row("cage_velocity", on(body), "m/s", "velocity of the cage centre, ring frame"),
        row("cage_quaternion", on("quaternion"), "1", "orientation of the cage, scalar first"),
        row("cage_omega", on(body), "rad/s", "angular velocity of the cage, cage frame"),
        row("cage_acceleration", on(body), "m/s^2", "acceleration of the cage centre, cage frame"),
        row(
            "cage_angular_acceleration",
            on(body),
            "rad/s^2",
            "angular acceleration of the cage, cage frame",
        ),
        row("modal_coordinates", on("mode"), "m kg^0.5", "modal coordinates of the cage"),
        row("modal_velocity", on("mode"), "m kg^0.5/s", "modal velocities of the cage"),
        row("modal_acceleration", on("mode"), "m kg^0.5/s^2", "modal accelerations of the cage"),
        row("race_force", on(roller, "race"), "N", "normal force of a race on a roller"),
        row("race_traction", on(roller, "race"), "N", "traction of a race on a roller, along psi"),
        row("race_moment", on(roller, "race", "moment"), "N m", "moment of a race on a roller"),
        row("race_slip", on(roller, "race"), "m/s", "sliding speed at a race, roller mid-length"),
        row("ball_position", on(ball, "cyl"), "m, m, rad", "ball centre (x, r, psi)"),
        row(
            "ball_velocity",
            on(ball, "cyl"),
            "m/s",
            "velocity of the ball centre (axial, radial, tangential)",
        ),
        row(
            "ball_omega",
            on(ball, "cyl"),
            "rad/s",
            "inertial angular velocity of the ball, about the axes at its azimuth",
        ),
        row("contact_force", on(ball, "race"), "N", "normal force of a race on a ball"),
        row(
            "contact_angle",
            on(ball, "race"),
            "rad",
            "angle of the line from a groove's centre through the ball's",
        ),
        row(
            "contact_traction",
            on(ball, "race", "direction"),
            "N",
            "traction of a race on a ball, along the rolling direction and across it",
        ),
        row(
            "contact_slip",
            on(ball, "race"),
            "m/s",
            "sliding speed along the rolling direction, in the middle of the contact",
        ),
        row(
            "pocket_direction",
            on(ball),
            "rad",
            "where a ball stands in its pocket, from +psi towards +x",
        ),
        row("pocket_force", on(pocket, "face"), "N", "normal force on a pocket face"),
        row(
            "pocket_peak",
            on(pocket, "face"),
            "N",
            "largest normal force on a pocket face since the sample before, at the solver's steps",
        ),
        row("pocket_friction", on(pocket, "face"), "N", "friction force on a pocket face"),
        row(
            "pocket_slice_force",
            on(pocket, "crossbeam_face", "slice"),
            "N",
            "normal force of a slice on a crossbeam face",
        ),
        row(
            "pocket_slice_friction",
            on(pocket, "crossbeam_face", "slice"),
            "N",
            "friction force of a slice on a crossbeam face",
        ),
        row(
            "pocket_point_force",
            on(pocket, "side_face", "end_point"),
            "N",
            "normal force of a point of a roller's end on a side-beam face",
        ),
        row(
            "pocket_point_friction",
            on(pocket, "side_face", "end_point"),
            "N",
            "friction force of a point of a roller's end on a side-beam face",
        ),
        row(
            "station_force",
            on(pocket, "face", "station", "cyl"),
            "N",
            "force on the cage at a station of a pocket face (x, r, psi)",
        ),
        row(
            "residual_coordinates",
            on(pocket, "residual"),
            "1",
            "quasi-static residual coordinates of a pocket's faces",
        ),
        row("rib_force", on(roller, "rib"), "N", "normal force of a rib on a roller end"),
        row("land_force", on(body), "N", "force of the guiding land on the cage, ring frame"),
        row(
            "land_station_force",
            on("land_station", "polar"),
            "N",
            "force of the guiding land on the cage at stations round it (r, psi)",
        ),
        row("multiplier", on("constraint"), "N or N m", "constraint force or torque"),
        row("energy", on("energy_kind"), "J", "energy stored"),
        row("work", on("channel"), "J", "work done on the bearing since the start (losses < 0)"),
        row(
            "outer_acceleration",
            (TIME_HF, "axis2"),
            "m/s^2",
            "acceleration of the outer ring, ring frame",
        ),
        row(
            "outer_acceleration_filtered",
            (TIME_HF, "axis2"),
            "m/s^2",
            "acceleration of the outer ring, low-pass filtered",
        ),
    ]


_table = {v.name: v for v in _variables()}

#: Every result variable by name, a read-only view.
VARIABLES: Mapping[str, Variable] = MappingProxyType(_table)


def variables_of(element: str) -> list[str]:
    """Names of the variables of bearings with these rolling elements ("roller", "ball")."""
    return [name for name, v in VARIABLES.items() if v.of in ("", element)]


def variable(name: str) -> Variable:
    """The registered variable, or one sentence with the nearest name."""
    if name in VARIABLES:
        return VARIABLES[name]
    near = difflib.get_close_matches(name, VARIABLES, n=1)
    hint = f"; the nearest known name is {near[0]!r}" if near else ""
    raise InputError(f"There is no result variable {name!r}{hint}.", where="variable", value=name)


PAGE = """# Result variables

What a run records: `run.dataset["NAME"]`, an xarray array with labels and units. Printed by
`flexcage variables`; forces act *on* the named body.
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
        notes = (v.long_name, v.of and f"{v.of} bearings", _ON_GRID.get(v.dims[0], ""))
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
    check_free(_table, new.name, what="result variable")
    if not new.dims or new.dims[0] != TIME:
        raise InputError(
            f"Result variable '{new.name}' has dimensions {new.dims}; the first must be '{TIME}'.",
            where=new.name,
        )
    labels = labels or {}
    for dim in new.dims[1:]:
        if (dim in LABELS or dim in RUN_DIMS) == (dim in labels):
            has = "has labels already" if dim in labels else "needs labels"
            raise InputError(f"Dimension '{dim}' of '{new.name}' {has}.", where=new.name)
    _labels.update({dim: tuple(names) for dim, names in labels.items()})
    COMPUTED[new.name] = compute
    return add(_table, new.name, new, what="result variable")
