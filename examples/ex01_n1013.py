"""The main job from Python: an N1013 with one bent crossbeam, its speeds, stress and pictures."""

from math import pi
from pathlib import Path

import flexcage


def main(out: Path | None = None, **changes: object) -> float:
    """Mean cage speed [rpm]; ``changes`` are paths of the case and their new values."""
    case = flexcage.load_case(Path(__file__).with_name("n1013.toml")).replace(**changes)
    run = flexcage.simulate(case, out=out)
    print(run.summary)
    field = run.stress()  # of the whole cage, at the instant of its largest equivalent stress
    print(f"{field.von_mises.max() / 1e6:.1f} MPa at t = {field.time * 1e3:.3f} ms")
    if out is not None:
        run.draw(out / "images")
    return run.summary["cage_speed"] * 30 / pi


if __name__ == "__main__":
    rpm = main(Path("runs/ex01"))
    # pure rolling gives 6000/2 (1 - 8/82.5) = 2709.09 rpm, and a loaded cage slips little
    assert abs(rpm / 2709.09 - 1) < 0.03, rpm
