"""Strain gauges on the cage of a run: against the whole mesh's displacement and stress there."""

from __future__ import annotations

import numpy as np
import pytest
from simulate_cases import n1013

from flexcage import load_run, simulate
from flexcage.core.errors import InputError
from flexcage.stress.gauge_lines import gauge_line

GAUGES = [
    {"type": "strain_gauge", "name": "beam", "crossbeam": 0, "along": "axial", "grid": "2 mm"},
    {"type": "strain_gauge", "name": "rim", "azimuth": "0 deg", "plane": "7.5 mm", "grid": "2 mm"},
    {"type": "strain_gauge", "name": "end", "side": "+x", "crossbeam": 3, "rate": "25 kHz",
     "noise": "0.01 um/m/Hz^0.5", "range": "500 um/m", "bits": 16},
]  # fmt: skip


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    folder = tmp_path_factory.mktemp("gauges") / "run"
    case = n1013({"output.settle": 0.0}, sensors=GAUGES, solver={"duration": "1.5 ms"})
    return simulate(case, out=folder), folder


def test_gauges_read_the_displacement_of_the_whole_mesh(stored):
    """At samples, by the mode acceleration of ``run.stress``: another way, node by node."""
    run, _ = stored
    model, cage = run.recovery.model, run.case.its_cage
    for sensor in run.case.sensors[:2]:
        row = gauge_line(model, sensor, run.mesh.pocket_count, cage.mean_radius).row(model)
        signal = run.signals[sensor.name]
        t = signal[signal.dims[0]].values
        for k in (20, 41, 60):
            moved = run.recovery.displacement(loads_at(run, k))
            expected = row @ moved.ravel()
            assert float(signal[k]) == pytest.approx(expected, abs=1e-5 * float(abs(signal).max()))
            assert t[k] == pytest.approx(run.dataset["time"].values[k], abs=1e-12)


def loads_at(run, k):
    from flexcage.stress.loads import cage_loads

    return cage_loads(run.dataset, k, inner=run.case.its_cage.land_ring == "inner")


def test_a_chain_and_a_folder_are_as_of_other_sensors(stored):
    run, folder = stored
    end = run.signals["end"]
    assert end.attrs["units"] == "1" and end.attrs["quantity"] == "strain"
    assert (end.attrs["direction"], end.attrs["place"], end.attrs["rate"]) == (
        "circumferential", "cage", 25e3
    )  # fmt: skip
    step = 2.0 * 500e-6 / 2**16
    np.testing.assert_allclose(end.values / step, np.round(end.values / step), atol=1e-6)
    assert run.summary["sensor_beam_rms"] > 0.0
    again = load_run(folder).signals["beam"]
    np.testing.assert_allclose(again, run.signals["beam"], rtol=1e-3, atol=1e-10)


def test_a_gauge_over_a_pocket_is_refused_before_the_run(tmp_path):
    case = n1013(sensors=[{"type": "strain_gauge", "name": "g", "azimuth": "0 deg"}])
    with pytest.raises(InputError, match="'g' .*does not lie on the cage's surface"):
        simulate(case, out=tmp_path / "r")
    assert not (tmp_path / "r" / "results.zarr").exists()
