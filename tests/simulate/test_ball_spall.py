"""Spalls and waves of the races of a running ball bearing: how often balls fall in, what the outer
ring's envelope has of it, and by which method."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import flexcage
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.results.metrics import settled
from flexcage.results.slip import BearingNumbers
from flexcage.results.spectra import SIGNALS, own_frequencies

CASE = Path(__file__).parents[2] / "examples" / "6205_spall.toml"
RIGID = {"cage.model": "rigid", "mesh.fineness": "coarse"}
NO_SPALL = {"bearing.outer_spall.length": "0 mm"}


def run_of(*tables):
    return flexcage.simulate(
        load_case(CASE, overrides={k: v for t in (RIGID, *tables) for k, v in t.items()}),
        stress=False,
    )


def envelope_lines(run, settle=0.2):
    """Frequencies [Hz], amplitudes of the outer ring's envelope, a bin [Hz], and the run's own
    frequencies."""
    ds = settled(run.dataset, settle)
    series = SIGNALS["outer_envelope"].of(ds).sel(axis2="y")
    values, step = series.values, float(np.diff(series["time_hf"].values[:2])[0])
    amplitude = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(len(values)),
                                   8 * len(values)))  # fmt: skip
    frequency = np.fft.rfftfreq(8 * len(values), step)
    own = own_frequencies(ds, BearingNumbers.of(run.case.bearing))
    return frequency, amplitude, 1.0 / (len(values) * step), own


def strongest(frequency, amplitude, low, high):
    near = (frequency > low) & (frequency < high)
    best = np.argmax(amplitude[near])
    return frequency[near][best], amplitude[near][best]


@pytest.fixture(scope="module")
def spalled():
    return run_of({"solver.duration": "40 ms"})


def test_balls_strike_a_spall_of_the_outer_race_at_its_frequency(spalled):
    frequency, amplitude, resolution, own = envelope_lines(spalled)
    found, height = strongest(frequency, amplitude, 200.0, 520.0)
    assert found == pytest.approx(own["BPFO"], abs=0.5 * resolution)
    assert own["BPFO"] == pytest.approx(353.2, rel=0.01)  # a half of 9 x 100 Hz (1 - 7.938/38.5)
    second, also = strongest(frequency, amplitude, 1.7 * own["BPFO"], 2.3 * own["BPFO"])
    assert second == pytest.approx(2.0 * own["BPFO"], abs=0.5 * resolution) and also > 0.3 * height


def test_the_summary_says_which_line_stands_out(spalled):
    """By its own speeds, a few percent below those without slip."""
    found = spalled.summary
    nominal = 0.5 * 9 * 100.0 * (1 - 7.938 / 38.5)
    assert found["nominal_bpfo"] == pytest.approx(nominal, rel=1e-6)
    assert found["frequency_bpfo"] == pytest.approx(nominal, rel=0.02)
    assert found["envelope_bpfo"] > 3.0 * found["envelope_floor"]
    assert found["envelope_bpfo_multiples"] > 1.3 * max(
        found["envelope_bpfi_multiples"], found["envelope_bsf_twice_multiples"]
    )


def test_a_ball_over_the_spall_bears_little_and_energy_balances(spalled):
    """1 mm lets a ball of 7.938 mm down by 26 um, about as far as 1000 N press it in."""
    ds, race = spalled.dataset, 23.2e-3
    off = np.angle(np.exp(1j * ds["element_position"].sel(cyl="psi").values)) * race
    outer = ds["race_force"].sel(race="outer").values
    over, beside = np.abs(off) < 0.15e-3, (np.abs(off) > 2e-3) & (np.abs(off) < 4e-3)
    assert over.sum() > 20 and outer[over].min() < 1.0
    assert np.mean(outer[beside]) > 300.0 and np.mean(outer[over]) < 0.5 * np.mean(outer[beside])
    assert spalled.summary.row("energy_audit").value == "passed"


def test_spalls_that_cannot_be_are_refused():
    for changes, words in (
        ({"length": "17 mm"}, "another race"),
        ({"depth": "5 mm"}, "a tenth of the ball's diameter"),
        ({"width": "1 mm", "offset": "5 mm"}, "where no ball runs"),
        ({"width": "9 mm"}, "wider than the race, 6.14"),
    ):
        with pytest.raises(InputError, match=words):
            load_case(CASE, overrides={f"bearing.outer_spall.{k}": v for k, v in changes.items()})


@pytest.mark.slow
def test_a_spall_beside_the_path_is_not_met():
    """Balls under radial load alone run at the groove's bottom, 2 mm from it, as without it until
    rounding parts the runs; one narrower than the ellipse is met, but balls stand on its sides."""

    def at(width, offset):
        spall = {"width": width, "offset": offset}
        spall = {f"bearing.outer_spall.{k}": v for k, v in spall.items()}
        return run_of(spall, {"solver.duration": "10 ms"}).dataset["race_force"].values

    without = run_of(NO_SPALL, {"solver.duration": "10 ms"}).dataset["race_force"].values
    aside, narrow, wide = at("1 mm", "2 mm"), at("0.2 mm", "0 mm"), at("3 mm", "0 mm")
    one_pass = slice(0, 140)  # 2.8 ms, in which one ball comes by
    np.testing.assert_allclose(aside[one_pass], without[one_pass], atol=0.01)
    loaded = without[..., 1] > 300.0
    assert narrow[..., 1][loaded].min() > 100.0
    assert wide[..., 1][loaded].min() < 1.0  # N: it all but lets go, as its edge is felt over 2 b


@pytest.mark.slow
def test_a_spall_of_the_inner_race_has_sidebands_at_the_shaft_s_speed():
    """It passes through the loaded zone once a turn."""
    inner = {"bearing.inner_spall.length": "1 mm", "bearing.inner_spall.depth": "50 um"}
    frequency, amplitude, resolution, own = envelope_lines(
        run_of(NO_SPALL, inner, {"solver.duration": "150 ms"})
    )
    found, _ = strongest(frequency, amplitude, own["BPFI"] - 40.0, own["BPFI"] + 40.0)
    assert found == pytest.approx(own["BPFI"], abs=resolution)
    floor = np.median(amplitude[(frequency > 300.0) & (frequency < 800.0)])
    for side in (-1.0, 1.0):
        middle = own["BPFI"] + side * own["shaft"]
        found, height = strongest(frequency, amplitude, middle - 40.0, middle + 40.0)
        assert found == pytest.approx(middle, abs=resolution) and height > 5.0 * floor


@pytest.mark.slow
@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_both_methods_pass_the_edges_and_agree(method, spalled):
    run = run_of({"solver.duration": "40 ms", "solver.method": method})
    mean, other = (r.dataset["race_force"].mean("time").values for r in (run, spalled))
    np.testing.assert_allclose(mean, other, atol=0.03 * other.max())
    assert run.summary.row("energy_audit").value == "passed"


@pytest.mark.slow
@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_waves_shake_the_bearing_in_proportion(ring):
    """Waves as many as balls move the ring at the passing frequency, twice as high twice as far."""
    swings = []
    for amplitude in (0.0, 0.2, 0.4):
        waves = {f"bearing.{ring}_waviness": f"{amplitude} um",
                 f"bearing.{ring}_waviness_order": 9}  # fmt: skip
        run = run_of(NO_SPALL, waves, {"load.radial": "0 N", "load.axial": "300 N",
                                       "solver.duration": "40 ms"})  # fmt: skip
        ds = settled(run.dataset, 0.3)
        x = ds["inner_position"].sel(axis="x").values
        own = own_frequencies(ds, BearingNumbers.of(run.case.bearing))
        t, name = ds["time"].values, "BPFO" if ring == "outer" else "BPFI"
        window = np.hanning(len(t))
        line = np.exp(-2j * np.pi * own[name] * t) * window
        swings.append(2.0 * abs(np.sum((x - x.mean()) * line)) / window.sum())
    assert swings[1] > 10.0 * swings[0]
    assert swings[2] == pytest.approx(2.0 * swings[1], rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "line", "nominal"),
    [
        ({"bearing.inner_spall.length": "1.5 mm"}, "bpfi", 450.0 * (1 + 7.938 / 38.5)),
        ({"bearing.ball_spot.size": "1.5 mm"}, "bsf_twice",
         100.0 * 38.5 / 7.938 * (1 - (7.938 / 38.5) ** 2)),
    ],
    ids=["inner race", "ball"],
)  # fmt: skip
def test_the_summary_tells_inner_race_and_ball(fault, line, nominal):
    """Of a ring in a heavy housing. Sidebands of BPFI, 100 Hz apart, come near BPFO and 2 BSF, so
    that the multiples tell more than the line alone."""
    signals = CASE.with_name("6205_signals.toml")
    healthy = {"bearing.outer_spall.length": "0 mm", "solver.duration": "200 ms"}
    found = flexcage.simulate(load_case(signals, overrides={**healthy, **fault}), stress=False)
    summary = found.summary
    assert summary[f"nominal_{line}"] == pytest.approx(nominal, rel=1e-6)
    assert summary[f"frequency_{line}"] == pytest.approx(nominal, rel=0.015)
    assert summary[f"envelope_{line}"] > 15.0 * summary["envelope_floor"]
    for other in {"bpfo", "bpfi", "bsf_twice"} - {line}:
        own, its = (summary[f"envelope_{name}_multiples"] for name in (line, other))
        assert own > 1.1 * its, other
