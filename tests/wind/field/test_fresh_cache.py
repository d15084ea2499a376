"""A field is the same to the last bit whether its kernels were just compiled or come from Numba's cache."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

RUN = """
import hashlib
import numpy as np
from windswept.wind.field import *
from windswept.wind.gusts import Gust
from windswept.wind.mean import MeanWind
from windswept.wind.wind import Wind

way = Path(np.array([0.0, 9.0]), np.array([[-3.0, 0.0], [24.0, 4.0]]))
plan = FieldPlan(
    Grid((-4.0, -4.0), (0.4, 0.4, 0.4), (21, 21, 11)),
    primitives=(Line((0.5, 0.5, 0.0), vortex=5.0),),
    obstacles=(Spheroid((1.0, 1.0, 1.0), 1.0, 0.9, 0.4), Box((-1.0, -1.0), (1.0, 0.8), 1.0)),
    agents=(Ball(way, 0.4), Walker(way), Helicopter(way), Rain(20.0)),
)
field = start_field(plan, Wind(mean=MeanWind(6.0), gusts=(Gust(0.2, 8.0),)))
for _ in range(20):
    step_field(field, 1.0 / 30.0)
points = np.random.default_rng(0).uniform(-4.0, 4.0, (2000, 3)).astype(np.float32)
read = sample(field, points, points[:, 2] + np.float32(2.0))
assert all(np.count_nonzero(a) > 100 for a in (field.departure, field.push, field.flow, read))
for array in (field.deflection.tensor, field.departure, field.velocity, field.push, field.flow, read):
    print(hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest())
"""


@pytest.mark.slow
def test_the_first_run_of_all_is_like_the_second(tmp_path: Path) -> None:
    settings = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    first, second = (
        subprocess.run([sys.executable, "-c", RUN], env=settings, capture_output=True, text=True, check=True)
        for _ in range(2)
    )
    assert any(tmp_path.rglob("*.nbc"))
    assert len(first.stdout.split()) == 6
    assert first.stdout == second.stdout
