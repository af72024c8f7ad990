"""An elastic shaft in its bearings: balances, slopes, mirror images, springs, seats, files."""

from __future__ import annotations

import json

import numpy as np
import pytest
from machines import load, pair

from flexcage import Machine, load_machine, load_static, solve_machine, solve_static
from flexcage.core.errors import InputError
from flexcage.machine.beams import Beam
from flexcage.machine.writing import as_loaded

MOTOR = {
    "drive": {"speed": "1500 rpm"},
    "gravity": {"direction": "180 deg"},
    "shaft": {
        "sections": [
            {"length": "60 mm", "diameter": "30 mm"},
            {"length": "240 mm", "diameter": "45 mm"},
            {"length": "80 mm", "diameter": "30 mm"},
        ],
        "discs": [{"position": "180 mm", "mass": "12 kg"}],
        "loads": [load(370, 100, -800, 300)],
    },
    "bearings": [
        {"name": "fixed", "preset": "7010C-PI", "position": "45 mm", "facing": "-x",
         "axial_seat": "floating", "spring_force": "300 N"},
        {"name": "other", "preset": "7010C-PI", "position": "315 mm", "facing": "+x"},
    ],
}  # fmt: skip


def motor(**changes):
    return load_machine(MOTOR, overrides={k.replace("__", "."): v for k, v in changes.items()})


@pytest.fixture(scope="module")
def solved():
    return solve_machine(motor())


def test_forces_balance_and_the_spring_bears_what_it_should(solved):
    weight = 9.80665 * (12.0 + sum(b.mass_per_length * b.length for b in solved.shaft.beams))
    total = sum(b.force for b in solved.bearings)
    assert total[:3] == pytest.approx([-100.0, 800.0 + weight, -300.0], rel=1e-9)
    assert solved["fixed"].force[0] == pytest.approx(300.0, rel=1e-9)  # pushed towards -x
    assert solved["other"].force[0] == pytest.approx(-400.0, rel=1e-9)
    assert solved.unbalanced < 1e-8


def test_the_shaft_bends_as_a_beam_between_what_its_bearings_do():
    """Simply supported with end moments and a load in the middle, all by closed forms."""
    m = load_machine({
        "gravity": {"acceleration": "0 m/s^2"},
        "shaft": {"sections": [{"length": "400 mm", "diameter": "30 mm"}],
                  "loads": [load(200, 0, 2000, 0)]},
        "bearings": [
            {"preset": "15x37x10", "position": "0 mm"},
            {"preset": "15x37x10", "position": "400 mm", "axial_seat": "floating"},
        ],
    })  # fmt: skip
    found = solve_machine(m)
    one, L = Beam(0.4, m.shaft.sections[0], m.shaft.material), 0.4
    EI, GA = one.bending_stiffness, one.shear_stiffness
    chord = 0.5 * (found["A"].displacement[1] + found["B"].displacement[1])
    moment = 0.5 * (found["A"].force[4] - found["B"].force[4])  # that resists the sag
    assert abs(moment) > 0.05
    wanted = 2000.0 * L**3 / 48 / EI + 2000.0 * L / 4 / GA + moment * L**2 / 8 / EI
    assert found.deflection(0.2)[1] - chord == pytest.approx(wanted, rel=1e-6)
    middle = np.abs(found.sections.position - 0.2) < 1e-9
    assert found.sections.bending[middle].max() == pytest.approx(2000 * L / 4 + moment, rel=1e-6)


def test_an_elastic_shaft_that_is_stiff_is_the_rigid_one():
    stiff = {"name": "stiff", "youngs_modulus": "2e6 GPa", "poisson_ratio": 0.3,
             "density": "7850 kg/m^3"}  # fmt: skip
    rigid, elastic = (
        solve_machine(motor(shaft__kind=kind, shaft__material=stiff))
        for kind in ("rigid", "elastic")
    )
    for name in ("fixed", "other"):
        assert elastic[name].force == pytest.approx(rigid[name].force, rel=1e-3, abs=0.1)


def test_stiffness_at_a_place_is_the_slope_of_loads_there(solved):
    """More load there, in every direction, moves the shaft there by its inverse."""
    place = 0.123
    compliance = solved.compliance_at(place)
    for k in range(5):
        step = 0.5 if k < 3 else 0.02
        moved = []
        for sign in (step, -step):
            more = load(1e3 * place, *(sign if j == k else 0.0 for j in range(3)))
            more["moment"] = [f"{sign if j == k else 0.0} N*m" for j in (3, 4)]
            table = {**MOTOR, "shaft": {**MOTOR["shaft"]}}
            table["shaft"]["loads"] = [*MOTOR["shaft"]["loads"], more]
            moved.append(solve_machine(load_machine(table)).deflection(place))
        slope = (moved[0] - moved[1]) / (2.0 * step)
        size = np.sqrt(np.diag(compliance) * compliance[k, k])
        assert np.abs(slope - compliance[:, k]).max() <= 2e-3 * size.max(), k


def test_a_mirrored_machine_is_the_mirror_image(solved):
    shaft, length = MOTOR["shaft"], 380
    mirrored = {
        **MOTOR,
        "shaft": {
            "sections": shaft["sections"][::-1],
            "discs": [{"position": "200 mm", "mass": "12 kg"}],
            "loads": [load(length - 370, -100, -800, 300)],
        },
        "bearings": [
            {**row, "facing": "+x" if row["facing"] == "-x" else "-x",
             "position": f"{length - int(row['position'].split()[0])} mm"}
            for row in MOTOR["bearings"]
        ],
    }  # fmt: skip
    other = solve_machine(load_machine(mirrored))
    signs = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])
    for name in ("fixed", "other"):
        assert other[name].force == pytest.approx(signs * solved[name].force, rel=1e-6, abs=1e-6)
        assert other[name].solution.elements.force == pytest.approx(
            solved[name].solution.elements.force, rel=1e-6, abs=1e-6
        )
    assert other.displacement[::-1] == pytest.approx(signs * solved.displacement, abs=1e-11)


def test_each_bearing_is_at_the_force_where_its_own_static_solution_has_it(solved):
    """Pressed as the machine presses it, a case alone is displaced as much."""
    own, case = solved["fixed"], motor().bearings[0].case
    alone = solve_static(as_loaded(case, own.solution.load))
    pressed = own.solution.displacement - own.solution.outer  # the outer ring slides
    assert pressed == pytest.approx(alone.displacement, rel=1e-6, abs=1e-10)
    assert own.solution.ratings.reference_life == pytest.approx(alone.ratings.reference_life)


def test_a_seat_that_yields_moves_by_its_force():
    bushing = {"kind": "bushing", "stiffness": "50 N/um", "axial_stiffness": "30 N/um"}
    m = pair(preload_force="250 N", mount=bushing, loads=[load(108, 0, 400, 0)])
    found = solve_machine(m)
    for b in found.bearings:
        outer = b.solution.outer
        assert outer[:2] == pytest.approx([b.solution.load[0] / 30e6, 200.0 / 50e6], rel=1e-6)
    hard = solve_machine(pair(preload_force="250 N", loads=[load(108, 0, 400, 0)]))
    assert found["A"].solution.load[0] < hard["A"].solution.load[0]  # the seats give way
    assert found.deflection(0.108)[1] > hard.deflection(0.108)[1] + 3.9e-6


def test_fits_change_the_preload():
    """An inner ring pressed on its shaft meets the balls earlier: more preload."""
    loose = solve_machine(pair(preload_force="250 N"))
    tight = solve_machine(pair(preload_force="250 N", fit={"shaft": "k5"}))
    assert tight["A"].offset > loose["A"].offset + 1e-6
    assert tight["A"].solution.load[0] > 1.3 * loose["A"].solution.load[0]
    assert tight["A"].solution.mounting is not None


def test_a_machine_reads_back_from_its_own_text():
    m = motor()
    again = load_machine(m.to_toml())
    assert again == m and again.bearings[0].case == m.bearings[0].case
    named = m.replace({"bearings.other.axial_offset": "3 um", "drive.speed": "900 rpm"})
    assert named.bearings[1].place.axial_offset == 3e-6 and named.speed == pytest.approx(30 * np.pi)


def test_a_bearing_is_a_case_from_a_file(tmp_path):
    (tmp_path / "own.toml").write_text(
        'name = "x"\n[bearing]\npreset = "7010C-PI"\n[load]\naxial = "9 N"\n[lubricant]\n'
        'viscosity = "50 mPa*s"\n'
    )
    rows = [{k: v for k, v in row.items() if k != "preset"} | {"case": "own.toml"}
            for row in MOTOR["bearings"]]  # fmt: skip
    rows[1]["lubricant"] = {"viscosity": "20 mPa*s"}
    m = Machine.from_table({**MOTOR, "bearings": rows}, folder=tmp_path)
    assert [b.case.lubricant.viscosity for b in m.bearings] == [0.05, 0.02]
    assert m.bearings[0].case.bearing == load_static(tmp_path / "own.toml").bearing
    assert m.bearings[0].case.speed == m.speed


def test_solution_as_json(solved, tmp_path):
    solved.to_json(tmp_path / "machine.json")
    found = json.loads((tmp_path / "machine.json").read_text("utf-8"))
    assert found["bearings"]["fixed"]["force"][0] == pytest.approx(300.0)
    assert found["bearings"]["other"]["solution"]["elements"]["force"][0][0] > 0.0
    page = solved._repr_html_()
    assert "elastic shaft in 2 bearings at 1500 rpm" in page and "<td" in page
    assert "gravity at 180 deg from y towards z" in solved.table(100).replace("\n", " ")
    with pytest.raises(InputError, match="no bearing 'C'; they are fixed, other"):
        _ = solved["C"]
    with pytest.raises(InputError, match="off the shaft, which is 380 mm"):
        solved.stiffness_at(0.5)


def test_a_life_is_quoted_at_the_speed_of_the_machine():
    m = motor(bearings__other__life={"contamination": 0.5, "reliability": 95.0})
    lives = solve_machine(m)["other"].solution.lives
    assert lives.here.speed == m.speed and 0.0 < lives.here.modification < 50.0


def test_a_designation_brings_no_values_that_were_given():
    """So that no warning names what the catalogue's case says beside a fit."""
    rows = [{"name": n, "designation": "6210", "position": x, "fit": {"clearance": "CN"}}
            for n, x in (("A", "50 mm"), ("B", "300 mm"))]  # fmt: skip
    rows[1]["axial_seat"] = "floating"
    found = solve_machine(load_machine({**MOTOR, "bearings": rows}))
    assert not [text for text in found.warnings if "not used" in text]
    rows[0]["fit"]["shaft_roughness"] = "5 um"  # with smoothing = "roughness" alone
    found = solve_machine(load_machine({**MOTOR, "bearings": rows}))
    assert [text for text in found.warnings if "bearing A: Given, but not used: fit.shaft" in text]


def test_unloaded_balls_at_speed_and_stress_are_told():
    soft = {"name": "steel", "proof_stress": "5 MPa"}
    m = motor(shaft__material=soft)
    said = " ".join(solve_machine(m).warnings)
    assert "would yield" in said and "nominal stress at" in said
    idle = {**MOTOR["bearings"][0], "name": "idle", "position": "100 mm", "axial_seat": "fixed",
            "axial_offset": "-90 um", "spring_force": "0 N"}  # fmt: skip
    more = load_machine({**MOTOR, "bearings": [*MOTOR["bearings"], idle]})
    assert "bearing idle: none of its elements bears load" in " ".join(solve_machine(more).warnings)
