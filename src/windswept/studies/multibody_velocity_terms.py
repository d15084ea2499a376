"""How much centrifugal and gyroscopic terms matter: `multibody` with and without them in the same turbulence.

``python -m windswept.studies.multibody_velocity_terms``: a JSON row a tree and a wind. What links carry holds those
terms: they are left out where every step begins with link velocities that are only the joints' rates in the pose that
the step is reckoned in, those rates being carried by the trapezoidal rule instead.
"""

from __future__ import annotations

import argparse
import json

import numpy as np

from windswept.motion import Model, build_model
from windswept.motion.multibody import MultibodyStepper, coupled_rest, link_velocities
from windswept.motion.multibody.constants import RATE_LEAD, forces_at, warped_step
from windswept.motion.rods import Doubles
from windswept.studies.bench_plants import plant_with_links
from windswept.studies.turbulence import Air, link_tips, rms, turbulent_air

LINKS, SEED, SPEEDS = 39, 0, (7.0, 14.0)
"""Of the tree, and mean winds, m/s."""
SUBSTEPS = 4
"""Inner steps between two samples of the wind."""


def tips(model: Model, air: Air, seconds: float, velocity_terms: bool) -> Doubles:
    """(time, L, 3) tips of all links in a wind, m."""
    stepper, state = MultibodyStepper(model), coupled_rest(model, 1)
    links, ahead = np.arange(model.link_count, dtype=np.int32), forces_at(model)
    beyond, interval, seen = warped_step(model) / ahead, SUBSTEPS * model.time_step, []
    carried = np.zeros((model.link_count, 2))
    for sample in range(round(seconds / interval)):
        winds = air(sample * interval), air((sample + 1) * interval)
        for part in range(SUBSTEPS):
            before = state.velocities(0).astype(np.float64)
            if not velocity_terms:
                pose = state.angles(0) + ahead * before
                state.carried[0, :, :, 0] = link_velocities(
                    model, pose.astype(np.float32), carried.astype(np.float32)
                )
            stepper.step(state, *winds, 1, part, SUBSTEPS)
            middle = (state.velocities(0) + RATE_LEAD * before) / (1.0 + RATE_LEAD)
            carried += beyond * (middle - carried)
        seen.append(link_tips(model, state, links)[0].astype(np.float64))
    return np.array(seen)


def row(speed: float, seconds: float, links: int = LINKS) -> dict[str, float]:
    """How far apart tips are without velocity terms, over their motion from rest and over the sway about the mean."""
    model = build_model(plant_with_links(links, SEED))
    air = turbulent_air(model, speed, SEED)
    whole, without = (tips(model, air, seconds, terms) for terms in (True, False))
    apart = rms(without - whole)
    figures = {
        "links": links,
        "wind_m_s": speed,
        "over_motion": apart / rms(whole - whole[0]),
        "over_sway": apart / rms(whole - whole.mean(axis=0)),
    }
    return {name: float(f"{value:.3g}") for name, value in figures.items()}


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(description="What multibody loses without its velocity terms.")
    parser.add_argument("--seconds", type=float, default=12.0)
    parser.add_argument("--links", type=int, nargs="+", default=(LINKS,))
    options = parser.parse_args(arguments)
    for links in options.links:
        for speed in SPEEDS:
            print(json.dumps(row(speed, options.seconds, links)), flush=True)


if __name__ == "__main__":
    main()
