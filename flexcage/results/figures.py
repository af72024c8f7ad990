"""The figures of a run's summary: its speeds, slip, motion, forces and energy after settling."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results import audit, metrics
from flexcage.results.angles import at_angles, of_curvature
from flexcage.results.bootstrap import FEWEST
from flexcage.results.contact_activity import EVENTS, contact_series
from flexcage.results.known import KNOWN, NO_DRIFT, SETTLING, KnownFigure, marked
from flexcage.results.metrics import BearingNumbers, SlipRange
from flexcage.results.registry import NEIGHBOURS
from flexcage.results.ring_figures import constraint_sections, outer_sections, ring_section
from flexcage.results.statistics import Record, Windows, element_passes
from flexcage.results.summary import Row, Section, Summary, figure, section_of, statistic

if TYPE_CHECKING:
    import xarray

JOINT = 1.25  # times its margin a drift must be, for that three figures err together in 5 % of runs
LOW_PASS = 2e3  # Hz, of the second deviation of the cage centre's speed


def pass_peak(element: str) -> str:
    """What the peak of a pass is, in words."""
    return f"mean of the largest in each {element} pass"


@dataclass(frozen=True)
class OwnFigures:
    """What the summary of one family's bearings says beside what all do: the figures ``known``;
    rows on its elements' ``speeds``, the section of their ``slip``, and rows on the cage's
    ``motion`` and on ``forces``."""

    known: tuple[KnownFigure, ...]
    speeds: Callable[[xarray.Dataset, BearingNumbers], tuple[Row, ...]]
    slip: Callable[[xarray.Dataset, BearingNumbers, SlipRange], Section]
    motion: Callable[[xarray.Dataset], tuple[Row, ...]] = lambda ds: ()
    forces: Callable[[xarray.Dataset, Windows], tuple[Row, ...]] = lambda ds, windows: ()


def summarise(
    ds: xarray.Dataset,
    bearing: BearingNumbers,
    *,
    settle: float = 0.3,
    slip_range: SlipRange | None = None,
    events: xarray.Dataset | None = None,
) -> Summary:
    """Summary of a run's motion and forces after its start; stress, solver and times come from
    those who know them, by :meth:`Summary.with_figures`. ``events`` are the run's contacts that
    closed or opened; without them contacts are counted at samples.
    """
    if not 0.0 <= settle < 1.0:
        raise InputError(f"settle must lie in 0 ... 1, not {settle}.", where="output.settle")
    part = metrics.settled(ds, settle)
    windows = element_passes(part, bearing)
    own: OwnFigures = metrics.family(ds).figures()
    caged = metrics.caged(part)
    pockets = _force_rows(part, windows) if caged else ()
    sections = [
        section_of((*_speed_rows(part, bearing), *own.speeds(part, bearing))),
        own.slip(part, bearing, slip_range or SlipRange()),
        *([section_of((*_motion_rows(part, bearing), *own.motion(part)))] if caged else ()),
        section_of((*pockets, *_race_rows(part), *own.forces(part, windows))),
        *([section_of(_contact_rows(part, windows, events))] if caged else ()),
        *_neighbour_sections(part, windows, events, bearing),
        ring_section(part, windows),
        *outer_sections(part, windows),
        *constraint_sections(part, windows),
    ]
    records = {r.key: r.record for s in sections for r in s.rows if r.record is not None}
    sections.insert(0, section_of(_statistics_rows(part, windows, settle, records)))
    if "energy" in ds and "work" in ds:
        sections.append(section_of(_energy_rows(ds)))
    return Summary(tuple(sections))


def _statistics_rows(
    ds: xarray.Dataset, windows: Windows, settle: float, records: dict[str, Record]
) -> tuple[Row, ...]:
    begin, end = (float(ds["time"][k]) for k in (0, -1))
    count = len(windows.first)
    few = "" if count >= FEWEST else f"; intervals need {FEWEST}"
    watched = [key for key in marked(SETTLING) if key in records]
    drifts = {KNOWN[key].quantity: records[key].drift for key in watched}
    known = any(isfinite(d) for d in drifts.values())
    drifting = ", ".join(name for name, d in drifts.items() if d > JOINT)
    remedy = "" if known else f"too few passes to tell: {2 * FEWEST} are needed"
    if drifting:
        remedy = "beyond the intervals: not settled, raise output.settle"
    return (
        figure("settled_at", begin, f"{100.0 * settle:g} % of the run left out"),
        figure("settled_time", end - begin),
        figure(
            "roller_passes",
            count,
            f"± is a 95 % interval{few}",
            Element=metrics.element(ds).capitalize(),
        ),
        figure("drift", (drifting or NO_DRIFT) if known else None, remedy),
    )


def _speed_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    speed = metrics.cage_speed(ds, bearing)
    part = metrics.whole_revolutions(ds)
    windows = element_passes(part, bearing)
    omega = metrics.carrier_speed(part).values
    own = metrics.at_own_angles(part, bearing)
    ideal = part["inner_speed"].values * own.kinematics(1.0).cage_speed
    inner = float(ds["inner_speed"].mean())
    slip, curved = windows.ratio(ideal - omega, ideal), of_curvature(part, bearing)
    if not metrics.caged(ds):
        whole, name = f"mean of {speed.revolutions:.2f} turns", metrics.element(ds).capitalize()
        return (
            figure("inner_speed", inner),
            statistic("orbital_speed", windows.mean(omega), whole, value=speed.mean, Element=name),
            figure("epicyclic_speed", speed.epicyclic, at_angles(own)),
            statistic("orbital_slip_ratio", slip, curved, value=speed.slip_ratio, Element=name),
        )
    whole = f"mean of {speed.revolutions:.2f} cage revolutions"
    return (
        figure("inner_speed", inner),
        statistic("cage_speed", windows.mean(omega), whole, value=speed.mean),
        figure("epicyclic_speed", speed.epicyclic, at_angles(own)),
        statistic("cage_slip_ratio", slip, curved, value=speed.slip_ratio),
        statistic("cage_speed_ripple", windows.deviation(omega), "standard deviation over mean"),
    )


def _motion_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    whole = metrics.whole_revolutions(ds)
    windows = element_passes(whole, bearing)
    about_mean, about_axis = (
        windows.mean(metrics.whirl_radius(whole, about=c)) for c in ("mean", "axis")
    )
    mean, axis = metrics.whirl(whole, about="mean"), metrics.whirl(whole, about="axis")
    lean = metrics.tilt(ds).sel(component="total")
    leaning = element_passes(ds, bearing).mean(lean.values)
    rate = f"{metrics.sampling_rate(ds) / 1e3:g} kHz"
    return (
        statistic("whirl_radius", about_mean, "about the orbit's mean"),
        figure("whirl_radius_max", mean.largest),
        figure("whirl_ratio", mean.ratio),
        statistic("whirl_radius_axis", about_axis, "the ring's axis"),
        figure("whirl_ratio_axis", axis.ratio),
        figure(
            "whirl_speed_ratio",
            axis.speed_ratio,
            f"net turns about the ring's axis over the cage's, at {rate}",
        ),
        figure(
            "velocity_deviation",
            metrics.velocity_deviation(ds),
            f"standard deviation over mean, at {rate}, no filter",
        ),
        figure(
            "velocity_deviation_2khz",
            metrics.velocity_deviation(ds, low_pass=LOW_PASS),
            f"the same, low-passed at {LOW_PASS / 1000.0:g} kHz",
        ),
        statistic("tilt_mean", leaning),
        figure("tilt_max", float(lean.max())),
    )


def _force_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    pocket = metrics.pocket_forces(ds)
    total, faces, largest = metrics.pocket_force_series(ds)
    place = f"pocket {pocket.peak_pocket}"
    if ds.sizes["face"] > 1:
        place += f", {pocket.peak_face}"
    where = f"{place}, t = {pocket.peak_time * 1e3:.3f} ms" if pocket.peak else "none is touched"
    walls = "Pocket faces" if ds.sizes["face"] > 1 else "Pockets"
    return (
        statistic("pocket_force_mean", windows.ratio(total, faces), "while in contact"),
        statistic("pocket_force_sum", windows.mean(total)),
        statistic("pocket_force_pass_peak", windows.peak(largest), pass_peak(metrics.element(ds))),
        figure("pocket_force_peak", pocket.peak, where),
        figure("pocket_force_ratio", pocket.ratio),
        figure("pocket_contact", pocket.contact_share, "of the time", Faces=walls),
    )


def _contact_rows(
    ds: xarray.Dataset, windows: Windows, events: xarray.Dataset | None
) -> tuple[Row, ...]:
    series = contact_series(ds, events)
    begun = series.onsets.sum(axis=1) / series.step
    source = "to a step of the solver"
    if series.source != EVENTS:
        source = f"at samples, {metrics.sampling_rate(ds) / 1e3:g} kHz, that miss shorter ones"
    return (
        statistic(
            "contact_frequency", windows.mean(begun / ds.sizes["pocket"]), f"counted {source}"
        ),
        statistic("contact_frequency_total", windows.mean(begun)),
        statistic(
            "free_flight_share",
            windows.mean(series.free),
            "of the time: no pocket and no land touches the cage",
        ),
    )


def _neighbour_sections(
    ds: xarray.Dataset, windows: Windows, events: xarray.Dataset | None, bearing: BearingNumbers
) -> Iterator[Section]:
    """How elements press and met their neighbours, where they can."""
    if NEIGHBOURS not in ds:
        return
    forces = () if metrics.caged(ds) else _neighbour_rows(ds, windows, bearing)
    yield section_of((*forces, _touches(ds, events)))


def _neighbour_rows(
    ds: xarray.Dataset, windows: Windows, bearing: BearingNumbers
) -> tuple[Row, ...]:
    """Forces between neighbours, and how far the loosest pair of them is apart."""
    force = ds[NEIGHBOURS].transpose("time", "element").values.astype(float)
    touching, name = force > metrics.TOUCHING, metrics.element(ds)
    summed, largest = np.where(touching, force, 0.0).sum(axis=1), force.max(axis=1)
    words: Any = {"element": name, "Element": name.capitalize()}
    at = np.unravel_index(int(np.argmax(force)), force.shape)
    where = f"{name} {at[1]}, t = {float(ds['time'][at[0]]) * 1e3:.3f} ms"
    apart = metrics.gaps(ds, bearing).max(axis=1)
    return (
        statistic(
            "neighbour_force_mean", windows.ratio(summed, touching.sum(axis=1)),
            "while in contact", **words,
        ),
        statistic(
            "neighbour_force_pass_peak", windows.peak(largest), pass_peak(name), **words
        ),
        figure(
            "neighbour_force_peak", float(force.max()),
            f"{where}, at the samples" if force.any() else "none touches", **words,
        ),
        figure("neighbour_contact", float(touching.mean()), "of the time", **words),
        statistic("largest_gap", windows.mean(apart), **words),
    )  # fmt: skip


def _touches(ds: xarray.Dataset, events: xarray.Dataset | None) -> Row:
    """How often elements met their neighbours."""
    if events is None:
        closed = ds[NEIGHBOURS].transpose("time", "element").values > 0.0
        count = int((closed[1:] & ~closed[:-1]).sum())
    else:
        time, place = events["time"].values, events["place"].values.astype(str)
        begun = events["closed"].values & np.char.startswith(place, "next ")
        count = int(
            (begun & (time >= float(ds["time"][0])) & (time <= float(ds["time"][-1]))).sum()
        )
    name = metrics.element(ds).capitalize()
    return figure("element_touches", count, idle=count == 0 and metrics.caged(ds), Element=name)


def _race_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    race = ds["race_force"].max("time")
    inner, outer = (float(race.sel(race=r).max()) for r in ("inner", "outer"))
    return (
        figure("race_force_inner", inner),
        figure("race_force_outer", outer),
    )


def _energy_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    check = audit.energy_audit(ds)
    lacking = "" if isfinite(check.of_cage) else ": too little"
    caged = metrics.caged(ds)
    bounds = f"at most {100.0 * audit.OF_DRIVE:g} % of the drive's work"
    if caged:
        bounds += f", {100.0 * audit.OF_CAGE:g} % of the cage's losses"
    note = {
        audit.PASSED: bounds,
        audit.UNJUDGED: "too little work to judge by",
        audit.EXCEEDED: f"{bounds}: tighten solver.tolerance",
    }[check.verdict]
    return (
        figure("energy_audit", check.verdict, note),
        *(
            figure(
                f"stored_{k}", v, "whole run", idle=not ds["energy"].sel(energy_kind=k).values.any()
            )
            for k, v in check.stored.items()
        ),
        figure("energy_moved", check.moved, "whole run"),
        figure("energy_elastic", check.elastic),
        figure("energy_imbalance", check.worst),
        figure("energy_relative", check.relative),
        figure("energy_of_drive", check.of_drive),
        figure(
            "energy_of_cage",
            check.of_cage,
            f"what pockets, lands and modes dissipate{lacking}",
            idle=not caged,
        ),
        *(
            figure(f"work_{k}", v, idle=not ds["work"].sel(channel=k).values.any())
            for k, v in check.channels.items()
        ),
    )
