"""What runs of roller bearings record beside what all do."""

from __future__ import annotations

from math import prod
from typing import Any

from flexcage.modes.basis import FACES
from flexcage.results.registry import FORCE_BITS, MODAL_BITS, OwnVariables, sampled

END_POINTS = (2, 7)  # of a roller's end on a side beam: across the band and along it
_PARTS: Any = {
    "bits": FORCE_BITS,
    "together": 1,
    "sparse": True,
    "dtype": "float32",
    "of_cage": True,
}
_BEAM, _SIDE = ("pocket", "crossbeam_face", "slice"), ("pocket", "side_face", "end_point")

VARIABLES = OwnVariables(
    variables=(
        sampled(
            "element_quaternion", "1",
            "orientation of a spinning roller, ring frame, scalar first",
            "element", "quaternion", together=1,
        ),
        sampled("element_tilt", "rad", "skew and tilt of a roller's axis", "element", "tilt"),
        sampled(
            "race_moment", "N m", "moment of a race on a roller", "element", "race", "moment",
            bits=MODAL_BITS, together=1,
        ),
        sampled("rib_force", "N",
                "normal force of a rib on a roller end, of the ring that guides the rollers",
                "element", "rib"),
        sampled("counter_rib_force", "N",
                "the same of the other ring's ribs, zero where there are none (N, NU)",
                "element", "rib"),
        sampled("pocket_slice_force", "N", "normal force of a slice on a crossbeam face", *_BEAM,
                **_PARTS),
        sampled("pocket_slice_friction", "N", "friction force of a slice on a crossbeam face",
                *_BEAM, **_PARTS),
        sampled("pocket_point_force", "N",
                "normal force of a point of a roller's end on a side-beam face", *_SIDE, **_PARTS),
        sampled("pocket_point_friction", "N",
                "friction force of a point of a roller's end on a side-beam face", *_SIDE,
                **_PARTS),
        sampled(
            "residual_coordinates", "1", "quasi-static residual coordinates of a pocket's faces",
            "pocket", "residual", bits=FORCE_BITS, together=1, sparse=True, of_cage=True,
        ),
    ),
    labels={
        "tilt": ("skew", "tilt"),
        "moment": ("tilt", "skew"),
        "crossbeam_face": FACES[:2],
        "side_face": FACES[2:],
        "rib": ("+x", "-x"),
    },
    counted=("slice", "end_point", "residual"),
    sizes={"end_point": prod(END_POINTS)},
)  # fmt: skip
