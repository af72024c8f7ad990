"""The example with a spall: its balls strike it as often as its cage takes them past."""

from pathlib import Path

import numpy as np
import pytest

from flexcage.case import load_case
from flexcage.results.metrics import settled
from flexcage.results.spectra import SIGNALS, amplitude_spectrum
from flexcage.simulate import simulate

CASE = Path(__file__).parents[2] / "examples" / "6205_spall.toml"


@pytest.mark.slow
def test_the_envelope_s_strongest_line_is_nine_times_the_cage_s_speed():
    run = simulate(load_case(CASE, overrides={"mesh.fineness": "coarse"}), stress=False)
    ds = settled(run.dataset, 0.2)
    spectrum = amplitude_spectrum(SIGNALS["outer_envelope"].of(ds).sel(axis2="y"))
    line = float(spectrum.sel(frequency=slice(20.0, 2000.0)).idxmax("frequency"))
    cage = float(ds["cage_omega"].sel(axis="x").mean()) / (2.0 * np.pi)
    assert 9.0 * cage == pytest.approx(353.2, abs=1.0)
    assert line == pytest.approx(9.0 * cage, abs=float(np.diff(spectrum["frequency"][:2])[0]))
