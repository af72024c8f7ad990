"""What every bearing type's model takes from a case: its bodies, its land, and its cage's body."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.bodies.floating_frame import FlexibleBody, with_point_mass
from flexcage.contacts import laws
from flexcage.contacts.land import KINDS, NONE, LandData
from flexcage.contacts.ring_waves import no_waves
from flexcage.contacts.spec import LandSpec, Lubricant
from flexcage.geometry.bearing import Bearing, RingLand
from flexcage.geometry.cage import Cage
from flexcage.geometry.materials import Material
from flexcage.system import time_functions
from flexcage.system.data import Bodies, RingBody
from flexcage.system.layout import HELD_VELOCITIES
from flexcage.system.spec import WAVES, Drive, Load, Mount, Wave

YIELDS = [0, 1, 2, 4, 5]  # of a ring's velocities, those that a housing's compliance is of
CAGE_SKIN_FRICTION = 0.01  # assumption: turbulent skin friction of the cage's outer surface


def unbalanced(body: FlexibleBody, cage) -> FlexibleBody:
    """The cage's body with the point mass of its unbalance, at its mean radius and its offset."""
    return with_point_mass(body, *unbalance_of(cage)) if cage.unbalance else body


def unbalance_of(cage) -> tuple[float, np.ndarray]:
    """The point mass [kg] that makes the cage's unbalance, and its place (3,) in the cage [m]."""
    r = cage.mean_radius
    around = r * np.cos(cage.unbalance_phase), r * np.sin(cage.unbalance_phase)
    return cage.unbalance / r, np.array([cage.unbalance_offset, *around])


def _constant(value: float) -> np.ndarray:
    """Table (2, 2) of time [s] and a value that stays."""
    return np.array([[0.0, 1.0], [value, value]])


def _table(
    value: float, spec: Drive | Load, length: float, values: tuple[float, ...]
) -> np.ndarray:
    """Table (2, n) of time [s] and value: from ``value`` along the ramp, or over the times."""
    if spec.times:
        return np.array([spec.times, values], float)
    if spec.ramp_to is None:
        return _constant(value)
    start = spec.ramp_start
    return np.array([[start, start + max(length, 1e-12)], [value, spec.ramp_to]])


def _load_table(load: Load, along: str) -> np.ndarray:
    """Table (2, n) of time [s] and the "radial" or "axial" load [N], without its wave."""
    value: float = getattr(load, along)
    if load.varies != along:
        return _constant(value)
    return _table(value, load, load.ramp_time, load.values)


def loads_over(load: Load, times: np.ndarray) -> np.ndarray:
    """Radial and axial load [N] at times [s], (n, 2), as in a run."""
    loads = np.zeros((2, len(times)))
    for out, way in zip(loads, ("radial", "axial")):
        wave = np.array(_wave(load, load.wave_amplitude * (load.wave_of == way)))
        time_functions.time_function(_load_table(load, way), wave, times, out)
    return loads.T


def speeds_over(drive: Drive, times: np.ndarray) -> np.ndarray:
    """Speed [rad/s] that the inner ring is driven at, at times [s], (n,), as in a run."""
    speeds, wave = np.zeros(len(times)), np.array(_wave(drive, drive.wave_amplitude))
    time_functions.time_function(_speed_table(drive), wave, times, speeds)
    return speeds


def _speed_table(drive: Drive) -> np.ndarray:
    """Table (2, n) of time [s] and speed [rad/s], without its wave."""
    return _table(drive.speed, drive, drive.ramp_length, drive.speeds)


def heaviest_load(load: Load) -> float:
    """How many times as large as at the start the load on the inner ring grows, at the most."""
    largest = []
    for way in ("radial", "axial"):
        wave = load.wave_amplitude * (load.wave != "none" and load.wave_of == way)
        largest.append(np.abs(_load_table(load, way)[1]).max() + abs(wave))
    begin = np.hypot(*load.at_start)
    return float(max(np.hypot(*largest) / begin, 1.0)) if begin > 0.0 else 1.0


def _wave(spec: Wave, amplitude: float) -> tuple[float, float, float, float]:
    """Shape, share of a rise, amplitude and period as the kernels take them."""
    if spec.wave == "none" or amplitude == 0.0:
        return time_functions.NONE, 0.0, 0.0, 1.0
    shape = time_functions.SINE if spec.wave == "sine" else time_functions.TRAPEZOID
    return shape, WAVES[spec.wave], amplitude, spec.wave_period


def elastic_constants(material: Material) -> tuple[float, float]:
    """Modulus [Pa] and Poisson's ratio."""
    return material.youngs_modulus, material.poisson_ratio


def land_data(
    cage, spec: LandSpec, lubricant: Lubricant, modes: np.ndarray, *, kind: str, outer: bool,
    radius: float, bearing: Bearing, end: float | None = None,
) -> LandData:  # fmt: skip
    """Land of a cage, ``spec`` with clearance and width: is it its outside, its radius [m], and the
    bearing whose ring it meets. Its two lands end at ``end`` [m] from the middle, by default where
    cage or bearing does.

    ``modes`` (2, nl, 3, n) at the stations of the inner and the outer land.
    """
    ring = bearing.material
    long = min(cage.width, bearing.width) if end is None else 2.0 * end
    clearance, width = spec.clearance, spec.width
    assert clearance is not None and width is not None
    modes = modes[1 if outer else 0]  # (nl, 3, n)
    n_l = modes.shape[0]
    angle = 2.0 * np.pi * np.arange(n_l) / n_l
    n = modes.shape[-1]
    crest, borne = no_waves()
    k, e = laws.land_line_law(
        radius=radius,
        clearance=clearance,
        length=width,
        cage=elastic_constants(cage.warm_material),
        ring=elastic_constants(ring),
        depth=0.25 * (cage.outside_diameter - cage.bore),
    )
    normal = laws.normal_parameters(spec.normal, k, e)
    x = np.array([-0.5, 0.5]) * (long - width)
    phi = np.ascontiguousarray(modes)
    phi_max = np.abs(modes[:, 1]).max(axis=0) if n else np.zeros(0)
    return LandData(
        kind=KINDS[kind],
        inner=0 if outer else 1,
        clearance=clearance,
        radius=radius,
        x=x,
        angle=np.ascontiguousarray(np.stack([np.cos(angle), np.sin(angle)], axis=1)),
        phi=phi,
        phi_max=phi_max,
        normal=normal,
        friction=laws.friction_parameters(spec.friction),
        viscosity=lubricant.viscosity,
        width=width,
        crest=crest,
        borne=borne,
        other_kind=NONE,
        other_clearance=clearance,
        other_radius=radius,
        other_x=x,
        other_phi=phi,
        other_phi_max=phi_max,
        other_normal=normal,
    )


def land_on_stop(
    cage, spec: LandSpec, lubricant: Lubricant, modes: np.ndarray, *, stop: RingLand, outer: bool,
    bearing: Bearing,
) -> LandData:  # fmt: skip
    """What a cage meets on a ring that does not guide it: dry, with the laws of ``spec`` and the
    gap that the dimensions leave; none where ``spec`` has no land."""
    return land_data(
        cage, replace(spec, clearance=None, width=None).on(stop), lubricant, modes,
        kind="none" if spec.kind == "none" else "dry", outer=outer,
        radius=0.5 * (cage.outside_diameter if outer else cage.bore), bearing=bearing,
        end=stop.end,
    )  # fmt: skip


def bodies_of(
    bearing, cage: Cage | None, lubricant: Lubricant, drive: Drive, load: Load,
    *, element: np.ndarray, radius: np.ndarray, area: float,
) -> Bodies:  # fmt: skip
    """Elements, drive, loads and drag.

    ``element`` (3,): mass [kg] and inertias [kg m^2] of a rolling element, ``radius`` (Z,) [m]
    theirs, ``area`` [m^2] that one meets the oil with.
    """
    speed = _speed_table(drive)
    steps = 0.5 * np.diff(speed[0]) * (speed[1, 1:] + speed[1, :-1])
    rho = lubricant.density * lubricant.oil_fraction
    azimuth, skin = load.gravity_direction, _skin(cage) * _rows_in(cage, bearing)
    return Bodies(
        element=element,
        radius=radius,
        pitch=0.5 * bearing.pitch_diameter,
        gravity=load.gravity * np.array([0.0, np.cos(azimuth), np.sin(azimuth)]),
        drag=0.5 * rho * np.array([lubricant.drag_coefficient * area, skin]),
        by_shaft=int(drive.kind == "shaft"),
        shaft=np.array([drive.shaft_stiffness, drive.shaft_damping]),
        speed=speed,
        angle=np.concatenate([[0.0], np.cumsum(steps)]),
        load=_load_table(load, "radial"),
        axial=_load_table(load, "axial"),
        waves=np.array(
            [
                _wave(drive, drive.wave_amplitude),
                _wave(load, load.wave_amplitude * (load.wave_of == "radial")),
                _wave(load, load.wave_amplitude * (load.wave_of == "axial")),
            ]
        ),
        load_direction=np.array([np.cos(load.direction), np.sin(load.direction)]),
        moments=np.array([load.moment_y, load.moment_z]),
    )  # fmt: skip


def _rows_in(cage: Cage | None, bearing: Bearing) -> int:
    """So many rows of elements each cage of a bearing holds."""
    return bearing.row_count // cage.count_in(bearing) if cage else 0


def _skin(cage: Cage | None) -> float:
    """Friction coefficient times area times the radius cubed [m^5] of a cage's outside, on which
    the mixture drags."""
    if cage is None:
        return 0.0
    radius = 0.5 * cage.outside_diameter
    return CAGE_SKIN_FRICTION * 2.0 * np.pi * radius**4 * cage.axial_width


def inner_ring_of(bearing, drive: Drive, load: Load, *, free_axially: bool) -> RingBody:
    """The inner ring on its shaft."""
    tilts = load.tilt == "free"
    free = np.array([free_axially, True, True, drive.kind == "shaft", tilts, tilts])
    stiffness, damping = np.zeros((2, 6, 6))
    sprung = list(HELD_VELOCITIES[:3])
    stiffness[sprung, sprung] = load.stiffness * free[sprung]
    damping[sprung, sprung] = load.damping * free[sprung]
    return RingBody(
        inertia=np.array([bearing.inner_ring_mass + load.shaft_mass, *bearing.inner_ring_inertia]),
        free=free.astype(np.int64),
        stands=int(load.centre != "free"),
        stiffness=stiffness,
        damping=damping,
        rest=np.array([0.0, 0.0, 0.0, 0.0, 0.0, load.misalignment]),
        loose=0,
        bore=np.zeros(3),
    )


def outer_ring_of(bearing, mount: Mount) -> RingBody:
    """The outer ring on its mount, without an elastic body as its housing (``in_housing``). What
    moves with it has its radii of gyration (an assumption)."""
    mass = bearing.outer_ring_mass + mount.mass
    moves, loose = mount.kind != "fixed", mount.kind == "contact"
    stiffness, damping = np.zeros((2, 6, 6))
    free = np.array([0, 1, 1, 0, 0, 0]) * moves
    if moves and not loose:
        springs = np.zeros(6)
        springs[YIELDS] = bushing_stiffness(mount)
        dampers = np.zeros(6)
        dampers[YIELDS] = (
            mount.axial_damping, mount.damping, mount.damping, mount.tilt_damping,
            mount.tilt_damping,
        )  # fmt: skip
        stiffness, damping, free = np.diag(springs), np.diag(dampers), 1 * (springs > 0.0)
    turns = np.array(bearing.outer_ring_inertia) * mass / bearing.outer_ring_mass
    return RingBody(
        inertia=np.array([mass, *turns]),
        free=free,
        stands=0,
        stiffness=stiffness,
        damping=damping,
        rest=np.zeros(6),
        loose=int(loose),
        bore=np.array([mount.stiffness, mount.damping, mount.clearance]),
    )


def bushing_stiffness(mount: Mount) -> np.ndarray:
    """Stiffness (5,) of a bushing along x, y, z [N/m] and in tilt about y and z [N m/rad]; 0: it
    holds the ring."""
    tilt = mount.tilt_stiffness
    return np.array([mount.axial_stiffness, mount.stiffness, mount.stiffness, tilt, tilt])


def in_housing(ring: RingBody, compliance: np.ndarray, late: float) -> RingBody:
    """An outer ring whose seat yields by ``compliance`` (5, 5) in x, y, z and the tilts about y and
    z, or holds it where that is zero, and is damped by its stiffness times ``late`` [s]."""
    yields = np.diag(compliance) > 0.0
    stiffness, own = np.zeros((6, 6)), np.array(YIELDS)[yields]
    stiffness[np.ix_(own, own)] = np.linalg.inv(compliance[np.ix_(yields, yields)])
    free = np.zeros(6, np.int64)
    free[own] = 1
    return ring._replace(free=free, stiffness=stiffness, damping=late * stiffness)
