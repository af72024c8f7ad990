"""Files of signals, each read back by the reader that people have for it."""

from __future__ import annotations

import json
import sys
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.io
from scipy.io import wavfile

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.results.signals.files import write_signals
from flexcage.results.signals.signals import signals_of
from flexcage.spec import Accelerometer, Proximity

CAGE = SimpleNamespace(outside_diameter=89.3e-3, width=17e-3)


@pytest.fixture
def one_rate(known_run):
    sensors = (
        Accelerometer(name="casing", rate=48e3, noise=0.01, direction=np.pi / 2),
        Proximity(name="cage_y", place="cage", rate=48e3),
    )
    return signals_of(known_run, sensors, cage=CAGE, attrs={"case": "known", "BPFO (Hz)": 973.47})


@pytest.fixture
def two_rates(known_run):
    sensors = (Accelerometer(name="casing", noise=0.01), Proximity(name="probe", rate=5e3))
    return signals_of(known_run, sensors, cage=CAGE)


def test_csv(one_rate, tmp_path):
    (path,) = write_signals(one_rate, tmp_path / "s.csv")
    frame = pd.read_csv(path, comment="#")
    assert list(frame) == ["time (s)", "casing (m/s^2)", "cage_y (m)"]
    np.testing.assert_array_equal(frame["cage_y (m)"], one_rate["cage_y"])
    np.testing.assert_array_equal(frame["time (s)"], one_rate["time"])
    head = [line for line in path.read_text("utf-8").splitlines() if line.startswith("#")]
    assert "# BPFO (Hz): 973.47" in head
    said = json.loads(next(line for line in head if "casing" in line).partition(": ")[2])
    assert (said["units"], said["rate"], said["direction"]) == ("m/s^2", 48e3, "90")


def test_parquet(one_rate, tmp_path):
    (path,) = write_signals(one_rate, tmp_path / "s.parquet")
    frame = pd.read_parquet(path)
    np.testing.assert_array_equal(frame["casing (m/s^2)"], one_rate["casing"])
    assert frame.attrs["signals"]["casing"]["place"] == "outer_ring"
    assert frame.attrs["signals"]["cage_y"]["rate"] == 48e3
    assert frame.attrs["run"]["case"] == "known"


def test_mat_of_two_rates(two_rates, tmp_path):
    (path,) = write_signals(two_rates, tmp_path / "s.mat")
    found = scipy.io.loadmat(path, simplify_cells=True)
    np.testing.assert_array_equal(found["casing"]["data"], two_rates["casing"])
    np.testing.assert_array_equal(found["probe"]["data"], two_rates["probe"])
    assert found["probe"]["rate"] == 5e3 and found["casing"]["rate"] == 200e3
    assert found["probe"]["units"] == "m" and found["probe"]["place"] == "inner_ring"


def test_wav(one_rate, tmp_path):
    (path,) = write_signals(one_rate, tmp_path / "s.wav")
    rate, values = wavfile.read(path)
    assert rate == 48_000 and values.dtype == np.float32 and values.shape[1] == 2
    np.testing.assert_allclose(values[:, 1], one_rate["cage_y"], rtol=1e-7)
    content = path.read_bytes()
    assert len(content) == 8 + int.from_bytes(content[4:8], "little")
    at = content.index(b"ICMT")
    length = int.from_bytes(content[at + 4 : at + 8], "little")
    said = json.loads(content[at + 8 : at + 8 + length].rstrip(b"\0"))
    assert said["signals"]["cage_y"]["units"] == "m"


def test_uff(two_rates, tmp_path):
    pyuff = pytest.importorskip("pyuff")
    (path,) = write_signals(two_rates, tmp_path / "s.uff")
    casing, probe = pyuff.UFF(str(path)).read_sets()
    np.testing.assert_allclose(casing["data"], two_rates["casing"], rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(casing["x"], two_rates["casing"].time_200000Hz, rtol=1e-5, atol=1e-9)
    assert casing["type"] == 58 and casing["func_type"] == 1 and casing["id1"].strip() == "casing"
    assert casing["ordinate_spec_data_type"] == 12 and probe["ordinate_spec_data_type"] == 8
    assert casing["ordinate_axis_units_lab"].strip() == "m/s^2"
    assert casing["rsp_dir"] == 2 and casing["rsp_ent_name"].strip() == "outer_ring"
    assert probe["abscissa_inc"] == pytest.approx(1 / 5e3)


def test_without_pyuff_the_sentence_says_what_to_install(two_rates, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyuff", None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(EnvironmentLacks, match="by pyuff, which is not installed.*signals"):
        write_signals(two_rates, tmp_path / "s.uff")
    assert not list(tmp_path.iterdir())


def test_several_rates_have_a_file_each(two_rates, tmp_path):
    paths = write_signals(two_rates, tmp_path / "s.csv")
    assert [p.name for p in paths] == ["s_200000Hz.csv", "s_5000Hz.csv"]
    frame = pd.read_csv(paths[1], comment="#")
    np.testing.assert_array_equal(frame["probe (m)"], two_rates["probe"])


def test_what_cannot_be_written_is_one_sentence(one_rate, known_run, tmp_path):
    with pytest.raises(InputError, match="should end in .csv, .parquet, .mat, .wav or .uff"):
        write_signals(one_rate, tmp_path / "s.txt")
    write_signals(one_rate, tmp_path / "s.mat")
    with pytest.raises(InputError, match="exists already"):
        write_signals(one_rate, tmp_path / "s.mat")
    write_signals(one_rate, tmp_path / "s.mat", force=True)
    odd = signals_of(known_run, [Proximity(name="p", rate=12.5)] * 1, cage=CAGE)
    with pytest.raises(InputError, match="12.5 samples a second.*whole numbers"):
        write_signals(odd, tmp_path / "s.wav")
