"""Blade: one component of underbrush as sets of vectors, with what it is made of (Endo, section 3.1).

Vectors stand in the blade's base frame (axis, normal, side): along the blade at its root, towards the face to which it
curls, and axis x normal. To make a shape, the main axis is added up from the root, section after section, and the two
border vectors are added at every point of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from windswept.plants.plant import Floats
from windswept.plants.underbrush.form import Component

Doubles = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Blade:
    """A component of size 1 with K sections.

    A blade of size s is s times as long. It is as thick as makes it hang in the same shape: a strip s wide and s^1.5
    thick, a tube s^1.5 across, as plants grow elastically similar (McMahon 1973).
    """

    component: Component
    """The form it comes from: colours, damping, drag."""
    axis: Floats
    """(K, 3) section vectors without any load, m."""
    left: Floats
    """(K + 1, 3) from the main axis to the left border, m."""
    right: Floats
    """(K + 1, 3) from the main axis to the right border, m."""
    length: Doubles
    """(K,) of every section, m."""
    curvature: Doubles
    """(K,) natural curvature towards the normal, rad/m."""
    bending_stiffness: Doubles
    """(K,) EI across the flat face, N m^2."""
    strength: Doubles
    """(K,) largest moment, N m."""
    mass: Doubles
    """(K,) with what the section carries, kg."""
    area: Doubles
    """(K,) one-sided, with what the section carries, m^2."""

    @property
    def section_count(self) -> int:
        """Number of sections, K."""
        return len(self.length)

    @property
    def round(self) -> bool:
        """Whether its cross-section is a tube."""
        return self.component.shape == "round"

    @property
    def mass_power(self) -> float:
        """By which power of size the mass grows: length x width x thickness."""
        return 4.0 if self.round else 3.5

    @property
    def area_power(self) -> float:
        """By which power of size the area grows: length x width."""
        return 2.5 if self.round else 2.0


def build_blade(component: Component) -> Blade:
    """Blade of a component of size 1 that carries nothing yet."""
    count = component.sections
    length = np.full(count, 1e-3 * component.length_mm / count)
    border = _half_width(component, np.linspace(0.0, 1.0, count + 1))
    middle = _half_width(component, (np.arange(count) + 0.5) / count)
    curvature = np.full(count, np.radians(component.curve_deg) / length.sum())
    section_area, moment_of_area, half_depth = _cross_section(component, middle)
    stiffness = component.youngs_modulus * moment_of_area
    frame = _natural_frames(length, curvature)
    joint_side = np.broadcast_to(np.array([0.0, 0.0, 1.0]), (count + 1, 3))
    return Blade(
        component=component,
        axis=(length[:, None] * frame).astype(np.float32),
        left=(border[:, None] * joint_side).astype(np.float32),
        right=(-border[:, None] * joint_side).astype(np.float32),
        length=length,
        curvature=curvature,
        bending_stiffness=stiffness,
        strength=component.strength * moment_of_area / half_depth,
        mass=component.density * section_area * length,
        area=2.0 * middle * length,
    )


LEAST_WIDTH = 0.05
"""A section is reckoned with at least this part of the largest width: a point has no stiffness, but it has no length
either."""


def _half_width(component: Component, place: Doubles) -> Doubles:
    """Half-width at places 0 to 1 along the blade, m."""
    outline = np.array(component.outline)
    share = np.interp(place, np.linspace(0.0, 1.0, len(outline)), outline)
    return 0.5e-3 * component.width_mm * np.maximum(share, LEAST_WIDTH)


def _cross_section(component: Component, half_width: Doubles) -> tuple[Doubles, Doubles, Doubles]:
    """Area (m^2), second moment across the flat face (m^4) and half depth (m) of every section."""
    thickness = 1e-3 * component.thickness_mm
    if component.shape == "flat":
        whole = np.full_like(half_width, thickness)
        return 2.0 * half_width * whole, 2.0 * half_width * whole**3 / 12.0, 0.5 * whole
    inner = np.maximum(half_width - thickness, 0.0)
    area = np.pi * (half_width**2 - inner**2)
    return area, 0.25 * np.pi * (half_width**4 - inner**4), half_width


def _natural_frames(length: Doubles, curvature: Doubles) -> Doubles:
    """(K, 3) direction of every section without any load: its own curve, seen at its middle."""
    turned = np.cumsum(length * curvature) - 0.5 * length * curvature
    return np.stack([np.cos(turned), np.sin(turned), np.zeros_like(turned)], axis=1)
