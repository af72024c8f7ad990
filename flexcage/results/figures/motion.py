"""Figures of the cage's motion: whirl, the speed of its centre, tilt."""

from __future__ import annotations

from flexcage.results import metrics
from flexcage.results.figures.figure import (
    BRIEF,
    CAGED,
    CONVERGENCE,
    LARGE,
    SETTLING,
    SIGNED,
    STATISTIC,
    Found,
    Table,
)
from flexcage.results.figures.part import Part

LOW_PASS = 2e3  # Hz, of the second deviation of the cage centre's speed

MOTION = Table[Part]("Cage motion", needs=CAGED)


@MOTION.figure(
    "Whirl radius, mean", "um", "distance of the centre from its mean place",
    STATISTIC, LARGE, SETTLING, CONVERGENCE,
)  # fmt: skip
def whirl_radius(part: Part) -> Found:
    return Found(part.whole_windows.mean(part.about_mean.radius), "about the orbit's mean")


@MOTION.figure("Whirl radius, largest", "um", "largest such distance")
def whirl_radius_max(part: Part) -> float:
    return part.about_mean.largest


@MOTION.figure("Whirl (max - min)/mean", "", "spread of that distance over its mean")
def whirl_ratio(part: Part) -> float:
    return part.about_mean.ratio


@MOTION.figure(
    "Whirl about axis, mean", "um", "distance of the centre from the ring's axis", STATISTIC, BRIEF
)
def whirl_radius_axis(part: Part) -> Found:
    return Found(part.whole_windows.mean(part.about_axis.radius), "the ring's axis")


@MOTION.figure("Whirl about axis (max - min)/mean", "", "spread of that distance over its mean")
def whirl_ratio_axis(part: Part) -> float:
    return part.about_axis.ratio


@MOTION.figure(
    "Whirl speed / cage speed", "",
    "net turns of the centre about the ring's axis over the cage's, over whole turns", SIGNED,
)  # fmt: skip
def whirl_speed_ratio(part: Part) -> Found:
    note = f"net turns about the ring's axis over the cage's, at {part.rate}"
    return Found(part.about_axis.speed_ratio, note)


@MOTION.figure(
    "Centre's speed, ripple", "%",
    "standard deviation over mean of the centre's speed, at the samples",
)  # fmt: skip
def velocity_deviation(part: Part) -> Found:
    note = f"standard deviation over mean, at {part.rate}, no filter"
    return Found(metrics.velocity_deviation(part.ds), note)


@MOTION.figure("Centre's speed, slow ripple", "%", "the same, low-passed at 2 kHz")
def velocity_deviation_2khz(part: Part) -> Found:
    value = metrics.velocity_deviation(part.ds, low_pass=LOW_PASS)
    return Found(value, f"the same, low-passed at {LOW_PASS / 1000.0:g} kHz")


@MOTION.figure(
    "Cage tilt, mean", "deg", "angle between the cage's axis and the bearing's", STATISTIC
)
def tilt_mean(part: Part) -> Found:
    return Found(part.windows.mean(part.lean))


@MOTION.figure("Cage tilt, largest", "deg", "largest such angle")
def tilt_max(part: Part) -> float:
    return float(part.lean.max())
