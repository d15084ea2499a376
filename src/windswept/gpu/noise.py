"""A tiling texture of noise: broad clouds, fine grain, bark furrows and white noise in one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SIZE = 512
"""Texels along a side."""
_SEED = 20070607


def noise_levels() -> list[NDArray[np.uint8]]:
    """Mip chain of (size, size, 4) texels, finest first. Made from a fixed seed, the same on every machine."""
    rng = np.random.default_rng(_SEED)
    broad = _spectral(rng, fall=1.9)
    fine = _spectral(rng, fall=1.0)
    furrow = _furrows(rng)
    white = rng.random((SIZE, SIZE))
    level = np.stack([broad, fine, furrow, white], axis=-1)
    levels = []
    while len(level) >= 1:
        levels.append(np.round(255.0 * level).astype(np.uint8))
        if len(level) == 1:
            break
        level = level.reshape(len(level) // 2, 2, len(level) // 2, 2, 4).mean(axis=(1, 3))
    return levels


def _spectral(rng: np.random.Generator, fall: float, stretch: float = 1.0) -> NDArray[np.float64]:
    """(size, size) noise whose amplitude falls with frequency^-fall; evenly spread over 0..1, tiling."""
    across = np.fft.fftfreq(SIZE)[None, :] * SIZE
    down = np.fft.fftfreq(SIZE)[:, None] * SIZE * stretch
    frequency = np.sqrt(across**2 + down**2)
    frequency[0, 0] = np.inf
    spectrum = np.fft.fft2(rng.standard_normal((SIZE, SIZE))) * frequency**-fall
    return _spread(np.fft.ifft2(spectrum).real)


def _furrows(rng: np.random.Generator) -> NDArray[np.float64]:
    """(size, size) ridges along v with dark creases between them."""
    wave = _spectral(rng, fall=1.15, stretch=5.0)
    crease = np.abs(wave - 0.5) * 2.0
    return _spread(0.75 * crease**0.7 + 0.25 * _spectral(rng, fall=0.9, stretch=2.5))


def _spread(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Map to 0..1 with mean 1/2, clipping the outermost two in a hundred."""
    low, high = np.quantile(values, [0.01, 0.99])
    return np.clip((values - low) / (high - low), 0.0, 1.0)
