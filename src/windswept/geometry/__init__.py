"""The drawn form of plants, in NumPy and Numba: what the card does each frame stands here as a plain formula.

::

    Plant --build_geometry--> Geometry              curves.py: pieces, stations, frames (fit.py), light (openness.py)
    (Geometry, Pose) --pose_curves--> PosedCurves   pose_curves.py; on the card gpu/shaders/curves.wgsl
    PosedCurves --bark_surface--> Surface           bark.py; on the card gpu/shaders/bark.wgsl
    Geometry --detail_order, choose_detail--> Detail  detail.py: how much is drawn, by size on the screen
    leaf_mesh                                       leaves.py: blades of every shape
    (Blade, BladePose) --blade_surface--> BladeSurface  blades.py: underbrush
"""
