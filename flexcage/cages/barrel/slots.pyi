from flexcage.cages.barrel.proposal import propose_barrel_cage as proposal
from flexcage.cages.conical.build import build_conical_mesh as mesh
from flexcage.cages.conical.interface import CONICAL_INTERFACES as interfaces
from flexcage.cages.window.places import WINDOW_PLACES as places

__all__ = ["interfaces", "mesh", "places", "proposal"]
