"""One folder a bearing family; a new one is its folder, and its lines here and in ``specs``."""

from flexcage.bearings import ball, cylindrical_roller
from flexcage.bearings.family import (
    Family,
    family_of,
    in_motion,
    motion_of,
    recording_of,
    sections_of,
    statics_of,
)

MEMBERS = (
    cylindrical_roller.FAMILY,
    ball.FAMILY,
)

__all__ = [
    "MEMBERS", "Family", "family_of", "in_motion", "motion_of", "recording_of", "sections_of",
    "statics_of",
]  # fmt: skip
