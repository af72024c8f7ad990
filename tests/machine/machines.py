"""Machines for the tests: pairs of bearings on a rigid shaft, as tables."""

from __future__ import annotations

from flexcage.machine import load_machine

STEEL = {"name": "GCr15"}


def pair(
    faces=("+x", "-x"), *, apart=16.0, preset="7010C-PI", rpm=0, loads=(), bearing=None, **place
):
    """Two bearings ``apart`` mm on a rigid, weightless shaft; values of ``place`` go to both."""
    rows = [
        {
            "name": name, "preset": preset, "position": f"{x} mm", "facing": face,
            "bearing": {"material": "GCr15", **(bearing or {})}, **place,
        }
        for name, x, face in zip("AB", (100.0, 100.0 + apart), faces)
    ]  # fmt: skip
    return load_machine({
        "drive": {"speed": f"{rpm} rpm"},
        "gravity": {"acceleration": "0 m/s^2"},
        "shaft": {"kind": "rigid", "length": "300 mm", "loads": list(loads)},
        "bearings": rows,
    })  # fmt: skip


def load(x, *force):
    """A load at x mm: forces along x, y, z [N]."""
    return {"position": f"{x} mm", "force": [f"{f} N" for f in force]}
