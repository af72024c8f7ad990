"""An elastic housing under the outer ring in the static solution."""

from __future__ import annotations

import dataclasses
import re
import shutil
import subprocess
from types import SimpleNamespace

import numpy as np
import pytest
import skfem

import flexcage
from flexcage.bearings import statics_of
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.cage_mesh import signed_volumes
from flexcage.modes.exchange.body import MODAL, ReducedBody
from flexcage.modes.exchange.formats import write_body
from flexcage.static import solve_static
from flexcage.system.seat import seat_compliance
from flexcage.system.spec import Load, Mount
from flexcage.system.statics.solve import solve_bearing
from flexcage.system.statics.yielding import on_seat, questioned

STEEL = MATERIALS["steel"]
RADIUS, WALL, WIDTH = 40e-3, 12e-3, 16e-3  # of the seat, of the housing
AROUND, DEEP, LONG = 16, 2, 2


@pytest.fixture(scope="module")
def tube():
    """A housing: a ring of linear tetrahedra round the seat, its outside to be held."""
    grid = [np.linspace(0, 1, n + 1) for n in (LONG, AROUND, DEEP)]
    mesh = skfem.MeshTet.init_tensor(*grid)
    x, turn, r = mesh.p
    angle = 2.0 * np.pi * turn
    own = RADIUS + WALL * r
    points = np.column_stack([WIDTH * (x - 0.5), own * np.cos(angle), own * np.sin(angle)])
    _, first, back = np.unique(
        np.round(points, 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    tets = back.ravel()[mesh.t.T]
    points = points[first]
    turned = signed_volumes(points, tets) < 0.0
    tets = np.where(turned[:, None], tets[:, [0, 2, 1, 3]], tets)
    return assemble(SimpleNamespace(points=points, tets=tets, groups={}), STEEL, order=1)


def at(model, radius):
    return np.flatnonzero(np.isclose(np.hypot(*model.nodes[:, 1:].T), radius))


@pytest.fixture(scope="module")
def feet(tube):
    """The outer nodes at the bottom: held to the ground, so that y and z differ."""
    outer = at(tube, RADIUS + WALL)
    return outer[tube.nodes[outer, 1] < -0.8 * RADIUS]


def condensed(model, seat, feet):
    """Stiffness of the seat's nodes, by dense algebra; what Guyan's reduction gives anywhere."""
    K = model.K.toarray()
    kept = (3 * seat[:, None] + np.arange(3)).ravel()
    gone = (3 * feet[:, None] + np.arange(3)).ravel()
    rest = np.setdiff1d(np.arange(len(K)), np.concatenate([kept, gone]))
    K_kr = K[np.ix_(kept, rest)]
    return K[np.ix_(kept, kept)] - K_kr @ np.linalg.solve(K[np.ix_(rest, rest)], K_kr.T)


@pytest.fixture(scope="module")
def housing(tube, feet):
    seat = at(tube, RADIUS)
    stiffness = condensed(tube, seat, feet)
    # two fixed-interface modes, which stand apart in the stiffness: nothing of them shows at rest
    whole = np.zeros((len(stiffness) + 2,) * 2)
    whole[:-2, :-2] = stiffness
    whole[-2:, -2:] = np.diag([1e9, 2e9])
    dofs = [(node, axis) for node in range(len(seat)) for axis in range(3)] + [(MODAL, 0)] * 2
    return ReducedBody(
        stiffness=whole, mass=np.eye(len(whole)), nodes=tube.nodes[seat], dofs=np.array(dofs)
    )


@pytest.fixture
def file(housing, tmp_path):
    return str(write_body(housing, tmp_path / "housing.npz"))


def compliance(file, diameter=2 * RADIUS, width=WIDTH, **values):
    return seat_compliance(Mount(body=file, **values), diameter=diameter, width=width)


def calculix(model, seat, feet, folder, load):
    """Displacements (6,) of the seat's rigid frame under a load (6,), by CalculiX."""
    n = len(model.nodes)
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{i + 1}, " + ", ".join(f"{c:.11g}" for c in p) for i, p in enumerate(model.nodes)]
    lines += [f"{n + 1}, 0, 0, 0", f"{n + 2}, 0, 0, 0", "*ELEMENT, TYPE=C3D4, ELSET=BODY"]
    tets = model.tets
    back = signed_volumes(model.points, tets) < 0.0
    tets = np.where(back[:, None], tets[:, [0, 2, 1, 3]], tets)
    lines += [f"{i + 1}, " + ", ".join(map(str, t + 1)) for i, t in enumerate(tets)]
    for name, nodes in (("SEAT", seat), ("FEET", feet)):
        lines += [f"*NSET, NSET={name}", *(f"{k + 1}," for k in nodes)]
    lines += [f"*NSET, NSET=RING\n{n + 1},\n{n + 2},"]
    lines += [
        f"*RIGID BODY, NSET=SEAT, REF NODE={n + 1}, ROT NODE={n + 2}",
        "*MATERIAL, NAME=STEEL", "*ELASTIC", f"{STEEL.youngs_modulus}, {STEEL.poisson_ratio}",
        "*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL", "*BOUNDARY", "FEET, 1, 3",
        "*STEP", "*STATIC", "*CLOAD",
    ]  # fmt: skip
    lines += [f"{n + 1 + k // 3}, {k % 3 + 1}, {load[k]:.15g}" for k in range(6) if load[k]]
    lines += ["*NODE PRINT, NSET=RING", "U", "*END STEP", ""]
    (folder / "job.inp").write_text("\n".join(lines))
    done = subprocess.run(["ccx", "job"], cwd=folder, capture_output=True, text=True, timeout=300)
    text = (folder / "job.dat").read_text() if (folder / "job.dat").is_file() else ""
    rows = re.findall(r"^\s+\d+((?:\s+-?\d\.\d+E[+-]\d+){3})\s*$", text, re.MULTILINE)
    assert len(rows) == 2, done.stdout[-1500:]
    return np.array([float(v) for row in rows for v in row.split()])


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize("k", [1, 4])
def test_a_rigid_ring_in_a_housing_by_calculix(tube, feet, file, tmp_path, k):
    """The whole mesh with a rigid seat, another program: displacement of the ring's frame."""
    load = np.zeros(6)
    load[[0, 1, 2, 4, 5][k]] = 1000.0 if k < 3 else 20.0
    found = calculix(tube, at(tube, RADIUS), feet, tmp_path, load)[[0, 1, 2, 4, 5]]
    ours = compliance(file) @ load[[0, 1, 2, 4, 5]]
    np.testing.assert_allclose(ours, found, atol=2e-5 * np.abs(found[:3]).max(), rtol=2e-5)


def test_an_average_yields_more_than_a_rigid_ring(file):
    """RBE3 leaves the seat soft (Rayleigh): any load finds more compliance; symmetric both."""
    rigid, average = compliance(file), compliance(file, seat_tie="average")
    np.testing.assert_allclose(rigid, rigid.T, atol=1e-12 * np.abs(rigid).max())
    assert np.linalg.eigvalsh(average - rigid)[0] > -1e-12 * average.max()
    assert average[1, 1] > 1.02 * rigid[1, 1]
    assert rigid[2, 2] > 1.5 * rigid[1, 1]  # held below alone


def test_a_seat_among_other_nodes_by_its_set(tube, feet, file, tmp_path):
    """An Abaqus substructure in N, mm, t without a mass, with a node at the top that bears nothing:
    its deck's set says which are the seat."""
    seat = at(tube, RADIUS)
    top = int(np.argmax(tube.nodes[:, 1]))
    nodes = np.append(seat, top)
    stiffness = condensed(tube, nodes, feet)
    body = ReducedBody(
        stiffness=stiffness * 1e-3,
        mass=None,
        nodes=tube.nodes[nodes] * 1e3,
        dofs=np.array([(node, axis) for node in range(len(nodes)) for axis in range(3)]),
    )
    path = str(write_body(body, tmp_path / "z1.mtx"))
    deck = tmp_path / "job.inp"
    lines = ["*NODE"]
    lines += [f"{i + 1}, " + ", ".join(f"{c:.11g}" for c in p) for i, p in enumerate(body.nodes)]
    lines += ["*NSET, NSET=Seat, GENERATE", f"1, {len(seat)}"]
    deck.write_text("\n".join([*lines, ""]))
    given = {"body_nodes": str(deck), "body_units": "mm-t-s"}
    refused(path, "lies 52 mm from the axis", **given)
    for tie in ("rigid", "average"):
        wanted = compliance(file, seat_tie=tie)
        found = compliance(path, seat="SEAT", seat_tie=tie, **given)
        np.testing.assert_allclose(found, wanted, atol=1e-8 * np.abs(wanted).max())


def test_one_node_in_the_centre(file, housing, tmp_path):
    """Another program tied the seat: one node of six degrees of freedom."""
    whole = np.linalg.inv(np.array([[2.0, 0.3], [0.3, 1.0]]))
    stiffness = np.kron(whole, np.diag([1e8, 2e8, 3e8]))
    body = ReducedBody(
        stiffness=stiffness,
        mass=np.eye(6),
        nodes=np.zeros((1, 3)),
        dofs=np.stack([np.zeros(6, int), np.arange(6)], axis=1),
    )
    path = str(write_body(body, tmp_path / "tied.npz"))
    wanted = np.linalg.inv(stiffness)[np.ix_([0, 1, 2, 4, 5], [0, 1, 2, 4, 5])]
    for tie in ("rigid", "average"):
        np.testing.assert_allclose(compliance(path, seat_tie=tie), wanted, rtol=1e-9, atol=1e-20)


@pytest.fixture(scope="module")
def bearing():
    return load_preset("7010C-PI").bearing


def solved(bearing, seat=None, **load):
    return solve_bearing(bearing, statics_of(bearing), load=Load(**load), speed=700.0, seat=seat)


def test_seat_and_bearing_are_springs_in_series(bearing):
    """Free motions, given loads: elements see what they see on a rigid seat, and the ring is
    displaced by S F more; stiffness over the whole displacement is a difference of loads."""
    seat = np.diag([2e-9, 5e-9, 3e-9, 4e-6, 1e-6])
    seat[1, 4] = seat[4, 1] = 1e-8
    load = {"radial": 300.0, "axial": 400.0, "moment_y": 1.0, "tilt": "free"}
    rigid, soft = solved(bearing, **load), solved(bearing, seat, **load)
    np.testing.assert_allclose(soft.elements.force, rigid.elements.force, rtol=1e-7)
    np.testing.assert_allclose(soft.outer, seat @ soft.load, rtol=1e-7, atol=1e-15)
    wanted = rigid.displacement + soft.outer
    np.testing.assert_allclose(soft.displacement, wanted, rtol=1e-7, atol=1e-14)
    more = solved(bearing, seat, **{**load, "axial": 400.1})
    moved = more.displacement - soft.displacement
    np.testing.assert_allclose(soft.stiffness @ moved, more.load - soft.load, atol=1e-4)
    series = np.linalg.inv(np.linalg.inv(rigid.stiffness) + seat)
    np.testing.assert_allclose(on_seat(rigid.stiffness, seat), series, rtol=1e-9)


@pytest.mark.parametrize("softness", [1.0, 100.0, 1e4])
def test_a_tilt_that_is_held_is_shared_with_the_seat(bearing, softness):
    """Held in space, not relative to the outer ring: what elements see is a rigid seat's at the
    rest of the tilt, and the moment that they bear turns the seat by the remainder."""
    turn = softness * 1e-6  # rad/(N m); the bearing has some 4e-4
    seat = np.diag([1e-9, 2e-9, 2e-9, turn, turn])
    load = {"radial": 300.0, "axial": 400.0, "misalignment": 0.5e-3}
    soft = solved(bearing, seat, **load)
    assert soft.displacement[4] == pytest.approx(0.5e-3, abs=1e-9)
    seen = soft.displacement - soft.outer
    assert soft.outer[4] == pytest.approx(turn * soft.reaction[4], rel=1e-6)
    # of the tilts that are seen, the one about y has no key of its own: it is small, and left out
    again = solved(bearing, **{**load, "misalignment": seen[4]})
    largest = again.elements.force.max()
    assert np.abs(again.elements.force - soft.elements.force).max() < 2e-3 * largest
    if softness == 1e4:  # the seat gives way: elements see nearly the tilt without a moment
        free = solved(bearing, radial=300.0, axial=400.0, tilt="free").displacement[4]
        assert seen[4] == pytest.approx(free, rel=0.1)


def test_in_a_case_file(file, tmp_path, monkeypatch):
    text = (
        '[bearing]\npreset = "7010C-PI"\n[load]\naxial = "400 N"\nradial = "300 N"\n'
        '[mount]\nbody = "housing.npz"\nkind = "bushing"\n'
    )
    path = tmp_path / "case.toml"
    path.write_text(text)
    case = flexcage.load_static(path)  # a path relative to the case, wherever one stands
    assert case.mount.body == file and case.mount.kind == "fixed"  # statics read the body alone
    solution = solve_static(case)
    assert solution.outer[1] > 0.0 and "of it, the outer ring's" in solution.table()
    assert flexcage.load_static(case.to_toml()).mount == case.mount
    rigid = solve_static(flexcage.load_static(path, overrides={"mount.body": ""}))
    assert not rigid.outer.any() and "the outer ring's" not in rigid.table()
    with pytest.raises(InputError, match="mount.body is given, but mount.kind is 'bushing'"):
        flexcage.load_case(path)
    with pytest.raises(InputError, match="'mount.mass' takes no part in a static solution"):
        flexcage.load_static(path, overrides={"mount.mass": "1 kg"})


@pytest.mark.parametrize(("factor", "odd"), [(1.0, False), (1e-3, True), (1e3, True)])
def test_a_housing_far_softer_or_stiffer_than_steel_is_questioned(file, bearing, factor, odd):
    """As of a stiffness in N/mm that was taken for N/m, or the other way round."""
    mount = Mount(body=file)
    said = questioned(mount, bearing, compliance(file) / factor)
    assert bool(said) == odd
    if odd:
        assert "mount.body_units 'm-kg-s'" in said[0] and "N/um across the axis" in said[0]
    assert not questioned(Mount(kind="bushing"), bearing, compliance(file) / factor)


# --- what does not fit ---------------------------------------------------------------------------


def refused(file, words, **values):
    with pytest.raises(InputError, match=words) as caught:
        compliance(file, **values)
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


def test_nodes_off_the_seat(file, housing, tmp_path):
    refused(file, "node .* lies 40 mm from the axis .* seat has a radius of 45 mm", diameter=90e-3)
    refused(file, "node .* reaches x = 4 mm on either side; name the seat's nodes", width=8e-3)
    in_mm = dataclasses.replace(housing, nodes=1e3 * housing.nodes)
    path = str(write_body(in_mm, tmp_path / "mm.npz"))
    refused(path, 'set mount.body_units = "mm-t-s"')
    refused(file, "mount.seat is 'BORE', but .* has no sets of nodes", seat="BORE")


def test_a_housing_that_nothing_holds(tube, tmp_path):
    seat = at(tube, RADIUS)
    K = condensed(tube, seat, np.array([], int))
    dofs = np.array([(node, axis) for node in range(len(seat)) for axis in range(3)])
    free = ReducedBody(stiffness=K, mass=np.eye(len(K)), nodes=tube.nodes[seat], dofs=dofs)
    path = str(write_body(free, tmp_path / "free.npz"))
    for tie in ("rigid", "average"):
        refused(path, "singular: nothing holds the housing to the ground", seat_tie=tie)


def test_too_few_nodes(housing, tmp_path):
    two = np.array([0, 1, 2, 3, 4, 5])
    few = dataclasses.replace(
        housing,
        stiffness=np.eye(6) * 1e8,
        mass=np.eye(6),
        nodes=housing.nodes[:2],
        dofs=housing.dofs[two],
    )
    refused(str(write_body(few, tmp_path / "few.npz")), "give three nodes or more")
