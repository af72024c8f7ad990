"""The spec of how a bearing sits: fits, temperatures and speed, which leave it its clearance."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from flexcage.core.spec import option, quantity
from flexcage.geometry.materials import MATERIALS, Material

CLASSES = ("C2", "CN", "C3", "C4", "C5")
ROUGH = "roughness"
#: How much of an interference smoothing takes: by the roughness of both seats (DIN 7190-1), or by
#: the rule of bearing makers, d/(d + 2) and d/(d + 3) of it are left, d in mm.
SMOOTHINGS: Mapping[str, float] = {"ground": 2.0, "turned": 3.0, ROUGH: 0.0, "none": 0.0}
AT = ("mean", "least", "largest")
_ROUGH = {"smoothing": (ROUGH,)}


@dataclass(frozen=True, kw_only=True)
class Fit:
    """How rings sit on shaft and in housing, and how warm and fast all of it is.

    Any value of it makes the bearing's clearance, contact angle and races those before mounting;
    what is left in operation follows (``geometry.fits.mounting``) and is what everything else
    reads. Interferences are those of the diameters, before surfaces are smoothed; a code of ISO 286
    gives them with the bearing's tolerances of class Normal (ISO 492).
    """

    elsewhere: ClassVar[Mapping[str, str]] = {
        "(outer_|inner_)?(fit|tolerance|code)s?":
            'fit.shaft = "k5" and fit.housing = "H7" are codes of ISO 286',
        "(radial_)?(internal_)?clearance_(class|group)|class": 'fit.clearance = "C3" is one',
        "shaft_(inner_diameter|hole)": "fit.shaft_bore is the bore of a hollow shaft",
        "(shaft|housing)_(diameter|outer_diameter)":
            "seats have the bearing's bore and outside diameter; fit.housing_thickness is the wall",
    }  # fmt: skip

    clearance: str | None = option(
        None, choices=CLASSES,
        doc="class of radial clearance before mounting (ISO 5753-1), in place of bearing."
        "radial_clearance",
    )  # fmt: skip
    shaft: str = option("", doc="tolerance of the shaft, such as k5 (ISO 286)")
    shaft_interference: float | None = quantity(
        "um", None, doc="interference of shaft and bore, in place of a code; < 0: a gap"
    )
    housing: str = option("", doc="tolerance of the housing's bore, such as H7 (ISO 286)")
    housing_interference: float | None = quantity(
        "um", None, doc="interference of outer ring and housing, in place of a code; < 0: a gap"
    )
    at: str = option(
        "mean", doc="where in the tolerances of clearance and seats the bearing is", choices=AT
    )
    preload: bool = option(False, doc="is a clearance below zero meant? no warning then")
    smoothing: str = option(
        "ground", doc="how seats were finished, which says how much of an interference they lose",
        choices=tuple(SMOOTHINGS),
    )  # fmt: skip
    shaft_roughness: float = quantity(
        "um", 4e-6, doc="roughness Rz of the shaft's seat", minimum=0.0, when=_ROUGH,
        assumption="a ground seat, Ra 0.8 um",
    )  # fmt: skip
    housing_roughness: float = quantity(
        "um", 6.3e-6, doc="roughness Rz of the housing's bore", minimum=0.0, when=_ROUGH,
        assumption="a finely turned bore, Ra 1.6 um",
    )  # fmt: skip
    bearing_roughness: float = quantity(
        "um", 2e-6, doc="roughness Rz of the bearing's bore and outside", minimum=0.0, when=_ROUGH,
        assumption="ground rings, Ra 0.4 um",
    )  # fmt: skip
    shaft_bore: float = quantity("mm", 0.0, doc="bore of a hollow shaft; 0: solid", minimum=0.0)
    housing_thickness: float | None = quantity(
        "mm", None, doc="wall of the housing around the ring; none: a thick block", above=0.0
    )
    shaft_material: Material = option(MATERIALS["steel"], doc="material of the shaft")
    housing_material: Material = option(MATERIALS["steel"], doc="material of the housing")
    assembly_temperature: float = quantity(
        "degC", 293.15, doc="temperature at which seats and clearance were measured", above=0.0
    )
    inner_temperature: float | None = quantity(
        "degC", None, doc="of the inner ring (default: as at assembly)", above=0.0
    )
    outer_temperature: float | None = quantity(
        "degC", None, doc="of the outer ring (default: as at assembly)", above=0.0
    )
    element_temperature: float | None = quantity(
        "degC", None, doc="of the rolling elements (default: the mean of both rings')", above=0.0
    )
    shaft_temperature: float | None = quantity(
        "degC", None, doc="of the shaft (default: the inner ring's)", above=0.0
    )
    housing_temperature: float | None = quantity(
        "degC", None, doc="of the housing (default: the outer ring's)", above=0.0
    )
    at_speed: float | None = quantity(
        "rpm", None, doc="speed at which inner ring and shaft grow (default: the fastest of "
        "[drive])",
    )  # fmt: skip

    @property
    def given(self) -> bool:
        """Does it say anything?"""
        return self != Fit()

    @property
    def warmth(self) -> Mapping[str, float]:
        """By body, how much warmer [K] than at assembly it is."""
        start = self.assembly_temperature
        inner, outer = (
            0.0 if t is None else t - start
            for t in (self.inner_temperature, self.outer_temperature)
        )

        def of(temperature: float | None, otherwise: float) -> float:
            return otherwise if temperature is None else temperature - start

        return {
            "shaft": of(self.shaft_temperature, inner),
            "inner": inner,
            "element": of(self.element_temperature, 0.5 * (inner + outer)),
            "outer": outer,
            "housing": of(self.housing_temperature, outer),
        }
