from flexcage.cages.window.build import build_window_mesh as mesh
from flexcage.cages.window.interface import WINDOW_INTERFACES as interfaces
from flexcage.cages.window.places import WINDOW_PLACES as places
from flexcage.cages.window.proposal import propose_window_cage as proposal

__all__ = ["interfaces", "mesh", "places", "proposal"]
