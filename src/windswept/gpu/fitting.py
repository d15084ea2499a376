"""Fitting: the detail in which all plants find room where full detail does not, as a share of the picture's height."""

from __future__ import annotations

from collections.abc import Callable

from windswept.gpu.culling import Told
from windswept.gpu.posing import Counts

LEAST_DETAIL = 0.3
"""Where plants need more room than a card has, they are drawn as in a picture of down to this share of the height."""
DETAIL_STEP = 0.02
SLACK = 0.85
"""A window goes back to more detail when no more than this share of its room is wanted."""


def most_detail(fits: Callable[[float], bool]) -> float:
    """Largest share for which there is room, by halving to DETAIL_STEP; LEAST_DETAIL if there is none.

    Args:
        fits: says whether a share finds room.
    """
    if fits(1.0):
        return 1.0
    low, high = LEAST_DETAIL, 1.0
    while high - low > DETAIL_STEP:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if fits(middle) else (low, middle)
    return low


def followed_detail(share: float, told: Told, room: Counts) -> float:
    """The share of a window's next frame, by what an earlier one lacked or left over: it goes a step at a time."""
    if told.refused:
        return max(LEAST_DETAIL, share - DETAIL_STEP)
    if all(wanted <= SLACK * had for wanted, had in zip(told.wanted, room, strict=True)):
        return min(1.0, share + DETAIL_STEP)
    return share
