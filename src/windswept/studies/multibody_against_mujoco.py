"""`multibody` against MuJoCo with the very same rods: frequencies, gusts, and forcing near the first frequency."""

from __future__ import annotations

import argparse
import json
from dataclasses import dataclass

import numpy as np

from windswept.motion import Model, Stepper, build_model, finest_level, plant_frequencies, rest_state
from windswept.motion.multibody import MultibodyStepper, coupled_rest
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.mujoco_tree import MujocoPlant, mujoco_frequencies, mujoco_tree
from windswept.studies.turbulence import Air, link_tips, rms, turbulent_air

SIZES, SEEDS = (39, 200, 1000), (0, 1, 2)
"""Links and seeds of the trees that are compared."""
SUBSTEPS = 4
"""Inner steps between two samples of the wind."""
STABLE = 1.5
"""Greatest angle in MuJoCo's step of the stiffest joint, rad: its springs are explicit, stable below 2."""
MEAN_SPEED = 7.0
"""Of the turbulent wind, m/s."""
NEAR_RESONANCE = 0.9
"""Forcing frequency over the plant's first."""


@dataclass(frozen=True, slots=True)
class Errors:
    """Root mean square over all link tips and the whole run."""

    motion: float
    """Displacement of the tips from rest in MuJoCo, m."""
    sway: float
    """Displacement from their mean place, m."""
    multibody: float
    """Distance from MuJoCo's, m."""
    springs: float
    """The same of the joints of `springs`, m."""


def compare(model: Model, air: Air, seconds: float, mujoco_step: float) -> Errors:
    """Blows the same wind at a plant in MuJoCo, in `multibody` and in `springs`.

    Args:
        model: the plant's constants.
        air: the wind; it goes linearly between samples SUBSTEPS inner steps apart.
        seconds: length of the run.
        mujoco_step: largest step of MuJoCo, s.
    """
    interval = SUBSTEPS * model.time_step
    parts = int(np.ceil(interval / mujoco_step))
    level, links = finest_level(model), np.arange(model.link_count, dtype=np.int32)
    coupling, jointed, theirs = (
        MultibodyStepper(model),
        Stepper(level),
        MujocoPlant(model, interval / parts),
    )
    ours, plain = coupled_rest(model, 1), rest_state(level, 1)
    rest, seen = theirs.tips(), []
    for sample in range(round(seconds / interval)):
        before, after = air(sample * interval), air((sample + 1) * interval)
        coupling.step(ours, before, after, SUBSTEPS)
        jointed.step(plain, before, after, SUBSTEPS)
        for part in range(parts):
            theirs.step((before[0] + (after[0] - before[0]) * ((part + 0.5) / parts)).astype(np.float64))
        seen.append([theirs.tips(), link_tips(model, ours, links)[0], link_tips(model, plain, links)[0]])
    their, multibody, springs = np.array(seen).transpose(1, 0, 2, 3)
    return Errors(
        motion=rms(their - rest),
        sway=rms(their - their.mean(axis=0)),
        multibody=rms(multibody - their),
        springs=rms(springs - their),
    )


def swaying_air(model: Model) -> Air:
    """The same air everywhere, that swells and ebbs near the plant's first frequency."""
    omega = NEAR_RESONANCE * 2.0 * np.pi * plant_frequencies(model.skeleton, model.rods, 1)[0]
    along = np.array([0.96, 0.28, 0.0], np.float32)
    shape = (len(model.probe_position), 1)
    return lambda time: np.tile(along, shape)[None] * np.float32(4.0 + np.sin(omega * time))


def row(links: int, seed: int, seconds: float) -> dict[str, float]:
    """One tree: its frequencies' worst difference, and errors over motion and over sway in both winds."""
    model = build_model(plant_with_links(links, seed))
    theirs = mujoco_frequencies(mujoco_tree(model))
    ours = plant_frequencies(model.skeleton, model.rods, 5)
    step = STABLE / (2.0 * np.pi * theirs[-1])
    figures: dict[str, float] = {
        "links": links,
        "seed": seed,
        "first_hz": float(ours[0]),
        "frequency_error": float(np.abs(ours / theirs[:5] - 1.0).max()),
    }
    for name, air in (("gust", turbulent_air(model, MEAN_SPEED, seed)), ("resonance", swaying_air(model))):
        errors = compare(model, air, seconds, step)
        figures[f"{name}_motion_m"] = errors.motion
        figures[f"{name}_error"] = errors.multibody / errors.motion
        figures[f"{name}_error_of_sway"] = errors.multibody / errors.sway
        figures[f"{name}_springs_error"] = errors.springs / errors.motion
    return figures


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(
        description="multibody against MuJoCo with the same rods, a JSON row a tree."
    )
    parser.add_argument("--links", type=int, nargs="+", default=SIZES)
    parser.add_argument("--seeds", type=int, nargs="+", default=SEEDS)
    parser.add_argument("--seconds", type=float, default=4.0)
    options = parser.parse_args(arguments)
    for links in options.links:
        for seed in options.seeds:
            figures = row(links, seed, options.seconds)
            print(json.dumps({name: float(f"{value:.3g}") for name, value in figures.items()}), flush=True)


if __name__ == "__main__":
    main()
