"""draw_levels: errors of a plant's simulation levels over the links that each steps, drawn with Pillow."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from windswept.levels.metrics import METRICS
from windswept.render.offscreen import write_png

SIZE = (1100, 760)
"""Pixels."""
FRAME = (110, 90, 1060, 660)
"""Left, top, right and bottom of the axes, pixels."""
INK, FAINT = (40, 40, 40), (222, 222, 222)
CURVES = (
    ("bound", "bound, hardest winds up to 12 m/s", (170, 170, 170)),
    ("measured_max", "largest measured", (226, 140, 20)),
    ("measured_p95", "95 % of tips", (24, 110, 60)),
)


def draw_levels(report: dict[str, Any], path: Path) -> None:
    """Draws what `windswept levels` reports.

    Args:
        report: as that command prints it with ``--json``.
        path: of the PNG file.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image, ImageDraw

    picture = Image.new("RGB", SIZE, (255, 255, 255))
    draw = ImageDraw.Draw(picture)
    unit = METRICS[report["metric"]].suffix
    rows = [row for row in report["levels"] if row["level"] > 0 and row[f"bound_{unit}"] > 0.0]
    links = [row["links"] for row in report["levels"]]
    values = [max(row[f"{name}_{unit}"], 1e-6) for row in rows for name, _, _ in CURVES]
    across = (0.7, 1.4 * max(links))
    up = (0.7 * min(values), 1.5 * max(values))
    _axes(draw, across, up, report)
    for place, (name, words, colour) in enumerate(CURVES):
        points = [
            (_at(row["links"], across, 0, 2), _at(max(row[f"{name}_{unit}"], 1e-6), up, 3, 1)) for row in rows
        ]
        draw.line(points, fill=colour, width=3)
        for x, y in points:
            draw.ellipse((x - 5, y - 5, x + 5, y + 5), fill=colour)
        x = FRAME[0] + 330 * place
        draw.rectangle((x, 26, x + 14, 40), fill=colour)
        draw.text((x + 22, 33), words, fill=INK, font_size=18, anchor="lm")
    write_png(np.asarray(picture), path)


def _axes(draw: Any, across: tuple[float, float], up: tuple[float, float], report: dict[str, Any]) -> None:
    """Frame, decades and titles."""
    for decade in range(-6, 7):
        value = 10.0**decade
        if across[0] <= value <= across[1]:
            x = _at(value, across, 0, 2)
            draw.line((x, FRAME[1], x, FRAME[3]), fill=FAINT)
            draw.text((x, FRAME[3] + 10), f"{value:g}", fill=INK, font_size=18, anchor="mt")
        if up[0] <= value <= up[1]:
            y = _at(value, up, 3, 1)
            draw.line((FRAME[0], y, FRAME[2], y), fill=FAINT)
            draw.text((FRAME[0] - 10, y), f"{value:g}", fill=INK, font_size=18, anchor="rm")
    draw.rectangle(FRAME, outline=INK)
    middle = (FRAME[0] + FRAME[2]) // 2
    title = f"links and groups stepped, {report['species']}"
    draw.text((middle, FRAME[3] + 48), title, fill=INK, font_size=20, anchor="mt")
    draw.text((20, FRAME[1] - 10), f"error, {report['unit']}", fill=INK, font_size=20, anchor="ls")


def _at(value: float, span: tuple[float, float], low: int, high: int) -> float:
    """Pixel of a value on a logarithmic axis between two edges of the frame."""
    share = math.log(value / span[0]) / math.log(span[1] / span[0])
    return FRAME[low] + share * (FRAME[high] - FRAME[low])
