"""Catalogue ratings of the presets, and the standard's own table behind the dynamic one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import flexcage
from flexcage.verification.bearings import preset
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

# ISO 281:2007, factor f_c of radial roller bearings against Dwe cos(alpha)/Dpw
ISO_281_FC = {
    0.01: 52.1, 0.02: 60.8, 0.03: 66.5, 0.04: 70.7, 0.05: 74.1, 0.06: 76.9, 0.07: 79.2,
    0.08: 81.2, 0.09: 82.8, 0.10: 84.2, 0.12: 86.4, 0.14: 87.7, 0.16: 88.5, 0.18: 88.8,
    0.20: 88.7, 0.22: 88.2, 0.24: 87.5, 0.26: 86.4, 0.28: 85.2, 0.30: 83.8,
}  # fmt: skip
LAST_DIGIT = Tolerance(0.05, "the table is printed to one decimal", absolute=True)
CATALOGUE = Tolerance(0.01, "makers round ratings to two or three digits")


def geometry_factor(gamma: float) -> float:
    """f_c [N and mm] at Dw/Dpw, from the rating b_m f_c Lwe^7/9 Z^3/4 Dw^29/27 of a bearing."""
    bearing = preset("N1013")
    length, diameter = 1e3 * bearing.effective_length, 1e3 * bearing.roller_diameter
    size = length ** (7.0 / 9.0) * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    pitch, roller = bearing.roller_diameter / gamma, bearing.roller_diameter
    wanted = replace(
        bearing, inner_race_diameter=pitch - roller, outer_race_diameter=pitch + roller
    )
    return float(wanted.dynamic_rating / (1.1 * size))


def rows() -> Iterator[Row]:
    for gamma, expected in ISO_281_FC.items():
        found = geometry_factor(gamma)
        yield Row(f"f_c at Dwe/Dpw = {gamma:.2f}", "", expected, found, LAST_DIGIT)
    yield Row("f_c of the N1013", "", 83.8, geometry_factor(8.0 / 82.5), LAST_DIGIT)
    for name in flexcage.preset_names():
        for rating, stated, found in flexcage.load_preset(name).ratings():
            yield Row(f"{name}, {rating}", "kN", stated / 1e3, found / 1e3, CATALOGUE)


CASE: KnownAnswer = KnownAnswer(
    name="ratings",
    title="Static and dynamic load ratings",
    source="ISO 76:2006; ISO 281:2007, table of f_c; makers' catalogues (N1013: 51.0 and 41.0 kN)",
    checks="The inside that a preset assumes must give the ratings that its maker states: they fix "
    "the number, diameter and effective length of the rollers.",
    rows=rows,
)
