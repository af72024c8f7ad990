"""A run's histories as charts that can be zoomed: speeds, forces, contact angles, stress, orbit."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.render.curves import (
    beyond_clearance,
    carrier_title,
    drive_varies,
    land_circle,
    radial_and_axial,
)
from flexcage.render.elements import shown_faces
from flexcage.render.sheet import BLUE, GREEN, INK, ORANGE, VERMILION
from flexcage.report.blocks import Chart
from flexcage.report.plots import add_band, add_curve, new_figure
from flexcage.report.thinning import thinned
from flexcage.results import metrics
from flexcage.results.audit import imbalance
from flexcage.results.registry import NEIGHBOURS
from flexcage.results.slip import at_own_angles, loaded_zone, rolling_sense, speed_of, touching
from flexcage.stress.places import in_words

if TYPE_CHECKING:
    import xarray

    from flexcage.render.album import Scene
    from flexcage.results.slip import BearingNumbers

RPM = 30.0 / pi
TIME = "time [ms]"
_WASH, _SAND = "rgba(86, 180, 233, 0.35)", "rgba(230, 159, 0, 0.3)"
_LEFT_OUT = "#eeeeee"  # the time that statistics leave out


def history_charts(scene: Scene, numbers: BearingNumbers) -> list[Chart]:
    """Charts over time of a run, and the orbit of its cage's centre: what the pictures of the
    histories and of the orbit show."""
    ds = scene.dataset
    numbers = at_own_angles(metrics.settled(ds, scene.settle), numbers)
    contacts = _pocket_force(ds) if metrics.caged(ds) else _neighbour_force(ds)
    charts = [_carrier_speed(ds, numbers), contacts]
    if drive_varies(ds, scene.loads):
        charts = [*_drive(ds, scene.loads), *charts]
    if scene.stress is not None:
        charts.append(_root_stress(scene))
    charts.append(_element_speed(scene, numbers))
    if "contact_angle" in ds:
        charts += [_sliding(scene), _contact_angles(scene)]
    t = _ms(ds)
    for chart in charts:
        if scene.settle:
            end = t[0] + scene.settle * (t[-1] - t[0])
            chart.figures[0][1].add_vrect(
                t[0], end, fillcolor=_LEFT_OUT, layer="below", line_width=0
            )
    return [*charts, *(_orbit(own) for own in scene.rows or (scene,) if metrics.caged(ds))]


def _ms(ds: xarray.Dataset) -> np.ndarray:
    return ds["time"].values * 1e3


def _drive(ds: xarray.Dataset, loads: np.ndarray) -> list[Chart]:
    """Speed of the inner ring, and the loads on it."""
    speed, load = new_figure(TIME, "speed [rpm]", showlegend=False), new_figure(TIME, "load [N]")
    add_curve(speed, _ms(ds), ds["inner_speed"].values * RPM, "inner ring", color=BLUE)
    pairs = zip(("radial load", "axial load"), radial_and_axial(loads), (VERMILION, ORANGE))
    for name, values, colour in pairs:
        if np.any(values):
            add_curve(load, _ms(ds), values, name, color=colour)
    charts = [Chart("Speed of the inner ring", [("", speed)])]
    return [*charts, *([Chart("Load on the inner ring", [("", load)])] if load.data else [])]


def _carrier_speed(ds: xarray.Dataset, numbers: BearingNumbers) -> Chart:
    figure = new_figure(TIME, "speed [rpm]")
    ideal = ds["inner_speed"].values * numbers.kinematics(1.0).cage_speed * RPM
    speed = metrics.carrier_speed(ds).values * RPM
    add_curve(figure, _ms(ds), speed, metrics.carrier(ds), color=BLUE)
    add_curve(figure, _ms(ds), ideal, "without slip", color=VERMILION, dash="dash")
    return Chart(carrier_title(ds), [("", figure)])


def _neighbour_force(ds: xarray.Dataset) -> Chart:
    figure, one = new_figure(TIME, "force [N]", showlegend=False), metrics.element(ds)
    add_curve(figure, _ms(ds), ds[NEIGHBOURS].max("element").values, f"next {one}", color=VERMILION)
    return Chart(f"Force between neighbouring {one}s, largest of all", [("", figure)])


def _pocket_force(ds: xarray.Dataset) -> Chart:
    force = metrics.pocket_peaks(ds).max("pocket")
    figure = new_figure(TIME, "force [N]")
    for (name, faces), colour in zip(shown_faces(ds).items(), (VERMILION, BLUE, GREEN)):
        values = force.sel(face=faces).max("face").values
        add_curve(figure, _ms(ds), values, name.replace("face", "faces"), color=colour)
    return Chart("Pocket force, largest of all pockets", [("", figure)])


def _root_stress(scene: Scene) -> Chart:
    assert scene.stress is not None
    roots, t = scene.stress.roots * 1e-6, _ms(scene.dataset)
    worst = int(roots[scene.stress.settled :].max(axis=0).argmax())
    figure = new_figure(TIME, "equivalent stress [MPa]")
    kind = scene.stress.root_kind
    add_band(figure, t, roots.min(axis=1), roots.max(axis=1), f"all {kind.short}", _WASH)
    name = in_words(scene.stress.root_names[worst])
    add_curve(figure, t, roots[:, worst], f"highest once settled: {name}", color=BLUE)
    return Chart(f"Stress at {kind.many}", [("", figure)])


def _element_speed(scene: Scene, numbers: BearingNumbers) -> Chart:
    ds = scene.dataset
    own = speed_of(ds)
    ideal = _rolling(ds, own.rolling(numbers.kinematics(1.0)))
    figure = _speeds(f"{own.axis} [rpm]", scene, own.spin(ds).values, ideal)
    return Chart(own.title, [("", figure)])


def _rolling(ds: xarray.Dataset, unit: float) -> np.ndarray:
    """Speed of rolling [rad/s] in its own sense, (time,); ``unit`` is that at 1 rad/s of the inner
    ring."""
    return np.asarray(rolling_sense(ds) * unit * ds["inner_speed"].values)


def _speeds(title: str, scene: Scene, speed: np.ndarray, ideal: np.ndarray) -> Any:
    """Speeds (time, element) [rad/s]: the band of all, one by itself with the loaded zone marked,
    and the one without slip."""
    ds, own = scene.dataset, scene.followed
    speed, one = speed * RPM, metrics.element(ds)
    figure = new_figure(TIME, title)
    add_band(figure, _ms(ds), speed.min(axis=1), speed.max(axis=1), f"all {one}s", _WASH)
    add_curve(figure, _ms(ds), speed[:, own], f"{one} {own}", color=BLUE)
    loaded = loaded_zone(ds).transpose("time", "element").values[:, own]
    if loaded.any():
        inside = np.where(loaded, speed[:, own], np.nan)
        add_curve(figure, _ms(ds), inside, "in the loaded zone", color=ORANGE, width=2.4)
    add_curve(figure, _ms(ds), ideal * RPM, "pure rolling", color=VERMILION, dash="dash")
    return figure


def _sliding(scene: Scene) -> Chart:
    figure = _by_race(scene, scene.dataset["race_slip"], "speed [m/s]")
    return Chart("Sliding speed at the races", [("", figure)])


def _contact_angles(scene: Scene) -> Chart:
    figure = _by_race(scene, scene.dataset["contact_angle"] * (180.0 / pi), "angle [°]")
    return Chart("Contact angles", [("", figure)])


def _by_race(scene: Scene, of: xarray.DataArray, title: str) -> Any:
    """Values ``of`` (time, element, race) of elements that touch: bands of all, lines of one."""
    ds, own = scene.dataset, scene.followed
    one, touched = metrics.element(ds), touching(ds, of)
    figure = new_figure(TIME, title)
    for race, colour, wash in (("inner", BLUE, _WASH), ("outer", ORANGE, _SAND)):
        values = touched.sel(race=race).transpose("time", "element")
        low, high = values.min("element").values, values.max("element").values
        add_band(figure, _ms(ds), low, high, f"{race} race, all {one}s", wash)
        line = values.isel(element=own).values
        add_curve(figure, _ms(ds), line, f"{race} race, {one} {own}", color=colour)
    return figure


def _orbit(scene: Scene) -> Chart:
    part = metrics.settled(scene.dataset, scene.settle)
    y, z = (metrics.orbit(part) * 1e6).T
    kept = np.union1d(thinned(y), thinned(z))
    land = land_circle(part, scene.clearance, scene.guide)
    reach = 1.08 * max(
        float(np.abs([y, z]).max()), max(map(abs, land[:2])) + land[2] if land else 0
    )
    span = {"range": [-reach, reach]}
    figure = new_figure("z [µm]", "y [µm]")
    # z to the left, as seen when looking along -x with y upwards, as in the pictures
    figure.update_xaxes(range=[reach, -reach], constrain="domain")
    figure.update_yaxes(**span, scaleanchor="x", constrain="domain")
    if land is not None:
        angle = np.linspace(0.0, 2.0 * pi, 181)
        ring = [land[1] + land[2] * np.cos(angle), land[0] + land[2] * np.sin(angle)]
        name = f"land clearance {land[2]:g} µm"
        add_curve(figure, ring[0], ring[1], name, color=VERMILION, dash="dash")
    figure.add_scatter(
        x=z[kept].astype(np.float32), y=y[kept].astype(np.float32), mode="lines",
        line={"width": 1.1, "color": BLUE}, name="cage centre",
    )  # fmt: skip
    for name, at, symbol in (
        ("start", (z[0], y[0]), "circle-open"), ("end", (z[-1], y[-1]), "square"),
        ("mean", (z.mean(), y.mean()), "cross-thin"),
    ):  # fmt: skip
        figure.add_scatter(
            x=[float(at[0])], y=[float(at[1])], mode="markers", name=name,
            marker={"symbol": symbol, "size": 13 if name == "mean" else 8, "color": INK,
                    "line": {"width": 2, "color": INK}},
        )  # fmt: skip
    why = beyond_clearance(part, np.stack([y, z], axis=1), land)
    return Chart("Orbit of the cage's centre, settled part", [("", figure)], why, height=420)


def imbalance_chart(ds: xarray.Dataset) -> Chart:
    """Energy gained less work done, over time."""
    figure = new_figure(TIME, "imbalance [mJ]", showlegend=False)
    add_curve(figure, _ms(ds), imbalance(ds).values * 1e3, "imbalance", color=BLUE)
    return Chart("Energy gained less work done", [("", figure)])


def step_chart(time: np.ndarray, step: np.ndarray) -> Chart:
    """The solver's steps [s] over time [s]."""
    figure = new_figure(TIME, "step [µs]", showlegend=False)
    figure.update_yaxes(type="log", dtick=1)
    add_curve(figure, time * 1e3, step * 1e6, "step", color=BLUE)
    return Chart("Steps of the solver", [("", figure)])
