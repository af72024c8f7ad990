"""What one run of the N1013 shows: the numbers that the paper's figures and tables are made of.

Numbers that studies of this folder ask for. All are over the whole settled record. Pocket 5 is the
paper's j, its crossbeam 5 lies between rollers j-1 and j. Of a cage that is lost there is no number
but ``lost`` and ``away``.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import nan, pi

import numpy as np

from flexcage import register
from flexcage.results import metrics
from flexcage.results.lowpass import butterworth, low_passed_both_ways
from flexcage.results.reductions import crest_factor, kurtosis, main_line, mean_frequency
from flexcage.results.slip import cage_speed, element_slip_ratio, element_spin
from flexcage.results.statistics import element_passes

BEFORE, AT, AFTER = 4, 5, 6  # rollers j-1, j, j+1
ROLLERS = {"before": BEFORE, "at": AT, "after": AFTER}
PLACES = ("pocket4_", "pocket5_")  # corners beside the deformed beams
LOST = 0.5e-3  # m from the axis: beyond any guidance that a cage of an N1013 can have
FILTERS = {"spikes_5k": 5e3, "spikes_20k": 20e3}  # Hz, beside the 10 kHz of ``spikes``
TOO_LITTLE = 1e-9  # m or rad/s: what does not move has no spectrum
UNITS = {
    "lost": "",  # 1 where the cage's centre went further from the axis than any guidance allows
    "drifts": "",  # 1 where the whirl of the record's halves differs
    "away": "mm",  # largest distance of the cage's centre from the axis
    "cage_speed_mean": "rpm",
    "cage_slip": "%",
    "corner": "MPa",  # at corners of pockets j-1 and j: mean of the largest of every roller pass
    "corner_most": "MPa",  # largest of the record
    "stress": "MPa",  # of the whole cage off pocket walls, mean of the largest at each instant
    "reach": "um",  # radial displacement of the cage: standard deviation
    "reach_range": "um",  # largest less least
    "place": "um",  # mean
    "whirl": "um",  # distance of the centre from its mean place, mean
    "scatter": "um",  # standard deviation
    "line": "%",  # share of the variance of the centre's motion that lies in its strongest line
    "order": "",  # frequency of that line over the cage's own
    "spikes": "",  # kurtosis of the outer ring's acceleration along the load, 10 kHz
    "spikes_5k": "",
    "spikes_20k": "",
    "crest": "",
    "shake": "",  # rms of the same, in m/s^2
    "ripple": "%",  # of the cage's speed, standard deviation over mean
    "pitch": "Hz",  # mean frequency of the same
    "inner_ripple": "%",  # of the inner ring's speed
    "speed_before": "rpm",  # of roller j-1, positive as in rolling
    "speed_at": "rpm",
    "speed_after": "rpm",
    "swing_before": "%",  # standard deviation of that speed over the mean speed of all rollers
    "swing_at": "%",
    "swing_after": "%",
    "slip_before": "%",  # (theoretical less computed speed)/theoretical, mean
    "slip_at": "%",
    "slip_after": "%",
    "push_before": "N",  # of roller j-1 forwards on the crossbeam in front of it, mean
    "push_at": "N",
    "push_sound": "N",  # mean of all other rollers
    "blow": "N",  # hardest in any pocket
    "blow_here": "N",  # hardest in pockets j-1 and j
    "pinch": "N",  # force of what is squeezed when assembled
}


def evaluate(run) -> Mapping[str, float]:
    """All of ``UNITS`` of one run, in SI."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    away = float(metrics.whirl_radius(ds, about="axis").max())
    found = {"lost": float(away > LOST), "away": away, "pinch": pinch(run)}
    if away > LOST:
        return {name: found.get(name, nan) for name in UNITS}
    return {
        **found,
        **cage_motion(ds, run),
        **vibration(ds, run),
        **rollers(ds, run),
        **pushes(ds),
        **stresses(run, ds),
    }


def cage_motion(ds, run) -> dict[str, float]:
    """The cage's speed and the motion of its centre."""
    time = ds["time"].values
    step = float(np.median(np.diff(time)))
    omega = ds["cage_omega"].sel(axis="x").values
    speed = cage_speed(ds, run.numbers)
    distance, whirl = (metrics.whirl_radius(ds, about=about) for about in ("axis", "mean"))
    along = metrics.orbit(ds)
    widest = along[:, int(np.argmax(along.std(axis=0)))]  # of y and z, the one that moves more
    frequency, share = main_line(widest, step) if widest.std() > TOO_LITTLE else (nan, nan)
    inner = ds["inner_speed"].values
    return {
        "cage_speed_mean": speed.mean,
        "cage_slip": 1.0 - speed.mean / speed.epicyclic,
        "reach": float(distance.std()),
        "reach_range": float(np.ptp(distance)),
        "place": float(distance.mean()),
        "drifts": float(element_passes(ds, run.numbers).drifts(whirl)),
        "whirl": float(whirl.mean()),
        "scatter": float(whirl.std()),
        "line": share,
        "order": frequency * 2.0 * pi / abs(speed.mean),
        "ripple": float(omega.std() / abs(omega.mean())),
        "pitch": mean_frequency(omega, step),
        "inner_ripple": float(inner.std() / abs(inner.mean())),
    }


def vibration(ds, run) -> dict[str, float]:
    """The outer ring's acceleration along the load, filtered at 10 kHz and at ``FILTERS``."""
    filtered = ds["outer_acceleration_filtered"].sel(axis2="y").values.astype(float)
    raw = ds["outer_acceleration"].sel(axis2="y").values.astype(float)
    if filtered.std() == 0.0:
        return {name: nan for name in ("spikes", *FILTERS, "crest", "shake")}
    rate = run.case.output.vibration_rate
    cut = {
        name: low_passed_both_ways(butterworth(2.0 * hz / rate), raw[:, None])[:, 0]
        for name, hz in FILTERS.items() if 2.0 * hz < 0.9 * rate
    }  # fmt: skip
    return {
        "spikes": kurtosis(filtered),
        **{name: kurtosis(cut[name]) if name in cut else nan for name in FILTERS},
        "crest": crest_factor(filtered),
        "shake": float(np.sqrt(np.mean(filtered**2))),
    }


def rollers(ds, run) -> dict[str, float]:
    """Speeds and slips of rollers j-1, j and j+1."""
    spin = element_spin(ds).transpose("time", "element").values
    slip = element_slip_ratio(ds, run.numbers).transpose("time", "element").values
    typical = float(np.median(np.abs(spin).mean(axis=0)))
    found = {}
    for name, k in ROLLERS.items():
        found[f"speed_{name}"] = float(spin[:, k].mean())
        found[f"swing_{name}"] = float(spin[:, k].std()) / typical
        found[f"slip_{name}"] = float(slip[:, k].mean())
    return found


def pushes(ds) -> dict[str, float]:
    """Who drives the cage, and the hardest blows on it."""
    front = ds["pocket_force"].sel(face="front").transpose("time", "pocket").values.mean(axis=0)
    peaks = metrics.pocket_peaks(ds).values.max(axis=(0, 2))
    others = [k for k in range(len(front)) if k not in (BEFORE, AT)]
    return {
        "push_before": float(front[BEFORE]),
        "push_at": float(front[AT]),
        "push_sound": float(front[others].mean()),
        "blow": float(peaks.max()),
        "blow_here": float(peaks[[BEFORE, AT]].max()),
    }


def stresses(run, ds) -> dict[str, float]:
    """Stress at the corners of the deformed pockets, and of the whole cage; NaN of a rigid one."""
    if run.cage is None:
        return {name: nan for name in ("corner", "corner_most", "stress")}
    history = run.stress_history
    here = [k for k, name in enumerate(history.place_names) if name.startswith(PLACES)]
    corner = history.places[history.settled :, here].max(axis=1)
    return {
        "corner": float(element_passes(ds, run.numbers).peak(corner).value),
        "corner_most": float(corner.max()),
        "stress": float(history.peak[history.settled :].mean()),
    }


def pinch(run) -> float:
    """Force of rollers that a deformed pocket squeezes when assembled; 0 where it squeezes none."""
    return float(run.summary["pinch_force"]) if "pinch_force" in run.summary else 0.0


register.outputs(evaluate, UNITS)
