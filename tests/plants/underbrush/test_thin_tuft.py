"""A thinned tuft: fewer blades, parents kept, the others untouched."""

import numpy as np
import pytest

from windswept.plants.underbrush import grow_tuft, load_underbrush, underbrush_names
from windswept.plants.underbrush.thin_tuft import thin_tuft


@pytest.mark.parametrize("name", underbrush_names())
@pytest.mark.parametrize("share", [0.01, 0.3, 1.0])
def test_shares_and_parents(name: str, share: float) -> None:
    tuft = grow_tuft(load_underbrush(name), 2)
    thin = thin_tuft(tuft, [share] * len(tuft.kinds))
    thin.validate()
    for kind in range(len(tuft.kinds)):
        whole, left = np.sum(tuft.blade_kind == kind), np.sum(thin.blade_kind == kind)
        assert 1 <= left <= max(np.ceil(share * whole) + 1, 1)
    carried = thin.blade_parent >= 0
    assert (thin.blade_parent[carried] < np.flatnonzero(carried)).all()
    above = [blade.component.parent for blade in tuft.kinds]
    for blade in np.flatnonzero(carried):
        parent = tuft.kinds[thin.blade_kind[thin.blade_parent[blade]]].component.name
        assert parent == above[thin.blade_kind[blade]]


def test_everything_is_the_same_tuft() -> None:
    tuft = grow_tuft(load_underbrush("oxeye_daisy"), 1)
    same = thin_tuft(tuft, [1.0] * len(tuft.kinds))
    for name in ("blade_kind", "blade_parent", "blade_attach", "blade_root", "blade_frame", "blade_size"):
        np.testing.assert_array_equal(getattr(tuft, name), getattr(same, name))
