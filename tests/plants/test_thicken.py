"""Wood carries its load: no link is strained beyond the working stress, and none grows thinner."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from handmade import build_plant, straight
from windswept.plants.air import AIR_DENSITY
from windswept.plants.plant import Material
from windswept.plants.thicken import PLATE_SHARE, WORKING_STRESS, WORKING_WIND, thicken


def test_a_pole_with_leaves_at_its_end() -> None:
    # One leaf at the tip of a thread: r^3 = 4 M / (pi sigma) at every joint, M = force x distance to the leaf's link.
    stem = straight(2.0, 10, 1e-4)
    plant = build_plant(stem, Material(reconfiguration=0.0))
    leafy = replace(
        plant,
        leaf_link=np.array([9], np.int32),
        leaf_position=np.array([[0.0, 0.0, 1.9]], np.float32),
        leaf_axis=np.array([[1.0, 0.0, 0.0]], np.float32),
        leaf_normal=np.array([[0.0, 0.0, 1.0]], np.float32),
        leaf_length=np.array([0.5], np.float32),
        leaf_width=np.array([0.5], np.float32),
    )
    force = 0.5 * AIR_DENSITY * WORKING_WIND**2 * PLATE_SHARE * float(leafy.leaf_area[0])
    arm = 1.9 - 0.2 * np.arange(10)
    expected = (4.0 * force * arm / (np.pi * WORKING_STRESS)) ** (1 / 3)
    thick = thicken(leafy)
    assert thick.link_radius_base == pytest.approx(expected, rel=1e-4)
    assert thick.link_radius_tip[:-1] == pytest.approx(expected[1:], rel=1e-4)


def test_stout_wood_stays_as_it_is() -> None:
    stem = straight(2.0, 10, 0.2)
    stem.leaves = 3
    plant = build_plant(stem)
    thick = thicken(plant)
    assert np.array_equal(thick.link_radius_base, plant.link_radius_base)
    assert np.array_equal(thick.link_radius_tip, plant.link_radius_tip)
