"""Site: what does not change while plants spread."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.scene.spread.cells import Grid
from windswept.scene.spread.claims import Claims, build_claims
from windswept.scene.spread.ecology import Ecology, suitability
from windswept.scene.spread.plot import Plot
from windswept.scene.terrain import Terrain

Floats = NDArray[np.float32]
Reals = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Site:
    """A plot and S species, ready for kernels."""

    grid: Grid
    ecology: Ecology
    claims: Claims
    terrain: Terrain
    rise: Floats
    """(2, G, G) of the terrain towards +x and +y, m/m."""
    fit: Floats
    """(R, C, S) suitability; 0 where the cell is not to be grown on."""
    deepest: Reals
    """(S, 2) range of the optical depth of light that suits."""


def build_site(plot: Plot, ecology: Ecology) -> Site:
    """The ground and the species."""
    fit = np.where(plot.is_open, suitability(ecology, plot.supply), np.float32(0.0))
    with np.errstate(divide="ignore"):
        deepest = -np.log(ecology.light[:, ::-1])
    return Site(
        grid=plot.grid,
        ecology=ecology,
        claims=build_claims(ecology, plot.low, plot.high),
        terrain=plot.terrain,
        rise=plot.terrain.gradient(),
        fit=np.ascontiguousarray(np.moveaxis(fit, 0, -1)),
        deepest=deepest + 0.0,
    )
