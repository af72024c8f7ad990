"""A study: the same case under several loads and speeds, on all cores, and its table."""

from pathlib import Path

import flexcage


def main(out: Path, **changes: object) -> flexcage.StudyResults:
    """Outer race force and cage speed over load and speed; ``changes`` are of the base case."""
    study = flexcage.Study(
        name="load and speed",
        case=flexcage.load_case(Path(__file__).with_name("n1013.toml")).replace(**changes),
        axes=[
            flexcage.study.Grid("load.radial", ["500 N", "1 kN"]),
            flexcage.study.Grid("drive.speed", ["3000 rpm", "6000 rpm"]),
        ],
        outputs=["cage_speed", "epicyclic_speed", "race_force[race=outer].max"],
    )
    results = flexcage.run_study(study, out=out)
    print(results.report())
    return results


def largest_slip(results: flexcage.StudyResults) -> float:
    """Largest slip of the cage behind pure rolling, as a ratio."""
    table = results.table
    return float((1 - table["cage_speed [rad/s]"] / table["epicyclic_speed [rad/s]"]).abs().max())


if __name__ == "__main__":
    # a loaded cage slips little, whatever the load and the speed
    slip = largest_slip(main(Path("runs/ex04")))
    assert slip < 0.03, slip
