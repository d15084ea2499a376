"""Camera and sun matrices. Column vectors, clip space of WebGPU: x right, y up, depth 0..1."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from windswept.gpu.frame import Camera

Doubles = NDArray[np.float64]

NEAR = 0.08
"""Distance of the near plane, m."""


def view_matrix(eye: Doubles, forward: Doubles) -> Doubles:
    """(4, 4) world to eye: x right, y up, looking along -z. Looking straight up or down, y in the world is up."""
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    if np.linalg.norm(right) < 1e-6:
        right = np.array([1.0, 0.0, 0.0])
    right = right / np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([right, np.cross(right, forward), -forward])
    matrix[:3, 3] = -matrix[:3, :3] @ eye
    return matrix


def camera_matrix(camera: Camera, aspect: float) -> Doubles:
    """(4, 4) world to clip; depth is near over distance, so that float32 depth serves out to the horizon."""
    eye, focus = np.asarray(camera.eye, np.float64), np.asarray(camera.target, np.float64)
    zoom = 1.0 / np.tan(0.5 * camera.fov_y)
    projection = np.zeros((4, 4))
    projection[0, 0], projection[1, 1] = zoom / aspect, zoom
    projection[2, 3], projection[3, 2] = NEAR, -1.0
    return projection @ view_matrix(eye, focus - eye)


def sun_matrix(sun: Doubles, centre: Doubles, radius: float, depth: float, texels: int) -> Doubles:
    """(4, 4) world to the shadow map, which holds the ball round ``centre`` and moves by whole texels.

    Args:
        sun: (3,) unit direction towards the sun.
        centre: (3,) middle of what receives shadows, m.
        radius: of the ball, m.
        depth: how far towards and away from the sun casters are kept, m.
        texels: side of the shadow map.
    """
    view = view_matrix(np.zeros(3), -sun)
    texel = 2.0 * radius / texels
    middle = view[:3, :3] @ centre
    middle[:2] = np.round(middle[:2] / texel) * texel
    projection = np.diag([1.0 / radius, 1.0 / radius, -0.5 / depth, 1.0])
    projection[:3, 3] = -projection[:3, :3] @ middle + (0.0, 0.0, 0.5)
    return projection @ view


def shadow_ball(camera: Camera, aspect: float, reach: float) -> tuple[Doubles, float]:
    """Smallest ball round the part of the view nearer than ``reach``: centre (3,) and radius, m."""
    eye, focus = np.asarray(camera.eye, np.float64), np.asarray(camera.target, np.float64)
    forward = (focus - eye) / np.linalg.norm(focus - eye)
    tangent = np.tan(0.5 * camera.fov_y) * np.hypot(1.0, aspect)
    along = min(0.5 * reach * (1.0 + tangent**2), reach)
    radius = float(np.hypot(reach - along, reach * tangent)) if along < reach else reach * tangent
    return eye + along * forward, max(radius, 0.5 * reach)


def frustum_planes(matrix: Doubles) -> Doubles:
    """(5, 4) planes left, right, bottom, top, near; ``plane[:3] @ x + plane[3]`` is the distance inside, m."""
    rows = [
        matrix[3] + matrix[0],
        matrix[3] - matrix[0],
        matrix[3] + matrix[1],
        matrix[3] - matrix[1],
        matrix[3],
    ]
    planes = np.stack(rows)
    return planes / np.linalg.norm(planes[:, :3], axis=1, keepdims=True)
