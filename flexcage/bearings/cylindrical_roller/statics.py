"""Cylindrical rollers between two races, in slices with their profile: ISO/TS 16281.

A roller's own coordinates are its centre's radial displacement and, for its tilt about the tangent,
by how much more the end of its effective length at +x is displaced, so that both are lengths.
Each race bears its share of the slices with the stiffness of one contact, so that centrifugal force
divides the races; without it both slices are as the standard has them, in series. Ribs carry axial
load where the design has them on both rings (``rib_statics``). Small angles;
waviness, spalls and scatter of diameters are left out, and so are gyroscopic moments of rollers
that follow a tilted ring (6 % of the moment that holds an N1013 tilted by 1 mrad at 6000 rpm).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.optimize import brentq

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.rib_statics import RibPairs, rib_pairs
from flexcage.contacts.spec import Contacts
from flexcage.geometry.kinematics import epicyclic
from flexcage.geometry.rollers import LINE_EXPONENT as EXPONENT
from flexcage.geometry.rollers import (
    STATIC_PRESSURE,
    line_pressure,
    reference_life,
    roller_ratings,
)
from flexcage.system.statics.elements import ElementLoads, Response, azimuths
from flexcage.system.statics.laws import check_law
from flexcage.system.statics.options import StaticOptions


def rollers_of(
    bearing: RollerBearing, *, speed: float, contacts: Contacts, options: StaticOptions
) -> Rollers:
    """Rollers of a bearing, in the slices and with the stiffness of ``contacts.race``."""
    _check_laws(bearing, contacts)
    from flexcage.bearings.cylindrical_roller.model import rib_stiffness, slice_grid
    from flexcage.contacts.laws import iso_line_stiffness  # its kernels take seconds to load

    places, drop = slice_grid(bearing, contacts.race.slices)
    stiffness = iso_line_stiffness(bearing.effective_length, bearing.race_modulus)
    cage = epicyclic(
        element_diameter=bearing.roller_diameter,
        pitch_diameter=bearing.pitch_diameter,
        element_count=bearing.roller_count,
        inner_speed=speed,
    ).cage_speed
    return Rollers(
        bearing,
        places=places,
        drop=drop,
        stiffness=stiffness * contacts.race.normal.stiffness_factor / len(places),
        cage_speed=cage if options.cage_speed is None else options.cage_speed,
        rating=options.dynamic_rating or bearing.dynamic_rating,
        ribs=rib_pairs(bearing, rib_stiffness(bearing) * contacts.rib.normal.stiffness_factor),
    )


def _check_laws(bearing: RollerBearing, contacts: Contacts) -> None:
    """Refuse laws that have no force at rest, or another one than the static solution takes."""
    race, rib = "contacts.race.normal.law", "contacts.rib.normal.law"
    check_law(contacts.race.normal.law, race, "rollers on races by ISO/TS 16281")
    if any(bearing.carried):
        check_law(contacts.rib.normal.law, rib, "rollers on ribs as flat ends")


@dataclass(frozen=True)
class Rollers:
    """The rollers of a bearing at one speed; implements ``elements.Elements``."""

    bearing: RollerBearing
    places: np.ndarray  # (n,) slices' centres along the roller
    drop: np.ndarray  # (n,) of the profile
    stiffness: float  # of one slice on one race, N/m^(10/9)
    cage_speed: float
    rating: float
    ribs: RibPairs | None
    conservative = True
    pressure_limit = STATIC_PRESSURE

    @property
    def carries(self) -> tuple[bool, ...]:
        return self.ribs is not None, True, True, True, True

    @cached_property
    def azimuth(self) -> np.ndarray:
        return azimuths(self.bearing.roller_count)

    @cached_property
    def shapes(self) -> np.ndarray:
        """How a roller's coordinates displace its slices (2, n)."""
        return np.stack(
            [np.ones_like(self.places), 2.0 * self.places / self.bearing.effective_length]
        )

    @property
    def scale(self) -> float:
        return 0.01 * self.bearing.roller_diameter

    @property
    def push(self) -> float:
        """Centrifugal force [N] on the pitch circle."""
        return self.bearing.roller_mass * self.bearing.pitch_radius * self.cage_speed**2

    @cached_property
    def rest(self) -> float:
        """Displacement [m] from the outer race at which it bears a roller's push alone."""
        top = float(self.drop.min())
        if self.push == 0.0:
            return top
        reach = (self.push / self.stiffness) ** (1.0 / EXPONENT)  # if one slice bore it all

        def missing(x: float) -> float:
            depth = np.maximum(x - self.drop, 0.0)
            return self.push - self.stiffness * float((depth**EXPONENT).sum())

        return float(brentq(missing, top, top + reach, xtol=1e-24, rtol=1e-15))

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """Rollers on the outer race alone, where they push; or halfway between races."""
        shift = 0.25 * self.bearing.radial_clearance + self.rest
        halfway = 0.5 * v[:, 1:] * np.array([1.0, 0.5 * self.bearing.effective_length])
        return [np.tile([shift, 0.0], (len(v), 1)), halfway]

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        return w + step

    def depths(self, v: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How deep (Z, n) the slices are pressed into the inner and the outer race."""
        gap = 0.25 * self.bearing.radial_clearance + self.drop
        roller = w @ self.shapes
        ring = v[:, 1:2] + v[:, 2:] * self.places
        return np.maximum(ring - roller - gap, 0.0), np.maximum(roller - gap, 0.0)

    def slice_forces(self, v: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Forces (Z, n) of the slices on the inner and the outer race [N]."""
        inner, outer = self.depths(v, w)
        return self.stiffness * inner**EXPONENT, self.stiffness * outer**EXPONENT

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        depth = self.depths(v, w)
        force = self.slice_forces(v, w)
        slope = [EXPONENT * self.stiffness * d ** (EXPONENT - 1.0) for d in depth]
        own = self.shapes
        arms = np.stack([0.0 * self.places, np.ones_like(self.places), self.places])
        inner, outer = (np.einsum("zn,an,bn->zab", s, own, own) for s in slope)
        across = np.einsum("zn,an,bn->zab", slope[0], arms, own)
        stored = sum((f * d).sum(axis=1) for f, d in zip(force, depth)) / (EXPONENT + 1.0)
        races = Response(
            energy=stored - self.push * w[:, 0],
            ring=force[0] @ arms.T,
            unbalance=(force[1] - force[0]) @ own.T - np.array([self.push, 0.0]),
            ring_v=np.einsum("zn,an,bn->zab", slope[0], arms, arms),
            ring_w=-across,
            unbalance_v=-across.transpose(0, 2, 1),
            unbalance_w=inner + outer,
        )
        return self.ribs.add(v, w, races) if self.ribs else races

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        slices = np.stack(self.slice_forces(v, w), axis=1)  # (Z, 2, n)
        force = slices.sum(axis=2)
        line = slices.max(axis=2) * len(self.places) / self.bearing.effective_length  # N/m
        b, Z = self.bearing, len(v)
        radius, half = 0.5 * b.roller_diameter, 0.5 * b.effective_length
        races = np.array([b.inner_race_radius, b.outer_race_radius])
        curved = radius * races / (races + np.array([radius, -radius]))
        pressure, width = line_pressure(line, curved, b.race_modulus)
        loaded = slices > 0.0
        return ElementLoads(
            azimuth=self.azimuth,
            force=force,
            angle=np.where(force > 0.0, 0.0, np.nan),
            pressure=pressure,
            across=half * loaded.mean(axis=2),
            along=width,
            edge=np.full((Z, 2), -np.inf),
            centrifugal=np.full(Z, self.push),
            gyroscopic=np.zeros(Z),
            orbital_speed=np.full(Z, self.cage_speed),
            friction=np.where(force > 0.0, 0.0, np.nan),
            axial=self.ribs.forces(v, w) if self.ribs else None,
        )

    def check(self, loads: ElementLoads) -> None:
        """Slices bear only where there is a race."""

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        b = self.bearing
        ratings = roller_ratings(self.rating, b.roller_count, b.gamma)
        return reference_life(*self.slice_forces(v, w), ratings)
