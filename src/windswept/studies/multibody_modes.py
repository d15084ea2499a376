"""Whether `multibody` rings at a plant's natural frequencies: each mode swung freely by the stepper itself.

``python -m windswept.studies.multibody_modes``: a JSON row a tree. The trapezoidal rule turns a mode of frequency f too
slowly by (omega h)^2 / 12; the warped step takes the first mode's share of that from all of them.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace

import numpy as np

from windswept.motion import Model, build_model, finest_level, plant_frequencies, rest_state
from windswept.motion.modes import natural_modes
from windswept.motion.multibody import MultibodyStepper, coupled
from windswept.motion.multibody.constants import warped_step
from windswept.plants.plant import Floats
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.mujoco_tree import mujoco_frequencies, mujoco_tree

LINKS, SEEDS, MODES = 39, (0, 1), 5
PERIODS, SWING = 24, 1e-3
"""Of a mode that swings freely, and its largest joint angle, rad: no term of higher order matters."""


def ringing_frequency(model: Model, mode: int) -> float:
    """Frequency at which one of MODES modes, 0 for the lowest, rings in the stepper without air and damping, Hz.

    From how far the phase of its share in the angles runs from the expected one between the first and the last third.
    """
    free = replace(model, damping_ratio=0.0 * model.damping_ratio)
    omega, shapes = natural_modes(free.skeleton, free.rods, MODES)
    expected, shape = omega[mode] / (2.0 * np.pi), shapes[..., mode]
    start = rest_state(finest_level(free), 1)
    start.angles(0)[:] = SWING * shape / np.abs(shape).max()
    state, stepper = coupled(free, start), MultibodyStepper(free)
    calm: Floats = np.zeros((1, len(free.probe_position), 3), np.float32)
    weight, seen = shape / free.rods.compliance, []
    for _ in range(round(PERIODS / expected / free.time_step)):
        seen.append(float(np.sum(weight * state.angles(0))))
        stepper.step(state, calm, calm)
    time = np.arange(len(seen)) * free.time_step
    turned = np.array(seen) * np.exp(-2j * np.pi * expected * time)
    third = len(seen) // 3
    window = np.hanning(third)
    first, last = np.sum(window * turned[:third]), np.sum(window * turned[-third:])
    run = float(np.angle(last / first))
    return float(expected) + run / (2.0 * np.pi * (len(seen) - third) * free.time_step)


def row(links: int, seed: int) -> dict[str, object]:
    """Frequencies of one tree, Hz: of its mass matrix, of MuJoCo's, and as they ring; and worst difference."""
    model = build_model(plant_with_links(links, seed))
    own = plant_frequencies(model.skeleton, model.rods, MODES)
    theirs = mujoco_frequencies(mujoco_tree(model))[:MODES]
    rung = np.array([ringing_frequency(model, mode) for mode in range(MODES)])
    expected = np.arctan(np.pi * own * warped_step(model)) / (np.pi * model.time_step)
    return {
        "links": links,
        "seed": seed,
        "hz": own.round(4).tolist(),
        "mujoco_hz": theirs.round(4).tolist(),
        "rung_hz": rung.round(4).tolist(),
        "trapezoidal_rule_hz": expected.round(4).tolist(),
        "rung_error": float(f"{np.abs(rung / theirs - 1.0).max():.3g}"),
    }


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(description="Modes of multibody as its stepper rings them.")
    parser.add_argument("--links", type=int, default=LINKS)
    parser.add_argument("--seeds", type=int, nargs="+", default=SEEDS)
    options = parser.parse_args(arguments)
    for seed in options.seeds:
        print(json.dumps(row(options.links, seed)), flush=True)


if __name__ == "__main__":
    main()
