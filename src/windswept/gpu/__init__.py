"""The card: the only place that creates devices, buffers and pipelines.

What stays is uploaded once, what moves is uploaded every frame, and one plan ties them together::

    Plant, Geometry, Look --plant_arrays--> rest buffers   (plant_buffers.py, layouts.py = shaders/types.wgsl)
    Frame --draw_list--> what to draw of each placement    (draw_list.py, by geometry/detail.py)
          --Culling--> the same, on the card               (culling/, where the motion is there too)
          --DrawPlan--> indirect dispatches and draws      (draw_plan.py, written by either)
          --Posing--> posed pieces and leaves              (posing.py, shaders/curves.wgsl)
          --PlantDrawing--> shadow map, then picture       (plant_drawing.py, shaders/bark.wgsl, leaves.wgsl)
          --MeadowDrawing--> blades of underbrush          (meadow/, shaders/blades_pose.wgsl, blades.wgsl)
          --Balls--> balls of the force field              (balls.py, shaders/balls.wgsl)
          --Backdrop--> ground, sky, and a made-up lawn    (backdrop.py, lawn.py, shaders/grass.wgsl, ...)
                        where a scene has no underbrush

Where the simulation runs on the card too (springs/, blades/), a frame is wind, steps, cull, pose, curves, picture
without read-back: the card chooses what is drawn, ``Frame.motion`` poses that alone (seating.py, pose_order.py), and
nothing of a placement is uploaded; ``Frame.meadow`` names the buffer in which blades lean. See
docs/decisions/plants-chosen-on-the-card.md and blades-on-the-card.md.

`Renderer` in renderer.py walks down these steps; frame.py holds the nouns it is given. Bind group 0 is the frame's
uniforms, 1 belongs to whoever draws, 2 is light (lighting.py, shaders/light.wgsl). All kinds of plants lie in the
same buffers, so a frame is some ten draws however many kinds and placements it has.
"""
