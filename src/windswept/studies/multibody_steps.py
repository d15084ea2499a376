"""`multibody` at its usual step against itself at finer ones, and whether plants come to rest in a steady storm.

``python -m windswept.studies.multibody_steps [SPECIES ...]``: a JSON row a plant, then one of the energy of a tree.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from windswept.levels.maximal_wind import maximal_wind
from windswept.levels.measure import followed_tips, tip_positions
from windswept.levels.training_wind import PLACEMENTS, Air, training_air
from windswept.motion import Model, build_model, finest_level, rest_state
from windswept.motion.modes import natural_modes
from windswept.motion.multibody import MultibodyStepper, coupled, coupled_rest
from windswept.motion.multibody.constants import forces_at, warped_step
from windswept.motion.multibody.plain import energy
from windswept.motion.rods import Doubles
from windswept.motion.sweeps import joint_torque
from windswept.plants.plant import Floats
from windswept.plants.sources import grow_source
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.turbulence import rms

SPECIES = ("hazel", "bracken", "wheat", "flowering_herb", "quaking_aspen")
SECONDS, MOST_TIPS, SUBSTEPS = 8.0, 300, 4
FINER = 16
"""Steps of the truth for one of the usual."""
STORMS = (12.0, 20.0, 30.0, 40.0)
"""Steady winds at every height, m/s."""
SWAY_WIND, SWAY_ASIDE, SWAY_SECONDS = (20.0, 0.0, 0.0), (21.0, 2.0, 0.0), 2.0
"""A plant that a wind holds is blown aside for half a second and sways back freely for so long; m/s and s."""
SWUNG_LINKS, SWUNG_ANGLES, RATES = 39, (0.001, 0.01), (5.0, 30.0, 120.0, 480.0, 2000.0)
"""Of a tree that swings freely after a pull: links, angles of the joint that is bent most (rad), steps a second.

The gentler swing loses what SETTLING takes of each mode. The wider one loses more: it is no longer linear, and passes
energy on to stiffer modes, which SETTLING takes sooner.
"""


def tips_in_wind(model: Model, air: Air, finer: int) -> tuple[Doubles, float]:
    """(time, P, n, 3) tips of a plant in a wind, m, and the largest rate of any joint, rad/s.

    Args:
        model: at its usual step.
        air: in which.
        finer: steps for one of the usual.
    """
    fine = replace(model, time_step=model.time_step / finer)
    level = replace(finest_level(fine), coupled=True)
    stepper, state, tips = (
        MultibodyStepper(fine),
        coupled_rest(fine, PLACEMENTS),
        followed_tips(fine, MOST_TIPS),
    )
    interval, seen, fastest = SUBSTEPS * model.time_step, [], 0.0
    for sample in range(round(SECONDS / interval)):
        winds = air(level, sample * interval), air(level, (sample + 1) * interval)
        stepper.step(state, *winds, SUBSTEPS * finer)
        seen.append(tip_positions(fine, level, state, tips).astype(np.float64))
        fastest = max(fastest, float(np.abs(state.joints[:, :, 1::2]).max()))
    return np.array(seen), fastest


def rates_in_storms(model: Model) -> list[float]:
    """Largest rate of any joint after ten seconds in each of STORMS, rad/s: at rest, none."""
    wind: Floats = np.zeros((len(STORMS), len(model.probe_position), 3), np.float32)
    wind[..., 0] = np.array(STORMS)[:, None]
    stepper, state = MultibodyStepper(model), coupled_rest(model, len(STORMS))
    second = round(1.0 / model.time_step)
    stepper.step(state, np.zeros_like(wind), wind, second)
    stepper.step(state, wind, wind, 9 * second)
    return [float(np.abs(state.velocities(placement)).max()) for placement in range(len(STORMS))]


def sway_in_wind(model: Model, finer: int) -> Doubles:
    """(time, 1, n, 3) free sway of tips about where SWAY_WIND holds them, m.

    Args:
        model: at its usual step.
        finer: steps for one of the usual.
    """
    fine = replace(model, time_step=model.time_step / finer)
    level = replace(finest_level(fine), coupled=True)
    stepper, state = MultibodyStepper(fine), coupled_rest(fine, 1)
    tips, second = followed_tips(fine, MOST_TIPS), round(1.0 / fine.time_step)
    wind, aside = (np.zeros((1, len(model.probe_position), 3), np.float32) for _ in range(2))
    wind[:], aside[:] = SWAY_WIND, SWAY_ASIDE
    stepper.step(state, np.zeros_like(wind), wind, second)
    stepper.step(state, wind, wind, 5 * second)
    held = tip_positions(fine, level, state, tips).astype(np.float64)
    stepper.step(state, aside, aside, second // 2)
    seen = []
    for _ in range(round(SWAY_SECONDS / model.time_step)):
        stepper.step(state, wind, wind, finer)
        seen.append(tip_positions(fine, level, state, tips) - held)
    return np.array(seen)


def bent_by_a_pull(model: Model) -> Doubles:
    """(L, 2) joint angles of a plant whose every mass is pulled aside alike, in no unit."""
    skeleton, rods = model.skeleton, model.rods
    force = np.outer(rods.mass, [1.0, 0.3, 0.0])
    lever = (rods.moment / rods.mass)[:, None] * skeleton.vector
    tree = (skeleton.parent, 0, skeleton.attach, skeleton.vector, skeleton.axes)
    return np.asarray(joint_torque(*tree, force.copy(), np.cross(lever, force)) * rods.compliance)


def settled_share(model: Model, angles: Doubles, seconds: float) -> float:
    """Share of its energy that a plant let go at rest keeps when SETTLING alone damps its modes, in small angles."""
    omega, shapes = natural_modes(model.skeleton, model.rods, 2 * model.link_count)
    energies = np.einsum("lir,li->r", shapes, angles / model.rods.compliance) ** 2
    beyond = forces_at(model) / warped_step(model) - 0.5
    kept = np.exp(-2.0 * omega**2 * beyond * model.time_step * seconds)
    return float(np.sum(energies * kept) / np.sum(energies))


def energy_left(rate: float, angle: float) -> tuple[float, float]:
    """Share of its energy that an undamped tree has after a minute, and the share that SETTLING alone would leave.

    Args:
        rate: steps a second.
        angle: that the joint bent most is pulled to, rad.
    """
    plant = plant_with_links(SWUNG_LINKS, 0)
    free = replace(plant.material, damping_ratio=0.0, wood_drag=0.0, leaf_drag=0.0)
    model = build_model(replace(plant, material=free), time_step=1.0 / rate)
    bent, start = bent_by_a_pull(model), rest_state(finest_level(model), 1)
    start.angles(0)[:] = bent * angle / np.abs(bent).max()
    state = coupled(model, start)
    calm: Floats = np.zeros((1, len(model.probe_position), 3), np.float32)

    def now() -> float:
        carried = state.carried[0, :, :, 0].reshape(-1, 2, 3).astype(np.float64)
        return energy(model, state.angles(0).astype(np.float64), carried)

    before = now()
    expected = settled_share(model, state.angles(0).astype(np.float64), 60.0)
    MultibodyStepper(model).step(state, calm, calm, round(60.0 * rate))
    return now() / before, expected


def rows(species: list[str]) -> Iterator[dict[str, object]]:
    """The study's rows."""
    for name in species:
        model = build_model(grow_source(name, 1))
        row: dict[str, object] = {"species": name, "links": model.link_count}
        for wind, air in (("training", training_air()), ("maximal", maximal_wind(model))):
            (usual, fast), (true, truly_fast) = (tips_in_wind(model, air, finer) for finer in (1, FINER))
            row[f"{wind}_error"] = rms(usual - true) / rms(true - true[0])
            row[f"{wind}_fastest_rad_s"] = [fast, truly_fast]
        usual, true = (sway_in_wind(model, finer) for finer in (1, FINER))
        row["sway_error"] = rms(usual - true) / rms(true)
        row["rates_in_storms_rad_s"] = rates_in_storms(model)
        yield row
    for angle in SWUNG_ANGLES:
        left = {f"{rate:g} Hz": energy_left(rate, angle) for rate in RATES}
        yield {
            "pulled_rad": angle,
            "energy_left_after_a_minute": {rate: share for rate, (share, _) in left.items()},
            "settling_alone_leaves": {rate: share for rate, (_, share) in left.items()},
        }


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(description="multibody at its usual step against finer ones.")
    parser.add_argument("species", nargs="*", default=SPECIES)
    for row in rows(parser.parse_args(arguments).species):
        print(json.dumps(row, default=float), flush=True)


if __name__ == "__main__":
    main()
