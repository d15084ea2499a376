"""From a file to a scene: what comes out, that it is the same each time, and the example."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.distance import pdist

from windswept.forms.read_toml import read_toml
from windswept.plants.underbrush import library, underbrush_names
from windswept.plants.weber_penn import grow
from windswept.scene.camera import view_at
from windswept.scene.form import SceneForm
from windswept.scene.load_scene import build_scene, load_scene
from windswept.scene.scene import PlantKind, Scene

EXAMPLE = Path(__file__).parents[2] / "examples" / "forest_edge.toml"

CAMERA = {"eye": [0.0, -30.0, 2.0], "target": [0.0, 0.0, 6.0]}
PLANT = {"source": "quaking_aspen", "position": [3.0, -4.0], "seed": 2, "yaw_degrees": 90.0}
STAND = {
    "count": 20,
    "area": {"rectangle": [-30.0, 5.0, 30.0, 40.0]},
    "source": [{"source": "hazel", "weight": 3.0}, {"source": "scots_pine", "spacing_m": 5.0}],
}


def scene_of(**tables: Any) -> Scene:
    return build_scene("test.toml", {"plant": [PLANT], "camera": CAMERA} | tables)


def same(first: Scene, second: Scene) -> bool:
    places = zip(first.placements, second.placements, strict=True)
    return first.kinds == second.kinds and all(
        np.array_equal(a.position, b.position) and np.array_equal(a.yaw, b.yaw) for a, b in places
    )


def test_one_plant_stands_where_it_was_put() -> None:
    scene = scene_of(ground={"kind": "hills", "relief_m": 8.0})
    assert scene.kinds == (PlantKind("quaking_aspen", 2),)
    x, y, z = scene.placements[0].position[0]
    assert (x, y) == (3.0, -4.0)
    assert z == pytest.approx(scene.terrain.height(3.0, -4.0))
    assert scene.placements[0].yaw[0] == pytest.approx(math.pi / 2)


def test_stand_is_shared_out_by_weight_over_few_individuals() -> None:
    scene = scene_of(stand=[STAND], plant=[], seed=5)
    counts = {kind: placements.count for kind, placements in zip(scene.kinds, scene.placements, strict=True)}
    assert scene.placement_count == 20
    assert sum(count for kind, count in counts.items() if kind.source == "hazel") == 15
    assert [counts[PlantKind("hazel", seed)] for seed in (5, 6, 7)] == [5, 5, 5]


def test_stand_keeps_its_spacing_and_area() -> None:
    scene = scene_of(stand=[STAND], plant=[])
    places = np.concatenate([placements.position for placements in scene.placements])[:, :2]
    assert pdist(places).min() >= 3.0 - 1e-5
    assert (places >= [-30.0, 5.0]).all()
    assert (places <= [30.0, 40.0]).all()


def test_equal_plants_share_one_kind() -> None:
    scene = scene_of(plant=[PLANT, PLANT | {"position": [9.0, 9.0]}], stand=[STAND | {"count": 2}])
    assert scene.kinds.count(PlantKind("quaking_aspen", 2)) == 1
    assert scene.placements[0].count == 2


def test_a_later_stand_moves_no_earlier_plant() -> None:
    alone = scene_of(stand=[STAND])
    more = {"count": 5, "area": {"ellipse": [0.0, -50.0, 30.0, 10.0]}, "source": [{"source": "black_tupelo"}]}
    both = scene_of(stand=[STAND, more])
    for kind, placements in zip(alone.kinds, alone.placements, strict=True):
        there = both.placements[both.kinds.index(kind)]
        np.testing.assert_array_equal(there.position, placements.position)


def test_wind_tables_become_wind() -> None:
    wind = scene_of(
        wind={
            "speed_m_s": 6.0,
            "direction_degrees": 90.0,
            "roughness_m": 0.3,
            "gust": [
                {"start_s": 2.0, "strength_m_s": 8.0},
                {"start_s": 3.0, "strength_m_s": 1.0, "width_m": 9.0},
            ],
            "waves": [{"wavelength_m": 20.0, "speed_m_s": 5.0, "amplitude_m_s": 1.0, "push_degrees": 0.0}],
        }
    ).wind
    assert wind.mean.vector == pytest.approx((0.0, 6.0))
    assert wind.profile.roughness == 0.3
    assert wind.gusts[0].azimuth == pytest.approx(math.pi / 2)
    assert [gust.width for gust in wind.gusts] == [math.inf, 9.0]
    own = wind.waves.sets[1].waves
    assert (own.travel[0], own.push[0]) == pytest.approx((math.pi / 2, 0.0))


def test_no_speed_and_no_gust_is_calm() -> None:
    wind = scene_of(wind={"speed_m_s": 0.0}).wind
    assert not wind.waves.sets
    assert wind.mean.vector == (0.0, 0.0)


def test_camera_heights_are_above_the_ground() -> None:
    scene = scene_of(ground={"kind": "hills", "relief_m": 8.0})
    view = view_at(scene.camera, 0.0)
    assert view.eye[2] == pytest.approx(2.0 + float(scene.terrain.height(0.0, -30.0)), abs=1e-5)
    assert view.fov_y == pytest.approx(math.radians(40.0))


def test_camera_keys_become_a_path() -> None:
    keys = [
        {"time_s": 0.0, **CAMERA},
        {"time_s": 5.0, **CAMERA, "eye": [5.0, -30.0, 2.0], "fov_degrees": 20.0},
    ]
    camera = scene_of(camera={"key": keys}).camera
    assert camera.time.tolist() == [0.0, 5.0]
    assert camera.fov_y == pytest.approx(np.radians([40.0, 20.0]))


def test_sun_and_time() -> None:
    scene = scene_of(
        sun={"azimuth_degrees": 90.0, "elevation_degrees": 30.0}, time={"duration_s": 2.0, "fps": 30}
    )
    assert scene.sun_direction == pytest.approx([0.0, math.cos(math.pi / 6), 0.5], abs=1e-6)
    assert scene.frame_count == 60


def test_same_file_same_scene_and_seed_replaces() -> None:
    first, second = load_scene(EXAMPLE), load_scene(str(EXAMPLE))
    assert same(first, second)
    np.testing.assert_array_equal(first.terrain.heights, second.terrain.heights)
    other = load_scene(EXAMPLE, seed=99)
    assert other.seed == 99
    assert not same(first, other)


def test_form_survives_the_round_trip_through_its_values() -> None:
    form = SceneForm.model_validate(read_toml(EXAMPLE, 1 << 20, "a scene file"))
    assert SceneForm.model_validate(form.model_dump(exclude_none=True)) == form


def test_example_is_a_forest_edge_with_a_gust_across_the_view() -> None:
    scene = load_scene(EXAMPLE)
    assert 35 <= scene.placement_count <= 60
    assert {kind.source for kind in scene.kinds} >= {"quaking_aspen", "scots_pine", "hazel", "weeping_willow"}
    (gust,) = scene.wind.gusts
    for x, low, high in ((-45.0, 2.5, 4.0), (45.0, 7.0, 9.0)):
        arrival = gust.start + (x - gust.position[0]) * math.cos(gust.azimuth) / gust.speed
        assert low < arrival < high
    assert scene.frame_count == 168


def test_species_file_relative_to_the_scene_file(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(built_in("hazel"))
    (tmp_path / "scene.toml").write_text(
        '[[plant]]\nsource = "own.toml"\nposition = [0, 0]\n[camera]\neye = [0, -9, 1]\ntarget = [0, 0, 1]\n'
    )
    assert load_scene(tmp_path / "scene.toml").kinds[0].source == str(tmp_path / "own.toml")


def test_a_species_is_a_lone_plant(tmp_path: Path) -> None:
    scene = load_scene("hazel", seed=3)
    assert scene.kinds == (PlantKind("hazel", 3),)
    assert scene.placement_count == 1
    assert not scene.terrain.heights.any()
    (tmp_path / "own.toml").write_text(built_in("hazel"))
    assert load_scene(tmp_path / "own.toml").kinds[0].source == str(tmp_path / "own.toml")


@pytest.mark.parametrize(("species", "seed"), [("hazel", 0), ("california_black_oak", 1)])
def test_a_lone_plant_fills_the_picture_whatever_its_size(species: str, seed: int) -> None:
    scene = load_scene(species, seed=seed)
    tips = grow(species, seed).link_tip
    view = view_at(scene.camera, 0.0)
    forward = (view.target - view.eye) / np.linalg.norm(view.target - view.eye)
    rays = tips - view.eye
    angle = np.arccos(rays @ forward / np.linalg.norm(rays, axis=1)).max()
    assert 0.25 * view.fov_y < angle < 0.5 * view.fov_y


def built_in(species: str) -> str:
    """Text of a built-in species file."""
    import windswept.plants

    return (Path(windswept.plants.__path__[0]) / "species" / f"{species}.toml").read_text()


@pytest.mark.parametrize("source", underbrush_names())
def test_underbrush_is_a_patch_inside_the_picture(source: str) -> None:
    scene = load_scene(source, 3)
    assert scene.placement_count == 0
    [colony] = scene.colonies
    assert (colony.source, colony.count) == (source, 64)
    assert np.abs(colony.position[:, :2]).max() <= 1.0
    assert np.ptp(colony.position[:, :2], axis=0).min() > 1.5
    view = view_at(scene.camera, 0.0)
    forward = (view.target - view.eye) / np.linalg.norm(view.target - view.eye)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    ray = colony.position - view.eye
    ray /= (ray @ forward)[:, None]
    half = np.tan(0.5 * view.fov_y)
    assert np.abs(ray @ np.cross(right, forward)).max() < half
    assert np.abs(ray @ right).max() < half * 16.0 / 9.0
    np.testing.assert_array_equal(load_scene(source, 3).colonies[0].position, colony.position)
    assert (load_scene(source, 4).colonies[0].position != colony.position).any()


def test_a_file_of_underbrush_is_a_patch_too(tmp_path: Path) -> None:
    text = (Path(library.__file__).parent / "species" / "common_poppy.toml").read_text(encoding="utf-8")
    own = tmp_path / "own.toml"
    own.write_text(text.replace('"common_poppy"', '"own_poppy"'))
    assert load_scene(own).colonies[0].source == str(own)
