"""Warnings of what was found, when a run has come to its end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import cos, isfinite, sin
from typing import TYPE_CHECKING

import numpy as np

from flexcage.contacts.spec import LandSpec
from flexcage.core.units import describe
from flexcage.core.warning import RunWarning
from flexcage.geometry.bearing import Bearing, RingLand
from flexcage.geometry.cage import Cage
from flexcage.results import metrics
from flexcage.results.audit import EXCEEDED, OF_CAGE, OF_DRIVE
from flexcage.results.bootstrap import FEWEST
from flexcage.results.each_cage import cage_count, one_cage
from flexcage.results.edges import Edge
from flexcage.results.elastic import ElasticShape, grown_into_ring, large_rotation
from flexcage.results.figures.own import own_warnings
from flexcage.results.figures.speeds import NO_DRIFT
from flexcage.results.summary import Summary
from flexcage.results.warnings import has_land

if TYPE_CHECKING:
    import xarray

LEAST_TURNS = 1.0  # of the cage in the statistics: one brings every element through the load
# a cage that is thrown off: the mean distance of its centre rises through so many equal parts of
# the settled time, by so much in all, beyond so much of what its pockets leave it
_PARTS, _GROWN, _BEYOND_POCKETS = 5, 1.3, 2.0
_STRIBECK = 5.0  # ISO 76: the most loaded element has 5 times the mean of a radial load
_PASSED = 1e-6  # m by which a cage must pass a ring, more than rounding


@dataclass(frozen=True, kw_only=True)
class RunOutcome:
    """What is known of a run at its end, or as far as it came."""

    summary: Summary
    dataset: xarray.Dataset
    bearing: Bearing
    cage: Cage | None
    land: LandSpec
    duration: float  # s that it should last
    settle: float  # share of the run that statistics leave out
    edges: tuple[Edge, ...] = ()  # contact ellipses at grooves' edges
    shape: ElasticShape = ElasticShape()  # how far the cage deformed
    said: frozenset[str] = frozenset()  # keys of what was said before the run

    @property
    def element(self) -> str:
        return self.bearing.element

    @property
    def its_cage(self) -> Cage:
        """The cage, for those that look at one."""
        assert self.cage is not None
        return self.cage

    def number(self, key: str) -> float:
        """A figure of the summary, or NaN where it has none."""
        value = self.summary[key] if key in self.summary else None
        return float(value) if isinstance(value, (int, float)) else float("nan")


Check = Callable[[RunOutcome], Iterator[RunWarning]]


def _unfinished(o: RunOutcome) -> Iterator[RunWarning]:
    reached = float(o.dataset["time"][-1])
    if reached < o.duration * (1.0 - 1e-3):
        yield RunWarning(
            "unfinished",
            f"The run stopped at {reached * 1e3:.4g} ms of {o.duration * 1e3:.4g} ms; 'flexcage "
            "run --resume' continues it.",
        )


def _yield(o: RunOutcome) -> Iterator[RunWarning]:
    known = [v for v in (o.number("stress_peak"), o.number("stress_start")) if isfinite(v)]
    peak, material = max(known, default=0.0), o.its_cage.material
    if peak > material.proof_stress:
        yield RunWarning(
            "stress_above_proof",
            f"The stress reaches {peak / 1e6:.0f} MPa, more than the proof stress of "
            f"{material.name} ({material.proof_stress / 1e6:.0f} MPa): a real cage would yield "
            "there, and this one is linear elastic.",
        )


def _overloaded(o: RunOutcome) -> Iterator[RunWarning]:
    """Forces beyond what ISO 76 allows the most loaded element under the static rating: 5 C0r/(Z
    cos(alpha)) of a radial bearing, C0a/(Z sin(alpha)) of a thrust bearing; of elements of another
    material than the rings' the force that presses as hard."""
    b = o.bearing
    angle = b.nominal_contact_angle
    share = sin(angle) if b.is_thrust else cos(angle) / _STRIBECK
    allowed = b.static_rating * b.stress_share / (b.total_elements * share)
    largest = max((o.number("race_force_inner"), o.number("race_force_outer")), default=0.0)
    if largest > allowed:
        yield RunWarning(
            "overloaded",
            f"The largest force of a {o.element} on a race is {describe(largest, 'kN')}, "
            f"{largest / allowed:.2g} times what the static rating allows one "
            f"({describe(allowed, 'kN')}, ISO 76): a real race would be dented, and this one stays "
            "elastic.",
        )


def _thrown_off(o: RunOutcome) -> Iterator[RunWarning]:
    # A land ends the growth of a whirl, also of one that rotation has made larger: no later failure
    # is to be told. How far the cage swings and how hard it strikes are figures of the summary.
    if has_land(o.its_cage, o.land) or any(_stops(o)):
        return
    part = metrics.settled(o.dataset, o.settle)
    radius = metrics.whirl_radius(part, about="axis")
    if len(radius) < 2 * _PARTS:
        return
    means = np.array([values.mean() for values in np.array_split(radius, _PARTS)])
    play = 0.5 * o.its_cage.pocket_clearance(o.bearing)
    allowed = _BEYOND_POCKETS * play
    if (np.diff(means) > 0.0).all() and means[-1] > max(_GROWN * means[0], allowed):
        begin, end = (float(part["time"][k]) * 1e3 for k in (0, -1))
        yield RunWarning(
            "thrown_off",
            f"The cage is being thrown off: the distance of its centre from the axis grows "
            f"steadily, from {_um(radius[0])} at {begin:.4g} ms to {_um(radius[-1])} at "
            f"{end:.4g} ms, and its pockets have a clearance of {_um(play)} to each side. A longer "
            "run would fail; a land (cage.guidance) or spherical pockets would hold the cage.",
        )


def _stops(o: RunOutcome) -> tuple[RingLand | None, RingLand | None]:
    """Where a run computes the contact of the cage with rings that do not guide it."""
    return (None, None) if o.land.kind == "none" else o.bearing.stops(o.its_cage)


def _passes_ring(o: RunOutcome) -> Iterator[RunWarning]:
    ds, cage = o.dataset, o.its_cage
    tilt = metrics.tilt(ds).sel(component="total").values
    guided = has_land(cage, o.land) and cage.land_ring
    for side, limit, stop in zip(("inner", "outer"), o.bearing.cage_space(cage), _stops(o)):
        if limit is None or side == guided:
            continue
        gap = 0.5 * (
            cage.bore - limit.diameter
            if side == "inner"
            else limit.diameter - cage.outside_diameter
        )
        centre = metrics.centre_of(ds, "cage")
        if side == "inner":
            centre = centre - metrics.centre_of(ds, "inner")
        excursion = np.hypot(*centre.T) + cage.axial_reach * np.sin(tilt)
        at = int(excursion.argmax())
        if gap > 0.0 and stop is not None and excursion[at] > gap:
            yield RunWarning(
                "meets_ring",
                f"The cage meets {limit.name}: its centre and its tilt together reach "
                f"{_um(excursion[at])} (t = {float(ds['time'][at]) * 1e3:.4g} ms), and the gap "
                f"there is {_um(gap)}; land_force has the force.",
            )
        elif gap > 0.0 and stop is None and excursion[at] > gap + _PASSED:
            yield RunWarning(
                "passes_ring",
                f"The cage passes through {limit.name}: it swings by {_um(excursion[at])} (t = "
                f"{float(ds['time'][at]) * 1e3:.4g} ms), but the gap there is {_um(gap)}, and no "
                "contact between them is computed.",
            )


def _short(o: RunOutcome) -> Iterator[RunWarning]:
    if "short_run" in o.said:
        return
    part = metrics.settled(o.dataset, o.settle)
    turns = abs(float(np.ptp(metrics.carrier_angle(part)))) / (2.0 * np.pi)
    passes = o.number("roller_passes")
    stands, carrier = not np.any(part["inner_speed"].values), metrics.carrier(part)
    few = [f"intervals need {FEWEST} passes"] if passes < FEWEST else []
    if turns < LEAST_TURNS and not stands:
        few.append(f"means need at least one turn of the {carrier}")
    if few:
        yield RunWarning(
            "short_run",
            f"Statistics rest on {passes:.0f} {o.element} passes and {turns:.2g} turns of the "
            f"{carrier}, but {' and '.join(few)}; give a longer solver.duration.",
        )


def _drift(o: RunOutcome) -> Iterator[RunWarning]:
    drift = o.summary["drift"] if "drift" in o.summary else None
    if drift not in (None, NO_DRIFT):
        yield RunWarning(
            "not_settled",
            f"The two halves of the settled part differ beyond the intervals in: {drift}; raise "
            "output.settle or solver.duration.",
        )


def _audit(o: RunOutcome) -> Iterator[RunWarning]:
    if "energy_audit" not in o.summary or o.summary["energy_audit"] != EXCEEDED:
        return
    shares = (
        (o.number("energy_of_drive"), "the drive's work", OF_DRIVE),
        (o.number("energy_of_cage"), "the cage's losses", OF_CAGE),
    )
    known = " and ".join(
        f"{100.0 * share:.2g} % of {what} (at most {100.0 * most:g} %)"
        for share, what, most in shares
        if isfinite(share)
    )
    yield RunWarning(
        "energy_audit",
        f"The energy audit is exceeded: the imbalance is {known}; tighten solver.tolerance.",
    )


def _slip(o: RunOutcome) -> Iterator[RunWarning]:
    note = o.summary.row("slip_loaded").note if "slip_loaded" in o.summary else ""
    if note.startswith("unresolved"):
        yield RunWarning(
            "slip_unresolved", f"{o.element.capitalize()} slip in the loaded zone is {note}."
        )


def _over_edge(o: RunOutcome) -> Iterator[RunWarning]:
    for edge in o.edges:
        if edge.warning:
            yield RunWarning("over_edge", edge.warning[0].upper() + edge.warning[1:])


def _large_rotation(o: RunOutcome) -> Iterator[RunWarning]:
    yield from large_rotation(o.shape)


def _grown_into_ring(o: RunOutcome) -> Iterator[RunWarning]:
    cage = o.its_cage
    guided = cage.land_ring if has_land(cage, o.land) else ""
    yield from grown_into_ring(o.shape, cage, o.bearing.cage_space(cage), guided)


def _elements_touch(o: RunOutcome) -> Iterator[RunWarning]:
    count = o.number("element_touches")
    if count > 0.0:
        yield RunWarning(
            "elements_touch",
            f"{o.element.capitalize()}s touch each other: {count:.0f} times one met the next, "
            "where no pocket keeps them apart.",
        )


def _own_figures(o: RunOutcome) -> Iterator[RunWarning]:
    yield from own_warnings(o.summary)


def _um(length: float) -> str:
    return f"{length * 1e6:.3g} um" if abs(length) < 1e-3 else f"{length * 1e3:.3g} mm"


def _of_each(check: Check) -> Check:
    """The check of every cage, where each row of elements has one."""

    def checked(o: RunOutcome) -> Iterator[RunWarning]:
        count = cage_count(o.dataset)
        for k in range(count):
            which = "" if count == 1 else f"Row {k}: "
            for found in check(replace(o, dataset=one_cage(o.dataset, k))):
                yield replace(found, text=which + found.text)

    return checked


_THROWN_OFF, _PASSES_RING = _of_each(_thrown_off), _of_each(_passes_ring)
#: What is looked at when a run has come to its end.
AT_END: tuple[Check, ...] = (
    _unfinished,
    _yield,
    _overloaded,
    _THROWN_OFF,
    _PASSES_RING,
    _large_rotation,
    _grown_into_ring,
    _short,
    _drift,
    _audit,
    _slip,
    _over_edge,
    _elements_touch,
    _own_figures,
)
_OF_CAGE = (
    _yield, _THROWN_OFF, _PASSES_RING, _large_rotation, _grown_into_ring, _elements_touch
)  # fmt: skip
#: The same without a cage.
CAGELESS_AT_END = tuple(check for check in AT_END if check not in _OF_CAGE)
