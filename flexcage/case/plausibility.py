"""Values far from any solid or any bearing, with the slip of a unit that they probably are: legal,
computed as they are, and questioned once each."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from math import degrees, radians
from typing import TYPE_CHECKING, Any

from flexcage.case.fit_checks import questioned_fit
from flexcage.core.units import describe
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.system.spec import CageSpeed

if TYPE_CHECKING:
    from flexcage.case.static import StaticCase

Said = tuple[str, str]  # key of a warning, and its sentence

ODD, OTHER_STEEL, FIT = "odd_value", "other_steel", "fit"
_STEEL = 0.1  # by which a modulus may differ from bearing steel's before ratings are another's
_THINNEST = 0.02  # of the element's diameter, a fifth of what sheet and webs have (assumption)
_FLATTEST = radians(1.0)  # contact angle; no catalogue has less than 10 deg
_ROUGHEST = 0.005  # of the element's diameter, ten times the waves of a bad race (assumption)


@dataclass(frozen=True)
class Usual:
    """Between which values a constant of solids lies, with those at both ends; ``slips``: factors
    by which a confused unit or a lost digit leaves it."""

    name: str
    unit: str
    least: float
    most: float
    ends: str
    slips: tuple[float, ...]


_THOUSANDS = (1e3, 1e-3, 1e6, 1e-6)
_OF_SOLIDS = (
    Usual("youngs_modulus", "GPa", 0.3e9, 1.2e12, "PTFE has 0.5 GPa, diamond 1100 GPa", _THOUSANDS),
    Usual("density", "kg/m^3", 800.0, 2.3e4, "polymers have 900 kg/m^3, tungsten 19300 kg/m^3",
          _THOUSANDS),
    Usual("poisson_ratio", "", 0.05, 0.48, "diamond has 0.07, steel 0.3, polymers up to 0.46",
          (10.0, 0.1)),
    Usual("proof_stress", "MPa", 5e6, 6e9, "PTFE has 10 MPa, hardened steel 2000 MPa", _THOUSANDS),
)  # fmt: skip
# by body: rings and elements of the softest polymer have 1 GPa
_RINGS = (Usual("youngs_modulus", "GPa", 1e9, 1.2e12, "polymer rings have 2 GPa, steel 206 GPa",
                _THOUSANDS), *_OF_SOLIDS[1:3])  # fmt: skip


_OF_LUBRICANTS = (
    Usual("viscosity", "mPa*s", 1e-4, 10.0, "thin fuels have 1 mPa*s, heavy oils 1000 mPa*s",
          _THOUSANDS),
    Usual("pressure_coefficient", "1/GPa", 0.3e-9, 1e-7, "water has 0.5 1/GPa, oils 10 to 35 1/GPa",
          _THOUSANDS),
    Usual("density", "kg/m^3", 50.0, 3000.0, "oils have 800 to 1000 kg/m^3", _THOUSANDS),
)  # fmt: skip
_COEFFICIENTS = ("static", "dynamic", "peak", "high_speed", "limit")
_MOST_FRICTION = 1.5  # of dry metals in vacuum; percents are beyond
_TWO = ("step_coulomb", "decay_coulomb")  # friction laws that fall from rest to sliding
_EARTH = (9.7, 9.9)  # m/s^2


def implausible_values(case: StaticCase) -> Iterator[Said]:
    """Keys and sentences of warnings on the values of a case."""
    for where, material, usual in _bodies(case):
        yield from ((ODD, text) for text in _implausible_constants(where, material, usual))
    yield from ((ODD, text) for text in _rough_races(case))
    yield from ((ODD, text) for text in _thin_cage(case))
    yield from ((ODD, text) for text in _flat_contact(case))
    yield from ((ODD, text) for text in _implausible_lubricant(case))
    yield from ((ODD, text) for text in _implausible_friction(case))
    yield from ((ODD, text) for text in _implausible_gravity(case))
    yield from ((ODD, text) for text in _cage_at_rest(case))
    yield from ((FIT, text) for text in questioned_fit(case))
    yield from _of_other_steel(case)


def _thin_cage(case: Any) -> Iterator[str]:
    """A cage thinner than any is made, as where too many elements leave it no webs."""
    cage, bearing = getattr(case, "cage", None), case.bearing
    if cage is None:
        return
    count, element = bearing.element_count, bearing.element
    for name, size in cage.parts(bearing.pitch_diameter, count).items():
        if size < _THINNEST * bearing.element_diameter:
            yield (
                f"The cage's {name} have {describe(size, 'mm')} at their thinnest, for {element}s "
                f"of {describe(bearing.element_diameter, 'mm')}: are {count} {element}s meant?"
            )


def _flat_contact(case: StaticCase) -> Iterator[str]:
    """A contact angle in radians that was given as degrees."""
    angle = getattr(case.bearing, "contact_angle", None)
    if isinstance(angle, float) and 0.0 < angle < _FLATTEST and degrees(degrees(angle)) < 60.0:
        yield (
            f"bearing.contact_angle is {describe(angle, 'deg')}, where angular contact bearings "
            f"have 10 to 40 deg; is {degrees(angle):.3g} rad meant?"
        )


def _bodies(case: Any) -> Iterator[tuple[str, Material, tuple[Usual, ...]]]:
    """Key and material of every body that has one, and between what its constants usually are."""
    if own := getattr(case.bearing, "material", None):
        yield "bearing.material", own, _RINGS
    if rolling := getattr(case.bearing, "element_material", None):
        yield "bearing.element_material", rolling, _RINGS
    for name in ("inner_ring", "outer_ring"):
        ring = getattr(case, name)
        if ring.bends and ring.material is not None:
            yield f"{name}.material", ring.material, (*_RINGS[:1], *_RINGS[2:])
    for name in ("shaft_material", "housing_material") if case.fit.given else ():
        yield f"fit.{name}", getattr(case.fit, name), _OF_SOLIDS[:3]
    if cage := getattr(case, "cage", None):
        yield "cage.material", cage.material, _OF_SOLIDS


def _implausible_lubricant(case: StaticCase) -> Iterator[str]:
    yield from _implausible_constants("lubricant", case.lubricant, _OF_LUBRICANTS, "any lubricant")


def _implausible_friction(case: StaticCase) -> Iterator[str]:
    """Coefficients in percent, and those of rest and sliding exchanged, where a law reads them."""
    for place in sorted(case.bearing.places):
        law = getattr(case.contacts, place).friction
        where = f"contacts.{place}.friction"
        coefficients = [f for f in dataclasses.fields(law) if f.name in _COEFFICIENTS]
        read = {
            f.name: getattr(law, f.name)
            for f in coefficients
            if law.law in (f.metadata.get("of") or (law.law,))
        }
        for name, value in read.items():
            if value > _MOST_FRICTION:
                yield (
                    f"{where}.{name} is {value:.6g}, above any coefficient of friction of bearings "
                    f"(dry metals have up to 1); is {value / 100.0:.6g} meant?"
                )
        if law.law in _TWO and law.static < law.dynamic <= _MOST_FRICTION:
            yield (
                f"{where}.static is {law.static:.6g}, below its dynamic, {law.dynamic:.6g}, where "
                "friction is larger at rest than in sliding; are they exchanged?"
            )


def _implausible_gravity(case: StaticCase) -> Iterator[str]:
    gravity = case.load.gravity
    if _EARTH[0] < 1e-3 * gravity < _EARTH[1]:
        yield (
            f"load.gravity is {describe(gravity, 'm/s^2')}, a thousand times the Earth's; is "
            f"{describe(1e-3 * gravity, 'm/s^2')} meant?"
        )


def _cage_at_rest(case: Any) -> Iterator[str]:
    """A constraint on the cage's speed that names none, and so holds it still."""
    for i, held in enumerate(getattr(case, "constraints", ())):
        if isinstance(held, CageSpeed) and not (held.speed or held.ratio):
            yield (
                f"constraints.{i} (cage_speed) has neither speed nor ratio, and holds the cage "
                "still; is a speed meant?"
            )


def _implausible_constants(
    where: str, material: Any, constants: tuple[Usual, ...], of: str = "any solid of bearings"
) -> Iterator[str]:
    for usual in constants:
        value = getattr(material, usual.name)
        if value == 0.0 or usual.least <= value <= usual.most or value == float("inf"):
            continue
        probably = next(
            (value * f for f in usual.slips if usual.least <= value * f <= usual.most), None
        )
        meant = f"; is {_text(probably, usual.unit)} meant?" if probably is not None else "."
        yield (
            f"{where}.{usual.name} is {_text(value, usual.unit)}, "
            f"{'below' if value < usual.least else 'above'} that of {of} "
            f"({usual.ends}){meant}"
        )


def _text(value: float, unit: str) -> str:
    return describe(value, unit) if unit else f"{value:.6g}"


def _rough_races(case: StaticCase) -> Iterator[str]:
    bearing = case.bearing
    element = bearing.element
    for name, what in (
        ("inner_waviness", "waves of ground races have 0.01 to 5 um"),
        ("outer_waviness", "waves of ground races have 0.01 to 5 um"),
        (f"{element}_scatter", f"{element}s of one bearing differ by less than 2 um"),
    ):
        value = getattr(bearing, name, 0.0)
        if value and value > _ROUGHEST * (diameter := bearing.element_diameter):
            yield (
                f"bearing.{name} is {describe(value, 'um')}, for {element}s of "
                f"{describe(diameter, 'mm')}: {what}."
            )


def _of_other_steel(case: StaticCase) -> Iterator[Said]:
    """Ratings and raceways of a material that is no bearing steel."""
    own = getattr(case.bearing, "material", None)
    if own is None:  # of a bearing of one's own
        return
    steel = MATERIALS["GCr15"].plane_strain_modulus
    if abs(own.plane_strain_modulus / steel - 1.0) > _STEEL:
        yield (
            OTHER_STEEL,
            "Ratings and lives are those of bearing steel (ISO 76, ISO 281), but bearing.material "
            f"is {own.name}, with {describe(own.youngs_modulus, 'GPa')}.",
        )
    elements = case.bearing.rolling_material
    if elements.plane_strain_modulus > (1.0 + _STEEL) * steel >= own.plane_strain_modulus:
        yield (
            OTHER_STEEL,
            f"bearing.element_material is {elements.name}: C is that of steel "
            f"{case.bearing.element}s, the same for silicon nitride (ISO 20056-1); C0 and C_u are "
            f"{case.bearing.stress_share:.2f} of theirs, the loads that press as hard (Hertz), and "
            "ISO 20056-2 allows slightly more.",
        )
    for name in ("inner_ring", "outer_ring"):
        ring = getattr(case, name)
        if not ring.bends or ring.material is None:
            continue
        if ring.material.plane_strain_modulus != own.plane_strain_modulus:
            yield (
                OTHER_STEEL,
                f"{name}.material ({ring.material.name}) makes the ring bend as it says, but "
                f"contacts with the ring, and their films, have the moduli of bearing.material "
                f"({own.name}).",
            )
