"""Pictures of meshes, modes, stress and runs. Every function returns the path it wrote.

They take meshes, arrays and datasets; pyvista and matplotlib are loaded when one is called.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from flexcage.render.album import Scene, register_picture
    from flexcage.render.animations import animate_bearing, animate_stress, write_animation
    from flexcage.render.bearing_pictures import bearing_picture
    from flexcage.render.convergence import convergence_picture
    from flexcage.render.curves import compare_forces, histories, orbit
    from flexcage.render.look import Look
    from flexcage.render.mesh_pictures import mesh_picture
    from flexcage.render.mode_pictures import mode_sheet
    from flexcage.render.spectra import spectra_picture
    from flexcage.render.static_pictures import static_picture
    from flexcage.render.stress_pictures import (
        deformation_picture,
        envelope_picture,
        stress_picture,
    )

_HOME = {
    "Look": "look",
    "Scene": "album",
    "register_picture": "album",
    "animate_bearing": "animations",
    "animate_stress": "animations",
    "write_animation": "animations",
    "bearing_picture": "bearing_pictures",
    "compare_forces": "curves",
    "histories": "curves",
    "orbit": "curves",
    "mesh_picture": "mesh_pictures",
    "mode_sheet": "mode_pictures",
    "convergence_picture": "convergence",
    "spectra_picture": "spectra",
    "static_picture": "static_pictures",
    "deformation_picture": "stress_pictures",
    "envelope_picture": "stress_pictures",
    "stress_picture": "stress_pictures",
}

__all__ = [
    "Look",
    "Scene",
    "animate_bearing",
    "animate_stress",
    "bearing_picture",
    "compare_forces",
    "convergence_picture",
    "deformation_picture",
    "envelope_picture",
    "histories",
    "mesh_picture",
    "mode_sheet",
    "orbit",
    "register_picture",
    "spectra_picture",
    "static_picture",
    "stress_picture",
    "write_animation",
]


def __getattr__(name: str) -> Any:
    if name in _HOME:
        return getattr(importlib.import_module(f"{__name__}.{_HOME[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
