"""Constraints beyond those of drive and load: on any body, by any function.

A kind of constraint is a function of the signature

    rows(t, y, at, p, G, g, h)

that says of m scalar constraints at time t [s] what they miss: in place, g (m,), and in velocity, h
(m,), with G (m, n) = dh/du. y holds all coordinates and velocities, and ``at``
(``layout.Places``) says where: those of the cage begin at y[at.cage_q] and y[at.cage_u], and its
velocities have the columns of G from at.cage_b on; p is the kind's vector of parameters. Arrays to
fill hold zeros; t may be a microsecond before the start. Of level "position",
a holonomic g(q, t), h is dg/dt; a kind of level "velocity" is a h(q, u, t) and leaves g alone. Both
enter the equations as index 2, stabilised where there is a place to keep: G^T lambda acts on the
bodies, and lambda is the result ``multiplier``.
``register_constraint`` adds a kind from any module.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from math import cos, sin
from numbers import Real
from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types

from flexcage.bodies.floating_frame import BodyData
from flexcage.core.errors import InputError
from flexcage.core.jit import WITHOUT_NRT, kernel, kernel_of, why_not_compiled
from flexcage.core.kernel_values import KernelType
from flexcage.core.registry import add, check_free
from flexcage.core.vectors import RIGID, TURN, xyz
from flexcage.system import spec as specs
from flexcage.system.data import AXIAL, MASS, TRANSVERSE
from flexcage.system.layout import CONSTRAINTS as REACTIONS
from flexcage.system.layout import QUATERNION, REACTION_UNITS, Layout, Places
from flexcage.system.own_rows import check_rows
from flexcage.system.spec import Constraint

N_PARAMETERS = 10
OFF, VELOCITY, POSITION = 0, 1, 2  # levels; OFF while a start is brought to equilibrium
PROJECT, BORNE = -1, -2  # what ``apply_constraints`` may be asked for beside its rows
LEVELS = {"velocity": VELOCITY, "position": POSITION}
UNITS = ("N", "N m")  # of multipliers
_ALIKE = 1e-9  # of normalised constraints: below it they hold the same
_NUDGE = np.array([1e-6, 5e-7])  # [m] away from a place without slopes
_BEYOND = 16  # rows more than a kind has labels for, in which it is caught writing

_F8, _VECTOR = types.float64, types.Array(types.float64, 1, "C")
_MATRIX = types.Array(types.float64, 2, "C")
_PLACES = types.NamedUniTuple(types.int64, len(Places._fields), Places)
ROWS = types.void(_F8, _VECTOR, _PLACES, _VECTOR, _MATRIX, _VECTOR, _VECTOR)
ALL_ROWS = types.void(_F8, _VECTOR, _PLACES, _MATRIX, _MATRIX, _VECTOR, _VECTOR)
ALL_ROWS_TYPE = KernelType(ALL_ROWS)
_ARGUMENTS = "t, y, at, p, G, g, h"


@kernel(ROWS)
def cage_speed(t, y, at, p, G, g, h):
    """p: speed [rad/s], share of the inner ring's."""
    h[0] = y[at.cage_u + TURN] - p[0] - p[1] * y[at.inner_u + TURN]
    G[0, at.cage_b + TURN], G[0, at.inner_b + TURN] = 1.0, -p[1]


@kernel(ROWS)
def cage_centre(t, y, at, p, G, g, h):
    """p: y, z [m]."""
    for k in range(2):
        g[k] = y[at.cage_q + 1 + k] - p[k]
        h[k] = y[at.cage_u + 1 + k]
        G[k, at.cage_b + 1 + k] = 1.0


@kernel(ROWS)
def cage_tilt(t, y, at, p, G, g, h):
    """No parameters. The cage's axis a = A(q/|q|) e_x turns by da/dt = w_z A e_y - w_y A e_z with w
    in the cage's frame; its angles about y and z, -a_z and a_y where they are small, are held."""
    q, u, b = y[at.cage_q + QUATERNION :], y[at.cage_u + TURN :], at.cage_b + TURN
    w, (i, j, k) = q[0], xyz(q[1:])
    of_unit = 1.0 / (w * w + i * i + j * j + k * k)
    g[0], g[1] = 2.0 * (w * j - i * k) * of_unit, 2.0 * (i * j + w * k) * of_unit
    a_yy, a_yz = 1.0 - 2.0 * (i * i + k * k) * of_unit, 2.0 * (j * k - w * i) * of_unit
    a_zy, a_zz = 2.0 * (j * k + w * i) * of_unit, 1.0 - 2.0 * (i * i + j * j) * of_unit
    G[0, b + 1], G[0, b + 2] = a_zz, -a_zy
    G[1, b + 1], G[1, b + 2] = -a_yz, a_yy
    for row in range(2):
        h[row] = G[row, b + 1] * u[1] + G[row, b + 2] * u[2]


PATH_Y, PATH_Z, PATH_RADIUS, PATH_SPEED, PATH_PHASE = range(5)  # its parameters


@kernel(ROWS)
def inner_path(t, y, at, p, G, g, h):
    """p: y, z, radius [m], speed [rad/s], phase [rad]."""
    azimuth = p[PATH_SPEED] * t + p[PATH_PHASE]
    c, s = p[PATH_RADIUS] * cos(azimuth), p[PATH_RADIUS] * sin(azimuth)
    q, u = at.inner_q, at.inner_u
    g[0], g[1] = y[q + 1] - p[PATH_Y] - c, y[q + 2] - p[PATH_Z] - s
    h[0], h[1] = y[u + 1] + p[PATH_SPEED] * s, y[u + 2] - p[PATH_SPEED] * c
    for k in range(2):
        G[k, at.inner_b + 1 + k] = 1.0


@kernel(ALL_ROWS)
def no_rows(t, y, at, p, G, g, h):
    """Nothing is held beyond drive and load."""


@dataclass(frozen=True)
class ConstraintKind:
    """Rows of a kind, compiled; which level; names of its scalar constraints and the unit of their
    multipliers; its parameters."""

    rows: Any
    level: str
    labels: tuple[str, ...]
    unit: str
    parameters: Callable[[Any], Sequence[float]]

    def named(self, name: str) -> tuple[str, ...]:
        return tuple(f"{name}_{label}" if label else name for label in self.labels)


def _values(spec: Constraint) -> tuple[float, ...]:
    """The values of a spec, in the order of its fields."""
    return tuple(getattr(spec, f.name) for f in fields(spec) if f.name != "type")


KINDS: dict[str, ConstraintKind] = {
    "cage_speed": ConstraintKind(cage_speed, "velocity", ("",), "N m", _values),
    "cage_centre": ConstraintKind(cage_centre, "position", ("y", "z"), "N", _values),
    "cage_tilt": ConstraintKind(cage_tilt, "position", ("y", "z"), "N m", _values),
    "inner_path": ConstraintKind(inner_path, "position", ("y", "z"), "N", _values),
}


def register_constraint(
    name: str,
    rows: Callable[..., None],
    *,
    level: str,
    spec: type[Constraint] | None = None,
    labels: Sequence[str] = ("",),
    unit: str = "N",
    parameters: Callable[[Any], Sequence[float]] | None = None,
) -> None:
    """Add a kind of constraint: ``[[constraints]]`` with ``type = "name"`` then asks for it.

    ``rows`` is a function of the signature above, in plain Python that is compiled here; ``level``
    is "position" or "velocity"; ``labels`` names its scalar constraints, one for every row that it
    fills ("" for a single one), and ``unit`` is that of their multipliers: "N" where h is a
    velocity [m/s], "N m" where it is an angular one [rad/s]. ``spec``, if it has values of its own,
    is a frozen dataclass derived from ``Constraint`` whose fields carry their units and whose
    ``type`` defaults to ``name``. ``parameters(spec)`` gives p, at most ``N_PARAMETERS`` numbers;
    without it p holds the spec's values in their order.

    Raises InputError for a name that is taken, another level or unit, labels that are none, a
    wrong spec, or rows that cannot be compiled.
    """
    check_free(KINDS, name, what="kind of constraint")
    if level not in LEVELS:
        raise InputError(
            f"The level of constraint '{name}' is {level!r}, but must be 'position' or 'velocity'.",
            where=name, value=level,
        )  # fmt: skip
    if unit not in UNITS:
        raise InputError(
            f"The unit of constraint '{name}' is {unit!r}, but must be 'N' or 'N m'.",
            where=name, value=unit,
        )  # fmt: skip
    words = not isinstance(labels, str) and all(isinstance(label, str) for label in labels)
    if not (words and len(labels) > 0 and len(set(labels)) == len(labels)):
        raise InputError(
            f"The labels of constraint '{name}' are {labels!r}, but must be texts that differ, one "
            'for every row, as in ("y", "z").',
            where=name, value=labels,
        )  # fmt: skip
    own: Any = spec or _spec_of(name)
    derived = isinstance(own, type) and issubclass(own, Constraint)
    if not derived or own.__dataclass_fields__["type"].default != name:
        raise InputError(
            f"The spec of constraint '{name}' must be a dataclass derived from Constraint whose "
            f"type defaults to '{name}'.",
            where=name, value=own,
        )  # fmt: skip
    try:
        compiled = kernel_of(getattr(rows, "py_func", rows), ROWS)
    except (numba.errors.NumbaError, TypeError) as exc:
        raise InputError(
            f"The rows of constraint '{name}' cannot be compiled as a function "
            f"({_ARGUMENTS}): {why_not_compiled(exc)}.",
            where=name,
        ) from exc
    kind = ConstraintKind(compiled, level, tuple(labels), unit, parameters or _values)
    add(KINDS, name, kind, what="kind of constraint", source=rows)
    specs.CONSTRAINTS[name] = own


def _spec_of(name: str) -> type[Constraint]:
    """A spec without values."""
    from dataclasses import make_dataclass

    from flexcage.core.spec import option

    kind = option(name, doc="kind of constraint", choices=specs.CONSTRAINTS)
    return make_dataclass(
        "".join(word.capitalize() for word in name.split("_")), [("type", str, kind)],
        bases=(Constraint,), frozen=True, kw_only=True,
    )  # fmt: skip


def names_of(constraints: Sequence[Constraint]) -> tuple[str, ...]:
    """Names of all scalar constraints, numbered where a kind comes twice.

    Raises InputError where two have one name.
    """
    found: list[str] = []
    for i, spec in enumerate(constraints):
        before = sum(other.type == spec.type for other in constraints[:i])
        name = f"{spec.type}_{before + 1}" if before else spec.type
        for own in KINDS[spec.type].named(name):
            if own in (*REACTIONS, *found):
                raise InputError(
                    f"constraints.{i} is called '{own}' in results, as another multiplier is; "
                    "register its kind under another name.",
                    where=f"constraints.{i}", value=own,
                )  # fmt: skip
            found.append(own)
    return tuple(found)


def units_of(constraints: Sequence[Constraint]) -> tuple[str, ...]:
    """Units of the multipliers of all scalar constraints, those of drive and load first."""
    further = [KINDS[spec.type].unit for spec in constraints for _ in KINDS[spec.type].labels]
    return (*REACTION_UNITS, *further)


class Constraints(NamedTuple):
    """What the kernels know of m scalar constraints of k specs, and their workspaces."""

    level: np.ndarray  # (m,) OFF, VELOCITY or POSITION
    p: np.ndarray  # (k, N_PARAMETERS)
    ease: np.ndarray  # (n,) inverse masses and inertias; 0: drive, load or mount hold it
    G: np.ndarray  # (m, n) dh/du at the point evaluated last, n velocities of bodies
    g: np.ndarray  # (m,)
    h: np.ndarray  # (m,)
    pull: np.ndarray  # (m, n) accelerations that unit multipliers give
    S: np.ndarray  # (m, m) G times those, then its factors
    pivot: np.ndarray  # (m,)
    x: np.ndarray  # (m,)
    place: np.ndarray  # (size,) y a little before and after
    late: np.ndarray  # (2, m) h a little before and after
    spare: np.ndarray  # (m, n) G and g there, which nobody asked for


def constraints_of(
    constraints: Sequence[Constraint], model: Any, layout: Layout
) -> tuple[Constraints, Any]:
    """The constraints' arrays, and their rows as one function of the type ``ALL_ROWS_TYPE``."""
    kinds = [KINDS[spec.type] for spec in constraints]
    m, n, z = len(layout.held), layout.places.border, np.zeros
    p = z((len(kinds), N_PARAMETERS))
    for i, (kind, spec) in enumerate(zip(kinds, constraints, strict=True)):
        values = kind.parameters(spec)
        if len(values) > N_PARAMETERS or not all(isinstance(v, Real) for v in values):
            raise InputError(
                f"The parameters of constraint '{spec.type}' are {tuple(values)}, but must be "
                f"numbers, at most {N_PARAMETERS}.",
                where=f"constraints.{i}", value=values,
            )  # fmt: skip
        p[i, : len(values)] = values
    level = [LEVELS[kind.level] for kind in kinds for _ in kind.labels]
    data = Constraints(
        np.array(level, float), p, _ease(model, layout), z((m, n)), z(m), z(m), z((m, n)),
        z((m, m)), z(m, np.int64), z(m), z(layout.size), z((2, m)), z((m, n)),
    )  # fmt: skip
    return data, _joined(tuple((kind.rows, len(kind.labels)) for kind in kinds))


def _ease(model: Any, layout: Layout) -> np.ndarray:
    """Inverse mass or inertia (n,) of every motion of the bodies, 0 where it is held."""
    ease = np.zeros(layout.places.border)
    bodies = layout.border(ease)
    for name in ("inner", "outer"):
        ring = getattr(model, f"{name}_ring")
        free = ring.free * (np.arange(len(ring.free)) > 2) if ring.stands else ring.free
        bodies[name][:] = free / ring.inertia[[MASS, MASS, MASS, AXIAL, TRANSVERSE, TRANSVERSE]]
        bodies[f"{name}_modes"][:] = 1.0  # they have unit mass
    if layout.has_cage:
        cage: BodyData = model.cage
        inertia = np.trace(cage.G0) - np.diag(cage.G0)
        bodies["cage"][:], bodies["omega"][:] = 1.0 / cage.mass, 1.0 / inertia
        bodies["modes"][:] = 1.0 / np.diag(cage.mff)
    return ease


def check_independent(
    constraints: Sequence[Constraint], data: Constraints, layout: Layout, y: np.ndarray
) -> None:
    """Raise InputError for a constraint on what drive, load, mount or those before it hold, where
    bodies are and move as y has it.

    A place at which a constraint has no slope, as the middle of a circle has none towards it, is
    left by a nudge of the centres in y.
    """
    basis = np.zeros((0, layout.places.border))
    for i, spec in enumerate(constraints):
        G = _slopes(spec, data.p[i], layout.places, y)
        if not _has_slope(G):
            for body in layout.bodies:
                if body.name != "outer":
                    layout.q(y)[body.name][..., 1:3] += _NUDGE
            G = _slopes(spec, data.p[i], layout.places, y)
        if not _has_slope(G):
            raise InputError(
                f"constraints.{i} ({spec.type}) has no slope G at the start, or one that is not a "
                "number: does every label have its row?",
                where=f"constraints.{i}", value=spec.type,
            )  # fmt: skip
        if layout.cages > 1 and G[:, layout.places.cage_b :].any():
            raise InputError(
                f"constraints.{i} ({spec.type}) holds the cage, but each row has one (cage.rows is "
                "'each'); leave it out, or give both rows one cage.",
                where=f"constraints.{i}", value=spec.type,
            )  # fmt: skip
        given = len(KINDS[spec.type].parameters(spec))
        check_rows(KINDS[spec.type], spec.type, data.p[i, :given], layout.places, y)
        for row in G * np.sqrt(data.ease):
            size, left = np.linalg.norm(row), row - basis.T @ (basis @ row)
            if not np.linalg.norm(left) > _ALIKE * size:
                by = "another constraint holds" if size > 0.0 else "drive, load or mount hold"
                raise InputError(
                    f"constraints.{i} ({spec.type}) is on what {by} already; leave one of them "
                    "out.",
                    where=f"constraints.{i}", value=spec.type,
                )  # fmt: skip
            basis = np.vstack([basis, left / np.linalg.norm(left)])


def _slopes(spec: Constraint, p: np.ndarray, at: Places, y: np.ndarray) -> np.ndarray:
    """G (m, n) of one constraint; InputError if it fills more rows than it has labels, or holds a
    cage that is not there."""
    kind = KINDS[spec.type]
    m, beyond = len(kind.labels), RIGID if at.cages == 0 else 0
    G, g, h = np.zeros((m + _BEYOND, at.border + beyond)), *np.zeros((2, m + _BEYOND))
    kind.rows(0.0, y, at, p, G, g, h)
    if G[:, at.border :].any():
        raise InputError(
            f"Constraint '{spec.type}' holds the cage, but the bearing has none; leave it out, or "
            "give a cage.",
            where=spec.type,
        )
    if G[m:].any() or g[m:].any() or h[m:].any():
        raise InputError(
            f"Constraint '{spec.type}' fills more rows than the {m} that its labels name; register "
            "it with a label for each.",
            where=spec.type,
        )
    return G[:m, : at.border]


def _has_slope(G: np.ndarray) -> bool:
    return bool(np.isfinite(G).all() and np.all(np.any(G, axis=1)))


def _joined(kinds: tuple[tuple[Any, int], ...]) -> Any:
    """The rows of all constraints, one after the other, as one compiled function."""
    if not kinds:
        return no_rows
    (first, m), rest = kinds[0], _joined(kinds[1:])

    def rows(t, y, at, p, G, g, h):
        first(t, y, at, p[0], G[:m], g[:m], h[:m])
        rest(t, y, at, p[1:], G[m:], g[m:], h[m:])

    return numba.njit(ALL_ROWS, **{**WITHOUT_NRT, "cache": False})(rows)
