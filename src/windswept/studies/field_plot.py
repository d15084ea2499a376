"""A plan view of the field: a gust passes a post and a crown, drawn with Pillow.

``python -m windswept.studies.field_plot -o docs/pictures/field.png``
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path as FilePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.render.offscreen import write_png
from windswept.wind.field import Cylinder, Field, FieldPlan, Grid, Spheroid, sample, start_field, step_field
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.velocity import velocity
from windswept.wind.wind import Wind

Floats = NDArray[np.float32]
Reals = NDArray[np.float64]

POST = Cylinder((-14.0, 5.0), 2.5, 9.0)
CROWN = Spheroid((4.0, -10.0, 5.0), 5.0, 4.0, 0.5)
WEST, SOUTH, EAST, NORTH = -46.0, -25.0, 46.0, 25.0
"""Of the picture, m."""
HEIGHT = 4.0
"""At which the air is shown, m."""
TIME = 16.0
"""s."""
PER_METRE = 15
"""Pixels."""
LEFT, TOP, BELOW = 90, 70, 110
"""Margins, pixels."""
FINER = 2
"""Lines are drawn so many times larger."""
STREAK_APART, STREAK_SECONDS, STREAK_STEPS = 1.7, 0.6, 16
"""Streaks of air: distance between them, m; how long the air takes along one; pieces it is drawn in."""
FASTEST = 8.0
"""End of the colour scale, m/s."""
COLOURS = (
    (28, 34, 68),
    (38, 84, 124),
    (46, 139, 139),
    (122, 188, 120),
    (228, 222, 122),
    (246, 158, 70),
    (214, 74, 62),
)
"""Of the speeds from 0 to FASTEST, evenly."""
INK = (40, 40, 40)


def passing_gust(cell: float = 0.5) -> Field:
    """The field at the moment that is drawn, with nodes a cell's edge apart, m."""
    gust = Gust(
        start=TIME,
        strength=4.5,
        speed=9.0,
        azimuth=math.radians(12.0),
        position=(16.0, 0.0),
        rise_length=9.0,
        hold_length=8.0,
        decay_length=26.0,
    )
    wind = Wind(mean=MeanWind(5.0, 0.0), gusts=(gust,))
    grid = Grid((-60.0, -40.0), (cell, cell, 1.0), (round(120.0 / cell) + 1, round(80.0 / cell) + 1, 13))
    field = start_field(FieldPlan(grid, obstacles=(POST, CROWN)), wind)
    return step_field(field, TIME)


def air(field: Field, places: Reals) -> Floats:
    """(N, 3) velocity at (N, 2) places, m/s."""
    points = np.column_stack([places, np.zeros(len(places))]).astype(np.float32)
    height = np.full(len(points), HEIGHT, np.float32)
    return velocity(field.wind, points, height, field.time) + sample(field, points, height)


def colour_of(speed: NDArray[Any]) -> NDArray[np.uint8]:
    """(..., 3) colour of a speed, m/s."""
    stops = np.linspace(0.0, FASTEST, len(COLOURS))
    return np.stack([np.interp(speed, stops, [c[n] for c in COLOURS]) for n in range(3)], axis=-1).astype(
        np.uint8
    )


def draw_field(field: Field, path: FilePath) -> None:
    """Draw speed as colour, direction as streaks that brighten downwind, and what stands in the field.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image, ImageDraw

    width, height = round((EAST - WEST) * PER_METRE), round((NORTH - SOUTH) * PER_METRE)
    picture = Image.new("RGB", (LEFT + width + 30, TOP + height + BELOW), (255, 255, 255))
    columns = WEST + (np.arange(width) + 0.5) / PER_METRE
    rows = NORTH - (np.arange(height) + 0.5) / PER_METRE
    places = np.stack(np.meshgrid(columns, rows), axis=-1)
    speed = np.linalg.norm(air(field, places.reshape(-1, 2)), axis=1).reshape(height, width)
    # Lines are drawn larger and made smaller, which smooths them.
    ground = Image.fromarray(colour_of(speed)).resize(
        (FINER * width, FINER * height), Image.Resampling.BICUBIC
    )
    _draw_streaks(field, ImageDraw.Draw(ground, "RGBA"))
    _draw_obstacles(ImageDraw.Draw(ground, "RGBA"))
    picture.paste(ground.resize((width, height), Image.Resampling.LANCZOS), (LEFT, TOP))
    _draw_frame(ImageDraw.Draw(picture), width, height)
    write_png(np.asarray(picture), path)


def _pixel(places: Reals) -> Reals:
    """(N, 2) pixels of the larger drawing inside the frame."""
    return FINER * PER_METRE * np.column_stack([places[:, 0] - WEST, NORTH - places[:, 1]])


def _draw_streaks(field: Field, draw: Any) -> None:
    """Ways that air goes in a moment, brighter and wider to where it goes."""
    rng = np.random.default_rng(0)
    x, y = np.meshgrid(np.arange(WEST, EAST, STREAK_APART), np.arange(SOUTH, NORTH, STREAK_APART))
    places = np.column_stack([x.ravel(), y.ravel()]) + rng.uniform(0.0, STREAK_APART, (x.size, 2))
    ways = [places]
    for _ in range(STREAK_STEPS):
        half = places + 0.5 * STREAK_SECONDS / STREAK_STEPS * air(field, places)[:, :2]
        places = places + STREAK_SECONDS / STREAK_STEPS * air(field, half)[:, :2]
        ways.append(places)
    pixels = np.stack([_pixel(way) for way in ways])
    for n in range(STREAK_STEPS):
        share = (n + 1) / STREAK_STEPS
        for start, stop in zip(pixels[n], pixels[n + 1], strict=True):
            draw.line((*start, *stop), fill=(255, 255, 255, int(190 * share)), width=2 + int(2.0 * share))


def _draw_obstacles(draw: Any) -> None:
    """Outlines at the height that is shown, and their names."""
    for (x, y), radius, fill, name in (
        (POST.centre, POST.radius, (70, 66, 64, 255), "post"),
        (CROWN.centre[:2], CROWN.radius, (30, 90, 40, 120), "crown, half open"),
    ):
        px, py = _pixel(np.array([[x, y]]))[0]
        r = FINER * radius * PER_METRE
        draw.ellipse((px - r, py - r, px + r, py + r), fill=fill, outline=(255, 255, 255, 255), width=4)
        edge = {"stroke_width": 5, "stroke_fill": (40, 40, 40, 255)}
        draw.text((px, py + r + 34), name, fill=(255, 255, 255, 255), font_size=38, anchor="mm", **edge)


def _draw_frame(draw: Any, width: int, height: int) -> None:
    """Axes, title and colour scale."""
    draw.rectangle((LEFT, TOP, LEFT + width, TOP + height), outline=INK)
    for x in range(-40, 41, 20):
        px = LEFT + (x - WEST) * PER_METRE
        draw.line((px, TOP + height, px, TOP + height + 6), fill=INK)
        draw.text((px, TOP + height + 10), f"{x}", fill=INK, font_size=18, anchor="mt")
    for y in range(-20, 21, 10):
        py = TOP + (NORTH - y) * PER_METRE
        draw.line((LEFT - 6, py, LEFT, py), fill=INK)
        draw.text((LEFT - 10, py), f"{y}", fill=INK, font_size=18, anchor="rm")
    draw.text((LEFT - 10, TOP + 8), "y, m", fill=INK, font_size=18, anchor="rm")
    draw.text((LEFT + width, TOP + height + 10), "x, m", fill=INK, font_size=18, anchor="rt")
    title = f"Air {HEIGHT:g} m above the ground: a gust that travels to the right at 9 m/s passes a post and a crown"
    draw.text((LEFT, TOP - 30), title, fill=INK, font_size=22, anchor="lm")
    bar = 420
    left, top = LEFT + width - bar, TOP + height + 62
    for n in range(bar):
        draw.line(
            (left + n, top, left + n, top + 16), fill=tuple(colour_of(np.array(FASTEST * n / bar)).tolist())
        )
    for speed in range(0, int(FASTEST) + 1, 2):
        draw.text((left + bar * speed / FASTEST, top + 20), f"{speed}", fill=INK, font_size=18, anchor="mt")
    draw.text((left - 14, top + 8), "speed, m/s", fill=INK, font_size=18, anchor="rm")
    draw.text(
        (LEFT, top + 8),
        f"streaks: the way of the air in {STREAK_SECONDS:g} s",
        fill=INK,
        font_size=18,
        anchor="lm",
    )


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(description="Plan view of a gust passing a post.")
    parser.add_argument("-o", "--output", type=FilePath, required=True, help="PNG file")
    draw_field(passing_gust(), parser.parse_args(arguments).output)


if __name__ == "__main__":
    main()
