"""`multibody` on the card: every link a rigid body, all coupled, as ``motion.multibody`` is on the CPU.

::

    RungArrays --coupled_arrays--> CoupledArrays  rods of coupled rungs, where memory begins (coupled_arrays.py)
    CoupledState --put--> joints, carried rows --states--> CoupledState                          (coupled_rows.py)
    CardState --CoupledWalk--> changes of level, the wind, three walks a step, poses  (walk.py, shaders/multibody*.wgsl)

`CoupledSimulation` in simulation.py is a ``GpuSimulation`` some rungs of which are coupled: levels, wind, posing and
drawing are those of springs/, joints and groups lie where they lie there, and the other rungs are stepped as there.
"""
