"""world_links: where the links of placed plants are in the world."""

from __future__ import annotations

from windswept.plants.plant import Floats
from windswept.scene.probes import turn_about_z
from windswept.scene.simulation import Simulation


def world_links(simulation: Simulation, kind: int) -> tuple[Floats, Floats]:
    """Both ends of every link of all P placements of one kind at this moment.

    Args:
        simulation: at its moment.
        kind: which of ``simulation.scene.kinds``.

    Returns:
        (P, L, 3) joints at the bases and (P, L, 3) far ends, m; a stem's last link ends at its tip.
    """
    moving, pose = simulation.kinds[kind], simulation.pose[kind]
    at, yaw = moving.placements.position[:, None], moving.placements.yaw
    tips = pose.ends(moving.plant.link_tip - moving.plant.link_base)
    return turn_about_z(pose.position, yaw) + at, turn_about_z(tips, yaw) + at
