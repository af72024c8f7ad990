"""A flexible cage becomes the rigid one: with a modulus or a stiffness far higher, and frozen."""

from dataclasses import replace

import numpy as np
import pytest
from verification_bearing import (
    FRICTIONLESS,
    bearing_of,
    bent,
    cage_of,
    log,
    march,
    n1013,
    relative_error,
    with_modes,
)  # fmt: skip

from flexcage.bearings.cylindrical_roller.motion import MOTION
from flexcage.bodies.cage import flexible_from_basis, rigid_from_tets
from flexcage.cages.window.interface import rigid_interface
from flexcage.compiling import build_bearing
from flexcage.simulate import simulate
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem
from flexcage.system.start import find_start

WINDOW = {
    "solver.duration": "1.5 ms",  # trajectories part soon after
    "solver.tolerance": "0.0001 um",
    "output.vibration_rate": "200 kHz",
    "output.rate": "200 kHz",
}


FORCES = 0.02  # share of pocket forces; 0.005 and 0.009 are left, which fall as the cage stiffens
MODULUS = "cage.material.youngs_modulus"


def of_modulus(factor: float):
    """Datasets of the case with a rigid and with a flexible cage of so many times brass's modulus.

    Roller and wall then make the same contact law in both: the wall's share has vanished.
    """
    case = n1013(WINDOW, defects=bent("0.2 mm"))
    case = case.replace(MODULUS, factor * case.cage.material.youngs_modulus)
    return [simulate(case.replace("cage.model", m)).dataset for m in ("rigid", "flexible")]


def of_stiffness(factor: float):
    """Datasets with a rigid cage of brass, and a flexible one whose mesh alone is so much stiffer.

    Contacts yield as those of brass in both. A flexible cage's pocket law leaves out what its mesh
    yields on a contact's patch; this mesh yields nothing there, and gets the rigid cage's law.
    """
    case = n1013(WINDOW, defects=bent("0.2 mm"))
    rigid, flexible = (case.replace("cage.model", m) for m in ("rigid", "flexible"))
    stiff = flexible.replace(MODULUS, factor * case.cage.material.youngs_modulus)
    bearing = build_bearing(flexible, *cage_of(stiff))
    ours, theirs = bearing.data.model, bearing_of(rigid).data.model
    assert ours.cage.kff[0, 0] > 0.99 * factor * cage_of(flexible)[1].basis.stiffness[0, 0]
    ours.pocket.normal[:] = theirs.pocket.normal
    np.testing.assert_array_equal(ours.land.normal, theirs.land.normal)
    return [simulate(rigid).dataset, march(flexible, bearing, *_start(bearing))]


@pytest.fixture(scope="module", params=[of_modulus, of_stiffness])
def stiff_runs(request):
    """The same case with a rigid cage, and with a flexible one ten thousand times as stiff."""
    return request.param(1e4)


def test_ten_thousand_times_the_stiffness_gives_the_rigid_forces(stiff_runs):
    """Until trajectories diverge: many pockets touch, forces up to 68 N, cage moves by 17 um."""
    rigid, flexible = stiff_runs
    a, b = (ds["pocket_force"].values.astype(float) for ds in stiff_runs)
    assert np.count_nonzero(a.max(axis=0)) > 8 and a.max() > 20.0
    error = relative_error(b, a)
    races = relative_error(flexible["race_force"].values, rigid["race_force"].values)
    log.info("10^4 times as stiff: pocket forces differ by %.4f, race forces %.1e", error, races)
    assert error < FORCES and races < 1e-4
    assert b.max() == pytest.approx(a.max(), rel=FORCES)


def test_what_is_left_falls_as_the_cage_stiffens():
    """Forces of a mesh 10^5 times as stiff are ten times nearer the rigid cage's of brass."""
    left = []
    for factor in (1e4, 1e5):
        a, b = (ds["pocket_force"].values.astype(float) for ds in of_stiffness(factor))
        left.append(relative_error(b, a))
    log.info("10^4 and 10^5 times as stiff: pocket forces differ by %.5f and %.5f", *left)
    assert left[1] < 0.3 * left[0]


def test_ten_thousand_times_the_stiffness_gives_the_rigid_motion(stiff_runs):
    rigid, flexible = stiff_runs
    for name in ("cage_position", "inner_position"):
        moved = float(np.abs(rigid[name] - rigid[name][0]).max())
        # the inner ring moves by 0.25 um, of which a hundredth is ten times the tolerance
        share = 1e-3 if name == "cage_position" else 1e-2
        assert float(np.abs(flexible[name] - rigid[name]).max()) < share * moved, name
    apart = np.abs(flexible["element_position"] - rigid["element_position"]).max("time")
    assert float(apart.sel(cyl="r").max()) < 0.02e-6
    assert float(apart.sel(cyl="psi").max()) * 41.25e-3 < 0.5e-6  # each moved by 23 mm


@pytest.fixture(scope="module")
def frozen_and_rigid():
    """(case, flexible without residual compliance, rigid), with the same pocket law."""
    case = n1013(defects=bent("0.2 mm"))
    mesh, cage = cage_of(case)
    flexible = flexible_from_basis(
        cage.model.nodes, cage.model.mass_scalar, cage.basis, np.ones(cage.basis.size)
    )
    parts = {
        name: getattr(case, name) for name in ("contacts", "lubricant", "drive", "load", "mount")
    }

    def bearing(body, interface, pocket_law=None):
        model = MOTION.build_model(case.bearing, case.cage, body, interface, **parts)
        if pocket_law is not None:
            model.pocket.normal[:] = pocket_law
        layout = Layout(case.bearing.roller_count, bodies_of_bearing(body.modes))
        return BearingSystem(MOTION, case.bearing, model, case.contacts, layout)

    interface = replace(cage.interface, compliance=np.zeros_like(cage.interface.compliance))
    frozen = bearing(flexible, interface)
    rigid = bearing(
        rigid_from_tets(mesh.points, mesh.tets, case.cage.material.density),
        rigid_interface(case.cage, pocket_count=case.bearing.roller_count, defects=case.defects),
        frozen.data.model.pocket.normal,
    )
    return case, frozen, rigid


def test_frozen_modes_leave_the_rigid_equations(frozen_and_rigid):
    """In states with pocket contact and any accelerations, every rigid row is the rigid one."""
    _, frozen, rigid = frozen_and_rigid
    rng = np.random.default_rng(1)
    small, large = rigid.layout, frozen.layout
    mass = rigid.data.model.cage.mass
    for _ in range(5):
        y, yd = np.zeros(small.size), 10.0 * rng.standard_normal(small.size)
        q, u = small.q(y), small.u(y)
        q["elements"][:, 1] = 41.25e-3 + 4e-6 * rng.standard_normal(22)
        q["elements"][:, 2] = 2 * np.pi * np.arange(22) / 22 + 3e-3 * rng.standard_normal(22)
        q["elements"][:, 0] = 5e-6 * rng.standard_normal(22)
        q["elements"][:, 3:5] = 2e-3 * rng.standard_normal((22, 2))
        q["cage"][:] = 2e-4 * rng.standard_normal(3)
        q["quaternion"][:] = [1.0, 1e-4, 2e-4, -1e-4]
        for values in u.values():
            values[...] = rng.standard_normal(values.shape)
        u["omega"][0] = 280.0
        for bearing in (frozen, rigid):
            _set_onset_speeds(bearing, 0.3)
        expected = small.u(rigid.residual(0.0, y, yd))
        ours = large.u(frozen.residual(0.0, *(with_modes(small, large, v) for v in (y, yd))))
        rigid.residual(0.0, y, yd, 2)
        assert np.count_nonzero(rigid.data.work.report.pocket_normal) >= 5
        for name, values in expected.items():
            if name != "modes" and values.size:
                scale = np.abs(values).max() + 10.0 * mass
                np.testing.assert_allclose(ours[name], values, atol=1e-9 * scale, err_msg=name)


def test_modes_frozen_by_stiffness_run_as_the_rigid_cage(frozen_and_rigid):
    """Modal stiffness times 1e10: a frozen body with all its inertia coupling, no friction."""
    case, frozen, rigid = frozen_and_rigid
    both = {"solver.duration": "2 ms", "solver.method": "bdf"}  # no explicit step bears the frozen
    case = case.replace(si=False, **{**WINDOW, **both}, **FRICTIONLESS)
    datasets = []
    for bearing in (rigid, frozen):
        _set_onset_speeds(bearing, 0.0)
        body = bearing.data.model.cage
        model = bearing.data.model._replace(
            cage=body._replace(kff=1e10 * body.kff, dff=1e5 * body.dff)
        )
        one = BearingSystem(MOTION, case.bearing, model, case.contacts, bearing.layout,
                      block=case.output.block, stride=case.output.vibration_ratio)  # fmt: skip
        start = _start(one)
        datasets.append(march(case, one, *start))
    a, b = (ds["pocket_force"].values.astype(float) for ds in datasets)
    assert np.count_nonzero(a.max(axis=0)) > 5 and a.max() > 10.0
    error = relative_error(b, a)
    log.info("frozen modes: pocket forces differ by %.1e", error)
    assert error < 5e-3


def _set_onset_speeds(bearing: BearingSystem, speed: float) -> None:
    for speeds in bearing.data.memory[:4]:
        speeds[...] = speed


def _start(bearing: BearingSystem) -> tuple[np.ndarray, np.ndarray]:
    start = find_start(bearing, limit_force=1e9)
    return start.y, start.yd
