"""Defects of crown cages: claws bent, cracked or missing, and worn pockets.

The front claw of a pocket is that on the side of increasing azimuth, the rear one the other.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.round_pocket.defects import BallCageDefect
from flexcage.cages.round_pocket.shapes import PocketShapes
from flexcage.core.spec import option, quantity
from flexcage.core.units import mm, typeset
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import (
    CageLine,
    Finding,
    Mark,
    Reading,
    around,
    defect_type,
    signed_mm,
)

if TYPE_CHECKING:
    from flexcage.mesh.cage_mesh import CageMesh

_BROKEN = (Mark("line", "crack", "crack under a claw, or where one is missing"),)
CLAWS = {"front": 1.0, "rear": -1.0}  # and the sign of the azimuth on their side of the pocket


@dataclass(frozen=True, kw_only=True)
class CrownDefect(BallCageDefect):
    """A defect of a crown cage."""

    breaks: ClassVar[bool] = False  # does the sound mesh need a plane where claws stand on bars?
    removes: ClassVar[bool] = False  # does it take vertices away?

    def move_stations(self, offset: np.ndarray, stations: np.ndarray, cage: Any) -> None:
        """Add how far it moved stations, at angles [rad] from +psi towards +x, beyond what it
        alters of shapes, to ``offset`` (Z, n_st, 3) [m], components (x, r, psi)."""

    def lower_walls(self, open_at: np.ndarray, cage: Any) -> None:
        """Lower the places x (Z,) [m] at which walls end towards +x."""

    def fronts(self, cage: Any) -> Sequence[float]:
        """Radii [m] at which that plane must have arcs of edges."""
        return ()


@dataclass(frozen=True, kw_only=True)
class ClawDefect(CrownDefect):
    """A defect of one of a pocket's two claws."""

    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    claw: str = option(doc="which of the pocket's claws", choices=tuple(CLAWS))

    @property
    def sign(self) -> float:
        """1 for the front claw, -1 for the rear one."""
        return CLAWS[self.claw]

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        yield from self.check_number(where, count)
        if self.claw not in CLAWS:
            yield (
                f"{where}.claw",
                f"{where}.claw is {self.claw!r}, but must be 'front' or 'rear'.",
                self.claw,
            )

    @classmethod
    def check_together(cls, own: Sequence[ClawDefect], count: int) -> Iterator[Finding]:
        claws = [(defect.pocket, defect.claw) for defect in own]
        for pocket, claw in claws:
            if claws.count((pocket, claw)) > 1:
                yield (
                    "defects",
                    f"The {claw} claw of pocket {pocket} has {claws.count((pocket, claw))} defects "
                    f"of type '{own[0].type}'; give each claw one.",
                    pocket,
                )

    @property
    def _named(self) -> str:
        return f"the {self.claw} claw of pocket {self.pocket}"


@dataclass(frozen=True, kw_only=True)
class BentClaw(ClawDefect):
    """A claw bent as a cantilever from its bar: its tip went along the circumference, away from the
    ball, or towards it where ``deflection`` is negative. Without stress since then."""

    type: str = defect_type("bent_claw")
    deflection: float = quantity("mm", doc="how far the tip is bent away from the ball")

    def move_stations(self, offset: np.ndarray, stations: np.ndarray, cage: Any) -> None:
        """Those in the opening as the tip, the one in its middle half as far."""
        from flexcage.cages.crown.morph import bent_share

        cosine = np.cos(stations)
        here = np.where(np.abs(cosine) < 1e-9, 0.5, self.sign * cosine > 0.0)
        share = bent_share(0.5 * cage.pocket_diameter * np.sin(stations), cage)
        offset[self.pocket, :, 2] += self.sign * self.deflection * share * here

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        from flexcage.cages.crown.morph import bend_claw

        return bend_claw(mesh, cage, self.pocket, self.sign, self.deflection)

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        from flexcage.cages.crown.morph import tip_place

        place = tip_place(mesh, cage, self.pocket, self.sign)
        return [Reading(self.type, self.deflection, [place])]

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        yield from super().check(where, cage, count)
        assert isinstance(cage, CrownCage)
        most = cage.tip - cage.bar_height
        if not abs(self.deflection) < most:
            yield (
                f"{where}.deflection",
                f"{where}.deflection is {mm(self.deflection)}, but a claw {mm(most)} long bends by "
                "less than its length.",
                self.deflection,
            )

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, "place"): 0.0}

    @property
    def legend(self) -> Sequence[Mark]:
        return (Mark("line", "moved", "pocket with a bent claw; arrow: way of its tip"),)

    def way(self, count: int) -> tuple[float, np.ndarray] | None:
        if not self.deflection:
            return None
        return 0.2, np.sign(self.deflection) * self.sign * around(self.place, count)

    @property
    def label(self) -> str:
        return f"{self._named} bent, {signed_mm(self.deflection)}"

    def in_words(self, count: int) -> str:
        way = "away from" if self.deflection > 0.0 else "towards"
        return f"{self._named} is bent by {typeset(abs(self.deflection), 'mm')} {way} the ball"


@dataclass(frozen=True, kw_only=True)
class CrackedClaw(ClawDefect):
    """A slit without width where a claw stands on its bar, from the bore outwards over ``share`` of
    the wall. It stays open: its faces exert no force on each other."""

    breaks: ClassVar[bool] = True

    type: str = defect_type("cracked_claw")
    share: float = option(doc="its depth over the thickness of the cage's wall, between 0 and 1")

    def extent(self, cage: Any) -> float:
        return self.fronts(cage)[0] - 0.5 * float(cage.bore)

    def fronts(self, cage: Any) -> Sequence[float]:
        return (0.5 * (cage.bore + self.share * (cage.outside_diameter - cage.bore)),)

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        from flexcage.cages.crown.morph import crack_claw

        return crack_claw(sound, mesh, cage, self.pocket, self.sign, *self.fronts(cage))

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        from flexcage.cages.crown.morph import crack_depth

        asked = self.fronts(cage)[0] - 0.5 * cage.bore
        return [Reading(self.type, asked, [crack_depth(mesh, cage, self.pocket, self.sign)])]

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        yield from super().check(where, cage, count)
        if not 0.0 < self.share < 1.0:
            yield (
                f"{where}.share",
                f"{where}.share is {self.share:g}, but a crack is deeper than 0 and less deep than "
                "the wall, 1; a claw that is off is a 'missing_claw'.",
                self.share,
            )

    @property
    def legend(self) -> Sequence[Mark]:
        return _BROKEN

    def lines(self, points: np.ndarray, count: int) -> list[CageLine]:
        from flexcage.cages.crown.morph import doubled_line

        return doubled_line(points, count, self.pocket, self.sign)

    @property
    def label(self) -> str:
        return f"{self._named} cracked, {100.0 * self.share:g} % of the wall"

    def in_words(self, count: int) -> str:
        return (
            f"{self._named} is cracked at its root from the bore over {100.0 * self.share:g} % of "
            "the wall"
        )


@dataclass(frozen=True, kw_only=True)
class MissingClaw(ClawDefect):
    """A claw that broke off where it stood on its bar.

    Its pocket holds the ball no more on the open side: contact ends at the bars' height there,
    beside the claw that is left too.
    """

    breaks: ClassVar[bool] = True
    removes: ClassVar[bool] = True

    type: str = defect_type("missing_claw")

    def lower_walls(self, open_at: np.ndarray, cage: Any) -> None:
        open_at[self.pocket] = min(open_at[self.pocket], cage.bar_height)

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        from flexcage.cages.crown.morph import without_claw

        return without_claw(mesh, cage, self.pocket, self.sign)

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        from flexcage.cages.crown.morph import missing_height

        asked = cage.tip - cage.bar_height
        return [Reading(self.type, asked, [missing_height(mesh, cage, self.pocket, self.sign)])]

    @property
    def legend(self) -> Sequence[Mark]:
        return _BROKEN

    def lines(self, points: np.ndarray, count: int) -> list[CageLine]:
        from flexcage.cages.crown.morph import broken_line

        return broken_line(points, count, self.pocket, self.sign)

    @property
    def label(self) -> str:
        return f"{self._named} missing"

    def in_words(self, count: int) -> str:
        return f"{self._named} is missing"


@dataclass(frozen=True, kw_only=True)
class WornPocket(CrownDefect):
    """A pocket whose wall has lost a layer of even thickness, claws' insides and all; their tips
    are as high as before."""

    type: str = defect_type("worn_pocket")
    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    depth: float = quantity("mm", doc="thickness of what is worn off", above=0.0)

    def alter(self, shapes: PocketShapes) -> None:
        shapes.radius[self.pocket] += self.depth

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        from flexcage.cages.crown.morph import wear_pocket

        return wear_pocket(mesh, cage, self.pocket, self.depth)

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        from flexcage.cages.crown.morph import pocket_radius

        radius = pocket_radius(mesh, self.pocket, pitch_radius)
        return [Reading(self.type, self.depth, [radius - 0.5 * cage.pocket_diameter])]

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        yield from super().check(where, cage, count)
        assert isinstance(cage, CrownCage)
        most = 0.5 * min(cage.claw_thickness, cage.ring_thickness)
        if not 0.0 < self.depth < most:
            yield (
                f"{where}.depth",
                f"{where}.depth is {mm(self.depth)}, but must be greater than zero and less than "
                f"half of the thinner one of claws and ring, {mm(most)}.",
                self.depth,
            )

    @classmethod
    def check_together(cls, own: Sequence[WornPocket], count: int) -> Iterator[Finding]:
        pockets = [defect.pocket for defect in own]
        for k in pockets:
            if pockets.count(k) > 1:
                yield "defects", f"Pocket {k} is worn {pockets.count(k)} times; say it once.", k

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, "diameter"): 2.0 * self.depth}

    @property
    def legend(self) -> Sequence[Mark]:
        return (Mark("line", "larger", "worn pocket"),)

    @property
    def label(self) -> str:
        return f"pocket {self.pocket} worn by {mm(self.depth)}"

    def in_words(self, count: int) -> str:
        return f"the wall of pocket {self.pocket} is worn by {typeset(self.depth, 'mm')}"
