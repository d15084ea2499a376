"""Pictures after Endo's figures 3, 4, 8 and 9: a blade that bends, four kinds of tufts, two fields in a wind."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

import windswept.plants.underbrush
from windswept.gpu.meadow.blade_list import BladeRules
from windswept.motion.blades import build_chain, rest_shape
from windswept.motion.blades.rest_shape import natural_turns, posed
from windswept.render.offscreen import write_png
from windswept.render.staging import frame_now, stage
from windswept.scene.load_scene import build_scene
from windswept.scene.scene import Scene
from windswept.scene.simulation import Simulation

Pixels = NDArray[np.uint8]

PANEL = (500, 500)
TALL, LOW = (420, 500), (420, 320)
TUFT = Path(windswept.plants.underbrush.__path__[0]) / "species" / "meadow_fescue.toml"
VARIANTS: tuple[dict[str, float], ...] = (
    {},
    {"thickness_mm": 0.3},
    {"width_mm": 11.0, "length_mm": 330.0},
    {"density": 1100.0, "curve_deg": 90.0},
)
"""Values of the leaf of a tuft, one picture each: as it is, thin, broad and long, heavy and curved."""
WIND = ((0.0, 0.0), (13.0, 2.6), (0.0, 5.0))
"""Speed of the air, m/s, and until when it blows, s: calm, a flow, calm again."""
SECTIONS = 8


def draw_figures(folder: Path, say: Callable[[str], None] = lambda line: None) -> None:
    """Write endo_bending, endo_tufts, endo_grass and endo_flowers, all .png.

    Args:
        folder: where.
        say: told what is being drawn.
    """
    from windswept.studies.endo import flower_field, grass_field

    say("figure 3: a blade that bends joint by joint")
    write_png(bending(), folder / "endo_bending.png")
    say("figure 4: tufts")
    write_png(tufts(), folder / "endo_tufts.png")
    for number, name, scene in ((8, "grass", grass_field(200)), (9, "flowers", flower_field())):
        say(f"figure {number}: a field of {name} before, in and after a flow of wind")
        write_png(in_a_flow(scene), folder / f"endo_{name}.png")


def bending(stages: tuple[int, ...] = (0, 1, 3, SECTIONS), size: tuple[int, int] = LOW) -> Pixels:
    """Figure 3: the paper's pass from base to tip, stage by stage, and the true equilibrium beside its end.

    A blade with a weight of 6 EI / L^2, clamped at 60 degrees to the vertical.
    """
    from PIL import Image, ImageDraw

    ones = np.ones(SECTIONS)
    chain = build_chain(ones / SECTIONS, ones, 0.3 * ones, ones, 0.0 * ones, 1.0, 1e9 * ones, "figure 3")
    lean = np.radians(60.0)
    down = 6.0 * np.array([-np.cos(lean), np.sin(lean), 0.0])
    passed, settled = rest_shape(chain, down, "sequential"), rest_shape(chain, down)
    panels = []
    for bent in stages:
        turns = natural_turns(chain)
        turns[:bent] = passed.turns[:bent]
        image = Image.new("RGB", (2 * size[0], 2 * size[1]), (250, 249, 245))
        draw = ImageDraw.Draw(image)
        if bent == SECTIONS:
            draw.line(_on_paper(settled.joint, lean, size), fill=(225, 150, 60), width=6)
        line = _on_paper(posed(chain, turns).joint, lean, size)
        draw.line(line, fill=(50, 110, 40), width=8)
        for number, (x, y) in enumerate(line):
            colour = (180, 40, 30) if number < bent else (40, 40, 40)
            draw.ellipse((x - 9, y - 9, x + 9, y + 9), fill=colour)
        panels.append(np.asarray(image.convert("RGBA").resize(size)))
    return np.concatenate(panels, axis=1)


def _on_paper(joint: NDArray[np.float64], lean: float, size: tuple[int, int]) -> list[tuple[float, float]]:
    """Joints (K + 1, 3) of a blade that leaves the ground at an angle, in pixels of a drawing twice as large."""
    ahead = joint[:, 0] * np.sin(lean) + joint[:, 1] * np.cos(lean)
    up = joint[:, 0] * np.cos(lean) - joint[:, 1] * np.sin(lean)
    scale = 1.55 * size[0]
    return list(
        zip((0.2 * size[0] + scale * ahead).tolist(), (1.35 * size[1] - scale * up).tolist(), strict=True)
    )


def tufts(size: tuple[int, int] = TALL) -> Pixels:
    """Figure 4: one tuft for each of VARIANTS, side by side."""
    text = TUFT.read_text(encoding="utf-8")
    with TemporaryDirectory() as folder:
        panels = []
        for number, changes in enumerate(VARIANTS):
            path = Path(folder) / f"tuft_{number}.toml"
            path.write_text(_changed(text, changes), encoding="utf-8")
            panels.append(_moment(Simulation(_lone_tuft(path)), size))
    return np.concatenate(panels, axis=1)


def _changed(text: str, changes: dict[str, float]) -> str:
    """A species file with other values of its first component."""
    for key, value in changes.items():
        text = re.sub(rf"^{key} = .*$", f"{key} = {value}", text, count=1, flags=re.MULTILINE)
    return text


def _lone_tuft(path: Path) -> Scene:
    """One tuft in calm air."""
    data: dict[str, Any] = {
        "ground": {"size_m": 20.0},
        "wind": {"speed_m_s": 0.0, "turbulence": 0.0},
        "plant": [{"source": str(path), "position": [0.0, 0.0]}],
        "camera": {"eye": [0.0, -1.25, 0.42], "target": [0.0, 0.0, 0.24], "fov_degrees": 36.0},
        "sun": {"azimuth_degrees": 130.0, "elevation_degrees": 30.0},
    }
    return build_scene("tuft", data)


def in_a_flow(scene: Scene, size: tuple[int, int] = PANEL) -> Pixels:
    """Figures 8 and 9: a field in calm air, in a flow of wind, and when the flow has passed."""
    from windswept.wind.mean import MeanWind
    from windswept.wind.wind import Wind

    simulation = Simulation(scene, picture_height=10**9)
    panels = []
    for speed, until in WIND:
        simulation.wind = Wind(profile=scene.wind.profile, mean=MeanWind(speed, 0.0))
        simulation.advance(until - simulation.time)
        panels.append(_moment(simulation, size))
    return np.concatenate(panels, axis=1)


def _moment(simulation: Simulation, size: tuple[int, int]) -> Pixels:
    """(height, width, 4) what is to be seen now, in full detail."""
    return stage(simulation, size, blade_rules=BladeRules()).draw(frame_now(simulation))
