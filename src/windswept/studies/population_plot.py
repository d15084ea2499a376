"""draw_population: two panels of points on the measured bands, drawn with Pillow."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.render.offscreen import write_png

Reals = NDArray[np.float64]

SIZE = (1500, 720)
"""Pixels."""
PANEL = (600, 520)
"""Width and height of one panel's frame, pixels."""
LEFT, TOP, APART = 95, 90, 730
FREQUENCY = (0.05, 5.0)
"""Range of both panels' vertical axes, Hz."""
FOREST_BAND, MODEL_BAND = (0.092, 0.270), (0.083, 0.513)
"""58 pulled broadleaves, from least to most; 970 frame models of scans, 5 to 95 %, Hz (Jackson et al. 2019)."""
MEDIAN = 0.88
"""f sqrt(H) of the 58, Hz sqrt(m)."""
T14 = ((23.8, 0.188), (23.8, 0.242))
"""Height and frequency of the scanned tree, in leaf and bare."""
OPEN_COLOUR, FOREST_COLOUR, INK = (226, 140, 20), (24, 110, 60), (40, 40, 40)


class _Panel:
    """A frame with two logarithmic axes.

    Args:
        draw: Pillow's drawing.
        left: place of the frame, pixels.
        span: range of the horizontal axis.
        ticks: marks on it.
        title: what it measures.
    """

    def __init__(
        self, draw: Any, left: int, span: tuple[float, float], ticks: tuple[float, ...], title: str
    ) -> None:
        self.draw, self.left, self.span = draw, left, span
        draw.rectangle((left, TOP, left + PANEL[0], TOP + PANEL[1]), outline=INK)
        for tick in ticks:
            x = self.at(tick, FREQUENCY[0])[0]
            draw.line((x, TOP + PANEL[1], x, TOP + PANEL[1] + 6), fill=INK)
            draw.text((x, TOP + PANEL[1] + 10), f"{tick:g}", fill=INK, font_size=18, anchor="mt")
        for tick in (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0):
            y = self.at(span[0], tick)[1]
            draw.line((left - 6, y, left, y), fill=INK)
            draw.text((left - 10, y), f"{tick:g}", fill=INK, font_size=18, anchor="rm")
        draw.text((left + PANEL[0] // 2, TOP + PANEL[1] + 44), title, fill=INK, font_size=20, anchor="mt")
        draw.text((left - 60, TOP - 14), "lowest frequency, Hz", fill=INK, font_size=20, anchor="ls")

    def at(self, x: float, frequency: float) -> tuple[float, float]:
        """Pixel of a point; outside the axes it is put on their edge."""
        across = math.log(x / self.span[0]) / math.log(self.span[1] / self.span[0])
        up = math.log(frequency / FREQUENCY[0]) / math.log(FREQUENCY[1] / FREQUENCY[0])
        clamped = min(max(across, 0.0), 1.0), min(max(up, 0.0), 1.0)
        return self.left + PANEL[0] * clamped[0], TOP + PANEL[1] * (1.0 - clamped[1])

    def band(self, low: float, high: float, colour: tuple[int, int, int], label: str) -> None:
        """A range of frequencies over the whole width."""
        x, bottom = self.at(self.span[0], low)
        top = self.at(self.span[0], high)[1]
        self.draw.rectangle((x + 1, top, x + PANEL[0] - 1, bottom), fill=colour)
        self.draw.text((x + 8, top + 4), label, fill=INK, font_size=15, anchor="lt")

    def points(self, x: Reals, frequency: Reals, colour: tuple[int, int, int]) -> None:
        """Trees."""
        for one, other in zip(x, frequency, strict=True):
            px, py = self.at(float(one), float(other))
            self.draw.ellipse((px - 4, py - 4, px + 4, py + 4), outline=colour, fill=(*colour, 150))


def draw_population(
    height: Reals, dbh: Reals, frequency: Reals, forest: NDArray[np.bool_], path: Path
) -> None:
    """Draw trees on the bands of measured ones.

    Args:
        height: (N,) m.
        dbh: (N,) m.
        frequency: (N,) Hz.
        forest: (N,) whether a tree is slender.
        path: of the PNG file.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image, ImageDraw

    picture = Image.new("RGBA", SIZE, (255, 255, 255, 255))
    draw = ImageDraw.Draw(picture, "RGBA")
    by_height = _Panel(draw, LEFT, (3.0, 40.0), (5, 10, 20, 40), "height H, m")
    by_slenderness = _Panel(
        draw, LEFT + APART, (2e-4, 2e-2), (2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2), "DBH / H^2, 1/m"
    )
    for panel in (by_height, by_slenderness):
        panel.band(*MODEL_BAND, (222, 232, 244), "970 frame models of scans, 5 to 95 %")
        panel.band(*FOREST_BAND, (190, 208, 230), "58 forest broadleaves, pulled")
    _median_line(by_height)
    for which, colour in ((~forest, OPEN_COLOUR), (forest, FOREST_COLOUR)):
        by_height.points(height[which], frequency[which], colour)
        by_slenderness.points(dbh[which] / height[which] ** 2, frequency[which], colour)
    for tall, rate in T14:
        x, y = by_height.at(tall, rate)
        draw.rectangle((x - 5, y - 5, x + 5, y + 5), fill=(190, 20, 30))
    _legend(draw)
    write_png(np.asarray(picture), path)


def _median_line(panel: _Panel) -> None:
    """F = 0.88 / sqrt(H)."""
    ends = [panel.at(h, MEDIAN / math.sqrt(h)) for h in (panel.span[0], panel.span[1])]
    panel.draw.line((*ends[0], *ends[1]), fill=(30, 70, 140), width=3)


def _legend(draw: Any) -> None:
    """What the marks mean."""
    entries = (
        (OPEN_COLOUR, "grown in the open"),
        (FOREST_COLOUR, "grown slender, as in a forest"),
        ((190, 20, 30), "T14, measured in leaf and bare"),
        ((30, 70, 140), "f = 0.88 / sqrt(H), median of the 58"),
    )
    for place, (colour, words) in enumerate(entries):
        x = LEFT + 350 * place
        draw.rectangle((x, 26, x + 14, 40), fill=colour)
        draw.text((x + 22, 33), words, fill=INK, font_size=18, anchor="lm")
