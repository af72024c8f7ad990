"""Specs of contacts: which law at which place, with which numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from flexcage.core.spec import OtherThan, option, quantity
from flexcage.geometry.bearing import RingLand
from flexcage.geometry.film import Oil
from flexcage.geometry.other_kinds import SURROUNDINGS

# Names of laws, and the spec that a name brings along, None for the one below; ``contacts.laws``
# registers further ones.
NORMAL_LAWS: dict[str, type | None] = dict.fromkeys(
    ("restitution", "lankarani_nikravesh", "impact_step", "elastic")
)
FRICTION_LAWS: dict[str, type | None] = dict.fromkeys(
    ("traction", "step_coulomb", "ramp_coulomb", "none")
)
MOST_FRICTION = 100.0  # coefficient: clean metals in air have about 1; tests of limits take more
_RETURNS, _IMPACTS = ("restitution", "lankarani_nikravesh"), ("impact_step", "impact")
_STEPS = ("step_coulomb", "ramp_coulomb")
_COULOMB = (*_STEPS, "decay_coulomb")
_CREEP_END = {  # by law, the speed's field
    "step_coulomb": "v_static", "ramp_coulomb": "v_dynamic", "decay_coulomb": "v_static",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class NormalLaw:
    """Normal force from penetration and its rate; stiffness follows from geometry and materials.

    ``restitution``: F = K d^n (1 + (lambda/v0) d'), lambda from the exact relation to e, v0 the
    approach speed at the contact's onset (not below ``speed_floor``); ``lankarani_nikravesh``: the
    same with 3 (1 - e^2)/4 for lambda, right near e = 1, while bodies rebound faster than a small e
    says (H. M. Lankarani and P. E. Nikravesh, J. Mech. Des. 112 (1990) 369); ``impact_step``:
    F = K d^n + STEP(d, 0, 0, full_damping_depth, damping) d' (ADAMS IMPACT); ``elastic``: no
    damping. Forces are clipped at zero.
    """

    law: str = option("restitution", doc="name of the law", choices=NORMAL_LAWS)
    restitution: float = option(
        0.9, doc="coefficient of restitution e", minimum=0.01, maximum=1.0, of=_RETURNS,
        assumption="no source gives one: 0.9 for oiled steel on steel, 0.7 elsewhere",
    )  # fmt: skip
    speed_floor: float = quantity(
        "m/s", 0.05, doc="least onset speed v0", above=0.0, of=_RETURNS,
        assumption="bounds the damping",
    )  # fmt: skip
    damping: float = quantity(
        "N*s/m", 0.0, doc="full damping of a whole contact", minimum=0.0, of=_IMPACTS
    )
    full_damping_depth: float = quantity(
        "mm", 1e-5, doc="depth of full damping", above=0.0, of=_IMPACTS,
        assumption="0.01 mm, as in the published ADAMS model of examples/papers/c7010_centroid",
    )  # fmt: skip
    stiffness_factor: float = option(
        1.0, doc="multiplies the computed stiffness (studies)", minimum=1e-6, maximum=1e6
    )

    def elastic(self, stiffness: float, exponent: float) -> tuple[float, float]:
        """Stiffness [N/m^exponent] and exponent of a whole contact's elastic force, from those that
        geometry and materials make."""
        return stiffness, exponent

    def shared_by(self, parts: int) -> NormalLaw:
        """The law of one of so many equal parts (slices, points) of a contact, which share its
        damping."""
        return replace(self, damping=self.damping / parts) if parts > 1 else self


@dataclass(frozen=True, kw_only=True)
class OwnImpact(NormalLaw):
    """``impact_step`` with a stiffness and an exponent of one's own, as ADAMS' IMPACT takes them:

    F = K d0 (d/d0)^exponent with d0 = 1 mm, so K in N/mm is ADAMS' number in its units of N and mm.
    """

    law: str = option("impact", doc="name of the law", choices=NORMAL_LAWS)
    stiffness: float = quantity(
        "N/mm", 1e8, doc="force over penetration at a penetration of 1 mm", above=0.0,
        assumption="1e5 N/mm, ADAMS's default of IMPACT",
    )  # fmt: skip
    exponent: float = option(
        2.2, doc="exponent of the elastic force", minimum=1.0, maximum=4.0,
        assumption="ADAMS's default of IMPACT",
    )  # fmt: skip

    def elastic(self, stiffness: float, exponent: float) -> tuple[float, float]:
        """The law's own numbers in place of the computed ones."""
        return self.stiffness * _ONE_MM ** (1.0 - self.exponent), self.exponent


_ONE_MM = 1e-3  # m, the penetration at which ``OwnImpact`` has its stiffness
NORMAL_LAWS["impact"] = OwnImpact


@dataclass(frozen=True, kw_only=True)
class FrictionLaw:
    """Friction coefficient against sliding speed.

    ``traction``: Gupta's (A + B u) exp(-C u) + D through 0, the maximum ``peak`` at
    ``peak_speed`` and ``high_speed`` for large u; ``step_coulomb``: ADAMS static/dynamic with
    cubic steps; ``ramp_coulomb``: Ambrosio's ramp from v_static to v_dynamic.
    """

    law: str = option("step_coulomb", doc="name of the law", choices=FRICTION_LAWS)
    static: float = option(
        0.1, doc="static coefficient", minimum=0.0, maximum=MOST_FRICTION, of=_COULOMB,
        assumption="published bearing models take 0.1 to 0.15 (Symmetry 2025, 17(10), 1761)",
    )  # fmt: skip
    dynamic: float = option(
        0.05, doc="dynamic coefficient", minimum=0.0, maximum=MOST_FRICTION, of=_COULOMB,
        assumption="of greased steel in ADAMS's table of contacts; 0.02 at the cage in Symmetry "
        "2025, 17(10), 1761, 0.1 in thin films",
    )  # fmt: skip
    v_static: float = quantity(
        "m/s", 0.1, doc="speed of the static peak", above=0.0, of=_COULOMB,
        assumption="ADAMS's default; published models give none",
    )  # fmt: skip
    v_dynamic: float = quantity(
        "m/s", 1.0, doc="speed of full dynamic friction", above=0.0, of=_STEPS,
        assumption="ADAMS's default; published models give none",
    )  # fmt: skip
    peak: float = option(
        0.05, doc="traction maximum", minimum=0.0, maximum=MOST_FRICTION, of=("traction",),
        assumption="mineral oils have 0.04 to 0.08, and no oil is given; the curve is Gupta's",
    )  # fmt: skip
    peak_speed: float = quantity(
        "m/s", 0.3, doc="sliding speed of the maximum", above=0.0, of=("traction",),
        assumption="about 2 % of a rolling speed of 13 m/s; loaded slip follows from it",
    )  # fmt: skip
    high_speed: float = option(
        0.03, doc="traction at large sliding speed", minimum=0.0, maximum=MOST_FRICTION,
        of=("traction",),
        assumption="less than the peak, as heat thins the film; no source says how much",
    )  # fmt: skip

    @property
    def creeps_below(self) -> float | None:
        """Sliding speed [m/s] below which the law only creeps, so that slip under it says nothing;
        None for a law whose rise from rest is the physics.

        ``step_coulomb`` and ``decay_coulomb`` creep up to their static peak; ``ramp_coulomb``,
        which has no force at all below v_static, up to its full force at v_dynamic.
        """
        end = _CREEP_END.get(self.law)
        return getattr(self, end) if end else None

    @property
    def rises_below(self) -> float | None:
        """Sliding speed [m/s] up to which traction rises from rest, so that slip under it is set
        by the slope of that rise; None for a law without one."""
        return self.peak_speed if self.law == "traction" else None


@dataclass(frozen=True, kw_only=True)
class EhlTraction(FrictionLaw):
    """Traction of an elastohydrodynamic film: mu = limit (1 - exp(-u/creep_speed)).

    Shear stress of a film between its modulus and its limiting stress (S. Bair and W. O. Winer, J.
    Lubr. Tech. 101 (1979) 258), with one slope for the contact; ``flexcage.ehl_traction`` gives it
    from film, pressure and speed.
    """

    law: str = option("ehl", doc="name of the law", choices=FRICTION_LAWS)
    limit: float = option(
        0.06, doc="limiting shear stress over pressure", minimum=1e-6, maximum=MOST_FRICTION,
        assumption="0.04 to 0.08 for mineral oils",
    )  # fmt: skip
    creep_speed: float = quantity(
        "m/s", 0.1, doc="sliding speed at which the slope at rest meets the limit", above=0.0,
        assumption="flexcage.ehl_traction finds it from film, pressure and speed",
    )  # fmt: skip

    @property
    def rises_below(self) -> float | None:
        """Sliding speed [m/s] up to which traction rises nearly linearly."""
        return self.creep_speed if self.law == "ehl" else None


@dataclass(frozen=True, kw_only=True)
class DecayFriction(FrictionLaw):
    """Coulomb's two coefficients with an exponential between them:

    mu = dynamic + (static - dynamic) exp(-decay u), the law of LS-DYNA's contacts (Keyword User's
    Manual, *CONTACT: FS, FD, DC; DC is 0 there unless it is given, so that static acts at any
    speed). Below ``v_static`` a cubic step from rest, as ``step_coulomb`` has, takes the place of
    LS-DYNA's sticking spring.
    """

    law: str = option("decay_coulomb", doc="name of the law", choices=FRICTION_LAWS)
    decay: float = quantity("s/m", 0.0, doc="decay DC of static to dynamic friction", minimum=0.0)


FRICTION_LAWS["ehl"] = EhlTraction
FRICTION_LAWS["decay_coulomb"] = DecayFriction


FEWEST_SLICES, MOST_SLICES = 3, 128


@dataclass(frozen=True, kw_only=True)
class PairSpec:
    """A contact place: its normal law, its friction law, and how finely it is cut."""

    normal: NormalLaw = option(NormalLaw(), doc="normal law")
    friction: FrictionLaw = option(FrictionLaw(), doc="friction law")
    slices: int = option(
        16,
        doc="slices along a roller, strips of a ball's contact ellipse; multiples of 8 are fast",
        minimum=FEWEST_SLICES,
        maximum=MOST_SLICES,
    )


_MEETS = {"kind": OtherThan(("none",))}
_NO_LAND = (0.25e-3, 3.5e-3)  # m, clearance and width of a land that meets nothing
_OF_FACING = 0.9  # width of a land over the length on which cage and ring face each other


@dataclass(frozen=True, kw_only=True)
class LandSpec:
    """Cage land against the ring land it is guided by, or may touch; in ball bearings also the
    cage against shoulders of rings that do not guide it, dry, over the gap that they leave.

    What is not given follows from the dimensions of cage and ring (``on``).
    """

    kind: str = option("dry", doc="land contact", choices=("none", "dry", "film"))
    clearance: float | None = quantity(
        "mm",
        None,
        doc="radial land clearance; by default what cage and ring leave",
        above=0.0,
        when=_MEETS,
    )
    width: float | None = quantity(
        "mm", None, doc="width of one land; by default nine tenths of what faces the ring",
        above=0.0, when=_MEETS,
        assumption="nine tenths of where an end of the cage faces the ring, to two digits; the "
        "rest are rounded edges",
    )  # fmt: skip
    normal: NormalLaw = option(NormalLaw(restitution=0.7), doc="normal law", when=_MEETS)
    friction: FrictionLaw = option(
        FrictionLaw(static=0.1, dynamic=0.05), doc="friction law", when=_MEETS
    )

    def on(self, ring: RingLand | None) -> LandSpec:
        """The same with clearance and width as numbers, from where cage and ring face each other.

        Where they meet nowhere, the numbers are ones that no contact reads.
        """
        clearance, width = _NO_LAND
        if ring is not None:
            clearance = clearance if ring.clearance is None else ring.clearance
            width = float(f"{_OF_FACING * ring.facing:.2g}") if ring.facing > 0.0 else width
        return replace(
            self,
            kind="none" if ring is not None and ring.facing <= 0.0 else self.kind,
            clearance=clearance if self.clearance is None else self.clearance,
            width=width if self.width is None else self.width,
        )


@dataclass(frozen=True, kw_only=True)
class Contacts:
    """All contact places; "roller" is any rolling element. Balls have no side and no rib."""

    race: PairSpec = option(
        PairSpec(friction=FrictionLaw(law="traction")), doc="roller against both races"
    )
    pocket: PairSpec = option(
        PairSpec(normal=NormalLaw(restitution=0.7), slices=64), doc="roller against crossbeams"
    )
    side: PairSpec = option(
        PairSpec(normal=NormalLaw(restitution=0.7)), doc="roller end against side beams"
    )
    rib: PairSpec = option(
        PairSpec(normal=NormalLaw(restitution=0.7)), doc="roller end against ribs"
    )
    land: LandSpec = option(LandSpec(), doc="cage land")


@dataclass(frozen=True, kw_only=True)
class Lubricant:
    """Lubricant and what it does apart from traction: rolling resistance and drag."""

    elsewhere: ClassVar[Mapping[str, str]] = SURROUNDINGS

    name: str = option(
        "ISO VG 32 at 70 C", doc="name", assumption="neither oil nor temperature is given"
    )
    viscosity: float = quantity(
        "Pa*s", 0.01, doc="dynamic viscosity", above=0.0,
        assumption="ISO 3448, ASTM D341: an ISO VG 32 at 67 C; 0.0093 Pa*s at 70 C, grade +-10 %",
    )  # fmt: skip
    pressure_coefficient: float = quantity(
        "1/GPa", 2e-8, doc="pressure-viscosity", above=0.0,
        assumption="light machine oils have 17.5 to 19.5 1/GPa where they have 0.01 Pa*s "
        "(Stachowiak, Batchelor, Engineering Tribology, table 2.3)",
    )  # fmt: skip
    density: float = quantity(
        "kg/m^3", 860.0, doc="density", above=0.0,
        assumption="mineral oils have 865 to 880 kg/m^3 at 15 C: this is one near 30 C",
    )  # fmt: skip
    oil_fraction: float = option(
        0.01, doc="oil volume fraction in the space", minimum=0.0, maximum=1.0,
        assumption="drip or oil-air: 1.25 cm^3/min leave as much in a bore of 65 mm at 6000 rpm by "
        "Parker's formula (NASA TP-2275, 1984); a jet's 0.1 to 1 l/min 5 to 12 %",
    )  # fmt: skip
    rolling_resistance: str = option(
        "blended", doc="rolling resistance", choices=("none", "goksem_hargreaves", "blended"),
        assumption="Goksem and Hargreaves (1978) for rollers, Houpert for balls, isothermal and "
        "flooded: heat and starvation would lower it",
    )  # fmt: skip
    drag_coefficient: float = option(
        0.4, doc="C_D of a shadowed rolling element", minimum=0.0, maximum=100.0,
        assumption="a free ball has 0.42 (Schiller, Naumann 1933), a free cylinder about 1; "
        "neighbours shadow both",
    )  # fmt: skip

    @property
    def oil(self) -> Oil:
        """What of it makes films."""
        return Oil(self.viscosity, self.pressure_coefficient)
