"""Underbrush: grass, reed, fern, clover, flowers and low shrubs, as tufts of blades (Endo, Morimoto and Fabris 2003).

::

    species file --load_underbrush--> UnderbrushSpecies   library.py, form.py
    UnderbrushSpecies --grow_tuft-->  Tuft                grow_tuft.py: which blade stands where, on what
    Component --build_blade-->        Blade               blade.py: vectors, stiffness and mass, shared
"""

from windswept.plants.underbrush.blade import Blade, build_blade
from windswept.plants.underbrush.blade_pose import BladePose
from windswept.plants.underbrush.form import Component, UnderbrushSpecies
from windswept.plants.underbrush.grow_tuft import grow_tuft
from windswept.plants.underbrush.library import load_underbrush, underbrush_names
from windswept.plants.underbrush.tuft import Tuft

__all__ = [
    "Blade",
    "BladePose",
    "Component",
    "Tuft",
    "UnderbrushSpecies",
    "build_blade",
    "grow_tuft",
    "load_underbrush",
    "underbrush_names",
]
