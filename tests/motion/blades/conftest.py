from __future__ import annotations

import numpy as np
import pytest

from windswept.motion.blades.chain import Chain, build_chain
from windswept.motion.blades.kind import BladeKind, build_kind
from windswept.motion.blades.pose_table import Bins
from windswept.plants.underbrush import Blade, grow_tuft, load_underbrush

COARSE = Bins(16, 12, 12)


def uniform(sections: int, weight: float = 1.0, side_ratio: float = 1.0, **more: object) -> Chain:
    """A blade of length 1 m, bending stiffness 1 N m^2 and a mass of ``weight`` kg."""
    ones = np.ones(sections)
    share = ones / sections
    return build_chain(share, ones, weight * share, share, 0.0 * ones, side_ratio, **more)  # type: ignore[arg-type]


def component(species: str, name: str) -> Blade:
    return next(b for b in grow_tuft(load_underbrush(species)).kinds if b.component.name == name)


@pytest.fixture(scope="session")
def grass() -> BladeKind:
    return build_kind(component("meadow_fescue", "leaf"))


@pytest.fixture(scope="session")
def reed() -> BladeKind:
    return build_kind(component("giant_reed", "blade"), COARSE)
