"""Skjermo's section 5 remade: how many branches a second are bent and drawn, and how far branches lag behind."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from windswept.gpu.bend import Bending
from windswept.gpu.device import adapter_summary, is_software, shared_device
from windswept.gpu.frame import Camera
from windswept.motion.bend import Bender
from windswept.motion.bend_branches import Branches, BranchPose
from windswept.motion.bend_plain import attachment_gap
from windswept.studies.bench_bend import PAPER, STEMS, four_waves, rows_of_trees, tree_of_stems
from windswept.studies.branch_scene import BranchScene, branch_scene
from windswept.studies.machine import machine, median_seconds
from windswept.studies.skjermo_pictures import GUST_TIME, draw_deformer, draw_wood, gusty_wind
from windswept.studies.skjermo_plot import draw_frames
from windswept.wind.wind import Wind

PAPER_CARD = "GeForce 7900 GTX"
PAPER_TREES = 100
"""Section 5: "a scene with over a 100 highly detailed trees"."""
DRAWN = (1, 2, 4, 8, 16, 32, 64)
"""Trees of STEMS branches in figure 8's curve, on any card. The paper's own values stand only in its picture."""
LARGE_DRAWN = (128, 256)
"""On a real card as well."""
ONE_GRID = ((6, 8),)
"""The single mesh that every branch of that curve is an instance of."""
SIZE = (1280, 720)
STEP, STEPS = 1.0 / 60.0, 30
"""Step and number of steps over which the lag is measured, s."""
FRAMES, SOFTWARE_FRAMES = 32, 1
"""Drawn between two looks at the time, on a real card and where the CPU plays it."""
CARD_SECONDS = 3.0
"""How long the card is timed, about."""


def skjermo(folder: Path | None = None, say: Callable[[str], None] = lambda line: None) -> list[Any]:
    """Rows of the paper's results beside ours.

    Args:
        folder: gets the pictures, ``skjermo_deformer.png`` (figure 3), those of ``draw_wood`` (figure 7) and
            ``skjermo_frames.png`` (figure 8); None for none.
        say: told what is done.

    Returns:
        One dictionary a row: what was measured, on what, in which mode, branches and vertices, the paper's figure
        per second (None where its text has none) and ours; for bending also the gap at which branches stand off
        their parents.

    Raises:
        GraphicsError: there is no graphics adapter.
    """
    rows = []
    for count in PAPER:
        branches = rows_of_trees(count)
        say(f"bending {count:,} branches on the CPU")
        rows += _bent_on_cpu(branches)
        say(f"bending {count:,} branches on {adapter_summary()}")
        rows += _bent_on_card(branches)
    for trees in DRAWN if is_software(shared_device()) else DRAWN + LARGE_DRAWN:
        say(f"drawing {trees * STEMS:,} branches")
        rows.append(_drawn(trees))
    if folder is not None:
        say("drawing figure 3")
        draw_deformer(folder / "skjermo_deformer.png")
        rows.append(_wood_row(draw_wood(folder, say)))
        draw_frames(rows, folder / "skjermo_frames.png")
    return rows


def _row(
    what: str, on: str, mode: str, branches: int, per_second: float, paper: float | None, vertices: int = 0
) -> dict[str, Any]:
    return {
        "what": what,
        "mode": mode,
        "branches": branches,
        "vertices": vertices,
        "paper_on": PAPER_CARD,
        "paper_per_second": paper,
        "on": on,
        "per_second": float(f"{per_second:.4g}"),
    }


def _bent_on_cpu(branches: Branches) -> list[dict[str, Any]]:
    """Lagged and ordered passes with Numba."""
    info, wind = machine(), four_waves()
    on = f"{info['machine.processor']}, {info['machine.threads']} threads"
    rows = []
    for mode in ("lagged", "ordered"):
        bender = Bender(branches)
        state = bender.rest()
        step = bender.step_lagged if mode == "lagged" else bender.step_ordered
        seconds = median_seconds(lambda: step(state, wind, 1.0), repeats=60)  # noqa: B023
        row = _row("bend", on, mode, branches.branch_count, 1.0 / seconds, PAPER[branches.branch_count])
        rows.append(row | _gaps(branches, lambda t: bender.pose(step(state, gusty_wind(), t))))  # noqa: B023
    return rows


def _bent_on_card(branches: Branches) -> list[dict[str, Any]]:
    """The same with WGSL on the adapter that is there."""
    wind, device, rows = four_waves(), shared_device(), []
    for mode in ("lagged", "ordered"):
        card = Bending(device, branches)
        step = card.step_lagged if mode == "lagged" else card.step_ordered

        def stepped(t: float) -> BranchPose:
            step(gusty_wind(), t)  # noqa: B023
            return card.pose()  # noqa: B023

        count = branches.branch_count
        row = _row("bend", adapter_summary(), mode, count, _per_second(card, step, wind), PAPER[count])
        rows.append(row | _gaps(branches, stepped))
    return rows


def _per_second(card: Bending, step: Callable[..., None], wind: Wind) -> float:
    """Passes a second on the card, each submitted by itself as for a frame, and waited for after a run of them."""

    def run(passes: int) -> float:
        started = time.perf_counter()
        for number in range(passes):
            step(wind, number * STEP)
        card.wait()
        return (time.perf_counter() - started) / passes

    run(2)
    passes = int(np.clip(CARD_SECONDS / 3.0 / run(3), 3, 2000))
    return 1.0 / float(np.median([run(passes) for _ in range(3)]))


def _gaps(branches: Branches, pose_at: Callable[[float], BranchPose]) -> dict[str, float]:
    """How far branches stand off their parents' curves, step by step, as the front of a gust passes, m."""
    start = GUST_TIME - 0.5 * STEPS * STEP
    # The wind sets in at once; what is left after a step a level is the lag of motion.
    for _ in range(branches.level_count):
        pose_at(start)
    worst = np.zeros(branches.branch_count)
    for number in range(1, STEPS + 1):
        worst = np.maximum(worst, attachment_gap(branches, pose_at(start + number * STEP)))
    return {"gap_p95_m": float(f"{np.quantile(worst, 0.95):.3g}"), "gap_max_m": float(f"{worst.max():.3g}")}


def _drawn(trees: int) -> dict[str, Any]:
    """Frames a second, bent and drawn, of one point of figure 8."""
    across = int(np.ceil(np.sqrt(trees)))
    number = np.arange(trees)
    position = 6.0 * np.stack([number % across - 0.5 * across, number // across, 0 * number], axis=1)
    scene = branch_scene(
        [tree_of_stems()],
        np.zeros(trees, np.int32),
        position.astype(np.float32),
        2.0 * np.pi * (number * 0.6180339887 % 1.0),
        SIZE,
        grids=ONE_GRID,
        lit="_lit",
    )
    # From above grass is too far to be drawn: what is timed is branches, their shadows and the ground.
    reach = 6.0 * across
    camera = Camera((0.0, -40.0 - 0.5 * reach, 62.0), (0.0, 0.5 * reach, 5.0), 0.6)
    vertices = (ONE_GRID[0][0] + 1) * (ONE_GRID[0][1] + 1) * trees * STEMS
    per_second = _frames_per_second(scene, four_waves(), camera)
    return _row("frames", adapter_summary(), "lagged", trees * STEMS, per_second, None, vertices)


def _frames_per_second(scene: BranchScene, wind: Wind, camera: Camera) -> float:
    """Frames a second, bent and drawn one after the other and left on the card, of which the last is waited for."""
    frames = SOFTWARE_FRAMES if is_software(shared_device()) else FRAMES

    def draw() -> None:
        for number in range(frames):
            scene.bending.step_lagged(wind, GUST_TIME + number * STEP)
            scene.draw_aside(camera)
        scene.bending.wait()

    return frames / median_seconds(draw, repeats=5, warm_up=1)


def _wood_row(scene: BranchScene) -> dict[str, Any]:
    """Frames a second of the wood, bent and drawn at SIZE in full detail."""
    branches = scene.bending.branches
    scene.renderer.resize(SIZE)
    camera = Camera((-10.0, -36.0, 5.0), (2.0, 10.0, 7.6), 0.62)
    per_second = _frames_per_second(scene, gusty_wind(), camera)
    row = _row("wood", adapter_summary(), "lagged", branches.branch_count, per_second, None)
    return row | {"paper_trees": PAPER_TREES, "trees": int(branches.placement.max()) + 1}
