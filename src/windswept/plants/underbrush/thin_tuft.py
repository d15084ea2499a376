"""thin_tuft: a tuft for a place from which its blades cannot be told apart: some blades stand for all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from windswept.plants.underbrush.tuft import Tuft


def thin_tuft(tuft: Tuft, share: Sequence[float]) -> Tuft:
    """The same tuft with fewer blades, evenly chosen; whoever draws it makes them as much wider.

    Args:
        tuft: to be thinned.
        share: (C,) of each kind's blades that is kept, 0 to 1; what hangs on a blade that goes, goes too. Of every
            kind at least one blade is kept.
    """
    kept = np.zeros(tuft.blade_count, np.bool_)
    for kind, wanted in enumerate(share):
        mine = np.flatnonzero(tuft.blade_kind == kind)
        parent = tuft.blade_parent[mine]
        left = mine[(parent < 0) | kept[parent]]
        kept[_every(left, wanted * len(mine) / max(len(left), 1))] = True
    place = np.cumsum(kept) - 1
    chosen = np.flatnonzero(kept)
    parent = tuft.blade_parent[chosen]
    columns = ("blade_kind", "blade_attach", "blade_root", "blade_frame", "blade_size")
    return replace(
        tuft,
        blade_parent=np.where(parent < 0, -1, place[parent]).astype(np.int32),
        **{name: getattr(tuft, name)[chosen] for name in columns},
    )


def _every(blades: NDArray[np.signedinteger], share: float) -> NDArray[np.signedinteger]:
    """A share of the blades, one at least, at even steps through them."""
    steps = np.floor(min(share, 1.0) * np.arange(len(blades) + 1) + 0.5)
    chosen = blades[np.diff(steps) > 0.0]
    return chosen if len(chosen) else blades[:1]
