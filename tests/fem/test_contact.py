"""Contact with friction against closed forms: a patch, Lame's press fit, a fit under torque."""

import numpy as np
import pytest
from contact_bodies import STEEL, loads_on, problem, sleeve_on_shaft, stacked

from flexcage.core.errors import RunFailed
from flexcage.fem.curved import curved_stress, curved_volumes

A, B, LENGTH = 5e-3, 10e-3, 6e-3
NU, E = STEEL.poisson_ratio, STEEL.youngs_modulus


def held_at(nodes, points):
    """The dofs that hold a body at three of its nodes without any force: x, y, z; y, z; x ..."""
    out = []
    for place, axes in points:
        node = int(np.argmin(np.linalg.norm(nodes - place, axis=1)))
        out += [3 * node + axis for axis in axes]
    return np.array(out)


def shaft(sectors=12, hollow=2.5e-3):
    radii = np.linspace(hollow, A, 4), np.linspace(A, B, 5)
    return sleeve_on_shaft(radii, np.linspace(0.0, LENGTH, 4), sectors)


def test_bodies_have_their_volumes():
    bodies = shaft()
    volumes = curved_volumes(bodies.nodes, bodies.tets)
    whole = [volumes[bodies.bodies == b].sum() for b in (0, 1)]
    exact = np.pi * LENGTH * np.array([A**2 - 2.5e-3**2, B**2 - A**2])
    assert np.allclose(whole, exact, rtol=2e-4)


def test_a_patch_carries_a_uniform_pressure():
    """Two discs under a pressure: the stress is uniform to rounding, whatever the mesh."""
    bodies = stacked(np.linspace(0.0, 4e-3, 4), np.array([0.0, 1e-3, 3e-3]), 8)
    pressure = 50e6
    base = np.unique(bodies.faces["base", 0])
    across = [((-3e-3, 0, 0), (1, 2)), ((-3e-3, 4e-3, 0), (2,))]
    held = np.concatenate([3 * base, held_at(bodies.nodes, across)])
    found = problem(bodies, 0.2, np.unique(held), springs=1e-3)
    loads = loads_on(
        bodies, bodies.faces["end", 1], lambda p: np.tile([-pressure, 0, 0], (len(p), 1))
    )
    state = found.solve(loads, found.gaps({}), found.at_rest())
    assert np.allclose(state.pressure, pressure, rtol=1e-4)
    stress = curved_stress(bodies.nodes, bodies.tets, STEEL, state.moved)
    assert np.allclose(stress, [-pressure, 0, 0, 0, 0, 0], atol=1e-4 * pressure)
    top = state.moved[bodies.faces["end", 1][:, 0], 0]
    assert np.allclose(top, -pressure * (6e-3 / E + 1e-16), rtol=1e-4)


@pytest.fixture(scope="module")
def fit():
    """A sleeve on a hollow shaft, 5 um too large, without friction."""
    bodies = shaft()
    held = held_at(bodies.nodes, [((0, A, 0), (0, 2)), ((0, -A, 0), (0, 2)), ((0, 0, A), (0, 1))])
    found = problem(bodies, 0.0, held)
    state = found.solve(np.zeros_like(bodies.nodes), found.gaps({"fit": -5e-6}), found.at_rest())
    return bodies, found, state


def test_press_fit_of_lame(fit):
    """Plane stress in both rings, as nothing holds them along: Timoshenko, Strength of Materials
    II, 1956, article 41."""
    bodies, found, state = fit
    hole = 2.5e-3
    compliance = A / E * (
        (A**2 + B**2) / (B**2 - A**2) + NU + (A**2 + hole**2) / (A**2 - hole**2) - NU
    ) + 1.0 / found.penalty  # fmt: skip
    exact = 5e-6 / compliance
    assert state.pressure.mean() == pytest.approx(exact, rel=3e-3)
    assert state.pressure.std() < 0.02 * exact
    stress = curved_stress(bodies.nodes, bodies.tets, STEEL, state.moved)
    outside = np.isclose(np.hypot(*bodies.nodes[:, 1:].T), B, rtol=1e-6)
    hoop = stress[outside] @ [1, 1, 1, 0, 0, 0]  # the other two are zero there
    assert hoop.mean() == pytest.approx(exact * 2 * A**2 / (B**2 - A**2), rel=1e-2)


def test_resultants_balance(fit):
    _, found, state = fit
    force = found.resultants(state, np.zeros(3))["fit"]
    push = float((state.pressure * found.weights).sum())
    assert np.abs(force[:3]).max() < 1e-6 * push


@pytest.fixture(scope="module")
def rubbing():
    """The same fit with friction, the sleeve's outside held, torque on the shaft's end."""
    bodies = shaft(sectors=8)
    outside = np.flatnonzero(np.isclose(np.hypot(*bodies.nodes[:, 1:].T), B, rtol=1e-6))
    held = np.concatenate([3 * outside, 3 * outside + 1, 3 * outside + 2])
    found = problem(bodies, 0.3, held)
    gaps = found.gaps({"fit": -5e-6})
    smooth = problem(bodies, 0.0, held)  # pressed without friction, so that none is left along x
    pressed = smooth.solve(np.zeros_like(bodies.nodes), gaps, smooth.at_rest())
    around = loads_on(
        bodies, bodies.faces["end", 0],
        lambda p: np.stack([0 * p[:, 0], -p[:, 2], p[:, 1]], axis=1),
    )  # fmt: skip
    around /= float(np.cross(bodies.nodes, around)[:, 0].sum())  # a unit torque

    def twist(state):
        return float((state.moved * around).sum())  # works with the torque

    bound = 0.3 * A * float((pressed.pressure * found.weights).sum())
    return found, gaps, pressed, around, twist, bound


def test_friction_bears_no_more_than_its_bound(rubbing):
    found, gaps, pressed, around, twist, bound = rubbing
    held = found.solve(0.95 * bound * around, gaps, pressed)
    torque = found.resultants(held, np.zeros(3))["fit"][3]
    assert torque == pytest.approx(0.95 * bound, rel=1e-3)
    # beyond its bound the shaft turns until its nodes, on chords, wedge in the sleeve
    slid = found.solve(1.1 * bound * around, gaps, pressed)
    assert twist(slid) - twist(pressed) > 15.0 * (twist(held) - twist(pressed))


def test_what_nothing_holds_is_refused():
    """A shaft with play and no friction falls through its sleeve."""
    bodies = shaft(sectors=8)
    outside = np.flatnonzero(np.isclose(np.hypot(*bodies.nodes[:, 1:].T), B, rtol=1e-6))
    held = np.concatenate([3 * outside, 3 * outside + 1, 3 * outside + 2])
    found = problem(bodies, 0.0, held)
    pull = loads_on(bodies, bodies.faces["end", 0], lambda p: np.tile([1e6, 0, 0], (len(p), 1)))
    with pytest.raises(RunFailed, match="holds a body"):
        found.solve(pull, found.gaps({"fit": 5e-6}), found.at_rest())


def test_friction_remembers_as_masing_says(rubbing):
    """Under constant pressure the way back is the first loading's, twice as large (G. Masing, Proc.
    2nd Int. Congr. Appl. Mech., 1926, 332): exact for sliders of fixed bounds and springs."""
    found, gaps, pressed, around, twist, bound = rubbing
    first, back = 0.8 * bound, -0.2 * bound
    rest = twist(pressed)
    top = found.solve(first * around, gaps, pressed)
    half = found.solve(0.5 * (first - back) * around, gaps, pressed)
    turned = found.solve(back * around, gaps, top)
    fall = twist(top) - twist(turned)
    assert fall == pytest.approx(2.0 * (twist(half) - rest), rel=2e-3)
    again = found.solve(first * around, gaps, turned)
    assert twist(again) == pytest.approx(twist(top), rel=2e-3)  # the loop closes
    straight = found.solve(back * around, gaps, pressed)
    assert abs(twist(straight) - twist(turned)) > 0.02 * abs(twist(top) - rest)  # and remembers
