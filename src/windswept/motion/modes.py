"""Natural frequencies of a plant and of the subtree beyond each of its stems.

With springs on every joint the stiffness matrix is diagonal, so the modes are those of the scaled mass matrix
C^(1/2) M C^(1/2), whose eigenvalues are 1 / omega^2; Lanczos' iteration finds the largest, and needs nothing but
products with M, which two walks over the tree give in linear time.
"""

from __future__ import annotations

import numpy as np
from numba import njit, prange
from scipy.sparse.linalg import LinearOperator, eigsh

from windswept.motion.rods import Doubles, Rods
from windswept.motion.skeleton import Skeleton
from windswept.motion.sweeps import inertial_torque

LANCZOS_STEPS = 30
"""Krylov vectors per subtree: the lowest frequency is then good to 1e-4 (test_modes.py)."""


def plant_frequencies(skeleton: Skeleton, rods: Rods, count: int = 5) -> Doubles:
    """The lowest natural frequencies of the whole plant, all joints coupled.

    Args:
        skeleton: the rest skeleton.
        rods: mass and compliance.
        count: how many.

    Returns:
        (count,) frequencies in Hz, ascending; fewer where the plant has fewer freedoms.
    """
    return natural_modes(skeleton, rods, count)[0] / (2.0 * np.pi)


def natural_modes(
    skeleton: Skeleton, rods: Rods, count: int, tolerance: float = 1e-8
) -> tuple[Doubles, Doubles]:
    """The lowest natural modes of the whole plant, all joints coupled.

    Args:
        skeleton: the rest skeleton.
        rods: mass and compliance.
        count: how many.
        tolerance: relative error of a frequency's square.

    Returns:
        (R,) angular frequencies in rad/s, ascending, and (L, 2, R) joint angles, with an elastic energy of 1/2; R is
        ``count``, or the number of the plant's freedoms where that is less.
    """
    root = np.sqrt(rods.compliance)
    tree = (skeleton.parent, 0, skeleton.attach, skeleton.vector, skeleton.axes)

    def scaled_mass(vector: Doubles) -> Doubles:
        joint = root * vector.reshape(-1, 2)
        torque = inertial_torque(*tree, rods.mass, rods.moment, rods.inertia, joint)
        return (root * torque).ravel()

    size = root.size
    if size <= 2 * count + 2:
        values, vectors = np.linalg.eigh(np.column_stack([scaled_mass(column) for column in np.eye(size)]))
    else:
        operator = LinearOperator((size, size), matvec=scaled_mass, dtype=np.float64)
        start = np.random.default_rng(0).standard_normal(size)
        values, vectors = eigsh(operator, k=count, which="LA", v0=start, tol=tolerance)
    slowest = np.argsort(-values)[:count]
    return 1.0 / np.sqrt(values[slowest]), root[..., None] * vectors[:, slowest].reshape(*root.shape, -1)


def stem_frequencies(skeleton: Skeleton, rods: Rods) -> Doubles:
    """Angular frequency of the lowest mode of every stem's own subtree, clamped at the stem's base.

    Returns:
        (S,) rad/s.
    """
    first = skeleton.stem_first_link
    stop = skeleton.subtree_end[first]
    # Longest first, so that the threads end together.
    order = np.argsort(first - stop, kind="stable")
    largest = np.empty(len(first))
    largest[order] = _largest_eigenvalues(
        first[order],
        stop[order],
        skeleton.parent,
        skeleton.attach,
        skeleton.vector,
        skeleton.axes,
        rods.mass,
        rods.moment,
        rods.inertia,
        np.sqrt(rods.compliance),
        np.random.default_rng(0).standard_normal((len(skeleton.parent), 2)),
    )
    return 1.0 / np.sqrt(largest)


@njit(cache=True, parallel=True)
def _largest_eigenvalues(  # type: ignore[no-untyped-def]
    first, stop, parent, attach, vector, axes, mass, moment, inertia, root, seed
):
    """(n,) largest eigenvalue of the scaled mass matrix of every range of links, in s^2."""
    count = len(first)
    largest = np.empty(count)
    halves = 2
    for half in prange(halves):
        # The plant's trunk takes as long as many twigs: ranges are dealt out like cards, longest first.
        for index in range(half, count, halves):
            a, b = first[index], stop[index]
            diagonal, off_diagonal = _lanczos(
                parent[a:b],
                a,
                attach[a:b],
                vector[a:b],
                axes[a:b],
                mass[a:b],
                moment[a:b],
                inertia[a:b],
                root[a:b],
                seed[a:b],
            )
            largest[index] = _largest_of_tridiagonal(diagonal, off_diagonal)
    return largest


@njit(cache=True)
def _lanczos(  # type: ignore[no-untyped-def]
    parent, start, attach, vector, axes, mass, moment, inertia, root, seed
):
    """Lanczos' tridiagonal coefficients of one subtree's scaled mass matrix."""
    steps = min(LANCZOS_STEPS, seed.size)
    diagonal, off_diagonal = np.zeros(steps), np.zeros(steps)
    current = seed / np.sqrt(np.sum(seed * seed))
    previous, norm = np.zeros_like(current), 0.0
    for step in range(steps):
        joint = root * current
        product = root * inertial_torque(parent, start, attach, vector, axes, mass, moment, inertia, joint)
        diagonal[step] = np.sum(current * product)
        product -= diagonal[step] * current + norm * previous
        norm = np.sqrt(np.sum(product * product))
        if norm <= 1e-9 * diagonal[0]:
            break  # a subtree with few freedoms is exhausted early
        off_diagonal[step] = norm
        previous, current = current, product / norm
    return diagonal, off_diagonal[:-1]


@njit(cache=True)
def _largest_of_tridiagonal(diagonal: Doubles, off_diagonal: Doubles) -> float:
    """Largest eigenvalue of a symmetric tridiagonal matrix, by bisection on Sturm's sequence."""
    size, high = len(diagonal), 0.0
    for i in range(size):
        left = off_diagonal[i - 1] if i > 0 else 0.0
        right = off_diagonal[i] if i < size - 1 else 0.0
        high = max(high, diagonal[i] + abs(left) + abs(right))
    low = diagonal.max()
    for _ in range(50):
        middle = 0.5 * (low + high)
        if _is_above_spectrum(diagonal, off_diagonal, middle):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


@njit(cache=True)
def _is_above_spectrum(diagonal: Doubles, off_diagonal: Doubles, value: float) -> bool:
    """Whether every pivot of (matrix - value) is negative."""
    pivot = diagonal[0] - value
    for i in range(1, len(diagonal)):
        if pivot >= 0.0:
            return False
        pivot = diagonal[i] - value - off_diagonal[i - 1] ** 2 / pivot
    return pivot < 0.0
