"""Temperatures at which a bearing settles, and bearings that do not."""

import csv
import json
import tomllib
from pathlib import Path

import pytest

from flexcage.case import load_case, load_static
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.geometry.life.oil import viscosity_at
from flexcage.warming import warm, write_warmth
from flexcage.warming.at_temperatures import evaluate, film_of

CROWN = Path(__file__).parents[2] / "examples" / "6205_crown.toml"
BALLS = """
name = "6206"
[bearing]
type = "deep_groove_ball"
bore = "30 mm"
outside_diameter = "62 mm"
width = "16 mm"
pitch_diameter = "46 mm"
ball_diameter = "9.525 mm"
ball_count = 9
inner_groove_radius = "4.9054 mm"
outer_groove_radius = "5.0006 mm"
[cage]
model = "none"
[fit]
clearance = "CN"
shaft = "k5"
housing = "H7"
[drive]
speed = "9000 rpm"
[load]
radial = "2000 N"
[life]
viscosity_40 = "68 mm^2/s"
viscosity_100 = "8.7 mm^2/s"
temperature = "60 degC"
contamination = 0.6
"""
ROLLERS = """
name = "NU206"
[bearing]
type = "cylindrical_roller"
bore = "30 mm"
outside_diameter = "62 mm"
width = "16 mm"
inner_race_diameter = "37.5 mm"
outer_race_diameter = "55.5 mm"
roller_diameter = "9 mm"
roller_length = "10 mm"
effective_length = "8.67 mm"
roller_count = 13
radial_clearance = "20 um"
design = "NU"
rib_diameter = "52.5 mm"
rib_gap = "10.03 mm"
[drive]
speed = "12000 rpm"
[load]
radial = "2200 N"
[life]
viscosity_40 = "68 mm^2/s"
viscosity_100 = "8.7 mm^2/s"
temperature = "60 degC"
"""


def balls(**values):
    return load_static(BALLS, overrides={k.replace("__", "."): v for k, v in values.items()})


@pytest.fixture(scope="module")
def settled():
    return warm(balls())


def test_energy_in_is_heat_out(settled):
    end = settled.last
    assert settled.settled and end.change <= 1.0
    assert end.power == pytest.approx(sum(end.losses.values()), rel=1e-9)  # what the drive puts in
    assert sum(end.out.values()) == pytest.approx(end.power, rel=0.01)


def test_temperatures_stay_where_they_have_settled(settled):
    """Once more from there, and from far away, is the same within the tolerance."""
    again = evaluate(settled.case, settled.temperatures).iteration
    for body, at in settled.temperatures.items():
        assert again.towards[body] == pytest.approx(at, abs=1.0)
    far = warm(balls(life__temperature="110 degC"))
    for body, at in settled.temperatures.items():
        assert far.temperatures[body] == pytest.approx(at, abs=1.5), body


def test_viscosity_clearance_and_life_follow_the_temperatures(settled):
    """In the settled case, whose temperatures are written to 0.01 K."""
    case, t = settled.case, settled.temperatures
    film = film_of(t)
    assert case.lubricant.viscosity == pytest.approx(
        viscosity_at(film, 68e-6, 8.7e-6) * case.lubricant.density, rel=1e-3
    )
    assert case.life.temperature == pytest.approx(film, abs=0.02)
    fit = case.fit
    assert (fit.inner_temperature, fit.shaft_temperature) == (
        pytest.approx(t["inner"], abs=0.006), pytest.approx(t["shaft"], abs=0.006),
    )  # fmt: skip
    assert t["inner"] > t["outer"] > t["housing"] > case.heat.ambient
    parts = settled.solution.mounting
    assert parts.operating == pytest.approx(settled.last.clearance, abs=2e-8)
    assert parts.part("temperature").values[1] < -2e-6  # the inner ring is the warmer one
    assert settled.solution.lives.here.temperature == case.life.temperature


def test_heat_goes_where_it_is_let(settled):
    cooled = warm(balls(heat__oil_flow="0.5 l/min", heat__oil_inlet="30 degC"))
    assert cooled.settled and cooled.temperatures["oil"] < settled.temperatures["oil"]
    assert cooled.last.out["oil to oil that flows"] > 0.5 * cooled.last.loss
    assert cooled.last.viscosity > settled.last.viscosity  # and so it loses more
    assert cooled.last.loss > settled.last.loss
    sealed = warm(balls(heat__seal_torque="20 N*mm", heat__churning_torque="10 N*mm"))
    turning = sealed.solution.speed
    assert sealed.last.losses["seals"] == pytest.approx(0.02 * turning)
    assert sealed.last.losses["churning"] == pytest.approx(0.01 * turning)
    assert sealed.temperatures["inner"] > settled.temperatures["inner"]


@pytest.mark.parametrize(
    ("values", "said"),
    [
        (
            {"heat__housing_ambient": "0.02 W/K", "heat__shaft_ambient": "0.02 W/K"},
            "Runaway: the oil in contacts is past heat.oil_limit, 150 degC",
        ),
        (  # a preload that warmth closes further: more heat, more preload
            {
                "heat__shaft_ambient": "0 W/K", "heat__housing_ambient": "50 W/K",
                "drive__speed": "15000 rpm", "fit__shaft": "n6", "fit__housing": "N7",
            },
            "Runaway: the inner ring is past heat.steel_limit, 150 degC",
        ),
    ],
    ids=["no way out", "preload"],
)  # fmt: skip
def test_a_runaway_is_a_result(values, said):
    found = warm(balls(**values))
    assert found.verdict == "runaway" and found.sentence.startswith(said)
    assert len(found.iterations) < 12
    assert found.last.towards["inner"] > found.temperatures["inner"]


def test_a_clearance_that_warmth_closes_is_a_result():
    """Rollers have no preload in the model: 200 W from the shaft's side close it, and the last
    iterations near the end from below."""
    more = {"heat.shaft_heat": "200 W", "heat.housing_ambient": "10 W/K"}
    found = warm(load_static(ROLLERS, overrides=more))
    assert found.verdict == "runaway" and "the bearing cannot turn: [fit] leaves" in found.sentence
    assert 0.0 < found.last.clearance < 1e-6


def test_a_cooled_shaft_counts_what_flows_both_ways():
    """60 W out of the shaft, more than is lost: heat comes in from the housing's side."""
    found = warm(balls(heat__shaft_heat="-60 W"))
    assert found.settled and found.temperatures["inner"] < found.temperatures["outer"]
    assert found.last.losses["shaft heat"] == -60.0
    assert sum(found.last.out.values()) == pytest.approx(found.last.loss, abs=1.3)


def test_losses_of_runs_settle_as_the_static_ones(caplog):
    """Short runs of the same case without a cage, whose warnings are said once."""
    values = {"heat.losses": "run", "solver.duration": "2 ms", "heat.tolerance": "2 K"}
    with caplog.at_level("WARNING"):
        found = warm(load_case(BALLS, overrides=values))
    static = warm(balls())
    assert found.settled
    assert found.temperatures["inner"] == pytest.approx(static.temperatures["inner"], abs=3.0)
    assert found.last.losses["inner race"] == pytest.approx(
        static.last.losses["inner race"], rel=0.1
    )
    short = [text for text in caplog.messages if "The run is short" in text]
    assert len(short) == 1 and any("The run is short" in w for w in found.solution.warnings)
    assert not any("pockets and lands are left out" in note for note in found.notes)


def test_it_says_when_it_has_not_settled():
    found = warm(balls(heat__iterations=2, heat__tolerance="0.001 K"))
    assert found.verdict == "not settled" and "Not settled after 2 iterations" in found.sentence


def test_what_is_lacking_is_one_sentence():
    bare = BALLS.partition("[life]")[0]
    with pytest.raises(InputError, match="give life.viscosity_40, life.viscosity_100"):
        warm(load_static(bare))
    with pytest.raises(InputError, match="heat.losses is 'run', which needs a case that can be"):
        warm(balls(heat__losses="run"))


def test_a_cage_beyond_its_service_is_told():
    """A crown of polyamide at a million dn, which no modulus is known for there, and which ages."""
    oil = {"life.viscosity_40": "68 mm^2/s", "life.viscosity_100": "8.7 mm^2/s",
           "life.temperature": "90 degC"}  # fmt: skip
    found = warm(load_case(CROWN, overrides=oil))
    notes = " ".join(found.notes)
    assert found.temperatures["cage"] > 393.15
    assert "where cages of PA66-GF25 conditioned are used up to 120 degC" in notes
    assert "the cage keeps its modulus" in notes and found.case.cage.temperature is None


def test_the_record_has_every_iteration(settled, tmp_path):
    paths = {p.name: p for p in write_warmth(settled, tmp_path)}
    assert set(paths) == {"warm.txt", "warm.json", "warm.csv", "case.toml", "warm.png"}
    stored = json.loads(paths["warm.json"].read_text())
    assert stored["verdict"] == "settled" and len(stored["iterations"]) == len(settled.iterations)
    assert stored["torque"] * stored["speed"] == pytest.approx(settled.last.power)
    rows = list(csv.DictReader(paths["warm.csv"].open()))
    assert float(rows[-1]["inner_degC"]) + 273.15 == pytest.approx(
        settled.temperatures["inner"], abs=1e-3
    )
    assert load_static(paths["case.toml"]).mounted.bearing == settled.case.mounted.bearing
    assert settled.sentence.split(":")[0] in " ".join(paths["warm.txt"].read_text().split())


def test_the_command_writes_a_case_that_runs(tmp_path, capsys):
    source, out = tmp_path / "case.toml", tmp_path / "out"
    source.write_text(BALLS, encoding="utf-8")
    assert main(["warm", str(source), "-o", str(out)]) == 0
    said = capsys.readouterr().out
    assert "Settled after" in said and "inner race" in said and "housing to ambient" in said
    again = load_case(out / "case.toml")
    table = tomllib.loads((out / "case.toml").read_text())
    assert again.fit.inner_temperature > again.fit.outer_temperature
    assert table["lubricant"]["viscosity"].endswith("Pa*s")
    assert main(["warm", str(source), "-o", str(out)]) == 2
    assert "exists already" in capsys.readouterr().err
    assert main(["warm", str(source), "-o", str(out), "--force"]) == 0


def test_the_command_ends_a_runaway_with_code_0(tmp_path, capsys):
    source, out = tmp_path / "case.toml", tmp_path / "out"
    source.write_text(BALLS, encoding="utf-8")
    hot = ["--set", "heat.housing_ambient=0.01 W/K", "--set", "heat.shaft_ambient=0.01 W/K"]
    assert main(["warm", str(source), "-o", str(out), *hot]) == 0
    assert "Runaway" in capsys.readouterr().out
    assert json.loads((out / "warm.json").read_text())["verdict"] == "runaway"
    assert not (out / "case.toml").exists()
    assert main(["warm", str(source), "--set", "heat.iterations=1"]) == 1
    assert main(["warm", str(source), "--set", "heat.housing_ambint=1 W/K"]) == 2
    assert "the nearest known one is 'housing_ambient'" in capsys.readouterr().err
