"""The riveted cage's paper as a study: it plans, and its claims judge figures of known order."""

import sys
from dataclasses import fields
from pathlib import Path

import pytest

from flexcage.study.plan import make_plan
from flexcage.study.verdicts import FAILS, HOLDS, Estimate

PAPERS = Path(__file__).parents[2] / "examples" / "papers"


@pytest.fixture(scope="module")
def papers():
    sys.path.insert(0, str(PAPERS))
    yield
    sys.path.remove(str(PAPERS))


def test_the_riveted_cage_is_a_plan_and_its_claims_judge(papers):
    """A force and a stress that have their least at 3.46 mm hold, those that fall fail."""
    import riveted_cage
    import riveted_cage_claims as riveted

    for reading in riveted_cage.READINGS:
        asked = riveted_cage.points(reading)
        labels = [p["label"] for p in asked]
        assert len(set(labels)) == len(labels) == 26
        plan = make_plan(riveted_cage.study(reading))
        assert len(plan.cases) == 26 * riveted_cage.STARTS[reading]
    ball = 6.747e-3
    case = plan.case(next(p for p in plan.cases if p.point.labels["case"] == "Pd 20"))
    assert (
        case.bearing.inner_conformity == pytest.approx(0.515, rel=1e-5)
        and case.cage_model == "rigid"
    )
    assert case.bearing.ball_diameter == pytest.approx(ball)

    def outcome(forces):
        plain = {f.name: Estimate(1.0, 0.01) for f in fields(riveted.Figures)}
        found = {
            label: [riveted.Figures(**plain | dict.fromkeys(("force", "rivet"), of))] * 3
            for label, of in zip(riveted.RADII, (Estimate(force, 0.1) for force in forces))
        }
        (claim,) = (c for c in riveted.CLAIMS if c.key == "001-1")
        views = {"flexible": riveted.View(found)}
        return claim.verdict(views, "flexible", shown=riveted.SHOWN, source="").outcome

    assert outcome([30, 27, 26, 25, 26, 27, 29, 31]) == HOLDS
    assert outcome([30, 29, 28, 27, 26, 25, 24, 23]) == FAILS
