"""draw_sheet: plants side by side, each with a person for scale."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from windswept.errors import InputError
from windswept.geometry.detail import DetailRules
from windswept.plants.sources import grow_source
from windswept.plants.species import load_species, species_names
from windswept.plants.weber_penn.tree import plant_tree
from windswept.scene.camera import View
from windswept.scene.load_scene import load_scene
from windswept.scene.simulation import Simulation

CELL = (420, 480)
"""Width and height of one plant's picture, pixels."""
CAPTION = 40
"""Height of the strip below it, pixels."""
COLUMNS = 6
PERSON = 1.75
"""Height of the figure, m."""
FOV = math.radians(24.0)
MARGIN = 1.16
"""Height of a picture over what it shows."""
SEEDS = 12
"""Seeds among which the typical tree of a species is sought."""
FIGURE = (
    *(
        (-0.055, 0.0),
        (-0.085, 0.03),
        (-0.075, 0.25),
        (-0.095, 0.47),
        (-0.10, 0.55),
        (-0.14, 0.45),
        (-0.165, 0.46),
    ),
    *(
        (-0.14, 0.62),
        (-0.13, 0.78),
        (-0.10, 0.82),
        (-0.03, 0.84),
        (-0.03, 0.87),
        (-0.055, 0.90),
        (-0.06, 0.95),
    ),
    *((-0.035, 0.99), (0.0, 1.0)),
)
"""Left half of a standing person's outline, over the height."""


def draw_sheet(
    sources: Sequence[str], path: Path, columns: int = COLUMNS, say: Callable[[str], None] = lambda line: None
) -> None:
    """Draw plants into one picture.

    Args:
        sources: anything that `grow_source` takes.
        path: of the PNG file.
        columns: plants in a row.
        say: told of each plant before it is drawn.

    Raises:
        InputError: the path does not end in .png, or a source is wrong.
        GraphicsError: there is no graphics adapter.
    """
    from PIL import Image

    from windswept.render.offscreen import write_png

    if path.suffix.lower() != ".png":
        raise InputError(str(path), "", path.suffix, "a path that ends in .png")
    width, height = CELL[0], CELL[1] + CAPTION
    rows = -(-len(sources) // columns)
    sheet = Image.new("RGBA", (columns * width, rows * height), (255, 255, 255, 255))
    for place, source in enumerate(sources):
        say(f"drawing {source}")
        corner = (place % columns * width, place // columns * height)
        sheet.paste(draw_with_person(source, typical_seed(source)), corner)
    write_png(np.asarray(sheet), path)


def typical_seed(source: str) -> int:
    """The seed, of the first few, whose tree is nearest to its species' mean size; 0 for other sources."""
    if source not in species_names():
        return 0
    species = load_species(source)
    scales = [plant_tree(species, seed, 1, 1).scale for seed in range(SEEDS)]
    return int(np.argmin(np.abs(np.array(scales) - species.growth.scale)))


def draw_with_person(source: str, seed: int = 0) -> Any:
    """A Pillow picture of one plant in calm air, a person beside it, and its name and height below."""
    from PIL import Image, ImageDraw

    from windswept.render.staging import frame_now, stage

    plant = grow_source(source, seed)
    simulation = Simulation(load_scene(source, seed), [plant])
    crown = max(0.0, float(np.abs(plant.link_tip[:, :2]).max()))
    left = -(crown + 0.25 + 0.2 * PERSON)
    shown = MARGIN * max(plant.height, PERSON, (crown - left + 0.7) * CELL[1] / CELL[0] / MARGIN)
    distance = 0.5 * shown / math.tan(0.5 * FOV) + crown
    middle = np.array([0.5 * (left + crown), 0.0, 0.46 * shown])
    eye = middle + np.array([0.0, -distance, 0.0])
    picture = stage(simulation, CELL, DetailRules()).draw(frame_now(simulation, View(eye, middle, FOV)))
    cell = Image.new("RGBA", (CELL[0], CELL[1] + CAPTION), (255, 255, 255, 255))
    cell.paste(Image.fromarray(np.ascontiguousarray(picture)))
    draw = ImageDraw.Draw(cell)
    scale = CELL[1] / (2.0 * distance * math.tan(0.5 * FOV))
    foot = (0.5 * CELL[0] + scale * (left - middle[0]), 0.5 * CELL[1] + scale * middle[2])
    outline = [*FIGURE, *((-x, y) for x, y in reversed(FIGURE))]
    points = [(foot[0] + scale * PERSON * x, foot[1] - scale * PERSON * y) for x, y in outline]
    draw.polygon(points, fill=(30, 32, 38, 255))
    draw.text((8, CELL[1] + 4), f"{plant.species}, {plant.height:.3g} m", fill=(0, 0, 0, 255), font_size=18)
    return cell
