"""Blades: grass, leaves and flowers that go to equilibrium poses computed beforehand (Endo, Morimoto and Fabris 2003).

::

    Blade --chain_of-->            Chain         chain.py: sections on springs
    (Chain, load) --rest_shape-->  RestShape     rest_shape.py: true equilibrium (newton.py), or the paper's pass
    Chain --build_table-->         PoseTable     pose_table.py: equilibria by angle, norm and direction of the load
    PoseTable --simplify_table-->  PoseTable     simplify_table.py: fewer sections, the tip where it was
    Blade --build_kind-->          BladeKind     kind.py: tables, frequency, drag of one component
    (Tufts, places) --plant_tufts--> [Blades]    plant_tufts.py: who stands where, on whom
    Blades --step_in_field-->      BladeState    step_blades.py: a million leans (lean.py) in the wind (field.py)
    (Blades, BladeState) --pose_blades--> BladePose  pose_blades.py: where every section is now
"""

from windswept.motion.blades.blades import Blades, BladeState, place_blades, rest_blades
from windswept.motion.blades.chain import Chain, build_chain
from windswept.motion.blades.field import PackedField, pack_field
from windswept.motion.blades.kind import BladeKind, build_kind, chain_of
from windswept.motion.blades.plant_tufts import TuftPlaces, plant_tufts
from windswept.motion.blades.pose_blades import pose_blades
from windswept.motion.blades.pose_table import DEFAULT_BINS, Bins, PoseTable, build_table
from windswept.motion.blades.rest_shape import RestShape, rest_shape
from windswept.motion.blades.simplify_table import simplify_table
from windswept.motion.blades.step_blades import step_in_field, step_in_given

__all__ = [
    "DEFAULT_BINS",
    "Bins",
    "BladeKind",
    "BladeState",
    "Blades",
    "Chain",
    "PackedField",
    "PoseTable",
    "RestShape",
    "TuftPlaces",
    "build_chain",
    "build_kind",
    "build_table",
    "chain_of",
    "pack_field",
    "place_blades",
    "plant_tufts",
    "pose_blades",
    "rest_blades",
    "rest_shape",
    "simplify_table",
    "step_in_field",
    "step_in_given",
]
