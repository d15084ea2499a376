"""Level zero: every link a rigid body, all coupled.

One step, for one placement::

    descend   root to leaf   where every link is half a step ahead, and the force on it (descend.py)
    ascend    leaf to root   the articulated inertia beyond every joint, and the joint's answer (ascend.py)
    advance   root to leaf   every joint's acceleration and step (advance.py)

`plain.py` is the same with the whole mass matrix in NumPy for one placement, and the tests hold the two together.
"""

from windswept.motion.multibody.coupled_state import coupled, coupled_rest, link_velocities
from windswept.motion.multibody.stepper import MultibodyStepper
from windswept.motion.state import CoupledState

__all__ = ["CoupledState", "MultibodyStepper", "coupled", "coupled_rest", "link_velocities"]
