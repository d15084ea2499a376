"""Skjermo's two passes on the card: bend every branch, then draw it straight from where it was bent.

Branches --branch_rows--> Branch, BranchLook rows       (branch_rows.py, layouts.py = shaders/bend_types.wgsl)
Wind     --breeze-------> what blows now, one uniform   (breeze.py)
         --Bending------> bent branches, two buffers    (bending.py, shaders/bend.wgsl)
         --BranchDrawing> shadow map and picture        (branch_drawing.py, shaders/bend_pieces.wgsl, bark.wgsl)
"""

from windswept.gpu.bend.bending import Bending
from windswept.gpu.bend.branch_drawing import BranchDrawing
from windswept.gpu.bend.branch_rows import branch_look_rows

__all__ = ["Bending", "BranchDrawing", "branch_look_rows"]
