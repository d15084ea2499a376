"""A plan of the meadow at the paper's limit, 100,000 plants: who grows where, on which ground.

Run ``python -m windswept.studies.spread_plot -o spread.png``.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.render.offscreen import write_png
from windswept.scene.build_ground import build_nutrients, build_terrain
from windswept.scene.build_spread import build_spread
from windswept.scene.plant_sources import Nursery
from windswept.scene.spread.nutrients import Nutrient
from windswept.scene.terrain import Terrain
from windswept.studies.spread_scene import MEADOW, spread_scene

Reals = NDArray[np.float64]
Colour = tuple[int, int, int]

COUNT = 100_000
PICTURE = (1720, 1190)
"""Pixels."""
MAIN, SMALL, LEFT, TOP, APART = 1080, 520, 40, 56, 40
"""Edges of the large and the small panels, left and upper margin, and gap, pixels."""
FINER = 2
"""Drawn at so many times the size, and made smaller."""
CLOSE_UP = 5.0
"""Edge of the piece of ground in the close-up, m."""
POOR, RICH = (247, 241, 226), {"moisture": (120, 163, 196), "nitrogen": (186, 140, 92)}
"""Colours of poor ground, and of ground rich in a nutrient."""
INK, LINE = (40, 40, 40), (120, 112, 98)
LOOKS: dict[str, tuple[str, Colour]] = {
    "meadow_fescue": ("meadow fescue", (128, 168, 74)),
    "tufted_hair_grass": ("tufted hair-grass", (36, 104, 84)),
    "white_clover": ("white clover", (240, 240, 232)),
    "common_poppy": ("common poppy", (204, 36, 34)),
    "oxeye_daisy": ("oxeye daisy", (246, 196, 20)),
    "cornflower": ("cornflower", (52, 84, 196)),
    "heather": ("heather", (158, 66, 142)),
    "male_fern": ("male fern", (24, 70, 30)),
    "hazel": ("hazel", (146, 98, 44)),
    "quaking_aspen": ("quaking aspen", (96, 84, 66)),
}
"""Name and colour of each species."""


@dataclass(frozen=True, slots=True)
class Meadow:
    """All plants of the meadow, by species, in the order of LOOKS."""

    terrain: Terrain
    nutrients: list[Nutrient]
    stems: dict[str, Reals]
    """(n, 3) x, y and radius of the foot, m."""
    crowns: dict[str, float]
    """Radius of a tree's crown, m."""


def grow_meadow(count: int = COUNT) -> Meadow:
    """Let the meadow spread."""
    form = spread_scene(count)
    assert form.spread is not None
    terrain, nursery = build_terrain(str(MEADOW), form.ground, form.seed), Nursery()
    feet = {sort.source: sort.radius_m for sort in form.spread.species}
    stems = {
        colony.source: np.column_stack([colony.position[:, :2], feet[colony.source] * colony.size])
        for colony in build_spread(str(MEADOW), form, terrain, nursery)
    }
    for kind, places in nursery.places.items():
        rows = np.column_stack([places, np.full(len(places), feet[kind.source])])
        stems[kind.source] = np.concatenate([stems.get(kind.source, np.zeros((0, 3))), rows])
    trees = {kind.source for kind in nursery.places}
    crowns = {sort.source: sort.reach_m or 0.0 for sort in form.spread.species if sort.source in trees}
    nutrients = build_nutrients(str(MEADOW), form.nutrient, terrain.size, form.seed)
    return Meadow(terrain, nutrients, {name: stems[name] for name in LOOKS if name in stems}, crowns)


def draw_meadow(meadow: Meadow, path: Path) -> None:
    """Draw the plan, a close-up and the maps of nutrients.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image, ImageDraw

    half = 0.5 * meadow.terrain.size
    picture = Image.new("RGB", (FINER * PICTURE[0], FINER * PICTURE[1]), (255, 255, 255))
    right, low = LEFT + MAIN + APART, TOP + SMALL + APART + 26
    corner = _crowded_corner(meadow)
    window = (corner[0], corner[1], CLOSE_UP)
    _plan(picture, meadow, (LEFT, TOP, MAIN), (-half, -half, 2.0 * half), window)
    _plan(picture, meadow, (right, TOP, SMALL), window, None)
    small = (SMALL - APART) // 2
    for place, nutrient in enumerate(meadow.nutrients):
        _map(picture, nutrient, (right + place * (small + APART), low, small))
    draw = ImageDraw.Draw(picture)
    total = sum(map(len, meadow.stems.values()))
    _write(
        draw, LEFT, TOP - 12, f"{total:,} plants on {2 * half:.0f} m x {2 * half:.0f} m, over moisture", "ls"
    )
    _write(draw, right, TOP - 12, f"the framed {CLOSE_UP:g} m x {CLOSE_UP:g} m: feet at their size", "ls")
    for place, nutrient in enumerate(meadow.nutrients):
        words = f"{nutrient.name}, {nutrient.map.min():.2g} to {nutrient.map.max():.2g}"
        _write(draw, right + place * (small + APART), low - 12, words, "ls")
    _legend(draw, meadow, right, low + small + 40)
    _scale_bar(draw, LEFT, TOP + MAIN + 22, MAIN / (2.0 * half))
    write_png(np.asarray(picture.resize(PICTURE, Image.Resampling.LANCZOS)), path)


def _crowded_corner(meadow: Meadow) -> Reals:
    """South-western corner of the piece of ground on which the most species meet evenly."""
    half = 0.5 * meadow.terrain.size
    edges = np.arange(-half, half + 1e-6, CLOSE_UP)
    counts = np.array(
        [np.histogram2d(stems[:, 0], stems[:, 1], bins=[edges, edges])[0] for stems in meadow.stems.values()]
    )
    share = counts / np.maximum(counts.sum(axis=0), 1.0)
    variety = -np.sum(share * np.log(np.maximum(share, 1e-12)), axis=0)
    column, row = np.unravel_index(np.argmax(variety), variety.shape)
    return np.array([edges[column], edges[row]])


def _plan(
    picture: Any,
    meadow: Meadow,
    panel: tuple[int, int, int],
    ground: tuple[float, float, float],
    frame: tuple[float, float, float] | None,
) -> None:
    """One square of ground (west, south, edge, m) with its plants, in a square panel (left, top, edge, pixels)."""
    from PIL import Image, ImageDraw

    left, top, edge = (FINER * number for number in panel)
    west, south, length = ground
    scale = edge / length
    middle = (np.arange(edge) + 0.5) / scale
    x, y = np.meshgrid(west + middle, south + middle[::-1])
    nutrient = meadow.nutrients[0]
    square = Image.fromarray(_tint(nutrient, nutrient.amount(x, y)))
    draw = ImageDraw.Draw(square, "RGBA")

    def circle(east: float, north: float, radius: float, **look: Any) -> None:
        px, py, pr = (east - west) * scale, edge - (north - south) * scale, radius * scale
        draw.ellipse((px - pr, py - pr, px + pr, py + pr), **look)

    for name, stems in meadow.stems.items():
        inside = np.all(
            (stems[:, :2] > [west - 4, south - 4]) & (stems[:, :2] < [west + length + 4, south + length + 4]),
            axis=1,
        )
        for east, north, radius in stems[inside].tolist():
            if name in meadow.crowns:
                circle(
                    east,
                    north,
                    meadow.crowns[name],
                    fill=(*LOOKS[name][1], 60),
                    outline=LOOKS[name][1],
                    width=3,
                )
            circle(east, north, radius, fill=LOOKS[name][1], outline=INK if scale > 100 else None)
    if frame is not None:
        px, py, pe = (frame[0] - west) * scale, edge - (frame[1] - south + frame[2]) * scale, frame[2] * scale
        draw.rectangle((px, py, px + pe, py + pe), outline=INK, width=3)
    draw.rectangle((0, 0, edge - 1, edge - 1), outline=INK, width=2)
    picture.paste(square, (left, top))


def _map(picture: Any, nutrient: Nutrient, panel: tuple[int, int, int]) -> None:
    """A nutrient over all the ground."""
    from PIL import Image, ImageDraw

    left, top, edge = (FINER * number for number in panel)
    middle = ((np.arange(edge) + 0.5) / edge - 0.5) * nutrient.size
    x, y = np.meshgrid(middle, middle[::-1])
    square = Image.fromarray(_tint(nutrient, nutrient.amount(x, y)))
    ImageDraw.Draw(square).rectangle((0, 0, edge - 1, edge - 1), outline=INK, width=2)
    picture.paste(square, (left, top))


def _tint(nutrient: Nutrient, amount: Reals) -> NDArray[np.uint8]:
    """(..., 3) colour of ground that holds so much of a nutrient."""
    share = (amount / nutrient.map.max())[..., None]
    poor, rich = np.array(POOR, np.float64), np.array(RICH.get(nutrient.name, LINE), np.float64)
    return np.clip(poor + share * (rich - poor), 0, 255).astype(np.uint8)


def _write(draw: Any, x: int, y: int, words: str, anchor: str) -> None:
    """A line of text."""
    draw.text((FINER * x, FINER * y), words, fill=INK, font_size=FINER * 17, anchor=anchor)


def _legend(draw: Any, meadow: Meadow, left: int, top: int) -> None:
    """Colours, names and numbers of the species, in two columns."""
    rows = (len(meadow.stems) + 1) // 2
    for place, (name, stems) in enumerate(meadow.stems.items()):
        words, colour = LOOKS[name]
        x, y = left + 272 * (place // rows), top + 34 * (place % rows)
        draw.ellipse([FINER * n for n in (x, y - 8, x + 16, y + 8)], fill=colour, outline=INK, width=2)
        _write(draw, x + 26, y, f"{words}, {len(stems):,}", "lm")
    _write(draw, left, top + 34 * rows + 8, "large circles: crowns of trees", "lm")


def _scale_bar(draw: Any, left: int, y: int, scale: float) -> None:
    """Ten metres."""
    end = left + round(10.0 * scale)
    for box in ((left, y, end, y), (left, y - 5, left, y + 5), (end, y - 5, end, y + 5)):
        draw.line([FINER * n for n in box], fill=INK, width=2 * FINER)
    _write(draw, end + 12, y, "10 m", "lm")


def main() -> None:
    """Draw the picture."""
    parser = argparse.ArgumentParser(description="A plan of the meadow with 100,000 plants.")
    parser.add_argument("-o", "--out", type=Path, default=Path("spread.png"))
    draw_meadow(grow_meadow(), parser.parse_args().out)


if __name__ == "__main__":
    main()
