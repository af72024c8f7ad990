"""A run whose every figure is known in closed form: pure kinematics, no solver."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.results.registry import variables_of
from flexcage.results.slip import BearingNumbers
from flexcage.results.store import RunStore

N1013 = BearingNumbers(pitch_diameter=82.5e-3, element_diameter=8e-3, element_count=22)
Z = 22


def run_coords(n: int, rate: float = 50e3, ratio: int = 4) -> dict:
    return {
        "time": np.arange(n) / rate,
        "time_hf": np.arange((n - 1) * ratio + 1) / (ratio * rate),
        "element": np.arange(Z),
        "pocket": np.arange(Z),
        "mode": np.arange(3),
        "slice": np.linspace(-3e-3, 3e-3, 5),
        "end_point": np.arange(4),
        "station": np.arange(3),
        "residual": np.arange(12),
        "land_station": np.arange(24),
        "support": np.arange(3),
        "spotted": np.array([2, 5]),
        "constraint": ["axial_force", "moment_y", "moment_z", "drive_torque"],
        "energy_kind": ["kinetic", "contact"],
        "channel": ["drive", "race_friction"],
    }


@pytest.fixture
def bearing() -> BearingNumbers:
    return N1013


@pytest.fixture
def known_run():
    """Cage slips 2 %, whirls at +1 with 40 um about (10, -20) um; rollers 3..5 are loaded and
    slip 1 %, the others 5 %; pocket 7's rear face bears 3 N half the time and once 11 N."""
    n = 5001
    store = RunStore.create(
        None,
        coords=run_coords(n),
        variables=variables_of("cylindrical_roller"),
        n_time=n,
        n_time_hf=4 * (n - 1) + 1,
        block=n,
        block_hf=4 * (n - 1) + 1,
        attrs={"family": "cylindrical_roller", "element": "roller"},
    )
    layout = store.layout
    a = {v.name: np.zeros(layout.shape(v)) for v in layout.variables}
    t = layout.coords["time"][1]
    inner = 6000 * np.pi / 30
    cage = 0.98 * 2709.0909090909 * np.pi / 30
    a["inner_speed"][:] = inner
    a["inner_angle"][:] = inner * t
    a["cage_quaternion"][:, 0], a["cage_quaternion"][:, 1] = (
        np.cos(cage * t / 2),
        np.sin(cage * t / 2),
    )
    a["cage_omega"][:, 0] = cage
    a["cage_position"][:, 1] = 10e-6 + 40e-6 * np.cos(cage * t)
    a["cage_position"][:, 2] = -20e-6 + 40e-6 * np.sin(cage * t)
    spin = -27937.5 * np.pi / 30
    a["element_omega"][:, :, 0] = 0.95 * spin
    a["element_omega"][:, 3:6, 0] = 0.99 * spin
    a["race_force"][:, 3:6, 0] = 300.0
    a["race_force"][:, :, 1] = 10.5
    a["race_slip"][:, 3:6] = 0.02
    a["pocket_force"][: n // 2, 7, 1] = 3.0
    a["pocket_force"][4000, 7, 1] = 8.0
    a["pocket_peak"][:] = a["pocket_force"]
    a["pocket_peak"][4000, 7, 1] = 11.0  # between two samples
    a["energy"][:, 0] = 1.0 - 2.0 * t
    a["work"][:, 0], a["work"][:, 1] = 5.0 * t, -7.0 * t
    main = {k: v for k, v in a.items() if "acceleration" not in k or not k.startswith("outer")}
    fine = {k: v for k, v in a.items() if k not in main}
    store.write_block(0, main, fine)
    return store.dataset()
