"""Random cylindrical roller bearings of sensible dimensions, loads and speeds, seeded."""

from __future__ import annotations

import numpy as np


def random_bearing(seed: int, model: str = "rigid") -> dict:
    """Tables of a case: rollers of 5 to 30 mm, 0.1 to 12 % of the static rating, speed times pitch
    diameter 2e4 to 6e5 rpm mm, a cage of brass or PA66 of this model."""
    r = np.random.default_rng(seed)
    roller = r.uniform(5.0, 30.0)  # mm, like all lengths here
    count = int(r.integers(10, 25))
    pitch = roller * r.uniform(1.2, 1.45) / np.sin(np.pi / count)
    inner, outer = pitch - roller, pitch + roller
    length = roller * r.uniform(1.0, 1.6)
    edge = 0.06 * roller
    width = length * r.uniform(1.6, 1.9)
    rib, rib_play = inner + 0.3 * roller, r.uniform(0.02, 0.08)
    ring = 0.08 * inner + 0.3 * roller
    play = r.uniform(0.1, 0.4)
    land = r.uniform(0.02, 0.05) * roller
    cage_outside = pitch + roller * r.uniform(0.25, 0.5)
    rating = 44.0 * (1.0 - roller / pitch) * count * (length - 2.0 * edge) * roller  # N
    load = rating * 10.0 ** r.uniform(-3.0, -0.9)
    speed = r.uniform(2e4, 6e5) / pitch
    clearance = r.uniform(0.0, 2e-3) * roller
    material = str(r.choice(["brass", "PA66"]))
    kind = str(r.choice(["none", "dry", "dry"]))
    return {
        "bearing": _mm(
            bore=inner - 2.0 * ring,
            outside_diameter=outer + 2.0 * ring,
            width=width,
            inner_race_diameter=inner,
            outer_race_diameter=outer,
            roller_diameter=roller,
            roller_length=length,
            effective_length=length - 2.0 * edge,
            radial_clearance=clearance,
            rib_diameter=rib,
            rib_gap=length + rib_play,
        )
        | {"roller_count": count},
        "cage": _mm(
            bore=rib + 2.0 * land,
            outside_diameter=cage_outside,
            width=1.5 * length,
            pocket_width=roller + play,
            pocket_length=length + play,
            fillet_radius=edge,
        )
        | {"model": model, "material": material},
        "drive": {"speed": f"{speed} rpm"},
        "load": {"radial": f"{load} N"},
        "contacts": {"land": {"kind": kind} | _mm(clearance=land, width=0.2 * length)},
    }


def _mm(**lengths: float) -> dict[str, str]:
    return {name: f"{value} mm" for name, value in lengths.items()}
