"""`springs` with simulation levels on the card: the state never leaves it.

::

    GrownKind --rung_arrays--> RungArrays    every level of every kind, one after another   (rung_arrays.py, rows.py)
              --room_for-->    how many placements each level has room for                  (room.py)
    Wind      --air_rows-->    the sources of a moment, a few rows                          (air.py)
    Field     --CardField-->   what a force field adds to it, on a grid                     (card_field.py)
    RungArrays --CardState-->  buffers on the card                                          (card_state.py)
    CardState --Walk-->        choose, change levels, sample winds, step, pose              (walk.py, shaders/*.wgsl)

`GpuSimulation` in simulation.py walks down these steps as `scene.Simulation` does on the CPU, and lets the scene's
underbrush (gpu/blades/) step beside its plants. The force field itself is stepped on the CPU. Placements of a level
stand in blocks of LANES, placement fastest, so that a workgroup reads 1 KiB at a time.
"""
