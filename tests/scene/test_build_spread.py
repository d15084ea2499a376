"""A scene file's ground, nutrients and spread: what comes of them, and each mistake in one line."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from windswept.errors import InputError
from windswept.scene.load_scene import build_scene, load_scene
from windswept.scene.scene import Scene

CAMERA = {"eye": [0.0, -30.0, 2.0], "target": [0.0, 0.0, 6.0]}
CLOVER: dict[str, Any] = {
    "source": "white_clover",
    "points": [[0.0, 0.0]],
    "radius_m": 0.1,
    "height_m": 0.15,
    "need": [{"nutrient": "moisture", "amount": 0.3}],
}
HAZEL = {"source": "hazel", "points": [[3.0, 3.0]], "radius_m": 0.2, "spacing_m": 2.0, "height_m": 4.0}
MOISTURE = {"name": "moisture", "kind": "noise", "poor": 0.1, "patch_m": 8.0}
GOOD: dict[str, Any] = {
    "camera": CAMERA,
    "ground": {"size_m": 20.0},
    "nutrient": [MOISTURE],
    "spread": {"species": [CLOVER], "rounds": 8},
}


def scene_of(folder: Path | None = None, **tables: Any) -> Scene:
    return build_scene(str((folder or Path()) / "test.toml"), GOOD | tables)


def with_clover(**keys: Any) -> dict[str, Any]:
    return {"spread": {"species": [CLOVER | keys], "rounds": 3}}


def test_underbrush_is_a_colony_and_trees_are_placements() -> None:
    scene = scene_of(
        ground={"kind": "hills", "size_m": 20.0}, spread={"species": [CLOVER, HAZEL], "rounds": 12}
    )
    (colony,) = scene.colonies
    assert colony.source == "white_clover"
    assert colony.count > 300
    x, y, z = colony.position.T
    np.testing.assert_allclose(z, scene.terrain.height(x, y), atol=1e-5)
    assert colony.size.min() >= 0.8 - 1e-6
    assert colony.size.max() <= 1.2 + 1e-6
    assert {kind.source for kind in scene.kinds} == {"hazel"}
    assert len(scene.kinds) == 3
    assert scene.placement_count > 3


def test_the_same_file_is_the_same_meadow() -> None:
    first, second, other = scene_of(), scene_of(), scene_of(seed=1)
    assert first.colonies[0].position.tobytes() == second.colonies[0].position.tobytes()
    assert first.colonies[0].yaw.tobytes() == second.colonies[0].yaw.tobytes()
    assert first.colonies[0].position.tobytes() != other.colonies[0].position.tobytes()


def test_spreading_moves_nothing_that_a_person_placed() -> None:
    plant = {"source": "hazel", "position": [1.0, 1.0]}
    scene = scene_of(plant=[plant], spread={"species": [CLOVER, HAZEL | {"points": []}], "rounds": 12})
    assert scene.placements[0].position[0].tolist() == [1.0, 1.0, 0.0]
    # The hazel that was placed is a propagation point of its species.
    assert scene.placement_count > 1
    away = np.hypot(*(scene.colonies[0].position[:, :2] - 1.0).T)
    assert away.min() > 0.2 + 0.08 - 1e-6


def test_species_of_underbrush_from_a_file(tmp_path: Path) -> None:
    from windswept.plants.underbrush import library

    text = (Path(library.__file__).parent / "species" / "white_clover.toml").read_text()
    (tmp_path / "own.toml").write_text(text)
    scene = scene_of(tmp_path, **with_clover(source="own.toml"))
    assert scene.colonies[0].source == str(tmp_path / "own.toml")


def test_nutrients_from_an_image_lie_as_the_image_does(tmp_path: Path) -> None:
    # White in the north-west only.
    grey = np.zeros((20, 20), np.uint8)
    grey[:10, :10] = 255
    Image.fromarray(grey).save(tmp_path / "moist.png")
    image = {"name": "moisture", "kind": "image", "image": "moist.png"}
    points = [[-5.0, 5.0], [5.0, -5.0]]
    spread = {"species": [CLOVER | {"points": points, "distance_m": 3.0}], "rounds": 10}
    x, y, _ = scene_of(tmp_path, nutrient=[image], spread=spread).colonies[0].position.T
    assert len(x) > 200
    assert np.mean((x < 0.5) & (y > -0.5)) == 1.0


def test_ground_from_an_image_lies_as_the_image_does(tmp_path: Path) -> None:
    rise = np.linspace(0, 65535, 33).astype(np.uint16)
    Image.fromarray(np.tile(rise, (33, 1))).save(tmp_path / "rise.png")
    ground = {"kind": "image", "image": "rise.png", "heights_m": [-2.0, 6.0], "size_m": 20.0}
    terrain = scene_of(tmp_path, ground=ground).terrain
    x = np.array([-10.0, 0.0, 5.0, 10.0])
    assert terrain.height(x, np.array([3.0, -8.0, 0.0, 10.0])) == pytest.approx(
        [-2.0, 2.0, 4.0, 6.0], abs=2e-3
    )
    assert terrain.slope(0.0, 0.0) == pytest.approx(np.arctan(8.0 / 20.0), rel=1e-3)
    north = np.tile(np.arange(33, dtype=np.uint8)[::-1, None] * 7, (1, 33))
    Image.fromarray(north).save(tmp_path / "north.png")
    terrain = scene_of(tmp_path, ground=ground | {"image": "north.png"}).terrain
    assert terrain.height(0.0, 9.0) > terrain.height(0.0, -9.0) + 5.0


BAD = {
    "point off the map": (
        with_clover(points=[[0.0, 0.0], [11.0, 0.0]]),
        "spread.species[0].points[1] = [11.0, 0.0]: expected x and y from -10 to 10",
    ),
    "no points": (
        with_clover(points=[]),
        "spread.species[0].points: expected at least one, or random_points",
    ),
    "unknown nutrient": (
        with_clover(need=[{"nutrient": "moistur", "amount": 0.3}]),
        "need[0].nutrient = 'moistur': expected the name of a [[nutrient]]: did you mean moisture?",
    ),
    "no nutrients": (
        {"nutrient": []},
        "need[0].nutrient = 'moisture': expected the name of a [[nutrient]]: there is none",
    ),
    "need twice": (
        with_clover(need=CLOVER["need"] * 2),
        "need[1].nutrient = 'moisture': expected each nutrient",
    ),
    "nutrient twice": (
        {"nutrient": [MOISTURE, MOISTURE]},
        "nutrient[1].name = 'moisture': expected a name that no other nutrient has",
    ),
    "unknown species": (
        with_clover(source="white_clovr"),
        "spread.species[0].source = 'white_clovr': expected a built-in species, underbrush or grammar, or a file: "
        "did you mean white_clover?",
    ),
    "reversed light": (with_clover(light=[0.9, 0.1]), "light = [0.9, 0.1]: expected the lower number first"),
    "reversed slope": (
        with_clover(slope_degrees=[30.0, 3.0]),
        "slope_degrees = [30.0, 3.0]: expected the lower",
    ),
    "narrow spacing": (with_clover(spacing_m=0.1), "spacing_m = 0.1: expected at least twice radius_m, 0.2"),
    "nothing grows": (
        {"nutrient": [{"name": "moisture", "rich": 0.0}]},
        "spread: expected ground, light and nutrients that suit a plant: none came up in 8 rounds",
    ),
    "no radius": (
        {"spread": {"species": [{"source": "heather", "height_m": 1.0}]}},
        "spread.species[0].radius_m: expected this key to be given: a number from 0.01 to 50",
    ),
    "area off the ground": (
        {"spread": {"species": [CLOVER], "area": {"rectangle": [0.0, 0.0, 11.0, 5.0]}}},
        "spread.area.rectangle = [11.0, 5.0]: expected x and y from -10 to 10",
    ),
    "image without a path": ({"ground": {"kind": "image"}}, "ground.image: expected this key to be given"),
    "path without the kind": (
        {"ground": {"kind": "hills", "image": "hills.png"}},
        "ground.kind = 'hills': expected \"image\", as an image is given",
    ),
    "image that is not there": (
        {"nutrient": [{"name": "moisture", "kind": "image", "image": "no.png"}]},
        "nutrient[0].image = 'no.png': expected an image that exists (looked for ",
    ),
    "image of another shape": (
        {"nutrient": [{"name": "moisture", "kind": "image", "image": "wide.png"}]},
        "nutrient[0].image = 'wide.png': expected a square image, as the ground is square: this one has 30 x 20",
    ),
    "heights in colour": (
        {"ground": {"kind": "image", "image": "colour.png"}},
        "colour.png: expected a grey image of 8 or 16 bit (PNG or TIFF): this one is in colour",
    ),
    "heights with holes": (
        {"ground": {"kind": "image", "image": "holes.tif"}},
        "holes.tif: expected an image without holes: 2 of its pixels have no value, the first in column 4, row 1",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_mistake_is_told_in_one_line(name: str, tmp_path: Path) -> None:
    Image.new("L", (30, 20)).save(tmp_path / "wide.png")
    Image.new("RGB", (20, 20)).save(tmp_path / "colour.png")
    holes = np.full((20, 20), 0.5, np.float32)
    holes[1, 4] = holes[7, 2] = np.nan
    Image.fromarray(holes).save(tmp_path / "holes.tif")
    tables, message = BAD[name]
    with pytest.raises(InputError) as caught:
        scene_of(tmp_path, **tables)
    text = str(caught.value)
    assert message in text
    assert text.startswith(str(tmp_path))
    assert "\n" not in text
    assert len(text.replace(str(tmp_path), "")) < 300


def test_example_is_a_meadow_with_trees() -> None:
    scene = load_scene(Path(__file__).parents[2] / "examples" / "meadow.toml")
    names = {colony.source for colony in scene.colonies}
    assert names >= {"meadow_fescue", "white_clover", "oxeye_daisy", "male_fern", "heather"}
    assert {kind.source for kind in scene.kinds} == {"hazel", "quaking_aspen"}
    assert sum(colony.count for colony in scene.colonies) > 50_000
