"""The reference itself: a frame of beams against closed forms."""

import numpy as np
import pytest

from frame_elements import frame_frequencies, frame_of_cylinders


def test_uniform_cantilever() -> None:
    # f_n = (lambda_n^2 / 2 pi) (D/4) / L^2 sqrt(E / rho), lambda L = 1.8751, 4.6941 (PHYSICS B2).
    length, radius, count = 10.0, 0.1, 8
    rows = [[radius, length / count, 0, 0, i * length / count, 0.1, 0, 2.0, i] for i in range(count)]
    table = np.array(rows, float)
    table[:, 5] = 0.0
    found = frame_frequencies(frame_of_cylinders(table), count=4)
    scale = radius / 2 / length**2 * np.sqrt(9.5e9 / 800.0) / (2 * np.pi)
    assert found == pytest.approx(scale * np.array([1.8751, 1.8751, 4.6941, 4.6941]) ** 2, rel=2e-3)
