"""What the blades of one kind share: force scale, breaking, drag and which kinds need no motion."""

from __future__ import annotations

import numpy as np
import pytest

from windswept.motion.blades.kind import BladeKind, bending_lean, build_kind, chain_of
from windswept.motion.blades.lean import force_scale, load_of_lean
from windswept.motion.blades.rest_shape import GRAVITY, moment, rest_shape

from .conftest import COARSE, component, uniform


def test_force_scale_of_a_uniform_blade() -> None:
    # The tip of a uniform cantilever moves by q L^4 / 8 EI.
    assert force_scale(uniform(40)) == pytest.approx(8.0, rel=0.002)


def test_a_kind_states_what_its_blade_is(grass: BladeKind) -> None:
    blade = component("meadow_fescue", "leaf")
    assert grass.weight * grass.force_scale == pytest.approx(GRAVITY * blade.mass.sum())
    assert grass.drag * grass.force_scale == pytest.approx(0.5 * 1.2 * 1.0 * blade.area.sum())
    assert grass.push * grass.force_scale == pytest.approx(blade.area.sum())
    # Across its face it meets the air whole, at its edge it does not.
    along, face, edge = grass.drag_share
    assert face > 0.9
    assert edge == pytest.approx(0.25)
    assert edge < along < 0.5


def test_reach_is_how_far_the_drag_moves(grass: BladeKind) -> None:
    chain, load = grass.chain, 1e-3
    rest = rest_shape(chain, np.zeros(3)).joint
    for axis, reach in ((1, grass.reach[0]), (2, grass.reach[1])):
        force = np.zeros(3)
        force[axis] = load * grass.force_scale
        moved = rest_shape(chain, force).joint - rest
        centre = 0.5 * (moved[1:] + moved[:-1])
        travel = (chain.area / chain.area.sum()) @ np.linalg.norm(centre, axis=1)
        # Its own curve of 30 degrees makes a blade reach a little less than the straight one.
        assert travel / load == pytest.approx(reach, rel=0.08)


def test_constant_of_barzel_and_barr() -> None:
    kind = build_kind(component("white_clover", "leaflet"), COARSE, tau=0.25)
    assert kind.damping_ratio == 1.0
    np.testing.assert_allclose(kind.frequency, 4.0)


def test_breaking_lean_is_where_the_weakest_joint_bears_its_strength() -> None:
    blade = component("heather", "stem")
    kind, chain = build_kind(blade, COARSE), chain_of(blade)
    whole = chain.softened(np.zeros(chain.section_count, bool))
    rng, below, above = np.random.default_rng(0), [], []
    for _ in range(400):
        lean = rng.normal(size=3)
        lean *= rng.uniform(0.3, 0.999) / np.linalg.norm(lean)
        turns = rest_shape(whole, kind.force_scale * load_of_lean(lean)).turns
        strain = float((moment(chain, turns) / chain.strength).max())
        (below if bending_lean(lean) < kind.breaking_lean else above).append(strain)
    assert min(len(below), len(above)) > 5
    # It is the smallest such lean of all directions: below it nothing breaks, above it some do.
    assert max(below) < 1.02
    assert max(above) > 1.0


def test_only_what_wind_cannot_move_is_still(grass: BladeKind) -> None:
    assert not grass.still
    assert build_kind(component("heather", "bell"), COARSE).still
    assert build_kind(component("oxeye_daisy", "disc"), COARSE).still
