from flexcage.cages.ribbon.build import build_ribbon_mesh as mesh
from flexcage.cages.ribbon.proposal import propose_ribbon_cage as proposal
from flexcage.cages.round_pocket.interface import ROUND_INTERFACES as interfaces
from flexcage.cages.round_pocket.places import ROUND_PLACES as places

__all__ = ["interfaces", "mesh", "places", "proposal"]
