"""One plant for each kind, in order."""

from windswept.scene.grow_kinds import grow_kinds
from windswept.scene.load_scene import build_scene

CAMERA = {"eye": [0.0, -30.0, 2.0], "target": [0.0, 0.0, 6.0]}


def test_each_kind_is_grown_once_in_order() -> None:
    plants = [{"source": "hazel", "position": [x, 0.0], "seed": seed} for x, seed in ((0, 5), (4, 2), (8, 5))]
    scene = build_scene("test.toml", {"plant": plants, "camera": CAMERA})
    told: list[str] = []
    grown = grow_kinds(scene, told.append)
    assert [(plant.species, plant.seed) for plant in grown] == [("hazel", 5), ("hazel", 2)]
    assert told == ["growing hazel, seed 5", "growing hazel, seed 2"]
