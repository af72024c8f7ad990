from flexcage.bearings.family import register_family as bearing_family
from flexcage.cages.cage_type import register_cage_type as cage_type
from flexcage.case.presets import register_preset as preset
from flexcage.contacts.laws import register_friction as friction_law
from flexcage.contacts.laws import register_normal as normal_law
from flexcage.core.spec import option, quantity
from flexcage.geometry.bearing import bearing_type
from flexcage.geometry.defect import register_defect as cage_defect
from flexcage.geometry.materials import register_material as material
from flexcage.geometry.temperature import register_modulus_curve as modulus_curve
from flexcage.modes.registry import register_basis as mode_basis
from flexcage.render.album import register_picture as picture
from flexcage.results.figures.own import register_figure as figure
from flexcage.results.registry import Variable
from flexcage.results.registry import register as variable
from flexcage.solve.integrators import register_integrator as integrator
from flexcage.stress.sn_curves import register_sn_curve as sn_curve
from flexcage.stress.wear_laws import register_wear_law as wear_law
from flexcage.study.own import register_outputs as outputs
from flexcage.system.constraints import register_constraint as constraint
from flexcage.verification.chapter import register_case as known_answer

__all__ = [
    "Variable",
    "bearing_family",
    "bearing_type",
    "cage_defect",
    "cage_type",
    "constraint",
    "figure",
    "friction_law",
    "integrator",
    "known_answer",
    "material",
    "mode_basis",
    "modulus_curve",
    "normal_law",
    "option",
    "outputs",
    "picture",
    "preset",
    "quantity",
    "sn_curve",
    "variable",
    "wear_law",
]
