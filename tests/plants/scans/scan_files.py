"""Small scans of the tests' own."""

from __future__ import annotations

from pathlib import Path

import numpy as np

HEADER = "radius,length,start_x,start_y,start_z,axis_x,axis_y,axis_z,parent"


def fork() -> np.ndarray:
    """A trunk of three cylinders and a branch of two from its second, standing away from the origin."""
    up, out = (0.0, 0.0, 1.0), (0.8, 0.0, 0.6)
    return np.array(
        [
            [0.10, 1.0, 5.0, 7.0, 2.0, *up, 0],
            [0.08, 1.0, 5.0, 7.0, 3.0, *up, 1],
            [0.06, 1.0, 5.0, 7.0, 4.0, *up, 2],
            [0.03, 1.0, 5.0, 7.0, 3.4, *out, 2],
            [0.02, 1.0, 5.8, 7.0, 4.0, *out, 4],
        ]
    )


def write_csv(path: Path, table: np.ndarray, header: str = HEADER) -> Path:
    """Write a table as a scan."""
    rows = [",".join(f"{value:.9g}" for value in row) for row in table]
    path.write_text("\n".join([header, *rows] if header else rows) + "\n")
    return path
