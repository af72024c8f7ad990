"""A stepped, hollow shaft with two discs on two springs, by ROSS: written for the tests.

`python ross_rotor.py` prints what `ross_rotor.json` holds (ROSS turns about z, bends in x and y).
"""

from __future__ import annotations

import json
import sys
from math import pi

import numpy as np

# length, outside and inside diameter [m]; a node at the end of every piece
SECTIONS = [(0.06, 0.03, 0.0), (0.30, 0.05, 0.02), (0.06, 0.03, 0.0), (0.05, 0.025, 0.0)]
PIECES = (4, 16, 4, 4)
STEEL = {"modulus": 206e9, "ratio": 0.3, "density": 7850.0}
DISCS = [(0.1725, 12.0, 0.12, 0.064), (0.47, 3.0, 0.012, 0.0065)]  # place, mass, polar, diametral
SPRINGS = {0.03: (8e7, 6e7), 0.39: (5e7, 7e7)}  # place: along y, along z
DAMPING = 400.0  # N s/m of both
UNBALANCE = 100e-6  # kg m on the first disc
SPEEDS = [np.array(rpm) * pi / 30.0 for rpm in (2000.0, 5000.0, 9000.0)]


def by_ross() -> dict:
    import ross

    E, nu = STEEL["modulus"], STEEL["ratio"]
    steel = ross.Material("ours", rho=STEEL["density"], E=E, Poisson=nu)
    shaft, ends = [], [0.0]
    for (length, outside, inside), count in zip(SECTIONS, PIECES):
        for _ in range(count):
            shaft.append(ross.ShaftElement(L=length / count, idl=inside, odl=outside,
                                           material=steel))  # fmt: skip
            ends.append(ends[-1] + length / count)
    at = {round(x, 6): n for n, x in enumerate(ends)}
    discs = [ross.DiskElement(n=at[round(x, 6)], m=m, Id=d, Ip=p) for x, m, p, d in DISCS]
    bearings = [
        ross.BearingElement(n=at[round(x, 6)], kxx=ky, kyy=kz, cxx=DAMPING, cyy=DAMPING)
        for x, (ky, kz) in SPRINGS.items()
    ]
    rotor = ross.Rotor(shaft, discs, bearings)
    found = {"version": ross.__version__, "frequencies": {}, "orbit": {}}
    for speed in SPEEDS:
        modal = rotor.run_modal(speed=float(speed), num_modes=28)
        lines = np.unique(np.round(np.abs(modal.wd[modal.wd > 1.0]), 8))
        found["frequencies"][f"{speed:.6f}"] = lines[:6].tolist()
    forced = rotor.run_unbalance_response(
        node=at[round(DISCS[0][0], 6)], unbalance_magnitude=UNBALANCE, unbalance_phase=0.0,
        frequency=np.array([float(s) for s in SPEEDS]),
    )  # fmt: skip
    dofs = rotor.number_dof
    node = at[round(DISCS[0][0], 6)]
    for k, speed in enumerate(SPEEDS):
        y, z = forced.forced_resp[dofs * node, k], forced.forced_resp[dofs * node + 1, k]
        found["orbit"][f"{speed:.6f}"] = [float(abs(y)), float(abs(z))]
    critical = rotor.run_critical_speed(num_modes=24)
    found["critical"] = [float(w) for w in np.sort(critical.wd())[:4]]
    return found


if __name__ == "__main__":
    sys.stdout.write(json.dumps(by_ross(), indent=1) + "\n")
