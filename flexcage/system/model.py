"""From specs to the arrays that kernels read: one constant model, one workspace."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flexcage.bodies.floating_frame import (
    BodyData,
    FlexibleBody,
    FrameWork,
    frame_work,
    with_point_mass,
)
from flexcage.contacts import laws
from flexcage.contacts.land import LandData, LandWork, land_work
from flexcage.contacts.pocket_wall import (
    N_LOCAL,
    PocketData,
    PocketWork,
    pocket_work,
    with_end_stations,
)
from flexcage.contacts.race import RaceSide
from flexcage.contacts.rib import RibData
from flexcage.contacts.slices import Slices, new_slices
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.contacts.state import Pair, RollerPose, new_pair, new_pose
from flexcage.geometry.cages import WindowCage
from flexcage.geometry.cylindrical_roller import RollerBearing
from flexcage.modes.basis import CageInterface
from flexcage.system.layout import N_LAMBDA, N_MU, Layout
from flexcage.system.spec import Drive, Load, Mount

POWERS = (
    "drive",
    "load",
    "gravity",
    "race_damping",
    "race_friction",
    "rolling_resistance",
    "pocket_damping",
    "pocket_friction",
    "rib",
    "land",
    "drag",
    "modal_damping",
    "mount",
)
CAGE_SKIN_FRICTION = 0.01  # assumption: turbulent skin friction of the cage's outer surface


class Bodies(NamedTuple):
    """Masses and what acts on bodies apart from contacts."""

    roller: np.ndarray  # (3,) mass, axial and transverse inertia
    radius: np.ndarray  # (Z,) roller radii
    ring: np.ndarray  # (3,) inner ring with what moves with it
    outer: np.ndarray  # (5,) mass, stiffness, damping, 1.0 if fixed, clearance (< 0: a bushing)
    gravity: np.ndarray  # (3,)
    drag: np.ndarray  # (2,) roller 0.5 rho C A, cage 0.5 rho C_f 2 pi r^4 b
    drive: np.ndarray  # (3,) 1.0 if through a shaft, stiffness, damping
    speed: np.ndarray  # (2, n) table of time and speed
    angle: np.ndarray  # (n,) drive angle at the table's times
    load: np.ndarray  # (2, m) table of time and radial load
    load_direction: np.ndarray  # (2,) y, z
    misalignment: float


class Memory(NamedTuple):
    """Law parameters of every pair; slot 3 keeps the onset speed of a contact."""

    race: np.ndarray  # (Z, 2, N_NORMAL)
    pocket: np.ndarray  # (Z, 4, N_NORMAL)
    rib: np.ndarray  # (Z, 2, N_NORMAL)
    land: np.ndarray  # (2, N_NORMAL)
    deflection: np.ndarray  # (Z, 8) residual coordinates of the pockets, to begin the next solve


class Model(NamedTuple):
    """Everything constant that the residual reads."""

    bodies: Bodies
    cage: BodyData
    inner: RaceSide
    outer: RaceSide
    rib: RibData
    pocket: PocketData
    land: LandData


class Tangent(NamedTuple):
    """Stiffness K and damping C of Newton's matrix in blocks: rollers r, border b."""

    Krr: np.ndarray  # (Z, 6, 6)
    Crr: np.ndarray
    Krb: np.ndarray  # (Z, 6, nb)
    Crb: np.ndarray
    Kbr: np.ndarray  # (Z, nb, 6)
    Cbr: np.ndarray
    Kbb: np.ndarray  # (nb, nb)
    Cbb: np.ndarray
    Mbb: np.ndarray  # (nb, nb)
    active: np.ndarray  # (Z,) roller touches its pocket


class Report(NamedTuple):
    """What one evaluation reports beyond the residual (mode 2)."""

    race: np.ndarray  # (Z, 2, 9) sums of race_contact
    pocket_normal: np.ndarray  # (Z, 4)
    pocket_friction: np.ndarray  # (Z, 4)
    slice_normal: np.ndarray  # (Z, 2, ns)
    slice_friction: np.ndarray  # (Z, 2, ns)
    station: np.ndarray  # (Z, 4, nst, 3)
    residual: np.ndarray  # (Z, 8)
    rib: np.ndarray  # (Z, 2)
    land: np.ndarray  # (3,)
    land_touch: np.ndarray  # (2, 2) of the lands at -x, +x: normal force, approach speed
    power: np.ndarray  # (len(POWERS),)
    energy: np.ndarray  # (4,) kinetic, strain, contact, mount
    contact: np.ndarray  # (Z, 8) booleans: races 2, pocket faces 4, ribs 2
    approach: np.ndarray  # (Z, 8) approach speed of each
    body_force: np.ndarray  # (3,) contact force on the outer ring


class Scratch(NamedTuple):
    """Small buffers of the residual."""

    S: np.ndarray  # (6, 6)
    T6: np.ndarray  # (2, 6, 6) products
    R: np.ndarray  # (2, 3, 3)
    A: np.ndarray  # (3, 3) cage attitude
    unit: np.ndarray  # (3, 3) unit matrix
    roller: np.ndarray  # (6,) wrench of all contacts on one roller
    sums: np.ndarray  # (9,)
    vec: np.ndarray  # (9, 3), see residual.py
    border: np.ndarray  # (nb,) generalised forces on the border
    Lm: np.ndarray  # (6, n) roller-modal products
    Bm: np.ndarray  # (n, 6)
    PR: np.ndarray  # (n, 8) modal-residual products
    out: np.ndarray  # (size,) residual that nobody asked for


class Work(NamedTuple):
    """Workspaces of one evaluation."""

    pose: RollerPose
    slices: Slices
    pair: Pair
    pocket: PocketWork
    land: LandWork
    frame: FrameWork
    scratch: Scratch
    tangent: Tangent
    report: Report


def _table(value, ramp_to, start, length, times, values) -> np.ndarray:
    if len(times) > 0:
        return np.array([times, values], float)
    if ramp_to is None:
        return np.array([[0.0, 1.0], [value, value]])
    return np.array([[start, start + max(length, 1e-12)], [value, ramp_to]])


def slice_grid(bearing: RollerBearing, slices: int) -> tuple[np.ndarray, np.ndarray]:
    """Slice centres (n,) on the effective length, and the profile's drop there (n,) [m]."""
    width = bearing.effective_length / slices
    s = (np.arange(slices) + 0.5) * width - 0.5 * bearing.effective_length
    drop = bearing.profile.drop(
        s, diameter=bearing.roller_diameter, length=bearing.effective_length
    )
    return s, drop


def _race_side(bearing, contacts: Contacts, lubricant: Lubricant, *, inner: bool) -> RaceSide:
    s, drop = slice_grid(bearing, contacts.race.slices)
    sign = 1.0 if inner else -1.0
    radius = bearing.inner_race_radius if inner else bearing.outer_race_radius
    rw = 0.5 * bearing.roller_diameter
    equivalent = rw * radius / (radius + sign * rw)
    modulus = bearing.material.plane_strain_modulus  # E' = 2/(2 (1-nu^2)/E)
    wave = (
        (bearing.inner_waviness, bearing.inner_waviness_order)
        if inner
        else (bearing.outer_waviness, bearing.outer_waviness_order)
    )
    return RaceSide(
        sign=sign,
        radius=radius,
        s=s,
        drop=drop,
        friction=laws.friction_parameters(contacts.race.friction),
        rolling=laws.rolling_resistance(lubricant, equivalent, bearing.effective_length, modulus),
        hydro=2.0 * equivalent / rw,
        wave=np.array(wave, float),
    )


def end_points(bearing: RollerBearing, cage: WindowCage) -> np.ndarray:
    """Points (14, 2) of a roller's end over the band that a side beam covers, as offsets along e_r
    and e_psi [m]: 2-point Gauss across the band by 7-point Gauss along it, enough to feel a
    side beam that is bent within one pocket."""
    low = max(0.5 * cage.bore - bearing.pitch_radius, -0.45 * bearing.roller_diameter)
    high = min(0.5 * cage.outside_diameter - bearing.pitch_radius, 0.45 * bearing.roller_diameter)
    across = 0.5 * (low + high) + 0.5 * (high - low) * np.array([-1.0, 1.0]) / np.sqrt(3.0)
    reach = np.sqrt((0.45 * bearing.roller_diameter) ** 2 - max(abs(low), abs(high)) ** 2)
    along = reach * np.polynomial.legendre.leggauss(7)[0]
    return np.array([(y, z) for y in across for z in along])


def rib_points(bearing: RollerBearing) -> np.ndarray:
    """Three points (3, 2) of a roller's end over the rib, halfway up the overlap [m]."""
    rw = 0.5 * bearing.roller_diameter
    y = -0.5 * (bearing.pitch_radius - 0.5 * bearing.rib_diameter + 0.9 * rw)
    reach = np.sqrt(max((0.9 * rw) ** 2 - y**2, 0.0))
    return np.array([(y, -0.7 * reach), (y, 0.0), (y, 0.7 * reach)])


def _elastic(material) -> tuple[float, float]:
    return material.youngs_modulus, material.poisson_ratio


def crossbeam_width(bearing: RollerBearing, cage: WindowCage) -> float:
    """Width of a crossbeam at the pitch radius [m]."""
    return 2.0 * np.pi * bearing.pitch_radius / bearing.roller_count - cage.pocket_width


def _guiding_land(bearing: RollerBearing, cage: WindowCage) -> tuple[bool, float, float]:
    """Is the cage's outside its land, that land's radius, and its clearance on the ring [m]?"""
    if cage.guidance == "outer":
        radius = 0.5 * cage.outside_diameter
        return True, radius, bearing.outer_race_radius - radius
    radius = 0.5 * cage.bore
    return False, radius, radius - 0.5 * bearing.rib_diameter


def build_memory(bearing, cage, contacts: Contacts, interface: CageInterface) -> Memory:
    """Law parameters of every contact pair, per slice or point."""
    Z, flexible = bearing.roller_count, interface.modes.shape[-1] > 0
    steel, wall = _elastic(bearing.material), _elastic(cage.material)
    rw = 0.5 * bearing.roller_diameter
    n = contacts.race.slices
    k_race = laws.iso_line_stiffness(bearing.effective_length) / n
    race = laws.normal_parameters(contacts.race.normal, k_race, 10.0 / 9.0)
    k, e = laws.pocket_line_law(
        radius=rw,
        length=bearing.effective_length,
        roller=steel,
        wall=wall,
        depth=0.5 * crossbeam_width(bearing, cage),
        patch_half_width=interface.patch_half_width if flexible else 0.0,
    )
    pocket = laws.normal_parameters(contacts.pocket.normal, k / contacts.pocket.slices, e)
    k_end = laws.flat_end_stiffness(0.9 * rw, steel, wall)
    points = len(end_points(bearing, cage))
    side = laws.normal_parameters(contacts.side.normal, k_end / points, 1.0)
    k_rib = laws.flat_end_stiffness(0.45 * rw, steel, steel)
    rib = laws.normal_parameters(contacts.rib.normal, k_rib / 3, 1.0)
    _, radius, clearance = _guiding_land(bearing, cage)
    k, e = laws.land_line_law(
        radius=radius,
        clearance=clearance,
        length=contacts.land.width,
        cage=wall,
        ring=steel,
        depth=0.25 * (cage.outside_diameter - cage.bore),
    )
    land = laws.normal_parameters(contacts.land.normal, k, e)
    return Memory(
        race=np.tile(race, (Z, 2, 1)),
        pocket=np.array([[pocket, pocket, side, side]] * Z),
        rib=np.tile(rib, (Z, 2, 1)),
        land=np.tile(land, (2, 1)),
        deflection=np.zeros((Z, N_LOCAL)),
    )


def compliance_root(compliance: np.ndarray) -> np.ndarray:
    """L (Z, n, n) with L L^T the compliance (Z, n, n), which may be singular."""
    values, vectors = np.linalg.eigh(compliance)
    return np.ascontiguousarray(vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :])


def _pocket_data(bearing, cage, contacts: Contacts, interface: CageInterface) -> PocketData:
    s, drop = slice_grid(bearing, contacts.pocket.slices)
    angle = 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
    normal = np.stack(
        [interface.modes[:, f, :, 2 if f < 2 else 0] for f in range(4)], axis=1
    )  # (Z, 4, nst, n)
    n = interface.modes.shape[-1]
    at = interface.stations if interface.offset_at is None else interface.offset_at
    st = np.ascontiguousarray
    root = compliance_root(interface.compliance)
    res = with_end_stations(np.einsum("zfsa,zab->zfsb", interface.residual, root))
    return PocketData(
        azimuth=st(np.stack([np.cos(angle), np.sin(angle)], axis=1)),
        half=0.5 * np.array([cage.pocket_width, cage.pocket_length]),
        s=s,
        drop=drop,
        points=end_points(bearing, cage),
        half_roller=0.5 * bearing.roller_length,
        x0=st(interface.stations[:, 0]),
        dx=st(interface.stations[:, 1] - interface.stations[:, 0]),
        offset=st(interface.offset),
        grid=st(np.stack([at[:, 0], at[:, 1] - at[:, 0]])),
        low=interface.offset.min(axis=2),
        bent=np.any(interface.offset, axis=2).astype(np.int64),
        phi=st(interface.modes),
        phi_max=np.abs(normal).max(axis=(0, 1, 2)) if n else np.zeros(0),
        soft=int(interface.compliance.any()),
        res=res,
        res_max=np.abs(res).max(axis=2),
        root=root,
        friction=np.stack(
            [
                laws.friction_parameters(contacts.pocket.friction),
                laws.friction_parameters(contacts.side.friction),
            ]
        ),
    )


def _land_data(bearing, cage: WindowCage, contacts: Contacts, lubricant, interface) -> LandData:
    outer, radius, clearance = _guiding_land(bearing, cage)
    spec = contacts.land
    modes = interface.land[1 if outer else 0]  # (nl, 3, n)
    n_l = modes.shape[0]
    angle = 2.0 * np.pi * np.arange(n_l) / n_l
    n = modes.shape[-1]
    return LandData(
        kind={"none": 0, "dry": 1, "film": 2}[spec.kind],
        inner=-1.0 if outer else 1.0,
        clearance=clearance,
        radius=radius,
        x=np.array([-0.5, 0.5]) * (cage.width - spec.width),
        angle=np.ascontiguousarray(np.stack([np.cos(angle), np.sin(angle)], axis=1)),
        phi=np.ascontiguousarray(modes),
        phi_max=np.abs(modes[:, 1]).max(axis=0) if n else np.zeros(0),
        friction=laws.friction_parameters(spec.friction),
        film=np.array([lubricant.viscosity, spec.width, radius, clearance]),
    )


def _bodies(bearing, cage, lubricant, drive: Drive, load: Load, mount: Mount, seed: int) -> Bodies:
    rng = np.random.default_rng(seed)
    scatter = bearing.roller_scatter * rng.standard_normal(bearing.roller_count)
    speed = _table(
        drive.speed, drive.ramp_to, drive.ramp_start, drive.ramp_time, drive.times, drive.speeds
    )
    steps = 0.5 * np.diff(speed[0]) * (speed[1, 1:] + speed[1, :-1])
    rho = lubricant.density * lubricant.oil_fraction
    area = bearing.roller_diameter * bearing.roller_length
    ro = 0.5 * cage.outside_diameter
    fixed = mount.kind == "fixed"
    azimuth = load.gravity_direction
    return Bodies(
        roller=np.array([bearing.roller_mass, *bearing.roller_inertia]),
        radius=0.5 * (bearing.roller_diameter + scatter),
        ring=np.array([bearing.inner_ring_mass + load.shaft_mass, *bearing.inner_ring_inertia]),
        outer=np.array(
            [
                bearing.outer_ring_mass + mount.mass,
                mount.stiffness,
                mount.damping,
                float(fixed),
                mount.clearance if mount.kind == "contact" else -1.0,
            ]
        ),
        gravity=load.gravity * np.array([0.0, np.cos(azimuth), np.sin(azimuth)]),
        drag=np.array(
            [
                0.5 * rho * lubricant.drag_coefficient * area,
                0.5 * rho * CAGE_SKIN_FRICTION * 2.0 * np.pi * ro**4 * cage.width,
            ]
        ),
        drive=np.array([float(drive.kind == "shaft"), drive.shaft_stiffness, drive.shaft_damping]),
        speed=speed,
        angle=np.concatenate([[0.0], np.cumsum(steps)]),
        load=_table(
            load.radial, load.ramp_to, load.ramp_start, load.ramp_time, load.times, load.values
        ),
        load_direction=np.array([np.cos(load.direction), np.sin(load.direction)]),
        misalignment=load.misalignment,
    )


def build_model(
    bearing: RollerBearing,
    cage: WindowCage,
    body: FlexibleBody,
    interface: CageInterface,
    *,
    contacts: Contacts,
    lubricant: Lubricant,
    drive: Drive,
    load: Load,
    mount: Mount,
    seed: int = 0,
) -> tuple[Model, Memory]:
    """Arrays of one bearing for the kernels, and the law parameters with their memory."""
    if cage.unbalance > 0.0:
        r = cage.mean_radius
        where = r * np.array([0.0, np.cos(cage.unbalance_phase), np.sin(cage.unbalance_phase)])
        body = with_point_mass(body, cage.unbalance / r, where)
    model = Model(
        bodies=_bodies(bearing, cage, lubricant, drive, load, mount, seed),
        cage=body.data,
        inner=_race_side(bearing, contacts, lubricant, inner=True),
        outer=_race_side(bearing, contacts, lubricant, inner=False),
        rib=RibData(
            half_gap=0.5 * bearing.rib_gap,
            half_roller=0.5 * bearing.roller_length,
            points=rib_points(bearing),
            friction=laws.friction_parameters(contacts.rib.friction),
        ),
        pocket=_pocket_data(bearing, cage, contacts, interface),
        land=_land_data(bearing, cage, contacts, lubricant, interface),
    )
    return model, build_memory(bearing, cage, contacts, interface)


def new_work(model: Model, layout: Layout) -> Work:
    """Fresh workspaces for one thread."""
    Z, n, nb = layout.rollers, layout.modes, layout.n_border
    ns, nst = len(model.pocket.s), model.pocket.phi.shape[2]
    z = np.zeros
    tangent = Tangent(
        z((Z, 6, 6)), z((Z, 6, 6)), z((Z, 6, nb)), z((Z, 6, nb)), z((Z, nb, 6)), z((Z, nb, 6)),
        z((nb, nb)), z((nb, nb)), z((nb, nb)), z(Z, np.int64),
    )  # fmt: skip
    report = Report(
        z((Z, 2, 9)), z((Z, 4)), z((Z, 4)), z((Z, 2, ns)), z((Z, 2, ns)), z((Z, 4, nst, 3)),
        z((Z, 8)), z((Z, 2)), z(3), z((2, 2)), z(len(POWERS)), z(4), z((Z, 8), np.int64), z((Z, 8)),
        z(3),
    )  # fmt: skip
    scratch = Scratch(
        z((6, 6)), z((2, 6, 6)), z((2, 3, 3)), z((3, 3)), np.eye(3), z(6), z(9), z((9, 3)),
        z(14 + n), z((6, n)), z((n, 6)), z((n, 8)), z(layout.size),
    )  # fmt: skip
    return Work(
        new_pose(), new_slices(), new_pair(), pocket_work(ns, nst),
        land_work(len(model.land.angle)), frame_work(n), scratch, tangent, report,
    )  # fmt: skip


__all__ = ["Bodies", "Memory", "Model", "N_LAMBDA", "N_MU", "POWERS", "Work", "build_model"]
