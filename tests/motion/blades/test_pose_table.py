"""Tables of poses against the direct solution, and their coarser copies against themselves."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.motion.blades.chain import Chain
from windswept.motion.blades.kind import BladeKind, chain_of
from windswept.motion.blades.lean import force_scale, lean_of_load, load_of_lean
from windswept.motion.blades.newton import pose_chain
from windswept.motion.blades.pose_table import (
    DEFAULT_BINS,
    Bins,
    PoseTable,
    build_table,
    look_up,
    ray_directions,
    ray_norms,
)
from windswept.motion.blades.rest_shape import GRAVITY, rest_shape
from windswept.motion.blades.simplify_table import simplify_table

from .conftest import COARSE, component, uniform


def shape_of(table: PoseTable, lean: np.ndarray) -> np.ndarray:
    """(K + 1, 3) joints of a blade of size 1."""
    count = table.section_count
    turns, joint = np.zeros((count, 2)), np.empty((count + 1, 3))
    look_up(table.turns, lean, turns)
    pose_chain(turns, table.length.astype(float), joint, np.empty((2 * count, 3)), np.empty((count, 3, 3)))
    return joint


def windy_load(rng: np.random.Generator, chain: Chain, strongest: float) -> np.ndarray:
    """Weight at a tilt of 2 to 60 degrees and a force along the ground of up to ``strongest`` force scales, N."""
    tilt = np.radians(rng.uniform(2.0, 60.0))
    up = np.array([np.cos(tilt), -np.sin(tilt), 0.0])
    force = rng.normal(size=3)
    force -= up * (force @ up)
    force *= force_scale(chain) * rng.uniform(0.0, strongest) / np.linalg.norm(force)
    return force - GRAVITY * chain.mass.sum() * up


@pytest.mark.parametrize(
    ("species", "name"), [("meadow_fescue", "leaf"), ("oxeye_daisy", "stem"), ("giant_reed", "blade")]
)
def test_between_bins_a_pose_is_within_one_percent_of_length(species: str, name: str) -> None:
    # 3 force scales are a wind of 15 to 100 m/s. What is left over lies where a blade falls over to one face or the
    # other: two neighbouring bins then hold two different equilibria, and so do two directions of the wind in nature.
    chain = chain_of(component(species, name))
    table, scale, rng = build_table(chain), force_scale(chain), np.random.default_rng(0)
    for strongest, most in ((1.0, 0.03), (3.0, 0.07)):
        misses = []
        for _ in range(300):
            load = windy_load(rng, chain, strongest)
            direct = rest_shape(chain, load).joint
            looked_up = shape_of(table, lean_of_load(load / scale))
            misses.append(np.linalg.norm(looked_up - direct, axis=1).max() / chain.whole_length)
        assert np.mean(np.array(misses) > 0.01) < most
        assert np.median(misses) < 0.003


def test_a_node_is_the_equilibrium_itself() -> None:
    chain = uniform(6, side_ratio=3.0)
    table = build_table(chain, COARSE)
    direction, norm = ray_directions(COARSE), ray_norms(COARSE)
    for node in ((6, 3, 4), (9, 5, 2), (11, 4, 0)):
        load = norm[node[1]] * direction[node[0], node[2]]
        direct = rest_shape(chain, force_scale(chain) * load)
        np.testing.assert_allclose(table.turns[node], direct.turns, atol=2e-5)
        turns = np.zeros((6, 2))
        look_up(table.turns, lean_of_load(load), turns)
        np.testing.assert_allclose(turns, direct.turns, atol=2e-5)


def test_a_load_from_the_other_side_gives_the_mirror_image() -> None:
    table = build_table(uniform(4, side_ratio=3.0), COARSE)
    lean = np.array([-0.3, 0.2, 0.4])
    mirrored = shape_of(table, lean * [1, 1, -1])
    np.testing.assert_allclose(mirrored, shape_of(table, lean) * [1, 1, -1], atol=1e-7)


def test_a_stronger_wind_bends_further() -> None:
    table = build_table(uniform(6), COARSE)
    loads = np.geomspace(0.01, 100.0, 60)
    tips = [shape_of(table, lean_of_load(np.array([0.0, load, 0.0])))[-1, 1] for load in loads]
    assert (np.diff(tips) > 0.0).all()
    assert tips[-1] > 0.9


def test_lean_is_the_tips_displacement_over_the_length() -> None:
    # Exact for small loads, within 0.1 for all.
    chain = uniform(20)
    for load in (1e-3, 0.1, 0.5, 1.0, 2.0, 4.0, 10.0):
        tip = rest_shape(chain, np.array([0.0, force_scale(chain) * load, 0.0])).joint[-1, 1]
        lean = lean_of_load(np.array([0.0, load, 0.0]))[1]
        assert tip == pytest.approx(lean, rel=1e-3 if load < 0.01 else 1.0, abs=0.1 if load > 0.01 else 0.0)
        assert load_of_lean(np.array([0.0, lean, 0.0]))[1] == pytest.approx(load)


def test_memory_is_stated() -> None:
    bins = Bins(4, 3, 2)
    table = build_table(uniform(5), bins)
    assert bins.node_count == 5 * 4 * 3
    assert table.bytes == 60 * 5 * 2 * 4 + 5 * 4


def test_bins_that_make_no_table_are_refused() -> None:
    for bins in (Bins(1, 8, 8), Bins(8, 0, 8), Bins(999, 999, 999)):
        with pytest.raises(InputError, match="pose table"):
            build_table(uniform(3), bins)


@pytest.mark.parametrize("sections", [2, 3, 4])
def test_fewer_sections_leave_the_tip_where_it_is(grass: BladeKind, sections: int) -> None:
    coarse, rng = simplify_table(grass.table, sections), np.random.default_rng(1)
    assert coarse.length.sum() == pytest.approx(grass.table.length.sum())
    length = grass.chain.whole_length
    moved = []
    for _ in range(400):
        force = rng.normal(size=3)
        force *= 10.0 ** rng.uniform(-2.0, 2.0) / np.linalg.norm(force)
        lean = lean_of_load(force)
        moved.append(np.linalg.norm(shape_of(coarse, lean)[-1] - shape_of(grass.table, lean)[-1]) / length)
    nodes = [tip_miss(grass.table, coarse, i) / length for i in range(0, DEFAULT_BINS.node_count, 97)]
    assert max(nodes) < 0.005
    assert np.percentile(moved, 98) < 0.005


def tip_miss(fine: PoseTable, coarse: PoseTable, node: int) -> float:
    """How far apart the tips of two tables are at one node, m."""
    tips = []
    for table in (fine, coarse):
        count = table.section_count
        turns = table.turns.reshape(-1, count, 2)[node].astype(float)
        joint = np.empty((count + 1, 3))
        frame = np.empty((count, 3, 3))
        pose_chain(turns, table.length.astype(float), joint, np.empty((2 * count, 3)), frame)
        tips.append(joint[-1])
    return float(np.linalg.norm(tips[0] - tips[1]))


def test_only_fewer_sections_make_a_simpler_blade(grass: BladeKind) -> None:
    for sections in (1, 7):
        with pytest.raises(InputError, match="2 to 6"):
            simplify_table(grass.table, sections)
