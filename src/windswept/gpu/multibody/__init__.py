"""`multibody` on the card: every link a rigid body, all coupled, as ``motion.multibody`` is on the CPU.

::

    Model --coupled_arrays--> CoupledArrays      rods of every kind, and where its memory begins  (coupled_arrays.py)
    CoupledState --put--> joints, carried rows --states--> CoupledState                           (coupled_rows.py)
    CardState --CoupledWalk--> the wind, three walks a step, poses              (walk.py, shaders/multibody*.wgsl)

`CoupledSimulation` in simulation.py is a ``GpuSimulation`` whose links are coupled: wind, posing and drawing are those
of springs/, and joints lie where they lie there.
"""
