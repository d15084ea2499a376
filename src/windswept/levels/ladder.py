"""build_ladder: a plant's simulation levels in a row, from every link down to a plant that stands still."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from windswept.levels.cut_level import compact_level, walk_cut
from windswept.levels.hierarchy import Hierarchy, way_errors
from windswept.levels.mismatch import LOG_HIGH, mismatch_table
from windswept.motion import Level, finest_level
from windswept.motion.level import GROUP_STEP
from windswept.motion.rods import Doubles
from windswept.plants.plant import Ints

STEP = 0.4
"""Each level has at most this many times the oscillators of the one before."""
TYPICAL_TO_95 = 2.0
"""95th percentile over standard deviation of the mismatch."""
DECOUPLED_SHARE = 0.02
"""Reckoned error of `springs` against `multibody`, as a share of a swaying plant's whole motion."""
COUPLED_RUNGS = 3
"""Finest cuts of the hierarchy that are also rungs of `multibody`: coarser ones lose what coupling gains
(docs/decisions/multibody.md)."""
COUPLED_COST = 2.75
"""Time of a coupled link over that of a link of `springs`, as measured."""


@dataclass(frozen=True, slots=True)
class Ladder:
    """Levels 0 (all links) to K - 1 (still), each coarser than the one before.

    Errors are against level 0, which is `springs`, or `multibody` where the ladder was built with it; then coupled
    levels stand among those of `springs` in the order of what they cost.
    """

    hierarchy: Hierarchy
    levels: tuple[Level, ...]
    """The last stands still; the one before, where kept, has no inertia: the plant follows the wind's pressure."""
    error: Doubles
    """(K,) stated error, m: estimated 95 % of tips, or what `with_measured_errors` makes of a measurement."""
    tolerance: Doubles
    """(K,) reckoned error of the hierarchy's nodes at which each level is cut; 0 for every link."""
    bound: Doubles | None = None
    """(K,) no tip is farther than this from where level 0 has it, in wind up to the stated speed, m; or None."""

    def merged(self, coupled: bool) -> Ints:
        """(n,) levels in which some links are merged and swing, that are coupled or are not."""
        return np.array(
            [k for k, x in enumerate(self.levels) if x.groups_swing and x.coupled == coupled], np.int32
        )

    @property
    def oscillators(self) -> list[int]:
        """Links and groups that each level steps."""
        return [level.link_count + level.group_count for level in self.levels]


def build_ladder(hierarchy: Hierarchy, multibody: bool = False) -> Ladder:
    """Ladder of a plant, its errors estimated from the hierarchy.

    Args:
        hierarchy: of the plant.
        multibody: whether `multibody` is its first rung, that all errors are against, with others after it.
    """
    levels, cuts = [finest_level(hierarchy.model)], [0.0]
    for tolerance in _tolerances(hierarchy):
        links, nodes = walk_cut(
            hierarchy.child, hierarchy.root, hierarchy.error <= tolerance, hierarchy.model.link_count
        )
        whole = len(links) == 0 and levels[-1].link_count > 0
        if whole or len(links) + len(nodes) < STEP * (levels[-1].link_count + levels[-1].group_count):
            levels.append(compact_level(hierarchy, np.sort(links), nodes))
            cuts.append(float(tolerance))
    # Without inertia a group is an oscillator of endless frequency.
    frequencies = [level.group_frequency for level in levels] + [
        np.full(levels[-1].group_count, np.exp(LOG_HIGH))
    ]
    errors = [
        estimated_error(hierarchy, level, w)
        for level, w in zip([*levels, levels[-1]], frequencies, strict=True)
    ]
    sway = np.linalg.norm(hierarchy.influence.tip, ord=2, axis=(1, 2))
    still = TYPICAL_TO_95 * float(np.sqrt(np.mean(sway**2)))
    levels += [_without_inertia(levels[-1]), _still(levels[-1])]
    ladder = Ladder(
        hierarchy=hierarchy,
        levels=tuple(levels),
        error=hierarchy.pressure * np.array([*errors, still]),
        tolerance=np.array([*cuts, cuts[-1], cuts[-1]]),
    )
    return _under_multibody(ladder) if multibody else ladder


def estimated_error(hierarchy: Hierarchy, level: Level, group_frequency: Doubles) -> float:
    """95 % error of a level's tips per pressure: twice the root mean square over the tips, s^2/m.

    Args:
        hierarchy: of the plant.
        level: one of its levels.
        group_frequency: (G,) angular frequency of the level's groups, rad/s.
    """
    model = hierarchy.model
    skeleton = model.skeleton
    way = way_errors(
        skeleton.parent,
        level.listens,
        np.log(model.stem_frequency[skeleton.stem]),
        np.log(np.append(group_frequency, 1.0)),
        hierarchy.lever,
        mismatch_table(float(model.damping_ratio.mean())),
    )
    tips = np.append(skeleton.stem_first_link[1:], model.link_count) - 1
    return TYPICAL_TO_95 * float(np.sqrt(np.mean(way[tips] ** 2)))


def _under_multibody(ladder: Ladder) -> Ladder:
    """The ladder with coupled levels among those of `springs`, the dearest first.

    What `springs` loses adds to what merging does as errors of unlike origin do, by their squares.
    """
    count = min(COUPLED_RUNGS, len(ladder.levels) - 2)
    coupled = [replace(level, coupled=True) for level in ladder.levels[:count] if level.link_count]
    levels = (*coupled, *ladder.levels)
    error = np.hypot(ladder.error, DECOUPLED_SHARE * ladder.error[-1])
    error[-1] = ladder.error[-1]
    order = np.argsort([-_cost(level) for level in levels[:-2]], kind="stable").tolist()
    order += [len(levels) - 2, len(levels) - 1]
    return replace(
        ladder,
        levels=tuple(levels[k] for k in order),
        error=np.concatenate([ladder.error[: len(coupled)], error])[order],
        tolerance=np.concatenate([ladder.tolerance[: len(coupled)], ladder.tolerance])[order],
    )


def _cost(level: Level) -> float:
    """What a level costs, in links of `springs`."""
    return (COUPLED_COST if level.coupled else 1.0) * level.link_count + level.group_count


def _tolerances(hierarchy: Hierarchy) -> Doubles:
    """Errors at which to cut: finely spaced from that of the smallest merges to that of the whole plant."""
    error = hierarchy.error
    low = np.quantile(error[error > 0], 0.2) if (error > 0).any() else 1e-12
    top = error[hierarchy.root] * 1.001 + 1e-12
    return np.append(np.geomspace(max(low, 1e-4 * top), 0.999 * top, 24), top)


def _without_inertia(level: Level) -> Level:
    """The same groups at rest in the wind of every moment: no state is carried from step to step."""
    constants = level.group_constants.copy()
    constants[:, GROUP_STEP : GROUP_STEP + 4] = 0.0
    return replace(level, group_constants=constants)


def _still(level: Level) -> Level:
    """A plant that does not move: every joint listens to a group that feels nothing."""
    constants = np.zeros_like(level.group_constants)
    return replace(level, group_constants=constants)
