"""The static solution's stiffness as a bearing element of ROSS, a program for rotors.

ROSS turns its rotor about z and bends it in x and y (ross-rotordynamics, MIT licence). flexcage's
bearing axis is x, and y, z are radial: y, z, x here are x, y, z there, a turn that keeps the hand.
"""

from math import pi
from pathlib import Path

import numpy as np

import flexcage

RPM = (2000.0, 6000.0, 10000.0)


def table(axial: str = "400 N", radial: str = "300 N") -> flexcage.study.StiffnessTable:
    """Stiffness of a 7010C at ``RPM``; several loads of either kind make a grid."""
    case = flexcage.load_static(Path(__file__).with_name("c7010_static.toml"))
    speeds = [rpm * pi / 30.0 for rpm in RPM]
    return flexcage.study.stiffness_table(case, speeds=speeds, radial=[radial], axial=[axial])


def coefficients(**loads: str) -> dict[str, np.ndarray]:
    """kxx, kxy, kyx, kyy, kzz [N/m] of a 7010C at ``RPM``, in ROSS's axes and by its names."""
    return table(**loads).ross_coefficients()


def main() -> tuple[float, float]:
    """First frequency [Hz] of a stiff shaft on two bearings, by ROSS and as sqrt(2 k/m)/2 pi."""
    import ross

    found, speeds = table(), np.array(RPM) * pi / 30.0
    k = found.ross_coefficients()
    stiff = ross.Material("stiff", rho=7810, E=211e14, G_s=81e14)  # bends by nothing: a closed form
    shaft = [ross.ShaftElement(L=0.05, idl=0.0, odl=0.1, material=stiff) for _ in range(10)]
    ends = [found.to_ross(n) for n in (0, 10)]
    rotor = ross.Rotor(shaft, bearing_elements=ends)
    softer = min(k["kxx"][1], k["kyy"][1])
    by_hand = np.sqrt(2.0 * softer / rotor.m) / (2.0 * pi)
    by_ross = rotor.run_modal(speed=speeds[1]).wn / (2.0 * pi)
    return float(by_ross[np.argmin(np.abs(by_ross - by_hand))]), float(by_hand)


if __name__ == "__main__":
    by_ross, by_hand = main()
    print(f"{by_ross:.2f} Hz by ROSS, {by_hand:.2f} Hz by hand")
    assert abs(by_ross / by_hand - 1.0) < 1e-3, (by_ross, by_hand)
