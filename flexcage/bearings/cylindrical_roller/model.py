"""A roller bearing from its specs to the arrays that kernels read."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.designs import DESIGNS
from flexcage.bearings.cylindrical_roller.lands import limits
from flexcage.bearings.cylindrical_roller.neighbours import roller_roller_data
from flexcage.bearings.cylindrical_roller.ribs import rib_height
from flexcage.bearings.cylindrical_roller.variables import END_POINTS
from flexcage.bodies.floating_frame import BodyData, no_body
from flexcage.cages.window.cage import WindowCage
from flexcage.contacts import laws
from flexcage.contacts.land import LandData, no_land
from flexcage.contacts.pocket_wall import (
    N_FACE,
    N_LOCAL,
    PocketData,
    modal_rows,
    no_pockets,
    pocket_work,
    with_end_stations,
)
from flexcage.contacts.race import RaceSide, race_work
from flexcage.contacts.rib import RibData
from flexcage.contacts.roller_roller import RollerRollerContact
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT
from flexcage.contacts.uneven import is_uneven, spread, uneven_race
from flexcage.geometry.spot import marked
from flexcage.modes.basis import CageInterface
from flexcage.system.bodies import (
    bodies_of,
    elastic_constants,
    inner_ring_of,
    land_data,
    outer_ring_of,
    unbalanced,
)
from flexcage.system.data import Bodies, RingBody, Work, new_work
from flexcage.system.layout import Layout
from flexcage.system.spec import Drive, Load, Mount


class SpottedRollers(NamedTuple):
    """Which rollers have a spot, and of which row each is."""

    has: np.ndarray  # (Z,) 1 or 0
    angle: float  # of its middle [rad] while the roller's spin angle is zero
    row: np.ndarray  # (Z,) 0 at -x


def spotted_rollers(bearing: Any) -> SpottedRollers:
    """Those of a bearing with ``roller_spot``."""
    spot, rows = bearing.roller_spot, np.arange(bearing.row_count)
    return SpottedRollers(
        marked(bearing.total_elements, spot.rollers), spot.angle,
        np.repeat(rows, bearing.element_count),
    )  # fmt: skip


class RollerRows(NamedTuple):
    """How many rollers a row has, and of every roller the middle of its row along the axis and its
    azimuth in the row."""

    each: int
    place: np.ndarray  # (Z,) [m]
    azimuth: np.ndarray  # (Z,) [rad]


class RollerModel(NamedTuple):
    """Everything constant that a roller bearing's residual reads."""

    bodies: Bodies
    inner_ring: RingBody
    outer_ring: RingBody
    cage: BodyData
    inner: RaceSide
    outer: RaceSide
    rib: RibData  # of the inner ring
    outer_rib: RibData
    pocket: PocketData
    neighbours: RollerRollerContact
    spot: SpottedRollers
    land: LandData
    rows: RollerRows


def slice_grid(bearing: RollerBearing, slices: int) -> tuple[np.ndarray, np.ndarray]:
    """Slice centres (n,) on the effective length, and the profile's drop there (n,) [m]."""
    return bearing.profile.slices(
        slices, diameter=bearing.roller_diameter, length=bearing.effective_length
    )


def _race_side(bearing, contacts: Contacts, lubricant: Lubricant, *, inner: bool) -> RaceSide:
    s, drop = slice_grid(bearing, contacts.race.slices)
    sign = 1.0 if inner else -1.0
    radius = bearing.inner_race_radius if inner else bearing.outer_race_radius
    rw = 0.5 * bearing.roller_diameter
    equivalent = rw * radius / (radius + sign * rw)
    modulus = bearing.race_modulus
    wave, spall = uneven_race(bearing, "inner" if inner else "outer", radius, equivalent)
    own = bearing.inner_spall if inner else bearing.outer_spall
    stiffness = laws.iso_line_stiffness(bearing.effective_length, modulus)
    return RaceSide(
        sign=sign,
        radius=radius,
        s=s,
        drop=drop,
        normal=laws.normal_parameters(
            contacts.race.normal, stiffness, 10.0 / 9.0, parts=contacts.race.slices
        ),
        friction=laws.friction_parameters(contacts.race.friction),
        rolling=laws.rolling_resistance(lubricant, equivalent, bearing.effective_length, modulus),
        hydro=2.0 * equivalent / rw,
        wave=wave,
        spall=spall,
        spalled=own.covered(s, bearing.effective_length / contacts.race.slices),
        row=own.row,
        uneven=is_uneven(wave, spall),
        spot=bearing.roller_spot.dimensions(rw, equivalent, spread(equivalent, modulus)),
        spotted=bearing.roller_spot.covered(s, bearing.effective_length / contacts.race.slices),
    )


def end_points(bearing: RollerBearing, cage: WindowCage) -> np.ndarray:
    """Points (n, 2) of a roller's end over the band that a side beam covers, as offsets along e_r
    and e_psi [m]."""
    low, high = (0.5 * d - bearing.pitch_radius for d in (cage.bore, cage.outside_diameter))
    return points_over(low, high, bearing.roller_diameter)


def points_over(low: float, high: float, diameter: float) -> np.ndarray:
    """Points (n, 2) of an end of a ``diameter`` over a band between heights [m], as offsets along
    the heights and across them: Gauss points across the band by those along it (``END_POINTS``),
    enough to feel a side beam that is bent within one pocket."""
    low, high = max(low, -0.45 * diameter), min(high, 0.45 * diameter)
    across, along = (np.polynomial.legendre.leggauss(n)[0] for n in END_POINTS)
    across = 0.5 * (low + high) + 0.5 * (high - low) * across
    reach = np.sqrt((0.45 * diameter) ** 2 - max(abs(low), abs(high)) ** 2)
    return np.array([(y, z) for y in across for z in reach * along])


def rib_points(bearing: RollerBearing, ring: str) -> np.ndarray:
    """Three points (3, 2) of a roller's end over the ribs of the "inner" or "outer" ring, halfway
    up the overlap [m]; along e_r and e_psi."""
    rw, y = 0.5 * bearing.roller_diameter, rib_height(bearing, ring)
    reach = np.sqrt(max((0.9 * rw) ** 2 - y**2, 0.0))
    return np.array([(y, -0.7 * reach), (y, 0.0), (y, 0.7 * reach)])


def rib_stiffness(bearing: RollerBearing) -> float:
    """Stiffness [N/m] of a roller's end on one rib."""
    roller, rib = elastic_constants(bearing.rolling_material), elastic_constants(bearing.material)
    return laws.flat_end_stiffness(0.45 * 0.5 * bearing.roller_diameter, roller, rib)


def crossbeam_width(bearing: RollerBearing, cage: WindowCage) -> float:
    """Width of a crossbeam at the pitch radius [m]."""
    return 2.0 * np.pi * bearing.pitch_radius / bearing.roller_count - cage.pocket_width


def _guiding_land(bearing: RollerBearing, cage: WindowCage) -> tuple[bool, float, float]:
    """Is the cage's outside its land, that land's radius, and its clearance on the ring [m]?"""
    radius, (inner, outer) = cage.land_radius, limits(bearing, cage)
    if cage.land_ring == "outer":
        return True, radius, 0.5 * outer.diameter - radius
    return False, radius, radius - 0.5 * inner.diameter


def compliance_root(compliance: np.ndarray) -> np.ndarray:
    """L (Z, n, n) with L L^T the compliance (Z, n, n), which may be singular."""
    values, vectors = np.linalg.eigh(compliance)
    return np.ascontiguousarray(vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :])


def own_coordinates(shapes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What residual coordinates (Z, 4, nst, 12) do to each face, in six coordinates of its own.

    The shapes (Z, 4, nst, 6) of those, and their directions (Z, 4, 6, 12), orthonormal or zero. Of
    the seven that seven stations have, the one left out holds 1e-8 of the compliance (N1013).
    """
    left, values, right = np.linalg.svd(shapes, full_matrices=False)
    own = np.zeros((*shapes.shape[:3], N_FACE))
    turn = np.zeros((*shapes.shape[:2], N_FACE, N_LOCAL))
    n = min(N_FACE, values.shape[-1])
    own[..., :n], turn[..., :n, :] = (left * values[..., None, :])[..., :n], right[..., :n, :]
    return own, turn


def _pocket_laws(bearing, cage, contacts: Contacts, interface: CageInterface) -> np.ndarray:
    points = len(end_points(bearing, cage))
    return laws_in_pockets(
        bearing, cage, crossbeam_width(bearing, cage), points, contacts, interface
    )


def laws_in_pockets(
    bearing: Any, cage: Any, crossbeam: float, points: int, contacts: Contacts,
    interface: CageInterface,
) -> np.ndarray:  # fmt: skip
    """Normal laws (2, N_NORMAL) of a slice of a crossbeam, whose width is given [m], and of one of
    the ``points`` of a side beam."""
    rw, flexible = 0.5 * bearing.roller_diameter, interface.modes.shape[-1] > 0
    roller = elastic_constants(bearing.rolling_material)
    wall = elastic_constants(cage.warm_material)
    k, e = laws.pocket_line_law(
        radius=rw,
        length=bearing.effective_length,
        roller=roller,
        wall=wall,
        depth=0.5 * crossbeam,
        patch_half_width=interface.patch_half_width if flexible else 0.0,
    )
    k_end = laws.flat_end_stiffness(0.9 * rw, roller, wall)
    return np.stack([
        laws.normal_parameters(contacts.pocket.normal, k, e, parts=contacts.pocket.slices),
        laws.normal_parameters(contacts.side.normal, k_end, 1.0, parts=points),
    ])  # fmt: skip


def _rib_data(
    bearing: RollerBearing, cage: WindowCage | None, contacts: Contacts, ring: str
) -> RibData:
    """Ribs of the "inner" or "outer" ring; those that guide the rollers come first in arrays. A
    cage between them takes the width of its side beams."""
    ribs, guides = bearing.ribs(ring), ring == DESIGNS[bearing.design].guide
    points = rib_points(bearing, ring) if ribs else np.zeros((0, 2))
    plus, minus = ribs.sides if ribs else (False, False)
    beams = cage.side_beam_width if cage and bearing.cage_between_ribs else 0.0
    return RibData(
        first=0 if plus else 1,
        end=2 if minus else int(plus),
        column=0 if guides else 2,
        half_gap=0.5 * ribs.gap - beams if ribs else np.inf,
        half_roller=0.5 * bearing.roller_length,
        points=points,
        normal=laws.normal_parameters(
            contacts.rib.normal, rib_stiffness(bearing), 1.0, parts=max(len(points), 1)
        ),
        friction=laws.friction_parameters(contacts.rib.friction),
    )


def _places_of_rows(bearing: RollerBearing) -> np.ndarray:
    """Middle (Z,) [m] of the row of every roller."""
    return np.repeat([row.place for row in bearing.row_places], bearing.roller_count)


def _pocket_data(bearing, cage, contacts: Contacts, interface: CageInterface) -> PocketData:
    s, drop = slice_grid(bearing, contacts.pocket.slices)
    at = interface.stations if interface.offset_at is None else interface.offset_at
    return pocket_arrays(
        interface, interface.modes, interface.stations, at, contacts, bearing.element_azimuths,
        place=_places_of_rows(bearing), s=s, drop=drop,
        half=0.5 * np.array([cage.pocket_width, cage.pocket_length]),
        points=end_points(bearing, cage), half_roller=0.5 * bearing.roller_length, middle=0.0,
        normal=_pocket_laws(bearing, cage, contacts, interface),
    )  # fmt: skip


def pocket_arrays(
    interface: CageInterface, modes: np.ndarray, stations: np.ndarray, at: np.ndarray,
    contacts: Contacts, angle: np.ndarray, **known: Any,
) -> PocketData:  # fmt: skip
    """Pockets of a cage at ``angle`` (Z,): ``modes`` (Z, 4, nst, 3, n) at the stations in the axes
    of the faces, places of ``stations`` (4, nst) and of the offsets (4, no) along them [m], and
    what else is ``known``."""
    n = modes.shape[-1]
    normal = np.stack([modes[:, f, :, 2 if f < 2 else 0] for f in range(4)], axis=1)
    st = np.ascontiguousarray
    if interface.compliance.shape[1:] != (N_LOCAL, N_LOCAL):
        raise ValueError(f"compliances are {interface.compliance.shape}, not (Z, {N_LOCAL}, same)")
    root = compliance_root(interface.compliance)
    shapes = np.einsum("zfsa,zab->zfsb", interface.residual, root)
    res = with_end_stations(shapes)
    res_max = np.abs(res).max(axis=2)
    own, turn = own_coordinates(shapes)
    own = with_end_stations(own)
    return PocketData(
        azimuth=st(np.stack([np.cos(angle), np.sin(angle)], axis=1)),
        x0=st(stations[:, 0]),
        dx=st(stations[:, 1] - stations[:, 0]),
        offset=st(interface.offset),
        grid=st(np.stack([at[:, 0], at[:, 1] - at[:, 0]])),
        low=interface.offset.min(axis=2),
        bent=np.any(interface.offset, axis=2).astype(np.int64),
        phi=st(modes),
        phi_max=np.abs(normal).max(axis=(0, 1, 2)) if n else np.zeros(0),
        rows=modal_rows(modes),
        soft=int(interface.compliance.any()),
        res=res,
        res_max=res_max,
        most=res_max.max(axis=1),
        own=own,
        own_max=np.abs(own).max(axis=2),
        turn=turn,
        root=root,
        friction=np.stack(
            [
                laws.friction_parameters(contacts.pocket.friction),
                laws.friction_parameters(contacts.side.friction),
            ]
        ),
        **known,
    )


def build_roller_model(
    bearing: RollerBearing, cage: WindowCage | None, body: Any, interface: Any, *,
    contacts: Contacts, lubricant: Lubricant, drive: Drive, load: Load, mount: Mount, seed: int = 0,
) -> RollerModel:  # fmt: skip
    """Arrays of a roller bearing for the kernels, from its cage's body (``FlexibleBody``) and
    interface (``CageInterface``); without a cage all three are None."""
    scatter = bearing.roller_scatter * np.random.default_rng(seed).standard_normal(
        bearing.total_elements
    )
    return RollerModel(
        bodies=bodies_of(
            bearing, cage, lubricant, drive, load,
            element=np.array([bearing.roller_mass, *bearing.roller_inertia]),
            radius=0.5 * (bearing.roller_diameter + scatter),
            area=bearing.roller_diameter * bearing.roller_length,
        ),
        inner_ring=inner_ring_of(bearing, drive, load, free_axially=load.frees_axially(bearing)),
        outer_ring=outer_ring_of(bearing, mount),
        cage=unbalanced(body, cage).data if cage else no_body().data,
        inner=_race_side(bearing, contacts, lubricant, inner=True),
        outer=_race_side(bearing, contacts, lubricant, inner=False),
        rib=_rib_data(bearing, cage, contacts, "inner"),
        outer_rib=_rib_data(bearing, cage, contacts, "outer"),
        pocket=(
            _pocket_data(bearing, cage, contacts, interface) if cage
            else no_pockets(bearing.total_elements, 0.5 * bearing.roller_length)
        ),
        neighbours=roller_roller_data(
            bearing, contacts, *slice_grid(bearing, contacts.race.slices)
        ),
        spot=spotted_rollers(bearing),
        land=_land(bearing, cage, contacts, lubricant, interface) if cage else no_land(),
        rows=RollerRows(
            bearing.roller_count, _places_of_rows(bearing), bearing.element_azimuths
        ),
    )  # fmt: skip


def _land(
    bearing: RollerBearing, cage: WindowCage, contacts: Contacts, lubricant: Lubricant,
    interface: CageInterface,
) -> LandData:  # fmt: skip
    """The cage's land on the ring that guides it."""
    outer, radius, clearance = _guiding_land(bearing, cage)
    ring = bearing.land(cage)
    assert ring is not None, "rollers' cages face a ring"
    land = replace(contacts.land.on(ring), clearance=clearance)
    return land_data(
        cage,
        land,
        lubricant,
        interface.land,
        kind=land.kind,
        outer=outer,
        radius=radius,
        bearing=bearing,
        end=ring.end,
    )


def rib_columns(model: RollerModel) -> int:
    """Length of arrays of ribs: two guide the rollers, and two more if there are counter ribs."""
    both = model.rib.end > model.rib.first and model.outer_rib.end > model.outer_rib.first
    return 4 if both else 2


def roller_work(model: RollerModel, layout: Layout) -> Work:
    """Fresh workspaces of a roller bearing for one thread."""
    slices, points, stations = (
        len(model.pocket.s),
        len(model.pocket.points),
        model.pocket.phi.shape[2],
    )
    return new_work(
        layout, race_work(len(model.inner.s)), pocket_work(slices, points, stations, layout.modes),
        slices=slices, points=points, faces=4 if layout.has_cage else 1, stations=stations,
        ribs=rib_columns(model), land_stations=len(model.land.angle),
        turns=(Q_SPIN, Q_SKEW, Q_TILT),
    )  # fmt: skip
