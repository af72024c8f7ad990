"""One folder a bearing family; a new one is that and its line in ``specs``.

``core.wings`` finds the ``FAMILY`` of every folder.
"""

from flexcage.bearings.family import (
    Family,
    bending_of,
    family_of,
    in_motion,
    losses_of,
    motion_of,
    recording_of,
    sections_of,
    statics_of,
)

__all__ = [
    "Family", "bending_of", "family_of", "in_motion", "losses_of", "motion_of", "recording_of",
    "sections_of", "statics_of",
]  # fmt: skip
