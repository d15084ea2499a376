"""Scanned trees: from the cylinders of a quantitative structure model to a plant.

file --read_scan--> Cylinders --repair--> Cylinders --join--> Joined --build_stems--> Plant --add_leaves--> Plant
"""

from windswept.plants.scans.grow_scan import grow_scan

__all__ = ["grow_scan"]
