"""The spec of a modified rating life, and of the load spectrum that it is asked for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from flexcage.core.spec import GIVEN, option, quantity


@dataclass(frozen=True, kw_only=True)
class LoadPoint:
    """A part of the operating time: its speed, load and temperature."""

    share: float = option(doc="share of the time", minimum=0.0, maximum=1.0)
    speed: float = quantity("rpm", doc="speed of the inner ring")
    radial: float = quantity("N", 0.0, doc="radial load", minimum=0.0)
    axial: float = quantity("N", 0.0, doc="axial load, along +x")
    temperature: float | None = quantity(
        "degC", None, doc="of the oil (default: life.temperature)", above=0.0
    )


_OIL = {"viscosity_40": GIVEN, "viscosity_100": GIVEN}


@dataclass(frozen=True, kw_only=True)
class Life:
    """How life is quoted: L_nm of ISO 281 and L_nmr of ISO/TS 16281, beside L10 and L10r.

    Without ``contamination`` there is no a_ISO. The oil is that of [lubricant] (its viscosity over
    its density), or one of two viscosities, whose own at a temperature follows from ASTM D341.
    """

    elsewhere: ClassVar[Mapping[str, str]] = {
        "(e_?c|eta_?c|cleanliness|contamination_factor)": "e_C is life.contamination",
        "(c_?u|p_?u|fatigue_limit)": "C_u is life.fatigue_load_limit",
        "(a_?1|probability|failure.*)": "life.reliability in percent gives a_1",
        "(grease.*|f10.*)": "flexcage computes no grease life: no formula of it is public enough",
        "(kappa|viscosity_ratio)": "kappa follows from the lubricant's viscosity",
        "(spectra|points?|loads?|duty.*)": "a spectrum is [[life.spectrum]], one table a point",
    }

    reliability: float = option(
        90.0, doc="percent of bearings that reach the life (a_1 of ISO 281): 90, 95 to 99.95"
    )
    contamination: float | None = option(
        None, doc="contamination factor e_C of ISO 281: 1 extreme cleanliness, 0.5 to 0.8 normal, "
        "0 very severe; none: no a_ISO",
        minimum=0.0, maximum=1.0,
    )  # fmt: skip
    fatigue_load_limit: float | None = quantity(
        "kN", None, doc="fatigue load limit C_u (default: from C0, as ISO 281's annex B has it)",
        above=0.0,
    )  # fmt: skip
    additives: bool = option(
        False, doc="has the oil proven extreme-pressure additives, which ISO 281 credits below "
        "kappa = 1?",
    )  # fmt: skip
    temperature: float | None = quantity("degC", None, doc="of the oil", above=0.0, when=_OIL)
    viscosity_40: float | None = quantity(
        "mm^2/s", None, doc="kinematic viscosity of the oil at 40 degC", above=0.0
    )
    viscosity_100: float | None = quantity("mm^2/s", None, doc="the same at 100 degC", above=0.0)
    inlet: float | None = quantity(
        "um", None, doc="distance of the oil's edge from the middle of the heaviest contacts, in "
        "the rolling direction: starves the film; none: flooded",
        above=0.0,
    )  # fmt: skip
    spectrum: tuple[LoadPoint, ...] = option(
        (), doc="points of a load spectrum, whose shares add up to 1"
    )

    @property
    def given(self) -> bool:
        """Does it say anything?"""
        return self != Life()
