"""draw_branching: free sway over time, a panel a tree, with the decay of a branch by itself, drawn with Pillow."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from windswept.motion.rods import Doubles
from windswept.render.offscreen import write_png

SIZE = (1400, 1000)
"""Pixels."""
LEFT, TOP, WIDE, HIGH, APART = 90, 70, 1260, 240, 300
"""Of the panels, pixels."""
INK, FAINT = (40, 40, 40), (170, 170, 170)
COLOURS = ((24, 110, 60), (150, 90, 30), (60, 90, 170))


def draw_branching(
    sways: dict[str, tuple[Doubles, Doubles]], ratios: dict[str, float], own: float, path: Path
) -> None:
    """Draw sways below one another.

    Args:
        sways: time in periods and displacement over the largest, by what sways.
        ratios: damping ratio of each.
        own: damping ratio of every branch by itself.
        path: of the PNG file.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image, ImageDraw

    picture = Image.new("RGB", SIZE, (255, 255, 255))
    draw = ImageDraw.Draw(picture)
    for row, (name, (periods, displacement)) in enumerate(sways.items()):
        top = TOP + APART * row
        last = float(periods[-1])
        _frame(draw, top, last, f"{name}: damping ratio {ratios[name]:.3f}")
        decay = np.exp(-2.0 * np.pi * own * periods)
        for side in (1.0, -1.0):
            _line(draw, top, last, periods, side * decay, FAINT, 2)
        _line(draw, top, last, periods, displacement, COLOURS[row], 3)
    below = (
        f"grey: decay of every branch by itself, damping ratio {own:g}; time in periods of the lowest mode"
    )
    draw.text((LEFT, SIZE[1] - 42), below, fill=INK, font_size=20)
    write_png(np.asarray(picture.convert("RGBA")), path)


def _frame(draw: Any, top: int, last: float, title: str) -> None:
    """Box, ticks and title of a panel."""
    draw.rectangle((LEFT, top, LEFT + WIDE, top + HIGH), outline=INK)
    draw.line((LEFT, top + HIGH // 2, LEFT + WIDE, top + HIGH // 2), fill=(225, 225, 225))
    draw.text((LEFT, top - 8), title, fill=INK, font_size=22, anchor="ls")
    for tick in range(0, int(last) + 1, 2):
        x = LEFT + WIDE * tick / last
        draw.line((x, top + HIGH, x, top + HIGH + 5), fill=INK)
        draw.text((x, top + HIGH + 8), f"{tick}", fill=INK, font_size=16, anchor="mt")
    for value in (1.0, 0.0, -1.0):
        draw.text((LEFT - 8, _height(top, value)), f"{value:g}", fill=INK, font_size=16, anchor="rm")


def _line(
    draw: Any, top: int, last: float, x: Doubles, y: Doubles, colour: tuple[int, int, int], width: int
) -> None:
    """A curve in a panel."""
    points = [(LEFT + WIDE * float(a) / last, _height(top, float(b))) for a, b in zip(x, y, strict=True)]
    draw.line(points, fill=colour, width=width, joint="curve")


def _height(top: int, value: float) -> float:
    """Pixel row of a value between -1.1 and 1.1."""
    return top + HIGH * (0.5 - value / 2.2)
