"""Pictures of meshes, modes, stress and runs. Every function returns the path it wrote.

They take meshes, arrays and datasets; pyvista and matplotlib are loaded when one is called.
"""

from flexcage._names import lazy

__getattr__, __dir__ = lazy(__name__, __file__)
