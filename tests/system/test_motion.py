"""Motions of the whole bearing: a roller's spin, constraints, equivalents."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from bearing_runs import march, rolling_start
from law_values import rolling
from scipy.integrate import solve_ivp

from flexcage.bodies.floating_frame import rigid_body
from flexcage.contacts import laws
from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant, NormalLaw, PairSpec
from flexcage.geometry.rollers import RollerProfile
from flexcage.system.spec import Drive, Load

RPM = 2 * np.pi / 60
SMOOTH = PairSpec(friction=FrictionLaw(law="none"))
NO_LOSS = Lubricant(rolling_resistance="none", oil_fraction=0.0)


GRIPPING = FrictionLaw(law="traction", peak=0.3, high_speed=0.2)
THICK = Lubricant(rolling_resistance="none", oil_fraction=0.2, drag_coefficient=40.0)
LOOSE, TIGHT = 8.0004e-3, 7.991e-3  # widths of pockets
ORBIT = 2709.09 * RPM


def curve(law):
    """Friction coefficient of a traction law against sliding speed, odd in it."""
    a, b, c, d = laws.gupta_coefficients(law.peak, law.peak_speed, law.high_speed)
    return lambda v: np.sign(v) * ((a + b * abs(v)) * np.exp(-c * abs(v)) + d)


@pytest.mark.parametrize(
    ("lubricant", "slip", "width", "pocket", "start", "end"),
    [
        pytest.param(NO_LOSS, 1.0, LOOSE, SMOOTH.friction, 0.0, -2926.0, id="rolls"),
        pytest.param(NO_LOSS, 0.97, LOOSE, SMOOTH.friction, 0.0, -2875.0, id="slow cage"),
        pytest.param(
            Lubricant(oil_fraction=0.0), 1.0, LOOSE, SMOOTH.friction, 0.0, -2925.0, id="resistance"
        ),
        pytest.param(THICK, 1.0, LOOSE, GRIPPING, 0.0, -2921.0, id="drag"),
        pytest.param(NO_LOSS, 1.0, TIGHT, GRIPPING, -2926.0, ORBIT, id="locks"),
    ],
)
def test_spin_of_one_roller(bearing_of, lubricant, slip, width, pocket, start, end):
    """From a standstill, skidding, to rolling (or to a lasting slip behind a slow cage).

    A cage of enormous inertia prescribes the orbit, races that pinch every roller alike prescribe
    the load; what is left is Ia dw/dt = R (traction in - traction out) - rolling resistance - R
    times friction in the pocket. A hundred times the usual drag presses the roller on the
    crossbeam behind it; two that pinch it hold it harder than traction and lock it to the cage.
    """
    pair = PairSpec(friction=FrictionLaw(law="traction"), normal=NormalLaw(law="elastic"), slices=3)
    orbit, ring = slip * ORBIT, 6000 * RPM
    bearing = bearing_of(
        bearing={"radial_clearance": -6e-6, "profile": RollerProfile(kind="straight")},
        cage={"pocket_width": width}, body=rigid_body(1e6, np.zeros(3), 1e3 * np.eye(3)),
        contacts=Contacts(race=pair, pocket=replace(SMOOTH, friction=pocket), side=SMOOTH,
                          rib=SMOOTH),
        lubricant=lubricant, load=Load(gravity=0.0),
    )  # fmt: skip
    model, layout = bearing.data.model, bearing.layout
    mass, axial, _ = model.bodies.element
    ri, ro, rw = model.inner.radius, model.outer.radius, 4e-3
    # radial balance of a roller on two springs c d^(10/9), with its centrifugal force
    c = laws.iso_line_stiffness(7.3e-3, 206e9 / (1.0 - 0.3**2))
    grid = np.linspace(ri + rw - 4e-6, ri + rw, 400_001)
    inner = c * np.clip(ri + rw - grid, 0, None) ** (10 / 9)
    outer = c * np.clip(grid - (ro - rw), 0, None) ** (10 / 9)
    outward = outer - inner - mass * orbit**2 * grid  # the further force that holds it there
    radius = np.interp(0.0, outward, grid)
    assert 100.0 < np.interp(radius, grid, inner) < np.interp(radius, grid, outer) < 1000.0
    stiffness, exponent = model.pocket.normal[0, :2]
    pinch = len(model.pocket.s) * stiffness * max(rw - 0.5 * width, 0.0) ** exponent
    drag = 0.5 * lubricant.oil_fraction * lubricant.density * lubricant.drag_coefficient
    drag *= 8e-3 * 8e-3 * (orbit * radius) ** 2

    y, yd = rolling_start(bearing)
    q, u, qd = layout.q(y), layout.u(y), layout.q(yd)
    q["elements"][:, 1], q["inner"][1:3] = radius, 0.0
    u["elements"][:, 2], u["elements"][:, 3] = orbit * radius, start
    qd["elements"][:, 2], qd["elements"][:, 5] = orbit, start - orbit
    u["omega"][0], qd["quaternion"][1] = orbit, 0.5 * orbit
    h = march(bearing, y, yd, duration=4e-3, rate=50e3)
    spin = layout.u(h.y)["elements"][:, :, 3]
    np.testing.assert_allclose(layout.u(h.y)["omega"][:, 0], orbit, rtol=1e-4)

    mu, grip = curve(pair.friction), curve(pocket) if pocket.law == "traction" else lambda v: 0.0
    hard = np.array([model.inner.rolling, model.outer.rolling])

    def rate(t, w):
        slide_in = ring * ri - orbit * radius + w[0] * rw  # race ahead of the roller's surface
        slide_out = -orbit * radius - w[0] * rw  # the outer race stands
        rub = grip((w[0] - orbit) * rw)
        radial = 0.0  # what friction on the crossbeams adds, up from the one ahead
        for _ in range(3):
            n_in, n_out = (np.interp(radial, outward, n) for n in (inner, outer))
            behind = drag - n_in * mu(slide_in) - n_out * mu(slide_out)  # less that from ahead
            radial = -rub * behind
        # the inner contact is at -rw e_r, where a force f on the roller has the moment -rw f
        torque = -rw * n_in * mu(slide_in) + rw * n_out * mu(slide_out)
        torque -= rw * rub * max(2.0 * pinch, abs(behind))
        speed = 0.5 * abs((ring - orbit) * ri - (w[0] - orbit) * rw)
        torque += rw * rolling(hard[0], speed, n_in)[0]
        speed = 0.5 * abs(orbit * ro - (w[0] - orbit) * rw)
        torque += rw * rolling(hard[1], speed, n_out)[0]
        return [torque / axial]

    span = (0, h.time[-1])
    ref = solve_ivp(rate, span, [start], "LSODA", t_eval=h.time, rtol=1e-9, atol=1e-6).y[0]
    assert abs(ref[-1] - end) < 1.0 and abs(ref[1] - end) > 600.0  # it comes there in the run
    assert np.abs(spin - ref[:, None]).max() < 4e-3 * np.abs(ref).max()
    assert np.ptp(spin[-1]) < 1e-3 * np.abs(ref).max()  # all alike


@pytest.mark.parametrize("misalignment", [0.0, 0.4e-3])
def test_constraints_hold(bearing_of, misalignment):
    """Axial position, skew and prescribed tilt to the last bits; speed along its ramp."""
    drive = Drive(speed=5000 * RPM, ramp_to=6000 * RPM, ramp_time=1e-3, ramp_start=0.5e-3)
    bearing = bearing_of(drive=drive, load=Load(radial=1000.0, misalignment=misalignment))
    h = march(bearing, *rolling_start(bearing), duration=2e-3)
    q, u = bearing.layout.q(h.y)["inner"], bearing.layout.u(h.y)["inner"]
    assert np.abs(q[:, [0, 3]]).max() < 1e-13
    assert np.abs(q[:, 4] - misalignment).max() < 1e-13
    assert np.abs(u[:, [0, 4, 5]]).max() < 1e-10
    table = np.interp(h.time, [0.5e-3, 1.5e-3], [5000 * RPM, 6000 * RPM])
    assert np.abs(u[:, 3] - table).max() < 5e-2  # dense output across the ramp's corners
    quaternion = np.linalg.norm(bearing.layout.q(h.y)["quaternion"], axis=1)
    assert np.abs(quaternion - 1.0).max() < 1e-5
    if misalignment:
        assert np.abs(bearing.layout.multipliers(h.y)[:, 2]).max() > 0.1  # the tilting moment


def test_shaft_comes_to_the_same_speed(bearing_of):
    """A compliant shaft settles at the prescribed speed, twisted by torque over stiffness."""
    stiffness = 2e3
    drive = Drive(kind="shaft", shaft_stiffness=stiffness, shaft_damping=0.8)
    bearing = bearing_of(drive=drive, load=Load(radial=1000.0))
    rigid = bearing_of(load=Load(radial=1000.0))
    h, ref = (march(b, *rolling_start(b), duration=6e-3, rate=50e3) for b in (bearing, rigid))
    late = h.time > 4e-3
    speed = bearing.layout.u(h.y)["inner"][late, 3]
    assert speed.mean() == pytest.approx(6000 * RPM, rel=2e-4)
    cage, other = (
        m.layout.u(x.y)["omega"][late, 0].mean() for m, x in ((bearing, h), (rigid, ref))
    )
    assert cage == pytest.approx(other, rel=2e-3)
    twist = 6000 * RPM * h.time[late] - bearing.layout.q(h.y)["inner"][late, 5]
    torque = rigid.layout.multipliers(ref.y)[late, 3].mean()
    assert (stiffness * twist).mean() == pytest.approx(torque, rel=0.15)  # both still swing


def test_stiff_modes_are_a_rigid_cage(bearing_of):
    """Modes 10^4 times as stiff move nothing: the same run as with a rigid body of that mass."""
    specs = {"load": Load(radial=1000.0)}
    stiff = bearing_of(flexible={"modes": 6, "stiffer": 1e6}, **specs)
    rigid = bearing_of(flexible={"modes": 0}, **specs)
    runs = [march(b, *rolling_start(b), duration=2e-3, tolerance=1e-9) for b in (stiff, rigid)]
    q = [b.layout.q(h.y) for b, h in zip((stiff, rigid), runs)]
    assert runs[1].samples.pocket_normal.max() > 1.0
    assert np.abs(q[0]["modes"]).max() < 1e-7
    assert np.abs(q[0]["cage"] - q[1]["cage"]).max() < 5e-8
    assert np.abs(q[0]["elements"][:, :, :2] - q[1]["elements"][:, :, :2]).max() < 5e-8
    loads = [h.samples.race[:, :, 0, 0] for h in runs]
    assert np.abs(loads[0] - loads[1]).max() < 0.01 * loads[1].max()
