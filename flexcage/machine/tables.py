"""A bearing's stiffness over speed and load, as a table and as bearing elements of ROSS."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.case import StaticCase
from flexcage.core.binding import expect
from flexcage.core.errors import EnvironmentLacks, FlexcageError, InputError
from flexcage.core.units import parse
from flexcage.core.writing import write_text
from flexcage.static import solve_static

_AXES = ("x", "y", "z", "ty", "tz")
#: Rows of the stiffness (x, y, z, tilts) that are ROSS's x, y, z: it turns its rotor about z.
ROSS = {"x": 1, "y": 2, "z": 0}
COEFFICIENTS = ("kxx", "kxy", "kyx", "kyy", "kzz")


@dataclass(frozen=True, eq=False)
class StiffnessTable:
    """Stiffness (r, a, s, 5, 5) [N/m, N/rad, N m/rad] over radial and axial loads [N] and speeds
    [rad/s]; NaN where no static solution was found, and ``failed`` says why, by place."""

    title: str
    radial: np.ndarray
    axial: np.ndarray
    speed: np.ndarray
    stiffness: np.ndarray
    failed: Mapping[tuple[int, int, int], str]

    def at(self, *, radial: float | None = None, axial: float | None = None) -> np.ndarray:
        """Stiffness (s, 5, 5) over the speeds at loads [N], linear between those of the table;
        the only load there is, if none is given. InputError for loads outside of it."""
        found = self.stiffness
        for name, value in (("radial", radial), ("axial", axial)):
            found = _between(getattr(self, name), found, value, name)
        if not np.isfinite(found).all():
            reason = next(iter(self.failed.values()))
            raise InputError(
                f"The table has no stiffness at these loads and every speed: {reason}",
                where="radial",
            )
        return found

    def ross_coefficients(self, **loads: float | None) -> dict[str, np.ndarray]:
        """kxx, kxy, kyx, kyy and kzz (s,) [N/m] over the speeds, in ROSS's axes: x, y, z there
        are y, z, x here. ``radial`` and ``axial`` [N] as for ``at``."""
        k = self.at(**loads)
        return {name: k[:, ROSS[name[1]], ROSS[name[2]]] for name in COEFFICIENTS}

    def to_ross(
        self, node: int, *, damping: float = 0.0, radial: float | None = None,
        axial: float | None = None, **more: Any,
    ) -> Any:  # fmt: skip
        """A ross.BearingElement at a node, with the stiffness over the speeds and a radial damping
        [N s/m]; ``more`` goes to ROSS. Raises EnvironmentLacks without ROSS."""
        try:
            import ross
        except ImportError as exc:
            raise EnvironmentLacks(
                "ROSS is not installed; 'pip install ross-rotordynamics' brings it"
            ) from exc
        except Exception as exc:  # as of ROSS 2.3.0 beside a plotly that it does not know
            raise EnvironmentLacks(
                f"ROSS is installed, but fails when it is imported ({type(exc).__name__}); ROSS "
                "2.3.0 needs 'plotly<7'"
            ) from exc
        k = self.ross_coefficients(radial=radial, axial=axial)
        if len(self.speed) == 1:
            alone = {name: float(values[0]) for name, values in k.items()}
            return ross.BearingElement(n=node, cxx=damping, **alone, **more)
        return ross.BearingElement(n=node, cxx=damping, frequency=self.speed, **k, **more)

    def to_csv(self, path: str | Path) -> None:
        """One row a load and speed: radial and axial load [N], speed [rpm], and all 25 entries."""
        heads = [f"k_{a}_{b}" for a, b in product(_AXES, _AXES)]
        lines = [",".join(["radial_N", "axial_N", "speed_rpm", *heads])]
        for i, j, s in np.ndindex(self.stiffness.shape[:3]):
            at = (self.radial[i], self.axial[j], self.speed[s] * 30.0 / pi)
            values = (*at, *self.stiffness[i, j, s].ravel())
            lines.append(",".join(f"{v:.9g}" if np.isfinite(v) else "" for v in values))
        write_text(Path(path), "\n".join(lines) + "\n")


def stiffness_table(
    case: StaticCase, *, speeds: Sequence[float | str], radial: Sequence[float | str] = (),
    axial: Sequence[float | str] = (),
) -> StiffnessTable:  # fmt: skip
    """Stiffness of a bearing over speeds, radial and axial loads, each a static solution of its
    own: text with units, or SI. Loads that are left out are the case's.

    A load that the bearing cannot bear at a speed leaves NaN there, and a reason in ``failed``.
    """
    expect(case, StaticCase, "case", "flexcage.load_static reads one from a file")
    own_radial, own_axial = case.load.at_start
    w = _values(speeds, "rpm", "speeds")
    r = _values(radial or (own_radial,), "N", "radial")
    a = _values(axial or (own_axial,), "N", "axial")
    found, failed = np.full((len(r), len(a), len(w), 5, 5), np.nan), {}
    for place in np.ndindex(found.shape[:3]):
        changes = dict(zip(("load.radial", "load.axial", "drive.speed"),
                           (float(v[k]) for v, k in zip((r, a, w), place))))  # fmt: skip
        try:
            found[place] = solve_static(case.replace(changes)).stiffness
        except FlexcageError as exc:
            failed[place] = str(exc)
    title = case.bearing.designation or case.name
    return StiffnessTable(title, r, a, w, found, failed)


def _values(given: Sequence[float | str], unit: str, name: str) -> np.ndarray:
    """Values [SI] that rise."""
    if isinstance(given, (str, int, float)):
        given = (given,)
    values = [parse(v, unit, where=name) if isinstance(v, str) else float(v) for v in given]
    if not values or any(b <= a for a, b in zip(values, values[1:])):
        raise InputError(
            f"{name} should be one value or more, each above the one before.", where=name
        )
    return np.array(values)


def _between(loads: np.ndarray, table: np.ndarray, value: float | None, name: str) -> np.ndarray:
    """The table without its first axis, at a load, linear between neighbours."""
    if value is None and len(loads) == 1:
        return np.asarray(table[0])
    if value is None or not loads[0] <= value <= loads[-1]:
        said = "is not given" if value is None else f"is {value:g} N"
        raise InputError(
            f"{name} {said}, but the table goes from {loads[0]:g} N to {loads[-1]:g} N; give a "
            "load between.",
            where=name, value=value,
        )  # fmt: skip
    k = int(np.searchsorted(loads, value))
    if value == loads[k]:
        return np.asarray(table[k])
    k -= 1
    share = (value - loads[k]) / (loads[k + 1] - loads[k])
    return np.asarray((1.0 - share) * table[k] + share * table[k + 1])
