"""The meadow on the card: blades posed and drawn from tables of equilibria, fewer and simpler with distance.

::

    beds   --meadow_rows--> MeadowRows   meadow_rows.py: tables, borders and blades, uploaded once
    eye    --BladeChoice--> items, indirect arguments   blade_choice.py, shaders/blade_choice.wgsl: which blades are
                                         drawn, with how many sections; blade_list.py is the plain formula
    leans  --MeadowDrawing-->  picture   meadow_drawing.py, shaders/blades_pose.wgsl and blades.wgsl
"""

from windswept.gpu.meadow.meadow_drawing import MeadowDrawing

__all__ = ["MeadowDrawing"]
