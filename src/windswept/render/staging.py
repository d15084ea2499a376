"""From a running simulation to what the renderer draws: the one place where scene and gpu meet."""

from __future__ import annotations

import numpy as np

from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.gpu.frame import Camera, Frame, Ground, PosedPlants
from windswept.gpu.renderer import Renderer
from windswept.plants.plant import Floats
from windswept.scene.camera import View, view_at
from windswept.scene.simulation import Simulation
from windswept.scene.terrain import Terrain

LARGEST_FLUTTER = 0.6
"""How far a readily fluttering leaf trembles in a storm, rad."""
FLUTTER_SPEED = 5.0
"""Wind speed at which it trembles with 63 % of that, m/s."""


def stage(
    simulation: Simulation, size: tuple[int, int] = (1280, 720), rules: DetailRules | None = None
) -> Renderer:
    """A renderer that holds everything of a simulation's scene.

    Args:
        simulation: whose plants and ground to draw.
        size: width and height, pixels.
        rules: what may be spent; None for what suits the device.

    Raises:
        GraphicsError: there is no graphics adapter.
    """
    plants = [kind.plant for kind in simulation.kinds]
    geometries = [build_geometry(plant) for plant in plants]
    return Renderer(plants, geometries, ground_grid(simulation.scene.terrain), size, rules)


def frame_now(simulation: Simulation, view: View | None = None) -> Frame:
    """What is to be seen at this moment.

    Args:
        simulation: at the moment to draw.
        view: from where; None for the scene's own camera.
    """
    scene = simulation.scene
    seen = view_at(scene.camera, simulation.time) if view is None else view
    posed = tuple(
        PosedPlants(pose.link, kind.placements.position, kind.placements.yaw, flutter(speeds))
        for kind, pose, speeds in zip(simulation.kinds, simulation.pose, simulation.wind_speeds, strict=True)
    )
    x, y = simulation.wind.mean.vector
    return Frame(
        plants=posed,
        camera=camera_of(seen),
        sun=_triple(scene.sun_direction),
        time=simulation.time,
        wind=(float(x), float(y)),
    )


def camera_of(view: View) -> Camera:
    """A scene's view as the renderer takes it."""
    return Camera(_triple(view.eye), _triple(view.target), view.fov_y)


def flutter(speeds: Floats) -> Floats:
    """(P,) amplitude of trembling leaves in wind of (P,) m/s, rad; exactly 0 in calm air."""
    return (LARGEST_FLUTTER * -np.expm1(-speeds / FLUTTER_SPEED)).astype(np.float32)


def ground_grid(terrain: Terrain) -> Ground:
    """The terrain as the renderer takes it."""
    corner = -0.5 * terrain.size
    return Ground(terrain.heights, (corner, corner), terrain.spacing)


def _triple(vector: Floats) -> tuple[float, float, float]:
    return float(vector[0]), float(vector[1]), float(vector[2])
