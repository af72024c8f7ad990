"""Curves over time: the cage's orbit, histories of a run, and forces of several runs compared."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import pi
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.render import sheet
from flexcage.render.elements import shown_faces
from flexcage.results import metrics
from flexcage.results.figures.table import FIGURES
from flexcage.results.registry import NEIGHBOURS
from flexcage.results.slip import (
    BearingNumbers,
    at_own_angles,
    loaded_zone,
    rolling_sense,
    speed_of,
    touching,
)
from flexcage.stress.places import in_words

if TYPE_CHECKING:
    import xarray

RPM, DEGREE = 30.0 / pi, 180.0 / pi
EDGE, TOP = 110, 110
_WIDTH, _HEIGHT, _BETWEEN = 1480, 250, 66
_BEYOND = 0.01  # of a clearance: an orbit that leaves it by less needs no word
_MARGIN = EDGE + 30  # of histories: speeds of five digits, small sliding speeds with many


def orbit(
    ds: xarray.Dataset,
    path: str | Path,
    *,
    clearance: float | None = None,
    guide: str = "outer",
    settle: float = 0.0,
    title: str = "Orbit of the cage centre",
    note: str = "",
) -> Path:
    """Cage centre relative to the outer ring's in µm, coloured by time.

    ``clearance`` [m] draws the circle in which a land of an undeformed cage lets the centre move,
    about the mean place of the ring that guides it, ``guide`` "inner" or "outer"; if the orbit is
    small in it, a second panel shows the orbit alone, and if it leaves the circle, a sentence says
    why. ``settle`` leaves the start out.
    """
    part = metrics.settled(ds, settle) if settle else ds
    yz = metrics.orbit(part) * 1e6
    t = part["time"].values * 1e3
    reach = float(np.abs(yz).max()) or 1.0
    land = land_circle(part, clearance, guide)
    radius = land[2] if land else 0.0
    zoomed = land is not None and reach < 0.5 * radius
    side, panels, top = 760, 2 if zoomed else 1, TOP + 30
    left_it = beyond_clearance(part, yz, land)
    with sheet.style():
        width = EDGE + panels * (side + 120) + 130
        figure = sheet.new_figure(width, top + side + (96 if not left_it else 140))
        artist = sheet.text_at(figure, 36, top + side + 88, left_it, color=sheet.FAINT)
        sheet.fit_width(figure, artist, width - 72)
        whirl = metrics.whirl(metrics.whole_revolutions(part))
        facts = [
            note,
            f"t = {t[0]:.1f} … {t[-1]:.1f} ms",
            f"mean whirl radius {whirl.mean * 1e6:.1f} µm about the mean",
        ]
        sheet.heading(figure, title, sheet.join(facts), left=36)
        limits = [1.12 * max(reach, radius)]
        if zoomed:
            limits.append(1.12 * reach)
        for i, limit in enumerate(limits):
            left = EDGE + i * (side + 120)
            ax = sheet.axes_at(figure, (left, top, side, side))
            _orbit_panel(ax, yz, t, limit, land)
            if zoomed and i == 0:
                x, y = limits[1] * np.array([[-1, 1, 1, -1, -1], [-1, -1, 1, 1, -1]])
                ax.plot(x, y, color=sheet.INK, lw=0.9, ls=":")
            if i == 0:
                _orbit_legend(ax)
            if zoomed and i == 1:
                ax.set_title("close up of the dotted square", loc="left")
        _time_bar(figure, (width - 200, top, 24, side), t)
        return sheet.save(figure, path)


def land_circle(
    ds: xarray.Dataset, clearance: float | None, guide: str
) -> tuple[float, float, float] | None:
    """Centre (y, z) and radius [µm] of the circle in which a land of an undeformed cage lets the
    cage's centre move, about the mean place of its ring; None without a land."""
    if not clearance:
        return None
    ring = metrics.centre_of(ds, guide) if guide == "inner" else np.zeros((1, 2))
    y, z = (ring.mean(axis=0) * 1e6).tolist()
    return y, z, clearance * 1e6


def beyond_clearance(
    ds: xarray.Dataset, yz: np.ndarray, land: tuple[float, float, float] | None
) -> str:
    """A sentence that says how far an orbit ``yz`` (time, 2) [µm] leaves the ``land_circle``, and
    why; "" if it does not."""
    if land is None:
        return ""
    y, z, radius = land
    beyond = float(np.hypot(yz[:, 0] - y, yz[:, 1] - z).max()) - radius
    if beyond < _BEYOND * radius:
        return ""
    if "modal_coordinates" in ds:
        why = "this cage is flexible, and bends where its land is pressed"
    else:
        why = "the guiding ring moves about its mean place, and the land's contacts yield"
    return (
        f"The orbit reaches {beyond:.2g} µm beyond the circle, which is the clearance of an "
        f"undeformed cage: {why}."
    )


def _orbit_panel(
    ax: Any, yz: np.ndarray, t: np.ndarray, limit: float, land: tuple[float, ...] | None
) -> None:
    """``land``: centre (y, z) and radius of the clearance's circle."""
    from matplotlib.collections import LineCollection

    # z to the left, as seen when looking along -x with y upwards
    xy = yz[:, ::-1]
    lines = LineCollection(
        list(np.stack([xy[:-1], xy[1:]], axis=1)), cmap="cividis", linewidths=1.1, capstyle="round"
    )
    lines.set_array(0.5 * (t[:-1] + t[1:]))
    ax.add_collection(lines)
    if land is not None:
        y, z, radius = land
        angle = np.linspace(0.0, 2.0 * np.pi, 361)
        ax.plot(
            z + radius * np.cos(angle),
            y + radius * np.sin(angle),
            color=sheet.VERMILION,
            lw=1.3,
            ls="--",
            label=f"land clearance, undeformed cage: {radius:g} µm",
        )
    ax.plot(*xy[0], "o", ms=6, mfc="white", mec=sheet.INK, mew=1.2, label="start", ls="none")
    ax.plot(*xy[-1], "s", ms=6, mfc=sheet.INK, mec=sheet.INK, label="end", ls="none")
    ax.plot(*xy.mean(axis=0), "+", ms=11, mew=1.8, color=sheet.VERMILION, label="mean", ls="none")
    ax.set(xlim=(limit, -limit), ylim=(-limit, limit), xlabel="z [µm]", ylabel="y [µm]")
    ax.set_aspect("equal")


def _orbit_legend(ax: Any) -> None:
    ax.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=4,
        borderaxespad=0.2,
        columnspacing=1.2,
        handletextpad=0.4,
    )


def _time_bar(figure: Any, rect: sheet.Rect, t: np.ndarray) -> None:
    sheet.colour_bar(
        figure,
        rect,
        cmap="cividis",
        limits=(float(t[0]), float(t[-1])),
        label="time [ms]",
        vertical=True,
    )


def histories(
    ds: xarray.Dataset,
    path: str | Path,
    *,
    bearing: BearingNumbers | None = None,
    root_stress: xarray.DataArray | None = None,
    loads: np.ndarray | None = None,
    element: int = 0,
    settle: float = 0.0,
    title: str = "Histories",
    note: str = "",
) -> Path:
    """Cage speed, pocket forces (without a cage those of neighbours), root stress (if given) and
    speeds of elements over time; sliding speeds and contact angles as well where these move.

    ``bearing`` adds the speeds without slip, of balls at their mean contact angles once settled.
    ``root_stress`` (time, place) or (time,) is in Pa. ``loads`` (time, 3) are F_x, F_y, F_z [N] on
    the inner ring; where they or its speed change with time, a panel shows them.
    ``element`` is shown by itself over the band of all. The share ``settle`` that statistics
    leave out is shaded.
    """
    if bearing is not None:
        bearing = at_own_angles(metrics.settled(ds, settle), bearing)
    force_panel = _pocket_panel if metrics.caged(ds) else _neighbour_panel
    panels: list[Callable[..., None]] = [_speed_panel, force_panel]
    if drive_varies(ds, loads):
        panels.insert(0, _drive_panel)
    if root_stress is not None:
        panels.append(_stress_panel)
    panels.append(_spin_panel)
    if "contact_angle" in ds:
        panels += [_sliding_panel, _angle_panel]
    count = ds.sizes["element"]
    if not 0 <= element < count:
        raise InputError(f"There is no {metrics.element(ds)} {element}; the bearing has {count}.")
    t, left = ds["time"].values * 1e3, _MARGIN
    with sheet.style():
        height = TOP + len(panels) * (_HEIGHT + _BETWEEN) + 40
        figure = sheet.new_figure(left + _WIDTH + 60, height)
        span = f"t = {t[0]:.1f} … {t[-1]:.1f} ms"
        sheet.heading(figure, title, sheet.join([note, span]))
        for i, panel in enumerate(panels):
            rect = (left, TOP + 22 + i * (_HEIGHT + _BETWEEN), _WIDTH, _HEIGHT)
            ax = sheet.axes_at(figure, rect)
            panel(
                ax, t, ds, bearing=bearing, root_stress=root_stress, loads=loads, element=element,
                settle=settle,
            )  # fmt: skip
            ax.set_xlim(t[0], t[-1])
            if settle:
                end = t[0] + settle * (t[-1] - t[0])
                ax.axvspan(t[0], end, color="#eeeeee", zorder=0, lw=0)
            if i < len(panels) - 1:
                ax.tick_params(labelbottom=False)
            else:
                shaded = "   (shaded: left out of statistics)" if settle else ""
                ax.set_xlabel(f"time [ms]{shaded}")
            ax.yaxis.set_label_coords((40.0 - left) / _WIDTH, 0.5)
        return sheet.save(figure, path)


def _legend(ax: Any, name: str, columns: int = 4) -> None:
    ax.set_title(name, loc="left", weight="bold")
    if ax.get_legend_handles_labels()[1]:
        ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, borderaxespad=0.2)


def drive_varies(ds: xarray.Dataset, loads: np.ndarray | None) -> bool:
    """Whether the inner ring's speed, or the radial or axial one of its ``loads`` (time, 3),
    changes with time."""
    shown = () if loads is None else radial_and_axial(loads)
    return any(map(metrics.varies, (ds["inner_speed"].values, *shown)))


def radial_and_axial(loads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Size of the radial load, and the axial load (time,) [N], of loads (time, 3)."""
    return np.hypot(loads[:, 1], loads[:, 2]), loads[:, 0]


def _drive_panel(ax: Any, t: np.ndarray, ds: xarray.Dataset, *, loads, **_: Any) -> None:
    """Speed of the inner ring on the left, loads on the right."""
    ax.plot(t, ds["inner_speed"] * RPM, color=sheet.BLUE, label="speed")
    ax.set_ylabel("speed [rpm]")
    ax.margins(y=0.15)
    if loads is not None and np.any(loads):
        right = ax.twinx()
        pairs = zip(("radial load", "axial load"), radial_and_axial(loads))
        for (name, values), colour in zip(pairs, (sheet.VERMILION, sheet.ORANGE)):
            if np.any(values):
                right.plot(t, values, color=colour, ls="--", lw=1.3, label=f"{name} [N], right")
        right.margins(y=0.15)
        right.grid(visible=False)
        right.spines["right"].set_visible(True)
        handles, names = right.get_legend_handles_labels()
        for handle, name in zip(handles, names):
            ax.plot([], [], color=handle.get_color(), ls="--", lw=1.3, label=name)
    _legend(ax, "Inner ring")


def _speed_panel(ax: Any, t: np.ndarray, ds: xarray.Dataset, *, bearing, **_: Any) -> None:
    ax.plot(t, metrics.carrier_speed(ds) * RPM, color=sheet.BLUE, label=metrics.carrier(ds))
    if bearing is not None:
        ideal = ds["inner_speed"] * bearing.kinematics(1.0).cage_speed * RPM
        ax.plot(t, ideal, color=sheet.VERMILION, ls="--", lw=1.3, label="epicyclic (no slip)")
    ax.set_ylabel("speed [rpm]")
    _legend(ax, carrier_title(ds))


def carrier_title(ds: xarray.Dataset) -> str:
    """Title of the speed of what goes round with the elements."""
    if metrics.caged(ds):
        return FIGURES["cage_speed"].title
    return FIGURES["orbital_speed"].titled(Element=metrics.element(ds).capitalize())


def _neighbour_panel(ax: Any, t: np.ndarray, ds: xarray.Dataset, **_: Any) -> None:
    force = ds[NEIGHBOURS].max("element")
    ax.plot(t, force, color=sheet.VERMILION, lw=0.8)
    ax.set_ylim(bottom=0.0)
    if not force.values.any():
        sheet.nothing(ax, f"no {metrics.element(ds)} touches the next one")
    ax.set_ylabel("force [N]")
    _legend(ax, f"Largest force between neighbouring {metrics.element(ds)}s, at the samples")


def _pocket_panel(ax: Any, t: np.ndarray, ds: xarray.Dataset, **_: Any) -> None:
    force = metrics.pocket_peaks(ds).max("pocket")
    colours = (sheet.VERMILION, sheet.BLUE, sheet.GREEN)
    for (name, faces), colour in zip(shown_faces(ds).items(), colours):
        ax.plot(t, force.sel(face=faces).max("face"), color=colour, lw=0.8, label=name)
    ax.set_ylim(bottom=0.0)
    if not force.values.any():
        sheet.nothing(ax, "no pocket is touched")
    ax.set_ylabel("force [N]")
    _legend(ax, "Largest pocket force")


def _stress_panel(
    ax: Any, t: np.ndarray, ds: xarray.Dataset, *, root_stress, settle: float, **_: Any
) -> None:
    places = [d for d in root_stress.dims if d != "time"]
    if not places:
        ax.plot(root_stress["time"] * 1e3, root_stress * 1e-6, color=sheet.BLUE)
    else:
        (place,) = places
        values = root_stress.transpose("time", place).values * 1e-6
        when = root_stress["time"].values * 1e3
        ax.fill_between(
            when,
            values.min(axis=1),
            values.max(axis=1),
            color=sheet.SKY,
            alpha=0.45,
            lw=0,
            label="all places",
        )
        part = metrics.settled(root_stress, settle)
        most = int(np.asarray(part.max("time")).argmax())
        name = str(root_stress[place].values[most]) if place in root_stress.coords else str(most)
        highest = "highest once settled" if settle else "highest"
        ax.plot(when, values[:, most], color=sheet.BLUE, label=f"{highest}: {in_words(name)}")
    ax.set_ylim(bottom=0.0)
    ax.set_ylabel("stress [MPa]")
    name = str(root_stress.attrs.get("long_name", "equivalent stress"))
    _legend(ax, name[:1].upper() + name[1:])


def _spin_panel(
    ax: Any, t: np.ndarray, ds: xarray.Dataset, *, bearing, element: int, **_: Any
) -> None:
    own = speed_of(ds)
    _element_speed(ax, t, ds, own.spin(ds).values * RPM, element)
    if bearing is not None:
        ideal = _rolling(ds, own.rolling(bearing.kinematics(1.0)))
        ax.plot(t, ideal, color=sheet.VERMILION, ls="--", lw=1.3, label="pure rolling")
    _legend(ax, own.title)


def _rolling(ds: xarray.Dataset, unit: float) -> xarray.DataArray:
    """Speed of rolling [rpm] in its own sense; ``unit`` is the speed at 1 rad/s of the inner
    ring."""
    return rolling_sense(ds) * unit * ds["inner_speed"] * RPM


def _element_speed(
    ax: Any, t: np.ndarray, ds: xarray.Dataset, speed: np.ndarray, element: int
) -> None:
    """Speeds (time, element) [rpm]: the band of all, one by itself, and where it is loaded."""
    one = metrics.element(ds)
    ax.fill_between(t, speed.min(axis=1), speed.max(axis=1), color="#cfd4da", lw=0, label="all")
    ax.plot(t, speed[:, element], color=sheet.BLUE, label=f"{one} {element}")
    loaded = loaded_zone(ds).transpose("time", "element").values[:, element]
    if loaded.any():
        ax.plot(
            t,
            np.where(loaded, speed[:, element], np.nan),
            color=sheet.ORANGE,
            lw=2.2,
            label=f"{one} {element} in the loaded zone",
        )
    ax.set_ylabel("speed [rpm]")


def _sliding_panel(ax: Any, t: np.ndarray, ds: xarray.Dataset, *, element: int, **_: Any) -> None:
    _race_bands(ax, t, ds, ds["race_slip"], element)
    ax.set_ylabel("speed [m/s]")
    _legend(ax, "Sliding speed at the races")


def _angle_panel(ax: Any, t: np.ndarray, ds: xarray.Dataset, *, element: int, **_: Any) -> None:
    _race_bands(ax, t, ds, ds["contact_angle"] * DEGREE, element)
    ax.set_ylabel("angle [°]")
    _legend(ax, "Contact angles")


def _race_bands(
    ax: Any, t: np.ndarray, ds: xarray.Dataset, of: xarray.DataArray, element: int
) -> None:
    """Values ``of`` (time, element, race) of elements that touch: bands of all, lines of one."""
    one, touched = metrics.element(ds), touching(ds, of)
    for race, colour in (("inner", sheet.BLUE), ("outer", sheet.ORANGE)):
        values = touched.sel(race=race).transpose("time", "element")
        low, high = values.min("element"), values.max("element")
        ax.fill_between(t, low, high, color=colour, alpha=0.25, lw=0, label=f"{race} race, all")
        own = values.isel(element=element)
        ax.plot(t, own, color=colour, lw=0.9, label=f"{race} race, {one} {element}")


def compare_forces(
    datasets: Mapping[str, xarray.Dataset],
    path: str | Path,
    *,
    settle: float = 0.3,
    title: str = "Cage forces compared",
    note: str = "",
) -> Path:
    """Pocket forces of several runs: history, share of time above a force, peaks by pocket."""
    if not 1 <= len(datasets) <= len(sheet.CYCLE):
        raise InputError(f"1 to {len(sheet.CYCLE)} runs can be compared, not {len(datasets)}.")
    parts = {name: metrics.settled(ds, settle) for name, ds in datasets.items()}
    colours = dict(zip(parts, sheet.CYCLE))
    half, second = (_WIDTH - 150) / 2, TOP + 24 + 320 + 110
    with sheet.style():
        figure = sheet.new_figure(EDGE + _WIDTH + 60, second + 360 + 90)
        facts = [_force_text(name, ds) for name, ds in parts.items()]
        sheet.heading(figure, title, sheet.join([note, *facts]))
        top = sheet.axes_at(figure, (EDGE, TOP + 24, _WIDTH, 320))
        share = sheet.axes_at(figure, (EDGE, second, half, 360))
        bars = sheet.axes_at(figure, (EDGE + half + 150, second, half, 360))
        for name, ds in parts.items():
            _history(top, ds, colours[name], name)
            _exceedance(share, ds, colours[name])
        _pocket_bars(bars, parts, colours)
        top.set(xlabel="time [ms]", ylabel="force [N]", ylim=(0.0, None))
        share.set(xlim=(0.0, None))  # once all runs are drawn: to the largest force of any
        spans = [ds["time"].values[[0, -1]] * 1e3 for ds in parts.values()]
        top.set_xlim(min(s[0] for s in spans), max(s[1] for s in spans))
        _legend(top, "Largest pocket force", len(parts))
        return sheet.save(figure, path)


def _force_text(name: str, ds: xarray.Dataset) -> str:
    forces = metrics.pocket_forces(ds)
    return f"{sheet.label(name)}: mean {forces.mean:.3g} N in contact, peak {forces.peak:.3g} N"


def _history(ax: Any, ds: xarray.Dataset, colour: str, name: str) -> None:
    largest = metrics.pocket_peaks(ds).max(("pocket", "face"))
    ax.plot(ds["time"] * 1e3, largest, color=colour, lw=0.8, alpha=0.85, label=sheet.label(name))


def _exceedance(ax: Any, ds: xarray.Dataset, colour: str) -> None:
    """Share of all samples of all pocket faces in which the force is above the abscissa."""
    values = np.sort(ds["pocket_force"].values.ravel())
    share = 1.0 - np.arange(len(values)) / len(values)
    touching = values > 1e-3
    if touching.any():
        ax.semilogy(values[touching], share[touching] * 100.0, color=colour)
    ax.set(xlabel="force at the samples [N]", ylabel="share of time above [%]")
    ax.set_title("How often a face bears more than a force", loc="left", weight="bold")


def _pocket_bars(ax: Any, parts: Mapping[str, xarray.Dataset], colours: dict[str, str]) -> None:
    width = 0.8 / len(parts)
    for i, (name, ds) in enumerate(parts.items()):
        peak = metrics.pocket_peaks(ds).max(("time", "face")).values
        at = np.arange(len(peak)) + (i - 0.5 * (len(parts) - 1)) * width
        ax.bar(at, peak, width * 0.94, color=colours[name])
    count = max(ds.sizes["pocket"] for ds in parts.values())
    ax.set(xlabel="pocket", ylabel="force [N]", xlim=(-0.7, count - 0.3))
    ax.set_xticks(np.arange(0, count, 2 if count <= 30 else 5))
    ax.grid(axis="x", visible=False)
    ax.set_title("Peak force by pocket", loc="left", weight="bold")
