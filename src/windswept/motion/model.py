"""The constants of a plant's motion: what a step reads and never writes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from windswept.motion.drag import Drag, build_drag
from windswept.motion.exact_step import exact_step
from windswept.motion.modal import Modes, no_modes, plant_modes
from windswept.motion.modes import stem_frequencies
from windswept.motion.rods import Doubles, Rods, build_rods
from windswept.motion.skeleton import Skeleton, build_skeleton
from windswept.motion.sweeps import joint_motion, joint_torque
from windswept.plants.plant import Floats, Ints, Material, Plant

TIME_STEP = 1.0 / 120.0
"""The fixed inner step, s."""
PROBE_SPACING = 1.5
"""Edge of the cells in which links share one wind probe, m; gusts are tens of metres long."""

CONSTANT_COUNT = 32
"""Columns of ``Model.constants``; the kernels in springs.py read them by the numbers below."""
AXIS_1, AXIS_2, VECTOR, ATTACH, OFFSET = 0, 3, 6, 9, 10
DRAG_CENTRE, DRAG_LEAF, DRAG_WOOD, INVERSE_SQUARE, MOBILITY = 13, 14, 20, 21, 22
COMPLIANCE_1, COMPLIANCE_2, STEP_XX, STEP_XV, STEP_VX, STEP_VV = 23, 24, 25, 26, 27, 28
PROPAGATION, TENSION, HALF_STEP = 29, 30, 31


@dataclass(frozen=True, slots=True)
class Model:
    """Constants of one plant with L links, S stems, B wind probes, in the plant's frame."""

    skeleton: Skeleton
    rods: Rods
    drag: Drag
    material: Material
    time_step: float
    """s"""
    stem_frequency: Doubles
    """(S,) angular frequency at which every joint of the stem oscillates, rad/s."""
    damping_ratio: Doubles
    """(S,) fraction of critical damping."""
    propagation: Doubles
    """(L,) factor on the force that a link passes on to its parent; 1 but for the paper's printed merges."""
    link_probe: Ints
    """(L,) probe that each link feels."""
    probe_position: Floats
    """(B, 3) where the wind is sampled, m."""
    constants: Floats
    """(L, CONSTANT_COUNT) all of the above as the kernels read it."""
    modes: Modes
    """Of the whole plant, all joints coupled."""

    @property
    def link_count(self) -> int:
        """Number of links, L."""
        return len(self.skeleton.parent)

    @property
    def joint_inertia(self) -> Doubles:
        """(L, 2) effective inertia of every joint, stiffness / frequency^2, kg m^2."""
        frequency = self.stem_frequency[self.skeleton.stem]
        return 1.0 / (self.rods.compliance * frequency[:, None] ** 2)


def build_model(plant: Plant, time_step: float = TIME_STEP, propagation: Doubles | None = None) -> Model:
    """Model of a plant: stiffness, mass, damping and drag of every joint and link.

    Every joint of a stem oscillates at the lowest frequency of the stem's own subtree clamped at its base, so
    its effective inertia is stiffness / frequency^2 and its static deflection is exact.

    Args:
        plant: the plant.
        time_step: fixed inner step, s.
        propagation: (L,) factors on passed-on force; None for 1, which is physics (PHYSICS C3.1).

    """
    skeleton, rods, drag = build_skeleton(plant), build_rods(plant), build_drag(plant)
    link_probe, probe_position = _place_probes(skeleton, drag)
    model = Model(
        skeleton=skeleton,
        rods=rods,
        drag=drag,
        material=plant.material,
        time_step=time_step,
        stem_frequency=stem_frequencies(skeleton, rods),
        damping_ratio=np.full(plant.stem_count, plant.material.damping_ratio),
        propagation=np.ones(plant.link_count) if propagation is None else propagation,
        link_probe=link_probe,
        probe_position=probe_position,
        constants=np.empty((0, CONSTANT_COUNT), np.float32),
        modes=no_modes(),
    )
    return replace(model, constants=pack_constants(model), modes=modes_of(model))


def modes_of(model: Model) -> Modes:
    """The modes of a model's plant, beside the frequencies and damping that its joints have for themselves."""
    stem = model.skeleton.stem
    own = model.stem_frequency[stem], model.damping_ratio[stem]
    return plant_modes(model.skeleton, model.rods, *own, model.time_step)


def joint_lag(model: Model) -> Doubles:
    """(L,) damping over stiffness of every joint, s, so that its stem's own mode has its damping ratio."""
    return (2.0 * model.damping_ratio / model.stem_frequency)[model.skeleton.stem]


def _place_probes(skeleton: Skeleton, drag: Drag) -> tuple[Ints, Floats]:
    """One probe for every occupied cell of a grid, at the mean of the drag centres in it."""
    centre = skeleton.base + drag.centre[:, None] * skeleton.vector
    cell = np.floor(centre / PROBE_SPACING).astype(np.int64)
    _, link_probe, size = np.unique(cell, axis=0, return_inverse=True, return_counts=True)
    link_probe = link_probe.ravel()
    position = np.column_stack([np.bincount(link_probe, centre[:, i]) / size for i in range(3)])
    return link_probe.astype(np.int32), position.astype(np.float32)


def drag_mobility(model: Model) -> Doubles:
    """(L,) how fast a unit drag coefficient's field slows each link down, 1/m.

    If every link felt the force c v e with its own drag constant c, along one axis e, its drag centre would
    accelerate by mobility x v. The kernel divides the damping part of drag by 1 + mobility |u| dt, which
    bounds the feedback at any wind speed (no step is too long), and leaves the static force untouched.
    """
    skeleton, drag = model.skeleton, model.drag
    coefficient = drag.leaf[:, :3].sum(axis=1) + drag.wood
    tree = (skeleton.parent, 0, skeleton.attach, skeleton.vector, skeleton.axes)
    lever = drag.centre[:, None] * skeleton.vector
    mobility = np.zeros(len(coefficient))
    for axis in np.eye(3):
        force = coefficient[:, None] * axis
        torque = joint_torque(*tree, force.copy(), np.cross(lever, force))
        angular, linear = joint_motion(*tree, torque / model.joint_inertia)
        speed = np.linalg.norm(linear + np.cross(angular, lever), axis=1)
        mobility = np.maximum(mobility, speed)
    return mobility


STABLE_SHARE = 4.0
"""How much softer than the stability limit of one joint the air's own stiffness is kept, since joints act together."""


def tension_per_force(model: Model) -> Doubles:
    """(L,) stiffness that the air's pull gives a joint, times the inner step squared over inertia, per newton.

    A force F beyond a joint resists a turn out of its line with the stiffness F x arm. The kernel feels that stiffness
    only through the next step's torque, which is stable while stiffness x step^2 / inertia is small; where F makes it
    larger than one, the kernel divides the joint's acceleration by it (no storm is too strong), and leaves the
    equilibrium untouched.
    """
    skeleton, drag = model.skeleton, model.drag
    at = skeleton.base + drag.centre[:, None] * skeleton.vector
    weight = drag.leaf[:, :3].sum(axis=1) + drag.wood + 1e-30

    def beyond(per_link: Doubles) -> Doubles:
        """Sum over each link's subtree."""
        summed = np.concatenate([np.zeros((1, *per_link.shape[1:])), np.cumsum(per_link, axis=0)])
        return summed[skeleton.subtree_end] - summed[:-1]

    whole = beyond(weight)
    mean = beyond(weight[:, None] * at) / whole[:, None]
    square = beyond(weight * np.sum(at**2, axis=1)) / whole
    arm = np.sqrt(
        np.maximum(square - 2.0 * np.sum(mean * skeleton.base, axis=1) + np.sum(skeleton.base**2, axis=1), 0)
    )
    return STABLE_SHARE * model.time_step**2 * arm / model.joint_inertia.min(axis=1)


def pack_constants(model: Model) -> Floats:
    """(L, CONSTANT_COUNT) constants in the columns that the kernels read."""
    skeleton, drag = model.skeleton, model.drag
    packed = np.zeros((model.link_count, CONSTANT_COUNT), np.float32)
    packed[:, AXIS_1 : AXIS_1 + 3] = skeleton.axes[:, 0]
    packed[:, AXIS_2 : AXIS_2 + 3] = skeleton.axes[:, 1]
    packed[:, VECTOR : VECTOR + 3] = skeleton.vector
    packed[:, ATTACH] = skeleton.attach
    root = skeleton.parent < 0
    packed[root, OFFSET : OFFSET + 3] = skeleton.base[root]
    packed[:, DRAG_CENTRE] = drag.centre
    packed[:, DRAG_LEAF : DRAG_LEAF + 6] = drag.leaf
    packed[:, DRAG_WOOD] = drag.wood
    packed[:, INVERSE_SQUARE] = 1.0 / skeleton.length**2
    packed[:, MOBILITY] = model.time_step * drag_mobility(model)
    packed[:, COMPLIANCE_1] = model.rods.compliance[:, 0]
    packed[:, COMPLIANCE_2] = model.rods.compliance[:, 1]
    stem_step = exact_step(model.stem_frequency, model.damping_ratio, model.time_step)
    packed[:, STEP_XX : STEP_VV + 1] = stem_step[skeleton.stem]
    packed[:, PROPAGATION] = model.propagation
    packed[:, HALF_STEP] = 0.5 * model.time_step
    packed[:, TENSION] = tension_per_force(model)
    return packed
