"""A blade as a chain of rigid sections on springs: what the equilibrium solvers read.

The base frame of a blade is (axis, normal, side): the axis points along the blade at its root, the normal is the
face towards which it curls, the side is axis x normal. Every joint bends twice: first across the flat face, about
the side, by which the axis turns towards the normal; then in the plane of the blade, by which it turns to the side.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.motion.rods import Doubles

BROKEN_STIFFNESS = 0.1
"""What is left of a joint's stiffness once it is broken (PHYSICS C2.6)."""


@dataclass(frozen=True, slots=True)
class Chain:
    """One blade of K sections; joint i is at the base of section i."""

    length: Doubles
    """(K,) m."""
    turn: Doubles
    """(K,) angle across the flat face at which the joint's spring is at rest: the natural curvature, rad."""
    stiffness: Doubles
    """(K, 2) of the joint, across the flat face and to the side, N m/rad."""
    strength: Doubles
    """(K,) largest elastic moment that the joint bears, N m; infinity where it never breaks."""
    mass: Doubles
    """(K,) kg."""
    area: Doubles
    """(K,) one-sided area that the air meets, m^2."""

    @property
    def section_count(self) -> int:
        """Number of sections, K."""
        return len(self.length)

    @property
    def whole_length(self) -> float:
        """Length along the blade, m."""
        return float(self.length.sum())

    def softened(self, broken: NDArray[np.bool_]) -> Chain:
        """The chain with joints (K,) broken; they break no further."""
        return replace(
            self,
            stiffness=np.where(broken[:, None], BROKEN_STIFFNESS, 1.0) * self.stiffness,
            strength=np.where(broken, np.inf, self.strength),
        )

    def validate(self, name: str) -> None:
        """Raise InputError for a chain that cannot stand: no length, stiffness or mass, or numbers that are none."""
        for field, words in (("length", "m"), ("stiffness", "N m/rad"), ("mass", "kg")):
            values = getattr(self, field)
            bad = ~(np.isfinite(values) & (values > 0.0))
            if bad.any():
                section = int(np.argmax(bad.reshape(self.section_count, -1).any(axis=1)))
                value = float(values[section].flat[0] if values.ndim > 1 else values[section])
                raise InputError(name, f"section {section}, {field}", value, f"a number above 0 ({words})")


def build_chain(
    length: Doubles,
    bending_stiffness: Doubles,
    mass: Doubles,
    area: Doubles,
    curvature: Doubles,
    side_ratio: float = 1.0,
    strength: Doubles | None = None,
    name: str = "blade",
) -> Chain:
    """Chain of a blade whose properties are constant along each section.

    A joint stands for the bending of half a section on either side: k = EI/h in a uniform blade and 2 EI/h at the
    base, which stands for half a section only (PHYSICS B3).

    Args:
        length: (K,) h, m.
        bending_stiffness: (K,) EI across the flat face, N m^2.
        mass: (K,) kg.
        area: (K,) one-sided, m^2.
        curvature: (K,) natural curvature towards the normal, rad/m.
        side_ratio: bending stiffness to the side over that across the flat face.
        strength: (K,) largest moment of each section, N m; None for one that never breaks.
        name: of the blade, for error messages.

    Raises:
        InputError: a section without length, stiffness or mass.
    """
    with np.errstate(divide="ignore"):
        half = 0.5 * length / bending_stiffness
    compliance = half + np.concatenate([[0.0], half[:-1]])
    turned = 0.5 * length * curvature
    stiffness = (1.0 / compliance)[:, None] * np.array([1.0, side_ratio])
    chain = Chain(
        length=length,
        turn=turned + np.concatenate([[0.0], turned[:-1]]),
        stiffness=stiffness,
        strength=np.full(len(length), np.inf) if strength is None else strength,
        mass=mass,
        area=area,
    )
    chain.validate(name)
    return chain


def weight_share(chain: Chain) -> Doubles:
    """(K,) fraction of the blade's mass in every section."""
    return chain.mass / chain.mass.sum()
