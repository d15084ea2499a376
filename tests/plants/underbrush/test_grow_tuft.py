"""Tufts: who carries whom, vectors and masses, and that seeds and streams hold."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from windswept.errors import BudgetError, InputError
from windswept.plants.underbrush import Blade, build_blade, grow_tuft, load_underbrush, underbrush_names


@pytest.mark.parametrize("name", underbrush_names())
def test_every_tuft_is_well_formed(name: str) -> None:
    species = load_underbrush(name)
    for seed in (0, 7):
        tuft = grow_tuft(species, seed)
        tuft.validate()
        assert (np.diff(tuft.blade_kind) >= 0).all()
        assert (tuft.blade_parent < np.arange(tuft.blade_count)).all()
        names = [kind.component.name for kind in tuft.kinds]
        for kind, parent in zip(tuft.blade_kind, tuft.blade_parent, strict=True):
            carrier = tuft.kinds[kind].component.parent
            assert (parent < 0) if not carrier else names[tuft.blade_kind[parent]] == carrier
        unit = np.einsum("bij,bkj->bik", tuft.blade_frame, tuft.blade_frame)
        np.testing.assert_allclose(unit, np.broadcast_to(np.eye(3), unit.shape), atol=1e-6)
        assert np.allclose(np.linalg.det(tuft.blade_frame), 1.0, atol=1e-5)
        ground = tuft.blade_parent < 0
        assert (tuft.blade_frame[ground, 0, 2] > -0.05).all()
        assert not tuft.blade_root[~ground].any()


def test_same_seed_same_tuft() -> None:
    species = load_underbrush("oxeye_daisy")
    one, two, other = grow_tuft(species, 4), grow_tuft(species, 4), grow_tuft(species, 5)
    for field in ("blade_frame", "blade_root", "blade_size", "blade_parent"):
        assert getattr(one, field).tobytes() == getattr(two, field).tobytes()
    assert one.blade_frame.tobytes() != other.blade_frame.tobytes()


def test_a_component_more_moves_no_other() -> None:
    species = load_underbrush("meadow_fescue")
    shorter = species.model_copy(update={"component": species.component[:1]})
    whole, leaves = grow_tuft(species, 2), grow_tuft(shorter, 2)
    count = leaves.blade_count
    assert (whole.blade_kind[:count] == 0).all()
    assert whole.blade_frame[:count].tobytes() == leaves.blade_frame.tobytes()


def test_vectors_mass_and_stiffness_of_a_strip() -> None:
    leaf = load_underbrush("meadow_fescue").component[0]
    leaf = leaf.model_copy(update={"outline": [1.0, 1.0], "curve_deg": 90.0})
    blade = build_blade(leaf)
    length, width, thickness = 0.28, 0.005, 0.42e-3
    assert blade.length.sum() == pytest.approx(length)
    assert blade.mass.sum() == pytest.approx(700 * length * width * thickness)
    assert blade.area.sum() == pytest.approx(length * width)
    np.testing.assert_allclose(blade.bending_stiffness, 2e9 * width * thickness**3 / 12)
    np.testing.assert_allclose(blade.strength, 7e7 * width * thickness**2 / 6)
    np.testing.assert_allclose(blade.left, -blade.right)
    np.testing.assert_allclose(np.linalg.norm(blade.left, axis=1), 0.5 * width, rtol=1e-6)
    # A quarter circle reaches as far along the axis as towards the normal: its radius.
    reach = blade.axis.sum(axis=0)
    assert reach[:2] == pytest.approx([2 * length / np.pi] * 2, rel=0.01)


def test_stiffness_of_a_tube() -> None:
    culm = load_underbrush("meadow_fescue").component[1].model_copy(update={"outline": [1.0, 1.0]})
    blade = build_blade(culm)
    outer, inner = 1.7e-3, 1.0e-3
    np.testing.assert_allclose(blade.bending_stiffness, 3e9 * np.pi * (outer**4 - inner**4) / 64)
    assert blade.mass.sum() == pytest.approx(700 * 0.56 * np.pi * (outer**2 - inner**2) / 4)


def sizes(kind: Blade) -> np.ndarray:
    """(count,) mean sizes on one parent."""
    return np.linspace(1.0, kind.component.last_size, kind.component.count)


def test_leaflets_grow_less_to_the_tip_of_a_frond() -> None:
    tuft = grow_tuft(load_underbrush("male_fern"))
    leaflets = tuft.blade_parent == 0
    order = np.argsort(tuft.blade_attach[leaflets])
    size = tuft.blade_size[leaflets][order]
    np.testing.assert_allclose(size, np.linspace(1.0, 0.36, 40), rtol=0.061)


def test_a_stalk_bears_what_hangs_on_it() -> None:
    species = load_underbrush("oxeye_daisy")
    stem, *others = (
        k for k in grow_tuft(species).kinds if k.component.name in ("stem", "stem_leaf", "disc", "ray")
    )
    bare = build_blade(stem.component)
    hung = sum(np.sum(sizes(k) ** 3.5) * k.mass.sum() for k in others)
    assert stem.mass.sum() == pytest.approx(bare.mass.sum() + hung)
    flower = sum(k.component.count * k.mass.sum() for k in others if k.component.name != "stem_leaf")
    assert stem.mass[-1] == pytest.approx(bare.mass[-1] + flower)
    np.testing.assert_array_equal(stem.bending_stiffness, bare.bending_stiffness)


def test_what_no_tuft_can_be() -> None:
    species = load_underbrush("heather")
    with pytest.raises(InputError, match="seed = -1"):
        grow_tuft(species, -1)
    crowd = [c.model_copy(update={"count": 200}) for c in species.component]
    with pytest.raises(BudgetError, match=r"^heather: more than 20,000 blades in a tuft$"):
        grow_tuft(species.model_copy(update={"component": crowd}))
    tuft = grow_tuft(load_underbrush("giant_reed"))
    flat = replace(tuft.kinds[1], bending_stiffness=0.0 * tuft.kinds[1].bending_stiffness)
    with pytest.raises(
        InputError, match=r"giant_reed: blade\.bending_stiffness = 0\.0: expected a number above 0"
    ):
        replace(tuft, kinds=(tuft.kinds[0], flat)).validate()


def test_too_many_blades_are_refused_before_there_is_room_for_them() -> None:
    # 1,000 flowers of 1,000 rays each, the most that a file may ask for, would take gigabytes.
    species = load_underbrush("oxeye_daisy")
    crowd = [c.model_copy(update={"count": 1000, "count_v": 0}) for c in species.component]
    tracemalloc.start()
    with pytest.raises(BudgetError, match=r"^oxeye_daisy: more than 20,000 blades in a tuft$"):
        grow_tuft(species.model_copy(update={"component": crowd}))
    most = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert most < 64e6
