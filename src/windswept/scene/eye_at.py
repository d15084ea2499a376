"""eye_at, eye_of: who looks at a scene, as simulation levels are chosen for."""

from __future__ import annotations

import numpy as np

from windswept.levels import Eye, outside_view
from windswept.scene.camera import Camera, View, view_at


def eye_at(camera: Camera, time: float, picture_height: int, aspect: float, pixels: float) -> Eye:
    """The eye of a scene's camera at a time, s; see ``eye_of``."""
    return eye_of(view_at(camera, time), picture_height, aspect, pixels)


def eye_of(view: View, picture_height: int, aspect: float, pixels: float = 1.0) -> Eye:
    """The eye of a camera that is somewhere, which spares what is outside its picture.

    Args:
        view: where it is and looks.
        picture_height: pixels.
        aspect: width of the picture over its height.
        pixels: error that may be seen.
    """
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
