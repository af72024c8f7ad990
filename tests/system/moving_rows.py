"""Double row bearings in motion as tests take them: a 3205, a 1205, an NN 3010, at their start."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.case import Case
from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant, NormalLaw, PairSpec
from flexcage.spec import (
    DoubleRowAngularContactBallBearing,
    DoubleRowRollerBearing,
    Drive,
    Load,
    SelfAligningBallBearing,
)
from flexcage.stages import assembled_start, bearing_in_motion, cage_mesh

MM, UM = 1e-3, 1e-6
B3205 = DoubleRowAngularContactBallBearing(
    bore=25 * MM, outside_diameter=52 * MM, width=20.6 * MM, pitch_diameter=38.5 * MM,
    ball_diameter=7.938 * MM, ball_count=9, inner_groove_radius=4.088 * MM,
    outer_groove_radius=4.167 * MM, contact_angle=np.radians(30.0), row_distance=9.5 * MM,
    axial_clearance=-5 * UM,
)  # fmt: skip
FACE_TO_FACE = replace(B3205, arrangement="face_to_face", axial_clearance=0.0)
B1205 = SelfAligningBallBearing(
    bore=25 * MM, outside_diameter=52 * MM, width=15 * MM, pitch_diameter=38.5 * MM,
    ball_diameter=7.5 * MM, ball_count=12, inner_groove_radius=3.975 * MM, row_distance=7 * MM,
    radial_clearance=5 * UM,
)  # fmt: skip
NN3010 = DoubleRowRollerBearing(
    bore=50 * MM, outside_diameter=80 * MM, width=23 * MM, inner_race_diameter=58 * MM,
    outer_race_diameter=72 * MM, roller_diameter=7 * MM, roller_length=7 * MM,
    effective_length=6.4 * MM, roller_count=24, rib_diameter=60 * MM, rib_gap=7.05 * MM,
    row_distance=9 * MM,
)  # fmt: skip
ELASTIC = PairSpec(normal=NormalLaw(law="elastic"), friction=FrictionLaw(law="none"), slices=8)
SMOOTH = Contacts(race=ELASTIC, pocket=ELASTIC, side=replace(ELASTIC), rib=replace(ELASTIC))
DRY = Lubricant(rolling_resistance="none", oil_fraction=0.0)


def moving(bearing, *, cage=None, speed=0.0, contacts=None, lubricant=DRY, sections=None, **load):
    """A case of a bearing without a cage or with a rigid one and further ``sections``, its system
    and its start."""
    case = Case(
        bearing=bearing, cage=cage, cage_model="rigid" if cage else "none",
        load=Load(**{"gravity": 0.0, **load}), drive=Drive(speed=speed),
        contacts=contacts or Contacts(), lubricant=lubricant, **(sections or {}),
    )  # fmt: skip
    system = bearing_in_motion(case, cage_mesh(case) if cage else None, None)
    return case, system, assembled_start(case, system)


def reported(system, y, yd=None):
    """The report at y, of a copy."""
    system.residual(0.0, y, np.zeros_like(y) if yd is None else yd, mode=2)
    return system.data.work.report


def in_space(system, y):
    """Sums of forces (3,) and moments (3,) about the origin of contacts on all bodies and elements,
    after a residual at y, and of their sizes."""
    layout, work = system.layout, system.data.work.scratch
    q, own = layout.q(y), work.wrenches
    psi = q["elements"][:, 2]
    c, s = np.cos(psi), np.sin(psi)

    def turned(a):
        return np.stack([a[:, 0], c * a[:, 1] - s * a[:, 2], s * a[:, 1] + c * a[:, 2]], axis=1)

    place = np.stack([q["elements"][:, 0], q["elements"][:, 1] * c, q["elements"][:, 1] * s], 1)
    forces = turned(own[:, :3])
    force, moment = forces.sum(axis=0), (turned(own[:, 3:]) + np.cross(place, forces)).sum(axis=0)
    pushed = layout.border(work.border)
    for ring in ("inner", "outer"):
        force = force + pushed[ring][:3]
        moment = moment + pushed[ring][3:6] + np.cross(q[ring][:3], pushed[ring][:3])
    return force, moment, np.abs(forces).sum()


def energy_misses(system, y, rows, *, seed=2, tilt=3e-8):
    """Of random motions of elements and inner ring, differences of the energy less the work of the
    contacts' forces in the ``rows`` at rest, over the size of both."""
    layout, rng, bodies = system.layout, np.random.default_rng(seed), system.data.model.bodies
    layout.u(rows)["inner"][:2] += bodies.axial[1, 0], bodies.load[1, 0]
    force, r = layout.u(-rows), layout.q(y)["elements"][:, 1]

    def energy(at):
        return float(reported(system, at).energy[1:].sum())

    misses = []
    for _ in range(6):
        step = np.zeros_like(y)
        q = layout.q(step)
        q["elements"][:, :3] = rng.standard_normal((layout.elements, 3)) * 1e-9
        q["elements"][:, 2] /= r
        q["inner"][:5] = rng.standard_normal(5) * np.array([1e-9, 1e-9, 1e-9, tilt, tilt])
        slope = -0.5 * (energy(y + step) - energy(y - step))
        along = np.stack([r**0, r**0, r], axis=1)
        work = (force["elements"][:, :3] * q["elements"][:, :3] * along).sum()
        work += force["inner"][:3] @ q["inner"][:3] + force["inner"][4:6] @ q["inner"][3:5]
        scale = np.abs(force["elements"]).max() * 1e-9 * layout.elements
        misses.append((slope - work) / scale)
    return np.array(misses)
