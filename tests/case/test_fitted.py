"""A bearing on its seats: classes of clearance, what follows in statics, runs and texts, and what
cannot be."""

from math import cos
from pathlib import Path

import numpy as np
import pytest

import flexcage
from flexcage import Case, load_case, load_static, solve_static
from flexcage.case.description import in_words
from flexcage.case.fitted import class_limits
from flexcage.core.errors import InputError
from flexcage.geometry.fits.spec import Fit
from flexcage.simulate import simulate

PAGE = Path(__file__).parents[2] / "examples/fits.md"
ROLLERS = Case.from_preset(
    "N1013", load={"radial": 5000.0}, drive={"speed": 600.0}, cage={"model": "rigid"}
)
ANGULAR = load_static(
    '[bearing]\npreset = "7010C-PI"\n[load]\naxial = "100 N"\naxial_stiffness = "50 N/um"\n'
)


def worked():
    """The case of the page."""
    return load_case(PAGE.read_text("utf-8").split("```toml\n")[1].split("```")[0])


def values(case, key, at=1):
    return 1e6 * case.mounting.part(key).values[at]


def test_the_worked_example():
    """6306 C3, k5, H7, shaft and inner ring 20 K warmer: by hand, with the cylinder of the inner
    ring's section, 41.8 mm, at its race of 39.094 mm."""
    case = worked()
    assert [round(values(case, "initial", k), 6) for k in range(3)] == [13.0, 20.5, 28.0]
    kept = 11.5 * 30.0 / 32.0  # of 2 to 11 um and -10 to 0 um: d/(d + 2)
    d, wall, race = 30.0, 41.799, 39.094
    t, nu = (d / wall) ** 2, 0.3
    # of a solid shaft of the same steel, p d/E = kept (1 - t)/2
    growth = 0.5 * kept * (t * (1 - nu) * race + (1 + nu) * d * d / race) / d
    assert values(case, "inner_fit") + values(case, "smoothing") == pytest.approx(-growth, rel=1e-4)
    warm = 12e-6 * (20e3 * race + 2.0 * 10e3 * 11.906)  # balls in the middle
    assert values(case, "temperature") == pytest.approx(-warm, rel=1e-3)
    left = 20.5 - growth - warm + values(case, "centrifugal")
    assert values(case, "operating") == pytest.approx(left, abs=1e-3)
    assert -0.1 < values(case, "centrifugal") < 0.0
    assert case.mounted.bearing.clearance == case.mounting.operating
    assert 1e6 * case.mounting.operating == pytest.approx(0.32, abs=0.005)  # as the page says


def test_the_worked_example_is_told(capsys):
    solution = solve_static(worked())
    text = solution.table(100)
    for line in (
        "before mounting      13.00   20.50    28.00",
        "in operation        -13.72    0.32",
    ):
        assert line in text
    assert "interference 11.5 um as toleranced, 10.7" in text
    assert any("may close the clearance: -13.7 um to 14.4 um" in w for w in solution.warnings)
    assert solution.to_dict()["mounting"]["changed"]["clearance"] == pytest.approx(3.2e-7, abs=5e-9)


def test_without_fit_nothing_is_another():
    case = worked().replace("fit", Fit())
    assert case.mounted is case and case.mounting is None and "[fit]" not in case.to_toml()
    assert "mounting" not in solve_static(case).to_dict()
    assert case.replace("fit.preload", True).hash != "" and case.hash != worked().hash


def test_texts_read_back():
    case = worked()
    again = load_case(case.to_toml())
    assert again == case and again.hash == case.hash
    assert again.mounted.bearing == case.mounted.bearing


def test_hash_counts_what_follows():
    """Two ways to the same bearing are one; an interference that changes it is another."""
    case = worked().replace({"fit.shaft": "", "fit.shaft_interference": "11.5 um"})
    assert case.hash == worked().hash
    assert case.replace("fit.shaft_interference", "12 um").hash != case.hash


def test_a_static_solution_is_one_of_the_bearing_that_is_left():
    for case in (worked(), ROLLERS.replace({"fit.shaft": "k5", "fit.housing": "H7"})):
        left = case.mounted.bearing
        plain = case.replace("fit", Fit()).replace("bearing", left)
        fitted, alone = solve_static(case), solve_static(plain)
        assert np.array_equal(fitted.displacement, alone.displacement)
        assert np.array_equal(fitted.elements.force, alone.elements.force)
        assert left != case.bearing


def test_a_run_is_one_of_the_bearing_that_is_left():
    case = ROLLERS.replace({"solver.duration": "2 ms", "fit.shaft": "k5", "fit.clearance": "C3"})
    plain = case.replace("fit", Fit()).replace("bearing", case.mounted.bearing)
    run, alone = simulate(case), simulate(plain)
    assert np.array_equal(run.dataset["race_force"], alone.dataset["race_force"])
    figure = run.summary["clearance_operating"]
    assert figure == case.mounting.operating == run.bearing.radial_clearance
    assert "60 um to 90 um within tolerances" in run.summary.row("clearance_initial").note
    assert "clearance_operating" not in alone.summary
    words = " ".join(in_words(case))
    assert "leave of 75 µm before mounting." in words and "radial clearance 75 µm" not in words


def test_races_move_with_their_rings():
    """An inner ring that grows moves the pitch circle, not both races alike."""
    case = ROLLERS.replace({"fit.shaft_interference": "20 um", "fit.smoothing": "none"})
    grown, b, now = case.mounting.changed.inner_race, case.bearing, case.mounted.bearing
    assert 12e-6 < grown < 19e-6
    assert now.inner_race_radius - b.inner_race_radius == pytest.approx(0.5 * grown, rel=1e-9)
    assert now.outer_race_radius == pytest.approx(b.outer_race_radius, abs=1e-12)
    assert now.rib_diameter - b.rib_diameter == pytest.approx(grown)
    balls = worked()
    bottoms = [
        b.pitch_diameter - b.ball_diameter - 0.5 * b.clearance
        for b in (balls.replace("bearing.radial_clearance", 20.5e-6).bearing, balls.mounted.bearing)
    ]
    assert bottoms[1] - bottoms[0] == pytest.approx(balls.mounting.changed.inner_race, abs=1e-9)


def test_angle_and_preload_of_angular_contact_follow():
    case = ANGULAR.replace({"fit.shaft_interference": "8 um", "fit.housing_interference": "2 um"})
    before, after = case.mounting.angles
    b, m = case.bearing, case.mounted.bearing
    assert 0.0 < after < before == b.free_contact_angle
    lost = 2.0 * b.groove_distance * (cos(after) - cos(before))
    assert lost == pytest.approx(-sum(values(case, k) for k in
                                      ("inner_fit", "outer_fit", "smoothing")) * 1e-6)  # fmt: skip
    approach = b.groove_offset[0] - m.groove_offset[0]
    assert case.mounting.approach == approach > 0.0
    assert case.mounted.load.axial == pytest.approx(100.0 + 50e6 * approach)
    # on a shaft that does not yield the ring stays where it is: preload by geometry alone
    rigid = case.replace({"load.axial_stiffness": 1e12, "load.axial": 0.0, "load.radial": 1.0})
    assert solve_static(rigid).displacement[0] == pytest.approx(approach, rel=1e-3)


def test_limits_of_the_tolerances_are_cases():
    least, mean, largest = (
        worked().replace("fit.at", at).mounting.operating for at in ("least", "mean", "largest")
    )
    assert least < mean < largest
    assert worked().mounting.parts[-1].values == pytest.approx((least, mean, largest))


def test_speed_is_the_fastest_of_the_drive():
    case = worked()
    ramp = case.replace({"drive.ramp_to": "20000 rpm", "drive.ramp_time": "10 ms"})
    own = case.replace("fit.at_speed", "20000 rpm")
    assert values(ramp, "centrifugal") == values(own, "centrifugal") < values(case, "centrifugal")


@pytest.mark.parametrize(
    ("preset", "group", "um"),
    [("N1013", "C3", (60.0, 90.0)), ("N1013", "CN", (40.0, 70.0)), ("7010C-PI", "C3", None)],
)
def test_classes(preset, group, um):
    found = class_limits(flexcage.load_preset(preset).bearing, group)
    assert (None if found is None else tuple(round(1e6 * v, 6) for v in found)) == um


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"shaft": "q5"}, "fit.shaft is 'q5', which is no tolerance of shafts"),
        ({"housing": "h7"}, "holes have capital letters: is H7 meant"),
        ({"shaft": "k5", "shaft_interference": "5 um"}, "each says the same; keep one"),
        ({"shaft_bore": "30 mm"}, "fit.shaft_bore is 30 mm, but the shaft itself has 30 mm"),
        ({"clearance": "C6"}, "fit.clearance 'C6' is not known; choose from C2, CN"),
        ({"shaft": "", "shaft_interference": "2 mm"}, "[fit] leaves a radial clearance of"),
        ({"inner_temperature": "20 K", "housing_thickness": "0 mm"}, "housing_thickness"),
        ({"housing_material": {"name": "alloy", "youngs_modulus": "70 GPa", "poisson_ratio": 0.33,
                               "density": "2700 kg/m^3"}, "outer_temperature": "60 degC"},
         "no thermal expansion of alloy is known; give fit.housing_material.expansion"),
        ({"interference": "5 um"}, "Unknown key 'interference' in [fit]"),
        ({"fit": "k5"}, "fit.shaft = \"k5\" and fit.housing"),
    ],
)  # fmt: skip
def test_what_cannot_be(values, said):
    with pytest.raises(InputError) as caught:
        worked().replace({f"fit.{key}": value for key, value in values.items()}, si=False)
    assert said in str(caught.value) and caught.value.where.startswith("fit")


def test_rollers_have_no_preload():
    with pytest.raises(
        InputError, match=r"\[fit\] leaves a radial clearance of -.* um of 40 um be"
    ):
        ROLLERS.replace({"bearing.radial_clearance": "40 um", "fit.shaft_interference": "90 um"})


def test_angular_contact_has_no_class_and_keeps_an_angle():
    with pytest.raises(InputError, match="no classes of angular contact ball bearings; leave it"):
        ANGULAR.replace("fit.clearance", "C3")
    with pytest.raises(InputError, match="contact angle from a clearance greater than 0 um"):
        ANGULAR.replace("fit.shaft_interference", "40 um")


def test_warnings():
    def told(case):
        return " ".join(solve_static(case).warnings)

    tight = worked().replace({"fit.shaft": "n6", "bearing.radial_clearance": "10 um"}, si=False)
    assert "The fit closes the clearance: -10 um" in told(tight)
    assert "closes the clearance" not in told(tight.replace("fit.preload", True))
    unread = load_static(tight.to_toml()).replace("fit.shaft", "k5")
    assert "bearing.radial_clearance (fit.clearance gives it)" in told(unread)
    alloy = {"name": "alloy", "youngs_modulus": 70e9, "poisson_ratio": 0.33, "density": 2700.0,
             "expansion": 24e-6}  # fmt: skip
    loose = worked().replace(
        {"fit.housing": "N7", "fit.housing_material": alloy, "fit.housing_temperature": 350.0}
    )
    assert "The outer ring loses its grip: of an interference of 17.5 um" in told(loose)
