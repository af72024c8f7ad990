"""A spall of a race in a running bearing: how often rollers fall into it, and how far."""

from __future__ import annotations

import numpy as np
import pytest
from simulate_cases import n1013

import flexcage
from flexcage.core.errors import InputError
from flexcage.results.metrics import settled
from flexcage.results.spectra import SIGNALS, spectral_density

RIGID = {"cage.model": "rigid"}
SPALL = {
    "bearing.outer_spall.length": "1.5 mm",
    "bearing.outer_spall.depth": "50 um",
    "mount.kind": "bushing",
    "mount.stiffness": "2e8 N/m",
    "mount.damping": "2000 N*s/m",
    "solver.duration": "60 ms",
    "output.settle": 0.33,
}


@pytest.fixture(scope="module")
def spalled():
    return flexcage.simulate(n1013(RIGID, SPALL))


def test_rollers_strike_a_spall_of_the_outer_race_at_its_frequency(spalled):
    """Z times the cage's own speed, by the strongest line of the squared acceleration."""
    ds = settled(spalled.dataset, 0.33)
    power = ds["outer_acceleration_filtered"].sel(axis2="y").values ** 2
    step = float(np.diff(ds["time_hf"].values[:2])[0])
    span = len(power) * step
    lines = np.abs(np.fft.rfft((power - power.mean()) * np.hanning(len(power)), 8 * len(power)))
    frequency = np.fft.rfftfreq(8 * len(power), step)
    near = (frequency > 300.0) & (frequency < 1500.0)
    found = frequency[near][np.argmax(lines[near])]
    cage = float(ds["cage_omega"].sel(axis="x").mean()) / (2.0 * np.pi)
    assert found == pytest.approx(22 * cage, abs=0.25 / span)


def test_the_envelope_has_the_line_of_a_spall(spalled):
    """At BPFO it stands an order of magnitude above what is around it; without a spall it is not
    there."""
    sound = flexcage.simulate(n1013(RIGID, {k: v for k, v in SPALL.items() if "spall" not in k}))

    def line(run):
        ds = settled(run.dataset, 0.33)
        cage = float(ds["cage_omega"].sel(axis="x").mean()) / (2.0 * np.pi)
        density = spectral_density(SIGNALS["outer_envelope"].of(ds).sel(axis2="y"))
        near = density.sel(frequency=slice(700.0, 1300.0))
        at = float(near.idxmax("frequency"))
        return at / (22 * cage), float(near.max() / near.median())

    at, above = line(spalled)
    assert at == pytest.approx(1.0, abs=0.03) and above > 30.0
    assert line(sound)[1] < 0.3 * above


def test_roller_over_a_spall_bears_nothing_and_its_neighbours_take_over(spalled):
    """1.5 mm let a roller of 8 mm down by 32 um, more than the most loaded one is pressed in."""
    ds = spalled.dataset
    azimuth = np.angle(np.exp(1j * ds["element_position"].sel(cyl="psi").values))
    outer = ds["race_force"].sel(race="outer").values
    over = np.abs(azimuth) * 45.26e-3 < 0.2e-3
    beside = (np.abs(azimuth) * 45.26e-3 > 2e-3) & (np.abs(azimuth) < 0.14)
    assert over.sum() > 50 and np.mean(outer[over] == 0.0) > 0.9
    assert np.mean(outer[beside]) > 200.0
    assert spalled.summary.row("energy_audit").value == "passed"


def test_spalls_that_cannot_be_are_refused():
    for changes, words in (
        ({"length": "14 mm"}, "another race"),
        ({"length": "1 mm", "depth": "2 mm"}, "a tenth of the roller's diameter"),
        ({"length": "1 mm", "width": "1 mm", "offset": "5 mm"}, "where no roller runs"),
    ):
        with pytest.raises(InputError, match=words):
            n1013(RIGID, {f"bearing.outer_spall.{k}": v for k, v in changes.items()})
