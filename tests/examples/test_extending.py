"""What "Extending" in flexcage/README.md promises: a module from outside adds to flexcage, which
stays as is."""

from __future__ import annotations

import importlib
import importlib.util
import os
import re
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import fsolve

from flexcage.case import extensions, load_case, load_extension, presets
from flexcage.contacts import laws
from flexcage.contacts import spec as contact_spec
from flexcage.core import registry as core_registry
from flexcage.core.environment import offscreen_backend
from flexcage.core.errors import InputError
from flexcage.geometry import materials
from flexcage.modes import registry as modes_registry
from flexcage.modes import spec as modes_spec
from flexcage.render import album
from flexcage.results import registry
from flexcage.results.figures.table import FIGURES
from flexcage.solve import integrators
from flexcage.solve import options as solver_options
from flexcage.system import constraints
from flexcage.system import spec as system_spec

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
LOAD, STIFFNESS, SLICES = 800.0, 2e7, 15  # N, N/m of a slice

CASE = """
[bearing]
preset = "my_bearing"
[mesh]
fineness = "coarse"
[contacts.race]
normal = {law = "spring", stiffness = "20 N/um"}
friction = {law = "limited_shear", limit = 0.05, scale = "0.3 m/s"}
[lubricant]
rolling_resistance = "none"
[drive]                   # so fast a ramp that rollers slide
speed = "3000 rpm"
ramp_to = "3600 rpm"
ramp_time = "1 ms"
[load]
radial = "800 N"
gravity = "0 m/s^2"
[[constraints]]
type = "rail"
azimuth = "30 deg"
[modes]
kind = "pocket_shapes"
count = 8
[solver]
method = "heun"
max_step = "0.5 us"
duration = "1 ms"
[output]
block = 10
"""


ALL_TABLES = (
    laws.NORMAL_LAWS, laws.FRICTION_LAWS, laws.NORMAL_PARAMETERS, laws.FRICTION_PARAMETERS,
    contact_spec.NORMAL_LAWS, contact_spec.FRICTION_LAWS, modes_registry.BUILDERS,
    modes_spec.KINDS, registry.VARIABLES._added, FIGURES._added,
    registry.LABELS._added, registry.COMPUTED,
    album.PICTURES, materials.MATERIALS, presets._ADDED, core_registry._sources,
    integrators.INTEGRATORS, solver_options.METHODS, constraints.KINDS, system_spec.CONSTRAINTS,
)  # fmt: skip


@contextmanager
def restored():
    """Leaves every table as it was."""
    saved, loaded = [dict(table) for table in ALL_TABLES], list(extensions._loaded)
    yield
    extensions._loaded[:] = loaded
    for table, before in zip(ALL_TABLES, saved, strict=True):
        table.clear()
        table.update(before)


@pytest.fixture(autouse=True)
def tables():
    """Other tests do not see what is registered here."""
    with restored():
        yield


@pytest.fixture
def mine(tables, monkeypatch):
    """The user's module, imported as any other."""
    monkeypatch.syspath_prepend(HERE)
    yield importlib.import_module("my_extensions")
    del sys.modules["my_extensions"]


def law_checks():
    spec = importlib.util.spec_from_file_location("checks", ROOT / "tests/contacts/law_checks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_laws_pass_the_checks_of_every_law(mine):
    checks = law_checks()
    p = laws.normal_parameters(mine.Spring(stiffness=STIFFNESS, loss=2e-7), 1e9, 10 / 9)
    assert p[:2] == pytest.approx([STIFFNESS, 1.0])
    checks.check_normal_law(laws.NORMAL_LAWS["spring"], p)
    p = laws.friction_parameters(mine.LimitedShear())
    checks.check_friction_law(laws.FRICTION_LAWS["limited_shear"], p, top=0.06)


def roller_loads(centre: np.ndarray, psi: np.ndarray, clearance: float, centrifugal: np.ndarray):
    """Forces (Z,) of two linear races in series on rollers at psi, the rings' centres apart."""
    k = SLICES * STIFFNESS
    approach = centre[0] * np.cos(psi) + centre[1] * np.sin(psi) - 0.5 * clearance
    return np.maximum(0.5 * (k * approach - centrifugal), 0.0)


def balance(centre: np.ndarray, psi: np.ndarray, *args) -> np.ndarray:
    """Load less the rollers' resultant, y and z."""
    force = roller_loads(centre, psi, *args)
    return np.array([LOAD - force @ np.cos(psi), force @ np.sin(psi)])


def test_a_run_with_all_of_it(mine, tmp_path):
    """Static load distribution and friction are what the registered laws make them."""
    from flexcage.simulate import simulate

    case = load_case(CASE).replace("cage.model", "rigid")
    assert case.contacts.race.normal == mine.Spring(stiffness=STIFFNESS)
    assert load_case(case.to_toml()) == case
    assert case.assumptions["cage.pocket_width"] == "0.2 mm of clearance"
    run = simulate(case, out=tmp_path / "run")
    ds, bearing = run.dataset, case.bearing

    psi = ds["element_position"].sel(cyl="psi").values
    force = ds["race_force"].sel(race="inner").values
    speed = ds["element_velocity"].sel(cyl="psi").values
    centrifugal = bearing.roller_mass * speed**2 / ds["element_position"].sel(cyl="r").values
    expected = np.empty_like(force)
    for t, angles in enumerate(psi):
        args = angles, bearing.radial_clearance, centrifugal[t]
        expected[t] = roller_loads(fsolve(balance, [1e-5, 0.0], args=args), *args)
    late = slice(ds.sizes["time"] // 2, None)
    # nothing damps these springs: the ring goes on swinging about its place
    assert force[late].mean(axis=0) == pytest.approx(expected[late].mean(axis=0), abs=0.03 * LOAD)
    assert expected.max() > 0.3 * LOAD

    slip = ds["race_slip"].sel(race="inner").values
    traction = ds["race_traction"].sel(race="inner").values
    mu = 0.05 * np.tanh(np.abs(slip) / 0.3)
    assert np.abs(np.abs(traction) - mu * force).max() < 0.01 * np.abs(traction).max()
    assert np.abs(traction).max() > 0.1 and mu.max() > 0.005

    cage = ds["cage_position"].values[:, 1:]
    assert np.abs(cage @ [-0.5, np.sqrt(0.75)]).max() < 1e-12 < 1e-9 < np.abs(cage).max()

    ring = ds["ring_force"]
    assert ring.dims == ("time", "axis2") and ring.attrs["units"] == "N"
    np.testing.assert_allclose(ring[late].mean("time"), [-LOAD, 0.0], atol=2e-3 * LOAD)
    volume = run.summary["cage_mass"] / 8800.0
    assert volume == pytest.approx(np.pi / 4 * (47e-3**2 - 40e-3**2) * 16e-3 * 0.68, rel=0.1)
    if offscreen_backend() is not None:
        assert tmp_path / "ring_force.png" in run.draw(tmp_path)
        assert (tmp_path / "ring_force.png").stat().st_size > 5_000


def test_a_basis_bounds_the_frequencies_from_above(mine):
    """Rayleigh: a basis' frequencies lie above the free modes', and close to the lowest."""
    from flexcage.stages import cage_mesh, cage_reduction

    case = load_case(CASE)
    mesh = cage_mesh(case)
    reduced = cage_reduction(case, mesh)
    model, basis = reduced.model, reduced.basis
    assert basis.name == "pocket_shapes" and basis.size == 8
    shapes = basis.shapes.reshape(model.n_dof, -1)
    assert np.abs(model.rigid_modes.T @ model.mass_times(shapes)).max() < 1e-8
    free = cage_reduction(case.replace("modes.kind", "free_free"), mesh).basis
    assert np.all(basis.frequencies >= free.frequencies[:8] * (1.0 - 1e-9))
    assert basis.frequencies[:2] == pytest.approx(free.frequencies[:2], rel=0.1)
    assert case.replace("modes.kind", "ritz").modes.count == 8  # back to the plain spec


def test_nothing_recompiles_for_a_new_law(mine):
    """Compiled on import: the laws, and with them no kernel of the program."""
    from flexcage.system.problem import law_functions

    if not os.environ.get("NUMBA_DISABLE_JIT"):
        for name in ("spring", "limited_shear"):
            law = {**laws.NORMAL_LAWS, **laws.FRICTION_LAWS}[name]
            assert len(law.nopython_signatures) == 1
    chosen = law_functions(load_case(CASE).contacts)
    assert len(chosen) == 10 and chosen[0] is laws.NORMAL_LAWS["spring"]


def test_an_edited_law_makes_another_case(tmp_path, tables):
    """A run does not go on, nor a cache answer, with a law that has changed since."""
    source = (HERE / "my_extensions.py").read_text("utf-8")
    hashes = []
    for text in (source, source, source.replace("p[0] * (d[i] +", "p[0] * (1.0 * d[i] +")):
        file = tmp_path / f"edition{len(hashes)}.py"
        file.write_text(text)
        (tmp_path / "my_bearing.toml").write_bytes((HERE / "my_bearing.toml").read_bytes())
        with restored():
            load_extension(file)
            hashes.append((load_case(CASE).hash, load_case(PLAIN).hash))
    assert hashes[0] == hashes[1] and hashes[1][0] != hashes[2][0] and hashes[1][1] == hashes[2][1]


def test_names_of_ones_own_are_refused_like_all_others(mine):
    for changes, words in (
        ('normal.law="sprong"', ["'sprong' is not known", "the nearest known one is 'spring'"]),
        ('normal.law="hertz"', ["'hertz' is not known", "choose from", "--use FILE"]),
        ('normal={law="spring"}', ["lacks 'stiffness'", "N/um"]),
        ('normal={law="spring", stiffness="20 mm"}', ["normal.stiffness", "N/um"]),
        ('normal={law="spring", stifness="20 N/um"}', ["'stifness'", "'stiffness'"]),
        ('normal={law="elastic", stiffness="20 N/um"}', ["Unknown key 'stiffness'"]),
    ):
        text = re.sub(r"^normal = .*$", changes, CASE, flags=re.M)
        with pytest.raises(InputError) as caught:
            load_case(text)
        assert all(word in str(caught.value) for word in words), str(caught.value)
    case = load_case(CASE)
    plain = case.replace("contacts.race.normal.law", "restitution")
    assert type(plain.contacts.race.normal) is contact_spec.NormalLaw
    with pytest.raises(InputError, match="whose values are those of Spring, not of NormalLaw"):
        case.replace("contacts.race.normal", contact_spec.NormalLaw(law="spring"))


def test_taken_names_and_wrong_parts_are_refused(mine):
    from flexcage.render import register_picture

    m = mine
    bronze = materials.MATERIALS["my_bronze"]
    unnamed = materials.Material(name="tin", youngs_modulus=50e9, poisson_ratio=0.3, density=7300.0)
    attempts = [
        (lambda: laws.register_normal("spring", m.spring), "normal law 'spring' exists already"),
        (lambda: laws.register_normal("no name", m.spring), "one word"),
        (lambda: laws.register_normal("coil", m.spring, spec=m.Spring), "must to 'coil'"),
        (lambda: laws.register_normal("coil", m.spring, spec=FrictionLike), "derived from"),
        (lambda: laws.register_friction("none", m.limited_shear), "'none' exists already"),
        (lambda: modes_registry.register_basis("ritz", m.pocket_shapes), "'ritz' exists already"),
        (lambda: register_picture("orbit", m.ring_force_picture), "'orbit' exists already"),
        (lambda: materials.register_material(bronze), "'my_bronze' exists already"),
        (lambda: materials.register_material(unnamed), "has no source"),
        (lambda: presets.register_preset(HERE / "my_bearing.toml"), "'my_bearing' exists already"),
        (lambda: presets.register_preset(HERE / "none.toml"), "cannot be read"),
        (lambda: laws.register_normal("bad", law_of_old), r"takes .*Fd, Fv\), but .*F, Fe, Fd, Fv"),
    ]
    if not os.environ.get("NUMBA_DISABLE_JIT"):
        attempts += [
            (
                lambda: laws.register_normal("bad", unbound_law),
                r"'bad' \(n, d.*name 'undefined_name",
            ),
            (
                lambda: laws.register_normal("bad", law_that_returns),
                r"returns a value.*\(line \d+ of",
            ),
            (lambda: laws.register_normal("bad", law_with_arrays), "makes an array of its own"),
            (lambda: laws.register_friction("bad", friction_by_text), "numba does not know this"),
        ]
    for attempt, words in attempts:
        with pytest.raises(InputError, match=words):
            attempt()
    assert "coil" not in laws.NORMAL_LAWS and "bad" not in contact_spec.NORMAL_LAWS


class FrictionLike:
    law = "coil"


def law_of_old(n, d, v, onset, p, F, Fd, Fv):
    """Before laws had to give their elastic part."""


def law_that_returns(n, d, v, onset, p, F, Fe, Fd, Fv):
    return p[0] * d


def law_with_arrays(n, d, v, onset, p, F, Fe, Fd, Fv):
    F = p[0] * d  # noqa: F841


def friction_by_text(n, u, p, g, dg):
    g[0] = p["static"]


def unbound_law(n, d, v, onset, p, F, Fe, Fd, Fv):
    F[0] = undefined_name  # noqa: F821


def test_a_rigid_motion_in_a_basis_is_refused(mine):
    from dataclasses import replace

    from flexcage.stages import cage_mesh, cage_reduction

    def careless(solver, *, pocket_count, spec):
        basis = mine.pocket_shapes(solver, pocket_count=pocket_count, spec=mine.PocketShapes())
        stiffness = basis.stiffness.copy()
        stiffness[0, 0] = 0.0
        return replace(basis, stiffness=stiffness)

    modes_registry.register_basis("careless", careless)
    case = load_case(CASE.replace("pocket_shapes", "careless"))
    with pytest.raises(InputError, match="six rigid motions"):
        cage_reduction(case, cage_mesh(case))


def test_the_command_line_uses_a_file(tmp_path):
    """In a process of its own, whose cwd is not the file's."""
    case = tmp_path / "case.toml"
    case.write_text(CASE)
    command = [sys.executable, "-m", "flexcage.cli", "presets", "my_bearing"]
    done = subprocess.run(
        [*command, "--use", str(HERE / "my_extensions.py")],
        capture_output=True, text=True, cwd=tmp_path, check=False,
    )  # fmt: skip
    assert done.returncode == 0 and "12 rollers" in done.stdout, done.stderr
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 2 and "'my_bearing' is not known" in done.stderr


def test_files_that_cannot_be_loaded(tmp_path):
    (tmp_path / "broken.py").write_text("raise RuntimeError('not today')\n")
    (tmp_path / "script.py").write_text("raise SystemExit(0)\n")
    (tmp_path / "laws.txt").write_text("")
    for source, words in (
        (tmp_path / "none.py", "There is no file"),
        (tmp_path / "broken.py", "RuntimeError: not today"),
        (tmp_path / "script.py", "ends the program as it is loaded"),
        (tmp_path / "laws.txt", "is no file that can be loaded: .py"),
        (str(tmp_path / "laws.txt"), "is no file that can be loaded: .py"),
        ("no_such_module_here", "ModuleNotFoundError"),
    ):
        with pytest.raises(InputError, match=words):
            load_extension(source)


def blocks_of_the_page():
    page = (ROOT / "flexcage" / "README.md").read_text("utf-8")
    section = page.split("## Extending")[1].split("\n## ")[0]
    return re.findall(r"```python\n(.*?)```", section, flags=re.S)


def test_the_law_of_the_page(tmp_path):
    """The page's own example works as printed, and is a law like the others."""
    code = blocks_of_the_page()[0]
    assert sum(1 for line in code.splitlines() if line) <= 15
    file = tmp_path / "my_laws.py"
    file.write_text(code)
    load_extension(file)
    case = load_case(CASE_OF_PAGE)
    law = case.contacts.pocket.normal
    p = laws.normal_parameters(law, 1e8, 1.0)
    assert p[0] == pytest.approx(2e6)
    place = "contacts.pocket.normal"
    varied = {f"{place}.stiffness": "2 N/um", f"{place}.law": "soft_wall"}  # in any order
    assert load_case(PLAIN, overrides=varied) == case
    law_checks().check_normal_law(laws.NORMAL_LAWS[law.law], p)


def test_the_constraint_of_the_page(tmp_path):
    from flexcage.simulate import simulate

    file = tmp_path / "my_constraint.py"
    file.write_text(blocks_of_the_page()[1])
    load_extension(file)
    case = load_case(PLAIN + '[[constraints]]\ntype = "in_plane"\n')
    varied = {"cage.model": "rigid", "mesh.fineness": "coarse", "solver.duration": "0.5 ms"}
    ds = simulate(case.replace(**varied)).dataset
    assert np.abs(ds["cage_position"].sel(axis="x")).max() < 1e-12
    assert ds["constraint"].values[-1] == "in_plane"


def test_the_figure_of_the_page(tmp_path):
    from flexcage.simulate import simulate

    file = tmp_path / "my_figure.py"
    file.write_text(blocks_of_the_page()[2])
    load_extension(file)
    varied = {"cage.model": "rigid", "mesh.fineness": "coarse", "solver.duration": "2 ms"}
    summary = simulate(load_case(PLAIN).replace(**varied)).summary
    assert summary["cage_offset"] == pytest.approx(summary["whirl_radius_axis"], rel=1e-9)
    assert summary["cage_offset"] > 1e-6 and summary.row("cage_offset").record is not None


PLAIN = '[bearing]\npreset = "N1013"\n'
CASE_OF_PAGE = """
bearing.preset = "N1013"
[contacts.pocket.normal]
law = "soft_wall"
stiffness = "2 N/um"
"""
