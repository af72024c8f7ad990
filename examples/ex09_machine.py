"""Machines: a spindle's stiffness at its nose, and the bearing forces of a motor by hand."""

from pathlib import Path

import flexcage

HERE = Path(__file__).parent


def spindle(preload: str = "250 N") -> float:
    """Stiffness [N/um] across the nose of the spindle, with a preload of its pair."""
    changes = {f"bearings.{name}.preload_force": preload for name in ("front", "second")}
    solution = flexcage.solve_machine(
        flexcage.load_machine(HERE / "spindle.toml", overrides=changes)
    )
    return 1e-6 / solution.compliance_at(0.0)[1, 1]


def motor() -> tuple[float, float]:
    """Force [N] of the floating bearing of the motor, and that of two supports that bear no
    moments."""
    solution = flexcage.solve_machine(flexcage.load_machine(HERE / "motor.toml"))
    shaft, fixed, floating = solution.shaft, solution["fixed"], solution["floating"]
    weights = [(18.0, 0.180)]  # kg and place of the rotor, and of the shaft's pieces
    middles = 0.5 * (shaft.places[1:] + shaft.places[:-1])
    weights += [(b.mass_per_length * b.length, x) for b, x in zip(shaft.beams, middles)]
    moment = sum(9.80665 * mass * (x - fixed.position) for mass, x in weights)
    moment += 1200.0 * (0.400 - fixed.position)
    return float(floating.force[1]), moment / (floating.position - fixed.position)


if __name__ == "__main__":
    soft, stiff = spindle(), spindle("500 N")
    print(f"nose: {soft:.1f} N/um with 250 N of preload, {stiff:.1f} N/um with 500 N")
    borne, by_hand = motor()
    print(f"floating bearing: {borne:.1f} N, {by_hand:.1f} N by the lever rule")
    assert abs(borne / by_hand - 1.0) < 2e-3, (borne, by_hand)
    assert abs(soft - 80.7) < 0.1 and stiff > 1.05 * soft, (soft, stiff)
