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
