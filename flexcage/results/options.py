"""What a run stores, and from which part of it statistics are taken."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.spec import option, quantity


@dataclass(frozen=True, kw_only=True)
class OutputOptions:
    """Sampling grids of a run. Samples are dense output of the solver, never its own steps.

    The main grid is ``rate``; the outer ring's acceleration is kept at ``vibration_rate``, a
    whole multiple of it, so that a block of samples ends at one instant on both grids.
    """

    rate: float = quantity(
        "kHz", 50e3, doc="samples a second of states and forces", above=0.0, maximum=1e7
    )
    vibration_rate: float = quantity(
        "kHz",
        200e3,
        doc="samples a second of the outer ring's acceleration",
        above=0.0,
        maximum=1e8,
    )
    block: int = option(
        250, doc="samples a block: what one commit makes safe", minimum=2, maximum=10_000
    )
    settle: float = option(
        0.3, doc="share of the run left out of statistics", minimum=0.0, maximum=0.95
    )
    keep_cage: bool = option(
        True,
        doc="keep the mesh and the mode shapes of a flexible cage with the results (2 to 40 MB); "
        "without them the cage is made anew on loading",
    )

    @property
    def vibration_ratio(self) -> int:
        """Samples of the vibration grid per sample of the main grid."""
        return round(self.vibration_rate / self.rate)

    @property
    def block_hf(self) -> int:
        """Samples of the vibration grid in one block."""
        return self.block * self.vibration_ratio
