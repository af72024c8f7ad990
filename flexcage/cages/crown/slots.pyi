from flexcage.cages.crown.build import build_crown_mesh as mesh
from flexcage.cages.crown.interface import CROWN_INTERFACES as interfaces
from flexcage.cages.crown.places import CROWN_PLACES as places
from flexcage.cages.crown.proposal import propose_crown_cage as proposal

__all__ = ["interfaces", "mesh", "places", "proposal"]
