"""Integrate a rotor and its bearings, each of which keeps a record of its own."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from flexcage.integrate.integration import Integration
from flexcage.integrate.recorder import Recorder
from flexcage.integrate.recording import Recording
from flexcage.results.options import OutputOptions
from flexcage.results.store import MemoryRunStore
from flexcage.solve.options import SolverOptions
from flexcage.system.data import POWERS
from flexcage.system.shaft.problem import MachineSystem


class MachineIntegration(Integration):
    """The integration of a machine; ``rotor`` has what happened to the rotor so far: lists of
    arrays of blocks, by name."""

    def __init__(
        self, machine: MachineSystem, recordings: Sequence[Recording],
        stores: Sequence[MemoryRunStore], y: np.ndarray, *, solver: SolverOptions,
        output: OutputOptions,
    ) -> None:  # fmt: skip
        first, n = machine.shaft.first, len(POWERS)
        recorders = [
            Recorder(
                bearing, recording, store, output=output, span=slice(first[k], first[k + 1]),
                works=slice(k * n, (k + 1) * n), mark=f"{k} ",
            )
            for k, (bearing, recording, store) in enumerate(
                zip(machine.bearings, recordings, stores, strict=True)
            )
        ]  # fmt: skip
        self.machine = machine
        self.rotor: dict[str, list[np.ndarray]] = {
            name: [] for name in ("position", "velocity", "force", "work")
        }
        super().__init__(machine, recorders, y, np.zeros_like(y), solver=solver, output=output)

    def keep_more(self, ys: np.ndarray, quads: np.ndarray) -> None:
        """Keep the rotor's motion, its forces on the bearings, and its own works."""
        ratio, at = self.output.vibration_ratio, int(self.machine.shaft.first[-1])
        main, half = slice(ratio - 1, None, ratio), at + (self.machine.size - at) // 2
        self.rotor["position"].append(ys[main, at:half].copy())
        self.rotor["velocity"].append(ys[main, half:].copy())
        self.rotor["force"].append(self.machine.shaft.kept[: len(ys)][main].copy())
        self.rotor["work"].append(quads[main, len(self.recorders) * len(POWERS) :].copy())
