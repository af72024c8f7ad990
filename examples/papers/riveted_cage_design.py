"""The 49-point design of table 3 of "Machines 2024, 12(7), 466": pocket radius by cage width.

    python examples/papers/riveted_cage_design.py --starts 8     # one process, in the background
    flexcage study surface runs/riveted_cage_design pocket_peak.turn_max

One statistic, fixed before the runs: the mean over turns of the cage of the largest ball-cage force
in each (``STATISTIC``). Rigid cage; balls of 6.747 mm, the reading whose forces are the paper's in
size (the reading as printed, 6.47 mm, by --ball 6.47). The strip is as broad as the preset's
shoulders allow, 4.2 mm: even so a cage narrower than 5.53 mm would be cut through by the holes at
its pockets' sides, so that 14 of the 49 points, 4.4 and 5.0 mm wide, have no cage in one piece.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

import flexcage
from flexcage.core.progress import Progress
from flexcage.study.spec import Repeat

FOLDER = Path(__file__).with_name("riveted_cage")
OUT = Path("runs/riveted_cage_design")
STATISTIC = "pocket_peak.turn_max"
RADII = (3.43, 3.44, 3.45, 3.46, 3.47, 3.48, 3.49)  # mm
WIDTHS = (8.0, 7.4, 6.8, 6.2, 5.6, 5.0, 4.4)  # mm
STRIP = 4.2  # mm, an assumption: the shoulders of 21.73 and 30.27 mm leave 4.27 mm
PITCH = 26.0  # mm
CONFORMITY = (0.515, 0.525)  # inner, outer, over the ball's diameter; the paper prints none


def whole(radius: float, width: float, strip: float = STRIP) -> bool:
    """Whether the holes at a pocket's sides leave sheet beside them (mm)."""
    opening = max(radius**2 - 0.25 * width**2, 0.0) ** 0.5
    return opening < 0.5 * strip - 0.02 * 0.8


def study(ball: float = 6.747, starts: int = 8) -> flexcage.Study:
    """The points that can be made, each with so many starts."""
    inner, outer = CONFORMITY
    base = {
        "cage.model": "rigid", "bearing.ball_diameter": f"{ball:g} mm",
        "bearing.inner_groove_radius": f"{inner * ball:.6g} mm",
        "bearing.outer_groove_radius": f"{outer * ball:.6g} mm",
        "cage.bore": f"{PITCH - STRIP:g} mm", "cage.outside_diameter": f"{PITCH + STRIP:g} mm",
    }  # fmt: skip
    widths = tuple(w for w in WIDTHS if whole(max(RADII), w))
    return flexcage.Study(
        name=f"riveted-cage design, balls of {ball:g} mm",
        case=flexcage.load_case(FOLDER / "case.toml", overrides=base),
        axes=[
            flexcage.study.Grid("cage.pocket_diameter", [f"{2.0 * r:.2f} mm" for r in RADII]),
            flexcage.study.Grid("cage.width", [f"{w:g} mm" for w in widths]),
        ],
        outputs=[STATISTIC, "pocket_force_pass_peak", "cage_slip_ratio_nominal"],
        repeat=Repeat(count=starts, push=20e-3),
        keep="figures",
    )


def main(arguments: Sequence[str] | None = None) -> flexcage.StudyResults:
    """Compute what is missing; the surface is laid by ``flexcage study surface``."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--ball", type=float, default=6.747, help="ball diameter, mm")
    parser.add_argument("--starts", type=int, default=8, help="starts a point")
    parser.add_argument("-o", "--out", type=Path, default=OUT)
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args(arguments)
    results = flexcage.run_study(
        study(options.ball, options.starts), out=options.out, workers=options.workers,
        progress=Progress,
    )  # fmt: skip
    print(results.report())
    return results


if __name__ == "__main__":
    main()
