"""A tapered roller bearing: what its large rib bears as it turns faster, and where load spreads."""

from math import cos, pi, sin, tan
from pathlib import Path

import flexcage


def main(*speeds: float) -> list[float]:
    """Force [N] of the rib on a roller under axial load alone, at speeds [rpm]."""
    case = flexcage.load_static(Path(__file__).with_name("30205.toml"))
    b, forces = case.bearing, []
    for rpm in speeds:
        drive = flexcage.spec.Drive(speed=rpm * pi / 30)
        solution = flexcage.solve_static(
            flexcage.StaticCase(bearing=b, load=flexcage.spec.Load(axial=1200.0), drive=drive)
        )
        on_rib = solution.elements.axial[0] / cos(b.axis_angle - b.rib_angle)
        print(f"{rpm:6.0f} rpm: the rib bears {on_rib:.3f} N, the outer race "
              f"{solution.elements.force[0, 1]:.2f} N of each roller")  # fmt: skip
        forces.append(on_rib)
    return forces


def wedge() -> float:
    """The same [N] by hand, at rest: races push a cone towards its large end."""
    b = flexcage.load_static(Path(__file__).with_name("30205.toml")).bearing
    outer = 1200.0 / (b.roller_count * sin(b.contact_angle))
    both = tan(b.rib_angle) * tan(b.half_angle)
    return outer * (1.0 + (1.0 - both) / (1.0 + both)) * sin(b.half_angle) / cos(b.rib_angle)


def loaded() -> int:
    """Rollers that the example's combined load presses on both races."""
    return flexcage.solve_static(
        flexcage.load_static(Path(__file__).with_name("30205.toml"))
    ).loaded


if __name__ == "__main__":
    still, *_, fast = main(0.0, 3000.0, 6000.0, 12000.0)
    assert abs(still / wedge() - 1.0) < 1e-9 and fast > 1.1 * still, (still, fast)
    assert loaded() == 15
