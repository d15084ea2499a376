"""Pictures after Skjermo's figures 3, 6 and 7: what the deformer's parameters do, and a wood in a gust."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.frame import Camera
from windswept.motion.bend_plant import plant_branches
from windswept.plants.plant import Floats, Ints, Plant
from windswept.plants.species import load_species
from windswept.plants.weber_penn import grow
from windswept.render.offscreen import write_png
from windswept.studies.bench_plants import cut_to_links
from windswept.studies.branch_scene import BranchScene, bare, branch_scene
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.plausible_waves import plausible_waves
from windswept.wind.waves import WaveSchedule, WaveSet
from windswept.wind.wind import Wind, calm

SHAPES = (
    *({"taper": 1.0}, {"taper": 2.0}, {"taper": 2.6}),
    *({"flare": 0.0}, {"flare": 0.8}, {"flare": 2.5}),
    *({"bulges": 0.0}, {"bulges": 0.05}, {"bulges": 0.1}),
    *({"lobes": 0.0}, {"lobes": 0.1}, {"lobes": 0.2}),
)
"""One parameter at a time, three values each, as in figure 3: taper, flare, depth of 5 bulges, depth of 7 lobes."""
STEM_HEIGHT, STEM_RADIUS, STEM_SPACING = 3.0, 0.21, 1.05
"""Of the stems in that picture, m."""
SPECIES = ("wild_cherry", "sugar_maple", "quaking_aspen", "small_leaved_lime")
"""Of the wood: trees of some 1,100 to 1,900 branches each. Their leaves catch the wind and are not drawn."""
TREES = 120
"""More than the paper's hundred."""
SEED = 7
FINER = 2
"""Pixels drawn for one of the picture, along each side."""


def draw_deformer(path: Path, size: tuple[int, int] = (1600, 660)) -> None:
    """Stems with one parameter changed at a time, above in still air and below in wind, into a .png file."""
    stems = [_stem(**shape) for shape in SHAPES]
    limp = [replace(plant_branches(stem), flexibility=np.full(1, 0.012, np.float32)) for stem in stems]
    number = np.arange(len(stems))
    x = STEM_SPACING * (number + 0.6 * (number // 3) - 0.5 * number[-1] - 0.9)
    scene = branch_scene(
        stems,
        number.astype(np.int32),
        np.stack([x, 0.0 * x, 0.0 * x], axis=1).astype(np.float32),
        np.zeros(len(stems)),
        (size[0], size[1] // 2),
        kinds=limp,
        grids=((96, 56),),
    )
    camera = Camera((0.0, -17.0, 2.4), (0.25, 0.0, 1.5), 0.225)
    rows = []
    for wind in (calm(), Wind(mean=MeanWind(10.0, 0.0))):
        scene.bending.step_ordered(wind, 0.0)
        rows.append(scene.draw(camera))
    write_png(np.concatenate(rows), path)


def _stem(taper: float = 1.0, flare: float = 0.0, bulges: float = 0.0, lobes: float = 0.0) -> Plant:
    """An upright stem without branches."""
    tree = grow(load_species("lombardy_poplar"), 0)
    trunk = cut_to_links(bare(tree), int(tree.stem_link_start[1]))
    base = trunk.link_base[0]
    scale = STEM_HEIGHT / float(trunk.link_tip[-1, 2] - base[2])
    one = np.ones(1, np.float32)
    return replace(
        trunk,
        link_base=scale * (trunk.link_base - base),
        link_tip=scale * (trunk.link_tip - base),
        stem_radius=STEM_RADIUS * one,
        stem_taper=taper * one,
        stem_flare=flare * one,
        stem_lobes=7.0 * one,
        stem_lobe_depth=lobes * one,
        stem_full_length=STEM_HEIGHT * one,
        look=replace(tree.look, bark_relief=0.1, bark_bulges=5, bark_bulge_depth=bulges),
    )


def draw_wood(
    folder: Path, say: Callable[[str], None], trees: int = TREES, size: tuple[int, int] = (1600, 900)
) -> BranchScene:
    """A wood in still air and in a gust, and a strip of frames as the gust comes through, into .png files.

    Args:
        folder: gets ``skjermo_wood.png``, ``skjermo_gust.png`` and ``skjermo_strip.png``.
        say: told what is done.
        trees: how many stand in it.
        size: width and height of the pictures, pixels.
    """
    plants = [grow(load_species(name), SEED) for name in SPECIES]
    kind, position, yaw = _stand(trees, len(plants))
    scene = branch_scene(plants, kind, position, yaw, _finer(size))
    wind = gusty_wind()
    camera = Camera((-10.0, -36.0, 5.0), (2.0, 10.0, 7.6), 0.62)
    say(f"drawing {trees} trees, {scene.bending.branches.branch_count:,} branches")
    scene.bending.step_ordered(calm(), 0.0)
    write_png(_averaged(scene.draw(camera)), folder / "skjermo_wood.png")
    scene.bending.step_ordered(wind, GUST_TIME)
    write_png(_averaged(scene.draw(camera, GUST_TIME)), folder / "skjermo_gust.png")
    near = Camera((-4.0, -30.0, 3.0), (-4.0, 0.0, 7.4), 0.62)
    scene.renderer.resize(_finer((size[0] // 4, size[1] // 2)))
    frames = []
    for time in GUST_TIME + np.array([-4.0, -2.4, -0.8, 0.8]):
        scene.bending.step_ordered(wind, float(time))
        frames.append(_averaged(scene.draw(near, float(time))))
    write_png(np.concatenate(frames, axis=1), folder / "skjermo_strip.png")
    return scene


def _finer(size: tuple[int, int]) -> tuple[int, int]:
    return FINER * size[0], FINER * size[1]


def _averaged(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """A picture of a FINER-th of the size: twigs far thinner than a pixel would be dotted lines."""
    height, width, channels = picture.shape
    cells = picture.reshape(height // FINER, FINER, width // FINER, FINER, channels)
    return np.round(cells.mean(axis=(1, 3))).astype(np.uint8)


GUST_TIME = 6.0
"""When the gust stands in the middle of the wood, s."""


def gusty_wind() -> Wind:
    """A strong wind along +x whose front reaches the wood's middle at GUST_TIME."""
    waves = plausible_waves(7.0, 0.3, seed=3, azimuth=0.15, along_count=3, cross_count=1)
    front = Gust(GUST_TIME, 10.0, 0.15, (10.0, 0.0), speed=11.0, rise_length=25.0, hold_length=10.0)
    return Wind(mean=MeanWind(7.0, 0.15), waves=WaveSchedule((WaveSet(waves),)), gusts=(front,))


def _stand(trees: int, kinds: int) -> tuple[Ints, Floats, Floats]:
    """Kind (P,), position (P, 3) and yaw (P,) of trees on a jittered grid that lies behind a clearing."""
    rng = np.random.default_rng(SEED)
    columns = int(np.ceil(np.sqrt(1.4 * trees)))
    number = np.arange(trees)
    across = 6.5 * (number % columns - 0.5 * columns)
    along = 6.5 * (number // columns)
    position = np.stack([across, along, 0.0 * along], axis=1)
    position[:, :2] += rng.uniform(-2.2, 2.2, (trees, 2))
    kind = rng.integers(0, kinds, trees).astype(np.int32)
    yaw = rng.uniform(0.0, 2.0 * np.pi, trees).astype(np.float32)
    return kind, position.astype(np.float32), yaw
