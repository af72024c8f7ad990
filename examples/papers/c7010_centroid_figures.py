"""What one run of the 7010C's cage is, and what lasers would show of it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import flexcage
from flexcage.results import instrument, metrics

PLANE = 15e-3  # assumption: axial distance of the radial sensors, which the paper does not give
PLANES = (5e-3, 10e-3, 15e-3, 20e-3, 25e-3)  # over which it is swept
WRONG = 2e-3  # m, by which the radius that the inversion takes is made wrong


@dataclass(frozen=True)
class Found:
    """What one run's cage does, and what lasers would show of it [rad/s, m, 1]."""

    speed: float
    theory: float  # the paper's equation 18: 15 degrees at both races
    mean: float  # whirl radius about the axis
    difference: float  # largest less least of it
    ratio: float
    turns: float  # of the centre about the axis, over those of the cage
    axial: float  # range of the centre's axial motion
    tilt: float  # mean, rad
    deviation: float  # of the centre's speed over its mean, low pass 2 kHz
    raw: float  # difference at the sensors' plane
    solved: float  # difference of the centre by the paper's equation
    axial_raw: float  # share of the axial reading's variance at the cage's frequency
    axial_solved: float
    errors: tuple[float, ...]  # raw over solved, less one, for ``PLANES``
    by_radius: float  # what a radius wrong by ``WRONG`` changes in the solved difference
    beyond: float  # share of readings out of the sensors' range

    @property
    def error(self) -> float:
        """Deflection error at ``PLANE``."""
        return self.raw / self.solved - 1.0


def evaluate(run: flexcage.Run) -> Found:
    """Figures of one run, its settled part."""
    case, ds = run.case, metrics.settled(run.dataset, run.case.output.settle)
    speed, whirl = metrics.cage_speed(ds, run.numbers), metrics.whirl(ds, about="axis")
    centre, axis = instrument.of_run(ds)
    setup = instrument.LaserSetup(
        radius=0.5 * case.cage.outside_diameter, half_width=0.5 * case.cage.width, plane=PLANE,
        circle=case.cage.mean_radius, repeatability=0.02e-6, reach=3e-3,
    )  # fmt: skip
    shown = instrument.readings(centre, axis, setup, seed=1)
    full, _ = instrument.invert(shown, setup)
    solved = difference(instrument.by_tilt_angles(shown, setup))
    wrong = instrument.by_tilt_angles(shown, replace(setup, radius=setup.radius + WRONG))
    turns = abs(speed.mean) / (2.0 * np.pi)
    rate = 1.0 / float(np.median(np.diff(ds["time"].values)))
    return Found(
        speed=speed.mean,
        theory=speed.epicyclic,  # the preset's contact angle is 15 degrees
        mean=whirl.mean,
        difference=whirl.largest - whirl.smallest,
        ratio=whirl.ratio,
        turns=whirl.speed_ratio,
        axial=float(np.ptp(centre[:, 0])),
        tilt=float(metrics.tilt(ds).sel(component="total").mean()),
        deviation=metrics.velocity_deviation(ds, low_pass=2e3),
        raw=difference(shown[:, :2]),
        solved=solved,
        axial_raw=_share(shown[:, 2], turns, rate),
        axial_solved=_share(full[:, 0], turns, rate),
        errors=tuple(_error(centre, axis, replace(setup, plane=p)) for p in PLANES),
        by_radius=difference(wrong) - solved,
        beyond=float(np.isnan(shown).any(axis=1).mean()),
    )


def _error(centre: np.ndarray, axis: np.ndarray, setup: instrument.LaserSetup) -> float:
    """Deflection error that sensors at another plane have."""
    shown = instrument.readings(centre, axis, setup, seed=1)
    return difference(shown[:, :2]) / difference(instrument.by_tilt_angles(shown, setup)) - 1.0


def difference(yz: np.ndarray) -> float:
    """Largest less least distance (n, 2) from the axis."""
    return float(np.ptp(np.hypot(yz[:, 0], yz[:, 1])))


def _share(values: np.ndarray, frequency: float, rate: float) -> float:
    """Share of the variance within a tenth of a frequency."""
    power = np.abs(np.fft.rfft(values - values.mean())) ** 2
    at = np.fft.rfftfreq(len(values), 1.0 / rate)
    near = np.abs(at - frequency) <= 0.1 * frequency
    return float(power[near].sum() / power.sum()) if power.sum() > 0.0 else 0.0
