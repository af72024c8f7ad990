"""Can heat leave as [heat] says? One sentence each, and what would be right."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from flexcage.core.units import describe
from flexcage.geometry.checks import Finding

if TYPE_CHECKING:
    from flexcage.case.sections import StaticSections

_OUT = ("shaft_ambient", "housing_ambient")  # ways out beside a flow of oil


def find_in_heat(case: StaticSections) -> Iterator[Finding]:
    """What is impossible in [heat]."""
    heat = case.heat
    if not heat.given:
        return
    yield from find_without_oil(case)
    if not any(getattr(heat, name) != 0.0 for name in _OUT) and not heat.oil_flow:
        yield (
            "heat.housing_ambient",
            "heat.shaft_ambient and heat.housing_ambient are 0 W/K and no oil flows, so no heat "
            "leaves the bearing; give one of them, or heat.oil_flow.",
        )
    if heat.oil_inlet is not None and not heat.oil_flow:
        yield (
            "heat.oil_inlet",
            f"heat.oil_inlet is {describe(heat.oil_inlet, 'degC')}, but no oil flows; give "
            "heat.oil_flow, or leave it out.",
        )
    for limit in ("oil_limit", "steel_limit"):
        value = getattr(heat, limit)
        if value <= heat.ambient:
            yield (
                f"heat.{limit}",
                f"heat.{limit} is {describe(value, 'degC')}, but heat.ambient is "
                f"{describe(heat.ambient, 'degC')} already; give more.",
            )


def find_without_oil(case: StaticSections) -> Iterator[Finding]:
    """What temperatures need of the oil and the motion."""
    life = case.life
    if life.viscosity_40 is None or life.viscosity_100 is None:
        yield (
            "life.viscosity_40",
            "Temperatures need the oil's viscosity over temperature; give life.viscosity_40, "
            "life.viscosity_100, and life.temperature, at which the search begins.",
        )
    if case.speed == 0.0:
        yield (
            "drive.speed",
            "The bearing stands still at the start (drive.speed), so that nothing warms it; give "
            "the speed at which temperatures are asked for.",
        )
    yield from _find_without_expansion(case)


def _find_without_expansion(case: StaticSections) -> Iterator[Finding]:
    """Bodies whose growth with warmth is not known."""
    bearing, fit = case.bearing, case.fit
    bodies = {"bearing.material": bearing.material, "fit.shaft_material": fit.shaft_material,
              "fit.housing_material": fit.housing_material}  # fmt: skip
    if bearing.element_material is not None:
        bodies["bearing.element_material"] = bearing.element_material
    for where, material in bodies.items():
        if material.expansion is None:
            yield (
                f"{where}.expansion",
                f"Temperatures change the clearance, but no thermal expansion of {material.name} "
                f'is known; give {where}.expansion, such as "12e-6 1/K" of steel.',
            )
