"""The examples run, on a coarse mesh and for a short time, and their numbers hold."""

import importlib.util
from math import pi
from pathlib import Path

import numpy as np
import pytest

from flexcage import load_case, load_static, simulate, solve_static

EXAMPLES = Path(__file__).parents[2] / "examples"
SHORT = {"solver.duration": "6 ms", "mesh.fineness": "coarse"}
TESTED = {
    "ex01_n1013",
    "ex02_rigid_against_flexible",
    "ex03_defect_sweep",
    "ex04_study",
    "ex05_static",
    "ex06_ball_bearing",
    "ex07_own_body",
    "ex08_rotor_bearing",
    "ex09_machine",
    "ex10_signals",
    "ex11_diagnosis",
    "ex12_tapered",
    "ex13_tapered_run",
    "ex15_spherical_run",
    "ex14_spherical",
}


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_example_is_tested():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == TESTED


def test_main_job_from_python(capsys):
    rpm = example("ex01_n1013").main(**SHORT)
    assert rpm == pytest.approx(6000 / 2 * (1 - 8 / 82.5), rel=0.03)
    assert "MPa at t =" in capsys.readouterr().out


def test_rigid_against_flexible():
    module = example("ex02_rigid_against_flexible")
    assert module.speed_difference(module.main(**SHORT)) < 0.01


def test_defect_sweep():
    first, _, last = example("ex03_defect_sweep").main(**{**SHORT, "solver.duration": "1 ms"})
    assert last / first == pytest.approx(0.05 / 0.01, rel=0.06)


def test_tapered_example(capsys):
    module = example("ex12_tapered")
    still, fast = module.main(0.0, 12000.0)
    assert still == pytest.approx(module.wedge()) and fast > 1.1 * still
    assert module.loaded() == 15
    assert "the rib bears" in capsys.readouterr().out


def test_spherical_example(capsys):
    module = example("ex14_spherical")
    both, few = module.main(0.0, module.limit())
    assert both == pytest.approx(0.5, abs=0.01) and few < 0.02
    assert "the row at -x bears" in capsys.readouterr().out


def test_tapered_rollers_run(capsys):
    ratio, skew = example("ex13_tapered_run").main(**{"solver.duration": "2 ms"})
    assert ratio == pytest.approx(1.0, abs=0.01) and skew > 0.0
    assert "askew" in capsys.readouterr().out


def test_barrels_run(capsys):
    ratio, skew = example("ex15_spherical_run").main(**{"solver.duration": "2 ms"})
    assert ratio == pytest.approx(1.0, abs=0.01) and skew > 0.5
    assert "askew" in capsys.readouterr().out


def test_static(capsys):
    still, fast = example("ex05_static").main(0.0, 10000.0)
    assert abs(still) < 1e-9 and fast == pytest.approx(19.8114 - 10.6191, abs=1e-3)
    assert "N/um axially" in capsys.readouterr().out


def test_machines():
    module = example("ex09_machine")
    assert module.spindle() == pytest.approx(80.7, abs=0.1)
    borne, by_hand = module.motor()  # the roller bearing's own moment lifts it by 0.1 %
    assert borne == pytest.approx(by_hand, rel=2e-3) and by_hand > 1200.0


def test_an_accelerometer_finds_the_spall(tmp_path):
    picture = tmp_path / "signals.png"
    short = {"solver.duration": "60 ms", "mesh.fineness": "coarse"}
    line, bpfo = example("ex10_signals").main(str(picture), **short)
    assert line == pytest.approx(bpfo, abs=1 / 0.048)  # a bin of 48 ms
    assert bpfo == pytest.approx(0.5 * 9 * 100 * (1 - 7.938 / 38.5), rel=0.02)
    assert picture.stat().st_size > 20_000


def test_nu210():
    """Its cage goes round at the epicyclic speed, and the outer ring's ribs guide it."""
    run = simulate(load_case(EXAMPLES / "nu210.toml").replace(SHORT))
    assert run.summary["cage_speed"] * 30 / pi == pytest.approx(3000 * (1 - 11 / 70.5), rel=0.03)
    assert run.case.land.clearance == pytest.approx(0.25e-3)


def test_qj208():
    """Balls press all four arcs as the static solution has it."""
    case = load_case(EXAMPLES / "qj208.toml").replace({**SHORT, "cage.model": "rigid"})
    run = simulate(case)
    arcs = run.dataset["arc_force"].max(["time", "element"])
    due = solve_static(load_static(EXAMPLES / "qj208.toml")).elements.arcs
    for race in ("inner", "outer"):
        for side in ("-x", "+x"):
            found = float(arcs.sel(race=race, arc=side))
            assert found == pytest.approx(due[f"{race} {side}"].max(), rel=0.04)
    assert run.summary["share_on_4_contacts"] > 0.5 and run.summary["energy_audit"] == "passed"


def test_3205():
    """The row at -x bears 4.1 times as much as the other, as the static solution has it."""
    case = load_case(EXAMPLES / "3205.toml").replace({**SHORT, "mesh.fineness": "coarse"})
    run = simulate(case)
    force = run.dataset["race_force"].sel(race="inner").mean("time").groupby("row").sum().values
    due = solve_static(load_static(EXAMPLES / "3205.toml")).elements.force[:, 0].reshape(2, -1)
    assert force[0] / force[1] == pytest.approx(due[0].sum() / due[1].sum(), rel=0.05)
    assert run.summary["energy_audit"] == "passed"


def test_hk2020():
    """Five of 21 needles bear; the most loaded one 551 N, in the static solution."""
    solution = solve_static(load_static(EXAMPLES / "HK2020.toml"))
    force = solution.elements.force[:, 0]
    assert (force > 0.0).sum() == 5
    assert solution.largest_force == pytest.approx(551.2, abs=0.1)


def test_full_complement():
    """From pure rolling, rollers outside the loaded zone begin to slow each other down."""
    run = simulate(load_case(EXAMPLES / "n1013_full.toml").replace("solver.duration", "12 ms"))
    assert 0.0 < run.summary["orbital_slip_ratio"] < 0.05
    assert run.summary["element_touches"] > 10 and run.summary["energy_audit"] == "passed"


def test_ball_bearing():
    rigid = {"mesh.fineness": "coarse", "cage.model": "rigid"}
    inner, outer = example("ex06_ball_bearing").main(duration="10 ms", **rigid)
    assert outer < 11.5 and 19.0 < inner


def test_own_body(capsys):
    ratio = example("ex07_own_body").main(**{"mesh.fineness": "coarse"})
    assert ratio == pytest.approx(1.0, abs=1e-6)
    assert "Hz from the file" in capsys.readouterr().out


def test_rotor_bearing():
    """Under an axial load alone all radial directions are alike; with ROSS, its rotor too."""
    module = example("ex08_rotor_bearing")
    k = module.coefficients(radial="0 N")
    np.testing.assert_allclose(k["kxx"], k["kyy"], rtol=1e-9)
    assert np.abs(k["kxy"]).max() < 1e-9 * k["kxx"].min() and (np.diff(k["kzz"]) < 0.0).all()
    try:
        import ross  # noqa: F401
    except Exception as exc:  # beside a plotly that it does not know it fails otherwise
        pytest.skip(f"ROSS is not here: {type(exc).__name__}")
    by_ross, by_hand = module.main()
    assert by_ross == pytest.approx(by_hand, rel=1e-3)


def test_study(tmp_path):
    module = example("ex04_study")
    short = {"solver.duration": "1 ms", "mesh.fineness": "coarse", "cage.model": "rigid"}
    assert module.largest_slip(module.main(tmp_path, **short)) < 0.03


def test_study_file_is_a_plan():
    from flexcage.study.plan import make_plan
    from flexcage.study.spec import load_study

    assert len(make_plan(load_study(EXAMPLES / "n1013_study.toml")).cases) == 3 * 2 * 3
