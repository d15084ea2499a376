"""Closed forms: beams, tip masses and chains (PHYSICS B2, B3), and MuJoCo's own mass matrix."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import build_plant, random_tree, straight
from windswept.motion.model import build_model
from windswept.motion.modes import plant_frequencies, stem_frequencies
from windswept.motion.rods import build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.plant import Material
from windswept.studies.mujoco_tree import mujoco_frequencies, mujoco_tree

WOOD = Material(youngs_modulus=9.5e9, wood_density=800.0)

# f = c D / L^2 sqrt(E / rho) for r(x) = R (1 - t x / L), PHYSICS B2.
TAPERED = {
    0.0: (0.1399, 0.8767, 2.4549),
    0.25: (0.1574, 0.8279, 2.2015),
    0.5: (0.1840, 0.7778, 1.9329),
    0.75: (0.2317, 0.7352, 1.6440),
    0.9: (0.2867, 0.7432, 1.4768),
    1.0: (0.3469, 0.8412, 1.5292),
}


@pytest.mark.parametrize("taper", TAPERED)
def test_cantilever_frequencies(taper: float) -> None:
    plant = build_plant(straight(10.0, 40, 0.1, max(0.1 * (1.0 - taper), 1e-6)), WOOD)
    skeleton, rods = build_skeleton(plant), build_rods(plant)
    found = plant_frequencies(skeleton, rods, 6)[::2]  # every bending mode comes twice, once an axis
    unit = 0.2 / 10.0**2 * np.sqrt(WOOD.youngs_modulus / WOOD.wood_density)
    expected = unit * np.array(TAPERED[taper])
    assert found[0] == pytest.approx(expected[0], rel=0.01)
    assert found[1:] == pytest.approx(expected[1:], rel=0.03)


@pytest.mark.parametrize(("ratio", "coefficient"), [(0.5, 0.0802), (1.0, 0.0620), (2.0, 0.0461)])
def test_tip_mass(ratio: float, coefficient: float) -> None:
    plant = build_plant(straight(10.0, 40, 0.1), WOOD)
    skeleton, rods = build_skeleton(plant), build_rods(plant)
    tip = ratio * rods.mass.sum()
    mass, moment, inertia = rods.mass.copy(), rods.moment.copy(), rods.inertia.copy()
    mass[-1] += tip
    moment[-1] += tip
    inertia[-1] += tip * skeleton.length[-1] ** 2
    loaded = replace(rods, mass=mass, moment=moment, inertia=inertia)
    expected = coefficient * 0.2 / 10.0**2 * np.sqrt(WOOD.youngs_modulus / WOOD.wood_density)
    assert plant_frequencies(skeleton, loaded, 1)[0] == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize(
    ("stiffness", "lengths", "masses", "modes"),
    [
        ((10, 5), (1, 1), (1, 0.5), (0.3809, 1.7013)),
        ((10, 1), (1, 1), (1, 0.5), (0.2954, 0.9812)),
        ((20, 10), (1, 0.5), (1, 0.25), (0.8225, 4.7960)),
    ],
)
def test_two_link_chain(
    stiffness: tuple[float, float],
    lengths: tuple[float, float],
    masses: tuple[float, float],
    modes: tuple[float, float],
) -> None:
    # Joint-space matrices of PHYSICS B3 for two rods of m L^2 / 3.
    stem = straight(1.0, 2, 0.01)
    stem.nodes = np.array([[0, 0, 0], [0, 0, lengths[0]], [0, 0, sum(lengths)]], float)
    plant = build_plant(stem, WOOD)
    skeleton, length, mass = build_skeleton(plant), np.array(lengths), np.array(masses)
    rods = replace(
        build_rods(plant),
        mass=mass,
        moment=mass / 2,
        inertia=mass * length**2 / 3,
        compliance=np.repeat(1.0 / np.array(stiffness, float)[:, None], 2, axis=1),
    )
    assert plant_frequencies(skeleton, rods, 4)[::2] == pytest.approx(modes, rel=2e-4)


@pytest.mark.parametrize("seed", range(3))
def test_mujoco_agrees_on_frequencies(seed: int) -> None:
    plant = random_tree(seed)
    model = build_model(plant)
    theirs = mujoco_frequencies(mujoco_tree(model))
    ours = plant_frequencies(model.skeleton, model.rods, 5)
    assert ours == pytest.approx(theirs[:5], rel=1e-3)
    assert model.stem_frequency[0] / (2 * np.pi) == pytest.approx(theirs[0], rel=0.03)


def test_every_stem_rings_at_its_own_clamped_subtree() -> None:
    plant = random_tree(4)
    skeleton, rods = build_skeleton(plant), build_rods(plant)
    found = stem_frequencies(skeleton, rods)
    for stem in range(plant.stem_count):
        first = skeleton.stem_first_link[stem]
        inside = slice(first, skeleton.subtree_end[first])
        parent = skeleton.parent[inside] - first
        parent[0] = -1
        sub = replace(
            skeleton,
            parent=parent.astype(np.int32),
            attach=skeleton.attach[inside],
            vector=skeleton.vector[inside],
            length=skeleton.length[inside],
            axes=skeleton.axes[inside],
        )
        sub_rods = replace(
            rods,
            mass=rods.mass[inside],
            moment=rods.moment[inside],
            inertia=rods.inertia[inside],
            compliance=rods.compliance[inside],
        )
        alone = plant_frequencies(sub, sub_rods, 1)[0]
        assert found[stem] / (2 * np.pi) == pytest.approx(alone, rel=2e-3)
