"""What studies and maps of a data set may draw, and the labels that follow; no runs."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from study_cases import study_file

from flexcage.case import load_case
from flexcage.study.dataset import labels
from flexcage.study.maps import load_map
from flexcage.study.plan import make_plan
from flexcage.study.spec import load_study

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def drawn():
    """Cases of the example map by condition."""
    plan = make_plan(load_map(EXAMPLES / "cage_faults_study.toml").study())
    assert plan.study.keep == "runs" and len(plan.cases) == 40
    return [(p.point.labels["condition"], plan.case(p)) for p in plan.cases]


def test_every_class_of_the_example_has_its_labels(drawn):
    found = {label: (labels.fault_of(c).name, labels.cage_faults(c)) for label, c in drawn}
    assert found == {
        "sound": ("normal", "none"), "lost rivet": ("cage", "missing_rivet"),
        "two lost rivets": ("cage", "missing_rivet"), "imbalance": ("cage", "unbalance"),
        "lost rivet and spall": ("inner+cage", "missing_rivet"),
    }  # fmt: skip
    assert Counter(label for label, _ in drawn) == dict.fromkeys(found, 8)
    (mixed, *_) = (c for label, c in drawn if label == "lost rivet and spall")
    assert labels.fault_of(mixed).place == "test_bearing+test_bearing"
    rivets = {len(c.defects) for label, c in drawn if label == "two lost rivets"}
    assert rivets == {2}


def test_the_example_draws_what_it_says(drawn):
    cases = [case for _, case in drawn]
    clearance = np.array([c.bearing.radial_clearance for c in cases])
    assert clearance.min() >= 6e-6 and clearance.max() <= 14e-6 and np.ptp(clearance) > 5e-6
    noise = np.log10([c.sensors[0].noise for c in cases])
    assert noise.min() >= -3.0 and noise.max() <= -2.0 and np.ptp(noise) > 0.6
    assert {labels.speed_profile(c) for c in cases} == {"constant", "varying"}
    assert {"varying" in labels.load_words(c) for c in cases} == {True, False}
    assert all("8.25 N m" in labels.load_words(c) for c in cases)
    assert len({c.start.seed for c in cases}) == 8  # one of each sample
    assert len({c.speed for c in cases}) == 8 and len({c.bearing.ball_scatter for c in cases}) == 8
    assert len({labels.noise_of(c) for c in cases}) == 40
    assert len({labels.bearing_id(c) for c in cases}) == 40  # sizes differ, and faults


AXES = """
[[axes]]
type = "list"
name = "fault"
points = [
  { label = "outer" },
  { label = "outer and beam", "defects" = [{ type = "broken_crossbeam", crossbeam = 3 }] },
  { label = "drift", "drive.ramp_to" = "7000 rpm", "drive.ramp_time" = "0.1 ms" },
  { label = "table", "load.times" = ["0 ms", "0.1 ms"], "load.values" = ["500 N", "900 N"] },
]

[[axes]]
type = "lhs"
count = 4
seed = 3

[axes.ranges]
"bearing.outer_spall.length" = ["0.3 mm", "1.5 mm"]
"bearing.outer_spall.azimuth" = ["-20 deg", "20 deg"]
"bearing.radial_clearance" = ["20 um", "40 um"]
"drive.speed" = ["5000 rpm", "6000 rpm"]

[repeat]
count = 2
"""


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    path = study_file(tmp_path_factory.mktemp("variety"), 'keep = "runs"', AXES)
    plan = make_plan(load_study(path))
    return [(p.point.labels["fault"], p.repetition, plan.case(p)) for p in plan.cases]


def test_sizes_places_speeds_and_starts_of_a_study(table):
    assert len(table) == 32
    own = {(label, r): [c for k, s, c in table if (k, s) == (label, r)]
           for label, r, _ in table}  # fmt: skip
    sizes = [labels.fault_of(c).size for c in own["outer", 0]]
    assert all(0.3e-3 <= s <= 1.5e-3 for s in sizes) and np.ptp(sizes) > 0.6e-3
    azimuth = np.degrees([c.bearing.outer_spall.azimuth for c in own["outer", 0]])
    assert azimuth.min() < 0.0 < azimuth.max() and np.abs(azimuth).max() <= 20.0
    assert len({c.bearing.radial_clearance for c in own["outer", 0]}) == 4
    grades = {labels.level_of(labels.fault_of(c), (0.6e-3, 1.0e-3)) for c in own["outer", 0]}
    assert len(grades) >= 2 and 0 not in grades
    assert {labels.fault_of(c).name for c in own["outer and beam", 0]} == {"outer+cage"}
    assert {labels.speed_profile(c) for c in own["drift", 0]} == {"increasing"}
    assert all("varying" in labels.load_words(c) for c in own["table", 1])
    first, again = own["outer", 0][0], own["outer", 1][0]
    assert first.start.seed != again.start.seed
    assert labels.bearing_id(first) == labels.bearing_id(again)


CAGES = {
    "window": {"bearing": {"preset": "N1013"}},
    "machined": {"bearing": {"preset": "7603025"}},
    "ribbon": {"bearing": {"preset": "15x37x10"}},
}


@pytest.mark.parametrize(
    ("cage", "defect", "size"),
    [
        ("window", {"type": "crossbeam", "crossbeam": 5, "displacement": "-0.2 mm"}, 0.2e-3),
        ("window", {"type": "side_beam", "pocket": 2, "displacement": "0.1 mm"}, 0.1e-3),
        ("window", {"type": "broken_crossbeam", "crossbeam": 5}, 3.85e-3),  # the wall
        ("machined", {"type": "enlarged", "pocket": 1, "increase": "0.15 mm"}, 0.15e-3),
        ("machined", {"type": "crack", "web": 1, "share": 0.4}, None),
        ("ribbon", {"type": "missing_rivet", "web": 2}, 1.2e-3),  # the rivet
        ("crown", {"type": "worn_pocket", "pocket": 0, "depth": "50 um"}, 50e-6),
        ("crown", {"type": "cracked_claw", "pocket": 0, "claw": "front", "share": 0.5}, 1.785e-3),
        ("crown", {"type": "missing_claw", "pocket": 0, "claw": "rear"}, 0.0),
    ],
)
def test_faults_of_every_cage_have_a_name_and_a_size(cage, defect, size):
    if cage == "crown":
        from tomllib import loads

        base = loads((EXAMPLES / "6205_signals.toml").read_text("utf-8"))
        base["bearing"].pop("outer_spall")
    else:
        base = CAGES[cage]
    case = load_case({**base, "defects": [defect]})
    fault = labels.fault_of(case)
    wanted = 0.4 * case.its_cage.width if size is None else size
    assert fault.kinds == ("cage",) and fault.size == pytest.approx(wanted, rel=1e-6)
    assert labels.cage_faults(case) == defect["type"]
    both = load_case({**base, "defects": [defect]}, overrides={"cage.unbalance": "0.1 g*mm"})
    assert labels.cage_faults(both) == f"{defect['type']}+unbalance"


@pytest.mark.parametrize(
    ("sensor", "wanted"),
    [
        ({"type": "strain_gauge", "name": "a", "side": "-x"},
         ("unknown", "unknown", "tangential", "none")),
        ({"type": "accelerometer", "name": "a", "direction": "90 deg"},
         ("acceleration", "m/s^2", "z", "outer_ring")),
    ],
)  # fmt: skip
def test_signals_have_words_of_the_schema(sensor, wanted):
    """The schema has none for strain."""
    from types import SimpleNamespace

    from flexcage.study.dataset.recording import channel_row

    case = load_case({"bearing": {"preset": "N1013"}, "sensors": [sensor]})
    (own,) = case.sensors
    attrs = {"rate": 1.0, "quantity": own.quantity, "units": own.unit, "place": own.place,
             "direction": own.towards}  # fmt: skip
    row = channel_row(case, own.name, SimpleNamespace(attrs=attrs, size=3), "f", 0)
    assert tuple(row[k] for k in ("quantity", "unit", "axis", "sensor_mounting")) == wanted
    schema = pytest.importorskip("bearing_datasets.schema")
    units = pytest.importorskip("bearing_datasets.units")
    assert row["quantity"] in schema.QUANTITIES
    assert row["unit"] in units.allowed_units(row["quantity"])
    assert row["axis"] in schema.VOCABULARIES["axis"]
