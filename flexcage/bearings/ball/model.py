"""A ball bearing from its specs to the arrays that kernels read."""

from __future__ import annotations

from math import pi
from typing import Any, NamedTuple

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.neighbours import ball_ball_data
from flexcage.bodies.floating_frame import BodyData, no_body
from flexcage.cages.halves import signs_of
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.interface import BallCageInterface
from flexcage.contacts import laws
from flexcage.contacts.ball_ball import BallBallContact
from flexcage.contacts.ball_pocket import (
    CYLINDER,
    SPHERE,
    BallPockets,
    ball_pocket_work,
    no_ball_pockets,
)
from flexcage.contacts.groove import Groove
from flexcage.contacts.land import NONE, LandData, no_land, with_other
from flexcage.contacts.race import race_work
from flexcage.contacts.spec import Contacts, LandSpec, Lubricant
from flexcage.contacts.uneven import is_uneven, spread, uneven_race
from flexcage.geometry.hertz import PointContact
from flexcage.geometry.materials import contact_modulus
from flexcage.geometry.spot import marked
from flexcage.system.bodies import (
    bodies_of,
    inner_ring_of,
    land_data,
    land_on_stop,
    outer_ring_of,
    unbalanced,
)
from flexcage.system.data import Bodies, RingBody, Work, new_work
from flexcage.system.layout import Layout
from flexcage.system.spec import Drive, Load, Mount

POINT = 1.5  # exponent of a Hertz contact


class SpottedBalls(NamedTuple):
    """Which balls have a spot."""

    has: np.ndarray  # (Z,) 1 or 0


class BallModel(NamedTuple):
    """Everything constant that a ball bearing's residual reads."""

    bodies: Bodies
    inner_ring: RingBody
    outer_ring: RingBody
    cage: BodyData
    inner: Groove
    outer: Groove
    pocket: BallPockets
    neighbours: BallBallContact
    spot: SpottedBalls
    land: LandData


def strips(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Middles (n,) of equal strips of -1..1 across an ellipse, and the share (n,) of a Hertz
    contact's load that each bears: 3/4 (1 - s^2) ds, exactly."""
    edges = np.linspace(-1.0, 1.0, count + 1)
    return 0.5 * (edges[1:] + edges[:-1]), 0.75 * np.diff(edges - edges**3 / 3.0)


def groove_of(
    bearing: BallBearing, contacts: Contacts, lubricant: Lubricant, *, inner: bool
) -> Groove:
    """The inner or the outer raceway."""
    contact = bearing.contacts[0 if inner else 1]
    axial, centre = bearing.inner_groove_centre if inner else bearing.outer_groove_centre
    radius = bearing.inner_groove_radius if inner else bearing.outer_groove_radius
    strip, share = strips(contacts.race.slices)
    ring, side = ("inner", -1.0) if inner else ("outer", 1.0)
    wave, spall = uneven_race(bearing, ring, bearing.race_radius(ring), contact.rolling)
    sides = getattr(bearing, f"{ring}_spall").sides(radius)
    long = float(contact.semi_axes(1.0)[0])
    felt = spread(contact.rolling, bearing.race_modulus)
    return Groove(
        side=side,
        axial=axial,
        centre=centre,
        radius=radius,
        long=long,
        bend=bearing.contact_curvatures[0 if inner else 1],
        strip=strip,
        share=share,
        normal=laws.normal_parameters(contacts.race.normal, contact.stiffness, POINT),
        friction=laws.friction_parameters(contacts.race.friction),
        rolling=laws.point_rolling_resistance(lubricant, contact),
        wave=wave,
        spall=spall,
        sides=np.sort(side * np.array(sides)),
        reach=long * contact.stiffness ** (1.0 / 3.0),
        spot=bearing.ball_spot.dimensions(0.5 * bearing.ball_diameter, contact.rolling, felt),
        uneven=is_uneven(wave, spall),
    )


def pocket_contact(bearing: BallBearing, cage: BallCage, radius: float) -> PointContact:
    """Hertz contact of a ball with the wall of a pocket of that radius [m].

    Across a cylinder's axis, and all round in a sphere, ball and wall nearly fit: the contact is
    long, but small against both while loads are those of cages.
    """
    ball = 0.5 * bearing.ball_diameter
    fit = 1.0 / (1.0 / ball - 1.0 / radius)
    along = fit if cage.pocket_shape == "spherical" else ball
    modulus = contact_modulus(bearing.rolling_material, cage.warm_material)
    return PointContact(rolling=along, transverse=fit, modulus=modulus)


def _pockets(
    bearing: BallBearing, cage: BallCage, contacts: Contacts, interface: BallCageInterface
) -> BallPockets:
    st = np.ascontiguousarray
    angle = bearing.element_azimuths
    theta = interface.stations
    normal = np.sin(theta)[None, :, None] * interface.modes[:, :, 0]
    normal = normal + np.cos(theta)[None, :, None] * interface.modes[:, :, 2]
    if cage.pocket_shape == "spherical":
        normal = np.linalg.norm(interface.modes, axis=2)
    n, height = interface.modes.shape[-1], 0.5 * bearing.pitch_diameter
    ends = np.array([cage.wall_ends(height, float(r)) for r in interface.radius])
    if interface.open_at is not None:
        ends[:, 2] = np.minimum(ends[:, 2], interface.open_at / interface.radius)
    offset = np.zeros(interface.modes.shape[:3]) if interface.offset is None else interface.offset
    mirrored = np.repeat(signs_of(cage, bearing.row_places), bearing.ball_count) < 0.0
    ends[mirrored, 2:] = ends[mirrored, :1:-1]
    return BallPockets(
        azimuth=st(np.stack([np.cos(angle), np.sin(angle)], axis=1)),
        shift=st(interface.centre),
        slot=st(interface.slot),
        radius=st(interface.radius),
        height=height,
        wall=0.5 * np.array([cage.bore, cage.outside_diameter]),
        shape=SPHERE if cage.pocket_shape == "spherical" else CYLINDER,
        rims=st(ends[:, :2]),
        sides=st(ends[:, 2:]),
        offset=st(offset),
        inset=float(np.linalg.norm(offset, axis=2).max()),
        phi=st(interface.modes[:, None]),
        phi_max=np.abs(normal).max(axis=(0, 1)) if n else np.zeros(0),
        local=st(interface.local),
        normal=np.stack(
            [
                laws.normal_parameters(
                    contacts.pocket.normal, pocket_contact(bearing, cage, float(r)).stiffness, POINT
                )
                for r in interface.radius
            ]
        ),
        friction=laws.friction_parameters(contacts.pocket.friction),
    )


def build_ball_model(
    bearing: BallBearing, cage: BallCage | None, body: Any, interface: Any, *,
    contacts: Contacts, lubricant: Lubricant, drive: Drive, load: Load, mount: Mount, seed: int = 0,
) -> BallModel:  # fmt: skip
    """Arrays of a ball bearing for the kernels, from its cage's body (``FlexibleBody``) and
    interface (``BallCageInterface``); without a cage all three are None."""
    rng = np.random.default_rng(seed)
    scatter = bearing.ball_scatter * rng.standard_normal(bearing.total_elements)
    radius_of_balls = 0.5 * (bearing.ball_diameter + scatter)
    return BallModel(
        bodies=bodies_of(
            bearing, cage, lubricant, drive, load,
            element=np.array([bearing.ball_mass, bearing.ball_inertia, bearing.ball_inertia]),
            radius=radius_of_balls,
            area=0.25 * pi * bearing.ball_diameter**2,
        ),
        inner_ring=inner_ring_of(bearing, drive, load, free_axially=True),
        outer_ring=outer_ring_of(bearing, mount),
        cage=unbalanced(body, cage).data if cage else no_body().data,
        inner=groove_of(bearing, contacts, lubricant, inner=True),
        outer=groove_of(bearing, contacts, lubricant, inner=False),
        pocket=(
            _pockets(bearing, cage, contacts, interface) if cage
            else no_ball_pockets(bearing.total_elements)
        ),
        neighbours=ball_ball_data(bearing, contacts, radius_of_balls),
        spot=SpottedBalls(marked(bearing.total_elements, bearing.ball_spot.balls)),
        land=(
            _lands(bearing, cage, contacts.land, lubricant, interface.land) if cage else no_land()
        ),
    )  # fmt: skip


def _lands(
    bearing: BallBearing, cage: BallCage, spec: LandSpec, lubricant: Lubricant, modes: np.ndarray
) -> LandData:
    """The cage's land on the ring that guides it; of a cage that only balls guide the shoulders of
    the inner ring and, as the other's, of the outer one."""
    on = spec.on(bearing.land(cage))
    land = land_data(
        cage, on, lubricant, modes, kind=on.kind if cage.has_land else "none",
        outer=cage.land_ring == "outer", radius=cage.land_radius, bearing=bearing,
    )  # fmt: skip
    inner, outer = (
        None if stop is None else
        land_on_stop(cage, spec, lubricant, modes, stop=stop, outer=out, bearing=bearing)
        for stop, out in zip(bearing.stops(cage), (False, True))
    )  # fmt: skip
    land = land if inner is None else inner
    return land if outer is None else with_other(land, outer)


def ball_work(model: BallModel, layout: Layout, ribs: int = 1) -> Work:
    """Fresh workspaces of a ball bearing for one thread; ``ribs``: what its balls may touch besides
    two races and their pocket."""
    stations = model.pocket.phi.shape[2]
    return new_work(
        layout, race_work(1), ball_pocket_work(stations, layout.modes), slices=0, points=0,
        faces=int(layout.has_cage), stations=stations, ribs=ribs,
        land_stations=len(model.land.angle), turns=(3, 4, 5),
        other_land=model.land.other_kind != NONE,
    )  # fmt: skip
