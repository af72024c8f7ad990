"""Which way the races hold a ball whose axis its orbit turns: against Newton and Euler in space."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from flexcage.simulate import simulate
from flexcage.verification.runs import NO_OIL, c7010

EX = np.array([1.0, 0.0, 0.0])


def in_space(bearing, angles, orbit, speed, resistance):
    """Tractions (2, 3) of outer and inner race on one ball, as (x, r, psi), in steady motion.

    The ball's centre is led round the axis; its angular velocity has space components, so that no
    frame's rotation enters. Contacts are points with viscous traction; their spin, which would lay
    the ball's axis across the line of contacts, is a viscous couple.
    """
    radius, rb = 0.5 * bearing.pitch_diameter, 0.5 * bearing.ball_diameter
    inertia = bearing.ball_inertia

    def frame(t):
        c, s = np.cos(orbit * t), np.sin(orbit * t)
        return np.array([0.0, c, s]), np.array([0.0, -s, c])

    def pushes(t, w):
        er, ep = frame(t)
        moment, forces = np.zeros(3), []
        for sign, ring, angle in ((1.0, 0.0, angles[1]), (-1.0, speed, angles[0])):
            n = sign * (np.sin(angle) * EX + np.cos(angle) * er)
            lever = rb * n
            point = radius * er + lever
            slip = radius * orbit * ep + np.cross(w, lever) - np.cross(ring * EX, point)
            force = -resistance * (slip - (slip @ n) * n)
            spin = (w - ring * EX) @ n
            moment += np.cross(lever, force) - 1e-6 * spin * n
            forces.append(force)
        return moment, forces

    start = np.array([-radius / rb * orbit, 0.0, 0.0])
    out = solve_ivp(lambda t, w: pushes(t, w)[0] / inertia, (0.0, 0.02), start, rtol=1e-9,
                    max_step=2e-5)  # fmt: skip
    er, ep = frame(out.t[-1])
    axes = np.array([EX, er, ep])
    return np.array([axes @ f for f in pushes(out.t[-1], out.y[:, -1])[1]]), axes @ out.y[:, -1]


def test_friction_takes_from_the_outer_contacts_axial_force():
    """Both ways the outer race pushes the ball away from its loaded shoulder, so that the contact
    angles part further than without friction (outer race control has it the other way)."""
    friction = {"contacts.race.friction.law": "traction", "solver.duration": "20 ms"}
    run = simulate(c7010(NO_OIL, friction, {"drive.speed": "7000 rpm"}))
    ds = run.dataset.isel(time=slice(-200, None)).mean(("time", "element"))
    angles = ds["contact_angle"].values
    orbit = float(ds["element_velocity"].sel(cyl="psi") / ds["element_position"].sel(cyl="r"))
    bearing = run.case.bearing
    rb = 0.5 * bearing.ball_diameter
    forces, omega = in_space(bearing, angles, orbit, run.case.drive.speed, 10.0)
    wanted = bearing.ball_inertia * orbit * omega[1]
    n = np.array([np.sin(angles[1]), np.cos(angles[1]), 0.0])
    moment = rb * (np.cross(n, forces[0])[2] - np.cross(n, forces[1])[2])
    assert moment == pytest.approx(wanted, rel=0.05) and omega[1] > 0.0
    across = ds["race_traction_across"]
    assert forces[0, 0] < 0.0 and float(across.sel(race="outer")) < 0.0
    assert angles[0] > np.radians(19.18) and angles[1] < np.radians(11.42)
