from flexcage.cages.machined.build import build_ball_cage_mesh as mesh
from flexcage.cages.machined.proposal import propose_machined_cage as proposal
from flexcage.cages.round_pocket.interface import ROUND_INTERFACES as interfaces
from flexcage.cages.round_pocket.places import ROUND_PLACES as places

__all__ = ["interfaces", "mesh", "places", "proposal"]
