"""What of a frame is drawn, chosen on the card: for frames whose motion is there already.

::

    placements --standing_rows--> rows that stay                       (standing_rows.py)
    View --Culling--> DrawPlan and Seating, nothing read back          (culling.py, shaders/cull.wgsl, cull_places.wgsl)
         --Tally--> what was drawn and what lacked room, frames later  (tally.py)

`draw_list.py` and `draw_plan.py` are the same on the CPU. Poses have seats as people have: only who is drawn gets some,
and of those only the links that its detail needs (``pose_order.py``). Where there is no room for all, those
nearest to the camera are drawn, by bands of distance, and the others are counted.
"""

from windswept.gpu.culling.culling import Culling
from windswept.gpu.culling.tally import Tally, Told, told_of

__all__ = ["Culling", "Tally", "Told", "told_of"]
