"""Waves and spalls of a race: how far it stands out or lets an element sink, over the azimuth.

An element feels an edge over the width of its contact, not at a line: how far it sinks is the mean
over that width (``spread``). So forces have no jumps, where an element stands on both edges of a
short spall there is an equilibrium, and integrators see what they step over.

``effective_penetration`` of a ball in an uneven groove: its contact is a row of strips across the
ellipse, each of which presses in proportion to its own depth d - y^2/c^2 at y across, for c half of
the ellipse's length over the root of d. That is Hertz's force, energy and distribution of load,
exactly. A spall takes its own depth from the strips that lie over it; so an ellipse that is wider
than the spall stands on its sides.
"""

from __future__ import annotations

from math import copysign, cos, pi, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.jit import outlined, part

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing

LEAST_SHARE = 1e-12  # of the energy on an even groove: less is rounding
# pressure of a contact at whose half width edges are felt; 1 to 2 GPa are usual in bearings
_FELT_AT = 1.0e9


def spread(effective: float, modulus: float) -> float:
    """Half of the width [m] over which an edge is felt: that of a line contact of ``_FELT_AT``,
    with an ``effective`` radius [m] and a plane strain modulus E/(1 - nu^2) [Pa] of both bodies."""
    return 4.0 * _FELT_AT * effective / modulus


def uneven_race(
    bearing: Bearing, ring: str, radius: float, effective: float
) -> tuple[np.ndarray, np.ndarray]:
    """Waves (3,) of the "inner" or "outer" ring's race: amplitude [m], order, azimuth of a crest;
    and its spall (5,): half angle, azimuth, depth, drop over the square of an angle, and half of
    the angle over which an edge is felt, 0 where there is none.

    ``radius``: the race's about the bearing's axis; ``effective``: that of element and race.
    """
    wave = [getattr(bearing, f"{ring}_waviness{of}") for of in ("", "_order", "_azimuth")]
    spall, bend = getattr(bearing, f"{ring}_spall"), radius**2 / (2.0 * effective)
    half = 0.5 * spall.length / radius
    felt = spread(effective, bearing.race_modulus) / radius if half else 0.0
    return np.array(wave, float), np.array([half, spall.azimuth, spall.depth, bend, felt])


def is_uneven(wave: np.ndarray, spall: np.ndarray) -> int:
    """1 if there is a wave or a spall (records hold no booleans)."""
    return int(wave[0] > 0.0 or spall[0] > 0.0)


@part
def wave_at(wave, phi):
    """How much larger the race's radius is by its waves at azimuth ``phi`` [rad] on the ring, and
    its slope over phi [m, m/rad]."""
    amplitude, order, crest = wave
    way = order * (phi - crest)
    return amplitude * cos(way), -amplitude * order * sin(way)


@part
def spall_depth(spall, phi):
    """How far an element sinks into a spall, >= 0, and its slope over phi [m, m/rad].

    Its centre goes down by (l - |x|)^2/(2 R) at a distance x from the spall's middle, as it turns
    about the edge at l, until it rolls on the bottom; of that the mean over the contact's width.
    """
    half, middle, depth, bend, felt = spall
    off = (phi - middle + pi) % (2.0 * pi) - pi
    return spall_depth_from_middle(off, half, depth, bend, felt)


@part
def spall_depth_from_middle(off, half, depth, bend, felt):
    """The same at ``off`` from the middle; all along the race by one measure, angle or length."""
    if abs(off) >= half + felt:
        return 0.0, 0.0
    before, after = off - felt, off + felt
    sunk = _depth_integral(after, half, depth, bend) - _depth_integral(before, half, depth, bend)
    rise = _sharp_depth(after, half, depth, bend) - _sharp_depth(before, half, depth, bend)
    return sunk / (2.0 * felt), rise / (2.0 * felt)


@part
def _sharp_depth(x, half, depth, bend):
    """How far an element sinks that feels an edge at a line."""
    beyond = max(half - abs(x), 0.0)
    return min(bend * beyond * beyond, depth)


@part
def _depth_integral(x, half, depth, bend):
    """Integral of ``_sharp_depth`` from the middle to x."""
    wall = min(sqrt(depth / bend), half)  # from the edge to the bottom
    beyond = max(half - abs(x), 0.0)
    if beyond >= wall:
        return depth * x
    bottom = half - wall
    return copysign(depth * bottom + bend * (wall**3 - beyond**3) / 3.0, x)


@outlined
def effective_penetration(race, phi, place, depth):
    """Effective depth of a ball at azimuth ``phi`` on its ring [rad] and angle ``place`` across
    the groove, which would press by ``depth`` into an even one; and its slopes over depth, phi and
    place. < 0: it does not touch.

    By that depth the normal law has the energy of all strips: of those beside the spall, and of
    those over it, that press by less. So forces are the slopes of one energy.
    """
    rise, turn = wave_at(race.wave, phi)
    sunk, steep = spall_depth(race.spall, phi)
    depth -= race.side * rise
    turn *= -race.side
    low, high = race.radius * (race.sides[0] - place), race.radius * (race.sides[1] - place)
    effective, by_depth, by_sunk, by_shift = _effective_depth(race.reach, low, high, sunk, depth)
    return effective, by_depth, by_depth * turn + by_sunk * steep, -race.radius * by_shift


@outlined
def spotted_penetration(race, spot, along, across, depth):
    """The same of a ball whose spot has its middle ``along`` and ``across`` the groove from the
    contact [m]; slopes over depth and both places. ``spot`` (4,): half of its length and width, its
    depth, the drop over the square of a length, and half of that over which an edge is felt."""
    half, deep, bend, felt = spot
    sunk, steep = spall_depth_from_middle(along, half, deep, bend, felt)
    effective, by_depth, by_sunk, by_shift = _effective_depth(
        race.reach, across - half, across + half, sunk, depth
    )
    return effective, by_depth, by_sunk * steep, by_shift


@part
def _effective_depth(c, low, high, sunk, depth):
    """Effective depth where strips from ``low`` to ``high`` across [m] press by ``sunk`` less
    than ``depth``; its slopes over depth, sunk and a shift of both sides."""
    if sunk <= 0.0 or depth <= 0.0:
        return depth, 1.0, 0.0, 0.0
    within = max(depth - sunk, 0.0)
    # of all strips: energy ~ d^2.5 and force ~ d^1.5 (Hertz), with the spall's at their own depth
    energy, force = _strip_shares(low, high, c * sqrt(depth))
    on, bears = depth**2.5 * (1.0 - energy), depth * sqrt(depth) * (1.0 - force)
    energy, force = _strip_shares(low, high, c * sqrt(within)) if within > 0.0 else (0.0, 0.0)
    on += within**2.5 * energy
    within_spall = within * sqrt(within) * force
    if on <= LEAST_SHARE * depth**2.5:
        return depth - sunk, 1.0, -1.0, 0.0
    effective = on**0.4  # an even race stores as much at this depth
    scale = 1.0 / (effective * sqrt(effective))
    across = _energy_at_edge(low, depth, within, c), _energy_at_edge(high, depth, within, c)
    return (
        effective,
        (bears + within_spall) * scale,
        -within_spall * scale,
        0.4 * (across[0] - across[1]) * scale,
    )


@part
def _strip_shares(low, high, half):
    """Shares of a contact's energy and force in its strips from ``low`` to ``high`` across [m], for
    half of the ellipse's length: 15/16 (1 - s^2)^2 ds and 3/4 (1 - s^2) ds."""
    a, b = min(max(low / half, -1.0), 1.0), min(max(high / half, -1.0), 1.0)
    a2, b2 = a * a, b * b
    energy = b * (15.0 - 10.0 * b2 + 3.0 * b2 * b2) - a * (15.0 - 10.0 * a2 + 3.0 * a2 * a2)
    force = b * (3.0 - b2) - a * (3.0 - a2)
    return energy / 16.0, force / 4.0


@part
def _energy_at_edge(y, depth, within, c):
    """What a spall's side at y takes: the difference of the energies there, per length across."""
    lower = y * y / (c * c)
    beside, within_spall = max(depth - lower, 0.0), max(within - lower, 0.0)
    return 15.0 / 16.0 / c * (beside * beside - within_spall * within_spall)
