"""Figures of the lubricant's film at the races."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.geometry.film import Oil
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.results.film import film_thickness
from flexcage.results.slip import loaded_zone


@dataclass(frozen=True, eq=False)
class Lubricated:
    """A part of a run, with the bearing and the oil that make its films."""

    part: SettledRun
    bearing: Bearing
    oil: Oil

    @cached_property
    def films(self) -> Mapping[str, tuple[np.ndarray, np.ndarray]]:
        """Films of loaded elements [m], central and least, by the races that have any."""
        ds = self.part.ds
        film = film_thickness(ds, self.bearing, self.oil).values
        zone = loaded_zone(ds).transpose("time", ...).values
        found = {race: (film[:, :, k, 0][zone], film[:, :, k, 1][zone])
                 for k, race in enumerate(("inner", "outer"))}  # fmt: skip
        return {race: both for race, both in found.items() if np.isfinite(both[1]).any()}


def _mean(race: str, facts: Lubricated) -> Found | None:
    if race not in facts.films:
        return None
    note = f"middle of loaded {facts.part.element}s' contacts"
    return Found(float(np.nanmean(facts.films[race][0])), note)


def _least(race: str, facts: Lubricated) -> float | None:
    return float(np.nanmin(facts.films[race][1])) if race in facts.films else None


# fmt: off
FILM = FigureTable[Lubricated]("Lubricant's film")
for _race in ("inner", "outer"):
    FILM.add(f"film_{_race}", f"Film, {_race} race, mean", "um",
             "middle of loaded elements' contacts; isothermal, fully flooded",
             take=partial(_mean, _race))
    FILM.add(f"film_least_{_race}", f"Film, {_race} race, least", "um", "of loaded elements",
             take=partial(_least, _race))
