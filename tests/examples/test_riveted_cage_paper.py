"""The riveted cage: its plans, what its claims and predictions make of known numbers, its fits."""

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import flexcage
from flexcage.case import load_extension
from flexcage.stress.riveted_joint import Peak
from flexcage.study import load_study
from flexcage.study.own import OWN
from flexcage.study.plan import make_plan

PAPERS = Path(__file__).parents[2] / "examples" / "papers"
FOLDER = PAPERS / "riveted_cage"


@pytest.fixture(scope="module")
def paper():
    """The paper, whose modules import each other as scripts do."""
    sys.path.insert(0, str(PAPERS))
    import repeat

    yield repeat.load(FOLDER)
    sys.path.remove(str(PAPERS))


@pytest.fixture(scope="module")
def scripts(paper):
    """Scripts of the folder; another paper's have the same names."""
    sys.path.insert(0, str(FOLDER))
    import blows
    import predict
    import rivet

    yield SimpleNamespace(
        predict=predict, rivet=rivet, blows=blows, printed=sys.modules["figures"].PRINTED
    )
    sys.path.remove(str(FOLDER))
    sys.modules.pop("predict", None)


def test_the_design_is_that_of_table_3(paper):
    assert "design.toml" in paper.studies
    assert len(make_plan(load_study(FOLDER / "design.toml")).cases) == 49 * 4


def test_findings_judge_numbers_of_known_order(paper):
    """Numbers as the paper has them hold its findings; others do not."""
    force = {"base": 25.12, "Rp 3.43": 29.66, "Rp 3.49": 28.73, "Rp 3.60": 30.0, "w 8.0": 31.2,
             "w 4.4": 30.8, "t 0.7": 26.0, "t 1.0": 25.9, "f_i 0.505": 27.0, "f_i 0.525": 24.0,
             "f_e 0.515": 27.0, "f_e 0.530": 24.0, "Pd 5": 24.0, "Pd 20": 27.0}  # fmt: skip
    slip = {"base": 0.0100, "Rp 3.43": 0.0095, "Rp 3.49": 0.0105, "w 8.0": 0.0102, "w 4.4": 0.0101,
            "t 0.7": 0.0100, "t 1.0": 0.0101, "modified 9000": 0.0113,
            "original 9000": 0.0184}  # fmt: skip
    tilt = {"Rp 3.43": 3.0, "base": 2.0, "Rp 3.49": 1.0, "w 8.0": 1.0, "w 4.4": 3.0}
    ends = {"root_tight": 300.0, "eave_tight": 400.0, "root_loose": 270.0, "eave_loose": 50.0}
    good = {"pocket_turn_largest": force, "slip_size": slip, "psi": tilt, "rivet": slip | force}
    good |= {name: {"base": value} for name, value in ends.items()}

    def holds(found):
        def at(output, condition):
            return found[output].get(condition, force.get(condition, 0.0))

        return {f"{c.key} {part}" for c in paper.claims for part, f in c.parts.items()
                if f.holds(at)}  # fmt: skip

    every = {f"{c.key} {part}" for c in paper.claims for part in c.parts}
    # rivets' stress is least at 0.8 mm here, though lower at 1.0 than at 0.7 mm
    assert every - holds(good) == set()
    same = good | {"slip_size": dict.fromkeys(slip, 0.03), "root_loose": {"base": 40.0}}
    assert every - holds(same) == {
        "001-2 slip rises", "001-3b slip over width", "001-8 original slips more",
        "001-9 modified, 1.13 %", "001-9 original, 1.84 %", "001-7 root with play",
    }  # fmt: skip


def test_predictions_are_the_rows_that_are_asked_for(scripts):
    """Every cell of Table 3 off the cross, and Table 4 at 8000 and 7000 rpm."""
    rows = json.loads((FOLDER / "predictions.json").read_text("utf-8"))
    cells = {f"{r} x {w}" for r in scripts.predict.RADII for w in scripts.predict.WIDTHS
             if r != "3.46" and w != "6.2"}  # fmt: skip
    slips = {f"{cage} {n} {s}" for cage in ("modified", "original") for n in (8000, 7000)
             for s in ("experimental", "artificial")}  # fmt: skip
    assert {r["row"] for r in rows if r["table"] == "3"} == cells
    assert {r["row"] for r in rows if r["table"] == "4"} == slips and len(rows) == 44
    for r in rows:
        assert r["paper"] == "001" and r["low"] < r["value"] < r["high"]


def test_what_adds_to_a_force(scripts):
    """q = 1 is the sum of the cross, q near 0 the larger of both; mirror pairs that agree leave
    cells between them."""
    predict, rng = scripts.predict, np.random.default_rng(3)
    assert predict.joined(4.0, 3.0, 1.0) == pytest.approx(7.0)
    assert predict.joined(4.0, 3.0, 0.02) == pytest.approx(4.0, abs=1e-3)
    assert predict.additive(scripts.printed)["3.43 x 8"] == pytest.approx(29.657 + 31.162 - 25.12)
    assert np.median(predict.sigmas(np.full(6, 0.1), rng)) == pytest.approx(0.075, abs=0.01)
    found = predict.forces(scripts.printed, rng)
    low, high = np.percentile(found["3.43 x 8"], (5, 95))
    assert 31.162 - 1.0 < low < 35.699 < high


def test_powers_of_a_slip_over_speed(scripts):
    speeds = np.array([9000.0, 8000.0, 7000.0])
    slips = np.vstack([0.01 * (speeds / 9000.0) ** 1.5, [0.01, -0.01, 0.01]])
    np.testing.assert_allclose(scripts.predict.powers(slips), [[1.5, 1.5]])


@pytest.mark.parametrize(
    "eave, root, small, outcomes",
    [
        (300e6, 200e6, 100e6, ("holds", "holds", "holds")),
        (200e6, 300e6, 100e6, ("fails", "holds", "holds")),
        (201e6, 200e6, 198e6, ("undecided", "holds", "undecided")),
    ],
)
def test_what_becomes_of_the_fits(scripts, eave, root, small, outcomes):
    def result(play, **peaks):
        found = [Peak(place, stress, None) for place, stress in peaks.items()]
        return SimpleNamespace(fit=SimpleNamespace(play=play), peaks=lambda: found)

    results = [result(-3e-6, eave=eave, root=root), result(5e-6, eave=small, root=250e6)]
    assert tuple(scripts.rivet.judged(results).values()) == outcomes


def test_what_is_assumed_of_the_joint_is_varied_alone(scripts, monkeypatch):
    state = SimpleNamespace(equivalent=np.array([1.0, 3.0]) * 1e6)
    result = SimpleNamespace(
        places={"root": [0, 1]}, instants={"clamped": state, "again": state},
        range_at=lambda place: (2e6, 3e6, 1), nominal_range=4e6, K_t=0.5,
        lives=lambda: [SimpleNamespace(swt=s, morrow=m) for s, m in ((8e9, np.inf), (np.inf, 6e9))],
    )  # fmt: skip
    seen = []

    def one(run, factor, plays, mesh, **changed):
        seen.append(changed)
        return (result,)

    monkeypatch.setattr(scripts.rivet, "computed", one)
    table = scripts.rivet.assumed(None, 1.0)
    ends = {name: (low, high) for name, (low, _, high) in scripts.rivet.ASSUMED.items()}
    assert seen == [{}, *({name: v} for name, both in ends.items() for v in both)]
    assert list(table["range at the root [MPa]"]) == [2.0] * 7
    assert list(table["root, again [MPa]"]) == [3.0] * 7
    assert list(table["cycles, least"]) == [3e9] * 7  # two reversals are a cycle


@pytest.mark.slow
def test_a_load_stresses_the_heads_roots(paper):
    """The range at the roots is that of the joint's own cycle; a rigid cage has none."""
    changes = {"solver.duration": "5 ms", "cage.model": "flexible"}
    run = flexcage.simulate(flexcage.load_case(FOLDER / "case.toml", overrides=changes))
    load_extension(FOLDER / "outputs.py")
    outputs = sys.modules[OWN["fillet"].compute.__module__]
    found = OWN["fillet"].compute(run)
    tight, result = run.rivet_joint("-3 um", "3 um", mesh=outputs.MESH)
    assert found["fillet"] == pytest.approx(result.range_at("root")[0], rel=1e-9)
    for name, joint in (("tight", tight), ("loose", result)):
        peaks = {p.place: p.stress for p in joint.peaks()}
        for place in ("root", "eave"):
            assert found[f"{place}_{name}"] == pytest.approx(peaks[place], rel=1e-9)
    rigid = SimpleNamespace(case=SimpleNamespace(riveted=False))
    assert all(np.isnan(v) for v in OWN["fillet"].compute(rigid).values())


@pytest.mark.slow
def test_the_parts_of_the_slip_are_the_whole(paper):
    """They sum to equation 10's slip; balls of 6.747 mm by the printed 6.47 mm make 1.4 %. The cage
    turns about its own axis, so that the paper's inclination is about its tilt in that plane."""
    case = flexcage.load_case(FOLDER / "case.toml", overrides={"solver.duration": "25 ms"})
    load_extension(FOLDER / "outputs.py")
    found = OWN["slip"].compute(flexcage.simulate(case))
    parts = [found[name] for name in ("reference", "angle", "curvature", "traction")]
    assert sum(parts) == pytest.approx(found["slip"], abs=1e-12)
    assert parts[0] == pytest.approx(0.0142, abs=2e-4) and parts[1] < 0.0
    assert found["psi"] == pytest.approx(found["cage_tilt"], rel=0.3)


def test_blows_are_found_and_said_by_turn(scripts):
    """Known forces: two turns of ten samples, three blows above 5 N, one of them at the edge."""
    force = np.zeros((20, 2))
    force[4, 1], force[5, 1], force[12, 0], force[15, 0], force[19, 1] = 9.0, 30.0, 4.0, 7.0, 50.0
    assert scripts.blows.peaks_of(force) == [(5, 1), (15, 0)]
    assert scripts.blows.largest_of(force, 10) == [(5, 1), (19, 1)]
    one = {"largest": [1.0, 3.0], "near": [1.0, 0.0], "load": [2.0, 4.0], "speed": [0.1] * 20,
           "count": 5.0, "held": 0.2, "relative": 0.05, "all_load": 9.0}  # fmt: skip
    row = scripts.blows.row(3.46, [one, one | {"largest": [2.0, 2.0], "count": 7.0}])
    assert row["turns"] == 4 and row["largest of a turn [N]"] == 2.0
    assert row["blows above 5 N in a turn"] == 6.0 and row["largest near the moment's axis"] == 0.5


def test_balls_approach_a_cage_that_moves_and_turns(scripts):
    """A cage that turns with the balls and moves along y: the ball at psi = 90 degrees sees all of
    it, the one at 0 nothing."""
    import xarray as xr

    psi = np.array([[0.0, np.pi / 2]])
    place = np.stack([np.zeros((1, 2)), np.full((1, 2), 0.013), psi], axis=-1)
    speed = np.stack([np.zeros((1, 2)), np.zeros((1, 2)), np.full((1, 2), 1.3)], axis=-1)
    where = ("time", "element", "cyl")
    ds = xr.Dataset(
        {"element_position": (where, place), "element_velocity": (where, speed),
         "cage_omega": (("time", "axis"), [[100.0, 0.0, 0.0]]),
         "cage_velocity": (("time", "axis"), [[0.0, 0.02, 0.0]])},
        {"cyl": ["x", "r", "psi"]},
    )  # fmt: skip
    np.testing.assert_allclose(scripts.blows.approach(ds), [[0.0, 0.02]], atol=1e-12)
