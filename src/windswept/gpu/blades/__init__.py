"""`blades` on the card: leans that never leave it.

::

    [Blades]      --lean_rows--> blocks, kinds, constants   lean_rows.py, layouts.py = shaders/lean_types.wgsl
    [PackedField] --air_grids--> nodes of the air           lean_rows.py
                  --Leaning-->   leans, stepped             leaning.py, shaders/lean.wgsl
    (beds, wind, field) --CardMeadow--> all underbrush of a scene in motion   card_meadow.py

``Leaning.leans`` is the buffer from which ``shaders/blades_pose.wgsl`` looks poses up.
"""

from windswept.gpu.blades.card_meadow import CardMeadow
from windswept.gpu.blades.leaning import Leaning

__all__ = ["CardMeadow", "Leaning"]
