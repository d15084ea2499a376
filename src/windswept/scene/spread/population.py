"""Population: the living plants of a spread."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Ints32 = NDArray[np.int32]
Marks = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Population:
    """P plants in order of age, the oldest first."""

    species: Ints32
    """(P,) index into the ecology."""
    x: Floats
    """(P,) m."""
    y: Floats
    """(P,) m."""
    size: Floats
    """(P,) factor on the lengths of the species."""
    placed: Marks
    """(P,) put there by a person: never dies."""

    @property
    def count(self) -> int:
        """Number of plants, P."""
        return len(self.x)

    def only(self, which: Marks) -> Population:
        """Those of the plants that a (P,) mask marks."""
        return Population(*(getattr(self, field.name)[which] for field in fields(self)))

    def with_more(self, others: Population) -> Population:
        """These plants and younger ones."""
        pairs = ((getattr(self, field.name), getattr(others, field.name)) for field in fields(self))
        return Population(*(np.concatenate(pair) for pair in pairs))
