"""One folder a cage type, with its defects; a new one is that and its line in ``specs``.

``core.wings`` finds the ``CAGE_TYPE`` of every folder.
"""

from flexcage.cages.cage_type import CageType, cage_type_of, register_cage_type, riveted_cages

__all__ = ["CageType", "cage_type_of", "register_cage_type", "riveted_cages"]
