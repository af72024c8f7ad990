"""The spec of heat: where it leaves a bearing, how well, and when temperatures have settled."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from flexcage.core.spec import option, quantity

LOSSES = ("static", "run")  # where losses are from


def _conductance(doc: str, by: str) -> Any:
    return quantity("W/K", None, doc=f"conductance {doc} (default: {by})", minimum=0.0)


@dataclass(frozen=True, kw_only=True)
class Heat:
    """How heat leaves a bearing (``flexcage warm``): conductances, oil, and further sources.

    A conductance that is not given follows from size and speed (``geometry.heat.correlations``).
    The oil's viscosity over temperature is that of life.viscosity_40 and viscosity_100; the search
    begins at life.temperature.
    """

    elsewhere: ClassVar[Mapping[str, str]] = {
        "(.*_)?(viscosit(y|ies)|nu|vg).*": "viscosities over temperature are life.viscosity_40 and "
        "life.viscosity_100",
        "(start|initial|oil)_temperature": "the search begins at life.temperature",
        "(ambient|environment|room|air)_temperature": "heat.ambient is the temperature around",
        "seals?(_friction|_moment)?|friction_of_seals": "heat.seal_torque is the torque of seals",
        "churning(_loss.*)?|stirring.*": "heat.churning_torque is the torque of churning",
        "(limit|maximum|max)(_temperature)?": "heat.oil_limit and heat.steel_limit are limits",
    }

    losses: str = option(
        "static", choices=LOSSES,
        doc="where losses are from: the static solution, without pockets and lands, or short runs",
    )  # fmt: skip
    ambient: float = quantity("degC", 293.15, doc="temperature around shaft and housing", above=0.0)
    shaft_ambient: float | None = _conductance(
        "from the shaft to what is around", "ISO 15312's of its seat"
    )
    housing_ambient: float | None = _conductance(
        "from the housing to what is around", "ISO 15312's of its seat"
    )
    inner_shaft: float | None = _conductance("of the inner ring's seat", "its area and seat_joint")
    outer_housing: float | None = _conductance(
        "of the outer ring's seat", "its area and seat_joint"
    )
    inner_elements: float | None = _conductance(
        "of all contacts with the inner race", "rolling contacts with their films"
    )
    outer_elements: float | None = _conductance("of those with the outer race", "likewise")
    inner_oil: float | None = _conductance("from the inner ring to the oil", "laminar flow")
    outer_oil: float | None = _conductance("from the outer ring to the oil", "likewise")
    elements_oil: float | None = _conductance("from the elements to the oil", "likewise")
    cage_oil: float | None = _conductance("from the cage to the oil", "likewise")
    oil_housing: float = quantity(
        "W/K", 0.0, doc="conductance from the oil to the housing's walls", minimum=0.0,
        assumption="none: oil that splashes on walls takes more heat there",
    )  # fmt: skip
    seat_joint: float = quantity(
        "W/(m^2*K)", 5000.0, doc="conductance per area of the joint of a ring and its seat",
        above=0.0,
        assumption="steel on steel in air has 2500 to 14000 W/(m^2 K) at 0.1 to 10 MPa (order of "
        "Incropera's table of joints, from memory)",
    )  # fmt: skip
    oil_flow: float = quantity(
        "l/min", 0.0, doc="flow of oil that carries heat away; 0: none leaves", minimum=0.0
    )
    oil_inlet: float | None = quantity(
        "degC", None, doc="temperature of the oil that comes (default: ambient)", above=0.0
    )
    oil_conductivity: float = quantity(
        "W/(m*K)", 0.14, doc="thermal conductivity of the oil", above=0.0,
        assumption="mineral oils have 0.12 to 0.15 W/(m K)",
    )  # fmt: skip
    oil_capacity: float = quantity(
        "J/(kg*K)", 2000.0, doc="specific heat of the oil", above=0.0,
        assumption="mineral oils have 1900 to 2200 J/(kg K) at 40 to 100 C",
    )  # fmt: skip
    ring_conductivity: float = quantity(
        "W/(m*K)", 45.0, doc="thermal conductivity of the rings", above=0.0,
        assumption="bearing steel (100Cr6) has 40 to 46 W/(m K)",
    )  # fmt: skip
    ring_capacity: float = quantity(
        "J/(kg*K)", 470.0, doc="specific heat of the rings", above=0.0,
        assumption="bearing steel",
    )  # fmt: skip
    element_conductivity: float | None = quantity(
        "W/(m*K)", None, doc="thermal conductivity of rolling elements (default: the rings'; "
        "silicon nitride has 30)", above=0.0,
    )  # fmt: skip
    element_capacity: float | None = quantity(
        "J/(kg*K)", None, doc="specific heat of rolling elements (default: the rings'; silicon "
        "nitride has 700)", above=0.0,
    )  # fmt: skip
    seal_torque: float = quantity("N*m", 0.0, doc="torque of seals", minimum=0.0)
    churning_torque: float = quantity(
        "N*m", 0.0, doc="torque of churning beside the drag of elements", minimum=0.0
    )
    shaft_heat: float = quantity("W", 0.0, doc="heat that comes into the shaft, as of a motor")
    housing_heat: float = quantity("W", 0.0, doc="heat that comes into the housing")
    oil_limit: float = quantity(
        "degC", 423.15, doc="temperature that the oil bears", above=0.0,
        assumption="mineral oils age within hours above 120 to 150 C",
    )  # fmt: skip
    steel_limit: float = quantity(
        "degC", 423.15, doc="temperature that rings and elements bear", above=0.0,
        assumption="rings of stabilisation S0 keep their size up to 150 C; others up to 120 C",
    )  # fmt: skip
    tolerance: float = quantity(
        "K",
        1.0,
        doc="change of any temperature from where they have settled",
        above=0.0,
        maximum=20.0,
    )
    iterations: int = option(30, doc="most iterations", minimum=1, maximum=1000)

    @property
    def given(self) -> bool:
        """Does it say anything?"""
        return self != Heat()
