"""Free sway after a pull: a crown damps itself, since the trunk's energy goes into branches that beat out of step.

Measured trees have limbs whose own frequencies crowd round the trunk's (Rodriguez et al. 2008); limbs of grown plants
are stiffer, and their crowns damp nothing: the study prints that too. So it softens or stiffens each limb as a whole
until it rings near the trunk that carries it, lets the tree sway from a pull on its trunk in still air, and draws it
beside the same tree without side branches:
``python -m windswept.studies.multibody_branching -o branching_damping.png``.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from windswept.motion import Model, Stepper, build_model, finest_level, rest_state
from windswept.motion.modal import no_modes
from windswept.motion.multibody import MultibodyStepper, coupled
from windswept.motion.rods import Doubles
from windswept.motion.sweeps import joint_torque
from windswept.plants.plant import Plant
from windswept.plants.weber_penn import grow
from windswept.studies.bench_plants import cut_to_links
from windswept.studies.branching_plot import draw_branching
from windswept.studies.turbulence import link_tips

DAMPING_RATIO = 0.02
"""Of every branch by itself; there is no air in this study."""
SPREAD = 0.3
"""Limbs ring within this share of the trunk's frequency."""
RIGID = 1e6
"""Factor on the stiffness of limbs that only weigh on the trunk."""
PULLED_AT = 0.6
"""Where along the trunk's links the rope is tied."""
PULL = 0.02
"""Displacement of the trunk's tip over the plant's height."""
LOOKS = 24
"""Looks at the tip in a period."""


@dataclass(frozen=True, slots=True)
class Sway:
    """Free sway of a trunk's tip."""

    periods: Doubles
    """(n,) time over the period of the trunk with its load."""
    displacement: Doubles
    """(n,) along the pull, over the largest."""


def tuned_to_trunk(plant: Plant, seed: int = 0) -> Plant:
    """The plant with limbs that each ring, clamped at their base, near the trunk that carries their weight."""
    rng, own = np.random.default_rng(seed), build_model(plant)
    skeleton, scale = own.skeleton, np.ones((plant.link_count, 2), np.float32)
    scale[skeleton.stem != 0] = RIGID
    trunk = build_model(replace(plant, joint_scale=scale)).stem_frequency[0]
    scale[:] = 1.0
    for limb in np.flatnonzero(plant.stem_parent == 0):
        first = skeleton.stem_first_link[limb]
        wanted = trunk * rng.uniform(1.0 - SPREAD, 1.0 + SPREAD)
        scale[first : skeleton.subtree_end[first]] = (wanted / own.stem_frequency[limb]) ** 2
    return replace(plant, joint_scale=scale)


def airless(plant: Plant) -> Plant:
    """The plant in no air, with little damping in its wood."""
    material = replace(plant.material, damping_ratio=DAMPING_RATIO, leaf_drag=0.0, wood_drag=0.0)
    return replace(plant, material=material)


def trunk_alone(plant: Plant) -> Plant:
    """The plant without side branches."""
    return cut_to_links(replace(plant, joint_scale=None), int(plant.stem_link_start[1]))


def pulled_angles(model: Model, trunk: int, height: float) -> Doubles:
    """(L, 2) joint angles of a plant whose trunk of so many links is pulled aside by a rope."""
    skeleton = model.skeleton
    force = np.zeros((model.link_count, 3))
    force[int(PULLED_AT * trunk), 0] = 1.0
    tree = (skeleton.parent, 0, skeleton.attach, skeleton.vector, skeleton.axes)
    angles = joint_torque(*tree, force.copy(), np.cross(0.5 * skeleton.vector, force)) * model.rods.compliance
    state, top = rest_state(finest_level(model), 1), np.array([trunk - 1], np.int32)
    upright = link_tips(model, state, top)[0, 0, 0]
    state.angles(0)[:] = 1e-3 * angles / np.abs(angles).max()
    moved = link_tips(model, state, top)[0, 0, 0] - upright
    return 1e-3 * angles / np.abs(angles).max() * (PULL * height / moved)


def free_sway(plant: Plant, periods: float, decoupled: bool = False) -> Sway:
    """Sway of the trunk's tip after the pull, by `multibody` or by every joint for itself."""
    model = build_model(plant)
    trunk = int(plant.stem_link_start[1])
    state = rest_state(finest_level(model), 1)
    upright = link_tips(model, state, np.array([trunk - 1], np.int32))[0, 0, 0]
    state.angles(0)[:] = pulled_angles(model, trunk, plant.height)
    moving = coupled(model, state)
    alone = finest_level(replace(model, modes=no_modes()))
    stepper = Stepper(alone) if decoupled else MultibodyStepper(model)
    period = 2.0 * np.pi / model.stem_frequency[0]
    steps = max(1, round(period / model.time_step / LOOKS))
    calm = np.zeros((1, len(model.probe_position), 3), np.float32)
    seen = []
    for _ in range(round(periods * period / model.time_step / steps)):
        seen.append(link_tips(model, moving, np.array([trunk - 1], np.int32))[0, 0, 0] - upright)
        stepper.step(moving, calm, calm, steps)
    time = np.arange(len(seen)) * steps * model.time_step
    return Sway(time / period, np.array(seen) / np.abs(seen).max())


def damping_ratio(sway: Sway, periods: float = 6.0) -> float:
    """Damping ratio of the oscillator whose swing falls off as that of the first periods, window by window."""
    windows = range(int(periods))
    swing = [rms_within(sway, window) for window in windows]
    return float(-np.polyfit(windows, np.log(swing), 1)[0] / (2.0 * np.pi))


def rms_within(sway: Sway, window: int) -> float:
    """Root mean square displacement in one period."""
    inside = (sway.periods >= window) & (sway.periods < window + 1)
    return float(np.sqrt(np.mean(sway.displacement[inside] ** 2)))


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(
        description="Free sway of a tree after a pull, with and without its branches."
    )
    parser.add_argument("-o", "--output", type=Path, required=True, help="PNG file")
    parser.add_argument("--species", default="scots_pine")
    parser.add_argument("--periods", type=float, default=12.0)
    options = parser.parse_args(arguments)
    grown = airless(grow(options.species, 0))
    tree = tuned_to_trunk(grown)
    sways = {
        "with its branches": free_sway(tree, options.periods),
        "the same tree without side branches": free_sway(trunk_alone(tree), options.periods),
        "every joint for itself": free_sway(tree, options.periods, decoupled=True),
    }
    ratios = {name: damping_ratio(sway) for name, sway in sways.items()}
    print("a tree whose limbs are tuned to ring near their trunk:")
    draw_branching(
        {name: (s.periods, s.displacement) for name, s in sways.items()},
        ratios,
        DAMPING_RATIO,
        options.output,
    )
    for name, ratio in ratios.items():
        print(f"{name:<40} damping ratio {ratio:.3f}")
    print(f"{'every branch by itself':<40} damping ratio {DAMPING_RATIO:.3f}")
    print("the tree as it is grown, its limbs stiffer:")
    for name, plant in (("with its branches", grown), ("without side branches", trunk_alone(grown))):
        print(f"{name:<40} damping ratio {damping_ratio(free_sway(plant, options.periods)):.3f}")


if __name__ == "__main__":
    main()
