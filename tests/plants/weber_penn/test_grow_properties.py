"""Whatever form a species has, its plant is finite and valid or refused by a budget."""

import contextlib

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from windswept.errors import BudgetError
from windswept.plants.species import Species
from windswept.plants.validate import validate
from windswept.plants.weber_penn import grow

ANGLE = st.floats(-360, 360)
SPREAD = st.floats(0, 360)

LEVEL = st.fixed_dictionaries(
    {"length": st.floats(0.01, 3), "curve_res": st.integers(1, 12), "branches": st.integers(0, 12)},
    optional={
        "down_angle": ANGLE,
        "down_angle_v": ANGLE,
        "rotate": ANGLE,
        "rotate_v": SPREAD,
        "length_v": st.floats(0, 3),
        "taper": st.floats(0, 3),
        "seg_splits": st.floats(0, 1.2),
        "split_angle": st.floats(0, 180),
        "split_angle_v": st.floats(0, 180),
        "curve": ANGLE,
        "curve_back": ANGLE,
        "curve_v": ANGLE,
    },
)

GROWTH = st.fixed_dictionaries(
    {
        "shape": st.integers(0, 8),
        "levels": st.integers(1, 4),
        "scale": st.floats(0.05, 150),
        "ratio": st.floats(0.001, 0.5),
        "level": st.lists(LEVEL, min_size=1, max_size=5),
    },
    optional={
        "scale_v": st.floats(0, 150),
        "base_size": st.floats(0, 0.95),
        "ratio_power": st.floats(0, 5),
        "flare": st.floats(0, 10),
        "base_splits": st.integers(0, 4),
        "leaves": st.integers(-9, 9),
        "leaf_bend": st.floats(0, 1),
        "leaf_quality": st.floats(0.01, 1),
        "attraction_up": st.floats(-20, 20),
        "prune_ratio": st.floats(0, 1),
        "prune_width": st.floats(0.01, 2),
        "prune_width_peak": st.floats(0, 0.99),
        "prune_power_low": st.floats(0, 10),
        "prune_power_high": st.floats(0, 10),
        "scale_0": st.floats(0.1, 10),
        "scale_v_0": st.floats(0, 10),
    },
)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(GROWTH, st.integers(0, 2**40))
def test_any_form_grows_a_valid_plant_or_is_too_large(growth, seed):
    species = Species.model_validate({"name": "any", "common_name": "Any", "growth": growth})
    with contextlib.suppress(BudgetError):
        validate(grow(species, seed, link_budget=20_000, leaf_budget=20_000))
