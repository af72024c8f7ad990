"""What a user asks of a modal basis."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from flexcage.core.body_file import BodyFile
from flexcage.core.spec import ABSENT, GIVEN, OtherThan, option, quantity
from flexcage.geometry.materials import OILED_ASSEMBLY, Material

_COMPUTED = {"body": ABSENT}
_RITZ = {"kind": OtherThan(("craig_bampton", "free_free"))}
_BODY = {"body": GIVEN}
KINDS: dict[str, type | None] = dict.fromkeys(("ritz", "craig_bampton", "free_free"))


@dataclass(frozen=True, kw_only=True)
class DampingBand:
    """Modal damping ratio of the modes whose frequency lies in [low, high)."""

    low: float = quantity("Hz", 0.0, doc="lower edge of the band", minimum=0.0)
    high: float = quantity("Hz", float("inf"), doc="upper edge of the band", above=0.0)
    ratio: float = option(doc="damping ratio in the band", minimum=0.0, maximum=1.0)


@dataclass(frozen=True, kw_only=True)
class ModesSpec(BodyFile):
    """Modal basis of the flexible cage: computed as ``kind`` says, or from a ``body``."""

    kind: str = option("ritz", doc="kind of basis", choices=KINDS, when=_COMPUTED)
    count: int = option(
        24, doc="number of free (or fixed-interface) eigenmodes", minimum=1,
        when=_COMPUTED,
    )  # fmt: skip
    dynamic: str = option(
        "free",
        doc="ritz: 'free' keeps attachments quasi-static, 'all' makes every vector dynamic",
        choices=("free", "all"),
        when=(_BODY, _RITZ),
    )
    crossbeams: bool = option(
        True,
        doc="ritz: add the static shape under a push on every crossbeam as a dynamic coordinate, "
        "so that crossbeams have their own bending with its inertia",
        when={**_COMPUTED, **_RITZ},
    )
    attachments: str = option(
        "quadratic",
        doc="ritz, craig_bampton: loads on every pocket face whose local deflection is exact: "
        "'linear' has uniform and linear ones and is 3 to 6 % too stiff where a roller presses "
        "the middle of a face alone, 'quadratic' has one more and leaves 0.5 to 2 %",
        choices=("linear", "quadratic"),
        when=(_BODY, {"kind": OtherThan(("free_free",))}),
    )
    damping: float | None = option(
        None,
        doc="modal damping ratio where neither ratios nor a band say otherwise; by default that of "
        "the cage's material",
        minimum=0.0,
        maximum=1.0,
        when={"ratios": ABSENT},
        assumption="0.01 for joints and oil, and half of the material's loss factor, which metals "
        "hardly have; no source gives a cage's own",
    )
    ratios: tuple[float, ...] = option(
        (),
        doc="damping ratios mode by mode, in the order of the mode table, where no band says "
        "otherwise; the last holds for all further modes",
        minimum=0.0,
        maximum=1.0,
    )
    bands: tuple[DampingBand, ...] = option((), doc="damping ratios by frequency band")
    land: bool = option(
        False,
        doc="ritz, craig_bampton: add static vectors of radial pressure on the lands as dynamic "
        "coordinates; without them the lands move as the modes do",
        when=_COMPUTED,
    )
    geometric_stiffening: bool = option(
        False,
        doc="add the stiffness that the stress of rotation gives the modes: the first frequency "
        "of an N1013's cage at 2709 rpm rises by 0.25 %, others by less",
    )

    def damped_as(self, material: Material) -> ModesSpec:
        """The same with a damping ratio as a number: the material's where none is given."""
        return replace(self, damping=material.modal_damping) if self.damping is None else self

    def damping_ratios(self, frequencies: np.ndarray) -> np.ndarray:
        """Damping ratio of every mode (n,) from its number and its frequency [Hz].

        A band wins over the mode's own ratio, and the first band over the others.
        """
        common = OILED_ASSEMBLY if self.damping is None else self.damping
        ratios = np.full(len(frequencies), self.ratios[-1] if self.ratios else common)
        given = self.ratios[: len(ratios)]
        ratios[: len(given)] = given
        for band in reversed(self.bands):
            ratios[(frequencies >= band.low) & (frequencies < band.high)] = band.ratio
        return ratios
