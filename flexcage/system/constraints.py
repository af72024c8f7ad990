"""Constraints beyond those of drive and load: on rings and cage, by any function.

A kind of constraint is a function of the signature

    rows(t, q, u, p, G, g, h)

that says of m scalar constraints at time t [s] what they miss: in place, g (m,), and in velocity, h
(m,), with G (m, 14) = dh/du. q (15,) and u (14,) are the coordinates and velocities of the rings
and the cage, at the places that the constants of ``layout`` name; p is the kind's vector of
parameters. Arrays to fill hold zeros; t may be a microsecond before the start. Of level "position",
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

from flexcage.core.errors import InputError
from flexcage.core.jit import LEAN, kernel, kernel_of, why_not_compiled
from flexcage.core.kernel_values import KernelType
from flexcage.core.registry import add, check_free
from flexcage.system import spec as specs
from flexcage.system.data import FIXED, MASS
from flexcage.system.layout import (
    CAGE,
    CAGE_TURN,
    INNER,
    INNER_TURN,
    MODES,
    Q_CAGE,
    Q_INNER,
    Q_MODES,
    Q_QUATERNION,
    REACTION_UNITS,
    Layout,
)  # fmt: skip
from flexcage.system.layout import CONSTRAINTS as REACTIONS
from flexcage.system.spec import Constraint

N_PARAMETERS = 10
OFF, VELOCITY, POSITION = 0, 1, 2  # levels; OFF while a start is brought to equilibrium
PROJECT, BORNE = -1, -2  # what ``holding.hold`` may be asked for beside its rows
LEVELS = {"velocity": VELOCITY, "position": POSITION}
UNITS = ("N", "N m")  # of multipliers
_ALIKE = 1e-9  # of normalised constraints: below it they hold the same
_NUDGE = np.array([1e-6, 5e-7])  # [m] away from a place without slopes
_BEYOND = 16  # rows more than a kind has labels for, in which it is caught writing

_F8, _VECTOR = types.float64, types.Array(types.float64, 1, "C")
_MATRIX = types.Array(types.float64, 2, "C")
ROWS = types.void(_F8, _VECTOR, _VECTOR, _VECTOR, _MATRIX, _VECTOR, _VECTOR)
ALL_ROWS = types.void(_F8, _VECTOR, _VECTOR, _MATRIX, _MATRIX, _VECTOR, _VECTOR)
ALL_ROWS_TYPE = KernelType(ALL_ROWS)
_ARGUMENTS = "t, q, u, p, G, g, h"


@kernel(ROWS)
def cage_speed(t, q, u, p, G, g, h):
    """p: speed [rad/s], share of the inner ring's."""
    h[0] = u[CAGE_TURN] - p[0] - p[1] * u[INNER_TURN]
    G[0, CAGE_TURN], G[0, INNER_TURN] = 1.0, -p[1]


@kernel(ROWS)
def cage_centre(t, q, u, p, G, g, h):
    """p: y, z [m]."""
    for k in range(2):
        g[k] = q[Q_CAGE + 1 + k] - p[k]
        h[k] = u[CAGE + 1 + k]
        G[k, CAGE + 1 + k] = 1.0


@kernel(ROWS)
def cage_tilt(t, q, u, p, G, g, h):
    """No parameters. The cage's axis a = A(q/|q|) e_x turns by da/dt = w_z A e_y - w_y A e_z with w
    in the cage's frame; its angles about y and z, -a_z and a_y where they are small, are held."""
    w, x = q[Q_QUATERNION], q[Q_QUATERNION + 1]
    y, z = q[Q_QUATERNION + 2], q[Q_QUATERNION + 3]
    of_unit = 1.0 / (w * w + x * x + y * y + z * z)
    g[0], g[1] = 2.0 * (w * y - x * z) * of_unit, 2.0 * (x * y + w * z) * of_unit
    a_yy, a_yz = 1.0 - 2.0 * (x * x + z * z) * of_unit, 2.0 * (y * z - w * x) * of_unit
    a_zy, a_zz = 2.0 * (y * z + w * x) * of_unit, 1.0 - 2.0 * (x * x + y * y) * of_unit
    G[0, CAGE_TURN + 1], G[0, CAGE_TURN + 2] = a_zz, -a_zy
    G[1, CAGE_TURN + 1], G[1, CAGE_TURN + 2] = -a_yz, a_yy
    for k in range(2):
        h[k] = G[k, CAGE_TURN + 1] * u[CAGE_TURN + 1] + G[k, CAGE_TURN + 2] * u[CAGE_TURN + 2]


PATH_Y, PATH_Z, PATH_RADIUS, PATH_SPEED, PATH_PHASE = range(5)  # its parameters


@kernel(ROWS)
def inner_path(t, q, u, p, G, g, h):
    """p: y, z, radius [m], speed [rad/s], phase [rad]."""
    azimuth = p[PATH_SPEED] * t + p[PATH_PHASE]
    c, s = p[PATH_RADIUS] * cos(azimuth), p[PATH_RADIUS] * sin(azimuth)
    g[0], g[1] = q[Q_INNER + 1] - p[PATH_Y] - c, q[Q_INNER + 2] - p[PATH_Z] - s
    h[0], h[1] = u[INNER + 1] + p[PATH_SPEED] * s, u[INNER + 2] - p[PATH_SPEED] * c
    for k in range(2):
        G[k, INNER + 1 + k] = 1.0


@kernel(ALL_ROWS)
def no_rows(t, q, u, p, G, g, h):
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
    ease: np.ndarray  # (14,) inverse masses and inertias; 0: drive, load or mount hold it
    G: np.ndarray  # (m, 14) dh/du at the point evaluated last
    g: np.ndarray  # (m,)
    h: np.ndarray  # (m,)
    pull: np.ndarray  # (m, 14 + n) accelerations that unit multipliers give
    S: np.ndarray  # (m, m) G times those, then its factors
    pivot: np.ndarray  # (m,)
    x: np.ndarray  # (m,)
    place: np.ndarray  # (2, 15) coordinates
    late: np.ndarray  # (2, m) h a little before and after
    spare: np.ndarray  # (m, 14) G and g there, which nobody asked for


def constraints_of(
    constraints: Sequence[Constraint], model: Any, layout: Layout
) -> tuple[Constraints, Any]:
    """The constraints' arrays, and their rows as one function of the type ``ALL_ROWS_TYPE``."""
    kinds = [KINDS[spec.type] for spec in constraints]
    m, z = len(layout.held), np.zeros
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
        np.array(level, float), p, _ease(model), z((m, MODES)), z(m), z(m),
        z((m, MODES + layout.modes)), z((m, m)), z(m, np.int64), z(m),
        z((2, Q_MODES)), z((2, m)), z((m, MODES)),
    )  # fmt: skip
    return data, _joined(tuple((kind.rows, len(kind.labels)) for kind in kinds))


def _ease(model: Any) -> np.ndarray:
    """Inverse mass or inertia (14,) of every motion of rings and cage, 0 where it is held."""
    bodies, cage = model.bodies, model.cage
    axial, skew, tilt, centre = bodies.free
    mass, spin, across = bodies.ring
    inner = [axial * centre / mass, centre / mass, centre / mass]
    inner += [bodies.by_shaft / spin, skew / across, tilt / across]
    outer = 0.0 if bodies.support == FIXED else 1.0 / bodies.outer[MASS]
    inertia = np.trace(cage.G0) - np.diag(cage.G0)
    return np.array([*inner, outer, outer, *[1.0 / cage.mass] * 3, *(1.0 / inertia)])


def check_independent(
    constraints: Sequence[Constraint], data: Constraints, q: np.ndarray, u: np.ndarray
) -> None:
    """Raise InputError for a constraint on what drive, load, mount or those before it hold, where
    rings and cage are at q (15,) and move as u (14,).

    A place at which a constraint has no slope, as the middle of a circle has none towards it, is
    left by a nudge of the centres in q.
    """
    basis = np.zeros((0, MODES))
    for i, spec in enumerate(constraints):
        G = _slopes(spec, data.p[i], q, u)
        if not _has_slope(G):
            for centre in (Q_INNER, Q_CAGE):
                q[centre + 1 : centre + 3] += _NUDGE
            G = _slopes(spec, data.p[i], q, u)
        if not _has_slope(G):
            raise InputError(
                f"constraints.{i} ({spec.type}) has no slope G at the start, or one that is not a "
                "number: does every label have its row?",
                where=f"constraints.{i}", value=spec.type,
            )  # fmt: skip
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


def _slopes(spec: Constraint, p: np.ndarray, q: np.ndarray, u: np.ndarray) -> np.ndarray:
    """G (m, 14) of one constraint; InputError if it fills more rows than it has labels."""
    kind = KINDS[spec.type]
    m = len(kind.labels)
    G, g, h = np.zeros((m + _BEYOND, MODES)), np.zeros(m + _BEYOND), np.zeros(m + _BEYOND)
    kind.rows(0.0, q, u, p, G, g, h)
    if G[m:].any() or g[m:].any() or h[m:].any():
        raise InputError(
            f"Constraint '{spec.type}' fills more rows than the {m} that its labels name; register "
            "it with a label for each.",
            where=spec.type,
        )
    return G[:m]


def _has_slope(G: np.ndarray) -> bool:
    return bool(np.isfinite(G).all() and np.all(np.any(G, axis=1)))


def _joined(kinds: tuple[tuple[Any, int], ...]) -> Any:
    """The rows of all constraints, one after the other, as one compiled function."""
    if not kinds:
        return no_rows
    (first, m), rest = kinds[0], _joined(kinds[1:])

    def rows(t, q, u, p, G, g, h):
        first(t, q, u, p[0], G[:m], g[:m], h[:m])
        rest(t, q, u, p[1:], G[m:], g[m:], h[m:])

    return numba.njit(ALL_ROWS, **{**LEAN, "cache": False})(rows)
