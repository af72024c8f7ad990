"""The 7010C's papers as studies: they plan, and their claims judge figures of known order."""

import sys
from dataclasses import fields, replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.study.plan import make_plan
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED, Estimate, read_verdicts

PAPERS = Path(__file__).parents[2] / "examples" / "papers"


@pytest.fixture(scope="module")
def papers():
    sys.path.insert(0, str(PAPERS))
    import c7010_vibro_claims
    import c7010_vibro_figures
    import c7010_vibro_impact
    import speed_fluctuation
    import speed_fluctuation_claims
    import speed_fluctuation_figures

    yield SimpleNamespace(
        vibro=c7010_vibro_impact, claims=c7010_vibro_claims,
        figures=c7010_vibro_figures, fluctuation=speed_fluctuation,
        waves=speed_fluctuation_claims, wave_figures=speed_fluctuation_figures,
    )  # fmt: skip
    sys.path.remove(str(PAPERS))


def judged(papers, key, cases):
    """The verdict on a claim by figures of some cases: {label: {figure: value}}."""
    plain = {f.name: Estimate(1.0, 0.01) for f in fields(papers.figures.Figures)}
    steady = papers.figures.Figures(**plain)
    found = {
        label: [replace(steady, **{k: Estimate(v, 0.01) for k, v in changed.items()})] * 2
        for label, changed in cases.items()
    }
    claim = next(c for c in papers.claims.CLAIMS if c.key == key)
    view = papers.claims.View(found)
    return claim.verdict({"radial": view}, "radial", shown=papers.claims.SHOWN, source="")


def test_every_reading_is_a_plan(papers):
    counts = {}
    for reading in papers.vibro.READINGS:
        plan = make_plan(papers.vibro.study(reading))
        counts[reading] = len(plan.cases)
        asked = [p["label"] for p in papers.vibro.points(reading)]
        assert len(set(asked)) == len(asked)
    assert (
        counts["radial"] == 2 * counts["axial"] == 2 * 28
        and counts["steeper friction"] == 14 == counts["guided by a land"]
    )


def test_readings_load_what_they_say(papers):
    assert papers.vibro.points("axial")[0]["load.radial"] == "0 N"
    top = next(p for p in papers.vibro.points("combined") if p["label"] == "12500 N")
    assert top["load.radial"] == top["load.axial"] == "12500 N"
    waves = next(p for p in papers.vibro.points("axial") if p["label"] == "load sine")
    assert waves["load.wave_of"] == "axial"


def test_a_peak_that_rises_with_gaps_holds_and_one_that_falls_does_not(papers):
    speeds = papers.claims.SPEEDS
    rising = {s: {"peak": 100.0 + 5.0 * k, "empty_opposite": 0.3} for k, s in enumerate(speeds)}
    assert judged(papers, "004-1", rising).outcome == HOLDS
    falling = {s: {"peak": 100.0 - 5.0 * k, "empty_opposite": 0.3} for k, s in enumerate(speeds)}
    assert judged(papers, "004-1", falling).outcome == FAILS
    full = {s: {**v, "empty_opposite": 0.0} for s, v in rising.items()}
    assert judged(papers, "004-1", full).outcome in (FAILS, UNDECIDED)


def test_waves_rank_as_claimed_or_not(papers):
    ranked = {
        w: {"peak": 10.0 + k, "axial_range": 2.0 + k, "ball_ripple": 5.0 + k}
        for k, w in enumerate(papers.claims.LOAD_WAVES)
    }
    assert judged(papers, "004-6 load", ranked).outcome == HOLDS
    swapped = dict(zip(ranked, list(ranked.values())[::-1], strict=True))
    assert judged(papers, "004-6 load", swapped).outcome == FAILS
    verdict = judged(papers, "004-6 load", {"load sine": {}})
    assert verdict.outcome == UNDECIDED and verdict.reason == "not computed"


def test_a_line_tells_regular_orbits_beyond_its_interval(papers):
    view = papers.claims.View({
        name: [SimpleNamespace(line=Estimate(value, 0.05))]
        for name, value in {"a": 0.9, "b": 0.2, "c": 0.52}.items()
    })  # fmt: skip
    assert papers.claims.regular("a")(view) == HOLDS and papers.claims.chaotic("b")(view) == HOLDS
    assert papers.claims.regular("c")(view) == UNDECIDED


@pytest.mark.slow
def test_vibro_impacts_from_end_to_end(papers, tmp_path):
    found = papers.vibro.main(["--quick", "-o", str(tmp_path / "quick")])
    stored = read_verdicts(tmp_path / "quick" / "radial")
    assert [(v.key, v.outcome) for v in stored] == [(v.key, v.outcome) for v in found]
    angles = next(v for v in found if v.key == "004-3")
    at = {line.label: line.value for line in angles.figures}
    # centrifugal force parts the angles
    assert at["12000 rpm: inner contact angle"] > at["4000 rpm: inner contact angle"] + 2.0
    assert at["12000 rpm: outer contact angle"] < at["4000 rpm: outer contact angle"] - 2.0


def test_the_speeds_of_the_third_paper_fluctuate_as_it_says(papers):
    for reading in papers.fluctuation.READINGS:
        plan = make_plan(papers.fluctuation.study(reading))
        assert len(plan.cases) == (18 if reading == "step" else 6)
    waves = {p["label"]: p for p in papers.fluctuation.points("step")}
    assert list(waves) == [papers.waves.CONSTANT, *papers.waves.AMPLITUDES, "A 6 %, N 2",
                           "A 6 %, N 3"]  # fmt: skip
    assert "drive.wave" not in waves["constant"]
    assert waves["A 9 %"]["drive.wave_amplitude"] == "180 rpm"
    assert waves["A 6 %, N 3"]["drive.wave_period"] == "10 ms"


def test_figures_of_a_speed_that_fluctuates(papers):
    """A sine of 6 % with a quarter of its variance in another; balls whose force follows place."""
    f = papers.wave_figures
    t = np.arange(7200) / 20e3
    sine, other = np.sin(2 * np.pi * t / 30e-3), np.sin(2 * np.pi * t / 9e-3)
    amplitude, share = f.wave_in(100.0 + 6.0 * sine + 3.0 * other, t, 30e-3)
    assert amplitude == pytest.approx(6.0, rel=1e-3) and share == pytest.approx(0.8, abs=1e-3)
    assert f.half_range(100.0 + 6.0 * sine) == pytest.approx(0.06, rel=1e-4)
    even = 2 * np.pi * np.arange(17) / 17
    psi = even + 98.0 * t[:, None]
    force = 200.0 + 150.0 * np.cos(psi) + 20.0 * np.cos(2 * psi)
    assert f.place_in(force, psi) == pytest.approx(1.0, abs=1e-9)
    noise = np.random.default_rng(1).normal(0.0, force.std(), force.shape)
    assert f.place_in(force + noise, psi) == pytest.approx(0.5, abs=0.02)
    assert f.excursion(psi + 0.01 * np.cos(even)) == pytest.approx(0.01, rel=0.02)


def test_claims_on_a_speed_that_fluctuates(papers):
    """A cage that follows its ring in all holds 002-1 and 002-7; one that overshoots does not."""
    waves = papers.waves

    def outcome(key, swings, speed=98.0):
        shares = {"constant": 0.0, **papers.waves.AMPLITUDES, "A 6 %, N 2": 0.06,
                  "A 6 %, N 3": 0.06}  # fmt: skip
        found = {}
        for label, share in shares.items():
            plain = {f.name: Estimate(1.0, 0.001) for f in fields(papers.wave_figures.Figures)}
            plain |= {"swing": Estimate(share * swings.get(label, 1.0), 1e-4),
                      "speed": Estimate(speed, 0.01), "follows": Estimate(0.97, 0.01)}  # fmt: skip
            found[label] = [papers.wave_figures.Figures(**plain)]
        claim = next(c for c in waves.CLAIMS if c.key == key)
        views = {"step": waves.View(found)}
        return claim.verdict(views, "step", shown=waves.SHOWN, source="").outcome

    assert outcome("002-1", {}) == outcome("002-7", {}) == HOLDS
    assert outcome("002-2", {}) == FAILS  # 97 % of the variance at 3 %
    assert outcome("002-1", {"A 9 %": 1.3}) == FAILS
    assert outcome("002-7", {"A 6 %, N 3": 1.5}) == FAILS
