"""Spreading: rich ground is denser, stems keep apart, species part, limits hold, same seed means same meadow."""

import numpy as np
import pytest
from numba import get_num_threads, set_num_threads
from scipy.spatial import cKDTree

from windswept.scene.area import ellipse
from windswept.scene.spread.ecology import Ecology
from windswept.scene.spread.nutrients import Nutrient, constant_nutrient, noise_nutrient
from windswept.scene.spread.plot import build_plot
from windswept.scene.spread.population import Population
from windswept.scene.spread.spread import spread
from windswept.scene.terrain import Terrain, flat_terrain, hilly_terrain

SIZE = 24.0


def species(*rows: dict[str, float | list[float]]) -> Ecology:
    """Species that differ from a plain one in a few numbers; M is that of the first one's need."""
    plain = {
        "foot": 0.1, "spacing": 0.2, "reach": 0.2, "height": 0.4, "size_v": 0.2, "need": [0.3], "shade": 0.1,
        "light": [0.3, 1.0], "slope": [0.0, 1.0], "ground": [-100.0, 100.0], "vigour": 1.0, "turnover": 0.3,
        "offspring": 4, "distance": 1.0, "most": 10**6,
    }  # fmt: skip
    whole = ("offspring", "most")
    return Ecology(
        **{
            key: np.array([(plain | row)[key] for row in rows], int if key in whole else float)
            for key in plain
        }
    )


def plants_at(kinds: list[int], places: list[tuple[float, float]], placed: bool = False) -> Population:
    x, y = np.array(places, np.float32).reshape(-1, 2).T
    count = len(kinds)
    return Population(np.array(kinds, np.int32), x, y, np.ones(count, np.float32), np.full(count, placed))


NOBODY = plants_at([], [])


def scattered(kinds: int, each: int = 6) -> Population:
    places = np.random.default_rng(3).uniform(-0.5 * SIZE, 0.5 * SIZE, (kinds * each, 2))
    return plants_at(np.repeat(np.arange(kinds), each).tolist(), places.tolist())


def gradient(name: str, west: float, east: float) -> Nutrient:
    """From one amount at the western edge to another at the eastern."""
    return Nutrient(name, SIZE, np.tile(np.linspace(west, east, 65), (65, 1)))


def grow(
    ecology: Ecology,
    nutrients: list[Nutrient],
    terrain: Terrain | None = None,
    seed: int = 0,
    rounds: int = 25,
) -> Population:
    plot = build_plot(terrain or flat_terrain(SIZE), nutrients)
    return spread(plot, ecology, scattered(ecology.count), NOBODY, rounds, 10**6, seed)


def test_richer_ground_is_denser() -> None:
    soil = noise_nutrient("soil", SIZE, 0.05, 0.8, 10.0, np.random.default_rng(4))
    plants = grow(species({"need": [0.6]}), [soil])
    edges = np.linspace(-0.5 * SIZE, 0.5 * SIZE, 13)
    count, _, _ = np.histogram2d(plants.x, plants.y, bins=[edges, edges])
    middle = 0.5 * (edges[1:] + edges[:-1])
    richness = soil.amount(*np.meshgrid(middle, middle, indexing="ij"))
    assert np.corrcoef(count.ravel(), richness.ravel())[0, 1] > 0.9


def test_plants_take_what_there_is_and_no_more() -> None:
    # A plant of size 1 takes 0.5 pi 0.1^2, a sixth of what a cell holds: little is left in crumbs too small for it.
    ecology = species({"need": [0.5], "foot": 0.03, "spacing": 0.06, "reach": 0.1, "size_v": 0.3})
    plants = grow(ecology, [constant_nutrient("soil", SIZE, 0.55)], rounds=40)
    taken = np.sum(0.5 * np.pi * (0.1 * plants.size.astype(float)) ** 2)
    assert 0.8 * 0.55 * SIZE**2 < taken <= 0.55 * SIZE**2 * (1.0 + 1e-9)


def test_no_two_stems_are_closer_than_their_sizes_allow() -> None:
    ecology = species(
        {"foot": 0.06, "spacing": 0.12, "size_v": 0.4},
        {"foot": 0.09, "spacing": 0.6, "size_v": 0.2},
        {"foot": 0.35, "spacing": 3.0, "size_v": 0.0, "reach": 1.5, "height": 6.0},
    )
    plants = grow(ecology, [constant_nutrient("soil", SIZE, 3.0)])
    assert np.bincount(plants.species, minlength=3).min() >= 3
    assert plants.count > 5000
    feet = ecology.foot[plants.species] * plants.size
    assert -1e-6 < slack(plants, feet) < 0.01
    for kind in range(3):
        own = plants.only(plants.species == kind)
        assert slack(own, 0.5 * ecology.spacing[kind] * own.size) > -1e-6


def slack(plants: Population, radius: np.ndarray) -> float:
    """Least distance between the circles of any two plants, m; sums of radii are rounded to float32."""
    xy = np.stack([plants.x, plants.y], axis=1).astype(float)
    first, second = cKDTree(xy).query_pairs(3.0 * radius.max(), output_type="ndarray").T
    apart = np.linalg.norm(xy[first] - xy[second], axis=1)
    return float(np.min(apart - radius[first] - radius[second]))


def test_competing_species_part_where_each_alone_would_grow_everywhere() -> None:
    nutrients = [gradient("moisture", 0.1, 1.0), gradient("lime", 1.0, 0.1)]
    wet, dry = {"need": [0.5, 0.05]}, {"need": [0.05, 0.5]}
    both = grow(species(wet, dry), nutrients, rounds=40)
    east = both.x > 0.0
    assert np.mean(east[both.species == 0]) > 0.8
    assert np.mean(east[both.species == 1]) < 0.2
    alone = grow(species(wet, dry | {"most": 0}), nutrients, rounds=40)
    others_half = np.sum((alone.species == 0) & (alone.x < 0.0))
    assert others_half > 2 * np.sum((both.species == 0) & (both.x < 0.0))


def test_the_taller_shades_out_what_needs_light() -> None:
    # Crowns that take 0.9 of the light over a third of the ground; ferns that bear no sun.
    tree = {"height": 8.0, "reach": 2.0, "spacing": 4.0, "shade": -np.log(0.1), "need": [0.0], "size_v": 0.0}
    grass, fern = {"light": [0.5, 1.0]}, {"light": [0.02, 0.5], "height": 0.3}
    plants = grow(species(tree, grass, fern), [constant_nutrient("soil", SIZE, 3.0)])
    trees, grasses, ferns = (
        np.stack([plants.x, plants.y], axis=1)[plants.species == kind] for kind in range(3)
    )
    assert min(map(len, (trees, grasses, ferns))) > 10
    crown = cKDTree(trees)
    # A cell counts as shaded where its middle is under the crown: half its diagonal, 0.29 m, either way.
    assert crown.query(grasses)[0].min() > 2.0 - 0.29
    assert crown.query(ferns)[0].max() < 2.0 + 0.29


def test_slope_and_height_limits_hold_for_every_plant() -> None:
    hills = hilly_terrain(SIZE, 4.0, 12.0, np.random.default_rng(2))
    limits = {"slope": [0.1, 0.4], "ground": [-0.6, 0.9]}
    plants = grow(species(limits), [constant_nutrient("soil", SIZE, 1.0)], hills)
    x, y = plants.x.astype(float), plants.y.astype(float)
    height, slope = hills.height(x, y), np.tan(hills.slope(x, y))
    assert plants.count > 1000
    assert -0.6 - 1e-5 < height.min() < -0.5
    assert 0.8 < height.max() < 0.9 + 1e-5
    assert 0.1 - 1e-5 < slope.min() < 0.13
    assert 0.37 < slope.max() < 0.4 + 1e-5


def test_placed_plants_stay_spread_and_are_kept_clear_of() -> None:
    ecology = species(
        {"distance": 0.3}, {"foot": 1.0, "spacing": 2.0, "offspring": 0, "need": [0.0], "most": 0}
    )
    plot = build_plot(flat_terrain(SIZE), [constant_nutrient("soil", SIZE, 1.0)])
    placed = plants_at([0, 1], [(-3.0, 0.0), (-2.0, 2.0)], placed=True)
    plants = spread(plot, ecology, NOBODY, placed, 6, 10**6, 0)
    assert plants.count > 50
    assert (plants.species == 0).all()
    assert np.median(np.hypot(plants.x + 3.0, plants.y)) < 2.5
    assert np.hypot(plants.x + 2.0, plants.y - 2.0).min() >= 1.0 + 0.08 - 1e-6
    assert np.hypot(plants.x + 3.0, plants.y).min() >= 0.1 + 0.08 - 1e-6


def test_plants_stay_in_the_area() -> None:
    area = ellipse(2.0, -1.0, 6.0, 3.0)
    plot = build_plot(flat_terrain(SIZE), [], area)
    ecology = species({"need": []})
    plants = spread(plot, ecology, plants_at([0], [(2.0, -1.0)]), NOBODY, 20, 10**6, 0)
    assert plants.count > 200
    assert area.contains(np.stack([plants.x, plants.y], axis=1).astype(float)).all()
    assert np.ptp(plants.x) > 10.0


def test_most_is_kept_in_all_and_by_species() -> None:
    ecology = species({"most": 70}, {})
    plot = build_plot(flat_terrain(SIZE), [constant_nutrient("soil", SIZE, 1.0)])
    plants = spread(plot, ecology, scattered(2), NOBODY, 15, 500, 0)
    assert plants.count == 500
    assert np.sum(plants.species == 0) == 70


def test_half_of_the_seeds_fall_within_the_distance() -> None:
    # One round from one point onto ground without rivals for room: what settles is what fell.
    ecology = species({"foot": 0.0005, "spacing": 0.001, "distance": 2.0, "need": [], "offspring": 64})
    points = plants_at([0] * 30, [(0.0, 0.0)] * 30)
    plants = spread(build_plot(flat_terrain(400.0), []), ecology, points, NOBODY, 1, 10**6, 1)
    away = np.hypot(plants.x, plants.y)
    # 30,720 seeds, a few of which fall on others: the sampling error of the median's rank is 0.003.
    assert np.mean(away < 2.0) == pytest.approx(0.5, abs=0.015)
    # 2Dt with shape 2: 1 - F(5 m) = 1 / (1 + 25 (sqrt 2 - 1) / 4)^2.
    assert np.mean(away > 5.0) == pytest.approx(1.0 / (1.0 + 6.25 * (np.sqrt(2.0) - 1.0)) ** 2, abs=0.01)


def same(first: Population, second: Population) -> bool:
    fields = ("species", "x", "y", "size")
    return all(getattr(first, name).tobytes() == getattr(second, name).tobytes() for name in fields)


def test_same_seed_same_bytes_on_any_number_of_threads() -> None:
    ecology = species({}, {"foot": 0.15, "spacing": 0.5, "height": 0.8, "shade": 0.5})
    soil = [noise_nutrient("soil", SIZE, 0.1, 1.0, 9.0, np.random.default_rng(1))]
    threads = get_num_threads()
    many = grow(ecology, soil, seed=5)
    try:
        set_num_threads(1)
        one = grow(ecology, soil, seed=5)
    finally:
        set_num_threads(threads)
    assert many.count > 1000
    assert same(many, one)
    assert not same(many, grow(ecology, soil, seed=6))


def test_barren_ground_stays_bare() -> None:
    assert grow(species({}), [constant_nutrient("soil", SIZE, 0.0)], rounds=3).count == 0
