"""The main job from Python: an N1013 with one bent crossbeam, its speeds, stress and pictures."""

from pathlib import Path

import flexcage


def main(folder: Path | None = None, **changes: object) -> float:
    """Cage speed [rpm], mean over the settled run; ``changes`` are paths and values of the case."""
    case = flexcage.load_case(Path(__file__).with_name("n1013.toml")).replace(**changes)
    run = flexcage.simulate(case, out=folder)
    print(run.summary)
    field = run.stress()  # the whole cage at the instant of its greatest stress
    print(f"{field.von_mises.max() / 1e6:.1f} MPa at t = {field.time * 1e3:.3f} ms")
    if folder is not None:
        run.draw(folder / "images")
    speed = run.dataset["cage_omega"].sel(axis="x").isel(time=slice(run.dataset.sizes["time"] // 3, None))
    return float(speed.mean()) * 30.0 / 3.141592653589793


if __name__ == "__main__":
    rpm = main(Path("runs/ex01"))
    # pure rolling gives 6000/2 (1 - 8/82.5) = 2709.09 rpm; a loaded cage slips little
    assert abs(rpm / 2709.09 - 1.0) < 0.03, rpm
