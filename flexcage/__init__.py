"""flexcage: rigid-flexible dynamics of rolling bearings with an elastic, deformed cage.

``import flexcage`` loads almost nothing: names come from their modules when first used (PEP 562).
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any

from flexcage._version import __version__

# name: the module that defines it
_LAZY: dict[str, str] = {
    "load_case": "flexcage.case",
    "load_extension": "flexcage.case",
    "Case": "flexcage.case",
    "StaticCase": "flexcage.case",
    "load_static": "flexcage.case",
    "solve_static": "flexcage.static",
    "ehl_traction": "flexcage.static",
    "simulate": "flexcage.simulate",
    "Run": "flexcage.simulate",
    "load_run": "flexcage.simulate",
    "converge": "flexcage.study.converge",
    "AngularContactBallBearing": "flexcage.geometry.angular_contact_ball",
    "DeepGrooveBallBearing": "flexcage.geometry.deep_groove_ball",
    "BallCage": "flexcage.geometry.ball_cages",
    "DisplacedPocket": "flexcage.geometry.ball_cage_defects",
    "ElongatedPocket": "flexcage.geometry.ball_cage_defects",
    "EnlargedPocket": "flexcage.geometry.ball_cage_defects",
    "WebCrack": "flexcage.geometry.ball_cage_defects",
    "MissingRivet": "flexcage.geometry.ball_cage_defects",
    "RibbonCage": "flexcage.geometry.ribbon_cage",
    "RollerBearing": "flexcage.geometry.cylindrical_roller",
    "RollerProfile": "flexcage.geometry.cylindrical_roller",
    "Spall": "flexcage.geometry.cylindrical_roller",
    "WindowCage": "flexcage.geometry.cages",
    "CrossbeamDefect": "flexcage.geometry.cages",
    "SideBeamDefect": "flexcage.geometry.cages",
    "Material": "flexcage.geometry.materials",
    "MATERIALS": "flexcage.geometry.materials",
    "load_preset": "flexcage.geometry.presets",
    "preset_names": "flexcage.geometry.presets",
    "epicyclic": "flexcage.geometry.kinematics",
    "SNCurve": "flexcage.stress.sn_curves",
    "WearLaw": "flexcage.stress.wear_laws",
    "MeshOptions": "flexcage.mesh.options",
    "ModesSpec": "flexcage.modes.spec",
    "DampingBand": "flexcage.modes.spec",
    "Contacts": "flexcage.contacts.spec",
    "PairSpec": "flexcage.contacts.spec",
    "LandSpec": "flexcage.contacts.spec",
    "NormalLaw": "flexcage.contacts.spec",
    "FrictionLaw": "flexcage.contacts.spec",
    "EhlTraction": "flexcage.contacts.spec",
    "Lubricant": "flexcage.contacts.spec",
    "CageCentre": "flexcage.system.spec",
    "CageSpeed": "flexcage.system.spec",
    "Constraint": "flexcage.system.spec",
    "Drive": "flexcage.system.spec",
    "InnerPath": "flexcage.system.spec",
    "Load": "flexcage.system.spec",
    "Mount": "flexcage.system.spec",
    "Limits": "flexcage.system.spec",
    "StaticOptions": "flexcage.system.statics.options",
    "StaticSolution": "flexcage.system.statics.solution",
    "StartOptions": "flexcage.system.spec",
    "SolverOptions": "flexcage.solve.options",
    "OutputOptions": "flexcage.results.options",
    "LaserSetup": "flexcage.results.instrument",
    "load_readings": "flexcage.results.instrument",
    "Study": "flexcage.study.spec",
    "Repeat": "flexcage.study.spec",
    "load_study": "flexcage.study.spec",
    "Grid": "flexcage.study.axes",
    "Zip": "flexcage.study.axes",
    "Points": "flexcage.study.axes",
    "LatinHypercube": "flexcage.study.axes",
    "Sobol": "flexcage.study.axes",
    "run_study": "flexcage.study.run",
    "StudyResults": "flexcage.study.results",
    "FlexcageError": "flexcage.core.errors",
    "InputError": "flexcage.core.errors",
    "EnvironmentLacks": "flexcage.core.errors",
    "RunFailed": "flexcage.core.errors",
}
_ROOMS = ("render",)  # rooms that a user reaches as flexcage.<room>

__all__ = ["__version__", *_LAZY, *_ROOMS]


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return importlib.import_module(f"flexcage.{name}")
    if name not in _LAZY:
        raise AttributeError(f"module 'flexcage' has no attribute '{name}'")
    value = getattr(importlib.import_module(_LAZY[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


class _Package(ModuleType):
    """``flexcage.simulate`` is the function, though a module of that name is imported as well."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "simulate" and isinstance(value, ModuleType):
            return  # the import system would put the module in the function's place
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
