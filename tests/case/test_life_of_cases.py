"""Lives that cases ask for: of one load, of a spectrum, in texts and figures; what cannot be."""

from pathlib import Path

import pytest

from flexcage import Case, load_case, load_static, solve_static
from flexcage.core.errors import InputError
from flexcage.simulate import simulate

PAGE = Path(__file__).parents[2] / "examples/fits.md"
ROLLERS = Case.from_preset(
    "N1013", load={"radial": 8000.0}, drive={"speed": 300.0}, cage={"model": "rigid"}
)


def worked():
    """The case of the page with its [life]."""
    blocks = PAGE.read_text("utf-8").split("```toml\n")
    return load_static("".join(block.split("```")[0] for block in blocks[1:3]))


def test_the_worked_example():
    lives = solve_static(worked()).lives
    first, second, standing = lives.points
    assert standing is None and lives.symbol == "5" and lives.reliability_factor == 0.64
    assert first.reference_modification == pytest.approx(8.68, abs=0.01)  # as the page says
    assert lives.combined == pytest.approx(1.0 / (0.3 / first.hours + 0.6 / second.hours))
    assert lives.combined == pytest.approx(124250.0, rel=1e-3)
    assert lives.fatigue_limit == pytest.approx(14.93e3 / 22.0, rel=1e-3)
    # 70 degC instead of 60 thins the oil
    assert (1e6 * second.viscosity, 1e6 * first.viscosity) == pytest.approx((28.7, 20.1), rel=3e-3)


def test_the_worked_example_is_told():
    text = solve_static(worked()).table(100)
    for words in (
        "reliability factor a1           0.64 at 95 %", "life L5mr, ISO/TS 16281",
        "(e_C 0.6, C_u 0.6788 kN)", "load spectrum: each point", "kappa  a_ISO     L5mrh, h",
    ):  # fmt: skip
        assert words in text


def test_without_life_nothing_is_another():
    case = ROLLERS
    asked = case.replace("life.reliability", 95.0)
    assert "[life]" not in case.to_toml() and "life L5r" not in solve_static(case).table(100)
    assert "lives" not in solve_static(case).to_dict() and asked.hash != case.hash
    assert load_case(asked.to_toml()) == asked
    spectrum = worked()
    assert load_static(spectrum.to_toml()).life == spectrum.life


def test_reliability_alone_scales_the_plain_life():
    solution = solve_static(ROLLERS.replace("life.reliability", 99.0))
    here, plain = solution.lives.here, solution.ratings
    assert here.reference_life == pytest.approx(0.25 * plain.reference_life)
    assert here.life == pytest.approx(0.25 * plain.life)
    assert here.hours == pytest.approx(0.25 * solution.life_hours())
    assert "life L1r, ISO/TS 16281" in solution.table(100)


def test_a_spectrum_of_one_point_is_the_load_itself():
    own = {"share": 1.0, "speed": 300.0, "radial": 8000.0}
    case = ROLLERS.replace({"life.contamination": 0.5, "life.spectrum": [own]})
    lives = solve_static(case).lives
    assert lives.combined == pytest.approx(lives.here.hours, rel=1e-9)
    halves = [{**own, "share": 0.5}, {**own, "share": 0.5}]
    assert solve_static(case.replace("life.spectrum", halves)).lives.combined == pytest.approx(
        lives.combined
    )


def test_a_value_of_a_point_is_set_from_outside():
    text = worked().to_toml()
    changed = load_static(text, overrides={"life.spectrum.0.radial": "3 kN"})
    assert [point.radial for point in changed.life.spectrum] == [3e3, 1e3, 0.0]
    with pytest.raises(InputError, match="leads nowhere"):
        load_static(text, overrides={"life.spectrum.3.radial": "3 kN"})


def test_points_are_of_the_fit_at_their_own_speed():
    case = worked().replace({"life.spectrum.0.speed": "20000 rpm", "life.spectrum.2.share": 0.1})
    at_rest = case.replace("drive.speed", 500.0)
    found = [solve_static(c).lives.points[0].hours for c in (case, at_rest)]
    assert found[0] == found[1]


def test_starvation_takes_of_kappa():
    case = ROLLERS.replace("life.contamination", 0.5)
    full, less = (solve_static(c).lives.here for c in (case, case.replace("life.inlet", "150 um")))
    assert full.starved == 1.0 and 0.0 < less.starved < 1.0
    assert less.kappa == pytest.approx(full.kappa * less.starved**1.3)
    assert less.reference_life < full.reference_life
    # a thicker oil needs more of it at the inlet
    thick = case.replace({"life.inlet": "150 um", "lubricant.viscosity": 0.1})
    assert solve_static(thick).lives.here.starved < less.starved
    warm = {"life.viscosity_40": 116.3e-6, "life.viscosity_100": 14e-6, "life.temperature": 313.15}
    as_thick = solve_static(case.replace({"life.inlet": "150 um", **warm})).lives.here
    assert as_thick.starved == pytest.approx(solve_static(thick).lives.here.starved, rel=1e-3)
    dry = solve_static(case.replace("life.inlet", "1 um"))
    assert any("life.inlet lies within the heaviest contacts" in w for w in dry.warnings)


def test_a_run_has_them_as_figures():
    case = ROLLERS.replace({"solver.duration": "2 ms", "life.contamination": 0.5})
    summary, lives = simulate(case).summary, solve_static(case).lives
    assert summary["life_kappa"] == pytest.approx(lives.here.kappa)
    assert summary["life_a_iso"] == pytest.approx(lives.here.reference_modification)
    assert summary["life_nmrh"] == pytest.approx(3600.0 * lives.here.hours)
    assert "life_spectrum" not in summary
    thin = case.replace({"lubricant.viscosity": 1e-4, "drive.speed": 20.0})
    assert any("has a_ISO from 0.1 on" in w.text for w in simulate(thin).summary.warnings)


def spectrum(*shares):
    return [{"share": share, "speed": 300.0, "radial": 1e3} for share in shares]


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"spectrum": spectrum(0.5, 0.4)}, "add up to 0.9, but should to 1; give all"),
        ({"spectrum": spectrum(50.0, 0.5)}, "share"),
        ({"spectrum": spectrum(0.9, 0.9)}, "shares are parts of 1, not percent"),
        ({"contamination": 1.2}, "life.contamination is 1.2"),
        ({"contamination": -0.1}, "life.contamination is -0.1"),
        ({"reliability": 94.0}, "ISO 281 has a_1 for 90, 95"),
        ({"reliability": 0.95}, "it is in percent"),
        ({"viscosity_40": 32e-6}, "life.viscosity_40 is given without life.viscosity_100"),
        ({"viscosity_40": 32e-6, "viscosity_100": 5e-6}, "give life.temperature"),
        ({"viscosity_40": 5e-6, "viscosity_100": 6e-6, "temperature": 330.0}, "oils thin"),
        ({"spectrum": [{**spectrum(1.0)[0], "temperature": 330.0}]}, "by which it would count"),
        ({"grease_life": 1.0}, "flexcage computes no grease life"),
        ({"spectrum": [{**spectrum(1.0)[0], "radial": 1e9}]}, "In life.spectrum.0: load.radial"),
    ],
)
def test_what_cannot_be(values, said):
    with pytest.raises(InputError) as caught:
        solve_static(ROLLERS.replace({f"life.{key}": value for key, value in values.items()}))
    assert said in str(caught.value) and caught.value.where.startswith("life")


def test_a_standing_bearing_has_no_a_iso():
    with pytest.raises(InputError, match="the bearing stands still at the start"):
        ROLLERS.replace({"drive.speed": 0.0, "life.contamination": 0.5})


def test_outside_of_the_standard():
    slow = ROLLERS.replace({"drive.speed": 0.5, "life.contamination": 0.5})
    assert any("kappa is 0.0" in w for w in solve_static(slow).warnings)
    heavy = ROLLERS.replace({"load.radial": "30 kN", "life.contamination": 0.5})
    assert any("above half of the dynamic rating" in w for w in solve_static(heavy).warnings)
