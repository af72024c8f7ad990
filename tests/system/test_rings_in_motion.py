"""Rings that bend in a run."""

import dataclasses
from functools import partial

import numpy as np
import pytest
import ring_cases
from bearing_runs import unbalanced

import flexcage
from flexcage.bearings import sections_of, statics_of
from flexcage.core.errors import InputError
from flexcage.integrate.rings import _deflections
from flexcage.stages import assembled_start, bearing_in_motion, bent_rings, cage_mesh
from flexcage.static import solve_static
from flexcage.stress.rings import ring_field
from flexcage.system.rings.moving import moving_rings
from flexcage.system.spec import Load
from flexcage.system.statics.options import AT_START
from flexcage.system.statics.rings import Rings
from flexcage.system.statics.solve import solve_bearing

BOTH = {"inner_ring.ring": "flexible", "outer_ring.ring": "flexible"}
LOADS = ring_cases.LOADS | {"N1013": {"radial": 2000.0}}
case_of = partial(ring_cases.case_of, loads=LOADS)


def bending(preset, **how):
    return case_of(preset, **{**BOTH, **how})


def hard(case, factor=1e4):
    material = case.bearing.material
    stiff = dataclasses.replace(material, youngs_modulus=factor * material.youngs_modulus)
    return dataclasses.replace(
        case,
        inner_ring=dataclasses.replace(case.inner_ring, material=stiff),
        outer_ring=dataclasses.replace(case.outer_ring, material=stiff),
    )


def exchanged(run):
    """Sum of what all powers did, each without its sign [J]."""
    return float(np.abs(run.dataset["work"].values[-1]).sum())


def missed_energy(run):
    """What the audit misses, as a share of what is exchanged."""
    ds = run.dataset
    missed = ds["energy"].sum("energy_kind") - ds["work"].sum("channel")
    return np.ptp(missed.values) / exchanged(run)


@pytest.mark.parametrize("preset", LOADS)
def test_what_kernels_read_is_the_static_compliance(preset):
    case = bending(preset)
    rings = Rings(case.inner_ring, case.outer_ring, sections_of(case.bearing))
    solution = solve_bearing(
        case.bearing, statics_of(case.bearing), load=Load(**LOADS[preset]), rings=rings
    )
    data = moving_rings(rings, solution).data
    for side, ring in enumerate(solution.rings):
        psi, force = ring.azimuth[None], ring.force[None]
        (found,) = _deflections(data, side, psi, force)
        wanted = ring.deflection[:, data.way]
        missed = np.abs(found - wanted).max(axis=0) / np.abs(wanted).max(axis=0)
        assert missed.max() < 5e-4  # of each port; elements far apart do not feel each other


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"solver.method": "bdf"}, "rings that bend move by explicit steps"),
    ],
)
def test_what_a_run_cannot_have_is_said_in_a_sentence(changes, said):
    case = case_of("N1013").replace(changes)
    with pytest.raises(InputError, match=said):
        case.replace("outer_ring.ring", "flexible")


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_a_run_at_rest_is_the_static_solution(preset):
    """Displacement and forces within 1 %, deflections within 2 %."""
    case = bending(preset, speed=0.0, **{"load.gravity": 0.0})
    run, static = flexcage.simulate(case, stress=False), solve_static(case, options=AT_START)
    ds, largest = run.dataset, static.largest_force
    force = ds["race_force"].values[-1]
    assert np.abs(force - static.elements.force).max() < 0.01 * largest
    moved = np.linalg.norm(static.displacement[:3])
    found = ds["inner_position"].values[-1]
    assert np.abs(found - static.displacement[:3]).max() < 0.01 * moved
    deflection = ds["ring_deflection"].values[-1]
    for side, ring in enumerate(static.rings):
        wanted = ring.deflection[:, :2]
        assert np.abs(deflection[:, side, :2] - wanted).max() < 0.02 * np.abs(wanted).max()


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_rings_of_a_hard_material_move_as_rigid_ones(preset):
    tight = {"solver.tolerance": 1e-10}
    rigid = flexcage.simulate(case_of(preset, **tight), stress=False).dataset
    other = flexcage.simulate(hard(bending(preset, **tight)), stress=False).dataset
    largest = float(rigid["race_force"].max())
    assert np.abs(other["race_force"] - rigid["race_force"]).max() < 2e-3 * largest
    for name in ("inner_position", "element_position", "cage_position"):
        moved = np.abs(rigid[name] - rigid[name][0]).max()
        assert np.abs(other[name] - rigid[name]).max() < 2e-3 * moved + 1e-9, name


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_energy_is_accounted_for(preset):
    """Under a load that swings between nearly nothing and twice its size, at the default
    tolerance; what the rings lose is a loss."""
    wave = {
        "load.wave": "sine", "load.wave_of": "radial", "load.wave_period": 5e-4,
        "load.wave_amplitude": 0.95 * LOADS[preset]["radial"], "outer_ring.seat": "foundation",
        "outer_ring.foundation": 1e12,
    }  # fmt: skip
    run = flexcage.simulate(bending(preset, **wave), stress=False)
    ds = run.dataset
    assert missed_energy(run) < 1e-4
    damped = ds["work"].sel(channel="modal_damping").values
    assert damped[-1] < 0.0
    assert (np.diff(damped) < 1e-4 * abs(damped[-1])).all()


UNEVEN = {
    "bearing.outer_spall.length": 1e-3, "bearing.outer_spall.depth": 50e-6,
    "bearing.outer_spall.azimuth": 0.1, "bearing.inner_spall.length": 1e-3,
    "bearing.inner_spall.azimuth": 0.1, "bearing.ball_spot.size": 1.2e-3,
    "bearing.ball_spot.ball": 3, "bearing.ball_spot.angle": np.pi / 2,
}  # fmt: skip


@pytest.mark.slow
def test_balls_fall_into_spalls_and_turn_spots_between_rings_that_bend():
    """Balls 0 and 3 dip; energy is accounted for within 5e-4 while edges strike races, and within
    2e-5 at a tight tolerance; with 1e4 times the modulus forces are on the mean as between rigid
    rings."""
    run = flexcage.simulate(bending("7010C-PI", duration=2e-3, **UNEVEN), stress=False)
    ds = run.dataset
    assert missed_energy(run) < 5e-4
    close = {"solver.tolerance": 1e-10, **UNEVEN}
    exact = flexcage.simulate(bending("7010C-PI", duration=2e-3, **close), stress=False)
    assert missed_energy(exact) < 2e-5
    force = ds["race_force"].values
    whole = flexcage.simulate(bending("7010C-PI", duration=2e-3), stress=False).dataset
    beside = whole["race_force"].values
    for ball in (0, 3):
        assert (force[:, ball] / beside[:, ball]).min() < 0.7, ball
    tight = {"solver.tolerance": 1e-10, **UNEVEN}
    rigid = flexcage.simulate(case_of("7010C-PI", **tight), stress=False).dataset
    other = flexcage.simulate(hard(bending("7010C-PI", **tight)), stress=False).dataset
    largest = float(rigid["race_force"].max())
    apart = np.abs(other["race_force"] - rigid["race_force"])
    assert apart.mean() < 2e-3 * largest  # but for the instants at which edges strike


@pytest.mark.slow
@pytest.mark.parametrize("preset", LOADS)
def test_forces_on_all_bodies_add_up_to_none(preset):
    """Between races that yield, slopes included, in a state that is no equilibrium."""
    case = bending(preset)
    bearing = bearing_in_motion(case, cage_mesh(case), None)
    layout, start = bearing.layout, assembled_start(case, bearing)
    y, rng = start.y.copy(), np.random.default_rng(1)
    elements = layout.q(y)["elements"]
    elements[:, 1] += 1e-6 * rng.standard_normal(len(elements))
    elements[:, 2] += 1e-3 * rng.standard_normal(len(elements))
    layout.ring_forces(y)[:] *= 1.0 + 0.3 * rng.standard_normal(layout.ring_forces(y).shape)
    bearing.residual(0.0, y, start.yd)
    rings = bearing.data.model.rings
    assert np.abs(rings.moment).max() > 1e-8  # slopes push
    assert np.abs(unbalanced(bearing, elements)).max() < 1e-12


@pytest.mark.slow
def test_relaxation_hardly_shows():
    """Means of forces under a steady load are the same for half and twice the time, to 0.1 %."""
    found = []
    for time in (2.5e-6, 10e-6):
        times = {"outer_ring.relaxation": time, "inner_ring.relaxation": time}
        ds = flexcage.simulate(bending("N1013", **times), stress=False).dataset
        found.append(ds["race_force"].values[5:].mean(axis=0))
    assert np.abs(found[0] - found[1]).max() < 1e-3 * found[0].max()


@pytest.mark.slow
def test_a_folder_gives_the_rings_of_an_instant(tmp_path):
    case = bending("N1013")
    flexcage.simulate(case, out=tmp_path / "run", stress=False)
    run = flexcage.load_run(tmp_path / "run")
    inner, outer = run.rings(time=5e-4)
    k = int(np.argmin(np.abs(run.dataset["time"].values - 5e-4)))
    psi = run.dataset["element_position"].values[k, :, 2]
    assert outer.azimuth == pytest.approx(psi)
    load = run.dataset["race_force"].values[k, :, 1]
    assert outer.force[:, 0] == pytest.approx(load, abs=0.02 * load.max())
    assert inner.force[:, 0].min() < 0.0
    yielded = (outer.seated.race @ outer.force.ravel()).reshape(-1, 2)[:, 0]
    assert outer.deflection[:, 1] == pytest.approx(yielded, abs=1e-3 * np.abs(yielded).max())
    field = ring_field(outer, stations=60)
    assert field.von_mises.max() > 1e6
    (inner_now, _) = bent_rings(case)
    assert inner_now.side == inner.side == "inner"
