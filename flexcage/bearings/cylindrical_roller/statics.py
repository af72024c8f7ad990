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
from math import inf, pi

import numpy as np
from scipy.optimize import brentq

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.rib_statics import RibPairs, rib_pairs
from flexcage.contacts.spec import Contacts
from flexcage.geometry.kinematics import epicyclic
from flexcage.system.statics.elements import ElementLoads, Response, azimuths
from flexcage.system.statics.laws import check_law
from flexcage.system.statics.options import StaticOptions

EXPONENT = 10.0 / 9.0
# ISO/TS 16281:2008: ratings of one roller, and lambda nu of radial roller bearings
_INNER, _OUTER, _LAMBDA_NU, _SPREAD = 0.378, 0.364, 0.83, 1.038


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
    pressure_limit = 4.0e9  # ISO 76, roller bearings

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
        modulus = 0.5 * b.race_modulus
        width = np.sqrt(4.0 * line * curved / (pi * modulus))  # Johnson 4.43
        loaded = slices > 0.0
        return ElementLoads(
            azimuth=self.azimuth,
            force=force,
            angle=np.where(force > 0.0, 0.0, np.nan),
            pressure=np.sqrt(line * modulus / (pi * curved)),  # Johnson 4.45
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
        inner, outer = self.slice_forces(v, w)
        if not max(inner.max(), outer.max()) > 0.0:
            return inf
        n = len(self.places)
        edges = edge_stress(n)
        ratings = [q * n ** (-7.0 / 9.0) for q in self._roller_ratings()]
        on_inner = np.mean((edges * inner) ** 4.0, axis=0) ** 0.25  # it turns under the load
        on_outer = np.mean((edges * outer) ** 4.5, axis=0) ** (1.0 / 4.5)  # it stands
        worn = (on_inner / ratings[0]) ** 4.5 + (on_outer / ratings[1]) ** 4.5
        return float(worn.sum() ** (-8.0 / 9.0))

    def _roller_ratings(self) -> tuple[float, float]:
        """Loads [N] of one roller that inner and outer race bear for 10^6 revolutions."""
        b = self.bearing
        share = (_SPREAD * ((1.0 - b.gamma) / (1.0 + b.gamma)) ** (143.0 / 108.0)) ** 4.5
        one = self.rating / (_LAMBDA_NU * b.roller_count)
        return (
            one / _INNER * (1.0 + share) ** (2.0 / 9.0),
            one / _OUTER * (1.0 + 1.0 / share) ** (2.0 / 9.0),
        )


def edge_stress(slices: int) -> np.ndarray:
    """Stress riser (n,) of ISO/TS 16281 on the slices of a line contact, largest at its ends."""
    k = np.arange(1, slices + 1)
    place = np.abs(2.0 * k - slices - 1.0) / (2.0 * slices - 2.0)
    middle = place == 0.0
    return 1.0 - np.where(middle, 0.0, 0.01 / np.log(1.985 * np.where(middle, 0.25, place)))
