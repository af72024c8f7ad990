from flexcage.cages.conical.build import build_conical_mesh as mesh
from flexcage.cages.conical.interface import CONICAL_INTERFACES as interfaces
from flexcage.cages.conical.proposal import propose_conical_cage as proposal
from flexcage.cages.window.places import WINDOW_PLACES as places

__all__ = ["interfaces", "mesh", "places", "proposal"]
