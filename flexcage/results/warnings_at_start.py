"""Warnings of what is to be computed: a cage, its mesh and its modes, when a run begins."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import pi

from flexcage.contacts.spec import LandSpec
from flexcage.core.units import describe
from flexcage.core.warning import RunWarning
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.plausibility import implausible_geometry
from flexcage.mesh.cage_mesh import WALL_GROUPS, CageMesh, pocket_groups
from flexcage.modes.basis import BodyFit
from flexcage.results.warnings import has_land

# of a body from elsewhere: least share of a pocket's deflection that it holds, and difference of
# its stiffness and its mass from the elements', for stiffness beyond what meshes of one fineness do
_CARRIED, _STIFFNESS, _LUMPED = 0.97, 0.05, 0.02


@dataclass(frozen=True, kw_only=True)
class Setup:
    """What is known of a cage when a run begins."""

    bearing: Bearing
    cage: Cage
    land: LandSpec
    mesh: CageMesh
    flexible: bool = True
    basis: str = "ritz"  # kind of modal basis
    attached: bool = True  # does a pocket yield by more than the modes?
    pinched: tuple[int, ...] = ()  # pockets that hold their element with force
    pinch_force: float = 0.0  # N, the largest
    fit: BodyFit | None = None  # of a cage that was reduced elsewhere
    highest: float = 0.0  # Hz, of the dynamic modes


def _implausible_geometry(setup: Setup) -> Iterator[RunWarning]:
    yield from implausible_geometry(setup.bearing, setup.cage)


def _pinched(setup: Setup) -> Iterator[RunWarning]:
    if setup.pinched:
        pockets = "pocket" if len(setup.pinched) == 1 else "pockets"
        yield RunWarning(
            "pinched",
            f"At the start the {setup.bearing.element} of {pockets} "
            f"{', '.join(map(str, setup.pinched))} is pinched with up to "
            f"{setup.pinch_force:.3g} N: the cage is pre-stressed.",
        )


def of_statics(texts: Iterable[str]) -> tuple[RunWarning, ...]:
    """What the static solution warns of that a run begins with."""
    return tuple(RunWarning("static", f"At the start {text}") for text in texts)


def _sharp_corners(setup: Setup) -> Iterator[RunWarning]:
    groups = setup.mesh.groups
    if not setup.flexible or not setup.cage.fillet:
        return
    count = setup.mesh.pocket_count
    sharp = [k for k in range(count) if not len(groups.get(f"pocket{k}_fillet", ()))]
    if not sharp:
        return
    where = "all pockets" if len(sharp) == count else f"pockets {', '.join(map(str, sharp))}"
    yield RunWarning(
        "sharp_corners",
        f"The mesh has no fillets in the corners of {where} (groups such as "
        f"pocket{sharp[0]}_fillet), so cage.fillet_radius = {describe(setup.cage.fillet, 'mm')} is "
        "not in it: stress at a sharp corner has no limit, and rises with every finer mesh.",
    )


def _no_residual_flexibility(setup: Setup) -> Iterator[RunWarning]:
    if not setup.flexible or setup.attached or setup.basis == "craig_bampton" or setup.fit:
        return
    yield RunWarning(
        "no_residual_flexibility",
        f"The modal basis '{setup.basis}' has no residual flexibility: unless its modes contain "
        "the static deflection under loads on every pocket, pockets are too stiff under contact "
        "forces, and stress peaks too low.",
    )


def _body_too_stiff(setup: Setup) -> Iterator[RunWarning]:
    """A body from elsewhere whose modes miss deflection; in round pockets the interface has it."""
    if setup.fit is None or pocket_groups(setup.mesh.groups) == WALL_GROUPS:
        return
    if setup.fit.carried < _CARRIED:
        yield RunWarning(
            "no_residual_flexibility",
            f"The body of modes.body holds {100.0 * setup.fit.carried:.3g} % of the static "
            "deflection under a force on a pocket's wall, and no residual flexibility has the "
            "rest: pockets are too stiff under contact forces, and stress peaks too low; write "
            "more modes, attachment modes of the pockets' faces, or the full matrices.",
        )


def _body_of_another_stiffness(setup: Setup) -> Iterator[RunWarning]:
    if setup.fit is not None and abs(setup.fit.stiffness - 1.0) > _STIFFNESS:
        yield RunWarning(
            "body_stiffness",
            f"A mode of modes.body is {setup.fit.stiffness:.3g} times as stiff as its shape makes "
            "the cage's own elements: contact laws and stresses take the modulus of "
            "cage.material; give that of the body.",
        )


def _body_of_lumped_mass(setup: Setup) -> Iterator[RunWarning]:
    if setup.fit is not None and abs(setup.fit.mass - 1.0) > _LUMPED:
        yield RunWarning(
            "lumped_mass",
            f"A mode of modes.body has {setup.fit.mass:.3g} times the mass that its shape has in "
            "the cage's own elements, as lumped masses give it: inertia forces of such modes, and "
            "their coupling to the motion of the whole cage, differ by as much; write consistent "
            "masses, or take a finer mesh.",
        )


def _body_of_few_modes(setup: Setup) -> Iterator[RunWarning]:
    """The band that contacts excite is taken to end where an element bounces on a pocket's wall."""
    if setup.fit is None:
        return
    bounce = (setup.fit.compliance * setup.bearing.element_mass) ** -0.5 / (2.0 * pi)
    if setup.highest < bounce:
        yield RunWarning(
            "few_modes",
            f"The modes of modes.body reach {setup.highest / 1e3:.3g} kHz, but a "
            f"{setup.bearing.element} bounces on the wall of its pocket at {bounce / 1e3:.3g} kHz: "
            "the inertia of the wall is missing in contacts; write modes up to there.",
        )


def _rigid_land(setup: Setup) -> Iterator[RunWarning]:
    if not setup.flexible or not has_land(setup.cage, setup.land):
        return
    name = f"land_{setup.cage.land_ring}"
    if not len(setup.mesh.groups.get(name, ())):
        yield RunWarning(
            "rigid_land",
            f"The mesh has no group '{name}', so the cage's land there stays rigid.",
        )


#: What is looked at of a cage when a run begins.
AT_START: tuple[Callable[[Setup], Iterator[RunWarning]], ...] = (
    _implausible_geometry,
    _pinched,
    _sharp_corners,
    _no_residual_flexibility,
    _body_too_stiff,
    _body_of_another_stiffness,
    _body_of_lumped_mass,
    _body_of_few_modes,
    _rigid_land,
)
