"""What stands where, in which wind, seen from where.

scene file --read_toml--> tables --SceneForm--> checked values --load_scene--> Scene
(Area, spacings, Terrain) --scatter--> Placements
Scene.kinds --grow_kinds--> one Plant for each kind
"""
