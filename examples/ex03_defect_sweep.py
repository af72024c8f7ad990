"""A crossbeam bent further and further: how long its narrowed pocket touches the roller."""

from pathlib import Path

import flexcage

STEPS = ("0 mm", "0.1 mm", "0.19 mm")  # of a circumferential clearance of 0.2 mm


def main(**changes: object) -> list[float]:
    """Share of the time in which roller 4 touches the crossbeams of its pocket, one per step."""
    base = flexcage.load_case(Path(__file__).with_name("n1013.toml")).replace(**changes)
    shares = []
    for step in STEPS:
        run = flexcage.simulate(base.replace("defects.0.displacement", step))
        force = run.dataset["pocket_force"].sel(pocket=4, face=["front", "rear"])
        shares.append(float((force > 0).any("face").mean()))
        print(f"{step:>8}: in contact {shares[-1]:.0%} of the time")
    return shares


if __name__ == "__main__":
    sound, _, tight = main()
    assert tight > 2 * sound, (sound, tight)
