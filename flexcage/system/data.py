"""The arrays that all bearings' kernels share: bodies, contact memory, report, workspaces."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from flexcage.bodies.floating_frame import FrameWork, frame_work
from flexcage.contacts.evaluation import N_RACE, N_SUMS
from flexcage.contacts.land import LandWork, land_work
from flexcage.contacts.pocket_wall import N_LOCAL, filled
from flexcage.contacts.race import RaceWork
from flexcage.contacts.slices import Slices, new_slices
from flexcage.contacts.state import KEPT, Pair, RollerPose, new_pair, new_pose
from flexcage.core.vectors import RIGID
from flexcage.system.layout import Layout

POWERS = (
    "drive",
    "load",
    "gravity",
    "race_damping",
    "race_friction",
    "rolling_resistance",
    "pocket_damping",
    "pocket_friction",
    "neighbour_damping",
    "neighbour_friction",
    "rib_damping",
    "rib_friction",
    "land_damping",
    "land_friction",
    "film",
    "drag",
    "modal_damping",
    "mount",
    "constraints",
)
(
    DRIVE, LOAD, GRAVITY, RACE_DAMPING, RACE_FRICTION, ROLLING_RESISTANCE, POCKET_DAMPING,
    POCKET_FRICTION, NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION, RIB_DAMPING, RIB_FRICTION,
    LAND_DAMPING, LAND_FRICTION, FILM, DRAG, MODAL_DAMPING, MOUNT, CONSTRAINTS,
) = range(len(POWERS))  # fmt: skip
EXCHANGED = RACE_DAMPING  # so many, the first ones, the bearing exchanges with the outside
# contact places of an element; from POCKET on the faces of its pocket, then ribs
INNER_RACE, OUTER_RACE, POCKET = range(3)
MASS, AXIAL, TRANSVERSE = range(3)  # in ``Bodies.element``, ``RingBody.inertia``: mass, inertias
RING_AXIS, RING_SPIN = range(2)  # of ``Scratch.rings``
OF_SPEED, OF_LOAD, OF_AXIAL = range(3)  # rows of ``Bodies.waves``
SHAFT_STIFFNESS, SHAFT_DAMPING = range(2)  # places in ``Bodies.shaft``
EVENT_TIME, EVENT_ELEMENT, EVENT_PLACE, EVENT_CLOSED = range(4)  # in a row of ``Events.rows``
LANDS, OTHER_LAND = 4, 2  # lands of each cage at -x, +x on its guiding ring, then on the other one
KINETIC, STRAIN, IN_CONTACTS, IN_MOUNT = range(4)  # places in ``Report.energy``
# places in ``law`` behind those of ``contacts.evaluation``: the rows of further constraints, what
# puts these in (``constraint_equations``), and the family's functions ``separate``
CONSTRAINT_EQUATIONS, HOLD, FAMILY_PARTS = 10, 11, 12
# rows of ``Scratch.vec``: of the cage under work in space; of the pair under work, in the roller's
# frame F; of lands, forces and moments on the cage and on the ring that they meet
(
    CAGE_SPIN, LEVER, PARTNER_V, PARTNER_W, CAGE_FORCE, CAGE_MOMENT, RING_FORCE, RING_MOMENT, N_VEC,
) = range(9)  # fmt: skip


class Bodies(NamedTuple):
    """Masses and what acts on bodies apart from contacts."""

    element: np.ndarray  # (3,) of a rolling element: mass, axial and transverse inertia
    radius: np.ndarray  # (Z,) roller radii
    pitch: float  # radius of the pitch circle
    gravity: np.ndarray  # (3,)
    drag: np.ndarray  # (2,) roller 0.5 rho C A, cage 0.5 rho C_f 2 pi r^4 b
    by_shaft: int  # 1 if a compliant shaft drives (records hold no booleans)
    shaft: np.ndarray  # (2,) stiffness, damping
    speed: np.ndarray  # (2, n) table of time and speed
    angle: np.ndarray  # (n,) drive angle at the table's times
    load: np.ndarray  # (2, m) table of time and radial load
    axial: np.ndarray  # (2, k) table of time and axial load
    load_direction: np.ndarray  # (2,) y, z
    waves: np.ndarray  # (3, 4) of speed, radial load, axial load, see time_functions.py
    moments: np.ndarray  # (2,) about y and z on the inner ring


class RingBody(NamedTuple):
    """A ring: its mass, and what holds it to the ground. Arrays of six are in the order of its
    velocities: x, y, z, spin, skew, tilt."""

    inertia: np.ndarray  # (3,) mass, axial and transverse inertia, with what moves with it
    free: np.ndarray  # (6,) 1 where it is free; else it is held or driven
    stands: int  # 1: its centre stays where it is
    stiffness: np.ndarray  # (6, 6) of springs, zero where it is held, and about the axis
    damping: np.ndarray  # (6, 6)
    rest: np.ndarray  # (6,) coordinates at which springs rest, or it is held
    loose: int  # 1: it lies in a bore with clearance, which presses on it
    bore: np.ndarray  # (3,) of that: stiffness, damping, clearance
    # of a ring with M modes of unit mass: inertia that each has in common with the ring's motions,
    # and the inverse of the mass matrix of all that is free
    coupling: np.ndarray = np.zeros((RIGID, 0))
    inverse: np.ndarray = np.zeros((0, 0))
    spare: np.ndarray = np.zeros(0)


class Memory(NamedTuple):
    """What contacts remember of accepted points: the speeds [m/s] at which they closed, and where
    the pockets' walls were."""

    race: np.ndarray  # (Z, 2)
    pocket: np.ndarray  # (Z, faces)
    rib: np.ndarray  # (Z, ribs)
    land: np.ndarray  # (cages LANDS,)
    deflection: np.ndarray  # (Z, 12) residual coordinates of the pockets, to begin the next solve


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
    held: np.ndarray  # (m, bodies' velocities) G of further constraints, where it acts
    active: np.ndarray  # (Z,) roller touches its pocket
    turns: np.ndarray  # (3,) places in an element's coordinates of what its rotations turn


class Report(NamedTuple):
    """What one evaluation reports beyond the residual (mode REPORT)."""

    race: np.ndarray  # (Z, 2, N_RACE) ``sums`` of a race up to ROLLED
    pocket_normal: np.ndarray  # (Z, faces)
    pocket_friction: np.ndarray  # (Z, faces)
    slice_normal: np.ndarray  # (Z, 2, ns)
    slice_friction: np.ndarray  # (Z, 2, ns)
    point_normal: np.ndarray  # (Z, 2, np) of a roller's end on side beams
    point_friction: np.ndarray  # (Z, 2, np)
    station: np.ndarray  # (Z, faces, nst, 3)
    residual: np.ndarray  # (Z, 12)
    rib: np.ndarray  # (Z, ribs)
    # of lands, one cage after the other: (3 cages,); (cages nl, 2) on the cage, outwards and
    # forwards, (2 cages nl, 2) if it may meet the other ring, too; (cages LANDS, 2) normal force
    # and approach speed at -x, +x
    land: np.ndarray
    land_station: np.ndarray
    land_touch: np.ndarray
    power: np.ndarray  # (len(POWERS),)
    energy: np.ndarray  # (4,) places as above; that of the mount holds the shaft's springs too
    contact: np.ndarray  # (Z, places) booleans: races 2, faces of the pocket, ribs
    approach: np.ndarray  # (Z, places) approach speed of each
    outer_wrench: np.ndarray  # (6,) of contacts on the outer ring, in space, about its centre
    outer_races: np.ndarray  # (6,) the share of its races


def new_memory(report: Report) -> Memory:
    """That of contacts which closed at rest; as many as ``report`` tells of."""
    z, like = np.zeros, np.zeros_like
    return Memory(
        z((len(report.rib), 2)), like(report.pocket_normal), like(report.rib),
        z(len(report.land_touch)),
        like(report.residual),
    )  # fmt: skip


class Scratch(NamedTuple):
    """Small buffers of the residual."""

    S: np.ndarray  # (6, 6)
    T6: np.ndarray  # (2, 6, 6) products
    R: np.ndarray  # (2, 3, 3)
    A: np.ndarray  # (3, 3) attitude of the cage under work
    unit: np.ndarray  # (3, 3) unit matrix
    poses: np.ndarray  # (Z, KEPT, 3) of the rollers, see ``keep_pose``
    wrenches: np.ndarray  # (Z, 6) of all contacts on each element
    sums: np.ndarray  # (N_SUMS,) see ``contacts.evaluation``
    vec: np.ndarray  # (N_VEC, 3), rows as above
    rings: np.ndarray  # (2, 2, 3) of both rings, in space: axis and angular velocity
    held: np.ndarray  # (2,) force of the outer ring on its bore, y and z
    pull: np.ndarray  # (6,) of springs on a ring
    border: np.ndarray  # (bodies' velocities,) generalised forces on bodies
    shift: np.ndarray  # (bodies' velocities,) displacement of bodies
    moved: np.ndarray  # (bodies' coordinates,) what it makes of these
    modal: np.ndarray  # (2, n8) modal coordinates and rates, filled up with zeros
    out: np.ndarray  # (size,) residual that nobody asked for


class Work(NamedTuple):
    """Workspaces of one evaluation."""

    pose: RollerPose
    slices: Slices
    pair: Pair
    race_work: RaceWork
    pocket_work: Any  # of the pockets' kernel
    land_work: LandWork
    frame: FrameWork
    scratch: Scratch
    tangent: Tangent
    report: Report


def new_work(
    layout: Layout, race_work: RaceWork, pocket_work: Any, *, slices: int, points: int,
    faces: int, stations: int, ribs: int, land_stations: int, turns: tuple[int, int, int],
    other_land: bool = False,
) -> Work:  # fmt: skip
    """Fresh workspaces for one thread, of elements with so many contact places; ``turns`` as
    ``Tangent`` has it; ``other_land``: the cage may meet the ring that does not guide it."""
    Z, n, nb, bodies = layout.elements, layout.modes, layout.n_border, layout.places.border
    cages = max(layout.cages, 1)
    places = 2 + faces + ribs
    z = np.zeros
    tangent = Tangent(
        z((Z, 6, 6)), z((Z, 6, 6)), z((Z, 6, nb)), z((Z, 6, nb)), z((Z, nb, 6)), z((Z, nb, 6)),
        z((nb, nb)), z((nb, nb)), z((nb, nb)), z((len(layout.held), bodies)), z(Z, np.int64),
        np.array(turns),
    )  # fmt: skip
    report = Report(
        z((Z, 2, N_RACE)), z((Z, faces)), z((Z, faces)), z((Z, 2, slices)), z((Z, 2, slices)),
        z((Z, 2, points)), z((Z, 2, points)),
        z((Z, faces, stations, 3)), z((Z, N_LOCAL)), z((Z, ribs)), z(3 * cages),
        z((cages * land_stations * (2 if other_land else 1), 2)), z((cages * LANDS, 2)),
        z(len(POWERS)), z(4),
        z((Z, places), np.int64), z((Z, places)), z(6), z(6),
    )  # fmt: skip
    scratch = Scratch(
        z((6, 6)), z((2, 6, 6)), z((2, 3, 3)), z((3, 3)), np.eye(3), z((Z, KEPT, 3)), z((Z, 6)),
        z(N_SUMS), z((N_VEC, 3)), z((2, 2, 3)), z(2), z(6), z(bodies), z(bodies),
        z(layout.places.coordinates), z((2, filled(n, 8))), z(layout.size),
    )  # fmt: skip
    return Work(
        new_pose(), new_slices(), new_pair(), race_work, pocket_work, land_work(land_stations),
        frame_work(n, layout.cages), scratch, tangent, report,
    )  # fmt: skip
