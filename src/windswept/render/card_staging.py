"""From a simulation on the card to what the renderer draws: poses and winds stay where they are."""

from __future__ import annotations

import numpy as np

from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.gpu.frame import Frame, PosedPlants
from windswept.gpu.renderer import Renderer
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.render.staging import LEVEL_LOOKS, camera_of, ground_grid, level_colour
from windswept.scene.camera import View, view_at


def stage_on_card(
    simulation: GpuSimulation, size: tuple[int, int] = (1280, 720), rules: DetailRules | None = None
) -> Renderer:
    """A renderer that holds everything of a simulation's scene.

    Args:
        simulation: whose plants and ground to draw.
        size: width and height, pixels.
        rules: what may be spent; None for what suits the device.
    """
    plants = [kind.plant for kind in simulation.kinds]
    geometries = [build_geometry(plant) for plant in plants]
    ground = ground_grid(simulation.scene.terrain)
    return Renderer(plants, geometries, ground, size, rules, extra_looks=LEVEL_LOOKS)


def frame_on_card(simulation: GpuSimulation, view: View | None = None, level_colours: bool = False) -> Frame:
    """What is to be seen at this moment; draw it before the simulation advances.

    Args:
        simulation: at the moment to draw.
        view: from where; None for the scene's own camera.
        level_colours: colour every plant by how few oscillators move it; which those are has to be read back.
    """
    levels = simulation.levels_now if level_colours else [None] * len(simulation.kinds)
    scene = simulation.scene
    x, y = simulation.wind.mean.vector
    sun = scene.sun_direction
    return Frame(
        plants=tuple(
            PosedPlants(
                link=None,
                position=kind.placements.position,
                yaw=kind.placements.yaw,
                flutter=np.zeros(kind.placements.count, np.float32),
                extra_look=None if at is None else level_colour(kind.levels, at),
            )
            for kind, at in zip(simulation.kinds, levels, strict=True)
        ),
        camera=camera_of(view_at(scene.camera, simulation.time) if view is None else view),
        sun=(float(sun[0]), float(sun[1]), float(sun[2])),
        time=simulation.time,
        wind=(float(x), float(y)),
        motion=simulation.motion(),
    )
