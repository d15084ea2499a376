"""Tuft: one plant of underbrush, as many blades that share a few shapes."""

from __future__ import annotations

from dataclasses import dataclass

from windswept.errors import InputError
from windswept.plants.plant import Floats, Ints
from windswept.plants.underbrush.blade import Blade


@dataclass(frozen=True, slots=True)
class Tuft:
    """B blades of C kinds. Frame: +Z is the normal of the ground, the middle of the root patch is the origin, m.

    A blade that another carries comes after it. Without any load, blade b begins at its place on its parent and turns
    from there as ``blade_frame`` says.
    """

    species: str
    seed: int
    kinds: tuple[Blade, ...]
    """(C,) shape and material of every component, in the order of the species file."""
    blade_kind: Ints
    """(B,) ascending."""
    blade_parent: Ints
    """(B,) blade that carries it, -1 on the ground; always smaller than the blade's own index."""
    blade_attach: Floats
    """(B,) where along the parent it sits, 0 base to 1 tip; 0 on the ground."""
    blade_root: Floats
    """(B, 3) place on the ground, m; 0 on a parent."""
    blade_frame: Floats
    """(B, 3, 3) rows axis, normal, side: on the ground in x, y, z; on a parent in the axis, normal and side of the
    parent's section."""
    blade_size: Floats
    """(B,) length over that of the kind."""

    @property
    def blade_count(self) -> int:
        """Number of blades, B."""
        return len(self.blade_kind)

    def validate(self) -> None:
        """Raise InputError for a blade without length, width, thickness or mass."""
        for kind in self.kinds:
            for field in ("length", "bending_stiffness", "mass"):
                if not (getattr(kind, field) > 0.0).all():
                    raise InputError(self.species, f"{kind.component.name}.{field}", 0.0, "a number above 0")
