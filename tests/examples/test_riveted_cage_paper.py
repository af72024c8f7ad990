"""The riveted cage: its design, its fits and its slip; what is planned, and rules."""

import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import flexcage
from flexcage.core.errors import InputError
from flexcage.stress.riveted_joint import Peak
from flexcage.study.plan import make_plan
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED

PAPERS = Path(__file__).parents[2] / "examples" / "papers"


@pytest.fixture(scope="module")
def papers():
    sys.path.insert(0, str(PAPERS))
    import riveted_cage_design
    import riveted_cage_rivet
    import riveted_cage_slip

    yield SimpleNamespace(
        design=riveted_cage_design, rivet=riveted_cage_rivet, slip=riveted_cage_slip
    )
    sys.path.remove(str(PAPERS))


def test_the_design_has_the_points_that_can_be_made(papers):
    """35 of 49; the others are refused by the cage itself, and not by the script's rule alone."""
    planned = make_plan(papers.design.study(starts=1))
    made = [(r, w) for r in papers.design.RADII for w in papers.design.WIDTHS
            if papers.design.whole(r, w)]  # fmt: skip
    assert len(planned.cases) == len(made) == 35
    base = papers.design.study(starts=1).case
    for radius, width in ((3.43, 5.0), (3.49, 4.4)):
        assert not papers.design.whole(radius, width)
        with pytest.raises(InputError, match="cut the sheet through"):
            base.replace(**{"cage.pocket_diameter": 2e-3 * radius, "cage.width": 1e-3 * width})


@pytest.mark.parametrize(
    "eave, root, small, outcomes",
    [
        (300e6, 200e6, 100e6, (HOLDS, HOLDS, HOLDS)),
        (200e6, 300e6, 100e6, (FAILS, HOLDS, HOLDS)),
        (201e6, 200e6, 198e6, (UNDECIDED, HOLDS, UNDECIDED)),
    ],
)
def test_what_becomes_of_the_fits(papers, eave, root, small, outcomes):
    def result(play, **peaks):
        found = [Peak(place, stress, None) for place, stress in peaks.items()]
        return SimpleNamespace(fit=SimpleNamespace(play=play), peaks=lambda: found)

    results = [result(-3e-6, eave=eave, root=root), result(5e-6, eave=small, root=250e6)]
    assert tuple(papers.rivet.judged(results).values()) == outcomes


@pytest.mark.slow
def test_the_parts_of_the_slip_are_the_whole(papers):
    """A run with balls of 6.747 mm: the parts sum to equation 10's slip, and the printed ball's
    diameter alone makes 1.4 %."""
    case = flexcage.load_case(
        PAPERS / "riveted_cage" / "case.toml",
        overrides={"cage.model": "rigid", "solver.duration": "25 ms",
                   "bearing.ball_diameter": "6.747 mm", "bearing.inner_groove_radius": "3.475 mm",
                   "bearing.outer_groove_radius": "3.542 mm"},
    )  # fmt: skip
    whole, *rest = papers.slip.parts(flexcage.simulate(case)).values()
    assert sum(rest) == pytest.approx(whole, abs=1e-12)
    assert rest[0] == pytest.approx(0.0142, abs=2e-4) and rest[1] < 0.0
