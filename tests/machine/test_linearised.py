"""Natural frequencies, critical speeds and unbalance response beside closed forms and ROSS."""

from __future__ import annotations

import json
from math import pi
from pathlib import Path

import numpy as np
import pytest
from ross_rotor import DAMPING, DISCS, SECTIONS, SPEEDS, SPRINGS, STEEL, UNBALANCE, by_ross

from flexcage.geometry.materials import Material
from flexcage.machine.beams import Beam
from flexcage.machine.linear import amplitude, of_shaft, on_supports
from flexcage.machine.shaft import build_shaft
from flexcage.machine.spec import Disc, Gravity, Shaft, ShaftLoad, ShaftSection

OURS = Material(
    name="ours", youngs_modulus=STEEL["modulus"], poisson_ratio=STEEL["ratio"],
    density=STEEL["density"],
)  # fmt: skip
HOLLOW = ShaftSection(length=0.5, diameter=0.06, bore=0.03)
TORSION = 1748.678  # rad/s, a natural frequency of ROSS's rotor that turns about its axis


def beam(section=HOLLOW, **more):
    return Shaft(material=OURS, sections=(section,), **more)


def rotor():
    discs = [Disc(position=x, mass=m, polar_inertia=p, diametral_inertia=d)
             for x, m, p, d in DISCS]  # fmt: skip
    discs[0] = Disc(
        position=DISCS[0][0], mass=DISCS[0][1], polar_inertia=DISCS[0][2],
        diametral_inertia=DISCS[0][3], unbalance=UNBALANCE,
    )  # fmt: skip
    sections = tuple(ShaftSection(length=L, diameter=D, bore=d) for L, D, d in SECTIONS)
    spec = Shaft(material=OURS, sections=sections, discs=tuple(discs), elements=60)
    shaft = build_shaft(spec, list(SPRINGS))
    held = {x: np.diag([1e6, y, z, 0.0, 0.0]) for x, (y, z) in SPRINGS.items()}
    return of_shaft(shaft, on_supports(shaft, held).stiffness, dict.fromkeys(SPRINGS, DAMPING))


def check_against(ross):
    ours = rotor()
    for speed in SPEEDS:
        found, ways = ours.frequencies(float(speed), 7)
        found = [f for f, way in zip(found, ways) if way != "axial"]
        stored = ross["frequencies"][f"{speed:.6f}"]
        wanted = [f for f in stored if abs(f - TORSION) > 0.01]
        assert len(wanted) == 5 and found[:5] == pytest.approx(wanted, rel=2e-5)
        moved = ours.response([speed])[0, np.argmin(np.abs(ours.places - DISCS[0][0]))]
        assert np.abs(moved[1:3]) == pytest.approx(ross["orbit"][f"{speed:.6f}"], rel=1e-5)
    wanted = [w for w in ross["critical"] if abs(w - TORSION) > 0.01]
    found = [c.speed for c in ours.criticals() if c.way != "axial"]
    assert found[: len(wanted)] == pytest.approx(wanted, rel=1e-4)  # ROSS's are damped


def test_a_stepped_rotor_whirls_as_that_of_ross():
    stored = json.loads(Path(__file__).with_name("ross_rotor.json").read_text("utf-8"))
    assert stored["version"] == "2.3.0"
    check_against(stored)


def test_a_stepped_rotor_whirls_as_that_of_ross_here():
    try:
        import ross  # noqa: F401
    except Exception as exc:  # beside a plotly that it does not know it fails otherwise
        pytest.skip(f"ROSS is not here: {type(exc).__name__}")
    check_against(by_ross())


def test_a_pinned_beam_has_the_frequencies_of_timoshenko():
    shaft = build_shaft(beam(elements=60), [0.0, 0.5])
    pin = np.diag([1e9, 1e13, 1e13, 0.0, 0.0])
    found, ways = on_supports(shaft, {0.0: pin, 0.5: pin}).frequencies(0.0, 12)
    found = [f for f, way in zip(found, ways) if way != "axial"]
    one = Beam(0.5, HOLLOW, OURS)
    EI, GA, m = one.bending_stiffness, one.shear_stiffness, one.mass_per_length
    turning = OURS.density * HOLLOW.second_moment
    for n in (1, 2):
        k = n * pi / 0.5
        roots = np.roots([turning * m / GA, -(m + turning * k**2 + EI * k**2 * m / GA), EI * k**4])
        wanted = np.sqrt(roots.min())
        assert found[2 * n - 2 : 2 * n] == pytest.approx([wanted, wanted], rel=1e-4)
        assert wanted < k**2 * np.sqrt(EI / m) * 0.99  # Euler and Bernoulli's is higher


def test_a_clamped_beam_bends_as_euler_bernoulli_and_shear_say():
    """An end load and the weight, in one element a section: exact for both."""
    load = ShaftLoad(position=0.5, force=(1e4, 300.0, -200.0), moment=(5.0, 7.0))
    shaft = build_shaft(beam(loads=(load,), elements=4), [])
    gravity = Gravity(acceleration=9.81, direction=pi / 2)
    force = shaft.load(gravity)
    q = np.zeros_like(force)
    q[5:] = np.linalg.solve(shaft.stiffness[5:, 5:], force[5:])
    one, L = Beam(0.5, HOLLOW, OURS), 0.5
    EI, GA, m = one.bending_stiffness, one.shear_stiffness, one.mass_per_length
    x, y, z, ty, tz = q[-5:]
    assert x == pytest.approx(1e4 * L / (OURS.youngs_modulus * HOLLOW.area), rel=1e-9)
    assert y == pytest.approx(300.0 * (L**3 / 3 / EI + L / GA) + 7.0 * L**2 / 2 / EI, rel=1e-9)
    assert tz == pytest.approx(300.0 * L**2 / 2 / EI + 7.0 * L / EI, rel=1e-9)
    down = m * 9.81  # towards z
    sag = down * (L**4 / 8 / EI + L**2 / 2 / GA)
    assert z == pytest.approx(
        -200.0 * (L**3 / 3 / EI + L / GA) - 5.0 * L**2 / 2 / EI + sag, rel=1e-9
    )
    assert ty == pytest.approx(
        200.0 * L**2 / 2 / EI + 5.0 * L / EI - down * L**3 / 6 / EI, rel=1e-9
    )
    clamp = np.zeros_like(force)
    clamp[:5] = (shaft.stiffness @ q)[:5] - force[:5]
    borne = shaft.borne(clamp + 0.0, gravity)
    assert borne.force[0, 4] == pytest.approx(300.0 * L + 7.0, rel=1e-9)  # about z, at the clamp
    stress = 1e4 / HOLLOW.area + borne.bending[0] * 0.03 / HOLLOW.second_moment
    assert borne.stress[0] == pytest.approx(stress, rel=1e-9)


def test_a_rigid_rotor_cones_as_its_gyroscope_says():
    """Forward and backward: w^2 (Id -+ Ip) = k a^2 + k a^2, where w is the speed as well."""
    disc = Disc(position=0.2, mass=10.0, polar_inertia=0.02, diametral_inertia=0.05,
                unbalance=50e-6, azimuth=pi / 3)  # fmt: skip
    shaft = build_shaft(Shaft(kind="rigid", length=0.4, discs=(disc,)), [0.1, 0.3])
    spring = np.diag([1e6, 2e7, 2e7, 0.0, 0.0])
    lines = on_supports(shaft, {0.1: spring, 0.3: spring})
    found = {(c.way, round(c.speed, 3)) for c in lines.criticals()}
    turning, bounce = 2 * 2e7 * 0.1**2, np.sqrt(4e7 / 10.0)
    assert found == {
        ("axial", round(np.sqrt(2e6 / 10.0), 3)),
        ("forward", round(bounce, 3)), ("backward", round(bounce, 3)),
        ("forward", round(np.sqrt(turning / 0.03), 3)),
        ("backward", round(np.sqrt(turning / 0.07), 3)),
    } or {w for _, w in found} == {
        round(float(v), 3) for v in (np.sqrt(2e5), bounce, np.sqrt(turning / 0.03),
                                     np.sqrt(turning / 0.07))
    }  # of equal frequencies the eigenvectors are any mix  # fmt: skip
    r = 0.6
    moved = lines.response([r * bounce])[0]
    wanted = 50e-6 / 10.0 * r**2 / (1.0 - r**2)
    assert amplitude(moved) == pytest.approx([wanted] * len(moved), rel=1e-9)
    assert np.angle(moved[0, 1]) == pytest.approx(pi / 3, abs=1e-9)
