"""A new case of a full complement: names of two makers, rollers that fill the pitch circle, ribs by
design, and a run and a static solution of what is written."""

from math import asin, pi

import numpy as np
import pytest

from flexcage.bearings.cylindrical_roller.ratings import dynamic_rating, static_rating
from flexcage.case import catalogue, load_case, load_static
from flexcage.case.new import new_case
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.geometry.full_complement import circumferential_play, filling_count
from flexcage.simulate import simulate
from flexcage.static import solve_static

RATED = [d for d in catalogue.designations() if d.startswith(("NCF", "NJG"))]


def written(designation, **options):
    entry = catalogue.find(designation)
    return new_case(entry.outline, entry.source, **options)


@pytest.mark.parametrize(
    ("designation", "same"),
    [
        ("NCF 3010 CV", "NCF3010"),
        ("ncf3010cv", "NCF3010"),
        ("NCF 3010 V/C3", "NCF3010"),
        ("SL18 3010", "NCF3010"),
        ("SL183010-A-XL", "NCF3010"),
        ("SL18 2912", "NCF2912"),
        ("NJG 2308 VH", "NJG2308"),
        ("SL192308-TB", "NJG2308"),
        ("NJ2308-VH", "NJG2308"),
    ],
)
def test_names_of_two_makers_mean_one_bearing(designation, same):
    entry, plain = catalogue.find(designation), catalogue.find(same)
    assert entry.outline.boundary == plain.outline.boundary
    assert entry.outline.static_rating == plain.outline.static_rating
    assert ("means" in entry.source) == (not designation.upper().startswith(("NCF", "NJG")))
    assert "SKF, General Catalogue 6000" in entry.source


@pytest.mark.parametrize("designation", RATED)
def test_a_whole_number_of_rollers_fills_the_circle_of_the_makers_race(designation):
    """Makers choose E (NCF) or F (NJG) for a number of rollers: a tenth of one is spare, at most;
    C and C0 of the catalogue follow ISO 281 and ISO 76 by one inside."""
    made = written(designation)
    bearing = made.chosen.bearing
    around = pi / asin(bearing.roller_diameter / bearing.pitch_diameter)
    assert 0.01 < around - bearing.roller_count < 0.11
    assert static_rating(bearing) == pytest.approx(made.outline.static_rating, rel=1e-3)
    assert dynamic_rating(bearing) == pytest.approx(made.outline.dynamic_rating, rel=0.02)
    race = "outer" if designation.startswith("NCF") else "inner"
    assert getattr(bearing, f"{race}_race_diameter") == getattr(
        made.outline, f"{race}_race_diameter"
    )
    assert bearing.inner_race_diameter > bearing.bore
    assert bearing.outer_race_diameter < bearing.outside_diameter


def test_play_is_what_the_rollers_leave_of_the_circle():
    """Six rollers of 10 mm fill a circle of 20 mm exactly: one fewer spares its arc."""
    assert filling_count(10e-3, 20e-3) == 5
    assert circumferential_play(10e-3, 20e-3, 6) == pytest.approx(0.0, abs=1e-15)
    assert circumferential_play(10e-3, 20e-3, 5) == pytest.approx(pi * 20e-3 / 6.0)
    text = written("NCF 3010 CV").text
    # 22 rollers of 9 mm on 63.33 mm: pi 63.33 - 22 63.33 asin(9/63.33) = 0.284 mm
    assert "circumferential play 0.284 mm in all" in text and "roller_count = 22 " in text


def test_ribs_are_those_of_the_design_and_what_is_left_out_is_said():
    ncf, njg = (written(name) for name in ("NCF 3010 CV", "NJG 2308 VH"))
    inner, outer = (ncf.chosen.bearing.ribs(ring) for ring in ("inner", "outer"))
    assert all(inner.sides) and sum(outer.sides) == 1
    inner, outer = (njg.chosen.bearing.ribs(ring) for ring in ("inner", "outer"))
    assert sum(inner.sides) == 1 and all(outer.sides)
    assert "the retaining ring" in ncf.text and "(design NF)" in ncf.text
    assert any("hold themselves" in line for line in njg.findings())
    values = [line for line in ncf.text.splitlines() if line.startswith(("rib_", "counter_rib"))]
    assert len(values) == 4 and all("# assumption" in line for line in values)


def test_a_bearing_rated_with_a_cage_is_filled_and_rated_anew():
    """An NU 210 has 16 rollers of 11 mm on 70.5 mm, and space for 20."""
    caged = written("NU 210").chosen.bearing
    for made in (written("NU 210", cage="none"), written("NU 210 V")):
        bearing = made.chosen.bearing
        assert (caged.roller_count, bearing.roller_count) == (16, 20)
        assert bearing.roller_length == caged.roller_length
        told = "\n".join(made.findings())
        assert "16 rollers of 11 x 12 mm" in told and "No cage: 20 rollers" in told
        assert "C0r = 86.3 kN by ISO 76" in told  # 69 kN times 20/16
        assert 'model = "none"' in made.text
    balls = written("6205 V")
    assert balls.chosen.bearing.ball_count == 15 and load_case(balls.text).cage is None


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ["NCF 3010", "--cage", "window"],
            "NCF3010 has no cage: its elements fill",
        ),
        (["--type", "cylindrical_roller", "--design", "NCF"], 'NCF is the design "NF" with model'),
        (["--type", "cylindrical_roller"], "needs the race diameter E (--outer-race) or F"),
        (["--type", "deep_groove_ball"], "is not inferred from ratings of a full complement"),
    ],
)
def test_mistakes_get_one_sentence(arguments, sentence, capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    own = ["--cage", "none", "--bore", "50 mm", "--outside", "90 mm", "--width", "23 mm",
           "--dynamic", "100 kN", "--static", "120 kN"]  # fmt: skip
    assert main(["new", *arguments, *(own if "--type" in arguments else [])]) == 2
    assert sentence in capsys.readouterr().err


def test_dimensions_and_one_race_write_a_case_as_well(monkeypatch, tmp_path):
    """An NCF 2210 V, whose E the catalogue has: 20 rollers of 11 mm fill 70.4 mm."""
    monkeypatch.chdir(tmp_path)
    own = ["--design", "NF", "--bore", "50 mm", "--outside", "90 mm", "--width", "23 mm",
           "--outer-race", "81.4 mm", "--dynamic", "100 kN", "--static", "120 kN"]  # fmt: skip
    assert main(["new", "NCF2210V", "--type", "cylindrical_roller", "--cage", "none", *own]) == 0
    bearing = load_case("NCF2210V.toml").bearing
    assert (bearing.roller_count, bearing.roller_diameter) == (20, pytest.approx(11e-3))
    with pytest.raises(InputError, match="must be greater than F"):
        outline = catalogue.find("NCF3010").outline
        new_case(type(outline)(**(vars(outline) | {"inner_race_diameter": 75e-3})), "given")


def test_a_written_case_runs_and_has_a_static_solution(tmp_path):
    text = written("NCF 3010 CV").text
    case = load_case(text, overrides={"solver.duration": "2 ms", "load.axial": "300 N"})
    run = simulate(case, out=tmp_path)
    assert case.cage is None and run.summary["energy_audit"] == "passed"
    solution = solve_static(load_static(text))
    elements = solution.elements
    inner = elements.force[:, 0] * np.cos(elements.azimuth)
    assert inner.sum() == pytest.approx(3800.0, rel=1e-6)  # N, the load
