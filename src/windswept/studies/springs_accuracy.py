"""`springs` against `multibody` in turbulent wind: how far tips part, and whether they sway as much in every band.

With every joint for itself, and with the lowest modes of the whole plant in common (motion/modal.py), for six plants:
``python -m windswept.studies.springs_accuracy``.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace

import numpy as np

from windswept.motion import Model, Stepper, build_model, finest_level, rest_state
from windswept.motion.modal import no_modes
from windswept.motion.multibody import MultibodyStepper, coupled_rest
from windswept.motion.rods import Doubles
from windswept.plants.plant import Ints
from windswept.plants.weber_penn import grow
from windswept.studies.turbulence import Air, link_tips, rms, turbulent_air

SPECIES = ("quaking_aspen", "scots_pine", "hazel", "wild_cherry", "sugar_maple", "norway_spruce")
PLACEMENTS = 4
"""Plants that stand in different parts of the same wind."""
MOST_TIPS = 300
"""Stem tips that are followed, evenly picked."""
SUBSTEPS = 4
"""Inner steps between two samples of the wind, and between two looks at the tips."""
SETTLE = 5.0
"""Seconds before the first look: plants start at rest."""
BANDS = ((0.1, 0.5), (0.5, 2.0), (2.0, 8.0))
"""Hz."""


def tip_tracks(models: dict[str, Model], air: Air, seconds: float, links: Ints) -> dict[str, Doubles]:
    """(time, P, n, 3) displacement of tips from rest: `multibody` of the first model, and `springs` of every one.

    Args:
        models: of one plant, by name.
        air: wind at the plant's probes.
        seconds: length of the run after SETTLE.
        links: whose tips are followed.
    """
    first = next(iter(models.values()))
    coupled, coupling = coupled_rest(first, PLACEMENTS), MultibodyStepper(first)
    springs = {
        name: (Stepper(finest_level(model)), rest_state(finest_level(model), PLACEMENTS))
        for name, model in models.items()
    }
    rest, interval = link_tips(first, coupled, links), SUBSTEPS * first.time_step
    tracks: dict[str, list[Doubles]] = {name: [] for name in ("multibody", *models)}
    for sample in range(round((SETTLE + seconds) / interval)):
        before, after = air(sample * interval), air((sample + 1) * interval)
        coupling.step(coupled, before, after, SUBSTEPS)
        for stepper, state in springs.values():
            stepper.step(state, before, after, SUBSTEPS)
        if sample * interval >= SETTLE:
            tracks["multibody"].append((link_tips(first, coupled, links) - rest).astype(float))
            for name, (_, state) in springs.items():
                tracks[name].append((link_tips(first, state, links) - rest).astype(float))
    return {name: np.array(track) for name, track in tracks.items()}


def band_power(track: Doubles, interval: float) -> Doubles:
    """(bands,) power of tip motion in every band of BANDS, m^2, over all tips."""
    window = np.hanning(len(track)).reshape(-1, 1, 1, 1)
    power = np.sum(np.abs(np.fft.rfft((track - track.mean(axis=0)) * window, axis=0)) ** 2, axis=(1, 2, 3))
    hertz = np.fft.rfftfreq(len(track), interval)
    return np.array([power[(hertz >= low) & (hertz < high)].sum() for low, high in BANDS])


def row(species: str, mean_speed: float, seconds: float, seed: int = 0) -> dict[str, float | str]:
    """Errors and band powers of one plant."""
    model = build_model(grow(species, seed))
    last = np.append(model.skeleton.stem_first_link[1:], model.link_count) - 1
    links = last[:: max(1, len(last) // MOST_TIPS)].astype(np.int32)
    air = turbulent_air(model, mean_speed, seed, PLACEMENTS)
    models = {"before": replace(model, modes=no_modes()), "after": model}
    tracks = tip_tracks(models, air, seconds, links)
    true = tracks["multibody"]
    power = band_power(true, SUBSTEPS * model.time_step)
    figures: dict[str, float | str] = {
        "species": species,
        "links": model.link_count,
        "first_hz": model.stem_frequency[0] / (2.0 * np.pi),
        "motion_m": rms(true),
        "sway_m": rms(true - true.mean(axis=0)),
    }
    for name in models:
        apart = rms(tracks[name] - true)
        figures[f"{name}_error"] = apart / rms(true)
        figures[f"{name}_error_of_sway"] = apart / rms(true - true.mean(axis=0))
        decibel = 10.0 * np.log10(band_power(tracks[name], SUBSTEPS * model.time_step) / power)
        for (low, high), value in zip(BANDS, decibel, strict=True):
            figures[f"{name}_{low:g}_{high:g}_hz_db"] = float(value)
    return figures


def main(arguments: list[str] | None = None) -> None:
    """The command line of the study."""
    parser = argparse.ArgumentParser(
        description="springs against multibody in turbulent wind, a JSON row a plant."
    )
    parser.add_argument("species", nargs="*", default=SPECIES)
    parser.add_argument("--mean-speed", type=float, default=6.0, help="at 10 m height, m/s")
    parser.add_argument("--seconds", type=float, default=20.0)
    options = parser.parse_args(arguments)
    for species in options.species or SPECIES:
        figures = row(species, options.mean_speed, options.seconds)
        rounded = {k: v if isinstance(v, str) else float(f"{v:.3g}") for k, v in figures.items()}
        print(json.dumps(rounded), flush=True)


if __name__ == "__main__":
    main()
