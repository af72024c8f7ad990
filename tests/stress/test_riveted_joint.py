"""The riveted joint: its mesh, its loads, what it does."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from flexcage.core.errors import InputError, RunFailed
from flexcage.fem.contact import NoBalance
from flexcage.fem.curved import curved_volumes
from flexcage.geometry.materials import MATERIALS
from flexcage.geometry.riveted_joint import JointShape
from flexcage.mesh.riveted_joint import (
    LOWER,
    RIVET,
    ROOT_ELEMENTS,
    UPPER,
    JointMesh,
    joint_bodies,
)
from flexcage.stress.riveted_joint import Fit, RivetedJoint
from flexcage.stress.rivets import nominal_stress

SHAPE = JointShape(
    shank_diameter=1.2e-3, head_diameter=2.1e-3, head_height=0.72e-3, root_radius=0.1e-3,
    thickness=0.8e-3, inner=-1.6e-3, outer=1.6e-3, length=4.36e-3,
)  # fmt: skip
STEEL = MATERIALS["steel"]
COARSE = JointMesh(sectors=6, root=2, size=1.5, seat=0.6, growth=2.0)


def test_volumes_and_roots():
    """By Pappus' rule: a bar, two heads, rounds at their roots; plates less bevelled holes."""
    bodies = joint_bodies(SHAPE)
    volumes = curved_volumes(bodies.nodes, bodies.tets)  # NaN where an element is turned over
    whole = [volumes[bodies.bodies == b].sum() for b in (RIVET, LOWER, UPPER)]
    a, r, t = 0.6e-3, 0.1e-3, 0.8e-3
    corner = r**2 * (1.0 - 0.25 * pi)  # of a square, beside a quarter of a circle
    arm = (r * r * 0.5 * r - 0.25 * pi * r**2 * (r - 4.0 * r / (3.0 * pi))) / corner
    rivet = 2.0 * pi * (t * a**2 + 0.72e-3 * 1.05e-3**2 + 2.0 * corner * (a + arm))
    bevel = SHAPE.bevel
    sheet = 3.2e-3 * 4.36e-3 * t - pi * a**2 * t - pi * bevel**2 * (a + bevel / 3.0)
    assert np.allclose(whole, [rivet, sheet, sheet], rtol=1e-4)
    root = bodies.nodes[bodies.faces["root_upper", RIVET][:, :3]].reshape(-1, 3)
    radius = np.hypot(*root[:, 1:].T)
    assert np.allclose(np.hypot(radius - a - r, root[:, 0] - t + r), r, rtol=1e-9)  # on the round
    assert len(np.unique(np.round(radius * 1e9))) == 1 + ROOT_ELEMENTS


@pytest.fixture(scope="module")
def joint():
    return RivetedJoint(SHAPE, STEEL, mesh=COARSE)


def test_loads_act_on_both_sheets_as_asked(joint):
    load = np.array([-8.0, 5.0, 10.0, 0.002, 0.004, 0.006])
    nodal = joint.loads(load)
    for body, sign in ((LOWER, 1.0), (UPPER, -1.0)):
        own = joint.bodies.of_body(body)
        assert np.allclose(nodal[own].sum(axis=0), sign * load[:3])
        moment = np.cross(joint.bodies.nodes[own], nodal[own]).sum(axis=0)
        assert np.allclose(moment, sign * load[3:])
    assert not nodal[joint.bodies.of_body(RIVET)].any()


@pytest.fixture(scope="module")
def played(joint):
    """A rivet with play under tension and shear, largest and back."""
    load = np.array([-20.0, 4.0, 6.0, 0.0, 0.004, 0.0])
    return joint.cycle(load, -0.5 * load, Fit(play=10e-6, clamp=80.0))


def test_a_rivet_with_play_is_clamped(played):
    clamped, largest = played.instants["clamped"], played.instants["largest"]
    assert clamped.clamp == pytest.approx(80.0, rel=0.02)
    assert clamped.forces["sheets"][0] == pytest.approx(clamped.clamp, rel=1e-3)
    assert played.largest_pressure["hole_upper"] == 0.0  # the shank does not reach its holes
    # what goes from half to half goes through sheets and heads together
    for k, load in enumerate(largest.load[:3]):
        through = largest.forces["sheets"][k] + largest.forces["head_lower"][k]
        through += largest.forces["hole_lower"][k] if k else 0.0
        if k == 0:  # the lower sheet pushes the upper one; the lower head pulls the rivet back
            assert through == pytest.approx(load, abs=0.02 * abs(load))
    # and the clamp bears tension by what the sheets are relieved of (a bolt with stiff plates)
    assert abs(largest.clamp - clamped.clamp) < 0.3 * 20.0


class Nervous:
    """A contact that finds balance in small steps only, and says what it was loaded with."""

    def __init__(self, most):
        self.most, self.seen = most, []

    def solve(self, loads, gaps, state):
        size = float(np.abs(loads - state).max())
        if size > self.most:
            raise NoBalance("no balance")
        self.seen.append(size)
        return loads


def test_a_load_that_finds_no_balance_is_put_on_in_steps(joint):
    """In a quarter at a time where one step fails, up to the load itself; then it gives up."""
    before, load = np.zeros(6), np.array([0.0, 2.0, 0.0, 0.0, 0.0, 1e-3])
    start, end = joint.loads(before), joint.loads(load)
    most = float(np.abs(end - start).max())
    for share, steps in ((1.1, 1), (0.3, 4), (0.1, 16)):
        problem = Nervous(share * most)
        state = joint._loaded(problem, None, start, before, load)
        np.testing.assert_array_equal(state, end)
        assert len(problem.seen) == steps
    with pytest.raises(RunFailed, match="no balance"):
        joint._loaded(Nervous(0.01 * most), None, start, before, load)


def test_peaks_are_named_and_at_their_places(played):
    peaks = played.peaks()
    assert [p.stress for p in peaks] == sorted((p.stress for p in peaks), reverse=True)
    assert peaks[0].place == "root"  # with play: at the root of the head
    assert "play 10 um" in played.table() and "slip up to" in played.table()
    stress, highest, node = played.range_at("root")
    assert played.K_t == pytest.approx(stress / played.nominal_range)
    assert 0.0 < stress and highest < 5.0 * peaks[0].stress and node in played.places["root"]
    lives = played.lives()
    assert len(lives) == 6 and all(life.nominal == played.nominal_range for life in lives)


def test_interference_presses_on_the_holes(joint):
    small = np.array([0.0, 0.5, 0.0, 0.0, 0.0, 0.0])
    found = joint.cycle(small, -small, Fit(play=-4e-6, clamp=80.0))
    pressure = found.largest_pressure["hole_upper"]
    # Lame, a solid shank in an endless plate: p = E (interference/2)/a / 2 in plane stress, a tenth
    # more in plane strain, which the heads come near to; the strip gives way a little
    endless = 0.5 * STEEL.youngs_modulus * 2e-6 / 0.6e-3
    part = found.problem.part["hole_upper"]
    mean = found.instants["clamped"].state.pressure[part].mean()
    assert 0.7 * endless < mean < 1.1 * endless < 3.0 * pressure
    assert found.instants["clamped"].clamp == pytest.approx(80.0, rel=0.03)


def test_nominal_stress_of_a_shank():
    d = 1.2e-3
    area, bend = 0.25 * pi * d**2, pi * d**3 / 32.0
    assert nominal_stress(np.array([-5.0, 0, 0, 0, 0, 0]), d) == pytest.approx(5.0 / area)
    assert nominal_stress(np.array([5.0, 0, 0, 0, 0, 0]), d) == pytest.approx(5.0 / area)
    assert nominal_stress(np.array([0, 0, 0, 0, 3e-3, 4e-3]), d) == pytest.approx(5e-3 / bend)
    shear = 3.0**0.5 * 5.0 / area
    assert nominal_stress(np.array([0, 3.0, 4.0, 0, 0, 0]), d) == pytest.approx(shear)


@pytest.mark.parametrize(
    "change, words",
    [
        ({"root_radius": 0.4e-3}, "leaves the head no seat"),
        ({"thickness": 0.13e-3}, "too much for sheets"),
        ({"length": 2.0e-3}, "within its head"),
    ],
)
def test_shapes_that_are_impossible(change, words):
    values = {f: getattr(SHAPE, f) for f in SHAPE.__dataclass_fields__}
    with pytest.raises(InputError, match=words):
        JointShape(**{**values, **change})


def test_fits_that_are_impossible():
    with pytest.raises(InputError, match="clamp is 0"):
        Fit(clamp=0.0)
    with pytest.raises(InputError, match="friction is 1"):
        Fit(friction=1.0)
