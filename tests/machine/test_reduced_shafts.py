"""Shafts from files of reduced bodies, beside the beams that they were made of."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from reduced_shafts import LENGTH, beam_body, beams, reduced, rotor, shaft_of

from flexcage import load_machine, solve_machine
from flexcage.core.errors import InputError
from flexcage.machine.rotor import TurningShaft
from flexcage.machine_run.turning import turning_of
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.formats import read_body, write_body

ELEMENTS = 30
SPEED = 12000 * np.pi / 30


def solved(shaft, **changes):
    return solve_machine(load_machine(rotor(shaft, **changes)))


@pytest.fixture(scope="module")
def beam():
    return solved(beams(ELEMENTS))


@pytest.fixture(scope="module")
def whole():
    return beam_body(ELEMENTS)


def assert_at_rest_alike(found, beam, within):
    """Forces, displacements, stiffness at the wheel."""
    for name in ("front", "rear"):
        size = np.abs(beam[name].force).max()
        np.testing.assert_allclose(found[name].force, beam[name].force, atol=within * size)
    for place in (0.0, 0.15, 0.26):
        size = np.abs(beam.deflection(place)).max()
        np.testing.assert_allclose(
            found.deflection(place), beam.deflection(place), atol=within * size
        )
    ours, theirs = (np.diag(s.stiffness_at(0.0)) for s in (found, beam))
    np.testing.assert_allclose(ours, theirs, rtol=1e-7)  # springs that hold what nothing does


def assert_turns_alike(found, beam, *, critical, natural, count=3):
    ours, theirs = (s.linearised for s in (found, beam))
    np.testing.assert_allclose(
        ours.critical_speeds()[:count], theirs.critical_speeds()[:count], rtol=critical
    )
    for w in (0.0, SPEED):
        a, b = ours.frequencies(w, 6), theirs.frequencies(w, 6)
        np.testing.assert_allclose(a[0], b[0], rtol=natural)
        assert w == 0.0 or a[1] == b[1]  # at rest whirls have no way
    a, b = (lines.response(np.array([SPEED]))[0][0] for lines in (ours, theirs))
    np.testing.assert_allclose(a, b, atol=10.0 * natural * np.abs(b).max())


@pytest.mark.parametrize("spin", [True, False])
@pytest.mark.parametrize("ending", ["npz", "op4"])
def test_whole_matrices_are_the_beam_shaft(beam, tmp_path, spin, ending):
    body = beam_body(ELEMENTS, spin=spin)
    found = solved(shaft_of(body, tmp_path, ending))
    assert_at_rest_alike(found, beam, 1e-9)
    assert_turns_alike(found, beam, critical=1e-8, natural=1e-9)


def test_polar_inertia_of_the_nodes_makes_gyroscopic_moments(beam, whole, tmp_path):
    """Without G. Rest is exact; lumping costs 1e-5 of critical speeds with 30 elements."""
    body = dataclasses.replace(whole, gyroscopic=None)
    found = solved(shaft_of(body, tmp_path))
    assert_at_rest_alike(found, beam, 1e-9)
    assert_turns_alike(found, beam, critical=2e-5, natural=1e-5)
    assert solved(shaft_of(whole, tmp_path)).linearised.gyroscopic.sum() == pytest.approx(0.0)
    own = (s.shaft for s in (found, beam))
    polar = [
        u[:, 3] @ s.gyroscopic @ u[:, 4] for s in own for u in (s.rigid_about(0.1),)
    ]  # of the whole, with the wheel
    assert polar[0] == pytest.approx(polar[1], rel=1e-12)


@pytest.mark.parametrize(("modes", "critical", "natural"), [(0, 0.01, 0.01), (40, 2e-4, 5e-5)])
@pytest.mark.parametrize("given", [True, False])
def test_a_reduction_is_exact_at_rest_and_near_at_speed(
    beam, whole, tmp_path, modes, critical, natural, given
):
    """Craig and Bampton's, of five stations; torsional modes among its coordinates are left out."""
    body = whole if given else dataclasses.replace(whole, gyroscopic=None)
    found = solved(shaft_of(reduced(body, modes), tmp_path))
    assert_at_rest_alike(found, beam, 1e-9)
    more = 1.0 if given else 10.0
    assert_turns_alike(found, beam, critical=more * critical, natural=more * natural)
    assert len(found.linearised.mass) <= 25 + modes - (1 if modes else 0)
    weight = found.bearings[0].force + found.bearings[1].force
    assert found.sections.force[0, 2] == pytest.approx(beam.sections.force[0, 2], abs=3.0)
    assert weight[2] == pytest.approx(50.0, rel=1e-9)


def test_a_rigid_body_is_the_rigid_shaft(whole, tmp_path):
    body, sections = shaft_of(whole, tmp_path), beams(ELEMENTS)
    ours, theirs = (solved(s, kind="rigid") for s in (body, sections))
    for name in ("front", "rear"):
        np.testing.assert_allclose(ours[name].force, theirs[name].force, rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(
        ours.linearised.critical_speeds()[:2], theirs.linearised.critical_speeds()[:2], rtol=1e-9
    )


def test_other_units_are_read(beam, whole, tmp_path):
    """N/mm, t mm^2 and mm are what millimetres, tonnes and seconds make of it."""
    per = np.where(whole.dofs[:, 1] < 3, 1e-3, 1.0)  # m of a coordinate's unit
    energy = np.outer(per, per) * 1e3  # mJ
    body = ReducedBody(
        stiffness=whole.stiffness * energy, mass=whole.mass * energy,
        gyroscopic=whole.gyroscopic * energy, nodes=1e3 * whole.nodes, dofs=whole.dofs,
    )  # fmt: skip
    found = solved(shaft_of(body, tmp_path), body_units="mm-t-s")
    assert_at_rest_alike(found, beam, 1e-9)
    assert_turns_alike(found, beam, critical=1e-8, natural=1e-9)
    with pytest.raises(InputError, match=r"from 0 to 260 mm; set shaft.body_units = \"mm-t-s\""):
        solved(shaft_of(body, tmp_path))
    with pytest.raises(InputError, match=r"sound runs along it at .* check shaft.body_units"):
        solved(shaft_of(body, tmp_path), body_units="mm-kg-ms")


def test_a_body_with_its_gyroscopic_matrix_is_written_and_read(whole, tmp_path):
    for ending in ("npz", "op4"):
        again = read_body(write_body(whole, tmp_path / f"b.{ending}"))
        np.testing.assert_allclose(again.gyroscopic, whole.gyroscopic, rtol=1e-14)


def held(body):
    stiffness = body.stiffness.copy()
    stiffness[1, 1] += 1e9
    return dataclasses.replace(body, stiffness=stiffness)


def bent(body):
    """With springs between the ends' turn about x and y."""
    stiffness, last = body.stiffness.copy(), body.size - 6
    spring = np.zeros(body.size)
    spring[[3, last + 3, 1, last + 1]] = 0.1, -0.1, 1.0, -1.0
    spring[5] += LENGTH * 1e-3
    return dataclasses.replace(body, stiffness=stiffness + 1e8 * np.outer(spring, spring))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (held, "the body resists being moved along y as a whole"),
        (lambda b: dataclasses.replace(b, mass=None), "has no mass matrix, which motion needs"),
        (lambda b: dataclasses.replace(b, gyroscopic=-b.gyroscopic), "that of a spin about -x"),
        (lambda b: dataclasses.replace(b, gyroscopic=b.mass), "is not skew-symmetric"),
        (bent, "the shaft is not round"),
        (
            lambda b: reduced(b, 4, (0.0, 70.0, 150.0, 260.0)),
            r"a bearing stands at 210 mm, but no node on the axis does \(the nearest is at 260 mm",
        ),
        (
            lambda b: reduced(b, 4, (70.0, 150.0, 210.0, 260.0)),
            r"shaft.discs.0 stands at 0 mm, but no node",
        ),
        (
            lambda b: dataclasses.replace(b, nodes=b.nodes + [0.0, 0.01, 0.0]),
            "0 of its .* nodes with coordinates of their own stand on the axis",
        ),
        (
            lambda b: dataclasses.replace(b, nodes=b.nodes + [0.2, 0.0, 0.0]),
            "write it in the machine's axes",
        ),
    ],
)
def test_what_is_no_shaft_is_said_in_a_sentence(whole, tmp_path, make, said):
    with pytest.raises(InputError, match=said):
        solved(shaft_of(make(whole), tmp_path))


def test_an_oval_shaft_is_refused(tmp_path):
    with pytest.raises(InputError, match="its inertia across y and z differs by"):
        solved(shaft_of(beam_body(ELEMENTS, gyroscopic=False, oval=0.5), tmp_path))


def test_polar_inertia_that_nothing_tells_is_asked_for(tmp_path):
    body = beam_body(ELEMENTS, spin=False, gyroscopic=False)
    with pytest.raises(InputError, match="do not tell its polar inertia.*keep their turns about x"):
        solved(shaft_of(body, tmp_path))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"sections": [{"length": "1 mm", "diameter": "9 mm"}]}, "both describe the shaft"),
        ({"length": None}, "needs its length as well"),
        ({"body": "nothing.npz"}, "There is no file"),
    ],
)
def test_a_body_s_keys_are_checked(whole, tmp_path, change, said):
    shaft = {**shaft_of(whole, tmp_path), **change}
    shaft = {key: value for key, value in shaft.items() if value is not None}
    with pytest.raises(InputError, match=said):
        solved(shaft)


def test_a_body_tells_of_its_stations_alone(beam, whole, tmp_path):
    found = solved(shaft_of(reduced(whole, 10), tmp_path))
    with pytest.raises(InputError, match="no node on the axis at 100 mm; the nearest is at 70 mm"):
        found.deflection(0.1)
    assert "elastic shaft in 2 bearings" in found.table()
    again = load_machine(load_machine(rotor(shaft_of(whole, tmp_path))).to_toml())
    assert again.shaft.body == str(tmp_path / "shaft.npz")


def test_a_body_may_reach_a_little_beyond_the_shaft_s_length(whole, tmp_path):
    machine = load_machine(rotor({**shaft_of(whole, tmp_path), "length": "259 mm"}))
    found = solve_machine(machine)
    assert "shaft, right end" in found.table()
    assert turning_of(TurningShaft(machine, found)).places["right end"] == pytest.approx(0.26)
    whole_length = solved(shaft_of(whole, tmp_path))
    np.testing.assert_allclose(found.compliance_at(0.26), whole_length.compliance_at(0.26))
