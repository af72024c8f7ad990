"""Integrate a rotor and its bearings, each of which keeps a record of its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.integrate.integration import Attempt, Integration
from flexcage.integrate.recorder import Recorder
from flexcage.integrate.recording import Recording
from flexcage.results.options import OutputOptions
from flexcage.results.registry import TIME, Variable
from flexcage.results.store import MemoryRunStore, RunStore
from flexcage.solve.options import SolverOptions
from flexcage.system.data import POWERS
from flexcage.system.shaft.data import RIGID_ROTOR, SHAFT_POWERS
from flexcage.system.shaft.problem import MachineSystem

COMPONENTS = ("x", "y", "z", "about y", "about z")
#: What is recorded of a rotor, as computed; its coordinates are x, y, z, skew, tilt and modes.
_ROTOR = (
    Variable("rotor_position", (TIME, "coordinate"), "m, rad", "coordinates of the rotor"),
    Variable("rotor_velocity", (TIME, "coordinate"), "m/s, rad/s", "velocities of the rotor"),
    Variable("rotor_force", (TIME, "bearing", "component"), "N, N m",
             "what the rotor does to each inner ring, in the bearing's axes"),
    Variable("rotor_work", (TIME, "work_channel"), "J", "work of each power on the rotor"),
)  # fmt: skip


class MachineIntegration(Integration):
    """The integration of a machine. Its ``store`` (``rotor_store``) has what happened to the rotor;
    a block counts once it is there, behind those of all bearings."""

    def __init__(
        self, machine: MachineSystem, recordings: Sequence[Recording],
        stores: Sequence[MemoryRunStore], y: np.ndarray, *, store: MemoryRunStore,
        solver: SolverOptions, output: OutputOptions,
    ) -> None:  # fmt: skip
        first, n = machine.shaft.first, len(POWERS)
        recorders = [
            Recorder(
                bearing, recording, own, output=output, span=slice(first[k], first[k + 1]),
                works=slice(k * n, (k + 1) * n), mark=f"{k} ",
            )
            for k, (bearing, recording, own) in enumerate(
                zip(machine.bearings, recordings, stores, strict=True)
            )
        ]  # fmt: skip
        self.machine = machine
        super().__init__(
            machine, recorders, y, np.zeros_like(y), solver=solver, output=output, store=store
        )

    def keep_more(self, index: int, found: Attempt) -> None:
        """Store the rotor's motion, its forces on the bearings, and its own works."""
        ratio, at = self.output.vibration_ratio, int(self.machine.shaft.first[-1])
        main = slice(ratio - 1, ratio * found.done, ratio)
        half = at + (self.machine.size - at) // 2
        force = self.machine.shaft.kept[: len(found.ys)]
        self.store.write_block(
            index,
            {
                "rotor_position": found.ys[main, at:half],
                "rotor_velocity": found.ys[main, half:],
                "rotor_force": force[main],
                "rotor_work": found.quads[main, len(self.recorders) * len(POWERS) :],
            },
            checkpoint=self.checkpoint() if found.whole else None,
        )


def rotor_store(
    path: Path | None, machine: MachineSystem, names: Sequence[str], *, duration: float,
    output: OutputOptions, attrs: Mapping[str, Any],
) -> MemoryRunStore:  # fmt: skip
    """Allocate the record of a machine's rotor, at ``path`` or in memory; ``names`` of bearings."""
    n = max(round(duration * output.rate), 2)
    modes = len(machine.shaft.stiffness)
    return RunStore.create(
        path,
        coords={
            "time": np.arange(1, n + 1) / output.rate,
            "coordinate": np.arange(RIGID_ROTOR + modes),
            "bearing": np.array(names),
            "component": np.array(COMPONENTS),
            "work_channel": np.array(SHAFT_POWERS),
        },
        variables=_ROTOR,
        n_time=n,
        block=output.block,
        attrs=attrs,
    )
