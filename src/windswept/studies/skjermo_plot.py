"""draw_frames: Skjermo's figure 8, frames and passes a second over branches, drawn with Pillow."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from windswept.render.offscreen import write_png

SIZE = (1120, 860)
"""Pixels."""
FRAME = (100, 170, 1080, 700)
"""Left, top, right and bottom of the axes, pixels."""
FINER = 3
"""Lines are drawn so many times larger and made smaller, which smooths them."""
INK, FAINT, FAINTER = (40, 40, 40), (205, 205, 205), (236, 236, 236)
FRAMES, WOOD = (24, 110, 60), (110, 170, 60)
CARD, CPU, PAPER = (226, 140, 20), (30, 70, 140), (190, 20, 30)

Point = tuple[float, float]


class _Axes:
    """A frame with two logarithmic axes.

    Args:
        draw: Pillow's drawing, FINER times larger.
        points: (branches, per second) of all that will be drawn in it.
    """

    def __init__(self, draw: Any, points: Sequence[Point]) -> None:
        self._draw = draw
        self._spans = [(min(one) / 1.5, 1.5 * max(one)) for one in zip(*points, strict=True)]

    def grid(self, vertices: dict[float, int]) -> None:
        """Lines, numbers and titles; ``vertices`` that are drawn are told above the branches they stand for."""
        left, top, right, bottom = FRAME
        low, high = self._spans[1]
        for decade in range(math.floor(math.log10(low)), math.ceil(math.log10(high))):
            for digit in range(1, 10):
                value = digit * 10.0**decade
                if low <= value <= high:
                    y = self._at((1.0, value))[1]
                    self._line([(left, y), (right, y)], FAINT if digit == 1 else FAINTER, 1)
                    if digit in (1, 2, 5):
                        self.words((left - 8, y), f"{value:,g}", "rm")
        for branches, count in vertices.items():
            x = self._at((branches, low))[0]
            self._line([(x, top), (x, bottom)], FAINTER, 1)
            self.words((x, bottom + 10), f"{branches:,.0f}", "mt")
            if count:
                self.words((x, top - 8), f"{count / 1e6:#.2g}", "ms")
        for start, end in ((0, 1), (1, 2), (2, 3), (3, 0)):
            corners = [(left, top), (right, top), (right, bottom), (left, bottom)]
            self._line([corners[start], corners[end]], INK, 1)
        self.words(((left + right) / 2, bottom + 38), "branches", "mt", 20)
        self.words(((left + right) / 2, top - 34), "million vertices drawn", "ms", 20)
        self.words((24, top - 34), "frames or passes per second", "ls", 20)

    def curve(self, points: Sequence[Point], colour: tuple[int, int, int], square: bool = False) -> None:
        """Points and the line through them."""
        places = [self._at(point) for point in sorted(points)]
        self._line(places, colour, 3)
        for place in places:
            self.mark(place, colour, square)

    def mark(self, place: Point, colour: tuple[int, int, int], square: bool = False) -> None:
        """A point at a pixel, with a white rim."""
        x, y = place
        shape = self._draw.rectangle if square else self._draw.ellipse
        for size, fill in ((7.5, (255, 255, 255)), (6.0, colour)):
            shape([FINER * one for one in (x - size, y - size, x + size, y + size)], fill=fill)

    def words(self, place: Point, words: str, anchor: str, size: int = 17) -> None:
        """Text at a pixel."""
        spot = (FINER * place[0], FINER * place[1])
        self._draw.text(spot, words, fill=INK, font_size=FINER * size, anchor=anchor)

    def _line(self, places: Sequence[Point], colour: tuple[int, int, int], width: int) -> None:
        larger = [(FINER * x, FINER * y) for x, y in places]
        self._draw.line(larger, fill=colour, width=FINER * width, joint="curve")

    def _at(self, point: Point) -> Point:
        """Pixel of a point."""
        left, top, right, bottom = FRAME
        across, up = (
            math.log(one / low) / math.log(high / low)
            for one, (low, high) in zip(point, self._spans, strict=True)
        )
        return left + across * (right - left), bottom - up * (bottom - top)


def draw_frames(rows: Sequence[dict[str, Any]], path: Path) -> None:
    """Draws what `windswept reproduce skjermo` measured, and what the paper's text says beside it.

    Args:
        rows: as that command prints them with ``--json``.
        path: of the PNG file.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image, ImageDraw

    bent = [row for row in rows if row["what"] == "bend" and row["mode"] == "lagged"]
    frames = [row for row in rows if row["what"] == "frames"]
    card = frames[0]["on"]
    curves = (
        ("passes, bent alone, the paper", PAPER, bent, "paper_per_second"),
        ("passes, bent alone, CPU", CPU, [row for row in bent if row["on"] != card], "per_second"),
        ("passes, bent alone, card", CARD, [row for row in bent if row["on"] == card], "per_second"),
        ("frames, bent and drawn, card", FRAMES, frames, "per_second"),
        (
            "frames, the detailed wood, card",
            WOOD,
            [row for row in rows if row["what"] == "wood"],
            "per_second",
        ),
    )
    picture = Image.new("RGB", (FINER * SIZE[0], FINER * SIZE[1]), (255, 255, 255))
    drawn = [[(row["branches"], row[figure]) for row in chosen] for _, _, chosen, figure in curves]
    axes = _Axes(ImageDraw.Draw(picture), [point for points in drawn for point in points])
    axes.grid({row["branches"]: row["vertices"] for row in bent + frames})
    shown = [(*curve[:2], points) for curve, points in zip(curves, drawn, strict=True) if points]
    for place, (words, colour, points) in enumerate(shown):
        axes.curve(points, colour, square=colour == PAPER)
        x, y = FRAME[0] + 330.0 * (place // 2), 34.0 + 32.0 * (place % 2)
        axes.mark((x + 8, y), colour, square=colour == PAPER)
        axes.words((x + 24, y), words, "lm", 18)
    cpus = ", ".join(sorted({row["on"] for row in bent if row["on"] != card}))
    below = (
        f"Card: {card}. CPU: {cpus}. Paper: {bent[0]['paper_on']}.",
        "Of the paper only the two rates of bending alone are printed; its frames stand in a picture.",
    )
    for number, line in enumerate(below):
        axes.words((FRAME[0], FRAME[3] + 84 + 26 * number), line, "lt")
    write_png(np.asarray(picture.resize(SIZE, Image.Resampling.LANCZOS)), path)
