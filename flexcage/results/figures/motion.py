"""Figures of the cage's motion: whirl, the speed of its centre, tilt."""

from __future__ import annotations

from flexcage.results.features import OrbitClass, orbit_class
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.results.metrics import velocity_deviation

LOW_PASS = 2e3  # Hz, of the second deviation of the cage centre's speed


def _classed(found: OrbitClass | None) -> Found | None:
    if found is None:
        return None
    note = (
        f"spread {found.spread:.2g}, pace {found.pace:.2g}, ripple {found.ripple:.2g}, order "
        f"{found.order:.2g}; own rule"
    )
    return Found(found.kind, note)


# fmt: off
MOTION = FigureTable[SettledRun]("Cage motion", "a cage")
MOTION.add("whirl_radius", "Whirl radius, mean", "um",
           "distance of the centre from its mean place",
           "statistic", "large", "settling", "convergence",
           take=lambda part: Found(part.whole_windows.mean(part.about_mean.radius),
                                   "about the orbit's mean"))
MOTION.add("whirl_radius_max", "Whirl radius, largest", "um", "largest such distance",
           take=lambda part: part.about_mean.largest)
MOTION.add("whirl_ratio", "Whirl (max - min)/mean", "", "spread of that distance over its mean",
           take=lambda part: part.about_mean.ratio)
MOTION.add("whirl_radius_axis", "Whirl about axis, mean", "um",
           "distance of the centre from the ring's axis", "statistic", "brief",
           take=lambda part: Found(part.whole_windows.mean(part.about_axis.radius),
                                   "the ring's axis"))
MOTION.add("whirl_ratio_axis", "Whirl about axis (max - min)/mean", "",
           "spread of that distance over its mean", take=lambda part: part.about_axis.ratio)
MOTION.add("whirl_speed_ratio", "Whirl speed / cage speed", "",
           "net turns of the centre about the ring's axis over the cage's, over whole turns",
           "signed",
           take=lambda part: Found(
               part.about_axis.speed_ratio,
               f"net turns about the ring's axis over the cage's, at {part.rate}"))
MOTION.add("velocity_deviation", "Centre's speed, ripple", "%",
           "standard deviation over mean of the centre's speed, at the samples",
           take=lambda part: Found(velocity_deviation(part.ds),
                                   f"standard deviation over mean, at {part.rate}, no filter"))
MOTION.add("velocity_deviation_2khz", "Centre's speed, slow ripple", "%",
           "the same, low-passed at 2 kHz",
           take=lambda part: Found(velocity_deviation(part.ds, low_pass=LOW_PASS),
                                   f"the same, low-passed at {LOW_PASS / 1000.0:g} kHz"))
MOTION.add("cage_motion", "Cage's motion, class", "",
           "stable, circling or unstable, by a rule of flexcage's own (results.features)", "text",
           take=lambda part: _classed(orbit_class(part.ds)))
MOTION.add("tilt_mean", "Cage tilt, mean", "deg",
           "angle between the cage's axis and the bearing's", "statistic",
           take=lambda part: part.windows.mean(part.tilt))
MOTION.add("tilt_max", "Cage tilt, largest", "deg", "largest such angle",
           take=lambda part: float(part.tilt.max()))
