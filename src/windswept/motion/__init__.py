"""Motion models on the CPU: from a Plant to a Model, a State that steps, and the Pose it strikes."""

from windswept.motion.build_stepper import build_stepper
from windswept.motion.level import Level, finest_level
from windswept.motion.model import TIME_STEP, Model, build_model
from windswept.motion.modes import plant_frequencies
from windswept.motion.pose_links import pose_links
from windswept.motion.push import push
from windswept.motion.springs import Stepper
from windswept.motion.state import State, rest_state

__all__ = [
    "TIME_STEP",
    "Level",
    "Model",
    "State",
    "Stepper",
    "build_model",
    "build_stepper",
    "finest_level",
    "plant_frequencies",
    "pose_links",
    "push",
    "rest_state",
]
