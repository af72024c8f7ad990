"""One file or folder a cage type, with its defects; a new one is that and its lines here and in
``specs``."""

from flexcage.cages.cage_type import CageType, cage_type_of, register_cage_type, riveted_cages
from flexcage.cages.machined import MACHINED
from flexcage.cages.ribbon import RIBBON
from flexcage.cages.window import WINDOW

MEMBERS = (
    WINDOW,
    MACHINED,
    RIBBON,
)

__all__ = ["MEMBERS", "CageType", "cage_type_of", "register_cage_type", "riveted_cages"]
