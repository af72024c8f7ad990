"""[[sensors]] of a case: read as any section, and refused in one sentence."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from flexcage.case import load_case, load_static
from flexcage.cli import main
from flexcage.core.errors import InputError

EXAMPLE = Path(__file__).parents[2] / "examples" / "6205_spall.toml"
ACCELEROMETER = {
    "type": "accelerometer", "name": "casing", "rate": "50 kHz", "low_pass": "10 kHz",
    "noise": "0.003 m/s^2/Hz^0.5", "range": "2000 m/s^2", "bits": 16,
}  # fmt: skip


def sensed(*sensors, **changes):
    table = tomllib.loads(EXAMPLE.read_text("utf-8"))
    table["sensors"] = [*sensors] or [
        ACCELEROMETER, {"type": "proximity", "name": "probe", "range": "200 um"},
        {"type": "laser", "name": "laser"}, {"type": "tacho", "name": "key"},
    ]  # fmt: skip
    return load_case(table, overrides=changes)


def test_a_case_keeps_its_sensors_and_counts_them():
    case = sensed()
    assert case.sensors[0].rate == 50e3 and case.sensors[1].range == 200e-6
    assert load_case(case.to_toml()) == case and load_case(case.to_toml()).hash == case.hash
    assert case.replace("sensors.0.seed", 1).hash != case.hash
    plain = load_case(EXAMPLE)
    assert plain.sensors == () and load_case(plain.to_toml()).hash == plain.hash
    assert case.replace(sensors=()).hash == plain.hash


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"sensors.0.rate": "15 kHz"}, "is 15 kHz, which must be more than twice its band"),
        ({"sensors.0.rate": "400 kHz"}, "records what it sees at 200 kHz; raise output.vibration_"),
        ({"sensors.1.rate": "60 kHz"}, "records what it sees at 50 kHz; raise output.rate"),
        ({"sensors.0.rate": "33.333337 kHz"}, "no simple ratio"),
        ({"sensors.0.place": "shaft"}, "take 'inner_ring'"),
        ({"sensors.0.place": "housing node 3"}, "take 'housing' with a node of mount.body"),
        ({"sensors.0.place": "housing"}, "on a node of the housing, but the case has none"),
        ({"sensors.1.place": "cagee"}, "the nearest known one is 'cage'"),
        ({"sensors.0.axial": True}, "recorded across it; give a direction"),
        ({"sensors.0.range": "0 m/s^2"}, "bits is 16, but the range.*give sensors.0.range"),
        ({"sensors.3.bits": 3}, "a tacho's pulses pass no filter"),
        ({"sensors.2.plane": "20 mm"}, "plane is 20 mm, but the cage ends at 3.85 mm"),
        ({"sensors.1.name": "casing"}, "as that of sensors.0"),
        ({"sensors.1.name": "a b"}, "should be a word"),
        ({"sensors.1.name": "time"}, "does not begin with 'time'"),
        ({"sensors.0.resonance": "120 kHz"}, "shows less than half of that"),
        ({"sensors.0.high_pass": "11 kHz"}, "but must rise"),
        ({"sensors.0.nois": "3"}, "the nearest known one is 'noise'"),
        ({"sensors.0.noise": "3 um/Hz^0.5"}, "of another kind than m/s"),
        ({"sensors.0.type": "accelerometr"}, "the nearest known one is 'accelerometer'"),
        ({"sensors.0.damping_ratio": 0.0}, "must be 0.0001 or more"),
        ({"cage.model": "none"}, "is on the cage, but the bearing has none"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else None,
)  # fmt: skip
def test_a_sensor_that_cannot_be_is_one_sentence(changes, words):
    with pytest.raises(InputError, match=words) as told:
        sensed(**changes)
    assert "\n" not in str(told.value)


GAUGE = {
    "type": "strain_gauge",
    "name": "g",
    "side": "-x",
    "grid": "2 mm",
    "noise": "1 um/m/Hz^0.5",
}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"cage.model": "rigid"}, "is a strain gauge, but a rigid cage has no strain"),
        ({"cage.model": "none"}, "is on the cage, but the bearing has none"),
        ({"sensors.0.crossbeam": 9}, "is 9, but the cage's crossbeams are numbered 0 to 8"),
        ({"sensors.0.along": "axial"}, "on the side '-x' lies circumferential or radial"),
        ({"sensors.0.radius": "30 mm"}, "is 30 mm, but the cage reaches from 17.465 mm"),
        ({"sensors.0.side": "top"}, "outside, inside"),
        ({"sensors.0.grid": "0 mm"}, "grid"),
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else None,
)
def test_a_gauge_that_cannot_be_is_one_sentence(changes, words):
    with pytest.raises(InputError, match=words):
        sensed(GAUGE, **{"cage.model": "flexible", **changes})


def test_a_gauge_keeps_its_place():
    case = sensed({**GAUGE, "crossbeam": 0}, **{"cage.model": "flexible"})
    (gauge,) = load_case(case.to_toml()).sensors
    assert (gauge.crossbeam, gauge.side, gauge.grid, gauge.noise) == (0, "-x", 2e-3, 1e-6)
    assert gauge.towards == "circumferential" and gauge.unit == "1"


def test_a_sensor_without_a_name_is_told_so():
    with pytest.raises(InputError, match=r"\[sensors.0\] lacks 'name'"):
        sensed({"type": "tacho"})


def test_a_static_solution_leaves_sensors_alone(tmp_path):
    text = EXAMPLE.read_text("utf-8") + '\n[[sensors]]\ntype = "tacho"\nname = "key"\n'
    path = tmp_path / "case.toml"
    path.write_text(text)
    assert load_static(path).speed == pytest.approx(628.3, abs=0.1)


def test_keys_of_sensors_are_listed(capsys):
    assert main(["keys", "sensors"]) == 0
    shown = capsys.readouterr().out
    assert '[[sensors]], type = "accelerometer"' in shown and "anti_alias" in shown
    assert "m/s^2/Hz^0.5" in shown
