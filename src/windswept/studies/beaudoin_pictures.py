"""Pictures after Beaudoin's figures 1, 6 and 7: one tree at fewer and fewer oscillators, at one moment and in a row."""

from __future__ import annotations

import colorsys
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.frame import Frame
from windswept.gpu.renderer import Renderer
from windswept.levels.training_wind import training_air
from windswept.motion import Level, Model, State, Stepper, pose_links, rest_state
from windswept.motion.lanes import WIDTH
from windswept.plants.plant import Floats, Plant
from windswept.plants.pose import Pose
from windswept.render.offscreen import write_png
from windswept.render.staging import frame_now, stage
from windswept.scene.camera import standing_camera
from windswept.scene.lone_plant import lone_plant
from windswept.scene.simulation import Simulation

Picture = NDArray[np.uint8]

TREE = (360, 500)
"""Width and height of one tree's picture, pixels."""
FIELD_OF_VIEW = 0.5
"""Vertical, rad."""
CAPTION = 34
"""Height of the line under it, pixels."""
MOMENT = 6.0
"""When the trees are drawn, s: leaning in a gust."""
STRIP = tuple(MOMENT - 1.6 + 0.4 * k for k in range(7))
"""When the trees of the frame strip are drawn, s."""
PAPER_WHITE, INK = (255, 255, 255), (40, 40, 40)


def draw_beaudoin(
    plant: Plant,
    model: Model,
    levels: Sequence[Level],
    folder: Path,
    say: Callable[[str], None] = lambda line: None,
) -> None:
    """Writes beaudoin_levels.png (figures 1 and 6) and beaudoin_strip.png (figure 7) into a folder.

    Args:
        plant: the tree.
        model: of it.
        levels: level 0 and those of the table, finest first.
        folder: that exists.
        say: told what is done.
    """
    say("drawing the tree at every level")
    poses = [_poses(model, level, (MOMENT,))[0] for level in levels]
    draw = _tree_drawer(plant)
    words = [f"{level.link_count + level.group_count:,} simulated" for level in levels]
    above = np.concatenate(
        [_captioned(draw(pose), line) for pose, line in zip(poses, words, strict=True)], axis=1
    )
    below = np.concatenate(
        [_structure(model, level, pose) for level, pose in zip(levels, poses, strict=True)], axis=1
    )
    write_png(np.concatenate([above, below], axis=0), folder / "beaudoin_levels.png")
    say("drawing a row of frames")
    rows = []
    for level in (levels[0], levels[-2]):
        line = f"{level.link_count + level.group_count:,} simulated"
        frames = zip(STRIP, _poses(model, level, STRIP), strict=True)
        rows.append(
            np.concatenate([_captioned(draw(pose), f"{line}, {time:.1f} s") for time, pose in frames], axis=1)
        )
    write_png(np.concatenate(rows, axis=0), folder / "beaudoin_strip.png")


def _poses(model: Model, level: Level, times: Sequence[float]) -> list[Floats]:
    """(1, L, 8) poses at the given times of a tree that starts from rest in the training wind."""
    air, stepper, state = training_air(), Stepper(level), rest_state(level, WIDTH)
    interval, poses = 4 * level.time_step, []
    for sample in range(round(times[-1] / interval) + 1):
        if any(abs(sample * interval - time) < 0.5 * interval for time in times):
            poses.append(pose_links(model, level, State(state.joints[:1], state.groups[:1], 1)).link)
        stepper.step(state, air(level, sample * interval), air(level, (sample + 1) * interval), 4)
    return poses


def _tree_drawer(plant: Plant) -> Callable[[Floats], Picture]:
    """What draws the tree in a pose, in a scene of its own."""
    middle = np.array([0.0, 0.0, 0.5 * plant.height])
    away = np.array([0.0, -2.35 * plant.height, 0.1 * plant.height])
    scene = replace(lone_plant("hazel"), camera=standing_camera(middle + away, middle, FIELD_OF_VIEW))
    simulation = Simulation(scene, [plant])
    renderer: Renderer = stage(simulation, TREE)
    frame: Frame = frame_now(simulation)

    def draw(link: Floats) -> Picture:
        return renderer.draw(replace(frame, plants=(replace(frame.plants[0], link=link),)))[..., :3]

    return draw


def _structure(model: Model, level: Level, link: Floats) -> Picture:
    """What is simulated: links that are stepped in black, what moves together in one colour."""
    from PIL import Image, ImageDraw

    skeleton, pose = model.skeleton, Pose(link)
    ends = np.stack([pose.position[0], pose.ends(skeleton.vector)[0]], axis=1)[:, :, (0, 2)]
    rest = np.abs(skeleton.base)
    scale = 0.92 * min(TREE[1] / rest[:, 2].max(), 0.5 * TREE[0] / rest[:, 0].max())
    picture = Image.new("RGB", TREE, PAPER_WHITE)
    draw = ImageDraw.Draw(picture)
    listens = level.listens
    for k in np.argsort(listens >= 0, kind="stable").tolist():
        (x0, z0), (x1, z1) = ends[k].tolist()
        line = (
            TREE[0] / 2 + scale * x0,
            TREE[1] - 8 - scale * z0,
            TREE[0] / 2 + scale * x1,
            TREE[1] - 8 - scale * z1,
        )
        draw.line(line, fill=INK if listens[k] >= 0 else _group_colour(-1 - int(listens[k])))
    return np.asarray(picture)


def _group_colour(group: int) -> tuple[int, int, int]:
    """A colour unlike that of the groups before."""
    r, g, b = colorsys.hsv_to_rgb(group * 0.618034 % 1.0, 0.75, 0.85)
    return int(255 * r), int(255 * g), int(255 * b)


def _captioned(picture: Picture, words: str) -> Picture:
    """The picture with a line of words under it."""
    from PIL import Image, ImageDraw

    framed = Image.new("RGB", (picture.shape[1], picture.shape[0] + CAPTION), PAPER_WHITE)
    framed.paste(Image.fromarray(np.ascontiguousarray(picture)), (0, 0))
    draw = ImageDraw.Draw(framed)
    draw.text((picture.shape[1] // 2, picture.shape[0] + 8), words, fill=INK, font_size=20, anchor="mt")
    return np.asarray(framed)
