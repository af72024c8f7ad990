"""Cases of the chapter's runs, and these runs. Tables map dotted paths to text; later ones win."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from typing import Any

import flexcage
from flexcage import spec

ON_N1013 = {
    "bearing": {"preset": "N1013"},
    "mesh": {"fineness": "coarse"},
    "load": {"radial": "1000 N"},
}
ON_7010C = {
    "bearing": {"preset": "7010C-PI"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "load": {"axial": "100 N", "gravity": "0 m/s^2"},
    "output": {"rate": "50 kHz", "vibration_rate": "50 kHz"},
}
NO_OIL = {"lubricant.rolling_resistance": "none", "lubricant.oil_fraction": 0.0}
# of a 7010C
SMOOTH = {f"contacts.{place}.friction.law": "none" for place in ("race", "pocket", "land")}
ELASTIC = {f"contacts.{place}.normal.law": "elastic" for place in ("race", "pocket", "land")}
# of an N1013
FRICTIONLESS = {
    f"contacts.{place}.friction.law": "none" for place in ("race", "pocket", "side", "rib", "land")
}
LOSSLESS = {
    **FRICTIONLESS,
    **NO_OIL,
    **{f"contacts.{p}.normal.law": "elastic" for p in ("race", "pocket", "side", "rib", "land")},
    "modes.damping": 0.0,
    "load.gravity": "0 m/s^2",
}


def _case(base: Mapping[str, object], tables: tuple[Mapping[str, object], ...]) -> flexcage.Case:
    return flexcage.load_case(base, overrides={k: v for t in tables for k, v in t.items()})


def n1013(*tables: Mapping[str, object], **sections: object) -> flexcage.Case:
    """The preset with a sound cage under 1000 N."""
    return _case({**ON_N1013, **sections}, tables)


def c7010(*tables: Mapping[str, object]) -> flexcage.Case:
    """The preset with a rigid cage under 100 N, without weight."""
    return _case(ON_7010C, tables)


def in_a_cage(bearing: Any, *tables: Mapping[str, object]) -> flexcage.Case:
    """A ball bearing without weight in a rigid cage with 4 % of play."""
    ball, pitch = bearing.ball_diameter, bearing.pitch_diameter
    cage = bearing.cage_spec(
        bore=pitch - 0.4 * ball, outside_diameter=pitch + 0.4 * ball, width=1.5 * ball,
        pocket_diameter=1.04 * ball,
    )  # fmt: skip
    case = flexcage.Case(
        bearing=bearing, cage=cage, cage_model="rigid", mesh=spec.MeshOptions(fineness="coarse"),
        load=spec.Load(gravity=0.0),
    )  # fmt: skip
    return case.replace(si=False, **{k: v for t in tables for k, v in t.items()})


def faster(share: float, rpm: float, time: str = "2 ms") -> dict[str, object]:
    """A drive that begins at a share of its speed [rpm] and has it after ``time``, steadily."""
    speeds = [f"{v!r} rpm" for v in (share * rpm, rpm, rpm)]
    return {"drive.times": ["0 s", time, "1 s"], "drive.speeds": speeds}


def run_of(case: flexcage.Case) -> flexcage.Run:
    """A run of the case, without stress. Its warnings are not told: that it is too short for
    statistics is no news."""
    log = logging.getLogger("flexcage")
    level = log.level
    log.setLevel(logging.ERROR)
    try:
        return flexcage.simulate(case, stress=False)
    finally:
        log.setLevel(level)
