"""The paper on deformed cage pockets: its plans, what its claims make of known numbers, its figures
of known signals."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from flexcage.study import load_map, load_study
from flexcage.study.plan import make_plan
from flexcage.study.verdicts import UNDECIDED

PAPERS = Path(__file__).parents[2] / "examples" / "papers"
FOLDER = PAPERS / "pocket_deformation"
CAGES = ("sound", "dq 0.1", "dq 0.2", "dp +0.3", "dp -0.3")
#: Numbers that the paper's words ask for, of every cage. A longer pocket cannot both leave the
#: radial displacement as it was and make the orbit larger and chaotic, if these are one motion:
#: here its amplitude stays and its orbit grows.
GOOD = {
    "corner": (20e6, 25e6, 40e6, 20e6, 320e6),
    "reach": (5e-6, 9e-6, 6e-6, 5e-6, 5e-6),
    "whirl": (20e-6, 25e-6, 30e-6, 22e-6, 15e-6),
    "scatter": (5e-6, 6e-6, 7e-6, 6e-6, 3e-6),
    "line": (0.3, 0.3, 0.3, 0.2, 0.9),
    "spikes": (3.0, 5.0, 9.0, 4.0, 9.0),
    "ripple": (0.002, 0.002, 0.005, 0.0015, 0.006),
    "pitch": (200.0, 200.0, 400.0, 200.0, 400.0),
    "speed_before": (2890.0, 2892.0, 2000.0, 2890.0, 2880.0),
    "speed_at": (2890.0, 2890.0, 2890.0, 2890.0, 2000.0),
    "speed_after": (2890.0, 2890.0, 2890.0, 2890.0, 2880.0),
    "swing_before": (0.005, 0.005, 0.05, 0.005, 0.005),
    "slip_before": (0.012, 0.011, 0.3, 0.012, 0.016),
    "slip_after": (0.012, 0.012, 0.012, 0.012, 0.016),
}


@pytest.fixture(scope="module")
def paper():
    """The paper, whose modules import each other as scripts do."""
    sys.path.insert(0, str(PAPERS))
    import repeat

    yield repeat.load(FOLDER)
    sys.path.remove(str(PAPERS))


def at(numbers):
    """Means by output and condition."""
    return lambda output, condition: numbers[output][CAGES.index(condition)]


def starts_of(numbers, scatter=0.01):
    """Eight starts about the same numbers."""
    rng = np.random.default_rng(4)
    drawn = {
        (o, c): v * (1.0 + scatter * rng.standard_normal(8))
        for o, values in numbers.items() for c, v in zip(CAGES, values)
    }  # fmt: skip
    return lambda output, condition: drawn[output, condition]


def test_readings_and_map_are_plans(paper):
    for file in (paper.readings, *(file for file, _ in paper.alone.values())):
        study = load_study(FOLDER / file)
        starts = study.repeat.count
        assert starts >= 8 and len(make_plan(study).cases) == 5 * starts
        case = make_plan(study).case(make_plan(study).cases[-1])
        assert case.defects[0].displacement == pytest.approx(-0.3e-3) and case.land is not None
    spec = load_map(FOLDER / "map.toml")
    plan = make_plan(spec.study((0,)))
    assert {p.point.labels["condition"] for p in plan.cases} == set(CAGES)
    assert all(len(unknown.reason) > 8 for unknown in spec.unknowns)
    assert {c.key for c in paper.claims} == set(paper.decided_by)
    keys = [f"000-{k}" for k in (1, 2, 3, "3b", 4, 5, 6, 7, 8, "8b", 9, 10, 11, 12, 13)]
    assert [c.key for c in paper.claims] == keys


def test_the_printed_reading_is_that_of_the_papers_program(paper):
    study = load_study(FOLDER / "readings_printed.toml")
    plan = make_plan(study)
    case = plan.case(plan.cases[0])
    race = case.contacts.race
    assert (race.normal.law, race.normal.damping) == ("impact_step", pytest.approx(1e4))
    assert race.normal.full_damping_depth == pytest.approx(1e-4)
    assert (race.friction.static, race.friction.dynamic) == (0.3, 0.1)
    assert case.mount.kind == "contact" and case.lubricant.oil_fraction == 0.0
    lost = make_plan(load_study(FOLDER / "lost.toml"))
    assert all(lost.case(p).land.kind == "none" for p in (lost.cases[0], lost.cases[-1]))


def test_claims_judge_numbers_of_known_order(paper):
    """What the paper says holds its claims but for one of the two readings of the whirl; a cage
    that never changes holds none."""
    claims = {c.key: c for c in paper.claims}
    assert [key for key, c in claims.items() if not c.holds(at(GOOD))] == ["000-3b"]
    evidence = {key: c.evidence(starts_of(GOOD, 0.002)) for key, c in claims.items()}
    assert {key for key, e in evidence.items() if e.p < 1e-3} == set(claims) - {"000-3b"}
    free = {o: (v[0],) * 5 for o, v in GOOD.items()}
    held = [key for key, c in claims.items() if c.holds(at(free))]
    assert held == []
    against = {key: c.evidence(starts_of(free, 0.002)).against for key, c in claims.items()}
    sharp = ("000-1", "000-5", "000-6", "000-7", "000-8", "000-8b", "000-9", "000-12", "000-13")
    assert all(against[key] < 1e-3 for key in sharp)


def test_a_change_has_a_sign_and_a_size(paper):
    claims = sys.modules["claims"]
    numbers = {"x": (1.0, 1.2, 1.3, 0.9, 0.7)}
    for conditions, by, rising, expected in (
        (("sound", "dq 0.1"), 0.25, True, False),
        (("sound", "dq 0.2"), 0.25, True, True),
        (("sound", "dp +0.3"), 0.25, False, False),
        (("sound", "dp -0.3"), 0.25, False, True),
    ):
        part = claims.Up("x", conditions, by=by, rising=rising)
        assert part.holds(at(numbers)) is expected
        evidence = part.evidence(starts_of(numbers))
        assert (evidence.p < 1e-3, evidence.against < 1e-3) == (expected, not expected)
    for conditions, expected in ((("sound", "dq 0.2"), True), (("sound", "sound"), False)):
        part = claims.Differs("x", conditions, 0.1)
        evidence = part.evidence(starts_of(numbers))
        assert part.holds(at(numbers)) is expected
        assert (evidence.p < 1e-3, evidence.against < 1e-3) == (expected, not expected)


@pytest.mark.slow
def test_the_paper_from_end_to_end(tmp_path, capsys):
    """Short runs of one start: the shorter pocket holds its roller, and nothing is decided."""
    sys.path.insert(0, str(PAPERS))
    import pocket_deformation

    found = pocket_deformation.main(["--quick", "-o", str(tmp_path / "quick")])
    sys.path.remove(str(PAPERS))
    assert all(line.verdict.outcome == UNDECIDED for line in found.lines)
    reading = next(iter(found.readings.values()))
    assert reading.starts == 1 and reading.look == 0
    rolls, held = (reading.values("speed_at", c)[0] for c in ("sound", "dp -0.3"))
    assert rolls == pytest.approx(2900.0, rel=0.02)  # rad/s
    assert held == pytest.approx(-reading.values("cage_speed_mean", "dp -0.3")[0], rel=0.01)
    assert 100e6 < reading.values("corner", "dp -0.3")[0] < 1e9
    assert "000-8b" in capsys.readouterr().out
