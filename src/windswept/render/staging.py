"""From a running simulation to what the renderer draws: the one place where scene and gpu meet."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from windswept.geometry.curves import build_geometry
from windswept.geometry.detail import DetailRules
from windswept.gpu.frame import (
    FLUTTER_SPEED,
    LARGEST_FLUTTER,
    Camera,
    Frame,
    Ground,
    MeadowMotion,
    PosedPlants,
)
from windswept.gpu.meadow.blade_list import BladeRules
from windswept.gpu.renderer import PICTURE_FORMAT, Renderer
from windswept.gpu.springs.simulation import GpuSimulation
from windswept.motion import TIME_STEP, Level
from windswept.plants.plant import Floats, Ints, Look
from windswept.render.balls import balls_now
from windswept.scene.camera import View, view_at
from windswept.scene.simulation import Simulation
from windswept.scene.terrain import Terrain

Running = Simulation | GpuSimulation
"""A scene in motion, on the CPU or on the card."""
LEVEL_COLOURS = (
    (0.55, 0.03, 0.03),
    (0.60, 0.16, 0.02),
    (0.55, 0.38, 0.03),
    (0.25, 0.45, 0.05),
    (0.04, 0.42, 0.14),
    (0.03, 0.32, 0.38),
    (0.03, 0.14, 0.50),
    (0.14, 0.05, 0.45),
)
"""From a plant of which every link is stepped (red) to one that sways as a whole (violet), linear RGB."""
LEVEL_LOOKS = tuple(
    Look(bark_colour=c, leaf_colour=c, leaf_back_colour=c, bark_relief=0.2) for c in LEVEL_COLOURS
)


def stage(
    simulation: Running,
    size: tuple[int, int] = (1280, 720),
    rules: DetailRules | None = None,
    blade_rules: BladeRules | None = None,
    colour_format: str = PICTURE_FORMAT,
) -> Renderer:
    """A renderer that holds everything of a simulation's scene.

    Args:
        simulation: whose plants and ground to draw.
        size: width and height, pixels.
        rules: what may be spent; None for what suits the device.
        blade_rules: the same for underbrush.
        colour_format: of its pictures.

    Raises:
        GraphicsError: there is no graphics adapter.
    """
    plants = [kind.plant for kind in simulation.kinds]
    geometries = [build_geometry(plant) for plant in plants]
    ground = ground_grid(simulation.scene.terrain)
    beds = () if simulation.meadow is None else simulation.meadow.beds
    return Renderer(plants, geometries, ground, size, rules, colour_format, LEVEL_LOOKS, beds, blade_rules)


class LevelLooks:
    """What placements wear by simulation level: the same arrays while nobody changes, so that a card keeps its rows."""

    def __init__(self) -> None:
        self._last: list[Ints] = []

    def of(self, simulation: Running) -> list[Ints]:
        """(P,) index into LEVEL_LOOKS of every placement, kind by kind; from the card levels have to be read back."""
        if isinstance(simulation, GpuSimulation):
            looks = [
                level_colour(kind.levels, at)
                for kind, at in zip(simulation.kinds, simulation.levels_now, strict=True)
            ]
        else:
            looks = [level_colour([s.level for s in kind.sets], kind.at) for kind in simulation.kinds]
        last = self._last or looks
        self._last = [old if np.array_equal(old, new) else new for old, new in zip(last, looks, strict=True)]
        return self._last


def frame_now(simulation: Running, view: View | None = None, level_looks: LevelLooks | None = None) -> Frame:
    """What is to be seen at this moment; of a simulation on the card, draw it before the simulation advances.

    Args:
        simulation: at the moment to draw.
        view: from where; None for the scene's own camera.
        level_looks: colours every plant by how few oscillators move it, one for all frames of a film; None for its own.
    """
    scene = simulation.scene
    x, y = simulation.wind.mean.vector
    return Frame(
        plants=_plants(simulation, level_looks),
        camera=camera_of(view_at(scene.camera, simulation.time) if view is None else view),
        sun=_triple(scene.sun_direction),
        time=simulation.time,
        wind=(float(x), float(y)),
        motion=simulation.motion() if isinstance(simulation, GpuSimulation) and simulation.kinds else None,
        balls=balls_now(scene, simulation.time),
        meadow=meadow_motion(simulation),
    )


def _plants(simulation: Running, level_looks: LevelLooks | None) -> tuple[PosedPlants, ...]:
    """All plants, with the poses that they have; on the card these stay where they are."""
    looks = [None] * len(simulation.kinds) if level_looks is None else level_looks.of(simulation)
    if isinstance(simulation, GpuSimulation):
        return _plants_on_card(simulation, looks)
    return tuple(
        PosedPlants(pose.link, kind.placements.position, kind.placements.yaw, flutter(speeds), look)
        for kind, pose, speeds, look in zip(
            simulation.kinds, simulation.pose, simulation.wind_speeds, looks, strict=True
        )
    )


def _plants_on_card(simulation: GpuSimulation, looks: Sequence[Ints | None]) -> tuple[PosedPlants, ...]:
    """All plants, without poses and winds."""
    return tuple(
        PosedPlants(
            link=None,
            position=kind.placements.position,
            yaw=kind.placements.yaw,
            flutter=np.zeros(kind.placements.count, np.float32),
            extra_look=look,
        )
        for kind, look in zip(simulation.kinds, looks, strict=True)
    )


def meadow_motion(simulation: Running) -> MeadowMotion | None:
    """How the blades of a simulation lean at this moment; None where it has none."""
    if simulation.meadow is None:
        return None
    ahead = simulation.time - simulation.step_count * TIME_STEP
    if isinstance(simulation, GpuSimulation):
        return MeadowMotion((), ahead, simulation.meadow.leaning.leans)
    states = [state for bed in simulation.meadow.beds for state in bed.states if state is not None]
    return MeadowMotion(tuple(state.lanes for state in states), ahead)


def level_colour(levels: Sequence[Level], at: Ints) -> Ints:
    """(P,) index into LEVEL_COLOURS: the logarithm of links over oscillators, from none merged to all merged.

    Args:
        levels: of one plant, the finest first.
        at: (P,) which of them each placement is at.
    """
    links = levels[0].link_count
    stepped = np.array([level.link_count + level.group_count for level in levels], np.float64)
    merged = np.log(links / stepped) / np.log(max(links, 2))
    return np.rint(merged[at] * (len(LEVEL_COLOURS) - 1)).astype(np.int32)


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
