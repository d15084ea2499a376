"""eye_at: who looks at a scene at a time, as simulation levels are chosen for."""

from __future__ import annotations

import numpy as np

from windswept.levels import Eye, outside_view
from windswept.scene.camera import Camera, view_at


def eye_at(camera: Camera, time: float, picture_height: int, aspect: float, pixels: float) -> Eye:
    """A camera's eye, which spares what is outside its picture.

    Args:
        camera: of the scene.
        time: s.
        picture_height: pixels.
        aspect: width of the picture over its height.
        pixels: error that may be seen.
    """
    view = view_at(camera, time)
    towards = view.target - view.eye
    return Eye(
        view.eye,
        view.fov_y,
        picture_height,
        pixels,
        forward=towards / np.linalg.norm(towards),
        aspect=aspect,
        measures=(outside_view,),
    )
