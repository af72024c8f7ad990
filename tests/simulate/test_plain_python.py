"""The kernels as plain Python, as a debugger steps through them, against the compiled ones."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
from simulate_cases import bent, n1013

from flexcage.case import load_case
from flexcage.compiling import build_bearing
from flexcage.stages import cage_mesh, cage_reduction
from flexcage.system.data import POWERS
from flexcage.system.start import find_start

HERE = Path(__file__)


def bearing(text: str):
    case = load_case(text)
    mesh = cage_mesh(case)
    return build_bearing(case, mesh, cage_reduction(case, mesh))


def evaluated(bearing, y: np.ndarray, yd: np.ndarray) -> dict[str, np.ndarray]:
    """Residual, tangent and report at one state."""
    out = {"residual": bearing.residual(0.0, y, yd)}
    bearing.residual(0.0, y, yd, mode=1)
    out |= {
        name: getattr(bearing.data.work.tangent, name).copy()
        for name in ("Krr", "Krb", "Kbb", "Cbb")
    }
    bearing.residual(0.0, y, yd, mode=2)
    set_y, rates, power = y.copy(), np.empty_like(y), np.empty(len(POWERS))
    bearing.function("rates")(0.0, set_y, rates, bearing.args, power)
    out |= {"rates": rates, "multipliers": bearing.layout.multipliers(set_y), "powers": power}
    bearing.residual(0.0, y, yd, mode=2)
    return out | {
        "forces": bearing.data.work.report.pocket_normal,
        "power": bearing.data.work.report.power,
    }


def test_plain_python_gives_what_the_compiler_gives(tmp_path):
    """A flexible cage whose bent crossbeam presses on its roller, the ring under load on a
    compliant shaft."""
    shaft = {
        "load.axial": "50 N", "load.axial_stiffness": "10 N/um", "load.axial_damping": "10 N*s/m",
        "load.tilt": "free", "load.tilt_stiffness": "1000 N*m/rad", "load.moment_z": "0.5 N*m",
    }  # fmt: skip
    text = n1013(
        {"cage.model": "flexible", "mesh.fineness": "coarse"}, shaft, defects=bent("0.25 mm")
    ).to_toml()
    compiled = bearing(text)
    start = find_start(compiled, limit_force=1e4)
    rng = np.random.default_rng(1)
    y = start.y + 1e-9 * rng.standard_normal(len(start.y))
    expected = evaluated(compiled, y, start.yd)
    assert expected["forces"].max() > 100.0 and expected["residual"].any()
    np.savez(tmp_path / "state.npz", y=y, yd=start.yd)
    (tmp_path / "case.toml").write_text(text)
    subprocess.run(
        [sys.executable, str(HERE), str(tmp_path)], check=True, cwd=HERE.parent,
        env={**os.environ, "NUMBA_DISABLE_JIT": "1"},
    )  # fmt: skip
    with np.load(tmp_path / "plain.npz") as plain:
        for name, values in expected.items():
            scale = np.abs(values).max()
            np.testing.assert_allclose(plain[name], values, rtol=1e-6, atol=1e-9 * scale)


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    with np.load(folder / "state.npz") as state:
        found = evaluated(bearing((folder / "case.toml").read_text()), state["y"], state["yd"])
    np.savez(folder / "plain.npz", **found)
