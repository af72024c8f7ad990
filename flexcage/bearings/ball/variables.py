"""What runs of ball bearings record beside what all do."""

from __future__ import annotations

from flexcage.results.registry import OwnVariables, sampled

VARIABLES = OwnVariables(
    variables=(
        sampled(
            "contact_angle", "rad", "angle of the line from a groove's centre through the ball's",
            "element", "race",
        ),
        sampled(
            "race_traction_across", "N",
            "traction of a race on a ball across the rolling direction, in the surface of contact",
            "element", "race",
        ),
        sampled(
            "pocket_direction", "rad", "where a ball stands in its pocket, from +psi towards +x",
            "element", of_cage=True,
        ),
    )
)  # fmt: skip
